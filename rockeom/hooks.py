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
plot_motion = Hook()
"""A figure of a ground motion; keyword arguments as in `rockeom.plots.plot_motion`."""
plot_spectra = Hook()
"""A figure of response spectra; arguments as in `rockeom.plots.plot_spectra`."""
response_spectrum = Hook()
"""The spectrum of a motion; arguments as in `rockeom.analysis.response_spectrum`."""
animate = Hook()
"""An animation of a response; keyword arguments as in `rockeom.plots.animate`."""
html_of = Hook()
"""What Jupyter shows of a structure, a response, a motion or a sweep."""
thesis_wall = Hook()
"""The `rockeom.analysis.Wall` of the thesis with an initial force of its tendon [N]."""
save_response = Hook()
"""Write a response to a file; see `Response.save`."""
code_of_model = Hook()
"""The text of a RockingModel or Model in a language, see `rockeom.exports.code`."""
