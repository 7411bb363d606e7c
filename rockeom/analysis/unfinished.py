"""Results of long work that an interrupt ended early: no other result may follow from them."""

from __future__ import annotations

from typing import Protocol, TypeVar

import xarray as xr

from rockeom.analysis.sweeps import NOT_RUN, outcome_labels

Result = TypeVar("Result", bound="Interruptible | xr.Dataset")


class Interruptible(Protocol):
    """A result, other than a dataset, of work that a keyboard interrupt may have ended early."""

    @property
    def interrupted(self) -> bool: ...


def finished(result: Result) -> Result:
    """The result itself, if the work was done to its end; raises KeyboardInterrupt otherwise.

    A call by the user returns an incomplete result at an interrupt. A call in the package passes it
    through this function, which raises the interrupt again.
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
