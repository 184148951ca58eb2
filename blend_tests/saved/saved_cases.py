"""What saved files give: where everything is on some frames, what the artist has set, and what is wired."""

import json
from pathlib import Path

import bpy
import numpy as np

import support
from snow import snow_cases

HERE = Path(__file__).resolve().parent
ARCHIVE = "files.tar.xz"
FRAMES = (37, 5, 100, 22.25)
"""In an order that no playback has, and with a sub-frame."""
AFTER_REMOVAL = 37

REMOVALS = {
    "path": [("path_follow_remove", {"object": name}) for name in ("Eased", "Speeding", "Stopping", "Keyed", "Leaning")],
    "train": [("path_follow_remove", {"object": name}) for name in ("Engine", *(f"Follower {index}" for index in range(4)))],
    "ik": [("ik_remove", {"object": "Rig"})],
    "look_at": [("look_at_remove", {"object": "Figure"})],
    "layers": [("layer_remove", {"object": "Puppet", "layer": name}) for name in ("Wave", "More")],
    "dynamics": [("dynamics_remove", {"object": name}) for name in ("Parcel", "Ribbon", "Rope", "Turning")]
    + [("dynamics_remove", {"object": "Balloon", "data_path": "scale"})],
    "pull": [("pin_remove", {"object": "Grid", "all": True})],
    "lattice": [("lattice_remove", {"objects": "Ball"})],
    "pendulum": [("pendulum_remove", {"object": name}) for name in ("Hook", "Crane", "Pendulum")],
    "drivers": [("driver_remove", {"datablock": name}) for name in ("Pendulum", "Double_Pendulum", "Ease", "Noise", "Sprung", "Dial")],
    "snow": [("snow_remove", {"object": name}) for name in ("Snow", "Snow.001")],
    "snow_cover": [("snow_cover_remove", {"object": "Snow Cover"}), ("snow_remove", {"object": "Snow"})],
    "stereo": [("stereo_rig_remove", {"object": name}) for name in ("Eyes", "Looking")],
    "chroma": [("chroma_key_remove", {})],
    "walker": [("walker_remove", {"object": "Spider"}), ("ik_remove", {"object": "Spider"}), ("walker_remove", {"object": "Robot"})],
    "together": [(f"{name}_remove", {"object": "Puppet"}) for name in ("dynamics", "ik", "look_at", "path_follow")]
    + [("layer_remove", {"object": "Puppet", "layer": name}) for name in ("Wave", "More")],
    "baked": [
        ("unbake", {"object": "Car"}),
        ("path_follow_remove", {"object": "Car"}),
        ("unbake", {"object": "Arm"}),
        ("ik_remove", {"object": "Arm"}),
    ],
}
"""What takes the system off a file again: operators with their keywords."""

OF_THE_WIRING = {"is_active", "is_released", "hub", "row", "more_hubs", "targets", "wired", "order_proxy", "leader"}
"""Settings that artists do not see: another version may wire otherwise."""


def own_version():
    """Such as "5.2"."""
    return ".".join(map(str, bpy.app.version[:2]))


def open_file(path):
    bpy.ops.wm.open_mainfile(filepath=str(path), load_ui=False)


def whole(name):
    """All that is kept of a file that was just opened, in the order of looking; nothing of the systems is left in it then."""
    found = {"made by": f"Blender {bpy.app.version_string}", "contents": contents(), "settings": settings()}
    found["frames"] = {f"{frame:g}": numbers(frame) for frame in FRAMES}
    remove(name)
    found["removed"] = {"contents": contents(), "numbers": numbers(AFTER_REMOVAL)}
    return found


def remove(name):
    for operator, keywords in REMOVALS[name]:
        if getattr(bpy.ops.motus, operator)(**keywords) != {'FINISHED'}:
            raise RuntimeError(operator)
    bpy.context.view_layer.update()


# --- Numbers ------------------------------------------------------------------------------------------------------------


def numbers(frame):
    """{what: numbers} of a frame: world matrices row by row, meshes and instances in short, values that drivers and nodes have."""
    support.go_to(frame)
    depsgraph = bpy.context.evaluated_depsgraph_get()
    found = {}
    for obj in bpy.context.view_layer.objects:
        evaluated = obj.evaluated_get(depsgraph)
        found[obj.name] = rows(evaluated.matrix_world)
        for bone in evaluated.pose.bones if evaluated.pose else ():
            found[f"{obj.name} bone {bone.name}"] = rows(evaluated.matrix_world @ bone.matrix)
        found |= {f"{obj.name} {what}": values for what, values in _of_data(obj, evaluated)}
        found |= {
            f"{obj.name}[{key}]": [evaluated[key]] for key in obj.keys() if isinstance(obj[key], float) and not key.startswith("motus")
        }
    found |= _instances(depsgraph)
    found |= _nodes()
    return {what: [float(number) for number in values] for what, values in sorted(found.items())}


def rows(matrix):
    """12 numbers of a matrix."""
    return np.array(matrix)[:3].ravel()


