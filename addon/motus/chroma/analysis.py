"""The screen of a footage: its colour, how well it keys, and what is said of that."""

from ..core import native
from ..core.refusals import Refused
from ..core.translations import tr
from . import footage

UNEVEN, COLORED, SMALL, SPILLED = 0.6, 0.12, 0.1, 0.15
"""Numbers of a report beyond which a screen is warned of."""
_MARGIN = 0.02
"""By how much the clip levels lie beyond the measured ones: other frames differ."""


def measure(image, color=None):
    """(colour, report) of an image's screen, by a colour that is given or its own. Raises Refused."""
    picture = footage.pixels(image)
    found = native.module.screen_color(picture) if color is None else color
    if found is None:
        raise Refused(tr("{object} shows no green or blue screen: pick the colour, if there is one").format(object=image.name))
    try:
        return tuple(float(part) for part in found), native.module.screen_report(picture, found)
    except ValueError as error:
        raise Refused(tr("A screen is green or blue: the colour has neither above its other channels")) from error


def clip_levels(report):
    """(black, white) for the node Keying."""
    black = min(report["black"] + _MARGIN, 0.9)
    return black, max(report["white"] - _MARGIN, black + 0.05)


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
