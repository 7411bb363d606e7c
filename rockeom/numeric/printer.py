"""Plain numeric Python as LLVM's intermediate representation.

Generated modules, steps, the loop and the lanes are written in a closed part of Python: numbers,
tuples of them, arrays that are passed in, calls, `while`, `for ... in range(...)`, `if`. Its
meaning here is that of Python, but for what is said of machine numbers below; everything else is
refused by file and line.

    int       64 bits; what overflows is undefined. a // b and a % b for what cannot be negative
    float     64 bits; no exception: 1.0 / 0.0 is inf, math.sqrt(-1.0) is nan. x**n is a product
              where n is a whole number from 1 to 9
    bool      the only truth: `if`, `while`, `not`, `and`, `or` take nothing else
    tuple     of any of these; indices are constants. One that is an argument is not assigned
    array     of int or float, in C order, never out of bounds: indices are not checked. A negative
              index counts from the end. numpy.empty, zeros and array make one that lasts as long as
              the function's call, of constant size
    variable  one type: that of all values that it is given, float where some are int. Each is
              assigned before it is read, whatever way the function takes

How it works: a function is printed for the types of its arguments, line after line, each variable
a place on the stack, of which LLVM makes registers. Where a later line widens the type of a
variable, the function is printed once more. Nothing but what is marked @inlined is written out
where it is called; a tuple is passed by its place on the stack.

The same text gives the same numbers on every machine, but for `contract`: a*b + c is rounded once
where the text is a fused one and the processor can.
"""

from __future__ import annotations

import ast
import math
import struct
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field
from typing import Any, NamedTuple, NoReturn

import numpy as np

from rockeom.numeric.machine_types import (
    BOOL,
    FLOAT,
    INT,
    MATH,
    NOTHING,
    Array,
    Entry,
    Tuple,
    Type,
)

# -- types and values ----------------------------------------------------------------------------

ANNOTATIONS: dict[str, Type] = {
    "int": INT, "float": FLOAT, "bool": BOOL,
    "Floats": Array(FLOAT, 1), "Floats2": Array(FLOAT, 2), "Floats3": Array(FLOAT, 3),
    "Ints": Array(INT, 1), "Ints2": Array(INT, 2),
}  # fmt: skip


class Value(NamedTuple):
    """A type and what holds it: one operand of LLVM for a scalar; address and shape of an array."""

    type: Type
    parts: tuple[str, ...]


def parts_of(type_: Type) -> tuple[str, ...]:
    """The LLVM types of the parts of a value."""
    if isinstance(type_, Array):
        return ("ptr", *[INT] * type_.dimensions)
    if isinstance(type_, Tuple):
        return tuple(part for item in type_.items for part in parts_of(item))
    return (type_,)


def joined(a: Type, b: Type) -> Type | None:
    """The type that holds values of both, or None."""
    if a == b:
        return a
    if isinstance(a, Tuple) and isinstance(b, Tuple) and len(a.items) == len(b.items):
        items = [joined(x, y) for x, y in zip(a.items, b.items, strict=True)]
        return None if None in items else Tuple(tuple(items))  # type: ignore[arg-type]
    return FLOAT if {a, b} == {FLOAT, INT} else None


def told(type_: Type) -> str:
    """A type in Python's words."""
    if isinstance(type_, Array):
        return f"array of {told(type_.element)} with {type_.dimensions} dimensions"
    if isinstance(type_, Tuple):
        return f"({', '.join(map(told, type_.items))})" if type_.items else "nothing"
    return {FLOAT: "float", INT: "int", BOOL: "bool"}[type_]


def literal(x: float) -> str:
    return f"0x{struct.unpack('<Q', struct.pack('<d', x))[0]:016X}"


# -- what the texts are --------------------------------------------------------------------------


@dataclass(frozen=True)
class Text:
    """A part of a program: its file's name, its source, whether a*b + c may be rounded once."""

    name: str
    source: str
    fused: bool = False


GROWTH = 3000.0
"""Lines; beyond it compiling takes much longer, and calls cost less than code that is far apart."""


class Refused(SyntaxError):  # noqa: N818
    """A text that is not in the closed part of Python, with its file and line."""


class Definition(NamedTuple):
    """A function as it stands in a text."""

    tree: ast.FunctionDef
    text: Text
    marks: frozenset[str]

    def refuse(self, node: ast.AST | None, why: str) -> NoReturn:
        line = getattr(node, "lineno", self.tree.lineno)
        raise Refused(f"{self.text.name}, line {line}, in {self.tree.name}: {why}")


