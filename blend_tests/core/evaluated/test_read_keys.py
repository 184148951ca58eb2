"""Who reads keys of other frames answers to their edits at once: on the same frame, not when it is come back to."""

import unittest.mock

import bpy
import numpy as np

import live_scenes
import support

actions = support.addon("core.blender.actions")
history = support.addon("drivers.history")
solving = support.addon("core.wiring.solving.solving")

FRAME, AWAY = 25, 60
READERS = {
    "Crane": "Crane Rod 1",
    "Hook": "Hook Rod 1",
    "Parcel": "Ribbon",
    "Racer": "Racer",
    "Robot": "Robot Foot 0",
    "Rope": "Rope",
    "Snow": "Snow Cover",
    "Spider": "Spider",
    "Sprung": "Sprung",
    "Target": "Pendant",
}
"""What keys animate -> something that shows, and hangs on these at other frames too."""

REMOVED = """
import bpy
import support

def keyed(scene):
    thing = bpy.data.objects.new("Thing", None)
    scene.collection.objects.link(thing)
    for frame in (1, 10):
        thing.location.x = frame
        thing.keyframe_insert("location", frame=frame)
    return thing

def fill(scene):
    bpy.context.window.scene = scene
    things = [keyed(scene) for _ in range(20)]
    for thing in things:
        thing.select_set(True)
    bpy.context.view_layer.objects.active = things[0]
    bpy.ops.motus.dynamics_add()
    assert all(thing.motus.dynamics.is_active for thing in things)
    for thing in things:
        thing.select_set(False)
    scene.frame_set(5)

def empty(*_):
    bpy.data.batch_remove([one for one in (*bpy.data.objects, *bpy.data.meshes) if one != lamp])
    for _ in range(200):  # some of them come to lie where those were
        bpy.data.meshes.new("Other")

def edit():
    lamp.location.y += 1.0
    lamp.keyframe_insert("location", frame=5)
    bpy.context.view_layer.update()
    print("ALIVE", flush=True)

support.empty_scene()
first, second = bpy.context.scene, bpy.data.scenes.new("Second")
lamp = keyed(first)
first.frame_set(5)
fill(second)
bpy.context.window.scene = first
empty()
edit()

def empty_once(*_):
    bpy.app.handlers.depsgraph_update_post.remove(empty_once)
    empty()

fill(first)
bpy.app.handlers.depsgraph_update_post.insert(0, empty_once)
edit()
"""


def animated():
    """Names of all objects that keys animate, with the paths of these."""
    found = {obj.name: list(dict.fromkeys(curve.data_path for curve in actions.fcurves(obj))) for obj in bpy.data.objects}
    return {name: paths for name, paths in found.items() if paths}


def insert(name, paths):
    """As an artist does: by what each is on this frame."""
    for path in paths:
        bpy.data.objects[name].keyframe_insert(path, frame=FRAME)


def delete(name, paths):
    """The first keys."""
    obj = bpy.data.objects[name]
    for path in paths:
        obj.keyframe_delete(path, frame=min(curve.range()[0] for curve in actions.fcurves(obj) if curve.data_path == path))


def move(name, _paths):
    """As the graph editor does."""
    for curve in actions.fcurves(bpy.data.objects[name]):
        curve.keyframe_points[0].co.y += 0.2


def drop(name, _paths):
    """All keys."""
    remove_all(actions.fcurves(bpy.data.objects[name]))


def remove_all(curves):
    for curve in list(curves):
        curves.remove(curve)


