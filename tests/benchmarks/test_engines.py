"""Other programs on the reference cases, as far as it can be tested without them."""

import copy
import json
import math
from pathlib import Path

import numpy as np
import pytest

import rockeom as rk
from benchmarks.engines import __main__ as main, case, cases, tables, trace, with_mujoco

PAGE = Path(__file__).resolve().parents[2] / "docs" / "reference-cases.md"
STORED = json.loads(main.STORED.read_text(encoding="utf-8"))


# -- what is measured of a motion ----------------------------------------------------------------


def of_rockeom(one, step):
    """A runner: the block of a case by rockeom, in samples."""
    p = {name: value["value"] for name, value in one["parameters"].items()}
    block = rk.RigidBlock(half_width=p["half_width"], half_height=p["half_height"])
    duration, initial, motion = one["duration"], None, rk.GroundMotion.none(one["duration"])
    if "rotation" in p:
        initial = {"theta": p["rotation"]}
    elif "jerk" in p:
        motion = rk.GroundMotion.from_array([0.0, p["jerk"] * 2.0], dt=2.0)
    else:
        motion = rk.GroundMotion.single_sine(p["amplitude"], p["period"], duration=duration)
    run = rk.simulate(block, motion, initial=initial, duration=duration)
    t = np.arange(0.0, min(duration, run.t[-1]), step)
    states = run.at(t)
    rows = np.zeros((len(t), 6))
    rows[:, trace.ROTATION], rows[:, trace.RATE] = states["theta"], states["theta_dot"]
    return trace.Trace(t, {"block": rows})


@pytest.mark.parametrize(
    ("name", "bound"),
    [
        ("free-decay", 3e-5),
        ("tipped-past-balance", 3e-4),
        ("threshold-uplift", 1e-6),
        ("pulse-overturns", 3e-5),
        ("pulse-safe-window", 3e-5),
    ],
)
def test_measures_of_a_right_motion_are_the_answers(name, bound):
    one = case(name)
    values = trace.numbers(of_rockeom, one, 1e-3)
    found = tables.errors(one, {"values": values})
    assert max(found.values()) < bound, found


def test_ball_that_bounces_lands_when_it_is_pushed_up():
    t = np.arange(0.0, 1.0, 1e-3)
    rows = np.zeros((len(t), 6))
    z, v = 0.5, 0.0
    for i in range(len(t)):
        rows[i, trace.Z], rows[i, trace.Z_RATE] = z, v
        v -= 9.81e-3
        z += 1e-3 * v
        if z < 0.0:
            z, v = 0.0, -0.7 * v
    motion = trace.Trace(t, {"block": rows})
    fall = math.sqrt(2 * 0.5 / 9.81)
    for n, expected in ((1, fall), (2, fall * 2.4)):
        measure = {"what": "landing", "body": "block", "n": n}
        assert trace.measured(motion, measure) == pytest.approx(expected, abs=3e-3)
    assert trace.measured(motion, {"what": "landing", "body": "block", "n": 9}) is None


def test_threshold_of_a_pulse_is_bisected():
    """A body that falls where the pulse is longer than 0.41 s."""

    def run(one, step):
        rows = np.zeros((2, 6))
        rows[1, trace.ROTATION] = 1.5 if one["model"]["ground_motion"]["end"] > 0.41 else 0.1
        return trace.Trace(np.array([0.0, step]), {"block": rows})

    found = trace.numbers(run, case("threshold-pulse"), 1e-3)
    assert found == {"threshold_duration": pytest.approx(0.41, abs=3e-4)}


def test_ground_motions_are_those_of_their_formulas():
    jerk = trace.ground(case("threshold-uplift")["model"])
    assert jerk(0.3) == pytest.approx(1.5)
    sine = trace.ground(case("pulse-overturns")["model"])
    assert sine(0.175) == pytest.approx(7.0)
    assert sine(0.71) == 0.0
    assert trace.ground(case("free-decay")["model"])(0.3) == 0.0


