"""Copy F-curves and drivers of a number property to a different number property, also of a different datablock."""

from __future__ import annotations

from typing import Any

import bpy

from . import actions

_KEY_FIELDS = (
    "co",
    "handle_left",
    "handle_right",
    "handle_left_type",
    "handle_right_type",
    "interpolation",
    "easing",
    "back",
    "amplitude",
    "period",
    "type",
)


def copy_all(id_data: Any, path: str, holder: Any, name: str) -> None:
    """Copy the keys and the driver of the number property at data path `path` of a datablock to a different number property.

    holder, name: item of a datablock, such as an entry of a list, and its property that receives the keys and the driver.
    """
    animation = id_data.animation_data
    for curve in [curve for curve in actions.fcurves(id_data) if curve.data_path == path]:
        copy_curve(curve, holder, name)
    for curve in [curve for curve in animation.drivers if curve.data_path == path] if animation else ():
        copy_driver(curve, holder, name)


def copy_curve(source: Any, holder: Any, name: str) -> bpy.types.FCurve:
    """Copy keys, extrapolation and modifiers of an F-curve to a number property; returns the new F-curve.

    source: the F-curve. holder, name: item of a datablock, such as an entry of a list, and its property that receives the keys.
    """
    holder.keyframe_insert(name, frame=source.keyframe_points[0].co.x if source.keyframe_points else 0.0)
    target: Any = actions.find(holder.id_data, f"{holder.path_from_id()}.{name}")
    for point in reversed(target.keyframe_points):
        target.keyframe_points.remove(point)
    target.keyframe_points.add(len(source.keyframe_points))
    for old, new in zip(source.keyframe_points, target.keyframe_points):
        for field in _KEY_FIELDS:
            setattr(new, field, getattr(old, field))
    target.extrapolation = source.extrapolation
    for modifier in source.modifiers:
        _copy_settings(modifier, target.modifiers.new(modifier.type))
    target.update()
    return target


def copy_driver(source: Any, holder: Any, name: str) -> None:
    """Copy a driver to a property. source: the driver's F-curve. holder, name: item of a datablock and its property to be driven."""
    animation = holder.id_data.animation_data or holder.id_data.animation_data_create()
    made = animation.drivers.from_existing(src_driver=source)
    made.data_path = f"{holder.path_from_id()}.{name}"


def _copy_settings(source: Any, target: Any) -> None:
    for prop in source.bl_rna.properties:
        if not prop.is_readonly and prop.identifier != "rna_type":
            setattr(target, prop.identifier, getattr(source, prop.identifier))
