"""The properties editor with an object's transform, and the mouse over one of its properties."""

import bpy

from window import window_support

STEP = 6  # pixels


def opened():
    """Generator: a properties editor beside the viewport, with the object's transform, the same in all Blenders."""
    area = yield from window_support.add_area('PROPERTIES')
    area.spaces.active.context = 'OBJECT'
    yield


def editor():
    """The properties editor's area, and the region with its panels."""
    area = window_support.area('PROPERTIES')
    return area, next(one for one in area.regions if one.type == 'WINDOW')


def over():
    area, region = editor()
    return bpy.context.temp_override(window=window_support.window(), area=area, region=region)


def hover(wanted):
    """Generator: moves the mouse down the editor until it is over that property; its value is the place, or None."""
    _, region = editor()
    x = region.x + 11 * region.width // 20
    for y in range(region.y + region.height - STEP, region.y, -STEP):
        window_support.move(x, y)
        yield
        with over():
            if bpy.ops.ui.copy_data_path_button.poll():
                bpy.ops.ui.copy_data_path_button(full_path=False)
                if bpy.context.window_manager.clipboard.startswith(wanted):
                    return x, y
    return None


def picture_of(tab, name):
    """Generator: takes a picture, of a name, of that tab of the properties editor, wide in the place of the 3D viewport and narrow beside it."""
    yield from window_support.add_area('PROPERTIES')
    window_support.area('VIEW_3D').type = 'PROPERTIES'
    yield
    editors = window_support.window().screen.areas
    for area in editors:
        area.spaces.active.context = tab
    yield
    yield from window_support.picture(name)
    assert all(area.spaces.active.context == tab for area in editors)
    max(editors, key=lambda area: area.width * area.height).type = 'VIEW_3D'
    yield
