"""The controls of a page: sliders, and menus of parts of a case; and values of them by name.

All values of a page are one array, a number for each control in their order: the value of a slider,
and the number of the option of a menu.
"""

import itertools
import math
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np

from rockeom.browser.traced import Tape
from rockeom.numbers.checks import InputError, InputTypeError, described, is_number, require
from rockeom.simulation.case import Case
from rockeom.sweeps.case_numbers import OtherCase, function_of

MOST_CONTROLS = 12
MOST_SPECIAL = 1024
"""Values that are looked at because a case may go another way just there."""
MOST_COMBINATIONS = 24
"""Combinations of the options of all menus; the set-up of each is a part of the page."""


class Slider(NamedTuple):
    """Slider of a page.

    Parameters
    ----------
    low : float
        Lowest value.
    high : float
        Highest value.
    start : float, optional
        Value at first; that of the case or the middle if not given.
    unit : str, optional
        Unit behind its values; that of the number if not given, where the page is one of a case.
    words : str, optional
        Words in place of its name.

    Examples
    --------
    >>> import rockeom as rk
    >>> slider = rk.Slider(0.4, 4.0, 0.8, unit="m", words="height of the block")
    """

    low: float
    high: float
    start: float = math.nan
    unit: str = ""
    words: str = ""

    def at(self, share: float) -> float:
        """Value at a share of the range.

        Parameters
        ----------
        share : float
            Share, 0 to 1.

        Returns
        -------
        float
            Value.
        """
        return self.low + share * (self.high - self.low)


@dataclass(frozen=True)
class Menu:
    """A part of a case to choose from. options : by label, the first one at first."""

    options: Mapping[str, Any]

    @property
    def start(self) -> float:
        """The number of the option at first."""
        return 0.0

    @property
    def labels(self) -> list[str]:
        return list(self.options)

    def at(self, share: float) -> float:
        """The number of an option at a share of the menu, 0 to 1."""
        return float(min(int(share * len(self.options)), len(self.options) - 1))


@dataclass(frozen=True)
class Controls:
    """The controls of a page by name, in the order of their values."""

    of: Mapping[str, Slider | Menu]

    @property
    def start(self) -> np.ndarray:
        """The values at first."""
        return np.array([control.start for control in self.of.values()])

    def named(self, place: np.ndarray) -> dict[str, Any]:
        """Arguments of the case at some values: numbers, and the options of menus."""
        pairs = zip(self.of.items(), place.tolist(), strict=True)
        return {
            name: control.options[control.labels[int(x)]] if isinstance(control, Menu) else x
            for (name, control), x in pairs
        }

    def labelled(self) -> dict[str, Any]:
        """The values at first by name, those of menus by their labels."""
        return {name: control.labels[0] if isinstance(control, Menu) else control.start
                for name, control in self.of.items()}  # fmt: skip

    def arguments(self, values: Mapping[str, Any]) -> dict[str, Any]:
        """Arguments of the case at values by name, those of menus by their labels."""
        places = self.places("values", values)
        return self.named(np.array([places[k] for k in range(len(self.of))]))

    def traced(self, tape: Tape, place: np.ndarray) -> dict[str, Any]:
        """The same, the numbers traced, and the option that was chosen a condition."""
        numbers = tape.sliders(dict(zip(self.of, place.tolist(), strict=True)))
        arguments = self.named(place)
        for name, control in self.of.items():
            if isinstance(control, Menu):
                tape.condition("eq", numbers[name], numbers[name].present)
            else:
                arguments[name] = numbers[name]
        return arguments

    def combinations(self) -> Iterator[np.ndarray]:
        """The first values, with each combination of the options of all menus."""
        choices = [
            range(len(c.options)) if isinstance(c, Menu) else (c.start,) for c in self.of.values()
        ]
        yield from map(np.array, itertools.product(*choices))

    def spread(self, n: int) -> Iterator[np.ndarray]:
        """Values at both ends of all ranges, and n that fill them evenly.

        The additive recurrence of the plastic numbers: M. Roberts (2018), "The unreasonable
        effectiveness of quasirandom sequences".
        """
        size, root = len(self.of), 2.0
        for _ in range(40):  # root ** (size + 1) = root + 1
            root = (1.0 + root) ** (1.0 / (size + 1))
        shares = (0.5 + np.arange(n)[:, None] / root ** np.arange(1, size + 1)) % 1.0
        for row in ([0.0] * size, [1.0] * size, *shares.tolist()):
            yield np.array([c.at(x) for c, x in zip(self.of.values(), row, strict=True)])

    def special(self) -> Iterator[np.ndarray]:
        """Values with some controls at an end, at first or at zero, and the others spread.

        A case often goes another way just there: a block that stands upright, a ground at rest.
        """
        marks = [_special(control) for control in self.of.values()]
        chosen = (
            (group, values)
            for size in (1, 2, 3)
            for group in itertools.combinations(range(len(marks)), size)
            for values in itertools.product(*(marks[k] for k in group))
        )
        for place, (group, values) in zip(self.spread(MOST_SPECIAL), chosen, strict=False):
            place[list(group)] = values
            yield place

    def places(self, where: str, values: Mapping[str, Any]) -> dict[int, float]:
        """Some values by their place in the array; raises ValueError for one that cannot be, and
        TypeError where they have no names.

        where : the argument that has them.
        """
        check_mapping(where, values)
        return {list(self.of).index(self._known(where, n)): self._value(where, n, x)
                for n, x in values.items()}  # fmt: skip

    def _known(self, where: str, name: str) -> str:
        if name not in self.of:
            raise InputError(where, name).wrong(f"has {name!r}").choose(self.of)
        return name

    def _value(self, where: str, name: str, x: Any) -> float:
        control = self.of[name]
        if isinstance(control, Menu):
            require(x in control.options, where, name, x, f"give one of {control.labels}")
            return float(control.labels.index(x))
        if not (is_number(x) and control.low <= x <= control.high):
            raise InputError(name, x, where).give(
                f"a number from {control.low:g} to {control.high:g}, the range of the slider"
            )
        return float(x)


