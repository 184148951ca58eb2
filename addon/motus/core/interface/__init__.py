"""What the artist sees: operators, panels, rows of settings, menus, presets, the overlay."""
