"""Matching controls to the pose, and the pose to the solution, over a range of frames."""
