"""Every function of a program, in three ways, on random states.

With contraction off each operation is rounded by itself, and all ways give the same bits.
"""

import ast
import math
import warnings
from collections.abc import Callable, Iterator
from dataclasses import replace
from functools import cache
from itertools import islice
from types import ModuleType
from typing import Any, get_type_hints

import numpy as np

from rockeom.compiler.modules import Text, as_python
from rockeom.integrator.linking import linked
from rockeom.integrator.texts import source
from rockeom.symbolic import RockingModel
from tests.machine_code import HEAD, functions

Ways = dict[str, Callable[..., Any]]

ROUNDING = 1e7
"""Units in the last place, where mass matrices may be near to singular, of solutions by NumPy."""

ASKED = {
    "rates": ("ax: float, ay: float, out: Floats", "mode, y, p, ax, ay, out"),
    "guards": ("ax: float, ay: float, out: Floats", "mode, y, p, ax, ay, out"),
    "reactions": ("ax: float, ay: float, out: Floats", "mode, y, p, ax, ay, out"),
    "statics": ("ax: float, ay: float, out: Floats", "mode, y, p, ax, out"),
    "energies": ("ax: float, ay: float, out: Floats", "mode, y, p, out"),
    "kinematics": ("ax: float, ay: float, out: Floats", "mode, y, p, out"),
    "momentum": ("ax: float, ay: float, out: Floats", "mode, y, p, out"),
}
"""Functions of a generated module that fill `out`, and how each is called."""
FRAME = """
@entry
def ask_jump(mode: int, y: Floats, p: Floats, ax: float, ay: float, out: Floats):
    for guard in range(GUARDS[mode]):
        for law in range(2 if HAS_IMPULSIVE else 1):
            at = N_STATES * (2 * guard + law)
            out[at] = jump(mode, guard, law, 0.8, y, p, out[at : at + N_STATES])
"""


def questions(module: ModuleType) -> str:
    text = HEAD + FRAME
    for name, (arguments, call) in ASKED.items():
        if hasattr(module, name):
            text += f"\n@entry\ndef ask_{name}(mode: int, y: Floats, p: Floats, {arguments}):\n"
            text += f"    {name}({call})\n"
    return text


class _Products(ast.NodeTransformer):
    """x**n as the product that machine code has: C's pow rounds otherwise."""

    def visit_BinOp(self, node: ast.BinOp) -> ast.AST:
        self.generic_visit(node)
        power = isinstance(node.op, ast.Pow) and isinstance(node.right, ast.Constant)
        if power and isinstance(node.right.value, int) and 0 < node.right.value < 10:
            name = ast.Name("product_", ast.Load())
            return ast.copy_location(ast.Call(name, [node.left, node.right], []), node)
        return node


def product(x: float, n: int) -> float:
    found = None
    while n:
        if n % 2:
            found = x if found is None else found * x
        n, x = n // 2, x * x
    return found


def python(module: ModuleType, method: str) -> dict[str, Any]:
    """All functions of a program as Python runs them."""
    roots, modules, _ = linked(module, method)
    texts = [*modules.closure(roots), Text("the questions", questions(module))]
    texts = [replace(text, source=_with_products(text.source)) for text in texts]
    return as_python(texts, {"__name__": "plain", "product_": product})


def _with_products(source: str) -> str:
    return ast.unparse(_Products().visit(ast.parse(source)))


def flat(function: Callable[..., Any]) -> Callable[..., Any]:
    """A function of Python that takes the fields of its records, as machine code does."""
    kinds = [kind for name, kind in get_type_hints(function).items() if name != "return"]

    def with_fields(*values: Any) -> Any:
        left = iter(values)
        given = [
            kind(*islice(left, len(kind._fields))) if hasattr(kind, "_fields") else next(left)
            for kind in kinds
        ]
        return function(*given)

    return with_fields


