"""Small errors put into the project's own text, each of which an equation of the thesis notices.

    python -m tests.thesis.mutations        run all of them and list what each one is noticed by

Each replaces a piece of a file: of the derivations, of a structure, of a wall, of a law, or of the
catalogue of the thesis. Of an equation of the catalogue the first occurrence in its entry is
replaced, which is in its printed form.
"""

import contextlib
import inspect
import sys
from collections.abc import Iterator
from pathlib import Path
from types import FunctionType, ModuleType
from typing import Any, NamedTuple

from rockeom.symbolic import registry
from rockeom.thesis import EQUATIONS, Equation, verification

from .wrong import notices

ROOT = Path(__file__).parents[2] / "rockeom"


class Mutation(NamedTuple):
    """An error: the file under rockeom/, the piece and its replacement, and who notices it."""

    file: str
    noticed_by: str
    old: str
    new: str

    def __str__(self) -> str:
        return f"{self.noticed_by:<6} {self.file}: {_line(self.old)}  ->  {_line(self.new)}"


def _line(text: str) -> str:
    return " ".join(text.split()) or "nothing"


DERIVATIONS = {
    "symbolic/lagrange.py": (
        ("D-11", "(velocity.T * inertia", "((velocity.T * sp.diag(1, -1, 1)) * inertia"),
        ("3-1", "* inertia(body) * velocity)[0] / 2", "* inertia(body) * velocity)[0]"),
        ("2-9", "len(body.position), body.inertia)", "len(body.position), 2 * body.inertia)"),
        ("D-13", "mode.gravity * b.position[-1]", "mode.gravity * b.position[0]"),
        ("2-2", "mode.gravity * b.position[-1]", "-mode.gravity * b.position[-1]"),
        ("2-9", "sum(a * x for a, x", "sum(2 * a * x for a, x"),
        (
            "D-17",
            "excitation_forces=-gradient(moved, q)",
            "excitation_forces=gradient(moved, q)",
        ),
        ("5-35", "elastic_forces=gradient(elastic, q)", "elastic_forces=2 * gradient(elastic, q)"),
        ("D-26", "damping_forces=gradient(", "damping_forces=-gradient("),
        ("D-20", "tidy(_along(p, rates) - slope)", "tidy(_along(p, rates))"),
        ("D-25", "tidy(_along(p, rates)", "tidy(2 * _along(p, rates)"),
        ("5-34", "forces -= self.velocity_forces", "forces += self.velocity_forces"),
        ("3-6", " + [(c.velocity, c.acceleration) for c in coordinates]", ""),
    ),
    "symbolic/impulse.py": (
        ("2-6", "SIDE * before.side * after.side", "SIDE"),
        ("5-12", "momentum += jacobian.T", "momentum -= jacobian.T"),
        ("5-14", "inertia(body) * arriving", "sp.diag(body.mass, body.mass, 0) * arriving"),
        ("2-6", "inertia(body) * arriving", "sp.diag(body.mass, 0, body.inertia) * arriving"),
        ("5-13", "mass_matrix += jacobian.T", "mass_matrix += 2 * jacobian.T"),
    ),
    "symbolic/reactions.py": (
        ("3-8", "field = (*across", "field = (*(-a for a in across)"),
        ("3-11", "body.mass * (moved + field[i])", "moved + field[i]"),
        ("3-9", "up + mode.gravity", "up - mode.gravity"),
        ("3-15", "up + mode.gravity", "up"),
    ),
    "symbolic/statics.py": (
        ("5-24", "eq.gravity_forces + eq.elastic_forces", "eq.gravity_forces - eq.elastic_forces"),
        ("5-26", "eq.gravity_forces + eq.elastic_forces", "eq.elastic_forces"),
        ("5-31", "lacking - LOAD *", "lacking + LOAD *"),
        ("5-32", "return -turning.subs(LOAD, 0)", "return -2 * turning.subs(LOAD, 0)"),
    ),
    "symbolic/model.py": (
        ("2-2", "dx * cos + dy * sin", "dx * cos - dy * sin"),
        ("5-37", "dx * cos + dy * sin", "dx * cos"),
        ("D-1", "dy * cos", "dy"),
    ),
    "symbolic/rocking.py": (
        ("5-9", "pivot = (SIDE * half_width", "pivot = (-SIDE * half_width"),
    ),
    "symbolic/elements/spring.py": (
        ("5-35", "sp.sympify(self.deformation) ** 2 / 2", "sp.sympify(self.deformation) ** 2"),
        ("D-15", "rate(self.deformation, coordinates) ** 2 / 2", "self.deformation**2 / 2"),
    ),
    # the tendon: a sign, a factor, a term, its energy
    "symbolic/elements/tie.py": (
        ("4-27", "return self.pretension + self.stiff", "return self.pretension - self.stiff"),
        ("4-16", "return self.pretension + self.stiff", "return self.pretension - self.stiff"),
        ("4-16", "n + self.stiffness * drawn\n", "n + 2 * self.stiffness * drawn\n"),
        ("4-16", "return self.pretension + self.stiff", "return self.stiff"),
        ("4-27", "self._elastic**2 / (2 *", "self._elastic**2 / ("),
    ),
    "symbolic/algebra.py": (
        ("2-3", "sp.factorial(k)", "1"),
        ("2-7", "for k in range(order + 1)", "for k in range(order)"),
    ),
}  # fmt: skip
"""Errors of the engine."""

