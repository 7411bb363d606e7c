"""Sweeps on disk and on executors: killed, resumed, refused, and the bits of one that never was."""

import asyncio
import itertools
import json
import os
import signal
import subprocess
import sys
import threading
import time
from concurrent.futures import (
    BrokenExecutor,
    Future,
    ProcessPoolExecutor,
    ThreadPoolExecutor,
)
from multiprocessing import get_context, parent_process
from pathlib import Path
from pickle import PicklingError

import numpy as np
import pytest

import rockeom as rk
from rockeom.numbers.checks import described
from rockeom.sweeps import workers as ensemble_work
from tests.interrupts import interrupted_at
from tests.sweeping import one_by_one, simulate_many

pytest.importorskip("zarr")

BLOCK = rk.RigidBlock.from_frequency(p=2.14, alpha=0.25)
OVER = {"frequency": np.linspace(0.5, 4.0, 20), "amplitude": np.linspace(1.0, 8.0, 25)}
HOW = {"impact_times": 3, "chunk": 50, "progress": False}


def pulse(frequency, amplitude):
    return rk.Case(BLOCK, rk.GroundMotion.half_sine(amplitude, 1 / frequency, duration=4.0))


def waiting(store):
    """The function, which waits for ever once a store has three chunks."""

    def until_killed(frequency, amplitude):
        if len(done(Path(store))) >= 3:
            threading.Event().wait()
        return pulse(float(frequency), float(amplitude))

    return until_killed


def swept(case=pulse, over=OVER, **how):
    return simulate_many(case, over, **HOW | how)


@pytest.fixture(scope="module")
def whole():
    return swept()


@pytest.fixture
def store(tmp_path):
    return tmp_path / "map.zarr"


def done(store):
    """Chunks that are there."""
    names = [path.name for path in (store / "outcome" / "c").glob("[0-9]*")]
    return sorted(int(name) for name in names if name.isdigit())


def same_bits(one, other):
    assert one.identical(other)
    for name in one.variables:
        assert one[name].values.tobytes() == other[name].values.tobytes()


def counted(case=pulse):
    """The function, and how often it was called."""
    calls = []

    def counting(frequency, amplitude):
        calls.append((frequency, amplitude))
        return case(frequency, amplitude)

    return one_by_one(counting), calls


# -- on disk


@pytest.mark.parametrize("threads", [1, 2])
def test_the_same_call_does_only_what_is_missing(whole, store, threads):
    how = {"threads": threads, "store": store}
    same_bits(whole, swept(**how))
    assert done(store) == [*range(10)]
    for chunk in (3, 4, 9):
        (store / "outcome" / "c" / str(chunk)).unlink()
    others = {path: path.stat().st_mtime_ns for path in (store / "outcome" / "c").iterdir()}
    counting, calls = counted()
    same_bits(whole, swept(counting, **how))
    assert {path: path.stat().st_mtime_ns for path in others} == others
    sample = 1 + 16
    assert len(calls) == sample + 3 * 50
    # all is there: what is left to do is to make sure of the definition
    calls.clear()
    same_bits(whole, swept(counting, **how))
    assert len(calls) == sample


def test_a_sweep_that_is_killed_loses_only_the_chunks_under_way(whole, store):
    """By kill -9; while it is under way, no other process may write to the store."""
    code = (
        "from tests.sweeps.test_kept_sweeps import swept, waiting\n"
        f"swept(waiting({str(store)!r}), threads=2, store={str(store)!r})"
    )
    root = Path(rk.__file__).resolve().parents[1]
    process = subprocess.Popen(
        [sys.executable, "-c", code], cwd=root, env={**os.environ, "PYTHONPATH": str(root)}
    )
    while not store.exists() or len(done(store)) < 3:
        assert process.poll() is None
        time.sleep(0.01)
    with pytest.raises(RuntimeError, match="being written by another"):
        swept(store=store)
    process.kill()
    process.wait()
    there = len(done(store))
    assert 3 <= there < 10
    counting, calls = counted()
    same_bits(whole, swept(counting, store=store))
    assert len(calls) == 17 + 50 * (10 - there)


