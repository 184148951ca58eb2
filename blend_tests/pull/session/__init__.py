"""Tests of sessions of pulls."""
