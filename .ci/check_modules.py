"""Checks native modules that are shipped: check_modules.py [--oldest VERSION] PLATFORM FOLDER PYTHON...

Each is there, for that system and processor, runs on systems as old as promised, asks for nothing that a system has not, shows one symbol, tells
nothing of the machine that it was built on, has no two types of one name, is signed where Apple's processors want it, and is no larger than it may be.
`--oldest` is another oldest system, or glibc, than the platform's. Run by the programs of the group `package` of pyproject.toml.
"""

import argparse
import collections
import fnmatch
import hashlib
import re
import struct
import sys
from pathlib import Path

import lief

from platforms import PLATFORMS

LARGEST = 5 << 20
MAGIC = {"linux": lief.ELF.Binary, "windows": lief.PE.Binary, "macos": lief.MachO.Binary}
FOREIGN = re.compile(rb"/(?:root|home|tmp|work|build|Users|usr/src|usr/include|usr/lib/gcc)/[\x21-\x7e]+")
"""Paths that no system has where a module is used."""
UNNAMED = re.compile(rb"(?<=\0)\*?(N5motus\w*12_GLOBAL__N_1\w+)(?=\0)")
"""Names of types of namespaces without a name, as exceptions and pybind11 have them."""
ZIGS = re.compile(r"__mh_dylib_header|___dso_handle|__Z(n[wa]|d[la])\w+|__ZT[IS]P?F[a-zP0KR]+E")


class Seen:
    """What a module says of itself; a class a format below has the rest."""

    entry = "PyInit_motus_native"
    asked_for = frozenset()  # names of functions of the system
    mathematics = ()  # of which a module that asks for acos or atan2 has one of each set, where a compiler's library could stand in for them

    def __init__(self, binary, content):
        self.binary = binary
        self.content = content

    def other_problems(self):
        """Blender and the module have one mathematics: the system's, of which a compiler's own library has a part as well."""
        for names in self.mathematics if self.asked_for & {"acos", "atan2"} else ():
            if not self.asked_for & names:
                name = min(names, key=len)
                yield f"has a {name} of its own beside the system's acos: find what brings in the compiler's library, such as a product of complex numbers"


class Elf(Seen):
    """Of Linux."""

    machine = property(lambda self: self.binary.header.machine_type.name)
    libraries = property(lambda self: self.binary.libraries)
    shown = property(lambda self: {symbol.name for symbol in self.binary.exported_symbols})
    is_stripped = property(lambda self: not self.binary.has_section(".symtab"))
    asked_for = property(lambda self: {symbol.name for symbol in self.binary.imported_symbols})
    mathematics = ({"sin", "sincos"},)

    @property
    def oldest(self):
        """The newest version of glibc that a symbol is asked of."""
        versions = [version.name for library in self.binary.symbols_version_requirement for version in library.get_auxiliary_symbols()]
        return max(
            tuple(map(int, version.removeprefix("GLIBC_").split("."))) for version in versions if re.fullmatch(r"GLIBC_[\d.]+", version)
        )


class Pe(Seen):
    """Of Windows."""

    machine = property(lambda self: self.binary.header.machine.name)
    libraries = property(lambda self: [library.name for library in self.binary.imports])
    shown = property(lambda self: {entry.name for entry in self.binary.get_export().entries})
    is_stripped = property(lambda self: self.binary.header.numberof_symbols == 0)
    asked_for = property(lambda self: {entry.name for library in self.binary.imports for entry in library.entries})
    mathematics = ({"sin"}, {"sinf"})

    @property
    def oldest(self):
        """Version of Windows."""
        header = self.binary.optional_header
        return max(
            (header.major_subsystem_version, header.minor_subsystem_version),
            (header.major_operating_system_version, header.minor_operating_system_version),
        )


class MachO(Seen):
    """Of macOS."""

    entry = "_PyInit_motus_native"
    machine = property(lambda self: self.binary.header.cpu_type.name)
    libraries = property(
        lambda self: [library.name for library in self.binary.libraries if library.command != lief.MachO.LoadCommand.TYPE.ID_DYLIB]
    )
    # Zig's linker, which is given no list of what to show, shows two names of its own, the standard library's functions that allocate (macOS takes its
    # own ones for these, which do the same), and on Intel's processors the types of functions of plain values, which are the same in every library.
    shown = property(lambda self: {one.symbol.name for one in self.binary.dyld_info.exports if not ZIGS.fullmatch(one.symbol.name)})
    oldest = property(lambda self: tuple(self.binary.build_version.minos[:2]))

    is_stripped = True  # zig leaves names in; packed, the module is smaller than others nevertheless

    def other_problems(self):
        """Apple's processors run nothing that is not signed; by anybody will do."""
        if self.machine == "ARM64" or self.binary.has_code_signature:
            yield from signature_problems(self.binary, self.content)


