"""Settings that all systems share: the base of their property groups, lists of entries, and callbacks for edits."""

from .system_settings import ANIMATED, EXTENDABLE, NO_KEYS, OVERRIDABLE, SystemSettings, classes, rewire, touch

__all__ = ("ANIMATED", "EXTENDABLE", "NO_KEYS", "OVERRIDABLE", "SystemSettings", "classes", "rewire", "touch")
