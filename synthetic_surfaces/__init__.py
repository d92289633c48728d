"""Analytic and piecewise surfaces, exact and sampled."""
