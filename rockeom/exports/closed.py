"""The functions of a generated module as they are written out for another language.

Generated modules stand in a closed part of Python, see `rockeom.compiler.printer`: numbers, tuples
of them, arrays that are passed in, calls, `while`, `for`, `if`. What a language with declared types
must be told is found out here: the type of each variable, which arrays a function fills, what is
needed of its values, and which names would mean something else there.
"""

from __future__ import annotations

import ast
import math
import operator
import re
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property, lru_cache
from typing import Any, NamedTuple, NoReturn

import numpy as np

from rockeom.compiler.printer import Program, Text
from rockeom.compiler.types import MATH

INT, BOOL, FLOAT = "int", "bool", "float"


class Array(NamedTuple):
    """Numbers of one type, one after the other."""

    element: str


class Row(NamedTuple):
    """A tuple of as many numbers of one type."""

    element: str
    size: int


Type = str | Array | Row | None
"""None is what is not known yet, or a function that gives nothing back."""


class Unwritten(NotImplementedError):  # noqa: N818
    """Of a text what is not written in another language, by function and line."""


def joined(one: Type, other: Type) -> Type:
    """The type of what may be either."""
    if one is None or one == other:
        return other
    if other is None:
        return one
    if isinstance(one, Row) and isinstance(other, Row) and one.size == other.size:
        return Row(str(joined(one.element, other.element)), one.size)
    if isinstance(one, str) and isinstance(other, str):
        return FLOAT if FLOAT in (one, other) else INT
    raise Unwritten(f"either {one} or {other}")


class Alias(NamedTuple):
    """A name for what stands in an array from some place on."""

    array: str
    first: ast.expr


@dataclass
class Function:
    """One function: its tree, and the types of its variables.

    fills : arrays among its arguments that it changes. lengths : of arrays of its own.
    """

    name: str
    tree: ast.FunctionDef
    types: dict[str, Type] = field(default_factory=dict)
    returns: Type = None
    fills: set[str] = field(default_factory=set)
    lengths: dict[str, int] = field(default_factory=dict)
    aliases: dict[str, Alias] = field(default_factory=dict)
    calls: list[str] = field(default_factory=list)

    @property
    def loaded(self) -> set[str]:
        """Names whose values it asks for."""
        return set().union(*map(loaded, self.body))

    @cached_property
    def arguments(self) -> list[str]:
        return [a.arg for a in self.tree.args.args]

    @cached_property
    def own(self) -> set[str]:
        """Its arguments and variables."""
        return stored(self.tree)

    @cached_property
    def body(self) -> list[ast.stmt]:
        """Without its docstring."""
        return [
            s
            for s in self.tree.body
            if not (isinstance(s, ast.Expr) and isinstance(s.value, ast.Constant))
        ]

    @property
    def filled(self) -> list[str]:
        """The arguments that it changes, in their order."""
        return [a for a in self.arguments if a in self.fills]

    @property
    def doc(self) -> str:
        return ast.get_docstring(self.tree) or ""

    def refuse(self, node: ast.AST, why: str) -> NoReturn:
        raise Unwritten(f"line {getattr(node, 'lineno', 0)} of {self.name}: {why}")


