"""Demands on a structure that rocks, and on the same structure on a fixed base.

    from rockeom import analysis

    found = analysis.compare_with_fixed_base(column, motion, impact=rk.EnergyRatio(0.74))
    found.rocking.base_shear / found.fixed.base_shear

Source: thesis section 5.3.3.1, Figure 5-45.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import NamedTuple

from rockeom.motion import GroundMotion
from rockeom.numbers import explained
from rockeom.numbers.checks import InputError, require_type
from rockeom.simulation.options import SolverOptions
from rockeom.simulation.response import Response
from rockeom.simulation.simulate import simulate
from rockeom.simulation.works import EnergyBalance
from rockeom.structures.base import Structure
from rockeom.structures.impact_laws import ImpactLaw


class Demands(NamedTuple):
    """Largest absolute values in a response.

    base_shear [N] : horizontal force of the ground. base_moment [N m] : of the ground's forces
    about the middle of the base, as `Response.support.base_moment`; nan where it is unknown.
    displacement [m] : of the load point, deformation and rocking together. deformations [m] : of
    the coordinates besides the rotation, by name. uplift [m] : of either foot.
    """

    base_shear: float
    base_moment: float
    displacement: float
    deformations: dict[str, float]
    uplift: float


@dataclass(frozen=True, eq=False)
class Isolation:
    """Responses of a structure that rocks and of the same on a fixed base, under one motion."""

    rocking_run: Response
    fixed_run: Response

    @property
    def rocking(self) -> Demands:
        """The demands on the structure that rocks."""
        return demands(self.rocking_run)

    @property
    def fixed(self) -> Demands:
        """The demands on the structure on a fixed base."""
        return demands(self.fixed_run)

    @property
    def ratios(self) -> dict[str, float]:
        """Base shear, base moment and displacement: rocking over fixed."""
        return {
            name: getattr(self.rocking, name) / getattr(self.fixed, name)
            for name in ("base_shear", "base_moment", "displacement")
        }


@explained.calls()
def compare_with_fixed_base(
    structure: Structure,
    motion: GroundMotion,
    *,
    impact: ImpactLaw | None = None,
    duration: float | None = None,
    options: SolverOptions | None = None,
) -> Isolation:
    """The same structure, rocking and on a fixed base, under the same motion.

    structure, motion, duration [s], options : as in `simulate`. impact : impact law of the
    structure that rocks, as in `simulate`.

    Raises ValueError for a structure that has no fixed base, see `Structure.fixed_base`.

    Over the scale of a record:

    >>> found = [compare_with_fixed_base(column, record.scaled(a)) for a in (1, 2, 4)]
    >>> [one.ratios["base_shear"] for one in found]
    """
    require_type("structure", structure, Structure, "one such as FlexibleStructure(...)")
    fixed = structure.fixed_base()
    return Isolation(
        simulate(structure, motion, impact=impact, duration=duration, options=options),
        simulate(fixed, motion, duration=duration, options=options),
    )


def demands(run: Response) -> Demands:
    """The largest forces and displacements of a response `run`, found within its steps.

    Raises ValueError for a response without forces on feet.
    """
    if "left_uplift" not in run.names:
        raise InputError("run").told(
            f"{run.structure.model} has no feet: its response has no base shear and no uplift"
        )
    rotation = run.structure.module.ROTATION
    coordinates = run.states[: run.structure.module.N_STATES // 2]
    moment = run.support.base_moment
    return Demands(
        base_shear=abs(run.extremes("horizontal_reaction").peak),
        base_moment=math.nan if moment is None else abs(moment.peak),
        displacement=abs(run.extremes("displacement").peak),
        deformations={
            name: abs(run.extremes(name).peak)
            for i, name in enumerate(coordinates)
            if i != rotation
        },
        uplift=max(run.extremes(f"{foot}_uplift").maximum for foot in ("left", "right")),
    )


@explained.calls()
def energy_balance(run: Response) -> EnergyBalance:
    """The energies of a response `run`: work and losses by quadrature, and those of its states.

    Work and losses are integrals over the steps, the energies those of the states at the ends:
    their difference measures the accuracy of the integration. The same as `run.energy_balance()`.
    """
    require_type("run", run, Response, "the response of rk.simulate")
    return run.energy_balance()
