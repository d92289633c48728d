"""The window, the picture of it, and the notebook widget."""

from __future__ import annotations

import os
import sys
from collections.abc import Iterable
from pathlib import Path
from typing import Any, Final

import numpy as np

from pdtheory.atomic import atomic_path
from pdtheory.conventions import order_colour
from pdtheory.drawing.choice import Choice, check_choice, check_size
from pdtheory.drawing.glyphs import CERTAIN
from pdtheory.drawing.view import View, natural_view
from pdtheory.errors import ComputationError, InputError, MissingDependencyError
from pdtheory.pointset.cloud import PointCloud
from pdtheory.pointset.field import DirectionField
from pdtheory.viewer.strokes import Strokes, cells, discs

#: Degrees of the camera's field of view, and how much farther it stands than it must.
_ANGLE: Final = 30.0
_MARGIN: Final = 1.06

_SURFACE: Final = (0.93, 0.92, 0.90)
_DISCS: Final = (0.78, 0.77, 0.75)
_INK: Final = (0.15, 0.15, 0.15)

#: Pixels of a switch, and of the line of text beside it.
_SWITCH: Final = 22
_LINE: Final = 34


class FieldView:
    """A field in a PyVista plotter, with a switch for every order and a slider for the strength.

    Parameters
    ----------
    field
        The directions.
    cloud
        The surface, if it has triangles; else the points of the field are drawn as discs.
    choice
        What is shown at first.
    view
        Where the camera stands.
    plotter
        An empty `pyvista.Plotter`.
    """

    def __init__(
        self,
        field: DirectionField,
        cloud: PointCloud | None,
        choice: Choice,
        view: View,
        plotter: Any,
    ) -> None:
        self.choice = choice
        self.plotter = plotter
        self._strokes = Strokes.of_field(field)
        self._offered = field.orders
        plotter.set_background("white")
        plotter.enable_anti_aliasing("ssaa")
        points = field.points if cloud is None else cloud.points
        self._points = points[np.isfinite(points).all(axis=1)]
        self._place_camera(view)
        self._add_surface(field, cloud)
        self.refresh()
        plotter.reset_camera_clipping_range()

    def refresh(self) -> None:
        """Draw the strokes anew, as :attr:`choice` says."""
        import pyvista

        seen = self._strokes.seen(self.choice)
        order = self._strokes.data.attributes["order"]
        kind = np.asarray(self._strokes.data.attributes["kind"])
        both = self.choice.kind == "both"
        for number in self._offered:
            for sign, width in ((1, 5.0), (-1, 2.5 if both else 5.0)):
                name = f"order {number} {sign}"
                lines = self._strokes.lines(seen & (order == number) & (kind == sign), self.choice)
                if not len(lines):
                    self.plotter.remove_actor(name, render=False)
                    continue
                mesh = pyvista.PolyData()
                mesh.points = lines.reshape(-1, 3)
                mesh.lines = cells(lines)
                self.plotter.add_mesh(
                    mesh,
                    name=name,
                    color=tuple(order_colour(number)),
                    line_width=width,
                    render_lines_as_tubes=True,
                    ambient=0.25,
                    reset_camera=False,
                    render=False,
                )

    def count(self) -> int:
        """Return how many strokes are seen."""
        return int(self._strokes.seen(self.choice).sum())

    def switch(self, order: int, on: bool) -> None:
        """Switch an order on or off."""
        orders = set(self.choice.orders) | {order} if on else set(self.choice.orders) - {order}
        self.choice = self.choice._replace(orders=tuple(sorted(orders)))
        self.refresh()

    def threshold(self, strength: float) -> None:
        """Leave out the directions that are weaker."""
        self.choice = self.choice._replace(least_strength=strength)
        self.refresh()

    def add_controls(self) -> None:
        """Put a switch for each order and the slider for the strength into the window."""
        for row, order in enumerate(reversed(self._offered)):
            height = 12 + row * _LINE
            self.plotter.add_checkbox_button_widget(
                lambda on, order=order: self.switch(order, bool(on)),
                value=order in self.choice.orders,
                position=(12.0, float(height)),
                size=_SWITCH,
                border_size=2,
                color_on=tuple(order_colour(order)),
                color_off=(0.85, 0.85, 0.85),
            )
            self.plotter.add_text(
                f"order {order}",
                position=(12 + _SWITCH + 8, height + 2),
                font_size=9,
                color=_INK,
                name=f"label {order}",
            )
        chosen = self.choice.least_strength
        low, high = np.log10(self._strokes.strengths())
        start = float(np.log10(chosen)) if chosen > 0.0 else low
        low, high = min(low, start), max(high, start, low + 1e-3)
        self.plotter.add_slider_widget(
            lambda value: self.threshold(float(10.0**value) if value > low else 0.0),
            rng=(float(low), float(high)),
            value=float(start),
            title="least strength (log10)",
            pointa=(0.68, 0.08),
            pointb=(0.97, 0.08),
            color=_INK,
            style="modern",
            fmt="%.2f",
            title_height=0.018,
        )

    def _add_surface(self, field: DirectionField, cloud: PointCloud | None) -> None:
        import pyvista

        if cloud is not None and cloud.faces is not None and len(cloud.faces):
            mesh = pyvista.PolyData.from_regular_faces(cloud.points, cloud.faces)
            self.plotter.add_mesh(
                mesh,
                color=_SURFACE,
                smooth_shading=True,
                split_sharp_edges=True,
                feature_angle=40.0,
                specular=0.1,
                ambient=0.15,
                name="surface",
                reset_camera=False,
            )
            return
        points, faces = discs(field)
        self.plotter.add_mesh(
            pyvista.PolyData.from_regular_faces(points, faces),
            color=_DISCS,
            ambient=0.2,
            name="surface",
            reset_camera=False,
        )

    def _place_camera(self, view: View) -> None:
        """Look at the middle of the points from where they just fill the window."""
        right, back, up = view.axes()
        turn, rise = np.radians(view.azimuth), np.radians(view.elevation)
        outward = np.cos(rise) * (np.sin(turn) * right - np.cos(turn) * back) + np.sin(rise) * up
        # Seen from above, "up" in the picture is away from the viewer.
        upward = back if view.elevation > 89.0 else up
        across = np.cross(upward, outward)
        across /= np.linalg.norm(across)
        axes = np.stack([across, np.cross(outward, across), outward])
        seen = self._points @ axes.T
        middle = (seen.min(axis=0) + seen.max(axis=0)) / 2.0
        seen -= middle
        tangent = np.tan(np.radians(_ANGLE) / 2.0)
        width, height = self.plotter.window_size
        slopes = np.abs(seen[:, :2]) / (tangent * np.array([width / height, 1.0]))
        reach = float(np.linalg.norm(np.ptp(seen, axis=0))) or 1.0
        distance = max(_MARGIN * float((slopes.max(axis=1) + seen[:, 2]).max()), 0.1 * reach)
        centre = middle @ axes
        self.plotter.camera.view_angle = _ANGLE
        self.plotter.camera_position = [centre + distance * outward, centre, upward]
        self.plotter.reset_camera_clipping_range()


