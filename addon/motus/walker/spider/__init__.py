"""Spider: an operator makes an armature whose legs walk, and a mesh that the armature deforms."""
