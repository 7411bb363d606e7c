"""Will it overturn? Compared with closed forms, plain simulations and intervals of scipy."""

import dataclasses

import numpy as np
import pytest
from scipy.stats import binomtest

import rockeom as rk
from rockeom.analysis.risk.fragility import fit_fragility
from rockeom.assessment import trials
from rockeom.motion import JenningsEnvelope
from rockeom.plots.design_report import facts_of
from rockeom.sweeps import run as sweeps
from tests.interrupts import interrupted_at
from tests.refusals import refused, refuses, told
from tests.typical import column, stack

G = 9.81
BLOCK = rk.RigidBlock(half_width=0.25, half_height=1.0, mass=400.0)
PGA = np.array([0.35, 0.45, 0.6]) * G


def record(seed: int) -> rk.GroundMotion:
    envelope = JenningsEnvelope(rise=1.0, until=4.0, decay=1.0)
    motion = rk.GroundMotion.kanai_tajimi(
        0.02, duration=7.0, seed=seed, envelope=envelope, dt=0.02, angular_frequency=9.0
    )
    return dataclasses.replace(motion, name=f"record {seed}")


RECORDS = [record(seed) for seed in range(8)]


@pytest.fixture(scope="module")
def held():
    return rk.assess(BLOCK, RECORDS, pga=PGA)


@pytest.fixture(scope="module")
def sliding():
    return rk.assess(BLOCK, RECORDS, pga=PGA, friction=0.3)


# --- at rest


@pytest.mark.parametrize(
    ("friction", "words"), [(0.24, "slides first"), (0.25, "at the limit"), (0.26, "rocks first")]
)
def test_verdict_says_which_comes_first(friction, words):
    answer = rk.assess(BLOCK, RECORDS[:1], pga="0.1 g", friction=friction)
    assert answer.slides_first == (friction < 0.25)
    assert words in answer.findings[1]
    assert ("It slides before it rocks." in answer.verdict) == (friction < 0.25)


def test_block_off_the_middle_slides_to_one_side_and_rocks_to_the_other():
    block = rk.OffsetBlock(half_width=0.175, offset=0.03, half_height=1.0)
    answer = rk.assess(block, RECORDS[:1], pga="0.1 g", friction=0.16)
    assert "lifts from 0.205 g (2.01 m/s2) on to the left and from 0.145 g" in answer.findings[0]
    left, right = answer.findings[1].split(" to the left and ")
    assert "slides first, from 0.16 g on" in left
    assert "rocks first" in right
    assert not answer.slides_first


STATUE = rk.RigidBlock.from_dimensions(width=0.6, height=1.8, centroid_height=0.8, mass=900.0)
RACK = rk.RigidBlock.from_dimensions(width=0.6, height=2.0, centroid_height=1.1, mass=800.0)


@pytest.mark.parametrize(
    ("structure", "friction", "words"),
    [  # m a h - N b = 900 g (0.8 - 0.3) = 4415 N m, m a - mu N = 900 g (1 - mu)
        (STATUE, 0.5, ["A strap 1.8 m above the ground, its full height", "4.41 kN", "8.83 kN"]),
        (STATUE, 0.3, ["A strap 1.57 m above", "does not push the base out", "6.18 kN", "20.6 kN"]),
        (STATUE, None, ["lifting up to 1 g", "2.45 kN", "7.36 kN", "Neither is judged against"]),
        (STATUE, 0.0, ["A strap 1.1 m above", "8.83 kN", "No hold-down does", "stop the base"]),
        (RACK, 0.6, ["A strap 2 m above the ground, its full height"]),
        (dataclasses.replace(RACK, full_height=None), 0.6, ["2.2 m above the ground, twice the"]),
        (column(), None, ["m above the ground, the height of the centroid"]),
    ],
)
def test_restraint_holds_against_lifting_and_sliding_at_a_height_it_names(
    structure, friction, words
):
    helps = " ".join(rk.assess(structure, RECORDS[:1], pga="1 g", friction=friction).helps[2:])
    assert all(word in helps for word in words), helps


