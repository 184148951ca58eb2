"""Inside a Blender with a window: runs the generator functions test_* of one file, step by step from a timer.

    blender ... --enable-event-simulate --python driver.py -- TEST_FILE PICTURE_FOLDER [PATTERN...]

A test yields the seconds that Blender shall have to itself (to handle events, to draw), or what `picture()` needs.
"""

import importlib.util
import sys
import traceback
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parent)]
sys.dont_write_bytecode = True

import bpy  # noqa: E402
import support  # noqa: E402  (found by the line above)
import window_support  # noqa: E402

START = 0.5  # seconds for the window to appear


def load_tests(path, patterns):
    """The test functions of the file, in its order."""
    spec = importlib.util.spec_from_file_location(Path(path).stem, path)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    tests = [value for name, value in vars(module).items() if name.startswith("test_")]
    return [test for test in tests if not patterns or any(pattern in test.__name__ for pattern in patterns)]


def run_all(tests):
    """Generator over all steps of all tests; prints the failures and the summary line, and quits Blender."""
    failed = 0
    yield START
    for test in tests:
        support.empty_scene()
        yield START
        try:
            yield from test()
        except Exception:  # the next test still runs
            failed += 1
            print(f"FAILED {test.__name__}\n{traceback.format_exc()}", flush=True)
    print(f"summary: {len(tests) - failed} passed, {failed} failed, 0 skipped", flush=True)
    bpy.ops.wm.quit_blender()


def main(test_file, picture_folder, *patterns):
    support.enable()
    # Drawn in software, eight samples of each pixel would take most of the time.
    bpy.context.preferences.system.viewport_aa = 'OFF'
    window_support.picture_folder = Path(picture_folder)
    steps = run_all(load_tests(test_file, patterns))
    # Persistent, because each test opens a new file.
    bpy.app.timers.register(lambda: next(steps, None), first_interval=START, persistent=True)


main(*sys.argv[sys.argv.index("--") + 1:])
