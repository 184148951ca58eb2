"""Tests of checking chains over a range."""
