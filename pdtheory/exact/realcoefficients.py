"""The coefficients of a real form: a common factor times elements of a number field, or constants.

In a field of small degree the directions are algebraic numbers with minimal polynomials. Other
coefficients (cos(1), or a tower of roots) are constants that can be enclosed to any precision.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from typing import Any, Final

import sympy as sp

from pdtheory.errors import InputError
from pdtheory.exact.algebraic import RealAlgebraic, primitive
from pdtheory.exact.balls import engine, horner
from pdtheory.exact.coefficients import as_fraction
from pdtheory.exact.enclosing import enclose_real, real_balls
from pdtheory.exact.independent import Independent
from pdtheory.exact.intervals import Enclosure
from pdtheory.exact.numberfield import in_number_field
from pdtheory.exact.separation import extent, is_known_algebraic
from pdtheory.exact.texts import size_of
from pdtheory.exact.zeros import is_real, is_zero, sign

#: Total size of transcendental coefficients in which a common factor is looked for.
LONGEST_WITH_FACTOR: Final = 400

_T = sp.Symbol("t")


@dataclass(frozen=True)
class Coefficients:
    """Real numbers, as a common factor times elements of one field Q(a) where they are that.

    The factor is 1 if the numbers are algebraic. Else it is the size of the first one that does not
    vanish, if the quotients are algebraic: pi x^2 + pi sqrt(2) y^2 has the factor pi.

    Attributes
    ----------
    expressions : tuple
        The numbers as SymPy expressions.
    """

    expressions: tuple[Any, ...]

    def check_real_numbers(self) -> None:
        """Refuse coefficients with free symbols and those that are not real."""
        for e in self.expressions:
            if e.free_symbols:
                names = ", ".join(sorted(str(s) for s in e.free_symbols))
                raise InputError(
                    f"The coefficient {e} depends on {names}; put numbers in place of symbols."
                )
            if not is_real(e):
                raise InputError(f"The coefficient {e} is not real; the form must be real.")

    @cached_property
    def _split(self) -> tuple[Any, tuple[Any, ...] | None]:
        """The common factor and the quotients by it; (1, None) if these lie in no small field."""
        factor: Any = sp.Integer(1)
        quotients = self.expressions
        if not all(is_known_algebraic(e) for e in quotients):
            if sum(size_of(e, LONGEST_WITH_FACTOR) for e in self.expressions) > LONGEST_WITH_FACTOR:
                return factor, None
            lead = next((e for e in self.expressions if not is_zero(e)), None)
            if lead is None:
                return factor, tuple(sp.Integer(0) for _ in self.expressions)
            factor = lead if sign(lead) > 0 else -lead
            divided = Independent(self.expressions).quotients(self.expressions.index(lead))
            if divided is None:
                return sp.Integer(1), None
            quotients = tuple(q if factor is lead else -q for q in divided)
        if not extent(quotients).is_small:
            return sp.Integer(1), None
        return factor, quotients

    @property
    def in_field(self) -> bool:
        """True if the numbers over the factor lie in a number field of small degree."""
        return self._split[1] is not None

    @property
    def factor(self) -> Any:
        """The common factor, positive."""
        return self._split[0]

    @property
    def algebraic(self) -> tuple[Any, ...]:
        """The numbers divided by the common factor; they must lie in a small field."""
        quotients = self._split[1]
        assert quotients is not None
        return quotients

    @cached_property
    def rationals(self) -> list[Fraction] | None:
        """The numbers over the factor as fractions if all are rational, else None."""
        if self.in_field and all(e.is_Rational for e in self.algebraic):
            return [as_fraction(e) for e in self.algebraic]
        return None

    @cached_property
    def field_elements(self) -> tuple[Any, list[Any]]:
        """The field Q(a) and the numbers over the factor as elements of it."""
        return in_number_field(self.algebraic)

    @cached_property
    def polynomial(self) -> Any:
        """f(1, t) over the factor, as a SymPy polynomial over the field."""
        field, elements = self.field_elements
        poly = sp.Poly.from_list(elements[::-1], _T, domain=field)
        return poly.set_domain(sp.QQ) if field.is_QQ else poly

    @cached_property
    def generator(self) -> RealAlgebraic:
        """The generator a of the field."""
        field, _ = self.field_elements
        if field.is_QQ:
            return RealAlgebraic.rational(0)
        minimal = primitive([as_fraction(c) for c in field.mod.to_list()[::-1]])
        expression = field.ext.as_expr()
        return RealAlgebraic.select(minimal, lambda bits: enclose_real(expression, bits))

    @cached_property
    def factor_interval(self) -> Callable[[int], Any]:
        """An interval number for the common factor at a working precision in bits."""
        return lambda bits: engine().interval(enclose_real(self.factor, bits))

    @cached_property
    def in_generator(self) -> list[list[Fraction]]:
        """Each number over the factor as a polynomial in the generator, constant term first."""
        if self.rationals is not None:
            return [[r] for r in self.rationals]
        field, elements = self.field_elements
        if field.is_QQ:
            return [[as_fraction(e)] for e in elements]
        return [[as_fraction(c) for c in e.to_list()[::-1]] or [Fraction(0)] for e in elements]

    def intervals(self, bits: int) -> list[Any]:
        """Return interval numbers for the coefficients over the factor (inside `precision`)."""
        if bits not in self._intervals:
            self._intervals[bits] = self._enclose(bits)
        return self._intervals[bits]

    @cached_property
    def _intervals(self) -> dict[int, list[Any]]:
        return {}

    def _enclose(self, bits: int) -> list[Any]:
        if not self.in_field:
            return real_balls(self.expressions, bits)
        number = engine().interval
        if self.rationals is not None:
            return [number(Enclosure(r, r)) for r in self.rationals]
        a = number(self.generator.at_precision(bits))
        return [horner([number(Enclosure(c, c)) for c in p], a) for p in self.in_generator]
