"""Meshes and point clouds in the formats that trimesh reads."""

from __future__ import annotations

import io
import re
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from pdtheory.errors import FileFormatError, InputError
from pdtheory.interrupts import signals_held
from pdtheory.io.textmesh import bare_obj, plain_obj, require_whole_off, require_whole_ply
from pdtheory.pointset.cloud import FloatArray, IntArray, PointCloud

if TYPE_CHECKING:
    import trimesh

#: Share of the inner edges that must run both ways before a mesh's winding tells the side.
CONSISTENT_SHARE = 0.99

#: Most samples: no memory holds them, but NumPy counts them.
MOST_SAMPLES = 10**12

_OBJ_NORMALS = re.compile(rb"^vn +(.*)$", re.MULTILINE)


def mesh_suffixes() -> set[str]:
    """Return the suffixes, with their dot, that trimesh reads here."""
    with signals_held():
        from trimesh.exchange.load import mesh_formats

    return {f".{name}" for name in mesh_formats()} - {".xyz", ".stl_ascii"}


# Coordinates that are not finite are for the caller to refuse, not for NumPy to warn of.
@np.errstate(invalid="ignore", over="ignore")
def read_mesh(path: Path) -> PointCloud:
    """Read a mesh or a point cloud with trimesh, vertices in the order of the file.

    Polygons are cut into triangles; the parts of a scene are placed and put one after the other.
    Vertices at equal positions stay apart, except in STL, which has no shared vertices: there they
    are merged.

    Parameters
    ----------
    path
        The file.

    Returns
    -------
    PointCloud
        Points, which may not be finite, triangles if there are any, and normals if the file has
        them.

    Raises
    ------
    FileFormatError
        If the file is damaged or holds no points.
    """
    with signals_held():
        import trimesh

    try:
        scene = _load_scene(path)
        parts = [
            (scene.geometry[name], transform)
            for transform, name in (scene.graph[node] for node in scene.graph.nodes_geometry)
        ]
        for part, _ in parts:
            if "_ply_raw" in part.metadata:
                require_whole_ply(path, part.metadata["_ply_raw"])
        cloud = _concatenate([part for part in parts if _has_points(part[0])], path)
    except (FileFormatError, MemoryError):
        raise
    except Exception as error:
        # The readers of trimesh raise whatever their parsing ran into.
        kind = path.suffix[1:].upper()
        raise FileFormatError(f"{path} is not a readable {kind} file, or it is damaged.") from error
    if path.suffix.lower() == ".stl" and cloud.faces is not None:
        soup = trimesh.Trimesh(cloud.points, cloud.faces, process=False)
        soup.merge_vertices()
        cloud = PointCloud(
            np.array(soup.vertices, dtype=np.float64),
            faces=np.array(soup.faces, dtype=np.int64),
            name=path.name,
        )
    return cloud


def winding_normals(points: FloatArray, faces: IntArray) -> FloatArray | None:
    """Return area-weighted vertex normals from the winding of the triangles.

    The winding is trusted if at least 99 % of the edges between two triangles are run through in
    both directions, once each, where vertices at the same place count as one: a scan with a few
    bad triangles passes, triangles turned at random do not.

    Parameters
    ----------
    points : (P, 3) float64
        Vertices, finite.
    faces : (F, 3) int64
        Triangles.

    Returns
    -------
    (P, 3) float64 or None
        Unit normals; a vertex without a proper triangle takes that of the nearest vertex that has
        one. None if the winding is not consistent, no triangle has an area, or the areas exceed
        double precision.
    """
    if not len(faces) or not _consistent(_place_numbers(points)[faces]):
        return None
    with np.errstate(over="ignore", invalid="ignore"):
        doubled_area = _doubled_areas(points, faces)
        sums = np.stack(
            [
                np.bincount(faces.ravel(), np.repeat(doubled_area[:, axis], 3), len(points))
                for axis in range(3)
            ],
            axis=1,
        )
        lengths = np.linalg.norm(sums, axis=1)
    known = lengths > 0.0
    if not known.any() or not np.isfinite(lengths).all():
        return None
    normals: FloatArray = np.zeros((len(points), 3))
    normals[known] = sums[known] / lengths[known, None]
    if not known.all():
        from scipy.spatial import cKDTree

        _, nearest = cKDTree(points[known]).query(points[~known])
        normals[~known] = normals[known][nearest]
    return normals


