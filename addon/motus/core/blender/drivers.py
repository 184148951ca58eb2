"""Functions that add, find and remove drivers."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from typing import Any

import bpy

from . import actions, poses


def add(owner: Any, path: str, expression: str, variables: dict[str, Any], index: int | None = None, use_self: bool = False) -> None:
    """Add a driver with a Python expression to a property.

    variables: {name: Variable} that the expression reads. index: in an array property; None for a property that is no array. use_self:
    whether the expression may use `self`, the struct that has the property.
    """
    driver = _new(owner, path, index, variables)
    driver.type = 'SCRIPTED'
    driver.use_self = use_self
    driver.expression = expression


def copy_value(owner: Any, path: str, source: Any = None, index: int | None = None, name: str = "") -> None:
    """Add a driver without Python that gives a property the value of a Variable, or 0 if `source` is None.

    index: in an array property; None for a property that is no array. name: of the driver's variable; only expressions need one.
    """
    _new(owner, path, index, {name: source} if source else {}).type = 'SUM'


def _new(owner: Any, path: str, index: int | None, variables: dict[str, Any]) -> bpy.types.Driver:
    """Add a driver to a property, without keys or modifiers on the driver's F-curve, in place of the property's present driver.

    owner: datablock, or struct of it, such as a constraint. path: from the owner. variables: {name: Variable}. With an empty name, the
    variable keeps the name that Blender gives it. index: in an array property; None for a property that is no array. Returns the Driver.
    """
    if owner != owner.id_data:
        path = f"{owner.path_from_id()}.{path}"
    animation = owner.id_data.animation_data_create()
    present = animation.drivers.find(path, index=index or 0)
    if present is not None:
        animation.drivers.remove(present)
    # When a target is set, Blender 3.4 goes through all drivers of the datablock: 0.1 ms where there are 300. So a driver is made on a
    # datablock without others, which is gone again when the driver has been copied.
    bench = bpy.data.cameras.new("Motus")
    value = owner.id_data.path_resolve(path)
    bench["value"] = float(value if index is None else value[index])
    try:
        curve = animation.drivers.from_existing(src_driver=_on(bench, variables))
    finally:
        bpy.data.cameras.remove(bench, do_unlink=False, do_id_user=False, do_ui_user=False)
    curve.data_path, curve.array_index = path, index or 0
    return curve.driver


def _on(bench: Any, variables: dict[str, Any]) -> Any:
    """Add a driver with these variables to a camera's property "value"; returns the driver's F-curve.

    Blender makes the property's value the expression of its driver, which is seen if somebody makes it a scripted one.
    """
    curve = bench.driver_add('["value"]')
    # Blender maps a driver's value through the driver's F-curve. In 5.x that has two keys, at 0 and 1, and a value that is within
    # 1e-4 above a key is snapped onto the key. An F-curve without keys and modifiers passes the value on unchanged.
    while curve.modifiers:
        curve.modifiers.remove(curve.modifiers[0])
    for key in reversed(curve.keyframe_points):
        curve.keyframe_points.remove(key)
    for name, source in variables.items():
        variable = curve.driver.variables.new()
        if name:
            variable.name = name
        if source.is_transform:
            variable.type = 'TRANSFORMS'
        target = variable.targets[0]
        if source.id_type != 'OBJECT':
            target.id_type = source.id_type
        target.id = source.id
        if source.is_transform:
            target.bone_target = source.bone
            target.transform_space = 'WORLD_SPACE'
        else:
            target.data_path = source.data_path
    return curve


def remove_under(id_data: Any, prefix: str) -> None:
    """Remove every driver of a datablock whose data path begins with `prefix`."""
    remove_where(id_data, lambda path: path.startswith(prefix))


def remove_where(id_data: Any, is_meant: Callable[[str], bool]) -> None:
    """Remove every driver of a datablock for whose data path is_meant(data path) is true."""
    animation = id_data.animation_data
    if animation is None:
        return
    for curve in [c for c in animation.drivers if is_meant(c.data_path)]:
        animation.drivers.remove(curve)


def drop_empty_animation(id_data: Any) -> None:
    """Remove a datablock's animation data if it has no action, drivers or NLA tracks, so that a removed system leaves nothing."""
    animation = id_data.animation_data
    if animation and not animation.action and not animation.drivers and not animation.nla_tracks:
        id_data.animation_data_clear()


def driven_bones(obj: Any) -> set[str]:
    """Names of the bones of an object that have a driver on their own location, rotation or scale."""
    animation = obj.animation_data
    matches = (actions.OWN_CHANNEL.match(curve.data_path) for curve in (animation.drivers if animation else ()))
    return {poses.bone_named(obj, match) for match in matches} - {""}


def targets_on(read: set[Any]) -> Iterator[tuple[Any, Any, Any, int]]:
    """Yield (datablock, driver, variable, index of the target) for each target of a driver that reads a datablock in `read`.

    datablock: has the driver. driver: the driver's F-curve. Drivers of linked datablocks are left out.
    """
    for holder, curve in _drivers_of(set().union(*bpy.data.user_map(subset=read).values())):
        for variable in curve.driver.variables:
            for index, target in enumerate(variable.targets):
                if target.id in read:
                    yield holder, curve, variable, index


def _drivers_of(users: Iterable[Any]) -> Iterator[tuple[Any, Any]]:
    """Yield (datablock, driver's F-curve) for all drivers of datablocks and of their node trees, except linked ones."""
    for user in users:
        for holder in (user, getattr(user, "node_tree", None)):
            animation = getattr(holder, "animation_data", None)
            if holder and animation and not holder.library:
                for curve in animation.drivers:
                    yield holder, curve
