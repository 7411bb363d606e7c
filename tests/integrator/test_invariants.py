"""What no way of integrating may change: mirror, scale, cuts; and what an impact may not give."""

import math

import numpy as np
import pytest
from hypothesis import example, given, settings, strategies as st

import rockeom as rk
from tests.typical import S1, column, on_springs

STRUCTURES = {
    s.model: s
    for s in (
        rk.RigidBlock.from_frequency(p=2.14, alpha=0.25),
        rk.SlenderBlock.from_frequency(p=2.14, alpha=0.25),
        rk.NondimensionalBlock(alpha=0.3),
        rk.LumpedMassStructure(**S1),
        column(),
        on_springs(),
        rk.TwoSpringCart(**S1, foundation_stiffness=550e3),
    )
}
ALL = pytest.mark.parametrize("structure", STRUCTURES.values(), ids=STRUCTURES)
EVEN = {"heave", "heave_dot"}
SIDES = {"left": "right", "right": "left", "both_left": "both_right", "both_right": "both_left"}


def law(structure, e):
    if structure.model == "two_spring_structure":
        return None
    return rk.Impulsive() if structure.model == "flexible_structure" else rk.VelocityRatio(e)


def record(seed, structure, samples=60, dt=0.03):
    """Smoothed noise, in the units of the structure."""
    unit = 1.0 if structure.model == "nondimensional_block" else 9.81
    a = np.convolve(np.random.default_rng(seed).normal(size=samples), np.ones(3) / 3, "same")
    return rk.GroundMotion.from_array(0.5 * unit * a, dt)


seeds = st.integers(0, 2**32 - 1)


# -- mirror


