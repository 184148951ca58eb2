"""Keyed Pilot, the demo scene of the chroma key."""

from .scene import build

__all__ = ("build",)
