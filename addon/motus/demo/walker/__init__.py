"""Spiders on the Wall, the demo scene of walkers."""

from .scene import build

__all__ = ("build",)
