"""`IsolatedBlocks`: objects on one base that moves on an isolator."""

from __future__ import annotations

import functools
import math
from collections.abc import Sequence
from typing import Any, ClassVar, Self

from rockeom.integrator.schema import GeneratedModule
from rockeom.modelling.declared import module_of
from rockeom.motion.units import STANDARD_GRAVITY
from rockeom.numbers.checks import InputError, InputTypeError
from rockeom.structures.declared import StructureWithFields
from rockeom.structures.parameters import check_contact_law, check_values
from rockeom.structures.shipped.rigid_block import RigidBlock


class IsolatedBlocks(StructureWithFields):
    """Rigid blocks, side by side on one base that moves horizontally on a spring and a damper.

    The states are the displacement `u` of the base relative to the ground, and of each block its
    place `x` on the base and its height `y` above it [m], and `theta`, with their rates; of several
    blocks `x_1`, `y_1`, `theta_1`, `x_2` and so on. Blocks do not strike each other.

    Parameters
    ----------
    blocks : sequence of RigidBlock
        Blocks.
    base_mass : float
        Mass of the base [kg].
    isolator_stiffness : float
        Stiffness of the isolator [N/m].
    isolator_damping : float
        Damping of the isolator [N s/m].
    friction : float
        Coefficient of friction between blocks and base.
    restitution : float, optional
        Ratio of the rates of a foot's gap after and before it lands alone, 0 to 1.
    contact_law : str, optional
        Impact law of feet that touch, as of `Sliding`.
    gravity : float, optional
        Acceleration of gravity [m/s2].

    Raises
    ------
    InputError
        For no blocks, and for numbers out of their ranges.

    References
    ----------
    Vassiliou and Makris (2012), Earthquake Engineering and Structural Dynamics 41, 823-840.

    Examples
    --------
    >>> import rockeom as rk
    >>> vase = rk.RigidBlock.from_dimensions(width=0.3, height=0.9, mass=40.0)
    >>> isolated = rk.IsolatedBlocks.from_period(
    ...     [vase], base_mass=120.0, period=2.5, damping_ratio=0.15, friction=0.6
    ... )
    >>> isolated.states[:4]
    ('u', 'x', 'y', 'theta')
    """

    model: ClassVar[str] = "isolated_blocks"
    may_vanish = frozenset({"friction", "restitution", "isolator_damping"})
    not_numbers = frozenset({"blocks", "contact_law"})
    blocks: Sequence[RigidBlock]
    base_mass: float
    isolator_stiffness: float
    isolator_damping: float
    friction: float
    restitution: float = 0.0
    contact_law: str = "newton"
    gravity: float = STANDARD_GRAVITY

    def __post_init__(self) -> None:
        object.__setattr__(self, "blocks", _checked(self.blocks))
        for one in self.blocks:
            if one.gravity != self.gravity:
                raise InputError("gravity", self.gravity, "IsolatedBlocks").give(
                    f"that of the blocks, {one.gravity:g} m/s2"
                )
        check_contact_law("IsolatedBlocks", self.restitution, self.contact_law)

    @classmethod
    def from_period(
        cls, blocks: Sequence[RigidBlock], *, base_mass: float, period: float,
        damping_ratio: float, **others: Any,
    ) -> Self:  # fmt: skip
        """Blocks on an isolator of a period and a damping ratio, of base and blocks that stand.

        Parameters
        ----------
        blocks : sequence of RigidBlock
            Blocks.
        base_mass : float
            Mass of the base [kg].
        period : float
            Period of the base with its blocks [s].
        damping_ratio : float
            Part of critical damping.
        **others : object
            Other arguments of the constructor.

        Returns
        -------
        IsolatedBlocks
            Structure.

        Raises
        ------
        InputError
            As the constructor.
        """
        values = {"period": period, "damping_ratio": damping_ratio, "base_mass": base_mass}
        check_values("IsolatedBlocks.from_period", values, frozenset({"damping_ratio"}))
        every = _checked(blocks)
        mass = base_mass + sum(one.mass for one in every)
        omega = 2 * math.pi / period
        return cls(
            blocks=every, base_mass=base_mass, isolator_stiffness=mass * omega**2,
            isolator_damping=2 * damping_ratio * mass * omega, **others,
        )  # fmt: skip

    @property
    def derivation(self) -> dict[str, Any]:
        law = {} if self.contact_law == "newton" else {"law": self.contact_law}
        return {"blocks": len(self.blocks)} | law

    @property
    def unrestrained(self) -> RigidBlock:
        """The block that lifts first."""
        return min(self.blocks, key=lambda one: one.half_width / one.half_height)

    @property
    def full_height(self) -> float:
        """Twice the height of the centroid of the highest block [m]."""
        return 2.0 * max(one.half_height for one in self.blocks)

    @functools.cached_property
    def module(self) -> GeneratedModule:
        """The generated module of so many blocks."""
        return module_of(self.model, **self.derivation)

    def parameters(self) -> dict[str, float]:
        own = ("gravity", "friction", "restitution", "base_mass")
        values = {name: getattr(self, name) for name in own}
        values |= {n: getattr(self, n) for n in ("isolator_stiffness", "isolator_damping")}
        for i, block in enumerate(self.blocks, 1):
            end = f"_{i}" if len(self.blocks) > 1 else ""
            of = {
                "mass": block.mass, "half_width": block.half_width,
                "half_height": block.half_height, "inertia": block.parameters()["inertia"],
            }  # fmt: skip
            values |= {f"{name}{end}": value for name, value in of.items()}
        return values


def _checked(blocks: Any) -> tuple[RigidBlock, ...]:
    every = (blocks,) if isinstance(blocks, RigidBlock) else blocks
    if not isinstance(every, Sequence) or not every:
        raise InputError("blocks", every, "IsolatedBlocks").give("a list of RigidBlocks")
    for one in every:
        if type(one) is not RigidBlock:
            raise InputTypeError("blocks", one, "IsolatedBlocks").give("RigidBlocks")
    return tuple(every)
