"""Meshes of a scene that solvers read: their faces, where they are seen, and whether they stand still."""
