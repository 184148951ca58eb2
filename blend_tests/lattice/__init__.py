"""Tests of lattices."""
