"""A direction field as one flat table: a row for each direction."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

from pdtheory.pointset.cloud import FloatArray
from pdtheory.pointset.field import DirectionField

Columns = dict[str, npt.NDArray[Any]]


def direction_columns(field: DirectionField) -> Columns:
    """Return the directions of all orders as columns of equal length.

    Parameters
    ----------
    field
        The field.

    Returns
    -------
    dict of str to (M,) array
        ``point`` (index), ``order``, ``kind``, ``angle``, ``dx dy dz`` (unit tangent vector),
        ``eigenvalue``, ``strength``, ``angle_std`` and ``eigenvalue_std``; rows by order, then by
        point, then by angle.
    """
    parts = [field[order] for order in field.orders]
    vectors = _stack([rows.vector for rows in parts], (0, 3))
    return {
        "point": _stack([rows.point_index for rows in parts], 0).astype(np.int32),
        "order": _stack([np.full(len(rows), rows.order) for rows in parts], 0).astype(np.uint8),
        "kind": _stack([rows.kind for rows in parts], 0).astype(np.int8),
        "angle": _stack([rows.angle for rows in parts], 0),
        "dx": vectors[:, 0],
        "dy": vectors[:, 1],
        "dz": vectors[:, 2],
        **{
            name: _stack([getattr(rows, name) for rows in parts], 0)
            for name in ("eigenvalue", "strength", "angle_std", "eigenvalue_std")
        },
    }


def point_columns(field: DirectionField) -> Columns:
    """Return what a field says about its points, one column for each number.

    Parameters
    ----------
    field
        The field.

    Returns
    -------
    dict of str to (P,) array
        Position ``x y z``, normal ``nx ny nz`` (0 where there is no frame), ``radius``, ``degree``,
        ``neighbours``, ``residual_rms``, ``condition``, ``status``; and for every order k the
        number of maxima ``order{k}_maxima`` and the strongest maximum: ``order{k}_strength`` and
        ``order{k}_x``, ``_y``, ``_z`` (0 where there is none).
    """
    columns: Columns = dict(zip("xyz", field.points.T, strict=True))
    normals = np.nan_to_num(field.frames[:, 2])
    columns |= {f"n{axis}": normals[:, i] for i, axis in enumerate("xyz")}
    columns |= {"radius": field.radius, "residual_rms": field.residual_rms}
    columns |= {"condition": field.condition}
    for name in ("degree", "neighbours", "status"):
        columns[name] = getattr(field, name).astype(np.int32)
    for order in field.orders:
        maxima = field[order].maxima
        strength = np.zeros(len(field))
        vector = np.zeros((len(field), 3))
        # Ascending strength, so that the strongest maximum of a point is written last and stays.
        ranking = np.argsort(maxima.strength, kind="stable")
        strength[maxima.point_index[ranking]] = maxima.strength[ranking]
        vector[maxima.point_index[ranking]] = maxima.vector[ranking]
        columns[f"order{order}_maxima"] = np.diff(maxima.offsets).astype(np.uint8)
        columns[f"order{order}_strength"] = strength
        columns |= {f"order{order}_{axis}": vector[:, i] for i, axis in enumerate("xyz")}
    return columns


def glyph_columns(field: DirectionField) -> tuple[FloatArray, Columns]:
    """Return what draws a glyph at every direction: positions, and arrays of the same length.

    Parameters
    ----------
    field
        The field.

    Returns
    -------
    points : (M, 3) float64
        The point of each direction, so that one with several directions occurs several times.
    columns : dict of str to (M,) or (M, 3) array
        The columns of :func:`direction_columns`, with the vector in one as ``direction``, and
        ``normal``, ``radius`` and ``status`` of the point.
    """
    columns = direction_columns(field)
    index = columns["point"]
    vector = np.stack([columns.pop(f"d{axis}") for axis in "xyz"], axis=1)
    columns |= {"direction": vector, "normal": np.nan_to_num(field.frames[index, 2])}
    columns |= {"radius": field.radius[index], "status": field.status[index]}
    return field.points[index], columns


def _stack(parts: list[npt.NDArray[Any]], empty_shape: int | tuple[int, ...]) -> npt.NDArray[Any]:
    return np.concatenate(parts) if parts else np.zeros(empty_shape)
