"""Straps and anchors of a structure on sliding feet, against integrations of one angle."""

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import rockeom as rk
from tests.refusals import told

B, H, MASS, G = 0.25, 0.9, 300.0, 9.81
INERTIA = MASS * (4 * B**2 + 4 * H**2) / 12
HELD = rk.Sliding(friction=5.0, restitution=0.0)
SIZE = {
    "mass": MASS, "height": H, "inertia": INERTIA, "base_mass": 1e-9, "base_height": 0.0,
    "base_inertia": 1e-9, "half_width": B,
}  # fmt: skip
FINE = rk.SolverOptions(rtol=1e-11, atol=1e-12)


def statue(*restraint) -> rk.LumpedMassStructure:
    return rk.LumpedMassStructure(**SIZE, support=HELD, restraint=restraint)


def point(theta, x, y):
    """A point of the block that turns clockwise about its right foot, from its base's middle."""
    c, s = np.cos(theta), np.sin(theta)
    return B + c * (x - B) + s * y, c * y - s * (x - B)


def leaning(theta: float, rate: float) -> dict[str, float]:
    """Turned about the right foot, which stays where it stood."""
    return {"theta": theta, "theta_dot": rate, "x": B - B * np.cos(theta)}


def turned(pull, until: float, start: float, rate: float = 0.0) -> np.ndarray:
    """theta, theta' at a time, about the right foot, under M(theta), of a tie against it."""

    def rates(_, state):
        theta, speed = state
        x, _ = point(theta, 0.0, H)
        moment = MASS * G * (x - B) - pull(theta)
        return [speed, moment / (INERTIA + MASS * (B**2 + H**2))]

    found = solve_ivp(rates, (0.0, until), [start, rate], rtol=1e-11, atol=1e-12, method="DOP853")
    return found.y[:, -1]


def moment_of_strap(theta, at, to, stiffness, pretension=0.0):
    """Force of a strap times the change of its length, by differences of exact lengths."""

    def length(angle):
        x, y = point(angle, *at)
        return np.hypot(x - to[0], y - to[1])

    arm = (length(theta + 1e-6) - length(theta - 1e-6)) / 2e-6
    return max(pretension + stiffness * (length(theta) - length(0.0)), 0.0) * arm


STRAP = {"at": (-0.25, 1.6), "to": (-0.6, 1.7), "stiffness": 2e4}


@pytest.mark.parametrize("pretension", [0.0, 200.0])
def test_a_strap_turns_a_statue_back_as_its_exact_length_has_it(pretension):
    block = statue(rk.Strap(**STRAP, pretension=pretension))
    start, until = leaning(0.08, 0.4), 0.05
    run = rk.simulate(block, rk.GroundMotion.none(until), initial=start, options=FINE)
    of = [STRAP["at"], STRAP["to"], STRAP["stiffness"], pretension]
    own = turned(
        lambda theta: moment_of_strap(theta, *of), until, start["theta"], start["theta_dot"]
    )
    assert [run.final["theta"], run.final["theta_dot"]] == pytest.approx(own, rel=1e-8)


def test_a_strap_breaks_and_leaves_the_statue_to_itself():
    limit = 1500.0
    block = statue(rk.Strap(**STRAP, breaks_at=rk.Break(force=limit)))
    start = leaning(0.03, 1.2)
    run = rk.simulate(block, rk.GroundMotion.none(0.3), initial=start, options=FINE)
    (at,) = [event.time for event in run.events if event.kind == "break"]
    of = [STRAP["at"], STRAP["to"], STRAP["stiffness"]]
    theta, speed = turned(
        lambda theta: moment_of_strap(theta, *of), at, start["theta"], start["theta_dot"]
    )
    x, y = point(theta, *STRAP["at"])
    (x0, y0), (to_x, to_y) = STRAP["at"], STRAP["to"]
    drawn = np.hypot(x - to_x, y - to_y) - np.hypot(x0 - to_x, y0 - to_y)
    assert drawn * STRAP["stiffness"] == pytest.approx(limit, rel=1e-8)
    own = turned(lambda _: 0.0, 0.3 - at, theta, speed)
    assert [run.final["theta"], run.final["theta_dot"]] == pytest.approx(own, rel=1e-8)
    assert run.energy_balance().breaks == pytest.approx(limit**2 / 2 / STRAP["stiffness"])
    assert f"strap broke at {at:.4g} s, at 1500 N." in run.summary()


def test_an_anchor_holds_the_foot_that_rises():
    anchor = {"stiffness": 1e5, "slack_length": 0.01}
    block = statue(rk.Anchor(foot="left", **anchor))
    start = leaning(0.03, 0.5)
    run = rk.simulate(block, rk.GroundMotion.none(0.1), initial=start, options=FINE)

    def moment(theta):
        rise = 2 * B * np.sin(theta)
        return max(1e5 * (rise - 0.01), 0.0) * 2 * B * np.cos(theta)

    own = turned(moment, 0.1, start["theta"], start["theta_dot"])
    assert [run.final["theta"], run.final["theta_dot"]] == pytest.approx(own, rel=1e-8)
    assert np.abs(run["anchor_left_elongation"] - run["left_uplift"]).max() < 1e-15


