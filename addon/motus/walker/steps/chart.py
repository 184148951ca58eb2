"""Chart of a walker's steps over time, in the corner of a viewport: a row for each foot, a bar for each stand, whose ends are dragged."""

import math
from typing import Any, NamedTuple

from ...core.measures import scene_time
from ...core.refusals import Refused
from . import chosen

MOMENTS = "touch", "lift"
"""Ends of a bar, by the names of the properties that set them: the foot touches the ground, and lifts again."""
SECONDS = 2.0
"""Seconds before and after the present frame that the chart shows."""
MOST_ROWS = 16
ROW, BAR, LEFT, BOTTOM, NAMES, WIDTH, BESIDE = 14.0, 8.0, 70.0, 40.0, 80.0, 420.0, 20.0
"""Height of a row and of a bar, place of the chart, width of the names and of the bars, and least distance of the chart from the region's
right side; in pixels at a Resolution Scale of 1."""
NEAR = 6.0
"""Distance along the row, in pixels at a Resolution Scale of 1, within which the mouse picks the end of a bar."""


class End(NamedTuple):
    """An end of a bar. step: chosen.Step. moment: one of MOMENTS. seconds: when it is."""

    step: Any
    moment: str
    seconds: float


class Chart(NamedTuple):
    """What is drawn of a walker's steps. steps: chosen.Steps. now: present time, s. rows: number of feet. scale: of the interface.

    width: of the bars' part, in pixels.
    """

    steps: Any
    now: float
    rows: int
    scale: float
    width: float

    @classmethod
    def of(cls, context, owner, region):
        """The Chart of a walker in a region; None if it does not walk, or there is no room. owner: original object that walks."""
        scale = context.preferences.system.ui_scale
        width = min(WIDTH * scale, region.width - (LEFT + NAMES + BESIDE) * scale)
        if width < NAMES * scale:
            return None
        now = scene_time.seconds(context.scene, scene_time.present(context.scene))
        try:
            steps = chosen.between(context, owner, now - SECONDS, now + SECONDS)
        except Refused:
            return None
        rows = min(len(owner.motus.walker.legs), MOST_ROWS)
        return cls([step for step in steps if step.leg < rows], now, rows, scale, width)

    def seconds(self, pixels):
        """Time, s, that a distance along a row stands for."""
        return pixels * 2.0 * SECONDS / self.width

    def x(self, seconds):
        """Place of a time along the rows, within the chart."""
        across = min(max((seconds - self.now) / (2.0 * SECONDS) + 0.5, 0.0), 1.0)
        return (LEFT + NAMES) * self.scale + across * self.width

    def y(self, leg):
        """Height of the middle of a leg's row, the first leg's on top."""
        return (BOTTOM + (self.rows - leg - 0.5) * ROW) * self.scale

    def ends(self):
        """List the Ends of bars that are within the chart."""
        found = [End(step, name, getattr(step, name)) for step in self.steps for name in MOMENTS]
        return [end for end in found if math.isfinite(end.seconds) and abs(end.seconds - self.now) <= SECONDS]

    def pick(self, mouse):
        """The End nearest to the mouse; None if the mouse is near none. mouse: place in the region, pixels."""
        beside = [
            (abs(self.x(end.seconds) - mouse[0]), end)
            for end in self.ends()
            if abs(self.y(end.step.leg) - mouse[1]) <= 0.5 * ROW * self.scale
        ]
        best = min(beside, key=lambda one: one[0], default=None)
        return best[1] if best is not None and best[0] <= NEAR * self.scale else None
