"""Real E-eigenpairs of a symmetric tensor of dimension 2, exact and certified.

The E-eigenvectors are the zeros on the circle of F = x f_y - y f_x, that is the real roots of
F(1, t), t = tan(theta), and theta = 90 degrees where the degree of F(1, t) drops. The polynomial is
factored exactly and its real roots isolated with proof, so their number is proved.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from fractions import Fraction
from functools import cached_property, lru_cache, partial
from math import cos, radians, sin
from typing import Any, Literal

import sympy as sp

from pdtheory.conventions import Kind
from pdtheory.exact.algebraic import (
    SHORT,
    RealAlgebraic,
    bits_for,
    precisions,
    to_float,
)
from pdtheory.exact.balls import Enclosure, Integers, engine, horner
from pdtheory.exact.charpoly import cosine_squared_polynomial, value_polynomial
from pdtheory.exact.coefficients import check_order
from pdtheory.exact.faces import BinaryForm, Face
from pdtheory.exact.roots import Coefficients, form_roots
from pdtheory.exact.zeros import is_zero

Outcome = Literal["ok", "isotropic", "vanishing"]

#: Largest degree of an eigenvalue whose minimal polynomial is worked out for a text.
LARGEST_TEXT = 24


@dataclass(frozen=True)
class EigenPair:
    """One real E-eigenvector v = (cos theta, sin theta) with its E-eigenvalue lambda = T_k v^k.

    Attributes
    ----------
    tangent : RealAlgebraic or None
        tan(theta); None for theta = 90 and 270 degrees.
    opposite : bool
        True if theta is in [180, 360): the vector is minus the one at theta - 180.
    kind : Kind
        Maximum, minimum or inflection of g_k at theta, decided exactly.
    multiplicity : int
        Multiplicity of theta as a zero of the derivative of g_k.
    vanishing : bool
        True if lambda = 0, decided exactly.
    """

    tangent: RealAlgebraic | None
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
        if tangent is None or tangent.radical is None:
            return None
        polynomial = cosine_squared_polynomial(tangent.polynomial)
        return RealAlgebraic.select(polynomial, partial(_cosine_squared, tangent)).radical

    @cached_property
    def eigenvalue_number(self) -> RealAlgebraic:
        """lambda as a real algebraic number, with its minimal polynomial.

        Where the coefficients have a transcendental common factor it is lambda over that factor.
        """
        if self.vanishing:
            return RealAlgebraic.rational(0)
        coefficients = self._numbers.in_generator
        modulus: Integers = (0, 1)
        if self.tangent is None:
            coefficients = coefficients[::-1]
        else:
            modulus = self.tangent.polynomial
        polynomial = value_polynomial(coefficients, self._numbers.generator.polynomial, modulus)
        return RealAlgebraic.select(polynomial, lambda bits: self._enclose_eigenvalue(bits, False))

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
        degree = self._numbers.generator.degree * (self.tangent.degree if self.tangent else 1)
        if self.vanishing or degree <= LARGEST_TEXT:
            text = self.eigenvalue_number.text(digits)
            factor = self._numbers.factor
            return text if factor == 1 else f"{factor} times {text}"
        return f"a number in {self.eigenvalue_enclosure(digits).text(digits)}"

    def _enclose_eigenvalue(self, bits: int, with_factor: bool = True) -> Enclosure:
        if self.vanishing:
            return Enclosure(Fraction(0), Fraction(0))
        value = _value(self._numbers, self.tangent, bits, with_factor)
        turned = self.opposite
        if self.tangent is not None and self.tangent.sign() < 0:
            turned = not turned
        odd = len(self._numbers.expressions) % 2 == 0
        return value.flip() if turned and odd else value


def _angle(tangent: RealAlgebraic, bits: int) -> Enclosure:
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
    numbers: Coefficients, tangent: RealAlgebraic | None, bits: int, with_factor: bool
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
                value = value / engine().sqrt(square)
        if with_factor and numbers.factor != 1:
            value = value * numbers.factor_interval(bits)
        return engine().enclosure(value)


def _narrow(enclose: Callable[[int], Enclosure], digits: int) -> Enclosure:
    for bits in precisions(bits_for(digits)):
        found = enclose(bits)
        if found.narrower_than(digits):
            return found
    raise AssertionError("unreachable")


@dataclass(frozen=True)
class EigenPairs:
    """All real E-eigenpairs of one form, by angle in [0, 360) degrees.

    Iterate over it, index it, take its length.

    Attributes
    ----------
    form : BinaryForm
        The form f = T_k v^k.
    status : {"ok", "isotropic", "vanishing"}
        "isotropic" if f is a nonzero constant on the circle, so that every unit vector is an
        E-eigenvector and none is listed; "vanishing" if f = 0.
    pairs : tuple of EigenPair
        The pairs, by ascending angle.
    """

    form: BinaryForm
    status: Outcome
    pairs: tuple[EigenPair, ...]

    @property
    def order(self) -> int:
        """The order k."""
        return self.form.order

    @property
    def isotropic_eigenvalue(self) -> Any | None:
        """The one value of f on the circle where the status is not "ok", else None."""
        return None if self.status == "ok" else self.form.coefficients[0]

    @property
    def maxima(self) -> tuple[EigenPair, ...]:
        """The maximum principal directions."""
        return self.of_kind(Kind.MAXIMUM)

    @property
    def minima(self) -> tuple[EigenPair, ...]:
        """The minimum principal directions."""
        return self.of_kind(Kind.MINIMUM)

    @property
    def inflections(self) -> tuple[EigenPair, ...]:
        """The E-eigenvectors that are no extrema."""
        return self.of_kind(Kind.INFLECTION)

    def of_kind(self, kind: Kind) -> tuple[EigenPair, ...]:
        """Return the pairs of one kind."""
        return tuple(p for p in self.pairs if p.kind == kind)

    def _repr_latex_(self) -> str:
        from pdtheory.exact.report import latex_pairs

        return latex_pairs(self)

    def __len__(self) -> int:
        return len(self.pairs)

    def __iter__(self) -> Iterator[EigenPair]:
        return iter(self.pairs)

    def __getitem__(self, index: int) -> EigenPair:
        return self.pairs[index]


def real_eigenpairs(face: Face) -> EigenPairs:
    """Return all real E-eigenpairs of a symmetric tensor, on the full circle.

    Parameters
    ----------
    face
        A tensor, binary form or Wavejets row of order k >= 1 with real algebraic coefficients.

    Returns
    -------
    EigenPairs
        For odd k the pair at theta + 180 degrees has the opposite kind and eigenvalue, for even k
        the same.

    Raises
    ------
    InputError
        If the order is 0, or a coefficient is symbolic, complex, or transcendental other than by a
        common factor (a form that is constant on the circle may have any).

    Notes
    -----
    theta is an E-eigenvector iff g_k'(theta) = 0 (theorem 1 of the paper). It is an extremum iff
    the multiplicity of that zero is odd; then the first derivative of g_k that does not vanish
    has the sign in which F changes across theta, and F has no other zero between neighbours.

    Examples
    --------
    >>> pairs = real_eigenpairs(BinaryForm([6, 0, -18, 0]))
    >>> [(str(p.vector[0]), p.eigenvalue, p.kind.label) for p in pairs][:3]
    [('1', 6, 'max'), ('1/2', -6, 'min'), ('-1/2', 6, 'max')]
    """
    form = face.form
    check_order(form.order, 1)
    numbers = Coefficients(form.coefficients)
    numbers.check_real_numbers()
    if face.is_zero:
        return EigenPairs(form, "vanishing", ())
    derivative = form.angular_derivative()
    if derivative.is_zero:
        return EigenPairs(form, "isotropic", ())
    _ = numbers.in_generator  # refuses transcendental coefficients without a common factor
    # f and its derivative along the circle vanish together at the multiple zeros of f.
    zeros = {root.value for root in form_roots(form.coefficients, least_multiplicity=2)}
    half = _half_circle(derivative)
    pairs = [
        EigenPair(
            tangent,
            opposite,
            Kind(-kind if opposite and form.order % 2 else kind),
            multiplicity,
            tangent in zeros,
            numbers,
        )
        for opposite in (False, True)
        for tangent, multiplicity, kind in half
    ]
    return EigenPairs(form, "ok", tuple(pairs))


def _half_circle(derivative: BinaryForm) -> list[tuple[RealAlgebraic | None, int, int]]:
    """Return (tan theta, multiplicity, kind) of the zeros of F for theta in [0, 180) degrees."""
    order = derivative.order
    before = _sign_after_minus_90(derivative)
    first, second = [], []
    for root in form_roots(derivative.coefficients):
        after = before * (-1) ** root.multiplicity
        kind = (before - after) // 2
        if root.value is None or root.value.sign() >= 0:
            first.append((root.value, root.multiplicity, kind))
        else:
            # theta + 180 degrees: F has degree k, so its sign there is (-1)^k times.
            second.append((root.value, root.multiplicity, kind * (-1) ** order))
        before = after
    return first + second


def _sign_after_minus_90(derivative: BinaryForm) -> int:
    """Return the sign of F(1, t) for t towards minus infinity."""
    numbers = Coefficients(derivative.coefficients)
    degree = max(j for j, a in enumerate(derivative.coefficients) if not is_zero(a))
    for bits in precisions():
        with engine().precision(bits):
            sign = engine().enclosure(numbers.intervals(bits)[degree]).sign
        if sign:
            return sign * (-1) ** degree
    raise AssertionError("unreachable")
