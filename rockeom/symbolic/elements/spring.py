"""`Spring`: a spring and damper that always act."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import ClassVar, Self

import sympy as sp

from rockeom.numbers import explained
from rockeom.symbolic import valid
from rockeom.symbolic.lagrange import rate
from rockeom.symbolic.model import Coordinate


@explained.record()
@dataclass(frozen=True)
class Spring:
    """Spring and damper that always act: a storey's columns, a bearing, a tendon that is tight.

    The force is P + k d + c d', positive where it resists that the deformation d grows. The elastic
    energy and the dissipation of the structure follow from it, and a response has it by name:
    NAME_deformation, NAME_force, NAME_energy and NAME_loss.

    Parameters
    ----------
    name : str
        Name of the element, by which a response has its quantities.
    deformation : sympy.Expr
        Deformation d, a function of the coordinates, on whose rise the force does work -(P + k d +
        c d').
    stiffness : sympy.Expr, optional
        Stiffness k [N/m].
    damping : sympy.Expr, optional
        Coefficient c [N s/m].
    initial_force : sympy.Expr, optional
        Force P [N], of either sign, where d is zero. Its energy is the one that it gives back when
        it is let loose.
    mirrored : str, optional
        Name where s = -1 in a mode that is written with the side s, if not the same.

    Raises
    ------
    ValueError
        For anything but expressions, and for a negative stiffness or damping.

    Examples
    --------
    >>> import sympy as sp
    >>> from rockeom.symbolic import Spring
    >>> u_1, u_2, k_2, c_2 = sp.symbols("u_1 u_2 k_2 c_2")
    >>> storey = Spring("storey_2", u_2 - u_1, stiffness=k_2, damping=c_2)
    """

    name: str
    deformation: sp.Expr
    stiffness: sp.Expr = sp.S.Zero
    damping: sp.Expr = sp.S.Zero
    initial_force: sp.Expr = sp.S.Zero
    mirrored: str = ""

    positive: ClassVar = frozenset[str]()

    def __post_init__(self) -> None:
        what = f"element {self.name!r}"
        valid.texts(what, name=self.name, mirrored=self.mirrored)
        valid.expressions(
            what, deformation=self.deformation, initial_force=self.initial_force, **self.constants
        )
        valid.not_negative(what, **self.constants)

    @property
    def constants(self) -> dict[str, sp.Expr]:
        """Its constants by name, which must not be negative."""
        return {"stiffness": self.stiffness, "damping": self.damping}

    @property
    def displacement(self) -> sp.Expr:
        """The displacement on whose rise the force does negative work."""
        return self.deformation

    @property
    def output_displacement(self) -> sp.Expr:
        """The displacement that a response has by its name."""
        return self.deformation

    def called(self, side: int) -> str:
        """Its name on a side, -1, 0 or 1."""
        return self.mirrored or self.name if side < 0 else self.name

    def changed(self, change: Callable[[sp.Expr], sp.Expr]) -> Self:
        """It in other coordinates."""
        return replace(self, deformation=change(sp.sympify(self.deformation)))

    def still_force(self, chi: sp.Expr = sp.S.One) -> sp.Expr:
        """The force where nothing moves."""
        return self.initial_force + self.stiffness * self.deformation

    def force(self, chi: sp.Expr, coordinates: tuple[Coordinate, ...]) -> sp.Expr:
        """The force of the state chi, with the rates of the coordinates."""
        return self.still_force(chi) + self.damping * rate(self.deformation, coordinates)

    def energy(self, chi: sp.Expr = sp.S.One) -> sp.Expr:
        """The energy that it stores in the state chi."""
        if self.initial_force == 0:
            return self.stiffness * sp.sympify(self.deformation) ** 2 / 2
        if self.stiffness == 0:
            return self.initial_force * self.deformation
        return self.still_force(chi) ** 2 / (2 * self.stiffness)

    def dissipation(self, coordinates: tuple[Coordinate, ...]) -> sp.Expr:
        """Its part of Rayleigh's function, half the power lost in its damper."""
        return self.damping * rate(self.deformation, coordinates) ** 2 / 2

    def loss(self, chi: sp.Expr, coordinates: tuple[Coordinate, ...]) -> sp.Expr:
        """Power lost."""
        return 2 * self.dissipation(coordinates)
