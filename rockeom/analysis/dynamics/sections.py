"""Steady motions under periodic shaking: Poincare sections, coexisting orbits, basins.

    import numpy as np
    import rockeom as rk
    from rockeom.analysis import dynamics

    block = rk.SlenderBlock.from_frequency(p=2.0, alpha=0.2)
    shaking = rk.GroundMotion.harmonic(1.5, period=0.6, duration=300.0)
    stroboscope = dynamics.StroboscopicMap(block, shaking, period=0.6, impact=rk.VelocityRatio(0.9))
    starts = {"theta": np.linspace(-0.1, 0.1, 40), "theta_dot": np.linspace(-0.3, 0.3, 40)}
    found = dynamics.poincare_sections(stroboscope, starts=starts, settling=200, cycles=16)
    basins = dynamics.basins(found)
    dynamics.basin_stability(basins)

A motion is looked at once a period of the ground, and at its impacts: each look is a point of a
section of its states (Poincare's). The orbit on which it settles depends on its start; the starts
that end on the same orbit are its basin. Many motions are followed from many starts, and for many
values of parameters, by `simulate_many`.
"""

from __future__ import annotations

import os
import sys
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import xarray as xr

from rockeom.analysis.arguments import dims_of_starts
from rockeom.analysis.dynamics.orbits import StroboscopicMap
from rockeom.analysis.sweeps import FALLS, NOT_RUN, STANDS, check_finished
from rockeom.numbers.checks import (
    InputError,
    InputTypeError,
    numbers,
    positive,
    require,
    require_type,
    whole_number,
)
from rockeom.simulation.case import Case
from rockeom.simulation.quantities import units_of
from rockeom.structures.base import Structure
from rockeom.structures.units import in_udunits, time_unit
from rockeom.sweeps.cases import ROW, Cases
from rockeom.sweeps.options import SweepOptions
from rockeom.sweeps.run import simulate_many
from rockeom.sweeps.unfinished import Unfinished, part_for_users
from rockeom.sweeps.workers import Progress


@part_for_users
def poincare_sections(
    stroboscope: StroboscopicMap | Callable[..., StroboscopicMap],
    over: Mapping[str, Any] | None = None,
    *,
    starts: Any,
    settling: int = 100,
    cycles: int = 50,
    impacts: int = 0,
    threads: int | None = None,
    progress: bool | None = None,
    store: str | os.PathLike[str] | None = None,
) -> xr.Dataset:
    """States at the starts of cycles, and at impacts, of motions from several starts.

    Parameters
    ----------
    stroboscope : StroboscopicMap or callable
        A map; or a function that makes one from one value of each name in `over`, of any parameter
        of the structure, its impacts or its shaking, whose period may vary, too. All states are
        followed, and looked at once a whole period, whatever the map says of these.
    over : dict of str to sequence, optional
        Names and their values, a grid.
    starts : dict or list of dict or pandas.DataFrame
        States at the time zero, those that are not named being zero: names and their values are a
        grid, over which the dataset is, too; a table (a list of dicts, a DataFrame) has a start in
        each row, and the dataset is over "start".
    settling : int, optional
        Number of cycles before the recorded ones.
    cycles : int, optional
        Number of recorded cycles.
    impacts : int, optional
        Largest number of recorded impacts, in the mean of a cycle.
    threads : int, optional
        Number of threads, as for `SweepOptions`.
    progress : bool, optional
        Whether a line on stderr shows the progress, as for `SweepOptions`.
    store : path_like, optional
        Folder of finished cases, of the package zarr, as for `SweepOptions`: the same call
        continues where the last one was stopped, with the same result to the last bit.

    Returns
    -------
    xarray.Dataset
        Dataset over the names and the starts: strobe over "look" and "state", all states at the
        start of each recorded cycle and at the end of the last; impact_count over "cycle"; outcome,
        a label, of the last cycle that was followed. With `impacts`, also impact_time since the
        start of its cycle [s], and impact_state over "side", which is before or after, both over
        "impact", in the order of time; for these the cycles are followed a second time. Missing
        values are NaN: a motion that has overturned has no states. An interrupt ends the work
        early, ``attrs["interrupted"]`` is 1.

    Raises
    ------
    ValueError
        For names that are no states, and as `simulate_many` does.

    Notes
    -----
    As many cycles as the motion of the ground lasts are settled in one go, one after the other
    otherwise; a motion that lasts for all of them saves time. The motions have the options of the
    first map, and continue from cycle to cycle in their mode.

    Examples
    --------
    With a block and the unit of acceleration `unit`::

        def shaken(beta):
            ground = rk.GroundMotion.harmonic(beta * unit, period=3.0, duration=600.0)
            return dynamics.StroboscopicMap(block, ground, 3.0, impact=rk.VelocityRatio(0.5))

        dynamics.poincare_sections(
            shaken,
            over={"beta": np.linspace(3.0, 3.26, 200)},
            starts=[{"x": 0.1}, {"x": -0.1}],
            settling=150,
            cycles=32,
            impacts=4,
        )
    """
    plan = _Plan.of(stroboscope, over, starts)
    settling, cycles = whole_number("settling", settling, 0), whole_number("cycles", cycles, 1)
    impacts = whole_number("impacts", impacts, 0)
    shown = sys.stderr.isatty() if progress is None else progress
    rounds = settling + cycles * (2 if impacts else 1)
    with Progress(plan.total * rounds, shown, "cycles") as line:
        how = _How(threads, None if store is None else Path(store), line)
        motions = plan.motions(how)
        for k, stride in enumerate(plan.strides(settling)):
            motions.go(stride, f"settling_{k}")
        again = motions.copy()
        strobe, count = [motions.y.copy()], []
        for k in range(cycles):
            count.append(motions.go(1, f"cycle_{k}")["impacts"])
            strobe.append(motions.y.copy())
        recorded = {"strobe": np.stack(strobe, axis=1), "count": np.stack(count, axis=1)}
        if impacts:
            parts = [
                again.go(stride, f"impacts_{k}", impacts * stride)
                for k, stride in enumerate(plan.strides(cycles))
            ]
            for name in ("impact_time", "impact_state"):
                recorded[name] = np.concatenate([part[name] for part in parts], axis=1)
            recorded["impact_time"] %= again.periods[:, None]
            motions.interrupted |= again.interrupted
    sections = plan.dataset(motions, recorded)
    if motions.interrupted:
        raise Unfinished(sections)
    return sections


