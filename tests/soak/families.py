"""Motions of bodies that stand, slide, bounce and fly, and the mechanics to compare them with.

A family is a kind of structure; its seeds are numbered from BASE times its place in FAMILIES on, so
that one whole number fixes all of a motion, as with the structures of `tests.soak.cases`. Few
programs are compiled: sizes, friction and restitution are parameters.
"""

import functools
import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
import sympy as sp

import rockeom as rk
from rockeom.codes import LEAST_RESTITUTION
from rockeom.structures.base import Structure
from rockeom.symbolic import Contact, Rigid, Unilateral, Yielding, dead_load
from rockeom.symbolic.model import Parameter, parameter
from tests.contact import declared
from tests.mechanics import (
    AtWall,
    BlockOnFeet,
    Foot,
    Frame,
    Mechanics,
    Storey,
    of_sliding_block,
    of_stack,
    two_feet,
)
from tests.soak import cases
from tests.soak.cases import Dice, Motion

BASE = 10**12
METHODS = ("DOP853", "DOP853", "RK45 1e-6", "DOP853", "RK45 1e-6", "DOP853", "RK45", "DOP853")
"""Of one seed after the other: the default, and RK45 at the tolerance of maps and at 1e-10."""
GRAVITY = 9.81


@dataclass(frozen=True)
class Drawn:
    structure: Structure
    by_hand: Mechanics
    initial: dict[str, float]
    motion: rk.GroundMotion
    vertical: rk.GroundMotion | None = None
    slope: float = 0.0
    ground_axes: str = "slope"


