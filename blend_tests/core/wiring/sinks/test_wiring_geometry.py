"""Systems that wait for the final geometry of other objects."""

import bpy

import support
import toy_rest_system
import toy_system
from core.wiring.wiring_cases import WiringTestCase, frame_set

wiring = support.addon("core.wiring")
SYSTEM = toy_rest_system.SYSTEM
FRAMES = (10, 3, 55, 1.5, 54)


def new_ground(name="Ground", height=0.0):
    """A mesh whose first point a hook lifts, to where a moving empty is, and another modifier lifts all."""
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata([(0.0, 0.0, height), (1.0, 0.0, height), (0.0, 1.0, height)], [], [(0, 1, 2)])
    ground = toy_system.new_object(name, (0.3, 0.2, 0.1), mesh)
    handle = toy_system.new_object(f"{name} Handle")
    curve = handle.driver_add("location", 2)
    curve.driver.expression = "1.0 + 0.1*frame"
    hook = ground.modifiers.new("Hook", 'HOOK')
    hook.object = handle
    hook.vertex_indices_set([0])
    lift = ground.modifiers.new("Lift", 'DISPLACE')
    lift.direction, lift.strength, lift.mid_level = 'Z', 0.5, 0.0
    return ground


def build():
    """What rests on a ground."""
    owner = toy_system.new_object("Owner", (7.0, 8.0, 9.0))
    toy_rest_system.rest(owner, new_ground())
    return owner


class GeometryTest(WiringTestCase):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        support.register_systems(SYSTEM)
        cls.addClassCleanup(support.unregister_systems, SYSTEM)

    def assert_rests(self, owner, frames=FRAMES):
        found = []
        for frame in frames:
            frame_set(frame)
            self.assert_rests_now(owner)
            found.append(toy_system.world_matrix(owner))
        return found

    def assert_rests_now(self, owner):
        graph = bpy.context.evaluated_depsgraph_get()
        grounds = [one.evaluated_get(graph) for one in (owner.motus.rest.ground, owner.motus.rest.other) if one]
        self.assert_close(toy_system.world_matrix(owner).translation, toy_rest_system.highest(*grounds))

    def test_frames_in_any_order(self):
        owner = build()
        found = self.assert_rests(owner)
        self.assertEqual(self.assert_rests(owner, FRAMES[::-1])[::-1], found)
        self.assertGreater((found[2].translation - found[1].translation).length, 1.0)

    def test_edits_of_the_geometry(self):
        owner = build()
        frame_set(2)
        ground = owner.motus.rest.ground
        for edit in (
            lambda: setattr(ground.modifiers["Lift"], "strength", 3.0),
            lambda: setattr(bpy.data.objects["Ground Handle"].location, "x", -4.0),
            lambda: setattr(ground.location, "z", 5.0),
            lambda: (setattr(ground.data.vertices[1].co, "x", 2.0), ground.data.update()),
            lambda: ground.modifiers.remove(ground.modifiers["Lift"]),
        ):
            calls, before = toy_rest_system.solve_calls, toy_system.world_matrix(owner)
            edit()
            bpy.context.view_layer.update()
            self.assertGreater(toy_rest_system.solve_calls, calls)
            self.assertNotEqual(toy_system.world_matrix(owner), before)
            self.assert_rests_now(owner)

    def test_two_grounds(self):
        owner = build()
        owner.motus.rest.other = new_ground("Other", 2.0)
        self.assert_rests(owner)
        owner.motus.rest.ground = None
        frame_set(1)
        graph = bpy.context.evaluated_depsgraph_get()
        self.assertIs(wiring.problem(SYSTEM, owner, graph), toy_rest_system.NO_GROUND)

    def test_a_ground_that_another_system_deforms(self):
        owner = build()
        handle = bpy.data.objects["Ground Handle"]
        handle.animation_data_clear()
        toy_system.orbit(handle, toy_system.new_target())
        self.assert_rests(owner)

    def test_copies_and_removal(self):
        owner = build()
        other = toy_system.new_object("Second")
        toy_rest_system.rest(other, owner.motus.rest.ground)
        self.assertEqual(other.motus.rest.order_proxy, owner.motus.rest.order_proxy)
        copy = owner.copy()
        bpy.context.scene.collection.objects.link(copy)
        frame_set(1)
        for one in (owner, other, copy):
            self.assert_rests(one)
            wiring.detach(SYSTEM, one)
        self.assertFalse([obj for obj in bpy.data.objects if obj.name.startswith(".Motus")])

    def test_other_files(self):
        found = self.assert_rests(build())
        path = str(self.folder / "rest.blend")
        bpy.ops.wm.save_as_mainfile(filepath=path)
        bpy.ops.wm.open_mainfile(filepath=path)
        self.assertEqual(self.assert_rests(bpy.data.objects["Owner"]), found)
        for link in (False, True):
            support.empty_scene()
            with bpy.data.libraries.load(path, link=link) as (_, wanted):
                wanted.objects = ["Owner", "Ground"]
            for obj in wanted.objects:
                bpy.context.scene.collection.objects.link(obj)
            self.assertEqual(self.assert_rests(wanted.objects[0]), found)
