"""Equations, impacts and guards that follow from a declaration, at random states and parameters.

Each check raises ValueError, which names the declaration, the item and the remedy.
"""

from collections.abc import Iterable, Mapping
from typing import Any

import numpy as np
import sympy as sp

from rockeom.symbolic.checks.common import ModelError, naming
from rockeom.symbolic.checks.modes import side_of, words_of
from rockeom.symbolic.evaluate import array_function
from rockeom.symbolic.hybrid import HybridModel
from rockeom.symbolic.mode import Mode

_SAMPLES = 200
_NEGLIGIBLE = 1e-9


def check_derived(model: HybridModel) -> None:
    """Equations, impacts and guards of a declaration, at random states and parameters.

    Modes of contacts are derived here, which refuses those that statics leaves open.
    """
    with naming(model.name):
        sample = _Sample(model)
        _ = model.mode_names
        matrices = {p.equations.mass_matrix.as_immutable(): p for p in reversed(model.modes)}
        for mode in reversed(matrices.values()):
            _invertible(model, mode, sample)
        _one_ratio(model, sample)
        _guards_open(model, sample)
        _rests(model, sample)
        _energies_are_even(model, sample)


class _Sample:
    """Random values of all symbols, by which expressions become arrays (k, n)."""

    def __init__(self, model: HybridModel) -> None:
        rng = np.random.default_rng(1)
        self.model = model
        self.values: dict[sp.Symbol, np.ndarray] = {}
        self.functions: dict[tuple[str, tuple[sp.Expr, ...]], Any] = {}
        for p in model.parameters:
            size = 2.0 ** rng.uniform(-1, 1, _SAMPLES)
            sign = 1.0 if p.symbol.is_nonnegative else rng.choice([-1.0, 1.0], _SAMPLES)
            self.values[p.symbol] = sign * size
        for c in model.coordinates:
            for x in (c.position, c.velocity, c.acceleration):
                size = 10.0 ** rng.uniform(-3, 3, _SAMPLES)
                self.values[x] = rng.choice([-1.0, 1.0], _SAMPLES) * size
        for x in model.shaking:
            self.values[x] = rng.uniform(-1, 1, _SAMPLES)

    def __call__(
        self,
        name: str,
        expressions: Iterable[sp.Expr],
        put: Mapping[sp.Symbol, Any] | None = None,
    ) -> np.ndarray:
        """Values (k, n) in a mode, those of some symbols changed."""
        values = {**self.values, **(put or {})}
        given = [np.broadcast_to(v, _SAMPLES) for v in values.values()]
        key = name, tuple(expressions)
        if key not in self.functions:  # some are needed with other values of many symbols
            written = [self.model.in_mode(e, name).xreplace(self.model.constants) for e in key[1]]
            self.functions[key] = array_function(list(values), written)
        with np.errstate(all="ignore"):
            return self.functions[key](given)


def first_name(mode: Mode) -> str:
    """Name of the first of the modes that share equations."""
    return next(iter(mode.sides))


def _invertible(model: HybridModel, mode: Mode, sample: _Sample) -> None:
    """Each free coordinate moves a mass of its own."""
    n = len(mode.coordinates)
    if n == 0:
        return
    found = sample(first_name(mode), mode.equations.mass_matrix)
    matrices = np.moveaxis(found.reshape(n, n, -1), -1, 0)
    matrices = matrices[np.isfinite(matrices).all(axis=(1, 2))]
    for i, c in enumerate(mode.coordinates):
        if len(matrices) and not (matrices[:, i, i] > 0).any():
            raise ModelError(
                f"the coordinate {c.name!r} moves no mass in mode {'/'.join(mode.sides)}: "
                "its mass matrix is singular; give a body whose position contains it a mass",
            )
    size = np.sqrt(np.abs(np.diagonal(matrices, axis1=1, axis2=2)))
    with np.errstate(all="ignore"):
        lowest = np.linalg.eigvalsh(matrices / size[:, :, None] / size[:, None, :])[:, 0]
    if len(lowest) and not (lowest > 1e-12).any():
        raise ModelError(
            f"the mass matrix of mode {'/'.join(mode.sides)} is singular: its coordinates "
            f"{', '.join(c.name for c in mode.coordinates)} move fewer masses than they are",
        )


