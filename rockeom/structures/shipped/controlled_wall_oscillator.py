"""The controlled wall as an oscillator: its energy ratio of the speed, and the speed of a start."""

import dataclasses
import math
from collections.abc import Mapping
from typing import Any, Self

import numpy as np

from rockeom.numbers.checks import InputError, InputTypeError, number
from rockeom.numbers.functions import mathematics
from rockeom.structures.impact_laws import EnergyRatioAtSpeed
from rockeom.structures.shipped.declarations import controlled_wall_oscillator as declared
from rockeom.structures.shipped.tendoned_wall import Wall
from rockeom.structures.shipped.walls import RockingWall, of_wall

_PIECES = 4


class ControlledWallOscillator(RockingWall, declared.ControlledWallOscillator):
    not_numbers = frozenset({"energy_ratio", "held"})
    energy_ratio: float | EnergyRatioAtSpeed
    held: bool = True

    def __post_init__(self) -> None:
        if not isinstance(self.held, bool | np.bool_):
            raise InputTypeError("held", self.held, "ControlledWallOscillator").give(
                "True or False"
            )
        if not isinstance(self.energy_ratio, EnergyRatioAtSpeed):
            if not 0 < number("energy_ratio", self.energy_ratio, type(self).__name__) <= 1:
                raise InputError(
                    "energy_ratio", self.energy_ratio, "ControlledWallOscillator"
                ).hold("it must lie between 0 and 1")
        elif len(self.energy_ratio.pieces) > _PIECES:
            raise InputError("energy_ratio", of="ControlledWallOscillator").wrong(
                f"has {len(self.energy_ratio.pieces)} pieces: at most {_PIECES}"
            )
        super().__post_init__()

    @classmethod
    def from_wall(
        cls,
        wall: Wall,
        energy_ratio: float | EnergyRatioAtSpeed,
        held: bool = True,
        regularisation: float | None = None,
        effective_mass: float | None = None,
    ) -> Self:
        """Wall of `rockeom.analysis` as an equivalent oscillator.

        Parameters
        ----------
        wall : Wall
            Wall with one tendon.
        energy_ratio : float or EnergyRatioAtSpeed
            Energy ratio r of a passage, or its dependence on the speed.
        held : bool, optional
            Whether r is that of the speed of the whole passage.
        regularisation : float, optional
            Width of a passage [m]; the wall's epsilon if not given, as in 4.8.
        effective_mass : float, optional
            Mass of the oscillator [kg]; the wall's if not given.

        Returns
        -------
        ControlledWallOscillator
            Oscillator.
        """
        return cls(
            **of_wall(cls.__name__, wall),
            regularisation=regularisation or wall.rotation_centre.epsilon,
            energy_ratio=energy_ratio,
            held=held,
            effective_mass=effective_mass,
        )

    @classmethod
    def thesis(
        cls,
        energy_ratio: float | EnergyRatioAtSpeed,
        initial_force: float = 75.6e3,
        held: bool = True,
    ) -> Self:
        """Wall of thesis chapter 4 as an equivalent oscillator.

        Parameters
        ----------
        energy_ratio : float or EnergyRatioAtSpeed
            Energy ratio r of a passage, or its dependence on the speed.
        initial_force : float, optional
            Initial force of its tendon, 75.6 kN or 111 kN [N].
        held : bool, optional
            Whether r is that of the speed of the whole passage.

        Returns
        -------
        ControlledWallOscillator
            Oscillator.
        """
        return cls.from_wall(Wall.thesis(initial_force), energy_ratio, held)

    @property
    def jumps_between_events(self) -> bool:
        """Where the ratio follows the speed of the instant, in pieces that need not meet."""
        law = self.energy_ratio
        return not self.held and isinstance(law, EnergyRatioAtSpeed) and len(law.pieces) > 1

    def parameters(self) -> dict[str, float]:
        values = {f.name: getattr(self, f.name) for f in dataclasses.fields(self)}
        law = values.pop("energy_ratio")
        pieces = law.pieces if isinstance(law, EnergyRatioAtSpeed) else ((math.inf, law, 0.0),)
        for i, piece in enumerate((*pieces, *pieces[-1:] * (_PIECES - len(pieces)))):
            values |= dict(zip(_of_piece(i), piece, strict=True))
        mass = values["effective_mass"]
        values["held"] = float(self.held)
        return values | {"effective_mass": self.mass if mass is None else mass}

    def parameter_at(self, path: tuple[Any, ...]) -> str:
        if path[:2] == ("energy_ratio", "pieces"):
            name = _of_piece(path[2])[path[3]]
            return name if name in self.module.PARAMETERS else ""
        return "energy_ratio" if path == ("energy_ratio",) else super().parameter_at(path)

    def check_reach(self, y: np.ndarray) -> None:
        """Check that a rotation has the displacement of a state.

        Parameters
        ----------
        y : ndarray
            State (N,).

        Raises
        ------
        ValueError
            For a displacement beyond the height.
        """
        if not abs(y[0]) < self.height:
            raise InputError("u", y[0]).says(
                f"state u is {y[0]}, beyond the height of {self.height:.6g} m: u/height is the "
                "sine of the rotation"
            )

    def state(self, values: Mapping[str, float]) -> np.ndarray:
        """State vector of named values; a passage_speed that is not named is that of the energy
        there is.

        Parameters
        ----------
        values : dict of str to float
            Values of states by name; others are zero.

        Returns
        -------
        ndarray
            State (N,).

        Raises
        ------
        ValueError
            For unknown names, NaN, and a displacement that no rotation has.
        """
        y = super().state(values)
        if "passage_speed" not in values:
            y = y.astype(np.result_type(y, self.vector))
            upright = np.zeros_like(y)
            upright[1] = y[1]
            m = self.module_for(y, self.vector)
            energy = np.empty((2, len(m.ENERGIES)), np.result_type(y, self.vector))
            for at, row in zip((y, upright), energy, strict=True):
                m.energies(self.mode_number(at), at, self.vector, row)
            kinetic = max(number("energy", energy[0].sum() - energy[1].sum()), 0.0)
            y[m.STATES.index("passage_speed")] = mathematics.sqrt(
                2 * kinetic / self.parameters()["effective_mass"]
            )
        return y


def _of_piece(i: int) -> tuple[str, str, str]:
    """Limit, r at no speed and slope of a piece, as the equations have them."""
    ratio = f"energy_ratio_{i + 1}" if i else "energy_ratio"
    return f"speed_limit_{i + 1}", ratio, f"energy_ratio_slope_{i + 1}"
