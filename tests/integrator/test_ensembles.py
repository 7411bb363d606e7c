"""simulate_many: labels, the same bits however the work is cut, interrupts, errors by name."""

import os
import threading
import tracemalloc

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st

import rockeom as rk

BLOCK = rk.RigidBlock.from_frequency(p=2.14, alpha=0.25)
THRESHOLD = BLOCK.gravity * np.tan(0.25)
FREQUENCY, AMPLITUDE = np.linspace(0.4, 2.5, 7), np.linspace(0.8, 6.0, 9)
OVER = {"frequency": FREQUENCY, "amplitude": AMPLITUDE}


def pulse(frequency, amplitude):
    motion = rk.GroundMotion.single_sine(amplitude * THRESHOLD, 1 / frequency, duration=8.0)
    return rk.Case(BLOCK, motion, impact=rk.VelocityRatio(0.9))


def many(**changes):
    return rk.simulate_many(pulse, over=OVER, impact_times=20, **changes)


@pytest.fixture(scope="module")
def reference():
    return many(threads=1)


def test_same_as_simulate(reference):
    """Case by case: outcome, impacts and their times to the last bit, peaks, the end."""
    assert {"came to rest", "overturned"} <= set(reference.outcome.values.ravel().tolist())
    for f in FREQUENCY[::2]:
        for a in AMPLITUDE[::2]:
            case = pulse(f, a)
            run = rk.simulate(
                BLOCK, case.motion, impact=case.impact, options=rk.SolverOptions(output_step=1e-3)
            )
            found = reference.sel(frequency=f, amplitude=a)
            assert found.outcome.item() == run.outcome.label
            assert found.final_phase.item() == run.phase[-1]
            assert found.impacts.item() == len(run.impacts)
            assert found.final_time.item() == pytest.approx(run.t[-1], rel=1e-14)
            times = [impact.time for impact in run.impacts[:20]]
            np.testing.assert_array_equal(found.impact_time.values[: len(times)], times)
            assert np.isnan(found.impact_time.values[len(times) :]).all()
            assert found.final.values.tolist() == [*run.final.values()]
            # samples a millisecond apart pass beside the turning points
            rotation = found.sel(state="theta")
            assert 0 <= rotation.largest.item() - run["theta"].max() < 1e-6
            assert 0 <= run["theta"].min() - rotation.smallest.item() < 1e-6


@settings(max_examples=20, deadline=None)
@given(threads=st.integers(1, 5), chunk=st.integers(1, 100))
def test_threads_and_chunks_change_no_bit(threads, chunk):
    one = many(threads=1, chunk=63)
    other = many(threads=threads, chunk=chunk)
    assert one.identical(other)


def test_order_of_the_cases_changes_no_bit(reference):
    """What one case leaves behind in its thread must not reach the next."""
    backwards = rk.simulate_many(pulse, over={k: v[::-1] for k, v in OVER.items()}, impact_times=20)
    again = backwards.isel(frequency=slice(None, None, -1), amplitude=slice(None, None, -1))
    assert reference.identical(again)


def test_labels_and_what_is_kept(reference):
    assert dict(reference.sizes) == {"frequency": 7, "amplitude": 9, "state": 2, "impact": 20}
    np.testing.assert_array_equal(reference.frequency, FREQUENCY)
    assert reference.state.values.tolist() == ["theta", "theta_dot"]
    assert reference.final_time.attrs["units"] == "s"
    assert reference.attrs == {"model": "rigid_block", "method": "DOP853", "interrupted": 0}
    # below the threshold nothing moves
    still = reference.sel(amplitude=0.8)
    assert set(still.outcome.values.tolist()) == {"came to rest"}
    assert not still.largest.any()
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
    """Words label themselves; structures and motions are numbered in their order."""
    motions = [rk.GroundMotion.none(1.0), rk.GroundMotion.constant(2 * THRESHOLD, 1.0)]
    phases = ["right", "left"]
    result = rk.simulate_many(
        lambda motion, side: rk.Case(
            BLOCK, motion, initial={"theta": 0.1 if side == "right" else -0.1}
        ),
        over={"motion": motions, "side": phases},
    )
    assert result.motion.values.tolist() == [0, 1]
    assert result.side.values.tolist() == phases
    theta = result.smallest.sel(state="theta")
    assert theta.sel(motion=0, side="left") == -0.1
    assert theta.sel(motion=1, side="right") < -0.01


