"""The workloads by rockeom."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np

import rockeom as rk
from benchmarks import workloads as w
from rockeom.numeric.case import Case
from rockeom.numeric.ensemble import _Results
from rockeom.numeric.simulate import run
from rockeom.numeric.specialise import program

IMPACT = 0


def options(rtol: float, **changes: float) -> rk.SolverOptions:
    return replace(rk.SolverOptions(rtol=rtol, atol=1e-2 * rtol), **changes)


def _impacts(events: tuple[np.ndarray, ...], rate_at: int) -> w.Impacts:
    times, kinds, states = events
    chosen = kinds[:, 0] == IMPACT
    return w.Impacts(times[chosen], states[chosen, 0, rate_at])


def loop(structure, motion, solver: rk.SolverOptions, **case) -> Callable[[], w.Impacts]:
    """The compiled loop by itself, without dense output kept."""
    problem = Case(structure, motion, **case).problem()
    compiled = program(structure.module, solver.method)
    rate_at = structure.module.ROTATION_RATE
    return lambda: _impacts(run(compiled, problem, solver, keep=False).events, rate_at)


def response(structure, motion, solver: rk.SolverOptions, **case) -> Callable[[], w.Impacts]:
    """What a user calls: the response with all that belongs to it."""

    def call() -> w.Impacts:
        found = rk.simulate(structure, motion, options=solver, **case)
        return _impacts(found.passages, structure.module.ROTATION_RATE)

    return call


def free_decay(rtol: float, entry=loop) -> Callable[[], w.Impacts]:
    solver = options(rtol, max_impacts=w.N_IMPACTS - 1)
    motion = rk.GroundMotion.none(100.0)
    return entry(w.BLOCK, motion, solver, initial={"theta": w.RELEASE})


def under_record(structure, rtol: float, entry=loop, **changes: float) -> Callable[[], w.Impacts]:
    return entry(structure, w.record(), options(rtol, **changes))


def pulses(rtol: float):
    """Outcome and peak of every pulse: the compiled loop over prepared cases."""
    problems = [Case(w.BLOCK, motion).problem() for motion in w.pulses()]
    solver = options(rtol)
    compiled = program(w.BLOCK.module, solver.method)

    def call():
        results = _Results.empty(len(problems), w.BLOCK.module.N_STATES, 0)
        results.run(0, problems, compiled, solver)
        fell = results.outcome == list(rk.Outcome).index(rk.Outcome.OVERTURNED)
        return fell, np.abs(results.peaks[:, :, 0]).max(axis=1)

    return call


def pulse_map(rtol: float, threads: int = 1):
    """Outcome and peak of every pulse, from the numbers of the grid to a labelled dataset."""
    frequencies, amplitudes = w.pulse_grid()

    def case(frequency: float, amplitude: float) -> rk.Case:
        return rk.Case(w.BLOCK, w.pulse(frequency, amplitude))

    def call():
        found = rk.simulate_many(
            case,
            {"frequency": frequencies, "amplitude": amplitudes},
            options=options(rtol),
            threads=threads,
            progress=False,
        )
        fell = found["outcome"].to_numpy() == "overturned"
        extremes = np.maximum(-found["smallest"].to_numpy(), found["largest"].to_numpy())
        return fell.ravel(), extremes[..., 0].ravel()

    return call


def bifurcation(rtol: float) -> Callable[[], dict[float, np.ndarray]]:
    law = rk.VelocityRatio(w.DRIVEN_RATIO)
    runs = {float(a): loop(w.DRIVEN, w.shaking(a), options(rtol), impact=law) for a in w.AMPLITUDES}
    return lambda: {a: w.kept(call()) for a, call in runs.items()}
