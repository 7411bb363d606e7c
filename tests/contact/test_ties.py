"""Ties that draw tight, yield and break, against the closed forms of a mass that pulls at them."""

import pickle
from dataclasses import replace
from functools import cache

import numpy as np
import pytest

import rockeom as rk
from rockeom.symbolic import Break, Damper, Spring, Tie, Unilateral, parameter
from tests.contact import declared
from tests.refusals import told

M, K, V = 2.0, 50.0, 1.0
OMEGA = np.sqrt(K / M)
LIMIT = parameter("F_u", "limit", "-", "limit at which the tie breaks")
FINE = rk.SolverOptions(rtol=1e-12, atol=1e-13)


@cache
def torn(limit: str, **tie) -> type:
    """A block that moves in flight along a tie, which does not turn it."""
    of = declared.on_points(f"torn_by_{limit}_{len(tie)}", {"tip": (0, 0)}, LIMIT)
    pulled = declared.block().position[0]
    breaks = {} if limit == "none" else {"breaks_at": Break(**{limit: LIMIT.symbol})}
    return replace(of, elements=(Tie("tie", pulled, K, **tie, **breaks),))


VALUES = {
    "mass": M, "height": 1.0, "inertia": 0.7, "gravity": 9.81, "friction": 0.4,
    "restitution": 0.0, "limit": 0.2,
}  # fmt: skip


def case(limit: str, value: float, duration: float, initial=None, **tie) -> rk.Case:
    block = rk.structure(torn(limit, **tie), **(VALUES | {"limit": value}))
    start = {"y": 100.0, "x_dot": V} if initial is None else initial
    return rk.Case(block, rk.GroundMotion.none(duration), initial=start)


def run_of(*of, **tie) -> rk.Response:
    return rk.simulate(case(*of, **tie), options=FINE)


def quarter(force: float, speed: float = V) -> float:
    """Time of a spring without force to reach one, from a speed."""
    return float(np.arcsin(force * OMEGA / (K * speed)) / OMEGA)


def after(*losses: float) -> float:
    """Speed when so much energy is gone."""
    return float(np.sqrt(V**2 - 2.0 * sum(losses) / M))


def tensed(pretension: float, force: float) -> float:
    """Time from a pretension to a force, from the speed V."""
    phase, amplitude = np.arctan2(pretension / K, V / OMEGA), np.hypot(pretension / K, V / OMEGA)
    return float((np.arcsin(force / K / amplitude) - phase) / OMEGA)


YIELDED = quarter(3.0)
FLOW = after(9.0 / (2 * K))  # speed at which it begins to flow
HARD = 10.0 * K / (10.0 + K)  # stiffness with a hardening of 10 N/m
HARD_OMEGA = np.sqrt(HARD / M)


def hardened(extra: float) -> float:
    """Time in which a force beyond 3 N grows while it flows with hardening."""
    amplitude = np.hypot(3.0 / HARD, FLOW / HARD_OMEGA)
    phase = np.arcsin(3.0 / HARD / amplitude)
    return float((np.arcsin((3.0 + extra) / HARD / amplitude) - phase) / HARD_OMEGA)


# limit and its value, tie: times of its events, loss by yielding, energy that it holds at the break
BREAKS = {
    "by force": ("force", 3.0, {}, [quarter(3.0)], 0.0, 9.0 / (2 * K)),
    "by extension": ("extension", 0.05, {}, [quarter(2.5)], 0.0, 2.5**2 / (2 * K)),
    "slack first": (
        "force", 3.0, {"slack_length": 0.2}, [0.2 / V, 0.2 / V + quarter(3.0)], 0.0, 9.0 / (2 * K),
    ),
    "with pretension": (
        "force", 3.0, {"pretension": 1.0}, [tensed(1.0, 3.0)], 0.0, 9.0 / (2 * K) - 1.0 / (2 * K),
    ),
    "by energy": (
        "energy", 0.3, {"strength": 3.0},
        [YIELDED, YIELDED + (FLOW - after(9.0 / (2 * K), 0.3)) / (3.0 / M)], 0.3, 9.0 / (2 * K),
    ),
    "by force of hardening": (
        "force", 3.5, {"strength": 3.0, "hardening": 10.0},
        [YIELDED, YIELDED + hardened(0.5)], 3.0 * 0.05, 3.5**2 / (2 * K) + 10.0 * 0.05**2 / 2,
    ),
    "slack, then by force of hardening": (
        "force", 3.5, {"strength": 3.0, "hardening": 10.0, "slack_length": 0.2},
        [0.2 / V, 0.2 / V + YIELDED, 0.2 / V + YIELDED + hardened(0.5)], 3.0 * 0.05,
        3.5**2 / (2 * K) + 10.0 * 0.05**2 / 2,
    ),
}  # fmt: skip


