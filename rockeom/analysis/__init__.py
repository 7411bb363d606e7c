"""Formulas and procedures of the field on arrays, responses and sweeps; never SymPy.

    from rockeom import analysis

    analysis.response_spectrum(motion, periods=[0.2, 0.5, 1.0])
    analysis.formulas.energy_ratio_of_block(alpha=[0.1, 0.2, 0.3])

The names used most are attributes of the package. All names are in six groups: `formulas`,
`design`, `dynamics`, `identification`, `risk` and `validation`.

Quantities are in SI units and radians. "Thesis" numbers are the equations of Ma (2010), which
`rockeom.thesis` checks.
"""

import sys
from functools import reduce
from importlib import import_module
from typing import TYPE_CHECKING, Any

from rockeom import renamed

if TYPE_CHECKING:  # for type checkers and editors, which cannot follow __getattr__
    from rockeom.analysis import (
        design as design,
        dynamics as dynamics,
        formulas as formulas,
        identification as identification,
        risk as risk,
        validation as validation,
    )
    from rockeom.analysis.design.isolation import (
        compare_with_fixed_base as compare_with_fixed_base,
        energy_balance as energy_balance,
    )
    from rockeom.analysis.dynamics.overturning import (
        overturning_boundaries as overturning_boundaries,
        rocking_spectrum as rocking_spectrum,
    )
    from rockeom.analysis.dynamics.spectra import response_spectrum as response_spectrum
    from rockeom.analysis.formulas.controlled_wall import Wall as Wall
    from rockeom.analysis.identification.fitting import fit_free_vibration as fit_free_vibration
    from rockeom.analysis.identification.records import MeasuredRecord as MeasuredRecord
    from rockeom.analysis.risk.fragility import fragility_of as fragility_of
    from rockeom.analysis.sweeps import outcome_labels as outcome_labels, peaks_of as peaks_of

_GROUPS = ("formulas", "design", "dynamics", "identification", "risk", "validation")
_HOME_OF = {
    "MeasuredRecord": "identification.records",
    "Wall": "formulas.controlled_wall",
    "compare_with_fixed_base": "design.isolation",
    "energy_balance": "design.isolation",
    "fit_free_vibration": "identification.fitting",
    "fragility_of": "risk.fragility",
    "outcome_labels": "sweeps",
    "overturning_boundaries": "dynamics.overturning",
    "peaks_of": "sweeps",
    "response_spectrum": "dynamics.spectra",
    "rocking_spectrum": "dynamics.overturning",
}
"""The module of each name that is an attribute of the package itself."""
__all__ = [*_HOME_OF]

_FORMER = {
    "beside_fixed_base": "compare_with_fixed_base",
    "held_states": "equilibrium_states",
    "TwoSprings": "FoundationSprings",
}
_CONSTANTS = {
    "DESIGN_FACTORS": "formulas.damping.DESIGN_FACTORS",
    "FEIGENBAUM": "dynamics.branches.FEIGENBAUM",
    "GRANT_FACTORS": "formulas.damping.GRANT_FACTORS",
    "PULSE_MODELS": "identification.pulses.PULSE_MODELS",
}
_ELSEWHERE = {
    "rockeom.simulation.quantities": ("EnergyBalance",),
    "rockeom.thesis.points_of_interest": (
        "PointsOfInterest", "importance_scores", "points_by_prominence", "points_by_score",
    ),
    "rockeom.thesis.wall_tests": (
        "EdgeUplifts", "back_calculated_force", "corrected_uplifts", "energy_ratio_4_31",
        "energy_ratio_4_36", "energy_ratio_4_38", "harmonic_force", "quarter_period_fit",
    ),
}  # fmt: skip
"""Former names by the module that has them now, of packages that this one cannot import."""


def __getattr__(name: str) -> Any:
    if name in _GROUPS:
        return import_module(f"{__name__}.{name}")
    if name in _HOME_OF:
        globals()[name] = getattr(import_module(f"{__name__}.{_HOME_OF[name]}"), name)
        return globals()[name]
    message = f"module {__name__!r} has no attribute {name!r}"
    if name.startswith("_"):
        raise AttributeError(message)
    for module, names in _ELSEWHERE.items():
        if name in names:
            raise AttributeError(f"{message}: import it from {module}")
    return _former(name, message)


def _former(name: str, message: str) -> Any:
    """A name of a group as an attribute of this package, for one release."""
    groups = {one: f"{group}.{one}" for group in _GROUPS for one in dir(__getattr__(group))}
    places = groups | _CONSTANTS | {one: one for one in _HOME_OF}
    today = _FORMER.get(name, name)
    if today in places:
        renamed.warn(f"{__name__}.{name}", f"{__name__}.{places[today]}")
        return reduce(getattr, places[today].split("."), sys.modules[__name__])
    from difflib import get_close_matches  # only where there is an error

    for meant in get_close_matches(name, places, n=1):
        message += f" (did you mean {places[meant]}?)"
    raise AttributeError(message, name=name, obj=None)  # Python would add a suggestion of its own


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__, *_GROUPS})
