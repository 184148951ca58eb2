"""Least-squares anaglyphs.

Dubois, "A projection method to generate anaglyph stereo images" (2001); matrices for further glasses, rounded as Dubois has published
them with "Conversion of a Stereo Pair to Anaglyph with the Least-Squares Projection Method" (2009).
"""

from ..core.lazy import numpy as np

GLASSES = (
    ('RED_CYAN', "Red-Cyan", "Red for the left eye, cyan for the right one"),
    ('GREEN_MAGENTA', "Green-Magenta", "Green for the left eye, magenta for the right one"),
    ('YELLOW_BLUE', "Amber-Blue", "Amber or yellow for the left eye, blue for the right one"),
)
MATRICES = {
    'RED_CYAN': (
        ((0.456, 0.500, 0.176), (-0.040, -0.038, -0.016), (-0.015, -0.021, -0.005)),
        ((-0.043, -0.088, -0.002), (0.378, 0.734, -0.018), (-0.072, -0.113, 1.226)),
    ),
    'GREEN_MAGENTA': (
        ((-0.062, -0.158, -0.039), (0.284, 0.668, 0.143), (-0.015, -0.027, 0.021)),
        ((0.529, 0.705, 0.024), (-0.016, -0.015, -0.065), (0.009, 0.075, 0.937)),
    ),
    'YELLOW_BLUE': (
        ((1.062, -0.205, 0.299), (-0.026, 0.908, 0.068), (-0.038, -0.173, 0.022)),
        ((-0.016, -0.123, -0.017), (0.006, 0.062, -0.017), (0.094, 0.185, 0.911)),
    ),
}
"""What the left and the right eye's linear red, green and blue add to those of the anaglyph, by glasses."""


def combined(left, right, glasses):
    """Anaglyph of two pictures, (..., 3) linear red, green and blue, each clipped to [0, 1]. glasses: one of MATRICES."""
    first, second = (np.array(matrix) for matrix in MATRICES[glasses])
    return np.clip(left @ first.T + right @ second.T, 0.0, 1.0)
