"""print_matrices() for a Blender without the add-on: needs nothing of it."""

import json

import bpy


def print_matrices(path, addresses, use_scripts):
    """Open a file, and print the evaluated matrices of (object, bone or "") at the frames of test_wiring_files."""
    bpy.ops.wm.open_mainfile(filepath=path, use_scripts=use_scripts)
    collected = []
    for frame, subframe in ((12, 0.0), (40, 0.5)):
        bpy.context.scene.frame_set(frame, subframe=subframe)
        collected.append([_matrix(*place) for place in addresses])
    print("RESULT " + json.dumps(collected), flush=True)


def _matrix(name, bone):
    evaluated = bpy.data.objects[name].evaluated_get(bpy.context.evaluated_depsgraph_get())
    matrix = evaluated.matrix_world @ evaluated.pose.bones[bone].matrix if bone else evaluated.matrix_world
    return [list(row) for row in matrix]
