"""
Native core of Motus.

Arrays are NumPy float64 unless said; (m, 3) means m rows of x, y, z. Metres, radians and seconds; quaternions w, x, y, z.
A wrong shape, type or value raises ValueError or TypeError that names the argument. Parameters and lengths outside a
curve's interval never raise: extend = "clamp" | "extrapolate" | "loop" | "ping_pong" says what they mean.
"""
from __future__ import annotations
import builtins
import enum
import numpy
import numpy.typing
import typing
__all__: list[str] = ['BSpline', 'Bezier', 'Chain', 'ChainSolution', 'Curve', 'FCurve', 'FollowPlan', 'IkBones', 'IkPlan', 'IkRest', 'LAG_MEMORY', 'Lattice', 'LayerClip', 'LayerStack', 'LookAtPlan', 'LookAtTurns', 'Picker', 'PolyLine', 'PoseBuffer', 'Reason', 'RigGoals', 'RotationTrack', 'SecondOrder', 'Snow', 'SnowCollider', 'SnowCover', 'SnowLayer', 'SnowMarks', 'Spline', 'StrandMotion', 'StrandSurface', 'TailPlan', 'Timing', 'Track', 'TwoBoneSolution', 'Walker', 'WalkerGround', 'above_floor', 'are_below', 'blink', 'blinks', 'bone_to_pose', 'box_around', 'cache_budget', 'cached_bytes', 'clear_caches', 'comfortable_parallax', 'depth_budget', 'depth_range', 'divergence_limit', 'double_pendulum', 'double_pendulum_longest_time', 'double_pendulum_value', 'double_pendulums', 'ease', 'ease_derivative', 'euler_xyz', 'follow', 'frames', 'gusts', 'instruction_set', 'keep_thread_state', 'layer_mask', 'layer_moments', 'layer_moves', 'link_turns', 'look_at', 'matrix_products', 'noise1', 'noise2', 'noise3', 'pack_matrices', 'parallax', 'parallax_around', 'pendulum_angle', 'pendulum_period', 'pivot_accelerations', 'pose_to_bone', 'pull', 'pull_forces', 'refine', 'rotations_of', 'roundness', 'saccades', 'screen_color', 'screen_matte', 'screen_report', 'second_order', 'seen_distance', 'set_cache_budget', 'single_pendulum', 'smooth_ahead', 'soft_reach', 'solve_chain', 'solve_depth_budget', 'solve_two_bone', 'spherical_pendulum', 'step_response', 'steps', 'stereo_points', 'vertical_parallax', 'walker_gait', 'walker_natural_stride', 'wave', 'weld', 'window_violations']
class Curve:
    """
    A curve of Bezier segments of one degree; the base of Bezier, Spline, Chain, BSpline and PolyLine. Immutable.
    
    The parameter t runs over [0, segment_count], segment i over [i, i + 1].
    """
    def __repr__(self) -> str:
        ...
    def bounds(self) -> tuple[numpy.typing.NDArray[numpy.float64], numpy.typing.NDArray[numpy.float64]]:
        """
        Corners (min, max) of the smallest axis-aligned box that holds the curve, each (3,).
        """
    def curvature(self, t: numpy.typing.ArrayLike, extend: typing.Literal['clamp', 'extrapolate', 'loop', 'ping_pong'] = 'clamp') -> typing.Any:
        """
        Curvature |C' x C''| / |C'|^3 at t (a number or (m,)), 1 / unit of length: a float or (m,).
        
        Where C' vanishes, the limit: infinity at a cusp, 0 on a straight stretch.  extend: what a t outside means, as in
        position(); 0 if it goes straight on.  Raises as position().
        """
    def derivative(self, t: numpy.typing.ArrayLike, order: int = 1, extend: typing.Literal['clamp', 'extrapolate', 'loop', 'ping_pong'] = 'clamp') -> typing.Any:
        """
        Derivative of the position with respect to t.
        
        t: a number or (m,), in [0, segment_count]; at a joint the segment that begins there counts.  order: 1, 2 or 3.
        extend: outside, the derivative of position(t, extend): 'loop' repeats it; on the way back of 'ping_pong' odd orders
        change their sign; 'extrapolate' keeps the end's first derivative, the others are 0; 'clamp' gives the end's derivative.
        Returns (3,) or (m, 3).  Raises ValueError if t is not finite or order is not 1, 2 or 3, TypeError as position().
        """
    def elevate(self, times: int = 1) -> Curve:
        """
        The same curve written with a degree higher by `times`: a Bezier of a Bezier, else a Chain.
        
        Raises ValueError if times < 0 or the degree would pass 64, TypeError if it is no whole number.
        """
    def length(self) -> float:
        """
        Length of the curve in its unit; gaps between segments do not count; 0 if all points coincide.
        
        Adaptive Clenshaw-Curtis quadrature of |C'|; error <= 1e-12 of the length, cusps included.
        """
    def length_at(self, t: numpy.typing.ArrayLike, extend: typing.Literal['clamp', 'extrapolate', 'loop', 'ping_pong'] = 'clamp') -> typing.Any:
        """
        Distance along the curve from its start to t (a number or (m,)): a float or (m,).
        
        extend: outside [0, segment_count] the distance at which position_at_length(s, extend) is position(t, extend): 'loop' and
        'ping_pong' add whole lengths, 'extrapolate' goes on by |C'| of that end.
        Error <= 1e-12 of the length.  Raises as position().
        """
    def nearest(self, point: numpy.typing.ArrayLike) -> tuple[typing.Any, numpy.typing.NDArray[numpy.float64], typing.Any]:
        """
        The nearest of all points of the curve.
        
        point: (3,) or (m, 3), in the curve's space.  Returns (t, position, distance): float, (3,), float, or (m,), (m, 3), (m,).
        Branch and bound, then Newton's method; the distance is right to 1e-12 of itself.  Raises ValueError for another shape,
        if a value is not finite, or above 1e100.
        """
    def position(self, t: numpy.typing.ArrayLike, extend: typing.Literal['clamp', 'extrapolate', 'loop', 'ping_pong'] = 'clamp') -> typing.Any:
        """
        Position at the parameter t.
        
        t: a number or (m,), in [0, segment_count].  extend: the meaning of a t outside: 'clamp' the nearest end; 'extrapolate' on
        along the end's derivative; 'loop' modulo the interval; 'ping_pong' forth and back.
        Returns (3,) or (m, 3), in the curve's space and unit. De Casteljau's scheme (cubics: the Bernstein form): Farin,
        "Curves and Surfaces for CAGD" (2002).  Raises ValueError if t is not finite or extend is none of these names,
        TypeError if t does not hold real numbers.
        """
    def position_at_length(self, s: numpy.typing.ArrayLike, extend: typing.Literal['clamp', 'extrapolate', 'loop', 'ping_pong'] = 'clamp') -> typing.Any:
        """
        Position at the distance s along the curve: equal steps of s are equal steps on the curve.
        
        s: a number or (m,), in [0, length()].  extend: what an s outside means, as in position(); 'extrapolate' goes on straight
        along the unit tangent of that end.
        Returns (3,) or (m, 3), right to 1e-10 of the length.  Raises as position().
        """
    def reversed(self) -> Curve:
        """
        The same points run through from the end to the start: a Bezier of a Bezier, else a Chain.
        """
    def split(self, t: float) -> tuple[Curve, Curve]:
        """
        The parts (before, after) of the curve cut at t (a number, clamped): two Bezier of a Bezier, else two Chain.
        
        Cut at an end, one part has zero length.  Raises ValueError if t is not finite, TypeError if it is no number.
        """
    def t_at_length(self, s: numpy.typing.ArrayLike, extend: typing.Literal['clamp', 'extrapolate', 'loop', 'ping_pong'] = 'clamp') -> typing.Any:
        """
        Parameter at the distance s along the curve: the inverse of length_at().
        
        s: a number or (m,), in [0, length()].  extend: what an s outside means, as in position(); 'extrapolate' gives the end's
        parameter, since no parameter lies beyond.
        Returns a float or (m,); the distance at it differs from s by <= 1e-10 of the length (measured: 1e-12). Where the curve
        rests (a segment of zero length), one of its parameters.  Raises as position().
        """
    def tangent(self, t: numpy.typing.ArrayLike, extend: typing.Literal['clamp', 'extrapolate', 'loop', 'ping_pong'] = 'clamp') -> typing.Any:
        """
        Unit tangent at t (a number or (m,)): (3,) or (m, 3).
        
        Where the first derivative vanishes (cusp, handle on its point): its limit from the right, or at the end of the curve from
        the left; (0, 1, 0) on a curve of zero length.  extend: as in derivative(), order 1.  Raises as position().
        """
    def torsion(self, t: numpy.typing.ArrayLike, extend: typing.Literal['clamp', 'extrapolate', 'loop', 'ping_pong'] = 'clamp') -> typing.Any:
        """
        Torsion (C' x C'') . C''' / |C' x C''|^2 at t (a number or (m,)), 1 / unit of length: a float or (m,).
        
        Positive where the curve turns as a right-handed screw, forth and back; 0 where the curvature is 0 or infinite.
        extend: as in curvature().  Raises as position().
        """
    def transformed(self, matrix: numpy.typing.ArrayLike) -> Curve:
        """
        The curve moved by an affine matrix, (4, 4) in rows as Blender's: a Bezier of a Bezier, else a Chain.
        
        Raises ValueError for another shape or if a value is not finite.
        """
    @property
    def control_points(self) -> numpy.ndarray:
        """
        A copy of the control points: (degree + 1, 3) of a Bezier, else (segment_count, degree + 1, 3).
        """
    @property
    def cyclic(self) -> bool:
        """
        Whether the curve's end is its start.
        """
    @property
    def degree(self) -> int:
        """
        Degree of the segments, 1 to 64.
        """
    @property
    def segment_count(self) -> int:
        """
        Number of segments: the end of the parameter's interval.
        """
class Bezier(Curve):
    """
    A Bezier curve of any degree n, 1 to 64, t in [0, 1].
    """
    def __init__(self, control_points: numpy.typing.ArrayLike) -> None:
        """
        control_points: (n + 1, 3), 2 to 65 rows.  Raises ValueError for another shape or if a value is not finite,
        TypeError if they are not real numbers.
        """
class Spline(Curve):
    """
    Cubic segments through points with two handles each, as Blender's Bezier splines; t in [0, segment_count].
    """
    def __init__(self, points: numpy.typing.ArrayLike, handles_left: numpy.typing.ArrayLike, handles_right: numpy.typing.ArrayLike, cyclic: bool = False) -> None:
        """
        points, handles_left, handles_right: (k, 3), k >= 2.  cyclic: adds the segment from the last point to the first.
        Raises ValueError for another shape, different k, or if a value is not finite, TypeError if they are not real
        numbers.
        """
class Chain(Curve):
    """
    Bezier segments of one degree, each with its own control points, so that neighbours may be apart; t in
    [0, segment_count].
    """
    def __init__(self, control_points: numpy.typing.ArrayLike, cyclic: bool = False) -> None:
        """
        control_points: (segments, degree + 1, 3), degree 1 to 64.  cyclic: says that the end is the start; adds no segment.
        Raises ValueError for another shape or if a value is not finite, TypeError if they are not real numbers.
        """
class BSpline(Curve):
    """
    Blender's NURBS spline with all weights 1, as Bezier segments of degree order - 1, exactly; one a knot span.
    """
    def __init__(self, points: numpy.typing.ArrayLike, order: int = 4, cyclic: bool = False, use_endpoint: bool = False, use_bezier: bool = False) -> None:
        """
        points: (k, 3), k >= 2.  order: 2 to 6.  The flags are Blender's (use_cyclic_u, use_endpoint_u, use_bezier_u) and decide
        the knots; combinations that Blender shows as the bare control polygon give that polygon.
        Raises ValueError for another shape or order or if a value is not finite, TypeError if they are not real numbers.
        """
class PolyLine(Curve):
    """
    Straight segments from point to point, as Blender's poly splines; t in [0, segment_count].
    """
    def __init__(self, points: numpy.typing.ArrayLike, cyclic: bool = False) -> None:
        """
        points: (k, 3), k >= 2.  cyclic: adds the segment from the last point to the first.
        Raises ValueError for another shape or if a value is not finite, TypeError if they are not real numbers.
        """
class FCurve:
    """
    An F-curve as Blender plays it: its keys, and a Cycles modifier. Immutable. Its values are in single precision, as Blender's are;
    a LayerClip plays it in double precision if it is_plain.
    
    keys: (K, 6) float32, K > 0, their frames rising: frame and value of the key, of its left handle, of its right one.
    interpolations: (K,) int32, Blender's numbers: 0 constant, 1 linear, 2 Bezier, 3 back, 4 bounce, 5 circular, 6 cubic, 7 elastic,
    8 exponential, 9 quadratic, 10 quartic, 11 quintic, 12 sinusoidal.  goes_on: beyond the keys as a straight line, else it holds.
    easings: (K,) int32: 0 automatic, 1 in, 2 out, 3 in and out; None: all automatic.
    shapes: (K, 3) float32: overshoot of back, amplitude and period of elastic; None: as of new keys.
    cycles: (10,) float64, or None without the modifier: what it does before and after the keys, 0 nothing, 1 repeat, 2 repeat with
    offset, 3 repeat mirrored; how often before and after, 0 for ever; first and last frame, which may be infinite; over how many
    frames it blends in and out; influence; 0 if laps are counted in single precision, as versions of Blender before 4.2 do.
    is_plain: whether it has neither easings that go by a name nor a Cycles modifier.
    Raises ValueError or TypeError that names the argument.
    """
    def __init__(self, keys: numpy.typing.NDArray[numpy.float32], interpolations: numpy.typing.NDArray[numpy.int32], goes_on: bool, easings: numpy.typing.NDArray[numpy.int32] | None = None, shapes: numpy.typing.NDArray[numpy.float32] | None = None, cycles: numpy.typing.NDArray[numpy.float64] | None = None) -> None:
        ...
    def value(self, frame: float) -> float:
        """
        Value at a frame; infinite or NaN where Blender's overflows.  Raises ValueError or TypeError that names the argument.
        """
    def values(self, frames: numpy.typing.ArrayLike) -> numpy.typing.NDArray[numpy.float64]:
        """
        (n,): values at frames (n,), in any order.  Raises ValueError or TypeError that names the argument.
        """
    @property
    def is_plain(self) -> bool:
        ...
class PoseBuffer:
    """
    Memory for the poses of `count` members that a solver computes at each frame, and for the numbers that it tells beside them.
    
    Not for two threads at once.
    """
    def __init__(self, count: int, outputs: numpy.typing.NDArray[numpy.float64]) -> None:
        """
        outputs: an aligned, C-contiguous float64 array of any shape, which is kept. The poses are neutral: they change nothing.
        Raises ValueError or TypeError that names the argument.
        """
    def forget(self) -> None:
        """
        Has the next poses count as new, whatever they are.
        """
    def is_ordinary(self) -> bool:
        """
        Whether the squares of all numbers of the poses, and of all outputs, have sums below 1e30: all of them are finite then.
        """
    def matrices(self, has_scales: bool) -> typing.Any:
        """
        The poses as 4 x 4 matrices, column by column; None if they are those at the last call of matrices() or write_slots().
        
        has_scales: whether the scales count; they are 1 if not.  Returns (16 * count,) float32, which the next call overwrites.
        Raises ValueError if a rotation is zero.
        """
    def reset(self) -> None:
        """
        Sets all poses to neutral ones, which change nothing.
        """
    def write_slots(self, slots: numpy.typing.NDArray[numpy.float64], has_scales: bool) -> bool:
        """
        Writes location and Euler angles (order XYZ, rad) of each member into slots, and then the scales of all members.
        
        slots: a C-contiguous float64 array (6 * count,), or (9 * count,) if has_scales. Nothing is written if the poses are those
        at the last call of matrices() or write_slots().
        Returns whether the slots were written.  Raises ValueError or TypeError that names the argument.
        """
    @property
    def locations(self) -> numpy.ndarray:
        """
        (count, 3), a view of the memory.
        """
    @property
    def rotations(self) -> numpy.ndarray:
        """
        (count, 4): w, x, y, z, a view of the memory.
        """
    @property
    def scales(self) -> numpy.ndarray:
        """
        (count, 3), a view of the memory.
        """
