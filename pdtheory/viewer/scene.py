"""The surface, its strokes, the switches and the camera, in a plotter of PyVista."""

from __future__ import annotations

from typing import Any, Final

import numpy as np

from pdtheory.conventions import order_colour
from pdtheory.drawing.choice import Choice
from pdtheory.drawing.view import View, surface_points
from pdtheory.pointset.cloud import FloatArray, PointCloud
from pdtheory.pointset.field import DirectionField
from pdtheory.viewer.strokes import Strokes, cells, discs

#: Degrees of the camera's field of view, and the part of the picture left free on each side.
_ANGLE: Final = 30.0
_MARGIN: Final = 0.06
#: Steps that bring the picture to the middle, each of which leaves a fraction of the error.
_STEPS: Final = 30

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
        The surface, if it is known: its triangles, or its points as discs; else the points of the
        field.
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
        self._place_camera(view, self._add_surface(field, cloud))
        self.refresh()
        plotter.reset_camera_clipping_range()

    def refresh(self) -> None:
        """Draw the strokes anew, as :attr:`choice` says."""
        import pyvista

        seen = self._strokes.seen(self.choice)
        self._count = int(seen.sum())
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
        return self._count

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

    def _add_surface(self, field: DirectionField, cloud: PointCloud | None) -> FloatArray:
        """Add triangles or discs and return the points that they reach to."""
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
            return surface_points(field, cloud)
        points, faces = discs(field, cloud)
        self.plotter.add_mesh(
            pyvista.PolyData.from_regular_faces(points, faces),
            color=_DISCS,
            ambient=0.2,
            name="surface",
            reset_camera=False,
        )
        return points

    def _place_camera(self, view: View, points: FloatArray) -> None:
        """Stand where `points` just fill the window, and lie in the middle of it."""
        right, back, up = view.axes()
        turn, rise = np.radians(view.azimuth), np.radians(view.elevation)
        level = np.sin(turn) * right - np.cos(turn) * back
        outward = np.cos(rise) * level + np.sin(rise) * up
        upward = np.cos(rise) * up - np.sin(rise) * level
        axes = np.stack([np.cross(upward, outward), upward, outward])
        seen = points @ axes.T
        middle = (seen.min(axis=0) + seen.max(axis=0)) / 2.0
        seen -= middle
        width, height = self.plotter.window_size
        tangents = np.tan(np.radians(_ANGLE) / 2.0) * np.array([width / height, 1.0])
        shift, distance = _fit(seen, tangents)
        centre = (middle + shift) @ axes
        self.plotter.camera.view_angle = _ANGLE
        self.plotter.camera_position = [centre + distance * outward, centre, upward]
        self.plotter.reset_camera_clipping_range()


def _fit(seen: FloatArray, tangents: FloatArray) -> tuple[FloatArray, float]:
    """Return where a camera that looks along -z stands: its (x, y, 0), and its height z.

    Parameters
    ----------
    seen : (N, 3) float64
        Points that fill the picture in one direction and are in its middle in both.
    tangents : (2,) float64
        Half the width and height of the picture, at distance 1.
    """
    inner = (1.0 - 2.0 * _MARGIN) * tangents
    deep = seen[:, 2, None] * inner
    # A point is in the picture of a camera at (c, z) if |x - c| <= t (z - depth).
    high = (seen[:, :2] + deep).max(axis=0)
    low = (seen[:, :2] - deep).min(axis=0)
    reach = float(np.linalg.norm(np.ptp(seen, axis=0))) or 1.0
    distance = max(float(((high - low) / (2.0 * inner)).max()), seen[:, 2].max() + 0.1 * reach)
    shift = np.zeros(3)
    shift[:2] = (high + low) / 2.0
    nearest = distance - seen[:, 2].max()
    for _ in range(_STEPS):
        # Where there is room left, the margins shall be equal in the picture, not in space.
        slopes = (seen[:, :2] - shift[:2]) / (distance - seen[:, 2, None])
        shift[:2] += nearest * (slopes.max(axis=0) + slopes.min(axis=0)) / 2.0
    return shift, distance
