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
import kept_tests


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


def run_folder(folder, patterns=(), about=()):
    """Runs folder/test_*.py, or of it the tests whose id contains one of `patterns`; returns the exit status.

    Those with the attribute that the environment variable MOTUS_LEAVE_OUT names are left out, and those that the journal has. about: lines
    that say what is tested, and by what: files of which all tests have passed before are then passed without being run (kept_tests.py).
    """
    faulthandler.enable()  # a process that a signal ends says which test it was in
    with bytecode.kept_for_children():
        return _run(folder, patterns, about)


def _run(folder, patterns, about):
    sys.path.insert(0, str(folder))
    loader = unittest.TestLoader()
    if patterns:
        loader.testNamePatterns = [f"*{pattern}*" for pattern in patterns]
    ended = journal.Journal.named()
    result = _Result(ended)
    known = ended.outcomes()
    mark = os.environ.get("MOTUS_LEAVE_OUT", "")
    modules = _by_module(loader.discover(str(folder), top_level_dir=str(folder)))
    before = kept_tests.KeptTests.named(folder, modules, [mark, *about]) if about and not patterns else None
    gc.freeze()  # Blender, the add-on and the tests stay: looking through them again and again would be a thirtieth of the time
    kept = {}
    for module, tests in modules.items():
        wanted = [test for test in tests if not (mark and _is_marked(test, mark))]
        left = [test for test in wanted if test.id() not in known]
        if before is None or len(left) < len(wanted):
            unittest.TestSuite(left).run(result)
        elif number := before.count(module):
            kept[module] = number
        else:
            with before.watched(module) as note:
                failed = _not_passed(result)
                unittest.TestSuite(left).run(result)
                if left and _not_passed(result) == failed:
                    note(len(left))
    has_failed = _summary(result, kept)
    return 1 if has_failed or not (result.testsRun or kept or patterns) else 0


def _by_module(suite):
    """{name of a module: its tests, in their order}."""
    found = {}
    for test in _tests(suite):
        found.setdefault(type(test).__module__, []).append(test)
    return found


def _not_passed(result):
    return len(result.failures) + len(result.errors) + len(result.unexpectedSuccesses) + len(result.skipped)


def _summary(result, kept):
    """Prints what has become of the tests; returns whether some failed. kept: {module: number of its tests, which passed before}."""
    failed = len(failed_tests(result))
    skipped = len(result.skipped)
    for test, reason in result.skipped:
        print(f"skipped: {test.id()}: {reason}")
    if kept:
        print(f"kept: {sum(kept.values())} tests in {len(kept)} files have passed before, just as they are")
    passed = max(result.testsRun - failed - skipped, 0) + sum(kept.values())
    print(f"summary: {passed} passed, {failed} failed, {skipped} skipped", flush=True)
    return failed > 0


if __name__ == "__main__":
    sys.exit(run_folder(sys.argv[1], sys.argv[2:]))