@pytest.mark.parametrize("name", BREAKS)
def test_a_tie_breaks_where_its_closed_form_has_it(name):
    limit, value, tie, times, yielded, held = BREAKS[name]
    run = run_of(limit, value, 1.0, **tie)
    assert run.events.times == pytest.approx(times, abs=1e-8)
    assert [event.kind for event in run.events][-1] == "break"
    assert run["tie_broken"][[0, -1]].tolist() == [0.0, 1.0]
    assert run["x_dot"][-1] == pytest.approx(after(yielded, held), rel=1e-10)
    stored = tie.get("pretension", 0.0) ** 2 / (2 * K)
    balance = run.energy_balance()
    assert balance.breaks == run["tie_break"][-1] == pytest.approx(held + stored, rel=1e-10)
    assert run["tie_loss"][-1] == pytest.approx(yielded, rel=1e-9, abs=1e-12)
    assert balance.error < 1e-10
    record = run.ties["tie"]
    assert record.broke_at == run.events.times[-1]
    assert record.largest_force == pytest.approx(run["tie_force"].max(), rel=1e-9)
    drawn = "slack" in name  # tight; it pulls until it breaks
    assert record.tightenings == drawn
    assert record.snatch_force == pytest.approx(drawn * record.largest_force)
    assert record.dissipated == run["tie_loss"][-1]
    # the state before the break is at the limit but for rounding: it breaks at once
    again = run_of(limit, value, 1.0 - times[-1], run.events[-1].before, **tie)
    assert (again.events[-1].kind, again.events[-1].time) == ("break", pytest.approx(0.0, abs=1e-8))
    assert again.final["x"] == pytest.approx(run.final["x"], rel=1e-9)


@pytest.mark.parametrize("until", [0.03, 0.5])
def test_a_motion_continues_from_its_final_state_whole_or_broken(until):
    whole = run_of("force", 3.0, 1.0)
    first = run_of("force", 3.0, until)
    rest = run_of("force", 3.0, 1.0 - until, first.final)
    for name, value in whole.final.items():
        assert rest.final[name] == pytest.approx(value, rel=1e-9, abs=1e-9)


def test_a_broken_strap_of_a_bouncing_block_stays_broken_to_the_last_bit():
    strap = rk.Strap(at=(-0.2, 1.1), to=(-0.6, 1.1), stiffness=1e5, breaks_at=rk.Break(force=500.0))
    block = rk.HeldBlock(
        width=0.4, height=1.2, mass=60.0, friction=0.45, restitution=0.9, restraint=strap
    )
    start, loose = {"theta": 0.1, "strap_broken": 1.0}, rk.SolverOptions("RK45", rtol=1e-6)
    run = rk.simulate(block, rk.GroundMotion.none(3.0), initial=start, options=loose)
    assert len(run.events) > 300
    assert {e.after["strap_broken"] for e in run.events} == {1.0}
    quiet = rk.GroundMotion.none(0.1)
    assert rk.simulate(block, quiet, initial=run.final).final["strap_broken"] == 1.0


def test_break_is_kept_by_pickles_and_sweeps():
    of = case("force", 3.0, 1.0)
    run = pickle.loads(pickle.dumps(rk.simulate(of)))
    assert run.energy_balance().breaks == pytest.approx(9.0 / (2 * K))
    starts = {"x_dot": [0.1, 0.5, V]}
    sweep = rk.simulate_many(
        lambda x_dot: replace(of, initial={"y": 100.0, "x_dot": x_dot}), over=starts
    )
    broken = sweep["final"].sel(state="tie_broken").values.tolist()
    assert broken == [0.0, 1.0, 1.0]


@pytest.mark.parametrize("name", BREAKS)
def test_derivatives_pass_through_a_break(name):
    limit, value, tie, times, *_ = BREAKS[name]
    answers = [f"event {len(times)} time", "end x", "end x_dot"]
    of = case(limit, value, 1.0, **tie)
    slopes = rk.sensitivity(of, of=answers, to=["limit"], options=FINE).derivatives[:, 0]
    step = 1e-4 * value
    runs = [run_of(limit, value + k * step, 1.0, **tie) for k in (-2, -1, 1, 2)]
    ends = [np.array([r.events[-1].time, r.final["x"], r.final["x_dot"]]) for r in runs]
    central = (ends[0] - 8 * ends[1] + 8 * ends[2] - ends[3]) / (12 * step)
    np.testing.assert_allclose(slopes, central, rtol=1e-6)


