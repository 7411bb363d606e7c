"""Blocks of full dimensions, and the block whose centroid is off the middle of its base."""

import math

import numpy as np
import pytest

import rockeom as rk
from rockeom.structures.base import Structure
from rockeom.symbolic import Body, Model, Rigid, coordinate, feet, parameter, turned

SIZE = {"half_width": 0.3, "half_height": 0.9, "mass": 400.0}
STATUE = rk.RigidBlock.from_dimensions(width=0.6, height=1.8, offset=0.05, mass=400.0)
PULSE = rk.GroundMotion.single_sine(amplitude=4.0, period=0.7, duration=8.0)
ALONE = rk.GroundMotion.none(20.0)


def test_full_dimensions_give_housners_block():
    block = rk.RigidBlock.from_dimensions(width=0.6, height=1.8)
    radius = math.hypot(0.3, 0.9)
    assert (block.R, block.alpha) == (pytest.approx(radius), pytest.approx(math.atan2(0.3, 0.9)))
    assert block.p == pytest.approx(math.sqrt(3 * 9.81 / (4 * radius)))
    assert (block.R, block.p) == (block.radius, block.frequency_parameter)
    assert block.overturning_angles == (block.alpha, block.alpha)


def test_a_low_centroid_keeps_the_inertia_of_the_whole_rectangle():
    rack = rk.RigidBlock.from_dimensions(width=0.6, height=2.0, centroid_height=0.8, mass=100.0)
    assert rack.alpha == pytest.approx(math.atan2(0.3, 0.8))
    inertia = 100.0 * (0.6**2 + 2.0**2) / 12
    assert rack.p == pytest.approx(math.sqrt(100.0 * 9.81 * rack.R / (inertia + 100.0 * rack.R**2)))


def test_a_sliding_block_has_full_dimensions_too():
    block = rk.SlidingBlock.from_dimensions(width=0.6, height=1.8, friction=0.3, restitution=0.0)
    assert (type(block), block.half_width, block.friction) == (rk.SlidingBlock, 0.3, 0.3)


@pytest.mark.parametrize(
    ("wrong", "named"),
    [
        ({"offset": 0.3}, "offset is 0.3 and width 0.6"),
        ({"offset": math.nan}, "offset is nan"),
        ({"centroid_height": 1.9}, "centroid_height is 1.9 and height 1.8"),
        ({"width": -0.6}, "width is -0.6: .* positive"),
    ],
)
def test_a_centroid_outside_the_block_is_refused(wrong, named):
    with pytest.raises(ValueError, match=named):
        rk.RigidBlock.from_dimensions(**({"width": 0.6, "height": 1.8} | wrong))
    with pytest.raises(ValueError, match="its centroid above the middle"):
        rk.SlidingBlock.from_dimensions(
            width=0.6, height=1.8, offset=0.1, friction=0.3, restitution=0.0
        )
    with pytest.raises(ValueError, match=r"offset is -0.31 .* not above the base.* at rest"):
        rk.OffsetBlock(half_width=0.3, half_height=0.9, offset=-0.31)


def by_particles(offset: float, landing: float, inertia: float = 0.4) -> float:
    """Angular velocity after an impact over that before: a unit mass on feet at x = -0.3 and 0.3.

    Two half masses with the body's inertia about the centroid turn about the old foot by 1 rad/s;
    their moment of momentum about the new one stays. landing : x of the new foot.
    """
    centroid, arm = np.array([offset, 0.9]), math.sqrt(inertia) * np.array([0.6, 0.8])
    old, new = np.array([-landing, 0.0]), np.array([landing, 0.0])
    momentum = about_new = 0.0
    for place in (centroid + arm, centroid - arm):
        (x, y), (rx, ry) = place - old, place - new
        momentum += 0.5 * (rx * -x - ry * y)  # of velocity (y, -x), clockwise about the old foot
        about_new += 0.5 * (rx * -rx - ry * ry)
    return momentum / about_new


@pytest.mark.parametrize("offset", [0.05, -0.12, 0.25])
def test_impacts_conserve_the_moment_of_momentum_about_the_foot_that_lands(offset):
    block = rk.OffsetBlock(half_width=0.3, half_height=0.9, offset=offset, inertia=0.4)
    for law in (None, rk.AngularMomentum(), rk.Impulsive()):
        for mode, rate, landing in (("right", -0.7, -0.3), ("left", 0.7, 0.3)):
            after, follows = block.after_impact({"theta_dot": rate}, mode, law)
            assert after["theta_dot"] / rate == pytest.approx(by_particles(offset, landing))
            assert follows != mode


def test_each_side_overturns_at_the_angle_of_its_line_to_the_centroid():
    left, right = STATUE.overturning_angles
    assert (left, right) == (math.atan2(0.35, 0.9), math.atan2(0.25, 0.9))
    for side, angle in ((-1, left), (1, right)):
        back, away = (
            rk.simulate(STATUE, ALONE, initial={"theta": side * part * angle})
            for part in (0.999, 1.001)
        )
        assert back.impacts
        assert not away.impacts
        assert away.outcome == "overturned"
    # by the pushover, as of other structures
    assert Structure.overturning_angles.func(STATUE) == pytest.approx((left, right), rel=1e-9)


