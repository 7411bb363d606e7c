"""Maps of many motions on one core: lanes beside C and beside one by one.

    python -m benchmarks.lanes

400 blocks of different size and slenderness, and 100 flexible structures of different width and
stiffness, under the record of W2: C and "one by one" take controlled steps, which end at every
sample; lanes take one step a sample. 400 of the pulses of W4: controlled steps everywhere. All of
order 8.
"""

from collections.abc import Callable, Iterator
from threading import Event

import numpy as np

import rockeom as rk
from benchmarks import report, timing, ways, with_c, with_rockeom, workloads as w
from rockeom.integrator.program import program
from rockeom.simulation.case import Problems
from rockeom.sweeps.cases import Batch
from rockeom.sweeps.results import Results

RTOL = 1e-6
"""Of the controlled steps: so loose that hardly one is shorter than a sample."""
FIRST_IMPACTS = 20

HEIGHTS, SLENDERNESSES = np.linspace(0.3, 3.0, 20), np.linspace(0.12, 0.36, 20)  # m, rad
WIDTHS, STIFFNESSES = np.linspace(0.16, 0.36, 10), np.linspace(2e5, 1e6, 10)  # m, N/m


def blocks() -> list[w.Case]:
    return [
        w.shaken(rk.RigidBlock(half_width=h * np.tan(alpha), half_height=h))
        for h in HEIGHTS
        for alpha in SLENDERNESSES
    ]


def columns() -> list[w.Case]:
    values = w.COLUMN.parameters()
    return [
        w.shaken(rk.FlexibleStructure(**values | {"half_width": b, "stiffness": k}))
        for b in WIDTHS
        for k in STIFFNESSES
    ]


def pulses() -> list[w.Case]:
    return [w.Case(w.BLOCK, motion) for motion in w.pulses(5)]


def by_c(cases: list[w.Case], variant: str) -> Callable[[], list]:
    problems = [with_c.Problem(case, with_rockeom.options(RTOL), variant) for case in cases]
    return lambda: [problem.run() for problem in problems]


def by_rockeom(cases: list[w.Case], solver: rk.SolverOptions, lanes: bool) -> Callable:
    """As simulate_many runs a chunk of prepared cases."""
    part = Batch(np.arange(len(cases)), Problems.of([case.problem() for case in cases]), [])
    module = cases[0].structure.module
    compiled = program(module, solver.method, lanes)

    def call() -> Results:
        results = Results.empty(len(cases), module.N_STATES, FIRST_IMPACTS)
        results.integrate(part, compiled, solver, Event(), lanes)
        return results

    return call


def first_impacts(result: Results | list) -> np.ndarray:
    """Times (n, FIRST_IMPACTS) of the first impacts of each motion, nan where there are fewer."""
    if isinstance(result, Results):
        return result.times
    times = np.full((len(result), FIRST_IMPACTS), np.nan)
    for row, (_, _, events, _) in zip(times, result, strict=True):
        found = events["time"][events["kind"] == with_c.IMPACT][:FIRST_IMPACTS]
        row[: len(found)] = found
    return times


def fallen(result: Results | list) -> int:
    if isinstance(result, Results):
        return int((result.outcome == with_c.OVERTURNED).sum())
    return sum(outcome == with_c.OVERTURNED for outcome, *_ in result)


def rows(
    turns: int = 7, told: Callable[[str, str], None] = lambda *_: None
) -> Iterator[report.Row]:
    """Time and error of each way on each map, as cells of `report.lanes`.

    A step's time is told where steps are as long as the samples. The error of a motion is the
    largest among the times of its first impacts, against steps of tolerance 1e-13.
    """
    a_sample, loose = rk.SolverOptions("DOP853", steps_per_segment=1), with_rockeom.options(RTOL)
    maps = (
        ("blocks", blocks(), a_sample),
        ("flexible structures", columns(), a_sample),
        ("pulses", pulses(), loose),
    )
    for name, cases, of_lanes in maps:
        told("lanes and one by one:", name)
        runs: dict[str, Callable[[], Results | list]] = {}
        if "C" not in ways.missing():
            runs = {variant: by_c(cases, variant) for variant in with_c.VARIANTS}
        runs["one by one"] = by_rockeom(cases, loose, False)
        runs["lanes"] = by_rockeom(cases, of_lanes, True)
        exact = first_impacts(by_rockeom(cases, with_rockeom.options(1e-13), False)())
        times = timing.in_turns(runs, turns)
        for way, run in runs.items():
            result = run()
            off = np.abs(first_impacts(result) - exact)
            rocks = np.isfinite(off).any(axis=1)
            a_motion = times[way].median / len(cases)
            equal = way == "lanes" and of_lanes.steps_per_segment == 1
            yield (
                name,
                way,
                report.seconds(a_motion),
                report.seconds(a_motion / len(cases[0].motion.segments)) if equal else "",
                report.times(times[way].ratio_to(times["C"])) if "C" in times else "",
                report.scientific(np.median(np.nanmax(off[rocks], axis=1))),
                str(fallen(result)),
            )


if __name__ == "__main__":
    print(report.lanes(list(rows())))