@pytest.mark.parametrize("part", [1.0, 1.0 - 1e-12, 1.0 - 1e-9])
def test_a_break_that_is_just_reached_has_no_derivatives_and_says_so(part):
    of = case("force", part * V * np.sqrt(K * M), 1.0)  # of the force where the mass turns back
    assert [event.kind for event in rk.simulate(of, options=FINE).events] == ["break"]
    slopes = rk.sensitivity(of, of=["end x"], to=["limit"], options=FINE)
    assert np.isnan(slopes.derivatives).all()
    assert "flight to tie_slack, grazes: its guard falls so slowly" in str(slopes)


def test_a_tie_without_a_strength_has_two_states_and_no_variable_of_its_own():
    tie = Tie("tie", declared.block().position[0], K)
    assert (tie.states, tie.internal) == ((0, -1), ())
    run = run_of("none", 1.0, 2.0, slack_length=0.05)
    switches = [event.time for event in run.events]
    assert switches == pytest.approx([0.05 / V, 0.05 / V + np.pi / OMEGA], abs=1e-8)


@cache
def damped(stop: bool):
    """The block on a damper that breaks at its stroke, or meets a stop there."""
    of = declared.on_points(f"damped_{stop}", {"tip": (0, 0)}, LIMIT)
    pulled, stroke = declared.block().position[0], LIMIT.symbol
    elements = (Damper("damper", pulled, 4.0, stroke),)
    if stop:
        elements = (Spring("damper", pulled, damping=4.0), Unilateral("stop", pulled - stroke, K))
    return replace(of, elements=elements)


STROKE = 0.2
AT_END = V - 4.0 * STROKE / M  # speed at the end of the stroke
TO_END = -M / 4.0 * np.log(AT_END / V)


@pytest.mark.parametrize("speed", [V, -V])
def test_a_damper_breaks_at_the_end_of_its_stroke(speed):
    of = replace(case("force", 1.0, 1.0), structure=rk.structure(damped(False), **VALUES))
    run = rk.simulate(replace(of, initial={"y": 100.0, "x_dot": speed}), options=FINE)
    assert [e.kind for e in run.events] == ["break"]
    assert run.events.times == pytest.approx([TO_END], abs=1e-8)
    assert run["x_dot"][-1] == pytest.approx(np.sign(speed) * AT_END, rel=1e-9)
    beyond = {"y": 100.0, "x": 1.01 * np.sign(speed) * STROKE}
    assert "beyond the limit" in told(rk.simulate, replace(of, initial=beyond))
    assert run["damper_loss"][-1] == pytest.approx(0.5 * M * (V**2 - AT_END**2), rel=1e-9)
    assert run.energy_balance().breaks == 0.0


def test_a_damper_meets_a_stop_at_the_end_of_its_stroke():
    of = replace(case("force", 1.0, 1.0), structure=rk.structure(damped(True), **VALUES))
    meets, leaves = rk.simulate(of, options=FINE).events.times
    assert meets == pytest.approx(TO_END, abs=1e-8)
    decay, omega = 4.0 / (2 * M), np.sqrt(K / M - (4.0 / (2 * M)) ** 2)
    assert leaves - meets == pytest.approx(np.pi / omega, abs=1e-8)
    assert decay < omega


REFUSED = {
    "beyond its limit": ({"y": 100.0, "x": 0.2}, "beyond the limit at which it breaks: give tie_"),
    "half broken": ({"y": 100.0, "tie_broken": 0.5}, "tie_broken is 0.5: give 0, or 1 once it has"),
}


@pytest.mark.parametrize("name", REFUSED)
def test_a_start_that_is_neither_whole_nor_broken_is_refused(name):
    initial, words = REFUSED[name]
    assert words in told(rk.simulate, case("force", 3.0, 0.1, initial))


def test_a_mode_in_which_a_broken_tie_pulls_is_refused():
    broken = case("force", 3.0, 0.1, {"y": 100.0, "x": 0.02, "tie_broken": 1.0})
    assert "contradicts tie_broken = 1" in told(rk.simulate, replace(broken, mode="flight"))
    assert rk.simulate(broken).mode[0] == "tie_slack"


@pytest.mark.parametrize(
    ("tie", "words"),
    [
        ({"hardening": 1.0}, "give a finite one, at which it yields"),
        ({"breaks_at": Break(energy=1.0)}, "give a finite one, at which it yields"),
        ({"breaks_at": 3.0}, "give such as Break(force=F_u)"),
        ({"strength": 0}, "strength is 0: give a positive one"),
        ({"slack_length": -1}, "slack_length is -1"),
    ],
)
def test_a_tie_that_cannot_be_is_refused(tie, words):
    assert words in told(Tie, "tie", declared.block().position[0], K, **tie)


@pytest.mark.parametrize("limits", [{}, {"force": 1.0, "energy": 2.0}])
def test_a_break_has_one_limit(limits):
    assert "give one of force, extension and energy" in told(Break, **limits)
