"""Section 2: the error order that is quoted from the literature."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any

import sympy as sp

from pdtheory.paper.claims.core import Orders, Section, Step
from pdtheory.paper.claims.fits import basis, fit, normal_residuals, uniform_moment
from pdtheory.paper.claims.kit import fact, identity, n, t

section = Section("Section 2: related work")


@section.claim(
    "error-order",
    place="Section 2, 'Differential quantities estimation'",
    printed=r"Estimating order $k$ with a fit of degree $K$ in a neighbourhood of radius $r$ has "
    r"the error $O(r^{K - k})$.",
    statement=r"True but not sharp: it is $O(r^{K + 1 - k})$ for $f \in C^{K+1}$, and one power "
    r"better still, for $f \in C^{K+2}$ on a full disc, when $K - k$ is even.",
)
def error_order(
    orders: Orders, exponent: Callable[[Any, Any], Any] = lambda degree, k: degree + 1 - k
) -> Iterator[Step]:
    R, c = sp.symbols("R c", positive=True)
    k, j, d, K = sp.symbols("k j d K", integer=True, positive=True)
    mu = sp.Function("mu")
    yield identity(
        r"Scaling: on the disc of radius $R$ the moment matrix is $R^{k + j + 2} \mu_{k+j+1}$ and "
        r"the right side for $r^d e^{i n \theta}$ is $R^{k + d + 2} \mu_{k+d+1}$. So if $c_j$ "
        r"solves it for $R = 1$, $c_j R^{d - j}$ does for $R$ (symbolic exponents): $r^d$ "
        r"contributes $c_k R^{d - k}$ to order $k$.",
        R ** (k + j + 2) * mu(k + j + 1) * c * R ** (d - j),
        R ** (k + d + 2) * mu(k + j + 1) * c,
    )
    yield identity(
        r"Terms with $d \leq K$ are reproduced; the first that is not is $d = K + 1$. A remainder "
        r"of size $r^{K+1}$ gives the same power, because order $k$ of the fit is a linear "
        r"functional of norm $R^{-k}$: the error is $O(R^{K + 1 - k})$.",
        lambda: (K + 1) - k,
        exponent(K, k),
    )
    yield fact(
        r"It is a power of $R$ better than printed, so $O(r^{K-k})$ holds.",
        sp.simplify(exponent(K, k) - (K - k)) >= 0,
        gain=sp.simplify(exponent(K, k) - (K - k)),
    )
    yield identity(
        r"Frequencies do not mix on a full disc: $\int_0^{2\pi} e^{i n \theta} = 0$ for $n \neq "
        r"0$. Terms of degree $K + 1$ have $n = K + 1 \bmod 2$, so for $K - k$ even they do not "
        r"reach order $k$, and $d = K + 2$ comes first.",
        sp.Integral(sp.exp(sp.I * n * t), (t, 0, 2 * sp.pi)),
    )
    sharp: dict[tuple[int, int], Any] = {}
    solved = True
    for degree in orders:
        for order in range(1, degree + 1):
            first = degree + 1 + (degree - order + 1) % 2
            powers = basis(degree, 2 - order % 2)
            solution = fit(uniform_moment, powers, first)
            solved = solved and not any(normal_residuals(uniform_moment, powers, first, solution))
            sharp[degree, order] = solution[order]
    yield fact(
        r"Sharp: with the uniform weight the coefficient of that first term is not 0, exactly, "
        r"for the degrees $K$ in the orders asked for and every $k \leq K$ with $K - k$ odd or "
        r"even as it comes.",
        solved and all(value != 0 for value in sharp.values()),
        coefficients={key: value for key, value in sharp.items() if key[0] <= 6},
    )