def test_damping_ratio_of_a_bounce_gives_its_restitution():
    """By steps of a mass on a spring and a damper that push and do not pull."""
    ratio, step = with_mujoco.damping_ratio(0.7), 1e-5
    x, v = 0.0, -1.0
    while True:
        force = -x - 2.0 * ratio * v
        if force <= 0.0 and v > 0.0:
            break
        v += step * force
        x += step * v
    assert v == pytest.approx(0.7, abs=1e-4)


# -- runs and tables -----------------------------------------------------------------------------


class Engine:
    NAME, PACKAGE, INSTALL, SETTINGS = "Engine", "numpy", "pip install numpy", "none"

    @staticmethod
    def run(one, step):
        if one["id"] == "bounce":
            raise trace.UnsupportedError("no bounces")
        if one["id"] == "free-decay":
            raise RuntimeError("lacks a\nlibrary")
        t = np.arange(round(one["duration"] / step) + 1) * step
        still = np.zeros((len(t), 6))
        return trace.Trace(t, {body["name"]: still for body in one["model"]["bodies"]})


def test_program_that_fails_or_cannot_state_a_case_goes_on(capsys):
    found = main.measure(Engine, (1e-2, 1e-3))
    assert found["cases"]["bounce"] == [{"unsupported": "no bounces"}]
    assert [row["failed"] for row in found["cases"]["free-decay"]] == ["lacks a library"] * 2
    assert found["cases"]["rocking-frame"][0]["values"]["impact_1_time"] is None
    text = tables.of_engine(found)
    assert "no bounces" in text
    assert "| `rocking-frame` " in text
    assert "missed" in text
    whole = tables.whole({"engines": {"Engine": found}, "missing": {"Other": "pip install other"}})
    assert "Other is not installed: pip install other." in whole


def test_programs_that_are_missing_have_a_remedy_and_the_page_is_written(
    monkeypatch, tmp_path, capsys
):
    monkeypatch.setattr(main, "missing", lambda engine: True)
    page = tmp_path / "page.md"
    names = ("descriptions", "answers", "side by side", "engines")
    page.write_text("a\n" + "".join("\n".join(tables.marks(name)) + "\n" for name in names))
    main.main(["--out", str(tmp_path / "out"), "--write", str(page)])
    text = page.read_text(encoding="utf-8")
    for engine in main.ENGINES:
        assert f"{engine.NAME} is not installed: pip install" in text
    kept = json.loads((tmp_path / "out" / "engines.json").read_text(encoding="utf-8"))
    assert set(kept["missing"]) == {engine.NAME for engine in main.ENGINES}
    with pytest.raises(SystemExit):
        main.main(["Newton"])
    assert "unknown: Newton; there are MuJoCo" in capsys.readouterr().err


def test_order_of_a_program_is_that_of_its_errors():
    one = case("slide-to-stop")
    (quantity,) = tables.references(one).items()
    rows = [
        {"step": step, "values": {quantity[0]: quantity[1] * (1.0 + 3.0 * step**2)}}
        for step in (1e-2, 1e-3)
    ]
    text = tables.of_engine({"cases": {one["id"]: rows}})
    row = next(line for line in text.splitlines() if one["id"] in line)
    assert [cell.strip() for cell in row.strip("|").split("|")][2:] == ["3.0e-04", "3.0e-06", "2.0"]


def test_page_holds_what_the_stored_run_and_the_cases_give():
    page = PAGE.read_text(encoding="utf-8")
    assert tables.written(STORED, page) == page
    assert set(STORED["engines"]) == {engine.NAME for engine in main.ENGINES}
    for one in STORED["engines"].values():
        assert set(one["cases"]) == {known["id"] for known in cases()}


def test_page_without_marks_is_refused():
    with pytest.raises(ValueError, match="between which a table stands"):
        tables.written(copy.deepcopy(STORED), "no marks")
