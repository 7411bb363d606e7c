"""Functions of numbers, and of objects that calculate as numbers and have more behind them.

Such are the numbers of many cases (`rockeom.numbers.batch`), a number with its derivatives
(`rockeom.numbers.dual`), and one with its rates (`rockeom.numbers.jet`). A formula that is written
for numbers, as those of the generated modules are, calculates with all of them.
"""

import math
import operator
from collections.abc import Callable
from functools import cache, partial
from types import FunctionType, SimpleNamespace
from typing import Any, NamedTuple

import numpy as np

from rockeom.numbers.derivatives import CURVATURES, SLOPES


@cache
def gauss_rule(places: int = 8) -> tuple[np.ndarray, np.ndarray]:
    """(nodes, weights) of Gauss's rule on [-1, 1]."""
    return np.polynomial.legendre.leggauss(places)  # NumPy imports it on first use


OPERATORS: dict[np.ufunc, Callable[..., Any]] = {
    np.add: operator.add, np.subtract: operator.sub, np.multiply: operator.mul,
    np.true_divide: operator.truediv, np.floor_divide: operator.floordiv,
    np.remainder: operator.mod, np.power: operator.pow, np.negative: operator.neg,
    np.positive: operator.pos, np.absolute: abs, np.less: operator.lt,
    np.less_equal: operator.le, np.equal: operator.eq, np.not_equal: operator.ne,
    np.greater_equal: operator.ge, np.greater: operator.gt, np.bitwise_and: operator.and_,
    np.bitwise_or: operator.or_, np.bitwise_xor: operator.xor,
}  # fmt: skip
"""NumPy's names of Python's operators, which know whole numbers of any size."""

SIGNS = {"add": "+", "sub": "-", "mul": "*", "truediv": "/"}
COMPARISONS = {"lt": "<", "le": "<=", "gt": ">", "ge": ">=", "eq": "==", "ne": "!="}
"""Names in `operator` of operators of two numbers, and how most languages write them."""

Operator = Callable[[Any, Any], Any]


def _binary(function: Operator) -> tuple[Operator, Operator]:
    """An operator of two numbers, and the same with the compound on its right."""

    def forward(self: Any, other: Any) -> Any:
        return self.of_function(function, (self, other)) if self.meets(other) else NotImplemented

    def backward(self: Any, other: Any) -> Any:
        return self.of_function(function, (other, self)) if self.meets(other) else NotImplemented

    return forward, backward


class Compound:
    """An object that calculates as a number and has more behind it.

    Its operators are functions of two numbers, and NumPy's functions of numbers those of `math`.
    """

    __slots__ = ()

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

    def checked(self) -> Any:
        """Its plain number, for a check that raises or changes nothing.

        Returns
        -------
        object
            Number.
        """
        return self

    @classmethod
    def of_function(cls, function: Callable[..., Any], arguments: tuple[Any, ...]) -> Any:
        """Function of `math`, `operator` or NumPy where an argument is of this class.

        Parameters
        ----------
        function : callable
            Function.
        arguments : tuple of object
            Arguments.

        Returns
        -------
        object
            Value of the function.
        """
        raise NotImplementedError

    @classmethod
    def meets(cls, other: Any) -> bool:
        """Whether an operator takes another object.

        Parameters
        ----------
        other : object
            Object.

        Returns
        -------
        bool
            Whether it is a number.
        """
        return isinstance(other, (int, float, np.number, cls))  # a union takes longer to make

    def __array_ufunc__(self, ufunc: np.ufunc, method: str, *arguments: Any, **how: Any) -> Any:
        """NumPy's functions of numbers one by one, operators among them."""
        if method != "__call__" or ufunc.signature is not None:
            return NotImplemented
        if any(isinstance(x, np.ndarray) for x in arguments):
            return ufunc(*(boxed(x) if type(x) is type(self) else x for x in arguments), **how)
        if how:
            return NotImplemented
        if ufunc in OPERATORS:
            return OPERATORS[ufunc](
                *(x if isinstance(x, Compound) else float(x) for x in arguments)
            )
        return self.of_function(ufunc, arguments)

    __add__, __radd__ = _binary(operator.add)
    __sub__, __rsub__ = _binary(operator.sub)
    __mul__, __rmul__ = _binary(operator.mul)
    __truediv__, __rtruediv__ = _binary(operator.truediv)
    __pow__, __rpow__ = _binary(operator.pow)
    __lt__, __gt__ = _binary(operator.lt)[0], _binary(operator.gt)[0]
    __le__, __ge__ = _binary(operator.le)[0], _binary(operator.ge)[0]
    __eq__, __ne__ = _binary(operator.eq)[0], _binary(operator.ne)[0]

    def __neg__(self) -> Any:
        return self.of_function(operator.neg, (self,))

    def __abs__(self) -> Any:
        return self.of_function(abs, (self,))

    def __pos__(self) -> Any:
        return self


