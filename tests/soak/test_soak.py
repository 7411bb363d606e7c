"""The short form of the soak, and that its checks can fail."""

import warnings
from dataclasses import replace
from functools import cache

import numpy as np
import pytest

import rockeom as rk
from rockeom.simulation.response import Outcome
from tests.soak.cases import MODELS, draw, method_of, model_of
from tests.soak.checks import IMPACT, Record, on_record
from tests.soak.declared import pushed
from tests.soak.faults import FAULTS, ROOT
from tests.soak.run import Checks, checked, soaked

SHORT = [seed for seed in range(28 * len(MODELS)) if method_of(seed) == "DOP853"][:250]
"""Seeds of the method whose programs other tests compile, too."""


def test_some_hundred_seeds(tmp_path):
    """In a process of their own, so that one that hangs is named and ended."""
    with (tmp_path / "progress").open("w") as progress:
        summary = soaked(SHORT, 1, Checks(drawn=("mirror", "cut", "equal")), stream=progress)
    assert summary.total == len(SHORT)
    assert not summary.violations, "\n".join(map(str, summary.violations))


ONCE_WRONG = {
    708146: ("none", "a tendon without tension hovers about none, near upright"),
    529069: ("none", "the same with a method of low order"),
    919041: ("none", "a turning point is landed on a little late"),
    712773: ("none", "both feet lift at once, and their guards begin below zero by rounding"),
    801195: ("none", "shaking begins from nothing, and so does the opening of a guard"),
    801316: ("none", "a guard opens for a thousandth of a long step"),
    577728: ("equal", "an equal step is refused at a coarse tolerance"),
    5142: ("equal", "a structure lies on the ground and is pulled back within a step"),
    501127: ("mirror", "a wall with an eccentric tendon starts upright, without shaking"),
    503758: ("mirror", "a bent wall starts upright"),
    532929: ("mirror", "both feet are in the air, and one is held by its damper"),
    813609: ("mirror", "full contact with a slack tendon"),
    1063885: ("none", "a wall that yields turns where it has just begun to"),
    1057755: ("none", "an impact ends in full contact, out of which the other foot lifts at once"),
    1068297: ("none", "a tendon slackens just before an impact, a small part of a step"),
    1165890: ("none", "it comes back beside that impact, and its guard is closed at first"),
    1286501: ("equal", "a foot lifts so slowly that the first step would be of any length"),
    1394789: ("none", "a tendon tightens where another event has just been, at zero by rounding"),
    1373537: ("none", "the same, and only for a hundredth of the step"),
    1340093: ("none", "a tendon hovers beside zero between impacts"),
    1367347: ("none", "a tendon slackens just before an impact, and the step to it is too long"),
    1502207: ("none", "a gap opens, and a dense output of low order has it close at first"),
    1264039: ("none", "a decay of which the fifth-order estimate knows nothing"),
    1256216: ("none", "a foot lands, and the tendon tightens at the same moment"),
    1040351: ("cut", "small errors of steps grow at impacts whose loss depends on their speed"),
    1501368: ("lanes", "chaotic: a change of 1e-9 decides whether a count of impacts is reached"),
    1670785: ("none", "a turning point is landed on with a remainder of time that settle asks for"),
    1656788: (
        "cut",
        "a motion is cut so near to an impact that a twin is below the ground",
    ),
    1700595: ("lanes", "chaotic: a millionth decides whether it falls"),
    1503033: ("lanes", "what steps err by grows through 700 impacts, with and without lanes"),
    294: (
        "tangents",
        "a foot lifts at the start, and the law has no ratio: nothing had a derivative",
    ),
    279: ("tangents", "an element switches where the force goes on, and a table tells the ratio"),
    1009897: ("none", "a rest of more than a thousand impacts gives too little to the column"),
}
"""Seeds that found something: the check that is made besides those of every response, and what."""


@pytest.mark.parametrize("seed", ONCE_WRONG)
def test_seed_that_once_found_something_is_right(seed):
    check, _ = ONCE_WRONG[seed]
    result = checked(seed, Checks(drawn=()) if check == "none" else Checks(always=check))
    assert not result.violations, result


def test_mode_of_the_other_side_is_refused():
    """A wall that yields leaning right, named for one that leans left."""
    assert checked(540999, Checks(drawn=())).outcome.startswith("refused: the mode 'right_yield'")


def test_a_seed_always_gives_the_same_motion():
    for seed in range(30):
        assert str(draw(seed)) == str(draw(seed))
        assert model_of(seed) == draw(seed).structure.model
        assert draw(seed).options == draw(seed, sibling=1).options


