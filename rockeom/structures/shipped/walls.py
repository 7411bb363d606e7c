"""Controlled rocking walls: their constructors, their tendon, and their equilibrium."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, ClassVar, NamedTuple, Protocol

import numpy as np

from rockeom.motion.units import STANDARD_GRAVITY
from rockeom.numbers.checks import InputError, InputTypeError, number
from rockeom.numbers.dual import value_of
from rockeom.structures.declared import StructureWithFields
from rockeom.structures.declared_modes import margin


class TendonedWall(Protocol):
    """The properties of a wall, such as a `rockeom.analysis.Wall`, from which a class is made."""

    @property
    def mass(self) -> float: ...
    @property
    def height(self) -> float: ...
    @property
    def half_width(self) -> float: ...
    @property
    def centroid_height(self) -> float: ...
    @property
    def corner_inertia(self) -> float: ...
    @property
    def fixed_base_period(self) -> float: ...
    @property
    def gravity(self) -> float: ...
    @property
    def rotation_centre(self) -> Any: ...
    @property
    def tendons(self) -> tuple[Any, ...]: ...
    def moment_of_inertia(self, detached_length: Any) -> Any: ...


class ThesisCentre(NamedTuple):
    """How the rotation centre moves out from the centreline, as printed in thesis 4-7 [m]."""

    C1: float = 0.412
    C2: float = 0.096
    epsilon: float = 3.551e-3


class ThesisTendon(NamedTuple):
    """The tendon of thesis chapter 4, at one of its initial forces [N].

    The thesis states x1 = 6.4564 mm at 75.6 kN between anchors 3100 mm apart, a yield extension of
    13.5814 mm and F_y = 159.03 kN. E = 205 GPa and A = 176.7 mm2 are inferred: they give all of
    these, the 177 mm2 of 4.2 does not. The stiffness is that at 75.6 kN for any initial force, as
    4-44 has it.
    """

    initial_force: float = 75.6e3
    stiffness: float = (205e9 * 176.7e-6 + 75.6e3) / 3.1
    yield_force: float = 900e6 * 176.7e-6
    eccentricity: float = 0.0


@dataclass(frozen=True)
class ThesisWall:
    """The wall of thesis chapter 4; initial_force of its tendon 75.6 kN or 111 kN [N].

    The height of 2.438 m is inferred: with it the energies under Figure 4-29, the drifts of 4.5 and
    the restitution 0.835 of 4.9.2.1 agree.
    """

    initial_force: float = 75.6e3
    height: float = 2.438
    centroid_height: float = 2.173
    panel_mass: float = 577.56
    added_mass: float = 1438.5
    added_height: float = 2.537
    own_inertia: float = 686.0 + 442.0
    fixed_base_period: float = 0.0428
    gravity: float = STANDARD_GRAVITY
    rotation_centre: ClassVar[ThesisCentre] = ThesisCentre()

    @property
    def tendons(self) -> tuple[ThesisTendon]:
        return (ThesisTendon(self.initial_force),)

    @property
    def mass(self) -> float:
        """m of wall and added mass [kg]."""
        return self.panel_mass + self.added_mass

    @property
    def half_width(self) -> float:
        """B of the base [m]."""
        return self.rotation_centre.C1 + self.rotation_centre.C2

    def moment_of_inertia(self, detached_length: float) -> float:
        """I_o about the rotation centre [kg m2] at a detached length d of the base [m]; B-9."""
        d = detached_length
        panel = self.panel_mass / 3 * (self.height**2 + d**2)
        added = self.added_mass * (self.added_height**2 + (d - self.half_width) ** 2)
        return self.own_inertia + panel + added

    @property
    def corner_inertia(self) -> float:
        """I_o about a corner of the base [kg m2]."""
        return self.moment_of_inertia(2 * self.half_width)


def of_wall(what: str, wall: TendonedWall) -> dict[str, float]:
    """The parameters that all classes of walls share, of a wall with one tendon."""
    if isinstance(wall, type) or not hasattr(wall, "tendons"):
        raise InputTypeError("wall", wall).give("a wall, such as rockeom.analysis.Wall.thesis()")
    if len(wall.tendons) != 1:
        raise InputError("wall", wall).says(
            f"{what} has one tendon, the wall has {len(wall.tendons)}: for several derive a model, "
            "rockeom.symbolic.controlled_wall"
        )
    (tendon,) = wall.tendons
    return {
        "mass": wall.mass,
        "height": wall.height,
        "half_width": wall.half_width,
        "edge_distance": wall.rotation_centre.C2,
        "transition": wall.rotation_centre.epsilon,
        "tendon_stiffness": tendon.stiffness,
        "initial_force": tendon.initial_force,
        "yield_force": tendon.yield_force,
        "eccentricity": tendon.eccentricity,
        "gravity": wall.gravity,
    }


class RockingWall(StructureWithFields):
    """A wall whose tendon is elastic, yields, or is slack."""

    def __post_init__(self) -> None:
        what, values = type(self).__name__, self.parameters()
        for name, most in (("initial_force", "yield_force"), ("edge_distance", "half_width")):
            if not values[name] < values[most]:
                raise InputError(name, values[name], what).hold(
                    f"it must be below {most}, {values[most]}"
                )

    @property
    def speed_height(self) -> float:
        """Height of the point whose speed impact laws mean [m]."""
        return self.parameters()["height"]

    def state(self, values: Mapping[str, float]) -> np.ndarray:
        """State vector of named values; beyond yield on the way back the tendon has been drawn out.

        Parameters
        ----------
        values : dict of str to float
            Values of states by name; others are zero. A permanent_extension that is not named is
            then the one that leaves the yield force.

        Returns
        -------
        ndarray
            State (N,).

        Raises
        ------
        ValueError
            For unknown names, NaN, and a state that no rotation has.
        """
        y = super().state(values)
        self.check_reach(y)
        if "permanent_extension" in values:
            return y
        y = y.astype(np.result_type(y, self.vector))
        m, parameters = self.module, self.parameters()
        side = "left" if (y[m.ROTATION] or y[m.ROTATION_RATE]) < 0 else "right"
        beyond = self._elastic_force(side, y) - parameters["yield_force"]
        if beyond > 0.0:
            yielding = m.MODES.index(f"{side}_yield")
            if margin(m, value_of(self.vector), yielding, y) < 0.0:
                extension = beyond / parameters["tendon_stiffness"]
                y[m.STATES.index("permanent_extension")] = extension
        return y

    def check_reach(self, y: np.ndarray) -> None:
        """Check that a rotation has a state.

        Parameters
        ----------
        y : ndarray
            State (N,).

        Raises
        ------
        ValueError
            For a state that no rotation has.
        """

    def _elastic_force(self, side: str, y: np.ndarray) -> float:
        """Force of the tendon [N], if it neither yields nor is slack."""
        m = self.module_for(y, self.vector)
        forces = np.empty(len(m.REACTIONS), np.result_type(y, self.vector))
        m.reactions(m.MODES.index(side), y, self.vector, 0.0, 0.0, forces)
        return number("tendon_force", forces[m.REACTIONS.index("tendon_force")])

    def pushover(self, rotations) -> np.ndarray:
        """Force at the load point that holds the wall at each rotation, or displacement.

        Parameters
        ----------
        rotations : array_like
            Values of the model's first state, any shape. Each is reached from upright by a growing
            rotation: a tendon that yields has its yield force.

        Returns
        -------
        ndarray
            Force [N], in the shape of the rotations.

        Raises
        ------
        ValueError
            Where there is no equilibrium.
        """
        return super().pushover(rotations)

    def equilibrium(self, rotation: float) -> tuple[float, np.ndarray]:
        m = self.module
        y = np.zeros(m.N_STATES)
        y[m.ROTATION] = rotation
        side = "left" if rotation < 0 else "right"
        elastic, yield_force = self._elastic_force(side, y), self.parameters()["yield_force"]
        mode = "_yield" if elastic > yield_force else "_slack" if elastic < 0 else ""
        return self.load(m.MODES.index(side + mode), y), y

    def load(self, mode: int, y: np.ndarray) -> float:
        """Force with which the rotation of a state is in equilibrium.

        Parameters
        ----------
        mode : int
            Number of the mode.
        y : ndarray
            State (N,).

        Returns
        -------
        float
            Force at the load point [N].
        """
        row = self.module.ROTATION
        none = self.lacking(mode, y, 0.0)[row]
        load = 1.0 + abs(none)  # the digits of one newton might be lost next to the other forces
        return float(load * (none / (none - self.lacking(mode, y, load)[row])))

    def lacking(self, mode: int, y: np.ndarray, load: float) -> np.ndarray:
        """Force that each coordinate lacks of equilibrium under a load.

        Parameters
        ----------
        mode : int
            Number of the mode.
        y : ndarray
            State (N,).
        load : float
            Force at the load point [N].

        Returns
        -------
        ndarray
            Forces (n,) [N].
        """
        out = np.empty(len(y) // 2)
        self.module.statics(mode, y, self.vector, load, out)
        return out
