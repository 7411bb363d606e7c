"""The answers of all cases by rockeom."""

import math
from collections.abc import Mapping

import numpy as np
from scipy.optimize import brentq

import rockeom as rk

Numbers = Mapping[str, float]
Answer = dict[str, float]
TIGHT = rk.SolverOptions("DOP853", rtol=1e-13, atol=1e-15)


def _run(structure: rk.Structure, duration: float, motion=None, **more) -> rk.Response:
    motion = motion or rk.GroundMotion.none(duration)
    return rk.simulate(structure, motion, duration=duration, options=TIGHT, **more)


def _block(p: Numbers) -> rk.RigidBlock:
    return rk.RigidBlock(
        half_width=p["half_width"], half_height=p["half_height"], mass=p["mass"],
        gravity=p["gravity"],
    )  # fmt: skip


def _sliding(p: Numbers) -> rk.SlidingBlock:
    return rk.SlidingBlock(
        half_width=p["half_width"], half_height=p["half_height"], mass=p["mass"],
        gravity=p["gravity"], friction=p["friction"], restitution=p.get("restitution", 0.0),
    )  # fmt: skip


def _events(run: rk.Response, kind: str) -> list:
    return [event for event in run.events if event.kind == kind]


def _turned(run: rk.Response, rotation: float) -> float:
    """When it has turned so far, at last, on its way down."""
    last = int(np.nonzero(run.theta <= rotation)[0][-1])
    low, high = run.t[last], run.t[last + 1]
    return brentq(lambda t: float(run.at(t)["theta"]) - rotation, low, high, xtol=1e-15)


def _ramp(p: Numbers) -> rk.GroundMotion:
    return rk.GroundMotion.from_array([0.0, p["jerk"] * 2.0], dt=2.0)


def free_decay(p: Numbers) -> Answer:
    impacts = _run(_block(p), 4.5, initial={"theta": p["rotation"]}).impacts
    return {
        "impact_1_time": impacts[0].time,
        "impact_1_rate_before": impacts[0].before["theta_dot"],
        "impact_1_rate_after": impacts[0].after["theta_dot"],
        "impact_5_time": impacts[4].time,
        "impact_10_time": impacts[9].time,
        "impact_10_rate_after": impacts[9].after["theta_dot"],
    }


def free_to_rest(p: Numbers) -> Answer:
    run = _run(_block(p), 20.0, initial={"theta": p["rotation"]})
    return {
        "impact_1_time": run.impacts[0].time,
        "impact_20_time": run.impacts[19].time,
        "rest_time": run.events.rest_time,
    }


def tipped_past_balance(p: Numbers) -> Answer:
    run = _run(_block(p), 5.0, initial={"theta": p["rotation"]})
    when = _turned(run, p["end_rotation"])
    return {"fall_time": when, "fall_rate": float(run.at(when)["theta_dot"])}


def threshold_pulse(p: Numbers) -> Answer:
    """Bisection of the duration by the outcome."""
    block = _block(p)

    def run(duration: float) -> rk.Response:
        pulse = rk.GroundMotion.constant(-p["amplitude"], duration, duration + 30.0)
        return _run(block, duration + 30.0, pulse)

    low, high = 0.3, 0.6
    for _ in range(50):
        middle = 0.5 * (low + high)
        low, high = (low, middle) if run(middle).overturned else (middle, high)
    pulse = rk.GroundMotion.constant(-p["amplitude"], low, low)
    return {
        "threshold_duration": low,
        "threshold_rotation": _run(block, low, pulse).final["theta"],
    }


def rocking_frame(p: Numbers) -> Answer:
    frame = rk.RockingFrame(
        columns=2, column_mass=p["column_mass"], half_width=p["half_width"],
        half_height=p["half_height"], beam_mass=p["beam_mass"], gravity=p["gravity"],
    )  # fmt: skip
    impacts = _run(frame, 5.0, initial={"theta": p["rotation"]}).impacts
    return {
        "impact_1_time": impacts[0].time,
        "impact_1_rate_before": impacts[0].before["theta_dot"],
        "impact_1_rate_after": impacts[0].after["theta_dot"],
        "impact_5_time": impacts[4].time,
    }


