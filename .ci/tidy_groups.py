"""Sources that clang-tidy checks together, as one text in which the headers are read once.

Most of clang-tidy's time goes into the headers of pybind11, GLM and the standard library, anew for every source. A group of sources in which nothing
is found has passed. The sources of a group in which something is found are checked one by one: the finding then names its own file and line, and is
none that only the neighbours bring about.
"""

import bisect
import itertools
import re
import shlex
import subprocess
import tempfile
from pathlib import Path

CONFIG = Path(__file__).resolve().parents[1] / ".clang-tidy"
FEWEST, MOST = 3, 16  # sources in a group; the more there are, the more are checked again where something is found
ANEW = "#undef MOTUS_NEXT_SOURCE\n"  # a directive after which readability-duplicate-include lets a header be included again
# A function is analysed by itself also where another source of the group calls it, as it is when its source is checked alone.
IN_A_GROUP = ("--extra-arg=-Xclang", "--extra-arg=-analyzer-inlining-mode=all")
# A check that looks at nothing but directives: what is left of clang-tidy is the compiler.
COMPILE = ("--checks=-*,readability-duplicate-include", "--extra-arg=-ferror-limit=0")


class Source:
    """A source file, and what it is compiled with by its entry in a compilation database."""

    def __init__(self, entry):
        self.path = Path(entry["file"])
        _compiler, *arguments = shlex.split(entry["command"])
        for option in ("-o", "-c"):
            place = arguments.index(option)
            del arguments[place : place + 2]
        self.folders = [argument for argument in arguments if argument.startswith("-I")]
        self.flags = [argument for argument in arguments if argument not in self.folders]

    def check(self):
        return run_clang_tidy(self.path, self.folders + self.flags)


class Group:
    """Sources with the same flags in one file. It does not include them, because several checks look at the main file alone."""

    def __init__(self, sources, folder):
        self.sources = sources
        self._path = Path(tempfile.mkdtemp(dir=folder), "sources.cpp")
        texts = [f"{ANEW}{with_whole_names(source.path)}\n" for source in sources]
        self._last_lines = [*itertools.accumulate(text.count("\n") for text in texts)]
        self._path.write_text("".join(texts), encoding="utf-8")

    def check(self, options=IN_A_GROUP):
        folders = itertools.chain(*(source.folders for source in self.sources))
        return run_clang_tidy(self._path, [*dict.fromkeys(folders), *self.sources[0].flags], options)

    def clashing(self):
        """The sources that do not compile after those before them, because they have helpers of one name for example."""
        _, output = self.check(COMPILE)
        lines = map(int, re.findall(rf"^{re.escape(str(self._path))}:(\d+):\d+: error:", output, re.MULTILINE))
        numbers = {bisect.bisect_left(self._last_lines, line) for line in lines}
        return [self.sources[number] for number in sorted(numbers - {0})]


def run_clang_tidy(path, arguments, options=()):
    """(whether clang-tidy finds nothing, its output)."""
    done = subprocess.run(
        ["clang-tidy", "-quiet", f"--config-file={CONFIG}", *options, str(path), "--", *arguments],
        check=False,
        text=True,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
    )
    return done.returncode == 0, done.stdout


def with_whole_names(path):
    """The text of a source for another folder: the headers that lie beside the source are named with their folder."""

    def whole(match):
        beside = path.parent / match[2]
        return f'{match[1]}"{beside}"' if beside.is_file() else match[0]

    return re.sub(r'^( *# *include +)"([^"]+)"', whole, path.read_text(encoding="utf-8"), flags=re.MULTILINE)


def alike(sources):
    """Lists of at most MOST sources with the same flags. A topic's sources come into different lists: it is they that have helpers of one name."""
    by_flags = {}
    for source in sources:
        by_flags.setdefault(tuple(source.flags), []).append(source)
    for those in by_flags.values():
        count = -(-len(those) // MOST)
        yield from (those[first::count] for first in range(count))


def groups_of(sources, folder):
    """Groups in which these sources compile together; fewer than FEWEST are groups of one each, for which nothing is compiled."""
    groups = []
    while len(sources) >= FEWEST:
        group, left = Group(sources, folder), []
        while clashing := group.clashing():
            left += clashing
            group = Group([source for source in group.sources if source not in clashing], folder)
        groups.append(group)
        sources = left
    return groups + [Group([source], folder) for source in sources]


def check_all(sources, folder, pool):
    """Yields (source, whether clang-tidy finds nothing, its output); writes the groups into `folder`."""
    groups = [*itertools.chain(*pool.map(lambda those: groups_of(those, folder), alike(sources)))]
    alone = [group.sources[0] for group in groups if len(group.sources) == 1]
    groups = [group for group in groups if len(group.sources) > 1]
    for group, (is_clean, _) in zip(groups, pool.map(Group.check, groups)):
        if is_clean:
            yield from ((source, True, "") for source in group.sources)
        else:
            alone += group.sources
    for source, (is_clean, output) in zip(alone, pool.map(Source.check, alone)):
        yield source, is_clean, output
