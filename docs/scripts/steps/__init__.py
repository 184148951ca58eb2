"""The manual's steps, done in a Blender with a window by mouse and keys, each with a picture. `python3 docs/steps.py` runs them."""
