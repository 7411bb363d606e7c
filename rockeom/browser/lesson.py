"""A lesson on a page: questions to predict and then to see, and objects of every day."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

from rockeom.browser.controls import Controls
from rockeom.browser.program import METHOD
from rockeom.numbers.checks import InputError, require_word
from rockeom.simulation.case import Case
from rockeom.simulation.options import SolverOptions
from rockeom.simulation.response import Response
from rockeom.simulation.simulate import simulated

Motions = Callable[..., tuple[str, list[float]]]
"""Outcome and readings of a motion of a page, at values of all controls and until a time."""

COMPARED = ("overturns", "peak", "impacts", "period", "duration")
"""The readings of a motion that questions compare, in their order."""
SAME = 0.01
"""Relative difference up to which two readings are the same."""
FATES = {"overturned": 1.0, "completed": -1.0, "came to rest": -1.0}
"""The outcomes that questions and maps compare: a fall, or none."""
LONGER = 3.0
"""A reading is settled where a motion so many times as long has the same."""
DOUBLINGS = 8
"""How often the duration of a case is doubled for that."""

OBJECTS = {
    "statue on a plinth": (0.25, 0.9),
    "server rack": (0.3, 1.0),
    "bookshelf": (0.15, 1.0),
    "display case": (0.3, 0.95),
    "gravestone": (0.1, 0.5),
    "bridge pier": (1.5, 6.0),
}
"""Half width and half height of blocks of the size of such objects [m]."""


@dataclass(frozen=True)
class Question:
    """Question that a reader of a page answers first, and the page by integration then.

    Parameters
    ----------
    text : str
        Question.
    after : dict of str to object
        Values of sliders and menus by name that change the first motion into the second.
    compare : str, optional
        "overturns", whether the second one does; or the quantity that grows, falls or stays within
        1 % from the first to the second: the "peak" of the rotation, the number of "impacts", the
        "period" between the first and the third, the "duration" until the last.
    before : dict of str to object, optional
        Values of the first motion that differ from those at first.
    explanation : str, optional
        Explanation shown with the answer.

    Notes
    -----
    Both motions go on beyond the duration of the case until that no longer changes, such as to
    rest. A question whose answer never settles, or is not that of `rk.simulate`, has no page: its
    ValueError says why.

    Examples
    --------
    >>> import rockeom as rk
    >>> question = rk.Question(
    ...     "Does a block of twice the size survive?", {"size": 2.0}, before={"size": 1.0}
    ... )
    """

    text: str
    after: Mapping[str, Any]
    compare: str = "overturns"
    before: Mapping[str, Any] = field(default_factory=dict)
    explanation: str = ""

    def __post_init__(self) -> None:
        require_word("compare", self.compare, COMPARED)

    def motions(self, controls: Controls) -> list[dict[int, float]]:
        """Values of the motions before and after, by their place among those of the page.

        Parameters
        ----------
        controls : Controls
            Sliders and menus of the page.

        Returns
        -------
        list of dict of int to float
            Values of both motions.
        """
        where = f"question {self.text!r}"
        return [controls.places(where, {**self.before, **x}) for x in ({}, self.after)]

    def described(self, controls: Controls) -> dict[str, Any]:
        """Question as a page reads it.

        Parameters
        ----------
        controls : Controls
            Sliders and menus of the page.

        Returns
        -------
        dict of str to object
            Data of the page.

        Raises
        ------
        ValueError
            For values that no control has.
        """
        before, after = self.motions(controls)
        return {
            "text": self.text, "before": before, "after": after, "compare": self.compare,
            "reading": COMPARED.index(self.compare), "explanation": self.explanation,
        }  # fmt: skip


def readings_of(run: Response) -> list[float]:
    """The numbers that questions compare, in the order of COMPARED; nan where a run has none."""
    times = run.impacts.times
    peak = abs(run.extremes(run.states[run.structure.module.ROTATION]).peak)
    period = times[2] - times[0] if len(times) > 2 else np.nan
    overturned, last = str(run.outcome) == "overturned", max(times, default=np.nan)
    return [float(x) for x in (overturned, peak, len(times), period, last)]


def ends_of(
    question: Question, case: Callable[..., Case], controls: Controls, page: Motions
) -> list[float]:
    """The times [s] until which both motions of a question go on, so that its answer is settled.

    page : the motions of the page. Raises ValueError for an answer that does not settle, and for
    one that `rk.simulate` does not give for motions that are LONGER.
    """
    kind, ends, here, python = COMPARED.index(question.compare), [], [], []
    for values in question.motions(controls):
        place = controls.start
        place[list(values)] = [*values.values()]
        motion = case(**controls.named(place))
        ends.append(_settled(question, page, place, motion.problem().end))
        here.append(page(place, ends[-1])[1][kind])
        longer = replace(motion, duration=LONGER * ends[-1])
        run = simulated(longer, longer.problem(), SolverOptions(method=METHOD))
        python.append(readings_of(run)[kind])
    if not np.allclose(here, python, rtol=SAME, atol=0.0) or _change(*here) != _change(*python):
        raise InputError("questions").says(
            f"question {question.text!r}: {question.compare} before and after is {here} on the "
            f"page and {python} by rk.simulate: the motions are too sensitive, ask of others"
        )
    return ends


def _settled(question: Question, page: Motions, place: np.ndarray, end: float) -> float:
    """The time until which a motion goes on for its reading to stay."""
    kind, outcome, now, later = COMPARED.index(question.compare), "", np.nan, np.nan
    for _ in range(DOUBLINGS):
        later = page(place, LONGER * end)[1][kind]
        outcome, readings = page(place, end)
        now = readings[kind]
        if np.isclose(now, later, rtol=1e-9, atol=0.0) and outcome in FATES:
            return end
        end *= 2.0
    raise InputError("questions").says(
        f"question {question.text!r}: {question.compare} of a motion is {now:g} until {end / 2:g} "
        f"s, {later:g} until {LONGER * end / 2:g} s (nan: there is none), and it ends as "
        f"{outcome!r}: ask of motions that come to rest, or compare something else"
    )


def _change(before: float, after: float) -> float:
    """The sign of a change, 0 for readings that are the same."""
    change = after - before
    return 0.0 if abs(change) <= SAME * abs(before) else np.sign(change)
