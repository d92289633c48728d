"""Helpers for tests of pdtheory; they need the development dependencies.

``pytest --pyargs pdtheory.testing`` runs the properties that every form and every field of
directions must have; ``HYPOTHESIS_PROFILE=ci`` tries many examples instead of few. The strategies
that draw the forms are in :mod:`pdtheory.testing.strategies`.
"""
