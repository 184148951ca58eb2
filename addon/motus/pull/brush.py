"""Settings of the pull brush as plain values, and the transform between the object's space and the world."""

import math
from dataclasses import dataclass

from ..core.file.choices import chosen
from ..core.lazy import numpy as np
from ..core.refusals import Refused
from ..core.translations import tr
from . import falloff_curve
from .properties import KEYWORDS, is_finite

CHOICES = ("unit", "falloff", "distance", "direction", "clamp_axis")
FINITE = ("radius", "strength", "scale_factor", "minimum", "maximum")
AXIS_INDEX = {'X': 0, 'Y': 1, 'Z': 2}
SMALLEST_SCALE = 1e-12
"""Least ratio of an object's smallest scale to its largest one; a flatter object has no inverse matrix."""


@dataclass(frozen=True)
class Brush:
    """Values of the brush; BrushKeywords in properties.py explains them.

    Lengths are metres of the world, or units of the object if unit is LOCAL.
    """

    radius: float = 1.0
    unit: str = 'WORLD'
    strength: float = 0.1
    falloff: str = 'SMOOTH'
    scale_factor: float = 0.0
    distance: str = 'STRAIGHT'
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
        """The scene's brush, with the values of `given` (keyword -> value) in place of its own. Raises Refused."""
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
        """Raise Refused if a number is not finite or the limits exclude each other."""
        for name in FINITE:
            if not is_finite(getattr(self, name)):
                raise Refused(tr("{keyword} is not a finite number").format(keyword=name))
        if not is_finite(self.curve):
            raise Refused(tr("{keyword} is not a finite number").format(keyword="curve"))
        if self.use_minimum and self.use_maximum and self.minimum > self.maximum:
            raise Refused(tr("The minimum is above the maximum"))

    def reach_of(self, radius):
        """Distance from the root at and beyond which the pull moves nothing."""
        return math.sqrt(radius) if self.falloff == 'CLASSIC' else radius

    @property
    def profile(self):
        """Keyword arguments of the library's functions that say how the force fades with the distance."""
        curve = {"curve": np.array(self.curve, np.float32)} if self.falloff == 'CURVE' else {}
        return {"falloff": self.falloff.lower(), "scale_factor": self.scale_factor, **curve}

    @property
    def largest_force(self):
        """Largest factor between a vertex's displacement and the root's; infinite if limits may move a vertex further."""
        if self.use_minimum or self.use_maximum:
            return math.inf
        return max(map(abs, self.curve), default=1.0) if self.falloff == 'CURVE' else 1.0

    def mirror_bits(self):
        """Axes that each mirror image of a pull reverses, as bits (x 1, y 2, z 4); the first entry is the pull itself."""
        mask = sum(1 << AXIS_INDEX[axis] for axis in self.mirror)
        return [bits for bits in range(8) if bits & ~mask == 0]


class Space:
    """Transform between an object's space and the world."""

    def __init__(self, matrix):
        self.matrix = np.array(matrix, float)
        self.linear = self.matrix[:3, :3]
        sizes = np.linalg.svd(self.linear, compute_uv=False) if np.isfinite(self.linear).all() else np.zeros(3)
        if sizes[-1] <= SMALLEST_SCALE * sizes[0]:
            raise Refused(tr("The object is scaled to nothing along an axis: change its scale first"))
        self.inverse = np.linalg.inv(self.linear)

    def metric(self, unit):
        """3x3 matrix: the length of metric @ vector is the length of a local vector in the brush's unit."""
        return self.linear if unit == 'WORLD' else np.eye(3)

    def point_to_world(self, point):
        """World positions of a local point, or of rows of local points."""
        return np.asarray(point, float) @ self.linear.T + self.matrix[:3, 3]

    def point_to_local(self, point):
        """Local positions of a world point, or of rows of world points."""
        return (np.asarray(point, float) - self.matrix[:3, 3]) @ self.inverse.T

    def normal_to_world(self, normal):
        """World direction of a local normal, with length 1; zero for a zero vector."""
        return unit(self.inverse.T @ np.asarray(normal, float))

    def is_skewed_by_mirrors(self, unit_name):
        """Whether mirroring a vector on the object's axes may change its length, as on a sheared object."""
        products = self.metric(unit_name).T @ self.metric(unit_name)
        return bool(np.abs(products - np.diag(np.diag(products))).max() > 1e-6 * np.diag(products).max())

    def limits(self, brush):
        """Limits of the brush along a local axis: (axis, minimum, maximum); None if no local axis is parallel to the limits' axis."""
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
        """Move local places (m, 3) between the brush's limits, along any axis."""
        axis = AXIS_INDEX[brush.clamp_axis]
        low = brush.minimum if brush.use_minimum else -math.inf
        high = brush.maximum if brush.use_maximum else math.inf
        is_world = brush.unit == 'WORLD'
        heights = (self.point_to_world(places) if is_world else places)[:, axis]
        way = self.inverse[:, axis] if is_world else np.eye(3)[axis]
        return (places + np.outer(np.clip(heights, low, high) - heights, way)).astype(np.float32)


def unit(vector):
    """The vector scaled to length 1; a zero vector stays zero."""
    length = np.linalg.norm(vector)
    return vector / length if length > 0.0 and np.isfinite(length) else np.zeros(3)
