"""Options of a sweep: who runs its cases, how many at a time, and where results are kept."""

from __future__ import annotations

import os
from dataclasses import dataclass
from typing import Any

from rockeom.numbers import explained
from rockeom.numbers.checks import InputTypeError, options_of, whole_number


@explained.record(n_jobs="threads=", workers="threads=", rtol="options=rk.SolverOptions(rtol=...)")
@dataclass(frozen=True)
class SweepOptions:
    """How a sweep is run; results are the same to the last bit for any of these but `lanes`.

    Parameters
    ----------
    threads : int, optional
        Number of threads; all cores if not given.
    chunk : int, optional
        Number of cases that a thread takes at a time: if not given, ever fewer towards the end, so
        that no thread waits long for another. A chunk is also what a store keeps and an executor
        receives at a time: if not given, a 64th of the cases, at most 4096.
    progress : bool, optional
        Whether a line on stderr shows the progress; where stderr is a terminal if not given.
    lanes : bool, optional
        Whether the vectors of the processor carry many motions at once, up to several times as
        fast: if not given, with explicit methods for all structures on rigid ground and on two
        springs. Impact times agree with those without lanes within the tolerances, and results are
        the same to the last bit for any number and order of the cases. False integrates one motion
        after the other, as `simulate` does, to the same bits.
    store : path_like, optional
        Folder, such as "map.zarr", that keeps each chunk when it is done, of the package zarr (the
        extra `store`). The same call reads there what is done and does the rest; the result is that
        of a call that was never stopped, to the last bit.
    executor : concurrent.futures.Executor, optional
        Executor that does the work instead of threads: anything whose `submit` returns futures,
        such as ProcessPoolExecutor() or ``client.get_executor(pure=False)`` of a dask cluster.

    Raises
    ------
    TypeError
        For values of the wrong kind.
    ValueError
        For numbers out of their ranges.

    Notes
    -----
    A killed process loses no more than the chunks under way. `threads`, `chunk` and `executor` may
    change from call to call; the chunks remain those of the first. The sweep of a store must be the
    same: its names and values, structure, options and results, and the function, by the cases that
    it makes: the first, the last, 14 between and one of each object in `over`. Another function
    that makes the same of these is not noticed. One process at a time may write; `open_sweep`
    reads.

    With an executor the case or function, its values and the options are sent to the workers, and
    so must be picklable; with a ProcessPoolExecutor a function stands at the top level of a module.
    A chunk that is lost with its worker is given out again, where the executor takes it. This
    process alone writes to the store.

    Examples
    --------
    >>> import rockeom as rk
    >>> block = rk.RigidBlock(half_width=0.1, half_height=0.4)  # m
    >>> def case(amplitude):
    ...     return rk.Case(block, rk.GroundMotion.single_sine(amplitude, 0.4, duration=6.0))
    >>> options = rk.SweepOptions(threads=1, progress=False)
    >>> sweep = rk.simulate_many(case, {"amplitude": [3.0, 4.0]}, sweep_options=options)

    A sweep that is kept on disk::

        rk.simulate_many(case, over, sweep_options=rk.SweepOptions(store="map.zarr", threads=8))
    """

    threads: int | None = None
    chunk: int | None = None
    progress: bool | None = None
    lanes: bool | None = None
    store: str | os.PathLike[str] | None = None
    executor: Any = None

    def __post_init__(self) -> None:
        for name in ("threads", "chunk"):
            if (value := getattr(self, name)) is not None:
                object.__setattr__(self, name, whole_number(name, value, 1))
        for name in ("progress", "lanes"):
            if getattr(self, name) not in (None, True, False):
                raise InputTypeError(name, getattr(self, name)).give("True, False or None")
        if not isinstance(self.store, str | os.PathLike | None):
            raise InputTypeError("store", self.store).give(
                "the path of a folder, such as 'map.zarr'"
            )
        if self.executor is not None and not callable(getattr(self.executor, "submit", None)):
            raise InputTypeError("executor", self.executor).give(
                "one that takes work by `submit`, such as concurrent.futures.ProcessPoolExecutor()"
            )

    @classmethod
    def of(cls, options: SweepOptions | None) -> SweepOptions:
        """Options, or the defaults for None.

        Parameters
        ----------
        options : SweepOptions
            Options or None.

        Returns
        -------
        SweepOptions
            Options.

        Raises
        ------
        TypeError
            For anything else.
        """
        return options_of("sweep_options", options, cls, "rk.SweepOptions(threads=4)")
