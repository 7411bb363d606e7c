"""The ways of doing each workload, with the settings that are tried for them."""

import functools
import importlib
import itertools
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from types import ModuleType
from typing import Any

from benchmarks import with_best_c, with_c, with_rockeom, with_scipy, workloads as w

Run = Callable[[], object]

TARGETS = {"W1": 1e-9, "W2": 1e-6, "W3": 1e-6, "W4": 1e-7, "W5": 1e-6}
"""Error that a run may have in the comparison at equal error; in the units of ERRORS."""

ERRORS = {
    "W1": ("largest error of an impact time", "s"),
    "W2": ("largest error of an impact time", "s"),
    "W3": ("largest error of an impact time", "s"),
    "W4": ("largest error of a peak rotation", "alpha"),
    "W5": ("largest error of a crossing speed", "alpha p"),
}

PIECES = {
    "W1": ("decay", len(w.RELEASES)),
    "W2": ("motion", 1),
    "W3": ("motion", 1),
    "W4": ("pulse", w.PULSE_GRID**2),
    "W5": ("amplitude", len(w.AMPLITUDES)),
}
"""What one time is given for, and how many of them the whole workload has."""

THINNED = {"W4": len(range(w.PULSE_STRIDE // 2, w.PULSE_GRID, w.PULSE_STRIDE)) ** 2, "W5": 4}
"""How many of them the slow methods, and whatever is compared with them, take."""

TOLERANCES = tuple(10.0 ** (-0.5 * n) for n in range(6, 29))


@dataclass(frozen=True)
class Way:
    """One way of doing a workload; `make` builds all that need not be timed.

    options : of rockeom's solver, where it is that which does it.
    """

    who: str
    setting: str
    make: Callable[[], Run]
    pieces: int = 1
    options: Mapping[str, Any] = field(default_factory=dict)


def _exponent(x: float) -> str:
    return f"{x:.0e}".replace("e-0", "e-")


def thinned(workload: str) -> bool:
    """Whether rockeom and the best C take as few pieces as the slow methods, too.

    Not of W4: a hundred pulses take hardly longer than what a sweep costs before its first.
    """
    return workload == "W5"


# -- rockeom and C -------------------------------------------------------------------------------


def _ours(workload: str, thin: bool) -> dict:
    """Arguments that thin a workload for rockeom and C."""
    if not thin:
        return {}
    return {
        "W4": {"stride": w.PULSE_STRIDE},
        "W5": {"amplitudes": w.REFERENCE_AMPLITUDES},
    }.get(workload, {})


def pieces(workload: str, thin: bool) -> int:
    return THINNED[workload] if thin and workload in THINNED else PIECES[workload][1]


def rockeom(workload: str, *, thin: bool, **options) -> Way:
    rtol, rest = options.get("rtol", 1e-10), options.get("rest_tolerance", 1e-6)
    method = options.get("method", "DOP853")
    if n := options.get("steps_per_segment"):
        setting = f"{method}, {n} step{'s' if n > 1 else ''} a sample, rest {_exponent(rest)}"
    else:
        setting = f"{method}, rtol {_exponent(rtol)}, rest {_exponent(rest)}"
    solver = with_rockeom.options(**{"rtol": 1e-10, **options})
    make = functools.partial(with_rockeom.RUNS[workload], solver, **_ours(workload, thin))
    return Way("rockeom", setting, make, pieces(workload, thin), options)


def through_simulate_many(workload: str, way: Way) -> Way:
    """The same motions with the same options, from what a user writes to the labelled result.

    The whole workload: what a sweep costs before its first case, and lanes that find no case, are
    part of it as they are of any sweep of that size.
    """
    solver = with_rockeom.options(**{"rtol": 1e-10, **way.options})
    make = functools.partial(with_rockeom.MANY[workload], solver)
    many = with_rockeom.REPEATED if workload in ("W2", "W3") else pieces(workload, False)
    return Way("rockeom, rk.simulate_many", way.setting, make, many)


def c(workload: str, variant: str, *, thin: bool, **options) -> Way:
    solver = with_rockeom.options(**{"rtol": 1e-10, **options})
    make = functools.partial(with_c.RUNS[workload], solver, variant, **_ours(workload, thin))
    return Way(variant, "", make, pieces(workload, thin))


def best_c(workload: str, *, thin: bool, **options) -> Way:
    """The other program in C; equal steps as long as a sample."""
    chosen = with_best_c.Options(**options)
    if n := chosen.steps_per_segment:
        setting = f"{chosen.method}, {n} step{'s' if n > 1 else ''} a sample"
    else:
        setting = f"{chosen.method}, rtol {_exponent(chosen.rtol)}"
    setting += f", rest {_exponent(chosen.rest_tolerance)}"
    make = functools.partial(with_best_c.RUNS[workload], chosen, **_ours(workload, thin))
    return Way("best C", setting, make, pieces(workload, thin))


# -- the families of settings that are searched --------------------------------------------------

# Thresholds of rest: rockeom's in units of the motion's own time, the others' in rad/s. A coarse
# one is used wherever the error that is compared forgives it.
OUR_RESTS = {
    "W1": (1e-6,),
    "W2": (1e-6, 1e-1),
    "W3": (1e-6, 1e-4),
    "W4": (1e-6, 1e-1),
    "W5": (1e-6,),
}
THEIR_RESTS = {"W1": (1e-9,), "W2": (1e-2,), "W3": (1e-7, 1e-8), "W4": (1e-2,), "W5": (1e-3,)}

SCIPY: dict[str, list[tuple[str, Sequence[float], float]]] = {
    "W1": [("DOP853", (1e-9, 1e-10), 1e-9), ("RK45", (1e-10,), 1e-9), ("LSODA", (1e-11,), 1e-9)],
    "W2": [("RK45", (1e-3, 1e-8), 1e-2), ("DOP853", (1e-3,), 1e-2)],
    "W3": [("RK45", (1e-7,), 1e-8), ("DOP853", (1e-3, 1e-6), 1e-7)],
    "W4": [("DOP853", (1e-7, 1e-8), 1e-2), ("RK45", (1e-7, 1e-8), 1e-2)],
    "W5": [("DOP853", (1e-7, 1e-8), 1e-3), ("RK45", (1e-7, 1e-8), 1e-3)],
}
"""(method, relative tolerances, threshold of rest): what a wider search left as worth a try."""


def families(who: str, workload: str, rests: Sequence[float] | None = None) -> Iterator[list[Way]]:
    """Settings of one kind, from loose to tight: the first that meets a target is its cheapest.

    rests : thresholds of rest for rockeom and the best C, if not all that are tried.
    """
    rests = rests or OUR_RESTS[workload]
    if who == "rockeom":
        for rest in rests:
            yield [
                rockeom(workload, thin=thinned(workload), rtol=rtol, rest_tolerance=rest)
                for rtol in TOLERANCES
            ]
            if workload in ("W2", "W3"):
                for method, rtol in itertools.product(("RK45", "DOP853"), (1e-6, 1e-10)):
                    # by rtol only what is left to an event is judged
                    yield [
                        rockeom(
                            workload,
                            thin=thinned(workload),
                            method=method,
                            steps_per_segment=n,
                            rtol=rtol,
                            rest_tolerance=rest,
                        )
                        for n in (1, 2, 4)
                    ]
    elif who == "best C":
        for rest, method in itertools.product(rests, ("DOP853", "Tsit5")):
            if workload in ("W2", "W3"):
                # what is left to an event is extrapolated within rtol
                yield [
                    best_c(
                        workload,
                        thin=thinned(workload),
                        method=method,
                        steps_per_segment=n,
                        rtol=rtol,
                        rest_tolerance=rest,
                    )
                    for n, rtol in ((1, 1e-6), (2, 1e-6), (2, 1e-10), (3, 1e-10))
                ]
            yield [
                best_c(
                    workload, thin=thinned(workload), method=method, rtol=rtol, rest_tolerance=rest
                )
                for rtol in TOLERANCES
            ]
    elif who == "heyoka":
        for rest in THEIR_RESTS[workload]:
            yield [heyoka_way(workload, tolerance, rest) for tolerance in TOLERANCES]
    elif who == "SciPy":
        for method, tolerances, rest in SCIPY[workload]:
            yield [scipy_way(workload, method, rtol, rest) for rtol in tolerances]


def heyoka_way(workload: str, tolerance: float, rest: float) -> Way:
    make = functools.partial(heyoka().RUNS[workload], tolerance, rest)
    setting = f"tolerance {_exponent(tolerance)}, rest {_exponent(rest)}"
    return Way("heyoka", setting, make, THINNED.get(workload, 1))


def scipy_way(workload: str, method: str, rtol: float, rest: float) -> Way:
    make = functools.partial(with_scipy.RUNS[workload], method, rtol, rest)
    setting = f"{method}, rtol {_exponent(rtol)}, rest {_exponent(rest)}"
    return Way("SciPy", setting, make, THINNED.get(workload, 1))


def over_samples() -> Way:
    """What looks cheaper for a record by SciPy, to show what it costs."""
    make = functools.partial(with_scipy.over_samples, "RK45", 1e-5, 1e-2)
    return Way("SciPy, steps over samples", "RK45, rtol 1e-5, rest 1e-2", make)


def heyoka() -> ModuleType:
    return importlib.import_module("benchmarks.with_heyoka")


def missing() -> dict[str, str]:
    """What cannot be run here, and why."""
    found = {}
    try:
        with_c.compiler()
    except RuntimeError as error:
        found["C"] = str(error)
    try:
        heyoka()
    except ImportError:
        found["heyoka"] = "heyoka is not installed: pip install heyoka"
    return found
