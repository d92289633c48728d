"""The height over the tangent plane from a local equation or a local parametrization.

Both are reversions of power series whose linear part is solved before, so that no division is
left: the coefficients of the height are polynomials with integer coefficients in those given.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from sympy.polys.rings import ring

from pdtheory.exact.fields import Field
from pdtheory.exact.powerseries import Series

Part = dict[tuple[int, int], Any]


def solve_height(equation: Series, field: Field) -> Series:
    """Return h(s, t) with h = sum g_ijm s^i t^j h^m.

    Parameters
    ----------
    equation
        The right hand side in the variables (s, t, h), h being of degree 2; it has no constant or
        linear part.
    field
        The field of the coefficients.

    Returns
    -------
    Series
        The height in the variables (s, t), to the same degree.
    """
    degree, zero = equation.degree, field.domain.zero
    # powers[m][d] is the part of degree d of h^m.
    powers: dict[int, dict[int, Part]] = {0: {0: {(0, 0): field.domain.one}}, 1: {}}
    for d in range(2, degree + 1):
        part: Part = {}
        for e in range(2, d + 1):
            for (i, j, m), c in equation.terms[e].terms():
                for (a, b), v in powers.get(m, {}).get(d - i - j, {}).items():
                    part[a + i, b + j] = part.get((a + i, b + j), zero) + c * v
        powers[1][d] = part
        for m in range(2, degree // 2 + 1):
            # h^m has the least degree 2 m; with h known to degree d it is to d + 2 (m - 1).
            top = d + 2 * (m - 1)
            if top <= degree:
                powers.setdefault(m, {})[top] = _product_part(powers[1], powers[m - 1], top, zero)
    return _series(powers[1], degree, field)


def eliminate(components: Sequence[Series], field: Field) -> Series:
    """Return h with h(s, t) = z, for s and t that start with the two variables themselves.

    Parameters
    ----------
    components
        s, t and z, series of one degree in two variables; z has no constant or linear part.
    field
        The field of the coefficients.
    """
    s, t, z = components
    degree, zero = z.degree, field.domain.zero
    rest = [dict(term.terms()) for term in z.terms]
    powers = [[field.series(degree, 1)], [field.series(degree, 1)]]
    for start, known in zip((s, t), powers, strict=True):
        for _ in range(degree):
            known.append(known[-1] * start)
    height: dict[int, Part] = {}
    for d in range(2, degree + 1):
        height[d] = {k: c for k, c in rest[d].items() if c}
        for (i, j), c in height[d].items() if d < degree else ():
            product = powers[0][i] * powers[1][j]
            for e in range(d + 1, degree + 1):
                for k, v in product.terms[e].terms():
                    rest[e][k] = rest[e].get(k, zero) - c * v
    return _series(height, degree, field)


def _product_part(a: dict[int, Part], b: dict[int, Part], degree: int, zero: Any) -> Part:
    """Return the part of one degree of a product."""
    product: Part = {}
    for e, left in a.items():
        for (i, j), u in left.items():
            for (p, q), v in b.get(degree - e, {}).items():
                product[i + p, j + q] = product.get((i + p, j + q), zero) + u * v
    return product


def _series(parts: dict[int, Part], degree: int, field: Field) -> Series:
    plane = ring("s,t", field.domain)[0]
    return Series(
        tuple(
            plane.from_dict({k: c for k, c in parts.get(d, {}).items() if c})
            for d in range(degree + 1)
        )
    )
