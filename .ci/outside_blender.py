"""Runs tests that need no Blender, by pytest: outside_blender.py FOLDER [PATTERN...]; called by `./motus test`."""

import os
import sys

import pytest

import bytecode

SLOW = 2.0
"""Processor seconds from which a test is listed, as suite.py lists those inside Blender."""


class Slow:
    """A plugin of pytest: what slow tests take of the processor, with what is made ready before them and the processes that they start."""

    @pytest.hookimpl(wrapper=True)
    def pytest_runtest_protocol(self, item):
        started = sum(os.times()[:4])
        result = yield
        seconds = sum(os.times()[:4]) - started
        if seconds > SLOW:
            print(f"\nslow: {item.nodeid} {seconds:.1f} s", flush=True)
        return result


class Choice:
    """A plugin of pytest: runs the tests whose id contains one of `patterns`, or all, and ends with the summary line that test.py reads."""

    def __init__(self, patterns):
        self.patterns = patterns

    def pytest_collection_modifyitems(self, config, items):
        if self.patterns:
            left_out = [item for item in items if not self._is_chosen(item)]
            items[:] = filter(self._is_chosen, items)
            config.hook.pytest_deselected(items=left_out)

    def _is_chosen(self, item):
        # test_curve.CurveTest.test_length, as unittest names a test
        name = item.nodeid.rpartition("/")[2].replace(".py::", ".").replace("::", ".")
        return any(pattern in name for pattern in self.patterns)

    @pytest.hookimpl(trylast=True)
    def pytest_sessionfinish(self, session, exitstatus):
        if self.patterns and exitstatus == pytest.ExitCode.NO_TESTS_COLLECTED:
            session.exitstatus = pytest.ExitCode.OK

    def pytest_unconfigure(self, config):
        reports = config.pluginmanager.get_plugin("terminalreporter").stats
        failed, skipped, passed = (self._names(reports, *kinds) for kinds in (("failed", "error"), ("skipped",), ("passed",)))
        skipped -= failed  # a test of which some subtests failed
        passed -= failed | skipped
        print(f"summary: {len(passed)} passed, {len(failed)} failed, {len(skipped)} skipped", flush=True)

    @staticmethod
    def _names(reports, *kinds):
        return {report.nodeid for kind in kinds for report in reports.get(kind, ())}


def main(folder, *patterns):
    """Returns the exit status. What is slow, failed or skipped is listed."""
    options = ("--quiet", "-rfEs", "-p", "no:cacheprovider")
    with bytecode.kept_for_children():
        return pytest.main([*options, folder], plugins=[Slow(), Choice(patterns)])


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