class EditedKeysTest(support.SceneTestCase):
    def setUp(self):
        super().setUp()
        live_scenes.opened()
        self.go_to(FRAME)

    @staticmethod
    def go_to(frame):
        bpy.context.scene.frame_set(frame)

    def changed_by(self, edit, *arguments):
        """Names of the objects that an edit changes on this frame, all of it at once."""
        before = live_scenes.state()
        edit(*arguments)
        bpy.context.view_layer.update()
        now = live_scenes.state()
        self.go_to(AWAY)
        self.go_to(FRAME)
        wanted = live_scenes.state()
        late = [place for place in wanted if not np.array_equal(now[place], wanted[place])]
        self.assertEqual(late, [])
        return {place[0] for place in wanted if not np.array_equal(before[place], wanted[place])}

    def test_all_that_is_live(self):
        for name, paths in animated().items():
            changed = {}
            for edit in (insert, delete, move, drop):
                with self.subTest(name, edit=edit.__name__):
                    changed[edit] = self.changed_by(edit, name, paths)
            if name in READERS:
                with self.subTest(name):
                    self.assertIn(READERS[name], changed[move])
                    self.assertIn(READERS[name], changed[delete] | changed[drop])

    def test_action_of_a_layer(self):
        curves = next(iter(actions.all_fcurves(bpy.data.actions["Wave"])))
        self.assertEqual(self.changed_by(remove_all, curves), {"Puppet"})

    def test_action_in_a_strip(self):
        animation = bpy.data.objects["Crane"].animation_data
        strip = animation.nla_tracks.new().strips.new("Strip", 1, animation.action)
        if hasattr(strip, "action_slot"):
            strip.action_slot = animation.action_slot
        animation.action = None
        self.go_to(FRAME)
        points = actions.curves_of(strip)[0].keyframe_points
        self.assertIn("Crane Rod 1", self.changed_by(points.remove, points[0]))

    def test_edited_on_the_way_to_the_frame(self):
        """An edit and a change of the frame in one evaluation."""
        crane = bpy.data.objects["Crane"]
        crane.parent = bpy.data.objects.new("Ship", None)
        bpy.context.scene.collection.objects.link(crane.parent)
        bpy.context.view_layer.update()
        for frame, place in ((1, 0.0), (20, 3.0), (40, 4.0)):
            crane.parent.location.x = place
            crane.parent.keyframe_insert("location", frame=frame)
        self.go_to(FRAME)
        self.assertIn("Crane Rod 1", self.changed_by(drop, "Ship", ()))

    def test_what_is_not_keyed_yet_stays(self):
        for name in ("Crane", "Sprung"):
            obj = bpy.data.objects[name]
            obj.keyframe_insert("scale", frame=1)
            self.go_to(FRAME)
            obj.scale.x = 3.0
            bpy.context.view_layer.update()
            insert(name, ["location"])
            bpy.context.view_layer.update()
            self.assertEqual((name, obj.scale.x), (name, 3.0))

    def test_driver_on_nodes(self):
        material = bpy.data.materials.new("Glow")
        material.use_nodes = True
        shader = next(node for node in material.node_tree.nodes if node.type == 'BSDF_PRINCIPLED')
        path = f'{shader.inputs["Roughness"].path_from_id()}.default_value'
        screen = bpy.data.objects.new("Screen", bpy.data.meshes.new("Screen"))
        bpy.context.scene.collection.objects.link(screen)
        screen.data.materials.append(material)
        for frame, value in ((1, 0.0), (10, 1.0), (40, 0.5)):
            shader.inputs["Roughness"].default_value = value
            material.node_tree.keyframe_insert(path, frame=frame)
        bpy.ops.motus.driver_add(datablock="Glow", collection="materials", data_path=f"node_tree.{path}", function='SECOND_ORDER')
        self.go_to(FRAME)
        before = shader.inputs["Roughness"].default_value
        material.node_tree.keyframe_delete(path, frame=10)
        bpy.context.view_layer.update()
        now = shader.inputs["Roughness"].default_value
        self.go_to(AWAY)
        self.go_to(FRAME)
        self.assertEqual(shader.inputs["Roughness"].default_value, now)
        self.assertNotEqual(before, now)

    def test_undone(self):
        bpy.ops.ed.undo_push(message="Before")
        before = live_scenes.state()
        move("Target", ())
        bpy.context.view_layer.update()
        bpy.ops.ed.undo_push(message="After")
        bpy.ops.ed.undo()
        bpy.context.view_layer.update()
        now = live_scenes.state()
        self.assertTrue(np.array_equal(now["Pendant", ""], before["Pendant", ""]))


class CallsTest(support.SceneTestCase):
    """How often solvers are called."""

    def setUp(self):
        super().setUp()
        live_scenes.opened()
        bpy.context.scene.frame_set(FRAME)
        # What was read on a frame that was only gone to nobody knows.
        self.calls(insert, "Crane", ["location"])

    @staticmethod
    def calls(edit, *arguments):
        """Names of the owners whose solvers an edit has called, once for each call."""
        with unittest.mock.patch.object(solving.Solver, "_solve", autospec=True, side_effect=solving.Solver._solve) as solve:
            edit(*arguments)
            for _ in range(3):
                bpy.context.view_layer.update()
        return sorted(call.args[0]._owner.name for call in solve.call_args_list)

    def test_readers_alone(self):
        self.assertEqual(self.calls(insert, "Crane", ["location"]), ["Crane"])
        self.assertEqual(self.calls(insert, "Target", ["location"]), ["Pendant"])
        lamp = bpy.data.objects.new("Lamp", None)
        bpy.context.scene.collection.objects.link(lamp)
        bpy.context.view_layer.update()
        self.assertEqual(self.calls(lamp.keyframe_insert, "location"), [])

    def test_once_where_blender_calls_them(self):
        self.assertEqual(self.calls(move, "Crane", ()), ["Crane"])

    def test_of_another_scene(self):
        """What is not evaluated any more has nobody called."""
        scene = bpy.data.scenes.new("Second")
        scene.collection.objects.link(bpy.data.objects["Crane"])
        with bpy.context.temp_override(scene=scene, view_layer=scene.view_layers[0]):
            bpy.context.evaluated_depsgraph_get().update()
        self.assertEqual(self.calls(insert, "Target", ["location"]), ["Pendant"])

    def test_frames_that_are_gone_to(self):
        """Then nothing is noted; the first edit calls all of them once, the next one those alone that read what was edited."""
        bpy.context.scene.frame_set(FRAME + 1)
        found = self.calls(insert, "Target", ["location"])
        self.assertIn("Pendant", found)
        self.assertIn("Racer", found)
        self.assertEqual(self.calls(delete, "Target", ["location"]), ["Pendant"])

    def test_drivers_of_their_own_keys_alone(self):
        """An object that is called again is evaluated whole, with its geometry."""
        for name, wanted in (("Target", False), ("Sprung", True)):
            bpy.context.scene.frame_set(bpy.context.scene.frame_current + 1)
            with unittest.mock.patch.object(history, "_kept", side_effect=history._kept) as kept:
                insert(name, ["location"])
                bpy.context.view_layer.update()
            self.assertEqual((name, kept.called), (name, wanted))

    def test_of_what_is_removed(self):
        """In another scene, or by a handler that is called before: Blender's copies are still there, and point to freed memory."""
        status, said = support.run_beside(REMOVED, arguments=("--factory-startup", "--debug-memory"))
        self.assertEqual((status, said.count("ALIVE")), (0, 2), said)
