"""What a transition changes: impact maps, and the jump from the state before to that after."""

from __future__ import annotations

from rockeom.codegen.guards import outgoing
from rockeom.codegen.solve import solve
from rockeom.codegen.text import Text
from rockeom.symbolic.algebra import SIDE
from rockeom.symbolic.impulse import ImpulseMap
from rockeom.symbolic.model import RockingModel, Transition

ImpulseNames = dict[tuple[str, str], str]
"""Name of the function of an impact map, by the contact states before and after."""


def impulsive(model: RockingModel) -> bool:
    """Whether the impulsive form of Lagrange's equations gives the rates after an impact."""
    return model.has_impacts and model.rigid_velocity_ratio is None


def jump(text: Text) -> None:
    """The functions of the impact maps, and one that passes through a transition."""
    impulses = _impulses(text)
    body = ["    for i in range(N_STATES):", "        out[i] = y[i]"]
    for contact in text.model.contacts:
        for i, t in enumerate(outgoing(text.model, contact)):
            body.append(f"    if contact == {text.contacts[contact]} and guard == {i}:")
            if t.kind == "impact":
                body += _impact(text, t, impulses, " " * 8)
            else:
                body += _passage(text, t, " " * 8)
    body.append("    return contact")
    text.function(
        "jump(contact, guard, law, ratio, y, p, out)",
        """Pass through the transition whose guard fell: state after into out (N,).

    law : RATIO multiplies the rate of rotation by `ratio` and leaves the other rates; IMPULSIVE
        applies the impulsive form of Lagrange's equations.
    Returns the contact state that follows.""",
        body,
    )


def _passage(text: Text, t: Transition, indent: str) -> list[str]:
    """Lines of a transition without an impact: the states that it sets."""
    sets = {f"out[{text.index(x)}]": text.model.written_out(e) for x, e in t.sets.items()}
    lines = []
    if any(e.has(SIDE) for e in sets.values()):
        lines.append(f"{indent}s = {text.model.mechanism(t.source).side_of(t.source)}.0")
    lines += text.evaluate("jump", sets, indent) if sets else []
    return [*lines, f"{indent}return {text.contacts[t.target]}"]


def _impact(text: Text, t: Transition, impulses: ImpulseNames, indent: str) -> list[str]:
    """Lines of an impact: the target follows if its gap opens, otherwise the fallback."""
    rotation = text.model.rotation
    theta, theta_dot = text.index(rotation.position), text.index(rotation.velocity)
    arriving = text.model.mechanism(t.source).side_of(t.source)
    side = text.model.mechanism(t.target).side_of(t.target)
    opens = f"{'' if side == 1 else '-'}out[{theta_dot}] > 0.0 and y[{theta_dot}] != 0.0"

    def by_impulses(target: str) -> list[str]:
        return [
            f"{indent}if law == IMPULSIVE:",
            f"{indent}    {impulses[t.source, target]}({arriving}.0, y, p, out)",
        ]

    by_ratio = f"out[{theta_dot}] = ratio * y[{theta_dot}]"
    lines = [f"{indent}out[{theta}] = 0.0"]
    if impulses:
        lines += [*by_impulses(t.target), f"{indent}else:", f"{indent}    {by_ratio}"]
    else:
        lines.append(f"{indent}{by_ratio}")
    lines += [f"{indent}if {opens}:", f"{indent}    return {text.contacts[t.target]}"]
    # the old foot does not lift
    if impulses and t.fallback:
        lines += by_impulses(t.fallback)
    lines.append(f"{indent}out[{theta_dot}] = 0.0")
    return [*lines, f"{indent}return {text.contacts[t.fallback or t.target]}"]


def _impulses(text: Text) -> ImpulseNames:
    """Add a function for each impact map; those that differ in the side alone share one."""
    names: ImpulseNames = {}
    if not impulsive(text.model):
        return names
    maps: dict[str, ImpulseMap] = {}
    for t in text.model.transitions:
        if t.kind == "impact":
            for target in filter(None, (t.target, t.fallback)):
                if (t.source, target) not in names:
                    names[t.source, target] = _impulse(text, t, target, maps)
    return names


def _impulse(text: Text, t: Transition, target: str, maps: dict[str, ImpulseMap]) -> str:
    """Name of the function of the map from the source of `t` to `target`: one of `maps`, or new."""
    law = text.model.impulse_map(t.source, target)
    side = text.model.mechanism(t.source).side_of(t.source)
    for name, known in maps.items():
        if known.at_side(side).equals(law.at_side(side)):
            return name
    word = "opposite" if target == t.target else target
    name = text.function_name(f"impulse_to_{word}", f"impulse_{len(maps)}")
    maps[name] = law
    after = [f"{text.name(c.velocity)}_after" for c in law.coordinates]
    body = ["    pass"]
    if after:
        body = solve(text, "impulse", law.mass_matrix, law.momentum, after, "    ")
    places = [text.index(c.velocity) for c in law.coordinates]
    body += [f"    out[{i}] = {a}" for i, a in zip(places, after, strict=True)]
    text.function(
        f"{name}(s, y, p, out)",
        f"Rates after side s closes and {word} contact follows: M+ q'+ = sum J+^T m v-.",
        body,
    )
    return name
