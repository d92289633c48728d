"""Constants of one run, and the scratch memory of one thread."""

from __future__ import annotations

from functools import lru_cache
from math import comb, factorial, gamma
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt
from numba import types
from numba.experimental import structref

from pdtheory.conventions import frequencies
from pdtheory.pointset.kernels.jit import Array, inner
from pdtheory.pointset.kernels.moments import BLOCK, table_rows
from pdtheory.pointset.kernels.regression import coefficient_count
from pdtheory.pointset.kernels.roots import DEPTH, SAMPLES


class Tables(NamedTuple):
    """Constants that depend on the degree only.

    Attributes
    ----------
    real, imaginary : (K + 1, K // 2 + 1, K + 1) float64
        phi_{k,n} = sum_b (real + i imaginary)[k, j, b] c_{k-b,b} with n = k mod 2 + 2 j.
    binomial : (K + 1, K + 1) float64
        Binomial coefficients.
    factorial : (K + 1,) float64
        k!.
    full_disc : (K + 1,) float64
        Smallest relative pivot of each degree for points that fill the disc evenly.
    cosines, sines : (K + 1, SAMPLES + 1) float64
        cos and sin of n theta_j, theta_j = j pi / SAMPLES.
    """

    real: Any
    imaginary: Any
    binomial: Any
    factorial: Any
    full_disc: Any
    cosines: Any
    sines: Any


@structref.register
class _ScratchType(types.StructRef):
    """The type of `Scratch` in compiled code: a reference, so that it costs nothing to pass on."""


class Scratch(structref.StructRefProxy):
    """Working memory, reused from point to point; allocated by `make_scratch`."""

    X: Any
    V: Any
    offsets: Any
    moments: Any
    heights: Any
    G: Any
    S: Any
    c: Any
    step: Any
    diagonal: Any
    pivots: Any
    spare: Any
    table: Any
    middle: Any
    square: Any
    frame: Any
    A: Any
    Q: Any
    line: Any
    re: Any
    im: Any
    samples: Any
    stack: Any
    angle: Any
    kind: Any
    full_disc: Any
    powers: Any
    gradient: Any
    spreads: Any
    covariance: Any
    found: Any


structref.define_proxy(Scratch, _ScratchType, list(Scratch.__annotations__))


def _full_disc_pivots(degree: int) -> npt.NDArray[np.float64]:
    """Return the smallest relative pivot of each degree for the continuous weighted disc."""
    nodes, weights = np.polynomial.legendre.leggauss(64)
    r = (nodes + 1) / 2
    radial = [
        float(np.sum(weights / 2 * r ** (d + 1) * np.exp(-4.5 * r**2)))
        for d in range(2 * degree + 1)
    ]
    powers = [(d - b, b) for d in range(degree + 1) for b in range(d + 1)]

    def moment(a: int, b: int) -> float:
        if a % 2 or b % 2:
            return 0.0
        return radial[a + b] * 2 * gamma((a + 1) / 2) * gamma((b + 1) / 2) / gamma((a + b) / 2 + 1)

    gram = np.array([[moment(a + c, b + d) for c, d in powers] for a, b in powers])
    pivots = np.diag(np.linalg.cholesky(gram)) ** 2 / np.diag(gram)
    return np.array(
        [min(pivots[i] for i, (a, b) in enumerate(powers) if a + b == d) for d in range(degree + 1)]
    )


@lru_cache(maxsize=16)
def make_tables(degree: int) -> Tables:
    """Build the constants for degree K = `degree`."""
    real = np.zeros((degree + 1, degree // 2 + 1, degree + 1))
    imaginary = np.zeros_like(real)
    for k in range(degree + 1):
        for b in range(k + 1):
            # cos^(k-b) sin^b as powers of u = e^{i theta}: exact integers over 2^k i^b.
            powers = [
                sum(
                    comb(k - b, m - j) * comb(b, j) * (-1) ** j
                    for j in range(max(0, m - k + b), min(b, m) + 1)
                )
                for m in range(k + 1)
            ]  # coefficient of u^(k - 2 m)
            unit = (1, -1j, -1, 1j)[b % 4]
            for j, n in enumerate(frequencies(k)):
                value = unit * powers[(k - n) // 2] / 2**k
                real[k, j, b] = value.real
                imaginary[k, j, b] = value.imag
    binomial = np.array([[comb(i, j) for j in range(degree + 1)] for i in range(degree + 1)], float)
    factorials = np.array([factorial(k) for k in range(degree + 1)], float)
    angles = np.outer(np.arange(degree + 1), np.arange(SAMPLES + 1) * (np.pi / SAMPLES))
    return Tables(
        real,
        imaginary,
        binomial,
        factorials,
        _full_disc_pivots(degree),
        np.cos(angles),
        np.sin(angles),
    )


@inner
def make_scratch(degree: int, full_disc: Array) -> Scratch:
    """Allocate working memory for degree K = `degree` (at least 4)."""
    n = coefficient_count(degree)
    rows = table_rows(degree)
    return Scratch(
        np.empty((rows, BLOCK + 8)),
        np.empty((rows, BLOCK + 8)),
        np.empty(n, dtype=np.int64),
        np.empty((2 * degree + 10, 2 * degree + 10)),
        np.empty((2 * degree + 10, 2 * degree + 10)),
        np.empty((n, n)),
        np.empty((n, n)),
        np.empty(n),
        np.empty(n),
        np.empty(n),
        np.empty(n),
        np.empty(n),
        np.empty((degree + 1, degree + 1)),
        np.empty((degree + 1, degree + 1)),
        np.empty((degree + 2, degree + 2)),
        np.empty((3, 3)),
        np.empty((3, 3)),
        np.empty((3, 3)),
        np.empty(BLOCK),
        np.empty(degree // 2 + 1),
        np.empty(degree // 2 + 1),
        np.empty((2, SAMPLES + 1)),
        np.empty((DEPTH + 3, 6)),
        np.empty(degree + 1),
        np.empty(degree + 1, dtype=np.int8),
        full_disc,
        np.empty((2, degree + 1)),
        np.empty((2, n)),
        np.empty((max(degree + 1, 4), n)),
        np.empty((degree + 1, degree + 1)),
        np.empty((2 * degree, 5)),
    )
