"""What a derivation costs at a former commit and in the working tree, and where its time goes.

python -m benchmarks.derivation COMMIT [PART]    of those whose name has PART; minutes

Each derivation is made in a new process with an empty cache, in turns of both trees, and once more
under a profiler in the working tree. Times are those of the processor, after the imports; of each
tree the shortest of `TURNS` counts. What a commit cannot derive has no time.
"""

import os
import pstats
import subprocess
import sys
import tempfile
from pathlib import Path

from benchmarks.report import table
from tests.golden.__main__ import ROOT, checkout

TURNS = 1
_COMPILED = "program(module_of({}), 'DOP853')"
DERIVATIONS = {
    **{
        f"shear frame of {n} storeys, derived and compiled": _COMPILED.format(
            f"'shear_frame', storeys={n}"
        )
        for n in (3, 10, 20)
    },
    "two blocks with friction, 100 modes, derived": (
        "module_of('stacked_blocks', support='sliding')"
    ),
    "the same, compiled too": _COMPILED.format("'stacked_blocks', support='sliding'"),
    "block on two feet, its page": "rk.derive('sliding_block').markdown()",
    "block on feet at two heights, its page": "declared.on_a_step().markdown()",
    "block on unequal feet, its page": "declared.unequal_feet().markdown()",
}
_PROGRAM = """
import cProfile, sys, time
import sympy
import rockeom as rk
from rockeom.codegen import module_text
from rockeom.integrator.program import program
from rockeom.modelling.declared import module_of
from tests.contact import declared
sys.setrecursionlimit(10_000)  # former commits call themselves for each term of a sum
profile, started = cProfile.Profile(), time.process_time()
if {profiled}:
    profile.enable()
{derivation}
profile.disable()
print(time.process_time() - started)
if {profiled}:
    profile.dump_stats({file!r})
"""


def taken(root: Path, derivation: str, profile: str = "") -> float:
    """Seconds of the processor in a new process, NaN where it fails; profile : a file for one."""
    program = _PROGRAM.format(derivation=derivation, profiled=bool(profile), file=profile)
    with tempfile.TemporaryDirectory() as cache:
        done = subprocess.run(
            [sys.executable, "-c", program], cwd=root, capture_output=True, text=True,
            env={**os.environ, "PYTHONPATH": str(root), "ROCKEOM_CACHE_DIR": cache},
        )  # fmt: skip
    return float(done.stdout) if done.returncode == 0 else float("nan")


def shares(file: str) -> dict[str, float]:
    """The part of a profile's time in SymPy, in rockeom, in LLVM and elsewhere.

    A function of C counts as what calls it.
    """
    of = dict.fromkeys(("sympy", "rockeom", "llvmlite", ""), 0.0)

    def add(path: str, seconds: float) -> None:
        of[next(name for name in of if f"/{name}/" in path or not name)] += seconds

    for (path, *_), (_, _, own, _, callers) in pstats.Stats(file).stats.items():  # type: ignore[attr-defined]
        if path != "~":
            add(path, own)
        for (caller, *_), called in callers.items() if path == "~" else ():
            add(caller, called[2])
    return {name: seconds / sum(of.values()) for name, seconds in of.items()}


def measured(name: str, former: Path, scratch: str) -> tuple[str, ...]:
    """A row of the table."""
    derivation = DERIVATIONS[name]
    times = [[taken(root, derivation) for root in (former, ROOT)] for _ in range(TURNS)]
    before, now = (min(turns) for turns in zip(*times, strict=True))
    profile = f"{scratch}/profile"
    taken(ROOT, derivation, profile)
    parts = shares(profile)
    ratio = f"{before / now:.1f}" if before == before else ""
    was = f"{before:.1f} s" if before == before else ""
    percent = (f"{100 * parts[of]:.0f} %" for of in ("sympy", "rockeom", "llvmlite"))
    return name, "", was, f"{now:.1f} s", ratio, *percent


def main(commit: str, part: str = "") -> None:
    head = ("derivation", "", commit, "now", "ratio", "SymPy", "rockeom", "LLVM")
    with tempfile.TemporaryDirectory() as scratch:
        former = Path(scratch) / "former"
        former.mkdir()
        checkout(commit, former)
        rows = [measured(name, former, scratch) for name in DERIVATIONS if part in name]
    print(table(head, rows))


if __name__ == "__main__":
    main(*sys.argv[1:])
