"""Tests of what the mouse does, without a window."""
