"""Windy Bridge, the demo scene of chains."""

from .scene import build

__all__ = ("build",)
