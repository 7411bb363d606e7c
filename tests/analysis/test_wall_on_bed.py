"""Walls on a bed that crushes: closed forms, invariants, a return map, and the derived modes."""

from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest
import sympy as sp
from hypothesis import given, settings, strategies as st
from scipy.optimize import brentq

import rockeom as rk
from rockeom.analysis import formulas
from rockeom.modelling.wall_on_bed import WallPath
from rockeom.symbolic.parts.walls import wall_on_bed
from rockeom.symbolic.statics import LOAD, small_rotations
from tests.refusals import refused

WEAK = rk.WallOnBed(
    length=1.25, thickness=0.32, shear_span=1.5, axial_force=300e3, bed_modulus=4e9, strength=2.8e6
)
HARD = replace(WEAK, strength=1e12)
N, B, T, H = WEAK.axial_force, WEAK.length / 2, WEAK.thickness, WEAK.shear_span


# --- closed forms


@pytest.mark.parametrize("displacement", [1e-4, 1e-3, 1e-2])
def test_bed_that_does_not_crush_lifts_as_the_closed_form(displacement):
    """The bed of strips tends to the continuous one with the square of their number."""
    exact = formulas.winkler_moment(displacement / H, N, WEAK.bed_modulus * T, B) / H
    errors = [
        abs(replace(HARD, springs=n).pushover(displacement).force[-1] / exact - 1)
        for n in (30, 300)
    ]
    assert errors[1] < 2e-4
    assert errors[1] < errors[0] / 20


def test_uplift_begins_where_the_closed_form_says():
    path = replace(HARD, springs=400).pushover(0.01)
    uplift = formulas.winkler_uplift_rotation(N, WEAK.bed_modulus * T, B) * H
    assert path.displacement[1] == pytest.approx(uplift, rel=3e-3)  # the first event
    assert path.force[1] * H == pytest.approx(N * B / 3, rel=3e-3)


@pytest.mark.parametrize("displacement", [0.02, 0.05, 0.3])
def test_rectangle_crushes_as_the_closed_form(displacement):
    """Stresses rise over d = f/(k theta), and are f from there to the edge."""
    rise = WEAK.strength / WEAK.bed_modulus / (displacement / H)
    moment = N * B - N**2 / (2 * WEAK.strength * T) - WEAK.strength * T * rise**2 / 24
    errors = [
        abs(replace(WEAK, springs=n).pushover(displacement).force[-1] * H / moment - 1)
        for n in (40, 400)
    ]
    assert errors[1] < 2e-5
    assert errors[1] < errors[0] / 10


def test_strength_tends_to_that_of_rigid_rocking_on_a_crushed_corner():
    exact = formulas.rocking_strength(N, 2 * B, H, T, WEAK.strength, stress_block=1.0)
    assert exact == pytest.approx(N * (2 * B - N / (WEAK.strength * T)) / (2 * H))
    assert WEAK.rocking_strength == exact
    near, far = (1 - replace(WEAK, springs=300).pushover(u).force[-1] / exact for u in (0.02, 0.5))
    assert 0 < far < 2e-5
    assert 50 * far < near < 2e-3


def test_load_that_stays_vertical_takes_p_delta_and_nothing_else():
    path, vertical = (replace(WEAK, following=f).cycles([0.01, 0.02]) for f in (True, False))
    np.testing.assert_array_equal(path.displacement, vertical.displacement)
    lost = path.force - vertical.force
    np.testing.assert_allclose(lost, N * path.displacement / H, rtol=1e-9, atol=1e-9 * N)


def test_bed_of_one_spring_bears_no_moment():
    path = replace(WEAK, springs=1).pushover(0.01)
    np.testing.assert_allclose(path.force, 0.0, atol=1e-9 * N)


# --- what was derived


