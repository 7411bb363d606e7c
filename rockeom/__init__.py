"""Equations of motion of rocking structures: derived symbolically, compiled, and integrated.

    import rockeom as rk

    block = rk.RigidBlock(half_width=0.095, half_height=0.45)  # m
    run = rk.simulate(block, rk.GroundMotion.none(10.0), initial={"theta": 0.1})  # s, rad
    run.t, run["theta"], run.impacts, run.outcome

Every public name is a lazy attribute of this package (PEP 562): it is imported from its home on
first use, so that ``import rockeom`` costs next to nothing and who only simulates never loads
SymPy.
"""

from importlib import import_module
from typing import TYPE_CHECKING, Any

from rockeom.numbers import pictures
from rockeom.version import VERSION

__version__ = VERSION

pictures.register(lambda: import_module("rockeom.drawing.shown"))

_NAMES_OF = {
    "rockeom.assessment.assess": ("assess",),
    "rockeom.assessment.result": ("Assessment",),
    "rockeom.browser.controls": ("Slider",),
    "rockeom.browser.lesson": ("Question",),
    "rockeom.browser.page": ("Explorer", "explorer"),
    "rockeom.numbers.breaks": ("Break",),
    "rockeom.structures.restraints": ("Anchor", "Push", "Strap"),
    "rockeom.modelling.boulder": ("Boulder",),
    "rockeom.modelling.composed": ("Pinned", "ShearFrame", "Sliding", "TwoSprings", "Winkler"),
    "rockeom.modelling.facade": ("Facade",),
    "rockeom.modelling.held_block": ("HeldBlock",),
    "rockeom.modelling.isolated": ("IsolatedBlocks",),
    "rockeom.modelling.rolling": ("RollingCylinder",),
    "rockeom.modelling.standing": ("LeggedStatue", "Prism"),
    "rockeom.modelling.wobbling": ("Podium", "WobblingColumn"),
    "rockeom.modelling.wall_on_bed": ("WallOnBed",),
    "rockeom.numbers.checks": ("InputError",),
    "rockeom.numbers.dual": ("Dual", "duals"),
    "rockeom.motion": ("DesignSpectrum", "GroundMotion", "MotionSet", "Recording"),
    "rockeom.motion.floor": ("floor_motion",),
    "rockeom.modelling.named": ("structure",),
    "rockeom.simulation.case": ("Case",),
    "rockeom.sweeps.options": ("SweepOptions",),
    "rockeom.sweeps.run": ("simulate_many",),
    "rockeom.sweeps.dataset": ("Sweep",),
    "rockeom.sweeps.store": ("open_sweep",),
    "rockeom.simulation.extremes": ("Extremes",),
    "rockeom.structures.modal": ("rayleigh_damping",),
    "rockeom.structures.impact_laws": (
        "AngularMomentum",
        "EnergyLossAtSpeed",
        "EnergyRatio",
        "EnergyRatioAtSpeed",
        "EnergyRatioByImpact",
        "Impulsive",
        "RandomEnergyRatio",
        "VelocityRatio",
    ),
    "rockeom.simulation.options": ("SolverOptions",),
    "rockeom.simulation.events": ("Event",),
    "rockeom.simulation.outcome": ("Outcome",),
    "rockeom.simulation.response": ("Response",),
    "rockeom.sweeps.sensitivity": ("Sensitivity", "sensitivity"),
    "rockeom.simulation.simulate": ("simulate",),
    "rockeom.structures.classes": ("Structure",),
    "rockeom.sweeps.tangents": ("Tangents", "tangents"),
    "rockeom.exports.responses": ("load",),
    "rockeom.symbolic": ("Body", "Parameter", "Mode", "RockingModel", "derive", "models"),
}
_NAMESPACES = ("analysis", "plots")
"""Packages whose many names are no top-level ones."""
_HOME_OF = {name: home for home, names in _NAMES_OF.items() for name in names}


_SYNONYMS = {
    "Block": "RigidBlock",
    "HousnerBlock": "RigidBlock",
    "Frame": "ShearFrame",
    "Record": "GroundMotion",
    "Motion": "GroundMotion",
    "run": "simulate",
    "solve": "simulate",
    "sweep": "simulate_many",
    "Restitution": "VelocityRatio",
    "CoefficientOfRestitution": "VelocityRatio",
    "Options": "SolverOptions",
    "Model": "rockeom.symbolic.Model",
    "Contact": "rockeom.symbolic.Contact",
    "read": "GroundMotion.read",
    "plot": "plots.plot_response",
    "spectrum": "analysis.response_spectrum",
    "fragility": "analysis.fragility_of",
    "overturning_spectrum": "analysis.rocking_spectrum",
}
"""Names that people try first, and the names that they mean."""