def test_an_interrupt_keeps_whole_chunks(whole, store):
    interrupted = one_by_one(interrupted_at(17 + 120, pulse))
    found = swept(interrupted, store=store, threads=1)
    assert found.attrs["interrupted"] == 1
    assert int((found.outcome_flag == 0).sum()) == 500 - 100
    assert done(store) == [0, 1]
    same_bits(found, rk.open_sweep(store))
    with pytest.raises(ValueError, match="no store of a sweep"):
        rk.open_sweep(store.parent)
    same_bits(whole, swept(store=store))


def test_a_store_is_for_one_sweep_at_a_time_in_a_process_too(store):
    """Begun within a function of another one."""

    over = {"frequency": [1.0], "amplitude": [2.0]}
    refused = []

    def nested(frequency, amplitude):
        if store.exists():
            with pytest.raises(RuntimeError, match="being written by another"):
                swept(over=over, store=store)
            refused.append(1)
        return pulse(frequency, amplitude)

    swept(nested, over, store=store)
    assert refused
    swept(over=over, store=store)  # and is let go


OTHERS = {
    "value": ({"over": OVER | {"amplitude": np.linspace(1.0, 8.0 + 1e-15, 25)}}, "amplitude"),
    "order": ({"over": OVER | {"amplitude": OVER["amplitude"][::-1]}}, "amplitude"),
    "kind of value": ({"over": OVER | {"amplitude": range(1, 26)}}, "amplitude"),
    "shape": ({"over": OVER | {"amplitude": OVER["amplitude"][:-1]}}, "20 x 25 there, .*20 x 24"),
    "names": (
        {"case": lambda frequency, a: pulse(frequency, a),
         "over": {"frequency": OVER["frequency"], "a": OVER["amplitude"]}}, "frequency, a here",
    ),
    "table": ({"over": [{"frequency": 1.0, "amplitude": 2.0}] * 500}, "a table of 500"),
    "tolerance": ({"options": rk.SolverOptions(rtol=1e-8)}, "rtol .1e-10 there, 1e-08 here"),
    "method": ({"options": rk.SolverOptions("RK45")}, "'DOP853' there, 'RK45' here"),
    "impact times": ({"impact_times": 4}, "impact_times .3 there, 4 here"),
    "quantities": ({"quantities": ["displacement"]}, "quantities"),
    "lanes": ({"lanes": False}, "lanes"),
    "structure": (
        {"case": lambda frequency, amplitude: rk.Case(
            rk.SlenderBlock.from_frequency(p=2.14, alpha=0.25), pulse(frequency, amplitude).motion
        )}, "slender_block here",
    ),
    "size of the structure": (
        {"case": lambda frequency, amplitude: rk.Case(
            rk.RigidBlock.from_frequency(p=2.15, alpha=0.25), pulse(frequency, amplitude).motion
        )}, "what the function makes",
    ),
    "duration": (
        {"case": lambda frequency, amplitude: rk.Case(
            BLOCK, pulse(frequency, amplitude).motion, duration=3.0
        )}, "what the function makes",
    ),
    "law": (
        {"case": lambda frequency, amplitude: rk.Case(
            BLOCK, pulse(frequency, amplitude).motion, rk.EnergyRatio(0.9)
        )}, "what the function makes",
    ),
}  # fmt: skip


@pytest.fixture(scope="module")
def begun(tmp_path_factory):
    """A store of which two chunks are there."""
    store = tmp_path_factory.mktemp("begun") / "map.zarr"
    interrupted = one_by_one(interrupted_at(17 + 120, pulse))
    swept(interrupted, store=store, threads=1)
    return store


@pytest.mark.parametrize("what", OTHERS)
def test_another_sweep_under_the_same_name_is_refused(begun, what):
    changes, words = OTHERS[what]
    with pytest.raises(ValueError, match=f"holds another sweep.*{words}.*another store"):
        swept(**{"store": begun} | changes)
    assert done(begun) == [0, 1]


