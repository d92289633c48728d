"""Speed and errors beside public Wavejets codes, on the same neighbourhoods.

    uv run python benchmarks/wavejets.py [speed] [accuracy] --sources FOLDER [FOLDER ...]
        [--eigen FOLDER] [--build FOLDER] [--queries 200] [--graphs 200]

Both tables are printed unless one is named. FOLDER is a checkout of one of these projects, which
live on GitHub under these names:

Etharsys/CPPWaveJets
    The class Wavejet: coefficients of any degree, in the principal frame of the neighbours. OpenCV,
    which it displays with, is not needed.
STORM-IRIT/algebraic-shape-operator
    CurvatureComputer_WJets: curvatures of degree 2, in a frame tangent to a first fit.

They are compiled with g++ and Eigen (Debian: g++, libeigen3-dev), as `-O3 -march=native -DNDEBUG`.
Each has to find the coefficients of exact polynomials first; one that does not is left out, and the
exit code is 1.

speed
    Microseconds of processor time a point, one thread, the median of five timings in turns: of
    theirs for the fit alone, to neighbours that are given (without the point itself, as both ask);
    of ours for everything, from the search for neighbours to the directions of orders 2 to K. On
    the torus of benchmarks/pointset.py.
accuracy
    Medians over graphs of random polynomials of degree 12 in random positions, whose coefficients
    of degree d are about 0.4^d, with 300 points each within a radius of about 1: the angle of the
    normal in degrees, and for orders 2 to 4 the error of the row phi_{k,n} (root mean square of the
    difference of g_k over the angle, relative to the exact one) and of the principal directions in
    degrees, seen along the exact normal. Noise is along the axis of the graph, in radii. A code
    that hands back curvatures only: the error of the mean curvature and of the larger curvature by
    modulus, relative to the larger one, and the same for exact quadrics.
"""

from __future__ import annotations

import argparse
import shutil
import statistics
import subprocess
import sys
import tempfile
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from accuracy import exact_angles
from pointset import alternate, ours, radius_for, refusal, show, spread_of_ratio, torus_points
from scipy.spatial import cKDTree
from scipy.stats import special_ortho_group

from pdtheory.pointset import DirectionField, estimate_directions

HERE = Path(__file__).parent / "peers_wavejets"
NOISE = (0.0, 1e-5, 1e-3)
ORDERS = (2, 3, 4)
#: Largest relative error of coefficients of an exact polynomial that is not nonsense.
EXACT = 1e-4


@dataclass(frozen=True)
class Peer:
    """A public code: where its fit is in a checkout, and what drives it."""

    name: str
    driver: str
    sources: tuple[str, ...]
    include: str
    degrees: tuple[int, ...]
    curvatures: bool
    """Whether it hands back curvatures, not coefficients."""


PEERS = (
    Peer("CPPWaveJets", "cpp_wavejets.cpp",
         ("wavejet/src/wavejet.cpp", "wavejet/src/phi.cpp"), "wavejet/include", (4, 10), False),
    Peer("algebraic-shape-operator", "shape_operator.cpp",
         ("figures/src/PCP/Curvature/Methods/WJets.cpp",), "figures/src", (2,), True),
)  # fmt: skip


@dataclass(frozen=True)
class Jet:
    """Coefficients at a point: the frame as rows t1, t2, n, and phi_{k,n} for n = -k, ..., k."""

    frame: np.ndarray
    rows: dict[int, np.ndarray]

    def along(self, order: int, vectors: np.ndarray) -> np.ndarray:
        """g_k along vectors (D, 3)."""
        theta = np.arctan2(vectors @ self.frame[1], vectors @ self.frame[0])
        return (np.exp(1j * np.outer(theta, every(order))) @ self.rows[order]).real

    def lines(self, order: int) -> np.ndarray:
        """The principal directions, one vector of each line, (D, 3)."""
        theta = np.pi * np.arange(order + 1) / (order + 1)
        b = np.arange(order + 1)
        monomials = np.cos(theta)[:, None] ** (order - b) * np.sin(theta)[:, None] ** b
        g = self.along(order, self.vectors(theta))
        return self.vectors(exact_angles(np.linalg.solve(monomials, g)))

    def vectors(self, theta: np.ndarray) -> np.ndarray:
        """Unit vectors at some angles, (D, 3)."""
        return np.column_stack([np.cos(theta), np.sin(theta)]) @ self.frame[:2]


