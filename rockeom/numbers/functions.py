"""Functions of numbers, and of objects that calculate as numbers and have more behind them.

Such are the numbers of many cases (`rockeom.numbers.batch`), a number with its derivatives
(`rockeom.numbers.dual`), and one with its rates (`rockeom.numbers.jet`). A formula that is written
for numbers, as those of the generated modules are, calculates with all of them.
"""

import math
from collections.abc import Callable
from functools import cache
from types import FunctionType, SimpleNamespace
from typing import Any, NamedTuple

import numpy as np

from rockeom.numbers.derivatives import CURVATURES, SLOPES


@cache
def gauss_rule(places: int = 8) -> tuple[np.ndarray, np.ndarray]:
    """(nodes, weights) of Gauss's rule on [-1, 1]."""
    return np.polynomial.legendre.leggauss(places)  # NumPy imports it on first use


class Compound:
    """An object that calculates as a number and has more behind it."""

    __slots__ = ()

    def __abs__(self) -> Any:
        raise NotImplementedError

    def floats(self) -> Any:
        """The same in floats.

        Returns
        -------
        Compound
            Number in floats.

        Raises
        ------
        OverflowError
            For a whole number that no float can hold.
        """
        return self

    @classmethod
    def of_function(cls, name: str, given: tuple[Any, ...]) -> Any:
        """Function of `math` where one of the arguments is of this class.

        Parameters
        ----------
        name : str
            Name of the function.
        given : tuple of object
            Arguments.

        Returns
        -------
        object
            Value of the function.
        """
        raise NotImplementedError


class _Mathematics:
    """The functions of `math`, of compounds as well."""

    def __getattr__(self, name: str) -> Any:
        function = getattr(math, name)
        if callable(function):
            function = _of_compounds(name, function)
        setattr(self, name, function)
        return function


def _of_compounds(name: str, plain: Callable[..., Any]) -> Callable[..., Any]:
    def function(*arguments: Any) -> Any:
        for x in arguments:
            if isinstance(x, Compound):
                return type(x).of_function(name, arguments)
        return plain(*arguments)

    return function


mathematics = _Mathematics()


def isfinite(x: Any) -> Any:
    """`math.isfinite`, of compounds as well."""
    return abs(x) < math.inf if isinstance(x, Compound) else math.isfinite(x)


@cache
def of_compounds(module: Any) -> Any:
    """The functions of a generated module, which take compounds; arrays hold objects."""
    names = vars(module) | {
        "math": mathematics,
        "np": SimpleNamespace(empty=lambda n: np.empty(n, dtype=object)),
    }
    for name, function in vars(module).items():
        if isinstance(function, FunctionType):
            own = function.__globals__ is vars(module)  # or it is imported, with its constants
            around = names if own else {**function.__globals__, **names}
            names[name] = FunctionType(function.__code__, around)
    return SimpleNamespace(**names)


def for_arrays(module: Any, *arrays: np.ndarray) -> Any:
    """The generated module, for compounds where arrays hold such."""
    return of_compounds(module) if any(x.dtype == object for x in arrays) else module


class Derivatives(NamedTuple):
    """A function of one number with its first two derivatives, of arrays."""

    f: Callable[[Any], Any]
    slope: Callable[[Any], Any]
    curvature: Callable[[Any], Any]


IN_NUMPY = {
    "asin": "arcsin", "acos": "arccos", "atan": "arctan", "asinh": "arcsinh", "acosh": "arccosh",
    "atanh": "arctanh",
}  # fmt: skip
"""Names that NumPy has instead of those of `math`."""
IN_MATH = {name: here for here, name in IN_NUMPY.items()} | {"arctan2": "atan2"}
"""Names of `math` by those of NumPy."""

_NAMES = [function.__name__ for function in CURVATURES]
_ARRAYS = SimpleNamespace(**{name: getattr(np, IN_NUMPY.get(name, name)) for name in _NAMES})


def _of_arrays(derivative: Callable[..., Any]) -> Callable[[Any], Any]:
    """A function of `rockeom.numbers.derivatives`, of arrays."""
    return FunctionType(derivative.__code__, {"math": _ARRAYS})


FUNCTIONS: dict[str, Derivatives] = {
    of.__name__: Derivatives(
        vars(_ARRAYS)[of.__name__], _of_arrays(SLOPES[of]), _of_arrays(curvature)
    )
    for of, curvature in CURVATURES.items()
} | {"fabs": Derivatives(np.abs, np.sign, lambda x: 0.0 * x)}
"""Functions by their names in `math`."""
