"""Events of a motion: impacts, uplifts, slips, rests; their times, modes and states."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import ClassVar, NamedTuple, overload

import numpy as np

from rockeom.codes import (
    ENERGY_ROUNDING,
    FRICTIONLESS,
    IDLE_POINT,
    IMPACT,
    KIND_OF,
    LANDING,
    LIFTING,
    REST,
    SLIP_RIGHT,
    STICK,
    STICKING,
)
from rockeom.integrator.schema import (
    GeneratedModule,
    ground_axes,
    has_landings,
    has_points,
    is_by_code,
)
from rockeom.numbers import explained
from rockeom.numbers.checks import InputTypeError, described
from rockeom.structures.base import Structure
from rockeom.structures.evaluation import filled
from rockeom.structures.modes import modes_of
from rockeom.structures.pickled import made_of
from rockeom.structures.searched_modes import HAPPENED, breaking, landing_speeds

KINDS = (*KIND_OF, "rest", *HAPPENED.values())
"""Words of the kinds of events, by number."""

BREAK = "break"
"""Word for the switch in which a tie breaks."""

IDLE, BEARS_AGAIN, RELEASE, TURN = "idle", "bears again", "released", "slip turns"
"""Words for a point in space that ceases to bear while others keep it closed, and its return; for
one that never slips and is let loose; and for a slip that has turned to another quarter."""

MEASURABLE = 1e-3
"""Angular velocity above which an impact is counted by itself [rad/s, or the rotation's unit/s]."""


@dataclass(frozen=True)
class Event:
    """Transition from one mode to another.

    Parameters
    ----------
    time : float
        Time [s].
    kind : str
        "impact"; "uplift"; "switch" (a foot leaves or meets a spring); "rest" (the limit of
        infinitely many impacts); "break" of a tie. Where contacts may open and slide: "landing",
        "lifting", "slip begins", "slip ends"; in space "slip turns", "idle", "bears again" and
        "released". "bound", where a declaration holds no further, or a body in space has overturned
        by its tilt.
    mode_before : str
        Name of the mode before.
    mode_after : str
        Name of the mode after.
    before : dict of str to float
        States before, by name [rad, m, rad/s, m/s].
    after : dict of str to float
        States after, by name.
    contact : str, optional
        Name of the point that landed, lifted or slipped, or of the element that switched; of
        several at once joined by "+", such as "left+right"; or of the bound. Empty where the modes
        say all.
    """

    time: float
    kind: str
    mode_before: str
    mode_after: str
    before: dict[str, float]
    after: dict[str, float]
    contact: str = ""


class EventColumns(NamedTuple):
    """k events as arrays.

    times (k,) [s]; kinds (k, 4) : kind, mode before, mode after, guard; states (k, 2, N) before and
    after.
    """

    times: np.ndarray
    kinds: np.ndarray
    states: np.ndarray

    def of(self, *kinds: int) -> EventColumns:
        """The events of some kinds."""
        some = np.isin(self.kinds[:, 0], kinds)
        return EventColumns(*(column[some] for column in self))


@explained.attributes(time="times", speed="speeds", energy="energy_loss")
@dataclass(frozen=True, eq=False, repr=False)
class Events(Sequence[Event]):
    """Events in the order of time: a sequence of `Event`, and the same in `columns`.

    Parameters
    ----------
    structure : Structure
        Structure.
    columns : EventColumns
        Events by columns.

    Examples
    --------
    With a response `run`::

        run.events[0].kind, run.events.times, run.events.rest_time
    """

    structure: Structure
    columns: EventColumns

    __getstate__ = made_of

    def __len__(self) -> int:
        return len(self.columns.times)

    @overload
    def __getitem__(self, which: int) -> Event: ...

    @overload
    def __getitem__(self, which: slice) -> tuple[Event, ...]: ...

    def __getitem__(self, which: int | slice) -> Event | tuple[Event, ...]:
        try:
            return self._events[which]
        except IndexError:
            raise IndexError(f"no event {which}: there are {len(self)}, from 0 on") from None
        except TypeError:
            raise InputTypeError("event", which).says(
                f"{described(which)} is no number of an event: give one from 0 on, or select by "
                "kind, as in [event for event in run.events if event.kind == 'uplift']"
            ) from None

    def __iter__(self) -> Iterator[Event]:
        return iter(self._events)

    def __eq__(self, other: object) -> bool:
        return tuple(self) == tuple(other) if isinstance(other, Sequence) else NotImplemented

    def __hash__(self) -> int:
        return hash(self.times.tobytes())

    def __repr__(self) -> str:
        return repr(self._events)

    @cached_property
    def _events(self) -> tuple[Event, ...]:
        module, states = self.structure.module, self.structure.states
        p = self.structure.vector
        points = modes_of(module).subjects(module, self.columns.kinds, self.columns.states, p)
        ties = breaking(module)
        rows = zip(*self.columns, points, strict=True)
        return tuple(
            Event(
                float(time),
                BREAK
                if contact in ties and pair[1, ties[contact]] > pair[0, ties[contact]]
                else _word(module, kind, before, after, guard),
                module.MODES[before],
                module.MODES[after],
                dict(zip(states, pair[0].tolist(), strict=True)),
                dict(zip(states, pair[1].tolist(), strict=True)),
                contact,
            )
            for time, (kind, before, after, guard), pair, contact in rows
        )

    @property
    def times(self) -> np.ndarray:
        """(k,) [s]."""
        return self.columns.times

    @property
    def rest_time(self) -> float | None:
        """Last time at which infinitely many impacts had come to their end [s], or None."""
        rests = self.columns.of(REST).times
        return float(rests[-1]) if len(rests) else None

    @cached_property
    def impacts(self) -> Impacts:
        """The impacts; of contacts that may open and slide each landing is one."""
        return Impacts(self.structure, self.columns.of(IMPACT, LANDING))


def _word(module: GeneratedModule, kind: int, before: int, after: int, guard: int) -> str:
    """Word of an event; a point whose force falls to zero may become idle, and bear again."""
    if not (kind in (LIFTING, STICKING) and is_by_code(module) and has_points(module)):
        return KINDS[kind]
    point = module.SUBJECTS[before][guard]
    was, comes = (module.POINT_STATES[mode][point] for mode in (before, after))
    if kind == STICKING:
        return TURN if comes == SLIP_RIGHT else KINDS[kind]
    if comes == IDLE_POINT:
        return IDLE
    if was == IDLE_POINT:
        return BEARS_AGAIN
    return RELEASE if (was, comes) == (STICK, FRICTIONLESS) else KINDS[kind]


@dataclass(frozen=True, eq=False, repr=False)
class Impacts(Events):
    """Impacts of a motion in the order of time, with their speeds, impulses and energies.

    Parameters
    ----------
    structure : Structure
        Structure.
    columns : EventColumns
        Events by columns.

    Examples
    --------
    With a response `run`::

        run.impacts[0].time, run.impacts.impulses(), run.impacts.energy_loss
    """

    measurable: ClassVar[float] = MEASURABLE

    @cached_property
    def speeds(self) -> np.ndarray:
        """Sizes of the angular velocities just before (k,) [rad/s, or the rotation's unit/s].

        Where points land, the speed of the fastest [m/s].
        """
        before = self.columns.states[:, 0]
        module = self.structure.module
        if has_landings(module):
            return landing_speeds(module, self.structure.vector, before)
        return np.abs(before[:, module.ROTATION_RATE])

    def above(self, rate: float = MEASURABLE) -> tuple[Event, ...]:
        """Impacts before which the structure turned faster than a rate.

        Before it comes to rest a structure has endlessly many smaller ones, whose number depends on
        the last digit of everything.

        Parameters
        ----------
        rate : float, optional
            Angular velocity [rad/s], or the unit of the rotation over that of time; 0.001 rad/s is
            1 mm/s at a metre from the foot.

        Returns
        -------
        tuple of Event
            Impacts.
        """
        rates = self.columns.states[:, 0, self.structure.module.ROTATION_RATE]
        return tuple(self[i] for i in np.flatnonzero(np.abs(rates) > rate).tolist())

    def impulses(self) -> np.ndarray:
        """Horizontal and vertical impulse of the ground, on all feet together.

        Returns
        -------
        ndarray
            Impulses (k, 2) [N s], the gain of momentum of all bodies; in space (k, 3), along both
            horizontal axes and upwards.
        """
        before, after = self.momenta
        return (after - before).T

    @cached_property
    def momenta(self) -> np.ndarray:
        """(2, axes, k) momentum before and after along the axes of the ground [N s]."""
        axes = len(ground_axes(self.structure.module))
        return np.stack([self._of_sides("momentum", axes, side) for side in (0, 1)])

    @property
    def energy_gains(self) -> np.ndarray:
        """Kinetic energy gained at each impact that gained some (g,) [J]; empty for most motions.

        An impact gains energy where the kinetic energy grows by more than 1e-9 of itself. On a
        structure that bends every impact law but `Impulsive` can do so; on feet that slide, with
        friction and a restitution above zero, those of contacts but "lzb" and "pairwise", see
        `rockeom.symbolic.Rigid`. A motion that depends on such impacts is not to be trusted.
        """
        before, after = self._energies
        return (after - before)[after > before * (1.0 + ENERGY_ROUNDING)]

    @property
    def energy_loss(self) -> float:
        """Kinetic energy lost at all impacts together [J]; gains at others are not deducted."""
        before, after = self._energies
        return float(np.maximum(before - after, 0.0).sum())

    @cached_property
    def _energies(self) -> np.ndarray:
        """(2, k) kinetic energy before and after each [J]."""
        return np.stack([self._of_sides("energies", 3, side)[0] for side in (0, 1)])

    def _of_sides(self, function: str, size: int, side: int) -> np.ndarray:
        """(size, k) of a function of the module in the states before (0) or after (1)."""
        m, p = self.structure.module, self.structure.vector
        _, kinds, states = self.columns
        return filled(m, p, function, size, kinds[:, 1 + side], states[:, side])

    def describe(self) -> str:
        """Number of impacts, and of those faster than ``MEASURABLE``, in words.

        Returns
        -------
        str
            Text.
        """
        unit = self.structure.module.STATE_UNITS[self.structure.module.ROTATION_RATE]
        faster = f", {len(self.above())} of them faster than {MEASURABLE:g} {unit}"
        return f"{len(self)} impacts{faster if len(self) else ''}"
