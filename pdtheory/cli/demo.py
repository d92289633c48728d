"""``pdtheory demo``: the main job once, from a formula and from samples to a picture."""

from __future__ import annotations

from itertools import product
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from pdtheory.cli.options import progress_bar
from pdtheory.errors import ComputationError, FileAccessError, MissingDependencyError

if TYPE_CHECKING:
    import sympy
    from rich.console import Console

    from pdtheory.exact import EigenPairs, SurfaceJet, SymmetricTensor
    from pdtheory.pointset import DirectionField, PointCloud

ORDERS = (2, 3, 4)
DEGREE = 6
NEIGHBOURS = 80

#: The analytic surface: a torus with these radii, its samples, and the regression on them.
MAJOR, MINOR = "1", "2/5"
TORUS_SAMPLES = 20_000
TORUS_RADIUS = 0.3
TORUS_DEGREE = 10

#: Tangents of half angles, around the torus and around its tube, at which the exact directions are
#: worked out: all is rational there.
AROUND = ("-3", "-3/2", "-2/3", "-1/5", "1/4", "3/4", "7/5", "4")
ACROSS = ("-5/2", "-1", "-1/3", "1/6", "1/2", "2")

#: Points of the rounded cube that stands in where no scan is given.
CUBE_SAMPLES = 30_000
#: Cells along a side of the cube's mesh, on which its directions are drawn.
CUBE_RESOLUTION = 48


def demo(
    model: Annotated[
        Path | None,
        typer.Option(
            help="A mesh or point cloud; the rounded cube if left out.", show_default="cube"
        ),
    ] = None,
    output: Annotated[Path, typer.Option("--output", "-o", help="Folder for the results.")] = Path(
        "demo"
    ),
    quiet: Annotated[bool, typer.Option("--quiet", "-q", help="No progress bars.")] = False,
) -> None:
    """Prove, estimate, compare and draw: the main job in under two minutes.

    Example: pdtheory demo --model scan.ply
    """
    from rich.console import Console

    console = Console(highlight=False, soft_wrap=True)
    # The scan is read first of all, so that a wrong path is refused at once.
    cloud, surface = _read(model)
    _prepare(output)
    _prove_monkey_saddle(console)
    _compare_with_exact(console, quiet)
    field = _estimate(console, cloud, quiet)
    _write(console, field, surface, output, quiet)


def _read(model: Path | None) -> tuple[PointCloud, PointCloud]:
    """Return the points to compute at and the surface to draw below them."""
    if model is not None:
        from pdtheory.io import read_cloud

        cloud = read_cloud(model)
        return cloud, cloud
    import synthetic_surfaces

    cube = synthetic_surfaces.get("rounded-cube")
    return cube.sample(CUBE_SAMPLES, seed=1), cube.mesh(CUBE_RESOLUTION)


def _prepare(output: Path) -> None:
    try:
        output.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise FileAccessError(
            f"cannot make the folder {output}: {error.strerror}; choose another with --output."
        ) from error


def _prove_monkey_saddle(console: Console) -> None:
    import sympy as sp

    from pdtheory.cli.eigen import eigen_table
    from pdtheory.exact import differential_tensor, real_eigenpairs

    x, y = sp.symbols("x y")
    tensor = differential_tensor(x**3 - 3 * x * y**2, (x, y), 3)
    pairs = real_eigenpairs(tensor)
    console.print("\n[bold]1. Exactly: the monkey saddle z = x^3 - 3 x y^2[/bold]")
    console.print(eigen_table(3, pairs))
    derivative = prove_critical(tensor, pairs)
    count = len(pairs)
    console.print(f"  T v^2 = lambda v    holds exactly for all {count} vectors")
    console.print(f"  g_3'(theta) = 0     holds exactly at all {count} angles")
    console.print(
        f"  P(u) = {derivative.as_expr()}, u = e^(2i theta), has {derivative.degree()} simple "
        f"roots: at most {2 * derivative.degree()} angles"
    )
    console.print(
        "  Proved: the E-eigenvectors are exactly the critical angles of the Wavejets row."
    )


