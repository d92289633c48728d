"""Camera, light, ground, render and file: from objects to a picture on white."""

from __future__ import annotations

import os
import tempfile
from collections.abc import Callable
from pathlib import Path
from typing import Any, Final

import bpy
import numpy as np
from mathutils import Matrix
from scipy.ndimage import map_coordinates

from pdtheory.blender import compat
from pdtheory.drawing.view import View
from pdtheory.errors import ComputationError, FileAccessError, InputError
from pdtheory.pointset.cloud import FloatArray

Progress = Callable[[float, str], None]

#: Field of view of the camera; long, so that the shape is not distorted.
_LENS_MM: Final = 70.0

#: Part of the picture left free around the object.
_MARGIN: Final = 0.06

# The ground is lit to just above white, so that only shadows on it can be seen.
_SKY: Final = 0.55
_SUN: Final = 3.1
_GROUND: Final = 0.8
_GROUND_NAME: Final = "Ground"

#: Light that bounces between surfaces more often adds nothing that can be seen on matt grey.
_BOUNCES: Final = 1

#: The ground is rendered so many times coarser than the objects, but not below so many rows.
_SHADOW_COARSER: Final = 3.0
_SHADOW_ROWS: Final = 200
_SHADOW_SAMPLES: Final = 16

#: Part of the picture along its border in which shadows fade.
_FADE: Final = 0.1


def new_file() -> Any:
    """Start an empty Blender file and return its scene."""
    if not bpy.app.background:
        raise InputError(
            "drawing into a fresh file would throw away the open one; use bpy without a window."
        )
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    return bpy.context.scene


def set_stage(scene: Any, corners: FloatArray, view: View, *, ground: bool = True) -> None:
    """Add camera, sun, white surroundings and ground for objects that fill the given points.

    Parameters
    ----------
    scene
        `bpy` scene to put them into.
    corners : (N, 3) float
        Points in world coordinates that must all be in the picture.
    view
        Where the camera stands.
    ground
        Whether the object stands on a ground that catches its shadow; never if it is seen from
        below.
    """
    axes = view.axes()
    local = corners @ axes.T
    low, high = local.min(axis=0), local.max(axis=0)
    size = float(np.linalg.norm(high - low)) or 1.0
    stage = Matrix(axes.T.tolist()).to_4x4()

    azimuth, elevation = np.radians(view.azimuth), np.radians(view.elevation)
    look = Matrix.Rotation(azimuth, 4, "Z") @ Matrix.Rotation(np.pi / 2 - elevation, 4, "X")
    camera = bpy.data.objects.new("Camera", bpy.data.cameras.new("Camera"))
    camera.data.lens = _LENS_MM
    scene.collection.objects.link(camera)
    scene.camera = camera
    camera.matrix_world = stage @ look
    _frame(camera, corners)
    camera.data.clip_start, camera.data.clip_end = 1e-3 * size, 1e3 * size

    # The sun stands behind the left shoulder of the camera, on the side that is seen.
    below = view.elevation < 0.0
    tilt = np.radians(180.0 - 38.0 if below else 38.0)
    aim = Matrix.Rotation(azimuth - np.radians(38.0), 4, "Z") @ Matrix.Rotation(tilt, 4, "X")
    sun = bpy.data.objects.new("Sun", bpy.data.lights.new("Sun", "SUN"))
    sun.data.energy = _SUN
    sun.data.angle = np.radians(25.0)
    sun.matrix_world = stage @ aim
    scene.collection.objects.link(sun)
    _surroundings(scene)
    if ground and not below:
        centre = (low + high) / 2.0
        centre[2] = low[2] - 0.002 * size
        _ground(scene, stage, centre, 60.0 * size)


def _frame(camera: Any, corners: FloatArray) -> None:
    """Move the camera along its axis and sideways until all points are in the picture."""
    points = np.ascontiguousarray(corners, dtype=np.float32).ravel()
    lens = camera.data.lens
    # Fit with a longer lens, then put the wider one back: what is left over is the margin.
    camera.data.lens = lens / (1.0 - 2.0 * _MARGIN)
    bpy.context.view_layer.update()
    graph = bpy.context.evaluated_depsgraph_get()
    location, _ = camera.camera_fit_coords(graph, points.tolist())
    camera.data.lens = lens
    camera.location = location
    bpy.context.view_layer.update()


