"""Repair the wiring of owners after changes that Blender does not report to add-ons."""
