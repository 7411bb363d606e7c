"""Numbers behind the figures of 2.5, 2.7 and 4.9.1; the figures themselves are drawn elsewhere."""

import numpy as np
import pytest

import rockeom as rk
from rockeom.thesis import statements
from rockeom.thesis.figures import (
    FIGURES,
    chapter_2_blocks,
    chapter_2_design,
    chapter_4_shaken,
    chapter_4_tests,
)


@pytest.mark.parametrize("margin", [0.99, 1.01])
def test_residual_rotation_by_the_moment_at_the_opening_and_not_by_lambda(margin):
    """Statics: it returns if the moment left by the opened joint exceeds that of the dissipater."""
    ratio = margin * chapter_2_design.moment_at_design_over_opening()
    assert ratio > 1
    assert (chapter_2_design.residual_rotation(ratio) > 0.05) == (margin < 1)


def test_damping_over_that_of_a_flag_in_closed_form():
    """2 (1 - k)/(1 + k (mu - 1)) of 2-32a over beta/(1 + 0.05 (mu - 1)) of 2-32c, Table 2-4."""
    bilinear, takeda = (one.judged().finding for one in statements.of_figure("2-22"))
    ends = [2 * 0.8 / (1 + 0.2 * x) * (1 + 0.05 * x) / 0.35 for x in (7.0, 0.5)]
    assert [bilinear.low[0], bilinear.low[1]] == pytest.approx(ends)
    assert bilinear.high == pytest.approx([2 * 0.95 / 0.35] * 2)
    assert takeda.high == pytest.approx([2.0, 3.0], abs=0.05)  # alpha_T = 0.3


def test_orbits_of_figure_2_11_and_doublings_of_2_12():
    """Symmetric, asymmetric and doubled: what distinguishes them, not where they are."""

    def speeds(beta):
        return chapter_2_blocks.upright_speeds(chapter_2_blocks.driven(beta))

    symmetric, asymmetric = speeds(2.0), speeds(2.8)
    assert np.ptp(np.abs(symmetric)) < 1e-6
    assert chapter_2_blocks.distinct(np.abs(asymmetric)) == 2
    found = [chapter_2_blocks.distinct(speeds(beta)) for beta in (3.0, 3.1075, 3.18, 3.22)]
    assert found == [2, 2, 4, 8]  # the first doubling is at 3.1106


def test_figure_2_12_has_no_cascade_where_half_of_the_energy_is_left():
    """As a ratio of energies 0.5 leaves one stable orbit of two mirror images from 3 to 3.26."""
    symmetric, asymmetric = chapter_2_blocks.branches_by_energy()
    assert not symmetric.orbits[-1].stable
    assert [one.kind for one in symmetric.bifurcations] == ["symmetry breaking"]
    assert symmetric.bifurcations[0].value < 3.0
    assert asymmetric.values[-1] == 3.26
    assert asymmetric.bifurcations == ()
    assert np.all(asymmetric.stable[1:])
    late = asymmetric.at(3.2)
    run = rk.simulate(
        chapter_2_blocks.SQUAT,
        rk.GroundMotion.harmonic(
            chapter_2_blocks.SQUAT.alpha * 3.2, period=3.0, phase=np.pi / 2, duration=150.0
        ),
        impact=rk.EnergyRatio(0.5),
        initial=dict(zip(late.states, late.state + np.array([1e-3, -1e-3]), strict=True)),
    )
    assert run.end == pytest.approx(late.state, abs=1e-6)


def test_pulses_of_figures_2_13_and_2_14():
    """Facts of the text: 0.172 g overturns, 0.454 g does not; 4.26 stands, 4.28 does not."""
    outcomes = [chapter_2_blocks.pulsed(8.0, peak, 2.192, 0.954).outcome for peak in (0.172, 0.454)]
    assert (outcomes[0] == "overturned", outcomes[1] == "overturned") == (True, False)
    ratios = (3.8, 3.82, 4.26, 4.28)
    fell = [chapter_2_blocks.pulsed(x, 0.3, 2.0, None).outcome for x in ratios]
    assert [one == "overturned" for one in fell] == [False, False, False, True]
    changes = chapter_2_blocks.changes_of_fate(
        "slenderness", 3.5, 5.0, 151, amplitude=0.3, period=2.0, ratio=None
    )
    labels = [text.get_text() for text in FIGURES["2-13"]().axes[1].texts]
    assert labels.count("stands") == 2  # below the weakest, and about 0.454 g
    for value in (changes.slenderness.values * (1 + 2e-9 * side) for side in (-1, 1)):
        fell = chapter_2_blocks.pulsed(float(value[0]), 0.3, 2.0, None).outcome
        assert (fell == "overturned") == (value[0] > changes.high.values[0])


def test_table_4_2_as_figures_4_57_and_4_58_read_it():
    found = chapter_4_tests.rows_of_75_kn()
    assert found["displacement"] == pytest.approx([-5.4e-3, -4.34e-3, 8.65e-3, -23.91e-3, 9.44e-3])
    assert found["largest"][3] == pytest.approx(119.5e3)
    assert float(chapter_4_tests.bending(np.array(5e-3))) == pytest.approx(0.57e-3, rel=0.02)


def test_turning_points_of_figure_4_69_give_back_the_force_of_the_wall():
    """4-42 where the wall stands still, but for the height at which the ground pushes its mass."""
    run = rk.simulate(
        rk.ControlledWall.thesis(),
        rk.GroundMotion.single_sine(8.0, 0.4, 1.5),
        impact=rk.EnergyRatio(0.852),
        options=rk.SolverOptions(output_step=1e-3),
    )
    displacement, force = chapter_4_shaken.forces_when_still(run)
    assert np.abs(displacement).max() > 3e-3
    far = np.abs(displacement) > 1e-3
    expected = chapter_4_shaken.WALL.restoring_force(displacement[far])
    assert len(expected) > 3
    assert force[far] == pytest.approx(expected, abs=0.08 * np.abs(expected).max())