STRUCTURES = {
    "symbolic/structures/rigid_block.py": (
        ("2-9", "turned((0, h), pivot, theta)", "turned((0, 2 * h), pivot, theta)"),
        ("2-2", "INERTIA.symbol, theta, polar", "2 * INERTIA.symbol, theta, polar"),
        ("2-3", "r * sp.sin(a), r * sp.cos(a)", "r * sp.cos(a), r * sp.sin(a)"),
        ("2-14", "r * sp.sin(a), r * sp.cos(a)", "r * sp.sin(a), 2 * r * sp.cos(a)"),
        ("2-13", "a * x.position, rho * sp.cos(a)", "2 * a * x.position, rho * sp.cos(a)"),
        ("2-13", "rho - rho**2", "rho"),
    ),
    "symbolic/structures/dirac_delta.py": (
        ("2-29", "return loss(r)", "return -loss(r)"),
        ("2-28", "sp.sqrt(r) * v_0", "r * v_0"),
        ("2-29", "(n * sp.sqrt(sp.pi))", "n"),
        ("2-29", "sp.tanh(v / n)", "sp.tanh(v)"),
        ("2-29", "(height - x**2 / 2)", "(height + x**2 / 2)"),
        ("2-29", "forces=(a**2 * force,)", "forces=(2 * a**2 * force,)"),
    ),
    "symbolic/structures/uplifting_oscillator.py": (
        ("2-7", "turned((u.position, HEIGHT.symbol)", "turned((-u.position, HEIGHT.symbol)"),
        ("2-8a", "u.position, STIFFNESS.symbol", "u.position, 2 * STIFFNESS.symbol"),
        ("2-8b", "STIFFNESS.symbol, DAMPING.symbol),)", "STIFFNESS.symbol, 2 * DAMPING.symbol),)"),
    ),
    "symbolic/structures/two_spring.py": (
        ("5-22", "-place((SIDE * b, sp.S.Zero))", "-place((2 * SIDE * b, sp.S.Zero))"),
        ("5-15", "MASS.symbol + BASE_MASS.symbol", "MASS.symbol - BASE_MASS.symbol"),
        ("5-25", "lever = HEIGHT.symbol", "lever = 2 * HEIGHT.symbol"),
        ("5-33", "sp.cancel(-cosine / sine)", "sp.cancel(cosine / sine)"),
        ("5-33", "- pl / (uo - ul) * beyond**2 / 2", "- pl / uo * beyond**2 / 2"),
    ),
    "symbolic/parts/superstructures.py": (
        ("D-1", "place((deformation, height.symbol))", "place((-deformation, height.symbol))"),
        ("5-8", "at, inertia.symbol, angle", "at, sp.S.Zero, angle"),
        ("D-2", "BASE_MASS, BASE_HEIGHT, BASE_INERTIA\n", "BASE_MASS, HEIGHT, BASE_INERTIA\n"),
        ("D-12", "BASE_MASS, BASE_HEIGHT, BASE_INERTIA\n", "BASE_MASS, BASE_HEIGHT, INERTIA\n"),
        ("5-10", "MASS, HEIGHT, INERTIA, place", "MASS, BASE_HEIGHT, INERTIA, place"),
        ("5-35", "STIFFNESS.symbol, DAMPING.symbol),)", "STIFFNESS.symbol, 2 * DAMPING.symbol),)"),
        ("D-13", "u.position, STIFFNESS.symbol", "u.position, -STIFFNESS.symbol"),
    ),
    "symbolic/parts/supports.py": (
        ("5-16", "k if d in down", "2 * k if d in down"),
        ("5-18", "x + centre[0]", "2 * x + centre[0]"),
        ("5-20", "return k * compression", "return 2 * k * compression"),
    ),
}  # fmt: skip
"""Errors of the structures."""