def sample_mesh(cloud: PointCloud, count: int, seed: int) -> PointCloud:
    """Draw points on the triangles of a mesh, uniformly by area.

    Parameters
    ----------
    cloud
        A mesh.
    count
        Number of points.
    seed
        Seed of the random numbers.

    Returns
    -------
    PointCloud
        `count` points; with the normals of their triangles if `cloud` has normals.

    Raises
    ------
    InputError
        If there are no triangles, their area is zero or infinite, or `count` or `seed` is out of
        range.
    """
    with signals_held():
        import trimesh

    if not 1 <= count <= MOST_SAMPLES:
        raise InputError(f"samples = {count}; give a positive number up to {MOST_SAMPLES:,}.")
    if seed < 0:
        raise InputError(f"seed = {seed}; give 0 or a positive number.")
    if cloud.faces is None or not len(cloud.faces):
        raise InputError(
            f"{cloud.name} has no faces, so its surface cannot be sampled; use its points, without "
            "samples."
        )
    mesh = trimesh.Trimesh(cloud.points, cloud.faces, process=False)
    with np.errstate(over="ignore"):
        area = mesh.area
    if not area > 0.0:
        raise InputError(f"{cloud.name} has no area, so its surface cannot be sampled.")
    if not np.isfinite(area):
        raise InputError(
            f"the area of {cloud.name} exceeds double precision; choose larger units of length."
        )
    points, index = trimesh.sample.sample_surface(mesh, count, seed=seed)[:2]
    normals = None
    if cloud.normals is not None:
        normals = _doubled_areas(cloud.points, cloud.faces)
        # Triangles without area are never drawn, so their normal is never used.
        normals /= np.maximum(np.linalg.norm(normals, axis=1), np.finfo(float).tiny)[:, None]
        normals = normals[index]
    return PointCloud(np.asarray(points, dtype=np.float64), normals, name=cloud.name)


def _doubled_areas(points: FloatArray, faces: IntArray) -> FloatArray:
    """Return for each triangle its normal, as long as twice its area."""
    corners = points[faces]
    return np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])


def _load_scene(path: Path) -> trimesh.Scene:
    with signals_held():
        import trimesh

    if path.suffix.lower() == ".off":
        require_whole_off(path.read_text(encoding="utf-8", errors="replace"))
    if path.suffix.lower() != ".obj":
        return trimesh.load_scene(path, process=False)
    plain = plain_obj(path.read_bytes())
    scene = trimesh.load_scene(
        io.BytesIO(bare_obj(plain)), file_type="obj", process=False, maintain_order=True
    )
    rows = [match.split() for match in _OBJ_NORMALS.findall(plain)]
    for part in scene.geometry.values():
        if isinstance(part, trimesh.PointCloud) and len(rows) == len(part.vertices):
            part.metadata["normals"] = np.array(rows, dtype=np.float64)
    return scene


def _has_points(part: Any) -> bool:
    vertices = getattr(part, "vertices", None)
    return vertices is not None and len(vertices) > 0 and np.shape(vertices)[1] == 3


def _concatenate(parts: list[tuple[Any, npt.NDArray[Any]]], path: Path) -> PointCloud:
    if not parts:
        raise FileFormatError(f"{path} holds no points.")
    points, normals, faces, start = [], [], [], 0
    for geometry, transform in parts:
        linear = np.asarray(transform, dtype=np.float64)
        points.append(np.asarray(geometry.vertices, np.float64) @ linear[:3, :3].T + linear[:3, 3])
        normals.append(_file_normals(geometry, linear[:3, :3]))
        triangles = getattr(geometry, "faces", None)
        if triangles is not None and len(triangles):
            turned = np.linalg.det(linear[:3, :3]) < 0.0
            faces.append(np.asarray(triangles, np.int64)[:, :: -1 if turned else 1] + start)
        start += len(points[-1])
    known = [rows for rows in normals if rows is not None]
    return PointCloud(
        np.ascontiguousarray(np.concatenate(points)),
        np.concatenate(known) if len(known) == len(normals) else None,
        np.ascontiguousarray(np.concatenate(faces)) if faces else None,
        path.name,
    )


def _file_normals(geometry: Any, linear: FloatArray) -> FloatArray | None:
    """Return the normals, of any length, that the file gives to the points, if it does."""
    given = geometry.metadata.get("normals")
    if given is None:
        # trimesh keeps the raw columns of a PLY file, but drops the normals of a point cloud.
        raw = geometry.metadata.get("_ply_raw", {}).get("vertex", {}).get("data")
        names = getattr(getattr(raw, "dtype", None), "names", None) or ()
        if isinstance(raw, dict):
            names = tuple(raw)
        if raw is None or not {"nx", "ny", "nz"} <= set(names):
            return None
        given = np.stack([np.ravel(raw[name]) for name in ("nx", "ny", "nz")], axis=1)
    rows: FloatArray = np.asarray(given, dtype=np.float64) @ np.linalg.inv(linear)
    return rows


def _place_numbers(points: FloatArray) -> IntArray:
    """Return a number for each point that is the same for points at the same place."""
    order = np.lexsort(points.T)
    ordered = points[order]
    fresh = np.concatenate(([False], (ordered[1:] != ordered[:-1]).any(axis=1)))
    numbers = np.empty(len(points), dtype=np.int64)
    numbers[order] = np.cumsum(fresh)
    return numbers


def _consistent(faces: IntArray) -> bool:
    starts, ends = faces.ravel(), np.roll(faces, -1, axis=1).ravel()
    count = int(faces.max()) + 1
    key = np.minimum(starts, ends) * count + np.maximum(starts, ends)
    edges, inverse = np.unique(key, return_inverse=True)
    inner = np.bincount(inverse, minlength=len(edges)) == 2
    opposed = inner & (np.bincount(inverse, starts < ends, minlength=len(edges)) == 1)
    return int(opposed.sum()) >= CONSISTENT_SHARE * int(inner.sum())
