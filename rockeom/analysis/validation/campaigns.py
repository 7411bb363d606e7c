"""Campaigns of tests: their table, their records, and the same tests simulated.

campaign = validation.Campaign.from_csv("tests.csv")
simulated = validation.simulate_campaign(campaign, case, {"r": stats.uniform(0.8, 0.15)}, 500)
"""

import os
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any, Self

import numpy as np

from rockeom.analysis.sweeps import FALLS, STANDS
from rockeom.analysis.validation.ensembles import Ensemble
from rockeom.files import in_text
from rockeom.motion.ground_motion import GroundMotion
from rockeom.motion.motion_set import MotionSet
from rockeom.motion.readers import TextTable, read_table
from rockeom.motion.units import STANDARD_GRAVITY
from rockeom.numbers import explained
from rockeom.numbers.checks import FilePath, InputError, near, numbers, whole_number
from rockeom.simulation.case import Case
from rockeom.sweeps.run import simulate_many

_STOOD = ("stood", "stands", *STANDS)
_COLUMNS = ("test", "record", "peak", "outcome")


@explained.calls()
@dataclass(frozen=True, eq=False)
class Campaign:
    """Tests of a structure on a shaking table: the motion, the peak and the outcome of each.

    Parameters
    ----------
    tests : tuple of str
        Names of the n tests, each another.
    records : tuple of str
        Name of the motion of each test (n,).
    motions : MotionSet
        Motions; several tests may have one.
    measured : Ensemble
        Peaks and outcomes of the tests (n,).
    parameters : dict of str to ndarray, optional
        Numbers that differ from test to test, (n,) each, in SI units, by the names that
        `simulate_many` has for them, such as "scale" of the motion, "half_width", "initial theta".
    name : str, optional
        Name of the campaign.

    Raises
    ------
    ValueError
        For lengths that differ, two tests of one name, and records that no motion has.

    Examples
    --------
    >>> import numpy as np
    >>> import rockeom as rk
    >>> from rockeom import analysis
    >>> motions = rk.MotionSet(
    ...     rk.GroundMotion.kanai_tajimi(0.006, duration=8.0, seed=seed) for seed in (1, 2)
    ... )
    >>> measured = analysis.validation.Ensemble([0.013, np.nan], [False, True])  # rad
    >>> analysis.validation.Campaign(["T1", "T2"], motions.names, motions, measured, name="blocks")
    Campaign('blocks': 2 tests of 2 motions, 1 overturned)
    """

    tests: tuple[str, ...]
    records: tuple[str, ...]
    motions: MotionSet
    measured: Ensemble
    parameters: Mapping[str, np.ndarray] = field(default_factory=dict)
    name: str = ""

    def __post_init__(self) -> None:
        tests, records = tuple(self.tests), tuple(self.records)
        parameters = {
            name: numbers("Campaign", **{name: values})[0]
            for name, values in self.parameters.items()
        }
        shapes = {"records": (len(records),), "measured": self.measured.peaks.shape}
        shapes |= {name: values.shape for name, values in parameters.items()}
        for name, shape in shapes.items():
            if shape != (len(tests),):
                raise InputError(name, of="Campaign").wrong(
                    f"has the shape {shape}, and there are {len(tests)} tests: give one value for "
                    "each test"
                )
        for test in tests:
            if tests.count(test) > 1:
                raise InputError("tests", test, "Campaign").so("several tests have this name")
        for record in records:
            if record not in self.motions:
                known = near(record, self.motions.names)
                raise InputError("motions", record, "Campaign").says(
                    f"no motion is called {record!r}{known}"
                )
        object.__setattr__(self, "tests", tests)
        object.__setattr__(self, "records", records)
        object.__setattr__(self, "parameters", parameters)

    @classmethod
    def from_csv(
        cls,
        path: FilePath,
        records: MotionSet | FilePath | None = None,
        *,
        units: Mapping[str, str] | None = None,
        parameters: Sequence[str] | None = None,
        record_units: str | None = None,
        gravity: float = STANDARD_GRAVITY,
    ) -> Self:
        """Campaign of a table, a test a line, with a first line of headings.

        Parameters
        ----------
        path : path_like
            File of the table.
        records : MotionSet or path_like, optional
            Motions, whose names the column record has; or the folder of the files that it names,
            that of the table if not given. They are read by `GroundMotion.read`, and lie in that
            folder or below it: a table reads no other files, also not by links or "..".
        units : dict of str to str, optional
            Unit by the name of a column, as ``{"peak": "deg"}``; not needed where the heading has
            it in brackets.
        parameters : sequence of str, optional
            Columns that are parameters, to leave out remarks and others.
        record_units : str, optional
            Unit of the accelerations in the files, as for `GroundMotion.read`.
        gravity : float, optional
            Acceleration of gravity for accelerations in g [m/s2].

        Returns
        -------
        Campaign
            Tests with their motions.

        Raises
        ------
        InputError
            A ValueError that names the file, the line, the column, the value and the remedy.

        Notes
        -----
        The columns test, record, peak and outcome are needed, in any order. outcome is "stood" or
        "overturned", or one of the outcomes of a response. peak is its size; it may be empty where
        the test overturned, and is not used there. All others are parameters, see the class.

        Examples
        --------
        A table::

            test, record, peak (deg), outcome, scale (-)
            T1, elcentro.at2, 3.2, stood, 1.0
            T2, elcentro.at2, , overturned, 1.5
        """
        table = read_table(path)
        names = _parameters(table, parameters)
        stated = dict(units or {})
        for name in stated:
            if name not in table.names or name in ("test", "record", "outcome"):
                what = f"units has {name!r}{near(name, table.names)}, which is no column of numbers"
                raise table.error(None, what, "name the column of the peak, or of a parameter")
        factors = {name: table.factor(name, stated.get(name), gravity) for name in ("peak", *names)}
        rows = range(len(table.rows))
        fell = np.array([_overturned(table, row) for row in rows])
        peaks = np.array([_peak(table, row, bool(fell[row])) for row in rows])
        return cls(
            _tests(table),
            tuple(table.text(row, "record") for row in rows),
            _motions(table, path, records, record_units, gravity),
            Ensemble(peaks * factors["peak"], fell),
            {n: np.array([table.number(row, n) for row in rows]) * factors[n] for n in names},
            in_text(path).stem,
        )

    def __len__(self) -> int:
        return len(self.tests)

    def __repr__(self) -> str:
        return (
            f"Campaign({self.name!r}: {len(self)} tests of {len(self.motions)} motions, "
            f"{int(self.measured.overturned.sum())} overturned)"
        )


