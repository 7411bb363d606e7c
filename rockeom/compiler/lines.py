"""Lines of LLVM's intermediate representation: what is done with values, whatever text asks for it.

Nothing here knows Python's syntax; the front end does, and says what is to be done.
"""

from __future__ import annotations

import math
import struct
from collections.abc import Collection, Iterator, Mapping, Sequence
from contextlib import contextmanager
from functools import cache
from itertools import islice
from types import MappingProxyType
from typing import NamedTuple

from rockeom.compiler.types import (
    BOOL,
    DUAL,
    FLOAT,
    IN_MEMORY,
    INT,
    NOTHING,
    VECTOR,
    WIDTH,
    Array,
    Tuple,
    Type,
    words,
)

# -- types and values ----------------------------------------------------------------------------


class Unfit(Exception):  # noqa: N818
    """An operation that values of some types do not have, and why."""


class Value(NamedTuple):
    """A type and what holds it: one operand of LLVM for a scalar; address and shape of an array.

    A tuple has a place on the stack, or none, and items that differ from those in the place.
    """

    type: Type
    parts: tuple[str, ...]
    items: Mapping[int, Value] = MappingProxyType({})

    @property
    def operand(self) -> str:
        """The number itself, or the address."""
        return self.parts[0]


def parts_of(type_: Type) -> tuple[str, ...]:
    """The LLVM types of the parts of a value."""
    if isinstance(type_, str):
        return (FLOAT, VECTOR) if type_ == DUAL else (type_,)
    if isinstance(type_, Array):
        return ("ptr", *[INT] * type_.dimensions)
    return tuple(part for item in type_.items for part in parts_of(item))


@cache
def size_of(type_: Type) -> int:
    """How many 64 bits a value takes in a tuple."""
    return sum(map(words, parts_of(type_)))


@cache
def start_of(type_: Tuple, i: int) -> int:
    """Where an item of a tuple begins, in 64 bits from the first."""
    return sum(map(size_of, type_.items[:i]))


def joined(a: Type, b: Type) -> Type | None:
    """The type that holds values of both, or None."""
    if a == b:
        return a
    if isinstance(a, Tuple) and isinstance(b, Tuple) and len(a.items) == len(b.items):
        items = [joined(x, y) for x, y in zip(a.items, b.items, strict=True)]
        if None in items or a.fields != b.fields:
            return None
        return Tuple(tuple(items), a.fields)  # type: ignore[arg-type]
    types = {a, b}
    if DUAL in types and types <= {DUAL, FLOAT, INT}:
        return DUAL
    return FLOAT if types == {FLOAT, INT} else None


def described(type_: Type) -> str:
    """A type in Python's words."""
    if isinstance(type_, Array):
        return f"array of {described(type_.element)} with {type_.dimensions} dimensions"
    if isinstance(type_, Tuple):
        return f"({', '.join(map(described, type_.items))})" if type_.items else "nothing"
    return {FLOAT: "float", INT: "int", BOOL: "bool", DUAL: "number with derivatives"}[type_]


def _aligned(part: str) -> str:
    """How a vector lies in memory: among numbers of 64 bits."""
    return ", align 8" if part == VECTOR else ""


def returned(type_: Type) -> str:
    """LLVM's type of what a function returns."""
    parts = parts_of(type_)
    if not parts or returned_in_place(type_):
        return "void"
    return parts[0] if len(parts) == 1 else "{ " + ", ".join(parts) + " }"


def tuple_of(type_: Type, parts: Iterator[str]) -> Value:
    """A value whose parts follow one another."""
    if isinstance(type_, Tuple):
        return a_tuple([tuple_of(item, parts) for item in type_.items], type_.fields)
    return Value(type_, tuple(islice(parts, len(parts_of(type_)))))


def literal(x: float) -> str:
    return f"0x{struct.unpack('<Q', struct.pack('<d', x))[0]:016X}"


