"""Operations of a generated module, counted in its text, for the page of a structure."""

import ast
from collections import Counter
from collections.abc import Iterator

from rockeom.codegen.rates import each_mode
from rockeom.symbolic.hybrid import HybridModel
from rockeom.symbolic.text.page import Block, Heading, Table

KINDS = {
    "additions": (ast.Add, ast.Sub),
    "multiplications": (ast.Mult,),
    "divisions": (ast.Div,),
    "functions": (),
}


def operations(model: HybridModel, module: str) -> list[Block]:
    """A table of the operations that the accelerations of each mode take."""
    declared = [] if model.search else each_mode(model)
    rows: list[tuple[str, ...]] = []
    for function in ast.parse(module).body:
        if isinstance(function, ast.FunctionDef) and _of_one_mode(function):
            counts = Counter(_kinds(ast.Module(function.body, [])))
            where = (ast.get_docstring(function) or "").rstrip(".").partition(" states ")[2]
            if declared:
                where = ", ".join(f"`{name}`" for name in declared[len(rows)].sides)
            rows.append((where, *(str(counts[kind]) for kind in KINDS)))
    return [
        Heading(2, "Operations"),
        "Operations of the accelerations of a state in the generated module, which shares common "
        "subexpressions and computes constants of the parameters beforehand. A difference is an "
        "addition, a square a multiplication.",
        Table(("Modes", *(kind.capitalize() for kind in KINDS)), tuple(rows)),
    ]


def _of_one_mode(function: ast.FunctionDef) -> bool:
    """Whether it gives the accelerations, or the rates of all states, where the mode is known."""
    named = function.name.startswith(("accelerations_", "rates_"))
    return named and function.args.args[0].arg != "mode"


def _kinds(node: ast.AST) -> Iterator[str]:
    """The operations of an expression or statement; powers but whole ones are functions."""
    inside = list(ast.iter_child_nodes(node))
    if isinstance(node, ast.Call):
        yield from ["functions"] * (2 if ast.unparse(node.func) == "sine_cosine" else 1)
    elif isinstance(node, ast.BinOp) and isinstance(node.op, ast.Pow):
        power = node.right.value if isinstance(node.right, ast.Constant) else None
        yield from ["multiplications"] * (power - 1) if isinstance(power, int) else ["functions"]
        inside = [node.left]
    elif isinstance(node, ast.BinOp | ast.AugAssign):
        yield from (kind for kind, signs in KINDS.items() if isinstance(node.op, signs))
    for part in inside:
        yield from _kinds(part)
