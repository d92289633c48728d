"""Speed of the point-set engine against peers, in the same run.

    uv run python benchmarks/pointset.py [--build FOLDER] [--peers PYTHON] [--stages]

Every figure is the median of five timings by processor time of one thread, unless said otherwise;
peers see the same neighbourhoods. CGAL is used if g++ and its headers are there (Debian: g++,
libcgal-dev, libeigen3-dev), libigl if `--peers` names a Python that has it. Compiled peers go to
the folder `--build`. A row with a goal says whether it was met. `--stages` prints the time of the
stages of the fit instead, in nanoseconds a point.
"""

from __future__ import annotations

import argparse
import json
import os
import shutil
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

# The threads of a matrix product wait busily for the next one, on the clock of what follows.
os.environ["OPENBLAS_NUM_THREADS"] = "1"

import numpy as np
from scipy.spatial import cKDTree

from pdtheory.pointset import estimate_directions

HERE = Path(__file__).parent
REPEATS = 5
ORDERS = tuple(range(2, 11))


def torus_points(count: int, seed: int = 1) -> tuple[np.ndarray, np.ndarray]:
    """Uniform points on a torus with radii 1 and 0.4, and their normals."""
    rng = np.random.default_rng(seed)
    v = np.empty(0)
    while len(v) < count:
        trial = 2 * np.pi * rng.random(count)
        v = np.append(v, trial[rng.random(count) < (1 + 0.4 * np.cos(trial)) / 1.4])
    v, u = v[:count], 2 * np.pi * rng.random(count)
    ring = 1 + 0.4 * np.cos(v)
    points = np.column_stack([ring * np.cos(u), ring * np.sin(u), 0.4 * np.sin(v)])
    normals = np.column_stack([np.cos(v) * np.cos(u), np.cos(v) * np.sin(u), np.sin(v)])
    return points, normals


def radius_for(neighbours: int, count: int) -> float:
    """Radius that holds so many of `count` uniform points on the torus on average."""
    return float(np.sqrt(neighbours * 4 * np.pi**2 * 0.4 / count / np.pi))


def refusal(sentence: str) -> SystemExit:
    """What to raise to end with code 2, having said what is missing."""
    print(sentence, file=sys.stderr)
    return SystemExit(2)


def check_peers(python: str, *modules: str) -> None:
    """Refuse a Python that is not there or lacks a module."""
    for module in modules:
        try:
            done = subprocess.run([python, "-c", f"import {module}"], capture_output=True)
        except OSError as error:
            raise refusal(
                f"cannot run {python}: {error.strerror}; name a Python that has {module}."
            ) from None
        if done.returncode:
            raise refusal(f"{python} cannot import {module}; name a Python that has it.")


def once(action, clock=time.process_time) -> float:
    """Seconds that one call takes."""
    start = clock()
    action()
    return clock() - start


def median_time(action) -> float:
    """Median of five timings by processor time."""
    return statistics.median(once(action) for _ in range(REPEATS))


def alternate(*actions) -> list[list[float]]:
    """Results of each action, called in turns.

    The speed of a shared machine changes from second to second, so what is compared must alternate.
    """
    for action in actions:
        action()
    rounds = [[action() for action in actions] for _ in range(REPEATS)]
    return [list(results) for results in zip(*rounds, strict=True)]


def ours(points, normals, neighbours, degree, orders, clock=time.process_time, **options):
    """Return a function for seconds per point, everything included, in one thread by default."""
    radius = radius_for(neighbours, len(points))
    how = {"radius": radius, "degree": degree, "orders": orders, "normals": normals, "threads": 1}

    def run():
        estimate_directions(points, **(how | options))

    return lambda: once(run, clock) / len(points)


