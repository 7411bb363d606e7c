"""Sweeps of tests: all options by their names, and functions that are called case by case."""

import dataclasses
from collections.abc import Callable
from typing import Any

import rockeom as rk
from rockeom.numbers.batch import one_of

OPTIONS = {field.name for field in dataclasses.fields(rk.SweepOptions)}


def simulate_many(case: Any, over: Any, **how: Any) -> rk.Sweep:
    """The sweep, with arguments of `rk.simulate_many` and of `rk.SweepOptions`."""
    of_sweep = {name: how.pop(name) for name in OPTIONS & how.keys()}
    return rk.simulate_many(case, over, sweep_options=rk.SweepOptions(**of_sweep), **how)


def one_by_one(case: Callable[..., rk.Case]) -> Callable[..., rk.Case]:
    """The same function, which asks for single numbers, and so is called for each case."""

    def of_one(**values: Any) -> rk.Case:
        return case(**{name: one_of(value) for name, value in values.items()})

    return of_one
