"""Will it overturn? Of structures that ties hold: compared with plain simulations and statics."""

import dataclasses
import re

import numpy as np
import pytest

import rockeom as rk
from tests.assessment.test_assessment import RECORDS
from tests.refusals import told

G = 9.81
SIZE = {"width": 0.5, "height": 1.8, "mass": 300.0, "friction": 0.6, "gravity": G}
STRAP = rk.Strap(
    at=(-0.25, 1.7), to=(-0.6, 1.7), stiffness=2e5, breaks_at=rk.Break(force=900.0)
)  # fmt: skip
STATUE = rk.HeldBlock(**SIZE, restraint=STRAP)
RACK = rk.HeldBlock(
    **SIZE, restraint=rk.Anchor.pair(stiffness=1e6, breaks_at=rk.Break(force=700.0))
)
WALL = rk.Facade(
    thickness=0.6, height=6.0, mass=7e3, restitution=0.4, gravity=G,
    restraint=rk.Strap(
        at=(-0.3, 5.5), to=(-2.3, 5.5), stiffness=2e6, breaks_at=rk.Break(extension=0.01)
    ),
)  # fmt: skip
SOME, PGA = RECORDS[:3], np.array([0.25, 0.4, 0.6]) * G


def answer_of(structure):
    return rk.assess(structure, SOME, pga=PGA)


@pytest.fixture(scope="module", params=[STATUE, RACK, WALL], ids=["statue", "rack", "facade"])
def answer(request):
    return answer_of(request.param)


def motions_at(pga):
    """Each record scaled to a PGA, in both directions, and ten seconds of quiet after it."""
    for record in SOME:
        scaled = record.scaled_to(pga)
        yield from ((scaled, record.duration + 10.0), (-scaled, record.duration + 10.0))


def test_tie_that_breaks_first_is_that_of_the_simulations(answer):
    counts, first = [], {name: 0 for name in answer.structure.states if name.endswith("_broken")}
    for pga in PGA:
        runs = [rk.simulate(answer.structure, a, duration=end) for a, end in motions_at(pga)]
        times = [{e.contact: e.time for e in run.events if e.kind == "break"} for run in runs]
        counts.append({tie.name: sum(tie.name in one for one in times) for tie in answer.ties})
        if any(times) and not any(first.values()):
            for one in filter(None, times):
                first[f"{min(one, key=one.get)}_broken"] += 1
    assert any(first.values())
    for tie in answer.ties:
        assert list(tie.broken) == [count[tie.name] for count in counts]
        assert tie.first == first[f"{tie.name}_broken"]
    (sentence,) = (one for one in answer.findings if one.startswith("Restraints"))
    lowest = next(i for i, count in enumerate(counts) if any(count.values()))
    leading = max(answer.ties, key=lambda tie: tie.first)
    assert sentence.startswith(
        f"Restraints: {leading.name} breaks in {leading.broken[lowest]} of 6 at a PGA of "
        f"{PGA[lowest] / 9.80665:.3g} g, first in {leading.first}"
    )
    assert sentence.replace(" N", "&nbsp;N").replace(" g,", "&nbsp;g,") in answer.html()


def test_strap_that_is_recommended_holds_in_a_simulation(answer):
    height = float(re.search(r"A strap ([\d.]+) m", " ".join(answer.helps))[1])
    (said,) = (one for one in answer.helps if one.startswith("That strap"))
    stiffness = float(re.search(r"of ([\d.e+]+) N/m", said)[1])
    number, kilo = re.search(r"strength of ([\d.]+) (k?)N or more", said).groups()
    strength = float(number) * (1e3 if kilo else 1.0)
    block, largest = answer.structure.strapped(height, stiffness), 0.0
    for motion, end in motions_at(PGA[-1]):
        run = rk.simulate(block, motion, duration=end)
        assert run.outcome != "overturned"
        largest = max(largest, *(run[f"{tie.name}_force"].max() for tie in block.restraint))
    assert 0.8 * strength < largest <= strength * (1 + 0.02)  # the stiffness is printed rounded


def test_statics_are_those_of_the_unrestrained_structure():
    statics = answer_of(STATUE).statics
    assert statics.uplift_accelerations == pytest.approx([G * 0.25 / 0.9] * 2)
    # about the outer edge: m g b = m a h + T z
    wall = dataclasses.replace(WALL, thrust=2e3)
    left, right = answer_of(wall).statics.uplift_accelerations
    assert np.isinf(left)
    assert right == pytest.approx((7e3 * G * 0.3 - 2e3 * 6.0) / (7e3 * 3.0))
    answer = answer_of(WALL)
    assert answer.findings[0].startswith("Uplift: the inner edge, without ties, lifts from 0.1 g")
    assert "hold the edge about which it turns" in answer.summary().replace("\n    ", " ")


def test_blocks_on_one_base_are_judged_by_the_block_that_falls():
    blocks = [
        rk.RigidBlock.from_dimensions(width=w, height=0.9, mass=40.0, gravity=G) for w in (0.3, 0.2)
    ]
    base = rk.IsolatedBlocks.from_period(
        blocks, base_mass=120.0, period=0.4, damping_ratio=0.05, friction=0.6, gravity=G
    )
    answer = answer_of(base)
    assert answer.statics.uplift_acceleration == pytest.approx(G * 0.2 / 0.9)
    fell = sum(
        rk.simulate(base, a, duration=end).outcome == "overturned" for a, end in motions_at(PGA[-1])
    )
    assert answer.trials.intensities[-1].overturned == fell > 0
    assert answer.trials.bodies["block_2"] >= answer.trials.bodies.get("block_1", 0)
    assert not any("strap" in one for one in answer.helps)


def test_friction_is_that_of_the_structure():
    said = told(rk.assess, STATUE, SOME, friction=0.3)
    assert "friction is 0.3, and 0.6 in the structure: leave it out" in said
