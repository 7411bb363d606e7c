"""Mistakes of newcomers at every public entry: each is answered by the package, with a remedy.

None is silent, and none is answered by Python, NumPy or another library: the error is raised in a
file of the package, and its message names the argument, the value or what to write instead.
"""

import traceback
from collections import Counter
from collections.abc import Callable
from functools import cache
from pathlib import Path
from typing import Any, NamedTuple

import matplotlib.pyplot as plt
import numpy as np
import pytest
import sympy as sp
import xarray as xr

import rockeom as rk
from rockeom import analysis, plots, symbolic

PACKAGE = Path(rk.__file__).parent
GM = rk.GroundMotion
BLOCK = rk.RigidBlock(half_width=0.1, half_height=0.4)
SINE = GM.single_sine(3.0, 0.5, duration=2.0)
RECORD = GM.from_array([0.0, 1.0, 2.0, -1.0, 0.0], 0.01)
CASE = rk.Case(BLOCK, SINE)
SET = rk.MotionSet([SINE])


@cache
def run() -> rk.Response:
    return rk.simulate(BLOCK, SINE)


def pulse(amplitude: float) -> rk.Case:
    return rk.Case(BLOCK, GM.single_sine(amplitude, 0.5, duration=2.0))


@cache
def sweep() -> Any:
    return rk.simulate_many(pulse, {"amplitude": [1.0, 5.0]})


def eurocode(damping_ratio: float) -> rk.DesignSpectrum:
    return rk.DesignSpectrum.eurocode_8("0.25 g", "B", damping_ratio=damping_ratio)


@cache
def assessment() -> rk.Assessment:
    return rk.assess(BLOCK, [SINE], pga=[3.0])


def lumped(**changes: Any) -> rk.Structure:
    values = {
        "mass": 1e3, "height": 2.0, "inertia": 0.0, "base_mass": 500.0, "base_height": 0.0,
        "base_inertia": 100.0, "half_width": 0.5,
    }  # fmt: skip
    return rk.LumpedMassStructure(**values | changes)


def frame(**changes: Any) -> rk.Structure:
    values = {
        "masses": [2e4, 2e4], "heights": [3.0, 6.0], "stiffnesses": [2e7, 2e7],
        "dampings": [1e4, 1e4], "half_width": 1.0, "base_mass": 1e4,
    }  # fmt: skip
    return rk.ShearFrame(**values | changes)


class Mistake(NamedTuple):
    """A call that is wrong, its kind, the error that answers it, and what the message says."""

    kind: str
    call: Callable[[], Any]
    error: type[Exception]
    says: tuple[str, ...]


NAME, TYPE, UNIT, SIGN = "wrong name", "wrong type", "wrong unit", "wrong sign"
SHAPE, VALUE, MISSING, FILE = "wrong shape", "wrong value", "missing value", "missing file"
KINDS = (NAME, TYPE, UNIT, SIGN, SHAPE, VALUE, MISSING, FILE)


def mistake(kind: str, call: Callable[[], Any], error: type[Exception], *says: str) -> Mistake:
    return Mistake(kind, call, error, says)


