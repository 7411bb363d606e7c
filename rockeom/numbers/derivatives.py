"""First and second derivatives of the functions of `math`, by the function.

NumPy's functions put in the place of `math` make them functions of arrays, see
`rockeom.numbers.functions`; the compiler takes its rules for numbers with derivatives from the text
of SLOPES.
"""

import math
from collections.abc import Callable
from typing import Any

Function = Callable[..., Any]

SLOPES: dict[Function, Function] = {
    math.sqrt: lambda x: 0.5 / math.sqrt(x),
    math.pow: lambda x, n: n * x ** (n - 1.0),
    math.exp: lambda x: math.exp(x),
    math.expm1: lambda x: math.exp(x),
    math.log: lambda x: 1.0 / x,
    math.log1p: lambda x: 1.0 / (1.0 + x),
    math.sin: lambda x: math.cos(x),
    math.cos: lambda x: -math.sin(x),
    math.tan: lambda x: 1.0 + math.tan(x) * math.tan(x),
    math.asin: lambda x: 1.0 / math.sqrt(1.0 - x * x),
    math.acos: lambda x: -1.0 / math.sqrt(1.0 - x * x),
    math.atan: lambda x: 1.0 / (1.0 + x * x),
    math.sinh: lambda x: math.cosh(x),
    math.cosh: lambda x: math.sinh(x),
    math.tanh: lambda x: 1.0 - math.tanh(x) * math.tanh(x),
    math.asinh: lambda x: 1.0 / math.sqrt(1.0 + x * x),
    math.acosh: lambda x: 1.0 / math.sqrt(x * x - 1.0),
    math.atanh: lambda x: 1.0 / (1.0 - x * x),
}
"""First derivatives, by their only argument or by the first of two."""

CURVATURES: dict[Function, Function] = {
    math.sqrt: lambda x: -0.25 / (x * math.sqrt(x)),
    math.exp: lambda x: math.exp(x),
    math.expm1: lambda x: math.exp(x),
    math.log: lambda x: -1.0 / (x * x),
    math.log1p: lambda x: -1.0 / ((1.0 + x) * (1.0 + x)),
    math.sin: lambda x: -math.sin(x),
    math.cos: lambda x: -math.cos(x),
    math.tan: lambda x: 2.0 * math.tan(x) * (1.0 + math.tan(x) * math.tan(x)),
    math.asin: lambda x: x / (1.0 - x * x) ** 1.5,
    math.acos: lambda x: -x / (1.0 - x * x) ** 1.5,
    math.atan: lambda x: -2.0 * x / (1.0 + x * x) ** 2,
    math.sinh: lambda x: math.sinh(x),
    math.cosh: lambda x: math.cosh(x),
    math.tanh: lambda x: -2.0 * math.tanh(x) * (1.0 - math.tanh(x) * math.tanh(x)),
    math.asinh: lambda x: -x / (1.0 + x * x) ** 1.5,
    math.acosh: lambda x: -x / (x * x - 1.0) ** 1.5,
    math.atanh: lambda x: 2.0 * x / (1.0 - x * x) ** 2,
}
"""Second derivatives."""
