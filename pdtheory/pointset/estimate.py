"""Principal directions of several orders at the points of a cloud."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Literal

import numpy as np
import numpy.typing as npt

from pdtheory.conventions import DEFAULT_DEGREE, Status
from pdtheory.errors import InputError
from pdtheory.pointset.assemble import Collector
from pdtheory.pointset.cloud import IntArray, PointCloud
from pdtheory.pointset.engine import Engine
from pdtheory.pointset.field import DirectionField
from pdtheory.pointset.intake import Intake, take_in
from pdtheory.pointset.kernels.fit import FRAME_GIVEN, FRAME_PRINCIPAL, FRAME_TANGENT, Settings
from pdtheory.pointset.neighbourhoods import choose, suggest_radius
from pdtheory.pointset.pool import Progress, run_chunks, thread_count

#: Largest degree of a regression.
MAX_DEGREE = 14
Orient = Literal["auto", "normals", "winding", "propagate", "none"]

#: Said before the first chunk: in the first run on a machine this takes up to a minute.
PREPARING = "preparing the kernels (compiled once)"
#: Points in a chunk: some ten milliseconds of work, or a second of it with l1.
CHUNK = 512

_FRAMES = {"tangent": FRAME_TANGENT, "principal": FRAME_PRINCIPAL, "given": FRAME_GIVEN}


def check_orders(orders: Sequence[int], degree: int) -> IntArray:
    """Return the orders, ascending and once each.

    Raises
    ------
    InputError
        If the degree or an order is not usable.
    """
    if not isinstance(degree, (int, np.integer)) or not 2 <= degree <= MAX_DEGREE:
        raise InputError(f"degree {degree!r} is not available; give one from 2 to {MAX_DEGREE}.")
    wanted = sorted(set(orders))
    for order in wanted:
        if not isinstance(order, (int, np.integer)) or order < 1:
            raise InputError(f"order {order!r} is not available; orders are 1, 2, 3, ...")
        if order > degree:
            raise InputError(
                f"order {order} is above the degree {degree} of the regression; "
                f"give degree {order} or more, or leave that order out."
            )
    return np.array(wanted, dtype=np.int64)


def make_engine(
    intake: Intake,
    *,
    radius: float | None,
    neighbours: int | None,
    radius_relative: float | None,
    degree: int,
    orders: IntArray,
    norm: str,
    frame: str,
    weight_distance: str,
    uncertainty: bool,
) -> Engine:
    """Check the remaining options and prepare the run."""
    if norm not in ("l1", "l2"):
        raise InputError(f"norm {norm!r} is not known; give 'l2' or 'l1'.")
    if frame not in _FRAMES:
        raise InputError(f"frame {frame!r} is not known; give one of {', '.join(_FRAMES)}.")
    if weight_distance not in ("3d", "planar"):
        raise InputError(
            f"weight_distance {weight_distance!r} is not known; give '3d' or 'planar'."
        )
    if frame == "given" and not intake.planes:
        raise InputError("frame='given' takes the planes from normals; give normals.")
    choice = choose(radius, neighbours, radius_relative, intake.diagonal, len(intake.points))
    if weight_distance == "planar" and choice.radius is None:
        raise InputError("weight_distance='planar' needs a radius; neighbours cannot choose it.")
    settings = Settings(
        int(degree),
        _FRAMES[frame],
        weight_distance == "planar",
        norm == "l1",
        uncertainty,
        intake.oriented,
    )
    return Engine(
        intake.points,
        intake.queries,
        intake.references,
        choice,
        orders,
        settings,
        intake.rounding,
    )


def estimate_directions(
    points: npt.ArrayLike | PointCloud,
    *,
    radius: float | None = None,
    neighbours: int | None = None,
    radius_relative: float | None = None,
    degree: int = DEFAULT_DEGREE,
    orders: Sequence[int] = (2, 3),
    norm: Literal["l2", "l1"] = "l2",
    normals: npt.ArrayLike | None = None,
    queries: npt.ArrayLike | None = None,
    orient: Orient | npt.ArrayLike = "auto",
    frame: Literal["tangent", "principal", "given"] = "tangent",
    weight_distance: Literal["3d", "planar"] = "3d",
    uncertainty: bool = True,
    non_finite: Literal["refuse", "drop"] = "refuse",
    threads: int | None = None,
    progress: Progress | None = None,
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
    radius : float
        Radius R of the neighbourhoods, in the units of the points.
    neighbours : int
        Number of nearest points, the point itself among them, whose farthest gives the radius.
    radius_relative : float
        Radius as a fraction of the diagonal of the bounding box. Give exactly one of the three.
    degree : int
        Degree K of the regression, 2 to 14.
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
        neighbours, or orthogonal to the given normals.
    weight_distance : {"3d", "planar"}
        Distance that the weights depend on: in space, which depends on no plane and is the default,
        or in the local plane.
    uncertainty : bool
        Whether to compute standard deviations of angles and eigenvalues; NaN otherwise.
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
    query from the smoothed surface. In the tangent frame phi_{1,1} is zero.
    """
    wanted = check_orders(orders, degree)
    intake = take_in(points, normals, queries, non_finite, orient)
    engine = make_engine(
        intake,
        radius=radius,
        neighbours=neighbours,
        radius_relative=radius_relative,
        degree=degree,
        orders=wanted,
        norm=norm,
        frame=frame,
        weight_distance=weight_distance,
        uncertainty=uncertainty,
    )
    workers = thread_count(threads)
    if progress is not None:
        progress(0.0, PREPARING)
    engine.warm_up()
    collector = Collector(intake.places, int(degree), wanted)
    chunks = run_chunks(
        engine.work, len(intake.places), CHUNK, workers, progress, "estimating directions"
    )
    for start, stop, (radii, output) in chunks:
        collector.add(engine.visit[start:stop], radii, output, engine.rows(stop - start))
    result = collector.field()
    refuse_nothing(result, engine)
    return result


def refuse_nothing(result: DirectionField, engine: Engine) -> None:
    """Raise if every point lacked neighbours.

    Raises
    ------
    InputError
        With a radius that would do.
    """
    if len(result) and np.all(result.status & Status.TOO_FEW_NEIGHBOURS):
        raise InputError(
            f"{engine.choice.text} catches at most {int(result.neighbours.max())} points anywhere, "
            f"too few for a fit; {suggest_radius(engine.points, engine.settings.degree)}."
        )
