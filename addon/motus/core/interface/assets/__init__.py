"""Presets of the user's own as assets: settings kept with a picture, and given to objects and bones by a menu, a click or a drag."""
