"""Real roots of polynomials with constants as coefficients, and other real constants."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import sympy as sp

from pdtheory.exact.constantpolynomial import ConstantPolynomial
from pdtheory.exact.enclosing import enclose_real
from pdtheory.exact.intervals import Enclosure
from pdtheory.exact.named import EnclosedConstant
from pdtheory.exact.realnumber import SHORT, RealNumber
from pdtheory.exact.texts import text_within
from pdtheory.exact.zeros import sign


@dataclass(frozen=True)
class RealConstant(RealNumber):
    """A real number by an exact expression that can be enclosed.

    Attributes
    ----------
    expression : sympy.Expr
        The number.
    """

    expression: Any

    def at_precision(self, bits: int) -> Enclosure:
        """Return an enclosure computed with a working precision in bits."""
        return enclose_real(self.expression, bits)

    @property
    def radical(self) -> Any | None:
        """The expression if it is short, else None."""
        return self.expression if _is_short(self.expression) else None

    @property
    def exact(self) -> Any:
        """The expression."""
        return self.expression

    def text(self, digits: int = 15) -> str:
        """Return the expression if it is short, else an enclosure."""
        if self.radical is not None:
            return str(self.expression)
        return f"a number in {self.enclosure(digits).text(digits)}"


@dataclass(frozen=True)
class RealRoot(RealNumber):
    """A real root of a squarefree polynomial with constants as coefficients.

    Attributes
    ----------
    polynomial : ConstantPolynomial
        The polynomial; it does not have the root 0.
    index : int
        Position among its real roots, ascending from 0.
    """

    polynomial: ConstantPolynomial
    index: int

    def at_precision(self, bits: int) -> Enclosure:
        """Return an enclosure computed with a working precision in bits."""
        return self.polynomial.isolated(bits).real[self.index]

    @property
    def closed_form(self) -> Any | None:
        """The root of a polynomial of degree 1 or 2 by the formula, else None."""
        known = self.polynomial.expressions
        if known is None or len(known) > 3:
            return None
        if len(known) == 2:
            return -known[0] / known[1]
        c, b, a = known
        spread = sp.sqrt(sp.expand(b**2 - 4 * a * c)) * sign(a) * (1 if self.index else -1)
        return (spread - b) / (2 * a)

    @property
    def radical(self) -> Any | None:
        """The closed form if it is short, else None."""
        found = self.closed_form
        return found if found is not None and _is_short(found) else None

    @property
    def exact(self) -> Any:
        """The closed form, else a SymPy number with this root as its definition."""
        found = self.closed_form
        return RootOfConstants(self) if found is None else found

    def text(self, digits: int = 15) -> str:
        """Return the closed form if it is short, else polynomial and enclosure, or that alone."""
        if self.radical is not None:
            return str(self.radical)
        place, polynomial = self.enclosure(digits).text(digits), self.polynomial.text()
        if polynomial:
            return f"the root of {polynomial} in {place}"
        return f"a number in {place}"


class RootOfConstants(EnclosedConstant):
    """A real root of a polynomial with constants as coefficients, as a SymPy number.

    Parameters
    ----------
    root
        The root.
    """

    __slots__ = ("root",)

    root: RealRoot

    def __new__(cls, root: RealRoot) -> RootOfConstants:
        self = super().__new__(cls)
        self.root = root
        return self

    def __getnewargs__(self) -> tuple[RealRoot]:
        return (self.root,)

    def _hashable_content(self) -> tuple[Any, ...]:
        return id(self.root.polynomial), self.root.index

    def enclosure_at(self, bits: int) -> Enclosure:
        """Return an enclosure computed with a working precision in bits."""
        return self.root.at_precision(bits)

    def _sympystr(self, printer: Any) -> str:
        polynomial = self.root.polynomial
        text = polynomial.text() or f"a polynomial of degree {polynomial.degree}"
        return f"RootOf({text}, {self.root.index})"

    _sympyrepr = _sympystr

    def _latex(self, printer: Any) -> str:
        return rf"{sp.sstr(self.evalf(12))}\ldots"


def _is_short(expression: Any) -> bool:
    return bool(text_within(expression, SHORT))
