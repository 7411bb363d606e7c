"""Marks of functions and arguments for the printer of machine code. Python itself ignores them.

The texts that become machine code (generated modules, steps, the loop) are plain Python, and run as
such. The marks say what Python cannot.
"""

from collections.abc import Callable, Iterable
from typing import TypeAlias, TypeVar

import numpy as np
from numpy.typing import NDArray

_F = TypeVar("_F", bound=Callable[..., object])


def inlined(function: _F) -> _F:
    """Mark a function to be written out at each call, unless the program would grow long by it."""
    return function


def everywhere(function: _F) -> _F:
    """Mark a function to be written out at each call, however long the program grows by it."""
    return function


def apart(function: _F) -> _F:
    """Mark a function to be called, and not written out at its calls."""
    return function


def rolled(function: _F) -> _F:
    """Its loops stay loops: written out round by round they are longer to compile than to run."""
    return function


def unrolled(numbers: Iterable[int]) -> Iterable[int]:
    """`for i in unrolled(range(N))`: written out round by round, with `i` a constant in each.

    The numbers are a range of constants, or a constant tuple.
    """
    return numbers


def fused(function: _F) -> _F:
    """a*b + c may be rounded once, in a text where it is rounded twice elsewhere."""
    return function


def entry(function: _F) -> _F:
    """Called from Python; its arguments have annotations: int, float, bool, or one of the below."""
    return function


def rule_of(function: Callable[..., object]) -> Callable[[_F], _F]:
    """Mark a function that takes the place of another one for numbers with derivatives."""
    return lambda rule: rule


Floats: TypeAlias = NDArray[np.float64]
Floats2: TypeAlias = NDArray[np.float64]
Floats3: TypeAlias = NDArray[np.float64]
"""Arrays of one, two and three dimensions."""
Duals: TypeAlias = NDArray[np.float64]
Duals2: TypeAlias = NDArray[np.float64]
Duals3: TypeAlias = NDArray[np.float64]
"""The same of numbers with derivatives, which stand behind each in one dimension more."""
Ints: TypeAlias = NDArray[np.int64]
Ints2: TypeAlias = NDArray[np.int64]
