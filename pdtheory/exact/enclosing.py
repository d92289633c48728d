"""Enclosures of exact constants: any expression without symbols, to any precision.

The expression is evaluated once in Arb's complex balls, which is proved. A function that Arb does
not know has no enclosure.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from functools import lru_cache
from math import floor, log10
from typing import Any, Final

import sympy as sp

from pdtheory.errors import ComputationError
from pdtheory.exact.balls import engine, real_roots
from pdtheory.exact.coefficients import as_fraction
from pdtheory.exact.intervals import Enclosure, Rectangle
from pdtheory.exact.realnumber import bits_for, precisions

#: Functions by their names in Arb; the principal branches of both libraries agree.
_ARB: Final = {
    sp.exp: "exp",
    sp.log: "log",
    sp.sin: "sin",
    sp.cos: "cos",
    sp.tan: "tan",
    sp.cot: "cot",
    sp.asin: "asin",
    sp.acos: "acos",
    sp.atan: "atan",
    sp.sinh: "sinh",
    sp.cosh: "cosh",
    sp.tanh: "tanh",
    sp.coth: "coth",
    sp.asinh: "asinh",
    sp.acosh: "acosh",
    sp.atanh: "atanh",
    sp.sec: "sec",
    sp.csc: "csc",
    sp.sech: "sech",
    sp.csch: "csch",
    sp.sinc: "sinc",
    sp.erf: "erf",
    sp.erfc: "erfc",
    sp.erfi: "erfi",
    sp.gamma: "gamma",
    sp.LambertW: "lambertw",
    sp.zeta: "zeta",
    sp.Abs: "__abs__",
}
#: Functions whose first argument is their order.
_ARB_BY_ORDER: Final = {
    sp.besselj: "bessel_j",
    sp.bessely: "bessel_y",
    sp.besseli: "bessel_i",
    sp.besselk: "bessel_k",
}


def enclose(expression: Any, bits: int) -> Rectangle | None:
    """Return a rectangle that holds a constant, None if no finite one is found at this precision.

    Parameters
    ----------
    expression
        A SymPy expression without free symbols.
    bits
        Working precision in bits.
    """
    here = engine()
    with here.precision(bits):
        ball = _Arb(bits).ball(expression)
        if ball is None or not ball.is_finite():
            return None
        return here.rectangle(ball)


def enclose_real(expression: Any, bits: int) -> Enclosure:
    """Return an enclosure of a real constant, computed with a working precision in bits.

    Raises
    ------
    ComputationError
        If none is found.
    """
    if expression.is_Rational:
        value = as_fraction(expression)
        return Enclosure(value, value)
    found = enclose(expression, bits)
    if found is None:
        raise ComputationError(f"The number {expression} could not be enclosed with {bits} bits.")
    return found.real


def real_balls(expressions: Sequence[Any], bits: int) -> list[Any]:
    """Return balls for several real constants, their common subexpressions evaluated once.

    Raises
    ------
    ComputationError
        If one of them cannot be enclosed.
    """
    with engine().precision(bits):
        evaluation = _Arb(bits)
        found = [evaluation.ball(e) for e in expressions]
        for e, ball in zip(expressions, found, strict=True):
            if ball is None or not ball.is_finite():
                raise ComputationError(f"The number {e} could not be enclosed with {bits} bits.")
        return [ball.real for ball in found]


def is_finite(expression: Any) -> bool:
    """Return whether a constant is proved to have a finite value, without a division by zero."""
    return expression.is_Rational or any(enclose(expression, b) for b in (64, 512, 4096))


class _Arb:
    """One evaluation in complex balls, every subexpression once."""

    def __init__(self, bits: int) -> None:
        self.flint = engine().library
        self.bits = bits
        self.known: dict[Any, Any] = {}

    def ball(self, node: Any) -> Any:
        if node not in self.known:
            self.known[node] = self._new(node)
        return self.known[node]

    def _new(self, node: Any) -> Any:
        acb = self.flint.acb
        if node.is_Rational:
            return acb(self.flint.fmpq(int(node.p), int(node.q)))
        if node is sp.I:
            return acb(0, 1)
        if node is sp.pi:
            return acb(self.flint.arb.pi())
        if node is sp.E:
            return acb(1).exp()
        if node is sp.EulerGamma:
            return acb(self.flint.arb.const_euler())
        if node is sp.Catalan:
            return acb(self.flint.arb.const_catalan())
        if node is sp.GoldenRatio:
            return (1 + acb(5).sqrt()) / 2
        if hasattr(node, "definition"):
            return _named_ball(node, self.bits)
        if hasattr(node, "enclosure_at"):
            return acb(engine().interval(node.enclosure_at(self.bits)))
        if isinstance(node, sp.CRootOf):
            return self._root(node)
        parts = [self.ball(a) for a in node.args]
        if not parts or any(p is None for p in parts):
            return None
        if node.is_Add or node.is_Mul:
            total = parts[0]
            for part in parts[1:]:
                total = total + part if node.is_Add else total * part
            return total
        if node.is_Pow:
            return self._power(node, *parts)
        if len(parts) == 2 and node.func in _ARB_BY_ORDER:
            return getattr(parts[1], _ARB_BY_ORDER[node.func])(parts[0])
        name = _ARB.get(node.func)
        return acb(getattr(parts[0], name)()) if name and len(parts) == 1 else None

    def _root(self, node: Any) -> Any:
        """Return a real root of an integer polynomial; SymPy numbers the real ones first."""
        coefficients = node.poly.all_coeffs()[::-1]
        if not all(c.is_Integer for c in coefficients):
            return None
        found = real_roots(tuple(int(c) for c in coefficients), self.bits)
        if node.index >= len(found):
            return None
        return self.flint.acb(engine().interval(found[node.index]))

    def _power(self, node: Any, base: Any, exponent: Any) -> Any:
        if node.exp.is_Integer:
            return base ** int(node.exp)
        if node.exp.is_Rational and node.exp.q == 2:
            return base.sqrt() ** int(node.exp.p)
        return base**exponent


# Many coefficients of one jet are made of the same named constants.
@lru_cache(maxsize=1024)
def _named_ball(node: Any, bits: int) -> Any:
    return _Arb(bits).ball(node.definition)


def nearest_double(value: Any) -> float:
    """Return a real constant in double precision, rounded correctly unless it is near a tie.

    Raises
    ------
    ComputationError
        If the number cannot be enclosed.
    """
    if value.is_Rational:
        return int(value.p) / int(value.q)
    for bits in (128, 512, 2048):
        found = enclose_real(value, bits)
        lower, upper = float(found.lower), float(found.upper)
        if lower == upper or (found.sign and found.width * 2**60 < abs(found.middle)):
            return float(found.middle)
    # Nothing but zero is as small as this in a table of doubles.
    return float(found.middle) if found.sign else 0.0


def rounded(value: Any, digits: int) -> Any:
    """Return a real constant that is not zero, rounded to a number of significant digits.

    The error is below one unit of the last digit; a rational number is returned as it is.

    Raises
    ------
    ComputationError
        If the number cannot be enclosed.
    """
    if value.is_Rational:
        return value
    for bits in precisions(bits_for(digits)):
        found = enclose_real(value, bits)
        if found.sign and found.width * 10 ** (digits + 1) <= abs(found.middle):
            middle = found.middle
            # 10^places times the number has at least `digits` digits before the point.
            size = middle.numerator.bit_length() - middle.denominator.bit_length()
            places = digits - floor((size - 1) * log10(2))
            scaled = round(middle * Fraction(10) ** places)
            return sp.Rational(scaled) / sp.Integer(10) ** places
    raise AssertionError("unreachable")
