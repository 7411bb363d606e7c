"""The texts of a program: their functions, and their constants and records by name."""

from __future__ import annotations

import ast
import operator
from abc import ABC, abstractmethod
from collections.abc import Callable, Collection, Iterable, Mapping
from typing import TYPE_CHECKING, Any, NamedTuple, NoReturn

from rockeom.compiler.modules import Modules, Refused, Text, parsed
from rockeom.compiler.types import BOOL, DUAL, FLOAT, INT, NOTHING, Array, Tuple, Type

if TYPE_CHECKING:  # machine code that is cached is loaded without what prints it
    from rockeom.compiler.lines import Value

ANNOTATIONS: dict[str, Type] = {
    "int": INT, "float": FLOAT, "bool": BOOL,
    "Floats": Array(FLOAT, 1), "Floats2": Array(FLOAT, 2), "Floats3": Array(FLOAT, 3),
    "Ints": Array(INT, 1), "Ints2": Array(INT, 2),
    "Duals": Array(DUAL, 1), "Duals2": Array(DUAL, 2), "Duals3": Array(DUAL, 3),
}  # fmt: skip


class Definition(NamedTuple):
    """A function in a text."""

    tree: ast.FunctionDef
    text: Text
    marks: frozenset[str]

    def refuse(self, node: ast.AST | None, why: str) -> NoReturn:
        line = getattr(node, "lineno", self.tree.lineno)
        raise Refused(f"{self.text.name}, line {line}, in {self.tree.name}: {why}")

    def arguments(self, names: Mapping[str, Any]) -> tuple[tuple[str, Type], ...]:
        """Names and annotated types of the arguments of an entry; names : of its text."""
        arguments = []
        for argument in self.tree.args.args:
            annotation = argument.annotation
            name = annotation.id if isinstance(annotation, ast.Name) else ""
            fields = fields_of(names.get(name)) or {}
            items = tuple(item for item in fields.values() if item is not None)
            type_ = ANNOTATIONS.get(name, Tuple(items, tuple(fields)))
            if type_ == NOTHING or len(items) < len(fields):
                self.refuse(argument, f"{argument.arg} has no annotation that is known")
            arguments.append((argument.arg, type_))
        return tuple(arguments)


def fields_of(value: Any) -> dict[str, Type | None] | None:
    """The fields of a record, with the types that annotations say; None of other values."""
    if not (isinstance(value, type) and issubclass(value, tuple)):
        return None
    annotations = value.__annotations__.items()
    return {f: ANNOTATIONS.get(getattr(a, "__forward_arg__", "")) for f, a in annotations}


class Texts(ABC):
    """Texts with all that they import, and what a back end makes of their functions.

    roots : the texts whose entries are wanted. modules : where others are that they import.
    contract : False rounds every operation by itself. growth : lines by which a program may grow by
    one function that is written out wherever it is called.

    Raises Refused where two texts define one name: a program has one home for each.
    """

    def __init__(
        self, roots: Iterable[Text], modules: Modules, contract: bool, growth: float
    ) -> None:
        self.texts, self.modules = modules.closure(roots), modules
        self.contract, self.growth = contract, growth
        self.definitions: dict[tuple[str, str], Definition] = {}  # by text and name
        self.rules: dict[str, Definition] = {}  # of derivatives, by the function that has them
        self.sizes: dict[str, int] = {}  # lines of each function that is marked @inlined
        self.written_out: set[str] = set()  # those of them that are written out at every call
        self.declared: dict[str, str] = {}
        self._spaces: dict[str, dict[str, Any]] = {}
        self._parsed = {text.name: parsed(text.source, text.name) for text in self.texts}
        homes: dict[str, str] = {}
        for text in self.texts:
            parts = self._parsed[text.name]
            lines = {name: tree.lineno for name, tree in parts.functions.items()}
            for name, line in (parts.constants | lines).items() if text.alone else ():
                home = f"{text.name}, line {line}"
                if homes.setdefault(name, home) != home and not name.startswith("__"):
                    raise Refused(f"{name} has two homes in one program: {homes[name]}, and {home}")
            for name, tree in parts.functions.items():
                self._define(name, tree, text)
        for text in self.texts:
            self.names_in(text)

    def _define(self, name: str, tree: ast.FunctionDef, text: Text) -> None:
        marks = frozenset(d.id for d in tree.decorator_list if isinstance(d, ast.Name))
        definition = Definition(tree, text, marks)
        self.definitions[text.name, name] = definition
        for mark in tree.decorator_list:
            if isinstance(mark, ast.Call) and ast.unparse(mark.func) == "rule_of":
                self.rules[ast.unparse(mark.args[0])] = definition

    @property
    def names(self) -> dict[str, Any]:
        """The constants of all texts, by name."""
        return {name: value for space in self._spaces.values() for name, value in space.items()}

    def names_in(self, text: Text) -> dict[str, Any]:
        """The constants that a text has or imports, by name."""
        if text.name not in self._spaces:
            names = self._spaces[text.name] = {"__name__": text.name}
            for name in self._parsed[text.name].imported:
                for home in self._homes(name, text):
                    is_function = name in self._parsed[home.name].functions
                    if not is_function and name in (constants := self.names_in(home)):
                        names[name] = constants[name]
            self._parsed[text.name].bind(names)  # what is absent is an error where it is used
        return self._spaces[text.name]

    def _homes(self, name: str, text: Text) -> list[Text]:
        """The texts from which a text imports a name and that have it; none if it is absent."""
        module = self._parsed[text.name].imported.get(name)
        homes = self.modules.texts_of(module) if module else ()
        return [home for home in homes if self._parsed[home.name].has(name, module)]

    def defined(self, name: str, text: Text) -> Definition | None:
        """The function that a name in a text means, its own or one that it imports, if any."""
        if name in self._parsed[text.name].functions:
            return self.definitions[text.name, name]
        for home in self._homes(name, text):
            return self.defined(name, home)
        return None

    @abstractmethod
    def function(
        self,
        definition: Definition,
        types: tuple[Type, ...],
        node: ast.AST | None,
        caller: Definition,
    ) -> tuple[str, Type]:
        """Symbol and type of what is returned, of a function for these types of arguments."""

    @abstractmethod
    def constant(self, value: Any) -> Value | None:
        """A table of numbers as an array of the program, or None if it is none."""

    @abstractmethod
    def site(self, text: Text, line: int) -> str:
        """Operands that say where a check is; empty where there are none."""


