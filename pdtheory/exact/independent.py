"""Constants as rational functions of numbers that are algebraically independent, as far as known.

By the theorem of Lindemann and Weierstrass the exponentials exp(b) of algebraic numbers b that are
linearly independent over Q are algebraically independent. The values of exp, sinh, ... at rational
multiples of b are rational functions of one such exponential, and those of sin, cos, ... of the
tangent of half an angle, which stays real. A factor that rational functions have in common is then
found by the arithmetic of polynomials.
"""

from __future__ import annotations

from collections.abc import Iterable
from functools import reduce
from math import lcm
from typing import Any, Final

import sympy as sp

from pdtheory.exact.numberfield import composed, in_number_field, is_composed, power
from pdtheory.exact.separation import extent, is_known_algebraic
from pdtheory.exact.zeros import is_zero

#: Largest degree of a number field that is kept as one; beyond it roots are taken for independent.
MOST_DEGREE: Final = 8

#: Largest power of an exponential, or multiple of an angle, that is written as one.
MOST_POWER: Final = 48

_CIRCULAR = (sp.sin, sp.cos, sp.tan, sp.cot)
_HYPERBOLIC = (sp.sinh, sp.cosh, sp.tanh, sp.coth)


class Independent:
    """Constants up to a common factor, as polynomials in symbols for what they are made of.

    Parameters
    ----------
    constants
        SymPy expressions without free symbols.

    Attributes
    ----------
    polynomials : list
        The constants times one number that is not zero, elements of a SymPy ring over QQ.
    meaning : dict
        The number that each symbol stands for. Those that are no exponentials or tangents, such as
        pi or a logarithm, may depend on each other.
    generator : (symbol, list) or None
        The symbol for the generator of the number field of the algebraic numbers, and its minimal
        polynomial over QQ, leading coefficient first.
    """

    def __init__(self, constants: Iterable[Any]) -> None:
        listed = list(constants)
        self.meaning: dict[Any, Any] = {}
        self.generator: tuple[Any, list[Any]] | None = None
        self._symbols: dict[Any, Any] = {}
        #: The least common denominator of the multiples of each basic argument, by kind.
        self._shares: dict[tuple[bool, Any], int] = {}
        algebraic = [*dict.fromkeys(a for c in listed for a in _algebraic_parts(c))]
        self._has_field = extent(algebraic).degree <= MOST_DEGREE
        self._visited: set[Any] = set()
        self._largest: dict[tuple[bool, Any], Any] = {}
        for constant in listed:
            self._collect(constant)
        wild = {key for key, q in self._shares.items() if q * self._largest[key] > MOST_POWER}
        self._shares = {key: q for key, q in self._shares.items() if key not in wild}
        for node in [n for n in self._visited if _is_elementary(n) and not self._is_rewritten(n)]:
            self._symbol(node)
        for circular, basic in self._shares:
            self._symbol(self._basic(circular, basic))
        coordinates = self._adjoin(algebraic) if self._has_field else {}
        self.field = (
            sp.QQ.frac_field(*self.meaning) if self.meaning else sp.QQ.frac_field(sp.Dummy())
        )
        self._known: dict[Any, Any] = {a: self._combined(c) for a, c in coordinates.items()}
        fractions = [self._of(constant) for constant in listed]
        common = reduce(lambda p, q: p.lcm(q), (f.denom for f in fractions))
        self.polynomials = [f.numer * common.exquo(f.denom) for f in fractions]

    def value(self, polynomial: Any) -> Any:
        """Return the number that a polynomial in the symbols stands for."""
        return polynomial.as_expr().xreplace(self.meaning)

    def quotients(self, index: int) -> list[Any] | None:
        """Return the constants over one of them if all quotients are seen to be algebraic."""
        parts = [self._by_monomials(p) for p in self.polynomials]
        divisor = parts[index]
        if not divisor:
            return None
        monomial, below = next(iter(divisor.items()))
        found = []
        for part in parts:
            if not part:
                found.append(sp.Integer(0))
                continue
            if part.keys() != divisor.keys():
                return None
            above = part[monomial]
            if any(not is_zero(part[m] * below - above * c) for m, c in divisor.items()):
                return None
            found.append(sp.radsimp(sp.expand(above / below)))
        return found

    def _by_monomials(self, polynomial: Any) -> dict[Any, Any]:
        """Return a polynomial in the independent symbols, its coefficients algebraic numbers."""
        place = None
        if self.generator is not None:
            place = list(self.meaning).index(self.generator[0])
            root = self.meaning[self.generator[0]]
        found: dict[Any, Any] = {}
        for exponents, c in polynomial.terms():
            value = sp.QQ.to_sympy(c)
            if place is not None:
                value *= root ** exponents[place]
                exponents = (*exponents[:place], *exponents[place + 1 :])
            found[exponents] = found.get(exponents, sp.Integer(0)) + value
        return {m: c for m, c in found.items() if not is_zero(c)}

    def _adjoin(self, algebraic: list[Any]) -> dict[Any, list[Any]]:
        """Name the generator of a number field; return numbers as polynomials in it."""
        if not algebraic:
            return {}
        ground, elements = in_number_field(algebraic)
        if ground.is_QQ:
            return {a: [e] for a, e in zip(algebraic, elements, strict=True)}
        symbol = self._symbol(ground.ext.as_expr())
        self.generator = symbol, ground.mod.to_list()
        return {a: e.to_list() for a, e in zip(algebraic, elements, strict=True)}

    def _combined(self, coordinates: list[Any]) -> Any:
        """Return a polynomial in the generator, leading coefficient first."""
        value = self.field.zero
        for c in coordinates:
            if self.generator is not None:
                value = value * self.field(self.generator[0])
            value = value + self.field.convert_from(c, sp.QQ)
        return value

    def _collect(self, node: Any) -> None:
        """Give symbols to all that is no sum, product or power."""
        if node in self._visited or node.is_Rational:
            return
        self._visited.add(node)
        if self._has_field and is_known_algebraic(node):
            return
        if _is_elementary(node):
            circular = isinstance(node, _CIRCULAR)
            for multiple, basic in _terms(_argument(node)):
                key = circular, basic
                self._shares[key] = lcm(self._shares.get(key, 1), int(multiple.q))
                self._largest[key] = max(self._largest.get(key, 0), abs(multiple))
        elif is_composed(node):
            for part in node.args:
                self._collect(part)
        else:
            self._symbol(node)

    def _symbol(self, number: Any) -> Any:
        if number not in self._symbols:
            self._symbols[number] = sp.Dummy()
            self.meaning[self._symbols[number]] = number
        return self._symbols[number]

    def _is_rewritten(self, node: Any) -> bool:
        """Return whether a number is a short power of what is named, or a short multiple."""
        circular = isinstance(node, _CIRCULAR)
        return _is_elementary(node) and all(
            (circular, basic) in self._shares for _, basic in _terms(_argument(node))
        )

    def _basic(self, circular: bool, basic: Any) -> Any:
        share = self._shares[circular, basic]
        return sp.tan(basic / (2 * share)) if circular else sp.exp(basic / share)

    def _of(self, node: Any) -> Any:
        if node not in self._known:
            self._known[node] = self._new(node)
        return self._known[node]

    def _new(self, node: Any) -> Any:
        if self._is_rewritten(node):
            if isinstance(node, _CIRCULAR):
                return self._circular(node)
            return self._exponential(node)
        if node.is_Rational or is_composed(node):
            return composed(node, self.field, self._of)
        return self.field(self._symbols[node])

    def _exponential(self, node: Any) -> Any:
        value = self.field.one
        for multiple, basic in _terms(_argument(node)):
            factor = self.field(self._symbols[self._basic(False, basic)])
            value *= power(factor, int(multiple * self._shares[False, basic]), self.field)
        if isinstance(node, sp.exp) or node is sp.E:
            return value
        plus, minus = value + 1 / value, value - 1 / value
        return {sp.sinh: minus / 2, sp.cosh: plus / 2, sp.tanh: minus / plus,
                sp.coth: plus / minus}[node.func]  # fmt: skip

    def _circular(self, node: Any) -> Any:
        cosine, sine = self.field.one, self.field.zero
        for multiple, basic in _terms(_argument(node)):
            t = self.field(self._symbols[self._basic(True, basic)])
            c, s = (1 - t**2) / (1 + t**2), 2 * t / (1 + t**2)
            turns = int(multiple * self._shares[True, basic])
            for _ in range(abs(turns)):
                turned = s if turns > 0 else -s
                cosine, sine = cosine * c - sine * turned, cosine * turned + sine * c
        if node.func in (sp.cos, sp.sin):
            return cosine if node.func is sp.cos else sine
        return sine / cosine if node.func is sp.tan else cosine / sine


def _algebraic_parts(node: Any) -> list[Any]:
    """Return the algebraic numbers in sums, products and powers."""
    if node.is_Rational or _is_elementary(node):
        return []
    if is_known_algebraic(node):
        return [node]
    return [a for part in node.args for a in _algebraic_parts(part)] if is_composed(node) else []


def _is_elementary(node: Any) -> bool:
    """Return whether a number is an exponential or the like of a real algebraic number."""
    if node is sp.E:
        return True
    if not isinstance(node, (sp.exp, *_CIRCULAR, *_HYPERBOLIC)):
        return False
    return is_known_algebraic(node.args[0]) and bool(node.args[0].is_real)


def _argument(node: Any) -> Any:
    return sp.Integer(1) if node is sp.E else sp.expand(node.args[0])


def _terms(argument: Any) -> list[tuple[Any, Any]]:
    """Write a number as a sum of rational multiples of basic numbers."""
    return [term.as_coeff_Mul() for term in sp.Add.make_args(argument)]
