"""Points and handles that are dragged in the 3D viewport."""
