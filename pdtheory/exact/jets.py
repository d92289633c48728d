"""Surfaces as height functions over their tangent plane, exactly and to any degree.

The jet is computed in an orthogonal frame (U, V, N) that is not normalized, so that no square root
enters the arithmetic; the lengths are divided out of the coefficients at the end.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt
import sympy as sp

from pdtheory.conventions import wavejets_table
from pdtheory.errors import ExpressionError, InputError
from pdtheory.exact.coefficients import check_order, exact, is_zero
from pdtheory.exact.faces import BinaryForm
from pdtheory.exact.series import Expansion, Field, Series
from pdtheory.exact.tensor import SymmetricTensor
from pdtheory.exact.wavejets import WavejetsRow

if TYPE_CHECKING:
    from pdtheory.exact.eigenpairs import EigenPairs

Vector = tuple[Any, Any, Any]


@dataclass(frozen=True)
class SurfaceJet:
    """A surface near a point as z(s, t) = sum_k T_k (s, t)^k / k! over its tangent plane.

    Attributes
    ----------
    point : tuple of 3
        The point, exact.
    frame : tuple of 3 tuples of 3
        Rows t1, t2, n, orthonormal and right-handed, exact; s runs along t1, t along t2, z along n.
    forms : tuple of BinaryForm
        T_k v^k for k = 0 to K; those of orders 0 and 1 vanish.
    """

    point: Vector
    frame: tuple[Vector, Vector, Vector]
    forms: tuple[BinaryForm, ...]

    @property
    def degree(self) -> int:
        """The degree K of the jet."""
        return len(self.forms) - 1

    def form(self, order: int) -> BinaryForm:
        """Return the binary form T_k v^k."""
        if not 0 <= order <= self.degree:
            raise InputError(f"The order is {order}; this jet knows the orders 0 to {self.degree}.")
        return self.forms[order]

    def tensor(self, order: int) -> SymmetricTensor:
        """Return the differential tensor T_k of the height function."""
        return self.form(order).tensor

    def row(self, order: int) -> WavejetsRow:
        """Return the Wavejets row of order k."""
        return self.form(order).row

    def eigenpairs(self, order: int) -> EigenPairs:
        """Return the principal directions of order k with their eigenvalues."""
        return self.form(order).eigenpairs()

    @cached_property
    def wavejets(self) -> dict[tuple[int, int], Any]:
        """The exact coefficients phi_{k,n} by (k, n), in storage order."""
        return {(k, n): self.row(k)[n] for k, n in wavejets_table(self.degree)}

    def principal_curvatures(self) -> tuple[Any, Any]:
        """Return the two principal curvatures with respect to n, the larger first, exactly."""
        a, b, c = self.tensor(2).components
        middle, spread = (a + c) / 2, sp.sqrt(sp.expand(((a - c) / 2) ** 2 + b**2))
        return sp.expand(middle + spread), sp.expand(middle - spread)

    def numeric_phi(self) -> npt.NDArray[np.complex128]:
        """Return phi as a (C,) complex array in the storage order of `wavejets_table`."""
        rows = {k: self.row(k).to_complex() for k in range(self.degree + 1)}
        return np.array([rows[k][n] for k, n in wavejets_table(self.degree)])

    def numeric_frame(self) -> npt.NDArray[np.float64]:
        """Return the frame as a (3, 3) array with rows t1, t2, n."""
        return np.array([[float(c) for c in row] for row in self.frame])


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
    f, (x, y) = exact(f), variables
    x0, y0 = (exact(c) for c in at)
    z0 = sp.expand(f.subs({x: x0, y: y0}, simultaneous=True))
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
    point = _triple(at, "point")
    if len(variables) != 3:
        raise InputError(f"An implicit surface needs three variables, not {variables}.")
    place = dict(zip(variables, point, strict=True))
    expansion = Expansion(F, place, degree)
    value = exact(F).subs(place, simultaneous=True)
    if not is_zero(value):
        raise InputError(
            f"The point {_text(point)} is not on the surface: F = {value} there instead of 0."
        )
    gradient = _gradient(exact(F), variables, place)
    if all(is_zero(c) for c in gradient):
        raise InputError(
            f"The gradient of F vanishes at {_text(point)}: the point is singular and has no "
            "tangent plane."
        )
    U, V, N = _orthogonal_frame(gradient, tangent)
    field = Field([*expansion.constants, *point, *U, *V, *N])
    field.check_division()
    base = [field.affine(p, u, v, degree) for p, u, v in zip(point, U, V, strict=True)]
    normal = [field.element(c) for c in N]
    slope = field.element(1) / sum(
        (field.element(g) * n for g, n in zip(gradient, normal, strict=True)), field.element(0)
    )
    height = field.constant(0, degree)
    # With the derivative frozen at the point each step makes one more degree right.
    for _ in range(2, degree + 1):
        arguments = {
            x: b + height.scale(n) for x, b, n in zip(variables, base, normal, strict=True)
        }
        height = height - expansion.evaluate(field, arguments).scale(slope)
    return _jet(point, (U, V, N), field, height)


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
    coordinates = _triple(X, "patch")
    u, v = variables
    place = {u: exact(at[0]), v: exact(at[1])}
    expansions = [Expansion(c, place, degree, constant_matters=False) for c in coordinates]
    first, second = (
        tuple(sp.expand(sp.diff(c, w).subs(place, simultaneous=True)) for c in coordinates)
        for w in variables
    )
    normal = _cross(first, second)
    if all(is_zero(c) for c in normal):
        raise InputError(
            f"The patch is not regular at {u} = {place[u]}, {v} = {place[v]}: its two tangent "
            "vectors are parallel."
        )
    U, V, N = _orthogonal_frame(normal, tangent)
    field = Field([*(c for e in expansions for c in e.constants), *U, *V, *N])
    field.check_division()
    arguments = field.variables(expansions, u, v, degree)
    series = [e.evaluate(field, arguments) for e in expansions]
    point = tuple(sp.expand(c.subs(place, simultaneous=True)) for c in coordinates)
    s, t, z = (_component(series, field, W) for W in (U, V, N))
    du, dv = _reversion(s, t, field)
    return _jet(point, (U, V, N), field, z.substitute(du, dv))


def _component(series: Sequence[Series], field: Field, W: Vector) -> Series:
    """Return <X - X0, W> / |W|^2."""
    weights = [field.element(c) for c in W]
    norm = sum((w * w for w in weights), field.element(0))
    scaled = [c.without_constant().scale(w / norm) for c, w in zip(series, weights, strict=True)]
    return scaled[0] + scaled[1] + scaled[2]


def _reversion(s: Series, t: Series, field: Field) -> tuple[Series, Series]:
    """Return the series (u, v) of (s, t) inverse to (s, t) of (u, v)."""
    a, b = _linear(s, field)
    c, d = _linear(t, field)
    determinant = a * d - b * c
    x, y = field.ring.gens
    zero = field.ring.zero
    u, v = Series((zero, zero)), Series((zero, zero))
    for degree in range(1, s.degree + 1):
        # What the terms above degree 1 add, known from the degrees found so far.
        u, v = u.extend(degree), v.extend(degree)
        rest = [_above_linear(w.truncate(degree)).substitute(u, v) for w in (s, t)]
        target = [
            Series((r.terms[0], g - r.terms[1], *(-e for e in r.terms[2:])))
            for r, g in zip(rest, (x, y), strict=True)
        ]
        u = target[0].scale(d / determinant) - target[1].scale(b / determinant)
        v = target[1].scale(a / determinant) - target[0].scale(c / determinant)
    return u, v


def _linear(series: Series, field: Field) -> tuple[Any, Any]:
    x, y = field.ring.gens
    return series.terms[1].coeff(x), series.terms[1].coeff(y)


def _above_linear(series: Series) -> Series:
    zero = series.terms[0] * 0
    return Series((zero, zero, *series.terms[2:]))


def _jet(
    point: Sequence[Any], axes: tuple[Vector, Vector, Vector], field: Field, height: Series
) -> SurfaceJet:
    """Divide the lengths of the axes out of a height function."""
    lengths = [sp.sqrtdenest(sp.sqrt(sp.expand(sum(c**2 for c in W)))) for W in axes]
    forms = []
    for k, form in enumerate(field.forms(height)):
        factors = [lengths[2] / (lengths[0] ** (k - j) * lengths[1] ** j) for j in range(k + 1)]
        forms.append(
            BinaryForm(
                [
                    sp.radsimp(sp.expand(a * factor)) if a else a
                    for a, factor in zip(form.coefficients, factors, strict=True)
                ]
            )
        )
    frame = tuple(
        tuple(sp.radsimp(c / length) for c in W) for W, length in zip(axes, lengths, strict=True)
    )
    return SurfaceJet(tuple(point), frame, tuple(forms))  # type: ignore[arg-type]


def _orthogonal_frame(
    normal: Sequence[Any], tangent: Sequence[Any] | None
) -> tuple[Vector, Vector, Vector]:
    """Return orthogonal U, V, N, right-handed, with U the projection of the tangent vector."""
    N = _shortened(normal)
    wanted = [_triple(tangent, "tangent vector")] if tangent is not None else []
    one, zero = sp.Integer(1), sp.Integer(0)
    for candidate in wanted or [(one, zero, zero), (zero, one, zero)]:
        along = _dot(candidate, N)
        square = _dot(N, N)
        U = _shortened(
            [sp.expand(square * c - along * n) for c, n in zip(candidate, N, strict=True)]
        )
        if not all(is_zero(c) for c in U):
            return U, _shortened(_cross(N, U)), N
    raise InputError(f"The tangent vector {_text(wanted[0])} is normal to the surface.")


def _shortened(vector: Sequence[Any]) -> Vector:
    """Divide a rational vector by the positive rational that makes it primitive."""
    if all(c.is_Rational for c in vector) and any(vector):
        scale = sp.ilcm(*(c.q for c in vector))
        content = sp.igcd(*(c * scale for c in vector))
        vector = [c * scale / content for c in vector]
    x, y, z = vector
    return x, y, z


def _cross(a: Sequence[Any], b: Sequence[Any]) -> Vector:
    return (
        sp.expand(a[1] * b[2] - a[2] * b[1]),
        sp.expand(a[2] * b[0] - a[0] * b[2]),
        sp.expand(a[0] * b[1] - a[1] * b[0]),
    )


def _dot(a: Sequence[Any], b: Sequence[Any]) -> Any:
    return sp.expand(sum(p * q for p, q in zip(a, b, strict=True)))


def _gradient(F: Any, variables: Sequence[Any], place: dict[Any, Any]) -> Vector:
    x, y, z = (sp.expand(sp.diff(F, w).subs(place, simultaneous=True)) for w in variables)
    return x, y, z


def _triple(values: Sequence[Any], what: str) -> Vector:
    if len(values) != 3:
        raise InputError(f"The {what} needs three coordinates, not {len(values)}.")
    x, y, z = (exact(c) for c in values)
    return x, y, z


def _text(vector: Sequence[Any]) -> str:
    return f"({', '.join(str(c) for c in vector)})"
