"""What all formulas share: documented and re-exported."""

import importlib
import inspect
import pkgutil

import pytest

import rockeom
from rockeom import analysis

FORMULAS = [name for name in analysis.__all__ if inspect.isfunction(getattr(analysis, name))]


@pytest.mark.parametrize("name", FORMULAS)
def test_formula_says_what_it_takes_and_where_it_is_from(name):
    text = inspect.getdoc(getattr(analysis, name))
    assert text
    # each parameter is named, or the reader is sent to the function that names it
    parameters = inspect.signature(getattr(analysis, name)).parameters
    if not any(f"`{other}`" in text for other in FORMULAS):
        assert [p for p in parameters if p not in text] == []


def test_everything_public_is_re_exported():
    for module in pkgutil.walk_packages(analysis.__path__, "rockeom.analysis."):
        own = ("rockeom.analysis.arguments", "rockeom.analysis.unfinished")  # of the package itself
        if module.name in own or module.ispkg:
            continue
        source = importlib.import_module(module.name)
        home, _, name = module.name.rpartition(".")
        assert getattr(importlib.import_module(home), name) is source  # no formula hides a module
        public = [
            name
            for name, value in vars(source).items()
            if (inspect.isfunction(value) or inspect.isclass(value))
            and value.__module__ == source.__name__
            and not name.startswith("_")
        ]
        assert public
        assert [name for name in public if name not in analysis.__all__] == []


def test_formulas_are_in_the_package_and_not_at_the_top():
    assert not set(analysis.__all__) & set(rockeom.__all__)
