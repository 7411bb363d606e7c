"""Work that an interrupt ends early, or that gives no answer: nothing that follows is a verdict."""

import ast
import functools
import shutil
from collections.abc import Callable, Iterator
from contextlib import suppress
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import xarray as xr
from scipy.stats import norm, uniform

import rockeom as rk
from rockeom import analysis, plots
from rockeom.analysis import design, dynamics, risk
from rockeom.analysis.design import envelope, fema_356
from rockeom.analysis.dynamics import branches as branches_module
from rockeom.analysis.identification import Observed, posterior
from rockeom.analysis.validation import Campaign, Ensemble, simulate_campaign
from rockeom.assessment.plane import in_plane
from rockeom.cli import main
from rockeom.motion import MotionSet
from rockeom.sweeps.results import Results
from rockeom.thesis.figures import chapter_2_blocks, chapter_4_shaken
from tests.interrupts import Interrupting, interrupted_at

BLOCK = rk.RigidBlock(half_width=0.5, half_height=2.0, mass=1000.0)
PRISM = rk.Prism(width=1.0, depth=1.4, height=4.0, mass=1000.0)
RECORDING = rk.Recording(
    "El Centro", tuple(rk.GroundMotion.from_library(f"El Centro 1940 {way}") for way in (180, 270))
)
PULSES = [rk.GroundMotion.single_sine(a, 1.0, duration=4.0) for a in (2.6, 2.7, 2.8, 2.9, 30.0)]


def pulse(amplitude: float) -> rk.Case:
    return rk.Case(BLOCK, rk.GroundMotion.single_sine(amplitude, 1.0, duration=4.0))


def shaken(beta: float, cycles: int = 1) -> dynamics.StroboscopicMap:
    return chapter_2_blocks.stroboscope(beta)


AMPLITUDES = np.linspace(2.0, 30.0, 40)
RANDOM = {"amplitude": norm(3.0, 0.3)}
RANDOM_E = {"restitution": uniform(0.7, 0.2)}


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


def command(words: str) -> None:
    """A command line, whose code says that it was interrupted."""
    first, *rest = words.split()
    block = ["rigid_block", "--set", "half_width=0.5", "half_height=2.0"]
    if main([first, *block, *rest]) == 130:
        raise KeyboardInterrupt


RECORD = "El Centro 1940 180"
ONE_BY_ONE = rk.SweepOptions(threads=1, chunk=5)
MOTIONS = MotionSet(PULSES)
CAMPAIGN = Campaign(MOTIONS.names, MOTIONS.names, MOTIONS, Ensemble(np.full(5, 0.1)))
FORMULA = posterior(Observed.formula(lambda r: [r], [0.8], noise=0.1), {"r": uniform(0.7, 0.2)})


@functools.cache
def assessed() -> Any:
    """An assessment in space, whose planar answer is asked again."""
    return rk.assess(PRISM, [RECORDING], pga="0.3 g", azimuths=1)


QUICK = {
    "assess": lambda: rk.assess(BLOCK, PULSES, pga=["0.3 g", "0.6 g"]),
    "rockeom assess": lambda: command(f"assess --records {RECORD} --pga 0.4g"),
    "rockeom fragility": lambda: command(f"fragility --records {RECORD} --pga 0.1g 0.4g"),
    "rockeom sweep": lambda: command(f"sweep --record {RECORD} --over mass=1,2"),
    "restitution_envelope": lambda: design.restitution_envelope(BLOCK, PULSES, [0.8, 0.85, 0.9]),
    "fema_356": lambda: design.fema_356_against_integration(BLOCK, PULSES),
    "monte_carlo": lambda: risk.monte_carlo(pulse, RANDOM, 60, sweep_options=ONE_BY_ONE),
    "reliability_of": lambda: risk.reliability_of(pulse, RANDOM),
    "simulate_campaign": lambda: simulate_campaign(CAMPAIGN, pulse(1.0), RANDOM_E, 20),
    "bifurcation_value": lambda: dynamics.bifurcation_value(
        shaken, (2.0, 3.26), chapter_2_blocks.symmetric_state()
    ),
    "changes of fate": lambda: chapter_2_blocks.changes_of_fate.__wrapped__(
        "amplitude", 0.1, 0.6, 40, slenderness=4.0, period=2.0, ratio=None
    ),
}

