"""Outcomes and peaks of the cases of a dataset of `simulate_many`, in either form of it."""

from collections import Counter
from typing import Any

import numpy as np
import xarray as xr
from numpy.typing import ArrayLike

from rockeom.numbers.checks import InputError, near, require_type

RESTS = "came to rest"
STANDS = ("completed", RESTS)
"""Outcomes of motions that last to their end without overturning."""
FALLS = "overturned"
ANSWERS = (FALLS, *STANDS)
NOT_RUN = "not run"
"""Label, and no outcome, of a case that an interrupt left out."""


def check_sweep(function: str, sweep: Any) -> None:
    """Raise TypeError for anything but a dataset."""
    require_type("sweep", sweep, xr.Dataset, "the dataset of rk.simulate_many", function)


def coordinate(function: str, sweep: xr.Dataset, name: str) -> xr.DataArray:
    """A coordinate of a sweep; raises ValueError, naming all there are, where there is none."""
    if name not in sweep.coords:
        raise InputError("name", name, function).says(
            f"the sweep has no coordinate {name!r}{near(name, map(str, sweep.coords))}: it has "
            f"{', '.join(map(str, sweep.coords))}"
        )
    return sweep[name]


def outcome_labels(sweep: xr.Dataset) -> xr.DataArray:
    """How each case of a sweep ended, in words such as "overturned".

    Parameters
    ----------
    sweep : xarray.Dataset
        Dataset whose variable `outcome` holds labels, or numbers whose `flag_values` and
        `flag_meanings` name them (CF conventions, 3.5). "not run" is no outcome.

    Returns
    -------
    xarray.DataArray
        Labels in the shape of the sweep.

    Raises
    ------
    ValueError
        Where there is no such variable, and for numbers without a meaning.
    """
    check_sweep("outcome_labels", sweep)
    if "outcome" not in sweep:
        raise InputError("sweep", of="outcome_labels").says(
            "the dataset has no `outcome`: give one of simulate_many"
        )
    outcome = sweep["outcome"]
    if outcome.dtype.kind in "OTU":
        return outcome.astype(str)
    meanings = str(outcome.attrs.get("flag_meanings", ""))
    words = [word.replace("_", " ") for word in meanings.split()]
    values = np.atleast_1d(outcome.attrs.get("flag_values", []))
    word_of = dict(zip(values.tolist(), words, strict=False))
    strange = set(np.unique(outcome.values).tolist()) - set(word_of)
    if len(values) != len(words) or strange:
        raise InputError("sweep", of="outcome_labels").says(
            f"outcome is {min(strange, default='numbers')}, and its flag_values {values.tolist()} "
            f"with flag_meanings {meanings!r} do not name it"
        )
    order = np.argsort(values)
    labels = np.array(words)[order][np.searchsorted(values[order], outcome.values)]
    return outcome.copy(data=labels)


def check_finished(function: str, sweep: xr.Dataset) -> None:
    """Raises ValueError, with the remedy, for a sweep of which some cases were not run."""
    labels = outcome_labels(sweep).values
    missing = int((labels == NOT_RUN).sum())
    if missing:
        raise InputError("sweep", of=function).says(
            f"{missing} of {labels.size} cases were not run, and no answer follows from the others "
            "alone: run them all again, with the same store if there is one, or select the cases "
            "that were run"
        )


def unanswered(labels: ArrayLike) -> str:
    """How many of some cases gave no answer and how they ended; nothing where all gave one.

    labels : of any shape, as of `outcome_labels`.
    """
    lost = Counter(label for label in np.ravel(labels).tolist() if label not in ANSWERS)
    each = ", ".join(f"{n} {label}" for label, n in sorted(lost.items()))
    return f"{lost.total()} without an answer ({each})" if lost else ""


def peaks_of(sweep: xr.Dataset, name: str) -> xr.DataArray:
    """Largest size of a state, or of one of the `quantities` asked for, in each case of a sweep.

    Parameters
    ----------
    sweep : xarray.Dataset
        Dataset of `simulate_many`.
    name : str
        Name of the state or quantity, such as "theta"; or of a variable that the dataset has.

    Returns
    -------
    xarray.DataArray
        Peaks in the shape of the sweep, in the unit of the state or quantity.

    Raises
    ------
    ValueError
        For a name that the dataset does not have; the message names all there are.
    """
    check_sweep("peaks_of", sweep)
    there = list(map(str, sweep.data_vars))
    for variable, of in (("peak", "state"), ("peak_quantity", "quantity")):
        if variable in sweep and of in sweep[variable].dims:
            names = [str(value) for value in sweep[of].values]
            if name in names:
                return sweep[variable].isel({of: names.index(name)})
            there += names
    if name in sweep.data_vars:
        return sweep[name]
    raise InputError("name", name).says(
        f"the sweep has no {name!r}{near(name, there)}: choose among {', '.join(there)}, or give "
        f"simulate_many quantities=[{name!r}]"
    )


def exceedances(
    sweep: xr.Dataset, demand: str | None, limit: float | None
) -> tuple[xr.DataArray, xr.DataArray, xr.DataArray]:
    """Which cases of a sweep exceed a limit, which gave an answer, and how each ended.

    Who overturns exceeds it; so does whose peak of the demand reaches the limit, if both are given.
    """
    labels = outcome_labels(sweep)
    exceeds, answered = labels == FALLS, labels.isin(ANSWERS)
    if demand is not None and limit is not None:
        exceeds = exceeds | (peaks_of(sweep, demand) >= limit)
    return exceeds & answered, answered, labels
