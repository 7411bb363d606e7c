"""The set-up of a page is that of Python, or there is no page."""

import math

import numpy as np
import pytest

import rockeom as rk
from rockeom.browser import setup
from rockeom.browser.controls import Controls, Slider
from rockeom.browser.places import OF_MODE
from rockeom.browser.setup import difference
from rockeom.browser.traced import Tape, UntracedError
from rockeom.sweeps.case_numbers import OtherCase
from tests import typical
from tests.refusals import refused

from .browsers import _declared_block


def setup_of(case, sliders):
    return setup.setup_of(case, Controls(sliders))


WIDTH = Slider(0.05, 0.4, 0.2)
AMPLITUDE = Slider(-6.0, 6.0, 3.0)
PULSE = rk.GroundMotion.half_sine(3.0, 1.0)
RECORD = rk.GroundMotion.from_library("El Centro 1940 180")


def block(half_width, half_height, theta, amplitude, period):
    structure = rk.RigidBlock(half_width=half_width, half_height=half_height)
    motion = rk.GroundMotion.half_sine(amplitude, period, duration=5.0)
    return rk.Case(structure, motion, initial={"theta": theta})


def under_record(half_width, scale):
    return rk.Case(rk.RigidBlock(half_width=half_width, half_height=0.6), RECORD.scaled(scale))


def column(half_width, stiffness, theta, amplitude):
    structure = typical.column(half_width=half_width, stiffness=stiffness, damping=500.0)
    motion = rk.GroundMotion.ricker(amplitude, 1.0)
    return rk.Case(structure, motion, rk.EnergyRatio(left=0.8, right=0.9), initial={"theta": theta})


def sliding_start(half_width, friction, theta, theta_dot, x_dot):
    structure = rk.SlidingBlock(
        half_width=half_width, half_height=0.4, friction=friction, restitution=0.2
    )
    start = {"theta": theta, "theta_dot": theta_dot, "x_dot": x_dot}
    return rk.Case(structure, PULSE, initial=start)


def leaning_stack(lower_half_width, theta):
    structure = rk.StackedBlocks(
        lower_half_width=lower_half_width, lower_half_height=0.5, upper_half_width=0.3,
        upper_half_height=0.6,
    )  # fmt: skip
    return rk.Case(structure, PULSE, initial={"theta": theta})


def leaning_on_a_bed(stiffness, theta):
    frame = rk.ShearFrame(
        masses=[20e3], heights=[3.5], stiffnesses=[2e7], dampings=[12e4], half_width=1.2,
        base_mass=10e3, base_inertia=5e4,
        support=rk.Winkler(springs=5, stiffness=stiffness, damping=1e5),
    )  # fmt: skip
    return rk.Case(frame, PULSE, initial={"theta": theta})


CASES = {
    block: {
        "half_width": WIDTH, "half_height": Slider(0.2, 1.5, 0.6), "theta": Slider(-0.5, 0.5, 0.1),
        "amplitude": AMPLITUDE, "period": Slider(0.2, 4.0, 1.0),
    },
    under_record: {"half_width": WIDTH, "scale": Slider(0.1, 4.0, 1.0)},
    column: {
        "half_width": Slider(0.1, 0.5, 0.3), "stiffness": Slider(1e5, 1e6, 5e5),
        "theta": Slider(-0.05, 0.05, 0.01), "amplitude": AMPLITUDE,
    },
    sliding_start: {
        "half_width": WIDTH, "friction": Slider(0.1, 0.8, 0.3), "theta": Slider(-0.1, 0.1, 0.05),
        "theta_dot": Slider(-0.5, 0.5, 0.1), "x_dot": Slider(-1.0, 1.0, 0.1),
    },
    leaning_stack: {
        "lower_half_width": Slider(0.3, 0.6, 0.4), "theta": Slider(-0.1, 0.1, 0.05),
    },
    leaning_on_a_bed: {"stiffness": Slider(1e6, 1e7, 4e6), "theta": Slider(-0.05, 0.05, 0.01)},
}  # fmt: skip


@pytest.mark.parametrize("case", CASES, ids=lambda case: case.__name__)
def test_numbers_of_other_places_are_those_of_python(case):
    sliders = CASES[case]
    numbers = setup_of(case, sliders).numbers
    rng = np.random.default_rng(9)
    for _ in range(50):
        place = np.array([rng.uniform(s.low, s.high) for s in sliders.values()])
        wanted = case(**dict(zip(sliders, place.tolist(), strict=True))).problem()
        made = numbers(place)
        assert made is not None
        assert difference(made, wanted) is None


def test_each_side_on_which_a_block_leans_is_a_way_of_its_own():
    found = setup_of(block, CASES[block])
    modes = [
        found.numbers(np.array([0.2, 0.6, theta, 3.0, 1.0])).numbers[OF_MODE]
        for theta in (-0.2, -0.1, 0.1, 0.2)
    ]
    assert modes == [0.0, 0.0, 2.0, 2.0]
    assert len(found.ways) >= 2


# --- what a page cannot repeat


def a_case(half_width, half_height=0.6):
    return rk.Case(rk.RigidBlock(half_width=half_width, half_height=half_height), PULSE)


@pytest.mark.parametrize(
    "calculated",
    [
        lambda x: float(x),
        lambda x: math.sqrt(x),
        lambda x: int(10 * x) / 10 + 0.1,
        lambda x: round(x, 3),
        lambda x: np.array([x]).astype(float)[0],
        lambda x: x // 0.1 + 0.1,
        lambda x: np.floor(10 * x) + 0.1,
    ],
    ids=["float", "math", "int", "round", "array", "quotient", "floor"],
)
def test_a_number_that_leaves_the_record_is_refused_with_its_line(calculated):
    with pytest.raises(UntracedError, match=r"test_setup\.py, line \d+.*slider"):
        setup_of(lambda half_width: a_case(calculated(half_width)), {"half_width": WIDTH})


