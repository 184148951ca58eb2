"""Sinks: the constraints, drivers and modifiers that bring solvers' results to objects, bones, properties and geometry."""
