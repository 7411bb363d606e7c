"""Plain numeric Python as LLVM's intermediate representation.

Generated modules, steps, the loop and the lanes are written in a closed part of Python: numbers,
tuples of them, arrays that are passed in, calls, `while`, `for ... in range(...)`, `if`. Its
meaning here is that of Python, but for the rules of machine numbers below; everything else is
refused by file and line.

    int       64 bits; what overflows is undefined. a // b and a % b for what cannot be negative
    float     64 bits; no exception: 1.0 / 0.0 is inf, math.sqrt(-1.0) is nan. x**n is a product
              where n is a whole number from 1 to 9
    bool      the only truth: `if`, `while`, `not`, `and`, `or` take nothing else
    loop      `for i in unrolled(range(N))` is written out round by round: i is a constant in each
    tuple     of any of these; indices are constants. One that is an argument is not assigned.
              `tuple(x for i in unrolled(range(N)))` has an item of each round; in a call of a
              function, `f(*items)`, each item is an argument
    record    a NamedTuple: a tuple whose items are read by name, as record.field. Fields have the
              types of their annotations; `record._replace(field=value)` is another one
    array     of int or float, in C order, never out of bounds: indices are not checked, unless the
              program is printed with `bounds`. A negative index counts from the end; with `bounds`
              only a constant one does. numpy.empty, zeros and array make one that lasts as long as
              the function's call, of constant size. array[first:last] = another copies its numbers
    variable  one type: that of all values that it is given, float where some are int. Each is
              assigned before it is read, whatever way the function takes
    dual      a float with its derivatives in some directions: what is printed for it carries them
              along by the rules of calculus, so that a text printed for duals is its own
              derivative. Comparisons are of the numbers; arrays that the function makes are of
              duals. A function marked @rule_of(f) is printed for duals in place of f, and
              the table SLOPES of a text has the derivatives of functions of `math`

How it works: a function is printed for the types of its arguments, line after line, each variable
a place on the stack, of which LLVM makes registers. Where a later line widens the type of a
variable, the function is printed once more. Nothing but what is marked @inlined is written out
where it is called. A tuple is passed by its place on the stack, and a record returned in a place of
the caller: whole ones are copied by one instruction, which LLVM resolves.

The same text gives the same numbers on every machine, but for `contract`: a*b + c is rounded once
where the text is a fused one and the processor can.
"""

import ast
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import lru_cache, partial
from typing import Any

import numpy as np

from rockeom.compiler.lines import (
    Lines,
    Unfit,
    Value,
    a_tuple,
    described,
    joined,
    literal,
)
from rockeom.compiler.parsed import UNKNOWN, Constants, Definition, Texts, fields_of
from rockeom.compiler.types import (
    BOOL,
    DUAL,
    FLOAT,
    INT,
    MATH,
    NOTHING,
    Array,
    Tuple,
    Type,
)


class _Later(Exception):  # noqa: N818
    """A variable whose type is not known yet: the function is printed again when it is."""


@dataclass
class _Loop:
    """Where `continue` and `break` go, and what is assigned wherever `break` leaves it."""

    again: str
    end: str
    broken: list[set[str]] = field(default_factory=list)


