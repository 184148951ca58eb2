"""Habits of jobs over a range of frames, which ask for the range in one way, and of the panels of what such a job has baked."""

import bpy

import support
from core.test_habits import Properties, classes_of, drawn, keywords, live_objects, operators, system, system_panels

over_frames = support.addon("core.interface.over_frames")


class Baked(support.SceneTestCase):
    def test_baked_looks_baked(self):
        seen = set()
        for one in live_objects():
            bpy.context.view_layer.objects.active = one
            if 'CANCELLED' in _quietly(bpy.ops.motus.bake, object=one.name, frame_start=3, frame_end=4):
                continue
            for panel in system_panels():
                owner_system = system.registered[panel.name]
                if panel.is_used and panel.is_shown(bpy.context) and support.addon("core.bake.state").is_baked(owner_system, one):
                    seen.add(panel.name)
                    with self.subTest(panel.prefix, owner=one.name):
                        self.check(panel, owner_system, one)
        wanted = {one.name for one in system.systems() if not one.unbakeable}
        self.assertEqual(seen, wanted, "a system without an owner in blend_tests/live_scenes.py")

    def check(self, panel, owner_system, owner):
        for cls in classes_of(panel):
            layout = drawn(cls)
            if layout is None:
                continue
            self.assertFalse(cls.__name__.endswith("_readouts"))
            self.assertEqual([name for of, name, is_on in layout.drawn if is_on and of in {"prop", "list"}], [], cls.__name__)
            on = [name for of, name, is_on in layout.drawn if is_on and of == "operator"]
            is_main = not hasattr(cls, "bl_parent_id")
            self.assertEqual(on, ["motus.unbake"] if is_main else [])
            if is_main:
                self.assertIn("Baked 3-4", layout.named("label"))
        overlay = support.addon("core.interface.overlay")
        if owner_system.overlay is not None:
            for other in system.registered.values():
                if other.overlay is not None:
                    setattr(bpy.context.scene.motus, overlay.switch_of(other), other is owner_system)
            self.assertEqual(overlay.batches(bpy.context), [])


def _quietly(operator, **options):
    try:
        return operator(**options)
    except RuntimeError:
        return {'CANCELLED'}


class OverFrames(support.SceneTestCase):
    """Jobs over a range ask for it first."""

    def jobs(self):
        return [cls for cls in operators() if {"frame_start", "frame_end", "step"} <= {prop.identifier for prop in keywords(cls)}]

    def test_all_jobs_share_it(self):
        self.assertGreaterEqual(len(self.jobs()), 4)
        for cls in self.jobs():
            with self.subTest(cls.bl_idname):
                self.assertTrue(issubclass(cls, over_frames.OverFrames))
                self.assertIn("range", [name for group in cls.redo for name in group.names])

    def test_what_is_proposed(self):
        scene = bpy.context.scene
        scene.frame_start, scene.frame_end = 5, 45
        scene.use_preview_range = True  # Blender takes its frames only then
        scene.frame_preview_start, scene.frame_preview_end = 11, 19
        for cls in self.jobs():
            for uses_preview, wanted, frames in ((True, 'PREVIEW', (11, 19)), (False, 'SCENE', (5, 45))):
                scene.use_preview_range = uses_preview
                made = Properties(cls)
                cls._suggest(made, scene)
                with self.subTest(cls.bl_idname, preview=uses_preview):
                    self.assertEqual((made.range, made.frame_start, made.frame_end), (wanted, *frames))
                    self.assertEqual(over_frames.span(made, scene), frames)

    def test_ranges(self):
        scene = bpy.context.scene
        scene.frame_start, scene.frame_end = 5, 7
        scene.frame_set(30, subframe=0.5)
        for cls in self.jobs():
            for chosen, wanted in (
                ({}, [5, 6, 7]),
                ({"frame_start": 6}, [6, 7]),
                ({"range": 'CURRENT'}, [30.5]),
                ({"range": 'SCENE', "frame_start": 1, "frame_end": 2}, [5, 6, 7]),
                ({"range": 'GIVEN', "frame_start": 1, "frame_end": 2}, [1, 2]),
            ):
                made = Properties(cls)
                vars(made).update(chosen)
                with self.subTest(cls.bl_idname, **chosen):
                    self.assertEqual(over_frames.OverFrames.frames(made, scene), wanted)
