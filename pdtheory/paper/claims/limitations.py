"""Section 8: continuity, isotropic points, the T-junction."""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction
from typing import Any

import sympy as sp

from pdtheory.paper.claims.core import Orders, Section, Shows, Step, Verdict
from pdtheory.paper.claims.kit import angular, fact, identity, t, x, y
from pdtheory.paper.claims.sturm import (
    count_maxima,
    critical,
    form_of_expression,
    form_of_row,
    real_lines,
)

section = Section("Section 8: limitations")


@section.claim(
    "continuity",
    place="Section 8, first paragraph",
    printed=r"The directions are continuous on generic surfaces.",
    statement=r"They are continuous where $F$ has simple roots. On generic surfaces order 2 jumps "
    r"at isolated umbilics, and for $k \geq 3$ a maximum and a minimum die together along curves "
    r"(the discriminant).",
    verdict=Verdict.REFUTED,
)
def continuity(
    orders: Orders, step: Fraction = Fraction(1, 100), fold: Fraction = Fraction(3)
) -> Iterator[Step]:
    a, b, s = sp.symbols("a b s", real=True)
    f = (a**2 + b**2) / 2 + (a**3 - 3 * a * b**2) / 6
    at = {a: s, b: 0}
    gradient = [sp.diff(f, variable).subs(at) for variable in (a, b)]
    hessian = sp.hessian(f, (a, b)).subs(at)
    gap = hessian[0, 0] / (1 + gradient[0] ** 2) - hessian[1, 1]
    signs = [sp.sign(gap.subs(s, sp.Rational(value))) for value in (-step, step)]
    yield fact(
        r"Order 2: $z = (x^2 + y^2)/2 + (x^3 - 3 x y^2)/6$ has a stable umbilic at 0. At $(s, 0)$ "
        r"the directions are the axes, and the difference of the principal curvatures changes "
        r"sign with $s$: the maximum direction jumps by 90 degrees.",
        hessian[0, 1] == 0 and gradient[1] == 0 and signs[0] * signs[1] < 0,
        shows=Shows.COUNTEREXAMPLE,
        hessian=hessian.tolist(),
        curvature_gap=sp.simplify(gap),
        signs=signs,
    )
    counts = [
        count_maxima(3, form_of_row(3, {3: (Fraction(1), Fraction(0)), 1: (value, Fraction(0))}))
        for value in (fold - step, fold + step)
    ]
    yield fact(
        r"Order 3: with $\phi_{33} = 1$ and $\phi_{31}$ passing 3, a simple point of the deltoid, "
        r"the number of maxima goes from 3 to 1 (Sturm counts at $3 \mp \frac{1}{100}$): two "
        r"directions end. A curve in the plane of $\phi_{31} / \phi_{33}$ is crossed along curves "
        r"of a generic surface.",
        counts == [3, 1],
        shows=Shows.COUNTEREXAMPLE,
        maxima=counts,
    )
    p, q, c = sp.symbols("p q c", positive=True)
    g = sp.cos(q * t) + c * sp.cos(p * t)
    yield identity(
        r"Every $k \geq 3$ has two frequencies $0 < p < q \leq k$ of its parity. $g = \cos "
        r"q\theta + c \cos p\theta$ has $g'(0) = 0$ and $g''(0) = -q^2 - c p^2$, which changes "
        r"sign at $c = -q^2 / p^2$: a direction that was a maximum is a minimum.",
        sp.Subs(sp.Derivative(g, (t, 2)), (t, c), (0, -(q**2) / p**2)),
    )
    value = sp.Symbol("a", real=True)
    F = sp.sin(t) * (9 + value - 12 * sp.sin(t) ** 2)
    speed = -sp.diff(F, value) / sp.diff(F, t)
    root = sp.asin(sp.sqrt((9 + value) / 12))
    yield identity(
        r"At a simple root, $F_\theta \neq 0$, the implicit function theorem moves a direction "
        r"smoothly, $\theta' = -F_a / F_\theta$. For $\phi_{33} = 1$, $\phi_{31} = a$: $\sin^2 "
        r"\theta = (9 + a) / 12$, and $\mathrm{d}\theta / \mathrm{d}a$ agrees; it is infinite "
        r"exactly at $a = -9$ and $a = 3$, on the deltoid.",
        sp.Derivative(root, value),
        speed.subs(t, root),
    )