class Timing:
    """
    Distance as a function of time, for follow(): seconds, and the curve's unit of length. Immutable.
    
    Made by Timing.eased, .constant, .pins, .speeds or .speeds_by_distance, which raise ValueError if a value is not finite
    or outside its domain, TypeError if one is not a real number.
    """
    @staticmethod
    def constant(speed: float) -> Timing:
        """
        speed * time, for all times.
        """
    @staticmethod
    def eased(duration: float, length: float, ease_in: float = 0.0, ease_out: float = 0.0, after: str = 'rest') -> Timing:
        """
        `length` in `duration` seconds (> 0) with ease() at both ends; at rest before 0.
        
        after: the motion after duration: 'rest'; 'go_on' with the last speed; 'repeat', lap after lap from where the last one ended.
        Laps cost nothing, however many they are.
        """
    @staticmethod
    def pins(times: numpy.typing.ArrayLike, distances: numpy.typing.ArrayLike) -> Timing:
        """
        Through pins: at times (k,), strictly increasing, k >= 1, at distances (k,); at rest outside.
        
        Monotone cubics in between (Fritsch and Carlson 1980): no overshoot, at rest between pins of equal distance.
        """
    @staticmethod
    def speeds(times: numpy.typing.ArrayLike, speeds: numpy.typing.ArrayLike) -> Timing:
        """
        The exact integral of speeds (k,) given at times (k,), strictly increasing, k >= 1: linear in between, held outside; 0 at
        time 0. A negative speed goes backwards.
        """
    @staticmethod
    def speeds_by_distance(distances: numpy.typing.ArrayLike, speeds: numpy.typing.ArrayLike, lap: float | None = None) -> Timing:
        """
        Motion that has speeds (k,), all > 0, at distances (k,), strictly increasing, k >= 1: linear in between, held outside;
        at distance 0 at time 0.  lap: > 0, way after which the speeds come again; the distances lie within one lap then.
        """
    def distance(self, time: numpy.typing.ArrayLike) -> typing.Any:
        """
        Distance at a time (a number or (m,), s): a float or (m,).
        """
    def speed(self, time: numpy.typing.ArrayLike) -> typing.Any:
        """
        Derivative of distance() at a time (a number or (m,), s): a float or (m,); at a jump the speed after it.
        """
class FollowPlan:
    """
    Followers of curves, each with its members, prepared for many frames: poses as of follow(), and how far they have come.
    """
    def __init__(self) -> None:
        ...
    def add(self, place: int, timing: Timing, offsets: numpy.typing.ArrayLike, mode: typing.Literal['world_up', 'minimal', 'banking', 'curvature', 'tilt', 'rail'], time: float | None = None, start_frame: float | None = None, moved: float = 0.0, offset: float = 0.0, extend: typing.Literal['clamp', 'extrapolate', 'loop', 'ping_pong'] = 'clamp', forward: typing.Literal['X', 'Y', 'Z', '-X', '-Y', '-Z'] = 'Y', up: typing.Literal['X', 'Y', 'Z', '-X', '-Y', '-Z'] = 'Z', rotate: bool = True, lag_rate: float = 0.0, lag_by: str = 'acceleration', line_up: bool = False, delays: numpy.typing.ArrayLike = 0.0, wheelbases: numpy.typing.ArrayLike = 0.0, side: float = 0.0, height: float = 0.0, level: bool = False, start: float | None = None, **kwargs) -> None:
        """
        Adds a follower, whose members have the next rows.
        
        place: index of its curve among those that solve() is given.  time: s; None: the frame's seconds, counted from start_frame
        and 0 before, or from frame 0 if that is None.  moved, offset: added to the timing's distance where progress is told.
        Everything else as in follow(). Raises ValueError or TypeError that names the argument.
        """
    def skip(self) -> None:
        """
        Leaves out the next follower, of one member: solve() writes neither its pose nor its progress.
        """
    def solve(self, curves: list, frame: float, fps: float, poses: PoseBuffer, spaces: list[numpy.typing.ArrayLike | None] | None = None) -> None:
        """
        Writes the poses of all members at a frame, as follow() does, and the progress of all followers.
        
        curves: list of Curves.  frame, fps: numbers.  poses: a PoseBuffer of as many poses as there are members, whose outputs are
        (followers, 5): parameter on the curve, fraction of its length, distance, speed, the curve's length.
        spaces: for each curve the matrix (4, 4), without scale, of the space in which the curve is, or None for the world's; poses
        are in the world.
        What is nowhere at that time, since its distance or speed is not finite, is NaN.
        Raises ValueError or TypeError that names the argument.
        """
    @property
    def followers(self) -> int:
        """
        How many followers were added.
        """
    @property
    def rows(self) -> int:
        """
        How many members all followers have together.
        """
class TailPlan:
    """
    Bones of one rig that turn so that their tails point to places. The hierarchy is checked once. Each bone turns about its own
    head, after the bones above have moved that head.
    
    parents: (B,), index of each bone's parent, -1 for none.  bones: (n,), the bones that turn, in any order.
    Raises ValueError or TypeError that names the argument.
    """
    def __init__(self, parents: numpy.typing.ArrayLike, bones: numpy.typing.ArrayLike) -> None:
        ...
    def solve(self, rest: numpy.typing.NDArray[numpy.float32], poses: numpy.typing.NDArray[numpy.float32], basis: numpy.typing.NDArray[numpy.float32], inheritance: numpy.typing.NDArray[numpy.int32], world: numpy.typing.ArrayLike, targets: numpy.typing.NDArray[numpy.float64], weights: numpy.typing.NDArray[numpy.float64]) -> numpy.typing.NDArray[numpy.float64]:
        """
        Rotations (n, 4), w, x, y, z, of the bones on top of their own: the identity if a tail points to its place already.
        
        rest, poses, basis, inheritance, world: as those of LookAtPlan.solve; of poses only the parents of the topmost bones are
        read.  targets: (n, 3) float64, world space.  weights: (n,) float64, the share of each turn, 0 to 1.
        Raises ValueError or TypeError that names the argument; numbers that are not finite do not raise.
        """
class Reason(enum.IntEnum):
    """
    Why the end of a chain is or is not on its target; an IntEnum, comparable with the codes in arrays.
    
    REACHED: the end is on the target, within the tolerance.  TOO_FAR: the target is farther than the chain reaches,
    or than softness lets it.  TOO_NEAR: the target is nearer to the root than the chain can fold.  LIMIT: a joint limit is in the way.
    ITERATIONS: the iterations allowed were used up.
    """
    ITERATIONS: typing.ClassVar[Reason]
    LIMIT: typing.ClassVar[Reason]
    REACHED: typing.ClassVar[Reason]
    TOO_FAR: typing.ClassVar[Reason]
    TOO_NEAR: typing.ClassVar[Reason]
    _member_map_: typing.ClassVar[dict]
    _member_names_: typing.ClassVar[list] = ['REACHED', 'TOO_FAR', 'TOO_NEAR', 'LIMIT', 'ITERATIONS']
    _unhashable_values_: typing.ClassVar[list] = list()
    _use_args_: typing.ClassVar[bool] = True
    _value2member_map_: typing.ClassVar[dict]
    _member_type_ = builtins.int
    @staticmethod
    def _generate_next_value_(name, start, count, last_values):
        """
                Generate the next value when not given.
        
                name: the name of the member
                start: the initial start value or None
                count: the number of existing members
                last_values: the list of values assigned
                
        """
    @staticmethod
    def _new_member_(type, *args, **kwargs):
        """
        Create and return a new object.  See help(type) for accurate signature.
        """
    @classmethod
    def __new__(cls, value):
        ...
    def __format__(self, format_spec):
        ...
    def _value_repr_(self):
        """
        Return repr(self).
        """
class TwoBoneSolution:
    """
    The positions of the joints of two bones, from solve_two_bone(): of one chain values, of m chains arrays with m rows.
    """
    @property
    def elbow(self) -> typing.Any:
        """
        (3,) or (m, 3).
        """
    @property
    def normal(self) -> typing.Any:
        """
        (3,) or (m, 3), unit: across the plane of the bend; cross(normal, target - root) points to the elbow's side.
        """
    @property
    def reason(self) -> typing.Any:
        """
        A Reason or (m,) int64 of their codes: REACHED, if the residual is at most 1e-12 of length1 + length2 +
        |target - root|; TOO_FAR or TOO_NEAR.
        """
    @property
    def residual(self) -> typing.Any:
        """
        A float or (m,): distance from the tip to the target.
        """
    @property
    def scale(self) -> typing.Any:
        """
        A float or (m,): of both bones, > 1 if they are stretched.
        """
    @property
    def tip(self) -> typing.Any:
        """
        (3,) or (m, 3); the target itself where it is reached exactly.
        """
