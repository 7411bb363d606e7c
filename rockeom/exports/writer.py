"""The common part of the languages: expressions, and the order of statements.

A language is a subclass that says how it writes numbers, calls, items of arrays and assignments.
"""

import ast
import textwrap
from collections.abc import Mapping, Sequence, Set
from typing import Any, ClassVar

import numpy as np

from rockeom.compiler.parsed import OPERATORS
from rockeom.compiler.types import Type
from rockeom.exports.closed import (
    Function,
    Functions,
    Names,
    base_of,
    given_names,
    indices_of,
    is_row,
    made_array,
    one_by_one,
    pairs,
    words,
)
from rockeom.numbers.functions import COMPARISONS, SIGNS

EITHER, OR, AND, NOT, COMPARED, SUM, PRODUCT, SIGNED, POWER, ITEM = range(10)
"""How strongly the parts of an expression hold together."""

WIDTH = 96
STEP = "    "

_SIGNS = {
    kind: sign
    for kind, of in OPERATORS.items()
    if (sign := {**SIGNS, **COMPARISONS}.get(of.__name__))
}


class Writer:
    """Writes one function into `lines`."""

    not_, unequal, at, first = "!", "!=", "{}[{}]", 0
    truths, nan, infinity = ("0", "1"), "NAN", "INFINITY"
    called: ClassVar[Mapping[str, str]] = {}
    """Functions that the language calls otherwise than Python."""
    if_, elif_, else_, while_, end, go_on = "", "", "", "", "", ""

    def __init__(
        self, functions: Functions, function: Function, names: Names, prefix: str = ""
    ) -> None:
        self.functions, self.function, self.names = functions, function, names
        self.prefix = prefix
        self.lines: list[str] = []
        self.depth = 1
        self.temporary = 0
        self.constants: list[str] = []
        self.inner: Set[str] = frozenset()  # names that only the statement knows which is written

    # -- what a language says -----------------------------------------------------------------

    def power(self, base: ast.expr, exponent: ast.expr) -> tuple[str, int]:
        raise NotImplementedError

    def either(self, test: ast.expr, one: ast.expr, other: ast.expr) -> tuple[str, int]:
        raise NotImplementedError

    def item(self, array: str, indices: Sequence[ast.expr]) -> str:
        raise NotImplementedError

    def place(self, array: str, i: int) -> str:
        """A place of an array, from 0."""
        return self.at.format(array, self.first + i)

    def part(self, array: str, first: ast.expr) -> tuple[str, int]:
        raise NotImplementedError

    def counted(self, counter: str, first: str, last: ast.expr) -> str:
        """The head of a loop."""
        raise NotImplementedError

    def change(self, target: ast.expr, sign: str, value: ast.expr) -> None:
        raise NotImplementedError

    def give(self, value: ast.expr | None) -> None:
        """Return."""
        raise NotImplementedError

    def invoke(self, node: ast.Call, result: str | None = None) -> None:
        """A call as a statement, and the name of what it gives, if that is wanted."""
        raise NotImplementedError

    def copy_part(self, array: str, last: str, value: str) -> None:
        raise NotImplementedError

    def make_array(self, name: str) -> None:
        raise NotImplementedError

    def make_alias(self, name: str) -> None:
        """Nothing where it is written out wherever it is used."""

    def type_word(self, value: ast.expr) -> str:
        """The type that a declaration of a temporary value begins with, if any."""
        return ""

    # -- expressions --------------------------------------------------------------------------

    def type_of(self, node: ast.expr) -> Type:
        return self.functions.type_of(self.function, node)

    def text(self, node: ast.expr, least: int = EITHER) -> str:
        """An expression, in brackets where its parts hold together less than is asked for."""
        written, level = self.expression(node)
        return written if level >= least else f"({written})"

    def expression(self, node: ast.expr) -> tuple[str, int]:
        match node:
            case ast.Constant(value=value):
                return self.number(value), ITEM
            case ast.Name(id=name):
                return self.name(name), ITEM
            case ast.BinOp(left=left, op=ast.Pow(), right=right):
                return self.power(left, right)
            case ast.BinOp(left=left, op=op, right=right) if type(op) in _SIGNS:
                sign = _SIGNS[type(op)]
                level = SUM if sign in "+-" else PRODUCT
                first = self.divided(left) if sign == "/" else self.text(left, level)
                second = self.text(right, level + 1)
                blank = " " if level == SUM else ""
                return f"{first}{blank}{sign}{blank}{second}", level
            case ast.UnaryOp(op=ast.USub(), operand=operand):
                return f"-{self.text(operand, POWER)}", SIGNED
            case ast.UnaryOp(op=ast.UAdd(), operand=operand):
                return self.expression(operand)
            case ast.UnaryOp(op=ast.Not(), operand=operand):
                return f"{self.not_}{self.text(operand, POWER)}", NOT
            case ast.Compare():
                return self.compared(node)
            case ast.BoolOp(op=op, values=values):
                sign, level = ("&&", AND) if isinstance(op, ast.And) else ("||", OR)
                return f" {sign} ".join(self.text(v, NOT) for v in values), level
            case ast.IfExp(test=test, body=body, orelse=orelse):
                return self.either(test, body, orelse)
            case ast.Attribute():
                return self.number(float(getattr(np, node.attr))), ITEM  # such as math.pi
            case ast.Subscript():
                return self.subscript(node)
            case ast.Call(func=ast.Name(id="len")):
                return self.number(self.functions.constant(node)), ITEM
            case ast.Call(func=ast.Name(id=name)) if name not in self.functions.by_name:
                return self.library(name, node.args)
            case ast.Call(func=ast.Attribute(attr=name)):
                return self.library(name, node.args)
            case ast.Call():
                return self.call(node)
        self.function.refuse(node, f"{type(node).__name__} is not written")

    def number(self, value: Any) -> str:
        if isinstance(value, bool):
            return self.truths[value]
        if isinstance(value, float) and not np.isfinite(value):
            return self.nan if value != value else self.infinity
        return repr(value)

    def call(self, node: ast.Call, *more: str) -> tuple[str, int]:
        arguments = [*map(self.text, node.args), *more]
        function = f"{self.prefix}{self.names.of(ast.unparse(node.func))}"
        return f"{function}({', '.join(arguments)})", ITEM

    def library(self, name: str, arguments: Sequence[ast.expr]) -> tuple[str, int]:
        """A function of the language; one of two numbers takes as many as are given."""
        function = self.called.get(name, name)
        *others, nested = map(self.text, arguments)
        nested = nested if others else f"{function}({nested})"
        for one in reversed(others):
            nested = f"{function}({one}, {nested})"
        return nested, ITEM

    def divided(self, node: ast.expr) -> str:
        """A dividend, as a number that is not whole."""
        return self.text(node, PRODUCT)

    def name(self, name: str) -> str:
        if name in self.function.own:
            return self.names.of(name)
        return self.constant(name)

    def constant(self, name: str) -> str:
        """A constant of the text, which `constants` collects."""
        if name not in self.constants:
            self.constants.append(name)
        return f"{self.prefix.upper()}{self.names.of(name)}"

    def compared(self, node: ast.Compare) -> tuple[str, int]:
        """Each comparison of a chain; its parts have no side effects."""
        comparisons, left = [], node.left
        for op, right in zip(node.ops, node.comparators, strict=True):
            if isinstance(op, ast.In) and isinstance(right, ast.Tuple) and len(node.ops) == 1:
                every = [f"{self.text(left, SUM)} == {self.text(x, SUM)}" for x in right.elts]
                return " || ".join(every), OR
            if type(op) not in _SIGNS:
                self.function.refuse(node, f"{type(op).__name__} is not written")
            sign = self.unequal if isinstance(op, ast.NotEq) else _SIGNS[type(op)]
            comparisons.append(f"{self.text(left, SUM)} {sign} {self.text(right, SUM)}")
            left = right
        return " && ".join(comparisons), COMPARED if len(comparisons) == 1 else AND

    def subscript(self, node: ast.Subscript) -> tuple[str, int]:
        base = base_of(node)
        if not isinstance(base, ast.Name):
            self.function.refuse(node, "only what has a name is subscripted")
        if isinstance(node.slice, ast.Slice):
            if node.slice.upper or node.slice.lower is None:
                self.function.refuse(node, "a part of an array is array[first:]")
            return self.part(base.id, node.slice.lower)
        return self.item(base.id, indices_of(node)), ITEM

    def is_row(self, node: ast.expr) -> bool:
        """Whether an expression is a call that gives several numbers."""
        return isinstance(node, ast.Call) and is_row(self.type_of(node))

    # -- statements ---------------------------------------------------------------------------

    def line(self, text: str) -> None:
        """A line, wrapped at blanks where it is long."""
        indent = STEP * self.depth
        wide = WIDTH - len(indent) - 8 if len(indent + text) > WIDTH else WIDTH
        parts = textwrap.wrap(text, wide, break_long_words=False, break_on_hyphens=False)
        for i, part in enumerate(parts, 1):
            end = self.go_on if i < len(parts) else ""
            self.lines.append(f"{indent}{STEP if i > 1 else ''}{part}{end}")

    def block(self, body: Sequence[ast.stmt], names: Set[str]) -> None:
        """names : those that nothing outside of it asks for."""
        self.depth += 1
        for statement in body:
            self.statement(statement)
        self.depth -= 1

    def statement(self, node: ast.stmt) -> None:
        names = self.inner
        match node:
            case ast.Assign():
                self.assign(node)
            case ast.AugAssign(target=target, op=op, value=value):
                self.change(target, _SIGNS[type(op)], value)
            case ast.If():
                self.branches(node, names)
            case ast.While(test=test, body=body):
                self.line(self.while_.format(self.text(test)))
                self.block(body, names)
                self.line(self.end)
            case ast.For(target=ast.Name(id=name), iter=ast.Call(args=[*first, last]), body=body):
                if len(first) > 1:
                    self.function.refuse(node, "a range counts by one")
                self.line(self.counted(name, self.text(first[0], SUM) if first else "0", last))
                self.block(body, names - {name})
                self.line(self.end)
            case ast.Return(value=value):
                self.give(value)
            case ast.Expr(value=ast.Constant()) | ast.Pass():
                pass
            case ast.Expr(value=ast.Call() as call):
                self.invoke(call)
            case ast.Break():
                self.line("break;")
            case ast.Continue():
                self.line("continue;")
            case _:
                self.function.refuse(node, f"{type(node).__name__} is not written")

    def test(self, node: ast.expr) -> str:
        """The test of an `if`."""
        return self.text(node)

    def follows(self, test: ast.expr, names: Set[str]) -> bool:
        """Whether a test may stand behind an `else`."""
        return not names & words(test)

    def branches(self, node: ast.If, names: Set[str]) -> None:
        self.line(self.if_.format(self.test(node.test)))
        self.block(node.body, names)
        rest = node.orelse
        while (
            len(rest) == 1 and isinstance(one := rest[0], ast.If) and self.follows(one.test, names)
        ):
            self.line(self.elif_.format(self.text(one.test)))
            self.block(one.body, names)
            rest = one.orelse
        if rest:
            self.line(self.else_)
            self.block(rest, names)
        self.line(self.end)

    def new(self, word: str) -> str:
        """A name for a temporary value."""
        self.temporary += 1
        return f"{word}_{self.temporary}_"

    def assign(self, node: ast.Assign) -> None:
        """One value to one or several targets, or a tuple of them to as many."""
        if len(node.targets) > 1:
            self.assign_to_all(node.targets, node.value)
            return
        target = node.targets[0]
        several = pairs(target, node.value)
        if several is None:
            self.unpack(target.elts, node.value)  # type: ignore[attr-defined,arg-type]
        elif one_by_one(several):
            for one, value in several:
                self.assign_one(one, value)
        else:
            kept = [self.keep(value) for _, value in several]
            for (one, _), text in zip(several, kept, strict=True):
                self.put(one, text)

    def at_once(self, statement: ast.Assign, name: str) -> bool:
        """Whether a statement gives a name its value before it asks for it."""
        return name not in words(statement.value) and name in given_names(statement)

    def assign_to_all(self, targets: Sequence[ast.expr], value: ast.expr) -> None:
        if isinstance(value, ast.Constant):
            for target in targets:
                self.assign_one(target, value)
            return
        text = self.keep(value)
        for target in targets:
            self.put(target, text)

    def assign_one(self, target: ast.expr, value: ast.expr) -> None:
        if isinstance(target, ast.Name):
            if made_array(value):
                self.make_array(target.id)
                return
            if target.id in self.function.aliases:
                self.make_alias(target.id)
                return
            if self.is_row(value):
                self.keep_row(target.id, value)  # type: ignore[arg-type]
                return
        if isinstance(target, ast.Subscript) and isinstance(part := target.slice, ast.Slice):
            if part.lower is not None or part.upper is None:
                self.function.refuse(target, "a part that is copied is array[:last]")
            self.copy_part(self.text(base_of(target)), self.text(part.upper), self.text(value))
            return
        self.put(target, self.text(value))

    def changed(self, target: ast.expr) -> str:
        """A target as it stands where it is assigned."""
        return self.text(target)

    def put(self, target: ast.expr, text: str) -> None:
        if not (isinstance(target, ast.Name) and target.id == "_"):
            self.line(f"{self.changed(target)} = {text};")

    def keep(self, value: ast.expr) -> str:
        name = self.new("kept")
        self.line(f"{self.type_word(value)}{name} = {self.text(value)};")
        return name

    def keep_row(self, name: str, value: ast.Call) -> None:
        """Several numbers that a function gives, in an array of this name."""
        self.invoke(value, self.names.of(name))

    def unpack(self, targets: Sequence[ast.expr], value: ast.Call) -> None:
        name = self.new("pair")
        self.invoke(value, name)
        for i, target in enumerate(targets):
            self.put(target, self.place(name, i))
