"""simulate_many: labels, the same bits however the work is cut, interrupts, errors by name."""

import _thread
import itertools
import os
import signal
import subprocess
import sys
import threading
import time
import tracemalloc
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st

import rockeom as rk
from rockeom.sweeps.cases import Cases, Source
from tests.interrupts import interrupted_at
from tests.sweeping import one_by_one, simulate_many

BLOCK = rk.RigidBlock.from_frequency(p=2.14, alpha=0.25)
THRESHOLD = BLOCK.gravity * np.tan(0.25)
FREQUENCY, AMPLITUDE = np.linspace(0.4, 2.5, 7), np.linspace(0.8, 6.0, 9)
OVER = {"frequency": FREQUENCY, "amplitude": AMPLITUDE}


def pulse(frequency, amplitude):
    motion = rk.GroundMotion.single_sine(amplitude * THRESHOLD, 1 / frequency, duration=8.0)
    return rk.Case(BLOCK, motion, impact=rk.VelocityRatio(0.9))


def many(**changes):
    return simulate_many(pulse, over=OVER, impact_times=20, **changes)


def environment():
    root = Path(rk.__file__).resolve().parents[1]
    return {**os.environ, "PYTHONPATH": str(root)}


@pytest.fixture(scope="module")
def reference():
    return many(threads=1)


def test_same_as_simulate():
    """Case by case: outcome, impacts and their times to the last bit, peaks, the end."""
    reference = many(threads=1, lanes=False)
    assert {"came to rest", "overturned"} <= set(reference.outcome.values.ravel().tolist())
    for f in FREQUENCY[::2]:
        for a in AMPLITUDE[::2]:
            case = pulse(f, a)
            run = rk.simulate(
                BLOCK, case.motion, impact=case.impact, options=rk.SolverOptions(output_step=1e-3)
            )
            found = reference.sel(frequency=f, amplitude=a)
            assert found.outcome.item() == run.outcome
            assert found.final_mode.item() == run.mode[-1]
            assert found.impacts.item() == len(run.impacts)
            assert found.final_time.item() == pytest.approx(run.t[-1], rel=1e-14)
            times = [impact.time for impact in run.impacts[:20]]
            np.testing.assert_array_equal(found.impact_time.values[: len(times)], times)
            assert np.isnan(found.impact_time.values[len(times) :]).all()
            assert found.final.values.tolist() == [*run.final.values()]
            # samples a millisecond apart pass beside the turning points
            rotation = found.sel(state="theta")
            assert 0 <= rotation.maximum.item() - run["theta"].max() < 1e-6
            assert 0 <= run["theta"].min() - rotation.minimum.item() < 1e-6


@settings(max_examples=20)
@given(threads=st.integers(1, 5), chunk=st.integers(1, 100), lanes=st.booleans())
def test_threads_and_chunks_change_no_bit(threads, chunk, lanes):
    one = many(threads=1, chunk=63, lanes=lanes)
    other = many(threads=threads, chunk=chunk, lanes=lanes)
    assert one.identical(other)


ALIKE, RISING, FALLING = (lambda x: 1 + 0 * x, lambda x: 1 + 9 * x, lambda x: 10 - 9 * x)


@pytest.mark.parametrize("costs", [ALIKE, RISING, FALLING], ids=["alike", "rising", "falling"])
@pytest.mark.parametrize(("total", "many", "each"), [(10_000, True, 60.0), (400, False, 0.0)])
def test_no_thread_waits_long_for_the_last_part(total, many, each, costs):
    """Two threads take the parts in turn, on cores of their own: beside an even share of the work.

    each : what a part costs besides its cases, in cases; measured of pulses in lanes.
    """
    source = Source(pulse, Cases({"n": [0] * total}), None, BLOCK.module, True, 2)
    cost, ends, first = costs(np.linspace(0, 1, total)), [0.0, 0.0], 0
    while first < total:
        n = source.size(total - first, many)
        ends[int(np.argmin(ends))] += each * cost.mean() + cost[first : first + n].sum()
        first += n
    assert max(ends) < 1.1 * cost.sum() / 2


@pytest.mark.parametrize("lanes", [True, False])
def test_order_of_the_cases_changes_no_bit(lanes):
    """What one case leaves behind in its thread must not reach the next."""
    backwards = rk.simulate_many(
        pulse,
        over={k: v[::-1] for k, v in OVER.items()},
        impact_times=20,
        sweep_options=rk.SweepOptions(lanes=lanes),
    )
    again = backwards.isel(frequency=slice(None, None, -1), amplitude=slice(None, None, -1))
    assert many(lanes=lanes).identical(again)


