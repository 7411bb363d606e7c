"""Planar answers and those in space: blocks, falls, shares, and sentences."""

import numpy as np
import pytest

import rockeom as rk
from benchmarks import azimuths
from rockeom.assessment import plane, trials
from tests.space.test_assess import FIGURINE, LEVEL, PGA, RECORDINGS, swing

MASSES = np.array([3.0, 1.0, 2.0, 4.0, 1.5, 2.5])
PLACES = np.array(
    [[0.1, 0.2, 0.3], [-0.2, 0.1, 1.0], [0.05, -0.3, 0.2], [0.1, 0.1, 0.8], [-0.2, 0.2, 0.6],
     [0.15, -0.2, 0.5]]
)  # fmt: skip
FEET = {"front": (0.02, 0.26), "left": (-0.24, -0.13), "right": (0.22, -0.11)}


def of_masses() -> rk.LeggedStatue:
    """A tripod whose mass is in points."""
    centroid = MASSES @ PLACES / MASSES.sum()
    arms = PLACES - centroid
    squares = np.einsum("i,ij,ik->jk", MASSES, arms, arms)
    inertia = np.trace(squares) * np.eye(3) - squares
    return rk.LeggedStatue(
        feet=FEET, centroid=tuple(centroid.tolist()), mass=float(MASSES.sum()), inertia=inertia
    )


def test_block_of_a_tripod_is_that_of_the_direction_in_which_least_lifts_it():
    statue = of_masses()
    block, azimuth = plane.planar_block(statue)
    feet = np.array([*FEET.values()]) - statue.centroid[:2]
    directions = np.linspace(-np.pi, np.pi, 360_001)
    reaches = (feet @ [np.cos(directions), np.sin(directions)]).max(axis=0)
    weakest = directions[reaches.argmin()]
    assert np.exp(1j * azimuth) == pytest.approx(np.exp(1j * weakest), abs=3e-5)
    assert block.half_width - block.offset == pytest.approx(reaches.min(), rel=1e-4)
    way = np.array([np.cos(weakest), np.sin(weakest)])
    assert 2.0 * block.half_width == pytest.approx(np.ptp(feet @ way), rel=1e-4)
    across, up = (PLACES - statue.centroid)[:, :2] @ way, PLACES[:, 2] - statue.centroid[2]
    assert block.inertia == pytest.approx(MASSES @ (across**2 + up**2), rel=1e-4)
    assert (block.half_height, block.mass) == (statue.centroid[2], MASSES.sum())


def test_block_of_a_prism_is_the_block_of_its_narrow_side():
    same = rk.RigidBlock.from_dimensions(width=0.1, height=0.4, mass=10.0)
    block, azimuth = plane.planar_block(FIGURINE)
    for name in ("half_width", "half_height", "mass"):
        assert getattr(block, name) == pytest.approx(getattr(same, name))
    assert block.inertia == pytest.approx(same.parameters()["inertia"])
    assert azimuth == 0.0


@pytest.mark.parametrize("body", [FIGURINE, of_masses()])
def test_falls_in_the_plane_are_those_of_single_simulations(body):
    whole = rk.assess(body, RECORDINGS, pga=PGA, azimuths=1)
    answer = whole.plane
    ways = (1.0,) if body is FIGURINE else (1.0, -1.0)
    for i, recording in enumerate(RECORDINGS):
        peaks = [one.peak for one in recording.horizontal]
        stronger = recording.horizontal[int(np.argmax(peaks))]
        for j, way in enumerate(ways):
            for k, pga in enumerate(PGA):
                factor = pga / np.sqrt(peaks[0] * peaks[1])
                run = rk.simulate(
                    answer.block, factor * way * stronger, vertical=factor * recording.vertical,
                    duration=recording.vertical.duration + 10.0,
                )  # fmt: skip
                assert answer.fell[i, j, k] == (run.outcome == "overturned")
    assert answer.fell.shape == (len(RECORDINGS), len(ways), len(PGA))
    assert answer.answered.all()
    assert "<th>planar block" in whole.html()
    for fell in answer.fell.sum(axis=(0, 1)):
        assert f"<td>{fell} of {4 * len(ways)}</td>" in whole.html()
    assert answer.share == pytest.approx(answer.fell.mean())


