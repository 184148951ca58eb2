"""What the tests in Blender's window share: the 3D viewport, simulated events, pictures from the X server."""

import array

import bpy
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


def centre(of=None):
    """Window coordinates of a region's middle; the 3D viewport's own by default."""
    one = of or region()
    return one.x + one.width // 2, one.y + one.height // 2


def move(x, y):
    window().event_simulate(type='MOUSEMOVE', value='NOTHING', x=x, y=y)


def press(key, x, y, **modifiers):
    """A key or button pressed and released at (x, y) of the window; modifiers: shift, ctrl, alt, oskey."""
    for value in ('PRESS', 'RELEASE'):
        window().event_simulate(type=key, value=value, x=x, y=y, **modifiers)


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


def open_tab(category):
    """Generator: opens the 3D viewport's sidebar at that tab; its value is the list of the panels drawn since."""
    area().spaces.active.show_region_ui = True
    yield 0.5
    drawn = drawn_panels(category)
    sidebar = region('UI')
    if support.addon("core.capabilities").has_panel_category():
        sidebar.active_panel_category = category
        yield 0.5
        return drawn
    # Before that property: try the tabs down the right edge, until the wanted one shows itself.
    for below_top in range(20, 240, 12):
        if drawn:
            break
        press('LEFTMOUSE', sidebar.x + sidebar.width - 8, sidebar.y + sidebar.height - below_top)
        yield 0.2
    return drawn


def picture(name):
    """Generator: takes a picture of the whole screen; its value is the path of the PNG file."""
    request = picture_folder / f"{name}.request"
    path = request.with_suffix(".png")
    for _ in range(2):  # whatever is marked for redrawing gets drawn before
        for one in window().screen.areas:
            one.tag_redraw()
        yield 0.3
    request.touch()
    for _ in range(200):
        if path.exists():
            return path
        yield 0.1
    raise AssertionError(f"no picture {path}: run.py takes them")


def pixels(path):
    """(width, height, float RGBA values) of a picture."""
    image = bpy.data.images.load(str(path))
    values = array.array("f", [0.0]) * len(image.pixels)
    image.pixels.foreach_get(values)
    size = tuple(image.size)
    bpy.data.images.remove(image)
    return (*size, values)
