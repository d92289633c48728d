"""Every Python block and every command of the documentation runs, page by page, in its order."""

from __future__ import annotations

import contextlib
import io
import re
import shlex
import shutil
from importlib.util import find_spec
from pathlib import Path

import numpy as np
import pytest
from typer.testing import CliRunner

import synthetic_surfaces
from pdtheory.cli.main import app
from pdtheory.io import write_cloud
from pdtheory.pointset import PointCloud

ROOT = Path(__file__).parents[2]
DOCS = ROOT / "docs"
GUIDES = [ROOT / "README.md", ROOT / "CONTRIBUTING.md"]
PAGES = sorted([*GUIDES, *DOCS.glob("*.md"), *DOCS.glob("howto/*.md")])

_FENCE = re.compile(r"^( *)```([^\n`]*)\n(.*?)^\1```$", re.MULTILINE | re.DOTALL)

_INCLUDE = re.compile(r"^```\{include\} (\S+)\n(.*?)^```$", re.MULTILINE | re.DOTALL)

#: Commands that other tests run, because they take minutes or need more than a folder.
ELSEWHERE = {
    "pdtheory addon": "tests/blender/test_packaging.py",
    "pdtheory demo": "tests/cli/test_demo.py",
    "pdtheory draw": "tests/blender/test_draw.py",
    "pdtheory figure": "tests/figures/test_command.py",
    "pdtheory surfaces --thumbnails": "tests/synthetic/test_surface_commands.py",
    "pdtheory verify": "tests/claims/test_verify.py",
}
#: Lines of a shell that belong to other programs.
FOREIGN = (
    "make",
    ". .venv/",
    "uv ",
    "pip ",
    "sudo apt-get",
    "apt-get",
    "python ",
    "git ",
    "blender ",
)
#: Blocks that run inside Blender, by their first line, and the tests that run the same.
IN_BLENDER = {"import bpy": "tests/blender/test_extension.py"}
#: Extras that a block asks for.
NEEDS = {"view": "pyvista", "to_pyvista": "pyvista", "to_dataframe": "pandas", "plot": "matplotlib"}


def blocks(page: Path) -> list[tuple[str, str]]:
    """Return (language, text) of the fenced blocks of a page, without their indentation."""
    found = _FENCE.findall(page.read_text(encoding="utf-8"))
    return [
        (language, "\n".join(line.removeprefix(indent) for line in text.splitlines()))
        for indent, language, text in found
    ]


def commands(page: Path) -> list[str]:
    """Return the commands of a page, without comments and continued lines joined."""
    lines = [
        line
        for language, text in blocks(page)
        if language in ("", "sh")
        for line in text.replace("\\\n", " ").splitlines()
    ]
    stripped = [" ".join(shlex.split(line, comments=True)) and line for line in lines]
    return [line.strip() for line in stripped if line and line.strip()]


@pytest.fixture
def folder(files, tmp_path, monkeypatch) -> Path:
    """A folder of its own for each page, with the files that the pages speak of."""
    shutil.copytree(files, tmp_path, dirs_exist_ok=True)
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.fixture(scope="module")
def files(tmp_path_factory) -> Path:
    """The files that the pages speak of."""
    here = tmp_path_factory.mktemp("docs")
    torus = synthetic_surfaces.get("torus")
    write_cloud(torus.mesh(32), here / "scan.ply")
    write_cloud(torus.sample(1_500, noise=0.1, seed=1), here / "noisy.ply")
    x, y = np.random.default_rng(2).uniform(-1, 1, (2, 1_500))
    write_cloud(PointCloud(np.column_stack([x, y, 0.3 * x**2 - 0.2 * x * y**2])), here / "open.ply")
    return here


def test_the_pages_are_found():
    assert len(PAGES) > 20
    assert sum(len(commands(page)) for page in PAGES) > 30


@pytest.mark.parametrize("page", PAGES, ids=lambda page: str(page.relative_to(ROOT)))
def test_python(page, folder):
    texts = [text for language, text in blocks(page) if language == "python"]
    names = {"points": synthetic_surfaces.get("torus").sample(3_000, seed=3).points}
    ran = 0
    for text in texts:
        if text.splitlines()[0] in IN_BLENDER:
            continue
        missing = [name for word, name in NEEDS.items() if f".{word}(" in text]
        if any(find_spec(name) is None for name in missing):
            continue
        with contextlib.redirect_stdout(io.StringIO()):
            exec(compile(text, str(page), "exec"), names)
        ran += 1
    if texts and not ran:
        pytest.skip("its blocks run inside Blender or need an extra")


@pytest.mark.parametrize("page", PAGES, ids=lambda page: str(page.relative_to(ROOT)))
def test_commands(page, folder):
    for line in commands(page):
        if line.startswith(FOREIGN) or any(line.startswith(known) for known in ELSEWHERE):
            continue
        words = shlex.split(line, comments=True)
        assert words[0] == "pdtheory", f"{page.name}: what is {line!r}?"
        if words[1] == "view" and find_spec("pyvista") is None:
            continue
        if "--plot" in words and find_spec("matplotlib") is None:
            continue
        result = CliRunner().invoke(app, words[1:])
        assert result.exit_code == 0, f"{line}\n{result.output}"


def test_what_runs_elsewhere_does():
    for command, place in {**ELSEWHERE, **IN_BLENDER}.items():
        assert (ROOT / place).is_file(), command


def test_links_between_pages_lead_somewhere():
    link = re.compile(r"\]\((?!https?:|#)([^)#]+)(?:#[^)]*)?\)")
    for page in PAGES:
        for target in link.findall(page.read_text(encoding="utf-8")):
            # The gallery exists once the documentation has been built.
            if not target.startswith("auto_examples/"):
                assert (page.parent / target).exists(), f"{page.name}: {target}"


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.name)
def test_what_a_page_includes_is_there(page: Path) -> None:
    """The site builds elsewhere; a part that another page includes must keep its first words."""
    for name, options in _INCLUDE.findall(page.read_text(encoding="utf-8")):
        text = (page.parent / name).read_text(encoding="utf-8")
        for mark in re.findall(r'^:(?:start-after|end-before): "?(.*?)"?$', options, re.MULTILINE):
            assert mark in text, f"{page.name} includes {name} from or to {mark!r}"
