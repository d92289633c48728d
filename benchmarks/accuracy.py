"""Accuracy on shapes whose derivatives are known, alone and beside other programs.

    uv run python benchmarks/accuracy.py [survey] [choice] [tilt] [peers] [--queries 2000]
        [--build FOLDER] [--python PYTHON]

All four tables are printed unless some are named.

survey
    The set-up of a survey of curvature estimators (Arnal-Anger et al., Computer Graphics Forum,
    2026): 50,000 points on each shape inside [-1, 1]^3, neighbourhoods of radius 0.1, Gaussian
    noise of standard deviation sigma along the normal or none. For each degree and norm: medians
    over the shapes of the median error of the larger principal curvature (by modulus, K1) and of
    its direction in degrees (D1), against the exact values from gradient and Hessian of the
    implicit function; and the share of directions within one standard deviation.
choice
    Degree and radius chosen at each point, against the best fixed ones, for noise from 0 to 1 % of
    the diagonal: medians over the shapes of the median error of the curvature tensor.
tilt
    Median errors of the angles of orders 3 to 6 in degrees, with the frame tangent to the fitted
    surface and with the principal plane of the neighbours: graphs of random polynomials of degree
    12, whose coefficients of degree d are about 0.4^d, in random positions, 300 points each.
peers
    Order 2 beside CGAL jet fitting on the same neighbourhoods, and on the vertices of a mesh of a
    torus beside libigl (5 rings) and PyMeshLab (quadrics within a radius), clean and noisy. CGAL is
    used as in benchmarks/pointset.py, the two others if `--python` names a Python that has them.
"""

from __future__ import annotations

import argparse
import subprocess
import tempfile
from pathlib import Path

import numpy as np
import sympy as sp
from pointset import build_cgal, cgal_input, check_peers, run_cgal, torus_mesh

from pdtheory.pointset import estimate_directions

X, Y, Z = VARIABLES = sp.symbols("x y z")
SHAPES = {
    "ellipsoid": X**2 / sp.Rational(64, 100) + Y**2 / sp.Rational(36, 100) + Z**2 / 0.2 - 1,
    "torus": (X**2 + Y**2 + Z**2 + 0.36 - 0.0625) ** 2 - 1.44 * (X**2 + Y**2),
    "goursat": X**4 + Y**4 + Z**4 - 0.6 * (X**2 + Y**2 + Z**2) + 0.1,
    "peanut": (4 * X**2 + 6 * Y**2 + 6 * Z**2) ** 2 - 8 * (X**2) - 0.2,
    "blob": X**2 + Y**2 + Z**2 + 0.15 * sp.sin(4 * X) * sp.sin(4 * Y) * sp.sin(4 * Z) - 0.5,
}
COUNT, RADIUS = 50_000, 0.1


