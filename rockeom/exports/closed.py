"""The functions of a generated module as they are written out for another language.

The front end of the compiler types them, and refuses the same texts. This module finds out which
arrays a function changes, which values it needs, and which names mean something else in the other
language.
"""

import ast
import re
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property, lru_cache, reduce
from typing import Any, NamedTuple, NoReturn

from rockeom.compiler.frontend import Function as Typed
from rockeom.compiler.lines import described, joined
from rockeom.compiler.modules import Modules, Text
from rockeom.compiler.parsed import UNKNOWN, Constants
from rockeom.compiler.printer import Program
from rockeom.compiler.types import BOOL, FLOAT, INT, NOTHING, Array, Tuple, Type


class Unwritten(NotImplementedError):  # noqa: N818
    """A part of a text that is not written in another language, by function and line."""


def joined_type(one: Type, other: Type) -> Type:
    """The type of a value that has either."""
    type_ = joined(one, other)
    if type_ is None:
        raise Unwritten(f"either {described(one)} or {described(other)}")
    return type_


def number_of(type_: Type) -> str:
    """The type of the numbers in a value."""
    if isinstance(type_, Array):
        return type_.element
    if isinstance(type_, Tuple):
        return number_of(reduce(joined_type, type_.items))
    return type_


def is_row(type_: Type) -> bool:
    """Whether a value is a tuple of numbers."""
    return isinstance(type_, Tuple) and type_ != NOTHING


class Alias(NamedTuple):
    """A name for the part of an array from some place on."""

    array: str
    first: ast.expr


