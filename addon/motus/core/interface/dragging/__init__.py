"""Modal operators that drag points and handles in the 3D viewport."""
