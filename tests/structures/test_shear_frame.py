"""The shear frame of any number of storeys: its modes, its landing, one storey as the column."""

import subprocess
import sys
from dataclasses import replace

import numpy as np
import pytest
import sympy as sp
from scipy.linalg import eigh

import rockeom as rk
from rockeom.symbolic.write.polar import polar_model
from tests.refusals import refused, told
from tests.typical import DAMPING, S1, STIFFNESS, column

GRAVITY = 9.81


def frame(storeys, **changes):
    """Of storeys that differ, on a base of some height; undamped if nothing else is said."""
    rng = np.random.default_rng(storeys)
    values = {
        "masses": 20e3 * rng.uniform(0.5, 1.5, storeys),
        "heights": np.cumsum(3.5 * rng.uniform(0.8, 1.2, storeys)),
        "stiffnesses": 40e6 * rng.uniform(0.5, 1.5, storeys),
        "dampings": [0.0] * storeys,
        "inertias": 3e4 * rng.uniform(0.5, 1.5, storeys),
        "half_width": 2.5,
        "base_mass": 30e3,
        "base_height": 0.4,
        "base_inertia": 2e4,
    }
    return rk.ShearFrame(**(values | changes))


def one_storey(**changes):
    """The steel column of `structures`, as a frame."""
    shared = {k: S1[k] for k in ("half_width", "base_mass", "base_height", "base_inertia")}
    return rk.ShearFrame(
        masses=[S1["mass"]],
        heights=[S1["height"]],
        inertias=[S1["inertia"]],
        stiffnesses=[STIFFNESS],
        dampings=[DAMPING],
        **(shared | changes),
    )


def matrices(f):
    """(M, K) of the frame on a fixed base."""
    k = np.append(f.stiffnesses, 0.0)
    stiffness = np.diag(k[:-1] + k[1:]) - np.diag(k[1:-1], 1) - np.diag(k[1:-1], -1)
    return np.diag(f.masses), stiffness


# -- on a fixed base


@pytest.mark.parametrize("storeys", [1, 2, 3])
def test_periods_on_a_fixed_base_are_those_of_its_matrices(storeys):
    f = frame(storeys)
    mass, stiffness = matrices(f)
    expected = 2 * np.pi / np.sqrt(eigh(stiffness, mass, eigvals_only=True))
    np.testing.assert_allclose(f.fixed_base().periods, expected, rtol=1e-10)


def test_dampers_stand_between_neighbours():
    """In proportion to the stiffnesses they damp each mode in proportion to its frequency."""
    f = frame(3)
    damped = frame(3, dampings=1e-3 * np.array(f.stiffnesses)).fixed_base()
    frequencies = 2 * np.pi / damped.periods
    np.testing.assert_allclose(damped.damping_ratios, 1e-3 * frequencies / 2, rtol=1e-8)


# -- one storey


def test_one_storey_is_the_flexible_structure():
    """Accelerations, energies, reactions and impacts, to the last digits."""
    rng = np.random.default_rng(3)
    for _ in range(50):
        side = rng.choice([-1.0, 1.0])
        mode, ground = "right" if side > 0 else "left", rng.uniform(-5, 5, 2)
        theta, u, theta_dot, u_dot = side * rng.uniform(0, 0.3), *rng.uniform(-0.1, 0.1, 3)
        state = {"theta": theta, "u": u, "theta_dot": theta_dot, "u_dot": u_dot}
        of_frame = {n.replace("u", "u_1", 1): v for n, v in state.items()}
        asked = [
            [
                s.accelerations(y, *ground, mode=mode),
                s.energies(y, mode=mode),
                s.reactions(y, *ground, mode=mode),
            ]
            for s, y in ((one_storey(), of_frame), (column(), state))
        ]
        for found, expected in zip(*asked, strict=True):
            numbers = list(expected.values())
            size = 1e-13 * np.abs(numbers).max()
            np.testing.assert_allclose(list(found.values()), numbers, rtol=1e-13, atol=size)
        landing = {"theta_dot": -side * abs(theta_dot), "u": u, "u_dot": u_dot}
        of_frame = {n.replace("u", "u_1", 1): v for n, v in landing.items()}
        for law in (rk.Impulsive(), rk.AngularMomentum()):
            expected, follows = column().after_impact(landing, mode, law)
            found, same = one_storey().after_impact(of_frame, mode, law)
            assert same == follows
            np.testing.assert_allclose(
                list(found.values()), list(expected.values()), rtol=1e-13, atol=1e-15
            )


