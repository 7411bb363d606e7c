"""Whatever users call their parameters, coordinates and modes, the numbers are the same.

The generated text is executed by Python itself, so that nothing needs to be compiled.
"""

import functools
import types
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, strategies as st

import rockeom as rk
from rockeom.codegen import module_text
from rockeom.codegen.names import Names, is_own
from rockeom.codes import IMPACT
from rockeom.integrator.linking import LOOP
from rockeom.integrator.printing import printed
from rockeom.integrator.texts import load_text
from rockeom.structures.declared import class_of
from rockeom.symbolic import Coordinate, Mode, RockingModel, Transition
from rockeom.symbolic.evaluate import NumpyMode
from tests.pages import two_storey
from tests.refusals import told

VALUES = {
    "base_mass": 10e3,
    "mass_1": 20e3,
    "mass_2": 15e3,
    "height_1": 3.5,
    "height_2": 7.0,
    "stiffness_1": 20e6,
    "stiffness_2": 18e6,
    "damping_1": 120e3,
    "damping_2": 100e3,
    "half_width": 1.2,
    "gravity": 9.81,
}
COORDINATES = ("theta", "u1", "u2")

NAMES = (
    # what numbers were computed wrongly with, without a word
    *(f"c{i}" for i in range(21)),
    *("s", "ax", "ay", "load", "theta_ddot", "p", "y", "out", "math", "RIGHT", "lambda"),
    # intermediate results
    *("x0", "x1", "x15", "m00", "m10", "m11", "f0", "f1", "r0", "r1", "l10", "l21"),
    *("share_10", "share_20", "angle_0", "sin_theta", "cos_theta", "sin_c0_", "cos_s"),
    *("u1_ddot", "u1_ddot_alone", "theta_dot_after", "u2_dot_after_alone", "total_gravity"),
    # arguments, functions and tables
    *("g", "dy", "i", "found", "value", "guard", "law", "ratio", "number", "parameters"),
    *("accelerations", "accelerations_left_right", "guards", "jump", "rates", "prepare", "np"),
    *("energies", "reactions", "kinematics", "statics", "overturning", "velocity_ratio"),
    *(
        "impulse_to_opposite",
        "impulse_to_both",
        "opening_acceleration",
        "sine_cosine",
        "fused",
        "inlined",
    ),
    *("STATES", "SIDES", "N_STATES", "IMPULSIVE", "RATIO", "LEFT", "BOTH", "NAME"),
    # Python's own
    *("self", "model", "name", "abs", "max", "min", "range", "float", "print", "__debug__"),
    *("class", "None", "True", "import", "_", "__", "lambda_", "c0_", "c0__", "s_", "µ".upper()),
    *("match", "int", "len", "__name__", "entry", "Floats", "x", "n", "r", "z", "ROUNDER", "EPS"),
)


def renamed(model: RockingModel, names: dict[str, str]) -> RockingModel:
    """The model with other names of parameters and coordinates, and nothing else changed."""

    def other(c: Coordinate) -> Coordinate:
        return replace(c, name=names.get(c.name, c.name))

    def other_mode(mode: Mode) -> Mode:
        new = replace(mode, coordinates=tuple(map(other, mode.coordinates)))
        vars(new)["equations"] = mode.equations  # the same, and derived once
        return new

    return replace(
        model,
        parameters=tuple(replace(p, name=names.get(p.name, p.name)) for p in model.parameters),
        coordinates=tuple(map(other, model.coordinates)),
        rotation=other(model.rotation),
        modes=tuple(map(other_mode, model.modes)),
    )


def with_modes(model: RockingModel, names: dict[str, str]) -> RockingModel:
    """The model with other names of modes."""

    def other(t: Transition) -> Transition:
        return replace(
            t,
            source=names.get(t.source, t.source),
            target=names.get(t.target, t.target),
            fallback=names.get(t.fallback, t.fallback),
        )

    return replace(
        model,
        modes=tuple(
            replace(mode, sides={names.get(c, c): s for c, s in mode.sides.items()})
            for mode in model.modes
        ),
        transitions=tuple(map(other, model.transitions)),
    )


def uncompiled(model: RockingModel) -> types.ModuleType:
    module = types.ModuleType(model.name)
    exec(module_text(model), vars(module))
    return module