STRUCTURES = [
    mistake(
        MISSING, lambda: rk.RigidBlock(half_width=0.1), TypeError,
        "RigidBlock: missing half_height", "Height of the centroid above the base [m]",
    ),
    mistake(
        MISSING, lambda: rk.FlexibleStructure(mass=1.0, height=1.0), TypeError,
        "stiffness (Flexural stiffness of the column [N/m])", "half_width",
    ),
    mistake(
        NAME, lambda: rk.RigidBlock(width=0.2, height=0.8), TypeError,
        "unknown width", "RigidBlock.from_dimensions takes it",
    ),
    mistake(
        NAME, lambda: rk.RigidBlock(b=0.1, h=0.4), TypeError,
        "unknown b (did you mean half_width?)", "unknown h (did you mean half_height?)",
    ),
    mistake(
        NAME, lambda: rk.SlidingBlock(half_width=0.2, half_height=1.0, mu=0.5, e=0.0), TypeError,
        "unknown mu (did you mean friction?)", "unknown e (did you mean restitution?)",
    ),
    mistake(
        NAME, lambda: rk.SlenderBlock(p=2.0, alpha=0.2), TypeError,
        "unknown p", "SlenderBlock.from_frequency takes it",
    ),
    mistake(
        NAME, lambda: rk.RigidBlock.from_dimensions(width=0.6, heigth=2.0), TypeError,
        "missing height (Height of the whole block [m])", "did you mean height?",
    ),
    mistake(
        SIGN,
        lambda: rk.SlidingBlock(half_width=0.2, half_height=1.0, friction=-0.5, restitution=0.0),
        ValueError, "friction is -0.5", "zero or positive",
    ),
    mistake(
        VALUE,
        lambda: rk.SlidingBlock(half_width=0.2, half_height=1.0, friction=0.5, restitution=1.2),
        ValueError, "restitution = 1.2", "0 to 1",
    ),
    mistake(
        UNIT, lambda: rk.RigidBlock(half_width="10 cm", half_height=0.4), TypeError,
        "half_width is '10 cm'", "SI units",
    ),
    mistake(
        UNIT, lambda: rk.SlenderBlock(radius=1.0, alpha=14), ValueError,
        "alpha is 14", "alpha_degrees",
    ),
    mistake(
        SHAPE, lambda: rk.RigidBlock(half_width=[0.1, 0.2], half_height=0.4), TypeError,
        "half_width is [0.1, 0.2]", "give a number",
    ),
    mistake(
        TYPE, lambda: lumped(support=1e6), TypeError, "support is 1e+06", "rk.Pinned()",
    ),
    mistake(
        MISSING, lambda: rk.TwoSprings(stiffness=1e6), TypeError, "TwoSprings: missing damping",
    ),
    mistake(
        NAME, lambda: rk.Winkler(springs=4, k=1e6, c=0.0), TypeError,
        "unknown k (give stiffness=)", "unknown c (give damping=)",
    ),
    mistake(
        NAME, lambda: rk.structure("RigidBlock", **{"half_width": 0.1}), ValueError,
        "no structure named 'RigidBlock'", "did you mean rigid_block?",
    ),
    mistake(
        TYPE, lambda: rk.structure(rk.RigidBlock, half_width=0.1), TypeError,
        "the class RigidBlock", "the name of a structure",
    ),
    mistake(
        NAME, lambda: BLOCK.widht, AttributeError, "'widht'", "did you mean 2 * half_width?",
    ),
    mistake(
        VALUE, lambda: setattr(BLOCK, "half_width", 0.2), AttributeError,
        "half_width cannot be set", "dataclasses.replace(it, half_width=0.2)",
    ),
    mistake(
        NAME, lambda: rk.FlexibleStructure.from_period(0.5, damping=0.05, mass=1e3), TypeError,
        "missing damping_ratio", "did you mean damping_ratio?",
    ),
    mistake(
        NAME, lambda: rk.FlexibleStructure.from_perid(0.5), AttributeError,
        "'FlexibleStructure' has no attribute 'from_perid'",
    ),
]  # fmt: skip

NAMES = [
    mistake(NAME, lambda: rk.RigidBlok, AttributeError, "did you mean RigidBlock?"),
    mistake(NAME, lambda: rk.Restitution, AttributeError, "did you mean VelocityRatio?"),
    mistake(NAME, lambda: rk.plot_response, AttributeError, "did you mean plots.plot_response?"),
    mistake(NAME, lambda: rk.fragility, AttributeError, "did you mean analysis.fragility_of?"),
    mistake(NAME, lambda: rk.Model, AttributeError, "did you mean rockeom.symbolic.Model?"),
    mistake(NAME, lambda: rk.Ricker, AttributeError, "did you mean GroundMotion.ricker?"),
    mistake(NAME, lambda: plots.plot_respons, AttributeError, "did you mean plot_response?"),
    mistake(NAME, lambda: symbolic.rigid_blok, AttributeError, "did you mean rigid_block?"),
    mistake(
        NAME, lambda: analysis.formulas.energy_ratio_of_blok, AttributeError,
        "did you mean energy_ratio_of_block?",
    ),
]  # fmt: skip

