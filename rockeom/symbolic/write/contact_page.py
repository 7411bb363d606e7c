"""The page of a structure whose modes are derived from its contacts: each mode's equations."""

from collections.abc import Iterable, Mapping

import sympy as sp

from rockeom.codes import OPEN
from rockeom.symbolic.algebra import SIDE, tidy
from rockeom.symbolic.contacts import ContactDeclaration
from rockeom.symbolic.elements import switch_of
from rockeom.symbolic.fractions import cancelled, over_one_denominator
from rockeom.symbolic.hybrid import HybridModel, Search
from rockeom.symbolic.impulse import AFTER, BEFORE, at_impact
from rockeom.symbolic.model import GROUND_ACCELERATIONS
from rockeom.symbolic.modes.balance import free_motion
from rockeom.symbolic.modes.derived import DerivedMode
from rockeom.symbolic.modes.kinematics import sign_of_slip
from rockeom.symbolic.text.page import Block, Display, Heading, Part
from rockeom.symbolic.write.notation import Notation
from rockeom.symbolic.write.symbols import energies, listed


def signs_of_search(search: Search) -> list[tuple[sp.Symbol, str]]:
    """The side, signs of slips and states of elements that equations contain, with meanings."""
    signs: list[tuple[sp.Symbol, str]] = []
    if search.of.by_code:
        return signs
    if any(m.sided for m in search.modes.derived):
        signs.append((SIDE, "side: $+1$ right, $-1$ left"))
    slips = max(len(m.slipping) for m in search.modes.derived)
    signs += [
        (sign_of_slip(i), "sign of the slip: $+1$ to the right, $-1$ to the left")
        for i in range(slips)
    ]
    return [*signs, *((switch_of(i), e.meaning()) for i, e in enumerate(search.of.switching))]


def contact_sections(model: HybridModel, search: Search) -> list[Block]:
    """Contacts, energies, internal variables, and the equations of all derived modes."""
    of = search.of
    notation = Notation(of.free, model)
    blocks = [*_declared(of, notation), *_internal(of, notation)]
    if of.by_code:
        return [*blocks, *_free_equations(of, notation, _IN_SPACE)]
    blocks += [] if _is_short(of) else _free_equations(of, notation, _IN_PLANE)
    for mode in search.modes.derived:
        blocks += _mode(search, mode, notation)
    return blocks


def _is_short(of: ContactDeclaration) -> bool:
    """Whether a page shows each mode's own equations; if not, those of the free structure.

    The prescribed motions and the zero forces of each mode complete these.
    """
    return len(of.coordinates) <= 3


_IN_PLANE = (
    "With the normal force $N$ and the friction $F$, positive to the right, at each point:",
    "Over an impact the rates jump and the impulses $P$ of these forces act: the same terms "
    "of accelerations, with the changes of the rates in place of the accelerations, are equal "
    "to the same terms of $N$ and $F$, with $P_N$ and $P_F$ in place of them. Each closing gap "
    "then opens at the rate $e_n$ times that at which it closed. A mode below follows "
    "where no force or impulse pulls, and friction is within its bound.",
)
_IN_SPACE = (
    "With the normal force $N$ at each point, which has no friction:",
    "In a mode some points touch, whose gaps stay zero, $\\ddot d = 0$, and the forces $N$ of all "
    "others are zero. These are linear equations, solved as numbers in each mode. More than three "
    "points of a rigid body share the load as equal springs under it: their forces are linear in "
    "the place of a point, and one that would pull is idle.",
    "Over an impact the rates jump by the impulses of the same forces. Each closing gap then opens "
    "at the rate $e_n$ times that at which it closed.",
)
"""Words around the equations of the free structure with the forces at all points."""


