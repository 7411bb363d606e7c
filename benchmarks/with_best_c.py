"""What one would write in C for these workloads alone, by the method that suits each: c/best.h.

Its equations are typed, in the files that the other program in C has too; before a structure's are
used, they are compared with those that were derived. Raises RuntimeError where there is no
compiler, or where they differ.
"""

import ctypes
import functools
from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

import rockeom as rk
from benchmarks import with_c, workloads as w
from benchmarks.with_c import Prepared, at, vector
from rockeom.integrator.methods.tableau import Tableau, tableau

FLAGS = (*with_c.FLAGS, "-DSMALL_ANGLES", "-fopenmp-simd")
"""Only the loop over the ground's sines, which says so, is done in vectors."""


@dataclass(frozen=True)
class Options:
    """As rockeom's, and Tsit5 among the methods. steps_per_segment : 0 for steps by the error."""

    method: str = "DOP853"
    rtol: float = 1e-10
    rest_tolerance: float = 1e-6
    steps_per_segment: int = 0
    max_impacts: int = 100_000


def tsit5() -> Tableau:
    """Tsitouras (2011) 5(4); its dense output is the quintic through both ends, like all here."""
    rows = [
        [],
        [0.161],
        [-0.008480655492356989, 0.335480655492357],
        [2.8971530571054935, -6.359448489975075, 4.3622954328695815],
        [5.325864828439257, -11.748883564062828, 7.4955393428898365, -0.09249506636175525],
        [
            5.86145544294642, -12.92096931784711, 8.159367898576159, -0.071584973281401,
            -0.028269050394068383,
        ],
        [
            0.09646076681806523, 0.01, 0.4798896504144996, 1.379008574103742, -3.290069515436081,
            2.324710524099774,
        ],
    ]  # fmt: skip
    error = [
        -0.00178001105222577714, -0.0008164344596567469, 0.007880878010261995,
        -0.1447110071732629, 0.5823571654525552, -0.45808210592918697, 1 / 66,
    ]  # fmt: skip
    a = np.array([row + [0.0] * (7 - len(row)) for row in rows])
    b = a[6, :6]
    line = np.append(b, 0.0)[:, None]
    return Tableau("Tsit5", a, b, a.sum(axis=1), (np.array(error),), line, 5, 4)


def method(name: str) -> Tableau:
    return tsit5() if name == "Tsit5" else tableau(name)


def _sum(weights: np.ndarray) -> str:
    return " + ".join(f"{w!r} * a[{j}][i]" for j, w in enumerate(weights.tolist()) if w) or "0.0"


def header(method: Tableau) -> str:
    """The sums of a method over the accelerations of its stages, as macros of the coordinate i."""
    s = method.stages
    a = method.a[: s + 1, : s + 1]
    squared = a @ a
    squared[np.abs(squared) < 1e-15] = 0.0
    lines = [
        f"#define STAGES {s}",
        f"#define ERROR_ORDER {method.error_order + 1.0!r}",
        f"#define TWO_ERRORS {len(method.errors) - 1}",
        "#define EACH_STAGE " + " ".join(f"STAGE({j})" for j in range(1, s + 1)),
        f"static const double C[] = {{{', '.join(map(repr, method.c[: s + 1].tolist()))}}};",
    ]
    for j in range(1, s + 1):
        lines.append(f"#define SUM_{j}(i) ({_sum(a[j])})")
        c = float(method.c[j])
        lines.append(f"#define MOVE_{j}(i) h * ({c!r} * y[M + i] + h * ({_sum(squared[j])}))")
    for n in range(2):
        e = method.errors[n] if n < len(method.errors) else np.zeros(s + 1)
        lines.append(f"#define ERROR_{n}(i) ({_sum(e)})")
        lines.append(f"#define ERROR_MOVE_{n}(i) ({_sum(e @ a)})")
    return "\n".join(lines) + "\n"


class _Options(ctypes.Structure):
    _fields_ = [
        *((n, ctypes.c_double) for n in ("rtol", "atol", "fallen", "rest_tolerance", "ratio")),
        *((n, ctypes.c_long) for n in ("max_impacts", "steps_per_segment")),
    ]


COUNTS = ("impacts", "steps", "landings", "crests", "refused")


@functools.cache
def _motion_type(n: int) -> type[ctypes.Structure]:
    class Motion(ctypes.Structure):
        _fields_ = [
            *((name, ctypes.c_double) for name in ("t", "peak", "side")),
            ("y", ctypes.c_double * n),
            *((name, ctypes.c_long) for name in COUNTS),
        ]

    return Motion


_IMPACT = np.dtype([("time", float), ("rate", float)])


@functools.cache
def library(model: str, name: str) -> ctypes.CDLL:
    return with_c.built(model, "best.h", header(method(name)), FLAGS)