# -- constants -----------------------------------------------------------------------------------

UNKNOWN = object()
"""The value of an expression that is not known before the program runs."""


class Constants:
    """Values of expressions that are made of the constants of texts alone.

    names : the constants. variables : names that mean something else here.
    """

    def __init__(self, names: Mapping[str, Any], variables: Collection[str] = ()) -> None:
        self.names, self.variables = names, variables
        self.unknown: set[ast.expr] = set()  # those that were looked at before

    def value(self, node: ast.expr) -> Any:
        """The value of an expression, or UNKNOWN."""
        if node in self.unknown:
            return UNKNOWN
        value = self._value(node)
        if value is UNKNOWN:
            self.unknown.add(node)
        return value

    def _value(self, node: ast.expr) -> Any:
        match node:
            case ast.Constant():
                return node.value
            case ast.Name():
                value = self.names.get(node.id)
                if node.id not in self.variables and value is not None and not callable(value):
                    return value
            case ast.BinOp() if type(node.op) in OPERATORS:
                return self._of_known(OPERATORS[type(node.op)], node.left, node.right)
            case ast.Subscript() if not isinstance(node.slice, ast.Slice):
                return self._of_known(operator.getitem, node.value, node.slice)
            case ast.UnaryOp() if type(node.op) in OPERATORS:
                return self._of_known(OPERATORS[type(node.op)], node.operand)
            case ast.Compare(ops=[op]) if type(op) in OPERATORS:
                return self._of_known(OPERATORS[type(op)], node.left, *node.comparators)
            case ast.BoolOp(op=ast.And()):
                if any(self.value(part) is False for part in node.values):
                    return False
            case ast.Attribute(value=ast.Name(id="math" | "np" as library)):
                value = getattr(self.names.get(library), node.attr, None)
                if isinstance(value, float):
                    return value
            case ast.Tuple():
                return self._of_known(_as_tuple, *node.elts)
            case ast.Call(func=ast.Name(id="len" | "range" as name), args=of):
                return self._of_known(len if name == "len" else range, *of)
        return UNKNOWN

    def _of_known(self, operation: Callable[..., Any], *nodes: ast.expr) -> Any:
        """The result of an operation in Python, if all values are known.

        The last is looked at first: a long sum is deep on its left, and shallow on its right.
        """
        values = []
        for node in reversed(nodes):
            value = self.value(node)
            if value is UNKNOWN:
                return UNKNOWN
            values.append(value)
        return operation(*reversed(values))

    def maybe(self, node: ast.expr) -> Any:
        """The value of an expression, or None."""
        value = self.value(node)
        return None if value is UNKNOWN else value

    def whole(self, node: ast.expr) -> int | None:
        """The value of an expression if it is a whole number, or None."""
        value = self.maybe(node)
        return value if isinstance(value, int) and not isinstance(value, bool) else None


def _as_tuple(*items: Any) -> tuple[Any, ...]:
    return items


OPERATORS: dict[type, Callable[..., Any]] = {
    ast.USub: operator.neg, ast.UAdd: operator.pos, ast.Not: operator.not_,
    ast.Add: operator.add, ast.Sub: operator.sub, ast.Mult: operator.mul, ast.Pow: operator.pow,
    ast.Div: operator.truediv, ast.FloorDiv: operator.floordiv, ast.Mod: operator.mod,
    ast.Lt: operator.lt, ast.LtE: operator.le, ast.Gt: operator.gt, ast.GtE: operator.ge,
    ast.Eq: operator.eq, ast.NotEq: operator.ne,
}  # fmt: skip
"""Operators of Python, by their classes."""
