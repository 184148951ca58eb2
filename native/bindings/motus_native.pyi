"""Native core of Motus.

Arrays are NumPy float64 unless said; (m, 3) means m rows of x, y, z. Metres, radians and seconds; quaternions w, x, y, z.
A wrong shape, type or value raises ValueError or TypeError that names the argument. Parameters and lengths outside a
curve's interval never raise: extend = "clamp" | "extrapolate" | "loop" | "ping_pong" says what they mean. help() of each
name is its manual.
"""

from enum import IntEnum
from typing import Callable, Literal, Sequence, Union, overload

import numpy as np
from numpy.typing import ArrayLike, NDArray

_Array = NDArray[np.float64]
_Number = Union[float, int]
_Extend = Literal["clamp", "extrapolate", "loop", "ping_pong"]
_Mode = Literal["world_up", "minimal", "banking", "curvature", "tilt"]
_Axis = Literal["X", "Y", "Z", "-X", "-Y", "-Z"]
_EmitterShape = Literal["square", "disc", "box", "sphere", "cone", "surface", "frustum"]
_Collision = Literal["stay", "slide", "melt"]
_StereoMode = Literal["off_axis", "parallel", "toe_in"]
_FlakeField = Literal["position", "velocity", "size", "color", "age", "rotation", "id"]
_Gait = Literal["tripod", "tetrapod", "ripple", "wave", "trot", "pace"]
_Basis = Literal["bernstein", "linear", "cardinal", "catmull_rom", "bspline"]

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
    def eased(duration: float, length: float, ease_in: float = 0.0, ease_out: float = 0.0,
              after: str = "rest") -> Timing: ...
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

# Seconds that a lagging orientation remembers.
LAG_MEMORY: float

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
    line_up: bool = False,
    **options: object,
) -> tuple[_Array, _Array]: ...

# Blender's Euler angles XYZ of quaternions: (m, 3) of (m, 4), or (3,) of (4,).
def euler_xyz(
    rotations: ArrayLike,
    out: _Array | None = None,  # (m, 3) or (3,), C-contiguous, written into
) -> _Array: ...

# 4 x 4 matrices, column by column: (m, 16) float32 of (m, 3), (m, 4) and (m, 3).
def pack_matrices(
    locations: ArrayLike,
    rotations: ArrayLike,
    out: NDArray[np.float32] | None = None,  # (m, 16), C-contiguous, written into
    scales: ArrayLike | None = None,  # None: 1
) -> NDArray[np.float32]: ...

class Reason(IntEnum):
    """What kept the end of a chain from its target."""

    REACHED = 0  # the end is on the target, within the tolerance
    TOO_FAR = 1  # the target is farther than the chain, or softness, reaches
    TOO_NEAR = 2  # it is nearer to the root than the chain can fold
    LIMIT = 3  # a joint limit is in the way
    ITERATIONS = 4  # the iterations allowed were used up

class TwoBoneSolution:
    """Of one chain values, of m chains arrays with m rows."""

    @property
    def elbow(self) -> _Array: ...  # (3,) or (m, 3)
    @property
    def tip(self) -> _Array: ...  # (3,) or (m, 3)
    @property
    def normal(self) -> _Array: ...  # (3,) or (m, 3), unit; cross(normal, target - root) points to the elbow's side
    @property
    def scale(self) -> Union[float, _Array]: ...  # of both bones, > 1 where they are stretched
    @property
    def residual(self) -> Union[float, _Array]: ...  # distance from tip to target
    @property
    def reason(self) -> Union[Reason, NDArray[np.int64]]: ...  # REACHED, TOO_FAR or TOO_NEAR

# Points (3,) or (m, 3), numbers one or (m,); what is given once counts for all chains.
def solve_two_bone(
    root: ArrayLike,
    target: ArrayLike,
    length1: ArrayLike,  # root to elbow, >= 0
    length2: ArrayLike,  # elbow to tip, >= 0
    pole: ArrayLike,  # point that the elbow bends towards, seen across root-target
    bend: ArrayLike = 1,  # 1: towards the pole; -1: away
    softness: ArrayLike = 0.0,  # length before the full reach at which the arm begins to slow
    stretch: ArrayLike = 0.0,  # share, 0 to 1, of what lacks that both bones lengthen by
    plane: ArrayLike | None = None,  # normal of the plane where the pole is near the line
) -> TwoBoneSolution: ...

class ChainSolution:
    """Where the joints of a chain stand."""

    @property
    def joints(self) -> _Array: ...  # (n + 1, 3), the root first
    @property
    def rotations(self) -> _Array | None: ...  # (n, 4) relative to the given pose: what the limits hold for
    @property
    def residual(self) -> float: ...  # distance from tip to target
    @property
    def iterations(self) -> int: ...
    @property
    def reason(self) -> Reason: ...

