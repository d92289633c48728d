"""Tools of the certificates: steps that are identities or facts, and calculus on monomials.

They are written with plain SymPy and share no code with :mod:`pdtheory.exact`, so that a
certificate does not rest on what it checks.
"""

from __future__ import annotations

from collections.abc import Iterable
from fractions import Fraction
from typing import Any

import sympy as sp

from pdtheory.paper.claims.core import Shows, Step

#: Variables and exponents. An identity between monomials with symbolic exponents, found for
#: positive x and y, is one of polynomials for every value of the exponents.
x, y = sp.symbols("x y", positive=True)
k, i, n = sp.symbols("k i n", integer=True, positive=True)
t = sp.Symbol("t", real=True)


def vanish(expression: Any) -> Any:
    """Reduce an expression that ought to be zero; the result is 0 only if it is zero."""
    expression = sp.sympify(expression)
    for reduce in (sp.expand, _multiples, _as_exponentials, sp.combsimp, sp.simplify):
        if expression == 0:
            return expression
        expression = reduce(expression)
    return expression


def _multiples(expression: Any) -> Any:
    """Expand angles that are sums and multiples, and roots of unity."""
    if not expression.free_symbols:
        expression = sp.expand_complex(expression)
    return sp.expand(sp.expand_trig(expression))


def _as_exponentials(expression: Any) -> Any:
    if not expression.has(sp.cos, sp.sin, sp.exp, sp.tan):
        return sp.powsimp(sp.expand(expression))
    return sp.expand(sp.powsimp(sp.expand(expression.rewrite(sp.exp), power_exp=False)))


def fact(text: str, holds: Any, *, shows: Shows = Shows.PROOF, **data: Any) -> Step:
    """Make a step from a condition that was computed."""
    return Step(
        shows, text, bool(holds), {name: str(_plain(value)) for name, value in data.items()}
    )


def _plain(value: Any) -> Any:
    """Write fractions inside containers as 1/2."""
    if isinstance(value, Fraction):
        return sp.Rational(value)
    if isinstance(value, dict):
        return {key: _plain(entry) for key, entry in value.items()}
    if isinstance(value, (list, tuple)):
        return type(value)(map(_plain, value))
    return value


def identity(
    text: str, left: Any, right: Any = 0, *, over: Any = 1, shows: Shows = Shows.PROOF
) -> Step:
    """Make a step that holds if `left` equals `right` identically.

    Parameters
    ----------
    text
        What the identity says.
    left, right
        The two sides. Derivatives, integrals and limits may be unevaluated, and are shown so; a
        side that SymPy would simplify at once is given as a function, and shown as it is written.
    over
        A factor that is not 0, by which the difference is divided to simplify it.
    shows
        Part of the identity in the certificate.
    """
    values = [side() if _is_function(side) else sp.sympify(side) for side in (left, right)]
    rest = vanish((values[0] - values[1]).doit() / over)
    shown = " = ".join(map(_written, (left, right)))
    return fact(text, rest == 0, shows=shows, identity=shown, difference=rest)


def _written(side: Any) -> str:
    if not _is_function(side):
        return str(side)
    with sp.evaluate(False):
        raw = side()
    return sp.sstr(raw, order="none")


def _is_function(side: Any) -> bool:
    return callable(side) and not isinstance(side, sp.Basic)


def differs(text: str, left: Any, right: Any, *, shows: Shows) -> Step:
    """Make a step that holds if `left` and `right` are proved to differ."""
    rest = vanish(left - right)
    return fact(
        text, rest.is_zero is False, shows=shows, inequality=f"{left} != {right}", difference=rest
    )


def angular(f: Any, a: Any = x, b: Any = y) -> Any:
    """Return F = x f_y - y f_x, the derivative of f along the circle."""
    return a * sp.diff(f, b) - b * sp.diff(f, a)


def radial(f: Any, a: Any = x, b: Any = y) -> Any:
    """Return x f_x + y f_y, which is k f for a form of order k."""
    return a * sp.diff(f, a) + b * sp.diff(f, b)


def tensor_on(f: Any, order: Any, a: Any = x, b: Any = y) -> tuple[Any, Any]:
    """Return T v^(k-1), the gradient of f = T v^k divided by k."""
    return sp.diff(f, a) / order, sp.diff(f, b) / order


def product_of_sines(angles: Iterable[Any]) -> Any:
    """Return prod_j sin(t - t_j)."""
    return sp.prod([sp.sin(t - angle) for angle in angles])
