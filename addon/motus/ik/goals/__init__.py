"""Targets and poles of chains: read where they are, move them, make new ones, and remove them."""