class ChainSolution:
    """
    The positions of a chain's joints, from solve_chain().
    """
    @property
    def iterations(self) -> int:
        """
        Steps taken; with limits those of all starts.
        """
    @property
    def joints(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (n + 1, 3), the root first.
        """
    @property
    def reason(self) -> typing.Any:
        """
        A Reason: REACHED if the residual is within the tolerance; TOO_FAR or TOO_NEAR if no chain of these lengths
        reaches the target; LIMIT if the limits do not let it; ITERATIONS if there were too few of them.
        """
    @property
    def residual(self) -> float:
        """
        Distance from the tip to the target.
        """
    @property
    def rotations(self) -> typing.Any:
        """
        (n, 4): each bone's rotation relative to the given pose, seen from the bone before it, for which the limits hold.
        None without limits.
        """
class LookAtTurns:
    """
    How a gaze turns to its target, from look_at(): of one target values, of m targets arrays with m rows.
    
    body, head and eyes are quaternions (m, 4) or (4,), w, x, y, z; each comes on top of the one before: eyes * head * body.
    """
    @property
    def body(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (4,) or (m, 4).
        """
    @property
    def eyes(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (4,) or (m, 4).
        """
    @property
    def head(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (4,) or (m, 4).
        """
    @property
    def reason(self) -> typing.Any:
        """
        A Reason or (m,) int64 of their codes: LIMIT if the clamp or a limit keeps the gaze off; REACHED if nothing but the
        weights does.
        """
    @property
    def residual(self) -> typing.Any:
        """
        A float or (m,): angle between the turned gaze and the target, rad.
        """
class LookAtPlan:
    """
    Bones of one rig that look at targets. The hierarchy is checked once.
    
    parents: (B,), index of each bone's parent, -1 for none.  bodies: for each entry (n,) bones from the lowest up, below the
    head; may be empty.  heads: (C,) bones.  eyes: for each entry (k,) bones above the head; may be empty.
    rows: the bones of the result's rows: body, head, eyes of each entry.  SETTINGS, REPORT: names of columns.
    Raises ValueError or TypeError that names the argument.
    """
    REPORT: typing.ClassVar[tuple] = ('angle', 'reason', 'yaw', 'pitch')
    SETTINGS: typing.ClassVar[tuple] = ('weight', 'body_weight', 'head_weight', 'eyes_weight', 'clamp', 'body_limit', 'head_limit', 'eyes_limit', 'head_left_limit', 'head_right_limit', 'head_up_limit', 'head_down_limit', 'eyes_left_limit', 'eyes_right_limit', 'eyes_up_limit', 'eyes_down_limit', 'is_on')
    def __init__(self, parents: numpy.typing.ArrayLike, bodies: typing.Sequence[numpy.typing.ArrayLike], heads: numpy.typing.ArrayLike, eyes: typing.Sequence[numpy.typing.ArrayLike]) -> None:
        ...
    def solve(self, rest: numpy.typing.NDArray[numpy.float32], poses: numpy.typing.NDArray[numpy.float32], basis: numpy.typing.NDArray[numpy.float32], inheritance: numpy.typing.NDArray[numpy.int32], world: numpy.typing.ArrayLike, settings: numpy.typing.NDArray[numpy.float64], targets: numpy.typing.NDArray[numpy.float64], head_forward: numpy.typing.NDArray[numpy.float64], eyes_forward: numpy.typing.NDArray[numpy.float64], rotations: numpy.typing.NDArray[numpy.float64] | None = None, up: numpy.typing.NDArray[numpy.float64] | None = None, target_weights: numpy.typing.NDArray[numpy.float64] | None = None, target_counts: numpy.typing.ArrayLike | None = None, eyes_beside: numpy.typing.NDArray[numpy.float64] | None = None) -> numpy.typing.NDArray[numpy.float64]:
        """
        Rotations that turn body, head and eyes of each entry to its target.
        
        rest, poses, basis: (B, 16) float32: Bone.matrix_local, PoseBone.matrix, PoseBone.matrix_basis, column by column; of poses
        only the parent of each entry's first bone is read.  inheritance: (B,) int32: Bone.inherit_scale | 8 use_inherit_rotation
        | 16 use_local_location.  world: (16,), the rig's matrix_world, column by column.
        settings: (C, 17), see SETTINGS and look_at().  targets: (T, 3), world space.  head_forward: (C, 3), eyes_forward: (E, 3) of
        the eyes of all entries, axes of the bones that point where they look, of any length but 0.  up: (C, 3), the rig's upward
        direction at rest, in armature space, of any length but 0; None: Z.
        target_counts: (C,), how many of the targets, in order, each entry has, at least one; None: one each.  target_weights: (T,), less
        than 0 counts as 0; None: 1.  An entry looks in the mean by weight of its targets' directions; of weights that sum up to less than 1
        the animated gaze takes the rest.  eyes_beside: (C, 2), how far beside that direction the eyes look, rad to the left and up, times
        weight, within their limits; see saccades(); None: 0.
        rotations: a C-contiguous float64 array (rows, 4) to write into, which shares no memory with other arguments; None: only the
        report.  Its rows are w, x, y, z and come on top of each bone's own rotation; the identity if nothing turns.
        Returns (C, 4), see REPORT: angle between gaze and target, rad; reason (a Reason: REACHED or LIMIT; -1 if an input is not
        finite or a bone that looks has no size); yaw (positive to the left) and pitch (positive up) of the target, rad.
        Raises ValueError or TypeError that names the argument; numbers that are not finite do not raise.
        """
    @property
    def rows(self) -> tuple[int, ...]:
        ...
class LayerClip:
    """
    What an action says of a rig's bones: its F-curves. Immutable.
    
    rotations: (B,), rotation mode of each bone: 0 quaternion, 1-6 Euler XYZ, XZY, YXZ, YZX, ZXY, ZYX, 7 axis and angle.
    curves: (C, 4) int32: bone; channel, 0-2 location, 3-6 the numbers of its rotation mode, 7-9 scale; index of its FCurve, -1 where
    the caller gives its value; whether it counts as an angle that goes beyond half a turn, whatever its keys say.
    fcurves: (F) FCurve.
    bones: those that it animates.  channels: of each a sum of 1 location, 2 rotation, 4 scale.  spins: whether angles of any go
    beyond half a turn, or by a whole turn from key to key.  given: how many curves have no FCurve.
    Raises ValueError or TypeError that names the argument.
    """
    def __init__(self, rotations: numpy.typing.ArrayLike, curves: numpy.typing.NDArray[numpy.int32], fcurves: list[FCurve]) -> None:
        ...
    def numbers(self, frame: float, given: numpy.typing.ArrayLike | None = None) -> numpy.typing.NDArray[numpy.float64]:
        """
        (n, 4): what the bones' rotations are made of at a frame of the action, in their modes: a quaternion, Euler angles and a number
        that does not count, an angle and its axis; rad.
        
        given: as of pose().  Raises ValueError or TypeError that names the argument.
        """
    def pose(self, frame: float, given: numpy.typing.ArrayLike | None = None) -> numpy.typing.NDArray[numpy.float64]:
        """
        (n, 10) of the bones at a frame of the action: location, unit quaternion w, x, y, z, scale; at rest what it says nothing of.
        
        given: (given,), values of the curves without an FCurve.  Raises ValueError or TypeError that names the argument.
        """
    @property
    def bones(self) -> tuple[int, ...]:
        ...
    @property
    def channels(self) -> tuple[int, ...]:
        ...
    @property
    def given(self) -> int:
        ...
    @property
    def spins(self) -> bool:
        ...
class LayerStack:
    """
    What the bones of one rig hang on, for layers of animation over its pose. Immutable.
    
    parents: (B,), index of each bone's parent, -1 for none.  rest: (B, 16) float32, Bone.matrix_local, column by column.
    inheritance: (B,) int32: 8 where the bone turns along with its parent.  SETTINGS: names of columns.
    Raises ValueError or TypeError that names the argument.
    """
    SETTINGS: typing.ClassVar[tuple] = ('start', 'first', 'last', 'speed', 'after', 'blend_in', 'blend_out', 'weight', 'mode', 'in_armature')
    def __init__(self, parents: numpy.typing.ArrayLike, rest: numpy.typing.NDArray[numpy.float32], inheritance: numpy.typing.NDArray[numpy.int32]) -> None:
        ...
    def solve(self, frame: float, basis: numpy.typing.NDArray[numpy.float32], clips: list, settings: numpy.typing.NDArray[numpy.float64], masks: numpy.typing.NDArray[numpy.float64], references: list, given: list, rows: numpy.typing.ArrayLike, locations: numpy.typing.NDArray[numpy.float64], rotations: numpy.typing.NDArray[numpy.float64], scales: numpy.typing.NDArray[numpy.float64], laid: numpy.typing.NDArray[numpy.float32], laps: list[numpy.typing.NDArray[numpy.float64] | None] | None = None) -> None:
        """
        Lays layers, the lowest first, over the bones' own transforms at a frame of the scene, and writes what comes on top of these.
        
        basis: (B, 16) float32, PoseBone.matrix_basis, column by column.  clips: (L) LayerClip.  settings: (L, 10), see SETTINGS: start
        frame; first and last frame of the action; speed; after: 0 it ends, 1 it holds, 2 it repeats; blend_in and blend_out, frames
        of the scene; weight; mode: 0 override, 1 additive; in_armature: not 0, rotations are blended as they are in the armature.
        masks: (L, B), in [0, 1].  references: of each layer the pose() that an additive one starts from, None for the rest pose.
        given: of each layer the values of its clip's curves without an FCurve, or None.
        rows: (R,) bones.  locations (R, 3), rotations (R, 4) w, x, y, z, scales (R, 3), float64: written into; location to add, rotation
        after the bone's own, scale to multiply by.  laid: (R, 16) float32, written into: the bone's own transform with all layers.
        laps: of each layer (n, 8), or None: numbers() of the first pose that it plays (of an additive one's reference, if that is a pose
        of the clip), and how far numbers() come from the first pose to the last. Bones that go around, see LayerClip.spins, then do so by a
        part of the way where the layer counts for a part; without it all rotations go the shorter way.
        Raises ValueError or TypeError that names the argument; transforms that are not finite stay as they are.
        """
    def sources(self, frame: float, basis: numpy.typing.NDArray[numpy.float32], clips: list, settings: numpy.typing.NDArray[numpy.float64], masks: numpy.typing.NDArray[numpy.float64], references: list, given: list, edited: int, wanted: numpy.typing.NDArray[numpy.float32], rows: numpy.typing.ArrayLike, laps: list[numpy.typing.NDArray[numpy.float64] | None] | None = None) -> tuple[numpy.typing.NDArray[numpy.float64], tuple[int, ...]]:
        """
        The inverse of solve(): what the clip of one layer has to say, so that the layers together give a wanted pose.
        
        edited: index of the layer.  wanted: (B, 16) float32, the bones' own transforms with all layers, column by column.  rows: (R,) bones of
        which the clip is to say something, whether it animates them now or not.  The others as of solve().
        Returns ((R, 10), as pose() has it, (R,) of each bone a sum of 1 location, 2 rotation, 4 scale, which the layers then give).  Channels
        that are missing in the sum are hidden by a layer above, have no share in the layer, or would have to turn by more than half a turn.
        Raises ValueError or TypeError that names the argument.
        """
class RigGoals:
    """
    Goals that bones of a rig reach for: bones of the rig itself, and things whose world matrices are given. Immutable.
    
    count: of the goals.  own: (k, 2) goal and bone of the rig.  others: (m, 2) goal and row of `things`. A goal that is in neither
    is nowhere.
    Raises ValueError or TypeError that names the argument.
    """
    def __init__(self, count: int, own: numpy.typing.ArrayLike, others: numpy.typing.ArrayLike) -> None:
        ...
    def matrices(self, poses: numpy.typing.NDArray[numpy.float32], world: numpy.typing.ArrayLike, things: numpy.typing.NDArray[numpy.float32]) -> numpy.typing.NDArray[numpy.float64]:
        """
        World matrices of the goals, (count, 16) float64, column by column; the identity for one that is nowhere.
        
        poses: (b, 16) float32, PoseBone.matrix as foreach_get gives it.  world: the rig's matrix_world, as in IkPlan.solve().  Both are read
        if a goal is a bone of the rig.  things: (n, 16) float32, world matrices, column by column.
        Raises ValueError or TypeError that names the argument; numbers that are not finite do not raise.
        """
    def points(self, poses: numpy.typing.NDArray[numpy.float32], world: numpy.typing.ArrayLike, things: numpy.typing.NDArray[numpy.float32]) -> numpy.typing.NDArray[numpy.float64]:
        """
        World positions of the goals, (count, 3) float64; NaN for one that is nowhere. Arguments as in matrices().
        """
class IkRest:
    """
    Bones at rest, of one IkPlan; made by IkPlan.rest(). Immutable.
    """
class IkBones:
    """
    Bones as they are animated, of one IkPlan; made by IkPlan.bones(). Immutable.
    """
class IkPlan:
    """
    Chains of one rig's bones, solved together. Immutable.
    
    parents: (b,) parent of each bone, -1 for none.  chains: lists of bones from root to tip, each a child of the one before,
    1 to 255.  effectors: (c,) the bone that each chain brings to its target: its last bone, whose tail is then the tip, or a
    child of its last bone, whose head is then the tip.  guards: (g, 2) bone and chain: children of chain bones, outside the chain, that are not
    stretched with it.
    If a chain with guards has an effector outside the chain, the effector's row is in pose space; the effector may be listed as
    a guard too.
    Raises ValueError or TypeError that names the argument.
    """
    REPORT: typing.ClassVar[tuple] = ('residual', 'angle', 'reason', 'iterations', 'distance', 'reach', 'tip_x', 'tip_y', 'tip_z')
    SETTINGS: typing.ClassVar[tuple] = ('position_weight', 'rotation_weight', 'softness', 'stretch', 'volume', 'pole_angle', 'bend', 'hinge_angle', 'tolerance', 'iterations', 'use_limits', 'is_on', 'left_out')
    def __init__(self, parents: numpy.typing.ArrayLike, chains: typing.Sequence[numpy.typing.ArrayLike], effectors: numpy.typing.ArrayLike, guards: numpy.typing.ArrayLike) -> None:
        ...
    def bones(self, rest: IkRest, basis: numpy.typing.NDArray[numpy.float32]) -> IkBones:
        """
        Reads the plan's bones as they are animated: an IkBones, valid until a bone's own transform changes.
        
        rest: a result of rest().  basis: (b, 16) float32, PoseBone.matrix_basis as foreach_get gives it.
        Wrong shapes and types raise ValueError or TypeError that names the argument.
        """
    def match(self, bones: IkBones, poses: numpy.typing.NDArray[numpy.float32], world: numpy.typing.ArrayLike, settings: numpy.typing.NDArray[numpy.float64]) -> tuple[numpy.typing.NDArray[numpy.float64], numpy.typing.NDArray[numpy.float64]]:
        """
        Targets and poles for which the solution is the animated pose: ((c, 16), (c, 3)), as solve() takes them.
        
        The targets are rigid. A chain with numbers that are not finite gets the identity and no pole (NaN).
        """
    def rest(self, rest: numpy.typing.NDArray[numpy.float32], lengths: numpy.typing.NDArray[numpy.float32], inheritance: numpy.typing.NDArray[numpy.int32]) -> IkRest:
        """
        Reads the plan's bones at rest: an IkRest, valid until the armature is edited.
        
        rest: (b, 16) float32, Bone.matrix_local as foreach_get gives it.  lengths: (b,) float32.  inheritance: (b,) int32, the
        number of Bone.inherit_scale (FULL 0, FIX_SHEAR 1, ALIGNED 2, AVERAGE 3, NONE 4, NONE_LEGACY 5), + 8 if it inherits
        rotation, + 16 if its location is local.  Wrong shapes and types raise ValueError or TypeError that names the argument.
        """
    def solve(self, bones: IkBones, poses: numpy.typing.NDArray[numpy.float32], world: numpy.typing.ArrayLike, settings: numpy.typing.NDArray[numpy.float64], targets: numpy.typing.NDArray[numpy.float64], poles: numpy.typing.NDArray[numpy.float64], limits: numpy.typing.NDArray[numpy.float64] | None = None, rotations: numpy.typing.NDArray[numpy.float64] | None = None, scales: numpy.typing.NDArray[numpy.float64] | None = None) -> typing.Any:
        """
        Turns the chains from their animated (FK) pose to their targets.
        
        bones: a result of bones().  poses: (b, 16) float32, PoseBone.matrix as foreach_get gives it; only the parents of chains are read.
        All float64 from here on.  world: (16,) the rig's matrix_world, column by column.
        settings: (c, len(SETTINGS)).  targets: (c, 16) world matrices, column by column.  poles: (c, 3) world, NaN for none.
        limits: (chain bones, 6) rad, least x, y, z and greatest x, y, z of swing (x, z) and twist (y), or None.
        rotations, scales: (rows, 4) w, x, y, z and (rows, 3) to write into; C-contiguous, apart in memory.
        Settings: position_weight, rotation_weight, stretch 0 to 1; volume the share, 0 to 1, that stretched bones keep of theirs; softness a fraction of the chain's length; pole_angle,
        hinge_angle rad; bend < 0 away from the pole; tolerance a fraction of the length; use_limits, is_on 0 or not; left_out how many of
        the chain's first bones stay as they are animated.
        Returns (c, len(REPORT)): residual, distance, reach and tip in the world, of the solution with position_weight 1; angle left
        between effector and target, rad; reason a code of Reason, or -1.
        Numbers that are not finite are allowed: such a chain's rows are neutral and its reason is -1. Wrong shapes and types
        raise ValueError or TypeError that names the argument.
        """
    @property
    def absolute(self) -> tuple[bool, ...]:
        """
        Whether each row is rotation and scale in pose space; else they come on top of the bone's own.
        """
    @property
    def rows(self) -> tuple[int, ...]:
        """
        Bone of each result row: all chain bones, chain by chain; effectors that are no chain bones; guards.
        """
class Picker:
    """
    A mesh to pick from: a tree over its triangles and vertices, and the neighbours of each vertex.
    
    It keeps a copy of the positions: answers are for the shape of the last refit. Coincident or loose vertices, triangles
    without area and edges of any number of triangles are allowed. Threads may use it at the same time.
    """
    def __init__(self, positions: numpy.typing.ArrayLike, triangles: numpy.typing.ArrayLike | None, edges: numpy.typing.ArrayLike | None = None) -> None:
        """
        positions: (v, 3) float32.  triangles: (t, 3) int32, or None.  edges: (e, 2) int32, the mesh's own, for distances counted
        in edges: the diagonals of polygons are no edges. None: all sides of triangles are.
        Other real numbers are converted, which takes time. Raises ValueError or TypeError that names the argument.
        """
    def nearest(self, point: numpy.typing.ArrayLike) -> typing.Any:
        """
        Index of the vertex nearest to the point (3,), the lowest if several are as near; None if there is no vertex.
        """
    def pick(self, origin: numpy.typing.ArrayLike, direction: numpy.typing.ArrayLike, metric: numpy.typing.ArrayLike | None = None, hidden: numpy.typing.ArrayLike | None = None, positions: numpy.typing.ArrayLike | None = None, slack: float | None = None) -> typing.Any:
        """
        The first hit of a ray, and the vertex that it picks: (triangle, point (3,), vertex), or None.
        
        The vertex is the one nearest to the point, by |metric (p - point)|, on the surface that was hit: of the triangle, and of
        at most 256 triangles that are connected with it by edges and seen from the same side. If triangles are thin it may belong
        to a neighbour, but never to the far side of a wall or to a different sheet.
        metric: as in within().  hidden: (v,) bool, vertices that are left out; if all around are hidden, the triangle's nearest
        corner is picked.  positions, slack: as in ray().
        """
    def ray(self, origin: numpy.typing.ArrayLike, direction: numpy.typing.ArrayLike, positions: numpy.typing.ArrayLike | None = None, slack: float | None = None) -> typing.Any:
        """
        The first hit of a ray: (triangle, point (3,), distance from the origin), or None. Triangles are hit from either side.
        The direction may have any length; with length 0 there is no hit.
        
        positions: (v, 3) float32, a different shape of the mesh, which the ray meets instead. slack, needed with positions: the
        most that a vertex has moved since the last refit; triangles of a vertex that moved further may be missed. For a few rays
        this takes far less time than a refit, if the slack is small compared with the mesh.
        """
    def reach(self, root: int | numpy.typing.ArrayLike, radius: float, distance: typing.Literal['straight', 'surface', 'edges'] = 'straight', metric: numpy.typing.ArrayLike | None = None) -> tuple[numpy.typing.NDArray[numpy.int32], numpy.typing.NDArray[numpy.float32]]:
        """
        The vertices within a radius of a root: (indices (n,) int32, ascending, distances (n,) float32).
        
        root: index of a vertex; for 'straight' also a point (3,).  radius: >= 0; for 'edges' a number of edges.
        distance: 'straight'; 'surface', along triangles and loose edges; 'edges', counted.  metric: as in within().
        The result can be given to pull() as `reach`.
        """
    def reaches(self, root: int | numpy.typing.ArrayLike, radius: float, distance: typing.Literal['straight', 'surface', 'edges'] = 'straight', metric: numpy.typing.ArrayLike | None = None, mirror: str = '') -> list[tuple[numpy.typing.NDArray[numpy.int32], numpy.typing.NDArray[numpy.float32]]]:
        """
        The results of reach() for the root and each of its mirror images, as a list for pull()'s `reach` with `mirror`. The order
        is: the root, mirrored in x, y, xy, z, xz, yz, xyz, of which those that do not apply are left out.
        
        mirror: letters of 'xyz'. The image of a vertex is the vertex nearest to its mirrored position.
        """
    def refit(self, positions: numpy.typing.ArrayLike, moved: numpy.typing.ArrayLike | None = None) -> None:
        """
        Adapts the tree to new positions (v, 3). moved: indices of the vertices that have moved since the last refit, which
        takes less time than to look at all; None: any vertex may have moved.
        """
    def within(self, point: numpy.typing.ArrayLike, radius: float, metric: numpy.typing.ArrayLike | None = None) -> numpy.typing.NDArray[numpy.int32]:
        """
        Indices (n,) int32, ascending, of the vertices with |metric (p - point)| <= radius.
        
        metric: (3, 3) in rows, such as that of an object's world matrix; None: the identity.
        """
    @property
    def triangle_count(self) -> int:
        """
        int
        """
    @property
    def vertex_count(self) -> int:
        """
        int
        """
class Lattice:
    """
    A grid of points that deforms positions within it (free-form deformation).
    
    origin: (3,), the first point at rest.  axes: (3, 3), rows: from the first to the last point along u, v and w; independent.
    resolution: points along u, v and w, 1 to 64.  basis: one name, or one each: 'bernstein' (Sederberg and Parry's, of the
    degree resolution - 1), or Blender's 'linear', 'cardinal', 'catmull_rom', 'bspline'.
    Points are counted with u fastest, then v, then w. Any space, any unit of length.
    Raises ValueError or TypeError that names the argument, as its methods do.
    """
    MAX_PULLS: typing.ClassVar[int] = 1000
    def __init__(self, origin: numpy.typing.ArrayLike, axes: numpy.typing.ArrayLike, resolution: typing.Sequence[int], basis: str | typing.Sequence[str] = 'bspline') -> None:
        ...
    def deform(self, positions: numpy.typing.ArrayLike, displacements: numpy.typing.ArrayLike, influence: numpy.typing.ArrayLike | None = None, point_weights: numpy.typing.ArrayLike | None = None, out: numpy.typing.NDArray[numpy.float32] | None = None) -> numpy.typing.NDArray[numpy.float32]:
        """
        Positions deformed by displacements of the points.
        
        positions: (m, 3).  displacements: (n, 3), from rest.  influence: (m,) factors of the change, strength times the weight of a
        vertex group in Blender.  point_weights: (n,), Blender's vertex group of the lattice: fades the change once more by
        influence times their blend.  out: a float32 array (m, 3) to write into, positions itself included.
        Returns float32 (m, 3).
        """
    def pull(self, places: numpy.typing.ArrayLike, displacements: numpy.typing.ArrayLike, pulls: numpy.typing.ArrayLike | None = None, shares: numpy.typing.ArrayLike | None = None, influence: numpy.typing.ArrayLike | None = None, point_weights: numpy.typing.ArrayLike | None = None, outside_only: bool = False, max_gain: float = 32.0) -> tuple[numpy.typing.NDArray[numpy.float64], numpy.typing.NDArray[numpy.float64]]:
        """
        The smallest displacements of the points that move places as wanted, or as nearly as possible (least squares).
        
        places: (k, 3), before they are deformed.  displacements: (p, 3), wanted; 0 holds a place.  pulls: (k,) index of the
        displacement that each place takes part in; None: one each.  shares: (k,) with pulls, such as the barycentric coordinates
        of a point of a triangle; None: 1.  influence: (k,), point_weights: (n,), as of deform().
        outside_only: points inside follow those of the outside, as with Blender's Outside.
        MAX_PULLS displacements at most, if they move more points than that: the work grows with the cube of the smaller number.
        max_gain: > 0; bounds the points' movement to this many times what the pulls would need at full influence by themselves.
        Returns ((n, 3), (p, 3)): displacements to be added to those of the points, and the rest of the wanted displacements that is not reached.
        """
    def rest_points(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        Positions of the points at rest: (n, 3).
        """
    def weights(self, places: numpy.typing.ArrayLike) -> numpy.typing.NDArray[numpy.float64]:
        """
        How much each point moves places: (m, n), rows add up to 1.  places: (m, 3), before they are deformed.
        """
    @property
    def point_count(self) -> int:
        ...
    @property
    def resolution(self) -> tuple[int, int, int]:
        ...
class SnowCollider:
    """
    Triangles that flakes land on, from either side; they stand still. Immutable: made once, for any number of Snows. A million
    triangles take some 70 MB, and 36 MB more where flakes slide.
    
    collider_positions (v, 3), world space.  collider_triangles (t, 3): indices of vertices.
    Raises ValueError or TypeError that names the argument.
    """
    def __init__(self, collider_positions: numpy.typing.ArrayLike, collider_triangles: numpy.typing.ArrayLike) -> None:
        ...
    @property
    def triangle_count(self) -> int:
        """
        How many triangles it has.
        """
    @property
    def vertex_count(self) -> int:
        """
        How many vertices it has.
        """
class Snow:
    """
    Flakes at any time, in any order of times, without a state or a cache. Immutable. Metres, seconds, radians, world space.
    
    start_speed, start_size: of each flake.  lifetime: s, >= 0.  start_color: a gradient, a pair of positions (k,), rising, and
    colours (k, 4); None is white. Flakes have its first colour.
    rate: flakes a second, >= 0; flake i of a steady stream is born at delay + (i + 1) / rate.  rate_times (r,), s, rising,
    rate_values (r,), >= 0: in place of it a rate that goes evenly from each value to the next; flake i is born when its integral
    from the delay on is i + 1.  delay, duration: s, >= 0; the stream ends after `duration`, unless looping.
    burst_times (s after the delay), burst_counts: (b,), flakes that come all at once, numbered where they are born.
    shape: 'square', 'disc', 'box', 'sphere', 'cone' in the emitter's space, of half width or radius cone_radius, >= 0; flakes
    leave along its +Z, of a sphere away from the middle, of a cone leaning outwards, at the edge by cone_angle, [0, pi]; or
    'surface': surface_positions (v, 3), surface_triangles (t, 3), evenly over their area, along their normals; or
    'frustum': what a camera at the emitter's place sees that looks along its -Z, between frustum_near, >= 0, and frustum_far, m,
    by frustum_angles (2,), half those in X and Y, [0, pi / 2); down along the world's -Z.
    random_speed: start_speed +-1.  random_orientation: anywhere within cone_angle of where they would leave.  random_lifetime:
    lifetime +-1 s, at least 0.  random_size: +-10 %.  random_color: anywhere on the gradient.
    snow: as it flies, a flake turns by up to max_angle about the world's X and Y, as noise of its age says that changes about
    snow_frequency times a second; snow_offsets: each flake has a time of its own in the noise.
    gravity: adds acceleration (3,).  drag: 1/s, [0, 1000], with which a flake takes on the velocity of the air, wind (3,) m/s; with
    wind_times (w,), s, rising, and wind_values (w, 3) it goes evenly from each of these to the next, and is held before and after.
    It varies by the fraction `gusts`, >= 0, about gust_frequency times a second.  period: s, after which gusts and eddies are as
    they were, for which their frequencies are changed a little; 0: never.  turbulence: m/s, root
    mean square, of air in eddies of turbulence_size m that flakes are carried along by.  tumble: rad/s up to which they spin.
    ground: height that flakes land on from above; None: they do not.  collider: a SnowCollider or None.  A flake lands once, on
    what it meets first after birth, of a collider rather than the ground at the same height; a way between looks counts as
    straight, which are 1/32 s apart, or lifetime / 4096 to twice that of lives over 128 s.  collision: 'stay', where it landed and
    as it was turned; 'slide', straight down the triangle and those beyond its edges, of a collider, as acceleration pulls it
    (with gravity or without) and friction, >= 0, slows it, until it stops, at a loose edge, or where two lead down to one edge;
    'melt', smaller and smaller over melt_time, s, and then gone.  rest_time: s after which a landed flake is gone; None: when its
    lifetime ends, as it does anyway. Where flakes land is found once and kept, for 18 million of all Snows at most (1 GB).
    movers: colliders that go from place to place, (SnowCollider in its own space, times (k,), s, rising, matrices (k, 4, 4) to world
    space, between which they go evenly) each; flakes that land on one are carried along, and do not slide.
    seed: 0 to 2^32 - 1; random numbers belong to flake and seed.
    emitter_times (k,), rising, emitter_matrices (k, 4, 4): the emitter's poses; a flake is born at the pose of that moment.
    inherited: share of the velocity of the emitter's origin that a flake leaves with, beside its own.
    Raises ValueError or TypeError that names the argument, also where more than 1e8 flakes would live at once.
    """
    def __init__(self, *, start_speed: float = 5.0, lifetime: float = 2.0, start_size: float = 1.0, start_color: tuple[numpy.typing.ArrayLike, numpy.typing.ArrayLike] | None = None, rate: float = 5.0, rate_times: numpy.typing.ArrayLike | None = None, rate_values: numpy.typing.ArrayLike | None = None, delay: float = 0.0, duration: float = 5.0, looping: bool = True, burst_times: numpy.typing.ArrayLike | None = None, burst_counts: numpy.typing.ArrayLike | None = None, shape: typing.Literal['square', 'disc', 'box', 'sphere', 'cone', 'surface', 'frustum'] = 'square', surface_positions: numpy.typing.ArrayLike | None = None, surface_triangles: numpy.typing.ArrayLike | None = None, frustum_angles: numpy.typing.ArrayLike = (0.4, 0.25), frustum_near: float = 0.1, frustum_far: float = 20.0, cone_angle: float = 0.0, cone_radius: float = 1.0, random_speed: bool = False, random_orientation: bool = False, random_lifetime: bool = False, random_size: bool = False, random_color: bool = False, snow: bool = False, max_angle: float = 1.3962634015954636, snow_frequency: float = 1.0, snow_offsets: bool = False, gravity: bool = False, acceleration: numpy.typing.ArrayLike = (0.0, 0.0, -9.81), drag: float = 0.0, wind: numpy.typing.ArrayLike = (0.0, 0.0, 0.0), wind_times: numpy.typing.ArrayLike | None = None, wind_values: numpy.typing.ArrayLike | None = None, gusts: float = 0.0, gust_frequency: float = 0.3, period: float = 0.0, turbulence: float = 0.0, turbulence_size: float = 1.0, tumble: float = 0.0, ground: float | None = None, collider: SnowCollider | None = None, collision: typing.Literal['stay', 'slide', 'melt'] = 'stay', rest_time: float | None = None, melt_time: float = 1.0, friction: float = 0.5, movers: typing.Sequence[tuple[SnowCollider, numpy.typing.ArrayLike, numpy.typing.ArrayLike]] = (), seed: int = 0, emitter_times: numpy.typing.ArrayLike | None = None, emitter_matrices: numpy.typing.ArrayLike | None = None, inherited: float = 0.0) -> None:
        ...
    def evaluate(self, time: float, fields: typing.Sequence[typing.Literal['position', 'velocity', 'size', 'color', 'age', 'rotation', 'id']] | None = None, out: dict[str, numpy.typing.NDArray[typing.Any]] | typing.Callable[[int], dict[str, numpy.typing.NDArray[typing.Any]]] | None = None, known: bool = False) -> dict[str, numpy.typing.NDArray[typing.Any]]:
        """
        The flakes that live at `time`, s, as a dict of arrays in the order of their numbers: float32 position (m, 3), velocity
        (m, 3), size (m,), color (m, 4), age (m,), rotation (m, 4), which turns +Z to where the flake heads, and int64 id (m,).
        
        fields: names of those wanted; None: those in out, or all.
        out: a dict of C-contiguous arrays of m rows or more, written into, or a function that is called with m and gives one; the
        result has views of their first m rows.
        known: leave out flakes of which nobody has found yet where they land; otherwise that is found now.
        The same bits for any number of threads, and by the same compiler. Raises ValueError or TypeError that names the argument.
        """
    def find_landings(self, time: float, most: int) -> int:
        """
        Finds where flakes land of up to `most` blocks of 256 of those that live at `time`, s: some 3 ms a block. Returns how many
        blocks remain. evaluate() finds it for all.
        """
    def landings(self, end: float) -> dict[str, numpy.typing.NDArray[typing.Any]]:
        """
        Where flakes land until `end`, s, but for movers, by time and then number, as a dict: float64 time (n,), int64 id (n,), float32 position
        (n, 3), int64 triangle (n,) of the collider, -1 for the ground. Looks at all flakes born until then, some 10 us each.
        
        Raises ValueError that names the argument, also where more than 1e7 flakes are born until then.
        """
class SnowCover:
    """
    How deep snow lies on each vertex of what its flakes land on, its collider, at any time, in any order of times. Immutable.
    
    snow: a Snow with a collider.  end: s; flakes that land later are left out.  flake_volume: m^3 of lying snow that a flake
    stands for, > 0: the heights times the vertices' areas add up to that of the flakes that have landed, but for those that fell
    from the collider.  repose: angle of slopes up to which all flakes lie where they land, [0, pi / 2); the steeper the more of
    them slide down and fall from edges to what is below; all do where the slope's tangent is 1.5 times as large.  smoothing: 0 to
    1000 rounds in which neighbouring vertices even out their heights, not with those that are under something or too steep.
    Takes some 11 us and 200 bytes for each flake that is born until `end` (32 bytes once it is made).
    Raises ValueError or TypeError that names the argument, also where more than 1e7 flakes are born until then.
    """
    @staticmethod
    def restored(data: bytes) -> SnowCover:
        """
        The cover whose bytes() these are. Raises ValueError or TypeError that names the argument, where they are not the bytes of a
        cover.
        """
    def __init__(self, snow: Snow, *, end: float, flake_volume: float = 0.0001, repose: float = 0.9, smoothing: int = 4) -> None:
        ...
    def bytes(self) -> bytes:
        """
        All that the cover is, for restored() in another process or another day. Some 40 bytes a flake, and 60 a vertex.
        """
    def heights(self, time: float, out: numpy.typing.NDArray[numpy.float32] | None = None) -> numpy.ndarray:
        """
        (v,) float32: how deep snow lies on each vertex of the collider at `time`, s, in m across the surface.
        
        out: an array of that kind to write into, which is returned.
        """
    def volume(self, time: float) -> float:
        """
        m^3 that lie on the collider at `time`, s.
        """
    @property
    def areas(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (v,) float64, m^2: a third of the triangles around each vertex.
        """
    @property
    def vertex_count(self) -> int:
        """
        How many vertices the collider has.
        """
class SnowLayer:
    """
    The mesh of snow that lies on triangles, as far off each vertex as the snow there is deep. Immutable.
    
    layer_positions (v, 3); layer_triangles (t, 3): indices of vertices.  up (3,): away from what pulls snow down; the layer is
    on that side.  shelter: None, or the SnowCollider of what snow cannot fall through: between a vertex with snow and a bare one
    that is under something, or too steep by SnowCover's repose, the layer ends where the one or the other begins.
    Raises ValueError or TypeError that names the argument.
    """
    def __init__(self, layer_positions: numpy.typing.ArrayLike, layer_triangles: numpy.typing.ArrayLike, up: numpy.typing.ArrayLike = (0.0, 0.0, 1.0), shelter: SnowCollider = None, repose: float | None = None) -> None:
        ...
    def mesh(self, depths: numpy.typing.ArrayLike, thinnest: float = 0.0, steepest: float | None = None, left: numpy.typing.ArrayLike | None = None) -> dict[str, numpy.typing.NDArray[typing.Any]]:
        """
        The layer, as a dict: float32 position (n, 3) and depth (n,); int32 triangle (m, 3), edge (e, 2), which are all sides of the
        triangles, each once, and side (m, 3), the edges that leave each triangle's corners.
        
        depths (v,), m, across the surface.  thinnest, >= 0, m: snow that is not deeper is left out: the layer is cut along the
        line where it is that thin.  steepest, > 0: from vertex to vertex depths differ by no more than this fraction of the way between them; what
        would be higher has fallen off.  left (v,), >= 0, None: 1: how much of that depth is left. At loose edges walls close the layer.
        Raises ValueError or TypeError that names the argument.
        """
    @property
    def vertex_count(self) -> int:
        """
        How many vertices the triangles have.
        """
class SnowMarks:
    """
    Marks that movers leave in lying snow: how much of it they have pressed or swept away, at any time. Immutable.
    
    With the height H(t) that has fallen on a vertex, and the clearance c(s) beneath the movers, the depth there is
    H(t) - max(0, max over s <= t of H(s) - c(s)).
    layer: a SnowLayer.  movers: (SnowCollider in its own space, its triangles' normals outwards; times (k,), rising; matrices
    (k, 4, 4) to world space, between which it goes evenly) each.  times (n,), rising: the stretch of time is from the first to
    the last; marks of several stretches add up by their maximum.  heights (n, v), m, >= 0: of the snow on each vertex of the layer.
    packed, m, >= 0: depth of the snow that stays under what presses.  step, m, > 0: a mover goes no farther from look to look, of
    which there are 64 at most from one of its times to the next, and 10,000,000 in all.
    Raises ValueError or TypeError that names the argument.
    """
    def __init__(self, layer: SnowLayer, movers: typing.Sequence[tuple[SnowCollider, numpy.typing.ArrayLike, numpy.typing.ArrayLike]], times: numpy.typing.ArrayLike, heights: numpy.typing.ArrayLike, *, packed: float = 0.0, step: float = 0.05) -> None:
        ...
    def pressed(self, time: float, depths: numpy.typing.ArrayLike, shares: numpy.typing.ArrayLike | None = None) -> numpy.typing.NDArray[numpy.float32]:
        """
        (v,) float32: how much snow was pressed away on each vertex until `time`, m.
        
        depths (v,): heights at that time.  shares (v,), [0, 1], None: 1: of the heights that lie there, at all times; what is pressed away is
        as much of the whole height.
        Raises ValueError or TypeError that names the argument.
        """
    @property
    def marked_count(self) -> int:
        """
        How many of them something has pressed on.
        """
    @property
    def vertex_count(self) -> int:
        """
        How many vertices the layer has.
        """
class WalkerGround:
    """
    The ground that feet stand on, on either side of its surfaces; it does not move. Immutable: made once, for any number of Walkers.
    
    positions (v, 3), world space, of which vertices that are not finite are never met.  triangles (t, 3): indices of vertices,
    counter-clockwise seen from outside: feet stay below a roof, a face whose normal points down into air.
    plane (2, 3): a point of an endless plane and its normal. All may be None.
    Raises ValueError or TypeError that names the argument.
    """
    def __init__(self, positions: numpy.typing.ArrayLike | None = None, triangles: numpy.typing.ArrayLike | None = None, plane: numpy.typing.ArrayLike | None = None) -> None:
        ...
    def with_plane(self, plane: numpy.typing.ArrayLike | None) -> WalkerGround:
        """
        A ground that shares these triangles, with this plane (2, 3), or None, in place of its own.
        """
    @property
    def nbytes(self) -> int:
        """
        Of the memory that it takes, about.
        """
    @property
    def triangle_count(self) -> int:
        """
        How many triangles it has.
        """
    @property
    def vertex_count(self) -> int:
        """
        How many vertices it has.
        """
class Walker:
    """
    The steps of legs that walk under a moving body, planned for a whole shot; any time afterwards is a look-up. Immutable.
    Metres, seconds, radians, world space; rest, hips and up are in the body's space.
    
    times (k,), s, strictly rising, 1 to 100,000; poses (k, 4, 4): the body's matrices, of any scale, also mirrored.
    Between samples the body moves evenly; before the first sample it moves at its first velocity, or rests if that is slow;
    after the last sample it rests. Sample once a frame.
    rest (n, 3), 1 to 256 legs: where each foot stands when the body rests.  ground: a WalkerGround; None: feet stand on these
    rest places.
    phases (n,), duty, [0.05, 0.95]: as from walker_gait(): leg i swings while frac(phase + phases[i]) < 1 - duty.
    stride, [1e-6, 1e6]: the most that the body moves while a foot stands, which is the duty's share of the way from touch to touch.
    cadence, cycles/s, [0.001, 1000]: the slowest; the
    cadence in use is max(cadence, duty * speed / stride) with the speed of the leg whose rest place moves fastest across `up`.
    A foothold is the ground under the foot's rest place, along `up`, at the middle of its stand; so a foot is never further than
    half a stride from its rest place. Steps of no length are left out: feet of a body at rest end on their rest places and stay.
    clearance: height of a foot half-way through its swing above the ground under it, less in steps below a quarter of the stride.
    reach_up, reach_down: height and depth about a rest place within which ground is searched.  minimum_step: shorter steps are
    left out; all of these >= 0.  up: not zero.
    hips (n, 3), lengths (n,), >= 0, in the world, of whole legs; both or None: footholds out of reach are replaced by places nearer
    to the hip.  bodies (k, 4, 4) or None: how the body's own animation moves the hips in the body's space at the samples, before the
    body follows its feet.  resets: rising indices of samples to which the body jumps, at which the plan begins anew, as
    it does if a rest place moves further than `jump`, > 0, from one sample to the next; None: 4 strides, with
    hip_height those of Froude number 1, 9.2 hip heights times the duty.
    frequency, damping, response: the SecondOrder of the body's height and tilt, which follow the plane of its feet; height,
    tilt, [0, 1]: share of each that the body follows.
    forward: of the feet, in the body's space, of which the part across up counts.  ankle, >= 0: height of a foot's place above the ground under its
    sole.  heel, toe, >= 0: how far behind and ahead of a foot's place its sole rolls.  strike, push, rad, [0, pi/2]: how much the toe
    is up when a heel touches down, and the heel when a toe lifts; less in steps shorter than the stride, the other way round in
    steps that go backwards.
    chosen: footholds that are chosen by hand, tuples (leg, time, offset, turn, fixed, touch, until): of the stand of a leg at a time, s, or of the
    swing before it, the rest place below which ground is looked for is moved by offset (3,), in the body's space, and the sole is
    turned by turn, rad, about the ground's normal, counter-clockwise from above. fixed: None, or (place (3,), rotation (4,)), w, x,
    y, z, of the foot with its flat sole, which stands there whatever body and ground do. touch, until: s, when the foot touches down
    and when it lifts again, or None; the leg's steps before and after make room. Such footholds are never replaced by nearer ones; of
    several for one stand the last one counts. time is as steps has it in 'planned', without any touch and until.
    changes: of the gait over time, tuples (sample, phases (n,), duty) in the order of samples: from there on legs go over to this gait
    within `transition` cycles, [1, 1000], each by half a cycle at most, while feet that stand stay.  strides, cadences, duties (k,) or
    None: at the samples, in place of stride, cadence, and the duty of all gaits. A step has the stride and the duty of when it lifts.
    hip_height, [0, 1e6]: above 0 feet stand for the duty's share of walker_natural_stride() at the body's speed, in place of stride.
    Raises ValueError or TypeError that names the argument, also if more than 1,000,000 steps would be planned.
    """
    def __init__(self, times: numpy.typing.ArrayLike, poses: numpy.typing.ArrayLike, rest: numpy.typing.ArrayLike, ground: WalkerGround | None = None, *, phases: numpy.typing.ArrayLike, duty: float = 0.5, stride: float = 0.5, cadence: float = 1.0, clearance: float = 0.1, reach_up: float = 0.5, reach_down: float = 1.0, minimum_step: float = 0.0, up: numpy.typing.ArrayLike = (0.0, 0.0, 1.0), hips: numpy.typing.ArrayLike | None = None, lengths: numpy.typing.ArrayLike | None = None, bodies: numpy.typing.ArrayLike | None = None, resets: typing.Sequence[int] | None = None, jump: float | None = None, frequency: float = 2.0, damping: float = 1.0, response: float = 0.0, height: float = 1.0, tilt: float = 1.0, forward: numpy.typing.ArrayLike = (0.0, 1.0, 0.0), ankle: float = 0.0, heel: float = 0.0, toe: float = 0.0, strike: float = 0.0, push: float = 0.0, chosen: typing.Sequence[tuple[int, float, numpy.typing.ArrayLike, float, tuple[numpy.typing.ArrayLike, numpy.typing.ArrayLike] | None, float | None, float | None]] | None = None, changes: typing.Sequence[tuple[int, numpy.typing.ArrayLike, float]] | None = None, transition: float = 1.0, strides: numpy.typing.ArrayLike | None = None, cadences: numpy.typing.ArrayLike | None = None, duties: numpy.typing.ArrayLike | None = None, hip_height: float = 0.0) -> None:
        ...
    def body(self, times: numpy.typing.ArrayLike) -> tuple[numpy.typing.NDArray[numpy.float64], numpy.typing.NDArray[numpy.float64]]:
        """
        How the body follows its feet at times: (offsets (3,) or (m, 3), rotations (4,) or (m, 4)), w, x, y, z. In the world it is
        turned about its own origin, then moved.
        """
    def feet(self, times: numpy.typing.ArrayLike) -> numpy.typing.NDArray[numpy.float64]:
        """
        Positions of the feet at times, s, a number or (m,): (n, 3) or (m, n, 3). While a sole lies flat its position has the same bits.
        """
    def normals(self, times: numpy.typing.ArrayLike) -> numpy.typing.NDArray[numpy.float64]:
        """
        Unit normals of the ground under the feet, (n, 3) or (m, n, 3); during a swing they turn from one foothold's normal to the next.
        """
    def phase(self, times: numpy.typing.ArrayLike) -> typing.Any:
        """
        Cycles since the first sample or the last jump, at times: a float or (m,).
        """
    def swing(self, times: numpy.typing.ArrayLike) -> numpy.typing.NDArray[numpy.float64]:
        """
        Fraction of the swing of each foot, 0 to 1, and 0 while it stands: (n,) or (m, n).
        """
    def turns(self, times: numpy.typing.ArrayLike) -> numpy.typing.NDArray[numpy.float64]:
        """
        Rotations of the soles from the body's space to the world, w, x, y, z, (n, 4) or (m, n, 4): flat on the ground, the heading that
        of the body at the middle of the stand, rolled over heel and toe, or in a swing between.
        """
    @property
    def leg_count(self) -> int:
        """
        How many legs there are.
        """
    @property
    def nbytes(self) -> int:
        """
        Of the memory that it takes.
        """
    @property
    def problems(self) -> list[tuple[int, float, float, str]]:
        """
        Problems with footholds, by leg, then time: tuples (leg, first, last, reason), s, with the reasons 'no_ground', where the
        foot stands on its rest place, 'out_of_reach' of the hip, 'no_length' of a leg, 'no_touch' and 'no_lift' if a foot cannot touch
        down or lift when `chosen` says, and 'left_out' if a chosen foothold has no step, since a timed one lasts beyond it.
        """
    @property
    def settled(self) -> float:
        """
        When the last foot has come to rest, s.
        """
    @property
    def steps(self) -> dict[str, numpy.typing.NDArray[typing.Any]]:
        """
        All steps by leg, then time, as a dict of arrays: leg (s,) int32; lift, touch (s,), s; start, end (s, 3); apex (s, 3), where the
        foot is half-way; middle (s,), s, of the stand; turn (s, 4), w, x, y, z, of the flat sole on `end`; chosen (s,) int32: which of
        `chosen` it follows, -1 for none; planned (s,), s: `middle` if none had a touch or until. If lift equals touch the foot is put there at once: at the first sample and at jumps.
        """
class StrandSurface:
    """
    Triangles that strands cannot go through, from either side. Immutable.
    
    positions: (v, 3) float32, in a space of their own.  triangles: (t, 3) int32.  Raises ValueError or TypeError that names the
    argument.
    """
    def __init__(self, positions: numpy.typing.ArrayLike, triangles: numpy.typing.ArrayLike) -> None:
        ...
    @property
    def nbytes(self) -> int:
        """
        Of the memory that it takes, roughly.
        """
class StrandMotion:
    """
    Strands over a whole shot: particles, each joined to its parent by a link, that hang, swing and touch. Solved once, by solve(), then
    read at any time.
    
    parents: (n,), index of each particle's parent, which comes before it; -1 for a root, which stays on the pose.  times: (m,), s,
    strictly rising.  poses: (m, n, 3), where the animation has the particles; links are as long as there.
    
    A number for all links, or (n,): mass: kg, > 0.  frequency: Hz, of a spring towards the pose, at most rate / 8; 0: none.  damping:
    its damping ratio, 0 to 100.  response: of that spring, as SecondOrder's, -100 to 100.  drag: deceleration relative to the air a
    velocity, 1/s, 0 to 1000.  stretch: by how much of its length a link is lengthened by its particle's weight, 0 to 1e6.  bend_frequency: Hz, of a
    spring that keeps the pose's angle to the parent's link.  bend: rad, 0 to pi, at most this angle from where the link would be if it followed its parent's link as in the pose.  side_bend: rad,
    0 to pi, the same for what goes towards the link's side or away from it, where that is less.  thickness: m, >= 0, radius in contacts.
    
    gravity, air: acceleration, and velocity of the air: (3,), or (m, 3), one for each time; None: 0.  gravity_factor: how many times gravity
    counts, -1000 to 1000: a number for all links, or (n,).
    obstacles: k names, "capsule" (around the segment between both places; a ball if they are one) or "plane" (through the first
    place; solid on the side away from the second).  obstacle_places: (m, k, 2, 3).  radii, friction: a number or (k,).
    surfaces: s StrandSurface, which particles and the middles of links keep away from, by the thickness and surface_distances: a
    number or (s,), m.  surface_matrices: (m, s, 4, 4), to world space, scaled evenly.  surface_friction: a number or (s,).
    pinned: p indices of particles that are held.  pin_places: (m, p, 3).  pin_weights: a number or (m, p), 0 to 1: 1 holds fast, below
    that a spring that is the softer the less.
    resets: rising indices of times at which all starts anew in the pose.
    sides: (m, n, 3), where the sides of links point in the pose; None: side_bend does not count.
    touching: whether links keep away from each other, by the thicknesses of both, or as far as in the first pose if that is less.
    touching_friction: of them.
    rate: steps a second, 60 to 1e5.  settle: s, 0 to 1000: for at most so long strands come to rest before the motion begins.
    loop: the times are one cycle of an endless motion, gone through up to `cycles` times until it closes.
    
    Everything in world space and metres, linear between times.  Raises ValueError or TypeError that names the argument.
    """
    def __init__(self, parents: numpy.typing.ArrayLike, times: numpy.typing.ArrayLike, poses: numpy.typing.ArrayLike, *, mass: numpy.typing.ArrayLike = 1.0, frequency: numpy.typing.ArrayLike = 0.0, damping: numpy.typing.ArrayLike = 0.3, response: numpy.typing.ArrayLike = 0.0, drag: numpy.typing.ArrayLike = 0.0, stretch: numpy.typing.ArrayLike = 0.0, bend_frequency: numpy.typing.ArrayLike = 0.0, bend: numpy.typing.ArrayLike = 3.141592653589793, side_bend: numpy.typing.ArrayLike = 3.141592653589793, thickness: numpy.typing.ArrayLike = 0.0, gravity: numpy.typing.ArrayLike | None = None, air: numpy.typing.ArrayLike | None = None, gravity_factor: numpy.typing.ArrayLike = 1.0, obstacles: typing.Sequence[str] | None = None, obstacle_places: numpy.typing.ArrayLike | None = None, radii: numpy.typing.ArrayLike = 0.0, friction: numpy.typing.ArrayLike = 0.5, surfaces: typing.Sequence[StrandSurface] | None = None, surface_matrices: numpy.typing.ArrayLike | None = None, surface_distances: numpy.typing.ArrayLike = 0.0, surface_friction: numpy.typing.ArrayLike = 0.5, pinned: typing.Sequence[int] | None = None, pin_places: numpy.typing.ArrayLike | None = None, pin_weights: numpy.typing.ArrayLike = 1.0, resets: typing.Sequence[int] | None = None, sides: numpy.typing.ArrayLike | None = None, touching: bool = False, touching_friction: float = 0.5, rate: float = 480.0, settle: float = 0.0, loop: bool = False, cycles: int = 40) -> None:
        ...
    def __len__(self) -> int:
        ...
    def places(self, time: float) -> numpy.typing.NDArray[numpy.float64]:
        """
        Where the particles are at a time, s: (n, 3). After solved_until, as at that time.
        """
    def solve(self, steps: int = 2147483647) -> bool:
        """
        Goes on for about so many steps: whether all is solved. No other thread may use this object meanwhile.
        """
    @property
    def gap(self) -> float:
        """
        Of a loop, the largest distance of a particle at the end of its last cycle from where that began, m.
        """
    @property
    def is_solved(self) -> bool:
        ...
    @property
    def nbytes(self) -> int:
        """
        Of the memory that it takes.
        """
    @property
    def near_pairs(self) -> int:
        """
        Number of pairs of links that are so near each other in the first pose that they may touch.
        """
    @property
    def solved_until(self) -> float:
        """
        Time up to which places are known, s; of a loop the first one until all is solved.
        """
class SecondOrder:
    """
    How an output y follows an input x: y + k1 y' + k2 y'' = x + k3 x'. Immutable; times in seconds.
    
    frequency f: Hz, > 0.  damping zeta: >= 0; 0 rings for ever, 1 is critical.  response r: 0 starts slowly, up to 1 responds
    at once, above 1 overshoots, below 0 anticipates.  k1 = zeta / (pi f), k2 = 1 / (2 pi f)^2, k3 = r zeta / (2 pi f).
    Raises ValueError if a value is not finite or outside its domain.
    """
    @staticmethod
    def from_coefficients(k1: float, k2: float, k3: float) -> SecondOrder:
        """
        The filter with these coefficients: k1 >= 0 in s, k2 > 0 in s^2, any k3 in s.
        """
    @staticmethod
    def from_mass_spring(mass: float, stiffness: float, resistance: float) -> SecondOrder:
        """
        A mass (kg, > 0) on a spring (N/m, > 0) and a damper (N s/m, >= 0): y + (b/k) y' + (m/k) y'' = x + (b/k) x'.
        """
    @staticmethod
    def from_overshoot(overshoot: float, settling: float, response: float = 0.0, tolerance: float = 0.02) -> SecondOrder:
        """
        The filter whose step response overshoots by a fraction of the step (between 0 and 1) and stays within `tolerance` of its
        end after `settling` seconds (> 0). Raises ValueError too if no damping gives that overshoot with this response.
        """
    def __init__(self, frequency: float, damping: float, response: float) -> None:
        ...
    def settling_time(self, tolerance: float = 0.02) -> float:
        """
        Last time, s, at which the step response is further than `tolerance` (> 0) from its final value; infinity without damping.
        """
    @property
    def coefficients(self) -> tuple[float, float, float]:
        ...
    @property
    def damping(self) -> float:
        ...
    @property
    def frequency(self) -> float:
        ...
    @property
    def overshoot(self) -> float:
        ...
    @property
    def response(self) -> float:
        ...
class Track:
    """
    An output at any time, in any order, of a SecondOrder and an input over time. Immutable.
    
    times: (m,), s, strictly rising.  inputs: (m,) or (m, d), linear between samples.  resets: rising indices of samples to
    which the input jumps: until then it keeps its value, and at the jump the output starts anew.  loop: the samples are one
    cycle, whose last sample is the first of the next cycle; the output closes without a seam, and each cycle is offset by the
    difference between the last sample and the first.  Raises ValueError if shapes differ, times do not rise, a value is not finite, a loop has resets,
    or its length is a whole number of periods without damping.
    """
    def __init__(self, filter: SecondOrder, times: numpy.typing.ArrayLike, inputs: numpy.typing.ArrayLike, resets: typing.Sequence[int] | None = None, loop: bool = False) -> None:
        ...
    def evaluate(self, times: numpy.typing.ArrayLike) -> numpy.typing.NDArray[numpy.float64]:
        """
        Outputs at times, s, a number or (m,): of the shape of the times, followed by the inputs' d if they have one.
        """
    def offsets(self, times: numpy.typing.ArrayLike) -> numpy.typing.NDArray[numpy.float64]:
        """
        Outputs less inputs at times, in the shape of evaluate(): exactly 0 if the input has never moved.
        """
    def value(self, time: typing.SupportsFloat | typing.SupportsIndex) -> float:
        """
        The output of inputs (m,) at one time, s, as a float, without the cost of arrays.
        """
    @property
    def nbytes(self) -> int:
        """
        Of the memory that it takes.
        """
class RotationTrack:
    """
    A Track of rotations: inputs (m, 4), unit quaternions w, x, y, z, each taken by the shorter way from the one before. The
    output is the input turned by a rotation vector that is filtered in its tangent space: about one fixed axis this is the filter
    of the angle. With `loop` the last input has to equal the first.
    """
    def __init__(self, filter: SecondOrder, times: numpy.typing.ArrayLike, inputs: numpy.typing.ArrayLike, resets: typing.Sequence[int] | None = None, loop: bool = False) -> None:
        ...
    def evaluate(self, times: numpy.typing.ArrayLike) -> numpy.typing.NDArray[numpy.float64]:
        """
        Rotations at times, s, a number or (m,): (4,) or (m, 4).
        """
    def offsets(self, times: numpy.typing.ArrayLike) -> numpy.typing.NDArray[numpy.float64]:
        """
        Turns from the inputs to the outputs at times, in the inputs' own frames, in the shape of evaluate(): exactly the identity if the
        input has never moved.
        """
    @property
    def nbytes(self) -> int:
        """
        Of the memory that it takes.
        """
def above_floor(target: numpy.typing.ArrayLike, place: numpy.typing.ArrayLike, up: numpy.typing.ArrayLike, height: float = 0.0, margin: float = 0.0) -> numpy.typing.NDArray[numpy.float64]:
    """
    A chain's target, or the place above a floor that takes its stead.
    
    target: (3,).  place: (3,), a point of the floor's plane.  up: (3,), away from the floor; of no length: there is no floor.
    height: of the lowest target above the plane.  margin: within it, above and below that height, targets are held back softly.
    Returns (3,).  Raises ValueError or TypeError that names the argument.
    """
def are_below(limit: typing.SupportsFloat | typing.SupportsIndex, *args) -> bool:
    """
    Whether each number of all arrays is smaller in size than the limit; NaN is not.
    
    arrays: C-contiguous, of float32 or float64 and any shape.  Raises TypeError that names the argument.
    """
def blink(since: numpy.typing.ArrayLike) -> typing.Any:
    """
    How far a blink has shut the eyes, 0 to 1.  since: a number or (m,), seconds after its beginning; it takes 0.3.
    Returns a float or (m,).  Raises ValueError or TypeError that names the argument.
    """
def blinks(seconds: numpy.typing.ArrayLike, rate: float = 0.25, seed: int = 0) -> typing.Any:
    """
    How far blinks have shut the eyes at times, 0 to 1: one at a random time in each 1 / rate.
    
    seconds: a number or (m,).  rate: blinks a second, >= 0, at most 100 count.  seed: a whole number from 0 to 2^32 - 1.
    Returns a float or (m,).  Raises ValueError or TypeError that names the argument.
    """
def bone_to_pose(rest: numpy.typing.ArrayLike, parent_rest: numpy.typing.ArrayLike | None, parent_pose: numpy.typing.ArrayLike | None, basis: numpy.typing.ArrayLike, inherit_scale: typing.Literal['FULL', 'FIX_SHEAR', 'ALIGNED', 'AVERAGE', 'NONE', 'NONE_LEGACY'] = 'FULL', inherit_rotation: bool = True, local_location: bool = True) -> typing.Any:
    """
    A bone's pose in armature space, as Blender makes it from the bone's own transform (Bone.convert_local_to_pose).
    
    rest, basis, parent_rest, parent_pose: (4, 4) in rows; the last two None without a parent.
    inherit_scale: 'FULL', 'FIX_SHEAR', 'ALIGNED', 'AVERAGE', 'NONE' or 'NONE_LEGACY'.  Returns (4, 4).
    """
def box_around(points: numpy.typing.ArrayLike, axes: numpy.typing.ArrayLike | None = None, turn: bool = False) -> tuple[numpy.typing.NDArray[numpy.float64], numpy.typing.NDArray[numpy.float64], numpy.typing.NDArray[numpy.float64]]:
    """
    A box around points.
    
    points: (m, 3).  axes: (3, 3), rows are its axes, at right angles and of length 1; None: x, y, z.  turn: look for a smaller
    box of a different orientation, its axes ordered and signed to be near the given ones.
    Returns (center (3,), axes (3, 3) in rows, size (3,)); all 0 but the axes if there are no points.
    Raises ValueError or TypeError that names the argument.
    """
def cache_budget() -> int:
    """
    Bytes that the tables which the module keeps for later questions may take together; 1 GiB at first.
    
    These are arc length tables, frames along curves, motions of pendulums and landings of flakes. Results do not depend on
    what is kept, only the time they take.
    """
def cached_bytes() -> int:
    """
    Bytes that all kept tables take now.
    """
def clear_caches() -> None:
    """
    Lets all kept tables go.
    """
def comfortable_parallax(width: float, viewing_distance: float, eye_separation: float = 0.065, angle: float = 0.017453292519943295) -> tuple[float, float]:
    """
    Parallax that differs from the screen's own vergence by an angle (rad, 0 to 1.5), not beyond divergence.
    
    Returns (near_parallax, far_parallax), magnitudes, fractions of the screen's width.
    """
def depth_budget(near_parallax: float, far_parallax: float, interaxial: float, focal_length: float, sensor_width: float, convergence: float, mode: typing.Literal['off_axis', 'parallel', 'toe_in'] = 'off_axis') -> tuple[float, float]:
    """
    The inverse of solve_depth_budget(): the depths between which parallax stays within two magnitudes >= 0; other arguments as
    for parallax().
    Returns (near, far); far is math.inf if no depth is too far.
    """
def depth_range(depths: numpy.typing.ArrayLike, low: float = 0.01, high: float = 0.99) -> typing.Any:
    """
    Near and far depth of a scene: the depths below which the fractions low and high (0 to 1, low < high) of the samples lie.
    
    depths: (m,); depths not above 0 do not count.  Returns (near, far), or None without samples.
    """
def divergence_limit(width: float, eye_separation: float = 0.065) -> float:
    """
    Parallax, a fraction of a screen's width (m, > 0), above which the eyes would have to turn apart.
    """
def double_pendulum(times: numpy.typing.ArrayLike, theta1: float, theta2: float, omega1: float = 0.0, omega2: float = 0.0, mass1: float = 1.0, mass2: float = 1.0, length1: float = 1.0, length2: float = 1.0, gravity: float = 9.81, damping: float = 0.0, most_acceleration: float | None = None, most_velocity: float | None = None, pivot_step: float = 0.0, pivot_accelerations: numpy.typing.ArrayLike | None = None) -> numpy.typing.NDArray[numpy.float64]:
    """
    theta1, theta2 (rad from the downward vertical, with all turns), omega1, omega2 (rad/s) of a double pendulum at times.
    
    times: s, a number or (m,), of any sign and order; each row depends on its own time alone.  theta1, theta2, omega1, omega2:
    the state at time 0.  mass1, length1: of the upper bob and rod, kg and m, > 0.  gravity: m/s^2, >= 0.  damping: 1/s, >= 0,
    taken as damping * omega from both angular accelerations.  most_acceleration, most_velocity: None, or limits (> 0) on the
    sizes of angular accelerations and velocities, which no real pendulum has.  pivot_step, pivot_accelerations: see
    single_pendulum().
    Returns (4,) or (m, 4). By Gauss's method of order 16; the energy stays within some 1e-11 of its range. The same bits by
    the same compiler.  Raises ValueError if a value is not finite or outside its domain, and for times beyond
    double_pendulum_longest_time().
    """
def double_pendulum_longest_time(theta1: float, theta2: float, omega1: float = 0.0, omega2: float = 0.0, mass1: float = 1.0, mass2: float = 1.0, length1: float = 1.0, length2: float = 1.0, gravity: float = 9.81) -> float:
    """
    Farthest time, s, before or after 0, for which double_pendulum() gives the state.  Arguments and errors as there.
    """
def double_pendulum_value(time: typing.SupportsFloat | typing.SupportsIndex, which: typing.SupportsInt | typing.SupportsIndex, theta1: typing.SupportsFloat | typing.SupportsIndex, theta2: typing.SupportsFloat | typing.SupportsIndex, omega1: typing.SupportsFloat | typing.SupportsIndex = 0.0, omega2: typing.SupportsFloat | typing.SupportsIndex = 0.0, mass1: typing.SupportsFloat | typing.SupportsIndex = 1.0, mass2: typing.SupportsFloat | typing.SupportsIndex = 1.0, length1: typing.SupportsFloat | typing.SupportsIndex = 1.0, length2: typing.SupportsFloat | typing.SupportsIndex = 1.0, gravity: typing.SupportsFloat | typing.SupportsIndex = 9.81, damping: typing.SupportsFloat | typing.SupportsIndex = 0.0) -> float:
    """
    The number that double_pendulum() gives for one time in its column `which` (0 to 3), as a float, without the cost of arrays.
    Arguments and errors as for double_pendulum(); ValueError for another `which`.
    """
def double_pendulums(time: float, starts: numpy.typing.ArrayLike, mass1: float = 1.0, mass2: float = 1.0, length1: float = 1.0, length2: float = 1.0, gravity: float = 9.81, damping: float = 0.0, most_acceleration: float | None = None, most_velocity: float | None = None, pivot_step: float = 0.0, pivot_accelerations: numpy.typing.ArrayLike | None = None) -> numpy.typing.NDArray[numpy.float64]:
    """
    States (n, 4) of many equal double pendulums at one time, s, from states `starts` (n, 4) at time 0. The same numbers as
    double_pendulum() gives one by one, in less time.  Other arguments and errors as for double_pendulum(); also ValueError
    if the time is so far, or the starts are so many, that their cached states would need more than 448 MB.
    """
def ease(u: numpy.typing.ArrayLike, ease_in: float, ease_out: float) -> typing.Any:
    """
    Fraction of the path at the fraction u of the time: constant acceleration, constant speed, constant deceleration.
    
    u: a number or (m,), clamped to [0, 1].  ease_in, ease_out: fractions of the time, each in [0, 1], their sum <= 1.
    Returns a float or (m,); 0 at u = 0, 1 at u = 1, with a continuous derivative if ease_in and ease_out are above 0.
    Raises ValueError if a value is not finite or outside its domain.
    """
def ease_derivative(u: numpy.typing.ArrayLike, ease_in: float, ease_out: float) -> typing.Any:
    """
    Derivative of ease() with respect to u: a float or (m,); 0 outside [0, 1].  Arguments and errors as ease().
    """
def euler_xyz(rotations: numpy.typing.ArrayLike, out: numpy.typing.NDArray[numpy.float64] | None = None) -> typing.Any:
    """
    Euler angles of quaternions in Blender's order XYZ, as mathutils' Quaternion.to_euler('XYZ') gives them.
    
    rotations: (m, 4) or (4,), w, x, y, z, of any length but 0.  out: a C-contiguous float64 array (m, 3) or (3,) to write
    into.  Returns (m, 3) or (3,), rad.  Raises ValueError or TypeError that names the argument.
    """
def follow(curve: Curve, timing: Timing, time: float, offsets: numpy.typing.ArrayLike, mode: typing.Literal['world_up', 'minimal', 'banking', 'curvature', 'tilt', 'rail'], extend: typing.Literal['clamp', 'extrapolate', 'loop', 'ping_pong'] = 'clamp', forward: typing.Literal['X', 'Y', 'Z', '-X', '-Y', '-Z'] = 'Y', up: typing.Literal['X', 'Y', 'Z', '-X', '-Y', '-Z'] = 'Z', rotate: bool = True, lag_rate: float = 0.0, lag_by: str = 'acceleration', locations: numpy.typing.NDArray[numpy.float64] | None = None, rotations: numpy.typing.NDArray[numpy.float64] | None = None, line_up: bool = False, delays: numpy.typing.ArrayLike = 0.0, wheelbases: numpy.typing.ArrayLike = 0.0, side: float = 0.0, height: float = 0.0, level: bool = False, start: float | None = None, **kwargs) -> tuple[numpy.typing.NDArray[numpy.float64], numpy.typing.NDArray[numpy.float64]]:
    """
    Poses of followers on a curve at one time. A function of its arguments alone: times may come in any order.
    
    timing: a Timing.  time: s.  offsets: a number or (n,), how far each follower is ahead (+) or behind (-) along the curve.
    mode and its options: as in frames(), without speed, which the timing gives.
    extend: the path beyond its ends: 'clamp'; 'extrapolate' straight on along the tangent with the end's frame; 'loop';
    'ping_pong'.  forward, up: the follower's own axes that go along the curve and up: 'X', '-X', 'Y', '-Y', 'Z', '-Z', across
    each other.  rotate: False leaves every rotation the identity.
    lag_rate: > 0 lets the orientation trail its target at lag_rate times the bend of the curve per second, from time 0 on
    and with LAG_MEMORY = 120 s of memory, in at most 2300 steps: 1/120 s each for the last 10 s, and up to 1/300 of their age before. The
    error is 1e-4 rad; 0.01 rad after a jump of the target, 0.3 rad if the target ran more than half a turn ahead.  lag_by: the bend is |C''(t)| ('acceleration') or the curvature ('curvature').
    line_up: the first follower stops at the ends, and the others keep their distance from it; with extend='extrapolate' they
    stand in line before the start.
    delays: a number or (n,), s: each follower is where one without delay was so long ago.
    wheelbases: a number or (n,), >= 0: above 0 two bogies whose straight distance this is carry the follower, equal arcs before
    and behind its place. It lies midway between them, its forward axis along the line through them.
    side, height: metres to the right of the path and above it, along the frames of the mode, or those of 'world_up' if level is
    True; distance and speed are still the path's.
    start: s; before it the timing rests as at it.
    locations, rotations: C-contiguous float64 arrays (n, 3) and (n, 4) to write into, which share no memory with each other
    or offsets; new ones if None.
    Returns (locations, rotations): (n, 3) and (n, 4) quaternions w, x, y, z.
    Raises ValueError or TypeError that names the argument.
    """
def frames(curve: Curve, lengths: numpy.typing.ArrayLike, mode: typing.Literal['world_up', 'minimal', 'banking', 'curvature', 'tilt', 'rail'], extend: typing.Literal['clamp', 'extrapolate', 'loop', 'ping_pong'] = 'clamp', **kwargs) -> typing.Any:
    """
    Orientations at distances along a curve: quaternions w, x, y, z that turn +Y to the tangent and +Z to up.
    
    lengths: a number or (m,), unit of the curve.  extend: the meaning of a length outside [0, length]: 'clamp', 'extrapolate'
    (both: the end's frame), 'loop', 'ping_pong'.
    mode, and the options that only this mode reads:
    'world_up'   the world's Z across the tangent; through places where the tangent nears the vertical (11.5 degrees) it
                 goes on smoothly, without a flip.
    'minimal'    rotation-minimising from world up at the start (double reflection: Wang et al. 2008); without a seam on
                 cyclic curves.
    'banking'    up along g z + k a, a = speed^2 * curvature towards the centre of the bend.  speed: a number or (m,), unit
                 of length / s (1).  strength: k (1).  gravity: g > 0 (9.81).  limit: largest roll away from world up, rad,
                 >= 0, pi and more: none (3.2).  smoothing: width along the curve of the zero-lag filter of the curvature,
                 >= 0 (0).
    'curvature'  up towards the centre of the bend, carried on through inflexions without a flip.  outward: bool (False).
                 smoothing: as above.
    'tilt'       'world_up' turned about the tangent by tilt: (k,) rad, one per point of the curve, linear in t between.
    'rail'       up towards rail, a second Curve; goes on smoothly where the rail lies along the tangent.  rail_point: the point of
                 the rail at the same 'share' of its length, or the 'nearest' one ('share').  rail_side: the rail lies 'above',
                 'right' or 'left' ('above').
    Returns (m, 4), or (4,) for a number. Continuous along the curve wherever its tangent is; the identity on a curve of zero
    length.  Raises TypeError for an option that the mode does not read, ValueError for values outside these domains.
    """
def gusts(times: numpy.typing.ArrayLike, frequency: float, period: float = 0.0) -> numpy.typing.NDArray[numpy.float64]:
    """
    How much the wind rises and falls in gusts, in [-1, 1]: four sine waves whose rates have no common period.
    
    times: (m,), s.  frequency: of the first and highest wave, 1/s, above 0, at most 1000.  period: time after which the gusts
    begin again, s, from 1e-6 to 1e30, for which the frequencies are changed a little; 0 for none.
    Returns (m,) float64, the gusts of snow's wind if times are those since its start. The same bits by the same compiler.
    Raises ValueError if a number is outside of its domain, or a shape is wrong.
    """
def instruction_set() -> str:
    """
    The widest instruction set that inner loops run with on this processor, such as AVX2 or NEON.
    """
def keep_thread_state() -> bool:
    """
    Keeps the calling thread's Python state, until the interpreter ends.
    
    Otherwise a thread that Python has not started gets a new state for each call into Python, without cached memory: for a
    short function this costs some 100 us a call. A second call does nothing. A thread that ends leaves its state behind, so
    states of at most 64 threads are kept.
    Returns whether the thread's state is kept.
    """
def layer_mask(parents: numpy.typing.ArrayLike, chosen: numpy.typing.ArrayLike, feather: int = 0) -> numpy.typing.NDArray[numpy.float64]:
    """
    Weights of a mask with a soft border: (B,).
    
    parents: (B,), index of each bone's parent, -1 for none.  chosen: (B,), in [0, 1]; 0 is outside.  feather: over how many
    bones from the border on, >= 0, the weight rises: at the first one it is chosen / (feather + 1).
    Raises ValueError or TypeError that names the argument.
    """
def layer_moments(settings: numpy.typing.NDArray[numpy.float64], frame: float) -> numpy.typing.NDArray[numpy.float64]:
    """
    When layers play what: (L, 2), frame of the action and weight, at a frame of the scene.
    
    settings: (L, 10), see LayerStack.SETTINGS.  Raises ValueError or TypeError that names the argument.
    """
def layer_moves(own: numpy.typing.NDArray[numpy.float32], laid: numpy.typing.NDArray[numpy.float32], locations: numpy.typing.NDArray[numpy.float64], rotations: numpy.typing.NDArray[numpy.float64], scales: numpy.typing.NDArray[numpy.float64]) -> None:
    """
    Writes what comes on top of bones' own transforms, so that they become others: as LayerStack.solve() does.
    
    own and laid: (R, 16) float32, matrices column by column.  locations (R, 3), rotations (R, 4) w, x, y, z, scales (R, 3), float64:
    written into.  Raises ValueError or TypeError that names the argument.
    """
def link_turns(before: numpy.typing.NDArray[numpy.float64], after: numpy.typing.NDArray[numpy.float64]) -> numpy.typing.NDArray[numpy.float64]:
    """
    Rotations (n, k, 4), w, x, y, z, by which the k links of n rows turn from directions to others: each link takes the next ones
    along, and these turn by the smallest rotation from there. A link that has no length turns with the one above.
    
    before, after: (n, k, 3) float64, of any length, aligned and C-contiguous. Their numbers may be infinite or NaN.
    Raises ValueError or TypeError that names the argument.
    """
def look_at(forward: numpy.typing.ArrayLike, targets: numpy.typing.ArrayLike, chest: numpy.typing.ArrayLike | None = None, up: numpy.typing.ArrayLike = (0.0, 0.0, 1.0), weight: float = 1.0, body_weight: float = 0.3, head_weight: float = 1.0, eyes_weight: float = 0.0, clamp: float = 0.5, body_limit: float = 3.141592653589793, head_limit: float = 3.141592653589793, eyes_limit: float = 3.141592653589793, head_sides: numpy.typing.ArrayLike | None = None, eyes_sides: numpy.typing.ArrayLike | None = None) -> LookAtTurns:
    """
    How body, head and eyes share the turn of a gaze to a target far away.
    
    forward: (3,), direction in which the head looks before the turn.  targets: (m, 3) or (3,), directions to look in.  chest: (3,), direction of the
    chest; forward if None.  up: (3,), the chest's up; its part across chest counts.  All in one space, of any length but 0.
    weight: of the whole turn.  body_weight: share of the turn.  head_weight: share of what the body leaves.  eyes_weight:
    share of what the head leaves.  clamp: 0 free, 0.5 90 degrees to each side, 1 no turn.  All in [0, 1].
    body_limit, head_limit, eyes_limit: greatest turn of the gaze by each, rad, >= 0; from pi on none.
    head_sides, eyes_sides: (4,), greatest parts of that turn to the left, to the right, up and down; None: none.
    A turn adds no roll if both gazes lie within 37 degrees of the horizon (and, unless clamp is 0 and head_limit pi, within
    73 degrees of chest).  With a clamp >= 0.5, or limits for all that turn, the result is a continuous function of the target;
    else it changes sides if the target passes straight behind the chest.
    Returns a LookAtTurns.
    Raises ValueError or TypeError that names the argument.
    """
def matrix_products(left: numpy.typing.NDArray[numpy.float64], right: numpy.typing.NDArray[numpy.float64]) -> numpy.typing.NDArray[numpy.float64]:
    """
    Matrix products left @ right, (n, k, m). Their numbers may be infinite or NaN.
    
    left: (n, k, k) or (1, k, k).  right: (n, k, m) or (1, k, m).  Both aligned and C-contiguous.
    Raises ValueError or TypeError that names the argument.
    """
def noise1(x: numpy.typing.ArrayLike, seed: int = 0, period: int = 0) -> typing.Any:
    """
    Smooth noise of one variable, in [-1, 1]: two continuous derivatives, no period, most of its power below one wave a unit.
    
    x: a float, taken in double precision, or (m,), taken in float32.  seed: a whole number from 0 to 2^32 - 1; different
    seeds give independent noises.  period: 0, or whole units after which the noise repeats without a seam, to 2^28; x is
    then taken in double precision, and the result is float64.
    Returns a float or (m,) float32; beyond 2^30 the noise is constant. The same bits by the same compiler.
    Raises ValueError if a value is not finite, also as float32, or a shape is wrong.
    """
def noise2(xy: numpy.typing.ArrayLike, seed: int = 0) -> typing.Any:
    """
    Smooth noise of two variables, as noise1().  xy: (2,) or (m, 2), taken in float32.  Returns a float or (m,) float32.
    """
def noise3(xyz: numpy.typing.ArrayLike, seed: int = 0) -> typing.Any:
    """
    Smooth noise of three variables, as noise1().  xyz: (3,) or (m, 3), taken in float32.  Returns a float or (m,) float32.
    """
def pack_matrices(locations: numpy.typing.ArrayLike, rotations: numpy.typing.ArrayLike, out: numpy.typing.NDArray[numpy.float32] | None = None, scales: numpy.typing.ArrayLike | None = None) -> typing.Any:
    """
    Locations, rotations and scales as 4 x 4 matrices, column by column, as Blender's FLOAT4X4 attributes take them.
    
    locations: (m, 3).  rotations: (m, 4), w, x, y, z.  out: a C-contiguous float32 array (m, 16) to write into, which shares
    no memory with locations and scales.  scales: (m, 3) along the rotated axes; None: 1.
    Returns (m, 16) float32.  Raises ValueError or TypeError that names the argument.
    """
def parallax(depth: numpy.typing.ArrayLike, interaxial: float, focal_length: float, sensor_width: float, convergence: float, mode: typing.Literal['off_axis', 'parallel', 'toe_in'] = 'off_axis') -> typing.Any:
    """
    Parallax of a point: by how much the right eye sees it further right than the left eye, as a fraction of the image's width,
    positive behind the screen. (t f / s) (1 / convergence - 1 / depth) for eyes that look the same way.
    
    depth: > 0, a number or (m,), along the camera's axis; unit of interaxial (>= 0) and of convergence (> 0, may be math.inf).
    focal_length, sensor_width: > 0, in the same unit; the width of the sensor's part that the image shows.
    mode: "off_axis"; "parallel", whose convergence is infinite; "toe_in", whose parallax holds at the middle of the image.
    Returns a float or (m,).  Raises ValueError if a number is outside its domain.
    """
def parallax_around(distance: numpy.typing.ArrayLike, interaxial: float, convergence: float, elevation: float = 0.0, merge_from: float = 1.5707963267948966, merge_to: float = 1.5707963267948966) -> typing.Any:
    """
    Parallax in a stereo panorama: by how much the right eye sees a point further right than the left eye, rad of azimuth,
    positive behind the sphere of zero parallax. Of Cycles' spherical stereo: each column is seen from another place.
    
    distance: from the centre, a number or (m,), at least half of interaxial (>= 0); same unit as convergence (> 0, may be
    math.inf), the radius of the sphere.  elevation: of the picture's row, rad, -pi / 2 to pi / 2.
    merge_from, merge_to: elevations, rad, between which the eyes approach each other; 0 <= merge_from <= merge_to <= pi / 2.
    Returns a float or (m,).  Raises ValueError if a number is outside its domain.
    """
def pendulum_angle(time: typing.SupportsFloat | typing.SupportsIndex, theta: typing.SupportsFloat | typing.SupportsIndex, omega: typing.SupportsFloat | typing.SupportsIndex = 0.0, length: typing.SupportsFloat | typing.SupportsIndex = 1.0, gravity: typing.SupportsFloat | typing.SupportsIndex = 9.81, damping: typing.SupportsFloat | typing.SupportsIndex = 0.0) -> float:
    """
    The angle that single_pendulum() gives for one time, as a float, without the cost of arrays.  Arguments and errors as for single_pendulum().
    """
def pendulum_period(theta: float, omega: float = 0.0, length: float = 1.0, gravity: float = 9.81) -> float:
    """
    Seconds after which an undamped pendulum repeats itself, a full turn being a repetition; infinity if it never does.
    Arguments and errors as single_pendulum().
    """
def pivot_accelerations(step: float, positions: numpy.typing.ArrayLike) -> numpy.typing.NDArray[numpy.float64]:
    """
    Accelerations (k, 2) of a pivot that passes through positions (k, 2), m, `step` seconds (> 0) apart: those of the natural
    cubic spline, for the pivot_accelerations of pendulum functions.  Raises ValueError if a value is not finite.
    """
def pose_to_bone(rest: numpy.typing.ArrayLike, parent_rest: numpy.typing.ArrayLike | None, parent_pose: numpy.typing.ArrayLike | None, pose: numpy.typing.ArrayLike, inherit_scale: typing.Literal['FULL', 'FIX_SHEAR', 'ALIGNED', 'AVERAGE', 'NONE', 'NONE_LEGACY'] = 'FULL', inherit_rotation: bool = True, local_location: bool = True) -> typing.Any:
    """
    The inverse of bone_to_pose(): a bone's own transform from its pose. Arguments as there.
    """
def pull(positions: numpy.typing.ArrayLike, root: int | numpy.typing.ArrayLike, displacement: numpy.typing.ArrayLike, radius: float, falloff: typing.Literal['classic', 'smooth', 'sphere', 'root', 'linear', 'sharp', 'constant', 'gaussian', 'curve'] = 'smooth', distance: typing.Literal['straight', 'surface', 'edges'] = 'straight', triangles: numpy.typing.ArrayLike | None = None, weights: numpy.typing.ArrayLike | None = None, scale_factor: float = 0.0, minimum: float | None = None, maximum: float | None = None, *, curve: numpy.typing.ArrayLike | None = None, clamp_axis: int = 2, mirror: str = '', metric: numpy.typing.ArrayLike | None = None, edges: numpy.typing.ArrayLike | None = None, picker: Picker | None = None, out: numpy.typing.NDArray[numpy.float32] | None = None, reach: tuple[numpy.typing.NDArray[numpy.int32], numpy.typing.NDArray[numpy.float32]] | list[tuple[numpy.typing.NDArray[numpy.int32], numpy.typing.NDArray[numpy.float32]]] | None = None, shape: numpy.typing.ArrayLike | None = None, copy: numpy.typing.NDArray[numpy.float32] | None = None) -> numpy.typing.NDArray[numpy.float32]:
    """
    Pulls a mesh at a vertex, the root: vertices near the root follow by force * weight * displacement.
    
    positions: (v, 3) float32 (other real numbers are converted, which takes time).
    root: index of a vertex; for the distance 'straight' also a point (3,).  displacement: (3,), in the positions' space.
    radius: > 0, where the force ends sharply: at and beyond it nothing moves. For 'edges' a number of edges.
    falloff, over t = 1 - d / radius: 'smooth' 3t^2 - 2t^3, 'sphere' sqrt(2t - t^2), 'root' sqrt(t), 'linear' t, 'sharp' t^2,
    'constant' 1, 'gaussian' (e^(-4.5 d^2 / radius^2) - e^-4.5) / (1 - e^-4.5), 'curve' (samples), 'classic'
    (1 - d^2 / (radius + 1))^(1 + |scale_factor|) for d^2 < radius. Errors of a force <= 1e-6 if |scale_factor| <= 10.
    distance: 'straight'; 'surface', along triangles and loose edges; 'edges', counted. The last two need triangles or picker.
    triangles: (t, 3) int32.  edges: (e, 2) int32, the mesh's own (None: all sides of triangles).
    weights: (v,) in [0, 1]; 0 leaves a vertex alone.  curve: 2 to 65536 samples at equal steps of t from 0 to 1.
    minimum, maximum: vertices that move are clamped to them on clamp_axis (0 x, 1 y, 2 z).
    mirror: letters of 'xyz': the pull also acts mirrored about these planes through the origin; where images meet, their mean acts.
    metric: (3, 3) in rows: distances are |metric (p - root)|, such as by an object's world matrix; None: the identity.
    picker: a Picker of the mesh; its tree, refitted to positions, finds the vertices, and its neighbours are used.
    reach: a result of Picker.reach(), for instance of the begin of a stroke; with mirror, of Picker.reaches(). Then root,
    distance and metric are not read.
    shape: (v, 3) float32, positions on which distances, also the root's place, are measured instead: with it all dabs of a stroke
    can act on the shape that the mesh had when the stroke began. A picker has to be of that shape.
    out: (v, 3) float32, C-contiguous, written into; positions itself may be given.
    copy: a float32 array as out, which gets the same values in the same pass; this takes less time than to copy out later.
    Returns out, or a new array. Raises ValueError or TypeError that names the argument, before anything is written. With picker
    or reach only positions and weights of vertices in reach are read.
    """
def pull_forces(distances: numpy.typing.ArrayLike, radius: float, falloff: typing.Literal['classic', 'smooth', 'sphere', 'root', 'linear', 'sharp', 'constant', 'gaussian', 'curve'] = 'smooth', scale_factor: float = 0.0, curve: numpy.typing.ArrayLike | None = None) -> numpy.typing.NDArray[numpy.float32]:
    """
    Forces of a falloff at distances >= 0, a number or (n,): float32 of that shape. Arguments and errors as pull().
    """
def refine(positions: numpy.typing.ArrayLike, triangles: numpy.typing.ArrayLike, longest_edge: float, most_vertices: int = 4194304) -> tuple[numpy.typing.NDArray[numpy.float32], numpy.typing.NDArray[numpy.int32], numpy.typing.NDArray[numpy.int32]]:
    """
    The mesh with all edges longer than longest_edge, > 0, halved again and again: (positions (v, 3) float32, triangles (t, 3)
    int32, ends (m, 2) int32), on the same surface and without new gaps. The given vertices come first; each of the m that follow
    halves the edge between two earlier ones, its ends.
    
    Raises ValueError or TypeError that names the argument, also if there would be more than most_vertices.
    """
def rotations_of(mode: int, numbers: numpy.typing.ArrayLike) -> numpy.typing.NDArray[numpy.float64]:
    """
    (n, 4): unit quaternions of numbers (n, 4) in a rotation mode, as Blender makes them.
    
    mode: 0 quaternion, 1-6 Euler XYZ, XZY, YXZ, YZX, ZXY, ZYX, 7 axis and angle.  numbers: a quaternion; Euler angles about X, Y and Z
    and a number that does not count; an angle and its axis; rad.  Raises ValueError or TypeError that names the argument.
    """
def roundness(depth: numpy.typing.ArrayLike, interaxial: float, focal_length: float, sensor_width: float, convergence: float, width: float, viewing_distance: float, eye_separation: float = 0.065, mode: typing.Literal['off_axis', 'parallel', 'toe_in'] = 'off_axis') -> typing.Any:
    """
    How deep a small ball at a depth seems, as a part of how wide it seems: 1 is round, less is flat, more is long.
    
    Arguments as for parallax() and seen_distance(). On the screen V t / (e convergence).
    Returns a float or (m,), math.inf if the eyes would have to turn apart.
    """
def saccades(seconds: numpy.typing.ArrayLike, amplitude: numpy.typing.ArrayLike, rate: float = 2.0, seed: int = 0) -> numpy.typing.NDArray[numpy.float64]:
    """
    Where eyes look beside their target at times: small jumps between random places, as long as those of people.
    
    seconds: a number or (m,).  amplitude: a number or (m,), farthest from the target, rad, >= 0.  rate: jumps a second on average,
    >= 0, at most 100 count.  seed: a whole number from 0 to 2^32 - 1.
    Returns (2,) or (m, 2): rad to the left and up.  Raises ValueError or TypeError that names the argument.
    """
def screen_color(picture: numpy.typing.ArrayLike) -> numpy.typing.NDArray[numpy.float64] | None:
    """
    Colour of the green or blue screen in a picture, or None if there is none on at least a fiftieth of it.
    
    The median of the most frequent saturated hue; pixels near the picture's border count most, transparent ones not at all.
    picture: (rows, columns, 4), red, green, blue and alpha, scene-linear, taken in float32.
    Returns (3,) float64, scene-linear. Raises ValueError if a value is not finite, or there is no pixel.
    """
def screen_matte(picture: numpy.typing.ArrayLike, color: numpy.typing.ArrayLike, balance: float = 0.0, gain: float = 1.0) -> numpy.typing.NDArray[numpy.float64]:
    """
    Alpha of each pixel by its colour difference: 1 - gain m(pixel) / m(color), clamped to [0, 1]. m is the screen's channel less a mixture of
    the others: balance times the smaller plus (1 - balance) times the larger.
    
    picture, color: as for screen_report().  balance: in [0, 1].  gain: not below 0.  Returns (rows, columns) float64.
    """
def screen_report(picture: numpy.typing.ArrayLike, color: numpy.typing.ArrayLike, balance: float = 0.0, gain: float = 1.0) -> dict[str, float]:
    """
    How well a picture can be keyed by a colour.
    
    picture: as for screen_color().  color: (3,), a green or a blue, not as green as it is blue at balance 0.  balance, gain: as for
    screen_matte().
    Returns a dict of floats. share: fraction of the pixels that show the screen.  luminance_spread: from the 5th to the 95th percentile of
    the screen's luminance, over its median.  chroma_spread: 95th percentile of the distance from the screen's median
    chromaticity, whose parts sum to 1.  spill: mean excess of the screen's channel on the subject, 1 for as much as on the screen; 0 for a
    screen that is as green as it is blue.
    black, white: levels of screen_matte() at which the screen is clear and the subject opaque; 0 <= black < white <= 1.
    """
def second_order(times: numpy.typing.ArrayLike, inputs: numpy.typing.ArrayLike, frequency: float, damping: float, response: float) -> numpy.typing.NDArray[numpy.float64]:
    """
    Outputs of a SecondOrder at the samples of its input, at rest on the first.
    
    times: (m,), s, strictly rising.  inputs: (m,) or (m, d), linear between samples; there the step is exact, whatever its
    length.  Returns an array of the shape of inputs.  Raises ValueError if shapes differ, times do not rise, or a value is
    not finite; other arguments and errors as SecondOrder().
    """
def seen_distance(parallax: numpy.typing.ArrayLike, width: float, viewing_distance: float, eye_separation: float = 0.065) -> typing.Any:
    """
    Perceived distance from the audience, m, of a point with a parallax (a fraction of the width; a number or (m,)).
    
    width, viewing_distance, eye_separation: of the screen, m, > 0.
    Returns a float or (m,), math.inf if the eyes are parallel or would have to turn apart.
    """
def set_cache_budget(bytes: typing.SupportsInt | typing.SupportsIndex) -> None:
    """
    Changes cache_budget(). Tables that no longer have room are let go, those first that were used longest ago.
    
    A budget of 0 keeps nothing. Raises TypeError if bytes is not a whole number >= 0.
    """
def single_pendulum(times: numpy.typing.ArrayLike, theta: float, omega: float = 0.0, length: float = 1.0, gravity: float = 9.81, damping: float = 0.0, pivot_step: float = 0.0, pivot_accelerations: numpy.typing.ArrayLike | None = None) -> numpy.typing.NDArray[numpy.float64]:
    """
    Angle (rad from the downward vertical, with all turns) and angular velocity (rad/s) of a pendulum at times.
    
    theta'' = -(gravity / length) sin(theta) - damping theta'
    
    times: s, a number or (m,), of any sign and order.  theta, omega: the state at time 0.  length: m, > 0.  gravity: m/s^2,
    >= 0.  damping: 1/s, >= 0.  pivot_accelerations: (k, 2), m/s^2, of a moving pivot in the plane of the swing (to the side
    of positive angles, and up), every pivot_step seconds from time 0 on, linear in between, none after the last; times must
    then be >= 0.
    Returns (2,) or (m, 2). Undamped on a fixed pivot in closed form (Jacobi's elliptic functions), else integrated.
    Raises ValueError if a value is not finite or outside its domain, or a time is out of the integration's reach.
    """
def smooth_ahead(values: numpy.typing.ArrayLike, ahead: int, side: str = 'either') -> typing.Any:
    """
    Values at equal times, smoothed without lag by the values up to `ahead` (a whole number, 0 to 10000) before and behind.
    
    side: "either"; "below" or "above": the side of all the values on which the curve stays; then values twice as far count.
    Returns (m,).
    """
def soft_reach(distance: numpy.typing.ArrayLike, reach: float, softness: numpy.typing.ArrayLike) -> typing.Any:
    """
    Distance from the root at which the tip of a chain stands whose target is at `distance`.
    
    distance: a number or (m,), >= 0.  reach: length of the straight chain, >= 0.  softness: >= 0; one above reach counts as
    that.
    Returns a float or (m,): distance up to reach - softness, from there with a slope that falls from 1 to 0, and reach from
    reach + 2 * softness on.  Raises ValueError or TypeError that names the argument.
    """
def solve_chain(joints: numpy.typing.ArrayLike, target: numpy.typing.ArrayLike, tolerance: float = 1e-06, max_iterations: int = 100, pole: numpy.typing.ArrayLike | None = None, limits: numpy.typing.ArrayLike | None = None, plane: numpy.typing.ArrayLike | None = None, frames: numpy.typing.ArrayLike | None = None) -> ChainSolution:
    """
    Brings the last joint of a chain of 1 to 255 bones to a target. Any space, any unit of length; coordinates up to 1e300.
    
    joints: (n + 1, 3), the pose to start from, the root first. Root and lengths are kept, and the
    shape of the pose and the plane that it bends in as far as possible. Straight and folded poses and bones without length are fine.
    target: (3,).  tolerance: residual that counts as reached, > 0, a fraction of the chain's length.
    max_iterations: >= 0; with limits those of one start of several.
    pole: (3,), a point that the chain bends towards, seen across the line from root to target, or None. Fades out if it
    lies within 6 degrees of that line. With limits it only leads the start.
    plane: (3,), normal of the plane to bend in if the pose is straight, or None for a fixed one; the bend is then on the
    side of cross(plane, target - root).
    limits: (n, 6), rows of min x, y, z, max x, y, z in rad, -inf and inf for free: how far each bone may turn from the given
    pose, seen from the bone before it. The turn is split into a twist about the bone (y) and a swing about x and z within
    the ellipse that the four limits span; an interval that does not contain 0 bounds its axis by itself.
    frames: (n, 4), each bone's frame in the given pose, whose Y is along the bone and whose X and Z are the axes of the limits; read
    with limits only. None: the first is +Y turned to the first bone by the smallest rotation, each of the others is the frame before it
    turned by the smallest rotation from bone to bone; half a turn about X if bones are opposite.
    A target out of reach gives, without limits, the chain straight or folded on the line to it, else the nearest place that
    several starts find.
    Returns a ChainSolution.  Raises ValueError or TypeError that names the argument.
    """
def solve_depth_budget(near: float, far: float, near_parallax: float, far_parallax: float, focal_length: float, sensor_width: float) -> tuple[float, float]:
    """
    Interaxial distance and convergence of off-axis eyes by which a range of depths takes exactly a range of parallax.
    
    near, far: depths, 0 < near < far; far may be math.inf.  near_parallax, far_parallax: magnitudes >= 0 in front of and behind
    the screen, fractions of the image's width, not both 0.  focal_length, sensor_width: as parallax() has them.
    Returns (interaxial, convergence), unit of the depths.  Raises ValueError if a number is outside its domain.
    """
def solve_two_bone(root: numpy.typing.ArrayLike, target: numpy.typing.ArrayLike, length1: numpy.typing.ArrayLike, length2: numpy.typing.ArrayLike, pole: numpy.typing.ArrayLike, bend: numpy.typing.ArrayLike = 1, softness: numpy.typing.ArrayLike = 0.0, stretch: numpy.typing.ArrayLike = 0.0, plane: numpy.typing.ArrayLike | None = None) -> TwoBoneSolution:
    """
    Elbow and tip of two bones whose tip goes to a target, in closed form. Any space, any unit of length.
    
    root, target: (3,) or (m, 3).  length1, length2: root to elbow and elbow to tip, >= 0.
    pole: (3,) or (m, 3), a point that the elbow bends towards, seen across the line from root to target (bend = 1), or
    away from (bend = -1).
    softness: the length, >= 0, before the full reach at which the arm begins to slow: see soft_reach(); one above
    length1 + length2 counts as that.  stretch: the share, 0 to 1, of the missing length that both bones stretch by.
    plane: (3,) or (m, 3), normal of the plane to bend in if the pole lies within 6 degrees of the line from root to
    target, blended in without a jump; the elbow is then on the side of cross(plane, target - root). None: the pole
    decides, except within 0.06 degrees of the line, where a fixed normal does.
    Numbers may be (m,) arrays too; an argument that is given once counts for all chains.
    A target out of reach gives the chain straight (too far) or folded (too near) on the line to it. Zero lengths and points
    that coincide are fine: with the target on the root, the elbow is towards the pole.
    Returns a TwoBoneSolution.  Raises ValueError or TypeError that names the argument.
    """
def spherical_pendulum(times: numpy.typing.ArrayLike, angle: float, heading: float = 0.0, velocity: float = 0.0, across: float = 0.0, length: float = 1.0, gravity: float = 9.81, damping: float = 0.0, pivot_step: float = 0.0, pivot_accelerations: numpy.typing.ArrayLike | None = None) -> numpy.typing.NDArray[numpy.float64]:
    """
    Direction (x, y, z, of length 1, Z up) from the pivot to the bob of a pendulum that swings to all sides, and its change in
    a second, at times.
    
    times: s, a number or (m,), of any sign and order; each row depends on its own time alone.  angle: at time 0, rad from the
    downward vertical, towards the heading, rad about the vertical from X to Y.  velocity, across: rad/s, by which the angle
    grows, and at right angles to that, to the side to which the heading grows.  length: m, > 0.  gravity: m/s^2, >= 0.
    damping: 1/s, >= 0.  pivot_step, pivot_accelerations: see single_pendulum(), here (k, 3) in space.
    Returns (6,) or (m, 6). By Gauss's method of order 16, which keeps the angular momentum about the vertical. The same bits
    by the same compiler.
    Raises ValueError if a value is not finite or outside its domain, or a time is out of the integration's reach.
    """
def step_response(times: numpy.typing.ArrayLike, frequency: float, damping: float, response: float) -> typing.Any:
    """
    Response of a SecondOrder to an input that jumps from 0 to 1 at time 0.
    
    times: s, a number or (m,).  Returns a float or (m,).  Other arguments and errors as SecondOrder().
    """
def steps(x: numpy.typing.ArrayLike, seed: int = 0, blend: float = 0.0) -> typing.Any:
    """
    A random number in [-1, 1] for each unit of x, held until the next one.
    
    x: a number or (m,).  seed: a whole number from 0 to 2^32 - 1.  blend: fraction of a unit, from 0 to 1, in which it
    goes over from the number before by a smooth step.
    Returns a float or (m,) float64.  Raises ValueError if a value is not finite or outside its domain.
    """
def stereo_points(points: numpy.typing.ArrayLike, interaxial: float, focal_length: float, sensor_width: float, convergence: float, mode: typing.Literal['off_axis', 'parallel', 'toe_in'] = 'off_axis') -> typing.Any:
    """
    Image positions at which both eyes see points.
    
    points: (m, 3), right, up and forward of the middle between the eyes, in front of both.  Other arguments as for parallax().
    Returns (m, 2, 2): of each point left and right eye, of these x and y from the image's middle, fractions of its width.
    Raises ValueError for a point that is not in front of both eyes.
    """
def vertical_parallax(depth: numpy.typing.ArrayLike, aspect: float, interaxial: float, focal_length: float, sensor_width: float, convergence: float, mode: typing.Literal['off_axis', 'parallel', 'toe_in'] = 'toe_in') -> float:
    """
    Largest vertical parallax at a depth, in a corner of the image: a fraction of the image's width, 0 except for "toe_in".
    
    aspect: the image's width / its height, > 0.  Other arguments as for parallax().  Returns a float.
    """
def walker_gait(gait: typing.Literal['tripod', 'tetrapod', 'ripple', 'wave', 'trot', 'pace', 'walk', 'run', 'canter', 'gallop', 'hop'], rest: numpy.typing.ArrayLike, forward: numpy.typing.ArrayLike = (0.0, 1.0, 0.0), up: numpy.typing.ArrayLike = (0.0, 0.0, 1.0)) -> tuple[numpy.typing.NDArray[numpy.float64], float]:
    """
    When the legs of a gait swing: (phases (n,), [0, 1), duty): leg i swings while frac(phase + phases[i]) < 1 - duty.
    
    gait: 'tripod', neighbours alternate; 'tetrapod', neighbours alternate, and all stand for a moment in between: L1 R2 L3 R4 | R1 L2 R3 L4; 'ripple',
    on each side from the back to the front, the sides about half a cycle apart; 'wave', one after the other; 'trot', the front
    half of a side with the rear half of the other; 'pace', all left legs, then all right legs; 'walk', on each side from the
    back to the front, the sides half a cycle apart; 'run', as a trot with all feet in the air in between; 'canter', three beats, the
    left side leads; 'gallop', four beats, the left side leads; 'hop', all together.
    rest (n, 3), 1 to 256 legs in any order: where feet stand when the body rests, in the space of forward and up (3,).
    Raises ValueError or TypeError that names the argument.
    """
def walker_natural_stride(speeds: numpy.typing.ArrayLike, hip_height: float) -> typing.Any:
    """
    How far a body goes from a touch of a foot to the next touch of the same foot, m, as animals of all sizes have it: 2.3 h F^0.3
    with the Froude number F = v^2 / (g h), of at least 0.001, and g = 9.81 m/s^2.
    
    speeds: v, m/s, a number or (m,), hip_height: h, m, all from 0 to 1e12. Returns a float or (m,).
    Raises ValueError or TypeError that names the argument.
    """
def wave(shape: str, x: numpy.typing.ArrayLike, share: float = 0.5) -> typing.Any:
    """
    A wave of the length 1 at x, in [-1, 1].
    
    shape: "sine" and "triangle", which are 0 and rise where x is whole; "saw", which rises from -1 to 1; "square", which is
    1, then -1.  x: a number or (m,).  share: fraction of a wave, from 0 to 1, for which a square is 1.
    Returns a float or (m,).  Raises ValueError if a value is not finite or outside its domain, or the shape is unknown.
    """
def weld(positions: numpy.typing.ArrayLike, distance: float, metric: numpy.typing.ArrayLike | None = None) -> numpy.typing.NDArray[numpy.int32]:
    """
    Leaders (v,) int32 of vertices that count as one, such as the corners of a scan's loose triangles.
    
    In the order of their indices, vertices without a leader lead themselves, and all vertices without a leader with
    |metric (p - q)| <= distance, where q is the leader's position. leaders[triangles] are the triangles of the welded mesh.
    positions: (v, 3) float32.  distance: >= 0.  metric: as in Picker.within().
    Raises ValueError or TypeError that names the argument.
    """
def window_violations(x: numpy.typing.ArrayLike, depths: numpy.typing.ArrayLike, interaxial: float, focal_length: float, sensor_width: float, convergence: float, tolerance: float = 0.0, mode: typing.Literal['off_axis', 'parallel', 'toe_in'] = 'off_axis') -> tuple[float, float]:
    """
    Largest parallax by which something in front of the screen is cut off in one eye's image alone, at each edge.
    
    x: (m,), position at which the middle between the eyes sees each sample, fractions of the width from the image's middle.
    depths: (m,); depths not above 0 do not count.  tolerance: parallax too small to be noticed, >= 0.
    Returns (left, right), magnitudes, 0 if nothing is cut off.
    """
LAG_MEMORY: float = 120.0
__version__: str = '0.1.0'
