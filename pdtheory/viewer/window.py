"""The window, the picture of it, and the notebook widget."""

from __future__ import annotations

import os
import sys
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from pdtheory.atomic import atomic_path
from pdtheory.drawing.choice import CERTAIN, check_choice, check_size, refuse_empty
from pdtheory.drawing.view import natural_view, on_fitted_surface
from pdtheory.errors import ComputationError, InputError, MissingDependencyError
from pdtheory.pointset.cloud import PointCloud
from pdtheory.pointset.field import DirectionField
from pdtheory.viewer.scene import FieldView


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
        The surface they lie on, if it is known: its triangles, or its points as small discs.
        Otherwise the points of the field are drawn, each where its fit puts the surface.
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
    field = on_fitted_surface(field) if cloud is None else field
    place = natural_view(field, cloud, up=up, azimuth=azimuth, elevation=elevation)
    pyvista = _pyvista()
    plotter = pyvista.Plotter(off_screen=screenshot is not None, window_size=list(size))
    try:
        scene = FieldView(field, cloud, choice, place, plotter)
        if screenshot is None:
            scene.add_controls()
            plotter.show(title="Principal directions")
            return
        refuse_empty(scene.count())
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

    The kernel draws, and serves the page on its own machine without any network; a browser on
    another machine reaches it only through PyVista's settings for a proxy.

    Parameters
    ----------
    field, cloud, orders, kind, strokes, least_strength, largest_uncertainty
        As for :func:`view_field`.
    size
        Width and height in pixels; a narrower notebook makes the widget narrower.

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
    check_size(size)
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
    field = on_fitted_surface(field) if cloud is None else field
    scene = FieldView(field, cloud, choice, natural_view(field, cloud), plotter)
    scene.add_controls()
    with _own_server(pyvista):
        # Drawn by the kernel, where the switches live. A fixed width would be cut off on the right,
        # and the slider with it.
        return plotter.show(
            jupyter_backend="server",
            jupyter_kwargs={"width": f"min({size[0]}px, 100%)"},
            return_viewer=True,
        )


@contextmanager
def _own_server(pyvista: Any) -> Iterator[None]:
    """Let PyVista start a server that downloads nothing.

    With each server PyVista sets up VTK's renderer for the browser, which is fetched at once; where
    that fails, a traceback appears below some later cell. The kernel draws this view, so the
    renderer is left out; and the server is our own, because other plots may want it in theirs.
    """
    settings = pyvista.global_theme.trame
    shared = settings.jupyter_server_name
    try:
        from trame.widgets import vtklocal
    except ImportError:
        vtklocal = None
    else:
        initialize, vtklocal.initialize = vtklocal.initialize, lambda server: None
    settings.jupyter_server_name = "pdtheory"
    try:
        yield
    finally:
        settings.jupyter_server_name = shared
        if vtklocal is not None:
            vtklocal.initialize = initialize


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