def test_labels_and_what_is_kept(reference):
    assert dict(reference.sizes) == {"frequency": 7, "amplitude": 9, "state": 2, "impact": 20}
    np.testing.assert_array_equal(reference.frequency, FREQUENCY)
    assert reference.state.values.tolist() == ["theta", "theta_dot"]
    assert reference.final_time.attrs["units"] == "s"
    chosen = {"method": "DOP853", "chosen": "suits most work, by the first case"}
    law = {"impact_law": "VelocityRatio(e=0.9), of the first case"}
    assert reference.attrs == {"model": "rigid_block", **chosen, **law, "interrupted": 0}
    # below the threshold nothing moves
    still = reference.sel(amplitude=0.8)
    assert set(still.outcome.values.tolist()) == {"came to rest"}
    assert not still.peak.any()
    assert not still.impacts.any()
    # impact times rise, and are as many as the impacts
    times = reference.impact_time.values
    count = np.isfinite(times).sum(axis=-1)
    np.testing.assert_array_equal(count, np.minimum(reference.impacts, 20))
    steps = np.diff(times, axis=-1)
    assert (steps[np.isfinite(steps)] > 0).all()
    # without being asked for, they are not kept
    assert "impact_time" not in rk.simulate_many(pulse, over={"frequency": [1.0], "amplitude": [2]})


def test_things_and_words_label_cases():
    """Words label themselves, motions go by their names."""
    motions = [rk.GroundMotion.none(1.0), rk.GroundMotion.constant(2 * THRESHOLD, 1.0)]
    modes = ["right", "left"]
    result = rk.simulate_many(
        lambda motion, side: rk.Case(
            BLOCK, motion, initial={"theta": 0.1 if side == "right" else -0.1}
        ),
        over={"motion": motions, "side": modes},
    )
    assert result.motion.values.tolist() == [motion.name for motion in motions]
    assert result.side.values.tolist() == modes
    theta = result.minimum.sel(state="theta")
    assert theta.sel(motion="no shaking", side="left") == -0.1
    assert theta.sel(motion=motions[1].name, side="right") < -0.01


def test_every_argument_of_a_case_reaches_the_motion():
    """Vertical motion, duration, start, mode and law, each changes the result as in simulate."""
    full = {
        "impact": rk.VelocityRatio(0.8),
        "initial": {"theta": 0.05, "theta_dot": 0.1},
        "duration": 3.0,
        "vertical": rk.GroundMotion.single_sine(4.0, period=0.5, duration=2.0),
        "mode": "right",
    }
    motion = rk.GroundMotion.single_sine(3.0, period=1.0, duration=4.0)
    kept = {"all": full} | {key: {k: v for k, v in full.items() if k != key} for key in full}
    result = rk.simulate_many(lambda left_out: rk.Case(BLOCK, motion, **kept[left_out]),
                              over={"left_out": list(kept)},
                              sweep_options=rk.SweepOptions(lanes=False))  # fmt: skip
    ends = []
    for name, arguments in kept.items():
        run = rk.simulate(BLOCK, motion, **arguments)
        found = result.sel(left_out=name)
        assert found.final.values.tolist() == [*run.final.values()]
        ends.append(tuple(found.final.values))
    assert len(set(ends)) == len(kept) - 1  # the mode follows from the state


@pytest.mark.parametrize("threads", [1, 2])
def test_interrupt_keeps_what_was_done(reference, threads):
    interrupted = one_by_one(interrupted_at(40, pulse))
    result = rk.simulate_many(
        interrupted,
        over=OVER,
        impact_times=20,
        sweep_options=rk.SweepOptions(threads=threads, chunk=4),
    )
    assert result.attrs["interrupted"] == 1
    ran = result.outcome != "not run"
    # all that was made in whole chunks, to the last bit, but for what the other thread runs just
    # then: that is stopped, and may have been made before the last chunk that was done
    chunks = ran.values.ravel()[:36].reshape(9, 4)
    assert not ran.values.ravel()[36:].any()
    assert np.all(chunks.all(axis=1) == chunks.any(axis=1))
    assert chunks.all(axis=1).sum() >= 9 - (threads - 1)
    for name in ("outcome", "final_time", "impacts", "maximum", "final", "impact_time"):
        done, whole = result[name].values[ran.values], reference[name].values[ran.values]
        np.testing.assert_array_equal(done, whole)
    # nothing is said of the others
    for name in ("final_time", "minimum", "maximum", "final", "impact_time"):
        assert np.isnan(result[name].values[~ran.values]).all()
    assert set(result.final_mode.values[~ran.values].tolist()) == {""}


