"""Faults to plant: each class of wrong answers that was once found, as a change of the text.

`python -m tests.soak --fault NAME` plants one in a copy of the package and soaks that. Most change
what is compiled, which takes a minute or more; the cheap ones are among the tests.
"""

import os
import shutil
import subprocess
import sys
import tempfile
from dataclasses import dataclass
from pathlib import Path

import rockeom
from rockeom.compiler.cache import cache_folder

ROOT = Path(rockeom.__file__).parent.parent


@dataclass(frozen=True)
class Fault:
    """Texts of a file that are replaced, the seeds that must notice, and by which words."""

    what: str
    file: str
    changes: tuple[tuple[str, str], ...]
    models: tuple[str, ...]
    words: tuple[str, ...]
    runs: int = 4000
    check: str = "none"
    methods: tuple[str, ...] = ("DOP853",)

    @property
    def compiles(self) -> bool:
        """Whether it changes the programs."""
        return self.file in (LOOP, LANES, IMPACTS, CARRIED)

    def text(self) -> str:
        """The file with the fault; raises LookupError where it is not as the fault knows it."""
        text = (ROOT / self.file).read_text(encoding="utf-8")
        for old, new in self.changes:
            if text.count(old) != 1:
                raise LookupError(f"{self.file} has {text.count(old)} times {old!r}")
            text = text.replace(old, new)
        return text


LOOP, LANES = "rockeom/integrator/loop.py", "rockeom/integrator/lanes/loop.py"
IMPACTS = "rockeom/integrator/transitions/declared.py"
CARRIED = "rockeom/integrator/tangents/variational.py"
MODES = "rockeom/structures/declared_modes.py"
_FULL = """\
        if is_full(motion, recorder) or motion.taken > turn:
            motion = motion._replace(outcome=FULL)
            break
"""
_NONE_FITS = """\
    raise InputError("state").says(
        f"no mode of {m.NAME} holds"""
_EQUAL = ("bound=most_error(case.rtol) if equal", "bound=np.inf if equal")

FAULTS = {
    "unfit": Fault(
        "a state that fits no mode is taken for the first",
        MODES,
        ((_NONE_FITS, f"    return 0\n{_NONE_FITS}"),),
        ("controlled_wall", "substitute_gravity_wall", "flexible_controlled_wall"),
        ("impact", "event", "energy", "gave up"),
        runs=40_000,
    ),
    "named": Fault(
        "a mode named against the state is taken",
        MODES,
        (("all(m.SIDES) and -side", "False and -side"),),
        ("two_spring_cart",),
        ("impact", "event"),
    ),
    "equal": Fault(
        "the error of an equal step is not looked at",
        LOOP,
        (_EQUAL,),
        ("slender_block",),
        ("energy", "guard"),
    ),
    "lanes": Fault(
        "nor that of a step of many lanes",
        LANES,
        (("coarse = most_error(batch.rtol)", "coarse = np.inf"),),
        ("flexible_structure",),
        ("lanes",),
        check="lanes",
    ),
    "nan": Fault(
        "a state that is not a number is taken for one",
        LOOP,
        (("finite = math.isfinite(step.error) and finite_end(a.k)", "finite = True"), _EQUAL),
        ("two_spring_structure",),
        ("not finite", "energy", "guard"),
    ),
    "event step": Fault(
        "the error of a step that ends on an event is not looked at",
        LOOP,
        (
            (
                "if not finite or step.error > step.bound:",
                "if not finite or (step.target < 0 and step.error > step.bound):",
            ),
        ),
        ("simplified_substitute_gravity_wall", "controlled_wall"),
        ("energy",),
        runs=40_000,
    ),
    "rest": Fault(
        "what still moves while impacts fade is left where it is",
        IMPACTS,
        (("if h == 0.0:\n        return True", "if h < 9.9:\n        return True"),),
        ("flexible_structure",),
        ("rest",),
    ),
    "jump at a call": Fault(
        "a call that ends where a law does forgets that the ground jumps there",
        LOOP,
        (
            (_FULL, ""),
            ("    while True:\n        if motion", f"    while True:\n{_FULL}        if motion"),
        ),
        ("rigid_block", "two_spring_structure"),
        ("many",),
        runs=40_000,
        check="many",
    ),
    "upright": Fault(
        "where shaking begins by nothing, the side is that of the middle of its first law",
        "rockeom/simulation/case.py",
        (("1e-3 * min(", "0.5 * (end - start) + 0.0 * min("),),
        ("dirac_delta_block", "controlled_wall_oscillator"),
        ("mirror",),
        check="mirror",
    ),
    "chatter": Fault(
        "an opening that a dense output hides is a passage back",
        LOOP,
        (
            (
                "slow = fall.unclear or opens_soon(",
                "slow = fall.unclear and opens_soon(",
            ),
        ),
        ("substitute_gravity_wall", "two_spring_structure"),
        ("gave up",),
    ),
    "names": Fault(
        "names of users are written as they are",
        "rockeom/codegen/names.py",
        (("while is_own(name) or name in self.taken:", "while name in self.taken:"),),
        ("rigid_block",),
        ("names",),
        check="names",
    ),
    "feet": Fault(
        "unequal feet have the impact of the first",
        "rockeom/symbolic/checks/derived.py",
        (("    _one_ratio(model, sample)\n", ""),),
        ("rigid_block",),
        ("feet",),
        check="feet",
    ),
    "saltation": Fault(
        "derivatives behind an impact are left at its time, which moves",
        CARRIED,
        (("y[j] = scratch.y_before[j] - scratch.rate[j] * tau", "y[j] = scratch.y_before[j]"),),
        ("rigid_block",),
        ("tangents",),
        runs=400,
        check="tangents",
    ),
    "pushover": Fault(
        "unknowns of a pushover in metres, equations in newtons",
        "rockeom/structures/statics.py",
        (
            ("    root = optimize.root(", "    length[:] = 1.0\n    root = optimize.root("),
            ("lacking(length * x)[0] / (stiffness * length)", "lacking(length * x)[0]"),
        ),
        ("two_spring_structure",),
        ("pushover",),
        check="pushover",
    ),
}


def planted(name: str) -> int:
    """Soak a copy of the package with a fault. 0 if it was found, 1 if not."""
    fault = FAULTS[name]
    with tempfile.TemporaryDirectory(prefix="rockeom-fault-") as folder:
        copy = Path(folder)
        for part in ("rockeom", "generated", "tests"):
            shutil.copytree(ROOT / part, copy / part)
        shutil.copy(ROOT / "pyproject.toml", copy)
        (copy / fault.file).write_text(fault.text(), encoding="utf-8")
        environment = os.environ | {"PYTHONPATH": str(copy)}
        if fault.compiles:  # what is wrong on purpose is not kept
            environment["ROCKEOM_CACHE_DIR"] = str(copy / "cache")
            (copy / "cache").mkdir()
            for path in cache_folder().glob("soak_*.py"):
                shutil.copy(path, copy / "cache")
        command = [sys.executable, "-m", "tests.soak", "--stop", "--workers", "1"]
        command += ["--runs", str(fault.runs), "--check", fault.check]
        command += ["--models", *fault.models, "--methods", *fault.methods]
        done = subprocess.run(
            command, cwd=copy, env=environment, check=False, stderr=subprocess.PIPE, text=True
        )
    print(done.stderr)
    found = any(f"\n    {word}" in done.stderr for word in fault.words)
    print(f"{name}, {fault.what}: {'found' if found else 'NOT FOUND'}")
    return int(not found)
