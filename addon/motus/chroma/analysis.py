"""The screen of a footage: its colour, how well it keys, and what is said of that."""

from mathutils import Color

from ..core import native
from ..core.refusals import Refused
from ..core.translations import tr
from . import footage

UNEVEN, COLORED, SMALL, SPILLED = 0.6, 0.12, 0.1, 0.15
"""Numbers of a report beyond which a screen is warned of."""
_MARGIN = 1.25
"""How much farther the clip levels go than the measured ones, of which there are none on an even screen: other frames differ."""


def measure(image, color=None, balance=0.0, gain=1.0):
    """(colour, report) of an image's screen, by a colour that is given or its own. Raises Refused."""
    picture = footage.pixels(image)
    found = native.module.screen_color(picture) if color is None else color
    if found is None:
        raise Refused(tr("{object} shows no green or blue screen: pick the colour, if there is one").format(object=image.name))
    check_color(found)
    return tuple(float(part) for part in found), native.module.screen_report(picture, found, balance, gain)


def is_keyable(color):
    """Whether a colour is a screen's, green or blue."""
    try:
        native.module.screen_matte(_PIXEL, color)
    except ValueError:
        return False
    return True


def check_color(color):
    """Refuse a colour that is no screen's."""
    if not is_keyable(color):
        raise Refused(tr("A screen is green or blue: this colour is {hue}").format(hue=_hue(color)))


_PIXEL = (((0.0, 0.0, 0.0, 1.0),),)


def _hue(color):
    """What a colour that is neither green nor blue is called."""
    hue, saturation, _ = Color([min(max(part, 0.0), 1e6) for part in color]).hsv
    if saturation < 0.1:
        return tr("grey or white")
    return tr("yellow") if 1 / 9 < hue < 0.25 else tr("magenta") if 0.7 < hue < 0.95 else tr("red")


def another_color(image, keys):
    """The colour of a screen in what keys leave of an image; None without. keys: (colour, black, balance, gain) of each."""
    picture = footage.pixels(image)
    for color, black, balance, gain in keys:
        picture[..., 3][native.module.screen_matte(picture, color, balance, gain) <= black + _LEFT] = 0.0
    return native.module.screen_color(picture)


_LEFT = 0.1
"""Mattes up to so far above a key's clip black are of its own screen."""


def clip_levels(report):
    """(black, white) that clear the screen and leave the subject opaque."""
    black = min(_MARGIN * report["black"], 0.9)
    return black, max(1.0 - _MARGIN * (1.0 - report["white"]), black + 0.05)


def sentences(noted):
    """Warnings on the screen that was measured. noted: settings of the scene."""
    if noted.share < SMALL:
        yield tr("The screen fills only {percent} % of the picture").format(percent=f"{100.0 * noted.share:.0f}")
    if noted.luminance_spread > UNEVEN:
        yield tr("The screen is lit unevenly, by {percent} %: raise Clip Black until the status shows it black").format(
            percent=f"{100.0 * noted.luminance_spread:.0f}")
    if noted.chroma_spread > COLORED:
        yield tr("The screen's colour is not the same everywhere: raise Smooth Color")
    if noted.spill > SPILLED:
        yield tr("The screen shines on the subject, by {percent} %: lower Clip White until the status shows it white").format(
            percent=f"{100.0 * noted.spill:.0f}")
