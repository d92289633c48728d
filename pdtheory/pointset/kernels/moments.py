"""Weighted sums of products of powers, the only thing a polynomial fit needs of its samples."""

from __future__ import annotations

from typing import Any

from pdtheory.pointset.kernels.jit import Array, inner
from pdtheory.pointset.kernels.lanes import LANES, Lanes, Rows, emit

#: Rows of a cloud: coordinates relative to the query and squared distance, in units of the radius;
#: weights; coordinates in the local frame; residuals; products; and for l1 the heights, residuals,
#: dual variables and weights.
DX, DY, DZ, SQUARED, WEIGHT, X, Y, Z, RESIDUAL, PRODUCT, HEIGHT, GAP, DUAL, REWEIGHT = range(14)
CLOUD_ROWS = 14
#: Most points whose powers are kept at a time, so that these stay in the nearest cache, of which
#: another process may use half.
BLOCK = 128
#: Powers of x in a tile, and widths of tiles in powers of y, as large as the registers allow.
TALL = 3
WIDTHS = (9, 7, 6, 4, 3, 1) if LANES == 8 else (4, 2)
#: Powers of y that are kept at a time.
WIDE = WIDTHS[0]


def cube_rows(degree: int) -> int:
    """Powers of x^3 that moments up to twice the degree need, then those times z; one to spare."""
    return (2 * degree + TALL) // TALL + (degree + TALL) // TALL + 1


@inner
def sum_moments(cloud: Array, weights: int, n: int, top: int, degree: int, w: Any) -> None:
    """Sum w x^a y^b for a + b <= top, and w z x^a y^b for a + b <= degree.

    Parameters
    ----------
    cloud : (CLOUD_ROWS, >= n) float64
        Rows X, Y and Z hold the coordinates; row number `weights` holds w.
    n : int
        Number of points, a multiple of LANES.
    top, degree : int
        Largest total degrees; with the second at -1 the heights are left out.
    w : record of WORKSPACE
        ``w.sums`` and ``w.heights`` receive the sums at [a, b]; entries with a + b above the degree
        are scratch.
    """
    # The code for the sums is long, so all that need them call this function.
    _sum(cloud, weights, n, top, degree, w.cubes, w.columns, w.sums, w.heights)


@emit
def _sum(
    to: Lanes,
    cloud: Rows,
    weights: Any,
    n: Any,
    top: Any,
    degree: Any,
    cubes: Rows,
    columns: Rows,
    sums: Rows,
    heights: Rows,
) -> None:
    """Do the work of `sum_moments`.

    Parameters
    ----------
    cubes : (>= cube_rows, >= BLOCK) float64
        Scratch for 1, x^3, x^6, ...
    columns : (WIDE + 1, >= BLOCK) float64
        Scratch for w y^b, WIDE of them at a time, and y^WIDE.
    sums, heights : (>= top + 4, >= top + 2 * LANES) float64
        Receive the sums.
    """
    third = to.plus(to.div(top, TALL), 1)
    for last, out in ((top, sums), (degree, heights)):
        with to.count(0, to.plus(last, TALL)) as a, to.count(0, to.plus(last, WIDE), LANES) as b:
            to.store(to.constant(0.0), out.at(a, b))
    blocks = to.greatest(to.div(to.plus(n, BLOCK - 1), BLOCK), 1)
    vectors = to.div(to.plus(n, LANES - 1), LANES)
    length = to.mul(to.div(to.minus(to.plus(vectors, blocks), 1), blocks), LANES)
    with to.count(0, blocks) as block:
        start = to.mul(block, length)
        stop = to.least(length, to.minus(n, start))
        _fill_powers(to, cloud, weights, start, stop, top, degree, cubes, columns)
        with to.count(0, to.plus(top, 1), WIDE) as b:
            with to.count(0, 2) as number:
                second = to.builder.icmp_signed("!=", number, to.integer(0))
                last = to.builder.select(second, degree, top)
                out = sums.unless(second, heights)
                cube = to.builder.select(second, third, to.integer(0))
                left = to.minus(last, b)
                first = cube
                # The power a has left - a + 1 partners, one less in each row of a tile. Those with
                # more than WIDE take what is kept; the others belong to the next width.
                shapes = [[WIDE] * TALL]
                shapes += [[max(width - row, 0) for row in range(TALL)] for width in WIDTHS]
                for widths, narrower in zip(shapes, (*WIDTHS, 0), strict=True):
                    tiles = to.div(to.greatest(to.plus(left, TALL - narrower), 0), TALL)
                    end = to.plus(cube, tiles)
                    with to.count(first, end) as tile:
                        a = to.mul(to.minus(tile, cube), TALL)
                        _tile(to, cloud, start, stop, cubes, columns, tile, widths, out, a, b)
                    first = end
            left = to.minus(top, b)
            with to.builder.if_then(to.builder.icmp_signed(">=", left, to.integer(WIDE))):
                _raise_columns(to, stop, columns)


