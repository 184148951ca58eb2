"""Reason why the value of a property or transform is unknown at frames other than the present one, as a sentence for the artist."""

from __future__ import annotations

from ..translations import tr


class Reason:
    """Reason why a value is unknown at other frames: one of the kinds below.

    names: the names of objects, bones, constraints or data paths that the kind's sentence contains.
    """

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
