"""Tests of the chroma key."""
