"""The process that compiles the kernels and those that load them give the same bits."""

from __future__ import annotations

import os
import subprocess
import sys

import numpy as np
import pytest

from pdtheory.pointset import DirectionField

SCRIPT = """
import sys
import numpy as np
from pdtheory.pointset import estimate_directions

points = np.random.default_rng(3).normal(size=(3_000, 3))
points /= np.linalg.norm(points, axis=1, keepdims=True)
field = estimate_directions(
    points + 0.01 * np.sin(5 * points), radius=0.4, degree=8, orders=(2, 3, 4)
)
field.save(sys.argv[1])
"""


@pytest.mark.slow
def test_compiling_changes_no_bit(tmp_path):
    environment = {**os.environ, "NUMBA_CACHE_DIR": str(tmp_path / "cache")}
    fields = []
    for name in ("compiled.npz", "loaded.npz"):
        target = str(tmp_path / name)
        subprocess.run([sys.executable, "-c", SCRIPT, target], env=environment, check=True)
        fields.append(DirectionField.load(target))
    compiled, loaded = fields
    np.testing.assert_array_equal(compiled.phi, loaded.phi)
    for order in compiled.orders:
        for name in ("angle", "vector", "eigenvalue", "angle_std", "eigenvalue_std"):
            one, two = (getattr(field[order], name) for field in fields)
            np.testing.assert_array_equal(one, two, err_msg=f"{name} of order {order}")