def every(order: int) -> np.ndarray:
    """The frequencies of an order, negative ones too."""
    return np.arange(-order, order + 1, 2)


def find_peer(folder: Path) -> Peer:
    """The project that a folder is a checkout of."""
    for peer in PEERS:
        if all((folder / source).is_file() for source in peer.sources):
            return peer
    needs = " or of ".join(f"{peer.name} (with {peer.sources[0]})" for peer in PEERS)
    raise refusal(f"{folder} is not a checkout of {needs}; give the folder of one.")


def build(peer: Peer, checkout: Path, eigen: Path, folder: Path) -> Path:
    """Compile a driver with the sources of a checkout."""
    compiler = shutil.which("g++")
    if compiler is None:
        raise refusal("g++ is not installed; it compiles the other codes.")
    if not (eigen / "Eigen" / "Dense").is_file():
        raise refusal(
            f"{eigen} holds no Eigen/Dense; install Eigen or give its folder with --eigen."
        )
    folder.mkdir(parents=True, exist_ok=True)
    program = folder / Path(peer.driver).stem
    command = [compiler, "-std=c++17", "-O3", "-march=native", "-DNDEBUG", "-w", f"-I{eigen}"]
    command += [f"-I{HERE}", f"-I{HERE / 'stand_in'}", f"-I{checkout / peer.include}"]
    # What draws is not linked.
    command += ["-ffunction-sections", "-Wl,--gc-sections", "-o", str(program)]
    command += [str(HERE / peer.driver), *(str(checkout / source) for source in peer.sources)]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode:
        wrong = [
            line for line in done.stderr.splitlines() if "error" in line or "undefined" in line
        ]
        raise refusal(f"{checkout} does not compile: {(wrong or ['no reason given'])[0]}")
    return program


def as_text(points: np.ndarray, queries: np.ndarray, radius: float) -> str:
    """The neighbourhoods of some points, as the drivers read them."""
    lists = cKDTree(points).query_ball_point(points[queries], radius)
    text = [f"{len(queries)} {radius!r}"]
    for i, members in zip(queries, lists, strict=True):
        text.append(str(len(members) - 1))
        rows = [i, *(j for j in members if j != i)]
        text += [" ".join(map(repr, map(float, points[j]))) for j in rows]
    return "\n".join(text)


def run(program: Path, degree: int, text: str) -> tuple[float, np.ndarray]:
    """Seconds of the fits, and a row of numbers for each query."""
    done = subprocess.run(
        [program, str(degree)], input=text, capture_output=True, text=True, check=False
    )
    if done.returncode:
        sys.exit(f"{program} ended with code {done.returncode} at degree {degree}.")
    return float(done.stderr), np.array([line.split() for line in done.stdout.splitlines()], float)


def their_jet(numbers: np.ndarray, degree: int) -> Jet:
    """The coefficients that CPPWaveJets hands back at one point, for a radius of 1."""
    phi = numbers[9::2] + 1j * numbers[10::2]
    starts = np.cumsum(np.arange(degree + 2))
    rows = {k: phi[starts[k] : starts[k + 1]] for k in range(degree + 1)}
    return Jet(numbers[:9].reshape(3, 3), rows)


def our_jet(field: DirectionField) -> Jet:
    """The coefficients at the one point of a field."""
    rows = {
        k: np.array([field.coefficient(k, int(n))[0] for n in every(k)])
        for k in range(int(field.degree[0]) + 1)
    }
    return Jet(field.frames[0], rows)


def row_error(found: Jet, exact: Jet, order: int) -> float:
    """Error of a row, whichever side its normal is on."""
    vectors = exact.vectors(np.pi * (np.arange(48) + 0.5) / 24)
    side = np.sign(found.frame[2] @ exact.frame[2])
    truth = exact.along(order, vectors)
    difference = side * found.along(order, vectors) - truth
    return float(np.linalg.norm(difference) / np.linalg.norm(truth))


