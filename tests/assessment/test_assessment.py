"""Will it overturn? Compared with closed forms, plain simulations and intervals of scipy."""

from __future__ import annotations

import dataclasses

import numpy as np
import pytest
from scipy.stats import binomtest

import rockeom as rk
from rockeom.assessment.statics import statics_of
from rockeom.motion import JenningsEnvelope
from tests.numeric.structures import column

G = 9.81
BLOCK = rk.RigidBlock(half_width=0.25, half_height=1.0, mass=400.0)
PGA = np.array([0.35, 0.45, 0.6]) * G


def record(seed: int) -> rk.GroundMotion:
    envelope = JenningsEnvelope(rise=1.0, until=4.0, decay=1.0)
    motion = rk.GroundMotion.kanai_tajimi(
        0.02, duration=7.0, seed=seed, envelope=envelope, dt=0.02, angular_frequency=9.0
    )
    return dataclasses.replace(motion, name=f"record {seed}")


RECORDS = [record(seed) for seed in range(6)]


@pytest.fixture(scope="module")
def held():
    return rk.assess(BLOCK, RECORDS, pga=PGA)


@pytest.fixture(scope="module")
def sliding():
    return rk.assess(BLOCK, RECORDS, pga=PGA, friction=0.3)


# --- at rest


@pytest.mark.parametrize(("b", "h"), [(0.1, 0.9), (0.4, 0.5), (1.2, 1.0)])
def test_block_lifts_at_b_over_h_and_slides_before_with_less_friction(b, h):
    statics = statics_of(rk.RigidBlock(half_width=b, half_height=h, mass=70.0))
    assert statics.uplift_acceleration == pytest.approx(G * b / h)
    assert statics.friction_to_rock == pytest.approx(b / h)
    assert statics.centroid_height == pytest.approx(h)
    assert statics.sliding_acceleration(0.2) == pytest.approx(0.2 * G)


@pytest.mark.parametrize("friction", [0.24, 0.26])
def test_verdict_says_which_comes_first(friction):
    answer = rk.assess(BLOCK, RECORDS[:1], pga=1.0, friction=friction)
    assert answer.slides_first == (friction < 0.25)
    first = "slides first" if friction < 0.25 else "rocks first"
    assert first in answer.findings[1]
    assert answer.verdict.startswith("It slides before it rocks.") == (friction < 0.25)


def test_restraint_carries_the_moment_that_the_weight_does_not():
    """M (a H - g B) about the edge, and the pull on a foot by the equations of full contact."""
    statics, a = statics_of(BLOCK), 0.7 * G
    moment = 400.0 * (a * 1.0 - G * 0.25)
    assert statics.restraint(a, 1.6) == pytest.approx(moment / 1.6)
    assert statics.hold_down(a) == pytest.approx(moment / 0.5)
    pulled = BLOCK.reactions({}, a, mode="both")["right_reaction"]
    assert statics.hold_down(a) == pytest.approx(-pulled)
    assert statics.hold_down(0.2 * G) == 0.0


def test_column_slides_by_the_mass_of_all_its_parts():
    structure = column()
    values = structure.parameters()
    mass = values["mass"] + values["base_mass"]
    statics = statics_of(structure)
    assert statics.mass == pytest.approx(mass)
    assert statics.weight == pytest.approx(mass * values["gravity"])


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
            assert (row.pga, row.overturned, row.number) == (pga, counted, 6)
            expected = binomtest(counted, 6).proportion_ci(0.95, method="exact")
            assert (row.lower, row.upper) == pytest.approx(expected)
    assert 0 < sum(row.overturned for row in held.trials.intensities) < 18


def test_effect_of_each_record_is_that_of_a_plain_simulation(held, sliding):
    for motion, one, slid in zip(RECORDS, held.records, sliding.records, strict=True):
        run = rk.simulate(BLOCK, motion, duration=motion.duration + 10.0)
        assert one.outcome == run.outcome
        assert one.rotation == pytest.approx(abs(run.extremes("theta").peak), rel=1e-6)
        assert one.part == pytest.approx(one.rotation / BLOCK.alpha)
        assert one.lifts == (motion.peak > 0.25 * G)
        assert np.isnan(one.slip)
        assert np.isfinite(slid.slip) == (slid.outcome != "overturned")


def test_block_that_slides_from_the_start_ends_where_a_plain_simulation_does():
    answer = rk.assess(BLOCK, RECORDS[:2], pga=PGA, friction=0.1)
    slides = rk.SlidingBlock(
        half_width=0.25, half_height=1.0, mass=400.0, friction=0.1, restitution=0.0
    )
    for motion, one in zip(RECORDS, answer.records, strict=False):
        run = rk.simulate(slides, motion, duration=motion.duration + 10.0)
        assert one.slip == pytest.approx(abs(run["x"][-1]))
        assert one.slip > 1e-3
    assert answer.verdict.startswith("It slides before it rocks. No")


def test_pga_is_the_quantile_of_the_curve_and_its_interval_says_its_method(held):
    value, lower, upper = held.pga_at(0.05)
    assert held.trials.fragility.probability(value) == pytest.approx(0.05)
    assert lower < value < upper
    said = " ".join(held.assumptions)
    for method in ("Clopper and Pearson", "maximum likelihood", "delta method", "95 %", "are few"):
        assert method in said


