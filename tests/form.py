"""python -m tests.form: figures of the project's form, and the bounds that they must keep.

A bound may fall, and never rises: a change that needs more finds another way, or says why the
figure is the wrong one. Lines of code are neither blank, nor comments, nor docstrings; rows of
tables of text count, and measured data do not.
"""

from __future__ import annotations

import ast
import io
import re
import sys
import tokenize
from collections import Counter
from collections.abc import Callable, Iterator, Mapping
from importlib import import_module
from pathlib import Path
from typing import NamedTuple

ROOT = Path(__file__).resolve().parent.parent
PACKAGE = ROOT / "rockeom"


class Figure(NamedTuple):
    what: str
    value: int
    bound: int | None


class Function(NamedTuple):
    """A function, and its sizes: lines without docstring, arguments, cyclomatic number."""

    name: str
    lines: int
    arguments: int
    branches: int


class Source(NamedTuple):
    path: str
    text: str
    tree: ast.Module


def sources() -> list[Source]:
    found = []
    for file in sorted(PACKAGE.rglob("*.py")):
        text = file.read_text(encoding="utf-8")
        found.append(Source(file.relative_to(PACKAGE).as_posix(), text, ast.parse(text)))
    return found


def functions(of: list[Source]) -> Iterator[Function]:
    for source in of:
        for node in ast.walk(source.tree):
            if isinstance(node, ast.FunctionDef) and ast.unparse(node.body) != "...":
                yield measured(f"{source.path}: {node.name}", node)


def measured(name: str, node: ast.FunctionDef) -> Function:
    lines = (node.end_lineno or 0) - node.lineno + 1
    first = node.body[0]
    if isinstance(first, ast.Expr) and isinstance(first.value, ast.Constant):
        lines -= (first.end_lineno or 0) - first.lineno + 1
    arguments = node.args
    branches = 1
    for part in ast.walk(node):
        branches += isinstance(part, ast.If | ast.IfExp | ast.For | ast.While)
        branches += len(part.values) - 1 if isinstance(part, ast.BoolOp) else 0
    count = len(arguments.args) + len(arguments.kwonlyargs) + len(arguments.posonlyargs)
    return Function(name, lines, count, branches)


# -- lines of code ---------------------------------------------------------------------------------

SILENT = {
    tokenize.COMMENT, tokenize.NL, tokenize.NEWLINE, tokenize.INDENT, tokenize.DEDENT,
    tokenize.ENDMARKER,
}  # fmt: skip


def code_lines(text: str) -> int:
    """Lines of code of a Python text."""
    lines: set[int] = set()
    for token in tokenize.generate_tokens(io.StringIO(text).readline):
        if token.type not in SILENT:
            lines.update(range(token.start[0], token.end[0] + 1))
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, ast.Module | ast.ClassDef | ast.FunctionDef) and ast.get_docstring(
            node
        ):
            lines.difference_update(range(node.body[0].lineno, node.body[0].end_lineno + 1))
    return len(lines)


def lines_of(path: Path) -> int:
    """Lines of code of a file; 0 where they are not counted."""
    if path.suffix in (".py", ".pyi"):
        return code_lines(path.read_text(encoding="utf-8"))
    rows = [row for row in map(str.strip, path.read_text("utf-8", "replace").splitlines()) if row]
    if path.suffix == ".js":
        code = re.sub(r"^/\*.*?\*/.*?$", "", "\n".join(rows), flags=re.DOTALL | re.MULTILINE)
        return sum(not row.startswith("//") for row in code.splitlines() if row)
    return len(rows) if path.suffix in (".toml", ".csv") and "data" not in path.parts else 0


def lines_by_folder(root: Path) -> Counter[str]:
    """Lines of code of each folder of a package, and of its own files, "."."""
    by_folder: Counter[str] = Counter()
    for path in sorted(root.rglob("*")):
        if path.is_file() and not {"__pycache__", "node_modules"} & {*path.parts}:
            parts = path.relative_to(root).parts
            by_folder[parts[0] if len(parts) > 1 else "."] += lines_of(path)
    return by_folder


# -- imports ---------------------------------------------------------------------------------------


def module_name(path: str) -> str:
    name = "rockeom." + path.removesuffix(".py").replace("/", ".")
    return name.removesuffix(".__init__")


class Imports(NamedTuple):
    """Which modules import which, at run time and for types too, and how many within functions."""

    at_run_time: dict[str, set[str]]
    with_types: dict[str, set[str]]
    within_functions: int


def imports(of: list[Source]) -> Imports:
    names = {module_name(source.path) for source in of}
    at_run_time: dict[str, set[str]] = {name: set() for name in names}
    with_types: dict[str, set[str]] = {name: set() for name in names}
    within = 0

    def visit(node: ast.AST, module: str, inside: bool, types: bool) -> None:
        nonlocal within
        for part in ast.iter_child_nodes(node):
            if isinstance(part, ast.ImportFrom):
                asked = imported(part, names) - {module}
                within += bool(asked) and inside
                with_types[module] |= asked
                if not types:
                    at_run_time[module] |= asked
            in_types = isinstance(part, ast.If) and "TYPE_CHECKING" in ast.unparse(part.test)
            in_function = isinstance(part, ast.FunctionDef | ast.Lambda)
            visit(part, module, inside or in_function, types or in_types)

    for source in of:
        visit(source.tree, module_name(source.path), False, False)
    return Imports(at_run_time, with_types, within)


