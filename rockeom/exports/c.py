"""A generated module as one file of C99."""

import ast
from collections import Counter
from collections.abc import Sequence, Set
from textwrap import wrap
from typing import Any, ClassVar

import numpy as np

from rockeom.compiler.types import BOOL, FLOAT, INT, Array, Tuple, Type
from rockeom.exports.closed import Function, Functions, Names, is_row, names_of, number_of, words
from rockeom.exports.writer import EITHER, ITEM, OR, POWER, PRODUCT, SIGNED, STEP, SUM, Writer

_WORDS = """
auto break case char const continue default do double else enum extern float for goto if inline
int long register restrict return short signed sizeof static struct switch typedef union
unsigned void volatile while alignas alignof bool constexpr false nullptr static_assert
thread_local true typeof typeof_unqual asm fortran and and_eq bitand bitor catch class compl
const_cast delete dynamic_cast explicit export friend mutable namespace new not not_eq operator
or or_eq private protected public reinterpret_cast static_cast template this throw try typeid
typename using virtual wchar_t xor xor_eq acos asin atan atan2 cos sin tan acosh asinh atanh
cosh sinh tanh exp exp2 expm1 frexp ilogb ldexp log log10 log1p log2 logb modf scalbn scalbln
cbrt fabs hypot pow sqrt erf erfc lgamma tgamma ceil floor nearbyint rint lrint llrint lround
llround round trunc fmod remainder remquo copysign nan nextafter nexttoward fdim fmax fmin fma
fpclassify isfinite isinf isnan isnormal signbit isgreater isgreaterequal isless islessequal
islessgreater isunordered INFINITY NAN HUGE_VAL HUGE_VALF HUGE_VALL FP_INFINITE FP_NAN FP_NORMAL
FP_SUBNORMAL FP_ZERO FP_FAST_FMA FP_ILOGB0 FP_ILOGBNAN MATH_ERRNO MATH_ERREXCEPT
math_errhandling float_t double_t errno main NULL EOF linux unix i386 result
"""
"""Words of C and C++, and what <math.h> may define, functions and macros."""
RESERVED = frozenset(_WORDS.split())

JOINED = "\x1f"
"""A blank at which no line is broken."""
_TYPES = {INT: "int", BOOL: "int", FLOAT: "double"}


def _word(type_: Type) -> str:
    return _TYPES[number_of(type_)]


