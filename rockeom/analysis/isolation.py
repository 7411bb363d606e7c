"""What rocking does for a structure: its demands beside those of the same structure held down.

    from rockeom import analysis

    beside = analysis.beside_fixed_base(column, motion, impact=rk.EnergyRatio(0.74))
    beside.rocking.base_shear / beside.fixed.base_shear

Source: thesis section 5.3.3.1, Figure 5-45.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from rockeom.arguments import told

if TYPE_CHECKING:
    from rockeom.motion import GroundMotion
    from rockeom.numeric.impact import ImpactLaw
    from rockeom.numeric.options import SolverOptions
    from rockeom.numeric.response import Response
    from rockeom.numeric.structures import Structure

_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(5)
"""Of the quadrature within a step, a polynomial of degree 7, under a straight law of the ground."""


class Demands(NamedTuple):
    """The largest of each in a response, whatever its sign.

    base_shear [N] : horizontal force of the ground. base_moment [N m] : of the ground's forces
    about the middle of the base, as `Response.base_moment`; nan where that is unknown.
    displacement [m] : of the load point, deformation and rocking together. deformations [m] : of
    the coordinates besides the rotation, by name. uplift [m] : of either foot.
    """

    base_shear: float
    base_moment: float
    displacement: float
    deformations: dict[str, float]
    uplift: float


class EnergyBalance(NamedTuple):
    """Where the energy of a response came from and went, in joules.

    input : work of the shaking on the masses, seen from the ground that moves. damping : lost in
    dampers and by yielding, less the work of forces that are declared by themselves (`Force`).
    impacts : lost at impacts. gained : energy at the end less that at the start.
    error : what input - damping - impacts - gained leaves, over the largest of them.
    """

    input: float
    damping: float
    impacts: float
    gained: float
    error: float


@dataclass(frozen=True)
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
        """The demands on the structure whose feet are held down."""
        return demands(self.fixed_run)

    @property
    def ratios(self) -> dict[str, float]:
        """Base shear, base moment and displacement: rocking over fixed."""
        return {
            name: getattr(self.rocking, name) / getattr(self.fixed, name)
            for name in ("base_shear", "base_moment", "displacement")
        }


def beside_fixed_base(
    structure: Structure,
    motion: GroundMotion,
    *,
    impact: ImpactLaw | None = None,
    duration: float | None = None,
    options: SolverOptions | None = None,
) -> Isolation:
    """The same structure, rocking and on a fixed base, under the same motion.

    structure, motion, duration [s], options : as in `simulate`. impact : law of the structure that
    rocks, as there.

    Raises ValueError for a structure that has no fixed base, see `Structure.fixed_base`.

    Over the scale of a record:

    >>> found = [beside_fixed_base(column, record.scaled(a)) for a in (1, 2, 4)]
    >>> [one.ratios["base_shear"] for one in found]
    """
    from rockeom.numeric.simulate import simulate
    from rockeom.numeric.structures import Structure

    if not isinstance(structure, Structure):
        raise TypeError(f"structure is {told(structure)}: give one such as FlexibleStructure(...)")
    held = structure.fixed_base()
    return Isolation(
        simulate(structure, motion, impact=impact, duration=duration, options=options),
        simulate(held, motion, duration=duration, options=options),
    )


def demands(run: Response) -> Demands:
    """The largest forces and displacements of a response `run`, found within its steps.

    Raises ValueError for a response without forces on feet.
    """
    if "left_uplift" not in run.names:
        raise ValueError(
            f"{run.structure.model} has no feet: its response tells no base shear and no uplift"
        )
    rotation = run.program.ROTATION
    coordinates = run.states[: run.program.N_STATES // 2]
    moment = run.base_moment
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


def energy_balance(run: Response) -> EnergyBalance:
    """The energy of a response `run` by quadrature of its motion, beside that of its states.

    Work and losses are integrals over the steps, the energies those of the states at the ends:
    the error tells how well the motion was integrated. Structures whose contacts or elements are
    declared know their losses; of others the damping is that of one column, the parameter
    `damping` [N s/m] on the state `u`.

    Raises ValueError for a structure with other dampers, whose losses are not known, or one that
    knows no momentum.
    """
    parameters = run.structure.parameters()
    told = hasattr(run.program, "losses")
    others = [n for n, v in parameters.items() if "damping" in n and n != "damping" and v]
    others *= not told
    if others or not hasattr(run.program, "momentum") or len(run.program.ENERGIES) != 3:
        raise ValueError(
            f"the energy balance of {run.structure.model} is not known: it is for structures on "
            f"rigid ground with the damping of one column{', and not ' * bool(others)}"
            f"{', '.join(others)}"
        )
    work, lost = _work(run, parameters.get("damping", 0.0))
    impacts = sum(
        _energy(run, e.before, e.phase_before) - _energy(run, e.after, e.phase_after)
        for e in run.events
    )
    start = dict(zip(run.states, run.steps.powers[0, 0].tolist(), strict=True))
    contacts = run.program.CONTACTS
    at_end = contacts[run.steps.contact[-1]]
    if run.events and run.events[-1].time >= float(run.steps.span[-1].sum()) * (1.0 - 1e-15):
        at_end = run.events[-1].phase_after  # the last step ended with it
    gained = _energy(run, run.final, at_end) - _energy(run, start, contacts[run.steps.contact[0]])
    left = work - lost - impacts - gained
    largest = max(abs(work), abs(lost), abs(impacts), abs(gained))
    return EnergyBalance(work, lost, impacts, gained, abs(left) / largest if largest else 0.0)


def _work(run: Response, damping: float) -> tuple[float, float]:
    """Work of the shaking and energy lost in dampers and the like [J], by quadrature."""
    starts, lengths = run.steps.span.T
    index = np.repeat(np.arange(len(starts)), len(_NODES))
    x = np.tile(0.5 * (1.0 + _NODES), len(starts))
    weights = 0.5 * lengths[index] * np.tile(_WEIGHTS, len(starts))
    y = run.steps.states(index, x)
    t = starts[index] + x * lengths[index]
    momentum = np.zeros((len(t), 2))
    for contact, state, out in zip(run.steps.contact[index], y, momentum, strict=True):
        run.program.momentum(contact, state, run.structure.vector, out)
    power = -momentum[:, 0] * run.motion.acceleration(t)
    if run.vertical is not None:
        power -= momentum[:, 1] * run.vertical.acceleration(t)
    lost = 0.0
    if hasattr(run.program, "losses"):
        powers = np.zeros((len(t), 1))
        for contact, state, out in zip(run.steps.contact[index], y, powers, strict=True):
            run.program.losses(contact, state, run.structure.vector, out)
        lost = float(weights @ powers[:, 0])
    elif damping:
        lost = damping * float(weights @ y[:, run.states.index("u_dot")] ** 2)
    return float(weights @ power), lost


def _energy(run: Response, state: dict[str, float], phase: str) -> float:
    """Kinetic, gravitational and elastic energy together [J]."""
    return sum(run.structure.energies(state, phase=phase).values())