def prove_critical(tensor: SymmetricTensor, pairs: EigenPairs) -> sympy.Poly:
    """Prove that E-eigenvectors and critical angles of the Wavejets row are the same.

    Both inclusions are computed: every vector satisfies the equation of the tensor and is a zero of
    g_k', and g_k' has no more zeros than there are vectors.

    Parameters
    ----------
    tensor
        A symmetric tensor of order k.
    pairs
        Its E-eigenpairs.

    Returns
    -------
    sympy.Poly
        P(u) = sum_n n phi_{k,n} u^((k+n)/2); its roots on the unit circle are the critical angles.

    Raises
    ------
    ComputationError
        If one of the three facts does not come out.
    """
    import sympy as sp

    order, row = tensor.order, tensor.row
    frequencies = range(-order, order + 1, 2)

    def derivative(vector: tuple[sp.Expr, sp.Expr]) -> sp.Expr:
        turn = vector[0] + sp.I * vector[1]
        return sp.simplify(sum(sp.I * n * row[n] * turn**n for n in frequencies))

    eigen = all(
        sp.simplify(left - pair.eigenvalue * right) == 0
        for pair in pairs
        for left, right in zip(
            tensor.contract(pair.vector, order - 1).components, pair.vector, strict=True
        )
    )
    critical = all(derivative(pair.vector) == 0 for pair in pairs)
    u = sp.Symbol("u")
    polynomial = sp.Poly(sum(n * row[n] * u ** ((order + n) // 2) for n in frequencies), u)
    none_missing = 2 * polynomial.degree() == len({pair.vector for pair in pairs})
    if not (eigen and critical and none_missing):
        raise ComputationError(
            f"the E-eigenvectors of {tensor} could not be proved to be its critical angles; "
            "please report this."
        )
    return polynomial


def _compare_with_exact(console: Console, quiet: bool) -> None:
    """Estimate on a sampled torus and compare with its exact jets at rational points."""
    import numpy as np
    from rich.table import Table

    import synthetic_surfaces
    from pdtheory.comparison import compare_fields, field_of_jets
    from pdtheory.pointset import PointCloud, estimate_directions

    cloud = synthetic_surfaces.get("torus", major=MAJOR, minor=MINOR).sample(
        TORUS_SAMPLES, method="area", seed=1
    )
    exact = field_of_jets(_torus_jets(), ORDERS)
    assert cloud.normals is not None
    whole = PointCloud(
        np.concatenate([exact.points, cloud.points]),
        np.concatenate([exact.frames[:, 2], cloud.normals]),
        name=cloud.name,
    )
    console.print(
        f"\n[bold]2. Estimated against exact: a torus, {len(whole):,} samples, "
        f"degree {TORUS_DEGREE}, R = {TORUS_RADIUS}[/bold]"
    )
    with progress_bar("Estimating", quiet=quiet) as report:
        field = estimate_directions(
            whole,
            radius=TORUS_RADIUS,
            degree=TORUS_DEGREE,
            orders=ORDERS,
            queries=np.arange(len(exact)),
            progress=report,
        )
    table = Table(title=f"Against the exact jets at {len(exact)} points")
    for heading in ("order", "directions", "found", "median error", "largest", "lambda, median"):
        table.add_column(heading, justify="right")
    for agreement in compare_fields(field, exact):
        angle = np.degrees(agreement.angle)
        table.add_row(
            str(agreement.order),
            f"{len(angle)}",
            f"{agreement.estimated}",
            f"{np.nanmedian(angle):.2g} deg",
            f"{np.nanmax(angle):.2g} deg",
            f"{100.0 * np.nanmedian(agreement.eigenvalue):.2g} %",
        )
    console.print(table)


def _torus_jets() -> list[SurfaceJet]:
    """Return exact jets of the torus at rational points, in rational frames."""
    import sympy as sp

    from pdtheory.exact import implicit_jet, parse_expression

    variables = sp.symbols("x y z")
    major, minor = sp.Rational(MAJOR), sp.Rational(MINOR)
    torus = parse_expression(
        f"(x**2 + y**2 + z**2 + ({MAJOR})**2 - ({MINOR})**2)**2 - 4*({MAJOR})**2*(x**2 + y**2)",
        ("x", "y", "z"),
    )
    jets = []
    for halves in product(AROUND, ACROSS):
        along, across = (
            ((1 - half**2) / (1 + half**2), 2 * half / (1 + half**2))
            for half in map(sp.Rational, halves)
        )
        point = (
            (major + minor * across[0]) * along[0],
            (major + minor * across[0]) * along[1],
            minor * across[1],
        )
        # The parallel circle is a rational tangent direction.
        jets.append(
            implicit_jet(torus, variables, max(ORDERS), point, tangent=(-along[1], along[0], 0))
        )
    return jets


def _estimate(console: Console, cloud: PointCloud, quiet: bool) -> DirectionField:
    from pdtheory.cli.estimate import summary_table
    from pdtheory.pointset import estimate_directions
    from pdtheory.pointset.summary import order_summaries, status_sentences

    console.print(f"\n[bold]3. On {cloud.name}, {len(cloud):,} points[/bold]")
    with progress_bar("Estimating", quiet=quiet) as report:
        field = estimate_directions(
            cloud, neighbours=NEIGHBOURS, degree=DEGREE, orders=ORDERS, progress=report
        )
    console.print(summary_table(len(field), order_summaries(field)))
    for sentence in status_sentences(field.status):
        console.print(f"  {sentence}")
    return field


def _write(
    console: Console, field: DirectionField, surface: PointCloud, output: Path, quiet: bool
) -> None:
    from pdtheory.io import write_field

    console.print("\n[bold]4. Files[/bold]")
    for target in (output / "field.npz", output / "field.ply"):
        write_field(field, target)
        console.print(f"  Wrote {target}")
    picture = output / "picture.png"
    try:
        from pdtheory.blender import draw_field

        with progress_bar("Rendering", quiet=quiet) as report:
            draw_field(field, surface, picture, orders=(2, 3), kind="max", progress=report)
    except MissingDependencyError as error:
        # An extra in square brackets is no markup.
        console.print(f"  No picture: {error}", markup=False)
    else:
        console.print(f"  Wrote {picture}")
