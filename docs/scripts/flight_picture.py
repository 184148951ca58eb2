"""The pictures of the demo scenes in the README and the manual."""

import shutil
import tempfile
from dataclasses import replace
from pathlib import Path

import demo_film


PICTURES = {"flight": "flight.png", "reach": "ik_demo.png", "pull": "pull_demo.png"}


def render_all(folder):
    """Render the first still of each demo scene; returns the files."""
    return [_render(show, folder / PICTURES[show.name]) for show in demo_film.SHOWS]


def _render(show, file):
    progress = demo_film.Progress()
    scene = demo_film.build(show, progress)
    quality = replace(demo_film.FULL, still_width=960)
    with tempfile.TemporaryDirectory() as temporary:
        demo_film.render_stills(show, scene, Path(temporary), quality, progress, count=1)
        return Path(shutil.move(Path(temporary, f"{show.name}_01.png"), file))