def threshold_slide(p: Numbers) -> Answer:
    run = _run(_sliding(p), p["time"], _ramp(p))
    return {
        "slip_begins": _events(run, "slip begins")[0].time,
        "displacement": run.final["x"],
        "velocity": run.final["x_dot"],
    }


def slide_to_stop(p: Numbers) -> Answer:
    run = _run(_sliding(p), 2.0, initial={"x_dot": p["velocity"]})
    return {"stop_time": _events(run, "slip ends")[0].time, "displacement": run.final["x"]}


def stick_slip(p: Numbers) -> Answer:
    motion = rk.GroundMotion.harmonic(p["amplitude"], duration=2.0, period=p["period"])
    run = _run(_sliding(p), 2.0, motion)
    begins, ends = _events(run, "slip begins"), _events(run, "slip ends")
    return {
        "slip_1_begins": begins[0].time,
        "slip_1_ends": ends[0].time,
        "displacement_after_slip_1": ends[0].after["x"],
        "slip_2_begins": begins[1].time,
        "slip_2_ends": ends[1].time,
    }


def bounce(p: Numbers) -> Answer:
    run = _run(_sliding(p), 4.0, initial={"y": p["height"]})
    landings = _events(run, "landing")
    times = {f"landing_{n}_time": landings[n - 1].time for n in (1, 2, 5)}
    return {**times, "rest_time": run.events.rest_time}


def drop_on_corner(p: Numbers) -> Answer:
    height = p["height"] + p["half_width"] * math.sin(p["rotation"])
    run = _run(_sliding(p), 0.4, initial={"y": height, "theta": p["rotation"]})
    first, second = _events(run, "landing")[:2]
    after = second.after
    up = after["y_dot"] - p["half_height"] * math.sin(after["theta"]) * after["theta_dot"]
    return {
        "landing_1_time": first.time,
        "rate_after_landing_1": first.after["theta_dot"],
        "landing_2_time": second.time,
        "rate_after_landing_2": after["theta_dot"],
        "velocity_after_landing_2": up,
    }


def _landing_of_a_slipping_foot(p: Numbers) -> Answer:
    run = _run(_sliding(p), 1.0, initial={"theta": p["rotation"]})
    landing = _events(run, "landing")[0]
    foot = landing.before["x"] + p["half_width"]
    return {
        "landing_time": landing.time,
        "rate_before": landing.before["theta_dot"],
        "slip": foot - p["half_width"] * math.cos(p["rotation"]),
    }


slide_and_rock = frictionless_release = _landing_of_a_slipping_foot


def threshold_uplift(p: Numbers) -> Answer:
    run = _run(_block(p), p["time"], _ramp(p))
    return {
        "uplift_time": _events(run, "uplift")[0].time,
        "rotation": run.final["theta"],
        "rate": run.final["theta_dot"],
    }


def _pulse(p: Numbers) -> rk.Response:
    motion = rk.GroundMotion.single_sine(p["amplitude"], p["period"], duration=6.0)
    return _run(_block(p), 6.0, motion)


def pulse_overturns(p: Numbers) -> Answer:
    run = _pulse(p)
    impact = run.impacts[0]
    return {
        "uplift_time": _events(run, "uplift")[0].time,
        "rotation_peak_1": run.extremes("theta").minimum,
        "impact_1_time": impact.time,
        "impact_1_rate_after": impact.after["theta_dot"],
        "fall_time": _turned(run, p["end_rotation"]),
    }


