"""Factor and solutions of the normal equations.

The matrix has the height in row and column 0 and the coefficients after it, by descending degree.
It is factored backwards, G = L^T L, from the last row to the first: so the fit of every lower
degree uses the trailing block of the same factor, and column 0 of L is the solution of
L^T y = right-hand side. The number of rows after row 0 is a multiple of PANEL; those without a
coefficient are rows of the unit matrix.
"""

from __future__ import annotations

from typing import Any

from pdtheory.pointset.kernels.lanes import LANES, Lanes, Rows, emit

#: Rows eliminated together.
PANEL = 4
#: Room for the monomials of one degree, in whole vectors.
WIDEST = 16
#: Relative pivot at which the factorization ends.
SINGULAR = 1e-15


def padded_rows(count: int) -> int:
    """Rows after row 0 for `count` coefficients."""
    return (count + PANEL - 1) // PANEL * PANEL


def padded_columns(count: int) -> int:
    """Columns for `count` coefficients: whole vectors, and room for a degree more."""
    return (padded_rows(count) // LANES + 1) * LANES + WIDEST


@emit
def fill_gram(to: Lanes, sums: Rows, heights: Rows, degree: Any, ordered: Rows, gram: Rows) -> None:
    """Fill the Gram matrix from the sums of w x^a y^b and w z x^a y^b.

    With the sums sorted by degree and power of y, a row of the matrix holds, for all monomials of
    one degree, numbers that follow one another in the sums.

    Parameters
    ----------
    sums, heights
        From `sum_moments`, to twice the degree and to the degree.
    degree : int
        The degree K.
    ordered : (>= 2 K + 1, >= 2 K + 1 + WIDEST) float64
        Scratch for the sorted sums.
    gram : (rows + 1, padded_columns) float64
        Receives the lower triangle, and finite numbers as far behind it as the factorization looks.
    """
    with to.count(0, to.plus(degree, degree, 1)) as d, to.count(0, to.plus(d, 1)) as b:
        to.put(to.get(sums.at(to.minus(d, b), b)), ordered.at(d, b))
    row = to.variable(to.integer(1))
    with to.count(0, to.plus(degree, 1)) as lower:
        d = to.minus(degree, lower)
        with to.count(0, to.plus(d, 1)) as b:
            i = to.get(row)
            to.put(to.get(heights.at(to.minus(d, b), b)), gram.at(i, 0))
            column = to.variable(to.integer(1))
            with to.count(0, to.plus(lower, 1)) as above:
                other = to.minus(degree, above)
                source, place = to.plus(d, other), to.get(column)
                # What goes beyond the degree is written over by the next one.
                for k in range(0, WIDEST, LANES):
                    value = to.load(ordered.at(source, to.plus(b, k)))
                    to.store(value, gram.at(i, to.plus(place, k)))
                to.put(to.plus(place, other, 1), column)
            with to.count(to.get(column), to.plus(i, PANEL + LANES), LANES) as k:
                to.store(to.constant(0.0), gram.at(i, k))
            to.put(to.plus(i, 1), row)
    count = to.get(row)
    whole = to.plus(to.mul(to.div(to.plus(count, PANEL - 2), PANEL), PANEL), 1)
    with to.count(count, whole) as i:
        with to.count(0, to.plus(i, PANEL + LANES), LANES) as k:
            to.store(to.constant(0.0), gram.at(i, k))
        to.put(to.real(1.0), gram.at(i, i))


@emit
def factor(to: Lanes, gram: Rows, count: Any, diagonal: Rows, pivots: Rows, inverses: Rows) -> None:
    """Factor the matrix in place.

    Parameters
    ----------
    gram : (rows + 2, padded_columns) float64
        The matrix; its lower triangle is replaced by L.
    count : int
        Number of coefficients.
    diagonal : (rows + 1,) float64
        Receives the diagonal of the matrix.
    pivots : (rows + 1,) float64
        Receives the relative pivots: what is left of each diagonal entry after the elimination of
        the later rows, as a fraction of it. Zero from the first failure on.
    inverses : (rows + 1,) float64
        Receives the reciprocals of the diagonal of L, 0 where the pivot is 0.
    """
    panels = to.div(to.plus(count, PANEL - 1), PANEL)
    rows = to.mul(panels, PANEL)
    with to.count(1, to.plus(rows, 1)) as i:
        to.put(to.get(gram.at(i, i)), diagonal.at(i))
        to.put(to.real(0.0), pivots.at(i))
        to.put(to.real(0.0), inverses.at(i))
    block = [
        [to.get(gram.at(to.minus(rows, q), to.minus(rows, p))) for q in range(p + 1)]
        for p in range(PANEL)
    ]
    yes = to.builder.icmp_signed("==", count, count)
    sound, going = to.variable(yes), to.variable(yes)
    corner = [to.variable(v) for v in _corner(to, block, rows, diagonal, pivots, inverses, sound)]
    with to.count(0, panels) as panel, to.builder.if_then(to.get(going), likely=True):
        top = to.minus(rows, to.mul(panel, PANEL))
        row = [to.minus(top, p) for p in range(PANEL)]
        # Also where a pivot of this panel failed: the rows before that one are good.
        _scale(to, gram, row, [to.get(v) for v in corner])
        to.put(to.get(sound), going)
        below = to.minus(top, PANEL)
        more = to.builder.icmp_signed(">", below, to.integer(0))
        with to.builder.if_then(to.builder.and_(more, to.get(sound)), likely=True):
            # The next corner is worked out ahead: its roots and quotients take as long as the rest.
            block = []
            for p in range(PANEL):
                here = [to.get(gram.at(r, to.minus(below, p))) for r in row]
                block.append([])
                for q in range(p + 1):
                    there = [to.get(gram.at(r, to.minus(below, q))) for r in row]
                    value = to.get(gram.at(to.minus(below, q), to.minus(below, p)))
                    for u, v in zip(here, there, strict=True):
                        value = to.subtract(value, to.times(u, v))
                    block[p].append(value)
            ahead = _corner(to, block, below, diagonal, pivots, inverses, sound)
            for place, value in zip(corner, ahead, strict=True):
                to.put(value, place)
            _subtract(to, gram, row, below)
    with to.count(1, to.plus(rows, 1), LANES) as i:
        left = to.load(pivots.at(i))
        part = to.divide(left, to.load(diagonal.at(i)))
        some = to.builder.fcmp_ordered(">", left, to.constant(0.0))
        to.store(to.builder.select(some, part, to.constant(0.0)), pivots.at(i))


def _corner(
    to: Lanes,
    block: list[list[Any]],
    top: Any,
    diagonal: Rows,
    pivots: Rows,
    inverses: Rows,
    sound: Any,
) -> list[Any]:
    """Factor the PANEL x PANEL corner at row `top`; returns its factors, then inverse pivots."""
    build = to.builder
    good = to.get(sound)
    squares: list[Any] = []  # reciprocals of the pivots; their roots are off the critical path
    goods: list[Any] = []
    rows: list[list[Any]] = []
    for p in range(PANEL):
        rest: list[Any] = []
        pivot = block[p][p]
        for q in range(p):
            value = block[p][q]
            for r in range(q):
                value = to.subtract(value, to.times(rest[r], to.times(rows[q][r], squares[r])))
            pivot = to.subtract(pivot, to.times(value, to.times(value, squares[q])))
            rest.append(value)
        at = to.minus(top, p)
        least = to.times(to.get(diagonal.at(at)), to.real(SINGULAR))
        good = build.and_(good, build.fcmp_ordered(">", pivot, least))
        goods.append(good)
        squares.append(build.fdiv(to.real(1.0), pivot))
        rows.append(rest)
        to.put(build.select(good, pivot, to.real(0.0)), pivots.at(at))
    # What follows from a pivot that fails is left out here, where nothing waits for it.
    zero = to.real(0.0)
    inverse = [build.select(g, to.root(s), zero) for g, s in zip(goods, squares, strict=True)]
    for p in range(PANEL):
        to.put(inverse[p], inverses.at(to.minus(top, p)))
    # A failure ends the work after the rows of its own panel.
    to.put(good, sound)
    factors = [
        build.select(goods[q], to.times(rows[p][q], inverse[q]), zero)
        for p in range(PANEL)
        for q in range(p)
    ]
    return [*factors, *inverse]


def _scale(to: Lanes, gram: Rows, row: list[Any], corner: list[Any]) -> None:
    """Replace the rows of a panel by those of L."""
    spread = [to.spread(value) for value in corner]
    with to.count(0, to.plus(row[0], 1), LANES) as k:
        done: list[Any] = []
        for p in range(PANEL):
            at = gram.at(row[p], k)
            value = to.load(at)
            for q in range(p):
                value = to.subtract(value, to.times(spread[p * (p - 1) // 2 + q], done[q]))
            value = to.times(value, spread[PANEL * (PANEL - 1) // 2 + p])
            to.store(value, at)
            done.append(value)


def _subtract(to: Lanes, gram: Rows, row: list[Any], below: Any) -> None:
    """Subtract the products of the rows of a panel from the rows up to `below`."""
    width = 2
    stop = to.plus(below, 1)
    with to.count(0, stop, width * LANES) as k:
        columns = [to.plus(k, v * LANES) for v in range(width)]
        panel = [[to.load(gram.at(r, column)) for column in columns] for r in row]
        start = to.greatest(k, 1)
        # Rows that end within the first vector, then those that go on.
        for used in range(1, width + 1):
            end = stop if used == width else to.least(to.plus(k, used * LANES), stop)
            with to.count(start, end) as i:
                spread = [to.spread(to.get(gram.at(r, i))) for r in row]
                for v, column in enumerate(columns[:used]):
                    at = gram.at(i, column)
                    value = to.load(at)
                    for f, line in zip(spread, panel, strict=True):
                        value = to.subtract(value, to.times(f, line[v]))
                    to.store(value, at)
            start = end


@emit
def solve_transposed(to: Lanes, gram: Rows, count: Any, inverses: Rows, v: Rows, y: Rows) -> None:
    """Solve L^T y = v; entries whose inverse pivot is 0 become 0. `v` is overwritten."""
    panels = to.div(to.plus(count, PANEL - 1), PANEL)
    rows = to.mul(panels, PANEL)
    with to.count(0, panels) as panel:
        top = to.minus(rows, to.mul(panel, PANEL))
        row = [to.minus(top, p) for p in range(PANEL)]
        found: list[Any] = []
        for p in range(PANEL):
            value = to.get(v.at(row[p]))
            for q in range(p):
                value = to.subtract(value, to.times(found[q], to.get(gram.at(row[q], row[p]))))
            found.append(to.times(value, to.get(inverses.at(row[p]))))
            to.put(found[p], y.at(row[p]))
        spread = [to.spread(value) for value in found]
        with to.count(0, to.minus(top, PANEL - 1), LANES) as k:
            value = to.load(v.at(k))
            for p in range(PANEL):
                value = to.subtract(value, to.times(spread[p], to.load(gram.at(row[p], k))))
            to.store(value, v.at(k))


@emit
def solve_lower(to: Lanes, gram: Rows, count: Any, inverses: Rows, y: Rows, c: Rows) -> None:
    """Solve L c = y; entries whose inverse pivot is 0 become 0. `c` must not be `y`."""
    panels = to.div(to.plus(count, PANEL - 1), PANEL)
    with to.count(0, to.plus(to.mul(panels, PANEL), 1 + LANES), LANES) as k:
        to.store(to.constant(0.0), c.at(k))
    with to.count(0, panels) as panel:
        low = to.plus(to.mul(panel, PANEL), 1)
        row = [to.plus(low, p) for p in range(PANEL)]
        sums = [to.variable(to.constant(0.0)) for _ in row]
        with to.count(0, low, LANES) as k:
            known = to.load(c.at(k))
            for p in range(PANEL):
                line = to.times(known, to.load(gram.at(row[p], k)))
                to.put(to.add(to.get(sums[p]), line), sums[p])
        total = to.sums([to.get(place) for place in sums])
        found: list[Any] = []
        for p in range(PANEL):
            value = to.subtract(to.get(y.at(row[p])), to.lane(total, p))
            for q in range(p):
                value = to.subtract(value, to.times(found[q], to.get(gram.at(row[p], row[q]))))
            found.append(to.times(value, to.get(inverses.at(row[p]))))
            to.put(found[p], c.at(row[p]))
