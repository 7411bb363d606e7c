"""Boundaries of overturning by derivatives, beside closed forms and motions on both sides."""

import numpy as np
import pytest

import rockeom as rk
from rockeom import analysis
from rockeom.analysis import dynamics, formulas
from rockeom.motion import STANDARD_GRAVITY as GRAVITY
from tests.typical import column

from .exact_slender import exact_fates

SLENDER = rk.SlenderBlock.from_frequency(p=2.0, alpha=0.2)
LAW = rk.VelocityRatio(0.9)
SINE = dynamics.dimensionless_pulses(SLENDER, impact=LAW, p=2.0)
HALF_SINE = dynamics.dimensionless_pulses(SLENDER, rk.GroundMotion.half_sine, impact=LAW, p=2.0)


def between(case, low, high, **others):
    """The point between two amplitudes."""
    return dynamics.overturning_point(
        case, {**others, "amplitude": low}, {**others, "amplitude": high}, accuracy=1e-12
    )


def housner(frequency):
    """The amplitude of half a sine that overturns the slender block, in g alpha."""
    return float(formulas.overturning_half_sine(np.pi / (2 * frequency), 0.2, 2)) / (GRAVITY * 0.2)


@pytest.mark.parametrize("frequency", [0.7, 3.0])
def test_half_sine_overturns_from_housners_amplitude_on(frequency):
    point = between(HALF_SINE, 1.01, 8.0, frequency=frequency)
    assert (point.below, point.above) == (np.inf, 0.0)
    assert point.at["frequency"] == frequency
    assert point.at["amplitude"] == pytest.approx(housner(frequency), rel=1e-10)
    assert point.runs < 20
    slope = (housner(frequency + 1e-4) - housner(frequency - 1e-4)) / 2e-4
    assert -point.normal[0] / point.normal[1] == pytest.approx(slope, rel=1e-5)


def test_boundary_of_the_slender_block_is_followed_on_its_exact_course():
    point = between(SINE, 1.2, 2.5, frequency=4.0)
    box = {"frequency": (1.5, 7.0), "amplitude": (1.0, 8.0)}
    line = dynamics.followed_boundary(SINE, point, box, step=0.1)
    assert line.attrs["first"] == line.attrs["last"] == "left what is within"
    frequency, amplitude = line.frequency.values, line.amplitude.values
    assert np.ptp(frequency) > 3
    for sign, fate in ((-1, point.below), (1, point.above)):
        away = 3e-7 * sign * amplitude
        found = exact_fates(
            frequency + away * line.normal_frequency.values,
            amplitude + away * line.normal_amplitude.values,
            0.9,
        )
        assert (found == fate).all()
    gaps = np.hypot(np.diff(frequency) / 5.5, np.diff(amplitude) / 7.0)
    assert gaps.max() < 0.11


def test_boundary_ends_where_its_step_is_wider_than_the_fate_beside_it():
    """The window above overturning after an impact becomes narrow as exp(-2 pi p/omega)."""
    box = {"frequency": (0.2, 7.0), "amplitude": (1.0, 8.0)}
    point = between(SINE, 3.0, 5.2, frequency=4.0)
    assert (point.below, point.above) == (1.0, np.inf)
    line = dynamics.followed_boundary(SINE, point, box, step=0.1)
    assert line.attrs["last"] == "the boundary between these fates ends"
    assert line.attrs["first"] == "left what is within"
    frequency, amplitude = (float(line[name][-1]) for name in box)
    (found,) = exact_fates(np.array([frequency]), np.array([amplitude + 1e-3]), 0.9)
    assert found == 0  # the window is narrower than this


def flexible(amplitude):
    """A column on a rigid base, 2.1 m to its mass."""
    return rk.Case(column(), rk.GroundMotion.single_sine(amplitude, 1.2))


def test_flexible_column_overturns_on_one_side_of_its_boundary_only():
    point = between(flexible, 3.0, 7.0)
    fates = []
    for side in (-1, 1):
        case = flexible(point.at["amplitude"] * (1 + 1e-8 * side))
        run = rk.simulate(case.structure, case.motion, duration=60.0)
        fates.append(len(run.impacts) if run.outcome is rk.Outcome.OVERTURNED else np.inf)
    assert fates == [point.below, point.above]


def test_point_agrees_with_halving():
    def tall(amplitude):
        block = rk.RigidBlock(half_width=1.0, half_height=8.0)
        pulse = rk.GroundMotion.single_sine(amplitude, 2.192)
        return rk.Case(block, pulse, impact=rk.EnergyRatio(0.954))

    sweep = rk.simulate_many(tall, {"amplitude": [4.45, 5.0]})
    halved = analysis.overturning_boundaries(tall, sweep, accuracy=1e-11)
    point = between(tall, 4.45, 5.0)
    assert point.at["amplitude"] == pytest.approx(float(halved.amplitude[0]), rel=1e-10)


def test_what_is_no_boundary_says_so():
    at = {"frequency": 4.0}
    with pytest.raises(ValueError, match=r"amplitude = 0.5 stands, and .*1.1 stands: give two fat"):
        between(SINE, 0.5, 1.1, **at)
    with pytest.raises(ValueError, match=r"another fate, at frequency = 4, amplitude = .* stands"):
        between(SINE, 4.5, 6.0, **at)
    with pytest.raises(ValueError, match="start has amplitude, end frequency: give the same names"):
        dynamics.overturning_point(SINE, {"amplitude": 1.0}, at)
    point = between(SINE, 1.2, 2.5, **at)
    with pytest.raises(ValueError, match="within has amplitude, the point frequency, amplitude"):
        dynamics.followed_boundary(SINE, point, {"amplitude": (1.0, 8.0)})
    with pytest.raises(ValueError, match="which is not within"):
        dynamics.followed_boundary(SINE, point, {"frequency": (5, 6), "amplitude": (1, 8)})
