"""Structures whose classes are made of declarations: shipped ones, and those that users declare."""

import dataclasses
import functools
import math
from collections.abc import Mapping
from dataclasses import dataclass
from inspect import signature
from typing import Any, ClassVar, dataclass_transform

import numpy as np

from rockeom.integrator.schema import GeneratedModule
from rockeom.motion.units import STANDARD_GRAVITY
from rockeom.numbers import explained
from rockeom.numbers.checks import InputError, InputTypeError, number
from rockeom.numbers.degrees import in_radians, named_in_degrees
from rockeom.numbers.dual import directions
from rockeom.structures.base import Structure, generated_module, missing
from rockeom.structures.parameters import check_named, check_names, check_slenderness, check_values


@dataclass_transform(kw_only_default=True, frozen_default=True)
class StructureWithFields(Structure):
    """A structure whose class has a field for each argument: shipped ones and families.

    Each subclass becomes a frozen dataclass by keyword whose constructor explains what is wrong.
    """

    may_vanish: ClassVar[frozenset[str]] = frozenset()
    may_be_negative: ClassVar[frozenset[str]] = frozenset()
    not_numbers: ClassVar[frozenset[str]] = frozenset()
    arguments: ClassVar[Mapping[str, str]] = {}
    """Arguments of parameters that have another name in the equations."""
    whole: ClassVar[frozenset[str]] = frozenset()
    """Numbers of equal things."""
    sizes_checked: ClassVar[bool] = False
    """Whether arguments of the right signs may give a body or a base no size."""

    __dataclass_fields__: ClassVar[dict[str, dataclasses.Field[Any]]]
    _defaults: ClassVar[dict[str, Any]] = {}
    _required: ClassVar[frozenset[str]] = frozenset()
    """`defaults` and those of its names that have none, looked up once: structures are many."""

    def __init_subclass__(cls, **options: Any) -> None:
        super().__init_subclass__(**options)
        explained.calls()(cls)  # of closed forms and other constructors
        declarations = (base.__doc__ for base in cls.__mro__ if "model" in vars(base))
        cls.__doc__ = cls.__doc__ or next(declarations, None)
        if len(cls.__bases__) > 1 or vars(cls).get("__annotations__"):
            cls._become_dataclass()
        # else closed forms of a declared structure, whose fields are those of its base

    @classmethod
    def _become_dataclass(cls) -> None:
        """A field for each argument, and a constructor that checks what it is given."""
        dataclass(frozen=True, kw_only=True, repr=False, eq=False)(cls)
        cls._defaults = cls.defaults()
        missing = dataclasses.MISSING
        cls._required = frozenset(n for n, default in cls._defaults.items() if default is missing)
        plain: Any = cls.__init__

        @functools.wraps(plain)
        def init(self: StructureWithFields, *unnamed: Any, **values: Any) -> None:
            kind = type(self)  # this class, or one of its closed forms
            if named_in_degrees(values):
                values = in_radians(kind.__name__, values, kind.units())
            values = kind.complete(values)
            kind._check_names(unnamed, values)
            kind._check_numbers(values)
            plain(self, **values)

        setattr(cls, "__init__", init)  # noqa: B010
        explained.refuse_assignments(cls)

    @classmethod
    def _check_names(cls, unnamed: tuple[Any, ...], values: Mapping[str, Any]) -> None:
        """Raise TypeError for arguments without a name, missing ones and unknown ones."""
        if unnamed or not cls._required <= values.keys() <= cls._defaults.keys():
            check_named(cls.__name__, unnamed, cls._defaults, cls.__doc__)
            required = [name for name in cls._defaults if name in cls._required]
            explain = cls.__doc__, cls._taker_of
            check_names(cls.__name__, required, cls._defaults, values, *explain)

    @classmethod
    def _check_numbers(cls, values: Mapping[str, Any]) -> None:
        """Raise TypeError or ValueError for what is no number, of the wrong sign, or not whole."""
        unset = {n for n, v in values.items() if v is None and cls._defaults[n] is None}
        numbers = {n: v for n, v in values.items() if n not in cls.not_numbers | unset}
        check_values(cls.__name__, numbers, cls.may_vanish, cls.may_be_negative)
        if "alpha" in numbers:
            check_slenderness(cls.__name__, numbers["alpha"])
        for name in cls.whole & set(values):
            check_whole(cls.__name__, name, values[name])

    # dataclass would write these into each class, and a process would start later

    def __repr__(self) -> str:
        values = (f"{f.name}={getattr(self, f.name)!r}" for f in dataclasses.fields(self))
        return f"{type(self).__qualname__}({', '.join(values)})"

    def __eq__(self, other: object) -> bool:
        if type(other) is not type(self):
            return NotImplemented
        return self._field_values() == other._field_values()

    def __hash__(self) -> int:
        return hash(self._field_values())

    def _field_values(self) -> tuple[Any, ...]:
        return tuple(getattr(self, f.name) for f in dataclasses.fields(self))

    def __post_init__(self) -> None:
        if self.sizes_checked:
            check_sizes(self)

    @classmethod
    def units(cls) -> dict[str, str]:
        """Units of the arguments.

        Returns
        -------
        dict of str to str
            Units by name.
        """
        try:
            m = generated_module(cls.model)
        except ModuleNotFoundError:  # of a family, whose arguments are no angles
            return {}
        rows = zip(m.PARAMETERS, m.PARAMETER_UNITS, strict=True)
        return {cls.arguments.get(name, name): unit for name, unit in rows}

    @classmethod
    def _taker_of(cls, name: str) -> str:
        """Another constructor or structure that takes an argument, in words; "" where none does."""
        if name in ("restraint", "loads"):
            return " (rk.HeldBlock and rk.Facade take it, and structures on rk.Sliding feet)"
        takers = [
            other
            for other in dir(cls)
            if other.startswith("from_") and name in signature(getattr(cls, other)).parameters
        ]
        return f" ({cls.__name__}.{takers[0]} takes it)" if takers else ""

    @classmethod
    def complete(cls, values: dict[str, Any]) -> dict[str, Any]:
        """Arguments of the fields, by those of the constructor.

        Parameters
        ----------
        values : dict of str to object
            Arguments of the constructor by name.

        Returns
        -------
        dict of str to object
            Arguments of the fields by name.
        """
        return values

    def parameters(self) -> dict[str, float]:
        named = self.arguments
        return {name: getattr(self, named.get(name, name)) for name in self.module.PARAMETERS}

    def parameter_at(self, path: tuple[Any, ...]) -> str:
        names = {argument: name for name, argument in self.arguments.items()}
        return super().parameter_at((names.get(path[0], path[0]), *path[1:]))


