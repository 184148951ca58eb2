"""What a script or the outliner can do to what Motus keeps in a file. Run in a Blender of its own, which is to stay alive."""

import contextlib
import functools
import itertools
import logging
import traceback
from pathlib import Path

import bpy

FRAME = 17


def hub_meshes():
    return [mesh for mesh in bpy.data.meshes if "motus_owner" in mesh or "motus_shared" in mesh]


def hubs():
    meshes = set(hub_meshes())
    return [obj for obj in bpy.data.objects if obj.data in meshes]


def helpers():
    """What works behind the scenes: hubs, and the empties by which solvers wait or objects are moved."""
    return [obj for obj in bpy.data.objects if not obj.users_collection]


def owners():
    return [obj for obj in bpy.data.objects if obj.is_property_set("motus")]


def own_keys():
    """{kind: names} of the custom properties on hubs' meshes, and on the objects that these work for, of all systems."""
    found = {}
    for block in (*hub_meshes(), *owners(), *helpers()):
        for key in block.keys():
            if key.startswith("motus_"):
                kind = next((part for part in ("_out", "_info", "_row", "_wait", "_wired", "_of_") if part in key), key)
                found.setdefault(kind, set()).add(key)
    return found


def places(keys):
    """(datablock, name) of all custom properties of these names."""
    return [(block, key) for block in (*bpy.data.meshes, *bpy.data.objects) for key in keys if key in block]


def _give(make):
    def act(keys):
        for block, key in places(keys):
            try:
                value = make(block[key])
                del block[key]
                block[key] = value
            except (TypeError, ValueError):
                continue

    return act


def _longer(value):
    return list(value) * 2 + [0.0] if hasattr(value, "__len__") and not isinstance(value, (str, dict)) else [1.0] * 9


def _delete(keys):
    for block, key in places(keys):
        del block[key]


def _rename(keys):
    for block, key in places(keys):
        block[key + "_x"] = block[key]
        del block[key]


OF_KEYS = {
    "deleted": _delete,
    "renamed": _rename,
    "a number": _give(lambda _: 5),
    "a text": _give(lambda _: "x"),
    "a group": _give(lambda _: {}),
    "another length": _give(_longer),
    "whole numbers": _give(lambda _: [1, 2, 3]),
    "a datablock": _give(lambda _: bpy.data.scenes[0]),
}
"""What may happen to custom properties of these names: on all that have them."""


def spoil_keys(turn):
    """Does something else to the custom properties of each kind; in as many turns as there are acts, each act to each kind."""
    acts = list(OF_KEYS.values())
    for number, names in enumerate(own_keys().values()):
        acts[(number + turn) % len(acts)](names)


def _each(found, act):
    def each():
        for one in found():
            with contextlib.suppress(ReferenceError, RuntimeError):
                act(one)

    return each


def _clear_constraints(obj):
    for thing in (obj, *(obj.pose.bones if obj.pose else ())):
        for constraint in list(thing.constraints):
            thing.constraints.remove(constraint)


def _clear_drivers(block):
    for curve in list(block.animation_data.drivers if block.animation_data else ()):
        block.animation_data.drivers.remove(curve)


EXPRESSIONS = (
    'motus_solve(5,"snow",frame,depsgraph)',
    "motus_solve()",
    "motus_solve(self)",
    'motus_solve(self,"nothing",frame,depsgraph)',
    "motus_solve(self,3,frame,depsgraph)",
    'motus_solve(self,"path","x",depsgraph)',
    'motus_solve(self,"path",frame,depsgraph)',
    'motus_solve(self,"snow",frame,depsgraph,0,0,0,0,0,0)',
    "motus_points[5]",
    'motus_points[self,"pull"]',
)
"""What somebody may have written into a solver's driver."""


def _say_all(expressions):
    """Writes one of the expressions after the other into the drivers of hubs."""

    def act():
        curves = [curve for mesh in hub_meshes() for curve in (mesh.animation_data.drivers if mesh.animation_data else ())]
        for curve, expression in zip(curves, itertools.cycle(expressions)):
            curve.driver.expression = expression

    return act


