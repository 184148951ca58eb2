"""Choose the footage, see it keyed, look at the matte, lay a picture underneath, and refine it in the compositor."""

import tempfile
from pathlib import Path

import bpy
import numpy as np

from window import window_support

from . import hand

VIEWS = Path(__file__).resolve().parents[2] / "pictures" / "chroma_views.png"
WIDTH, HEIGHT, GAP = 480, 270, 8
"""Of each of the three views on that picture, and what is between them."""
PATH, FIRST, SECOND = (620, 752), (300, 692), (300, 670)
"""Places in the file browser, from the lower left of the window: its path, and the first two of its files."""


def steps(strip):
    """Generator: the five steps of the Chroma Key page."""
    with tempfile.TemporaryDirectory(prefix="footage_") as folder:
        yield from _steps(strip, folder)


def _steps(strip, folder):
    _cut_out(Path(folder))
    bpy.context.preferences.view.filebrowser_display_type = 'SCREEN'
    yield from hand.fresh()
    yield from hand.click("Set Up Chroma Key", hand.box('UI'))
    yield 1.0
    yield from _choose(folder, SECOND)
    yield from strip.shot(250, 30)
    yield from hand.click("Set Up Chroma Key")

    yield 3.0
    yield from hand.over_view()
    yield from strip.shot(260, 190, has_mouse=False)

    yield from hand.click("View", hand.box('UI'), beside=90)
    yield 0.5
    yield from hand.click("Matte")
    yield 2.0
    yield from strip.shot(260, 190, has_mouse=False)

    yield from hand.click("View", hand.box('UI'), beside=90)
    yield 0.5
    yield from hand.click("Composite")
    yield from hand.click("Underneath", hand.box('UI'), beside=90)
    yield 0.5
    yield from hand.click("Footage")
    yield from hand.on("Open", hand.box('UI'))
    yield from strip.shot(620, 80)
    yield from hand.click()
    yield 1.0
    yield from _choose(folder, FIRST)
    yield from hand.click("Open Image")

    yield 3.0
    yield from hand.over_view()
    yield from strip.shot(200, 180, has_mouse=False)


def _choose(folder, place):
    """Type the path of the folder, and click on a file."""
    yield from hand.click_at(PATH)
    yield from hand.key('A', ctrl=True)
    yield from hand.type_text(folder)
    for _ in range(2):  # the first one takes what is completed
        yield from hand.key('RET')
        yield 0.5
    yield from hand.click_at(place)
    yield 0.5


def _cut_out(folder):
    """Files of what was filmed, and of what lies underneath, from the picture of the views."""
    width, height, values = window_support.pixels(VIEWS)
    picture = np.array(values, np.float32).reshape(height, width, 4)
    for index, name in ((2, "desert.png"), (0, "pilot.png")):
        left = index * (WIDTH + GAP)
        image = bpy.data.images.new(name, WIDTH, HEIGHT)
        image.pixels.foreach_set(picture[:HEIGHT, left : left + WIDTH].ravel())
        image.file_format, image.filepath_raw = 'PNG', str(folder / name)
        image.save()
        bpy.data.images.remove(image)
