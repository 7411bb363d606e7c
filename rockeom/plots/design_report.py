"""One page on a structure under a set of records: figures, numbers, assumptions and how they held.

from rockeom.plots import design_report

page = design_report(column, records, impact=rk.EnergyRatio(0.74))
page.write("column.pdf")   # or column.html
"""

import html
import math
import textwrap
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property, partial
from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from rockeom.analysis.design.isolation import Demands, demands, energy_balance
from rockeom.drawing import page, style
from rockeom.drawing.checks import check_drawn
from rockeom.drawing.style import digits
from rockeom.files import check_target, write
from rockeom.motion import STANDARD_GRAVITY, GroundMotion
from rockeom.numbers import explained
from rockeom.numbers.checks import InputError, InputTypeError
from rockeom.numbers.degrees import with_degrees
from rockeom.simulation.plausible import ROUGHEST, default_masses, forces, shaking
from rockeom.simulation.reserve import Reserve, reserve_of
from rockeom.simulation.response import Outcome, Response
from rockeom.simulation.simulate import simulate
from rockeom.structures.base import FixedBase, Structure
from rockeom.structures.impact_laws import ImpactLaw
from rockeom.structures.slope import overturning_angles, uplift_accelerations

A4 = (8.27, 11.69)  # in
SHOWN = 12
"""Records that the page lists: those of the largest displacement."""
FILES = (".html", ".pdf")
_ASSUMPTIONS = "Assumptions, and how far they held"

Row = tuple[str, ...]


@dataclass(frozen=True, eq=False)
class UnderRecord:
    """Effects of one record on the structure, rocking and, if it has one, on a fixed base.

    Parameters
    ----------
    run : Response
        Response of the structure that rocks.
    fixed_run : Response
        Response on a fixed base; None without one.
    """

    run: Response
    fixed_run: Response | None

    @property
    def stands(self) -> bool:
        """Whether it was followed to its end and did not fall."""
        return self.run.outcome in (Outcome.COMPLETED, Outcome.CAME_TO_REST)

    @cached_property
    def rocking(self) -> Demands:
        """Demands of the structure that rocks."""
        return demands(self.run)

    @cached_property
    def fixed(self) -> Demands | None:
        """Demands of the structure on a fixed base, if it has one."""
        return None if self.fixed_run is None else demands(self.fixed_run)

    @cached_property
    def energy_error(self) -> float:
        """Error of the energy balances."""
        runs = (self.run, self.fixed_run)
        return max(energy_balance(run).error for run in runs if run is not None)

    @cached_property
    def reserve(self) -> Reserve | None:
        """Largest theta/alpha of the motion, if the structure has an overturning angle."""
        rotation = self.run.states[self.run.structure.module.ROTATION]
        return reserve_of(self.run.structure, self.run.extremes(rotation))

    @property
    def row(self) -> Row:
        """Its line in the table of the page."""
        name = self.run.motion.name or "a ground motion"
        peak = f"{self.run.motion.peak / STANDARD_GRAVITY:.3g}"
        if not self.stands:
            return (name, peak, str(self.run.outcome), *("–",) * 7)
        rocks, held = self.rocking, self.fixed
        return (
            name,
            peak,
            digits(1e3 * rocks.displacement),
            "–" if held is None else digits(1e3 * held.displacement),
            digits(1e3 * rocks.uplift),
            "–" if self.reserve is None else f"{self.reserve.ratio:.2f}",
            digits(rocks.base_shear * _force_scale(self.run.structure)[0], 4),
            "–" if held is None else f"{rocks.base_shear / held.base_shear:.2f}",
            "–" if held is None else f"{rocks.base_moment / held.base_moment:.2f}",
            f"{self.run.support.friction_demand:.2f}",
        )