_WALL = "symbolic/structures/controlled_wall.py"
WALLS = {
    _WALL: (
        # the rotation centre: a sign, a factor, a term
        ("4-8", "1 - sp.exp(-((displ", "1 + sp.exp(-((displ"),
        ("4-8", "lambda D: (HALF_WIDTH", "lambda D: 2 * (HALF_WIDTH"),
        ("4-27", "HALF_WIDTH.symbol - EDGE_DISTANCE.symbol) *", "HALF_WIDTH.symbol) *"),
        ("4-37", "lambda D: HALF_WIDTH.symbol * _m", "lambda D: HALF_WIDTH.symbol / 2 * _m"),
        # the tendon: a sign, a factor, a term
        ("4-27", "(self.centre + B * (1 - cosine)) / cosine", "self.centre / cosine"),
        ("4-27", "* (q / H) / cosine", "* (q / H)"),
        ("4-16", "(self.centre + B * (1 - sp.cos(q)))", "(self.centre - B * (1 - sp.cos(q)))"),
        ("4-16", "B * (1 - sp.cos(q))) / sp.cos(q)", "B) / sp.cos(q)"),
        # the substitute gravity: a sign, a factor, a term
        ("4-32", "forces=(-downward *", "forces=(downward *"),
        ("4-40", "forces=(-downward *", "forces=(-2 * downward *"),
        ("4-32", "forces=(-downward * sp.diff(centroid[1], q),)", "forces=(sp.S.Zero,)"),
        ("4-40", "(self.arm**2 + Hc**2)", "self.arm**2"),
        ("4-40", "pivot = self.q, (SIDE * self.arm", "pivot = self.q, (-SIDE * self.arm"),
        ("4-32", "turned((0, Hc), pivot, q)", "turned((0, H), pivot, q)"),
        # the oscillator
        ("4-27", "GRAVITY.symbol * self.rise", "GRAVITY.symbol * -self.rise"),
        ("4-27", "damping = M * loss", "damping = -M * loss"),
        ("4-27", "* self.now * self.v\n", "* self.now * self.now\n"),
        ("4-27", "SIDE * lever * q / H", "2 * SIDE * lever * q / H"),
    ),
}  # fmt: skip
"""Errors of the shipped walls."""

LAWS = {
    "structures/impact_laws.py": (
        ("4-31", "0.85, 0.01 / 0.45", "0.84, 0.01 / 0.45"),
        ("4-31", "0.01 / 0.45", "0.01 / 0.5"),
        ("4-31", "((0.3, ", "((0.31, "),
        ("4-31", "0.852", "0.842"),
        ("4-31", "0.95, 0.0", "0.94, 0.0"),
        ("4-36", "cls(((math.inf, 0.865", "cls(((math.inf, 0.876"),
        ("4-36", "0.0441),))\n", "0.0541),))\n"),
        ("4-38", "0.445", "0.455"),
        ("4-38", "0.445, 1.0", "0.445, 0.9"),
        ("4-38", "(0.78, 0.85, 0.0)", "(0.78, 0.86, 0.0)"),
        ("4-38", "0.94, 0.0", "0.93, 0.0"),
    ),
    "analysis/formulas/damping.py": (
        ("2-15", "return 0.4 *", "return 0.41 *"),
        ("2-16", "return -0.34", "return -0.35"),
    ),
}  # fmt: skip
"""Errors of shipped laws and formulas whose numbers are those of the thesis."""