class Functions:
    """Functions of some texts, those that are asked for and all that they call.

    entries : by name the types of their arguments. constants : of the texts, by name.
    """

    def __init__(self, texts: Sequence[Text], entries: Mapping[str, Sequence[Type]]) -> None:
        self.constants: dict[str, Any] = Program(texts).names
        # trees of their own: they are changed, and others print the same texts
        bodies = [ast.parse(text.source, text.name).body for text in texts]
        self.trees = {f.name: f for body in bodies for f in body if isinstance(f, ast.FunctionDef)}
        self.entries = tuple(entries)
        self.known: dict[str, Function] = {}
        self.news = True
        while self.news:
            self.news = False
            for name, types in entries.items():
                self.asked(name, types)
            for function in list(self.known.values()):
                _Reader(self, function).read()
        for function in self.known.values():
            function.body, _ = _needed(self, function.body, frozenset())
            called = {ast.unparse(n.func) for s in function.body for n in calls_in(s)}
            function.calls = [name for name in function.calls if name in called]

    def changes(self, node: ast.AST) -> bool:
        """Whether a call in it changes an array."""
        called = (self.known.get(ast.unparse(call.func)) for call in calls_in(node))
        return any(function is not None and function.filled for function in called)

    def asked(self, name: str, types: Sequence[Type]) -> Function:
        """A function that is called with these types of arguments."""
        if name not in self.known:
            if name not in self.trees:
                raise Unwritten(f"no function {name} is known")
            self.known[name] = Function(name, _Pruned(self.constants).visit(self.trees[name]))
            self.news = True
        function = self.known[name]
        for argument, type_ in zip(function.arguments, types, strict=True):
            self.learn(function, argument, type_)
        return function

    def learn(self, function: Function, name: str, type_: Type) -> None:
        """Widen the type of a variable."""
        found = joined(function.types.get(name), type_)
        if found is not None and found != function.types.get(name):
            function.types[name] = found
            self.news = True

    def ordered(self) -> list[Function]:
        """Each behind those that it calls."""
        found: dict[str, Function] = {}

        def add(name: str) -> None:
            if name not in found:
                for called in self.known[name].calls:
                    add(called)
                found[name] = self.known[name]

        for name in self.entries:
            add(name)
        return list(found.values())

    # -- types --------------------------------------------------------------------------------

    def type_of(self, function: Function, node: ast.expr) -> Type:
        """The type of an expression, as far as it is known."""
        match node:
            case ast.Constant(value=bool()):
                return BOOL
            case ast.Constant(value=value):
                return INT if isinstance(value, int) else FLOAT
            case ast.Name(id=name):
                if name in function.own:
                    return function.types.get(name)
                return self._of_constant(function, node, self.constants.get(name))
            case ast.BinOp(op=ast.Div() | ast.Pow()):
                return FLOAT
            case ast.BinOp(left=left, right=right):
                return joined(self.type_of(function, left), self.type_of(function, right))
            case ast.UnaryOp(op=ast.Not()) | ast.Compare() | ast.BoolOp():
                return BOOL
            case ast.UnaryOp(operand=operand):
                return self.type_of(function, operand)
            case ast.IfExp(body=body, orelse=orelse):
                return joined(self.type_of(function, body), self.type_of(function, orelse))
            case ast.Tuple(elts=items):
                element: Type = None
                for item in items:
                    element = joined(element, self.type_of(function, item))
                return None if element is None else Row(str(element), len(items))
            case ast.Attribute(value=ast.Name(id="math" | "np"), attr=attribute):
                return self._of_constant(function, node, getattr(math, attribute, None))
            case ast.Subscript():
                return self._of_item(function, node)
            case ast.Call():
                return self._of_call(function, node)
        function.refuse(node, f"{type(node).__name__} is not written")

    def _of_constant(self, function: Function, node: ast.expr, value: Any) -> Type:
        while isinstance(value, (tuple, np.ndarray)) and len(value):
            value = value[0]
        if isinstance(value, (bool, np.bool_)):
            return BOOL
        if isinstance(value, (int, np.integer)):
            return INT
        if isinstance(value, (float, np.floating)):
            return FLOAT
        if isinstance(value, (tuple, np.ndarray)):  # of an element that is not there
            return INT
        function.refuse(node, f"{ast.unparse(node)} is no number")

    def _of_item(self, function: Function, node: ast.Subscript) -> Type:
        base = base_of(node)
        if isinstance(base, ast.Name) and base.id not in function.own:
            return self._of_constant(function, base, self.constants.get(base.id))
        type_ = self.type_of(function, base)
        if isinstance(node.slice, ast.Slice):
            return type_
        return type_.element if isinstance(type_, (Array, Row)) else None

    def _of_call(self, function: Function, node: ast.Call) -> Type:
        match node.func:
            case ast.Name(id="abs" | "max" | "min"):
                found: Type = None
                for argument in node.args:
                    found = joined(found, self.type_of(function, argument))
                return found
            case ast.Name(id="int" | "len"):
                return INT
            case ast.Name(id="float"):
                return FLOAT
            case ast.Name(id=name):
                types = [self.type_of(function, a) for a in node.args]
                called = self.asked(name, types)
                if name not in function.calls:
                    function.calls.append(name)
                for own, given in zip(called.arguments, node.args, strict=True):
                    if own in called.fills:
                        self.fill(function, base_of(given))
                return called.returns
            case ast.Attribute(value=ast.Name(id="math"), attr="isfinite"):
                return BOOL
            case ast.Attribute(value=ast.Name(id="math"), attr=name) if name in MATH:
                return FLOAT
            case ast.Attribute(value=ast.Name(id="np"), attr="empty" | "zeros"):
                return Array(INT if len(node.args) > 1 else FLOAT)
        function.refuse(node, f"{ast.unparse(node.func)} is not written")

    def fill(self, function: Function, node: ast.expr) -> None:
        """An array is changed, and with it that of which it is a part."""
        if not isinstance(node, ast.Name):
            function.refuse(node, "only an array with a name is changed")
        name = node.id
        if name not in function.fills:
            function.fills.add(name)
            self.news = True
        if name in function.aliases:
            self.fill(function, ast.Name(function.aliases[name].array))

    def constant(self, node: ast.expr) -> Any:
        """The value of an expression of constants; raises LookupError for any other."""
        return _constant(node, self.constants)