@explained.calls()
def simulate_campaign(
    campaign: Campaign,
    case: Case | Callable[..., Case],
    random: Mapping[str, Any] | None = None,
    number: int = 200,
    *,
    shared: Sequence[str] = (),
    quantity: str = "theta",
    seed: int = 0,
    **how: Any,
) -> Ensemble:
    """Peaks and outcomes of each test of a campaign with uncertain parameters.

    Parameters
    ----------
    campaign : Campaign
        Tests, whose motions and parameters the cases have.
    case : Case or callable
        A `Case`, in place of whose motion and numbers come those of each test; or a function that
        makes one of "motion", the parameters of the campaign and the random ones, by name, as in
        `simulate_many`.
    random : dict of str to distribution, optional
        Distribution of each uncertain parameter, by name: one of scipy.stats, frozen; they are
        independent.
    number : int, optional
        Number of campaigns to simulate, the columns of the result.
    shared : sequence of str, optional
        Names of random parameters that are unknown, and the same in all tests of a campaign, such
        as the width of the specimen; the others differ from test to test as well.
    quantity : str, optional
        State or quantity whose largest size was measured.
    seed : int, optional
        Seed of the draws; the same seed draws the same.
    **how : object
        Other arguments of `simulate_many`: ``options``, ``sweep_options``.

    Returns
    -------
    Ensemble
        Ensemble (n, number) of n tests.

    Raises
    ------
    ValueError
        For names that the case does not have or that are given twice, for a distribution that is
        none, and for a motion that gives no answer, as `Ensemble.from_sweep`.

    Notes
    -----
    An interrupt is raised, as some of the motions are no sample.

    Examples
    --------
    >>> import numpy as np
    >>> from scipy import stats
    >>> import rockeom as rk
    >>> from rockeom import analysis
    >>> motions = rk.MotionSet(
    ...     rk.GroundMotion.kanai_tajimi(0.006, duration=8.0, seed=seed) for seed in (1, 2)
    ... )
    >>> measured = analysis.validation.Ensemble([0.013, np.nan], [False, True])  # rad
    >>> campaign = analysis.validation.Campaign(["T1", "T2"], motions.names, motions, measured)
    >>> block = rk.RigidBlock(half_width=0.1, half_height=0.4)  # m
    >>> case = rk.Case(block, motions[0], rk.EnergyRatio(0.85))
    >>> random = {"half_width": stats.norm(0.1, 0.002), "r": stats.uniform(0.8, 0.1)}
    >>> simulated = analysis.validation.simulate_campaign(
    ...     campaign, case, random, 50, shared=["half_width"]
    ... )
    >>> simulated.peaks.shape
    (2, 50)
    """
    count = whole_number("number", number, 1, "simulate_campaign")
    columns = {
        "motion": np.array([campaign.motions[name] for name in campaign.records], dtype=object),
        **campaign.parameters,
    }
    columns = {name: np.repeat(values, count) for name, values in columns.items()}
    drawn = _drawn(random or {}, shared, (len(campaign), count), seed)
    for name in drawn:
        if name in columns:
            raise InputError("random", name, "simulate_campaign").wrong(
                f"has {name!r}, and so has the campaign: take it out of one"
            )
    columns |= drawn
    table = np.empty(len(campaign) * count, dtype=[(n, x.dtype) for n, x in columns.items()])
    for name, values in columns.items():
        table[name] = values
    kept = () if quantity in _one(case, table[0]).structure.states else (quantity,)
    peaks = Ensemble.from_sweep(simulate_many(case, table, quantities=kept, **how), quantity)
    shape = (len(campaign), count)
    return Ensemble(peaks.peaks.reshape(shape), peaks.overturned.reshape(shape))


