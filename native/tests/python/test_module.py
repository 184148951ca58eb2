"""The module as a whole: a second copy of it, the states of threads, and arrays that other threads write into."""

import ctypes
import doctest
import shutil
import subprocess
import sys
import tempfile
import threading
import unittest
from pathlib import Path

import numpy as np

import motus_native as native

SECOND_COPY = """
import importlib.util, sys
import numpy as np
import motus_native as first

def load(path, name):
    spec = importlib.util.spec_from_file_location(name, path)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module

second = load(sys.argv[1], "another_package.motus_native")
assert second.Curve is not first.Curve
points = [[0, 0, 0], [1, 0, 0], [1, 1, 0]]
for module in (first, second):
    curve = module.Bezier(points)
    assert isinstance(curve, module.Curve)
    module.follow(curve, module.Timing.constant(1.0), 0.5, [0.0], "minimal")
    plan = module.IkPlan([-1, 0], [[0, 1]], [1], np.zeros((0, 2), np.int32))
    module.solve_two_bone([0, 0, 0], [0, 1, 0], 1.0, 1.0, [0, 0, 1])
    module.Picker(np.zeros((3, 3), np.float32), [[0, 1, 2]])
    module.Lattice([0, 0, 0], np.eye(3), [2, 2, 2])
    module.LookAtPlan([-1], [[]], [0], [[]])
try:  # of another version it might be laid out otherwise
    first.follow(second.Bezier(points), first.Timing.constant(1.0), 0.5, [0.0], "minimal")
except TypeError as error:
    assert "curve" in str(error), error
else:
    raise AssertionError("a curve of the other copy was taken")
print("both work")
"""


class FirstExamplesTest(unittest.TestCase):
    def test_they_print_what_the_manual_says(self):
        found = doctest.testfile("../../../docs/python_module.md", encoding="utf-8")
        self.assertGreater(found.attempted, 0)
        self.assertEqual(found.failed, 0)


class CachesTest(unittest.TestCase):
    def setUp(self):
        self.addCleanup(native.set_cache_budget, native.cache_budget())
        native.clear_caches()

    def test_tables_are_kept_within_a_budget_and_let_go(self):
        self.assertEqual((native.cache_budget(), native.cached_bytes()), (1 << 30, 0))
        curve = native.Bezier([[0, 0, 0], [1, 2, 0], [3, 1, 1], [4, 0, 0]])
        length = curve.length()
        kept = native.cached_bytes()
        self.assertGreater(kept, 1000)
        native.set_cache_budget(kept - 1)
        self.assertEqual(native.cached_bytes(), 0)
        self.assertEqual(native.Bezier([[0, 0, 0], [1, 2, 0], [3, 1, 1], [4, 0, 0]]).length(), length)
        self.assertEqual(native.cached_bytes(), 0)
        native.set_cache_budget(kept)
        native.Bezier([[0, 0, 0], [1, 2, 0], [3, 1, 1], [4, 0, 0]]).length()
        self.assertEqual(native.cached_bytes(), kept)
        native.clear_caches()
        self.assertEqual(native.cached_bytes(), 0)

    def test_a_budget_is_a_whole_number(self):
        for wrong in (-1, 1.5, "much", None):
            with self.assertRaises(TypeError):
                native.set_cache_budget(wrong)


class BoundedTest(unittest.TestCase):
    def test_numbers_of_all_arrays_count(self):
        self.assertTrue(native.are_below(3.4e38))
        for dtype in (np.float32, np.float64):
            rows = np.full((7, 3), -3.3e38, dtype)
            self.assertTrue(native.are_below(3.4e38, rows, rows[0], np.empty((0, 3))))
            for number in (np.nan, np.inf, -np.inf, 3.4e38):
                rows[6, 2] = number
                self.assertFalse(native.are_below(3.4e38, rows, np.zeros(3)))
                self.assertFalse(native.are_below(3.4e38, np.zeros(3), rows))

    def test_arrays_that_cannot_be_read_are_refused(self):
        odd = np.zeros(9, np.uint8)[1:].view(np.float64)
        for array in ([1.0], 1.0, None, np.zeros(3, int), np.zeros(3, np.float16), np.zeros((3, 3))[:, 0], odd):
            with self.subTest(array=array), self.assertRaisesRegex(TypeError, "^arrays: "):
                native.are_below(1.0, np.zeros(2), array)


class SecondCopyTest(unittest.TestCase):
    def test_a_copy_under_another_package_is_imported_beside_the_first(self):
        with tempfile.TemporaryDirectory() as folder:
            copy = Path(folder) / "another_package" / Path(native.__file__).name
            copy.parent.mkdir()
            shutil.copy(native.__file__, copy)
            paths = [str(Path(native.__file__).parent), *sys.path]
            script = f"import sys\nsys.path[:0] = {paths!r}\n{SECOND_COPY}"
            done = subprocess.run([sys.executable, "-c", script, str(copy)], capture_output=True, text=True, check=False)
        self.assertEqual((done.stdout.strip(), done.stderr), ("both work", ""))


