"""Tests of stereo rigs."""
