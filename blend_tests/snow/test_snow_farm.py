"""Frames of one process are those of another, which opens the file cold."""

import os

import bpy

import support
from snow.cover_cases import CoverTestCase, layer
from support import go_to

FRAMES = (3, 200)


COLD = """
import bpy
bpy.ops.wm.open_mainfile(filepath={file!r})
bpy.context.scene.frame_set({frame})
bpy.context.scene.render.filepath = {cold!r}
bpy.ops.render.render(write_still=True)
"""


def set_render(scene):
    scene.render.engine = 'CYCLES'
    scene.cycles.samples, scene.cycles.seed = 4, 3
    scene.cycles.use_denoising = False
    scene.render.resolution_x, scene.render.resolution_y, scene.render.resolution_percentage = 96, 64, 100
    scene.render.use_motion_blur = True
    scene.render.image_settings.file_format = 'BMP'


def pixels(file):
    with open(file, "rb") as opened:
        return opened.read()


class Farm(CoverTestCase):
    @support.in_one_blender
    def test_one_process_a_frame(self):
        emitter = self.add(preset='GENTLE', rate=20.0, location=(0.0, 0.0, 6.0))
        emitter.keyframe_insert("location", frame=1)
        emitter.location.x = 3.0
        emitter.keyframe_insert("location", frame=200)
        self.square()
        cover = self.cover(lump=0.3)
        scene = bpy.context.scene
        camera = bpy.data.objects.new("Camera", bpy.data.cameras.new("Camera"))
        camera.location, camera.rotation_euler = (0.0, -9.0, 2.0), (1.5, 0.0, 0.0)
        scene.collection.objects.link(camera)
        scene.camera = camera
        sun = bpy.data.objects.new("Sun", bpy.data.lights.new("Sun", 'SUN'))
        scene.collection.objects.link(sun)
        set_render(scene)
        for frame in FRAMES:
            go_to(frame)
            self.assertGreater(len(layer(cover)[0]), 0)
        # As `blender -a` does.
        scene.frame_start, scene.frame_end, scene.frame_step = *FRAMES, FRAMES[1] - FRAMES[0]
        scene.render.filepath = os.path.join(self.folder, "own")
        bpy.ops.render.render(animation=True)
        own = {frame: pixels(os.path.join(self.folder, f"own{frame:04d}.bmp")) for frame in FRAMES}
        self.assertNotEqual(own[FRAMES[0]], own[FRAMES[1]])
        go_to(1)
        file = os.path.join(self.folder, "snow.blend")
        bpy.ops.wm.save_as_mainfile(filepath=file, check_existing=False, copy=True)
        for frame in FRAMES:
            cold = os.path.join(self.folder, f"cold{frame}")
            status, said = support.run_blender(COLD.format(file=file, frame=frame, cold=cold))
            self.assertEqual(status, 0, said)
            self.assertEqual(pixels(f"{cold}.bmp"), own[frame], frame)
