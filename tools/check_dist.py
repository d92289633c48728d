"""Build the sdist and the wheel, and prove that each works where nothing else is installed.

    uv run --group dist python tools/check_dist.py [--tag v1.2.3]

Both are checked by twine, searched for what they must and must not hold, installed into an empty
environment each, and run there: ``python -m pdtheory demo``.
"""

from __future__ import annotations

import argparse
import os
import shutil
import subprocess
import sys
import tarfile
import tempfile
import zipfile
from pathlib import Path

ROOT = Path(__file__).parents[1]
DIST = ROOT / "dist"

#: What a user must find in the wheel, and what must be in the sdist beside it.
IN_WHEEL = ("pdtheory/py.typed", "synthetic_surfaces/py.typed", "pdtheory/testing/test_forms.py")
IN_SDIST = ("README.md", "LICENSE", "CHANGELOG.md", "tests/conftest.py", "docs/index.md")
#: What is made on the way and belongs into neither.
UNWANTED = ("__pycache__", ".npz", "docs/_build/", "docs/auto_examples/", "docs/generated/")


def main() -> None:
    """Build, check, install, run."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--tag", help="the tag of the release, which must name this version")
    tag = parser.parse_args().tag
    for old in (*DIST.glob("pdtheory-*.whl"), *DIST.glob("pdtheory-*.tar.gz")):
        old.unlink()
    run(uv(), "build", "--quiet", "--out-dir", str(DIST))
    (wheel,), (sdist,) = DIST.glob("pdtheory-*.whl"), DIST.glob("pdtheory-*.tar.gz")
    version = wheel.name.split("-")[1]
    if tag is not None and tag != f"v{version}":
        sys.exit(f"the tag is {tag} and the version {version}: change one of them.")
    run(sys.executable, "-m", "twine", "check", "--strict", str(wheel), str(sdist))
    with zipfile.ZipFile(wheel) as archive:
        check_names(wheel, archive.namelist(), IN_WHEEL)
    with tarfile.open(sdist) as archive:
        names = [name.partition("/")[2] for name in archive.getnames()]
        check_names(sdist, names, IN_WHEEL + IN_SDIST)
    for package in (wheel, sdist):
        check_install(package, version)
    print(f"{wheel.name} and {sdist.name} install and run.")


def uv() -> str:
    """Return the uv that the Makefile uses."""
    return os.environ.get("UV") or shutil.which("uv") or str(ROOT / ".tools/bin/uv")


def run(*command: str, cwd: Path = ROOT, silent: bool = False) -> None:
    """Run a command, without what this environment would lend it; errors are always shown."""
    lent = ("VIRTUAL_ENV", "PYTHONPATH", "UV_PYTHON")
    environment = {name: value for name, value in os.environ.items() if name not in lent}
    out = subprocess.DEVNULL if silent else None
    done = subprocess.run(command, cwd=cwd, env=environment, stdout=out)
    if done.returncode:
        sys.exit(f"failed with exit code {done.returncode}: {' '.join(command)}")


def check_names(package: Path, names: list[str], needed: tuple[str, ...]) -> None:
    """Stop if something is missing from a package or does not belong into it."""
    missing = [name for name in needed if name not in names]
    surplus = [name for name in names if any(part in name for part in UNWANTED)]
    if missing:
        sys.exit(f"{package.name} lacks {', '.join(missing)}.")
    if surplus:
        sys.exit(f"{package.name} holds {', '.join(surplus[:5])}, which is made on the way.")


def check_install(package: Path, version: str) -> None:
    """Install a package into an empty environment and run the demo there."""
    with tempfile.TemporaryDirectory() as folder:
        home = Path(folder)
        run(uv(), "venv", "--quiet", "--python", sys.executable, str(home / "env"))
        scripts = home / "env" / ("Scripts" if os.name == "nt" else "bin")
        python = str(scripts / "python")
        run(uv(), "pip", "install", "--quiet", "--python", python, str(package))
        code = f"import pdtheory; assert pdtheory.__version__ == {version!r}, pdtheory.__version__"
        run(python, "-c", code, cwd=home)
        run(python, "-m", "pdtheory", "demo", "--quiet", cwd=home, silent=True)
        if not (home / "demo" / "field.npz").is_file():
            sys.exit(f"the demo of {package.name} wrote no field.")


if __name__ == "__main__":
    main()
