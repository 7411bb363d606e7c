"""Figures of walls that were tested: measured envelopes and computed pushovers."""

from collections.abc import Mapping
from typing import Any

from matplotlib.axes import Axes
from matplotlib.figure import Figure, SubFigure

from rockeom.analysis.identification.stone_walls import WallTest
from rockeom.drawing import style
from rockeom.numbers.checks import require, require_word

_COLUMNS = 4


@style.styled
def wall_envelopes(
    tests: Mapping[str, WallTest],
    paths: Mapping[str, Any],
    *,
    figure: Figure | SubFigure | None = None,
) -> Figure | SubFigure:
    """Draw measured envelopes and computed pushovers, a wall in each panel, with the error.

    Parameters
    ----------
    tests : dict of str to WallTest
        Tests by name, such as `analysis.identification.wall_tests`; those with an envelope are
        drawn.
    paths : dict of str to WallPath
        Paths by name, each with a displacement [m] and a force [N] from zero to beyond the
        envelope, such as those of `rk.WallOnBed.pushover`.
    figure : matplotlib.figure.Figure, optional
        Empty figure or subfigure to draw in; a new one if not given.

    Returns
    -------
    matplotlib.figure.Figure
        Figure. Both directions of a test are drawn to one side. The error is that of
        `WallTest.envelope_error`; dashes are the strength of rigid rocking on a crushed corner.

    Raises
    ------
    ValueError
        Where no test has an envelope, and where a path lacks.

    Examples
    --------
    With tests and the walls of `rk.WallOnBed.of_tests`::

        wall_envelopes(tests, {name: walls[name].pushover(0.05) for name in tests})
    """
    drawn = {name: test for name, test in tests.items() if test.envelope is not None}
    require(bool(drawn), "wall_envelopes", "tests", {}, "give walls that have a measured envelope")
    for name in drawn:
        require_word("paths", name, paths, "wall_envelopes")
    columns = min(_COLUMNS, len(drawn))
    rows = -(-(len(drawn) + 1) // columns)
    figure = figure or style.new_figure(2.0 * columns, 1.7 * rows)
    axes = figure.subplots(rows, columns, sharex=True, squeeze=False)
    panels = axes.ravel()
    for ax, (name, test) in zip(panels, drawn.items(), strict=False):
        lines = _panel(ax, test, paths[name])
        error = test.envelope_error(paths[name].displacement, paths[name].force)
        ax.set_title(f"{name}: rms {100 * error:.0f} %", fontsize="medium")
    for ax in panels[len(drawn) :]:
        ax.set_axis_off()
    panels[len(drawn)].legend(handles=lines, loc="center")
    for ax in panels[max(0, len(drawn) - columns) : len(drawn)]:
        ax.tick_params(labelbottom=True)
    figure.supxlabel("displacement [mm]", fontsize="medium")
    figure.supylabel("force [kN]", fontsize="medium")
    return figure


def _panel(ax: Axes, test: WallTest, path: Any) -> list:
    """Lines of the measured and the computed force."""
    envelope = test.envelope
    assert envelope is not None
    lines = []
    for sign, marker, direction in ((1, "o", "measured, positive"), (-1, "s", "negative")):
        at = sign * envelope.displacement >= 0
        u, f = sign * envelope.displacement[at], sign * envelope.force[at]
        face = style.LINES[0] if sign > 0 else "none"
        lines += ax.plot(
            1e3 * u, f / 1e3, marker, ms=2.5, mew=0.6, mfc=face, color=style.LINES[0],
            label=direction,
        )  # fmt: skip
    lines += ax.plot(
        1e3 * path.displacement, path.force / 1e3, color=style.LINES[1], label="bed that crushes"
    )
    strength = test.rocking_strength / 1e3
    lines.append(ax.axhline(strength, color=style.INK, ls="--", lw=0.8, label="rigid rocking"))
    ax.set(xlim=(0.0, 50.0), ylim=(0.0, None))
    return lines
