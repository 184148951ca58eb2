"""Hand the open file over: a second Blender works on a copy of it, so that nothing changes in this one.

Beside the file FILM.blend that is to be written stand, while the work lasts, FILM.motus-copy.blend, a copy of the open file, and
FILM.motus-new.blend, the result, which takes the place of FILM.blend only when it is whole. What a session left that was ended in between is
removed by the next one that writes the same file.
"""

import json
import os
import shlex
import shutil
import tempfile
import time
from contextlib import suppress
from pathlib import Path

import bpy

from ..core.refusals import Refused
from ..core.translations import tr
from .formats import FORMATS
from .second import MARK

PROGRAM = "MOTUS_BLENDER_PROGRAM"
"""Environment variable with the command that starts a Blender, for a Blender that is a module of Python and has no program of its own."""
WAIT = 0.05
"""Seconds between two looks at what the second Blender has told."""
_SCRIPT = Path(__file__).with_name("worker.py")
_PACKAGE = __package__.rpartition(".")[0]


def program():
    """The command that starts a Blender such as this one. Raises Refused if there is none."""
    command = [bpy.app.binary_path] if bpy.app.binary_path else shlex.split(os.environ.get(PROGRAM, ""))
    if not command:
        raise Refused(tr("This Blender is a module of Python: let {variable} be the command of a Blender").format(variable=PROGRAM))
    return command


def target(text):
    """The path of the file to be written. Raises Refused if nothing can be written there. text: path as the user has given it."""
    if not text:
        raise Refused(tr("Name the file that is to be written"))
    path = Path(bpy.path.abspath(text)).absolute()
    if path.suffix != ".blend":
        path = path.with_name(f"{path.name}.blend")
    if path.is_dir():
        raise Refused(tr("{path} is a folder: name a file").format(path=path))
    if bpy.data.filepath and _is_same(path, Path(bpy.data.filepath)):
        raise Refused(tr("{path} is the open file itself: name another one").format(path=path))
    if not path.parent.is_dir():
        raise Refused(tr("There is no folder {path}").format(path=path.parent))
    try:
        with tempfile.TemporaryFile(dir=path.parent):
            pass
    except OSError as error:
        raise Refused(tr("Nothing can be written into {path}: {reason}").format(path=path.parent, reason=error.strerror)) from None
    return path


def _is_same(one, other):
    with suppress(OSError):
        return one.samefile(other)
    return False


def hand_over(scene, view_layer, path, frames, formats=(), span=()):
    """Write the file: a generator of the number of frames done. Raises Refused with the reason if it cannot be written.

    The file that was there stays until the new one is whole. path: of the file, as target() gives it. frames: of the time line.
    formats: keys of FORMATS, in which files are written beside it. span: (first, last) frame of these.
    """
    copy, new, caches = (beside(path, part) for part in ("copy.blend", "new.blend", "caches"))
    # Each file or folder that is written, and the place that it gets when all are there.
    placed = {caches: caches_of(path), new: path}
    placed |= {beside(path, f"new{FORMATS[one].suffix}"): path.with_suffix(FORMATS[one].suffix) for one in formats}
    process = None
    try:
        _remove(copy, *placed)
        _save_copy(copy)
        given = {
            "package": _PACKAGE,
            "source": str(copy),
            "result": str(new),
            "caches": str(caches),
            "caches_name": caches_of(path).name,
            "scene": scene.name,
            "layer": view_layer.name,
            "frames": frames,
            "formats": sorted(formats),
            "span": span,
        }
        import subprocess

        with tempfile.TemporaryFile("w+b") as said:
            # Signals stay as they are: a file that grows too large is an error then, which has a sentence.
            process = subprocess.Popen(
                _command(given), stdin=subprocess.DEVNULL, stdout=said, stderr=subprocess.STDOUT, restore_signals=False
            )
            yield from _followed(process, said)
        _put(path, placed)
    finally:
        if process is not None and process.poll() is None:
            process.kill()
            process.wait()
        _remove(copy, *placed)


def beside(path, part):
    """The path of a file that stands beside the one to be written while the work lasts. part: end of its name."""
    return path.with_name(f"{path.stem}.motus-{part}")


def caches_of(path):
    """The folder beside a handed-over file that has its caches."""
    return path.with_name(f"{path.stem}_caches")


def _command(given):
    # The user's own preferences, since other add-ons may have drivers in the file.
    scripts = "--enable-autoexec" if bpy.context.preferences.filepaths.use_scripts_auto_execute else "--disable-autoexec"
    return [*program(), "--background", scripts, "--addons", _PACKAGE, "--python", str(_SCRIPT), "--", json.dumps(given)]


def _save_copy(copy):
    try:
        bpy.ops.wm.save_as_mainfile(filepath=str(copy), copy=True, compress=False)
    except RuntimeError as error:
        raise Refused(tr("No copy of the open file could be written: {reason}").format(reason=_last_line(str(error)))) from None


def _followed(process, said):
    """Yield the number of frames done, as the second Blender tells it. Raises Refused if it does not save the file. said: its output."""
    begun, is_saved, place = 0, False, 0
    while True:
        is_over = process.poll() is not None
        said.seek(place)
        *lines, _ = said.read().split(b"\n")
        place += sum(len(line) + 1 for line in lines)
        for line in (one.decode(errors="replace") for one in lines):
            if line.startswith(MARK):
                facts = json.loads(line.removeprefix(MARK))
                if "refused" in facts:
                    raise Refused(facts["refused"])
                begun, is_saved = facts.get("done", begun), is_saved or "saved" in facts
        if is_over:
            break
        yield begun
        time.sleep(WAIT)
    if not is_saved:
        said.seek(0)
        reason = _last_line(said.read().decode(errors="replace")) or str(process.returncode)
        raise Refused(tr("The second Blender has ended without a result: {reason}").format(reason=reason))


def _put(path, placed):
    """Put new files into their places. The former ones come back if that fails. placed: {new file or folder: its place}."""
    formers = {}
    try:
        for new, place in placed.items():
            former = place.with_name(f"{place.name}.motus-former")
            if former.exists() and not place.exists():  # a session was ended between the two steps that follow
                os.replace(former, place)
            _remove(former)
            if place.exists():
                os.replace(place, former)
                formers[place] = former
            if new.exists():
                os.replace(new, place)
    except OSError as error:
        for place, former in formers.items():
            _remove(place)
            os.replace(former, place)
        raise Refused(tr("{path} could not be written: {reason}").format(path=path, reason=error.strerror)) from None
    _remove(*formers.values())


def _last_line(text):
    lines = [line.strip() for line in text.splitlines() if line.strip()]
    return lines[-1] if lines else ""


def _remove(*paths):
    for path in paths:
        if path.is_dir():
            shutil.rmtree(path, ignore_errors=True)
        else:
            path.unlink(missing_ok=True)
