"""clang-tidy over several sources at once finds what it finds in each."""

import concurrent.futures
import tempfile
import unittest
from pathlib import Path

import tidy_groups

CLEAN = """
#include "shape.hpp"

namespace sample {{

int area_{0}(const Shape& shape) {{ return shape.width * shape.height + {0}; }}

}}  // namespace sample
"""
SHAPE = """#pragma once
namespace sample {
struct Shape {
    int width = 1;
    int height = 1;
};
}  // namespace sample
"""
FOUND = {  # what clang-tidy says: a source in which it says so
    "misc-unused-using-decls": "namespace other { struct Unused {}; }\nusing other::Unused;\n",
    "readability-else-after-return": "int sign(int a) { if (a < 0) { return -1; } else { return 1; } }\n",
    "clang-analyzer-core.NullDereference": "int read(const int* from) { if (from == nullptr) { return *from; } return 0; }\n",
    "misc-definitions-in-headers": '#include "defines.hpp"\n',
    "performance-unnecessary-value-param": "struct Large { Large(const Large&); ~Large(); int a; };\nint read(const Large large) { return large.a; }\n",
}


class Tidy(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory(prefix="motus test ")
        self.addCleanup(temporary.cleanup)
        self.folder = Path(temporary.name)
        self.topic = self.folder / "native" / "src" / "topic"  # .clang-tidy wants to hear of headers in such a folder
        self.topic.mkdir(parents=True)
        (self.topic / "shape.hpp").write_text(SHAPE, encoding="utf-8")
        (self.topic / "defines.hpp").write_text("#pragma once\nint defined() { return 1; }\n", encoding="utf-8")

    def source(self, name, text, flags="-O1", folder="-I/a"):
        path = self.topic / f"{name}.cpp"
        path.write_text(text, encoding="utf-8")
        return tidy_groups.Source({"file": str(path), "command": f"/usr/bin/c++ {folder} {flags} -std=c++20 -o '{name}.o' -c '{path}'"})

    def clean(self, count):
        return [self.source(f"clean{number}", CLEAN.format(number)) for number in range(count)]

    def outcomes(self, sources):
        """{name of a source: what is said of it, "" where it has passed}."""
        with concurrent.futures.ThreadPoolExecutor(2) as pool:
            found = {
                source.path.stem: "" if is_clean else output
                for source, is_clean, output in tidy_groups.check_all(sources, self.folder, pool)
            }
        self.assertEqual(found.keys(), {source.path.stem for source in sources})
        return found

    def test_all_kinds_of_findings_are_found_in_a_group(self):
        first, last = self.clean(2)
        self.assertEqual(tidy_groups.Group([first, last], self.folder).check(), (True, ""))
        for check, text in FOUND.items():
            with self.subTest(check):
                is_clean, output = tidy_groups.Group([first, self.source("found", text), last], self.folder).check()
                self.assertFalse(is_clean)
                self.assertIn(check, output)

    def test_a_finding_names_its_source_and_line(self):
        sources = self.clean(3)
        sources[1:1] = [self.source(f"found{number}", "\n" + text) for number, text in enumerate(FOUND.values())]
        found = self.outcomes(sources)
        for number, check in enumerate(FOUND):
            place = f"{self.topic / 'defines.hpp'}:2:" if "headers" in check else f"{self.topic / f'found{number}.cpp'}:"
            self.assertRegex(found.pop(f"found{number}"), rf"(?m)^{place}.*\[{check},-warnings-as-errors\]")
        self.assertEqual(set(found.values()), {""})

    def test_a_function_that_another_source_calls_is_analysed_by_itself(self):
        (self.topic / "read.hpp").write_text("#pragma once\nint read(const int* from);\n", encoding="utf-8")
        called = self.source(
            "called", '#include "read.hpp"\nint read(const int* from) { if (from == nullptr) { return *from; } return 0; }\n'
        )
        caller = self.source("caller", '#include "read.hpp"\nint one() { const int number = 1; return read(&number); }\n')
        is_clean, output = tidy_groups.Group([called, caller], self.folder).check()
        self.assertFalse(is_clean)
        self.assertIn("NullDereference", output)

    def test_sources_with_helpers_of_one_name_are_in_different_groups(self):
        helper = "namespace {{\nint helper() {{ return {0}; }}\n}}\nint use_{0}() {{ return helper(); }}\n"
        helped = [self.source(f"helped{number}", helper.format(number)) for number in range(2)]
        clean = self.clean(4)
        groups = tidy_groups.groups_of([clean[0], helped[0], clean[1], helped[1], *clean[2:]], self.folder)
        self.assertEqual(
            [[source.path.stem for source in group.sources] for group in groups],
            [["clean0", "helped0", "clean1", "clean2", "clean3"], ["helped1"]],
        )
        self.assertEqual(set(self.outcomes(clean + helped).values()), {""})

    def test_a_source_that_does_not_compile_is_found_and_the_others_pass(self):
        found = self.outcomes([self.source("broken", "int broken( {\n"), *self.clean(3)])
        self.assertIn("broken.cpp:1:", found.pop("broken"))
        self.assertEqual(set(found.values()), {""})

    def test_groups_have_the_same_flags_and_are_not_too_large(self):
        sources = [self.source(f"one{number}", "", flags=f"-O{number % 2}", folder=f"-I/{number}") for number in range(40)]
        lists = [*tidy_groups.alike(sources)]
        self.assertEqual(sorted(map(len, lists)), [10, 10, 10, 10])
        for those in lists:
            self.assertEqual(len({tuple(source.flags) for source in those}), 1)
        self.assertEqual({source for those in lists for source in those}, set(sources))

    def test_few_sources_are_checked_alone(self):
        groups = tidy_groups.groups_of(self.clean(tidy_groups.FEWEST - 1), self.folder)
        self.assertEqual([len(group.sources) for group in groups], [1] * (tidy_groups.FEWEST - 1))
