"""A chroma key as an artist sees it: the panel beside the viewport and beside the compositor, and the screen's colour there."""

import bpy
import numpy as np

import support
from window import window_support

compositor = support.addon("chroma.compositor")
settings = support.addon("chroma.settings")
PANEL = "MOTUS_PT_chroma"
GREEN = (0.05, 0.42, 0.08, 1.0)
WIDE, LABELS, MARGIN, DOT = 240.0, 0.4, 45.0, 20.0
"""As in the tests of the stereo panel: from which width on labels have room, their share, and what is none of the panel's. DOT: width of
what is clicked to key a setting."""


def set_up():
    image = bpy.data.images.new("Footage", 64, 36, float_buffer=True)
    grey = (0.4, 0.4, 0.4, 1.0)
    image.pixels = [part for y in range(36) for x in range(64) for part in (grey if 20 < x < 44 and y < 25 else GREEN)]
    bpy.ops.motus.chroma_key_setup(clip="Footage", underneath='NOTHING')
    return compositor.key_of(bpy.context.scene)


def test_panel_beside_the_viewport():
    key = set_up()
    drawn = yield from window_support.open_tab("Motus")
    assert PANEL in drawn and f"{PANEL}_edge" in drawn and f"{PANEL}_readouts" in drawn, drawn
    window_support.draw_all()
    yield
    path = yield from window_support.picture("chroma_panel")
    assert has_color(path), "the field of the screen's colour is not seen"
    # As the field's eyedropper sets it.
    holder, name = settings.place_of_input(key, settings.COLOR)
    setattr(holder, name, (0.8, 0.0, 0.6, 1.0))
    window_support.draw_all()
    yield
    path = yield from window_support.picture("chroma_panel_picked")
    assert not has_color(path), "the field shows the colour from before"


def has_color(path):
    """Whether the sidebar shows the screen's green."""
    width, _, values = window_support.pixels(path)
    seen = np.array(values).reshape(-1, width, 4)
    sidebar = window_support.region('UI')
    seen = seen[sidebar.y : sidebar.y + sidebar.height, sidebar.x : sidebar.x + sidebar.width, :3]
    return ((seen[..., 1] > seen[..., 0] + 0.3) & (seen[..., 1] > seen[..., 2] + 0.3)).sum() > 200


def test_panel_beside_the_compositor():
    set_up()
    area = window_support.area()
    kind = area.ui_type
    area.ui_type = 'CompositorNodeTree'
    try:
        drawn = []
        panel = next(one for one in bpy.types.Panel.__subclasses__() if one.__name__ == f"{PANEL}_compositor")
        panel.append(lambda _panel, _context: drawn.append(panel.__name__))
        area.spaces.active.show_region_ui = True
        yield
        yield from window_support.choose_tab("Motus", window_support.region('UI', 'NODE_EDITOR'), drawn)
        yield from window_support.picture("chroma_compositor")
        assert drawn, "the panel was not drawn"
    finally:
        area.ui_type = kind
        yield


def test_labels_fit_beside_their_fields():
    set_up()
    yield from window_support.open_tab("Motus")
    width, scale = window_support.region('UI').width, bpy.context.preferences.system.ui_scale
    if width < WIDE * scale:  # there Blender clips its own labels too
        return
    room = LABELS * (width - MARGIN * scale) - DOT * scale
    shown = [one.label for one in settings.OF_KEYING] + [settings.COLOR, settings.WRAP]
    clipped = {label: wide for label in shown if (wide := window_support.text_width(label)) > room}
    assert not clipped, (clipped, room)


def test_one_step_of_undo():
    scene = bpy.context.scene
    image = bpy.data.images.new("Footage", 4, 4, float_buffer=True)
    image.pixels = list(GREEN) * 16
    image.pack()
    scene.camera = bpy.data.objects.new("Camera", bpy.data.cameras.new("Camera"))
    scene.collection.objects.link(scene.camera)
    before = state(scene)
    with window_support.override():
        bpy.ops.ed.undo_push(message="Before")
        bpy.ops.motus.chroma_key_setup('EXEC_DEFAULT', True, clip="Footage", underneath='NOTHING', use_plane=True)
    yield
    after = state(bpy.context.scene)
    assert after != before and compositor.key_of(bpy.context.scene), after
    with window_support.override():
        bpy.ops.ed.undo()
    yield
    assert state(bpy.context.scene) == before, (state(bpy.context.scene), before)
    with window_support.override():
        bpy.ops.ed.redo()
    yield
    assert state(bpy.context.scene) == after, (state(bpy.context.scene), after)


def state(scene):
    """What one step of undo takes back."""
    tree = compositor.tree_of(scene)
    return (
        sorted(node.name for node in tree.nodes) if tree else None,
        len(bpy.data.node_groups),
        len(bpy.data.meshes),
        sorted(thing.name for thing in scene.objects),
        scene.render.resolution_x,
        scene.view_settings.view_transform,
    )
