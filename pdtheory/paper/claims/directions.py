"""Section 4: Taylor tensors, the theorem, and Wavejets."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any

import sympy as sp

from pdtheory.paper.claims.core import Orders, Section, Shows, Step, Verdict
from pdtheory.paper.claims.kit import angular, differs, fact, i, identity, k, n, t, tensor_on, x, y
from pdtheory.paper.claims.sturm import critical, form_of_expression, real_lines

section = Section("Section 4: arbitrary order principal directions")

_MONOMIAL = x**i * y ** (k - i)


@section.claim(
    "taylor-first-terms",
    place="Section 4, equation (4.1)",
    printed=r"$f(v) = f(0) + n^T v + \tfrac12 v^T H v + o(\|v\|^2)$ with $n$ the normal at the "
    r"origin.",
    statement=r"The linear term is $\nabla f(0)^T v$, the gradient; the normal of the graph is "
    r"$(-\nabla f, 1) / \sqrt{1 + |\nabla f|^2}$.",
    verdict=Verdict.REFUTED,
    scope="orders 1 and 2",
)
def taylor_first_terms(
    orders: Orders, printed: Callable[[Any], Any] | None = None, corrected: bool = True
) -> Iterator[Step]:
    p, q, r, a, b, c = sp.symbols("p q r a b c", real=True)
    f = r + p * x + q * y + a * x**2 + b * x * y + c * y**2
    length = sp.sqrt(1 + p**2 + q**2)
    linear = printed or (lambda g: (-g[0] / length, -g[1] / length))
    wrong = linear((p, q))
    rest = sp.expand(f - r - wrong[0] * x - wrong[1] * y).coeff(x, 1).coeff(y, 0)
    yield differs(
        r"$f = x$: with the normal $(-1, 0, 1) / \sqrt 2$ of its graph in place of the gradient, "
        r"$f(v) - f(0) - n^T v$ keeps a multiple of $x$, which is not $o(\|v\|)$.",
        rest.subs({p: 1, q: 0}),
        0,
        shows=Shows.COUNTEREXAMPLE,
    )
    gradient = (sp.diff(f, x), sp.diff(f, y)) if corrected else wrong
    at = {x: 0, y: 0}
    hessian = sp.hessian(f, (x, y))
    v = sp.Matrix([x, y])
    linear_part = sum(g.subs(at) * s for g, s in zip(gradient, (x, y), strict=True))
    quadratic_part = (v.T * hessian * v)[0] / 2
    yield identity(
        r"With the gradient the remainder of every polynomial of degree 2 vanishes; terms "
        r"$x^a y^b$, $a + b \geq 3$, are $o(\|v\|^2)$.",
        f,
        lambda: r + linear_part + quadratic_part,
    )


@section.claim(
    "taylor-tensor",
    place="Section 4, equations (4.2), (4.4), (4.5) and (4.6)",
    printed=r"$T_k v^k = \sum_i \binom{k}{i} \partial^k f / \partial x^i \partial y^{k-i}\; x^i "
    r"y^{k-i}$, so the Taylor polynomial is $\sum_k T_k v^k / k!$.",
    statement=r"As printed, for every $k$ (read $\partial x^i \partial y^{k-i}$ where "
    r"$\partial^i x\, \partial^{k-i} y$ is printed in (4.4) and (4.5)).",
)
def taylor_tensor(
    orders: Orders,
    multiplicity: Callable[[Any, Any], Any] = sp.binomial,
    normalisation: Callable[[Any], Any] = sp.factorial,
) -> Iterator[Step]:
    yield identity(
        r"Induction over $k$: among the index tuples with $i$ ones, $\binom{k-1}{i-1}$ begin with "
        r"1 and $\binom{k-1}{i}$ with 2, and $\binom{k-1}{i-1} + \binom{k-1}{i} = \binom{k}{i}$. "
        r"So $T_k v^k$ has $\binom{k}{i}$ equal terms $x^i y^{k-i}$.",
        (multiplicity(k - 1, i - 1) + multiplicity(k - 1, i)) / multiplicity(k, i),
        1,
    )
    first = multiplicity(sp.Integer(1), sp.Integer(0)), multiplicity(sp.Integer(1), sp.Integer(1))
    yield fact(
        r"The induction starts at $k = 1$: $T v = T_x x + T_y y$.", first == (1, 1), k1=first
    )
    yield identity(
        r"$\frac{1}{k!} \binom{k}{i} = \frac{1}{i! (k-i)!}$: (4.5) is the term of order $k$ of "
        r"(4.2).",
        multiplicity(k, i) / normalisation(k) * sp.factorial(i) * sp.factorial(k - i),
        1,
    )
    a, b = sp.symbols("a b", integer=True, nonnegative=True)
    yield identity(
        r"(4.6) is exact on $x^a y^b$: its only derivative that is not 0 at the origin is "
        r"$\partial^{a+b} / \partial x^a \partial y^b = a!\, b!$, which gives the term back. By "
        r"linearity it is exact on polynomials, and the remainder of a $K$ times differentiable "
        r"$f$ is Peano's $o(\|v\|^K)$.",
        lambda: sp.ff(a, a) * sp.ff(b, b) / (sp.factorial(a) * sp.factorial(b)),
        1,
    )


#: Peano's function.
_PEANO = x * y * (x**2 - y**2) / (x**2 + y**2)


@section.claim(
    "mixed-partials",
    place="Section 4, after Definition 4.1",
    printed=r"If $f$ is differentiable, the order of differentiation is irrelevant and $T_k$ is "
    r"symmetric.",
    statement=r"$T_k$ is symmetric if $f$ is $k$ times (Fréchet) differentiable at the point, in "
    r"particular if it is $C^k$; being differentiable and having all partial derivatives is not "
    r"enough.",
    verdict=Verdict.REFUTED,
)
def mixed_partials(orders: Orders, f: Any = _PEANO) -> Iterator[Step]:
    a, b, s = sp.symbols("a b s", real=True)
    g = f.subs({x: a, y: b})
    f_x, f_y = sp.diff(g, a), sp.diff(g, b)
    along_y = sp.simplify(f_x.subs({a: 0, b: s}))
    across_x = sp.simplify(f_y.subs({a: s, b: 0}))
    mixed = (sp.simplify(sp.diff(along_y, s)), sp.simplify(sp.diff(across_x, s)))
    polar = sp.simplify(f_x.subs({a: s * sp.cos(t), b: s * sp.sin(t)}))
    yield fact(
        r"$f = x y (x^2 - y^2) / (x^2 + y^2)$, $f(0) = 0$, is $C^1$ (its gradient is homogeneous "
        r"of degree 1, hence continuous at 0), $f_x(0, y) = -y$ and $f_y(x, 0) = x$: the mixed "
        r"second derivatives at 0 are $-1$ and $+1$.",
        mixed[0] != mixed[1] and sp.simplify(polar / s).free_symbols <= {t},
        shows=Shows.COUNTEREXAMPLE,
        f=f,
        f_xy=mixed[0],
        f_yx=mixed[1],
    )
    diagonal = sp.simplify(f_x.subs({a: s, b: s}))
    yield fact(
        r"What it lacks: its gradient is not differentiable at 0. The candidate derivative of "
        r"$f_x$ along $(s, s)$ is $-s$, but $f_x(s, s)$ is not $-s + o(s)$.",
        sp.simplify(diagonal - along_y) != 0,
        shows=Shows.COUNTEREXAMPLE,
        f_x_on_diagonal=diagonal,
        linear_part=along_y,
    )
    h, h_xx, h_xy, h_yx, h_yy = sp.symbols("h f_xx f_xy f_yx f_yy")
    model_x, model_y = h_xx * a + h_xy * b, h_yx * a + h_yy * b
    first = model_x.subs(b, h) - model_x.subs(b, 0)
    second = model_y.subs(a, h) - model_y.subs(a, 0)
    yield identity(
        r"Corrected (Young): let $f_x$ and $f_y$ be differentiable at 0. The second difference "
        r"$\Delta = f(h, h) - f(h, 0) - f(0, h) + f(0, 0)$ is symmetric in the variables, and by "
        r"the mean value theorem it is $h (f_x(\xi, h) - f_x(\xi, 0)) = h^2 f_{xy} + o(h^2)$ and "
        r"likewise $h^2 f_{yx} + o(h^2)$; apply it to derivatives of order $k - 2$.",
        lambda: h * first / h**2 - h * second / h**2,
        h_xy - h_yx,
    )
    m = sp.Symbol("m", integer=True, positive=True)
    monomial = x**m * y**n
    yield identity(
        r"On monomials with symbolic exponents the derivatives commute.",
        sp.Derivative(sp.Derivative(monomial, x), y),
        sp.Derivative(sp.Derivative(monomial, y), x),
        over=monomial,
    )


@section.claim(
    "lemma-gradient",
    place="Section 4, Lemma 4.2, equation (4.7)",
    printed=r"$\partial (T v^k) / \partial v = k\, T v^{k-1}$.",
    statement=r"As printed, for every $k \geq 1$.",
)
def lemma_gradient(
    orders: Orders, factor: Callable[[Any], Any] = lambda order: order
) -> Iterator[Step]:
    form = sp.binomial(k, i) * _MONOMIAL
    rows = (
        ("x", x, sp.binomial(k - 1, i - 1) * x ** (i - 1) * y ** (k - i), "i-1"),
        ("y", y, sp.binomial(k - 1, i) * x**i * y ** (k - 1 - i), "i"),
    )
    for name, variable, contracted, lower in rows:
        yield identity(
            rf"The tensor with the one component $a_i = 1$ has $T v^k = \binom{{k}}{{i}} x^i "
            rf"y^{{k-i}}$ and $T_{name} v^{{k-1}}$ has the coefficient "
            rf"$\binom{{k-1}}{{{lower}}}$; its derivative by ${name}$ equals "
            rf"$k\, T_{name} v^{{k-1}}$ for symbolic $i$ and $k$.",
            sp.Derivative(form, variable),
            factor(k) * contracted,
            over=form,
        )


@section.claim(
    "theorem-equivalence",
    place="Section 4, Theorem 4.3, equations (4.10) and (4.13)",
    printed=r"The unit vectors with $\partial (T_k v^k) / \partial \theta = 0$ are the real "
    r"E-eigenvectors of $T_k$, $\lambda = T_k v^k$, and the reverse holds.",
    statement=r"$|v|^2\, T v^{k-1} - (T v^k)\, v = (F / k)\, (-y, x)$ with $F = x f_y - y f_x = "
    r"\mathrm{d}f / \mathrm{d}\theta$; as $(-y, x) \neq 0$ both directions follow, for every $k "
    r"\geq 1$ and for complex angles too.",
)
def theorem_equivalence(
    orders: Orders,
    factor: Callable[[Any], Any] = lambda order: 1 / order,
    normal: tuple[Any, Any] = (-y, x),
) -> Iterator[Step]:
    F = x * sp.Derivative(_MONOMIAL, y) - y * sp.Derivative(_MONOMIAL, x)
    for name, coordinate, side in zip(("first", "second"), (x, y), normal, strict=True):
        yield identity(
            rf"The {name} component, on $x^i y^{{k-i}}$ with symbolic $i$ and $k$, hence by "
            r"linearity on every form.",
            (x**2 + y**2) * sp.Derivative(_MONOMIAL, coordinate) / k - _MONOMIAL * coordinate,
            factor(k) * F * side,
            over=_MONOMIAL,
        )
    radius = sp.Symbol("r", positive=True)
    angle = sp.Symbol("theta", positive=True)
    polar = {x: radius * sp.cos(angle), y: radius * sp.sin(angle)}
    yield identity(
        r"$\partial f / \partial \theta = F$, by the chain rule on the same monomial.",
        sp.Derivative(_MONOMIAL.subs(polar), angle),
        F.doit().subs(polar),
        over=_MONOMIAL.subs(polar),
    )
    yield identity(
        r"The vector $(-y, x)$ has $|(-y, x)|^2 = |v|^2 = 1$, so it is not 0 and the left side "
        r"vanishes exactly where $F$ does.",
        lambda: normal[0] ** 2 + normal[1] ** 2,
        lambda: x**2 + y**2,
    )


@section.claim(
    "extrema-or-critical",
    place="Section 4, Definition 4.6 and the text around equations (4.13) and (4.17)",
    printed=r"The principal directions are the extrema of $g_k$.",
    statement=r"They are its critical points: maxima, minima and, for every $k \geq 3$, also "
    r"inflections.",
    verdict=Verdict.REFUTED,
)
def extrema_or_critical(orders: Orders, f: Any = y**3, order: int = 3) -> Iterator[Step]:
    g = f.subs({x: sp.cos(t), y: sp.sin(t)})
    derivatives = [sp.diff(g, t, j).subs(t, 0) for j in range(4)]
    t_v = tuple(c.subs({x: 1, y: 0}) for c in tensor_on(f, order))
    yield fact(
        r"$f = y^3$: $(\pm 1, 0)$ is an E-eigenvector with $\lambda = 0$, and there $g' = g'' = "
        r"0$, $g''' \neq 0$: an inflection, no extremum.",
        t_v == (derivatives[0], 0)
        and derivatives[1] == derivatives[2] == 0
        and derivatives[3] != 0,
        shows=Shows.COUNTEREXAMPLE,
        f=f,
        eigenvector="(1, 0)",
        eigenvalue=derivatives[0],
        derivatives_of_g=derivatives,
    )
    power = sp.Symbol("k", integer=True, positive=True)
    family = x ** (power - 3) * y**3
    yield identity(
        r"For every $k \geq 3$ the form $x^{k-3} y^3$ has $F = x^{k-4} y^2 (3 x^2 - (k - 3) "
        r"y^2)$, with a double root at $y = 0$ where $F$ does not change sign.",
        x * sp.Derivative(family, y) - y * sp.Derivative(family, x),
        x ** (power - 4) * y**2 * (3 * x**2 - (power - 3) * y**2),
        over=family,
    )
    counts = {}
    for o in (o for o in orders if o >= 3):
        p = form_of_expression(x ** (o - 3) * y**3)
        counts[o] = real_lines(o, critical(o, p))
    yield fact(
        r"Counted with Sturm's sequences on these forms: critical lines by multiplicity; a line of "
        r"multiplicity 2 is present each time.",
        all(2 in count for count in counts.values()),
        lines_by_multiplicity=counts,
    )
    a, b, c = sp.symbols("a b c", real=True)
    F = sp.Poly(sp.expand(angular(a * x**2 + b * x * y + c * y**2).subs({x: 1, y: t})), t)
    squares = 4 * (a - c) ** 2 + 4 * b**2
    yield fact(
        r"No form of order 2 has an inflection: $F$ is a quadratic form, zero or with two "
        r"different real roots, as its discriminant is a sum of squares.",
        sp.expand(F.discriminant() - squares) == 0,
        F=F.as_expr(),
        discriminant=squares,
    )


#: e = e^(i t); on the circle cos t = (e + 1/e) / 2 and sin t = (e - 1/e) / (2 i).
_E = sp.Symbol("e", nonzero=True)


def _on_circle(e: Any) -> tuple[Any, Any]:
    return (e + 1 / e) / 2, (e - 1 / e) / (2 * sp.I)


@section.claim(
    "wavejets-symmetry",
    place="Section 4, after equation (4.14)",
    printed=r"$\phi_{k,-n} = \overline{\phi_{k,n}}$, and $\phi_{k,n} = 0$ unless $n$ and $k$ have "
    r"the same parity.",
    statement=r"As printed, for the Taylor terms of every real $f$. A regression over all $n$ "
    r"does not have the parity by itself: it must be imposed.",
)
def wavejets_symmetry(
    orders: Orders, parity: Callable[[Any], Any] = lambda order: (-1) ** order
) -> Iterator[Step]:
    cosine, sine = _on_circle(_E)
    minus = tuple(c.subs(_E, -_E) for c in (cosine, sine))
    a, b = sp.symbols("a b", integer=True, nonnegative=True)
    ratio = sp.factor(minus[0] / cosine) ** a * sp.factor(minus[1] / sine) ** b
    yield identity(
        r"Replacing $e = e^{i t}$ by $-e$ multiplies $\cos^a t\, \sin^b t$ by $(-1)^{a + b} = "
        r"(-1)^k$ and $e^n$ by $(-1)^n$: only $n$ with $(-1)^n = (-1)^k$ occur.",
        ratio,
        parity(a + b),
    )
    mirrored = tuple(sp.simplify(c.subs(_E, 1 / _E).subs(sp.I, -sp.I)) for c in (cosine, sine))
    yield fact(
        r"Conjugation on the circle, $e \to 1/e$ and $i \to -i$, leaves $\cos t$ and $\sin t$, "
        r"hence every real form, alone; it takes $\phi_n e^n$ to $\overline{\phi_n} e^{-n}$.",
        all(sp.simplify(m - c) == 0 for m, c in zip(mirrored, (cosine, sine), strict=True)),
        conjugated=mirrored,
    )
    rho, c1, c2 = sp.symbols("rho c_10 c_20")
    fit = sp.integrate(sp.expand((rho**4 - c1 * rho - c2 * rho**2) ** 2 * rho), (rho, 0, 1))
    free = sp.solve([sp.diff(fit, c1), sp.diff(fit, c2)], [c1, c2])
    yield fact(
        r"A fit does not know it: the least squares fit of the smooth $r^4$ on the unit disc by "
        r"$\phi_{1,0}\, r + \phi_{2,0}\, r^2$ has $\phi_{1,0} \neq 0$, which no smooth function "
        r"has.",
        free[c1] != 0,
        phi_10=free[c1],
        phi_20=free[c2],
    )


@section.claim(
    "corollary-wavejets",
    place="Section 4, Corollary 4.5, equations (4.16) and (4.17)",
    printed=r"The directions are the zeros of $\sum_n i n\, \phi_{k,n} e^{i n \theta}$, and of "
    r"$\sum_{n \geq 1} n\, (\mathrm{Im}\, \phi_{k,n} \cos n\theta + \mathrm{Re}\, \phi_{k,n} \sin "
    r"n\theta)$.",
    statement=r"As printed, for every $k$; precisely, $g_k'$ is $-2$ times the real form.",
)
def corollary_wavejets(orders: Orders, factor: Any = -2, sign: int = 1) -> Iterator[Step]:
    a, b = sp.symbols("a b", real=True)
    phi = a + sp.I * b
    pair = phi * sp.exp(sp.I * n * t) + sp.conjugate(phi) * sp.exp(-sp.I * n * t)
    termwise = sp.I * n * phi * sp.exp(sp.I * n * t) - sp.I * n * sp.conjugate(phi) * sp.exp(
        -sp.I * n * t
    )
    yield identity(
        r"Term by term, $\mathrm{d}/\mathrm{d}\theta$ of $\phi_n e^{i n \theta} + "
        r"\overline{\phi_n} e^{-i n \theta}$ is the pair $\pm n$ of (4.16), symbolic $n$.",
        sp.Derivative(pair, t),
        termwise,
    )
    yield identity(
        r"It is $-2 n\, (\mathrm{Im}\, \phi_n \cos n\theta + \mathrm{Re}\, \phi_n \sin n\theta)$, "
        r"symbolic $n$; the term $n = 0$ gives 0. With Theorem 4.3 the zeros are the "
        r"E-eigenvectors.",
        sp.Derivative(pair, t),
        factor * n * (b * sp.cos(n * t) + sign * a * sp.sin(n * t)),
    )


@section.claim(
    "eigenvalue-link",
    place="Section 4, after equation (4.17)",
    printed=r"$g_k(\theta_e) = \lambda_e / k!$.",
    statement=r"As printed, for every $k$.",
)
def eigenvalue_link(
    orders: Orders, factor: Callable[[Any], Any] = lambda order: 1 / sp.factorial(order)
) -> Iterator[Step]:
    gradient = (sp.Derivative(_MONOMIAL, x), sp.Derivative(_MONOMIAL, y))
    yield identity(
        r"$\lambda = \lambda\, v \cdot v = v \cdot T v^{k-1} = T v^k$, on $x^i y^{k-i}$ with "
        r"symbolic exponents.",
        (x * gradient[0] + y * gradient[1]) / k,
        _MONOMIAL,
        over=_MONOMIAL,
    )
    a, b = sp.symbols("a b", integer=True, nonnegative=True)
    derivative, value = sp.factorial(a) * sp.factorial(b), sp.Integer(1)
    yield identity(
        r"$g = T v^k / k!$: for $f = x^a y^b$, $k = a + b$, the tensor's component is $a!\, b!$ "
        r"and occurs $\binom{k}{a}$ times, so $g = \lambda / k!$ is the value of $x^a y^b$ itself.",
        sp.binomial(a + b, a) * derivative * factor(a + b),
        value,
    )
