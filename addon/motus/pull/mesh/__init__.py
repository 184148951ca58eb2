"""Reading and writing the mesh that is pulled, in each mode of the object."""
