"""Wires owners again after changes that Blender does not report to add-ons."""
