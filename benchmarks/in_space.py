"""Bodies in space: speed, size, other programs, and planar contacts on numeric modes.

    python -m benchmarks.in_space [PART ...] --write docs/benchmarks.md

Measures the parts that are named, all if none is, and takes the others from in_space.json beside
this file; --write puts the tables into a page between its marks, and the figures into that file.
The part "engines" takes many minutes, and needs MuJoCo and Drake.
"""

import argparse
import importlib.metadata
import importlib.util
import json
import os
import subprocess
import sys
import tempfile
import textwrap
from collections.abc import Callable, Mapping, Sequence
from functools import partial
from pathlib import Path

import numpy as np

import rockeom as rk
from benchmarks import plane_by_numbers, report, timing
from benchmarks.engines.prism import FALLEN, PROGRAMS, Shaken
from benchmarks.with_rockeom import steps
from rockeom.simulation.case import Case

STORED = Path(__file__).with_suffix(".json")
START, END = "<!-- tables of space -->", "<!-- end of space -->"

ALONG, ACROSS, UP = (
    rk.GroundMotion.from_library(f"El Centro 1940 {way}") for way in ("180", "270", "up")
)
PRISM = rk.Prism(width=0.5, depth=0.7, height=3.0, mass=2000.0)
BLOCK = rk.RigidBlock.from_dimensions(width=0.5, height=3.0, mass=2000.0)
DEFAULT = rk.SolverOptions(method="DOP853")
TIGHT = rk.SolverOptions(method="DOP853", rtol=1e-12, atol=1e-14)
BY_METHOD = (rk.SolverOptions(method="RK45"), DEFAULT)
RATIO_GOAL, EARLY, FACTOR = 40, 3.0, 1.5  # s: the motion before EARLY is not sensitive yet
STEPS = (1e-3, 1e-4, 1e-5)
ENOUGH = 1e-3  # relative error
MOTIONS, MANY = 200, 10_000


def prism(factor: float = 1.0, options: rk.SolverOptions = DEFAULT, structure=PRISM):
    """Response of the prism to the record."""
    return rk.simulate(
        structure, factor * ALONG, transverse=factor * ACROSS, vertical=factor * UP, options=options
    )


def block(options: rk.SolverOptions = DEFAULT):
    """Response of the planar block to the record's first and vertical component."""
    return rk.simulate(BLOCK, ALONG, vertical=UP, options=options)


# -- what is measured ----------------------------------------------------------------------------


def speed() -> dict:
    """The prism beside the planar block, in turns."""
    measured = timing.in_turns({"prism": prism, "block": block}, 7)
    seconds = {name: times.fastest for name, times in measured.items()}
    cases = {
        "prism": Case(PRISM, ALONG, transverse=ACROSS, vertical=UP),
        "block": Case(BLOCK, ALONG, vertical=UP),
    }
    tilt, tight = (prism(options=o).extremes("tilt").maximum for o in (DEFAULT, TIGHT))
    return {
        "seconds": seconds,
        "ratio": seconds["prism"] / seconds["block"],
        "steps": {name: steps(case, DEFAULT) for name, case in cases.items()},
        "impacts": {"prism": len(prism().impacts), "block": len(block().impacts)},
        "peak": tight,
        "error": abs(tilt / tight - 1.0),
        "planar peak": _peak_of_block(),
    }


def _peak_of_block() -> float:
    found = block(TIGHT).extremes("theta")
    return max(found.maximum, -found.minimum)


_PROCESS = """
import time
started = time.process_time()
import json
from pathlib import Path
import rockeom as rk
from rockeom.integrator.program import program
taken = {{"import": time.process_time() - started}}
def lap(name, work):
    started = time.process_time()
    result = work()
    taken[name] = time.process_time() - started
    return result
structure = {structure}
module = lap("derivation", lambda: structure.module)
lap("compilation", lambda: program(module, "DOP853"))
x, y, z = (rk.GroundMotion.from_library(f"El Centro 1940 {{way}}") for way in ("180", "270", "up"))
lap("motion", lambda: rk.simulate(structure, x, {transverse}vertical=z))
status = Path("/proc/self/status").read_text()  # of Linux; else none is told
taken["memory"] = int(status.split("VmHWM:")[1].split()[0]) / 1024  # MiB
print(json.dumps(taken))
"""


