"""Many motions at once, on all cores or many machines, keeping only what is asked for."""

import inspect
import os
import sys
from collections.abc import Callable, Sequence
from contextlib import nullcontext
from dataclasses import replace
from functools import partial
from typing import Any

import numpy as np

from rockeom.codes import IMPACT
from rockeom.integrator.program import program, revision
from rockeom.integrator.schema import GeneratedModule, in_space
from rockeom.numbers import explained
from rockeom.numbers.checks import InputError, InputTypeError
from rockeom.simulation.case import Case
from rockeom.simulation.method_selection import DEFAULT, Choice, chosen
from rockeom.simulation.options import SolverOptions
from rockeom.sweeps.cases import Cases, first_of, sweep_of
from rockeom.sweeps.dataset import Labels, Sweep, check_names, dataset
from rockeom.sweeps.options import SweepOptions
from rockeom.sweeps.results import NOT_RUN, Results
from rockeom.sweeps.store import Store, definition, opened
from rockeom.sweeps.task import Task
from rockeom.sweeps.unfinished import Unfinished, part_for_users
from rockeom.sweeps.workers import Progress, in_executor, in_threads

MOST_KEPT, CHUNKS = 4096, 64
"""Cases in a chunk of a store or of an executor, at most; and chunks of a smaller sweep."""


