"""Motion drivers that act while the dialog of motus.driver_add is open, and are taken back without a trace."""

from dataclasses import dataclass
from typing import Any

import bpy


@dataclass(frozen=True)
class _Before:
    """What a property was before. driver: type, use of `self` and expression of its driver, or None. value: of the property."""

    place: Any
    driver: tuple | None
    value: Any
    was_animated: bool

    def restore(self):
        if self.driver is not None:
            driver = self.place.curve.driver
            driver.type, driver.use_self, driver.expression = self.driver
            return
        self.place.remove()
        if not self.was_animated:
            self.place.holder.animation_data_clear()
        self.place.rest_at(self.value)


class Trial:
    """Motion drivers on properties, and the scene playing, from begin() to end()."""

    def __init__(self):
        self._before = []
        self._plays = False

    def begin(self, context):
        """Play the scene, if it does not play yet."""
        if not bpy.app.background and not context.screen.is_animation_playing:
            bpy.ops.screen.animation_play()
            self._plays = True

    def put(self, place, expression):
        """Add a motion driver to a property, or change the expression of the driver that it has. Raises Refused if it cannot be driven."""
        curve, animation = place.curve, place.holder.animation_data
        driver = curve and (curve.driver.type, curve.driver.use_self, curve.driver.expression)
        before = _Before(place, driver, place.value, animation is not None)
        if curve:
            place.set_expression(expression)
        else:
            place.add(expression)
        self._before.append(before)

    def take_back(self):
        """Leave the properties as they were before put()."""
        while self._before:
            self._before.pop().restore()

    def end(self):
        """Take everything back; if begin() has started to play, stop at the frame on which it started."""
        self.take_back()
        if self._plays:
            bpy.ops.screen.animation_cancel(restore_frame=True)
            self._plays = False
