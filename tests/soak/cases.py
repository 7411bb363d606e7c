"""One motion from one whole number: structure, ground motion, start, law and options.

Quantities are drawn in units of the structure's own time and of the acceleration that lifts it, so
that most motions rock; a part of them is extreme on purpose.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

import rockeom as rk
from rockeom.motion.segments import COLUMNS
from rockeom.structures.base import Structure
from rockeom.structures.classes import SHIPPED
from tests.shipped import plain
from tests.typical import S1

NEWER = ("sliding_block", "stacked_blocks", "rocking_frame", "wall_with_frame", "offset_block")
"""Structures that are not drawn: seeds keep their meaning. Those of contacts have random motions of
their own in tests/contact."""
MODELS = tuple(name for name in SHIPPED if name not in NEWER)
METHODS = ("DOP853", "DOP853", "RK45", "DOP853", "Radau", "DOP853", "RK45", "DOP853")
"""Of one seed after the other; DOP853 is the default, and what most people use."""

EVEN = {"heave", "permanent_extension", "passage_speed", "y", "eta"}
"""Coordinates that a mirror leaves as they are."""


def model_of(seed: int) -> str:
    """Of sixteen rigid blocks one has its centroid off the middle."""
    model = MODELS[seed % len(MODELS)]
    offset = model == "rigid_block" and seed // len(MODELS) % 16 == 15
    return "offset_block" if offset else model


def method_of(seed: int) -> str:
    return METHODS[seed // len(MODELS) % len(METHODS)]


@dataclass(frozen=True)
class Motion:
    """All that `rk.simulate` takes, of one seed."""

    seed: int
    structure: Structure
    motion: rk.GroundMotion
    vertical: rk.GroundMotion | None
    impact: Any
    initial: dict[str, float]
    mode: str | None
    options: rk.SolverOptions
    slope: float = 0.0
    ground_axes: str = "slope"

    def run(self) -> rk.Response:
        return rk.simulate(self.structure, self.motion, **self.arguments(), options=self.options)

    def case(self) -> rk.Case:
        return rk.Case(self.structure, self.motion, **self.arguments())

    def arguments(self) -> dict[str, Any]:
        return {
            "impact": self.impact,
            "initial": self.initial,
            "vertical": self.vertical,
            "mode": self.mode,
            "slope": self.slope,
            "ground_axes": self.ground_axes,
        }

    def mirrored(self) -> Motion:
        """Left and right exchanged."""
        structure = self.structure
        for name in ("eccentricity", "offset"):
            if getattr(structure, name, 0.0):
                structure = replace(structure, **{name: -getattr(structure, name)})
        return replace(
            self,
            structure=structure,
            motion=-self.motion,
            slope=-self.slope,
            initial={k: v if is_even(k) else -v for k, v in self.initial.items()},
            mode=None if self.mode is None else other_side(self.mode),
        )

    def __str__(self) -> str:
        o = self.options
        initial = ", ".join(f"{k}={v!r}" for k, v in self.initial.items())
        return (
            f"{self.structure}\n  under {self.motion.name!r}, vertical "
            f"{self.vertical and self.vertical.name!r}, {self.motion.duration:.6g} s, "
            f"slope {self.slope:.6g} ({self.ground_axes})\n  impact "
            f"{self.impact}, initial {{{initial}}}, mode {self.mode!r}\n  {o}"
        )


def is_even(state: str) -> bool:
    return state.removesuffix("_dot") in EVEN


def other_side(mode: str) -> str:
    if "left" in mode:
        return mode.replace("left", "right")
    return mode.replace("right", "left")


class Dice:
    """Draws of one seed."""

    def __init__(self, *seed: int) -> None:
        self.rng = np.random.default_rng(seed)

    def between(self, low: float, high: float) -> float:
        return float(self.rng.uniform(low, high))

    def over(self, low: float, high: float) -> float:
        """Log-uniform."""
        return math.exp(self.between(math.log(low), math.log(high)))

    def chance(self, share: float) -> bool:
        return bool(self.rng.random() < share)

    def one_of(self, *items: Any) -> Any:
        return items[int(self.rng.integers(len(items)))]


@dataclass(frozen=True)
class Scales:
    """What is natural to a structure.

    p : rate of its rocking [1/s]; alpha : rotation (or displacement) at which it falls, or that is
        large; lift : acceleration that lifts it; gravity; fast : rate of its fastest vibration.
    """

    p: float
    alpha: float
    lift: float
    gravity: float = 9.81
    fast: float = 0.0


def draw(seed: int, sibling: int = 0, linear: bool = False) -> Motion:
    """The motion of a seed. Siblings have the same model, method and options.

    linear : under records, steps or nothing, as lanes want them.
    """
    model = model_of(seed)
    options = _options(Dice(seed, 0, 1), method_of(seed))
    dice = Dice(seed, sibling)
    structure, scales = _STRUCTURES[model](dice) if model in _STRUCTURES else _any(model, dice)
    length = dice.over(1.0, 25.0) / scales.p
    if scales.fast:  # a stiff one is not followed for hours
        length = min(length, dice.over(20.0, 2000.0) / scales.fast)
    motion = _motion(dice, scales, length, linear)
    vertical = None
    if dice.chance(0.25):
        size = dice.over(0.02, 1.5) * scales.gravity
        vertical = _motion(dice, replace(scales, lift=size), length, linear)
    initial, mode = _start(dice, structure, scales)
    return Motion(seed, structure, motion, vertical, _law(dice, structure), initial, mode, options)


# -- options


def _options(dice: Dice, method: str) -> rk.SolverOptions:
    rtol = {
        "DOP853": (1e-10, 1e-10, 1e-10, 1e-12, 1e-8, 1e-6),
        "RK45": (1e-10, 1e-8, 1e-7, 1e-6),
        "Radau": (1e-8, 1e-7, 1e-6),
    }[method]
    chosen = dice.one_of(*rtol)
    return rk.SolverOptions(
        method=method,
        rtol=chosen,
        atol=chosen * dice.one_of(1e-2, 1e-2, 1e-4),
        steps_per_segment=dice.one_of(1, 2, 3, 5, 10) if dice.chance(0.25) else 0,
        rest_tolerance=dice.one_of(1e-6, 1e-6, 1e-6, 1e-9, 1e-4),
        max_impacts=2000,
        max_steps=20_000,
    )


# -- ground motions


LINEAR = ("none", "constant")
CURVED = ("half_sine", "single_sine", "single_cosine", "harmonic", "ricker", "antisymmetric")
RECORDS = ("record", "record", "jumps", "jumps")


def _motion(dice: Dice, scales: Scales, length: float, linear: bool) -> rk.GroundMotion:
    """Most within a decade of what lifts the structure, of periods around its own."""
    kind = dice.one_of(*LINEAR, *(() if linear else CURVED), *RECORDS)
    if kind == "none":
        return rk.GroundMotion.none(length)
    size = scales.lift * dice.over(0.2, 8.0) * dice.one_of(1.0, -1.0)
    period = dice.over(0.05, 5.0) / scales.p
    if kind == "constant":
        return rk.GroundMotion.constant(size, min(period, length), length)
    if kind in ("half_sine", "single_sine", "single_cosine"):
        make = getattr(rk.GroundMotion, kind)
        return make(size, period, duration=max(length, 1.01 * period))
    if kind == "harmonic":
        return rk.GroundMotion.harmonic(
            size, period=period, duration=length, phase=dice.one_of(0.0, dice.between(0.0, 6.3))
        )
    if kind in ("ricker", "antisymmetric"):
        period /= 4.0
        return rk.GroundMotion.ricker(
            size, period, duration=max(length, 4.01 * period), antisymmetric=kind != "ricker"
        )
    n = int(dice.over(4, 150))
    values = dice.rng.normal(size=n)
    if dice.chance(0.7):
        values = np.convolve(values, np.ones(3) / 3, "same")
    if dice.chance(0.3):
        values[: n // 3] = 0.0
    if dice.chance(0.3):
        values[2 * n // 3 :] = 0.0
    if kind == "record":
        dt = 0.8 * length / (n - 1)
        return rk.GroundMotion.from_array(size * values, dt).padded_to(length)
    # steps, each with an acceleration and a slope of its own
    ends = np.cumsum(dice.rng.uniform(0.1, 1.0, n))
    ends *= length / ends[-1]
    rows = np.zeros((n, COLUMNS))
    rows[:, 1], rows[1:, 0], rows[:, 3] = ends, ends[:-1], size * values
    rows[:, 4] = size * dice.rng.normal(size=n) * scales.p * (dice.rng.random(n) < 0.5)
    return rk.GroundMotion(rows, name=f"{n} jumps")


# -- starts


def _start(dice: Dice, structure: Structure, scales: Scales) -> tuple[dict[str, float], str | None]:
    states = structure.states
    rotation = structure.module.ROTATION
    half = len(states) // 2
    kind = dice.one_of("rest", "rest", "tilted", "tilted", "moving", "both", "tiny", "rate")
    speed = scales.alpha * scales.p
    size = dice.over(1e-12, 1e-4) if kind == "tiny" else dice.over(0.01, 1.2)
    initial: dict[str, float] = {}
    if kind in ("tilted", "both", "tiny"):
        initial[states[rotation]] = scales.alpha * size * dice.one_of(1.0, -1.0)
    if kind in ("moving", "both", "tiny", "rate"):
        initial[states[half + rotation]] = speed * size * dice.between(-1.0, 1.0)
    for name in ("u", "heave"):
        if name in states[1:] and dice.chance(0.3):
            wide = scales.lift / max(scales.fast, scales.p) ** 2
            initial[name] = wide * dice.between(-2.0, 2.0)
            if dice.chance(0.5):
                initial[f"{name}_dot"] = wide * max(scales.fast, scales.p) * dice.between(-2.0, 2.0)
    if "permanent_extension" in states and dice.chance(0.2):
        largest = (structure.yield_force - structure.initial_force) / structure.tendon_stiffness
        initial["permanent_extension"] = largest * dice.over(0.01, 2.0)
    if dice.chance(0.1):  # zero, by name
        initial.setdefault(states[half + rotation], dice.one_of(0.0, -0.0))
    bound = structure.overturning_rotation
    if abs(initial.get(states[rotation], 0.0)) >= bound:
        initial[states[rotation]] *= 0.99 * bound / abs(initial[states[rotation]])
    mode = None
    # what is less is taken for a rounding error of an impact, and any side may be named
    if dice.chance(0.08) and not 0.0 < abs(initial.get(states[rotation], 0.0)) < 2e-6 * bound:
        mode = dice.one_of(*structure.module.MODES)
        if "yield" in mode and not initial.get(states[rotation]):
            mode = None  # upright a tendon yields neither out nor in: a tie of both
    return initial, mode


# -- laws of impact


def _law(dice: Dice, structure: Structure) -> Any:
    if not structure.has_impacts:
        return None
    laws: list[Callable[[], Any]] = [
        lambda: None,
        rk.AngularMomentum,
        lambda: rk.EnergyRatio(dice.one_of(0.0, dice.between(0.0, 1.0), 1.0)),
        lambda: rk.VelocityRatio(dice.one_of(0.0, dice.between(0.0, 1.0), 1.0)),
        lambda: rk.VelocityRatio(dice.between(0.7, 0.95)),
        lambda: _at_speed(dice, structure),
    ]
    if structure.module.HAS_IMPULSIVE:
        laws += [rk.Impulsive, rk.Impulsive]
    return dice.one_of(*laws)()


def _at_speed(dice: Dice, structure: Structure) -> Any:
    height = None if structure.speed_height is not None else dice.over(0.1, 10.0)
    ends = sorted({dice.over(1e-3, 10.0) for _ in range(dice.one_of(0, 1, 2))})
    pieces = []
    for end in (*ends, math.inf):
        r = dice.between(0.2, 0.95)
        slope = 0.0 if end == math.inf else (dice.between(0.2, 0.95) - r) / end
        pieces.append((end, r, slope))
    return rk.EnergyRatioAtSpeed(tuple(pieces), height=height)


# -- structures


def _rocking(mass: float, first: float, inertia: float, half_width: float, g: float) -> Scales:
    """first : sum of m h; inertia : about an edge."""
    radius = math.hypot(half_width * mass, first)
    alpha = math.atan2(half_width * mass, first)
    return Scales(math.sqrt(g * radius / inertia), alpha, g * math.tan(alpha), g)


def _rigid_block(dice: Dice) -> tuple[Structure, Scales]:
    if dice.chance(0.7):
        block = rk.RigidBlock.from_frequency(
            p=dice.over(0.5, 8.0), alpha=dice.over(0.02, 1.2), mass=dice.over(1e-2, 1e6)
        )
    else:
        inertia = dice.one_of(None, 0.0, dice.over(1e-3, 10.0))
        mass, b, h = dice.over(1e-3, 1e6), dice.over(0.02, 5.0), dice.over(0.05, 10.0)
        block = rk.RigidBlock(
            half_width=b,
            half_height=h,
            mass=mass,
            inertia=inertia and inertia * mass * (b * b + h * h),
            gravity=dice.one_of(9.81, 1.62, 100.0),
        )
    alpha = block.alpha
    return block, Scales(
        block.frequency_parameter, alpha, block.gravity * math.tan(alpha), block.gravity
    )


def _offset_block(dice: Dice) -> tuple[Structure, Scales]:
    b, h = dice.over(0.02, 5.0), dice.over(0.05, 10.0)
    offset = b * dice.one_of(0.0, dice.between(-0.9, 0.9))
    block = rk.OffsetBlock(half_width=b, half_height=h, offset=offset, mass=dice.over(1e-2, 1e6))
    near = b - abs(offset)
    inertia = block.parameters()["inertia"] + block.mass * (near**2 + h**2)
    return block, _rocking(block.mass, block.mass * h, inertia, near, block.gravity)


def _slender_block(dice: Dice) -> tuple[Structure, Scales]:
    p, alpha = dice.over(0.5, 8.0), dice.over(0.01, 0.6)
    block = rk.SlenderBlock.from_frequency(p=p, alpha=alpha, mass=dice.over(1e-2, 1e6))
    if dice.chance(0.3):
        block = replace(
            block, inertia=dice.one_of(0.0, dice.over(1e-2, 3.0)) * block.mass * block.radius**2
        )
    return block, Scales(p, alpha, 9.81 * alpha)


def _nondimensional_block(dice: Dice) -> tuple[Structure, Scales]:
    alpha = dice.over(0.01, 1.0)
    block = rk.NondimensionalBlock(
        alpha=alpha, radius_ratio=dice.one_of(0.75, dice.between(0.1, 1.0))
    )
    return block, Scales(1.0, 1.0, math.tan(alpha), 1.0)


def _dirac_delta_block(dice: Dice) -> tuple[Structure, Scales]:
    n = dice.over(1e-4, 1e-1)
    block = rk.DiracDeltaBlock(
        alpha=dice.over(0.02, 0.5),
        energy_ratio=dice.one_of(dice.between(0.3, 1.0), dice.between(0.8, 1.0), 1.0),
        regularisation=n,
    )
    return block, Scales(1.0, 1.0, block.alpha, 1.0, fast=1.0 / n)


def _two_masses(dice: Dice) -> tuple[dict[str, float], Scales]:
    if dice.chance(0.2):  # the steel column of thesis chapter 5
        given = S1
    else:
        mass, height = dice.over(1.0, 1e6), dice.over(0.2, 30.0)
        base = dice.one_of(0.0, dice.over(1e-3, 3.0), dice.over(0.1, 1.0)) * mass
        low = dice.one_of(0.0, dice.between(0.0, 0.3)) * height
        given = {
            "mass": mass,
            "height": height,
            "inertia": dice.one_of(0.0, dice.over(1e-3, 1.0)) * mass * height**2,
            "base_mass": base,
            "base_height": low,
            "base_inertia": dice.one_of(0.0, dice.over(1e-3, 1.0)) * base * height**2,
            "half_width": height * dice.over(0.03, 1.5),
        }
    total = given["mass"] + given["base_mass"]
    first = given["mass"] * given["height"] + given["base_mass"] * given["base_height"]
    b = given["half_width"]
    inertia = given["inertia"] + given["base_inertia"] + total * b * b
    inertia += given["mass"] * given["height"] ** 2
    inertia += given["base_mass"] * given["base_height"] ** 2
    return given, _rocking(total, first, inertia, b, 9.81)


def _lumped_mass_structure(dice: Dice) -> tuple[Structure, Scales]:
    given, scales = _two_masses(dice)
    return rk.LumpedMassStructure(**given), scales


def _damping_ratio(dice: Dice) -> float:
    return dice.one_of(0.0, dice.over(1e-3, 0.1), dice.over(1e-2, 2.0))


def _flexible_structure(dice: Dice) -> tuple[Structure, Scales]:
    given, scales = _two_masses(dice)
    rate = scales.p * dice.over(2.0, 60.0)
    mass = given["mass"]
    fast = rate * math.sqrt(1.0 + (given["height"] / given["half_width"]) ** 2)
    return rk.FlexibleStructure(
        **given, stiffness=mass * rate**2, damping=2 * _damping_ratio(dice) * rate * mass
    ), replace(scales, fast=fast)


def _two_spring_structure(dice: Dice) -> tuple[Structure, Scales]:
    given, scales = _two_masses(dice)
    total = given["mass"] + given["base_mass"]
    settlement = given["half_width"] * dice.over(1e-4, 0.2)
    stiffness = total * 9.81 / (2 * settlement)
    damping = 2 * _damping_ratio(dice) * math.sqrt(stiffness * total)
    structure = rk.TwoSpringStructure(
        **given, foundation_stiffness=stiffness, foundation_damping=damping
    )
    return structure, replace(scales, fast=math.sqrt(2 * stiffness / total))


def _two_spring_cart(dice: Dice) -> tuple[Structure, Scales]:
    given, scales = _two_masses(dice)
    total = given["mass"] + given["base_mass"]
    stiffness = total * 9.81 / (2 * given["half_width"] * dice.over(1e-4, 0.1))
    structure = rk.TwoSpringCart(**given, foundation_stiffness=stiffness)
    wide = scales.alpha * given["height"]
    return structure, Scales(
        scales.p, wide, scales.lift, fast=math.sqrt(2 * stiffness / total) * scales.alpha
    )


def _uplifting_oscillator(dice: Dice) -> tuple[Structure, Scales]:
    height = dice.over(0.2, 30.0)
    b = height * dice.over(0.02, 1.0)
    p = math.sqrt(9.81 / height)
    rate = p * dice.over(1.0, 60.0)
    structure = rk.UpliftingOscillator.from_frequency(
        angular_frequency=rate,
        damping_ratio=_damping_ratio(dice),
        height=height,
        half_width=b,
        mass=dice.over(1.0, 1e6),
    )
    fast = rate * math.hypot(1.0, height / b)
    return structure, Scales(p, b / height, 9.81 * b / height, fast=fast)


def _wall(dice: Dice) -> dict[str, float]:
    """The wall of thesis chapter 4, each of its numbers changed."""
    spread = dice.one_of(1.0, 1.3, 3.0)

    def about(value: float) -> float:
        return value * dice.over(1 / spread, spread)

    half_width = about(0.508)
    yields = about(159e3)
    return {
        "mass": about(2016.0),
        "height": about(2.438),
        "half_width": half_width,
        "edge_distance": half_width * dice.one_of(0.0, 0.19, dice.between(0.0, 0.9)),
        "transition": dice.one_of(3.551e-3, dice.over(3e-4, 3e-2)),
        "tendon_stiffness": about(11.7e6),
        "initial_force": yields * dice.one_of(0.0, 0.48, dice.between(0.0, 0.99)),
        "yield_force": yields,
        "eccentricity": half_width * dice.one_of(0.0, 0.0, dice.between(-0.5, 0.5)),
    }


def _wall_scales(wall: dict[str, float], dice: Dice) -> Scales:
    """Small rotations of about what makes the tendon yield, or far beyond."""
    arm = wall["half_width"]
    inertia = wall["mass"] * wall["height"] ** 2
    hold = (wall["mass"] * 9.81 + wall["initial_force"]) * arm
    give = (wall["yield_force"] - wall["initial_force"]) / wall["tendon_stiffness"]
    turn = 0.5 * give / arm
    # to and fro within a rotation that about makes it yield
    p = math.sqrt(hold / (inertia * turn))
    wide = min(turn * dice.over(0.1, 30.0), 0.5)
    return Scales(p, wide, hold / (wall["mass"] * wall["height"]))


def _controlled_wall(dice: Dice) -> tuple[Structure, Scales]:
    wall = _wall(dice)
    height = wall["height"]
    return rk.ControlledWall(
        **wall,
        centroid_height=0.9 * height,
        inertia=wall["mass"] * height**2 * dice.one_of(0.0, dice.over(0.02, 0.5)),
        anchor_height=height * dice.between(0.5, 1.5),
        anchor_depth=height * dice.one_of(0.0, 0.3),
    ), _wall_scales(wall, dice)


def _flexible_controlled_wall(dice: Dice) -> tuple[Structure, Scales]:
    wall = _wall(dice)
    height, scales = wall["height"], _wall_scales(wall, dice)
    mass = wall["mass"]
    rate = max(scales.p, 30.0) * dice.over(1.0, 8.0)
    return rk.FlexibleControlledWall(
        **wall,
        centroid_height=0.9 * height,
        inertia=mass * height**2 * dice.over(0.05, 0.5),
        anchor_height=height * dice.between(0.5, 1.5),
        anchor_depth=height * dice.one_of(0.0, 0.3),
        stiffness=mass * rate**2,
        damping=2 * _damping_ratio(dice) * rate * mass,
    ), replace(scales, fast=4.0 * rate)


def _substitute(cls: type[Structure]) -> Callable[[Dice], tuple[Structure, Scales]]:
    def drawn(dice: Dice) -> tuple[Structure, Scales]:
        wall = _wall(dice)
        inertia = wall["mass"] * (wall["height"] ** 2 + wall["half_width"] ** 2)
        return cls(
            **wall,
            centroid_height=0.9 * wall["height"],
            pivot_inertia=inertia * dice.over(0.9, 2.0),
        ), _wall_scales(wall, dice)

    return drawn


def _controlled_wall_oscillator(dice: Dice) -> tuple[Structure, Scales]:
    wall = _wall(dice)
    scales = _wall_scales(wall, dice)
    structure = rk.ControlledWallOscillator(
        **wall,
        regularisation=dice.one_of(wall["transition"], dice.over(1e-3, 1e-2)),
        energy_ratio=dice.one_of(
            dice.between(0.3, 1.0), 1.0, rk.EnergyRatioAtSpeed.equation_4_31()
        ),
        held=dice.chance(0.5),
        effective_mass=dice.one_of(None, wall["mass"] / 1.06),
    )
    return structure, replace(scales, alpha=scales.alpha * wall["height"])


def _any(model: str, dice: Dice) -> tuple[Structure, Scales]:
    """One of which nothing is known: parameters about one, in units of its own."""
    structure = rk.structure(model, **plain(model, lambda: dice.over(0.3, 3.0)))
    gravity = getattr(structure, "gravity", 1.0)
    lift = structure.uplift_acceleration or gravity
    alpha = min(math.atan(lift / gravity), structure.overturning_rotation)
    return structure, Scales(math.sqrt(gravity), alpha, lift, gravity)


_STRUCTURES: dict[str, Callable[[Dice], tuple[Structure, Scales]]] = {
    "rigid_block": _rigid_block,
    "offset_block": _offset_block,
    "slender_block": _slender_block,
    "nondimensional_block": _nondimensional_block,
    "dirac_delta_block": _dirac_delta_block,
    "lumped_mass_structure": _lumped_mass_structure,
    "two_spring_structure": _two_spring_structure,
    "two_spring_cart": _two_spring_cart,
    "uplifting_oscillator": _uplifting_oscillator,
    "flexible_structure": _flexible_structure,
    "controlled_wall": _controlled_wall,
    "flexible_controlled_wall": _flexible_controlled_wall,
    "controlled_wall_oscillator": _controlled_wall_oscillator,
    "substitute_gravity_wall": _substitute(rk.SubstituteGravityWall),
    "simplified_substitute_gravity_wall": _substitute(rk.SimplifiedSubstituteGravityWall),
}
