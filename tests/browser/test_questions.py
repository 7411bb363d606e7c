"""What a page draws besides a motion: energies over time, overturning angles and the separatrix.

In machine code, which has the bits of the page.
"""

from typing import NamedTuple

import numpy as np
import pytest

import rockeom as rk
from rockeom.structures.classes import SHIPPED
from tests.shipped import plain
from tests.typical import column

from .browsers import native

SAMPLES = 4801
BLOCK = rk.RigidBlock(half_width=0.15, half_height=0.6)
PULSE = rk.GroundMotion.half_sine(4.0, 0.8, duration=5.0)
LIFT = rk.GroundMotion.half_sine(2.0, 0.5, duration=5.0)
COLUMN = column(stiffness=40e3)
OFFSET = rk.OffsetBlock(half_width=0.2, half_height=0.6, offset=0.05)
SLIDER = {"gravity": (9.0, 10.0, 9.81)}


class Shown(NamedTuple):
    """A motion as a page has it: energies (5, n) of the n samples, and what `balance` gives."""

    t: np.ndarray
    energies: np.ndarray
    angles: np.ndarray
    separatrix: np.ndarray


def shown(case: rk.Case) -> Shown:
    page = rk.explorer(case, SLIDER)
    motion = native(page, SAMPLES)(page.setup.controls.start)
    found, angles, separatrix = np.zeros((5, SAMPLES)), np.zeros(2), np.zeros((2, 64))
    history = (motion[name] for name in ("states", "modes", "p", "ground", "spacing"))
    motion["program"].energy_history(*history, found)
    motion["program"].balance(motion["p"], motion["numbers"], angles, separatrix)
    between, n, _ = motion["spacing"]
    return Shown(between * np.arange(n), found[:, : round(n)], angles, separatrix)


@pytest.fixture(scope="module")
def block() -> Shown:
    return shown(rk.Case(BLOCK, PULSE))


def run_of(case: rk.Case) -> rk.Response:
    return rk.simulate(case.structure, case.motion, initial=case.initial, vertical=case.vertical)


@pytest.mark.parametrize(
    "case",
    [rk.Case(BLOCK, PULSE, vertical=LIFT), rk.Case(COLUMN, PULSE)],
    ids=["block under both ground motions", "column with a damper"],
)
def test_energies_over_time_are_those_of_a_run(case):
    found, run = shown(case), run_of(case)
    names = [*run.structure.module.ENERGIES, "ground_work", "impact_loss", "damping_loss"]
    wanted = run.at(found.t, names=names)
    largest = found.energies.max()
    for row, name in zip(found.energies, run.structure.module.ENERGIES, strict=False):
        assert row == pytest.approx(wanted[name] - wanted[name][0], abs=1e-6 * largest)
    lost = wanted["impact_loss"] + wanted["damping_loss"]
    assert found.energies[3] == pytest.approx(wanted["ground_work"], abs=2e-3 * largest)
    assert found.energies[4] == pytest.approx(lost, abs=2e-3 * largest)


def test_free_rocking_loses_energy_at_impacts_alone():
    case = rk.Case(BLOCK, rk.GroundMotion.none(3.0), initial={"theta": 0.15})
    found, run = shown(case), run_of(case)
    lost = found.energies[4]
    assert np.abs(found.energies[3]).max() == 0.0
    between = np.diff(np.searchsorted(run.impacts.times, found.t)) == 0
    assert np.abs(np.diff(lost)[between]).max() < 1e-7 * lost[-1]
    assert np.diff(lost)[~between].min() > 0.0
    assert lost[-1] == pytest.approx(run.energy_balance().impacts, rel=1e-6)


@pytest.mark.parametrize("structure", [BLOCK, COLUMN, OFFSET], ids=lambda one: type(one).__name__)
def test_overturning_angles_are_those_of_a_structure(structure):
    found = shown(rk.Case(structure, PULSE))
    assert found.angles == pytest.approx(structure.overturning_angles, rel=1e-9)
    assert found.separatrix.any() == (len(structure.states) == 2)


@pytest.mark.parametrize(
    ("name", "why"),
    [
        ("controlled_wall", "elements change the modes of a side"),
        ("two_spring_structure", "it stands on springs"),
    ],
)
def test_no_angle_is_told_where_a_side_has_no_mode_of_its_own(name, why):
    case = rk.Case(SHIPPED[name](**plain(name)), PULSE, initial={"theta": 0.01})
    assert not shown(case).angles.any(), why


@pytest.mark.parametrize("place", [12, 20, 27, 36, 43, 51])
def test_a_motion_inside_the_separatrix_comes_back_and_one_outside_overturns(block, place):
    rotation, rate = block.separatrix[:, place]
    assert abs(rotation) < BLOCK.alpha
    still, outwards = rk.GroundMotion.none(6.0), np.copysign(rate, rotation)
    for part, falls in ((0.999, False), (1.001, True)):
        run = rk.simulate(BLOCK, still, initial={"theta": rotation, "theta_dot": part * outwards})
        assert (str(run.outcome) == "overturned") is falls