@pytest.mark.parametrize("following", [True, False])
def test_equilibrium_to_first_order_has_the_terms_that_the_path_takes(following):
    """Rotation and heave meet in the springs alone, and the horizontal force moves no heave."""
    of = small_rotations(wall_on_bed(1, following).free)
    m, force, span, h, g = sp.symbols("m_e N H_0 H_e g", positive=True)
    turned = -h * g * m - (0 if following else force * span)
    assert of.stiffness == sp.Matrix([[turned, 0], [0, 0]])
    assert sp.expand(of.constant - sp.Matrix([0, force + g * m])) == sp.zeros(2, 1)
    assert of.lever == sp.Matrix([span, 0])
    assert LOAD not in of.stiffness.free_symbols | of.constant.free_symbols


@pytest.mark.parametrize(
    ("strength", "farthest", "crushes"), [(1.2e6, 6e-4, True), (1e7, 2e-3, False)]
)
def test_path_is_the_pushover_of_the_derived_modes(strength, farthest, crushes):
    """Three springs of the simulated structure, but for the square of the rotation."""
    wall = replace(WEAK, springs=3, following=False, strength=strength)
    area = wall.length * wall.thickness / 3
    derived = rk.structure(
        wall_on_bed(3, False), mass=1e-3, height=0.6, inertia=1e-3, half_width=B, gravity=9.81,
        axial_force=wall.axial_force, shear_span=H, foundation_stiffness=wall.bed_modulus * area,
        strength=wall.strength * area,
    )  # fmt: skip
    rotations = np.array([0.3, 0.6, 1.0]) * farthest
    forces = [wall.pushover(H * r).force[-1] for r in rotations]
    np.testing.assert_allclose(derived.pushover(rotations), forces, rtol=5e-6)
    assert (wall.pushover(H * farthest).plastic_work[-1] > 0) == crushes


# --- cycles


def work(path: WallPath) -> float:
    """Work of the horizontal force [J]: between two points it is linear."""
    return float(np.sum(np.diff(path.displacement) * (path.force[1:] + path.force[:-1]) / 2))


def test_bed_that_does_not_crush_comes_back_on_its_way():
    path = HARD.cycles([0.01, 0.03])
    loop = path.last_cycle
    assert loop.area < 1e-9 * loop.force.max() * loop.displacement.max()
    assert not path.plastic_work.any()
    back = HARD.along([0.03, 0.0])
    assert abs(back.force[-1]) < 1e-9 * N
    assert back.heave[-1] == pytest.approx(back.heave[0], rel=1e-9)


def test_cycle_loses_what_crushing_takes_less_what_the_load_gives():
    """A wall that rolls to and fro on its crushed base settles by as much in each cycle."""
    path = replace(WEAK, springs=60).cycles([0.02], repeat=20)
    peaks = np.flatnonzero(path.displacement == 0.02)
    before, after = peaks[-2:]
    loop = path.last_cycle
    crushing = path.plastic_work[after] - path.plastic_work[before]
    settled = path.heave[before] - path.heave[after]
    stored = path.elastic_energy[after] - path.elastic_energy[before]
    assert settled == pytest.approx(path.heave[peaks[-3]] - path.heave[before], rel=1e-3)
    assert settled > 1e-4
    assert loop.area == pytest.approx(crushing + stored - N * settled, rel=1e-3)


def test_wall_that_presses_more_dissipates_more():
    damping = [
        replace(WEAK, axial_force=n).cycles([0.02], repeat=3).last_cycle.damping
        for n in (100e3, 300e3, 600e3)
    ]
    assert damping == sorted(damping)
    assert damping[0] < 1e-4
    assert damping[1] > 0.01
    assert damping[2] > 0.1


walls = st.builds(
    rk.WallOnBed,
    length=st.floats(0.3, 3.0),
    thickness=st.floats(0.1, 0.6),
    shear_span=st.floats(0.5, 4.0),
    axial_force=st.floats(20e3, 150e3),
    bed_modulus=st.floats(1e8, 1e11),
    strength=st.floats(6e6, 60e6),
    following=st.booleans(),
    springs=st.integers(2, 25),
)
paths = st.lists(st.floats(-0.05, 0.05), min_size=1, max_size=5)


