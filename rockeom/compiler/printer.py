"""Programs of LLVM: functions that are typed by the front end, entries, and halves of a program."""

import ast
import re
from collections import Counter
from collections.abc import Callable, Collection, Iterable, Mapping, Sequence
from functools import lru_cache
from typing import Any

import numpy as np

from rockeom.compiler.frontend import Function, has_duals
from rockeom.compiler.lines import (
    Lines,
    Value,
    a_tuple,
    described,
    literal,
    parts_of,
    returned,
    size_of,
)
from rockeom.compiler.modules import Modules, Text
from rockeom.compiler.parsed import ANNOTATIONS, Definition, Texts
from rockeom.compiler.types import BOOL, FLOAT, INT, NOTHING, WIDTH, Array, Entry, Tuple, Type

GROWTH = 5000.0
"""Lines; beyond it compiling takes much longer, and calls cost less than code that is far apart."""


MODULES = Modules()
"""The modules of rockeom, and nothing that is provided."""


class Program(Texts):
    """Texts, and what is printed of them so far.

    contract : False rounds every operation by itself.
    growth : lines by which the program may grow by one function that is written out wherever it is
        called; what would make it longer is called, whatever its mark says.
    bounds : every index and slice is checked; one that leaves its array is reported to the
        function `out_of_bounds`, which whoever loads the program provides, see `machine.Loaded`.
    own : names of texts that are in the first of two halves.
    """

    def __init__(
        self,
        roots: Iterable[Text],
        modules: Modules = MODULES,
        contract: bool = True,
        growth: float = GROWTH,
        bounds: bool = False,
        own: Collection[str] = (),
    ) -> None:
        super().__init__(roots, modules, contract, growth)
        self.bounds, self.own = bounds, own
        self.printed: dict[tuple[str, str, tuple[Type, ...]], tuple[str, Type] | None] = {}
        self.functions: dict[tuple[str, str, tuple[Type, ...]], Function] = {}
        self.bodies: dict[str, str] = {}  # of each function, by its symbol
        self.of_text: dict[str, Text] = {}  # in which it stands
        self.constants: dict[tuple[str, tuple[int, ...], bytes], str] = {}
        self.entries: dict[str, Entry] = {}
        for (_, name), definition in self.definitions.items():
            if "entry" in definition.marks and not definition.text.elsewhere:
                self.entry(name, definition)

    def entry(self, name: str, definition: Definition) -> None:
        """Print a function, and one that takes all its arguments from a row of 64-bit places.

        Arrays come as address and shape, a record as its fields: the row is a tuple in memory. The
        place behind them is for the value that the function returns.
        """
        arguments = definition.arguments(self.names_in(definition.text))
        types = tuple(type_ for _, type_ in arguments)
        symbol, returns = self.function(definition, types, None, definition)
        if returns not in (FLOAT, INT, BOOL, NOTHING):
            definition.refuse(None, f"an entry returns a number, not {described(returns)}")
        ir, row = Lines((), False, self.declared), Value(Tuple(types), ("%row",))
        values = [ir.item(row, i) for i in range(len(types))]
        operands = [operand for value in values for operand in ir.operands_of(value)]
        ir.put(ir.call(symbol, returns, operands), ir.inside("%row", size_of(row.type)))
        head = f"define void @{name}(ptr %row) nounwind {{"
        self.bodies[name] = "\n".join([head, *ir.head, *ir.lines, "  ret void", "}"])
        self.of_text[name] = definition.text
        self.entries[name] = Entry(flattened(arguments), returns)

    def elsewhere(self, name: str, symbol: str, definition: Definition) -> Type:
        """Print a function that calls an entry of another program by its row of places."""
        arguments = definition.arguments(self.names_in(definition.text))
        annotation = definition.tree.returns
        returns = ANNOTATIONS.get(annotation.id) if isinstance(annotation, ast.Name) else NOTHING
        if returns is None:
            definition.refuse(None, "what it returns has no annotation that is known")
        ir, values = Lines((), False, self.declared), []
        operands: list[str] = []
        for _, type_ in arguments:
            parts = ("ptr",) if isinstance(type_, Tuple) else parts_of(type_)
            names = [f"%x{len(operands) + i}" for i in range(len(parts))]
            values.append(Value(type_, tuple(names)))
            operands += [f"{part} {x}" for part, x in zip(parts, names, strict=True)]
        types = Tuple((*(type_ for _, type_ in arguments), returns))
        row = ir.place_of(types)
        ir.put(a_tuple(values), row)
        ir.line(f"call void @{name}(ptr {row})")
        ir.give_back(ir.item(Value(types, (row,)), len(values)))
        head = f"define internal {returned(returns)} @{symbol}({', '.join(operands)}) {{"
        self.bodies[symbol] = "\n".join([head, *ir.head, *ir.lines, "}"])
        self.of_text[symbol] = definition.text
        self.declared[name] = f"void @{name}(ptr)"
        return returns

    def function(
        self,
        definition: Definition,
        types: tuple[Type, ...],
        node: ast.AST | None,
        caller: Definition,
    ) -> tuple[str, Type]:
        """Symbol and type of what is returned, of a function for these types of arguments."""
        if any(map(has_duals, types)):
            definition = self.rules.get(definition.tree.name, definition)
        name = definition.tree.name
        key = definition.text.name, name, types
        if key not in self.printed:
            self.printed[key] = None
            symbol = f"{name}.{sum(of == name for _, of, _ in self.printed)}"
            if "entry" in definition.marks and definition.text.elsewhere:
                annotated = definition.arguments(self.names_in(definition.text))
                if tuple(type_ for _, type_ in annotated) != types:
                    caller.refuse(node, f"arguments of {name} are not as it is annotated")
                self.printed[key] = symbol, self.elsewhere(name, symbol, definition)
                return self.function(definition, types, node, caller)
            function = self.functions[key] = Function(self, definition, types)
            if definition.marks & {"inlined", "everywhere"}:
                self.sizes[symbol] = function.size
                grows = function.size * (self.calls(name) - 1)
                if grows <= self.growth or "everywhere" in definition.marks:
                    self.written_out.add(symbol)
            self.bodies[symbol] = function.body(symbol)
            self.of_text[symbol] = definition.text
            self.printed[key] = symbol, function.returns
        printed = self.printed[key]
        if printed is None:
            caller.refuse(node, f"{name} calls itself")
        return printed

    def calls(self, name: str) -> int:
        """How often a function is called in the texts, or a little more: words are counted."""
        return sum(_called(text.source)[name] for text in self.texts) - 1  # its definition

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
        bodies = "\n".join(self.bodies.values())
        return _joined(self.constants, self.declared.values(), [bodies, *self._checks(bodies)])

    def site(self, text: Text, line: int) -> str:
        """Operands that say where a check is; empty where there are none."""
        if not self.bounds:
            return ""
        number = next(i for i, one in enumerate(self.texts) if one is text)
        return f"ptr @text.{number}, i64 {line}"

    def _checks(self, bodies: str) -> list[str]:
        """The function that checks an index, and names of texts, where functions have checks."""
        if not self.bounds:
            return []
        named = []
        for i, text in enumerate(self.texts):
            name = text.name.encode() + b"\0"
            spelt = "".join(f"\\{byte:02X}" for byte in name)
            if f"@text.{i}," in bodies:
                named.append(f'@text.{i} = private constant [{len(name)} x i8] c"{spelt}"')
        return [*named, _CHECKS]

    def halves(self) -> tuple[str, str]:
        """The same as two programs that call one another: of the own texts, and of the others.

        Where something of the own texts is written out in a function of the others, that one is in
        the first, too. The second is the same, to the letter, for all programs that have the same
        other texts and the same constants in them.
        """
        ours = {s for s, text in self.of_text.items() if text.name in self.own}
        calls = {
            symbol: [(m[1], bool(m[2])) for m in _CALLS.finditer(body) if m[1] in self.bodies]
            for symbol, body in self.bodies.items()
        }

        def grown(symbols: set[str], by: Callable[[set[str]], set[str]]) -> set[str]:
            while not (more := by(symbols)) <= symbols:
                symbols = symbols | more
            return symbols

        def writers(symbols: set[str]) -> set[str]:
            return {s for s, all_ in calls.items() if any(out and c in symbols for c, out in all_)}

        def written_out(symbols: set[str]) -> set[str]:
            return {called for s in symbols for called, out in calls[s] if out}

        ours = grown(ours, writers)
        first, second = grown(ours, written_out), grown({*self.bodies} - ours, written_out)
        of_second = {called for s in first for called, _ in calls[s]} - first
        of_first = {called for s in second for called, _ in calls[s]} - second
        names = {symbol: [called for called, _ in all_] for symbol, all_ in calls.items()}
        return (
            self._half(_callers_first(first, names), of_first, of_second),
            self._half(_callers_first(second, names), of_second, of_first),
        )

    def _half(self, symbols: Iterable[str], shown: set[str], asked: set[str]) -> str:
        """Functions, and the tables that they want.

        shown : those of them that the other half calls. asked : those of the other that they call.
        """
        heads = (_HEAD.match(self.bodies[symbol]) for symbol in sorted(asked))
        declared = [_NAMES.sub("", head[1]) for head in heads if head]
        bodies = [self.bodies[s].replace("define internal", "define", s in shown) for s in symbols]
        text = "\n".join(bodies)
        declared += [d for name, d in sorted(self.declared.items()) if f"@{name}(" in text]
        tables = dict(zip(self.constants.values(), self.constants, strict=True))
        used = {name: f"@table_{i}" for i, name in enumerate(dict.fromkeys(_TABLE.findall(text)))}
        tables_of_half = {tables[name]: new for name, new in used.items()}
        text = _TABLE.sub(lambda name: used[name[0]], text)
        return _joined(tables_of_half, declared, [text, *self._checks(text)])


