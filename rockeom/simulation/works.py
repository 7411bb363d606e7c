"""Works and losses of a motion, by quadrature over its steps; its balance of energy."""

from collections.abc import Callable, Mapping
from itertools import product
from typing import NamedTuple

import numpy as np

from rockeom.codes import REST
from rockeom.integrator.schema import GeneratedModule, SearchedModes, has_landings, is_by_code
from rockeom.numbers.functions import gauss_rule
from rockeom.simulation.events import EventColumns, Events
from rockeom.simulation.steps import Rows, Steps
from rockeom.structures.base import Structure
from rockeom.structures.evaluation import at_states, filled, jets
from rockeom.structures.searched_modes import breaking, slipping

_WORKS = ("ground_work", "damping_loss", "force_work", "friction_loss")


def names_of_works(module: GeneratedModule) -> tuple[str, ...]:
    """Names of the works and losses that powers have."""
    return (*_WORKS, *(f"{name}_loss" for name in module.ELEMENT_NAMES))


def names_of_losses(module: GeneratedModule) -> tuple[str, ...]:
    """Names of the losses at events: of impacts, and of ties that break."""
    return ("impact_loss", *(f"{name}_break" for name in breaking(module)))


_CHUNK = 2048  # steps at once, so that memory is bounded


class EnergyBalance(NamedTuple):
    """Origin and whereabouts of the energy of a response.

    Parameters
    ----------
    input : float
        Work of the shaking on the masses, seen from the ground that moves [J]. On a slope the
        gravitational energy is m g times the height along its normal, and the rest of the work of
        the weight counts here.
    damping : float
        Energy lost in dampers and by yielding, less the work of forces that are declared by
        themselves (`Force`) [J].
    impacts : float
        Energy lost at impacts, and in springs that are let go while they are drawn [J].
    gained : float
        Energy at the end less that at the start [J].
    error : float
        The rest input - damping - friction - impacts - gained, over the largest of them and of the
        kinetic, gravitational (of the height above the ground) and elastic energies on the way.
    friction : float, optional
        Energy lost where points slide [J].
    impact_gains : float, optional
        Energy of the impacts that gained some, which `impacts` has less [J]; see
        ``run.impacts.energy_gains``.
    breaks : float, optional
        Energy that ties held as they broke [J].
    """

    input: float
    damping: float
    impacts: float
    gained: float
    error: float
    friction: float = 0.0
    impact_gains: float = 0.0
    breaks: float = 0.0


