"""A superstructure of a user's own on supports: what docs/how-to/your-own-structure.md shows."""

from functools import cache

import numpy as np
import pytest

import rockeom as rk
from rockeom.symbolic.parts.supports import pinned, two_springs
from tests.pages import GUIDE, blocks, names_of


@cache
def page():
    """What the page has made."""
    (shown,) = (block for block in blocks("python", GUIDE) if "Superstructure(" in block)
    return names_of(["import rockeom as rk", shown])


def test_tank_on_feet_that_slide_slides_with_its_water():
    """The base slides where the ground passes mu g; the water swings on, at its own period."""
    pulse = rk.GroundMotion.single_sine(amplitude=6.0, period=0.8, duration=8.0)
    run = rk.simulate(page()["structure"], pulse)
    assert np.ptp(run["x"]) > 0.01
    assert {e.kind for e in run.events} >= {"slip begins", "slip ends"}
    late = np.linspace(3.0, 8.0, 5001)
    water = run.at(late)["w"]
    rises = late[1:][(water[:-1] < 0) & (water[1:] >= 0)]
    period = 2 * np.pi / np.sqrt(2e4 / 4e3)
    assert np.diff(rises).mean() == pytest.approx(period, rel=2e-3)


def test_tank_on_pinned_feet_and_on_springs():
    """The same declaration; the water's period with both feet down, and settled."""
    values = dict(page()["structure"].parameters())
    for gone in ("friction", "restitution"):
        del values[gone]
    held = rk.structure(pinned(page()["sloshing"]), **values).fixed_base()
    assert held.periods == pytest.approx([2 * np.pi / np.sqrt(2e4 / 4e3)], rel=1e-10)
    foundation = {"foundation_stiffness": 1e7, "foundation_damping": 1e5}
    springs = rk.structure(two_springs(page()["sloshing"]), **values, **foundation)
    forces = springs.reactions({})
    assert forces["left_reaction"] == pytest.approx(12e3 * 9.81 / 2, rel=1e-12)