def _move_drivers(mesh):
    mesh["other"] = [0.0]
    for curve in mesh.animation_data.drivers if mesh.animation_data else ():
        curve.data_path = '["other"]'


def _show_hub(hub):
    hub.hide_viewport = hub.hide_render = False
    bpy.context.scene.collection.objects.link(hub)


def _exchange_meshes():
    """The artist's meshes become the hubs', and the other way round."""
    shown = [obj for obj in bpy.context.scene.objects if obj.type == 'MESH']
    for hub, obj in zip(hubs(), shown):
        hub.data, obj.data = obj.data, hub.data


def _copy_drivers():
    """A hub's driver is pasted onto an artist's mesh, which is then somebody's geometry."""
    shown = [obj.data for obj in bpy.context.scene.objects if obj.type == 'MESH']
    for source, mesh in zip(hub_meshes(), shown):
        for curve in source.animation_data.drivers if source.animation_data else ():
            mesh["other"] = [0.0]
            copy = mesh.driver_add('["other"]', 0)
            call = curve.driver.expression.partition(",v")[0].rstrip(")]")
            copy.driver.use_self, copy.driver.expression = True, f"{call},{','.join('0' * 30)}{']' if '[' in call else ')'}"


def _on_each(operator, **keywords):
    """The operator acts on one object of the scene after the other."""

    def act():
        for obj in list(bpy.context.scene.objects):
            with contextlib.suppress(RuntimeError, ReferenceError, AttributeError):
                for other in bpy.context.selected_objects:
                    other.select_set(False)
                bpy.context.view_layer.objects.active = obj
                obj.select_set(True)
                operator(**keywords)

    return act


def _apply_modifiers():
    for obj in list(bpy.context.scene.objects):
        bpy.context.view_layer.objects.active = obj
        for modifier in list(obj.modifiers):
            with contextlib.suppress(RuntimeError):
                bpy.ops.object.modifier_apply(modifier=modifier.name)


def _join():
    for kind in ('MESH', 'ARMATURE'):
        found = [obj for obj in bpy.context.scene.objects if obj.type == kind]
        for obj in bpy.context.scene.objects:
            obj.select_set(obj in found)
        bpy.context.view_layer.objects.active = found[0]
        bpy.ops.object.join()


def _grow(mesh):
    mesh.vertices.add(5)
    mesh.update()


def _drop_attributes(mesh):
    for name in [one.name for one in mesh.attributes if one.name.startswith("motus")]:
        mesh.attributes.remove(mesh.attributes[name])


def _purge():
    for _ in range(3):
        bpy.ops.outliner.orphans_purge(do_recursive=True)


def _undo():
    with contextlib.suppress(RuntimeError):
        bpy.ops.ed.undo_push(message="before")
        _each(hub_meshes, bpy.data.meshes.remove)()
        bpy.ops.ed.undo_push(message="after")
        bpy.ops.ed.undo()
        bpy.ops.ed.redo()


