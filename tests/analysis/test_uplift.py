"""Uplift and the vibration after it, beside the engine's structures."""

from functools import partial

import numpy as np
import pytest

import rockeom as rk
from rockeom.analysis import formulas
from tests import typical


@pytest.mark.parametrize(("factor", "lifts"), [(0.999, False), (1.001, True)])
def test_block_lifts_above_the_static_criterion_and_not_below(factor, lifts):
    acceleration = factor * formulas.uplift_acceleration(0.1, 0.4)
    block = rk.RigidBlock(half_width=0.1, half_height=0.4)
    run = rk.simulate(block, rk.GroundMotion.constant(acceleration, 0.2))
    assert (np.abs(run["theta"]).max() > 0) is np.bool_(lifts)


NOTHING = dict.fromkeys(("inertia", "base_mass", "base_height", "base_inertia"), 0.0)
column = partial(typical.column, **NOTHING)
"""A mass without inertia on an elastic column whose base has no mass."""


FREQUENCY = np.sqrt(571.8e3 / 122.6)


def test_deformation_that_lifts_a_foot():
    """On a stiff column: the engine's weight acts on the deformed one, by m g/(k H) less."""
    structure = column(stiffness=1e13)
    deformation = structure.pushover(0.0) / structure.stiffness
    assert formulas.uplift_displacement(np.sqrt(1e13 / 122.6), 0.285, 1.05) == pytest.approx(
        deformation, rel=1e-9
    )


@pytest.mark.parametrize("side", [-1, 1])
def test_uplifted_column_vibrates_faster(side):
    """Without gravity the engine's column is linear for small deformations: u'' = -k u - c u'."""
    structure = column(gravity=1e-20)
    state = {"theta": side * 1e-12, "u": 0.0, "theta_dot": 0.0, "u_dot": 0.0}

    def acceleration(**changes):
        return structure.accelerations(state | changes)["u"]

    stiffness, damping = -acceleration(u=1e-9) / 1e-9, -acceleration(u_dot=1e-9) / 1e-9
    frequency = formulas.uplifted_frequency(FREQUENCY, 0.285, 1.05)
    assert frequency == pytest.approx(np.sqrt(stiffness), rel=1e-7)
    ratio = 502.4 / (2 * np.sqrt(122.6 * 571.8e3))
    assert formulas.uplifted_damping(ratio, 0.285, 1.05) == pytest.approx(
        damping / (2 * frequency), rel=1e-7
    )


def test_example_of_chapter_2_takes_b_for_the_half_width():
    """H/B = 10 and a damping of 0.05 become "close to 0.5"."""
    assert formulas.uplifted_damping(0.05, 1.0, 10.0) == pytest.approx(0.5025, abs=1e-4)


def test_slenderness_counts_and_size_does_not():
    sizes = np.array([0.1, 1.0, 10.0])
    ratios = formulas.uplifted_damping(0.05, 0.3 * sizes, sizes)
    np.testing.assert_allclose(ratios, ratios[0], rtol=1e-14)


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: formulas.uplift_acceleration(0.1, 0.0), "half_height is 0: give"),
        (lambda: formulas.uplifted_damping(-0.1, 1.0, 2.0), r"damping_ratio is -0\.1: give"),
        (lambda: formulas.uplifted_frequency(9.0, -1.0, 2.0), "half_width is -1"),
        (
            lambda: formulas.uplift_acceleration([0.1, 0.2], [0.3, 0.4, 0.5]),
            r"half_width \(2,\), half_height \(3,\).* do not broadcast",
        ),
    ],
)
def test_impossible_input_is_refused(call, message):
    with pytest.raises(ValueError, match=message):
        call()
