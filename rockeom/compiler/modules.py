"""Texts as modules: where each is, what it imports from others, and what it defines.

A text imports as any module of Python does, by `from rockeom.x import name`. Python itself imports
nothing for it: the text of that module becomes part of the program, its constants are worked out
in a namespace of its own, and its functions are printed where they are called. Only imports from
`rockeom.compiler`, the language of texts, and from other packages are those of Python.

Some names differ from program to program, such as the equations of motion. A module that only
declares them stands for the texts that a program is built with, see `Modules.provided`.
"""

from __future__ import annotations

import ast
import re
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass, field, replace
from functools import cache, lru_cache
from importlib.resources import files
from types import CodeType
from typing import Any, NamedTuple

_IMPORTED = re.compile(r"^ *from (rockeom\.[\w.]+) import ", re.MULTILINE)
_LANGUAGE = "rockeom.compiler"
"""The language of texts, which is no part of their programs."""
_FUTURE = annotations.compiler_flag
"""Annotations of records are read by their names in all texts."""
_ROUNDED = "\n__fused__ = False"
"""A line of a text whose products and sums are rounded one by one."""


@dataclass(frozen=True)
class Text:
    """A part of a program: its name, its source, whether a*b + c may be rounded once.

    elsewhere : its entries are another program's, which this one calls. alone : nothing else in a
    program has the name of one of its constants; what is written for one structure has its own
    words.
    """

    name: str
    source: str
    fused: bool = False
    elsewhere: bool = False
    alone: bool = False


class Refused(SyntaxError):  # noqa: N818
    """A text that is not in the closed part of Python, with its file and line."""


@cache
def module_text(module: str) -> Text:
    """The text of a module of rockeom, by the module's name."""
    path = "/".join(module.split(".")[1:]) + ".py"
    source = files("rockeom").joinpath(path).read_text(encoding="utf-8")
    return Text(path, source, fused=_ROUNDED not in source, alone=True)


@lru_cache(maxsize=1024)
def imported_modules(source: str) -> tuple[str, ...]:
    """The modules of rockeom that a text imports from anywhere in it, the language apart.

    By the first words of its lines: a later process need not parse texts to know that they are
    those that a program was made of.
    """
    modules = dict.fromkeys(_IMPORTED.findall(source))
    return tuple(m for m in modules if not f"{m}.".startswith(f"{_LANGUAGE}."))


@dataclass(frozen=True)
class Modules:
    """The texts that modules stand for.

    provided : of modules that declare names only, the texts that define them in this program.
    read : the text of another module.
    """

    provided: Mapping[str, tuple[Text, ...]] = field(default_factory=dict)
    read: Callable[[str], Text] = module_text

    def texts_of(self, module: str) -> tuple[Text, ...]:
        return self.provided[module] if module in self.provided else (self.read(module),)

    def closure(self, roots: Iterable[Text]) -> list[Text]:
        """The texts `roots` and all that they import, each behind those that it imports.

        Where texts import one another, the order is that in which they are first named.
        """
        closure: list[Text] = []
        visited: set[str] = set()

        def visit(text: Text) -> None:
            if text.name in visited:
                return
            visited.add(text.name)
            for module in imported_modules(text.source):
                for imported in self.texts_of(module):
                    visit(imported)
            closure.append(text)

        for root in roots:
            visit(root)
        return closure


class Parsed(NamedTuple):
    """A text in parts: its functions, the module of each name that it imports, all else.

    constants : the lines of other names that it binds. rest : its statements, but for functions and
    what is imported from texts; code : the same compiled.
    """

    functions: dict[str, ast.FunctionDef]
    imported: dict[str, str]
    constants: dict[str, int]
    rest: tuple[ast.stmt, ...]
    code: CodeType

    def has(self, name: str, but: str | None) -> bool:
        """Whether it binds a name, or imports it from another module than `but`."""
        imported = self.imported.get(name, but) != but
        return imported or name in self.functions or name in self.constants

    def bind(self, names: dict[str, Any]) -> None:
        """Bind its constants; one that is made of an absent name is absent, too."""
        if not _is_bound(self.code, names):
            for statement in self.rest:
                _is_bound(_compiled([statement], names["__name__"]), names)


def _imports_text(node: ast.stmt) -> bool:
    """Whether a statement imports names from a text."""
    of = getattr(node, "module", None)
    return isinstance(node, ast.ImportFrom) and bool(imported_modules(f"from {of} import "))


def _functions(node: ast.stmt) -> Iterator[ast.FunctionDef]:
    """The function that a statement defines, or those of SLOPES, a table of derivatives."""
    match node:
        case ast.FunctionDef():
            yield node
        case ast.AnnAssign(target=ast.Name("SLOPES"), value=ast.Dict(keys=keys, values=values)):
            for of, slope in zip(keys, values, strict=True):
                assert isinstance(of, ast.Attribute)
                assert isinstance(slope, ast.Lambda)
                mark, body = ast.Call(ast.Name("rule_of"), [of], []), ast.Return(slope.body)
                function = ast.FunctionDef(f"{of.attr}_slope", slope.args, [body], [mark])
                yield ast.copy_location(function, slope)


@lru_cache(maxsize=256)  # the loop and the steps are those of many structures
def parsed(source: str, name: str) -> Parsed:
    """The parts of a text; raises Refused for a name that is imported under another one."""
    tree = ast.parse(source, name)
    functions: dict[str, ast.FunctionDef] = {}
    imported: dict[str, str] = {}
    constants: dict[str, int] = {}
    rest: list[ast.stmt] = []
    for node in tree.body:
        functions |= {function.name: function for function in _functions(node)}
        if isinstance(node, ast.ImportFrom) and _imports_text(node):
            for alias in node.names:
                if alias.asname is not None:
                    raise Refused(f"{name}, line {node.lineno}: {alias.name} has one name only")
                imported[alias.name] = str(node.module)
        elif not isinstance(node, ast.FunctionDef):
            rest.append(node)
            constants |= dict.fromkeys(_names_bound(node), node.lineno)
    return Parsed(functions, imported, constants, tuple(rest), _compiled(rest, name))


def _is_bound(code: CodeType, names: dict[str, Any]) -> bool:
    """Run statements; whether all names are there that they are made of."""
    try:
        exec(code, names)
    except NameError:
        return False
    return True


def _compiled(statements: list[ast.stmt], name: str) -> CodeType:
    return compile(ast.Module(statements, []), name, "exec", _FUTURE)


def without(text: Text, name: str) -> Text:
    """A text without one of its functions."""
    tree = ast.parse(text.source)
    tree.body = [node for node in tree.body if getattr(node, "name", "") != name]
    return replace(text, source=ast.unparse(tree))


def as_python(texts: Iterable[Text], names: dict[str, Any]) -> dict[str, Any]:
    """Run texts as Python, each behind those that it imports, in one namespace, and return that.

    names : of it, among them all that is provided.
    """
    for text in texts:
        tree = ast.parse(text.source, text.name)
        tree.body = [node for node in tree.body if not _imports_text(node)]
        exec(compile(tree, text.name, "exec"), names)
    return names


def _names_bound(statement: ast.stmt) -> list[str]:
    """Names of constants and classes that a statement at the top of a module binds."""
    match statement:
        case ast.ClassDef(name=name):
            return [name]
        case ast.Assign(targets=targets):
            nodes = [node for target in targets for node in ast.walk(target)]
            return [node.id for node in nodes if isinstance(node, ast.Name)]
        case ast.AnnAssign(target=ast.Name(id=name), value=ast.expr()):
            return [name]
    return []
