"""Small models whose events are known in closed form, declared as a user would."""

import functools
import itertools

import sympy as sp

import rockeom as rk
from rockeom.structures.declared import class_of
from rockeom.symbolic.mode import Mode, Transition
from rockeom.symbolic.model import Body, coordinate, parameter
from rockeom.symbolic.rocking import RockingModel

HEIGHT = coordinate("x", "x", "m", "height of the point")
FLAGS = ("neither", "first", "second", "both_flags")
CHAIN = ("one", "two", "three", "four", "five", "six")


@functools.cache
def clock() -> RockingModel:
    """A point thrown upwards, x = x_0 + v t - g t^2/2: every event is a root of a polynomial.

    Modes only mark what has happened; the motion goes on through all of them.

    - "outside"/"inside": the wave (x - a)(x - b)(x - c) has fallen through zero, and rises again;
    - "neither", "first", "second", "both_flags": x has passed a, b, or both, in any order, the
      passage of a declared first; "later neither" ...: that of b declared first;
    - "one" to "six": five marks in a row, `spacing` apart from a on;
    - "ping", "pong": each leads to the other at once, for ever.

    `edge` makes the potential -m sqrt(1 - edge x): no motion exists beyond x = 1/edge.
    """
    x = HEIGHT.position
    m, g, a, b, c, spacing, edge = parameters = [
        parameter(symbol, name, unit, meaning)
        for symbol, name, unit, meaning in (
            ("m", "mass", "kg", "mass"),
            ("g", "gravity", "m/s2", "acceleration of gravity"),
            ("a", "a", "m", "first mark"),
            ("b", "b", "m", "second mark"),
            ("c", "c", "m", "third mark"),
            ("d", "spacing", "m", "distance of the marks of the chain"),
            ("w", "edge", "1/m", "inverse of the height at which the potential ends"),
        )
    ]
    wave = (x - a.symbol) * (x - b.symbol) * (x - c.symbol)
    passes = {"first": a.symbol - x, "second": b.symbol - x}

    def flags(prefix: str, order: tuple[str, str]) -> list[Transition]:
        other = {"first": "second", "second": "first"}
        return [
            *(Transition(f"{prefix}neither", prefix + f, "switch", passes[f]) for f in order),
            *(
                Transition(prefix + f, f"{prefix}both_flags", "switch", passes[other[f]])
                for f in order
            ),
        ]

    transitions = [
        Transition("outside", "inside", "switch", wave),
        Transition("inside", "outside", "switch", -wave),
        *flags("", ("first", "second")),
        *flags("later_", ("second", "first")),
        *(
            Transition(before, after, "switch", a.symbol + n * spacing.symbol - x)
            for n, (before, after) in enumerate(itertools.pairwise(CHAIN))
        ),
        Transition("ping", "pong", "switch", -1 - x**2),
        Transition("pong", "ping", "switch", -1 - x**2),
    ]
    names = [
        "left",
        "right",
        *dict.fromkeys(n for t in transitions for n in (t.source, t.target)),
    ]
    modes = (
        Mode(
            {name: 0},
            (HEIGHT,),
            (Body("point", m.symbol, (sp.Integer(0), x)),),
            g.symbol,
            load_point=(sp.Integer(0), x),
            elastic_energy=-m.symbol * sp.sqrt(1 - edge.symbol * x),
        )
        for name in names
    )
    return RockingModel(
        name="clock",
        title="A thrown point that passes marks",
        parameters=tuple(parameters),
        coordinates=(HEIGHT,),
        modes=tuple(modes),
        transitions=tuple(transitions),
        rotation=HEIGHT,
        overturning=sp.Integer(10) ** 9,
    )


MARKS = ("a", "b", "c", "spacing", "edge")


@functools.cache
def _module():
    """The generated module, derived once."""
    return rk.structure(clock(), mass=1.0, gravity=0.0, **dict.fromkeys(MARKS, 0.0)).module


def point(**parameters):
    """A structure of the clock's kind; mass 1, and all else zero if not given."""
    defaults = {"mass": 1.0, "gravity": 0.0} | dict.fromkeys(MARKS, 0.0)
    return class_of(_module())(**defaults | parameters)


def thrown(mode, *, speed=1.0, start=0.0, duration=1000.0, options=None, **parameters):
    """Response of the clock; with gravity zero x = start + speed t."""
    return rk.simulate(
        point(**parameters),
        rk.GroundMotion.none(duration),
        initial={"x": start, "x_dot": speed},
        mode=mode,
        options=options,
    )
