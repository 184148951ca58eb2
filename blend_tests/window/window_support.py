"""What the tests in Blender's window share: the 3D viewport, simulated events, pictures from the X server."""

import array
import struct
import time
import zlib
from contextlib import contextmanager

import blf
import bpy
import numpy as np

import support

picture_folder = None  # set by driver.py


def window():
    return bpy.context.window_manager.windows[0]


def area(kind='VIEW_3D'):
    """The largest area of that kind."""
    areas = [one for one in window().screen.areas if one.type == kind]
    return max(areas, key=lambda one: one.width * one.height)


def region(kind='WINDOW', of='VIEW_3D'):
    return next(one for one in area(of).regions if one.type == kind)


def leave_the_viewport():
    """Closes all areas but the 3D viewport: most tests look at no other, and Blender draws each of them anew with every change of an object."""
    while others := [one for one in window().screen.areas if one != area()]:
        with bpy.context.temp_override(window=window(), area=others[0]):
            bpy.ops.screen.area_close()


def add_area(kind, direction='VERTICAL', share=0.21):
    """Generator: splits an area of a kind from the 3D viewport, which keeps the rest; its value is the new area."""
    view, before = area(), {one.as_pointer() for one in window().screen.areas}
    with override():
        bpy.ops.screen.area_split(direction=direction, factor=1.0 - share)
    yield
    new = next(one for one in window().screen.areas if one.as_pointer() not in before)
    least = min(new, view, key=lambda one: one.width * one.height)
    least.ui_type = kind
    yield
    return least


def draw_little():
    """Lets the 3D viewport do without what no test looks at: drawn in software, it is half of the time.

    A test of the toolbar or of the tool's settings shows them itself.
    """
    space = area().spaces.active
    for of, names in (
        (space, ("show_region_toolbar", "show_region_tool_header", "show_gizmo_navigate")),
        (space.overlay, ("show_floor", "show_ortho_grid", "show_axis_x", "show_axis_y")),
        (space.overlay, ("show_outline_selected", "show_text", "show_cursor")),
        (space.shading, ("show_object_outline", "show_specular_highlight")),
    ):
        for name in names:
            setattr(of, name, False)


def lower_the_viewport():
    """Generator: text editors take three quarters of the 3D viewport's height.

    For tests of what panels hold, seen or not: Blender lays out all of a sidebar, and draws what fits into it.
    """
    for _ in range(2):
        yield from add_area('TEXT_EDITOR', 'HORIZONTAL', 0.49)


def centre(of=None):
    """Window coordinates of a region's middle; the 3D viewport's own by default."""
    one = of or region()
    return one.x + one.width // 2, one.y + one.height // 2


def move(x, y, **modifiers):
    window().event_simulate(type='MOUSEMOVE', value='NOTHING', x=x, y=y, **modifiers)


def press(key, x, y, **modifiers):
    """A key or button pressed and released at (x, y) of the window; modifiers: shift, ctrl, alt, oskey."""
    for value in ('PRESS', 'RELEASE'):
        window().event_simulate(type=key, value=value, x=x, y=y, **modifiers)


def until(condition, seconds=120.0):
    """Generator: waits until `condition()` is true, or these seconds are over; its value is what the condition gave last."""
    end = time.monotonic() + seconds
    while not (found := condition()) and time.monotonic() < end:
        yield
    return found


def override():
    """A context in the 3D viewport, for operators called from a test."""
    return bpy.context.temp_override(window=window(), area=area(), region=region())


def drawn_panels(category):
    """Appends a marker to every panel of the tab; gives the list that fills with the names of those that are drawn."""
    drawn = []

    def appended(panel):
        def mark(_panel, _context):
            drawn.append(panel.__name__)

        panel.append(mark)

    for panel in bpy.types.Panel.__subclasses__():
        if getattr(panel, "bl_category", "") == category and panel.is_registered:
            appended(panel)
    return drawn


_tabs = []
"""How far below a sidebar's top tabs were found, pixels, the last one first: a mode has few places for a tab."""


def open_tab(category):
    """Generator: opens the 3D viewport's sidebar at that tab; its value is the list of the panels drawn since."""
    area().spaces.active.show_region_ui = True
    yield
    drawn = drawn_panels(category)
    yield from choose_tab(category, region('UI'), drawn)
    return drawn


def choose_tab(category, sidebar, drawn):
    """Generator: has a sidebar show that tab, until something is in `drawn`, which the tab's panels fill as they are drawn."""
    if support.addon("core.blender.capabilities").has_panel_category():
        sidebar.active_panel_category = category
        sidebar.tag_redraw()  # as a click on the tab does; 4.3 does not where a script has chosen it
        yield from until(lambda: drawn)
        return
    if drawn:
        return
    # Before that property: try the tabs down the right edge, until the wanted one shows itself.
    for below_top in (*_tabs, *range(20, 320, 12)):
        press('LEFTMOUSE', sidebar.x + sidebar.width - 8, sidebar.y + sidebar.height - below_top)
        yield
        if drawn:
            _tabs[:] = [below_top, *(one for one in _tabs if one != below_top)]
            return