def _of_data(obj, evaluated):
    """(what, numbers) of an object's data."""
    if obj.type == 'MESH':
        yield "vertices", in_short(_positions(evaluated.data.vertices, "co"))
        if obj.is_property_set("motus") and obj.motus.is_property_set("snow"):
            flakes = snow_cases.flakes(obj)
            yield from ((f"flakes' {what}", in_short(array.reshape(len(array), -1))) for what, array in flakes.items())
    elif obj.type == 'LATTICE':
        yield "points", in_short(_positions(evaluated.data.points, "co_deform"))
    elif obj.type == 'CAMERA':
        data = evaluated.data
        yield "lens", (data.lens, data.shift_x, data.shift_y, data.stereo.interocular_distance, data.stereo.convergence_distance)


def _positions(items, name):
    found = np.empty(3 * len(items), np.float32)
    items.foreach_get(name, found)
    return found.reshape(-1, 3)


def in_short(array):
    """How many rows there are, their mean and spread, and the first, a middle and the last one."""
    if len(array) == 0:
        return [0.0]
    array = array.astype(float)
    return np.concatenate(([len(array)], array.mean(axis=0), array.std(axis=0), array[0], array[len(array) // 2], array[-1]))


def _instances(depsgraph):
    """Of what instances there are: {"instances of an emitter": their matrices in short}."""
    found = {}
    for one in depsgraph.object_instances:
        if one.is_instance:
            found.setdefault(f"{one.parent.name} instances", []).append(rows(one.matrix_world))
    return {name: in_short(np.array(matrices)) for name, matrices in found.items()}


def _nodes():
    """{"node, socket": numbers} of what the scene's compositor is given."""
    tree = support.addon("chroma.compositor").tree_of(bpy.context.scene)
    found = {}
    for node in tree.nodes if tree and bpy.context.scene.motus.is_property_set("chroma") else ():
        for index, socket in enumerate(node.inputs if node.type == 'GROUP' else ()):
            value = getattr(socket, "default_value", "")
            if not isinstance(value, str):
                found[f"{node.name} input {index} {socket.name}"] = np.ravel(value)
    return found


# --- Settings, and what is wired -------------------------------------------------------------------------------------------


def settings():
    """{name of the owner: what was set in its settings}."""
    owners = [bpy.context.scene, *bpy.context.view_layer.objects]
    return {owner.name: _of_group(owner.motus) for owner in owners if owner.is_property_set("motus")}


def _of_group(group):
    """{name: value} of the settings that were set."""
    names = [prop.identifier for prop in group.bl_rna.properties if prop.identifier not in OF_THE_WIRING | {"rna_type"}]
    return {name: value for name in sorted(names) if group.is_property_set(name) and (value := value_of(group, name)) not in ({}, [])}


def value_of(group, name):
    """A setting as JSON has it: groups and lists with all that was set in them, datablocks by their names."""
    prop, value = group.bl_rna.properties[name], getattr(group, name)
    if prop.type == 'COLLECTION':
        return [_of_group(item) for item in value]
    if prop.type == 'POINTER':
        return _of_group(value) if isinstance(value, bpy.types.PropertyGroup) else value and value.name
    if isinstance(value, set):
        return sorted(value)
    if prop.type == 'FLOAT':
        return [round(float(number), 6) for number in value] if prop.is_array else round(value, 6)
    return list(value) if getattr(prop, "is_array", False) else value


def contents():
    """What there is in the file, by names: objects, their drivers, constraints and modifiers, and the kinds of data that systems make."""
    found = {"objects": {obj.name: _hangs_on(obj) for obj in bpy.data.objects}}
    for kind in ("meshes", "node_groups", "actions", "collections"):
        found[kind] = sorted(block.name for block in getattr(bpy.data, kind))
    return found


def _hangs_on(obj):
    animated = [obj, *([obj.data] if obj.data else [])]
    bones = obj.pose.bones if obj.pose else ()
    drivers = [
        f"{curve.data_path} {curve.array_index}: {curve.driver.expression}"
        for block in animated
        if block.animation_data
        for curve in block.animation_data.drivers
    ]
    constraints = [f"{getattr(owner, 'name', '')}: {one.type} {one.name}" for owner in (obj, *bones) for one in owner.constraints]
    found = {"drivers": sorted(drivers), "constraints": constraints, "modifiers": [f"{one.type} {one.name}" for one in obj.modifiers]}
    return {kind: names for kind, names in found.items() if names}


# --- Files of numbers -------------------------------------------------------------------------------------------------------


def write(path, found):
    """As JSON, sorted, a line for each row of numbers."""
    path.write_text(f"{_text(found)}\n", encoding="utf-8")


def _text(value, indent=""):
    if isinstance(value, dict) and value:
        inner = indent + " "
        lines = [f"{inner}{json.dumps(name)}: {_text(value[name], inner)}" for name in sorted(value)]
        return "{\n" + ",\n".join(lines) + f"\n{indent}}}"
    return json.dumps(
        [round(one, 7) if isinstance(one, float) else one for one in value] if isinstance(value, list) else value, sort_keys=True
    )
