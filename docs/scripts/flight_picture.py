"""The picture of the README: the first still of the demo."""

import shutil
import tempfile
from dataclasses import replace
from pathlib import Path

import bpy
import demo_film


def render(folder):
    """Render the demo's first still as flight.png; returns the file."""
    bpy.ops.motus.demo_scene(system="PATH")
    quality = replace(demo_film.FULL, still_width=960)
    with tempfile.TemporaryDirectory() as temporary:
        still = Path(temporary, "flight_01.png")
        demo_film.render_stills(bpy.context.window.scene, still.parent, quality, demo_film.Progress(), count=1)
        return Path(shutil.move(still, folder / "flight.png"))
