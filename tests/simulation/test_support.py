"""What the ground had to give: forces found within the steps, impulses at impacts, uplift."""

import gc
import math

import numpy as np
import pytest

import rockeom as rk
from tests.typical import S1, STIFFNESS, column, on_springs

GRAVITY = 9.81
BLOCK = rk.RigidBlock(half_width=0.095, half_height=0.45, mass=200.0)
SINE = rk.GroundMotion.single_sine(6.0, 0.3, duration=1.5)
RUNS = {
    "block": lambda step: rk.simulate(
        BLOCK, rk.GroundMotion.single_sine(2.8, 0.5, duration=3.0), options=options(step)
    ),
    "column": lambda step: rk.simulate(
        column(), SINE, impact=rk.Impulsive(), options=options(step)
    ),
    "overturned": lambda step: rk.simulate(
        BLOCK, rk.GroundMotion.single_sine(5.6, 0.5, duration=3.0), options=options(step)
    ),
}


def options(step):
    return rk.SolverOptions(output_step=step)


# -- extremes within steps


# Fails where extremes are those of samples: they grow as the samples come closer.
@pytest.mark.parametrize("name", RUNS)
def test_extremes_are_those_of_ever_finer_samples_and_do_not_know_the_samples(name):
    coarse, fine = (RUNS[name](step) for step in (0.05, 2e-5))
    same = fine.extremes_of(fine.names)
    for quantity, found in coarse.extremes_of(coarse.names).items():
        assert found == same[quantity]
        values = fine[quantity]
        size = np.abs(values).max()
        assert -1e-12 * size <= found.maximum - values.max() <= 1e-6 * size, quantity
        assert -1e-12 * size <= values.min() - found.minimum <= 1e-6 * size, quantity
        assert abs(found.peak) == max(found.maximum, -found.minimum)
    assert coarse.support.friction_demand == fine.support.friction_demand
    assert coarse.support.lost_contact == fine.support.lost_contact


@pytest.mark.usefixtures("garbage_of_its_own")
@pytest.mark.parametrize("name", RUNS)
def test_memory_of_what_is_evaluated_is_free_at_once(name):
    """Not when Python next looks for garbage in cycles: it may be hundreds of megabytes."""
    names = [quantity for quantity in RUNS[name](0.05).names if quantity != "rotation_ratio"]

    def all_of_another():
        run = RUNS[name](0.05)
        return [run[quantity] for quantity in names], run.extremes_of(names)

    all_of_another()
    gc.collect()
    gc.disable()
    try:
        found = all_of_another()
        assert gc.collect() == 0
    finally:
        gc.enable()
    assert all(len(of_each) == len(names) for of_each in found)


@pytest.mark.usefixtures("garbage_of_its_own")
@pytest.mark.parametrize("name", RUNS)
def test_memory_that_an_overturning_angle_leaves_in_cycles_is_that_of_single_numbers(name):
    """SciPy's root finders leave their functions in cycles, which hold no history of a response."""
    run = RUNS[name](1e-4)
    if "rotation_ratio" not in run.names:
        pytest.skip("it has no overturning angle")
    gc.collect()
    gc.disable()
    gc.set_debug(gc.DEBUG_SAVEALL)
    try:
        history = run["rotation_ratio"]
        gc.collect()
        referents = (one for of in gc.garbage for one in gc.get_referents(of))
        left = {id(one): one for one in referents if isinstance(one, np.ndarray)}
        assert sum(array.nbytes for array in left.values()) < 10_000 < history.nbytes
    finally:
        gc.set_debug(0)
        gc.garbage.clear()
        gc.enable()


def test_extremes_stand_where_they_are():
    run = RUNS["column"](None)
    for quantity in ("displacement", "u", "u_dot", "left_uplift"):
        found = run.extremes(quantity)
        for value, time in (
            (found.maximum, found.maximum_time),
            (found.minimum, found.minimum_time),
            (found.peak, found.peak_time),
        ):
            beside = [run.at(time, side, [quantity])[quantity] for side in ("left", "right")]
            assert value == pytest.approx(min(beside, key=lambda x: abs(x - value)), abs=1e-12)
    with pytest.raises(KeyError, match="no quantity 'phi'"):
        run.extremes("phi")


@pytest.mark.parametrize("name", ["block", "column"])
def test_friction_demand_is_that_of_ever_finer_samples(name):
    demand = RUNS[name](0.05).support.friction_demand
    fine = RUNS[name](1e-5)
    across, left, right = (fine[f"{x}_reaction"] for x in ("horizontal", "left", "right"))
    samples = np.max(np.abs(across) / (left + right))
    assert 0 <= demand - samples <= 1e-5 * demand
    # and the usual samples miss some of it, where the column vibrates
    usual = RUNS[name](None)
    across, left, right = (usual[f"{x}_reaction"] for x in ("horizontal", "left", "right"))
    if name == "column":
        assert np.max(np.abs(across) / (left + right)) < demand * (1 - 1e-6)


