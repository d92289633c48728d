"""Number fields by generators, each found once: finding one takes SymPy up to a second."""

from __future__ import annotations

from collections.abc import Iterable
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
    return field, [_composed(number, field, known) for number in listed]


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
    if node.is_Add or node.is_Mul or (node.is_Pow and node.exp.is_Integer):
        for part in node.args:
            _collect(part, roots)
    else:
        roots[_root(node) if node.is_Pow and node.exp.is_Rational else node] = None


def _composed(node: Any, field: Any, known: dict[Any, Any]) -> Any:
    if node in known:
        return known[node]
    if node.is_Rational:
        return field.convert(sp.QQ(int(node.p), int(node.q)), sp.QQ)
    if node.is_Pow and node.exp.is_Rational:
        whole = node.exp.is_Integer
        base = _composed(node.base, field, known) if whole else known[_root(node)]
        power = int(node.exp.p)
        return base**power if power >= 0 else (field.one / base) ** -power
    parts = [_composed(part, field, known) for part in node.args]
    return sum(parts, field.zero) if node.is_Add else reduce(mul, parts)
