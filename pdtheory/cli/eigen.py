"""The command ``pdtheory eigen``: exact principal directions of a formula."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Annotated, Any

import typer

from pdtheory.errors import InputError

if TYPE_CHECKING:
    from rich.table import Table

    from pdtheory.exact import EigenPairs

#: Bounds on the digits that are printed.
MOST_DIGITS = 10_000


def eigen(
    expression: Annotated[
        str, typer.Argument(help="Formula in x and y, such as 'x**3 - 3*x*y**2'.")
    ],
    order: Annotated[
        int | None, typer.Option("--order", help="One order k; all that do not vanish if left out.")
    ] = None,
    max_order: Annotated[
        int, typer.Option("--max-order", help="Largest order listed if it is no polynomial.")
    ] = 8,
    digits: Annotated[int, typer.Option("--digits", help="Significant digits in the table.")] = 12,
    as_json: Annotated[bool, typer.Option("--json", help="Print JSON instead of tables.")] = False,
) -> None:
    """Print all E-eigenpairs of the differential tensors T_k of a formula, exactly.

    The eigenvalue is lambda = T_k v^k = k! g_k, the angle runs from the x axis.

    Example: pdtheory eigen "x**3 - 3*x*y**2" --digits 30
    """
    import sympy as sp

    from pdtheory.exact.eigenpairs import real_eigenpairs
    from pdtheory.exact.expression import parse_expression
    from pdtheory.exact.report import orders_of, report

    check_digits(digits)
    symbols = sp.Symbol("x"), sp.Symbol("y")
    formula = parse_expression(expression)
    forms = orders_of(formula, symbols, order=order, max_order=max_order)
    if as_json:
        typer.echo(json.dumps(report(forms), indent=2))
        return
    for form in forms:
        print_order(real_eigenpairs(form), digits)


def print_order(pairs: EigenPairs, digits: int = 12) -> None:
    """Print one order: its form, its Wavejets row, and the table of pairs."""
    from rich.console import Console

    from pdtheory.exact.report import short

    console = Console(highlight=False)
    # Digits that were asked for are never cut: a narrow terminal wraps the lines itself.
    console.width = max(console.width, 2 * digits + 56)
    console.print(
        f"[bold]Order {pairs.order}[/]  T v^{pairs.order} = {short(pairs.form.expression)}"
    )
    row = ", ".join(f"phi_{n} = {short(value, 40)}" for n, value in pairs.form.row.phi.items())
    console.print(f"Wavejets row: {row}")
    if pairs.status == "ok":
        console.print(eigen_table(pairs.order, pairs, digits))
    elif pairs.status == "isotropic":
        console.print(
            "Isotropic: every unit vector is an E-eigenvector, lambda = "
            f"{short(pairs.isotropic_eigenvalue)}."
        )
    else:
        console.print("This order vanishes.")


def eigen_table(order: int, pairs: EigenPairs, digits: int = 12) -> Table:
    """Return the table of all real E-eigenpairs of one order.

    Parameters
    ----------
    order
        The order k, for the title.
    pairs
        The pairs.
    digits
        Significant digits of angle and eigenvalue.
    """
    from rich.table import Table
    from rich.text import Text

    table = Table(title=f"Real E-eigenpairs of order {order}")
    table.add_column("theta (deg)", justify="right", no_wrap=True, min_width=digits)
    table.add_column("lambda", justify="right", no_wrap=True, min_width=digits)
    table.add_column("kind")
    table.add_column("mult.", justify="right")
    table.add_column("exact", overflow="fold")
    for pair in pairs:
        table.add_row(
            Text(_number(pair.angle_degrees(digits))),
            Text(_number(pair.eigenvalue_float(digits))),
            pair.kind.label,
            str(pair.multiplicity),
            Text(pair.exact_text),
        )
    return table


def _number(value: Any) -> str:
    text = str(value)
    mantissa, exponent, power = text.partition("e")
    if "." in mantissa:
        mantissa = mantissa.rstrip("0").rstrip(".")
    return mantissa + exponent + power


def check_digits(digits: int) -> None:
    """Refuse a number of digits that is not positive or too large."""
    if not 1 <= digits <= MOST_DIGITS:
        raise InputError(f"--digits is {digits}; it must be from 1 to {MOST_DIGITS}.")