def numbers(model: RockingModel, names: dict[str, str]) -> dict[str, np.ndarray]:
    """All that a structure tells without a simulation, at some states of each mode."""
    values = {names.get(k, k): v for k, v in VALUES.items()}
    frame = class_of(uncompiled(model))(**values)
    theta, u1, u2 = (names.get(c, c) for c in COORDINATES)
    found = {
        "velocity ratio": np.array(frame.velocity_ratio),
        "overturning": np.array(frame.overturning_rotation),
        "pushover": frame.pushover([0.0, 0.01, -0.05]),
    }
    state = {theta: 0.0, u1: 0.01, u2: -0.02, f"{u1}_dot": 0.3, f"{u2}_dot": 0.2}
    for side, mode in ((-1, "left"), (0, "both"), (1, "right")):
        here = state | {theta: 0.03 * side, f"{theta}_dot": 0.4 * side}
        y = frame.state(here)
        ground = {"ground_acceleration": 1.2, "vertical_ground_acceleration": 0.3}
        tables = {
            "accelerations": frame.accelerations(here, mode=mode, **ground),
            "energies": frame.energies(here, mode=mode),
            "reactions": frame.reactions(here, mode=mode, **ground),
        }
        found |= {f"{k}, {mode}": np.array([*t.values()]) for k, t in tables.items()}
        m = frame.module
        for name, size in (("kinematics", len(m.KINEMATICS)), ("guards", m.N_GUARDS)):
            out, more = np.zeros(size), (1.2, 0.3) if name == "guards" else ()
            getattr(m, name)(frame.mode_number(y, mode), y, frame.vector, *more, out)
            found[f"{name}, {mode}"] = out
        if side:
            for law in (rk.AngularMomentum(), rk.Impulsive()):
                landing = state | {f"{theta}_dot": -0.4 * side}
                after, follows = frame.after_impact(landing, mode, law)
                found[f"{law}, {mode} to {follows}"] = np.array([*after.values()])
    return found


MODEL = two_storey()


@functools.cache
def usual() -> dict[str, np.ndarray]:
    return numbers(MODEL, {})


def assert_same(found: dict[str, np.ndarray]) -> None:
    assert list(found) == list(usual())
    for what, expected in usual().items():
        np.testing.assert_allclose(
            found[what], expected, rtol=1e-12, atol=1e-12 * np.abs(expected).max(), err_msg=what
        )


RENAMED = (*(name for name in VALUES if name != "gravity"), *COORDINATES)


@pytest.mark.parametrize("first", range(0, len(NAMES), len(RENAMED)))
def test_two_storey_frame_gives_the_same_numbers_whatever_its_parameters_are_called(first):
    nasty = NAMES[first : first + len(RENAMED)]
    names = dict(zip(RENAMED, nasty, strict=False))
    assert_same(numbers(renamed(MODEL, names), names))


def test_and_its_coordinates():
    names = {"theta": "c0", "u1": "s", "u2": "sin_", "mass_1": "sin_c0", "mass_2": "c0_"}
    assert_same(numbers(renamed(MODEL, names), names))


def test_names_that_dampers_and_springs_are_given():
    names = {"damping_1": "c1", "damping_2": "c2", "stiffness_1": "k1", "stiffness_2": "k2"}
    names |= {"mass_1": "m1", "mass_2": "m2", "half_width": "b", "gravity": "g", "theta": "x"}
    model = renamed(MODEL, names)
    assert_same(numbers(model, names))
    values = {names.get(k, k): v for k, v in VALUES.items()}
    y, ground = [0.02, 0.01, -0.02, 0.1, 0.3, 0.2], {"ax": 1.2, "ay": 0.3}
    mode, usual_mode = NumpyMode(model, "right"), NumpyMode(MODEL, "right")
    for of, more in (("rates", ground), ("energies", {}), ("reactions", ground)):
        found = getattr(mode, of)(y, values, **more)
        expected = getattr(usual_mode, of)(y, VALUES, **more)
        if of != "rates":
            found, expected = ([*d.values()] for d in (found, expected))
        np.testing.assert_allclose(found, expected, rtol=1e-12)


