"""Covers that other processes have computed: files in the folder that the environment variable MOTUS_PLANS names.

Every frame of a render farm is a process of its own, and would find anew where all flakes land. A file is named after all that its cover is
computed from, and by what, so it is never out of date. Without the variable nothing is read or written.
"""

import hashlib
import logging
import os
from contextlib import suppress
from pathlib import Path

import mathutils

from ...core import native
from ...core.lazy import numpy as np

log = logging.getLogger(__name__)

FOLDER = "MOTUS_PLANS"
MOST_BYTES = 1 << 30
"""Size of the largest file that is read: twice what a cover of the most flakes takes."""


def find(plan, fall, smoothing, vertex_count):
    """Return the native SnowCover of one Fall of a Plan; None if no file has it.

    smoothing: rounds of smoothing. vertex_count: number of vertices of the ground on which the snow lies.
    """
    path = _path(plan, fall, smoothing)
    try:
        if path is None or path.stat().st_size > MOST_BYTES:
            return None
        found = native.module.SnowCover.restored(path.read_bytes())
    except (OSError, ValueError):  # there is no such file, or it is not a cover's
        return None
    return found if found.vertex_count == vertex_count else None


def put(plan, fall, smoothing, cover):
    """Write a native SnowCover into a file, for find() with the same arguments. A folder that cannot be written is told of in the log."""
    path = _path(plan, fall, smoothing)
    if path is None:
        return
    part = path.with_suffix(f".{os.getpid()}")
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        part.write_bytes(cover.bytes())
        part.replace(path)  # at once, since other processes look for it
    except OSError as error:
        log.warning("Motus: %s could not be written: %s", path, error)
        with suppress(OSError):
            part.unlink()


def _path(plan, fall, smoothing):
    """Path of the file of a cover; None if there is no folder for covers, or the native module's own file is gone."""
    folder = os.environ.get(FOLDER)
    if not folder:
        return None
    try:
        by_what = Path(native.module.__file__).read_bytes()
    except OSError:  # another version of the add-on has taken its place
        return None
    name = hashlib.blake2b(by_what, digest_size=16)
    for part in _parts((plan._replace(falls=(), share=0.0, smoothing=smoothing, marks=None), fall)):
        name.update(part)
    return Path(folder) / f"{name.hexdigest()}.cover"


def _parts(value):
    """Yield bytes by which other processes recognize a value: of numbers, texts, arrays, and tuples of them.

    Stamps in named tuples are left out, since some of them count evaluated copies, which each process numbers anew: the arrays and matrices
    beside them decide.
    """
    if isinstance(value, tuple):
        yield f"({len(value)}".encode()
        for name, one in zip(getattr(value, "_fields", range(len(value))), value):
            if name != "stamp":
                yield from _parts(one)
    elif isinstance(value, np.ndarray | mathutils.Matrix):
        rows = np.ascontiguousarray(value)
        yield f"{rows.dtype.str}{rows.shape}".encode() + rows.tobytes()
    else:
        yield f"{value.__class__.__name__}:{value!r}".encode()
