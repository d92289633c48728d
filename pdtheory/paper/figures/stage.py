"""Pictures of surfaces with strokes, through Blender, and sheets of several of them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, Final

import numpy as np
import numpy.typing as npt

from pdtheory.atomic import atomic_path
from pdtheory.conventions import Kind
from pdtheory.paper.figures.outcome import Job
from pdtheory.paper.figures.tubes import Drapery, tubes
from pdtheory.pointset.cloud import FloatArray, PointCloud
from pdtheory.pointset.field import DirectionField

#: Strokes by strength are at most so many times their full length.
_LONGEST: Final = 1.5

#: Minima are drawn so much thinner than maxima.
_MINIMUM_WIDTH: Final = 0.5


@dataclass(frozen=True)
class Strokes:
    """How the directions of a field are drawn.

    Attributes
    ----------
    field : DirectionField
        The directions; a stroke stands at every point of the field.
    orders : sequence of int
        The orders drawn.
    length : float
        Length of a stroke of strength `full`, in the units of the surface.
    full : float or None
        Strength at which a stroke has its full length; None draws all of them at full length.
    maxima, minima : bool
        The kinds drawn.
    width : float
        Thickness of a maximum, as a part of `length`; minima are thinner.
    least : float
        Directions of smaller strength are left out.
    chosen : (P,) int64 or None
        The one order to draw at each point; None draws all.
    amplitude : (P,) float64 or None
        What stands for the strength of all directions of a point; None takes their own.
    """

    field: DirectionField
    orders: Sequence[int]
    length: float
    full: float | None = None
    maxima: bool = True
    minima: bool = False
    width: float = 0.16
    least: float = 0.0
    chosen: npt.NDArray[np.int64] | None = None
    amplitude: FloatArray | None = None

    def mesh(self, drapery: Drapery, order: int) -> PointCloud:
        """Return the strokes of one order as tubes on a surface."""
        rows = self.field[order]
        point = rows.point_index
        strength = rows.strength if self.amplitude is None else self.amplitude[point]
        keep = (strength >= self.least) & (
            (self.maxima & (rows.kind == Kind.MAXIMUM))
            | (self.minima & (rows.kind == Kind.MINIMUM))
        )
        if self.chosen is not None:
            keep &= self.chosen[point] == order
        share = np.ones(len(rows))
        if self.full is not None:
            share = np.minimum(strength / self.full, _LONGEST)
        thick = np.where(rows.kind == Kind.MAXIMUM, 1.0, _MINIMUM_WIDTH)
        point, share, thick = point[keep], share[keep], thick[keep]
        return tubes(
            drapery,
            self.field.points[point],
            rows.vector[keep],
            self.field.frames[point, 2],
            self.length * share,
            0.5 * self.width * self.length * thick,
        )


@dataclass(frozen=True)
class Panel:
    """One picture of a sheet.

    Attributes
    ----------
    surface : PointCloud
        A mesh.
    strokes : sequence of Strokes
        What is drawn on it.
    title : str
        Stands below the picture.
    up, azimuth, elevation
        Where the camera stands (:class:`pdtheory.blender.scene.View`).
    focus : (N, 3) float64 or None
        Points that must be in the picture; None takes the whole surface.
    patch : (F,) bool or None
        Triangles shown in green.
    ground : bool
        Whether there is a ground with a shadow.
    """

    surface: PointCloud
    strokes: Sequence[Strokes]
    title: str = ""
    up: str = "z"
    azimuth: float = 30.0
    elevation: float = 35.0
    focus: FloatArray | None = None
    patch: npt.NDArray[np.bool_] | None = None
    ground: bool = True


def render(panel: Panel, path: Path, size: tuple[int, int], samples: int) -> None:
    """Render one panel to a PNG.

    Parameters
    ----------
    panel
        What to draw.
    path
        The file to write.
    size
        Width and height in pixels.
    samples
        Rays for each pixel.

    Raises
    ------
    MissingDependencyError
        If Blender's Python module is not installed.
    ComputationError
        If Blender did not make a picture.
    FileAccessError
        If the file cannot be written.
    """
    from pdtheory.blender.requirement import require_bpy

    require_bpy()

    from pdtheory.blender.needles import order_material
    from pdtheory.blender.prints import no_prints
    from pdtheory.blender.scene import new_file, render_picture, set_stage
    from pdtheory.blender.surface import add_surface
    from pdtheory.drawing.view import View

    scene = new_file()
    scene.render.resolution_x, scene.render.resolution_y = size
    scene.render.resolution_percentage = 100
    surface, patch = _split(panel.surface, panel.patch)
    add_surface(surface, collection=scene.collection)
    if patch is not None:
        part = add_surface(patch, collection=scene.collection)
        part.data.materials[0] = _patch_material(part.data.materials[0])
    drapery = Drapery(panel.surface)
    for strokes in panel.strokes:
        for order in strokes.orders:
            mesh = strokes.mesh(drapery, order)
            if len(mesh):
                thing = add_surface(mesh, collection=scene.collection)
                thing.data.materials[0] = order_material(order)
    corners = panel.surface.points if panel.focus is None else panel.focus
    view = View(up=panel.up, azimuth=panel.azimuth, elevation=panel.elevation)
    set_stage(scene, corners, view, ground=panel.ground)
    with atomic_path(path) as temporary, no_prints():
        render_picture(scene, temporary, samples=samples)


def _split(
    surface: PointCloud, chosen: npt.NDArray[np.bool_] | None
) -> tuple[PointCloud, PointCloud | None]:
    """Cut the chosen triangles out of a mesh."""
    if chosen is None or not chosen.any():
        return surface, None
    assert surface.faces is not None
    return replace(surface, faces=surface.faces[~chosen]), replace(
        surface, faces=surface.faces[chosen]
    )


def _patch_material(grey: Any) -> Any:
    """Return the material of the surface in pale green, as the paper shows a neighbourhood."""
    material = grey.copy()
    shader = next(node for node in material.node_tree.nodes if node.type == "BSDF_PRINCIPLED")
    shader.inputs["Base Color"].default_value = (0.30, 0.58, 0.30, 1.0)
    return material


def sheet(
    job: Job,
    panels: Sequence[Panel],
    folder: Path,
    name: str,
    *,
    columns: int,
    size: tuple[int, int] = (640, 480),
) -> list[Path]:
    """Render panels and put them on one sheet with their titles.

    Parameters
    ----------
    job
        Gives quality and progress.
    panels
        The panels, row by row.
    folder
        Where the files go.
    name
        Name of the sheet; panels get a number behind it.
    columns
        Panels in a row.
    size
        Width and height of a panel in pixels at draft quality; 2.5 times that on paper.

    Returns
    -------
    list of Path
        The sheet as PNG, then the panels. A single panel is its own sheet.
    """
    scale = job.pick(0.25, 1.0, 2.5)
    pixels = (round(size[0] * scale), round(size[1] * scale))
    single = len(panels) == 1
    paths = []
    for index, panel in enumerate(panels):
        job.tell(index / len(panels), f"{name}: picture {index + 1} of {len(panels)}")
        path = folder / (f"{name}.png" if single else f"{name}-{index + 1}.png")
        render(panel, path, pixels, job.pick(2, 8, 64))
        paths.append(path)
    if single:
        return paths
    return [_mount(panels, paths, folder / f"{name}.png", columns, size, scale), *paths]


def _mount(
    panels: Sequence[Panel],
    paths: Sequence[Path],
    target: Path,
    columns: int,
    size: tuple[int, int],
    scale: float,
) -> Path:
    """Put pictures side by side, with their titles below."""
    from pdtheory.paper.figures.plots import new_plot, pyplot, save

    plt = pyplot()
    rows = -(-len(panels) // columns)
    dots = 160.0
    wide, high = size[0] / dots, size[1] / dots
    text = 0.28 if any(panel.title for panel in panels) else 0.0
    figure = new_plot(columns * wide, rows * (high + text))
    for index, (panel, path) in enumerate(zip(panels, paths, strict=True)):
        column, row = index % columns, index // columns
        top = rows * (high + text)
        box = (
            column / columns,
            1 - (row * (high + text) + high) / top,
            1 / columns,
            high / top,
        )
        axes = figure.add_axes(box)
        axes.imshow(plt.imread(path), interpolation="lanczos")
        axes.set_axis_off()
        axes.text(0.5, -0.02, panel.title, ha="center", va="top", transform=axes.transAxes)
    save(figure, target, dots=dots * scale)
    return target
