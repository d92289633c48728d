"""Trigonometric polynomials made of sines of given angles, multiplied out and merged exactly.

Their coefficients are sums of unit complex numbers exp(-i b) with whole factors, kept by the angle
b: products add angles, and equal angles merge, so that nothing is left to simplify.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from functools import reduce
from operator import mul
from typing import Any

import sympy as sp

from pdtheory.exact.frames import without_hidden_zero

#: The sum of c exp(-i b), as c by b in degrees.
Turns = dict[Any, int]


@dataclass(frozen=True)
class Wave:
    """The trigonometric polynomial sum_n exp(i n theta) sum_b c exp(-i b).

    Attributes
    ----------
    terms : dict
        By frequency n the integers c by angle b in degrees.
    """

    terms: dict[int, Turns]

    @classmethod
    def constant(cls, turns: Turns) -> Wave:
        """Return a wave of frequency 0."""
        return cls({0: turns})

    @classmethod
    def product_of_sines(cls, angles: Iterable[Any]) -> Wave:
        """Return (2 i)^m prod sin(theta - a_j) for m angles in degrees."""
        sines = (cls({1: {a: 1}, -1: {-a: -1}}) for a in angles)
        return reduce(mul, sines, cls.constant({sp.Integer(0): 1}))

    @classmethod
    def cosine(cls, n: int, shift: int = 0) -> Wave:
        """Return 2 cos(n theta - shift), shift in degrees; for n = 0 the constant 1."""
        angle = sp.Integer(shift)
        return cls({n: {angle: 1}, -n: {-angle: 1}})

    def __mul__(self, other: Wave) -> Wave:
        total: dict[int, Turns] = {}
        for n, first in self.terms.items():
            for m, second in other.terms.items():
                turns = total.setdefault(n + m, {})
                for a, c in first.items():
                    for b, d in second.items():
                        _add(turns, a + b, c * d)
        return Wave(total)

    def __sub__(self, other: Wave) -> Wave:
        total = {n: dict(turns) for n, turns in self.terms.items()}
        for n, turns in other.terms.items():
            for b, c in turns.items():
                _add(total.setdefault(n, {}), b, -c)
        return Wave(total)

    def parts(self, n: int, *, turn: int = 0) -> tuple[Any, Any]:
        """Return the parts of one coefficient times exp(-i turn), turn in degrees."""
        turned: Turns = {}
        for b, c in self.terms.get(n, {}).items():
            _add(turned, b + turn, c)
        angles = [(c, sp.pi * b / 180) for b, c in turned.items() if c]
        real = sp.Add(*(c * sp.cos(b) for c, b in angles))
        imaginary = sp.Add(*(-c * sp.sin(b) for c, b in angles))
        return without_hidden_zero(real), without_hidden_zero(imaginary)


def _add(turns: Turns, angle: Any, factor: int) -> None:
    # Whole turns are taken off rational angles alone: other numbers merge as they are written.
    b = angle % 360 if angle.is_Rational else angle
    turns[b] = turns.get(b, 0) + factor
