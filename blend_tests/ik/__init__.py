"""Tests of inverse kinematics."""
