"""The numbers of a case by their names, and the case with other numbers in their places.

`sensitivity` derives by them, and sweeps by names vary them. A name is that of the argument by
which the number was given: "half_width", "masses[0]", "support.stiffness", "amplitude", "r". The
part of the case in front of it, "structure.half_width", "motion.amplitude", tells apart those that
two parts have.
"""

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, fields, is_dataclass, replace
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np

from rockeom.integrator.schema import in_space
from rockeom.motion import GroundMotion
from rockeom.motion.formula import UNITS, formula_of
from rockeom.motion.recording import Recording
from rockeom.motion.scaling import target
from rockeom.numbers.checks import InputError, is_number, near
from rockeom.numbers.degrees import ANGLES, RADIANS, SUFFIX
from rockeom.numbers.functions import Compound, mathematics
from rockeom.simulation.case import Case
from rockeom.simulation.ground import MOTIONS
from rockeom.structures.base import Structure
from rockeom.structures.declared import DeclaredStructure
from rockeom.structures.impact_laws import AngularMomentum, EnergyRatio, Impulsive, VelocityRatio
from rockeom.structures.units import dimensioned, time_unit, with_unit

_Path = tuple[Any, ...]

PARTS = (
    "structure", "motion", "impact", "initial", "vertical", "mode", "ground_axes", "transverse",
)  # fmt: skip
"""Parts of a case that a sweep by names may vary as a whole."""

FACTORS = ("scale", "time_scale")
"""Factors of the acceleration and the time of a motion, or of all motions of a case."""

_IN_FULL = {f"{motion}.{name}" for motion in MOTIONS for name in (*FACTORS, "duration")}
"""Names that are never shortened: factors of motions, and the duration of the case."""


class Number(NamedTuple):
    """A number of a case: where it is, its value and unit.

    part : a field of the case, or "case". path : within what that was made of. value : None where
    the case has none yet and may be given one. smooth : whether derivatives are found by it.
    """

    part: str
    path: _Path
    value: float | None
    unit: str
    smooth: bool = True

    @property
    def factor(self) -> str:
        """Whether it is "scale" or "time_scale"; "" for neither."""
        of_motion = self.part in ("case", *MOTIONS)
        return str(self.path[0]) if of_motion and self.path[0] in FACTORS else ""


def numbers_of(case: Case) -> dict[str, Number]:
    """All numbers of a case by their names in full."""
    return {
        **of_structure(case.structure),
        **_of_motion("motion", case),
        **_of_law(case),
        **_of_start(case),
        **_of_motion("transverse", case),
        **_of_motion("vertical", case),
        **_of_time(case),
    }


def numbers_named(
    where: str, names: Sequence[str], numbers: Mapping[str, Number], structure: Structure
) -> list[Number]:
    """Some of the numbers, by names in full or, where one part alone has it, without the part.

    Raises ValueError for a name that is unknown or ambiguous, and for two names of one number;
    where : the argument that has them. structure : of the case.
    """
    found = [_named(where, name, numbers, structure) for name in names]
    places = [(number.part, number.path) for number in found]
    for name, place in zip(names, places, strict=True):
        if places.count(place) > 1:
            raise InputError(where, name).so("it is named twice, with and without its part")
    return found


def _named(where: str, name: str, numbers: Mapping[str, Number], structure: Structure) -> Number:
    if name in numbers:
        return numbers[name]
    of_parts = [full for full in numbers if _short(full) == name]
    if len(of_parts) == 1:
        return numbers[of_parts[0]]
    if of_parts:
        raise InputError(where, name).wrong(
            f"has {name!r}, a number of several parts of the case: name "
            f"{' or '.join(map(repr, of_parts))}"
        )
    shorts = [_short(full) for full in numbers]
    known = {
        short if shorts.count(short) == 1 else full: number.unit
        for (full, number), short in zip(numbers.items(), shorts, strict=True)
    }
    every = ", ".join(with_unit(name, unit) for name, unit in known.items())
    meant = _meant(name, known, structure)
    raise InputError(where, name).wrong(f"has {name!r}, which is unknown{meant}: there are {every}")


def _short(name: str) -> str:
    return name if name in _IN_FULL else name.partition(".")[2] or name


def _meant(name: str, names: Mapping[str, str], structure: Structure) -> str:
    if name.isidentifier() and is_number(getattr(structure, name, None)):
        return " (it follows from others: name those, or let a function make the case of it)"
    if f"initial {name}" in names:
        return f" (did you mean 'initial {name}'?)"
    if name in ("r", "e"):
        return (
            " (name 'restitution', which is the ratio e of the angular velocities, or give the "
            "case a law that has it, such as impact=rk.EnergyRatio(r=0.8))"
        )
    if name in UNITS and not names.keys() & {"amplitude", "acceleration", "velocity"}:
        return (
            " (pulses have it, such as GroundMotion.single_sine; of others, and of those that were "
            "changed after they were made, pga is the peak, scale and time_scale are factors)"
        )
    return near(name, names)