_DONE: dict[type, Callable[..., Any]] = {
    ast.Add: operator.add, ast.Sub: operator.sub, ast.Mult: operator.mul, ast.Div: operator.truediv,
    ast.FloorDiv: operator.floordiv, ast.Mod: operator.mod, ast.USub: operator.neg,
    ast.Lt: operator.lt, ast.LtE: operator.le, ast.Gt: operator.gt, ast.GtE: operator.ge,
    ast.Eq: operator.eq, ast.NotEq: operator.ne,
}  # fmt: skip


def _constant(node: ast.expr, constants: Mapping[str, Any]) -> Any:
    match node:
        case ast.Constant(value=value):
            return value
        case ast.Name(id=name) if isinstance(constants.get(name), (int, float, tuple)):
            return constants[name]
        case ast.BinOp(op=op, left=left, right=right) if type(op) in _DONE:
            return _DONE[type(op)](_constant(left, constants), _constant(right, constants))
        case ast.UnaryOp(op=ast.USub(), operand=operand):
            return -_constant(operand, constants)
        case ast.Compare(left=left, ops=[op], comparators=[right]) if type(op) in _DONE:
            return _DONE[type(op)](_constant(left, constants), _constant(right, constants))
        case ast.Call(func=ast.Name(id="len"), args=[of]):
            return len(_constant(of, constants))
    raise LookupError(ast.unparse(node))


class _Pruned(ast.NodeTransformer):
    """Without what never happens, by what is constant."""

    def __init__(self, constants: Mapping[str, Any]) -> None:
        self.constants = constants

    def visit_If(self, node: ast.If) -> Any:
        try:
            known = _constant(node.test, self.constants)
        except LookupError:
            return self.generic_visit(node)
        kept = node.body if known else node.orelse
        return [self.visit(statement) for statement in kept] or ast.Pass()


Live = frozenset[str]
"""Names whose values are still asked for."""


def _needed(
    functions: Functions, body: Sequence[ast.stmt], after: Live, looping: Live = frozenset()
) -> tuple[list[ast.stmt], Live]:
    """The statements without values that nobody asks for, and the names that they ask for.

    after : names that are asked for behind them; looping : those where a loop goes on or ends.
    """
    kept: list[ast.stmt] = []
    for statement in reversed(body):
        match statement:
            case ast.Return():
                after = _loads(statement)
            case ast.Break() | ast.Continue():
                after = looping
            case ast.Assign(targets=[target], value=value):
                pairs_left = [
                    (t, v)
                    for t, v in pairs(target, value) or [(target, value)]
                    if not isinstance(t, ast.Name) or t.id in after or functions.changes(v)
                ]
                if isinstance(target, ast.Tuple) and not isinstance(value, ast.Tuple):
                    for item in target.elts:
                        if isinstance(item, ast.Name) and item.id not in after:
                            item.id = "_"
                    if not functions.changes(value) and all(
                        isinstance(item, ast.Name) and item.id == "_" for item in target.elts
                    ):
                        continue
                elif not pairs_left:
                    continue
                elif isinstance(target, ast.Tuple):
                    targets, values = zip(*pairs_left, strict=True)
                    one = len(targets) == 1
                    new = targets[0] if one else ast.Tuple(list(targets), ast.Store())
                    given = values[0] if one else ast.Tuple(list(values), ast.Load())
                    statement = ast.copy_location(ast.Assign([new], given), statement)
                after = after - _given_names(statement) | _loads(statement)
            case ast.If(test=test, body=yes, orelse=no):
                yes, before = _needed(functions, yes, after, looping)
                no, otherwise = _needed(functions, no, after, looping)
                statement = ast.copy_location(ast.If(test, yes or [ast.Pass()], no), statement)
                after = before | otherwise | _loads(test)
            case ast.For() | ast.While():
                after = after | _loads(statement)
                statement.body, _ = _needed(functions, statement.body, after, after)
            case ast.Pass():
                continue
            case _:
                after = after | _loads(statement)
        kept.insert(0, statement)
    return kept, after


