"""Sums of exponentials of constants in a normal form, in which zero is plain.

Trigonometric and hyperbolic functions are exponentials. A constant becomes a quotient of two sums
c_1 exp(b_1) + ... + c_m exp(b_m) with distinct exponents. By the theorem of Lindemann and
Weierstrass exponentials of distinct algebraic numbers are linearly independent over the algebraic
numbers, so that such a sum with algebraic c_i is zero only if every c_i is.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, Final, NamedTuple

import sympy as sp

from pdtheory.exact.sums import (
    GAUSS,
    ONE,
    Monomial,
    Root,
    Sum,
    added,
    coefficient_of,
    expression_of,
    monomial_of,
    product,
)


class Term(NamedTuple):
    """One term of a normal form: coefficient times powers of roots times exp(exponent)."""

    coefficient: Any
    exponent: Any
    roots: dict[Root, int]

    def without(self, root: Root) -> Any:
        """Return the term as an expression, with one root left out."""
        powers = (r.base ** sp.Rational(p, r.order) for r, p in self.roots.items() if r != root)
        return sp.Mul(self.coefficient, sp.exp(self.exponent), *powers)


class _Quotient(NamedTuple):
    """A sum over powers of denominators that are kept apart: {key of a sum: power}."""

    above: Sum
    below: dict[Any, int]


def numerator_terms(expression: Any) -> list[Term]:
    """Return the terms of the numerator of an expression.

    Parameters
    ----------
    expression
        A SymPy expression whose denominators do not vanish.

    Returns
    -------
    list of Term
        The expression is zero if and only if their sum is; empty if all cancel. The exponents
        look different; roots are those of sums with exponentials, such as sqrt(1 + exp(2)).

    Raises
    ------
    TooLong
        If there would be more than `MOST_TERMS` terms.
    """
    found = _Normal().of(expression).above
    terms = []
    for monomial, c in found.items():
        exponent = sum((e * _rational(p) for e, p in monomial if not _is_root(e)), sp.Integer(0))
        roots = {e: int(p) for e, p in monomial if _is_root(e)}
        terms.append(Term(expression_of(c), exponent, roots))
    return terms


def _is_root(factor: Any) -> bool:
    return isinstance(factor, Root)


class _Normal:
    """The normal form of every subexpression, each found once."""

    def __init__(self) -> None:
        self.known: dict[Any, _Quotient] = {}
        self.sums: dict[Any, Sum] = {}
        self.meaning: dict[Root, _Quotient] = {}

    def of(self, node: Any) -> _Quotient:
        if node not in self.known:
            self.known[node] = self._new(node)
        return self.known[node]

    def _new(self, node: Any) -> _Quotient:
        definition = getattr(node, "definition", None)
        if definition is not None:
            return self.of(definition)
        if node.is_Add:
            return self._sum([self.of(part) for part in node.args])
        if node.is_Mul:
            result = _Quotient(ONE, {})
            for part in node.args:
                result = self._times(result, self.of(part))
            return result
        if isinstance(node, sp.exp) or node is sp.E:
            argument = sp.Integer(1) if node is sp.E else sp.expand(node.args[0])
            return _Quotient({_exponent(argument): GAUSS.one}, {})
        if node.is_Pow and node.exp.is_Integer:
            return self._power(node.base, int(node.exp))
        if node.is_Pow and node.exp.is_Rational and not node.is_algebraic:
            return self._root(node.base, int(node.exp.p), int(node.exp.q))
        rule = _RULES.get(node.func)
        if rule is not None:
            above, below = rule(sp.expand(node.args[0]))
            if below is None:
                return _Quotient(above, {})
            key = frozenset(below.items())
            self.sums[key] = below
            return _Quotient(above, {key: 1})
        return _Quotient({(): coefficient_of(node)} if node else {}, {})

    def _sum(self, parts: list[_Quotient]) -> _Quotient:
        common: dict[Any, int] = {}
        for part in parts:
            for key, power in part.below.items():
                common[key] = max(power, common.get(key, 0))
        total: Sum = {}
        for part in parts:
            above = part.above
            for key, power in common.items():
                for _ in range(power - part.below.get(key, 0)):
                    above = product(above, self.sums[key])
            total = added(total, above)
        return self._reduced(_Quotient(total, common))

    def _times(self, a: _Quotient, b: _Quotient) -> _Quotient:
        below = dict(a.below)
        for key, power in b.below.items():
            below[key] = below.get(key, 0) + power
        return self._reduced(_Quotient(product(a.above, b.above), below))

    def _reduced(self, value: _Quotient) -> _Quotient:
        """Replace R^q by its meaning until no root R has a power of its index or above."""
        while True:
            root = next(
                (r for m in value.above for r, p in m if _is_root(r) and p >= r.order), None
            )
            if root is None:
                return value
            high: Sum = {}
            low: Sum = {}
            for monomial, c in value.above.items():
                powers = dict(monomial)
                if powers.get(root, 0) >= root.order:
                    powers[root] -= root.order
                    high[monomial_of(powers)] = c
                else:
                    low[monomial] = c
            base = self.meaning[root]
            parts = [_Quotient(product(high, base.above), base.below), _Quotient(low, {})]
            joined = self._sum(parts) if low else parts[0]
            below = dict(value.below)
            for key, power in joined.below.items():
                below[key] = below.get(key, 0) + power
            value = _Quotient(joined.above, below)

    def _inverse(self, value: _Quotient, key: Any) -> _Quotient:
        above = ONE
        for below, power in value.below.items():
            for _ in range(power):
                above = product(above, self.sums[below])
        if len(value.above) == 1:
            ((monomial, c),) = value.above.items()
            if not isinstance(c, sp.Basic) and not any(_is_root(e) for e, _ in monomial):
                inverse = {tuple((e, -p) for e, p in monomial): GAUSS.one / c}
                return _Quotient(product(above, inverse), {})
        self.sums[key] = value.above
        return self._reduced(_Quotient(above, {key: 1}))

    def _power(self, base: Any, exponent: int) -> _Quotient:
        factor = self.of(base)
        if exponent < 0:
            factor = self._inverse(factor, base)
        result = _Quotient(ONE, {})
        for _ in range(abs(exponent)):
            result = self._times(result, factor)
        return result

    def _root(self, base: Any, power: int, index: int) -> _Quotient:
        """Return base^(power/index) by whole powers of the base and of its root."""
        whole, part = divmod(power, index)
        root = Root(base, index)
        self.meaning[root] = self.of(base)
        return self._times(self._power(base, whole), _Quotient({((root, part),): GAUSS.one}, {}))


def _exponent(argument: Any) -> Monomial:
    """Write exp(argument) as a product of rational powers of exponentials of basic numbers."""
    powers: dict[Any, Any] = {}
    for term in sp.Add.make_args(argument):
        c, basic = term.as_coeff_Mul()
        powers[basic] = powers.get(basic, sp.QQ(0)) + sp.QQ(int(c.p), int(c.q))
    return monomial_of(powers)


def _rational(power: Any) -> Any:
    return sp.Rational(int(power.numerator), int(power.denominator))


def _pair(argument: Any, plus: Any, minus: Any) -> Sum:
    """Return plus exp(argument) + minus exp(-argument)."""
    return added(
        {_exponent(argument): coefficient_of(sp.sympify(plus, strict=True))},
        {_exponent(sp.expand(-argument)): coefficient_of(sp.sympify(minus, strict=True))},
    )


def _quotient(
    factor: Any, above: tuple[Any, Any], below: tuple[Any, Any] | None = None
) -> Callable[[Any], tuple[Sum, Sum | None]]:
    """Return the rule for a function of exp(+-factor x)."""

    def rule(argument: Any) -> tuple[Sum, Sum | None]:
        inner = sp.expand(factor * argument)
        return _pair(inner, *above), None if below is None else _pair(inner, *below)

    return rule


_HALF = sp.Rational(1, 2)
_RULES: Final = {
    sp.sinh: _quotient(1, (_HALF, -_HALF)),
    sp.cosh: _quotient(1, (_HALF, _HALF)),
    sp.tanh: _quotient(1, (1, -1), (1, 1)),
    sp.coth: _quotient(1, (1, 1), (1, -1)),
    sp.sin: _quotient(sp.I, (-sp.I * _HALF, sp.I * _HALF)),
    sp.cos: _quotient(sp.I, (_HALF, _HALF)),
    sp.tan: _quotient(sp.I, (-sp.I, sp.I), (1, 1)),
    sp.cot: _quotient(sp.I, (sp.I, sp.I), (1, -1)),
}
