"""Tests of Pick & Pull."""