# A chain of n bones, 1 to 255, brought to a target from a given pose.
def solve_chain(
    joints: ArrayLike,  # (n + 1, 3), the root first
    target: ArrayLike,  # (3,)
    tolerance: float = 1e-6,  # > 0, a fraction of the chain's length
    max_iterations: int = 100,
    pole: ArrayLike | None = None,  # (3,), point that the chain bends towards, seen across root-target
    limits: ArrayLike | None = None,  # (n, 6), min x, y, z, max x, y, z in rad, inf: free; x, z swing, y twist
    plane: ArrayLike | None = None,  # (3,), normal of the plane that a straight pose bends in
    frames: ArrayLike | None = None,  # (n, 4), what the limits are about: Y along each bone of the given pose
) -> ChainSolution: ...

# Where the tip stands whose target is at a distance: slope 1 up to reach - softness, reach from reach + 2 softness on.
@overload
def soft_reach(distance: _Number, reach: float, softness: float) -> float: ...
@overload
def soft_reach(distance: ArrayLike, reach: float, softness: float) -> _Array: ...

class LookAtTurns:
    """How a gaze turns to its target; quaternions, each on top of the one before."""

    @property
    def body(self) -> _Array: ...  # (4,) or (m, 4)
    @property
    def head(self) -> _Array: ...  # (4,) or (m, 4)
    @property
    def eyes(self) -> _Array: ...  # (4,) or (m, 4)
    @property
    def residual(self) -> Union[float, _Array]: ...  # angle between the turned gaze and the target, rad
    @property
    def reason(self) -> Union[Reason, NDArray[np.int64]]: ...  # REACHED or LIMIT

def look_at(
    forward: ArrayLike,  # (3,), where the head looks before
    targets: ArrayLike,  # (m, 3) or (3,), directions
    chest: ArrayLike | None = None,  # (3,), where the chest faces; None: forward
    up: ArrayLike = (0.0, 0.0, 1.0),  # of the chest
    weight: float = 1.0,  # this and the next four in [0, 1]
    body_weight: float = 0.3,
    head_weight: float = 1.0,
    eyes_weight: float = 0.0,
    clamp: float = 0.5,  # 0 free, 0.5 90 degrees to each side, 1 no turn
    body_limit: float = 3.141592653589793,  # rad, pi: none
    head_limit: float = 3.141592653589793,
    eyes_limit: float = 3.141592653589793,
) -> LookAtTurns: ...

class TailPlan:
    """Bones of one rig that turn so that their tails point to places."""

    def __init__(self, parents: ArrayLike, bones: ArrayLike) -> None: ...
    def solve(
        self, rest: _Array, poses: _Array, basis: _Array, inheritance: _Array, world: _Array, targets: _Array,
        weights: _Array,
    ) -> _Array: ...

class LookAtPlan:
    """Bones of one rig that look at targets, checked once."""

    SETTINGS: tuple[str, ...]
    REPORT: tuple[str, ...]

    def __init__(
        self,
        parents: ArrayLike,  # (B,), -1 for none
        bodies: Sequence[ArrayLike],  # for each entry (n,) bones from the lowest up
        heads: ArrayLike,  # (C,)
        eyes: Sequence[ArrayLike],  # for each entry (k,)
    ) -> None: ...
    @property
    def rows(self) -> tuple[int, ...]: ...  # bones of the result's rows: body, head, eyes of each entry
    # The report (C, 4), see REPORT.
    def solve(
        self,
        rest: NDArray[np.float32],  # (B, 16), columns, as the next two
        poses: NDArray[np.float32],
        basis: NDArray[np.float32],
        inheritance: NDArray[np.int32],  # (B,): inherit_scale | 8 use_inherit_rotation | 16 use_local_location
        world: _Array,  # (16,), columns
        settings: _Array,  # (C, 9), see SETTINGS
        targets: _Array,  # (C, 3), world space
        head_forward: _Array,  # (C, 3), axes of the bones
        eyes_forward: _Array,  # (E, 3), of the eyes of all entries
        rotations: _Array | None = None,  # (rows, 4), C-contiguous, written into
        up: _Array | None = None,  # (C, 3), what the rig stands along at rest, armature space; None: Z
    ) -> _Array: ...

