"""Columns under a beam: the published equation and ratio (Makris and Vassiliou 2013)."""

import numpy as np
import pytest
import sympy as sp

import rockeom as rk
from rockeom.symbolic.algebra import at_side, tidy
from rockeom.symbolic.model import GROUND_X, GROUND_Y

MODEL = rk.derive("rocking_frame")
OF = {p.name: p.symbol for p in MODEL.parameters}
RADIUS, ALPHA = sp.symbols("R alpha", positive=True)
POLAR = {OF["half_width"]: RADIUS * sp.sin(ALPHA), OF["half_height"]: RADIUS * sp.cos(ALPHA)}
GAMMA = OF["beam_mass"] / (OF["columns"] * OF["column_mass"])
THETA = MODEL.rotation


def frame(**changes):
    values = {
        "columns": 4,
        "column_mass": 12e3,
        "half_width": 0.6,
        "half_height": 3.0,
        "beam_mass": 90e3,
    }
    return rk.RockingFrame(**(values | changes))


def is_zero(expr):
    return tidy(sp.expand_trig(sp.numer(sp.together(expr)))) == 0


@pytest.mark.parametrize("side", [-1, 1])
def test_equation_of_motion_is_the_published_one(side):
    """The vertical acceleration of the ground multiplies the sine alone."""
    eq = MODEL.equations("right" if side > 0 else "left")
    (acceleration,) = eq.mass_matrix.LUsolve(eq.forcing)
    g, theta = OF["gravity"], THETA.position
    p_squared = 3 * g / (4 * RADIUS)
    angle = ALPHA * side - theta
    published = (
        -(1 + 2 * GAMMA)
        / (1 + 3 * GAMMA)
        * p_squared
        * ((1 + GROUND_Y / g) * sp.sin(angle) + GROUND_X / g * sp.cos(angle))
    )
    assert is_zero(acceleration.subs(POLAR) - published)


def test_ratio_of_the_rates_at_an_impact_is_the_published_one():
    published = (1 - sp.Rational(3, 2) * sp.sin(ALPHA) ** 2 + 3 * GAMMA * sp.cos(2 * ALPHA)) / (
        1 + 3 * GAMMA
    )
    assert is_zero(MODEL.velocity_ratio.subs(POLAR) - published)
    law = MODEL.impulse_map("right", "left")
    (after,) = law.velocities()
    assert is_zero((at_side(after, 1) / THETA.velocity).subs(POLAR) - published)


def test_beam_stays_where_it_is_when_the_columns_change_their_feet():
    """On the upper corners opposite the pressed feet, which differ: its path has no jump."""
    right, left = (MODEL.mode(c).bodies[0] for c in ("right", "left"))
    places = [at_side(sp.Matrix(b.position), s) for b, s in ((right, 1), (left, -1))]
    assert places[0].subs(THETA.position, 0) == places[1].subs(THETA.position, 0)


@pytest.mark.parametrize("columns", [2, 5])
def test_without_a_beam_it_is_a_block(columns):
    """And the number of columns changes nothing but the forces."""
    bare = frame(columns=columns, beam_mass=0.0)
    block = rk.RigidBlock(half_width=0.6, half_height=3.0, mass=12e3)
    state = {"theta": 0.05, "theta_dot": -0.3}
    assert bare.accelerations(state, 1.0, 0.5) == pytest.approx(
        block.accelerations(state, 1.0, 0.5)
    )
    assert bare.velocity_ratio == pytest.approx(block.velocity_ratio, rel=1e-14)
    one, all_ = (s.reactions(state, 1.0, 0.5) for s in (block, bare))
    assert all_ == pytest.approx({name: columns * force for name, force in one.items()})


def test_what_the_beam_weighs_does_not_change_when_the_frame_lifts():
    """At g tan(alpha), as its columns by themselves."""
    for mass in (0.0, 1e3, 1e6):
        assert frame(beam_mass=mass).uplift_acceleration == pytest.approx(9.81 * 0.6 / 3.0)


def test_a_heavier_beam_makes_it_the_steadier():
    """What the paper is known for: the top-heavier frame turns less under the same pulse."""
    pulse = rk.GroundMotion.single_sine(amplitude=3.0, period=0.9, duration=4.0)
    peaks = [
        np.abs(rk.simulate(frame(beam_mass=mass), pulse)["theta"]).max() for mass in (1e3, 4e5)
    ]
    assert 0.005 < peaks[1] < peaks[0] < 0.2


@pytest.mark.parametrize("columns", [2.5, 0, -1, np.nan, np.inf])
def test_half_a_column_is_none(columns):
    with pytest.raises(ValueError, match="columns is"):
        frame(columns=columns)
