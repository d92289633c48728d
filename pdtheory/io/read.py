"""One way in for every file of points."""

from __future__ import annotations

import os
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np

from pdtheory.errors import FileAccessError, FileFormatError, InputError
from pdtheory.io.las import read_las
from pdtheory.io.meshes import mesh_suffixes, read_mesh, sample_mesh, winding_normals
from pdtheory.io.text import read_text
from pdtheory.pointset.cloud import FloatArray, PointCloud

TEXT_SUFFIXES = (".xyz", ".txt", ".csv")
LAS_SUFFIXES = (".las", ".laz")


def read_cloud(
    path: str | os.PathLike[str], *, samples: int | None = None, seed: int = 0
) -> PointCloud:
    """Read points from a mesh or a point file, by its suffix.

    Parameters
    ----------
    path
        PLY, OBJ, OFF, STL, glTF and whatever else trimesh reads here; XYZ, TXT or CSV; LAS or LAZ
        (extra ``las``).
    samples
        Draw so many points on the triangles, uniformly by area, in place of the vertices.
    seed
        Seed of that draw.

    Returns
    -------
    PointCloud
        Points in the order of the file, with triangles and normals where they are known. The
        normals of a mesh follow from its winding, if that is consistent
        (:func:`pdtheory.io.meshes.winding_normals`).

    Raises
    ------
    FileAccessError
        If there is no such file, or it cannot be read.
    FileFormatError
        If it is empty or damaged, or its suffix is not known.
    InputError
        If a coordinate is NaN or infinite, or samples are asked for where there are no faces.
    MissingDependencyError
        If the format needs a library that is not installed.
    """
    source = Path(path)
    if source.is_dir():
        raise FileAccessError(f"{source} is a folder; give a file.")
    try:
        if not source.exists():
            raise FileAccessError(f"no such file: {source}.")
        if source.stat().st_size == 0:
            raise FileFormatError(f"{source} is empty.")
        with source.open("rb"):
            pass
        cloud = _reader(source)(source)
    except (FileAccessError, FileFormatError):
        raise
    except OSError as error:
        raise FileAccessError(f"cannot read {source}: {error.strerror or error}.") from error
    _require_finite(cloud.points, source, "a coordinate")
    if cloud.faces is not None:
        cloud = replace(cloud, normals=winding_normals(cloud.points, cloud.faces))
    elif cloud.normals is not None:
        _require_finite(cloud.normals, source, "a normal")
        cloud = replace(cloud, normals=_unit(cloud.normals))
    return cloud if samples is None else sample_mesh(cloud, samples, seed)


def _reader(source: Path) -> Callable[[Path], PointCloud]:
    suffix = source.suffix.lower()
    if suffix in TEXT_SUFFIXES:
        return read_text
    if suffix in LAS_SUFFIXES:
        return read_las
    known = mesh_suffixes()
    if suffix in known:
        return read_mesh
    raise FileFormatError(
        f"{source} has the unknown suffix {suffix or '(none)'}; known are "
        f"{', '.join(sorted({*known, *TEXT_SUFFIXES, *LAS_SUFFIXES}))}."
    )


def _unit(normals: FloatArray) -> FloatArray | None:
    """Return the normals at length 1, or None if one of them is zero and so tells no side."""
    lengths = np.linalg.norm(normals, axis=1, keepdims=True)
    return normals / lengths if np.all(lengths > 0.0) else None


def _require_finite(rows: FloatArray, source: Path, what: str) -> None:
    bad = np.flatnonzero(~np.isfinite(rows).all(axis=1))
    if len(bad):
        raise InputError(
            f"{source}: {what} of {len(bad)} of {len(rows)} points is NaN or infinite, first of "
            f"point {bad[0]}; remove these points."
        )
