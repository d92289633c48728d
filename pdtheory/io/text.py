"""Point files of plain text: XYZ, TXT and CSV."""

from __future__ import annotations

import re
from itertools import islice
from pathlib import Path

import numpy as np

from pdtheory.errors import FileFormatError
from pdtheory.pointset.cloud import FloatArray, PointCloud

#: How many lines are looked at to find the first row of numbers.
HEADER_LINES = 100

#: Largest deviation from length 1 at which unnamed columns 4 to 6 count as normals, not colours.
UNIT_TOLERANCE = 0.02

_SEPARATORS = re.compile(r"[\s,;]+")


def read_text(path: Path) -> PointCloud:
    """Read a text file with one point a line.

    Columns are separated by blanks, tabs, commas or semicolons; lines before the first row of
    numbers are a header, which may name the columns (``x y z`` and, if wanted, ``nx ny nz``).
    Without names the file must have 3 columns, or 6, of which the last three are normals if they
    have unit length and are ignored (colours) otherwise.

    Parameters
    ----------
    path
        The file.

    Returns
    -------
    PointCloud
        Points, and normals where the file has them.

    Raises
    ------
    FileFormatError
        If the file holds no rows of numbers, or not the columns that are needed.
    """
    header, first, separator = _layout(path)
    try:
        rows = np.loadtxt(
            path,
            dtype=np.float64,
            comments=["#", "//"],
            delimiter=separator,
            skiprows=first,
            ndmin=2,
            encoding="utf-8",
        )
    except ValueError as error:
        reason = str(error).splitlines()[0].rstrip(".")
        raise FileFormatError(
            f"{path} has a line that is not a row of numbers: {reason}."
        ) from None
    named = _named_columns(header)
    if named is not None and max(named) < rows.shape[1]:
        points = rows[:, named[:3]]
        normals = rows[:, named[3:]] if len(named) == 6 else None
    elif rows.shape[1] in (3, 6):
        points = rows[:, :3]
        normals = rows[:, 3:] if rows.shape[1] == 6 and _unit(rows[:, 3:]) else None
    else:
        raise FileFormatError(
            f"{path} has {rows.shape[1]} columns; give 3 (x y z) or 6 (x y z nx ny nz), "
            "or a header line that names them."
        )
    return PointCloud(np.ascontiguousarray(points), normals, name=path.name)


def _layout(path: Path) -> tuple[list[str], int, str | None]:
    """Return the words of the header, the number of lines to skip and the separator."""
    header: list[str] = []
    with path.open(encoding="utf-8", errors="replace") as stream:
        for number, line in enumerate(islice(stream, HEADER_LINES)):
            bare = line.strip().lstrip("#/").strip()
            words = [word for word in _SEPARATORS.split(bare) if word]
            if line.lstrip().startswith(("#", "//")):
                header = words or header
            elif len(words) >= 2 and all(_is_number(word) for word in words):
                separator = next((mark for mark in ",;" if mark in line), None)
                return header, number, separator
            elif words and not (len(words) == 1 and _is_number(words[0])):
                header = words
    raise FileFormatError(
        f"{path} holds no points: none of its first {HEADER_LINES} lines is a row of numbers."
    )


def _named_columns(header: list[str]) -> list[int] | None:
    """Return the columns of x y z (and nx ny nz) if the header names them."""
    names = [word.strip("\"'").lower() for word in header]
    if not {"x", "y", "z"} <= set(names):
        return None
    wanted = ["x", "y", "z"]
    if {"nx", "ny", "nz"} <= set(names):
        wanted += ["nx", "ny", "nz"]
    return [names.index(word) for word in wanted]


def _is_number(word: str) -> bool:
    try:
        float(word)
    except ValueError:
        return False
    return True


def _unit(vectors: FloatArray) -> bool:
    lengths = np.linalg.norm(vectors, axis=1)
    return bool(np.all(np.abs(lengths - 1.0) <= UNIT_TOLERANCE))
