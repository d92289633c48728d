"""``pdtheory sample`` and ``pdtheory surfaces``: the synthetic surfaces from the command line."""

from __future__ import annotations

from enum import StrEnum
from pathlib import Path
from typing import Annotated

import typer

from pdtheory.errors import FileAccessError, InputError


class Method(StrEnum):
    """How points are placed."""

    area = "area"
    blue = "blue"
    grid = "grid"


class Along(StrEnum):
    """Which way noise moves them."""

    normal = "normal"
    position = "position"


def sample(
    context: typer.Context,
    surface: Annotated[
        str, typer.Argument(metavar="SURFACE", help="Name of the surface; see pdtheory surfaces.")
    ],
    output: Annotated[
        Path, typer.Option("--output", "-o", help="File to write: .ply .xyz .txt .csv (.obj .stl).")
    ],
    samples: Annotated[int, typer.Option("--samples", "-n", help="Number of points.")] = 20_000,
    noise: Annotated[
        float, typer.Option(help="Gaussian noise, in percent of the diagonal of the bounding box.")
    ] = 0.0,
    noise_along: Annotated[
        Along, typer.Option(help="Noise along the normal, or in all coordinates.")
    ] = Along.normal,
    outliers: Annotated[float, typer.Option(help="Share of outliers, 0 to below 1.")] = 0.0,
    method: Annotated[
        Method, typer.Option(help="Random by area, evenly spread (blue noise), or a grid.")
    ] = Method.area,
    seed: Annotated[int, typer.Option(help="Seed of all random numbers.", min=0)] = 0,
    parameter: Annotated[
        list[str] | None,
        typer.Option("--parameter", "-p", metavar="NAME=VALUE", help="A parameter; several times."),
    ] = None,
    resolution: Annotated[
        int | None,
        typer.Option(help="Write a triangle mesh with so many cells along a side, not samples."),
    ] = None,
) -> None:
    """Sample a synthetic surface.

    Example: pdtheory sample torus -p minor=0.3 -n 50000 --noise 0.05 -o torus.ply
    """
    import synthetic_surfaces
    from pdtheory.cli.options import check_target, refuse_given
    from pdtheory.io import write_cloud
    from pdtheory.io.write import CLOUD_SUFFIXES

    check_target(output, CLOUD_SUFFIXES)
    if resolution is not None:
        refuse_given(
            context,
            ("samples", "noise", "noise_along", "outliers", "method", "seed"),
            "does nothing where --resolution asks for a mesh; leave one of them out.",
        )
    shape = synthetic_surfaces.get(surface, **_parameters(parameter or []))
    if resolution is not None:
        cloud = shape.mesh(resolution)
    else:
        cloud = shape.sample(
            samples,
            method=method.value,
            noise=noise,
            noise_along=noise_along.value,
            outliers=outliers,
            seed=seed,
        )
    write_cloud(cloud, output)
    typer.echo(f"{output}: {len(cloud)} points of {surface}, {shape.describe()}")


def surfaces(
    name: Annotated[
        str | None, typer.Argument(metavar="NAME", help="Tell about one surface only.")
    ] = None,
    thumbnails: Annotated[
        Path | None,
        typer.Option(help="Folder for a small picture of each (needs the extra blender)."),
    ] = None,
) -> None:
    """List the synthetic surfaces and their parameters.

    Example: pdtheory surfaces torus --thumbnails pictures
    """
    from rich.console import Console
    from rich.table import Table

    import synthetic_surfaces

    chosen = synthetic_surfaces.names() if name is None else (name,)
    table = Table("name", "parameters (default, range)", "surface", show_lines=True)
    for each in chosen:
        shape = synthetic_surfaces.get(each)
        rows = [parameter.summary for parameter in shape.parameters]
        table.add_row(each, "\n".join(rows), f"{shape.summary}\n{shape.describe()}")
    Console(markup=False).print(table)
    if thumbnails is not None:
        _draw_thumbnails(chosen, thumbnails)


def _draw_thumbnails(names: tuple[str, ...], folder: Path) -> None:
    """Render a small picture of each surface into a folder, which is made if needed."""
    import synthetic_surfaces
    from pdtheory.cli.options import progress_bar
    from pdtheory.paper.figures.stage import Panel, render

    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise FileAccessError(f"cannot make the folder {folder}: {error.strerror}.") from error
    with progress_bar("thumbnails") as report:
        for index, name in enumerate(names):
            report(index / len(names), name)
            panel = Panel(synthetic_surfaces.get(name).mesh(64), [], azimuth=20, elevation=35)
            render(panel, folder / f"{name}.png", (320, 240), 16)


def _parameters(pairs: list[str]) -> dict[str, str]:
    values = {}
    for pair in pairs:
        name, equals, value = pair.partition("=")
        if not equals or not name.strip():
            raise InputError(f"cannot read the parameter {pair!r}; write name=value.")
        values[name.strip()] = value
    return values
