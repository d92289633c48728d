"""Estimation of directions on point sets."""
