"""Reading: every format gives the points, order and sides of the file."""

from __future__ import annotations

import os
from pathlib import Path

import numpy as np
import pytest
import trimesh

from pdtheory.errors import (
    FileAccessError,
    FileFormatError,
    InputError,
    MissingDependencyError,
    PdtheoryError,
)
from pdtheory.io import read_cloud
from pdtheory.io.meshes import winding_normals

CUBE = trimesh.creation.box(extents=(2.0, 3.0, 4.0))
PLY_HEADER = "ply\nformat ascii 1.0\nelement vertex {n}\n" + "".join(
    f"property float {axis}\n" for axis in "xyz"
)


def text_file(folder: Path, name: str, content: str) -> Path:
    path = folder / name
    path.write_bytes(content.encode())
    return path


@pytest.mark.parametrize("suffix", ["ply", "obj", "off", "glb", "gltf"])
def test_mesh_formats_keep_points_faces_and_outward_side(tmp_path: Path, suffix: str) -> None:
    path = tmp_path / f"cube.{suffix}"
    if suffix == "gltf":
        for name, content in trimesh.Scene(CUBE).export(file_type="gltf").items():
            (tmp_path / (path.name if name == "model.gltf" else name)).write_bytes(content)
    else:
        CUBE.export(path)
    cloud = read_cloud(path)
    np.testing.assert_array_equal(cloud.points, CUBE.vertices)
    np.testing.assert_array_equal(cloud.faces, CUBE.faces)
    assert cloud.normals is not None
    assert np.all(np.einsum("ij,ij->i", cloud.normals, cloud.points) > 0.5)
    np.testing.assert_allclose(np.linalg.norm(cloud.normals, axis=1), 1.0)


def test_stl_vertices_are_merged(tmp_path: Path) -> None:
    CUBE.export(tmp_path / "cube.stl")
    cloud = read_cloud(tmp_path / "cube.stl")
    assert len(cloud) == 8
    assert cloud.normals is not None


def test_obj_with_materials_texture_and_negative_indices_is_not_split(tmp_path: Path) -> None:
    path = text_file(
        tmp_path,
        "square.obj",
        "mtllib no.mtl\n# a square\no one\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 5 5 5\n"
        "vt 0 0\nvt 1 0\nvt 1 1\nvn 0 0 1\nusemtl a\nf 1/1/1 2/2/1 3/3/1\n"
        "g two\nusemtl b\nf -5//1 -3//-1 -2//1\n",
    )
    cloud = read_cloud(path)
    np.testing.assert_array_equal(
        cloud.points, [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [5, 5, 5]]
    )
    np.testing.assert_array_equal(cloud.faces, [[0, 1, 2], [0, 2, 3]])
    # The loose vertex takes the normal of its nearest neighbour.
    np.testing.assert_allclose(cloud.normals, [[0, 0, 1]] * 5)


def test_obj_points_with_normals(tmp_path: Path) -> None:
    path = text_file(tmp_path, "p.obj", "v 0 0 0\nvn 0 0 2\nv 1 2 3\nvn 0 1 0\n")
    cloud = read_cloud(path)
    assert cloud.faces is None
    np.testing.assert_array_equal(cloud.normals, [[0, 0, 1], [0, 1, 0]])


SQUARE = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]]


@pytest.mark.parametrize(
    "content",
    [
        "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 \\\n 3 4\n",
        "  v 0 0 0\n\tv 1 0 0\n v 1 1 0\n v 0 1 0\n  f 1 2 3 4\n",
        "v\t0\t0\t0\nv\t1 0 0\nv 1 1 0\nv 0 1 0\nf\t1\t2\t3\t4\n",
        "v 0 0 0 # a\nv 1 0 0# b\nv 1 1 0\nv 0 1 0\nf 1/1 2/2 3/3 4/4 # c\n",
        "# C:\\scans\\\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4",
    ],
    ids=["continued", "indented", "tabs", "comments", "backslash"],
)
@pytest.mark.parametrize("end", ["\n", "\r\n", "\r"])
def test_obj_layouts(tmp_path: Path, content: str, end: str) -> None:
    cloud = read_cloud(text_file(tmp_path, "a.obj", content.replace("\n", end)))
    np.testing.assert_array_equal(cloud.points, SQUARE)
    assert cloud.faces is not None
    np.testing.assert_array_equal(np.sort(cloud.faces, axis=1), [[0, 1, 2], [0, 2, 3]])
    np.testing.assert_array_equal(cloud.normals, [[0, 0, 1]] * 4)


