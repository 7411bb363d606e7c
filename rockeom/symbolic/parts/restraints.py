"""Attachments of a base that slides: anchors at its feet, straps to fixed points, and pushes."""

from collections.abc import Iterable
from typing import NamedTuple

import sympy as sp

from rockeom.symbolic.elements import Break, Pulse, Tie
from rockeom.symbolic.model import Parameter
from rockeom.symbolic.parts.superstructures import HALF_WIDTH, Place

_MEANINGS = {
    "stiffness": ("k", "N/m", "stiffness"),
    "slack_length": ("s", "m", "elongation at which it pulls"),
    "pretension": ("P", "N", "force where nothing has moved"),
    "strength": ("f_y", "N", "force at which it yields"),
    "hardening": ("H", "N/m", "hardening"),
    "x": ("x", "m", "place of its end on the structure, to the right of the base's middle"),
    "y": ("y", "m", "height of its end on the structure"),
    "to_x": ("X", "m", "place of its fixed end, to the right of the base's middle"),
    "to_y": ("Y", "m", "height of its fixed end"),
    "size": ("F", "N", "largest force, to the right"),
    "start": ("t", "s", "time at which it begins"),
    "duration": ("T", "s", "duration"),
}
PUSH = "push "
"""Beginning of the place of a push; its shape follows."""
_LIMIT_UNITS = {"force": "N", "extension": "m", "energy": "J"}


class Kind(NamedTuple):
    """Kind of a tie or a push in a derivation: its place, its name, and its possible states.

    breaks : the limit at which it breaks, or empty.
    """

    place: str
    name: str
    yields: bool
    breaks: str


class Attachments(NamedTuple):
    """Parameters and elements of ties and pushes."""

    parameters: tuple[Parameter, ...]
    elements: tuple[Tie | Pulse, ...]


def attachments(
    kinds: Iterable[tuple[str, str, bool, str]], place: Place, standing: Place
) -> Attachments:
    """Ties and pushes of these kinds, see `Kind`.

    place, standing : of points of the base as it moves, and as it stands.
    """
    parameters: list[Parameter] = []
    elements: list[Tie | Pulse] = []
    for kind in (Kind(*fields) for fields in kinds):
        own = _parameters(kind)
        parameters += own.values()
        p = {name: parameter.symbol for name, parameter in own.items()}
        of_push = kind.place.startswith(PUSH)
        elements.append(_push(kind, p, place) if of_push else _tie(kind, p, place, standing))
    return Attachments(tuple(parameters), tuple(elements))


def _parameters(kind: Kind) -> dict[str, Parameter]:
    if kind.place.startswith(PUSH):
        names = ["x", "y", "size", "start", "duration"]
    else:
        names = ["stiffness", "slack_length", "pretension"]
        names += ["strength", "hardening"] * kind.yields
        names += ["x", "y", "to_x", "to_y"] * (kind.place == "strap")
    rows = {name: _MEANINGS[name] for name in names}
    if kind.breaks:
        rows["limit"] = "L", _LIMIT_UNITS[kind.breaks], f"{kind.breaks} at which it breaks"
    tex = kind.name.replace("_", " ")
    return {
        name: Parameter(
            _symbol(f"{letter}_{{{tex}}}", name), f"{kind.name}_{name}", unit, f"{tex}: {meaning}"
        )
        for name, (letter, unit, meaning) in rows.items()
    }


def _symbol(letter: str, name: str) -> sp.Symbol:
    if name in ("x", "y", "to_x", "to_y", "size"):
        return sp.Symbol(letter, real=True)
    if name in ("slack_length", "pretension", "hardening", "start"):
        return sp.Symbol(letter, nonnegative=True)
    return sp.Symbol(letter, positive=True)


def _push(kind: Kind, p: dict[str, sp.Symbol], place: Place) -> Pulse:
    at = place((p["x"], p["y"]))
    shape = kind.place.removeprefix(PUSH)
    return Pulse(kind.name, at[0], p["size"], p["start"], p["duration"], shape, at)


def _tie(kind: Kind, p: dict[str, sp.Symbol], place: Place, standing: Place) -> Tie:
    if kind.place == "strap":
        end = p["x"], p["y"]
        to = p["to_x"], p["to_y"]
        elongation = _distance(place(end), to) - _distance(standing(end), to)
    else:
        side = -1 if kind.place == "anchor_left" else 1
        end = side * HALF_WIDTH.symbol, sp.S.Zero
        elongation = place(end)[1]
        to = place(end)[0], sp.S.Zero  # below the foot: it pulls down
    return Tie(
        kind.name, elongation, p["stiffness"], p.get("strength", sp.oo),
        p.get("hardening", sp.S.Zero), p["slack_length"], p["pretension"],
        Break(**{kind.breaks: p["limit"]}) if kind.breaks else None, place(end), to,
    )  # fmt: skip


def _distance(point: tuple[sp.Expr, sp.Expr], to: tuple[sp.Expr, sp.Expr]) -> sp.Expr:
    return sp.sqrt((point[0] - to[0]) ** 2 + (point[1] - to[1]) ** 2)