def test_forces_of_the_law_that_held_where_the_ground_jumps():
    """A step that ends where the ground's acceleration jumps has not felt the jump.

    The block stands until a pulse of twice what lifts it: no foot is pulled at that instant.
    """
    jump = rk.GroundMotion.constant(2 * BLOCK.uplift_acceleration, 0.05)
    still = rk.GroundMotion.none(0.3).segments.copy()
    laws = np.concatenate([still, jump.segments])
    laws[1, :2] += 0.3
    run = rk.simulate(BLOCK, rk.GroundMotion(laws))
    assert run.events[0].time == 0.3
    assert not run.support.lost_contact
    # standing: nothing; at the instant of lifting by hand, m (a + H theta'') and m (g + B theta'')
    a = jump.peak
    turning = BLOCK.accelerations({}, a, mode="left")["theta"]
    across, up = a + BLOCK.half_height * turning, GRAVITY + BLOCK.half_width * abs(turning)
    assert run.support.friction_demand == pytest.approx(across / up, rel=0.3)
    assert (
        run.support.friction_demand < a / GRAVITY
    )  # that of a block that the pulse finds standing


# -- no friction suffices, or there is none to tell


def test_force_without_pressure_needs_infinite_friction():
    """The ground falls away faster than the block: a horizontal force, and nothing that presses."""
    run = rk.simulate(
        BLOCK,
        rk.GroundMotion.none(0.1),
        vertical=rk.GroundMotion.half_sine(-1.5 * GRAVITY, period=0.2),
        initial={"theta": 0.05},
    )
    assert run.support.lost_contact
    assert run.support.friction_demand == math.inf
    assert "No friction coefficient would have kept it from sliding" in run.summary()


def test_summary_never_prints_nan():
    standing = rk.simulate(BLOCK, rk.GroundMotion.none(0.1))
    assert standing.support.friction_demand == 0.0
    flying = rk.simulate(
        on_springs(), rk.GroundMotion.none(2.0), vertical=rk.GroundMotion.single_sine(30, 0.2)
    )
    cart = rk.simulate(
        rk.TwoSpringCart(**S1, foundation_stiffness=550e3), rk.GroundMotion.none(0.1)
    )
    for run in (standing, flying, cart):
        assert "nan" not in run.summary()
        assert "inf" not in run.summary()
    for run in (flying, cart):
        assert math.isnan(run.support.impact_friction_demand)  # no impulses


# -- impulses


@pytest.mark.parametrize("side", [1, -1])
def test_impulses_of_a_rectangular_block(side):
    """3 s c/(4 - 3 s^2) where angular momentum is conserved, cot(alpha) (1 - e)/(1 + e) for any e.

    The centroid moves by w (H, -+B) before and by e w (H, +-B) after: the impulse is
    m w (H (1 - e), B (1 + e)).
    """
    s, c = math.sin(BLOCK.alpha), math.cos(BLOCK.alpha)
    still, initial = rk.GroundMotion.none(2.0), {"theta": side * 0.1}
    run = rk.simulate(BLOCK, still, initial=initial)
    assert run.support.impact_friction_demand == pytest.approx(
        3 * s * c / (4 - 3 * s * s), rel=1e-12
    )
    for e in (0.0, 0.4, 0.9, 1.0):
        run = rk.simulate(BLOCK, still, initial=initial, impact=rk.VelocityRatio(e))
        expected = c / s * (1 - e) / (1 + e)
        assert run.support.impact_friction_demand == pytest.approx(expected, rel=1e-12, abs=1e-15)
        told = f"The impulses at its impacts needed {expected:.3g}."
        assert (told in run.summary()) == (e < 1)


@pytest.mark.parametrize("law", [rk.AngularMomentum(), rk.Impulsive()])
def test_impulses_of_two_masses_on_a_column(law):
    """Momenta of both masses by hand; relative to the pivot a foot away from the centreline."""
    run = rk.simulate(column(), SINE, impact=law)
    largest, seen = 0.0, set()
    for impact in run.impacts:
        momentum = []
        for mode, state in (
            (impact.mode_before, impact.before), (impact.mode_after, impact.after)
        ):  # fmt: skip
            turning, sliding, u = state["theta_dot"], state["u_dot"], state["u"]
            pivot = {"left": -1, "both": 0, "right": 1}[mode] * S1["half_width"]
            seen.add(mode)
            x = S1["mass"] * (turning * S1["height"] + sliding)
            x += S1["base_mass"] * turning * S1["base_height"]
            y = S1["mass"] * turning * (pivot - u) + S1["base_mass"] * turning * pivot
            momentum.append((x, y))
        across, up = np.subtract(*momentum[::-1])
        if abs(up) > 1e-6:
            largest = max(largest, abs(across) / up)
    assert seen >= {"left", "right"}
    assert run.support.impact_friction_demand == pytest.approx(largest, rel=1e-6)


