"""The response of a structure, and how it ended."""

from __future__ import annotations

import importlib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from enum import Enum
from functools import cached_property
from types import ModuleType
from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from rockeom.motion import GroundMotion
    from rockeom.numeric.structures import Structure


class Outcome(Enum):
    """How a motion ended; `sentence` says it to a reader."""

    COMPLETED = ("completed", "The motion was followed to the end of the duration.")
    CAME_TO_REST = ("came to rest", "The structure stands at rest in full contact.")
    OVERTURNED = ("overturned", "The structure fell over.")
    TOO_MANY_IMPACTS = ("too many impacts", "More impacts happened than max_impacts allows.")
    STALLED = (
        "stalled",
        "The step became too small or the steps too many: loosen rtol, or look for a stiff part.",
    )
    CHATTER = ("chatter", "Contact states followed one another without time going on.")
    NOT_FINITE = ("not finite", "The state became infinite or not a number: check the parameters.")

    def __init__(self, label: str, sentence: str) -> None:
        self.label = label
        self.sentence = sentence

    def __str__(self) -> str:
        return self.label


@dataclass(frozen=True)
class Impact:
    """One passage from a contact state to another.

    kind : "impact"; "uplift"; "switch" (a foot leaves or meets a spring); "rest" (the limit of
        infinitely many impacts).
    before, after : the states on both sides, by name.
    """

    time: float
    kind: str
    phase_before: str
    phase_after: str
    before: dict[str, float]
    after: dict[str, float]


_KINDS = ("impact", "uplift", "switch", "rest")


