"""``pdtheory verify``: recompute the paper, statement by statement."""

from __future__ import annotations

import json as json_module
import re
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from pdtheory.cli.options import check_target, parse_orders, progress_bar

if TYPE_CHECKING:
    from rich.console import Console
    from rich.table import Table

    from pdtheory.paper.claims import Result


def verify(
    ids: Annotated[
        list[str] | None,
        typer.Argument(metavar="ID", help="Claims to check; all of them if none is named."),
    ] = None,
    orders: Annotated[
        str, typer.Option(help="Orders for steps that reach only a bound, as 2:12 or 3,5,8.")
    ] = "2:12",
    json: Annotated[
        bool, typer.Option("--json", help="Print verdicts and certificates as JSON.")
    ] = False,
    report: Annotated[
        Path | None,
        typer.Option(help="Write a report: .html (one file), .md or .tex.", show_default=False),
    ] = None,
    quiet: Annotated[bool, typer.Option("--quiet", "-q", help="No progress bar.")] = False,
) -> None:
    """Check every statement of the paper: proved, refuted, misprint, ... with certificates.

    The exit code is 1 if any verdict comes out differently from the recorded one.

    Example: pdtheory verify krosy-iff --report rosy.html
    """
    wanted = parse_orders(orders, smallest=2)
    if report is not None:
        check_target(report, (".html", ".md", ".tex"))

    from pdtheory.paper.claims import CLAIMS, run_claims, select
    from pdtheory.paper.report import check_requirements, write_report

    chosen = [claim.id for claim in select(CLAIMS, ids or ())]
    if report is not None:
        check_requirements(report)
    with progress_bar("Checking", quiet=quiet) as progress:
        results = list(run_claims(chosen, wanted, progress))
    if json:
        typer.echo(json_module.dumps([result.as_json() for result in results], indent=2))
    else:
        from rich.console import Console

        _print(Console(highlight=False), results, certificates=bool(ids))
    if report is not None:
        written = write_report(results, report)
        if not json:
            typer.echo(f"Wrote {written[0]}")
    if not all(result.holds for result in results):
        raise typer.Exit(1)


def _print(console: Console, results: list[Result], *, certificates: bool) -> None:
    from pdtheory.paper.claims.plain import plain_text

    console.print(_table(results))
    for result in results if certificates else ():
        _print_certificate(console, result)
    failed = [result for result in results if not result.holds]
    for result in failed:
        console.print(f"\n{result.claim.id}: recorded as {result.claim.verdict}, but:")
        for step in result.steps:
            if not step.holds:
                text = plain_text(step.text)
                console.print(f"  this {step.shows} does not hold: {text}", markup=False)
        if all(step.holds for step in result.steps):
            console.print(f"  its steps show: {result.verdict}")
    steps = sum(len(result.steps) for result in results)
    console.print(
        f"{len(results) - len(failed)} of {len(results)} claims come out as recorded "
        f"({steps} certified steps)."
    )


def _print_certificate(console: Console, result: Result) -> None:
    """Print what a claim says and every step of its certificate."""
    from rich.padding import Padding
    from rich.text import Text

    from pdtheory.paper.claims.plain import plain_text

    claim = result.claim
    console.print(f"\n[bold]{claim.id}[/bold] ({claim.place})")
    if claim.printed:
        console.print(Padding(Text(f"Printed: {plain_text(claim.printed)}"), (0, 0, 0, 2)))
    console.print(Padding(Text(f"True: {plain_text(claim.statement)}"), (0, 0, 0, 2)))
    for number, step in enumerate(result.steps, start=1):
        sign = "" if step.holds else " - DOES NOT HOLD"
        line = f"{number}. {step.shows}{sign}: {plain_text(step.text)}"
        console.print(Padding(Text(line), (0, 0, 0, 2)))
        for name, value in step.data.items():
            console.print(Padding(Text(f"{name}: {value}", style="dim"), (0, 0, 0, 5)))
    console.print()


def _table(results: list[Result]) -> Table:
    from rich.table import Table

    table = Table(title="The paper, checked", box=None, padding=(0, 1, 0, 0))
    table.add_column("sec.", justify="right")
    table.add_column("claim", no_wrap=True)
    table.add_column("verdict", min_width=len("configuration-dependent"))
    table.add_column("scope", no_wrap=True)
    table.add_column("holds")
    for result in results:
        section = re.search(r"(?:Section|Definition) (\d)", result.claim.place)
        table.add_row(
            section.group(1) if section else "-",
            result.claim.id,
            result.verdict.value,
            result.scope,
            "[green]yes[/green]" if result.holds else "[red]NO[/red]",
        )
    return table