def test_another_record_of_the_same_name_is_refused(store):
    """Of each object among the values one case is looked at, wherever it stands."""

    def shaken(factor, motion):
        return rk.Case(BLOCK, motion.scaled(factor))

    def records(last):
        waves = [np.sin(0.3 * np.arange(60.0) + n) for n in range(9)]
        waves[7] = waves[7] * last
        return [rk.GroundMotion.from_array(wave, dt=0.02, name=f"{n}") for n, wave in
                enumerate(waves)]  # fmt: skip

    over = {"factor": np.linspace(1.0, 9.0, 40), "motion": records(1.0)}
    first = swept(shaken, over, store=store)
    assert first.motion.values.tolist() == [*"012345678"]
    over["motion"] = records(1.0 + 1e-12)
    with pytest.raises(ValueError, match="what the function makes"):
        swept(shaken, over, store=store)


def test_a_chunk_that_was_not_written_whole_is_made_again_or_told(whole, store):
    swept(store=store)
    (store / "outcome" / "c" / "7").unlink()
    (store / "final" / "c" / "7" / "0").write_bytes(b"half")  # as a machine without power leaves it
    with pytest.raises(RuntimeError, match=r"decompress|decoding") as caught:
        swept(store=store)
    assert "final" in caught.value.__notes__[0]
    (store / "final" / "c" / "7" / "0").unlink()
    same_bits(whole, swept(store=store))


def test_a_chunk_is_pending_until_all_of_it_is_written(whole, store):
    """A disk that takes all but one of its arrays."""
    in_the_way = store / "final" / "c"

    def blocking(frequency, amplitude):
        if store.exists() and not in_the_way.exists():
            in_the_way.write_text("no folder")
        return pulse(frequency, amplitude)

    with pytest.raises(OSError, match="final"):
        swept(blocking, store=store, threads=1)
    assert (store / "peaks" / "c").exists()
    assert done(store) == []
    in_the_way.unlink()
    same_bits(whole, swept(store=store))


def test_other_equations_or_another_loop_are_refused(begun, monkeypatch):
    """Here, and where a worker has them."""
    with ThreadPoolExecutor(1) as pool:
        monkeypatch.setattr("rockeom.sweeps.workers.revision", lambda *_: "another")
        with pytest.raises(RuntimeError, match=r"another rigid_block.*install the same"):
            swept(executor=pool)
    monkeypatch.setattr("rockeom.sweeps.run.revision", lambda *_: "another")
    with pytest.raises(ValueError, match=r"equations and loop .* there, another here"):
        swept(store=begun)


def test_what_is_no_store_is_left_alone(tmp_path, monkeypatch):
    mine = tmp_path / "mine"
    mine.mkdir()
    (mine / "thesis.tex").write_text("all of it")
    with pytest.raises(ValueError, match="no store of a sweep"):
        swept(store=mine)
    assert [path.name for path in mine.iterdir()] == ["thesis.tex"]
    with pytest.raises(TypeError, match=r"store is 3.*map\.zarr"):
        swept(store=3)
    monkeypatch.setitem(sys.modules, "zarr", None)
    with pytest.raises(ModuleNotFoundError, match=r"pip install -e \"\.\[store\]\""):
        swept(store=tmp_path / "map.zarr")


def test_store_whose_arrays_have_another_size_is_refused_before_they_are_read(store):
    swept(store=store)
    path = store / "final" / "zarr.json"
    about = json.loads(path.read_text())
    about["shape"][0] = 10**9  # 16 GB
    path.write_text(json.dumps(about))
    with pytest.raises(ValueError, match=r"final' has the shape \(1000000000, 2\)"):
        swept(store=store)


@pytest.mark.parametrize("call", [lambda store: swept(store=store), rk.open_sweep])
def test_store_of_another_format_is_refused(store, call):
    swept(store=store)
    path = store / "zarr.json"
    about = json.loads(path.read_text())
    about["attributes"]["rockeom_sweep"]["format"] = "2"
    path.write_text(json.dumps(about))
    with pytest.raises(ValueError, match=r"a sweep in format 2, .*another version.* sweep again"):
        call(store)


