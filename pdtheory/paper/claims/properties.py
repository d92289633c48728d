"""Section 5: parity, numbers of directions, order 2."""

from __future__ import annotations

import random
from collections.abc import Callable, Iterator
from fractions import Fraction
from typing import Any

import sympy as sp

from pdtheory.paper.claims.core import Orders, Section, Shows, Step, Verdict
from pdtheory.paper.claims.kit import (
    angular,
    fact,
    i,
    identity,
    k,
    n,
    radial,
    t,
    x,
    y,
)
from pdtheory.paper.claims.sturm import (
    count_maxima,
    critical,
    form_of_expression,
    form_of_row,
    random_row,
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