@section.claim(
    "isotropic-vanish",
    place="Section 8, first paragraph, against Definition 4.4",
    printed=r"On a sphere or a plane the directions vanish, since no extremum is found.",
    statement=r"There $g_k$ is constant, $F = 0$, and by Definition 4.4 every unit vector is a "
    r"principal direction: a status of its own, *isotropic*.",
    verdict=Verdict.REFUTED,
)
def isotropic_vanish(orders: Orders, profile: Any = None) -> Iterator[Step]:
    m = sp.Symbol("m", integer=True, positive=True)
    height = (lambda square: square**m) if profile is None else profile
    f = height(x**2 + y**2)
    yield identity(
        r"Every term of a surface of revolution about the normal is $c\,(x^2 + y^2)^m$, and its "
        r"$F$ is 0 (symbolic $m$): all unit vectors satisfy Theorem 4.3.",
        x * sp.Derivative(f, y) - y * sp.Derivative(f, x),
        shows=Shows.COUNTEREXAMPLE,
    )
    yield identity(
        r"Indeed $T v^{k-1} = (x^2 + y^2)^{m - 1} v$: on the circle $T v^{k-1} = v$ for every "
        r"unit vector.",
        sp.Derivative((x**2 + y**2) ** m, x) / (2 * m),
        (x**2 + y**2) ** (m - 1) * x,
        over=(x**2 + y**2) ** m,
    )
    square = sp.Symbol("s", positive=True)
    sphere = sp.sqrt(1 - square)
    yield identity(
        r"Nor do the eigenvalues vanish: on the sphere $z + 1 = \sqrt{1 - s}$, $s = x^2 + y^2$, "
        r"satisfies $2 (1 - s) z' = -(z + 1)$, so its coefficients obey $(m + 1) c_{m+1} = (m - "
        r"\frac12) c_m$ and none is 0: every even order has one $\lambda \neq 0$. On the plane $T "
        r"= 0$ and every vector has $\lambda = 0$.",
        2 * (1 - square) * sp.Derivative(sphere, square),
        -sphere,
    )
    top = max(orders) // 2 + 1
    series = sp.Poly(sp.series(sphere, square, 0, top + 1).removeO(), square).all_coeffs()[::-1]
    yield fact(
        "Those coefficients for the orders asked for.",
        all((j + 1) * series[j + 1] == (j - sp.Rational(1, 2)) * series[j] for j in range(top))
        and all(series),
        coefficients={2 * j: c for j, c in enumerate(series) if j},
    )


@section.claim(
    "tjunction-impossible",
    place="Section 8, last paragraph, and Figure 13",
    printed=r"Two maxima of order 3 are never opposite, so they cannot take the shape of a T.",
    statement=r"As printed for maxima (and for minima), at every odd order. The E-eigenvectors "
    r"together can: $f = y^3$ has them exactly at 0, 90, 180 and 270 degrees.",
)
def tjunction_impossible(orders: Orders, parity: int = 1, f: Any = y**3) -> Iterator[Step]:
    m = sp.Symbol("m", integer=True)
    yield identity(
        r"$g(\theta + \pi) = (-1)^k g(\theta) = -g(\theta)$ for $k = 2m + 1$: opposite a strict "
        r"maximum is a strict minimum, never a maximum.",
        lambda: (-1) ** (2 * m + parity),
        -1,
    )
    counts = real_lines(3, critical(3, form_of_expression(f)))
    F = sp.factor(angular(f))
    yield fact(
        r"$f = y^3$: $F = 3 x y^2$, so the E-eigenvectors lie exactly on the two axes; the T of "
        r"0, 90, 180 degrees is among them, with inflections at 0 and 180.",
        counts == {1: 1, 2: 1} and sp.simplify(F - 3 * x * y**2) == 0,
        F=F,
        lines_by_multiplicity=counts,
    )
    yield identity(
        r"It is the limit: maxima at $0, 90, 180$ degrees would need $g' = C \sin\theta "
        r"\sin(\theta - 90) \sin(\theta - 180) = C \sin^2\theta \cos\theta$, $g = \frac{C}{3} "
        r"\sin^3\theta$.",
        lambda: sp.sin(t) * sp.sin(t - sp.pi / 2) * sp.sin(t - sp.pi),
        sp.Derivative(sp.sin(t) ** 3 / 3, t),
    )
