"""Fan of Chaos, the demo scene of double pendulums."""

from .scene import build

__all__ = ("build",)