def test_vertical_shaking_takes_weight_off_a_strap_and_may_lift_all_of_it():
    def helps(share: float) -> str:
        up = dataclasses.replace(RECORDS[1].scaled_to(share), is_vertical=True)
        pair = rk.Recording("site", (RECORDS[0].scaled_to(1.0),), up)
        return rk.assess(STATUE, pair, pga="1 g", friction=0.5).helps[2]

    # N = 900 (g - 0.4 g): pushed out above z = (0.8 + 0.6 0.3)/(1 - 0.3) = 1.4 m, 900 g 0.7
    assert "A strap 1.4 m above" in helps(0.4)
    assert "6.18 kN" in helps(0.4)
    assert "the vertical shaking lifts it" in helps(1.1)
    assert len(rk.assess(STATUE, RECORDS[:1], pga="0.2 g", friction=0.3).helps) == 2


# --- under records


def fallen(structure, motion, pga):
    shaken = motion.scaled_to(pga)
    run = rk.simulate(structure, shaken, duration=shaken.duration + 10.0)
    return run.outcome == "overturned"


def test_fractions_are_those_of_plain_simulations(held, sliding):
    slides = rk.SlidingBlock(
        half_width=0.25, half_height=1.0, mass=400.0, friction=0.3, restitution=0.0
    )
    for answer, structure in ((held, BLOCK), (sliding, slides)):
        for row, pga in zip(answer.trials.intensities, PGA, strict=True):
            counted = sum(fallen(structure, motion, pga) for motion in RECORDS)
            assert (row.pga, row.overturned, row.number) == (pga, counted, 8)
            expected = binomtest(counted, 8).proportion_ci(0.95, method="exact")
            assert (row.lower, row.upper) == pytest.approx(expected)
    assert 0 < sum(row.overturned for row in held.trials.intensities) < 24


def test_records_of_a_structure_without_symmetry_shake_it_in_both_directions():
    """Records with a larger push one way: their sign changes nothing."""
    block = rk.OffsetBlock(half_width=0.3, half_height=0.6, offset=0.2, mass=100.0)
    skewed = [dataclasses.replace(one, name=f"{one.name}!") for one in map(lopsided, RECORDS)]
    other = [dataclasses.replace(-one, name=one.name) for one in skewed]
    one, two = (rk.assess(block, records, pga=["0.2 g", "0.3 g"]) for records in (skewed, other))
    assert one.verdict == two.verdict
    assert one.trials.intensities == two.trials.intensities
    assert "Each record shakes it in both directions." in one.verdict
    for row in one.trials.intensities:
        falls = [[fallen(block, m, row.pga) for m in (one, -one)] for one in skewed]
        assert (row.overturned, row.number) == (np.sum(falls), 16)
        every, some = (int(np.sum(count)) for count in (np.all(falls, 1), np.any(falls, 1)))
        lower = binomtest(every, 8).proportion_ci(0.95, method="exact").low
        upper = binomtest(some, 8).proportion_ci(0.95, method="exact").high
        assert (row.lower, row.upper) == pytest.approx((lower, upper))
    gain = (one.trials.fell.mean() - one.remedies[0].trials.fell.mean(), one.remedies[0].gain.value)
    assert gain[0] == pytest.approx(gain[1])


def lopsided(motion: rk.GroundMotion) -> rk.GroundMotion:
    a = np.where(motion.samples > 0, 1.6 * motion.samples, motion.samples)
    return rk.GroundMotion.from_array(a, motion.dt, name=motion.name)


@pytest.mark.parametrize("call", [1, 2, 3, 4])
def test_interrupt_of_any_of_its_sweeps_is_no_answer(monkeypatch, call):
    monkeypatch.setattr(sweeps, "in_threads", interrupted_at(call, sweeps.in_threads))
    with pytest.raises(KeyboardInterrupt):
        rk.assess(BLOCK, RECORDS[:2], pga="0.4 g")


