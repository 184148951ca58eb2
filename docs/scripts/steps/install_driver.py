"""Inside a Blender with windows and without Motus: installs it by mouse, as a user does, and takes the pictures of docs/install.md.

blender ... --enable-event-simulate --python install_driver.py -- X_SERVER_FOLDER ZIP
"""

import os
import sys
import traceback
from pathlib import Path

SCRIPTS = Path(__file__).resolve().parents[1]
CLONE = SCRIPTS.parents[1]
sys.path[:0] = [str(SCRIPTS), str(CLONE / "blend_tests")]
sys.dont_write_bytecode = True

import bpy  # noqa: E402  (found by the lines above)
import numpy as np  # noqa: E402

from steps import hand, strip  # noqa: E402
from window import driver, window_support  # noqa: E402

IS_EXTENSION = bpy.app.version >= (4, 2, 0)
PICTURES = CLONE / "docs" / "pictures"
FROM_RIGHT, FROM_TOP = 20, 16
"""Pixels to the arrow at the upper right of the preferences, which opens a menu."""
NAVIGATION = 150
"""Pixels at the left of the preferences, in which their sections are listed."""
LINE = 24
"""Pixels from the head of the list of files to its first line."""
NARROW, TALL, GAP = 420, 380, 10

whole_screen = window_support.screen


def newest():
    """The window that was opened last: each dialogue has a window of its own, above the others."""
    return bpy.context.window_manager.windows[-1]


def screen_of_newest():
    """What is seen of that window alone, so that places are counted from its corner, as Blender counts the mouse's."""
    pixels, window = whole_screen(), newest()
    top = pixels.shape[0] - window.y - window.height
    return pixels[top : top + window.height, window.x : window.x + window.width]


def windows(count):
    """Generator: waits until so many windows are there, and drawn."""
    yield from window_support.until(lambda: len(bpy.context.window_manager.windows) == count)
    yield 1.0
    yield


def settled():
    """Generator: lets Blender draw what was installed meanwhile."""
    for area in newest().screen.areas:
        area.tag_redraw()
    yield 1.0
    yield


def in_navigation():
    """Where the preferences list their sections, for `within`."""
    return 0, 0, NAVIGATION, newest().height


def to_file(path):
    """Generator: goes to the folder in the file browser and clicks on the only file in it."""
    params = window_support.area('FILE_BROWSER').spaces.active.params
    params.directory = str(path.parent).encode()
    yield 1.0
    x, y = yield from hand.at("Name")
    yield from hand.click_at((x, y - LINE))
    yield 0.5


def picture(number, width=None, height=None):
    """Generator: the upper left of the newest window, or all of it without a size, with the mouse and a number."""
    screen = yield from strip.smooth_screen()
    strip.paint_cursor(screen, hand.place[0], screen.shape[0] - hand.place[1])
    found = screen[:height, :width].copy()
    if number:
        strip.paint_badge(found, number)
    return found


def sheet(*rows):
    """One picture of rows of pictures."""
    heights = [max(one.shape[0] for one in row) for row in rows]
    width = max(sum(one.shape[1] + GAP for one in row) for row in rows) - GAP
    whole = np.full((sum(heights) + GAP * (len(rows) - 1), width, 3), strip.PAPER, np.uint8)
    top = 0
    for row, height in zip(rows, heights):
        left = 0
        for one in row:
            whole[top : top + one.shape[0], left : left + one.shape[1]] = one
            left += one.shape[1] + GAP
        top += height + GAP
    return whole


def main_window():
    """Generator: the tab Motus, once the dialogues are closed."""
    while len(bpy.context.window_manager.windows) > 1:
        with bpy.context.temp_override(window=newest()):
            bpy.ops.wm.window_close()
        yield 0.5
    yield from window_support.open_tab("Motus")
    yield 0.5
    screen = yield from strip.smooth_screen()
    sidebar = window_support.region('UI')
    top, right = screen.shape[0] - sidebar.y - sidebar.height, sidebar.x + sidebar.width
    found = screen[top : top + TALL, right - NARROW : right].copy()
    strip.paint_badge(found, 5)
    return found


def extension(path):
    """Generator: Blender 4.2 and later; the pictures, by their names."""
    yield from hand.menu("Edit", "Preferences")
    first = yield from picture(1, NARROW, TALL)
    yield from hand.click()
    yield from windows(2)
    yield from hand.click("Get Extensions")
    yield 0.5
    yield from hand.click_at((newest().width - FROM_RIGHT, newest().height - FROM_TOP))
    yield 0.5
    yield from hand.on("Install from Disk")
    second = yield from picture(2, height=TALL)
    yield from hand.click()
    yield from windows(3)
    yield from to_file(path)
    yield from hand.on("Install from Disk")
    third = yield from picture(3)
    yield from hand.click()
    yield from windows(2)
    yield from settled()
    _, y = yield from hand.at("Motus")
    yield from hand.click_at((NAVIGATION + 30, y))
    yield 0.5
    yield from hand.on("Motus")
    fourth = yield from picture(4, height=TALL)
    yield from hand.click_at((newest().width - FROM_RIGHT - 8, y))
    yield 0.5
    yield from hand.on("Uninstall")
    removal = yield from picture(0, height=TALL)
    fifth = yield from main_window()
    return {"extension": sheet((first, second), (third,), (fourth, fifth)), "removal": removal}


def legacy(path):
    """Generator: Blender before 4.2; the pictures, by their names."""
    yield from hand.menu("Edit", "Preferences")
    first = yield from picture(1, NARROW, TALL)
    yield from hand.click()
    yield from windows(2)
    yield from hand.click("Add-ons", in_navigation())
    yield 0.5
    yield from hand.on("Install...")
    second = yield from picture(2, height=TALL)
    yield from hand.click()
    yield from windows(3)
    yield from to_file(path)
    yield from hand.on("Install Add-on")
    third = yield from picture(3)
    yield from hand.click()
    yield from windows(2)
    yield from settled()
    _, y = yield from hand.at("Animation: Motus")
    yield from hand.click_at((NAVIGATION + 55, y))
    yield from settled()
    fourth = yield from picture(4, height=TALL)
    fifth = yield from main_window()
    return {"legacy": sheet((first, second), (third,), (fourth, fifth))}


def do_all(path):
    """Generator: all steps; ends Blender with status 1 at the first that cannot be done."""
    try:
        pictures = yield from (extension if IS_EXTENSION else legacy)(path)
    except Exception:
        traceback.print_exc()
        sys.stdout.flush()
        os._exit(1)  # an exception in a timer would leave Blender open
    for name, pixels in pictures.items():
        file = PICTURES / f"install_{name}.png"
        file.write_bytes(strip.png(strip.coarse(pixels)))
        print(f"docs/pictures/{file.name}", flush=True)
    os._exit(0)


def main(folder, path):
    """Begin; the rest is done by Blender's timer."""
    window_support.window, window_support.screen = newest, screen_of_newest
    view = bpy.context.preferences.view
    view.show_splash = view.show_tooltips = False
    bpy.context.preferences.inputs.mouse_double_click_time = 1  # milliseconds: two clicks of the hand are no double click
    window_support.picture_folder = Path(folder)
    bpy.app.timers.register(driver.stepper(do_all(Path(path))), first_interval=1.0, persistent=True)


main(*sys.argv[sys.argv.index("--") + 1 :])