def view_field(
    field: DirectionField,
    cloud: PointCloud | None = None,
    *,
    orders: Iterable[int] | None = None,
    kind: str = "max",
    strokes: int = 800,
    least_strength: float = 0.0,
    largest_uncertainty: float = CERTAIN,
    up: str | None = None,
    azimuth: float | None = None,
    elevation: float | None = None,
    size: tuple[int, int] = (1200, 900),
    screenshot: str | os.PathLike[str] | None = None,
) -> None:
    """Open a window with the directions on their surface, or write a picture of it.

    The window has a switch for every order and a slider below which strength directions are left
    out; the mouse turns, shifts and zooms; ``q`` closes it.

    Parameters
    ----------
    field
        The directions.
    cloud
        The surface they lie on, if its triangles are known; otherwise the points of the field are
        drawn as small discs.
    orders
        Orders that are switched on at first; all by default.
    kind
        ``max``, ``min`` or ``both``; minima are thinner where both are drawn.
    strokes
        About how many points carry strokes.
    least_strength
        Weaker directions are left out.
    largest_uncertainty
        Directions whose standard deviation is larger (radians) are left out.
    up, azimuth, elevation
        As for :func:`pdtheory.blender.draw_field`.
    size
        Width and height of the window or the picture in pixels.
    screenshot
        A PNG to write, without a window and without the controls.

    Raises
    ------
    InputError
        If an option cannot be used, or there is nothing to show.
    MissingDependencyError
        If PyVista is not installed.
    FileAccessError
        If the picture cannot be written.
    ComputationError
        If there is no display for a window, or no OpenGL to draw with.
    """
    choice = check_choice(
        field,
        orders=orders,
        kind=kind,
        strokes=strokes,
        least_strength=least_strength,
        largest_uncertainty=largest_uncertainty,
    )
    check_size(size)
    if screenshot is not None and Path(screenshot).suffix.lower() != ".png":
        raise InputError(f"cannot write {screenshot}: pictures of the viewer are .png files.")
    if screenshot is None and not _has_display():
        raise ComputationError(
            "there is no display to open a window on; write a picture with screenshot instead "
            "(--screenshot on the command line)."
        )
    place = _view(field, cloud, up, azimuth, elevation)
    pyvista = _pyvista()
    plotter = pyvista.Plotter(off_screen=screenshot is not None, window_size=list(size))
    try:
        scene = FieldView(field, cloud, choice, place, plotter)
        if screenshot is None:
            scene.add_controls()
            plotter.show(title="Principal directions")
            return
        if not scene.count():
            raise InputError(
                "no direction is left to show; switch on more orders, lower least_strength or "
                "raise largest_uncertainty."
            )
        with atomic_path(screenshot) as temporary:
            plotter.screenshot(str(temporary))
    finally:
        plotter.close()


