"""Numbers that record how they are calculated: a case of such numbers is one for all sliders.

The constructors of structures, motions and laws are plain Python, and a browser has none. A
`Traced` calculates as a number does and records how. A comparison gives the truth at the present
values, and is recorded as a condition: where it fails another way may be gone. Where a plain number
is needed (`float(x)`, `math.sin(x)`, an index) the record would be lost: that is an UntracedError.
"""

from __future__ import annotations

import math
import operator
import sys
from collections.abc import Callable
from numbers import Real
from pathlib import Path
from typing import Any, NamedTuple, NoReturn

import numpy as np

from rockeom.browser import elementary
from rockeom.numbers.functions import COMPARISONS, IN_MATH, SIGNS, Compound

_LIBRARIES = (str(Path(__file__).parents[1]), str(Path(np.__file__).parent))
OWN = {n.removeprefix("own_"): f for n, f in vars(elementary).items() if n.startswith("own_")}
LONG = 64
"""Operations from which on an expression is long, and none of the rows of a table."""
_CALLED = IN_MATH | {"maximum": "max", "minimum": "min"}
_FUNCTIONS = OWN | {name: getattr(operator, name) for name in (*SIGNS, "neg", "abs")}
_FUNCTIONS |= {"sqrt": math.sqrt, "max": max, "min": min}
_MOST = 9
"""The largest whole exponent that is written as products, as in machine code."""


class UntracedError(TypeError):
    """Calculation with a slider that a page cannot repeat, with the line of it."""


class Node:
    """An operation of a tape, which has each once.

    of : its arguments, nodes or numbers; that of a slider is its place. size : of its expression,
    in operations, as far as it is not long.
    """

    __slots__ = ("of", "operation", "size")

    def __init__(self, operation: str, of: tuple[Any, ...]) -> None:
        self.operation, self.of = operation, of
        self.size: int = min(1 + sum(x.size for x in of if isinstance(x, Node)), LONG)


class Condition(NamedTuple):
    """A comparison on the way, and whether it held."""

    comparison: str
    left: Any
    right: Any
    holds: bool


class Tape:
    """The operations of a calculation, and its conditions in their order."""

    def __init__(self) -> None:
        self.conditions: dict[Condition, None] = {}
        self.nodes: dict[tuple[Any, ...], Node] = {}

    def node(self, operation: str, *of: Any) -> Node:
        """The operation of nodes or numbers; of zeros, which are equal, by their signs."""
        key = operation, *(x or str(x) for x in of)
        if key not in self.nodes:
            self.nodes[key] = Node(operation, of)
        return self.nodes[key]

    def sliders(self, values: dict[str, float]) -> dict[str, Traced]:
        """A traced number for each slider, by name."""
        return {
            name: Traced(self, self.node("slider", i), float(value))
            for i, (name, value) in enumerate(values.items())
        }

    def condition(self, comparison: str, left: Any, right: Any) -> bool:
        """The truth at the present values, which is recorded."""
        holds = bool(getattr(operator, comparison)(plain(left), plain(right)))
        condition = Condition(comparison, node_of(left), node_of(right), holds)
        self.conditions[condition] = None
        return holds


def plain(x: Any) -> float:
    """The present value of a number."""
    return x.present if isinstance(x, Traced) else float(x)


def node_of(x: Any) -> Node | float:
    """The operation of a traced number, or a plain one."""
    return x.node if isinstance(x, Traced) else float(x)


def _refuse(what: str, remedy: str) -> NoReturn:
    """Raise UntracedError with the line outside of the package that led here."""
    frame: Any = sys._getframe(1)
    while frame and (frame.f_code.co_filename.startswith(_LIBRARIES)):
        frame = frame.f_back
    where = f"{frame.f_code.co_filename}, line {frame.f_lineno}: " if frame else ""
    raise UntracedError(f"{where}{what} cannot be part of a page: {remedy}")


def _refused(what: str, remedy: str) -> Callable[..., NoReturn]:
    """An operation on a number that a page cannot repeat: an error with its remedy."""
    return lambda *_: _refuse(what, remedy)