class Program:
    """Texts that know one another's names, and what is printed of them so far.

    contract : False rounds every operation by itself.
    growth : lines by which the program may grow by one function that is written out wherever it is
        called; what would make it longer is called, whatever its mark says.

    The texts are run as Python, but for their functions, to learn their constants.
    """

    def __init__(
        self, texts: Sequence[Text], contract: bool = True, growth: float = GROWTH
    ) -> None:
        self.texts, self.contract, self.growth = texts, contract, growth
        self.names: dict[str, Any] = {"__name__": "rockeom.numeric.program"}
        self.definitions: dict[str, Definition] = {}
        self.printed: dict[tuple[str, tuple[Type, ...]], tuple[str, Type] | None] = {}
        self.bodies: list[str] = []
        self.sizes: dict[str, int] = {}  # lines of each function that is marked @inlined
        self.written_out: set[str] = set()  # those of them that are written out at every call
        self.constants: dict[tuple[str, tuple[int, ...], bytes], str] = {}
        self.declared: dict[str, str] = {}
        self.entries: dict[str, Entry] = {}
        for text in texts:
            tree = ast.parse(text.source, text.name)
            functions = [node for node in tree.body if isinstance(node, ast.FunctionDef)]
            for node in functions:
                marks = frozenset(d.id for d in node.decorator_list if isinstance(d, ast.Name))
                self.definitions[node.name] = Definition(node, text, marks)
            tree.body = [node for node in tree.body if not isinstance(node, ast.FunctionDef)]
            exec(compile(tree, text.name, "exec"), self.names)
        for name, definition in self.definitions.items():
            if "entry" in definition.marks:
                self.entry(name, definition)

    def entry(self, name: str, definition: Definition) -> None:
        """Print a function, and one that takes all its arguments from a row of 64-bit places.

        Arrays come as address and shape. What is returned stands in the place behind them.
        """
        arguments = []
        for argument in definition.tree.args.args:
            annotation = argument.annotation
            known = isinstance(annotation, ast.Name) and annotation.id in ANNOTATIONS
            if not known:
                definition.refuse(argument, f"{argument.arg} has no annotation that is known")
            arguments.append((argument.arg, ANNOTATIONS[annotation.id]))  # type: ignore[union-attr]
        types = tuple(type_ for _, type_ in arguments)
        symbol, returns = self.function(name, types, None, definition)
        if returns not in (FLOAT, INT, BOOL, NOTHING):
            definition.refuse(None, f"an entry returns a number, not {told(returns)}")
        lines, operands = [], []
        parts = [part for type_ in types for part in parts_of(type_)]
        for i, part in enumerate(parts):
            kind = INT if part == BOOL else part
            lines += [f"%p{i} = getelementptr i64, ptr %row, i64 {i}"]
            lines += [f"%x{i} = load {kind}, ptr %p{i}"]
            if part == BOOL:
                lines += [f"%b{i} = icmp ne i64 %x{i}, 0"]
            operands.append(f"{part} %{'b' if part == BOOL else 'x'}{i}")
        call = f"call {_returned(returns)} @{symbol}({', '.join(operands)})"
        if returns == NOTHING:
            lines.append(call)
        else:
            lines += [f"%r = {call}", f"%place = getelementptr i64, ptr %row, i64 {len(parts)}"]
            if returns == BOOL:
                lines += ["%wide = zext i1 %r to i64", "store i64 %wide, ptr %place"]
            else:
                lines.append(f"store {returns} %r, ptr %place")
        body = "\n".join(f"  {line}" for line in [*lines, "ret void"])
        self.bodies.append(f"define void @{name}(ptr %row) nounwind {{\n{body}\n}}")
        self.entries[name] = Entry(tuple(arguments), returns)

    def function(
        self, name: str, types: tuple[Type, ...], node: ast.AST | None, caller: Definition
    ) -> tuple[str, Type]:
        """Symbol and type of what is returned, of a function for these types of arguments."""
        key = name, types
        if key not in self.printed:
            if name not in self.definitions:
                caller.refuse(node, f"no function {name} is known")
            self.printed[key] = None
            symbol = f"{name}.{len(self.printed)}"
            definition = self.definitions[name]
            function = _Function(self, definition, types)
            if "inlined" in definition.marks:
                self.sizes[symbol] = function.size
                if function.size * (self.calls(name) - 1) <= self.growth:
                    self.written_out.add(symbol)
            self.bodies.append(function.body(symbol))
            self.printed[key] = symbol, function.returns
        found = self.printed[key]
        if found is None:
            caller.refuse(node, f"{name} calls itself")
        return found

    def calls(self, name: str) -> int:
        """How often a function is called in the texts, or a little more: words are counted."""
        return sum(text.source.count(f"{name}(") for text in self.texts) - 1  # its definition

    def constant(self, value: Any) -> Value | None:
        """A table of numbers as an array of the program, or None if it is none."""
        try:
            table = np.array(value)
        except ValueError:  # rows of different lengths
            return None
        if table.dtype.kind not in "if":
            return None
        element = FLOAT if table.dtype.kind == "f" else INT
        key = element, table.shape, table.tobytes()
        if key not in self.constants:
            self.constants[key] = f"@table.{len(self.constants)}"
        return Value(Array(element, table.ndim), (self.constants[key], *map(str, table.shape)))

    def ir(self) -> str:
        """All that is printed so far."""
        tables = []
        for (element, _, data), name in self.constants.items():
            numbers = np.frombuffer(data, np.float64 if element == FLOAT else np.int64).tolist()
            items = ", ".join(f"{element} {literal(x) if element == FLOAT else x}" for x in numbers)
            tables.append(
                f"{name} = private unnamed_addr constant [{len(numbers)} x {element}] [{items}]"
            )
        declared = [f"declare {text}" for text in self.declared.values()]
        return "\n".join([*tables, *declared, *self.bodies]) + "\n"


def _returned(type_: Type) -> str:
    """LLVM's type of what a function returns."""
    parts = parts_of(type_)
    if not parts:
        return "void"
    return parts[0] if len(parts) == 1 else "{ " + ", ".join(parts) + " }"


# -- one function --------------------------------------------------------------------------------


class _Later(Exception):  # noqa: N818
    """A variable whose type is not known yet: the function is printed again when it is."""


class _NotConstant(Exception):  # noqa: N818
    """An expression whose value is not known before the program runs."""


@dataclass
class _Loop:
    """Where `continue` and `break` go, and what is assigned wherever `break` leaves it."""

    again: str
    end: str
    broken: list[set[str]] = field(default_factory=list)


