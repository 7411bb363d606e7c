"""`Prism` and `LeggedStatue`: bodies on feet in space, which rock over edges and corners."""

from __future__ import annotations

import dataclasses
import functools
import os
from collections.abc import Iterator
from typing import Any, ClassVar, Self

import numpy as np
from scipy.spatial import ConvexHull, QhullError

from rockeom.integrator.schema import GeneratedModule
from rockeom.modelling.declared import module_of
from rockeom.modelling.mesh import read_body, surface_of
from rockeom.motion.units import STANDARD_GRAVITY
from rockeom.numbers.checks import InputError
from rockeom.numbers.dual import value_of
from rockeom.numbers.functions import checked
from rockeom.structures.declared import StructureWithFields
from rockeom.structures.positions import LEVEL, Solid, box, solid

Place = tuple[float, float]
_OF_MASSES = ("inertia_xx", "inertia_yy", "inertia_zz", "centroid_height")


class _StandingBody(StructureWithFields):
    """A rigid body on feet in one plane; see `Prism` and `LeggedStatue`."""

    may_vanish = frozenset({"restitution", "friction"})

    @functools.cached_property
    def module(self) -> GeneratedModule:
        """The generated module of these feet."""
        return module_of(self.model, **self.derivation)


def _slips(kind: str, friction: float | None, restitution: float) -> str:
    """The word for how feet slip; raises InputError for numbers out of their ranges."""
    if not 0 <= checked(restitution) <= 1:
        raise InputError("restitution", restitution, kind).give("a ratio of rates, 0 to 1")
    if friction is None:
        return "never"
    return "rubbing" if value_of(friction) > 0 else "freely"


def _check_base(kind: str, places: np.ndarray) -> None:
    """Raise InputError for feet (n, 2) that do not support the centroid, at the origin."""
    if len(places) < 3:
        raise InputError("feet", of=kind).wrong(f"are {len(places)}: give three or more")
    try:
        hull = ConvexHull(places)
    except QhullError:
        raise InputError("feet", of=kind).wrong("are on one line: give one that is not") from None
    if (hull.equations[:, -1] >= 0.0).any():
        raise InputError("centroid", of=kind).wrong(
            "is not above the area between the feet, or it falls by itself: move the centroid, or "
            "the feet"
        )


