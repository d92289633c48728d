"""Polynomials that vanish at values of forms: characteristic polynomials in quotient algebras."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from typing import Any

import sympy as sp
from sympy.polys.matrices import DomainMatrix

from pdtheory.exact.algebraic import primitive
from pdtheory.exact.coefficients import as_fraction
from pdtheory.exact.engines import Integers


def value_polynomial(
    coefficients: Sequence[Sequence[Fraction]], generator: Integers, tangent: Integers
) -> Integers:
    """Return an integer polynomial with the root lambda = f(1, t) / (1 + t^2)^(k/2).

    It is the characteristic polynomial of the multiplication by lambda (k even) or by lambda^2
    (k odd, then written in lambda) on the algebra Q[a, t] / (generator(a), tangent(t)).

    Parameters
    ----------
    coefficients
        The k + 1 coefficients of f, each a polynomial in the generator a, constant term first.
    generator
        Minimal polynomial of a.
    tangent
        Minimal polynomial of t; it must not be 1 + t^2.
    """
    order = len(coefficients) - 1
    a, t = _companion(generator), _companion(tangent)
    one = DomainMatrix.eye(len(tangent) - 1, sp.QQ).to_dense()
    unit = DomainMatrix.eye(len(generator) - 1, sp.QQ).to_dense()
    t_both = _kron(unit, t)
    value = _kron(unit, one) * sp.QQ(0)
    for c in reversed(coefficients):
        value = value * t_both + _kron(_at_matrix(c, a), one)
    square = _kron(unit, one + t * t)
    if order % 2 == 0:
        return _charpoly(value * (square ** (order // 2)).inv())
    in_square = _charpoly(value * value * (square**order).inv())
    return tuple(e for c in in_square for e in (c, 0))[:-1]


def cosine_squared_polynomial(tangent: Integers) -> Integers:
    """Return an integer polynomial with the root cos(theta)^2 = 1 / (1 + t^2)."""
    t = _companion(tangent)
    one = DomainMatrix.eye(len(tangent) - 1, sp.QQ).to_dense()
    return _charpoly((one + t * t).inv())


def _charpoly(matrix: DomainMatrix) -> Integers:
    descending = matrix.charpoly()
    return primitive([as_fraction(c) for c in descending[::-1]])


def _dense(rows: list[list[Any]]) -> DomainMatrix:
    return DomainMatrix(rows, (len(rows), len(rows)), sp.QQ).to_dense()


def _companion(polynomial: Integers) -> DomainMatrix:
    """Return the matrix of multiplication by the root."""
    size, lead = len(polynomial) - 1, polynomial[-1]
    rows = [[sp.QQ(int(i == j + 1)) for j in range(size)] for i in range(size)]
    for i in range(size):
        rows[i][-1] += sp.QQ(-polynomial[i], lead)
    return _dense(rows)


def _at_matrix(polynomial: Sequence[Fraction], matrix: DomainMatrix) -> DomainMatrix:
    """Evaluate a rational polynomial, constant term first, at a matrix."""
    one = DomainMatrix.eye(matrix.shape[0], sp.QQ).to_dense()
    value = one * sp.QQ(0)
    for c in reversed(polynomial):
        value = value * matrix + one * sp.QQ(c.numerator, c.denominator)
    return value


def _kron(a: DomainMatrix, b: DomainMatrix) -> DomainMatrix:
    left, right = a.to_list(), b.to_list()
    return _dense([[x * y for x in row_a for y in row_b] for row_a in left for row_b in right])