class _Function:
    """Prints one function for one set of types."""

    def __init__(self, program: Program, definition: Definition, types: tuple[Type, ...]) -> None:
        self.program, self.definition = program, definition
        self.refuse = definition.refuse
        tree = definition.tree
        arguments = tree.args
        if (
            arguments.vararg or arguments.kwarg or arguments.kwonlyargs or arguments.defaults
            or arguments.posonlyargs
        ):  # fmt: skip
            self.refuse(None, "arguments have names, and no default values")
        self.arguments = [a.arg for a in arguments.args]
        if len(self.arguments) != len(types):
            self.refuse(None, f"it takes {len(self.arguments)} arguments, and got {len(types)}")
        self.locals = _stored(tree) | set(self.arguments)
        fused = program.contract and (definition.text.fused or "fused" in definition.marks)
        self.fast = "contract " if fused else ""
        self.types: dict[str, Type] = dict(zip(self.arguments, types, strict=True))
        self.returns: Type = NOTHING
        self.returned = False
        while True:
            self._start()
            self._block(tree.body)
            if self.open and self.returned and self.returns != NOTHING:
                self.refuse(tree.body[-1], "it ends without `return`")
            if not self.changed:
                break
        self.size += len(self.lines)
        if self.later is not None:
            self.refuse(self.later, "the type of this cannot be found out")

    def _start(self) -> None:
        self.lines: list[str] = []
        self.head: list[str] = []
        self.count = 0
        self.size = 0  # lines of what is written out in this function
        self.open = True  # whether the block that is being printed can be reached and goes on
        self.label = "entry"
        self.loops: list[_Loop] = []
        self.assigned = set(self.arguments)
        self.natural: set[str] = set()  # variables of loops, while they cannot be negative
        self.changed = False
        self.later: ast.AST | None = None

    def body(self, symbol: str) -> str:
        """The whole function as text."""
        head, operands = [], []
        for name, type_ in self.types.items():
            parts = list(enumerate(parts_of(type_)))
            if isinstance(type_, Tuple):
                whole = self._whole(name)
                if name in self.arguments:
                    operands.append(f"ptr noalias readonly {whole}")
                else:
                    head.append(f"  {whole} = alloca i64, i64 {len(parts)}")
                head += [
                    f"  %{name}.{i} = getelementptr i64, ptr {whole}, i64 {i}" for i, _ in parts
                ]
                continue
            head += [f"  %{name}.{i} = alloca {part}" for i, part in parts]
            if name in self.arguments:
                operands += [f"{part} %in.{name}.{i}" for i, part in parts]
                head += [f"  store {part} %in.{name}.{i}, ptr %{name}.{i}" for i, part in parts]
        inline = "noinline " if "apart" in self.definition.marks else ""
        end = []
        if self.open:
            end = ["  ret void"] if self.returns == NOTHING else ["  unreachable"]
        return "\n".join(
            [
                f"define internal {_returned(self.returns)} @{symbol}({', '.join(operands)}) "
                f"{inline}nounwind {{",
                "entry:",
                *head,
                *self.head,
                *self.lines,
                *end,
                "}",
            ]
        )

    # -- lines ------------------------------------------------------------------------------

    def _line(self, text: str) -> None:
        self.lines.append(f"  {text}")

    def _new(self, text: str) -> str:
        """Print an operation; returns the name of its result."""
        self.count += 1
        name = f"%t{self.count}"
        self.lines.append(f"  {name} = {text}")
        return name

    def _label(self) -> str:
        self.count += 1
        return f"L{self.count}"

    def _begin(self, label: str) -> None:
        self.lines.append(f"{label}:")
        self.label, self.open = label, True

    def _jump(self, label: str) -> None:
        self._line(f"br label %{label}")
        self.open = False

    def _on_stack(self, element: str, size: int = 1) -> str:
        """A place that lasts as long as the call."""
        self.count += 1
        name = f"%s{self.count}"
        self.head.append(f"  {name} = alloca {element}, i64 {size}, align {8 if size == 1 else 64}")
        return name

    def _whole(self, name: str) -> str:
        """Where the parts of a tuple begin, in 64 bits each: what a call of a function passes."""
        return f"%{'in' if name in self.arguments else 'all'}.{name}"

    # -- constants ----------------------------------------------------------------------------

    def _known(self, node: ast.expr) -> Any:
        """The value of an expression of constants alone; raises _NotConstant for any other."""
        if isinstance(node, ast.Constant):
            return node.value
        if isinstance(node, ast.Name):
            if node.id in self.locals or node.id not in self.program.names:
                raise _NotConstant
            value = self.program.names[node.id]
            if callable(value):
                raise _NotConstant
            return value
        if isinstance(node, ast.Attribute):
            if isinstance(node.value, ast.Name) and node.value.id in ("math", "np"):
                value = getattr(self.program.names[node.value.id], node.attr, None)
                if isinstance(value, float):
                    return value
            raise _NotConstant
        if isinstance(node, ast.UnaryOp) and type(node.op) in _KNOWN_UNARY:
            return _KNOWN_UNARY[type(node.op)](self._known(node.operand))
        if isinstance(node, ast.BinOp) and type(node.op) in _KNOWN_BINARY:
            return _KNOWN_BINARY[type(node.op)](self._known(node.left), self._known(node.right))
        if isinstance(node, ast.Compare) and len(node.ops) == 1:
            compare = _KNOWN_COMPARED.get(type(node.ops[0]))
            if compare is not None:
                return compare(self._known(node.left), self._known(node.comparators[0]))
        if isinstance(node, ast.Subscript) and not isinstance(node.slice, ast.Slice):
            return self._known(node.value)[self._known(node.slice)]
        if isinstance(node, ast.Tuple):
            return tuple(map(self._known, node.elts))
        if isinstance(node, ast.Call) and isinstance(node.func, ast.Name) and node.func.id == "len":
            return len(self._known(node.args[0]))
        raise _NotConstant

    def _maybe(self, node: ast.expr) -> Any:
        """The value of an expression of constants, or None."""
        try:
            return self._known(node)
        except _NotConstant:
            return None

    def _literal(self, value: Any, node: ast.expr) -> Value:
        if isinstance(value, bool | np.bool_):
            return Value(BOOL, ("true" if value else "false",))
        if isinstance(value, int | np.integer):
            return Value(INT, (str(int(value)),))
        if isinstance(value, float | np.floating):
            return Value(FLOAT, (literal(float(value)),))
        if isinstance(value, tuple):
            return _tuple([self._literal(item, node) for item in value])
        found = self.program.constant(value) if isinstance(value, np.ndarray) else None
        if found is None:
            self.refuse(node, f"{type(value).__name__} is no number and no table of numbers")
        return found

    # -- expressions --------------------------------------------------------------------------

    def _value(self, node: ast.expr) -> Value:
        try:
            known = self._known(node)
        except _NotConstant:
            pass
        else:
            return self._literal(known, node)
        print_it = getattr(self, f"_{type(node).__name__.lower()}", None)
        if print_it is None:
            self.refuse(node, f"{type(node).__name__} is not among the expressions")
        return print_it(node)

    def _number(self, node: ast.expr) -> Value:
        value = self._value(node)
        if value.type not in (FLOAT, INT):
            self.refuse(node, f"a number is wanted, and this is {told(value.type)}")
        return value

    def _float(self, node: ast.expr) -> str:
        return self._as(self._number(node), FLOAT, node).parts[0]

    def _int(self, node: ast.expr) -> str:
        value = self._value(node)
        if value.type != INT:
            self.refuse(node, f"a whole number is wanted, and this is {told(value.type)}")
        return value.parts[0]

    def _as(self, value: Value, type_: Type, node: ast.AST) -> Value:
        """The same value as one of a wider type."""
        if value.type == type_:
            return value
        if value.type == INT and type_ == FLOAT:
            operand = value.parts[0]
            if not operand.startswith("%"):
                return Value(FLOAT, (literal(float(int(operand))),))
            return Value(FLOAT, (self._new(f"sitofp i64 {operand} to double"),))
        if isinstance(value.type, Tuple) and isinstance(type_, Tuple):
            return _tuple(
                [self._as(_item(value, i), item, node) for i, item in enumerate(type_.items)]
            )
        self.refuse(node, f"{told(value.type)} where {told(type_)} is wanted")

    def _type_of(self, node: ast.Name) -> Type:
        """The type of a variable that is read."""
        if node.id not in self.locals:
            self.refuse(node, f"{node.id} is not known")
        if node.id not in self.assigned:
            self.refuse(node, f"{node.id} may be read before it is assigned")
        if node.id not in self.types:
            raise _Later
        return self.types[node.id]

    def _name(self, node: ast.Name) -> Value:
        type_ = self._type_of(node)
        loads = [f"load {p}, ptr %{node.id}.{i}" for i, p in enumerate(parts_of(type_))]
        return Value(type_, tuple(map(self._new, loads)))

    def _tuple(self, node: ast.Tuple) -> Value:
        return _tuple([self._value(item) for item in node.elts])

    def _attribute(self, node: ast.Attribute) -> Value:
        value = self._value(node.value)
        if node.attr != "shape" or not isinstance(value.type, Array):
            self.refuse(node, f".{node.attr} is not known")
        return Value(Tuple((INT,) * value.type.dimensions), value.parts[1:])

    def _unaryop(self, node: ast.UnaryOp) -> Value:
        if isinstance(node.op, ast.Not | ast.Invert):
            value = self._value(node.operand)
            if value.type != BOOL:
                self.refuse(node, f"`not` and ~ take a bool, and this is {told(value.type)}")
            return Value(BOOL, (self._new(f"xor i1 {value.parts[0]}, true"),))
        value = self._number(node.operand)
        if isinstance(node.op, ast.UAdd):
            return value
        if value.type == INT:
            return Value(INT, (self._new(f"sub nsw i64 0, {value.parts[0]}"),))
        return Value(FLOAT, (self._new(f"fneg {self.fast}double {value.parts[0]}"),))

    def _binop(self, node: ast.BinOp) -> Value:
        if isinstance(node.op, ast.Pow):
            return self._power(node)
        left, right = self._value(node.left), self._value(node.right)
        return self._arithmetic(node.op, left, right, node)

    def _arithmetic(self, op: ast.operator, left: Value, right: Value, node: ast.expr) -> Value:
        word = type(op).__name__
        if (left.type, right.type) == (BOOL, BOOL) and word in ("BitAnd", "BitOr"):
            name = "and" if word == "BitAnd" else "or"
            return Value(BOOL, (self._new(f"{name} i1 {left.parts[0]}, {right.parts[0]}"),))
        for value in (left, right):
            if value.type not in (FLOAT, INT):
                self.refuse(node, f"no arithmetic with {told(value.type)}")
        if word == "Div" or FLOAT in (left.type, right.type):
            if word not in _OF_FLOATS:
                self.refuse(node, f"{word} of floats is not among the operations")
            a, b = self._as(left, FLOAT, node), self._as(right, FLOAT, node)
            line = f"{_OF_FLOATS[word]} {self.fast}double {a.parts[0]}, {b.parts[0]}"
            return Value(FLOAT, (self._new(line),))
        if word not in _OF_INTS:
            self.refuse(node, f"{word} of ints is not among the operations")
        if word in ("FloorDiv", "Mod"):
            sides = (node.left, node.right) if isinstance(node, ast.BinOp) else ()
            if not sides or not all(map(self._is_natural, sides)):
                self.refuse(node, "// and % are for numbers that clearly cannot be negative")
        line = f"{_OF_INTS[word]} i64 {left.parts[0]}, {right.parts[0]}"
        return Value(INT, (self._new(line),))

    def _power(self, node: ast.BinOp) -> Value:
        """By repeated squares where the exponent is a small whole number."""
        n = self._maybe(node.right)
        if isinstance(n, bool) or not isinstance(n, int) or not 0 < n < 10:
            return self._external("llvm.pow.f64", [self._float(node.left), self._float(node.right)])
        square, power = self._number(node.left), None
        while True:
            if n & 1:
                power = square if power is None else self._times(power, square, node)
            n >>= 1
            if not n:
                assert power is not None
                return power
            square = self._times(square, square, node)

    def _times(self, a: Value, b: Value, node: ast.expr) -> Value:
        return self._arithmetic(ast.Mult(), a, b, node)

    def _compare(self, node: ast.Compare) -> Value:
        """All comparisons of a chain; the values in it have no side effects."""
        values = [node.left, *node.comparators]
        left = self._value(node.left)
        every: str | None = None
        for op, second in zip(node.ops, values[1:], strict=True):
            if isinstance(op, ast.In | ast.NotIn):
                one = self._among(left, op, second)
            else:
                right = self._value(second)
                one, left = self._compared(op, left, right, node), right
            every = one if every is None else self._new(f"and i1 {every}, {one}")
        assert every is not None
        return Value(BOOL, (every,))

    def _among(self, left: Value, op: ast.cmpop, items: ast.expr) -> str:
        if not isinstance(items, ast.Tuple):
            self.refuse(items, "`in` takes a tuple that is written out")
        found = "false"
        for item in items.elts:
            one = self._compared(ast.Eq(), left, self._value(item), item)
            found = self._new(f"or i1 {found}, {one}")
        return found if isinstance(op, ast.In) else self._new(f"xor i1 {found}, true")

    def _compared(self, op: ast.cmpop, left: Value, right: Value, node: ast.AST) -> str:
        word = type(op).__name__
        if word not in _COMPARED:
            self.refuse(node, f"{word} is not among the comparisons")
        of_floats, of_ints = _COMPARED[word]
        if (left.type, right.type) == (BOOL, BOOL) and word in ("Eq", "NotEq"):
            return self._new(f"icmp {of_ints} i1 {left.parts[0]}, {right.parts[0]}")
        for value in (left, right):
            if value.type not in (FLOAT, INT):
                self.refuse(node, f"no comparison with {told(value.type)}")
        if left.type == right.type == INT:
            return self._new(f"icmp {of_ints} i64 {left.parts[0]}, {right.parts[0]}")
        a, b = self._as(left, FLOAT, node), self._as(right, FLOAT, node)
        return self._new(f"fcmp {of_floats} double {a.parts[0]}, {b.parts[0]}")

    def _boolop(self, node: ast.BoolOp) -> Value:
        yes, no, end = self._label(), self._label(), self._label()
        self._branch(node, yes, no)
        for label in (yes, no):
            self._begin(label)
            self._jump(end)
        self._begin(end)
        return Value(BOOL, (self._new(f"phi i1 [true, %{yes}], [false, %{no}]"),))

    def _branch(self, test: ast.expr, yes: str, no: str) -> None:
        """Jump to one of two labels, looking at no more of a test than decides it."""
        known = self._maybe(test)
        if known is not None:
            self._jump(yes if known else no)
        elif isinstance(test, ast.BoolOp):
            for part in test.values[:-1]:
                go_on = self._label()
                self._branch(part, *((go_on, no) if isinstance(test.op, ast.And) else (yes, go_on)))
                self._begin(go_on)
            self._branch(test.values[-1], yes, no)
        elif isinstance(test, ast.UnaryOp) and isinstance(test.op, ast.Not):
            self._branch(test.operand, no, yes)
        else:
            value = self._value(test)
            if value.type != BOOL:
                self.refuse(test, f"a test is a bool, and this is {told(value.type)}")
            self._line(f"br i1 {value.parts[0]}, label %{yes}, label %{no}")
            self.open = False

    def _ifexp(self, node: ast.IfExp) -> Value:
        known = self._maybe(node.test)
        if known is not None:
            return self._value(node.body if known else node.orelse)
        yes, no, end = self._label(), self._label(), self._label()
        self._branch(node.test, yes, no)
        found: list[tuple[Value, str]] = []
        marks = []
        for label, choice in ((yes, node.body), (no, node.orelse)):
            self._begin(label)
            found.append((self._value(choice), self.label))
            marks.append(len(self.lines))
        (first, from_first), (second, from_second) = found
        type_ = joined(first.type, second.type)
        if type_ is None:
            self.refuse(node, f"either {told(first.type)} or {told(second.type)}")
        # casts go to the ends of both blocks
        after = self.lines[marks[0] :]
        self.lines = self.lines[: marks[0]]
        first = self._as(first, type_, node)
        self._jump(end)
        self.lines += after
        second = self._as(second, type_, node)
        self._jump(end)
        self._begin(end)
        pairs = zip(parts_of(type_), first.parts, second.parts, strict=True)
        return Value(
            type_,
            tuple(
                self._new(f"phi {part} [{a}, %{from_first}], [{b}, %{from_second}]")
                for part, a, b in pairs
            ),
        )

    # -- arrays and tuples --------------------------------------------------------------------

    def _is_natural(self, node: ast.expr) -> bool:
        """Whether a whole number clearly cannot be negative, by what it is made of."""
        known = self._maybe(node)
        if known is not None:
            return known >= 0
        if isinstance(node, ast.Name):
            return node.id in self.natural
        if isinstance(node, ast.BinOp) and isinstance(
            node.op, ast.Add | ast.Mult | ast.FloorDiv | ast.Mod
        ):
            return self._is_natural(node.left) and self._is_natural(node.right)
        if isinstance(node, ast.Subscript):  # of a shape
            return isinstance(node.value, ast.Attribute) and node.value.attr == "shape"
        return isinstance(node, ast.Call) and getattr(node.func, "id", "") == "len"

    def _index(self, node: ast.expr, length: str) -> str:
        """An index as an operand; a negative one counts from the end."""
        operand = self._int(node)
        if self._is_natural(node):
            return operand
        if not operand.startswith("%"):
            return self._new(f"add nsw i64 {length}, {operand}")
        below = self._new(f"icmp slt i64 {operand}, 0")
        from_end = self._new(f"add nsw i64 {operand}, {length}")
        return self._new(f"select i1 {below}, i64 {from_end}, i64 {operand}")

    def _place(self, array: Value, indices: Sequence[ast.expr], node: ast.AST) -> Value:
        """What stands at some indices of an array, as an array of the dimensions that are left."""
        assert isinstance(array.type, Array)
        left = array.type.dimensions - len(indices)
        if left < 0:
            self.refuse(node, f"{len(indices)} indices of an {told(array.type)}")
        shape = array.parts[1:]
        at = ""
        for d, index in enumerate(indices):
            operand = self._index(index, shape[d])
            at = self._new(f"add nsw i64 {at}, {operand}") if at else operand
            if d + 1 < array.type.dimensions:
                at = self._new(f"mul nsw i64 {at}, {shape[d + 1]}")
        for length in shape[len(indices) + 1 :]:
            at = self._new(f"mul nsw i64 {at}, {length}")
        address = self._address(array, at)
        return Value(Array(array.type.element, left), (address, *shape[len(indices) :]))

    def _address(self, array: Value, at: str) -> str:
        assert isinstance(array.type, Array)
        line = f"getelementptr inbounds {array.type.element}, ptr {array.parts[0]}, i64 {at}"
        return self._new(line)

    def _part(self, node: ast.Subscript) -> Value:
        """What is subscripted, as an array without dimensions if it is a single number of one."""
        indices: list[ast.expr] = []
        base: ast.expr = node
        table = None
        while isinstance(base, ast.Subscript) and not isinstance(base.slice, ast.Slice):
            here = base.slice.elts if isinstance(base.slice, ast.Tuple) else [base.slice]
            indices[:0] = here
            base = base.value
            known = self._maybe(base)
            table = None if known is None else self.program.constant(known)
            if table is not None:
                break
        value = self._value(base) if table is None else table
        while indices and isinstance(value.type, Tuple):
            number = self._maybe(indices[0])
            if isinstance(number, bool) or not isinstance(number, int):
                self.refuse(node, "the index of a tuple is a constant")
            if not -len(value.type.items) <= number < len(value.type.items):
                self.refuse(node, f"a tuple of {len(value.type.items)} has no item {number}")
            value = _item(value, number % len(value.type.items))
            del indices[0]
        if not indices:
            return value
        if not isinstance(value.type, Array):
            self.refuse(node, f"{told(value.type)} has no items")
        return self._place(value, indices, node)

    def _subscript(self, node: ast.Subscript) -> Value:
        if isinstance(node.slice, ast.Slice):
            return self._slice(node, node.slice)
        found = self._part(node)
        if isinstance(found.type, Array) and found.type.dimensions == 0:
            element = found.type.element
            return Value(element, (self._new(f"load {element}, ptr {found.parts[0]}"),))
        return found

    def _slice(self, node: ast.Subscript, part: ast.Slice) -> Value:
        """From one index of the first dimension to another; they are not cut to the length."""
        array = self._value(node.value)
        if not isinstance(array.type, Array) or part.step is not None:
            self.refuse(node, "a slice is array[first:last]")
        _, length, *others = array.parts
        first = "0" if part.lower is None else self._index(part.lower, length)
        last = length if part.upper is None else self._index(part.upper, length)
        at = first
        for other in others:
            at = self._new(f"mul nsw i64 {at}, {other}")
        count = self._new(f"sub nsw i64 {last}, {first}")
        return Value(array.type, (self._address(array, at), count, *others))

    def _made_array(self, node: ast.Call, how: str) -> Value:
        """numpy.empty, zeros and array: on the stack, of constant shape."""
        if how == "array":
            listed = node.args[0]
            if not isinstance(listed, ast.List) or len(node.args) != 1:
                self.refuse(node, "np.array takes a list of numbers that is written out")
            numbers = [self._number(item) for item in listed.elts]
            element = FLOAT if any(v.type == FLOAT for v in numbers) else INT
            array = self._new_array(element, (len(numbers),))
            for i, number in enumerate(numbers):
                operand = self._as(number, element, node).parts[0]
                self._line(f"store {element} {operand}, ptr {self._address(array, str(i))}")
            return array
        shape = self._maybe(node.args[0])
        shape = (shape,) if isinstance(shape, int) else shape
        if not isinstance(shape, tuple) or not all(isinstance(n, int) for n in shape):
            self.refuse(node, "the shape of an array is constant")
        element = INT if len(node.args) > 1 else FLOAT
        array = self._new_array(element, shape)
        if how == "zeros" and math.prod(shape):
            self.program.declared["llvm.memset.p0.i64"] = (
                "void @llvm.memset.p0.i64(ptr, i8, i64, i1)"
            )
            self._line(
                f"call void @llvm.memset.p0.i64(ptr {array.parts[0]}, i8 0, "
                f"i64 {8 * math.prod(shape)}, i1 false)"
            )
        return array

    def _new_array(self, element: str, shape: tuple[int, ...]) -> Value:
        place = self._on_stack(element, max(math.prod(shape), 1))
        return Value(Array(element, len(shape)), (place, *map(str, shape)))

    # -- calls --------------------------------------------------------------------------------

    def _call(self, node: ast.Call) -> Value:
        function = node.func
        if node.keywords or any(isinstance(a, ast.Starred) for a in node.args):
            self.refuse(node, "arguments are given by their place")
        if isinstance(function, ast.Attribute) and isinstance(function.value, ast.Name):
            return self._library_call(node, function.value.id, function.attr)
        if not isinstance(function, ast.Name) or function.id in self.locals:
            self.refuse(node, "only functions with a name of their own are called")
        built_in = getattr(self, f"_call_{function.id}", None)
        if built_in is not None and function.id not in self.program.definitions:
            return built_in(node, [self._value(a) for a in node.args])
        given = [self._given(a) for a in node.args]
        types = tuple(type_ for type_, _ in given)
        symbol, returns = self.program.function(function.id, types, node, self.definition)
        operands = ", ".join(operand for _, operands in given for operand in operands)
        call = f"call {_returned(returns)} @{symbol}({operands})"
        if self._written_out(symbol, node):
            self.size += self.program.sizes[symbol]
            call += " alwaysinline"
        count = len(parts_of(returns))
        if count == 0:
            self._line(call)
            return Value(NOTHING, ())
        result = self._new(call)
        if count == 1:
            return Value(returns, (result,))
        type_ = _returned(returns)
        return Value(
            returns,
            tuple(self._new(f"extractvalue {type_} {result}, {i}") for i in range(count)),
        )

    def _written_out(self, symbol: str, node: ast.Call) -> bool:
        """Whether a function is written out at this call."""
        if symbol not in self.program.sizes or symbol in self.program.written_out:
            return symbol in self.program.written_out
        # where an argument is a constant, little of it may be left
        folds = any(self._maybe(argument) is not None for argument in node.args)
        return folds and 3 * self.program.sizes[symbol] <= self.program.growth

    def _given(self, node: ast.expr) -> tuple[Type, list[str]]:
        """Type and operands of an argument of a call; a tuple is passed by its place."""
        if isinstance(node, ast.Name) and node.id in self.locals:
            type_ = self._type_of(node)
            if isinstance(type_, Tuple):
                return type_, [f"ptr {self._whole(node.id)}"]
        value = self._value(node)
        parts = list(zip(parts_of(value.type), value.parts, strict=True))
        if not isinstance(value.type, Tuple):
            return value.type, [f"{part} {operand}" for part, operand in parts]
        whole = self._on_stack(INT, max(len(parts), 1))
        for i, (part, operand) in enumerate(parts):
            place = self._new(f"getelementptr i64, ptr {whole}, i64 {i}")
            self._line(f"store {part} {operand}, ptr {place}")
        return value.type, [f"ptr {whole}"]

    def _library_call(self, node: ast.Call, library: str, name: str) -> Value:
        if library == "np" and name in ("empty", "zeros", "array"):
            return self._made_array(node, name)
        if library == "np" and name == "int64":
            return self._call_int(node, [self._value(a) for a in node.args])
        if library != "math":
            self.refuse(node, f"{library}.{name} is not among the functions")
        if name == "isfinite":
            x = self._float(node.args[0])
            none = self._new(f"fsub double {x}, {x}")
            return Value(BOOL, (self._new(f"fcmp oeq double {none}, {literal(0.0)}"),))
        if name not in MATH or len(node.args) != 1:
            self.refuse(node, f"math.{name} of {len(node.args)} is not among the functions")
        return self._external(MATH[name], [self._float(node.args[0])])

    def _external(self, name: str, operands: list[str]) -> Value:
        self.program.declared[name] = f"double @{name}({', '.join(['double'] * len(operands))})"
        given = ", ".join(f"double {operand}" for operand in operands)
        return Value(FLOAT, (self._new(f"call {self.fast}double @{name}({given})"),))

    def _call_abs(self, node: ast.Call, values: list[Value]) -> Value:
        (value,) = values
        if value.type == FLOAT:
            return self._external("llvm.fabs.f64", [value.parts[0]])
        if value.type != INT:
            self.refuse(node, f"no abs of {told(value.type)}")
        below = self._new(f"icmp slt i64 {value.parts[0]}, 0")
        other = self._new(f"sub nsw i64 0, {value.parts[0]}")
        return Value(INT, (self._new(f"select i1 {below}, i64 {other}, i64 {value.parts[0]}"),))

    def _call_max(self, node: ast.Call, values: list[Value], op: ast.cmpop | None = None) -> Value:
        """As in Python: the first of those that no other exceeds."""
        best, *others = values
        for value in others:
            type_ = joined(best.type, value.type)
            if type_ not in (FLOAT, INT):
                self.refuse(node, f"no largest or least of {told(best.type)}, {told(value.type)}")
            best, value = self._as(best, type_, node), self._as(value, type_, node)
            better = self._compared(op or ast.Gt(), value, best, node)
            fast = self.fast if type_ == FLOAT else ""
            line = f"select {fast}i1 {better}, {type_} {value.parts[0]}, {type_} {best.parts[0]}"
            best = Value(type_, (self._new(line),))
        return best

    def _call_min(self, node: ast.Call, values: list[Value]) -> Value:
        return self._call_max(node, values, ast.Lt())

    def _call_len(self, node: ast.Call, values: list[Value]) -> Value:
        (value,) = values
        if not isinstance(value.type, Array):
            self.refuse(node, f"no length of {told(value.type)}")
        return Value(INT, (value.parts[1],))

    def _call_float(self, node: ast.Call, values: list[Value]) -> Value:
        (value,) = values
        if value.type == BOOL:
            return Value(FLOAT, (self._new(f"uitofp i1 {value.parts[0]} to double"),))
        return self._as(value, FLOAT, node)

    def _call_int(self, node: ast.Call, values: list[Value]) -> Value:
        (value,) = values
        if value.type == FLOAT:
            return Value(INT, (self._new(f"fptosi double {value.parts[0]} to i64"),))
        if value.type == BOOL:
            return Value(INT, (self._new(f"zext i1 {value.parts[0]} to i64"),))
        return self._as(value, INT, node)

    # -- statements ---------------------------------------------------------------------------

    def _block(self, body: Sequence[ast.stmt]) -> None:
        for statement in body:
            if not self.open:
                self.refuse(statement, "this is never reached")
            print_it = getattr(self, f"_do_{type(statement).__name__.lower()}", None)
            if print_it is None:
                self.refuse(statement, f"{type(statement).__name__} is not among the statements")
            try:
                print_it(statement)
            except _Later:
                self.later = statement
                self.assigned |= _stored(statement)

    def _do_pass(self, statement: ast.Pass) -> None:
        pass

    def _do_expr(self, statement: ast.Expr) -> None:
        if not isinstance(statement.value, ast.Constant):  # a docstring
            self._value(statement.value)

    def _do_assign(self, statement: ast.Assign) -> None:
        value = self._value(statement.value)
        for target in statement.targets:
            self._store(target, value)

    def _do_augassign(self, statement: ast.AugAssign) -> None:
        target = statement.target
        if isinstance(target, ast.Subscript):
            place = self._part(target)
            if not isinstance(place.type, Array) or place.type.dimensions:
                self.refuse(target, "only a number is changed in its place")
            element = place.type.element
            old = Value(element, (self._new(f"load {element}, ptr {place.parts[0]}"),))
            new = self._arithmetic(statement.op, old, self._value(statement.value), target)
            operand = self._as(new, element, target).parts[0]
            self._line(f"store {element} {operand}, ptr {place.parts[0]}")
        elif isinstance(target, ast.Name):
            old = self._name(ast.copy_location(ast.Name(target.id, ast.Load()), target))
            self._store(
                target, self._arithmetic(statement.op, old, self._value(statement.value), target)
            )
        else:
            self.refuse(target, "only a variable or a place of an array is changed")

    def _store(self, target: ast.expr, value: Value) -> None:
        if isinstance(target, ast.Name):
            self._store_name(target, value)
        elif isinstance(target, ast.Tuple):
            if not isinstance(value.type, Tuple) or len(value.type.items) != len(target.elts):
                self.refuse(target, f"{told(value.type)} for {len(target.elts)} names")
            for i, part in enumerate(target.elts):
                self._store(part, _item(value, i))
        elif isinstance(target, ast.Subscript):
            if isinstance(target.slice, ast.Slice):
                self._fill(self._slice(target, target.slice), value, target)
                return
            place = self._part(target)
            if not isinstance(place.type, Array) or place.type.dimensions:
                self.refuse(target, "a number of an array is assigned, or array[first:last]")
            operand = self._as(value, place.type.element, target).parts[0]
            self._line(f"store {place.type.element} {operand}, ptr {place.parts[0]}")
        else:
            self.refuse(target, f"{type(target).__name__} is not assigned to")

    def _store_name(self, target: ast.Name, value: Value) -> None:
        name = target.id
        if name == "_":
            return
        if value.type == NOTHING:
            self.refuse(target, "this call gives nothing back")
        old = self.types.get(name)
        if isinstance(old, Tuple) and name in self.arguments:
            self.refuse(target, f"the argument {name} is a tuple, and stays what it is")
        type_ = value.type if old is None else joined(old, value.type)
        if type_ is None:
            assert old is not None
            self.refuse(target, f"{name} was {told(old)}, and would become {told(value.type)}")
        if old is not None and type_ != old:
            self.changed = True
            if name in self.arguments:
                self.refuse(target, f"the argument {name} is {told(old)}, and would change that")
        if old is None and self.later is not None:
            self.changed = True  # what was left out may read it
        self.types[name] = type_
        value = self._as(value, type_, target)
        for i, (part, operand) in enumerate(zip(parts_of(type_), value.parts, strict=True)):
            self._line(f"store {part} {operand}, ptr %{name}.{i}")
        self.assigned.add(name)

    def _fill(self, part: Value, value: Value, node: ast.AST) -> None:
        """Give all numbers of a part of an array one value."""
        assert isinstance(part.type, Array)
        if part.type.dimensions != 1:
            self.refuse(node, "array[first:last] = number is for one dimension")
        element = part.type.element
        operand = self._as(value, element, node).parts[0]
        with self._counting("0", part.parts[1], 1) as at:
            self._line(f"store {element} {operand}, ptr {self._address(part, at)}")

    def _do_return(self, statement: ast.Return) -> None:
        value = Value(NOTHING, ()) if statement.value is None else self._value(statement.value)
        type_ = joined(self.returns, value.type) if self.returned else value.type
        if type_ is None:
            self.refuse(statement, f"it returned {told(self.returns)}, now {told(value.type)}")
        if self.returned and type_ != self.returns:
            self.changed = True
        self.returns, self.returned = type_, True
        value = self._as(value, type_, statement)
        parts = parts_of(type_)
        if not parts:
            self._line("ret void")
        elif len(parts) == 1:
            self._line(f"ret {parts[0]} {value.parts[0]}")
        else:
            whole = "undef"
            for i, (part, operand) in enumerate(zip(parts, value.parts, strict=True)):
                line = f"insertvalue {_returned(type_)} {whole}, {part} {operand}, {i}"
                whole = self._new(line)
            self._line(f"ret {_returned(type_)} {whole}")
        self.open = False

    def _do_if(self, statement: ast.If) -> None:
        known = self._maybe(statement.test)
        if known is not None:
            self._block(statement.body if known else statement.orelse)
            return
        yes, no, end = self._label(), self._label(), self._label()
        self._branch(statement.test, yes, no)
        before, natural = set(self.assigned), set(self.natural)
        after: set[str] | None = None
        for label, body in ((yes, statement.body), (no, statement.orelse)):
            self._begin(label)
            self.assigned, self.natural = set(before), set(natural)
            self._block(body)
            if self.open:
                self._jump(end)
                after = self.assigned if after is None else after & self.assigned
        self.natural = natural - _stored(statement)
        if after is not None:
            self._begin(end)
            self.assigned = after

    def _do_while(self, statement: ast.While) -> None:
        if statement.orelse:
            self.refuse(statement, "a loop has no `else`")
        top, body, end = self._label(), self._label(), self._label()
        self.natural -= _stored(statement)
        self._jump(top)
        self._begin(top)
        endless = self._maybe(statement.test) is True
        self._branch(statement.test, body, end)
        before = set(self.assigned)
        loop = self._in_loop(_Loop(top, end), body, statement.body)
        if not endless or loop.broken:
            self._begin(end)
            ways = loop.broken if endless else [before, *loop.broken]
            self.assigned = set.intersection(*ways)

    def _in_loop(self, loop: _Loop, label: str, body: Sequence[ast.stmt]) -> _Loop:
        self.loops.append(loop)
        self._begin(label)
        self._block(body)
        if self.open:
            self._jump(loop.again)
        return self.loops.pop()

    def _do_for(self, statement: ast.For) -> None:
        call = statement.iter
        if not isinstance(call, ast.Call) or ast.unparse(call.func) != "range" or statement.orelse:
            self.refuse(statement, "a loop is `for name in range(...)`, without `else`")
        if not isinstance(statement.target, ast.Name) or not 1 <= len(call.args) <= 3:
            self.refuse(statement, "a loop is `for name in range(...)`")
        step = self._maybe(call.args[2]) if len(call.args) == 3 else 1
        if isinstance(step, bool) or not isinstance(step, int) or step == 0:
            self.refuse(statement, "the step of a range is a constant")
        first_node = call.args[0] if len(call.args) > 1 else ast.Constant(0)
        last_node = call.args[0] if len(call.args) == 1 else call.args[1]
        first, last = self._int(first_node), self._int(last_node)
        # counting down it stays above its last, which is not below -1
        least = self._maybe(last_node) if step < 0 else None
        natural = self._is_natural(first_node) if step > 0 else least is not None and least >= -1
        self.natural -= _stored(statement)
        before = set(self.assigned)
        with self._counting(first, last, step) as at:
            self._store_name(statement.target, Value(INT, (at,)))
            others = {name for inner in statement.body for name in _stored(inner)}
            if natural and statement.target.id not in others:
                self.natural.add(statement.target.id)
            self._block(statement.body)
        self.natural.discard(statement.target.id)
        self.assigned = before

    @contextmanager
    def _counting(self, first: str, last: str, step: int) -> Iterator[str]:
        """A loop: what is printed within it is repeated for each number of a range."""
        counter = self._on_stack(INT)
        self._line(f"store i64 {first}, ptr {counter}")
        top, body, again, end = (self._label() for _ in range(4))
        self._jump(top)
        self._begin(top)
        at = self._new(f"load i64, ptr {counter}")
        below = self._new(f"icmp {'slt' if step > 0 else 'sgt'} i64 {at}, {last}")
        self._line(f"br i1 {below}, label %{body}, label %{end}")
        self._begin(body)
        self.loops.append(_Loop(again, end))
        yield at
        if self.open:
            self._jump(again)
        self.loops.pop()
        self._begin(again)
        now = self._new(f"load i64, ptr {counter}")
        self._line(f"store i64 {self._new(f'add nsw i64 {now}, {step}')}, ptr {counter}")
        self._jump(top)
        self._begin(end)

    def _do_break(self, statement: ast.Break) -> None:
        self.loops[-1].broken.append(set(self.assigned))
        self._jump(self.loops[-1].end)

    def _do_continue(self, statement: ast.Continue) -> None:
        self._jump(self.loops[-1].again)


