"""Principal directions of several orders at the points of a cloud."""

from __future__ import annotations

from typing import Unpack

import numpy as np
import numpy.typing as npt

from pdtheory.conventions import Status
from pdtheory.errors import InputError
from pdtheory.pointset.assemble import Collector
from pdtheory.pointset.cloud import IntArray, PointCloud
from pdtheory.pointset.engine import Engine
from pdtheory.pointset.field import DirectionField
from pdtheory.pointset.neighbourhoods import suggest_radius
from pdtheory.pointset.options import Options, shows_options_of
from pdtheory.pointset.pool import Flag, chunk_size, run_spans, shrinking_spans
from pdtheory.pointset.prepare import prepare
from pdtheory.pointset.selection import Selector

#: Said before the first chunk: in the first run on a machine this takes up to a minute.
PREPARING = "preparing the kernels (compiled once)"


@shows_options_of(prepare)
def estimate_directions(
    points: npt.ArrayLike | PointCloud, **options: Unpack[Options]
) -> DirectionField:
    """Estimate the principal directions of the surface that points were sampled from.

    At each query the heights of the neighbours over a local plane are fitted by a polynomial of
    degree K with the weights exp(-9 rho^2 / 2), rho being the distance as a fraction of the radius
    (sec. 5 of the paper, with sigma = R/3). Its terms of order k give the Wavejets coefficients
    phi_{k,n}, and the critical angles of each term are the principal directions of order k.

    Parameters
    ----------
    points : (P, 3) array_like or PointCloud
        The samples.
    radius : float, sequence of float, or "auto"
        Radius R of the neighbourhoods, in the units of the points. Of several, each point takes the
        one whose error is smallest as far as the data tell; "auto" tries radii at which half of the
        points have 1.5, 4.5, 13.5, ... neighbours for each coefficient, up to 1,000.
    neighbours : int
        Number of nearest points, the point itself among them, whose farthest gives the radius.
    radius_relative : float
        Radius as a fraction of the diagonal of the bounding box. Give exactly one of the three.
    degree : int or "auto"
        Degree K of the regression, 2 to 14. With "auto" each point takes one of every second degree
        from the highest order up to 10 in the same way; ``field.degree`` says which.
    orders : sequence of int
        Orders k of the directions, none above the degree.
    norm : {"l2", "l1"}
        Norm of the residuals. l1 withstands outliers and takes several times as long.
    normals : (P, 3) array_like, optional
        Vectors on the side from which heights are counted. Default: the normals of the cloud.
    queries : (Q, 3) float or (Q,) int array_like, optional
        Positions, or indices of points, where directions are computed. Default: all points.
    orient : {"auto", "normals", "winding", "propagate", "none"} or (3,) array_like
        How the side of the normals is found: from the normals, from the faces of the cloud, by
        handing signs on from neighbour to neighbour, not at all (then the status says
        ``UNORIENTED``), or towards a viewpoint. "auto" takes the first that the input allows, but
        hands on only if all points are queries, since that visits all of them.
    frame : {"tangent", "principal", "given"}
        The local plane: tangent to the fitted surface, the robust principal plane of the
        neighbours, or orthogonal to the given normals. Where the fit does not tell the tangent
        plane, that of a lower degree or the principal one takes its place, with the status
        ``UNCERTAIN_FRAME``.
    weight_distance : {"3d", "planar"}
        Distance that the weights depend on: in space, which depends on no plane and is the default,
        or in the local plane.
    uncertainty : bool
        Whether to compute standard deviations of angles and eigenvalues; NaN otherwise. A choice of
        degree or radius needs them and computes them in any case.
    non_finite : {"refuse", "drop"}
        What to do about points with NaN or infinite coordinates: raise, or leave them out, with the
        status ``NON_FINITE`` where they are queries.
    threads : int, optional
        Number of threads. Default: the cores available.
    progress : callable, optional
        Called as ``progress(fraction, text)`` in the calling thread. It may raise
        :class:`pdtheory.errors.Cancelled` to stop.

    Returns
    -------
    DirectionField
        Directions with eigenvalues, error bars and a status for each query, in their order.

    Raises
    ------
    InputError
        If the input cannot be used, or no query has enough neighbours.
    Cancelled
        If `progress` raised it.

    Notes
    -----
    The height of the fitted surface over the query itself is free: phi_{0,0} is the offset of the
    query from the smoothed surface. In a tangent frame phi_{1,1} is zero.

    Degree and radius are chosen by comparing each candidate with those of less bias
    (:mod:`pdtheory.pointset.selection`), for all orders asked for together: where each order shall
    have its own best degree, estimate them one by one.
    """
    run = prepare(points, **options)
    engine = run.engine
    if run.progress is not None:
        run.progress(0.0, PREPARING)
    engine.warm_up()
    collector = Collector(engine, run.places, run.degree)

    def work(start: int, stop: int, flag: Flag) -> None:
        where = engine.visit[start:stop]
        collector.compute(where, flag, where)

    most = chunk_size(engine.choice.neighbours)
    todo = shrinking_spans(0, len(run.places), run.threads, most)
    for _ in run_spans(work, todo, run.threads, run.progress, "estimating directions"):
        pass
    result = collector.field(run.threads)
    refuse_nothing(result.status, result.neighbours, engine)
    return result


def refuse_nothing(status: IntArray, neighbours: IntArray, engine: Engine | Selector) -> None:
    """Raise if every point lacked neighbours.

    Raises
    ------
    InputError
        With a radius that would do.
    """
    if not len(status) or not np.all(status & Status.TOO_FEW_NEIGHBOURS):
        return
    if engine.choice.neighbours is not None:
        raise InputError(
            f"the {engine.choice.neighbours} nearest points lie all in one place, at every point; "
            "leave out points that are repeated, or give more neighbours."
        )
    most = int(neighbours.max())
    raise InputError(
        f"{engine.choice.text} catches at most {most} point{'s' * (most != 1)} anywhere, too few "
        f"for a fit; {suggest_radius(engine.points, engine.settings.degree)}."
    )