def first_call() -> dict:
    """New processes with an empty and with a filled cache: seconds, memory, size of the code."""
    texts = {
        "prism": ("rk.Prism(width=0.5, depth=0.7, height=3.0, mass=2000.0)", "transverse=y, "),
        "block": ("rk.RigidBlock.from_dimensions(width=0.5, height=3.0, mass=2000.0)", ""),
    }
    found = {}
    for name, (structure, transverse) in texts.items():
        text = _PROCESS.format(structure=structure, transverse=transverse)
        firsts, laters = [], []
        for _ in range(3):
            with tempfile.TemporaryDirectory() as folder:
                firsts.append(_new_process(text, folder))
                laters.append(_new_process(text, folder))
                files = Path(folder).glob("*.compiled")
                size = sum(f.stat().st_size for f in files if "_module_" not in f.name)
        found[name] = {"first": _fastest_of(firsts), "later": _fastest_of(laters), "code": size}
    return found


def _fastest_of(processes: Sequence[Mapping[str, float]]) -> dict[str, float]:
    """The least of each figure: what other work on the machine has delayed least."""
    return {key: min(each[key] for each in processes) for key in processes[0]}


def _new_process(text: str, folder: str) -> dict[str, float]:
    environment = os.environ | {"ROCKEOM_CACHE_DIR": folder}
    done = subprocess.run(
        [sys.executable, "-c", text], env=environment, check=True, capture_output=True, text=True
    )
    return json.loads(done.stdout)


def many() -> dict:
    """The prism under the record from many azimuths, on two threads, by both explicit methods."""
    case = Case(PRISM, rk.Recording("El Centro", (ALONG, ACROSS), UP))
    over = {"azimuth_degrees": np.linspace(0.0, 360.0, MOTIONS, endpoint=False)}
    how = rk.SweepOptions(threads=2, progress=False)

    def swept(options: rk.SolverOptions):
        return rk.simulate_many(case, over, options=options, sweep_options=how)

    sweeps = {options.method: partial(swept, options) for options in BY_METHOD}
    measured = timing.in_turns(sweeps, 3)
    ends = {name: sweep()["outcome"].to_numpy() for name, sweep in sweeps.items()}
    tight = swept(TIGHT)["outcome"].to_numpy()
    return {
        "seconds": {name: times.fastest for name, times in measured.items()},
        "outcomes": {str(end): int((tight == end).sum()) for end in np.unique(tight)},
        "same": {name: int((outcomes == tight).sum()) for name, outcomes in ends.items()},
        "load": report.load(),
    }


def engines() -> dict:
    """Peaks of the tilt by other programs at some steps, and when the stronger motion falls."""
    found: dict = {"versions": {}, "missing": {}, "rows": [], "ours": {}}
    t = np.linspace(0.0, EARLY, 30_001)
    states = prism(options=TIGHT).at(t)
    found["ours"]["early"] = float(
        np.arccos(np.cos(states["pitch"]) * np.cos(states["roll"])).max()
    )
    taller = rk.Prism(width=0.5, depth=0.7, height=3.0 * (1 + 1e-6), mass=2000.0)
    changed, peak = (
        prism(options=TIGHT, structure=s).extremes("tilt").maximum for s in (taller, PRISM)
    )
    found["ours"] |= {"peak": peak, "sensitivity": abs(changed / peak - 1.0)}
    found["ours"]["falls"] = [float(prism(FACTOR, o).t[-1]) for o in (DEFAULT, TIGHT)]
    for name, (package, distribution, run) in PROGRAMS.items():
        if importlib.util.find_spec(package) is None:
            found["missing"][name] = f"pip install {distribution}"
            continue
        found["versions"][name] = importlib.metadata.version(distribution)
        for step in STEPS:
            t, tilt, seconds = run(_shaken(1.0), step)
            row = {"program": name, "step": step, "seconds": seconds, "peak": float(tilt.max())}
            row["early"] = float(tilt[t <= EARLY].max())
            strong = 9.0 if step < 1e-4 else ALONG.duration
            t, tilt, _ = run(_shaken(FACTOR, strong), step)
            fell = tilt > FALLEN
            row["falls"] = float(t[fell.argmax()]) if fell.any() else None
            row["until"] = strong
            print(row, file=sys.stderr)
            found["rows"].append(row)
    return found


def _shaken(factor: float, duration: float = ALONG.duration) -> Shaken:
    def ground(t: np.ndarray) -> np.ndarray:
        return factor * np.column_stack([m.acceleration(t) for m in (ALONG, ACROSS, UP)])

    sizes = PRISM.width / 2, PRISM.depth / 2, PRISM.height / 2
    return Shaken(sizes, PRISM.mass, PRISM.gravity, ground, ALONG.dt, duration)


PARTS: Mapping[str, Callable[[], object]] = {
    "speed": speed,
    "first": first_call,
    "many": many,
    "engines": engines,
    "planar": plane_by_numbers.measured,
}