def with_numbers(case: Case, values: Iterable[tuple[Number, Any]]) -> Case:
    """The case with other numbers, such as duals or those of many cases at once."""
    of_parts: dict[str, dict[_Path, Any]] = {}
    for number, x in values:
        of_parts.setdefault(number.part, {})[number.path] = x
    own = of_parts.pop("case", {})
    changed: dict[str, Any] = {
        part: _CHANGED[part](getattr(case, part), of_part) for part, of_part in of_parts.items()
    }
    factors = _factors(changed.get("motion", case.motion), own)
    for name in MOTIONS if factors else ():
        if (motion := changed.get(name, getattr(case, name))) is not None:
            changed[name] = _changed_motion(motion, factors)
    start = {path[1]: x for path, x in own.items() if path[0] == "initial"}
    if start:
        changed["initial"] = {**(case.initial or {}), **start}
    changed |= {name: own[name,] for name in ("duration", "slope", "azimuth") if (name,) in own}
    return replace(case, **changed)


@dataclass(frozen=True)
class OtherCase:
    """The function of a sweep by names: a case with other numbers, and other parts, in it."""

    case: Case
    names: tuple[str, ...]

    @cached_property
    def numbers(self) -> dict[str, Number]:
        """The number of each name; raises ValueError as `numbers_named` does.

        A name in degrees is that of an angle, whose unit is degrees then.
        """
        names = [name for name in self.names if name not in PARTS]
        plain = [name.removesuffix(SUFFIX) for name in names]
        every = numbers_of(self.case)
        numbers = dict(
            zip(names, numbers_named("over", plain, every, self.case.structure), strict=True)
        )
        for name in (name for name in names if name.endswith(SUFFIX)):
            if numbers[name].unit not in ANGLES:
                numbers_named("over", [name], every, self.case.structure)
            numbers[name] = numbers[name]._replace(unit=ANGLES[numbers[name].unit])
        return numbers

    def __call__(self, **values: Any) -> Case:
        parts = {name: x for name, x in values.items() if name in PARTS}
        motion = parts.get("motion")
        if isinstance(motion, Recording):  # which is both motions
            parts = {"vertical": None, "transverse": None} | parts
        elif motion is not None and self.case.transverse is not None and "transverse" not in parts:
            raise InputError("over", "motion").so(
                "the transverse one of the case would join it: give MotionSet.recordings()"
            )
        case = replace(self.case, **parts) if parts else self.case
        changes = ((n, values[name], name.endswith(SUFFIX)) for name, n in self.numbers.items())
        return with_numbers(case, [(n, x * RADIANS if degrees else x) for n, x, degrees in changes])


def function_of(case: Case | Callable[..., Case], names: Sequence[str]) -> Callable[..., Case]:
    """A function of a sweep as it is, or that of the names of a case's numbers."""
    return OtherCase(case, tuple(names)) if isinstance(case, Case) else case


# -- the numbers of each part


def of_structure(structure: Structure) -> dict[str, Number]:
    """Numbers that a structure was made of, by their names in full."""
    module = structure.module
    signs = dict(zip(module.PARAMETERS, module.PARAMETER_SIGNS, strict=True))
    units = dict(zip(module.PARAMETERS, module.PARAMETER_UNITS, strict=True))
    made, of_name = _made_of(structure), {}
    for name, path, value in _numbers(made):
        parameter, smooth = structure.parameter_at(path), signs.get(name) != "n"
        if not parameter and len(path) == 1:
            continue  # such as `full_height` of a block, which no equation has
        unit = units.get(parameter, "")
        of_name[f"structure.{name}"] = Number("structure", path, value, unit, smooth)
    for name in (name for name, value in made.items() if value is None):
        if parameter := structure.parameter_at((name,)):  # which follows from others
            of_name[f"structure.{name}"] = Number("structure", (name,), None, units[parameter])
    return of_name


def _of_motion(part: str, case: Case) -> dict[str, Number]:
    motion: GroundMotion | None = getattr(case, part)
    if motion is None:
        return {}
    formula = formula_of(motion)
    values = dict(formula.numbers) if formula else {}
    values |= dict.fromkeys(FACTORS, 1.0)
    units = dimensioned(case.structure.module, {n: UNITS.get(n, "-") for n in values})
    return {f"{part}.{n}": Number(part, (n,), x, units[n]) for n, x in values.items()}


def _of_law(case: Case) -> dict[str, Number]:
    law: Any = case.impact
    of_name = {}
    for name, path, value in _numbers(_made_of(law)) if is_dataclass(law) else ():
        if name != "seed":
            unit = "-" if len(path) == 1 and name != "height" else ""
            of_name[f"impact.{name}"] = Number("impact", path, value, unit)
    if not case.structure.has_impacts:
        return of_name
    ratio = law.e if isinstance(law, VelocityRatio) else None
    if isinstance(law, EnergyRatio) and law.r is not None:
        ratio = float(mathematics.sqrt(law.r))
    if ratio is not None or law is None or isinstance(law, AngularMomentum | Impulsive):
        of_name["impact.restitution"] = Number("impact", ("restitution",), ratio, "-")
    return of_name


