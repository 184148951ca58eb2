"""The demo of stereo: the camera keeps the aeroplane in sight, and its audience has nothing to suffer from."""

import bpy

import support
from demo import demo_cases


@support.in_one_blender
class DemoStereo(support.SceneTestCase):
    def test_the_gaze_follows_and_the_check_finds_nothing(self):
        self.assertEqual(demo_cases.build('STEREO'), {'FINISHED'})
        scene = bpy.context.window.scene
        camera, plane = scene.camera, scene.objects["Aeroplane"]
        depths = []
        for frame in range(1, scene.frame_end, 24):
            scene.frame_set(frame)
            seen = camera.matrix_world.normalized().inverted() @ plane.matrix_world.translation
            self.assertLess(abs(seen.x / seen.z), 0.15, frame)
            depths.append(-seen.z)
        self.assertGreater(max(depths), 5.0 * min(depths))
        bpy.ops.motus.stereo_check(object=camera.name, frame_start=1, frame_end=scene.frame_end, step=6.0)
        result = support.addon("stereo.results").of(camera)
        self.assertEqual(result.sentences, ())
        self.assertRegex(result.verdict, r"^No problems on a 1\.2 m screen in frames 1-\d+$")
