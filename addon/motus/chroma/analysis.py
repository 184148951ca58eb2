"""Measure the green or blue screen in footage: its colour, how well it can be keyed, and warnings."""

from mathutils import Color

from ..core import native
from ..core.refusals import Refused
from ..core.translations import tr
from . import footage

UNEVEN, COLORED, SMALL, SPILLED = 0.6, 0.12, 0.1, 0.15
"""Limits of values in a measurement report; a screen with a value beyond one of the limits gets a warning."""
_MARGIN = 1.25
"""Factor on the clip levels' distances from 0 and 1: frames that were not measured differ from the measured frame."""


def measure(image, color=None, balance=0.0, gain=1.0):
    """Measure the green or blue screen in an image: (colour, report of the native screen_report()).

    color: the screen's colour; None to search for it. Raises Refused if no screen is found, or the colour is neither green nor blue.
    """
    picture = footage.pixels(image)
    found = native.module.screen_color(picture) if color is None else color
    if found is None:
        raise Refused(tr("{object} shows no green or blue screen: pick the colour, if there is one").format(object=image.name))
    check_color(found, balance)
    return tuple(float(part) for part in found), native.module.screen_report(picture, found, balance, gain)


def is_keyable(color, balance=0.0):
    """Whether a colour is green or blue enough to be a screen's colour at a balance."""
    try:
        native.module.screen_matte(_PIXEL, color, balance)
    except ValueError:
        return False
    return True


def check_color(color, balance=0.0):
    """Raise Refused if a colour is not green or blue enough to be a screen's colour at a balance."""
    if is_keyable(color, balance):
        return
    if is_keyable(color, 1.0):
        raise Refused(tr("A screen is green or blue: this colour is as green as it is blue, which takes a Balance above 0"))
    raise Refused(tr("A screen is green or blue: this colour is {hue}").format(hue=_hue(color)))


_PIXEL = (((0.0, 0.0, 0.0, 1.0),),)


def _hue(color):
    """Name, in the language of the user, of the hue of a colour that is neither green nor blue."""
    hue, saturation, _ = Color([min(max(part, 0.0), 1e6) for part in color]).hsv
    if saturation < 0.1:
        return tr("grey or white")
    return tr("yellow") if 1 / 9 < hue < 0.25 else tr("magenta") if 0.7 < hue < 0.95 else tr("red")


def another_color(image, keys):
    """Find the colour of a further screen in the part of an image that no key makes transparent; None if there is no such screen.

    keys: (colour, black level, balance, gain) of each key that the scene has.
    """
    picture = footage.pixels(image)
    for color, black, balance, gain in keys:
        if not is_keyable(color, balance):
            continue  # a key by such a colour makes nothing transparent
        picture[..., 3][native.module.screen_matte(picture, color, balance, gain) <= black + _LEFT] = 0.0
    return native.module.screen_color(picture)


_LEFT = 0.1
"""Pixels whose matte exceeds a key's black level by at most this value count as that key's screen."""


def clip_levels(report):
    """Return clip levels (black, white) that make the measured screen transparent and leave the subject opaque."""
    black = min(_MARGIN * report["black"], 0.9)
    return black, max(1.0 - _MARGIN * (1.0 - report["white"]), black + 0.05)


def sentences(noted):
    """Yield the warnings about the measured screen. noted: settings of the scene that store the measurements."""
    if noted.share < SMALL:
        yield tr("The screen fills only {percent} % of the picture").format(percent=f"{100.0 * noted.share:.0f}")
    if noted.luminance_spread > UNEVEN:
        yield tr("The screen is lit unevenly, by {percent} %: raise Clip Black until the status shows it black").format(
            percent=f"{100.0 * noted.luminance_spread:.0f}"
        )
    if noted.chroma_spread > COLORED:
        yield tr("The screen's colour is not the same everywhere: raise Smooth Color")
    if noted.spill > SPILLED:
        yield tr("The screen shines on the subject, by {percent} %: lower Clip White until the status shows it white").format(
            percent=f"{100.0 * noted.spill:.0f}"
        )
