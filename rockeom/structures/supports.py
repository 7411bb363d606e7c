"""Supports: the base of a structure stands on one, which is a part of the structure."""

import dataclasses
import functools
from collections.abc import Mapping
from typing import Any, ClassVar

from rockeom.integrator.schema import GeneratedModule
from rockeom.numbers.checks import InputError, InputTypeError
from rockeom.structures.base import Structure
from rockeom.structures.declared import StructureWithFields
from rockeom.structures.restraints import attach, kinds_of, parameters_of


class Support:
    """The support of a base: how the base may move, and by which forces it is held.

    `rockeom.modelling.composed` has all supports.
    """

    called: ClassVar[Mapping[str, str]] = {}
    """Names in the equations of the parameters that have another name there."""

    def parameters(self) -> dict[str, float]:
        """Parameters of the support, in SI units.

        Returns
        -------
        dict of str to float
            Values by the names that they have in the generated module.
        """
        return {}

    @property
    def derivation(self) -> dict[str, Any]:
        """Arguments of `rockeom.derive` that stand for the support."""
        return {}

    def module(self, superstructure: str, **arguments: Any) -> GeneratedModule:
        """Generated module of a superstructure that stands on the support.

        Parameters
        ----------
        superstructure : str
            Name of the model.
        **arguments : object
            Arguments of a family, such as the number of storeys, and restraints.

        Returns
        -------
        GeneratedModule
            Module.
        """
        raise NotImplementedError

    def check_base(self, what: str, mass: float, inertia: float) -> None:
        """Check the base of a structure on the support.

        Parameters
        ----------
        what : str
            Name of the structure, for the message.
        mass : float
            Mass of all that moves with the base as one body [kg].
        inertia : float
            Its moment of inertia about the middle of the sole [kg m2].

        Raises
        ------
        ValueError
            Where a base that this support leaves free has no mass or inertia.
        """


def check_support(what: str, support: Any, mass: float, inertia: float) -> None:
    """Raise TypeError for anything but a support, ValueError for a base that it cannot carry.

    mass [kg], inertia [kg m2] : of all that moves with the base as one body, about its sole's
    middle.
    """
    if support is None:
        return
    if not isinstance(support, Support):
        raise InputTypeError("support", support, what).give("a support, such as rk.Pinned()")
    support.check_base(what, mass, inertia)


class SupportedStructure(StructureWithFields):
    """A structure that stands on any support."""

    not_numbers = frozenset({"support"})
    support: Any = None  # a Support: of any type, that all others may be given as ** of numbers

    def __post_init__(self) -> None:
        mass, inertia = self.of_base()
        check_support(type(self).__name__, self.support, mass, inertia)

    def of_base(self) -> tuple[float, float]:
        """Mass and inertia of all that moves with the base as one body.

        Returns
        -------
        mass : float
            Mass [kg].
        inertia : float
            Moment of inertia about the middle of the sole [kg m2].
        """
        raise NotImplementedError

    @property
    def derivation(self) -> dict[str, Any]:
        return dict(self.support.derivation) if self.support else {}

    @functools.cached_property
    def module(self) -> GeneratedModule:
        """The generated module, of this support."""
        return self.support.module(self.model) if self.support else super().module

    def parameters(self) -> dict[str, float]:
        own = set(self.defaults())
        support = self.support.parameters() if self.support else {}
        names = (n for n in self.module.PARAMETERS if n in own)
        return {name: getattr(self, name) for name in names} | support

    def parameter_at(self, path: tuple[Any, ...]) -> str:
        if path[0] == "support" and len(path) == 2:
            name = self.support.called.get(path[1], path[1])
            return name if name in self.module.PARAMETERS else ""
        return super().parameter_at(path)


class HeldStructure(SupportedStructure):
    """A structure that restraints hold and loads push where it stands on feet that may slide."""

    not_numbers = frozenset({"support", "restraint", "loads"})
    restraint: Any = ()
    loads: Any = ()

    def __post_init__(self) -> None:
        super().__post_init__()
        attach(self)
        if self._attached and not self._slides:
            raise InputError("restraint").says(
                f"{type(self).__name__} with restraints or loads stands on feet that slide: give "
                "support=rk.Sliding(friction=..., restitution=...), with much friction for feet "
                "that do not"
            )

    @property
    def _attached(self) -> tuple[Any, ...]:
        return (*self.restraint, *self.loads)

    @property
    def _slides(self) -> bool:
        return getattr(self.support, "kind", "") == "sliding"

    @property
    def unrestrained(self) -> Structure | None:
        if not self._slides:
            return None
        return dataclasses.replace(self, support=None, restraint=(), loads=())

    @property
    def derivation(self) -> dict[str, Any]:
        return super().derivation | kinds_of(*self._attached)

    @functools.cached_property
    def module(self) -> GeneratedModule:
        """The generated module, of this support and of what holds it."""
        if not self._attached:
            return super().module
        return self.support.module(self.model, **kinds_of(*self._attached))

    def parameters(self) -> dict[str, float]:
        return super().parameters() | parameters_of(*self._attached)
