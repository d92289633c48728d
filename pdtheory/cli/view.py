"""``pdtheory view``: a direction field in a window that answers the mouse."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from pdtheory.cli.options import (
    Azimuth,
    Elevation,
    LargestUncertainty,
    LeastStrength,
    Strokes,
    Up,
    check_target,
    load_drawable,
    parse_orders,
    parse_size,
)


def view(
    field: Annotated[
        Path,
        typer.Argument(
            metavar="FIELD",
            help="Direction field to show: NPZ, or the folder of a run.",
            show_default=False,
        ),
    ],
    mesh: Annotated[
        Path | None,
        typer.Option(help="Surface below the directions; without it their points are shown."),
    ] = None,
    orders: Annotated[
        str | None, typer.Option(help="Orders switched on at first, such as 2,3; all if left out.")
    ] = None,
    kind: Annotated[str, typer.Option(help="Directions to show: max, min or both.")] = "max",
    strokes: Strokes = 800,
    least_strength: LeastStrength = 0.0,
    largest_uncertainty: LargestUncertainty = 20.0,
    up: Up = None,
    azimuth: Azimuth = None,
    elevation: Elevation = None,
    size: Annotated[str, typer.Option(help="Width x height of the window.")] = "1200x900",
    screenshot: Annotated[
        Path | None, typer.Option(help="Write this PNG instead of opening a window.")
    ] = None,
) -> None:
    """Show directions on their surface in a window: a switch for each order, a strength slider.

    Needs PyVista (extra viewer). With --screenshot no display is needed.

    Example: pdtheory view field.npz --mesh scan.ply --orders 2,3
    """
    from math import radians

    from pdtheory.io import read_cloud
    from pdtheory.viewer import view_field

    if screenshot is not None:
        check_target(screenshot, (".png",), field, mesh)
    wanted = None if orders is None else parse_orders(orders)
    pixels = parse_size(size)
    directions = load_drawable(field)
    view_field(
        directions,
        None if mesh is None else read_cloud(mesh),
        orders=wanted,
        kind=kind,
        strokes=strokes,
        least_strength=least_strength,
        largest_uncertainty=radians(largest_uncertainty),
        up=up,
        azimuth=azimuth,
        elevation=elevation,
        size=pixels,
        screenshot=screenshot,
    )
    if screenshot is not None:
        typer.echo(f"Wrote {screenshot}")
