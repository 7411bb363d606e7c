"""The five workloads, and what their results are compared by.

W1  free decay of a block of 0.19 x 0.90 m from 0.9 alpha, through 20 impacts; timed over 200
    releases from 0.5 to 0.9 alpha
W2  the block under a record of 4,000 samples at 0.005 s, peak 0.4 g, from rest
W3  the flexible structure of thesis chapter 5 under the same record
W4  the block under 100 x 100 single-sine pulses, 8 s each: outcome and peak
W5  bifurcation diagram of the non-dimensional block (thesis 2-13): 400 amplitudes, 300 periods
    each, the speeds at the crossings of the last 100

Nothing here steps: the structures, the motions, and the measures of error.
"""

from __future__ import annotations

import functools
import json
import math
from dataclasses import dataclass
from pathlib import Path

import numpy as np

import rockeom as rk
from rockeom.simulation.case import Case

REFERENCE = Path(__file__).parent / "reference.json"

GRAVITY = 9.81
WORKLOADS = ("W1", "W2", "W3", "W4", "W5")

BLOCK = rk.RigidBlock(half_width=0.095, half_height=0.45)
SLIDING_BLOCK = rk.SlidingBlock(half_width=0.095, half_height=0.45, friction=0.4, restitution=0.0)
COLUMN = rk.FlexibleStructure(
    mass=122.6,
    height=1.05,
    inertia=44.8,
    base_mass=45.6,
    base_height=0.10,
    base_inertia=1.37,
    half_width=0.285,
    stiffness=571.8e3,
    damping=502.4,
)

# -- W1 ------------------------------------------------------------------------------------------

RELEASE = 0.9 * BLOCK.alpha
N_IMPACTS = 20
RELEASES = np.linspace(0.5, 0.9, 200) * BLOCK.alpha
"""One decay takes less time than calling it: so many of them, of which the last is compared."""


def decay(release: float) -> Case:
    return Case(BLOCK, rk.GroundMotion.none(100.0), initial={"theta": release})


# -- W2 and W3 -----------------------------------------------------------------------------------

SAMPLES, TIME_STEP, PEAK, SEED = 4000, 0.005, 0.4 * GRAVITY, 35


@functools.cache
def record() -> rk.GroundMotion:
    """White noise through a ground of 22 rad/s and a high pass of 5 rad/s, under an envelope.

    Rounded like a file's numbers, so that it is the same to the bit on every machine.
    """
    # the legacy generator: its stream is frozen by NumPy's promise
    noise = np.random.RandomState(SEED).standard_normal(SAMPLES)
    shaking = _oscillator(noise, 22.0, 0.6)
    shaking = shaking - _oscillator(shaking, 5.0, 0.6)
    t = TIME_STEP * np.arange(SAMPLES)
    shaking *= np.minimum(1.0, 0.5 * t) ** 2 * np.where(t < 12.0, 1.0, np.exp(-0.25 * (t - 12.0)))
    shaking *= PEAK / np.abs(shaking).max()
    return rk.GroundMotion.from_array(np.round(shaking, 6), TIME_STEP, name="filtered noise")


def shaken(structure: rk.Structure) -> Case:
    """A structure under the record, by the impact law of all programs that are compared."""
    law = rk.AngularMomentum() if structure.has_impacts else None
    return Case(structure, record(), law)


def _oscillator(force: np.ndarray, frequency: float, damping: float) -> np.ndarray:
    """Absolute acceleration of an oscillator whose base shakes with -force."""
    x = v = 0.0
    out = np.empty_like(force)
    for i, f in enumerate(force.tolist()):
        v += TIME_STEP * (f - 2.0 * damping * frequency * v - frequency**2 * x)
        x += TIME_STEP * v
        out[i] = 2.0 * damping * frequency * v + frequency**2 * x
    return out


# -- W4 ------------------------------------------------------------------------------------------

PULSE_GRID, PULSE_END = 100, 8.0


