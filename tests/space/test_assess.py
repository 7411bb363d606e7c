"""From which direction does it fall? Assessments in space, against loops of single simulations."""

import numpy as np
import pytest
from scipy.stats import beta, binom, binomtest, norm

import rockeom as rk
from rockeom.analysis import formulas
from rockeom.assessment import azimuths, trials
from tests.space.test_standing import TRIPOD

DT = 0.02
LEVEL = 0.95
FIGURINE = rk.Prism(width=0.1, depth=0.14, height=0.4, mass=10.0)
AZIMUTHS = (0.0, np.radians(40.0), np.radians(90.0))
PGA = np.array([2.5, 4.0])


def swing(seed: int) -> rk.GroundMotion:
    rng = np.random.default_rng(seed)
    t = np.arange(100) * DT
    angle = 2.0 * np.pi * t / rng.uniform(0.3, 0.9) + rng.uniform(0.0, 6.0)
    a = np.sin(angle) * np.exp(-t * rng.uniform(0.5, 2.0)) * rng.uniform(1.0, 3.0)
    return rk.GroundMotion.from_array(a, dt=DT, name=f"swing {seed}")


RECORDINGS = [
    rk.Recording(f"site {i}", (swing(3 * i), swing(3 * i + 1)), 0.3 * swing(3 * i + 2))
    for i in range(4)
]


@pytest.fixture(scope="module")
def answer():
    return rk.assess(FIGURINE, RECORDINGS, pga=PGA, azimuths=["0 deg", "40 deg", "90 deg"])


@pytest.fixture(scope="module")
def falls():
    """(recordings, azimuths, PGA) falls, one simulation after the other."""

    def fell(recording, azimuth, pga):
        peaks = [one.peak for one in recording.horizontal]
        shaken = (pga / np.sqrt(peaks[0] * peaks[1])) * recording
        end = shaken.vertical.duration + 10.0
        return rk.simulate(FIGURINE, shaken, azimuth=azimuth, duration=end).outcome == "overturned"

    return np.array([[[fell(r, a, pga) for pga in PGA] for a in AZIMUTHS] for r in RECORDINGS])


def test_falls_are_those_of_single_simulations(answer, falls):
    assert 0 < falls.sum() < falls.size
    np.testing.assert_array_equal(answer.trials.fell, falls.reshape(-1, len(PGA)))
    for at, pga in zip(answer.trials.intensities, PGA, strict=True):
        assert at.pga == pytest.approx(pga)
    for row, fell in zip(answer.trials.intensities, np.moveaxis(falls, 2, 0), strict=True):
        assert (row.overturned, row.number) == (fell.sum(), fell.size)
        parts, n = fell.mean(axis=1).sum(), len(RECORDINGS)
        lower = beta.ppf(0.025, parts, n - parts + 1) if parts else 0.0
        upper = beta.ppf(0.975, parts + 1, n - parts) if parts < n else 1.0
        assert (row.lower, row.upper) == pytest.approx((lower, upper))


def test_each_azimuth_counts_recordings_by_themselves(answer, falls):
    for i, (azimuth, at) in enumerate(zip(AZIMUTHS, answer.azimuths, strict=True)):
        assert at.azimuth == pytest.approx(azimuth)
        np.testing.assert_array_equal(at.overturned, falls[:, i].sum(axis=0))
        for j, hits in enumerate(at.overturned.tolist()):
            of_all = binomtest(hits, len(RECORDINGS)).proportion_ci(1.0 - 0.05 / 3, method="exact")
            assert (at.lower[j], at.upper[j]) == pytest.approx((of_all.low, of_all.high))


def test_words_and_page_name_the_azimuths(answer, falls, tmp_path):
    by_azimuth = falls.sum(axis=(0, 2))
    text = " ".join(str(answer).split())
    most = np.degrees(AZIMUTHS[by_azimuth.argmax()])
    assert "Will it overturn? Prism under 4 records" in text
    assert "Each record shakes it at 3 azimuths, from 0 degrees to 90 degrees." in text
    assert f"it falls most at {most:.4g} degrees, in {by_azimuth.max()} of 8 scaled" in text
    assert "the geometric mean of both horizontal components" in text
    assert "tilt/barrier" in text
    assert "one plane" not in text
    answer.save(tmp_path / "page.html")
    page = (tmp_path / "page.html").read_text(encoding="utf-8")
    assert "Overturning against azimuth" in page
    assert "site 3, at 90 degrees" in page


