"""First and second derivatives of the functions of `math`.

NumPy's functions put in the place of `math` make them functions of arrays, see
`rockeom.numbers.functions`; programs that carry derivatives are printed with this text.
"""

import math
from collections.abc import Callable
from typing import Any

Function = Callable[..., Any]
SLOPES: dict[str, Function] = {}
CURVATURES: dict[str, Function] = {}
"""The derivatives, by the name of the function of `math`."""


def slope_of(function: Function) -> Callable[[Function], Function]:
    """Mark the first derivative of a function of `math`."""
    return lambda derivative: SLOPES.setdefault(function.__name__, derivative)


def curvature_of(function: Function) -> Callable[[Function], Function]:
    """Mark the second derivative of a function of `math`."""
    return lambda derivative: CURVATURES.setdefault(function.__name__, derivative)


@slope_of(math.sqrt)
def sqrt_slope(x):
    return 0.5 / math.sqrt(x)


@curvature_of(math.sqrt)
def sqrt_curvature(x):
    return -0.25 / (x * math.sqrt(x))


@slope_of(math.pow)
def power_slope(x, n):
    return n * x ** (n - 1.0)


@slope_of(math.exp)
def exp_slope(x):
    return math.exp(x)


@curvature_of(math.exp)
def exp_curvature(x):
    return math.exp(x)


@slope_of(math.expm1)
def expm1_slope(x):
    return math.exp(x)


@curvature_of(math.expm1)
def expm1_curvature(x):
    return math.exp(x)


@slope_of(math.log)
def log_slope(x):
    return 1.0 / x


@curvature_of(math.log)
def log_curvature(x):
    return -1.0 / (x * x)


@slope_of(math.log1p)
def log1p_slope(x):
    return 1.0 / (1.0 + x)


@curvature_of(math.log1p)
def log1p_curvature(x):
    return -1.0 / ((1.0 + x) * (1.0 + x))


@slope_of(math.sin)
def sin_slope(x):
    return math.cos(x)


@curvature_of(math.sin)
def sin_curvature(x):
    return -math.sin(x)


@slope_of(math.cos)
def cos_slope(x):
    return -math.sin(x)


@curvature_of(math.cos)
def cos_curvature(x):
    return -math.cos(x)


@slope_of(math.tan)
def tan_slope(x):
    value = math.tan(x)
    return 1.0 + value * value


@curvature_of(math.tan)
def tan_curvature(x):
    value = math.tan(x)
    return 2.0 * value * (1.0 + value * value)


@slope_of(math.asin)
def asin_slope(x):
    return 1.0 / math.sqrt(1.0 - x * x)


@curvature_of(math.asin)
def asin_curvature(x):
    return x / (1.0 - x * x) ** 1.5


@slope_of(math.acos)
def acos_slope(x):
    return -1.0 / math.sqrt(1.0 - x * x)


@curvature_of(math.acos)
def acos_curvature(x):
    return -x / (1.0 - x * x) ** 1.5


@slope_of(math.atan)
def atan_slope(x):
    return 1.0 / (1.0 + x * x)


@curvature_of(math.atan)
def atan_curvature(x):
    return -2.0 * x / (1.0 + x * x) ** 2


@slope_of(math.sinh)
def sinh_slope(x):
    return math.cosh(x)


@curvature_of(math.sinh)
def sinh_curvature(x):
    return math.sinh(x)


@slope_of(math.cosh)
def cosh_slope(x):
    return math.sinh(x)


@curvature_of(math.cosh)
def cosh_curvature(x):
    return math.cosh(x)


@slope_of(math.tanh)
def tanh_slope(x):
    value = math.tanh(x)
    return 1.0 - value * value


@curvature_of(math.tanh)
def tanh_curvature(x):
    value = math.tanh(x)
    return -2.0 * value * (1.0 - value * value)


@slope_of(math.asinh)
def asinh_slope(x):
    return 1.0 / math.sqrt(1.0 + x * x)


@curvature_of(math.asinh)
def asinh_curvature(x):
    return -x / (1.0 + x * x) ** 1.5


@slope_of(math.acosh)
def acosh_slope(x):
    return 1.0 / math.sqrt(x * x - 1.0)


@curvature_of(math.acosh)
def acosh_curvature(x):
    return -x / (x * x - 1.0) ** 1.5


@slope_of(math.atanh)
def atanh_slope(x):
    return 1.0 / (1.0 - x * x)


@curvature_of(math.atanh)
def atanh_curvature(x):
    return 2.0 * x / (1.0 - x * x) ** 2