def widget(
    field: DirectionField,
    cloud: PointCloud | None = None,
    *,
    orders: Iterable[int] | None = None,
    kind: str = "max",
    strokes: int = 800,
    least_strength: float = 0.0,
    largest_uncertainty: float = CERTAIN,
    size: tuple[int, int] = (900, 600),
) -> Any:
    """Return the view of :func:`view_field`, controls included, as a widget for a notebook.

    Parameters
    ----------
    field, cloud, orders, kind, strokes, least_strength, largest_uncertainty, size
        As for :func:`view_field`.

    Returns
    -------
    ipywidgets.Widget
        To be displayed as the last line of a cell.

    Raises
    ------
    InputError
        If an option cannot be used, or there is nothing to show.
    MissingDependencyError
        If PyVista or its notebook support is not installed.
    """
    choice = check_choice(
        field,
        orders=orders,
        kind=kind,
        strokes=strokes,
        least_strength=least_strength,
        largest_uncertainty=largest_uncertainty,
    )
    pyvista = _pyvista()
    try:
        import ipywidgets  # noqa: F401
        import trame  # noqa: F401
    except ImportError as error:
        # PyVista would fall back to a picture that answers nothing.
        raise MissingDependencyError(
            "the notebook widget needs trame and ipywidgets; install them with "
            "`pip install 'pyvista[jupyter]'` (extra notebook)."
        ) from error
    plotter = pyvista.Plotter(notebook=True, off_screen=True, window_size=list(size))
    scene = FieldView(field, cloud, choice, _view(field, cloud, None, None, None), plotter)
    scene.add_controls()
    # Drawn by the kernel, where the switches live; nothing is fetched from a network.
    return plotter.show(jupyter_backend="server", return_viewer=True)


def _view(
    field: DirectionField,
    cloud: PointCloud | None,
    up: str | None,
    azimuth: float | None,
    elevation: float | None,
) -> View:
    points = field.points if cloud is None else cloud.points
    finite = points[np.isfinite(points).all(axis=1)]
    if len(finite) < 3:
        raise InputError("the surface has fewer than three finite points; nothing to show.")
    return natural_view(finite, field.frames[:, 2], up=up, azimuth=azimuth, elevation=elevation)


def _has_display() -> bool:
    """Return whether a window can be opened; only X and Wayland say so beforehand."""
    if not sys.platform.startswith("linux"):
        return True
    return bool(os.environ.get("DISPLAY") or os.environ.get("WAYLAND_DISPLAY"))


def _pyvista() -> Any:
    if not _has_display():
        # Else VTK tries an X server first and complains on the terminal.
        os.environ.setdefault("VTK_DEFAULT_OPENGL_WINDOW", "vtkEGLRenderWindow")
    try:
        import pyvista
    except ImportError as error:
        raise MissingDependencyError(
            "the viewer needs PyVista; install it with `pip install pyvista` (extra viewer)."
        ) from error
    return pyvista
