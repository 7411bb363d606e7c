"""Structures that are composed where they are used: any superstructure on any support."""

from __future__ import annotations

import dataclasses
import functools
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, ClassVar, Self

from rockeom.analysis.formulas.foundation import rectangular_footing
from rockeom.codes import MOST_MODES
from rockeom.integrator.schema import GeneratedModule
from rockeom.modelling.declared import module_of
from rockeom.motion.units import STANDARD_GRAVITY
from rockeom.numbers import explained
from rockeom.numbers.checks import InputError, InputTypeError, number, require, whole_number
from rockeom.structures.modal import rayleigh_damping
from rockeom.structures.parameters import check_contact_law, check_values
from rockeom.structures.restraints import parameters_of
from rockeom.structures.supports import HeldStructure, Support


class _Derived(Support):
    """A support that is a part of the derivation."""

    def module(self, superstructure: str, **arguments: Any) -> GeneratedModule:
        return module_of(superstructure, **arguments, **self.derivation)


@explained.record()
@dataclass(frozen=True)
class Pinned(_Derived):
    """Feet that may lift, and neither slide nor bounce: the default support.

    Examples
    --------
    >>> import rockeom as rk
    >>> support = rk.Pinned()
    """

    kind: ClassVar[str] = "pinned"


def _turns(what: str, inertia: float) -> None:
    """Raise ValueError where nothing resists that the base turns about its middle."""
    if not inertia > 0:
        raise InputError("base_inertia", of=what).says(
            "on this support the base must have an inertia of its own, and base_inertia, the "
            "inertias above and base_mass base_height**2 are zero: give one of them"
        )


@dataclass(frozen=True, kw_only=True)
class _Springs(_Derived):
    """Supports on springs and dampers: stiffness [N/m] and damping [N s/m] of each."""

    called: ClassVar[Mapping[str, str]] = {
        "stiffness": "foundation_stiffness",
        "damping": "foundation_damping",
    }
    stiffness: float
    damping: float

    def __post_init__(self) -> None:
        values = {"stiffness": self.stiffness, "damping": self.damping}
        check_values(type(self).__name__, values, frozenset({"damping"}))

    def parameters(self) -> dict[str, float]:
        return {name: getattr(self, own) for own, name in self.called.items()}

    def check_base(self, what: str, mass: float, inertia: float) -> None:
        _turns(what, inertia)


def _of_soil(what: str, springs: int, match: str, footing: Mapping[str, Any]) -> float:
    """Stiffness of each of equally spaced springs under a footing [N/m], as in `from_soil`."""
    given = dict(footing)
    young = given.pop("youngs_modulus")
    if (young is None) == (given["shear_modulus"] is None):
        raise InputError("shear_modulus", of=what).says(
            "give one of shear_modulus and youngs_modulus of the soil [Pa]"
        )
    if young is not None:
        check_values(what, {"youngs_modulus": young, "poisson_ratio": given["poisson_ratio"]})
        given["shear_modulus"] = young / (2 * (1 + given["poisson_ratio"]))
    require(match in ("rotation", "heave"), what, "match", match, 'give "rotation" or "heave"')
    stiffness = rectangular_footing(**given)
    if match == "heave":
        return float(stiffness.vertical) / springs
    squares = springs * (springs + 1) / (3 * (springs - 1))  # of places from -1 to 1
    return float(stiffness.rotational) / (squares * given["half_width"] ** 2)