def test_a_branch_that_is_not_recorded_is_refused_though_it_holds_on_a_thousandth_of_the_range():
    """The text of a number is no number: what is decided by it is not in the record."""

    def planted(half_width):
        inside = 0.2341 <= float(f"{half_width:.6f}") < 0.2341 + 1e-3 * (WIDTH.high - WIDTH.low)
        return a_case(half_width, 0.7 if inside else 0.6)

    with pytest.raises(UntracedError, match="the parameters of the page is not that of Python"):
        setup_of(planted, {"half_width": WIDTH})


def test_a_branch_that_is_recorded_becomes_a_way():
    def branched(half_width):
        return a_case(half_width, 0.7 if 0.2341 <= half_width < 0.2345 else 0.6)

    found = setup_of(branched, {"half_width": WIDTH})
    assert len(found.ways) == 3
    for x in (0.1, 0.2341, 0.2343, 0.2345, 0.3):
        assert difference(found.numbers(np.array([x])), branched(x).problem()) is None


def test_a_case_that_remembers_is_refused():
    calls = []

    def remembering(half_width):
        calls.append(half_width)
        return a_case(half_width, 0.6 + 1e-6 * len(calls))

    with pytest.raises(UntracedError, match="not that of Python"):
        setup_of(remembering, {"half_width": WIDTH})


def test_what_python_refuses_a_page_does_not_show():
    """A block that leans further than it falls is no case."""
    found = setup_of(
        lambda theta: rk.Case(
            rk.RigidBlock(half_width=0.1, half_height=0.5), PULSE, initial={"theta": theta}
        ),
        {"theta": Slider(0.0, 3.0, 0.1)},
    )
    assert found.numbers(np.array([0.2])) is not None
    assert found.numbers(np.array([2.0])) is None


def test_a_division_by_zero_at_the_end_of_a_slider_is_no_case_and_no_warning():
    declared = rk.Case(_declared_block(), PULSE)  # whose equations divide by its mass
    found = setup.setup_of(
        OtherCase(declared, ("mass",)), Controls({"mass": Slider(0.0, 9.0, 1.0)})
    )
    assert found.numbers(np.array([0.0])) is None
    assert found.numbers(np.array([0.1])) is not None
    with pytest.raises(UntracedError, match="division by zero; let no slider reach there"):
        setup_of(
            lambda mass: a_case(0.1 + 0.01 / (1.0 + 1.0 / mass)), {"mass": Slider(0.0, 9.0, 1.0)}
        )


def test_a_first_case_that_cannot_be_says_why():
    def fallen(theta):
        return rk.Case(
            rk.RigidBlock(half_width=0.1, half_height=0.5), PULSE, initial={"theta": theta}
        )

    assert refused(setup_of, fallen, {"theta": Slider(2.0, 3.0, 2.5)}) == ("theta", 2.5)


def test_too_many_ways_are_refused(monkeypatch):
    monkeypatch.setattr(setup, "MOST_WAYS", 4)

    def stairs(half_width):
        height = 0.6
        for i in range(60):
            if half_width > 0.05 + 0.35 * i / 60:
                height += 1e-3
        return a_case(half_width, height)

    with pytest.raises(UntracedError, match="more than 4 ways"):
        setup_of(stairs, {"half_width": WIDTH})


# --- the numbers themselves


def test_traced_numbers_calculate_as_numbers_do():
    x, y = Tape().sliders({"x": 0.7, "y": 2.5}).values()
    for traced, plain in (
        (x * y - y / x + 3, 0.7 * 2.5 - 2.5 / 0.7 + 3),
        (-(x**3), -(0.7 * 0.7 * 0.7)),
        (abs(x - y), abs(0.7 - 2.5)),
        (np.sqrt(y), math.sqrt(2.5)),
        (1 - x, 1 - 0.7),
    ):
        assert traced.present == plain
    for traced, plain in (
        (np.sin(x), math.sin(0.7)),
        (np.hypot(x, y), math.hypot(0.7, 2.5)),
        (y**0.3, 2.5**0.3),
        (2.0**x, 2.0**0.7),
        (np.arctan(x), math.atan(0.7)),
        (np.arctan2(x, y), math.atan2(0.7, 2.5)),
    ):
        assert traced.present == pytest.approx(plain, rel=1e-15)


def test_comparisons_are_recorded_once():
    tape = Tape()
    (x,) = tape.sliders({"x": 0.7}).values()
    held = [x > 0.5, x > 0.5, x < 0.5, bool(x), np.sign(x) == 1.0]
    assert held == [True, True, False, True, True]
    found = [(c.comparison, c.right, c.holds) for c in tape.conditions]
    assert found == [("gt", 0.5, True), ("lt", 0.5, False), ("ne", 0.0, True), ("gt", 0.0, True)]


def test_a_way_that_is_gone_at_one_value_alone_is_known():
    """A block that stands upright starts by the push of the ground, and by none if it is still."""

    def case(tilt, amplitude):
        structure = rk.RigidBlock(half_width=0.1, half_height=0.4)
        motion = rk.GroundMotion.single_cosine(amplitude, 0.8, duration=5.0)
        return rk.Case(structure, motion, initial={"theta": tilt * structure.alpha})

    sliders = {"tilt": Slider(0.0, 0.9, 0.5), "amplitude": Slider(0.0, 9.0, 0.0)}
    found = setup_of(case, sliders)
    for place in ([0.0, 5.0], [0.0, 0.0], [0.4, 0.0], [0.4, 5.0]):
        made = found.numbers(np.array(place))
        assert made is not None
        assert difference(made, case(*place).problem()) is None
