"""Live set-ups of every system, and ways in which whoever had a file may have changed what Motus keeps in it."""

import contextlib
import json
import logging
import math
import random
import traceback
from collections.abc import Callable
from typing import NamedTuple
from unittest import mock

import bmesh
import bpy
import numpy as np

import support
from look_at import look_at_cases
from support import link
from walker import walker_cases

FRAMES = (3.0, 20.5)
OUTBOX, INFO = "motus_{}_out", "motus_{}_info"
OWNER, MEMBER_DATA, STILL, COPY = "motus_owner", "motus_member_data", "motus_still", "motus_copy"


class Case(NamedTuple):
    """A set-up. build(): makes it and returns its owner. refresh, remove: operators that are given the owner's name."""

    system: str
    build: Callable
    refresh: Callable
    remove: Callable


# --- Set-ups -----------------------------------------------------------------------------------------------------


def _course():
    data = bpy.data.curves.new("Course", 'CURVE')
    data.dimensions = '3D'
    spline = data.splines.new('BEZIER')
    spline.bezier_points.add(1)
    for point, knot in zip(spline.bezier_points, ((0, 0, 0), (6, 6, 2))):
        point.co, point.handle_left, point.handle_right = knot, (knot[0] - 2, knot[1], 0), (knot[0] + 2, knot[1], 1)
    return link("Course", data)


def follower():
    _course()
    owner = link("Owner", None, (1.0, 2.0, 3.0))
    bpy.ops.motus.path_follow_add(object="Owner", curve="Course", duration=4.0)
    return owner


def train():
    _course()
    names = ["Owner", *(f"Wagon {index}" for index in range(4))]
    for index, name in enumerate(names):
        link(name, None, (index, -1.0, 0.5))
    bpy.ops.motus.path_train_add(objects=",".join(names), curve="Course", gap=0.3, duration=4.0)
    return bpy.data.objects["Owner"]


def _snake(count):
    rig = link("Owner", bpy.data.armatures.new("Owner"), (0.3, 0.2, 0.1))
    bpy.context.view_layer.objects.active = rig
    bpy.ops.object.mode_set(mode='EDIT')
    parent = None
    for index in range(count):
        bone = rig.data.edit_bones.new(f"Bone {index}")
        bone.head, bone.tail = (index, 0.02 * index**2, 0.0), (index + 1, 0.02 * (index + 1) ** 2, 0.0)
        bone.parent, parent = parent, bone
    side = rig.data.edit_bones.new("Side")
    side.head, side.tail, side.parent = (1.0, 0.0, 0.0), (1.0, 0.0, 0.5), rig.data.edit_bones["Bone 1"]
    bpy.ops.object.mode_set(mode='OBJECT')
    return rig


def chain(count=4, stretch=0.5):
    """With scales and a bone that is kept from the stretch."""
    rig = _snake(count)
    link("Target", None, (0.7 * count, 1.0, 1.5))
    bpy.ops.motus.ik_add(object="Owner", bone=f"Bone {count - 1}", target="Target", chain_length=count - 1)
    rig.motus.ik.entries[0].stretch = stretch
    return rig


def long_chain():
    return chain(30)


def driven_chain():
    """With a driven setting."""
    rig = chain()
    rig.motus.ik.entries[0].driver_add("position_weight").driver.expression = "0.5 + 0.01 * frame"
    bpy.context.view_layer.update()
    bpy.context.scene.frame_set(2)
    assert rig.motus.ik.hub
    return rig


def head():
    rig = look_at_cases.build_rig(name="Owner")
    link("Target", None, (2.0, -3.0, 2.0))
    bpy.ops.motus.look_at_add(object="Owner", bone="Head", target="Target")
    return rig


def pinned():
    bpy.ops.mesh.primitive_grid_add(x_subdivisions=8, y_subdivisions=8)
    owner = bpy.context.object
    owner.name = "Owner"
    bpy.ops.motus.pin_add(object="Owner", vertex=40, displacement=(0.0, 0.1, 1.0), radius=0.8)
    return owner


def walker():
    owner, shell, feet = walker_cases.cross("Robot")
    owner.name = "Owner"
    bpy.ops.motus.walker_add(object="Owner", feet=walker_cases.names(feet), body=shell.name, gait='TROT')
    for frame, place in ((1, 0.0), (40, 1.0)):
        owner.location.y = place
        owner.keyframe_insert("location", frame=frame)
    bpy.context.view_layer.update()
    return owner


