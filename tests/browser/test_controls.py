"""Menus, presets, questions, sizes, statics and code of a page say what Python says."""

import re

import numpy as np
import pytest

import rockeom as rk
from rockeom.assessment.statics import statics_of
from rockeom.browser.setup import difference
from rockeom.browser.sizes import enlarged
from rockeom.browser.traced import UntracedError
from tests.refusals import refused, refuses
from tests.typical import column

from .browsers import native

BLOCK = rk.RigidBlock(half_width=0.15, half_height=0.6)
PULSE = rk.GroundMotion.half_sine(4.0, 0.8, duration=5.0)
CASE = rk.Case(BLOCK, PULSE)
WIDTH = {"half_width": (0.05, 0.4)}
LAWS = {"Housner": rk.AngularMomentum(), "r = 0.7": rk.EnergyRatio(0.7)}
PULSES = {"half sine": PULSE, "sine": rk.GroundMotion.single_sine(3.0, 0.8, duration=6.0)}
COLUMN = column(half_width=0.3, stiffness=5e5, damping=500.0)
FRAME = rk.ShearFrame(
    masses=[20e3] * 3, heights=[3.5, 7.0, 10.5], stiffnesses=[2e7] * 3, dampings=[12e4] * 3,
    half_width=2.0, base_mass=10e3, base_inertia=5e3,
)  # fmt: skip


@pytest.fixture(scope="module")
def page():
    return rk.explorer(
        CASE, {**WIDTH, "amplitude": (1.0, 8.0)}, menus={"impact": LAWS, "motion": PULSES},
        presets={"slender": {"half_width": 0.06, "impact": "r = 0.7"}},
        questions=[rk.Question("Wider?", {"half_width": 0.3}, before={"half_width": 0.1})],
    )  # fmt: skip


# --- menus


def test_each_combination_of_menus_is_the_case_of_python(page):
    for law in range(2):
        for motion in range(2):
            place = np.array([0.2, 3.0, law, motion, 1.0])
            case = rk.Case(
                rk.RigidBlock(half_width=0.2, half_height=0.6),
                list(PULSES.values())[motion], list(LAWS.values())[law],
            )  # fmt: skip
            formula = (rk.GroundMotion.half_sine, rk.GroundMotion.single_sine)[motion]
            case = rk.Case(case.structure, formula(3.0, 0.8, duration=5.0 + motion), case.impact)
            made = page.setup.numbers(place)
            assert made is not None
            assert difference(made, case.problem()) is None


def test_a_menu_of_a_function_gives_it_the_option():
    def case(half_width, weight):
        return rk.Case(rk.RigidBlock(half_width=half_width, half_height=0.6, mass=weight), PULSE)

    page = rk.explorer(case, WIDTH, menus={"weight": {"light": 10.0, "heavy": 1000.0}})
    masses = [page.setup.numbers(np.array([0.2, i, 1.0])).p[0] for i in (0.0, 1.0)]
    assert masses == [10.0, 1000.0]
    assert "weight={'light': 10.0, 'heavy': 1000.0}[{1}]" in page.description()["code"]


@pytest.mark.parametrize(
    ("given", "error", "message"),
    [
        ({"menus": {"impact": {"one": None}}}, TypeError, "give two options or more"),
        ({"menus": {"impct": LAWS}}, ValueError, "over has 'impct', which is unknown"),
        ({"menus": {f"m{i}": LAWS for i in range(5)}}, ValueError, "32 combinations.*at most 24"),
        ({"presets": {"a": {"half_width": 4.0}}}, ValueError, "half_width is 4: give a number"),
        ({"presets": {"a": {"width": 0.1}}}, ValueError, r"preset 'a' has 'width'"),
        ({"questions": [rk.Question("Why?", {"half_width": 9})]}, ValueError, "question 'Why.'"),
        (
            {"menus": {"impact": LAWS}, "presets": {"a": {"impact": "none"}}}, ValueError,
            r"impact is 'none': give one of \['Housner', 'r = 0.7'\]",
        ),
    ],
)  # fmt: skip
def test_what_no_control_can_have_is_refused(given, error, message):
    with pytest.raises(error, match=message):
        rk.explorer(CASE, WIDTH, **given)


def test_a_menu_of_structures_with_other_equations_is_refused():
    pages = rk.explorer(
        CASE, {"amplitude": (1.0, 8.0)}, menus={"structure": {"block": BLOCK, "column": COLUMN}}
    )
    with pytest.raises(UntracedError, match="is a rigid_block or a flexible_structure: make a"):
        _ = pages.html


def test_a_question_compares_what_a_page_knows():
    assert refused(rk.Question, "Why?", {}, compare="energy") == ("compare", "energy")


