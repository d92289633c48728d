"""Section 5, last paragraphs: regularity, N-RoSy, triples, saddles."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from fractions import Fraction
from typing import Any

import sympy as sp

from pdtheory.paper.claims.core import Orders, Section, Shows, Step, Verdict
from pdtheory.paper.claims.kit import (
    angular,
    fact,
    identity,
    k,
    product_of_sines,
    t,
    x,
    y,
)
from pdtheory.paper.claims.sturm import (
    circle_point,
    count_maxima,
    critical,
    form_of_expression,
    form_of_row,
    is_maximum,
    real_lines,
    row_of_lines,
)

section = Section("Section 5: properties of the principal directions")

_J = sp.Symbol("j", integer=True)


@section.claim(
    "krosy-iff",
    place="Section 5, 'Regularity and link with N-RoSy'",
    printed=r"The directions of order $k$ are a $k$-RoSy if and only if $\phi_{k,n} = 0$ for all "
    r"$n \neq \pm k$.",
    statement=r"True for odd $k$ (maxima). For even $k$ it is false: $\phi_{k,0}$ is free, and "
    r"the maxima alone allow more; see *k-rosy*.",
    verdict=Verdict.REFUTED,
)
def krosy_iff(orders: Orders, e: Fraction = Fraction(1, 2)) -> Iterator[Step]:
    p = form_of_expression(2 * x**2 + y**2)
    axis = (Fraction(1), Fraction(0))
    yield fact(
        r"$f = 2 x^2 + y^2$: the maxima are at 0 and 180 degrees, a 2-RoSy, and $\phi_{2,0} = 3/4 "
        r"\neq 0$.",
        count_maxima(2, p) == 2
        and is_maximum(2, p, axis)
        and is_maximum(2, p, (-axis[0], axis[1])),
        shows=Shows.COUNTEREXAMPLE,
        phi_20=sp.Rational(3, 4),
    )
    row = {4: (Fraction(1, 2), Fraction(0)), 2: (e / 2, Fraction(0))}
    p = form_of_row(4, row)
    quarter = [(Fraction(c), Fraction(s)) for c, s in ((1, 0), (0, 1), (-1, 0), (0, -1))]
    yield fact(
        r"$\cos 4\theta + \frac12 \cos 2\theta$: the maxima are exactly at 0, 90, 180, 270 "
        r"degrees, a 4-RoSy, and $\phi_{4,2} \neq 0$.",
        e != 0 and count_maxima(4, p) == 4 and all(is_maximum(4, p, point) for point in quarter),
        shows=Shows.COUNTEREXAMPLE,
        phi_42=e / 2,
        maxima="0, 90, 180, 270 degrees",
    )
    distinct = {o: len({2 * j % o for j in range(o)}) for o in orders}
    yield fact(
        r"Odd $k$: the maxima $\theta_0 + 2 \pi j / k$ give $k$ different $u_j = e^{2 i "
        r"\theta_j}$, because 2 is invertible mod $k$; for even $k$ only $k / 2$, which is where "
        r"the print fails.",
        all(count == (o if o % 2 else o // 2) for o, count in distinct.items()),
        different_u=distinct,
    )
    yield identity(
        r"All have $u_j^k = e^{2 i k \theta_0} = w$; so for odd $k$, $P = c\,(u^k - w)$: all "
        r"other $n \phi_n$ vanish, and $n = 0$ does not occur. Conversely $g = 2\,\mathrm{Re}\, "
        r"\phi_k e^{i k \theta}$ has a $k$-RoSy of maxima.",
        sp.exp(2 * sp.I * k * (t + 2 * sp.pi * _J / k)),
        sp.exp(2 * sp.I * k * t),
    )


def _equations(angles: list[Any]) -> Any:
    """Return the matrix of g'(t_i) = 0 in the unknowns Re, Im phi_31, Re, Im phi_33."""
    return sp.Matrix([[sp.sin(a), sp.cos(a), 3 * sp.sin(3 * a), 3 * sp.cos(3 * a)] for a in angles])


@section.claim(
    "order3-rank",
    place="Section 5, 'Regularity and link with N-RoSy'",
    printed=r"Three angles give 6 equations for the 4 unknowns of order 3, and the system is "
    r"sometimes invertible, with only the trivial solution.",
    statement=r"The equations of $\theta$ and $\theta + \pi$ are the same: the rank is the number "
    r"of distinct $\theta_i \bmod \pi$, at most $3 < 4$, and there is always a non-trivial "
    r"solution.",
    verdict=Verdict.REFUTED,
    scope="order 3",
)
def order3_rank(orders: Orders, opposite: Any = sp.pi) -> Iterator[Step]:
    a = sp.Symbol("theta", real=True)
    rows = _equations([a, a + opposite])
    yield fact(
        r"The row of $\theta + \pi$ is minus the row of $\theta$: six equations have rank at most "
        r"3, and the system of 4 unknowns is never invertible.",
        sp.simplify(sp.expand_trig(rows[0, :] + rows[1, :])) == sp.zeros(1, 4),
        shows=Shows.COUNTEREXAMPLE,
        row=list(rows[0, :]),
        opposite_row=list(rows[1, :]),
    )
    slopes = sp.symbols("s1:4")
    columns = [sp.expand(s) for s in slopes]
    f0, f1, f2, f3 = sp.symbols("f0:4")
    F = sp.Poly(
        angular(f0 * x**3 + f1 * x**2 * y + f2 * x * y**2 + f3 * y**3).subs({x: 1, y: t}), t
    )
    to_F = sp.Matrix([[c.coeff(f) for f in (f0, f1, f2, f3)] for c in F.all_coeffs()])
    yield fact(
        r"$f \mapsto F$ is invertible on forms of order 3 (its determinant is not 0), so the "
        r"unknowns may be the coefficients of $F$.",
        to_F.det() != 0,
        determinant=to_F.det(),
    )
    vandermonde = sp.Matrix([[s**j for j in range(3)] for s in columns]).det()
    expected = sp.prod([slopes[b] - slopes[c] for b in range(3) for c in range(b)])
    yield identity(
        r"$F(1, s_i) = 0$ at three slopes has the minor $\prod (s_j - s_i)$, not 0 if they are "
        r"distinct: the rank is the number of distinct lines (turn the frame if one is vertical).",
        vandermonde,
        expected,
    )


