"""``pdtheory estimate``: directions at every point of a file."""

from __future__ import annotations

from enum import StrEnum
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from pdtheory.cli.options import check_target, parse_orders, progress_bar
from pdtheory.conventions import DEFAULT_DEGREE
from pdtheory.errors import InputError

if TYPE_CHECKING:
    from rich.table import Table

    from pdtheory.pointset import DirectionField

#: Files that `pdtheory.io.write_field` makes.
FIELD_SUFFIXES = (".npz", ".ply", ".vtp", ".csv")

#: Neighbours per unknown of the regression when no neighbourhood is asked for.
NEIGHBOURS_PER_UNKNOWN = 4


class Norm(StrEnum):
    """The norm that the regression minimises."""

    L2 = "l2"
    L1 = "l1"


def estimate(
    source: Annotated[
        Path, typer.Argument(metavar="INPUT", help="A mesh or a point cloud.", show_default=False)
    ],
    output: Annotated[
        list[Path],
        typer.Option(
            "--output",
            "-o",
            help="Where to write: .npz (complete), .ply, .vtp or .csv; may be given several times.",
            show_default=False,
        ),
    ],
    radius: Annotated[
        float | None, typer.Option(help="Neighbourhood radius R in the units of the file.")
    ] = None,
    neighbours: Annotated[
        int | None, typer.Option(help="Choose R at each point so that it holds this many points.")
    ] = None,
    radius_relative: Annotated[
        float | None, typer.Option(help="R as a fraction of the bounding-box diagonal.")
    ] = None,
    degree: Annotated[int, typer.Option(help="Degree K of the regression.")] = DEFAULT_DEGREE,
    orders: Annotated[str, typer.Option(help="Orders to compute, as 2,3,4 or 2:7.")] = "2,3",
    norm: Annotated[Norm, typer.Option(help="l1 resists outliers, l2 is faster.")] = Norm.L2,
    samples: Annotated[
        int | None,
        typer.Option(help="Sample the surface by area with this many points first."),
    ] = None,
    seed: Annotated[int, typer.Option(help="Seed of the samples.")] = 0,
    threads: Annotated[
        int | None, typer.Option(help="Threads to use; all processors by default.")
    ] = None,
    quiet: Annotated[bool, typer.Option("--quiet", "-q", help="Print nothing.")] = False,
) -> None:
    """Estimate the principal directions of several orders at every point of INPUT.

    Mesh vertices are used as the points unless --samples is given. Without a neighbourhood option
    each point takes four neighbours for every unknown of the regression.

    Example: pdtheory estimate scan.ply -o field.npz --neighbours 80 --degree 6 --orders 2,3,4
    """
    wanted = parse_orders(orders)
    for target in output:
        check_target(target, FIELD_SUFFIXES)
    chosen = [
        name
        for name, value in (
            ("--radius", radius),
            ("--neighbours", neighbours),
            ("--radius-relative", radius_relative),
        )
        if value is not None
    ]
    if len(chosen) > 1:
        raise InputError(f"{' and '.join(chosen)} exclude each other; give one of them.")

    from pdtheory.io import read_cloud, write_field
    from pdtheory.pointset import estimate_directions

    cloud = read_cloud(source, samples=samples, seed=seed)
    if not chosen:
        neighbours = NEIGHBOURS_PER_UNKNOWN * (degree + 1) * (degree + 2) // 2
    with progress_bar("Reading", quiet=quiet) as report:
        field = estimate_directions(
            cloud,
            radius=radius,
            neighbours=neighbours,
            radius_relative=radius_relative,
            degree=degree,
            orders=wanted,
            norm=norm.value,
            threads=threads,
            progress=report,
        )
    _refuse_empty(field, source)
    for target in output:
        write_field(field, target)
    if not quiet:
        from rich.console import Console

        from pdtheory.pointset.summary import status_sentences

        console = Console()
        console.print(summary_table(field))
        for sentence in status_sentences(field):
            console.print(sentence, highlight=False)
        for target in output:
            console.print(f"Wrote {target}", highlight=False, soft_wrap=True)


def _refuse_empty(field: DirectionField, source: Path) -> None:
    """Refuse a result in which no point has an answer: nobody wants a file of NaN."""
    if field.answered.any():
        return
    from pdtheory.pointset.summary import status_sentences

    _, *reasons = status_sentences(field)
    raise InputError(
        f"none of the {len(field):,} points of {source} could be answered: {' '.join(reasons)}"
    )


def summary_table(field: DirectionField) -> Table:
    """Return a table with the number of directions and the median strength of every order."""
    from math import isfinite

    from rich.table import Table

    from pdtheory.pointset.summary import order_summaries

    table = Table(title=f"Principal directions at {len(field):,} points")
    for heading in ("order", "maxima", "minima", "median strength", "median std (degrees)"):
        table.add_column(heading, justify="right")
    for row in order_summaries(field):
        medians = (
            f"{value:.3g}" if isfinite(value) else "-" for value in (row.strength, row.angle_std)
        )
        table.add_row(str(row.order), f"{row.maxima:,}", f"{row.minima:,}", *medians)
    return table
