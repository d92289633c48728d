"""Jets at points with several transcendental constants, in names for the Taylor coefficients.

Exponentials, cosines and their like at one point may depend on each other, so that nothing may be
divided by a polynomial in them unless it is proved not to vanish; and written out, the
coefficients of the height fill pages. The Taylor coefficients of the surface in its orthonormal
frame, divided by the slope, are short. They get names, and the coefficients of the height are
polynomials with rational coefficients in them.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from itertools import product
from math import prod
from typing import Any

import sympy as sp

from pdtheory.exact.fields import Field
from pdtheory.exact.frames import Vector, cross, length, without_hidden_zero
from pdtheory.exact.named import named
from pdtheory.exact.powerseries import Series
from pdtheory.exact.reversion import eliminate, solve_height
from pdtheory.exact.surfacejet import SurfaceJet
from pdtheory.exact.taylor import expand

Axes = tuple[Vector, Vector, Vector]
Indices = tuple[int, ...]


def implicit_by_names(F: Any, place: dict[Any, Any], axes: Axes, degree: int) -> SurfaceJet:
    """Return the jet of F = 0 at a regular point of it.

    The height is h = sum g_ijm s^i t^j h^m, where -|grad F| g_ijm are the Taylor coefficients of F
    in the orthonormal frame.

    Parameters
    ----------
    F
        A SymPy expression.
    place
        The value of its three variables at the point.
    axes
        Orthogonal U, V, N with N the gradient of F.
    degree
        The degree K.
    """
    frame = _normalized(axes)
    slope = length(axes[2])
    (series,), known = expand([F], place, degree)
    # Coordinates x - x0 as linear forms in (s, t, h); h is of degree 2.
    columns = [dict(enumerate(column)) for column in zip(*frame, strict=True)]
    local = _substituted(series, known, columns, lambda e: e[0] + e[1] + 2 * e[2] <= degree)
    constants = {
        e: _named("g", e, -c / slope)
        for e, c in local.items()
        if e != (0, 0, 1) and e[0] + e[1] + 2 * e[2] >= 2
    }
    field = Field(constants.values(), "s,t,h")
    equation = _graded(constants, field, degree, lambda e: e[0] + e[1] + 2 * e[2])
    return _named_jet(place.values(), frame, field, solve_height(equation, field))


def parametric_by_names(
    coordinates: Sequence[Any],
    place: dict[Any, Any],
    tangents: Sequence[Sequence[Any]],
    axes: Axes,
    degree: int,
) -> SurfaceJet:
    """Return the jet of a patch at a regular point of it.

    Parameters
    ----------
    coordinates
        The three coordinates as SymPy expressions.
    place
        The value of the two parameters.
    tangents
        The two tangent vectors X_u and X_v there.
    axes
        Orthogonal U, V, N with N along X_u x X_v.
    degree
        The degree K.
    """
    frame = _normalized(axes)
    (a, b), (c, d) = (
        [sum(p * q for p, q in zip(W, X_w, strict=True)) for X_w in tangents] for W in frame[:2]
    )
    # a d - b c, the area between the tangent vectors.
    determinant = length(cross(*tangents))
    # Parameters in which the components along t1 and t2 start with s and t themselves.
    columns = [
        {0: d / determinant, 1: -b / determinant},
        {0: -c / determinant, 1: a / determinant},
    ]
    series, known = expand(coordinates, place, degree, constant_matters=False)
    parts = [_substituted(s, known, columns, lambda e: sum(e) <= degree) for s in series]
    names: list[dict[Indices, Any]] = []
    for letter, W in zip("abc", frame, strict=True):
        indices = {e for part in parts for e in part if sum(e) >= 2}
        names.append(
            {
                e: _named(
                    letter, e, sum(w * part.get(e, 0) for w, part in zip(W, parts, strict=True))
                )
                for e in sorted(indices)
            }
        )
    field = Field((c for part in names for c in part.values()), "s,t")
    s, t, z = (_graded(part, field, degree, sum) for part in names)
    s, t = (
        Series((w.terms[0], variable, *w.terms[2:]))
        for w, variable in zip((s, t), field.variables, strict=True)
    )
    point = [x.subs(place, simultaneous=True) for x in coordinates]
    return _named_jet(point, frame, field, eliminate((s, t, z), field))


def _normalized(axes: Axes) -> Axes:
    """Return the axes divided by their lengths."""
    _, V, N = axes
    across, normal = length(V), length(N)
    # U = V x N has the product of both lengths: no third root.
    sizes = (across * normal, across, normal)
    return tuple(  # type: ignore[return-value]
        tuple(c / size for c in W) for W, size in zip(axes, sizes, strict=True)
    )


def _named(letter: str, indices: Indices, value: Any) -> Any:
    """Return a coefficient under its name, an exact 0 if it vanishes."""
    return named(f"{letter}_{''.join(map(str, indices))}", without_hidden_zero(value))


def _substituted(
    series: Series,
    field: Field,
    linear: Sequence[dict[int, Any]],
    wanted: Callable[[Indices], bool],
) -> dict[Indices, Any]:
    """Substitute linear forms for the variables of a Taylor series, without expanding anything.

    Parameters
    ----------
    series
        The Taylor series.
    field
        The field of its coefficients.
    linear
        For each variable the coefficients of a linear form, by the index of the new variable.
    wanted
        Whether a monomial of the result, given by its exponents, is wanted.
    """
    count = 1 + max(i for form in linear for i in form)
    result: dict[Indices, Any] = {}
    powers = [_Powers(form, count) for form in linear]
    for term in series.terms[1:]:
        for exponents, c in term.terms():
            value = field.expression(c)
            if not value:
                continue
            factors = [p.of(e) for p, e in zip(powers, exponents, strict=True)]
            for choice in product(*(f.items() for f in factors)):
                total = tuple(map(sum, zip(*(e for e, _ in choice), strict=True)))
                if wanted(total):
                    part = value * prod((f for _, f in choice), start=sp.Integer(1))
                    result[total] = result.get(total, sp.Integer(0)) + part
    return result


class _Powers:
    """The powers of one linear form by the exponents of their monomials."""

    def __init__(self, form: dict[int, Any], count: int) -> None:
        self.form = [form.get(i, sp.Integer(0)) for i in range(count)]

    def of(self, exponent: int) -> dict[Indices, Any]:
        """Return the multinomial expansion of a power."""
        return {
            e: sp.Integer(c) * prod((f**i for f, i in zip(self.form, e, strict=True)),
                                    start=sp.Integer(1))
            for e, c in sp.ntheory.multinomial_coefficients(len(self.form), exponent).items()
            if all(f for f, i in zip(self.form, e, strict=True) if i)
        }  # fmt: skip


def _graded(
    constants: dict[Indices, Any], field: Field, degree: int, weight: Callable[[Indices], int]
) -> Series:
    """Return the series with the given coefficients, each monomial in the part of its degree."""
    parts = [field.ring.zero] * (degree + 1)
    for e, c in constants.items():
        parts[weight(e)] += field.ring({e: field.element(c)})
    return Series(tuple(parts))


def _named_jet(point: Any, frame: Axes, field: Field, height: Series) -> SurfaceJet:
    return SurfaceJet(tuple(point), frame, tuple(field.forms(height)))
