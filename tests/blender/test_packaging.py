"""The zips of the extension: built, validated, installed, used, removed."""

from __future__ import annotations

import shutil
import subprocess
import sys
import tomllib
import zipfile
from pathlib import Path

import pytest
from typer.testing import CliRunner

from pdtheory.blender import installing, packaging
from pdtheory.errors import ComputationError, FileAccessError, InputError, MissingDependencyError


@pytest.fixture
def no_downloads(monkeypatch):
    """Put an empty wheel where the libraries would be."""

    def run(*command):
        if "wheel" in command[:8] or "download" in command[:8]:
            folder = next(
                (w.removeprefix("--dest=") for w in command if w.startswith("--dest=")), None
            )
            name = "library-1.0-py3-none-any.whl"
            if folder is None:
                folder = command[command.index("--wheel-dir") + 1]
                project = tomllib.loads((Path(command[-1]) / "pyproject.toml").read_text())
                name = f"pdtheory-{project['project']['version']}-py3-none-any.whl"
            with zipfile.ZipFile(f"{folder}/{name}", "w") as wheel:
                wheel.writestr("nothing.txt", "")
            return ""
        return real(*command)

    real = packaging.run_tool
    monkeypatch.setattr(packaging, "run_tool", run)
    monkeypatch.setattr(packaging, "_pip", lambda: ["pip"])


@pytest.mark.blender
@pytest.mark.parametrize("runtime", packaging.RUNTIMES)
@pytest.mark.parametrize("platform", packaging.PLATFORMS)
def test_zip_has_everything_and_is_valid(tmp_path, no_downloads, runtime, platform):
    import pdtheory

    package = packaging.build_zip(runtime, platform, tmp_path / "dist")
    assert (
        package.name == f"principal_directions-{pdtheory.__version__}-{runtime.tag}-{platform}.zip"
    )
    with zipfile.ZipFile(package) as archive:
        names = set(archive.namelist())
        manifest = tomllib.loads(archive.read("blender_manifest.toml").decode())
    assert {"__init__.py", "panels.py", "LICENSE"} <= names
    assert not any("__pycache__" in name for name in names)
    assert manifest["platforms"] == [platform]
    assert manifest["blender_version_min"] == runtime.blender_min
    assert manifest.get("blender_version_max") == runtime.blender_max
    assert {name.removeprefix("./") for name in manifest["wheels"]} <= names
    assert not any("numpy" in name for name in manifest["wheels"])
    assert any(f"pdtheory-{pdtheory.__version__}+s" in name for name in manifest["wheels"])


@pytest.mark.blender
def test_a_zip_is_written_whole_or_not_at_all(tmp_path, no_downloads, monkeypatch):
    def broken(source, target, **rest):
        if Path(target).suffix != ".zip":
            return real(source, target, **rest)
        Path(target).write_bytes(Path(source).read_bytes()[:100])
        raise OSError(28, "No space left on device")

    real = packaging.shutil.copyfile
    monkeypatch.setattr(packaging.shutil, "copyfile", broken)
    with pytest.raises(FileAccessError, match="No space left on device"):
        packaging.build_zip(packaging.RUNTIMES[0], "linux-x64", tmp_path)
    assert not list(tmp_path.iterdir())


@pytest.mark.blender
@pytest.mark.parametrize("folder", ["file", "file/below"])
def test_a_folder_that_cannot_be_made_is_a_sentence(tmp_path, folder):
    (tmp_path / "file").write_text("")
    with pytest.raises(FileAccessError, match="cannot make the folder"):
        packaging.build_zip(packaging.RUNTIMES[0], "linux-x64", tmp_path / folder)


