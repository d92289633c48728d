"""How fast the exact side is, against SymPy's own routes on the same forms in the same run.

Run ``python benchmarks/exact.py [--repeat N] [--limit SECONDS]``. Every figure is the median of
the processor time over random forms with integer coefficients in [-99, 99]; caches are emptied
before each form.
"""

from __future__ import annotations

import argparse
import random
import signal
import statistics
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any

import sympy as sp
from rich.console import Console
from rich.table import Table
from sympy.core.cache import clear_cache

from pdtheory.exact import BinaryForm, balls, characteristic_polynomial, real_eigenpairs

T = sp.Symbol("t", real=True)
TARGETS = {8: 5e-3, 20: 25e-3, 64: 1.0}
PSI_ORDER, PSI_TARGET = 12, 1.0


class OverTime(Exception):
    """The limit for one run has passed."""


@contextmanager
def time_limit(seconds: float) -> Iterator[None]:
    """Interrupt the block after a number of seconds."""

    def stop(*_: Any) -> None:
        raise OverTime

    before = signal.signal(signal.SIGALRM, stop)
    signal.setitimer(signal.ITIMER_REAL, seconds)
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)
        signal.signal(signal.SIGALRM, before)


def random_form(order: int, seed: int) -> BinaryForm:
    """Return a form with random integer coefficients."""
    rng = random.Random(1000 * order + seed)
    return BinaryForm([rng.randint(-99, 99) for _ in range(order + 1)])


def certified(form: BinaryForm) -> list[tuple[float, float, int]]:
    """Angle, eigenvalue to 15 certified digits and kind of all pairs, by this library."""
    return [
        (
            float(p.angle_enclosure(15).middle),
            float(p.eigenvalue_enclosure(15).middle),
            int(p.kind),
        )
        for p in real_eigenpairs(form)
    ]


def derivative(form: BinaryForm) -> Any:
    """F(1, t) as a SymPy polynomial."""
    return sp.Poly(sum(c * T**j for j, c in enumerate(form.angular_derivative().coefficients)), T)


def finish(form: BinaryForm, roots: list[Any]) -> list[tuple[float, float, int]]:
    """Angle, eigenvalue and kind from real roots, numerically, for the routes of SymPy."""
    k = form.order
    slope = derivative(form).diff(T)
    pairs = []
    for root in roots:
        value = sum(c * root**j for j, c in enumerate(form.coefficients))
        eigenvalue = sp.N(value / (1 + root**2) ** sp.Rational(k, 2), 15)
        kind = -int(sp.sign(sp.N(slope.eval(root), 15)))
        pairs.append((float(sp.N(sp.atan(root) * 180 / sp.pi, 15)), float(eigenvalue), kind))
        opposite = (-1) ** k
        pairs.append((pairs[-1][0] + 180, opposite * pairs[-1][1], opposite * kind))
    return pairs


def by_nroots(form: BinaryForm) -> list[tuple[float, float, int]]:
    """SymPy's numerical roots: not certified, and real only if they look it."""
    roots = derivative(form).nroots(n=15, maxsteps=500)
    return finish(form, [r for r in roots if r.is_real])


def by_solveset(form: BinaryForm) -> list[tuple[float, float, int]]:
    """SymPy's solveset over the reals: exact."""
    found = sp.solveset(derivative(form).as_expr(), T, sp.S.Reals)
    return finish(form, [sp.N(r, 20) for r in found])


def by_real_roots(form: BinaryForm) -> list[tuple[float, float, int]]:
    """SymPy's certified isolation, the nearest to the same answer."""
    return finish(form, [sp.N(r, 20) for r in derivative(form).real_roots()])


def psi_by_resultant(form: BinaryForm) -> Any:
    """The E-characteristic polynomial of even order by SymPy's resultant."""
    x, y, value = sp.symbols("x y lambda")
    f, k = form.expression, form.order
    sphere = (1 + T**2) ** (k // 2 - 1)
    first, second = (
        sp.expand(sp.diff(f, w).subs({x: 1, y: T}) / k - value * sphere * c)
        for w, c in ((x, 1), (y, T))
    )
    return sp.resultant(first, second, T)


def median_time(
    run: Callable[[BinaryForm], Any], forms: list[BinaryForm], limit: float
) -> str | float:
    """Return the median time of a run over forms in seconds, or why there is none."""
    times = []
    for form in forms:
        clear_cache()
        balls.real_roots.cache_clear()
        balls.complex_roots.cache_clear()
        start = time.process_time()
        try:
            with time_limit(limit):
                run(form)
        except OverTime:
            return f"over {limit:g} s"
        except (sp.polys.polyerrors.BasePolynomialError, ValueError, NotImplementedError) as error:
            return f"fails ({type(error).__name__})"
        except Exception as error:  # NoConvergence comes from mpmath without a common base
            return f"fails ({type(error).__name__})"
        times.append(time.process_time() - start)
    return statistics.median(times)


def show(value: str | float) -> str:
    """Return a time with a unit."""
    return value if isinstance(value, str) else f"{1e3 * value:.3g} ms"


def ratio(value: str | float, own: str | float) -> str:
    """Return how much slower, or what is known of it."""
    if isinstance(value, str) or isinstance(own, str):
        return "-"
    return f"{value / own:.3g} x"


def main() -> None:
    """Measure and print the tables."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--repeat", type=int, default=21, help="forms per order for this library")
    parser.add_argument("--peers", type=int, default=5, help="forms per order for SymPy's routes")
    parser.add_argument("--limit", type=float, default=30.0, help="seconds for one run")
    options = parser.parse_args()
    real_eigenpairs(BinaryForm([1, 2, 3]))  # import everything once

    table = Table(title="Real E-eigenpairs with lambda and kind, median")
    for heading in ("order", "pdtheory", "target", "nroots", "ratio", "real_roots", "ratio",
                    "solveset", "ratio"):  # fmt: skip
        table.add_column(heading, justify="right")
    for order, target in TARGETS.items():
        forms = [random_form(order, s) for s in range(options.repeat)]
        own = median_time(certified, forms, options.limit)
        cells = [str(order), show(own), show(target)]
        for run in (by_nroots, by_real_roots, by_solveset):
            other = median_time(run, forms[: options.peers], options.limit)
            cells += [show(other), ratio(other, own)]
        table.add_row(*cells)
    console = Console(width=140)
    console.print(table)

    table = Table(title="E-characteristic polynomial, median")
    for heading in ("order", "pdtheory", "target", "resultant", "ratio"):
        table.add_column(heading, justify="right")
    for order in (4, 8, PSI_ORDER):
        forms = [random_form(order, s) for s in range(options.repeat)]
        own = median_time(characteristic_polynomial, forms, options.limit)
        other = median_time(psi_by_resultant, forms[: options.peers], options.limit)
        target = show(PSI_TARGET) if order == PSI_ORDER else ""
        table.add_row(str(order), show(own), target, show(other), ratio(other, own))
    console.print(table)


if __name__ == "__main__":
    main()
