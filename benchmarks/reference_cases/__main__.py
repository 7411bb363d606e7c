"""Compute every answer twice, and write reference-cases.json; see the package's docstring.

`python -m benchmarks.reference_cases` takes some ten minutes; with names of cases it prints them
and writes nothing.
"""

import json
import sys
import time
from collections.abc import Mapping

from mpmath import mp, mpf

import rockeom as rk
from benchmarks.reference_cases import FILE, independent, with_rockeom
from benchmarks.reference_cases.declared import CASES, Case, unit_of
from benchmarks.reference_cases.newton_euler import Solver

STEP = "0.005"  # s
PERTURBATION = "1e-12"
INSENSITIVE = 1000.0
"""A relative change of 1e-12 of a parameter changes the answer by less than 1e-9."""
MOST_DIGITS = 15
FIRM_DIGITS = 18

CONVENTIONS = {
    "axes": "x to the right, z up, in the frame of the ground; rotations are positive clockwise",
    "bodies": "rectangles; x, z [m] and velocity [m/s, m/s, rad/s] are those of the centroid, at "
    "t = 0; inertia [kg m2] is about the centroid",
    "contacts": "the corners of the first body against the ground z = 0, or against the faces of "
    "the second body. friction: Coulomb's coefficient, null where it is large enough to exclude "
    "slip, for which 1 is enough in all cases. restitution: rate of a corner's gap after over "
    "before an impact, at each corner that lands (Newton); a corner that was closed opens in it, "
    "or stays closed, as the impulses ask for",
    "ground_motion": "acceleration of the ground a(t) [m/s2], positive to the right: in its frame "
    "a force -mass a(t) acts on each body",
    "springs": "linear, without mass or damping; where tension is false they press alone. Between "
    "a point of a body (from its centroid, in its axes) and the ground they are upright and free "
    "of force at z = 0",
    "digits": "significant digits of value on which rockeom and the independent derivation agree, "
    "15 at most",
    "sensitivity": "relative change of an answer over the relative change of a parameter, for the "
    "parameter that matters most",
    "measure": "how to read an answer from a motion in samples. rate_before_zero: angular "
    "velocity just before the n-th time that the rotation passes through zero; "
    "landing: the n-th time that the body is pushed up after it fell freely; peak: the first "
    "largest rotation to a side; lowest: how far the centroid comes below a height",
}


def parameters(case: Case) -> dict[str, mpf]:
    """As they are written: decimals, not the doubles next to them."""
    return {name: mpf(repr(value)) for name, value in case.parameters.items()}


def independently(
    case: Case, digits: int, values: Mapping[str, mpf] | None = None, step: str = STEP
) -> dict:
    """The answers in arithmetic of so many digits, by steps of no more than `step` [s]."""
    with mp.workdps(digits):
        values = values or parameters(case)
        return getattr(independent, case.function)(values, Solver(mpf(step), digits - 7))


def by_rockeom(case: Case) -> dict[str, float]:
    return getattr(with_rockeom, case.function)(case.parameters)


def agreed(a: mpf | float, b: mpf) -> int:
    """Significant digits on which two numbers agree."""
    apart = abs((a - b) / b)
    return MOST_DIGITS + 9 if apart == 0 else int(mp.floor(-mp.log10(apart)))


def sensitivities(case: Case) -> dict[str, float]:
    """By quantity: the largest relative change over that of a parameter."""
    digits, small = 25, mpf(PERTURBATION)
    with mp.workdps(digits):
        known, largest = independently(case, digits), {}
        for name, value in parameters(case).items():
            if value == 0:
                continue
            moved = independently(case, digits, {**parameters(case), name: value * (1 + small)})
            for key, answer in moved.items():
                change = float(abs(answer / known[key] - 1) / small)
                largest[key] = max(largest.get(key, 0.0), change)
    return largest


def answers(case: Case) -> list[dict]:
    """The quantities of a case by both derivations; raises ArithmeticError if one is in doubt."""
    mp.dps = 40
    ours, firm, check = by_rockeom(case), independently(case, 40), independently(case, 30)
    changes = sensitivities(case)
    rows = []
    for quantity in case.quantities:
        value = firm[quantity.name]
        sure = agreed(check[quantity.name], value)
        if sure < FIRM_DIGITS:
            raise ArithmeticError(f"{case.id}, {quantity.name}: {sure} digits without rockeom")
        digits = min(agreed(ours[quantity.name], value), MOST_DIGITS)
        rows.append(
            {
                "name": quantity.name,
                "unit": quantity.unit,
                "meaning": quantity.meaning,
                "value": float(mp.nstr(value, digits)),
                "digits": digits,
                "independent": mp.nstr(value, FIRM_DIGITS, strip_zeros=False),
                "rockeom": ours[quantity.name],
                "sensitivity": float(f"{changes[quantity.name]:.3g}"),
                "measure": dict(quantity.measure) if quantity.measure else None,
            }
        )
    return rows


def described(case: Case) -> dict:
    """A case as it is published."""
    quantities = answers(case)
    return {
        "id": case.id,
        "title": case.title,
        "description": case.description,
        "parameters": {
            name: {"value": value, "unit": unit_of(name)} for name, value in case.parameters.items()
        },
        "model": case.model(case.parameters),
        "duration": case.duration,
        "derivation": case.derivation,
        "closed_form": case.closed,
        "sensitive": max(q["sensitivity"] for q in quantities) >= INSENSITIVE,
        "quantities": quantities,
    }


def main() -> None:
    chosen = [case for case in CASES if not sys.argv[1:] or case.id in sys.argv[1:]]
    cases = []
    for case in chosen:
        started = time.perf_counter()
        cases.append(described(case))
        worst = min(q["digits"] for q in cases[-1]["quantities"])
        most = max(q["sensitivity"] for q in cases[-1]["quantities"])
        print(
            f"{case.id}: {worst} digits, sensitivity {most:.3g}, "
            f"{time.perf_counter() - started:.0f} s",
            flush=True,
        )
    if sys.argv[1:]:
        return
    whole = {
        "$schema": "schema.json",
        "title": "Reference motions of bodies in contact",
        "version": 1,
        "source": f"rockeom {rk.__version__}",
        "licence": "BSD-3-Clause",
        "conventions": CONVENTIONS,
        "cases": cases,
    }
    FILE.write_text(json.dumps(whole, indent=1) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
