"""The order of an override's drivers, which has to be that of its library's.

Blender knows the drivers of an override by their places in the list. What it saves of one, the targets of its variables, it
gives to whichever driver has that place in the library when the file is loaded: where the wiring had taken drivers away and
added others at the end, that would be one of the user's. So they are put back in the library's order, and where the library
has a driver of ours that is not needed, a muted one without variables stands for it.
"""

PREFIX = '["motus_'
"""Data paths of outboxes, and of their slots, begin so."""


def align(owner):
    """Put an override's drivers in the order of its library's. Those that the library has not come last."""
    theirs = _of_library(owner)
    if not theirs:
        return
    drivers = owner.animation_data_create().drivers
    present = {_key(curve) for curve in drivers}
    for curve in theirs:
        if _key(curve) not in present and _is_ours(curve):
            _stand_in(drivers, curve)
    places = {_key(curve): place for place, curve in enumerate(theirs)}
    _sort(drivers, lambda curve: places.get(_key(curve), len(places)))


def drop_stand_ins(owner):
    """Remove what align() added."""
    if not _of_library(owner) or not owner.animation_data:
        return
    drivers = owner.animation_data.drivers
    for curve in [curve for curve in drivers if curve.mute and not curve.driver.variables]:
        if any(_key(curve) == _key(one) and _is_ours(one) for one in _of_library(owner)):
            drivers.remove(curve)


def _of_library(owner):
    reference = owner.override_library and owner.override_library.reference
    return reference.animation_data.drivers if reference and reference.animation_data else ()


def _key(curve):
    return curve.data_path, curve.array_index


def _is_ours(curve):
    return curve.data_path.startswith(PREFIX) or any(
        target.data_path.startswith(PREFIX) for variable in curve.driver.variables for target in variable.targets
    )


def _stand_in(drivers, theirs):
    curve = drivers.from_existing(src_driver=theirs)
    while curve.driver.variables:
        curve.driver.variables.remove(curve.driver.variables[0])
    curve.driver.type = 'SCRIPTED'
    curve.driver.expression = "0.0"
    curve.mute = True


def _sort(drivers, place):
    """Sort a list of drivers, which Blender lets nobody move, by copies at its end."""
    now = list(drivers)
    wanted = sorted(now, key=place)
    right = next((index for index, (one, other) in enumerate(zip(now, wanted)) if one != other), len(now))
    moved = wanted[right:]
    for curve in moved:
        drivers.from_existing(src_driver=curve)
    for curve in moved:
        drivers.remove(curve)
