"""Constants of one run, and the working memory of one thread."""

from __future__ import annotations

from functools import cache
from math import comb, factorial, gamma
from typing import Any

import numpy as np
import numpy.typing as npt

from pdtheory.conventions import frequencies
from pdtheory.pointset.kernels.cholesky import WIDEST, padded_columns, padded_rows
from pdtheory.pointset.kernels.jit import Array
from pdtheory.pointset.kernels.lanes import LANES
from pdtheory.pointset.kernels.moments import BLOCK, CLOUD_ROWS, WIDE, cube_rows

#: Sample intervals of the angles on the half circle.
SAMPLES = 64
#: Side of the tables of coefficients, above the largest degree.
SIDE = 16
#: Cells on each side of the own one that a ball can touch: the cell is at least half a radius.
REACH = 2
#: Columns of cells that a ball can touch.
COLUMNS = (2 * REACH + 1) ** 2
#: Rows of a product of polynomials that are computed together.
ROWS = 4
#: Shape of a table of coefficients, with zeros before them.
JET = (ROWS + SIDE, 2 * SIDE)
#: Largest degree, for which all memory is laid out.
MAX_DEGREE = 14
_COUNT = (MAX_DEGREE + 1) * (MAX_DEGREE + 2) // 2
_ROWS, _COLUMNS = padded_rows(_COUNT) + 2, padded_columns(_COUNT)
_LINE = 64  # bytes of a cache line, where vectors begin best
#: Cache lines by which each row of a cloud is set off against the one before: with a power of two
#: between them all rows would want the same places of the cache.
_STAGGER = 5
_INTEGERS = ("runs", "cells")  # the arrays of integers among those of numbers


def layout(**shapes: tuple[int, ...]) -> np.dtype[Any]:
    """Lay out arrays in one record; one pointer to it costs less to pass on than many arrays."""
    offsets, end = [], 0
    for shape in shapes.values():
        offsets.append(end)
        end += -(-8 * int(np.prod(shape)) // _LINE) * _LINE
    formats = [("i8" if name in _INTEGERS else "f8", shape) for name, shape in shapes.items()]
    return np.dtype(
        {"names": list(shapes), "formats": formats, "offsets": offsets, "itemsize": end}
    )


def aligned(*shape: int) -> Array:
    """Zeros that begin at a cache line."""
    size = int(np.prod(shape))
    memory = np.zeros(size + _LINE // 8)
    start = -(memory.ctypes.data // 8) % (_LINE // 8)
    return memory[start : start + size].reshape(shape)


def make_cloud(capacity: int) -> Array:
    """Allocate the rows of a cloud of so many points."""
    lines = -(-capacity * 8 // _LINE)
    lines += (_STAGGER - lines) % 64
    return aligned(CLOUD_ROWS, lines * _LINE // 8)


def make_record(layout: np.dtype[Any]) -> Any:
    """Allocate a record of zeros that begins at a cache line."""
    return aligned(layout.itemsize // 8).view(layout)[0]


#: Constants of all degrees:
#: real, imaginary: phi_{k,n} = sum_b (real + i imaginary)[k (MAX_DEGREE + 1) + b, j] c_{k-b,b} with
#: n = k mod 2 + 2 j;
#: binomial coefficients and factorials;
#: full_disc: smallest relative pivot of each degree for points that fill the disc evenly;
#: cosines, sines of n theta_j, theta_j = j pi / SAMPLES.
TABLES = layout(
    real=((MAX_DEGREE + 1) * (MAX_DEGREE + 1), SIDE // 2),
    imaginary=((MAX_DEGREE + 1) * (MAX_DEGREE + 1), SIDE // 2),
    binomial=(MAX_DEGREE + 1, MAX_DEGREE + 1),
    factorial=(MAX_DEGREE + 1,),
    full_disc=(MAX_DEGREE + 1,),
    cosines=(MAX_DEGREE + 1, SAMPLES + LANES),
    sines=(MAX_DEGREE + 1, SAMPLES + LANES),
)
#: Memory of one thread, reused from point to point.
WORKSPACE = layout(
    cubes=(cube_rows(MAX_DEGREE), BLOCK),
    columns=(WIDE + 1, BLOCK),
    sums=(2 * MAX_DEGREE + 4, 2 * MAX_DEGREE + 2 * LANES),
    heights=(2 * MAX_DEGREE + 4, 2 * MAX_DEGREE + 2 * LANES),
    ordered=(2 * MAX_DEGREE + 1, 2 * MAX_DEGREE + 1 + WIDEST),
    G=(_ROWS, _COLUMNS),
    S=(_ROWS, _COLUMNS),
    X=(_ROWS, _COLUMNS),
    diagonal=(_COLUMNS,),
    pivots=(_COLUMNS,),
    inverses=(_COLUMNS,),
    spare=(_COLUMNS,),
    c=(_COLUMNS,),
    centred=(_COLUMNS,),
    y=(_COLUMNS,),
    v=(_COLUMNS,),
    step=(_COLUMNS,),
    horner=(_COLUMNS,),
    table=JET,
    middle=JET,
    slope=JET,
    norms=(SIDE,),
    frame=(3, 3),
    kept=(3, 3),
    A=(3, 3),
    B=(3, 3),
    Q=(3, 3),
    plane=(LANES,),
    weights=(LANES,),
    spread=(16 + LANES,),
    V=(SIDE + 1, _COLUMNS),
    Y=(_ROWS, 2 * SIDE),
    U=(SIDE + LANES + 1, _COLUMNS),
    across=(SIDE, 2 * SIDE),
    along=(SIDE, SIDE + LANES),
    powers=(4, SIDE),
    turns=(4, SIDE // 2),
    planar=(2, SIDE * (SIDE + 2) // 4 + LANES),
    gradient=(2, _COLUMNS),
    runs=(COLUMNS, 2),
    cells=(2, 3),
)


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


@cache
def make_tables() -> Any:
    """Build the constants."""
    tables = make_record(TABLES)
    for k in range(MAX_DEGREE + 1):
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
                tables["real"][k * (MAX_DEGREE + 1) + b, j] = value.real
                tables["imaginary"][k * (MAX_DEGREE + 1) + b, j] = value.imag
        for j in range(k + 1):
            tables["binomial"][k, j] = comb(k, j)
        tables["factorial"][k] = factorial(k)
    tables["full_disc"][:] = _full_disc_pivots(MAX_DEGREE)
    angles = np.outer(np.arange(MAX_DEGREE + 1), np.arange(SAMPLES + LANES) * (np.pi / SAMPLES))
    tables["cosines"][:] = np.cos(angles)
    tables["sines"][:] = np.sin(angles)
    return tables