@pytest.mark.parametrize("suffix", ["off", "ply"])
@pytest.mark.parametrize(
    "polygons", [["3 0 1 2", "3 0 2 3"], ["4 0 1 2 3"], ["3 0 1 2", "4 0 1 2 3"]]
)
def test_every_line_cut_off_a_text_mesh_is_missed(
    tmp_path: Path, suffix: str, polygons: list[str]
) -> None:
    header = f"OFF\n4 {len(polygons)} 0\n"
    if suffix == "ply":
        header = PLY_HEADER.format(n=4) + (
            f"element face {len(polygons)}\nproperty list uchar int vertex_indices\nend_header\n"
        )
    rows = [" ".join(map(str, point)) for point in SQUARE] + polygons
    assert (
        read_cloud(text_file(tmp_path, f"a.{suffix}", header + "\n".join(rows))).faces is not None
    )
    for kept in range(1, len(rows)):
        with pytest.raises(FileFormatError):
            read_cloud(text_file(tmp_path, f"b.{suffix}", header + "\n".join(rows[:kept]) + "\n"))
    rows[-1] = rows[-1].rpartition(" ")[0]
    with pytest.raises(FileFormatError):
        read_cloud(text_file(tmp_path, f"c.{suffix}", header + "\n".join(rows) + "\n"))


def test_polygons_become_triangles(tmp_path: Path) -> None:
    path = text_file(
        tmp_path, "five.off", "OFF\n5 1 0\n0 0 0\n1 0 0\n1 1 0\n0.5 1.5 0\n0 1 0\n5 0 1 2 3 4\n"
    )
    faces = read_cloud(path).faces
    assert faces is not None
    assert len(faces) == 3
    assert set(faces.ravel()) == set(range(5))


def test_ply_points_with_normals_in_double_precision(tmp_path: Path) -> None:
    path = text_file(
        tmp_path,
        "p.ply",
        "ply\nformat ascii 1.0\nelement vertex 2\nproperty double x\nproperty double y\n"
        "property double z\nproperty float nx\nproperty float ny\nproperty float nz\nend_header\n"
        "10000000.01 0 0 0 0 2\n1 2 3 0 1 0\n",
    )
    cloud = read_cloud(path)
    np.testing.assert_array_equal(cloud.points, [[10000000.01, 0, 0], [1, 2, 3]])
    np.testing.assert_array_equal(cloud.normals, [[0, 0, 1], [0, 1, 0]])


def test_scene_is_placed_and_joined(tmp_path: Path) -> None:
    scene = trimesh.Scene()
    scene.add_geometry(CUBE, transform=trimesh.transformations.translation_matrix([5, 0, 0]))
    mirror = np.diag([-1.0, 1.0, 1.0, 1.0])
    scene.add_geometry(CUBE, transform=mirror)
    scene.add_geometry(trimesh.PointCloud(np.full((4, 3), 9.0)))
    scene.export(tmp_path / "scene.glb")
    cloud = read_cloud(tmp_path / "scene.glb")
    assert len(cloud) == 20
    assert cloud.faces is not None
    assert len(cloud.faces) == 24
    assert cloud.points[:, 0].max() == 9.0
    mesh = trimesh.Trimesh(cloud.points, cloud.faces, process=False)
    assert mesh.volume == pytest.approx(2 * 24.0)  # a mirrored part must not count negatively