def test_one_storey_moves_as_the_flexible_structure():
    sine = rk.GroundMotion.single_sine(amplitude=5.0, period=0.5, duration=2.0)
    as_frame, as_column = (
        rk.simulate(s, sine, impact=rk.Impulsive()) for s in (one_storey(), column())
    )
    assert len(as_frame.impacts) == len(as_column.impacts) > 2
    t = np.linspace(0.0, 2.0, 300)
    expected = as_column.at(t)["theta"]
    size = np.abs(expected).max()
    assert size > 0.01
    np.testing.assert_allclose(as_frame.at(t)["theta"], expected, atol=1e-7 * size)


# -- landing


@pytest.mark.parametrize("storeys", [1, 3])
def test_landing_out_of_the_derived_impact(storeys):
    """From theta > 0 to theta < 0: the ratio of the rates, and by how much each floor's rises."""
    model = rk.derive("shear_frame", storeys=storeys)
    of = {p.name: p.symbol for p in model.parameters}
    c = {x.name: x for x in model.coordinates}
    floors = range(1, storeys + 1)
    m, h, inertia = ([of[f"{n}_{i}"] for i in floors] for n in ("mass", "height", "inertia"))
    u = [c[f"u_{i}"].position for i in floors]
    m_b, h_b, b = of["base_mass"], of["base_height"], of["half_width"]
    whole = sum(inertia) + of["base_inertia"]
    lost = sum(mi * (b**2 - ui**2) for mi, ui in zip(m, u, strict=True))
    about = sum(mi * (b + ui) ** 2 for mi, ui in zip(m, u, strict=True))
    ratio = (whole + m_b * (h_b**2 - b**2) - lost) / (whole + m_b * (h_b**2 + b**2) + about)

    law = model.impulse_map("right", "left")
    rate = c["theta"].velocity
    after = {"theta": ratio * rate}
    for i, hi in zip(floors, h, strict=True):
        after[f"u_{i}"] = c[f"u_{i}"].velocity + hi * (1 - ratio) * rate
    put = sp.Matrix([after[x.name] for x in law.coordinates])
    for lacking in law.mass_matrix * put - law.momentum:
        assert sp.expand(sp.numer(sp.together(lacking))) == 0
    tall = whole + m_b * h_b**2 + sum(mi * hi**2 for mi, hi in zip(m, h, strict=True))
    wide = (m_b + sum(m)) * b**2
    assert sp.cancel(model.velocity_ratio - (tall - wide) / (tall + wide)) == 0  # taken as rigid


def test_closed_forms_of_the_velocities_after_a_landing_solve_the_balance_of_momenta():
    """Also in polar form, in whose sines an elimination without sin^2 + cos^2 = 1 drowns."""
    law = polar_model(rk.derive("shear_frame", storeys=2)).impulse_map("right", "left")
    symbols = sorted(law.mass_matrix.free_symbols | law.momentum.free_symbols, key=str)
    numbers = np.random.default_rng(5).uniform(0.5, 1.5, len(symbols))
    mass_matrix, momentum, closed = (
        np.array(m.subs(dict(zip(symbols, numbers, strict=True))), dtype=float)
        for m in (law.mass_matrix, law.momentum, law.velocities())
    )
    np.testing.assert_allclose(closed, np.linalg.solve(mass_matrix, momentum), rtol=1e-11)


def test_a_direction_without_mass_has_no_velocity_after_a_landing():
    law = rk.derive("shear_frame", storeys=1).impulse_map("right", "left")
    with pytest.raises(ValueError, match="singular"):
        replace(law, mass_matrix=sp.zeros(2)).velocities()