def ring_surface(degree: int, rng) -> tuple[np.ndarray, Jet]:
    """An exact polynomial over rings, whose principal plane is z = 0, and its coefficients.

    Equally spaced points of a ring feel only the frequencies +1 and -1 in the covariance of x and
    y with z, and these are left out.
    """
    radius, theta = np.meshgrid(np.linspace(0.15, 0.9, 8), 2 * np.pi * np.arange(24) / 24)
    r, t = radius.ravel(), theta.ravel()
    z = np.zeros_like(r)
    rows = {}
    for order in range(2, degree + 1):
        n = every(order)
        row = 0.02 * (rng.normal(size=order + 1) + 1j * rng.normal(size=order + 1))
        row = np.where(np.abs(n) == 1, 0.0, row + np.conj(row[::-1]))
        z += r**order * (np.exp(1j * np.outer(t, n)) @ row).real
        rows[order] = row
    points = np.column_stack([r * np.cos(t), r * np.sin(t), z])
    return np.vstack([np.zeros(3), points]), Jet(np.eye(3), rows)


def is_sound(peer: Peer, program: Path) -> bool:
    """Whether a code finds exact polynomials in the frame that ours is given; says if not."""
    rng = np.random.default_rng(3)
    for degree in peer.degrees:
        points, exact = ring_surface(degree, rng)
        numbers = run(program, degree, as_text(points, np.array([0]), 1.0))[1][0]
        field = estimate_directions(
            points, queries=[0], radius=1.0, degree=degree, orders=(2,), frame="given",
            normals=np.tile(exact.frame[2], (len(points), 1)),
        )  # fmt: skip
        mine = our_jet(field)
        wrong = {"ours": max(row_error(mine, exact, k) for k in exact.rows)}
        if peer.curvatures:
            # The mean curvature 2 phi_{2,0} is the same along any two axes of the plane.
            mean = 2 * exact.rows[2][1].real * np.sign(numbers[5])
            wrong["theirs"] = abs(numbers[2] / mean - 1.0)
        else:
            theirs = their_jet(numbers, degree)
            wrong["theirs"] = max(row_error(theirs, exact, k) for k in exact.rows)
        listed = ", ".join(f"{name} {value:.1e}" for name, value in wrong.items())
        print(f"{peer.name} K={degree}, exact polynomial, error: {listed}", flush=True)
        if not max(wrong.values()) < EXACT:
            print(f"{peer.name} misses an exact polynomial; no figures for it.", file=sys.stderr)
            return False
    return True


def speed(peer: Peer, program: Path, queries: int) -> None:
    """Print the times of one code beside ours."""
    points, normals = torus_points(20_000)
    for degree in peer.degrees:
        for neighbours in (100, 300):
            text = as_text(points, np.arange(queries), radius_for(neighbours, len(points)))
            orders = tuple(range(2, degree + 1))
            mine, theirs = alternate(
                ours(points, normals, neighbours, degree, orders, uncertainty=False),
                lambda degree=degree, text=text: run(program, degree, text)[0] / queries,
            )
            row = {"ours us": 1e6 * statistics.median(mine)}
            row |= {"theirs us": 1e6 * statistics.median(theirs), **spread_of_ratio(theirs, mine)}
            show(f"{peer.name} K={degree} N={neighbours}", row)


def random_graph(sigma: float, rng, top: int) -> tuple[np.ndarray, Jet]:
    """The graph of a random polynomial of degree `top`, the query first, and its jet there."""
    c = [0.4**d * rng.normal(size=d + 1) if d > 1 else np.zeros(d + 1) for d in range(top + 1)]
    r, t = np.sqrt(rng.random(300)), 2 * np.pi * rng.random(300)
    r[0] = 0.0

    def g(order: int, theta: np.ndarray) -> np.ndarray:
        b = np.arange(order + 1)
        return np.cos(theta)[:, None] ** (order - b) * np.sin(theta)[:, None] ** b @ c[order]

    z = sum(r**d * g(d, t) for d in range(top + 1)) + sigma * rng.normal(size=300)
    rows = {}
    for order in range(2, min(top, max(ORDERS)) + 1):
        theta = np.pi * np.arange(order + 1) / (order + 1)
        rows[order] = np.linalg.solve(np.exp(1j * np.outer(theta, every(order))), g(order, theta))
    frame = special_ortho_group.rvs(3, random_state=rng)
    return np.column_stack([r * np.cos(t), r * np.sin(t), z]) @ frame, Jet(frame, rows)


def degrees_apart(exact: np.ndarray, found: np.ndarray) -> np.ndarray:
    """For each exact line (D, 3) the angle to the nearest one found."""
    found = found / np.linalg.norm(found, axis=1, keepdims=True)
    chords = [np.linalg.norm(exact[:, None] - side * found, axis=2) for side in (1, -1)]
    chord = np.minimum(*chords).min(axis=1)
    return np.degrees(2 * np.arcsin(np.minimum(chord / 2, 1.0)))


