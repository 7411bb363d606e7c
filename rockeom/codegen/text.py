"""The text of a generated module as it grows: the names in it, its constants, its functions.

`rates`, `guards`, `jump`, `outputs` and `parameters` write it: each has one function that adds to
the text. This file holds what they have in common.
"""

from collections.abc import Callable, Collection, Iterable, Mapping, Sequence
from textwrap import dedent

import sympy as sp

from rockeom.codegen.names import Names, docstring, names_in
from rockeom.codegen.printer import WIDTH, assign, python, statements
from rockeom.codegen.sine_cosine import assigned_angles, named_angles
from rockeom.symbolic.algebra import SIDE
from rockeom.symbolic.hybrid import HybridModel
from rockeom.symbolic.mode import Mode
from rockeom.symbolic.statics import LOAD


class Constants:
    """Parts of expressions that depend on parameters alone: named, and computed by `prepare`.

    names : of each constant, by its expression in parameters.
    """

    def __init__(self, parameters: Iterable[sp.Symbol]) -> None:
        self.parameters = frozenset(parameters)
        self.names: dict[sp.Expr, sp.Symbol] = {}
        self._fixed: dict[sp.Basic, bool] = {}

    def fixed(self, expr: sp.Basic) -> bool:
        """Whether an expression contains parameters alone."""
        if expr not in self._fixed:
            parts = all(self.fixed(a) for a in expr.args)
            self._fixed[expr] = parts if expr.args else expr.free_symbols <= self.parameters
        return self._fixed[expr]

    def name(self, expr: sp.Expr) -> sp.Expr:
        """A name for an expression in parameters alone; numbers and symbols need none."""
        if expr.is_Atom or expr.is_number:
            return expr
        if expr.could_extract_minus_sign():
            return -self.name(-expr)
        return self.names.setdefault(expr, sp.Symbol(f"c{len(self.names)}"))

    def hoisted(self, expr: sp.Expr) -> sp.Expr:
        """The expression with all parts that depend on parameters alone named as constants."""
        if expr.is_Atom:
            return expr
        if self.fixed(expr):
            return self.name(expr)
        if expr.is_Add or expr.is_Mul:
            fixed = [a for a in expr.args if self.fixed(a)]
            moving = [self.hoisted(a) for a in expr.args if not self.fixed(a)]
            return expr.func(*([self.name(expr.func(*fixed))] if fixed else []), *moving)
        return expr.func(*(self.hoisted(a) for a in expr.args))