@dataclass(frozen=True)
class DesignReport:
    """Results of `design_report`; `page` draws them, `html` and `write` hand them on.

    Parameters
    ----------
    structure : Structure
        Structure.
    impact : ImpactLaw
        Impact law; None for the default.
    results : tuple of UnderRecord
        Each motion, and its effect.
    """

    structure: Structure
    impact: ImpactLaw | None
    results: tuple[UnderRecord, ...]

    @property
    def title(self) -> str:
        """Structure and number of records, in words."""
        name = type(self.structure).__name__
        return f"{name} under {len(self.results)} record{'s' * (len(self.results) > 1)}"

    @property
    def columns(self) -> Row:
        """Headings of the table."""
        return (
            "record", "peak [g]", "displ. [mm]", "fixed [mm]", "uplift [mm]", "theta/alpha",
            f"shear [{_force_scale(self.structure)[1]}]", "shear ratio", "moment ratio", "friction",
        )  # fmt: skip

    @cached_property
    def facts(self) -> tuple[tuple[str, str], ...]:
        """The structure in names and values."""
        facts = [*facts_of(self.structure, self.impact)]
        held = self._held
        if held is not None:
            periods = ", ".join(f"{p:.4g}" for p in held.periods)
            ratios = ", ".join(f"{100 * z:.3g}" for z in held.damping_ratios)
            facts += [("fixed-base period", f"{periods} s"), ("its damping", f"{ratios} %")]
        return tuple(facts)

    @property
    def _held(self) -> FixedBase | None:
        """The structure on its fixed base, if it has one."""
        first = self.results[0].fixed_run
        held = None if first is None else first.structure
        return held if isinstance(held, FixedBase) else None

    @cached_property
    def standing(self) -> tuple[UnderRecord, ...]:
        """Motions that ended upright, the largest displacement first; others count as fallen."""
        standing = [one for one in self.results if one.stands]
        return tuple(sorted(standing, key=lambda one: -one.rocking.displacement))

    @cached_property
    def rows(self) -> tuple[Row, ...]:
        """Motions that overturned first, then the largest displacements; as many as are shown."""
        fallen = [one for one in self.results if not one.stands]
        return tuple(one.row for one in (*fallen, *self.standing)[:SHOWN])

    @cached_property
    def findings(self) -> tuple[str, ...]:
        """The set in sentences."""
        fallen = len(self.results) - len(self.standing)
        said = ["The structure stood under each of the records."]
        if fallen:
            outcomes = {str(one.run.outcome) for one in self.results if not one.stands}
            said = [f"Under {fallen} of {len(self.results)}: {', '.join(sorted(outcomes))}."]
        if not self.standing:
            return tuple(said)
        said.append(
            "Displacement of the load point: "
            + _spread([1e3 * one.rocking.displacement for one in self.standing], "mm")
        )
        if ratios := [one.reserve.ratio for one in self.standing if one.reserve is not None]:
            said.append(
                f"Rotation over overturning angle, theta/alpha: {_spread(ratios, '')} The least "
                f"reserve of those that stood is {100 * max(1 - max(ratios), 0.0):.3g} %."
            )
        both = [(one.rocking, one.fixed) for one in self.standing if one.fixed is not None]
        for name in ("base_shear", "base_moment", "displacement"):
            ratios = [getattr(a, name) / getattr(b, name) for a, b in both]
            if ratios and np.isfinite(ratios).all():
                what = name.replace("_", " ").capitalize()
                said.append(f"{what}, rocking over fixed base: {_spread(ratios, '')}")
        return tuple(said)

    @cached_property
    def assumptions(self) -> tuple[str, ...]:
        """Assumptions of the model, and how far the responses bear them out."""
        friction = [one.run.support.friction_demand for one in self.standing]
        demands = (one.run.support.impact_friction_demand for one in self.standing)
        impulses = [demand for demand in demands if demand >= 0.0]
        jumped = sum(one.run.support.lost_contact for one in self.standing)
        lifted = sum(not one.run.support.never_lifted for one in self.results)
        said = [f"Rocking: under {lifted} of {len(self.results)} records a foot lifted."]
        if friction:
            needed = f"; the impulses at impacts {max(impulses):.2f}" if impulses else ""
            said.append(
                "No sliding: the feet would have needed a friction coefficient of "
                f"{max(friction):.2f} under the worst record, {np.median(friction):.2f} under half "
                f"of them{needed}."
            )
            rough = sum(one > ROUGHEST for one in friction)
            if rough:
                said.append(
                    f"Under {rough} of them that is more than the {ROUGHEST:g} of rough concrete: "
                    "hold the feet, or let them slide."
                )
            said.append(
                "No bouncing: a foot that stood would have been pulled under "
                f"{jumped or 'none'} of the records."
            )
        body = "nothing bends" if self._held is None else "the column stays elastic"
        said.append(
            "Assumed, and not checked by these motions: rigid ground, motion in one plane, no "
            f"vertical shaking; {body}; an impact loses the energy that its law says."
        )
        vertical = [one.run.motion.name for one in self.results if one.run.motion.is_vertical]
        if vertical:
            said.append(f"Vertical components shake it horizontally: {'; '.join(vertical)}.")
        gains = [one.run.impacts.energy_gains for one in self.results]
        if gaining := [of_run for of_run in gains if len(of_run)]:
            said.append(
                f"Impacts gained energy under {len(gaining)} of {len(gains)} records: "
                f"{sum(map(len, gaining))} impacts, {digits(sum(map(sum, gaining)))} J in all."
            )
        if self._held is not None and self._held.rocking == self.structure:  # no tendon helps
            pull = max(
                -one.fixed_run.extremes(f"{foot}_reaction").minimum
                for one in self.results if one.fixed_run for foot in ("left", "right")
            )  # fmt: skip
            factor, unit = _force_scale(self.structure)
            said.append(
                f"Fixed base: a foot has to be held down by up to {digits(factor * pull)} {unit}."
            )
        errors = [one.energy_error for one in self.standing]
        if errors:
            said.append(f"Integration: all energy balances close to {max(errors):.1g} or better.")
        return (*said, *(f"Hint: {hint}" for hint in self._hints))

    @property
    def _hints(self) -> tuple[str, ...]:
        """Questions about the structure, and about the motions where none lifted it."""
        strongest = max((one.run for one in self.results), key=lambda run: run.motion.peak)
        stood = strongest.support.never_lifted
        questions = shaking(self.structure, strongest.motion, stood)
        return (*self.structure.hints(), *forces(self.structure), *questions)

    @style.styled
    def figures(self) -> Figure:
        """Draw the worst record as time histories, and the demands of all records.

        Returns
        -------
        matplotlib.figure.Figure
            Figure.
        """
        figure = style.new_figure(7.4, 5.0)
        axes = figure.subplot_mosaic("hh;fd")
        history, force, drift = (axes[place] for place in "hfd")
        _draw_history(history, (self.standing or self.results)[0])
        self._draw_both(force, drift)
        return figure

    @style.styled
    def page(self) -> Figure:
        """Draw all of it on one page of A4.

        Returns
        -------
        matplotlib.figure.Figure
            Figure.
        """
        figure = style.NotebookFigure(figsize=A4, dpi=150)
        write_text = partial(figure.text, parse_math=False)  # names may hold dollars
        write_text(0.07, 0.962, self.title, fontsize=15, weight="bold")
        third = math.ceil(len(self.facts) / 3)
        for i, (name, value) in enumerate(self.facts):
            x, y = 0.07 + 0.3 * (i // third), 0.94 - 0.0145 * (i % third)
            write_text(x, y, name, fontsize=7.5, color="0.4")
            write_text(x + 0.12, y, value, fontsize=7.5)
        top = 0.94 - 0.0145 * third - 0.015
        history = figure.add_axes((0.1, top - 0.14, 0.84, 0.11))
        _draw_history(history, (self.standing or self.results)[0])
        self._draw_both(
            figure.add_axes((0.1, top - 0.33, 0.36, 0.13)),
            figure.add_axes((0.58, top - 0.33, 0.36, 0.13)),
        )
        bottom = _draw_table(write_text, top - 0.395, self.columns, self.rows, len(self.results))
        for heading, sentences in (("Results", self.findings), (_ASSUMPTIONS, self.assumptions)):
            write_text(0.07, bottom, heading, fontsize=9, weight="bold", va="top")
            bottom -= 0.017
            for sentence in sentences:
                lines = textwrap.wrap(sentence, 125)
                write_text(0.07, bottom, "\n".join(lines), fontsize=7.4, va="top")
                bottom -= 0.0118 * len(lines) + 0.002
            bottom -= 0.006
        return figure

    def _draw_both(self, force: Axes, drift: Axes) -> None:
        n = len(self.results)
        factor, unit = _force_scale(self.structure)
        _draw_demands(force, self.standing, n, "base_shear", factor, f"base shear [{unit}]")
        _draw_demands(drift, self.standing, n, "displacement", 1e3, "displacement [mm]")

    def html(self) -> str:
        """Same report as a page that needs no other file.

        Returns
        -------
        str
            Text of the page.
        """
        picture = page.image(
            self.figures(),
            "displacement under the worst record, base shear and displacement under all records",
        )
        shown = html.escape(_shown(len(self.rows), len(self.results)))
        body = (
            f"{page.facts(self.facts)}{picture}<h2>Results</h2>{page.bullets(self.findings)}"
            f"{page.wide(page.table(self.columns, self.rows))}<p>{shown}</p>"
            f"<h2>{_ASSUMPTIONS}</h2>{page.bullets(self.assumptions)}"
        )
        return page.whole(self.title, body)

    def write(self, path: str | Path) -> None:
        """Write the report into a file.

        Parameters
        ----------
        path : path_like
            File whose name ends in .html or .pdf.

        Raises
        ------
        ValueError
            For another name.
        """
        path = Path(path)
        check_name(path)
        check_target(path)
        if path.suffix.lower() == ".pdf":
            style.save_figure(self.page(), path)
        else:
            write(path, self.html())


def facts_of(
    structure: Structure, impact: ImpactLaw | None, slope: float = 0.0
) -> tuple[tuple[str, str], ...]:
    """Parameters of a structure, the acceleration that lifts it and its impact law."""
    m, values = structure.module, structure.parameters()
    words = getattr(structure, "arguments", {})
    rows = {
        words.get(name, name): (values[name], unit)
        for name, unit in zip(m.PARAMETERS, m.PARAMETER_UNITS, strict=True)
        if name in values
    }
    full = getattr(structure, "full_height", None)
    if full is not None and "half_height" in rows:  # as the block was given
        base, centroid = rows.pop("half_width")[0], rows.pop("half_height")
        rows = {"width": (2 * base, "m"), "height": (full, "m"), "centroid height": centroid} | rows
    facts = [
        (name.replace("_", " "), f"{digits(value, 5)} {unit}".removesuffix(" -"))
        for name, (value, unit) in rows.items()
    ]
    threshold = min(uplift_accelerations(structure, slope) or (math.inf,))
    if math.isfinite(threshold):
        facts.append(("a foot lifts from", f"{threshold / STANDARD_GRAVITY:.3g} g"))
    facts += _angles(structure, slope)
    if structure.has_impacts:
        facts.append(("law of impact", structure.describe_impact(impact)))
    return tuple(facts)


def check_name(path: Path) -> None:
    """Raise ValueError for a name that says no format."""
    if path.suffix.lower() not in FILES:
        raise InputError("path", path).give(f"a name that ends in {' or '.join(FILES)}")


@explained.calls()
def design_report(
    structure: Structure,
    motions: Sequence[GroundMotion],
    impact: ImpactLaw | None = None,
    duration: float | None = None,
) -> DesignReport:
    """Simulate a structure on rigid ground under each of the motions, and on a fixed base.

    A rigid structure has no fixed base and stands alone.

    Parameters
    ----------
    structure : Structure
        Structure with feet on rigid ground.
    motions : sequence of GroundMotion
        Ground motions.
    impact : ImpactLaw, optional
        Impact law, as for `simulate`.
    duration : float, optional
        Duration [s], as for `simulate`.

    Returns
    -------
    DesignReport
        Report.

    Raises
    ------
    ValueError
        For no motions and for a structure without feet on rigid ground.
    TypeError
        For anything but a structure or ground motions.
    """
    check_drawn("structure", structure, Structure)
    if isinstance(motions, GroundMotion):
        raise InputTypeError("motions").wrong("is one motion: give a list of motions, [motion]")
    if not motions:
        raise InputError("motions").says("a report needs a motion: give one or more, as a list")
    if "left_uplift" not in structure.module.KINEMATICS or structure.module.STATE_UNITS[0] == "-":
        raise InputError("structure").says(
            f"{structure.model} has no feet that lift, in metres: there is no report of it; take a "
            "RigidBlock, LumpedMassStructure, FlexibleStructure or a wall"
        )
    try:
        held = structure.fixed_base()
    except ValueError:  # rigid
        held = None
    return DesignReport(
        structure,
        impact,
        tuple(
            UnderRecord(
                simulate(structure, motion, impact=impact, duration=duration),
                None if held is None else simulate(held, motion, duration=duration),
            )
            for motion in motions
        ),
    )


# -- the parts of the page -----------------------------------------------------------------------


def _draw_history(ax: Axes, one: UnderRecord) -> None:
    """Displacement of the load point, rocking and on the fixed base."""
    if one.fixed_run is not None:
        ax.plot(
            one.fixed_run.t, 1e3 * one.fixed_run["displacement"], color=style.LINES[1], lw=0.8,
            label="fixed base",
        )  # fmt: skip
    ax.plot(one.run.t, 1e3 * one.run["displacement"], color=style.LINES[0], label="rocking")
    style.mark_overturning(ax, one.run, 1e3 * one.run["displacement"], color=style.LINES[0])
    ax.set(xlabel="time [s]", ylabel="displacement [mm]", xlim=(0, one.run.t[-1]))
    ax.set_title(
        f"largest displacement: {style.plain(_short(one.run.motion.name, 80))}",
        loc="left",
        fontsize=8.5,
        pad=18,  # above the legend
    )
    style.legend_above(ax)


def _draw_demands(
    ax: Axes, results: Sequence[UnderRecord], total: int, name: str, factor: float, what: str
) -> None:
    """The part of the records that stay below a demand; those that fell stay below none."""
    both = {
        "fixed base": [getattr(one.fixed, name) for one in results if one.fixed is not None],
        "rocking": [getattr(one.rocking, name) for one in results],
    }
    for (label, sizes), color in zip(both.items(), (style.LINES[1], style.LINES[0]), strict=True):
        if sizes:
            number = total if label == "rocking" else len(sizes)
            values = factor * np.sort(sizes)
            ax.step(
                [0.0, *values], [0.0, *(np.arange(1, len(values) + 1) / number)], where="post",
                color=color, label=label,
            )  # fmt: skip
            ax.plot(values, np.arange(1, len(values) + 1) / number, ".", ms=3.5, color=color)
    ax.set(xlabel=what, ylabel="fraction of the records", xlim=(0, None), ylim=(0, 1.03))
    style.legend_above(ax)


def _draw_table(
    write_text: Callable[..., object], top: float, columns: Row, rows: Sequence[Row], number: int
) -> float:
    """The table as text from `top` downwards; returns where it ends."""
    places = (0.415, 0.49, 0.545, 0.6, 0.685, 0.745, 0.8, 0.865, 0.935)
    heads = [cell.replace(" ", "\n", 1) for cell in columns]
    y = top
    for (name, *cells), weight in ((heads, "bold"), *((row, "normal") for row in rows)):
        name = _short(name, 64)
        size = 7.2 * min(1.0, 42 / len(name))  # a long name in smaller letters
        write_text(0.07, y, name, fontsize=size, weight=weight)
        for x, cell in zip(places, cells, strict=True):
            write_text(x, y, cell, fontsize=7.2, ha="right", weight=weight)
        y -= 0.0175 if weight == "bold" else 0.0132
    write_text(0.07, y, _shown(len(rows), number), fontsize=7.2, color="0.4")
    return y - 0.016


# -- words ---------------------------------------------------------------------------------------


def _shown(rows: int, number: int) -> str:
    less = number - rows
    rest = f" {less} of smaller displacement are not listed." if less else ""
    return (
        "Ratios are those of rocking to the fixed base; friction is the coefficient that not "
        f"sliding needed.{rest}"
    )


def _spread(values: Sequence[float], unit: str) -> str:
    """Median and range of some values."""
    unit = f" {unit}" if unit else ""
    if len(values) == 1:
        return f"{digits(values[0])}{unit}."
    median, least, largest = map(digits, (np.median(values), min(values), max(values)))
    return f"median {median}{unit}, from {least} to {largest}{unit}."


def _angles(structure: Structure, slope: float) -> list[tuple[str, str]]:
    """Overturning angles, one where both sides have the same."""
    angles = overturning_angles(structure, slope)
    if angles is None or not np.isfinite(angles).all():
        return []
    if np.isclose(*angles, rtol=1e-9):
        return [("overturning angle", with_degrees(angles[0], "rad"))]
    sides = zip(("left", "right"), angles, strict=True)
    return [(f"overturns {side} at", with_degrees(angle, "rad")) for side, angle in sides]


def _force_scale(structure: Structure) -> tuple[float, str]:
    """Factor and unit of forces, which are those of one kilogram where no mass was given."""
    return (1.0, "N/kg") if default_masses(structure) else (1e-3, "kN")


def _short(name: str, most: int) -> str:
    """A name of so many letters, without its middle if it is long; the component is at its end."""
    name = name or "a ground motion"
    head = name[: most - 24].rstrip(" ,")
    return name if len(name) <= most else f"{head} … {name[-21:].lstrip(' ,')}"