def a_tuple(values: Sequence[Value], fields: tuple[str, ...] = ()) -> Value:
    """A tuple of values, a record if its fields have names."""
    types = tuple(value.type for value in values)
    return Value(Tuple(types, fields), (), dict(enumerate(values)))


def returned_in_place(type_: Type) -> bool:
    """Whether a function writes its result to a place of the caller: where it has a record."""
    return isinstance(type_, Tuple) and (
        bool(type_.fields) or any(map(returned_in_place, type_.items))
    )


# Operations are called as their classes in `ast`.
OF_FLOATS = {"Add": "fadd", "Sub": "fsub", "Mult": "fmul", "Div": "fdiv"}
OF_INTS = {
    "Add": "add nsw", "Sub": "sub nsw", "Mult": "mul nsw", "FloorDiv": "sdiv", "Mod": "srem",
}  # fmt: skip
OF_BOOLS = {"BitAnd": "and", "BitOr": "or"}
COMPARED = {
    "Lt": ("olt", "slt"), "LtE": ("ole", "sle"), "Gt": ("ogt", "sgt"), "GtE": ("oge", "sge"),
    "Eq": ("oeq", "eq"), "NotEq": ("une", "ne"),
}  # fmt: skip


# -- lines ---------------------------------------------------------------------------------------


class Round(NamedTuple):
    """One round of a loop over a range: the number it is at, where to go for the next and out."""

    at: str
    again: str
    end: str


