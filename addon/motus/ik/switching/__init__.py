"""Pass a chain from one target to a different one: over frames by keys, or by a driver when a number passes a value."""