class LayerClip:
    """What an action says of a rig's bones: its F-curves as plain arrays. Immutable."""

    def __init__(
        self,
        rotations: ArrayLike,  # (B,): 0 quaternion, 1-6 Euler XYZ, XZY, YXZ, YZX, ZXY, ZYX, 7 axis and angle
        curves: NDArray[np.int32],  # (C, 5): bone, channel 0-9, first key, how many (0: given), goes on straight
        keys: NDArray[np.float32],  # (K, 6): frame and value of the key, its left handle, its right one
        interpolations: NDArray[np.int32],  # (K,): 0 constant, 1 linear, 2 Bezier
    ) -> None: ...
    @property
    def bones(self) -> tuple[int, ...]: ...
    @property
    def channels(self) -> tuple[int, ...]: ...  # of each bone a sum of 1 location, 2 rotation, 4 scale
    @property
    def spins(self) -> bool: ...  # whether angles of any bone go beyond half a turn
    @property
    def given(self) -> int: ...  # curves without keys
    # (n, 10): location, quaternion, scale of its bones at a frame of the action.
    def pose(self, frame: float, given: ArrayLike | None = None) -> _Array: ...
    # (n, 4): what their rotations are made of, in their modes.
    def numbers(self, frame: float, given: ArrayLike | None = None) -> _Array: ...

class LayerStack:
    """What the bones of one rig hang on, for layers of animation over its pose. Immutable."""

    SETTINGS: tuple[str, ...]

    def __init__(
        self,
        parents: ArrayLike,  # (B,), -1 for none
        rest: NDArray[np.float32],  # (B, 16), columns
        inheritance: NDArray[np.int32],  # (B,): 8 turns along with its parent
    ) -> None: ...
    def solve(
        self,
        frame: float,  # of the scene
        basis: NDArray[np.float32],  # (B, 16), columns
        clips: Sequence[LayerClip],  # the lowest first
        settings: _Array,  # (L, 10), see SETTINGS
        masks: _Array,  # (L, B), in [0, 1]
        references: Sequence[_Array | None],  # (n, 10) of LayerClip.pose(), None for the rest pose
        given: Sequence[ArrayLike | None],  # values of the clips' curves without keys
        rows: ArrayLike,  # (R,) bones that are written
        locations: _Array,  # (R, 3), written into: to be added
        rotations: _Array,  # (R, 4), written into: after the bone's own
        scales: _Array,  # (R, 3), written into: to multiply by
        laid: NDArray[np.float32],  # (R, 16), columns, written into: the bones' own transforms with all layers
        laps: list[_Array | None] | None = None,  # (n, 8): LayerClip.numbers() where it begins, and what a lap adds
    ) -> None: ...

# (B,): chosen, with a border that rises over `feather` bones.
def layer_mask(parents: ArrayLike, chosen: ArrayLike, feather: int = 0) -> _Array: ...

# (L, 2): frame of the action and weight, at a frame of the scene; settings (L, 10), see LayerStack.SETTINGS.
def layer_moments(settings: _Array, frame: float) -> _Array: ...

_Inherit = Literal["FULL", "FIX_SHEAR", "ALIGNED", "AVERAGE", "NONE", "NONE_LEGACY"]

class IkRest:
    """Bones at rest, of one IkPlan; made by IkPlan.rest(). Immutable."""

class IkBones:
    """Bones as they are animated, of one IkPlan; made by IkPlan.bones(). Immutable."""

class IkPlan:
    """Chains of one rig's bones, solved together from their animated (FK) pose. Immutable."""

    SETTINGS: tuple[str, ...]  # columns of the settings
    REPORT: tuple[str, ...]  # columns of the report

    def __init__(
        self,
        parents: ArrayLike,  # (b,), -1 for none
        chains: list[ArrayLike],  # bones from root to tip
        effectors: ArrayLike,  # (c,), a chain's last bone or a child of it
        guards: ArrayLike,  # (g, 2): bone, chain
    ) -> None: ...
    @property
    def rows(self) -> tuple[int, ...]: ...  # bone of each result row
    @property
    def absolute(self) -> tuple[bool, ...]: ...  # rows in pose space
    def rest(
        self,
        rest: NDArray[np.float32],  # (b, 16), column by column
        lengths: NDArray[np.float32],  # (b,)
        inheritance: NDArray[np.int32],  # (b,): mode of inherit_scale + 8 inherits rotation + 16 has local location
    ) -> IkRest: ...
    def bones(self, rest: IkRest, basis: NDArray[np.float32]) -> IkBones: ...  # basis: (b, 16), column by column
    def solve(
        self,
        bones: IkBones,
        poses: NDArray[np.float32],  # (b, 16), column by column
        world: _Array,  # (16,), column by column
        settings: _Array,  # (c, len(SETTINGS))
        targets: _Array,  # (c, 16), world, column by column
        poles: _Array,  # (c, 3), world; NaN: none
        limits: _Array | None = None,  # (chain bones, 6), rad
        rotations: _Array | None = None,  # (rows, 4), C-contiguous, written into
        scales: _Array | None = None,  # (rows, 3), C-contiguous, written into
    ) -> _Array: ...  # (c, len(REPORT))
    def match(
        self,
        bones: IkBones,
        poses: NDArray[np.float32],
        world: _Array,
        settings: _Array,
    ) -> tuple[_Array, _Array]: ...  # targets (c, 16), poles (c, 3)

