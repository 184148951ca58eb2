"""What is wrong with a native module for any platform is found: each fault is made by the compiler that makes those that are shipped."""

import os
import re
import subprocess
import tempfile
import unittest
from pathlib import Path

import pinned
import platforms

CI = Path(__file__).resolve().parents[1]
CACHE = Path(os.environ.get("MOTUS_CACHE") or Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache") / "motus")
TARGETS = {
    "linux-x64": "x86_64-linux-gnu.2.28",
    "windows-x64": "x86_64-windows-gnu",
    "macos-arm64": "aarch64-macos.11.0",
    "macos-x64": "x86_64-macos.11.0",
}
ENTRY = """
#ifdef _WIN32
#define SHOWN __declspec(dllexport)
#else
#define SHOWN __attribute__((visibility("default")))
#endif
#include <math.h>
SHOWN double PyInit_motus_native(double x) { return sin(x); }
"""
FLAGS = ("-shared", "-O2", "-g0")


class CheckModules(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        compiler, why_not = platforms.tools(CACHE)
        programs, why_not = pinned.installed("package", CACHE / "programs") if compiler else (None, why_not)
        if not programs:
            raise unittest.SkipTest(f"what modules are built and read with cannot be had: {why_not}")
        cls.zig, cls.python = compiler / "ziglang" / "zig", programs / "python"

    def setUp(self):
        temporary = tempfile.TemporaryDirectory(prefix="motus test ", dir="/var/tmp")
        self.addCleanup(temporary.cleanup)
        self.folder = Path(temporary.name)

    def build(self, name, *flags, source=ENTRY, target="", stripped=True, shown=False):
        """A module for a platform, or for another target in its stead."""
        module = self.folder / platforms.PLATFORMS[name].module("3.11")
        (self.folder / "module.c").write_text(source, encoding="utf-8")
        command = [
            self.zig,
            "cc",
            "-target",
            target or TARGETS[name],
            *FLAGS,
            *([] if shown else ["-fvisibility=hidden"]),
            *(["-s"] if stripped else []),
            *flags,
            "module.c",
            "-o",
            module,
        ]
        command += ["-install_name", "@rpath/module"] if "macos" in command[3] else []
        environment = os.environ | {"ZIG_GLOBAL_CACHE_DIR": str(CACHE / "zig"), "ZIG_LOCAL_CACHE_DIR": str(self.folder / "zig")}
        done = subprocess.run(command, cwd=self.folder, check=False, capture_output=True, text=True, env=environment)
        self.assertEqual(done.returncode, 0, done.stderr)
        return module

    def check(self, name):
        """(exit status, what is said)."""
        command = [self.python, CI / "check_modules.py", name, self.folder, "3.11"]
        done = subprocess.run(command, check=False, capture_output=True, text=True)
        self.assertIn("summary: ", done.stdout, done.stderr)
        return done.returncode, done.stdout

    def assert_found(self, name, pattern):
        status, said = self.check(name)
        self.assertEqual(status, 1, said)
        self.assertRegex(said, pattern)
        self.assertIn("summary: 0 passed, 1 failed", said)

    def test_a_module_as_it_should_be(self):
        for name in TARGETS:
            with self.subTest(name):
                self.build(name)
                status, said = self.check(name)
                self.assertEqual((status, said), (0, "summary: 1 passed, 0 failed, 0 skipped\n"))

    def test_none(self):
        self.assert_found("windows-x64", "is not built")

    def test_of_another_system(self):
        other = dict(zip(TARGETS, [*list(TARGETS)[1:], "linux-x64"]))
        for name in TARGETS:
            with self.subTest(name):
                self.build(name, target=TARGETS[other[name]])
                self.assert_found(name, "is no library of|is for X86_64, not ARM64|is for ARM64, not X86_64")

    def test_of_another_processor(self):
        for name, target in (
            ("linux-x64", "aarch64-linux-gnu.2.28"),
            ("windows-x64", "aarch64-windows-gnu"),
            ("macos-x64", "aarch64-macos.11.0"),
        ):
            with self.subTest(name):
                self.build(name, target=target)
                self.assert_found(name, r"is for (AARCH64|ARM64), not")

    def test_needs_a_newer_system(self):
        for name, target in (("linux-x64", "x86_64-linux-gnu.2.34"), ("macos-arm64", "aarch64-macos.12.0")):
            with self.subTest(name):
                threads = (
                    "#include <pthread.h>\n" + ENTRY + "SHOWN void *start(void) { pthread_t t; pthread_create(&t, 0, 0, 0); return 0; }"
                )
                self.build(name, target=target, source=threads)
                self.assert_found(name, r"needs version (2\.34|12\.0) of the system")

    def test_shows_more(self):
        for name in TARGETS:
            with self.subTest(name):
                self.build(name, source=ENTRY + "SHOWN int more(void) { return 1; }")
                self.assert_found(name, r"shows these symbols, not _?PyInit_motus_native alone: .*more")

    def test_types_of_functions_are_everybodys_on_macos(self):
        for symbol, is_well in {"__ZTIFvvE": True, "__ZTSPFPKcvE": True, "__ZTI6Widget": False, "__ZTIPFv6WidgetE": False}.items():
            with self.subTest(symbol):
                self.build("macos-x64", source=f'{ENTRY}SHOWN int more __asm__("{symbol}") = 1;')
                status, said = self.check("macos-x64")
                self.assertEqual(status == 0, is_well, said)

    def test_mathematics_of_its_own(self):
        """On Linux a product of complex numbers asks for zig's library, which has a sin as well; on Windows everything does."""
        angle = "double angle(double x) { return acos(x); }\n"
        product = "double _Complex product(double _Complex a, double _Complex b) { return a * b; }\n"
        toolchains, library = CI.parent / "native" / "cmake" / "toolchains", self.folder / "mathematics.lib"
        dlltool = (self.zig, "dlltool", "-m", "i386:x86-64", "-d", toolchains / "windows_mathematics.def", "-l", library)
        subprocess.run(dlltool, check=True)
        asking = toolchains / "zig_windows_mathematics.cpp"
        for name, source, flags, is_well in (
            ("linux-x64", angle, (), True),
            ("linux-x64", angle + product, (), False),
            ("windows-x64", angle, (), False),
            ("windows-x64", angle, (library,), False),
            ("windows-x64", angle + product, (asking, "-fmath-errno", library), True),
        ):
            with self.subTest(name, source=source):
                self.build(name, *flags, source=ENTRY + source)
                status, said = self.check(name)
                self.assertEqual(status == 0, is_well, said)
                self.assertEqual(bool(re.search("a sinf? of its own", said)), not is_well, said)

    def test_asks_for_another_library(self):
        library = self.build("linux-x64", "-Wl,-soname,libother.so.1", source="int other(void) { return 1; }", shown=True)
        library = library.rename(self.folder / "libother.so")
        self.build("linux-x64", library, source=ENTRY + "int other(void); SHOWN int more(void) { return other(); }")
        self.assert_found("linux-x64", r"needs libother\.so\.1 at run time")
        self.build(
            "windows-x64", "-lws2_32", source=ENTRY + "int __stdcall WSACleanup(void); SHOWN int more(void) { return WSACleanup(); }"
        )
        self.assert_found("windows-x64", r"(?i)needs ws2_32\.dll at run time")

    def test_is_not_stripped(self):
        self.build("linux-x64", "-g", stripped=False)
        self.assert_found("linux-x64", "is not stripped")

    def test_two_types_of_one_name(self):
        """Each in a file of its own, in a namespace without a name."""
        for name in TARGETS:
            with self.subTest(name):
                names = [f'char name_{number}[] = "N5motus8bindings12_GLOBAL__N_18SolutionE";' for number in (1, 2)]
                more = "SHOWN char *more(int i) { return i ? name_1 + i : name_2 - i; }"
                self.build(name, source=ENTRY + "\n".join((*names, more)))
                self.assert_found(name, "has 2 types with the name N5motus8bindings12_GLOBAL__N_18SolutionE")

    def test_names_a_path_of_the_machine_that_built_it(self):
        for name in TARGETS:
            with self.subTest(name):
                self.build(
                    name,
                    source=ENTRY + 'const char *where(void); const char *where(void) { return "/home/somebody/motus/a.hpp"; }'
                    'SHOWN const char *(*const more)(void) = where;',
                )
                self.assert_found(name, r"names a path of the machine that it was built on: /home/somebody/motus/a\.hpp")

    def test_is_too_large(self):
        self.build("linux-x64", source=ENTRY + "const char many[6 << 20] = {1}; SHOWN const char *more(int i) { return many + i; }")
        self.assert_found("linux-x64", "bytes, more than")

    def test_changed_after_it_was_signed(self):
        """Apple's processors end a program that loads such a module."""
        module = self.build("macos-arm64")
        content = bytearray(module.read_bytes())
        content[0x4000 + 8] ^= 1
        module.write_bytes(content)
        self.assert_found("macos-arm64", "has been changed since it was signed: page")

    def test_needs_no_older_system_than_it_is_told(self):
        self.build("linux-x64")
        command = [self.python, CI / "check_modules.py", "--oldest", "2.1", "linux-x64", self.folder, "3.11"]
        done = subprocess.run(command, check=False, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
        self.assertTrue(re.search(r"needs version 2\.2\.5 .* newer than 2\.1:", done.stdout), done.stdout)