class Text:
    """The functions of one model; every symbol is renamed to its Python name here.

    model : what is written; n, its number of coordinates, the integrals of internal variables
        among them, behind the others.
    mode_constants, states, parameters : their Python names; of modes, by the names of the model.
    shaking : names of the accelerations of the ground, in the order of arguments.
    lines : the functions so far. operations : (before, after) common subexpressions were shared,
        by function.
    """

    def __init__(self, model: HybridModel) -> None:
        self.model = model
        coordinates = model.integrated
        self.n = len(coordinates)
        names = Names()
        listed = model.mode_names[:1] if model.is_by_code else model.mode_names
        self.mode_constants = {m: names.of_mode(m) for m in listed}
        self.states = [names.of(name) for name in model.states]
        self.parameters = [names.of(p.name) for p in model.parameters]
        self.user_names = names.taken
        self.names: dict[sp.Symbol, sp.Symbol] = {
            SIDE: sp.Symbol("s"),
            LOAD: sp.Symbol("load"),
        }
        shaking = [f"a{axis}" for axis, _ in zip("xyz", model.shaking, strict=False)]
        self.shaking = ", ".join(shaking)
        for a, name in zip(model.shaking, shaking, strict=True):
            self.names[a] = sp.Symbol(name)
        for p, name in zip(model.parameters, self.parameters, strict=True):
            self.names[p.symbol] = sp.Symbol(name)
        for i, c in enumerate(coordinates):
            self.names[c.position] = sp.Symbol(self.states[i])
            self.names[c.velocity] = sp.Symbol(self.states[self.n + i])
            self.names[c.acceleration] = sp.Symbol(f"{self.states[i]}_ddot")
        self.switches = [f"chi_{i}" for i in range(len(model.switches))]
        for symbol, name in zip(model.switches, self.switches, strict=True):
            self.names[symbol] = sp.Symbol(name)
        self.constants = Constants(self.names[p.symbol] for p in model.parameters)
        self.operations: dict[str, tuple[int, int]] = {}
        self.lines: list[str] = []
        self.functions: set[str] = set()

    # -- names ----------------------------------------------------------------------------

    def plain(self, expr: sp.Expr) -> sp.Expr:
        """The expression in Python names, derived constants written out."""
        expr = self.model.written_out(sp.sympify(expr))
        return expr.xreplace(self.model.constants).xreplace(self.names)

    def fixed(self, expr: sp.Expr) -> bool:
        """Whether an expression contains parameters alone."""
        return self.constants.fixed(self.plain(expr))

    def name(self, symbol: sp.Symbol) -> str:
        """Python name of a parameter, position, velocity or acceleration."""
        return str(self.names[symbol])

    def index(self, symbol: sp.Symbol) -> int:
        """Place in the table of states of a position or velocity."""
        return self.states.index(self.name(symbol))

    def function_name(self, wanted: str, otherwise: str) -> str:
        """`wanted`, unless another function has that name, or it could be one of a user's."""
        taken = not wanted or wanted in self.functions or wanted.endswith("_")
        name = otherwise if taken else wanted
        self.functions.add(name)
        return name

    # -- lines ----------------------------------------------------------------------------

    def test(self, *modes: Mode) -> str:
        """The condition that a mode is one of these modes'."""
        names = [self.mode_constants[c] for mode in modes for c in mode.sides]
        if len(modes) > 1:
            return f"mode in ({', '.join(names)})"
        return " or ".join(f"mode == {name}" for name in names)

    def side(self, indent: str, *modes: Mode) -> list[str]:
        """Lines that assign the side of a mode of these modes, if they have any."""
        if not any(mode.has_side for mode in modes):
            return []
        sides = [(side, c) for mode in modes for c, side in mode.sides.items()]
        if sorted(side for side, _ in sides) != [-1, 1]:
            return [f"{indent}s = SIDES[mode]"]
        right = next(c for side, c in sides if side == 1)
        return [f"{indent}s = 1.0 if mode == {self.mode_constants[right]} else -1.0"]

    def signs(self, lines: Iterable[str], modes: Sequence[Mode]) -> list[str]:
        """Lines that read the side and the states of elements, where lines of a branch use them."""
        used, indent = names_in(dedent("\n".join(lines))), " " * 8
        side = self.side(indent, *modes) if str(self.names[SIDE]) in used else []
        return side + [line for line in self.read_switches(indent) if line.split()[0] in used]

    def read_switches(self, indent: str) -> list[str]:
        """Lines that read the states of all elements of a mode."""
        return [
            f"{indent}{name} = 1.0 * ELEMENT_STATES[mode][{i}]"
            for i, name in enumerate(self.switches)
        ]

    def evaluate(
        self,
        function: str,
        targets: Mapping[str, sp.Expr],
        indent: str,
        first: Mapping[str, sp.Expr] | None = None,
        hoist: bool = False,
        states: bool = True,
    ) -> list[str]:
        """Lines that read what is needed, assign `first`, and then the targets.

        hoist : parts that depend on parameters alone are left to `prepare`, and the sine and
            cosine of an angle are found together. states : whether they are read from y.
        """
        ahead = {k: self.plain(e) for k, e in (first or {}).items()}
        plain = {k: self.plain(e) for k, e in targets.items()}
        angles: dict[sp.Expr, str] = {}
        if hoist:
            plain = {k: self.constants.hoisted(e) for k, e in plain.items()}
            plain, angles = named_angles(plain)
        lines, before, after = statements(plain, indent)
        self.count(function, before, after)
        in_lines = _symbols(plain.values())
        ahead = {k: e for k, e in ahead.items() if k in in_lines}
        assigned = [line for k, e in ahead.items() for line in assign(k, python(e), indent)]
        used = _symbols([*ahead.values(), *plain.values(), *angles])
        of_angles = _symbols(angles)
        read = self._read_states(used, indent) if states else []
        # what is read before the angles waits on the stack until they are found
        read += self._read_constants(used & of_angles, indent) + assigned_angles(angles, indent)
        return read + self._read_constants(used - of_angles, indent) + assigned + lines

    def _read_states(self, used: Collection[str], indent: str) -> list[str]:
        """Read the states that occur, of y."""
        return [f"{indent}{n} = y[{i}]" for i, n in enumerate(self.states) if n in used]

    def _read_constants(self, used: Collection[str], indent: str) -> list[str]:
        """Read the parameters and constants that occur, of p."""
        lines = [f"{indent}{n} = p[{i}]" for i, n in enumerate(self.parameters) if n in used]
        first = len(self.parameters)
        for i, (value, c) in enumerate(self.constants.names.items()):
            if str(c) in used:
                line, meaning = f"{indent}{c} = p[{first + i}]", f"  # {python(value)}"
                lines.append(line + meaning if len(line + meaning) <= WIDTH else line)
        return lines

    def count(self, function: str, before: int, after: int) -> None:
        """Add to the operations of a function."""
        b, a = self.operations.get(function, (0, 0))
        self.operations[function] = (b + before, a + after)

    # -- functions ------------------------------------------------------------------------

    def function(self, signature: str, doc: str, body: list[str], mark: str = "") -> None:
        """Add a function."""
        marked = [mark] if mark else []
        self.lines += ["", "", *marked, f"def {signature}:", docstring(doc, "    "), *body]

    def by_mode(
        self,
        signature: str,
        doc: str,
        branch: Callable[[Mode, str], list[str]],
        after: Sequence[str] = (),
    ) -> None:
        """Add a function with a branch for each mode, and the lines behind them.

        Modes that have the same lines share a branch.
        """
        branches: dict[tuple[str, ...], list[Mode]] = {}
        for mode in self.model.modes:
            branches.setdefault(tuple(branch(mode, " " * 8)), []).append(mode)
        tested = [
            (self.test(*modes), [*self.signs(lines, modes), *(lines or [" " * 8 + "pass"])])
            for lines, modes in branches.items()
        ]
        self.function(signature, doc, [*branched(tested), *after])


def branched(tested: Sequence[tuple[str, list[str]]], otherwise: bool = False) -> list[str]:
    """The lines of a function that has a branch for each test; of one alone they need none.

    otherwise : the last branch is that of all else.
    """
    if len(tested) == 1:
        return [line[4:] for line in tested[0][1]]
    body: list[str] = []
    for i, (test, lines) in enumerate(tested, 1):
        last = otherwise and i == len(tested)
        body += ["    else:" if last else f"    {'elif' if body else 'if'} {test}:", *lines]
    return body


def _symbols(exprs: Iterable[sp.Expr]) -> set[str]:
    """Names of the symbols that occur."""
    return {str(x) for e in exprs for x in sp.sympify(e).free_symbols}