# A bone's pose in armature space from its own transform, and back, by Blender's rules; (4, 4) in rows.
def bone_to_pose(
    rest: ArrayLike,
    parent_rest: ArrayLike | None,  # None without a parent, as parent_pose
    parent_pose: ArrayLike | None,
    basis: ArrayLike,
    inherit_scale: _Inherit = "FULL",
    inherit_rotation: bool = True,
    local_location: bool = True,
) -> _Array: ...
def pose_to_bone(
    rest: ArrayLike,
    parent_rest: ArrayLike | None,
    parent_pose: ArrayLike | None,
    pose: ArrayLike,
    inherit_scale: _Inherit = "FULL",
    inherit_rotation: bool = True,
    local_location: bool = True,
) -> _Array: ...

class Lattice:
    MAX_PULLS: int
    """A grid of points that deforms what is in it; points are counted with u fastest, then v, then w."""

    def __init__(
        self,
        origin: ArrayLike,  # (3,), the first point at rest
        axes: ArrayLike,  # (3, 3), rows: from the first to the last point along u, v, w
        resolution: Sequence[int],  # points along u, v, w, 1 to 64
        basis: _Basis | Sequence[_Basis] = "bspline",
    ) -> None: ...
    @property
    def resolution(self) -> tuple[int, int, int]: ...
    @property
    def point_count(self) -> int: ...
    def rest_points(self) -> _Array: ...  # (n, 3)
    def weights(self, places: ArrayLike) -> _Array: ...  # (m, 3) -> (m, n)
    def deform(
        self,
        positions: ArrayLike,  # (m, 3)
        displacements: ArrayLike,  # (n, 3), from rest
        influence: ArrayLike | None = None,  # (m,)
        point_weights: ArrayLike | None = None,  # (n,)
        out: NDArray[np.float32] | None = None,  # (m, 3)
    ) -> NDArray[np.float32]: ...
    def pull(
        self,
        places: ArrayLike,  # (k, 3), before they are deformed
        displacements: ArrayLike,  # (p, 3)
        pulls: ArrayLike | None = None,  # (k,) index of the displacement; None: one each
        shares: ArrayLike | None = None,  # (k,)
        influence: ArrayLike | None = None,  # (k,)
        point_weights: ArrayLike | None = None,  # (n,)
        outside_only: bool = False,
        max_gain: float = 32.0,
    ) -> tuple[_Array, _Array]: ...  # displacements of the points (n, 3), what is left (p, 3)

# (center (3,), axes (3, 3) in rows, size (3,)) of a box around points (m, 3).
def box_around(
    points: ArrayLike, axes: ArrayLike | None = None, turn: bool = False
) -> tuple[_Array, _Array, _Array]: ...

_Distance = Literal["straight", "surface", "edges"]
_Falloff = Literal["classic", "smooth", "sphere", "root", "linear", "sharp", "constant", "gaussian", "curve"]
_Floats = NDArray[np.float32]
_Indices = NDArray[np.int32]
_Reach = tuple[_Indices, _Floats]

# All edges longer than longest_edge are halved: (positions (v, 3) float32, triangles (t, 3) int32).
def refine(
    positions: ArrayLike, triangles: ArrayLike, longest_edge: float, most_vertices: int = 4194304
) -> tuple[NDArray[np.float32], NDArray[np.int32]]: ...

