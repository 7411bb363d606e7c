"""The functions of a structure whose modes are numbers only: motion, guards and forces.

The module holds the free motion and the points. The forces of a mode are solved for by
`rockeom.generated.numeric_modes`, from which the module imports.
"""

from rockeom.codegen.outputs import Columns
from rockeom.codegen.points import functions_of_points, impact_law
from rockeom.codegen.tables import table
from rockeom.codegen.text import Text, branched
from rockeom.symbolic.contacts import ContactDeclaration
from rockeom.symbolic.reactions import total_reaction

_SOLVER = (
    "digit_of", "guards_in_code", "motion_in_code", "move_by_squares", "press_by_squares",
    "rows_in", "slips_in",
)  # fmt: skip
_TABLES = (
    "MODES", "POINT_STATES", "KINDS", "SUBJECTS", "SHARED", "GUARDS", "ELEMENT_STATES", "SIDES",
    "TARGETS", "REVERSE", "PARTS",
)  # fmt: skip
WAYS = ("horizontal", "transverse", "vertical")


def numeric(text: Text, of: ContactDeclaration) -> tuple[dict[str, Columns], list[str]]:
    """Add all functions; returns the table of names of forces, and the tables of modes."""
    functions_of_points(text, of)
    _solver(text, of)
    _motion(text, of)
    _guards(text, of)
    columns = _reactions(text, of)
    return {"REACTIONS": columns}, _tables(of)


def _told(text: Text, of: ContactDeclaration) -> list[str]:
    """Lines that make room for what `solve_mode` finds besides accelerations."""
    n, m = text.n, len(of.contacts)
    return [f"    told, share = np.empty({m * (9 + 3 * n)}), np.empty({3 * m})"]


def _arrays(text: Text, of: ContactDeclaration) -> list[str]:
    return [f"    accelerations = np.empty({text.n})", *_told(text, of)]


def _in(lines: list[str]) -> list[str]:
    """The lines of a branch."""
    return [f"    {line}" for line in lines]


def _solved(text: Text) -> str:
    return f"    solve_mode(mode, y, p, {text.shaking}, told, accelerations, share)"


def _equations(text: Text, m: int) -> list[str]:
    """Lines that write down the equations of motion where nothing slips."""
    n = text.n
    return [
        f"    matrix, forces, squares = np.empty({n**2}), np.empty({n}), np.empty({n * (n + 1)})",
        f"    rows, pivots = np.empty({3 * m}, np.int64), np.empty({n}, np.int64)",
        f"    rows_in(mode, {m}, SMOOTH, rows)",
        f"    equations(y, p, {text.shaking}, mode, rows, matrix, forces, squares)",
    ]


def _solver(text: Text, of: ContactDeclaration) -> None:
    n, m = text.n, len(of.contacts)
    text.function(
        f"solve_mode(mode, y, p, {text.shaking}, told, accelerations, share)",
        "Rows and laws of points in a state into told, and the motion and forces of a mode.",
        [
            f"    matrix, forces = np.empty({n**2}), np.empty({n})",
            f"    free_motion(y, p, {text.shaking}, mode, matrix, forces)",
            "    points(y, p, told)",
            f"    point_laws(p, told[{m * (7 + 3 * n)}:])",
            "    motion_in_code(",
            f"        mode, {n}, {m}, SMOOTH, matrix, forces, told, accelerations, share",
            "    )",
        ],
    )


def _motion(text: Text, of: ContactDeclaration) -> None:
    """Rates of all states on arrays, and accelerations of plain numbers."""
    n, m = text.n, len(of.contacts)
    internal = {f"dy[{text.index(z.symbol)}]": e for z, e in of.internal.items()}
    sticks = [
        *_equations(text, m),
        f"    move_by_squares({n}, matrix, forces, squares, pivots, accelerations)",
    ]
    slides = [*_told(text, of), _solved(text)]
    way = branched([(f"slips_in(mode, {m})", _in(slides)), ("", _in(sticks))], True)
    text.function(
        f"rates(mode, y, p, {text.shaking}, dy)",
        f"Rates of the states y (N,) under ground accelerations {text.shaking} [m/s2], "
        "into dy (N,).",
        [
            f"    accelerations = np.empty({n})",
            *(way if _rub(of) else sticks),
            f"    for i in range({n}):",
            f"        dy[i], dy[{n} + i] = y[{n} + i], accelerations[i]",
            *text.evaluate("rates", internal, "    "),
        ],
    )
    text.function(
        f"accelerations(mode, {', '.join(text.states)}, p, {text.shaking})",
        f"Accelerations of the coordinates under ground accelerations {text.shaking} [m/s2].",
        [
            f"    y, dy = np.empty({2 * n}), np.empty({2 * n})",
            *(f"    y[{i}] = {name}" for i, name in enumerate(text.states)),
            f"    rates(mode, y, p, {text.shaking}, dy)",
            f"    return ({', '.join(f'dy[{n + i}]' for i in range(n))},)",
        ],
        "@inlined",
    )
    text.function(
        f"opening_acceleration(mode, y, p, {text.shaking})",
        "Zero: whether a gap opens is found among the candidates.",
        ["    return 0.0"],
        "@inlined",
    )
    text.function(
        "jump(mode, guard, law, ratio, y, p, out)",
        "The same state into out (N,), and the same mode: no guard leads to a certain one.",
        ["    for i in range(N_STATES):", "        out[i] = y[i]", "    return mode"],
    )