def _free_equations(
    of: ContactDeclaration, notation: Notation, words: tuple[str, ...]
) -> list[Block]:
    """M q'' = f + J_N^T N + J_T^T F with the forces at all points."""
    coordinates = of.coordinates
    matrix, forces = free_motion(of)
    letters = "N" if of.by_code else "NF"
    forced = {c.name: [_force(letter, [c.name]) for letter in letters] for c in of.contacts}
    lines = []
    for k, c in enumerate(coordinates):
        row = {a.acceleration: matrix[k, j] for j, a in enumerate(coordinates)}
        pushes = []
        for contact in of.contacts:
            for name, e in zip(forced[contact.name], contact.at(contact.side), strict=False):
                arm = tidy(sp.diff(e, c.position))
                pushes += [notation.write(arm * sp.Symbol(name))] if arm != 0 else []
        lines.append(_equation(row, forces[k], of, notation, pushes))
    return [
        Heading(2, "Equations of motion"),
        words[0],
        Display.of_parts(lines),
        *words[1:],
    ]


def _equation(
    row: Mapping[sp.Symbol, sp.Expr],
    forcing: sp.Expr,
    of: ContactDeclaration,
    notation: Notation,
    pushes: Iterable[str] = (),
) -> list[Part]:
    """Accelerations and what does not depend on the ground left, the ground and pushes right."""
    forcing = sp.expand(forcing)
    still = forcing.subs(dict.fromkeys(GROUND_ACCELERATIONS, 0))
    static = still.subs(dict.fromkeys((c.velocity for c in of.coordinates), 0))
    resisting = {
        "velocity terms": sp.expand(static - still),
        "static forces": -static,
    }
    return notation.equation(row, resisting, {"excitation": sp.expand(forcing - still)}, pushes)


def _force(letter: str, names: Iterable[str]) -> str:
    """A force with the names of its points, which hold no underscores in mathematics."""
    words = "+".join(name.replace("_", r"\thinspace ") for name in names)
    return rf"{letter}_{{\mathrm{{{words}}}}}"


_LAWS = {
    "moreau": "Moreau's law, that of Newton and Coulomb for velocities after the impact plus the "
    "restitution times those before",
    "poisson": "Poisson's law, with Coulomb's friction all through the impact (Routh)",
    "lzb": "the law of Liu, Zhao and Brogliato (2008), as linear springs, with Coulomb's friction "
    "all through the impact",
    "pairwise": "impacts of one after the other, with the energetic restitution and Coulomb's "
    "friction all through each (Routh)",
}
"""Impact laws that are followed through an impact, and are no equations of a mode."""


def _declared(of: ContactDeclaration, notation: Notation) -> list[Block]:
    """Contacts with their laws, and the energies of the free structure."""
    blocks: list[Block] = [Heading(2, "Contacts")] if of.contacts or of.switching else []
    for contact in of.contacts:
        gap, *slips = contact.at(contact.side)
        friction = contact.law.friction
        law = (
            f"`{contact.name}`: restitution ${notation.plain(sp.sympify(contact.law.restitution))}$"
        )
        if friction is None and contact.material:
            law += ", it rolls without slip: the velocity of the material there is zero"
        elif friction is None:
            law += ", it never slips"
        elif contact.law.frictionless:
            law += ", no friction"
        else:
            law += f", friction ${notation.plain(friction)}$"
        along = "u" if len(slips) == 1 else "u, v"
        lines = [f"d = {notation.write(gap)}"]
        lines += [f"{u} = {notation.write(e)}" for u, e in zip(along[::3], slips, strict=True)]
        words = f"{law}; its gap $d$ and its place ${along}$ along the contact are"
        blocks += [words, Display(tuple(lines))]
    if of.contacts and of.impact_law != "newton":
        blocks.append(f"Points that touch meet by {_LAWS[of.impact_law]}.")
    for element in of.switching:
        force = _force(element.symbol_of_force, [element.name])
        value = element.force(sp.S.One, of.coordinates)  # while it acts
        blocks += [element.description(), Display((f"{force} = {notation.write(value)}",))]
    if of.forces:
        works = tuple(
            rf"{_force('Q', [f.name])} = {notation.write(value)},"
            rf"\quad {_force('w', [f.name])} = {notation.write(displacement)}"
            for f in of.forces
            for value, displacement in f.components
        )
        blocks += [
            "Forces $Q$ that always act, each along a displacement $w$:",
            Display(works),
        ]
    return [
        *blocks,
        Heading(2, "Energies"),
        "Kinetic energy $T$, potential energies of gravity $V_g$ and of springs that always act "
        "$V_e$, half the power lost to their damping $D$; what is not shown is zero.",
        *energies(of.free, notation),
    ]