def imported(node: ast.ImportFrom, names: set[str]) -> set[str]:
    """The package's modules that a statement imports, or imports from."""
    of = node.module or ""
    return {
        f"{of}.{alias.name}" if f"{of}.{alias.name}" in names else of for alias in node.names
    } & names


def circles(graph: Mapping[str, set[str]]) -> list[set[str]]:
    """Modules that import one another, by way of others too."""
    reached = {start: reachable(graph, start) for start in graph}
    found: list[set[str]] = []
    for start in graph:
        circle = {other for other in reached[start] if start in reached[other]}
        if len(circle) > 1 and circle not in found:
            found.append(circle)
    return found


def reachable(graph: Mapping[str, set[str]], start: str) -> set[str]:
    seen, left = {start}, [start]
    while left:
        for other in graph[left.pop()] - seen:
            seen.add(other)
            left.append(other)
    return seen


# -- figures ---------------------------------------------------------------------------------------


def members(of: list[Source], name: str) -> int:
    """Public functions and fields of a class."""
    return sum(
        isinstance(part, ast.AnnAssign)
        or (isinstance(part, ast.FunctionDef) and not part.name.startswith("_"))
        for source in of
        for node in source.tree.body
        if isinstance(node, ast.ClassDef) and node.name == name
        for part in node.body
    )


VAGUE = {"found", "known", "given"}
"""Names that say how a value was obtained, and not what it is."""


def vague_names(of: list[Source]) -> int:
    """How often names of variables, arguments, attributes and functions are vague."""
    fields = "id", "arg", "attr", "name"
    nodes = (node for source in of for node in ast.walk(source.tree))
    return sum(getattr(node, field, None) in VAGUE for node in nodes for field in fields)


def public_names(package: str) -> int:
    """Length of the list __all__ of a package."""
    return len(import_module(package).__all__)


BOUNDS = {
    "rockeom": 71_002, "tests": 54_636, "generated": 14_265, "/.": 330, "/analysis": 8_086,
    "/assessment": 1_684, "/browser": 4_355, "/cli": 2_671, "/codegen": 2_489, "/compiler": 2_165,
    "/drawing": 1_904, "/exports": 1_787, "/generated": 570, "/integrator": 8_115,
    "/modelling": 1_449, "/motion": 4_893, "/numbers": 1_061, "/plots": 1_177, "/simulation": 2_743,
    "/structures": 4_253, "/sweeps": 2_120, "/symbolic": 9_197, "/teaching": 39,
    "/thesis": 9_914,
}  # fmt: skip
"""Lines of code of the package, of each of its folders, of tests and of generated modules."""


def figures() -> list[Figure]:
    of = sources()
    every = list(functions(of))
    edges = imports(of)
    at_run_time = circles(edges.at_run_time)
    # these have as many files as there are subjects, and as there are structures
    by_subject = "thesis", "analysis", "structures/shipped"
    subjects = [s for s in of if not s.path.startswith(by_subject)]
    folders = Counter(str(Path(source.path).parent) for source in subjects)

    def count(pattern: str, where: Callable[[str], bool] = lambda path: True) -> int:
        return sum(len(re.findall(pattern, s.text)) for s in of if where(s.path))

    by_folder = lines_by_folder(PACKAGE)
    models = r"isinstance\([^()]*(?:\([^()]*\))?[^()]*\b(?:Model|RockingModel)\)"
    return [
        Figure("lines of code of the package", by_folder.total(), BOUNDS["rockeom"]),
        *(Figure(f"lines of rockeom/{f}", n, BOUNDS[f"/{f}"]) for f, n in by_folder.items()),
        *(
            Figure(f"lines of {root}", lines_by_folder(ROOT / root).total(), BOUNDS[root])
            for root in ("tests", "generated")
        ),
        Figure("longest function", max(f.lines for f in every), 66),
        Figure("functions over 60 lines", sum(f.lines > 60 for f in every), 1),
        Figure("most arguments", max(f.arguments for f in every), 13),
        Figure("functions of more than 10 arguments", sum(f.arguments > 10 for f in every), 3),
        Figure("highest cyclomatic number", max(f.branches for f in every), 30),
        Figure("circles of files at run time", len(at_run_time), 0),
        Figure("files in them", sum(map(len, at_run_time)), 0),
        Figure("circles of files with types", len(circles(edges.with_types)), 0),
        Figure("imports within functions", edges.within_functions, 22),
        Figure("isinstance of models", count(models), 0),
        Figure("engine flag in the loop", count("N_POINTS", lambda p: p.endswith("loop.py")), 0),
        Figure("questions for points", count(r"has_points\(|stands_on_points"), 6),
        Figure("modules at the root", folders["."], 4),
        Figure("files of a folder", max(folders.values()), 21),
        Figure("names of analysis", public_names("rockeom.analysis"), 11),
        Figure("members of Response", members(of, "Response"), 40),
        Figure("lines of code of a file", max(code_lines(s.text) for s in of), 666),
        Figure("names found, known, given", vague_names(of), 1103),
        Figure("texts that are run", count(r"\bexec\("), 3),
    ]  # fmt: skip


def main() -> int:
    found = figures()
    for figure in found:
        bound = "" if figure.bound is None else f"at most {figure.bound}"
        print(f"{figure.what:38}{figure.value:>7}  {bound}")
    over = [f for f in found if f.bound is not None and f.value > f.bound]
    for figure in over:
        print(f"{figure.what}: {figure.value} is more than the bound of {figure.bound}")
    return bool(over)


if __name__ == "__main__":
    sys.exit(main())
