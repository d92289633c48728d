"""Binary PLY with any number of elements.

trimesh writes positions in single precision and knows no elements of its own, and survey
coordinates do not fit into single precision; the format itself is a text header and packed rows.
"""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

import numpy as np

from pdtheory.pointset.cloud import IntArray
from pdtheory.pointset.table import Columns

_TYPE_NAMES = {
    "i1": "char",
    "u1": "uchar",
    "i2": "short",
    "u2": "ushort",
    "i4": "int",
    "u4": "uint",
    "f4": "float",
    "f8": "double",
}


def write_ply(
    path: Path, elements: Mapping[str, Columns], *, faces: IntArray | None = None
) -> None:
    """Write a little-endian binary PLY file.

    Parameters
    ----------
    path
        The file.
    elements
        For each element, by name, its columns; all columns of an element have one length.
    faces : (F, 3) int64, optional
        Triangles, written as the element ``face`` after the first of `elements`.
    """
    header = ["ply", "format binary_little_endian 1.0"]
    blocks = []
    for place, (name, columns) in enumerate(elements.items()):
        fields = [(key, values.dtype.newbyteorder("<")) for key, values in columns.items()]
        rows = np.empty(len(next(iter(columns.values()))), dtype=fields)
        for key, values in columns.items():
            rows[key] = values
        header.append(f"element {name} {len(rows)}")
        header += [f"property {_TYPE_NAMES[kind.str[1:]]} {key}" for key, kind in fields]
        blocks.append(rows)
        if place == 0 and faces is not None:
            triangles = np.empty(len(faces), dtype=[("count", "u1"), ("corners", "<i4", 3)])
            triangles["count"] = 3
            triangles["corners"] = faces
            header.append(f"element face {len(faces)}")
            header.append("property list uchar int vertex_indices")
            blocks.append(triangles)
    header.append("end_header\n")
    with path.open("wb") as stream:
        stream.write("\n".join(header).encode("ascii"))
        for rows in blocks:
            stream.write(rows.tobytes())
