"""Frames on which chains do not come to their targets."""
