"""The light start: nothing heavy is loaded before a command needs it."""

import subprocess
import sys

import pytest

HEAVY = ("numpy", "scipy", "numba", "sympy", "flint", "mpmath", "trimesh", "bpy", "matplotlib")


def loaded_after(statement: str) -> set[str]:
    code = f"import sys; {statement}; print(*sys.modules, sep='\\n')"
    result = subprocess.run(
        [sys.executable, "-c", code], capture_output=True, text=True, check=True
    )
    return {line.partition(".")[0] for line in result.stdout.splitlines()}


@pytest.mark.parametrize("statement", ["import pdtheory", "import pdtheory.cli.main"])
def test_nothing_heavy_is_imported(statement: str) -> None:
    assert loaded_after(statement).isdisjoint(HEAVY)


def test_the_probe_sees_heavy_modules() -> None:
    assert "numpy" in loaded_after("import pdtheory; pdtheory.PointCloud")


def test_engine_starts_without_the_exact_side() -> None:
    assert loaded_after("import pdtheory.pointset").isdisjoint({"sympy", "flint", "bpy", "trimesh"})


def test_unknown_name_is_an_attribute_error() -> None:
    import pdtheory

    with pytest.raises(AttributeError, match="no attribute 'estimat'"):
        pdtheory.estimat  # noqa: B018


def test_every_exported_name_exists() -> None:
    import pdtheory

    for name in pdtheory.__all__:
        assert getattr(pdtheory, name) is not None
    assert set(pdtheory.__all__) <= set(dir(pdtheory))
