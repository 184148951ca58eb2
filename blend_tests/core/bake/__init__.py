"""Tests of baking."""
