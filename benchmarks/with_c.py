"""The same method written by hand in C, built with the system's compiler into a temporary folder.

Raises RuntimeError where there is no compiler.
"""

import ctypes
import functools
import hashlib
import os
import shutil
import subprocess
import tempfile
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np

import rockeom as rk
from benchmarks import workloads as w
from rockeom.integrator.methods.tableau import (
    NODES,
    Tableau,
    bernstein_at,
    powers_to_bernstein,
    samples_to_bernstein,
    tableau,
)
from rockeom.simulation.options import SolverOptions

FOLDER = Path(__file__).parent / "c"

FLAGS = ("-O3", "-march=native", "-fno-math-errno", "-fno-trapping-math", "-fno-tree-vectorize")
"""What made the program fastest with its arithmetic intact, of -O2, -O3, with and without vectors,
AVX and contraction to a*b + c (which is gcc's default). The short loops of two and eight turns are
better unrolled: with vectors the same program takes 1.4 to 2.2 times as long."""

IMPACT, OVERTURNED, FULL = 0, 2, 7  # as in loop.h; the second in best.h, too

VARIANTS = {"C": (), "C, inlined sine": ("-DINLINE_SINE",)}


def _sum(weights: np.ndarray) -> str:
    return " + ".join(f"{w!r} * k[{j}][i]" for j, w in enumerate(weights.tolist()) if w)


def _matrix(name: str, values: np.ndarray) -> str:
    rows = ", ".join("{" + ", ".join(map(repr, row)) + "}" for row in values.tolist())
    return f"static const double {name}[{len(values)}][{len(values.T)}] = {{{rows}}};\n"


def header(method: Tableau) -> str:
    """The sums of a method as macros of the place i in the state."""
    lines = [f"#define SUM_{j}(i) ({_sum(row)})" for j, row in enumerate(method.a) if row.any()]
    lines += [f"#define C_{j} {c!r}" for j, c in enumerate(method.c.tolist())]
    lines += [
        f"#define ERROR_{n}(i) ({_sum(e)})" for n, e in zip((5, 3), method.errors, strict=True)
    ]
    lines += [f"#define DENSE_{j + 1}(i) ({_sum(row)})" for j, row in enumerate(method.dense.T)]
    nodes = ", ".join(map(repr, NODES.tolist()))
    return (
        "\n".join(lines)
        + f"\nstatic const double NODES[8] = {{{nodes}}};\n"
        + _matrix("SAMPLES_TO_BERNSTEIN", samples_to_bernstein())
        + _matrix("POWERS_TO_BERNSTEIN", powers_to_bernstein())
        + _matrix("QUINTIC", bernstein_at(NODES, 5))
        + _matrix("QUARTIC", bernstein_at(NODES, 4))
    )


def compiler() -> str:
    """The C compiler: $CC, gcc or cc; raises RuntimeError where there is none."""
    for name in (os.environ.get("CC"), "gcc", "cc"):
        if name and shutil.which(name):
            return name
    raise RuntimeError("no C compiler: install gcc, or name one in $CC")


@functools.cache
def library(model: str, variant: str, flags: tuple[str, ...] = FLAGS) -> ctypes.CDLL:
    """The shared library of a model by the program of loop.h."""
    return built(model, "loop.h", header(tableau("DOP853")), (*flags, *VARIANTS[variant]))


def built(model: str, program: str, method: str, flags: tuple[str, ...]) -> ctypes.CDLL:
    """A model's equations with a program, made where their text or flags are new.

    method : text of the header method.h, which the program includes.
    """
    texts = [path.read_text(encoding="utf-8") for path in sorted(FOLDER.iterdir())]
    command = [compiler(), *flags, f'-DPROGRAM="{program}"', "-shared", "-fPIC"]
    digest = hashlib.sha256("\0".join([method, *texts, *command]).encode()).hexdigest()[:16]
    folder = Path(tempfile.gettempdir()) / f"rockeom-benchmarks-{os.getuid()}" / digest
    library = folder / f"{model}.so"
    if not library.exists():
        folder.mkdir(parents=True, exist_ok=True)
        (folder / "method.h").write_text(method, encoding="utf-8")
        temporary = folder / f"{model}.{os.getpid()}.tmp"
        source = FOLDER / f"{model}.c"
        subprocess.run(
            [*command, f"-I{folder}", f"-I{FOLDER}", str(source), "-o", str(temporary), "-lm"],
            check=True,
        )
        temporary.replace(library)
    return ctypes.CDLL(str(library))


class _Options(ctypes.Structure):
    _fields_ = [
        *((n, ctypes.c_double) for n in ("rtol", "atol", "fallen", "rest_tolerance", "ratio")),
        *((n, ctypes.c_long) for n in ("max_impacts", "max_steps")),
    ]


@functools.cache
def _state_type(n: int) -> type[ctypes.Structure]:
    class State(ctypes.Structure):
        _fields_ = [
            *((name, ctypes.c_double) for name in ("t", "h_next", "peak")),
            ("y", ctypes.c_double * n),
            *(
                (name, ctypes.c_long)
                for name in ("mode", "closed", "impacts", "taken", "accepted", "n_events")
            ),
        ]

    return State


def at(array: np.ndarray) -> ctypes.c_void_p:
    return ctypes.c_void_p(array.ctypes.data)


