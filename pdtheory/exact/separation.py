"""How far from zero an algebraic number is if it is not zero.

The bound of Burnikel, Funke, Mehlhorn, Schirra and Schmitt (A separation bound for real algebraic
expressions, ESA 2001): write the number as U / L with algebraic integers U and L in a field of
degree D; if u and l bound all conjugates of U and L, then U = 0 or |U / L| >= 1 / (u^(D-1) l).
"""

from __future__ import annotations

from math import ceil, lcm, log2
from typing import Any

import sympy as sp


class _NotCovered(Exception):
    """The expression holds something else than integers, roots and angles that divide a turn."""


def separation_bits(expression: Any) -> int | None:
    """Return b such that the number is 0 or at least 2^-b in size; None if no bound is known.

    Parameters
    ----------
    expression
        An expression of rationals, sums, products, quotients, radicals, roots of polynomials
        (``CRootOf``), i, and cosines, sines, tangents of rational multiples of pi.
    """
    bound = _Bound()
    try:
        u, low = bound.of(expression)
    except _NotCovered:
        return None
    return ceil((bound.degree - 1) * max(u, 0.0) + max(low, 0.0)) + 2


class _Bound:
    """The logarithms of u and l of every subexpression, and the degree of the field."""

    def __init__(self) -> None:
        self.known: dict[Any, tuple[float, float]] = {}
        self.roots: dict[Any, int] = {}
        self.conductor = 1

    @property
    def degree(self) -> int:
        """Bound on the degree of the field that all the numbers lie in."""
        product = int(sp.totient(self.conductor))
        for degree in self.roots.values():
            product *= degree
        return product

    def of(self, node: Any) -> tuple[float, float]:
        if node not in self.known:
            self.known[node] = self._new(node)
        return self.known[node]

    def _new(self, node: Any) -> tuple[float, float]:
        if node.is_Rational:
            return log2(max(1, abs(int(node.p)))), log2(int(node.q))
        if node is sp.I:
            self.conductor = lcm(self.conductor, 4)
            return 0.0, 0.0
        if node.is_Add:
            u, low = self.of(node.args[0])
            for part in node.args[1:]:
                v, other = self.of(part)
                u, low = _log_sum(u + other, low + v), low + other
            return u, low
        if node.is_Mul:
            parts = [self.of(part) for part in node.args]
            return sum(u for u, _ in parts), sum(low for _, low in parts)
        if node.is_Pow and node.exp.is_Rational:
            return self._power(node)
        if isinstance(node, sp.CRootOf):
            coefficients = [abs(int(c)) for c in node.poly.all_coeffs()]
            self.roots[node] = len(coefficients) - 1
            return log2(coefficients[0] + max(coefficients)), log2(coefficients[0])
        if isinstance(node, (sp.cos, sp.sin, sp.tan, sp.exp)):
            return self._turn(node)
        raise _NotCovered

    def _power(self, node: Any) -> tuple[float, float]:
        u, low = self.of(node.base)
        root, power = int(node.exp.q), int(node.exp.p)
        if root > 1:
            self.roots[node.base, root] = root
            u = (u + (root - 1) * low) / root
        if power < 0:
            u, low, power = low, u, -power
        return u * power, low * power

    def _turn(self, node: Any) -> tuple[float, float]:
        unit = sp.I * sp.pi if isinstance(node, sp.exp) else sp.pi
        part = node.args[0] / unit
        if not part.is_Rational:
            raise _NotCovered
        self.conductor = lcm(self.conductor, 4 * int(part.q))
        if isinstance(node, sp.exp):
            return 0.0, 0.0
        # 2 cos and 2 sin are algebraic integers of size at most 2; the tangent is their quotient.
        return (2.0, 2.0) if isinstance(node, sp.tan) else (1.0, 1.0)


def _log_sum(a: float, b: float) -> float:
    """Return log2(2^a + 2^b), rounded up a little."""
    high, low = max(a, b), min(a, b)
    return high + log2(1 + 2 ** max(low - high, -60.0)) + 1e-9