def test_motions_without_an_answer_are_counted_apart(monkeypatch):
    """As if a quarter of the sweep had found no solution: sentences count answers."""
    whole = trials.outcome_labels

    def some(sweep):
        labels = whole(sweep).astype("U20")
        labels.values[::4] = "no solution"
        return labels

    monkeypatch.setattr(trials, "outcome_labels", some)
    answer = rk.assess(BLOCK, RECORDS, pga=PGA)
    fell, answered, *_ = answer.trials
    assert "of 6 records lift a foot" in answer.verdict
    low, high = (
        fit_fragility(np.broadcast_to(PGA, fell.shape), hits).median / G
        for hits in (fell | ~answered, fell)
    )
    between = f"the PGA at 50 % is {low:.2g} g to {high:.2g} g"
    assert answer.findings[-1] == (
        "Without an answer, and left out: 6 'no solution' of 24 scaled motions. With all of them "
        f"standing, or all of them fallen, {between}."
    )
    monkeypatch.setattr(trials, "outcome_labels", lambda sweep: whole(sweep).where(False, "lost"))
    assert "none of 24 motions has an answer" in rk.assess(BLOCK, RECORDS, pga=PGA).verdict


def test_effect_of_each_record_is_that_of_a_plain_simulation(held, sliding):
    for motion, one, slid in zip(RECORDS, held.records, sliding.records, strict=True):
        run = rk.simulate(BLOCK, motion, duration=motion.duration + 10.0)
        assert one.outcome == run.outcome
        assert one.rotation == pytest.approx(abs(run.extremes("theta").peak), rel=1e-6)
        assert one.part == pytest.approx(one.rotation / BLOCK.alpha)
        assert one.lifts == (motion.peak > 0.25 * G)
        assert np.isnan(one.room)
        assert np.isfinite(slid.room) == (slid.outcome != "overturned")


def test_room_is_the_largest_distance_from_its_place_and_not_the_last():
    shape = JenningsEnvelope(rise=2.0, until=10.0, decay=0.5)
    motion = rk.GroundMotion.kanai_tajimi(0.02, duration=20.0, seed=24, envelope=shape)
    block = rk.RigidBlock.from_dimensions(width=0.6, height=0.8)
    answer = rk.assess(block, motion, friction=0.2, pga=motion.peak)
    slides = rk.SlidingBlock(half_width=0.3, half_height=0.4, friction=0.2, restitution=0.0)
    run = rk.simulate(slides, motion, duration=motion.duration + 10.0)
    (one,) = answer.records
    assert one.room == pytest.approx(abs(run.extremes("x").peak))
    assert one.displacement == pytest.approx(abs(run["x"][-1]))
    assert one.room > 20 * one.displacement
    assert "needs up to 13 mm of room on either side, and ends up to 0.5 mm" in answer.findings[1]
    assert answer.trials.intensities[0].room == pytest.approx(one.room, rel=1e-6)


def test_room_of_a_block_that_rocks_is_that_of_its_top():
    block = rk.RigidBlock.from_dimensions(width=1.0, height=2.0, centroid_height=0.9)
    motion = rk.GroundMotion.single_sine("0.9 g", 0.6)
    (one,) = rk.assess(block, motion, friction=0.9, pga=motion.peak).records
    run = rk.simulate(block, motion, duration=motion.duration + 10.0)
    tilt = abs(run.extremes("theta").peak)
    middle = 0.5 * (1.0 - np.cos(tilt))  # of the base, towards the corner that stands
    assert one.outcome != "overturned"
    assert one.room == pytest.approx(middle + 2.0 * np.sin(tilt), rel=1e-4)


def test_pga_is_the_quantile_of_the_curve_and_its_interval_says_its_method(held):
    value, lower, upper = held.pga_at(0.5)
    assert held.trials.fragility.probability(value) == pytest.approx(0.5)
    assert held.trials.fragility.groups == 8
    assert lower < value < upper
    said = " ".join(held.assumptions)
    for words in ("Clopper and Pearson", "maximum likelihood", "Fieller", "95 %"):
        assert words in said
    assert "8 recordings of 8 records" in said
    assert "stations of one event, are not grouped" in said


