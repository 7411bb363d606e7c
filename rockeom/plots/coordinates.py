"""Coordinates of a dataset in a figure: which there are, where they stand, how they are called."""

from typing import Any

import numpy as np
import xarray as xr
from matplotlib.axes import Axes

from rockeom.analysis.sweeps import coordinate
from rockeom.drawing import style
from rockeom.numbers.checks import InputError


def only(function: str, values: xr.DataArray, sweep: xr.Dataset, *names: str) -> xr.DataArray:
    """The array without dimensions of one value: those of the names are left.

    Raises ValueError where others have several values.
    """
    wanted = {d for name in names for d in coordinate(function, sweep, name).dims}
    others = {str(d): n for d, n in values.sizes.items() if d not in wanted and n > 1}
    if others:
        told = ", ".join(f"{name} ({n} values)" for name, n in others.items())
        first = next(iter(others))
        raise InputError("sweep", of=function).says(
            f"the sweep varies {told} as well: choose one, as in sweep.isel({first}=0), or name it"
        )
    return values.squeeze([d for d in values.dims if d not in wanted], drop=True)


def sortable(sweep: xr.Dataset, *names: str) -> list[str]:
    """Names whose values are numbers."""
    return [name for name in names if sweep[name].dtype.kind in "iuf"]


def places(values: xr.DataArray) -> np.ndarray:
    """Places of values on an axis: numbers where they are, words one after the other."""
    if values.dtype.kind in "iuf":
        return values.values
    each = different(values)
    return np.array([each.index(word) for word in values.values.tolist()])


def edges(centres: np.ndarray) -> np.ndarray:
    """(n + 1,) edges half-way between (n,) centres, and as far beyond the first and the last."""
    if len(centres) == 1:
        return centres[0] + np.array([-0.5, 0.5])
    between = (centres[1:] + centres[:-1]) / 2
    first, last = 2 * centres[0] - between[0], 2 * centres[-1] - between[-1]
    return np.concatenate([[first], between, [last]])


def different(values: xr.DataArray) -> list[Any]:
    """The different ones, in the order in which they come."""
    return list(dict.fromkeys(values.values.tolist()))


def name_axes(ax: Axes, sweep: xr.Dataset, x: str, y: str) -> None:
    """Names and units of both axes, and the words along them."""
    ax.set(xlabel=label(sweep, x), ylabel=label(sweep, y))
    for name, axis in ((x, ax.xaxis), (y, ax.yaxis)):
        if sweep[name].dtype.kind not in "iuf":
            words = [said(value) for value in different(sweep[name])]
            turned = axis is ax.xaxis and max(map(len, words)) > 6
            look: dict[str, Any] = {"rotation": 30, "ha": "right"} if turned else {}
            axis.set_ticks(range(len(words)), words, **look)


def label(sweep: xr.Dataset, name: str) -> str:
    """Name and unit of a coordinate."""
    attrs = sweep[name].attrs
    words = style.plain(str(attrs.get("long_name", name.replace("_", " "))))
    return f"{words} [{unit(attrs['units'])}]" if "units" in attrs else words


def unit(of: Any) -> str:
    """A unit as it is written on an axis: "1" is none."""
    return "-" if str(of) == "1" else style.plain(str(of))


def said(value: Any) -> str:
    """A coordinate's value in a figure."""
    if isinstance(value, (int, float, np.number)):
        return f"{value:.4g}"
    return style.plain(short(str(value)))


def short(name: str, letters: int = 24) -> str:
    """Its beginning and its end: components of a record differ there."""
    return name if len(name) <= letters else f"{name[: letters - 11]}…{name[-10:]}"
