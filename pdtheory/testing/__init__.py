"""Helpers for tests of pdtheory; they need the development dependencies."""
