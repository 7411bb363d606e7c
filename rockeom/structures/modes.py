"""The file that determines the modes of a structure: `declared_modes` or `searched_modes`."""

from collections.abc import Callable, Mapping
from functools import cache
from typing import Any, Protocol

import numpy as np

from rockeom.integrator.schema import has_points
from rockeom.structures import declared_modes, searched_modes
from rockeom.structures.statics import Equilibrium


class Modes(Protocol):
    """Functions of a generated module, a state y (N,) and p, the parameters and constants."""

    def completed(
        self, module: Any, y: np.ndarray, p: np.ndarray, named: Mapping[str, Any], /
    ) -> np.ndarray:
        """The state with what is not named put so that the structure can be in it."""
        ...

    def mode_of(
        self, module: Any, y: np.ndarray, p: np.ndarray, towards: Callable[[], float], /
    ) -> int:
        """Number of the mode of a state; raises ValueError where it fits none."""
        ...

    def named_mode(self, module: Any, mode: Any, y: np.ndarray, p: np.ndarray, /) -> int:
        """Number of the mode of a name; raises ValueError where the state contradicts it."""
        ...

    def mode_under_forces(
        self, module: Any, mode: int, y: np.ndarray, p: np.ndarray, ground: tuple[float, ...], /
    ) -> int:
        """The mode in which a state of a mode goes on under accelerations of the ground."""
        ...

    def equilibrium(self, module: Any, p: np.ndarray, rotation: float, /) -> Equilibrium:
        """(force, state) at rest under the force at the load point that holds a rotation [N]."""
        ...

    def subjects(
        self, module: Any, events: np.ndarray, states: np.ndarray, p: np.ndarray, /
    ) -> list[str]:
        """The points, or the element, of each event, joined by "+"; empty where modes say all."""
        ...


@cache
def modes_of(module: Any) -> Modes:
    """The functions that find the modes of a module's structures."""
    return searched_modes if has_points(module) else declared_modes