class Prism(_StandingBody):
    """Rectangular block in space, which rocks over its edges and corners.

    The states are the place x, y, z of the centroid relative to the ground [m], x and y the two
    horizontal directions and z upwards, its yaw, pitch and roll [rad], and their rates. The corners
    of its base are `south_west`, `south_east`, `north_east` and `north_west`, east along x and
    north along y.

    Parameters
    ----------
    width : float
        Length along x [m].
    depth : float
        Length along y [m].
    height : float
        Height [m].
    mass : float
        Mass [kg].
    friction : float, optional
        Coefficient of friction at each corner; None for corners that never slip.
    restitution : float, optional
        Ratio of the rates of a corner's gap after and before it lands alone, 0 to 1.
    offset_x : float, optional
        Place of the centroid along x, from the middle of the base [m].
    offset_y : float, optional
        The same along y [m].
    centroid_height : float, optional
        Height of the centroid above the base [m]; half of the height if not given.
    inertia_xx : float, optional
        Moment of inertia about the axis along x through the centroid [kg m2]; that of a homogeneous
        block if not given.
    inertia_yy : float, optional
        The same about the axis along y [kg m2].
    inertia_zz : float, optional
        The same about the axis along z [kg m2].
    gravity : float, optional
        Acceleration of gravity [m/s2].

    Raises
    ------
    InputError
        For numbers out of their ranges, a centroid that is not above the base, and moments that no
        masses have.

    Notes
    -----
    A corner that never slips is released where it would jam: where no forces fit that press, it
    bears without friction until it opens or lands again, or the prism stands flat, which ends
    its slide. Where several sets of corners fit an impact, the one with more corners closed
    follows.

    Impacts follow Moreau's law: after one plus restitution times before it, velocities of corners
    satisfy the laws of gap and friction. So a corner that sticks in it leaves with its slip turned
    round. No impact gives energy.

    Friction is Coulomb's: corners stick as long as some share of the force along the ground lies
    in the cones of all, and slip against their friction. A slip begins with a velocity of 1e-8 m/s,
    which gives it its direction, and with less where `rtol` is below its default.

    Examples
    --------
    >>> import rockeom as rk
    >>> statue = rk.Prism(width=0.5, depth=0.7, height=3.0, mass=2000.0)  # m, kg
    >>> run = rk.simulate(statue, rk.GroundMotion.none(2.0), initial={"pitch": 0.05, "roll": 0.02})
    >>> run.outcome.value
    'completed'
    """

    model: ClassVar[str] = "prism"
    may_vanish = frozenset({"restitution", "friction", "offset_x", "offset_y"})
    may_be_negative = frozenset({"offset_x", "offset_y"})
    width: float
    depth: float
    height: float
    mass: float
    friction: float | None = None
    restitution: float = 0.0
    offset_x: float = 0.0
    offset_y: float = 0.0
    centroid_height: float | None = None
    inertia_xx: float | None = None
    inertia_yy: float | None = None
    inertia_zz: float | None = None
    gravity: float = STANDARD_GRAVITY

    def __post_init__(self) -> None:
        values, b, c = self.parameters(), self.width / 2, self.depth / 2
        moments = [values[f"inertia_{axis}{axis}"] for axis in "xyz"]
        check_tensor("Prism", np.diag(checked(np.array(moments))))
        corners = [(i * b - self.offset_x, j * c - self.offset_y) for i in (-1, 1) for j in (-1, 1)]
        _check_base("Prism", checked(np.array(corners)))
        _slips("Prism", self.friction, self.restitution)

    @property
    def derivation(self) -> dict[str, Any]:
        return {"slips": _slips("Prism", self.friction, self.restitution)}

    @property
    def symmetry_angle(self) -> float:
        """Angle about the vertical after which it is as before [rad]."""
        return 2.0 * np.pi if self.offset_x or self.offset_y else np.pi

    def changed(self, wider: float, lower: float) -> Iterator[tuple[str, Prism]]:
        """Prisms of the same mass and inertia with another base and centroid, and the change.

        Parameters
        ----------
        wider : float
            Length that the base gains both ways [m].
        lower : float
            Part of its height by which the centroid is lowered.

        Yields
        ------
        tuple of (str, Prism)
            Change in words, and the changed prism.
        """
        values, same = self.parameters(), functools.partial(dataclasses.replace, self)
        own = {name: x for name, x in values.items() if name in _OF_MASSES}
        base = {"width": self.width + wider, "depth": self.depth + wider}
        yield (
            f"A base {100 * wider:g} cm wider both ways, half of it on each side",
            same(**own | base),
        )
        own["centroid_height"] *= 1.0 - lower
        yield f"A centroid {100 * lower:g} % lower", same(**own)

    @functools.cached_property
    def solids(self) -> dict[str, Solid]:
        middle = self.height / 2 - self.parameters()["centroid_height"]
        at = (-self.offset_x, -self.offset_y, middle)
        return {"body": box(self.width, self.depth, self.height, at)}

    def parameters(self) -> dict[str, float]:
        lengths = {"xx": self.width, "yy": self.depth, "zz": self.height}
        squares = {axes: length * length for axes, length in lengths.items()}
        whole = sum(squares.values())
        values = {f"inertia_{axes}": self.mass * (whole - x) / 12 for axes, x in squares.items()}
        values |= {name: getattr(self, name) for name in values if getattr(self, name) is not None}
        names = ("mass", "width", "depth", "offset_x", "offset_y", "restitution", "gravity")
        height = self.height / 2 if self.centroid_height is None else self.centroid_height
        values |= {name: getattr(self, name) for name in names} | {"centroid_height": height}
        return values | ({"friction": self.friction} if self.friction else {})