# -- the page ------------------------------------------------------------------------------------


def of_speed(found: Mapping) -> str:
    at = found["speed"]
    head = ("", "seconds of the processor", "steps", "impacts", "peak of the tilt [rad]")
    peaks = {"prism": at["peak"], "block": at["planar peak"]}
    rows = [
        (
            name, report.seconds(at["seconds"][key]), f"{at['steps'][key]:,}",
            str(at["impacts"][key]), f"{peaks[key]:.10f}",
        )
        for key, name in (("prism", "`Prism`, 180, 270, up"), ("block", "`RigidBlock`, 180, up"))
    ]  # fmt: skip
    return "\n\n".join(
        [
            SPEED,
            report.table(head, rows),
            f"The prism takes **{at['ratio']:.0f} times** as long as the block (goal "
            f"{RATIO_GOAL}). It rocks on the edges along y throughout, so that both peaks are one; "
            f"at the default tolerance that of the prism is off by {at['error']:.0e} of itself.",
        ]
    )


def of_first_calls(found: Mapping) -> str:
    at = found["first"]
    head = ("a new process", "", "`Prism`", "goal", "`RigidBlock`")

    def row(what: str, when: str, goal: str, value: Callable[[Mapping], str]):
        return (what, when, value(at["prism"]), goal, value(at["block"]))

    def lap(when: str, name: str) -> Callable[[Mapping], str]:
        return lambda of: report.seconds(of[when][name])

    rows = [
        row("derivation", "with SymPy's import", "10 s", lap("first", "derivation")),
        row("compilation", "", "3 s", lap("first", "compilation")),
        row("import", "kept code", "", lap("later", "import")),
        row("module", "kept code", "", lap("later", "derivation")),
        row("program", "kept code", "", lap("later", "compilation")),
        row("memory, at most", "first", "", lambda of: f"{of['first']['memory']:.0f} MiB"),
        row("memory, at most", "kept code", "", lambda of: f"{of['later']['memory']:.0f} MiB"),
        row("machine code", "", "", lambda of: f"{of['code'] / 1024:.0f} KiB"),
    ]
    return "\n\n".join([FIRST, report.table(head, rows), _of_many(found["many"])])


def _of_many(at: Mapping) -> str:
    """Sentences about many motions."""
    outcomes = ", ".join(f"{n} {name}" for name, n in at["outcomes"].items())
    by_method = (
        f"{seconds / MOTIONS * MANY / 2 / 60:.2f} minutes by {name} "
        f"({report.seconds(seconds / MOTIONS)} of the processor each; {at['same'][name]} outcomes "
        f"of {MOTIONS} are those at rtol {TIGHT.rtol:.0e})"
        for name, seconds in at["seconds"].items()
    )
    return (
        f"{MANY:,} motions of the prism (the record from {MANY:,} azimuths, `rk.simulate_many` on "
        f"two threads, default tolerances) would take on two cores {', and '.join(by_method)}; the "
        f"goal is 3. Measured by {MOTIONS} of them, {outcomes}; {at['load']}. Steps end at the "
        "samples of the record, so that the lower order needs hardly more of them."
    )


def of_engines(found: Mapping) -> str:
    at, ours = found["engines"], found["engines"]["ours"]
    seconds = found["speed"]["seconds"]["prism"]
    head = (
        "program", "step", f"error, peak of the first {EARLY:g} s", "error, peak of all",
        "time", "of rockeom's", f"times {FACTOR:g} falls at",
    )  # fmt: skip
    fell, tight = ours["falls"]
    rows = [
        (
            "rockeom", f"rtol {DEFAULT.rtol:.0e}", "", report.scientific(found["speed"]["error"]),
            report.seconds(seconds), "1", f"{fell:.6f} s",
        )
    ]  # fmt: skip
    for row in at["rows"]:
        when = f"{row['falls']:.2f} s" if row["falls"] else f"not before {row['until']:g} s"
        errors = (abs(row[key] / ours[key] - 1.0) for key in ("early", "peak"))
        rows.append(
            (
                row["program"], f"{row['step']:.0e} s", *map(report.scientific, errors),
                report.seconds(row["seconds"]), report.times(row["seconds"] / seconds), when,
            )
        )  # fmt: skip
    versions = ", ".join(f"{name} {version}" for name, version in at["versions"].items())
    missing = [f"{name} is not installed: {how}." for name, how in at["missing"].items()]
    return "\n\n".join(
        [
            f"{ENGINES} ({versions}.)",
            report.table(head, rows),
            f"The peak of the whole motion, {ours['peak']:.6f} rad, is sensitive: a height changed "
            f"by 1e-6 of itself changes it by {ours['sensitivity']:.0e}; the peak of the first "
            f"{EARLY:g} s, {ours['early']:.6f} rad, is not. {_fastest(at, seconds, 'peak')} "
            f"{_fastest(at, seconds, 'early')} Times {FACTOR:g}, rockeom falls at {fell:.9f} s, "
            f"and at rtol 1e-12 at {tight:.9f} s.",
            *missing,
        ]
    )


