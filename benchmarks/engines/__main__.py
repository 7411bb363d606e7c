"""Run the programs, or report an earlier run; see the package's docstring."""

import argparse
import importlib.metadata
import importlib.util
import json
import platform
import sys
import time
from collections.abc import Mapping, Sequence
from pathlib import Path
from types import ModuleType

from benchmarks.engines import (
    cases,
    pictures,
    tables,
    trace,
    with_drake,
    with_exudyn,
    with_mujoco,
    with_opensees,
    with_pybullet,
)

ENGINES = (with_mujoco, with_pybullet, with_drake, with_exudyn, with_opensees)
STEPS = (1e-2, 1e-3, 1e-4)
DISTRIBUTIONS = {"pydrake": "drake"}
STORED = Path(__file__).parent / "engines.json"


def missing(engine: ModuleType) -> bool:
    return importlib.util.find_spec(engine.PACKAGE) is None


def attempt(engine: ModuleType, case: Mapping, step: float) -> dict:
    """What a program gives at a step: values by quantity, or why there are none."""
    started = time.process_time()
    try:
        values = trace.numbers(engine.run, case, step)
    except trace.UnsupportedError as reason:
        return {"unsupported": str(reason)}
    except Exception as failure:  # a program may have changed, or lack a library here
        return {"step": step, "failed": " ".join(str(failure).split())[:200]}
    return {"step": step, "values": values, "seconds": round(time.process_time() - started, 2)}


def measure(engine: ModuleType, steps: tuple[float, ...] = STEPS) -> dict:
    """All cases by a program."""
    found = {}
    for case in cases():
        rows = []
        for step in steps:
            rows.append(attempt(engine, case, step))
            print(f"{engine.NAME}, {case['id']}, {step:g} s: {rows[-1]}", file=sys.stderr)
            if "unsupported" in rows[-1]:
                break
        found[case["id"]] = rows
    package = DISTRIBUTIONS.get(engine.PACKAGE, engine.PACKAGE)
    return {
        "version": importlib.metadata.version(package),
        "settings": engine.SETTINGS,
        "cases": found,
    }


def main(argv: Sequence[str] | None = None) -> None:
    names = [engine.NAME for engine in ENGINES]
    parser = argparse.ArgumentParser(prog="python -m benchmarks.engines", description=__doc__)
    parser.add_argument("engines", nargs="*", help=f"of {', '.join(names)}; all if none is named")
    parser.add_argument("--out", type=Path, default=Path("out"), help="folder of engines.json")
    parser.add_argument("--read", type=Path, help="measure nothing: report an earlier engines.json")
    parser.add_argument("--write", type=Path, help="a page that has the tables between its marks")
    parser.add_argument("--images", type=Path, help="a folder for the pictures of the page")
    arguments = parser.parse_args(argv)
    if unknown := set(arguments.engines) - set(names):
        parser.error(f"unknown: {', '.join(sorted(unknown))}; there are {', '.join(names)}")
    if arguments.read:
        found = json.loads(arguments.read.read_text(encoding="utf-8"))
    else:
        chosen = [e for e in ENGINES if not arguments.engines or e.NAME in arguments.engines]
        found = {"machine": {"Python": platform.python_version()}, "missing": {}, "engines": {}}
        for engine in chosen:
            if missing(engine):
                found["missing"][engine.NAME] = engine.INSTALL
            else:
                found["engines"][engine.NAME] = measure(engine)
        arguments.out.mkdir(parents=True, exist_ok=True)
        text = json.dumps(found, indent=1) + "\n"
        (arguments.out / "engines.json").write_text(text, encoding="utf-8")
    if arguments.images:
        pictures.draw(found, arguments.images)
    if arguments.write:
        page = arguments.write.read_text(encoding="utf-8")
        arguments.write.write_text(tables.written(found, page), encoding="utf-8")
    else:
        print(tables.whole(found))


if __name__ == "__main__":
    main()
