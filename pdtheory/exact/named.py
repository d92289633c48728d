"""Exact constants that go by a name because their definition is long."""

from __future__ import annotations

from typing import Any, Final

import mpmath
import sympy as sp

from pdtheory.exact.enclosing import enclose
from pdtheory.exact.realnumber import precisions

#: Longest definition, in nodes of the expression, that stays in sight.
LONGEST_PLAIN: Final = 24


class EnclosedConstant(sp.AtomicExpr):
    """A real number that prints like a symbol and is evaluated by its enclosures."""

    __slots__ = ()

    is_number = True
    is_commutative = True
    is_real = True

    def _eval_evalf(self, prec: int) -> Any:
        for bits in precisions(prec + 32):
            found = enclose(self, bits)
            if found is None:
                continue
            size = min(abs(found.real.lower), abs(found.real.upper))
            if found.real.width * 2 ** (prec + 2) <= size:
                middle = found.real.middle
                with mpmath.workprec(prec + 8):
                    value = mpmath.mpf(middle.numerator) / middle.denominator
                return sp.Float._new(value._mpf_, prec)
        raise AssertionError("unreachable")


class NamedConstant(EnclosedConstant):
    """A real number with a name and an exact definition, itself perhaps of named constants.

    It adds, multiplies and prints like a symbol, and is evaluated, compared and decided by its
    definition, which ``doit()`` puts in its place.

    Parameters
    ----------
    name
        The name, such as ``g_210``.
    definition
        The SymPy expression that it stands for.
    """

    __slots__ = ("definition", "name")

    name: str
    definition: Any

    def __new__(cls, name: str, definition: Any) -> NamedConstant:
        self = super().__new__(cls)
        self.name, self.definition = name, definition
        return self

    def __getnewargs__(self) -> tuple[str, Any]:
        return self.name, self.definition

    def _hashable_content(self) -> tuple[Any, ...]:
        return self.name, self.definition

    def doit(self, **hints: Any) -> Any:
        """Return the definition, with the definitions inside it."""
        return self.definition.doit(**hints)

    def _sympystr(self, printer: Any) -> str:
        return self.name

    _sympyrepr = _sympystr

    def _latex(self, printer: Any) -> str:
        letter, _, indices = self.name.partition("_")
        return f"{letter}_{{{indices}}}"


def named(name: str, definition: Any) -> Any:
    """Return a definition, under a name if it is long."""
    count = 0
    stack = [definition]
    while stack:
        stack.extend(stack.pop().args)
        count += 1
        if count > LONGEST_PLAIN:
            return NamedConstant(name, definition)
    return definition
