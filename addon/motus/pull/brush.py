"""A brush's settings as plain values, and the object's space that they are measured in."""

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
"""Of the largest one: an object that is flatter than that has no inverse."""


@dataclass(frozen=True)
class Brush:
    """See BrushKeywords in properties.py; lengths in metres of the world, or of the object where unit is LOCAL."""

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
        """The scene's brush, with what `given` (keyword -> value) has instead. May raise Refused."""
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
        """Raise Refused where a number is none, or the limits exclude each other."""
        for name in FINITE:
            if not is_finite(getattr(self, name)):
                raise Refused(tr("{keyword} is not a finite number").format(keyword=name))
        if not is_finite(self.curve):
            raise Refused(tr("{keyword} is not a finite number").format(keyword="curve"))
        if self.use_minimum and self.use_maximum and self.minimum > self.maximum:
            raise Refused(tr("The minimum is above the maximum"))

    def reach_of(self, radius):
        """The distance from the root at and beyond which nothing moves."""
        return math.sqrt(radius) if self.falloff == 'CLASSIC' else radius

    @property
    def profile(self):
        """Keyword arguments of the native functions that say how the force fades."""
        curve = {"curve": np.array(self.curve, np.float32)} if self.falloff == 'CURVE' else {}
        return {"falloff": self.falloff.lower(), "scale_factor": self.scale_factor, **curve}

    @property
    def largest_force(self):
        """No vertex moves by more than so many times the root's way; infinite where limits may move it further."""
        if self.use_minimum or self.use_maximum:
            return math.inf
        return max(map(abs, self.curve), default=1.0) if self.falloff == 'CURVE' else 1.0

    def mirror_bits(self):
        """For each image of a pull, its own first: the axes that are turned round, x 1, y 2, z 4."""
        mask = sum(1 << AXIS_INDEX[axis] for axis in self.mirror)
        return [bits for bits in range(8) if bits & ~mask == 0]


class Space:
    """The way between an object's space and the world."""

    def __init__(self, matrix):
        self.matrix = np.array(matrix, float)
        self.linear = self.matrix[:3, :3]
        sizes = np.linalg.svd(self.linear, compute_uv=False) if np.isfinite(self.linear).all() else np.zeros(3)
        if sizes[-1] <= SMALLEST_SCALE * sizes[0]:
            raise Refused(tr("The object is scaled to nothing along an axis: change its scale first"))
        self.inverse = np.linalg.inv(self.linear)

    def metric(self, unit):
        """3x3: the length of its product with a vector of the object is what counts as the vector's length."""
        return self.linear if unit == 'WORLD' else np.eye(3)

    def point_to_world(self, point):
        """Of one point, or of rows of them."""
        return np.asarray(point, float) @ self.linear.T + self.matrix[:3, 3]

    def point_to_local(self, point):
        """Of one point, or of rows of them."""
        return (np.asarray(point, float) - self.matrix[:3, 3]) @ self.inverse.T

    def normal_to_world(self, normal):
        """Unit; zero for a zero vector."""
        return unit(self.inverse.T @ np.asarray(normal, float))

    def is_skewed_by_mirrors(self, unit_name):
        """Whether a mirrored way, as the object has its axes, may be of another length."""
        products = self.metric(unit_name).T @ self.metric(unit_name)
        return bool(np.abs(products - np.diag(np.diag(products))).max() > 1e-6 * np.diag(products).max())

    def limits(self, brush):
        """(local axis, minimum, maximum) that say the same as the brush's limits; None where no local axis does."""
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
        """Local places (m, 3) brought between the brush's limits, whatever its axis."""
        axis = AXIS_INDEX[brush.clamp_axis]
        low = brush.minimum if brush.use_minimum else -math.inf
        high = brush.maximum if brush.use_maximum else math.inf
        is_world = brush.unit == 'WORLD'
        heights = (self.point_to_world(places) if is_world else places)[:, axis]
        way = self.inverse[:, axis] if is_world else np.eye(3)[axis]
        return (places + np.outer(np.clip(heights, low, high) - heights, way)).astype(np.float32)


def unit(vector):
    """The vector at length 1; zero where it has none."""
    length = np.linalg.norm(vector)
    return vector / length if length > 0.0 and np.isfinite(length) else np.zeros(3)
