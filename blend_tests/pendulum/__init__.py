"""Tests of pendulums."""
