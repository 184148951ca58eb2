"""Viewport overlay of a stereo rig: planes at near, screen and far, the comfortable volume, and a ruler of parallax."""

from ..core import native
from ..core.interface.overlay import Batch, Overlay, Switch
from ..core.lazy import numpy as np
from . import rig, screens
from .solve import PERCENT, depth_of

NEAR, ZERO, FAR = (0.95, 0.35, 0.30, 0.9), (0.95, 0.95, 0.95, 0.9), (0.35, 0.60, 0.98, 0.9)
SAFE = (0.35, 0.85, 0.45, 0.6)
COMFORTABLE, STRAINED, DIVERGING = (0.35, 0.85, 0.45, 0.9), (0.98, 0.75, 0.25, 0.9), (0.95, 0.25, 0.85, 0.9)
SCALE = (0.80, 0.80, 0.80, 0.7)

STEP, STEPS = 0.005, 8
"""Parallax between two marks of the ruler, and number of marks on either side of the screen. Parallax is a fraction of the width."""
MARKS = 0.015, 0.03
"""Half the length of the ruler's marks at half percents and at whole percents, as fractions of the image width."""
MOST_RULED = 64
"""Largest number of selected objects whose parallax the ruler shows."""

PLANES = Switch("show_stereo_planes", "Planes", "Draw the planes of the depth budget: near in red, the screen in white, far in blue")
VOLUME = Switch("show_stereo_volume", "Safe Volume", "Draw the volume that an audience can look at without strain")
RULER = Switch(
    "show_stereo_ruler",
    "Ruler",
    "Draw marks where parallax is a multiple of half a percent, and lines to the selected objects: "
    "green, strained ones in yellow, diverging ones in pink",
)


def _batches(context, owner):
    if not rig.has_rig(owner):
        return []
    depsgraph, scene = context.evaluated_depsgraph_get(), context.scene
    eyes, _ = rig.eyes(scene, owner, depsgraph)
    screen = screens.of(owner.motus.stereo)
    if eyes is None or not screens.is_sound(screen):
        return []
    evaluated = owner.evaluated_get(depsgraph)
    camera, settings = evaluated.data, evaluated.motus.stereo
    frame = _Frame(scene, evaluated)
    limits = native.module.comfortable_parallax(**screen)
    safe = native.module.depth_budget(*limits, **eyes)
    near, far = safe
    if settings.convergence == 'BUDGET':
        limits = PERCENT * settings.near_parallax, PERCENT * settings.far_parallax
        near, far = native.module.depth_budget(*limits, **eyes)
    ends = [min(max(depth, camera.clip_start), camera.clip_end) for depth in safe]
    found = []
    if scene.motus.show_stereo_planes:
        # Planes outside the clipping range are not drawn, since the camera sees nothing there.
        planes = ((near, NEAR), (eyes["convergence"], ZERO), (far, FAR))
        found += [
            Batch('LINE_STRIP', frame.loop(depth), color, 2.0) for depth, color in planes if camera.clip_start < depth < camera.clip_end
        ]
    if scene.motus.show_stereo_volume and ends[0] < ends[1]:
        found.append(Batch('LINES', frame.sides(*ends), SAFE, 1.5))
    if scene.motus.show_stereo_ruler:
        found += _ruler(context, owner, frame, eyes, screen)
    return found


def _ruler(context, owner, frame, eyes, screen):
    """Return the drawing batches of the ruler.

    The ruler has marks of equal parallax along the lower edge of the image, and a line to each selected object. frame: the camera's _Frame.
    eyes, screen: keyword arguments of the native functions.
    """
    camera, call = owner.data, native.module
    ends = camera.clip_start, camera.clip_end
    marks = [(eyes["convergence"], MARKS[1])]
    for index in range(1, STEPS + 1):
        marks += [(depth, MARKS[index % 2 == 0]) for depth in call.depth_budget(index * STEP, index * STEP, **eyes)]
    marks = sorted((depth, half) for depth, half in marks if ends[0] < depth < ends[1])
    if not marks:
        return []
    along = [frame.below(depth, 0.0) for depth, _ in (marks[0], marks[-1])]
    across = [frame.below(depth, side * half) for depth, half in marks for side in (-1.0, 1.0)]
    found = [Batch('LINES', np.array(along + across, np.float32), SCALE, 1.5)]
    near, far = call.comfortable_parallax(**screen)
    limit = call.divergence_limit(screen["width"], screen["eye_separation"])
    for obj in [one for one in context.selected_objects if one != owner][:MOST_RULED]:
        place = obj.matrix_world.translation
        depth = depth_of(owner.matrix_world, place)
        if depth > 0.0:
            parallax = call.parallax(depth, **eyes)
            color = DIVERGING if parallax > limit else COMFORTABLE if -near <= parallax <= far else STRAINED
            found.append(Batch('LINES', np.array((frame.below(depth, 0.0), place), np.float32), color, 2.0))
    return found


class _Frame:
    """World positions of the corners and edges of a camera's image at any depth."""

    def __init__(self, scene, evaluated):
        corners = np.array(evaluated.data.view_frame(scene=scene))
        self._corners = corners / -corners[:, 2:]
        self._matrix = np.array(rig.axis_matrix(evaluated.matrix_world).inverted())

    def _at(self, depth):
        return (self._corners * depth) @ self._matrix[:3, :3].T + self._matrix[:3, 3]

    def loop(self, depth):
        """Edge of the image at a depth, as a closed line of world positions, (5, 3)."""
        return self._at(depth)[[0, 1, 2, 3, 0]].astype(np.float32)

    def below(self, depth, aside):
        """World position on the lower edge of the image at a depth.

        aside: distance to the right of the middle, as a fraction of the image width.
        """
        corners = self._at(depth)
        right, left = corners[1], corners[2]
        return 0.5 * (left + right) + aside * (right - left)

    def sides(self, near, far):
        """Edges of the image at two depths, and the lines between the corners, as pairs of line ends, (24, 3)."""
        first, last = self._at(near), self._at(far)
        turned = [1, 2, 3, 0]
        pairs = [(first, last), (first, first[turned]), (last, last[turned])]
        return np.concatenate([np.stack(pair, axis=1).reshape(-1, 3) for pair in pairs]).astype(np.float32)


overlay = Overlay(_batches, (PLANES, VOLUME, RULER))
