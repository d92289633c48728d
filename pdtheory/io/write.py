"""Ways out: direction fields and point clouds, by suffix, whole or not at all."""

from __future__ import annotations

import os
from collections.abc import Callable
from pathlib import Path

from pdtheory.atomic import atomic_path
from pdtheory.errors import FileFormatError, InputError
from pdtheory.interrupts import signals_held
from pdtheory.io.ply import write_ply
from pdtheory.io.vtp import write_vtp
from pdtheory.pointset.cloud import PointCloud
from pdtheory.pointset.field import DirectionField
from pdtheory.pointset.table import Columns, direction_columns, glyph_columns, point_columns

FIELD_SUFFIXES = (".npz", ".ply", ".vtp", ".csv")
CLOUD_SUFFIXES = (".ply", ".xyz", ".txt", ".csv", ".obj", ".stl")

#: Largest number of rows turned to text at a time.
_CHUNK = 100_000


def read_field(path: str | os.PathLike[str]) -> DirectionField:
    """Read a direction field from its NPZ file.

    Parameters
    ----------
    path
        A file written by :func:`write_field`.

    Returns
    -------
    DirectionField
        The field, complete.

    Raises
    ------
    FileAccessError
        If the file does not exist or cannot be read.
    FileFormatError
        If it is not a direction field. PLY, VTP and CSV files do not hold enough to be read back.
    """
    source = Path(path)
    if source.suffix.lower() in FIELD_SUFFIXES[1:]:
        raise FileFormatError(
            f"{source} is an export and does not hold the whole field; give the .npz file."
        )
    return DirectionField.load(source)


def write_field(field: DirectionField, path: str | os.PathLike[str]) -> None:
    """Write a direction field in the format that the suffix names (docs/formats.md).

    Parameters
    ----------
    field
        The field.
    path
        ``.npz`` (complete, can be read back), ``.ply`` (points with named attributes and an element
        of directions), ``.vtp`` (a point for each direction, for ParaView) or ``.csv`` (a row for
        each direction).

    Raises
    ------
    FileFormatError
        If the suffix is another one.
    FileAccessError
        If the file cannot be written.
    """
    target = Path(path)
    writers: dict[str, Callable[[DirectionField, Path], None]] = {
        ".ply": _field_to_ply,
        ".vtp": _field_to_vtp,
        ".csv": _field_to_csv,
    }
    suffix = _suffix(target, FIELD_SUFFIXES)
    if suffix == ".npz":
        field.save(target)
        return
    with atomic_path(target) as temporary:
        writers[suffix](field, temporary)


def write_cloud(cloud: PointCloud, path: str | os.PathLike[str]) -> None:
    """Write points, with normals and triangles where the format has them.

    Parameters
    ----------
    cloud
        The points.
    path
        ``.ply`` (double precision), ``.xyz``, ``.txt`` or ``.csv`` (all digits, no triangles), or
        for meshes ``.obj`` (all digits) or ``.stl`` (single precision).

    Raises
    ------
    FileFormatError
        If the suffix is another one.
    InputError
        If a mesh format is asked for points without triangles.
    FileAccessError
        If the file cannot be written.
    """
    target = Path(path)
    suffix = _suffix(target, CLOUD_SUFFIXES)
    if suffix in (".obj", ".stl") and cloud.faces is None:
        raise InputError(
            f"{cloud.name} has no faces, which {suffix} files are made of; write .ply or .xyz."
        )
    columns: Columns = dict(zip("xyz", cloud.points.T, strict=True))
    if cloud.normals is not None:
        columns |= dict(zip(("nx", "ny", "nz"), cloud.normals.T, strict=True))
    with atomic_path(target) as temporary:
        if suffix == ".ply":
            write_ply(temporary, {"vertex": columns}, faces=cloud.faces)
        elif suffix in (".xyz", ".txt", ".csv"):
            _write_table(temporary, columns, header=suffix == ".csv")
        elif suffix == ".obj":
            _write_obj(temporary, cloud)
        else:
            with signals_held():
                import trimesh

            mesh = trimesh.Trimesh(cloud.points, cloud.faces, process=False)
            mesh.export(temporary, file_type="stl")


def _suffix(target: Path, known: tuple[str, ...]) -> str:
    suffix = target.suffix.lower()
    if suffix not in known:
        raise FileFormatError(
            f"cannot write {target}: the suffix {suffix or '(none)'} is not one of "
            f"{', '.join(known)}."
        )
    return suffix


def _field_to_ply(field: DirectionField, path: Path) -> None:
    write_ply(path, {"vertex": point_columns(field), "direction": direction_columns(field)})


def _field_to_vtp(field: DirectionField, path: Path) -> None:
    write_vtp(path, *glyph_columns(field))


def _field_to_csv(field: DirectionField, path: Path) -> None:
    columns = direction_columns(field)
    index = columns.pop("point")
    position = dict(zip("xyz", field.points[index].T, strict=True))
    _write_table(path, {"point": index, **position, **columns}, header=True)


def _write_table(path: Path, columns: Columns, *, header: bool) -> None:
    """Write columns as text that reads back to the same numbers; a header means commas."""
    separator = "," if header else " "
    formats = ["%d" if values.dtype.kind in "iu" else "%.17g" for values in columns.values()]
    line = separator.join(formats) + "\n"
    count = len(next(iter(columns.values())))
    with path.open("w", encoding="ascii", newline="\n") as stream:
        if header:
            stream.write(separator.join(columns) + "\n")
        for start in range(0, count, _CHUNK):
            chunk = [values[start : start + _CHUNK].tolist() for values in columns.values()]
            stream.writelines(line % row for row in zip(*chunk, strict=True))


def _write_obj(path: Path, cloud: PointCloud) -> None:
    position, face = "v {:.17g} {:.17g} {:.17g}\n".format, "f {} {} {}\n".format
    with path.open("w", encoding="ascii", newline="\n") as stream:
        stream.writelines(position(*row) for row in cloud.points.tolist())
        if cloud.faces is not None:
            stream.writelines(face(*row) for row in (cloud.faces + 1).tolist())
