"""Figures of responses, structures and sweeps, for papers and notebooks.

Every function returns a matplotlib figure and never opens a window: save it with
``figure.savefig("name.png")``, or leave it as the last line of a notebook's cell. `free_body`
holds the pieces of a drawing of your own, and `use_style` gives pyplot the look of these figures.
"""

from typing import Any

from rockeom.drawing import free_body as free_body, style as style
from rockeom.drawing.animation import Animation, animate
from rockeom.drawing.comparison import plot_comparison
from rockeom.drawing.ground_motion import plot_motion, plot_spectra
from rockeom.drawing.plan import plot_tilt, plot_tracks
from rockeom.drawing.portrait import plot_phase_portrait
from rockeom.drawing.response import plot_response
from rockeom.drawing.sketch import draw_structure
from rockeom.drawing.style import use_style
from rockeom.numbers import explained
from rockeom.plots.design_report import DesignReport, design_report
from rockeom.plots.dynamics import basins_of_attraction, bifurcation_diagram, poincare_section
from rockeom.plots.sweeps import (
    fragility_curve,
    incremental_dynamic_analysis,
    overturning_map,
    rocking_spectrum,
)
from rockeom.plots.validation import peak_distributions, reliability_diagram
from rockeom.plots.walls import wall_envelopes


def __getattr__(name: str) -> Any:
    offers = {one: one for one in __all__}
    message = f"module {__name__!r} has no attribute {name!r}"
    raise explained.UnknownAttributeError(message, name, lambda: offers)


__all__ = [
    "Animation",
    "DesignReport",
    "animate",
    "basins_of_attraction",
    "bifurcation_diagram",
    "design_report",
    "draw_structure",
    "fragility_curve",
    "incremental_dynamic_analysis",
    "overturning_map",
    "peak_distributions",
    "plot_comparison",
    "plot_motion",
    "plot_phase_portrait",
    "plot_response",
    "plot_spectra",
    "plot_tilt",
    "plot_tracks",
    "poincare_section",
    "reliability_diagram",
    "rocking_spectrum",
    "use_style",
    "wall_envelopes",
]
