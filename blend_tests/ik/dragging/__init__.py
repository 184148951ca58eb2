"""Tests of dragging chains."""