PRINTED = {
    "chapter_2": (
        ("2-2", "-m * g * R", "m * g * R"),
        ("2-4", "** 2", "** 3"),
        ("2-5", "4 / th.p", "3 / th.p"),
        ("2-6", "cos(2 * alpha)", "cos(alpha)"),
        ("2-7", "PM * g * th.H / th.B", "g * th.H / th.B"),
        ("2-9", "m * th.a_g * R * cos(alpha + PM", "2 * m * th.a_g * R * cos(alpha + PM"),
        ("2-9", "PM * m * g * R * sin(", "PM * m * g * sin("),
        ("2-13", "alpha * (alpha * (1 - PM * x))", "alpha * (alpha * (1 + PM * x))"),
        ("2-31", "xi_el + th.xi_hyst", "xi_el - th.xi_hyst"),
        ("2-32a", "* 2 / (pi", "* 4 / (pi"),
    ),
    "section_2_6": (
        ("2-17", "x_dd - x", "x_dd + x"),
        ("2-20", "DELTA_N", "2 * DELTA_N"),
        ("2-21b", "dt**2", "dt**3"),
        ("2-26", "-log(sqrt(r))", "-log(r)"),
        ("2-27", "-log(sqrt(r))", "-2 * log(sqrt(r))"),
        ("2-27", "tanh(x_d / n)", "tanh(x_d / 2 / n)"),
        ("2-28", "sqrt(pi)", "pi"),
        ("2-28", "-(x**2)", "(x**2)"),
        ("2-29", "x_dd - x", "x_dd + x"),
        ("2-29", "-log(sqrt(r))", "-log(r)"),
    ),
    "chapter_3": (
        ("3-2", "Abs(theta)", "theta"),
        ("3-9", "g + UP", "2 * g + UP"),
        ("3-10", "3 * g / (4", "3 * g / (5"),
        ("3-12", "- R * th.theta", "+ R * th.theta"),
        ("3-12", "Rational(3, 4)", "Rational(1, 2)"),
        ("3-13", "3 * g / (2", "3 * g / (4"),
        ("3-14", "3 * m * g / 4", "3 * m * g / 2"),
        ("3-14", "cos(alpha)", "sin(alpha)"),
    ),
    "chapter_4": (
        ("4-1", "1076 * Abs(u_L)", "1046 * Abs(u_L)"),
        ("4-1", "Abs(u_L) + Abs(u_R)", "Abs(u_L) - Abs(u_R)"),
        ("4-3", "x - 30", "x + 30"),
        ("4-12", "1 - th.B / th.d", "1 + th.B / th.d"),
        ("4-16", "P_initial + th.E_t", "P_initial - th.E_t"),
        ("4-19", "H**2", "H"),
        ("4-23", "2 * H**2", "H**2"),
        ("4-28", "th.n * sqrt(pi)", "th.n * pi"),
        ("4-33", "sin(theta)", "cos(theta)"),
        ("4-40", "- th.tau_t", "+ th.tau_t"),
        ("4-42", "a_g + th.Delta_dd", "a_g - th.Delta_dd"),
    ),
    "chapter_5": (
        ("5-2", "atan(th.B_measured / th.H", "atan(th.H_measured / th.B"),
        ("5-7", "1 / (2 * pi)", "1 / pi"),
        ("5-11", "alpha_e + s * theta, s)", "alpha_e + s * theta, 1)"),
        ("5-12", "theta_d1, -1)", "theta_d1, 1)"),
        ("5-20", "W / 2 - th.k_f", "W / 2 + th.k_f"),
        ("5-29", "FORCE * th.u,", "FORCE * 2 * th.u,"),
        ("5-29", "FORCE * th.u,", "FORCE * th.u**2,"),
        ("5-30", "m_b * th.H_b", "m_b * H_e"),
        ("5-31", "after_lift_off", "2 * after_lift_off"),
    ),
    "appendix_b": (
        ("B-2", "th.B * Abs", "2 * th.B * Abs"),
        ("B-9", "added_mass(th.d_lifted))", "added_mass(2 * th.d_lifted))"),
        ("B-10", "th.k * th.x", "th.k"),
    ),
    "appendix_d": (
        ("D-2", "R_b * cos(alpha_e", "R_e * cos(alpha_e"),
        ("D-3", "- u_d * sin", "+ u_d * sin"),
        ("D-4", "R_b * sin(alpha_e", "R_b * sin(alpha_b"),
        ("D-8", "th.I_eg", "2 * th.I_eg"),
        ("D-12", "T_B,", "2 * T_B,"),
        ("D-14", "- V_OF", "+ V_OF"),
        ("D-17", "- u * sin(theta)", "+ u * sin(theta)"),
        ("D-22", "cos(alpha_e + theta)", "cos(alpha_e - theta)"),
        ("D-23", "MODEL_C, -1)", "MODEL_C, 1)"),
        ("D-28", "th.y_3d, th.y_4", "th.y_3d, th.y_2"),
    ),
}  # fmt: skip
"""Errors of printed forms, right or wrong ones."""

