"""Hopping Creature, the demo scene of object dynamics."""

from .scene import build

__all__ = ("build",)
