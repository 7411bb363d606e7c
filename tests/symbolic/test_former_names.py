"""Former names work, and give the names of today."""

import dataclasses

import pytest

import rockeom as rk
from rockeom import symbolic

MODEL = rk.derive("rigid_block")
HEAVIER = tuple(dataclasses.replace(m, gravity=2 * m.gravity) for m in MODEL.modes)
OTHERS = {f.name: getattr(MODEL, f.name) for f in dataclasses.fields(MODEL)}
del OTHERS["modes"]
ROCKING = MODEL.mode("right")
OF_MODE = {f.name: getattr(ROCKING, f.name) for f in dataclasses.fields(ROCKING)}
del OF_MODE["sides"]
READ = {
    "Mechanism is now called rockeom.symbolic.Mode": (lambda: rk.Mechanism, lambda: rk.Mode),
    "symbolic.Mechanism is now": (lambda: symbolic.Mechanism, lambda: symbolic.Mode),
    "mechanisms is now called modes": (lambda: MODEL.mechanisms, lambda: MODEL.modes),
    "mechanism is now called mode": (lambda: MODEL.mechanism("right"), lambda: ROCKING),
    "RockingModel: mechanisms is now": (
        lambda: rk.RockingModel(**OTHERS, mechanisms=HEAVIER).modes, lambda: HEAVIER,
    ),
    "RockingModel.contacts is now": (lambda: MODEL.contacts, lambda: MODEL.mode_names),
    "Mode.contacts is now called sides": (lambda: ROCKING.contacts, lambda: ROCKING.sides),
    "Mode: contacts is now called sides": (
        lambda: rk.Mode(**OF_MODE, contacts=ROCKING.sides), lambda: ROCKING,
    ),
}  # fmt: skip


@pytest.mark.parametrize("says", READ)
def test_a_former_name_gives_what_that_of_today_gives_and_warns_at_its_use(says):
    former, today = READ[says]
    with pytest.warns(DeprecationWarning, match=says) as warned:
        found = former()
    assert found == today()
    assert [one.filename for one in warned] == [__file__]


def test_nothing_is_found_by_a_name_that_never_was():
    for of in (rk, symbolic):
        with pytest.raises(AttributeError, match="Fase"):
            _ = of.Fase
