"""Checks the native modules that are shipped: check_modules.py DIR ABI...

Each ABI is there, is loadable on systems as old as promised, needs no C++ runtime, and shows one symbol.
"""

import re
import subprocess
import sys
from pathlib import Path

NEWEST_GLIBC = (2, 35)
ALLOWED_LIBRARIES = {"libc.so.6", "libm.so.6", "ld-linux-x86-64.so.2"}


def output_of(*command):
    """What a command prints."""
    return subprocess.run(command, text=True, check=True, capture_output=True).stdout


def problems(module):
    """Sentences about what is wrong with one module."""
    symbols = output_of("objdump", "--dynamic-syms", str(module)).splitlines()
    for line in symbols:
        version = re.search(r"GLIBC_(\d+)\.(\d+)", line)
        if version and tuple(map(int, version.groups())) > NEWEST_GLIBC:
            yield (
                f"needs {line.split()[-1]} of {version.group()}, newer than GLIBC_{NEWEST_GLIBC[0]}.{NEWEST_GLIBC[1]}: "
                "find what brings it in (std::random_device does) and do without"
            )
    for library in re.findall(r"NEEDED\s+(\S+)", output_of("objdump", "--private-headers", str(module))):
        if library not in ALLOWED_LIBRARIES:
            yield f"needs {library} at run time: link it statically"
    visible = {line.split()[-1] for line in symbols if " g " in line and "*UND*" not in line and ".text" in line}
    if visible != {"PyInit_motus_native"}:
        yield f"shows these symbols, not PyInit_motus_native alone: {', '.join(sorted(visible)[:10])}"
    if " .symtab" in output_of("objdump", "--section-headers", str(module)):
        yield "is not stripped"


def main(folder, *abis):
    """Checks the module of each Python in `folder`; returns the exit status."""
    failed = 0
    for abi in abis:
        module = Path(folder, f"motus_native.{abi}.so")
        found = list(problems(module)) if module.is_file() else ["is not built"]
        for sentence in found:
            print(f"FAILED {module.name} {sentence}")
        failed += bool(found)
    print(f"summary: {len(abis) - failed} passed, {failed} failed, 0 skipped")
    return 1 if failed else 0


sys.exit(main(*sys.argv[1:]))
