"""Winter Flight, the demo scene in which eight systems of the add-on act together."""

from .scene import build

__all__ = ("build",)
