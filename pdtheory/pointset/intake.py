"""The user's arrays, checked and brought into the form the engine works on."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from pdtheory.errors import InputError
from pdtheory.pointset.cloud import FloatArray, IntArray, PointCloud
from pdtheory.pointset.columns import finite_rows, highest, lowest
from pdtheory.pointset.orientation import consistent_normals, winding_normals
from pdtheory.pointset.trees import kd_tree

#: Extents outside these bounds would overflow in the units of high orders.
SMALLEST, LARGEST = 1e-20, 1e20
#: Fewest points worth a fit.
FEWEST = 8
_ORIENT = ("auto", "normals", "winding", "propagate", "none")


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
    references : callable
        Returns (Q, 3) vectors on the side of the normals; away from the centre if nothing says the
        side. A call, since handing signs on takes long and other things may be refused before.
    oriented : bool
        Whether something does.
    planes : bool
        Whether the vectors are normals of the surface as given.
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
    references: Callable[[], FloatArray]
    oriented: bool
    planes: bool
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
    array = _as_array(values, name)
    if array.ndim != 2 or array.shape[1] != 3:
        raise InputError(f"{name} have shape {array.shape}; give (n, 3).")
    roundoff = float(np.finfo(array.dtype).eps) / 2 if array.dtype.kind == "f" else 0.0
    return np.ascontiguousarray(array, dtype=np.float64), max(roundoff, 2.0**-53)


def _as_array(values: npt.ArrayLike, name: str) -> npt.NDArray[Any]:
    """Return values as an array of real numbers of any shape, or refuse them."""
    try:
        array = np.asarray(values)
        if array.dtype.kind not in "fiub":
            raise TypeError
    except (TypeError, ValueError):
        raise InputError(f"{name} must be an array of real numbers.") from None
    return array


def take_in(
    points: npt.ArrayLike | PointCloud,
    normals: npt.ArrayLike | None,
    queries: npt.ArrayLike | None,
    non_finite: str,
    orient: str | npt.ArrayLike,
) -> Intake:
    """Check points, normals and queries, and find the side of the normals.

    Raises
    ------
    InputError
        If something cannot be used.
    """
    if non_finite not in ("refuse", "drop"):
        raise InputError(f"non_finite {non_finite!r} is not known; give 'refuse' or 'drop'.")
    name, faces = "points", None
    if isinstance(points, PointCloud):
        name, faces = points.name, points.faces
        normals = points.normals if normals is None else normals
        points = points.points
    places, roundoff = as_vectors(points, name)
    finite = finite_rows(places)
    dropped = int(len(finite) - finite.sum())
    if dropped and non_finite == "refuse":
        first = int(np.flatnonzero(~finite)[0])
        raise InputError(
            f"{name}: {dropped} of {len(places)} points have NaN or infinite coordinates "
            f"(the first is number {first}); remove them, or pass non_finite='drop'."
        )
    kept = places[finite] if dropped else places
    centre, diagonal = _extent(kept, name)
    wanted, index = (places, None) if queries is None else _resolve_queries(queries, places)
    shifted = wanted - centre
    mode = _mode(orient, normals, faces, queries is None)

    def references() -> FloatArray:
        sides = _sides(mode, places, normals, faces, finite)
        if sides is None:
            result = np.where(np.isfinite(shifted), shifted, 0.0)
        elif sides.shape == (3,):
            result = np.where(np.isfinite(wanted), sides - wanted, 0.0)
        elif queries is None:
            result = sides
        elif index is not None:
            result = sides[index]
        else:
            result = sides[_nearest_index(kept, np.flatnonzero(finite), wanted)]
        return np.ascontiguousarray(result)

    return Intake(
        points=kept - centre,
        queries=shifted,
        places=wanted,
        references=references,
        oriented=not (isinstance(mode, str) and mode == "none"),
        planes=isinstance(mode, str) and mode in ("normals", "winding"),
        diagonal=diagonal,
        rounding=roundoff * float(np.abs(kept).max()),
        dropped=dropped,
    )


def _extent(points: FloatArray, name: str) -> tuple[FloatArray, float]:
    """Return middle and diagonal of the bounding box of points that can be worked on."""
    if len(points) < FEWEST:
        raise InputError(
            f"{name}: {len(points)} finite points are too few; the smallest fit needs {FEWEST}."
        )
    low, high = lowest(points), highest(points)
    with np.errstate(over="ignore"):
        diagonal = float(np.linalg.norm(high - low))
    if diagonal == 0.0:
        raise InputError(f"{name}: all {len(points)} points are equal; there is no surface.")
    if not SMALLEST <= diagonal <= LARGEST:
        raise InputError(
            f"{name}: the bounding box has the diagonal {diagonal:g}; "
            f"choose units in which it is between {SMALLEST:g} and {LARGEST:g}."
        )
    return low + (high - low) / 2, diagonal


def _mode(
    orient: str | npt.ArrayLike, normals: npt.ArrayLike | None, faces: IntArray | None, whole: bool
) -> str | FloatArray:
    """Return how the side of the normals is found: one of the words but "auto", or a viewpoint."""
    if not isinstance(orient, str):
        viewpoint = _as_array(orient, "the viewpoint")
        if viewpoint.shape != (3,):
            raise InputError(f"a viewpoint is three numbers, not an array {viewpoint.shape}.")
        if not np.isfinite(viewpoint).all():
            raise InputError("the viewpoint has NaN or infinite coordinates.")
        return viewpoint.astype(np.float64)
    if orient not in _ORIENT:
        raise InputError(f"orient {orient!r} is not known; give one of {', '.join(_ORIENT)}.")
    if orient != "auto":
        return orient
    if normals is not None:
        return "normals"
    if faces is not None and len(faces):
        return "winding"
    return "propagate" if whole else "none"


def _sides(
    mode: str | FloatArray,
    places: FloatArray,
    normals: npt.ArrayLike | None,
    faces: IntArray | None,
    finite: Any,
) -> FloatArray | None:
    """Return a vector on the side of the normal for each point, a viewpoint (3,), or None."""
    if not isinstance(mode, str):
        return mode
    if mode == "normals":
        if normals is None:
            raise InputError("orient 'normals' needs normals; give them, or another orient.")
        vectors, _ = as_vectors(normals, "normals")
        if len(vectors) != len(places):
            raise InputError(
                f"{len(vectors)} normals for {len(places)} points; give one for each point."
            )
        return np.where(finite_rows(vectors)[:, None], vectors, 0.0)
    if mode == "winding":
        if faces is None or not len(faces):
            raise InputError("orient 'winding' needs a mesh with faces.")
        vectors = winding_normals(places, faces)
        return np.where(finite_rows(vectors)[:, None], vectors, 0.0)
    if mode == "propagate":
        vectors = np.zeros_like(places)
        vectors[finite] = consistent_normals(places[finite] - places[finite].mean(axis=0))
        return vectors
    return None


def _resolve_queries(queries: npt.ArrayLike, places: FloatArray) -> tuple[FloatArray, Any]:
    """Return positions, and the indices of points if the queries were given as such."""
    array = _as_array(queries, "queries")
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
    _, nearest = kd_tree(points).query(np.where(np.isfinite(wanted), wanted, 0.0))
    return numbers[nearest]