def _callers_first(symbols: Iterable[str], calls: Mapping[str, Iterable[str]]) -> list[str]:
    """Symbols, each before those that it calls, else in the order of their names.

    LLVM writes functions out in this order, and each that nothing calls any more goes at once.
    """
    left, order = set(symbols), []

    def visit(symbol: str) -> None:
        left.discard(symbol)
        for called in sorted(left.intersection(calls[symbol]), reverse=True):
            if called in left:
                visit(called)
        order.append(symbol)

    for symbol in sorted(symbols, reverse=True):
        if symbol in left:
            visit(symbol)
    return order[::-1]


def _joined(
    constants: Mapping[tuple[str, tuple[int, ...], bytes], str],
    declared: Iterable[str],
    bodies: Iterable[str],
) -> str:
    """A whole program: tables by their places, what others have, and functions."""
    tables = []
    for (element, _, data), name in constants.items():
        numbers = np.frombuffer(data, np.float64 if element == FLOAT else np.int64).tolist()
        items = ", ".join(f"{element} {literal(x) if element == FLOAT else x}" for x in numbers)
        tables.append(
            f"{name} = private unnamed_addr constant [{len(numbers)} x {element}] [{items}]"
        )
    return "\n".join([*tables, *(f"declare {d}" for d in declared), *bodies, _ROLLED]) + "\n"


