"""Read and write the positions of the mesh that is pulled, in Object, Edit and Sculpt Mode."""