@part_for_users
@explained.calls(
    vary="over=",
    parameters="over=",
    rtol="options=rk.SolverOptions(rtol=...)",
    threads="sweep_options=rk.SweepOptions(threads=...)",
    store="sweep_options=rk.SweepOptions(store=...)",
)
def simulate_many(
    case: Case | Callable[..., Case],
    over: Any,
    *,
    impact_times: int = 0,
    impact_states: bool = False,
    quantities: Sequence[str] = (),
    times: Sequence[float] | np.ndarray = (),
    options: SolverOptions | None = None,
    sweep_options: SweepOptions | None = None,
) -> Sweep:
    """Simulate every combination of the values in `over`, labelled by them, or each row of a table.

    Parameters
    ----------
    case : Case or callable
        A case, some of whose numbers `over` names; or a function that makes one case from one value
        of each name, where cases depend on them in another way.
    over : dict or list of dict or pandas.DataFrame
        A mapping of names to lists of values is a grid: the dataset is over its names. A table has
        a case in each row and is a DataFrame, a structured array, a list of dicts or a dataset over
        one dimension: the dataset is over "case", with the columns as coordinates.
    impact_times : int, optional
        Number of impact times of each case to keep.
    impact_states : bool, optional
        Whether to keep the states before and after each of these impacts, too; each case is then
        simulated by itself with its whole response, as for `quantities`.
    quantities : sequence of str, optional
        Further quantities of each case, by the names of a response ("theta", "displacement",
        "left_uplift", ...): peak_quantity, maximum_quantity and minimum_quantity, within the steps
        too, and their history at `times`. Each case is then also made and simulated by itself, with
        its whole response, which takes much longer.
    times : sequence of float or ndarray, optional
        Times of the history [s]; NaN behind the end of a motion.
    options : SolverOptions, optional
        Choices of the integration. Where they name no method, the first case chooses that of all,
        and ``attrs`` has it under "method", and why under "chosen"; the impact law of the first
        case is under "impact_law".
    sweep_options : SweepOptions, optional
        Threads, progress, store and others.

    Returns
    -------
    Sweep
        Dataset over the names in `over`: outcome (a label; "not run" after an interrupt) and
        outcome_flag (its number, with flag_values and flag_meanings of the CF conventions, 0 for
        not run), final_time [s], final_mode, impacts, impact_gains and impact_energy_gained [J]
        (how many of them gained kinetic energy, and how much in all), refined (segments of the
        ground in which equal steps would have been too long), peak, maximum, minimum and final
        value of each state, impact_time and impact_state (NaN where there was none). maximum and
        minimum have a sign, peak is the larger of their sizes; they are those within the steps.
        Every variable has a long_name and, where it has one unit, units; state_unit and
        quantity_unit give those of each state and quantity.

    Raises
    ------
    ValueError
        For names that the case does not have, with all there are and their units; with the values
        of the case for what cannot be simulated, with `lanes` or at all; and for a store that holds
        another sweep.
    RuntimeError
        For a store that is in use.
    ModuleNotFoundError
        For a store without zarr.

    See Also
    --------
    simulate : One motion.
    open_sweep : Dataset of a sweep in a store.

    Notes
    -----
    The names of the numbers of a case are those of `sensitivity`: arguments of the structure, such
    as "half_width", "masses[0]" and "support.stiffness"; of a pulse, such as "amplitude" and
    "period" or "frequency", its reciprocal; "scale" and "time_scale", factors of the acceleration
    and time of any motion and of the vertical one with it, and "pga", for which both are scaled; of
    the impact law, such as "r", or "restitution", the ratio e of the angular velocities; "initial
    theta" of a state; "duration"; "azimuth" of a structure in space. A name that two parts of the
    case have is written with the part, as "motion.amplitude" and "vertical.amplitude". "motion",
    "structure", "vertical", "impact" and "initial" are those parts as a whole.

    The result of a function must follow from its arguments alone. It is called for many cases at
    once, with arguments that calculate like numbers and hold the values of all; the threads call it
    in turn, never two at a time. Where cases do not go the same way (``if amplitude > 3``), or one
    number is asked for (``math.sin(x)``, a record scaled by x), it is called again for those that
    do, and in the end for each; ``np.sin(x)`` is of all at once. The first, the middle and the last
    case of each call are compared with calls for one case, to the last bit: where they differ, it
    is called for each. That takes tens of microseconds a case, at once a microsecond or two. All
    cases are of one model.

    Numbers and words are their own labels. Motions, structures and whatever else has a name go by
    it, numbered where several have the same; other objects are numbered. Values in a DataArray keep
    their attributes, such as units.

    Memory is bounded by the dataset. A keyboard interrupt ends the work early: the part that is
    done is returned, ``attrs["interrupted"]`` is 1. Functions of the package that make something
    else of a sweep raise it. The error of an executor that does not run some cases has a note that
    says whose it is and which cases are missing.

    Examples
    --------
    >>> import rockeom as rk
    >>> block = rk.RigidBlock(half_width=0.1, half_height=0.4)  # m
    >>> def shaken(amplitude, period):
    ...     return rk.Case(block, rk.GroundMotion.single_sine(amplitude, period, duration=6.0))
    >>> sweep = rk.simulate_many(shaken, over={"amplitude": [3.0, 4.0], "period": [0.4, 0.8]})
    >>> sweep.outcome.values.tolist()
    [['came to rest', 'overturned'], ['completed', 'overturned']]

    The numbers of a case, kept on disk::

        case = rk.Case(block, rk.GroundMotion.single_sine(amplitude=3.0, period=0.8, duration=8.0))
        rk.simulate_many(
            case,
            over={"frequency": np.linspace(0.5, 4, 100), "amplitude": np.linspace(1, 8, 100)},
            sweep_options=rk.SweepOptions(store="map.zarr"),
        )
    """
    cases = Cases.of(over)
    how = SweepOptions.of(sweep_options)
    if isinstance(case, Case):
        case, cases = sweep_of(case, cases)
    else:
        _check_function(case, cases)
    first = first_of(case, cases)
    module = first.structure.module
    options = SolverOptions.of(options)
    method, because = _method(first, options)
    options, lanes = replace(options, method=method), _in_lanes(how.lanes, module, method)
    apart = how.store is not None or how.executor is not None
    its_revision = revision(module, method, lanes) if apart else ""
    task = Task(
        case, options, lanes, impact_times, impact_states, quantities, np.asarray(times),
        its_revision,
    )  # fmt: skip
    attrs = {"model": module.NAME, "method": method, "chosen": because}
    if law := first.structure.describe_impact(first.impact):
        attrs["impact_law"] = f"{law}, of the first case"
    labels = Labels.of(task, cases, module, attrs)
    check_names(task, cases, labels)
    results = Results.of(task, cases.total, module.N_STATES)
    size = how.chunk or max(1, min(MOST_KEPT, -(-cases.total // CHUNKS)))
    store = (
        nullcontext()
        if how.store is None
        else opened(how.store, definition(task, cases, module), labels, results, size)
    )
    with store as on_disk:
        rows = np.flatnonzero(results.outcome == NOT_RUN)
        shown = sys.stderr.isatty() if how.progress is None else how.progress
        with Progress(len(rows), shown) as line:
            done = partial(_done, line, on_disk)
            try:
                if how.executor is None:
                    threads = how.threads or os.cpu_count() or 1
                    source = task.source(cases, module, chunk=how.chunk, threads=threads, rows=rows)
                    run = partial(results.run, compiled=program(module, method, lanes), task=task)
                    in_threads(threads, source, run, done)
                else:
                    chunks = _chunks(rows, size if on_disk is None else on_disk.size)
                    in_executor(how.executor, task, cases, chunks, results, done)
            except KeyboardInterrupt:
                raise Unfinished(dataset(results, labels, interrupted=True)) from None
    return dataset(results, labels, interrupted=False)


def _done(shown: Progress, on_disk: Store | None, rows: np.ndarray) -> None:
    shown.add(len(rows))
    if on_disk is not None:
        on_disk.keep(rows)


def _check_function(case: Any, cases: Cases) -> None:
    """Raises TypeError for what is no function of the names of a sweep."""
    names = cases.values
    if not callable(case):
        raise InputTypeError("case", case).give(
            "a case, rk.Case(structure, motion), or a function that makes one, such as lambda "
            f"{', '.join(names)}: rk.Case(structure, motion)"
        )
    try:
        inspect.signature(case).bind(**names)
    except TypeError:
        raise InputTypeError("over").wrong(
            f"has {', '.join(names)}, and the function of the sweep takes others: "
            f"{explained.misfit(case, (), names).partition(': ')[2]}"
        ) from None
    except ValueError:  # a function in C may not tell what it takes
        pass


def _chunks(rows: np.ndarray, size: int) -> list[np.ndarray]:
    """Rows, apart where a chunk of a store ends."""
    return np.split(rows, np.flatnonzero(np.diff(rows // size)) + 1) if len(rows) else []


MOST_MODES_IN_LANES = 4
"""Modes of a structure in lanes at most: every step evaluates them all."""


def lanes_pay(module: GeneratedModule) -> bool:
    """Whether sweeps step in lanes where it is left open, by the structure alone.

    They do where an impact ends a mode, and nothing else, or no impact does, and where the
    rotation alone may fall. Others have been measured, the time of lanes in that of one motion
    after the other: 0.7 to 1.0 for the cart on two springs; for walls 0.6 to 1.5, and 4 to 15 s
    more of compiling; 2 to 2.5 for the block of Dirac pulses. Most of their steps end at events,
    and lanes evaluate every mode in each. Lanes cannot follow points, whose next mode is searched
    for.
    """
    return (
        not getattr(module, "POINTS", ())
        and not module.LOCALISED
        and not module.N_FALLS
        and len(module.MODES) <= MOST_MODES_IN_LANES
        and all(
            kinds[:guards] == (IMPACT,) or IMPACT not in kinds[:guards]
            for guards, kinds in zip(module.GUARDS, module.KINDS, strict=True)
        )
    )


def _method(case: Case, options: SolverOptions) -> Choice:
    """The method of all cases, chosen by the first where none is named."""
    if options.method is not None:
        return Choice(options.method, "named")
    try:
        method, because = chosen(case.structure, case.problem(), options)
    except Exception:  # running the case raises it again, with its values
        method, because = DEFAULT
    return Choice(method, f"{because}, by the first case")


def _in_lanes(lanes: bool | None, module: GeneratedModule, method: str) -> bool:
    """Whether a sweep steps in lanes, as asked or by its structure and method."""
    pay, explicit = lanes_pay(module), method != "Radau"
    if lanes is None:
        return pay and explicit and not in_space(module)
    if lanes and in_space(module):
        raise InputError("lanes", True).says(
            f"lanes are of the plane, and {module.NAME} moves in space: leave lanes=True out"
        )
    if lanes and not pay:
        raise InputError("lanes", True).says(
            f"lanes gain too little for {module.NAME}, whose modes change too often: leave "
            "lanes=True out"
        )
    if lanes and not explicit:
        raise InputError("lanes", True).so(
            "they know no implicit method: choose 'DOP853' or 'RK45'"
        )
    return bool(lanes)