def errors_of_rows(exact: Jet, found: Jet) -> dict[str, np.ndarray]:
    """Errors of the normal, and of the rows and directions of some orders."""
    normal = exact.frame[2:]
    errors = {"normal, degrees": degrees_apart(normal, found.frame[2:])}
    for k in ORDERS:
        errors[f"order {k}, row"] = np.array([row_error(found, exact, k)])
        lines = found.lines(k)
        flat = lines - (lines @ normal.T) * normal
        errors[f"order {k}, degrees"] = degrees_apart(exact.lines(k), flat)
    return errors


def errors_of_curvatures(exact: Jet, normal: np.ndarray, two: np.ndarray) -> dict[str, np.ndarray]:
    """Errors of the normal, of the mean curvature and of the larger one."""
    side = np.sign(normal @ exact.frame[2])
    truth = 2 * exact.rows[2][1].real + 4 * np.abs(exact.rows[2][0]) * np.array([1, -1])
    larger, found = (pair[np.argmax(np.abs(pair))] for pair in (truth, side * two))
    return {
        "normal, degrees": degrees_apart(exact.frame[2:], normal[None]),
        "mean curvature": np.array([abs((side * two).mean() - truth.mean()) / abs(larger)]),
        "larger curvature": np.array([abs(found - larger) / abs(larger)]),
    }


def both_errors(peer: Peer, exact: Jet, field: DirectionField, numbers: np.ndarray):
    """Errors on one graph, ours and theirs."""
    mine, degree = our_jet(field), int(field.degree[0])
    if not peer.curvatures:
        return errors_of_rows(exact, mine), errors_of_rows(exact, their_jet(numbers, degree))
    values = field[2].eigenvalue
    return (
        errors_of_curvatures(exact, mine.frame[2], np.array([values.min(), values.max()])),
        errors_of_curvatures(exact, numbers[3:6], numbers[:2]),
    )


def accuracy(peer: Peer, program: Path, graphs: int) -> None:
    """Print the errors of one code beside ours."""
    surfaces = [(12, sigma) for sigma in NOISE]
    for degree in peer.degrees:
        for top, sigma in [(2, 0.0), *surfaces] if peer.curvatures else surfaces:
            rng = np.random.default_rng(4)
            table = []
            for _ in range(graphs):
                points, exact = random_graph(sigma, rng, top)
                field = estimate_directions(
                    points, queries=[0], radius=1.0, degree=degree, orders=(2,), threads=1,
                    normals=np.tile(exact.frame[2], (len(points), 1)), uncertainty=False,
                )  # fmt: skip
                numbers = run(program, degree, as_text(points, np.array([0]), 1.0))[1][0]
                table.append(both_errors(peer, exact, field, numbers))
            surface = "exact quadrics" if top == 2 else f"noise {sigma:g}"
            print(f"{peer.name} K={degree}, {surface}, ours / theirs:", flush=True)
            for name in table[0][0]:
                mine, theirs = (
                    np.median(np.concatenate([errors[side][name] for errors in table]))
                    for side in (0, 1)
                )
                print(f"    {name:18s} {mine:.2g} / {theirs:.2g}", flush=True)


def main() -> None:
    """Check each code, and print the tables asked for."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("tables", nargs="*", help="speed, accuracy or both")
    parser.add_argument("--sources", type=Path, nargs="+", required=True, metavar="FOLDER")
    parser.add_argument("--eigen", type=Path, default=Path("/usr/include/eigen3"))
    parser.add_argument("--build", type=Path, default=Path(tempfile.gettempdir()))
    parser.add_argument("--queries", type=int, default=200)
    parser.add_argument("--graphs", type=int, default=200)
    options = parser.parse_args()
    wanted = options.tables or ["speed", "accuracy"]
    for name in wanted:
        if name not in ("speed", "accuracy"):
            raise refusal(
                f"there is no table {name!r}; name speed or accuracy, or neither for both."
            )
    found = [(find_peer(folder), folder) for folder in options.sources]
    unsound = False
    for peer, folder in found:
        program = build(peer, folder, options.eigen, options.build)
        if not is_sound(peer, program):
            unsound = True
            continue
        if "speed" in wanted:
            speed(peer, program, options.queries)
        if "accuracy" in wanted:
            accuracy(peer, program, options.graphs)
    raise SystemExit(1 if unsound else 0)


if __name__ == "__main__":
    main()
