"""A lesson on a page: questions to predict and then to see, and objects of every day."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

from rockeom.browser.controls import Controls

COMPARED = ("overturns", "peak", "impacts", "period", "duration")

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
    """A question that a reader of a page answers first, and the page by integration then.

    text : the question. after : values of sliders and menus by name that change the first motion
    into the second. compare : "overturns", whether the second one does; or what grows, falls or
    stays within 1 % from the first to the second: the "peak" of the rotation, the number of
    "impacts", the "period" between the first and the third, the "duration" until the last.
    before : values of the first motion that differ from those at first. explanation : shown with
    the answer.

    >>> rk.Question("Does a block of twice the size survive?", {"size": 2.0}, before={"size": 1.0})
    """

    text: str
    after: Mapping[str, Any]
    compare: str = "overturns"
    before: Mapping[str, Any] = field(default_factory=dict)
    explanation: str = ""

    def __post_init__(self) -> None:
        if self.compare not in COMPARED:
            raise ValueError(f"compare is {self.compare!r}: give one of {', '.join(COMPARED)}")

    def described(self, controls: Controls) -> dict[str, Any]:
        """The question as a page reads it; raises ValueError for values that no control has."""
        where = f"question {self.text!r}"
        return {
            "text": self.text,
            "before": controls.places(where, self.before),
            "after": controls.places(where, {**self.before, **self.after}),
            "compare": self.compare,
            "explanation": self.explanation,
        }
