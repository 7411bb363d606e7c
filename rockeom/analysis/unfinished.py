"""Results of long work that an interrupt ended early: no other result may follow from them."""

from __future__ import annotations

import xarray as xr

from rockeom.analysis.sweeps import NOT_RUN, outcome_labels


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
