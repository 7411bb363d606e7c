"""Work that an interrupt ends early, or that gives no answer: nothing that follows is a verdict."""

from __future__ import annotations

import ast
import functools
import shutil
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
import xarray as xr
from scipy.stats import norm

import rockeom as rk
from rockeom import analysis, plots
from rockeom.analysis import design, dynamics, risk
from rockeom.analysis.design import envelope, fema_356
from rockeom.analysis.dynamics import branches as branches_module
from rockeom.cli import main
from rockeom.sweeps.results import Results
from rockeom.thesis.figures import chapter_2_blocks, chapter_4_shaken
from tests.interrupts import interrupted_at

BLOCK = rk.RigidBlock(half_width=0.5, half_height=2.0, mass=1000.0)
PULSES = [rk.GroundMotion.single_sine(a, 1.0, duration=4.0) for a in (2.6, 2.7, 2.8, 2.9, 30.0)]


def pulse(amplitude: float) -> rk.Case:
    return rk.Case(BLOCK, rk.GroundMotion.single_sine(amplitude, 1.0, duration=4.0))


def shaken(beta: float, cycles: int = 1) -> dynamics.StroboscopicMap:
    return chapter_2_blocks.stroboscope(beta)


AMPLITUDES = np.linspace(2.0, 30.0, 40)
RANDOM = {"amplitude": norm(3.0, 0.3)}


@pytest.fixture
def interrupted(monkeypatch):
    """Every sweep ends after the first of its parts, every branch after the first of its steps."""

    def interrupt(parts: int = 2) -> None:
        monkeypatch.setattr(Results, "run", interrupted_at(parts, Results.run))
        follower = branches_module._Follower
        monkeypatch.setattr(follower, "next", interrupted_at(parts, follower.next))

    return interrupt


# --- calls that run sweeps or branches for an answer of their own


def doublings() -> dynamics.Cascade:
    return dynamics.period_doublings(shaken, (2.0, 3.26), chapter_2_blocks.symmetric_state())


ANSWERS = {
    "restitution_envelope": lambda: design.restitution_envelope(BLOCK, PULSES, [0.8, 0.85, 0.9]),
    "fema_356": lambda: design.fema_356_against_integration(BLOCK, PULSES),
    "monte_carlo": lambda: risk.monte_carlo(
        pulse, RANDOM, 60, sweep_options=rk.SweepOptions(threads=1, chunk=10)
    ),
    "reliability_of": lambda: risk.reliability_of(pulse, RANDOM),
    "period_doublings": doublings,
    "bifurcation_value": lambda: dynamics.bifurcation_value(
        shaken, (2.0, 3.26), chapter_2_blocks.symmetric_state()
    ),
    "changes of fate": lambda: chapter_2_blocks.changes_of_fate.__wrapped__(
        "amplitude", 0.1, 0.6, 40, slenderness=4.0, period=2.0, ratio=None
    ),
    "branches": lambda: chapter_2_blocks.branches.__wrapped__(1),
    "branches by energy": lambda: chapter_2_blocks.branches_by_energy.__wrapped__(),
    "branches of the wall": lambda: chapter_4_shaken.branches_of(4.553, chapter_4_shaken.DOUBLING),
    "figure 4-71": chapter_4_shaken.figure_4_71,
}


@pytest.mark.parametrize("name", ANSWERS)
def test_interrupt_leaves_no_answer(name, interrupted):
    chapter_2_blocks.symmetric_state()
    interrupted()
    with pytest.raises(KeyboardInterrupt):
        ANSWERS[name]()


@pytest.mark.parametrize("step", [2, 5, 30])
def test_cascade_that_is_interrupted_at_any_step_has_no_doublings(step, interrupted):
    interrupted(step)
    with pytest.raises(KeyboardInterrupt):
        doublings()


@pytest.mark.parametrize("number", ["2-12", "2-13"])
def test_interrupted_command_prints_no_verdict(number, interrupted, monkeypatch, capsys, tmp_path):
    monkeypatch.setattr(chapter_2_blocks, "AMPLITUDES", np.array([3.0, 3.26]))
    for name in ("cascade", "branches", "branches_by_energy", "changes_of_fate"):
        of = getattr(chapter_2_blocks, name)
        monkeypatch.setattr(chapter_2_blocks, name, of.__wrapped__)
    interrupted(3)
    monkeypatch.chdir(tmp_path)
    assert main(["thesis", "figure", number]) == 130
    out, err = capsys.readouterr()
    assert "holds" not in out
    assert err.splitlines()[-1] == "interrupted"
    assert not [*tmp_path.iterdir()]


