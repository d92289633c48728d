"""The user's arrays, checked and brought into the form the engine works on."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt
from scipy.spatial import cKDTree

from pdtheory.errors import InputError
from pdtheory.pointset.cloud import FloatArray, PointCloud

#: Extents outside these bounds would overflow in the units of high orders.
SMALLEST, LARGEST = 1e-20, 1e20
#: Fewest points worth a fit.
FEWEST = 8


@dataclass(frozen=True)
class Intake:
    """Points and queries, centred on the middle of the bounding box.

    Attributes
    ----------
    points : (P, 3) float64
        Finite points, centred.
    queries : (Q, 3) float64
        Queries, centred; rows may be non-finite.
    places : (Q, 3) float64
        Queries as given.
    references : (Q, 3) float64
        Vectors on the side of the normals: the given normals, else away from the centre.
    oriented : bool
        Whether normals were given.
    diagonal : float
        Diagonal of the bounding box.
    rounding : float
        Rounding error of the coordinates as given.
    dropped : int
        Non-finite points left out.
    """

    points: FloatArray
    queries: FloatArray
    places: FloatArray
    references: FloatArray
    oriented: bool
    diagonal: float
    rounding: float
    dropped: int


def as_vectors(values: npt.ArrayLike, name: str) -> tuple[FloatArray, float]:
    """Return values as (n, 3) float64 in C order, and the unit roundoff of their own type.

    Raises
    ------
    InputError
        If they are not real numbers in three columns.
    """
    try:
        array = np.asarray(values)
        if array.dtype.kind not in "fiub":
            raise TypeError
    except (TypeError, ValueError):
        raise InputError(f"{name} must be an array of real numbers.") from None
    if array.ndim != 2 or array.shape[1] != 3:
        raise InputError(f"{name} have shape {array.shape}; give (n, 3).")
    roundoff = float(np.finfo(array.dtype).eps) / 2 if array.dtype.kind == "f" else 0.0
    return np.ascontiguousarray(array, dtype=np.float64), max(roundoff, 2.0**-53)


def take_in(
    points: npt.ArrayLike | PointCloud,
    normals: npt.ArrayLike | None,
    queries: npt.ArrayLike | None,
    non_finite: str,
) -> Intake:
    """Check points, normals and queries.

    Raises
    ------
    InputError
        If something cannot be used.
    """
    if non_finite not in ("refuse", "drop"):
        raise InputError(f"non_finite {non_finite!r} is not known; give 'refuse' or 'drop'.")
    name = "points"
    if isinstance(points, PointCloud):
        name = points.name
        normals = points.normals if normals is None else normals
        points = points.points
    places, roundoff = as_vectors(points, name)
    finite = np.isfinite(places).all(axis=1)
    dropped = int(len(finite) - finite.sum())
    if dropped and non_finite == "refuse":
        first = int(np.flatnonzero(~finite)[0])
        raise InputError(
            f"{name}: {dropped} of {len(places)} points have NaN or infinite coordinates "
            f"(the first is number {first}); remove them, or pass non_finite='drop'."
        )
    kept = places[finite] if dropped else places
    if len(kept) < FEWEST:
        raise InputError(
            f"{name}: {len(kept)} finite points are too few; the smallest fit needs {FEWEST}."
        )
    low, high = kept.min(axis=0), kept.max(axis=0)
    with np.errstate(over="ignore"):
        diagonal = float(np.linalg.norm(high - low))
    if diagonal == 0.0:
        raise InputError(f"{name}: all {len(kept)} points are equal; there is no surface.")
    if not SMALLEST <= diagonal <= LARGEST:
        raise InputError(
            f"{name}: the bounding box has the diagonal {diagonal:g}; "
            f"choose units in which it is between {SMALLEST:g} and {LARGEST:g}."
        )
    centre = low + (high - low) / 2
    vectors = None
    if normals is not None:
        vectors, _ = as_vectors(normals, "normals")
        if len(vectors) != len(places):
            raise InputError(
                f"{len(vectors)} normals for {len(places)} points; give one for each point."
            )
        vectors = np.where(np.isfinite(vectors).all(axis=1)[:, None], vectors, 0.0)
    centred = kept - centre
    if queries is None:
        wanted, references = places, vectors
    else:
        wanted, index = _resolve_queries(queries, places)
        references = None
        if vectors is not None:
            if index is None:
                index = _nearest_index(kept, np.flatnonzero(finite), wanted)
            references = vectors[index]
    shifted = wanted - centre
    if references is None:
        references = np.where(np.isfinite(shifted), shifted, 0.0)
    return Intake(
        points=centred,
        queries=shifted,
        places=wanted,
        references=np.ascontiguousarray(references),
        oriented=vectors is not None,
        diagonal=diagonal,
        rounding=roundoff * float(max(np.abs(low).max(), np.abs(high).max())),
        dropped=dropped,
    )


def _resolve_queries(queries: npt.ArrayLike, places: FloatArray) -> tuple[FloatArray, Any]:
    """Return positions, and the indices of points if the queries were given as such."""
    array = np.asarray(queries)
    if array.ndim == 1 and array.dtype.kind in "iu":
        count = len(places)
        if len(array) and not 0 <= int(array.min()) <= int(array.max()) < count:
            raise InputError(f"a query names a point outside 0..{count - 1}.")
        return places[array], array
    if array.ndim == 1 and array.dtype.kind == "b" and len(array) == len(places):
        return places[array], np.flatnonzero(array)
    return as_vectors(queries, "queries")[0], None


def _nearest_index(points: FloatArray, numbers: Any, wanted: FloatArray) -> Any:
    """Return the number of the nearest finite point of each query."""
    _, nearest = cKDTree(points).query(np.where(np.isfinite(wanted), wanted, 0.0))
    return numbers[nearest]