def test_each_side_lifts_at_its_own_acceleration():
    left, right = STATUE.uplift_accelerations
    assert (left, right) == pytest.approx((9.81 * 0.35 / 0.9, 9.81 * 0.25 / 0.9))
    assert STATUE.uplift_acceleration == right
    for side, threshold, mode in ((1, left, "left"), (-1, right, "right")):
        for part, goes in ((0.999, "both"), (1.001, mode)):
            push = rk.GroundMotion.constant(side * part * threshold, 0.05)
            assert rk.simulate(STATUE, push).mode[-1] == goes


def test_without_offset_it_is_the_rigid_block():
    blocks = rk.OffsetBlock(offset=0.0, **SIZE), rk.RigidBlock(**SIZE)
    runs = [rk.simulate(block, PULSE) for block in blocks]
    assert len(runs[0].impacts) > 10
    times = np.linspace(0.0, runs[1].t[-1], 500)
    a, b = (run.at(times)["theta"] for run in runs)
    assert np.abs(a - b).max() < 1e-8 * np.abs(b).max()


def test_the_mirrored_block_makes_the_mirrored_motion():
    run = rk.simulate(STATUE, PULSE)
    mirrored = rk.RigidBlock.from_dimensions(width=0.6, height=1.8, offset=-0.05, mass=400.0)
    other = rk.simulate(mirrored, -PULSE)
    times = np.linspace(0.0, run.t[-1], 200)
    assert np.abs(run.at(times)["theta"] + other.at(times)["theta"]).max() < 1e-9


def test_energy_stays_between_impacts():
    run = rk.simulate(STATUE, PULSE)
    assert len(run.impacts) > 10
    assert run.energy_balance().error < 1e-9


def test_a_ratio_of_energies_is_refused_where_the_feet_differ():
    with pytest.raises(ValueError, match="VelocityRatio"):
        rk.simulate(STATUE, PULSE, impact=rk.EnergyRatio(0.9))
    assert rk.simulate(STATUE, PULSE, impact=rk.VelocityRatio(0.9)).impacts


def on_contacts() -> Model:
    """The same body, free in the plane, with two contacts that never slip."""
    x = coordinate("x", "x", "m", "place of the middle of the base")
    y = coordinate("y", "y", "m", "height of the middle of the base")
    theta = coordinate("theta", "theta", "rad", "rotation, positive clockwise")
    units = {"mass": "kg", "inertia": "kg m2", "offset": "m", "height": "m", "half_width": "m"}
    parameters = [
        parameter(f"{name[:3]}_1", name, unit, name)
        for name, unit in {**units, "gravity": "m/s2"}.items()
    ]
    m, inertia, d, h, b, g = (p.symbol for p in parameters)

    def placed(across, up):
        right, above = turned((across, up), (0, 0), theta.position)
        return x.position + right, y.position + above

    return Model(
        name="offset_on_contacts",
        title="Block with its centroid off the middle, on contacts",
        parameters=[*parameters],
        coordinates=[x, y, theta],
        bodies=[Body("block", m, placed(d, h), inertia, theta.position)],
        gravity=g,
        rotation=theta,
        contacts=feet(
            gap=lambda side: placed(side * b, 0)[1],
            slip=lambda side: placed(side * b, 0)[0],
            law=Rigid(restitution=0, friction=None),
        ),
        load_point=placed(d, h),
    )


def test_random_blocks_move_as_on_contacts_whose_modes_are_searched():
    """Complementarity of impulses, not the impact map of declared modes."""
    model, rng = on_contacts(), np.random.default_rng(11)
    for _ in range(8):
        b, h = rng.uniform(0.04, 0.4), rng.uniform(0.8, 1.5)
        offset, inertia = rng.uniform(0.0, 0.9) * b, rng.uniform(0.1, 0.3) * (b**2 + h**2)
        size = {"half_width": b, "offset": offset, "inertia": inertia}
        block = rk.OffsetBlock(half_height=h, **size)
        peak = rng.uniform(1.0, 1.6) * block.uplift_acceleration
        pulse = rk.GroundMotion.single_sine(amplitude=peak, period=0.5, duration=8.0)
        run = rk.simulate(block, pulse)
        free = rk.simulate(rk.structure(model, mass=1.0, height=h, **size), pulse)
        assert run.outcome == free.outcome
        times = np.linspace(0.0, min(run.t[-1], free.t[-1]), 200)
        apart = np.abs(run.at(times)["theta"] - free.at(times)["theta"]).max()
        assert apart < 1e-6 * np.abs(run["theta"]).max()
        if run.events.rest_time:
            assert run.events.rest_time == pytest.approx(free.events.rest_time, rel=1e-8)
