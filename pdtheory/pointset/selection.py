"""Degree and radius chosen at each point from the data.

Every candidate - a degree and a radius - is computed with error bars. A higher degree or a smaller
radius has less bias and more variance. Two questions are asked of each candidate at each point.

- *Is there a bias?* There is if some higher degree with the same radius describes the heights
  better even after paying for its coefficients: log r^2 + 3 t / (1 - t) is smaller, with the
  residual r and the share t of the degrees of freedom that it uses up (the corrected information
  criterion of Hurvich, Simonoff and Tsai, J. R. Stat. Soc. B 60, 1998, with a dearer price).
- *Does it matter?* It does if, in an order asked for, g_k differs from that of a candidate with no
  lower degree and no larger radius by more than one standard deviation of the latter.

A candidate with a bias that matters is dropped; of the others the one with the smallest standard
deviations is taken. Where there is no higher degree to ask, the second question alone decides, with
two standard deviations, as in the method of Lepski (Theory Probab. Appl. 35, 1991). No true value
and no noise level need be known.
"""

from __future__ import annotations

from collections.abc import Sequence
from math import factorial
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from pdtheory.conventions import UNANSWERED, wavejets_table
from pdtheory.pointset.cloud import FloatArray, IntArray
from pdtheory.pointset.engine import Engine
from pdtheory.pointset.kernels.results import (
    COLUMNS,
    DEGREE,
    EIGENVALUE_STD,
    NOISE,
    RADIUS,
    RESIDUAL,
    STATUS,
    Found,
    make_found,
)
from pdtheory.pointset.pool import Flag

#: Standard deviations by which g_k may differ from that of a candidate with less bias, where the
#: heights show a bias, and where nothing is known of them.
BIASED, UNKNOWN = 1.0, 2.0
#: Price of the share of freedom that a fit uses up; 2 would be the information criterion itself.
PRICE = 3.0
#: Highest degree that is tried, unless the orders ask for more.
HIGHEST = 10


def candidate_degrees(orders: Sequence[int] | IntArray, largest: int) -> list[int]:
    """Return the degrees to try, ascending, none below an order.

    In steps of two: a term of the other parity hardly changes the order where the samples surround
    the point.

    Parameters
    ----------
    orders
        The orders asked for.
    largest
        The largest degree there is.
    """
    lowest = max([2, *map(int, orders)])
    highest = min(max(HIGHEST, lowest + 2), largest)
    return sorted({*range(lowest, highest, 2), highest})


class _Result(NamedTuple):
    """What one candidate found in one chunk."""

    degree: int
    found: Found
    rows: FloatArray

    @property
    def able(self) -> npt.NDArray[np.bool_]:
        """(Q,) whether there is an answer with the degree asked for."""
        answered = (self.found.integers(STATUS) & int(UNANSWERED)) == 0
        return answered & (self.found.numbers[:, DEGREE] == self.degree)

    @property
    def radii(self) -> FloatArray:
        """(Q,) the radius."""
        radii: FloatArray = self.found.numbers[:, RADIUS]
        return radii

    @property
    def score(self) -> FloatArray:
        """(Q,) how badly the heights are described, coefficients paid for; -inf if exactly."""
        squared = self.found.numbers[:, RESIDUAL] ** 2
        noise = self.found.numbers[:, NOISE] ** 2
        with np.errstate(divide="ignore", invalid="ignore"):
            # noise^2 = r^2 / (1 - t), so t / (1 - t) follows from the two.
            score = np.log(squared) + PRICE * (noise / squared - 1.0)
        return np.where(squared > 0.0, score, -np.inf)