def family_of(seed: int) -> str | None:
    """None for seeds of the structures on pinned feet and springs of `cases`."""
    return None if seed < BASE else FAMILIES[seed // BASE - 1]


def first_of(family: str) -> int:
    return 0 if family == "structures" else BASE * (FAMILIES.index(family) + 1)


def model_of(seed: int) -> str:
    """The structure, for which a program is compiled."""
    family = family_of(seed)
    if family is None:
        return cases.model_of(seed)
    variants = [*_VARIANTS[family]]
    return variants[seed % BASE % len(variants)]


def method_of(seed: int) -> str:
    family = family_of(seed)
    if family is None:
        return cases.method_of(seed)
    return METHODS[seed % BASE // len(_VARIANTS[family]) % len(METHODS)].split()[0]


def drawn(seed: int) -> tuple[Motion, Mechanics]:
    """The motion of a seed, and the mechanics of its structure."""
    family = family_of(seed)
    assert family is not None
    variants = _VARIANTS[family]
    of = variants[model_of(seed)](Dice(seed))
    motion = Motion(
        seed, of.structure, of.motion, of.vertical, None, of.initial, None, _options(seed),
        of.slope, of.ground_axes,
    )  # fmt: skip
    return motion, of.by_hand


def _options(seed: int) -> rk.SolverOptions:
    family = family_of(seed)
    assert family is not None
    method = METHODS[seed % BASE // len(_VARIANTS[family]) % len(METHODS)]
    limits = {"max_impacts": 300_000, "max_steps": 1_000_000}
    if method == "RK45 1e-6":
        return rk.SolverOptions(method="RK45", rtol=1e-6, **limits)
    return rk.SolverOptions(method=method.split()[0], **limits)


# -- ground and starts


def _restitution(dice: Dice) -> float:
    return dice.one_of(0.0, 0.0, 0.02, 0.03, 0.2, dice.between(0.0, 0.1), dice.between(0.0, 0.9))


def _friction(dice: Dice) -> float:
    """Below 4/3, from which on a rigid block on sliding feet may jam (Painleve)."""
    return dice.one_of(0.0, 0.3, 0.5, dice.over(0.03, 1.0), dice.between(0.05, 1.0))


def _ground(dice: Dice, lift: float, size: float, shaken: float = 0.5) -> rk.GroundMotion:
    """None, a pulse or a record in units of what lifts, for some of the structure's own time."""
    time = math.sqrt(size / GRAVITY)
    length = dice.over(4.0, 16.0) * time
    if not dice.chance(shaken):
        return rk.GroundMotion.none(length)
    strong = lift * dice.over(0.5, 4.0)
    if dice.chance(0.5):
        period = time * dice.over(0.5, 8.0)
        make = dice.one_of(rk.GroundMotion.single_sine, rk.GroundMotion.half_sine)
        return make(strong, period, duration=max(length, 1.01 * period))
    n = int(dice.over(20, 80))
    values = np.convolve(dice.rng.normal(size=n), np.ones(3) / 3, "same")
    return rk.GroundMotion.from_array(strong * values, 0.7 * length / n).padded_to(length)


def _vertical(dice: Dice, length: float) -> rk.GroundMotion | None:
    if not dice.chance(0.15):
        return None
    n = int(dice.over(20, 60))
    values = GRAVITY * dice.over(0.05, 0.6) * dice.rng.normal(size=n)
    return rk.GroundMotion.from_array(values, length / n)


# -- a block that slides


def _sliding_block(dice: Dice) -> Drawn:
    b, h = dice.over(0.1, 1.0), dice.over(0.2, 2.0)
    given = {
        "half_width": b, "half_height": h, "mass": dice.one_of(1.0, dice.over(0.1, 1e4)),
        "friction": _friction(dice), "restitution": _restitution(dice),
    }  # fmt: skip
    return _a_block(dice, rk.SlidingBlock(**given), of_sliding_block(given), b, h)


def _a_block(dice: Dice, structure: Structure, by_hand: Mechanics, b: float, h: float) -> Drawn:
    """Let go leaning, above the ground, moving, or from rest under shaking."""
    slenderness = math.atan(b / h)
    kind = dice.one_of("rest", "leaning", "leaning", "moving", "dropped", "sliding")
    initial: dict[str, float] = {}
    if kind != "rest":
        initial["theta"] = min(slenderness, 1.3) * dice.between(-1.2, 1.2)  # upright, not fallen
    if kind == "moving":
        initial["theta_dot"] = math.sqrt(GRAVITY / h) * slenderness * dice.between(-1.5, 1.5)
    if kind == "dropped":
        low = by_hand.lowest(initial["theta"]) if isinstance(by_hand, BlockOnFeet) else (
            b * abs(math.sin(initial["theta"]))
        )  # fmt: skip
        initial["y"] = low + h * dice.over(1e-6, 0.5)
        initial["theta_dot"] = dice.between(-0.5, 0.5)
        initial["x_dot"] = dice.between(-1.0, 1.0)
    if kind == "sliding":
        initial["x_dot"] = dice.between(-2.0, 2.0)
        if dice.chance(0.5):
            del initial["theta"]
    lift = GRAVITY * min(b / h, 2.0)
    motion = _ground(dice, lift, h, shaken=1.0 if kind == "rest" else 0.3)
    return Drawn(structure, by_hand, initial, motion, _vertical(dice, motion.duration))


def _other_law(law: str) -> Callable[[Dice], Drawn]:
    """The same where feet that touch at once meet by another law of impact; some are slender."""

    def drawn(dice: Dice) -> Drawn:
        block = _sliding_block(dice)
        numbers = dict(block.structure.parameters())
        if dice.chance(0.2):
            numbers["half_width"] *= dice.over(1e-5, 1.0)
            # tilted by less they turn as slowly as a rest may be
            block = replace(block, initial={"theta": numbers["half_width"] * dice.over(1e-2, 0.5)})
        if law == "lzb" and numbers["restitution"]:
            numbers["restitution"] = max(numbers["restitution"], LEAST_RESTITUTION)
        feet = two_feet(*(numbers[n] for n in ("half_width", "friction", "restitution")))
        by_hand = BlockOnFeet(numbers["mass"], numbers["inertia"], numbers["height"], feet)
        return replace(block, structure=rk.structure(_block_by(law), **numbers), by_hand=by_hand)

    return drawn


@functools.cache
def _block_by(law: str):
    return rk.derive("sliding_block", law=law)


# -- a stack


@functools.cache
def _stack_by_newton():
    return rk.derive("stacked_blocks")


def _stacked_blocks(dice: Dice) -> Drawn:
    b = dice.over(0.2, 0.8)
    h = b * dice.one_of(dice.over(0.5, 1.5), dice.over(1.0, 4.0))
    upper_b = b * dice.between(0.3, 1.0)
    upper_h = upper_b * dice.over(0.8, 5.0)
    given = {
        "lower_half_width": b, "lower_half_height": h, "lower_mass": dice.one_of(2.0, 1000.0),
        "upper_half_width": upper_b, "upper_half_height": upper_h,
        "restitution": _restitution(dice),
    }  # fmt: skip
    given["upper_mass"] = given["lower_mass"] * dice.over(0.2, 2.0)
    lower, upper = math.atan(b / h), math.atan(upper_b / upper_h)
    kind = dice.one_of("rest", "lower", "upper", "upper", "both", "both", "moving")
    initial: dict[str, float] = {}
    if kind in ("lower", "both", "moving"):
        initial["theta"] = lower * dice.between(-0.6, 0.6)
    if kind in ("upper", "both", "moving"):
        initial["phi"] = upper * dice.between(-0.9, 0.9)
    if kind == "moving":
        rate = math.sqrt(GRAVITY / h)
        initial["theta_dot"] = rate * lower * dice.between(-0.5, 0.5)
        initial["phi_dot"] = rate * upper * dice.between(-0.5, 0.5)
    lift = GRAVITY * min(b / h, upper_b / upper_h)
    motion = _ground(dice, lift, h + upper_h, shaken=1.0 if kind == "rest" else 0.2)
    stack = rk.structure(_stack_by_newton(), **rk.StackedBlocks(**given).parameters())
    return Drawn(stack, of_stack(given), initial, motion)


# -- declared feet


def _signed(symbol: str, name: str) -> Parameter:
    return Parameter(sp.Symbol(symbol, real=True), name, "m", "place along the base")


@functools.cache
def _on_feet(names: tuple[str, ...]):
    """A declaration whose feet are anywhere: places and heights are parameters."""
    along = [_signed(f"s_{name}", f"{name}_place") for name in names]
    above = [parameter(f"d_{name}", f"{name}_height", "m", "above the base") for name in names]
    places = {name: (s.symbol, d.symbol) for name, s, d in zip(names, along, above, strict=True)}
    return declared.on_points(f"on_{len(names)}_feet", places, *along, *above)


def _feet(names: tuple[str, ...]) -> Callable[[Dice], Drawn]:
    def drawn(dice: Dice) -> Drawn:
        b, h = dice.over(0.2, 1.0), dice.over(0.3, 2.0)
        mass = dice.one_of(1.0, 2.0, dice.over(0.1, 1e4))
        inertia = mass * (b * b + h * h) / 3.0 * dice.between(0.7, 1.3)
        friction, e = min(_friction(dice), 0.8), _restitution(dice)
        count = len(names)
        along = np.linspace(-b, b, count) + dice.one_of(0.0, 0.1) * b * dice.rng.normal(size=count)
        along.sort()
        raised = np.zeros(count)
        if count > 2:  # lower in the middle, or higher by little: no three of them stand together
            curve = (along / b) ** 2
            raised = b * dice.one_of(dice.over(1e-4, 0.3) * curve, -dice.over(1e-4, 0.05) * curve)
            raised -= raised.min()
        given = {
            "mass": mass, "height": h, "inertia": inertia, "gravity": GRAVITY,
            "friction": friction, "restitution": e,
        }  # fmt: skip
        given |= {f"{n}_place": float(s) for n, s in zip(names, along, strict=True)}
        given |= {f"{n}_height": float(d) for n, d in zip(names, raised, strict=True)}
        feet = tuple(
            Foot(n, float(s), float(d), friction, e)
            for n, s, d in zip(names, along, raised, strict=True)
        )
        by_hand = BlockOnFeet(mass, inertia, h, feet)
        return _a_block(dice, rk.structure(_on_feet(names), **given), by_hand, b, h)

    return drawn


# -- frames on feet that slide


def _frame_ground(dice: Dice, structure: Structure, by_hand: Frame) -> Drawn:
    b, h = by_hand.half_width, by_hand.floors[-1].height
    kind = dice.one_of("rest", "rest", "leaning", "moving")
    initial: dict[str, float] = {}
    if kind != "rest":
        initial["theta"] = math.atan(b / h) * dice.between(-0.7, 0.7)
    if kind == "moving":
        initial["theta_dot"] = math.sqrt(GRAVITY / h) * math.atan(b / h) * dice.between(-0.7, 0.7)
    motion = _ground(dice, GRAVITY * min(b / h, 1.0), 0.5 * h, 1.0 if kind == "rest" else 0.3)
    return Drawn(structure, by_hand, initial, motion)


def _support(dice: Dice) -> rk.Sliding:
    return rk.Sliding(friction=min(_friction(dice), 0.8), restitution=_restitution(dice))


def _shear_frame(dice: Dice) -> Drawn:
    storey = dice.over(1.0, 4.0)
    m = dice.over(1e3, 1e5)
    mass = (m, m * dice.over(0.5, 1.0))
    heights = (storey, 2 * storey)
    b = storey * dice.between(0.2, 0.8)
    rate = math.sqrt(GRAVITY / storey) * dice.over(3.0, 20.0)
    stiffness = (mass[0] * rate**2, mass[1] * rate**2)
    damping = tuple(2 * dice.between(0.01, 0.1) * k / rate for k in stiffness)
    base, inertia = 0.5 * m, 0.5 * m * b * b / 3.0
    support = _support(dice)
    structure = rk.ShearFrame(
        masses=mass, heights=heights, stiffnesses=stiffness, dampings=damping, half_width=b,
        base_mass=base, base_inertia=inertia, support=support,
    )  # fmt: skip
    floors = tuple(
        Storey(mass[i], 0.0, heights[i], stiffness[i], damping[i], f"u_{i + 1}") for i in (0, 1)
    )
    by_hand = Frame(
        floors, base, 0.0, inertia, b, two_feet(b, support.friction, support.restitution),
        coordinates=("x", "y", "theta", "u_1", "u_2"),
    )  # fmt: skip
    return _frame_ground(dice, structure, by_hand)


def _two_masses(dice: Dice) -> dict[str, float]:
    mass, height = dice.over(100.0, 1e5), dice.over(1.0, 10.0)
    base, b = mass * dice.over(0.1, 1.0), height * dice.between(0.1, 0.5)
    return {
        "mass": mass, "height": height, "inertia": dice.one_of(0.0, 0.1 * mass * height**2),
        "base_mass": base, "base_height": dice.one_of(0.0, 0.1) * height,
        "base_inertia": base * b * b * dice.between(0.2, 0.5), "half_width": b,
    }  # fmt: skip


def _flexible_structure(dice: Dice) -> Drawn:
    given = _two_masses(dice)
    rate = math.sqrt(GRAVITY / given["height"]) * dice.over(3.0, 20.0)
    k, c = given["mass"] * rate**2, 2 * dice.between(0.01, 0.1) * rate * given["mass"]
    support = _support(dice)
    structure = rk.FlexibleStructure(**given, stiffness=k, damping=c, support=support)
    by_hand = _on_base(given, (k, c), "u", ("x", "y", "theta", "u"))
    feet = two_feet(given["half_width"], support.friction, support.restitution)
    return _frame_ground(dice, structure, replace(by_hand, feet=feet))


def _on_base(
    given: dict[str, float], column: tuple[float, float], moves: str, coordinates: tuple[str, ...]
) -> Frame:
    top = Storey(given["mass"], given["inertia"], given["height"], *column, moves)
    return Frame(
        (top,), given["base_mass"], given["base_height"], given["base_inertia"],
        given["half_width"], coordinates=coordinates,
    )  # fmt: skip


# -- springs that press and never pull


def _springs(count: int, kind: str = "centre") -> Callable[[Dice], Drawn]:
    """Two springs or a bed of them, let go pressed, open, and with the feet moving to and fro.

    kind : what is guided, or "structure" for `TwoSpringStructure`.
    """

    def drawn(dice: Dice) -> Drawn:
        given = _two_masses(dice)
        b, total = given["half_width"], given["mass"] + given["base_mass"]
        settles = b * dice.over(1e-4, 0.1)
        stiffness = total * GRAVITY / (count * settles)
        rate = math.sqrt(count * stiffness / total)
        damping = dice.one_of(0.0, 2 * dice.over(0.01, 3.0) * rate * total / count)
        structure = _on_springs(given, count, kind, stiffness, damping)
        names = ["left", *(f"spring_{i}" for i in range(2, count)), "right"]
        places = np.linspace(-b, b, count)
        struts = tuple(
            (n, float(s), stiffness, damping) for n, s in zip(names, places, strict=True)
        )
        by_hand = replace(
            _on_base(given, (0.0, 0.0), "", ("theta", "heave")),
            struts=struts, settlement=total * GRAVITY / (count * stiffness),
            guided="foot" if kind == "foot" else "centre", has_points=False,
        )  # fmt: skip
        initial: dict[str, float] = {}
        start = dice.one_of("rest", "leaning", "open", "open", "aloft", "grazing")
        if start == "leaning":
            initial["theta"] = math.atan(b / given["height"]) * dice.between(-0.8, 0.8)
        if start == "open":  # one foot above its spring, moving down or up
            initial["theta"] = settles / b * dice.over(1.1, 10.0) * dice.one_of(1.0, -1.0)
            turns = dice.over(0.1, 50.0) * dice.one_of(1.0, -1.0)
            initial["theta_dot"] = rate * settles / b * turns
            initial["heave_dot"] = rate * settles * dice.between(-2.0, 2.0)
        if start == "aloft":
            initial["heave"] = settles * dice.over(1.01, 10.0)
            rises = dice.over(0.1, 50.0) * dice.one_of(1.0, -1.0)
            initial["heave_dot"] = rate * settles * rises
        if start == "grazing":  # all tops just touched
            initial["heave"] = settles
            initial["heave_dot"] = rate * settles * dice.one_of(0.0, -1.0, 1.0)
        lift = GRAVITY * b / given["height"]
        motion = _ground(dice, lift, given["height"], 1.0 if start == "rest" else 0.3)
        longest = dice.over(20.0, 400.0) / rate
        if motion.duration > longest and start != "rest":
            motion = rk.GroundMotion.none(longest)
        return Drawn(structure, by_hand, initial, motion)

    return drawn


def _on_springs(
    given: dict[str, float], count: int, kind: str, stiffness: float, damping: float
) -> Structure:
    if kind == "structure":
        return rk.TwoSpringStructure(
            **given, foundation_stiffness=stiffness, foundation_damping=damping
        )
    support = (
        rk.Winkler(springs=count, stiffness=stiffness, damping=damping)
        if count > 2
        else rk.TwoSprings(stiffness=stiffness, damping=damping, guided=kind)
    )
    return rk.LumpedMassStructure(**given, support=support)


# -- bars that yield and pads that press, at places of a block


@functools.cache
def _with_bars():
    """A block on two feet with yielding bars at two places, from the ground up."""
    feet = {"left": (-_B.symbol, sp.S.Zero), "right": (_B.symbol, sp.S.Zero)}
    model = declared.on_points("barred_block", feet, _B, *_BAR, *_BAR_PLACES)
    bars = tuple(
        Yielding(f"bar_{i}", declared.placed((p.symbol, 0))[1], *(q.symbol for q in _BAR))
        for i, p in enumerate(_BAR_PLACES, 1)
    )
    return replace(model, elements=bars)


@functools.cache
def _with_pads():
    """The same with springs and dampers, which press where their tops come below the ground."""
    feet = {"left": (-_B.symbol, sp.S.Zero), "right": (_B.symbol, sp.S.Zero)}
    model = declared.on_points("padded_block", feet, _B, *_PAD, *_BAR_PLACES)
    pads = tuple(
        Unilateral(f"pad_{i}", -place[1], _PAD[0].symbol, _PAD[1].symbol, place)
        for i, p in enumerate(_BAR_PLACES, 1)
        for place in [declared.placed((p.symbol, _PAD[2].symbol))]
    )
    return replace(model, elements=pads)


_B = parameter("b", "half_width", "m", "half of the width of the base")
_BAR = (
    parameter("k", "stiffness", "N/m", "stiffness of a bar"),
    parameter("f_y", "strength", "N", "force at which a bar yields"),
    parameter("k_h", "hardening", "N/m", "hardening of a bar"),
)
_PAD = (
    parameter("k", "stiffness", "N/m", "stiffness of a pad"),
    parameter("c", "damping", "N s/m", "damping of a pad"),
    parameter("d", "lifted", "m", "height of the pads above the base"),
)
_BAR_PLACES = (_signed("s_1", "first_place"), _signed("s_2", "second_place"))


def _held_block(dice: Dice) -> tuple[dict[str, float], dict[str, float]]:
    """Parameters of a block, and places of what holds it: at the middle, the feet or anywhere."""
    b, h = dice.over(0.2, 1.0), dice.over(0.5, 3.0)
    mass = dice.one_of(1.0, dice.over(1.0, 1e4))
    block = {
        "mass": mass, "height": h, "inertia": mass * (b * b + h * h) / 3.0, "gravity": GRAVITY,
        "friction": min(_friction(dice), 0.8), "restitution": _restitution(dice), "half_width": b,
    }  # fmt: skip
    places = dice.one_of((-b, b), (0.0, b), (0.0, b), (-0.5 * b, dice.between(0.0, 1.0) * b))
    return block, {"first_place": places[0], "second_place": places[1]}


def _hand_block(block: dict[str, float]) -> BlockOnFeet:
    feet = two_feet(*(block[name] for name in ("half_width", "friction", "restitution")))
    return BlockOnFeet(block["mass"], block["inertia"], block["height"], feet)


def _leaning(dice: Dice, block: dict[str, float]) -> dict[str, float]:
    """Let go, or pushed outward or back, from upright or leaning."""
    turn = math.atan(block["half_width"] / block["height"])
    initial = {}
    if dice.chance(0.7):
        initial["theta"] = turn * dice.over(1e-3, 0.7) * dice.one_of(1.0, -1.0)
    if dice.chance(0.6):
        speed = math.sqrt(GRAVITY / block["height"]) * turn * dice.over(0.01, 1.0)
        initial["theta_dot"] = speed * dice.one_of(1.0, -1.0)
    return initial


def _barred_block(dice: Dice) -> Drawn:
    block, places = _held_block(dice)
    weight = block["mass"] * GRAVITY
    strength = weight * dice.over(0.05, 2.0)
    stiffness = strength / (block["half_width"] * dice.over(1e-3, 0.1))
    hardening = stiffness * dice.one_of(0.0, dice.over(1e-3, 0.3))
    bars = tuple(
        (f"bar_{i}", place, stiffness, strength, hardening)
        for i, place in enumerate(places.values(), 1)
    )
    given = {"stiffness": stiffness, "strength": strength, "hardening": hardening}
    by_hand = replace(
        _hand_block(block), bars=bars, internal=tuple(f"{bar[0]}_extension" for bar in bars)
    )
    structure = rk.structure(_with_bars(), **block, **given, **places)
    return _held(dice, structure, by_hand, block)


def _padded_block(dice: Dice) -> Drawn:
    block, places = _held_block(dice)
    sinks = block["half_width"] * dice.over(1e-4, 0.1)
    stiffness = block["mass"] * GRAVITY / sinks
    damping = dice.one_of(0.0, 2 * dice.over(0.01, 1.0) * math.sqrt(stiffness * block["mass"]))
    lifted = dice.one_of(0.0, 0.0, sinks * dice.over(0.01, 10.0))
    pads = tuple(
        (f"pad_{i}", place, lifted, stiffness, damping)
        for i, place in enumerate(places.values(), 1)
    )
    by_hand = replace(_hand_block(block), pads=pads)
    given = {"stiffness": stiffness, "damping": damping, "lifted": lifted}
    structure = rk.structure(_with_pads(), **block, **given, **places)
    return _held(dice, structure, by_hand, block)


def _held(dice: Dice, structure: Structure, by_hand: BlockOnFeet, block: dict[str, float]) -> Drawn:
    b, h = block["half_width"], block["height"]
    initial = _leaning(dice, block)
    motion = _ground(dice, GRAVITY * min(b / h, 1.0), h, 0.3 if initial else 1.0)
    return Drawn(structure, by_hand, initial, motion)


@functools.cache
def _with_a_jack(turns: bool):
    """A block on two feet under a dead load, which turns with it or does not."""
    feet = {"left": (-_B.symbol, sp.S.Zero), "right": (_B.symbol, sp.S.Zero)}
    name = "block_and_jack" if turns else "block_and_weight"
    model = declared.on_points(name, feet, _B, _LOAD, _LENGTH)
    turned = declared.THETA.position if turns else sp.S.Zero
    load = dead_load("load", _LOAD.symbol, declared.placed((0, _LENGTH.symbol)), turned)
    return replace(model, forces=(load,))


_LOAD = parameter("N", "load", "N", "force that presses on a point of the axis")


def _loaded(turns: bool) -> Callable[[Dice], Drawn]:
    def drawn(dice: Dice) -> Drawn:
        block, _ = _held_block(dice)
        load = block["mass"] * GRAVITY * dice.over(0.01, 3.0)
        across = block["height"] * dice.between(0.5, 2.0)
        by_hand = replace(_hand_block(block), load=(load, across, float(turns)))
        structure = rk.structure(_with_a_jack(turns), **block, load=load, length=across)
        return _held(dice, structure, by_hand, block)

    return drawn


# -- smooth walls: contacts without friction


@functools.cache
def _ladder():
    """A ladder on a smooth floor, against a smooth wall to its left, at x = 0."""
    smooth = Rigid(restitution=declared.RESTITUTION.symbol, friction=sp.S.Zero)
    foot, top = declared.placed((0, 0)), declared.placed((0, _LENGTH.symbol))
    return replace(
        declared.on_points("ladder", {"foot": (0, 0)}, _LENGTH, laws={"foot": smooth}),
        parameters=(*(p for p in declared.BLOCK if p is not declared.FRICTION), _LENGTH),
        contacts=(
            Contact("foot", gap=foot[1], slip=foot[0], law=smooth),
            Contact("top", gap=top[0], slip=top[1], law=smooth, place=top),
        ),
    )


@functools.cache
def _before_a_stop():
    """A block on two feet with friction, before a smooth stop to its right."""
    smooth = Rigid(restitution=declared.RESTITUTION.symbol, friction=sp.S.Zero)
    feet = {"left": (-_B.symbol, sp.S.Zero), "right": (_B.symbol, sp.S.Zero)}
    block = declared.on_points("before_a_stop", feet, _B, _AWAY, _LENGTH)
    x, y = declared.placed((_B.symbol, _LENGTH.symbol))
    stop = Contact("stop", gap=_AWAY.symbol - x, slip=y, law=smooth, place=(x, y))
    return replace(block, contacts=(*block.contacts, stop))


_LENGTH = parameter("l", "length", "m", "how high the point is that touches the wall")
_AWAY = parameter("d", "away", "m", "where the wall stands")


def _a_ladder(dice: Dice) -> Drawn:
    half, mass, e = dice.over(0.3, 3.0), dice.over(1.0, 100.0), _restitution(dice)
    inertia = mass * half**2 * dice.one_of(1 / 3, dice.between(0.1, 1.0))
    given = {
        "mass": mass, "height": half, "inertia": inertia, "gravity": GRAVITY, "restitution": e,
        "length": 2 * half,
    }  # fmt: skip
    by_hand = AtWall(
        mass, inertia, half, (Foot("foot", 0.0, 0.0, 0.0, e),), point=("top", 0.0, 2 * half),
        bounces=e,
    )  # fmt: skip
    theta = -dice.between(0.05, 1.2)
    initial = {"theta": theta, "x": -2 * half * math.sin(theta), "y": 0.0}
    if dice.chance(0.3):
        initial["x"] += half * dice.over(1e-3, 0.3)
    if dice.chance(0.2):
        initial["y"] += half * dice.over(1e-3, 0.3)
    motion = rk.GroundMotion.none(dice.over(0.5, 3.0) * math.sqrt(half / GRAVITY))
    return Drawn(rk.structure(_ladder(), **given), by_hand, initial, motion)


def _a_stop(dice: Dice) -> Drawn:
    b, h, mass = dice.over(0.1, 1.0), dice.over(0.2, 2.0), dice.over(0.1, 1e3)
    friction, e = min(_friction(dice), 0.8), _restitution(dice)
    inertia, height = mass * (b * b + h * h) / 3.0, h * dice.between(0.0, 2.0)
    away = b + dice.over(1e-3, 0.5)
    given = {
        "mass": mass, "height": h, "inertia": inertia, "gravity": GRAVITY, "friction": friction,
        "restitution": e, "half_width": b, "away": away, "length": height,
    }  # fmt: skip
    by_hand = AtWall(
        mass, inertia, h, two_feet(b, friction, e), point=("stop", b, height), wall=away,
        facing=-1.0, bounces=e,
    )  # fmt: skip
    initial = {"x_dot": dice.over(0.1, 5.0)}
    motion = rk.GroundMotion.none(dice.over(2.0, 8.0) * math.sqrt(h / GRAVITY))
    return Drawn(rk.structure(_before_a_stop(), **given), by_hand, initial, motion)


# -- structures of practice, and ground that slopes


_TIES = {
    "putty": ("force", False), "anchor": ("energy", True), "strap": ("force", True),
    "facade": ("extension", False),
}  # fmt: skip
"""Limits at which ties break, and whether they yield."""


def _ties(dice: Dice, hand: BlockOnFeet, kind: str) -> tuple[Any, ...]:
    """Ties of a block, or none; a small part of its half-width draws them to their strength."""
    if kind not in _TIES:
        return ()
    limit, yields = _TIES[kind]
    b, h, strength = hand.feet[1].along, hand.height, hand.mass * GRAVITY * dice.over(0.05, 2.0)
    stiffness = strength / (b * dice.over(1e-3, 0.1))
    slack = dice.one_of(0.0, 0.0, b * dice.over(1e-4, 0.05))
    limits = {
        "force": strength * dice.over(0.9, 1.5),
        "extension": slack + strength / stiffness * dice.over(0.9, 5.0),
        "energy": strength * b * dice.over(1e-3, 0.2),
    }
    pretension = strength * dice.one_of(0.0, 0.0, dice.between(0.01, 0.8))
    given = {"stiffness": stiffness, "slack_length": slack, "pretension": pretension}
    given["breaks_at"] = rk.Break(**{limit: limits[limit]})
    if yields:
        given |= {"strength": strength, "hardening": stiffness * dice.one_of(0.0, 0.05, 0.3)}
    if kind == "putty":
        return rk.Anchor.pair(**given)
    if kind == "anchor":
        return (rk.Anchor(foot="left", **given),)
    at = -b * dice.one_of(1.0, dice.between(0.0, 1.0)), h * dice.between(0.2, 2.0)
    to = at[0] - b * dice.one_of(0.0, dice.over(0.3, 3.0)), -h * dice.between(0.1, 1.0)
    return (rk.Strap(at=at, to=to, **given),)


def _practical(kind: str) -> Callable[[Dice], Drawn]:
    """A sliding block made into a `HeldBlock`, a `Facade` or `IsolatedBlocks`."""

    def drawn(dice: Dice) -> Drawn:
        block = _sliding_block(dice)
        hand, initial = block.by_hand, block.initial
        b, h, mass, e = hand.feet[1].along, hand.height, hand.mass, hand.feet[1].restitution
        mu, time = min(hand.feet[1].friction, 0.8), math.sqrt(h / GRAVITY)
        size = {"width": 2 * b, "height": 2 * h, "mass": mass, "friction": mu, "restitution": e}
        feet, own = two_feet(b, mu, e), {}
        if ties := _ties(dice, hand, kind):
            size["restraint"] = ties
            flows = [f"{tie.name}_extension" for tie in ties if not math.isinf(tie.strength)]
            own = {"ties": ties, "internal": (*flows, *(f"{tie.name}_broken" for tie in ties))}
            if dice.chance(0.9):  # leaning it may begin beyond its limit
                initial = {n: x for n, x in initial.items() if n not in ("theta", "y")}
        if kind == "rounded":
            radius = b * dice.over(0.01, 0.9)
            offset = (b - radius) * dice.one_of(0.0, dice.between(-0.8, 0.8))
            size |= {"corner_radius": radius, "centroid_offset": offset}
            feet, own = two_feet(b - radius, mu, e), {"radius": radius, "offset": offset}
        elif kind == "round base":
            size["base_radius"] = own["radius"] = b * dice.over(1.0, 10.0)
            feet = (Foot("base", 0.0, 0.0, mu, e),)
            initial.pop("y", None)
            edge = 0.9 * math.asin(b / own["radius"])  # of the round base: the motion ends there
            initial["theta"] = max(-edge, min(edge, initial.get("theta", 0.0)))
        elif kind == "wall":
            gap, bounces = h * dice.over(1e-3, 0.3), _restitution(dice)
            size |= {"wall_gap": gap, "wall_restitution": bounces}
            own = {"point": ("wall", b, 2 * h), "wall": b + gap, "facing": -1.0, "bounces": bounces}
            initial["theta"] = -abs(initial.get("theta", 0.0))  # it may not begin beyond it
        elif kind == "push":
            size["loads"] = rk.Push(
                at=(0.0, h * dice.between(0.1, 2.0)), start=time * dice.one_of(0.0, 1.0),
                force=mass * GRAVITY * dice.over(0.05, 2.0) * dice.one_of(1.0, -1.0),
                duration=time * dice.over(0.1, 4.0),
            )  # fmt: skip
            own = {"pushes": (size["loads"],), "internal": ("push_time",)}
        elif kind == "facade":
            feet = (Foot("walls", -b, 0.0, 0.0, e),)
            own |= {"pivot": b, "coordinates": ("theta",)}
            del size["friction"]
            size["thickness"] = size.pop("width")
            initial = {n: abs(x) for n, x in initial.items() if n.startswith("theta")}
        elif kind == "isolator":
            base, rate = mass * dice.over(0.1, 10.0), dice.over(0.2, 3.0) / time
            stiffness = (mass + base) * rate**2
            damping = (mass + base) * rate * dice.between(0.0, 0.6)
            size = {
                "blocks": (rk.RigidBlock(half_width=b, half_height=h, mass=mass),), "friction": mu,
                "restitution": e, "base_mass": base, "isolator_stiffness": stiffness,
                "isolator_damping": damping,
            }  # fmt: skip
            coordinates = "u", "x", "y", "theta"
            own = {"isolator": (base, stiffness, damping), "coordinates": coordinates}
            initial["u_dot"] = h / time * dice.one_of(0.0, dice.between(-0.5, 0.5))
        make = {"facade": rk.Facade, "isolator": rk.IsolatedBlocks}.get(kind, rk.HeldBlock)
        of = AtWall if kind == "wall" else BlockOnFeet
        by_hand = of(mass, hand.inertia, h, feet, **own)
        return replace(block, structure=make(**size), by_hand=by_hand, initial=initial)

    return drawn


def _on_slope(drawn: Callable[[Dice], Drawn]) -> Callable[[Dice], Drawn]:
    def sloping(dice: Dice) -> Drawn:
        of, slope = drawn(dice), dice.over(1e-3, 0.3) * dice.one_of(1.0, -1.0)
        axes = "slope" if of.vertical else dice.one_of("slope", "world")
        return replace(of, slope=slope, ground_axes=axes)

    return sloping


_VARIANTS: dict[str, dict[str, Callable[[Dice], Drawn]]] = {
    "blocks": {"sliding_block": _sliding_block},
    "stacks": {"stacked_blocks": _stacked_blocks},
    "feet": {
        "on_2_feet": _feet(("a", "b")),
        "on_3_feet": _feet(("a", "b", "c")),
        "on_4_feet": _feet(("a", "b", "c", "d")),
    },
    "frames": {
        "sliding_shear_frame": _shear_frame,
        "sliding_flexible_structure": _flexible_structure,
    },
    "springs": {
        "on_two_springs": _springs(2),
        "on_a_bed_of_springs": _springs(3),
        "on_foot_guided_springs": _springs(2, "foot"),
        "two_spring_structure_by_hand": _springs(2, "structure"),
    },
    "bars": {"barred_block": _barred_block, "padded_block": _padded_block},
    "smooth": {"ladder": _a_ladder, "before_a_stop": _a_stop},
    "laws": {
        f"sliding_block by {law}": _other_law(law)
        for law in ("moreau", "poisson", "lzb", "pairwise")
    },
    "loads": {"block_and_weight": _loaded(False), "block_and_jack": _loaded(True)},
    "ties": {f"held by {kind}": _practical(kind) for kind in ("putty", "anchor", "strap")},
    "practice": {
        f"held_block, {kind}": _practical(kind)
        for kind in ("rounded", "round base", "wall", "push", "facade", "isolator")
    },
    "slopes": {
        f"{name} on a slope": _on_slope(drawn)
        for name, drawn in (
            ("block", _sliding_block), ("stack", _stacked_blocks), ("column", _flexible_structure),
            *((kind, _practical(kind)) for kind in ("strap", "facade", "isolator")),
        )
    },
}  # fmt: skip
FAMILIES = tuple(_VARIANTS)
ALLOWED: tuple[str, ...] = ("beyond the limit at which it breaks",)
"""Texts of errors with which a motion may be refused."""


EVERY = ("structures", *FAMILIES)
"""The families, and the structures on pinned feet and springs of `cases`."""


def spread(runs: int, first: int, families: Sequence[str]) -> list[int]:
    """So many seeds of all families alike, each from its own number `first` on."""
    each = [runs // len(families) + (i < runs % len(families)) for i in range(len(families))]
    return [
        first_of(family) + first + n
        for family, count in zip(families, each, strict=True)
        for n in range(count)
    ]
