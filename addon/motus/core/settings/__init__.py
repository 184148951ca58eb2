"""Settings that the wiring and all systems share: what every system keeps with its owner, lists of entries, and what edits call."""

from .system_settings import ANIMATED, EXTENDABLE, NO_KEYS, OVERRIDABLE, SystemSettings, classes, rewire, touch

__all__ = ("ANIMATED", "EXTENDABLE", "NO_KEYS", "OVERRIDABLE", "SystemSettings", "classes", "rewire", "touch")
