"""A generated module as one file of C99."""

import ast
from collections import Counter
from collections.abc import Sequence, Set
from functools import lru_cache
from textwrap import wrap
from typing import Any

import numpy as np

from rockeom.compiler.types import BOOL, FLOAT, INT, Array, Tuple, Type
from rockeom.exports.closed import Function, Functions, Names, base_of, is_row, names_of, number_of
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

    def __init__(self, functions: Functions, function: Function, names: Names, prefix: str) -> None:
        super().__init__(functions, function, names)
        self.prefix = prefix
        self.result_array = _array_given(function)
        self.pending: list[set[str]] = []  # names by block, declared when they are first assigned
        self.inner: Set[str] = (
            frozenset()
        )  # names that only the statement knows which is written now
        self.times = Counter(
            n.id for s in function.body for n in names_of(s) if isinstance(n.ctx, ast.Store)
        )

    # -- expressions --------------------------------------------------------------------------

    def number(self, value: Any) -> str:
        if isinstance(value, bool):
            return "1" if value else "0"
        if isinstance(value, float) and not np.isfinite(value):
            return "NAN" if value != value else "INFINITY"
        return repr(value)

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

    def item(self, array: str, indices: Sequence[ast.expr], of_table: bool) -> str:
        return self.name(array) + "".join(f"[{self.text(i)}]" for i in indices)

    def part(self, array: str, first: ast.expr) -> tuple[str, int]:
        return f"{self.name(array)} + {self.text(first, PRODUCT)}", SUM

    def call(self, node: ast.Call, *more: str) -> tuple[str, int]:
        arguments = [self.text(a) for a in node.args]
        function = f"{self.prefix}{self.names.of(ast.unparse(node.func))}"
        return f"{function}({', '.join([*arguments, *more])})", ITEM

    def library(self, name: str, arguments: Sequence[ast.expr]) -> tuple[str, int]:
        texts = [self.text(a) for a in arguments]
        if name in ("max", "min"):
            return self.of_two(f"f{name}", texts), ITEM
        if name == "int":
            return f"(int) ({texts[0]})", POWER
        name = {"abs": "fabs"}.get(name, name)
        return f"{name}({', '.join(texts)})", ITEM

    def constant_name(self, name: str) -> str:
        return f"{self.prefix.upper()}{self.names.of(name)}"

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
        self.declaring(body, self.function.own - {*self.function.arguments, "_"})
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

    def declaring(self, body: Sequence[ast.stmt], names: Set[str]) -> None:
        """A block; `names` are those that nothing outside of it asks for.

        Each is declared where it is first assigned, in the innermost block that knows it.
        """
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
        self.pending.append(set(here))
        self.depth += 1
        for statement in body:
            for name in before.get(statement, ()):
                self.pending[-1].discard(name)
                self.line(f"{_word(self.function.types[name])} {self.names.of(name)} = 0;")
            self.inner = inside[statement] - here
            self.statement(statement)
        self.depth -= 1
        self.pending.pop()

    def only_within(self, statement: ast.stmt, name: str) -> bool:
        """Whether only the blocks within a statement ask for a name, or a loop counts with it."""
        if isinstance(statement, ast.For):
            head = statement.iter
        elif isinstance(statement, (ast.If, ast.While)):
            head = statement.test
        else:
            return False
        return name not in words(head)

    def at_once(self, statement: ast.Assign, name: str) -> bool:
        """Whether a statement gives a name its value before it asks for it."""
        targets = [t for target in statement.targets for t in getattr(target, "elts", [target])]
        return name not in words(statement.value) and any(
            isinstance(t, ast.Name) and t.id == name for t in targets
        )

    def is_pending(self, name: str) -> bool:
        """Whether a name is declared with its first value, which is now."""
        for level in self.pending:
            if name in level:
                level.remove(name)
                return True
        return False

    def declared(self, name: str) -> str:
        """A name as it stands where it is assigned, with its type where that is the first time."""
        word = self.names.of(name)
        if not self.is_pending(name):
            return word
        const = "const " if self.times[name] == 1 else ""
        return f"{const}{_word(self.function.types[name])} {word}"

    def statement(self, node: ast.stmt) -> None:
        names = self.inner
        match node:
            case ast.Assign():
                self.assign(node)
            case ast.AugAssign(target=target, op=op, value=value):
                sign = {ast.Add: "+", ast.Sub: "-", ast.Mult: "*", ast.Div: "/"}[type(op)]
                self.line(f"{self.text(target)} {sign}= {self.text(value)};")
            case ast.If():
                self.branches(node, names)
            case ast.While(test=test, body=body):
                self.line(f"while ({self.text(test)}) {{")
                self.declaring(body, names)
                self.line("}")
            case ast.For():
                self.loop(node, names)
            case ast.Return():
                self.give(node.value)
            case ast.Expr(value=ast.Constant()) | ast.Pass():
                pass
            case ast.Expr(value=value):
                self.line(f"{self.text(value)};")
            case ast.Break():
                self.line("break;")
            case ast.Continue():
                self.line("continue;")
            case _:
                self.function.refuse(node, f"{type(node).__name__} is not written")

    def branches(self, node: ast.If, names: Set[str]) -> None:
        self.line(f"if ({self.text(node.test)}) {{")
        while True:
            self.declaring(node.body, names)
            rest = node.orelse
            plain = len(rest) == 1 and isinstance(rest[0], ast.If)
            if not plain or names & words(rest[0].test):  # type: ignore[attr-defined]
                break
            node = rest[0]  # type: ignore[assignment]
            self.line(f"}} else if ({self.text(node.test)}) {{")
        if rest:
            self.line("} else {")
            self.declaring(rest, names)
        self.line("}")

    def loop(self, node: ast.For, names: Set[str]) -> None:
        assert isinstance(node.target, ast.Name)
        name, arguments = node.target.id, node.iter.args  # type: ignore[attr-defined]
        first = self.text(arguments[0]) if len(arguments) > 1 else "0"
        last = self.text(arguments[-1] if len(arguments) < 3 else arguments[1], SUM)
        if len(arguments) > 2:
            self.function.refuse(node, "a range counts by one")
        counter, own = self.names.of(name), "int " if name in names else ""
        self.is_pending(name)
        self.line(f"for ({own}{counter} = {first}; {counter} < {last}; {counter}++) {{")
        self.declaring(node.body, names - {name})
        self.line("}")

    def give(self, value: ast.expr | None) -> None:
        """Return."""
        if value is None:
            self.line("return;")
            return
        type_ = self.function.returns
        if is_row(type_) and isinstance(value, ast.Call):
            self.line(f"{self.call(value, 'result')[0]};")
            self.line("return;")
        elif is_row(type_):
            if not isinstance(value, ast.Tuple):
                self.function.refuse(value, "a tuple is returned as it is written out")
            for i, item in enumerate(value.elts):
                self.line(f"result[{i}] = {self.text(item)};")
            self.line("return;")
        elif isinstance(type_, Array):
            self.line("return;")
        else:
            self.line(f"return {self.text(value)};")

    def name(self, name: str) -> str:
        return "result" if name == self.result_array else super().name(name)

    def put(self, target: ast.expr, text: str) -> None:
        if isinstance(target, ast.Name):
            if target.id == "_":
                return
            self.line(f"{self.declared(target.id)} = {text};")
        else:
            self.line(f"{self.text(target)} = {text};")

    def keep(self, value: ast.expr) -> str:
        name = self.new("kept")
        self.line(f"const {_word(self.type_of(value))} {name} = {self.text(value)};")
        return name

    def unpack(self, targets: Sequence[ast.expr], value: ast.expr) -> None:
        row, name = self.type_of(value), self.new("pair")
        assert isinstance(row, Tuple)
        assert isinstance(value, ast.Call)
        self.line(f"{_word(row)} {name}[{len(row.items)}];")
        self.line(f"{self.call(value, name)[0]};")
        for i, target in enumerate(targets):
            self.put(target, f"{name}[{i}]")

    def make_array(self, name: str, zeros: bool) -> None:
        if name == self.result_array:
            self.is_pending(name)
            return
        size, type_ = self.function.lengths[name], _word(self.function.types[name])
        self.is_pending(name)
        self.line(f"{type_} {self.names.of(name)}[{max(size, 1)}] = {{0}};")

    def make_alias(self, name: str) -> None:
        alias = self.function.aliases[name]
        const = "" if name in self.function.fills else "const "
        array, _ = self.part(alias.array, alias.first)
        self.is_pending(name)
        type_ = _word(self.function.types[name])
        self.line(f"{const}{type_} *{self.names.of(name)} = {array};")

    def keep_row(self, name: str, value: ast.expr) -> None:
        row = self.type_of(value)
        assert isinstance(row, Tuple)
        assert isinstance(value, ast.Call)
        if not self.is_pending(name):
            self.function.refuse(value, f"{name} is found in several places")
        self.line(f"{_word(row)} {self.names.of(name)}[{len(row.items)}];")
        self.line(f"{self.call(value, self.names.of(name))[0]};")

    def copy(self, target: ast.Subscript, value: ast.expr) -> None:
        part, counter = target.slice, self.new("i")
        assert isinstance(part, ast.Slice)
        if part.lower is not None or part.upper is None:
            self.function.refuse(target, "a part that is copied is array[:last]")
        array = self.text(base_of(target))
        self.line(f"for (int {counter} = 0; {counter} < {self.text(part.upper)}; {counter}++) {{")
        self.line(f"    {array}[{counter}] = {self.text(value)}[{counter}];")
        self.line("}")


@lru_cache(maxsize=20_000)  # asked for by every block around it
def words(node: ast.AST) -> frozenset[str]:
    """All names in a part of a function."""
    return frozenset(n.id for n in names_of(node))


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
    if not rows or not isinstance(rows[0], (tuple, list)):
        whole = all(isinstance(x, int) for x in rows)
        items = ", ".join(repr(x) for x in rows) or "0"
        size = max(len(rows), 1)
        return _wrapped(f"static const {'int' if whole else 'double'} {name}[{size}] =", items)
    whole = all(isinstance(x, int) for row in rows for x in row)
    width = max(1, *(len(row) for row in rows))
    written = ", ".join("{" + (", ".join(repr(x) for x in row) or "0") + "}" for row in rows)
    type_ = "int" if whole else "double"
    return _wrapped(f"static const {type_} {name}[{len(rows)}][{width}] =", written)


def _wrapped(head: str, items: str) -> list[str]:
    return [
        f"{head} {{",
        *wrap(items, 92, initial_indent="    ", subsequent_indent="    "),
        "};",
    ]