def test_interrupt_before_a_command_begins_has_its_exit_code(monkeypatch, capsys):
    monkeypatch.setattr("rockeom.cli._parser", interrupted_at(1, lambda: None))
    assert main(["models"]) == 130
    assert capsys.readouterr().err == "interrupted\n"


# --- calls that return what is done, for the user to go on with

PARTIAL = {
    "simulate_many": lambda: rk.simulate_many(
        pulse, {"amplitude": AMPLITUDES}, sweep_options=rk.SweepOptions(threads=1, chunk=5)
    ),
    "rocking_spectrum": lambda: analysis.rocking_spectrum(
        PULSES,
        np.linspace(1.0, 4.0, 8),
        alpha=0.25,
        sweep_options=rk.SweepOptions(threads=1, chunk=5),
    ),
    "poincare_sections": lambda: dynamics.poincare_sections(
        shaken(2.0), starts={"x": np.linspace(-0.3, 0.3, 5)}, settling=4, cycles=2, threads=1
    ),
    "orbit_branch": lambda: dynamics.orbit_branch(
        shaken, (2.0, 3.0), chapter_2_blocks.symmetric_state()
    ),
}


@pytest.mark.parametrize("name", PARTIAL)
def test_part_of_a_result_says_that_it_is_one(name, interrupted):
    chapter_2_blocks.symmetric_state()
    interrupted()
    found = PARTIAL[name]()
    if isinstance(found, xr.Dataset):
        assert found.attrs["interrupted"] == 1
        assert (found.outcome == "not run").any()
    else:
        assert found.interrupted


RUN = {
    "simulate_many",
    "orbit_branch",
    "switched",
    "overturning_boundaries",
    "rocking_spectrum",
    "poincare_sections",
    "lyapunov_spectrum",
}
"""Functions whose result after an interrupt is a part of the whole."""

HANDED_ON = {("rocking_spectrum", "simulate_many"), ("_swept", "simulate_many")}
"""Functions that hand it on to the user, with `attrs` that say so."""


def calls(path: Path) -> Iterator[tuple[str, str, bool]]:
    """Function, the one of `RUN` it calls, and whether the call is the argument of `finished`."""
    tree = ast.parse(path.read_text())
    wrapped = {
        id(part)
        for node in ast.walk(tree)
        if isinstance(node, ast.Call) and name_of(node) == "finished"
        for part in ast.iter_child_nodes(node)
    }
    wrapped |= {  # finished(one(...) for ...)
        id(node.elt) for node in ast.walk(tree)
        if isinstance(node, ast.GeneratorExp) and id(node) in wrapped
    }  # fmt: skip
    for function in ast.walk(tree):
        if isinstance(function, ast.FunctionDef):
            for node in ast.walk(function):
                if isinstance(node, ast.Call) and name_of(node) in RUN:
                    yield function.name, name_of(node), id(node) in wrapped


def name_of(call: ast.Call) -> str:
    return getattr(call.func, "attr", None) or getattr(call.func, "id", "")


def test_every_sweep_in_the_package_is_whole_or_handed_on():
    root = Path(rk.__file__).parent
    found = [
        (path.name, *call)
        for part in ("analysis", "thesis", "plots", "cli")
        for path in (root / part).rglob("*.py")
        for call in calls(path)
    ]
    assert len(found) > 10
    bare = {(file, *call) for file, *call, whole in found if not whole}
    assert {tuple(call) for _, *call in bare} == HANDED_ON


# --- reducers of the user's dataset


@functools.cache
def partly_run() -> xr.Dataset:
    """A sweep of 40 amplitudes of which the last 12 were not run."""
    found = rk.simulate_many(pulse, {"amplitude": AMPLITUDES})
    found["outcome"][-12:] = "not run"
    return found.assign_coords(motion=("amplitude", ["one"] * 40))