def _operators(system):
    motus = bpy.ops.motus
    return {
        "path": (motus.refresh, lambda object: motus.path_follow_remove(object=object)),
        "ik": (motus.refresh, lambda object: motus.ik_remove(object=object)),
        "look_at": (motus.refresh, lambda object: motus.look_at_remove(object=object, bone="Head")),
        "walker": (motus.refresh, lambda object: motus.walker_remove(object=object)),
        "pull": (motus.pin_restore, lambda object: motus.pin_remove(object=object, all=True)),
    }[system]


CASES = [
    Case(system, build, *_operators(system))
    for system, build in (
        ("path", follower),
        ("path", train),
        ("ik", chain),
        ("ik", long_chain),
        ("ik", driven_chain),
        ("look_at", head),
        ("pull", pinned),
        ("walker", walker),
    )
]


# --- What is seen of them ----------------------------------------------------------------------------------------


def evaluated():
    """Numbers that say where everything stands at FRAMES, but hidden helpers."""
    found = []
    for frame in FRAMES:
        support.go_to(frame)
        depsgraph = bpy.context.evaluated_depsgraph_get()
        for obj in sorted(bpy.context.scene.collection.all_objects, key=lambda one: one.name_full):
            found.append(_numbers(obj.evaluated_get(depsgraph)))
    return found


def _numbers(obj):
    parts = [np.array(obj.matrix_world).ravel()]
    parts += [np.array(bone.matrix).ravel() for bone in (obj.pose.bones if obj.pose else ())]
    if obj.type == 'MESH':
        places = np.empty(3 * len(obj.data.vertices), np.float32)
        obj.data.vertices.foreach_get("co", places)
        parts.append(places)
    return np.concatenate(parts)


def are_same(some, others, tolerance=1e-5):
    return all(one.shape == other.shape and np.allclose(one, other, atol=tolerance) for one, other in zip(some, others))


def problem(case, owner):
    """What the panel says of an owner; None where it says nothing."""
    return support.addon("core.wiring").problem(
        support.addon("core.declare").registered[case.system], owner, bpy.context.evaluated_depsgraph_get()
    )


def drawn(case, owner):
    """All that the panel writes."""
    bpy.context.view_layer.objects.active = owner
    layout = _Layout()
    draw = support.addon("pull.pins.panel").draw_list if case.system == "pull" else support.addon(f"{case.system}.panel").draw_main
    draw(layout, bpy.context)
    return " ".join(layout.texts)


class _Layout:
    """Stands for any part of a layout, or what an operator's button is given."""

    def __init__(self):
        self.texts = []

    def label(self, text="", **_options):
        self.texts.append(text)

    def __getattr__(self, _name):
        return lambda *_arguments, **_options: self


@contextlib.contextmanager
def raised():
    """A list of what driver functions raise and what is logged as an error within."""
    found, functions = [], support.addon("core.wiring.solving.namespace")._FUNCTIONS

    def watched(function):
        def call(*arguments):
            try:
                return function(*arguments)
            except BaseException as error:
                found.append(repr(error))
                raise

        return call

    class Points:
        """What is called by a subscript."""

        def __getitem__(self, arguments):
            return watched(functions_as_they_were["motus_points"].__getitem__)(arguments)

    class Handler(logging.Handler):
        def emit(self, record):
            found.append(f"{record.getMessage()}: {record.exc_info and traceback.format_exception(*record.exc_info)[-3:]}")

    functions_as_they_were = dict(functions)
    wrapped = {name: Points() if name == "motus_points" else watched(function) for name, function in functions.items()}
    handler = Handler(logging.ERROR)
    logging.getLogger().addHandler(handler)
    with mock.patch.dict(functions, wrapped):
        bpy.app.driver_namespace.update(wrapped)
        try:
            yield found
        finally:
            logging.getLogger().removeHandler(handler)
            bpy.app.driver_namespace.update(functions_as_they_were)


# --- Damage ------------------------------------------------------------------------------------------------------


class Damage(NamedTuple):
    """One way to spoil what is stored. act(owner): does it. is_outside: an array is other than what would be written to it."""

    name: str
    act: Callable
    is_outside: bool = False


def carrier_of(case, owner):
    """What carries the first solver: the owner or its hub's mesh."""
    hub = getattr(owner.motus, case.system).hub
    return hub.data if hub else owner


def damages(case, owner):
    """Everything that is done to a set-up as it is wired now, in an order that is the same each time."""
    random_numbers = random.Random(f"{case.system} {case.build.__name__}")
    carrier = carrier_of(case, owner)
    found = [*_of_values(case, carrier, random_numbers), *_of_info(case, carrier, random_numbers)]
    if carrier != owner:
        found += [*_of_attributes(case, carrier), *_of_hub(case)]
    return found


