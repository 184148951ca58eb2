"""Tests of Look At."""