def _of_start(case: Case) -> dict[str, Number]:
    structure, initial = case.structure, dict(case.initial or {})
    rest = None if structure.has_landings else 0.0  # heights follow from what is named
    values = {name: initial.get(name, rest) for name in structure.states}
    units = dict(zip(structure.states, structure.module.STATE_UNITS, strict=True))
    return {
        f"initial {name}": Number("case", ("initial", name), value, units[name])
        for name, value in values.items()
    }


def _of_time(case: Case) -> dict[str, Number]:
    duration = case.motion.duration if case.duration is None else case.duration
    unit = time_unit(case.structure.module)
    acceleration = dimensioned(case.structure.module, {"pga": "m/s2"})["pga"]
    azimuth = Number("case", ("azimuth",), case.azimuth, "rad")
    return {
        **{f"case.{name}": Number("case", (name,), 1.0, "-") for name in FACTORS},
        "case.pga": Number("case", ("pga",), case.motion.peak, acceleration, smooth=False),
        "case.duration": Number("case", ("duration",), float(duration), unit),
        "case.slope": Number("case", ("slope",), case.slope, "rad"),
        **({"case.azimuth": azimuth} if in_space(case.structure.module) else {}),
    }


# -- a number within what a part was made of


def _made_of(x: Any) -> dict[str, Any]:
    """The arguments of a structure, a support or a law, by name."""
    if isinstance(x, DeclaredStructure):
        return x.parameters()
    return {field.name: getattr(x, field.name) for field in fields(x)}


def _numbers(values: Mapping[str, Any]) -> Iterator[tuple[str, _Path, Any]]:
    """(name, path, value) of each number in values, in lists and in supports among them."""
    for name, value in values.items():
        yield from _numbers_at(name, (name,), value)


def _numbers_at(name: str, path: _Path, value: Any) -> Iterator[tuple[str, _Path, Any]]:
    if is_number(value) and np.isfinite(value):
        yield name, path, value if isinstance(value, Compound) else float(value)
    elif isinstance(value, tuple | list):
        for i, item in enumerate(value):
            yield from _numbers_at(f"{name}[{i}]", (*path, i), item)
    elif is_dataclass(value) and not isinstance(value, type):
        for field, item in _made_of(value).items():
            if not isinstance(item, int):  # how many there are of something
                yield from _numbers_at(f"{name}.{field}", (*path, field), item)


def _changed(value: Any, places: Mapping[_Path, Any]) -> Any:
    """The same, made again with other numbers at some paths within it."""
    if () in places:
        return places[()]
    inside: dict[Any, dict[_Path, Any]] = {}
    for (first, *rest), x in places.items():
        inside.setdefault(first, {})[tuple(rest)] = x
    if isinstance(value, tuple | list):
        return tuple(_changed(x, inside[i]) if i in inside else x for i, x in enumerate(value))
    made = _made_of(value)
    return type(value)(**{**made, **{n: _changed(made[n], of) for n, of in inside.items()}})


def _changed_motion(motion: GroundMotion, places: Mapping[_Path, Any]) -> GroundMotion:
    numbers = {name: x for (name,), x in places.items()}
    scale, time = (numbers.pop(name, 1.0) for name in FACTORS)
    if numbers:
        formula = formula_of(motion)
        assert formula is not None, f"{motion!r} has no formula"
        motion = formula.with_numbers(numbers)
    return motion.scaled(scale, time) if {*places} & {("scale",), ("time_scale",)} else motion


def _factors(motion: GroundMotion, own: Mapping[_Path, Any]) -> dict[_Path, Any]:
    """The factors of all motions, of which "pga" makes one for the peak of the horizontal one."""
    factors = {(name,): own[name,] for name in FACTORS if (name,) in own}
    if ("pga",) in own:
        if ("scale",) in factors:
            raise InputError("over", "scale").so("pga is the same factor: name one of both")
        if motion.peak == 0.0:
            raise InputError("over", "pga").says("no factor makes a motion without shaking shake")
        factors["scale",] = target(None, own["pga",], None, None).value / motion.peak
    return factors


def _changed_law(law: Any, places: Mapping[_Path, Any]) -> Any:
    if ("restitution",) not in places:
        return _changed(law, places)
    if len(places) > 1:
        raise InputError("over", "restitution").so("the law has it: name one of both")
    return VelocityRatio(places["restitution",])


_CHANGED = {
    "structure": _changed,
    **dict.fromkeys(MOTIONS, _changed_motion),
    "impact": _changed_law,
}