def test_no_impact_needs_no_friction():
    assert rk.simulate(BLOCK, rk.GroundMotion.none(0.1)).support.impact_friction_demand == 0.0


# -- impacts that can be measured


def test_impacts_above_a_rate():
    run = rk.simulate(BLOCK, rk.GroundMotion.none(15.0), initial={"theta": 0.1})
    rates = np.array([abs(impact.before["theta_dot"]) for impact in run.impacts])
    for rate in (0.0, 1e-6, 1e-3, 0.1, 10.0):
        assert len(run.impacts.above(rate)) == (rates > rate).sum()
    faster = (rates > 1e-3).sum()
    assert 0 < faster < len(rates)
    for text in (run.summary(), repr(run)):
        assert f"{len(rates)} impacts, {faster} of them faster than 0.001 rad/s" in text


# -- uplift


def test_uplift_acceleration_by_hand():
    total = S1["mass"] + S1["base_mass"]
    moment = S1["mass"] * S1["height"] + S1["base_mass"] * S1["base_height"]
    weight = total * GRAVITY * S1["half_width"]
    wall = rk.SimplifiedSubstituteGravityWall.thesis()  # 4-32: its tendon holds it down, too
    held_down = wall.mass * GRAVITY + wall.initial_force
    expected = {
        wall: held_down * wall.half_width / (wall.mass * wall.centroid_height),
        BLOCK: GRAVITY * math.tan(BLOCK.alpha),
        rk.SlenderBlock(radius=1.2, alpha=0.2): GRAVITY * 0.2,
        rk.LumpedMassStructure(**S1): weight / moment,
        # the column has bent by m a/k, and its weight with it
        column(): weight / (moment + S1["mass"] ** 2 * GRAVITY / STIFFNESS),
    }
    for structure, acceleration in expected.items():
        assert structure.uplift_acceleration == pytest.approx(acceleration, rel=1e-9)
    assert on_springs().uplift_acceleration is None


@pytest.mark.parametrize("sign", [1, -1])
def test_motion_that_never_lifts_says_when_it_would(sign):
    lifts = BLOCK.uplift_acceleration
    below, above = (
        rk.simulate(BLOCK, rk.GroundMotion.constant(sign * share * lifts, 0.2))
        for share in (1 - 1e-9, 1 + 1e-9)
    )
    assert below.support.never_lifted
    assert f"lifts it at {lifts:.4g} m/s2" in below.summary()
    assert f"the largest was {below.motion.peak:.4g} m/s2" in below.summary()
    assert not above.support.never_lifted
    assert "never lifted" not in above.summary()


# -- hints


def test_inertia_that_no_body_of_this_size_has():
    size = {"half_width": 0.3, "half_height": 0.4, "mass": 2.0}  # R = 0.5, m R**2 = 0.5
    for inertia in (None, 0.0, 0.1, 0.5):
        assert rk.RigidBlock(**size, inertia=inertia).hints() == ()
    (hint,) = rk.RigidBlock(**size, inertia=0.6).hints()
    assert "inertia is 0.6 kg m2" in hint
    assert "at most m R**2 = 0.5 kg m2" in hint
    assert rk.SlenderBlock(radius=0.5, alpha=0.2, mass=2.0, inertia=0.5).hints() == ()
    assert rk.SlenderBlock(radius=0.5, alpha=0.2, mass=2.0, inertia=0.6).hints()
    assert rk.NondimensionalBlock(alpha=0.2, radius_ratio=0.75).hints() == ()
    for ratio in (0.49, 1.01):
        assert rk.NondimensionalBlock(alpha=0.2, radius_ratio=ratio).hints()


@pytest.mark.parametrize("side", [1, -1])
def test_start_beyond_the_balance(side):
    still = rk.GroundMotion.none(0.01)
    structures = {BLOCK: BLOCK.alpha, column(): math.atan2(
        (S1["mass"] + S1["base_mass"]) * S1["half_width"],
        S1["mass"] * S1["height"] + S1["base_mass"] * S1["base_height"],
    )}  # fmt: skip
    for structure, balance in structures.items():
        for share in (0.99, 1.01):
            run = rk.simulate(structure, still, initial={"theta": side * share * balance})
            assert bool(run.hints) == (share > 1)
            assert ("Hint: The initial theta" in run.summary()) == (share > 1)
    assert (
        f"overturning angle, {BLOCK.alpha:.4g} rad"
        in rk.simulate(BLOCK, still, initial={"theta": side * 0.3}).summary()
    )
