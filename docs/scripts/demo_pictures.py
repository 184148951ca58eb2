"""The pictures of the demo scenes in the README and the manual."""

import shutil
import tempfile
import time
from dataclasses import replace
from pathlib import Path

import demo_film
import demo_plan


def render_all(folder):
    """Render the first still of each demo scene; returns the files."""
    return [_render(demo, folder / f"demo_{demo.name}.png") for demo in demo_plan.SCENES]


def _render(demo, file):
    progress = demo_film.Progress(time.time())
    scene = demo_film.build(demo, progress)
    quality = replace(demo_film.FULL, still_width=960)
    with tempfile.TemporaryDirectory() as temporary:
        shot = demo_plan.Shot(demo, 0, demo_plan.NEVER)
        still = demo_film.render_still(shot, scene, Path(temporary), quality, progress, quality.still_width)
        return Path(shutil.move(still, file))