def _offers() -> dict[str, str]:
    """Names that may have been meant, each with what to write; those of its packages are longer."""
    package = import_module(__name__)
    analysis, plots = (import_module(f"{__name__}.{name}") for name in _NAMESPACES)
    groups = {
        name: f"analysis.{group}.{name}"
        for group in analysis._GROUPS
        for name in dir(getattr(analysis, group))
    }
    named = {name: f"analysis.{name}" for name in analysis.__all__}
    drawn = {name: f"plots.{name}" for name in plots.__all__ if name not in named}
    pulses = {
        name.replace("_", ""): f"GroundMotion.{name}"
        for name in dir(package.GroundMotion)
        if not name.startswith("_")
    }
    names = {name: name for name in __dir__() if not name.startswith("_")}
    return {**groups, **pulses, **drawn, **named, **_SYNONYMS, **names}


def _classes() -> dict[str, str]:
    """The home of the class of each shipped structure, as `rockeom generate` has listed them."""
    found = import_module("rockeom.generated.shipped_structures").SHIPPED
    return dict.fromkeys(found.values(), "rockeom.structures.classes")


# For type checkers and editors, which cannot follow __getattr__; a test holds it to the table.
if TYPE_CHECKING:
    from rockeom.assessment.assess import assess as assess
    from rockeom.assessment.result import Assessment as Assessment
    from rockeom.browser.controls import Slider as Slider
    from rockeom.browser.lesson import Question as Question
    from rockeom.browser.page import Explorer as Explorer, explorer as explorer
    from rockeom.exports.responses import load as load
    from rockeom.modelling.boulder import Boulder as Boulder
    from rockeom.modelling.composed import (
        Pinned as Pinned,
        ShearFrame as ShearFrame,
        Sliding as Sliding,
        TwoSprings as TwoSprings,
        Winkler as Winkler,
    )
    from rockeom.modelling.facade import Facade as Facade
    from rockeom.modelling.held_block import HeldBlock as HeldBlock
    from rockeom.modelling.isolated import IsolatedBlocks as IsolatedBlocks
    from rockeom.modelling.named import structure as structure
    from rockeom.modelling.rolling import RollingCylinder as RollingCylinder
    from rockeom.modelling.standing import LeggedStatue as LeggedStatue, Prism as Prism
    from rockeom.modelling.wall_on_bed import WallOnBed as WallOnBed
    from rockeom.modelling.wobbling import Podium as Podium, WobblingColumn as WobblingColumn
    from rockeom.motion import (
        DesignSpectrum as DesignSpectrum,
        GroundMotion as GroundMotion,
        MotionSet as MotionSet,
        Recording as Recording,
    )
    from rockeom.motion.floor import floor_motion as floor_motion
    from rockeom.numbers.breaks import Break as Break
    from rockeom.numbers.checks import InputError as InputError
    from rockeom.numbers.dual import Dual as Dual, duals as duals
    from rockeom.simulation.case import Case as Case
    from rockeom.simulation.events import Event as Event
    from rockeom.simulation.extremes import Extremes as Extremes
    from rockeom.simulation.options import SolverOptions as SolverOptions
    from rockeom.simulation.outcome import Outcome as Outcome
    from rockeom.simulation.response import Response as Response
    from rockeom.simulation.simulate import simulate as simulate
    from rockeom.structures.classes import *  # noqa: F403
    from rockeom.structures.impact_laws import (
        AngularMomentum as AngularMomentum,
        EnergyLossAtSpeed as EnergyLossAtSpeed,
        EnergyRatio as EnergyRatio,
        EnergyRatioAtSpeed as EnergyRatioAtSpeed,
        EnergyRatioByImpact as EnergyRatioByImpact,
        Impulsive as Impulsive,
        RandomEnergyRatio as RandomEnergyRatio,
        VelocityRatio as VelocityRatio,
    )
    from rockeom.structures.modal import rayleigh_damping as rayleigh_damping
    from rockeom.structures.restraints import Anchor as Anchor, Push as Push, Strap as Strap
    from rockeom.sweeps.dataset import Sweep as Sweep
    from rockeom.sweeps.options import SweepOptions as SweepOptions
    from rockeom.sweeps.run import simulate_many as simulate_many
    from rockeom.sweeps.sensitivity import (
        Sensitivity as Sensitivity,
        sensitivity as sensitivity,
    )
    from rockeom.sweeps.store import open_sweep as open_sweep
    from rockeom.sweeps.tangents import Tangents as Tangents, tangents as tangents
    from rockeom.symbolic import (
        Body as Body,
        Mode as Mode,
        Parameter as Parameter,
        RockingModel as RockingModel,
        derive as derive,
        models as models,
    )


def __getattr__(name: str) -> Any:
    if name in _NAMESPACES:
        return import_module(f"rockeom.{name}")
    if name == "__all__":
        return sorted({*_HOME_OF, *_classes()})
    home = _HOME_OF.get(name)
    if home is None and name[:1].isupper():
        home = _classes().get(name)
    if home is None:
        message = f"module {__name__!r} has no attribute {name!r}"
        if name.startswith("_"):
            raise AttributeError(message)
        unknown = import_module("rockeom.numbers.explained").UnknownAttributeError
        raise unknown(message, name, _offers)
    value = getattr(import_module(home), name)
    globals()[name] = value  # found directly from now on
    return value


def __dir__() -> list[str]:
    """The public names, without those that this file needs for itself."""
    dunder = (name for name in globals() if name.startswith("__"))
    return sorted({*dunder, *_NAMESPACES, *__getattr__("__all__")})
