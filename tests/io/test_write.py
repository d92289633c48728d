"""Writing: what is written reads back, by independent readers where there are some."""

from __future__ import annotations

import base64
import csv
import gc
import re
import xml.etree.ElementTree as ET
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import fields
from pathlib import Path

import numpy as np
import pytest
import trimesh

from pdtheory.conventions import Status
from pdtheory.errors import FileAccessError, FileFormatError, InputError
from pdtheory.io import read_cloud, read_field, write_cloud, write_field
from pdtheory.pointset.cloud import PointCloud
from pdtheory.pointset.directions import OrderDirections
from pdtheory.pointset.field import DirectionField


def rows(order: int, counts: list[int], rng: np.random.Generator) -> OrderDirections:
    total = sum(counts)
    vectors = rng.normal(size=(total, 3))
    return OrderDirections(
        order=order,
        offsets=np.concatenate(([0], np.cumsum(counts))).astype(np.int64),
        angle=rng.uniform(0, 6, total),
        vector=vectors / np.linalg.norm(vectors, axis=1, keepdims=True),
        eigenvalue=rng.normal(size=total),
        strength=rng.uniform(0.1, 1, total),
        kind=np.where(np.arange(total) % 2 == 0, 1, -1).astype(np.int8),
        angle_std=rng.uniform(0, 1, total),
        eigenvalue_std=rng.uniform(0, 1, total),
        isotropic=np.array(counts) == 0,
    )


@pytest.fixture
def field() -> DirectionField:
    """Three points, the second without an answer."""
    rng = np.random.default_rng(5)
    frames = np.stack([np.linalg.qr(rng.normal(size=(3, 3)))[0] for _ in range(3)])
    frames[1] = np.nan
    phi = rng.normal(size=(3, 4)) + 1j * rng.normal(size=(3, 4))
    phi[1] = np.nan
    return DirectionField(
        points=rng.normal(size=(3, 3)) + 1e7,
        frames=frames,
        radius=np.array([0.1, 0.1, 0.2]),
        degree=np.array([6, 0, 4]),
        neighbours=np.array([80, 2, 40]),
        residual_rms=np.array([1e-6, np.nan, 1e-5]),
        condition=np.array([1e-3, np.nan, 1e-4]),
        status=np.array([0, int(Status.TOO_FEW_NEIGHBOURS), int(Status.DEGREE_LOWERED)]),
        phi=phi,
        phi_order=np.array([2, 2, 3, 3]),
        phi_frequency=np.array([0, 2, 1, 3]),
        directions={2: rows(2, [4, 0, 0], rng), 3: rows(3, [6, 0, 2], rng)},
    )


def test_npz_holds_everything(field: DirectionField, tmp_path: Path) -> None:
    write_field(field, tmp_path / "f.npz")
    back = read_field(tmp_path / "f.npz")
    for entry in fields(DirectionField):
        if entry.name != "directions":
            np.testing.assert_array_equal(getattr(back, entry.name), getattr(field, entry.name))
    assert back.orders == (2, 3)
    for order in back.orders:
        for entry in fields(OrderDirections):
            np.testing.assert_array_equal(
                getattr(back[order], entry.name), getattr(field[order], entry.name)
            )


def test_ply_is_read_by_trimesh(field: DirectionField, tmp_path: Path) -> None:
    write_field(field, tmp_path / "f.ply")
    cloud = read_cloud(tmp_path / "f.ply")
    np.testing.assert_array_equal(cloud.points, field.points)
    (part,) = trimesh.load_scene(tmp_path / "f.ply", process=False).geometry.values()
    raw = part.metadata["_ply_raw"]
    vertex = {name: np.ravel(values) for name, values in _columns(raw["vertex"]["data"]).items()}
    np.testing.assert_array_equal(vertex["status"], field.status)
    np.testing.assert_array_equal(vertex["nz"], np.nan_to_num(field.frames[:, 2, 2]))
    np.testing.assert_array_equal(vertex["order3_maxima"], [3, 0, 1])
    strongest = [field[3].strength[0:6:2].argmax() * 2, 6]
    np.testing.assert_array_equal(vertex["order3_strength"][[0, 2]], field[3].strength[strongest])
    np.testing.assert_array_equal(vertex["order3_x"][[0, 2]], field[3].vector[strongest, 0])
    assert vertex["order3_strength"][1] == 0.0
    directions = _columns(raw["direction"]["data"])
    assert np.ravel(directions["order"]).tolist() == [2] * 4 + [3] * 8
    assert np.ravel(directions["point"]).tolist() == [0] * 10 + [2] * 2
    np.testing.assert_array_equal(np.ravel(directions["dy"])[4:], field[3].vector[:, 1])


