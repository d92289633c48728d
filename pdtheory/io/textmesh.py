"""Meshes written as text: what trimesh would pass over without a word."""

from __future__ import annotations

import re
from collections.abc import Mapping
from itertools import takewhile
from pathlib import Path
from typing import Any

#: OBJ lines other than positions and faces: they would make trimesh split the vertices.
_OBJ_OTHER_LINES = re.compile(rb"^ *(?! *[vf] ).*$", re.MULTILINE)
_OBJ_FACE_EXTRAS = re.compile(rb"(?<=\d)/-?\d*(?:/-?\d*)?")
_OBJ_NO_VERTEX = re.compile(rb"^f .*(?<= )-?0+(?: |$)", re.MULTILINE)
_COMMENT = re.compile(rb"#.*")
_INDENT = re.compile(rb"^ +", re.MULTILINE)


def plain_obj(text: bytes) -> bytes:
    """Return an OBJ file with one entry a line, each from its beginning, and without comments."""
    text = text.replace(b"\r\n", b"\n").replace(b"\r", b"\n")
    # A comment may end in a backslash, as a folder of Windows does, and still continues nowhere.
    text = _COMMENT.sub(b"", text).replace(b"\\\n", b" ").replace(b"\t", b" ")
    return _INDENT.sub(b"", text)


def bare_obj(plain: bytes) -> bytes:
    """Return the positions of a plain OBJ file, and its faces by nothing but their vertices.

    Raises
    ------
    ValueError
        If a face names vertex 0, where OBJ counts from 1 or, backwards, from -1.
    """
    bare = _OBJ_FACE_EXTRAS.sub(b"", _OBJ_OTHER_LINES.sub(b"", plain))
    if _OBJ_NO_VERTEX.search(bare):
        raise ValueError("a face with vertex 0")
    return bare


def require_whole_ply(path: Path, elements: Mapping[str, Any]) -> None:
    """Refuse a text PLY file that holds less than its header promises.

    Parameters
    ----------
    path
        The file.
    elements
        For each element of the header, in order, ``length`` and ``properties``, as trimesh tells.

    Raises
    ------
    ValueError
        If the file ends early, or a line holds too few numbers.
    """
    with path.open("rb") as lines:
        header = list(takewhile(lambda line: b"end_header" not in line, lines))
        if b"ascii" not in header[1]:
            return
        for element in elements.values():
            lists = ["$LIST" in kind for kind in element["properties"].values()]
            for _ in range(element["length"]):
                numbers = [float(word) for word in lines.readline().split()]
                needed = 0
                for is_list in lists:
                    needed += 1 + (int(numbers[needed]) if is_list else 0)
                if len(numbers) < needed:
                    raise ValueError("a line holds too few numbers")


def require_whole_off(text: str) -> None:
    """Refuse an OFF file that holds fewer faces, or shorter ones, than it promises.

    Raises
    ------
    ValueError
        If it does.
    """
    bare = (line.partition("#")[0].split() for line in text.splitlines())
    rows = [row for row in bare if row]
    # The numbers of vertices and faces may follow on the line of the word OFF.
    start = 0 if len(rows[0]) > 1 else 1
    vertices, faces = [int(word) for word in rows[start] if word.isdigit()][:2]
    found = rows[start + 1 + vertices :][:faces]
    if len(found) < faces or any(len(row) <= int(row[0]) for row in found):
        raise ValueError("fewer faces, or shorter ones, than promised")