class LeggedStatue(_StandingBody):
    """Rigid body of any shape on three feet or more, up to eight, in space.

    The states are those of `Prism`.

    Parameters
    ----------
    feet : dict of str to tuple of float
        Place of each foot along x and y [m], by its name; with a third number, its height above the
        lowest feet, which are three or more. A foot that is higher touches when the body leans.
    centroid : tuple of (float, float, float)
        Place of the centroid [m], in the same axes, z above the feet.
    mass : float
        Mass [kg].
    inertia : array_like
        Inertia tensor (3, 3) about the centroid along these axes [kg m2].
    friction : float, optional
        Coefficient of friction at each foot; None for feet that never slip.
    restitution : float, optional
        Ratio of the rates of a foot's gap after and before it lands alone, 0 to 1.
    gravity : float, optional
        Acceleration of gravity [m/s2].
    shape : tuple, optional
        Surface for pictures, as `from_mesh` gives it: vertices from the centroid [m], and for each
        face the numbers of its vertices, counter-clockwise seen from outside.

    Raises
    ------
    InputError
        For numbers out of their ranges, fewer than three lowest feet, lowest feet in one line, a
        centroid that is not above the area between them, and a tensor that no masses have.

    Notes
    -----
    More than three feet share the load as equal springs under the body. One that would pull is
    idle. See `Prism` for feet that never slip.

    Examples
    --------
    >>> import numpy as np
    >>> import rockeom as rk
    >>> tripod = rk.LeggedStatue(
    ...     feet={"front": (0.02, 0.26), "left": (-0.24, -0.13), "right": (0.22, -0.11)},
    ...     centroid=(0.0, 0.0, 0.6), mass=300.0, inertia=np.diag([50.0, 45.0, 12.0]),
    ... )  # m, kg, kg m2
    >>> {name: round(force) for name, force in tripod.reactions({}).items() if "reaction" in name}
    {'horizontal_reaction': 0, 'transverse_reaction': 0, 'vertical_reaction': 2943, ...}
    """

    model: ClassVar[str] = "legged_statue"
    not_numbers = frozenset({"feet", "centroid", "inertia", "shape"})
    feet: Any
    centroid: tuple[float, float, float]
    mass: float
    inertia: Any
    friction: float | None = None
    restitution: float = 0.0
    gravity: float = STANDARD_GRAVITY
    shape: Any = None

    @classmethod
    def from_mesh(
        cls,
        path: str | os.PathLike[str],
        *,
        feet: Any,
        mass: float | None = None,
        density: float | None = None,
        scale: float = 1.0,
        **others: Any,
    ) -> Self:
        """Homogeneous body of a closed surface in a file, on feet as low as its lowest point.

        Parameters
        ----------
        path : path_like
            File .stl, .obj or .ply, z upwards. It is read by trimesh, of the extra `mesh`.
        feet : dict of str to tuple of float
            Place of each foot along x and y of the file [m], by its name, and its height, as of the
            class.
        mass : float, optional
            Mass [kg].
        density : float, optional
            Density [kg/m3], in place of the mass.
        scale : float, optional
            Factor of the lengths in the file to metres, such as 0.001.
        **others : object
            Further arguments of the class.

        Returns
        -------
        LeggedStatue
            Statue.

        Raises
        ------
        InputError
            For a surface that is open, inside out or of no volume, for other than one of mass and
            density, and for feet that do not support the centroid.
        FileNotFoundError
            For a missing file.
        ModuleNotFoundError
            Without trimesh.

        Examples
        --------
        >>> import rockeom as rk
        >>> statue = rk.LeggedStatue.from_mesh(
        ...     "statue.stl", density=2700.0, scale=0.001,  # kg/m3, from mm
        ...     feet={"front": (0.0, 0.3), "left": (-0.25, -0.15), "right": (0.25, -0.15)},  # m
        ... )  # doctest: +SKIP
        """
        body = read_body(path, mass, density, scale)
        return cls(
            feet=feet, mass=body.mass, centroid=tuple(body.centroid.tolist()),
            inertia=body.inertia, shape=body.shape, **others,
        )  # fmt: skip

    def __post_init__(self) -> None:
        try:
            feet = dict(self.feet)
        except (TypeError, ValueError):
            raise InputError("feet", self.feet, "LeggedStatue").give(
                "a mapping of names to places, {'front': (x, y), ...}"
            ) from None
        for name, place in feet.items():
            rises = np.shape(place) == (3,)
            _check_numbers("LeggedStatue", f"foot {name!r}", place, 3 if rises else 2)
        _check_numbers("LeggedStatue", "centroid", self.centroid, 3)
        check_tensor("LeggedStatue", checked(np.array(self.inertia)))
        rows = tuple(tuple(row) for row in np.array(self.inertia).tolist())
        object.__setattr__(self, "inertia", rows)
        object.__setattr__(self, "shape", surface_of(self.shape, "LeggedStatue"))
        object.__setattr__(self, "feet", tuple((name, tuple(at)) for name, at in feet.items()))
        arms, rises = np.array([at for _, at in self._arms]), checked(np.array(self._rises))
        if (rises < 0.0).any():
            name = self.feet[int(np.argmin(rises))][0]
            raise InputError("feet", of="LeggedStatue").wrong(
                f"have {name!r} below the lowest feet: give heights of 0 and more"
            )
        if self._is_uneven and (rest := int((rises == 0.0).sum())) < 3:
            raise InputError("feet", of="LeggedStatue").wrong(
                f"have {rest} of height 0: give three or more on which it rests, and the heights "
                "of others above these"
            )
        _check_base("LeggedStatue", checked(arms)[rises == 0.0])
        _slips("LeggedStatue", self.friction, self.restitution)

    @functools.cached_property
    def solids(self) -> dict[str, Solid]:
        return {} if self.shape is None else {"body": solid(*self.shape)}

    @property
    def derivation(self) -> dict[str, Any]:
        slips = _slips("LeggedStatue", self.friction, self.restitution)
        named = {"feet": tuple(name for name, _ in self.feet), "slips": slips}
        return named | ({"uneven": True} if self._is_uneven else {})

    @property
    def _arms(self) -> list[tuple[str, Place]]:
        """Places of the feet from the centroid, seen from above."""
        x, y, _ = self.centroid
        return [(foot, (at[0] - x, at[1] - y)) for foot, at in self.feet]

    @property
    def _is_uneven(self) -> bool:
        return any(len(at) > 2 for _, at in self.feet)

    @property
    def _rises(self) -> list[float]:
        """Heights of the feet above the lowest."""
        least = LEVEL * value_of(self.centroid[2])
        heights = [at[2] if len(at) > 2 else 0.0 for _, at in self.feet]
        return [0.0 if abs(value_of(height)) <= least else height for height in heights]

    def parameters(self) -> dict[str, float]:
        rows = (("xx", 0, 0), ("yy", 1, 1), ("zz", 2, 2), ("xy", 0, 1), ("xz", 0, 2), ("yz", 1, 2))
        values = {f"inertia_{axes}": self.inertia[i][j] for axes, i, j in rows}
        for foot, (x, y) in self._arms:
            values |= {f"{foot}_x": x, f"{foot}_y": y}
        if self._is_uneven:
            values |= {f"{foot}_z": z for (foot, _), z in zip(self.feet, self._rises, strict=True)}
        values |= {name: getattr(self, name) for name in ("mass", "restitution", "gravity")}
        values |= {"centroid_height": self.centroid[2]}
        return values | ({"friction": self.friction} if self.friction else {})


