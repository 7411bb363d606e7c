"""`Response`: the motion of a structure under a ground motion, and all that follows from it."""

from __future__ import annotations

import math
import os
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from rockeom.motion import GroundMotion
from rockeom.motion.slope import SLOPE
from rockeom.numbers import explained
from rockeom.numbers.checks import InputError, array_of, require
from rockeom.numbers.degrees import with_degrees
from rockeom.numbers.mode_codes import rows_of
from rockeom.numbers.pictures import picture
from rockeom.simulation import plausible
from rockeom.simulation.events import Events, Impacts
from rockeom.simulation.extremes import Extremes
from rockeom.simulation.ground import Ground, ground_of
from rockeom.simulation.options import SolverOptions
from rockeom.simulation.outcome import Outcome
from rockeom.simulation.quantities import Places, Quantities
from rockeom.simulation.recorder import Samples
from rockeom.simulation.reserve import describe_tilt, reserve_of
from rockeom.simulation.steps import Rows, Steps
from rockeom.simulation.support import Support
from rockeom.simulation.ties import YIELDS, Samples as OfTie, TieRecord, states_of, tie_record
from rockeom.simulation.works import EnergyBalance
from rockeom.structures.base import Structure
from rockeom.structures.impact_laws import ImpactLaw
from rockeom.structures.pickled import made_of
from rockeom.structures.positions import DIRECTION, RESERVE, TILT
from rockeom.structures.searched_modes import assumption
from rockeom.structures.slope import uplift_accelerations
from rockeom.structures.units import is_dimensionless

if TYPE_CHECKING:
    import pandas as pd
    import xarray as xr

_SYNONYMS = {
    "states": "names",
    "max": "extremes(name)",
    "min": "extremes(name)",
    "peak": "extremes(name).peak",
    "plots": "plot",
    "to_csv": "to_dataframe().to_csv(path)",
    "to_excel": "to_dataframe().to_excel(path)",
    "to_pandas": "to_dataframe()",
    "to_numpy": "y",
    "rotation": "theta",
    "acceleration": "ground_acceleration",
    "energy": "energy_balance()",
    "forces": "support",
    "reactions": "support",
    "contact": "mode",
}
"""Names that people try first, and what to write for each."""

_PARTS = {"support": Support, "impacts": Impacts, "events": Events, "places": Places}


def _offers() -> dict[str, str]:
    """Names that a response lacks, those of its parts too, and what to write for each."""
    of_parts = {
        name: f"{part}.{name}"
        for part, kind in _PARTS.items()
        for name in explained.public_names(kind)
    }
    return of_parts | _SYNONYMS


def _listed(names: Sequence[str]) -> Sequence[str]:
    """Names of quantities; raises ValueError for one word, which is a sequence of letters."""
    if isinstance(names, str):
        raise InputError("names").wrong(f"is the word {names!r}: give a list of names, [{names!r}]")
    return names


