"""Drag a chain of bones by any point on one of its bones."""