def partly_looked() -> xr.Dataset:
    how = {"starts": {"x": np.linspace(-0.3, 0.3, 40)}, "settling": 2, "cycles": 2}
    found = dynamics.poincare_sections(shaken(2.0), **how)
    found["outcome"][-12:] = "not run"
    return found


REDUCERS = {
    "fragility_of": lambda: analysis.fragility_of(partly_run(), intensity="amplitude"),
    "overturning_boundaries": lambda: analysis.overturning_boundaries(pulse, partly_run()),
    "basins": lambda: dynamics.basins(partly_looked()),
    "fragility_curve": lambda: plots.fragility_curve(partly_run(), intensity="amplitude"),
    "rocking_spectrum": lambda: plots.rocking_spectrum(partly_run(), x="amplitude", alpha=0.24),
    "incremental_dynamic_analysis": lambda: plots.incremental_dynamic_analysis(
        partly_run(), intensity="amplitude", record="motion"
    ),
    "poincare_section": lambda: plots.poincare_section(partly_looked(), x="x", y="x_dot"),
}


@pytest.mark.parametrize("name", REDUCERS)
def test_unfinished_sweep_is_refused_with_the_number_of_cases_and_the_remedy(name):
    with pytest.raises(ValueError, match=r"12 of 40 cases were not run.*with the same store"):
        REDUCERS[name]()


def test_least_amplitude_of_an_interrupted_search_is_refused(interrupted):
    sweep = rk.simulate_many(pulse, {"amplitude": AMPLITUDES})
    whole = analysis.overturning_boundaries(pulse, sweep, accuracy=1e-3, threads=1)
    assert whole.attrs["interrupted"] == 0
    interrupted()
    part = analysis.overturning_boundaries(pulse, sweep, accuracy=1e-3, threads=1)
    assert part.attrs["interrupted"] == 1
    with pytest.raises(ValueError, match="was interrupted: give them to overturning_boundaries"):
        dynamics.minimum_overturning(part, x="motion", y="amplitude")


# --- motions that were run and gave no answer


@pytest.fixture
def few_impacts(monkeypatch):
    """Sweeps whose motions end without an answer at the second impact."""
    short = functools.partial(rk.simulate_many, options=rk.SolverOptions(max_impacts=2))
    for procedure in (envelope, fema_356):
        monkeypatch.setattr(procedure, "simulate_many", short)


@pytest.mark.usefixtures("few_impacts")
def test_envelope_of_motions_without_an_answer_is_refused():
    with pytest.raises(ValueError, match=r"8 of 10 motions give no answer.*'too many impacts' at"):
        design.restitution_envelope(BLOCK, PULSES, [0.8, 0.9])


@pytest.mark.usefixtures("few_impacts")
def test_comparison_with_motions_without_an_answer_says_so():
    found = design.fema_356_against_integration(BLOCK, PULSES)
    assert found.answered.tolist() == [False] * 4 + [True]
    assert np.isnan(found.ratio).all()
    assert "1 overturned; 4 without an answer (4 too many impacts), 5 if they did" in str(found)
    assert str(found).count("too many impacts") == 5


# --- stores


def kept(store: Path) -> xr.Dataset:
    return rk.simulate_many(
        pulse, {"amplitude": AMPLITUDES}, impact_times=2,
        sweep_options=rk.SweepOptions(store=store, chunk=10),
        impact_states=True, quantities=["displacement"], times=[0.5],
    )  # fmt: skip


def test_chunk_of_a_store_that_lacks_a_file_is_run_again(tmp_path):
    """Of any of its arrays, also of those that hold nothing but zeros."""
    pytest.importorskip("zarr")
    store = tmp_path / "kept.zarr"
    whole = kept(store)
    names = sorted(path.name for path in store.iterdir() if path.is_dir())
    assert len(names) >= 12
    for name in names:
        of_second = store / name / "c" / "1"
        (lost,) = [path for path in (of_second, *of_second.rglob("*")) if path.is_file()]
        lost.unlink()
        assert kept(store).identical(whole), name
        assert lost.exists(), name


def test_store_without_one_of_its_arrays_is_refused_by_name(tmp_path):
    pytest.importorskip("zarr")
    store = tmp_path / "kept.zarr"
    kept(store)
    shutil.rmtree(store / "final")
    with pytest.raises(ValueError, match="final' is missing: the store is damaged, give another"):
        kept(store)
