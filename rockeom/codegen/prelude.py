"""Parts that a generated module has in common with others: it imports them instead."""

import ast

from rockeom.codegen.names import names_in
from rockeom.compiler.sources import ROOT

PRELUDE = (ROOT / "generated" / "prelude.py").read_text(encoding="utf-8")
"""The text of `rockeom.generated.prelude`."""
NUMERIC_MODES = (ROOT / "generated" / "numeric_modes.py").read_text(encoding="utf-8")
"""The text of `rockeom.generated.numeric_modes`."""


def _defined(statement: ast.stmt) -> list[str]:
    """The names that a statement at the top of a module defines."""
    if isinstance(statement, ast.FunctionDef):
        return [statement.name]
    if isinstance(statement, ast.Assign):
        return [node.id for node in ast.walk(statement.targets[0]) if isinstance(node, ast.Name)]
    if isinstance(statement, ast.ImportFrom) and statement.module == "rockeom.codes":
        return [alias.name for alias in statement.names]
    return []


_DEFINITIONS = {ast.dump(s): names for s in ast.parse(PRELUDE).body if (names := _defined(s))}

_NAMES = {name for names in _DEFINITIONS.values() for name in names}


def without_prelude(text: str) -> tuple[str, list[str]]:
    """A text without the definitions of the prelude, and the names that it wants of these."""
    tree = ast.parse(text)
    lines, wanted = text.split("\n"), names_in(tree)
    for statement in reversed(tree.body):
        if _NAMES.isdisjoint(_defined(statement)) or ast.dump(statement) not in _DEFINITIONS:
            wanted -= {*_defined(statement)}
            continue
        first = statement.lineno - 1
        if isinstance(statement, ast.FunctionDef):  # with its marks, and the blank lines above
            first -= len(statement.decorator_list) + 2
        del lines[first : statement.end_lineno]
    return "\n".join(lines), [n for names in _DEFINITIONS.values() for n in names if n in wanted]
