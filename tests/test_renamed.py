"""Former names give what the names of today give, and say so once, at the line that uses them."""

from dataclasses import dataclass

import pytest

from rockeom import renamed


@renamed.arguments(phase="mode")
def force(*, mode):
    return 2 * mode


@renamed.fields(laws="functions")
@dataclass(frozen=True)
class Declaration:
    functions: int


SPRINGS = renamed.names("springs", {"constant": "stiffness"}, {"stiffness": 5}.__getitem__)


USES = {
    "force: phase is now called mode": (lambda: force(phase=3), 6),
    "Declaration: laws is now called functions": (lambda: Declaration(laws=4).functions, 4),
    "Declaration.laws is now called functions": (lambda: Declaration(4).laws, 4),
    "springs.constant is now called springs.stiffness": (lambda: SPRINGS("constant"), 5),
}


@pytest.mark.parametrize("says", USES)
def test_a_former_name_works_and_warns_at_its_use(says):
    use, value = USES[says]
    with pytest.warns(DeprecationWarning, match=says) as warned:
        assert use() == value
    assert [warning.filename for warning in warned] == [__file__]


def test_a_name_that_never_was_is_no_attribute():
    with pytest.raises(AttributeError, match="has no attribute 'fase'"):
        SPRINGS("fase")


def test_an_argument_by_both_names_is_an_error():
    with pytest.raises(TypeError, match="both are given"):
        force(phase=1, mode=2)


def test_no_former_name_no_warning(recwarn):
    assert force(mode=3) == Declaration(functions=6).functions == 6
    assert not recwarn