def build_cgal(folder: Path) -> Path | None:
    """Compile the CGAL driver; None if that is not possible here."""
    headers = Path("/usr/include/CGAL"), Path("/usr/include/eigen3")
    if shutil.which("g++") is None or not all(path.exists() for path in headers):
        return None
    folder.mkdir(parents=True, exist_ok=True)
    program = folder / "jet_fitting"
    if not program.exists():
        command = ["g++", "-O3", "-march=native", "-DNDEBUG", "-DCGAL_EIGEN3_ENABLED"]
        command += ["-I/usr/include/eigen3", str(HERE / "peers_pointset" / "jet_fitting.cpp")]
        subprocess.run([*command, "-o", str(program), "-lgmp", "-lmpfr"], check=True)
    return program


def cgal_input(points, queries: int, radius: float) -> str:
    """The neighbourhoods of the first points, as the CGAL driver reads them."""
    text = [str(queries)]
    for i, members in enumerate(cKDTree(points).query_ball_point(points[:queries], radius)):
        text.append(str(len(members)))
        rows = [i, *(j for j in members if j != i)]
        text += [" ".join(map(repr, map(float, points[j]))) for j in rows]
    return "\n".join(text)


def run_cgal(program: Path, degree: int, solver: str, text: str) -> tuple[float, np.ndarray]:
    """Seconds of the fits, and rows of both curvatures, the larger first, and its direction."""
    done = subprocess.run(
        [program, str(degree), solver], input=text, capture_output=True, text=True, check=True
    )
    return float(done.stderr), np.array([line.split() for line in done.stdout.splitlines()], float)


def cgal(program: Path, points, neighbours: int, degree: int, solver: str, queries: int):
    """Return a function for seconds per point of CGAL, fitting only, on the same neighbourhoods."""
    text = cgal_input(points, queries, radius_for(neighbours, len(points)))
    return lambda: run_cgal(program, degree, solver, text)[0] / queries


def torus_mesh(count: int) -> tuple[np.ndarray, np.ndarray]:
    """A regular triangulation of the torus with count x count vertices."""
    u, v = np.meshgrid(np.arange(count), np.arange(count), indexing="ij")
    a, b = 2 * np.pi * u.ravel() / count, 2 * np.pi * v.ravel() / count
    ring = 1 + 0.4 * np.cos(b)
    points = np.column_stack([ring * np.cos(a), ring * np.sin(a), 0.4 * np.sin(b)])
    corner = (u * count + v).ravel()
    right = ((u + 1) % count * count + v).ravel()
    up = (u * count + (v + 1) % count).ravel()
    across = ((u + 1) % count * count + (v + 1) % count).ravel()
    faces = np.concatenate([np.column_stack([corner, right, across]),
                            np.column_stack([corner, across, up])])  # fmt: skip
    return points, faces


IGL = """
import json, sys, time
import igl, numpy as np
data = np.load(sys.argv[1])
start = time.process_time()
result = igl.principal_curvature(data["points"], data["faces"], radius=5)
seconds = time.process_time() - start
curvatures = np.sort(np.column_stack([np.ravel(result[2]), np.ravel(result[3])]), axis=1)
np.save(sys.argv[2], curvatures)
print(json.dumps(seconds / len(data["points"])))
"""


def igl_row(python: str, folder: Path) -> dict[str, float]:
    """libigl with 5 rings against K = 4 with 100 neighbours on average, on one mesh."""
    points, faces = torus_mesh(140)
    np.savez(folder / "mesh.npz", points=points, faces=faces)

    def theirs() -> float:
        done = subprocess.run(
            [python, "-c", IGL, str(folder / "mesh.npz"), str(folder / "igl.npy")],
            capture_output=True, text=True, check=True,
        )  # fmt: skip
        return float(json.loads(done.stdout))

    ring = np.linalg.norm(points[:, :2], axis=1)
    normals = points - np.column_stack([points[:, :2] / ring[:, None], 0 * points[:, :1]])
    radius = np.mean(cKDTree(points).query(points[::50], k=[100])[0])
    how = {"radius": radius, "degree": 4, "orders": (2,), "normals": normals, "threads": 1}
    field = estimate_directions(points, uncertainty=False, **how)

    def run() -> None:
        estimate_directions(points, uncertainty=False, **how)

    peer, mine = alternate(theirs, lambda: once(run) / len(points))
    exact = np.sort(np.column_stack([np.full(len(points), 2.5), (ring - 1) / 0.4 / ring]), axis=1)
    curvatures = np.load(folder / "igl.npy")
    if np.median(curvatures) < 0:
        curvatures = np.sort(-curvatures, axis=1)
    found = np.sort(-np.column_stack(
        [field[2].maxima.eigenvalue[::2], field[2].minima.eigenvalue[::2]]), axis=1)  # fmt: skip
    return {
        "neighbours": float(field.neighbours.mean()),
        "libigl us": 1e6 * statistics.median(peer),
        "ours us": 1e6 * statistics.median(mine),
        **spread_of_ratio(peer, mine),
        "libigl median error": float(np.median(np.abs(curvatures - exact))),
        "ours median error": float(np.median(np.abs(found - exact))),
    }