def thread_states():
    """How many thread states the interpreter has."""
    api = ctypes.pythonapi
    for name in ("PyInterpreterState_Get", "PyInterpreterState_ThreadHead", "PyThreadState_Next"):
        getattr(api, name).restype = ctypes.c_void_p
    api.PyInterpreterState_ThreadHead.argtypes = api.PyThreadState_Next.argtypes = [ctypes.c_void_p]
    count, state = 0, api.PyInterpreterState_ThreadHead(api.PyInterpreterState_Get())
    while state:
        count, state = count + 1, api.PyThreadState_Next(state)
    return count


def in_foreign_thread(work, times=1):
    """Calls work() from a thread that Python has not started, so many times, each with a call into Python of its own."""
    libc = ctypes.CDLL(None)
    callback = ctypes.CFUNCTYPE(ctypes.c_void_p, ctypes.c_void_p)(lambda _argument: work())
    for _ in range(times):
        thread = ctypes.c_ulong()
        libc.pthread_create(ctypes.byref(thread), None, callback, None)
        libc.pthread_join(thread, None)


@unittest.skipIf(sys.platform == "win32", "threads that Python did not start are made by POSIX here")
class ThreadStateTest(unittest.TestCase):
    def test_one_state_a_thread_is_kept_however_often_it_asks(self):
        found = []

        def ask():
            before = thread_states()
            found.extend(native.keep_thread_state() for _ in range(1000))
            found.append(thread_states() - before)

        before = thread_states()
        in_foreign_thread(ask)
        self.assertEqual(found, [True] * 1000 + [0])
        self.assertEqual(thread_states(), before + 1)

    def test_threads_that_come_and_go_leave_a_bounded_number_of_states(self):
        before, kept = thread_states(), []
        in_foreign_thread(lambda: kept.append(native.keep_thread_state()) and None, times=200)
        self.assertEqual(len(kept), 200)
        self.assertIn(False, kept)
        self.assertLessEqual(thread_states() - before, 64)


class ChangingArraysTest(unittest.TestCase):
    """Another thread writes into the caller's arrays while the solver is at work without the interpreter's lock."""

    def spoil(self, array, value, call, calls):
        memory, end = memoryview(array).cast("B"), threading.Event()
        good, bad = bytes(memory), np.full_like(array, value).tobytes()

        def write():
            while not end.is_set():
                memory[:] = bad  # at once, with the lock held, as NumPy does not do it
                memory[:] = good

        thread = threading.Thread(target=write)
        thread.start()
        try:
            return [call() for _ in range(calls)]
        finally:
            end.set()
            thread.join()

    def test_a_solve_sees_its_arrays_as_they_were_when_it_was_called(self):
        count = 3000
        bones = 3 * count
        parents = [-1 if i % 3 == 0 else i - 1 for i in range(bones)]
        plan = native.IkPlan(
            parents, [[3 * i, 3 * i + 1, 3 * i + 2] for i in range(count)], [3 * i + 2 for i in range(count)], np.zeros((0, 2), np.int32)
        )
        rest = np.tile(np.eye(4, dtype=np.float32).ravel(), (bones, 1))
        for i in range(bones):
            rest[i, 13] = i % 3
        own = np.tile(np.eye(4, dtype=np.float32).ravel(), (bones, 1))
        bones_at = plan.bones(plan.rest(rest, np.ones(bones, np.float32), np.full(bones, 8 | 16, np.int32)), own)
        settings = np.zeros((count, len(plan.SETTINGS)))
        given = {"position_weight": 1, "bend": 1, "tolerance": 1e-6, "iterations": 30, "use_limits": 1, "is_on": 1}
        for name, value in given.items():
            settings[:, plan.SETTINGS.index(name)] = value
        targets = np.tile(np.eye(4).ravel(), (count, 1))
        targets[:, 12:15] = 1.0, 1.5, 0.4
        poles = np.full((count, 3), np.nan)
        limits = np.tile(np.array([-2.0, -2, -2, 2, 2, 2]), (bones, 1))
        reason = plan.REPORT.index("reason")

        def call():
            report = plan.solve(bones_at, rest, np.eye(4).ravel(), settings, targets, poles, limits)
            return np.unique(report[:, reason]).size  # all chains are alike

        for array in (settings, targets, limits):
            self.assertEqual(set(self.spoil(array, np.nan, call, calls=8)), {1})

    def test_numbers(self):
        curve = native.Bezier([[0, 0, 0], [1, 2, 0], [3, 1, 1], [4, 0, 0]])
        at = np.linspace(0.0, 1.0, 1_000_000)

        whole, other = curve.position(at), curve.position(0.25)

        def call():
            found = curve.position(at)
            return bool((found == whole).all() or (found == other).all())

        self.assertNotIn(False, self.spoil(at, 0.25, call, calls=8))

    def test_triangles_of_a_picker(self):
        count = 60_000
        positions = np.random.default_rng(1).random((count, 3)).astype(np.float32)
        triangles = np.arange(count, dtype=np.int32).reshape(count // 3, 3)

        def call():
            try:
                native.Picker(positions, triangles).reach(0, 0.5, "surface")
            except ValueError as error:
                return str(error).startswith("triangles: ")
            return True

        self.assertNotIn(False, self.spoil(triangles, 2**31 - 1, call, calls=30))
