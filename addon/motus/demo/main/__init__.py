"""Winter Flight, the demo scene in which eight systems act together."""

from .scene import build

__all__ = ("build",)
