"""``pdtheory draw``: a direction field as a picture or a Blender file."""

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
    progress_bar,
)


def draw(
    field: Annotated[
        Path,
        typer.Argument(
            metavar="FIELD", help="Direction field to draw: NPZ, or the folder of a run."
        ),
    ],
    output: Annotated[
        Path, typer.Option("--output", "-o", help="Picture (.png) or Blender file (.blend).")
    ],
    mesh: Annotated[
        Path | None,
        typer.Option(help="Surface to draw the directions on; without it their points are drawn."),
    ] = None,
    orders: Annotated[
        str | None, typer.Option(help="Orders to draw, such as 2,3; all if left out.")
    ] = None,
    kind: Annotated[str, typer.Option(help="Directions to draw: max, min or both.")] = "max",
    strokes: Strokes = 800,
    least_strength: LeastStrength = 0.0,
    largest_uncertainty: LargestUncertainty = 20.0,
    up: Up = None,
    azimuth: Azimuth = None,
    elevation: Elevation = None,
    size: Annotated[str, typer.Option(help="Width x height of the picture.")] = "1200x900",
    rays: Annotated[int, typer.Option(help="Rays for each pixel.", min=1)] = 12,
    quiet: Annotated[bool, typer.Option("--quiet", "-q", help="Print nothing.")] = False,
) -> None:
    """Draw directions on their surface with Blender.

    Example: pdtheory draw field.npz --mesh scan.ply -o picture.png --orders 2,3
    """
    from math import radians

    from pdtheory.blender.draw import SUFFIXES, draw_field
    from pdtheory.io import read_cloud

    check_target(output, SUFFIXES, field, mesh)
    wanted = None if orders is None else parse_orders(orders)
    pixels = parse_size(size)
    directions = load_drawable(field)
    cloud = None if mesh is None else read_cloud(mesh)
    with progress_bar("Drawing", quiet=quiet) as report:
        draw_field(
            directions,
            cloud,
            output,
            orders=wanted,
            kind=kind,
            strokes=strokes,
            least_strength=least_strength,
            largest_uncertainty=radians(largest_uncertainty),
            up=up,
            azimuth=azimuth,
            elevation=elevation,
            size=pixels,
            rays=rays,
            progress=report,
        )
    if not quiet:
        typer.echo(f"Wrote {output}")
