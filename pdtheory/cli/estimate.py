"""``pdtheory estimate``: directions at every point of a file."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from enum import StrEnum
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Literal, TypeVar

import typer

from pdtheory.cli.options import check_target, parse_orders, progress_bar, refuse_given
from pdtheory.conventions import DEFAULT_DEGREE
from pdtheory.errors import InputError

if TYPE_CHECKING:
    from rich.table import Table

    from pdtheory.pointset import PointCloud
    from pdtheory.pointset.cloud import IntArray
    from pdtheory.pointset.options import Options
    from pdtheory.pointset.summary import OrderSummary

N = TypeVar("N")

#: Neighbours per unknown of the regression when no neighbourhood is asked for.
NEIGHBOURS_PER_UNKNOWN = 4


class Norm(StrEnum):
    """The norm that the regression minimises."""

    L2 = "l2"
    L1 = "l1"


def estimate(
    context: typer.Context,
    source: Annotated[
        Path, typer.Argument(metavar="INPUT", help="A mesh or a point cloud.", show_default=False)
    ],
    output: Annotated[
        list[Path],
        typer.Option(
            "--output",
            "-o",
            metavar="PATH",
            help="Where to write: .npz (complete), .ply, .vtp or .csv, several times if wanted; or "
            "one name without suffix, a folder for clouds whose results exceed the memory.",
            show_default=False,
        ),
    ],
    radius: Annotated[
        str | None,
        typer.Option(
            help="Neighbourhood radius R in the units of the file; several, as 0.1,0.2, or auto to "
            "choose at each point.",
        ),
    ] = None,
    neighbours: Annotated[
        int | None, typer.Option(help="Choose R at each point so that it holds this many points.")
    ] = None,
    radius_relative: Annotated[
        float | None, typer.Option(help="R as a fraction of the bounding-box diagonal.")
    ] = None,
    degree: Annotated[
        str, typer.Option(help="Degree K of the regression, or auto to choose at each point.")
    ] = str(DEFAULT_DEGREE),
    orders: Annotated[str, typer.Option(help="Orders to compute, as 2,3,4 or 2:7.")] = "2,3",
    orient: Annotated[
        str,
        typer.Option(
            help="Side of the normals, which decides what is a maximum: auto, normals, winding, "
            "propagate, none, or a viewpoint x,y,z that they look to.",
        ),
    ] = "auto",
    norm: Annotated[Norm, typer.Option(help="l1 resists outliers, l2 is faster.")] = Norm.L2,
    samples: Annotated[
        int | None,
        typer.Option(help="Sample the surface by area with this many points first."),
    ] = None,
    seed: Annotated[int, typer.Option(help="Seed of the samples.", min=0)] = 0,
    threads: Annotated[
        int | None, typer.Option(help="Threads to use; all processors by default.")
    ] = None,
    resume: Annotated[
        bool, typer.Option("--resume", help="Go on with the folder of a run that was stopped.")
    ] = False,
    quiet: Annotated[bool, typer.Option("--quiet", "-q", help="Print nothing.")] = False,
) -> None:
    """Estimate the principal directions of several orders at every point of INPUT.

    Mesh vertices are used as the points unless --samples is given. Without a neighbourhood option
    each point takes four neighbours for every unknown of the regression.

    Example: pdtheory estimate scan.ply -o field.npz --neighbours 80 --degree 6 --orders 2,3,4
    """
    from pdtheory.io import read_cloud
    from pdtheory.io.write import FIELD_SUFFIXES

    # In the tangent frame there is no term of order 1.
    wanted = parse_orders(orders, smallest=2)
    if samples is None:
        refuse_given(
            context, ("seed",), "does nothing without --samples; give both, or leave it out."
        )
    folder = _folder(output, resume)
    for target in output if folder is None else ():
        check_target(target, FIELD_SUFFIXES, source)
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

    cloud = read_cloud(source, samples=samples, seed=seed)
    degrees = _number_or_auto(degree, "--degree", int)
    if not chosen:
        unknowns = (DEFAULT_DEGREE + 1) * (DEFAULT_DEGREE + 2) // 2
        if not isinstance(degrees, str):
            unknowns = (degrees + 1) * (degrees + 2) // 2
        neighbours = NEIGHBOURS_PER_UNKNOWN * unknowns
    options: Options = {
        "radius": _radius(radius),
        "neighbours": neighbours,
        "radius_relative": radius_relative,
        "degree": degrees,
        "orders": wanted,
        "orient": _orient(orient),
        "norm": norm.value,
        "threads": threads,
    }
    if folder is None:
        _to_files(cloud, output, source, options, quiet)
    else:
        _to_folder(cloud, folder, source, options, resume, quiet)


def _folder(output: list[Path], resume: bool) -> Path | None:
    """Return the folder if the results go to one."""
    from pdtheory.io.write import FIELD_SUFFIXES
    from pdtheory.pointset.parts import check_parent, holds_run

    for target in output:
        # An empty name means the current folder, and Python sees no suffix in a mere ".npz".
        if target.name.lower() in ("", *FIELD_SUFFIXES):
            raise InputError(
                f"the output {str(target)!r} has no name; give a file such as field.npz, or a "
                "folder by its name."
            )
    folders = [target for target in output if not target.suffix or target.is_dir()]
    if not folders:
        if resume:
            raise InputError(
                f"--resume goes on with a folder, and {output[0]} is a file; give the folder of "
                "the run."
            )
        return None
    if len(output) > 1:
        raise InputError(f"the folder {folders[0]} must be the only output; leave the others out.")
    folder = folders[0]
    check_parent(folder)
    if folder.is_dir() and not holds_run(folder):
        # Hidden files are those of the system, or what a run that was killed was writing.
        strangers = sorted(p.name for p in folder.iterdir() if not p.name.startswith("."))
        if strangers:
            raise InputError(
                f"{folder} holds other files, such as {strangers[0]}; give a new or empty folder."
            )
    return folder


def _number_or_auto(text: str, name: str, kind: Callable[[str], N]) -> N | Literal["auto"]:
    """Read a number or the word auto."""
    if text == "auto":
        return "auto"
    try:
        return kind(text)
    except ValueError:
        raise InputError(f"cannot read {name} {text!r}; give a number or auto.") from None


def _radius(text: str | None) -> float | list[float] | Literal["auto"] | None:
    """Read a radius, several with commas between them, or the word auto."""
    if text is None:
        return None
    if "," not in text:
        return _number_or_auto(text, "--radius", float)
    try:
        return [float(part) for part in text.split(",")]
    except ValueError:
        raise InputError(f"cannot read --radius {text!r}; write several as 0.1,0.2,0.4.") from None


def _orient(text: str) -> str | list[float]:
    """Read a way to orient normals: a word, or a viewpoint as three numbers."""
    if "," not in text:
        return text
    try:
        return [float(part) for part in text.split(",")]
    except ValueError:
        raise InputError(f"cannot read --orient {text!r}; write a viewpoint as x,y,z.") from None


def _to_files(
    cloud: PointCloud, output: list[Path], source: Path, options: Options, quiet: bool
) -> None:
    """Estimate in memory and write every file asked for."""
    from pdtheory.io import write_field
    from pdtheory.pointset import estimate_directions

    with progress_bar("Reading", quiet=quiet) as report:
        options["progress"] = report
        field = estimate_directions(cloud, **options)
        _refuse_empty(field.status, field.degree, cloud, source, options)
    for target in output:
        write_field(field, target)
    if quiet:
        return
    from pdtheory.pointset.summary import order_summaries

    _print_summary(field.status, order_summaries(field), [f"Wrote {path}" for path in output])


def _to_folder(
    cloud: PointCloud, folder: Path, source: Path, options: Options, resume: bool, quiet: bool
) -> None:
    """Estimate part by part into a folder."""
    from pdtheory.pointset import estimate_to_disk
    from pdtheory.pointset.parts import discard_run, load_column
    from pdtheory.pointset.summary import run_summaries

    created = not folder.exists()
    with progress_bar("Reading", quiet=quiet) as report:
        options["progress"] = report
        parts = estimate_to_disk(cloud, folder, resume=resume, **options)
        status = load_column(folder, "status")
        try:
            _refuse_empty(status, load_column(folder, "degree"), cloud, source, options)
        except InputError:
            discard_run(folder, created=created)
            raise
    if quiet:
        return
    wrote = f"Wrote {parts} {'parts' if parts > 1 else 'part'} to {folder}"
    _print_summary(status, run_summaries(folder), [wrote])


def _print_summary(status: IntArray, rows: list[OrderSummary], wrote: list[str]) -> None:
    """Print what was found, what is wrong with it, and where it is."""
    from rich.console import Console

    from pdtheory.pointset.summary import status_sentences

    console = Console(highlight=False)
    console.print(summary_table(len(status), rows))
    for sentence in (*status_sentences(status), *wrote):
        console.print(sentence, markup=False, soft_wrap=True)


def _refuse_empty(
    status: IntArray, degree: IntArray, cloud: PointCloud, source: Path, options: Options
) -> None:
    """Refuse a result without any direction: nobody wants a file of NaN."""
    from pdtheory.conventions import UNANSWERED
    from pdtheory.pointset.summary import status_sentences

    if not ((status & int(UNANSWERED)) == 0).any():
        _, *reasons = status_sentences(status)
        raise InputError(
            f"none of the {len(status):,} points of {source} could be answered: {' '.join(reasons)}"
        )
    best = int(degree.max())
    if best < min(options["orders"]):
        more = "" if cloud.faces is None else " (--samples puts some on a mesh)"
        raise InputError(
            f"the neighbours bear no fit of more than degree {best} at any of the {len(status):,} "
            f"points of {source}, and so no direction of the orders asked for; enlarge the "
            f"neighbourhood, or give more points{more}."
        )


def summary_table(points: int, rows: Iterable[OrderSummary]) -> Table:
    """Return a table with the number of directions and the median strength of every order."""
    from rich.table import Table

    from pdtheory.pointset.summary import HEADINGS

    table = Table(title=f"Principal directions at {points:,} points")
    for heading in HEADINGS:
        table.add_column(heading, justify="right")
    for row in rows:
        table.add_row(*row.cells)
    return table
