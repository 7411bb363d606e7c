"""Arguments of formulas: made arrays of numbers, or refused with their value and a remedy."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike


def require(right: ArrayLike, function: str, name: str, value: ArrayLike, rule: str) -> None:
    """Raise ValueError for the first value for which `right` is False.

    right, value : of shapes that broadcast. rule : what must hold, and the remedy.
    """
    rights, values = np.broadcast_arrays(right, value)
    if rights.all():
        return
    index = tuple(int(i) for i in np.argwhere(~rights)[0])
    place = f"[{', '.join(map(str, index))}]" if index else ""
    raise ValueError(f"{function}: {name}{place} is {values[index]}: {rule}")


def numbers(function: str, **values: ArrayLike) -> list[np.ndarray]:
    """The values as arrays of float, in the order given.

    Raises ValueError where one is not a finite number, and where they do not broadcast.
    """
    arrays = []
    for name, value in values.items():
        try:
            array = np.asarray(value, dtype=float)
        except (TypeError, ValueError):
            raise ValueError(
                f"{function}: {name} is {value!r}: give numbers, in SI units"
            ) from None
        require(np.isfinite(array), function, name, array, "it must be finite")
        arrays.append(array)
    try:
        np.broadcast_shapes(*(array.shape for array in arrays))
    except ValueError:
        shapes = ", ".join(f"{n} {a.shape}" for n, a in zip(values, arrays, strict=True))
        raise ValueError(f"{function}: the shapes of {shapes} do not broadcast") from None
    return arrays


def positive(function: str, **values: ArrayLike) -> list[np.ndarray]:
    """As `numbers`; raises ValueError also where one is not positive."""
    arrays = numbers(function, **values)
    for name, array in zip(values, arrays, strict=True):
        require(array > 0, function, name, array, "it must be positive, in SI units")
    return arrays


def not_negative(function: str, **values: ArrayLike) -> list[np.ndarray]:
    """As `numbers`; raises ValueError also where one is negative."""
    arrays = numbers(function, **values)
    for name, array in zip(values, arrays, strict=True):
        require(array >= 0, function, name, array, "it must be zero or positive, in SI units")
    return arrays