def _one(case: Case | Callable[..., Case], row: Any) -> Case:
    """One case of the sweep, whose states it keeps without being asked."""
    if isinstance(case, Case):
        return case
    return case(**{name: row[name] for name in row.dtype.names})


def _drawn(
    random: Mapping[str, Any], shared: Sequence[str], shape: tuple[int, int], seed: int
) -> dict[str, np.ndarray]:
    """Values of each random parameter, test by test, those of one test in a row."""
    for name in shared:
        if name not in random:
            raise InputError("shared", of="simulate_campaign").wrong(
                f"has {name!r}{near(name, random)}, and random has not"
            )
    rng = np.random.default_rng(seed)
    drawn = {}
    for name, distribution in random.items():
        if not hasattr(distribution, "rvs"):
            raise InputError("random", of="simulate_campaign").wrong(
                f"has {name} = {distribution!r}: give a distribution with its parameters, such as "
                "scipy.stats.norm(0.1, 0.01)"
            )
        size = (1, shape[1]) if name in shared else shape
        values = np.asarray(distribution.rvs(size=size, random_state=rng), dtype=float)
        drawn[name] = np.broadcast_to(values, shape).ravel()
    return drawn


# -- the cells of a table ------------------------------------------------------------------------


def _parameters(table: TextTable, wanted: Sequence[str] | None) -> list[str]:
    """Names of the columns of parameters, where all that are needed are there."""
    there = ", ".join(table.names)
    for name in (*_COLUMNS, *(wanted or ())):
        if name not in table.names:
            what = f"no column is called {name!r}{near(name, table.names)}; there are {there}"
            raise table.error(None, what, f"name the columns {', '.join(_COLUMNS)}")
    others = [name for name in table.names if name not in _COLUMNS]
    return others if wanted is None else list(wanted)


def _tests(table: TextTable) -> tuple[str, ...]:
    names: dict[str, int] = {}
    for row, (line, _) in enumerate(table.rows):
        name = table.text(row, "test")
        if not name or name in names:
            what = f"test is {name!r}" + (f", as in line {names[name]}" if name else "")
            raise table.error(row, what, "give each test a name of its own")
        names[name] = line
    return tuple(names)


def _overturned(table: TextTable, row: int) -> bool:
    word = table.text(row, "outcome")
    if word.lower() == FALLS:
        return True
    if word.lower() in _STOOD:
        return False
    what = f"outcome is {word!r}{near(word, (FALLS, *_STOOD))}"
    raise table.error(row, what, f"write {FALLS} or {_STOOD[0]}")


def _peak(table: TextTable, row: int, overturned: bool) -> float:
    if overturned and not table.text(row, "peak"):
        return np.nan
    if not table.text(row, "peak"):
        what = f"the peak of test {table.text(row, 'test')!r}, which {_STOOD[0]}, is missing"
        raise table.error(row, what, "find it in its record; a test is not left out silently")
    peak = table.number(row, "peak")
    if peak < 0:
        raise table.error(row, f"peak is {peak:g}", "give the size of the largest rotation")
    return peak


def _motions(
    table: TextTable,
    path: FilePath,
    records: MotionSet | FilePath | None,
    units: str | None,
    gravity: float,
) -> MotionSet:
    """The motions of all tests, each once, in the order of the tests."""
    first: dict[str, int] = {}
    for row in range(len(table.rows)):
        first.setdefault(table.text(row, "record"), row)
    folder = Path(path).parent if records is None else records
    motions: list[GroundMotion] = []
    for name, row in first.items():
        if isinstance(folder, MotionSet):
            if name not in folder:
                what = f"record is {name!r}{near(name, folder.names)}, and no motion is called so"
                raise table.error(row, what, "use a name of the motions that are given")
            motions.append(folder[name])
            continue
        file = Path(folder, name)
        if not file.resolve().is_relative_to(Path(folder).resolve()):
            what = f"record is {name!r}, which is no file within {os.fspath(folder)!r}"
            raise table.error(row, what, "copy the file to there, or name its folder by records=")
        try:
            motion = GroundMotion.read(file, units=units, gravity=gravity, name=name)
        except (InputError, OSError) as error:
            remedy = "give the file, relative to records= or to the table; the message tells more"
            raise table.error(row, f"record is {name!r}: {error}", remedy) from None
        motions.append(replace(motion, name=name))
    return MotionSet(motions, in_text(path).stem)
