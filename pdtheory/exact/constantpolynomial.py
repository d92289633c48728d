"""Real polynomials whose coefficients are constants known to any precision, and their roots.

All complex roots are isolated in disjoint balls at once: what a ball holds is one simple root for
sure, so that the number of real roots is proved. A root is real if the mirror image of its ball
touches no other ball, because the mirror image of the root is a root too.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from functools import cached_property
from typing import Any, Final, NamedTuple

import sympy as sp

from pdtheory.exact.balls import engine, in_order_of
from pdtheory.exact.enclosing import real_balls
from pdtheory.exact.intervals import Enclosure, Rectangle
from pdtheory.exact.realnumber import FIRST_BITS, precisions
from pdtheory.exact.texts import text_within

#: Longest text of a polynomial that is shown.
LONG: Final = 160

_T = sp.Symbol("t")


class Isolation(NamedTuple):
    """Disjoint enclosures of all roots of a real polynomial.

    Attributes
    ----------
    real : tuple of Enclosure
        The real roots, ascending.
    upper : tuple of Rectangle
        The roots in the upper half plane, in one order for all precisions.
    """

    real: tuple[Enclosure, ...]
    upper: tuple[Rectangle, ...]


@dataclass(frozen=True, eq=False)
class ConstantPolynomial:
    """A real polynomial by balls for its coefficients; two are equal only if they are one object.

    Attributes
    ----------
    degree : int
        The degree.
    balls : callable
        Returns real balls of the coefficients, constant term first, for a precision in bits.
    expressions : tuple or None
        The coefficients as SymPy expressions where these are known, constant term first.
    """

    degree: int
    balls: Callable[[int], list[Any]]
    expressions: tuple[Any, ...] | None = None

    @classmethod
    def of(cls, expressions: Iterable[Any]) -> ConstantPolynomial:
        """Return the polynomial with given coefficients, of which the last is not zero."""
        known = tuple(expressions)
        return cls(len(known) - 1, lambda bits: real_balls(known, bits), known)

    def ball(self, bits: int) -> Any:
        """Return the polynomial in balls (inside `precision`)."""
        return engine().library.arb_poly(self.balls(bits))

    def separates(self, bits: int) -> bool:
        """Return whether this precision tells all roots apart, so that they are simple."""
        return self._isolate(bits) is not None

    def isolation(self, bits: int) -> Isolation | None:
        """Return enclosures of all roots, None if this precision does not tell them apart.

        It never succeeds for a polynomial with a multiple root.
        """
        if bits not in self._isolations:
            found = self._isolate(bits)
            if found is not None and bits > FIRST_BITS:
                first = self.isolated(FIRST_BITS)
                upper = in_order_of(first.upper, found.upper)
                found = None if upper is None else Isolation(found.real, upper)
            self._isolations[bits] = found
        return self._isolations[bits]

    def isolated(self, bits: int) -> Isolation:
        """Return the isolation at the first precision that shows it, of a squarefree polynomial."""
        for more in precisions(bits):
            found = self._isolate(more) if bits == FIRST_BITS else self.isolation(more)
            if found is not None:
                return found
        raise AssertionError("unreachable")

    @cached_property
    def _isolations(self) -> dict[int, Isolation | None]:
        return {}

    def _isolate(self, bits: int) -> Isolation | None:
        with engine().precision(bits):
            polynomial = self.ball(bits)
            if polynomial.length() <= self.degree or polynomial[self.degree].contains(0):
                return None
            roots = _roots(polynomial, bits)
            if roots is None:
                return None
            real, upper = [], []
            for i, root in enumerate(roots):
                mirrored = root.conjugate()
                if mirrored.overlaps(root):
                    if any(mirrored.overlaps(other) for other in (*roots[:i], *roots[i + 1 :])):
                        return None
                    real.append(engine().enclosure(root.real))
                elif root.imag > 0:
                    upper.append(engine().rectangle(root))
            return Isolation(tuple(sorted(real)), tuple(sorted(upper)))

    def text(self) -> str:
        """Return the polynomial in t; empty if it is long or its coefficients have no text."""
        if self.expressions is None:
            return ""
        return text_within(sp.Add(*(c * _T**j for j, c in enumerate(self.expressions))), LONG)


def _roots(polynomial: Any, bits: int) -> list[Any] | None:
    """Return disjoint balls of all complex roots, as narrow as the precision allows."""
    flint = engine().library
    # Coefficients that lose digits to cancellation do not bear the narrowest tolerance.
    for tolerance in (bits - 40, bits // 2, 0):
        try:
            return list(
                flint.acb_poly(polynomial).roots(
                    tol=flint.arb(2) ** -tolerance if tolerance else None, maxprec=4 * bits
                )
            )
        except ValueError:
            continue
    return None