def _tuple(values: Sequence[Value]) -> Value:
    types = tuple(value.type for value in values)
    return Value(Tuple(types), tuple(part for value in values for part in value.parts))


def _item(value: Value, i: int) -> Value:
    """An item of a tuple."""
    assert isinstance(value.type, Tuple)
    start = sum(len(parts_of(type_)) for type_ in value.type.items[:i])
    type_ = value.type.items[i]
    return Value(type_, value.parts[start : start + len(parts_of(type_))])


def _stored(statement: ast.stmt) -> set[str]:
    """Names that are assigned somewhere in a statement."""
    targets = [*getattr(statement, "targets", ()), getattr(statement, "target", None)]
    found = {
        node.id
        for target in targets
        if target is not None
        for node in ast.walk(target)
        if isinstance(node, ast.Name) and isinstance(node.ctx, ast.Store)
    }
    for inner in (*getattr(statement, "body", ()), *getattr(statement, "orelse", ())):
        found |= _stored(inner)
    return found


_OF_FLOATS = {"Add": "fadd", "Sub": "fsub", "Mult": "fmul", "Div": "fdiv"}
_OF_INTS = {
    "Add": "add nsw", "Sub": "sub nsw", "Mult": "mul nsw", "FloorDiv": "sdiv", "Mod": "srem",
}  # fmt: skip
_COMPARED = {
    "Lt": ("olt", "slt"), "LtE": ("ole", "sle"), "Gt": ("ogt", "sgt"), "GtE": ("oge", "sge"),
    "Eq": ("oeq", "eq"), "NotEq": ("une", "ne"),
}  # fmt: skip
_KNOWN_UNARY: dict[type, Callable[[Any], Any]] = {
    ast.USub: lambda a: -a, ast.UAdd: lambda a: a, ast.Not: lambda a: not a,
}  # fmt: skip
_KNOWN_BINARY: dict[type, Callable[[Any, Any], Any]] = {
    ast.Add: lambda a, b: a + b, ast.Sub: lambda a, b: a - b, ast.Mult: lambda a, b: a * b,
    ast.Div: lambda a, b: a / b, ast.FloorDiv: lambda a, b: a // b, ast.Mod: lambda a, b: a % b,
    ast.Pow: lambda a, b: a**b,
}  # fmt: skip
_KNOWN_COMPARED: dict[type, Callable[[Any, Any], bool]] = {
    ast.Lt: lambda a, b: a < b, ast.LtE: lambda a, b: a <= b, ast.Gt: lambda a, b: a > b,
    ast.GtE: lambda a, b: a >= b, ast.Eq: lambda a, b: a == b, ast.NotEq: lambda a, b: a != b,
}  # fmt: skip
