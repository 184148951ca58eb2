"""Keep the drivers of a library override in the order of the library's drivers.

Blender identifies the drivers of an override by their positions in the list. When a file is loaded, the saved targets of a driver's
variables are given to the driver at that position in the library. If the wiring (the setting up of a system on an object) had removed
drivers and added new ones at the end, the targets could reach a driver that an artist has added. Drivers are therefore put back into the
library's order. If the library has a driver of Motus that the override does not need, a muted driver without variables takes its position.
"""

PREFIX = '["motus_'
"""Beginning of the data paths of outboxes, the custom properties with a solver's results, and of their slots."""


def align(owner):
    """Sort the drivers of a library override in the order of its library's drivers; drivers that the library does not have come last.

    Nothing happens if the object is no override, or if the library's object has no drivers. If the library has a driver of Motus that the
    override lacks, a muted driver without variables is added at its position.
    """
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
    """Remove the muted drivers without variables that align() has added to a library override."""
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
    """Sort the drivers of an object by a key function, `place`, which is called with the F-curve of a driver.

    Blender has no function that moves drivers, so copies are added at the end and the old drivers removed. drivers: AnimData.drivers.
    """
    now = list(drivers)
    wanted = sorted(now, key=place)
    right = next((index for index, (one, other) in enumerate(zip(now, wanted)) if one != other), len(now))
    moved = wanted[right:]
    for curve in moved:
        drivers.from_existing(src_driver=curve)
    for curve in moved:
        drivers.remove(curve)
