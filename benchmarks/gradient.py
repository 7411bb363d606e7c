"""A gradient with respect to ten parameters beside runs of the same motion.

    python -m benchmarks.gradient

By differences to both sides it takes 21 runs, each with an error of its own. What is timed is
`rk.sensitivity` with all that Python does for it, some milliseconds, against `rk.simulate`.
"""

from collections.abc import Callable, Iterator

import rockeom as rk
from benchmarks import report, timing, workloads as w

GOAL = 6.0
"""Runs."""
BY_DIFFERENCES = 21

_START = ("initial theta", "initial theta_dot")
_OF_BLOCK = ("half_width", "half_height", "mass", "gravity", "restitution", *_START)
OF_BLOCK = (*_OF_BLOCK, "scale", "time_scale", "duration")
OF_COLUMN = (
    "mass", "height", "inertia", "base_mass", "base_height", "base_inertia", "half_width",
    "stiffness", "damping", "scale",
)  # fmt: skip


def cases() -> dict[str, tuple[rk.Case, tuple[str, ...], str]]:
    """(case, what it is derived by, the answer) by what it is."""
    law, start = rk.VelocityRatio(0.9), {"theta": w.RELEASE}
    still, record = rk.GroundMotion.none(20.0), w.record()
    shear = rk.ShearFrame(
        masses=[20e3, 20e3], heights=[3.5, 7.0], stiffnesses=[20e6, 20e6],
        dampings=[120e3, 120e3], half_width=1.2, base_mass=10e3,
    )  # fmt: skip
    of_frame = (*(f"{n}[{i}]" for n in shear.of_each if n != "inertias" for i in (0, 1)),)
    return {
        "W1, the block let go": (rk.Case(w.BLOCK, still, law, start), OF_BLOCK, "impact 9 time"),
        "W4, one of its pulses": (
            rk.Case(w.BLOCK, w.pulses(w.PULSE_STRIDE)[50], law), OF_BLOCK, "end theta",
        ),
        "W2, the block, a record": (rk.Case(w.BLOCK, record, law), OF_BLOCK, "end theta"),
        "W3, the column, a record": (w.shaken(w.COLUMN), OF_COLUMN, "end u"),
        "two storeys, a record": (
            w.shaken(shear), (*of_frame, "half_width", "base_mass"), "end u_2",
        ),
    }  # fmt: skip


def ways(case: rk.Case, to: tuple[str, ...], answer: str) -> dict[str, Callable[[], object]]:
    return {
        "a run": lambda: rk.simulate(
            case.structure, case.motion, impact=case.impact, initial=case.initial
        ),
        "gradient": lambda: rk.sensitivity(case, [answer], to),
    }


def rows() -> Iterator[report.Row]:
    for name, (case, to, answer) in cases().items():
        found = rk.sensitivity(case, [answer], to).tangents.response
        measured = timing.in_turns(ways(case, to, answer), 7)
        run, gradient = measured["a run"], measured["gradient"]
        yield (
            name, str(len(to)), str(len(found.steps)), str(len(found.impacts)),
            report.seconds(run.median), report.seconds(gradient.median),
            report.times(gradient.ratio_to(run)),
        )  # fmt: skip


def main() -> None:
    head = (
        "motion", "parameters", "steps", "impacts", "a run", "gradient",
        f"runs (goal {GOAL:g}, by differences {BY_DIFFERENCES})",
    )  # fmt: skip
    print(report.table(head, list(rows())))


if __name__ == "__main__":
    main()
