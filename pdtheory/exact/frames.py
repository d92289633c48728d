"""Orthogonal frames of tangent planes, exactly and without square roots until the end."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import sympy as sp

from pdtheory.errors import InputError
from pdtheory.exact.coefficients import exact_tuple, tidy
from pdtheory.exact.separation import extent
from pdtheory.exact.zeros import is_zero

Vector = tuple[Any, Any, Any]


def orthogonal_frame(
    normal: Sequence[Any], tangent: Sequence[Any] | None
) -> tuple[Vector, Vector, Vector]:
    """Return orthogonal U, V, N, right-handed, with U along the projection of the tangent vector.

    Parameters
    ----------
    normal
        A normal vector, not zero.
    tangent
        A vector that is not normal; by default the x axis, or the y axis where the x axis is.

    Raises
    ------
    InputError
        If `tangent` is normal.
    """
    N = _shortened(normal)
    wanted = [triple(tangent, "tangent vector")] if tangent is not None else []
    one, zero = sp.Integer(1), sp.Integer(0)
    for candidate in wanted or [(one, zero, zero), (zero, one, zero)]:
        V = _shortened(cross(N, candidate))
        if not all(is_zero(c) for c in V):
            return _shortened(cross(V, N)), V, N
    raise InputError(f"The tangent vector {text(wanted[0])} is normal to the surface.")


def length(vector: Sequence[Any]) -> Any:
    """Return |v|; sums of transcendental numbers and of towers of roots are not expanded."""
    square = sum(c**2 for c in vector)
    if all(c.is_algebraic for c in vector) and extent(vector).is_small:
        return sp.sqrtdenest(sp.sqrt(sp.expand(square)))
    return sp.sqrt(square)


def cross(a: Sequence[Any], b: Sequence[Any]) -> Vector:
    """Return the vector product, with exact zeros."""
    products = (
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    )
    x, y, z = (without_hidden_zero(tidy(c)) for c in products)
    return x, y, z


def without_hidden_zero(value: Any) -> Any:
    """Return an exact number, as the integer 0 if it is zero."""
    return sp.Integer(0) if is_zero(value) else value


def triple(values: Sequence[Any], what: str) -> Vector:
    """Return three exact numbers.

    Raises
    ------
    InputError
        If there are not three.
    """
    x, y, z = exact_tuple(values, 3, what)
    return x, y, z


def text(vector: Sequence[Any]) -> str:
    """Return a vector for people."""
    return f"({', '.join(str(c) for c in vector)})"


def _shortened(vector: Sequence[Any]) -> Vector:
    """Divide a rational vector by the positive rational that makes it primitive."""
    if all(c.is_Rational for c in vector) and any(vector):
        scale = sp.ilcm(*(c.q for c in vector))
        content = sp.igcd(*(c * scale for c in vector))
        vector = [c * scale / content for c in vector]
    x, y, z = vector
    return x, y, z