def boxed(x: Any) -> np.ndarray:
    """An object as NumPy has it, which has no say any more in what NumPy does."""
    box = np.empty((), dtype=object)
    box[()] = x
    return box


class _Mathematics:
    """The functions of `math`, of compounds as well."""

    def __getattr__(self, name: str) -> Any:
        function = getattr(math, name)
        if callable(function):
            function = _of_compounds(function)
        setattr(self, name, function)
        return function


def _of_compounds(plain: Callable[..., Any]) -> Callable[..., Any]:
    def function(*arguments: Any) -> Any:
        for x in arguments:
            if isinstance(x, Compound):
                return type(x).of_function(plain, arguments)
        return plain(*arguments)

    return function


mathematics = _Mathematics()


def checked(x: Any) -> Any:
    """An array without what is behind its numbers, for a check that raises or changes nothing."""
    if not (isinstance(x, np.ndarray) and x.dtype == object):
        return x.checked() if isinstance(x, Compound) else x
    plain = [element.checked() if isinstance(element, Compound) else element for element in x.flat]
    return np.array(plain).reshape(x.shape)


def isfinite(x: Any) -> Any:
    """`math.isfinite`, of compounds as well."""
    return abs(x) < math.inf if isinstance(x, Compound) else math.isfinite(x)


def _new(make: Callable[..., np.ndarray], n: int, kind: type = object) -> np.ndarray:
    """An array in which compounds, or whole numbers, stand."""
    return make(n, dtype=kind)


_ARRAYS = SimpleNamespace(empty=partial(_new, np.empty), zeros=partial(_new, np.zeros), int64=int)
"""Functions of NumPy that generated modules use."""


@cache
def of_compounds(module: Any) -> Any:
    """The functions of a generated module, which take compounds; arrays hold objects."""
    names = vars(module) | {
        "math": mathematics,
        "np": _ARRAYS,
    }
    around = {id(vars(module)): names}
    for name, function in vars(module).items():
        if isinstance(function, FunctionType):
            home = function.__globals__
            if id(home) not in around:  # it is imported, with its constants and what it calls there
                around[id(home)] = {**home, **names}
                around[id(home)] |= _called_with(around[id(home)], home)
            names[name] = FunctionType(function.__code__, around[id(home)])
    return SimpleNamespace(**names)


def _called_with(names: dict[str, Any], home: dict[str, Any]) -> dict[str, FunctionType]:
    """The functions of a module with other names around them."""
    return {
        name: FunctionType(function.__code__, names)
        for name, function in home.items()
        if isinstance(function, FunctionType) and function.__globals__ is home
    }


def for_arrays(module: Any, *arrays: np.ndarray) -> Any:
    """The generated module, for compounds where arrays hold such."""
    return of_compounds(module) if any(x.dtype == object for x in arrays) else module


class Derivatives(NamedTuple):
    """A function of one number with its first two derivatives, of arrays."""

    f: Callable[[Any], Any]
    slope: Callable[[Any], Any]
    curvature: Callable[[Any], Any]


IN_MATH = {
    "arcsin": "asin", "arccos": "acos", "arctan": "atan", "arcsinh": "asinh", "arccosh": "acosh",
    "arctanh": "atanh", "arctan2": "atan2",
}  # fmt: skip
"""Names of `math` by those that NumPy has instead."""


def _of_arrays(derivative: Callable[..., Any]) -> Callable[[Any], Any]:
    """A function of `rockeom.numbers.derivatives`, of arrays."""
    return FunctionType(derivative.__code__, {"math": np})


FUNCTIONS: dict[str, Derivatives] = {
    of.__name__: Derivatives(
        getattr(np, of.__name__), _of_arrays(SLOPES[of]), _of_arrays(curvature)
    )
    for of, curvature in CURVATURES.items()
} | {"fabs": Derivatives(np.abs, np.sign, lambda x: 0.0 * x)}
"""Functions by their names in `math`."""
