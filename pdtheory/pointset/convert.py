"""Direction fields as objects of other libraries, which are imported when they are asked for."""

from __future__ import annotations

from typing import Any

import numpy as np

from pdtheory.conventions import order_colour
from pdtheory.errors import InputError, MissingDependencyError
from pdtheory.interrupts import signals_held
from pdtheory.pointset.field import DirectionField
from pdtheory.pointset.table import direction_columns, glyph_columns

#: A stroke is so much shorter than the neighbourhood's radius if nothing else is asked for.
_RADII_PER_STROKE = 3.0


def stroke_length(field: DirectionField) -> float:
    """Return the length of a stroke that suits a field: a third of the median radius."""
    radius = field.radius[field.answered]
    return float(np.median(radius)) / _RADII_PER_STROKE if len(radius) else 1.0


def to_dataframe(field: DirectionField) -> Any:
    """Return a pandas DataFrame; see :meth:`DirectionField.to_dataframe`."""
    try:
        import pandas
    except ImportError as error:
        raise MissingDependencyError(
            "to_dataframe needs pandas; install it: pip install pandas."
        ) from error
    columns = direction_columns(field)
    index = columns.pop("point")
    position = dict(zip("xyz", field.points[index].T, strict=True))
    return pandas.DataFrame({"point": index} | position | columns)


def to_pyvista(field: DirectionField) -> Any:
    """Return a PyVista PolyData; see :meth:`DirectionField.to_pyvista`."""
    try:
        import pyvista
    except ImportError as error:
        raise MissingDependencyError(
            "to_pyvista needs PyVista; install it with `pip install pyvista` (extra viewer)."
        ) from error
    points, columns = glyph_columns(field)
    mesh = pyvista.PolyData(points)
    for name, values in columns.items():
        mesh.point_data[name] = values
    return mesh


def to_trimesh(field: DirectionField, *, length: float | None = None) -> Any:
    """Return a trimesh Path3D; see :meth:`DirectionField.to_trimesh`."""
    if length is not None and not (np.isfinite(length) and length > 0):
        raise InputError(f"length is {length}; give a positive length in the units of the points.")
    with signals_held():
        from trimesh.path import Path3D
        from trimesh.path.entities import Line

    points, columns = glyph_columns(field)
    reach = stroke_length(field) if length is None else length
    ends = np.stack([points, points + reach * columns["direction"]], axis=1)
    colours = {
        order: np.array([*(round(255 * part) for part in order_colour(order)), 255], np.uint8)
        for order in field.orders
    }
    entities = [
        Line([2 * row, 2 * row + 1], color=colours[int(order)])
        for row, order in enumerate(columns["order"])
    ]
    return Path3D(entities=entities, vertices=ends.reshape(-1, 3), process=False)
