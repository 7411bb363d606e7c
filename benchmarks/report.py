"""What was measured, as tables of plain text that are Markdown too."""

import importlib.metadata
import os
import platform
import subprocess
from pathlib import Path

from benchmarks import with_c

Row = tuple[str, ...]


def table(head: Row, rows: list[Row]) -> str:
    """Columns of one width; all but the first two are set to the right."""
    widths = [max(len(row[i]) for row in [head, *rows]) for i in range(len(head))]

    def line(row: Row) -> str:
        cells = [
            cell.ljust(width) if i < 2 else cell.rjust(width)
            for i, (cell, width) in enumerate(zip(row, widths, strict=True))
        ]
        return "| " + " | ".join(cells) + " |"

    rule = ["-" * width if i < 2 else "-" * (width - 1) + ":" for i, width in enumerate(widths)]
    return "\n".join([line(head), "| " + " | ".join(rule) + " |", *map(line, rows)])


def seconds(x: float) -> str:
    for unit, size in (("s", 1.0), ("ms", 1e-3), ("µs", 1e-6)):
        if x >= size:
            return f"{x / size:.3g} {unit}"
    return f"{x / 1e-9:.3g} ns"


def scientific(x: float) -> str:
    return f"{x:.1e}"


def times(x: float) -> str:
    return f"{x:.2f}" if x < 10.0 else f"{x:.0f}"


def machine() -> dict[str, str]:
    """Processor, compiler and versions."""
    found = {"processor": _processor(), "cores": str(os.cpu_count())}
    try:
        version = subprocess.run(
            [with_c.compiler(), "--version"], capture_output=True, text=True, check=True
        )
        found["compiler"] = version.stdout.splitlines()[0] + ", " + " ".join(with_c.FLAGS)
    except (RuntimeError, OSError, subprocess.CalledProcessError):
        found["compiler"] = "none"
    found["Python"] = platform.python_version()
    for name in ("llvmlite", "numpy", "scipy", "heyoka"):
        try:
            found[name] = importlib.metadata.version(name)
        except importlib.metadata.PackageNotFoundError:
            found[name] = "not installed"
    return found


def load() -> str:
    """How busy the machine is: what is told by the wall's clock is worth little on a busy one."""
    return f"load {os.getloadavg()[0]:.1f}" if hasattr(os, "getloadavg") else "load unknown"


def _processor() -> str:
    info = Path("/proc/cpuinfo")
    if not info.exists():
        return platform.processor() or platform.machine()
    fields = dict(
        (part.strip() for part in line.split(":", 1))
        for line in info.read_text(encoding="utf-8").splitlines()
        if ":" in line
    )
    name = fields.get("model name", platform.machine())
    family, model = fields.get("cpu family"), fields.get("model")
    return f"{name} (family {family}, model {model})" if family and model else name


TITLES = {
    "W1": "W1, free decay of the block",
    "W2": "W2, the block under a record",
    "W3": "W3, the flexible structure under the same record",
    "W4": "W4, the block under 100 x 100 pulses",
    "W5": "W5, bifurcation diagram of the non-dimensional block",
}


def workload(name: str, found: dict) -> str:
    """Both tables of a workload."""
    unit, piece = found["unit"], found["piece"]
    parts = [f"### {TITLES[name]}", ""]
    head = (
        "by the same method",
        "what",
        f"error [{unit}]",
        f"time per {piece}",
        "rockeom/this (goal 1.15)",
    )
    rows = [
        (
            row["who"],
            row["setting"],
            scientific(row["error"]),
            seconds(row["seconds"]),
            times(row["ratio"]) if row["ratio"] else "",
        )
        for row in found["same method"]
    ]
    parts += [table(head, rows), ""]
    if "steps" in found:
        mine, theirs, apart = found["steps"]
        parts += [
            f"Steps: rockeom {mine:,}, C {theirs:,}; their impact times differ by {apart:.0e} s.",
            "",
        ]
    target, goals = found["target"], found["goals"]
    head = (
        f"error below {target:.0e} {unit}",
        "setting",
        f"error [{unit}]",
        f"time per {piece}",
        "this/rockeom",
        "goal",
    )
    rows = [
        (
            row["who"],
            row["setting"],
            scientific(row["error"]),
            seconds(row["seconds"]),
            times(row["ratio"]) if row["ratio"] else "",
            f"{goals[row['who']]:g}" if row["who"] in goals else "",
        )
        for row in found["equal error"]
    ]
    parts += [table(head, rows), ""]
    return "\n".join(parts)


DERIVATION = "### Derivation"


def derivations(page: Path) -> str:
    """The section of a page that holds what `benchmarks.derivation` told, and stays as it is."""
    text = page.read_text(encoding="utf-8") if page.exists() else ""
    _, mark, section = text.partition(DERIVATION)
    return f"\n{mark}{section}" if mark else ""


