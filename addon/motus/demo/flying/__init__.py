"""The aeroplane of the demo scenes, and the course that it flies."""
