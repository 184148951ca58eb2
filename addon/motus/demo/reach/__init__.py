"""Reaching Pilot, the demo scene of inverse kinematics and Look At."""

from .scene import build

__all__ = ("build",)