class DeclaredStructure(Structure):
    """A structure whose class is made of its generated module; see `class_of`.

    Its parameters, whatever they are called, are those of the model; none has a default but
    gravity. Those whose name is no other's are attributes.
    """

    module: GeneratedModule  # of the class
    declaration: Any = None  # of the class, where it was declared in this process
    slenderness = None  # a parameter `alpha` may be anything

    def __init__(self, /, *unnamed: Any, **given: Any) -> None:
        known, doc = self.module.PARAMETERS, type(self).__doc__
        if named_in_degrees(given):
            rows = zip(self.module.PARAMETERS, self.module.PARAMETER_UNITS, strict=True)
            given = in_radians(self.model, given, dict(rows))
        check_named(self.model, unnamed, known, doc)
        defaults = {n: v for n, v in self.defaults().items() if v is not dataclasses.MISSING}
        check_names(self.model, known, known, defaults | given, doc)
        values = {
            name: number(name, value, self.model, "a number in SI units")
            for name, value in (defaults | given).items()
        }
        signs = dict(zip(self.module.PARAMETERS, self.module.PARAMETER_SIGNS, strict=True))
        signed = frozenset(name for name, sign in signs.items() if sign == "+-")
        # the products of a declaration are not known
        check_values(self.model, values, frozenset(known), signed, largest=math.inf)
        for name in (name for name, sign in signs.items() if sign == "n"):
            check_whole(self.model, name, values[name])
        self.values = {name: values[name] for name in self.module.PARAMETERS}
        check_sizes(self)

    @classmethod
    def defaults(cls) -> dict[str, Any]:
        return {
            name: STANDARD_GRAVITY if name == "gravity" else dataclasses.MISSING
            for name in vars(cls)["module"].PARAMETERS
        }

    def parameters(self) -> dict[str, float]:
        return dict(self.values)

    def __getattr__(self, name: str) -> Any:
        if name in (values := vars(self).get("values", {})):
            return values[name]
        return missing(self, name)

    def __repr__(self) -> str:
        return f"{type(self).__name__}({', '.join(f'{n}={v!r}' for n, v in self.values.items())})"

    def __eq__(self, other: object) -> bool:
        return type(other) is type(self) and vars(other)["values"] == self.values

    def __hash__(self) -> int:
        return hash((type(self), *self.values.values()))


def check_whole(what: str, name: str, value: Any) -> None:
    """Raise TypeError or ValueError for a number of equal things that is not whole."""
    if directions(value):
        raise InputTypeError(name, of=what).wrong("is a dual: whole numbers have no derivative")
    if not (value >= 1 and value % 1 == 0):
        raise InputError(name, value, what).give("a whole number of at least 1")


def check_sizes(structure: Structure) -> None:
    """Raise ValueError where the parameters give a body or a base no size."""
    rows, values = structure.module.SIZES, structure.parameters()
    parameters = np.array([values[name] for name in structure.module.PARAMETERS])
    sizes = np.empty(len(rows), parameters.dtype)
    structure.module_for(parameters).sizes(parameters, sizes)
    for size, (what, may_vanish, names, remedy) in zip(sizes, rows, strict=True):
        if not (size > 0 or (size == 0 and may_vanish)):
            given = ", ".join(f"{name} = {values[name]}" for name in names)
            raise ValueError(f"{structure.model}: {what} is {float(size):g} with {given}: {remedy}")


@functools.cache
def class_of(module: Any) -> type[DeclaredStructure]:
    """The class of the structures of a generated module."""
    rows = zip(module.PARAMETERS, module.PARAMETER_UNITS, module.PARAMETER_MEANINGS, strict=True)
    title = (module.__doc__ or "").partition("\n")[0]
    described = "\n".join(f"{name} : float\n    {meaning} [{unit}]" for name, unit, meaning in rows)
    return type(
        module.CLASS,
        (DeclaredStructure,),
        {
            "__doc__": f"{title}\n\nParameters\n----------\n{described}\n",
            "__module__": __name__,
            "model": module.NAME,
            "module": module,
        },
    )