FIRST = """
import time
start = time.process_time()
import numpy as np
from pdtheory.pointset import estimate_directions
xy = np.random.default_rng(0).uniform(-1, 1, (2000, 2))
points = np.column_stack([xy, 0.3 * xy[:, 0] ** 2 - 0.2 * xy[:, 1] ** 2])
estimate_directions(points, radius=0.5, orient="none", queries=[0], threads=1)
print(time.process_time() - start)
"""


LEAST = """
import time
start = time.process_time()
import numba, numpy as np
numba.njit(cache=True)(lambda a, b: a + b)(np.zeros(3), np.zeros(3))
print(time.process_time() - start)
"""


def first_result(folder: Path, script: str, fresh: bool) -> float:
    """Processor seconds of a new process to its first result, imports included."""
    cache = folder / "kernels"
    if fresh:
        shutil.rmtree(cache, ignore_errors=True)
    # Numba keeps nothing of what has no file.
    file = folder / "first_result.py"
    file.write_text(script)
    done = subprocess.run(
        [sys.executable, file], capture_output=True, text=True, check=True,
        env={**os.environ, "NUMBA_CACHE_DIR": str(cache)},
    )  # fmt: skip
    return float(done.stdout)


def serve() -> None:
    """Time one thread whenever a line comes in; what `Pair` starts."""
    run = ours(*torus_points(20_000), 300, 10, ORDERS, time.perf_counter)
    run()
    print("ready", flush=True)
    for _ in sys.stdin:
        print(run(), flush=True)


class Pair:
    """Two processes that know nothing of each other: what the machine gives to two threads."""

    def __init__(self) -> None:
        command = [sys.executable, "-c", "from pointset import serve; serve()"]
        pipes = {"stdin": subprocess.PIPE, "stdout": subprocess.PIPE, "text": True, "cwd": HERE}
        self._processes = [subprocess.Popen(command, **pipes) for _ in range(2)]
        self._answers()

    def _answers(self) -> list[str]:
        return [process.stdout.readline() for process in self._processes]

    def __call__(self) -> float:
        """Seconds per point of both together."""
        for process in self._processes:
            process.stdin.write("\n")
            process.stdin.flush()
        return statistics.mean(map(float, self._answers())) / 2

    def close(self) -> None:
        """End the processes."""
        for process in self._processes:
            process.communicate()


def dgemm_rate() -> float:
    """Floating-point operations per second of a matrix product, by processor time."""
    a = np.random.default_rng(0).random((700, 700))
    return 2 * 700**3 / median_time(lambda: a @ a)


def spread_of_ratio(above: list[float], below: list[float]) -> dict[str, float]:
    """The median ratio of paired timings, the smallest and the largest."""
    ratios = [a / b for a, b in zip(above, below, strict=True)]
    return {"ratio": statistics.median(ratios), "from": min(ratios), "to": max(ratios)}


def show(name: str, row: dict[str, float], goal: str = "", met: bool | None = None) -> None:
    """Print one row, with its goal if it has one."""
    text = f"{name:34s} " + "  ".join(f"{k} {v:.4g}" for k, v in row.items())
    if met is not None:
        text += f"  [goal {goal}: {'met' if met else 'not met'}]"
    print(text, flush=True)