def _loads(node: ast.AST) -> Live:
    return frozenset(loaded(node))


def _given_names(statement: ast.Assign) -> Live:
    targets = [t for target in statement.targets for t in getattr(target, "elts", [target])]
    return frozenset(t.id for t in targets if isinstance(t, ast.Name))


@lru_cache(maxsize=20_000)  # asked for in every pass
def calls_in(node: ast.AST) -> tuple[ast.Call, ...]:
    return tuple(n for n in ast.walk(node) if isinstance(n, ast.Call))


def base_of(node: ast.expr) -> ast.expr:
    """What is subscripted."""
    while isinstance(node, ast.Subscript):
        node = node.value
    return node


def indices_of(node: ast.Subscript) -> list[ast.expr]:
    """The indices of an item, outer ones first."""
    found: list[ast.expr] = []
    base: ast.expr = node
    while isinstance(base, ast.Subscript):
        found.insert(0, base.slice)
        base = base.value
    return found


def names_of(node: ast.AST) -> Iterator[ast.Name]:
    return (n for n in ast.walk(node) if isinstance(n, ast.Name))


def stored(node: ast.AST) -> set[str]:
    """Names that are given a value somewhere, or are arguments."""
    found = {n.id for n in names_of(node) if isinstance(n.ctx, ast.Store)}
    return found | {a.arg for a in ast.walk(node) if isinstance(a, ast.arg)}


def loaded(node: ast.AST) -> set[str]:
    """Names whose values are asked for."""
    found = set()
    for part in ast.walk(node):
        if isinstance(part, ast.Name) and isinstance(part.ctx, ast.Load):
            found.add(part.id)
        elif isinstance(part, ast.AugAssign) and isinstance(part.target, ast.Name):
            found.add(part.target.id)
    return found


def made_array(node: ast.expr) -> str:
    """How an array of a function's own is made, "empty" or "zeros"; "" for anything else."""
    match node:
        case ast.Call(func=ast.Attribute(value=ast.Name(id="np"), attr="empty" | "zeros" as how)):
            return how
    return ""


def pairs(targets: ast.expr, value: ast.expr) -> list[tuple[ast.expr, ast.expr]] | None:
    """Each target with its value, where a tuple is written out; None where one is returned."""
    if not isinstance(targets, ast.Tuple):
        return [(targets, value)]
    if not isinstance(value, ast.Tuple):
        return None
    return list(zip(targets.elts, value.elts, strict=True))


def one_by_one(several: Sequence[tuple[ast.expr, ast.expr]]) -> bool:
    """Whether no value reads what was assigned before it."""
    if len(several) == 1:
        return True
    changed: set[str] = set()
    for target, value in several:
        if changed & {n.id for n in names_of(value)}:
            return False
        base = base_of(target)
        changed |= {base.id} if isinstance(base, ast.Name) else set()
    return True