class Implicit:
    """An implicit surface with its first and second derivatives as fast functions."""

    def __init__(self, expression: sp.Expr) -> None:
        gradient = [sp.diff(expression, v) for v in VARIABLES]
        hessian = [[sp.diff(g, v) for v in VARIABLES] for g in gradient]
        self._value = sp.lambdify(VARIABLES, expression)
        self._gradient = [sp.lambdify(VARIABLES, g) for g in gradient]
        self._hessian = [[sp.lambdify(VARIABLES, h) for h in row] for row in hessian]

    def gradient(self, p: np.ndarray) -> np.ndarray:
        """Gradient at points, (n, 3)."""
        one = np.ones(len(p))
        return np.column_stack([f(*p.T) * one for f in self._gradient])

    def sample(self, count: int, rng: np.random.Generator) -> np.ndarray:
        """Points of the surface, even to first order: those of a thin shell, projected."""
        kept: list[np.ndarray] = []
        while sum(map(len, kept)) < count:
            p = rng.uniform(-1, 1, (20 * count, 3))
            size = np.linalg.norm(self.gradient(p), axis=1)
            p = p[np.abs(self._value(*p.T)) < 0.02 * size]
            for _ in range(20):
                g = self.gradient(p)
                p = p - (self._value(*p.T) / np.sum(g * g, axis=1))[:, None] * g
            kept.append(p[(np.abs(p) < 1).all(axis=1) & (np.abs(self._value(*p.T)) < 1e-12)])
        return np.concatenate(kept)[:count]

    def tensors(self, p: np.ndarray) -> np.ndarray:
        """The curvature tensor for the normal +gradient, as (n, 3, 3)."""
        g = self.gradient(p)
        size = np.linalg.norm(g, axis=1)
        n = g / size[:, None]
        one = np.ones(len(p))
        hessian = np.array([[f(*p.T) * one for f in row] for row in self._hessian])
        hessian = hessian.transpose(2, 0, 1)
        plane = np.eye(3) - n[:, :, None] * n[:, None, :]
        return -plane @ hessian @ plane / size[:, None, None]

    def principal(self, p: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Principal curvature larger by modulus, and its direction."""
        return larger(self.tensors(p))


def larger(tensors: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Eigenvalue larger by modulus, and its vector; the normal has the eigenvalue zero."""
    values, vectors = np.linalg.eigh(tensors)
    end = np.where(np.abs(values[:, 0]) > np.abs(values[:, 2]), 0, 2)
    rows = np.arange(len(tensors))
    return values[rows, end], vectors[rows, :, end]


def found_tensors(field) -> np.ndarray:
    """The estimated curvature tensors, NaN where there is no answer."""
    values, vectors = field[2].eigenvalues.padded(), field[2].vectors.padded()
    return np.einsum("pd,pdi,pdj->pij", values, vectors, vectors) / 2


def compare(found, exact) -> tuple[float, float]:
    """Median errors of K1, and of D1 in degrees."""
    angle = np.arctan2(
        np.linalg.norm(np.cross(found[1], exact[1]), axis=1),
        np.abs(np.sum(found[1] * exact[1], axis=1)),
    )
    return float(np.nanmedian(np.abs(found[0] - exact[0]))), float(np.degrees(np.nanmedian(angle)))


def errors(shape: Implicit, points: np.ndarray, clean: np.ndarray, queries: int, **how) -> list:
    """Median errors of K1 and D1, and the share of directions within one standard deviation."""
    field = estimate_directions(
        points, radius=RADIUS, orders=(2,), queries=np.arange(queries),
        normals=shape.gradient(clean), **how,
    )  # fmt: skip
    k1, d1 = shape.principal(clean[:queries])
    rows = field[2]
    found = np.full(queries, np.nan)
    angle = np.full(queries, np.nan)
    inside = np.zeros(queries, bool)
    for i in range(queries):
        at = rows.rows_of(i)
        if at.start == at.stop:
            continue
        j = at.start + int(np.argmax(np.abs(rows.eigenvalue[at])))
        found[i] = rows.eigenvalue[j]
        cross = np.linalg.norm(np.cross(rows.vector[j], d1[i]))
        angle[i] = np.arctan2(cross, abs(rows.vector[j] @ d1[i]))
        inside[i] = angle[i] <= rows.angle_std[j]
    return [
        float(np.nanmedian(np.abs(found - k1))),
        float(np.degrees(np.nanmedian(angle))),
        float(inside.mean()),
    ]


def displaced(shape: Implicit, points: np.ndarray, sigma: float, rng) -> np.ndarray:
    """Points with noise along the normal."""
    g = shape.gradient(points)
    step = sigma * rng.normal(size=(len(points), 1))
    return points + step * g / np.linalg.norm(g, axis=1, keepdims=True)


def survey(shapes, clean, queries: int, rng) -> None:
    """Print the rows of the survey."""
    print("sigma   degree norm      K1        D1 deg    within one std")
    for sigma in (0.0, 0.001, 0.005):
        noisy = {name: displaced(shape, clean[name], sigma, rng) for name, shape in shapes.items()}
        for degree, norm in (
            (2, "l2"), (4, "l2"), (6, "l2"), (10, "l2"), ("auto", "l2"), (4, "l1"),
        ):  # fmt: skip
            table = [
                errors(shape, noisy[name], clean[name], queries, degree=degree, norm=norm)
                for name, shape in shapes.items()
            ]
            k1, d1, share = np.median(table, axis=0)
            print(f"{sigma:<7g} {degree:<6} {norm}   {k1:.3g}   {d1:.3g}   {share:.2f}", flush=True)


def choice(shapes, clean, queries: int, rng) -> None:
    """Print the errors of fixed and chosen degrees and radii."""
    radii = (0.07, 0.1, 0.14, 0.2)
    sweeps = {
        "degree, R = 0.1": (
            [{"degree": degree} for degree in (2, 4, 6, 8, 10)], {"degree": "auto"}
        ),
        "radius, K = 4": (
            [{"degree": 4, "radius": radius} for radius in radii], {"degree": 4, "radius": radii}
        ),
    }  # fmt: skip
    for title, (fixed, chosen) in sweeps.items():
        print(f"{title}: error of each fixed one, of the choice, and its ratio to the best")
        for level in (0.0, 1e-6, 1e-5, 1e-4, 3e-4, 1e-3, 3e-3, 1e-2):
            table = np.empty((len(fixed) + 1, len(shapes)))
            for column, (name, shape) in enumerate(shapes.items()):
                size = level * np.linalg.norm(np.ptp(clean[name], axis=0))
                points = displaced(shape, clean[name], size, rng)
                exact = shape.tensors(clean[name][:queries])
                for row, how in enumerate([*fixed, chosen]):
                    field = estimate_directions(
                        points, orders=(2,), queries=np.arange(queries),
                        normals=shape.gradient(clean[name]), **{"radius": RADIUS} | how,
                    )  # fmt: skip
                    difference = np.linalg.norm(found_tensors(field) - exact, axis=(1, 2))
                    table[row, column] = np.nanmedian(difference)
            medians = np.median(table, axis=1)
            each = " ".join(f"{value:.2g}" for value in medians[:-1])
            worst = np.max(table[-1] / table[:-1].min(axis=0))
            print(
                f"{level:<7g} {each}   {medians[-1]:.2g}   {medians[-1] / medians[:-1].min():.2f}"
                f"   (worst single shape {worst:.2f})",
                flush=True,
            )


def exact_angles(coefficients: np.ndarray) -> np.ndarray:
    """Critical angles of sum_b c_b cos^(k-b) sin^b in [0, pi), by samples and bisection."""
    order = len(coefficients) - 1

    def slope(t):
        c, s = np.cos(t), np.sin(t)
        total = np.zeros_like(t)
        for b, value in enumerate(coefficients):
            a = order - b
            if a:
                total = total - value * a * c ** (a - 1) * s ** (b + 1)
            if b:
                total = total + value * b * c ** (a + 1) * s ** (b - 1)
        return total

    grid = np.linspace(0.0, np.pi, 20_001)
    sign = slope(grid) > 0
    low = grid[:-1][sign[1:] != sign[:-1]]
    high = grid[1:][sign[1:] != sign[:-1]]
    rising = slope(low) > 0
    for _ in range(60):
        middle = (low + high) / 2
        same = (slope(middle) > 0) == rising
        low, high = np.where(same, middle, low), np.where(same, high, middle)
    return (low + high) / 2


def tilt(trials: int, rng) -> None:
    """Print angle errors with and without the tangent frame."""
    from scipy.stats import special_ortho_group

    print("median angle error in degrees, frame tangent / principal plane")
    for degree in (6, 10):
        for sigma in (0.0, 1e-5, 1e-3):
            wrong: dict[tuple[str, int], list[float]] = {}
            for _ in range(trials):
                c = {
                    (d - b, b): 0.4**d * rng.normal()
                    for d in range(2, 13) for b in range(d + 1)
                }  # fmt: skip
                r, t = np.sqrt(rng.random(300)), 2 * np.pi * rng.random(300)
                r[0] = 0.0
                x, y = r * np.cos(t), r * np.sin(t)
                z = sum(value * x**a * y**b for (a, b), value in c.items())
                turn = special_ortho_group.rvs(3, random_state=rng)
                noise = sigma * rng.normal(size=300)
                noise[0] = 0.0
                points = np.column_stack([x, y, z + noise]) @ turn.T
                for frame in ("tangent", "principal"):
                    field = estimate_directions(
                        points, radius=1.0, degree=degree, orders=(3, 4, 5, 6), queries=[0],
                        normals=np.tile(turn[:, 2], (300, 1)), frame=frame,
                    )  # fmt: skip
                    for order in (3, 4, 5, 6):
                        if not len(field[order]):
                            continue
                        angles = exact_angles(np.array([c[order - b, b] for b in range(order + 1)]))
                        local = field[order].vector @ turn
                        mine = np.arctan2(local[:, 1], local[:, 0])
                        apart = np.abs((angles[:, None] - mine + np.pi / 2) % np.pi - np.pi / 2)
                        wrong.setdefault((frame, order), []).extend(apart.min(axis=1))
            rows = "   ".join(
                f"order {k}: {np.degrees(np.median(wrong['tangent', k])):.2g} / "
                f"{np.degrees(np.median(wrong['principal', k])):.2g}"
                for k in (3, 4, 5, 6)
            )
            print(f"K = {degree:<3d} sigma {sigma:<7g} {rows}", flush=True)


MESH_PEERS = """
import sys
import igl, numpy as np, pymeshlab
data = np.load(sys.argv[1])
points, faces, radius = data["points"], data["faces"], float(data["radius"])
d1, d2, k1, k2 = igl.principal_curvature(points, faces, radius=5)[:4]
k1, k2 = np.ravel(k1), np.ravel(k2)
first = np.abs(k1) > np.abs(k2)
igl_k, igl_d = np.where(first, k1, k2), np.where(first[:, None], d1, d2)
meshes = pymeshlab.MeshSet()
meshes.add_mesh(pymeshlab.Mesh(points, faces))
result = []
for word in ("Max Curvature", "Min Curvature"):
    meshes.compute_curvature_principal_directions_per_vertex(
        method="Scale Dependent Quadric Fitting", curvcolormethod=word, autoclean=False,
        scale=pymeshlab.PureValue(radius),
    )
    result.append(np.array(meshes.current_mesh().vertex_scalar_array()))
mesh = meshes.current_mesh()
np.savez(
    sys.argv[2], igl_k=igl_k, igl_d=igl_d, max_k=result[0], min_k=result[1],
    one=mesh.vertex_curvature_principal_dir1_matrix(),
    two=mesh.vertex_curvature_principal_dir2_matrix(),
)
"""


def peers(shapes, clean, queries: int, rng, build: Path, python: str | None) -> None:
    """Print order 2 beside other programs."""
    program = build_cgal(build)
    if program is not None:
        print(
            "the survey's neighbourhoods: K1 and D1 degrees of ours, of CGAL (SVD; its signs "
            "brought to the exact ones)"
        )
        for sigma in (0.0, 0.001, 0.005):
            for degree in (2, 4, 6):
                table = []
                for name, shape in shapes.items():
                    points = displaced(shape, clean[name], sigma, rng)
                    exact = shape.principal(clean[name][:queries])
                    field = estimate_directions(
                        points, radius=RADIUS, orders=(2,), degree=degree,
                        queries=np.arange(queries), normals=shape.gradient(clean[name]),
                    )  # fmt: skip
                    text = cgal_input(points, queries, RADIUS)
                    rows = run_cgal(program, degree, "svd", text)[1]
                    value, vector = by_modulus(rows, shape.gradient(clean[name][:queries]))
                    theirs = np.copysign(value, exact[0]), vector
                    table.append([*compare(larger(found_tensors(field)), exact),
                                  *compare(theirs, exact)])  # fmt: skip
                ours_k, ours_d, cgal_k, cgal_d = np.median(table, axis=0)
                print(
                    f"sigma {sigma:<6g} K = {degree}   {ours_k:.3g} {ours_d:.3g}   "
                    f"{cgal_k:.3g} {cgal_d:.3g}",
                    flush=True,
                )
    if python:
        on_a_mesh(python, build, rng)


def by_modulus(rows: np.ndarray, normals: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """K1 and D1 from k1 >= k2, the direction of k1, and normals of either side."""
    n = normals / np.linalg.norm(normals, axis=1, keepdims=True)
    first = np.abs(rows[:, 0]) > np.abs(rows[:, 1])
    direction = np.where(first[:, None], rows[:, 2:5], np.cross(n, rows[:, 2:5]))
    return np.where(first, rows[:, 0], rows[:, 1]), direction


def on_a_mesh(python: str, build: Path, rng) -> None:
    """Print order 2 on the vertices of a torus beside libigl and PyMeshLab."""
    print("vertices of a torus mesh: K1 and D1 degrees (signs brought to the exact ones)")
    plain, faces = torus_mesh(140)
    ring = np.linalg.norm(plain[:, :2], axis=1)
    axis = np.column_stack([plain[:, :2] / ring[:, None], np.zeros(len(plain))])
    normals = (plain - axis) / 0.4
    direction = np.cross(np.cross([0.0, 0.0, 1.0], axis), normals)
    exact = np.full(len(plain), -2.5), direction
    radius = 0.14
    for sigma in (0.0, 0.0005, 0.002):
        points = plain + sigma * rng.normal(size=(len(plain), 1)) * normals
        np.savez(build / "mesh.npz", points=points, faces=faces, radius=radius)
        subprocess.run(
            [python, "-c", MESH_PEERS, str(build / "mesh.npz"), str(build / "found.npz")],
            check=True, capture_output=True,
        )  # fmt: skip
        data = np.load(build / "found.npz")
        first = np.abs(data["max_k"]) > np.abs(data["min_k"])
        lab_k = np.where(first, data["max_k"], data["min_k"])
        # As found on a torus: the first direction is not that of "Max Curvature".
        lab_d = np.where(first[:, None], data["two"], data["one"])
        rows = {"libigl": (data["igl_k"], data["igl_d"]), "PyMeshLab": (lab_k, lab_d)}
        for degree in (2, 4, "auto"):
            field = estimate_directions(
                points, radius=radius, degree=degree, orders=(2,), normals=normals
            )
            rows[f"ours, K = {degree}"] = larger(found_tensors(field))
        for name, (value, vector) in rows.items():
            k1, d1 = compare((np.copysign(value, exact[0]), vector), exact)
            print(f"sigma {sigma:<7g} {name:14s} {k1:.3g}   {d1:.3g}", flush=True)


def main() -> None:
    """Print the tables asked for."""
    parser = argparse.ArgumentParser(description=__doc__)
    names = ("survey", "choice", "tilt", "peers")
    parser.add_argument("tables", nargs="*", help=f"some of {', '.join(names)}")
    parser.add_argument("--queries", type=int, default=2000)
    parser.add_argument("--build", type=Path, default=Path(tempfile.gettempdir()))
    parser.add_argument("--python", help="a Python with libigl and pymeshlab")
    options = parser.parse_args()
    wanted = options.tables or names
    if "peers" in wanted and options.python:
        check_peers(options.python, "igl", "pymeshlab")
    rng = np.random.default_rng(1)
    shapes = {name: Implicit(expression) for name, expression in SHAPES.items()}
    clean = {name: shape.sample(COUNT, rng) for name, shape in shapes.items()}
    if "survey" in wanted:
        survey(shapes, clean, options.queries, rng)
    if "choice" in wanted:
        choice(shapes, clean, options.queries, rng)
    if "tilt" in wanted:
        tilt(max(options.queries // 10, 1), rng)
    if "peers" in wanted:
        peers(shapes, clean, options.queries, rng, options.build, options.python)


if __name__ == "__main__":
    main()
