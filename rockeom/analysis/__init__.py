"""Formulas and procedures of the field on arrays, responses and sweeps; never SymPy.

::

    from rockeom import analysis

    analysis.response_spectrum(motion, periods=[0.2, 0.5, 1.0])
    analysis.formulas.energy_ratio_of_block(alpha=[0.1, 0.2, 0.3])

The names used most are attributes of the package. All names are in seven groups: `formulas`,
`design`, `dynamics`, `identification`, `risk`, `standards` and `validation`.

Quantities are in SI units and radians. "Thesis" numbers are the equations of Ma (2010), which
`rockeom.thesis` checks.
"""

from importlib import import_module
from typing import TYPE_CHECKING, Any

from rockeom.numbers import explained

if TYPE_CHECKING:  # for type checkers and editors, which cannot follow __getattr__
    from rockeom.analysis import (
        design as design,
        dynamics as dynamics,
        formulas as formulas,
        identification as identification,
        risk as risk,
        standards as standards,
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

_GROUPS = ("formulas", "design", "dynamics", "identification", "risk", "standards", "validation")
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


def __getattr__(name: str) -> Any:
    if name in _GROUPS:
        return import_module(f"{__name__}.{name}")
    if name in _HOME_OF:
        globals()[name] = getattr(import_module(f"{__name__}.{_HOME_OF[name]}"), name)
        return globals()[name]
    message = f"module {__name__!r} has no attribute {name!r}"
    if name.startswith("_"):
        raise AttributeError(message)
    raise explained.UnknownAttributeError(message, name, _offers)


def _offers() -> dict[str, str]:
    """The names of the package and of its groups, each with what to write."""
    of_groups = {one: f"{group}.{one}" for group in _GROUPS for one in dir(__getattr__(group))}
    return of_groups | {one: one for one in _HOME_OF}


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__, *_GROUPS})
