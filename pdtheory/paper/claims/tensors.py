"""Section 3: symmetric tensors of dimension 2 and their E-eigenvalues."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from itertools import product
from typing import Any

import sympy as sp

from pdtheory.paper.claims.core import Orders, Section, Shows, Step, Verdict
from pdtheory.paper.claims.kit import angular, fact, i, identity, k, tensor_on, x, y

section = Section("Section 3: arbitrary order symmetric tensors")

#: Dense arrays have 2^k entries; the argument does not depend on k, the arrays only illustrate it.
LARGEST_DENSE_ORDER = 8


def _symmetric(index: tuple[int, ...]) -> Any:
    """Return the component of a generic symmetric tensor: it depends on the number of ones only."""
    return sp.Symbol(f"a{index.count(1)}")


@section.claim(
    "tensor-contraction",
    place="Section 3, equation (3.1)",
    printed=r"$T v = x T_x + y T_y$, and since $T$ is symmetric any index may be contracted.",
    statement=r"For a symmetric $T$ of any order $k \geq 1$, contracting any of the $k$ indices "
    r"with $v = (x, y)$ gives the same tensor $x T_x + y T_y$ of order $k - 1$.",
)
def tensor_contraction(
    orders: Orders, component: Callable[[tuple[int, ...]], Any] = _symmetric
) -> Iterator[Step]:
    m = sp.Symbol("m", integer=True, nonnegative=True)
    a = sp.Function("a")
    yield identity(
        r"A component depends only on the number of its indices equal to 1, because any "
        r"permutation of them leaves it alone. If $m$ of the free indices are 1, contracting at "
        r"any place gives $x\,a_{m+1} + y\,a_m$, as contracting at the first place does.",
        lambda: x * a(m + 1) + y * a(m),
        lambda: x * a(1 + m) + y * a(0 + m),
    )
    dense = sorted({2, 3, *(o for o in orders if o <= LARGEST_DENSE_ORDER)})
    agree = {
        order: all(
            sp.expand(
                x * (component((*j[:place], 1, *j[place:])) - component((1, *j)))
                + y * (component((*j[:place], 2, *j[place:])) - component((2, *j)))
            )
            == 0
            for j in product((1, 2), repeat=order - 1)
            for place in range(order)
        )
        for order in dense
    }
    yield fact(
        "Written out: all contractions of the dense array with symbolic entries agree.",
        all(agree.values()),
        orders=dense,
    )


@section.claim(
    "symmetry-definition",
    place="Section 3, Definition 3.1 and the paragraph after it",
    printed=r"A tensor of order $k$ has indices $i_j$ with $j \in [0, k]$, and $v^k$ multiplies "
    r"$v$ $k$ times by the Cartesian product.",
    statement=r"A tensor of order $k$ has $k$ indices, $j \in [1, k]$, and $v^k$ is the outer "
    r"product, with the $2^k$ entries $v_{i_1} \cdots v_{i_k}$.",
    verdict=Verdict.MISPRINT,
)
def symmetry_definition(orders: Orders, first_index: int = 1) -> Iterator[Step]:
    yield identity(
        r"The index set $[1, k]$ has $k$ elements, one for each dimension.",
        lambda: k - first_index + 1,
        k,
    )
    yield fact(
        r"The printed index set $[0, k]$ has $k + 1$ elements, one more than the array has "
        r"dimensions.",
        sp.simplify((k - 0 + 1) - k) == 1,
        shows=Shows.MISPRINT,
        printed_indices=k + 1,
        dimensions=k,
    )
    sizes = {order: (2**order, 2 * order) for order in sorted({3, *orders})}
    yield fact(
        r"A Cartesian product of $k$ copies of $v$ is a list of $k$ vectors, with $2k$ numbers; a "
        r"tensor of order $k$ has $2^k$ entries, and the two differ for every $k \geq 3$.",
        all(outer != cartesian for o, (outer, cartesian) in sizes.items() if o >= 3)
        and sp.simplify(2 ** (k + 1) - 2 * 2**k) == 0,
        shows=Shows.MISPRINT,
        sizes=sizes,
    )
    order = 4
    entries = {
        index: sp.prod([(x, y)[j - 1] for j in index]) for index in product((1, 2), repeat=order)
    }
    yield fact(
        rf"The entries $v_{{i_1}} \cdots v_{{i_k}}$ are symmetric and $v^k$ contracted with $w$ "
        rf"at all indices is $(v \cdot w)^k$ (order {order}).",
        all(entry == entries[tuple(sorted(index))] for index, entry in entries.items())
        and sp.expand(
            sum(
                entry * sp.prod([sp.symbols("p q")[j - 1] for j in index])
                for index, entry in entries.items()
            )
            - (x * sp.Symbol("p") + y * sp.Symbol("q")) ** order
        )
        == 0,
        entries=len(entries),
    )


def _euler() -> Step:
    monomial = x**i * y ** (k - i)
    gradient = (sp.Derivative(monomial, x), sp.Derivative(monomial, y))
    return identity(
        r"$v \cdot T v^{k-1} = T v^k$, on $x^i y^{k-i}$ with symbolic $i$ and $k$, hence by "
        r"linearity for every tensor of every order. So $T v^{k-1} = \lambda v$ and $v \cdot v = "
        r"1$ give $\lambda = \lambda\, v \cdot v = T v^k$, a real polynomial in $v$: real for "
        r"real $v$.",
        (x * gradient[0] + y * gradient[1]) / k,
        monomial,
        over=monomial,
    )


#: f = x^3 + 3/4 x y^2: its E-eigenvectors outside R^2 have the E-eigenvalues i/2 and -i/2.
_CUBIC = x**3 + sp.Rational(3, 4) * x * y**2


def _eigenpair(f: Any, order: int, vector: tuple[Any, Any], value: Any) -> bool:
    """Tell whether T v^(k-1) = lambda v and v.v = 1, exactly."""
    at = dict(zip((x, y), vector, strict=True))
    t_x, t_y = (component.subs(at) for component in tensor_on(f, order))
    equations = (
        t_x - value * vector[0],
        t_y - value * vector[1],
        vector[0] ** 2 + vector[1] ** 2 - 1,
    )
    return all(sp.expand(equation) == 0 for equation in equations)


@section.claim(
    "e-eigen-real",
    place="Section 3, Definition 3.2, and the remark after Definition 4.4",
    printed=r"Qi's E-eigenvectors are taken with $v \in \mathbb{R}^2$ and $\lambda \in "
    r"\mathbb{C}$; where $\lambda$ is real as well the pair is a Z-eigenpair.",
    statement=r"Qi's E-eigenvectors are in $\mathbb{C}^2$. For a real one "
    r"$\lambda = T v^k$ is real by itself, so every real E-eigenvector is a Z-eigenvector.",
    verdict=Verdict.MISPRINT,
)
def e_eigen_real(
    orders: Orders,
    f: Any = _CUBIC,
    vector: tuple[Any, Any] = (sp.I, sp.sqrt(2)),
    value: Any = sp.I / 2,
) -> Iterator[Step]:
    yield _euler()
    yield fact(
        r"Over $\mathbb{R}^2$ pairs are lost that Qi counts: $f = x^3 + \tfrac34 x y^2$ has the "
        r"E-eigenvector $(i, \sqrt 2)$ with $\lambda = i/2$, so $\mathbb{R}^2$ is printed for "
        r"$\mathbb{C}^2$.",
        _eigenpair(f, 3, vector, value) and not sp.im(value).is_zero,
        shows=Shows.MISPRINT,
        f=f,
        v=vector,
        eigenvalue=value,
    )


@section.claim(
    "e-characteristic-roots",
    place="Section 3, Definition 3.2",
    printed=r"The set of $\lambda$ that satisfy (3.2) with a real $v$ are the roots of the "
    r"E-characteristic polynomial.",
    statement=r"The $\lambda$ of *complex* E-eigenvectors of a *regular* tensor are the roots of "
    r"the E-characteristic polynomial.",
    verdict=Verdict.REFUTED,
)
def e_characteristic_roots(
    orders: Orders,
    f: Any = _CUBIC,
    irregular: Any = x * (x**2 + y**2) ** 2,
) -> Iterator[Step]:
    yield from _real_eigenvalues_are_not_all(f)
    lam = sp.Symbol("lambda")
    a = sp.Symbol("a", positive=True)
    cosine, sine = sp.symbols("c s")
    on_circle = tensor_on(irregular, 5)
    at = {x: sp.I * a, y: a}
    yield fact(
        r"$f = x (x^2 + y^2)^2$ is irregular: $T v^4 = 0$ on the isotropic vectors $(\pm i, 1)$. "
        r"So for every $\lambda$ the homogenised equations have a common zero, their resultant "
        r"$\psi$ is the zero polynomial, and every $\lambda$ is a root; real $v$ give $\pm 1$ "
        r"alone.",
        all(sp.expand(component.subs(at)) == 0 for component in on_circle)
        and sp.expand((x**2 + y**2).subs(at)) == 0
        and _eigenvalues_on_circle(irregular, cosine, sine) == {sp.Integer(1), sp.Integer(-1)},
        shows=Shows.COUNTEREXAMPLE,
        f=irregular,
        gradient_at_isotropic=tuple(sp.expand(c.subs(at)) for c in on_circle),
        real_eigenvalues=sorted(_eigenvalues_on_circle(irregular, cosine, sine)),
    )
    monomial = x**i * y ** (k - i)
    yield identity(
        r"Corrected: for $v \cdot v = 1$, real or complex, $T v^{k-1} - (T v^k) v = (F / k) (-y, "
        r"x)$ with $F = x f_y - y f_x$ (first component, symbolic exponents), so E-eigenvectors "
        r"are the common zeros of $F$ and $v \cdot v - 1$, with $\lambda = f(v)$.",
        (x**2 + y**2) * sp.Derivative(monomial, x) / k - monomial * x,
        -y / k * (x * sp.Derivative(monomial, y) - y * sp.Derivative(monomial, x)),
        over=monomial,
    )
    h, order = sp.symbols("h k", positive=True)
    yield identity(
        r"$\psi(\lambda)$ is the resultant of $T v^{k-1} = \lambda x_0^{k-2} v$ and $v \cdot v = "
        r"x_0^2$, which are homogeneous (scaling by $h$ multiplies both sides of the first by "
        r"$h^{k-1}$): it is 0 exactly if they have a common zero $(v, x_0) \neq 0$. For $k \geq "
        r"3$ and $x_0 = 0$ that would be $T v^{k-1} = 0$, $v \cdot v = 0$, which regular tensors "
        r"exclude; else $x_0$ can be scaled to 1, and $v$ is an E-eigenvector with the "
        r"E-eigenvalue $\lambda$.",
        lambda: h ** (order - 2) * h,
        h ** (order - 1),
    )
    yield from _resultant_roots(f, lam)


def _eigenvalues_on_circle(f: Any, cosine: Any, sine: Any) -> set[Any]:
    circle = cosine**2 + sine**2 - 1
    F = sp.expand(angular(f).subs({x: cosine, y: sine}))
    return {
        sp.simplify(f.subs({x: c, y: s}))
        for c, s in sp.solve([F, circle], [cosine, sine])
        if c.is_real and s.is_real
    }


def _characteristic(f: Any, order: int, lam: Any) -> Any:
    """Return Res_t(F, f^2 - lambda^2 (1 + t^2)^k) at (1, t), for an odd form a multiple of psi."""
    slope = sp.Symbol("t")
    F = sp.expand(angular(f).subs({x: 1, y: slope}))
    value = f.subs({x: 1, y: slope}) ** 2 - lam**2 * (1 + slope**2) ** order
    return sp.factor(sp.resultant(F, sp.expand(value), slope))


def _real_eigenvalues_are_not_all(f: Any) -> Iterator[Step]:
    lam = sp.Symbol("lambda")
    cosine, sine = sp.symbols("c s")
    psi = sp.Poly(_characteristic(f, 3, lam), lam)
    roots = set(sp.roots(psi))
    real = _eigenvalues_on_circle(f, cosine, sine)
    yield fact(
        r"$f = x^3 + \tfrac34 x y^2$: the roots of $\psi \sim (\lambda^2 - 1)(4 \lambda^2 + 1)^2$ "
        r"are $\pm 1$ and $\pm i/2$, but a real $v$ gives $\pm 1$ only.",
        real < roots and sp.rem(psi, sp.Poly((lam**2 - 1) * (4 * lam**2 + 1) ** 2, lam)) == 0,
        shows=Shows.COUNTEREXAMPLE,
        f=f,
        psi=psi.as_expr().factor(),
        roots=sorted(roots, key=str),
        real_eigenvalues=sorted(real),
    )


def _resultant_roots(f: Any, lam: Any) -> Iterator[Step]:
    z, w = sp.symbols("z w")
    isotropic = sp.expand(f.subs({x: (z + w) / 2, y: (z - w) / (2 * sp.I)}))
    phi_3 = isotropic.coeff(z, 3)
    roots = sorted(sp.roots(sp.Poly(_characteristic(f, 3, lam), lam)), key=str)
    complex_pairs = [
        ((sp.Integer(1), sp.Integer(0)), sp.Integer(1)),
        ((sp.Integer(-1), sp.Integer(0)), sp.Integer(-1)),
        ((sp.I, sp.sqrt(2)), sp.I / 2),
        ((-sp.I, sp.sqrt(2)), -sp.I / 2),
    ]
    yield fact(
        r"For example, every root of $\psi$ of the regular cubic above (its coefficient of "
        r"$(x + i y)^3$ is not 0) belongs to a complex E-eigenvector; see also "
        r"*e-characteristic-polynomial*.",
        phi_3 != 0
        and all(_eigenpair(f, 3, vector, value) for vector, value in complex_pairs)
        and {value for _, value in complex_pairs} == set(roots),
        regular_since=phi_3,
        pairs=complex_pairs,
        roots=roots,
    )
