"""Operators that work with any system: Bake, Refresh, Copy Settings and the like."""