def _special(control: Slider | Menu) -> list[float]:
    if isinstance(control, Menu):
        return [float(i) for i in range(len(control.options))]
    within = [0.0] if control.low < 0.0 < control.high else []
    return sorted({control.low, control.start, control.high, *within})


def slider(name: str, given: Any, number: Any) -> Slider:
    """A slider, or (lowest, highest), (lowest, highest, first).

    number : that of the case, with its value and unit; None for an argument of a function.
    """
    several = isinstance(given, tuple | list) and 2 <= len(given) <= len(Slider._fields)
    if not (several and all(map(is_number, given[:3])) and all(map(_is_text, given[3:]))):
        raise InputTypeError("sliders", given).says(
            f"slider {name!r} is {described(given)}: give (lowest, highest) or (lowest, highest, "
            "first), or rk.Slider(lowest, highest, first, unit, words)"
        )
    low, high, start, unit, words = Slider(*given)
    if math.isnan(start):
        value = number.value if number else None
        start = (low + high) / 2 if value is None else min(max(value, low), high)
    if not (-math.inf < low < high < math.inf and low <= start <= high):
        raise InputError("sliders").says(
            f"slider {name!r} goes from {low:g} to {high:g}, first {start:g}: give two finite "
            "numbers, the lower one first, and a first value between them"
        )
    unit = unit or (number.unit if number else "")
    return Slider(float(low), float(high), float(start), unit, words)


def _is_text(x: Any) -> bool:
    return isinstance(x, str)


def check_mapping(name: str, given: Any) -> None:
    """Raise TypeError for what does not go by names."""
    if not (isinstance(given, Mapping) and all(map(_is_text, given))):
        example = '{"half_width": (0.05, 0.4)}' if name == "sliders" else "{name: ...}"
        raise InputTypeError(name, given).give(f"it by names, as {example}")


def _menu(name: str, given: Any) -> Menu:
    """A menu of options by label."""
    if not (isinstance(given, Mapping) and all(map(_is_text, given)) and len(given) > 1):
        raise InputTypeError("menus", given).says(
            f"menu {name!r} is {described(given)}: give two options or more by their labels, such "
            'as {"Housner": rk.AngularMomentum(), "r = 0.8": rk.EnergyRatio(0.8)}'
        )
    return Menu(dict(given))


def controls_of(
    case: Any, sliders: Mapping[str, Any], menus: Mapping[str, Any]
) -> tuple[Callable[..., Case], Controls]:
    """The function of a page, and its controls.

    Raises ValueError for too many controls, and for a name that two of them have.
    """
    menu_of = {name: _menu(name, value) for name, value in menus.items()}
    if not sliders or len(sliders) + len(menus) > MOST_CONTROLS:
        raise InputError("sliders").says(
            f"{len(sliders)} sliders and {len(menus)} menus: give a slider or more, and at most "
            f"{MOST_CONTROLS} of both"
        )
    if both := sliders.keys() & menus.keys():
        raise InputError("menus", min(both)).so("it is a slider, too: name one of both")
    combinations = math.prod(len(one.options) for one in menu_of.values())
    if combinations > MOST_COMBINATIONS:
        raise InputError("menus").says(
            f"the menus have {combinations} combinations of their options: give at most "
            f"{MOST_COMBINATIONS}"
        )
    function = function_of(case, (*sliders, *menus))
    numbers = function.numbers if isinstance(function, OtherCase) else {}
    slider_of = {name: slider(name, value, numbers.get(name)) for name, value in sliders.items()}
    return function, Controls({**slider_of, **menu_of})
