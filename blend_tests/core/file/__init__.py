"""Tests of what guards against files of somebody else's."""
