"""First and second derivatives of the functions of `math`: `f_slope` and `f_curvature` of `math.f`.

NumPy's functions put in the place of `math` make them functions of arrays, see
`rockeom.numbers.functions`; programs that carry derivatives are printed with this text.
"""

import math


def sqrt_slope(x):
    return 0.5 / math.sqrt(x)


def sqrt_curvature(x):
    return -0.25 / (x * math.sqrt(x))


def power_slope(x, n):
    return n * x ** (n - 1.0)


def exp_slope(x):
    return math.exp(x)


def exp_curvature(x):
    return math.exp(x)


def expm1_slope(x):
    return math.exp(x)


def expm1_curvature(x):
    return math.exp(x)


def log_slope(x):
    return 1.0 / x


def log_curvature(x):
    return -1.0 / (x * x)


def log1p_slope(x):
    return 1.0 / (1.0 + x)


def log1p_curvature(x):
    return -1.0 / ((1.0 + x) * (1.0 + x))


def sin_slope(x):
    return math.cos(x)


def sin_curvature(x):
    return -math.sin(x)


def cos_slope(x):
    return -math.sin(x)


def cos_curvature(x):
    return -math.cos(x)


def tan_slope(x):
    value = math.tan(x)
    return 1.0 + value * value


def tan_curvature(x):
    value = math.tan(x)
    return 2.0 * value * (1.0 + value * value)


def asin_slope(x):
    return 1.0 / math.sqrt(1.0 - x * x)


def asin_curvature(x):
    return x / (1.0 - x * x) ** 1.5


def acos_slope(x):
    return -1.0 / math.sqrt(1.0 - x * x)


def acos_curvature(x):
    return -x / (1.0 - x * x) ** 1.5


def atan_slope(x):
    return 1.0 / (1.0 + x * x)


def atan_curvature(x):
    return -2.0 * x / (1.0 + x * x) ** 2


def sinh_slope(x):
    return math.cosh(x)


def sinh_curvature(x):
    return math.sinh(x)


def cosh_slope(x):
    return math.sinh(x)


def cosh_curvature(x):
    return math.cosh(x)


def tanh_slope(x):
    value = math.tanh(x)
    return 1.0 - value * value


def tanh_curvature(x):
    value = math.tanh(x)
    return -2.0 * value * (1.0 - value * value)


def asinh_slope(x):
    return 1.0 / math.sqrt(1.0 + x * x)


def asinh_curvature(x):
    return -x / (1.0 + x * x) ** 1.5


def acosh_slope(x):
    return 1.0 / math.sqrt(x * x - 1.0)


def acosh_curvature(x):
    return -x / (x * x - 1.0) ** 1.5


def atanh_slope(x):
    return 1.0 / (1.0 - x * x)


def atanh_curvature(x):
    return 2.0 * x / (1.0 - x * x) ** 2
