"""Problem: the sentence that a solver returns if something keeps it from working."""

from dataclasses import dataclass, field


@dataclass(frozen=True)
class Problem:
    """A sentence that the panel shows to the artist.

    blocking: whether the driven objects stay at their own transforms. about: subject of this very problem, such as the name of a
    setting, for a system whose panel says more than the declared sentence.
    """

    sentence: str
    blocking: bool = True
    about: str = field(default="", compare=False)


OK = None
"""Return value of solve() if there is no problem."""
