"""The command ``pdtheory eigen``: exact principal directions of a formula."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Annotated, Any

import typer

from pdtheory.errors import InputError

if TYPE_CHECKING:
    from rich.table import Table

    from pdtheory.exact import BinaryForm, EigenPairs

#: Bounds on the digits that are printed.
MOST_DIGITS = 10_000


def eigen(
    expression: Annotated[
        str | None,
        typer.Argument(metavar="FORMULA", help="Formula in x and y, such as 'x**3 - 3*x*y**2'."),
    ] = None,
    order: Annotated[
        int | None, typer.Option("--order", help="One order k; all that do not vanish if left out.")
    ] = None,
    max_order: Annotated[
        int, typer.Option("--max-order", help="Largest order listed if it is no polynomial.")
    ] = 8,
    at: Annotated[
        str | None,
        typer.Option("--at", help="Point of expansion X,Y, or X,Y,Z on an implicit surface."),
    ] = None,
    implicit: Annotated[
        str | None,
        typer.Option(
            "--implicit", help="Surface F(x,y,z) = 0 over its tangent plane at --at, as its F."
        ),
    ] = None,
    complex_pairs: Annotated[
        bool, typer.Option("--complex", help="List the complex E-eigenpairs too.")
    ] = False,
    characteristic: Annotated[
        bool, typer.Option("--characteristic", help="Give the E-characteristic polynomial too.")
    ] = False,
    digits: Annotated[
        int, typer.Option("--digits", help="Significant digits in the table and in LaTeX.")
    ] = 12,
    as_latex: Annotated[bool, typer.Option("--latex", help="Print LaTeX instead.")] = False,
    as_json: Annotated[bool, typer.Option("--json", help="Print JSON instead of tables.")] = False,
) -> None:
    """Print all E-eigenpairs of the differential tensors T_k of a formula, exactly.

    The eigenvalue is lambda = T_k v^k = k! g_k, the angle runs from the x axis.

    Example: pdtheory eigen "x**3 - 3*x*y**2" --digits 30

    Example: pdtheory eigen --implicit "x**2 + y**2/4 + z**2/9 - 1" --at 1/3,4/3,2 --order 3
    """
    check_digits(digits)
    if as_latex and as_json:
        raise InputError("--latex and --json exclude each other; choose one.")
    if (expression is None) == (implicit is None):
        raise InputError("Give either a formula in x and y or --implicit with its F(x,y,z).")
    heading: dict[str, Any] = {}
    if implicit is None:
        forms = _explicit_forms(expression or "", order, max_order, at)
    else:
        forms, heading = _implicit_forms(implicit, order, max_order, at)
    if as_json:
        _print_json(forms, heading, complex_pairs, characteristic)
    elif as_latex:
        _print_latex(forms, complex_pairs, characteristic, digits)
    else:
        if heading:
            _print_frame(heading)
        for form in forms:
            print_order(form.eigenpairs(), digits)
            _print_more(form, complex_pairs, characteristic, digits)


def _explicit_forms(
    expression: str, order: int | None, max_order: int, at: str | None
) -> list[BinaryForm]:
    import sympy as sp

    from pdtheory.exact.expression import parse_expression
    from pdtheory.exact.report import orders_of

    x, y = sp.Symbol("x"), sp.Symbol("y")
    place = (sp.Integer(0), sp.Integer(0)) if at is None else _point(at, 2)
    formula = parse_expression(expression)
    return orders_of(formula, (x, y), order=order, max_order=max_order, at=place)


def _implicit_forms(
    implicit: str, order: int | None, max_order: int, at: str | None
) -> tuple[list[BinaryForm], dict[str, Any]]:
    import sympy as sp

    from pdtheory.exact.coefficients import check_order
    from pdtheory.exact.expression import parse_expression
    from pdtheory.exact.jets import implicit_jet

    if at is None:
        raise InputError("An implicit surface needs its point, as --at X,Y,Z.")
    names = ("x", "y", "z")
    surface = parse_expression(implicit, variables=names)
    degree = check_order(max_order if order is None else order, 1)
    jet = implicit_jet(surface, [sp.Symbol(n) for n in names], degree, _point(at, 3))
    heading = {
        "point": [str(c) for c in jet.point],
        "frame": [[str(c) for c in row] for row in jet.frame],
    }
    if order is not None:
        return [jet.form(order)], heading
    forms = [f for f in jet.forms[1:] if not f.is_zero]
    if not forms:
        raise InputError(f"The surface is flat at ({at}) up to order {degree}: no directions.")
    return forms, heading


def _print_frame(heading: dict[str, Any]) -> None:
    """Print where on a surface the orders are, and which way x, y and z go there."""
    typer.echo(f"At ({', '.join(heading['point'])}), in the frame")
    for name, axis in zip(("x", "y", "normal"), heading["frame"], strict=True):
        typer.echo(f"  {name:6} ({', '.join(axis)})")


def _point(text: str, count: int) -> tuple[Any, ...]:
    from pdtheory.exact.expression import parse_expression

    parts = text.split(",")
    if len(parts) != count:
        raise InputError(f"--at is {text!r}; it needs {count} coordinates separated by commas.")
    return tuple(parse_expression(part, variables=()) for part in parts)


def _print_json(
    forms: list[BinaryForm], heading: dict[str, Any], complex_pairs: bool, characteristic: bool
) -> None:
    from pdtheory.exact.report import characteristic_report, complex_report, report

    data = {**heading, **report(forms)}
    for form in forms:
        entry = data["orders"][str(form.order)]
        if complex_pairs:
            entry["complex"] = complex_report(form)
        if characteristic and form.order > 1:
            entry["characteristic"] = characteristic_report(form)
    typer.echo(json.dumps(data, indent=2))


def _print_latex(
    forms: list[BinaryForm], complex_pairs: bool, characteristic: bool, digits: int
) -> None:
    import sympy as sp

    from pdtheory.exact.characteristic import characteristic_polynomial
    from pdtheory.exact.report import latex_pairs

    if complex_pairs:
        raise InputError("--complex has no LaTeX; use --json.")
    for form in forms:
        typer.echo(rf"\[ {form.latex()} \]")
        typer.echo(rf"\[ {form.row.latex()} \]")
        typer.echo(latex_pairs(form.eigenpairs(), digits))
        if characteristic and form.order > 1:
            psi = characteristic_polynomial(form).polynomial.as_expr()
            typer.echo(rf"\[ \psi(\lambda) \sim {sp.latex(sp.factor(psi))} \]")


def _print_more(form: BinaryForm, complex_pairs: bool, characteristic: bool, digits: int) -> None:
    from rich.console import Console
    from rich.table import Table
    from rich.text import Text

    from pdtheory.exact.characteristic import characteristic_polynomial
    from pdtheory.exact.complexpairs import complex_eigenpairs

    console = Console(highlight=False)
    if complex_pairs:
        pairs = complex_eigenpairs(form)
        table = Table(title=f"Complex E-eigenpairs of order {form.order}, up to the sign of v")
        for heading in ("cos t", "sin t", "lambda", "mult."):
            table.add_column(heading, overflow="fold")
        for pair in pairs:
            cells = (*pair.vector(digits), pair.eigenvalue(digits))
            table.add_row(*(Text(str(c)) for c in cells), str(pair.multiplicity))
        console.print(table)
        if pairs.isotropic_multiplicity:
            console.print(
                f"Isotropic eigenvectors (1, +-i) of multiplicity {pairs.isotropic_multiplicity}."
            )
    if characteristic and form.order > 1:
        psi = characteristic_polynomial(form)
        if psi.is_irregular:
            console.print("psi(lambda) = 0: the tensor is irregular.")
        else:
            factors = " * ".join(
                f"({p.as_expr()})" + (f"**{m}" if m > 1 else "") for p, m in psi.factors()
            )
            console.print(Text(f"psi(lambda) ~ {factors}"))


def print_order(pairs: EigenPairs, digits: int = 12, *, rounded: bool = False) -> None:
    """Print one order: its form, its Wavejets row, and the table of pairs (:func:`eigen_table`)."""
    from rich.console import Console

    from pdtheory.exact.report import short_form, short_number

    console = Console(highlight=False)
    # Digits that were asked for are never cut: a narrow terminal wraps the lines itself.
    console.width = max(console.width, 2 * digits + 56)
    console.print(f"[bold]Order {pairs.order}[/]  T v^{pairs.order} = {short_form(pairs.form)}")
    row = ", ".join(
        f"phi_{n} = {short_number(*parts)}" for n, parts in pairs.form.row.parts.items()
    )
    console.print(f"Wavejets row: {row}")
    if pairs.status == "ok":
        console.print(eigen_table(pairs.order, pairs, digits, rounded=rounded))
    elif pairs.status == "isotropic":
        console.print(
            "Isotropic: every unit vector is an E-eigenvector, lambda = "
            f"{short_number(pairs.isotropic_eigenvalue)}."
        )
    else:
        console.print("This order vanishes.")


def eigen_table(order: int, pairs: EigenPairs, digits: int = 12, *, rounded: bool = False) -> Table:
    """Return the table of all real E-eigenpairs of one order.

    Parameters
    ----------
    order
        The order k, for the title.
    pairs
        The pairs.
    digits
        Significant digits of angle and eigenvalue.
    rounded
        True if the row was rounded, so that exact forms of its pairs would say nothing.
    """
    from rich.table import Table
    from rich.text import Text

    from pdtheory.exact.report import decimal_text

    table = Table(title=f"Real E-eigenpairs of order {order}")
    table.add_column("theta (deg)", justify="right", no_wrap=True, min_width=digits)
    table.add_column("lambda", justify="right", no_wrap=True, min_width=digits)
    table.add_column("kind")
    table.add_column("mult.", justify="right")
    if not rounded:
        table.add_column("exact", overflow="fold")
    for pair in pairs:
        table.add_row(
            Text(decimal_text(pair.angle_degrees(digits))),
            Text(decimal_text(pair.eigenvalue_float(digits))),
            pair.kind.label,
            str(pair.multiplicity),
            *(() if rounded else (Text(pair.exact_text),)),
        )
    return table


def check_digits(digits: int) -> None:
    """Refuse a number of digits that is not positive or too large."""
    if not 1 <= digits <= MOST_DIGITS:
        raise InputError(f"--digits is {digits}; it must be from 1 to {MOST_DIGITS}.")
