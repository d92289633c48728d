"""Order 2 against MeshLab's APSS, an algebraic sphere fitted to points with normals.

    uv run python benchmarks/meshlab.py --peers PYTHON

PYTHON is one that has PyMeshLab. The same 20,000 points of a torus of radii 1 and 0.4 go to both,
moved along the normal by noise; their normals stay exact. APSS fits to them, pdtheory takes only
the side from them. How far APSS reaches at a scale is measured: one normal is turned, and the
farthest point whose curvature changes counts. pdtheory gets as many neighbours as lie within that
reach. Times are processor time a point, one thread, the median of five, on a busy machine to within
a half; errors are medians over all points, of the larger curvature and of its direction.
"""

from __future__ import annotations

import argparse
import subprocess
import tempfile
from pathlib import Path

import numpy as np
from pointset import check_peers, median_time
from scipy.spatial import cKDTree

import synthetic_surfaces
from pdtheory.pointset import DirectionField, PointCloud, estimate_directions

MAJOR, MINOR = 1.0, 0.4
COUNT = 20_000
SCALES = (2.0, 4.0, 6.0)
NOISE = (0.0, 0.0005, 0.002)

_PEER = """
import sys, time
import numpy as np
import pymeshlab
data = np.load(sys.argv[1])
results = {}
for key in data.files:
    scale, turned = key.split(":")
    times = []
    for _ in range(5 if turned == "no" else 1):
        meshes = pymeshlab.MeshSet(verbose=False)
        meshes.add_mesh(pymeshlab.Mesh(data[key][0], v_normals_matrix=data[key][1]))
        start = time.process_time()
        meshes.compute_curvature_and_color_apss_per_vertex(
            filterscale=float(scale), curvaturetype="K1"
        )
        times.append(time.process_time() - start)
    mesh = meshes.current_mesh()
    results[key + ":time"] = np.median(times)
    results[key + ":k1"] = mesh.vertex_scalar_array()
    results[key + ":first"] = mesh.vertex_curvature_principal_dir1_matrix()
    results[key + ":second"] = mesh.vertex_curvature_principal_dir2_matrix()
np.savez(sys.argv[2], **results)
"""


def main() -> None:
    """Print a row for each noise, reach and tool."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--peers", required=True, help="a Python with PyMeshLab")
    peer = parser.parse_args().peers
    check_peers(peer, "pymeshlab")
    torus = synthetic_surfaces.get("torus", major=MAJOR, minor=MINOR).sample(COUNT, seed=1)
    heads = ("noise", "reach", "N", "tool", "us", "curvature", "degrees")
    print("{:>7} {:>6} {:>5} {:>18} {:>6} {:>11} {:>8}".format(*heads))
    for noise in NOISE:
        shift = noise * np.random.default_rng(2).standard_normal((COUNT, 1))
        cloud = PointCloud(torus.points + shift * torus.normals, torus.normals)
        found = _meshlab(peer, cloud)
        for scale in SCALES:
            reach, neighbours = _reach(cloud, found, scale)
            key = f"{scale}:no"
            rows = [("APSS", float(found[key + ":time"]), *_apss_errors(torus, found, key))]
            for degree in (2, 4):
                if neighbours < (degree + 1) * (degree + 2):
                    continue
                rows.append(
                    (f"pdtheory, degree {degree}", *_ours(cloud, torus, neighbours, degree))
                )
            for name, seconds, curvature, degrees in rows:
                print(
                    f"{noise:7g} {reach:6.3f} {neighbours:5d} {name:>18} "
                    f"{1e6 * seconds / COUNT:6.1f} {100 * curvature:9.2g} % {degrees:8.2g}"
                )


def _meshlab(peer: str, cloud: PointCloud) -> dict[str, np.ndarray]:
    turned = cloud.normals.copy()
    turned[0] = np.roll(turned[0], 1)
    jobs = {f"{s}:no": np.stack([cloud.points, cloud.normals]) for s in SCALES}
    jobs |= {f"{s}:yes": np.stack([cloud.points, turned]) for s in SCALES}
    with tempfile.TemporaryDirectory() as folder:
        asked, told = Path(folder) / "in.npz", Path(folder) / "out.npz"
        np.savez(asked, **jobs)
        subprocess.run([peer, "-c", _PEER, str(asked), str(told)], check=True)
        with np.load(told) as answer:
            return dict(answer)


def _reach(cloud: PointCloud, found: dict[str, np.ndarray], scale: float) -> tuple[float, int]:
    """Return how far the influence of one normal goes, and the points within that distance."""
    changed = found[f"{scale}:no:k1"] != found[f"{scale}:yes:k1"]
    distance = np.linalg.norm(cloud.points - cloud.points[0], axis=1)
    reach = float(distance[changed].max())
    counts = cKDTree(cloud.points).query_ball_point(cloud.points, reach, return_length=True)
    return reach, int(np.median(counts))


def _truth(torus: PointCloud) -> tuple[float, np.ndarray]:
    """Return the curvature along the small circles, the larger everywhere, and its direction."""
    ring = np.hypot(torus.points[:, 0], torus.points[:, 1])
    outward = torus.points * [1.0, 1.0, 0.0] / ring[:, None]
    around = np.cross([0.0, 0.0, 1.0], outward)
    return 1.0 / MINOR, np.cross(torus.normals, around)


def _errors(value: np.ndarray, vector: np.ndarray, torus: PointCloud) -> tuple[float, float]:
    exact, direction = _truth(torus)
    cosine = np.abs(np.einsum("ij,ij->i", vector, direction))
    sine = np.linalg.norm(np.cross(vector, direction), axis=1)
    angle = np.degrees(np.arctan2(sine, cosine))
    return float(np.median(np.abs(np.abs(value) / exact - 1.0))), float(np.median(angle))


def _apss_errors(torus: PointCloud, found: dict[str, np.ndarray], key: str) -> tuple[float, float]:
    # Which of the two directions belongs to K1 is not said: the better one counts.
    value = found[key + ":k1"]
    both = [_errors(value, found[key + name], torus) for name in (":first", ":second")]
    return min(both, key=lambda pair: pair[1])


def _ours(
    cloud: PointCloud, torus: PointCloud, neighbours: int, degree: int
) -> tuple[float, float, float]:
    def run() -> DirectionField:
        return estimate_directions(
            cloud, neighbours=neighbours, degree=degree, orders=(2,), threads=1
        )

    rows = run()[2]
    largest = np.array([part.argmax() for part in map(np.abs, rows.eigenvalues)])
    pick = rows.offsets[:-1] + largest
    return median_time(run), *_errors(rows.eigenvalue[pick], rows.vector[pick], torus)


if __name__ == "__main__":
    main()