def _fill_powers(
    to: Lanes,
    cloud: Rows,
    weights: Any,
    start: Any,
    stop: Any,
    top: Any,
    degree: Any,
    cubes: Rows,
    columns: Rows,
) -> None:
    """Write the powers of x^3, those times z, and the first WIDE columns w y^b."""
    with to.count(0, stop, LANES) as i:
        at = to.plus(start, i)
        x = to.load(cloud.at(X, at))
        cube = to.times(to.times(x, x), x)
        after = to.integer(0)
        for first, last in ((to.constant(1.0), top), (to.load(cloud.at(Z, at)), degree)):
            power = to.variable(first)
            end = to.plus(after, to.div(to.plus(last, TALL), TALL))
            with to.count(after, end) as row:
                value = to.get(power)
                to.store(value, cubes.at(row, i))
                to.put(to.times(value, cube), power)
            after = end
        y = to.load(cloud.at(Y, at))
        square = to.times(y, y)
        even = to.load(cloud.at(weights, at))
        odd = to.times(even, y)
        for row in range(WIDE):
            to.store(even, columns.at(row, i))
            even, odd = odd, to.times(even, square)
        with to.builder.if_then(to.builder.icmp_signed(">=", top, to.integer(WIDE))):
            last = y
            for digit in f"{WIDE:b}"[1:]:
                last = to.times(last, last)
                if digit == "1":
                    last = to.times(last, y)
            to.store(last, columns.at(WIDE, i))


def _raise_columns(to: Lanes, stop: Any, columns: Rows) -> None:
    """Multiply all columns by y^WIDE."""
    with to.count(0, stop, LANES) as i:
        factor = to.load(columns.at(WIDE, i))
        for row in range(WIDE):
            at = columns.at(row, i)
            to.store(to.times(to.load(at), factor), at)


def _tile(
    to: Lanes,
    cloud: Rows,
    start: Any,
    stop: Any,
    cubes: Rows,
    columns: Rows,
    tile: Any,
    widths: list[int],
    out: Rows,
    a: Any,
    b: Any,
) -> None:
    """Add the dot products of the powers of x with so many columns to the sums from (a, b) on."""
    sums = [[to.variable(to.constant(0.0)) for _ in range(width)] for width in widths]
    with to.count(0, stop, LANES) as i:
        x = to.load(cloud.at(X, to.plus(start, i)))
        powers = [to.load(cubes.at(tile, i))]
        while len(powers) < TALL:
            powers.append(to.times(powers[-1], x))
        for column in range(widths[0]):
            value = to.load(columns.at(column, i))
            for power, row in zip(powers, sums, strict=True):
                if column < len(row):
                    to.put(to.add(to.times(power, value), to.get(row[column])), row[column])
    for offset, row in enumerate(sums):
        for column in range(0, len(row), LANES):
            part = [to.get(total) for total in row[column : column + LANES]]
            at = out.at(to.plus(a, offset), to.plus(b, column))
            to.store(to.add(to.load(at), to.sums(part)), at)


@emit
def subtract_polynomial(to: Lanes, cloud: Rows, n: Any, degree: Any, horner: Rows) -> None:
    """Write z - sum c_ab x^a y^b to the row RESIDUAL.

    Parameters
    ----------
    cloud : (CLOUD_ROWS, >= n) float64
        The points.
    n : int
        Number of points: at least LANES^2, or the cloud is as wide as that.
    degree : int
        Degree of the polynomial.
    horner : (coefficient_count,) float64
        Coefficients by descending b and, for each b, by descending a.
    """
    group = LANES
    with to.count(0, n, group * LANES) as first:
        # The last group overlaps the one before.
        start = to.greatest(to.least(first, to.minus(n, group * LANES)), 0)
        at = [to.plus(start, g * LANES) for g in range(group)]
        x = [to.load(cloud.at(X, i)) for i in at]
        y = [to.load(cloud.at(Y, i)) for i in at]
        outer = [to.variable(to.constant(0.0)) for _ in at]
        inner = [to.variable(to.constant(0.0)) for _ in at]
        next_one = to.variable(to.integer(0))
        with to.count(0, to.plus(degree, 1)) as row:
            for g in range(group):
                to.put(to.constant(0.0), inner[g])
            with to.count(0, to.plus(row, 1)) as a:
                c = to.spread(to.get(horner.at(to.plus(to.get(next_one), a))))
                for g in range(group):
                    to.put(to.add(to.times(to.get(inner[g]), x[g]), c), inner[g])
            to.put(to.plus(to.get(next_one), row, 1), next_one)
            for g in range(group):
                to.put(to.add(to.times(to.get(outer[g]), y[g]), to.get(inner[g])), outer[g])
        for g in range(group):
            z = to.load(cloud.at(Z, at[g]))
            to.store(to.subtract(z, to.get(outer[g])), cloud.at(RESIDUAL, at[g]))


@emit
def multiply_rows(to: Lanes, cloud: Rows, first: Any, second: Any, n: Any, out: Any) -> None:
    """Write the products of two rows of the cloud to another."""
    with to.count(0, n, LANES) as i:
        product = to.times(to.load(cloud.at(first, i)), to.load(cloud.at(second, i)))
        to.store(product, cloud.at(out, i))