@settings(max_examples=40, deadline=None)
@given(walls, paths)
def test_energy_balances_and_the_axial_force_is_carried_on_every_path(wall, targets):
    path = wall.along(targets)
    np.testing.assert_allclose(path.reaction, wall.axial_force, rtol=1e-9)
    assert (np.diff(path.plastic_work) >= 0).all()
    gained = path.elastic_energy[-1] - path.elastic_energy[0] + path.plastic_work[-1]
    gained += wall.axial_force * (path.heave[-1] - path.heave[0])
    if not wall.following:
        gained -= wall.axial_force * path.displacement[-1] ** 2 / (2 * wall.shear_span)
    scale = np.abs(path.force).max() * np.abs(path.displacement).max() + wall.axial_force * 1e-6
    assert work(path) == pytest.approx(gained, abs=1e-8 * scale)


@settings(max_examples=20, deadline=None)
@given(walls, paths)
def test_path_to_the_other_side_is_its_mirror_image(wall, targets):
    path, image = wall.along(targets), wall.along([-x for x in targets])
    force = float(np.abs(path.force).max())
    assert image.force[-1] == pytest.approx(-path.force[-1], abs=1e-7 * force + 1e-9)
    assert image.plastic_work[-1] == pytest.approx(path.plastic_work[-1], rel=1e-6, abs=1e-9)


def return_map(wall: rk.WallOnBed, targets: list[float], steps: int) -> float:
    """The force at the end of a path in small steps: of each spring the largest compression counts.

    In each step the heave follows from the sum of forces by bisection.
    """
    x = wall.length * ((np.arange(wall.springs) + 0.5) / wall.springs - 0.5)
    k = wall.bed_modulus * wall.length * wall.thickness / wall.springs
    limit, plastic = wall.strength / wall.bed_modulus, np.zeros(wall.springs)
    corners = [0.0, *targets]
    for start, end in pairwise(corners):
        for u in np.linspace(start, end, steps + 1)[1:]:
            level = x * u / wall.shear_span - plastic

            def lacking(heave, level=level):
                return k * np.clip(level - heave, 0.0, limit).sum() - wall.axial_force

            heave = brentq(lacking, level.min() - 1.1 * limit, level.max(), xtol=1e-15)
            plastic += np.maximum(level - heave - limit, 0.0)
            force = k * np.clip(x * u / wall.shear_span - heave - plastic, 0.0, limit)
    return float(force @ x / wall.shear_span)


def test_events_give_the_limit_of_small_steps():
    wall, targets = replace(WEAK, springs=12), [0.01, -0.02, 0.02, 0.004]
    exact = wall.along(targets)
    assert exact.plastic_work[-1] > 100
    errors = [abs(return_map(wall, targets, n) / exact.force[-1] - 1) for n in (100, 1000)]
    assert errors[1] < 1e-4
    assert errors[1] < errors[0] / 5


# --- input that is refused


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"length": 0.0}, "length"),
        ({"bed_modulus": float("nan")}, "bed_modulus"),
        ({"axial_force": 2e6}, "axial_force"),
        ({"following": 1}, "following"),
        ({"springs": 2.5}, "springs"),
    ],
)
def test_impossible_wall_is_refused(change, message):
    assert refused(replace, WEAK, **change)[0] == message


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: WEAK.along([0.01, np.inf]), r"displacements\[1\] is inf"),
        (lambda: WEAK.along([[0.01]]), "displacements.* give a list"),
        (lambda: WEAK.pushover(np.nan), r"displacements\[0\] is nan"),
        (lambda: WEAK.cycles([0.01, -0.02]), r"amplitudes\[1\] is -0\.02: give"),
        (lambda: WEAK.cycles([0.01], repeat=0), "repeat is 0: give a whole number"),
        (
            lambda: replace(WEAK, bed_modulus=1e6, strength=1e7).effective_stiffness(),
            "half the length, the force stays below .* give a stiffer bed",
        ),
        (lambda: formulas.rocking_strength(2e6, 1.25, 1.5, 0.32, 3e6), "more than the wall bears"),
    ],
)
def test_impossible_path_is_refused(call, message):
    with pytest.raises(ValueError, match=message):
        call()
