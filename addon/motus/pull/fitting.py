"""A brush that suits the object, as long as the user has not set another one."""

from mathutils import Vector

RADIUS_SHARE = 0.125  # of the object's longest side
STRENGTH_SHARE = 0.03  # of the radius; a session's dabs come twenty times a second


def fit(settings, obj):
    """Set what nobody has changed of the scene's brush by the object's size in the brush's unit."""
    if settings.distance == 'EDGES':
        return  # the radius counts edges
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
