"""What all formulas share: each is in one group, by which an unknown name is answered."""

import importlib
import inspect
import pkgutil

import pytest

import rockeom
from rockeom import analysis
from rockeom.analysis import design, dynamics, formulas, identification, risk, validation

GROUPS = (design, dynamics, formulas, identification, risk, validation)


@pytest.mark.parametrize("group", GROUPS, ids=lambda group: group.__name__)
def test_a_group_has_the_public_names_of_its_modules(group):
    listed = importlib.import_module(group.__name__).__all__
    assert len(set(listed)) == len(listed)
    assert not set(listed) & {name for other in GROUPS if other is not group for name in dir(other)}
    for module in pkgutil.iter_modules(group.__path__, f"{group.__name__}."):
        source = importlib.import_module(module.name)
        assert getattr(group, module.name.rpartition(".")[2]) is source  # no formula hides a module
        public = getattr(source, "__all__", None) or [
            name
            for name, value in vars(source).items()
            if (inspect.isfunction(value) or inspect.isclass(value))
            and value.__module__ == source.__name__
            and not name.startswith("_")
        ]
        assert public
        assert [name for name in public if getattr(group, name) is not vars(source)[name]] == []


def test_names_for_type_checkers_are_those_at_run_time():
    for package in (analysis, *GROUPS):
        text = inspect.getsource(package)
        if package is analysis:
            names = [*analysis.__all__, *(group.__name__.rpartition(".")[2] for group in GROUPS)]
            assert [name for name in names if f"{name} as {name}" not in text] == []
        else:
            modules = [module.name for module in pkgutil.iter_modules(package.__path__)]
            stars = [f"from {package.__name__}.{name} import *" for name in modules]
            assert [star for star in stars if star not in text] == []


def test_formulas_are_in_the_package_and_not_at_the_top():
    assert not set(analysis.__all__) & set(rockeom.__all__)


@pytest.mark.parametrize(
    ("name", "remedy"),
    [
        ("respons_spectrum", r"did you mean response_spectrum\?"),
        ("poincare_section", r"did you mean dynamics.poincare_sections\?"),
        ("quarter_period", r"did you mean formulas.quarter_period\?"),
    ],
)
def test_an_unknown_name_comes_with_a_remedy(name, remedy):
    with pytest.raises(AttributeError, match=remedy):
        getattr(analysis, name)