def test_a_restrained_structure_comes_back_from_a_file(tmp_path):
    block = statue(rk.Strap(**STRAP, breaks_at=rk.Break(force=1500.0)), rk.Anchor(
        foot="right", stiffness=1e6, strength=2e3, breaks_at=rk.Break(energy=20.0)
    ))  # fmt: skip
    run = rk.simulate(block, rk.GroundMotion.none(0.05), initial=leaning(0.03, 0.0))
    run.save(tmp_path / "run.nc")
    again = rk.load(tmp_path / "run.nc")
    assert (again.structure, again.final) == (block, run.final)


def test_derivatives_by_the_strength_are_those_of_differences():
    def case(strength):
        block = statue(rk.Strap(**STRAP, strength=strength))
        start = leaning(0.03, 1.0)
        return rk.Case(block, rk.GroundMotion.none(0.3), initial=start)

    slope = rk.sensitivity(case(500.0), of=["end theta"], to=["restraint[0].strength"])
    ends = [rk.simulate(case(500.0 + d), options=FINE).final["theta"] for d in (-0.5, 0.5)]
    assert slope.derivatives[0, 0] == pytest.approx(ends[1] - ends[0], rel=1e-5)


REFUSED = {
    "pinned feet": (rk.LumpedMassStructure, {**SIZE, "restraint": rk.Strap(**STRAP)}, "Sliding("),
    "stacked blocks": (
        rk.StackedBlocks,
        {
            "lower_half_width": 0.3, "lower_half_height": 0.3, "upper_half_width": 0.2,
            "upper_half_height": 0.6, "lower_mass": 9.0, "upper_mass": 9.0, "support": HELD,
            "restraint": rk.Strap(**STRAP),
        },
        "unknown restraint (rk.HeldBlock and rk.Facade take it, and structures on rk.Sliding",
    ),
    "no restraint": (
        rk.LumpedMassStructure, {**SIZE, "support": HELD, "restraint": [1]}, "give rk.Anchor(...)",
    ),
    "two of one name": (
        rk.LumpedMassStructure,
        {**SIZE, "support": HELD, "restraint": [rk.Strap(**STRAP), rk.Strap(**STRAP)]},
        "give a name= to each",
    ),
    "another foot": (rk.Anchor, {"foot": "middle", "stiffness": 1.0}, "one of left, right"),
    "a number for a limit": (rk.Strap, {**STRAP, "breaks_at": 3.0}, "give rk.Break(force=...)"),
    "no length": (rk.Strap, {**STRAP, "to": STRAP["at"]}, "another place than that of at"),
    "no place": (rk.Strap, {**STRAP, "to": 1.0}, "give two numbers, x and y"),
    "a name of two words": (rk.Strap, {**STRAP, "name": "a b"}, "a word of the letters a to z"),
    "broken before it pulls": (
        rk.Strap, {**STRAP, "slack_length": 0.1, "breaks_at": rk.Break(extension=0.1)},
        "more than slack_length, 0.1 m",
    ),
    "hardening without a strength": (rk.Strap, {**STRAP, "hardening": 1.0}, "a finite one"),
    "a place that is no number": (rk.Strap, {**STRAP, "at": (np.nan, 1.0)}, "it must be finite"),
    "more pretension than strength": (
        rk.Strap, {**STRAP, "pretension": 2e3, "strength": 1e3}, "less than the strength, 1000 N",
    ),
    "a name that others than English have": (rk.Strap, {**STRAP, "name": "größe"}, "a to z"),
    "the name of a loss": (rk.Strap, {**STRAP, "name": "impact"}, "give another one"),
    "names of which one is a part of another": (
        rk.LumpedMassStructure,
        {**SIZE, "support": HELD, "restraint": [rk.Strap(**STRAP, name=n) for n in ("a", "a_to")]},
        "give a name= to each",
    ),
    "a push that begins before the motion": (
        rk.Push, {"at": (0.0, 1.0), "force": 1.0, "duration": 1.0, "start": -0.1}, "start is -0.1",
    ),
    "an anchor of a facade": (
        rk.Facade,
        {"thickness": 0.6, "height": 6.0, "mass": 7e3,
         "restraint": rk.Anchor(foot="left", stiffness=1e6)},
        "give rk.Strap(...)",
    ),
}  # fmt: skip


@pytest.mark.parametrize("name", REFUSED)
def test_a_restraint_that_cannot_be_is_refused(name):
    kind, values, words = REFUSED[name]
    assert words in told(kind, **values)