@pytest.mark.parametrize(
    ("name", "content"),
    [
        ("a.xyz", "1 2 3\n4 5 6\n"),
        ("a.txt", "2\n1\t2\t3\n4\t5\t6\n"),
        ("a.csv", "x,y,z\n1,2,3\n4,5,6\n"),
        ("a.csv", '"id","z","y","x","r"\n7,3,2,1,0\n8,6,5,4,0\n'),
        ("a.csv", "// X;Y;Z;Intensity\n1;2;3;9\n4;5;6;9\n"),
        ("a.txt", "# made by hand\n\n1, 2, 3\n4, 5, 6\n"),
        ("a.xyz", "1 2 3 255 0 0\n4 5 6 0 255 0\n"),
        # A mark of the encoding, as Excel writes it.
        ("a.xyz", "\ufeff1 2 3\n4 5 6\n"),
        ("a.csv", "\ufeffz,y,x\n3,2,1\n6,5,4\n"),
        ("a.csv", "\ufeffx,y,z,intensity\n1,2,3,9\n4,5,6,9\n"),
        # Comments that speak of x, y and z but do not name the columns.
        ("a.xyz", "# columns: x y z r g b\n1 2 3 255 0 0\n4 5 6 0 255 0\n"),
        ("a.csv", "y,x,z\n# survey of 2020\n2,1,3\n5,4,6\n"),
        ("a.csv", "# z x y\n# axes z y x of the scanner\n3;1;2\n6;4;5\n"),
        # Columns of words or of nothing.
        ("a.csv", "class,x,y,z,note\nground,1,2,3,\nlow plant,4,5,6,wet\n"),
        ("a.csv", "x,y,z,i\n1,2,3,\n4,5,6,\n"),
        ("a.csv", "1,2,3,\n4,5,6,\n"),
        ("a.csv", "X (m),Y (m),Z [m],I\n1,2,3,7\n4,5,6,7\n"),
        ("a.xyz", "# note\n" * 150 + "1 2 3 // seen\n\n# between\n4 5 6\n"),
    ],
)
def test_text_layouts(tmp_path: Path, name: str, content: str) -> None:
    cloud = read_cloud(text_file(tmp_path, name, content))
    np.testing.assert_array_equal(cloud.points, [[1, 2, 3], [4, 5, 6]])
    assert cloud.normals is None


@pytest.mark.parametrize(
    ("content", "place"),
    [
        ("# made by hand\n\n1 2 3\n4 five 6\n", "line 4, column 2: 'five' is no number"),
        ("x,y,z,class\n1,2,3,a\n4,5,,b\n", "line 3, column 3: '' is no number"),
        ("x,y,z\n1,2,3\n1_0,5,6\n", "line 3, column 1: '1_0' is no number"),
        ("1 2 3\n# a\n4 5\n6 7 8\n", r"line 3, has .* columns \(2\) than line 1 \(3\)"),
        ("x,y,z,class\n1,2,3,a\n4,5,6\n", r"line 3, has .* columns \(3\) than line 2 \(4\)"),
        ("x,y,z,class\n1,2,3,a\n1,234,5,6,b\n", r"line 3, has .* columns \(5\)"),
        ("\n1 2 3 4\n", r"has 4 columns \(line 2\)"),
        ("1,2,3,ground\n", "name all columns in a header"),
    ],
)
def test_bad_rows_are_named_by_their_line(tmp_path: Path, content: str, place: str) -> None:
    with pytest.raises(FileFormatError, match=place):
        read_cloud(text_file(tmp_path, "a.csv", content))


def test_text_in_another_encoding(tmp_path: Path) -> None:
    path = tmp_path / "a.csv"
    path.write_bytes("# café\nx,y,z,class\n1,2,3,forêt\n".encode("latin-1"))
    np.testing.assert_array_equal(read_cloud(path).points, [[1, 2, 3]])


def test_text_normals(tmp_path: Path) -> None:
    plain = read_cloud(text_file(tmp_path, "a.xyz", "1 2 3 0 0 1\n4 5 6 0.6 0.8 0\n"))
    np.testing.assert_array_equal(plain.normals, [[0, 0, 1], [0.6, 0.8, 0]])
    named = read_cloud(text_file(tmp_path, "b.csv", "nx,ny,nz,x,y,z\n0,0,2,1,2,3\n"))
    np.testing.assert_array_equal(named.points, [[1, 2, 3]])
    np.testing.assert_array_equal(named.normals, [[0, 0, 1]])


