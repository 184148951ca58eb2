"""Run inside a Blender with Motus: make_shot.py -- SYSTEM FILE BROKEN saves a demo scene as a shot whose frames are small, and need no graphics card.

BROKEN: frame at which the file ends Blender when it is rendered; "" for none.
"""

import sys

import bpy

HANDLER = """
import os
import bpy

def end_at(scene, *_):
    if scene.frame_current == {frame}:
        print("this frame is broken", flush=True)
        os._exit(3)

bpy.app.handlers.render_pre.append(end_at)
"""
system, file, broken = sys.argv[sys.argv.index("--") + 1 :]
bpy.ops.motus.demo_scene(system=system)
scene = bpy.context.window.scene
scene.render.engine = 'CYCLES'
cycles = scene.cycles
cycles.samples, cycles.use_denoising, cycles.use_adaptive_sampling, cycles.max_bounces = 1, False, False, 2
scene.render.resolution_x, scene.render.resolution_y, scene.render.resolution_percentage = 160, 90, 100
scene.render.use_multiview = False
scene.render.image_settings.file_format = 'PNG'
if broken:
    text = bpy.data.texts.new("broken.py")
    text.from_string(HANDLER.format(frame=broken))
    text.use_module = True  # run when the file is opened
bpy.ops.wm.save_as_mainfile(filepath=file)
