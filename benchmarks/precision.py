"""Work-precision diagrams: the error of each method against its time, out/precision.png.

    python -m benchmarks.precision [--out out]

Every line is one method whose tolerance, or number of steps, changes from point to point; rests
are completed as finely by all of them, so that they do the same work.
"""

import argparse
import math
import sys
import time
from collections.abc import Iterable
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter

from benchmarks import report, timing, ways, workloads as w
from benchmarks.ways import Way

WORKLOADS = ("W1", "W2", "W3", "W4")
RESTS = {"W1": 1e-9, "W2": 1e-7, "W3": 1e-9, "W4": 1e-7}
"""Threshold of rest of heyoka and SciPy [rad/s]; below 1e-9 heyoka loses impacts of W3."""
OUR_REST = {"W3": 1e-8}
ROUNDING = {"W2": 3e-10}
"""Errors below which no method gets any further [s]."""

STYLES = {
    "rockeom DOP853": ("#0b5394", "o", "-"),
    "rockeom RK45": ("#5aa0dc", "s", "-"),
    "rockeom RK45, equal steps": ("#5aa0dc", "D", ":"),
    "C DOP853": ("#222222", "x", "--"),
    "heyoka": ("#c1440e", "^", "-"),
    "SciPy DOP853": ("#3f7d20", "v", "-"),
    "SciPy RK45": ("#93b83c", "<", "-"),
}


def sweeps(workload: str, missing: Iterable[str]) -> dict[str, list[Way]]:
    """Method -> its ways from loose to tight."""
    rest = {"rest_tolerance": OUR_REST.get(workload, 1e-6)}
    fine = [10.0**-n for n in range(3, 14)]
    coarse = [10.0**-n for n in range(3, 13, 2)]
    found = {
        "rockeom DOP853": [ways.rockeom(workload, thin=True, rtol=r, **rest) for r in fine],
        "rockeom RK45": [
            ways.rockeom(workload, thin=True, method="RK45", rtol=r, **rest) for r in fine[:9]
        ],
    }
    if workload in ("W2", "W3"):
        found["rockeom RK45, equal steps"] = [
            ways.rockeom(workload, thin=True, method="RK45", steps_per_segment=n, **rest)
            for n in ((1, 2, 3) if workload == "W2" else (1, 2, 4, 8))
        ]
    if "C" not in missing:
        found["C DOP853"] = [ways.c(workload, "C", thin=True, rtol=r, **rest) for r in fine]
    if "heyoka" not in missing:
        found["heyoka"] = [
            ways.heyoka_way(workload, tolerance, RESTS[workload]) for tolerance in fine
        ]
    for method in ("DOP853", "RK45"):
        found[f"SciPy {method}"] = [
            ways.scipy_way(workload, method, rtol, RESTS[workload]) for rtol in coarse
        ]
    return found


Points = dict[str, list[tuple[float, float]]]
"""Method -> (time of a piece [s], error) of each of its ways."""

SLOW = 0.3  # runs that take longer [s] are timed once, the others in turns


def measure(workload: str, missing: Iterable[str]) -> Points:
    errors, slow, runs, swept = {}, {}, {}, sweeps(workload, missing)
    for method, tried in swept.items():
        sys.stderr.write(f"{workload}: {method}\n")
        for i, way in enumerate(tried):
            run = way.make()
            if way.who != "SciPy":
                run()  # what is compiled is compiled now
            started = time.process_time()
            errors[method, i] = w.error(workload, run())
            taken = time.process_time() - started
            if taken > SLOW:
                slow[method, i] = taken
            else:
                runs[method, i] = run
    sys.stderr.write(f"{workload}: timing {len(runs)} runs in turns\n")
    fast = timing.in_turns(runs, 5)
    return {
        method: [
            (
                (slow[method, i] if (method, i) in slow else fast[method, i].fastest) / way.pieces,
                errors[method, i],
            )
            for i, way in enumerate(tried)
        ]
        for method, tried in swept.items()
    }


def draw(measured: dict[str, Points]) -> plt.Figure:
    figure, axes = plt.subplots(2, 2, figsize=(11.0, 9.0), constrained_layout=True)
    lines = {}
    for ax, (workload, methods) in zip(axes.flat, measured.items(), strict=True):
        for method, points in methods.items():
            color, marker, style = STYLES[method]
            shown = [(t, e) for t, e in points if math.isfinite(e) and e > 0.0]
            if not shown:
                continue
            (line,) = ax.plot(
                *zip(*shown, strict=True),
                color=color,
                marker=marker,
                linestyle=style,
                markersize=5.0,
                linewidth=1.3,
            )
            lines[method] = line
        quantity, unit = ways.ERRORS[workload]
        ax.set(xscale="log", yscale="log", title=report.TITLES[workload])
        ax.set_xlabel(f"processor time per {ways.PIECES[workload][0]}")
        ax.set_ylabel(f"{quantity} [{unit}]")
        ax.xaxis.set_major_locator(LogLocator(10.0))
        ax.xaxis.set_major_formatter(FuncFormatter(lambda x, _: report.seconds(x * (1 + 1e-12))))
        ax.xaxis.set_minor_formatter(NullFormatter())
        if workload in ROUNDING:
            limits = ax.get_ylim()
            ax.axhspan(limits[0], ROUNDING[workload], color="#eeeeee", zorder=0)
            ax.set_ylim(limits)
            ax.text(
                0.98, 0.03, "rounding, as the motion amplifies it", transform=ax.transAxes,
                ha="right", color="#666666", fontsize=9.0,
            )  # fmt: skip
        ax.grid(which="major", color="#dddddd", linewidth=0.7)
        ax.set_axisbelow(True)
    ordered = [name for name in STYLES if name in lines]
    figure.legend(
        [lines[name] for name in ordered],
        ordered,
        loc="outside lower center",
        ncols=4,
        frameon=False,
    )
    return figure


def main() -> None:
    parser = argparse.ArgumentParser(prog="python -m benchmarks.precision", description=__doc__)
    parser.add_argument("--out", type=Path, default=Path("out"), help="folder of precision.png")
    arguments = parser.parse_args()
    missing = ways.missing()
    for line in missing.values():
        print(line)
    measured = {workload: measure(workload, missing) for workload in WORKLOADS}
    arguments.out.mkdir(parents=True, exist_ok=True)
    path = arguments.out / "precision.png"
    draw(measured).savefig(path, dpi=150)
    print(path)


if __name__ == "__main__":
    main()
