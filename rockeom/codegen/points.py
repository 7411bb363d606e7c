"""Free motion and points of a structure whose contacts were declared: the same in all modes."""

from collections import defaultdict
from collections.abc import Iterable, Mapping, Sequence

import sympy as sp

from rockeom.codegen.printer import assign, python
from rockeom.codegen.text import Text
from rockeom.codes import CONTACT_LAWS, NEVER_SLIPS
from rockeom.symbolic.algebra import tidy
from rockeom.symbolic.contacts import ContactDeclaration
from rockeom.symbolic.lagrange import rate
from rockeom.symbolic.modes.balance import free_motion


def functions_of_points(text: Text, of: ContactDeclaration) -> None:
    """Add all of them."""
    free, told = _free_motion(text, of), _points(text, of)
    _point_laws(text, of)
    if of.by_code:
        _gaps(text, told)
        _equations(text, of, free, told)
    elif of.impact_law != "newton":
        _point_numbers(text, of)


def impact_law(of: ContactDeclaration) -> list[str]:
    """The number of the impact law; Newton's needs none."""
    law = of.impact_law
    return [] if law == "newton" else [f"IMPACT_LAW = {CONTACT_LAWS[law]}  # {law}"]


def _every(text: Text, name: str, targets: Mapping[str, sp.Expr]) -> list[str]:
    """Lines of a function that is the same in every mode."""
    in_space = len(text.model.shaking) > 2  # where it is part of every step
    return text.evaluate(name, targets, "    ", hoist=in_space) or ["    pass"]


def _free_motion(text: Text, of: ContactDeclaration) -> dict[str, sp.Expr]:
    n = text.n
    matrix, forces = free_motion(of)
    inertia = sp.diag(matrix, *([0] * len(of.internal)))  # internal variables have none
    targets = {f"matrix[{n * i + j}]": inertia[i, j] for i in range(n) for j in range(n)}
    targets |= {f"forces[{i}]": e for i, e in enumerate([*forces, *_still(of)])}
    text.function(
        f"free_motion(y, p, {text.shaking}, mode, matrix, forces)",
        "M (n * n, row by row) and f (n) of M q'' = f + J^T lambda, without forces of contact.",
        text.read_switches("    ")
        + text.evaluate("free_motion", targets, "    ", hoist=of.by_code),
    )
    return targets


def _still(of: ContactDeclaration) -> list[sp.Expr]:
    """A zero for the integral of each internal variable: no force, no gap knows of it."""
    return [sp.S.Zero] * len(of.internal)


def _points(text: Text, of: ContactDeclaration) -> list[list[sp.Expr]]:
    """Add `points`; returns what it tells of each."""
    coordinates, told = of.coordinates, []
    targets: dict[str, sp.Expr] = {}
    still = {c.acceleration: 0 for c in coordinates}
    size = 1 + (3 if of.by_code else 2) * (2 + text.n)
    for i, contact in enumerate(of.contacts):
        followed = contact.followed
        rates = [contact.now(rate(e, coordinates)) for e in followed]
        biases = [rate(e, coordinates).subs(still) for e in rates]
        slopes = [
            slope
            for e in followed
            for slope in (*(contact.now(e.diff(c.position)) for c in coordinates), *_still(of))
        ]
        # of a rim as they come: by cosines, as `tidy` may write it, a small tilt has no digits
        values = [followed[0], *rates, *biases, *slopes]
        told.append([e if contact.material else tidy(e) for e in values])
        targets |= {f"out[{size * i + j}]": e for j, e in enumerate(told[-1])}
    text.function(
        "points(y, p, out)",
        f"""For each point from out[i * {size}]: gap, its rate and the slip's, biases, rows.

    gap'' = J_N q'' + bias, and so the slip. The rows are J_N (n), then J_T (n).""",
        _every(text, "points", targets),
    )
    return told


def _gaps(text: Text, told: list[list[sp.Expr]]) -> None:
    """Add a part of `points`."""
    size = len(told[0])
    wanted = (0, *range(7, 7 + text.n))
    targets = {f"out[{size * i + j}]": of[j] for i, of in enumerate(told) for j in wanted}
    text.function(
        "gaps_of_points(y, p, out)",
        "Gaps and their rows alone, where `points` puts them.",
        _every(text, "gaps_of_points", targets),
    )