@explained.record()
@dataclass(frozen=True, eq=False)
class Response:
    """Motion of a structure under a ground motion, as sampled and at any time.

    `simulate` makes it. ``run["theta"]`` gives the samples of any of `names`, in the unit that
    `units` has for it: states [rad, m, rad/s, m/s], energies [J], reactions [N], displacement and
    uplifts [m], accelerations of the ground [m/s2], and those of places, elements and works. They
    are attributes, too: ``run.theta``; ``run.time`` is `t`. The samples are at the times `t` (n,)
    [s], with the states `y` (n, d) in the order of `states` and the names `mode` (n,) of modes.
    Where a velocity jumps `t` holds the instant twice, before and after.

    `save` keeps it in a file, from which `rk.load` makes it again; it can be pickled and copied.

    Parameters
    ----------
    structure : Structure
        Structure of the simulation.
    motion : GroundMotion
        Horizontal ground motion.
    vertical : GroundMotion
        Vertical ground motion.
    impact : ImpactLaw
        Impact law of the simulation; None for the default.
    options : SolverOptions
        Choices of the integration.
    outcome : Outcome
        How the motion ended.
    duration : float
        Duration asked for [s].
    statistics : dict of str to object
        Figures of the integration, such as "method", "steps" and "impact_law".
    record : Steps or Samples
        Every step, or samples, see `simulate`.
    events : Events
        Transitions between modes, of which `impacts` are the most asked for.
    end : ndarray
        Last state (N,).
    slope : float, optional
        Slope of the ground [rad].
    ground_axes : str, optional
        Axes of the ground motions, see `simulate`.
    transverse : GroundMotion, optional
        Second horizontal ground motion, of a structure in space.
    azimuth : float, optional
        Azimuth of the x axis of a structure in space from the first ground motion [rad].

    Examples
    --------
    >>> import rockeom as rk
    >>> block = rk.RigidBlock(half_width=0.1, half_height=0.4, mass=300.0)  # m, kg
    >>> pulse = rk.GroundMotion.single_sine(amplitude=3.5, period=0.4, duration=4.0)  # m/s2, s
    >>> run = rk.simulate(block, pulse)
    >>> run["theta"].shape == run.t.shape
    True
    >>> round(run.extremes("left_uplift").peak, 3)  # m
    0.022
    >>> figure = run.plot()
    """

    structure: Structure
    motion: GroundMotion
    vertical: GroundMotion | None
    impact: ImpactLaw | None
    options: SolverOptions
    outcome: Outcome
    duration: float
    statistics: dict[str, Any]
    record: Steps | Samples
    events: Events
    end: np.ndarray
    slope: float = 0.0
    ground_axes: str = SLOPE
    transverse: GroundMotion | None = None
    azimuth: float = 0.0

    __getstate__ = made_of

    # -- the motion

    @property
    def steps(self) -> Steps:
        """The dense record; raises ValueError where only samples were kept."""
        return self._quantities.steps("steps")

    @cached_property
    def _rows(self) -> Rows:
        if isinstance(self.record, Samples):
            return Rows(self.record.t, self.record.y, self.record.mode)
        return self.record.samples(self.options.spacing(self.duration))

    @property
    def t(self) -> np.ndarray:
        """(n,) times of the samples [s]; the instant of a jump stands twice."""
        return self._rows.t

    @property
    def y(self) -> np.ndarray:
        """(n, d) states, columns in the order of `states`."""
        return self._rows.y

    @property
    def mode(self) -> np.ndarray:
        """(n,) name of the mode at each sample."""
        return rows_of(self.structure.module.MODES, self._rows.mode)

    @property
    def impacts(self) -> Impacts:
        """Impacts, in time order; `events` holds uplifts and other events, too.

        Each landing of contacts that may open and slide is one.
        """
        return self.events.impacts

    @property
    def final(self) -> dict[str, float]:
        """The last state, by name."""
        return dict(zip(self.states, self.end.tolist(), strict=True))

    @property
    def final_mode(self) -> str:
        """Name of the mode at the end.

        With it and `final` a motion goes on; `impact` and `options` are those of its simulation::

            rk.simulate(run.structure, aftershock, initial=run.final, mode=run.final_mode)
        """
        kinds = self.events.columns.kinds
        return self.structure.module.MODES[kinds[-1, 2] if len(kinds) else self._rows.mode[0]]

    @cached_property
    def overturned(self) -> str:
        """Name of the coordinate that has fallen, such as the rotation; empty if none has.

        That of the tilt, of a body in space that has overturned by it.
        The one nearest to its overturning angle, where the motion was followed to the end of its
        duration and falls afterwards.
        """
        if self.outcome is not Outcome.OVERTURNED:
            return ""
        last = self.events[-1:]
        if last and last[0].kind == "bound":
            return last[0].contact
        if DIRECTION in self.units:
            return TILT
        final = self.final
        parts = {name: abs(final[name]) / size for name, size in self.structure.falls.items()}
        return max(parts, key=lambda name: parts[name])

    # -- quantities

    @cached_property
    def _quantities(self) -> Quantities:
        method = self.statistics["method"]
        columns = self.events.columns
        return Quantities(self.structure, self._ground, method, self.record, columns)

    @cached_property
    def _ground(self) -> Ground:
        return ground_of(self)

    @property
    def states(self) -> tuple[str, ...]:
        """Names of the states."""
        return self.structure.states

    @property
    def names(self) -> tuple[str, ...]:
        """Names of all quantities that `run[...]` gives."""
        return tuple(self.units)

    @property
    def units(self) -> dict[str, str]:
        """Unit of each of `names`, such as "m/s2"; "-" throughout without dimensions."""
        return self._quantities.units

    def __getitem__(self, name: str) -> np.ndarray:
        if name in self.states:
            return self.y[:, self.states.index(name)]
        family = self._quantities.family(name)
        if family not in self._outputs:
            self._outputs[family] = self._quantities.of_family(family, self._rows)
        return self._outputs[family][name]

    if not TYPE_CHECKING:  # for type checkers an unknown attribute stays an error

        def __getattr__(self, name: str) -> Any:
            """A quantity by its name, where the class has no attribute of that name."""
            if "structure" in vars(self) and not hasattr(type(self), name):  # and not half made
                if name in self.units:
                    return self[name]
                if name == "time":
                    return self.t
            return explained.missing(self, name, _offers)

    def __dir__(self) -> list[str]:
        """The attributes, and the quantities that are no attributes of the class."""
        return [*object.__dir__(self), "time", *self.names]

    def __iter__(self) -> Iterator[str]:
        """Over `names`, so that `"theta" in run` and `list(run)` are as of a mapping."""
        return iter(self.names)

    @cached_property
    def _outputs(self) -> dict[str, dict[str, np.ndarray]]:
        """Quantities at the samples, of families that have been asked for."""
        return {}

    def at(
        self, times, side: str = "right", names: Sequence[str] | None = None
    ) -> dict[str, np.ndarray]:
        """States, or other quantities, at any times, from the dense output.

        Parameters
        ----------
        times : array_like
            Times [s], any shape.
        side : str, optional
            "left" or "right", the side of a jump of a velocity.
        names : sequence of str, optional
            Names of states or of any other quantities of the response; all states if not given.

        Returns
        -------
        dict of str to ndarray
            Values by name, each in the shape of `times`.

        Raises
        ------
        ValueError
            For times outside the response and where only samples were kept.
        KeyError
            For an unknown name.

        Examples
        --------
        >>> import rockeom as rk
        >>> block = rk.RigidBlock(half_width=0.1, half_height=0.4)  # m
        >>> run = rk.simulate(block, rk.GroundMotion.none(2.0), initial={"theta": 0.1})  # s, rad
        >>> run.at([0.0, 0.1])["theta"].round(4)  # rad
        array([0.1   , 0.0869])
        """
        self._quantities.steps("at")
        require(side in ("left", "right"), "", "side", side, "choose 'left' or 'right'")
        times = array_of("times", times)
        flat = times.ravel()
        if flat.size and (flat.min() < self.t[0] or flat.max() > self.t[-1]):
            raise InputError("times").says(
                f"times reach from {flat.min()} to {flat.max()} s, the response from {self.t[0]} "
                f"to {self.t[-1]} s"
            )
        names = self.states if names is None else _listed(names)
        values = self._quantities.at(flat, side, names)
        return {name: values[name].reshape(times.shape) for name in names}

    def extremes(self, name: str) -> Extremes:
        """Least and greatest value of a quantity, within the steps too, and their times.

        They do not depend on `output_step`.

        Parameters
        ----------
        name : str
            Any of `names`.

        Returns
        -------
        Extremes
            Extremes in the unit of the quantity.

        Raises
        ------
        KeyError
            For an unknown name.
        """
        return self.extremes_of([name])[name]

    def extremes_of(self, names: Sequence[str]) -> dict[str, Extremes]:
        """`extremes` of several quantities, faster than one after the other.

        Parameters
        ----------
        names : sequence of str
            Names of the quantities.

        Returns
        -------
        dict of str to Extremes
            Extremes by name.

        Raises
        ------
        KeyError
            For an unknown name.
        """
        return self._quantities.extremes_of(_listed(names))

    @cached_property
    def places(self) -> Places:
        """Positions, rotations, velocities and accelerations of bodies and feet at the samples."""
        return Places(self.structure, self._ground, self._rows)

    @cached_property
    def ties(self) -> dict[str, TieRecord]:
        """Largest force and elongation, dissipation and break of each `Tie`, by its name."""
        module = self.structure.module
        names = getattr(module, "TIES", ())
        wanted = [f"{name}_{what}" for name in names for what in ("force", "elongation")]
        largest = self.extremes_of(wanted) if names else {}
        return {
            name: tie_record(
                module, name, self.events.columns, OfTie(self.t, self[f"{name}_force"]), largest,
                float(self[f"{name}_loss"][-1]) if YIELDS in states_of(module, name) else 0.0,
            )
            for name in names
        }  # fmt: skip

    @cached_property
    def support(self) -> Support:
        """Forces of the ground, friction demands, sliding and loss of contact."""
        overturned = self.outcome is Outcome.OVERTURNED
        return Support(self._quantities, self.events, self._rows, overturned)

    def energy_balance(self) -> EnergyBalance:
        """Works and losses by quadrature of the motion, and the energy of its states.

        Returns
        -------
        EnergyBalance
            Energies [J]. Their `error` measures the accuracy of the integration.

        Examples
        --------
        >>> import rockeom as rk
        >>> block = rk.RigidBlock(half_width=0.1, half_height=0.4, mass=300.0)  # m, kg
        >>> pulse = rk.GroundMotion.single_sine(amplitude=3.5, period=0.4, duration=4.0)  # m/s2, s
        >>> bool(rk.simulate(block, pulse).energy_balance().error < 1e-9)
        True
        """
        return self._quantities.works.balance()

    # -- in words

    @property
    def hints(self) -> tuple[str, ...]:
        """Plausible mistakes in the structure, its start, its ground motion and its impacts."""
        structure, support = self.structure, self.support
        stood = support.never_lifted or (structure.has_landings and not len(self.events))
        law = self.statistics.get("impact_law", "their law")
        return (
            *structure.hints(),
            *plausible.shaking(structure, self.motion, stood),
            *(plausible.friction(structure, support) if isinstance(self.record, Steps) else ()),
            *plausible.gained(structure, self.impacts, law),
            *plausible.directions(self.motion, self.vertical),
            *(() if self.slope else plausible.tie(self.motion, self.events.columns)),
            *plausible.beyond_wall(structure, self._rows),
            *plausible.beyond_balance(structure, self._rows, self.slope),
            *plausible.sloping(structure, self.slope),
        )

    def summary(self) -> str:
        """Response in words.

        Returns
        -------
        str
            Text of several lines.
        """
        sloping = f" on a slope of {with_degrees(self.slope, 'rad')}" if self.slope else ""
        if self.azimuth:
            sloping = f" at an azimuth of {with_degrees(self.azimuth, 'rad')}"
        across = "" if self.transverse is None else f" with {self.transverse.name} across"
        lines = [
            f"{type(self.structure).__name__}{sloping} under "
            f"{self.motion.name or 'a ground motion'}{across}, "
            f"{self.t[-1]:.6g} s of {self.duration:.6g} s.",
            f"Outcome: {self.outcome}. {self.outcome.sentence}{self._why()}",
        ]
        leans = DIRECTION in self.units and isinstance(self.record, Steps)
        lines += self._tilted() if leans else self._turned()
        lines += self._impact_law()
        lines += self._uplift()
        lines += [record.describe(name) for name, record in self.ties.items()]
        if (rest := self.events.rest_time) is not None:
            lines.append(f"It last came to rest at {rest:.4g} s, after infinitely many impacts.")
        return "\n".join([*lines, self.support.describe(), *(f"Hint: {h}" for h in self.hints)])

    def _turned(self) -> list[str]:
        """The largest rotation, and how near it is to overturning."""
        m = self.structure.module
        rotation, unit = self.states[m.ROTATION], m.STATE_UNITS[m.ROTATION]
        largest = self.extremes(rotation)
        size = with_degrees(abs(largest.peak), unit)
        line = f"Largest |{rotation}|: {size} at {largest.peak_time:.4g} s"
        reserve = reserve_of(self.structure, largest, self.slope)
        return [
            f"{line}; {self.impacts.describe()}.",
            *([reserve.describe(unit)] if reserve else []),
        ]

    def _tilted(self) -> list[str]:
        """The same of a body in space."""
        tilt = self.extremes(TILT)
        reserve = self.extremes(RESERVE) if RESERVE in self.units else None
        times = [tilt.maximum_time, reserve.minimum_time if reserve else 0.0]
        towards = self._quantities.at(np.array(times), "right", [DIRECTION])[DIRECTION]
        line = f"{self.impacts.describe()}."
        if "yaw" in self.states:
            turned = round(self.final["yaw"] - self["yaw"][0], 9) + 0.0  # what is less is rounding
            line = f"Turn about the vertical: {with_degrees(turned, 'rad')}; {line}"
        return [describe_tilt(tilt, towards[0], reserve, towards[1]), line]

    def _why(self) -> str:
        """The coordinate that fell, where several may; or the assumption that failed."""
        m = self.structure.module
        if self.outcome in (Outcome.NO_SOLUTION, Outcome.SEVERAL_SOLUTIONS):
            return f" An assumption fails: {assumption(m, self.structure.vector)}."
        if self.outcome is Outcome.OUT_OF_BOUNDS:
            return f" The bound is {self.events[-1].contact!r}."
        if fall_is_judged(self):
            return " It is judged to fall: no mode fits any more, and a body turns on outward."
        name, falls = self.overturned, self.structure.falls
        if name and name not in falls:
            if self.events[-1:] and self.events[-1].kind == "bound":
                return f" Its {name} reached that at which it has overturned."
            return " At the end of the record it leans on outward, and falls afterwards."
        if not name or len(falls) == 1:
            return ""
        unit = m.STATE_UNITS[self.states.index(name)]
        return f" {name} is {self.final[name]:.4g} {unit}."

    def _impact_law(self) -> list[str]:
        """The impact law, and the loss at all impacts."""
        law = self.statistics.get("impact_law")
        if not law or not len(self.impacts):
            return []
        unit = "" if is_dimensionless(self.structure.module) else " J"
        lost = f"{self.impacts.energy_loss:.4g}{unit}"
        return [f"Impact law: {law}. The impacts lost {lost} of kinetic energy in all."]

    def _uplift(self) -> list[str]:
        """The acceleration of the ground that would lift it, where the motion never lifted."""
        if not self.support.never_lifted:
            return []
        uplifts = uplift_accelerations(self.structure, self.slope)
        if uplifts is None or math.isinf(min(uplifts)):
            return []
        threshold = min(uplifts)
        unit = "g" if is_dimensionless(self.structure.module) else "m/s2"
        return [
            f"It never lifted off. A ground acceleration that grows slowly lifts it at "
            f"{threshold:.4g} {unit}; here the largest was {self.motion.peak:.4g} {unit}."
        ]

    # -- files, tables and figures

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write all of the response to a file, from which `rk.load` makes the same one again.

        Parameters
        ----------
        path : path_like
            File of the format netCDF-4, which is written whole or not at all; one that is there is
            replaced. It takes the extra `files`, see the README.

        Raises
        ------
        TypeError
            For a structure of a class of your own.
        ModuleNotFoundError
            Without the extra.
        OSError
            Where the file cannot be written.

        Notes
        -----
        Files hold numbers and names, no code. The file has the parameters and a hash of a structure
        that you declared: `rk.load` takes the declaration again. It has the name alone of an impact
        law of your own, and a warning says so; only going on needs the law.

        Examples
        --------
        >>> import rockeom as rk
        >>> block = rk.RigidBlock(half_width=0.1, half_height=0.4)  # m
        >>> run = rk.simulate(block, rk.GroundMotion.none(2.0), initial={"theta": 0.1})  # s, rad
        >>> run.save("block.nc")  # doctest: +SKIP
        >>> run = rk.load("block.nc")  # doctest: +SKIP
        """
        from rockeom.simulation.saved import save  # xarray

        save(path, self.__getstate__())

    def to_xarray(self, names: Sequence[str] | None = None, times: Any = None) -> xr.Dataset:
        """Quantities over "time" and impacts over "impact", each with its unit and its long name.

        Parameters
        ----------
        names : sequence of str, optional
            Names of the quantities; the states if not given.
        times : array_like, optional
            Times (n,) [s], by the dense record; if not given those of the samples, which have the
            instant of a jump twice.

        Returns
        -------
        xarray.Dataset
            Dataset. `mode` is the name of the mode; impact_time [s], impact_contact, and states and
            mode before and after each impact, such as theta_dot_before.

        Raises
        ------
        KeyError
            For an unknown name.
        ValueError
            For times outside the response.

        Examples
        --------
        With a response `run`::

            run.to_xarray(["theta", "displacement"]).theta.plot()
        """
        from rockeom.simulation.tables import over_impacts, units_with_time  # xarray

        table = self._over_time(names, times)
        units = units_with_time(self.structure.module, self.units)
        return table.assign(over_impacts(self.impacts, units))

    def to_dataframe(self, names: Sequence[str] | None = None, times: Any = None) -> pd.DataFrame:
        """Quantities and the mode, a column each, over the time.

        Parameters
        ----------
        names : sequence of str, optional
            Names of the quantities; the states if not given.
        times : array_like, optional
            Times (n,) [s], by the dense record; those of the samples if not given.

        Returns
        -------
        pandas.DataFrame
            Table over the time [s].

        Raises
        ------
        KeyError
            For an unknown name.
        ValueError
            For times outside the response.

        Examples
        --------
        With a response `run`::

            run.to_dataframe(times=np.arange(0, 5, 0.01)).to_csv("block.csv")
        """
        return self._over_time(names, times).to_dataframe()

    def _over_time(self, names: Sequence[str] | None, times: Any) -> xr.Dataset:
        from rockeom.simulation.tables import over_time, units_with_time  # xarray

        names = tuple(self.states if names is None else _listed(names))
        if times is None:
            t, modes, values = self.t, self.mode, {name: self[name] for name in names}
        else:
            t = array_of("times", times)
            require(t.ndim == 1, "", "times", t, "give one dimension, (n,)")
            values = self.at(t, names=names)
            modes = rows_of(self.structure.module.MODES, self.steps.at(t, "right")[1])
        units = units_with_time(self.structure.module, self.units)
        return over_time(t, modes, values, units).assign_attrs(
            model=self.structure.model,
            motion=self.motion.name,
            outcome=str(self.outcome),
            duration=self.duration,
            **({"azimuth": self.azimuth} if self.azimuth else {}),
            **{n: self.statistics[n] for n in ("method", "impact_law") if n in self.statistics},
        )

    def plot(self, *names: str, **kwargs):
        """Draw rotation, displacement, uplift and impacts, or the quantities named.

        Parameters
        ----------
        *names : str
            Names of quantities, a row each; or all in the axes `ax`, where these are given.
        **kwargs : object
            Further arguments of `rockeom.plots.plot_response`.

        Returns
        -------
        matplotlib.figure.Figure
            Figure.

        Raises
        ------
        KeyError
            For an unknown name.

        Examples
        --------
        With a response `run`::

            run.plot()
            run.plot("theta", "left_uplift")
            run.plot("theta", ax=axes)
        """
        return picture("plot_response", self, *names, **kwargs)

    def animate(self, path=None, **kwargs):
        """Draw the motion to scale, frame by frame: a .gif, .html or .mp4 file, or in Jupyter.

        Parameters
        ----------
        path : path_like, optional
            File, if one is wanted.
        **kwargs : object
            Further arguments of `rockeom.plots.animate`.

        Returns
        -------
        Animation
            Animation, which Jupyter shows.
        """
        return picture("animate", self, path, **kwargs)

    def _ipython_key_completions_(self) -> list[str]:
        """Names that IPython offers after `run["`."""
        return list(self.names)

    def _repr_html_(self) -> str:
        return picture("page_of_response", self)

    def __repr__(self) -> str:
        return f"<Response: {self.outcome}, {self.duration:.6g} s, {self.impacts.describe()}>"


def fall_is_judged(run: Response) -> bool:
    """Whether no mode fitted the forces while a body turned outward, far beyond its balance.

    It counts as a fall where a body, relative to what bears it, is beyond twice the angle at which
    its weight turns it back.
    """
    if not (name := run.overturned) or run.t[-1] >= run.duration:
        return False
    if name not in run.structure.falls:  # a tilt
        return False
    return abs(run.final[name]) < (1.0 - 1e-6) * run.structure.falls[name]
