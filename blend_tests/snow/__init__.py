"""Tests of snow."""