class Function:
    """Prints one function for one set of types.

    It knows the meaning of Python's statements and expressions, and refuses others; `Lines` knows
    LLVM.
    """

    def __init__(self, program: Texts, definition: Definition, types: tuple[Type, ...]) -> None:
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
        self.stores = _stores(tree)
        self.locals = {*self.stores, *self.arguments}
        self.fused = program.contract and (definition.text.fused or "fused" in definition.marks)
        self.types: dict[str, Type] = dict(zip(self.arguments, types, strict=True))
        self.element = DUAL if any(map(has_duals, types)) else FLOAT  # of arrays that are made
        self.returns: Type = NOTHING
        self.returned = False
        self.typed: dict[ast.expr, Type] = {}  # expressions that are no variables
        self._know(program.names_in(definition.text))
        while True:
            self._start()
            self._block(tree.body)
            if self.ir.open and self.returned and self.returns != NOTHING:
                self.refuse(tree.body[-1], "it ends without `return`")
            if not self.changed:
                break
        self.size += len(self.ir.lines)
        if self.later is not None:
            self.refuse(self.later, "the type of this cannot be found out")

    def _know(self, names: Mapping[str, Any]) -> None:
        """Take names for constants."""
        self.names, constants = names, Constants(names, self.locals)
        self._constant, self._maybe, self._whole = constants.value, constants.maybe, constants.whole

    def _start(self) -> None:
        again = ", !llvm.loop !0" if "rolled" in self.definition.marks else ""
        self.ir = Lines(self.arguments, self.fused, self.program.declared, again)
        self.size = 0  # lines of what is written out in this function
        self.loops: list[_Loop] = []
        self.assigned = set(self.arguments)
        self.natural: set[str] = set()  # variables of loops, while they cannot be negative
        self.changed = False
        self.later: ast.AST | None = None
        self.statement: ast.stmt | None = None  # that is being printed

    def body(self, symbol: str) -> str:
        """The whole function as text."""
        how = "noinline " if "apart" in self.definition.marks else ""
        if symbol in self.program.written_out:
            how = "alwaysinline "
        return self.ir.function(symbol, self.types, self.returns, f"{how}nounwind ")

    def _literal(self, value: Any, node: ast.expr) -> Value:
        if isinstance(value, bool | np.bool_):
            return Value(BOOL, ("true" if value else "false",))
        if isinstance(value, int | np.integer):
            return Value(INT, (str(int(value)),))
        if isinstance(value, float | np.floating):
            return Value(FLOAT, (literal(float(value)),))
        if isinstance(value, tuple):
            return a_tuple([self._literal(item, node) for item in value])
        table = self.program.constant(value) if isinstance(value, np.ndarray) else None
        if table is None:
            self.refuse(node, f"{type(value).__name__} is no number and no table of numbers")
        return table

    # -- expressions --------------------------------------------------------------------------

    def _value(self, node: ast.expr) -> Value:
        if isinstance(node, ast.Name) and node.id in self.locals:  # most are
            return self._name(node)
        constant = self._constant(node)
        if constant is not UNKNOWN:
            value = self._literal(constant, node)
            self.typed[node] = value.type
            return value
        print_it = getattr(self, f"_{type(node).__name__.lower()}", None)
        if print_it is None:
            self.refuse(node, f"{type(node).__name__} is not among the expressions")
        try:
            value = print_it(node)
        except Unfit as why:
            self.refuse(node, str(why))
        self.typed[node] = value.type
        return value

    def _of_type(self, node: ast.expr, types: Sequence[Type], wanted: str) -> Value:
        value = self._value(node)
        if value.type not in types:
            self.refuse(node, f"{wanted}, and this is {described(value.type)}")
        return value

    def _number(self, node: ast.expr) -> Value:
        return self._of_type(node, (FLOAT, INT, DUAL), "a number is wanted")

    def _int(self, node: ast.expr) -> str:
        return self._of_type(node, (INT,), "a whole number is wanted").operand

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
        return self.ir.load(node.id, self._type_of(node))

    def _tuple(self, node: ast.Tuple) -> Value:
        return a_tuple([self._value(item) for item in node.elts])

    def _attribute(self, node: ast.Attribute) -> Value:
        value = self._value(node.value)
        if isinstance(value.type, Tuple) and node.attr in value.type.fields:
            return self.ir.item(value, value.type.fields.index(node.attr))
        if node.attr != "shape" or not isinstance(value.type, Array):
            self.refuse(node, f".{node.attr} is not known")
        return a_tuple([Value(INT, (length,)) for length in value.parts[1:]])

    def _unaryop(self, node: ast.UnaryOp) -> Value:
        if isinstance(node.op, ast.Not | ast.Invert):
            value = self._of_type(node.operand, (BOOL,), "`not` and ~ take a bool")
            return self.ir.number(BOOL, f"xor i1 {value.operand}, true")
        value = self._number(node.operand)
        return value if isinstance(node.op, ast.UAdd) else self.ir.negative(value)

    def _binop(self, node: ast.BinOp) -> Value:
        """A sum is as deep on its left as it has terms: it is printed from the innermost."""
        if isinstance(node.op, ast.Pow):
            return self._power(node)
        nested = [node]
        while isinstance(left := nested[-1].left, ast.BinOp) and not isinstance(left.op, ast.Pow):
            if self._constant(left) is not UNKNOWN:
                break
            nested.append(left)
        value = self._value(left)
        for part in reversed(nested):
            value = self._operated(part, value)
        return value

    def _operated(self, node: ast.BinOp, left: Value) -> Value:
        """The result of an operation on what its left side has become."""
        right = self._value(node.right)
        try:
            result = self.ir.arithmetic(type(node.op).__name__, left, right)
        except Unfit as why:
            self.refuse(node, str(why))
        divides = isinstance(node.op, ast.FloorDiv | ast.Mod)
        if divides and not (self._is_natural(node.left) and self._is_natural(node.right)):
            self.refuse(node, _NO_REMAINDER)
        self.typed[node] = result.type
        return result

    def _power(self, node: ast.BinOp) -> Value:
        n = self._whole(node.right)
        if n is not None and 0 < n < 10:
            return self.ir.power(self._number(node.left), n)
        base, exponent = self._number(node.left), self._number(node.right)
        if exponent.type == DUAL:
            self.refuse(node, "an exponent has no derivatives here")
        return self._through("pow", "llvm.pow.f64", node, base, exponent)

    def _compare(self, node: ast.Compare) -> Value:
        """All comparisons of a chain; the values in it have no side effects."""
        left = self._value(node.left)
        every = ""
        for op, second in zip(node.ops, node.comparators, strict=True):
            if isinstance(op, ast.In | ast.NotIn):
                one = self._among(left, op, second)
            else:
                right = self._value(second)
                one, left = self.ir.compared(type(op).__name__, left, right), right
            every = self.ir.new(f"and i1 {every}, {one}") if every else one
        return Value(BOOL, (every,))

    def _among(self, left: Value, op: ast.cmpop, items: ast.expr) -> str:
        if not isinstance(items, ast.Tuple):
            self.refuse(items, "`in` takes a tuple that is written out")
        equal = "false"
        for item in items.elts:
            one = self.ir.compared("Eq", left, self._value(item))
            equal = self.ir.new(f"or i1 {equal}, {one}")
        return equal if isinstance(op, ast.In) else self.ir.new(f"xor i1 {equal}, true")

    def _boolop(self, node: ast.BoolOp) -> Value:
        yes, no, end = self.ir.label(), self.ir.label(), self.ir.label()
        self._branch(node, yes, no)
        for label in (yes, no):
            self.ir.begin(label)
            self.ir.jump(end)
        self.ir.begin(end)
        return self.ir.number(BOOL, f"phi i1 [true, %{yes}], [false, %{no}]")

    def _branch(self, test: ast.expr, yes: str, no: str) -> None:
        """Jump to one of two labels, looking at no more of a test than decides it."""
        constant = self._maybe(test)
        if constant is not None:
            self.ir.jump(yes if constant else no)
        elif isinstance(test, ast.BoolOp):
            for part in test.values[:-1]:
                go_on = self.ir.label()
                self._branch(part, *((go_on, no) if isinstance(test.op, ast.And) else (yes, go_on)))
                self.ir.begin(go_on)
            self._branch(test.values[-1], yes, no)
        elif isinstance(test, ast.UnaryOp) and isinstance(test.op, ast.Not):
            self._branch(test.operand, no, yes)
        else:
            value = self._of_type(test, (BOOL,), "a test is a bool")
            self.ir.branch(value.operand, yes, no)

    def _ifexp(self, node: ast.IfExp) -> Value:
        constant = self._maybe(node.test)
        if constant is not None:
            return self._value(node.body if constant else node.orelse)
        yes, no, end = self.ir.label(), self.ir.label(), self.ir.label()
        self._branch(node.test, yes, no)
        self.ir.begin(yes)
        first, block = self._value(node.body), self.ir.block
        mark = len(self.ir.lines)
        self.ir.begin(no)
        second, blocks = self._value(node.orelse), (block, self.ir.block)
        type_ = joined(first.type, second.type)
        if type_ is None:
            self.refuse(node, f"either {described(first.type)} or {described(second.type)}")
        # only now is the type known to which the first is widened, at the end of its block
        place = self.ir.place_of(type_) if isinstance(type_, Tuple) else ""
        self.ir.lines, after = self.ir.lines[:mark], self.ir.lines[mark:]
        first = self.ir.chosen(first, type_, place)
        self.ir.jump(end)
        self.ir.lines += after
        second = self.ir.chosen(second, type_, place)
        self.ir.jump(end)
        self.ir.begin(end)
        return self.ir.either(type_, first, second, blocks)

    # -- arrays and tuples --------------------------------------------------------------------

    def _is_natural(self, node: ast.expr) -> bool:
        """Whether a whole number clearly cannot be negative, by what it is made of."""
        constant = self._maybe(node)
        if constant is not None:
            return constant >= 0
        match node:
            case ast.Name():
                return node.id in self.natural
            case ast.BinOp(op=ast.Add() | ast.Mult() | ast.FloorDiv() | ast.Mod()):
                return self._is_natural(node.left) and self._is_natural(node.right)
            case ast.Subscript(value=ast.Attribute(attr="shape")) | ast.Call(func=ast.Name("len")):
                return True
        return False

    def _index(self, node: ast.expr, length: str) -> str:
        """An index as an operand; a negative one counts from the end."""
        operand = self._int(node)
        self.ir.site = self.program.site(self.definition.text, node.lineno)
        return operand if self._is_natural(node) else self.ir.from_end(operand, length)

    def _part(self, node: ast.Subscript) -> Value:
        """The object of a subscript; a single number of an array is one without dimensions."""
        indices: list[ast.expr] = []
        base: ast.expr = node
        value: Value | None = None
        while value is None and isinstance(base, ast.Subscript) and not _is_slice(base):
            indices[:0] = base.slice.elts if isinstance(base.slice, ast.Tuple) else [base.slice]
            base = base.value
            constant = self._maybe(base)
            value = None if constant is None else self.program.constant(constant)
        value = value or self._value(base)
        while indices and isinstance(value.type, Tuple):
            number, length = self._whole(indices[0]), len(value.type.items)
            if number is None:
                self.refuse(node, "the index of a tuple is a constant")
            if not -length <= number < length:
                self.refuse(node, f"a tuple of {length} has no item {number}")
            value = self.ir.item(value, number % length)
            del indices[0]
        if not indices:
            return value
        if not isinstance(value.type, Array):
            self.refuse(node, f"{described(value.type)} has no items")
        if len(indices) > value.type.dimensions:
            self.refuse(node, f"{len(indices)} indices of an {described(value.type)}")
        operands = map(self._index, indices, value.parts[1:])
        return self.ir.place(value, operands, len(indices))

    def _subscript(self, node: ast.Subscript) -> Value:
        if isinstance(node.slice, ast.Slice):
            return self._slice(node, node.slice)
        part = self._part(node)
        return self.ir.read(part) if _is_place(part) else part

    def _slice(self, node: ast.Subscript, part: ast.Slice) -> Value:
        """A slice of the first dimension; its ends are not cut to the length."""
        array = self._value(node.value)
        if not isinstance(array.type, Array) or part.step is not None:
            self.refuse(node, "a slice is array[first:last]")
        length = array.parts[1]
        first = "0" if part.lower is None else self._index(part.lower, length)
        last = length if part.upper is None else self._index(part.upper, length)
        self.ir.site = self.program.site(self.definition.text, node.lineno)
        return self.ir.part(array, first, last)

    def _made_array(self, node: ast.Call, how: str) -> Value:
        """numpy.empty, zeros and array: on the stack, of constant shape."""
        if how == "array":
            if len(node.args) != 1 or not isinstance(node.args[0], ast.List):
                self.refuse(node, "np.array takes a list of numbers that is written out")
            return self.ir.listed([self._number(item) for item in node.args[0].elts])
        shape = self._maybe(node.args[0]) if node.args else None
        shape = (shape,) if isinstance(shape, int) else shape
        if not isinstance(shape, tuple) or not all(isinstance(n, int) for n in shape):
            self.refuse(node, "the shape of an array is constant")
        make = self.ir.zeros if how == "zeros" else self.ir.new_array
        return make(INT if len(node.args) > 1 else self.element, shape)

    # -- calls --------------------------------------------------------------------------------

    def _call(self, node: ast.Call) -> Value:
        function = node.func
        if isinstance(function, ast.Attribute) and function.attr == "_replace":
            return self._replaced(node, function.value)
        if isinstance(function, ast.Name) and (fields := fields_of(self.names.get(function.id))):
            return self._record(node, function.id, fields)
        if node.keywords:
            self.refuse(node, "arguments are given by their place")
        if isinstance(function, ast.Attribute) and isinstance(function.value, ast.Name):
            return self._library_call(node, function.value.id, function.attr)
        if not isinstance(function, ast.Name) or function.id in self.locals:
            self.refuse(node, "only functions with a name of their own are called")
        name = function.id
        called = self.program.defined(name, self.definition.text)
        if called is None and name == "tuple":
            return self._tuple_of_rounds(node)
        if called is None and name in _BUILT_IN:
            if len(node.args) != _TAKES.get(name, 1) and (
                name not in ("max", "min") or not node.args
            ):
                self.refuse(node, f"{name} of {len(node.args)} is not among the functions")
            return _BUILT_IN[name](self.ir, *(value for _, value in self._spread(node)))
        if called is None:
            self.refuse(node, f"no function {name} is known")
        arguments = self._spread(node)
        values = [value for _, value in arguments]
        types = tuple(value.type for value in values)
        symbol, returns = self.program.function(called, types, node, self.definition)
        how = ""
        if self._written_out(symbol, node):
            self.size += self.program.sizes[symbol]
            how = " alwaysinline"
        else:  # a record that no call sees in its place can be kept in registers
            values = [
                self.ir.in_place(value) if self._is_record(a, value.type) else value
                for a, value in arguments
            ]
        operands = [operand for value in values for operand in self.ir.operands_of(value)]
        return self.ir.call(symbol, returns, operands, how, self._destination(node, returns))

    def _spread(self, node: ast.Call) -> list[tuple[ast.expr, Value]]:
        """The arguments of a call and their values; a starred tuple is as many as it has items."""
        arguments: list[tuple[ast.expr, Value]] = []
        for argument in node.args:
            if isinstance(argument, ast.Starred):
                whole = self._value(argument.value)
                if not isinstance(whole.type, Tuple):
                    self.refuse(argument, f"a tuple has a star, and no {described(whole.type)}")
                items = map(partial(self.ir.item, whole), range(len(whole.type.items)))
                arguments += [(argument, item) for item in items]
            else:
                arguments.append((argument, self._value(argument)))
        return arguments

    def _tuple_of_rounds(self, node: ast.Call) -> Value:
        """A tuple with an item of each round of an unrolled loop."""
        match node.args:
            case [ast.GeneratorExp(elt=item, generators=[ast.comprehension(ifs=[]) as loop])]:
                if (of := _unrolled(loop)) is not None:
                    return a_tuple(self._rounds(loop, of, lambda: self._value(item)))
        self.refuse(node, "a tuple is written out, or tuple(x for i in unrolled(range(N)))")

    def _destination(self, node: ast.Call, returns: Type) -> str:
        """The place of a tuple that a call may write to at once, or none."""
        match self.statement:
            case ast.Return(value=value) if value is node:
                return "%out"
            case ast.Assign(targets=[ast.Name(id=name)], value=value) if value is node:
                read = {n.id for a in node.args for n in ast.walk(a) if isinstance(n, ast.Name)}
                if self.types.get(name, returns) == returns and name not in read:
                    return self.ir.whole(name)
        return ""

    def _is_record(self, node: ast.expr, type_: Type) -> bool:
        """Whether an argument is a record that is a variable, and is assigned more than once."""
        changes = isinstance(node, ast.Name) and self.stores.get(node.id, 0) > 1
        return changes and isinstance(type_, Tuple) and bool(type_.fields)

    def _record(self, node: ast.Call, name: str, fields: Mapping[str, Type | None]) -> Value:
        """A new record, of the types that its fields are annotated with."""
        values = dict(zip(fields, node.args, strict=False))
        values |= {str(keyword.arg): keyword.value for keyword in node.keywords}
        if len(node.args) + len(node.keywords) != len(fields) or set(values) != set(fields):
            self.refuse(node, f"{name} takes {', '.join(fields)}, each once")
        parts = {
            field: self._field(node, f"{name}.{field}", fields[field], value)
            for field, value in values.items()
        }
        return a_tuple([parts[field] for field in fields], tuple(fields))

    def _field(self, node: ast.AST, name: str, wanted: Type | None, item: ast.expr) -> Value:
        """The value of a field: a number is widened to the type of its annotation."""
        value = self._value(item)
        if wanted is None or wanted in (value.type, _without_derivatives(value.type)):
            return value
        if wanted in (value.type, joined(wanted, value.type)):
            return self.ir.widened(value, wanted)
        self.refuse(node, f"{name} is {described(wanted)}, not {described(value.type)}")

    def _replaced(self, node: ast.Call, of: ast.expr) -> Value:
        """A record with other values in some fields."""
        value = self._value(of)
        changes = self._changes(node, value.type)
        return value._replace(items={**value.items, **changes})

    def _changes(self, node: ast.Call, type_: Type) -> dict[int, Value]:
        """The new values of a `_replace`, by their places in the record."""
        if not isinstance(type_, Tuple) or not type_.fields or node.args:
            self.refuse(node, "._replace(field=value) is of a record")
        changes = {}
        for keyword in node.keywords:
            field = str(keyword.arg)
            if field not in type_.fields:
                self.refuse(node, f"there is no field {field}, only {', '.join(type_.fields)}")
            i = type_.fields.index(field)
            old, new = type_.items[i], self._value(keyword.value)
            if joined(old, new.type) != old:
                self.refuse(node, f"{field} is {described(old)}, not {described(new.type)}")
            changes[i] = self.ir.widened(new, old)
        return changes

    def _written_out(self, symbol: str, node: ast.Call) -> bool:
        """Whether a function is written out at this call."""
        if symbol not in self.program.sizes or symbol in self.program.written_out:
            return symbol in self.program.written_out
        # where an argument is a constant, little of it may be left
        folds = any(self._maybe(argument) is not None for argument in node.args)
        return folds and 3 * self.program.sizes[symbol] <= self.program.growth

    def _library_call(self, node: ast.Call, library: str, name: str) -> Value:
        if library == "np" and name in ("empty", "zeros", "array"):
            return self._made_array(node, name)
        if library != "math" and f"{library}.{name}" != "np.int64":
            self.refuse(node, f"{library}.{name} is not among the functions")
        if len(node.args) == 1 and library == "np":
            return self.ir.as_int(self._value(node.args[0]))
        if len(node.args) == 1 and name == "isfinite":
            return self.ir.is_finite(self.ir.value(self._number(node.args[0])).operand)
        if len(node.args) == 1 and name in MATH:
            return self._through(name, MATH[name], node, self._number(node.args[0]))
        self.refuse(node, f"{library}.{name} of {len(node.args)} is not among the functions")

    def _through(self, name: str, symbol: str, node: ast.AST, number: Value, *more: Value) -> Value:
        """A function of another library; of a number with derivatives, by the text of its slope."""
        numbers = [self.ir.value(x) for x in (number, *more)]
        value = self.ir.external(symbol, *(x.operand for x in numbers))
        if number.type != DUAL:
            return value
        if (rule := self.program.rules.get(f"math.{name}")) is None:
            self.refuse(node, f"no slope of math.{name} is known")
        slope, returns = self.program.function(rule, (FLOAT,) * len(numbers), node, self.definition)
        operands = [operand for x in numbers for operand in self.ir.operands_of(x)]
        return self.ir.through(number, value, self.ir.call(slope, returns, operands))

    # -- statements ---------------------------------------------------------------------------

    def _block(self, body: Sequence[ast.stmt]) -> None:
        for statement in body:
            if not self.ir.open:
                self.refuse(statement, "this is never reached")
            self.statement = statement
            print_it = getattr(self, f"_do_{type(statement).__name__.lower()}", None)
            if print_it is None:
                self.refuse(statement, f"{type(statement).__name__} is not among the statements")
            try:
                print_it(statement)
            except Unfit as why:
                self.refuse(statement, str(why))
            except _Later:
                self.later = statement
                self.assigned |= _stores(statement).keys()

    def _do_pass(self, statement: ast.Pass) -> None:
        pass

    def _do_expr(self, statement: ast.Expr) -> None:
        if not isinstance(statement.value, ast.Constant):  # a docstring
            self._value(statement.value)

    def _do_assign(self, statement: ast.Assign) -> None:
        value = self.ir.settled(self._value(statement.value))
        for target in statement.targets:
            self._store(target, value)

    def _do_augassign(self, statement: ast.AugAssign) -> None:
        target, word = statement.target, type(statement.op).__name__
        if isinstance(statement.op, ast.FloorDiv | ast.Mod):
            self.refuse(target, _NO_REMAINDER)
        if isinstance(target, ast.Subscript):
            place = self._part(target)
            if not _is_place(place):
                self.refuse(target, "only a number is changed in its place")
            old = self.ir.read(place)
            self.ir.write(self.ir.arithmetic(word, old, self._value(statement.value)), place)
        elif isinstance(target, ast.Name):
            old = self._name(target)
            new = self.ir.arithmetic(word, old, self._value(statement.value))
            self._store_name(target, new)
        else:
            self.refuse(target, "only a variable or a place of an array is changed")

    def _store(self, target: ast.expr, value: Value) -> None:
        if isinstance(target, ast.Name):
            self._store_name(target, value)
        elif isinstance(target, ast.Tuple):
            if not isinstance(value.type, Tuple) or len(value.type.items) != len(target.elts):
                self.refuse(target, f"{described(value.type)} for {len(target.elts)} names")
            for i, part in enumerate(target.elts):
                self._store(part, self.ir.item(value, i))
        elif isinstance(target, ast.Subscript) and isinstance(target.slice, ast.Slice):
            self.ir.fill(self._slice(target, target.slice), value)
        elif isinstance(target, ast.Subscript):
            place = self._part(target)
            if not _is_place(place):
                self.refuse(target, "a number of an array is assigned, or array[first:last]")
            self.ir.write(value, place)
        else:
            self.refuse(target, f"{type(target).__name__} is not assigned to")

    def _store_name(self, target: ast.Name, value: Value) -> None:
        name = target.id
        if name == "_":
            return
        if value.type == NOTHING:
            self.refuse(target, "this call gives nothing back")
        old = self.types.get(name, value.type)
        type_ = joined(old, value.type)
        if type_ is None:
            self.refuse(
                target, f"{name} was {described(old)}, and would become {described(value.type)}"
            )
        if name in self.arguments and isinstance(old, Tuple):
            self.refuse(target, f"the argument {name} is a tuple, and stays what it is")
        if name in self.arguments and type_ != old:
            self.refuse(target, f"the argument {name} is {described(old)}, and would change that")
        # what was left out may read a variable that is new
        self.changed |= type_ != old or (name not in self.types and self.later is not None)
        self.types[name] = type_
        self.ir.store(name, self.ir.widened(value, type_))
        self.assigned.add(name)

    def _do_return(self, statement: ast.Return) -> None:
        value = Value(NOTHING, ()) if statement.value is None else self._value(statement.value)
        type_ = joined(self.returns, value.type) if self.returned else value.type
        if type_ is None:
            self.refuse(
                statement, f"it returned {described(self.returns)}, now {described(value.type)}"
            )
        self.changed |= self.returned and type_ != self.returns
        self.returns, self.returned = type_, True
        self.ir.give_back(self.ir.widened(value, type_))

    def _do_if(self, statement: ast.If) -> None:
        constant = self._maybe(statement.test)
        if constant is not None:
            self._block(statement.body if constant else statement.orelse)
            return
        yes, no, end = self.ir.label(), self.ir.label(), self.ir.label()
        self._branch(statement.test, yes, no)
        before, natural = set(self.assigned), set(self.natural)
        after: list[set[str]] = []
        for label, body in ((yes, statement.body), (no, statement.orelse)):
            self.ir.begin(label)
            self.assigned, self.natural = set(before), set(natural)
            self._block(body)
            if self.ir.open:
                self.ir.jump(end)
                after.append(self.assigned)
        self.natural = natural - _stores(statement).keys()
        if after:
            self.ir.begin(end)
            self.assigned = set.intersection(*after)

    def _do_while(self, statement: ast.While) -> None:
        if statement.orelse:
            self.refuse(statement, "a loop has no `else`")
        top, body, end = self.ir.label(), self.ir.label(), self.ir.label()
        self.natural -= _stores(statement).keys()
        self.ir.jump(top)
        self.ir.begin(top)
        endless = self._maybe(statement.test) is True
        self._branch(statement.test, body, end)
        ways = [] if endless else [set(self.assigned)]
        self.ir.begin(body)
        ways += self._repeated(statement.body, _Loop(top, end))
        if self.ir.open:
            self.ir.jump(top)
        if ways:
            self.ir.begin(end)
            self.assigned = set.intersection(*ways)

    def _repeated(self, body: Sequence[ast.stmt], loop: _Loop) -> list[set[str]]:
        """Print what is within a loop; returns what is assigned at each `break`."""
        self.loops.append(loop)
        self._block(body)
        return self.loops.pop().broken

    def _rounds(
        self, loop: ast.For | ast.comprehension, of: ast.expr, do: Callable[[], Any]
    ) -> list[Any]:
        """The results of the rounds of a loop over constants, in which its name is one of them."""
        numbers, target, results = self._maybe(of), loop.target, []
        if numbers is None:
            self.refuse(of, _ALL_CONSTANTS)
        if not isinstance(target, ast.Name) or target.id in self.locals:
            self.refuse(target, "an unrolled loop has one name, and no variable has it")
        outside = self.names
        try:
            for number in numbers:
                self._know({**outside, target.id: number})
                results.append(do())
        finally:
            self._know(outside)
        return results

    def _do_for(self, statement: ast.For) -> None:
        call, target = statement.iter, statement.target
        if (of := _unrolled(statement)) is not None:
            leaves = any(isinstance(n, ast.Break | ast.Continue) for n in ast.walk(statement))
            if leaves or statement.orelse:
                self.refuse(statement, _ALL_CONSTANTS)
            self._rounds(statement, of, lambda: self._block(statement.body))
            return
        if not isinstance(call, ast.Call) or ast.unparse(call.func) != "range" or statement.orelse:
            self.refuse(statement, "a loop is `for name in range(...)`, without `else`")
        if not isinstance(target, ast.Name) or not 1 <= len(call.args) <= 3:
            self.refuse(statement, "a loop is `for name in range(...)`")
        step = self._whole(call.args[2]) if len(call.args) == 3 else 1
        if not step:
            self.refuse(statement, "the step of a range is a constant")
        first_node = call.args[0] if len(call.args) > 1 else ast.Constant(0)
        last_node = call.args[0] if len(call.args) == 1 else call.args[1]
        first, last = self._int(first_node), self._int(last_node)
        # counting down it stays above its last, which is not below -1
        least = self._maybe(last_node) if step < 0 else None
        natural = self._is_natural(first_node) if step > 0 else least is not None and least >= -1
        self.natural -= _stores(statement).keys()
        before = set(self.assigned)
        with self.ir.counting(first, last, step) as loop:
            self._store_name(target, Value(INT, (loop.at,)))
            if natural and not any(target.id in _stores(inner) for inner in statement.body):
                self.natural.add(target.id)
            self._repeated(statement.body, _Loop(loop.again, loop.end))
        self.natural.discard(target.id)
        self.assigned = before

    def _do_break(self, statement: ast.Break) -> None:
        self.loops[-1].broken.append(set(self.assigned))
        self.ir.jump(self.loops[-1].end)

    def _do_continue(self, statement: ast.Continue) -> None:
        self.ir.jump(self.loops[-1].again)