ANSWERS = QUICK | {
    "planar answer": lambda: in_plane(PRISM, assessed().conditions, assessed().trials, 0.95),
    "period_doublings": doublings,
    "branches": lambda: chapter_2_blocks.branches.__wrapped__(1),
    "branches by energy": lambda: chapter_2_blocks.branches_by_energy.__wrapped__(),
    "branches of the wall": lambda: chapter_4_shaken.branches_of(4.553, chapter_4_shaken.DOUBLING),
    "peaks by ratio": lambda: chapter_4_shaken.peaks_by_ratio.__wrapped__(),
}
QUICK["sample"] = lambda: FORMULA.sample(60, chains=1, warm_up=10)  # no sweep


@pytest.fixture
def alone(monkeypatch):
    """Work is done in the thread that calls."""
    monkeypatch.setattr("os.cpu_count", lambda: 1)


def drawn_calls(name: str, function: Callable[[], Any], number: int) -> tuple[Any, list[int]]:
    """The whole result, and which calls of functions on the way to it are interrupted."""
    function()  # what is cached is there
    with Interrupting() as counted:
        whole = function()
    rng = np.random.default_rng([*name.encode()])
    return whole, rng.integers(2, max(3, int(0.95 * counted.calls)), number).tolist()


@pytest.mark.usefixtures("alone")
@pytest.mark.parametrize("name", QUICK)
def test_interrupt_at_any_time_leaves_no_answer(name):
    for call in drawn_calls(name, QUICK[name], 8)[1]:
        with Interrupting(call) as interrupting, pytest.raises(KeyboardInterrupt):
            QUICK[name]()
        assert interrupting.calls == call


def test_every_caller_of_a_sweep_in_the_package_raises_the_interrupt(interrupted):
    """Calls of functions that return to users what is done; all callers are interrupted here."""
    chapter_2_blocks.symmetric_state(), whole_sweep(), symmetric(), assessed()
    called = set()
    for name, function in (ANSWERS | PARTIAL).items():
        interrupted(1 if name == "planar answer" else 2)  # of one motion
        either = pytest.raises if name in ANSWERS else suppress
        with Interrupting() as everything, either(KeyboardInterrupt):
            function()
        called |= everything.called
    assert {*PARTIAL} == {name.strip("_") for name in decorated()}
    assert not {*callers()} - called


def test_interrupt_is_raised_out_of_a_sweep_in_a_function_that_the_package_runs(interrupted):
    """Where a user's model sweeps, its part is no value of the model."""

    def model(r):
        sweep = rk.simulate_many(pulse, {"amplitude": AMPLITUDES}, sweep_options=ONE_BY_ONE)
        return [r * (sweep.outcome == "overturned").mean().item()]

    interrupted()
    with pytest.raises(KeyboardInterrupt):
        posterior(Observed.formula(model, [0.8], noise=0.1), {"r": uniform(0.7, 0.2)})


@functools.cache
def functions_of_the_package() -> list[tuple[Path, ast.FunctionDef]]:
    return [
        (path, node)
        for path in Path(rk.__file__).parent.rglob("*.py")
        for node in ast.walk(ast.parse(path.read_text("utf-8")))
        if isinstance(node, ast.FunctionDef)
    ]


def name_of(node: Any) -> str:
    return getattr(node, "attr", None) or getattr(node, "id", "")


def decorated() -> Iterator[str]:
    """Functions that return to users what an interrupt leaves."""
    for _, function in functions_of_the_package():
        if any(name_of(one) == "part_for_users" for one in function.decorator_list):
            yield function.name


