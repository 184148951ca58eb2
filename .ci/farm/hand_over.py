"""Run inside a Blender with Motus: hand_over.py -- SHOT RESULT FIRST LAST opens a shot, and writes it as a file that plays without Motus."""

import sys

import bpy

shot, result, first, last = sys.argv[sys.argv.index("--") + 1 :]
bpy.context.preferences.filepaths.use_scripts_auto_execute = True  # as on the workers
bpy.ops.wm.open_mainfile(filepath=shot)
try:
    bpy.ops.motus.hand_over(filepath=result, start=int(first), end=int(last))
except RuntimeError as error:
    sys.exit(f"motus: {str(error).strip().removeprefix('Error: ')}")
