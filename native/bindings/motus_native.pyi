"""Native core of Motus.

Arrays are NumPy float64 unless said; (m, 3) means m rows of x, y, z. Metres, radians and seconds; quaternions w, x, y, z.
A wrong shape, type or value raises ValueError or TypeError that names the argument. Parameters and lengths outside a
curve's interval never raise: extend = "clamp" | "extrapolate" | "loop" | "ping_pong" says what they mean. help() of each
name is its manual.
"""

from typing import Literal, Union, overload

import numpy as np
from numpy.typing import ArrayLike, NDArray

_Array = NDArray[np.float64]
_Number = Union[float, int]
_Extend = Literal["clamp", "extrapolate", "loop", "ping_pong"]
_Mode = Literal["world_up", "minimal", "banking", "curvature", "tilt"]
_Axis = Literal["X", "Y", "Z", "-X", "-Y", "-Z"]

__version__: str

class Curve:
    """A curve of Bezier segments of one degree, t in [0, segment_count]; the base of the classes below. Immutable."""

    @property
    def degree(self) -> int: ...
    @property
    def segment_count(self) -> int: ...
    @property
    def cyclic(self) -> bool: ...
    @property
    def control_points(self) -> _Array: ...  # a copy: (degree + 1, 3) of a Bezier, else (segment_count, degree + 1, 3)

    # t, s: a number or (m,). Results (3,) or (m, 3) for vectors, a float or (m,) for numbers.
    def position(self, t: ArrayLike, extend: _Extend = "clamp") -> _Array: ...
    def derivative(self, t: ArrayLike, order: int = 1, extend: _Extend = "clamp") -> _Array: ...  # order 1, 2 or 3
    def tangent(self, t: ArrayLike, extend: _Extend = "clamp") -> _Array: ...  # unit vectors
    @overload
    def curvature(self, t: _Number, extend: _Extend = "clamp") -> float: ...
    @overload
    def curvature(self, t: ArrayLike, extend: _Extend = "clamp") -> _Array: ...
    @overload
    def torsion(self, t: _Number, extend: _Extend = "clamp") -> float: ...
    @overload
    def torsion(self, t: ArrayLike, extend: _Extend = "clamp") -> _Array: ...
    def length(self) -> float: ...
    @overload
    def length_at(self, t: _Number, extend: _Extend = "clamp") -> float: ...
    @overload
    def length_at(self, t: ArrayLike, extend: _Extend = "clamp") -> _Array: ...
    @overload
    def t_at_length(self, s: _Number, extend: _Extend = "clamp") -> float: ...
    @overload
    def t_at_length(self, s: ArrayLike, extend: _Extend = "clamp") -> _Array: ...
    def position_at_length(self, s: ArrayLike, extend: _Extend = "clamp") -> _Array: ...

    # (t, position, distance): float, (3,), float for a point (3,); (m,), (m, 3), (m,) for points (m, 3).
    def nearest(self, point: ArrayLike) -> tuple: ...
    def bounds(self) -> tuple[_Array, _Array]: ...  # (min, max), each (3,)
    def split(self, t: float) -> tuple[Curve, Curve]: ...  # (before, after)
    def elevate(self, times: int = 1) -> Curve: ...
    def reversed(self) -> Curve: ...
    def transformed(self, matrix: ArrayLike) -> Curve: ...  # (4, 4) in rows, affine

class Bezier(Curve):
    """One segment of any degree n from 1 to 64, t in [0, 1]."""

    def __init__(self, control_points: ArrayLike) -> None: ...  # (n + 1, 3)

class Spline(Curve):
    """Cubic segments through points with two handles each, as Blender's Bezier splines."""

    def __init__(
        self,
        points: ArrayLike,  # (k, 3), k >= 2
        handles_left: ArrayLike,  # (k, 3)
        handles_right: ArrayLike,  # (k, 3)
        cyclic: bool = False,  # adds the segment from the last point to the first
    ) -> None: ...

class Chain(Curve):
    """Bezier segments of one degree, each with its own control points."""

    def __init__(
        self,
        control_points: ArrayLike,  # (segments, degree + 1, 3)
        cyclic: bool = False,  # says that the end is the start; adds no segment
    ) -> None: ...