def callers() -> Iterator[tuple[str, str]]:
    """File and name of functions of the package that call one of these."""
    for path, function in functions_of_the_package():
        for node in ast.walk(function):
            if isinstance(node, ast.Call) and name_of(node.func) in PARTIAL:
                yield path.name, function.name


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


@functools.cache
def whole_sweep() -> xr.Dataset:
    return rk.simulate_many(pulse, {"amplitude": AMPLITUDES})


def boundaries(known: xr.Dataset | None = None) -> xr.Dataset:
    sweep = whole_sweep() if known is None else known
    return analysis.overturning_boundaries(pulse, sweep, accuracy=1e-3, threads=1)


def spectrum(start: Any = None) -> dynamics.LyapunovSpectrum:
    start = {"x": 0.1} if start is None else start
    return dynamics.lyapunov_spectrum(shaken(2.0), start, cycles=30, settling=0)


@functools.cache
def symmetric() -> dynamics.OrbitBranch:
    return dynamics.orbit_branch(shaken, (2.0, 3.26), chapter_2_blocks.symmetric_state(), step=0.1)


PARTIAL = {
    "simulate_many": lambda: rk.simulate_many(
        pulse, {"amplitude": AMPLITUDES}, sweep_options=ONE_BY_ONE
    ),
    "rocking_spectrum": lambda: analysis.rocking_spectrum(
        PULSES, np.linspace(1.0, 4.0, 8), alpha=0.25, sweep_options=ONE_BY_ONE
    ),
    "poincare_sections": lambda: dynamics.poincare_sections(
        shaken(2.0), starts={"x": np.linspace(-0.3, 0.3, 5)}, settling=4, cycles=2, threads=1
    ),
    "overturning_boundaries": boundaries,
    "lyapunov_spectrum": spectrum,
    "orbit_branch": lambda: dynamics.orbit_branch(
        shaken, (2.0, 3.0), chapter_2_blocks.symmetric_state(), step=0.1
    ),
    "switched": lambda: symmetric().switched(symmetric().bifurcations[0], (2.0, 2.8), step=0.1),
}


def done(result: Any) -> bool:
    interrupted = getattr(result, "interrupted", None)
    return not (result.attrs["interrupted"] if interrupted is None else interrupted)


def assert_begins(part: Any, whole: Any) -> None:
    """A part is the whole result as far as it goes, to the last bit, or goes on to become it."""
    if isinstance(part, dynamics.OrbitBranch):
        n = len(part.values)
        np.testing.assert_array_equal(part.values, whole.values[:n])
    elif isinstance(part, dynamics.LyapunovSpectrum):
        np.testing.assert_array_equal(spectrum(part).growth[:30], whole.growth)
    elif "low" in part:
        assert boundaries(part).identical(whole)
    else:
        for name in part.data_vars:
            there, right = part[name].values, whole[name].values
            ran = np.isfinite(there) if name == "strobe" else part["outcome"].values != "not run"
            np.testing.assert_array_equal(there[ran], right[ran], name)


@pytest.mark.usefixtures("alone")
@pytest.mark.parametrize("name", PARTIAL)
def test_part_of_a_result_says_that_it_is_one_and_is_right(name):
    whole, calls = drawn_calls(name, PARTIAL[name], 12)
    assert done(whole)
    parts = []
    for call in calls:
        try:
            with Interrupting(call):
                parts.append(PARTIAL[name]())
        except KeyboardInterrupt:  # before there was a part, or when it was put together
            continue
        assert not done(parts[-1])
        assert_begins(parts[-1], whole)
    assert len(parts) > 3


# --- reducers of the user's dataset


@functools.cache
def partly_run() -> xr.Dataset:
    """A sweep of 40 amplitudes of which the last 12 were not run."""
    found = whole_sweep().copy(deep=True)
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
    assert done(boundaries())
    interrupted()
    part = boundaries()
    assert not done(part)
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
    names = sorted(path.name for path in store.iterdir() if (path / "c").is_dir())
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
