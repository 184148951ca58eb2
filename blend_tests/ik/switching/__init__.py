"""Tests of switching targets."""
