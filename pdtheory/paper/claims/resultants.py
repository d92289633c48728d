"""Resultants of binary forms: those of single random forms, and those of generic lines."""

from __future__ import annotations

import random
from collections.abc import Sequence
from typing import Any

import flint
import sympy as sp

from pdtheory.paper.claims.sturm import critical


def line_resultant(a: Sequence[Any], b: Sequence[Any]) -> Any:
    """Return the resultant of the lines a[0] x + a[1] y and b[0] x + b[1] y."""
    return a[0] * b[1] - a[1] * b[0]


def conic_pullback(line: Sequence[Any]) -> tuple[Any, Any, Any]:
    """Return the coefficients of s^2, s t, t^2 of a line on x^2 + y^2 = x_0^2.

    The conic is parametrised by x = t^2 - s^2, y = 2 s t, x_0 = s^2 + t^2.
    """
    a, b, c = line
    return c - a, 2 * b, c + a


def quadratic_resultant(p: Sequence[Any], q: Sequence[Any]) -> Any:
    """Return the resultant of two quadratic forms: the determinant of Sylvester, unevaluated."""
    return sp.Determinant(sp.Matrix(4, 4, [*p, 0, 0, *p, *q, 0, 0, *q]))


def resultant(a: Any, b: Any) -> Any:
    """Return the resultant of two polynomials over the rationals."""
    scale = flint.fmpq(a.denom()) ** b.degree() * flint.fmpq(b.denom()) ** a.degree()
    return flint.fmpq(a.numer().resultant(b.numer())) / scale


def on_isotropic(p: Any) -> Any:
    """Return |f(1, i)|^2."""
    powers = (1, 1, -1, -1)  # of i, apart from the factor i of the odd ones
    parts = [flint.fmpq(0), flint.fmpq(0)]
    for j, c in enumerate(p.coeffs()):
        parts[j % 2] += powers[j % 4] * c
    return parts[0] ** 2 + parts[1] ** 2


def psi_value(order: int, p: Any, value: Any) -> Any:
    """Return psi(value) from Qi's definition, up to a constant that depends on the order only.

    Even order: the resultant of the two components of T v^(k-1) - lambda (v.v)^((k-2)/2) v. Odd
    order: of T v^(k-1) - lambda x_0^(k-2) v on the conic v.v = x_0^2, with its parametrisation
    x = 1 - s^2, y = 2 s, x_0 = 1 + s^2.
    """
    s = flint.fmpq_poly([0, 1])
    square = flint.fmpq_poly([1, 0, 1])
    slope = p.derivative()
    t_x, t_y = (order * p - s * slope) / order, slope / order
    if order % 2 == 0:
        power = value * square ** ((order - 2) // 2)
        return resultant(t_x - power, t_y - power * s)
    across, along = flint.fmpq_poly([1, 0, -1]), flint.fmpq_poly([0, 2])

    def on_conic(form: Any) -> Any:
        return sum(
            (c * across ** (order - 1 - j) * along**j for j, c in enumerate(form.coeffs())),
            flint.fmpq_poly(),
        )

    power = value * square ** (order - 2)
    return resultant(on_conic(t_x) - power * across, on_conic(t_y) - power * along)


def reduced_value(order: int, p: Any, value: Any) -> Any:
    """Return Res(F/k, f - lambda q^(k/2)), or Res(F/k, f^2 - lambda^2 q^k) for odd order."""
    F = critical(order, p) / order
    square = flint.fmpq_poly([1, 0, 1])
    if order % 2 == 0:
        return resultant(F, p - value * square ** (order // 2))
    return resultant(F, p * p - value * value * square**order)


def random_form(order: int, generator: random.Random) -> Any:
    """Return f(1, t) with random integer coefficients, none of them zero."""
    digits = [j for j in range(-9, 10) if j]
    return flint.fmpq_poly([generator.choice(digits) for _ in range(order + 1)])