def _columns(data: object) -> dict[str, np.ndarray]:
    if isinstance(data, dict):
        return data
    assert isinstance(data, np.ndarray)
    return {name: data[name] for name in data.dtype.names or ()}


def test_vtp_arrays_decode(field: DirectionField, tmp_path: Path) -> None:
    write_field(field, tmp_path / "f.vtp")
    root = ET.parse(tmp_path / "f.vtp").getroot()
    kinds = {"Float64": "<f8", "Int32": "<i4", "Int64": "<i8", "UInt8": "u1", "Int8": "i1"}
    arrays = {}
    for entry in root.iter("DataArray"):
        content = base64.b64decode(entry.text or "")
        assert int.from_bytes(content[:8], "little") == len(content) - 8
        values = np.frombuffer(content[8:], dtype=kinds[entry.attrib["type"]])
        arrays[entry.attrib["Name"]] = values.reshape(
            -1, int(entry.attrib["NumberOfComponents"])
        ).squeeze()
    np.testing.assert_array_equal(arrays["Points"], field.points[[0] * 10 + [2] * 2])
    np.testing.assert_array_equal(arrays["direction"][:4], field[2].vector)
    np.testing.assert_array_equal(arrays["strength"][4:], field[3].strength)
    assert arrays["offsets"].tolist() == list(range(1, 13))


def test_vtp_is_read_by_vtk(field: DirectionField, tmp_path: Path) -> None:
    reader_module = pytest.importorskip("vtkmodules.vtkIOXML")
    support = pytest.importorskip("vtkmodules.util.numpy_support")
    write_field(field, tmp_path / "f.vtp")
    reader = reader_module.vtkXMLPolyDataReader()
    reader.SetFileName(str(tmp_path / "f.vtp"))
    reader.Update()
    data = reader.GetOutput()
    assert data.GetNumberOfVerts() == 12
    direction = support.vtk_to_numpy(data.GetPointData().GetArray("direction"))
    np.testing.assert_array_equal(direction[:4], field[2].vector)


def test_csv_reads_back_to_the_same_numbers(field: DirectionField, tmp_path: Path) -> None:
    write_field(field, tmp_path / "f.csv")
    with (tmp_path / "f.csv").open() as stream:
        table = list(csv.DictReader(stream))
    assert len(table) == 12
    assert [int(row["order"]) for row in table] == [2] * 4 + [3] * 8
    np.testing.assert_array_equal(
        [float(row["eigenvalue"]) for row in table[4:]], field[3].eigenvalue
    )
    assert [float(row["x"]) for row in table[-2:]] == [field.points[2, 0]] * 2


def test_field_without_directions(field: DirectionField, tmp_path: Path) -> None:
    empty = DirectionField(
        **{e.name: getattr(field, e.name) for e in fields(DirectionField) if e.name != "directions"}
    )
    for suffix in ("npz", "ply", "vtp", "csv"):
        write_field(empty, tmp_path / f"f.{suffix}")
    assert len(read_cloud(tmp_path / "f.ply")) == 3


@pytest.mark.parametrize("suffix", ["ply", "xyz", "txt", "csv", "obj"])
def test_clouds_read_back_exactly(tmp_path: Path, suffix: str) -> None:
    rng = np.random.default_rng(1)
    normals = rng.normal(size=(50, 3))
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    cloud = PointCloud(rng.normal(size=(50, 3)) * 1e-9 + 1e7, normals, rng.integers(0, 50, (20, 3)))
    write_cloud(cloud, tmp_path / f"c.{suffix}")
    back = read_cloud(tmp_path / f"c.{suffix}")
    np.testing.assert_array_equal(back.points, cloud.points)
    if suffix in ("ply", "obj"):
        np.testing.assert_array_equal(back.faces, cloud.faces)
    else:
        np.testing.assert_allclose(back.normals, cloud.normals, rtol=1e-15)