class CWriter(Writer):
    """One function of C. Global names begin with `prefix`."""

    called: ClassVar = {"abs": "fabs", "max": "fmax", "min": "fmin"}
    if_, elif_, else_ = "if ({}) {{", "}} else if ({}) {{", "} else {"
    while_, end = "while ({}) {{", "}"

    def __init__(self, functions: Functions, function: Function, names: Names, prefix: str) -> None:
        super().__init__(functions, function, names, prefix)
        self.result_array = _array_given(function)
        self.pending: set[str] = set()  # names that are declared when they are first assigned
        self.times = Counter(
            n.id for s in function.body for n in names_of(s) if isinstance(n.ctx, ast.Store)
        )

    # -- expressions --------------------------------------------------------------------------

    def expression(self, node: ast.expr) -> tuple[str, int]:
        text, level = super().expression(node)
        return (text, SIGNED) if text.startswith("-") and level == ITEM else (text, level)

    def divided(self, node: ast.expr) -> str:
        if self.type_of(node) != INT:
            return self.text(node, PRODUCT)
        match node:
            case ast.Constant(value=value):
                return f"{value!r}.0"
            case ast.UnaryOp(op=ast.USub(), operand=ast.Constant(value=value)):
                return f"-{value!r}.0"
        return f"(double) {self.text(node, ITEM)}"

    def power(self, base: ast.expr, exponent: ast.expr) -> tuple[str, int]:
        return f"pow({self.text(base)}, {self.text(exponent)})", ITEM

    def either(self, test: ast.expr, one: ast.expr, other: ast.expr) -> tuple[str, int]:
        return f"{self.text(test, OR)} ? {self.text(one, OR)} : {self.text(other)}", EITHER

    def item(self, array: str, indices: Sequence[ast.expr]) -> str:
        return self.name(array) + "".join(f"[{self.text(i)}]" for i in indices)

    def part(self, array: str, first: ast.expr) -> tuple[str, int]:
        return f"{self.name(array)} + {self.text(first, PRODUCT)}", SUM

    def library(self, name: str, arguments: Sequence[ast.expr]) -> tuple[str, int]:
        if name == "int":
            return f"(int) ({self.text(arguments[0])})", POWER
        return super().library(name, arguments)

    # -- statements ---------------------------------------------------------------------------

    def write(self, how: str = "") -> list[str]:
        """The function as lines."""
        body = self.function.body
        self.depth = 0
        self.line(f"{how}{self.head()} {{")
        self.depth = 1
        asked = self.function.loaded
        for name in self.function.arguments:
            if name not in asked:
                self.line(f"(void) {self.names.of(name)};")
        self.depth = 0
        self.block(body, self.function.own - {*self.function.arguments, "_"})
        if self.lines[-1] == f"{STEP}return;":
            self.lines.pop()
        return [line.replace(JOINED, " ") for line in [*self.lines, "}"]]

    def head(self) -> str:
        """Its name, arguments and result."""
        function = self.function
        arguments = []
        for name in function.arguments:
            type_ = function.types[name]
            if isinstance(type_, (Array, Tuple)):
                const = "" if name in function.fills else "const "
                arguments.append(f"{const}{_word(type_)} *{self.names.of(name)}")
            else:
                arguments.append(f"{_word(type_)} {self.names.of(name)}")
        arguments = [argument.replace(" ", JOINED) for argument in arguments]
        returns = function.returns
        if isinstance(returns, Array) or is_row(returns):
            arguments.append(f"{_word(returns)}{JOINED}*result")
        word = _word(returns) if isinstance(returns, str) else "void"
        return f"{word} {self.prefix}{self.names.of(function.name)}({', '.join(arguments)})"

    def block(self, body: Sequence[ast.stmt], names: Set[str]) -> None:
        """Each is declared where it is first assigned, in the innermost block that knows it."""
        inside = {statement: words(statement) & names for statement in body}
        here: set[str] = set()
        before: dict[ast.stmt, list[str]] = {}
        for name in sorted(set().union(*inside.values())):
            asking = [statement for statement in body if name in inside[statement]]
            first = asking[0]
            if all(_counted(s, name) for s in asking) or (
                len(asking) == 1 and self.only_within(first, name)
            ):
                continue
            here.add(name)
            if not (isinstance(first, ast.Assign) and self.at_once(first, name)):
                before.setdefault(first, []).append(name)
        self.pending |= here
        self.depth += 1
        for statement in body:
            for name in before.get(statement, ()):
                self.pending.discard(name)
                self.line(f"{_word(self.function.types[name])} {self.names.of(name)} = 0;")
            self.inner = inside[statement] - here
            self.statement(statement)
        self.depth -= 1
        self.pending -= here

    def only_within(self, statement: ast.stmt, name: str) -> bool:
        """Whether only the blocks within a statement ask for a name, or a loop counts with it."""
        head = getattr(statement, "iter", getattr(statement, "test", None))
        return head is not None and name not in words(head)

    def is_pending(self, name: str) -> bool:
        """Whether a name is declared with its first value, which is now."""
        pending = name in self.pending
        self.pending.discard(name)
        return pending

    def declared(self, name: str) -> str:
        """A name as it stands where it is assigned, with its type where that is the first time."""
        word = self.names.of(name)
        if not self.is_pending(name):
            return word
        const = "const " if self.times[name] == 1 else ""
        return f"{const}{_word(self.function.types[name])} {word}"

    def change(self, target: ast.expr, sign: str, value: ast.expr) -> None:
        self.line(f"{self.text(target)} {sign}= {self.text(value)};")

    def counted(self, counter: str, first: str, last: ast.expr) -> str:
        own, i = "int " if counter in self.inner else "", self.names.of(counter)
        self.is_pending(counter)
        return f"for ({own}{i} = {first}; {i} < {self.text(last, SUM)}; {i}++) {{"

    def invoke(self, node: ast.Call, result: str | None = None) -> None:
        if result is None:
            self.line(f"{self.text(node)};")
            return
        row = self.type_of(node)
        assert isinstance(row, Tuple)
        self.line(f"{_word(row)} {result}[{len(row.items)}];")
        self.line(f"{self.call(node, result)[0]};")

    def give(self, value: ast.expr | None) -> None:
        type_ = self.function.returns
        if value is not None and isinstance(type_, str):
            self.line(f"return {self.text(value)};")
            return
        if is_row(type_) and isinstance(value, ast.Call):
            self.line(f"{self.call(value, 'result')[0]};")
        elif is_row(type_):
            if not isinstance(value, ast.Tuple):
                self.function.refuse(
                    value or self.function.tree, "a tuple is returned as it is written out"
                )
            for i, item in enumerate(value.elts):
                self.line(f"{self.place('result', i)} = {self.text(item)};")
        self.line("return;")

    def name(self, name: str) -> str:
        return "result" if name == self.result_array else super().name(name)

    def changed(self, target: ast.expr) -> str:
        return self.declared(target.id) if isinstance(target, ast.Name) else self.text(target)

    def type_word(self, value: ast.expr) -> str:
        return f"const {_word(self.type_of(value))} "

    def make_array(self, name: str) -> None:
        self.is_pending(name)
        if name != self.result_array:
            size, type_ = self.function.lengths[name], _word(self.function.types[name])
            self.line(f"{type_} {self.names.of(name)}[{max(size, 1)}] = {{0}};")

    def make_alias(self, name: str) -> None:
        alias = self.function.aliases[name]
        const = "" if name in self.function.fills else "const "
        array, _ = self.part(alias.array, alias.first)
        self.is_pending(name)
        type_ = _word(self.function.types[name])
        self.line(f"{const}{type_} *{self.names.of(name)} = {array};")

    def keep_row(self, name: str, value: ast.Call) -> None:
        if not self.is_pending(name):
            self.function.refuse(value, f"{name} is found in several places")
        super().keep_row(name, value)

    def copy_part(self, array: str, last: str, value: str) -> None:
        i = self.new("i")
        self.line(f"for (int {i} = 0; {i} < {last}; {i}++) {{")
        self.line(f"    {array}[{i}] = {value}[{i}];")
        self.line("}")