def pulse_safe_window(p: Numbers) -> Answer:
    run = _pulse(p)
    first, second = run.impacts[:2]
    widest = run.extremes("theta")
    return {
        "uplift_time": _events(run, "uplift")[0].time,
        "rotation_peak_1": widest.minimum,
        "impact_1_time": first.time,
        "impact_1_rate_after": first.after["theta_dot"],
        "rotation_peak_2": widest.maximum,
        "impact_2_time": second.time,
    }


def _stack(p: Numbers, lower: float) -> dict:
    structure = rk.StackedBlocks(
        **{n: v for n, v in p.items() if not n.endswith(("rotation", "time"))}
    )
    b, turn = p["upper_half_width"], p["upper_rotation"]
    # its right corner is where it stands when upright
    start = {"theta": lower, "phi": turn, "xi": b * (1.0 - math.cos(turn - lower))}
    run = _run(structure, p["time"], initial=start)
    landing = run.impacts[0]
    later = {"lower": run.final["theta"], "upper": run.final["phi"]}
    return {
        "time": landing.time, "before": landing.before, "after": landing.after,
        "later": {f"{name}_rotation_later": value for name, value in later.items()},
    }  # fmt: skip


def stack_leans(p: Numbers) -> Answer:
    landing = _stack(p, p["lower_rotation"])
    before, after = landing["before"], landing["after"]
    return {
        **landing["later"],
        "landing_time": landing["time"],
        "lower_rate_before": before["theta_dot"],
        "upper_rotation": before["phi"],
        "upper_rate_before": before["phi_dot"],
        "lower_rate_after": after["theta_dot"],
        "upper_rate_after": after["phi_dot"],
    }


def upper_block_rocks(p: Numbers) -> Answer:
    landing = _stack(p, 0.0)
    return {
        **landing["later"],
        "landing_time": landing["time"],
        "upper_rate_before": landing["before"]["phi_dot"],
        "lower_rate_after": landing["after"]["theta_dot"],
        "upper_rate_after": landing["after"]["phi_dot"],
    }


def flexible_column(p: Numbers) -> Answer:
    values = {name: value for name, value in p.items() if name != "rotation"}
    structure = rk.FlexibleStructure(**values, damping=0.0)
    run = _run(structure, 1.0, initial={"theta": p["rotation"]}, impact=rk.Impulsive())
    answer = {}
    for n, impact in enumerate(run.impacts[:3], 1):
        answer[f"impact_{n}_time"] = impact.time
        answer[f"impact_{n}_deformation"] = impact.before["u"]
        answer[f"impact_{n}_rate_after"] = impact.after["theta_dot"]
    return answer


def two_springs(p: Numbers) -> Answer:
    values = {k: v for k, v in p.items() if k not in ("rotation", "time", "stiffness")}
    structure = rk.TwoSpringStructure(
        **values, foundation_stiffness=p["stiffness"], foundation_damping=0.0
    )
    run = _run(structure, p["time"], initial={"theta": p["rotation"]})
    switches = {f"switch_{n}_time": run.events[n - 1].time for n in (1, 2, 5)}
    return {**switches, "rotation": run.final["theta"], "rate": run.final["theta_dot"]}


def spring_drop(p: Numbers) -> Answer:
    """Its mass and that of a base are parts of one; a heave counts from where it settles."""
    part = 0.5 * p["mass"]
    structure = rk.TwoSpringStructure(
        mass=part, height=p["half_height"], inertia=1.0, base_mass=part,
        base_height=p["half_height"], base_inertia=1.0, half_width=p["half_width"],
        foundation_stiffness=p["stiffness"], foundation_damping=0.0, gravity=p["gravity"],
    )  # fmt: skip
    settled = p["mass"] * p["gravity"] / (2.0 * p["stiffness"])
    run = _run(structure, 0.4, initial={"heave": p["height"] + settled})
    times = [event.time for event in run.events if "both" in (event.mode_before, event.mode_after)]
    return {
        "touch_time": times[0],
        "lift_off_time": times[1],
        "compression": settled - run.extremes("heave").minimum,
        "touch_2_time": times[2],
    }