def _internal(of: ContactDeclaration, notation: Notation) -> list[Block]:
    """The rates of internal variables, the same in each mode."""
    if not of.internal:
        return []
    lines = (f"{notation.plain(z.rate)} = {notation.write(e)}" for z, e in of.internal.items())
    return [
        Heading(2, "Internal variables"),
        "States of first order, in all modes; an impact leaves them as they are:",
        Display(tuple(lines)),
    ]


def _mode(search: Search, mode: DerivedMode, notation: Notation) -> list[Block]:
    """A derived mode."""
    of, modes = search.of, search.modes
    number = modes.derived.index(mode)
    served = [state for state in modes.states if modes.patterns[state.pattern].mode == number]
    first = tuple(e.states[0] for e in of.switching)
    alike = {state.name: modes.signs(state) for state in served if state.elements == first}
    blocks: list[Block] = [Heading(2, f"Contact {listed(alike)}")]
    words = [
        f"{', '.join(f'${notation.plain(x)} = {v:+d}$' for x, v in signs.items())} in `{name}`"
        for name, signs in alike.items()
        if signs
    ]
    blocks += [f"One form for all: {'; '.join(words)}."] if words else []
    held = [f"{notation.plain(x)} = {notation.write(e)}" for x, e in mode.place.items()]
    held += [f"{notation.plain(x)} = {notation.plain(e)}" for x, e in mode.leaning.items()]
    held += [
        f"{notation.plain(mode.qd[d])} = {notation.write(mode.velocity[mode.qd[d]])}"
        for d in mode.dependent
    ]
    if held:
        blocks += ["The closed contacts prescribe", Display(tuple(held))]
    if not _is_short(of):
        return [*blocks, *_ends(mode, notation)]
    lines = _mode_lines(of, mode, notation)
    stands = "No coordinate is free: the structure stands still."
    motion = Display.of_parts(lines) if lines else stands
    blocks += [Heading(3, "Equations of motion"), motion]
    return [*blocks, *_mode_forces(search, mode, notation)]


def _mode_lines(of: ContactDeclaration, mode: DerivedMode, notation: Notation) -> list[list[Part]]:
    """Equations of independent coordinates, then accelerations of dependent ones."""
    lines = [
        _equation(
            {mode.qdd[i]: mode.mass_matrix[k, j] for j, i in enumerate(mode.independent)},
            mode.forcing[k],
            of,
            notation,
        )
        for k in range(len(mode.independent))
    ]
    for d in mode.dependent:
        terms = [mode.motions[d, j] * mode.qdd[i] for j, i in enumerate(mode.independent)]
        total = sp.expand(sum(terms, mode.drift[d]))
        if total != 0:
            lines.append([Part(f"{notation.plain(mode.qdd[d])} = {notation.write(total)}", "")])
    return lines


def _called(mode: DerivedMode, letter: str, points: Iterable[int]) -> str:
    """A force, by its letter alone where one point is closed that has a mirror image."""
    if mode.sided and len(mode.closed) == 1:
        return letter
    return _force(letter, [mode.model.contacts[i].name for i in points])


def _bound(mode: DerivedMode, group: tuple[int, ...], notation: Notation) -> str:
    """The largest friction of points that share it."""
    terms = [f"{notation.plain(mode.friction(i))} {_called(mode, 'N', [i])}" for i in group]
    return " + ".join(terms) if len(terms) == 1 else f"({' + '.join(terms)})"


