"""Reads and writes the pulled mesh in each mode of the object."""