def _fastest(at: Mapping, seconds: float, peak: str) -> str:
    """The largest step of a program that meets the error asked for in a peak."""
    which = {"peak": "the whole", "early": f"the first {EARLY:g} s"}[peak]
    met = [r for r in at["rows"] if abs(r[peak] / at["ours"][peak] - 1.0) <= ENOUGH]
    if not met:
        return f"No program meets {ENOUGH:g} in the peak of {which} at any of these steps."
    best = min(met, key=lambda row: row["seconds"])
    return (
        f"The fastest to meet {ENOUGH:g} in the peak of {which} is {best['program']} at "
        f"{best['step']:.0e} s, in {report.times(best['seconds'] / seconds)} times the time of "
        "rockeom."
    )


def whole(found: Mapping) -> str:
    """The text between the marks of the page."""
    named = ", ".join(f"{key} {value}" for key, value in found["machine"].items())
    parts = [f"{INTRODUCTION} Measured on: {named}."]
    parts += [of_speed(found), of_first_calls(found), of_engines(found)]
    parts.append(plane_by_numbers.table(found["planar"]))
    paragraphs = "\n\n".join(parts).split("\n\n")
    return "\n\n".join(p if p[0] in "|#" else filled(p) for p in paragraphs)


filled = partial(textwrap.fill, width=100, break_long_words=False, break_on_hyphens=False)


INTRODUCTION = """\
Written by `python -m benchmarks.in_space --write docs/benchmarks.md`. The prism has the half sizes
b, c, h = 0.25, 0.35, 1.5 m, and feet that never slip; the record is El Centro 1940, its components
180, 270 and up, 53.7 s. Times are those of the processor, the fastest of some turns, side by side
in one process: the machine was busy with other work, too."""

SPEED = """\
The prism and the planar block of the same width and height, both by DOP853 at the default
tolerance, by `rk.simulate`:"""

FIRST = """\
In a process with an empty cache, and in later ones, seconds of the processor, the fastest of three;
the memory is the most that a process held, which then simulates the record:"""

ENGINES = """\
The same prism by programs that step through contacts, with equal steps, as on
[reference motions](reference-cases.md): contacts as stiff as the step allows, friction 2. The
program itself goes from step to step, without Python between them. Errors are relative, against
rockeom at rtol 1e-12, times those of the whole motion, on the same machine as rockeom's, but in
busier hours: read them as orders of magnitude."""


written = partial(report.written, marks=(START, END))


def main(argv: Sequence[str] | None = None) -> None:
    parser = argparse.ArgumentParser(prog="python -m benchmarks.in_space", description=__doc__)
    parser.add_argument("parts", nargs="*", help=f"of {', '.join(PARTS)}; all if none is named")
    parser.add_argument("--out", type=Path, default=Path("out"), help="folder of in_space.md")
    parser.add_argument("--write", type=Path, help="a page that has the tables between its marks")
    parser.add_argument("--read", action="store_true", help="measure nothing")
    arguments = parser.parse_args(argv)
    if unknown := set(arguments.parts) - set(PARTS):
        parser.error(f"unknown: {', '.join(sorted(unknown))}; there are {', '.join(PARTS)}")
    found = json.loads(STORED.read_text(encoding="utf-8")) if STORED.exists() else {}
    for part in () if arguments.read else arguments.parts or PARTS:
        print(f"{part} ...", file=sys.stderr)
        found[part] = PARTS[part]()
        if arguments.write:
            STORED.write_text(json.dumps(found, indent=1) + "\n", encoding="utf-8")
        machine = report.machine()
        found["machine"] = {k: machine[k] for k in ("processor", "cores", "Python", "llvmlite")}
    text = whole(found)
    print(text)
    arguments.out.mkdir(parents=True, exist_ok=True)
    (arguments.out / "in_space.md").write_text(text + "\n", encoding="utf-8")
    if arguments.write:
        STORED.write_text(json.dumps(found, indent=1) + "\n", encoding="utf-8")
        page = arguments.write.read_text(encoding="utf-8")
        arguments.write.write_text(written(text, page), encoding="utf-8")


if __name__ == "__main__":
    main()