def test_every_argument_of_a_case_reaches_the_motion():
    """Vertical motion, duration, start, phase and law, each changes the result as in simulate."""
    full = {
        "impact": rk.VelocityRatio(0.8),
        "initial": {"theta": 0.05, "theta_dot": 0.1},
        "duration": 3.0,
        "vertical": rk.GroundMotion.single_sine(4.0, period=0.5, duration=2.0),
        "phase": "right",
    }
    motion = rk.GroundMotion.single_sine(3.0, period=1.0, duration=4.0)
    kept = {"all": full} | {key: {k: v for k, v in full.items() if k != key} for key in full}
    result = rk.simulate_many(lambda left_out: rk.Case(BLOCK, motion, **kept[left_out]),
                              over={"left_out": list(kept)})  # fmt: skip
    ends = []
    for name, arguments in kept.items():
        run = rk.simulate(BLOCK, motion, **arguments)
        found = result.sel(left_out=name)
        assert found.final.values.tolist() == [*run.final.values()]
        ends.append(tuple(found.final.values))
    assert len(set(ends)) == len(kept) - 1  # the phase follows from the state


@pytest.mark.parametrize("threads", [1, 2])
def test_interrupt_keeps_what_was_done(reference, threads):
    calls = 0

    def interrupted(frequency, amplitude):
        nonlocal calls
        calls += 1
        if calls == 40:
            raise KeyboardInterrupt
        return pulse(frequency, amplitude)

    result = rk.simulate_many(interrupted, over=OVER, impact_times=20, threads=threads, chunk=4)
    assert result.attrs["interrupted"] == 1
    ran = result.outcome != "not run"
    n = int(ran.sum())
    assert 0 < n <= 39
    # all that was made in whole chunks, from the first on, and to the last bit
    assert ran.values.ravel()[:n].all()
    assert n >= 36
    for name in ("outcome", "final_time", "impacts", "largest", "final", "impact_time"):
        done, whole = result[name].values[ran.values], reference[name].values[ran.values]
        np.testing.assert_array_equal(done, whole)
    # nothing is said of the others
    for name in ("final_time", "smallest", "largest", "final", "impact_time"):
        assert np.isnan(result[name].values[~ran.values]).all()
    assert set(result.final_phase.values[~ran.values].tolist()) == {""}


def test_error_in_a_case_names_the_case():
    def broken(frequency, amplitude):
        if amplitude > 3 and frequency > 1:
            raise ValueError("the machine is out of sine")
        return pulse(frequency, amplitude)

    with pytest.raises(ValueError, match="out of sine") as caught:
        rk.simulate_many(broken, over=OVER)
    text = " ".join([str(caught.value), *getattr(caught.value, "__notes__", [])])
    assert "frequency" in text
    assert "amplitude" in text
    assert str(AMPLITUDE[AMPLITUDE > 3][0])[:5] in text


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
        threads=4 * os.cpu_count(),
        chunk=1,
    )
    assert (few.outcome != "not run").all()
    assert threading.active_count() == started  # none is left behind


def test_memory_holds_results_and_not_cases():
    """Cases are made when they are needed: of each, some hundred bytes of results remain."""
    still = rk.GroundMotion.none(10.0)

    def peak(n):
        tracemalloc.start()
        rk.simulate_many(
            lambda theta: rk.Case(BLOCK, still, initial={"theta": theta}),
            over={"theta": np.linspace(0.01, 0.02, n)},
            chunk=64,
            threads=1,
        )
        found = tracemalloc.get_traced_memory()[1]
        tracemalloc.stop()
        return found

    peak(100)  # what is made once
    assert peak(4000) - peak(1000) < 600 * 3000
