"""Properties of all kinds that are driven, as one small scene to test."""

import bpy

import support
import toy_dial_system
import toy_system
from core.wiring.wiring_cases import WiringTestCase, frame_set

wiring = support.addon("core.wiring")
property_sink = support.addon("core.wiring.sinks.property_sink")
SYSTEM = toy_dial_system.SYSTEM
FRAMES = (10, 3, 55, 1.5, 54)
SOCKET = 'active_material.node_tree.nodes["Mix"].inputs[1].default_value'
OWN = (
    ('["custom"]', -1),
    ('modifiers["Push"].strength', -1),
    ("color", 1),
    ("active_material.metallic", -1),
    (SOCKET, 2),
    ('data.shape_keys.key_blocks["Key"].value', -1),
    ('data["numbers"]', 1),
    ("location", 2),
)


def build():
    """A mesh object whose properties are driven, every other one keyed, and the shift of a camera."""
    mesh = bpy.data.meshes.new("Mesh")
    mesh.from_pydata([(0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (0.0, 1.0, 0.0)], [], [(0, 1, 2)])
    mesh["numbers"] = [0.25, 0.5, 0.75]
    owner = toy_system.new_object("Owner", data=mesh)
    owner["custom"] = 0.1234567890123
    owner.modifiers.new("Push", 'DISPLACE').strength = 0.3
    for name in ("Basis", "Key"):
        owner.shape_key_add(name=name)
    material = bpy.data.materials.new("Material")
    material.use_nodes = True
    mesh.materials.append(material)
    material.node_tree.nodes.new("ShaderNodeMixRGB").name = "Mix"
    camera = toy_system.new_object("Camera", data=bpy.data.cameras.new("Camera"))
    entries = [(None, *one) for one in OWN] + [(camera, "data.shift_x", -1)]
    for order, (thing, path, index) in enumerate(entries):
        if order % 2 == 0:
            key(thing or owner, path, index, 1, 0.2)
            key(thing or owner, path, index, 60, 0.9)
    toy_dial_system.dial(owner, toy_system.new_target(), *entries)
    return owner


def key(obj, path, index, frame, value):
    """One key of a property."""
    found = property_sink.property_place(obj, path, index)
    found.number.write(value)
    found.id_data.keyframe_insert(found.data_path, index=index, frame=frame)


def places(owner, evaluated=False):
    """Where the properties of the entries lie, on the originals or on the evaluated copies."""
    graph = bpy.context.evaluated_depsgraph_get()
    things = [(entry.thing or owner, entry) for entry in owner.motus.dial.entries]
    return [
        property_sink.property_place(thing.evaluated_get(graph) if evaluated else thing, entry.path, entry.index) for thing, entry in things
    ]


def values(owner):
    """The evaluated values of the properties."""
    return [one.number.present for one in places(owner, evaluated=True)]


def state(owner):
    """All that removal has to bring back: values, keys and drivers of what the properties lie on."""
    return [
        (
            one.number.present,
            one.id_data.animation_data
            and (one.id_data.animation_data.action and one.id_data.animation_data.action.name, len(one.id_data.animation_data.drivers)),
            sorted(one.id_data.keys()),
        )
        for one in places(owner)
    ]


def shown(owner):
    """What the dials are to show at the present frame."""
    graph = bpy.context.evaluated_depsgraph_get()
    target = owner.motus.dial.target.evaluated_get(graph).matrix_world
    return [toy_dial_system.shown(target, order) for order, _ in enumerate(owner.motus.dial.entries)]


class PropertyTestCase(WiringTestCase):
    """Tests with the system registered."""

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        support.register_systems(SYSTEM)
        cls.addClassCleanup(support.unregister_systems, SYSTEM)

    def assert_shown(self, owner, frames=FRAMES):
        """All properties are what the system says."""
        for frame in frames:
            frame_set(frame)
            with self.subTest(frame=frame):
                self.assert_close(values(owner), shown(owner), 1e-6)

    @staticmethod
    def problem(owner):
        return wiring.problem(SYSTEM, owner, bpy.context.evaluated_depsgraph_get())

    def own_values(self, owner):
        """What the properties are without the system, at all frames."""
        wiring.detach(SYSTEM, owner)
        found = {}
        for frame in FRAMES:
            frame_set(frame)
            found[frame] = values(owner)
        wiring.attach(SYSTEM, owner)
        return found
