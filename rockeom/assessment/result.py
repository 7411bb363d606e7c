"""The answer to "will it overturn?": words, numbers, a figure and a page."""

from __future__ import annotations

import re
from dataclasses import dataclass
from functools import cached_property
from html import escape
from pathlib import Path
from textwrap import fill

import numpy as np
from matplotlib.figure import Figure

from rockeom.analysis.risk.fragility import Estimate
from rockeom.analysis.sweeps import FALLS
from rockeom.assessment.figure import draw
from rockeom.assessment.remedies import Remedy
from rockeom.assessment.statics import Statics
from rockeom.assessment.trials import (
    QUIET,
    AtIntensity,
    Conditions,
    Trials,
    UnderRecord,
    can_slide,
    simulated,
)
from rockeom.drawing import page
from rockeom.files import check_target, write
from rockeom.motion import STANDARD_GRAVITY
from rockeom.numbers import explained
from rockeom.numbers.arguments import require
from rockeom.plots.design_report import facts_of
from rockeom.simulation.plausible import LIKE_G, default_masses
from rockeom.simulation.response import Response
from rockeom.structures.base import Structure

FEW = 20
"""Number of stations below which intervals of the curve are too short."""
_UNIT = re.compile(r"(?<=\d) (?=(?:g|m|mm|k?N|%)(?![a-z]))")
"""The blank between a number and its unit."""
_WIDTH = 78
"""Letters in a line of the summary."""
_SHOWN = 60
"""Records that the page lists."""