@dataclass
class Function:
    """One function: its tree, and the types of its variables and of its other expressions.

    fills : arrays among its arguments that it changes. lengths : of arrays of its own.
    """

    name: str
    tree: ast.FunctionDef
    types: dict[str, Type]
    typed: dict[ast.expr, Type]
    returns: Type
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

    roots, modules : the texts and what they import, as of `Program`.
    entries : by name the types of their arguments. constants : of the texts, by name.
    """

    def __init__(
        self, roots: Iterable[Text], modules: Modules, entries: Mapping[str, Sequence[Type]]
    ) -> None:
        program = Program(roots, modules)
        self.constants: dict[str, Any] = program.names
        self.entries = tuple(entries)
        self.values = Constants(self.constants)
        typed = _typed(program, entries)
        self.by_name = {name: self._read(name, all_) for name, all_ in typed.items()}
        for function in self.by_name.values():
            self._find_calls(function)
        for function in self.ordered():
            self._read_arrays(function)
        for function in self.by_name.values():
            function.body, _ = _needed(self, function.body, frozenset())
            self._find_calls(function)

    def _read(self, name: str, typed: Sequence[Typed]) -> Function:
        """A function by what the front end says of it, for all types that it is called with."""
        tree = typed[0].definition.tree
        body = _pruned(tree.body, self.values)
        written = ast.FunctionDef(name, tree.args, body, [])
        return Function(
            name,
            ast.copy_location(written, tree),
            _merged(one.types for one in typed),
            _merged(one.typed for one in typed),
            reduce(joined_type, (one.returns for one in typed)),
        )

    def _find_calls(self, function: Function) -> None:
        """The functions that it calls, in the order in which their values are found."""
        calls: dict[str, None] = {}

        def add(call: ast.Call) -> None:
            for argument in call.args:
                if isinstance(argument, ast.Call):
                    add(argument)
            if (name := ast.unparse(call.func)) in self.by_name:
                calls[name] = None

        for statement in function.body:
            for call in calls_in(statement):
                add(call)
        function.calls = list(calls)

    def _read_arrays(self, function: Function) -> None:
        """Find out which arrays a function changes, and which are parts of others."""
        changed: list[ast.expr] = []
        for node in (n for statement in function.body for n in ast.walk(statement)):
            match node:
                case ast.Assign(targets=targets, value=value):
                    for target in targets:
                        for one, source in pairs(target, value) or _each(target):
                            changed += self._assigned(function, one, source)
                case ast.AugAssign(target=ast.Subscript() as target):
                    changed.append(base_of(target))
                case ast.Call() if called := self.by_name.get(ast.unparse(node.func)):
                    given = zip(called.arguments, node.args, strict=True)
                    changed += [base_of(x) for own, x in given if own in called.fills]
        for array in changed:
            self.fill(function, array)

    def _assigned(
        self, function: Function, target: ast.expr, value: ast.expr | None
    ) -> list[ast.expr]:
        """Note an array that is made, or a part that gets a name; the array that is changed."""
        match target, value:
            case ast.Subscript(), _:
                return [base_of(target)]
            case ast.Name(id=name), ast.Call(args=[size, *_]) if made_array(value):
                function.lengths[name] = self.constant(size)
            case ast.Name(id=name), ast.Subscript(slice=ast.Slice() as part):
                base = base_of(value)
                if not isinstance(base, ast.Name) or part.upper or part.lower is None:
                    function.refuse(value, "a part of an array is array[first:]")
                function.aliases[name] = Alias(base.id, part.lower)
        return []

    def changes(self, node: ast.AST) -> bool:
        """Whether a call in it changes an array."""
        called = (self.by_name.get(ast.unparse(call.func)) for call in calls_in(node))
        return any(function is not None and function.filled for function in called)

    def ordered(self) -> list[Function]:
        """Each behind those that it calls."""
        order: dict[str, Function] = {}

        def add(name: str) -> None:
            if name not in order:
                for called in self.by_name[name].calls:
                    add(called)
                order[name] = self.by_name[name]

        for name in self.entries:
            add(name)
        return list(order.values())

    def type_of(self, function: Function, node: ast.expr) -> Type:
        """The type of an expression."""
        if isinstance(node, ast.Name) and node.id in function.own:
            return function.types[node.id]
        if node not in function.typed:  # a part of an expression that is constant as a whole
            value = self.values.value(node)
            return BOOL if isinstance(value, bool) else INT if isinstance(value, int) else FLOAT
        return function.typed[node]

    def fill(self, function: Function, node: ast.expr) -> None:
        """An array is changed, and with it that of which it is a part."""
        if not isinstance(node, ast.Name):
            function.refuse(node, "only an array with a name is changed")
        name = node.id
        function.fills.add(name)
        if name in function.aliases:
            self.fill(function, ast.Name(function.aliases[name].array))

    def constant(self, node: ast.expr) -> Any:
        """The value of an expression of constants; raises LookupError for any other."""
        value = self.values.value(node)
        if value is UNKNOWN:
            raise LookupError(ast.unparse(node))
        return value


def _typed(program: Program, entries: Mapping[str, Sequence[Type]]) -> dict[str, list[Typed]]:
    """Typed functions and all that they call, for the widest types, too."""
    homes = {name: definition for (_, name), definition in program.definitions.items()}
    wanted: dict[str, tuple[Type, ...]] = {}
    wider = {name: tuple(types) for name, types in entries.items()}
    while wider != wanted:
        wanted = wider
        for name, types in wanted.items():
            if name not in homes:
                raise Unwritten(f"no function {name} is known")
            program.function(homes[name], types, None, homes[name])
        wider = {}
        for _, name, types in program.functions:
            old = wider.get(name, types)
            wider[name] = tuple(map(joined_type, old, types))
    of_each: dict[str, list[Typed]] = {}
    for (_, name, _), function in program.functions.items():
        of_each.setdefault(name, []).append(function)
    return of_each


def _merged(types: Iterable[Mapping[Any, Type]]) -> dict[Any, Type]:
    """Types by their keys, each the widest."""
    widest: dict[Any, Type] = {}
    for some in types:
        for key, type_ in some.items():
            widest[key] = joined_type(widest.get(key, type_), type_)
    return widest


def _pruned(body: Sequence[ast.stmt], constants: Constants) -> list[ast.stmt]:
    """Statements without what never happens, by what is constant."""
    left: list[ast.stmt] = []
    for statement in body:
        match statement:
            case ast.If(test=test, body=yes, orelse=no):
                value = constants.value(test)
                if value is not UNKNOWN:
                    left += _pruned(yes if value else no, constants)
                    continue
                new: ast.stmt = ast.If(test, _pruned(yes, constants), _pruned(no, constants))
            case ast.While(test=test, body=inner):
                new = ast.While(test, _pruned(inner, constants), [])
            case ast.For(target=target, iter=range_, body=inner):
                new = ast.For(target, range_, _pruned(inner, constants), [])
            case _:
                new = statement
        left.append(ast.copy_location(new, statement))
    return left or [ast.Pass()]


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
                    names = [
                        ast.Name("_", ast.Store())
                        if isinstance(item, ast.Name) and item.id not in after
                        else item
                        for item in target.elts
                    ]
                    if not functions.changes(value) and all(
                        isinstance(item, ast.Name) and item.id == "_" for item in names
                    ):
                        continue
                    new = ast.Assign([ast.Tuple(names, ast.Store())], value)
                    statement = ast.copy_location(new, statement)
                elif not pairs_left:
                    continue
                elif isinstance(target, ast.Tuple):
                    targets, values = zip(*pairs_left, strict=True)
                    one = len(targets) == 1
                    left = targets[0] if one else ast.Tuple(list(targets), ast.Store())
                    right = values[0] if one else ast.Tuple(list(values), ast.Load())
                    statement = ast.copy_location(ast.Assign([left], right), statement)
                after = after - given_names(statement) | _loads(statement)
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


def given_names(statement: ast.Assign) -> Live:
    targets = [t for target in statement.targets for t in getattr(target, "elts", [target])]
    return frozenset(t.id for t in targets if isinstance(t, ast.Name))


@lru_cache(maxsize=20_000)  # asked for in every pass
def calls_in(node: ast.AST) -> tuple[ast.Call, ...]:
    return tuple(n for n in ast.walk(node) if isinstance(n, ast.Call))


def base_of(node: ast.expr) -> ast.expr:
    """The object of a subscript."""
    while isinstance(node, ast.Subscript):
        node = node.value
    return node


def indices_of(node: ast.Subscript) -> list[ast.expr]:
    """The indices of an item, outer ones first."""
    indices: list[ast.expr] = []
    base: ast.expr = node
    while isinstance(base, ast.Subscript):
        indices.insert(0, base.slice)
        base = base.value
    return indices


def names_of(node: ast.AST) -> Iterator[ast.Name]:
    return (n for n in ast.walk(node) if isinstance(n, ast.Name))


@lru_cache(maxsize=20_000)  # asked for by every block around it
def words(node: ast.AST) -> frozenset[str]:
    """All names in a part of a function."""
    return frozenset(n.id for n in names_of(node))


def stored(node: ast.AST) -> set[str]:
    """Names that are given a value somewhere, or are arguments."""
    names = {n.id for n in names_of(node) if isinstance(n.ctx, ast.Store)}
    return names | {a.arg for a in ast.walk(node) if isinstance(a, ast.arg)}


def loaded(node: ast.AST) -> set[str]:
    """Names whose values are asked for."""
    names = set()
    for part in ast.walk(node):
        if isinstance(part, ast.Name) and isinstance(part.ctx, ast.Load):
            names.add(part.id)
        elif isinstance(part, ast.AugAssign) and isinstance(part.target, ast.Name):
            names.add(part.target.id)
    return names


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


def _each(target: ast.expr) -> list[tuple[ast.expr, None]]:
    """Targets whose values a function returns."""
    return [(item, None) for item in getattr(target, "elts", ())]


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


_KEPT = re.compile(r"(kept|pair|so|i)_\d+_")
"""Names of temporary values, see `Writer.new`."""


class Names:
    """Names as another language takes them, each its own.

    reserved : what means something there.
    """

    def __init__(self, reserved: Collection[str], longest: int = 60) -> None:
        self.reserved, self.longest = frozenset(reserved), longest
        self.words: dict[str, str] = {}
        self.taken: set[str] = set()

    def of(self, name: str) -> str:
        if name not in self.words:
            word = in_plain_letters(name)[: self.longest]
            number = 1
            while word in self.reserved or word in self.taken or _KEPT.fullmatch(word):
                number += 1
                word = f"{in_plain_letters(name)[: self.longest]}_{number}"
            self.words[name] = word
            self.taken.add(word)
        return self.words[name]


def in_plain_letters(name: str) -> str:
    """A name of letters that every compiler takes, beginning with one of them."""
    plain = "".join(
        c if c.isascii() and (c.isalnum() or c == "_") else f"u{ord(c):04x}" for c in name
    )
    return plain if plain[:1].isalpha() else f"x{plain}"


def printable(text: str) -> str:
    """A text of one line for a comment or a string."""
    return "".join(c if c.isprintable() else c.encode("unicode_escape").decode() for c in text)
