"""The machinery all systems share; it never imports a system."""