def _rub(of: ContactDeclaration) -> bool:
    """Whether points may slip with friction."""
    laws = [c.law for c in of.contacts]
    return any(law.friction is not None and not law.frictionless for law in laws)


def _guards_of_points(of: ContactDeclaration) -> int:
    """One of each point, and two more where points may slip with friction."""
    return (3 if _rub(of) else 1) * len(of.contacts)


def _guards(text: Text, of: ContactDeclaration) -> None:
    n, m = text.n, len(of.contacts)
    first = _guards_of_points(of)
    pressing = [  # normal forces and gaps are enough
        *_equations(text, m),
        "    gaps_of_points(y, p, told)",
        f"    point_laws(p, told[{m * (7 + 3 * n)}:])",
        "    press_by_squares(",
        f"        {n}, {m}, matrix, forces, squares, rows, pivots, told, accelerations,",
        "        share",
        "    )",
    ]
    bounds = {f"g[{first + i}]": e for i, e in enumerate(of.limits.values())}
    text.function(
        f"guards(mode, y, p, {text.shaking}, g)",
        "Guards of a mode into g (N_GUARDS,): all positive in it; the first to fall ends it.",
        [
            *_arrays(text, of),
            *([_solved(text)] if _rub(of) else pressing),
            f"    guards_in_code(mode, {n}, {m}, SMOOTH, told, share, g)",
            *text.evaluate("guards", bounds, "    ", hoist=True),
        ],
    )


def _reactions(text: Text, of: ContactDeclaration) -> Columns:
    """The ground's forces along its axes, then the normal force at each point."""
    totals = total_reaction(of.free)
    read = [
        f"    {text.name(c.acceleration)} = accelerations[{i}]"
        for i, c in enumerate(of.coordinates)
    ]
    lines = text.evaluate("reactions", {f"out[{i}]": e for i, e in enumerate(totals)}, "    ")
    used = "\n".join(lines)
    first, m = len(totals), len(of.contacts)
    text.function(
        f"reactions(mode, y, p, {text.shaking}, out)",
        "Forces [N] into out, in the order of REACTIONS: of the ground, and at each point.",
        [
            *_arrays(text, of),
            _solved(text),
            *(line for line in read if line.split()[0] in used),
            *lines,
            f"    for i in range({m}):",
            "        bears = digit_of(mode, i) != IDLES",
            f"        out[{first} + i] = share[3 * i] if bears else 0.0",
            f"        out[{first + m} + 2 * i] = share[3 * i + 1]",
            f"        out[{first + m} + 2 * i + 1] = share[3 * i + 2]",
        ],
    )
    normal = [f"{way}_reaction" for way in WAYS] + [f"{c.name}_reaction" for c in of.contacts]
    return (*normal, *(f"{c.name}_friction_{axis}" for c in of.contacts for axis in "xy"))


def _tables(of: ContactDeclaration) -> list[str]:
    m, limits = len(of.contacts), [*of.limits]
    smooth = sum(2**i for i, c in enumerate(of.contacts) if c.law.frictionless)
    return [
        *table("POINTS", [c.name for c in of.contacts]),
        "ELEMENTS = ()",
        f"N_GUARDS = {_guards_of_points(of) + len(limits)}",
        "N_PARTS = 0",
        f"N_POINTS = {m}",
        "N_ELEMENTS = 0",
        *(table("BOUNDS", limits) if limits else []),
        f"FIRST_BOUND = {_guards_of_points(of)}  # of the guards",
        f"N_BOUNDS_OF_DECLARATION = {len(of.bounds)}  # behind them are tilts that overturn",
        *(["HELD_ACROSS = True"] if of.is_held_across else []),
        *impact_law(of),
        "TRANSITIONS = ()",
        "LOCALISED = False  # whether forces may act in a small part of a step",
        "FULL_CONTACT = -1  # mode whose guards are sums of the state and the ground, or -1",
        "HAS_IMPULSIVE = False",
        "EQUATIONS = ()",
        f"SMOOTH = {smooth}  # with a binary digit 1 for each point without friction",
        "BY_CODE = True  # the number of a mode has a digit for each point",
        "from rockeom.codes import IDLES",
        f"from rockeom.generated.numeric_modes import {', '.join(_SOLVER)}",
        "from rockeom.numbers.mode_codes import tables_by_code",
        "(",
        f"    {', '.join(_TABLES)},",
        f") = tables_by_code(POINTS, SMOOTH, N_GUARDS, {len(limits)})",
    ]