COEFFICIENTS = {
    "chapter_2": (
        ("2-15", "0.4", "0.6"),
        ("2-16", "0.34", "0.35"),
        ("2-35", "0.05", "0.04"),
    ),
    "chapter_3": (
        ("3-17", "5.525", "6.525"),
        ("3-17", "9.661", "9.961"),
        ("3-17", "0.6663", "0.8663"),
        ("3-18", "7.144", "7.441"),
        ("3-18", "7.576", "7.756"),
        ("3-18", "- Float(\"0.0381\")", "+ Float(\"0.0381\")"),
    ),
    "chapter_4": (
        ("4-5", "0.505", "0.55"),
        ("4-5", "5155", "5515"),
        ("4-5", "0.01", "0.02"),
        ("4-7", "412", "421"),
        ("4-7", "96", "69"),
        ("4-7", "3.551", "3.515"),
        ("4-16", "* EXTENSION", "/ EXTENSION"),
        ("4-20", "244.05", "245.04"),
        ("4-20", "297.22", "279.22"),
        ("4-31", "1, 45", "1, 54"),
        ("4-31", "0.85", "0.58"),
        ("4-31", "0.81", "0.18"),
        ("4-31", "0.852", "0.825"),
        ("4-31", "0.95", "0.59"),
        ("4-36", "0.0441", "0.0414"),
        ("4-36", "0.865", "0.856"),
        ("4-37", "508", "442"),
        ("4-38", "0.445", "0.454"),
        ("4-38", "0.81", "0.18"),
        ("4-38", "\"0.85\"", "\"0.87\""),
        ("4-38", "0.94", "0.96"),
        ("4-43", "16 * pi", "8 * pi"),
        ("4-44", "526.12", "562.12"),
        ("4-44", "98.506", "95.806"),
    ),
    "chapter_5": (
        ("5-1", "571.8e3", "517.8e3"),
        ("5-5", "220.1", "221.0"),
        ("5-5", "0.1276", "0.1267"),
        ("5-5", "300", "285"),
    ),
    "appendix_b": (
        ("B-12", "244.050", "245.040"),
        ("B-13", "297.22", "279.22"),
    ),
}  # fmt: skip
"""Errors of numbers that are data of the thesis."""


def _all() -> tuple[Mutation, ...]:
    code = {**DERIVATIONS, **STRUCTURES, **WALLS, **LAWS}
    found = [Mutation(file, *each) for file, of_file in code.items() for each in of_file]
    for group in (PRINTED, COEFFICIENTS):
        for name, of_file in group.items():
            found += [Mutation(f"thesis/{name}.py", *each) for each in of_file]
    return tuple(found)