def whole(found: dict) -> str:
    """All of it, as docs/benchmarks.md."""
    parts = ["# Benchmarks", "", INTRODUCTION, ""]
    parts += [table(("", "measured on"), list(found["machine"].items())), ""]
    parts += [f"{line}.\n" for line in found["missing"].values()]
    if found["ratios to C"]:
        parts += ["", "### rockeom against C, by the same method", "", ratios(found), ""]
        parts += ["### rockeom against the best C", "", BEST_C, "", best_c(found), ""]
    parts += [workload(name, found["workloads"][name]) for name in found["workloads"]]
    if "others" in found:
        parts += ["### Sweeps", "", others(found["others"]), ""]
        parts += ["### Lanes", "", LANES, "", lanes(found["lanes"]), ""]
        parts += ["### The first call", "", FIRST_CALL, "", first_calls(found["first call"]), ""]
    return "\n".join(parts)


def ratios(found: dict) -> str:
    """Summary: rockeom's time over that of C."""
    names = list(found["ratios to C"])
    variants = sorted({v for ratio in found["ratios to C"].values() for v in ratio})
    rows = [
        (variant, "goal 1.15", *(times(found["ratios to C"][n][variant]) for n in names))
        for variant in variants
    ]
    return table(("rockeom's time over that of", "", *names), rows)


def best_c(found: dict) -> str:
    """rockeom's time over that of the best C at equal error, with both errors."""
    rows = []
    for name, result in found["workloads"].items():
        for pair in result["best C"]:
            ours, c, many = pair["rockeom"], pair["C"], pair["simulate_many"]
            rows.append(
                (
                    name,
                    ours["setting"],
                    c["setting"],
                    f"{scientific(ours['error'])} {result['unit']}",
                    f"{scientific(c['error'])} {result['unit']}",
                    seconds(ours["seconds"]),
                    seconds(c["seconds"]),
                    times(c["ratio"]),
                    times(many["ratio"]),
                )
            )
    head = (
        "", "rockeom", "best C", "rockeom's error", "C's error", "rockeom's time", "C's time",
        "ratio (goal 1.2)", "by rk.simulate_many (goal 1.3)",
    )  # fmt: skip
    return table(head, rows)


FIRST_CALL = """\
`import rockeom` and `rk.simulate` in a new process, seconds of the processor above
`import numpy, llvmlite.binding` (for what is declared, above `import sympy` too): with an empty
cache, where the structure is compiled for the method, and in a later process, the fastest of some.
Expected were below 1.2 s for `rigid_block`, 2 s for others, 2.5 s for walls and 5 s for what is
declared; later 0.1 s, and 0.3 s for what is declared."""


def first_calls(found: dict) -> str:
    """Of each structure: with each method compiled first, and later."""
    methods = list(next(iter(found.values())))
    rows = [
        (
            name,
            "",
            *(f"{by[m][of][1]:.{places}f}" for of, places in ((0, 1), (1, 2)) for m in methods),
        )
        for name, by in found.items()
    ]
    head = ("structure", "", *(f"{m}, {when}" for when in ("first", "later") for m in methods))
    return table(head, rows)


def lanes(found: list[Row]) -> str:
    """Maps of motions: C, one by one, and in lanes."""
    head = (
        "map", "way", "time per motion", "per step", "of C's", "median error [s]",
        "motions that fell",
    )  # fmt: skip
    return table(head, found)


def others(found: dict) -> str:
    rows = [(row["what"], row["how"], row["measured"], row["goal"]) for row in found]
    return table(("", "how", "measured", "goal"), rows)


LANES = """\
Maps of many motions on one core: 400 blocks and 100 flexible structures under the record of W2, and
400 of the pulses of W4, by the same method of order 8. C, and rockeom one by one, take controlled
steps, which end at every sample; in lanes sixteen motions are stepped at once, the records with one
step a sample. The error is the largest among the times of a motion's first impacts."""

BEST_C = """\
C by the method that suits each work, and with no more than it needs. The first line of each work
has the cheapest setting of either whose error is below that of the work's table, the second
rockeom's default and the cheapest C whose error is not larger, and which completes rests as finely.
Ratios are rockeom's time over that of C."""

INTRODUCTION = """\
Written by `python -m benchmarks --write docs/benchmarks.md`, or, of what `make bench` has left, by
`python -m benchmarks --read out/bench.json --write docs/benchmarks.md`; what is compared, and how,
is told in [verification.md](verification.md). Times are medians of processor time, ratios the
medians of the ratios turn by turn: all ways of doing a workload take turns in one process, so that
what slows the machine down for a while slows all of them. The goals are numbers that were set
beforehand."""


def written(text: str, page: str, marks: tuple[str, str]) -> str:
    """A page with a text between its two marks; raises ValueError where it has none."""
    start, end = marks
    before, found, rest = page.partition(start)
    _, closed, after = rest.partition(end)
    if not found or not closed:
        raise ValueError(f"the page has no {start} and {end} between which the table stands")
    return f"{before}{start}\n\n{text}\n\n{end}{after}"
