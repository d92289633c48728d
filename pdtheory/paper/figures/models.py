"""Scans: found in the folders given, in the cache, or fetched where there is a network."""

from __future__ import annotations

import os
from collections.abc import Sequence
from pathlib import Path
from typing import Final

from pdtheory.errors import FileAccessError
from pdtheory.io import read_cloud
from pdtheory.paper.figures.outcome import Job
from pdtheory.pointset.cloud import PointCloud

#: Environment variable that names a folder of scans.
VARIABLE: Final = "PDTHEORY_MODELS"

_SOURCE: Final = "https://raw.githubusercontent.com/alecjacobson/common-3d-test-models/master/"

#: File, SHA-256 and path at the source, by name.
KNOWN: Final = {
    "armadillo": (
        "armadillo.obj",
        "c007ebd11e541a2b1ab86a4c376653579281265f2c6c786a4a7bf47ba84d6879",
        "data/armadillo.obj",
    ),
    "fandisk": (
        "fandisk.obj",
        "ea5bab2fbf545b1915f0d9faf6cc61ff8c18e0d8174ad61f8e35de15d8f6e3f8",
        "data/fandisk.obj",
    ),
    "igea": (
        "igea.ply",
        "8888e96f2fb8c69dd3d328554c9f91f0770379b8a13e50224300ca48c44cc1a6",
        "data/igea.ply",
    ),
    "rocker-arm": (
        "rocker-arm.obj",
        "590257e6d01e689354821d807854306c3bfbb02d9cca73404d5a4924f105c287",
        "data/rocker-arm.obj",
    ),
}

#: Suffixes under which a scan of one's own is looked for.
_SUFFIXES: Final = (".ply", ".obj", ".off", ".stl")


def find(*names: str, folder: Path | None = None) -> Path:
    """Return the path of a scan, or of one that may stand in for it.

    Parameters
    ----------
    names
        Names without suffix, the best first: ``david``, which is not public, then ``igea``.
    folder
        Looked at first; then the folder in the environment variable ``PDTHEORY_MODELS``, then the
        cache, then the network.

    Raises
    ------
    FileAccessError
        If none of them is anywhere; the sentence says where they were looked for.
    """
    folders = [folder] if folder is not None else []
    if os.environ.get(VARIABLE):
        folders.append(Path(os.environ[VARIABLE]))
    for name in names:
        for place in folders:
            for suffix in _SUFFIXES:
                path = place / f"{name}{suffix}"
                if path.is_file():
                    return path
        fetched = _fetch(name)
        if fetched is not None:
            return fetched
    looked = ", ".join(str(place) for place in folders) or "no folder"
    raise FileAccessError(
        f"the scan {' or '.join(names)} was not found (looked in {looked}, the cache and the "
        f"network); give its folder with --models or {VARIABLE}."
    )


def load(names: Sequence[str], job: Job) -> PointCloud:
    """Read the first scan found of several, as a mesh."""
    return read_cloud(find(*names, folder=job.models))


def _fetch(name: str) -> Path | None:
    """Return a known scan from the cache or the network, None if that is not to be had."""
    if name not in KNOWN:
        return None
    try:
        import pooch
    except ImportError:
        return None
    file, digest, remote = KNOWN[name]
    try:
        found = pooch.retrieve(
            _SOURCE + remote,
            known_hash=f"sha256:{digest}",
            fname=file,
            path=pooch.os_cache("pdtheory"),
        )
    except (OSError, ValueError):
        # No network, no room, or another file under the name: the scan is absent, and said to be.
        return None
    return Path(found)
