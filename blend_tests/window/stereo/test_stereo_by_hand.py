"""A stereo rig added by hand: it fits what the camera sees, can be adjusted, and is looked at through both eyes."""

import bpy
import numpy as np

from stereo import stereo_cases as cases
from window import window_support


def build():
    for obj in list(bpy.data.objects):
        bpy.data.objects.remove(obj)
    camera = cases.camera()
    cases.square("Near", (0.3, 5.0, 0.0), 1.0).color = (0.0, 0.0, 0.0, 1.0)
    cases.square("Wall", (0.0, 9.0, 0.0), 30.0)
    other = cases.square("Other", (50.0, 0.0, 0.0))
    bpy.context.view_layer.objects.active = other
    with window_support.override():
        assert bpy.ops.motus.stereo_rig_add('INVOKE_DEFAULT') == {'FINISHED'}
    return camera


def test_fits_what_is_seen():
    camera = build()
    yield
    settings = camera.motus.stereo
    assert bpy.context.object == camera, "the panel shows another object"
    assert settings.convergence == 'BUDGET'
    np.testing.assert_allclose((settings.near, settings.far), (5.0, 9.0), rtol=1e-3)
    assert 0.0 < settings.far_parallax <= 2.0


def show(camera, name):
    with window_support.override():
        bpy.ops.motus.stereo_view(object=camera.name)
    window_support.draw_all()
    yield
    return (yield from window_support.picture(name))


def colored(path):
    """How many pixels of the 3D viewport have more red than green, or less: Blender's yellow frame of the active camera has not."""
    width, _, values = window_support.pixels(path)
    seen = np.array(values).reshape(-1, width, 4)
    view = window_support.region()
    inner = seen[view.y + view.height // 4 : view.y + 3 * view.height // 4, view.x + view.width // 4 : view.x + 3 * view.width // 4]
    return int((np.abs(inner[..., 0] - inner[..., 1]) > 0.2).sum())


def test_a_camera_view_is_plain_until_it_is_asked_for():
    camera = build()
    space, display = window_support.area().spaces.active, window_support.window().stereo_3d_display
    space.shading.color_type = 'OBJECT'
    space.region_3d.view_perspective, space.overlay.show_overlays = 'CAMERA', False
    display.anaglyph_type = 'GREEN_MAGENTA'
    window_support.draw_all()
    yield
    plain = yield from window_support.picture("stereo_plain")
    assert colored(plain) == 0
    both = yield from show(camera, "stereo_both_from_camera")
    assert display.anaglyph_type == 'RED_CYAN' and colored(both) > 40
    back = yield from show(camera, "stereo_plain_again")
    assert (space.region_3d.view_perspective, display.anaglyph_type) == ('CAMERA', 'GREEN_MAGENTA')
    assert not space.overlay.show_overlays and colored(back) == 0
    display.anaglyph_type, space.shading.color_type = 'RED_CYAN', 'MATERIAL'
    space.region_3d.view_perspective, space.overlay.show_overlays = 'PERSP', True


def test_anaglyph_view_and_back():
    camera = build()
    space = window_support.area().spaces.active
    space.shading.color_type = 'OBJECT'
    with window_support.override():
        bpy.ops.view3d.view_axis(type='TOP')
    yield
    turn, where = space.region_3d.view_rotation.copy(), space.region_3d.view_perspective
    with window_support.override():
        bpy.ops.motus.stereo_view(object=camera.name)
    window_support.draw_all()
    yield
    path = yield from window_support.picture("stereo_anaglyph")
    width, _, values = window_support.pixels(path)
    seen = np.array(values).reshape(-1, width, 4)
    # Beside the dark square each eye sees of the wall what the other one does not. Blender's frames of the eyes are red and green.
    reddish = seen[..., 0] > seen[..., 2] + 0.2
    bluish = seen[..., 2] > seen[..., 0] + 0.2
    view = window_support.region()
    rows = slice(view.y + view.height // 4, view.y + 3 * view.height // 4)
    columns = slice(view.x + view.width // 4, view.x + 3 * view.width // 4)
    assert reddish[rows, columns].sum() > 20 and bluish[rows, columns].sum() > 20
    with window_support.override():
        bpy.ops.motus.stereo_view(object=camera.name)
    yield
    assert space.region_3d.view_perspective == where and space.overlay.show_overlays
    space.shading.color_type = 'MATERIAL'
    assert space.region_3d.view_rotation.rotation_difference(turn).angle < 1e-4