def _one_ratio(model: HybridModel, sample: _Sample) -> None:
    """Impact laws multiply the rate by one ratio, whichever side closes.

    The rotation of a rigid body, its only coordinate, has the ratio of each foot by the impulses.
    """
    impacts = [t for t in model.transitions if t.kind == "impact"]
    rigid = len(model.coordinates) == 1
    if rigid or model.rigid_velocity_ratio is not None or len(impacts) < 2:
        return
    first, *others = impacts
    ratios = sample(first.source, [model.velocity_ratio_at(t) for t in impacts])
    for t, ratio in zip(others, ratios[1:], strict=True):
        if not np.allclose(ratio, ratios[0], rtol=_NEGLIGIBLE, atol=0, equal_nan=True):
            raise ModelError(
                f"the ratio of the angular velocities differs between {words_of(first)} and "
                f"{words_of(t)}: the feet are not equally far from the masses, which is not "
                "modelled; make both sides alike, or give `rigid_velocity_ratio`, or declare a "
                "Model whose feet have the law Rigid(restitution=0, friction=None)",
            )


def _guards_open(model: HybridModel, sample: _Sample) -> None:
    """Each mode of one side contains states on that side."""
    theta = model.rotation.position
    sides = {name: side for mode in model.modes for name, side in mode.sides.items()}
    for side in sorted({*sides.values()} - {0}):
        here = [name for name in sides if sides[name] == side]
        out = [t for t in model.transitions if t.source in here and t.kind == "switch"]
        if not out:
            continue
        # many modes of a side have the same guards
        guards = list(dict.fromkeys(t.guard for t in out))
        put = {theta: side * np.abs(sample.values[theta])}
        found = dict(zip(guards, sample(here[0], guards, put), strict=True))
        for t in out:
            values = found[t.guard]
            known = values[np.isfinite(values)]
            if known.size and not (known > 0).any():
                raise ModelError(
                    f"the guard of {words_of(t)} is nowhere positive where {model.rotation.name!r} "
                    f"has the sign of {t.source!r}: it must be positive inside its source; turn "
                    "its sign",
                )


def _at_rest(model: HybridModel) -> dict[sp.Symbol, Any]:
    """No coordinate has moved. Parameters of either sign, which may make sides differ, are zero."""
    states = {x: 0.0 for c in model.coordinates for x in (c.position, c.velocity)}
    return states | {p.symbol: 0.0 for p in model.parameters if not p.symbol.is_nonnegative}


def _rests(model: HybridModel, sample: _Sample) -> None:
    """Springs do not push the structure away from where it rests by declaration.

    Without a spring at work, or where it carries the weight, a coordinate may be zero.
    """
    pushed: dict[str, bool] = {}
    for mode in model.modes:
        eq, n = mode.equations, len(mode.coordinates)
        others = [c for c in mode.coordinates if c != model.rotation]
        if not others or not any(t.kind != "switch" for t in model.transitions):
            continue
        parts = sample(
            first_name(mode),
            (*eq.elastic_forces, *eq.gravity_forces, *eq.applied_forces),
            _at_rest(model),
        )
        elastic, weight, force = parts.reshape(3, n, -1)
        bound = _NEGLIGIBLE * (np.abs(elastic) + np.abs(weight) + np.abs(force))
        wrong = (np.abs(elastic) > bound) & (np.abs(elastic + weight - force) > bound)
        for c, found in zip(mode.coordinates, wrong, strict=True):
            if c != model.rotation:
                pushed[c.name] = pushed.get(c.name, True) and bool(found.any())
    for name in (name for name, always in pushed.items() if always):
        raise ModelError(
            f"the elastic energy pushes {name!r} away from zero, where the structure "
            "rests: declare an energy such as k u**2/2, not a force",
        )


def _energies_are_even(model: HybridModel, sample: _Sample) -> None:
    """The elastic energy does not rise to one side of rest while it falls to the other.

    For a coordinate other than the rotation, less the energy of springs compressed at rest.
    """
    rest = _at_rest(model)
    pairs = {(t.source, t.target) for t in model.transitions if t.kind == "impact"}
    for one, other in sorted(pairs):
        if side_of(model, one) > 0:
            continue
        mode = model.mode(one)
        energy, slopes = mode.equations.elastic_energy, mode.equations.elastic_forces
        for c, slope in zip(mode.coordinates, slopes, strict=True):
            if not model.written_out(energy).has(c.position):
                continue
            turns = c == model.rotation
            gains = []
            for way, name in ((-1, one), (1, other if turns else one)):
                (there,) = sample(name, [energy], {**rest, c.position: 1e-2 * way})
                here, given = sample(name, [energy, slope], rest)
                given = 0.0 * given if turns else 1e-2 * way * given
                gain = there - here - given
                gains.append(
                    np.sign(gain) * (np.abs(gain) > 1e-12 * (np.abs(there) + np.abs(given)))
                )
            if np.all(gains[0] * gains[1] < 0):
                raise ModelError(
                    f"the elastic energy in {one!r} rises where {c.name!r} moves to one "
                    "side and falls on the other: it must grow to either side, as k u**2/2 does, "
                    "or k*SIDE*theta with rockeom.symbolic.SIDE, which has the sign of theta",
                )
