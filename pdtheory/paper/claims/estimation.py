"""Section 6: computing directions on point sets."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any

import sympy as sp

from pdtheory.paper.claims.core import Orders, Section, Shows, Step, Verdict
from pdtheory.paper.claims.kit import fact, identity

section = Section("Section 6: directions computed per point")


def _gaussian(distance: Any, radius: Any) -> Any:
    return sp.exp(-(distance**2) / (2 * (radius / 3) ** 2))


@section.claim(
    "z-gaussian",
    place="Section 6, after equation (6.1)",
    printed=r"The Gaussian weight with $\sigma = r / 3$ avoids sharp boundary effects.",
    statement=r"It lowers them: the weight still jumps by $e^{-9/2}$, 1.1 % of its maximum, where "
    r"a point leaves the neighbourhood, and the coefficients jump with it. A weight that vanishes "
    r"at $r$ is continuous.",
    verdict=Verdict.REFUTED,
    scope="configuration",
)
def z_gaussian(orders: Orders, weight: Callable[[Any, Any], Any] = _gaussian) -> Iterator[Step]:
    R, r = sp.symbols("R r", positive=True)
    edge = sp.simplify(weight(R, R))
    yield fact(
        r"At distance $r$ the weight is $e^{-9/2} = 0.0111$ of the weight at the centre, and 0 "
        r"beyond, for every radius.",
        edge == sp.exp(sp.Rational(-9, 2)) * weight(0, R),
        shows=Shows.COUNTEREXAMPLE,
        jump=edge,
        value=sp.N(edge, 12),
    )
    near = sp.simplify(weight(R / 2, R))
    inside = sp.simplify(edge / (near / 16 + edge))
    yield fact(
        r"The result jumps: fit $\phi\, \rho^2$ to the samples $z(\tfrac12) = 0$ and $z(1) = 1$. "
        r"With the second inside, $\phi = e^{-9/2} / (e^{-9/8} / 16 + e^{-9/2})$; an arbitrarily "
        r"small step outside it is 0.",
        inside.is_positive,
        shows=Shows.COUNTEREXAMPLE,
        inside=inside,
        value=sp.N(inside, 12),
        outside=0,
    )
    yield identity(
        r"Corrected: $w(\rho) - w(1)$ is continuous, its limit at the boundary is 0, the value "
        r"beyond.",
        sp.Limit(weight(r, R) - weight(R, R), r, R, "-"),
    )