def _surroundings(scene: Any) -> None:
    """White to the camera, a soft sky to everything else."""
    world = bpy.data.worlds.new("White")
    scene.world = world
    tree = compat.enable_nodes(world)
    tree.nodes.clear()
    path = tree.nodes.new("ShaderNodeLightPath")
    seen = tree.nodes.new("ShaderNodeMix")
    seen.inputs["A"].default_value = _SKY
    seen.inputs["B"].default_value = 1.0
    background = tree.nodes.new("ShaderNodeBackground")
    output = tree.nodes.new("ShaderNodeOutputWorld")
    tree.links.new(path.outputs["Is Camera Ray"], seen.inputs["Factor"])
    tree.links.new(seen.outputs[0], background.inputs["Strength"])
    background.inputs["Color"].default_value = (1.0, 1.0, 1.0, 1.0)
    tree.links.new(background.outputs[0], output.inputs["Surface"])


def _ground(scene: Any, stage: Any, centre: FloatArray, size: float) -> None:
    half = size / 2.0
    mesh = bpy.data.meshes.new("Ground")
    corners = [(-half, -half, 0.0), (half, -half, 0.0), (half, half, 0.0), (-half, half, 0.0)]
    mesh.from_pydata(corners, [], [(0, 1, 2, 3)])
    material = bpy.data.materials.new("Ground")
    tree = compat.enable_nodes(material)
    tree.nodes.clear()
    diffuse = tree.nodes.new("ShaderNodeBsdfDiffuse")
    diffuse.inputs["Color"].default_value = (_GROUND, _GROUND, _GROUND, 1.0)
    output = tree.nodes.new("ShaderNodeOutputMaterial")
    tree.links.new(diffuse.outputs[0], output.inputs["Surface"])
    mesh.materials.append(material)
    ground = bpy.data.objects.new(_GROUND_NAME, mesh)
    ground.matrix_world = stage @ Matrix.Translation(centre.tolist())
    scene.collection.objects.link(ground)


def render_picture(
    scene: Any,
    path: str | os.PathLike[str],
    *,
    samples: int = 12,
    progress: Progress | None = None,
) -> None:
    """Render a scene to a PNG on white with Cycles.

    The objects are rendered on a transparent film; the ground, where there is one, apart and
    coarser, since soft shadows hold no detail and most of a picture is ground.

    Parameters
    ----------
    scene
        `bpy` scene with a camera.
    path
        The PNG to write.
    samples
        Rays for each pixel; 12 to 32 suffice where Blender carries a denoiser.
    progress
        Called with a fraction and a text.

    Raises
    ------
    ComputationError
        If Blender did not make a picture.
    """
    report = progress or (lambda fraction, text: None)
    _settings(scene)
    ground = scene.objects.get(_GROUND_NAME)
    with tempfile.TemporaryDirectory() as folder:
        report(0.0, "rendering the surface")
        if ground is not None:
            ground.hide_render = True
        scene.render.film_transparent = True
        scene.cycles.samples = samples
        scene.cycles.max_bounces = _BOUNCES
        picture = _render(scene, Path(folder) / "objects.png")
        alpha = picture[..., 3:]
        behind: FloatArray = np.ones_like(picture[..., :3])
        if ground is not None:
            report(0.8, "rendering the shadow")
            behind = _shadow(scene, ground, Path(folder) / "ground.png", picture.shape[:2])
        blend = behind + alpha * (picture[..., :3] - behind)
        _write(Path(path), blend)
    report(1.0, "rendered")


