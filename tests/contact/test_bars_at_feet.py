"""Bars at the foot on which a wall stands: nothing stretches them, so they neither pull nor switch.

Their elongation and its rate vanish but for rounding while the foot stands; a guard made of that
rounding would fall and rise at every step.
"""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest
import sympy as sp

import rockeom as rk
from rockeom.symbolic import Tie, Unilateral, Yielding
from tests.contact.declared import placed
from tests.contact.test_yielding import STRENGTH, WALL, B, K, wall_with_bars

KINDS = {
    "yielding": lambda name, up: Yielding(name, up, K.symbol, STRENGTH.symbol),
    "slack": lambda name, up: Tie(name, up, K.symbol, STRENGTH.symbol),
    "unilateral": lambda name, up: Unilateral(name, up, K.symbol),
    "damped": lambda name, up: Unilateral(name, up, K.symbol, K.symbol / 1000),
}


@cache
def wall(kind: str, *places: int):
    """A wall that bars hold down, at its middle, 0, and at its right foot, 1."""
    of, theirs = wall_with_bars(), WALL
    bars = tuple(
        KINDS[kind](("middle", "foot")[at], placed((at * B.symbol, sp.S.Zero))[1]) for at in places
    )
    parameters = of.parameters
    if kind in ("unilateral", "damped"):
        parameters = tuple(p for p in parameters if p.name != "strength")
        theirs = {name: value for name, value in WALL.items() if name != "strength"}
    name = f"wall_{kind}_{len(places)}"
    return rk.structure(replace(of, name=name, parameters=parameters, elements=bars), **theirs)


@pytest.mark.parametrize("rate", [0.0, 0.2])
@pytest.mark.parametrize("kind", KINDS)
def test_a_bar_at_the_foot_that_stands_changes_nothing_until_the_wall_lands(kind, rate):
    """It starts drawn out, let go or pushed outward, on the foot with the bar."""
    motion, initial = rk.GroundMotion.none(0.6), {"theta": 0.02, "theta_dot": rate}
    both, alone = (rk.simulate(wall(kind, *at), motion, initial=initial) for at in ((0, 1), (0,)))
    landing = next(e.time for e in alone.events if e.kind == "landing")
    before = landing * (1.0 - 1e-9)
    assert [e for e in both.events if e.contact == "foot" and e.time < before] == []
    times = [[e.time for e in run.events if e.time < before] for run in (both, alone)]
    assert times[0] == pytest.approx(times[1], rel=1e-9)
    stands = both.t < before
    force = "foot_force" if kind in ("yielding", "slack") else "foot_reaction"
    assert both[force][stands] == pytest.approx(0.0, abs=1e-6)
    assert both["theta"][stands][-1] == pytest.approx(alone.at(both.t[stands][-1])["theta"])


def test_a_bar_at_a_foot_that_lifts_out_of_rest_does_not_switch_without_end():
    """It neither pulls nor yields there, but for rounding: 867 events within 1e-11 s followed."""
    given = {"strength": 512478.3586913015, "stiffness": 1440894750.627202}
    given["initial_force"] = 72507.06579278441
    wall = rk.structure(wall_with_bars(), **WALL | given)
    start = {"theta": 0.15372978565071976, "theta_dot": 0.026721453770352843}
    start["y"] = 0.4099825626160293
    run = rk.simulate(wall, rk.GroundMotion.none(0.7), initial=start)
    times = run.events.times
    assert (np.searchsorted(times, times + 1e-11) - np.arange(len(times))).max() < 50
    assert run.energy_balance().error < 1e-9


@pytest.mark.parametrize("kind", KINDS)
def test_bars_at_a_foot_switch_as_often_as_the_wall_swings(kind):
    """On both feet in turn, until the wall has come to rest."""
    options = rk.SolverOptions(max_steps=5_000)
    run = rk.simulate(
        wall(kind, 0, 1), rk.GroundMotion.none(0.6), initial={"theta": -0.02}, options=options
    )
    assert run.outcome in (rk.Outcome.COMPLETED, rk.Outcome.CAME_TO_REST)
    assert rk.analysis.energy_balance(run).error < 1e-7