MOTIONS = [
    mistake(SIGN, lambda: GM.none(-1), rk.InputError, "duration is -1", "positive"),
    mistake(
        MISSING, lambda: GM.single_sine(3.0), TypeError,
        "GroundMotion.single_sine: missing period", "It takes amplitude, period",
    ),
    mistake(
        NAME, lambda: GM.single_sine(amplitude=3.0, frequency=2.0), TypeError,
        "unknown frequency (give period = 1/frequency)",
    ),
    mistake(
        MISSING, lambda: GM.kanai_tajimi(0.01, duration=10.0), TypeError,
        "missing seed (Seed; equal seeds give equal motions)",
    ),
    mistake(MISSING, lambda: GM.from_array([0.0, 1.0]), TypeError, "from_array: missing dt"),
    mistake(SHAPE, lambda: GM.from_array([], 0.01), rk.InputError, "two samples or more"),
    mistake(
        NAME, lambda: GM.from_array([0, 1, 0], 0.01, unit="g"), TypeError,
        "unknown unit (did you mean units?)",
    ),
    mistake(
        UNIT, lambda: GM.from_array([0, 1, 0], 0.01, units="G's"), rk.InputError,
        "units \"G's\" are unknown", "m/s2, g, cm/s2",
    ),
    mistake(
        FILE, lambda: GM.read("nofile.AT2"), rk.InputError,
        "nofile.AT2: there is no such file", "check the path",
    ),
    mistake(FILE, lambda: GM.read("words.txt"), rk.InputError, "words.txt, line 2", "two are"),
    mistake(FILE, lambda: GM.read("columns.csv"), rk.InputError, "say its units", "units="),
    mistake(
        FILE, lambda: GM.from_csv("columns.csv", time_column="t", acceleration_column="acc"),
        rk.InputError, "'acc'", "the names are 't', 'a'",
    ),
    mistake(NAME, lambda: GM.from_file("a.AT2"), AttributeError, "did you mean read(path)?"),
    mistake(
        NAME, lambda: GM.from_library("El Centroo 1940 180"), rk.InputError,
        "'centroo' is in no name (did you mean centro?)",
    ),
    mistake(NAME, lambda: SINE.pga, AttributeError, "did you mean peak?"),
    mistake(NAME, lambda: SINE.time, AttributeError, "did you mean sampled(dt)?"),
    mistake(SIGN, lambda: SINE.scaled_to(-1), rk.InputError, "peak is -1", "positive"),
    mistake(TYPE, lambda: SINE.filtered(low=0.1), rk.InputError, "no samples", "resampled(dt)"),
    mistake(SIGN, lambda: SINE.response_spectrum([-1.0]), ValueError, "periods[0] is -1"),
    mistake(
        UNIT, lambda: SINE.response_spectrum([1.0], damping_ratio=5), ValueError,
        "damping_ratio is 5", "give less",
    ),
    mistake(TYPE, lambda: rk.MotionSet(SINE), rk.InputError, "motions is", "give a list"),
    mistake(
        FILE, lambda: rk.MotionSet.from_folder("nowhere"), rk.InputError,
        "path is 'nowhere'",
    ),
    mistake(
        FILE, lambda: rk.MotionSet.from_folder(".", "*.xyz"), rk.InputError,
        "'*.xyz'", ".csv",
    ),
    mistake(NAME, lambda: SET.scaled_to("pgaa", 3.0), rk.InputError, "did you mean pga?"),
    mistake(VALUE, lambda: SET[3], IndexError, "no motion 3", "the set has 1"),
    mistake(
        SHAPE, lambda: rk.Recording("A", [SINE] * 3), rk.InputError,
        "3 horizontal", "one or two",
    ),
    mistake(
        MISSING, lambda: rk.DesignSpectrum.eurocode_8(), TypeError,
        "missing ground_acceleration", "ground_type",
    ),
    mistake(NAME, lambda: rk.DesignSpectrum.ec8(3.0, "B"), AttributeError, "eurocode_8"),
    mistake(
        SHAPE, lambda: rk.DesignSpectrum.from_table([0, 1], [1]), rk.InputError,
        "shape (2,)", "(1,)",
    ),
    mistake(MISSING, lambda: rk.floor_motion(RECORD), TypeError, "floor_motion: missing periods"),
]  # fmt: skip