@section.claim(
    "order3-triples",
    place="Section 5, 'Regularity and link with N-RoSy'",
    printed=r"Not every triple of directions can be had at order 3 (by the rank analysis).",
    statement=r"True, for another reason: three angles distinct mod $\pi$ fix $g_3$ up to a "
    r"factor, and its maxima must interlace with their opposites; see *order3-maxima*.",
    scope="order 3",
)
def order3_triples(
    orders: Orders, halves: tuple[Fraction, ...] = (Fraction(0), Fraction(1, 10), Fraction(1, 5))
) -> Iterator[Step]:
    points = [circle_point(h) for h in halves]
    outcome = {}
    simple = True
    for sign in (1, -1):
        p = form_of_row(3, row_of_lines(points, sign))
        outcome[sign] = [is_maximum(3, p, point) for point in points]
        simple = simple and real_lines(3, critical(3, p)) == {1: 3}
    yield fact(
        r"The angles $0$, $2 \arctan\frac1{10}$, $2 \arctan\frac15$ (about 0, 11.4, 22.6 "
        r"degrees): the only rows with these critical lines are $C \prod \sin(\theta - "
        r"\theta_j)$, and for neither sign of $C$ are all three maxima.",
        simple and not any(all(maxima) for maxima in outcome.values()),
        maxima_for_each_sign=outcome,
        points=points,
    )
    angles = sp.symbols("t1:4", real=True)
    s = sum(angles)
    C = sp.Symbol("C", real=True)
    phi33 = C / 24 * sp.exp(-sp.I * s)
    phi31 = -C / 8 * sp.exp(-sp.I * s) * sum(sp.exp(2 * sp.I * a) for a in angles)
    terms = sum(
        sp.I * m * phi * sp.exp(sp.I * m * t) - sp.I * m * sp.conjugate(phi) * sp.exp(-sp.I * m * t)
        for m, phi in ((3, phi33), (1, phi31))
    )
    yield identity(
        r"Those rows: $g' = C \prod_j \sin(\theta - t_j)$ for $\phi_{33} = \frac{C}{24} e^{-i s}$, "
        r"$\phi_{31} = -\frac{C}{8} e^{-i s} \sum_j e^{2 i t_j}$, $s = t_1 + t_2 + t_3$.",
        terms,
        C * product_of_sines(angles),
    )


@section.claim(
    "saddles-rosy",
    place="Section 5, Figure 2 (monkey and octopus saddles)",
    printed=r"The maxima of order 3 (8) of the monkey (octopus) saddle are a 3-RoSy (8-RoSy); "
    r"other orders vanish.",
    statement=r"For every $k$, $z = \mathrm{Re}\,(x + i y)^k$ has only the order $k$, with "
    r"E-eigenvectors at $j \pi / k$, $\lambda = (-1)^j k!$, maxima for even $j$.",
)
def saddles_rosy(
    orders: Orders,
    value: Callable[[Any, Any], Any] = lambda j, order: (-1) ** j * sp.factorial(order),
) -> Iterator[Step]:
    g = sp.cos(k * t)
    at = {t: _J * sp.pi / k}
    yield identity(
        r"On the circle $\mathrm{Re}\,(x + i y)^k = \cos k\theta$; $g' = -k \sin k\theta$ "
        r"vanishes at $j \pi / k$.",
        sp.Subs(sp.Derivative(g, t), t, at[t]),
    )
    yield identity(
        r"There $\lambda = k!\, g = (-1)^j k!$.",
        lambda: sp.factorial(k) * sp.Subs(g, t, at[t]),
        value(_J, k),
    )
    yield identity(
        r"$g'' = -k^2 (-1)^j$: maxima for even $j$, a $k$-RoSy; minima for odd $j$.",
        sp.Subs(sp.Derivative(g, (t, 2)), t, at[t]),
        -(k**2) * value(_J, k) / sp.factorial(k),
    )
    a, b = sp.symbols("a b", real=True)
    saddles = {o: sp.expand(sp.re(sp.expand((a + sp.I * b) ** o))) for o in (3, 8)}
    counts = {
        order: count_maxima(order, form_of_expression(f, a, b)) for order, f in saddles.items()
    }
    yield fact(
        "The monkey and the octopus saddle are homogeneous, so their other orders vanish, and "
        "they have 3 and 8 maxima.",
        counts == {3: 3, 8: 8} and all(sp.Poly(f, a, b).is_homogeneous for f in saddles.values()),
        maxima=counts,
        surfaces=saddles,
    )