def test_the_wheel_of_another_source_has_another_version(tmp_path):
    """Blender keeps a wheel that it has, by its version, when an extension is installed again."""

    def version():
        folder = tmp_path / "library"
        shutil.rmtree(folder, ignore_errors=True)
        packaging._stage_library(root, folder)
        return tomllib.loads((folder / "pyproject.toml").read_text())["project"]["version"]

    root = tmp_path / "root"
    for package in ("pdtheory", "synthetic_surfaces"):
        (root / package / "__pycache__").mkdir(parents=True)
        (root / package / "__init__.py").write_text("a = 1\n")
    for name in ("README.md", "LICENSE"):
        (root / name).write_text("")
    (root / "pyproject.toml").write_text('[project]\nversion = "1.2.3"\n[tool]\nversion = "4"\n')
    before = version()
    assert before.startswith("1.2.3+s")
    (root / "pdtheory" / "__pycache__" / "a.pyc").write_text("compiled")
    assert version() == before
    (root / "pdtheory" / "__init__.py").write_text("a = 2\n")
    assert version() != before


def test_unknown_platform_and_python_are_refused(tmp_path):
    with pytest.raises(InputError, match="'amiga' is not known"):
        packaging.build_zip(packaging.RUNTIMES[0], "amiga", tmp_path)
    with pytest.raises(InputError, match=r"'2.7' is not available"):
        packaging.runtime_for("2.7")
    assert packaging.runtime_for("3.14").tag == "cp314"


def test_without_tools_a_sentence_says_what_is_missing(monkeypatch):
    monkeypatch.setattr(packaging, "find_spec", lambda name: None)
    monkeypatch.setattr(packaging.shutil, "which", lambda name: None)
    with pytest.raises(MissingDependencyError, match="extension tool"):
        packaging._extension_tool()
    with pytest.raises(MissingDependencyError, match="pip or uv"):
        packaging._pip()


def test_a_tool_that_fails_is_a_sentence():
    with pytest.raises(ComputationError, match="no such thing"):
        packaging.run_tool(sys.executable, "-c", "import sys; sys.exit('no such thing')")


def test_blender_is_found_or_asked_for(tmp_path, monkeypatch):
    program = tmp_path / "blender"
    program.write_text("")
    assert installing.find_blender(program) == program
    monkeypatch.setenv("BLENDER", str(program))
    assert installing.find_blender() == program
    with pytest.raises(InputError, match="no such program"):
        installing.find_blender(tmp_path / "missing")
    # A program is started by its path, not searched for by its bare name.
    monkeypatch.chdir(tmp_path)
    assert installing.find_blender(Path("blender")) == program


def test_a_program_that_does_not_start_is_a_sentence(tmp_path):
    program = tmp_path / "blender"
    program.write_text("")
    with pytest.raises(ComputationError, match="blender does not start"):
        installing.python_of(program)


@pytest.mark.parametrize(("content", "message"), [(None, "no such file"), (b"x", "is no zip")])
def test_what_is_no_extension_is_not_installed(tmp_path, content, message):
    package = tmp_path / "package.zip"
    if content is not None:
        package.write_bytes(content)
    with pytest.raises(InputError, match=message):
        installing.install_zip(tmp_path / "blender", package)


@pytest.mark.skipif(sys.platform == "win32", reason="the stand-in for Blender is a shell script")
def test_a_zip_that_blender_refuses_is_a_sentence(tmp_path):
    package = tmp_path / "package.zip"
    with zipfile.ZipFile(package, "w") as archive:
        archive.writestr("blender_manifest.toml", "")
    program = tmp_path / "blender"
    program.write_text("#!/bin/sh\n[ $3 = list ] || echo 'ERROR: needs version 5.1.0'\n")
    program.chmod(0o755)
    with pytest.raises(ComputationError, match="ERROR: needs version 5"):
        installing.install_zip(program, package)


