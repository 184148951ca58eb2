"""Tests of what every system shares."""