# --- which motions end on the same orbit

NOT_PERIODIC, FALLEN, UNKNOWN = 0, -1, -2
"""Fates of motions that are on no periodic orbit; the orbits are numbered from one on."""


def basins(sections: xr.Dataset, tolerance: float = 1e-3) -> xr.Dataset:
    """Starts that end on the same periodic orbit, from sections of one map.

    Parameters
    ----------
    sections : xarray.Dataset
        Dataset of `poincare_sections`, over starts alone.
    tolerance : float, optional
        Tolerance of a look at a motion, in parts of the largest size that each state has in any of
        them.

    Returns
    -------
    xarray.Dataset
        Dataset with the `fate` of each start: from 1 on the number of its orbit, the one with the
        most starts first; 0 not periodic within the recorded cycles, whether chaotic, of a long
        period or not yet settled; -1 overturned; -2 without an answer. Its attributes flag_values
        and flag_meanings say so. orbit_cycles and orbit_state, a look at it, belong to each orbit.

    Raises
    ------
    ValueError
        For sections of several maps or that were not run to their end, and for a tolerance that is
        not positive.

    Notes
    -----
    A motion is periodic if all its looks repeat themselves within the tolerance after as many
    cycles as half of the recorded ones or fewer; two are on one orbit if the last look at one is as
    near to one at the other. Orbits that are nearer to each other than that, as late in a cascade,
    count as one, and a motion that settles so slowly that it seems to repeat itself counts as
    periodic.

    Examples
    --------
    With a map `stroboscope`::

        looks = dynamics.poincare_sections(
            stroboscope,
            starts={"theta": np.linspace(-0.2, 0.2, 200), "theta_dot": np.linspace(-1, 1, 200)},
            settling=200,
            cycles=16,
        )
        dynamics.basins(looks)
    """
    (tolerance,) = (float(one) for one in positive("basins", tolerance=tolerance))
    dims_of_starts("basins", sections)  # refuses others
    check_finished("basins", sections)
    strobe = sections["strobe"].values
    looks = strobe.reshape(-1, *strobe.shape[-2:])
    labels = sections["outcome"].values.ravel()
    fate = np.where(labels == FALLS, FALLEN, UNKNOWN)
    there = np.isin(labels, STANDS) & np.isfinite(looks).all(axis=(1, 2))
    size = np.abs(looks[there]).max(axis=(0, 1), initial=0.0)
    scaled = looks[there] / np.where(size > 0, size, 1.0)
    fate[there], orbits = _orbits(scaled, tolerance)
    state = looks[there][[first for first, _ in orbits], -1]
    words = [f"orbit_{i}" for i in range(1, len(orbits) + 1)]
    attrs = {
        "long_name": "what a start ends on",
        "flag_values": np.arange(UNKNOWN, len(orbits) + 1),
        "flag_meanings": " ".join(["no_answer", "overturned", "not_periodic", *words]),
    }
    return sections.assign(
        fate=(sections["outcome"].dims, fate.reshape(sections["outcome"].shape), attrs),
        orbit_cycles=("orbit", [cycles for _, cycles in orbits], {"long_name": "cycles of it"}),
        orbit_state=(("orbit", "state"), state.reshape(-1, strobe.shape[-1])),
    ).assign_coords(orbit=np.arange(1, len(orbits) + 1))