def test_remedies_are_assessments_of_changed_blocks(held):
    inertia = BLOCK.parameters()["inertia"]
    changed = (
        dataclasses.replace(BLOCK, half_width=0.275, inertia=inertia),
        dataclasses.replace(BLOCK, half_height=0.9, inertia=inertia),
    )
    for one, block, said in zip(held.remedies, changed, held.helps, strict=False):
        other = rk.assess(block, RECORDS, pga=PGA)
        assert one.statics == other.statics
        assert [row[:-1] for row in one.trials.intensities] == [
            row[:-1] for row in other.trials.intensities
        ]
        assert f"{other.statics.uplift_acceleration / G:.3g} g instead of 0.25 g on" in said
    assert "5 cm wider" in held.helps[0]
    assert "10 % lower" in held.helps[1]
    assert "2 m above the ground" in held.helps[2]


def test_block_with_its_centroid_off_the_middle_counts_each_side_by_its_own_angle():
    block = rk.RigidBlock.from_dimensions(width=0.5, height=2.0, offset=0.05, mass=400.0)
    statics = statics_of(block)
    assert statics.friction_to_rock == pytest.approx(0.2)
    assert statics.centroid_height == pytest.approx(1.0)
    assert statics.hold_down(0.5 * G) == pytest.approx(400.0 * G * (0.5 - 0.2) / 0.5)
    left, right = block.overturning_angles
    for motion, one in zip(RECORDS, rk.assess(block, RECORDS, pga=PGA).records, strict=True):
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
    assert none.verdict.startswith("Not under these records: none of 6 overturns it")
    assert none.pga_at(0.5) is None
    assert "add higher intensities" in none.findings[-1]
    every = rk.assess(BLOCK, RECORDS, pga=["4 g", "5 g"])
    assert every.verdict == "Yes: at each intensity, from 4 g on, every record does it."
    assert "add lower ones" in every.findings[-1]
    below = rk.assess(BLOCK, RECORDS, pga=["0.1 g", "0.2 g"])
    assert below.verdict == "No: up to a PGA of 0.2 g none of 6 records even lifts a foot."
    for answer in (none, every, below):
        assert answer.verdict in answer.html().replace("&nbsp;", " ")


def test_separated_outcomes_and_one_record_are_answers():
    two = rk.assess(BLOCK, RECORDS[:2], pga=["0.2 g", "5 g"])
    assert "too few intensities" in two.findings[-1]
    assert two.findings[-1].endswith("add some between.")
    one = rk.assess(BLOCK, RECORDS[0], pga=["0.2 g", "5 g"])
    assert "one record says nothing of others" in one.findings[-1]


def test_vertical_components_are_left_out_and_named():
    up = dataclasses.replace(RECORDS[0], name="up", is_vertical=True)
    answer = rk.assess(BLOCK, [*RECORDS[:2], up], pga=PGA)
    assert answer.trials.intensities[0].number == 2
    (said,) = (one for one in answer.assumptions if one.startswith("Vertical components"))
    assert "were left out: up." in said
    alone = rk.assess(BLOCK, [up])
    assert "there is no horizontal one" in alone.verdict
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
    assert answer.conditions.stations == (0, 0, 1, 1)
    alone = rk.assess(BLOCK, both[:1], pga=PGA)
    assert "one record says nothing of others" in alone.findings[-1]


def test_accelerations_in_m_s2_that_look_like_g_have_a_hint():
    assert 'write "0.6 g"' in rk.assess(BLOCK, RECORDS[:2], pga=[0.2, 0.6]).verdict
    assert "write" not in rk.assess(BLOCK, RECORDS[:2], pga=[2.0]).verdict


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
    assert len(sliding.plot().axes) == 2


def test_names_of_records_are_no_markup():
    named = dataclasses.replace(RECORDS[0], name="<script>$x$</script>")
    assert "<script>" not in rk.assess(BLOCK, [named], pga=1.0).html()


def test_mass_that_was_not_given_makes_forces_parts_of_the_weight():
    answer = rk.assess(rk.RigidBlock(half_width=0.25, half_height=1.0), RECORDS[:1], pga="0.5 g")
    assert "12 % of the weight" in answer.helps[-1]  # (a H - g B)/(2 H g)
    assert " N" not in answer.helps[-1]


def test_folder_and_file_are_read(tmp_path):
    (tmp_path / "one.txt").write_text("\n".join(f"{0.01 * i} {np.sin(i / 9)}" for i in range(300)))
    with pytest.raises(rk.MotionError, match=r'from_folder\(.*pattern="\*.txt"'):
        rk.assess(BLOCK, tmp_path)
    with pytest.raises(rk.MotionError, match="units"):
        rk.assess(BLOCK, tmp_path / "one.txt")
    with pytest.raises(rk.MotionError, match="is no folder"):
        rk.assess(BLOCK, tmp_path / "nowhere")


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
    with pytest.raises(ValueError, match=r"\.html"):
        held.save(tmp_path / "page.docx")
