"""A spider that is made by a script: an armature with legs that walk, and a mesh on it."""