@pytest.mark.parametrize(
    ("number", "words"), [(5, "6 recordings or more, and there are 5"), (7, "that takes 8 record")]
)
def test_what_few_recordings_leave_open_is_not_given(number, words):
    answer = rk.assess(BLOCK, RECORDS[:number], pga=[3.0, 4.0, 5.0, 6.0])
    assert answer.pga_at(0.05) is None
    assert (answer.pga_at(0.5) is None) == (number == 5)
    assert words in " ".join(answer.findings)


def test_measures_are_motions_of_changed_blocks_run_again(held):
    inertia = BLOCK.parameters()["inertia"]
    changed = (
        dataclasses.replace(BLOCK, half_width=0.275, inertia=inertia),
        dataclasses.replace(BLOCK, half_height=0.9, inertia=inertia),
    )
    for one, block, said in zip(held.remedies, changed, held.helps, strict=False):
        lost = [[fallen(b, m, a) for b in (BLOCK, block)] for m in RECORDS for a in PGA]
        before, after = np.mean(lost, axis=0)
        assert one.gain.value == pytest.approx(before - after)
        assert f"{one.statics.uplift_acceleration / G:.3g} g instead of 0.25 g on" in said
        clear = one.gain.lower > 0.0
        assert ("fewer overturn (" if clear else "no measurable difference") in said
    assert "5 cm wider" in held.helps[0]
    assert "10 % lower" in held.helps[1]


def test_gain_is_seen_where_all_fall_at_the_largest_intensity():
    """Judged there, a centroid 10 % lower would be of no use."""
    levels = ["0.35 g", "0.4 g", "0.45 g", "0.5 g", "0.55 g", "4 g"]
    answer = rk.assess(BLOCK, [record(seed) for seed in range(20)], pga=levels)
    assert answer.trials.intensities[-1].overturned == 20
    assert "fewer overturn (95 % interval" in answer.helps[1]


def test_block_with_its_centroid_off_the_middle_counts_each_side_by_its_own_angle():
    block = rk.RigidBlock.from_dimensions(width=0.5, height=2.0, offset=0.05, mass=400.0)
    left, right = block.overturning_angles
    found = rk.assess(block, RECORDS, pga=PGA).records[::2]  # the others are reversed
    for motion, one in zip(RECORDS, found, strict=True):
        theta = rk.simulate(block, motion, duration=motion.duration + 10.0).extremes("theta")
        assert one.part == pytest.approx(max(theta.maximum / right, -theta.minimum / left))


def test_elastic_column_is_assessed_and_sliding_is_compared_with_what_it_needs():
    answer = rk.assess(column(), RECORDS[:2], pga=[1.0, 6.0], friction=0.05)
    support = answer.furthest.support
    needed = max(support.friction_demand, support.impact_friction_demand)
    assert f"needed a friction of {needed:.2g}" in answer.assumptions[0]
    assert answer.assumptions[0].endswith("It did not hold.")


# --- answers in words


def test_none_and_all_overturned_are_answers():
    none = rk.assess(BLOCK, RECORDS, pga="0.26 g")
    assert none.verdict.endswith(
        "Not under these records: none of 8 overturns it up to a PGA of 0.26 g, where the 95 % "
        "interval of the probability is 0 to 37 %."
    )
    assert none.pga_at(0.5) is None
    assert "add higher intensities" in none.findings[-1]
    every = rk.assess(BLOCK, RECORDS, pga=["4 g", "5 g"])
    assert every.verdict.endswith("Yes: scaled to each PGA, from 4 g on, every record does it.")
    assert "add lower ones" in every.findings[-1]
    below = rk.assess(BLOCK, RECORDS, pga=["0.1 g", "0.2 g"])
    assert below.verdict.endswith("No: up to a PGA of 0.2 g none of 8 records even lifts a foot.")
    for answer in (none, every, below):
        assert answer.verdict in answer.html().replace("&nbsp;", " ")


