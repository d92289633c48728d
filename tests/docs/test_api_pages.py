"""What the packages export has a page in the reference."""

import importlib
from pathlib import Path

import pytest

API = Path(__file__).parents[2] / "docs" / "api.md"


@pytest.mark.parametrize(
    "package",
    [
        "pdtheory.blender",
        "pdtheory.exact",
        "pdtheory.io",
        "pdtheory.pointset",
        "pdtheory.viewer",
        "synthetic_surfaces",
    ],
)
def test_everything_exported_is_listed(package: str) -> None:
    listed = {line.strip().rpartition(".")[2] for line in API.read_text().splitlines()}
    exported = importlib.import_module(package).__all__
    assert exported
    assert set(exported) <= listed
