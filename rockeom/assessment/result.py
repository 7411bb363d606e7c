"""The answer to "will it overturn?": words, numbers, a figure and a page."""

import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from functools import cached_property
from html import escape
from pathlib import Path
from textwrap import fill

import numpy as np
from matplotlib.figure import Figure

from rockeom.analysis.risk.fragility import Estimate
from rockeom.analysis.standards.check import Check
from rockeom.assessment.azimuths import (
    AtAzimuth,
    alone,
    by_azimuth,
    in_degrees,
    in_words as of_azimuths,
)
from rockeom.assessment.comparison import HOW_TO_READ, rows_of, sources_of
from rockeom.assessment.figure import draw
from rockeom.assessment.plane import InPlane, in_words as of_plane
from rockeom.assessment.remedies import Remedy
from rockeom.assessment.statics import Load, Statics
from rockeom.assessment.ties import StrapTrial, TieAnswer, in_words, strap_trial
from rockeom.assessment.trials import (
    OF_TAILS,
    QUIET,
    AtIntensity,
    Conditions,
    Trials,
    UnderRecord,
    can_slide,
    case_of,
    fitted,
    height_of,
    pga_of,
    simulated,
)
from rockeom.assessment.words import count, in_g, in_mm, newton, percent, plural
from rockeom.drawing import page
from rockeom.files import check_target, write
from rockeom.numbers import explained
from rockeom.numbers.checks import InputError, require
from rockeom.plots.design_report import facts_of
from rockeom.simulation.plausible import LIKE_G, default_masses, forces, shaking
from rockeom.simulation.response import Response
from rockeom.simulation.simulate import simulate
from rockeom.structures import plausible
from rockeom.structures.base import Structure

_UNIT = re.compile(r"(?<=\d) (?=(?:g|m|mm|k?N|%)(?![a-z]))")
"""The blank between a number and its unit."""
_WIDTH = 78
"""Letters in a line of the summary."""
_SHOWN = 60
"""Records that the page lists."""
_BY_GROUP = (
    "from below of the recordings all of whose motions overturn it, from above of those of which "
    "any does"
)
_BY_PARTS = "of recordings that count by the part of the azimuths at which they overturn it"
_STILL = 5e-4
"""Distance below which a structure stays in its place [m]."""


UNITS_CHECKED = "units_checked=True"
"""The argument of `assess` by which the caller vouches for the units."""


