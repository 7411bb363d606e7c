"""Uplift, sliding and restraint of structures at rest, by equilibrium of the forces on them."""

import dataclasses
import math

import numpy as np
import pytest

import rockeom as rk
from rockeom.assessment.statics import Load, Statics, is_symmetric, statics_of
from tests.refusals import refused
from tests.typical import column, stack

G = 9.81


@pytest.mark.parametrize(("b", "h"), [(0.1, 0.9), (0.4, 0.5), (1.2, 1.0)])
def test_block_lifts_at_b_over_h_and_slides_before_with_less_friction(b, h):
    statics = statics_of(rk.RigidBlock(half_width=b, half_height=h, mass=70.0))
    assert statics.uplift_accelerations == pytest.approx([G * b / h] * 2)
    assert statics.frictions_to_rock == pytest.approx([b / h] * 2)
    assert statics.centroid_height == pytest.approx(h)
    assert statics.arms == pytest.approx([b, b])
    assert statics.slides_first(b / h) == (None, None)
    assert statics.slides_first(0.9 * b / h) == (True, True)


def test_column_slides_by_the_mass_of_all_its_parts():
    structure = column()
    values = structure.parameters()
    mass = values["mass"] + values["base_mass"]
    statics = statics_of(structure)
    assert statics.mass == pytest.approx(mass)
    assert statics.weight == pytest.approx(mass * values["gravity"])


@pytest.mark.parametrize(("upper_half_width", "lifts"), [(0.12, "upper"), (0.2, "a foot")])
def test_stack_lifts_as_one_or_its_upper_block_alone(upper_half_width, lifts):
    statics = statics_of(stack(upper_half_width=upper_half_width))
    both = 0.25 / ((600 * 0.6 + 200 * 1.7) / 800)
    assert statics.uplift_acceleration == pytest.approx(G * min(both, upper_half_width / 0.5))
    assert lifts in statics.lifts


def test_hold_down_is_the_pull_on_a_foot_by_the_equations_of_full_contact():
    block = rk.RigidBlock(half_width=0.25, half_height=1.0, mass=400.0)
    pulled = block.reactions({}, 0.7 * G, mode="both")["right_reaction"]
    assert statics_of(block).hold_down(Load(0.7 * G)) == pytest.approx(-pulled)
    assert statics_of(block).hold_down(Load(0.2 * G)) == 0.0


def still(of: Statics, a: float, load: Load, z: float, forces: np.ndarray) -> np.ndarray:
    """(n, 2) whether a force at a height keeps it at rest under a to either side.

    The resultant of the ground lies between the edges and within the cone of friction.
    """
    weight = of.weight - of.mass * load.vertical
    pressure = (of.mass * a * of.centroid_height - forces * z) / weight
    left, right = of.arms
    within = np.stack([(-right <= pressure) & (pressure <= left),
                       (-left <= pressure) & (pressure <= right)], axis=1)  # fmt: skip
    if load.friction is None:
        return within
    return within & (np.abs(of.mass * a - forces) <= load.friction * weight)[:, None]


def test_straps_hold_what_equilibrium_says_and_the_others_do_not():
    """200 objects: sliding, without friction, off the middle, shaken vertically, pushed out."""
    rng = np.random.default_rng(8)
    counts = {"still": 0, "held": 0, "pushed out": 0}
    for _ in range(200):
        b, h, z = rng.uniform([0.1, 0.3, 0.2], [0.6, 1.5, 3.0])
        arms = b * (1 + rng.choice([0.0, 0.3])), b * (1 - rng.choice([0.0, 0.3]))
        weight = 100.0 * G
        lifts = tuple(G * arm / h for arm in arms)
        of = Statics(lifts, weight, 100.0, arms, h, sum(arms))
        load = Load(
            G * rng.uniform(0.1, 1.5), G * rng.choice([0.0, 0.4]),
            rng.choice(np.array([None, 0.0, 0.2, 0.5, 1.0], dtype=object)),
        )  # fmt: skip
        forces = np.linspace(0.0, 4.0 * weight * max(1.0, h / z), 20_001)
        force, step = of.strap(load, z), forces[1]
        least = []
        for a in load.acceleration * np.linspace(0.05, 1.0, 5):
            tried = np.append(forces, 100.0 * a)  # without friction no other holds
            holds = still(of, a, load, z, tried)
            least += [tried[way.argmax()] if way.any() else math.nan for way in holds.T]
        if np.isnan(least).any():
            counts["pushed out"] += 1
            assert math.isnan(force)
            assert z > of.highest_strap(load) or z < h
        else:
            counts["held" if force else "still"] += 1
            assert force == pytest.approx(max(least), abs=2 * step)
            assert z <= of.highest_strap(load)
    assert min(counts.values()) > 15