def equations_differ(structure: rk.Structure, states: int = 50) -> float:
    """Largest difference of the equations in C from the derived ones, at random states.

    Of the accelerations while rocking on either side and with both feet down, and of those with
    which a side would open; relative to the largest of each.
    """
    c, module = library(structure.model, "Tsit5"), structure.module
    c.opens.restype = ctypes.c_double
    parameters, n = vector(structure), module.N_STATES // 2
    random = np.random.default_rng(7)
    worst = 0.0
    for mode, side in (("left", -1.0), ("both", 0.0), ("right", 1.0)):
        rows = []
        for _ in range(states):
            y, ground = random.uniform(-0.5, 0.5, 2 * n), random.uniform(-5.0, 5.0)
            closed = y.copy()
            closed[[module.ROTATION, module.ROTATION_RATE]] = 0.0
            if side == 0.0:
                y = closed
            else:
                y[module.ROTATION] = side * abs(y[module.ROTATION])

            def derived(
                state_at: np.ndarray, mode: str = mode, ground: float = ground
            ) -> list[float]:
                state = dict(zip(module.STATES, state_at.tolist(), strict=True))
                return list(structure.accelerations(state, ground, mode=mode).values())

            found = np.empty(n)
            c.accelerate(
                ctypes.c_int(module.MODES.index(mode)), at(y), at(parameters),
                ctypes.c_double(ground), at(found),
            )  # fmt: skip
            opens = c.opens(
                ctypes.c_double(side or 1.0), at(closed), at(parameters), ctypes.c_double(ground)
            )
            known = side * derived(closed)[module.ROTATION] if side else opens
            rows.append([[*found, opens], [*derived(y), known]])
        table = np.array(rows)
        size = np.abs(table).max(axis=(0, 1))
        apart = np.abs(table[:, 0] - table[:, 1]).max(axis=0)
        worst = max(worst, float((apart / np.where(size > 0.0, size, 1.0)).max()))
    return worst


@functools.cache
def _checked(structure: rk.Structure) -> None:
    """Raises RuntimeError where the equations in C are not those that were derived."""
    if (apart := equations_differ(structure)) > 1e-12:
        raise RuntimeError(
            f"{structure.model}: the equations in C are {apart:.1e} off the derived ones"
        )


class Problem(Prepared):
    """A case of rockeom's, prepared for C: the same numbers go to both.

    options : their method may be Tsit5, too.
    """

    def __init__(self, case: w.Case, options: Options) -> None:
        q = case.problem()
        self.y0, self.side, self.end = q.y0, float(q.mode - 1), q.end
        self.segments = np.ascontiguousarray(q.horizontal)
        self.parameters = vector(case.structure)
        _checked(case.structure)
        self.library = library(case.structure.model, options.method)
        self.options = _Options(
            options.rtol, 1e-2 * options.rtol, q.fallen, options.rest_tolerance, q.ratio,
            options.max_impacts, options.steps_per_segment,
        )  # fmt: skip
        self.motion_type = _motion_type(len(q.y0))
        self.room = np.empty(1 << 14, _IMPACT)

    def run(self) -> ctypes.Structure:
        """The motion at its end, with its counts; the impacts are in `room`."""
        motion = self.motion_type(side=self.side)
        motion.y[:] = self.y0.tolist()
        self.library.run(
            ctypes.byref(motion), ctypes.c_double(self.end), at(self.segments),
            ctypes.c_long(len(self.segments)), at(self.parameters), ctypes.byref(self.options),
            at(self.room), ctypes.c_long(len(self.room)),
        )  # fmt: skip
        return motion

    def impacts(self) -> w.Impacts:
        n = self.run().impacts
        if n > len(self.room):
            raise RuntimeError(f"{n} impacts, and room for {len(self.room)}")
        found = self.room[:n].copy()
        return w.Impacts(found["time"], found["rate"])

    def many(self, starts: np.ndarray, n: int) -> np.ndarray:
        """Impacts (m, n): the first n from each start (m, N), nan where there are fewer."""
        found = np.full((len(starts), n), np.nan, _IMPACT)
        self.library.many(
            ctypes.c_long(len(starts)), at(starts), ctypes.c_double(self.side),
            ctypes.c_double(self.end), at(self.segments), ctypes.c_long(len(self.segments)),
            at(self.parameters), ctypes.byref(self.options), at(found), ctypes.c_long(n),
        )  # fmt: skip
        return found


# -- the workloads -------------------------------------------------------------------------------


def decays(options: Options) -> Callable[[], w.Impacts]:
    """Of all releases in one call; the impacts of the last."""
    problem = Problem(w.decay(w.RELEASE), replace(options, max_impacts=w.N_IMPACTS - 1))
    starts = np.array([[release, 0.0] for release in w.RELEASES])

    def run() -> w.Impacts:
        found = problem.many(starts, w.N_IMPACTS)[-1]
        return w.Impacts(found["time"], found["rate"])

    return run


RUNS = with_c.runs(Problem, decays)
"""Workload -> options -> what runs it."""
