"""What is compiled once stays compiled, and is never used for other equations."""

import dataclasses
import math
import os
import re
import shutil
import subprocess
import sys
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
import sympy as sp

import rockeom as rk
from rockeom.codegen import declaration_digest, module_text
from rockeom.integrator import program as programs
from rockeom.integrator.texts import load_text
from rockeom.modelling import declared
from rockeom.structures.classes import SHIPPED
from rockeom.symbolic.model import Body, parameter, turned
from rockeom.symbolic.rocking import RockingModel, rocking_structure
from rockeom.symbolic.structures.rigid_block import GRAVITY, ROTATION, rigid_block
from tests.shipped import plain

ROOT = Path(__file__).resolve().parents[2]

DECAY = """
import rockeom as rk
from rockeom.integrator import program as programs
made, make = [], programs._made
programs._made = lambda *given: made.append(1) or make(*given)
block = rk.RigidBlock(half_width=0.25, half_height=1.0, gravity=9.81)
options = rk.SolverOptions(method="RK45")
run = rk.simulate(block, rk.GroundMotion.none(1.0), initial={"theta": 0.1}, options=options)
print(repr(run.impacts[0].time), len(made), programs.program(block.module, "RK45").name)
"""
"""Prints the time of the first impact, how many programs were compiled, and the program's name."""

KILLED = """
import os
from rockeom.integrator import program as programs
compile, calls = programs.compiled, []
programs.compiled = lambda *given: calls.append(1) or (
    compile(*given) if len(calls) == 1 else os._exit(9)
)
"""
"""The process ends, as if it were killed, when it has compiled the loop but not its own half."""


def start(package, cache, script=DECAY):
    """A new process that runs the script with the package and the cache given."""
    environment = {**os.environ, "PYTHONPATH": str(package), "ROCKEOM_CACHE_DIR": str(cache)}
    return subprocess.Popen(
        [sys.executable, "-c", script],
        cwd=package,
        env=environment,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    )


def result(process):
    out, errors = process.communicate(timeout=300)
    assert process.returncode == 0, errors
    time, made, name = out.split()
    # a line where compiling took more than a second, and none where all is loaded
    line = "(rockeom: compiled rigid_block with RK45 in [0-9.]+ s, once on this machine\n)?"
    assert re.fullmatch(line if int(made) else "", errors), errors
    return float(time), int(made), name


def quarter_period(gravity):
    """From 0.1 rad at rest to the impact, for the block of DECAY."""
    nodes, weights = np.polynomial.legendre.leggauss(60)
    alpha, radius = math.atan2(0.25, 1.0), math.hypot(0.25, 1.0)
    u = 0.5 * math.sqrt(0.1) * (nodes + 1)
    x = u**2 / 2
    ratio = math.sqrt(2) / np.sqrt(np.sinc(x / np.pi))
    p = math.sqrt(0.75 * gravity / radius)
    return float(ratio / np.sqrt(np.sin(alpha - 0.1 + x)) @ weights) * 0.5 * math.sqrt(0.1) / p


def copy_of_the_package(folder):
    """Laid out as in a wheel, with what the models give today for generated module."""
    halfway = shutil.ignore_patterns("*.pyc.*")  # what another process is just writing
    shutil.copytree(ROOT / "rockeom", folder / "rockeom", ignore=halfway)
    shutil.copy(ROOT / "generated" / "shipped_structures.py", folder / "rockeom" / "generated")
    generate(folder, rigid_block())
    return folder


def generate(package, model):
    """As `make generated` does it, for one model; returns how many files changed."""
    path = package / "rockeom" / "generated" / f"{model.name}.py"
    text = module_text(model)
    if path.exists() and path.read_text(encoding="utf-8") == text:
        return 0
    path.write_text(text, encoding="utf-8")
    return 1


