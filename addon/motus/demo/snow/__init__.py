"""Winter Village, the demo scene of snow."""

from .scene import build

__all__ = ("build",)
