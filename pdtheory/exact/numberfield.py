"""Number fields by generators, each found once: finding one takes SymPy up to a second."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from functools import lru_cache, reduce
from operator import mul
from typing import Any

import sympy as sp


def in_number_field(numbers: Iterable[Any]) -> tuple[Any, list[Any]]:
    """Return a field that holds some algebraic numbers, and the numbers as its elements.

    Parameters
    ----------
    numbers
        Algebraic numbers as SymPy expressions.

    Returns
    -------
    field : sympy.Domain
        QQ, or QQ(a) with one generator a.
    elements : list
        The numbers.
    """
    listed = list(numbers)
    roots: dict[Any, None] = {}
    for number in listed:
        _collect(number, roots)
    field, known = _generated(tuple(sorted(roots, key=sp.default_sort_key)))

    def element(node: Any) -> Any:
        if node in known:
            return known[node]
        if node.is_Pow and not node.exp.is_Integer:
            return power(known[_root(node)], int(node.exp.p), field)
        return composed(node, field, element)

    return field, [element(number) for number in listed]


def is_composed(node: Any) -> bool:
    """Return whether an expression is a sum, a product or a whole power."""
    return bool(node.is_Add or node.is_Mul or (node.is_Pow and node.exp.is_Integer))


def composed(node: Any, domain: Any, element: Callable[[Any], Any]) -> Any:
    """Return a rational number, a sum, a product or a whole power as an element of a domain.

    Parameters
    ----------
    node
        A SymPy expression.
    domain
        A SymPy domain that contains the rational numbers.
    element
        Returns the terms, the factors or the base as elements.
    """
    if node.is_Rational:
        return domain.convert(sp.QQ(int(node.p), int(node.q)), sp.QQ)
    if node.is_Pow:
        return power(element(node.base), int(node.exp), domain)
    parts = [element(part) for part in node.args]
    return sum(parts, domain.zero) if node.is_Add else reduce(mul, parts)


def power(base: Any, exponent: int, domain: Any) -> Any:
    """Return a whole power of an element of a domain."""
    return base**exponent if exponent >= 0 else (domain.one / base) ** -exponent


@lru_cache(maxsize=64)
def _generated(roots: tuple[Any, ...]) -> tuple[Any, dict[Any, Any]]:
    field, elements = sp.construct_domain([*roots, sp.Integer(1)], extension=True, field=True)
    return field, dict(zip(roots, elements, strict=False))


def _root(power: Any) -> Any:
    """Return b^(1/q) for b^(p/q)."""
    return power.base ** sp.Rational(1, power.exp.q)


def _collect(node: Any, roots: dict[Any, None]) -> None:
    if node.is_Rational:
        return
    if is_composed(node):
        for part in node.args:
            _collect(part, roots)
    else:
        roots[_root(node) if node.is_Pow and node.exp.is_Rational else node] = None