@given(st.lists(st.from_regex(r"[a-z_]\w{0,3}", fullmatch=True) | st.sampled_from(NAMES)))
def test_given_names_are_different_and_none_is_the_program_s(words):
    names = Names()
    given_names = [names.of_mode(w) for w in words] + [names.of(w) for w in words]
    assert len(set(given_names)) == len(given_names)
    assert not any(map(is_own, given_names))


def test_modes_may_be_named_as_the_texts_of_the_loop_name_things():
    """Numbers of modes are constants of the module alone."""
    model = rk.derive("dirac_delta_block")
    names = dict(zip(model.mode_names, ("impact", "eps", "left", "rest", "n", "k"), strict=True))
    text = module_text(with_modes(model, names))
    program = printed(load_text("block", text), "RK45", LOOP)
    assert program.names_in(program.texts[-1])["IMPACT"] == IMPACT
    assert sorted(program.names["MODES"]) == sorted(names.values())


def test_modes_of_any_name():
    """Of a block whose modes are marks on the way."""
    model = rk.derive("dirac_delta_block")
    nasty = ("rest", "Impact", "states", "ratio", "EPS", "lambda")
    names = dict(zip(model.mode_names, nasty, strict=True))
    module, usual_module = uncompiled(with_modes(model, names)), uncompiled(model)
    for table in ("STATES", "NAME", "PARAMETERS", "RATIO", "IMPULSIVE"):
        assert getattr(module, table) == getattr(usual_module, table)
    parameters = np.array([0.2, 0.8, 0.01])
    for y in np.array([[0.02, 1.0], [0.7, -1.0], [-0.1, 0.0]]):
        for mode, name in names.items():
            found = []
            for m, called in ((usual_module, mode), (module, name)):
                number, p = m.MODES.index(called), m.prepare(parameters)
                g, dy, after = np.zeros(m.N_GUARDS), np.zeros(2), np.zeros(2)
                m.guards(number, y, p, 0.0, 0.0, g)
                m.rates(number, y, p, 0.3, 0.1, dy)
                follows = [
                    m.MODES[m.jump(number, i, 0, 0.9, y, p, after)] for i in range(m.GUARDS[number])
                ]
                found.append((g, dy, follows))
            np.testing.assert_array_equal(found[0][0], found[1][0])
            np.testing.assert_array_equal(found[0][1], found[1][1])
            assert [names[c] for c in found[0][2]] == found[1][2]


def test_keywords_are_parameters_like_any_other():
    names = {"half_width": "lambda", "mass_1": "model", "mass_2": "self", "base_mass": "name"}
    model = renamed(MODEL, names)
    values = {names.get(k, k): v for k, v in VALUES.items()}
    frame = rk.structure(model, **values)
    assert frame.parameters() == values
    assert "did you mean lambda" in told(rk.structure, model, **values | {"lamda": 1.0})


def test_a_simulation_with_ugly_names_is_the_same():
    """Compiled, joined to the loop, and through impacts and full contact."""
    names = {"damping_1": "c1", "damping_2": "c2", "stiffness_1": "s", "stiffness_2": "x0"}
    names |= {"mass_1": "p", "mass_2": "y", "height_1": "load", "height_2": "theta_ddot"}
    names |= {"base_mass": "lambda", "half_width": "RIGHT", "u1": "c0", "u2": "out"}
    runs = []
    for model, called in ((MODEL, {}), (renamed(MODEL, names), names)):
        values = {called.get(k, k): v for k, v in VALUES.items()}
        runs.append(
            rk.simulate(
                rk.structure(model, **values),
                rk.GroundMotion.single_sine(4.0, 0.6, duration=2.0),
                impact=rk.Impulsive(),
            )
        )
    usual_run, run = runs
    assert len(usual_run.impacts) > 2
    assert [e.kind for e in run.events] == [e.kind for e in usual_run.events]
    times = np.linspace(0.0, 2.0, 201)
    found, expected = run.at(times), usual_run.at(times)
    for name in (*COORDINATES, *(f"{c}_dot" for c in COORDINATES)):
        coordinate, dot, _ = name.partition("_dot")
        other = names.get(coordinate, coordinate) + dot
        size = np.abs(expected[name]).max()
        # sums are written in the order of their names, and impacts enlarge what rounding leaves
        np.testing.assert_allclose(found[other], expected[name], rtol=0, atol=2e-10 * size)
