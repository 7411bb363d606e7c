"""Long work that an interrupt ended early: the guard of all answers that follow from it."""

from __future__ import annotations

from typing import Protocol, TypeVar

import xarray as xr

from rockeom.analysis.sweeps import NOT_RUN, outcome_labels

Result = TypeVar("Result", bound="Interruptible | xr.Dataset")


class Interruptible(Protocol):
    """A result of long work, no dataset, that a keyboard interrupt may have ended early."""

    @property
    def interrupted(self) -> bool: ...


def finished(result: Result) -> Result:
    """A result of long work from which another answer follows, if the work was done to its end.

    A call by the user returns what is done at an interrupt. A call inside the package has no reader
    for that, so each goes through this function, which raises the interrupt again.
    """
    if isinstance(result, xr.Dataset):
        interrupted = result.attrs.get("interrupted")
    else:
        interrupted = result.interrupted
    if interrupted:
        raise KeyboardInterrupt
    return result


def check_finished(function: str, sweep: xr.Dataset) -> None:
    """Raises ValueError, with the remedy, for a sweep of which some cases were not run."""
    labels = outcome_labels(sweep).values
    missing = int((labels == NOT_RUN).sum())
    if missing:
        raise ValueError(
            f"{function}: {missing} of {labels.size} cases were not run, and no answer follows "
            "from the others alone: run them all again, with the same store if there is one, or "
            "select the cases that were run"
        )
