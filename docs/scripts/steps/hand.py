"""A user's hand: the mouse goes to what it reads on the screen, clicks, drags, and types.

All are generators: a bare `yield` lets Blender handle and draw what was done.
"""

import bpy

from window import window_support

from . import reading

SEEN_WITHIN = 30.0  # seconds until words have to be on the screen
SCROLLED, WHOLE_TAB = 8, 60  # notches of the wheel
SCROLLED_AFTER = 3.0  # seconds until the region that has to show words is scrolled down to them
HOVERED = 0.4  # seconds until a submenu opens under the mouse
DRAG_STEPS = 5
CHARACTERS = {
    ".": 'PERIOD',
    "/": 'SLASH',
    "-": 'MINUS',
    " ": 'SPACE',
    "_": 'MINUS',
    **dict(zip("0123456789", ('ZERO', 'ONE', 'TWO', 'THREE', 'FOUR', 'FIVE', 'SIX', 'SEVEN', 'EIGHT', 'NINE'))),
}

place = (640, 400)
"""Where the mouse is, from the lower left of the window."""


def to(x, y):
    """Move the mouse."""
    global place
    place = (round(x), round(y))
    window_support.move(*place)
    yield 0.0


def box(kind='WINDOW', of='VIEW_3D'):
    """(left, bottom, right, top) of a region, for `within`."""
    region = window_support.region(kind, of)
    return region.x, region.y, region.x + region.width, region.y + region.height


def whole(of):
    """(left, bottom, right, top) of an editor."""
    area = window_support.area(of)
    return area.x, area.y, area.x + area.width, area.y + area.height


def at(words, within=None):
    """Where words are on the screen; waits until they are there. A region, `within`, is scrolled to them, from its top down."""
    for count in range(round(SEEN_WITHIN / SCROLLED_AFTER)):
        found = yield from window_support.until(lambda: reading.find(window_support.screen(), words, within), SCROLLED_AFTER)
        if found is not None:
            return found
        if within is not None:
            left, bottom, right, top = within
            yield from to((left + right) // 2, (bottom + top) // 2)
            yield from scroll(-SCROLLED if count else WHOLE_TAB)
    raise AssertionError(f'"{words}" is not on the screen')


def on(words, within=None, beside=0):
    """Move the mouse to words; beside: so many pixels to their right."""
    x, y = yield from at(words, within)
    yield from to(x + beside, y)


def click(words=None, within=None, beside=0, button='LEFTMOUSE', **modifiers):
    """Click on words, or where the mouse is."""
    if words is not None:
        yield from on(words, within, beside)
    window_support.press(button, *place, **modifiers)
    yield


def click_at(pixel, **modifiers):
    """Click on a place of the window."""
    yield from to(*pixel)
    yield from click(**modifiers)


def menu(*words, within=None):
    """Open a menu and its submenus; the mouse rests on the last of the words."""
    first, *others = words
    yield from click(first, within)
    yield HOVERED
    for index, word in enumerate(others):
        yield from on(word)
        yield from to(place[0] + 3, place[1])
        if index < len(others) - 1:
            yield HOVERED
            yield


def choose(*words, within=None):
    """Click through a menu."""
    yield from menu(*words, within=within)
    yield from click()


def key(name, **modifiers):
    """Press a key where the mouse is."""
    window_support.press(name, *place, **modifiers)
    yield


def type_text(text):
    """Type into the field that is open."""
    for character in text:
        window_support.window().event_simulate(
            type=CHARACTERS.get(character, character.upper()), value='PRESS', unicode=character, x=place[0], y=place[1]
        )
    yield


def enter(text, words, within=None, beside=0):
    """Click on the field beside the words, and type in place of what stands there."""
    yield from click(words, within, beside)
    yield from key('A', ctrl=True)
    yield from type_text(text)
    yield from key('RET')


def press_at(x, y, button='LEFTMOUSE', **modifiers):
    """Hold a button down at a place."""
    yield from to(x, y)
    window_support.window().event_simulate(type=button, value='PRESS', x=place[0], y=place[1], **modifiers)
    yield


def drag_to(x, y, steps=DRAG_STEPS):
    """Move while a button is held."""
    start = place
    for step in range(1, steps + 1):
        share = step / steps
        yield from to(start[0] + (x - start[0]) * share, start[1] + (y - start[1]) * share)


def let_go(button='LEFTMOUSE'):
    """Release the button."""
    window_support.window().event_simulate(type=button, value='RELEASE', x=place[0], y=place[1])
    yield


def pixel_of(point):
    """Where a place of the world is in the window."""
    from bpy_extras.view3d_utils import location_3d_to_region_2d

    region, view = window_support.region(), window_support.area().spaces.active.region_3d
    with window_support.override():
        x, y = location_3d_to_region_2d(region, view, point)
    return round(region.x + x), round(region.y + y)


def fresh():
    """Blender as it starts, with the sidebar open at the tab Motus."""
    bpy.ops.wm.read_homefile(use_factory_startup=True)
    yield
    yield from window_support.open_tab("Motus")


def empty_view():
    """Remove what Blender starts with, and look from the front."""
    yield from over_view()
    yield from key('A')
    yield from key('X')
    for _ in range(20):  # Blender asks first, in a while
        if not bpy.context.scene.objects:
            break
        yield 0.2
        yield from key('RET')
    else:
        raise AssertionError("what Blender starts with is still there")
    yield from key('NUMPAD_1')


def over_view():
    """Move the mouse to the middle of the viewport."""
    yield from to(*window_support.centre())


def frame_view(zoom_out=0):
    """Look at all there is, from so many notches of the wheel farther away."""
    yield from over_view()
    yield from key('HOME')
    yield from scroll(-zoom_out)


def scroll(notches):
    """Turn the wheel, downward for less than 0."""
    for _ in range(abs(notches)):
        yield from key('WHEELUPMOUSE' if notches > 0 else 'WHEELDOWNMOUSE')


def to_frame(frame):
    """Drag the playhead there."""
    timeline = window_support.region('WINDOW', 'DOPESHEET_EDITOR')
    top = timeline.y + timeline.height - 12
    yield from press_at(timeline.x + timeline.view2d.view_to_region(bpy.context.scene.frame_current, 0)[0], top)
    yield from drag_to(timeline.x + timeline.view2d.view_to_region(frame, 0)[0], top)
    yield from let_go()
    yield from over_view()


def move_along(axis, distance):
    """Grab what is selected, and type how far it goes."""
    if distance:
        yield from key('G')
        yield from key(axis)
        yield from type_text(f"{distance:g}")
        yield from key('RET')