class Lines:
    """The lines of one function; each variable is a place on the stack, which is called by it.

    arguments : names of variables that are given. fused : a*b + c may be rounded once.
    declared : takes what is called of other libraries, by name. again : text added to each jump
    back of a loop over a range.

    An operation on values of other types raises Unfit.
    """

    def __init__(
        self, arguments: Collection[str], fused: bool, declared: dict[str, str], again: str = ""
    ) -> None:
        self.arguments, self.declared, self.again = arguments, declared, again
        self.fast = "contract " if fused else ""
        self.lines: list[str] = []
        self.head: list[str] = []  # what stands at the beginning: places on the stack
        self.count = 0
        self.within: dict[tuple[str, int], str] = {}  # places in tuples that are read or written
        self.site = (
            ""  # where the text is, as `checked` passes it on; empty: indices are not checked
        )
        self.block = "entry"
        self.open = True  # whether the block that is being printed can be reached and goes on

    def line(self, text: str) -> None:
        self.lines.append(f"  {text}")

    def new(self, text: str) -> str:
        """Print an operation; returns the name of its result."""
        self.count += 1
        name = f"%t{self.count}"
        self.lines.append(f"  {name} = {text}")
        return name

    def number(self, type_: str, text: str) -> Value:
        """The result of an operation."""
        return Value(type_, (self.new(text),))

    def label(self) -> str:
        self.count += 1
        return f"L{self.count}"

    def begin(self, label: str) -> None:
        self.lines.append(f"{label}:")
        self.block, self.open = label, True

    def jump(self, label: str, how: str = "") -> None:
        self.line(f"br label %{label}{how}")
        self.open = False

    def branch(self, test: str, yes: str, no: str) -> None:
        self.line(f"br i1 {test}, label %{yes}, label %{no}")
        self.open = False

    @contextmanager
    def counting(self, first: str, last: str, step: int) -> Iterator[Round]:
        """A loop: what is printed within it is repeated for each number of a range."""
        counter = self.on_stack(INT)
        self.line(f"store i64 {first}, ptr {counter}")
        top, body, again, end = (self.label() for _ in range(4))
        self.jump(top)
        self.begin(top)
        at = self.new(f"load i64, ptr {counter}")
        below = self.new(f"icmp {'slt' if step > 0 else 'sgt'} i64 {at}, {last}")
        self.branch(below, body, end)
        self.begin(body)
        yield Round(at, again, end)
        if self.open:
            self.jump(again)
        self.begin(again)
        now = self.new(f"load i64, ptr {counter}")
        self.line(f"store i64 {self.new(f'add nsw i64 {now}, {step}')}, ptr {counter}")
        self.jump(top, self.again)
        self.begin(end)

    def chosen(self, value: Value, type_: Type, place: str) -> Value:
        """One of the values of `either`, of its type; place : of a tuple."""
        value = self.widened(value, type_)
        if place:
            self.put(value, place)
            value = Value(type_, (place,))
        return value

    def either(self, type_: Type, one: Value, other: Value, blocks: tuple[str, str]) -> Value:
        """The value that the block has from which this one was reached."""
        if isinstance(type_, Tuple):
            return one
        return Value(
            type_,
            tuple(
                self.new(f"phi {part} [{a}, %{blocks[0]}], [{b}, %{blocks[1]}]")
                for part, a, b in zip(parts_of(type_), one.parts, other.parts, strict=True)
            ),
        )

    # -- variables, functions

    def on_stack(self, element: str, size: int = 1) -> str:
        """A place that lasts as long as the call."""
        self.count += 1
        name = f"%s{self.count}"
        kind = IN_MEMORY.get(element, element)
        self.head.append(f"  {name} = alloca {kind}, i64 {size}, align {8 if size == 1 else 64}")
        return name

    def whole(self, name: str) -> str:
        """Where the parts of a tuple begin, in 64 bits each: what a call of a function passes."""
        return f"%{'in' if name in self.arguments else 'all'}.{name}"

    def load(self, name: str, type_: Type) -> Value:
        """The value of a variable; a tuple is read when an item is wanted."""
        if type_ in (FLOAT, INT, BOOL):  # most are
            return self.number(type_, f"load {type_}, ptr %{name}.0")
        if isinstance(type_, Tuple):
            return Value(type_, (self.whole(name),))
        places = [f"%{name}.{i}" for i in range(len(parts_of(type_)))]
        return Value(type_, tuple(map(self._from, parts_of(type_), places)))

    def store(self, name: str, value: Value) -> None:
        if isinstance(value.type, Tuple):
            self.put(value, self.whole(name))
            return
        for i, (part, operand) in enumerate(zip(parts_of(value.type), value.parts, strict=True)):
            self._to(part, operand, f"%{name}.{i}")

    def _from(self, part: str, place: str) -> str:
        return self.new(f"load {part}, ptr {place}{_aligned(part)}")

    def _to(self, part: str, operand: str, place: str) -> None:
        self.line(f"store {part} {operand}, ptr {place}{_aligned(part)}")

    # -- tuples, in which a bool is an i64

    def inside(self, place: str, at: int) -> str:
        """The place that is some 64 bits behind one on the stack."""
        if not at:
            return place
        if (place, at) not in self.within:
            self.count += 1
            self.within[place, at] = name = f"%i{self.count}"
            self.head.append(f"  {name} = getelementptr i64, ptr {place}, i64 {at}")
        return self.within[place, at]

    def item(self, value: Value, i: int) -> Value:
        """An item of a tuple."""
        assert isinstance(value.type, Tuple)
        if i in value.items:
            return value.items[i]
        type_, start = value.type.items[i], start_of(value.type, i)
        if isinstance(type_, Tuple):
            return Value(type_, (self.inside(value.operand, start),))
        parts = []
        for part in parts_of(type_):
            at = self.inside(value.operand, start)
            if part == BOOL:
                parts.append(self.new(f"trunc i64 {self._from(INT, at)} to i1"))
            else:
                parts.append(self._from(part, at))
            start += words(part)
        return Value(type_, tuple(parts))

    def put(self, value: Value, place: str) -> None:
        """Write a value to a place in a tuple."""
        if isinstance(value.type, Tuple):
            if value.parts and value.operand != place:
                copy, size = "llvm.memcpy.p0.p0.i64", 8 * size_of(value.type)
                self.declared[copy] = f"void @{copy}(ptr, ptr, i64, i1)"
                self.line(
                    f"call void @{copy}(ptr align 8 {place}, ptr align 8 {value.operand}, "
                    f"i64 {size}, i1 false)"
                )
            for i, item in value.items.items():
                self.put(item, self.inside(place, start_of(value.type, i)))
            return
        start = 0
        for part, operand in zip(parts_of(value.type), value.parts, strict=True):
            kind = part
            if part == BOOL:
                kind, operand = INT, self.new(f"zext i1 {operand} to i64")
            self._to(kind, operand, self.inside(place, start))
            start += words(part)

    def settled(self, value: Value) -> Value:
        """The same value, whose items stay what they are when variables are written."""
        items = {
            i: self.in_place(item) if isinstance(item.type, Tuple) else item
            for i, item in value.items.items()
        }
        return value._replace(items=items) if items else value

    def in_place(self, value: Value) -> Value:
        """The same tuple, all of it in a new place."""
        assert isinstance(value.type, Tuple)
        place = self.place_of(value.type)
        self.put(value, place)
        return Value(value.type, (place,))

    def place_of(self, type_: Tuple) -> str:
        """A new place for a tuple."""
        self.count += 1
        name = f"%s{self.count}"
        self.head.append(f"  {name} = alloca [{size_of(type_)} x i64], align 8")
        return name

    def flat(self, value: Value) -> list[str]:
        """All parts of a value, those of the items of a tuple one behind the other."""
        if not isinstance(value.type, Tuple):
            return list(value.parts)
        items = range(len(value.type.items))
        return [part for i in items for part in self.flat(self.item(value, i))]

    # -- functions

    def operands_of(self, value: Value) -> list[str]:
        """The operands of an argument of a call; a tuple is passed by its place."""
        if isinstance(value.type, Tuple):
            value = self.in_place(value) if value.items or not value.parts else value
            return [f"ptr {value.operand}"]
        parts = zip(parts_of(value.type), value.parts, strict=True)
        return [f"{part} {operand}" for part, operand in parts]

    def call(
        self, symbol: str, returns: Type, operands: Sequence[str], how: str = "", place: str = ""
    ) -> Value:
        """how : attributes of the call. place : for a result with a record, or "" for a new one."""
        if returned_in_place(returns):
            assert isinstance(returns, Tuple)
            place = place or self.place_of(returns)
            self.line(f"call void @{symbol}({', '.join([*operands, f'ptr {place}'])}){how}")
            return Value(returns, (place,))
        type_, count = returned(returns), len(parts_of(returns))
        call = f"call {type_} @{symbol}({', '.join(operands)}){how}"
        if count == 0:
            self.line(call)
            return Value(NOTHING, ())
        result = self.new(call)
        if count == 1:
            return tuple_of(returns, iter([result]))
        parts = (self.new(f"extractvalue {type_} {result}, {i}") for i in range(count))
        return tuple_of(returns, parts)

    def external(self, name: str, *operands: str) -> Value:
        """A function of floats of another library."""
        self.declared[name] = f"double @{name}({', '.join(['double'] * len(operands))})"
        arguments = ", ".join(f"double {operand}" for operand in operands)
        return self.number(FLOAT, f"call {self.fast}double @{name}({arguments})")

    def give_back(self, value: Value) -> None:
        type_, parts = returned(value.type), parts_of(value.type)
        if returned_in_place(value.type):
            self.put(value, "%out")
            self.line("ret void")
        elif not parts:
            self.line("ret void")
        elif len(parts) == 1:
            self.line(f"ret {type_} {self.flat(value)[0]}")
        else:
            whole = "undef"
            for i, (part, operand) in enumerate(zip(parts, self.flat(value), strict=True)):
                whole = self.new(f"insertvalue {type_} {whole}, {part} {operand}, {i}")
            self.line(f"ret {type_} {whole}")
        self.open = False

    def function(self, symbol: str, types: Mapping[str, Type], returns: Type, how: str) -> str:
        """The whole function as text. types : of all variables. how : its attributes."""
        # said of what is written out, it only costs time
        alone, read = ("", "") if "alwaysinline" in how else (" noalias", " readonly nocapture")
        head, operands = [], []
        for name, type_ in types.items():
            parts = list(enumerate(parts_of(type_)))
            if isinstance(type_, Tuple):
                if name in self.arguments:
                    operands.append(f"ptr{alone}{read} {self.whole(name)}")
                else:
                    size = size_of(type_)
                    head.append(f"  {self.whole(name)} = alloca [{size} x i64], align 8")
                continue
            head += [f"  %{name}.{i} = alloca {part}{_aligned(part)}" for i, part in parts]
            if name in self.arguments:
                operands += [f"{part} %in.{name}.{i}" for i, part in parts]
                head += [
                    f"  store {part} %in.{name}.{i}, ptr %{name}.{i}{_aligned(part)}"
                    for i, part in parts
                ]
        if returned_in_place(returns):
            operands.append(f"ptr{alone} %out")
        first = f"define internal {returned(returns)} @{symbol}({', '.join(operands)}) {how}{{"
        end = ["  ret void" if returns == NOTHING else "  unreachable"] if self.open else []
        return "\n".join([first, "entry:", *head, *self.head, *self.lines, *end, "}"])

    # -- numbers

    def widened(self, value: Value, type_: Type) -> Value:
        """The same value as one of a wider type."""
        if value.type == type_:
            return value
        if type_ == DUAL:
            return Value(DUAL, (self.widened(value, FLOAT).operand, "zeroinitializer"))
        if value.type == INT and type_ == FLOAT:
            if not value.operand.startswith("%"):
                return Value(FLOAT, (literal(float(int(value.operand))),))
            return self.number(FLOAT, f"sitofp i64 {value.operand} to double")
        if isinstance(value.type, Tuple) and isinstance(type_, Tuple):
            items = enumerate(type_.items)
            wide = [self.widened(self.item(value, i), wider) for i, wider in items]
            return a_tuple(wide, type_.fields)
        raise Unfit(f"{described(value.type)} where {described(type_)} is wanted")

    def arithmetic(self, operation: str, left: Value, right: Value) -> Value:
        if left.type == right.type == BOOL and operation in OF_BOOLS:
            return self.number(BOOL, f"{OF_BOOLS[operation]} i1 {left.operand}, {right.operand}")
        _numbers("arithmetic", left, right)
        if DUAL in (left.type, right.type):
            return self.of_duals(operation, left, right)
        if operation == "Div" or FLOAT in (left.type, right.type):
            if operation not in OF_FLOATS:
                raise Unfit(f"{operation} of floats is not among the operations")
            a, b = self.widened(left, FLOAT).operand, self.widened(right, FLOAT).operand
            return self.number(FLOAT, f"{OF_FLOATS[operation]} {self.fast}double {a}, {b}")
        if operation not in OF_INTS:
            raise Unfit(f"{operation} of ints is not among the operations")
        return self.number(INT, f"{OF_INTS[operation]} i64 {left.operand}, {right.operand}")

    def negative(self, value: Value) -> Value:
        if value.type == INT:
            return self.number(INT, f"sub nsw i64 0, {value.operand}")
        if value.type == DUAL:
            number, rates = value.parts
            return self.dual(self.new(f"fneg {self.fast}double {number}"), self.opposite(rates))
        return self.number(FLOAT, f"fneg {self.fast}double {value.operand}")

    def power(self, square: Value, n: int) -> Value:
        """A whole power by repeated squares."""
        power = None
        while True:
            if n & 1:
                power = square if power is None else self.arithmetic("Mult", power, square)
            n >>= 1
            if not n:
                assert power is not None
                return power
            square = self.arithmetic("Mult", square, square)

    def compared(self, comparison: str, left: Value, right: Value) -> str:
        if comparison not in COMPARED:
            raise Unfit(f"{comparison} is not among the comparisons")
        of_floats, of_ints = COMPARED[comparison]
        if left.type == right.type == BOOL and comparison in ("Eq", "NotEq"):
            return self.new(f"icmp {of_ints} i1 {left.operand}, {right.operand}")
        _numbers("comparison", left, right)
        if left.type == right.type == INT:
            return self.new(f"icmp {of_ints} i64 {left.operand}, {right.operand}")
        a, b = self.value(left).operand, self.value(right).operand
        return self.new(f"fcmp {of_floats} double {a}, {b}")

    def is_finite(self, x: str) -> Value:
        none = self.new(f"fsub double {x}, {x}")
        return self.number(BOOL, f"fcmp oeq double {none}, {literal(0.0)}")

    def absolute(self, value: Value) -> Value:
        if value.type == FLOAT:
            return self.external("llvm.fabs.f64", value.operand)
        if value.type == DUAL:
            return self.largest(value, self.negative(value))
        if value.type != INT:
            raise Unfit(f"no abs of {described(value.type)}")
        below = self.new(f"icmp slt i64 {value.operand}, 0")
        other = self.new(f"sub nsw i64 0, {value.operand}")
        return self.number(INT, f"select i1 {below}, i64 {other}, i64 {value.operand}")

    def largest(self, best: Value, *others: Value, better: str = "Gt") -> Value:
        """The largest as in Python: the first that no other exceeds."""
        for value in others:
            type_ = joined(best.type, value.type)
            if type_ not in (FLOAT, INT, DUAL):
                raise Unfit(
                    f"no largest or least of {described(best.type)}, {described(value.type)}"
                )
            best, value = self.widened(best, type_), self.widened(value, type_)
            test = self.compared(better, value, best)
            fast = "" if type_ == INT else self.fast
            both = zip(parts_of(type_), value.parts, best.parts, strict=True)
            select = f"select {fast}i1 {test}"
            chosen = [self.new(f"{select}, {part} {a}, {part} {b}") for part, a, b in both]
            best = Value(type_, tuple(chosen))
        return best

    def least(self, *values: Value) -> Value:
        return self.largest(*values, better="Lt")

    def length(self, value: Value) -> Value:
        if not isinstance(value.type, Array):
            raise Unfit(f"no length of {described(value.type)}")
        return Value(INT, (value.parts[1],))

    def as_float(self, value: Value) -> Value:
        if value.type == BOOL:
            return self.number(FLOAT, f"uitofp i1 {value.operand} to double")
        return value if value.type == DUAL else self.widened(value, FLOAT)

    def as_int(self, value: Value) -> Value:
        if value.type in (FLOAT, DUAL):
            return self.number(INT, f"fptosi double {value.operand} to i64")
        if value.type == BOOL:
            return self.number(INT, f"zext i1 {value.operand} to i64")
        return self.widened(value, INT)

    # -- numbers with derivatives: the rules of sums, products and quotients, and of the chain

    def dual(self, number: str, rates: str) -> Value:
        return Value(DUAL, (number, rates))

    def value(self, value: Value) -> Value:
        """The number without its derivatives."""
        if value.type == DUAL:
            return Value(FLOAT, (value.operand,))
        return self.widened(value, FLOAT)

    def moving(self, number: Value, rate: Value) -> Value:
        """A number whose derivatives are all one rate."""
        rates = self.everywhere(self.value(rate).operand)
        return self.dual(self.value(number).operand, rates)

    def rate(self, value: Value) -> Value:
        """The first of the derivatives."""
        rates = self.widened(value, DUAL).parts[1]
        return self.number(FLOAT, f"extractelement {VECTOR} {rates}, i64 0")

    def everywhere(self, x: str) -> str:
        """A number in all places of a vector."""
        one = self.new(f"insertelement {VECTOR} poison, double {x}, i64 0")
        none = f"<{WIDTH} x i32> zeroinitializer"
        return self.new(f"shufflevector {VECTOR} {one}, {VECTOR} poison, {none}")

    def opposite(self, rates: str) -> str:
        return self.new(f"fneg {self.fast}{VECTOR} {rates}")

    def vectors(self, operation: str, a: str, b: str) -> str:
        return self.new(f"{operation} {self.fast}{VECTOR} {a}, {b}")

    def times(self, rates: str, factor: str) -> str:
        return self.vectors("fmul", rates, self.everywhere(factor))

    def through(self, number: Value, value: Value, slope: Value) -> Value:
        """A function of a number with derivatives, by its value and its slope there."""
        return self.dual(value.operand, self.times(number.parts[1], slope.operand))

    def of_duals(self, operation: str, left: Value, right: Value) -> Value:
        """Arithmetic where one or both have derivatives; the other has none."""
        if operation not in OF_FLOATS:
            raise Unfit(f"{operation} of {described(DUAL)} is not among the operations")
        a, b = self.value(left), self.value(right)
        da, db = (x.parts[1] if x.type == DUAL else "" for x in (left, right))
        result = self.arithmetic(operation, a, b)
        if operation in ("Add", "Sub"):
            how = OF_FLOATS[operation]
            if not db:
                return self.dual(result.operand, da)
            if not da:
                return self.dual(result.operand, db if how == "fadd" else self.opposite(db))
            return self.dual(result.operand, self.vectors(how, da, db))
        if operation == "Mult":
            terms = [self.times(x, y.operand) for x, y in ((da, b), (db, a)) if x]
            rates = terms[0] if len(terms) == 1 else self.vectors("fadd", *terms)
            return self.dual(result.operand, rates)
        inverse = self.arithmetic("Div", Value(FLOAT, (literal(1.0),)), b)
        if db:
            lost = self.times(db, result.operand)
            da = self.vectors("fsub", da, lost) if da else self.opposite(lost)
        return self.dual(result.operand, self.times(da, inverse.operand))

    # -- arrays

    def from_end(self, index: str, length: str) -> str:
        """An index that counts from the end where it is negative.

        Where indices are checked only a constant does: a computed one is meant to be a place.
        """
        if not index.startswith("%"):
            return self.new(f"add nsw i64 {length}, {index}")
        if self.site:
            return index
        below = self.new(f"icmp slt i64 {index}, 0")
        from_end = self.new(f"add nsw i64 {index}, {length}")
        return self.new(f"select i1 {below}, i64 {from_end}, i64 {index}")

    def address(self, array: Value, at: str) -> str:
        assert isinstance(array.type, Array)
        kind = IN_MEMORY.get(array.type.element, array.type.element)
        return self.new(f"getelementptr inbounds {kind}, ptr {array.operand}, i64 {at}")

    def checked(self, index: str, size: str, also: str = "", how: str = "below") -> str:
        """Report an index that is not below a size; returns whether it is, and `also` is true.

        how : "up_to" if it may be the size itself. Prints nothing where indices are not checked.
        """
        if not self.site:
            return ""
        inside = self.new(f"call i1 @{how}(i64 {index}, i64 {size}, {self.site})")
        return self.new(f"and i1 {also}, {inside}") if also else inside

    def guarded(self, array: Value, inside: str) -> Value:
        """The same array, or an empty one in a spare place: the program goes on after a report."""
        if not inside:
            return array
        address, *shape = array.parts
        parts = [self.new(f"select i1 {inside}, ptr {address}, ptr @spare")]
        parts += [self.new(f"select i1 {inside}, i64 {length}, i64 0") for length in shape]
        return Value(array.type, tuple(parts))

    def place(self, array: Value, indices: Iterator[str], count: int) -> Value:
        """The part of an array at some indices, as an array of the dimensions that are left."""
        assert isinstance(array.type, Array)
        dimensions, shape = array.type.dimensions, array.parts[1:]
        at = inside = ""
        for d, index in enumerate(indices):
            inside = self.checked(index, shape[d], inside)
            at = self.new(f"add nsw i64 {at}, {index}") if at else index
            if d + 1 < dimensions:
                at = self.new(f"mul nsw i64 {at}, {shape[d + 1]}")
        for length in shape[count + 1 :]:
            at = self.new(f"mul nsw i64 {at}, {length}")
        left = Array(array.type.element, dimensions - count)
        return self.guarded(Value(left, (self.address(array, at), *shape[count:])), inside)

    def part(self, array: Value, first: str, last: str) -> Value:
        """A part from one index of the first dimension to another."""
        inside = self.checked(last, array.parts[1], how="up_to")
        inside = self.checked(first, last, inside, how="up_to")
        at = first
        for length in array.parts[2:]:
            at = self.new(f"mul nsw i64 {at}, {length}")
        count = self.new(f"sub nsw i64 {last}, {first}")
        slice_ = Value(array.type, (self.address(array, at), count, *array.parts[2:]))
        return self.guarded(slice_, inside)

    def read(self, place: Value) -> Value:
        """The number in a place: an array without dimensions."""
        assert isinstance(place.type, Array)
        element, at = place.type.element, place.operand
        if element == DUAL:
            number = self.new(f"load double, ptr {at}")
            rates = self.new(f"load {VECTOR}, ptr {self.rates_at(at)}{_aligned(VECTOR)}")
            return self.dual(number, rates)
        return self.number(element, f"load {element}, ptr {at}")

    def rates_at(self, place: str) -> str:
        """Where the derivatives stand of a number in memory: behind it."""
        return self.new(f"getelementptr inbounds i64, ptr {place}, i64 1")

    def write(self, value: Value, place: Value) -> None:
        """Put a number into a place."""
        assert isinstance(place.type, Array)
        element, at = place.type.element, place.operand
        value = self.widened(value, element)
        if element == DUAL:
            number, rates = value.parts
            self.line(f"store double {number}, ptr {at}")
            self.line(f"store {VECTOR} {rates}, ptr {self.rates_at(at)}{_aligned(VECTOR)}")
            return
        self.line(f"store {element} {value.operand}, ptr {at}")

    def fill(self, part: Value, value: Value) -> None:
        """Give all numbers of a part of an array one value, or those of another array."""
        assert isinstance(part.type, Array)
        if part.type.dimensions != 1:
            raise Unfit("array[first:last] = number is for one dimension")
        copies = isinstance(value.type, Array) and value.type.dimensions == 1
        if not copies:
            value = self.widened(value, part.type.element)
        with self.counting("0", part.parts[1], 1) as loop:
            number = value
            if copies:
                self.checked(loop.at, value.parts[1])
                number = self.read(value._replace(parts=(self.address(value, loop.at),)))
            self.write(number, part._replace(parts=(self.address(part, loop.at),)))

    def new_array(self, element: str, shape: tuple[int, ...]) -> Value:
        place = self.on_stack(element, max(math.prod(shape), 1))
        return Value(Array(element, len(shape)), (place, *map(str, shape)))

    def zeros(self, element: str, shape: tuple[int, ...]) -> Value:
        array, size = self.new_array(element, shape), 8 * math.prod(shape)
        if element == DUAL:
            size *= 1 + WIDTH
        if size:
            self.declared["llvm.memset.p0.i64"] = "void @llvm.memset.p0.i64(ptr, i8, i64, i1)"
            self.line(
                f"call void @llvm.memset.p0.i64(ptr {array.operand}, i8 0, i64 {size}, i1 false)"
            )
        return array

    def listed(self, numbers: Sequence[Value]) -> Value:
        """An array of numbers that are given one by one."""
        kinds = {v.type for v in numbers}
        element = DUAL if DUAL in kinds else FLOAT if FLOAT in kinds else INT
        array = self.new_array(element, (len(numbers),))
        for i, number in enumerate(numbers):
            value = self.widened(number, element)
            self.write(value, array._replace(parts=(self.address(array, str(i)),)))
        return array


def _numbers(what: str, *values: Value) -> None:
    for value in values:
        if value.type not in (FLOAT, INT, DUAL):
            raise Unfit(f"no {what} with {described(value.type)}")