class Picker:
    """A mesh to pick from, as of the last refit."""

    def __init__(
        self,
        positions: ArrayLike,  # (v, 3) float32
        triangles: ArrayLike | None,  # (t, 3) int32
        edges: ArrayLike | None = None,  # (e, 2) int32; None: all sides of triangles
    ) -> None: ...
    @property
    def vertex_count(self) -> int: ...
    @property
    def triangle_count(self) -> int: ...
    # (triangle, point (3,), distance) of the first hit.
    def ray(
        self,
        origin: ArrayLike,
        direction: ArrayLike,
        positions: ArrayLike | None = None,  # (v, 3), another shape of the mesh
        slack: float | None = None,  # how far it is, at most, from that of the last refit
    ) -> tuple[int, _Array, float] | None: ...
    # (triangle, point (3,), vertex) of the first hit: the vertex nearest to it on the surface that is seen.
    def pick(
        self,
        origin: ArrayLike,
        direction: ArrayLike,
        metric: ArrayLike | None = None,  # (3, 3)
        hidden: ArrayLike | None = None,  # (v,) bool: never found where others are
        positions: ArrayLike | None = None,  # as in ray()
        slack: float | None = None,
    ) -> tuple[int, _Array, int] | None: ...
    def nearest(self, point: ArrayLike) -> int | None: ...  # index of a vertex
    def within(self, point: ArrayLike, radius: float, metric: ArrayLike | None = None) -> _Indices: ...  # ascending
    # (indices, distances) of the vertices within the radius.
    def reach(
        self,
        root: int | ArrayLike,  # a vertex, or for "straight" a point (3,)
        radius: float,  # for "edges" a number of edges
        distance: _Distance = "straight",
        metric: ArrayLike | None = None,  # (3, 3)
    ) -> _Reach: ...
    def reaches(  # one for each mirror image
        self,
        root: int | ArrayLike,
        radius: float,
        distance: _Distance = "straight",
        metric: ArrayLike | None = None,
        mirror: str = "",  # letters of "xyz"
    ) -> list[_Reach]: ...
    def refit(self, positions: ArrayLike, moved: ArrayLike | None = None) -> None: ...  # moved: indices

# Positions (v, 3) float32 pulled at a vertex: new ones, or out.
def pull(
    positions: ArrayLike,
    root: int | ArrayLike,  # a vertex, or for "straight" a point (3,)
    displacement: ArrayLike,  # (3,)
    radius: float,  # > 0
    falloff: _Falloff = "smooth",
    distance: _Distance = "straight",
    triangles: ArrayLike | None = None,  # (t, 3) int32
    weights: ArrayLike | None = None,  # (v,), in [0, 1]
    scale_factor: float = 0.0,  # of "classic"
    minimum: float | None = None,
    maximum: float | None = None,
    *,
    curve: ArrayLike | None = None,  # samples over t from 0 to 1
    clamp_axis: int = 2,  # of minimum and maximum
    mirror: str = "",  # letters of "xyz"
    metric: ArrayLike | None = None,  # (3, 3), distances are |metric (p - root)|
    edges: ArrayLike | None = None,  # (e, 2) int32
    picker: Picker | None = None,
    out: _Floats | None = None,  # (v, 3), C-contiguous, written into; positions itself may be given
    reach: _Reach | list[_Reach] | None = None,  # of Picker.reach, or with mirror of Picker.reaches
    shape: ArrayLike | None = None,  # (v, 3), what distances are measured on
    copy: _Floats | None = None,  # (v, 3), C-contiguous, filled with what out is
) -> _Floats: ...

# Forces at distances, a number or (n,).
def pull_forces(
    distances: ArrayLike,
    radius: float,
    falloff: _Falloff = "smooth",
    scale_factor: float = 0.0,
    curve: ArrayLike | None = None,
) -> _Floats: ...

# Keeps the calling thread's Python state, until the interpreter ends; for threads that Python has not started.
def keep_thread_state() -> bool: ...

# --- Noise ---------------------------------------------------------------------------------------------------------------

# In [-1, 1]. seed: 0 to 2^32 - 1. A float for one place, else (m,).
def noise1(x: ArrayLike, seed: int = 0) -> float | NDArray[np.float32]: ...
def noise2(xy: ArrayLike, seed: int = 0) -> float | NDArray[np.float32]: ...  # (2,) or (m, 2)
def noise3(xyz: ArrayLike, seed: int = 0) -> float | NDArray[np.float32]: ...  # (3,) or (m, 3)

# --- Colour --------------------------------------------------------------------------------------------------------------

# picture: (rows, columns, 4), scene-linear, taken in float32. color: (3,), a green or a blue.
def screen_color(picture: ArrayLike) -> _Array | None: ...  # (3,)
def screen_report(picture: ArrayLike, color: ArrayLike, balance: float = 0.0, gain: float = 1.0) -> dict[str, float]: ...
def screen_matte(picture: ArrayLike, color: ArrayLike, balance: float = 0.0, gain: float = 1.0) -> _Array: ...  # (rows, columns)

# --- Snow ----------------------------------------------------------------------------------------------------------------

class SnowCollider:
    """Triangles that flakes land on. Immutable, for any number of Snows."""

    vertex_count: int
    triangle_count: int

    def __init__(self, collider_positions: ArrayLike, collider_triangles: ArrayLike) -> None: ...  # (v, 3), (t, 3)