def test_first_sentence_is_on_the_records_as_they_are(held):
    fell = sum(one.fell for one in held.records)
    largest = max(one.part for one in held.records if not one.fell)
    assert fell == 0
    assert f"none overturns it; the largest theta/alpha is {largest:.2g}. Scaled" in held.verdict
    strong = rk.assess(BLOCK, [one.scaled(1.5) for one in RECORDS], pga=PGA)
    fell = sum(one.fell for one in strong.records)
    assert 0 < fell < 8
    assert strong.verdict.startswith(f"As recorded, 8 of 8 records lift a foot, {fell} overturn")
    assert "; the largest theta/alpha of the others is " in strong.verdict


def test_separated_outcomes_are_an_answer():
    two = rk.assess(BLOCK, RECORDS, pga=["0.2 g", "5 g"])
    assert "too few intensities" in two.findings[-1]
    assert two.findings[-1].endswith("add some between.")


def test_vertical_components_are_left_out_and_named_above_the_verdict():
    up = dataclasses.replace(RECORDS[0], name="up", is_vertical=True)
    answer = rk.assess(BLOCK, [*RECORDS[:2], up], pga=PGA)
    assert answer.trials.intensities[0].number == 2
    (said,) = (one for one in answer.questions if one.startswith("Vertical components"))
    assert "are left out: up." in said
    alone = rk.assess(BLOCK, [up])
    assert "there is no horizontal one" in alone.verdict
    assert "no curve, there is no motion" in alone.findings[-1]
    assert "a foot lifts from 0.25 g" in alone.summary()
    assert max(map(len, alone.summary().splitlines())) <= 80
    assert alone.html().count("<h2>") == 3


def test_recordings_shake_vertically_too_and_count_once():
    up = dataclasses.replace(RECORDS[5].scaled(0.6), name="up", is_vertical=True)
    both = [rk.Recording(f"site {i}", RECORDS[i : i + 2], up) for i in (0, 2)]
    answer = rk.assess(BLOCK, both, pga=PGA)
    assert [one.name for one in answer.records] == [f"record {i}" for i in range(4)]
    for one, motion in zip(answer.records, RECORDS, strict=False):
        run = rk.simulate(BLOCK, motion, vertical=up, duration=motion.duration + 10.0)
        assert (one.outcome, one.peak) == (run.outcome, motion.peak)
        assert one.rotation == pytest.approx(abs(run.extremes("theta").peak), rel=1e-6)
    assert "Vertical shaking: that of 4 of 4 records, scaled along." in answer.assumptions
    assert answer.conditions.recordings.tolist() == [0, 0, 1, 1]


@pytest.mark.parametrize(
    ("names", "groups"),
    [
        (["A-000", "A-090", "B-NS", "B-EW"], [0, 0, 1, 1]),
        (["A-000", "B", "A-045", "B"], [0, 1, 2, 3]),  # at no right angle, and of one name
        (["", "", "C-000"], [0, 1, 2]),
        (["seed 100", "seed 130", "seed 190", "seed 220"], [0, 1, 2, 3]),
    ],
)
def test_motions_are_grouped_by_names_of_one_recording(names, groups):
    """Of six stations none of 12 components falls: an upper bound of 0.459, not of 0.265."""
    named = [dataclasses.replace(m, name=n) for m, n in zip(RECORDS, names, strict=False)]
    answer = rk.assess(BLOCK, named, pga="0.26 g")
    assert {one.name for one in answer.records} <= {*names, "a ground motion"}
    assert sorted(answer.conditions.recordings.tolist()) == groups
    n = len(set(groups))
    assert answer.trials.intensities[0].upper == pytest.approx(1 - 0.025 ** (1 / n))