# -- each check notices what it is for: a response that is right, and the same tampered with


def a_record(model: str, wanted) -> Record:
    """The first seed of a model whose response is as wanted."""
    for seed in range(MODELS.index(model), 4000, len(MODELS)):
        if method_of(seed) != "DOP853":
            continue
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            motion = replace(draw(seed), mode=None)
            motion = replace(motion, options=rk.SolverOptions())
            try:
                run = motion.run()
            except ValueError:
                continue
        record = Record(motion, run)
        if wanted(record) and not list(on_record(record)):
            return record
    raise LookupError(f"no seed of {model}")


def bounced(record: Record) -> bool:
    return (record.kinds == IMPACT).sum() > 3 and record.run.outcome is Outcome.COMPLETED


@cache
def block() -> Record:
    return a_record("rigid_block", bounced)


def words(record: Record) -> set[str]:
    return {found.split(":")[0].split()[0] for found in on_record(record)}


def test_nan_with_an_outcome_of_success_is_noticed():
    powers = block().run.steps.powers.copy()
    powers[-1, 1, 0] = np.nan
    assert "not" in words(block().altered(powers=powers))
    assert "not" in words(block().altered(end=np.array([np.nan, 0.0]), outcome=Outcome.OVERTURNED))


def test_gap_in_time_is_noticed():
    span = block().run.steps.span.copy()
    span[5:, 0] += 1e-9
    assert "time" in words(block().altered(span=span))


def test_fall_through_the_ground_is_noticed():
    """An impact left out: the motion goes on on the same side."""
    modes = block().mode.copy()
    modes[modes == 0] = 2
    assert "guard" in words(block().altered(mode=modes))


def test_event_left_out_is_noticed():
    times, kinds, states = block().run.events.columns
    keep = np.arange(len(times)) != 1
    found = words(block().altered(times=times[keep], kinds=kinds[keep], states=states[keep]))
    assert {"joined", "modes"} <= found


def test_energy_from_nothing_is_noticed():
    """One step in which the motion changes by a hundred-thousandth more."""
    powers = block().run.steps.powers.copy()
    moving = int(np.abs(powers[:, 1:, 1].sum(axis=1) * powers[:, 0, 1]).argmax())
    powers[moving, 1:] *= 1 + 1e-5
    assert "energy" in words(block().altered(powers=powers))


def test_impact_that_gives_energy_or_is_not_at_the_ground_is_noticed():
    for what, factor, shift in (("gives", 1.5, 0.0), ("aloft", 1.0, 1e-3)):
        states = block().run.events.columns[2].copy()
        impact = int(np.flatnonzero(block().kinds == IMPACT)[0])
        states[impact, 1, 1] = factor * states[impact, 0, 1]
        states[impact, 0, 0] += shift
        assert "impact" in words(block().altered(states=states)), what


def test_success_short_of_the_end_is_noticed():
    assert "end" in words(block().altered(duration=1.1 * block().run.duration))


def test_state_that_is_not_overturned_is_noticed():
    span = block().run.steps.span[:5]
    early = block().altered(
        span=span, mode=block().mode[:5], powers=block().run.steps.powers[:5],
        times=np.empty(0), kinds=np.empty((0, 4), int), states=np.empty((0, 2, 2)),
        end=block().last[4], outcome=Outcome.OVERTURNED,
    )  # fmt: skip
    assert "end" in words(early)


@pytest.mark.parametrize("fault", FAULTS.values(), ids=FAULTS)
def test_fault_to_plant_still_fits_the_code(fault):
    assert fault.text() != (ROOT / fault.file).read_text(encoding="utf-8")


def test_load_of_a_pushover_that_is_wrong_is_noticed(monkeypatch):
    structure = draw(5).structure
    monkeypatch.setattr(type(structure), "pushover", lambda self, r: np.full(len(r), 1.0))
    assert list(pushed(5, structure))


# -- planted: the mode of a start


def test_contact_that_falls_back_to_the_first_is_noticed(monkeypatch):
    """Whatever the state: the first mode, "left"."""
    wall = rk.ControlledWall.thesis()
    motion = replace(
        draw(MODELS.index("controlled_wall")), structure=wall, motion=rk.GroundMotion.none(0.5),
        vertical=None, impact=None, initial={"theta": 0.05, "theta_dot": -0.1}, mode=None,
        options=rk.SolverOptions(),
    )  # fmt: skip
    monkeypatch.setattr(type(wall), "mode_number", lambda self, y, mode=None, towards=0.0: 0)
    assert {"impact", "event"} & words(Record(motion, motion.run()))
