"""Interrupted or lost work is never a verdict; files are whole or refused; names are data."""

import ast
import os
import stat
import subprocess
import sys
import threading
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import rockeom as rk
from rockeom import analysis
from rockeom.analysis import branches
from rockeom.numeric import ensemble, machine, program
from rockeom.symbolic import coordinate, parameter
from rockeom.writing import written_whole
from tests.interrupts import interrupted_at

BLOCK = rk.RigidBlock(half_width=0.5, half_height=2.0)


def pulse_of(amplitude):
    return rk.GroundMotion.single_sine(amplitude, 1.0, duration=4.0)


PULSES = [pulse_of(amplitude) for amplitude in (2.5, 3.0, 3.5)]

KEEPS_THE_MARK = {"sections.py": 1, "overturning.py": 1}
"""Callers that hand the sweep with its mark `interrupted` to the user."""


def test_who_reduces_a_sweep_to_an_answer_raises_an_interrupt():
    root = Path(rk.__file__).parent
    found = {}
    for package in ("analysis", "thesis", "plots", "cli"):
        for path in (root / package).rglob("*.py"):
            calls = [
                n.func for n in ast.walk(ast.parse(path.read_text())) if isinstance(n, ast.Call)
            ]
            n = sum(getattr(f, "id", getattr(f, "attr", "")) == "simulate_many" for f in calls)
            if n:
                found[path.name] = n
    assert found == KEEPS_THE_MARK


@pytest.fixture
def interrupted(monkeypatch):
    """Every sweep is interrupted within its second case."""
    real = ensemble.simulate_many

    def soon(case, over, **how):
        return real(interrupted_at(2, case), over, **how | {"threads": 1, "arrays": False})

    monkeypatch.setattr(ensemble, "simulate_many", soon)


def test_interrupted_procedures_give_no_answer(interrupted):
    from scipy.stats import norm

    with pytest.raises(KeyboardInterrupt):
        analysis.restitution_envelope(BLOCK, PULSES, [0.8, 0.9])
    with pytest.raises(KeyboardInterrupt):
        analysis.monte_carlo(
            lambda half_width: rk.Case(replace(BLOCK, half_width=half_width), PULSES[0]),
            {"half_width": norm(0.5, 0.01)}, number=4,
        )  # fmt: skip


def test_interrupted_sweep_has_no_fragility():
    over = {"amplitude": np.linspace(1.0, 6.0, 8)}
    pulse = interrupted_at(
        5,
        lambda amplitude: rk.Case(BLOCK, pulse_of(amplitude)),
    )
    found = rk.simulate_many(pulse, over, threads=1, chunk=1)
    with pytest.raises(ValueError, match="interrupted"):
        analysis.fragility_of(found, intensity="amplitude")


def test_run_that_ended_early_has_no_envelope(monkeypatch):
    real = ensemble.simulate_many
    short = rk.SolverOptions(max_impacts=1)
    monkeypatch.setattr(ensemble, "simulate_many", lambda *a, **k: real(*a, **k, options=short))
    with pytest.raises(ValueError, match="too many impacts"):
        analysis.restitution_envelope(BLOCK, PULSES, [0.9])


@pytest.mark.parametrize("name", ["period_doublings", "bifurcation_value"])
def test_interrupted_branch_has_no_bifurcations(monkeypatch, name):
    class Branch:
        ended, bifurcations, values = branches.INTERRUPTED, (), [0.0]
        completed = branches.OrbitBranch.completed

    monkeypatch.setattr(branches, "orbit_branch", lambda *_, **__: Branch())
    with pytest.raises(KeyboardInterrupt):
        getattr(branches, name)(None, (0.0, 1.0), {})


@pytest.mark.parametrize("name", ["final", "peaks", "impacts"])
def test_lost_chunk_of_a_store_is_run_again(tmp_path, name):
    pytest.importorskip("zarr")

    def swept():
        return rk.simulate_many(
            lambda amplitude: rk.Case(BLOCK, pulse_of(amplitude)),
            {"amplitude": np.linspace(1.0, 6.0, 8)}, store=tmp_path / "s.zarr", chunk=2, threads=1,
        )  # fmt: skip

    first = swept()
    lost = [p for p in (tmp_path / "s.zarr" / name / "c" / "1").rglob("*") if p.is_file()]
    for path in lost or [tmp_path / "s.zarr" / name / "c" / "1"]:
        path.unlink()
    assert swept().identical(first)


@pytest.mark.skipif(not hasattr(os, "fork"), reason="no fork")
def test_child_forked_while_another_thread_compiles(monkeypatch):
    inside, go_on = threading.Event(), threading.Event()

    def slow(*_):
        inside.set()
        go_on.wait(10)

    monkeypatch.setattr(program, "_of_parts", slow)
    thread = threading.Thread(target=program.program, args=(None, "DOP853"))
    thread.start()
    inside.wait(10)
    threading.Timer(0.3, go_on.set).start()
    pid = os.fork()
    if pid == 0:
        os._exit(0 if program._LOCK.acquire(timeout=5) else 1)
    thread.join()
    assert os.waitstatus_to_exitcode(os.waitpid(pid, 0)[1]) == 0


FULL_DISK = """
import resource, signal, sys
import rockeom as rk
run = rk.simulate(rk.RigidBlock(half_width=.5, half_height=2.), rk.GroundMotion.none(3.0),
                  initial={"theta": .1})
signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
resource.setrlimit(resource.RLIMIT_FSIZE, (4096, 4096))
try:
    run.save(sys.argv[1])
except OSError as error:
    print("told", *error.__notes__)
"""


@pytest.mark.skipif(sys.platform == "win32", reason="no limits of files")
def test_full_disk_keeps_the_old_file_and_the_interpreter(tmp_path):
    pytest.importorskip("h5netcdf")
    path = tmp_path / "run.nc"
    path.write_text("old")
    done = subprocess.run(
        [sys.executable, "-c", FULL_DISK, path], capture_output=True, text=True, timeout=120
    )
    assert done.returncode == 0, done.stderr
    assert "told" in done.stdout
    assert str(path) in done.stdout
    assert path.read_text() == "old"
    assert list(tmp_path.iterdir()) == [path]


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="no pipes")
def test_only_regular_files_are_replaced(tmp_path):
    pipe = tmp_path / "pipe.nc"
    os.mkfifo(pipe)
    for path in (pipe, tmp_path, Path("/dev/null")):
        with pytest.raises(OSError, match="no regular file"), written_whole(path):
            pass
    assert stat.S_ISFIFO(pipe.stat().st_mode)


@pytest.mark.parametrize("symbol", [r"\input{secret}", r"x\write18{rm}", "<b>x</b>", "x$y", r"\\"])
def test_symbols_run_nothing_in_latex(symbol):
    for declare in (lambda: parameter(symbol, "size", "m", "size"),
                    lambda: coordinate(symbol, "size", "m", "size")):  # fmt: skip
        with pytest.raises(ValueError, match="symbol"):
            declare()


def test_hostile_words_are_data_in_markdown():
    from rockeom.symbolic.page import Heading, Table, to_markdown

    hostile = "<img src=x onerror=alert(1)>"
    page = to_markdown([Heading(1, hostile), hostile, Table(("Name",), (("$" + hostile + "$",),))])
    assert "<img" not in page
    assert page.count("&lt;img") == 3


def test_machine_is_loaded_under_the_lock_of_programs():
    """No other module loads machine code, so that no fork comes between."""
    calls = [
        p.name for p in Path(machine.__file__).parent.glob("*.py") if "Loaded(" in p.read_text()
    ]
    assert calls == ["program.py"]
