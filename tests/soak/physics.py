"""What the invariants need of a structure, from its declaration and not from generated code.

Energies, powers and guards of each mode as NumPy functions of arrays. SymPy derives them
once for a model; the text is kept beside the compiled programs, where later processes find it.
"""

import functools
import hashlib
import importlib
import importlib.util
import inspect
import os
import tempfile
from dataclasses import dataclass
from pathlib import Path
from types import ModuleType

import numpy as np
import sympy as sp

import rockeom as rk
from rockeom.compiler.cache import cache_folder
from rockeom.symbolic.model import GROUND_X, GROUND_Y
from rockeom.symbolic.rocking import RockingModel


@dataclass(frozen=True)
class Physics:
    """The functions of one model; `mode` is the number of a mode.

    y (N, n) : one column a sample. p : the parameters in their order. ax, ay : numbers or (n,).
    """

    module: ModuleType

    def energies(self, mode: int, y, p) -> np.ndarray:
        """(3, n) kinetic, gravitational and elastic."""
        return self._call("energies", mode, y, p, 0.0, 0.0)

    def power(self, mode: int, y, p, ax, ay) -> np.ndarray:
        """(2, n) of the ground's accelerations, and of dampers and all other forces."""
        return self._call("power", mode, y, p, ax, ay)

    def guards(self, mode: int, y, p, ax, ay) -> np.ndarray:
        """(g, n) in the order of the generated module, positive inside the mode."""
        return self._call("guards", mode, y, p, ax, ay)

    def _call(self, part: str, mode: int, y, p, ax, ay) -> np.ndarray:
        with np.errstate(all="ignore"):
            found = getattr(self.module, f"{part}_{mode}")(*y, ax, ay, *p)
        out = np.empty((len(found), y.shape[1]))
        for row, value in zip(out, found, strict=True):
            row[:] = value
        return out


@functools.cache
def physics(name: str) -> Physics:
    """The functions of a shipped model."""
    made_of = inspect.getsource(inspect.getmodule(physics)) + "".join(
        path.read_text(encoding="utf-8")
        for path in sorted((Path(rk.__file__).parent / "symbolic").rglob("*.py"))
    )
    digest = hashlib.sha256(made_of.encode()).hexdigest()[:20]
    path = cache_folder() / f"soak_{name}_{digest}.py"
    if not path.exists():
        path.parent.mkdir(parents=True, exist_ok=True)
        handle, temporary = tempfile.mkstemp(dir=path.parent, suffix=".tmp")
        with os.fdopen(handle, "w", encoding="utf-8") as f:
            f.write(_text(rk.derive(name)))
        os.replace(temporary, path)
    spec = importlib.util.spec_from_file_location(path.stem, path)
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return Physics(module)


def _text(model: RockingModel) -> str:
    q = [c.position for c in model.coordinates]
    qd = [c.velocity for c in model.coordinates]
    arguments = [*q, *qd, GROUND_X, GROUND_Y, *(p.symbol for p in model.parameters)]
    # plain names: `dummify` would go through the expressions for each argument again
    plain = {symbol: sp.Symbol(f"a{i:03}") for i, symbol in enumerate(arguments)}
    parts = ["from functools import reduce\n\nfrom numpy import *\n"]
    for number, mode in enumerate(model.mode_names):
        for part, expressions in (
            ("energies", _energies(model, mode)),
            ("power", _power(model, mode)),
            ("guards", _guards(model, mode)),
        ):
            exact = [_plain(model, e).xreplace(plain) for e in expressions]
            compiled = sp.lambdify(list(plain.values()), exact, modules="numpy", cse=True)
            text = inspect.getsource(compiled)
            parts.append(text.replace("_lambdifygenerated", f"{part}_{number}"))
    return "\n\n".join(parts)


def _plain(model: RockingModel, expr: sp.Expr) -> sp.Expr:
    """Without the symbols of constants that follow from the parameters."""
    while expr.free_symbols & set(model.constants):
        expr = expr.xreplace(model.constants)
    return expr


def _energies(model: RockingModel, mode: str) -> list[sp.Expr]:
    equations = model.equations(mode)
    return [
        model.in_mode(e, mode)
        for e in (
            equations.kinetic_energy,
            equations.gravitational_energy,
            equations.elastic_energy,
        )
    ]


def _power(model: RockingModel, mode: str) -> list[sp.Expr]:
    """d/dt of the energies: that the ground gives, and that other forces give and dampers take."""
    equations, declared = model.equations(mode), model.mode(mode)
    rates = [c.velocity for c in declared.coordinates]
    total = equations.kinetic_energy + equations.gravitational_energy + equations.elastic_energy
    ground = sp.Add(*(v * e for v, e in zip(rates, equations.excitation_forces, strict=True)))
    given = equations.applied_forces - equations.damping_forces
    other = sp.Add(*(v * e for v, e in zip(rates, given, strict=True)))
    ground, other = (model.in_mode(e, mode) for e in (ground, other))
    if total.free_symbols & {law.symbol for law in model.functions}:
        # the equations take such a law as a constant, the energies change with it
        for c in declared.coordinates:
            held = model.in_mode(sp.diff(total, c.position), mode)
            moving = sp.diff(model.in_mode(total, mode), c.position)
            other += c.velocity * (moving - held)
    return [ground, other]


def _guards(model: RockingModel, mode: str) -> list[sp.Expr]:
    leaving = [t for t in model.transitions if t.source == mode]
    return [
        -_opening(model, t.target) if t.kind == "uplift" else model.in_mode(t.guard, mode)
        for t in leaving
    ]


def _opening(model: RockingModel, target: str) -> sp.Expr:
    """Acceleration with which the gap of `target` would open from closed and at rest."""
    mode, equations = model.mode(target), model.equations(target)
    closed = {model.rotation.position: 0, model.rotation.velocity: 0}

    def still(m: sp.Matrix) -> sp.Matrix:
        return m.applyfunc(lambda e: model.in_mode(e, target).subs(closed))

    found = still(equations.mass_matrix).LUsolve(still(equations.forcing))
    return mode.side_of(target) * found[list(mode.coordinates).index(model.rotation)]