LAWS = [
    mistake(
        NAME, lambda: rk.VelocityRatio(r=0.9), TypeError,
        "missing e (Coefficient of restitution, 0 to 1)", "give rk.EnergyRatio(r)",
    ),
    mistake(NAME, lambda: rk.EnergyRatio(e=0.9), TypeError, "give rk.VelocityRatio(e)"),
    mistake(SIGN, lambda: rk.VelocityRatio(-0.1), ValueError, "e is -0.1", "0 (no rebound)"),
    mistake(UNIT, lambda: rk.EnergyRatio(90), ValueError, "r is 90", "90 % is 0.9"),
    mistake(TYPE, lambda: rk.Impulsive(0.9), TypeError, "Impulsive: 0.9 is one too many"),
    mistake(SHAPE, lambda: rk.EnergyRatioAtSpeed([0.9]), TypeError, "three numbers for each"),
    mistake(VALUE, lambda: rk.RandomEnergyRatio([1.2]), ValueError, "values", "measured"),
]  # fmt: skip

SIMULATIONS = [
    mistake(
        VALUE, lambda: rk.simulate(CASE, SINE), TypeError,
        "structure is a case", "dataclasses.replace(case",
    ),
    mistake(
        NAME, lambda: rk.simulate(BLOCK, SINE, restitution=0.9), TypeError,
        "unknown restitution (give impact=rk.VelocityRatio(e))",
    ),
    mistake(
        NAME, lambda: rk.simulate(BLOCK, SINE, restitutoin=0.9), TypeError,
        "unknown restitutoin (did you mean impact=rk.VelocityRatio(e)?)",
    ),
    mistake(
        NAME, lambda: rk.simulate(BLOCK, SINE, durations=3.0), TypeError,
        "unknown durations (did you mean duration?)",
    ),
    mistake(
        NAME, lambda: rk.simulate(BLOCK, SINE, theta=0.1), TypeError, 'give initial={"theta": ...}',
    ),
    mistake(
        MISSING, lambda: rk.simulate(BLOCK, SINE, rk.EnergyRatio(0.9)), TypeError,
        "EnergyRatio(r=0.9) needs its name", "impact=",
    ),
    mistake(TYPE, lambda: rk.simulate(BLOCK, SET), TypeError, "motion is MotionSet"),
    mistake(
        NAME, lambda: rk.simulate(BLOCK, SINE, initial={"tetha": 0.1}), ValueError,
        "unknown state 'tetha' (did you mean theta?)",
    ),
    mistake(NAME, lambda: rk.SolverOptions(rtoll=1e-8), TypeError, "did you mean rtol?"),
    mistake(NAME, lambda: rk.SolverOptions(dt=0.01), TypeError, "give output_step= or max_step="),
    mistake(SIGN, lambda: rk.SolverOptions(rtol=-1), ValueError, "rtol is -1", "positive"),
    mistake(MISSING, lambda: rk.Case(BLOCK), TypeError, "Case: missing motion"),
    mistake(NAME, lambda: CASE.simulate(), AttributeError, "rk.simulate(case)"),
]  # fmt: skip