@pytest.fixture
def interruptible():
    """The handler of Ctrl-C is set: what runs in the background ignores it."""
    handler = signal.signal(signal.SIGINT, signal.default_int_handler)
    yield
    signal.signal(signal.SIGINT, handler)


def test_interrupt_that_wakes_nobody(interruptible):
    """A signal that comes just before the caller waits, or on Windows any, does not end a wait."""
    calls = 0

    def case(theta_0):
        nonlocal calls
        calls += 1
        if calls == 1000:
            _thread.interrupt_main()
        return rk.Case(BLOCK, rk.GroundMotion.none(5.0), initial={"theta": float(theta_0)})

    over = {"theta_0": np.linspace(0.1, 0.2, 200_000)}
    result = rk.simulate_many(case, over=over, sweep_options=rk.SweepOptions(threads=2))
    assert result.attrs["interrupted"] == 1
    assert 0 < (result.outcome != "not run").sum() < 150_000


@pytest.mark.skipif(sys.platform == "win32", reason="no SIGINT to another process")
def test_interrupt_from_the_keyboard():
    """Ctrl-C at a twentieth of the way: the process goes on with what was done."""
    code = """
import signal
import rockeom as rk, numpy as np
signal.signal(signal.SIGINT, signal.default_int_handler)  # ignored by what runs in the background
block, still = rk.RigidBlock.from_frequency(p=2.14, alpha=0.25), rk.GroundMotion.none(50.0)
theta = np.linspace(0.1, 0.2, 100_000)
def case(theta_0):
    if theta_0 == theta[5000]:
        print("under way", flush=True)
    return rk.Case(block, still, initial={"theta": theta_0})
how = rk.SweepOptions(threads=2, progress=False)
result = rk.simulate_many(case, over={"theta_0": theta}, sweep_options=how)
ran = (result.outcome != "not run").values
print(result.attrs["interrupted"], ran.sum(), np.isfinite(result.final_time.values[ran]).all())
"""
    process = subprocess.Popen(
        [sys.executable, "-c", code], stdout=subprocess.PIPE, text=True, env=environment()
    )
    assert process.stdout.readline() == "under way\n"
    process.send_signal(signal.SIGINT)
    out, _ = process.communicate(timeout=60)
    assert process.returncode == 0
    interrupted, ran, finite = out.split()
    assert (interrupted, finite) == ("1", "True")
    # of 5000 cases made no more than a chunk for each thread, and two, can have been waiting
    assert 4000 <= int(ran) < 100_000


@pytest.fixture
def interrupted_soon(interruptible):
    """Ctrl-C in half a second."""
    timer = threading.Timer(0.5, _thread.interrupt_main)
    timer.start()
    yield
    timer.cancel()


FOREVER = {"options": rk.SolverOptions(max_impacts=10**9, max_steps=10**12)}


def for_days(theta):
    """Rocking without loss: some seconds of work each."""
    still = rk.GroundMotion.none(86_400.0 * 5)
    return rk.Case(BLOCK, still, rk.VelocityRatio(1.0), initial={"theta": theta})


@pytest.mark.parametrize("threads", [1, 2])
def test_interrupt_within_a_chunk_of_long_motions(interrupted_soon, threads):
    """Hours of work in one chunk: answered at once, and what was ended is told."""
    over = {"theta": [*np.linspace(0.2, 0.21, 256)]}
    short = 40

    def case(theta):
        if theta < over["theta"][short]:  # these end before the interrupt
            return rk.Case(BLOCK, rk.GroundMotion.none(2.0), initial={"theta": theta})
        return for_days(theta)

    started = time.monotonic()
    result = rk.simulate_many(
        case, over, sweep_options=rk.SweepOptions(threads=threads), impact_times=3, **FOREVER
    )
    assert time.monotonic() - started < 8.0
    assert result.attrs["interrupted"] == 1
    ran = (result.outcome != "not run").values
    assert ran[:short].all()
    assert not ran.all()
    assert np.isfinite(result.final_time.values[ran]).all()
    assert np.isnan(result.final_time.values[~ran]).all()
    assert np.isnan(result.impact_time.values[~ran]).all()


