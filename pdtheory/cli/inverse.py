"""The command ``pdtheory inverse``: rows with given directions."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Annotated, Any

import typer

from pdtheory.errors import InputError

if TYPE_CHECKING:
    from pdtheory.exact import WavejetsRow


def inverse(
    order: Annotated[int, typer.Option("--order", help="The order k.")],
    maxima: Annotated[
        str | None, typer.Option("--maxima", help="All maxima on the circle, in degrees.")
    ] = None,
    critical: Annotated[
        str | None,
        typer.Option("--critical", help="Lines that shall be E-eigenvectors, in degrees."),
    ] = None,
    digits: Annotated[int, typer.Option("--digits", help="Significant digits in the table.")] = 12,
    as_json: Annotated[bool, typer.Option("--json", help="Print JSON instead.")] = False,
) -> None:
    """Find the Wavejets rows that have given directions, or say why there is none.

    Example: pdtheory inverse --order 3 --maxima 0,110,250

    Example: pdtheory inverse --order 4 --critical 0,30
    """
    from pdtheory.cli.eigen import check_digits

    check_digits(digits)
    if (maxima is None) == (critical is None):
        raise InputError("Give either --maxima or --critical with its angles in degrees.")
    if maxima is not None:
        _realize(order, _angles(maxima), digits, as_json)
    else:
        _family(order, _angles(critical or ""), digits, as_json)


def _realize(order: int, angles: list[Any], digits: int, as_json: bool) -> None:
    from pdtheory.cli.eigen import print_order
    from pdtheory.exact.inverse import realize_maxima
    from pdtheory.exact.report import order_report

    found = realize_maxima(order, angles)
    pairs = None if found.row is None else found.row.eigenpairs()
    if as_json:
        data: dict[str, Any] = {"realizable": found.is_realizable, "reason": found.reason}
        if found.row is not None and pairs is not None:
            data["exact_wavejets"] = _texts(found.row)
            data["orders"] = {str(order): order_report(pairs)}
        typer.echo(json.dumps(data, indent=2))
        return
    verdict = "Realizable" if found.is_realizable else "Not realizable"
    typer.echo(f"{verdict}: {found.reason}.")
    if found.row is not None and pairs is not None:
        for n, text in _texts(found.row).items():
            typer.echo(f"phi_{n} = {text}")
        print_order(pairs, digits)


def _family(order: int, angles: list[Any], digits: int, as_json: bool) -> None:
    from pdtheory.exact.inverse import rows_with_critical_lines

    rows = rows_with_critical_lines(order, angles)
    if as_json:
        basis = [
            {
                "exact_wavejets": _texts(row),
                "wavejets": {str(n): [v.real, v.imag] for n, v in row.to_complex().items()},
            }
            for row in rows
        ]
        typer.echo(json.dumps({"order": order, "dimension": len(rows), "basis": basis}, indent=2))
        return
    typer.echo(f"The rows of order {order} with these lines form a space of dimension {len(rows)}.")
    for i, row in enumerate(rows, start=1):
        values = ", ".join(f"phi_{n} = {_number(v, digits)}" for n, v in row.to_complex().items())
        typer.echo(f"{i}: {values}")


def _texts(row: WavejetsRow) -> dict[str, str]:
    return {str(n): str(value) for n, value in row.phi.items()}


def _number(value: complex, digits: int) -> str:
    return f"{value.real:.{digits}g}{value.imag:+.{digits}g}i"


def _angles(text: str) -> list[Any]:
    from pdtheory.exact.expression import parse_expression

    return [parse_expression(part, variables=()) for part in text.split(",")]
