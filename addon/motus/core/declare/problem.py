"""What a solver says when something keeps it from working."""

from dataclasses import dataclass, field


@dataclass(frozen=True)
class Problem:
    """A sentence for the artist. A blocking one leaves the driven objects at their own transforms.

    about: what it is about now, such as the name of a setting, for a system that says more than the declared sentence.
    """

    sentence: str
    blocking: bool = True
    about: str = field(default="", compare=False)


OK = None
"""What solve() returns when all is well."""