@pytest.mark.skipif(sys.platform == "win32", reason="the stand-in for Blender is a shell script")
def test_a_refused_zip_is_told_from_an_older_one_that_is_installed(tmp_path, monkeypatch):
    package = tmp_path / "package.zip"
    with zipfile.ZipFile(package, "w") as archive:
        archive.writestr("blender_manifest.toml", "")
    program = tmp_path / "blender"
    program.write_text(
        "#!/bin/sh\n[ $3 = list ] && SAID='principal_directions [installed]'\necho \"$SAID\"\n"
    )
    program.chmod(0o755)
    monkeypatch.setenv("SAID", 'STATUS Installed "ERROR_free"')
    installing.install_zip(program, package)
    monkeypatch.setenv("SAID", "ERROR principal_directions: This Blender version is too old")
    with pytest.raises(ComputationError, match=r"did not take package.zip: ERROR principal"):
        installing.install_zip(program, package)


def test_a_folder_is_not_installed(tmp_path):
    with pytest.raises(FileAccessError, match="Is a directory"):
        installing.install_zip(tmp_path / "blender", tmp_path)


def test_what_a_tool_failed_at_is_not_made_up():
    with pytest.raises(ComputationError, match=r"^\S+ failed: exit code 1\.$"):
        packaging.run_tool(sys.executable, "-c", "raise SystemExit(1)")


def test_installing_without_a_zip_says_how_to_build_one(tmp_path, monkeypatch):
    from pdtheory.cli.addon import app

    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(installing, "find_blender", lambda given: tmp_path / "blender")
    monkeypatch.setattr(installing, "python_of", lambda program: "3.13")
    result = CliRunner().invoke(app, ["install"])
    assert isinstance(result.exception, InputError)
    assert "addon build" in str(result.exception)


@pytest.mark.slow
@pytest.mark.blender
def test_install_enable_compute_uninstall(tmp_path):
    """The whole life of the extension in the bpy wheel, from wheels fetched from the registry."""
    pytest.importorskip("bpy", exc_type=ImportError)
    from dataclasses import replace

    version = "{}.{}".format(*sys.version_info[:2])
    # The libraries must go with the NumPy that this bpy runs on.
    import numpy as np

    runtime = replace(packaging.runtime_for(version), numpy=f"numpy=={np.__version__}")
    package = packaging.build_zip(runtime, "linux-x64", tmp_path / "dist")
    with zipfile.ZipFile(package) as archive:
        wheels = {Path(n).name.split("-")[0] for n in archive.namelist() if n.endswith(".whl")}
    assert {"pdtheory", "scipy", "numba", "sympy", "python_flint", "matplotlib"} <= wheels
    assert "numpy" not in wheels
    home = tmp_path / "home"
    home.mkdir()
    script = tmp_path / "life.py"
    script.write_text(_LIFE)
    done = subprocess.run(
        [sys.executable, "-I", str(script), str(package)],
        env={"BLENDER_USER_RESOURCES": str(home), "PATH": "/usr/bin:/bin", "HOME": str(home)},
        capture_output=True,
        text=True,
        check=False,
    )
    assert "lived happily" in done.stdout, done.stdout[-2000:] + done.stderr[-2000:]


_LIFE = """
import sys
import os
# The wheels of the zip are to be used, not the source this test comes from.
sys.path = [p for p in sys.path if not os.path.isdir(os.path.join(p, "blender_addon"))]
import bpy
bpy.ops.wm.read_homefile(use_factory_startup=True)
bpy.ops.extensions.package_install_files(
    filepath=sys.argv[1], repo="user_default", enable_on_install=True
)
module = "bl_ext.user_default.principal_directions"
assert module in bpy.context.preferences.addons
import pdtheory
assert ".local" in pdtheory.__file__, pdtheory.__file__
bpy.ops.principal_directions.add_monkey(resolution=12)
bpy.ops.principal_directions.compute(neighbours=40, degree=4, orders={"2", "3"})
assert "points answered" in bpy.context.object.principal_directions.summary
assert bpy.ops.principal_directions.plot_point() == {"FINISHED"}
bpy.ops.extensions.package_uninstall(repo_directory="", repo_index=1, pkg_id="principal_directions")
assert module not in bpy.context.preferences.addons
print("lived happily")
"""