@pytest.mark.parametrize("name", ["record 0", "another"])
def test_one_motion_twice_is_refused(name):
    with refuses("records"):
        rk.assess(BLOCK, [RECORDS[0], dataclasses.replace(RECORDS[0], name=name)])


LARGE = rk.RigidBlock.from_dimensions(width=600, height=1800)
LIGHT = rk.RigidBlock(half_width=0.25, half_height=1.0)
HEAVY = dataclasses.replace(BLOCK, gravity=981.0)
IN_G = [one / G for one in RECORDS[:2]]


@pytest.mark.parametrize(
    ("structure", "more", "words", "said"),
    [
        (LARGE, {}, "measures 1800 m", "No verdict"),
        (HEAVY, {}, "gravity is 981", "No verdict"),
        (BLOCK, {"pga": [0.2, 0.6]}, 'write "0.6 g"', "No verdict"),
        (BLOCK, {"friction": 60}, "friction is 60", "As recorded"),
        (LIGHT, {}, "mass is at the default", "As recorded"),
        (BLOCK, {"records": IN_G}, "was it meant in g?", "Scaled it"),
    ],
)
def test_questions_stand_above_the_verdict_and_doubtful_units_take_its_place(
    structure, more, words, said
):
    arguments = {"records": RECORDS[:2], "pga": PGA} | more
    answer = rk.assess(structure, **arguments)
    (question,) = (one for one in answer.questions if words in one)
    assert answer.verdict.startswith(said)
    text = " ".join(answer.summary().split())
    assert text.index(f"Question: {question}") < text.index(answer.verdict)
    html = answer.html().replace("&nbsp;", " ")
    assert html.index('class="question"') < html.index('class="verdict"')
    if said == "No verdict":
        assert "strap" not in text
        assert not rk.assess(structure, **arguments, units_checked=True).verdict.startswith(said)
    assert not rk.assess(BLOCK, RECORDS[:1], pga=["0.4 g"]).questions


def test_stack_counts_the_fall_of_any_block_and_says_which():
    answer = rk.assess(stack(), RECORDS[:4], pga=["0.3 g", "0.6 g"])
    fell = sum(row.overturned for row in answer.trials.intensities)
    assert fell > 0
    assert (
        f"A fall of any block counts, of the scaled motions {fell} of the upper" in answer.verdict
    )
    assert not answer.helps
    for row in answer.trials.intensities:
        assert row.overturned == sum(fallen(stack(), motion, row.pga) for motion in RECORDS[:4])
    slides = dataclasses.replace(stack(), support=rk.Sliding(friction=0.2, restitution=0.0))
    with pytest.raises(ValueError, match="corners that slide are not judged"):
        rk.assess(slides, RECORDS[:4], pga=["0.3 g"])


def test_floors_of_a_recording_are_those_of_its_components():
    up = dataclasses.replace(RECORDS[2], name="up", is_vertical=True)
    floor = rk.floor_motion(rk.Recording("site", RECORDS[:2], up), periods=[0.5, 0.17], height=0.8)
    assert floor.vertical == up
    for one, motion in zip(floor.horizontal, RECORDS, strict=False):
        assert one == rk.floor_motion(motion, periods=[0.5, 0.17], height=0.8)
    assert rk.assess(BLOCK, [floor], pga=PGA).trials.intensities[0].number == 2


def test_facts_of_a_block_are_in_the_words_in_which_it_was_given():
    block = rk.RigidBlock.from_dimensions(width=0.6, height=1.9, centroid_height=0.85, mass=900.0)
    given = {"width": "0.6 m", "height": "1.9 m", "centroid height": "0.85 m"}
    assert given.items() <= dict(facts_of(block, None)).items()
    wider = dataclasses.replace(block, half_width=0.4)
    assert dict(facts_of(wider, None))["height"] == "1.9 m"
    halves = dict(facts_of(BLOCK, None))
    assert (halves["half width"], halves["half height"]) == ("0.25 m", "1 m")
    answer = rk.assess(block, RECORDS[:1], pga="0.4 g", friction=0.5)
    assert "<dt>centroid height</dt>" in answer.html()


