"""Stereo Colonnade, the demo scene of stereo cameras."""

from .scene import build

__all__ = ("build",)
