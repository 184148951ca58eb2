"""Passing from one target of a chain to another, by keys or when a number passes a value."""