def test_interrupt_within_a_long_motion(interrupted_soon):
    case = for_days(0.2)
    started = time.monotonic()
    with pytest.raises(KeyboardInterrupt):
        rk.simulate(
            case.structure, case.motion, impact=case.impact, initial=case.initial, **FOREVER
        )
    assert time.monotonic() - started < 8.0


def test_a_motion_of_many_turns_is_that_of_one():
    """A call that returns in the middle of a motion changes no bit of it."""
    still = rk.GroundMotion.none(5_000.0)
    run = rk.simulate(BLOCK, still, impact=rk.VelocityRatio(1.0), initial={"theta": 0.2}, **FOREVER)
    assert run.statistics["steps"] > 40_000
    one_by_one, lanes = (
        rk.simulate_many(
            lambda theta: rk.Case(BLOCK, still, rk.VelocityRatio(1.0), initial={"theta": theta}),
            over={"theta": [0.2, 0.1, 0.2]},
            sweep_options=rk.SweepOptions(lanes=lanes),
            **FOREVER,
        )
        for lanes in (False, True)
    )
    for i in (0, 2):
        np.testing.assert_array_equal(one_by_one.final.values[i], run.end)
        assert one_by_one.impacts.values[i] == len(run.impacts)
    np.testing.assert_array_equal(lanes.final.values[0], lanes.final.values[2])
    assert lanes.impacts.values[0] == len(run.impacts)


def test_error_in_a_case_names_the_case():
    def broken(frequency, amplitude):
        if amplitude > 3 and frequency > 1:
            raise ValueError("the machine is out of sine")
        return pulse(frequency, amplitude)

    with pytest.raises(ValueError, match="out of sine") as caught:
        rk.simulate_many(broken, over=OVER)
    text = " ".join([str(caught.value), *getattr(caught.value, "__notes__", [])])
    assert text == "case frequency = 1.1, amplitude = 3.4: the machine is out of sine"


@pytest.mark.parametrize("threads", [1, 2, 3])
@pytest.mark.parametrize("where", ["making", "running"])
def test_an_error_ends_the_work_of_all_threads(threads, where):
    """It reaches the caller, no thread goes on with the other cases, and none is left behind."""
    made, inside = 0, threading.Lock()

    class Breaks:
        asked = 0

        def resolve(self, velocity_ratio, has_impulsive, name):
            self.asked += 1
            if self.asked == (1 if where == "making" else 2):
                raise ZeroDivisionError
            return 0, velocity_ratio

    def case(theta):
        nonlocal made
        assert inside.acquire(blocking=False)  # never two at a time
        made += 1
        inside.release()
        impact = Breaks() if made == 20 else None
        return rk.Case(BLOCK, rk.GroundMotion.none(1.0), impact, initial={"theta": theta})

    started = threading.active_count()
    with pytest.raises(ZeroDivisionError):
        rk.simulate_many(
            case,
            over={"theta": np.linspace(0.01, 0.02, 2000)},
            sweep_options=rk.SweepOptions(threads=threads, chunk=10),
            quantities=["theta"],
        )
    assert made < 1000
    assert threading.active_count() == started


def test_start_that_cannot_be_names_the_case():
    with pytest.raises(ValueError, match="lies on the ground") as caught:
        rk.simulate_many(
            lambda times: rk.Case(BLOCK, rk.GroundMotion.none(1.0), initial={"theta": 0.1 * times}),
            over={"times": [1, 23]},
        )
    text = " ".join([str(caught.value), *getattr(caught.value, "__notes__", [])])
    assert "times" in text
    assert "23" in text


def test_cases_of_two_models_are_refused():
    slender = rk.SlenderBlock.from_frequency(p=2.14, alpha=0.25)
    with pytest.raises(ValueError, match=r"slender_block.*rigid_block"):
        rk.simulate_many(
            lambda s: rk.Case(s, rk.GroundMotion.none(1.0)), over={"s": [BLOCK, slender]}
        )


# Fails: no cases at all are run in chunks of none, and what is refused does not name the argument.
@pytest.mark.parametrize("wrong", [{"chunk": 0}, {"chunk": -1}, {"threads": -1}])
def test_chunks_and_threads_that_cannot_be_are_refused(wrong):
    (name,) = wrong
    with pytest.raises(ValueError, match=name):
        many(**wrong)


@pytest.mark.parametrize("over", [{}, {"frequency": []}, {"frequency": [1.0], "amplitude": []}])
def test_nothing_to_run_is_refused(over):
    with pytest.raises(ValueError, match="over"):
        rk.simulate_many(pulse, over=over)


