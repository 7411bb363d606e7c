"""A generated module as one file of MATLAB, which Octave runs as well."""

import ast
from collections.abc import Sequence, Set
from typing import Any, ClassVar

import numpy as np

from rockeom.compiler.types import NOTHING
from rockeom.exports.closed import Function, Names
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

    not_, unequal, go_on, at, first = "~", "~=", " ...", "{}({})", 1
    truths, nan, infinity = ("false", "true"), "NaN", "Inf"
    called: ClassVar = {"int": "fix"}
    if_, elif_, else_, while_, end = "if {}", "elseif {}", "else", "while {}", "end"

    # -- expressions --------------------------------------------------------------------------

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

    def item(self, array: str, indices: Sequence[ast.expr]) -> str:
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

    def call(self, node: ast.Call, *more: str) -> tuple[str, int]:
        if self.functions.by_name[ast.unparse(node.func)].filled:
            self.function.refuse(node, "an array is changed within an expression")
        return super().call(node, *more)

    # -- statements ---------------------------------------------------------------------------

    def write(self) -> list[str]:
        """The function as lines."""
        self.depth = 0
        self.block(self.function.body, self.inner)
        body, self.lines = self.lines, []
        arguments = ", ".join(self.names.of(a) for a in self.function.arguments)
        gives = outputs(self.function, self.names)
        left = f"[{', '.join(gives)}] = " if len(gives) > 1 else f"{gives[0]} = " if gives else ""
        self.line(f"function {left}{self.names.of(self.function.name)}({arguments})")
        self.depth = 1
        for name in self.constants:
            self.line(f"{self.names.of(name)} = {table(self.functions.constants[name])};")
        return [*self.lines, *body, "end"]

    def change(self, target: ast.expr, sign: str, value: ast.expr) -> None:
        level = PRODUCT if sign in "+-" else SIGNED
        blank = " " if level == PRODUCT else ""
        changed = self.text(target)
        self.line(f"{changed} = {changed}{blank}{sign}{blank}{self.text(value, level)};")

    def test(self, node: ast.expr) -> str:
        """Calls that change an array are made before it, as far as need be."""
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

    def follows(self, test: ast.expr, names: Set[str]) -> bool:
        return not self.functions.changes(test)

    def counted(self, counter: str, first: str, last: ast.expr) -> str:
        end = self.index(last, further=-1).replace("+ -", "- ")
        return f"for {self.names.of(counter)} = {first}:{end}"

    def give(self, value: ast.expr | None) -> None:
        if isinstance(value, ast.Call) and ast.unparse(value.func) in self.functions.by_name:
            self.invoke(value, "result")
        elif isinstance(value, ast.Tuple):
            self.line(f"result = zeros({len(value.elts)}, 1);")
            for i, item in enumerate(value.elts):
                self.line(f"{self.place('result', i)} = {self.text(item)};")
        elif value is not None:
            self.line(f"result = {self.text(value)};")
        self.line("return;")

    def invoke(self, node: ast.Call, result: str | None = None) -> None:
        """With the arrays that it changes."""
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
        self.line(f"{equal}{super().call(node)[0]};")

    def assign_one(self, target: ast.expr, value: ast.expr) -> None:
        if isinstance(value, ast.Call) and self.functions.changes(value):
            self.invoke(value, self.text(target))
        else:
            super().assign_one(target, value)

    def make_array(self, name: str) -> None:
        self.line(f"{self.names.of(name)} = zeros({self.function.lengths[name]}, 1);")

    def copy_part(self, array: str, last: str, value: str) -> None:
        self.line(f"{array}(1:{last}) = {value};")


def outputs(function: Function, names: Names) -> list[str]:
    """The results of a function: its value, and the arrays that it changes."""
    value = ["result"] if function.returns != NOTHING else []
    return value + [names.of(a) for a in function.filled]


def table(value: Any) -> str:
    """A constant of a text: a truth, a number, or a table of numbers."""
    if isinstance(value, bool):
        return MatlabWriter.truths[value]
    if isinstance(value, (int, float, np.integer, np.floating)):
        return repr(value if not isinstance(value, np.generic) else value.item())
    rows = value.tolist() if isinstance(value, np.ndarray) else value
    if not rows or not isinstance(rows[0], (tuple, list)):
        return f"[{', '.join(repr(x) for x in rows)}]"
    if not any(rows):
        return f"zeros({len(rows)}, 1)"
    return f"[{'; '.join(', '.join(repr(x) for x in row) for row in rows)}]"
