"""``pdtheory point``: what a direction field says about one point."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path
from typing import Annotated

import typer

from pdtheory.cli.options import check_target, parse_orders
from pdtheory.errors import InputError


def point(
    field: Annotated[
        Path,
        typer.Argument(
            metavar="FIELD",
            help="Direction field (NPZ, or the folder of a run).",
            show_default=False,
        ),
    ],
    index: Annotated[
        int,
        typer.Argument(metavar="INDEX", help="Number of the point, from 0.", show_default=False),
    ],
    plot: Annotated[
        Path | None,
        typer.Option(help="Draw g_k of every order in polar form: .png, .svg or .pdf."),
    ] = None,
    orders: Annotated[
        str | None, typer.Option(help="Orders to show, such as 2,3; all if left out.")
    ] = None,
    as_json: Annotated[bool, typer.Option("--json", help="Print JSON instead of a table.")] = False,
) -> None:
    """Print the directions at one point of FIELD with their errors, and plot them.

    Angles run from t1 towards t2 in degrees; lambda = k! g_k has the unit length^(1-k). What
    follows the sign is one standard deviation. A number is undetermined where that says nothing.

    Example: pdtheory point field.npz 1234 --plot point.png
    """
    from pdtheory.io.write import read_field
    from pdtheory.plots.polar import SUFFIXES

    if plot is not None:
        check_target(plot, SUFFIXES, field)
    wanted = None if orders is None else parse_orders(orders)
    if index < 0:
        raise InputError(f"there is no point {index}; points are counted from 0.")
    if field.is_dir():
        from pdtheory.pointset.parts import load_points

        some, row = load_points(field, [index]), 0
    else:
        some, row = read_field(field), index
    found = replace((some.only(wanted) if wanted else some).at(row), index=index)
    if plot is not None:
        found.plot(plot)
    if as_json:
        typer.echo(json.dumps(found.to_dict(), indent=2))
        return
    typer.echo(str(found))
    if plot is not None:
        typer.echo(f"Wrote {plot}")