@explained.attributes(fragility="trials.fragility", pga="pga_at(probability)")
@explained.calls()
@dataclass(frozen=True, eq=False)
class Assessment:
    """Results of `rockeom.assess`; print it, or look at `plot()`, or `save("page.html")`.

    structure, conditions : the arguments; level : of all intervals of confidence.
    statics : uplift, sliding and restraint of the structure at rest.
    records : each record as it was recorded, and its effect.
    trials : outcomes at each intensity, with `trials.fragility`, the curve, if there is one.
    remedies : changed structures, with their statics and trials.
    furthest : response to the record that turned it furthest without overturning it, for the
        assumptions; None without records or where all overturn.
    left_out : names of vertical components, which were not used.
    """

    structure: Structure
    conditions: Conditions
    level: float
    statics: Statics
    records: tuple[UnderRecord, ...]
    trials: Trials
    remedies: tuple[Remedy, ...]
    furthest: Response | None
    left_out: tuple[str, ...]

    # -- numbers

    def pga_at(self, probability: float) -> Estimate | None:
        """PGA that overturns with a probability [m/s2], and its interval; None without a curve.

        Raises ValueError for a probability outside 0 to 1.
        """
        require(0.0 < probability < 1.0, "pga_at", "probability", probability, "as 0.05 for 5 %")
        return _pga(self.trials, probability, self.level)

    @property
    def slides_first(self) -> bool | None:
        """Whether it slides before it rocks; None without a coefficient of friction."""
        friction = self.conditions.friction
        return None if friction is None else friction < self.statics.friction_to_rock

    # -- words

    @property
    def title(self) -> str:
        return f"Will it overturn? {type(self.structure).__name__} under {_records(self._n)}"

    @cached_property
    def verdict(self) -> str:
        """The answer in a sentence or two."""
        slides = "It slides before it rocks. " if self.slides_first else ""
        rows = self.trials.intensities
        if not rows:
            return f"{slides}Not judged under records: there is no horizontal one."
        top = rows[-1]
        fallen = [row for row in rows if row.overturned]
        if not fallen:
            return slides + self._none_overturns(top)
        first = fallen[0]
        if all(row.overturned == row.number for row in rows):
            return f"{slides}Yes: at each intensity, from {_g(first.pga)} on, every record does it."
        return (
            f"{slides}It may: {first.overturned} of {_records(first.number)} overturn"
            f"{'s' * (first.overturned == 1)} it at a PGA of {_g(first.pga)}"
            + (f", {top.overturned} of {top.number} at {_g(top.pga)}." if top != first else ".")
            + self._of_curve()
        )

    def _of_curve(self) -> str:
        found = [(p, self.pga_at(p)) for p in (0.05, 0.5)]
        said = [f"{_percent(p)} at {_g(one.value, 2)}" for p, one in found if one is not None]
        return f" The probability reaches {' and '.join(said)}." if said else ""

    def _none_overturns(self, top: AtIntensity) -> str:
        if not any(row.lifted for row in self.trials.intensities):
            said = (
                f"No: up to a PGA of {_g(top.pga)} none of {_records(self._n)} even lifts a foot."
            )
            if LIKE_G[0] <= top.pga <= min(LIKE_G[1], self._threshold):
                said += f' If {top.pga:.3g} was meant in g, write "{top.pga:.3g} g".'
            return said
        return (
            f"Not under these records: none of {self._n} overturns it up to a PGA of "
            f"{_g(top.pga)}, where the probability is below {_percent(top.upper)}."
        )

    @cached_property
    def findings(self) -> tuple[str, ...]:
        """The results in sentences."""
        threshold = self.statics.uplift_acceleration
        said = [
            f"Uplift: a foot lifts from {_g(threshold)} ({threshold:.3g} m/s2) on, the static "
            "threshold.",
            self._of_sliding(),
        ]
        if self.records:
            lift = sum(one.lifts for one in self.records)
            fall = sum(one.outcome == FALLS for one in self.records)
            lifts = f"{_count(lift)} of {_records(self._n)} lift{'s' * (lift <= 1)} a foot"
            falls = f", {_count(fall)} overturn{'s' * (fall <= 1)} it" if lift else ""
            said.append(f"As recorded: {lifts}{falls}.")
        said += [self._of_probability(p) for p in (0.05, 0.5)] if self.trials.fragility else []
        if self.trials.no_curve:
            said.append(f"Probability against intensity: no curve, {self.trials.no_curve}.")
        return tuple(said)

    def _of_sliding(self) -> str:
        needed, friction = self.statics.friction_to_rock, self.conditions.friction
        if friction is None:
            return (
                "Sliding: not judged, since no coefficient of friction was given; below "
                f"{needed:.3g} it slides before it rocks."
            )
        if self.slides_first:
            slides = _g(self.statics.sliding_acceleration(friction))
            said = (
                f"Sliding: it slides first, from {slides} on, since its friction, {friction:g}, is "
                f"below {needed:.3g}."
            )
        else:
            said = (
                f"Sliding: it rocks first, since its friction, {friction:g}, is not below "
                f"{needed:.3g}."
            )
        slips = [one.slip for one in self.records if np.isfinite(one.slip)]
        if slips:
            moved = f"ends up to {_mm(max(slips))} from its place"
            said += f" As recorded it {moved if max(slips) > 5e-4 else 'stays in its place'}."
        return said

    def _of_probability(self, probability: float) -> str:
        found = self.pga_at(probability)
        assert found is not None
        first, last = self.conditions.levels[[0, -1]]
        beyond = ", below those tried" if found.value < first else ""
        beyond += ", above those tried" if found.value > last else ""
        interval = f"{_g(found.lower, 2)} to {_g(found.upper, 2)}"
        return (
            f"Probability of overturning {_percent(probability)}: at a PGA of {_g(found.value, 2)}"
            f"{beyond} ({_percent(self.level)} interval {interval})."
        )

    @cached_property
    def helps(self) -> tuple[str, ...]:
        """Changes that help, each with its figure."""
        said = []
        for one in self.remedies:
            lifts = f"{_g(one.statics.uplift_acceleration)} instead of {_g(self._threshold)}"
            said.append(
                f"{one.change[0].upper()}{one.change[1:]}: a foot lifts from {lifts} on"
                f"{self._gain(one.trials)}."
            )
        if restraint := self._of_restraint():
            said.append(restraint)
        return tuple(said)

    def _gain(self, changed: Trials) -> str:
        """The effect of a change on overturning."""
        mine, other = self.pga_at(0.05), _pga(changed, 0.05, self.level)
        if mine is not None and other is not None:
            gained = other.value > mine.value
            effect = f"5 % overturn at {_g(other.value, 2)} instead of {_g(mine.value, 2)}"
        elif self.trials.intensities and self.trials.intensities[-1].overturned:
            before, after = self.trials.intensities[-1], changed.intensities[-1]
            gained = after.overturned < before.overturned
            effect = (
                f"{_count(after.overturned)} of {_records(after.number)} overturn"
                f"{'s' * (after.overturned <= 1)} it at {_g(after.pga)} instead of "
                f"{before.overturned}"
            )
        else:
            return ""
        return f"; {effect}" + ("" if gained else ", no gain under these records")

    def _of_restraint(self) -> str:
        most = self.conditions.levels[-1]
        held = self.statics.hold_down(most)
        if not held:
            return ""
        height = 2 * self.statics.centroid_height
        pushed = self.statics.restraint(most, height)
        return (
            f"A strap or an anchor: a horizontal force of {self._force(pushed)} "
            f"{height:.3g} m above the ground, or {self._force(held)} of hold-down at each edge, "
            f"keeps both feet down up to {_g(most)}, statically. The height is twice that of the "
            "centroid; further down the force is larger in proportion."
        )

    def _force(self, force: float) -> str:
        part = f"{_percent(force / self.statics.weight)} of the weight"
        return part if default_masses(self.structure) else f"{_newton(force)} ({part})"

    @cached_property
    def assumptions(self) -> tuple[str, ...]:
        """Assumptions, and whether they held."""
        said = [*self._of_feet()]
        if law := self.structure.describe_impact(self.conditions.impact):
            law = "feet land without bouncing" if self._slides else law
            said.append(f"Impacts: {law}. Not checked.")
        if self._n:
            factors = [
                level / one.peak
                for level in self.conditions.levels[[0, -1]].tolist()
                for one in self.records
            ]
            said.append(
                f"Records: scaled to each PGA, by {min(factors):.2g} to {max(factors):.2g}, which "
                f"keeps their frequencies. {QUIET:g} s of quiet follow each."
            )
        if self.left_out:
            said.append(
                f"Vertical components were left out: {'; '.join(self.left_out)}. Those of "
                "recordings count, see MotionSet.recordings()."
            )
        if self.trials.unanswered:
            said.append(
                f"{self.trials.unanswered} motions had no end that is an answer, and do not count."
            )
        shaken = sum(motion.vertical is not None for motion in self.conditions.motions)
        if shaken:
            said.append(f"Vertical shaking: that of {shaken} of {_records(self._n)}, scaled along.")
        still = "" if shaken else "no vertical shaking, "
        said.append(
            f"Not checked: rigid ground, motion in one plane, {still}feet that keep their edges."
        )
        said += self._of_intervals()
        return tuple(said)

    def _of_feet(self) -> tuple[str, ...]:
        if self._slides:
            return (f"Sliding: simulated, with a friction of {self.conditions.friction:g}.",)
        if self.furthest is None:
            return ("No sliding: the simulations hold the feet.",)
        support = self.furthest.support
        needed = max(support.friction_demand, support.impact_friction_demand)
        friction = self.conditions.friction
        held = (
            "" if friction is None else " It held." if needed <= friction else " It did not hold."
        )
        pulled = "was pulled: it would have jumped" if support.lost_contact else "was pulled"
        who = "a" if support.lost_contact else "no"
        return (
            "No sliding: the simulations hold the feet. Under the record that turned it furthest "
            f"without overturning that needed a friction of {needed:.2g}.{held}",
            f"No bouncing: under that record {who} foot that stood {pulled}.",
        )

    def _of_intervals(self) -> tuple[str, ...]:
        level, n = _percent(self.level), len(set(self.conditions.stations))
        said = [f"Intervals of fractions: {level}, Clopper and Pearson."]
        if self.trials.fragility is not None:
            said.append(
                "Curve: lognormal, maximum likelihood. Its intervals: "
                f"{level}, delta method, with a covariance by record (Liang and Zeger), since the "
                "same records are scaled to each PGA"
                + (f"; those of {n} stations are few, and the intervals too short." if n < FEW
                   else ".")
            )  # fmt: skip
        return tuple(said)

    @property
    def _slides(self) -> bool:
        return can_slide(self.structure, self.conditions)

    @property
    def _moves(self) -> bool:
        """Whether it ends anywhere else than it began, by a millimetre."""
        slips = [row.slip for row in self.trials.intensities]
        return any(slip > 5e-4 for slip in [*slips, *(one.slip for one in self.records)])

    @property
    def _n(self) -> int:
        return len(self.conditions.motions)

    @property
    def _threshold(self) -> float:
        return self.statics.uplift_acceleration

    def summary(self) -> str:
        """All of it in lines of text."""
        rows = [
            f"PGA {_g(row.pga)}: {row.overturned} of {row.number}, "
            f"{_percent(row.overturned / max(row.number, 1))} "
            f"({_percent(row.lower)} to {_percent(row.upper)})"
            + (f", it ends up to {_mm(row.slip)} from its place" if self._moves else "")
            for row in self.trials.intensities
        ]
        blocks = {
            "Results": self.findings,
            "Overturning against intensity": rows,
            "Measures that help": self.helps,
            "Assumptions": self.assumptions,
        }
        lines = [self.title, fill(self.verdict, _WIDTH)]
        for name, sentences in blocks.items():
            lines += ["", name] if sentences else []
            lines += [
                fill(one, _WIDTH, initial_indent="  ", subsequent_indent="    ")
                for one in sentences
            ]
        return "\n".join(lines)

    def __str__(self) -> str:
        return self.summary()

    def __repr__(self) -> str:
        return f"Assessment({self.verdict!r})"

    # -- a figure and a page

    def plot(self) -> Figure:
        """Probability of overturning against PGA, and the largest rotation under each record."""
        return draw(self.trials, self.remedies, self.records, self._threshold, self.level)

    def html(self) -> str:
        """A page that needs no other file."""
        return page.whole(self.title, self._body())

    def save(self, path: str | Path) -> None:
        """Write the page into a file whose name ends in .html.

        Raises ValueError for another name, and OSError where it cannot be written.
        """
        check_page(path)
        write(path, self.html())

    def _repr_html_(self) -> str:
        title = f"<div><strong>{escape(self.title)}</strong></div>"
        return f'<div class="rockeom">{title}{self._body()}</div>'

    def _body(self) -> str:
        shaken = simulated(self.structure, self.conditions)
        facts = facts_of(shaken, self.conditions.impact)
        parts = [
            f'<p class="verdict">{escape(self.verdict)}</p>',
            page.bullets(self.findings),
            page.image(self.plot(), "probability of overturning against peak ground acceleration")
            if self._n
            else "",
            "<h2>Overturning against intensity</h2>" + page.wide(self._intensity_table())
            if self._n
            else "",
            f"<h2>Measures that help</h2>{page.bullets(self.helps)}",
            f"<h2>Assumptions, and whether they held</h2>{page.bullets(self.assumptions)}",
            f"<h2>Structure</h2>{page.facts(facts)}",
            f"<h2>Each record as it was recorded</h2>{page.wide(self._record_table())}"
            if self._n
            else "",
        ]
        return _UNIT.sub("&nbsp;", "".join(parts))

    def _intensity_table(self) -> str:
        curve, level = self.trials.fragility, _percent(self.level)
        heads = (
            *("PGA", "lift a foot", "overturn", "fraction", f"{level} interval", "curve"),
            *("hold-down of an edge", *(["ends from its place"] if self._moves else [])),
        )
        rows = [
            (
                _g(row.pga),
                f"{row.lifted} of {row.number}",
                f"{row.overturned} of {row.number}",
                _percent(row.overturned / max(row.number, 1)),
                f"{_percent(row.lower)} to {_percent(row.upper)}",
                "–" if curve is None else _percent(float(curve.probability(row.pga))),
                self._force(force) if (force := self.statics.hold_down(row.pga)) else "–",
                *([_mm(row.slip)] if self._moves else []),
            )
            for row in self.trials.intensities
        ]
        return page.table(heads, rows)

    def _record_table(self) -> str:
        """Records that overturn it first, then those that turn it furthest."""
        heads = ("record", "PGA", "outcome", "largest rotation", "of the overturning angle")
        order = sorted(self.records, key=lambda one: (one.outcome != FALLS, -one.rotation))
        rows = [
            (
                one.name,
                _g(one.peak),
                one.outcome if one.lifts else "no foot lifts",
                "–" if one.outcome == FALLS else f"{np.degrees(one.rotation):.1f}°",
                "–" if one.outcome == FALLS or np.isnan(one.part) else _percent(one.part),
                *([_mm(one.slip)] if self._moves else []),
            )
            for one in order
        ]
        rest = f"<p>{len(rows) - _SHOWN} more are not listed.</p>" if len(rows) > _SHOWN else ""
        slip = ("ends from its place",) if self._moves else ()
        return page.table((*heads, *slip), rows[:_SHOWN]) + rest


def check_page(path: str | Path) -> None:
    """Raise ValueError for a name that is not that of a page, OSError where none can be written."""
    if Path(path).suffix.lower() != ".html":
        raise ValueError(f"{path}: an assessment is a page: end the name in .html")
    check_target(path)


def _pga(trials: Trials, probability: float, level: float) -> Estimate | None:
    curve = trials.fragility
    return None if curve is None else curve.quantile(probability, level)


def _g(acceleration: float, digits: int = 3) -> str:
    return f"{acceleration / STANDARD_GRAVITY:.{digits}g} g"


def _percent(part: float) -> str:
    percent = 100 * part
    whole = percent >= 10 or abs(percent - round(percent)) < 0.05
    return f"{percent:.{0 if whole else 1}f} %"


def _mm(length: float) -> str:
    return "–" if np.isnan(length) else f"{1e3 * length:.0f} mm"


def _newton(force: float) -> str:
    return f"{force / 1e3:.3g} kN" if force >= 1e3 else f"{force:.3g} N"


def _count(n: int) -> str:
    return str(n) if n else "none"


def _records(n: int) -> str:
    return f"{n} record{'s' * (n != 1)}"
