"""Inside a Blender with a window: runs the generator functions test_* of all files below this folder, step by step from a timer.

    blender ... --enable-event-simulate --python driver.py -- PICTURE_FOLDER [PATTERN...]

A test yields where Blender shall handle the events that it was sent, and draw what has changed by them. Where something takes its time, the
test waits for it by `window_support.until`, or yields the seconds that Blender shall have to itself.
"""

import importlib
import os
import sys
import time
import traceback
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE.parent), str(HERE.parents[1] / ".ci")]
sys.dont_write_bytecode = True

import bpy  # noqa: E402

import kept_tests  # noqa: E402  (found by the line above)
import passed  # noqa: E402
import support  # noqa: E402
from window import window_support  # noqa: E402

TURNS = 3
"""Of Blender's main loop: the events that a test has sent are handled in the first, and what is marked by that for drawing is drawn in the
second; a third for what these ask for in turn, such as a timer or a region that has to be laid out first."""
LIMIT = 600.0  # seconds for one test: for what never ends, not for a machine that does much else


def load_tests(patterns):
    """{file.test: function} of all files, in their order."""
    names = sorted(path.relative_to(HERE.parent).with_suffix("").parts for path in HERE.rglob("test_*.py"))
    modules = [importlib.import_module(".".join(parts)) for parts in names]
    tests = {f"{module.__name__}.{name}": value for module in modules for name, value in vars(module).items() if name.startswith("test_")}
    return {name: test for name, test in tests.items() if not patterns or any(pattern in name for pattern in patterns)}


def start_file():
    """Path of the start-up file of all tests, beside the pictures."""
    return window_support.picture_folder / "start.blend"


def make_start_file():
    """Generator: saves the start-up file, in which the 3D viewport has the window alone and draws little."""
    support.empty_scene()
    window_support.leave_the_viewport()
    yield
    window_support.draw_little()
    yield
    bpy.ops.wm.save_as_mainfile(filepath=str(start_file()), copy=True)


def run_one(test):
    """Generator over the steps of one test."""
    started = time.monotonic()
    support.enable()
    bpy.ops.wm.read_homefile(filepath=str(start_file()), use_empty=True)
    yield
    for step in test():
        if time.monotonic() - started > LIMIT:
            raise AssertionError(f"no end after {LIMIT:.0f} s")
        yield step


def run_all(tests, ended, before):
    """Generator over all steps of all tests but those that have ended; says what has passed and what has failed, and quits Blender.

    before: KeptTests; None if all are to run.
    """
    yield
    yield from make_start_file()
    for module, names in by_module(tests).items():
        left = [name for name in names if name not in ended]
        if before is None or len(left) < len(names):
            yield from run_some({name: tests[name] for name in left})
        elif before.count(module) == len(names):
            print(*(f"KEPT {name}" for name in names), sep="\n", flush=True)
        else:
            with before.watched(module) as note:
                if (yield from run_some({name: tests[name] for name in names})):
                    note(len(names))
    bpy.ops.wm.quit_blender()


def by_module(tests):
    """{name of a module: names of its tests}."""
    found = {}
    for name in tests:
        found.setdefault(name.rpartition(".")[0], []).append(name)
    return found


def run_some(tests):
    """Generator over all steps of some tests; returns whether all passed."""
    failed = 0
    for name, test in tests.items():
        print(f"BEGUN {name}", flush=True)
        try:
            yield from run_one(test)
            print(f"PASSED {name}", flush=True)
        except Exception:  # the next test still runs
            failed += 1
            print(f"{traceback.format_exc()}\nFAILED {name}", flush=True)
    return not failed


def stepper(steps):
    """A function for Blender's timer: a step of the generator each time that Blender has had what the last one asked for."""
    turns = iter(())

    def step():
        nonlocal turns
        if next(turns, None) is not None:
            return 0.0
        try:
            seconds = next(steps)
        except StopIteration:
            return None
        turns = iter(range(TURNS - 1)) if seconds is None else iter(())
        return seconds or 0.0

    return step


def main(picture_folder, *patterns):
    support.enable()
    preferences = bpy.context.preferences
    # Drawn in software, smooth edges would take most of the time.
    preferences.system.viewport_aa = 'OFF'
    preferences.system.use_overlay_smooth_wire = preferences.system.use_edit_mode_smooth_wire = False
    preferences.view.smooth_view = 0
    preferences.inputs.mouse_double_click_time = 1  # milliseconds: two presses of a test are no double click
    window_support.picture_folder = Path(picture_folder)
    tests = load_tests(patterns)
    print("TESTS", *tests, flush=True)
    runners = (line for name in ("driver.py", "run.py") for line in passed.contents(HERE / name))
    about = ["in a window", *runners, *support.about()]
    before = None if patterns else kept_tests.KeptTests.named(HERE.parent, by_module(tests), about)
    steps = run_all(tests, os.environ["MOTUS_ENDED"].split(), before)
    # Persistent, because each test opens a new file.
    bpy.app.timers.register(stepper(steps), first_interval=0.0, persistent=True)


if __name__ == "__main__":
    main(*sys.argv[sys.argv.index("--") + 1 :])
