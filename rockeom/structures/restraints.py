"""Straps and anchors that hold a structure on sliding feet until they break, and pushes of time."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any, ClassVar

from rockeom.numbers import explained
from rockeom.numbers.breaks import Break
from rockeom.numbers.checks import InputError, InputTypeError, number, require_word
from rockeom.numbers.dual import value_of
from rockeom.structures.parameters import check_values

_FEET = ("left", "right")


@dataclass(frozen=True, kw_only=True)
class Restraint:
    """A tie of a structure on sliding feet, by numbers; `Anchor` and `Strap` say where it is."""

    kind: ClassVar[str] = ""

    stiffness: float
    strength: float = math.inf
    hardening: float = 0.0
    slack_length: float = 0.0
    pretension: float = 0.0
    breaks_at: Break | None = None
    name: str = ""

    def __post_init__(self) -> None:
        what = type(self).__name__
        values = {n: getattr(self, n) for n in ("hardening", "slack_length", "pretension")}
        check_values(what, {"stiffness": self.stiffness})
        check_values(what, values, frozenset(values))
        if number("strength", self.strength, what) != math.inf:
            check_values(what, {"strength": self.strength})
        object.__setattr__(self, "name", self.name or self.kind)
        _check_name(what, self.name)
        if not isinstance(self.breaks_at, Break | None):
            raise InputTypeError("breaks_at", self.breaks_at, what).give(
                "rk.Break(force=...), rk.Break(extension=...) or rk.Break(energy=...)"
            )
        check_values(what, self.limits)
        if value_of(self.limits.get("extension", math.inf)) <= value_of(self.slack_length):
            raise InputError("breaks_at", self.limits["extension"], what).give(
                f"an extension of more than slack_length, {self.slack_length:g} m, a part of it"
            )
        if value_of(self.pretension) > value_of(self.strength):
            raise InputError("pretension", self.pretension, what).give(
                f"less than the strength, {self.strength:g} N"
            )
        if not self._yields and (self.hardening or "energy" in self.limits):
            raise InputError("strength", self.strength, what).give(
                "a finite one, at which it yields, with hardening and with an energy at a break"
            )

    @property
    def _yields(self) -> bool:
        return bool(value_of(self.strength) < math.inf)

    @property
    def limits(self) -> dict[str, float]:
        """The limit at which it breaks, by its name; empty for one that never does."""
        return {} if self.breaks_at is None else self.breaks_at.limits

    @property
    def place(self) -> str:
        """Where it is, as the derivation calls it."""
        return self.kind

    @property
    def of_derivation(self) -> tuple[str, str, bool, str]:
        """Its place, its name, whether it yields, and at what limit it breaks, or an empty text."""
        (limit,) = self.limits or ("",)
        return self.place, self.name, self._yields, limit

    def parameters(self) -> dict[str, float]:
        """Values by the names that they have in the generated module.

        Returns
        -------
        dict of str to float
            Values in SI units.
        """
        values = {n: getattr(self, n) for n in ("stiffness", "slack_length", "pretension")}
        if self._yields:
            values |= {"strength": self.strength, "hardening": self.hardening}
        if self.limits:
            (values["limit"],) = self.limits.values()
        return {f"{self.name}_{name}": value for name, value in (values | self.places()).items()}

    def places(self) -> dict[str, float]:
        """Coordinates of its ends.

        Returns
        -------
        dict of str to float
            Coordinates [m]; none of an anchor.
        """
        return {}


@explained.record(k="stiffness=")
@dataclass(frozen=True, kw_only=True)
class Anchor(Restraint):
    """Vertical anchor at a foot, which pulls where the foot rises.

    Parameters
    ----------
    stiffness : float
        Stiffness [N/m].
    strength : float, optional
        Force at which it first yields [N]; infinity for one that stays elastic.
    hardening : float, optional
        Force by which it yields more, a permanent extension [N/m].
    slack_length : float, optional
        Rise at which it begins to pull [m], such as the play of a bolt.
    pretension : float, optional
        Force where the foot stands [N].
    breaks_at : Break, optional
        Limit at which it breaks, for good; None for one that never does.
    name : str, optional
        Name of its quantities; "anchor_left" or "anchor_right" if not given.
    foot : str
        "left" or "right".

    Raises
    ------
    InputError
        For numbers out of their ranges, and for another limit.

    Examples
    --------
    >>> import rockeom as rk
    >>> bolt = rk.Anchor(
    ...     foot="left", stiffness=40e6, strength=20e3, breaks_at=rk.Break(extension=0.02)
    ... )  # N/m, N, m
    """

    kind: ClassVar[str] = "anchor"
    foot: str

    def __post_init__(self) -> None:
        require_word("foot", self.foot, _FEET, "Anchor")
        object.__setattr__(self, "name", self.name or self.place)
        super().__post_init__()

    @classmethod
    def pair(cls, **values: Any) -> tuple[Anchor, Anchor]:
        """An anchor at each foot, such as putty under both.

        Parameters
        ----------
        **values : object
            Arguments of both, but for the foot and the name.

        Returns
        -------
        tuple of Anchor
            Left and right anchor.

        Raises
        ------
        InputError
            As the constructor.
        """
        return cls(foot="left", **values), cls(foot="right", **values)

    @property
    def place(self) -> str:
        return f"anchor_{self.foot}"


@explained.record(k="stiffness=")
@dataclass(frozen=True, kw_only=True)
class Strap(Restraint):
    """Strap between a point of the structure and one that is fixed, with its exact length.

    Parameters
    ----------
    stiffness : float
        Stiffness [N/m].
    strength : float, optional
        Force at which it first yields [N]; infinity for one that stays elastic.
    hardening : float, optional
        Force by which it yields more, a permanent extension [N/m].
    slack_length : float, optional
        Length by which it is longer than the distance of the two points [m].
    pretension : float, optional
        Force when the structure stands [N].
    breaks_at : Break, optional
        Limit at which it breaks, for good; None for one that never does.
    name : str, optional
        Name of its quantities, "strap" if not given.
    at : tuple of (float, float)
        Point of the structure, from the middle of its base when it stands, x to the right [m].
    to : tuple of (float, float)
        Fixed point, from the same place [m].

    Raises
    ------
    InputError
        For numbers out of their ranges, another limit, and two points in one place.

    Examples
    --------
    >>> import rockeom as rk
    >>> strap = rk.Strap(
    ...     at=(0.25, 1.6), to=(0.6, 1.6), stiffness=2e5, breaks_at=rk.Break(force=3e3)
    ... )  # m, m, N/m, N
    """

    kind: ClassVar[str] = "strap"
    at: tuple[float, float] = field()
    to: tuple[float, float] = field()

    def __post_init__(self) -> None:
        super().__post_init__()
        for name in ("at", "to"):
            object.__setattr__(self, name, _point(name, getattr(self, name), "Strap"))
        if self.at == self.to:
            raise InputError("to", self.to, "Strap").give("another place than that of at")

    def places(self) -> dict[str, float]:
        (x, y), (to_x, to_y) = self.at, self.to
        return {"x": x, "y": y, "to_x": to_x, "to_y": to_y}


@explained.record()
@dataclass(frozen=True, kw_only=True)
class Push:
    """Horizontal force of time on a point: a gust, a blast, the blow of a vehicle.

    Parameters
    ----------
    at : tuple of (float, float)
        Point of the structure, from the middle of its base when it stands, x to the right [m].
    force : float
        Largest force, positive to the right [N].
    duration : float
        Duration [s].
    start : float, optional
        Time at which it begins [s].
    shape : str, optional
        "half sine", "constant", "falling" as of a blast, or "gust", 1 - cos.
    name : str, optional
        Name of its quantities, "push" if not given.

    Raises
    ------
    InputError
        For numbers out of their ranges, and another shape.

    Examples
    --------
    >>> import rockeom as rk
    >>> blast = rk.Push(at=(0.0, 1.0), force=5e3, duration=0.05, shape="falling")  # m, N, s
    """

    kind: ClassVar[str] = "push"

    at: tuple[float, float]
    force: float
    duration: float
    start: float = 0.0
    shape: str = "half sine"
    name: str = "push"

    def __post_init__(self) -> None:
        values = {"duration": self.duration, "start": self.start, "force": self.force}
        check_values("Push", values, frozenset({"start"}), frozenset({"force"}))
        require_word("shape", self.shape, ("half sine", "constant", "falling", "gust"), "Push")
        object.__setattr__(self, "at", _point("at", self.at, "Push"))
        _check_name("Push", self.name)

    @property
    def of_derivation(self) -> tuple[str, str, bool, str]:
        """Its shape and its name, as the derivation has them."""
        return f"push {self.shape}", self.name, False, ""

    def parameters(self) -> dict[str, float]:
        """Values by the names that they have in the generated module.

        Returns
        -------
        dict of str to float
            Values in SI units.
        """
        x, y = self.at
        values = {
            "x": x,
            "y": y,
            "size": self.force,
            "start": self.start,
            "duration": self.duration,
        }
        return {f"{self.name}_{name}": value for name, value in values.items()}


_TAKEN = {
    "base", "block", "damping", "facade", "friction", "ground", "impact", "left", "load", "right",
    "wall", "walls",
}  # fmt: skip
"""Names of bodies, contacts and losses of the structures that take restraints."""


def _check_name(what: str, name: str) -> None:
    if not (isinstance(name, str) and name.isidentifier() and name.isascii()):
        raise InputError("name", name, what).give("a word of the letters a to z, digits and _")
    if name in _TAKEN:
        raise InputError("name", name, what).give("another one: a part of the structure has it")


def _point(name: str, point: Any, what: str) -> tuple[float, float]:
    if not (isinstance(point, Sequence) and len(point) == 2):
        raise InputTypeError(name, point, what).give("two numbers, x and y [m]")
    for value in point:
        check_values(what, {name: value}, may_be_negative=frozenset({name}))
    x, y = (number(name, value, what) for value in point)
    return x, y


RESTRAINTS = {one.kind: one for one in (Anchor, Strap, Break, Push)}
"""Classes of restraints, and of what they are made of, by their names in files."""


Attached = Restraint | Push
"""Forces on a structure on sliding feet that are not those of the ground."""


def attach(structure: Any, restraint: type = Restraint) -> None:
    """Make tuples of the restraints, of a class, and of the loads of a structure.

    Raises InputTypeError for others, and InputError where two have one name.
    """
    what, names = type(structure).__name__, Counter[str]()
    kinds: dict[str, Any] = {"restraint": restraint, "loads": Push}
    for field_, kind in kinds.items():
        given = getattr(structure, field_)
        every: tuple[Any, ...] = tuple(given) if isinstance(given, list | tuple) else (given,)
        for one in every:
            if not isinstance(one, kind):
                raise InputTypeError(field_, one, what).give(_REMEDIES[kind])
            names.update({one.name, *one.parameters()})
        object.__setattr__(structure, field_, every)
        if twice := [name for name, number_ in names.items() if number_ > 1]:
            raise InputError(field_, twice, what).give("a name= to each, which no other has")


_REMEDIES = {
    Restraint: "rk.Anchor(...) or rk.Strap(...)", Strap: "rk.Strap(...)", Push: "rk.Push(...)",
}  # fmt: skip


def kinds_of(*attached: Attached) -> dict[str, Any]:
    """The argument of a derivation that stands for restraints and loads; none for none."""
    kinds = tuple(one.of_derivation for one in attached)
    return {"attached": kinds} if kinds else {}


def parameters_of(*attached: Attached) -> dict[str, float]:
    """Values of all of them by the names that they have in the generated module."""
    return {name: value for one in attached for name, value in one.parameters().items()}
