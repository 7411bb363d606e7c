"""Calls that a lower package makes and a higher one answers, so that none imports what is above it.

`rockeom/__init__.py`, which stands above all and is imported before any of them, says who answers.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any


class Hook:
    """A function that is called here and given elsewhere."""

    answer: Callable[..., Any]

    def __call__(self, *args: Any, **kwargs: Any) -> Any:
        return self.answer(*args, **kwargs)


plot_response = Hook()
"""A figure of a response; keyword arguments as in `rockeom.plots.plot_response`."""
thesis_wall = Hook()
"""The `rockeom.analysis.Wall` of the thesis with an initial force of its tendon [N]."""
code_of_model = Hook()
"""The text of a RockingModel or Model in a language, see `rockeom.exports.code`."""
