"""Enclosures of exact constants: any expression without symbols, to any precision.

python-flint evaluates the expression once in Arb's complex balls, which is proved. Without it, and
for functions that Arb does not know, SymPy's evaluation to a given accuracy takes its place.
"""

from __future__ import annotations

from fractions import Fraction
from functools import lru_cache
from math import floor, log10
from typing import Any, Final

import sympy as sp
from sympy.core.evalf import PrecisionExhausted

from pdtheory.errors import ComputationError
from pdtheory.exact.algebraic import bits_for, precisions
from pdtheory.exact.balls import engine
from pdtheory.exact.engines import FlintEngine
from pdtheory.exact.intervals import Enclosure, Rectangle

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
    sp.erf: "erf",
    sp.erfc: "erfc",
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
    if not isinstance(here, FlintEngine):
        return _by_evaluation(expression, bits)
    with here.precision(bits):
        ball = _Arb(here, bits).ball(expression)
        if ball is None or not ball.is_finite():
            return None
        return Rectangle(here.enclosure(ball.real), here.enclosure(ball.imag))


def enclose_real(expression: Any, bits: int) -> Enclosure:
    """Return an enclosure of a real constant, computed with a working precision in bits.

    Raises
    ------
    ComputationError
        If none is found.
    """
    if expression.is_Rational:
        value = Fraction(int(expression.p), int(expression.q))
        return Enclosure(value, value)
    found = enclose(expression, bits)
    if found is None:
        raise ComputationError(f"The number {expression} could not be enclosed with {bits} bits.")
    return found.real


def is_finite(expression: Any) -> bool:
    """Return whether a constant is proved to have a finite value, without a division by zero."""
    return expression.is_Rational or any(enclose(expression, b) for b in (64, 512, 4096))


class _Arb:
    """One evaluation in complex balls, every subexpression once."""

    def __init__(self, flint_engine: FlintEngine, bits: int) -> None:
        self.flint = flint_engine.library
        self.engine = flint_engine
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
        definition = getattr(node, "definition", None)
        if definition is not None:
            return _named_ball(node, self.bits)
        parts = [self.ball(a) for a in node.args] if node.args else []
        if not parts or any(p is None for p in parts):
            return self._evaluated(node)
        if node.is_Add or node.is_Mul:
            total = parts[0]
            for part in parts[1:]:
                total = total + part if node.is_Add else total * part
            return total
        if node.is_Pow:
            return self._power(node, *parts)
        name = _ARB.get(node.func)
        return getattr(parts[0], name)() if name and len(parts) == 1 else self._evaluated(node)

    def _power(self, node: Any, base: Any, exponent: Any) -> Any:
        if node.exp.is_Integer:
            return base ** int(node.exp)
        if node.exp.is_Rational and node.exp.q == 2:
            return base.sqrt() ** int(node.exp.p)
        return base**exponent

    def _evaluated(self, node: Any) -> Any:
        found = _by_evaluation(node, self.bits)
        if found is None:
            return None
        return self.flint.acb(*(self.engine.interval(part) for part in found))


# Many coefficients of one jet are made of the same named constants.
@lru_cache(maxsize=1024)
def _named_ball(node: Any, bits: int) -> Any:
    here = engine()
    assert isinstance(here, FlintEngine)
    return _Arb(here, bits).ball(node.definition)


def _by_evaluation(expression: Any, bits: int) -> Rectangle | None:
    """Enclose a constant by SymPy's evaluation to a given accuracy."""
    digits = int(bits * 0.302) + 5
    # The accuracy of SymPy is relative: beside a number of the size of 1 it is absolute.
    for shift in (0, 1, 3):
        try:
            value = (expression + shift).evalf(digits, maxn=4 * digits, strict=True)
            parts = [sp.Rational(p) for p in value.as_real_imag()]
        except (PrecisionExhausted, TypeError, ValueError):
            continue
        parts[0] -= shift
        break
    else:
        return None
    fractions = [Fraction(int(p.p), int(p.q)) for p in parts]
    slack = max(Fraction(1), *(abs(f) for f in fractions)) / 2 ** (bits - 8)
    # A part that is an exact zero was recognised as one.
    sides = [Enclosure(f - slack, f + slack) if f else Enclosure(f, f) for f in fractions]
    return Rectangle(*sides)


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
