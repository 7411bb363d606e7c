"""Ratios of kinetic energies: those that the engine derives, and those that its motions show."""

import itertools
import math

import numpy as np
import pytest

import rockeom as rk
from rockeom.analysis import formulas
from tests.typical import S1 as COLUMN


def peaks_of(run, count):
    """Rotations half-way between the impacts: the peaks, by symmetry in time."""
    times = [impact.time for impact in run.impacts[: count + 1]]
    return run.at([(a + b) / 2 for a, b in itertools.pairwise(times)])["theta"]


@pytest.mark.parametrize("half_width", [0.05, 0.1, 0.3, 0.5])
def test_block_against_the_derived_impact(half_width):
    rectangle = rk.RigidBlock(half_width=half_width, half_height=0.45, mass=334.0)
    assert formulas.energy_ratio_of_block(rectangle.alpha) == pytest.approx(
        rectangle.velocity_ratio**2, rel=1e-13
    )
    heavy_rim = rk.RigidBlock(half_width=half_width, half_height=0.45, mass=334.0, inertia=60.0)
    r = formulas.energy_ratio_of_block(
        heavy_rim.alpha, inertia=60.0, mass=334.0, radius=heavy_rim.radius
    )
    assert r == pytest.approx(heavy_rim.velocity_ratio**2, rel=1e-13)
    assert r != pytest.approx(rectangle.velocity_ratio**2, rel=1e-3)


def test_lumped_masses_against_the_derived_impact():
    for width in (0.1, 0.285, 0.6):
        values = COLUMN | {"half_width": width}
        assert formulas.energy_ratio_of_lumped_mass(**values) == pytest.approx(
            rk.LumpedMassStructure(**values).velocity_ratio ** 2, rel=1e-13
        )
    widths = np.array([0.1, 0.285])
    ratios = formulas.energy_ratio_of_lumped_mass(**(COLUMN | {"half_width": widths}))
    assert ratios.shape == (2,)
    assert ratios[1] == formulas.energy_ratio_of_lumped_mass(**COLUMN)


def test_lumped_mass_without_a_base_is_a_block():
    single = COLUMN | {"base_mass": 0.0, "base_height": 0.0, "base_inertia": 0.0}
    alpha = math.atan2(0.285, 1.05)
    block = formulas.energy_ratio_of_block(
        alpha, inertia=44.8, mass=122.6, radius=math.hypot(0.285, 1.05)
    )
    assert formulas.energy_ratio_of_lumped_mass(**single) == pytest.approx(block, rel=1e-13)


def test_peaks_of_a_rocking_block_tell_its_restitution():
    block = rk.RigidBlock(half_width=0.095, half_height=0.4549, mass=334.44)
    run = rk.simulate(
        block, rk.GroundMotion.none(4.0), impact=rk.EnergyRatio(0.8), initial={"theta": 0.12}
    )
    peaks = peaks_of(run, 5)
    assert len(set(np.sign(peaks))) == 2
    ratios = formulas.energy_ratios_from_peaks(peaks, block.alpha)
    np.testing.assert_allclose(ratios, 0.8, rtol=1e-7)


def test_peaks_of_a_rocking_column_tell_its_restitution():
    run = rk.simulate(
        rk.LumpedMassStructure(**COLUMN),
        rk.GroundMotion.none(4.0),
        impact=rk.EnergyRatio(0.74),
        initial={"theta": 0.1},
    )
    geometry = {k: v for k, v in COLUMN.items() if "inertia" not in k}
    ratios = formulas.energy_ratios_from_peaks_of_lumped_mass(peaks_of(run, 5), **geometry)
    np.testing.assert_allclose(ratios, 0.74, rtol=1e-7)


@pytest.mark.parametrize("theta", [-0.15, 1e-9, 0.1])
def test_energy_of_a_tilted_block_is_that_of_the_engine(theta):
    block = rk.RigidBlock(half_width=0.095, half_height=0.4549, mass=334.44)
    energy = formulas.gravitational_energy(
        theta, mass=block.mass, radius=block.radius, alpha=block.alpha
    )
    upright, tilted = (block.energies({"theta": x}, None) for x in (0.0, theta))
    gain = tilted["gravitational_energy"] - upright["gravitational_energy"]
    assert energy == pytest.approx(gain, rel=1e-11, abs=1e-11)
    # to first order the weight is lifted by B theta, at any size
    assert energy <= block.mass * 9.81 * block.half_width * abs(theta)


def test_rotational_spring_takes_part_in_the_energy():
    """Without a spring 3-3; with one far stiffer than gravity the ratio of squares, 3-4."""
    block = {"mass": 334.44, "radius": 0.4647}
    peaks = np.array([0.13, -0.11, 0.09])
    soft = formulas.energy_ratios_from_peaks(peaks, 0.2)
    for stiffness, expected, accuracy in (
        (1e-6, soft, 1e-6),
        (1e9, (peaks[1:] / peaks[:-1]) ** 2, 1e-5),
    ):
        ratios = formulas.energy_ratios_from_peaks(
            peaks, 0.2, rotational_stiffness=stiffness, **block
        )
        np.testing.assert_allclose(ratios, expected, rtol=accuracy)
    # the work of the moment 500 N m/rad times theta
    angles = np.linspace(0, 0.1, 3)
    assert formulas.spring_energy(-0.1, 500.0) == pytest.approx(
        sum(500 * (angles[1:] + angles[:-1]) / 2 * np.diff(angles))
    )
    energies = formulas.gravitational_energy(peaks, alpha=0.2, **block) + formulas.spring_energy(
        peaks, 500.0
    )
    ratios = formulas.energy_ratios_from_peaks(peaks, 0.2, rotational_stiffness=500.0, **block)
    np.testing.assert_allclose(np.cumprod(ratios), energies[1:] / energies[0], rtol=1e-14)


def test_energy_and_velocity_ratios_are_not_confused():
    assert formulas.velocity_ratio_from_energy_ratio(0.81) == pytest.approx(0.9, rel=1e-15)
    assert formulas.energy_ratio_from_velocity_ratio(0.9) == pytest.approx(0.81, rel=1e-15)
    _, ratio = rk.EnergyRatio(0.81).resolve(math.nan, False, "")
    assert formulas.velocity_ratio_from_energy_ratio(0.81) == ratio


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: formulas.velocity_ratio_from_energy_ratio(1.1), "energy_ratio is 1.1"),
        (lambda: formulas.energy_ratio_from_velocity_ratio(-0.1), "velocity_ratio is -0.1"),
        (lambda: formulas.energy_ratio_of_block(1.2), "alpha is 1.2: so squat"),
        (lambda: formulas.energy_ratio_of_block(0.2, mass=3.0), "inertia, radius is missing"),
        (
            lambda: formulas.energy_ratio_of_lumped_mass(**(COLUMN | {"half_width": 2.0})),
            "half_width is 2: so squat",
        ),
        (lambda: formulas.energy_ratios_from_peaks([0.1], 0.2), r"peaks is .* \(1,\): give"),
        (lambda: formulas.energy_ratios_from_peaks([7.9, -5.1], 0.2), r"\[0\] is 7.9.* radians"),
        (lambda: formulas.energy_ratios_from_peaks([0.1, 0.0], 0.2), r"peaks\[1\] is 0"),
        (
            lambda: formulas.energy_ratios_from_peaks([0.1, 0.05], 0.2, rotational_stiffness=9.0),
            "mass or radius is missing",
        ),
    ],
)
def test_impossible_input_is_refused(call, message):
    with pytest.raises(ValueError, match=message):
        call()
