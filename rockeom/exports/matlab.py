"""A generated module as one file of MATLAB, which Octave runs as well."""

import ast
from collections.abc import Sequence
from typing import Any

import numpy as np

from rockeom.compiler.types import NOTHING
from rockeom.exports.closed import Function, Names, base_of
from rockeom.exports.writer import ITEM, POWER, PRODUCT, SIGNED, SUM, Writer

_WORDS = """
break case catch classdef continue do else elseif end end_try_catch end_unwind_protect
endclassdef endenumeration endevents endfor endfunction endif endmethods endparfor endproperties
endswitch endwhile enumeration events for function global if methods otherwise parfor persistent
properties return spmd switch try until unwind_protect unwind_protect_cleanup while arguments
endarguments endspmd abs acos acosh all any asin asinh atan atanh cos cosh disp either error exp
expm1 fix floor inf Inf isfinite log log1p max min nan NaN numel ones pi power sin sinh size
sqrt sum tan tanh true false zeros ans eps i1 nargin nargout result model m
"""
"""Words of MATLAB and Octave, and the functions that are called here."""
RESERVED = frozenset(_WORDS.split())


class MatlabWriter(Writer):
    """One function of MATLAB. Arrays that it changes are given back, behind its value."""

    or_, not_, unequal = "||", "~", "~="
    go_on = " ..."

    # -- expressions --------------------------------------------------------------------------

    def number(self, value: Any) -> str:
        if isinstance(value, bool):
            return "true" if value else "false"
        if isinstance(value, float) and not np.isfinite(value):
            return "NaN" if value != value else "Inf"
        return repr(value)

    def power(self, base: ast.expr, exponent: ast.expr) -> tuple[str, int]:
        return f"{self.text(base, ITEM)}^{self.text(exponent, ITEM)}", POWER

    def either(self, test: ast.expr, one: ast.expr, other: ast.expr) -> tuple[str, int]:
        return f"either({self.text(test)}, {self.text(one)}, {self.text(other)})", ITEM

    def index(self, node: ast.expr, first: ast.expr | None = None, further: int = 1) -> str:
        """An index, which counts from one; `first` is that of the part of an array."""
        parts = [node] if first is None else [first, node]
        words = []
        for part in parts:
            try:
                further += self.functions.constant(part)
            except LookupError:
                words.append(self.text(part, SUM))
        return " + ".join([*words, *([str(further)] if further or not words else [])])

    def item(self, array: str, indices: Sequence[ast.expr], of_table: bool) -> str:
        if array in self.function.aliases:
            alias = self.function.aliases[array]
            return f"{self.name(alias.array)}({self.index(indices[0], alias.first)})"
        return f"{self.name(array)}({', '.join(self.index(i) for i in indices)})"

    def part(self, array: str, first: ast.expr) -> tuple[str, int]:
        return f"{self.name(array)}({self.index(first)}:end)", ITEM

    def name(self, name: str) -> str:
        if name in self.function.aliases:
            alias = self.function.aliases[name]
            return self.part(alias.array, alias.first)[0]
        return super().name(name)

    def call(self, node: ast.Call) -> tuple[str, int]:
        called = self.functions.by_name[ast.unparse(node.func)]
        if called.fills & set(called.arguments):
            self.function.refuse(node, "an array is changed within an expression")
        return self.called(node), ITEM

    def called(self, node: ast.Call) -> str:
        texts = [self.text(a) for a in node.args]
        return f"{self.names.of(ast.unparse(node.func))}({', '.join(texts)})"

    def library(self, name: str, arguments: Sequence[ast.expr]) -> tuple[str, int]:
        texts = [self.text(a) for a in arguments]
        if name in ("max", "min"):
            return self.of_two(name, texts), ITEM
        name = {"int": "fix"}.get(name, name)
        return f"{name}({', '.join(texts)})", ITEM

    def constant_name(self, name: str) -> str:
        return self.names.of(name)

    # -- statements ---------------------------------------------------------------------------

    def write(self) -> list[str]:
        """The function as lines."""
        for statement in self.function.body:
            self.statement(statement)
        body, self.lines, self.depth = self.lines, [], 0
        arguments = ", ".join(self.names.of(a) for a in self.function.arguments)
        gives = outputs(self.function, self.names)
        left = f"[{', '.join(gives)}] = " if len(gives) > 1 else f"{gives[0]} = " if gives else ""
        self.line(f"function {left}{self.names.of(self.function.name)}({arguments})")
        self.depth = 1
        for name in self.constants:
            self.line(f"{self.names.of(name)} = {table(self.functions.constants[name])};")
        return [*self.lines, *body, "end"]

    def statement(self, node: ast.stmt) -> None:
        match node:
            case ast.Assign():
                self.assign(node)
            case ast.AugAssign(target=target, op=op, value=value):
                sign = {ast.Add: "+", ast.Sub: "-", ast.Mult: "*", ast.Div: "/"}[type(op)]
                level = PRODUCT if sign in "+-" else SIGNED
                blank = " " if level == PRODUCT else ""
                changed = self.text(target)
                self.line(f"{changed} = {changed}{blank}{sign}{blank}{self.text(value, level)};")
            case ast.If():
                self.branches(node)
            case ast.While(test=test, body=body):
                if self.functions.changes(test):
                    self.function.refuse(node, "an array is changed by what a loop asks")
                self.line(f"while {self.text(test)}")
                self.block(body)
                self.line("end")
            case ast.For():
                self.loop(node)
            case ast.Return():
                if node.value is not None:
                    self.give(node.value)
                self.line("return;")
            case ast.Expr(value=ast.Constant()) | ast.Pass():
                pass
            case ast.Expr(value=ast.Call() as call):
                self.invoke(call, None)
            case ast.Break():
                self.line("break;")
            case ast.Continue():
                self.line("continue;")
            case _:
                self.function.refuse(node, f"{type(node).__name__} is not written")

    def test(self, node: ast.expr) -> str:
        """The test of an `if`; calls that change an array are made before it, as far as need be."""
        if not self.functions.changes(node):
            return self.text(node)
        match node:
            case ast.Call():
                name = self.new("so")
                self.invoke(node, name)
                return name
            case ast.UnaryOp(op=ast.Not(), operand=operand):
                return f"~{self.test(operand)}"
            case ast.BoolOp(op=op, values=values):
                name = self.new("so")
                self.line(f"{name} = {self.test(values[0])};")
                for value in values[1:]:
                    self.line(f"if {name if isinstance(op, ast.And) else '~' + name}")
                    self.depth += 1
                    self.line(f"{name} = {self.test(value)};")
                    self.depth -= 1
                    self.line("end")
                return name
        self.function.refuse(node, "an array is changed within an expression")

    def branches(self, node: ast.If) -> None:
        self.line(f"if {self.test(node.test)}")
        self.block(node.body)
        rest = node.orelse
        while (
            len(rest) == 1
            and isinstance(rest[0], ast.If)
            and not self.functions.changes(rest[0].test)
        ):
            self.line(f"elseif {self.text(rest[0].test)}")
            self.block(rest[0].body)
            rest = rest[0].orelse
        if rest:
            self.line("else")
            self.block(rest)
        self.line("end")

    def loop(self, node: ast.For) -> None:
        assert isinstance(node.target, ast.Name)
        arguments = node.iter.args  # type: ignore[attr-defined]
        if len(arguments) > 2:
            self.function.refuse(node, "a range counts by one")
        first = self.text(arguments[0], SUM) if len(arguments) > 1 else "0"
        last = self.index(arguments[-1], further=-1)
        self.line(f"for {self.names.of(node.target.id)} = {first}:{last.replace('+ -', '- ')}")
        self.block(node.body)
        self.line("end")

    def give(self, value: ast.expr) -> None:
        """Return a value."""
        if isinstance(value, ast.Call) and ast.unparse(value.func) in self.functions.by_name:
            self.invoke(value, "result")
        elif isinstance(value, ast.Tuple):
            self.line(f"result = zeros({len(value.elts)}, 1);")
            for i, item in enumerate(value.elts, 1):
                self.line(f"result({i}) = {self.text(item)};")
        else:
            self.line(f"result = {self.text(value)};")

    def invoke(self, node: ast.Call, result: str | None) -> None:
        """A call as a statement: its value, if that is wanted, and the arrays that it changes."""
        called = self.functions.by_name[ast.unparse(node.func)]
        left = []
        if called.returns != NOTHING:
            left.append(result or "~")
        for argument, value in zip(called.arguments, node.args, strict=True):
            if argument in called.fills:
                left.append(self.text(value))
        if left == ["~"]:
            left = []
        equal = f"[{', '.join(left)}] = " if len(left) > 1 else f"{left[0]} = " if left else ""
        self.line(f"{equal}{self.called(node)};")

    def put(self, target: ast.expr, text: str) -> None:
        if not (isinstance(target, ast.Name) and target.id == "_"):
            self.line(f"{self.text(target)} = {text};")

    def assign_one(self, target: ast.expr, value: ast.expr) -> None:
        if isinstance(value, ast.Call) and self.functions.changes(value):
            self.invoke(value, self.text(target))
        else:
            super().assign_one(target, value)

    def keep(self, value: ast.expr) -> str:
        name = self.new("kept")
        self.line(f"{name} = {self.text(value)};")
        return name

    def unpack(self, targets: Sequence[ast.expr], value: ast.expr) -> None:
        assert isinstance(value, ast.Call)
        name = self.new("pair")
        self.invoke(value, name)
        for i, target in enumerate(targets, 1):
            self.put(target, f"{name}({i})")

    def make_array(self, name: str, zeros: bool) -> None:
        self.line(f"{self.names.of(name)} = zeros({self.function.lengths[name]}, 1);")

    def make_alias(self, name: str) -> None:
        """Nothing: it is written out wherever it is used."""

    def keep_row(self, name: str, value: ast.expr) -> None:
        assert isinstance(value, ast.Call)
        self.invoke(value, self.names.of(name))

    def copy(self, target: ast.Subscript, value: ast.expr) -> None:
        part = target.slice
        assert isinstance(part, ast.Slice)
        if part.lower is not None or part.upper is None:
            self.function.refuse(target, "a part that is copied is array[:last]")
        self.line(f"{self.text(base_of(target))}(1:{self.text(part.upper)}) = {self.text(value)};")


def outputs(function: Function, names: Names) -> list[str]:
    """The results of a function: its value, and the arrays that it changes."""
    value = ["result"] if function.returns != NOTHING else []
    return value + [names.of(a) for a in function.filled]


def table(value: Any) -> str:
    """A constant of a text: a number, or a table of them."""
    if isinstance(value, (bool, int, float, np.integer, np.floating)):
        return repr(value if not isinstance(value, np.generic) else value.item())
    rows = value.tolist() if isinstance(value, np.ndarray) else value
    if not rows or not isinstance(rows[0], (tuple, list)):
        return f"[{', '.join(repr(x) for x in rows)}]"
    if not any(rows):
        return f"zeros({len(rows)}, 1)"
    return f"[{'; '.join(', '.join(repr(x) for x in row) for row in rows)}]"