@explained.record(k="stiffness=", c="damping=")
@dataclass(frozen=True, kw_only=True)
class TwoSprings(_Springs):
    """Spring and damper under each foot, which press and never pull.

    `heave` [m] counts from the settled position.

    Parameters
    ----------
    stiffness : float
        Stiffness of each spring [N/m].
    damping : float
        Coefficient of each damper [N s/m].
    guided : str, optional
        Point that moves up and down alone: the base's "centre", or the "foot" to whose side the
        base leans, which changes as it comes upright.

    Raises
    ------
    ValueError
        For numbers that are not positive, and another point.

    Notes
    -----
    As the springs grow stiff a structure guided at its centre becomes none on pinned feet: its foot
    glides sideways, by half_width (1 - cos(theta)). Guided at the foot it has the same equations as
    on pinned feet, once one foot presses; how it lands depends on the dampers.
    """

    kind: ClassVar[str] = "two_springs"

    guided: str = "centre"

    @classmethod
    def from_soil(
        cls, *, half_width: float, half_length: float, poisson_ratio: float, damping: float,
        shear_modulus: float | None = None, youngs_modulus: float | None = None,
        match: str = "rotation", guided: str = "centre",
    ) -> Self:  # fmt: skip
        """Springs of a rigid rectangular footing on soil.

        Parameters
        ----------
        half_width : float
            Half-width of the footing in the plane, that of the base above [m].
        half_length : float
            Half-length of the footing at right angles to the plane [m]. Both are of the whole
            footing, which carries the whole mass of the structure above; for one metre of a long
            wall, divide the springs of the whole footing by its length, as the mass.
        poisson_ratio : float
            Poisson's ratio of the soil.
        damping : float
            Coefficient of each damper [N s/m].
        shear_modulus : float, optional
            Shear modulus of the soil [Pa]; either this or `youngs_modulus`.
        youngs_modulus : float, optional
            Young's modulus of the soil [Pa].
        match : str, optional
            Stiffness of the footing that the springs have, "rotation" or "heave". They cannot have
            both: two springs that turn as a square footing are 15 % softer in heave.
        guided : str, optional
            Point that moves up and down alone, as for the class.

        Returns
        -------
        TwoSprings
            Support.

        Raises
        ------
        ValueError
            For both moduli, or none, and values out of their range.

        References
        ----------
        Pais and Kausel (1988), see `analysis.formulas.rectangular_footing`.

        Examples
        --------
        >>> import rockeom as rk
        >>> rk.TwoSprings.from_soil(
        ...     half_width=1.2, half_length=2.0, shear_modulus=30e6, poisson_ratio=0.3, damping=50e3
        ... ).stiffness  # N/m
        157714285.7...
        """
        footing = {
            "half_width": half_width, "half_length": half_length, "poisson_ratio": poisson_ratio,
            "shear_modulus": shear_modulus, "youngs_modulus": youngs_modulus,
        }  # fmt: skip
        stiffness = _of_soil("TwoSprings.from_soil", 2, match, footing)
        return cls(stiffness=stiffness, damping=damping, guided=guided)

    def __post_init__(self) -> None:
        super().__post_init__()
        if self.guided not in ("centre", "foot"):
            raise InputError("guided", self.guided, "TwoSprings").give('"centre" or "foot"')

    @property
    def derivation(self) -> dict[str, Any]:
        return {"support": self.kind, "guided": self.guided}


@explained.record(k="stiffness=", c="damping=")
@dataclass(frozen=True, kw_only=True)
class Winkler(_Springs):
    """Bed of equal springs and dampers, equally far apart, which press and never pull.

    The base's centre is guided vertically; `heave` [m] counts from the settled position.

    Parameters
    ----------
    stiffness : float
        Stiffness of each spring [N/m].
    damping : float
        Coefficient of each damper [N s/m].
    springs : int
        Number of springs, two or more, the outer two at the feet. As many as 40 are derived and
        compiled in seconds, once on a machine.

    Raises
    ------
    ValueError
        For more than 90 springs: those that press are neighbours, in n (n + 1)/2 + 1 sets.
    """

    kind: ClassVar[str] = "winkler"

    springs: int

    @classmethod
    def from_soil(
        cls, *, springs: int, half_width: float, half_length: float, poisson_ratio: float,
        damping: float, shear_modulus: float | None = None, youngs_modulus: float | None = None,
        match: str = "rotation",
    ) -> Self:  # fmt: skip
        """Bed of a rigid rectangular footing on soil.

        Parameters
        ----------
        springs : int
            Number of springs.
        half_width : float
            Half-width of the footing in the plane, that of the base above [m].
        half_length : float
            Half-length of the footing at right angles to the plane [m]. Both are of the whole
            footing, which carries the whole mass of the structure above; for one metre of a long
            wall, divide the springs of the whole footing by its length, as the mass.
        poisson_ratio : float
            Poisson's ratio of the soil.
        damping : float
            Coefficient of each damper [N s/m].
        shear_modulus : float, optional
            Shear modulus of the soil [Pa]; either this or `youngs_modulus`.
        youngs_modulus : float, optional
            Young's modulus of the soil [Pa].
        match : str, optional
            Stiffness of the footing that the springs have, "rotation" or "heave". They cannot have
            both: a bed of many that turns as a square footing is 2.6 times as stiff in heave.

        Returns
        -------
        Winkler
            Support.

        Raises
        ------
        ValueError
            For both moduli, or none, and values out of their range.

        References
        ----------
        Pais and Kausel (1988), see `analysis.formulas.rectangular_footing`.

        Examples
        --------
        >>> import rockeom as rk
        >>> bed = rk.Winkler.from_soil(
        ...     springs=11, half_width=1.2, half_length=2.0, youngs_modulus=80e6,
        ...     poisson_ratio=0.3, damping=10e3,
        ... )  # m, m, Pa, N s/m
        """
        footing = {
            "half_width": half_width, "half_length": half_length, "poisson_ratio": poisson_ratio,
            "shear_modulus": shear_modulus, "youngs_modulus": youngs_modulus,
        }  # fmt: skip
        what = "Winkler.from_soil"
        stiffness = _of_soil(what, whole_number("springs", springs, 2, what), match, footing)
        return cls(springs=springs, stiffness=stiffness, damping=damping)

    def __post_init__(self) -> None:
        super().__post_init__()
        n = whole_number("springs", self.springs, 2, "Winkler")
        sets = n * (n + 1) // 2 + 1
        if sets > MOST_MODES:
            raise InputError("springs", n, "Winkler").wrong(
                f"is {n}, which press in {sets} sets of neighbours, more than the {MOST_MODES} "
                "modes of a structure: give 90 or fewer"
            )
        object.__setattr__(self, "springs", n)

    @property
    def derivation(self) -> dict[str, Any]:
        return {"support": self.kind, "springs": self.springs}


