"""Run the benchmarks side by side; see the package's docstring."""

import argparse
import json
import os
import sys
import time
from collections.abc import Sequence
from pathlib import Path

import numpy as np

from benchmarks import first_call, lanes, report, timing, ways, with_c, with_rockeom, workloads as w
from benchmarks.ways import Way

GOALS = {
    "heyoka": {"W1": 2.0, "W2": 10.0, "W3": 10.0, "W4": 8.0},
    "SciPy": {"W1": 300.0, "W2": 2000.0, "W3": 2000.0, "W4": 1000.0},
}
"""How many times as long as rockeom they were expected to take."""


class Progress:
    """One line on stderr that says what is being done; without a terminal, a line for each task."""

    def __init__(self) -> None:
        self.started = time.monotonic()
        self.shown = sys.stderr.isatty()

    def __call__(self, task: str = "", detail: str = "") -> None:
        if self.shown:
            line = f"{time.monotonic() - self.started:4.0f} s  {task} {detail}" if task else ""
            sys.stderr.write(f"\r\033[K{line}")
        elif task and not detail:
            sys.stderr.write(f"{time.monotonic() - self.started:4.0f} s  {task}\n")
        sys.stderr.flush()


progress = Progress()


def _error(workload: str, run: ways.Run) -> float:
    return w.error(workload, run())


def cheapest(
    who: str, workload: str, target: float, rests: Sequence[float] | None = None
) -> tuple[Way, ways.Run, float] | None:
    """(way, its run, its error) of the cheapest setting whose error is not above the target."""
    best = None
    progress(f"{workload}: the cheapest setting of {who}")
    for family in ways.families(who, workload, rests):
        for way in family:
            progress(f"{workload}: the cheapest setting of {who}:", way.setting)
            try:
                run = way.make()
                started = time.process_time()
                error = _error(workload, run)
            except ArithmeticError:
                continue
            if error > target:
                continue
            taken = time.process_time() - started
            if taken < 1.0:  # else once is enough to compare settings
                taken = timing.in_turns({"": run}, 3)[""].fastest
            taken /= way.pieces
            if best is None or taken < best[0]:
                best = taken, (way, run, error)
            break
    return best[1] if best else None


def one_motion(workload: str) -> w.Case | None:
    """The case of which C and rockeom must take the same steps."""
    return {
        "W1": w.decay(w.RELEASE),
        "W2": w.shaken(w.BLOCK),
        "W3": w.shaken(w.COLUMN),
        "W4": w.Case(w.BLOCK, w.pulses(w.PULSE_STRIDE)[50]),
        "W5": w.driven(w.REFERENCE_AMPLITUDES[2]),
    }[workload]


def same_steps(workload: str) -> tuple[int, int, float]:
    """Steps of rockeom and of C in one motion, and how far the times of firm impacts differ."""
    case, solver = one_motion(workload), with_rockeom.options(1e-10)
    problem = with_c.Problem(case, solver)
    least = w.FIRM.get(workload, 0.0)
    mine = with_rockeom.loop(case, solver)().firm(least).times
    theirs = problem.impacts().firm(least).times
    apart = float(np.abs(mine - theirs).max()) if len(mine) == len(theirs) else np.inf
    return with_rockeom.steps(case, solver), problem.run()[3], apart


