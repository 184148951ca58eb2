"""Runs the unittest modules of a folder: a traceback for each failure, and one summary line that .ci/test.py reads.

suite.py FOLDER [PATTERN...] does so in a Python that has no pytest; Blenders call run_folder().
"""

import faulthandler
import gc
import os
import sys
import unittest

import bytecode
import journal


class _Result(unittest.TestResult):
    """Prints failures as they happen, and what the slow tests take of the processor, processes that they start included; keeps the journal."""

    SLOW = 2.0

    def __init__(self, kept):
        super().__init__()
        self._kept = kept

    def startTest(self, test):
        super().startTest(test)
        self._kept.note(test.id(), journal.BEGUN)
        self._known = self._counts()
        self._started = sum(os.times()[:4])

    def stopTest(self, test):
        super().stopTest(test)
        failed, skipped = (now > known for now, known in zip(self._counts(), self._known))
        self._kept.note(test.id(), "failed" if failed else "skipped" if skipped else "passed")
        seconds = sum(os.times()[:4]) - self._started
        if seconds > self.SLOW:
            print(f"slow: {test.id()} {seconds:.1f} s", flush=True)

    def _counts(self):
        return len(self.failures) + len(self.errors) + len(self.unexpectedSuccesses), len(self.skipped)

    def addFailure(self, test, err):
        super().addFailure(test, err)
        self._report(test, self.failures)

    def addError(self, test, err):
        super().addError(test, err)
        self._report(test, self.errors)

    def addSubTest(self, test, subtest, err):
        known = len(self.failures), len(self.errors)
        super().addSubTest(test, subtest, err)
        if len(self.failures) > known[0]:
            self._report(subtest, self.failures)
        if len(self.errors) > known[1]:
            self._report(subtest, self.errors)

    @staticmethod
    def _report(test, collected):
        print(f"FAILED {test.id()}\n{collected[-1][1]}", flush=True)


def failed_tests(result):
    """Ids of the tests that failed, each once however many of its subtests did."""
    broken = [test for test, _ in result.failures + result.errors] + list(result.unexpectedSuccesses)
    return {getattr(test, "test_case", test).id() for test in broken}


def _tests(suite):
    """The tests of a suite and of the suites in it, one by one."""
    for test in suite:
        if isinstance(test, unittest.TestSuite):
            yield from _tests(test)
        else:
            yield test


def _is_marked(test, mark):
    """Whether a test's class or method has the attribute `mark`."""
    return hasattr(test, mark) or hasattr(getattr(test, getattr(test, "_testMethodName", ""), None), mark)


def run_folder(folder, patterns=()):
    """Runs folder/test_*.py, or of it the tests whose id contains one of `patterns`; returns the exit status.

    Those with the attribute that the environment variable MOTUS_LEAVE_OUT names are left out, and those that the journal has.
    """
    faulthandler.enable()  # a process that a signal ends says which test it was in
    with bytecode.kept_for_children():
        return _run(folder, patterns)


def _run(folder, patterns):
    sys.path.insert(0, str(folder))
    loader = unittest.TestLoader()
    if patterns:
        loader.testNamePatterns = [f"*{pattern}*" for pattern in patterns]
    kept = journal.Journal.named()
    result = _Result(kept)
    tests = loader.discover(str(folder), top_level_dir=str(folder))
    if mark := os.environ.get("MOTUS_LEAVE_OUT"):
        tests = unittest.TestSuite(test for test in _tests(tests) if not _is_marked(test, mark))
    if ended := kept.outcomes():
        tests = unittest.TestSuite(test for test in _tests(tests) if test.id() not in ended)
    gc.freeze()  # Blender, the add-on and the tests stay: looking through them again and again would be a thirtieth of the time
    tests.run(result)
    failed = len(failed_tests(result))
    skipped = len(result.skipped)
    for test, reason in result.skipped:
        print(f"skipped: {test.id()}: {reason}")
    passed = max(result.testsRun - failed - skipped, 0)
    print(f"summary: {passed} passed, {failed} failed, {skipped} skipped", flush=True)
    return 1 if failed or not (result.testsRun or patterns) else 0


if __name__ == "__main__":
    sys.exit(run_folder(sys.argv[1], sys.argv[2:]))
