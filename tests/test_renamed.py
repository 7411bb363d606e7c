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


@dataclass(frozen=True)
class Paper:
    width: int = 1
    height: int = 1


@renamed.needless(colour="leave it out, it is black")
@renamed.moved("paper", Paper, "width", "height")
def printed(*, paper=None):
    return paper


def test_arguments_that_became_fields_of_one():
    with pytest.warns(DeprecationWarning, match="is now called paper=") as warned:
        assert printed(height=3, width=2) == Paper(2, 3)
    assert [str(warning.message) for warning in warned] == [
        "printed: width is now called paper=rk.Paper(width=...)",
        "printed: height is now called paper=rk.Paper(height=...)",
    ]
    assert {warning.filename for warning in warned} == {__file__}
    with pytest.raises(TypeError, match="width belongs into paper, which is given too"):
        printed(width=2, paper=Paper())


def test_an_argument_without_effect_says_what_to_do():
    with pytest.warns(DeprecationWarning, match="colour has no effect: leave it out") as warned:
        assert printed(colour="red", paper=Paper(5)) == Paper(5)
    assert [warning.filename for warning in warned] == [__file__]