@contextmanager
def drawn_settings(panels):
    """Opens these panels, each of a mixin that draws it, and before its sub-panels; gives {name of the panel: names of the properties drawn in it}.

    UILayout.introspect() would tell too, but crashes Blender 5.2.
    """
    found, closed = {}, [panel for panel in panels if 'DEFAULT_CLOSED' in getattr(panel, "bl_options", ())]
    kept = {panel: panel.__dict__.get("draw") for panel in panels}
    for panel in panels:
        panel.draw = _noting_draw(panel, found)
    _registered_anew(panels, closed, lambda panel: setattr(panel, "bl_options", set()))
    try:
        yield found
    finally:
        for panel, draw in kept.items():
            del panel.draw
            if draw:
                panel.draw = draw
        _registered_anew(panels, closed, lambda panel: setattr(panel, "bl_options", {'DEFAULT_CLOSED'}))


def _registered_anew(panels, changed, change):
    """All of them, though only some are changed: sub-panels would lose the one that they are in."""
    for panel in reversed(panels):
        bpy.utils.unregister_class(panel)
    for panel in changed:
        change(panel)
    for panel in panels:
        bpy.utils.register_class(panel)


def _noting_draw(panel, found):
    def draw(shown, context):
        stand_in = panel.__bases__[0]()  # Blender's own panels have layouts that cannot be replaced
        stand_in.layout = _NotingLayout(shown.layout, found.setdefault(panel.__name__, set()))
        stand_in.draw(context)

    return draw


class _NotingLayout:
    """A layout that draws, and notes the names of the properties."""

    def __init__(self, layout, names):
        self.__dict__.update(_layout=layout, _names=names)

    def __setattr__(self, name, value):
        setattr(self._layout, name, value)

    def __getattr__(self, name):
        found = getattr(self._layout, name)
        return self._noting(name, found) if callable(found) else found

    def _noting(self, name, function):
        def call(*arguments, **keywords):
            made = function(*arguments, **keywords)
            if name in {"prop", "prop_search"}:
                self._names.add(arguments[1])
            return _NotingLayout(made, self._names) if isinstance(made, bpy.types.UILayout) else made

        return call


def text_width(words):
    """In pixels, as the interface's font draws them."""
    style, scale = bpy.context.preferences.ui_styles[0].widget, bpy.context.preferences.system.ui_scale
    if bpy.app.version >= (4, 0, 0):
        blf.size(0, style.points * scale)
    else:
        blf.size(0, style.points * scale, 72)
    return blf.dimensions(0, words)[0]


def draw_all():
    """All areas are drawn anew: what Blender does after a button has changed a setting, and not after a script has."""
    for one in window().screen.areas:
        one.tag_redraw()


def picture(name):
    """Generator: takes a picture of the whole screen, as it is when Blender has drawn what it holds for changed; its value is the path of the PNG file.

    Nothing is marked for drawing here: what an operator forgets to have drawn anew is old in the picture as it is for a user.
    """
    yield
    path = picture_folder / f"{name}.png"
    path.write_bytes(_png(screen()))
    return path


def screen():
    """What the X server shows: (height, width, 3) bytes, red first, from the top. It keeps that in a file of the format XWD."""
    content = (picture_folder / "Xvfb_screen0").read_bytes()
    header = struct.unpack(">25I", content[:100])
    header_size, width, height, line, colours = (header[field] for field in (0, 4, 5, 12, 19))
    lines = np.frombuffer(content, np.uint8, height * line, header_size + 12 * colours).reshape(height, line)
    return lines[:, : 4 * width].reshape(height, width, 4)[:, :, 2::-1]


def _png(screen):
    """The content of a PNG file."""

    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    height, width, _ = screen.shape
    lines = np.zeros((height, 1 + 3 * width), np.uint8)  # a byte before each line says how the line is filtered: not at all
    lines[:, 1:] = screen.reshape(height, -1)
    return (
        b"\x89PNG\r\n\x1a\n"
        + chunk(b"IHDR", struct.pack(">2I5B", width, height, 8, 2, 0, 0, 0))
        + chunk(b"IDAT", zlib.compress(lines.tobytes(), 1))
        + chunk(b"IEND", b"")
    )


def pixels(path):
    """(width, height, float RGBA values) of a picture."""
    image = bpy.data.images.load(str(path))
    values = array.array("f", [0.0]) * len(image.pixels)
    image.pixels.foreach_get(values)
    size = tuple(image.size)
    bpy.data.images.remove(image)
    return (*size, values)
