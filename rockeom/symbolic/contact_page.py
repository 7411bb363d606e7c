"""The page of a structure whose modes are derived from its contacts: each mode's equations."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

import sympy as sp

from rockeom.symbolic.algebra import SIDE, tidy
from rockeom.symbolic.contacts import Model
from rockeom.symbolic.model import GROUND_X, GROUND_Y
from rockeom.symbolic.modes import (
    OPEN,
    DerivedMechanism,
    free_motion,
    sign_of_slip,
    switch_of,
)
from rockeom.symbolic.notation import AFTER, BEFORE, Notation, at_impact
from rockeom.symbolic.page import Block, Display, Heading
from rockeom.symbolic.typeset import listed, symbols_of


def contact_content(model: Model) -> list[Block]:
    """All that was derived of a structure whose modes follow from its contacts."""
    modes = model.modes
    signs: list[tuple[sp.Symbol, str]] = []
    if any(m.sided for m in modes.mechanisms):
        signs.append((SIDE, "side: $+1$ right, $-1$ left"))
    slips = max(len(m.slipping) for m in modes.mechanisms)
    signs += [
        (sign_of_slip(i), "sign of the slip: $+1$ to the right, $-1$ to the left")
        for i in range(slips)
    ]
    signs += [(switch_of(i), e.meaning()) for i, e in enumerate(model.switching)]
    blocks: list[Block] = [Heading(1, model.title)]
    blocks += [f"Reference: {model.reference}."] if model.reference else []
    blocks += symbols_of(model, False, signs)
    blocks += [*_declared(model), *_internal(model)]
    blocks += [] if _is_short(model) else _free_equations(model)
    for mechanism in modes.mechanisms:
        blocks += _mechanism(model, mechanism)
    return blocks


def _is_short(model: Model) -> bool:
    """Whether each mode's own equations can be read; if not, those of the free structure are told.

    What a mode prescribes and which forces are zero then tells the rest.
    """
    return len(model.coordinates) <= 3


def _free_equations(model: Model) -> list[Block]:
    """M q'' = f + J_N^T N + J_T^T F with the forces at all points."""
    notation, coordinates = Notation(model.free, model), model.coordinates
    matrix, forces = free_motion(model)
    forced = {c.name: (_force("N", [c.name]), _force("F", [c.name])) for c in model.contacts}
    lines = []
    for k, c in enumerate(coordinates):
        row = {a.acceleration: matrix[k, j] for j, a in enumerate(coordinates)}
        pushes = []
        for contact in model.contacts:
            for name, e in zip(forced[contact.name], contact.at(contact.side), strict=True):
                arm = tidy(sp.diff(e, c.position))
                pushes += [notation.write(arm * sp.Symbol(name))] if arm != 0 else []
        lines.append(_equation(row, forces[k], notation, pushes))
    return [
        Heading(2, "Equations of motion"),
        "With the normal force $N$ and the friction $F$, positive to the right, at each point:",
        Display(tuple(lines)),
        "Over an impact the rates jump and the impulses $P$ of these forces act: the same terms "
        "of accelerations, with the changes of the rates in place of the accelerations, are equal "
        "to the same terms of $N$ and $F$, with $P_N$ and $P_F$ in place of them. Each closing gap "
        "then opens at the rate $e_n$ times that at which it closed. A contact state below follows "
        "where no force or impulse pulls, and friction is within its bound.",
    ]


def _equation(
    row: Mapping[sp.Symbol, sp.Expr], forcing: sp.Expr, notation: Notation, pushes: Iterable[str]
) -> str:
    """Accelerations and what does not depend on the ground left, the ground and pushes right."""
    left = [notation.write(m * a) for a, m in row.items() if m != 0]
    forcing = sp.expand(forcing)
    still = forcing.subs({GROUND_X: 0, GROUND_Y: 0})
    left += [notation.write(-still)] if still != 0 else []
    shaken = sp.expand(forcing - still)
    right = [notation.write(shaken)] if shaken != 0 else []
    return f"{notation.sum(left)} = {notation.sum([*right, *pushes])}"


def _force(letter: str, names: Iterable[str]) -> str:
    """A force with the names of its points, which hold no underscores in mathematics."""
    words = "+".join(name.replace("_", r"\thinspace ") for name in names)
    return rf"{letter}_{{\mathrm{{{words}}}}}"


def _declared(model: Model) -> list[Block]:
    """What touches, by which law, and the energies of the free structure."""
    notation, equations = Notation(model.free, model), model.free.equations
    blocks: list[Block] = [Heading(2, "What touches")]
    for contact in model.contacts:
        gap, slip = contact.at(contact.side)
        friction = contact.law.friction
        law = (
            f"`{contact.name}`: restitution ${notation.plain(sp.sympify(contact.law.restitution))}$"
        )
        if friction is None:
            law += ", it never slips"
        elif contact.law.frictionless:
            law += ", no friction"
        else:
            law += f", friction ${notation.plain(friction)}$"
        lines = (f"d = {notation.write(gap)}", f"u = {notation.write(slip)}")
        blocks += [f"{law}; its gap $d$ and its place $u$ along the contact are", Display(lines)]
    for i, element in enumerate(model.switching):
        force = _force(element.symbol_of_force, [element.name])
        value = element.force(element.shown(switch_of(i)), model.coordinates)
        blocks += [element.law(), Display((f"{force} = {notation.write(value)}",))]
    if model.forces:
        works = tuple(
            rf"{_force('Q', [f.name])} = {notation.write(f.value)},"
            rf"\quad {_force('w', [f.name])} = {notation.write(f.displacement)}"
            for f in model.forces
        )
        blocks += [
            "Forces $Q$ that always act, each along a displacement $w$:",
            Display(works),
        ]
    energies = [
        f"T = {notation.write(equations.kinetic_energy)}",
        f"V_g = {notation.write(equations.gravitational_energy)}",
        f"V_e = {notation.plain(equations.elastic_energy)}",
        f"D = {notation.plain(model.free.dissipation_function)}",
    ]
    return [
        *blocks,
        Heading(2, "Energies"),
        "Kinetic energy $T$, potential energies of gravity $V_g$ and of springs that always act "
        "$V_e$, half the power lost to their damping $D$; what is not shown is zero.",
        Display(tuple(line for line in energies if not line.endswith(" = 0"))),
    ]


def _internal(model: Model) -> list[Block]:
    """The rates of internal variables, the same in each contact state."""
    if not model.internal:
        return []
    notation = Notation(model.free, model)
    lines = (f"{notation.plain(z.rate)} = {notation.write(e)}" for z, e in model.internal.items())
    return [
        Heading(2, "Internal variables"),
        "States of first order, in all contact states; an impact leaves them as they are:",
        Display(tuple(lines)),
    ]


def _mechanism(model: Model, mechanism: DerivedMechanism) -> list[Block]:
    modes = model.modes
    number = modes.mechanisms.index(mechanism)
    served = [
        state for state in modes.states if modes.arrangements[state.arrangement].mechanism == number
    ]
    first = tuple(e.states[0] for e in model.switching)
    alike = {state.name: modes.signs(state) for state in served if state.elements == first}
    notation = Notation(model.free, model)
    blocks: list[Block] = [Heading(2, f"Contact {listed(alike)}")]
    told = [
        f"{', '.join(f'${notation.plain(x)} = {v:+d}$' for x, v in signs.items())} in `{name}`"
        for name, signs in alike.items()
        if signs
    ]
    blocks += [f"One form for all: {'; '.join(told)}."] if told else []
    held = [f"{notation.plain(x)} = {notation.write(e)}" for x, e in mechanism.place.items()]
    held += [f"{notation.plain(x)} = {notation.plain(e)}" for x, e in mechanism.leaning.items()]
    held += [
        f"{notation.plain(mechanism.qd[d])} = {notation.write(mechanism.velocity[mechanism.qd[d]])}"
        for d in mechanism.dependent
    ]
    if held:
        blocks += ["The contact prescribes", Display(tuple(held))]
    if not _is_short(model):
        return [*blocks, *_ends(mechanism, notation)]
    blocks.append(Heading(3, "Equations of motion"))
    lines = _mechanism_lines(mechanism, notation)
    if lines:
        blocks.append(Display(tuple(lines)))
    else:
        blocks.append("No coordinate is free: the structure stands still.")
    return [*blocks, *_mechanism_forces(model, mechanism, notation)]


def _mechanism_lines(mechanism: DerivedMechanism, notation: Notation) -> list[str]:
    """Of the independent coordinates, and then the accelerations of those that depend on them."""
    lines = [
        _equation(
            {
                mechanism.qdd[i]: mechanism.mass_matrix[k, j]
                for j, i in enumerate(mechanism.independent)
            },
            mechanism.forcing[k],
            notation,
            (),
        )
        for k in range(len(mechanism.independent))
    ]
    for d in mechanism.dependent:
        terms = [
            mechanism.motions[d, j] * mechanism.qdd[i] for j, i in enumerate(mechanism.independent)
        ]
        total = sp.expand(sum(terms, mechanism.drift[d]))
        if total != 0:
            lines.append(f"{notation.plain(mechanism.qdd[d])} = {notation.write(total)}")
    return lines


def _called(mechanism: DerivedMechanism, letter: str, points: Iterable[int]) -> str:
    """A force, by its letter alone where one point is closed that has a mirror image."""
    if mechanism.sided and len(mechanism.closed) == 1:
        return letter
    return _force(letter, [mechanism.model.contacts[i].name for i in points])


def _bound(mechanism: DerivedMechanism, group: tuple[int, ...], notation: Notation) -> str:
    """The largest friction of points that share it."""
    terms = [
        f"{notation.plain(mechanism.friction(i))} {_called(mechanism, 'N', [i])}" for i in group
    ]
    return " + ".join(terms) if len(terms) == 1 else f"({' + '.join(terms)})"


def _mechanism_forces(model: Model, mechanism: DerivedMechanism, notation: Notation) -> list[Block]:
    """Normal forces, the friction with them, how long it lasts, and what it follows from."""
    if not mechanism.closed:
        return _ends(mechanism, notation)
    normal, friction = mechanism.forces
    lines = [f"{_called(mechanism, 'N', [i])} = {notation.write(e)}" for i, e in normal.items()]
    for group in mechanism.rubbing:
        name = _called(mechanism, "F", group)
        if group in mechanism.slipping:
            sigma = notation.plain(mechanism.sigma(group[0]))
            lines.append(f"{name} = -{sigma} {_bound(mechanism, group, notation)}")
        else:
            lines.append(f"{name} = {notation.write(friction[group[0]])}")
    text = "Normal force $N$" + (" of each point" if len(normal) > 1 else "")
    text += ", and friction $F$, positive to the right" if mechanism.rubbing else ""
    if any(len(g) > 1 for g in mechanism.rubbing):
        text += "; of points that share it only the sum is determined"
    return [
        Heading(3, "Forces of contact"),
        f"{text}:",
        Display(tuple(lines)),
        *_ends(mechanism, notation),
        *_landing(mechanism, notation),
        *_from_rest(mechanism, notation),
    ]


def _ends(mechanism: DerivedMechanism, notation: Notation) -> list[Block]:
    """What ends a contact state."""
    contacts = mechanism.model.contacts
    ends = [f"${_called(mechanism, 'N', [i])}$ falls to zero (lifting)" for i in mechanism.closed]
    for group in mechanism.rubbing:
        if group in mechanism.slipping:
            rate = notation.write(mechanism.sigma(group[0]) * mechanism.slip_rate(group))
            ends.append(f"${rate}$ falls to zero (the slip ends)")
        elif all(contacts[i].law.friction is not None for i in group):
            force = _called(mechanism, "F", group)
            bound = _bound(mechanism, group, notation).strip("()")
            ends.append(f"$|{force}|$ reaches ${bound}$ (slip begins)")
    for i, state in enumerate(mechanism.states):
        if state == OPEN:
            ends.append(f"the gap ${notation.write(mechanism.gap(i))}$ closes (landing)")
    ends += [e.ends() for e in mechanism.model.switching]
    return [f"It ends when {', or '.join(ends)}."]


def _landing(mechanism: DerivedMechanism, notation: Notation) -> list[Block]:
    """Rates after an impact that ends in a mechanism."""
    coordinates = mechanism.model.coordinates
    old = sp.Matrix([at_impact(c, BEFORE) for c in coordinates])
    new = [at_impact(c, AFTER) for c in coordinates]
    lines = []
    for k, momentum in enumerate(mechanism.kept_momentum * old):
        row = [mechanism.mass_matrix[k, j] * new[i] for j, i in enumerate(mechanism.independent)]
        left = notation.sum([notation.write(e) for e in row if e != 0])
        lines.append(f"{left} = {notation.write(momentum)}")
    for d in mechanism.dependent:
        tied = [mechanism.motions[d, j] * new[i] for j, i in enumerate(mechanism.independent)]
        total = sp.expand(sum(tied, (mechanism.rebound[d, :] * old)[0]))
        lines.append(f"{notation.plain(new[d])} = {notation.write(total)}")
    return [
        Heading(3, "Impact"),
        "Rates after an impact in which these points are pressed, and stick or slip as here; $-$ "
        "is just before, $+$ just after. It is what happens where no impulse pulls, friction is "
        "within its bound, slips after it have their sign, and no other gap closes:",
        Display(tuple(lines)),
    ]


def _from_rest(mechanism: DerivedMechanism, notation: Notation) -> list[Block]:
    """How a mechanism begins from standing at rest, and the friction that it needs then."""
    model = mechanism.model
    if not mechanism.independent:
        return []
    start = mechanism.from_rest(model.modes.standing)

    def line(name: str, value: sp.Expr) -> str:
        return f"{name} = {notation.quotient(value) if value != 0 else 0}"

    lines = [line(notation.plain(a), e) for a, e in start.motion.items() if e != 0]
    lines += [line(_called(mechanism, "N", [i]), e) for i, e in start.normal.items()]
    for group in mechanism.sticking:
        pressed = sp.together(sum(start.normal[i] for i in group))
        sum_of = " + ".join(_called(mechanism, "N", [i]) for i in group)
        if pressed != 0:
            needed = sp.cancel(start.friction[group[0]] / pressed)
            lines.append(line(rf"\frac{{{_called(mechanism, 'F', group)}}}{{{sum_of}}}", needed))
    needs = ", and the friction that it needs" if mechanism.sticking else ""
    return [
        Heading(3, "From rest"),
        f"Standing still, the accelerations and normal forces with which it begins{needs}:",
        Display(tuple(lines)),
    ]
