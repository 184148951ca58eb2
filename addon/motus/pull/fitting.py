"""Set the brush's default radius and strength by the size of an object."""

from mathutils import Vector

RADIUS_SHARE = 0.125  # radius, as a share of the object's longest side
STRENGTH_SHARE = 0.03  # strength, as a share of the radius; a held mouse makes twenty dabs a second


def fit(settings, obj):
    """Set radius and strength of the scene's brush by the size of an object, unless the user has changed them."""
    if settings.distance == 'EDGES':
        return  # with this distance the radius is a number of edges
    side = _longest_side(obj, settings.unit)
    if not 0.0 < side < float("inf"):
        return
    if _is_untouched(settings, "radius"):
        settings.radius = settings.fitted_radius = RADIUS_SHARE * side
    if _is_untouched(settings, "strength"):
        settings.strength = settings.fitted_strength = STRENGTH_SHARE * settings.radius


def _is_untouched(settings, name):
    return not settings.is_property_set(name) or getattr(settings, name) == getattr(settings, f"fitted_{name}")


def _longest_side(obj, unit):
    low, high = Vector(obj.bound_box[0]), Vector(obj.bound_box[6])
    sides = high - low
    if unit == 'WORLD':
        sides = Vector(abs(side * scale) for side, scale in zip(sides, obj.matrix_world.to_scale()))  # type: ignore[call-overload]
    return max(sides)  # type: ignore[call-overload]
