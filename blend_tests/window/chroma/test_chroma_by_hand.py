"""A key set up by hand: chosen in the file browser, seen in the viewport at once, and its colour picked by the eyedropper."""

import tempfile
from pathlib import Path

import bpy
import numpy as np

import support
from chroma import chroma_cases as cases
from window import window_support

compositor = support.addon("chroma.compositor")
settings = support.addon("chroma.settings")
SUBJECT = 0.55, 0.1, 0.5
SIZE = 96, 64
NEAR = 0.01
"""By how much a picked colour, which is in the file in 8 bits, may differ."""
WRONG = 0.1, 0.6, 0.05
"""A colour of the screen that the eyedropper mends."""


def footage(folder):
    """A file: a square of one colour in the middle of a green screen."""
    picture = np.ones((SIZE[1], SIZE[0], 4))
    picture[..., :3] = cases.GREEN
    picture[16:-16, 24:-24, :3] = SUBJECT
    return cases.written(picture, Path(folder) / "shot.png")


def scene_with_a_camera():
    scene = bpy.context.scene
    scene.camera = bpy.data.objects.new("Camera", bpy.data.cameras.new("Camera"))
    scene.collection.objects.link(scene.camera)
    return scene


def set_up_by_hand(path):
    """Generator: the operator asks for a file, which is chosen."""
    bpy.context.preferences.view.filebrowser_display_type = 'SCREEN'
    with window_support.override():
        assert bpy.ops.motus.chroma_key_setup('INVOKE_DEFAULT') == {'RUNNING_MODAL'}
    yield
    browser = window_support.area('FILE_BROWSER')
    params = yield from window_support.until(lambda: browser.spaces.active.params)
    params.directory, params.filename = str(Path(path).parent).encode(), Path(path).name
    window_support.draw_all()
    yield
    place = window_support.centre(window_support.region('WINDOW', 'FILE_BROWSER'))
    window_support.move(*place)
    yield
    window_support.press('RET', *place)
    found = yield from window_support.until(lambda: compositor.key_of(bpy.context.scene), 20.0)
    if not found:
        yield from window_support.picture("chroma_browser")
        raise AssertionError("no key was set up")


def colors(path):
    """(rows from below, columns, 3) of a picture of the window, as they are shown."""
    width, _, values = window_support.pixels(path)
    return np.array(values).reshape(-1, width, 4)[..., :3]


def in_viewport(path):
    view, sidebar = window_support.region(), window_support.region('UI')
    return colors(path)[view.y : view.y + view.height, view.x : sidebar.x]


def is_purple(seen):
    return (seen[..., 0] > seen[..., 1] + 0.2) & (seen[..., 2] > seen[..., 1] + 0.2)


def is_green(seen):
    return (seen[..., 1] > seen[..., 0] + 0.2) & (seen[..., 1] > seen[..., 2] + 0.2)


def until_purple():
    """Generator: what the viewport shows, as soon as the subject is there; shaders may have to be compiled first."""
    for _ in range(60):
        path = yield from window_support.picture("chroma_by_hand")
        seen = in_viewport(path)
        if is_purple(seen).sum() > 500:
            break
        yield 1.0
    return seen


def test_chosen_and_seen_at_once():
    with tempfile.TemporaryDirectory() as folder:
        scene_with_a_camera()
        space = window_support.area().spaces.active
        kept = space.shading.type, space.region_3d.view_perspective
        yield from set_up_by_hand(footage(folder))
        seen = yield from until_purple()
        assert is_purple(seen).sum() > 500, "the subject is not seen"
        assert is_green(seen).sum() < 0.05 * is_purple(seen).sum(), "the screen is seen"
        with window_support.override():
            bpy.ops.motus.chroma_key_show()
        yield
        assert (space.shading.type, space.region_3d.view_perspective) == kept
        with window_support.override():
            bpy.ops.motus.chroma_key_remove()
        yield
        assert not [obj for obj in bpy.data.objects if obj.type == 'MESH']


def test_eyedropper():
    """The field's own, clicked on the footage in an image editor: elsewhere Blender reads the screen, of which a server without one has no copy."""
    with tempfile.TemporaryDirectory() as folder:
        key = compositor.key_of(set_up(footage(folder)))
        place = settings.place_of_input(key, settings.COLOR)
        setattr(*place, (*WRONG, 1.0))
        area = yield from window_support.add_area('IMAGE_EDITOR')
        area.spaces.active.image = compositor.node_of(bpy.context.scene, compositor.FOREGROUND).image
        yield from window_support.open_tab("Motus")
        window_support.draw_all()
        yield
        path = yield from window_support.picture("chroma_before_picking")
        yield from pick(field_of_green(path), window_support.centre(window_support.region('WINDOW', 'IMAGE_EDITOR')))
        picked = tuple(getattr(*place))[:3]
        yield from window_support.picture("chroma_picked")
        np.testing.assert_allclose(picked, SUBJECT, atol=NEAR)


def set_up(path):
    bpy.ops.motus.chroma_key_setup(clip=path, underneath='NOTHING')
    return bpy.context.scene


def field_of_green(path):
    """Where the field of the screen's colour is in the window."""
    sidebar = window_support.region('UI')
    part = is_green(colors(path)[sidebar.y : sidebar.y + sidebar.height, sidebar.x : sidebar.x + sidebar.width])
    rows, columns = np.nonzero(part)
    return sidebar.x + int(np.median(columns)), sidebar.y + int(np.median(rows))


def pick(field, place):
    """Generator: the eyedropper of a field, by its key, and a click."""
    window_support.move(*field)
    yield
    window_support.press('E', *field)
    yield
    window_support.move(*place)
    yield
    window_support.press('LEFTMOUSE', *place)
    yield
