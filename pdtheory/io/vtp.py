"""VTK XML polygonal data (.vtp): points with named data, for ParaView."""

from __future__ import annotations

import base64
import xml.etree.ElementTree as ET
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from pdtheory.pointset.cloud import FloatArray

_TYPE_NAMES = {
    "i1": "Int8",
    "u1": "UInt8",
    "i4": "Int32",
    "i8": "Int64",
    "f4": "Float32",
    "f8": "Float64",
}


def write_vtp(path: Path, points: FloatArray, data: Mapping[str, npt.NDArray[Any]]) -> None:
    """Write points as vertex cells with point data, in inline binary.

    Parameters
    ----------
    path
        The file.
    points : (M, 3) float64
        Positions; the same one may occur several times.
    data
        Arrays of M rows, of one or three columns, by name.
    """
    count = len(points)
    root = ET.Element(
        "VTKFile",
        type="PolyData",
        version="1.0",
        byte_order="LittleEndian",
        header_type="UInt64",
    )
    piece = ET.SubElement(
        ET.SubElement(root, "PolyData"),
        "Piece",
        NumberOfPoints=str(count),
        NumberOfVerts=str(count),
        NumberOfLines="0",
        NumberOfStrips="0",
        NumberOfPolys="0",
    )
    attributes = ET.SubElement(piece, "PointData")
    for name, values in data.items():
        _append(attributes, name, values)
    _append(ET.SubElement(piece, "Points"), "Points", points)
    cells = ET.SubElement(piece, "Verts")
    _append(cells, "connectivity", np.arange(count, dtype=np.int64))
    _append(cells, "offsets", np.arange(1, count + 1, dtype=np.int64))
    ET.ElementTree(root).write(path, encoding="utf-8", xml_declaration=True)


def _append(parent: ET.Element, name: str, values: npt.NDArray[Any]) -> None:
    little = np.ascontiguousarray(values, dtype=values.dtype.newbyteorder("<"))
    content = little.tobytes()
    entry = ET.SubElement(
        parent,
        "DataArray",
        type=_TYPE_NAMES[little.dtype.str[1:]],
        Name=name,
        NumberOfComponents=str(1 if little.ndim == 1 else little.shape[1]),
        format="binary",
    )
    length = np.array([len(content)], dtype="<u8").tobytes()
    entry.text = base64.b64encode(length + content).decode("ascii")
