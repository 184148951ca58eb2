"""Sizes of named screens, and a rig's screen as keyword arguments of the native functions."""

import math

ITEMS = (
    ('PHONE', "Phone", "14 cm wide, seen from 30 cm"),
    ('MONITOR', "Monitor", "60 cm wide, seen from 70 cm"),
    ('TELEVISION', "Television", "1.2 m wide, seen from 2.5 m"),
    ('CINEMA', "Cinema", "12 m wide, seen from 15 m"),
    ('DOME', "Dome", "18 m wide, seen from 9 m"),
    ('CUSTOM', "Custom", "Custom width and viewing distance"),
)
SIZES = {'PHONE': (0.14, 0.3), 'MONITOR': (0.6, 0.7), 'TELEVISION': (1.2, 2.5), 'CINEMA': (12.0, 15.0), 'DOME': (18.0, 9.0)}
"""(Width, viewing distance) of each named screen, in metres."""


def of(settings):
    """Return the screen of a rig's settings as keyword arguments of the native functions: width, viewing distance, eye separation (m)."""
    width, distance = SIZES.get(settings.screen, (settings.screen_width, settings.screen_distance))
    return {"width": width, "viewing_distance": distance, "eye_separation": settings.eye_separation}


def is_sound(screen):
    """Whether all lengths of a screen, from of(), are finite and greater than 0."""
    return all(math.isfinite(value) and value > 0.0 for value in screen.values())
