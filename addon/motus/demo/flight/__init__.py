"""Banked Flight, the demo scene of Follow Path."""

from .scene import build

__all__ = ("build",)