def test_records_as_recorded_tell_tilt_and_reserve(answer):
    one = answer.records[4]  # the second recording at 40 degrees
    run = rk.simulate(
        FIGURINE, RECORDINGS[1], azimuth="40 deg", duration=RECORDINGS[1].vertical.duration + 10.0
    )
    assert one.outcome == run.outcome.value
    assert one.rotation == pytest.approx(run.extremes("tilt").maximum, rel=1e-9, abs=1e-14)
    assert 1.0 - one.part == pytest.approx(run.extremes("reserve").minimum, rel=1e-9)
    assert answer.furthest.azimuth in AZIMUTHS


# -- what is at rest


@pytest.mark.parametrize(
    "body", [FIGURINE, rk.LeggedStatue(**TRIPOD), rk.Prism(
        width=0.5, depth=0.7, height=2.0, mass=1.0, offset_x=0.1, offset_y=-0.2, friction=0.3,
    )],
)  # fmt: skip
def test_uplift_is_the_least_of_all_directions(body):
    answer = rk.assess(body, RECORDINGS[:1], pga=0.01, azimuths=1)
    at = body.positions({})
    feet = np.array([at[foot] - at["body"] for foot in body.module.POINTS])
    directions = np.linspace(-np.pi, np.pi, 3601)
    least = formulas.rocking_threshold(directions, feet[:, :2], -feet[0, 2]).min()
    assert answer.statics.uplift_acceleration == pytest.approx(least, rel=1e-6)
    assert answer.statics.weight == pytest.approx(body.mass * body.gravity)
    assert "at one azimuth, 0 degrees, alone: others may overturn it sooner." in answer.verdict
    assert any("azimuths other than 0 degrees" in said for said in answer.assumptions)
    where = "Sliding: in the weakest direction it"
    assert answer.findings[1].startswith(where) is (body.friction is not None)
    assert answer.slides_first is (None if body.friction is None else bool(least / 9.81 > 0.3))


def test_a_round_column_is_alike_at_all_azimuths():
    column = rk.WobblingColumn(radius=0.05, height=0.4, mass=3.0)
    strong = [r.scaled_to(pga=5.0) for r in RECORDINGS[:2]]  # weak wobbling takes very many steps
    answer = rk.assess(column, strong, pga=4.0)
    assert [at.azimuth for at in answer.azimuths] == [0.0]
    assert "azimuth" not in answer.verdict
    assert answer.statics.uplift_acceleration == pytest.approx(9.81 * 0.05 / 0.2)
    runs = [
        rk.simulate(column, r.scaled_to(pga=4.0), duration=r.vertical.duration + 10.0)
        for r in RECORDINGS[:2]
    ]
    assert answer.trials.fell[:, 0].tolist() == [run.outcome == "overturned" for run in runs]


@pytest.mark.parametrize(
    ("given", "degrees"),
    [
        ((FIGURINE, None), [0, 45, 90, 135]),
        ((FIGURINE, 3), [0, 60, 120]),
        ((rk.LeggedStatue(**TRIPOD), None), np.arange(0, 360, 45)),
        ((rk.WobblingColumn(radius=0.1, height=1.0, mass=1.0), 8), [0]),
        ((FIGURINE, ["30 deg", 1.0]), [30, np.degrees(1.0)]),
    ],
)
def test_azimuths_by_number_end_where_the_body_is_as_before(given, degrees):
    assert np.degrees(azimuths.azimuths_of(*given)) == pytest.approx(degrees)


# -- what is refused

X, Y = RECORDINGS[0].horizontal
BLOCK = rk.RigidBlock(half_width=0.1, half_height=0.4)
CAN = rk.RollingCylinder(radius=0.033, height=0.12, mass=0.35)


@pytest.mark.parametrize(
    ("body", "records", "more", "words"),
    [
        (FIGURINE, X, {}, "one horizontal component, and a structure in space takes two"),
        (FIGURINE, [RECORDINGS[0], rk.Recording("again", (X, Y))], {}, "one motion twice"),
        (FIGURINE, RECORDINGS, {"azimuths": 0}, "assess: azimuths is 0: give how many, 1 to 360"),
        (FIGURINE, RECORDINGS, {"azimuths": 0.5}, "how many, 1 to 360"),
        (FIGURINE, RECORDINGS, {"azimuths": np.inf}, "how many, 1 to 360"),
        (FIGURINE, RECORDINGS, {"azimuths": np.nan}, "how many, 1 to 360"),
        (FIGURINE, RECORDINGS, {"azimuths": [1e300]}, "a million radians at most"),
        (FIGURINE, RECORDINGS, {"azimuths": ["x"]}, "assess: azimuths is 'x'"),
        (FIGURINE, RECORDINGS, {"azimuths": [0.0, -1e-12]}, "one azimuth or more, each once"),
        (FIGURINE, RECORDINGS, {"azimuths": "north"}, 'a text such as "30 deg"'),
        (FIGURINE, RECORDINGS, {"azimuths": [0.0, "360 deg"]}, "one azimuth or more, each once"),
        (FIGURINE, RECORDINGS, {"azimuths": []}, "one azimuth or more, each once"),
        (FIGURINE, RECORDINGS, {"slope": "5 deg"}, "level ground alone"),
        (BLOCK, X, {"azimuths": 4}, "moves in a plane: leave them out"),
        (CAN, RECORDINGS, {}, "not one body at rest on level feet"),
    ],
)
def test_what_cannot_be_assessed_is_refused(body, records, more, words):
    with pytest.raises(ValueError, match=words):
        rk.assess(body, records, pga=4.0, **more)