def test_two_that_make_a_store_at_once_make_one(store):
    """Neither sees half of it; who comes second is refused or finds all done."""
    found, refused = [], []

    def work():
        try:
            found.append(swept(store=store))
        except RuntimeError as error:
            refused.append(error)

    threads = [threading.Thread(target=work) for _ in range(3)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert len(found) >= 1
    assert len(found) + len(refused) == 3
    assert [path.name for path in store.parent.iterdir()] == [store.name]
    for other in found[1:]:
        same_bits(found[0], other)


def test_quantities_and_histories_are_kept_on_disk(store):
    over = {"frequency": [1.0, 2.0], "amplitude": [2.0, 4.0, 6.0]}
    asked = {"quantities": ["displacement"], "times": [0.1, 0.5, 9.0], "chunk": 2}
    first = swept(over=over, **asked)
    same_bits(first, swept(over=over, store=store, **asked))
    same_bits(first, swept(over=over, store=store, **asked))


FORCED = {"quantities": ["displacement"], "times": [0.1, 0.5], "impact_states": True, "chunk": 2}
PULSES = [pulse(1.0, a).motion for a in (2.0, 4.0)]


@pytest.mark.parametrize(
    "over",
    [
        {"motion": PULSES, "scale": np.float32([1.0, 2.0, 3.0])},
        [{"motion": PULSES[i % 2], "scale": float(i)} for i in range(1, 5)],
    ],
    ids=["grid", "table"],
)
def test_store_is_opened_as_the_dataset_of_the_sweep_without_its_function(store, over):
    found = swept(rk.Case(BLOCK, PULSES[0]), over, store=store, **FORCED)
    same_bits(found, rk.open_sweep(store))
    assert [*found.coords] == [*rk.open_sweep(store).coords]


def test_flipped_bit_anywhere_in_a_chunk_is_an_error_and_no_result(store):
    over = {"frequency": [1.0, 2.0], "amplitude": [2.0, 4.0, 6.0]}
    swept(over=over, store=store, **FORCED)
    files = [path for path in store.rglob("c/**/*") if path.is_file()]
    assert store / "labels" / "frequency" / "c" / "0" in files
    rng = np.random.default_rng(1)
    for path in files:
        whole = path.read_bytes()
        spoilt = bytearray(whole)
        spoilt[rng.integers(len(whole))] ^= 1 << rng.integers(8)
        path.write_bytes(spoilt)
        with pytest.raises((RuntimeError, ValueError)):
            rk.open_sweep(store)
        if path.is_relative_to(store / "labels"):
            path.unlink()
            with pytest.raises(ValueError, match="lacks a file"):
                rk.open_sweep(store)
        path.write_bytes(whole)
    rk.open_sweep(store)


# -- executors


FAILURES = {
    "breaks": (BrokenExecutor, "a worker has died"),
    "cancels": (),
    "cancels as asyncio does": (asyncio.CancelledError,),
    "raises oddly": (ValueError, "too many values to unpack (expected 3)"),
    "refuses": (RuntimeError, "cannot schedule new futures"),
    "answers nothing": (),
}


class Failing(ThreadPoolExecutor):
    """Does not run what it is given, the first so many times, each time in the next way."""

    def __init__(self, losses, *ways):
        super().__init__(2)
        self.losses, self.given, self.ways = losses, 0, itertools.cycle(ways)

    def submit(self, function, *args, **named):
        self.given += 1
        if self.given > self.losses:
            return super().submit(function, *args, **named)
        way, future = next(self.ways), Future()
        if way == "cancels":
            future.cancel()
            future.set_running_or_notify_cancel()
            return future
        if way == "answers nothing":
            future.set_result(None)
            return future
        kind, *text = FAILURES[way]
        if way == "refuses":
            raise kind(*text)
        future.set_exception(kind(*text))
        return future


@pytest.mark.parametrize("case", [pulse, one_by_one(pulse)], ids=["at once", "one by one"])
def test_an_executor_gives_the_same_bits(whole, store, case):
    with ThreadPoolExecutor(2) as pool:
        same_bits(whole, swept(case, executor=pool))
        same_bits(whole, swept(case, executor=pool, store=store))
    assert done(store) == [*range(10)]
    same_bits(whole, swept(store=store))


def test_chunks_that_an_executor_does_not_run_are_submitted_again(whole, store):
    with Failing(13, *FAILURES) as pool:
        same_bits(whole, swept(executor=pool, store=store))
        assert pool.given == 10 + 13


@pytest.mark.parametrize("way", FAILURES)
def test_executor_that_never_runs_anything_is_named_as_what_failed(store, way):
    tries = 1 + ensemble_work.AGAIN
    with Failing(10**9, way) as pool:
        with pytest.raises((Exception, asyncio.CancelledError)) as caught:
            swept(executor=pool, store=store)
        assert pool.given == 10 * tries
    (note,) = caught.value.__notes__
    assert f"raised by {described(pool)} itself, and by no case, in each of {tries} tries" in note
    assert "cases 0 to 49, cases 50 to 99" in note
    assert "only what is missing" in note


def test_a_case_that_cannot_be_is_told_as_ever():
    with ThreadPoolExecutor(2) as pool, pytest.raises(ValueError, match="positive") as caught:
        swept(over=OVER | {"frequency": [1.0, 2.0, -1.0]}, executor=pool)
    notes = " ".join(caught.value.__notes__)
    assert "case frequency = -1, amplitude = 1: " in str(caught.value)
    assert "of the sweep, run by" in notes


class OfTwoWordsError(Exception):
    """Cannot be unpickled from the arguments it keeps."""

    def __init__(self, one, other):
        super().__init__(f"{one} and {other}")


def raising(frequency, amplitude):
    if frequency > 2.0:
        raise OfTwoWordsError("this", "that")
    return pulse(frequency, amplitude)


def test_exception_of_a_function_comes_from_another_process_with_its_trace():
    with (
        ProcessPoolExecutor(1, mp_context=get_context("spawn")) as pool,
        pytest.raises(RuntimeError, match=r"OfTwoWordsError: .*this and that") as caught,
    ):
        swept(raising, executor=pool)
    *_, trace, where = caught.value.__notes__
    assert "of the sweep, run by" in where
    assert "in raising" in trace


def test_a_function_that_cannot_be_sent_is_told():
    with (
        ProcessPoolExecutor(1, mp_context=get_context("spawn")) as pool,
        pytest.raises((PicklingError, AttributeError)) as caught,
    ):
        swept(lambda frequency, amplitude: pulse(frequency, amplitude), executor=pool)
    assert "top level of a module" in caught.value.__notes__[-1]


def test_an_interrupt_while_an_executor_works(store):
    """What has come is returned and kept, and nothing more is begun."""

    class Interrupted(ThreadPoolExecutor):
        given = 0

        def submit(self, function, *args, **named):
            self.given += 1
            future = super().submit(function, *args, **named)
            if self.given == 3:
                future.result = interrupt
            return future

    def interrupt():
        raise KeyboardInterrupt

    with Interrupted(1) as pool:
        found = swept(executor=pool, store=store)
    assert found.attrs["interrupted"] == 1
    assert done(store) == [0, 1]
    assert int((found.outcome != "not run").sum()) == 100


def test_an_executor_is_what_takes_work():
    with pytest.raises(TypeError, match=r"executor is 'dask'.*submit"):
        swept(executor="dask")


def once_killed(frequency, amplitude):
    """A case on which a worker dies, while a file is there."""
    fatal = Path(os.environ["ROCKEOM_TEST_FATAL"])
    if frequency > 2.0 and parent_process() is not None and fatal.exists():
        os.kill(os.getpid(), signal.SIGKILL)
    return pulse(frequency, amplitude)


@pytest.mark.skipif(sys.platform == "win32", reason="no SIGKILL")
def test_processes_of_which_one_is_killed(whole, store, tmp_path, monkeypatch):
    """A pool of processes breaks: what was lost is told, the rest is kept, and the call resumes."""
    fatal = tmp_path / "fatal"
    fatal.touch()
    monkeypatch.setenv("ROCKEOM_TEST_FATAL", str(fatal))
    with (
        ProcessPoolExecutor(1, mp_context=get_context("spawn")) as pool,
        pytest.raises(BrokenExecutor) as caught,
    ):
        swept(once_killed, executor=pool, store=store)
    assert "itself, and by no case" in caught.value.__notes__[-1]
    assert 0 < len(done(store)) < 10
    fatal.unlink()
    same_bits(whole, swept(once_killed, store=store))
