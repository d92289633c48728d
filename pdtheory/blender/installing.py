"""A zip of the extension into a Blender of this machine."""

from __future__ import annotations

import os
import re
import shutil
import zipfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Final

from pdtheory.blender.packaging import run_tool
from pdtheory.errors import ComputationError, FileAccessError, InputError

#: How Blender begins a line that says why it does not take something.
_ERROR: Final = re.compile(r"\s*(FATAL_)?ERROR\b")


def find_blender(given: Path | None = None) -> Path:
    """Find a Blender program.

    Parameters
    ----------
    given
        Use this one.

    Raises
    ------
    InputError
        If there is none.
    """
    if given is not None:
        if not given.is_file():
            raise InputError(f"no such program: {given}; give the path of Blender.")
        return given.absolute()
    for candidate in _candidates():
        if candidate.is_file():
            return candidate.absolute()
    raise InputError("no Blender found; say where it is with --blender PATH.")


def _candidates() -> Iterator[Path]:
    for place in (os.environ.get("BLENDER"), shutil.which("blender")):
        if place:
            yield Path(place)
    yield Path("/Applications/Blender.app/Contents/MacOS/Blender")
    programs = os.environ.get("PROGRAMFILES")
    if programs:
        yield from sorted(
            Path(programs).glob("Blender Foundation/Blender */blender.exe"), reverse=True
        )


def python_of(blender: Path) -> str:
    """Return the Python version that a Blender carries.

    Raises
    ------
    ComputationError
        If it does not start.
    """
    mark = "pdtheory-python:"
    code = f"import sys; print('{mark}%d.%d' % sys.version_info[:2])"
    said = run_tool(str(blender), "--background", "--factory-startup", "--python-expr", code)
    for line in said.splitlines():
        if line.startswith(mark):
            return line[len(mark) :].strip()
    raise ComputationError(f"{blender} did not say which Python it carries; is it Blender 4.2+?")


def install_zip(blender: Path, package: Path) -> None:
    """Install a zip into a Blender and switch it on.

    Raises
    ------
    InputError
        If the file is no zip of the extension.
    FileAccessError
        If it cannot be read.
    ComputationError
        If Blender refuses it.
    """
    with _opened(package) as archive:
        if "blender_manifest.toml" not in archive.namelist():
            raise InputError(f"{package} is no Blender extension; build one with addon build.")
    extension = (str(blender), "--command", "extension")
    said = run_tool(
        *extension, "install-file", "--repo", "user_default", "--enable", str(package.resolve())
    )
    # Blender ends well, too, where it refuses a zip; an older one may be installed all the same.
    refusal = next((line.strip() for line in said.splitlines() if _ERROR.match(line)), None)
    if refusal is None and "principal_directions [installed]" not in run_tool(*extension, "list"):
        refusal = "it did not say why"
    if refusal is not None:
        raise ComputationError(f"{blender} did not take {package.name}: {refusal}.")


@contextmanager
def _opened(package: Path) -> Iterator[zipfile.ZipFile]:
    try:
        with zipfile.ZipFile(package) as archive:
            yield archive
    except FileNotFoundError as error:
        raise InputError(f"no such file: {package}.") from error
    except OSError as error:
        raise FileAccessError(
            f"cannot read {package}: {error.strerror}; give a zip made by addon build."
        ) from error
    except zipfile.BadZipFile as error:
        raise InputError(f"{package} is no zip; build one with addon build.") from error