def test_presets_and_questions_are_places_of_values(page):
    found = page.description()
    assert found["presets"][-1] == {"name": "slender", "values": {0: 0.06, 2: 1.0}}
    (question,) = found["questions"]
    assert question["before"] == {0: 0.1}
    assert question["after"] == {0: 0.3}


def test_a_page_of_a_block_offers_objects_within_its_ranges():
    sliders = {"half_width": (0.05, 0.4), "half_height": (0.3, 1.2)}
    names = {preset["name"] for preset in rk.explorer(CASE, sliders).description()["presets"]}
    assert "statue on a plinth" in names
    assert "bridge pier" not in names


# --- sizes


@pytest.mark.parametrize("factor", [2.0, 4.0])
def test_a_block_of_another_size_is_the_block_with_these_sides(page, factor):
    larger = rk.RigidBlock(half_width=0.2 * factor, half_height=0.6 * factor, mass=factor**3)
    made = page.setup.numbers(np.array([0.2, 4.0, 0.0, 0.0, factor]))
    assert difference(made, rk.Case(larger, PULSE, LAWS["Housner"]).problem()) is None


def test_a_larger_structure_of_the_same_material_vibrates_as_much_slower():
    larger = enlarged(rk.Case(COLUMN, PULSE), 2.0).structure
    modes = [one.fixed_base() for one in (COLUMN, larger)]
    assert modes[1].periods == pytest.approx(2.0 * modes[0].periods)
    assert modes[1].damping_ratios == pytest.approx(modes[0].damping_ratios)


# --- statics


OFFSET = rk.OffsetBlock(half_width=0.175, half_height=1.0, offset=0.03)


@pytest.mark.parametrize("structure", [BLOCK, OFFSET, COLUMN, FRAME])
def test_uplift_and_sliding_are_those_of_the_assessment(structure):
    page = rk.explorer(rk.Case(structure, PULSE), {"amplitude": (1.0, 8.0)})
    motion, found = native(page)([4.0, 1.0]), np.zeros(2)
    motion["program"].uplift_and_friction(motion["p"], found)
    statics = statics_of(structure)
    assert found[0] == pytest.approx(statics.uplift_acceleration, rel=1e-9)
    assert found[1] == pytest.approx(max(statics.frictions_to_rock), rel=1e-9)


# --- code


def run_code(page, place):
    text = page.description()["code"]
    menus = {k: one for k, one in enumerate(page.controls.of.values()) if hasattr(one, "labels")}

    def value(found):
        k = int(found[1])
        return repr(menus[k].labels[int(place[k])] if k in menus else place[k])

    names: dict = {}
    exec(re.sub(r"\{(\d+)\}", value, text), names)
    return names["run"]


def test_code_of_a_page_simulates_the_same_motion(page, capsys):
    place = [0.21, 5.0, 1.0, 1.0, 1.0]
    motion, run = native(page)(place), run_code(page, place)
    assert motion["outcome"] == str(run.outcome)
    assert abs(run.extremes("theta").peak) == pytest.approx(motion["readings"][1], rel=1e-9)
    capsys.readouterr()


def test_code_of_a_record_and_of_degrees_is_complete(capsys):
    case = rk.Case(BLOCK, rk.GroundMotion.from_library("El Centro 1940 180"), duration=5.0)
    page = rk.explorer(case, {"scale": (0.5, 4.0), "initial theta_degrees": (0.0, 5.0)})
    run = run_code(page, [2.0, 3.0])
    assert run.motion.peak == pytest.approx(2.0 * case.motion.peak)
    assert run["theta"][0] == pytest.approx(np.radians(3.0))
    capsys.readouterr()


def of_one_shape(size, amplitude):
    block = rk.RigidBlock(half_width=0.25 * size, half_height=size)
    return rk.Case(block, rk.GroundMotion.half_sine(amplitude, 0.8, duration=6.0))


def test_code_of_a_function_has_its_source(capsys):
    page = rk.explorer(of_one_shape, {"size": (0.2, 2.0), "amplitude": (2.0, 8.0)})
    run = run_code(page, [1.0, 3.0])
    assert run.structure.half_width == 0.25
    capsys.readouterr()


# --- a widget


def test_values_of_a_widget_are_those_of_controls_and_give_the_case(page):
    pytest.importorskip("anywidget", reason="widgets are made with anywidget")
    shown = page.widget()
    assert shown.values == {
        "half_width": 0.15, "amplitude": 4.0, "impact": "Housner", "motion": "half sine",
    }  # fmt: skip
    shown.values = {"half_width": 0.2, "impact": "r = 0.7"}
    assert shown.values["amplitude"] == 4.0
    assert shown.case.structure.half_width == 0.2
    assert shown.case.impact == LAWS["r = 0.7"]
    with refuses("half_width", 7):
        shown.values = {"half_width": 7}
