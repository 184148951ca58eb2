"""What broke in a group of tests, in a few lines: what CTest prints of it is long."""

import re
from pathlib import Path

_FRAME = re.compile(r'File "(.*)", line (\d+) in (\S+)')
_RUNNERS = ("suite.py", "run.py")


def what_broke(output):
    """Lines that name failed tests, and where Python and Blender stood when a signal ended the process."""
    return re.findall(r"^(?:FAILED|SUBFAILED|ERROR \S+::).*", output, re.MULTILINE) + _python_stacks(output) + _native_stack(output)


def _python_stacks(output):
    """The signal, and a line a thread, innermost call first, as faulthandler tells them."""
    fatal = re.search(r"^Fatal Python error: (.*)\n((?:(?!Extension modules:).*\n)*)", output, re.MULTILINE)
    if not fatal:
        return []
    threads = re.findall(r"^(Current thread|Thread) .*\n((?:[ ]{2}.*\n)*)", fatal[2], re.MULTILINE)
    is_elsewhere = any(name.startswith("Current") and not _calls(calls) for name, calls in threads)
    return [
        fatal[1],
        *filter(None, (_calls(calls) for _, calls in threads)),
        *(["in a thread that runs no Python"] if is_elsewhere else ()),
    ]


def _calls(thread):
    return " < ".join(
        f"{Path(path).name}:{line} {name}"
        for path, line, name in _FRAME.findall(thread)
        if "/unittest/" not in path and Path(path).name not in _RUNNERS
    )


def _native_stack(output):
    """The same of the library calls below the signal's handlers, from the file that Blender leaves."""
    log = re.search(r"^Writing: (.*\.crash\.txt)$", output, re.MULTILINE)
    if not log or not Path(log[1]).exists():
        return []
    calls = Path(log[1]).read_text(errors="replace").rpartition("(gsignal")[2].partition("# Python backtrace")[0]
    return [
        " < ".join(
            f"{Path(library).name.partition('.')[0]} {place}" for library, place in re.findall(r"^(\S+)\((.*)\) \[", calls, re.MULTILINE)
        )
    ]
