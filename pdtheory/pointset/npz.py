"""Direction fields as NPZ files (schema 1, docs/formats.md)."""

from __future__ import annotations

import os
import zipfile
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import fields
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from pdtheory.atomic import atomic_path
from pdtheory.conventions import Status
from pdtheory.errors import FileAccessError, FileFormatError
from pdtheory.pointset.directions import OrderDirections

if TYPE_CHECKING:
    from pdtheory.pointset.field import DirectionField

#: Version of the layout.
SCHEMA = 1

_ORDER_ARRAYS = tuple(entry.name for entry in fields(OrderDirections) if entry.name != "order")


def save_npz(
    field: DirectionField, path: str | os.PathLike[str], **more: npt.NDArray[np.generic]
) -> None:
    """Write a field, whole or not at all.

    Parameters
    ----------
    field
        The field.
    path
        The file.
    **more
        Further arrays, which a reader of fields passes over.

    Raises
    ------
    FileAccessError
        If the file cannot be written.
    """
    arrays: dict[str, npt.NDArray[np.generic]] = {
        "schema": np.array(SCHEMA),
        "status_names": np.array([f"{flag.value}:{flag.name}" for flag in Status]),
        "orders": np.array(field.orders, dtype=np.int64),
    }
    for entry in fields(field):
        if entry.name != "directions":
            arrays[entry.name] = getattr(field, entry.name)
    for order, rows in field.directions.items():
        for name in _ORDER_ARRAYS:
            arrays[f"order{order}_{name}"] = getattr(rows, name)
    # np.savez does the same, but on a full disk prints a second error as it is thrown away.
    with atomic_path(path) as temporary, zipfile.ZipFile(temporary, "w") as archive:
        for name, values in (arrays | more).items():
            with archive.open(f"{name}.npy", "w", force_zip64=True) as stream:
                np.lib.format.write_array(stream, np.asanyarray(values), allow_pickle=False)


def load_npz(path: str | os.PathLike[str], names: tuple[str, ...]) -> dict[str, Any]:
    """Read what makes a field.

    Parameters
    ----------
    path
        A file written by :func:`save_npz`.
    names
        The arrays that a field has beside its directions.

    Returns
    -------
    dict
        The arguments of :class:`DirectionField`.

    Raises
    ------
    FileAccessError
        If the file does not exist or cannot be read.
    FileFormatError
        If it is not a direction field, or of a newer schema.
    """
    source = Path(path)
    with _opened(source) as data:
        if "schema" not in data:
            raise FileFormatError(f"{source} is not a direction field of pdtheory.")
        if int(data["schema"]) > SCHEMA:
            raise FileFormatError(
                f"{source} has schema {int(data['schema'])}; this version reads up to "
                f"{SCHEMA}, please upgrade pdtheory."
            )
        directions = {
            int(order): OrderDirections(
                order=int(order),
                **{name: data[f"order{order}_{name}"] for name in _ORDER_ARRAYS},
            )
            for order in data["orders"]
        }
        return {name: data[name] for name in names} | {"directions": directions}


def read_array(path: str | os.PathLike[str], name: str) -> npt.NDArray[Any]:
    """Read one array of a file and leave the others where they are.

    Raises
    ------
    FileAccessError
        If the file does not exist or cannot be read.
    FileFormatError
        If it holds no such array.
    """
    with _opened(Path(path)) as data:
        return data[name]


@contextmanager
def _opened(source: Path) -> Iterator[Any]:
    """Open an NPZ file, and say of everything that goes wrong with it what it means."""
    try:
        with source.open("rb") as stream:
            if not zipfile.is_zipfile(stream):
                raise FileFormatError(
                    f"{source} is not a direction field of pdtheory, or it is damaged; give an "
                    ".npz file that pdtheory wrote."
                )
        with np.load(source, allow_pickle=False) as data:
            yield data
    except (FileFormatError, MemoryError):
        raise
    except FileNotFoundError as error:
        raise FileAccessError(f"no such file: {source}.") from error
    except OSError as error:
        raise FileAccessError(f"cannot read {source}: {error.strerror or error}.") from error
    except Exception as error:
        # The readers of zip archives and of array headers raise a dozen unrelated types.
        reason = " ".join(str(error).split())
        raise FileFormatError(
            f"{source} is not a direction field of pdtheory, or it is damaged ({reason})."
        ) from error