def _mode_forces(search: Search, mode: DerivedMode, notation: Notation) -> list[Block]:
    """Normal forces, the friction with them, how long it lasts, and what it follows from."""
    if not mode.closed:
        return _ends(mode, notation)
    normal, friction = mode.forces
    lines = [f"{_called(mode, 'N', [i])} = {notation.write(e)}" for i, e in normal.items()]
    for group in mode.rubbing:
        name = _called(mode, "F", group)
        if group in mode.slipping:
            sigma = notation.plain(mode.sigma(group[0]))
            lines.append(f"{name} = -{sigma} {_bound(mode, group, notation)}")
        else:
            lines.append(f"{name} = {notation.write(friction[group[0]])}")
    text = "Normal force $N$" + (" of each point" if len(normal) > 1 else "")
    text += ", and friction $F$, positive to the right" if mode.rubbing else ""
    if any(len(g) > 1 for g in mode.rubbing):
        text += "; of points that share it only the sum is determined"
    return [
        Heading(3, "Forces of contact"),
        f"{text}:",
        Display(tuple(lines)),
        *_ends(mode, notation),
        *(_landing(mode, notation) if mode.model.impact_law == "newton" else []),
        *_from_rest(search, mode, notation),
    ]


def _ends(mode: DerivedMode, notation: Notation) -> list[Block]:
    """Events that end a mode."""
    contacts = mode.model.contacts
    ends = [f"${_called(mode, 'N', [i])}$ falls to zero (lifting)" for i in mode.closed]
    for group in mode.rubbing:
        if group in mode.slipping:
            rate = notation.write(mode.sigma(group[0]) * mode.slip_rate(group))
            ends.append(f"${rate}$ falls to zero (the slip ends)")
        elif all(contacts[i].law.friction is not None for i in group):
            force = _called(mode, "F", group)
            bound = _bound(mode, group, notation).strip("()")
            ends.append(f"$|{force}|$ reaches ${bound}$ (slip begins)")
    for i, state in enumerate(mode.states):
        if state == OPEN:
            ends.append(f"the gap ${notation.write(mode.gap(i))}$ closes (landing)")
    ends += [e.ends() for e in mode.model.switching]
    return [f"It ends when {', or '.join(ends)}."] if ends else []


def _landing(mode: DerivedMode, notation: Notation) -> list[Block]:
    """Rates after an impact that ends in a mode."""
    coordinates = mode.model.coordinates
    old = sp.Matrix([at_impact(c, BEFORE) for c in coordinates])
    new = [at_impact(c, AFTER) for c in coordinates]
    lines = []
    for k, momentum in enumerate(mode.impact.kept_momentum * old):
        row = [mode.mass_matrix[k, j] * new[i] for j, i in enumerate(mode.independent)]
        left = notation.sum([notation.write(e) for e in row if e != 0])
        lines.append(f"{left} = {notation.write(momentum)}")
    for d in mode.dependent:
        tied = [mode.motions[d, j] * new[i] for j, i in enumerate(mode.independent)]
        total = sp.expand(sum(tied, (mode.impact.rebound[d, :] * old)[0]))
        lines.append(f"{notation.plain(new[d])} = {notation.write(total)}")
    return [
        Heading(3, "Impact"),
        "Rates after an impact in which these points are pressed, and stick or slip as here; $-$ "
        "is just before, $+$ just after. It is what happens where no impulse pulls, friction is "
        "within its bound, slips after it have their sign, and no other gap closes:",
        Display(tuple(lines)),
    ]


def _from_rest(search: Search, mode: DerivedMode, notation: Notation) -> list[Block]:
    """Beginning of a mode from rest, and the friction that it needs."""
    if not mode.independent:
        return []
    start = mode.from_rest(search.modes.standing)

    def line(name: str, value: sp.Expr) -> str:
        return f"{name} = {notation.quotient(value) if value != 0 else 0}"

    lines = [line(notation.plain(a), e) for a, e in start.motion.items() if e != 0]
    lines += [line(_called(mode, "N", [i]), e) for i, e in start.normal.items()]
    for group in mode.sticking:
        pressed = over_one_denominator(sum(start.normal[i] for i in group))
        sum_of = " + ".join(_called(mode, "N", [i]) for i in group)
        if pressed != 0:
            needed = cancelled(start.friction[group[0]] / pressed)
            lines.append(line(rf"\frac{{{_called(mode, 'F', group)}}}{{{sum_of}}}", needed))
    needs = ", and the friction that it needs" if mode.sticking else ""
    return [
        Heading(3, "From rest"),
        f"Standing still, the accelerations and normal forces with which it begins{needs}:",
        Display(tuple(lines)),
    ]