def _of_values(case, carrier, random_numbers):
    """Other values of every custom property."""
    names = [name for name in carrier.keys() if name.startswith("motus_")]
    for name in names:
        size = len(carrier[name]) if hasattr(carrier[name], "typecode") else 4
        for value in _values(size, random_numbers):
            if name == MEMBER_DATA and _is_like(value, carrier[name]):
                continue  # other gaps, which nobody could tell from the right ones
            yield Damage(f"{name} = {_short(value)}", _putting(case, name, value))
        for kind in ("materials", "texts", "meshes", "objects"):
            yield Damage(f"{name} -> {kind}", _putting(case, name, kind, is_pointer=True))
        yield Damage(f"{name} removed", lambda owner, name=name: carrier_of(case, owner).pop(name, None))


def _is_like(value, stored):
    return isinstance(value, list) and len(value) == len(stored) and all(isinstance(one, float) and math.isfinite(one) for one in value)


def _values(size, random_numbers):
    yield from (5, -2.5, True, "hello", b"\x00\xff\x00", "", {"digest": "zz"}, {"a": {"b": [1.0, 2.0]}}, [{"a": 1}, {"b": 2}])
    for length in (0, 1, size - 1, size, size + 1, 6 * size, 10000):
        yield random_numbers.choices(range(-9, 2**31 - 1), k=length)
        yield [random_numbers.uniform(-1e3, 1e3) for _ in range(length)]
    yield [math.nan] * size
    yield [math.inf, -math.inf, 1e308] * size


def _putting(case, name, value, is_pointer=False):
    def act(owner):
        carrier = carrier_of(case, owner)
        carrier.pop(name, None)
        carrier[name] = _other(value) if is_pointer else value

    return act


def _other(kind):
    """A datablock of another kind than is meant, or an object that has nothing to do with it."""
    blocks = getattr(bpy.data, kind)
    if kind == "objects":
        return blocks.get("Stranger") or blocks.new("Stranger", None)
    return blocks.get("Stranger") or blocks.new("Stranger")


OTHER_FIELDS = [json.dumps(other) for other in (None, 5, "x", [], {}, [["a"]], [1e300], ["x"] * 3, ["x"] * 100000)]
"""What may stand in place of a field of the text beside an outbox, as JSON."""


