"""Run by a Blender before 4.2: installs and enables the add-on of the zip after `--`, and saves that in the preferences."""

import sys

import bpy

zip_path = sys.argv[sys.argv.index("--") + 1]
bpy.ops.preferences.addon_install(filepath=zip_path, overwrite=True)
bpy.ops.preferences.addon_enable(module="motus")
bpy.ops.wm.save_userpref()
if "motus" not in bpy.context.preferences.addons:
    sys.exit("motus: Blender did not enable the add-on")
