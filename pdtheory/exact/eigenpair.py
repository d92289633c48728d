"""One real E-eigenpair: exact, with enclosures to any number of digits."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from fractions import Fraction
from functools import cached_property, lru_cache, partial
from math import cos, radians, sin
from typing import Any

import sympy as sp

from pdtheory.conventions import Kind
from pdtheory.exact.algebraic import RealAlgebraic
from pdtheory.exact.balls import engine, horner
from pdtheory.exact.charpoly import cosine_squared_polynomial, value_polynomial
from pdtheory.exact.constantroots import RealConstant, RealRoot
from pdtheory.exact.engines import Integers
from pdtheory.exact.intervals import Enclosure
from pdtheory.exact.realcoefficients import Coefficients
from pdtheory.exact.realnumber import SHORT, RealNumber, bits_for, precisions, to_float

#: Largest degree of an eigenvalue whose minimal polynomial is worked out for a text.
LARGEST_TEXT = 24


@dataclass(frozen=True)
class EigenPair:
    """One real E-eigenvector v = (cos theta, sin theta) with its E-eigenvalue lambda = T_k v^k.

    Attributes
    ----------
    tangent : RealNumber or None
        tan(theta), algebraic or a root of a polynomial with constants as coefficients; None for
        theta = 90 and 270 degrees.
    opposite : bool
        True if theta is in [180, 360): the vector is minus the one at theta - 180.
    kind : Kind
        Maximum, minimum or inflection of g_k at theta, decided exactly.
    multiplicity : int
        Multiplicity of theta as a zero of the derivative of g_k.
    vanishing : bool
        True if lambda = 0, decided exactly.
    """

    tangent: RealNumber | None
    opposite: bool
    kind: Kind
    multiplicity: int
    vanishing: bool
    _numbers: Coefficients = field(repr=False, compare=False)

    @property
    def t(self) -> Any:
        """tan(theta), exactly; ``oo`` where the vector is vertical."""
        return sp.oo if self.tangent is None else self.tangent.exact

    @property
    def vector(self) -> tuple[Any, Any]:
        """(cos theta, sin theta), exactly."""
        turn = -1 if self.opposite else 1
        if self.tangent is None:
            return sp.Integer(0), sp.Integer(turn)
        right = -turn if self.tangent.sign() < 0 else turn
        square = self._short_cosine_squared
        if square is not None:
            cosine, sine = (sp.sqrtdenest(sp.sqrt(sp.expand(s))) for s in (square, 1 - square))
            return sp.expand(right * cosine), sp.expand(turn * sine)
        t = self.tangent.exact
        return right / sp.sqrt(1 + t**2), right * t / sp.sqrt(1 + t**2)

    @cached_property
    def _short_cosine_squared(self) -> Any | None:
        """cos(theta)^2 in radicals if tan(theta) and it are short, else None."""
        tangent = self.tangent
        if not isinstance(tangent, RealAlgebraic) or not tangent.is_short:
            return None
        polynomial = cosine_squared_polynomial(tangent.polynomial)
        return RealAlgebraic.select(polynomial, partial(_cosine_squared, tangent)).radical

    @cached_property
    def eigenvalue_number(self) -> RealNumber:
        """lambda as a real number: algebraic with its minimal polynomial, or by its expression.

        Where the coefficients have a transcendental common factor it is lambda over that factor.
        """
        if self.vanishing:
            return RealAlgebraic.rational(0)
        if not self._is_algebraic:
            return RealConstant(self._turned * self._value_expression)
        coefficients = self._numbers.in_generator
        modulus: Integers = (0, 1)
        if self.tangent is None:
            coefficients = coefficients[::-1]
        else:
            assert isinstance(self.tangent, RealAlgebraic)
            modulus = self.tangent.polynomial
        polynomial = value_polynomial(coefficients, self._numbers.generator.polynomial, modulus)
        return RealAlgebraic.select(polynomial, lambda bits: self._enclose_eigenvalue(bits, False))

    @property
    def _is_algebraic(self) -> bool:
        """True if lambda over the common factor and tan(theta) have minimal polynomials."""
        return self._numbers.in_field and not isinstance(self.tangent, RealRoot)

    @property
    def _value_expression(self) -> Any:
        """f(v) for v = (1, t) / sqrt(1 + t^2), or (0, 1)."""
        coefficients = self._numbers.expressions
        if self.tangent is None:
            return coefficients[-1]
        t = self.tangent.exact
        if t == 0:
            return coefficients[0]
        order = len(coefficients) - 1
        value = sp.Add(*(c * t**j for j, c in enumerate(coefficients)))
        return value / (1 + t**2) ** sp.Rational(order, 2)

    @property
    def _turned(self) -> int:
        """The sign of lambda relative to that of the vector with positive cosine, or (0, 1)."""
        turned = self.opposite
        if self.tangent is not None and self.tangent.sign() < 0:
            turned = not turned
        return -1 if turned and len(self._numbers.expressions) % 2 == 0 else 1

    @property
    def eigenvalue(self) -> Any:
        """lambda, exactly: radicals if short, else a root of its minimal polynomial."""
        return self._numbers.factor * self.eigenvalue_number.exact

    def angle_enclosure(self, digits: int = 15) -> Enclosure:
        """Return an enclosure of theta in degrees, in [0, 360), of relative width 10^-digits."""
        turn = 180 if self.opposite else 0
        if self.tangent is None:
            return Enclosure(Fraction(90 + turn), Fraction(90 + turn))
        sign = self.tangent.sign()
        if sign == 0:
            return Enclosure(Fraction(turn), Fraction(turn))
        tangent, turn = self.tangent, turn + (180 if sign < 0 else 0)
        return _narrow(lambda bits: _angle(tangent, bits).shift(turn), digits)

    def unit_vector(self) -> tuple[float, float]:
        """Return (cos theta, sin theta) in double precision, without the exact expressions."""
        angle = self.angle_enclosure(20).middle
        # Folding to [-45, 45] degrees first keeps the components exact on the axes.
        quarter = round(angle / 90)
        rest = radians(float(angle - 90 * quarter))
        c, s = cos(rest), sin(rest)
        return ((c, s), (-s, c), (-c, -s), (s, -c))[quarter % 4]

    def eigenvalue_enclosure(self, digits: int = 15) -> Enclosure:
        """Return an enclosure of lambda of width at most 10^-digits times max(1, |lambda|)."""
        return _narrow(self._enclose_eigenvalue, digits)

    def angle_degrees(self, digits: int = 15) -> Any:
        """Return theta in degrees, in [0, 360), as a SymPy Float with this many digits."""
        return to_float(self.angle_enclosure, digits)

    def eigenvalue_float(self, digits: int = 15) -> Any:
        """Return lambda as a SymPy Float with this many digits."""
        return (
            sp.Float(0, digits) if self.vanishing else to_float(self.eigenvalue_enclosure, digits)
        )

    @property
    def exact_text(self) -> str:
        """The pair for people: radicals when short, else minimal polynomials and enclosures."""
        direction = "" if self.tangent is None else f"tan(theta) = {self.tangent.text()}"
        if self.tangent is None or self._short_cosine_squared is not None:
            components = [str(c) for c in self.vector]
            if max(len(c) for c in components) <= SHORT or not direction:
                direction = f"v = ({', '.join(components)})"
        return f"{direction}, lambda = {self.eigenvalue_text()}"

    def enclosure_text(self, digits: int = 15) -> str:
        """The pair for people by its enclosures alone: for rows that were rounded."""
        angle = self.angle_enclosure(digits).text(digits)
        value = self.eigenvalue_enclosure(digits).text(digits)
        return f"theta in {angle} degrees, lambda in {value}"

    def eigenvalue_text(self, digits: int = 15) -> str:
        """Return lambda for people; beyond a degree of `LARGEST_TEXT` by its enclosure alone."""
        if self.vanishing or self._text_degree <= LARGEST_TEXT:
            number, factor = self.eigenvalue_number, self._numbers.factor
            if factor == 1 or not number.is_short:
                text = number.text(digits)
                return text if factor == 1 else f"{factor} times {text}"
            return str(factor * number.radical)
        return f"a number in {self.eigenvalue_enclosure(digits).text(digits)}"

    @property
    def _text_degree(self) -> int:
        """A bound on the degree of lambda; 1 where it is no matter of a minimal polynomial."""
        if not self._is_algebraic:
            return 1
        degree = self.tangent.degree if isinstance(self.tangent, RealAlgebraic) else 1
        return self._numbers.generator.degree * degree

    def _enclose_eigenvalue(self, bits: int, with_factor: bool = True) -> Enclosure:
        if self.vanishing:
            return Enclosure(Fraction(0), Fraction(0))
        value = _value(self._numbers, self.tangent, bits, with_factor)
        return value.flip() if self._turned < 0 else value


def _angle(tangent: RealNumber, bits: int) -> Enclosure:
    """Return an enclosure of atan(t) in degrees."""
    with engine().precision(bits):
        t = engine().interval(tangent.at_precision(bits))
        return engine().enclosure(engine().atan_degrees(t))


def _cosine_squared(tangent: RealAlgebraic, bits: int) -> Enclosure:
    """Return an enclosure of 1 / (1 + t^2)."""
    with engine().precision(bits):
        t = engine().interval(tangent.at_precision(bits))
        return engine().enclosure(1 / (1 + t * t))


# A pair and its opposite ask for the same value one after the other.
@lru_cache(maxsize=256)
def _value(
    numbers: Coefficients, tangent: RealNumber | None, bits: int, with_factor: bool
) -> Enclosure:
    """Return an enclosure of f(v) for v = (1, t) / sqrt(1 + t^2), or (0, 1)."""
    order = len(numbers.expressions) - 1
    with engine().precision(bits):
        coefficients = numbers.intervals(bits)
        if tangent is None:
            value = coefficients[-1]
        else:
            t = engine().interval(tangent.at_precision(bits))
            square = 1 + t * t
            value = horner(coefficients, t) / square ** (order // 2)
            if order % 2:
                value = value / square.sqrt()
        if with_factor and numbers.factor != 1:
            value = value * numbers.factor_interval(bits)
        return engine().enclosure(value)


def _narrow(enclose: Callable[[int], Enclosure], digits: int) -> Enclosure:
    for bits in precisions(bits_for(digits)):
        found = enclose(bits)
        if found.narrower_than(digits):
            return found
    raise AssertionError("unreachable")
