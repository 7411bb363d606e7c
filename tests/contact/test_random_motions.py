"""A block that slides, bounces and flies, under random shaking from random starts."""

import math

import numpy as np
import pytest

import rockeom as rk

OPTIONS = rk.SolverOptions(max_impacts=1500)
MOVED = ("x", "theta", "x_dot", "theta_dot")
"""States that change their sign in a mirror."""


def _start(seed: int):
    """(structure, motion, vertical motion, start): flat and slender, rough and smooth, shaken."""
    r = np.random.default_rng(seed)
    b = 10 ** r.uniform(-1.5, 0.5)
    h = b * 10 ** r.uniform(-0.5, 1.2)
    rough = [0.0, 0.05, 0.15, 0.3, b / h, 0.8]  # b/h: a slide and an uplift begin at once
    block = rk.SlidingBlock(
        half_width=b,
        half_height=h,
        friction=float(r.choice(rough)),
        restitution=float(r.choice([0.0, 0.0, 0.2, 0.5, 0.8])),
    )
    end = 4 * math.sqrt(h)
    shaking = [9.81 * r.uniform(0.02, 1.5) * r.normal(size=60) for _ in range(2)]
    motion = rk.GroundMotion.from_array(shaking[0], end / 60)
    vertical = rk.GroundMotion.from_array(0.5 * shaking[1], end / 60) if seed % 3 == 0 else None
    start = {}
    if seed % 2:
        start["theta"] = r.uniform(-1.0, 1.0) * math.atan(b / h)
    if seed % 4 == 0:
        start["y"] = b * abs(math.sin(start.get("theta", 0.0))) + 10 ** r.uniform(-6, 0) * h
    if seed % 5 == 0:
        start |= {"x_dot": r.normal(), "theta_dot": 0.3 * r.normal()}
    return block, motion, vertical, start


def _energy(block: rk.SlidingBlock, state: dict[str, float]) -> float:
    """Of the centroid and about it, and of the weight: typed, and not the package's."""
    p = block.parameters()
    angle, turning, h = state["theta"], state["theta_dot"], p["height"]
    across = state["x_dot"] + h * math.cos(angle) * turning
    up = state["y_dot"] - h * math.sin(angle) * turning
    kinetic = p["mass"] * (across**2 + up**2) / 2 + p["inertia"] * turning**2 / 2
    return kinetic + p["mass"] * p["gravity"] * (state["y"] + h * math.cos(angle))


@pytest.mark.parametrize("seed", range(60))
def test_no_foot_sinks_pulls_or_holds_more_than_friction(seed):
    block, motion, vertical, start = _start(seed)
    run = rk.simulate(block, motion, vertical=vertical, initial=start, options=OPTIONS)
    assert run.outcome not in (rk.Outcome.CHATTER, rk.Outcome.NOT_FINITE, rk.Outcome.STALLED)
    p = block.parameters()
    weight = p["mass"] * (p["gravity"] + motion.peak + (vertical.peak if vertical else 0.0))
    assert min(run["left_uplift"].min(), run["right_uplift"].min()) > -1e-8 * p["height"]
    assert min(run["left_reaction"].min(), run["right_reaction"].min()) > -1e-8 * weight
    pressed = run["left_reaction"] + run["right_reaction"]
    assert (abs(run["horizontal_reaction"]) - p["friction"] * pressed).max() < 1e-8 * weight
    if p["restitution"] == 0.0:
        scale = p["mass"] * p["gravity"] * p["height"] + run["kinetic_energy"].max()
        for event in run.events:
            if event.kind != "rest":  # in that time the ground works
                gain = _energy(block, event.after) - _energy(block, event.before)
                assert gain < 1e-9 * scale


def test_a_sweep_has_the_motions_of_single_cases():
    def case(friction, amplitude):
        block = rk.SlidingBlock(half_width=0.3, half_height=1.0, friction=friction, restitution=0.2)
        return rk.Case(block, rk.GroundMotion.single_sine(amplitude, 0.8, duration=3.0))

    over = {"friction": [0.1, 0.35, 0.6], "amplitude": [2.0, 5.0]}
    together = rk.simulate_many(case, over)
    for friction in over["friction"]:
        for amplitude in over["amplitude"]:
            one = case(friction, amplitude)
            run = rk.simulate(one.structure, one.motion)
            found = together.sel(friction=friction, amplitude=amplitude)
            assert str(found.outcome.item()) == str(run.outcome)
            assert found.final.values.tolist() == list(run.final.values())


@pytest.mark.parametrize("seed", range(1, 40, 3))
def test_a_mirrored_motion_is_the_mirror_of_the_motion(seed):
    block, motion, vertical, start = _start(seed)
    mirrored = {name: -x if name in MOVED else x for name, x in start.items()}
    one = rk.simulate(block, motion, vertical=vertical, initial=start, options=OPTIONS)
    other = rk.simulate(block, -motion, vertical=vertical, initial=mirrored, options=OPTIONS)
    assert other.outcome is one.outcome
    events = list(zip(one.events, other.events, strict=False))[:12]  # then rounding has grown
    for a, b in events:
        assert b.time == pytest.approx(a.time, abs=1e-9)
        for name, x in a.after.items():
            assert b.after[name] == pytest.approx(-x if name in MOVED else x, abs=1e-7)