def test_stl(tmp_path: Path) -> None:
    box = trimesh.creation.box()
    write_cloud(
        PointCloud(np.array(box.vertices), faces=np.array(box.faces, dtype=np.int64)),
        tmp_path / "c.stl",
    )
    assert trimesh.load_mesh(tmp_path / "c.stl").volume == pytest.approx(1.0)


def test_refusals(field: DirectionField, tmp_path: Path) -> None:
    cloud = PointCloud(np.zeros((3, 3)))
    with pytest.raises(FileFormatError, match=r"\.abc"):
        write_field(field, tmp_path / "f.abc")
    with pytest.raises(FileFormatError, match=r"\(none\)"):
        write_cloud(cloud, tmp_path / "f")
    with pytest.raises(InputError, match="no faces"):
        write_cloud(cloud, tmp_path / "f.stl")
    with pytest.raises(FileAccessError, match="does not exist"):
        write_field(field, tmp_path / "no" / "f.ply")
    with pytest.raises(FileFormatError, match="export"):
        read_field(tmp_path / "f.ply")
    with pytest.raises(FileAccessError, match="no such file"):
        read_field(tmp_path / "f.npz")
    assert list(tmp_path.iterdir()) == []


@contextmanager
def room_for(size: int) -> Iterator[None]:
    """Let no file grow beyond a size, as on a disk that fills up."""
    resource = pytest.importorskip("resource")
    soft, hard = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (size, hard))
    try:
        yield
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, (soft, hard))


@pytest.mark.filterwarnings("error::pytest.PytestUnraisableExceptionWarning")
@pytest.mark.parametrize("suffix", ["npz", "ply", "vtp", "csv"])
@pytest.mark.parametrize("room", [0, 600])
def test_a_full_disk_leaves_what_was_there(
    field: DirectionField, tmp_path: Path, suffix: str, room: int
) -> None:
    target = tmp_path / f"f.{suffix}"
    target.write_text("old")
    with (
        room_for(room),
        pytest.raises(FileAccessError, match=re.escape(f"cannot write {target}: ")),
    ):
        write_field(field, target)
    gc.collect()
    assert target.read_text() == "old"
    assert list(tmp_path.iterdir()) == [target]


def test_a_full_disk_has_no_room_for_plots_either(field: DirectionField, tmp_path: Path) -> None:
    target = tmp_path / "point.png"
    with room_for(600), pytest.raises(FileAccessError, match=re.escape(f"cannot write {target}: ")):
        field.at(0).plot(target)
    assert not list(tmp_path.iterdir())


def test_an_archive_is_that_of_numpy(field: DirectionField, tmp_path: Path) -> None:
    write_field(field, tmp_path / "f.npz")
    with np.load(tmp_path / "f.npz") as data:
        np.savez(tmp_path / "g.npz", **data)
    ours, theirs = ((tmp_path / name).stat().st_size for name in ("f.npz", "g.npz"))
    assert ours == theirs


def test_damaged_npz_files_get_one_sentence(field: DirectionField, tmp_path: Path) -> None:
    whole, bad = tmp_path / "f.npz", tmp_path / "bad.npz"
    write_field(field, whole)
    content = np.frombuffer(whole.read_bytes(), np.uint8)
    rng = np.random.default_rng(2)
    sentences = []
    for _ in range(300):
        flipped = content.copy()
        flipped[rng.integers(len(content), size=3)] ^= rng.integers(1, 256, 3, dtype=np.uint8)
        bad.write_bytes(flipped.tobytes())
        try:
            read_field(bad)
        except (FileFormatError, FileAccessError) as error:
            sentences.append(str(error))
    assert len(sentences) > 200
    assert not any("\n" in sentence for sentence in sentences)


def test_other_arrays_under_the_name_of_a_field_are_refused(
    field: DirectionField, tmp_path: Path
) -> None:
    path = tmp_path / "f.npz"
    with path.open("wb") as stream:
        np.save(stream, np.arange(3.0))
    with pytest.raises(FileFormatError, match="is not a direction field of pdtheory"):
        read_field(path)
    write_field(field, path)
    with np.load(path) as data:
        arrays = dict(data)
    for wrong in (
        {"schema": np.arange(2)},
        {"schema": np.array("one")},
        {"orders": np.array(2)},
        {"orders": np.ones((2, 2))},
    ):
        np.savez(path, **(arrays | wrong))
        with pytest.raises(FileFormatError, match="is not a direction field of pdtheory"):
            read_field(path)
