"""Names that things had before work, and say what they are called now."""

import dataclasses

import pytest

import rockeom as rk
from rockeom import symbolic

MODEL = rk.derive("rigid_block")
HEAVIER = tuple(dataclasses.replace(m, gravity=2 * m.gravity) for m in MODEL.mechanisms)
OTHERS = {f.name: getattr(MODEL, f.name) for f in dataclasses.fields(MODEL)}
del OTHERS["mechanisms"]
READ = {
    "Phase is now called Mechanism": (lambda: rk.Phase, lambda: rk.Mechanism),
    "Phase is now": (lambda: symbolic.Phase, lambda: symbolic.Mechanism),
    "Law is now called NamedFunction": (lambda: symbolic.Law, lambda: symbolic.NamedFunction),
    "phases is now called mechanisms": (lambda: MODEL.phases, lambda: MODEL.mechanisms),
    "phase is now called mechanism": (
        lambda: MODEL.phase("right"), lambda: MODEL.mechanism("right"),
    ),
    "laws is now called functions": (lambda: MODEL.laws, lambda: MODEL.functions),
    "phases is now": (
        lambda: rk.RockingModel(**OTHERS, phases=HEAVIER).mechanisms, lambda: HEAVIER,
    ),
}  # fmt: skip


@pytest.mark.parametrize("says", READ)
def test_an_old_name_gives_what_the_new_one_does_and_says_so_to_who_wrote_it(says):
    old, new = READ[says]
    with pytest.warns(DeprecationWarning, match=says) as told:
        found = old()
    assert found == new()
    assert [one.filename for one in told] == [__file__]


def test_nothing_is_found_by_a_name_that_never_was():
    for of in (rk, symbolic):
        with pytest.raises(AttributeError, match="Fase"):
            _ = of.Fase
