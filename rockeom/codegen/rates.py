"""Equations of motion: accelerations, rates of the states, and how fast a gap would open."""

from collections.abc import Collection

from rockeom.codegen.solve import solve
from rockeom.codegen.text import Text, branched
from rockeom.symbolic.hybrid import HybridModel
from rockeom.symbolic.mode import Mode


def equations_of_motion(text: Text) -> None:
    _accelerations(text)
    _rates(text)
    _opening_acceleration(text)


def each_mode(model: HybridModel) -> list[Mode]:
    """The declared modes that have accelerations of their own, in the order of their functions."""
    return [one for mode in model.modes for one in mode.of_each_state()]


def _accelerations(text: Text) -> None:
    """A function of plain numbers for each mode, and one that chooses the mode."""
    modes = each_mode(text.model)
    indent, chosen = " " * 8, []
    for i, mode in enumerate(modes):
        call = _accelerations_of(text, i, mode)
        chosen.append((text.test(mode), [*text.side(indent, mode), f"{indent}return {call}"]))
    text.function(
        f"accelerations(mode, {', '.join(text.states)}, p, {text.shaking})",
        f"Accelerations of the coordinates under ground accelerations {text.shaking} [m/s2].",
        branched(chosen, otherwise=True),
        "@inlined",
    )


def _accelerations_of(text: Text, number: int, mode: Mode) -> str:
    """Add the function of one mode; returns how it is called."""
    several = mode.has_side and len(mode.sides) > 2
    own = "" if several else "_".join(["accelerations", *mode.sides])
    name = text.function_name(own, f"accelerations_{number}")
    which = (
        f"of mode {number}"
        if several
        else f"in mode{'s' * (len(mode.sides) > 1)} {' or '.join(mode.sides)}"
    )
    out = [text.name(c.acceleration) for c in mode.coordinates]
    body = []
    if out:
        eq = mode.equations
        body = solve(
            text, "accelerations", eq.mass_matrix, eq.forcing, out, "    ", mode.gravity, False
        )
    accelerations = [
        text.name(c.acceleration) if c in mode.coordinates else "0.0"
        for c in text.model.coordinates
    ]
    side = "s, " if mode.has_side else ""
    call = f"{name}({side}{', '.join(text.states)}, p, {text.shaking})"
    text.function(
        call,
        f"Accelerations of the coordinates {which}.",
        [*body, f"    return ({', '.join(accelerations)},)"],
        "@inlined",
    )
    return call


def _rates(text: Text) -> None:
    """Rates of all states, on arrays."""

    def branch(mode: Mode, indent: str) -> list[str]:
        return [
            f"{indent}dy[{i}] = {f'y[{text.n + i}]' if c in mode.coordinates else '0.0'}"
            for i, c in enumerate(text.model.coordinates)
        ]

    text.by_mode(
        f"rates(mode, y, p, {text.shaking}, dy)",
        f"Rates of the states y (N,) under ground accelerations {text.shaking} [m/s2], "
        "into dy (N,).",
        branch,
        after=[
            found_accelerations(text, "    "),
            *(f"    dy[{text.n + i}] = found[{i}]" for i in range(text.n)),
        ],
    )


def _opening_acceleration(text: Text) -> None:
    """Second derivative of the gap that a rocking mode would open from rest."""
    rotation = text.model.rotation
    theta, theta_dot = text.index(rotation.position), text.index(rotation.velocity)
    text.function(
        f"opening_acceleration(mode, y, p, {text.shaking})",
        "Acceleration with which a mode's gap would open from closed and at rest.",
        [
            found_accelerations(text, "    ", zero=(theta, theta_dot)),
            f"    return SIDES[mode] * found[{theta}]",
        ],
        "@inlined",
    )


def found_accelerations(text: Text, indent: str, zero: Collection[int] = ()) -> str:
    """The line that finds the accelerations at y; the states numbered in `zero` are zero."""
    states = ("0.0" if i in zero else f"y[{i}]" for i in range(2 * text.n))
    return f"{indent}found = accelerations(mode, {', '.join(states)}, p, {text.shaking})"
