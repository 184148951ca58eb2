"""Operator that fills a follower's list of speeds from the bends of its path: slow in bends, fast where it is straight."""

import bpy

from ..core import wiring
from ..core.file.pointers import pointed
from ..core.interface.operators import Operator, object_keyword
from ..core.interface.rows import Rows
from ..core.lazy import numpy as np
from ..core.refusals import Refused, check_finite
from ..core.settings import lists
from ..core.settings.declared import number
from ..core.translations import tr
from . import curves, setup
from .operators import follower_for
from .properties import SLOWEST

SAMPLES = 2000  # places on the path at which the bend is measured
TOLERANCE = 0.02  # share of the top speed by which straight lines between the kept places may differ


class MOTUS_OT_path_speeds_from_bends(Operator, bpy.types.Operator):
    bl_idname = "motus.path_speeds_from_bends"
    bl_label = "Speeds from Bends"
    bl_description = "Replace the list of speeds by ones that are low in the bends of the path"

    object: object_keyword("Name of the object; empty takes the active one")
    top_speed: number("Top Speed", "Speed where the path is straight", 10.0, min=SLOWEST, soft_max=100.0, unit='VELOCITY', update=None)
    sideways: number(
        "Sideways", "Largest acceleration sideways in the bends", 3.0, min=1e-3, soft_max=30.0, unit='ACCELERATION', update=None
    )
    braking: number(
        "Braking", "Acceleration with which speed is gained and lost", 2.0, min=1e-3, soft_max=30.0, unit='ACCELERATION', update=None
    )
    redo = (Rows(("top_speed", "sideways", "braking")),)

    def run(self, context):
        obj = follower_for(context, self.object)
        settings, curve = obj.motus.path, pointed(obj.motus.path, "curve")
        check_finite(self, ("top_speed", "sideways", "braking"))
        if curve is None:
            raise Refused(tr("Choose a curve to follow"))
        depsgraph = context.view_layer.depsgraph
        try:
            path = curves.read_evaluated(curve.evaluated_get(depsgraph), depsgraph, settings.spline).curve
        except curves.Unreadable as unreadable:
            raise Refused(tr(unreadable.problem.sentence)) from None
        if path.length() == 0.0:
            raise Refused(tr("The path has no length"))
        places, speeds = speeds_in_bends(path, self.top_speed, self.sideways, self.braking)
        lists.replace(settings.speeds, [{"distance": place, "speed": speed} for place, speed in zip(places, speeds)], "Speed")
        settings.active_speed = 0
        settings.timing = 'PLACES'
        wiring.touch(setup.system(), obj)
        self.report({'INFO'}, tr("{count} speeds along the path").format(count=len(places)))


def speeds_in_bends(path, top, sideways, braking):
    """Return (distances, speeds): straight lines between them stay within TOLERANCE of the speed that the bends of a native curve allow.

    In a bend of curvature k the speed is sqrt(sideways / k) at most, and it changes by the acceleration `braking` at most.
    """
    places = np.linspace(0.0, path.length(), SAMPLES + 1)
    bend = np.nan_to_num(path.curvature(path.t_at_length(places)), nan=0.0, posinf=1e12)
    squares = np.minimum(top * top, sideways / np.maximum(bend, 1e-12))
    # v^2 grows by 2 a over a metre, forth and back; a closed path has two laps, of which the second knows the first.
    gain = 2.0 * braking * path.length() / SAMPLES
    for _ in range(2 if path.cyclic else 1):
        for order in (range(1, SAMPLES + 1), range(SAMPLES - 1, -1, -1)):
            for index in order:
                before = index - order.step
                squares[index] = min(squares[index], squares[before] + gain)
        if path.cyclic:
            squares[0] = squares[-1] = min(squares[0], squares[-1])
    speeds = np.maximum(np.sqrt(squares), SLOWEST)
    kept = _kept(places, speeds, TOLERANCE * top)
    return places[kept].tolist(), speeds[kept].tolist()


def _kept(places, values, tolerance):
    """Return the rising indices of the samples between which straight lines stay within the tolerance (Ramer, Douglas and Peucker)."""
    kept, open_pieces = {0, len(places) - 1}, [(0, len(places) - 1)]
    while open_pieces:
        first, last = open_pieces.pop()
        line = np.interp(places[first : last + 1], places[[first, last]], values[[first, last]])
        farthest = int(np.argmax(np.abs(values[first : last + 1] - line)))
        if abs(values[first + farthest] - line[farthest]) > tolerance and 0 < farthest < last - first:
            kept.add(first + farthest)
            open_pieces += [(first, first + farthest), (first + farthest, last)]
    return sorted(kept)


classes = (MOTUS_OT_path_speeds_from_bends,)