def _array_given(function: Function) -> str | None:
    """The array that a function makes and gives."""
    for node in function.body if isinstance(function.returns, Array) else ():
        if isinstance(node, ast.Return) and isinstance(node.value, ast.Name):
            return node.value.id
    return None


def _counted(node: ast.AST, name: str) -> bool:
    """Whether a name is nothing but the counter of loops."""
    if isinstance(node, ast.For) and isinstance(node.target, ast.Name) and node.target.id == name:
        return name not in words(node.iter)
    if isinstance(node, ast.Name):
        return node.id != name
    return name not in words(node) or all(
        _counted(child, name) for child in ast.iter_child_nodes(node)
    )


def table(name: str, value: Any) -> list[str]:
    """A constant of a text: a number, or a table of them."""
    if isinstance(value, (bool, int, np.integer)):
        return [f"enum {{ {name} = {int(value)} }};"]
    if isinstance(value, (float, np.floating)):
        return [f"static const double {name} = {float(value)!r};"]
    rows = np.asarray(value).tolist() if isinstance(value, np.ndarray) else value
    nested = bool(rows) and isinstance(rows[0], (tuple, list))
    every = rows if nested else [rows]
    texts = [", ".join(map(repr, row)) or "0" for row in every]
    size = f"[{max(1, *map(len, every))}]"
    if nested:
        size, texts = f"[{len(rows)}]{size}", [f"{{{text}}}" for text in texts]
    type_ = "int" if all(isinstance(x, int) for row in every for x in row) else "double"
    return _wrapped(f"static const {type_} {name}{size} =", ", ".join(texts))


def _wrapped(head: str, items: str) -> list[str]:
    return [
        f"{head} {{",
        *wrap(items, 92, initial_indent="    ", subsequent_indent="    "),
        "};",
    ]