RESPONSES = [
    mistake(NAME, lambda: run()["tetha"], KeyError, "no quantity 'tetha' (did you mean theta?)"),
    mistake(TYPE, lambda: run()[0], KeyError, "0 is no quantity", "'theta'"),
    mistake(TYPE, lambda: run().at("end"), TypeError, "times is 'end'", "give numbers"),
    mistake(
        SHAPE, lambda: run().at(1.0, names="theta"), ValueError,
        "names is the word", "['theta']",
    ),
    mistake(VALUE, lambda: run().impacts[1000], IndexError, "no event 1000", "from 0 on"),
    mistake(TYPE, lambda: run().events["uplift"], TypeError, "event.kind == 'uplift'"),
    mistake(VALUE, lambda: setattr(run(), "theta", 0.0), AttributeError, "theta cannot be set"),
    mistake(
        FILE, lambda: run().save("nowhere/run.nc"), FileNotFoundError,
        "no folder nowhere", "make it",
    ),
    mistake(FILE, lambda: run().save("run.csv"), ValueError, "netCDF", "to_dataframe().to_csv"),
    mistake(MISSING, lambda: run().save(), TypeError, "Response.save: missing path"),
    mistake(TYPE, lambda: run().save(3), TypeError, "path is 3", "give the path"),
    mistake(
        FILE, lambda: rk.load("nofile.nc"), FileNotFoundError,
        "nofile.nc: there is no such file",
    ),
    mistake(FILE, lambda: rk.load("junk.nc"), ValueError, "junk.nc cannot be loaded", "cut off"),
    mistake(FILE, lambda: rk.load("foreign.nc"), ValueError, "not written by `run.save(path)`"),
    mistake(TYPE, lambda: rk.load(None), TypeError, "path is None"),
    mistake(NAME, lambda: run().plot("thet"), KeyError, "no quantity 'thet' (did you mean theta?)"),
    mistake(NAME, lambda: run().plot(axes=3), TypeError, "unknown axes (give ax)"),
    mistake(TYPE, lambda: run().plot(ax=3), TypeError, "ax is 3", "plt.subplots()"),
    mistake(
        VALUE, lambda: run().plot(start=1.0, end=0.5), ValueError,
        "start is 1: give less than the end, 0.5 s",
    ),
    mistake(FILE, lambda: run().animate("run.xyz"), ValueError, "run.xyz", ".gif, .html"),
    mistake(NAME, lambda: run().animate(fps=30), TypeError, "unknown fps (give frames_per_second)"),
    mistake(TYPE, lambda: plots.draw_structure(rk.RigidBlock), TypeError, "the class RigidBlock"),
    mistake(MISSING, lambda: plots.draw_structure(BLOCK, {"theta": 0.1}), TypeError, "state="),
    mistake(
        TYPE, lambda: plots.plot_response(BLOCK), TypeError,
        "run is RigidBlock", "rk.simulate",
    ),
    mistake(
        TYPE, lambda: plots.plot_motion([0, 1, 0]), TypeError,
        "motion is [", "from_array",
    ),
    mistake(
        TYPE, lambda: plots.plot_comparison(run()), TypeError,
        "runs is", "a list of responses",
    ),
    mistake(TYPE, lambda: plots.design_report(BLOCK, SINE), TypeError, "[motion]"),
]  # fmt: skip

SWEEPS = [
    mistake(
        MISSING, lambda: rk.simulate_many(pulse), TypeError,
        "missing over (A mapping of names to lists of values",
    ),
    mistake(
        SHAPE, lambda: rk.simulate_many(pulse, {"amplitude": 3.0}), TypeError,
        "list of values",
    ),
    mistake(
        NAME, lambda: rk.simulate_many(pulse, {"amp": [1.0]}), TypeError,
        "over has amp", "missing amplitude", "unknown amp",
    ),
    mistake(
        NAME, lambda: rk.simulate_many(CASE, {"half_widht": [0.1]}), ValueError,
        "'half_widht', which is unknown (did you mean half_width?)",
    ),
    mistake(
        SIGN, lambda: rk.simulate_many(CASE, {"half_width": [0.1, -1.0]}), ValueError,
        "half_width = -1", "must be finite and positive",
    ),
    mistake(
        VALUE, lambda: rk.simulate_many(CASE, {"restitution": [1.2]}), ValueError,
        "restitution = 1.2", "0 (no rebound)",
    ),
    mistake(
        NAME, lambda: rk.simulate_many(pulse, {"amplitude": [1.0]}, quantities=["thet"]), KeyError,
        "did you mean theta?",
    ),
    mistake(
        TYPE, lambda: rk.simulate_many(pulse, {"amplitude": [1.0]}, sweep_options={"threads": 2}),
        TypeError, "sweep_options is {'threads': 2}", "rk.SweepOptions(threads=4)",
    ),
    mistake(
        NAME, lambda: rk.simulate_many(pulse, {"amplitude": [1.0]}, threads=2),
        TypeError, "unknown threads", "give sweep_options=rk.SweepOptions(threads=",
    ),
    mistake(NAME, lambda: rk.SweepOptions(thread=2), TypeError, "did you mean threads?"),
    mistake(VALUE, lambda: rk.SweepOptions(threads=0), ValueError, "threads is 0", "at least 1"),
    mistake(NAME, lambda: sweep().theta, AttributeError, 'peak.sel(state="theta")'),
    mistake(NAME, lambda: sweep()["theta"], KeyError, 'peak.sel(state="theta")'),
    mistake(NAME, lambda: sweep().overturned, AttributeError, "outcome == 'overturned'"),
    mistake(TYPE, lambda: rk.tangents(BLOCK), TypeError, "case is RigidBlock", "rk.Case("),
    mistake(MISSING, lambda: rk.tangents(CASE), ValueError, "no duals", "rk.duals(half_width=0.1)"),
    mistake(TYPE, lambda: rk.duals(0.1), TypeError, "duals: 0.1 needs its name"),
]  # fmt: skip

