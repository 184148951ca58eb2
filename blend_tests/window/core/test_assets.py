"""Presets as assets in a window: pictures, the asset browser, and the shelf, from which one is dragged onto an object; one step of undo each."""

import array

import bpy
from mathutils import Vector

import support
from window import window_support

OVERLAY = "show_floor", "show_axis_x", "show_axis_y", "show_cursor", "show_text", "show_relationship_lines"
PLACES = {"One": (-2.0, 0.0, 0.0), "Two": (2.0, 0.0, 0.0)}
SHELF_WITHIN = 20.0  # seconds until Blender has read the assets


def new_ball(name):
    mesh = bpy.data.meshes.new(name)
    corners = [Vector((x, y, z)) for x in (-0.8, 0.8) for y in (-0.8, 0.8) for z in (-0.8, 0.8)]
    faces = (0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)
    mesh.from_pydata(corners, [], faces)
    ball = support.link(name, mesh, location=PLACES[name])
    bpy.context.view_layer.update()
    return ball


def build():
    """Two boxes, One with dynamics that are kept as the asset Bouncy."""
    for name in PLACES:
        new_ball(name)
    bpy.ops.motus.dynamics_add(object="One")
    bpy.data.objects["One"].motus.dynamics.entries[0].frequency = 3.25
    with window_support.override():
        bpy.ops.view3d.view_axis(type='FRONT')
        bpy.ops.view3d.view_all()
        bpy.ops.motus.asset_keep(object="One", system="dynamics", name="Bouncy")
        bpy.ops.ed.undo_push(message="Kept")


def frequency(name):
    """Frequency of an object's dynamics; None without any."""
    settings = bpy.data.objects[name].motus.dynamics
    return settings.entries[0].frequency if settings.is_active else None


def pixel_of(name):
    from bpy_extras.view3d_utils import location_3d_to_region_2d

    region = window_support.region()
    place = location_3d_to_region_2d(region, region.data, bpy.data.objects[name].matrix_world.translation)
    return round(region.x + place.x), round(region.y + place.y)


def test_the_picture_shows_the_owner_and_no_setting_changes():
    overlay = window_support.area().spaces.active.overlay
    before = {name: getattr(overlay, name) for name in OVERLAY}
    build()
    yield
    preview = bpy.data.objects["Bouncy"].preview
    width, height = preview.image_size
    values = array.array('f', [0.0]) * (4 * width * height)
    preview.image_pixels_float.foreach_get(values)
    rows = [[values[4 * (row * width + column) + 1] for column in range(width)] for row in (height // 2, height - 2)]
    middle, edge = rows[0][width // 2], rows[1][2]
    assert (width, height) == (256, 256)
    assert abs(middle - edge) > 0.05, (middle, edge)  # the box before the background
    assert {name: getattr(overlay, name) for name in OVERLAY} == before


def switch_on(is_on):
    own = bpy.context.preferences.addons[support.module_name()].preferences
    with window_support.override():
        own.show_preset_shelf = is_on


def shelf():
    """The shelf's region, if it can be seen."""
    found = [one for one in window_support.area().regions if one.type == 'ASSET_SHELF' and one.height > 1]
    return found[0] if found else None


def has_preferences():
    return support.module_name() in bpy.context.preferences.addons


def item():
    """Window coordinates of the first asset in the shelf."""
    region = shelf()
    return region.x + 40, region.y + region.height - 40


def opened():
    """Generator: the scene, and the shelf with its asset; its value is whether this Blender has a shelf."""
    if not support.addon("core.blender.capabilities").has_asset_shelves():
        return False
    if not has_preferences():  # `blender --addons` enables without
        support.disable()
        support.enable()
    build()
    assert shelf() is None
    switch_on(True)
    yield from window_support.until(shelf, SHELF_WITHIN)
    assert shelf() is not None
    yield 2.0
    return True


def test_a_click_in_the_shelf_gives_to_what_is_selected():
    if not (yield from opened()):
        return
    try:
        two = bpy.data.objects["Two"]
        two.select_set(True)
        bpy.context.view_layer.objects.active = two
        yield
        window_support.move(*item())
        yield
        window_support.press('LEFTMOUSE', *item())
        yield from window_support.until(lambda: frequency("Two"), 10.0)
        yield from window_support.picture("preset_shelf")
        assert frequency("Two") == 3.25, frequency("Two")
        with window_support.override():
            bpy.ops.ed.undo()
        yield
        assert frequency("Two") is None
        assert frequency("One") == 3.25
    finally:
        switch_on(False)
    yield from window_support.until(lambda: shelf() is None, 10.0)
    assert shelf() is None


def drag(x, y):
    """Generator: press on the asset, and move to a place of the window."""
    start = item()
    window_support.move(*start)
    yield
    window_support.window().event_simulate(type='LEFTMOUSE', value='PRESS', x=start[0], y=start[1])
    yield
    for share in (0.1, 0.3, 0.6, 1.0):
        window_support.move(round(start[0] + share * (x - start[0])), round(start[1] + share * (y - start[1])))
        yield


def release(x, y):
    window_support.window().event_simulate(type='LEFTMOUSE', value='RELEASE', x=x, y=y)


def test_a_drag_from_the_shelf_gives_to_what_is_under_the_mouse():
    if not (yield from opened()):
        return
    try:
        for obj in bpy.context.scene.objects:
            obj.select_set(obj.name == "One")
        target = pixel_of("Two")
        yield from drag(*target)
        yield from window_support.picture("preset_drag")
        release(*target)
        yield from window_support.until(lambda: frequency("Two"), 10.0)
        assert frequency("Two") == 3.25, frequency("Two")
        assert [obj.name for obj in bpy.context.selected_objects] == ["One"]
        assert len(bpy.context.scene.objects) == 2
        with window_support.override():
            bpy.ops.ed.undo()
        yield
        assert frequency("Two") is None
    finally:
        switch_on(False)


def test_a_drag_that_is_cancelled_or_hits_nothing_changes_nothing():
    if not (yield from opened()):
        return
    try:
        target = pixel_of("Two")
        yield from drag(*target)
        window_support.press('ESC', *target)
        yield
        release(*target)
        yield
        assert frequency("Two") is None
        nothing = target[0], target[1] + 150
        yield from drag(*nothing)
        release(*nothing)
        yield
        assert frequency("Two") is None
        assert len(bpy.context.scene.objects) == 2
    finally:
        switch_on(False)


def test_the_asset_browser_gives_to_what_is_selected():
    build()
    area = yield from window_support.add_area('ASSETS', 'HORIZONTAL')
    two = bpy.data.objects["Two"]
    two.select_set(True)
    bpy.context.view_layer.objects.active = two
    yield 2.0
    area.spaces.active.activate_asset_by_id(bpy.data.objects["Bouncy"], deferred=False)
    yield 1.0
    region = next(one for one in area.regions if one.type == 'WINDOW')
    held = support.addon("core.interface.assets.held")
    with bpy.context.temp_override(window=window_support.window(), area=area, region=region):
        asset = held.shown(bpy.context)
        assert asset is not None and held.is_held(asset)
        assert held.place_of(asset, bpy.context) == ("Bouncy", "")
        assert bpy.ops.motus.asset_give('INVOKE_DEFAULT', True) == {'FINISHED'}
    yield
    yield from window_support.picture("preset_browser")
    assert frequency("Two") == 3.25, frequency("Two")
    with window_support.override():
        bpy.ops.ed.undo()
    yield
    assert frequency("Two") is None