MUTATIONS = _all()


def noticed(mutation: Mutation) -> bool:
    """Whether a finding of the equation fails, as in `decide`, or the mutated text is refused."""
    with mutated(mutation) as refused:
        if refused:
            return True
        one = verification.equation(mutation.noticed_by)
        return notices(one, one.right)


@contextlib.contextmanager
def mutated(mutation: Mutation) -> Iterator[bool]:
    """The project with an error in it, for a while; yields whether Python refuses the text."""
    text = (ROOT / mutation.file).read_text("utf-8")
    start = 0
    if mutation.file.startswith("thesis/"):
        start = text.index(f'"{mutation.noticed_by} ')
    place = text.find(mutation.old, start)
    if place < 0:
        raise ValueError(f"{mutation}: the piece is not there")
    text = text[:place] + mutation.new + text[place + len(mutation.old) :]
    name = f"rockeom.{mutation.file.removesuffix('.py').replace('/', '.')}"
    try:
        module = _executed(name, text)
    except ValueError:
        yield True
        return
    with _catalogue(module) if mutation.file.startswith("thesis/") else _code(name, module):
        yield False


def _executed(name: str, text: str) -> ModuleType:
    """A module of this text; structures that it declares do not count."""
    module = ModuleType(name)
    module.__file__ = sys.modules[name].__file__
    declared = dict(registry._DECLARED)
    try:
        exec(compile(text, str(module.__file__), "exec"), vars(module))
    finally:
        registry._DECLARED.update(declared)
    return module


@contextlib.contextmanager
def _catalogue(module: ModuleType) -> Iterator[None]:
    """With the equations of a module in place of those of the same numbers."""
    tuples = (value for value in vars(module).values() if isinstance(value, tuple))
    equations = {e.number: e for found in tuples for e in found if isinstance(e, Equation)}
    exact = verification.equation
    verification.equation = lambda number: equations.get(number, EQUATIONS[number])
    try:
        yield
    finally:
        verification.equation = exact


@contextlib.contextmanager
def _code(name: str, module: ModuleType) -> Iterator[None]:
    """With the code of a module's functions in place of the same functions', wherever used."""
    theirs, ours = _functions(module), _functions(sys.modules[name])
    exact = {key: ours[key].__code__ for key in ours}
    assert theirs.keys() == ours.keys()
    try:
        for key, function in ours.items():
            function.__code__ = theirs[key].__code__
        _forget()
        yield
    finally:
        for key, function in ours.items():
            function.__code__ = exact[key]
        _forget()


def _functions(module: ModuleType) -> dict[str, FunctionType]:
    """The functions of a module, of its classes and of its records, by their place in it."""
    found: dict[str, FunctionType] = {}

    def enter(place: str, value: Any) -> None:
        for inner in ("fget", "func", "__func__"):
            value = getattr(value, inner, None) or value
        value = inspect.unwrap(value) if callable(value) else value
        if isinstance(value, FunctionType) and value.__code__.co_filename == module.__file__:
            found[place] = value

    for name, value in vars(module).items():
        enter(name, value)
        belongs = getattr(value, "__module__", "") == module.__name__
        if belongs and hasattr(value, "__dict__") and not isinstance(value, FunctionType):
            for inner, attribute in vars(value).items():
                enter(f"{name}.{inner}", attribute)
    return found


def _forget() -> None:
    """Forget all that was derived."""
    for name, module in list(sys.modules.items()):
        if name.startswith(("rockeom.symbolic", "rockeom.thesis.checks")):
            for value in list(vars(module).values()):
                if hasattr(value, "cache_clear"):
                    value.cache_clear()


def main() -> int:
    """Print each mutation, and how many are noticed."""
    missed = 0
    for mutation in MUTATIONS:
        seen = noticed(mutation)
        missed += not seen
        print(f"{'noticed' if seen else 'MISSED ':<8}{mutation}", flush=True)
    print(f"{len(MUTATIONS) - missed} of {len(MUTATIONS)} noticed")
    return missed > 0


if __name__ == "__main__":
    sys.exit(main())
