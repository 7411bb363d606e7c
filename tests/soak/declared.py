"""What needs no motion: names of a declaration, feet of a declaration, statics."""

import types
from collections.abc import Iterator
from dataclasses import replace

import numpy as np
import sympy as sp

import rockeom as rk
from rockeom.codegen import module_text
from rockeom.codes import IMPULSIVE, RATIO
from rockeom.structures.base import Structure
from rockeom.symbolic.algebra import SIDE
from rockeom.symbolic.mode import Mode, Transition
from rockeom.symbolic.model import Body, Foot, coordinate, parameter, turned
from rockeom.symbolic.rocking import RockingModel
from tests.soak.cases import Dice
from tests.soak.physics import physics

AWKWARD = (
    "c0", "c1", "c2", "c3", "s", "ax", "ay", "load", "p", "y", "out", "math", "np", "fused", "g",
    "RIGHT", "LEFT", "BOTH", "number", "guard", "law", "ratio", "dy", "theta_ddot", "x0", "x1",
    "m00", "f0", "r0", "sin_theta", "cos_theta", "total_gravity", "rates", "jump", "lambda",
    "found", "N_STATES", "sine_cosine", "None", "gravity", "i", "kinetic_energy", "prepare",
)  # fmt: skip
"""Names that generated code may use itself."""
SMALL = ("rigid_block", "nondimensional_block", "lumped_mass_structure", "flexible_structure")


def as_python(text: str) -> types.ModuleType:
    """A generated module as Python runs it."""
    module = types.ModuleType("generated")
    exec(text, module.__dict__)
    return module


def named_otherwise(seed: int) -> Iterator[str]:
    """Parameters of other names: the same numbers from the code that follows, or an error."""
    dice = Dice(seed, 0, 5)
    model = rk.derive(dice.one_of(*SMALL))
    names = [p.name for p in model.parameters]
    pool = [n for n in AWKWARD if n not in names]
    chosen = list(dice.rng.permutation(pool)[: len(names)])
    renamed = [str(c) if dice.chance(0.5) else n for c, n in zip(chosen, names, strict=True)]
    try:
        other = replace(
            model,
            parameters=tuple(
                replace(p, name=n) for p, n in zip(model.parameters, renamed, strict=True)
            ),
        )
        rk.structure(other, **dict.fromkeys(renamed, 1.0))
    except (ValueError, TypeError):
        return  # refused
    except Exception as error:
        yield f"names: {', '.join(renamed)}: {type(error).__name__}: {error}"
        return
    told = f"{model.name} with the parameters {', '.join(renamed)}"
    try:
        pair = [as_python(module_text(m)) for m in (model, other)]
        values = [numbers(m, Dice(seed, 0, 6)) for m in pair]
    except Exception as error:
        yield f"names: {told}: {type(error).__name__}: {error}"
        return
    for what, (a, b) in zip(
        values[0], zip(values[0].values(), values[1].values(), strict=True), strict=True
    ):
        # terms in another order: what is left of some that cancel differs by rounding
        size = np.abs(a).max(where=np.isfinite(a), initial=0.0)
        if not np.allclose(a, b, rtol=1e-12, atol=1e-13 * size, equal_nan=True):
            yield f"names: {told}: other {what}"
            return


def numbers(m: types.ModuleType, dice: Dice) -> dict[str, np.ndarray]:
    """What the functions of a generated module give for a random structure and state."""
    p = m.prepare(dice.rng.uniform(0.5, 2.0, len(m.PARAMETERS)))
    y = dice.rng.uniform(-0.5, 0.5, m.N_STATES)
    found = {}
    for c, name in enumerate(m.MODES):
        shapes = {
            "rates": (m.N_STATES, (0.3, -0.2)),
            "guards": (m.N_GUARDS + m.N_PARTS, (0.3, -0.2)),
            "energies": (len(m.ENERGIES), ()),
            "reactions": (len(m.REACTIONS), (0.3, -0.2)),
            "kinematics": (len(m.KINEMATICS), ()),
        }
        for what, (size, more) in shapes.items():
            out = np.zeros(size)
            getattr(m, what)(c, y, p, *more, out)
            found[f"{what} of {name}"] = out
        for law in (0, 1) if m.HAS_IMPULSIVE else (0,):
            for guard in range(m.GUARDS[c]):
                out = np.zeros(m.N_STATES)
                after = m.jump(c, guard, law, 0.8, y, p, out)
                found[f"jump {guard} of {name} by law {law}"] = np.append(out, after)
    found["overturning"] = np.array([m.overturning(p)])
    return found


def unequal_feet(seed: int) -> Iterator[str]:
    """A block on feet at b1 and b2: angular momentum about either is conserved, or an error."""
    dice = Dice(seed, 0, 7)
    model = _on_unequal_feet()
    try:
        rk.structure(model, mass=1.0, b1=0.1, b2=0.2, height=1.0, inertia=0.3)
    except (ValueError, TypeError, NotImplementedError):
        return  # refused
    try:
        yield from _turned_over(as_python(module_text(model)), dice)
    except Exception as error:
        yield f"feet: {type(error).__name__}: {error}"


