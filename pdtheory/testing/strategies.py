"""Hypothesis strategies for binary forms: the easy ones and the treacherous ones."""

from __future__ import annotations

from fractions import Fraction
from typing import Any

import sympy as sp
from hypothesis import strategies as st

from pdtheory.exact import BinaryForm

#: Small integers: they make coincidences such as common factors likely.
small_integers = st.integers(-9, 9)


@st.composite
def rationals(draw: st.DrawFn, *, extreme: bool = False) -> Any:
    """Draw a SymPy rational; with `extreme`, scaled by up to 10^+-40."""
    value = draw(st.fractions(max_denominator=30, min_value=-30, max_value=30))
    power = draw(st.integers(-40, 40)) if extreme else 0
    scaled = value * Fraction(10) ** power
    return sp.Rational(scaled.numerator, scaled.denominator)


@st.composite
def forms(
    draw: st.DrawFn, *, min_order: int = 1, max_order: int = 24, extreme: bool = False
) -> BinaryForm:
    """Draw a binary form with rational coefficients, of any order between the bounds.

    About a third have zero leading or trailing coefficients, so that directions at 0 or 90
    degrees occur; the zero form is possible.
    """
    order = draw(st.integers(min_order, max_order))
    one = rationals(extreme=True) if extreme else small_integers
    coefficients = draw(st.lists(one, min_size=order + 1, max_size=order + 1))
    for end in draw(st.sampled_from([(), (), (0,), (-1,), (0, 1), (-1, -2)])):
        if -len(coefficients) <= end < len(coefficients):
            coefficients[end] = 0
    return BinaryForm(coefficients)


@st.composite
def forms_with_repeated_roots(draw: st.DrawFn, *, max_order: int = 24) -> BinaryForm:
    """Draw a product of powers of linear forms: double directions and vanishing eigenvalues."""
    coefficients = [1]
    while len(coefficients) - 1 < max_order:
        a, b = draw(st.integers(-4, 4)), draw(st.integers(-4, 4))
        if (a, b) == (0, 0):
            break
        power = draw(st.integers(1, 4))
        for _ in range(min(power, max_order + 1 - len(coefficients))):
            coefficients = [
                a * p + b * q for p, q in zip([*coefficients, 0], [0, *coefficients], strict=True)
            ]
    return BinaryForm(coefficients if len(coefficients) > 1 else [1, 0])


def any_forms(max_order: int = 24) -> st.SearchStrategy[BinaryForm]:
    """Draw from all strategies for forms of this module."""
    return st.one_of(
        forms(max_order=max_order),
        forms(max_order=max_order, extreme=True),
        forms_with_repeated_roots(max_order=max_order),
    )
