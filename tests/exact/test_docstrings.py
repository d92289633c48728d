"""The examples in the docstrings of the exact side are true."""

import doctest
import importlib
import pkgutil

import pytest

import pdtheory.exact

MODULES = sorted(m.name for m in pkgutil.iter_modules(pdtheory.exact.__path__))


@pytest.mark.parametrize("name", MODULES)
def test_examples(name):
    module = importlib.import_module(f"pdtheory.exact.{name}")
    assert doctest.testmod(module).failed == 0
