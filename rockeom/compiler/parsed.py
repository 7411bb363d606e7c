"""Texts as they are parsed: their functions, and their constants and records by name."""

from __future__ import annotations

import ast
import operator
from abc import ABC, abstractmethod
from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import dataclass
from functools import lru_cache
from types import CodeType
from typing import TYPE_CHECKING, Any, NamedTuple, NoReturn

from rockeom.compiler.types import BOOL, DUAL, FLOAT, INT, Array, Tuple, Type

if TYPE_CHECKING:  # machine code that is cached is loaded without what prints it
    from rockeom.compiler.lines import Value

ANNOTATIONS: dict[str, Type] = {
    "int": INT, "float": FLOAT, "bool": BOOL,
    "Floats": Array(FLOAT, 1), "Floats2": Array(FLOAT, 2), "Floats3": Array(FLOAT, 3),
    "Ints": Array(INT, 1), "Ints2": Array(INT, 2),
    "Duals": Array(DUAL, 1), "Duals2": Array(DUAL, 2), "Duals3": Array(DUAL, 3),
}  # fmt: skip


@dataclass(frozen=True)
class Text:
    """A part of a program: its file's name, its source, whether a*b + c may be rounded once.

    elsewhere : its entries are another program's, which this one calls.
    """

    name: str
    source: str
    fused: bool = False
    elsewhere: bool = False


class Refused(SyntaxError):  # noqa: N818
    """A text that is not in the closed part of Python, with its file and line."""


class Definition(NamedTuple):
    """A function in a text."""

    tree: ast.FunctionDef
    text: Text
    marks: frozenset[str]

    def refuse(self, node: ast.AST | None, why: str) -> NoReturn:
        line = getattr(node, "lineno", self.tree.lineno)
        raise Refused(f"{self.text.name}, line {line}, in {self.tree.name}: {why}")

    def arguments(self, records: Mapping[str, Tuple]) -> tuple[tuple[str, Type], ...]:
        """Names and annotated types of the arguments of an entry."""
        types = {**ANNOTATIONS, **records}
        arguments = []
        for argument in self.tree.args.args:
            annotation = argument.annotation
            if not isinstance(annotation, ast.Name) or annotation.id not in types:
                self.refuse(argument, f"{argument.arg} has no annotation that is known")
            arguments.append((argument.arg, types[annotation.id]))
        return tuple(arguments)


class Texts(ABC):
    """Texts that know one another's names, and what a back end makes of their functions.

    names : their constants, for which they are run as Python, but for their functions.
    contract : False rounds every operation by itself. growth : lines by which a program may grow by
    one function that is written out wherever it is called.
    """

    def __init__(self, texts: Sequence[Text], contract: bool, growth: float) -> None:
        self.texts, self.contract, self.growth = texts, contract, growth
        self.names: dict[str, Any] = {"__name__": "rockeom.integrator.program"}
        self.definitions: dict[str, Definition] = {}
        self.sizes: dict[str, int] = {}  # lines of each function that is marked @inlined
        self.written_out: set[str] = set()  # those of them that are written out at every call
        self.declared: dict[str, str] = {}
        for text in texts:
            functions, rest = _parsed(text.source, text.name)
            for node in functions:
                marks = frozenset(d.id for d in node.decorator_list if isinstance(d, ast.Name))
                self.definitions[node.name] = Definition(node, text, marks)
            exec(rest, self.names)
        self.records = {
            name: {
                field: ANNOTATIONS.get(getattr(annotation, "__forward_arg__", ""))
                for field, annotation in value.__annotations__.items()
            }
            for name, value in self.names.items()
            if isinstance(value, type) and issubclass(value, tuple) and value is not NamedTuple
        }
        self.annotated = {  # records with annotations that say all of their types
            name: Tuple(tuple(fields.values()), tuple(fields))  # type: ignore[arg-type]
            for name, fields in self.records.items()
            if None not in fields.values()
        }

    @abstractmethod
    def function(
        self, name: str, types: tuple[Type, ...], node: ast.AST | None, caller: Definition
    ) -> tuple[str, Type]:
        """Symbol and type of what is returned, of a function for these types of arguments."""

    @abstractmethod
    def constant(self, value: Any) -> Value | None:
        """A table of numbers as an array of the program, or None if it is none."""

    @abstractmethod
    def site(self, text: Text, line: int) -> str:
        """Operands that say where a check is; empty where there are none."""


@lru_cache(maxsize=64)  # the loop and the steps are those of many structures
def _parsed(source: str, name: str) -> tuple[list[ast.FunctionDef], CodeType]:
    """The functions of a text, which stay as they are, and all else as code to be run."""
    tree = ast.parse(source, name)
    functions = [node for node in tree.body if isinstance(node, ast.FunctionDef)]
    tree.body = [node for node in tree.body if not isinstance(node, ast.FunctionDef)]
    return functions, compile(tree, name, "exec")


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

    def known(self, node: ast.expr) -> Any:
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
            case ast.BinOp() if type(node.op) in _OPERATORS:
                return self._of_known(_OPERATORS[type(node.op)], node.left, node.right)
            case ast.Subscript() if not isinstance(node.slice, ast.Slice):
                return self._of_known(operator.getitem, node.value, node.slice)
            case ast.UnaryOp() if type(node.op) in _OPERATORS:
                return self._of_known(_OPERATORS[type(node.op)], node.operand)
            case ast.Compare(ops=[op]) if type(op) in _OPERATORS:
                return self._of_known(_OPERATORS[type(op)], node.left, *node.comparators)
            case ast.BoolOp(op=ast.And()):
                if any(self.known(part) is False for part in node.values):
                    return False
            case ast.Attribute(value=ast.Name(id="math" | "np" as library)):
                value = getattr(self.names[library], node.attr, None)
                if isinstance(value, float):
                    return value
            case ast.Tuple():
                return self._of_known(_as_tuple, *node.elts)
            case ast.Call(func=ast.Name(id="len"), args=[of]):
                return self._of_known(len, of)
        return UNKNOWN

    def _of_known(self, operation: Callable[..., Any], *nodes: ast.expr) -> Any:
        """The result of an operation in Python, if all values are known."""
        values = []
        for node in nodes:
            value = self.known(node)
            if value is UNKNOWN:
                return UNKNOWN
            values.append(value)
        return operation(*values)

    def maybe(self, node: ast.expr) -> Any:
        """The value of an expression, or None."""
        value = self.known(node)
        return None if value is UNKNOWN else value

    def whole(self, node: ast.expr) -> int | None:
        """The value of an expression if it is a whole number, or None."""
        value = self.maybe(node)
        return value if isinstance(value, int) and not isinstance(value, bool) else None


def _as_tuple(*items: Any) -> tuple[Any, ...]:
    return items


_OPERATORS: dict[type, Callable[..., Any]] = {
    ast.USub: operator.neg, ast.UAdd: operator.pos, ast.Not: operator.not_,
    ast.Add: operator.add, ast.Sub: operator.sub, ast.Mult: operator.mul, ast.Pow: operator.pow,
    ast.Div: operator.truediv, ast.FloorDiv: operator.floordiv, ast.Mod: operator.mod,
    ast.Lt: operator.lt, ast.LtE: operator.le, ast.Gt: operator.gt, ast.GtE: operator.ge,
    ast.Eq: operator.eq, ast.NotEq: operator.ne,
}  # fmt: skip
"""Operators of Python, by their classes."""
