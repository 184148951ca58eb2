"""Walk on a Small Planet, the demo scene of animation layers."""

from .scene import build

__all__ = ("build",)
