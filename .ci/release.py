"""What `./motus release` hands over, from the one version number that CMakeLists.txt states.

release.py check             refuses a state that may not be released, with a sentence each thing
release.py write FROM DIST   copies the zips and wheels of all platforms from the folder FROM into the folder DIST, with their checksums, SHA256SUMS,
                             and what has changed, RELEASE_NOTES.md; DIST is whole or not there
"""

import hashlib
import re
import shutil
import subprocess
import sys
from pathlib import Path

import package
from platforms import PLATFORMS, PYTHONS

CLONE = package.CLONE
NOTES, SUMS = "RELEASE_NOTES.md", "SHA256SUMS"
FILES = """## Which file

| file | for |
|---|---|
{rows}
Put a zip into Blender as it is: *Preferences > Get Extensions > Install from Disk*, or before 4.2 *Preferences > Add-ons > Install*. A wheel is the
mathematics alone, for `pip install` into a Python without Blender. `sha256sum --check SHA256SUMS` tells whether the files are whole.

Made from commit {commit}.
"""
SYSTEMS = {
    "linux-x64": "Linux, x86-64",
    "windows-x64": "Windows, x86-64",
    "macos-arm64": "macOS on Apple's processors",
    "macos-x64": "macOS on Intel's processors",
}


def git(clone, *arguments):
    """What git prints of a clone."""
    done = subprocess.run(["git", "-C", clone, *arguments], check=False, text=True, capture_output=True)
    return done.stdout.strip()


def section(changelog, version):
    """(date, text) of a version's section in the text of a changelog; ("", "") if it has none."""
    found = re.search(rf"^## \[{re.escape(version)}\] - (.+)\n((?:(?!## ).*\n?)*)", changelog, re.MULTILINE)
    return (found[1].strip(), found[2].strip()) if found else ("", "")


def refusals(clone, version):
    """Why the state of a clone may not be released, a sentence each."""
    changed = git(clone, "status", "--porcelain").splitlines()
    if changed:
        yield f"there are changes that are not committed: {', '.join(line[2:].strip() for line in changed[:5])}{', ...' if changed[5:] else ''}"
    date, text = section((clone / "CHANGELOG.md").read_text(encoding="utf-8"), version)
    if not text:
        yield f"CHANGELOG.md has no section of version {version}, or an empty one"
    elif not re.fullmatch(r"\d{4}-\d\d-\d\d", date):
        yield f"the heading of version {version} in CHANGELOG.md has no date, but says {date}"
    tagged = git(clone, "rev-parse", "--quiet", "--verify", f"v{version}^{{commit}}")
    if tagged and tagged != git(clone, "rev-parse", "HEAD"):
        yield f"v{version} was released already, from commit {tagged[:8]}: raise the version in CMakeLists.txt"


def files_of(platform, version):
    """{name of a file of a platform: what it is for}."""
    system, name = SYSTEMS[platform.name], platform.name.replace("-", "_")
    found = {
        f"motus-{version}-{name}.zip": f"Blender 4.2 and later, {system}",
        f"motus-{version}-{name}-legacy.zip": f"Blender 3.4 to 4.1 with Python 3.11, {system}",
    }
    for python in PYTHONS:
        tag = f"cp{python.replace('.', '')}"
        found[f"motus_native-{version}-{tag}-{tag}-{platform.wheel}.whl"] = f"Python {python} without Blender, {system}"
    return found


def notes(clone, version, files):
    """The text of RELEASE_NOTES.md. files: {name: what it is for}."""
    date, text = section((clone / "CHANGELOG.md").read_text(encoding="utf-8"), version)
    rows = "".join(f"| `{name}` | {purpose} |\n" for name, purpose in files.items())
    below = FILES.format(rows=rows, commit=git(clone, "rev-parse", "HEAD"))
    return f"# Motus {version}\n\n{date}\n\n{text}\n\n{below}"


def write(clone, version, source, dist):
    """Fills the folder `dist`; exits where a file is missing."""
    files = {name: purpose for platform in PLATFORMS.values() for name, purpose in files_of(platform, version).items()}
    if missing := [name for name in files if not (source / name).is_file()]:
        sys.exit(f"motus: a release is for all platforms, and these files were not made: {', '.join(missing)}")
    half = dist.with_name(f"{dist.name}.half")
    shutil.rmtree(half, ignore_errors=True)
    half.mkdir(parents=True)
    for name in files:
        shutil.copyfile(source / name, half / name)
    (half / NOTES).write_text(notes(clone, version, files), encoding="utf-8")
    sums = [f"{hashlib.sha256((half / name).read_bytes()).hexdigest()}  {name}\n" for name in (*files, NOTES)]
    (half / SUMS).write_text("".join(sums), encoding="utf-8")
    shutil.rmtree(dist, ignore_errors=True)
    half.rename(dist)


def main(task, *folders):
    """Returns the exit status."""
    version = package.version()
    if task == "check":
        found = list(refusals(CLONE, version))
        for sentence in found:
            print(f"motus: {sentence}", file=sys.stderr)
        return 1 if found else 0
    source, dist = map(Path, folders)
    write(CLONE, version, source, dist / version)
    for path in sorted((dist / version).iterdir()):
        print(path)
    return 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
