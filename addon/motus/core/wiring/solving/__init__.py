"""Code that runs while Blender evaluates the scene: the function that drivers call, and the solvers that it runs."""
