"""Checks of the arguments of a caller: which values count as numbers, and words of errors."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from functools import cache
from numbers import Real
from typing import Any, TypeVar

import numpy as np

from rockeom.numbers.functions import Compound

T = TypeVar("T")

_LONGEST = 60  # letters of a value in an error
LARGEST_WHOLE = 2**63 - 1
"""The largest whole number of a compiled program."""


def described(value: Any) -> str:
    """A given value in few words: a class as such, what has a shape by its shape."""
    if isinstance(value, type):
        return f"the class {value.__name__}"
    shape = getattr(value, "shape", None)
    if isinstance(shape, tuple) and shape:
        return f"{_kind(value)} of shape {shape}"
    if isinstance(value, list | tuple | dict | set):
        return f"{_kind(value)} of length {len(value)}"
    if callable(value) and (name := getattr(value, "__name__", "")):
        return f"the function {name}"
    text = repr(value)
    return text if len(text) <= _LONGEST else text[: _LONGEST - 3] + "..."


def _kind(value: Any) -> str:
    name = type(value).__name__
    return f"{'an' if name[0].lower() in 'aeiou' else 'a'} {name}"


def near(name: Any, known: Iterable[str], instead: Mapping[str, str] | None = None) -> str:
    """A hint at the known name that is most like an unknown one, or nothing if none is.

    instead : what to write for known names, where that is another.
    """
    import difflib  # only where there is an error

    fold = str.lower if len(str(name)) > 2 else str  # THETA is theta, and R is not r
    folded = {fold(one): one for one in known}
    found = difflib.get_close_matches(fold(str(name)), folded, n=1)
    if not found:
        return ""
    meant = folded[found[0]]
    return f" (did you mean {(instead or {}).get(meant, meant)}?)"


def installed_by(extra: str) -> str:
    """The command that installs an extra of the package, quoted for every shell."""
    return f'pip install -e ".[{extra}]" in a clone of the repository of rockeom'


def options_of(name: str, options: Any, kind: type[T], example: str) -> T:
    """The options of a kind, or its defaults for None; raises TypeError for anything else."""
    chosen = _defaults(kind) if options is None else options  # type: ignore[arg-type]
    if not isinstance(chosen, kind):
        raise TypeError(f"{name} is {described(chosen)}: give options, such as {example}")
    return chosen


@cache
def _defaults(kind: Any) -> Any:
    return kind()


def is_number(value: Any) -> bool:
    """Whether a value is one real number: of Python, of NumPy, or an array without dimensions.

    A word is none, whatever it says, nor is True.
    """
    dtype = getattr(value, "dtype", None)
    if dtype is not None:
        return getattr(dtype, "kind", None) in ("i", "u", "f") and value.ndim == 0
    return isinstance(value, Real) and not isinstance(value, bool)


def number(what: str, value: Any, remedy: str = "give a number") -> float:
    """The number given for what is named; infinite where a float cannot hold it.

    Raises TypeError for anything but a number.
    """
    if type(value) is float:
        return value
    if isinstance(value, Compound):
        return value.floats()  # it calculates as a number does
    if not is_number(value):
        raise TypeError(f"{what} is {described(value)}: {remedy}")
    try:
        return float(value)
    except OverflowError:
        return float("inf") if value > 0 else -float("inf")


def numbers(what: str, value: Any, remedy: str = "give numbers") -> np.ndarray:
    """The numbers given for what is named, of any shape, as an array of float.

    Raises TypeError where one is no number, masked or complex.
    """
    if type(value) is np.ndarray and value.dtype == float:
        return value
    try:
        found = np.asarray(value)
    except ValueError as error:
        raise TypeError(f"{what} is {described(value)} ({error}): {remedy}") from None
    if np.ma.is_masked(value) or np.iscomplexobj(found):
        raise TypeError(
            f"{what} is masked or complex: fill the gaps, or take the real part, yourself"
        )
    if found.dtype.kind in "iuf":
        return found.astype(float)
    for index, element in np.ndenumerate(np.asarray(value, dtype=object)):
        if not (type(element) is float or isinstance(element, Compound) or is_number(element)):
            place = f"[{', '.join(map(str, index))}]" if index else ""
            raise TypeError(f"{what}{place} is {described(element)}, which is no number: {remedy}")
    compounds = any(issubclass(kind, Compound) for kind in {*map(type, found.flat)})
    return found if compounds else found.astype(float)


def whole_number(what: str, value: Any, least: int) -> int:
    """The whole number given for what is named, which may be written as a float.

    Raises TypeError for anything but a number and ValueError for one that is not whole, is below
    the least or takes more than 64 bits.
    """
    given = number(what, value, f"give a whole number of at least {least}")
    if not (given >= least and given.is_integer()):
        raise ValueError(f"{what} is {given:g}: give a whole number of at least {least}")
    whole = int(value) if isinstance(value, int | np.integer) else int(given)  # no digit is lost
    if whole > LARGEST_WHOLE:
        raise ValueError(f"{what} is {given:g}: give a whole number of at most {LARGEST_WHOLE}")
    return whole