class BSpline(Curve):
    """Blender's NURBS spline with all weights 1, exactly, as Bezier segments."""

    def __init__(
        self,
        points: ArrayLike,  # (k, 3), k >= 2
        order: int = 4,  # 2 to 6
        cyclic: bool = False,
        use_endpoint: bool = False,
        use_bezier: bool = False,
    ) -> None: ...

class PolyLine(Curve):
    """Straight segments from point to point, as Blender's poly splines."""

    def __init__(
        self,
        points: ArrayLike,  # (k, 3), k >= 2
        cyclic: bool = False,  # adds the segment from the last point to the first
    ) -> None: ...

# Fraction of the way at fraction u of the time, and its derivative; ease_in + ease_out <= 1.
@overload
def ease(u: _Number, ease_in: float, ease_out: float) -> float: ...
@overload
def ease(u: ArrayLike, ease_in: float, ease_out: float) -> _Array: ...
@overload
def ease_derivative(u: _Number, ease_in: float, ease_out: float) -> float: ...
@overload
def ease_derivative(u: ArrayLike, ease_in: float, ease_out: float) -> _Array: ...

class Timing:
    """Distance as a function of time. Immutable; made by one of the static methods."""

    @staticmethod
    def eased(duration: float, length: float, ease_in: float = 0.0, ease_out: float = 0.0) -> Timing: ...
    @staticmethod
    def constant(speed: float) -> Timing: ...
    @staticmethod
    def pins(times: ArrayLike, distances: ArrayLike) -> Timing: ...  # (k,) each, times strictly increasing
    @staticmethod
    def speeds(times: ArrayLike, speeds: ArrayLike) -> Timing: ...  # (k,) each, times strictly increasing
    @staticmethod
    def speeds_by_distance(distances: ArrayLike, speeds: ArrayLike) -> Timing: ...  # (k,) each, speeds > 0
    @overload
    def distance(self, time: _Number) -> float: ...
    @overload
    def distance(self, time: ArrayLike) -> _Array: ...
    @overload
    def speed(self, time: _Number) -> float: ...
    @overload
    def speed(self, time: ArrayLike) -> _Array: ...

# Quaternions (m, 4), or (4,) for a number, that turn +Y to the tangent and +Z to up.
# Options by mode: banking: speed (a number or (m,), 1.0), strength (1.0), gravity (9.81), limit (rad, 3.2), smoothing (a
# length, 0.0); curvature: outward (False), smoothing (0.0); tilt: tilt (one value per point, rad; needed).
def frames(
    curve: Curve,
    lengths: ArrayLike,  # a number or (m,)
    mode: _Mode,
    extend: _Extend = "clamp",
    **options: object,
) -> _Array: ...

# (locations (n, 3), rotations (n, 4)) of followers at one time. Options as in frames(), without speed.
def follow(
    curve: Curve,
    timing: Timing,
    time: float,
    offsets: ArrayLike,  # a number or (n,), along the curve
    mode: _Mode,
    extend: _Extend = "clamp",
    forward: _Axis = "Y",
    up: _Axis = "Z",
    rotate: bool = True,
    lag_rate: float = 0.0,
    lag_by: Literal["acceleration", "curvature"] = "acceleration",
    locations: _Array | None = None,  # (n, 3), C-contiguous, written into
    rotations: _Array | None = None,  # (n, 4), C-contiguous, written into
    **options: object,
) -> tuple[_Array, _Array]: ...

# Blender's Euler angles XYZ of quaternions: (m, 3) of (m, 4), or (3,) of (4,).
def euler_xyz(
    rotations: ArrayLike,
    out: _Array | None = None,  # (m, 3) or (3,), C-contiguous, written into
) -> _Array: ...

# 4 x 4 matrices of scale 1, column by column: (m, 16) float32 of (m, 3) and (m, 4).
def pack_matrices(
    locations: ArrayLike,
    rotations: ArrayLike,
    out: NDArray[np.float32] | None = None,  # (m, 16), C-contiguous, written into
) -> NDArray[np.float32]: ...
