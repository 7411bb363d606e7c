"""Energies and restitution of any structure by its own: what a free test says of each kind."""

import importlib

import numpy as np
import pytest

import rockeom as rk
from rockeom import analysis
from rockeom.analysis import identification
from rockeom.structures.classes import SHIPPED
from rockeom.structures.declared import class_of
from rockeom.structures.evaluation import at_states
from tests.shipped import plain
from tests.typical import FOUNDATION_STIFFNESS, S1, column, every_structure

WALL = analysis.Wall.thesis()
BARE_TABLE = identification.FreeVibration.table_a1()
KINDS = [
    *every_structure(),
    rk.DiracDeltaBlock(alpha=0.25, energy_ratio=0.9, regularisation=0.01),
    rk.UpliftingOscillator.from_frequency(20.0, 0.0, height=3.0, half_width=1.0),
    rk.ControlledWall.thesis(),
    rk.FlexibleControlledWall.thesis(),
    rk.ControlledWallOscillator.thesis(0.85),
    rk.SubstituteGravityWall.thesis(),
    rk.SimplifiedSubstituteGravityWall.thesis(),
]


def free(peaks, speed=0.3):
    """A free vibration of these peaks, upright in the middle of the time between two."""
    n = 2 * len(peaks) - 1
    values, rates = np.zeros(n), np.zeros(n)
    values[::2] = peaks
    rates[1::2] = -speed * np.sign(peaks[:-1])
    return identification.FreeVibration(
        np.arange(n) % 2 == 0, np.arange(n) * 0.1, values, rates, rates
    )


def place_of(structure, y, name="displacement"):
    modes = np.array([structure.mode_number(state) for state in y])
    return at_states(structure.module, structure.vector, "kinematics", modes, y)[name]


def module_of(kind):
    return importlib.import_module(f"rockeom.generated.{kind.model}")


# --- one way to the energies


def test_every_shipped_kind_is_there():
    on_points = {name for name, kind in SHIPPED.items() if hasattr(module_of(kind), "POINTS")}
    frames = {"rocking_frame", "wall_with_frame"}  # declared as others that are there
    uneven = {"offset_block"}  # one angle is another energy on its other side
    assert {one.model for one in KINDS} == set(SHIPPED) - on_points - frames - uneven


@pytest.mark.parametrize("structure", KINDS, ids=lambda one: one.model)
def test_restitution_of_any_structure_from_its_rotation_and_from_its_displacement(structure):
    """One answer, whatever of it was measured and whoever is asked."""
    part = 0.02 if structure.module.STATE_UNITS[structure.module.ROTATION] in ("rad", "m") else 0.5
    rotation = part * np.array([1.0, -0.9, 0.7])
    displacement = place_of(structure, identification.equilibrium_states(structure, rotation))
    by_rotation = identification.Impacts.of_peaks([0, 1, 2], rotation, structure)
    by_place = identification.Impacts.of_peaks(
        [0, 1, 2], displacement, structure, quantity="displacement"
    )
    assert np.all((by_rotation.energy_ratio > 0) & (by_rotation.energy_ratio < 1))
    energy = identification.static_energy(structure, rotation)
    np.testing.assert_allclose(by_rotation.energy_ratio, energy[1:] / energy[:-1], rtol=1e-12)
    found = (
        by_place.energy_ratio,
        free(displacement).restitution(structure).energy_ratio,
        free(rotation).restitution(structure, structure.states[0]).energy_ratio,
    )
    for ratio in found:
        np.testing.assert_allclose(ratio, by_rotation.energy_ratio, rtol=1e-8)


def test_record_of_a_structure_whose_rotation_has_another_name():
    """Free vibrations by a cosine: no channel need be named where it is called as the state is."""
    cart = rk.TwoSpringCart(**S1, foundation_stiffness=FOUNDATION_STIFFNESS)
    t = np.arange(800) * 0.005
    record = analysis.MeasuredRecord(t, {"u": 0.02 * np.exp(-0.1 * t) * np.cos(3 * t)})
    found = identification.Impacts.of_record(record, cart, smallest=1e-3)
    energy = identification.static_energy(cart, found.peak_before)
    np.testing.assert_allclose(found.energy_before, energy, rtol=1e-12)
    assert len(found) == 3


def test_restitution_of_a_declared_structure():
    """Nothing is known of it but its module: as of the class that is written for it."""
    declared = class_of(importlib.import_module("rockeom.generated.flexible_structure"))
    ours = declared(**column().parameters())
    peaks = np.array([0.03, -0.025, 0.02])
    np.testing.assert_array_equal(
        free(peaks).restitution(ours).energy_ratio, free(peaks).restitution(column()).energy_ratio
    )


