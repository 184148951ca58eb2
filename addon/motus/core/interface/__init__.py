"""User interface that all systems share: operators, panels, rows of settings, menus, presets, and the viewport overlay."""
