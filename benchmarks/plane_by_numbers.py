"""Planar contacts on numeric modes, as a trial: the same declarations, lifted into space.

A planar model gets one coordinate across the plane, and becomes a structure in space, whose modes
are solved as numbers. Its motions are those of the plane, event by event, so that operations, times
and sizes stand side by side. Rows across the plane are the trial's own: numeric modes of a plane
would have two rows a point for three.
"""

import math
import os
import tempfile
import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, replace
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import sympy as sp
from sympy.core.cache import clear_cache

import rockeom as rk
from benchmarks import report, timing
from rockeom.codegen import module_text
from rockeom.generated import numeric_modes
from rockeom.integrator.program import program
from rockeom.integrator.schema import ground_axes
from rockeom.integrator.texts import source
from rockeom.symbolic import Model, coordinate, derive, space
from rockeom.symbolic.contacts import Contact
from rockeom.symbolic.model import Body
from rockeom.symbolic.parts.supports import RESTITUTION
from tests.form import ROOT, code_lines, lines_of

RECORD = rk.GroundMotion.from_library("El Centro 1940 180")
MOST = 100  # numbers that a function writes


@dataclass(frozen=True)
class Trial:
    """A planar structure, its motion, and the body that stands on another one, if any does."""

    name: str
    structure: rk.Structure
    motion: rk.GroundMotion = RECORD
    upper: str = ""


TRIALS = (
    Trial(
        "`SlidingBlock`, rocks",
        rk.SlidingBlock.from_dimensions(width=0.5, height=3.0, friction=0.4, restitution=0.0),
    ),
    Trial(
        "`SlidingBlock`, slides",
        rk.SlidingBlock.from_dimensions(width=1.5, height=3.0, friction=0.2, restitution=0.0),
    ),
    Trial(
        "`FlexibleStructure`, sliding feet",
        rk.FlexibleStructure(
            mass=122.6, height=1.05, inertia=44.8, base_mass=45.6, base_height=0.1,
            base_inertia=1.37, half_width=0.285, stiffness=571.8e3, damping=502.4,
            support=rk.Sliding(friction=0.4, restitution=0.0),
        ),
    ),
    Trial(
        "`StackedBlocks`, sliding feet",
        rk.StackedBlocks(
            lower=rk.RigidBlock(half_width=0.3, half_height=0.4, mass=500.0),
            upper=rk.RigidBlock(half_width=0.12, half_height=0.7, mass=300.0),
            support=rk.Sliding(friction=0.8, restitution=0.0),
        ),
        upper="upper",
    ),
)  # fmt: skip


def lifted(of: Model, upper: str) -> Model:
    """A planar model in space, with a coordinate across the plane of what stands on the ground.

    It has no restitution, which with friction Newton's law refuses in space.

    upper : the body that has one of its own, and the first part of the names of its points.
    """
    names = ("base", upper) if upper else ("base",)
    across = {
        name: coordinate(f"w_{i}", f"across_{name}", "m", "place across the plane")
        for i, name in enumerate(names)
    }

    def place(name: str) -> sp.Expr:
        return across.get(name, across["base"]).position

    bodies = [
        Body(
            b.name, b.mass, (b.position[0], place(b.name), b.position[1]),
            sp.eye(3) * b.inertia, space.about("y", b.rotation),
        )
        for b in of.bodies
    ]  # fmt: skip
    contacts = []
    for c in of.contacts:
        gap, slip = c.at(c.side)
        stands_on_other = bool(upper) and c.name.startswith(upper)
        aside = place(upper) - place("base") if stands_on_other else place("base")
        law = replace(c.law, restitution=sp.S.Zero)
        contacts.append(Contact(c.name, gap, (slip, aside), law))
    return Model(
        name=f"{of.name}_by_numbers",
        title=f"{of.title}, by numeric modes",
        parameters=tuple(p for p in of.parameters if p != RESTITUTION),
        coordinates=(*of.coordinates, *across.values()),
        bodies=bodies,
        gravity=of.gravity,
        rotation=of.rotation,
        contacts=contacts,
        elements=of.elements,
        elastic_energy=of.elastic_energy,
        dissipation=of.dissipation,
        overturning=of.overturning,
        falls=of.falls,
    )


def numeric(trial: Trial) -> rk.Structure:
    """The structure of a trial on numeric modes."""
    model = lifted(derive(trial.structure), trial.upper)
    values = trial.structure.parameters()
    return rk.structure(model, **{p.name: float(values[p.name]) for p in model.parameters})


# -- operations ----------------------------------------------------------------------------------


class Counted(float):
    """A number that counts the operations of which it is a part."""

    count = 0


def _counting(name: str):
    operation = getattr(float, name)

    def counted(self, *others):
        result = operation(self, *map(float, others))
        Counted.count += 1
        return Counted(result)

    return counted


for _name in ("add", "sub", "mul", "truediv", "pow"):
    setattr(Counted, f"__{_name}__", _counting(f"__{_name}__"))
    setattr(Counted, f"__r{_name}__", _counting(f"__r{_name}__"))
