"""Numbers in sentences."""

import numpy as np

from rockeom.motion import STANDARD_GRAVITY


def in_g(acceleration: float, digits: int = 3) -> str:
    return f"{acceleration / STANDARD_GRAVITY:.{digits}g} g"


def percent(part: float) -> str:
    value = 100 * part
    whole = abs(value) >= 10 or abs(value - round(value)) < 0.05
    return f"{value:.{0 if whole else 1}f} %".replace("-0 %", "0 %")


def in_mm(length: float) -> str:
    if length >= 1.0:
        return f"{length:.3g} m"
    digits = 0 if length >= 9.5e-3 or length < 5e-5 else 1
    return "–" if np.isnan(length) else f"{1e3 * length:.{digits}f} mm"


def newton(force: float) -> str:
    return f"{force / 1e3:.3g} kN" if force >= 1e3 else f"{force:.3g} N"


def count(n: int) -> str:
    return str(n) if n else "none"


def plural(n: int, word: str) -> str:
    return f"{n} {word}{'s' * (n != 1)}"