def test_a_wide_prism_shaken_across_falls_as_its_block_does():
    """From rest it rocks in the plane of the stronger component, as long as the other is weak."""
    wide = rk.Prism(width=0.1, depth=0.6, height=0.4, mass=10.0)
    recordings = [
        rk.Recording(f"site {i}", (swing(2 * i), (0.3 / swing(2 * i + 1).peak) * swing(2 * i + 1)))
        for i in range(4)
    ]
    answer = rk.assess(wide, recordings, pga=[1.2, 2.0], azimuths=1)
    np.testing.assert_array_equal(answer.plane.fell[:, 0], answer.trials.fell)
    assert 0 < answer.trials.fell.sum() < answer.trials.fell.size
    assert answer.plane.more.value == answer.plane.missed == 0
    assert answer.plane.share == answer.plane.share_in_space


# -- sentences


def said(space, flat, known=True) -> str:
    """Sentences of falls in space (n, turns) and in the plane (n, ways), at one intensity."""
    space, flat = np.array(space, bool), np.array(flat, bool)
    found = trials.Trials(
        space.reshape(-1, 1), np.ones((space.size, 1), bool), (), None, "", {}, {}, {}
    )
    flat = flat[:, :, None]
    answered = np.broadcast_to(known, flat.shape)
    compared = plane._compared(found, flat, answered, space.shape[1], LEVEL)
    answer = plane.InPlane(FIGURINE, np.radians(90.0), flat, answered, *compared)
    return plane.in_words(answer, found, LEVEL)


def test_a_plane_that_stands_where_the_body_falls_was_not_safe():
    text = said([[1, 1, 1, 1]] * 8 + [[0, 0, 0, 1]] * 4, [[0]] * 12)
    assert "towards 90 degrees" in text
    assert "overturns in 0 % of the scaled motions, the body in space in 75 %" in text
    assert "36 of its 36 falls are under recordings that leave the block standing" in text
    assert "The planar answer was not safe: in space 75 % more of them overturn" in text


def test_a_plane_that_falls_where_the_body_stands_was_safe():
    text = said([[0, 0, 0, 0]] * 11 + [[1, 0, 0, 0]], [[1, 0]] * 12)
    assert "overturns in 50 % of the scaled motions, the body in space in 2.1 %" in text
    assert "standing" not in text
    assert "The planar answer was safe: in space 48 % fewer of them overturn" in text


def test_the_interval_of_equal_answers_holds_zero():
    """Student's of 12 zeros and two of one: 2.201 sqrt(2/11/12) = 27 %."""
    text = said([[1, 1]] * 6 + [[0, 0]] * 6, [[1]] * 6 + [[0]] * 6)
    assert "No measurable difference says whether the planar answer was safe" in text
    assert "(95 % interval 27 % fewer to 27 % more)" in text


@pytest.mark.parametrize(
    ("space", "flat", "words"),
    [
        ([[0, 0]] * 3, [[0]] * 3, "overturns in none of the scaled motions, as the body does"),
        ([[1, 0]], [[0]], "does not follow from one recording"),
    ],
)
def test_what_does_not_follow_is_said(space, flat, words):
    assert words in said(space, flat)


def test_motions_without_an_answer_are_left_out():
    known = np.array([[[True]], [[False]], [[True]]])
    text = said([[1, 1], [1, 1], [1, 0]], [[1], [0], [0]], known)
    assert "in 50 % of the scaled motions, the body in space in 75 %" in text
    assert "1 of its 5 falls" in text
    assert said([[1, 1]] * 2, [[1]] * 2, False) == ""


def test_a_slab_on_columns_has_no_planar_block():
    podium = rk.Podium(columns=4, slab_mass=60e3, radius=0.5, height=4.0, mass=8000.0)
    alone = trials.Conditions((), np.zeros(0), np.ones(1), None, None, azimuths=(0.0,))
    assert plane.in_plane(podium, alone, None, LEVEL) is None


# -- how often intervals hold the truth


@pytest.mark.parametrize(
    "setting",
    [(6, 0.3, 0.2, 0.0), (12, 1.0, 0.05, 1.0), (30, 0.9, 0.5, 1.0), (30, 0.6, 0.05, 1.0)],
)
def test_intervals_of_recordings_hold_the_truth_as_often_as_they_say(setting):
    replicates = 300
    found = azimuths.coverage(azimuths.Setting(*setting), replicates)
    slack = 3.0 * np.sqrt(LEVEL * (1.0 - LEVEL) / replicates)
    for name in ("sum of parts", "space less plane"):
        assert found[name][0] >= LEVEL - slack, name
