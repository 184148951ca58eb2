"""Tests of Follow Path."""
