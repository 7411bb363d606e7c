"""Steps in which nothing happens are taken apart from the loop where no step is kept.

Where steps are kept the loop takes each of them itself: both must be the same motion to the last
bit.
"""

import numpy as np
import pytest

import rockeom as rk
from rockeom.integrator.program import program
from rockeom.simulation.case import Case
from rockeom.simulation.recorder import DenseRecorder
from rockeom.simulation.simulate import run
from tests.typical import column, oscillator

STRUCTURES = {
    "block": rk.RigidBlock(half_width=0.095, half_height=0.45),
    "column": column(),
    "oscillator": oscillator(),
}


def shaken(seed, scale):
    """Band-limited noise."""
    noise = np.random.default_rng(seed).normal(size=400)
    acceleration = scale * np.convolve(noise, np.hanning(9) / 4.5, "same")
    return rk.GroundMotion.from_array(acceleration, dt=0.01)


MOTIONS = {
    "record": (shaken(1, 6.0), None),
    "weak record": (shaken(2, 0.5), None),
    "both directions": (shaken(3, 5.0), shaken(4, 3.0)),
    "sine": (rk.GroundMotion.single_sine(4.0, 1.1), None),
    "wavelet": (rk.GroundMotion.ricker(3.0, 1.0), None),
    "a jump": (rk.GroundMotion.constant(2.5, 1.0), None),
}
OPTIONS = {
    "controlled": {},
    "loose": {"rtol": 1e-5, "atol": 1e-8},
    "equal": {"steps_per_segment": 2},
    "short": {"max_step": 0.004},
}


@pytest.mark.parametrize("name", STRUCTURES)
@pytest.mark.parametrize("options", OPTIONS)
def test_motions_of_which_no_step_is_kept_have_the_same_bits(name, options):
    structure, solver = STRUCTURES[name], rk.SolverOptions("DOP853", **OPTIONS[options])
    compiled = program(structure.module, "DOP853")
    events = 0
    for motion, vertical in MOTIONS.values():
        problem = Case(structure, motion, duration=6.0, vertical=vertical).problem()
        alone, kept = (
            run(compiled, problem, solver),
            run(compiled, problem, solver, DenseRecorder()),
        )
        assert alone.outcome is kept.outcome
        assert alone.refined == kept.refined
        assert np.array_equal(alone.y, kept.y)
        for one, other in zip(alone.events, kept.events, strict=True):
            assert np.array_equal(one, other)
        events += len(alone.events[0])
    assert events > 10
