"""The extension as zips that Blender installs, with all it needs as wheels."""

from __future__ import annotations

import re
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Sequence
from dataclasses import dataclass
from hashlib import sha256
from importlib.util import find_spec
from pathlib import Path
from typing import Final

from pdtheory.atomic import atomic_path
from pdtheory.errors import (
    ComputationError,
    FileAccessError,
    InputError,
    MissingDependencyError,
)

#: Wheel tags by Blender's name of a platform, best first.
PLATFORMS: Final[dict[str, tuple[str, ...]]] = {
    "linux-x64": ("manylinux_2_28_x86_64", "manylinux_2_17_x86_64", "manylinux2014_x86_64"),
    "windows-x64": ("win_amd64",),
    "macos-arm64": ("macosx_12_0_arm64", "macosx_11_0_arm64"),
}

#: What is packed beside pdtheory itself; NumPy comes with Blender.
_LIBRARIES: Final = (
    "scipy",
    "numba",
    "sympy",
    "mpmath<1.4",
    "python-flint",
    "trimesh",
    "matplotlib",
)

_NUMPY: Final = "numpy"

#: What the wheel of pdtheory holds.
_PACKAGES: Final = ("pdtheory", "synthetic_surfaces")


@dataclass(frozen=True)
class Runtime:
    """A Python that some Blenders carry.

    Attributes
    ----------
    python : str
        Its version, such as ``3.11``.
    numpy : str
        Requirement that the NumPy of those Blenders fulfils; libraries are chosen to go with it.
    blender_min, blender_max : str or None
        The Blenders that carry it, the second exclusive.
    """

    python: str
    numpy: str
    blender_min: str
    blender_max: str | None

    @property
    def tag(self) -> str:
        """The tag of its wheels."""
        return "cp" + self.python.replace(".", "")


#: Blender 4.2 to 5.0 has Python 3.11 and NumPy 1.24 or 1.26, later ones have Python 3.13.
RUNTIMES: Final = (
    Runtime("3.11", "numpy==1.24.*", "4.2.0", "5.1.0"),
    Runtime("3.13", "numpy==2.2.*", "5.1.0", None),
)


def runtime_for(python: str) -> Runtime:
    """Return the runtime of a Python version; some distributions carry other ones than these.

    Raises
    ------
    InputError
        If it is not a version from 3.11 on.
    """
    for runtime in RUNTIMES:
        if runtime.python == python:
            return runtime
    major, _, minor = python.partition(".")
    if major != "3" or not minor.isdecimal() or int(minor) < 11:
        raise InputError(f"the Python {python!r} is not available; give 3.11 or later, as in 3.13.")
    return Runtime(python, "numpy>=2.2", "4.2.0", None)


def source_root() -> Path:
    """Return the checkout with the extension's folder.

    Raises
    ------
    InputError
        If this pdtheory does not run from one.
    """
    import pdtheory

    root = Path(pdtheory.__file__).parents[1]
    if not (root / "blender_addon" / "blender_manifest.toml").is_file():
        raise InputError(
            "the extension is built from the source of pdtheory, and this installation is none; "
            "clone the repository and run the command there."
        )
    return root


def build_zip(runtime: Runtime, platform: str, folder: Path) -> Path:
    """Build and validate one zip.

    Parameters
    ----------
    runtime
        The Python it is for.
    platform
        One of :data:`PLATFORMS`.
    folder
        Where the zip goes; it is made if needed.

    Returns
    -------
    Path
        The zip.

    Raises
    ------
    InputError
        If the platform is not known, or this pdtheory does not run from its source.
    MissingDependencyError
        If pip or Blender's extension tool cannot be found.
    FileAccessError
        If the folder cannot be made or written to.
    ComputationError
        If one of the tools fails, with what it said.
    """
    if platform not in PLATFORMS:
        raise InputError(
            f"the platform {platform!r} is not known; give one of {', '.join(PLATFORMS)}."
        )
    root = source_root()
    tool = _extension_tool()
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise FileAccessError(
            f"cannot make the folder {folder}: {error.strerror}; choose another one."
        ) from error
    with tempfile.TemporaryDirectory() as scratch:
        stage = Path(scratch) / "principal_directions"
        shutil.copytree(
            root / "blender_addon", stage, ignore=shutil.ignore_patterns("__pycache__", "*.pyc")
        )
        wheels = stage / "wheels"
        wheels.mkdir()
        pip = _pip()
        library = _stage_library(root, Path(scratch) / "library")
        run_tool(*pip, "wheel", "--quiet", "--no-deps", "--wheel-dir", str(wheels), str(library))
        _download(pip, runtime, platform, wheels)
        version = _complete_manifest(stage, runtime, platform)
        target = folder / f"principal_directions-{version}-{runtime.tag}-{platform}.zip"
        built = Path(scratch) / target.name
        blender_tool = (sys.executable, str(tool))
        run_tool(
            *blender_tool, "build", "--source-dir", str(stage), "--output-filepath", str(built)
        )
        run_tool(*blender_tool, "validate", str(built))
        with atomic_path(target) as temporary:
            shutil.copyfile(built, temporary)
    return target