def _settings(scene: Any) -> None:
    render, cycles = scene.render, scene.cycles
    render.engine = "CYCLES"
    cycles.device = "CPU"
    cycles.use_adaptive_sampling = True
    cycles.adaptive_threshold = 0.05
    cycles.adaptive_min_samples = 4
    cycles.use_denoising = compat.has_denoiser(scene)
    if cycles.use_denoising:
        compat.denoise_fast(scene)
    scene.view_settings.view_transform = "Standard"
    render.image_settings.file_format = "PNG"
    render.image_settings.color_mode = "RGBA"
    render.use_file_extension = False


def _shadow(scene: Any, ground: Any, path: Path, shape: tuple[int, ...]) -> FloatArray:
    """Return the ground with the shadows of everything on it, (height, width, 3)."""
    render = scene.render
    percentage = render.resolution_percentage
    others = [thing for thing in scene.objects if thing is not ground and thing.visible_camera]
    try:
        for thing in others:
            thing.visible_camera = False
        ground.hide_render = False
        render.film_transparent = False
        coarser = min(_SHADOW_COARSER, max(1.0, shape[0] / _SHADOW_ROWS))
        render.resolution_percentage = max(1, round(percentage / coarser))
        scene.cycles.samples = max(scene.cycles.samples, _SHADOW_SAMPLES)
        scene.cycles.max_bounces = 0
        coarse = _render(scene, path)[..., :3]
    finally:
        render.resolution_percentage = percentage
        for thing in others:
            thing.visible_camera = True
    # Everything here is grey: one channel says it all, and carries no tint of noise.
    dark = 1.0 - coarse.mean(axis=-1)
    rows = np.linspace(0, dark.shape[0] - 1, shape[0])
    columns = np.linspace(0, dark.shape[1] - 1, shape[1])
    fine = map_coordinates(dark, np.meshgrid(rows, columns, indexing="ij"), order=1)
    # Towards its border the picture goes over into the white of the page.
    fade = np.outer(_rise(shape[0]), _rise(shape[1]))
    return np.repeat((1.0 - fade * fine)[..., None], 3, axis=-1)


def _rise(count: int) -> FloatArray:
    """Return a smooth window: 0 at both ends, 1 within the fading margin."""
    inward = np.minimum(np.arange(count), np.arange(count)[::-1]) / max(1.0, _FADE * count)
    inward = np.minimum(inward, 1.0)
    return np.asarray(inward**2 * (3.0 - 2.0 * inward))


def _render(scene: Any, path: Path) -> FloatArray:
    """Render and return the pixels, (height, width, 4) in sRGB from 0 to 1."""
    before = scene.render.filepath
    scene.render.filepath = str(path)
    try:
        bpy.ops.render.render(write_still=True, scene=scene.name)
    except RuntimeError as error:
        raise ComputationError(f"Blender could not render the picture ({error}).") from error
    finally:
        scene.render.filepath = before
    if not path.is_file():
        raise ComputationError("Blender made no picture; is there enough memory and disk?")
    image = bpy.data.images.load(str(path))
    try:
        width, height = image.size
        pixels = np.empty(width * height * 4, dtype=np.float32)
        image.pixels.foreach_get(pixels)
    finally:
        bpy.data.images.remove(image)
    return pixels.reshape(height, width, 4).astype(np.float64)


def _write(path: Path, picture: FloatArray) -> None:
    """Write pixels (height, width, 3), in sRGB from 0 to 1, as PNG."""
    height, width = picture.shape[:2]
    image = bpy.data.images.new(path.name, width, height, alpha=False)
    try:
        pixels = np.ones((height, width, 4), dtype=np.float32)
        pixels[..., :3] = picture
        image.pixels.foreach_set(pixels.ravel())
        image.file_format = "PNG"
        image.filepath_raw = str(path)
        image.save()
    finally:
        bpy.data.images.remove(image)


def save_blend(path: str | os.PathLike[str]) -> None:
    """Save a copy of the open file as .blend.

    Raises
    ------
    FileAccessError
        If the file cannot be written.
    """
    try:
        bpy.ops.wm.save_as_mainfile(
            filepath=os.fspath(path), copy=True, check_existing=False, compress=True
        )
    except RuntimeError as error:
        raise FileAccessError(f"Blender cannot write {Path(path)} ({error}).") from error
