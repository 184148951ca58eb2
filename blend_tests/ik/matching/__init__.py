"""Tests of matching controls and poses."""