_ALL_CONSTANTS = "an unrolled loop goes over all its constants, without `else`"
_NO_REMAINDER = "// and % are for numbers that clearly cannot be negative"


def has_duals(type_: Type) -> bool:
    """Whether a value of a type has derivatives somewhere."""
    if isinstance(type_, Tuple):
        return any(map(has_duals, type_.items))
    return (type_.element if isinstance(type_, Array) else type_) == DUAL


def _without_derivatives(type_: Type) -> Type:
    """The type of a number, or of an array, whose text is printed for duals."""
    if isinstance(type_, Array):
        return type_._replace(element=FLOAT) if type_.element == DUAL else type_
    return FLOAT if type_ == DUAL else type_


def _is_slice(node: ast.Subscript) -> bool:
    return isinstance(node.slice, ast.Slice)


def _is_place(value: Value) -> bool:
    """Whether a value is the place of one number of an array."""
    return isinstance(value.type, Array) and value.type.dimensions == 0


def _unrolled(loop: ast.For | ast.comprehension) -> ast.expr | None:
    """The constants that a loop goes over which is marked `unrolled`, or None."""
    match loop.iter:
        case ast.Call(func=ast.Name("unrolled"), args=[of]):
            return of
    return None


@lru_cache(maxsize=10_000)  # asked for by every statement that another one is within
def _stores(statement: ast.stmt) -> Mapping[str, int]:
    """Names that are assigned in a statement, and in how many places of it."""
    match statement:
        case ast.Assign(targets=targets):
            pass
        case ast.For() if _unrolled(statement) is not None:
            targets = []  # a constant
        case ast.AugAssign(target=target) | ast.For(target=target):
            targets = [target]
        case _:
            targets = []
    stores: dict[str, int] = {}
    for target in targets:
        for node in (target,) if isinstance(target, ast.Name) else ast.walk(target):
            if isinstance(node, ast.Name) and isinstance(node.ctx, ast.Store):
                stores[node.id] = stores.get(node.id, 0) + 1
    for inner in (*getattr(statement, "body", ()), *getattr(statement, "orelse", ())):
        for name, count in _stores(inner).items():
            stores[name] = stores.get(name, 0) + count
    return stores


_BUILT_IN: dict[str, Callable[..., Value]] = {
    "abs": Lines.absolute, "max": Lines.largest, "min": Lines.least, "len": Lines.length,
    "float": Lines.as_float, "int": Lines.as_int,
    "value": Lines.value, "moving": Lines.moving, "rate": Lines.rate,
}  # fmt: skip
_TAKES = {"moving": 2}
"""How many arguments they take, if not one."""