def measure(workload: str, quick: bool, missing: dict[str, str]) -> dict:
    """Everything about one workload."""
    runs: dict[str, tuple[Way, ways.Run]] = {}
    errors: dict[str, float] = {}

    def add(label: str, way: Way, run: ways.Run | None = None, error: float | None = None):
        progress(f"{workload}: {way.who}", way.setting)
        run = run or way.make()
        runs[label] = way, run
        errors[label] = _error(workload, run) if error is None else error

    # by the same method, to the same tolerances
    progress(f"{workload}: rockeom and C")
    ours = ways.rockeom(workload, thin=quick)
    add("rockeom", ours)
    if "C" not in missing:
        for variant in with_c.VARIANTS:
            add(variant, ways.c(workload, variant, thin=quick))
    same = list(runs)
    if single := with_rockeom.SINGLE.get(workload):
        solver = with_rockeom.options(1e-10)
        for label, entry in (
            ("rockeom, one call", with_rockeom.loop),
            ("rockeom, rk.simulate", with_rockeom.response),
        ):
            way = Way(label, ours.setting, lambda entry=entry: single(solver, entry))
            add(label, way)
        if "C" not in missing and workload == "W1":
            add("C, one call", Way("C, one call", "", lambda: with_c.free_decay(solver)))
    first = list(runs)

    # at equal error
    target = ways.TARGETS[workload]
    for who in ("rockeom", "best C", "heyoka", "SciPy"):
        if who in missing or (who == "best C" and "C" in missing):
            continue
        if found := cheapest(who, workload, target):
            add(f"cheapest {who}", *found)
    if workload == "W2":
        add("over samples", ways.over_samples())
    second = [label for label in runs if label not in first]

    # beside the best C: the cheapest of both, and rockeom's default with the C that is as exact
    add("default rockeom", ways.rockeom(workload, thin=ways.thinned(workload)))
    if "C" not in missing:
        rests = (with_rockeom.options(1e-10).rest_tolerance,)
        if found := cheapest("best C", workload, errors["default rockeom"], rests):
            add("as exact", *found)
    pairs = {
        ours: c
        for ours, c in {
            "cheapest rockeom": "cheapest best C",
            "default rockeom": "as exact",
        }.items()
        if ours in runs and c in runs
    }
    for label in pairs:
        way = ways.through_simulate_many(workload, runs[label][0])
        add(f"{label}, many", way, error=errors[label])  # it is the same loop

    progress(f"{workload}: timing {len(runs)} ways in turns")
    turns = {True: 3, False: 9}[quick]
    measured = timing.in_turns({label: run for label, (_, run) in runs.items()}, turns)

    def row(label: str, ratio: float | None) -> dict:
        way = runs[label][0]
        return {
            "who": way.who,
            "setting": way.setting,
            "error": errors[label],
            "seconds": measured[label].median / way.pieces,
            "ratio": ratio,
        }

    def ratio(of: str, to: str) -> float:
        return measured[of].ratio_to(measured[to]) / runs[of][0].pieces * runs[to][0].pieces

    found = {
        "unit": ways.ERRORS[workload][1],
        "piece": ways.PIECES[workload][0],
        "target": ways.TARGETS[workload],
        "goals": {who: goals[workload] for who, goals in GOALS.items() if workload in goals},
        "same method": [
            row(label, ratio("rockeom", label) if label in same[1:] else None) for label in first
        ],
        "equal error": [
            row(label, None if label == "cheapest rockeom" else ratio(label, "cheapest rockeom"))
            for label in second
        ],
    }
    found["best C"] = [
        {
            "rockeom": row(label, None),
            "C": row(c, ratio(label, c)),
            "simulate_many": row(f"{label}, many", ratio(f"{label}, many", c)),
        }
        for label, c in pairs.items()
    ]
    if "C" not in missing:
        found["steps"] = same_steps(workload)
    return found


def others(quick: bool) -> list[dict]:
    """Two threads against one, and what a case of a sweep costs besides its integration."""
    progress("cases at once and one by one")
    sizes = {"at once": 1000, "one by one": 10, "already": 10}
    measured = timing.in_turns(
        {
            "at once": with_rockeom.making(True, sizes["at once"]),
            "one by one": with_rockeom.making(False, sizes["one by one"]),
            "already": with_rockeom.made(sizes["already"]),
        },
        3 if quick else 7,
    )
    a_case = {way: measured[way].median / (100 * n) for way, n in sizes.items()}
    rows = [
        {
            "what": f"a case of a sweep, made {way}",
            "how": f"a block under a pulse, by rk.simulate_many without the loop; {report.load()}",
            "measured": report.seconds(a_case[way] - a_case["already"]),
            "goal": "2 µs" if way == "at once" else "",
        }
        for way in ("at once", "one by one")
    ]
    rows += [by_names(quick), *sliding(quick)]
    if (os.cpu_count() or 1) < 2:
        rows.append({"what": "two threads", "how": "", "measured": "one core only", "goal": ""})
    else:
        progress("W4 by one thread and by two")
        solver, stride = with_rockeom.options(1e-10), 2 if quick else 1
        measured = timing.in_turns(
            {str(n): with_rockeom.pulse_map(solver, n, stride) for n in (1, 2)},
            3 if quick else 5,
            clock=time.perf_counter,
        )
        rows.append(
            {
                "what": "one thread against two",
                "how": f"W4 by rk.simulate_many, by the wall, fastest of each; {report.load()}",
                "measured": report.times(measured["1"].fastest / measured["2"].fastest),
                "goal": "1.8",
            }
        )
    return rows


