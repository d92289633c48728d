"""LAS and LAZ files of laser scanners, through laspy."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from pdtheory.errors import FileFormatError, MissingDependencyError
from pdtheory.pointset.cloud import PointCloud


def read_las(path: Path) -> PointCloud:
    """Read the scaled coordinates of a LAS or LAZ file.

    Parameters
    ----------
    path
        The file.

    Returns
    -------
    PointCloud
        The points, in the units of the file; LAS has no normals.

    Raises
    ------
    MissingDependencyError
        If laspy, or for LAZ a decompressor, is not installed.
    FileFormatError
        If the file is damaged.
    """
    try:
        import laspy
    except ImportError as error:
        raise MissingDependencyError(
            f"{path} needs laspy to be read; install it with `pip install 'laspy[lazrs]'` "
            "(extra las)."
        ) from error
    compressed = path.suffix.lower() == ".laz"
    if compressed and not laspy.LazBackend.detect_available():
        raise MissingDependencyError(
            f"{path} needs a LAZ decompressor; install it with `pip install 'laspy[lazrs]'` "
            "(extra las)."
        )
    try:
        points = np.asarray(laspy.read(path).xyz, dtype=np.float64)
    except MemoryError:
        raise
    except Exception as error:
        # laspy and its decompressors raise a dozen unrelated types on damaged files.
        raise FileFormatError(f"{path} is not a readable LAS file, or it is damaged.") from error
    return PointCloud(np.ascontiguousarray(points), name=path.name)
