"""What a Blender object is made of, as a point cloud in world orientation and scale."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from hashlib import blake2b
from typing import Any, Final

import bpy
import numpy as np
import numpy.typing as npt

from pdtheory.blender.storage import POINTS_KEY
from pdtheory.errors import InputError
from pdtheory.pointset.cloud import FloatArray, IntArray, PointCloud

#: Objects that can be asked for their points.
TYPES: Final = frozenset({"MESH", "CURVE", "SURFACE", "FONT", "META", "POINTCLOUD"})


@dataclass(frozen=True)
class Source:
    """The points of an object.

    Attributes
    ----------
    cloud : PointCloud
        Points ``A p`` with A the linear part of the object's matrix: true to scale and orientation,
        with the object's origin at 0.
    linear : (3, 3) float64
        The matrix A.
    vertex : (P,) int64 or None
        For each point its vertex in the mesh the points came from; None for samples.
    vertices : int
        Number of vertices of that mesh.
    loose : int
        Vertices that belong to no face, left out since the others do.
    """

    cloud: PointCloud
    linear: FloatArray
    vertex: IntArray | None
    vertices: int
    loose: int


def read_object(
    thing: Any, *, evaluated: bool = True, samples: int | None = None, seed: int = 0
) -> Source:
    """Read the points of an object.

    Parameters
    ----------
    thing
        `bpy` object.
    evaluated
        Whether modifiers and shape keys take part; what is no mesh is always evaluated.
    samples
        Spread so many points over the surface instead of taking the vertices.
    seed
        Seed of the samples.

    Raises
    ------
    InputError
        If the object has no points, or no surface to sample, or is scaled to nothing, or cannot be
        read in its present mode.
    """
    if thing is None:
        raise InputError("no object is active; select one.")
    if thing.type not in TYPES:
        raise InputError(
            f"{thing.name} has no points to compute on; select a mesh, point cloud, curve or text."
        )
    if POINTS_KEY in thing:
        raise InputError(f"{thing.name} draws directions; select the surface they belong to.")
    if evaluated and thing.mode == "SCULPT" and any(m.type == "MULTIRES" for m in thing.modifiers):
        # Blender gives the mesh without its finer levels then.
        raise InputError(f"{thing.name} is being sculpted with Multiresolution; leave Sculpt Mode.")
    linear = linear_part(thing.matrix_world)
    if abs(np.linalg.det(linear)) <= 1e-12 * np.linalg.norm(linear) ** 3:
        raise InputError(f"{thing.name} is scaled to zero along an axis; give it a thickness.")
    if thing.mode == "EDIT":
        thing.update_from_editmode()
    if thing.type == "POINTCLOUD":
        return _read_points(thing, linear, samples)
    with _mesh_of(thing, evaluated) as mesh:
        points, normals, faces = _arrays(mesh)
    points = points @ linear.T
    if normals is not None:
        # Normals follow the inverse transpose, which keeps them outward under mirroring too.
        normals = normals @ np.linalg.inv(linear)
        length = np.linalg.norm(normals, axis=1, keepdims=True)
        normals = normals / np.where(length > 0.0, length, 1.0)
    count = len(points)
    if not count:
        raise InputError(f"{thing.name} has no vertices; there is nothing to compute on.")
    if samples is not None:
        if faces is None:
            raise InputError(f"{thing.name} has no faces to sample; use its vertices.")
        from pdtheory.io.meshes import sample_mesh

        whole = PointCloud(points, normals, faces, thing.name)
        return Source(sample_mesh(whole, samples, seed), linear, None, count, 0)
    if faces is None:
        return Source(PointCloud(points, name=thing.name), linear, np.arange(count), count, 0)
    used = np.unique(faces)
    new = np.full(count, -1, dtype=np.int64)
    new[used] = np.arange(len(used))
    assert normals is not None
    cloud = PointCloud(points[used], normals[used], new[faces], thing.name)
    return Source(cloud, linear, used, count, count - len(used))


def linear_part(matrix: Any) -> FloatArray:
    """Return the linear part of a `mathutils` matrix."""
    return np.array(matrix.to_3x3(), dtype=np.float64)


def fingerprint(thing: Any, *, evaluated: bool = True) -> bytes:
    """Return a few bytes that change when the points or faces of an object do.

    Parameters
    ----------
    thing
        `bpy` object of one of :data:`TYPES`.
    evaluated
        As in :func:`read_object`.
    """
    if thing.mode == "EDIT":
        thing.update_from_editmode()
    faces = 0
    if thing.type == "POINTCLOUD":
        points = _positions(thing)
    else:
        with _mesh_of(thing, evaluated) as mesh:
            points = _get(mesh.vertices, "co", len(mesh.vertices), 3)
            faces = len(mesh.polygons)
    return blake2b(points.tobytes() + faces.to_bytes(8, "little"), digest_size=16).digest()


def _read_points(thing: Any, linear: FloatArray, samples: int | None) -> Source:
    if samples is not None:
        raise InputError(f"{thing.name} is a point cloud and has no faces; use its points.")
    points = _positions(thing)
    count = len(points)
    if not count:
        raise InputError(f"{thing.name} has no points; there is nothing to compute on.")
    return Source(
        PointCloud(points @ linear.T, name=thing.name), linear, np.arange(count), count, 0
    )


def _positions(thing: Any) -> FloatArray:
    """Return the points of a point cloud, as it is shown."""
    data = thing.evaluated_get(bpy.context.evaluated_depsgraph_get()).data
    attribute = data.attributes.get("position")
    if attribute is None:
        return np.empty((0, 3))
    return _get(attribute.data, "vector", len(attribute.data), 3)


@contextmanager
def _mesh_of(thing: Any, evaluated: bool) -> Iterator[Any]:
    """Give the mesh of an object, with or without its modifiers, for a moment."""
    if thing.type == "MESH" and not evaluated:
        yield thing.data
        return
    owner = thing.evaluated_get(bpy.context.evaluated_depsgraph_get())
    try:
        mesh = owner.to_mesh()
    except RuntimeError as error:
        raise InputError(f"{thing.name} cannot be turned into a mesh ({error}).") from error
    try:
        yield mesh
    finally:
        owner.to_mesh_clear()


def _arrays(mesh: Any) -> tuple[FloatArray, FloatArray | None, IntArray | None]:
    """Return points, vertex normals and triangles of a mesh; None where there are no faces."""
    count = len(mesh.vertices)
    points = _get(mesh.vertices, "co", count, 3)
    if not len(mesh.polygons):
        return points, None, None
    mesh.calc_loop_triangles()
    triangles = np.empty(3 * len(mesh.loop_triangles), dtype=np.int32)
    mesh.loop_triangles.foreach_get("vertices", triangles)
    normals = np.empty(3 * count, dtype=np.float32)
    mesh.vertex_normals.foreach_get("vector", normals)
    return (
        points,
        normals.reshape(-1, 3).astype(np.float64),
        triangles.reshape(-1, 3).astype(np.int64),
    )


def _get(collection: Any, name: str, count: int, width: int) -> npt.NDArray[np.float64]:
    values = np.empty(count * width, dtype=np.float32)
    collection.foreach_get(name, values)
    return values.reshape(count, width).astype(np.float64)
