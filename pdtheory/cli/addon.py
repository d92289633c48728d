"""``pdtheory addon``: the Blender extension, packed and installed."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from pdtheory.errors import InputError

app = typer.Typer(help="The Blender extension, packed and installed.", no_args_is_help=True)


@app.command()
def build(
    output: Annotated[Path, typer.Option("--output", "-o", help="Folder for the zips.")] = Path(
        "dist"
    ),
    python: Annotated[
        list[str] | None,
        typer.Option(
            metavar="VERSION",
            help="Python of the Blender, such as 3.13; 3.11 and 3.13 if left out.",
        ),
    ] = None,
    platform: Annotated[
        list[str] | None,
        typer.Option(
            metavar="NAME", help="linux-x64, windows-x64 or macos-arm64; all if left out."
        ),
    ] = None,
) -> None:
    """Build the zips of the extension with all wheels, validate them and say their sizes.

    Example: pdtheory addon build --python 3.13 --platform linux-x64
    """
    from pdtheory.blender.packaging import PLATFORMS, RUNTIMES, build_zip, runtime_for

    runtimes = [runtime_for(version) for version in python] if python else RUNTIMES
    for runtime in runtimes:
        for name in platform or PLATFORMS:
            package = build_zip(runtime, name, output)
            typer.echo(f"{package}  {package.stat().st_size / 1e6:.1f} MB")


@app.command()
def install(
    package: Annotated[
        Path | None,
        typer.Argument(metavar="PACKAGE", help="The zip; the fitting one in dist if left out."),
    ] = None,
    blender: Annotated[
        Path | None, typer.Option(help="The Blender program; searched for if left out.")
    ] = None,
) -> None:
    """Install the extension into a Blender and switch it on.

    Example: pdtheory addon install --blender ~/blender-5.2/blender
    """
    from pdtheory.blender.installing import find_blender, install_zip, python_of
    from pdtheory.blender.packaging import runtime_for

    program = find_blender(blender)
    if package is None:
        tag = runtime_for(python_of(program)).tag
        fitting = sorted(Path("dist").glob(f"principal_directions-*-{tag}-{_platform()}.zip"))
        if not fitting:
            raise InputError(
                f"there is no zip for {tag} on {_platform()} in dist; "
                "make one with `pdtheory addon build`."
            )
        package = fitting[-1]
    install_zip(program, package)
    typer.echo(f"Installed {package} into {program}")


def _platform() -> str:
    import sys

    return {"win32": "windows-x64", "darwin": "macos-arm64"}.get(sys.platform, "linux-x64")