class _Reader:
    """Reads one function once, and tells what is new of the types."""

    def __init__(self, functions: Functions, function: Function) -> None:
        self.functions, self.function = functions, function

    def read(self) -> None:
        self._block(self.function.body)

    def _type(self, node: ast.expr) -> Type:
        return self.functions.type_of(self.function, node)

    def _block(self, body: Iterable[ast.stmt]) -> None:
        for statement in body:
            self._statement(statement)

    def _statement(self, statement: ast.stmt) -> None:
        function = self.function
        match statement:
            case ast.Assign(targets=targets, value=value):
                for target in targets:
                    self._assign(target, value)
            case ast.AugAssign(target=target, value=value):
                self._type(value)
                self._give(target, self._type(value))
            case ast.If(test=test, body=body, orelse=orelse):
                self._type_inside(test)
                self._block(body)
                self._block(orelse)
            case ast.While(test=test, body=body):
                self._type_inside(test)
                self._block(body)
            case ast.For(target=ast.Name(id=name), iter=ast.Call(args=args), body=body):
                for argument in args:
                    self._type_inside(argument)
                self.functions.learn(function, name, INT)
                self._block(body)
            case ast.Return(value=None) | ast.Pass() | ast.Break() | ast.Continue():
                pass
            case ast.Return(value=ast.expr() as value):
                self._type_inside(value)
                found = joined(function.returns, self._type(value))
                if found != function.returns:
                    function.returns, self.functions.news = found, True
            case ast.Expr(value=value):
                self._type_inside(value)
            case _:
                function.refuse(statement, f"{type(statement).__name__} is not written")

    def _type_inside(self, node: ast.expr) -> None:
        """Of all calls within an expression, what they are given."""
        for call in calls_in(node):
            self._type(call)

    def _assign(self, target: ast.expr, value: ast.expr) -> None:
        self._type_inside(value)
        several = pairs(target, value)
        if several is None:
            row = self._type(value)
            for part in target.elts:  # type: ignore[attr-defined]
                self._give(part, row.element if isinstance(row, Row) else None)
            return
        for one, given in several:
            if isinstance(one, ast.Name) and made_array(given):
                size = self.functions.constant(given.args[0])  # type: ignore[attr-defined]
                self.function.lengths[one.id] = size
            elif isinstance(one, ast.Name) and isinstance(given, ast.Subscript):
                self._name_part(one.id, given)
            self._give(one, self._type(given))

    def _name_part(self, name: str, given: ast.Subscript) -> None:
        if not isinstance(given.slice, ast.Slice):
            return
        base = base_of(given)
        if not isinstance(base, ast.Name) or given.slice.upper or given.slice.lower is None:
            self.function.refuse(given, "a part of an array is array[first:]")
        self.function.aliases[name] = Alias(base.id, given.slice.lower)
        if name in self.function.fills:
            self.functions.fill(self.function, base)

    def _give(self, target: ast.expr, type_: Type) -> None:
        if isinstance(target, ast.Name):
            self.functions.learn(self.function, target.id, type_)
        elif isinstance(target, ast.Subscript):
            self.functions.fill(self.function, base_of(target))
        else:
            self.function.refuse(target, f"{type(target).__name__} is not assigned to")


_KEPT = re.compile(r"(kept|pair|so|i)_\d+_")
"""Names of what is kept for a moment, see `Writer.new`."""


class Names:
    """Names as another language takes them, each its own.

    reserved : what means something there.
    """

    def __init__(self, reserved: Collection[str], longest: int = 60) -> None:
        self.reserved, self.longest = frozenset(reserved), longest
        self.given: dict[str, str] = {}
        self.taken: set[str] = set()

    def of(self, name: str) -> str:
        if name not in self.given:
            found = in_plain_letters(name)[: self.longest]
            number = 1
            while found in self.reserved or found in self.taken or _KEPT.fullmatch(found):
                number += 1
                found = f"{in_plain_letters(name)[: self.longest]}_{number}"
            self.given[name] = found
            self.taken.add(found)
        return self.given[name]


def in_plain_letters(name: str) -> str:
    """A name of letters that every compiler takes, beginning with one of them."""
    plain = "".join(
        c if c.isascii() and (c.isalnum() or c == "_") else f"u{ord(c):04x}" for c in name
    )
    return plain if plain[:1].isalpha() else f"x{plain}"


def printable(text: str) -> str:
    """A text of one line for a comment or a string."""
    return "".join(c if c.isprintable() else c.encode("unicode_escape").decode() for c in text)
