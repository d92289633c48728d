"""Surfaces as height functions over their tangent plane, exactly and to any degree.

The jet is computed in an orthogonal frame (U, V, N) that is not normalized, so that no square root
enters the arithmetic; the lengths are divided out of the coefficients at the end. Where the
constants at the point do not form a field that is known, the same equations are solved in names
for the Taylor coefficients (`namedjets`).
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import sympy as sp

from pdtheory.errors import ExpressionError, InputError
from pdtheory.exact.coefficients import check_order, exact, exact_tuple, tidy
from pdtheory.exact.expansion import Expansion
from pdtheory.exact.faces import BinaryForm
from pdtheory.exact.fields import Field
from pdtheory.exact.frames import (
    Vector,
    cross,
    length,
    orthogonal_frame,
    text,
    triple,
    without_hidden_zero,
)
from pdtheory.exact.namedjets import implicit_by_names, parametric_by_names
from pdtheory.exact.powerseries import Series
from pdtheory.exact.reversion import eliminate, solve_height
from pdtheory.exact.surfacejet import SurfaceJet
from pdtheory.exact.zeros import is_zero


def explicit_jet(
    f: Any,
    variables: Sequence[Any],
    degree: int,
    at: Sequence[Any] = (0, 0),
    *,
    tangent: Sequence[Any] | None = None,
) -> SurfaceJet:
    """Return the jet of the graph z = f(x, y) over its tangent plane, the normal pointing up.

    Where the gradient vanishes this is the Taylor expansion of f itself.

    Parameters
    ----------
    f
        A SymPy expression.
    variables
        Its two variables.
    degree
        The degree K.
    at
        The point (x, y).
    tangent
        A vector of space whose projection gives t1; the x axis by default.

    Raises
    ------
    ExpressionError, InputError
        As for :func:`implicit_jet`.
    """
    f, (x, y) = exact(f), exact_tuple(variables, 2, "list of variables")
    x0, y0 = exact_tuple(at, 2, "point")
    z0 = tidy(f.subs({x: x0, y: y0}, simultaneous=True))
    if z0.has(sp.zoo, sp.nan, sp.oo, -sp.oo):
        raise ExpressionError(f"{f} has no value at {x} = {x0}, {y} = {y0}; choose another point.")
    z = sp.Dummy("z")
    return implicit_jet(z - f, (x, y, z), degree, (x0, y0, z0), tangent=tangent)


def implicit_jet(
    F: Any,
    variables: Sequence[Any],
    degree: int,
    at: Sequence[Any],
    *,
    tangent: Sequence[Any] | None = None,
) -> SurfaceJet:
    """Return the jet of the implicit surface F(x, y, z) = 0 at a point.

    The normal is the gradient of F: outward if F is negative inside.

    Parameters
    ----------
    F
        A SymPy expression.
    variables
        Its three variables.
    degree
        The degree K of the jet.
    at
        A point of the surface, exact.
    tangent
        A vector of space whose projection on the tangent plane gives t1; the x axis by default, or
        the y axis where the x axis is the normal.

    Raises
    ------
    InputError
        If the point is not on the surface, is singular (zero gradient), or `tangent` is normal.
    ExpressionError
        If F is not smooth at the point.
    ComputationError
        If the constants at the point are too long for exact division.
    """
    degree = check_order(degree, 1)
    point = triple(at, "point")
    variables = exact_tuple(variables, 3, "list of variables")
    F, place = exact(F), dict(zip(variables, point, strict=True))
    expansion = Expansion(F, place, degree)
    value = F.subs(place, simultaneous=True)
    if not is_zero(value):
        raise InputError(
            f"The point {text(point)} is not on the surface: F = {value} there instead of 0."
        )
    gradient = _derivatives(F, place)
    if not any(gradient):
        raise InputError(
            f"The gradient of F vanishes at {text(point)}: the point is singular and has no "
            "tangent plane."
        )
    axes = orthogonal_frame(gradient, tangent)
    field = Field([*expansion.constants, *point, *(c for W in axes for c in W)], "s,t,h")
    if not field.divides:
        return implicit_by_names(F, place, axes, degree)
    U, V, N = axes
    arguments = {
        w: field.series(degree, field.element(p), field.linear((u, v)), field.linear((0, 0, n)))
        for w, p, u, v, n in zip(variables, point, U, V, N, strict=True)
    }
    slope = sum((field.element(g) * field.element(n) for g, n in zip(gradient, N, strict=True)),
                field.domain.zero)  # fmt: skip
    equation = expansion.evaluate(field, arguments).scale(-field.domain.one / slope)
    height = solve_height(above_linear(equation, field), field)
    return _jet(point, axes, field, height)


def parametric_jet(
    X: Sequence[Any],
    variables: Sequence[Any],
    degree: int,
    at: Sequence[Any],
    *,
    tangent: Sequence[Any] | None = None,
) -> SurfaceJet:
    """Return the jet of the patch X(u, v) at a parameter point, by reversion of power series.

    The normal is X_u x X_v.

    Parameters
    ----------
    X
        The three coordinates as SymPy expressions.
    variables
        The parameters (u, v).
    degree
        The degree K.
    at
        The parameter values, exact.
    tangent
        As for :func:`implicit_jet`.

    Raises
    ------
    InputError
        If X_u and X_v are parallel at the point.
    ExpressionError
        If a coordinate is not smooth at the point.
    ComputationError
        If the constants at the point are too long for exact division.
    """
    degree = check_order(degree, 1)
    coordinates = triple(X, "patch")
    u, v = exact_tuple(variables, 2, "list of parameters")
    place = dict(zip((u, v), exact_tuple(at, 2, "point"), strict=True))
    expansions = [Expansion(c, place, degree, constant_matters=False) for c in coordinates]
    rows = [_derivatives(c, place) for c in coordinates]
    first, second = ([row[i] for row in rows] for i in (0, 1))
    normal = cross(first, second)
    if not any(normal):
        raise InputError(
            f"The patch is not regular at {u} = {place[u]}, {v} = {place[v]}: its two tangent "
            "vectors are parallel."
        )
    axes = orthogonal_frame(normal, tangent)
    point = tuple(tidy(c.subs(place, simultaneous=True)) for c in coordinates)
    constants = [*(c for e in expansions for c in e.constants), *first, *second]
    field = Field([*constants, *(c for W in axes for c in W)], "s,t")
    if not field.divides:
        return parametric_by_names(coordinates, place, (first, second), axes, degree)
    one = field.domain.one
    weights = []
    for W in axes:
        row = [field.element(c) for c in W]
        square = sum((w * w for w in row), field.domain.zero)
        weights.append([w / square for w in row])
    a, b, c, d = (
        sum((w * field.element(e) for w, e in zip(weights[i], X_w, strict=True)), field.domain.zero)
        for i in (0, 1)
        for X_w in (first, second)
    )
    # Parameters in which the first two components start with s and t themselves.
    scale = one / (a * d - b * c)
    s, t = field.variables
    needed = set().union(*(e.needed for e in expansions))
    arguments = {
        w: field.series(degree, field.element(place[w] if w in needed else 0), linear)
        for w, linear in ((u, (s * d - t * b) * scale), (v, (t * a - s * c) * scale))
    }
    series = [e.evaluate(field, arguments).without_constant() for e in expansions]
    components = [
        sum((x.scale(w) for x, w in zip(series[1:], row[1:], strict=True)), series[0].scale(row[0]))
        for row in weights
    ]
    height = eliminate(components, field)
    return _jet(point, axes, field, height)


def _derivatives(expression: Any, place: dict[Any, Any]) -> Vector:
    """Return the partial derivatives at a point, with exact zeros."""
    derivatives = (sp.diff(expression, w).subs(place, simultaneous=True) for w in place)
    return tuple(without_hidden_zero(tidy(c)) for c in derivatives)


def above_linear(series: Series, field: Field) -> Series:
    """Return -(equation) / slope without its constant and linear part, h included."""
    *_, h = field.variables
    zero = field.ring.zero
    return Series((zero, zero, series.terms[2] + h, *series.terms[3:]))


def _jet(
    point: Sequence[Any], axes: tuple[Vector, Vector, Vector], field: Field, height: Series
) -> SurfaceJet:
    """Divide the lengths of the axes out of a height function."""
    lengths = [length(W) for W in axes]
    forms = []
    for k, form in enumerate(field.forms(height)):
        factors = [lengths[2] / (lengths[0] ** (k - j) * lengths[1] ** j) for j in range(k + 1)]
        forms.append(
            BinaryForm(
                [_plain(a * factor) for a, factor in zip(form.coefficients, factors, strict=True)]
            )
        )
    frame = tuple(tuple(_plain(c / size) for c in W) for W, size in zip(axes, lengths, strict=True))
    return SurfaceJet(tuple(point), frame, tuple(forms))  # type: ignore[arg-type]


def _plain(value: Any) -> Any:
    """Return a number tidy, without roots in the denominator where it is algebraic."""
    return sp.radsimp(sp.expand(value)) if value.is_algebraic else tidy(value)