def _check_numbers(kind: str, name: str, values: Any, length: int) -> None:
    """Raise InputError for anything but so many finite numbers."""
    try:
        given = np.array(values)
        numbers = np.empty(0) if given.dtype.kind in "US" else checked(given).astype(float)
    except (TypeError, ValueError):
        numbers = np.empty(0)
    if numbers.shape != (length,) or not np.isfinite(numbers).all():
        raise InputError(name, values, kind).give(f"{length} finite numbers")


def check_tensor(kind: str, tensor: np.ndarray) -> None:
    """Raise InputError for a tensor that no masses have."""
    if tensor.shape != (3, 3) or not np.isfinite(tensor.astype(float)).all():
        raise InputError("inertia", tensor, kind).give("a tensor (3, 3) of finite numbers")
    if not np.allclose(tensor, tensor.T, rtol=1e-9, atol=0.0):
        raise InputError("inertia", tensor, kind).wrong(
            "is not symmetric: give its other half alike"
        )
    low, middle, high = np.linalg.eigvalsh(tensor.astype(float))
    if not low > 0.0 or high > (low + middle) * (1.0 + 1e-9):
        raise InputError("inertia", tensor, kind).wrong(
            f"has the principal moments {low:.6g}, {middle:.6g} and {high:.6g}, which no masses "
            "have: each is positive and at most the sum of the other two"
        )