ANALYSES = [
    mistake(MISSING, lambda: rk.assess(BLOCK), TypeError, "assess: missing records"),
    mistake(SIGN, lambda: rk.assess(BLOCK, [SINE], friction=-1), ValueError, "friction is -1"),
    mistake(UNIT, lambda: assessment().pga_at(5), ValueError, "probability is 5", "0.05 for 5 %"),
    mistake(FILE, lambda: assessment().save("page.xyz"), ValueError, "page.xyz", ".html"),
    mistake(TYPE, lambda: rk.assess(rk.RigidBlock, [SINE]), TypeError, "the class RigidBlock"),
    mistake(
        NAME, lambda: analysis.fragility_of(sweep(), intensity="amplitud"), ValueError,
        "did you mean amplitude?",
    ),
    mistake(
        MISSING, lambda: analysis.fragility_of(sweep()), TypeError,
        "fragility_of: missing intensity",
    ),
    mistake(
        TYPE, lambda: analysis.fragility_of(run(), intensity="pga"), TypeError,
        "sweep is", "rk.simulate_many",
    ),
    mistake(
        VALUE, lambda: analysis.risk.fit_fragility([1, 2, 3], [False] * 3), ValueError,
        "none of 3 motions exceeded", "higher intensities",
    ),
    mistake(
        SHAPE, lambda: analysis.risk.fit_fragility([1, 2], [1, 0, 1]), ValueError,
        "intensity (2,), exceeded (3,)",
    ),
    mistake(
        UNIT, lambda: analysis.design.bilinear_fit(BLOCK.pushover, 0.3), TypeError,
        "bilinear_fit: force is the function pushover", "rotations [rad]", "lambda u:",
    ),
    mistake(
        UNIT, lambda: analysis.design.EquivalentOscillator(1.0, BLOCK.pushover), TypeError,
        "of rotations [rad]", "lambda u:",
    ),
    mistake(
        VALUE, lambda: analysis.design.modified_spectrum(eurocode(0.1)), ValueError,
        "damping_ratio is 0.1", "damping_ratio=0.05",
    ),
    mistake(
        UNIT, lambda: eurocode(5), rk.InputError, "damping_ratio is 5", "0.05",
    ),
    mistake(
        VALUE, lambda: eurocode(0.9).compatible_motions(1, seed=1), rk.InputError,
        "is 0.9: motions are matched", "0.01 to 0.5", "damping_ratio=0.05",
    ),
    mistake(
        VALUE, lambda: eurocode(1e-3).matched(RECORD), rk.InputError, "is 0.001", "0.01 to 0.5",
    ),
    mistake(
        NAME, lambda: eurocode(0.05).acceleration(1.0), AttributeError,
        "acceleration", "did you mean spectrum(periods)?",
    ),
    mistake(
        VALUE, lambda: rk.sensitivity(pulse(20.0), ["peak theta"], ["half_width"]), ValueError,
        "peak theta is 1.571", "overturned", '"overturning time"',
    ),
    mistake(
        TYPE, lambda: plots.rocking_spectrum(sweep(), x="amplitude", alpha=abs), ValueError,
        "alpha is the function abs", "give numbers",
    ),
    mistake(
        NAME, lambda: analysis.overturning_boundaries(pulse, sweep(), along="period"), ValueError,
        "along is 'period'", "it is over amplitude",
    ),
    mistake(
        UNIT, lambda: analysis.rocking_spectrum(SINE, [1.0], 14), ValueError,
        "alpha is 14", "in radians",
    ),
    mistake(
        TYPE, lambda: analysis.response_spectrum([0, 1, 0], [1.0]), TypeError,
        "motion is [",
    ),
    mistake(MISSING, lambda: analysis.response_spectrum(SINE), TypeError, "missing periods"),
    mistake(
        NAME, lambda: plots.overturning_map(sweep(), x="amplitude", y="period"), ValueError,
        "no coordinate 'period'",
    ),
]  # fmt: skip