Counted.__neg__ = lambda self: Counted(-float(self))  # type: ignore[method-assign]
Counted.__abs__ = lambda self: Counted(abs(float(self)))  # type: ignore[method-assign]


def _function(name: str):
    def counted(*numbers):
        Counted.count += 1
        return Counted(getattr(math, name)(*map(float, numbers)))

    return counted


def counted_module(module: Any) -> dict[str, Any]:
    """The functions of a generated module on lists of numbers that count their operations."""
    lists = {
        "np": SimpleNamespace(
            empty=lambda n, *_: [0.0] * n, zeros=lambda n, *_: [0.0] * n, int64=int, inf=math.inf,
            nan=math.nan, array=np.array,
        ),
        "math": SimpleNamespace(
            **{name: _function(name) for name in ("sqrt", "sin", "cos", "atan2")}, pi=math.pi
        ),
    }  # fmt: skip
    solver: dict[str, Any] = {"__name__": "solver"}
    exec(compile(source(numeric_modes), "numeric modes", "exec"), solver)
    solver |= lists
    functions: dict[str, Any] = {"__name__": module.__name__}
    exec(compile(source(module), module.__name__, "exec"), functions)
    functions |= lists
    functions |= {name: solver[name] for name in functions.keys() & solver.keys() - {"__name__"}}
    functions["sine_cosine"] = lambda x: (_function("sin")(x), _function("cos")(x))
    return functions


