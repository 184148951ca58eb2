"""Tests of what all systems keep with their owners."""