class Snow:
    """Flakes at any time, in any order of times, without a state. Immutable."""

    def __init__(
        self,
        *,
        start_speed: float = 5.0,
        lifetime: float = 2.0,
        start_size: float = 1.0,
        start_color: tuple[ArrayLike, ArrayLike] | None = None,  # positions (k,), colours (k, 4); None: white
        rate: float = 5.0,
        delay: float = 0.0,
        duration: float = 5.0,
        looping: bool = True,
        burst_times: ArrayLike | None = None,  # (b,)
        burst_counts: ArrayLike | None = None,  # (b,)
        shape: _EmitterShape = "square",
        surface_positions: ArrayLike | None = None,  # (v, 3)
        surface_triangles: ArrayLike | None = None,  # (t, 3)
        frustum_angles: ArrayLike = (0.4, 0.25),  # (2,)
        frustum_near: float = 0.1,
        frustum_far: float = 20.0,
        cone_angle: float = 0.0,
        cone_radius: float = 1.0,
        random_speed: bool = False,
        random_orientation: bool = False,
        random_lifetime: bool = False,
        random_size: bool = False,
        random_color: bool = False,
        snow: bool = False,
        max_angle: float = 1.3962634015954636,  # 80 degrees
        snow_frequency: float = 1.0,
        snow_offsets: bool = False,
        gravity: bool = False,
        acceleration: ArrayLike = (0.0, 0.0, -9.81),  # (3,)
        drag: float = 0.0,
        wind: ArrayLike = (0.0, 0.0, 0.0),  # (3,)
        wind_times: ArrayLike | None = None,  # (w,)
        wind_values: ArrayLike | None = None,  # (w, 3)
        gusts: float = 0.0,
        gust_frequency: float = 0.3,
        turbulence: float = 0.0,
        turbulence_size: float = 1.0,
        tumble: float = 0.0,
        ground: float | None = None,
        collider: SnowCollider | None = None,
        collision: _Collision = "stay",
        rest_time: float | None = None,
        melt_time: float = 1.0,
        friction: float = 0.5,
        seed: int = 0,
        emitter_times: ArrayLike | None = None,  # (k,)
        emitter_matrices: ArrayLike | None = None,  # (k, 4, 4)
    ) -> None: ...
    # float32 position (m, 3), velocity (m, 3), size (m,), color (m, 4), age (m,), rotation (m, 4), int64 id (m,).
    def evaluate(
        self,
        time: float,
        fields: Sequence[_FlakeField] | None = None,  # None: those in out, or all
        # C-contiguous, m rows or more, written into; or a function of m that gives them
        out: dict[str, NDArray] | Callable[[int], dict[str, NDArray]] | None = None,
        known: bool = False,  # without those of which nobody has found yet where they land
    ) -> dict[str, NDArray]: ...
    # Of up to `most` blocks of 256 flakes; how many blocks remain.
    def find_landings(self, time: float, most: int) -> int: ...
    # By time: float64 time (n,), int64 id (n,), float32 position (n, 3), int64 triangle (n,), -1 for the ground.
    def landings(self, end: float) -> dict[str, NDArray]: ...

class SnowCover:
    """How deep snow lies on each vertex of its collider, at any time, in any order of times. Immutable."""

    vertex_count: int
    areas: NDArray[np.float64]  # (v,)

    def __init__(
        self,
        snow: Snow,
        *,
        end: float,
        flake_volume: float = 1e-4,
        repose: float = 0.9,
        smoothing: int = 4,
    ) -> None: ...
    def heights(self, time: float, out: NDArray[np.float32] | None = None) -> NDArray[np.float32]: ...  # (v,)
    def volume(self, time: float) -> float: ...

class SnowLayer:
    """The mesh of snow that lies on triangles. Immutable."""

    vertex_count: int

    def __init__(
        self, layer_positions: ArrayLike, layer_triangles: ArrayLike, up: ArrayLike = (0.0, 0.0, 1.0),
        shelter: SnowCollider | None = None, repose: float | None = None,
    ) -> None: ...
    # float32 position (n, 3), depth (n,); int32 triangle (m, 3), edge (e, 2), side (m, 3).
    def mesh(
        self, depths: ArrayLike, thinnest: float = 0.0, steepest: float | None = None
    ) -> dict[str, NDArray]: ...

# --- Walker --------------------------------------------------------------------------------------------------------------

def walker_gait(  # phases (n,), duty
    gait: _Gait, rest: ArrayLike, forward: ArrayLike = (0.0, 1.0, 0.0), up: ArrayLike = (0.0, 0.0, 1.0),
) -> tuple[_Array, float]: ...

