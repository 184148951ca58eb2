"""Settings of the pull brush as plain values, and conversion between an object's local space and the world."""

import math
from dataclasses import dataclass

from ..core.file.choices import chosen
from ..core.lazy import numpy as np
from ..core.refusals import Refused
from ..core.translations import tr
from . import falloff_curve
from .properties import KEYWORDS, is_finite

CHOICES = ("unit", "falloff", "distance", "direction", "clamp_axis")
FINITE = ("radius", "strength", "scale_factor", "weld", "minimum", "maximum")
AXIS_INDEX = {'X': 0, 'Y': 1, 'Z': 2}
SMALLEST_SCALE = 1e-12
"""Least ratio of an object's smallest scale to its largest; below it the object's matrix counts as not invertible."""


@dataclass(frozen=True)
class Brush:
    """Values of the pull brush; the tooltips of BrushKeywords in properties.py explain them.

    Lengths are metres of the world, or lengths in the object's space if `unit` is LOCAL.
    """

    radius: float = 1.0
    unit: str = 'WORLD'
    strength: float = 0.1
    falloff: str = 'SMOOTH'
    scale_factor: float = 0.0
    distance: str = 'STRAIGHT'
    weld: float = 0.0
    direction: str = 'NORMAL'
    accumulate: bool = True
    mirror: frozenset = frozenset()
    use_minimum: bool = False
    minimum: float = -1.0
    use_maximum: bool = False
    maximum: float = 1.0
    clamp_axis: str = 'Z'
    vertex_group: str = ""
    curve: tuple = ()
    use_pressure_strength: bool = False
    use_pressure_size: bool = False

    @classmethod
    def of(cls, settings, given=None):
        """Create a Brush from the scene's brush settings.

        given: {keyword: value} that replace values of the scene's brush. Raises Refused if the values have no meaning.
        """
        values = {name: chosen(settings, name) if name in CHOICES else getattr(settings, name) for name in KEYWORDS}
        for name in ("use_pressure_strength", "use_pressure_size"):
            values[name] = getattr(settings, name)
        values.update(given or {})
        values["mirror"] = frozenset(values["mirror"])
        if values["falloff"] == 'CURVE' and "curve" not in values:
            values["curve"] = falloff_curve.samples(settings)
        values["curve"] = tuple(map(float, values.get("curve", ())))
        made = cls(**values)
        made.check()
        return made

    def check(self):
        """Raise Refused if a number is not finite, or the minimum exceeds the maximum."""
        for name in FINITE:
            if not is_finite(getattr(self, name)):
                raise Refused(tr("{keyword} is not a finite number").format(keyword=name))
        if not is_finite(self.curve):
            raise Refused(tr("{keyword} is not a finite number").format(keyword="curve"))
        if self.use_minimum and self.use_maximum and self.minimum > self.maximum:
            raise Refused(tr("The minimum is above the maximum"))

    def reach_of(self, radius):
        """Distance from the pulled vertex at and beyond which a pull with this radius moves nothing."""
        return math.sqrt(radius) if self.falloff == 'CLASSIC' else radius

    @property
    def profile(self):
        """Keyword arguments of native functions that say how the force of a pull fades with the distance from the pulled vertex."""
        curve = {"curve": np.array(self.curve, np.float32)} if self.falloff == 'CURVE' else {}
        return {"falloff": self.falloff.lower(), "scale_factor": self.scale_factor, **curve}

    @property
    def largest_force(self):
        """Largest ratio of a vertex's displacement to the displacement of the pulled vertex.

        Infinite if the brush has limits, which may move a vertex further.
        """
        if self.use_minimum or self.use_maximum:
            return math.inf
        return max(map(abs, self.curve), default=1.0) if self.falloff == 'CURVE' else 1.0

    def mirror_bits(self):
        """Return one integer for the pull itself (0) and for each of its mirror images.

        Its bits are the axes of the object that the image reverses (X: 1, Y: 2, Z: 4).
        """
        return mirror_bits(self.mirror)


def mirror_bits(axes):
    """Return Brush.mirror_bits() for mirrored axes, a sequence of 'X', 'Y' and 'Z'."""
    mask = sum(1 << AXIS_INDEX[axis] for axis in axes)
    return [bits for bits in range(8) if bits & ~mask == 0]


class Space:
    """Conversion between the local space of an object with this world matrix and the world. Raises Refused if the object is flat."""

    def __init__(self, matrix):
        self.matrix = np.array(matrix, float)
        self.linear = self.matrix[:3, :3]
        sizes = np.linalg.svd(self.linear, compute_uv=False) if np.isfinite(self.linear).all() else np.zeros(3)
        if sizes[-1] <= SMALLEST_SCALE * sizes[0]:
            raise Refused(tr("The object is scaled to nothing along an axis: change its scale first"))
        self.inverse = np.linalg.inv(self.linear)

    def metric(self, unit):
        """3x3 matrix that measures lengths: |metric @ v| is the length of a local vector v in the brush's unit."""
        return self.linear if unit == 'WORLD' else np.eye(3)

    def point_to_world(self, point):
        """World position of a local position (3,), or of rows of local positions (n, 3)."""
        return np.asarray(point, float) @ self.linear.T + self.matrix[:3, 3]

    def point_to_local(self, point):
        """Local position of a world position (3,), or of rows of world positions (n, 3)."""
        return (np.asarray(point, float) - self.matrix[:3, 3]) @ self.inverse.T

    def normal_to_world(self, normal):
        """World direction of length 1 for a local surface normal; a zero vector for a zero vector."""
        return unit(self.inverse.T @ np.asarray(normal, float))

    def is_skewed_by_mirrors(self, unit_name):
        """Whether reversing a local axis may change a vector's length in this unit, as happens in a sheared object."""
        products = self.metric(unit_name).T @ self.metric(unit_name)
        return bool(np.abs(products - np.diag(np.diag(products))).max() > 1e-6 * np.diag(products).max())

    def limits(self, brush):
        """Limits of the brush as (local axis, minimum, maximum), infinite if unused.

        None if the limits are along a world axis to which no local axis is parallel.
        """
        low = brush.minimum if brush.use_minimum else -math.inf
        high = brush.maximum if brush.use_maximum else math.inf
        axis = AXIS_INDEX[brush.clamp_axis]
        if brush.unit == 'LOCAL':
            return axis, low, high
        row = self.linear[axis]
        along = int(np.abs(row).argmax())
        if np.abs(np.delete(row, along)).max() > 1e-7 * abs(row[along]):
            return None
        ends = sorted((end - self.matrix[axis, 3]) / row[along] for end in (low, high))
        return along, ends[0], ends[1]

    def clamp(self, places, brush):
        """Move local positions (m, 3) between the brush's limits, along a local or a world axis; returns float32 (m, 3)."""
        axis = AXIS_INDEX[brush.clamp_axis]
        low = brush.minimum if brush.use_minimum else -math.inf
        high = brush.maximum if brush.use_maximum else math.inf
        is_world = brush.unit == 'WORLD'
        heights = (self.point_to_world(places) if is_world else places)[:, axis]
        way = self.inverse[:, axis] if is_world else np.eye(3)[axis]
        return (places + np.outer(np.clip(heights, low, high) - heights, way)).astype(np.float32)


def unit(vector):
    """Scale a vector to length 1; a zero vector, or one that is not finite, gives a zero vector."""
    length = np.linalg.norm(vector)
    return vector / length if length > 0.0 and np.isfinite(length) else np.zeros(3)
