"""Tests of what lies in addon/motus/core/animation."""