def test_point_floors_on_a_flat_base_always_land_in_full_contact():
    f = frame(2, inertias=None, base_height=0.0, base_inertia=0.0)
    rng = np.random.default_rng(1)
    for _ in range(20):
        u_1, u_2, u_1_dot, u_2_dot = rng.uniform(-0.1, 0.1, 4)
        landing = {
            "theta_dot": -0.2,
            "u_1": u_1,
            "u_2": u_2,
            "u_1_dot": u_1_dot,
            "u_2_dot": u_2_dot,
        }
        after, follows = f.after_impact(landing, "right", rk.Impulsive())
        assert follows == "both"
        assert after["theta_dot"] == 0.0
        for floor, height in zip(("u_1_dot", "u_2_dot"), f.heights, strict=True):
            assert after[floor] == pytest.approx(landing[floor] - 0.2 * height, rel=1e-12)


# -- in motion


def test_energy_is_kept_between_impacts_and_falls_at_each():
    f = frame(2, half_width=1.5)
    run = rk.simulate(
        f, rk.GroundMotion.none(6.0), impact=rk.Impulsive(), initial={"theta": 0.05, "u_1": 0.01}
    )
    assert len(run.impacts) >= 3
    energy = run["total_energy"]
    jumps = np.flatnonzero(np.diff(run.t) == 0.0)  # at an instant that is there twice
    losses = np.diff(energy)
    size = energy.max() - energy.min()
    assert size > 0
    assert np.abs(np.delete(losses, jumps)).max() < 1e-7 * size
    assert (losses[jumps] < 1e-9 * size).all()


def test_storeys_under_a_record_need_no_sympy_in_a_later_process():
    """What this process has derived is kept, as is what it has compiled."""
    code = """
import sys
import rockeom as rk
frame = rk.ShearFrame(
    masses=[20e3] * 4, heights=[3.5, 7.0, 10.5, 14.0], stiffnesses=[60e6] * 4,
    dampings=[3e5] * 4, half_width=1.6, base_mass=30e3,
)
record = rk.GroundMotion.from_library("El Centro 1940 180")
run = rk.simulate(frame, record, impact=rk.Impulsive())
assert run.outcome.name == "CAME_TO_REST" and len(run.impacts) > 10
"""
    exec(code, {})
    code += 'assert "sympy" not in sys.modules'
    done = subprocess.run([sys.executable, "-c", code], stderr=subprocess.PIPE, text=True)
    assert done.returncode == 0, done.stderr


# -- bad input


@pytest.mark.parametrize(
    ("changes", "error", "says"),
    [
        ({"masses": 20e3}, TypeError, "masses is 20000: give a list with a number"),
        ({"masses": "23"}, TypeError, "masses is '23': give a list"),
        ({"masses": {"1": 2.0}}, TypeError, "masses is {"),
        ({"masses": [20e3, "2"]}, TypeError, r"masses\[1\] is '2'"),
        ({"masses": []}, ValueError, "masses is empty"),
        ({"masses": [20e3, -1.0]}, ValueError, r"masses\[1\] is -1: it must be finite and pos"),
        ({"masses": [20e3] * 3}, ValueError, "masses are 3 and heights 2: give one for each"),
        ({"dampings": [1.0]}, ValueError, "masses are 2 and dampings 1"),
        ({"dampings": [1.0, np.nan]}, ValueError, r"dampings\[1\] is nan"),
        ({"stiffnesses": [1e6, 0.0]}, ValueError, r"stiffnesses\[1\] is 0"),
        ({"inertias": [1.0]}, ValueError, "inertias 1"),
        (
            {"heights": [7.0, 3.5]},
            ValueError,
            r"heights\[1\] is 3.5, not above .*: give the hei",
        ),
        ({"support": "pinned"}, TypeError, "support is 'pinned': give a support,"),
        ({"floors": 2}, TypeError, "unknown floors"),
    ],
)
def test_what_is_wrong_is_named(changes, error, says):
    with pytest.raises(error, match=says):
        frame(2, **changes)


def test_a_frame_of_no_or_half_a_storey_cannot_be_derived():
    for storeys in (0, 2.5, True, "2"):
        assert refused(rk.derive, "shear_frame", storeys=storeys)[0] == "storeys"
    assert "storeys" in told(rk.derive, "shear_frame")


def test_the_support_can_be_named():
    pinned = frame(2, support=rk.Pinned())
    assert pinned.module is frame(2).module
    assert column(support=rk.Pinned()).module is column().module
    assert pinned.parameters() == frame(2).parameters()
