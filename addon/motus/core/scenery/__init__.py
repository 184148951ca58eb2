"""Meshes of a scene that solvers read: their faces, the world matrices of their instances, and whether they move over time."""
