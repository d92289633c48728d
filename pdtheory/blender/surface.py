"""Surfaces and points as Blender meshes."""

from __future__ import annotations

from typing import Any, Final

import bpy
import numpy as np
import numpy.typing as npt

from pdtheory.blender import compat
from pdtheory.drawing.discs import disc_radii
from pdtheory.drawing.thinning import choose_spots
from pdtheory.errors import InputError
from pdtheory.pointset.cloud import FloatArray, IntArray, PointCloud

#: Edges sharper than this are drawn as edges.
_SMOOTH_ANGLE: Final = np.radians(40.0)

#: Points beyond this number are thinned before they are drawn as discs.
_MOST_DISCS: Final = 120_000

_DISC_CORNERS: Final = 6


def surface_material() -> Any:
    """Return the matt grey of the surface below the strokes, made on first use."""
    name = "Directions surface"
    material = bpy.data.materials.get(name)
    if material is None:
        material = bpy.data.materials.new(name)
        tree = compat.enable_nodes(material)
        surface = next(node for node in tree.nodes if node.type == "BSDF_PRINCIPLED")
        surface.inputs["Base Color"].default_value = (0.37, 0.37, 0.37, 1.0)
        surface.inputs["Roughness"].default_value = 0.55
        material.diffuse_color = (0.37, 0.37, 0.37, 1.0)
    return material


def add_surface(cloud: PointCloud, *, collection: Any, origin: FloatArray | None = None) -> Any:
    """Add the triangles of a cloud as a mesh object in the grey of the pictures.

    Parameters
    ----------
    cloud
        Points with faces.
    collection
        `bpy` collection to put the object into.
    origin : (3,) float64, optional
        Subtracted from the points before they become single precision.

    Raises
    ------
    InputError
        If there are no faces to draw.
    """
    mesh = surface_mesh(cloud, origin)
    mesh.materials.append(surface_material())
    return _link(mesh, collection)


def surface_mesh(cloud: PointCloud, origin: FloatArray | None = None) -> Any:
    """Return the triangles of a cloud as a mesh, smooth but for its edges.

    Parameters
    ----------
    cloud
        Points with faces. Faces with a corner that is not finite are left out.
    origin : (3,) float64, optional
        Subtracted from the points before they become single precision.

    Raises
    ------
    InputError
        If there are no faces to draw.
    """
    if cloud.faces is None or not len(cloud.faces):
        raise InputError(f"{cloud.name} has no faces to draw; give a mesh, or draw its points.")
    finite = np.isfinite(cloud.points).all(axis=1)
    faces = cloud.faces[finite[cloud.faces].all(axis=1)]
    if not len(faces):
        raise InputError(f"{cloud.name} has no face with finite corners; repair the mesh.")
    points = cloud.points if origin is None else cloud.points - origin
    mesh = _triangles(cloud.name, np.where(finite[:, None], points, 0.0), faces)
    mesh.set_sharp_from_angle(angle=float(_SMOOTH_ANGLE))
    return mesh


def add_points(
    points: FloatArray,
    normals: FloatArray | None,
    *,
    name: str,
    collection: Any,
    origin: FloatArray | None = None,
) -> Any:
    """Add points as small overlapping discs that face along the normals, so that they look closed.

    Parameters
    ----------
    points : (P, 3) float64
        Positions.
    normals : (P, 3) float64 or None
        Unit normals; points without a finite one are left out.
    name, collection, origin
        As for :func:`add_surface`.

    Raises
    ------
    InputError
        If no point can be drawn.
    """
    finite = np.isfinite(points).all(axis=1)
    if normals is not None:
        finite &= np.isfinite(normals).all(axis=1)
    if finite.sum() < 2:
        raise InputError(f"{name} has fewer than two finite points to draw; nothing to show.")
    where = np.flatnonzero(finite)
    if len(where) > _MOST_DISCS:
        spots = choose_spots(points[where])
        where = where[spots.spacing >= spots.spacing_for(_MOST_DISCS)]
    centre = points[where] if origin is None else points[where] - origin
    axis = np.tile([0.0, 0.0, 1.0], (len(where), 1)) if normals is None else normals[where]
    radius = disc_radii(centre)
    # Discs in one plane would shade each other black; each sinks by an amount of its own.
    depth = 0.1 * radius * np.modf(0.6180339887498949 * np.arange(len(centre)))[0]
    centre = centre - depth[:, None] * axis
    helper = np.where(np.abs(axis[:, :1]) < 0.7, [[1.0, 0.0, 0.0]], [[0.0, 1.0, 0.0]])
    first = np.cross(helper, axis)
    first /= np.linalg.norm(first, axis=1, keepdims=True)
    second = np.cross(axis, first)
    turn = 2.0 * np.pi * np.arange(_DISC_CORNERS) / _DISC_CORNERS
    corners = centre[:, None, :] + radius[:, None, None] * (
        np.cos(turn)[None, :, None] * first[:, None, :]
        + np.sin(turn)[None, :, None] * second[:, None, :]
    )
    fan = np.array([(0, i, i + 1) for i in range(1, _DISC_CORNERS - 1)])
    faces = (np.arange(len(where)) * _DISC_CORNERS)[:, None, None] + fan[None]
    mesh = _triangles(name, corners.reshape(-1, 3), faces.reshape(-1, 3))
    mesh.materials.append(surface_material())
    return _link(mesh, collection)


def _triangles(name: str, points: FloatArray, faces: IntArray) -> Any:
    mesh = bpy.data.meshes.new(name)
    mesh.vertices.add(len(points))
    mesh.vertices.foreach_set("co", _flat32(points))
    mesh.loops.add(3 * len(faces))
    mesh.loops.foreach_set("vertex_index", np.ascontiguousarray(faces, dtype=np.int32).ravel())
    mesh.polygons.add(len(faces))
    mesh.polygons.foreach_set("loop_start", np.arange(0, 3 * len(faces), 3, dtype=np.int32))
    mesh.update(calc_edges=True)
    mesh.validate()
    mesh.shade_smooth()
    return mesh


def _flat32(values: FloatArray) -> npt.NDArray[np.float32]:
    return np.ascontiguousarray(values, dtype=np.float32).ravel()


def _link(mesh: Any, collection: Any) -> Any:
    thing = bpy.data.objects.new(mesh.name, mesh)
    collection.objects.link(thing)
    return thing
