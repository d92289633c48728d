from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from typer.testing import CliRunner, Result

from pdtheory.cli.main import app


@pytest.fixture
def cli() -> Callable[..., Result]:
    """Run the command line in this process, like a user would from a shell."""

    def run(*arguments: object) -> Result:
        return CliRunner().invoke(app, [str(argument) for argument in arguments])

    return run


@pytest.fixture
def refused(cli: Callable[..., Result]) -> Callable[..., str]:
    """Run a command that must be refused: exit code 2, one sentence, no traceback."""

    def run(*arguments: object) -> str:
        result = cli(*arguments)
        assert result.exit_code == 2, result.output
        message = result.stderr.strip()
        assert message.startswith("pdtheory: ")
        assert message.endswith(".")
        assert "Traceback" not in message
        assert len(message.splitlines()) == 1
        return message

    return run


@pytest.fixture
def bumpy_cloud(tmp_path: Path) -> Path:
    """A small smooth point cloud as a text file."""
    x, y = np.random.default_rng(5).uniform(-1.0, 1.0, (2, 600))
    z = 0.3 * x**2 - 0.1 * y**2 + 0.2 * (x**3 - 3 * x * y**2)
    path = tmp_path / "bumpy.xyz"
    np.savetxt(path, np.stack([x, y, z], axis=1))
    return path
