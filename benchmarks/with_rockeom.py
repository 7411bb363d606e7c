"""The workloads by rockeom."""

from collections.abc import Callable
from dataclasses import replace
from threading import Event

import numpy as np

import rockeom as rk
from benchmarks import workloads as w
from rockeom.codes import IMPACT, REST
from rockeom.integrator.program import program
from rockeom.simulation.case import Case, Problems
from rockeom.simulation.recorder import DenseRecorder
from rockeom.simulation.simulate import run
from rockeom.sweeps.cases import Batch
from rockeom.sweeps.results import Results


def options(rtol: float, **changes) -> rk.SolverOptions:
    return replace(rk.SolverOptions("DOP853", rtol=rtol, atol=1e-2 * rtol), **changes)


def _impacts(events: tuple[np.ndarray, ...], rate_at: int) -> w.Impacts:
    times, kinds, states = events
    chosen = kinds[:, 0] == IMPACT
    return w.Impacts(times[chosen], states[:, 0, rate_at][chosen])


def loop(case: Case, solver: rk.SolverOptions) -> Callable[[], w.Impacts]:
    """The compiled loop by itself, without dense output kept."""
    problem, module = case.problem(), case.structure.module
    compiled = program(module, solver.method)
    rate_at = module.ROTATION_RATE
    return lambda: _impacts(run(compiled, problem, solver).events, rate_at)


def response(case: Case, solver: rk.SolverOptions) -> Callable[[], w.Impacts]:
    """What a user calls: the response with all that belongs to it."""

    def call() -> w.Impacts:
        found = rk.simulate(
            case.structure, case.motion, impact=case.impact, initial=case.initial, options=solver
        )
        return _impacts(found.events.columns, case.structure.module.ROTATION_RATE)

    return call


def steps(case: Case, solver: rk.SolverOptions) -> int:
    """Number of steps of a motion; a rest, which is recorded as one, is none."""
    taken = DenseRecorder()
    record = run(program(case.structure.module, solver.method), case.problem(), solver, taken)
    return len(taken) - int((record.events[1][:, 0] == REST).sum())


def released(block) -> Case:
    """Free rocking from half of the block's slenderness, for less time than to its first impact."""
    return Case(block, rk.GroundMotion.none(0.1), initial={"theta": 0.5 * w.BLOCK.alpha})


def _many(cases: list[Case], solver: rk.SolverOptions, times: int = 0) -> Callable[[], Results]:
    """The compiled loop over prepared cases, as simulate_many calls it."""
    part = Batch(np.arange(len(cases)), Problems.of([case.problem() for case in cases]), [])
    module = cases[0].structure.module
    compiled = program(module, solver.method)

    def call() -> Results:
        results = Results.empty(len(cases), module.N_STATES, times)
        results.integrate(part, compiled, solver, Event())
        return results

    return call


# -- the workloads -------------------------------------------------------------------------------


def free_decay(solver: rk.SolverOptions, entry=loop) -> Callable[[], w.Impacts]:
    return entry(w.decay(w.RELEASE), replace(solver, max_impacts=w.N_IMPACTS - 1))


def decays(solver: rk.SolverOptions) -> Callable[[], w.Impacts]:
    """Of all releases in one call; the impacts of the last."""
    solver = replace(solver, max_impacts=w.N_IMPACTS - 1)
    many = _many([w.decay(release) for release in w.RELEASES], solver, w.N_IMPACTS)

    def call() -> w.Impacts:
        times = many().times[-1]
        return w.Impacts(times, np.full(len(times), np.nan))

    return call


def under_record(structure) -> Callable:
    def made(solver: rk.SolverOptions, entry=loop) -> Callable[[], w.Impacts]:
        return entry(w.shaken(structure), solver)

    return made


def pulses(solver: rk.SolverOptions, stride: int = 1) -> Callable:
    """Outcome and peak of every pulse."""
    many = _many([Case(w.BLOCK, motion) for motion in w.pulses(stride)], solver)
    overturned = list(rk.Outcome).index(rk.Outcome.OVERTURNED)

    def call() -> tuple[np.ndarray, np.ndarray]:
        results = many()
        return results.outcome == overturned, np.abs(results.peaks[:, :, 0]).max(axis=1)

    return call


def pulse_map(solver: rk.SolverOptions, threads: int = 1, stride: int = 1) -> Callable:
    """Outcome and peak of every pulse, from the numbers of the grid to a labelled dataset."""
    frequencies, amplitudes = w.pulse_grid(stride)

    def case(frequency: float, amplitude: float) -> Case:
        return Case(w.BLOCK, w.pulse(frequency, amplitude))

    def call() -> tuple[np.ndarray, np.ndarray]:
        found = rk.simulate_many(
            case,
            {"frequency": frequencies, "amplitude": amplitudes},
            options=solver,
            sweep_options=rk.SweepOptions(threads=threads, progress=False),
        )
        fell = found["outcome"].to_numpy() == "overturned"
        extremes = found["peak"].to_numpy()
        return fell.ravel(), extremes[..., 0].ravel()

    return call