READERS = {"linux": Elf, "windows": Pe, "macos": MachO}


def signature_problems(binary, content):
    """What is wrong with a signature by nobody in particular: a checksum of each page of the file."""
    if not binary.has_code_signature:
        yield "is not signed: Apple's processors do not run it"
        return
    blob = bytes(binary.code_signature.content)
    places = (struct.unpack_from(">2I", blob, 12 + 8 * number) for number in range(struct.unpack_from(">I", blob, 8)[0]))
    directory = blob[next(place for kind, place in places if kind == 0) :]
    magic, _, _, flags, hashes, _, _, count, limit = struct.unpack_from(">9I", directory)
    size, kind, _, page = struct.unpack_from(">4B", directory, 36)
    if (magic, kind, size) != (0xFADE0C02, 2, 32) or not flags & 2:
        yield "has a signature that is not ad hoc, by SHA-256"
        return
    for number in range(count):
        start = number << page
        wanted = directory[hashes + size * number : hashes + size * (number + 1)]
        if hashlib.sha256(content[start : min(start + (1 << page), limit)]).digest() != wanted:
            yield f"has been changed since it was signed: page {number} of {count}"
            return


def problems(platform, path, python, oldest):
    """Sentences about what is wrong with one module."""
    content = path.read_bytes()
    binary = lief.parse(path)
    if not isinstance(binary, MAGIC[platform.system]):
        yield f"is no library of {platform.system}"
        return
    seen = READERS[platform.system](binary, content)
    if seen.machine != platform.machine:
        yield f"is for {seen.machine}, not {platform.machine}"
    if seen.oldest > oldest:
        yield (
            f"needs version {'.'.join(map(str, seen.oldest))} of the system or of glibc, newer than {'.'.join(map(str, oldest))}: "
            "find what brings it in (std::random_device does) and do without"
        )
    allowed = [library.format(minor=python.partition(".")[2]) for library in platform.libraries]
    for library in seen.libraries:
        if not any(fnmatch.fnmatch(library.lower() if platform.system == "windows" else library, pattern) for pattern in allowed):
            yield f"needs {library} at run time: link it statically"
    if seen.shown != {seen.entry}:
        yield f"shows these symbols, not {seen.entry} alone: {', '.join(sorted(seen.shown)[:10])}"
    if not seen.is_stripped:
        yield "is not stripped"
    if found := FOREIGN.search(content):
        yield f"names a path of the machine that it was built on: {found[0][:200].decode()}"
    for name, count in collections.Counter(UNNAMED.findall(content)).items():
        if count > 1:
            yield f"has {count} types with the name {name.decode()}: on macOS, where names are compared, pybind11 takes them for one"
    if len(content) > LARGEST:
        yield f"has {len(content):,} bytes, more than {LARGEST:,}"
    yield from seen.other_problems()


def main(arguments):
    """Checks the modules of a platform; returns the exit status."""
    parser = argparse.ArgumentParser(prog="check_modules.py")
    parser.add_argument("--oldest", default="")
    parser.add_argument("platform", choices=PLATFORMS)
    parser.add_argument("folder", type=Path)
    parser.add_argument("pythons", nargs="+")
    options = parser.parse_args(arguments)
    lief.logging.disable()  # it tells of what it does not understand of zig's libraries for macOS, which is not asked for
    platform = PLATFORMS[options.platform]
    oldest = tuple(map(int, options.oldest.split("."))) if options.oldest else platform.oldest
    failed = 0
    for python in options.pythons:
        path = options.folder / platform.module(python)
        found = list(problems(platform, path, python, oldest)) if path.is_file() else ["is not built"]
        for sentence in found:
            print(f"FAILED {platform.name}: {path.name} {sentence}")
        failed += bool(found)
    print(f"summary: {len(options.pythons) - failed} passed, {failed} failed, 0 skipped")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