class Traced(Compound):
    """A number of a tape. node : its operation. present : its value where the sliders are now."""

    __slots__ = ("node", "present", "tape")

    def __init__(self, tape: Tape, node: Node, present: float) -> None:
        self.tape, self.node, self.present = tape, node, float(present)

    def __repr__(self) -> str:
        return f"<{self.present!r}, of sliders>"

    def __format__(self, how: str) -> str:
        return format(self.present, how)

    def checked(self) -> float:
        return self.present

    @classmethod
    def of_function(cls, function: Callable[..., Any], arguments: tuple[Any, ...]) -> Any:
        """Raises UntracedError for a function that a page has not."""
        (tape,) = {id(x.tape): x.tape for x in arguments if isinstance(x, cls)}.values()
        name = _CALLED.get(function.__name__, function.__name__)
        x, *more = arguments
        if name in COMPARISONS:
            return tape.condition(name, *arguments)
        if name == "fabs":
            return abs(x)
        if name == "sign":
            return 1.0 if x > 0.0 else -1.0 if x < 0.0 else 0.0
        if name == "hypot":
            return np.sqrt(x * x + more[0] * more[0])
        if name == "atan2" and more[0] > 0.0:  # the angle of a block
            return np.arctan(x / more[0])
        if name == "isfinite":
            return abs(x) < math.inf
        if name not in _FUNCTIONS:
            _refuse(f"{name} of a slider", "a page has no such function")
        node = tape.node(name, *map(node_of, arguments))
        return cls(tape, node, _FUNCTIONS[name](*map(plain, arguments)))

    def __array_ufunc__(self, ufunc: np.ufunc, method: str, *arguments: Any, **how: Any) -> Any:
        if method != "__call__" or ufunc.signature is not None:
            _refuse(f"numpy.{ufunc.__name__}.{method} of a slider", "take numbers one by one")
        if how and not any(isinstance(x, np.ndarray) for x in arguments):
            _refuse(f"numpy.{ufunc.__name__} of a slider with {', '.join(how)}", "leave them out")
        return super().__array_ufunc__(ufunc, method, *arguments, **how)

    def __pow__(self, exponent: Any) -> Any:
        if isinstance(exponent, Traced) or not 0 < exponent <= _MOST or exponent % 1:
            if not isinstance(exponent, Traced) and exponent == 0.5:
                return np.sqrt(self)
            return self.of_function(pow, (self, exponent))
        power = self
        for _ in range(int(exponent) - 1):
            power = power * self
        return power

    def __rpow__(self, base: Any) -> Any:
        return self.of_function(pow, (base, self))

    def __bool__(self) -> bool:
        return bool(self != 0.0)

    __float__ = _refused(
        "float() or a function of `math` of a slider", "take the function of numpy"
    )
    __int__ = _refused("int() of a slider", "a whole number cannot follow it")
    __index__ = _refused("a slider as an index, or as a count", "a whole number cannot follow it")
    __round__ = _refused("round() of a slider", "leave it out")
    __mod__ = _refused("a remainder, or a quotient rounded down, of a slider", "leave it out")
    __rmod__ = __floordiv__ = __rfloordiv__ = __divmod__ = __mod__
    __floor__ = __ceil__ = __trunc__ = __int__


Real.register(Traced)


# --- as a text


class Lines:
    """Nodes as lines of Python, each operation once."""

    def __init__(self) -> None:
        self.lines: list[str] = []
        self.names: dict[Any, str] = {}

    def name(self, node: Node | float) -> str:
        """The name of the value of a node, or a number."""
        if not isinstance(node, Node):
            return number_text(node)
        if node not in self.names:
            text = self._text(node)
            self.names[node] = f"x{len(self.names)}"
            self.lines.append(f"{self.names[node]} = {text}")
        return self.names[node]

    def _text(self, node: Node) -> str:
        if node.operation == "slider":
            return f"sliders[{node.of[0]}]"
        return self.expression(node.operation, [self.name(x) for x in node.of])

    def expression(self, operation: str, operands: list[str]) -> str:
        """An operation of things that have names."""
        if operation in SIGNS:
            return f"{operands[0]} {SIGNS[operation]} {operands[1]}"
        if operation == "neg":
            return f"-{operands[0]}"
        called = f"own_{operation}" if operation in OWN else operation
        called = "math.sqrt" if operation == "sqrt" else called
        return f"{called}({', '.join(operands)})"


def number_text(x: float) -> str:
    """A number as Python reads it, to the bit."""
    if math.isnan(x):
        return "np.nan"
    if math.isinf(x):
        return "np.inf" if x > 0 else "(-np.inf)"
    return repr(float(x)) if math.copysign(1.0, x) > 0 else f"({float(x)!r})"


def skeleton(node: Node | float, numbers: list[float]) -> Any:
    """A node without its numbers, which are added to the list: rows of a table may share it.

    A long node stands for itself: rows share it as a whole.
    """
    if not isinstance(node, Node):
        numbers.append(node)
        return None
    if node.operation == "slider" or node.size == LONG:
        return node
    return node.operation, *(skeleton(x, numbers) for x in node.of)