def _stage_library(root: Path, folder: Path) -> Path:
    """Copy what the wheel of pdtheory is made of, under a version that tells its contents.

    Where an extension is installed again, Blender keeps a wheel of the same version.
    """
    for name in _PACKAGES:
        ignored = shutil.ignore_patterns("__pycache__", "*.pyc")
        shutil.copytree(root / name, folder / name, ignore=ignored)
    digest = sha256()
    for path in sorted(path for path in folder.rglob("*") if path.is_file()):
        digest.update(path.relative_to(folder).as_posix().encode() + b"\0" + path.read_bytes())
    project = (root / "pyproject.toml").read_text(encoding="utf-8")
    for name in ("README.md", "LICENSE"):
        shutil.copy(root / name, folder)
    # A letter first: a version part of digits alone would lose its leading zeros.
    told = rf'version = "\1+s{digest.hexdigest()[:12]}"'
    project = re.sub(r'^version = "(.*)"$', told, project, count=1, flags=re.MULTILINE)
    (folder / "pyproject.toml").write_text(project, encoding="utf-8")
    return folder


def _download(pip: Sequence[str], runtime: Runtime, platform: str, folder: Path) -> None:
    """Gather the wheels of the libraries, without NumPy."""
    tags = [f"--platform={tag}" for tag in PLATFORMS[platform]]
    tags += [f"--abi={abi}" for abi in (runtime.tag, "abi3", "none")]
    tags += [f"--python-version={runtime.python}", "--implementation=cp"]
    wanted = (*_LIBRARIES, runtime.numpy)
    run_tool(*pip, "download", "--quiet", "--only-binary=:all:", f"--dest={folder}", *tags, *wanted)
    for wheel in folder.glob(f"{_NUMPY}-*.whl"):
        wheel.unlink()


def _complete_manifest(stage: Path, runtime: Runtime, platform: str) -> str:
    """Write version, platform, Blenders and wheels into the manifest; return the version."""
    import pdtheory

    manifest = stage / "blender_manifest.toml"
    wheels = sorted(path.name for path in (stage / "wheels").glob("*.whl"))
    lines = []
    for line in manifest.read_text(encoding="utf-8").splitlines():
        key = line.partition("=")[0].strip()
        if key == "version":
            line = f'version = "{pdtheory.__version__}"'
        elif key == "blender_version_min":
            line = f'blender_version_min = "{runtime.blender_min}"'
            if runtime.blender_max is not None:
                line += f'\nblender_version_max = "{runtime.blender_max}"'
            line += f'\nplatforms = ["{platform}"]\nwheels = [\n'
            line += "".join(f'  "./wheels/{name}",\n' for name in wheels) + "]"
        lines.append(line)
    manifest.write_text("\n".join(lines) + "\n", encoding="utf-8")
    return pdtheory.__version__


def _extension_tool() -> Path:
    """Return the path of Blender's own tool for extensions, which comes with the bpy wheel.

    Raises
    ------
    MissingDependencyError
        If bpy is not installed.
    """
    found = find_spec("bpy")
    for place in (found.submodule_search_locations or ()) if found is not None else ():
        for tool in Path(place).glob("*/scripts/addons_core/bl_pkg/cli/blender_ext.py"):
            return tool
    raise MissingDependencyError(
        "building the extension needs Blender's extension tool, which comes with the Python module "
        "bpy; install it with `uv sync --extra blender` (Python 3.11 or 3.13)."
    )


def _pip() -> list[str]:
    """Return a command that runs pip.

    Raises
    ------
    MissingDependencyError
        If neither pip nor uv is there.
    """
    if find_spec("pip") is not None:
        return [sys.executable, "-m", "pip", "--disable-pip-version-check"]
    if shutil.which("uv"):
        return ["uv", "tool", "run", "--quiet", "pip", "--disable-pip-version-check"]
    raise MissingDependencyError("gathering the wheels needs pip or uv; install one of them.")


def run_tool(*command: str) -> str:
    """Run a tool and return what it printed.

    Raises
    ------
    ComputationError
        If it fails, or cannot be started.
    """
    try:
        done = subprocess.run(command, capture_output=True, text=True, check=False)
    except OSError as error:
        raise ComputationError(f"{command[0]} does not start ({error.strerror}).") from error
    if done.returncode:
        said = (done.stderr.strip() or done.stdout.strip()).splitlines()
        raise ComputationError(
            f"{Path(command[0]).name} failed: "
            f"{said[-1].strip() if said else f'exit code {done.returncode}'}."
        )
    return done.stdout
