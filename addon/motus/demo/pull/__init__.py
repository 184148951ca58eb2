"""Pulled from Clay, the demo scene of Pick & Pull."""

from .scene import build

__all__ = ("build",)