@explained.record(mu="friction=", e="restitution=")
@dataclass(frozen=True, kw_only=True)
class Sliding(_Derived):
    """Feet that open, stick, slip and bounce on rigid ground.

    The states `x` and `y` [m] are the place and the height of the base's centre.

    Parameters
    ----------
    friction : float
        Coefficient of friction at each foot.
    restitution : float
        Ratio of the rates of a foot's gap after and before it lands alone, 0 to 1.
    law : str, optional
        Impact law of feet that touch: "newton", "moreau", "poisson", "lzb" or "pairwise", see
        `rockeom.symbolic.Rigid`.

    Raises
    ------
    ValueError
        For a law of another name, and numbers out of their ranges.
    """

    kind: ClassVar[str] = "sliding"

    friction: float
    restitution: float
    law: str = "newton"

    def __post_init__(self) -> None:
        values = self.parameters()
        check_values("Sliding", values, frozenset(values))
        check_contact_law("Sliding", self.restitution, self.law)

    def parameters(self) -> dict[str, float]:
        return {"friction": self.friction, "restitution": self.restitution}

    def check_base(self, what: str, mass: float, inertia: float) -> None:
        if not mass > 0:
            raise InputError("base_mass", mass, what).so("a base that slides has a mass of its own")
        _turns(what, inertia)

    @property
    def derivation(self) -> dict[str, Any]:
        return {"support": self.kind} | ({} if self.law == "newton" else {"law": self.law})