STAGES = (
    "gather",
    "weights",
    "frame",
    "projection",
    "sums",
    "matrix",
    "matrix and factor",
    "solution",
    "residuals",
    "shift",
    "phi",
    "whole fit",
)


def stages() -> None:
    """Print the median time of each stage of a fit, one thread, on one neighbourhood of a torus."""
    import numba

    from pdtheory.pointset.kernels import (
        cholesky,
        chunk,
        fit,
        grid,
        moments,
        regression,
        tilting,
        weighing,
    )
    from pdtheory.pointset.kernels.lanes import LANES
    from pdtheory.pointset.kernels.tables import WORKSPACE, make_cloud, make_record, make_tables

    @numba.njit(nogil=True, error_model="numpy", fastmath={"reassoc", "contract", "arcp", "nsz"})
    def stage(  # pragma: no cover
        number, times, cells, query, normal, radius, settings, tables, cloud, points, n, w, phi
    ):
        degree = settings.degree
        count = (degree + 1) * (degree + 2) // 2
        done = fit.Fit(0, degree, degree, 0.0, 0.0, 0.0, 1.0, points, True)
        for _ in range(times):
            if number == 0:
                grid.locate(cells, query, w.cells[1])
                here = w.cells[1]
                runs, _ = grid.find_runs(cells, here[0], here[1], here[2], w.runs)
                grid.gather(cells.columns, w.runs, runs, query, 1.0, radius, cloud)
                for i in range(points, n):
                    cloud[moments.SQUARED, i] = weighing.OUTSIDE
            elif number == 1:
                weighing.weigh(cloud, n)
            elif number == 2:
                fit.choose_frame(cloud, n, normal, settings, w)
            elif number == 3:
                weighing.project(cloud, points, n, False, w)
            elif number == 4:
                moments.sum_moments(cloud, moments.WEIGHT, n, 2 * degree, degree, w)
            elif number == 5:
                cholesky.fill_gram(w.sums, w.heights, degree, w.ordered, w.G)
            elif number == 6:
                cholesky.fill_gram(w.sums, w.heights, degree, w.ordered, w.G)
                cholesky.factor(w.G, count, w.diagonal, w.pivots, w.inverses)
            elif number == 7:
                for i in range(1, count + 1):
                    w.y[i] = w.G[i, 0]
                cholesky.solve_lower(w.G, count, w.inverses, w.y, w.c)
            elif number == 8:
                regression.misfit(cloud, n, degree, 1.0, w)
            elif number == 9:
                tilting.shift(w.c, degree, 1e-9, 1e-9, w.table)
            elif number == 10:
                chunk._write_phi(w.c, done, 0.8, 0.6, radius, tables, w, phi)
            else:
                fit.fit_point(cloud, points, n, normal, settings, w)
        return points

    all_points, normals = torus_points(20_000)
    for degree, neighbours in ((10, 300), (10, 100), (4, 300), (4, 100)):
        radius = radius_for(neighbours, len(all_points))
        cells, _ = grid.build_grid(all_points, radius)
        points = len(cKDTree(all_points).query_ball_point(all_points[7], radius))
        n = -(-points // LANES) * LANES
        cloud = make_cloud(1024)
        settings = fit.Settings(degree, fit.FRAME_TANGENT, False, False, False, True)
        phi = np.empty((degree + 2) ** 2 // 4, np.complex128)
        fixed = (cells, all_points[7], normals[7], radius, settings, make_tables(), cloud)
        fixed += (points, n, make_record(WORKSPACE), phi)
        row = {}
        for number, name in enumerate(STAGES):
            stage(number, 1, *fixed)
            row[name] = 1e6 * median_time(lambda k=number: stage(k, 1000, *fixed))  # noqa: B023
        show(f"K={degree} N={points}, ns", row)
        sums = (2 * degree + 1) * (degree + 1) + (degree + 1) * (degree + 2) // 2
        share = 2 * n * sums / (1e-9 * row["sums"] * dgemm_rate())
        goal = (">= 60", 100 * share >= 60.0) if neighbours == 300 and degree == 10 else ()
        show("  sums, of a matrix product", {"percent": 100 * share}, *goal)


def main() -> None:
    """Run all rows."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--build", type=Path, default=Path(tempfile.gettempdir()))
    parser.add_argument("--peers", help="a Python with libigl")
    parser.add_argument("--queries", type=int, default=400)
    parser.add_argument("--stages", action="store_true", help="time the stages of the fit")
    options = parser.parse_args()
    if options.stages:
        stages()
        return
    if options.peers:
        check_peers(options.peers, "igl")
    points, normals = torus_points(20_000)
    program = build_cgal(options.build)
    plain = {"uncertainty": False}
    for name, count, degree, orders, solver, least in (
        ("K=10 N=300, CGAL SVD", 300, 10, ORDERS, "svd", 100),
        ("K=10 N=100, CGAL SVD", 100, 10, ORDERS, "svd", 75),
        ("K=10 N=300, CGAL QR, fit only", 300, 10, (1,), "qr", 60),
        ("K=4 N=300, CGAL SVD", 300, 4, (2, 3, 4), "svd", 30),
    ):
        fit_only = {"frame": "principal"} if orders == (1,) else {}
        actions = [ours(points, normals, count, degree, orders, **plain, **fit_only)]
        if program is not None:
            actions.append(cgal(program, points, count, degree, solver, options.queries))
        times = alternate(*actions)
        mine = statistics.median(times[0])
        row = {"ours us": 1e6 * mine}
        if program is not None:
            row |= {"CGAL us": 1e6 * statistics.median(times[1])}
            row |= spread_of_ratio(times[1], times[0])
        met = row["ratio"] >= least if "ratio" in row else None
        show(name, row, f">= {least}", met)
        if orders == (1,):
            # Sums for 231 moments and 66 heights, the factor of a 66 x 66 matrix, and two solves.
            operations = 2 * 300 * (231 + 66) + 66**3 / 3 + 4 * 66**2
            percent = 100 * operations / dgemm_rate() / mine
            show("  of a matrix product", {"percent": percent}, ">= 22", percent >= 22)
    if options.peers:
        row = igl_row(options.peers, options.build)
        better = row["ours median error"] < row["libigl median error"]
        show("K=4 N=100, libigl 5 rings", row, ">= 3, smaller error", row["ratio"] >= 3 and better)
    bars, bare, robust = alternate(
        ours(points, normals, 300, 10, ORDERS),
        ours(points, normals, 300, 10, ORDERS, **plain),
        ours(points, normals, 300, 10, ORDERS, norm="l1", **plain),
    )
    row = {"us with": 1e6 * statistics.median(bars), "us without": 1e6 * statistics.median(bare)}
    show("error bars, K=10 N=300", row)
    row = {"us": 1e6 * statistics.median(robust)} | spread_of_ratio(robust, bare)
    show("l1 over l2, K=10 N=300", row, "<= 4", row["ratio"] <= 4)
    pair = Pair()
    one, two, both = alternate(
        *(ours(points, normals, 300, 10, ORDERS, time.perf_counter, threads=n) for n in (1, 2)),
        pair,
    )
    pair.close()
    row = {"us one": 1e6 * statistics.median(one), "us two": 1e6 * statistics.median(two)}
    row |= spread_of_ratio(one, two)
    show("two threads against one, wall", row, ">= 1.9", row["ratio"] >= 1.9)
    show("  two processes against one", spread_of_ratio(one, both))
    for name, most in (("not cached", 8.0), ("cached", 0.7)):
        fresh = name == "not cached"
        times = sorted(first_result(options.build, FIRST, fresh) for _ in range(REPEATS))
        row = {"s": statistics.median(times), "from": times[0], "to": times[-1]}
        show(f"first result, {name}", row, f"<= {most}", row["s"] <= most)
    first_result(options.build, LEAST, fresh=False)
    least = statistics.median(first_result(options.build, LEAST, False) for _ in range(REPEATS))
    show("  of which any function of Numba", {"s": least})


if __name__ == "__main__":
    main()
