"""Demands on a structure that rocks, and on the same structure on a fixed base.

    from rockeom import analysis

    found = analysis.compare_with_fixed_base(column, motion, impact=rk.EnergyRatio(0.74))
    found.rocking.base_shear / found.fixed.base_shear

Source: thesis section 5.3.3.1, Figure 5-45.
"""

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

    Parameters
    ----------
    base_shear : float
        Horizontal force of the ground [N].
    base_moment : float
        Moment of the ground's forces about the middle of the base, as
        `Response.support.base_moment` [N m]; NaN where it is unknown.
    displacement : float
        Displacement of the load point, deformation and rocking together [m].
    deformations : dict of str to float
        Deformations, the coordinates besides the rotation, by name [m].
    uplift : float
        Uplift of either foot [m].
    """

    base_shear: float
    base_moment: float
    displacement: float
    deformations: dict[str, float]
    uplift: float


@dataclass(frozen=True, eq=False)
class Isolation:
    """Responses of a structure that rocks and of the same on a fixed base, under one motion.

    Parameters
    ----------
    rocking_run : Response
        Response of the structure that rocks.
    fixed_run : Response
        Response on a fixed base.
    """

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
    """Compare a structure that rocks with the same on a fixed base, under one motion.

    Parameters
    ----------
    structure : Structure
        Structure that rocks and has a fixed base, see `Structure.fixed_base`.
    motion : GroundMotion
        Horizontal ground motion.
    impact : ImpactLaw, optional
        Impact law of the structure that rocks; its default if not given.
    duration : float, optional
        Duration [s]; the motion's own if not given.
    options : SolverOptions, optional
        Choices of the integration.

    Returns
    -------
    Isolation
        Both responses, with their demands and the ratios of these.

    Raises
    ------
    ValueError
        For a structure that has no fixed base.

    Examples
    --------
    >>> import rockeom as rk
    >>> from rockeom import analysis
    >>> column = rk.FlexibleStructure(
    ...     mass=122.6, height=1.05, inertia=44.8, base_mass=45.6, base_height=0.1,
    ...     base_inertia=1.37, half_width=0.285, stiffness=571.8e3, damping=502.4,
    ... )  # kg, m, kg m2, N/m, N s/m
    >>> pulse = rk.GroundMotion.single_sine(amplitude=3.5, period=0.4, duration=4.0)  # m/s2, s
    >>> both = analysis.compare_with_fixed_base(column, pulse, impact=rk.Impulsive())
    >>> sorted(both.ratios)[:2]
    ['base_moment', 'base_shear']

    Over the scale of a record:

    >>> isolations = [
    ...     analysis.compare_with_fixed_base(column, pulse.scaled(a), impact=rk.Impulsive())
    ...     for a in (0.5, 1.0)
    ... ]
    >>> len([isolation.ratios["base_shear"] for isolation in isolations])
    2
    """
    require_type("structure", structure, Structure, "one such as FlexibleStructure(...)")
    fixed = structure.fixed_base()
    return Isolation(
        simulate(structure, motion, impact=impact, duration=duration, options=options),
        simulate(fixed, motion, duration=duration, options=options),
    )


def demands(run: Response) -> Demands:
    """Largest forces and displacements of a response, within its steps too.

    Parameters
    ----------
    run : Response
        Response of a structure on feet.

    Returns
    -------
    Demands
        Largest absolute values.

    Raises
    ------
    ValueError
        For a response without forces on feet.
    """
    if "left_uplift" not in run.names:
        raise InputError("run").says(
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
    """Energies of a response: work and losses by quadrature, and those of its states.

    The same as ``run.energy_balance()``.

    Parameters
    ----------
    run : Response
        Response with all its steps.

    Returns
    -------
    EnergyBalance
        Work and losses [J], integrals over the steps, and the energies of the states at the ends:
        their difference measures the accuracy of the integration.

    Raises
    ------
    TypeError
        For anything but a response.
    """
    require_type("run", run, Response, "the response of rk.simulate")
    return run.energy_balance()
