"""The pictures of the demo scenes in the README and the manual."""

import shutil
import tempfile
from dataclasses import replace
from pathlib import Path

import demo_film


def render(folder):
    """Render the flight's first still as flight.png; returns the file."""
    return _render(demo_film.FLIGHT, folder / "flight.png")


def render_reach(folder):
    """Render the first still of the inverse kinematics' scene as ik_demo.png; returns the file."""
    return _render(demo_film.REACH, folder / "ik_demo.png")


def _render(show, file):
    progress = demo_film.Progress()
    scene = demo_film.build(show, progress)
    quality = replace(demo_film.FULL, still_width=960)
    with tempfile.TemporaryDirectory() as temporary:
        demo_film.render_stills(show, scene, Path(temporary), quality, progress, count=1)
        return Path(shutil.move(Path(temporary, f"{show.name}_01.png"), file))
