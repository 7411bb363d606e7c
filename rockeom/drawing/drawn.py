"""Attributes that a drawing reads: of a ground motion, a spectrum, a structure and a response.

`GroundMotion`, `ResponseSpectrum`, `Structure` and `Response` have them; their docstrings say more.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any, Protocol

import numpy as np

from rockeom.drawing.positions import Shapes
from rockeom.numbers.checks import InputTypeError


class Motion(Protocol):
    """A ground motion."""

    @property
    def name(self) -> str: ...

    @property
    def source(self) -> str: ...

    @property
    def dt(self) -> float | None: ...

    @property
    def samples(self) -> np.ndarray | None: ...

    @property
    def duration(self) -> float: ...

    @property
    def breakpoints(self) -> np.ndarray: ...

    @property
    def peak(self) -> float: ...

    @property
    def peak_velocity(self) -> float: ...

    @property
    def peak_displacement(self) -> float: ...

    def acceleration(self, t: np.ndarray) -> Any: ...

    def velocity(self, t: np.ndarray) -> Any: ...

    def displacement(self, t: np.ndarray) -> Any: ...


class Spectrum(Protocol):
    """An elastic response spectrum; `ground_motion.plot_spectra` reads its ordinates by name."""

    @property
    def name(self) -> str: ...

    @property
    def periods(self) -> np.ndarray: ...

    @property
    def damping_ratio(self) -> float: ...


class DesignSpectrum(Protocol):
    """Pseudo-accelerations [m/s2] over periods [s], between the shortest and the longest."""

    @property
    def name(self) -> str: ...

    @property
    def shortest(self) -> float: ...

    @property
    def longest(self) -> float: ...

    def __call__(self, periods: np.ndarray) -> Any: ...


class Structure(Protocol):
    """A structure with its parameters."""

    @property
    def model(self) -> str: ...

    @property
    def module(self) -> Any: ...

    @property
    def vector(self) -> np.ndarray: ...

    @property
    def shapes(self) -> Shapes: ...

    @property
    def slenderness(self) -> Any: ...

    @property
    def overturning_angles(self) -> tuple[float, float] | None: ...

    @property
    def overturning_rotation(self) -> float: ...

    def parameters(self) -> dict[str, float]: ...

    def state(self, values: Mapping[str, float]) -> np.ndarray: ...

    def mode_number(self, y: np.ndarray) -> int: ...

    def energies(self, state: Mapping[str, Any]) -> dict[str, Any]: ...


class Event(Protocol):
    """A transition between modes."""

    @property
    def time(self) -> float: ...

    @property
    def kind(self) -> str: ...

    @property
    def mode_after(self) -> str: ...

    @property
    def contact(self) -> str: ...


class Events(Protocol):
    """Events of a motion, or its impacts."""

    @property
    def times(self) -> np.ndarray: ...

    @property
    def columns(self) -> Any: ...

    def __len__(self) -> int: ...

    def __getitem__(self, which: int) -> Event: ...

    def __iter__(self) -> Iterator[Event]: ...


class Impacts(Events, Protocol):
    """Impacts of a motion."""

    @property
    def measurable(self) -> float: ...

    @property
    def speeds(self) -> np.ndarray: ...

    def above(self) -> Sequence[Event]: ...

    def describe(self) -> str: ...


class Support(Protocol):
    """Forces of the ground and contact."""

    @property
    def spans(self) -> tuple[np.ndarray, np.ndarray]: ...

    @property
    def sliding(self) -> np.ndarray: ...


class Run(Protocol):
    """The response of a structure to a ground motion."""

    @property
    def structure(self) -> Structure: ...

    @property
    def motion(self) -> Motion: ...

    @property
    def vertical(self) -> Motion | None: ...

    @property
    def outcome(self) -> Any: ...

    @property
    def t(self) -> np.ndarray: ...

    @property
    def y(self) -> np.ndarray: ...

    @property
    def states(self) -> tuple[str, ...]: ...

    @property
    def names(self) -> tuple[str, ...]: ...

    @property
    def units(self) -> dict[str, str]: ...

    @property
    def steps(self) -> Any: ...

    @property
    def events(self) -> Events: ...

    @property
    def impacts(self) -> Impacts: ...

    @property
    def support(self) -> Support: ...

    def __getitem__(self, name: str) -> np.ndarray: ...

    def extremes(self, name: str) -> Any: ...

    def summary(self) -> str: ...


# -- checks ----------------------------------------------------------------------------------------


def check_run(name: str, value: Any) -> None:
    """Raise TypeError for an argument that is no response."""
    _require(name, value, "extremes", "the response of rk.simulate(structure, motion)")


def check_structure(name: str, value: Any) -> None:
    """Raise TypeError for an argument that is no structure, such as a class of structures."""
    remedy = "a structure, such as rk.RigidBlock(half_width=0.1, half_height=0.4)"
    _require(name, value, "shapes", remedy)


def check_motion(name: str, value: Any) -> None:
    """Raise TypeError for an argument that is no ground motion."""
    remedy = "a ground motion, such as rk.GroundMotion.from_array(values, dt)"
    _require(name, value, "breakpoints", remedy)


def _require(name: str, value: Any, attribute: str, remedy: str) -> None:
    """Look for an attribute of the class: one of the object may take long."""
    if isinstance(value, type) or not hasattr(type(value), attribute):
        raise InputTypeError(name, value).give(f"{remedy}")
