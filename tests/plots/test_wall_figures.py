"""Measured envelopes and computed paths: each wall in a panel, both directions to one side."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from matplotlib.figure import Figure

from rockeom.analysis import identification
from rockeom.plots import wall_envelopes
from tests.refusals import refused

TESTS = identification.wall_tests()


def straight(test):
    return SimpleNamespace(displacement=np.array([0.0, 0.1]), force=np.array([0.0, test.strength]))


def test_each_wall_with_an_envelope_has_a_panel_with_its_points_and_its_error():
    paths = {name: straight(test) for name, test in TESTS.items()}
    figure = wall_envelopes(TESTS, paths)
    panels = [ax for ax in figure.axes if ax.get_title()]
    assert len(panels) == 14
    for ax in panels:
        name = ax.get_title().split(":")[0]
        test = TESTS[name]
        up, down, path, rigid = ax.get_lines()
        assert len(up.get_xdata()) + len(down.get_xdata()) >= len(test.envelope.force)
        assert max(up.get_ydata()) == pytest.approx(test.envelope.force.max() / 1e3)
        assert min(np.concatenate([up.get_xdata(), down.get_xdata()])) >= 0
        np.testing.assert_allclose(path.get_xdata(), [0.0, 100.0])  # mm
        assert rigid.get_ydata()[0] == pytest.approx(test.rocking_strength / 1e3)
        error = test.envelope_error(paths[name].displacement, paths[name].force)
        assert ax.get_title() == f"{name}: rms {100 * error:.0f} %"


def test_walls_are_drawn_into_a_figure_of_ones_own():
    own = Figure()
    one = {"WS.40": TESTS["WS.40"]}
    assert wall_envelopes(one, {"WS.40": straight(TESTS["WS.40"])}, figure=own) is own
    assert own.axes


def test_walls_without_an_envelope_or_a_path_are_refused():
    assert refused(wall_envelopes, {"E8": TESTS["E8"]}, {}) == ("tests", {})
    assert refused(wall_envelopes, {"WS.40": replace(TESTS["WS.40"])}, {}) == ("paths", "WS.40")