def operations(trial: Trial, structure: rk.Structure) -> dict[str, int]:
    """The most operations in any mode of a motion, of its rates and guards.

    And of the free motion with the rows of points, the part of both that is written out.
    """
    module = structure.module
    functions = counted_module(module)
    run = rk.simulate(structure, trial.motion)
    p = [Counted(x) for x in structure.vector]
    modes = run.mode.astype(str)
    most = dict.fromkeys(("rates", "guards", "written"), 0)
    for name in np.unique(modes):
        rows = np.flatnonzero(modes == name)
        i, mode = rows[len(rows) // 2], module.MODES.index(name)
        y = [Counted(run[state][i]) for state in module.STATES]
        ground = [Counted(0.0) for _ in ground_axes(module)]
        ground[0] = Counted(trial.motion.acceleration(run.t[i]))

        def count(function: str, *arguments: Any) -> int:
            Counted.count = 0
            functions[function](*arguments)
            return Counted.count

        out = [[0.0] * MOST for _ in range(4)]
        counts = {
            "rates": count("rates", mode, y, p, *ground, out[0]),
            "guards": count("guards", mode, y, p, *ground, out[1]),
            "written": count("free_motion", y, p, *ground, mode, out[2], out[3])
            + count("points", y, p, [0.0] * MOST**2),
        }
        most = {what: max(number, counts[what]) for what, number in most.items()}
    return most


# -- times and sizes -----------------------------------------------------------------------------


@contextmanager
def _empty_cache() -> Iterator[Path]:
    before = os.environ.get("ROCKEOM_CACHE_DIR")
    with tempfile.TemporaryDirectory() as folder:
        os.environ["ROCKEOM_CACHE_DIR"] = folder
        try:
            yield Path(folder)
        finally:
            del os.environ["ROCKEOM_CACHE_DIR"]
            if before is not None:
                os.environ["ROCKEOM_CACHE_DIR"] = before


def _lap(work) -> tuple[float, Any]:
    started = time.process_time()
    result = work()
    return time.process_time() - started, result


def sizes(model: Model, structure: rk.Structure) -> dict[str, float]:
    """What a module costs before its first motion."""
    clear_cache()
    fresh = replace(model)  # without what was derived of it before
    with _empty_cache() as folder:
        derivation, text = _lap(lambda: module_text(fresh))
        compilation, _ = _lap(lambda: program(structure.module, "DOP853"))
        code = sum(f.stat().st_size for f in folder.glob("*dop853*.compiled"))
    return {
        "derivation": derivation,
        "lines": code_lines(text),
        "compilation": compilation,
        "code": code,
    }


def measured() -> dict:
    """A row for each trial, its numbers of derived and of numeric modes; and lines of files."""
    rows, seen = [], set()
    for trial in TRIALS:
        model = derive(trial.structure)
        lift = lifted(model, trial.upper)
        ways = {"derived": (model, trial.structure), "numeric": (lift, numeric(trial))}
        by: dict[str, dict] = {way: {} for way in ways}
        if model.name not in seen:  # a program is compiled once in a process
            by = {way: sizes(*of) for way, of in ways.items()}
        seen.add(model.name)
        runs = {
            way: lambda of=structure, motion=trial.motion: rk.simulate(of, motion)
            for way, (_, structure) in ways.items()
        }
        times = timing.in_turns(runs, 5)
        for way, (_, structure) in ways.items():
            response = runs[way]()
            by[way]["operations"] = operations(trial, structure)
            by[way]["seconds"] = times[way].fastest
            by[way]["events"] = len(response.events)
            by[way]["slip"] = float(response.extremes("x").maximum)
        rows.append({"name": trial.name, "modes": len(trial.structure.module.MODES), **by})
    lines = {name: lines_of(ROOT / "rockeom" / name) for name in (*GO, *STAY)}
    return {"trials": rows, "lines": lines}


# -- the page ------------------------------------------------------------------------------------

GO = (
    "codegen/searched.py", "symbolic/modes/every.py", "symbolic/modes/kinematics.py",
    "symbolic/modes/closed.py", "symbolic/modes/impact.py", "symbolic/modes/start.py",
    "symbolic/modes/derived.py", "symbolic/beds.py", "integrator/transitions/points_in_plane.py",
)  # fmt: skip
"""Files that only the planar search among derived modes needs."""

STAY = (
    "integrator/transitions/table.py", "integrator/transitions/modes_by_table.py",
    "integrator/transitions/declared.py",
)  # fmt: skip
"""Files that pinned rocking structures need, whose modes are declared."""


def table(found: Mapping) -> str:
    """The section of the page."""
    rows = found["trials"]
    head = ("structure", "modes", "events", *EVERY, "ratio", *ONCE)
    body = [
        (
            row["name"], str(row["modes"]), str(row["derived"]["events"]),
            *(_both(row, *figure) for figure in EVERY.values()),
            report.times(row["numeric"]["seconds"] / row["derived"]["seconds"]),
            *(_both(row, *f) if "code" in row["derived"] else "" for f in ONCE.values()),
        )
        for row in rows
    ]  # fmt: skip
    return "\n\n".join(
        [
            INTRODUCTION,
            report.table(head, body),
            same(rows),
            _left_out(rows),
            _files(found["lines"]),
        ]
    )


def _both(row: Mapping, value: Callable[[Mapping], float], show: Callable[[float], str]) -> str:
    return f"{show(value(row['derived']))} / {show(value(row['numeric']))}"


def same(rows: Sequence[dict]) -> str:
    """How far the motions of both are apart."""
    events = all(row["derived"]["events"] == row["numeric"]["events"] for row in rows)
    slips = [(row["derived"]["slip"], row["numeric"]["slip"]) for row in rows]
    apart = max((abs(b / a - 1.0) for a, b in slips if a > 1e-6), default=0.0)
    said = "the same number of" if events else "other numbers of"
    return (
        f"Both ways have {said} events; their largest slips differ by {apart:.0e} of themselves, "
        "since slips of numeric modes begin with a velocity of 1e-8 m/s."
    )


def _left_out(rows: Sequence[dict]) -> str:
    first = [row["numeric"]["operations"]["written"] for row in rows if "code" in row["numeric"]]
    return LEFT_OUT.format(written=", ".join(map(str, first)))


def _files(sizes: Mapping[str, int]) -> str:
    gone = ", ".join(f"`{name}` {sizes[name]}" for name in GO)
    stay = ", ".join(f"`{name}` {sizes[name]}" for name in STAY)
    return (
        f"Files that would go, with their lines of code: {gone}; "
        f"{sum(sizes[name] for name in GO):,} together. Those of tables stay, since pinned "
        f"structures have declared modes: {stay}."
    )


def _whole(x: float) -> str:
    return f"{x:,.0f}"


Figure = tuple[Callable[[Mapping], float], Callable[[float], str]]
EVERY: dict[str, Figure] = {
    "operations of `rates`": (lambda way: way["operations"]["rates"], _whole),
    "operations of `guards`": (lambda way: way["operations"]["guards"], _whole),
    "motion": (lambda way: way["seconds"], report.seconds),
}
ONCE: dict[str, Figure] = {
    "derivation": (lambda way: way["derivation"], report.seconds),
    "compilation": (lambda way: way["compilation"], report.seconds),
    "machine code": (lambda way: way["code"], lambda x: f"{x / 1024:.0f} KiB"),
    "lines of the module": (lambda way: way["lines"], _whole),
}
"""Figures of each row, and those of a structure, which its first row has."""

INTRODUCTION = """\
### Planar contacts on numeric modes, a trial

The forces of `SlidingBlock` and its like may be solved as numbers, too, as in space. This trial
tells what that would cost and gain: the same declarations, lifted into space by a coordinate
across the plane for what stands on the ground, and one for what stands on that, under El Centro
180 at the default tolerance. In each pair of figures the first is that of derived modes, as they
are, the second that of numeric ones. Operations are those of the mode of the motion that takes
most, counted as they are done, without those on the digits of modes. Derivation is that of the
module's text, SymPy loaded."""

LEFT_OUT = """\
The trial has three rows a point, of which modes of a plane would have two, and one or two
coordinates more. Free motion and rows of points take {written} of its operations, by structure;
the others solve for forces. It has no states of elements (beds of springs, ties) and Newton's
impact law alone. Derived modes are also what pages show, `model.mode(...)` returns, and notebooks
compare with the literature."""