def basin_stability(basins: xr.Dataset, level: float = 0.95) -> xr.Dataset:
    """Part of the starts that ends on each orbit, with confidence bounds.

    Parameters
    ----------
    basins : xarray.Dataset
        Dataset of `basins`. Starts without an answer are not counted.
    level : float, optional
        Probability of the bounds, which are Wilson's, of starts that were drawn at random; those of
        a grid are no sample: the areas are then more accurate than the bounds.

    Returns
    -------
    xarray.Dataset
        Share, low, high and number of starts over `fate`, the meanings of `basins`.

    Raises
    ------
    ValueError
        For a level that does not lie between 0 and 1, and where no start has an answer.

    References
    ----------
    Menck, Heitzig, Marwan and Kurths (2013), Nature Physics 9, 89-92.

    Examples
    --------
    With a map `stroboscope`::

        rng = np.random.default_rng(1)
        starts = [{"theta": a, "theta_dot": b} for a, b in rng.uniform(-0.1, 0.1, (2000, 2))]
        looks = dynamics.poincare_sections(stroboscope, starts=starts, settling=200, cycles=16)
        dynamics.basin_stability(dynamics.basins(looks))
    """
    from scipy.stats import binomtest  # takes long to import

    require(0.0 < level < 1.0, "basin_stability", "level", level, "it lies between 0 and 1")
    fate = basins["fate"]
    answered = fate.values[fate.values > UNKNOWN]
    if not len(answered):
        raise ValueError("basin_stability: no start has an answer: run the sections again")
    values = fate.attrs["flag_values"][1:]
    words = [word.replace("_", " ") for word in fate.attrs["flag_meanings"].split()[1:]]
    number = np.array([(answered == value).sum() for value in values])
    bounds = [binomtest(k, len(answered)).proportion_ci(level, method="wilson") for k in number]
    return xr.Dataset(
        {
            "share": ("fate", number / len(answered)),
            "low": ("fate", [one.low for one in bounds]),
            "high": ("fate", [one.high for one in bounds]),
            "number": ("fate", number),
        },
        {"fate": words},
        {"starts": len(answered), "level": level},
    )


def _orbits(looks: np.ndarray, tolerance: float) -> tuple[np.ndarray, list[tuple[int, int]]]:
    """Number of the orbit of each motion, and of each orbit a motion that is on it and its cycles.

    looks (n, c + 1, N) : scaled.
    """
    cycles = _cycles(looks, tolerance)
    orbits = np.full(len(looks), NOT_PERIODIC)
    left = np.flatnonzero(cycles)
    groups: list[np.ndarray] = []
    while len(left):
        first = left[0]
        points = looks[first, -cycles[first] :]
        apart = np.abs(looks[left, -1, None] - points).max(axis=2).min(axis=1)
        mine = apart <= tolerance
        groups.append(left[mine])
        left = left[~mine]
    groups.sort(key=len, reverse=True)
    for number, group in enumerate(groups, 1):
        orbits[group] = number
    return orbits, [(int(group[0]), int(cycles[group[0]])) for group in groups]


