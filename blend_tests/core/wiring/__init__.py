"""Tests of the wiring, mostly with the toy systems."""