def _equations(
    text: Text, of: ContactDeclaration, free: Mapping[str, sp.Expr], told: list[list[sp.Expr]]
) -> None:
    """Add the equations of motion of any mode; most of the rows of points are zeros and ones.

    Behind the sine and the cosine of the first angle, that of the outermost rotation, slips along x
    and along y have the same factors, and so have points behind those of the second.
    """
    n, values, held = text.n, dict(free), list[str]()
    for point, (contact, as_told) in enumerate(zip(of.contacts, told, strict=True)):
        angles = () if contact.material else _angles(text, as_told)[:2]
        of_point, rows = [_by_sines(e, angles) for e in as_told], []
        for k in range(3):
            row = [*of_point[7 + n * k : 7 + n * (k + 1)], of_point[4 + k]]
            names = [sp.Symbol(f"r{(3 * point + k) * (n + 1) + j}") for j in range(n + 1)]
            moving = {name: e for name, e in zip(names, row, strict=True) if not e.is_number}
            values |= {str(name): e for name, e in moving.items()}
            rows.append([e if e.is_number else x for x, e in zip(names, row, strict=True)])
        held += [f"    if rows[{3 * point}] == 1:", *_products(rows[:1], " " * 8)]
        held += [f"        if rows[{3 * point + 1}] == 1:", *_products(rows[1:], " " * 12)]
    text.function(
        f"equations(y, p, {text.shaking}, mode, rows, matrix, forces, g)",
        """M and f of `free_motion`, and J'J of the rows that are held, -J' bias behind it, into g.

    rows (3 m,) : 1 where a row of a point is held. g (n, n + 1) : above its diagonal alone.""",
        [
            f"    for i in range({n * (n + 1)}):",
            "        g[i] = 0.0",
            *text.read_switches("    "),
            *text.evaluate("equations", values, "    ", hoist=True),
            *held,
        ],
    )


def _angles(text: Text, expressions: Iterable[sp.Expr]) -> list[sp.Symbol]:
    """Coordinates whose sine or cosine occurs, in the order in which they are declared."""
    found = set().union(*(e.atoms(sp.sin, sp.cos) for e in expressions))
    turned = {sine.args[0] for sine in found}
    return [c.position for c in text.model.integrated if c.position in turned]


def _by_sines(e: sp.Expr, angles: Sequence[sp.Symbol]) -> sp.Expr:
    """A sum as factors of what depends on the first angle, and these as of the others."""
    if not angles:
        return e
    factors: defaultdict[sp.Expr, list[sp.Expr]] = defaultdict(list)
    for term in sp.Add.make_args(sp.expand(e)):
        factor, turned = term.as_independent(angles[0], as_Add=False)
        factors[turned].append(factor)
    return sp.Add(*(x * _by_sines(sp.Add(*of), angles[1:]) for x, of in factors.items()))


def _products(rows: list[list[sp.Expr]], indent: str) -> list[str]:
    """Lines that add J'J and -J' bias of rows [J bias] to g."""
    lines, width = list[str](), len(rows[0])
    for i in range(width - 1):
        for j in range(i, width):
            total = sum((row[i] * row[j] for row in rows), sp.S.Zero)
            if total != 0:
                entry, sign = f"g[{i * width + j}]", "-" if j == width - 1 else "+"
                lines += assign(entry, f"{entry} {sign} ({python(total)})", indent)
    return lines


def _point_laws(text: Text, of: ContactDeclaration) -> None:
    targets: dict[str, sp.Expr] = {}
    for i, contact in enumerate(of.contacts):
        friction = contact.law.friction
        targets[f"out[{2 * i}]"] = sp.sympify(contact.law.restitution)
        mu = sp.Float(NEVER_SLIPS) if friction is None else sp.sympify(friction)
        targets[f"out[{2 * i + 1}]"] = mu
    text.function(
        "point_laws(p, out)",
        "For each point from out[2 * i]: restitution, and coefficient of friction.",
        _every(text, "point_laws", targets),
    )


def _point_numbers(text: Text, of: ContactDeclaration) -> None:
    """The number that an impact law has of each point, besides restitution and friction."""
    targets = {}
    for i, contact in enumerate(of.contacts):
        law = contact.law
        slips = sp.S.NegativeOne if law.tangential is None else law.tangential
        number = slips if law.law == "moreau" else law.stiffness
        targets[f"out[{i}]"] = sp.sympify(number)
    text.function(
        "point_numbers(p, out)",
        "For each point: its stiffness, or with Moreau's law e of its slip, -1: that of the gap.",
        _every(text, "point_numbers", targets),
    )
