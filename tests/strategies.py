"""The hypothesis strategies of the tests."""

from pdtheory.testing.strategies import (
    any_forms,
    forms,
    forms_with_repeated_roots,
    rationals,
    small_integers,
)

__all__ = ["any_forms", "forms", "forms_with_repeated_roots", "rationals", "small_integers"]
