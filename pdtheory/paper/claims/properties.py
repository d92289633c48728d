"""Section 5: parity, numbers of directions, order 2, regularity."""

from __future__ import annotations

import random
from collections.abc import Callable, Iterator
from fractions import Fraction
from typing import Any

import sympy as sp

from pdtheory.paper.claims.core import Orders, Section, Shows, Step, Verdict
from pdtheory.paper.claims.kit import (
    angular,
    circle_point,
    count_maxima,
    critical,
    fact,
    form_of_expression,
    form_of_row,
    i,
    identity,
    is_maximum,
    k,
    n,
    product_of_sines,
    radial,
    random_row,
    real_lines,
    row_of_lines,
    t,
    x,
    y,
)

section = Section("Section 5: properties of the principal directions")

_J = sp.Symbol("j", integer=True)


def _turned(sign: Callable[[Any], Any]) -> Step:
    a, b = sp.symbols("a b", integer=True, nonnegative=True)
    return identity(
        r"$v \to -v$ multiplies $x^a y^b$ by $(-1)^{a + b} = (-1)^k$ (equivalently $e^{i n "
        r"\theta}$ by $(-1)^n$, $n = k \bmod 2$); periodicity alone would not give it.",
        lambda: (-1) ** a * (-1) ** b,
        sign(a + b),
    )


@section.claim(
    "parity-even",
    place="Section 5, 'Constraints on the principal directions', first item",
    printed=r"For even $k$, $g_k(\theta + \pi) = g_k(\theta)$: maxima come in opposite pairs.",
    statement=r"As printed, because only even $n$ occur (not by periodicity).",
)
def parity_even(
    orders: Orders, sign: Callable[[Any], Any] = lambda order: (-1) ** order, parity: int = 0
) -> Iterator[Step]:
    yield _turned(sign)
    half = sp.Symbol("m", integer=True)
    yield identity(
        r"For $k = 2 m$ the factor is 1, so $g$ has the same value and kind at $\theta$ and "
        r"$\theta + \pi$.",
        lambda: sign(2 * half + parity),
        1,
    )


@section.claim(
    "parity-odd",
    place="Section 5, 'Constraints on the principal directions', second item",
    printed=r"For odd $k$, $g_k(\theta + \pi) = -g_k(\theta)$: opposite a maximum is a minimum.",
    statement=r"As printed, because only odd $n$ occur (not by periodicity).",
)
def parity_odd(
    orders: Orders, sign: Callable[[Any], Any] = lambda order: (-1) ** order, parity: int = 1
) -> Iterator[Step]:
    yield _turned(sign)
    half = sp.Symbol("m", integer=True)
    yield identity(
        r"For $k = 2 m + 1$ the factor is $-1$, so a maximum at $\theta$ is a minimum at $\theta "
        r"+ \pi$.",
        lambda: sign(2 * half + parity),
        -1,
    )


def _unevaluated_angular(f: Any) -> Any:
    return x * sp.Derivative(f, y) - y * sp.Derivative(f, x)