def by_numba(module: ModuleType) -> Ways:
    """The functions of a generated module, each compiled by numba when it is first called."""
    from numba import njit

    names: dict[str, Any] = {"__name__": "jitted"}
    exec(source(module) + questions(module), names)
    for name, value in names.items():
        if isinstance(value, type(by_numba)) and name not in ("entry", "fused", "inlined"):
            names[name] = njit(error_model="numpy")(value)
    return {name: value for name, value in names.items() if name.startswith("ask_")}


def by_numpy(module: ModuleType, model: RockingModel) -> Ways:
    """The rates of `model.lambdify()`, by expressions that nothing has rewritten for a program."""
    modes = model.lambdify()

    def ask_rates(mode, y, p, ax, ay, out):
        values = dict(zip(module.PARAMETERS, p, strict=False))  # constants stand behind them
        out[: len(y)] = modes[module.MODES[mode]].rates(y, values, ax, ay)

    return {"ask_rates": ask_rates}


@cache
def printed(module: ModuleType, contract: bool = False) -> Ways:
    return functions(questions(module), module, contract=contract)


def asked(module: ModuleType, vector: np.ndarray, seed: int) -> Iterator[tuple[str, tuple]]:
    """Names of functions, with random arguments for each mode."""
    rng = np.random.default_rng(seed)
    for mode in range(len(module.MODES)):
        y = rng.normal(size=module.N_STATES) * 10.0 ** rng.uniform(-6, 0)
        ax, ay = rng.normal(size=2) * 5.0
        for name in ("jump", *ASKED):
            if hasattr(module, name):
                size = 2 * module.N_STATES * max(module.N_GUARDS, 1) + 64
                yield f"ask_{name}", (mode, y, vector, ax, ay, np.zeros(size))


def differences(
    module: ModuleType, vector: np.ndarray, one: Ways, other: Ways, seeds: int, ulps: float = 0.0
) -> list[str]:
    """Where two ways differ by more than some units in the last place of the largest number."""
    found = []
    for seed in range(seeds):
        for name, (*given, out) in asked(module, vector, seed):
            if name not in one:
                continue
            first, second = out.copy(), out.copy()
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")
                try:
                    one[name](*given, first)
                except (ValueError, OverflowError, ZeroDivisionError):
                    continue  # what Python has no number for
                other[name](*given, second)
            same = (first == second) | (np.isnan(first) & np.isnan(second))
            with np.errstate(invalid="ignore"):  # infinite on both sides
                room = ulps * np.finfo(float).eps * max(np.abs(first).max(), 1e-300)
                near = same | (np.abs(first - second) <= room)
                off = np.abs(first - second).max() / max(np.abs(first).max(), 1e-300)
            if not near.all():
                found.append(f"{name} in {module.MODES[given[0]]}, seed {seed}: {off:.3g}")
    return found


def run(integrate: Callable[..., int], structure, scratch: int, duration: float, method: str):
    """A short motion from a lean: (outcome, state, steps), all of it."""
    n = len(structure.states)
    y = np.zeros(n)
    record = (np.zeros((4000, 2)), np.zeros(4000, np.int64), np.zeros((4000, 8, n)))
    y[structure.module.ROTATION] = 0.01 * structure.overturning_rotation
    events = np.zeros(99), np.zeros((99, 4), np.int64), np.zeros((99, 2, n))
    status = np.array([structure.mode_number(y), -1, 0, 0, 0, 1, 1, 0, 0, 0])
    table = np.array([[0.0, duration, 1.0, 3.0, 2 * math.pi / duration, 0.0, 0.0]])
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        code = integrate(
            status, np.zeros(4), y, np.zeros(n), duration, table, table[:0], table[:0],
            structure.vector.copy(), 0, 0.8, 1e-8, np.full(n, 1e-10), math.inf, 0,
            structure.overturning_rotation, 1e-6, 1000, 3000, *record, *events, np.empty((0, n)),
            np.zeros(scratch),
        )  # fmt: skip
    return code, y, *record, *events