def _cycles(looks: np.ndarray, tolerance: float) -> np.ndarray:
    """(n,) after how many cycles each motion repeats itself, 0 if it does not."""
    periods = np.zeros(len(looks), dtype=int)
    for k in range(1, (looks.shape[1] - 1) // 2 + 1):
        left = np.flatnonzero(periods == 0)
        gap = np.abs(looks[left, k:] - looks[left, :-k]).max(axis=(1, 2))
        periods[left[gap <= tolerance]] = k
    return periods


# --- how motions are followed


@dataclass(frozen=True)
class _Plan:
    """Maps (m,) of the values of `over`, and k starts: m k motions, map by map."""

    maps: np.ndarray
    over: Cases | None
    starts: Cases

    @classmethod
    def of(cls, stroboscope: Any, over: Mapping[str, Any] | None, starts: Any) -> _Plan:
        if over is not None and (not isinstance(over, Mapping) or isinstance(over, xr.Dataset)):
            raise InputTypeError("over", over).give("names with their lists of values")
        values = None if over is None else Cases.of(over)
        from_where = Cases.of(starts)
        maps = _maps(stroboscope, values)
        if values is not None and (twice := {*values.values} & {*from_where.values}):
            raise InputError("starts", min(twice), "poincare_sections").says(
                f"{min(twice)!r} is a name of both `over` and `starts`: let the function call its "
                "argument by another one"
            )
        return cls(maps, values, from_where)

    def motions(self, how: _How) -> _Motions:
        n = self.total
        return _Motions(
            how,
            np.repeat(self.maps, self.starts.total),
            np.concatenate([_states(self.starts, one.structure) for one in self.maps]),
            np.full(n, "", dtype=object),
            np.full(n, NOT_RUN, dtype=object),
        )

    @property
    def total(self) -> int:
        return len(self.maps) * self.starts.total

    def strides(self, settling: int) -> list[int]:
        """Cycles that are settled in one go, while the shortest of the motions goes on behind."""
        longest = min(int(one.motion.duration / one.period * (1 + 1e-12)) for one in self.maps) - 1
        whole, rest = divmod(settling, longest)
        return [longest] * whole + [rest] * (rest > 0)

    def dataset(self, motions: _Motions, recorded: Mapping[str, np.ndarray]) -> xr.Dataset:
        module = self.maps[0].structure.module
        seconds = in_udunits(time_unit(module))
        units = [in_udunits(units_of(module)[name]) for name in module.STATES]
        names, of_starts = self.over, self.starts
        dims = (*(() if names is None else names.dims), *of_starts.dims)
        shape = (*(() if names is None else names.shape), *of_starts.shape)

        def shaped(a: np.ndarray, name: str, *others: str, **attrs: Any) -> Any:
            return (*dims, *others), a.reshape(shape + a.shape[1:]), {"long_name": name, **attrs}

        variables = {
            "outcome": shaped(motions.outcome.astype(str), "outcome"),
            "strobe": shaped(recorded["strobe"], "state at the start of a cycle", "look", "state"),
            "impact_count": shaped(recorded["count"], "impacts of the cycle", "cycle", units="1"),
        }
        if "impact_state" in recorded:
            times, states = recorded["impact_time"], recorded["impact_state"]
            each = "impact", "side", "state"
            variables["impact_time"] = shaped(times, "time in the cycle", "impact", units=seconds)
            variables["impact_state"] = shaped(states, "state at the impact", *each)
            variables["side"] = "side", ["before", "after"], {"long_name": "side of the impact"}
        coordinates = {
            **({} if names is None else names.coordinates()),
            **of_starts.coordinates(),
            "state": ("state", list(module.STATES), {"long_name": "name of the state"}),
            "state_unit": ("state", units, {"long_name": "unit of the state"}),
        }
        for name, unit in zip(module.STATES, units, strict=True):
            if name in coordinates:
                coordinates[name][2].update(units=unit, long_name=f"initial {name}")
        made = xr.Dataset(variables, coordinates).rename({ROW: "start"} if ROW in dims else {})
        starts = " ".join("start" if name == ROW else name for name in of_starts.dims)
        interrupted = int(motions.interrupted)
        return made.assign_attrs(model=module.NAME, starts=starts, interrupted=interrupted)


def _maps(stroboscope: Any, over: Cases | None) -> np.ndarray:
    """The map of each value; TypeError for anything else, ValueError for another structure."""
    if over is None:
        stroboscopes = [stroboscope]
    elif not callable(stroboscope):
        raise InputTypeError("stroboscope", stroboscope).give("with `over`, a function")
    else:
        stroboscopes = [stroboscope(**over.named(row)) for row in range(over.total)]
    maps = np.empty(len(stroboscopes), dtype=object)
    for i, one in enumerate(stroboscopes):
        require_type("stroboscope", one, StroboscopicMap, "an analysis.dynamics.StroboscopicMap")
        if one.structure.module is not stroboscopes[0].structure.module:
            raise InputError("stroboscope", of="poincare_sections").says(
                f"{one.structure.model} comes after {stroboscopes[0].structure.model}: follow each "
                "model by itself"
            )
        maps[i] = one
    return maps


def _states(starts: Cases, structure: Structure) -> np.ndarray:
    """(k, N) states at the start; of contacts that may open, heights follow from the rest."""
    names = structure.states
    y = np.zeros((starts.total, len(names)))
    places = starts.places(np.arange(starts.total))
    for (name, values), place in zip(starts.values.items(), places, strict=True):
        if name not in names:
            raise InputError("starts", name).wrong(f"has {name!r}").choose(names)
        (column,) = numbers("poincare_sections", **{f"starts[{name!r}]": values})
        y[:, names.index(name)] = column[place]
    if structure.has_landings:  # heights that are not named follow from the rest
        return np.array([structure.state(starts.named(row)) for row in range(starts.total)])
    return y


class _How(NamedTuple):
    """Options of the work: threads, progress, store."""

    threads: int | None
    store: Path | None
    line: Progress


@dataclass
class _Motions:
    """n motions: their states y (n, N), modes and outcomes."""

    how: _How
    maps: np.ndarray
    y: np.ndarray
    mode: np.ndarray
    outcome: np.ndarray
    interrupted: bool = False

    def copy(self) -> _Motions:
        here = self.y.copy(), self.mode.copy(), self.outcome.copy()
        return _Motions(self.how, self.maps, *here, self.interrupted)

    @property
    def periods(self) -> np.ndarray:
        """(n,) of the ground of each [s]."""
        return np.array([one.period for one in self.maps])

    def go(self, cycles: int, name: str, impacts: int = 0) -> dict[str, np.ndarray]:
        """Continue all motions that have not overturned; the others have no states from then on.

        name : of what is stored. Returns the number of impacts of each, and times and states of so
        many; nan of those that do not stand behind them.
        """
        n, width = self.y.shape
        recorded = {
            "impacts": np.full(n, np.nan),
            "impact_time": np.full((n, impacts), np.nan),
            "impact_state": np.full((n, impacts, 2, width), np.nan),
        }
        there = np.flatnonzero(np.isfinite(self.y).all(axis=1))
        if len(there) and not self.interrupted:
            try:
                sweep = self._swept(there, cycles, name, impacts)
            except Unfinished as interrupt:
                sweep, self.interrupted = interrupt.part, True
            stands = sweep["outcome"].isin(STANDS).values
            self.outcome[there] = sweep["outcome"].values
            self.mode[there] = sweep["final_mode"].values
            self.y[there] = np.where(stands[:, None], sweep["final"].values, np.nan)
            for key in recorded if impacts else ("impacts",):
                recorded[key][there[stands]] = sweep[key].values[stands]
        if self.interrupted:
            self.y[:] = np.nan
            self.outcome[np.isin(self.outcome, STANDS)] = NOT_RUN
        self.how.line.add(n * cycles)
        return recorded

    def _swept(self, there: np.ndarray, cycles: int, name: str, impacts: int) -> xr.Dataset:
        def case(stroboscope: StroboscopicMap, mode: str, **state: float) -> Case:
            one, end = stroboscope, cycles * stroboscope.period
            return Case(one.structure, one.motion, one.impact, state, end, mode=mode or None)

        threads, store = self.how.threads or os.cpu_count() or 1, self.how.store
        states = self.maps[0].structure.states
        rows = {"stroboscope": self.maps[there], "mode": self.mode[there]}
        rows |= {name: self.y[there, i] for i, name in enumerate(states)}
        return simulate_many(
            case,
            xr.Dataset({key: ("row", values) for key, values in rows.items()}),
            impact_times=impacts,
            impact_states=impacts > 0,
            options=self.maps[0].options,
            sweep_options=SweepOptions(
                threads=threads,
                chunk=None if store is None else -(-len(there) // (4 * threads)),
                progress=False,
                store=None if store is None else store / f"{name}.zarr",
            ),
        )