class WalkerGround:
    """What feet stand on. Immutable."""

    def __init__(
        self, positions: ArrayLike | None = None, triangles: ArrayLike | None = None, plane: ArrayLike | None = None,
    ) -> None: ...
    @property
    def vertex_count(self) -> int: ...
    @property
    def triangle_count(self) -> int: ...
    @property
    def nbytes(self) -> int: ...
    def with_plane(self, plane: ArrayLike | None) -> WalkerGround: ...

class Walker:
    """The steps of legs that walk where a body goes, for a whole shot. Immutable."""

    def __init__(
        self, times: ArrayLike, poses: ArrayLike, rest: ArrayLike, ground: WalkerGround | None = None, *, phases: ArrayLike,
        duty: float = 0.5, stride: float = 0.5, cadence: float = 1.0, clearance: float = 0.1, reach_up: float = 0.5,
        reach_down: float = 1.0, minimum_step: float = 0.0, up: ArrayLike = (0.0, 0.0, 1.0),
        hips: ArrayLike | None = None, lengths: ArrayLike | None = None, bodies: ArrayLike | None = None, resets: Sequence[int] | None = None,
        jump: float | None = None, frequency: float = 2.0, damping: float = 1.0, response: float = 0.0,
        height: float = 1.0, tilt: float = 1.0,
    ) -> None: ...
    # times: s, a number or (m,).
    def feet(self, times: ArrayLike) -> _Array: ...  # (n, 3) or (m, n, 3)
    def normals(self, times: ArrayLike) -> _Array: ...  # the same
    def swing(self, times: ArrayLike) -> _Array: ...  # (n,) or (m, n)
    def body(self, times: ArrayLike) -> tuple[_Array, _Array]: ...  # (3,), (4,) or (m, 3), (m, 4)
    def phase(self, times: ArrayLike) -> float | _Array: ...
    @property
    def leg_count(self) -> int: ...
    @property
    def steps(self) -> dict[str, NDArray]: ...  # leg int32; lift, touch; start, end, apex (s, 3)
    @property
    def problems(self) -> list[tuple[int, float, float, str]]: ...  # leg, first, last, reason
    @property
    def settled(self) -> float: ...
    @property
    def nbytes(self) -> int: ...

# --- Stereo --------------------------------------------------------------------------------------------------------------

# Parallax: a fraction of the image's width, positive behind the screen. A number or (m,) gives a float or (m,).
def parallax(
    depth: ArrayLike, interaxial: float, focal_length: float, sensor_width: float, convergence: float,
    mode: _StereoMode = "off_axis",
) -> float | _Array: ...
def solve_depth_budget(  # (interaxial, convergence)
    near: float, far: float, near_parallax: float, far_parallax: float, focal_length: float, sensor_width: float,
) -> tuple[float, float]: ...
def depth_budget(  # (near, far)
    near_parallax: float, far_parallax: float, interaxial: float, focal_length: float, sensor_width: float,
    convergence: float, mode: _StereoMode = "off_axis",
) -> tuple[float, float]: ...
def stereo_points(  # (m, 2, 2) of (m, 3): left and right eye, x and y
    points: ArrayLike, interaxial: float, focal_length: float, sensor_width: float, convergence: float,
    mode: _StereoMode = "off_axis",
) -> _Array: ...
def vertical_parallax(
    depth: float, aspect: float, interaxial: float, focal_length: float, sensor_width: float, convergence: float,
    mode: _StereoMode = "toe_in",
) -> float: ...
def seen_distance(
    parallax: ArrayLike, width: float, viewing_distance: float, eye_separation: float = 0.065,
) -> float | _Array: ...
def divergence_limit(width: float, eye_separation: float = 0.065) -> float: ...
def comfortable_parallax(  # (near, far), magnitudes
    width: float, viewing_distance: float, eye_separation: float = 0.065, angle: float = 0.017453292519943295,
) -> tuple[float, float]: ...
def roundness(
    depth: ArrayLike, interaxial: float, focal_length: float, sensor_width: float, convergence: float, width: float,
    viewing_distance: float, eye_separation: float = 0.065, mode: _StereoMode = "off_axis",
) -> float | _Array: ...
def depth_range(depths: ArrayLike, low: float = 0.01, high: float = 0.99) -> tuple[float, float] | None: ...
def window_violations(  # (left, right), magnitudes
    x: ArrayLike, depths: ArrayLike, interaxial: float, focal_length: float, sensor_width: float, convergence: float,
    tolerance: float = 0.0, mode: _StereoMode = "off_axis",
) -> tuple[float, float]: ...
def smooth_ahead(values: ArrayLike, ahead: int, side: Literal["either", "below", "above"] = "either") -> _Array: ...

# --- Dynamics -----------------------------------------------------------------------------------------------------------

