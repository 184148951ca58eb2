"""What brings results to objects, bones, properties and geometry: constraints, drivers, modifiers."""
