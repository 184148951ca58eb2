"""What every demo scene is staged with: scenes and collections, shapes, materials, lamps, cameras and keys."""