def pulse_grid(stride: int = 1) -> tuple[np.ndarray, np.ndarray]:
    """Angular frequencies [rad/s] and amplitudes [m/s2]; every stride-th of both."""
    frequencies = np.linspace(1.0, 8.0, PULSE_GRID) * BLOCK.frequency_parameter
    amplitudes = np.linspace(1.01, 8.0, PULSE_GRID) * (GRAVITY * math.tan(BLOCK.alpha))
    return frequencies[stride // 2 :: stride], amplitudes[stride // 2 :: stride]


def pulse(frequency: float, amplitude: float) -> rk.GroundMotion:
    return rk.GroundMotion.single_sine(amplitude, 2.0 * math.pi / frequency, PULSE_END)


def pulses(stride: int = 1) -> list[rk.GroundMotion]:
    frequencies, amplitudes = pulse_grid(stride)
    return [pulse(f, a) for f in frequencies for a in amplitudes]


PULSE_STRIDE = 10
"""The slow methods and the reference take every tenth pulse in both directions."""

# -- W5 ------------------------------------------------------------------------------------------

DRIVEN = rk.NondimensionalBlock(alpha=math.atan(0.5))
DRIVEN_RATIO = 0.5
FREQUENCY = 2.0 * math.pi / 3.0
N_PERIODS, KEPT_PERIODS = 300, 100
AMPLITUDES = np.linspace(3.0, 3.23, 400)
REFERENCE_AMPLITUDES = AMPLITUDES[[0, 100, 250, 320]]
"""Two of period one, two of period two; the slow methods take only these."""
PERIOD = 2.0 * math.pi / FREQUENCY


def shaking(amplitude: float) -> rk.GroundMotion:
    """alpha beta cos(omega tau), in g: thesis 2-13 in the units of the structure."""
    return rk.GroundMotion.harmonic(
        DRIVEN.alpha * amplitude,
        angular_frequency=FREQUENCY,
        phase=0.5 * math.pi,
        duration=N_PERIODS * PERIOD,
    )


def driven(amplitude: float) -> Case:
    return Case(DRIVEN, shaking(amplitude), impact=rk.VelocityRatio(DRIVEN_RATIO))


def kept(impacts: Impacts) -> np.ndarray:
    """Speeds at the crossings of the last periods."""
    return impacts.rates[impacts.times > (N_PERIODS - KEPT_PERIODS) * PERIOD]


# -- results and their errors --------------------------------------------------------------------


@dataclass
class Impacts:
    """Impact times (n,) and the rates of rotation just before (n,)."""

    times: np.ndarray
    rates: np.ndarray

    def firm(self, least: float) -> Impacts:
        """Those faster than `least`: of the endless small ones before each rest, methods see as
        many as their threshold lets them."""
        chosen = np.abs(self.rates) > least
        return Impacts(self.times[chosen], self.rates[chosen])


FIRM = {"W1": 0.0, "W2": 0.02, "W3": 0.02}
"""Least rate of rotation at an impact that is compared [rad/s]."""


@functools.cache
def reference() -> dict:
    return json.loads(REFERENCE.read_text(encoding="utf-8"))


def error(workload: str, result) -> float:
    """How far a result lies from the reference; infinite where something is missing.

    W1, W2, W3: the largest difference of an impact's time [s]. W4: of a peak, relative to alpha,
    over the pulses that do not overturn; infinite for a wrong outcome. W5: of a crossing speed,
    over those amplitudes of the reference whose motion is periodic.
    """
    found = reference()[workload]
    if workload in FIRM:
        if not np.isfinite(result.times).all():
            return math.inf
        times = np.array([float(t) for t in found["times"]])
        rates = np.array([float(v) for v in found["rates"]])
        known = Impacts(times, rates).firm(FIRM[workload])
        if len(result.times) < len(known.times):
            return math.inf
        # the nearest: a speed just at the threshold may fall on its other side
        right = np.searchsorted(result.times, known.times).clip(1, len(result.times) - 1)
        gaps = np.abs(result.times[np.stack([right - 1, right])] - known.times)
        return float(gaps.min(axis=0).max())
    if workload == "W4":
        outcomes, peaks = result
        known = np.array([math.nan if x is None else float(x) for x in found["peaks"]])
        fell = np.isnan(known)
        if len(peaks) > len(known):
            of_grid = np.arange(PULSE_GRID)[PULSE_STRIDE // 2 :: PULSE_STRIDE]
            rows = (PULSE_GRID * of_grid[:, None] + of_grid).ravel()
            outcomes, peaks = outcomes[rows], peaks[rows]
        if (outcomes != fell).any():
            return math.inf
        return float(np.abs(peaks - known)[~fell].max() / BLOCK.alpha)
    worst = 0.0
    for amplitude, speeds in found["cycles"].items():
        known = np.array([float(v) for v in speeds])
        crossings = result[float(amplitude)]
        if len(crossings) % len(known):
            return math.inf
        worst = max(worst, float(np.abs(crossings.reshape(-1, len(known)) - known).max()))
    return worst
