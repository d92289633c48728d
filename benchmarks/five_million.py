"""Time, memory and disk of a run to a folder, and the cost per point against a small one.

    uv run python benchmarks/five_million.py [--points 5000000] [--folder FOLDER] [--resume]
        [--neighbours 300] [--degree 10] [--uncertainty]

A torus with N = 300 neighbours in the radius, K = 10, orders 2 to 8 (none above K), all points as
queries, normals given, all cores. Every run is a process of its own, so that its peak memory is its
own; what is timed is the whole process: start, reading the points, kernels, neighbours, fits,
directions and writing. With --resume the large run goes on where an earlier one was stopped, and
its time is that of the rest.
"""

from __future__ import annotations

import argparse
import resource
import shutil
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import numpy as np
from pointset import radius_for, torus_points

SMALL = 200_000


def run(options: argparse.Namespace) -> None:
    """The run itself; prints its seconds and its peak memory in bytes."""
    start = time.perf_counter()
    from pdtheory.pointset import PointCloud, estimate_to_disk

    with np.load(options.run) as data:
        cloud = PointCloud(data["points"], data["normals"])
    estimate_to_disk(
        cloud, options.folder, resume=options.resume, degree=options.degree,
        radius=radius_for(options.neighbours, len(cloud)),
        orders=range(2, min(8, options.degree) + 1), uncertainty=options.uncertainty,
    )  # fmt: skip
    seconds = time.perf_counter() - start
    peak = 1024 * resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    print(seconds, peak)


def measure(
    count: int, folder: Path, resume: bool, options: argparse.Namespace
) -> tuple[float, float, int]:
    """Seconds and peak memory of one run in a fresh process, and the size of its folder."""
    source = folder.with_suffix(".points.npz")
    points, normals = torus_points(count)
    np.savez(source, points=points, normals=normals)
    if not resume:
        shutil.rmtree(folder, ignore_errors=True)
    del points, normals
    command = [sys.executable, __file__, "--run", str(source), "--folder", str(folder)]
    command += ["--neighbours", str(options.neighbours), "--degree", str(options.degree)]
    command += ["--resume"] * resume + ["--uncertainty"] * options.uncertainty
    done = subprocess.run(command, capture_output=True, text=True)
    source.unlink()
    if done.returncode:
        raise SystemExit(done.stderr)
    seconds, peak = map(float, done.stdout.split())
    return seconds, peak, sum(path.stat().st_size for path in folder.iterdir())


def main() -> None:
    """Print a row for the small run and one for the large."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--points", type=int, default=5_000_000)
    parser.add_argument("--neighbours", type=int, default=300)
    parser.add_argument("--degree", type=int, default=10)
    parser.add_argument("--folder", type=Path, help="where the results go; kept if given")
    parser.add_argument("--resume", action="store_true")
    parser.add_argument("--uncertainty", action="store_true", help="with error bars")
    parser.add_argument("--run", type=Path, help=argparse.SUPPRESS)
    options = parser.parse_args()
    if options.run is not None:
        run(options)
        return
    with tempfile.TemporaryDirectory() as scratch:
        folder = options.folder or Path(scratch) / "large"
        costs = []
        print("    points    seconds  us/point   peak GB   disk GB")
        for count, place, resume in (
            (SMALL, Path(scratch) / "small", False),
            (options.points, folder, options.resume),
        ):
            seconds, peak, disk = measure(count, place, resume, options)
            costs.append(seconds / count)
            print(
                f"{count:10,d} {seconds:10.1f} {1e6 * costs[-1]:9.1f} {peak / 1e9:9.2f} "
                f"{disk / 1e9:9.2f}",
                flush=True,
            )
    print(f"cost per point, large over small: {costs[1] / costs[0]:.3f}")


if __name__ == "__main__":
    main()