def test_hold_downs_keep_an_edge_down_and_press_enough_to_stop_sliding():
    rng = np.random.default_rng(9)
    for _ in range(200):
        b, h, mu, a = rng.uniform([0.1, 0.3, 0.05, 0.1 * G], [0.6, 1.5, 1.0, 1.5 * G])
        weight = 100.0 * G
        of = Statics((G * b / h, G * b / h), weight, 100.0, (b, b), h, 2 * b)
        forces = np.linspace(0.0, 60.0 * weight, 60_001)
        pressure = (100.0 * a * h - forces * b) / (weight + forces)
        holds = (pressure <= b) & (100.0 * a <= mu * (weight + forces))
        assert of.hold_down(Load(a, 0.0, mu)) == pytest.approx(
            forces[holds.argmax()], abs=2 * forces[1]
        )
    assert of.hold_down(Load(a, 0.0, 0.0)) == math.inf
    assert of.hold_down(Load(a, 1.1 * G, mu)) == math.inf
    assert math.isnan(of.strap(Load(a, 1.1 * G, mu), h))


def test_mirror_images_of_motions_are_motions_of_symmetric_structures():
    block = rk.OffsetBlock(half_width=0.3, half_height=0.6, offset=0.0)
    for structure in (rk.RigidBlock(half_width=0.2, half_height=0.8), column(), block):
        assert is_symmetric(structure)
    assert not is_symmetric(dataclasses.replace(block, offset=1e-3))


@pytest.mark.parametrize("phi", [0.08, -0.08])
def test_a_block_on_a_slope_is_held_by_a_strap_and_slides_first_as_on_level_ground(phi):
    b, h, m, mu, a = 0.2, 0.7, 70.0, 0.4, 0.5 * G
    statics = statics_of(rk.RigidBlock(half_width=b, half_height=h, mass=m), phi)
    assert statics.frictions_to_rock == pytest.approx((b / h, b / h))
    downhill = G * (mu * math.cos(phi) - math.sin(abs(phi)))
    assert statics.sliding_acceleration(mu) == pytest.approx(downhill)
    along, normal = m * (a + G * math.sin(abs(phi))), m * G * math.cos(phi)
    lifting = along * h - normal * b
    assert statics.strap(Load(a), 2.0 * h) == pytest.approx(lifting / (2.0 * h))
    assert statics.hold_down(Load(a)) == pytest.approx(lifting / (2.0 * b))


def test_assessment_on_a_slope_counts_both_directions_and_refuses_where_nothing_stands():
    block, record = rk.RigidBlock(half_width=0.2, half_height=0.7), rk.GroundMotion.ricker(4.0, 0.7)
    answer = rk.assess(block, record, slope="5 deg", pga=[4.0], units_checked=True)
    ways = [rk.simulate(block, way * record, slope="5 deg", duration=record.duration + 10.0)
            for way in (1.0, -1.0)]  # fmt: skip
    for one, run in zip(answer.records, ways, strict=True):
        assert one.rotation == pytest.approx(abs(run.extremes("theta").peak), rel=1e-6)
    assert "RigidBlock on a slope of 5 degrees under 1 record" in answer.title
    assert "the records act along it" in " ".join(answer.assumptions)
    assert refused(rk.assess, block, record, slope="20 deg")[0] == "slope"
    assert refused(rk.assess, block, record, slope="5 deg", friction=0.08)[0] == "slope"
    assert refused(rk.assess, stack(), record, slope="5 deg")[0] == "slope"