@lru_cache(maxsize=64)  # the loop and the steps are those of many structures
def _called(source: str) -> Counter[str]:
    """How often each name is followed by a bracket."""
    return Counter(re.findall(r"\b(\w+)\(", source))


# of what is printed: calls, and whether they are written out; heads of functions; names in them
_CALLS = re.compile(r"call [^@\n]*@([\w.]+)\(.*\)( alwaysinline)?$", re.MULTILINE)
_HEAD = re.compile(r"define internal (.*?\)) \S")
_NAMES = re.compile(r" %[\w.]+(?=[,)])")
_TABLE = re.compile(r"@table\.\d+")
_ROLLED = """!0 = distinct !{!0, !1}
!1 = !{!"llvm.loop.unroll.disable"}"""
"""Metadata of the loops of a function that is marked @rolled."""

_CHECK = """define internal i1 @{}(i64 %index, i64 %size, ptr %text, i64 %line) noinline nounwind {{
  %inside = icmp {} i64 %index, %size
  br i1 %inside, label %end, label %report
report:
  call void @out_of_bounds(i64 %index, i64 %size, ptr %text, i64 %line)
  br label %end
end:
  ret i1 %inside
}}"""
"""An index, or an end of a slice, which may be the size; a negative one is large without a sign."""
_CHECKS = f"""@spare = internal global [{1 + WIDTH} x i64] zeroinitializer
declare void @out_of_bounds(i64, i64, ptr, i64)
{_CHECK.format("below", "ult")}
{_CHECK.format("up_to", "ule")}"""
"""With a place that is read and written after a report."""


def flattened(arguments: Sequence[tuple[str, Type]]) -> tuple[tuple[str, Type], ...]:
    """Arguments, records by their fields; `record.field` where two have one name."""
    named = [
        (f"{argument}.{field}", field, item)
        for argument, type_ in arguments
        for field, item in (
            zip(type_.fields, type_.items, strict=True)
            if isinstance(type_, Tuple)
            else [(argument, type_)]
        )
    ]
    counts = Counter(field for _, field, _ in named)
    return tuple((field if counts[field] == 1 else whole, item) for whole, field, item in named)
