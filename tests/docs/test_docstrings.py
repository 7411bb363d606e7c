"""Docstrings of public names have the form of numpydoc, and their examples give what they print."""

import doctest
import functools
import importlib
import inspect
from enum import Enum
from types import FunctionType
from typing import Any

import pytest
from numpydoc.docscrape import get_doc_object
from numpydoc.validate import validate

import rockeom

GROUPS = ("formulas", "design", "dynamics", "identification", "risk", "standards", "validation")
PACKAGES = (
    "rockeom", "rockeom.motion", "rockeom.plots",
    "rockeom.analysis", *(f"rockeom.analysis.{group}" for group in GROUPS),
)  # fmt: skip
CHECKS = {"GL03", "GL08", "SS03", "PR01", "PR02", "PR03", "PR04", "RT01"}


@functools.cache
def public(package: str) -> dict[Any, str]:
    """Public functions and classes of a package, and the members of the classes, with their names.

    A member without a docstring that overrides one with a docstring is described by that.
    """
    module, names = importlib.import_module(package), {}
    for name in module.__all__:
        value = getattr(module, name)
        if inspect.isclass(value) or inspect.isroutine(value):
            names[inspect.unwrap(value)] = f"{package}.{name}"
        of_project = [
            c for c in getattr(value, "__mro__", ()) if c.__module__.startswith("rockeom")
        ]
        for i, base in enumerate(of_project):
            for member, raw in vars(base).items():
                plain = inspect.unwrap(getattr(raw, "__func__", raw))
                above = (getattr(c, member, None) for c in of_project[i + 1 :] if not raw.__doc__)
                if (
                    member[0] != "_"
                    and isinstance(plain, (FunctionType, property, functools.cached_property))
                    and not any(other.__doc__ for other in above)
                ):
                    names.setdefault(plain, f"{package}.{name}.{member}")
    return names


def misses(value: Any) -> list[str]:
    """What numpydoc's checks miss in a docstring."""
    left_out = set()
    if inspect.isclass(value):
        never_called = issubclass(value, Enum) or getattr(value, "_is_protocol", False)
        named = issubclass(value, rockeom.Structure)  # its arguments have no order
        left_out = {"PR01"} if never_called else {"PR03"} if named else set()
    errors = validate(get_doc_object(value, config={"show_class_members": False}))["errors"]
    return [text for code, text in errors if code in CHECKS - left_out]


@pytest.mark.parametrize("package", PACKAGES)
def test_docstrings_say_what_goes_in_and_what_comes_out(package):
    failed = {name: misses(value) for value, name in public(package).items()}
    assert not {name: texts for name, texts in failed.items() if texts}


@pytest.mark.parametrize("package", [*PACKAGES, "rockeom.symbolic"])
def test_examples_give_what_they_print(package, capsys):
    parser, flags = doctest.DocTestParser(), doctest.ELLIPSIS | doctest.NORMALIZE_WHITESPACE
    for value, name in public(package).items():
        test = parser.get_doctest(inspect.cleandoc(value.__doc__ or ""), {}, name, name, 0)
        failed = doctest.DocTestRunner(optionflags=flags).run(test).failed
        assert not failed, capsys.readouterr().out