def twice_as_heavy(model):
    """The model with gravity counted twice in every mode."""
    modes = (dataclasses.replace(mode, gravity=2 * mode.gravity) for mode in model.modes)
    return dataclasses.replace(model, modes=tuple(modes))


def test_processes_share_programs_race_for_them_and_see_every_change(tmp_path):
    """One is killed as it compiles; two start at once; another loads; then the equations change.

    A file that was cut off is made again, as in `compiler/test_store` all are that something is
    wrong with.
    """
    cache, package = tmp_path / "cache", copy_of_the_package(tmp_path / "package")
    killed = start(package, cache, KILLED + DECAY)
    killed.communicate()
    assert killed.returncode == 9
    assert all(path.stem.startswith("rockeom_loop") for path in cache.glob("rockeom_*"))

    racing = [start(package, cache), start(package, cache)]
    first, second = (result(process) for process in racing)
    assert first[0] == second[0] == pytest.approx(quarter_period(9.81), rel=1e-9)
    assert first[2] == second[2]
    assert 1 in (first[1], second[1])  # the killed one left nothing

    time, made, name = result(start(package, cache))
    assert (time, made, name) == (first[0], 0, first[2])
    (loop,) = (path for path in cache.iterdir() if path.stem != f"rockeom_{name}")
    assert re.fullmatch(r"rockeom_loop_[0-9a-f]{20}", loop.stem)

    # the model is derived anew, with twice the weight
    assert generate(package, rigid_block()) == 0  # what is in the package is what is derived
    assert generate(package, twice_as_heavy(rigid_block())) == 1
    time, made, other = result(start(package, cache))
    assert time == pytest.approx(quarter_period(2 * 9.81), rel=1e-9)
    assert made == 1
    assert other != name

    # and back: both programs are there, with one loop, but files are cut off, and made again
    (path,) = (path for path in cache.iterdir() if path.stem == f"rockeom_{name}")
    whole = path.read_bytes()
    path.write_bytes(whole[: len(whole) // 2])
    assert generate(package, rigid_block()) == 1
    assert result(start(package, cache)) == (first[0], 1, name)
    assert path.read_bytes() == whole
    names = {loop.stem, *(f"rockeom_{n}" for n in (name, other))}
    assert {path.stem for path in cache.iterdir()} == names
    whole = loop.read_bytes()
    loop.write_bytes(whole[: len(whole) // 2])
    assert result(start(package, cache)) == (first[0], 0, name)
    assert loop.read_bytes() == whole


def test_threads_that_want_one_program_compile_it_once(tmp_path, monkeypatch):
    monkeypatch.setenv("ROCKEOM_CACHE_DIR", str(tmp_path))
    text = Path(rk.RigidBlock(half_width=0.1, half_height=0.4).module.__file__).read_text()
    module, made = load_text("for_threads", text + "\n# in a module of its own\n"), []

    def make(*given):
        made.append(given)
        time.sleep(0.1)  # all others are there before it is done
        return b'{"entries": {}, "sizes": {}}\n'

    monkeypatch.setattr(programs, "_made", make)
    monkeypatch.setattr(programs, "Loaded", lambda *codes, bounds: SimpleNamespace(functions={}))
    with ThreadPoolExecutor(4) as pool:
        found = {*pool.map(lambda _: programs.program(module, "RK45"), range(8))}
    assert (len(found), len(made)) == (1, 1)


def test_lanes_compile_no_loop_that_is_there(tmp_path, monkeypatch):
    monkeypatch.setenv("ROCKEOM_CACHE_DIR", str(tmp_path))
    text = Path(rk.RigidBlock(half_width=0.1, half_height=0.4).module.__file__).read_text()
    module, made = load_text("with_lanes", text + "\n# known to nobody\n"), []

    def make(module, method, part, bounds):
        made.append(part)
        return b'{"entries": {}, "sizes": {}}\n'

    monkeypatch.setattr(programs, "_made", make)
    monkeypatch.setattr(programs, "Loaded", lambda *codes, bounds: SimpleNamespace(functions={}))
    programs.program(module, "RK45")
    assert made == [programs.LOOP]
    programs.program(module, "RK45", lanes=True)
    assert made == [programs.LOOP, programs.VECTORS, programs.GLUE]


def test_structures_of_a_kind_share_a_loop(tmp_path, monkeypatch):
    """Not a step, nor what is the structure's own; nor the loop of another method or kind."""
    monkeypatch.setenv("ROCKEOM_CACHE_DIR", str(tmp_path))
    monkeypatch.setattr(programs, "_SHARED", {})
    monkeypatch.setattr(programs, "compiled", lambda ir, lanes: ir.encode())
    monkeypatch.setattr(programs, "Loaded", lambda *codes, bounds: SimpleNamespace(functions={}))
    programs._of_parts.cache_clear()
    try:
        loops = []
        for name, method in (
            ("rigid_block", "RK45"), ("slender_block", "RK45"), ("rigid_block", "DOP853"),
            ("flexible_structure", "RK45"), ("wall_with_frame", "RK45"),
        ):  # fmt: skip
            programs.program(SHIPPED[name](**plain(name)).module, method)
            loops.append(len([*tmp_path.glob("rockeom_loop_*.compiled")]))
        assert loops == [1, 1, 2, 3, 3]
        assert len([*tmp_path.iterdir()]) == 5 + 3
        (own,) = (path.read_text() for path in tmp_path.glob("rockeom_slender_block_*"))
        assert "define double @take_step.1" in own
        assert "@first_fall" not in own
    finally:
        programs._of_parts.cache_clear()


def test_compiling_is_told_where_it_takes_more_than_a_second(tmp_path, monkeypatch, capsys):
    monkeypatch.setenv("ROCKEOM_CACHE_DIR", str(tmp_path))
    monkeypatch.setattr(programs, "_SHARED", {})
    module = rk.RigidBlock(half_width=0.1, half_height=0.4).module
    monkeypatch.setattr(programs, "compiled", lambda ir, lanes: b"")
    started = programs.time.monotonic()
    for seconds, line in (
        (0.5, ""),
        (2.5, "rockeom: compiled rigid_block with RK45 in 2.5 s, once on this machine\n"),
    ):
        times = iter([started, started + seconds])
        monkeypatch.setattr(programs.time, "monotonic", lambda times=times: next(times))
        programs._made(module, "RK45", programs.LOOP)
        assert capsys.readouterr() == ("", line)


def test_deriving_is_told_where_it_takes_more_than_a_second(tmp_path, monkeypatch, capsys):
    monkeypatch.setenv("ROCKEOM_CACHE_DIR", str(tmp_path))
    monkeypatch.setattr("rockeom.codegen.module_text", lambda model: "A = 1\n")
    started = programs.time.monotonic()
    for seconds, line in (
        (0.5, ""),
        (75.0, "rockeom: derived tall_block in 75.0 s, once on this machine\n"),
    ):
        times = iter([started, started + seconds])
        monkeypatch.setattr(declared.time, "monotonic", lambda times=times: next(times))
        declared._kept_module("tall_block", f"of_{seconds:.0f}", lambda: tall_block(1))
        assert capsys.readouterr() == ("", line)


def test_an_equal_declaration_is_not_derived_again(tmp_path, monkeypatch):
    monkeypatch.setenv("ROCKEOM_CACHE_DIR", str(tmp_path))
    texts = iter(["A = 1\n", "A = 2\n"])
    monkeypatch.setattr("rockeom.codegen.module_text", lambda model: next(texts))
    models = map(tall_block, (1, 1, 2))
    modules = (declared._kept_module(m.name, declaration_digest(m), lambda m=m: m) for m in models)
    assert [module.A for module in modules] == [1, 1, 2]


def tall_block(stretch) -> RockingModel:
    """The rigid block whose centroid is `stretch` times as high as its parameter says."""
    mass = parameter("m", "mass", "kg", "mass")
    half_width = parameter("B", "half_width", "m", "half of the width of the base")
    height = parameter("H", "height", "m", "nominal height of the centroid")
    inertia = parameter("I_g", "inertia", "kg m2", "moment of inertia about the centroid")

    def bodies(pivot):
        centroid = turned((0, stretch * height.symbol), pivot, ROTATION.position)
        return [Body("block", mass.symbol, centroid, inertia.symbol, ROTATION.position)]

    return rocking_structure(
        name="tall_block",
        title="A block",
        parameters=(mass, half_width, height, inertia, GRAVITY),
        coordinates=(ROTATION,),
        bodies=bodies,
        half_width=half_width.symbol,
        gravity=GRAVITY.symbol,
    )


def test_two_models_of_one_name_are_two_programs():
    """Declared anew with other equations in the same session: no name decides what is run."""
    y, found = np.array([0.1, 0.2]), {}
    for stretch in (1, 2):
        structure = rk.structure(
            tall_block(sp.Integer(stretch)),
            mass=1.0, half_width=0.25, height=0.5, inertia=0.3, gravity=9.81,
        )  # fmt: skip
        block = rk.RigidBlock(half_width=0.25, half_height=0.5 * stretch, inertia=0.3, gravity=9.81)
        name = "_".join(programs._key(structure.module, "DOP853", programs.LOOP))
        rates = np.zeros(2)
        structure.module.rates(structure.mode_number(y), y, structure.vector, 1.0, 0.5, rates)
        expected = block.accelerations({"theta": 0.1, "theta_dot": 0.2}, 1.0, 0.5)["theta"]
        assert rates.tolist() == [0.2, pytest.approx(expected, rel=1e-13)]
        found[name] = expected
    assert len(found) == 2
    assert len({*found.values()}) == 2


def test_text_that_does_not_run_leaves_nothing_behind():
    for _ in range(2):
        with pytest.raises(ZeroDivisionError):
            load_text("broken", "1 / 0\n")
    assert not [name for name in sys.modules if name.startswith("rockeom_broken")]
    one, two = load_text("probe", "VALUE = 1\n"), load_text("probe", "VALUE = 2\n")
    assert (one.VALUE, two.VALUE) == (1, 2)
    assert load_text("probe", "VALUE = 1\n") is one


def test_every_file_that_has_part_in_a_program_is_in_its_name():
    """One that is imported to make it and left out would keep old machine code in use."""
    code = """
import sys
import rockeom.generated.rigid_block as module
from rockeom.integrator import printing, program as programs

keys = set()
for method, part in (("DOP853", programs.GLUE), ("DOP853", programs.VECTORS),
                     ("DOP853", programs.TANGENTS), ("Radau", programs.LOOP)):
    of_part = {*programs._sources(module, method, part, False)}
    roots, modules, _ = programs.linked(module, method, part)
    printed = [text.name for text in modules.closure(roots) if text.alone]
    assert len(printed) > 9
    assert not [name for name in printed if open(f"rockeom/{name}").read() not in of_part]
    assert open(module.__file__).read() in of_part
    printing.printed(module, method, part)
    keys |= of_part
paths = {name: sys.modules[name].__file__ for name in sys.modules if name.startswith("rockeom.")}
print(*sorted(name for name, path in paths.items() if open(path).read() not in keys))
"""
    done = subprocess.run(
        [sys.executable, "-c", code], cwd=ROOT, capture_output=True, text=True, check=True
    )
    # packages have no text; nothing follows from errors, the files of the cache, the version
    assert [name for name in done.stdout.split() if not name.startswith("rockeom.numbers")] == [
        "rockeom.files", "rockeom.generated", "rockeom.integrator", "rockeom.integrator.lanes",
        "rockeom.version",
    ]  # fmt: skip
