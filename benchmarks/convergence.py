"""The order of convergence through impacts, observed against references of 30 digits.

    python -m benchmarks.convergence

Steps of one length, of which only impacts cut one: what an impact costs would be seen as a lower
order. A block under a harmonic motion, then the workloads under a record, whose samples are kinks.
"""

from dataclasses import replace

import numpy as np
from mpmath import mpf

import rockeom as rk
from benchmarks import reference, report, with_rockeom, workloads as w
from rockeom.integrator.program import program
from rockeom.simulation.simulate import run

P, ALPHA, RATIO, RELEASE = 2.0, 0.3, 0.9, 0.12
MOTION = rk.GroundMotion.harmonic(0.5, period=2.0, phase=0.4, duration=8.0)
PLACES = {1: 1.0, 2: 2.2, 4: 4.2, 8: 7.8}
"""Impact -> time between it and the next, at which the state is compared [s]."""

COUNTS = {"RK45": range(80, 330, 10), "DOP853": range(24, 74, 2)}
"""Steps over the whole motion."""
ROUNDING = 1e-13  # smaller errors say nothing of the order


def exact(end: float) -> tuple[np.ndarray, np.ndarray]:
    """(times of the impacts, state at the end), rounded from 36 digits."""
    block = reference.Block(mpf(P) ** 2, mpf(ALPHA), mpf(w.GRAVITY), mpf(RATIO))
    table = MOTION.segments.copy()
    table[0, 1] = end
    found = reference.follow(block, table, [mpf(RELEASE), 0], 1)
    return np.array(found.times, float), np.array(found.y, float)


def by_rockeom(end: float, method: str, steps: int) -> tuple[np.ndarray, np.ndarray]:
    """The same, in equal steps."""
    case = w.Case(
        rk.RigidBlock.from_frequency(p=P, alpha=ALPHA),
        MOTION,
        impact=rk.VelocityRatio(RATIO),
        initial={"theta": RELEASE},
        duration=end,
    )
    compiled = program(case.structure.module, method)
    solver = rk.SolverOptions(method=method, steps_per_segment=steps)
    record = run(compiled, case.problem(), solver)
    return record.events[0], record.y


def order(counts: np.ndarray, errors: np.ndarray) -> float:
    seen = errors > ROUNDING
    return -np.polyfit(np.log(counts[seen]), np.log(errors[seen]), 1)[0]


def through_impacts() -> str:
    references = {k: exact(end) for k, end in PLACES.items()}
    rows = []
    for method, steps in COUNTS.items():
        counts = np.array(steps)
        for k, (times, y) in references.items():
            found = [by_rockeom(PLACES[k], method, n) for n in steps]
            if any(len(t) != k for t, _ in found) or len(times) != k:
                raise ArithmeticError(f"not {k} impacts")
            of_time = np.array([abs(t[-1] - times[-1]) for t, _ in found])
            of_state = np.array([np.hypot(*((z - y) / (ALPHA, ALPHA * P))) for _, z in found])
            rows.append(
                (
                    method,
                    str(k),
                    f"{order(counts, of_time):.1f}",
                    f"{of_time[0]:.0e} ... {of_time[-1]:.0e}",
                    f"{order(counts, of_state):.1f}",
                    f"{of_state[0]:.0e} ... {of_state[-1]:.0e}",
                )
            )
    head = (
        "method",
        "impacts",
        "order of the last one's time",
        "its error [s]",
        "order of the state after it",
        "its error [alpha]",
    )
    return report.table(head, rows)


def under_the_record() -> str:
    rows = []
    for workload in ("W2", "W3"):
        last = None
        for steps in (1, 2, 3):
            solver = with_rockeom.options(1e-10, method="RK45", steps_per_segment=steps)
            solver = replace(solver, rest_tolerance=1e-8)
            error = w.error(workload, with_rockeom.RUNS[workload](solver)())
            found = np.log(last[1] / error) / np.log(steps / last[0]) if last else None
            rows.append((workload, str(steps), f"{error:.1e}", f"{found:.1f}" if found else ""))
            last = steps, error
    return report.table(("RK45", "steps a sample", "largest error [s]", "order"), rows)


if __name__ == "__main__":
    print(through_impacts() + "\n")
    print(under_the_record())
