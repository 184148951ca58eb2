"""Why something over time is not known ahead, in a sentence for the artist."""

from __future__ import annotations

from ..translations import tr


class Reason:
    """One of the kinds below, with the names that its sentence has."""

    CONSTRAINED, DRIVEN, SOLVED_BONE, PHYSICS, VERTICES, ALONG_CURVE, STRIPS, MODE, INFLUENCE, GEOMETRY, LOOP = range(11)

    def __init__(self, kind: int, **names: str) -> None:
        self.kind, self._names = kind, names

    @property
    def sentence(self) -> str:
        """The reason as a sentence in the user's language."""
        return _SENTENCES[self.kind]().format(**self._names)


# Functions, since the language may change while Blender runs.
_SENTENCES = {
    Reason.CONSTRAINED: lambda: tr("{thing} has the constraint {name}"),
    Reason.DRIVEN: lambda: tr("a driver on {thing} sets {path}"),
    Reason.SOLVED_BONE: lambda: tr("the constraint {name} of {bone} turns {thing}"),
    Reason.PHYSICS: lambda: tr("{thing} is a rigid body"),
    Reason.VERTICES: lambda: tr("{thing} hangs on vertices of {name}"),
    Reason.ALONG_CURVE: lambda: tr("{thing} is led along the curve {name}"),
    Reason.STRIPS: lambda: tr("NLA strips of {thing} are mixed in a way that is not known ahead"),
    Reason.INFLUENCE: lambda: tr("{name} drives {thing} by a part alone: its influence is not always 1"),
    Reason.GEOMETRY: lambda: tr("the shape of {name} changes, on which {thing} goes"),
    Reason.LOOP: lambda: tr("{thing} hangs on itself"),
    Reason.MODE: lambda: tr("{thing} changes its rotation mode"),
}