class ShearFrame(HeldStructure):
    """Frame of any number of storeys, elastic and damped, on a rigid base that rocks.

    The states are `theta` [rad] and `u_1`, `u_2`, ... [m], the displacement of each floor relative
    to the base, at right angles to the turned axis. The displacement of a response is that of the
    top floor, which carries the load of a pushover.

    Parameters
    ----------
    support : Support, optional
        Support of the base; rk.Pinned() if not given.
    restraint : sequence of Strap or Anchor, optional
        Restraints of the base, on feet of `Sliding`; the point of a strap moves with the base.
    loads : sequence of Push, optional
        Forces of time on the base, on feet of `Sliding`.
    masses : sequence of float
        Masses of the floors, from the lowest up [kg].
    heights : sequence of float
        Heights of the floors above the feet, rising [m].
    stiffnesses : sequence of float
        Stiffnesses of the storeys, from the lowest up [N/m].
    dampings : sequence of float
        Dampings of the storeys, from the lowest up [N s/m].
    half_width : float
        Half of the distance between the feet [m].
    base_mass : float
        Mass of the base [kg].
    inertias : sequence of float, optional
        Moments of inertia of the floors, which turn with the base [kg m2]; zero if not given.
    base_height : float, optional
        Height of the centroid of the base above the feet [m].
    base_inertia : float, optional
        Moment of inertia of the base about its own centroid [kg m2].
    gravity : float, optional
        Acceleration of gravity [m/s2].

    Raises
    ------
    ValueError
        For lists of different lengths, and for heights that do not rise.

    Notes
    -----
    The equations of each number of storeys are derived at their first use (some seconds for ten,
    once on a machine).

    Examples
    --------
    >>> import rockeom as rk
    >>> frame = rk.ShearFrame(
    ...     masses=[20e3, 20e3], heights=[3.5, 7.0], stiffnesses=[20e6, 20e6],
    ...     dampings=[120e3, 120e3], half_width=1.2, base_mass=10e3,
    ... )  # kg, m, N/m, N s/m, m, kg
    >>> frame.states
    ('theta', 'u_1', 'u_2', 'theta_dot', 'u_1_dot', 'u_2_dot')
    """

    model: ClassVar[str] = "shear_frame"
    may_vanish = frozenset({"base_mass", "base_height", "base_inertia"})
    of_each: ClassVar[Mapping[str, str]] = {
        "masses": "mass",
        "heights": "height",
        "stiffnesses": "stiffness",
        "dampings": "damping",
        "inertias": "inertia",
    }
    not_numbers = frozenset({*of_each, "support", "restraint", "loads"})
    masses: Sequence[float]
    heights: Sequence[float]
    stiffnesses: Sequence[float]
    dampings: Sequence[float]
    half_width: float
    base_mass: float
    inertias: Sequence[float] | None = None
    base_height: float = 0.0
    base_inertia: float = 0.0
    gravity: float = STANDARD_GRAVITY

    def __post_init__(self) -> None:
        set_ = functools.partial(object.__setattr__, self)
        set_("masses", _each("masses", self.masses))
        if self.inertias is None:
            set_("inertias", (0.0,) * len(self.masses))
        for name in ("heights", "stiffnesses", "dampings", "inertias"):
            values = _each(name, getattr(self, name), may_vanish=name in ("dampings", "inertias"))
            if len(values) != len(self.masses):
                raise InputError("masses", len(self.masses), "ShearFrame").wrong(
                    f"are {len(self.masses)} and {name} {len(values)}: give one for each storey, "
                    "from the lowest up"
                )
            set_(name, values)
        for i in range(1, len(self.heights)):
            if not self.heights[i] > self.heights[i - 1]:
                raise InputError("heights", self.heights[i], "ShearFrame").says(
                    f"heights[{i}] is {self.heights[i]}, not above heights[{i - 1}], "
                    f"{self.heights[i - 1]}: give the height of each floor above the feet, from "
                    "the lowest up"
                )

        super().__post_init__()

    def of_base(self) -> tuple[float, float]:
        inertia = (
            sum(self.inertias or ()) + self.base_inertia + self.base_mass * self.base_height**2
        )
        return self.base_mass, inertia

    @property
    def derivation(self) -> dict[str, Any]:
        return super().derivation | {"storeys": len(self.masses)}

    @functools.cached_property
    def module(self) -> GeneratedModule:
        """The generated module of so many storeys on this support."""
        return module_of(self.model, **self.derivation)

    def damped(self, ratio: float, mode: int = 1) -> ShearFrame:
        """Frame with dampings in proportion to its stiffnesses, by the ratio of one mode.

        Parameters
        ----------
        ratio : float
            Part of critical damping of the mode on a fixed base.
        mode : int, optional
            Number of the mode, 1 for the slowest.

        Returns
        -------
        ShearFrame
            The other frame. Other modes have ratios in proportion to their frequencies, see
            ``frame.fixed_base().damping_ratios``.

        Raises
        ------
        ValueError
            For a negative ratio, and for a mode that the frame has not.
        """
        mode = whole_number("mode", mode, 1, "ShearFrame.damped")
        if mode > len(self.masses):
            raise InputError("mode", mode, "ShearFrame.damped").so(
                f"a frame of {len(self.masses)} storeys has as many"
            )
        bare: Any = {"support": None, "restraint": (), "loads": ()}
        free = dataclasses.replace(self, dampings=[0.0] * len(self.masses), **bare)
        period = free.fixed_base().periods[mode - 1]
        beta = rayleigh_damping(period, number("ratio", ratio, "ShearFrame.damped")).beta
        return dataclasses.replace(self, dampings=[beta * k for k in self.stiffnesses])

    def parameters(self) -> dict[str, float]:
        values = {
            f"{name}_{i}": value
            for every, name in self.of_each.items()
            for i, value in enumerate(getattr(self, every), 1)
        }
        for name in ("half_width", "base_mass", "base_height", "base_inertia", "gravity"):
            values[name] = getattr(self, name)
        support = self.support.parameters() if self.support else {}
        return values | support | parameters_of(*self.restraint, *self.loads)


def _each(name: str, values: Any, may_vanish: bool = False) -> tuple[float, ...]:
    """One number a storey."""
    remedy = "give a list with a number for each storey, from the lowest up"
    if isinstance(values, str) or not hasattr(values, "__iter__") or hasattr(values, "keys"):
        raise InputTypeError(name, values, "ShearFrame").so(f"{remedy}")
    named = {f"{name}[{i}]": number(f"{name}[{i}]", v, "ShearFrame") for i, v in enumerate(values)}
    if not named:
        raise InputError(name, of="ShearFrame").wrong(f"is empty: {remedy}")
    check_values("ShearFrame", named, frozenset(named) if may_vanish else frozenset())
    return tuple(named.values())