@dataclass(frozen=True)
class Steps:
    """The dense record: steps (n, 2) start and length [s], contact (n,), powers (n, 8, N)."""

    span: np.ndarray
    contact: np.ndarray
    powers: np.ndarray

    def at(self, times: np.ndarray, side: str) -> tuple[np.ndarray, np.ndarray]:
        """States (m, N) and contact states (m,) at times (m,)."""
        starts = self.span[:, 0]
        found = np.searchsorted(starts, times, side="right" if side == "right" else "left")
        index = np.clip(found - 1, 0, len(starts) - 1)
        x = (times - starts[index]) / self.span[index, 1]
        powers = self.powers[index]
        values = powers[:, 7]
        for j in range(6, -1, -1):
            values = values * x[:, None] + powers[:, j]
        return values, self.contact[index]

    def samples(self, spacing: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """(t, states, contact) at both ends of every step and between, no wider than spacing."""
        n = np.maximum(np.ceil(self.span[:, 1] / spacing - 1e-9).astype(int), 1)
        index = np.repeat(np.arange(len(n)), n + 1)
        first = np.cumsum(n + 1) - (n + 1)
        x = (np.arange(len(index)) - np.repeat(first, n + 1)) / np.repeat(n, n + 1)
        powers = self.powers[index]
        values = powers[:, 7]
        for j in range(6, -1, -1):
            values = values * x[:, None] + powers[:, j]
        t = self.span[index, 0] + x * self.span[index, 1]
        # the end of a step is the start of the next: keep one unless a state jumps there
        keep = np.ones(len(t), dtype=bool)
        seam = first[1:]
        same = np.all(
            np.abs(values[seam] - values[seam - 1]) <= 1e-9 * np.abs(values[seam]), axis=1
        )
        keep[seam[same & (self.contact[1:] == self.contact[:-1])]] = False
        return t[keep], values[keep], self.contact[index][keep]


@dataclass(frozen=True)
class Response:
    """What a structure did under a ground motion.

    t (n,) [s], y (n, d) states in the order of `states`, phase (n,) names of contact states.
    Where a velocity jumps t holds the instant twice, before and after. `run["theta"]` gives a
    column of y, or any of `names`: energies [J], reactions [N], displacement and uplifts [m],
    accelerations of the ground [m/s2].
    """

    structure: Structure
    motion: GroundMotion
    vertical: GroundMotion | None
    outcome: Outcome
    duration: float
    output_step: float
    statistics: dict[str, Any]
    steps: Steps
    end: np.ndarray
    passages: tuple[np.ndarray, np.ndarray, np.ndarray]
    tables: tuple[np.ndarray, np.ndarray]
    program: ModuleType

    @cached_property
    def _samples(self) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        return self.steps.samples(self.output_step)

    @property
    def t(self) -> np.ndarray:
        """(n,) times of the samples [s]; the instant of a jump stands twice."""
        return self._samples[0]

    @property
    def y(self) -> np.ndarray:
        """(n, d) states, columns in the order of `states`."""
        return self._samples[1]

    @property
    def contact(self) -> np.ndarray:
        """(n,) number of the contact state."""
        return self._samples[2]

    @cached_property
    def events(self) -> tuple[Impact, ...]:
        """All passages between contact states, in time order."""
        names = self.program.CONTACTS
        return tuple(
            Impact(
                float(time),
                _KINDS[kind],
                names[before],
                names[after],
                dict(zip(self.states, pair[0].tolist(), strict=True)),
                dict(zip(self.states, pair[1].tolist(), strict=True)),
            )
            for time, (kind, before, after), pair in zip(*self.passages, strict=True)
        )

    @property
    def states(self) -> tuple[str, ...]:
        return self.program.STATES

    @property
    def names(self) -> tuple[str, ...]:
        """All that `run[...]` knows."""
        p = self.program
        return (
            *p.STATES, *p.ENERGIES, "total_energy", *p.REACTIONS, *p.KINEMATICS,
            "ground_acceleration", "vertical_ground_acceleration",
        )  # fmt: skip

    @property
    def phase(self) -> np.ndarray:
        """(n,) name of the contact state at each sample."""
        return np.array(self.program.CONTACTS)[self.contact]

    @property
    def impacts(self) -> tuple[Impact, ...]:
        """The impacts, in time order; `events` holds uplifts and other passages too."""
        return tuple(e for e in self.events if e.kind == "impact")

    @property
    def rest_time(self) -> float | None:
        """When infinitely many impacts had come to their end for the last time [s], or None."""
        times, kinds, _ = self.passages
        rests = times[kinds[:, 0] == _KINDS.index("rest")]
        return float(rests[-1]) if len(rests) else None

    def __getitem__(self, name: str) -> np.ndarray:
        if name in self.states:
            return self.y[:, self.states.index(name)]
        if name in self._outputs:
            return self._outputs[name]
        raise KeyError(f"no quantity {name!r}; there are {', '.join(self.names)}")

    @cached_property
    def _outputs(self) -> Mapping[str, np.ndarray]:
        return self._evaluated(self.t, self.y, self.contact)

    def _evaluated(self, t: np.ndarray, y: np.ndarray, contact: np.ndarray) -> dict[str, Any]:
        """What follows from the states y (n, N), at times t (n,) that do not fall."""
        p = self.program
        n = len(t)
        tables = (p.ENERGIES, p.REACTIONS, p.KINEMATICS)
        values = [np.empty((n, len(names))) for names in tables]
        p.evaluate(contact, t, y, *self.tables, self.structure.vector, *values)
        found = {
            name: value[:, i]
            for names, value in zip(tables, values, strict=True)
            for i, name in enumerate(names)
        }
        found["total_energy"] = values[0].sum(axis=1)
        found["ground_acceleration"] = self.motion.acceleration(t)
        found["vertical_ground_acceleration"] = (
            np.zeros(n) if self.vertical is None else self.vertical.acceleration(t)
        )
        return found

    def at(
        self, times, side: str = "right", names: Sequence[str] | None = None
    ) -> dict[str, np.ndarray]:
        """States at the given times [s], each with the shape of `times`, from the dense output.

        side : "left" or "right", which one where a velocity jumps. names : of the states, or of
        any other quantities of the response.
        Raises ValueError for times outside the response, KeyError for an unknown name.
        """
        if side not in ("left", "right"):
            raise ValueError(f"side is {side!r}: choose 'left' or 'right'")
        times = np.asarray(times, dtype=float)
        flat = times.ravel()
        if flat.size and (flat.min() < self.t[0] or flat.max() > self.t[-1]):
            raise ValueError(
                f"times reach from {flat.min()} to {flat.max()} s, the response from "
                f"{self.t[0]} to {self.t[-1]} s"
            )
        names = self.states if names is None else names
        for name in names:
            if name not in self.names:
                raise KeyError(f"no quantity {name!r}; there are {', '.join(self.names)}")
        values, contact = self.steps.at(flat, side)
        found: dict[str, Any] = {n: values[:, i] for i, n in enumerate(self.states)}
        if not set(names) <= set(self.states):
            order = np.argsort(flat, kind="stable")
            y = np.ascontiguousarray(values[order])
            for name, row in self._evaluated(flat[order], y, contact[order]).items():
                found[name] = np.empty(flat.size)
                found[name][order] = row
        return {name: found[name].reshape(times.shape) for name in names}

    @property
    def final(self) -> dict[str, float]:
        """The last state, by name."""
        return dict(zip(self.states, self.end.tolist(), strict=True))

    @cached_property
    def _support(self) -> tuple[np.ndarray, np.ndarray, np.ndarray] | None:
        """Horizontal force and both vertical ones while they matter, or None without feet.

        The last fall of a structure that overturned is left out, from its highest point on:
        nothing could stop it then.
        """
        if "left_reaction" not in self._outputs:
            return None
        end = len(self.t)
        if self.outcome is Outcome.OVERTURNED:
            rising = np.diff(self["gravitational_energy"]) > 0
            end = int(np.flatnonzero(rising)[-1]) + 2 if rising.any() else 1
        names = ("horizontal_reaction", "left_reaction", "right_reaction")
        horizontal, left, right = (self[name][:end] for name in names)
        return horizontal, left, right

    @cached_property
    def friction_demand(self) -> float:
        """Largest |horizontal|/vertical force that not sliding needed; nan without feet.

        Impulses at impacts are not in it, nor is the last fall of a structure that overturned.
        """
        if self._support is None:
            return float("nan")
        horizontal, left, right = self._support
        pressed = left + right > 0
        if not pressed.any():
            return float("nan")
        return float(np.max(np.abs(horizontal[pressed]) / (left + right)[pressed]))

    @cached_property
    def lost_contact(self) -> bool:
        """Whether the ground would have had to pull a foot: the model's assumption failed then."""
        if self._support is None:
            return False
        _, left, right = self._support
        weight = max(float(np.max(np.abs(left + right))), 1e-300)
        return bool(min(left.min(), right.min()) < -1e-9 * weight)

    def assumptions(self) -> str:
        """How far the assumptions of no sliding and no lost contact held, in words."""
        if self._support is None:
            return "The model has no feet: it says nothing of sliding or contact."
        text = f"Not sliding needed a friction coefficient of at least {self.friction_demand:.3g}."
        if self.lost_contact:
            return text + " A foot's vertical reaction turned negative: it would have jumped."
        return text + " No foot's vertical reaction turned negative."

    def summary(self) -> str:
        """The response in words."""
        rotation = self.states[self.program.ROTATION]
        unit = self.program.STATE_UNITS[self.program.ROTATION]
        peak = np.abs(self[rotation])
        lines = [
            f"{type(self.structure).__name__} under {self.motion.name or 'a ground motion'}, "
            f"{self.t[-1]:.6g} s of {self.duration:.6g} s.",
            f"Outcome: {self.outcome}. {self.outcome.sentence}",
            f"Largest |{rotation}|: {peak.max():.4g} {unit} at {self.t[peak.argmax()]:.4g} s; "
            f"{len(self.impacts)} impacts.",
        ]
        if self.rest_time is not None:
            lines.append(f"Infinitely many impacts came to an end at {self.rest_time:.9g} s.")
        return "\n".join([*lines, self.assumptions()])

    def plot(self, **kwargs):
        """A figure of rotation, displacement, uplift and impacts; see rockeom.plots."""
        return importlib.import_module("rockeom.plots").plot_response(self, **kwargs)

    def __repr__(self) -> str:
        return f"<Response: {self.outcome}, {self.duration:.6g} s, {len(self.impacts)} impacts>"
