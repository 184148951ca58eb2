"""*Online Manual*, by F1 and from the right button's menu, and the help buttons of panels: the manual opens where it tells of what is under the mouse."""

import contextlib
import webbrowser
from unittest import mock

import bpy

import support
from window import window_support
from window.core.test_habits import widen

SITE = "https://site/"


def build(follows):
    for obj in list(bpy.data.objects):
        bpy.data.objects.remove(obj)
    course, glider = bpy.data.objects.new("Course", bpy.data.curves.new("Course", 'CURVE')), bpy.data.objects.new("Glider", None)
    course.data.splines.new('BEZIER').bezier_points.add(1)
    for obj in (course, glider):
        bpy.context.scene.collection.objects.link(obj)
    if follows:
        bpy.ops.motus.path_follow_add(object="Glider", curve="Course")
    bpy.context.view_layer.objects.active = glider


@contextlib.contextmanager
def opening():
    """Nothing is opened; gives the list of the places in the manual that would be."""
    found = []
    with (
        mock.patch.object(support.addon("core.interface.manual"), "address", lambda place: f"{SITE}{place}"),
        mock.patch.object(webbrowser, "open", lambda address, *_: found.append(address.removeprefix(SITE))),
    ):
        yield found


def hover(x, y):
    """Generator: Blender takes the mouse for being over something once it has moved there."""
    window_support.move(x, y + 1)
    yield
    window_support.move(x, y)
    yield


def hovered(found, place):
    """Generator: goes down the middle of the sidebar, then along the header of its first panel, with F1 pressed, until that opens a place there.

    Its value is where that was.
    """
    sidebar = window_support.region('UI')
    left, top = sidebar.x + sidebar.width // 2, sidebar.y + sidebar.height
    down = [(left, y) for y in range(top - 10, sidebar.y + 10, -10)]
    header = [(x, top - 15) for x in range(left, sidebar.x + sidebar.width - 20, 8)]
    for x, y in (*header, *down) if place.endswith("#motus.manual") else down:
        yield from hover(x, y)
        window_support.press('F1', x, y)
        yield
        if found and found[-1] == place:
            return x, y
    return None


def test_settings():
    build(follows=True)
    yield from window_support.open_tab("Motus")
    with opening() as found:
        place = yield from hovered(found, "path.html#motus_pg_path.influence")
        assert place, found
        assert "path.html#motus_pg_path.curve" in found, found

        found.clear()
        yield from choose(*place, above_last=1)
        assert found == ["path.html#motus_pg_path.influence"], found


def choose(x, y, above_last):
    """Generator: opens the right button's menu and chooses the entry that stands so many above the last."""
    window_support.press('RIGHTMOUSE', x, y)
    yield
    yield
    for _ in range(above_last + 1):
        window_support.press('UP_ARROW', x, y)
        yield
    yield from window_support.picture("manual_menu")
    window_support.press('RET', x, y)
    yield
    yield


def test_buttons():
    build(follows=False)
    yield from window_support.open_tab("Motus")
    with opening() as found:
        place = yield from hovered(found, "operators.html#motus.path_follow_add")
        assert place, found
        found.clear()
        yield from choose(*place, above_last=0)
        assert found == ["operators.html#motus.path_follow_add"], found


def test_help_buttons():
    build(follows=True)
    yield from window_support.open_tab("Motus")
    with opening() as found:
        place = yield from hovered(found, "operators.html#motus.manual")
        assert place, found
        found.clear()
        window_support.press('LEFTMOUSE', *place)
        yield from window_support.until(lambda: found)
        assert found == ["path.html"], found


def test_help_buttons_leave_titles_their_room():
    build(follows=True)
    yield from window_support.open_tab("Motus")
    sidebar, widths, answers = window_support.region('UI'), support.addon("core.interface.view.widths"), {}
    before, fits = sidebar.width, widths.title_fits

    def noting(title, buttons):
        answers[title, buttons] = fits(title, buttons)
        return answers[title, buttons]

    with mock.patch.object(widths, "title_fits", noting):
        window_support.draw_all()
        yield from window_support.until(lambda: ("Follow Path", 2) in answers)
        assert answers["Follow Path", 2], (before, answers)
        yield from widen(sidebar, -110)
        yield from window_support.until(lambda: not answers["Follow Path", 2])
        yield from window_support.picture("manual_narrow")
        assert not answers["Follow Path", 2], (sidebar.width, answers)
    yield from widen(sidebar, before - sidebar.width)


def test_titles_are_no_wider_than_is_thought():
    declare, widths = support.addon("core.declare"), support.addon("core.interface.view.widths")
    view, scale, translate = bpy.context.preferences.view, bpy.context.preferences.system.ui_scale, bpy.app.translations.pgettext_iface
    view.use_translate_interface = True
    try:
        for view.language in ("es", "en_US"):
            yield
            titles = {translate(*declare.title(feature)) for feature in declare.registered.values()}
            wide = {title: window_support.text_width(title) / scale for title in titles}
            assert not {title for title in titles if wide[title] > widths.of_text(title) + widths.PADDING}, wide
    finally:
        view.language = "en_US"