class Selector:
    """Does the work of an engine with several, and keeps the best answer at each point.

    Parameters
    ----------
    engines
        The candidates, by ascending degree and, within a degree, descending radius.
    witnesses
        Engines of higher degree that only say whether the candidates have a bias.

    Attributes
    ----------
    points, queries, references, orders, visit
        As for :class:`pdtheory.pointset.engine.Engine`.
    choice, settings
        Those of the candidate that asks least: lowest degree, largest radius.
    degree : int
        Largest degree of a candidate.
    """

    def __init__(self, engines: Sequence[Engine], witnesses: Sequence[Engine] = ()) -> None:
        self._engines = engines
        self._witnesses = witnesses
        first = engines[0]
        self.points = first.points
        self.queries = first.queries
        self.references = first.references
        self.orders = first.orders
        self.visit = first.visit
        self.choice = first.choice
        self.settings = first.settings
        self.degree = max(engine.settings.degree for engine in engines)
        for engine in (*engines, *witnesses):
            engine.visit = first.visit

    def warm_up(self) -> None:
        """Compile or load the kernels in this thread, where Ctrl-C can interrupt that."""
        self._engines[0].warm_up()

    def make_found(self, size: int) -> Found:
        """Allocate the results of `size` queries."""
        return make_found(size, len(self.orders), len(wavejets_table(self.degree)))

    def work(self, where: IntArray, flag: Flag, slots: IntArray, found: Found) -> FloatArray:
        """Compute some queries; see :meth:`pdtheory.pointset.engine.Engine.work`."""

        def ask(engine: Engine) -> _Result:
            own = engine.make_found(len(where))
            # All engines work in the same memory.
            rows = engine.work(where, flag, np.arange(len(where)), own).copy()
            return _Result(engine.settings.degree, own, rows)

        results = [ask(engine) for engine in self._engines]
        chosen = self._choose(results, [ask(engine) for engine in self._witnesses])
        return self._merge(chosen, results, slots, found)

    def _choose(self, results: Sequence[_Result], witnesses: Sequence[_Result]) -> IntArray:
        """Return the number of the best candidate at each point, the first if none answers."""
        # One that could not keep its degree repeats another.
        able = np.array([result.able for result in results])
        tolerance = np.array([self._tolerance(one, (*results, *witnesses)) for one in results])
        tenable = able.copy()
        spread = np.zeros(able.shape)
        scale = results[0].radii
        for j, order in enumerate(self.orders):
            unit = scale ** (order - 1.0)
            g = [_row_of_order(result, int(order)) * unit[:, None] for result in results]
            variance = [_variance(result, j, unit / factorial(order)) for result in results]
            isotropic = [result.found.counts[j] < 0 for result in results]
            # Zero is a candidate without noise.
            spread += np.log(np.clip(variance, 1e-300, 1e300))
            for i, one in enumerate(results):
                for other, two in enumerate(results):
                    if i == other or two.degree < one.degree:
                        continue
                    better = able[other] & (two.radii <= one.radii)
                    both_round = isotropic[i] & isotropic[other]
                    difference = np.sum(np.abs(g[i] - g[other]) ** 2, axis=1)
                    with np.errstate(invalid="ignore"):
                        near = difference <= tolerance[i] ** 2 * variance[other]
                    tenable[i] &= near | both_round | ~better | np.isinf(tolerance[i])
        ranked = np.where(tenable, spread, np.inf)
        return np.where(tenable.any(axis=0), np.argmin(ranked, axis=0), np.argmax(able, axis=0))

    def _tolerance(self, one: _Result, others: Sequence[_Result]) -> FloatArray:
        """Return the standard deviations that differences to better candidates may have."""
        size = len(one.radii)
        if self.settings.robust:
            # The residuals of l1 follow no law that degrees could be compared by.
            return np.full(size, UNKNOWN)
        asked = np.zeros(size, np.bool_)
        biased = np.zeros(size, np.bool_)
        for two in others:
            if two.degree > one.degree:
                here = two.able & (two.radii == one.radii)
                asked |= here
                biased |= here & (two.score < one.score)
        return np.where(asked, np.where(biased, BIASED, np.inf), UNKNOWN)

    def _merge(
        self, chosen: IntArray, results: Sequence[_Result], slots: IntArray, found: Found
    ) -> FloatArray:
        """Write what the chosen candidate found at each point; returns the rows of these."""
        for number, result in enumerate(results):
            here = np.flatnonzero(chosen == number)
            there, own = slots[here], result.found
            found.numbers[there] = own.numbers[here]
            # Zero above the degree, NaN where there is no answer.
            found.phi[there] = np.where(np.isnan(own.phi[here, :1]), np.nan, 0.0)
            found.phi[there, : own.phi.shape[1]] = own.phi[here]
            found.counts[:, there] = own.counts[:, here]
        # The rows stand order by order, so the counts of all orders in turn tell where.
        counts = np.maximum(found.counts[:, slots], 0).ravel()
        rows = np.empty((int(counts.sum()), COLUMNS))
        for number, result in enumerate(results):
            here = np.flatnonzero(np.tile(chosen == number, len(self.orders)))
            own_rows = result.rows[_rows_of(result.found.lengths().ravel(), here)]
            rows[_rows_of(counts, here)] = own_rows
        return rows


def _rows_of(counts: IntArray, points: IntArray) -> IntArray:
    """Return the rows of some points where all have `counts` rows, one after the other."""
    last = np.cumsum(counts)[points]
    size = counts[points]
    ends = np.cumsum(size)
    return np.arange(int(size.sum())) + np.repeat(last - ends, size)


def _row_of_order(result: _Result, order: int) -> npt.NDArray[np.complex128]:
    """Return phi_{k,n} scaled so that squares add up to the mean of g_k^2 over the angle."""
    table = np.array(wavejets_table(result.degree))
    columns = np.flatnonzero(table[:, 0] == order)
    return result.found.phi[:, columns] * np.where(table[columns, 1] == 0, 1.0, np.sqrt(2.0))


def _variance(result: _Result, j: int, unit: FloatArray) -> FloatArray:
    """Return the variance of the order's g, the mean over its directions; 0 if it is isotropic."""
    lengths = result.found.lengths()
    counts = lengths[j]
    start = int(lengths[:j].sum())
    point = np.repeat(np.arange(len(counts)), counts)
    std = result.rows[start : start + len(point), EIGENVALUE_STD] * unit[point]
    total = np.bincount(point, std**2, len(counts))
    mean = np.divide(total, counts, out=np.full(len(counts), np.inf), where=counts > 0)
    return np.where(result.found.counts[j] < 0, 0.0, mean)
