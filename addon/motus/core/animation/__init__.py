"""F-curves, NLA strips and drivers of a property: what they make of it at any frame."""
