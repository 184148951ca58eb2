"""Inside a Blender with a window: does the steps of the manual's pages.

blender ... --enable-event-simulate --python driver.py -- X_SERVER_FOLDER [NAME...]
"""

import importlib
import os
import sys
import traceback
from pathlib import Path

SCRIPTS = Path(__file__).resolve().parents[1]
CLONE = SCRIPTS.parents[1]
sys.path[:0] = [str(SCRIPTS), str(CLONE / "blend_tests")]
sys.dont_write_bytecode = True

import bpy  # noqa: E402  (found by the lines above)

import support  # noqa: E402
from steps import strip  # noqa: E402
from window import driver, window_support  # noqa: E402


def do_all(names):
    """Generator: the steps of the pages one after the other; ends Blender with status 1 at the first that cannot be done."""
    for name in names:
        pictures = strip.Strip()
        try:
            yield from importlib.import_module(f"steps.{name}_steps").steps(pictures)
        except Exception:
            traceback.print_exc()
            sys.stdout.flush()
            os._exit(1)  # an exception in a timer would leave Blender open
        for file in pictures.save(CLONE / "docs" / "pictures" / f"{name}_steps.png"):
            print(f"docs/pictures/{file.name}", flush=True)
    bpy.ops.wm.quit_blender()


def main(folder, *names):
    """Begin; the rest is done by Blender's timer."""
    support.enable()
    preferences = bpy.context.preferences
    preferences.view.smooth_view = 0
    preferences.system.viewport_aa = 'OFF'
    preferences.view.show_splash = False
    preferences.view.show_tooltips = False
    preferences.inputs.mouse_double_click_time = 1  # milliseconds: two clicks of the hand are no double click
    window_support.picture_folder = Path(folder)
    known = sorted(path.stem[: -len("_steps")] for path in Path(__file__).parent.glob("*_steps.py"))
    bpy.app.timers.register(driver.stepper(do_all(names or known)), first_interval=1.0, persistent=True)


main(*sys.argv[sys.argv.index("--") + 1 :])