@pytest.mark.parametrize("suffix", ["las", "laz"])
def test_las(tmp_path: Path, suffix: str) -> None:
    laspy = pytest.importorskip("laspy")
    header = laspy.LasHeader(point_format=3, version="1.2")
    header.offsets, header.scales = np.array([1e6, 6e6, 0.0]), np.array([1e-3] * 3)
    las = laspy.LasData(header)
    points = np.array([[1e6, 6e6, 12.5], [1e6 + 0.123, 6e6 + 1.5, -3.0]])
    las.x, las.y, las.z = points.T
    las.write(tmp_path / f"scan.{suffix}")
    np.testing.assert_allclose(read_cloud(tmp_path / f"scan.{suffix}").points, points, atol=1e-9)


def test_las_without_laspy(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(__import__("sys").modules, "laspy", None)
    with pytest.raises(MissingDependencyError, match="extra las"):
        read_cloud(text_file(tmp_path, "a.las", "x"))


def test_samples_lie_on_the_surface_uniformly_and_follow_the_seed(tmp_path: Path) -> None:
    CUBE.export(tmp_path / "cube.ply")
    cloud = read_cloud(tmp_path / "cube.ply", samples=26_000, seed=3)
    half = np.array([1.0, 1.5, 2.0])
    assert cloud.faces is None
    np.testing.assert_allclose(np.max(np.abs(cloud.points) / half, axis=1), 1.0)
    # Areas of the faces across x, y, z are 12, 8, 6 of 52/2, so 12000, 8000, 6000 samples.
    assert cloud.normals is not None
    counts = np.bincount(np.argmax(np.abs(cloud.normals), axis=1))
    np.testing.assert_allclose(counts, [12_000, 8_000, 6_000], atol=4 * np.sqrt(26_000 / 4))
    assert np.all(np.einsum("ij,ij->i", cloud.normals, cloud.points) > 0)
    again = read_cloud(tmp_path / "cube.ply", samples=26_000, seed=3)
    np.testing.assert_array_equal(cloud.points, again.points)
    other = read_cloud(tmp_path / "cube.ply", samples=26_000, seed=4)
    assert not np.array_equal(cloud.points, other.points)


def test_winding_is_used_only_where_it_is_consistent() -> None:
    sphere = trimesh.creation.icosphere(subdivisions=4)
    points, faces = np.array(sphere.vertices), np.array(sphere.faces, dtype=np.int64)
    normals = winding_normals(points, faces)
    assert normals is not None
    assert np.max(np.linalg.norm(normals - points, axis=1)) < 1e-2
    few = faces.copy()
    few[:10] = few[:10, ::-1]
    assert winding_normals(points, few) is not None
    half = faces.copy()
    half[::2] = half[::2, ::-1]
    assert winding_normals(points, half) is None
    # Triangles that do not share vertices are judged by the places of their corners.
    soup = points[faces].reshape(-1, 3), np.arange(faces.size, dtype=np.int64).reshape(-1, 3)
    assert winding_normals(*soup) is not None
    assert winding_normals(points[half].reshape(-1, 3), soup[1]) is None


BAD_FILES = [
    ("empty.ply", ""),
    ("empty.xyz", ""),
    ("none.ply", PLY_HEADER.format(n=0) + "end_header\n"),
    ("cut.ply", PLY_HEADER.format(n=9) + "end_header\n1 2 3\n"),
    ("garbage.ply", "garbage"),
    ("garbage.obj", "garbage"),
    ("garbage.off", "garbage"),
    ("garbage.stl", "garbage"),
    ("garbage.glb", "garbage"),
    ("garbage.gltf", "garbage"),
    ("garbage.xyz", "garbage"),
    ("face.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n"),
    ("zero.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 0\n"),
    ("zeros.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 0/1 1/2 2/3\n"),
    ("face.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 7\n"),
    ("broken.xyz", "1 2 3\n4 five 6\n"),
    ("ragged.csv", "1,2,3\n4,5\n"),
    ("four.xyz", "1 2 3 4\n5 6 7 8\n"),
    ("unknown.abc", "1 2 3\n"),
    ("nosuffix", "1 2 3\n"),
]


@pytest.mark.parametrize(("name", "content"), BAD_FILES, ids=[name for name, _ in BAD_FILES])
def test_bad_files_get_one_sentence(tmp_path: Path, name: str, content: str) -> None:
    path = text_file(tmp_path, name, content)
    with pytest.raises(FileFormatError) as caught:
        read_cloud(path)
    message = str(caught.value)
    assert str(path) in message
    assert "\n" not in message
    assert message.endswith(".")


@pytest.mark.parametrize("content", ["1 2 nan\n3 4 5\n", "1 2 inf\n3 4 5\n"])
def test_coordinates_must_be_finite(tmp_path: Path, content: str) -> None:
    with pytest.raises(InputError, match="1 of 2 points is NaN or infinite"):
        read_cloud(text_file(tmp_path, "a.xyz", content))


def sphere_file(path: Path, coordinate: float) -> None:
    """Write a sphere with one coordinate that is not its own."""
    sphere = trimesh.creation.icosphere(subdivisions=1)
    points = np.array(sphere.vertices)
    points[3, 1] = coordinate
    with np.errstate(over="ignore", invalid="ignore"):
        trimesh.Trimesh(points, sphere.faces, process=False).export(path)


@pytest.mark.filterwarnings("error")
@pytest.mark.parametrize("samples", [None, 10])
@pytest.mark.parametrize("coordinate", [np.nan, np.inf, -np.inf])
@pytest.mark.parametrize("suffix", ["ply", "obj", "stl", "off", "glb"])
def test_coordinates_of_meshes_must_be_finite(
    tmp_path: Path, suffix: str, coordinate: float, samples: int | None
) -> None:
    path = tmp_path / f"a.{suffix}"
    sphere_file(path, coordinate)
    with pytest.raises(InputError, match="1 of 42 points is NaN or infinite"):
        read_cloud(path, samples=samples)


@pytest.mark.filterwarnings("error")
def test_areas_beyond_double_precision_tell_no_side(tmp_path: Path) -> None:
    path = tmp_path / "a.off"
    for size in (1e160, 1e200, 1e308):
        sphere_file(path, size)
        cloud = read_cloud(path)
        assert cloud.points[3, 1] == pytest.approx(size)
        assert cloud.normals is None
        with pytest.raises(InputError, match=r"area of a\.off exceeds double precision"):
            read_cloud(path, samples=10)
    sphere_file(path, 1e30)
    assert read_cloud(path).normals is not None


def test_files_that_cannot_be_opened(tmp_path: Path) -> None:
    with pytest.raises(FileAccessError, match="no such file"):
        read_cloud(tmp_path / "missing.ply")
    with pytest.raises(FileAccessError, match="folder"):
        read_cloud(tmp_path)
    if os.name == "posix" and os.geteuid() != 0:
        locked = text_file(tmp_path, "locked.xyz", "1 2 3\n")
        locked.chmod(0)
        with pytest.raises(FileAccessError, match="cannot read"):
            read_cloud(locked)


def test_sampling_needs_a_surface(tmp_path: Path) -> None:
    points = text_file(tmp_path, "a.xyz", "1 2 3\n4 5 6\n7 8 8\n")
    with pytest.raises(InputError, match="has no faces"):
        read_cloud(points, samples=10)
    flat = text_file(tmp_path, "flat.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n")
    with pytest.raises(InputError, match="has no area"):
        read_cloud(flat, samples=10)
    CUBE.export(tmp_path / "cube.ply")
    for count in (0, -5, 10**30):
        with pytest.raises(PdtheoryError, match="positive number"):
            read_cloud(tmp_path / "cube.ply", samples=count)
    with pytest.raises(InputError, match="seed = -1"):
        read_cloud(tmp_path / "cube.ply", samples=5, seed=-1)