ACTS = {
    "meshes of hubs removed": _each(hub_meshes, lambda one: bpy.data.meshes.remove(one)),
    "hubs removed": _each(hubs, lambda one: bpy.data.objects.remove(one)),
    "helpers removed": _each(helpers, lambda one: bpy.data.objects.remove(one)),
    "owners removed": _each(owners, lambda one: bpy.data.objects.remove(one)),
    "armatures and curves removed": lambda: (
        _each(lambda: list(bpy.data.armatures), lambda one: bpy.data.armatures.remove(one))(),
        _each(lambda: list(bpy.data.curves), lambda one: bpy.data.curves.remove(one))(),
    ),
    "node groups removed": _each(lambda: list(bpy.data.node_groups), lambda one: bpy.data.node_groups.remove(one)),
    "nodes removed": _each(lambda: list(bpy.data.node_groups), lambda one: one.nodes.clear()),
    "modifiers removed": _each(owners, lambda one: one.modifiers.clear()),
    "constraints removed": _each(lambda: list(bpy.data.objects), _clear_constraints),
    "drivers removed": _each(hub_meshes, _clear_drivers),
    "all drivers removed": _each(lambda: [*bpy.data.objects, *bpy.data.meshes], _clear_drivers),
    "animation removed": _each(hub_meshes, lambda one: one.animation_data_clear()),
    "drivers moved": _each(hub_meshes, _move_drivers),
    "drivers pasted": _copy_drivers,
    "all renamed": _each(lambda: [*bpy.data.objects, *bpy.data.meshes, *bpy.data.node_groups], lambda one: setattr(one, "name", "x")),
    "users cleared": _each(lambda: [*hub_meshes(), *helpers()], lambda one: one.user_clear()),
    "orphans purged": _purge,
    "helpers and meshes without users purged": lambda: (_each(hubs, lambda one: one.user_clear())(), _purge()),
    "single users": _each(hubs, lambda one: setattr(one, "data", one.data.copy())),
    "hubs remapped": _each(hubs, lambda one: one.user_remap(bpy.data.objects["Car"])),
    "hubs remapped to nothing": _each(hubs, lambda one: bpy.data.batch_remove([one])),
    "meshes remapped": _each(hub_meshes, lambda one: one.user_remap(hub_meshes()[0])),
    "owners remapped": _each(owners, lambda one: one.user_remap(bpy.data.objects["Target"])),
    "meshes emptied": _each(hub_meshes, lambda one: one.vertices and one.clear_geometry() if not one.animation_data else None),
    "meshes grown": _each(hub_meshes, _grow),
    "attributes removed": _each(hub_meshes, _drop_attributes),
    "hubs shown": _each(hubs, _show_hub),
    "parents cleared": _each(owners, lambda one: setattr(one, "parent", None)),
    "unlinked": _each(owners, lambda one: [collection.objects.unlink(one) for collection in one.users_collection]),
    "meshes exchanged": _exchange_meshes,
    "converted": _on_each(bpy.ops.object.convert, target='MESH'),
    "joined": _join,
    "modifiers applied": _apply_modifiers,
    "visual transforms applied": _on_each(bpy.ops.object.visual_transform_apply),
    "made local": _on_each(bpy.ops.object.make_local, type='ALL'),
    "made single user": _on_each(bpy.ops.object.make_single_user, type='ALL', object=True, obdata=True, material=True, animation=True),
    "duplicated": _on_each(bpy.ops.object.duplicate),
    "deleted": _on_each(bpy.ops.object.delete),
    "undone": _undo,
    "drivers changed": _say_all(EXPRESSIONS),
    "drivers changed again": _say_all(EXPRESSIONS[::-1]),
}
"""Everything else: name -> what is done."""


def go_on(name):
    """Change the relations among objects, and go to other frames."""
    bpy.context.scene.collection.objects.link(bpy.data.objects.new(name, None))
    bpy.context.view_layer.update()
    bpy.context.scene.frame_set(FRAME)
    for block in (*bpy.data.meshes, *bpy.data.objects):
        block.update_tag()
    bpy.context.view_layer.update()


class _Listener(logging.Handler):
    def emit(self, record):
        raised = traceback.format_exception(*record.exc_info)[-4:] if record.exc_info else ""
        print("LOGGED", record.getMessage(), *raised, flush=True)


def run(scene, folder, keys):
    """Do everything, each in the scene with all systems. Says ACT before each act, and ALIVE at the end.

    scene: the file that live_scenes.saved() has written. keys: whether to custom properties.
    """
    logging.getLogger().addHandler(_Listener())
    bpy.ops.wm.open_mainfile(filepath=scene)
    bpy.context.scene.frame_set(13)
    path, spoilt = (str(Path(folder, name)) for name in ("live.blend", "spoilt.blend"))
    bpy.ops.wm.save_as_mainfile(filepath=path)
    acts = {f"custom properties {turn}": functools.partial(spoil_keys, turn) for turn in range(len(OF_KEYS))} if keys else ACTS
    for name, act in acts.items():
        bpy.ops.wm.open_mainfile(filepath=path)
        bpy.context.view_layer.update()
        print("ACT", name, flush=True)
        act()
        go_on(name)
        if not keys:
            bpy.ops.wm.save_as_mainfile(filepath=spoilt, copy=True)
            bpy.ops.wm.open_mainfile(filepath=spoilt)
            bpy.context.view_layer.update()
    print("ALIVE", flush=True)