def _turned_over(m: types.ModuleType, dice: Dice) -> Iterator[str]:
    mass, b1, b2, inertia = (dice.over(0.2, 2.0) for _ in range(4))
    h = max(b1, b2) * dice.between(1.5, 5.0)
    given = {"mass": mass, "b1": b1, "b2": b2, "height": h, "inertia": inertia, "gravity": 9.81}
    p = m.prepare(np.array([given[n] for n in m.PARAMETERS]))
    for source, arm in (("left", b2), ("right", b1)):
        rate = 1.0 if source == "left" else -1.0
        expected = (inertia + mass * (h * h - b1 * b2)) / (inertia + mass * (h * h + arm * arm))
        ratio = m.velocity_ratio(p)  # not a number where each foot has its own
        laws = [RATIO] * (not np.isnan(ratio)) + [IMPULSIVE] * m.HAS_IMPULSIVE
        for law in laws:
            out = np.zeros(2)
            landing = np.array([0.0, rate])
            m.jump(m.MODES.index(source), 0, law, ratio, landing, p, out)
            if not np.isclose(out[1], expected * rate, rtol=1e-9):
                yield (
                    f"feet at {b1:.3g} and {b2:.3g} m, height {h:.3g} m: the rate after an impact "
                    f"from the {source} is {out[1]:.9g}, by angular momentum {expected * rate:.9g}"
                )


def _on_unequal_feet() -> RockingModel:
    theta = coordinate("theta", "theta", "rad", "rotation")
    mass, b1, b2, height, inertia, gravity = parameters = [
        parameter(symbol, name, unit, name)
        for symbol, name, unit in (
            ("m", "mass", "kg"), ("b_1", "b1", "m"), ("b_2", "b2", "m"), ("h", "height", "m"),
            ("I", "inertia", "kg m2"), ("g", "gravity", "m/s2"),
        )
    ]  # fmt: skip
    place = (1 + SIDE) / 2 * b2.symbol - (1 - SIDE) / 2 * b1.symbol
    pivot = (place, sp.S.Zero)
    edges = {"left": (-b1.symbol, sp.S.Zero), "right": (b2.symbol, sp.S.Zero)}
    q = theta.position
    turning = Body("block", mass.symbol, turned((0, height.symbol), pivot, q), inertia.symbol, q)
    upright = (sp.S.Zero, height.symbol)
    return RockingModel(
        name="unequal_feet",
        title="A block on feet of unequal distance",
        parameters=tuple(parameters),
        coordinates=(theta,),
        modes=(
            Mode(
                {"left": -1, "right": 1}, (theta,), (turning,), gravity.symbol,
                feet={k: Foot(turned(e, pivot, q)) for k, e in edges.items()},
                load_point=turning.position,
            ),
            Mode(
                {"both": 0}, (), (Body("block", mass.symbol, upright, inertia.symbol),),
                gravity.symbol, feet={k: Foot(e) for k, e in edges.items()}, load_point=upright,
            ),
        ),
        transitions=(
            Transition("left", "right", "impact", -q, "both"),
            Transition("right", "left", "impact", q, "both"),
            Transition("both", "left", "uplift"),
            Transition("both", "right", "uplift"),
        ),
        rotation=theta,
    )  # fmt: skip


def held_at(structure: Structure, rotation: float) -> float:
    """Load that holds a structure on two springs at a rotation, from its energies [N].

    The springs carry the weight: both, or one. Then the load does the work that changes energy.
    """
    values = structure.parameters()
    m = structure.module
    p = np.array([values[n] for n in m.PARAMETERS])
    weight = (values["mass"] + values["base_mass"]) * values["gravity"]
    k, b = values["foundation_stiffness"], values["half_width"]

    def energy(theta: float) -> float:
        lever = b * abs(np.sin(theta))
        both = lever <= weight / (2 * k)
        # rise from the settled position at which the pressed springs carry the weight
        heave = 0.0 if both else weight / (2 * k) + lever - weight / k
        side = "both" if both else "right" if theta > 0 else "left"
        y = np.array([[theta], [heave], [0.0], [0.0]])
        return float(physics(m.NAME).energies(m.MODES.index(side), y, p).sum())

    step = 1e-4 * abs(rotation)
    ends = [energy(rotation + n * step) for n in (-2, -1, 1, 2)]
    slope = (ends[0] - 8 * ends[1] + 8 * ends[2] - ends[3]) / (12 * step)
    return slope / (values["height"] * np.cos(rotation))


def pushed(seed: int, structure: Structure) -> Iterator[str]:
    """The load of a pushover of a structure on two springs is that of its energies."""
    if structure.model != "two_spring_structure":
        return
    dice = Dice(seed, 0, 8)
    values = structure.parameters()
    if dice.chance(0.3):  # heavy on hard springs
        size = dice.over(1.0, 1e4)
        structure = replace(
            structure, mass=size * values["mass"],
            foundation_stiffness=dice.over(1.0, 1e4) * size * values["foundation_stiffness"],
        )  # fmt: skip
        values = structure.parameters()
    rotation = dice.over(1e-5, 0.5) * dice.one_of(1.0, -1.0)
    weight = (values["mass"] + values["base_mass"]) * values["gravity"]
    settlement = weight / (2 * values["foundation_stiffness"])
    lift = settlement / values["half_width"]
    if abs(abs(np.sin(rotation)) - lift) < 1e-3 * lift:
        return  # where a foot is about to lift
    expected = held_at(structure, rotation)
    try:
        found = float(structure.pushover([rotation])[0])
    except ValueError as error:
        yield f"pushover: {error}, where {expected:.9g} N hold it"
        return
    size = weight * (values["half_width"] / values["height"] + abs(rotation))
    room = 1e-6 * (abs(expected) + size)
    # rounding in the energies: of springs that are pressed hard, and of the weight
    room += 1e-10 * weight * (1.0 + settlement / values["height"]) / abs(rotation)
    if not abs(found - expected) <= room:
        yield f"pushover at {rotation:.9g}: {found:.9g} N, by its energies {expected:.9g} N"