# times: a number or (m,), s. Results (2,) or (m, 2): angle, angular velocity.
def single_pendulum(
    times: ArrayLike, theta: float, omega: float = 0.0, length: float = 1.0, gravity: float = 9.81, damping: float = 0.0,
    pivot_step: float = 0.0, pivot_accelerations: ArrayLike | None = None,
) -> _Array: ...
def pendulum_angle(
    time: float, theta: float, omega: float = 0.0, length: float = 1.0, gravity: float = 9.81, damping: float = 0.0,
) -> float: ...
def pendulum_period(theta: float, omega: float = 0.0, length: float = 1.0, gravity: float = 9.81) -> float: ...
def pivot_accelerations(step: float, positions: ArrayLike) -> _Array: ...  # (k, 2) of (k, 2)

# Results (4,) or (m, 4): theta1, theta2, omega1, omega2.
def double_pendulum(
    times: ArrayLike, theta1: float, theta2: float, omega1: float = 0.0, omega2: float = 0.0, mass1: float = 1.0,
    mass2: float = 1.0, length1: float = 1.0, length2: float = 1.0, gravity: float = 9.81, damping: float = 0.0,
    most_acceleration: float | None = None, most_velocity: float | None = None, pivot_step: float = 0.0,
    pivot_accelerations: ArrayLike | None = None,
) -> _Array: ...
def double_pendulum_value(  # which: 0 to 3, a column of double_pendulum()
    time: float, which: int, theta1: float, theta2: float, omega1: float = 0.0, omega2: float = 0.0, mass1: float = 1.0,
    mass2: float = 1.0, length1: float = 1.0, length2: float = 1.0, gravity: float = 9.81, damping: float = 0.0,
) -> float: ...
def double_pendulums(  # starts (n, 4) -> (n, 4)
    time: float, starts: ArrayLike, mass1: float = 1.0, mass2: float = 1.0, length1: float = 1.0, length2: float = 1.0,
    gravity: float = 9.81, damping: float = 0.0, most_acceleration: float | None = None,
    most_velocity: float | None = None, pivot_step: float = 0.0, pivot_accelerations: ArrayLike | None = None,
) -> _Array: ...
def double_pendulum_longest_time(
    theta1: float, theta2: float, omega1: float = 0.0, omega2: float = 0.0, mass1: float = 1.0, mass2: float = 1.0,
    length1: float = 1.0, length2: float = 1.0, gravity: float = 9.81,
) -> float: ...

class SecondOrder:
    """How an output follows an input: y + k1 y' + k2 y'' = x + k3 x'. Immutable."""

    def __init__(self, frequency: float, damping: float, response: float) -> None: ...
    @staticmethod
    def from_coefficients(k1: float, k2: float, k3: float) -> SecondOrder: ...
    @staticmethod
    def from_mass_spring(mass: float, stiffness: float, resistance: float) -> SecondOrder: ...
    @staticmethod
    def from_overshoot(
        overshoot: float, settling: float, response: float = 0.0, tolerance: float = 0.02,
    ) -> SecondOrder: ...
    @property
    def frequency(self) -> float: ...
    @property
    def damping(self) -> float: ...
    @property
    def response(self) -> float: ...
    @property
    def coefficients(self) -> tuple[float, float, float]: ...  # k1, k2, k3
    @property
    def overshoot(self) -> float: ...  # of the step response, a fraction of the step
    def settling_time(self, tolerance: float = 0.02) -> float: ...

def step_response(times: ArrayLike, frequency: float, damping: float, response: float) -> float | _Array: ...
def second_order(  # of the shape of inputs: (m,) or (m, d)
    times: ArrayLike, inputs: ArrayLike, frequency: float, damping: float, response: float,
) -> _Array: ...

class Track:
    """The output of a SecondOrder at any time. Immutable."""

    def __init__(
        self, filter: SecondOrder, times: ArrayLike, inputs: ArrayLike, resets: Sequence[int] | None = None,
        loop: bool = False,
    ) -> None: ...
    def evaluate(self, times: ArrayLike) -> _Array: ...
    def value(self, time: float) -> float: ...
    def offsets(self, times: ArrayLike) -> _Array: ...
    @property
    def nbytes(self) -> int: ...

class RotationTrack:
    """The same for rotations, (m, 4). Immutable."""

    def __init__(
        self, filter: SecondOrder, times: ArrayLike, inputs: ArrayLike, resets: Sequence[int] | None = None,
        loop: bool = False,
    ) -> None: ...
    def evaluate(self, times: ArrayLike) -> _Array: ...
    def offsets(self, times: ArrayLike) -> _Array: ...
    @property
    def nbytes(self) -> int: ...