def test_progress_is_a_line_that_ends_with_the_total(capsys):
    many(progress=True)
    shown = capsys.readouterr()
    assert shown.out == ""
    assert shown.err.splitlines()[-1].split("\r")[-1].startswith("63 of 63 motions in ")
    many(progress=False)
    assert capsys.readouterr().err == ""
    many()  # stderr is no terminal here
    assert capsys.readouterr().err == ""


def test_more_threads_than_cores_and_cases():
    started = threading.active_count()
    few = rk.simulate_many(
        pulse,
        over={"frequency": [1.0], "amplitude": [1.5, 3.0]},
        sweep_options=rk.SweepOptions(threads=4 * os.cpu_count(), chunk=1),
    )
    assert (few.outcome != "not run").all()
    assert threading.active_count() == started  # none is left behind


@pytest.mark.parametrize("threads", [1, 2])
def test_memory_holds_results_and_not_cases(threads):
    """Cases are made when they are needed: what grows with their number is the dataset.

    A case with a record of its own takes seven times as much, and none may stay.
    """

    def case(theta):
        motion = rk.GroundMotion.from_array(np.full(20, theta), dt=0.01)
        return rk.Case(BLOCK, motion, initial={"theta": theta})

    def memory(n):
        tracemalloc.start()
        result = rk.simulate_many(
            case,
            over={"theta": np.linspace(0.01, 0.02, n)},
            sweep_options=rk.SweepOptions(chunk=32, threads=threads),
        )
        left, peak = tracemalloc.get_traced_memory()
        tracemalloc.stop()
        return np.array([result.nbytes, left, peak])

    memory(100)  # what is made once
    dataset, left, peak = (memory(1500) - memory(300)) / 1200
    assert left < 1.1 * dataset
    assert peak < 2 * dataset  # while the rows are put together


def test_histories_and_peaks_of_named_quantities():
    """They are those of the response of each case by itself."""
    times = np.array([0.0, 0.5, 1.0, 1000.0])
    asked = ["theta", "left_uplift"]
    result = many(quantities=asked, times=times)
    assert result.history.dims == (*OVER, "quantity", "time")
    for place in itertools.product(*(range(len(v)) for v in OVER.values())):
        named = {
            name: list(values)[i] for (name, values), i in zip(OVER.items(), place, strict=True)
        }
        case = pulse(**named)
        run = rk.simulate(case.structure, case.motion, impact=case.impact, initial=case.initial)
        row = result.isel(dict(zip(OVER, place, strict=True)))
        for name in asked:
            of = row.sel(quantity=name)
            assert float(of.maximum_quantity) == run.extremes(name).maximum
            assert float(of.minimum_quantity) == run.extremes(name).minimum
            assert float(of.peak_quantity) == abs(run.extremes(name).peak)
            within = times[times <= run.t[-1]]
            np.testing.assert_array_equal(
                of.history[: len(within)], run.at(within, names=asked)[name]
            )
            np.testing.assert_allclose(
                of.history[: len(within)], np.interp(within, run.t, run[name]), atol=1e-4
            )
            assert np.isnan(of.history[len(within) :]).all()


def test_states_at_impacts_are_those_of_the_response():
    """Of the first three of each; nan where there are fewer."""
    found = rk.simulate_many(
        pulse, over={"frequency": FREQUENCY[:2], "amplitude": AMPLITUDE[::4]},
        impact_times=3, impact_states=True,
    )  # fmt: skip
    assert found.impact_state.dims == (*OVER, "impact", "side", "state")
    for f, a in itertools.product(found.frequency.values, found.amplitude.values):
        case = pulse(f, a)
        impacts = rk.simulate(BLOCK, case.motion, impact=case.impact).impacts[:3]
        here = found.impact_state.sel(frequency=f, amplitude=a)
        assert np.isfinite(here).sum() == 4 * len(impacts)
        for impact, states in zip(impacts, here, strict=False):
            assert states.sel(side="before").values.tolist() == [*impact.before.values()]
            assert states.sel(side="after").values.tolist() == [*impact.after.values()]
    with pytest.raises(ValueError, match="impact_states needs impact_times"):
        rk.simulate_many(pulse, over=OVER, impact_states=True)


def test_peak_is_the_size_of_the_motion_to_either_side(reference):
    """What falls to the left has passed pi/2 there, and no signed extreme hides it."""
    lies = np.isclose(reference.peak.sel(state="theta"), np.pi / 2, rtol=1e-9)
    fell = reference.outcome.values == "overturned"
    assert fell[lies].all()
    to_the_left = np.isclose(reference.minimum.sel(state="theta"), -np.pi / 2)
    assert to_the_left.any()
    assert lies[to_the_left].all()
    both = np.maximum(reference.maximum, -reference.minimum)
    np.testing.assert_array_equal(reference.peak, both)


