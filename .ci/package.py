"""Makes the two zips of the add-on from its sources and the built native modules, unless they are up to date.

package.py --modules FILE... --stage DIR --dist DIR [-- BLENDER COMMAND...]

DIST/motus-VERSION-extension.zip  extension, Blender 4.2 on: made by `extension build` of the Blender given (4.2 or later), or
                                  without one as the same plain zip
DIST/motus-VERSION-legacy.zip     add-on, Blender 3.4-4.1: a folder motus/, with a bl_info made from the manifest
"""

import argparse
import ast
import hashlib
import json
import re
import shutil
import subprocess
import sys
import tomllib
import zipfile
from pathlib import Path

CLONE = Path(__file__).resolve().parents[1]
sys.path.append(str(CLONE / "docs" / "site"))

import plain  # noqa: E402  (found by the line above)

SOURCES = CLONE / "addon" / "motus"
IGNORED = shutil.ignore_patterns("__pycache__", ".*", "*.in")
MANIFEST = "blender_manifest.toml"
EPOCH = (1980, 1, 1, 0, 0, 0)  # fixed times: the same content gives the same zip


def version():
    """The version of everything, which CMakeLists.txt states."""
    text = (CLONE / "CMakeLists.txt").read_text(encoding="utf-8")
    return re.search(r"^project\(motus VERSION ([0-9.]+)", text, re.MULTILINE)[1]


def stub():
    """The signatures of the native module."""
    return CLONE / "native" / "bindings" / "motus_native.pyi"


def stage(folder, modules, platforms=("linux-x64",), wheels=()):
    """Fills `folder` with what an installed add-on for these platforms consists of: with native modules, or with wheels of it for an extension."""
    shutil.rmtree(folder, ignore_errors=True)
    shutil.copytree(SOURCES, folder, ignore=IGNORED)
    manifest = (SOURCES / f"{MANIFEST}.in").read_text(encoding="utf-8")
    for name, value in (
        ("VERSION", version()),
        ("PLATFORMS", json.dumps(list(platforms))),
        ("WHEELS", json.dumps([f"./wheels/{wheel.name}" for wheel in wheels])),
    ):
        manifest = manifest.replace(f"@MOTUS_{name}@", value)
    (folder / MANIFEST).write_text(manifest, encoding="utf-8")
    shutil.copy2(CLONE / "LICENSE", folder)
    plain.write(CLONE, folder / "manual")
    for module in modules:
        shutil.copy2(module, folder)
    for wheel in wheels:
        (folder / "wheels").mkdir(exist_ok=True)
        shutil.copy2(wheel, folder / "wheels")


def stage_legacy(folder, modules, platforms=("linux-x64",)):
    """What stage() does, for Blender before 4.2."""
    stage(folder, modules, platforms)
    manifest = tomllib.loads((folder / MANIFEST).read_text(encoding="utf-8"))
    package = folder / "__init__.py"
    package.write_text(insert_bl_info(package.read_text(encoding="utf-8"), manifest), encoding="utf-8")


def digest(*folders):
    """One number for all names and contents below the folders."""
    total = hashlib.sha256()
    for path in sorted(path for folder in folders for path in folder.rglob("*") if path.is_file()):
        content = path.read_bytes()
        total.update(f"{path.name}\0{path.parent}\0{len(content)}\0".encode())
        total.update(content)
    return total.hexdigest()


def bl_info(manifest):
    """The description that Blender before 4.2 reads instead of the manifest."""
    info = {
        "name": manifest["name"],
        "description": manifest["tagline"],
        "author": manifest["maintainer"],
        "version": tuple(int(part) for part in manifest["version"].split(".")),
        "blender": (3, 4, 0),
        "location": "3D View > Sidebar > Motus",
        "category": "Animation",
    }
    lines = "".join(f"    {key!r}: {value!r},\n" for key, value in info.items())
    return f"bl_info = {{\n{lines}}}\n"


def insert_bl_info(source, manifest):
    """`source` of the package with bl_info at the first place where a statement may stand."""
    after = 0
    for statement in ast.parse(source).body:
        is_docstring = isinstance(statement, ast.Expr) and isinstance(statement.value, ast.Constant)
        is_future = isinstance(statement, ast.ImportFrom) and statement.module == "__future__"
        if not (is_docstring or is_future):
            break
        after = statement.end_lineno
    lines = source.splitlines(keepends=True)
    return "".join(lines[:after]) + "\n" + bl_info(manifest) + "".join(lines[after:])


def write_zip(path, folder, prefix):
    """Writes all files below `folder` into a zip, their names with `prefix` in front.

    `prefix` has an entry of its own. By that Blender before 4.2 knows which folder of an older version it has to remove: without it the files
    are written over the old ones, the native module too, which a running Blender has mapped, and Blender crashes.
    """
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
        if prefix:
            entry = zipfile.ZipInfo(prefix, EPOCH)
            entry.external_attr = 0o40755 << 16
            archive.writestr(entry, b"")
        for file in sorted(file for file in folder.rglob("*") if file.is_file()):
            entry = zipfile.ZipInfo(prefix + file.relative_to(folder).as_posix(), EPOCH)
            entry.compress_type = zipfile.ZIP_DEFLATED
            entry.external_attr = 0o644 << 16
            archive.writestr(entry, file.read_bytes())


def extension_build(blender, *options):
    """Lets Blender make zips, which checks the manifest."""
    command = [*blender, "--command", "extension", "build", *map(str, options)]
    done = subprocess.run(command, text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, check=False)
    if done.returncode:
        sys.exit(f"{done.stdout}\nmotus: `extension build` failed, see above")


def build_extension(blender, folder, path):
    """Lets Blender make the zip; a plain zip where there is no Blender that can."""
    if blender:
        extension_build(blender, "--source-dir", folder, "--output-filepath", path)
    else:
        write_zip(path, folder, "")


def main(arguments):
    """Makes the zips, unless they are up to date."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--modules", type=Path, nargs="+", required=True, help="native modules, a file for each Python")
    for name in ("--stage", "--dist"):
        parser.add_argument(name, type=Path, required=True)
    parser.add_argument("blender", nargs="*", help="command that runs a Blender of 4.2 or later")
    options = parser.parse_args(arguments)

    extension = options.dist / f"motus-{version()}-extension.zip"
    legacy = options.dist / f"motus-{version()}-legacy.zip"

    stamp = options.stage / "stamp"
    extension_stage, legacy_stage = options.stage / "extension", options.stage / "legacy"
    stage(extension_stage, options.modules)
    content = digest(extension_stage, Path(__file__).parent)
    if extension.exists() and legacy.exists() and stamp.exists() and stamp.read_text() == content:
        return

    stamp.unlink(missing_ok=True)
    stage_legacy(legacy_stage, options.modules)
    options.dist.mkdir(parents=True, exist_ok=True)
    for old in options.dist.glob("motus-*.zip"):
        old.unlink()
    build_extension(options.blender, extension_stage, extension)
    write_zip(legacy, legacy_stage, "motus/")
    stamp.write_text(content)
    abis = ", ".join(module.name.split(".")[1].split("-x86")[0] for module in options.modules)
    print(f"motus: packaged {extension.name} and {legacy.name} in {options.dist} (native modules: {abis})", file=sys.stderr)


if __name__ == "__main__":
    main(sys.argv[1:])