def _constant_form(order: int) -> Any:
    return (x**2 + y**2) ** (order // 2)


@section.claim(
    "count-2k",
    place="Section 5, 'Number of principal directions'",
    printed=r"There are at most $2k$ principal directions of order $k$.",
    statement=r"If $g_k$ is not constant there are at most $2k$, more sharply at most $2 "
    r"n_{\max}$ and at least $2 n_{\min}$, the largest and least $n > 0$ with $\phi_{k,n} \neq "
    r"0$, and $n_{\min} \leq \#\max \leq n_{\max}$. If it is constant, every unit vector is one.",
    verdict=Verdict.PROVED_STRONGER,
)
def count_2k(
    orders: Orders,
    constant: Callable[[int], Any] = _constant_form,
    bounds: Callable[[set[int]], tuple[int, int]] = lambda support: (min(support), max(support)),
) -> Iterator[Step]:
    m = sp.Symbol("m", integer=True, positive=True)
    yield identity(
        r"Without the hypothesis it fails: $f = (x^2 + y^2)^m$, order $2 m$, has $F = 0$ "
        r"identically (symbolic $m$): every direction is an E-eigenvector.",
        _unevaluated_angular((x**2 + y**2) ** m),
        shows=Shows.NEEDED,
    )
    even = sorted({2, *(o for o in orders if o % 2 == 0)})
    yield fact(
        "The same by exact coefficients, for the even orders.",
        all(critical(o, form_of_expression(constant(o))) == 0 for o in even),
        shows=Shows.NEEDED,
        F={o: str(critical(o, form_of_expression(constant(o)))) for o in even},
    )
    u = sp.Symbol("u", positive=True)
    e = sp.sqrt(u)
    yield identity(
        r"With $u = e^{2 i \theta}$, $e^{i k \theta} \cdot n \phi_n e^{i n \theta} = n \phi_n "
        r"u^{(k + n) / 2}$: the directions are the roots $|u| = 1$ of $P(u) = \sum_n n \phi_n "
        r"u^{(k + n) / 2}$, of degree at most $k$, two for each root; $P = 0$ only if $g$ is "
        r"constant.",
        e**k * e**n,
        u ** ((k + n) / 2),
    )
    N = sp.Symbol("N", integer=True, positive=True)
    yield identity(
        r"$P = u^{(k - N) / 2} Q(u)$ with $N = n_{\max}$ and $\deg Q = (k + N)/2 - (k - N)/2 = "
        r"N$: at most $2 N$ directions, so at most $N$ maxima and $N$ minima, which alternate.",
        lambda: (k + N) / 2 - (k - N) / 2,
        N,
    )
    yield from _sturm_hurwitz_lower()
    yield from _sturm_hurwitz_counts(orders, bounds)


def _sturm_hurwitz_lower() -> Iterator[Step]:
    a, b = sp.symbols("a b", real=True)
    pair = sp.sin((t - a) / 2) * sp.sin((t - b) / 2)
    yield identity(
        r"Lower bound (Sturm, Hurwitz): if $g'$ had $2 s < 2 n_{\min}$ sign changes $s_1, s_2, "
        r"\dots$, the product of $\sin((\theta - s_j) / 2)$ would change sign with it. In pairs "
        r"that product is $\frac12 \cos\frac{a - b}{2} - \frac12 \cos(\theta - \frac{a + b}{2})$, "
        r"a trigonometric polynomial of degree $s < n_{\min}$ in all.",
        pair,
        (sp.cos((a - b) / 2) - sp.cos(t - (a + b) / 2)) / 2,
    )
    yield identity(
        r"But $\int_0^{2\pi} e^{i d \theta} = 0$ for every integer $d > 0$, so frequencies $l < "
        r"n$ are orthogonal ($d = n \pm l$), and the integral of the product times $g'$ would be "
        r"both 0 and of one strict sign.",
        sp.Integral(sp.exp(sp.I * n * t), (t, 0, 2 * sp.pi)),
    )


def _sturm_hurwitz_counts(
    orders: Orders, bounds: Callable[[set[int]], tuple[int, int]]
) -> Iterator[Step]:
    generator = random.Random(2)
    seen: dict[int, list[int]] = {}
    holds = True
    for order in orders:
        for _ in range(4):
            row = random_row(order, generator)
            for frequency in list(row):
                if generator.random() < 0.5 and len(row) > 1:
                    del row[frequency]
            support = {m for m, phi in row.items() if m and phi != (0, 0)}
            if not support:
                continue
            found = count_maxima(order, form_of_row(order, row))
            least, most = bounds(support)
            holds = holds and found is not None and least <= found <= most
            seen.setdefault(order, []).append(found or 0)
    yield fact(
        r"Sturm counts of random rational rows with gaps stay within $n_{\min} \leq \#\max \leq "
        r"n_{\max}$.",
        holds,
        maxima_by_order=seen,
    )


@section.claim(
    "polynomial-degree",
    place="Section 5, 'Number of principal directions'",
    printed=r"The directions are the roots of modulus 1 of a real polynomial of order $2k$.",
    statement=r"The polynomial is complex and self-inversive, $u^k \overline{P(1 / \bar u)} = "
    r"-P(u)$, and degree $k$ in $u = e^{2 i \theta}$ suffices; a real one of degree $k$ is $F(1, "
    r"\tan\theta)$.",
    verdict=Verdict.MISPRINT,
)
def polynomial_degree(
    orders: Orders, f: Any = x**2 + x * y, inversion_sign: int = -1
) -> Iterator[Step]:
    z, w = sp.symbols("z w")
    row = sp.expand(f.subs({x: (z + w) / 2, y: (z - w) / (2 * sp.I)}))
    top, bottom = 2 * row.coeff(z, 2), -2 * row.coeff(w, 2)
    ratio = sp.simplify(bottom / top)
    yield fact(
        r"Not real: for $f = x^2 + x y$ the printed polynomial is $i (2 \phi_2 z^4 + 0 - 2 "
        r"\bar\phi_2)$, and the ratio of its coefficients is not real, so no factor makes it real.",
        not sp.im(ratio).is_zero,
        shows=Shows.MISPRINT,
        f=f,
        ratio=ratio,
    )
    a, b = sp.symbols("a b", real=True)
    phi = a + sp.I * b
    yield identity(
        r"Self-inversive: the coefficients of $P$ at $(k + n)/2$ and at $k - (k + n)/2 = (k - "
        r"n)/2$ are $n \phi_n$ and $-n \overline{\phi_n}$.",
        lambda: -n * sp.conjugate(phi),
        lambda: inversion_sign * sp.conjugate(n * phi),
    )
    exponents = {o: [(o + m) // 2 for m in range(-o, o + 1, 2)] for o in orders}
    yield fact(
        r"$e^{i k \theta} \cdot e^{i n \theta}$ has the even exponent $k + n$, so the polynomial "
        r"of degree $2k$ in $e^{i \theta}$ is one of degree $k$ in $u$.",
        all(found == list(range(o + 1)) for o, found in exponents.items()),
        exponents_of_u=exponents,
    )
    slope = sp.Symbol("s", positive=True)
    order = i + n
    monomial = x**i * y**n
    yield identity(
        r"$F(\cos\theta, \sin\theta) = \cos^k\theta\; F(1, \tan\theta)$: real, of degree $k$ "
        r"in $\tan\theta$ (on $x^i y^{k-i}$, symbolic exponents).",
        angular(monomial).subs(y, slope * x),
        x**order * angular(monomial).subs({x: 1, y: slope}),
        over=x**order * slope**n,
    )
    yield identity(
        r"$F$ is homogeneous of degree $k$ like $f$.",
        radial(angular(monomial)),
        order * angular(monomial),
        over=monomial,
    )


@section.claim(
    "count-max-min",
    place="Section 5, 'Number of principal directions'",
    printed=r"$\#\max = \#\min \leq k$, even for even $k$ and odd for odd $k$.",
    statement=r"If $g_k$ is not constant, as printed; every number $N \leq k$ with $N = k \bmod "
    r"2$, $N > 0$, is attained, by $\cos N\theta$.",
    verdict=Verdict.PROVED_STRONGER,
)
def count_max_min(
    orders: Orders,
    expected: Callable[[int, int], int] = lambda order, frequency: frequency,
    parity: Callable[[int, int], bool] = lambda order, found: (order - found) % 2 == 0,
) -> Iterator[Step]:
    m = sp.Symbol("m", integer=True, positive=True)
    yield identity(
        r"Needed: for $f = (x^2 + y^2)^m$, $g$ is constant, and every direction is (weakly) both "
        r"a maximum and a minimum.",
        _unevaluated_angular((x**2 + y**2) ** m),
        shows=Shows.NEEDED,
    )
    a, b = sp.symbols("a b", integer=True, nonnegative=True)
    h = sp.Symbol("h", positive=True)
    F = angular(x**a * y**b)
    yield identity(
        r"Maxima and minima are the sign changes of $g' = F/k!$ on the circle; they alternate, so "
        r"there are as many of each, and with at most $2k$ zeros at most $k$. $F$ is homogeneous "
        r"of degree $k$ (symbolic exponents), so $F(-v) = (-1)^k F(v)$: on a half circle "
        r"$F$ changes sign an even number of times for even $k$ and an odd number for odd $k$, "
        r"and the full circle has twice as many.",
        F.subs({x: h * x, y: h * y}),
        h ** (a + b) * F,
        over=h ** (a + b) * x**a * y**b,
    )
    generator = random.Random(3)
    found_random = {
        order: [
            count_maxima(order, form_of_row(order, random_row(order, generator))) for _ in "abcd"
        ]
        for order in orders
    }
    yield fact(
        "Random rational rows: their Sturm counts have the parity of the order and do not exceed "
        "it.",
        all(
            found is not None and found <= order and parity(order, found)
            for order, row in found_random.items()
            for found in row
        ),
        maxima_by_order=found_random,
    )
    attained = {
        (order, frequency): count_maxima(
            order, form_of_row(order, {frequency: (Fraction(1), Fraction(0))})
        )
        for order in orders
        for frequency in range(2 - order % 2, order + 1, 2)
    }
    yield fact(
        r"Attained: $g = \cos N\theta$ as a form of order $k$ has $N$ maxima (Sturm counts).",
        all(found == expected(*key) for key, found in attained.items()),
        counted=len(attained),
        orders=sorted({order for order, _ in attained}),
    )
    yield identity(
        r"$(\cos N\theta)' = 0$ at $j \pi / N$, where $\cos N\theta = (-1)^j$: $N$ maxima for "
        r"symbolic $N$.",
        lambda: sp.cos(n * (_J * sp.pi / n)),
        (-1) ** _J,
    )


@section.claim(
    "order2-curvature",
    place="Section 5, 'Order 2 principal directions'",
    printed=r"The directions of order 2 are the principal curvature directions.",
    statement=r"They are if $\nabla f(0) = 0$, and for every $H$ only then. For one $H$ with two "
    r"different eigenvalues they are exactly if $\nabla f(0)$ is 0 or an eigenvector of $H$.",
    verdict=Verdict.PROVED_STRONGER,
    scope="order 2",
)
def order2_curvature(
    orders: Orders, gradient: tuple[Any, Any] = (1, 0), hessian: tuple[Any, Any, Any] = (0, 1, 0)
) -> Iterator[Step]:
    p, q, h1, h2 = sp.symbols("p q h_1 h_2", real=True)
    a, b = sp.symbols("a b", real=True)

    def curvature(grad: tuple[Any, Any], h: Any) -> Any:
        """det(II v, I v), zero exactly at the principal curvature directions v = (a, b)."""
        v = sp.Matrix([a, b])
        first = sp.eye(2) + sp.Matrix(grad) * sp.Matrix(grad).T
        return sp.expand(sp.Matrix.hstack(h * v, first * v).det())

    def order_two(h: Any) -> Any:
        v = sp.Matrix([a, b])
        return sp.expand(sp.Matrix.hstack(h * v, v).det())

    h = sp.Matrix([[hessian[0], hessian[1]], [hessian[1], hessian[2]]])
    ours = sorted(sp.solve(order_two(h).subs(a, 1), b))
    theirs = sorted(sp.solve(curvature(gradient, h).subs(a, 1), b))
    yield fact(
        r"$z = x + x y$: order 2 gives $(1, \pm 1)$, the curvature directions are $(1, \pm\sqrt "
        r"2)$ in the plane of $(x, y)$.",
        ours != theirs,
        shows=Shows.NEEDED,
        gradient=gradient,
        order_2=[(1, s) for s in ours],
        curvature=[(1, s) for s in theirs],
    )
    generic = sp.Matrix([[h1, 0], [0, h2]])
    yield identity(
        r"With $\nabla f = 0$ the first fundamental form is the identity, and the two equations "
        r"are the same.",
        curvature((0, 0), generic),
        order_two(generic),
    )
    axes = [
        curvature((p, q), generic).subs({a: 1, b: 0}),
        curvature((p, q), generic).subs({a: 0, b: 1}),
    ]
    yield fact(
        r"In the eigenvectors' axes of $H = \mathrm{diag}(h_1, h_2)$ the axes are curvature "
        r"directions exactly if $h_1 p q = h_2 p q = 0$, that is, $p q = 0$ as $h_1 \neq h_2$: "
        r"the gradient is along an axis or 0.",
        sp.expand(axes[0] - h1 * p * q) == 0 and sp.expand(axes[1] + h2 * p * q) == 0,
        at_first_axis=axes[0],
        at_second_axis=axes[1],
    )


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
        p = form_of_row(3, row_of_lines(3, points, sign))
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
