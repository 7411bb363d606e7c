"""The text of a generated module as it grows: the names in it, its constants, its functions.

What is written stands in `rates`, `guards`, `jump`, `outputs` and `parameters`: each has one
function that adds to the text. Here is what they have in common.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Mapping, Sequence
from textwrap import dedent
from typing import Any

import sympy as sp

from rockeom.codegen.constants import Constants
from rockeom.codegen.names import Names, docstring, names_in
from rockeom.codegen.printer import WIDTH, assign, python, statements
from rockeom.codegen.sine_cosine import assigned_angles, named_angles
from rockeom.symbolic.algebra import SIDE
from rockeom.symbolic.contacts import Model
from rockeom.symbolic.model import GROUND_X, GROUND_Y, Mechanism, RockingModel
from rockeom.symbolic.statics import LOAD


def contact_names(model: RockingModel | Model) -> tuple[str, ...]:
    """Names of the contact states, in the order in which generated code numbers them."""
    return model.modes.names if isinstance(model, Model) else model.contacts


class Text:
    """The functions of one model; every symbol is renamed to its Python name here.

    model : what is written; n, its number of coordinates, the integrals of internal variables
        among them, behind the others.
    contacts, states, parameters : their Python names, contacts by the model's.
    lines : the functions so far. operations : (before, after) common subexpressions were shared,
        by function.
    """

    def __init__(self, model: RockingModel | Model) -> None:
        self.model: Any = model
        coordinates = model.coordinates
        if isinstance(model, Model):
            coordinates += model.integrals
        self.n = len(coordinates)
        given = Names()
        self.contacts = {c: given.of_contact(c) for c in contact_names(model)}
        self.states = [given.of(name) for name in model.states]
        self.parameters = [given.of(p.name) for p in model.parameters]
        self.given = given.given
        self.names: dict[sp.Symbol, sp.Symbol] = {
            SIDE: sp.Symbol("s"),
            GROUND_X: sp.Symbol("ax"),
            GROUND_Y: sp.Symbol("ay"),
            LOAD: sp.Symbol("load"),
        }
        for p, name in zip(model.parameters, self.parameters, strict=True):
            self.names[p.symbol] = sp.Symbol(name)
        for i, c in enumerate(coordinates):
            self.names[c.position] = sp.Symbol(self.states[i])
            self.names[c.velocity] = sp.Symbol(self.states[self.n + i])
            self.names[c.acceleration] = sp.Symbol(f"{self.states[i]}_ddot")
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

    def test(self, *phases: Mechanism) -> str:
        """The condition that a contact state is one of these phases'."""
        names = [self.contacts[c] for phase in phases for c in phase.contacts]
        if len(phases) > 1:
            return f"contact in ({', '.join(names)})"
        return " or ".join(f"contact == {name}" for name in names)

    def side(self, indent: str, *phases: Mechanism) -> list[str]:
        """Lines that assign the side of a contact state of these phases, if they have any."""
        if not any(phase.has_side for phase in phases):
            return []
        sides = [(side, c) for phase in phases for c, side in phase.contacts.items()]
        if sorted(side for side, _ in sides) != [-1, 1]:
            return [f"{indent}s = SIDES[contact]"]
        right = next(c for side, c in sides if side == 1)
        return [f"{indent}s = 1.0 if contact == {self.contacts[right]} else -1.0"]

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

    def by_phase(
        self,
        signature: str,
        doc: str,
        branch: Callable[[Mechanism, str], list[str]],
        after: Sequence[str] = (),
    ) -> None:
        """Add a function with a branch for each phase, and the lines that stand after them.

        Phases of which the same is to be said share a branch.
        """
        branches: dict[tuple[str, ...], list[Mechanism]] = {}
        for phase in self.model.mechanisms:
            branches.setdefault(tuple(branch(phase, " " * 8)), []).append(phase)
        body: list[str] = []
        for lines, phases in branches.items():
            body.append(f"    {'elif' if body else 'if'} {self.test(*phases)}:")
            if str(self.names[SIDE]) in names_in(dedent("\n".join(lines))):
                body += self.side(" " * 8, *phases)
            body += lines or [" " * 8 + "pass"]
        if len(branches) == 1 and len(self.model.mechanisms) > 1:  # whatever the contact state is
            body = [line[4:] for line in body[1:]]
        self.function(signature, doc, [*body, *after])


def _symbols(exprs: Iterable[sp.Expr]) -> set[str]:
    """Names of the symbols that occur."""
    return {str(x) for e in exprs for x in sp.sympify(e).free_symbols}
