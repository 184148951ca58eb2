"""The properties editor with an object's transform, and the mouse over one of its properties."""

import bpy

from window import window_support

STEP = 6  # pixels


def editor():
    """The properties editor's region with the object's transform, the same in all Blenders."""
    area = window_support.area('PROPERTIES')
    area.spaces.active.context = 'OBJECT'
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
    """Generator: takes a picture, of a name, of that tab of the properties editor, in the place of the 3D viewport too."""
    window_support.area('VIEW_3D').type = 'PROPERTIES'
    yield
    editors = [area for area in window_support.window().screen.areas if area.type == 'PROPERTIES']
    for area in editors:
        area.spaces.active.context = tab
    yield
    yield from window_support.picture(name)
    assert all(area.spaces.active.context == tab for area in editors)
    max(editors, key=lambda area: area.width * area.height).type = 'VIEW_3D'
    yield