def test_restitution_of_blocks_is_that_of_the_closed_forms():
    """3-3 and 5-4, of rotations and of displacements of the centroid and of the mass."""
    block, frame = rk.RigidBlock.from_frequency(p=2.14, alpha=0.25), rk.LumpedMassStructure(**S1)
    peaks = np.array([0.12, -0.1, 0.09])
    by_formula = analysis.formulas.energy_ratios_from_peaks(peaks, block.alpha)
    along = identification.displacement_from_rotation(peaks, block.half_width, block.half_height)
    found = free(along).restitution(block).energy_ratio
    np.testing.assert_allclose(found, by_formula, rtol=1e-10)
    shape = {n: v for n, v in S1.items() if "inertia" not in n}
    by_formula = analysis.formulas.energy_ratios_from_peaks_of_lumped_mass(peaks, **shape)
    along = identification.displacement_from_rotation(peaks, S1["half_width"], S1["height"])
    found = free(along).restitution(frame).energy_ratio
    np.testing.assert_allclose(found, by_formula, rtol=1e-10)


def test_energies_of_a_block_in_motion():
    """At a crossing I_o (v/H)**2/2, the centroid moving by H times the rotation."""
    block = rk.RigidBlock(half_width=0.1, half_height=0.5, mass=300.0)
    found = free(np.array([0.03, -0.02]), speed=0.4).energies(block)
    inertia = 4 / 3 * 300.0 * block.radius**2
    np.testing.assert_allclose(found.kinetic, [0, inertia * (0.4 / 0.5) ** 2 / 2, 0], rtol=1e-4)
    np.testing.assert_allclose(found.elastic, 0.0)
    assert found.gravity[1] == 0.0


def test_column_that_has_not_lifted_only_bends():
    """Half the stiffness times the square of its displacement, full contact."""
    d = np.array([1e-4, -2e-4])
    found = identification.static_energy(column(), d, quantity="displacement")
    np.testing.assert_allclose(found, 571.8e3 * d**2 / 2, rtol=1e-3)


def test_table_a_1_by_each_model_of_the_wall():
    """4-18 and 4-20 by the formulas and by the oscillator that is derived of them, of one table."""
    table = BARE_TABLE
    bare = identification.FreeVibration(
        table.at_peak, table.time, table.displacement, table.velocity, table.acceleration
    )
    formulas = bare.restitution(WALL)
    derived = bare.restitution(rk.ControlledWallOscillator.from_wall(WALL, 1.0))
    np.testing.assert_allclose(derived.speed, formulas.speed)
    # of the wall's peaks, which still move a little in the table, but for the changing inertia
    np.testing.assert_allclose(derived.energy_ratio, formulas.energy_ratio, rtol=2e-3)
    whole = bare.restitution(rk.ControlledWall.thesis())
    np.testing.assert_allclose(whole.energy_ratio, formulas.energy_ratio, rtol=5e-3)


# --- what is no free test


def test_peak_beyond_the_balance_is_refused():
    """A block let go at 0.3 rad, alpha = 0.25, falls, though its energy is above that upright."""
    block = rk.RigidBlock.from_frequency(p=2.14, alpha=0.25)
    for quantity, peaks in ((None, [0.3, -0.1]), ("theta", [0.1, -0.3])):
        with pytest.raises(ValueError, match=r"is -?0.3: a free structure turns back before"):
            identification.Impacts.of_peaks([0, 1], peaks, block, quantity=quantity)


def test_what_a_structure_does_not_have_or_reach_is_refused():
    with pytest.raises(ValueError, match=r"no quantity 'displacment' \(did you mean displ"):
        identification.static_energy(column(), 0.01, quantity="displacment")
    with pytest.raises(ValueError, match=r"overturns before its displacement is 30.0"):
        identification.static_energy(column(), 30.0, quantity="displacement")


# --- many states at once


@pytest.mark.parametrize("name", SHIPPED)
def test_many_states_at_once_give_what_each_gives(name):
    """To the last bit, though states of one mode may go several ways in a function."""
    structure = SHIPPED[name](**plain(name))
    m, rng = structure.module, np.random.default_rng(5)
    y = rng.uniform(-0.1, 0.1, (12, m.N_STATES))
    modes = rng.integers(0, len(m.MODES), 12)
    given = {"energies": (), "kinematics": (), "reactions": (0.3, -0.1), "statics": (2.0,)}
    for function, more in given.items():
        found = at_states(structure.module, structure.vector, function, modes, y, *more)
        for i, state in enumerate(y):
            out = np.empty(len(found))
            getattr(m, function)(int(modes[i]), state, structure.vector, *more, out)
            np.testing.assert_array_equal([row[i] for row in found.values()], out)
