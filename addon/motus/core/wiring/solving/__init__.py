"""What runs while Blender evaluates: the function that solver drivers call, and the solvers behind it."""