def by_names(quick: bool) -> dict:
    """A sweep by names against one of a function, whose results are the same to the last bit."""
    progress("pulses by names and by a function")
    n = 100 if quick else 400
    runs = with_rockeom.names_and_function(n)
    same = runs["names"]().equals(runs["function"]())
    measured = timing.in_turns(runs, 3 if quick else 7)
    return {
        "what": "a sweep by names against one of a function",
        "how": f"{n * n:,} pulses by rk.simulate_many, {'the same' if same else 'OTHER'} bits",
        "measured": report.times(measured["names"].ratio_to(measured["function"])),
        "goal": "1.1",
    }


def sliding(quick: bool) -> list[dict]:
    """The block on feet that may slip beside the block on pinned feet: a step, and a record."""
    progress("the sliding block and the pinned one")
    solver, motion = with_rockeom.options(1e-10), w.record()
    short = with_rockeom.options(1e-10, max_step=1e-4)
    blocks = {"pinned": w.BLOCK, "sliding": w.SLIDING_BLOCK}
    rocking = {name: with_rockeom.released(block) for name, block in blocks.items()}
    shaken = {name: w.Case(block, motion) for name, block in blocks.items()}
    runs = {f"{name}, a step": with_rockeom.loop(case, short) for name, case in rocking.items()}
    runs |= {f"{name}, a record": with_rockeom.loop(case, solver) for name, case in shaken.items()}
    measured = timing.in_turns(runs, 3 if quick else 7)
    steps = {name: with_rockeom.steps(case, short) for name, case in rocking.items()}
    friction = f"friction {w.SLIDING_BLOCK.friction:g}"

    def ratio(of: str) -> float:
        return measured[f"sliding, {of}"].ratio_to(measured[f"pinned, {of}"])

    return [
        {
            "what": "a step of the sliding block against one of the pinned block",
            "how": f"free rocking without an impact, {friction}, {steps['sliding']} steps",
            "measured": report.times(ratio("a step") * steps["pinned"] / steps["sliding"]),
            "goal": "2",
        },
        {
            "what": "the sliding block under a record against the pinned block",
            "how": f"W2, {friction}, {with_rockeom.steps(shaken['sliding'], solver)} steps",
            "measured": report.times(ratio("a record")),
            "goal": "2",
        },
    ]


def _write(text: str, page: Path) -> None:
    page.write_text(text + report.derivations(page), encoding="utf-8")


def main() -> None:
    parser = argparse.ArgumentParser(prog="python -m benchmarks", description=__doc__)
    parser.add_argument("workloads", nargs="*", help="W1 to W5; all if none is named")
    parser.add_argument("--quick", action="store_true", help="few repetitions, thinned workloads")
    parser.add_argument("--out", type=Path, default=Path("out"), help="folder of bench.json, .md")
    parser.add_argument("--write", type=Path, help="write the report here too")
    parser.add_argument(
        "--read", type=Path, help="measure nothing: report what an earlier run left in bench.json"
    )
    arguments = parser.parse_args()
    if arguments.read:
        text = report.whole(json.loads(arguments.read.read_text(encoding="utf-8")))
        if arguments.write:
            _write(text, arguments.write)
        else:
            print(text)
        return
    if unknown := set(arguments.workloads) - set(w.WORKLOADS):
        parser.error(f"unknown: {', '.join(sorted(unknown))}; there are {', '.join(w.WORKLOADS)}")
    chosen = arguments.workloads or list(w.WORKLOADS)

    missing = ways.missing()
    for line in missing.values():
        print(line)
    found: dict = {"machine": report.machine(), "missing": missing, "workloads": {}}
    found["ratios to C"] = {}
    for name in chosen:
        result = measure(name, arguments.quick, missing)
        found["workloads"][name] = result
        to_c = {r["who"]: r["ratio"] for r in result["same method"] if r["ratio"]}
        if to_c:
            found["ratios to C"][name] = to_c
        progress()
        print(report.workload(name, result))
    if not arguments.workloads:
        found["others"] = others(arguments.quick)
        found["lanes"] = list(lanes.rows(2 if arguments.quick else 5, progress))
        found["first call"] = dict(first_call.table(arguments.quick, progress))
        progress()
        print(report.others(found["others"]) + "\n")
        print(report.lanes(found["lanes"]) + "\n")
        print(report.first_calls(found["first call"]) + "\n")
    if found["ratios to C"]:
        print(report.ratios(found) + "\n")
        print(report.best_c(found))
    text = report.whole(found)
    arguments.out.mkdir(parents=True, exist_ok=True)
    (arguments.out / "bench.json").write_text(json.dumps(found, indent=1) + "\n", encoding="utf-8")
    (arguments.out / "bench.md").write_text(text, encoding="utf-8")
    if arguments.write:
        _write(text, arguments.write)


if __name__ == "__main__":
    main()