BY_NAMES = Case(w.BLOCK, rk.GroundMotion.single_sine(3.0, 0.8, duration=8.0))


def _of_names(frequency: float, amplitude: float) -> Case:
    return Case(w.BLOCK, rk.GroundMotion.single_sine(amplitude, 1 / frequency, duration=8.0))


def map_by(case: Case | Callable[..., Case], n: int) -> Callable[[], rk.Sweep]:
    """n times n pulses on one core, by the names of a case's numbers or by a function."""
    over = {"frequency": np.linspace(0.5, 4.0, n), "amplitude": np.linspace(1.0, 8.0, n)}
    how = rk.SweepOptions(threads=1, progress=False)
    return lambda: rk.simulate_many(case, over, sweep_options=how)


def names_and_function(n: int) -> dict[str, Callable[[], rk.Sweep]]:
    return {"names": map_by(BY_NAMES, n), "function": map_by(_of_names, n)}


def sweep(name: str, case: Callable[[float], Case], values, **changes) -> Callable:
    """A workload by simulate_many on one core, from the values to a labelled dataset."""

    def made(solver: rk.SolverOptions, amplitudes=values) -> Callable[[], object]:
        options = replace(solver, **changes)
        return lambda: rk.simulate_many(
            lambda **value: case(value[name]),
            {name: amplitudes},
            impact_times=changes.get("max_impacts", -1) + 1,
            options=options,
            sweep_options=rk.SweepOptions(threads=1, progress=False),
        )

    return made


ONE_STEP = rk.SolverOptions("DOP853", max_steps=1)
"""Of a motion little more than its beginning is left: what it costs to make a case is seen."""


def _another_block(half_width: float, amplitude: float) -> Case:
    block = rk.RigidBlock(half_width=half_width, half_height=0.45)
    return Case(block, rk.GroundMotion.single_sine(amplitude, 0.5))


def _blocks(n: int) -> dict[str, np.ndarray]:
    """100 n of them."""
    return {"half_width": np.linspace(0.05, 0.1, n), "amplitude": np.linspace(4.0, 8.0, 100)}


def making(arrays: bool, n: int) -> Callable[[], object]:
    """100 n blocks under pulses, one step of each, from the numbers to a labelled dataset.

    arrays : whether the function may be called for many at once; else it asks for single numbers.
    """

    def one_by_one(half_width: float, amplitude: float) -> Case:
        return _another_block(float(half_width), float(amplitude))

    return lambda: rk.simulate_many(
        _another_block if arrays else one_by_one,
        _blocks(n),
        options=ONE_STEP,
        sweep_options=rk.SweepOptions(threads=1, progress=False),
    )


def made(n: int) -> Callable[[], object]:
    """One step of the same, which are made already."""
    widths, amplitudes = _blocks(n).values()
    return _many([_another_block(b, a) for b in widths for a in amplitudes], ONE_STEP)


def bifurcation(solver: rk.SolverOptions, amplitudes=w.AMPLITUDES) -> Callable:
    runs = {float(a): loop(w.driven(a), solver) for a in amplitudes}
    return lambda: {a: w.kept(call()) for a, call in runs.items()}


RUNS = {
    "W1": decays,
    "W2": under_record(w.BLOCK),
    "W3": under_record(w.COLUMN),
    "W4": pulses,
    "W5": bifurcation,
}
"""Workload -> options -> what runs it."""

REPEATED = 64
"""So many times one record is given to simulate_many, which is meant for many: lanes that the last
of few leave empty take as long as full ones, so that of 20 each takes half as long again."""

MANY = {
    "W1": sweep("release", w.decay, w.RELEASES, max_impacts=w.N_IMPACTS - 1),
    "W2": sweep("copy", lambda _: w.shaken(w.BLOCK), np.arange(REPEATED)),
    "W3": sweep("copy", lambda _: w.shaken(w.COLUMN), np.arange(REPEATED)),
    "W4": pulse_map,
    "W5": sweep("amplitude", w.driven, w.AMPLITUDES),
}
"""Workload -> options -> the same motions by rk.simulate_many on one core."""

SINGLE = {"W1": free_decay, "W2": RUNS["W2"], "W3": RUNS["W3"]}
"""Workload -> (options, entry) -> one motion by that entry."""
