"""Properties of settings, as most of them are declared: library overrides may change them, and an edit evaluates the owner again.

`more` are further arguments of Blender's property, in place of those that stand here (`update`, `min`, `subtype`, ...). options:
ANIMATED if keys and drivers may set the property. tells_no_keys: whether the tooltip ends with the reason why they may not.
"""

import bpy

from .system_settings import NO_KEYS, OVERRIDABLE, touch


def _common(name, description, default, options, tells_no_keys, more):
    ending = NO_KEYS if tells_no_keys and not options else ""
    own = {"name": name, "description": description + ending, "default": default, "options": set(options)}
    return own | {"update": touch, "override": OVERRIDABLE} | more


def number(name, description, default, options=frozenset(), tells_no_keys=False, **more):
    """Declare a FloatProperty that library overrides may change."""
    return bpy.props.FloatProperty(**_common(name, description, default, options, tells_no_keys, more))


def factor(name, description, default, options=frozenset(), tells_no_keys=False, **more):
    """Declare a FloatProperty from 0 to 1, drawn as a slider, that library overrides may change."""
    return number(name, description, default, options, tells_no_keys, **{"min": 0.0, "max": 1.0, "subtype": 'FACTOR'} | more)


def whole(name, description, default, options=frozenset(), tells_no_keys=False, **more):
    """Declare an IntProperty that library overrides may change."""
    return bpy.props.IntProperty(**_common(name, description, default, options, tells_no_keys, more))


def switch(name, description, default=False, options=frozenset(), tells_no_keys=False, **more):
    """Declare a BoolProperty that library overrides may change."""
    return bpy.props.BoolProperty(**_common(name, description, default, options, tells_no_keys, more))


def choice(name, description, items, default, options=frozenset(), tells_no_keys=False, **more):
    """An EnumProperty."""
    return bpy.props.EnumProperty(items=items, **_common(name, description, default, options, tells_no_keys, more))


def vector(name, description, size=3, options=frozenset(), tells_no_keys=False, **more):
    """Declare a FloatVectorProperty that library overrides may change. Its default is all zeros."""
    return bpy.props.FloatVectorProperty(size=size, **_common(name, description, (0.0,) * size, options, tells_no_keys, more))