DECLARATIONS = [
    mistake(TYPE, lambda: rk.derive(3), TypeError, "structure is 3", "a class such as"),
    mistake(SIGN, lambda: rk.derive("shear_frame", storeys=-1), ValueError, "storeys is -1"),
    mistake(
        MISSING, lambda: symbolic.parameter("m", "mass"), TypeError,
        "parameter: missing unit (SI unit as a text",
    ),
    mistake(
        UNIT, lambda: symbolic.parameter("m", "mass", 3, "mass"), ValueError,
        "unit is 3", "a text",
    ),
    mistake(
        SHAPE, lambda: symbolic.Body("b", sp.Symbol("m"), (0, 1, 2, 3)), ValueError,
        "position is (0, 1, 2, 3)", "(x, y)",
    ),
    mistake(VALUE, lambda: symbolic.Rigid(restitution=2), ValueError, "restitution is 2", "0 to 1"),
    mistake(
        MISSING, lambda: symbolic.Model(name="mine"), TypeError,
        "Model: missing title (Title, in words), parameters",
    ),
]  # fmt: skip

GROUPS = {
    "structures": STRUCTURES,
    "names": NAMES,
    "motions": MOTIONS,
    "laws": LAWS,
    "simulations": SIMULATIONS,
    "responses": RESPONSES,
    "sweeps": SWEEPS,
    "analyses": ANALYSES,
    "declarations": DECLARATIONS,
}
MISTAKES = [
    pytest.param(one, id=f"{group}-{i}") for group, of in GROUPS.items() for i, one in enumerate(of)
]


@pytest.fixture(autouse=True)
def folder(tmp_path, monkeypatch):
    """A folder with files that are no records and no responses."""
    monkeypatch.chdir(tmp_path)
    Path("words.txt").write_text("hello\nworld\n")
    Path("columns.csv").write_text("t,a\n0,0.1\n0.01,0.2\n0.02,0.3\n")
    Path("junk.nc").write_bytes(b"junk")
    yield
    plt.close("all")


@pytest.mark.parametrize("mistake", MISTAKES)
def test_mistake_is_answered_by_the_package_with_a_remedy(mistake):
    if mistake in RESPONSES:
        xr.Dataset({"a": ("x", [1, 2])}).to_netcdf("foreign.nc", engine="h5netcdf")
    with pytest.raises(mistake.error) as caught:
        mistake.call()
    message = str(caught.value)
    for words in mistake.says:
        assert words in message
    raised_in = Path(traceback.extract_tb(caught.value.__traceback__)[-1].filename)
    assert raised_in.is_relative_to(PACKAGE)
    assert len(message) < 1500


def test_mistakes_are_spread_over_their_kinds():
    count = Counter(one.kind for of in GROUPS.values() for one in of)
    assert {*count} == {*KINDS}
    assert count.total() >= 72
    assert min(count.values()) >= 9


# -- values that are allowed and hardly meant


def shaken(peak: float, **units: str) -> rk.GroundMotion:
    return GM.from_array(peak * np.sin(0.04 * np.arange(300)), 0.01, **units)


SLIPS = {
    "record in g as m/s2": (lambda: rk.simulate(lumped(), shaken(0.3)).hints, 'units="g"'),
    "peak in g as m/s2": (lambda: rk.simulate(BLOCK,
        SINE.scaled_to(0.4)).hints, "0.4 g are 3.924 m/s2"),
    "lengths in millimetres": (
        lambda: rk.RigidBlock(half_width=95.0, half_height=450.0, mass=1.0).hints(), "cm or mm",
    ),
    "damping ratio as a damper": (lambda: frame(dampings=[0.05, 0.05]).hints(), "damping ratio"),
    "damping ratio as a foundation's": (
        lambda: lumped(support=rk.TwoSprings(stiffness=1e6, damping=0.05)).hints(), "N s/m",
    ),
    "inertia beyond the body": (
        lambda: rk.RigidBlock(half_width=0.1, half_height=0.4, inertia=1.0).hints(), "inertia",
    ),
    "vertical record as horizontal": (
        lambda: rk.simulate(BLOCK, GM(SINE.segments, "UP", is_vertical=True)).hints, "vertical",
    ),
}  # fmt: skip


@pytest.mark.parametrize("slip", SLIPS)
def test_slip_that_is_allowed_gives_a_hint(slip):
    call, words = SLIPS[slip]
    assert any(words in hint for hint in call())


def test_record_in_cm_per_s2_that_is_given_as_m_per_s2_gives_a_warning():
    with pytest.warns(UserWarning, match="350 m/s2.*check the units"):
        GM.from_array([0.0, 350.0, 0.0], 0.01)
