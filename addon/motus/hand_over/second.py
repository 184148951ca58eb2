"""What the second Blender does: opens a copy of the file, makes plain Blender of it, saves it, and tells the first one how it goes.

It tells by lines on its standard output that begin with MARK: {"done": frames} after some frames, and at the end {"saved": true} or
{"refused": sentence}.
"""

import json
import time
import traceback
from pathlib import Path

import bpy

from ..core.evaluated import shares
from ..core.refusals import Refused
from ..core.translations import tr
from . import caches, convert, exchange, formats

MARK = "MOTUS-HAND-OVER "
PAUSE = 0.2
"""Seconds between two lines that tell the progress."""


def run(given):
    """Hand a file over, as handing.py asks for it.

    given: {"source": file to open, "result": file to write, "caches": folder to write caches into, "caches_name": name that the folder has in
    the end, "scene", "layer": names, "frames": of the time line, "formats": names, "span": (first, last) frame of files in these formats}.
    """
    try:
        _run(given)
    except Refused as refusal:
        tell(refused=str(refusal))
    except Exception as error:  # the first Blender shows the reason, whatever it is
        traceback.print_exc()
        tell(refused=tr("The file could not be handed over: {error}").format(error=str(error).strip()))
    else:
        tell(saved=True)


def tell(**facts):
    """Print a line for the first Blender."""
    print(MARK + json.dumps(facts), flush=True)


def _run(given):
    bpy.ops.wm.open_mainfile(filepath=given["source"], load_ui=True)
    scene = bpy.data.scenes[given["scene"]]
    view_layer = scene.view_layers[given["layer"]]
    window = bpy.context.window
    window.scene, window.view_layer = scene, view_layer
    shares.wait_for_all()
    folder = caches.Folder(Path(given["caches"]), given["caches_name"])
    if formats.need_velocities(given["formats"]):
        exchange.want_velocities()
    handed = _told(convert.convert(scene, view_layer, given["frames"], folder))
    bpy.context.preferences.filepaths.save_version = 0
    bpy.ops.wm.save_as_mainfile(filepath=given["result"], copy=True, relative_remap=False)
    if not Path(given["result"]).is_file():
        raise Refused(tr("The file could not be written"))
    if given["formats"]:
        folder.read_where_written()
        result = Path(given["result"])
        formats.export(exchange.Shown(scene, handed), scene, given["formats"], result.with_suffix, given["span"])


def _told(steps):
    """Let a generator run, and tell the numbers that it yields; returns what it returns."""
    told = time.perf_counter()
    while True:
        try:
            done = next(steps)
        except StopIteration as end:
            return end.value
        if time.perf_counter() > told + PAUSE:
            tell(done=done)
            told = time.perf_counter()