@ALL
@settings(max_examples=15)
@given(seed=seeds, tilt=st.floats(-0.05, 0.05), e=st.floats(0.0, 1.0))
def test_mirror_image_to_the_last_bit(structure, seed, tilt, e):
    """theta to -theta, a_g to -a_g, under vertical shaking that stays as it is."""
    rotation, rate = structure.states[0], structure.states[len(structure.states) // 2]
    motion, vertical = record(seed, structure), record(seed + 1, structure).scaled(0.3)
    run, image = (
        rk.simulate(
            structure,
            horizontal,
            vertical=vertical,
            impact=law(structure, e),
            initial={rotation: start, rate: -2 * start},
        )
        for horizontal, start in ((motion, tilt), (-motion, -tilt))
    )
    assert image.outcome is run.outcome
    np.testing.assert_array_equal(image.t, run.t)
    for name in run.states:
        np.testing.assert_array_equal(image[name], run[name] if name in EVEN else -run[name])
    assert [(e.time, e.kind, SIDES.get(e.mode_after, e.mode_after)) for e in image.events] == [
        (e.time, e.kind, e.mode_after) for e in run.events
    ]


# -- scale


@settings(max_examples=20)
@given(
    power=st.integers(-20, 20),
    seed=seeds,
    e=st.floats(0.3, 1.0),
)
def test_scaling_by_p_is_exact_for_powers_of_two(power, seed, e):
    """p to p/2^n and all times by 2^n: the same numbers, to the accuracy of the tolerances."""
    factor = 2.0**power
    block, motion = STRUCTURES["rigid_block"], record(seed, STRUCTURES["rigid_block"])
    other = rk.RigidBlock(
        half_width=block.half_width * factor**2,
        half_height=block.half_height * factor**2,
        mass=block.mass,
    )
    a = rk.simulate(block, motion, impact=rk.VelocityRatio(e), initial={"theta": 0.05})
    b = rk.simulate(
        other, motion.scaled(time=factor), impact=rk.VelocityRatio(e), initial={"theta": 0.05}
    )
    assert b.outcome is a.outcome
    times = [[event.time for event in run.events if event.time < 0.9 * run.t[-1]] for run in (a, b)]
    n = min(len(times[0]), 12)
    np.testing.assert_allclose(np.array(times[1][:n]) / factor, times[0][:n], rtol=1e-7)
    end = times[0][n - 1] if n else a.t[-1]
    t = np.linspace(0, min(end, 0.99 * a.t[-1]), 40)
    np.testing.assert_allclose(b.at(factor * t)["theta"], a.at(t)["theta"], atol=1e-8)


# -- steps


# Fails now and then for the two-spring structure: when a damped foot is found to land depends on
# the steps, see test_guard_with_a_kink_in_the_step.
@ALL
@settings(max_examples=15)
@given(
    seed=seeds,
    e=st.floats(0.0, 0.9),
    tilt=st.sampled_from([0.0, 0.02]),
    times=st.floats(0.3, 2.0),
    shaken_up=st.booleans(),
)
def test_smaller_steps_change_no_event(structure, seed, e, tilt, times, shaken_up):
    """An event that a long step misses, invents or misplaces is not in the run with short ones.

    Up to the first rest, and no more than ten: from there on rounding errors may have grown.
    """
    motion = record(seed, structure).scaled(times)
    vertical = record(seed + 1, structure).scaled(0.5 * times) if shaken_up else None
    runs = [
        rk.simulate(
            structure,
            motion,
            vertical=vertical,
            impact=law(structure, e),
            initial={structure.states[0]: tilt},
            options=options,
        )
        for options in (
            None,
            rk.SolverOptions(rtol=1e-12, atol=1e-14, max_step=motion.duration / 2000),
        )
    ]
    # impacts just before a rest are followed or summed up, whichever comes first
    ends = [
        x.time for run in runs for x in run.events if x.kind != "switch" and x.mode_after == "both"
    ]
    end = min(ends, default=math.inf) - 1e-4
    long, short = ([x for x in run.events if x.time < end][:10] for run in runs)
    assert [x.mode_after for x in long] == [x.mode_after for x in short]
    np.testing.assert_allclose(
        [x.time for x in long], [x.time for x in short], atol=1e-6 * motion.duration
    )
    assert runs[0].outcome not in (
        rk.Outcome.CHATTER, rk.Outcome.STALLED, rk.Outcome.NOT_FINITE
    )  # fmt: skip


@settings(max_examples=20)
@given(seed=seeds, e=st.floats(0.3, 0.9), times=st.floats(0.3, 2.0))
def test_both_methods_find_the_same_events(seed, e, times):
    block = STRUCTURES["rigid_block"]
    motion = record(seed, block).scaled(times)
    high, low = (
        rk.simulate(
            block,
            motion,
            impact=rk.VelocityRatio(e),
            initial={"theta": 0.05},
            options=rk.SolverOptions(method=name, rtol=1e-12, atol=1e-14),
        )
        for name in ("DOP853", "RK45")
    )
    assert low.outcome is high.outcome
    end = (high.events.rest_time or math.inf) - 1e-4
    of_high, of_low = ([x for x in run.events if x.time < end][:10] for run in (high, low))
    assert [x.mode_after for x in of_low] == [x.mode_after for x in of_high]
    np.testing.assert_allclose(
        [x.time for x in of_low], [x.time for x in of_high], rtol=1e-8, atol=1e-9
    )


# -- energy at impacts


@settings(max_examples=25)
@given(
    name=st.sampled_from([n for n in STRUCTURES if n != "two_spring_structure"]),
    seed=seeds,
    e=st.floats(0.0, 1.0),
)
def test_no_impact_in_a_shaken_motion_gives_energy(name, seed, e):
    structure = STRUCTURES[name]
    run = rk.simulate(structure, record(seed, structure), impact=law(structure, e))
    for impact in run.impacts:
        before = sum(structure.energies(impact.before, impact.mode_before).values())
        after = sum(structure.energies(impact.after, impact.mode_after).values())
        rest = structure.energies({}, impact.mode_after)
        assert after - before <= 1e-12 * max(abs(sum(rest.values())), abs(before))


# -- cut in two and continued


def from_time(motion, t):
    """The rest of a motion from time t on."""
    laws = motion.segments[motion.segments[:, 1] > t].copy()
    passed = max(t - laws[0, 0], 0.0)
    linear, sine = laws[0, 2] == 0, laws[0, 2] == 1
    if linear:
        laws[0, 3] += laws[0, 4] * passed
    elif sine:
        laws[0, 5] += laws[0, 4] * passed
    else:
        laws[0, 5] -= passed
    laws[:, :2] -= t
    laws[0, 0] = 0.0
    return rk.GroundMotion(laws)


def test_rest_of_a_motion_is_the_motion_later():
    """The helper itself, for every kind of law."""
    for motion in (
        rk.GroundMotion.ricker(3.0, period=0.4),
        rk.GroundMotion.ricker(3.0, period=0.4, antisymmetric=True),
        rk.GroundMotion.single_cosine(2.0, period=0.7),
        record(3, STRUCTURES["rigid_block"]),
    ):
        t = np.linspace(0, 1, 33)
        np.testing.assert_allclose(
            from_time(motion, 0.31).acceleration(t), motion.acceleration(0.31 + t), atol=1e-12
        )


# Fails now and then for the two-spring structure: when a damped foot is found to land depends on
# the steps, see test_guard_with_a_kink_in_the_step.
@ALL
@settings(max_examples=12)
@given(seed=seeds, cut=st.floats(0.1, 0.9), smooth=st.booleans())
@example(seed=542610, cut=0.5, smooth=False)  # leans back on its springs when the ground stops
def test_response_cut_in_two_and_continued_is_the_whole(structure, seed, cut, smooth):
    """Wherever it is cut; to 1e-7 of the largest rotation, far above the tolerance of 1e-10."""
    motion = record(seed, structure)
    if smooth:
        motion = rk.GroundMotion.ricker(motion.peak, period=0.4, duration=1.8)
    options = {"impact": law(structure, 0.9), "vertical": None}
    start = {structure.states[0]: 0.02}
    whole = rk.simulate(structure, motion, initial=start, **options)
    cut *= whole.t[-1]
    first = rk.simulate(structure, motion, initial=start, duration=cut, **options)
    assert first.t[-1] == cut
    rest = rk.simulate(
        structure,
        from_time(motion, cut),
        initial=first.final,
        mode=str(first.mode[-1]),
        duration=motion.duration - cut,
        **options,
    )
    assert rest.outcome is whole.outcome
    t = np.linspace(cut, whole.t[-1], 50)[1:-1]
    for name in structure.states:
        scale = np.abs(whole[name]).max()
        # at a jump either side may be asked: leave its instants out
        clear = (
            np.min([np.abs(t - e.time) for e in whole.events] or [np.full(len(t), 1.0)], axis=0)
            > 1e-6
        )
        np.testing.assert_allclose(
            rest.at(np.minimum(t - cut, rest.t[-1]))[name][clear],
            whole.at(t)[name][clear],
            atol=1e-7 * scale,
        )


def test_response_cut_at_its_own_impacts_is_the_whole():
    """Continued from both sides of every impact: before it, it happens; after it, it does not."""
    block, motion = STRUCTURES["rigid_block"], rk.GroundMotion.none(5.0)
    whole = rk.simulate(block, motion, initial={"theta": 0.1}, impact=rk.VelocityRatio(0.9))
    for n, impact in enumerate(whole.impacts[:4]):
        for state, mode, first in (
            (impact.before, impact.mode_before, n),
            (impact.after, impact.mode_after, n + 1),
        ):
            side = 1 if mode == "right" else -1
            state = state | {"theta": side * abs(state["theta"])}
            rest = rk.simulate(
                block,
                rk.GroundMotion.none(5.0 - impact.time),
                initial=state,
                mode=mode,
                impact=rk.VelocityRatio(0.9),
            )
            times = [impact.time + later.time for later in rest.impacts[:3]]
            expected = [later.time for later in whole.impacts[first : first + 3]]
            np.testing.assert_allclose(times, expected, rtol=1e-9, atol=1e-12)


def test_full_record_changes_no_bit():
    """More events and steps than the records hold at a time: the loop goes on where it was."""
    block = STRUCTURES["rigid_block"]
    long = {"impact": rk.VelocityRatio(1.0), "initial": {"theta": 0.1}}
    run = rk.simulate(block, rk.GroundMotion.none(2000.0), **long)
    times = [impact.time for impact in run.impacts]
    assert len(times) > 1000
    many = rk.simulate_many(
        lambda end: rk.Case(block, rk.GroundMotion.none(end), **long),
        over={"end": [2000.0]},
        impact_times=len(times),
        sweep_options=rk.SweepOptions(lanes=False),
    )
    assert many.impacts.item() == len(times)
    np.testing.assert_array_equal(many.impact_time.values[0], times)
    assert many.final.values[0].tolist() == [*run.final.values()]
