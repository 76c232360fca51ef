"""The examples in docstrings print what they say."""

import doctest
import importlib
import pkgutil

import pytest
import tumble

MODULES = sorted(
    m.name for m in pkgutil.walk_packages(tumble.__path__, "tumble.") if not m.name.endswith("__main__") and ".template" not in m.name
)


@pytest.mark.parametrize("name", MODULES)
def test_docstrings_are_true(name: str) -> None:
    assert doctest.testmod(importlib.import_module(name)).failed == 0


@pytest.mark.parametrize(
    "name", ["drop", "lcp", "lcp.solvers", "lcp.contacts", "lcp.rational", "_shapes", "_scene", "_rollout", "_simulate", "_simulation", "_trajectory"]
)
def test_there_are_examples(name: str) -> None:
    module = importlib.import_module(f"tumble.{name}")
    assert any(test.examples for test in doctest.DocTestFinder().find(module))
