"""Tests of motion drivers."""
