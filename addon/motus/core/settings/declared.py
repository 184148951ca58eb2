"""Declare properties of settings that library overrides may change. An edit of such a property evaluates the owner again.

options: ANIMATED if keys and drivers may set the property, {'HIDDEN'} if no panel shows it. tells_no_keys: whether the tooltip of a property
that is not ANIMATED ends with the reason why it cannot be keyed. more: further arguments of the function of bpy.props, which replace those
that are set here (`update`, `min`, `subtype`, ...).
"""

import bpy

from .system_settings import NO_KEYS, OVERRIDABLE, touch


def _common(name, description, default, options, tells_no_keys, more):
    ending = NO_KEYS if tells_no_keys and 'ANIMATABLE' not in options else ""
    own = {"name": name, "description": description + ending, "default": default, "options": set(options)}
    return own | {"update": touch, "override": OVERRIDABLE} | more


def number(name, description, default, options=frozenset(), tells_no_keys=False, **more):
    """Declare a FloatProperty that library overrides may change and whose edit evaluates the owner again."""
    return bpy.props.FloatProperty(**_common(name, description, default, options, tells_no_keys, more))


def factor(name, description, default, options=frozenset(), tells_no_keys=False, **more):
    """Declare a FloatProperty from 0 to 1, drawn as a slider, that library overrides may change."""
    return number(name, description, default, options, tells_no_keys, **{"min": 0.0, "max": 1.0, "subtype": 'FACTOR'} | more)


def whole(name, description, default, options=frozenset(), tells_no_keys=False, **more):
    """Declare an IntProperty that library overrides may change and whose edit evaluates the owner again."""
    return bpy.props.IntProperty(**_common(name, description, default, options, tells_no_keys, more))


def switch(name, description, default=False, options=frozenset(), tells_no_keys=False, **more):
    """Declare a BoolProperty that library overrides may change and whose edit evaluates the owner again."""
    return bpy.props.BoolProperty(**_common(name, description, default, options, tells_no_keys, more))


def choice(name, description, items, default, options=frozenset(), tells_no_keys=False, **more):
    """Declare an EnumProperty that library overrides may change and whose edit evaluates the owner again.

    items: as for bpy.props.EnumProperty.
    """
    return bpy.props.EnumProperty(items=items, **_common(name, description, default, options, tells_no_keys, more))


def vector(name, description, size=3, options=frozenset(), tells_no_keys=False, **more):
    """Declare a FloatVectorProperty that library overrides may change and whose edit evaluates the owner again.

    size: number of components. The default is 0 for each component.
    """
    return bpy.props.FloatVectorProperty(size=size, **_common(name, description, (0.0,) * size, options, tells_no_keys, more))