# Fails: the extremes of rates are those of the ends of steps.
def test_extremes_of_all_states_are_those_within_the_steps():
    """The loop's own bounds against a search of the recorded steps; rates too."""
    found = many(quantities=["theta", "theta_dot"], lanes=False)
    in_lanes = many()
    for name in ("peak", "maximum", "minimum"):
        searched = found[f"{name}_quantity"]
        np.testing.assert_allclose(found[name], searched.values, rtol=1e-11, atol=1e-13)
        np.testing.assert_allclose(in_lanes[name], searched.values, rtol=1e-8, atol=1e-10)


@pytest.mark.parametrize(
    ("wrong", "word"),
    [({"quantities": "theta"}, "list"), ({"times": [1.0]}, "quantities"),
     ({"quantities": ["theta"], "times": [-1.0]}, "-1.0")],
)  # fmt: skip
def test_quantities_that_cannot_be_are_refused(wrong, word):
    with pytest.raises(ValueError, match=word):
        many(**wrong)


@pytest.mark.parametrize(("across", "up"), [(2.0, 0.0), (0.0, 2.0), (2.0, 2.0), (0.0, 0.0)])
@pytest.mark.parametrize("steps", [0, 2])
def test_a_sweep_sees_each_jump_where_laws_of_both_grounds_end_at_once(across, up, steps):
    """The last sample of each record; behind it the ground stands still."""
    block = rk.RigidBlock(half_width=0.3, half_height=1.0)
    horizontal, vertical = (
        rk.GroundMotion.from_array([0.0, 1.0, last, last], 0.1) for last in (across, up)
    )
    options = rk.SolverOptions("DOP853", steps_per_segment=steps)
    case = rk.Case(block, horizontal, initial={"theta": 0.2}, duration=0.5, vertical=vertical)
    run = rk.simulate(
        block, horizontal, vertical=vertical, initial=case.initial, duration=0.5, options=options
    )
    together = rk.simulate_many(
        lambda n: case,
        {"n": [0]},
        options=options,
        sweep_options=rk.SweepOptions(lanes=False, progress=False),
    )
    assert together.final.values[0].tolist() == run.end.tolist()


LIMITED = {
    "rigid block": (rk.RigidBlock(half_width=0.2, half_height=0.8), "DOP853"),
    "flexible column": (
        rk.FlexibleStructure(
            mass=1e3, height=2.0, inertia=0.0, base_mass=500.0, base_height=0.0,
            base_inertia=100.0, half_width=0.5, stiffness=4e5, damping=1e3,
        ),
        "RK45",
    ),
}  # fmt: skip


@pytest.mark.parametrize("name", LIMITED)
@pytest.mark.parametrize("most", [2, 7, 30])
def test_a_limit_of_steps_ends_a_motion_at_the_same_time_however_it_is_run(name, most):
    structure, method = LIMITED[name]
    motion = rk.GroundMotion.single_sine(4.0, 1.0, duration=6.0)
    options, start = rk.SolverOptions(method, max_steps=most), {"theta": 0.1}
    run = rk.simulate(structure, motion, initial=start, options=options)
    for lanes in (False, True):
        sweep = rk.simulate_many(
            lambda n: rk.Case(structure, motion, initial=start), {"n": [0, 1, 2]},
            options=options, sweep_options=rk.SweepOptions(lanes=lanes, progress=False),
        )  # fmt: skip
        assert set(sweep.outcome.values) == {str(run.outcome)}
        if run.outcome is rk.Outcome.STALLED:
            np.testing.assert_array_equal(sweep.final_time, run.t[-1])
            np.testing.assert_array_equal(sweep.final, [run.end] * 3)


@pytest.mark.parametrize("limit", ["max_steps", "max_impacts"])
@pytest.mark.parametrize("most", [2**31, sys.maxsize])
def test_a_limit_that_no_motion_reaches_is_none(limit, most):
    block, motion = LIMITED["rigid block"][0], rk.GroundMotion.none(2.0)
    runs = [
        rk.simulate(block, motion, initial={"theta": 0.1}, options=options)
        for options in (rk.SolverOptions(), rk.SolverOptions(**{limit: most}))
    ]
    assert runs[0].outcome is runs[1].outcome
    assert runs[0].end.tolist() == runs[1].end.tolist()
