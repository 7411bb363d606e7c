"""Figures of ground motions and spectra: what they show is what the motion says, with units."""

import numpy as np
import pytest

import rockeom as rk
from rockeom.plots import plot_motion, plot_spectra

PULSE = rk.GroundMotion.single_cosine(2.0, 0.5, duration=1.0)
SET = rk.MotionSet(
    [rk.GroundMotion.kanai_tajimi(0.01, duration=2.0, seed=seed) for seed in range(8)], "synthetic"
)
PERIODS = np.geomspace(0.1, 1.0, 5)


def test_motion_is_drawn_with_its_units_and_its_exact_peaks():
    figure = PULSE.plot()
    figure.draw_without_rendering()
    acceleration, velocity, displacement = figure.axes
    labels = [ax.get_ylabel() for ax in figure.axes]
    assert labels == ["acceleration [g]", "velocity [m/s]", "displacement [m]"]
    t, drawn = acceleration.lines[0].get_data()
    assert drawn == pytest.approx(PULSE.acceleration(t) / 9.81)
    jump = np.flatnonzero(t == 0.5)[-1]  # from 2 m/s2 to nothing within one time step of a float
    assert (drawn[jump - 1], drawn[jump]) == (pytest.approx(2.0 / 9.81), 0.0)
    t, drawn = velocity.lines[0].get_data()
    assert drawn == pytest.approx(PULSE.velocity(t))
    assert velocity.lines[0].get_label() == f"PGV {PULSE.peak_velocity:.3g} m/s"
    t, drawn = displacement.lines[0].get_data()
    assert drawn == pytest.approx(PULSE.displacement(t))
    assert figure.get_suptitle() == PULSE.name
    assert plot_motion(PULSE, start=0.1, end=0.6).axes[2].get_xlim() == (0.1, 0.6)


def test_spectra_of_a_set_are_drawn_with_their_median():
    figure = SET.plot(PERIODS)
    figure.draw_without_rendering()
    spectra = [*SET.response_spectra(PERIODS).values()]
    for ax, name, scale in zip(
        figure.axes, ("pseudo_acceleration", "velocity", "displacement"), (9.81, 1, 1), strict=True
    ):
        values = np.array([getattr(one, name) for one in spectra]) / scale
        assert ax.get_xlabel() == "period [s]"
        assert "[" in ax.get_ylabel()
        assert len(ax.lines) == len(SET) + 1
        assert ax.lines[-1].get_label() == "median"
        assert ax.lines[-1].get_ydata() == pytest.approx(np.median(values, axis=0))
        assert ax.lines[2].get_ydata() == pytest.approx(values[2])
    assert "synthetic" in figure.get_suptitle()
    assert "damping ratio 5 %" in figure.get_suptitle()


def test_few_spectra_are_told_apart_by_name():
    figure = SET[:3].plot(PERIODS, 0.02)
    labels = [line.get_label() for line in figure.axes[0].lines]
    assert labels == [*SET[:3].names]
    (line,) = SET[0].response_spectrum(PERIODS).plot().axes[2].lines
    assert line.get_label() == SET[0].name


def test_spectra_that_do_not_belong_together_are_refused():
    with pytest.raises(ValueError, match="no spectra: give one or more"):
        plot_spectra([])
    with pytest.raises(ValueError, match="other periods or damping: draw them in figures"):
        plot_spectra([SET[0].response_spectrum(1.0), SET[1].response_spectrum(2.0)])


def test_design_spectrum_is_drawn_over_the_spectra_where_it_is_defined():
    target = rk.DesignSpectrum.eurocode_8(2.0, "B")
    spectrum = rk.GroundMotion.single_sine(2.0, 0.5).response_spectrum([0.1, 0.5, 2.0, 5.0])
    acceleration, velocity, displacement = plot_spectra([spectrum], target=target).axes
    line = acceleration.lines[-1]
    assert line.get_label() == target.name
    np.testing.assert_allclose(line.get_xdata(), [0.1, 0.5, 2.0])
    np.testing.assert_allclose(9.81 * line.get_ydata(), target([0.1, 0.5, 2.0]))
    np.testing.assert_allclose(
        displacement.lines[-1].get_ydata(), target.displacement([0.1, 0.5, 2])
    )
    assert len(velocity.lines) == 1
