"""Directions on scans: dense samples, strokes spread evenly, and the order that says most there."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import numpy.typing as npt

from pdtheory.conventions import UNANSWERED
from pdtheory.paper.figures.measure import anisotropy, eigen_residual, refit_difference, turned
from pdtheory.paper.figures.models import load
from pdtheory.paper.figures.outcome import Check, Figure, Job, Outcome, at_most
from pdtheory.paper.figures.stage import Panel, Strokes, sheet
from pdtheory.pointset import estimate_directions
from pdtheory.pointset.cloud import FloatArray, PointCloud
from pdtheory.pointset.field import DirectionField
from synthetic_surfaces.spread import OVERSAMPLING, thin

#: A direction uncertain by this angle counts half.
_CERTAIN = np.radians(3.0)


@dataclass(frozen=True)
class Scan:
    """How one scan is treated and shown.

    Attributes
    ----------
    name : str
        Name of the scan.
    orders : tuple of int
        The orders computed; each stroke point shows the one that says most there.
    radius : float
        Radius of the fits, as a part of the diagonal.
    spots : int
        Points with strokes on the whole surface.
    up, azimuth, elevation
        Where the camera stands.
    box : ((3,), (3,)) floats or None
        Part of the bounding box shown, from 0 to 1 along each axis; None shows all.
    degree : int
        Degree of the fits.
    sharp : bool
        Whether strokes stand on the sharp edges of the mesh only, as suits machined parts.
    preferred : str
        Name of a scan that is taken in place of `name` where the user has it.
    title : str
        Stands below the picture.
    """

    name: str
    orders: tuple[int, ...]
    radius: float = 0.03
    spots: int = 900
    up: str = "y"
    azimuth: float = 25.0
    elevation: float = 12.0
    box: tuple[tuple[float, float, float], tuple[float, float, float]] | None = None
    degree: int = 10
    sharp: bool = False
    preferred: str = ""
    title: str = ""

    @property
    def names(self) -> tuple[str, ...]:
        """The names of the scans that will do, the best first."""
        return (self.preferred, self.name) if self.preferred else (self.name,)


@dataclass(frozen=True)
class Shown:
    """A scan with its directions, ready to be drawn."""

    scan: Scan
    mesh: PointCloud
    field: DirectionField
    chosen: npt.NDArray[np.int64]
    spacing: float
    focus: FloatArray | None


def sample(mesh: PointCloud, count: int, seed: int) -> PointCloud:
    """Return `count` points on a mesh, uniform by area, with the normals of the triangles."""
    from pdtheory.io.meshes import sample_mesh

    return sample_mesh(mesh, count, seed)


def telling_order(field: DirectionField, orders: Sequence[int]) -> npt.NDArray[np.int64]:
    """Return for every point the order that stands out there most and is certain.

    That is the order whose angular amplitude is largest when measured by the 90 % quantile of its
    order over all points, the less so the less certain its best maximum is; 0 where there is none.
    It takes the place of a choice by hand.
    """
    score = np.zeros((len(orders), len(field)))
    for row, order in enumerate(orders):
        maxima = field[order].maxima
        doubt = np.full(len(field), np.inf)
        np.minimum.at(doubt, maxima.point_index, maxima.angle_std)
        swing = anisotropy(field, order)
        score[row] = swing / np.quantile(swing, 0.9) / (1.0 + (doubt / _CERTAIN) ** 2)
    best = np.array(orders)[score.argmax(axis=0)]
    return np.where(score.max(axis=0) > 0, best, 0)


def sharp_vertices(mesh: PointCloud) -> FloatArray:
    """Return the vertices of a mesh where triangles meet at more than 30 degrees, (S, 3)."""
    assert mesh.faces is not None
    corners = mesh.points[mesh.faces]
    normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normal /= np.maximum(np.linalg.norm(normal, axis=1), np.finfo(float).tiny)[:, None]
    mean = np.zeros_like(mesh.points)
    np.add.at(mean, mesh.faces.ravel(), np.repeat(normal, 3, axis=0))
    mean /= np.maximum(np.linalg.norm(mean, axis=1), np.finfo(float).tiny)[:, None]
    lean = np.ones(len(mesh.points))
    np.minimum.at(
        lean, mesh.faces.ravel(), np.einsum("fi,fki->fk", normal, mean[mesh.faces]).ravel()
    )
    return mesh.points[lean < np.cos(np.radians(15.0))]


def show(scan: Scan, job: Job) -> tuple[Shown, list[Check], dict[str, object]]:
    """Compute the directions of one scan at evenly spread points, and check them."""
    mesh = load(scan.names, job)
    count = job.pick(150_000, 300_000, 5_000_000)
    cloud = sample(mesh, count, job.seed)
    radius = scan.radius * mesh.diagonal
    box, focus = _box(scan, mesh)
    pool = cloud.points[: 200 * scan.spots]
    inside = np.all((pool >= box[0]) & (pool <= box[1]), axis=1)
    spots = scan.spots if scan.box is None else scan.spots // 2
    wanted = job.pick(60, spots, spots)
    candidates = sharp_vertices(mesh) if scan.sharp else pool[inside][: OVERSAMPLING * wanted]
    wanted = min(wanted, len(candidates))
    spots_at = candidates[thin(candidates, wanted)]
    job.tell(0.3, f"{scan.name}: directions")

    def estimate(points: PointCloud) -> DirectionField:
        return estimate_directions(
            points, radius=radius, degree=scan.degree, orders=scan.orders, queries=spots_at
        )

    field = estimate(cloud)
    again = estimate(sample(mesh, count, job.seed + 1))
    answered = (field.status & int(UNANSWERED)) == 0
    # In the principal frame the coefficients are those of one fit, without a turn to the tangent.
    few = estimate_directions(
        cloud, radius=radius, degree=scan.degree, orders=scan.orders, queries=spots_at[:4],
        frame="principal",
    )  # fmt: skip
    chosen = telling_order(field, scan.orders)
    # What is drawn must not depend on which samples were drawn.
    twist = np.concatenate(
        [
            turned(field[order], again[order])[
                chosen[np.flatnonzero(field[order].maxima.counts)] == order
            ]
            for order in scan.orders
        ]
    )
    bound = job.pick(25.0, 10.0, 5.0)
    checks = [
        Check(f"{scan.name}: share of stroke points that could be answered",
              float(answered.mean()), 0.98, 1.0, "the surface is closed and densely sampled"),
        at_most(f"{scan.name}: largest residual of the eigenvector equation, all directions",
                max(eigen_residual(field, order) for order in scan.orders), 1e-7, "theorem 1"),
        at_most(f"{scan.name}: difference of phi R^(k-1) from an independent fit",
                refit_difference(few, cloud), 1e-8,
                "orthogonal factorization with NumPy"),
        at_most(f"{scan.name}: median turn in degrees of the strokes drawn with other samples",
                np.median(twist), bound, "directions belong to the surface"),
    ]  # fmt: skip
    numbers: dict[str, object] = {
        "neighbours, median": float(np.median(field.neighbours)),
        "points showing each order": {order: int((chosen == order).sum()) for order in scan.orders},
    }
    seen = mesh.points[np.all((mesh.points >= box[0]) & (mesh.points <= box[1]), axis=1)]
    area = np.linalg.norm(np.ptp(seen, axis=0)) ** 2
    spacing = float(np.sqrt(area / len(spots_at)))
    return Shown(scan, mesh, field, chosen, spacing, focus), checks, numbers


def _box(scan: Scan, mesh: PointCloud) -> tuple[FloatArray, FloatArray | None]:
    low, high = mesh.points.min(axis=0), mesh.points.max(axis=0)
    if scan.box is None:
        return np.stack([low, high]), None
    part = low + (high - low) * np.array(scan.box)
    inside = np.all((mesh.points >= part[0]) & (mesh.points <= part[1]), axis=1)
    return part, mesh.points[inside]


def panel(shown: Shown) -> Panel:
    """Return the picture of one scan: at every point the maxima of its most telling order."""
    scan = shown.scan
    strokes = Strokes(
        shown.field, scan.orders, 0.42 * shown.spacing, width=0.22, chosen=shown.chosen
    )
    return Panel(
        shown.mesh,
        [strokes],
        scan.title,
        up=scan.up,
        azimuth=scan.azimuth,
        elevation=scan.elevation,
        focus=shown.focus,
        ground=scan.box is None,
    )


def figure(
    name: str,
    redraws: str,
    caption: str,
    scans: Sequence[Scan],
    *,
    columns: int,
    size: tuple[int, int],
) -> Figure:
    """Return a figure of one or several scans."""

    def compute(job: Job) -> Outcome:
        checks: list[Check] = []
        numbers, shown = {}, []
        for scan in scans:
            picture, its_checks, its_numbers = show(scan, job)
            checks += its_checks
            numbers[f"{scan.name} {scan.title}".strip()] = its_numbers
            shown.append(picture)
        parameters = {
            "samples": job.pick(150_000, 300_000, 5_000_000),
            "degree": [scan.degree for scan in scans],
            "radius over diagonal": [scan.radius for scan in scans],
            "orders": [list(scan.orders) for scan in scans],
            "seed": job.seed,
        }
        return Outcome(checks, parameters, numbers, shown)

    def draw(job: Job, outcome: Outcome, folder: Path) -> list[Path]:
        panels = [panel(shown) for shown in outcome.scene]
        return sheet(job, panels, folder, name, columns=columns, size=size)

    needed = tuple(dict.fromkeys(scan.names for scan in scans))
    return Figure(name, redraws, caption, compute, draw, needed)


TEASER = figure(
    "teaser",
    "principal directions of arbitrary orders on the Armadillo and Fandisk point sets",
    "Maximum principal directions of orders 2 (blue), 3 (green), 4 (cyan), 5 (pink) and 6 (brown); "
    "each point shows the order that stands out there.",
    [
        Scan("armadillo", (2, 3, 4, 5, 6), radius=0.03, spots=1500, azimuth=20.0),
        Scan("fandisk", (2, 3, 4, 5, 6), radius=0.04, spots=210, azimuth=215, elevation=32,
             degree=6, sharp=True),
    ],
    columns=2,
    size=(640, 640),
)  # fmt: skip
ARMADILLO = figure(
    "armadillo",
    "principal directions of various orders on the torso and leg of the Armadillo",
    "Maxima of orders 2, 3 and 4 on torso and leg of the Armadillo: order 2 along valleys, order 4 "
    "where valleys cross, order 3 where three meet.",
    [
        Scan("armadillo", (2, 3, 4), radius=0.025, spots=1300, azimuth=15.0, elevation=10,
             box=((0.22, 0.38, 0.45), (0.78, 0.74, 1.0)), title="torso"),
        Scan("armadillo", (2, 3, 4), radius=0.025, spots=1300, azimuth=15.0, elevation=8,
             box=((0.0, 0.0, 0.0), (0.5, 0.45, 1.0)), title="leg"),
    ],
    columns=2,
    size=(640, 560),
)  # fmt: skip
HEAD = figure(
    "head",
    "vector fields for order 2 and 3 on the David head (Igea stands in for it)",
    "Maxima of order 2 (left) and of order 3 (right) on a head.",
    [
        Scan("igea", (2,), radius=0.035, spots=1500, azimuth=0.0, elevation=5,
             preferred="david", title="order 2"),
        Scan("igea", (3,), radius=0.035, spots=1500, azimuth=0.0, elevation=5,
             preferred="david", title="order 3"),
    ],
    columns=2,
    size=(560, 640),
)  # fmt: skip
ROCKER_ARM = figure(
    "rocker-arm",
    "some principal directions computed on the Rockerarm model",
    "Maxima of order 2 (blue) and 3 (green); order 3 where three smooth parts meet.",
    [
        Scan(
            "rocker-arm", (2, 3), radius=0.04, spots=900, up="x", azimuth=30, elevation=35, degree=6
        )
    ],
    columns=1,
    size=(800, 640),
)
FANDISK = figure(
    "fandisk",
    "some principal directions computed on the Fandisk",
    "Maxima of order 2 (blue) along edges and of order 3 (green) near corners.",
    [
        Scan(
            "fandisk",
            (2, 3),
            radius=0.04,
            spots=210,
            azimuth=215,
            elevation=32,
            degree=6,
            sharp=True,
        )
    ],
    columns=1,
    size=(800, 640),
)
