"""``pdtheory figure``: the figures of the paper, drawn again and checked."""

from __future__ import annotations

from enum import StrEnum
from pathlib import Path
from typing import Annotated

import typer


class Quality(StrEnum):
    """How much work goes into a picture."""

    small = "small"
    draft = "draft"
    paper = "paper"


def figure(
    name: Annotated[
        str | None,
        typer.Argument(metavar="NAME|all", help="Name of the figure; without one, list them."),
    ] = None,
    output: Annotated[
        Path, typer.Option("--output", "-o", help="Folder for pictures and numbers.")
    ] = Path("figures"),
    quality: Annotated[
        Quality, typer.Option(help="small for tests, draft in seconds, paper in minutes.")
    ] = Quality.draft,
    models: Annotated[
        Path | None, typer.Option(help="Folder with scans (armadillo, fandisk, igea, rocker-arm).")
    ] = None,
    data_only: Annotated[bool, typer.Option("--data-only", help="Compute and check only.")] = False,
    seed: Annotated[int, typer.Option(help="Seed of all random numbers.", min=0)] = 0,
    quiet: Annotated[bool, typer.Option("--quiet", "-q", help="No progress bar.")] = False,
) -> None:
    """Redraw figures of the paper from data, with a check of numbers for each.

    The exit code is 1 if a check fails.

    Example: pdtheory figure all --quality draft --models ~/scans -o figures
    """
    from pdtheory.cli.options import progress_bar
    from pdtheory.errors import FileAccessError
    from pdtheory.paper.figures import catalogue
    from pdtheory.paper.figures.index import write_index
    from pdtheory.paper.figures.outcome import Job
    from pdtheory.paper.figures.run import Made, make

    if name is None:
        for known in catalogue.NAMES:
            typer.echo(f"{known:<15} {catalogue.get(known).redraws}")
        return
    names = catalogue.NAMES if name == "all" else (name,)
    for wanted in names:
        catalogue.get(wanted)
    if models is not None and not models.is_dir():
        raise FileAccessError(f"there is no folder {models}; give one with scans in it.")
    made: list[Made] = []
    with progress_bar("figures", quiet=quiet) as report:

        def step(fraction: float, text: str) -> None:
            report((len(made) + fraction) / len(names), text)

        job = Job(quality.value, models, seed, step)
        for each in make(names, job, output, data_only=data_only):
            made.append(each)
            step(0.0, each.figure.name)
    for each in made:
        if each.outcome is None:
            typer.echo(f"{each.figure.name}: skipped, {each.skipped}")
            continue
        typer.echo(f"{each.figure.name}: {each.seconds:.0f} s")
        for check in each.outcome.checks:
            typer.echo(f"  {check}")
        for path in each.pictures[:1]:
            typer.echo(f"  {path}")
    if name == "all":
        typer.echo(str(write_index(made, job, output)))
    if not all(each.holds for each in made):
        raise typer.Exit(1)
