"""Hubs, the hidden mesh objects that carry a solver's driver and its array of results: which owner has which hubs, and their layout."""
