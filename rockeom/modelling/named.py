"""Structures by the names of their models: shipped ones, families, and what they stand on.

A family is declared for each set of its arguments, such as a shear frame for each number of
storeys. Supports have names, too; their parameters are then given with those of the
structure, `foundation_stiffness` and `foundation_damping` for those of a spring:

    structure("flexible_structure", mass=..., support="winkler", springs=4, ...)
"""

import dataclasses
from collections.abc import Mapping
from importlib import import_module
from typing import Any

from rockeom.modelling.composed import Pinned, ShearFrame, Sliding, TwoSprings, Winkler
from rockeom.modelling.declared import class_of_model
from rockeom.numbers import explained
from rockeom.numbers.checks import InputError, InputTypeError, described, near
from rockeom.structures.base import Structure
from rockeom.structures.classes import SHIPPED
from rockeom.structures.supports import Support

FAMILIES: Mapping[str, type[Structure]] = {"shear_frame": ShearFrame}
IN_SPACE: Mapping[str, str] = {
    "prism": "standing.Prism",
    "wobbling_column": "wobbling.WobblingColumn",
    "podium": "wobbling.Podium",
}
"""Structures in space whose arguments are numbers, each by the home of its class."""
SUPPORTS: Mapping[str, type[Support]] = {
    support.kind: support for support in (Pinned, TwoSprings, Winkler, Sliding)
}


@explained.calls()
def structure(model: Any, /, **parameters: Any) -> Structure:
    """Structure of a model: the name of one, or a RockingModel or Model that you declared.

    Parameters
    ----------
    model : str or RockingModel or Model
        Name of a shipped structure or of a family, as ``rockeom models`` lists them; or a model of
        your own.
    **parameters : object
        Parameters of the model, in SI units, and its support: an object, such as
        ``rk.Winkler(...)``, or its name, "two_springs", "winkler" or "sliding", with its parameters
        among the others: foundation_stiffness and foundation_damping of each spring, guided,
        springs, friction, restitution, law.

    Returns
    -------
    Structure
        Structure with these parameters.

    Raises
    ------
    InputTypeError
        For missing or unknown parameters.
    ValueError
        For values that are not finite or negative, for a model that cannot be simulated, and where
        the values give a body a negative mass or a base a negative width.

    Notes
    -----
    A declared model, and one of a family, is derived and compiled at its first use (some seconds,
    once on a machine: the user's cache keeps both).

    Examples
    --------
    >>> import rockeom as rk
    >>> block = rk.structure("rigid_block", half_width=0.1, half_height=0.4)  # m
    >>> block == rk.RigidBlock(half_width=0.1, half_height=0.4)
    True
    >>> frame = rk.structure(
    ...     "shear_frame", masses=[20e3, 20e3], heights=[3.5, 7.0], stiffnesses=[20e6, 20e6],
    ...     dampings=[120e3, 120e3], half_width=1.2, base_mass=10e3, support="winkler", springs=4,
    ...     foundation_stiffness=1e8, foundation_damping=1e5, base_inertia=5e3,
    ... )
    >>> frame.support.springs
    4
    """
    if isinstance(model, str):
        made = class_named(model)
        return made(**_supported(made, parameters))
    if not hasattr(model, "check_values"):
        raise InputTypeError("model", model).says(
            "structure() takes the name of a structure, or a RockingModel or Model, not "
            f"{described(model)}"
        )
    return class_of_model(model)(**parameters)


def class_named(name: str) -> type[Structure]:
    """The class of a shipped structure, of a family, or in space.

    Raises ValueError, naming all of them, if there is none of that name.
    """
    for classes in (SHIPPED, FAMILIES):
        if name in classes:
            return classes[name]
    if name in IN_SPACE:
        home, made = IN_SPACE[name].split(".")
        return getattr(import_module(f"rockeom.modelling.{home}"), made)
    every = (*SHIPPED, *FAMILIES, *IN_SPACE)
    raise InputError("name", name).says(
        f"no structure named {name!r}{near(name, every)}: there are {', '.join(every)}"
    )


def takes_support(made: type[Structure]) -> bool:
    return "support" in made.defaults()


def parameters_of(support: str) -> dict[str, Any]:
    """Defaults of a support's parameters by name, `dataclasses.MISSING` where there is none."""
    made = SUPPORTS[support]
    fields = dataclasses.fields(made)  # type: ignore[arg-type]
    return {made.called.get(field.name, field.name): field.default for field in fields}


def _supported(made: type[Structure], parameters: Mapping[str, Any]) -> dict[str, Any]:
    """The parameters, a support that is named made of those that are its own."""
    arguments = dict(parameters)
    if not takes_support(made):
        return arguments
    every = {name for support in SUPPORTS for name in parameters_of(support)}
    beside = [name for name in arguments if name in every - made.defaults().keys()]
    support = arguments.get("support")
    if not isinstance(support, str):
        if beside:
            raise InputTypeError("support", of=made.__name__).says(
                f'{beside[0]} is a parameter of a support: name that, as in support="'
                f'{_that_takes(beside)}"'
            )
        return arguments
    if support not in SUPPORTS:
        raise InputError("support", support, made.__name__).wrong(
            f"is {support!r}{near(support, SUPPORTS)}; there are {', '.join(SUPPORTS)}"
        )
    own = parameters_of(support)
    missing = [
        n for n, default in own.items() if default is dataclasses.MISSING and n not in arguments
    ]
    wrong = [f"missing {', '.join(missing)}"] if missing else []
    wrong += [f"unknown {name}{near(name, own)}" for name in beside if name not in own]
    if wrong:
        raise InputTypeError("support", support).says(
            f"{made.__name__} on the support {support!r}: {'; '.join(wrong)}. Besides its own "
            f"parameters it takes {', '.join(own) or 'none'}"
        )
    plain = {called: name for name, called in SUPPORTS[support].called.items()}
    values = {plain.get(name, name): arguments.pop(name) for name in own if name in arguments}
    arguments["support"] = SUPPORTS[support](**values)
    return arguments


def _that_takes(names: list[str]) -> str:
    """The support that takes most of these parameters."""
    return max(SUPPORTS, key=lambda support: sum(n in parameters_of(support) for n in names))
