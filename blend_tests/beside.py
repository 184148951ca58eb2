"""Runs in a Blender beside that of the tests: a piece of code after the other from the standard input (support.BlenderBeside)."""

import ctypes
import json
import sys
import traceback
from pathlib import Path

import bpy

sys.path.insert(0, str(Path(__file__).resolve().parent))

import support


def run(code):
    """Runs the code in Blender's own start-up file; returns whether nothing was raised."""
    bpy.ops.wm.read_homefile(use_factory_startup=True)
    try:
        exec(compile(code, "a piece of code", "exec"), {"__name__": "__main__"})
    except BaseException:
        traceback.print_exc()
        return False
    return True


def flush():
    """Has all that was printed arrive, also what Blender itself has printed, such as reports of operators."""
    sys.stdout.flush()
    sys.stderr.flush()
    ctypes.CDLL("ucrtbase" if sys.platform == "win32" else None).fflush(None)


def unregister_toys(own):
    """Leaves of the add-on's systems its own."""
    if toys := [one for one in support.addon("systems").SYSTEMS if one not in own]:
        support.unregister_systems(*toys)


def serve():
    """Each line is a piece of code as JSON; the end of the input ends this Blender."""
    own = support.addon("systems").SYSTEMS if support.is_enabled() else None
    for line in sys.stdin:
        status = 0 if run(json.loads(line)) else 1
        if own:
            unregister_toys(own)
        flush()
        print(f"\n{support.DONE}{status}", flush=True)


serve()
