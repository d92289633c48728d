"""Point files of plain text: XYZ, TXT and CSV."""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import dataclass
from itertools import islice
from pathlib import Path
from typing import TextIO

import numpy as np

from pdtheory.errors import FileFormatError
from pdtheory.pointset.cloud import FloatArray, PointCloud

#: Largest deviation from length 1 at which unnamed columns 4 to 6 count as normals, not colours.
UNIT_TOLERANCE = 0.02

_COMMENT = re.compile("#|//")
_SEPARATORS = re.compile(r"[\s,;]+")
_UNIT_OF_LENGTH = re.compile(r"\s*[(\[].*")


@dataclass(frozen=True)
class _Layout:
    """Where the rows of numbers begin, and what is taken from them."""

    first: int  #: lines before the first row
    separator: str | None
    count: int  #: fields in a row
    columns: list[int]  #: those that are read
    named: bool  #: whether a header names them


def read_text(path: Path) -> PointCloud:
    """Read a text file with one point a line.

    Columns are separated by blanks, tabs, commas or semicolons; lines before the first row of
    numbers are a header, which may name the columns (``x y z`` and, if wanted, ``nx ny nz``); then
    other columns may hold words or nothing. Without names the file must have 3 columns, or 6, of
    which the last three are normals if they have unit length and are ignored (colours) otherwise.

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
    with _opened(path) as lines:
        layout = _layout(lines)
    if layout is None:
        raise FileFormatError(
            f"{path} holds no points: no line of it is a row of numbers; if some columns hold "
            "words, name all columns in a header, with x, y and z among them."
        )
    if not layout.named and len(layout.columns) not in (3, 6):
        raise FileFormatError(
            f"{path} has {len(layout.columns)} columns (line {layout.first + 1}); give 3 (x y z) "
            "or 6 (x y z nx ny nz), or a header line that names all columns."
        )
    rows = _rows(path, layout)
    points, normals = np.ascontiguousarray(rows[:, :3]), None
    if len(layout.columns) == 6 and (layout.named or _unit(rows[:, 3:])):
        normals = rows[:, 3:]
    return PointCloud(points, normals, name=path.name)


def _opened(path: Path) -> TextIO:
    # Programs on Windows begin a file with a mark of its encoding, which is no part of the text.
    return path.open(encoding="utf-8-sig", errors="replace")


def _layout(lines: Iterable[str]) -> _Layout | None:
    """Look for the first row of numbers, and for a header above it that names the columns."""
    headers: list[str] = []
    for number, line in enumerate(lines):
        text = _without_comment(line)
        separator = next((mark for mark in ";," if mark in text), None)
        fields = text.split(separator)
        filled = len(fields)
        while filled and not fields[filled - 1].strip():
            filled -= 1
        for header in reversed(headers):
            for names in (header.split(separator), _SEPARATORS.split(header)):
                columns = _named_columns(names)
                # A comment that only speaks of x, y and z seldom has a word for every column.
                if (
                    columns is not None
                    and filled <= len(names) <= len(fields)
                    and all(_is_number(fields[column]) for column in columns)
                ):
                    return _Layout(number, separator, len(fields), columns, named=True)
        if filled >= 2 and all(map(_is_number, fields[:filled])):
            return _Layout(number, separator, len(fields), list(range(filled)), named=False)
        bare = line.strip().lstrip("#/").strip().rstrip(",;")
        if _named_columns(_SEPARATORS.split(bare)) is not None:
            headers.append(bare)
    return None


def _rows(path: Path, layout: _Layout) -> FloatArray:
    """Read the columns of the layout; every row must have as many fields as the first."""
    others = set(range(layout.count)).difference(layout.columns)
    with _opened(path) as lines:
        try:
            table = np.loadtxt(
                map(_without_comment, islice(lines, layout.first, None)),
                dtype=np.float64,
                comments=None,
                delimiter=layout.separator,
                converters=dict.fromkeys(others, _passed_over),
                encoding="utf-8",
                ndmin=2,
            )
        except ValueError:
            # NumPy counts rows its own way and speaks of its own options.
            lines.seek(0)
            raise FileFormatError(f"{path}{_first_fault(lines, layout)}.") from None
    return table[:, layout.columns]


def _first_fault(lines: Iterable[str], layout: _Layout) -> str:
    """Say which line is not like the first row of numbers."""
    for number, line in islice(enumerate(lines, 1), layout.first, None):
        text = _without_comment(line)
        fields = text.split(layout.separator)
        if text and len(fields) != layout.count:
            return (
                f", line {number}, has another number of columns ({len(fields)}) than line "
                f"{layout.first + 1} ({layout.count}); correct the line or remove it"
            )
        wrong = [column for column in layout.columns if text and not _is_number(fields[column])]
        if wrong:
            return (
                f", line {number}, column {wrong[0] + 1}: {fields[wrong[0]].strip()[:40]!r} is no "
                "number; correct the line or remove it"
            )
    return " has a line that is not a row of numbers"


def _without_comment(line: str) -> str:
    return _COMMENT.split(line, maxsplit=1)[0].strip()


def _passed_over(_: str) -> float:
    """Stand for a column that is not wanted, which may hold words."""
    return 0.0


def _named_columns(header: list[str]) -> list[int] | None:
    """Return the columns of x y z (and nx ny nz) if the header names them."""
    names = [_UNIT_OF_LENGTH.sub("", word).strip(" \t\"'").lower() for word in header]
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
    # What Python reads and NumPy does not: 1_000, and the digits of other scripts.
    return word.isascii() and "_" not in word


def _unit(vectors: FloatArray) -> bool:
    lengths = np.linalg.norm(vectors, axis=1)
    return bool(np.all(np.abs(lengths - 1.0) <= UNIT_TOLERANCE))
