"""The command ``pdtheory cone``: what a regression must find at edges, corners and junctions."""

from __future__ import annotations

import json
from enum import StrEnum
from typing import TYPE_CHECKING, Annotated, Any

import typer

from pdtheory.cli.options import parse_orders
from pdtheory.errors import InputError

if TYPE_CHECKING:
    from pdtheory.exact.cones import Cone


class Shape(StrEnum):
    """The cones that have a name."""

    RIDGE = "ridge"
    CORNER = "corner"
    T_JUNCTION = "t-junction"
    PLANES = "planes"


class MeasureName(StrEnum):
    """How the samples lie and what their weights measure."""

    FLAT = "flat"
    SURFACE = "surface"


class WeightName(StrEnum):
    """The weight of the regression."""

    GAUSSIAN = "gaussian"
    UNIFORM = "uniform"


def cone(
    shape: Annotated[
        Shape,
        typer.Argument(metavar="SHAPE", help="Which cone; 'planes' takes --rays."),
    ],
    slope: Annotated[
        str | None,
        typer.Option("--slope", help="Steepness, such as 1/2; the shape's own if left out."),
    ] = None,
    rays: Annotated[
        str | None,
        typer.Option(
            "--rays", help="Rays of 'planes' as angle:slope, such as 0:0,90:-1,180:0,270:-1."
        ),
    ] = None,
    degree: Annotated[int, typer.Option("--degree", help="Degree K of the regression.")] = 10,
    orders: Annotated[str, typer.Option("--orders", help="Orders, such as 2:7 or 3,5.")] = "2:7",
    measure: Annotated[
        MeasureName,
        typer.Option("--measure", help="Samples uniform in the plane, or on the surface itself."),
    ] = MeasureName.FLAT,
    weight: Annotated[
        WeightName, typer.Option("--weight", help="Weight of the regression.")
    ] = WeightName.GAUSSIAN,
    digits: Annotated[int, typer.Option("--digits", help="Significant digits in the table.")] = 12,
    as_json: Annotated[bool, typer.Option("--json", help="Print JSON instead of tables.")] = False,
) -> None:
    """Predict the principal directions at the apex of a piecewise linear cone, for radius 1.

    Example: pdtheory cone t-junction --orders 2:7
    """
    from pdtheory.cli.eigen import check_digits, print_order
    from pdtheory.exact.prediction import predict
    from pdtheory.exact.report import order_report

    check_digits(digits)
    prediction = predict(
        make_cone(shape, slope, rays),
        degree,
        parse_orders(orders),
        weight=weight.value,
        measure=measure.value,
    )
    found = {k: prediction.eigenpairs(k) for k in prediction.orders}
    if as_json:
        data = {"orders": {str(k): order_report(pairs, rounded=True) for k, pairs in found.items()}}
        typer.echo(json.dumps(data, indent=2))
        return
    if prediction.cone.is_plane:
        typer.echo(
            "The cone is a plane: its creases have no angle, so every order above 1 vanishes."
        )
    for pairs in found.values():
        print_order(pairs, digits, rounded=True)


def make_cone(shape: Shape, slope: str | None, rays: str | None) -> Cone:
    """Return the cone that the options describe."""
    from pdtheory.exact.cones import Cone

    if shape is Shape.PLANES:
        if rays is None:
            raise InputError("The shape 'planes' needs --rays, such as 0:0,90:-1,180:0,270:-1.")
        if slope is not None:
            raise InputError("The shape 'planes' takes its slopes from --rays, not from --slope.")
        return Cone(tuple(_ray(part) for part in rays.split(",")))
    if rays is not None:
        raise InputError(f"The shape {shape.value!r} takes no --rays; use 'planes' for them.")
    make = {Shape.RIDGE: Cone.ridge, Shape.CORNER: Cone.corner, Shape.T_JUNCTION: Cone.t_junction}
    return make[shape]() if slope is None else make[shape](_constant(slope))


def _ray(text: str) -> tuple[Any, Any]:
    angle, colon, slope = text.partition(":")
    if not colon:
        raise InputError(f"The ray {text!r} is not of the form angle:slope, such as 90:-1.")
    return _constant(angle), _constant(slope)


def _constant(text: str) -> Any:
    from pdtheory.exact.expression import parse_expression

    return parse_expression(text, variables=())
