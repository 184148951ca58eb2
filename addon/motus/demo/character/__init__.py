"""The wooden pilot of the demo scenes: skeleton, figure and clips of animation."""