def test_a_component_that_does_not_shake_is_named():
    still = rk.GroundMotion.from_array(np.zeros(9), dt=DT, name="still")
    half = rk.Recording("half", (RECORDINGS[0].horizontal[0], still))
    with pytest.raises(rk.InputError, match="geometric mean of its horizontal components is zero"):
        half.scaled_to(pga=1.0)


# -- how often intervals hold the truth


@pytest.mark.parametrize("n", [2, 3, 8, 22, 44])
def test_the_interval_holds_for_all_parts_of_two_values(n):
    """Exactly, by the binomial distribution of recordings with the larger part."""
    turns, misses = 4, []
    probabilities = np.linspace(0.005, 0.995, 67)
    for low, high in [(i, j) for j in range(1, turns + 1) for i in range(j)]:
        ends = []
        for larger in range(n + 1):
            fallen = np.repeat([low, high], [n - larger, larger])
            fell = (np.arange(turns) < fallen[:, None]).ravel()
            ends.append(trials.by_parts(fell, np.repeat(np.arange(n), turns), LEVEL))
        lower, upper = np.array(ends).T
        truth = (low + (high - low) * probabilities)[:, None] / turns
        outside = (lower > truth + 1e-12) | (upper < truth - 1e-12)
        mass = binom.pmf(np.arange(n + 1), n, probabilities[:, None])
        misses.append((mass * outside).sum(axis=1).max())
    assert max(misses) <= 1.0 - LEVEL
    assert max(misses) == misses[[(i, j) for j in range(1, 5) for i in range(j)].index((0, turns))]


def drawn(seed: int, correlation: float, shift: np.ndarray) -> tuple[trials.Trials, np.ndarray]:
    """Falls of 12 recordings by lognormal capacities at azimuths, at three intensities."""
    rng, n, turns = np.random.default_rng(seed), 12, len(shift)
    shared, own = rng.standard_normal((n, 1)), rng.standard_normal((n, turns))
    capacity = np.sqrt(correlation) * shared + np.sqrt(1.0 - correlation) * own + shift
    fell = (capacity.ravel()[:, None] < np.array([-0.8, 0.0, 0.8])) & True
    found = trials.Trials(fell, np.ones_like(fell), (), None, "", {}, {}, {})
    return found, np.repeat(np.arange(n), turns)


def said(seed: int, correlation: float, shift: np.ndarray) -> tuple[str, tuple, np.ndarray]:
    found, recordings = drawn(seed, correlation, shift)
    conditions = trials.Conditions(
        (), recordings, np.ones(3), None, None, azimuths=tuple(range(len(shift)))
    )
    answers = azimuths.by_azimuth(found, conditions, LEVEL)
    return azimuths.in_words(answers, found, conditions, LEVEL), answers, found.fell


@pytest.mark.parametrize("correlation", [0.0, 0.7])
def test_azimuths_that_do_not_differ_are_seldom_told_apart(correlation):
    replicates, alike = 300, np.zeros(4)
    several = [said(seed, correlation, alike) for seed in range(replicates)]
    told_apart = sum("no measurable difference" not in text for text, *_ in several)
    missed = 0
    truth = norm.cdf([-0.8, 0.0, 0.8])
    for _, answers, _ in several:
        held = [(at.lower <= truth) & (truth <= at.upper) for at in answers]
        missed += not np.all(held, axis=0)[1]
    slack = 3.0 * np.sqrt(LEVEL * (1.0 - LEVEL) / replicates)
    assert told_apart / replicates <= 1.0 - LEVEL + slack
    assert missed / replicates <= 1.0 - LEVEL + slack


def test_an_azimuth_at_which_it_falls_far_more_often_is_told_apart():
    text, *_ = said(0, 0.7, np.array([0.0, 2.5, 2.5, 2.5]))
    assert "it falls most at 0 degrees" in text
    assert "no measurable difference" not in text