def test_intensities_are_numbers_or_texts_with_their_unit_in_any_order():
    answer = rk.assess(BLOCK, RECORDS[:1], pga=["0.5 g", 2.0, "300 cm/s2", 2.0])
    found = [row.pga for row in answer.trials.intensities]
    assert found == pytest.approx([2.0, 3.0, 0.5 * G])
    default = rk.assess(BLOCK, RECORDS[:1])
    assert [row.pga / (0.25 * G) for row in default.trials.intensities] == pytest.approx(
        [1.25, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0]
    )


# --- what a user sees


@pytest.mark.filterwarnings("error")
def test_page_summary_and_notebook_say_the_same(sliding, tmp_path):
    sliding.save(tmp_path / "page.html")
    text = (tmp_path / "page.html").read_text(encoding="utf-8").replace("&nbsp;", " ")
    assert "http://" not in text.replace("http://www.w3.org", "")
    shown = sliding._repr_html_().replace("&nbsp;", " ")
    for sentence in (sliding.verdict, *sliding.findings, *sliding.helps, *sliding.assumptions):
        assert sentence in text
        assert sentence in shown
        assert sentence in " ".join(str(sliding).split())
    assert sliding.verdict in repr(sliding)
    assert "record 3" in text
    assert len(sliding.plot().axes) == 1


def test_names_of_records_are_no_markup():
    named = dataclasses.replace(RECORDS[0], name="<script>$x$</script>")
    assert "<script>" not in rk.assess(BLOCK, [named], pga=1.0).html()


def test_mass_that_was_not_given_makes_forces_parts_of_the_weight():
    answer = rk.assess(rk.RigidBlock(half_width=0.25, half_height=1.0), RECORDS[:1], pga="0.5 g")
    assert "12 % of the weight" in answer.helps[2]  # (a H - g B)/(2 H g)
    assert " N" not in answer.helps[2]


def test_folder_and_file_are_read(tmp_path):
    (tmp_path / "one.txt").write_text("\n".join(f"{0.01 * i} {np.sin(i / 9)}" for i in range(300)))
    assert refused(rk.assess, BLOCK, tmp_path)[0] == "path"
    assert "units" in told(rk.assess, BLOCK, tmp_path / "one.txt")
    assert refused(rk.assess, BLOCK, tmp_path / "nowhere")[0] == "path"


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        ((BLOCK, []), ["records", "MotionSet.from_folder"]),
        ((BLOCK, [3.0]), ["records", "give ground motions"]),
        ((BLOCK, None), ["records is None"]),
        ((RECORDS, BLOCK), ["structure", "give a structure"]),
        ((BLOCK, RECORDS, {"pga": "0.4"}), ["pga", "0.4 g"]),
        ((BLOCK, RECORDS, {"pga": "0.4 gee"}), ["pga", "unknown"]),
        ((BLOCK, RECORDS, {"pga": -1.0}), ["pga", "positive"]),
        ((BLOCK, RECORDS, {"pga": []}), ["pga", "one intensity or more"]),
        ((BLOCK, RECORDS, {"friction": -0.3}), ["friction", "-0.3"]),
        ((BLOCK, RECORDS, {"friction": "rough"}), ["friction", "rough"]),
        ((BLOCK, RECORDS, {"level": 95}), ["level", "0.95"]),
        ((rk.NondimensionalBlock(alpha=0.2), RECORDS), ["assess", "RigidBlock"]),
    ],
)
def test_mistake_is_named_with_its_remedy(arguments, words):
    structure, records, *rest = arguments
    with pytest.raises((TypeError, ValueError)) as error:
        rk.assess(structure, records, **(rest[0] if rest else {}))
    assert all(word in str(error.value) for word in words), error.value


def test_page_of_another_ending_is_refused(held, tmp_path):
    assert ".html" in told(held.save, tmp_path / "page.docx")