def _of_info(case, carrier, random_numbers):
    """Other texts beside the outbox."""
    name = INFO.format(case.system)
    if name not in carrier:
        return
    text = carrier[name]["text"]
    deep = 100000
    texts = {
        "empty": "",
        "null": "null",
        "number": "5",
        "list": "[]",
        "short": "[[], []]",
        "deep list": "[" * deep,
        "deep object": '{"a":' * deep,
        "deep and whole": "[" * deep + "]" * deep,
        "escapes": '"' + '\\"' * deep,
        "cut": text[: len(text) // 2],
        "huge number": text.replace("false", "9" * 5000, 1),
        "not finite": _with(text, math.nan),
        "infinite": _with(text, math.inf),
        "no text": 7,
    }
    for index in range(8):
        place = random_numbers.randrange(len(text))
        texts[f"letter {index}"] = text[:place] + random_numbers.choice('"[]{}09,:\\') + text[place + 1 :]
    said = json.loads(text)
    fields = [json.dumps(one) for one in said]
    for place, one in enumerate(said):
        for index, other in enumerate((*OTHER_FIELDS, json.dumps(not one))):
            texts[f"field {place}.{index}"] = f"[{', '.join([*fields[:place], other, *fields[place + 1 :]])}]"
    texts |= {
        f"plan {index}": json.dumps([*said[:5], {**said[5], "plan": plan}, *said[6:]])
        for index, plan in enumerate(_plans(said[5].get("plan"), random_numbers))
    }
    for label, other in texts.items():
        yield Damage(f"info {label}", _putting_text(case, {"text": other, "version": 1}))
    for label, version in (("newer", 99), ("of no version", "x"), ("of an older one", 0)):
        yield Damage(f"info {label}", _putting_text(case, {"text": text + " ", "version": version}))
    yield Damage("info newer and other", _putting_text(case, {"text": "something else", "version": 2, "more": [1, 2]}))


def _with(text, number):
    return json.dumps([*json.loads(text)[:5], {"a": [number]}, []])


def _plans(plan, random_numbers):
    """Other plans of a group of bones."""
    if plan is None:
        return
    yield from (5, "", "5", "[" * 100000, "{}", '{"chains": [], "heads": [], "guards": [], "fingerprint": 1}')
    known = json.loads(plan)
    entries = _entries_of(known)
    for name, value in entries[0].items():
        for other in (
            None,
            -5,
            1e300,
            math.nan,
            "nobody",
            [],
            ["nobody"],
            [1, 2],
            {"iterations": 1e300},
            {"nobody": 1.0},
            [value] * 3,
            *([value[:-1], value * 40] if isinstance(value, list) else [2**40]),
        ):
            yield json.dumps(_changed(plan, lambda entry, name=name, other=other: entry.__setitem__(name, other)))
        yield json.dumps(_changed(plan, lambda entry, name=name: entry.pop(name)))
    for guards in (5, [5], [[1, 2, 3]], [["Side", 99]], [["Side", -1]], [["nobody", 0]], [["Side", 0]] * 50):
        yield json.dumps({**known, "guards": guards})
    yield json.dumps({**known, "chains": entries * 3, "heads": entries * 3})
    yield json.dumps({**known, "fingerprint": random_numbers.randrange(2**31)})


def _changed(plan, change):
    known = json.loads(plan)
    change(_entries_of(known)[0])
    return known


def _entries_of(known):
    return known.get("chains") or known.get("heads") or known["feet"]


def _putting_text(case, value):
    def act(owner):
        carrier_of(case, owner)[INFO.format(case.system)] = value

    return act


def _of_attributes(case, mesh):
    """Other attributes and other points of a hub's mesh."""
    for name in [one.name for one in mesh.attributes if one.name.startswith("motus_")]:
        for data_type, domain in (
            ('FLOAT', 'POINT'),
            ('FLOAT_COLOR', 'POINT'),
            ('FLOAT_VECTOR', 'FACE'),
            ('FLOAT_VECTOR', 'CORNER'),
            ('FLOAT_VECTOR', 'EDGE'),
            ('INT', 'POINT'),
            ('FLOAT4X4', 'FACE'),
            ('FLOAT4X4', 'EDGE'),
        ):
            if data_type in {one.identifier for one in bpy.types.Attribute.bl_rna.properties["data_type"].enum_items}:
                yield Damage(f"{name} as {data_type} of {domain}", _replacing(case, name, data_type, domain), True)
        yield Damage(f"{name} removed", lambda owner, name=name: _drop(carrier_of(case, owner), name))
    for count in (0, 1, 2, 1000):
        yield Damage(f"{count} points", lambda owner, count=count: _resize(carrier_of(case, owner), count), True)


def _drop(mesh, name):
    mesh.attributes.remove(mesh.attributes[name])


def _replacing(case, name, data_type, domain):
    def act(owner):
        mesh = carrier_of(case, owner)
        _drop(mesh, name)
        _add_face(mesh)
        mesh.attributes.new(name, data_type, domain)

    return act


def _add_face(mesh):
    made = bmesh.new()
    made.from_mesh(mesh)
    made.faces.new([made.verts.new((index, index * index, 0.0)) for index in range(3)])
    made.to_mesh(mesh)
    made.free()


def _resize(mesh, count):
    made = bmesh.new()
    made.from_mesh(mesh)
    made.verts.ensure_lookup_table()
    bmesh.ops.delete(made, geom=made.verts[count:], context='VERTS')
    while len(made.verts) < count:
        made.verts.new()
    made.to_mesh(mesh)
    made.free()


def _of_hub(case):
    """Other objects in place of the hub."""

    def setting(make):
        def act(owner):
            getattr(owner.motus, case.system).hub = make()

        return act

    yield Damage("no hub", setting(lambda: None))
    yield Damage("hub is an empty", setting(lambda: _other("objects")))
    yield Damage("hub is a stranger's mesh", setting(lambda: bpy.data.objects.new("Cube", bpy.data.meshes.new("Cube"))))
    yield Damage("hub has another mesh", lambda owner: setattr(getattr(owner.motus, case.system).hub, "data", bpy.data.meshes.new("Other")))
    yield Damage("hub waits otherwise", _wait_otherwise(case))


def _wait_otherwise(case):
    def act(owner):
        hub = getattr(owner.motus, case.system).hub
        for kind in ('LIMIT_LOCATION', 'ARMATURE', 'IK', 'CHILD_OF'):
            with contextlib.suppress(TypeError, RuntimeError):
                hub.constraints.new(kind).mute = True

    return act


def _short(value):
    text = repr(value[:30] if isinstance(value, list) else value)
    return text if len(text) < 30 else f"{text[:30]}... of {len(value)}"
