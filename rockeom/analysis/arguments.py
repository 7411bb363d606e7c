"""Arguments that several formulas share: slenderness, side, starts of sections."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike

from rockeom.numbers.checks import InputError, numbers, require

if TYPE_CHECKING:
    import xarray as xr


def slenderness(function: str, alpha: ArrayLike) -> np.ndarray:
    """alpha as an array; raises ValueError where it does not lie between 0 and pi/2."""
    (angle,) = numbers(function, alpha=alpha)
    rule = "alpha = atan(half_width/half_height) lies between 0 and pi/2, in radians"
    require((angle > 0) & (angle < np.pi / 2), function, "alpha", angle, rule)
    return angle


def side_of(function: str, theta: np.ndarray, side: ArrayLike | None) -> np.ndarray:
    """+1 where the block stands on its right foot, -1 where on its left; from theta if not given.

    Raises ValueError where theta is zero and no side is given, where the side is neither, and
    where it contradicts theta.
    """
    if side is None:
        rule = "upright, the rotation does not tell the foot: give side=1 (right) or -1 (left)"
        require(theta != 0, function, "theta", theta, rule)
        return np.sign(theta)
    (number,) = numbers(function, side=side)
    require(np.abs(number) == 1, function, "side", number, "give 1 (right foot) or -1 (left foot)")
    rule = "it contradicts the sign of theta: leave it out, or give it for theta = 0 alone"
    require(number * theta >= 0, function, "side", number, rule)
    return number


def measured_swings(
    function: str, offered: Mapping[str, ArrayLike | None]
) -> dict[str, np.ndarray]:
    """Measured peaks, peak times and crossing times (n,), those that there are, by these names.

    Raises ValueError where there are none.
    """
    given = {name: x for name, x in offered.items() if x is not None}
    require(bool(given), function, "peaks", None, "give peaks, peak_times or crossing_times")
    return {name: np.atleast_1d(numbers(function, **{name: x})[0]) for name, x in given.items()}


def dims_of_starts(function: str, sections: xr.Dataset, *names: str) -> tuple[str, ...]:
    """Names of the dimensions over which the motions of `poincare_sections` start differently.

    Raises ValueError where the sections vary anything but these and the names.
    """
    dims = list(map(str, sections["outcome"].dims))
    starts = tuple(name for name in str(sections.attrs.get("starts")).split() if name in dims)
    others = [name for name in dims if name not in (*starts, *names)]
    if others:
        raise InputError("sections", of=function).says(
            f"the sections vary {', '.join(others)} as well: choose one value, as in sections.isel("
            f"{others[0]}=0)"
        )
    return starts
