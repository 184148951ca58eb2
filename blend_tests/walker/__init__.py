"""Tests of walkers."""
