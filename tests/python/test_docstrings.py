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


def test_there_are_examples() -> None:
    finder = doctest.DocTestFinder()
    modules = [importlib.import_module(name) for name in ("tumble._scene", "tumble._shapes", "tumble.drop")]
    assert all(any(test.examples for test in finder.find(module)) for module in modules)
