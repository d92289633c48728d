"""What a regression of degree K finds at the apex of a cone as the samples become dense."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from typing import Any

import mpmath
import numpy as np
import numpy.typing as npt
import sympy as sp

from pdtheory.conventions import DEFAULT_DEGREE, frequencies, wavejets_table
from pdtheory.errors import InputError
from pdtheory.exact.coefficients import exact
from pdtheory.exact.cones import Cone
from pdtheory.exact.eigenpairs import EigenPairs, real_eigenpairs
from pdtheory.exact.enclosing import rounded
from pdtheory.exact.frames import without_hidden_zero
from pdtheory.exact.moments import (
    Measure,
    Weight,
    check_fit,
    coefficient_numbers,
    radial_moment,
)
from pdtheory.exact.wavejets import WavejetsRow

#: Decimal digits to which the transcendental coefficients are rounded.
DIGITS = 60
#: Nodes of the quadrature in each sector and working digits, for samples on the surface.
NODES, WORKING_DIGITS = 64, 50


@dataclass(frozen=True)
class ConePrediction:
    """The Wavejets coefficients that the weighted fit of a cone has, and its directions.

    Attributes
    ----------
    cone : Cone
        The cone.
    degree : int
        Degree K of the fit.
    rows : dict of int to WavejetsRow
        The row of every order asked for, with coefficients rounded to 60 digits (flat measure) or
        30 (surface measure); a row with one frequency has its exact phase, so that its directions
        are exact.
    """

    cone: Cone
    degree: int
    rows: dict[int, WavejetsRow]

    @property
    def orders(self) -> tuple[int, ...]:
        """The orders asked for."""
        return tuple(self.rows)

    def row(self, order: int) -> WavejetsRow:
        """Return the Wavejets row of one order."""
        if order not in self.rows:
            raise InputError(f"The order {order} was not predicted; the orders are {self.orders}.")
        return self.rows[order]

    def eigenpairs(self, order: int) -> EigenPairs:
        """Return the directions of one order."""
        return real_eigenpairs(self.row(order))

    def numeric_phi(self) -> npt.NDArray[np.complex128]:
        """Return phi as a (C,) array in the order of `wavejets_table`; NaN where not asked for."""
        rows = {k: row.to_complex() for k, row in self.rows.items()}
        return np.array(
            [rows[k][n] if k in rows else complex(np.nan) for k, n in wavejets_table(self.degree)]
        )


def predict(
    cone: Cone,
    degree: int = DEFAULT_DEGREE,
    orders: Iterable[int] | None = None,
    *,
    weight: Weight = "gaussian",
    measure: Measure = "flat",
    radius: Any = 1,
    constant: bool = True,
) -> ConePrediction:
    """Return what the continuous weighted least squares fit at the apex of a cone finds.

    Parameters
    ----------
    cone
        The cone, in the frame of its own axis.
    degree
        Degree K of the fit, at most 30 (16 for the surface measure).
    orders
        The orders wanted; all from 2 to K by default.
    weight
        "gaussian", exp(-9 rho^2 / 2), or "uniform".
    measure
        "flat": samples uniform in the plane, weights by the planar distance, the disc of radius R;
        closed form. "surface": samples uniform on the surface, weights by the distance in space,
        the ball of radius R; quadrature with 50 digits.
    radius
        R, exact.
    constant
        Whether the fit has a constant term.

    Raises
    ------
    InputError
        If the degree, an order, the weight, the measure or the radius cannot be used.
    """
    check_fit(degree, weight)
    wanted = tuple(range(2, degree + 1)) if orders is None else tuple(sorted(set(orders)))
    for k in wanted:
        if not 1 <= k <= degree:
            raise InputError(
                f"The order is {k}; a fit of degree {degree} has the orders 1 to {degree}."
            )
    R = exact(radius)
    if not (R.is_real and R > 0):
        raise InputError(f"The radius is {radius}; it must be a positive number.")
    if measure == "flat":
        rows = {k: _flat_row(cone, k, degree, weight, constant) for k in wanted}
    elif measure == "surface":
        rows = _surface_rows(cone, wanted, degree, weight, constant)
    else:
        raise InputError(f"The measure {measure!r} is not known; use 'flat' or 'surface'.")
    if R != 1:
        rows = {k: row * rounded(R ** (1 - k), DIGITS) for k, row in rows.items()}
    return ConePrediction(cone, degree, rows)


def _flat_row(cone: Cone, order: int, degree: int, weight: Weight, constant: bool) -> WavejetsRow:
    sums = {n: cone.jump_sum(n) for n in frequencies(order) if n != 1}
    waves = {n: (without_hidden_zero(a), without_hidden_zero(b)) for n, (a, b) in sums.items()}
    present = {n: wave for n, wave in waves.items() if any(wave)}
    if order == 1:
        present[1] = cone.fourier_parts(1)
    phi = {}
    for n, wave in present.items():
        c = coefficient_numbers(n, degree, weight, constant)[order]
        # The sums are 2 pi (1 - n^2) h_n.
        scale = c if n == 1 else c / (2 * sp.pi * (1 - n**2))
        parts = [rounded(scale * part, DIGITS) if part else sp.Integer(0) for part in wave]
        if len(present) == 1:
            parts = _with_exact_phase(parts, cone.fourier_parts(n))
        phi[n] = parts[0] + sp.I * parts[1]
    return WavejetsRow(order, phi)


def _with_exact_phase(parts: list[Any], wave: tuple[Any, Any]) -> list[Any]:
    """Keep the phase of the only frequency, which the directions follow, if it is short."""
    if any(part.has(sp.Function) for part in wave):
        return parts
    lead = next(i for i, part in enumerate(parts) if part)
    return [parts[lead] * sp.radsimp(part / wave[lead]) for part in wave]


def _surface_rows(
    cone: Cone, orders: tuple[int, ...], degree: int, weight: Weight, constant: bool
) -> dict[int, WavejetsRow]:
    """Solve the normal equations, r = rho / sqrt(1 + h^2): radial moments by angle integrals."""
    if degree > 16:
        raise InputError(f"The degree is {degree}; the surface measure goes up to 16.")
    basis = [(k, n) for k in range(0 if constant else 1, degree + 1) for n in range(-k, k + 1, 2)]
    with mpmath.workdps(WORKING_DIGITS):
        moments = [mpmath.mpf(sp.N(radial_moment(m, weight), WORKING_DIGITS))
                   for m in range(2 * degree + 2)]  # fmt: skip
        nodes = _angular_nodes(cone)
        plain = _angular_integrals(nodes, lambda g, h, m: g ** (-m - 2), 2 * degree)
        heights = _angular_integrals(nodes, lambda g, h, m: h * g ** (-m - 3), degree)
        matrix = mpmath.matrix(len(basis), len(basis))
        right = mpmath.matrix(len(basis), 1)
        for i, (k, n) in enumerate(basis):
            for j, (k2, n2) in enumerate(basis):
                matrix[i, j] = moments[k + k2 + 1] * plain[k + k2, n - n2]
            right[i] = moments[k + 2] * heights[k, n]
        solution = mpmath.lu_solve(matrix, right)
        phi = {kn: solution[i] for i, kn in enumerate(basis)}
        return {
            k: WavejetsRow(k, {n: _rounded(phi[k, n], n) for n in frequencies(k)}) for k in orders
        }


def _angular_nodes(cone: Cone) -> list[tuple[Any, Any, Any]]:
    """Return (angle, h, weight times area factor) of a Gauss-Legendre rule in every sector."""
    abscissae, weights = _gauss_legendre(NODES)
    nodes = []
    for (start, _), width, gradient in zip(cone.rays, cone.widths, cone.gradients, strict=True):
        p, q = (mpmath.mpf(sp.N(c, WORKING_DIGITS)) for c in gradient)
        first, span = (mpmath.radians(mpmath.mpf(sp.N(a, WORKING_DIGITS))) for a in (start, width))
        area = mpmath.sqrt(1 + p**2 + q**2)
        for s, w in zip(abscissae, weights, strict=True):
            angle = first + span * (1 + s) / 2
            height = p * mpmath.cos(angle) + q * mpmath.sin(angle)
            nodes.append((angle, height, w * span / 2 * area))
    return nodes


def _gauss_legendre(count: int) -> tuple[list[Any], list[Any]]:
    starts, _ = np.polynomial.legendre.leggauss(count)
    abscissae, weights = [], []
    for start in starts:
        s = mpmath.mpf(float(start))
        for _ in range(4):
            # Newton doubles the digits: four steps from double precision pass 50.
            value, before = _legendre(count, s)
            slope = count * (s * value - before) / (s**2 - 1)
            s -= value / slope
        value, before = _legendre(count, s)
        slope = count * (s * value - before) / (s**2 - 1)
        abscissae.append(s)
        weights.append(2 / ((1 - s**2) * slope**2))
    return abscissae, weights


def _legendre(count: int, s: Any) -> tuple[Any, Any]:
    before, value = mpmath.mpf(1), s
    for j in range(2, count + 1):
        before, value = value, ((2 * j - 1) * s * value - (j - 1) * before) / j
    return value, before


def _angular_integrals(
    nodes: list[tuple[Any, Any, Any]], factor: Callable[[Any, Any, int], Any], most: int
) -> dict[tuple[int, int], Any]:
    """Return the integrals of J factor(g, h, m) exp(-i j theta) by (m, j), g^2 = 1 + h^2."""
    waves = [[mpmath.expj(-j * angle) for angle, _, _ in nodes] for j in range(most + 1)]
    table: dict[tuple[int, int], Any] = {}
    for m in range(most + 1):
        values = [w * factor(mpmath.sqrt(1 + h * h), h, m) for _, h, w in nodes]
        for j in range(m % 2, most + 1, 2):
            total = mpmath.fdot(values, waves[j])
            table[m, j], table[m, -j] = total, mpmath.conj(total)
    return table


def _rounded(value: Any, n: int) -> Any:
    """Return a computed coefficient as an exact number; what is rounding only becomes zero."""
    parts = [value.real, value.imag if n else mpmath.mpf(0)]
    real, imaginary = (
        sp.Rational(mpmath.nstr(p, 30)) if abs(p) > mpmath.mpf(10) ** -30 else sp.Integer(0)
        for p in parts
    )
    return real + sp.I * imaginary
