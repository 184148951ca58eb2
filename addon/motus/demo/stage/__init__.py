"""Common parts of all demo scenes: scenes and collections, shapes, materials, lights, cameras and keys."""
