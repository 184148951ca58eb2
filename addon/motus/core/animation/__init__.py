"""Animation of a property by F-curves, NLA strips and drivers: the values that result at any frame."""