def vector(structure: rk.Structure) -> np.ndarray:
    """The parameters in the order of the generated module, as the programs in C take them."""
    values = structure.parameters()
    return np.array([float(values[name]) for name in structure.module.PARAMETERS])


class Prepared:
    """A structure with its options, for a program in C."""

    library: ctypes.CDLL
    end: float
    parameters: np.ndarray
    options: ctypes.Structure

    def map(self, motions: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """(whether it fell (n,), peaks (n,)) under motions (n, m, 7), from rest."""
        n, m, _ = motions.shape
        outcomes, peaks = np.empty(n, np.int64), np.empty(n)
        self.library.map(
            ctypes.c_long(n), ctypes.c_double(self.end), at(motions), ctypes.c_long(m),
            at(self.parameters), ctypes.byref(self.options), at(outcomes), at(peaks),
        )  # fmt: skip
        return outcomes == OVERTURNED, peaks


class Problem(Prepared):
    """A case of rockeom's, prepared for C: the same numbers go to both."""

    def __init__(
        self,
        case: w.Case,
        options: SolverOptions,
        variant: str = "C",
        flags: tuple[str, ...] = FLAGS,
    ) -> None:
        module, q = case.structure.module, case.problem()
        self.rate_at = module.ROTATION_RATE
        self.y0, self.mode, self.end = q.y0, q.mode, q.end
        self.segments = np.ascontiguousarray(q.horizontal)
        self.parameters = vector(case.structure)
        self.library = library(case.structure.model, variant, flags)
        self.options = _Options(
            options.rtol, options.atol, q.fallen, options.rest_tolerance, q.ratio,
            options.max_impacts, options.max_steps,
        )  # fmt: skip
        n = module.N_STATES
        self.state_type = _state_type(n)
        self.event = np.dtype(
            [
                ("time", float),
                *((name, np.int64) for name in ("kind", "before", "after")),
                ("from", float, (n,)),
                ("to", float, (n,)),
            ]
        )

    def run(self) -> tuple[int, np.ndarray, np.ndarray, int]:
        """(outcome, state at the end (N,), events, steps)."""
        state = self.state_type(mode=self.mode, closed=-1)
        state.y[:] = self.y0.tolist()
        chunks = []
        outcome = FULL
        while outcome == FULL:
            events = np.empty(256, self.event)
            state.n_events = 0
            outcome = self.library.run(
                ctypes.byref(state), ctypes.c_double(self.end), at(self.segments),
                ctypes.c_long(len(self.segments)), at(self.parameters),
                ctypes.byref(self.options), at(events), ctypes.c_long(len(events)),
            )  # fmt: skip
            chunks.append(events[: state.n_events])
        events = np.concatenate(chunks) if len(chunks) > 1 else chunks[0]
        return outcome, np.array(state.y[:]), events, state.accepted

    def impacts(self) -> w.Impacts:
        events = self.run()[2]
        events = events[events["kind"] == IMPACT]
        return w.Impacts(events["time"], events["from"][:, self.rate_at])

    def many(self, starts: np.ndarray, n: int) -> np.ndarray:
        """Times (m, n) of the first n impacts from each start (m, N), nan where there are fewer."""
        times = np.full((len(starts), n), np.nan)
        self.library.many(
            ctypes.c_long(len(starts)), at(starts), ctypes.c_long(self.mode),
            ctypes.c_double(self.end), at(self.segments), ctypes.c_long(len(self.segments)),
            at(self.parameters), ctypes.byref(self.options), at(times), ctypes.c_long(n),
        )  # fmt: skip
        return times


# -- the workloads -------------------------------------------------------------------------------


def free_decay(options: SolverOptions, variant: str = "C") -> Callable[[], w.Impacts]:
    options = replace(options, max_impacts=w.N_IMPACTS - 1)
    return Problem(w.decay(w.RELEASE), options, variant).impacts


def decays(options: SolverOptions, variant: str = "C") -> Callable[[], w.Impacts]:
    """Of all releases in one call; the impacts of the last."""
    options = replace(options, max_impacts=w.N_IMPACTS - 1)
    problem = Problem(w.decay(w.RELEASE), options, variant)
    starts = np.array([[release, 0.0] for release in w.RELEASES])

    def run() -> w.Impacts:
        times = problem.many(starts, w.N_IMPACTS)[-1]
        return w.Impacts(times, np.full(len(times), np.nan))

    return run


def runs(problem: Callable, decays: Callable) -> dict[str, Callable]:
    """Workload -> what a problem takes besides its case -> what runs it."""

    def under_record(structure: rk.Structure) -> Callable:
        return lambda *how: problem(w.shaken(structure), *how).impacts

    def pulses(*how, stride: int = 1) -> Callable:
        motions = w.pulses(stride)
        prepared = problem(w.Case(w.BLOCK, motions[0]), *how)
        table = np.array([motion.segments for motion in motions])
        return lambda: prepared.map(table)

    def bifurcation(*how, amplitudes=w.AMPLITUDES) -> Callable:
        prepared = {float(a): problem(w.driven(a), *how) for a in amplitudes}
        return lambda: {a: w.kept(each.impacts()) for a, each in prepared.items()}

    return {
        "W1": decays,
        "W2": under_record(w.BLOCK),
        "W3": under_record(w.COLUMN),
        "W4": pulses,
        "W5": bifurcation,
    }


RUNS = runs(Problem, decays)
"""Workload -> (options, variant) -> what runs it."""