@explained.attributes(fragility="trials.fragility", pga="pga_at(probability)")
@explained.calls()
@dataclass(frozen=True, eq=False)
class Assessment:
    """Results of `rockeom.assess`; print it, or look at ``plot()``, or ``save("page.html")``.

    Parameters
    ----------
    structure : Structure
        Structure of the assessment.
    conditions : Conditions
        Friction, impact law and other conditions.
    level : float
        Level of all intervals of confidence.
    statics : Statics
        Uplift, sliding and restraint of the structure at rest.
    records : tuple of UnderRecord
        Each record as it was recorded, and its effect.
    trials : Trials
        Outcomes at each intensity, with ``trials.fragility``, the curve, if there is one.
    remedies : tuple of Remedy
        Changed structures, with their statics and trials.
    units_checked : bool, optional
        Whether there is a verdict though a unit is in doubt.
    checks : tuple of tuple of Check, optional
        Checks of codes at each PGA (m, k).
    ties : tuple of TieAnswer, optional
        Ties that may break, and how often they do at each PGA.
    plane : InPlane, optional
        Planar answer for a body in space.
    """

    structure: Structure
    conditions: Conditions
    level: float
    statics: Statics
    records: tuple[UnderRecord, ...]
    trials: Trials
    remedies: tuple[Remedy, ...]
    units_checked: bool = False
    checks: tuple[tuple[Check, ...], ...] = ()
    ties: tuple[TieAnswer, ...] = ()
    plane: InPlane | None = None

    # -- numbers

    def pga_at(self, probability: float) -> Estimate | None:
        """PGA that overturns with a probability, and its interval.

        Parameters
        ----------
        probability : float
            Probability, between 0 and 1.

        Returns
        -------
        Estimate or None
            PGA with its bounds [m/s2]. None without a curve, with less than eight recordings (six
            for a probability of 0.5), and where the interval is wider than a factor of ten.

        Raises
        ------
        ValueError
            For a probability outside 0 to 1.
        """
        require(0.0 < probability < 1.0, "pga_at", "probability", probability, "as 0.05 for 5 %")
        return pga_of(self.trials.fragility, probability, self.level)

    @cached_property
    def azimuths(self) -> tuple[AtAzimuth, ...]:
        """Outcomes at each azimuth of a structure in space."""
        return by_azimuth(self.trials, self.conditions, self.level)

    @property
    def slides_first(self) -> bool | None:
        """Whether it slides before it rocks, to both sides; None without a friction."""
        friction = self.conditions.friction
        return None if friction is None else all(self.statics.slides_first(friction))

    @cached_property
    def furthest(self) -> Response | None:
        """Response to the record that turned it furthest without overturning it.

        None where none stands, and where sliding is simulated.
        """
        standing = [i for i, one in enumerate(self.records) if one.answered and not one.fell]
        if not standing or self._slides:
            return None
        furthest = max(standing, key=lambda i: self.records[i].rotation)
        motion, turns = self.conditions.motions[furthest], self.conditions.azimuths or (0.0,)
        turn = turns[furthest % len(turns)]
        return simulate(case_of(self.structure, motion, self.conditions, turn))

    # -- questions

    @cached_property
    def units_in_doubt(self) -> tuple[str, ...]:
        """Questions about lengths, gravity, and intensities that were given without a unit."""
        m, p = self.structure.module, self.structure.vector
        top, pga = float(self.conditions.levels[-1]), self.conditions.pga_given
        like_g = LIKE_G[0] <= top <= min(LIKE_G[1], self._threshold)
        said = (f'The highest PGA is {top:.3g} m/s2: was it meant in g? Then write "{top:.3g} g".',)
        without_unit = pga is not None and np.asarray(pga).dtype.kind != "U"
        return (*plausible.size(m, p), *plausible.gravity(m, p), *said * (like_g and without_unit))

    @cached_property
    def records_in_doubt(self) -> tuple[str, ...]:
        """Questions about the accelerations of the records."""
        horizontal = [one.horizontal[0] for one in self.conditions.motions]
        strongest = max(horizontal, key=lambda one: one.peak, default=None)
        stood = not any(one.lifts for one in self.records)
        return () if strongest is None else shaking(self.structure, strongest, stood)

    @property
    def questions(self) -> tuple[str, ...]:
        """Sentences on values to check before the answer is believed."""
        friction, vertical = self.conditions.friction, self.conditions.left_out
        left_out = (
            f"Vertical components are left out: {'; '.join(vertical)}. Those of whole "
            "recordings, with all components, shake along.",
        )
        both = (*self.units_in_doubt, *self.records_in_doubt, *self.structure.hints())
        rough = plausible.friction(0.0 if friction is None else friction)
        return (*dict.fromkeys(both), *rough, *left_out[: len(vertical)], *forces(self.structure))

    # -- words

    @property
    def title(self) -> str:
        """Question of the assessment, with the structure and the number of records."""
        n = self._n // (2 if self.conditions.both_ways else len(self.conditions.azimuths) or 1)
        slope = np.degrees(self.conditions.slope)
        where = f" on a slope of {slope:.3g} degrees" if slope else ""
        who = type(self.structure).__name__
        return f"Will it overturn? {who}{where} under {plural(n, 'record')}"

    @cached_property
    def verdict(self) -> str:
        """The answer in a few sentences, those on the records as they are first."""
        if self._in_doubt:
            return f"No verdict: a unit is in doubt. Answer the questions, or give {UNITS_CHECKED}."
        return " ".join(filter(None, (
            self._as_recorded(),
            "It slides before it rocks." if self.slides_first else "",
            self._scaled(),
            self._of_bodies(),
            "Each record shakes it in both directions." * self.conditions.both_ways,
            self._of_turns(),
        )))  # fmt: skip

    def _of_turns(self) -> str:
        if one := alone(self.structure, self.conditions):
            return f"It is judged at one azimuth, {one}, alone: others may overturn it sooner."
        if len(turns := self.conditions.azimuths) < 2:
            return ""
        between = f"from {in_degrees(min(turns))} to {in_degrees(max(turns))}"
        return f"Each record shakes it at {len(turns)} azimuths, {between}."

    def _as_recorded(self) -> str:
        answered = [one for one in self.records if one.answered]
        if not answered or self.records_in_doubt:
            return ""
        lift = sum(one.lifts for one in answered)
        of = f"{count(lift)} of {self._motions(len(answered))}"
        said = f"As recorded, {of} lift{_s(lift)} {self._foot}"
        if not lift:
            return f"{said}."
        standing = [one.part for one in answered if not one.fell]
        fell = len(answered) - len(standing)
        said += f", {count(fell)} overturn{_s(fell)} it"
        if standing and np.isfinite(standing).all():
            said += f"; the largest {self._ratio} {'of the others ' * (fell > 0)}is "
            said += f"{max(standing):.2g}"
        return f"{said}."

    def _scaled(self) -> str:
        """The answer on the records as scaled; it counts motions with an answer."""
        if not self._n:
            return "Not judged under records: there is no horizontal one."
        rows = [row for row in self.trials.intensities if row.number]
        if not rows:
            return f"Not judged when scaled: none of {self.trials.fell.size} motions has an answer."
        top, fallen = rows[-1], [row for row in rows if row.overturned]
        if all(row.overturned == row.number for row in rows):
            every = "every record" + " with an answer" * bool(self.trials.without_answer)
            return f"Yes: scaled to each PGA, from {in_g(rows[0].pga)} on, {every} does it."
        if fallen:
            first = fallen[0]
            of_top = f", {top.overturned} of {top.number} at {in_g(top.pga)}" * (top != first)
            return (
                f"Scaled it may: {first.overturned} of {self._motions(first.number)} "
                f"overturn{_s(first.overturned)} it at a PGA of {in_g(first.pga)}{of_top}."
                f"{self._of_curve()}"
            )
        most, one = f"up to a PGA of {in_g(top.pga)}", alone(self.structure, self.conditions)
        at = f" at {one}" if one else ""
        if not any(row.lifted for row in rows):
            lifts = f"none of {self._motions(top.number)} even lifts"
            return (
                f"No: {most} {lifts if top.number > 1 else 'it does not even lift'} {self._foot}."
            )
        return (
            f"Not under these records{at}: none of {top.number} overturns it {most}, where the "
            f"{percent(self.level)} interval of the probability is {_interval(top)}."
        )

    def _of_curve(self) -> str:
        estimates = [(p, self.pga_at(p)) for p in (0.05, 0.5)]
        said = [f"{percent(p)} at {in_g(one.value, 2)}" for p, one in estimates if one is not None]
        return f" The probability reaches {' and '.join(said)}." if said else ""

    def _of_bodies(self) -> str:
        """Which body fell, where there are several."""
        if not any(self.trials.bodies):
            return ""
        which = ", ".join(f"{n} of the {body} one" for body, n in self.trials.bodies.items())
        return f"A fall of any block counts, of the scaled motions {which}."

    @cached_property
    def findings(self) -> tuple[str, ...]:
        """The results in sentences."""
        accelerations = [f"{in_g(a)} ({a:.3g} m/s2)" for a in self.statics.uplift_accelerations]
        uplift = self._by_side(f"from {a} on" for a in accelerations)
        curve = f"Probability against intensity: no curve, {self.trials.no_curve}."
        of_curve = [curve] if self.trials.no_curve else map(self._of_probability, (0.05, 0.5))
        return (
            f"Uplift: {self.statics.lifts} lifts {uplift}, the static threshold.",
            self._of_sliding(),
            *filter(None, [in_words(self.ties, self.trials, self.conditions)]),
            *filter(None, [of_azimuths(self.azimuths, self.trials, self.conditions, self.level)]),
            *filter(None, [of_plane(self.plane, self.trials, self.level)]),
            *of_curve,
            *([self._of_unanswered()] if self.trials.without_answer else []),
        )

    def _of_sliding(self) -> str:
        needed, friction = self.statics.frictions_to_rock, self.conditions.friction
        if friction is None:
            return (
                "Sliding: not judged, since no coefficient of friction was given; below "
                f"{self._by_side(f'{one:.3g}' for one in needed)} it slides before it rocks."
            )
        slides = in_g(self.statics.sliding_acceleration(friction))
        phrases = {
            True: f"slides first, from {slides} on, since its friction, {friction:g}, is below ",
            False: f"rocks first, since its friction, {friction:g}, is above ",
            None: "is at the limit between sliding first and rocking first, a friction of ",
        }
        first = self.statics.slides_first(friction)
        said = self._by_side(f"{phrases[a]}{b:.3g}" for a, b in zip(first, needed, strict=True))
        where = "in the weakest direction " * bool(self.conditions.azimuths)
        return f"Sliding: {where}it {said}.{self._of_room()}"

    def _of_room(self) -> str:
        rooms = [(one.room, one.displacement) for one in self.records if np.isfinite(one.room)]
        if not rooms or self.records_in_doubt or self._in_doubt:
            return ""
        largest, final = (max(column) for column in zip(*rooms, strict=True))
        if largest < _STILL:
            return " As recorded it stays in its place."
        return (
            f" As recorded it needs up to {in_mm(largest)} of room on either side, and ends up to "
            f"{in_mm(final)} from its place."
        )

    def _of_probability(self, probability: float) -> str:
        estimate, said = self.pga_at(probability), f"PGA at {percent(probability)}"
        said += " of overturning"
        if estimate is None:
            few = self._recordings < OF_TAILS
            why = f"that takes {OF_TAILS} recordings" if few else "its interval would be too wide"
            return f"{said}: not given, since {why}."
        first, last = self.conditions.levels[[0, -1]]
        inside = first <= estimate.value <= last
        return (
            f"{said}: {in_g(estimate.value, 2)}{'' if inside else ', beyond those tried'} "
            f"({percent(self.level)} interval {in_g(estimate.lower, 2)} to "
            f"{in_g(estimate.upper, 2)})."
        )

    def _of_unanswered(self) -> str:
        """Motions that are left out, and the figures with all of them standing and fallen."""
        kinds = ", ".join(f"{n} {outcome!r}" for outcome, n in self.trials.without_answer.items())
        fell, answered, rows, *_ = self.trials
        low, high = (
            pga_of(fitted(self.conditions, counted, np.ones_like(fell))[0], 0.5, self.level)
            for counted in (fell | ~answered, fell)
        )
        between = f"{fell[:, -1].sum()} to {(fell | ~answered)[:, -1].sum()} of {len(fell)}"
        between = f"{between} overturn it at {in_g(rows[-1].pga)}"
        if low is not None and high is not None:
            between = f"the PGA at 50 % is {in_g(low.value, 2)} to {in_g(high.value, 2)}"
        return (
            f"Without an answer, and left out: {kinds} of {fell.size} scaled motions. With all of "
            f"them standing, or all of them fallen, {between}."
        )

    @cached_property
    def helps(self) -> tuple[str, ...]:
        """Changes that help, each with its figure."""
        lifts = f"instead of {in_g(self._threshold)} on"
        said = (
            f"{one.change}: a foot lifts from {in_g(one.statics.uplift_acceleration)} {lifts}"
            f"{self._gain(one)}."
            for one in self.remedies
        )
        return tuple(said) if self._in_doubt else (*said, *self._of_restraint())

    def _gain(self, remedy: Remedy) -> str:
        """The effect of a change on overturning, averaged over all intensities."""
        if remedy.gain is None or not (self.trials.fell.any() or remedy.trials.fell.any()):
            return ""
        mean, low, high = (
            f"{percent(abs(x))} {'fewer' if x > 0.0 else 'more'}" for x in remedy.gain
        )
        said = f"of all scaled motions {mean} overturn"
        if remedy.gain.lower <= 0.0 <= remedy.gain.upper:
            said = "no measurable difference in how many overturn"
        said = f"; {said} ({percent(self.level)} interval {low} to {high})"
        for part in (0.05, 0.5):
            before, after = self.pga_at(part), pga_of(remedy.trials.fragility, part, self.level)
            if before is not None and after is not None:
                values = f"{in_g(after.value, 2)} instead of {in_g(before.value, 2)}"
                said += f", {percent(part)} at {values}"
        return said

    def _of_restraint(self) -> Iterator[str]:
        """A strap and a hold-down against the highest PGA."""
        top, friction = float(self.conditions.levels[-1]), self.conditions.friction
        load = Load(top, self.conditions.vertical_peak, friction)
        (full, which), highest = self._strap_place, self.statics.highest_strap(load)
        height = full
        if highest < full:  # rounded down: from there on upwards none holds
            step = 10.0 ** (np.floor(np.log10(highest)) - 2.0)
            height = step * np.floor(highest / step)
            which = "the highest place where it does not push the base out"
        force, held = self.statics.strap(load, height), self.statics.hold_down(load)
        pushed = self.statics.mass * (top + abs(self.statics.along))
        if not self.statics.one_body or force == 0.0:
            return
        if np.isnan(force):
            yield "No strap or anchor is judged: the vertical shaking lifts it."
            return
        yield (
            f"A strap {height:.4g} m above the ground, {which}, keeps it from lifting"
            f"{' and sliding' * (friction is not None)} up to {in_g(top)}, "
            f"statically, with a strength of {self._force(force)}; the base then carries "
            f"{self._force(pushed - force)} across."
        )
        if not self.statics.one_sided:
            yield from self._of_hold_down(held, pushed)
        trial = strap_trial(self.structure, self.conditions, height, force)
        if trial is not None:
            yield self._of_trial(trial, force)

    def _of_hold_down(self, held: float, pushed: float) -> Iterator[str]:
        """Force of a hold-down, and the one across [N]."""
        yield (
            f"So does a hold-down of {self._force(held)} at each edge; the base then carries "
            f"{self._force(pushed)} across."
            if np.isfinite(held)
            else f"No hold-down does without friction: stop the base with {self._force(pushed)}."
        )
        if self.conditions.friction is None:
            yield "Neither is judged against sliding, since no coefficient of friction was given."

    def _of_trial(self, trial: StrapTrial, force: float) -> str:
        """The strap under the records at the highest PGA; force : that holds it still [N]."""
        sides = "" if self.statics.one_sided else " to either side"
        tried = f"That strap{sides}, of {trial.stiffness:.2g} N/m, simulated: "
        where = f"of {self._motions(trial.number)} at {in_g(float(self.conditions.levels[-1]))}"
        if trial.overturned:
            return f"{tried}{trial.overturned} {where} overturn it all the same."
        strength = max(force, trial.force)
        step = 10.0 ** (np.floor(np.log10(strength)) - 2.0)
        return (
            f"{tried}none {where} overturns it, and its largest force is "
            f"{self._force(trial.force)}; choose a strength of "
            f"{newton(step * np.ceil(strength / step))} or more."
        )

    @property
    def _strap_place(self) -> tuple[float, str]:
        """Height of a strap above the ground [m], and in words."""
        height, words = height_of(self.structure)
        if np.isnan(height):
            return self.statics.centroid_height, "the height of the centroid"
        return height, words

    def _force(self, force: float) -> str:
        part = f"{percent(force / self.statics.weight)} of the weight"
        return part if default_masses(self.structure) else f"{newton(force)} ({part})"

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
            of_both = ", the geometric mean of both horizontal components" * bool(
                self.conditions.azimuths
            )
            said.append(
                f"Records: scaled to each PGA{of_both}, by {min(factors):.2g} to "
                f"{max(factors):.2g}, which keeps their frequencies. {QUIET:g} s of quiet follow "
                "each."
            )
        shaken = sum(motion.vertical is not None for motion in self.conditions.motions)
        if shaken:
            said.append(
                f"Vertical shaking: that of {shaken} of {self._motions(self._n)}, scaled along."
            )
        if self.conditions.slope:
            said.append("Slope: it falls to the right; the records act along it and normal to it.")
        still = "" if shaken else "no vertical shaking, "
        plane = "" if self.conditions.azimuths else "motion in one plane, "
        one = alone(self.structure, self.conditions)
        turns = f"azimuths other than {one}, " if one else ""
        said.append(f"Not checked: rigid ground, {plane}{turns}{still}feet that keep their edges.")
        return (*said, *self._of_intervals())

    def _of_feet(self) -> tuple[str, ...]:
        if self._slides:
            return (f"Sliding: simulated, with a friction of {self.conditions.friction:g}.",)
        if self.furthest is None:
            return ("No sliding: the simulations hold the feet.",)
        support = self.furthest.support
        of_all = support.friction_demand, support.impact_friction_demand
        needed = max(*of_all, support.foot_friction_demand)  # NaN in the plane, and no larger
        friction = self.conditions.friction
        if np.isnan(needed):
            return ("No sliding: the simulations hold the edge about which it turns.",)
        held = (
            "" if friction is None else " It held." if needed <= friction else " It did not hold."
        )
        pulled = "was pulled: it would have jumped" if support.lost_contact else "was pulled"
        who = "a" if support.lost_contact else "no"
        return (
            "No sliding: the simulations hold the feet. Under the record that turned it furthest "
            f"without overturning that needed a friction of {needed:.2g}.{held}".replace(
                " inf.", " infinity."
            ),
            f"No bouncing: under that record {who} foot that stood {pulled}.",
        )

    def _of_intervals(self) -> tuple[str, ...]:
        n, by_what = self._recordings, _BY_PARTS if self.conditions.azimuths else _BY_GROUP
        said = (
            f"Intervals: {percent(self.level)}. Their unit is a recording, one event at one "
            f"station: {plural(n, 'recording')} of {self._motions(self._n)}. Several events of a "
            "station, and stations of one event, are not grouped.",
            f"Fractions: Clopper and Pearson, {by_what}.",
            "Curve: lognormal, maximum likelihood. Its intervals: Fieller and Student; motions of "
            "a recording may depend on one another fully.",
        )
        return said[: 2 + (self.trials.fragility is not None)] if self._n else ()

    @property
    def _in_doubt(self) -> bool:
        """Whether lengths, gravity or intensities must be checked before anything is promised."""
        return bool(self.units_in_doubt) and not self.units_checked

    @property
    def _ratio(self) -> str:
        """The largest rotation over that from which it does not come back."""
        return "tilt/barrier" if self.conditions.azimuths else "theta/alpha"

    @property
    def _foot(self) -> str:
        return "its inner edge" if self.statics.one_sided else "a foot"

    @property
    def _slides(self) -> bool:
        return can_slide(self.structure, self.conditions)

    @property
    def _moves(self) -> bool:
        """Whether it leaves its place anywhere."""
        rooms = [row.room for row in self.trials.intensities] + [one.room for one in self.records]
        return any(room > _STILL for room in rooms)

    def _by_side(self, texts: Iterable[str]) -> str:
        """Texts (left, right) as one; that of the right alone of what lifts to no other side."""
        left, right = texts
        if left == right or self.statics.one_sided:
            return right
        return f"{left} to the left and {right} to the right"

    @property
    def _n(self) -> int:
        return len(self.conditions.motions)

    @property
    def _recordings(self) -> int:
        return len(np.unique(self.conditions.recordings))

    @property
    def _threshold(self) -> float:
        return self.statics.uplift_acceleration

    def _motions(self, n: int) -> str:
        several = self.conditions.both_ways or len(self.conditions.azimuths) > 1
        return plural(n, "motion" if several else "record")

    def summary(self) -> str:
        """Whole assessment as text.

        Returns
        -------
        str
            Text of several lines.
        """
        rows = [
            f"PGA {in_g(row.pga)}: {_counted(row)}"
            + (f"; others need up to {in_mm(row.room)} of room" if row.room > _STILL else "")
            for row in self.trials.intensities
        ]
        levels = [f" at {in_g(level)}" for level in self.conditions.levels.tolist()]
        blocks = {
            "Results": self.findings,
            "Overturning against intensity": rows,
            "Overturning against azimuth": [
                f"{azimuth}: {'; '.join(map(str.__add__, cells, levels))}"
                for azimuth, *cells in self._azimuth_rows()
            ],
            "Checks of codes": self._checks_in_words(),
            "Measures that help": self.helps,
            "Assumptions": self.assumptions,
        }
        lines = [self.title]
        lines += [fill(f"Question: {one}", _WIDTH) for one in self.questions]
        lines.append(fill(self.verdict, _WIDTH))
        for name, sentences in blocks.items():
            lines += ["", name] if sentences else []
            lines += [
                fill(one, _WIDTH, initial_indent="  ", subsequent_indent="    ")
                for one in sentences
            ]
        return "\n".join(lines)

    def _azimuth_rows(self) -> list[tuple[str, ...]]:
        """Each azimuth, and the motions there that overturn at each PGA; none for one azimuth."""
        rows = []
        for azimuth, *columns in self.azimuths if len(self.azimuths) > 1 else ():
            cells = [f"{n} of {of} ({_between(*ends)})" for n, of, *ends in zip(*columns)]  # noqa: B905
            rows.append((in_degrees(azimuth), *cells))
        return rows

    def _checks_in_words(self) -> list[str]:
        if not self._shows_checks:
            return []
        levels = [in_g(pga) for pga in self.conditions.levels.tolist()]
        said = [
            f"{name}: {'; '.join(f'at {pga} {x}' for pga, x in zip(levels, results, strict=True))}"
            for name, *results in rows_of(self.checks)
        ]
        return [HOW_TO_READ, *said, *sources_of(self.checks)]

    @property
    def _shows_checks(self) -> bool:
        return bool(self.checks) and not self._in_doubt

    def __str__(self) -> str:
        return self.summary()

    def __repr__(self) -> str:
        return f"Assessment({self.verdict!r})"

    # -- a figure and a page

    def plot(self) -> Figure:
        """Draw the probability of overturning against PGA.

        Returns
        -------
        matplotlib.figure.Figure
            Figure.
        """
        return draw(self.trials, self.remedies, self._threshold, self.level)

    def html(self) -> str:
        """Page that needs no other file.

        Returns
        -------
        str
            Text of the page.
        """
        return page.whole(self.title, self._body())

    def save(self, path: str | Path) -> None:
        """Write the page into a file.

        Parameters
        ----------
        path : path_like
            File whose name ends in .html.

        Raises
        ------
        ValueError
            For another name.
        OSError
            Where it cannot be written.
        """
        check_page(path)
        write(path, self.html())

    def _repr_html_(self) -> str:
        title = f"<div><strong>{escape(self.title)}</strong></div>"
        return f'<div class="rockeom">{title}{self._body()}</div>'

    def _body(self) -> str:
        shaken = simulated(self.structure, self.conditions)
        facts = facts_of(shaken, self.conditions.impact, self.conditions.slope)
        parts = [
            *(f'<p class="question">{escape(one)}</p>' for one in self.questions),
            f'<p class="verdict">{escape(self.verdict)}</p>',
            page.bullets(self.findings),
            page.image(self.plot(), "probability of overturning against peak ground acceleration")
            if self._n
            else "",
            "<h2>Overturning against intensity</h2>" + page.wide(self._intensity_table())
            if self._n
            else "",
            f"<h2>Overturning against azimuth</h2>{self._azimuth_table()}"
            if self._azimuth_rows()
            else "",
            f"<h2>Checks of codes</h2>{self._check_table()}" if self._shows_checks else "",
            f"<h2>Measures that help</h2>{page.bullets(self.helps)}" if self.helps else "",
            f"<h2>Assumptions, and whether they held</h2>{page.bullets(self.assumptions)}",
            f"<h2>Structure</h2>{page.facts(facts)}",
            f"<h2>Each record as it was recorded</h2>{page.wide(self._record_table())}"
            if self._n
            else "",
        ]
        return _UNIT.sub("&nbsp;", "".join(parts))

    def _intensity_table(self) -> str:
        curve = self.trials.fragility
        heads = (
            "PGA",
            f"lift {self._foot}",
            "overturn",
            f"{percent(self.level)} interval",
            "curve",
            *["planar block"] * (self.plane is not None),
        )
        rows = [
            (
                in_g(row.pga),
                f"{row.lifted} of {row.number}",
                f"{row.overturned} of {row.number}",
                _interval(row),
                "–" if curve is None else percent(float(curve.probability(row.pga))),
                *([] if self.plane is None else [self.plane.at(i)]),
                *([in_mm(row.room)] if self._moves else []),
            )
            for i, row in enumerate(self.trials.intensities)
        ]
        return page.table((*heads, *(["room"] if self._moves else [])), rows)

    def _azimuth_table(self) -> str:
        """Motions that overturn it, a row for each azimuth and a column for each PGA."""
        heads = ("azimuth", *map(in_g, self.conditions.levels.tolist()))
        table = page.wide(page.table(heads, self._azimuth_rows()))
        return f"<p>The intervals at one PGA hold together at {percent(self.level)}.</p>{table}"

    def _check_table(self) -> str:
        """Motions and checks, a column for each PGA."""
        heads = ("", *map(in_g, self.conditions.levels.tolist()))
        title = f"Records that overturn it ({percent(self.level)} interval)"
        counts = [(title, *map(_counted, self.trials.intensities))]
        table = page.table(heads, [*(counts if self._n else []), *rows_of(self.checks)])
        sources = page.bullets(sources_of(self.checks))
        return f"<p>{HOW_TO_READ}</p>{page.wide(table)}{sources}"

    def _record_table(self) -> str:
        """Records that overturn it first, then those that turn it furthest."""
        order = sorted(self.records, key=lambda one: (not one.fell, -one.rotation))
        rows = [
            (
                one.name,
                in_g(one.peak),
                one.outcome if one.fell or not one.answered else f"{np.degrees(one.rotation):.1f}°",
                "–" if one.fell or np.isnan(one.part) else f"{one.part:.2g}",
                *([in_mm(one.room), in_mm(one.displacement)] if self._moves else []),
            )
            for one in order
        ]
        rest = f"<p>{len(rows) - _SHOWN} more are not listed.</p>" if len(rows) > _SHOWN else ""
        moves = ("room", "in the end") if self._moves else ()
        heads = ("record", "PGA", "largest rotation", self._ratio, *moves)
        return page.table(heads, rows[:_SHOWN]) + rest


def check_page(path: str | Path) -> None:
    """Raise ValueError for a name that is not that of a page, OSError where none can be written."""
    if Path(path).suffix.lower() != ".html":
        raise InputError("path", Path(path)).give("a page, a name that ends in .html")
    check_target(path)


def _s(n: int) -> str:
    """The end of a verb of which none, one or more are the subject."""
    return "s" * (n <= 1)


def _counted(row: AtIntensity) -> str:
    return f"{row.overturned} of {row.number} ({_interval(row)})"


def _interval(row: AtIntensity) -> str:
    return _between(row.lower, row.upper)


def _between(lower: float, upper: float) -> str:
    return f"{percent(lower).removesuffix(' %')} to {percent(upper)}"