class Works:
    """Works and losses of a motion since it began, by quadrature over its steps.

    The loss at impacts is the energy before them less that behind them. In the time in which
    infinitely many of them bring a structure on points to rest, it is the loss that no other
    explains. ground : its accelerations at times (n,). forces : those at points, at times that do
    not fall, by the compiled program.
    """

    def __init__(
        self,
        structure: Structure,
        ground: Callable[[np.ndarray], tuple[np.ndarray, ...]],
        forces: Callable[[Rows], Mapping[str, np.ndarray]],
        steps: Steps,
        events: EventColumns,
    ) -> None:
        self.structure, self.ground, self.forces, self.steps = structure, ground, forces, steps
        self.events = Events(structure, events)
        self.names = names_of_works(structure.module)
        starts, lengths = self.steps.span.T
        n = len(starts)
        of_steps = [
            self._within(np.arange(i, min(i + _CHUNK, n)), np.ones(min(_CHUNK, n - i)))
            for i in range(0, n, _CHUNK)
        ]
        self.table = np.zeros((n + 1, len(self.names)))
        np.cumsum(np.concatenate(of_steps), axis=0, out=self.table[1:])
        every = np.arange(n)
        energies = self._energies(self.steps.powers[:, 0], self.steps.mode)
        self.first, self.largest = energies.sum(axis=0), float(abs(energies).max())
        self.last = self._energy(self.steps.states(every, np.ones(n)), self.steps.mode)
        times, kinds, states = events
        ends = starts + lengths
        self.rests = np.isin(ends, times[kinds[:, 0] == REST]) & has_landings(structure.module)
        lost = np.zeros(n + 1)
        seams = np.flatnonzero(np.isin(starts[1:], times)) + 1
        lost[seams] = self.last[seams - 1] - self.first[seams]
        self.begin, self.end = self.first[0], self.last[-1]
        if len(times) and times[0] <= starts[0]:  # an impact at once, which no step is before
            self.begin = self._energy(states[:1, 0], kinds[:1, 1])[0]
            lost[0] = self.begin - self.first[0]
        if len(times) and times[-1] >= ends[-1]:
            self.end = self._energy(states[-1:, 1], kinds[-1:, 2])[0]
            lost[n] = self.last[-1] - self.end
        inside = np.zeros(n + 1)
        resting = np.flatnonzero(self.rests)
        inside[resting + 1] = self._unexplained(
            np.diff(self.table, axis=0)[resting], self.last[resting] - self.first[resting]
        )
        self.breaks = self._breaks(starts)
        self.impacts = np.cumsum(lost + inside - self.breaks.sum(axis=0))
        np.cumsum(self.breaks, axis=1, out=self.breaks)

    def _breaks(self, starts: np.ndarray) -> np.ndarray:
        """(m, n + 1) energy that each of m ties held as it broke, at the step behind, or the end.

        starts (n,) : times at which steps begin.
        """
        module = self.structure.module
        times, kinds, states = self.events.columns
        names = breaking(module)
        held = np.zeros((len(names), len(starts) + 1))
        n = len(module.ELEMENT_NAMES)
        for row, (name, i) in enumerate(names.items()):
            broke = np.flatnonzero(states[:, 1, i] > states[:, 0, i])
            for k in broke.tolist():
                before = filled(
                    module, self.structure.vector, "elements", 4 * n, kinds[k : k + 1, 1],
                    states[k : k + 1, 0],
                )  # fmt: skip
                energy = before.reshape(n, 4)[module.ELEMENT_NAMES.index(name), 2]
                held[row, np.searchsorted(starts, times[k])] = energy
        return held

    def _energies(self, y: np.ndarray, mode: np.ndarray) -> np.ndarray:
        """(3, n) kinetic, gravitational and elastic energy."""
        return filled(self.structure.module, self.structure.vector, "energies", 3, mode, y)

    def _energy(self, y: np.ndarray, mode: np.ndarray) -> np.ndarray:
        return self._energies(y, mode).sum(axis=0)

    @staticmethod
    def _unexplained(work: np.ndarray, gained: np.ndarray) -> np.ndarray:
        ground, damping, force, friction = work[:, :4].T
        return ground - damping + force - friction - gained

    def _within(self, index: np.ndarray, x: np.ndarray) -> np.ndarray:
        """(n, m) works from the start of steps to places x in [0, 1] of them."""
        start, length = self.steps.span[index].T
        nodes, weights = gauss_rule()  # a step has degree 7, and its square degree 14
        places = 0.5 * np.multiply.outer(x, 1.0 + nodes)
        t = start[:, None] + places * length[:, None]
        every = np.repeat(index, len(nodes))
        y = self.steps.states(every, places.ravel())
        powers = self._powers(t.ravel(), y, self.steps.mode[every])
        parts = 0.5 * np.multiply.outer(x * length, weights)
        return np.einsum("ij,kij->ik", parts, powers.reshape(len(self.names), *parts.shape))

    def _powers(self, t: np.ndarray, y: np.ndarray, mode: np.ndarray) -> np.ndarray:
        """(m, n), in the order of the names."""
        module, p, ground = self.structure.module, self.structure.vector, self.ground(t)
        n = len(module.ELEMENT_NAMES)
        powers = filled(module, p, "powers", 3, mode, y, *ground)
        lost = np.empty((0, len(t)))
        if n > 0:
            lost = filled(module, p, "elements", 4 * n, mode, y).reshape(n, 4, len(t))[:, 3]
        friction = np.zeros((1, len(t)))
        if has_landings(module):
            friction[0] = self._friction(module, Rows(t, y, mode), ground)
        return np.concatenate([powers, friction, lost])

    def _friction(self, m: SearchedModes, rows: Rows, ground: tuple[np.ndarray, ...]) -> np.ndarray:
        """(n,) power that friction takes."""
        p, lost = self.structure.vector, np.zeros(len(rows.t))
        ways: tuple[str, ...] = ("",)
        some, (t, y, mode) = np.full(len(rows.t), True), rows
        if is_by_code(m):  # to solve for forces takes long: only where a point slips
            some, ways = slipping(m, mode), ("_x", "_y")
            if not some.any():
                return lost
            t, y, mode = (column[some] for column in rows)
            rates = np.roll(y.T, -(m.N_STATES // 2), axis=0)  # of coordinates alone
            forces = self.forces(Rows(t, y, mode))
        else:
            rates = filled(m, p, "rates", m.N_STATES, mode, y, *ground)
            forces = at_states(m, p, "reactions", mode, y, *ground)
        moves = jets(m, p, "kinematics", len(m.KINEMATICS), mode, y, rates)[1]
        for point, way in product(m.POINTS, ways):
            if (name := f"{point}_slip{way}") in m.KINEMATICS:
                lost[some] -= forces[f"{point}_friction{way}"] * moves[m.KINEMATICS.index(name)]
        return lost

    def at(self, rows: Rows) -> dict[str, np.ndarray]:
        """All of them at times, states and modes, (n,) each by name."""
        t, y, mode = rows
        starts, lengths = self.steps.span.T
        index = np.clip(np.searchsorted(starts, t, side="right") - 1, 0, len(starts) - 1)
        # the state before a jump is the end of the step before
        seam = np.flatnonzero((t == starts[index]) & (index > 0))
        there = self.steps.states(index[seam], np.zeros(len(seam)))
        before = self.steps.states(index[seam] - 1, np.ones(len(seam)))
        away, near = (np.abs(y[seam] - one).max(axis=1, initial=0.0) for one in (there, before))
        of_before = mode[seam] == self.steps.mode[index[seam] - 1]
        of_after = mode[seam] == self.steps.mode[index[seam]]
        index[seam[(near < away) | ((near == away) & of_before & ~of_after)]] -= 1
        x = np.clip((t - starts[index]) / lengths[index], 0.0, 1.0)
        within = np.concatenate(
            [
                self._within(index[i : i + _CHUNK], x[i : i + _CHUNK])
                for i in range(0, len(t), _CHUNK)
            ]
            or [np.empty((0, len(self.names)))]
        )
        works = dict(zip(self.names, (self.table[index] + within).T, strict=True))
        impacts = self.impacts[index].copy()
        rests = np.flatnonzero(self.rests[index])
        gained = self._energy(y[rests], mode[rests]) - self.first[index[rests]]
        impacts[rests] += self._unexplained(within[rests], gained)
        at_events = [impacts, *self.breaks[:, index]]
        return works | dict(zip(names_of_losses(self.structure.module), at_events, strict=True))

    def balance(self) -> EnergyBalance:
        """Works and losses of the whole motion."""
        ground, damping, force, friction = self.table[-1, :4].tolist()
        impacts, gained = float(self.impacts[-1]), float(self.end - self.begin)
        breaks = float(self.breaks[:, -1].sum())
        lost = damping - force
        left = ground - lost - friction - impacts - breaks - gained
        largest = max(*map(abs, (ground, lost, friction, impacts, gained)), self.largest)
        error = abs(left) / largest if largest else 0.0
        gains = float(self.events.impacts.energy_gains.sum())
        return EnergyBalance(ground, lost, impacts, gained, error, friction, gains, breaks)
