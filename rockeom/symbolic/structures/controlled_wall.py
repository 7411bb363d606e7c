"""A rigid wall that rocks on its base, held by unbonded tendons (thesis chapter 4).

The wall turns about a point of its base that moves from the centreline towards the pressed edge
as it rocks, at the distance b from the centreline. Three models of it are built here: the
equivalent oscillator (4-27), the substitute gravity that takes the tendons' force as weight (4-32,
4-37) and Lagrange's equations of the positions themselves, where it may also bend (4.7).

A tendon is elastic, yields at a constant force, or is slack, a mode each. The permanent
extension is a coordinate that is held, and is put to its new value when yielding ends.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass, field, replace
from itertools import product
from typing import Any, ClassVar

import sympy as sp

from rockeom.symbolic.algebra import SIDE, at_side
from rockeom.symbolic.elements import Ending, Spring, Tie, switch_of
from rockeom.symbolic.lagrange import rate
from rockeom.symbolic.mode import Mode, Switch, Transition
from rockeom.symbolic.model import (
    Body,
    Coordinate,
    Foot,
    Member,
    NamedFunction,
    Parameter,
    coordinate,
    parameter,
    rectangle,
    turned,
)
from rockeom.symbolic.reactions import total_reaction
from rockeom.symbolic.registry import shipped
from rockeom.symbolic.rocking import RockingModel
from rockeom.symbolic.structures.dirac_delta import delta, loss
from rockeom.symbolic.structures.rigid_block import GRAVITY

ROTATION = coordinate("theta", "theta", "rad", "rotation, positive clockwise")
DISPLACEMENT = coordinate("Delta", "u", "m", "displacement of the wall at the height H")
DEFLECTION = coordinate(
    "u", "u", "m", "deflection of the wall relative to its base, at right angles to its axis"
)
PASSAGE_SPEED = coordinate(
    "w", "passage_speed", "m/s", "speed at which the present passage would come upright, no loss"
)

_SHARED = ("edge_distance", "initial_force")
"""Parameters of all walls that may be zero."""

MASS = parameter("m", "mass", "kg", "mass of the wall and what it carries")
EFFECTIVE_MASS = parameter("M_e", "effective_mass", "kg", "mass of the equivalent oscillator")
INERTIA = parameter("I_g", "inertia", "kg m2", "moment of inertia about the centroid")
PIVOT_INERTIA = parameter(
    "I_o", "pivot_inertia", "kg m2", "moment of inertia about the rotation centre, constant"
)
HEIGHT = parameter("H", "height", "m", "height of the point whose displacement is Delta")
CENTROID_HEIGHT = parameter("H_c", "centroid_height", "m", "height of the centroid")
HALF_WIDTH = parameter("B", "half_width", "m", "half of the width of the base")
EDGE_DISTANCE = parameter(
    "C_2", "edge_distance", "m", "distance of the rotation centre from the edge, fully rocking"
)
TRANSITION = parameter(
    "epsilon", "transition", "m", "displacement over which the rotation centre moves out"
)
STIFFNESS = parameter("k", "stiffness", "N/m", "stiffness of the wall against its deflection")
DAMPING = parameter("c", "damping", "N s/m", "viscous damping coefficient of the deflection")
REGULARISATION = parameter("n", "regularisation", "m", "width of a passage in Delta")
HELD = parameter(
    "h", "held", "-", "1: r of the speed of the whole passage; 0: of that of the instant"
)

PIECES = 4
"""Pieces of the energy ratio as a function of the speed, as in thesis 4-31."""

NEAR = 6
"""In units of n: beyond it nothing is left of the damping force, to the last bit of a double."""

SIDES = {"left": -1, "right": 1}

WORDS = {0: "", -1: "_slack", 1: "_yield"}
"""Ends of names of modes, by the states of a tendon, a `Tie`."""


# --- the rotation centre


@dataclass(frozen=True)
class RotationCentre:
    """Distance b from the centreline [m] as an even function of the displacement D [m].

    distance : takes a SymPy expression of D and gives one of b. parameters : of it, besides
    `HALF_WIDTH`.
    """

    distance: Callable[[sp.Expr], sp.Expr]
    parameters: tuple[Parameter, ...] = ()


def _moved_out(displacement: sp.Expr) -> sp.Expr:
    return 1 - sp.exp(-((displacement / TRANSITION.symbol) ** 2))


MIGRATING = RotationCentre(
    lambda D: (HALF_WIDTH.symbol - EDGE_DISTANCE.symbol) * _moved_out(D),
    (EDGE_DISTANCE, TRANSITION),
)
"""Thesis 4-7 and 4-8, with C_1 = B - C_2."""

MIGRATING_TO_THE_EDGE = RotationCentre(lambda D: HALF_WIDTH.symbol * _moved_out(D), (TRANSITION,))
"""Thesis 4-37."""

AT_THE_EDGE = RotationCentre(lambda D: HALF_WIDTH.symbol)
"""Thesis 4-32."""


# --- the tendons


@dataclass(frozen=True)
class Tendon:
    """Symbols of one tendon; with several they are numbered from 1.

    Its states are those of the element `Tie`, but that the permanent extension rests while it
    yields, and is put to its value where that ends: meanwhile its force is the yield force.
    """

    number: str
    stiffness: Parameter
    initial_force: Parameter
    yield_force: Parameter
    eccentricity: Parameter
    permanent: Coordinate
    extension: sp.Expr

    @property
    def name(self) -> str:
        return f"tendon{self.number}"

    @property
    def parameters(self) -> tuple[Parameter, ...]:
        return self.stiffness, self.initial_force, self.yield_force, self.eccentricity

    @property
    def element(self) -> Tie:
        """It, but that its permanent extension flows while it yields."""
        return Tie(
            self.name, self.extension, self.stiffness.symbol, self.yield_force.symbol,
            pretension=self.initial_force.symbol,
        )  # fmt: skip

    @property
    def settled(self) -> sp.Expr:
        """The permanent extension when yielding ends."""
        flowed = sp.expand(self.element.settled(1)[self.element.variable])
        return sp.collect(flowed, 1 / self.stiffness.symbol)

    def in_state(self, expr: sp.Expr, state: int) -> sp.Expr:
        """An expression of the element in a state, the permanent extension put in."""
        z = self.element.variable.symbol
        if state == 1:
            return sp.expand(expr.xreplace({z: self.settled}))
        return expr.xreplace({z: self.permanent.position})

    def force(self, state: int = 0) -> sp.Expr:
        """Its force; of the elastic state 0, P_0 + k (x - x_p)."""
        return self.in_state(self.element.still_force(sp.Integer(state)), state)

    def energy(self, state: int) -> sp.Expr:
        """Energy that it gives back when released, P**2/(2 k)."""
        return self.in_state(self.element.energy(sp.Integer(state)), state)

    @property
    def switches(self) -> dict[int, sp.Symbol]:
        """The symbol of each state with a force."""
        first = 2 * (int(self.number.strip("_") or 1) - 1)
        return {0: switch_of(first), 1: switch_of(first + 1)}

    def by_state(self, value: Callable[[int], sp.Expr]) -> sp.Expr:
        """An expression that vanishes where it is slack, written once for all states."""
        return sum((chi * value(state) for state, chi in self.switches.items()), sp.S.Zero)

    @property
    def acting(self) -> HeldTendon:
        """It among the elements of a mode."""
        return HeldTendon(
            self.name, self.extension - self.permanent.position, self.stiffness.symbol,
            initial_force=self.initial_force.symbol, of=self,
        )  # fmt: skip

    def plastic_force(self, by: sp.Symbol) -> sp.Expr:
        """Generalised force of the yield force, whose work is not stored."""
        return -self.switches[1] * self.yield_force.symbol * sp.diff(self.extension, by)

    def endings(self, state: int, moving: Coordinate) -> Iterable[Ending]:
        """Ends of a state; of two that lead to the same state only the one with a way back."""
        endings = self.element.endings((moving,))[state]
        return {e.target: e for e in sorted(endings, key=lambda e: e.back is not None)}.values()


@dataclass(frozen=True)
class HeldTendon(Spring):
    """A `Tendon` as an element; its deformation is without what yielded."""

    of: Tendon = field(kw_only=True)

    @property
    def output_displacement(self) -> sp.Expr:
        yields = self.of.switches[1]
        drawn = (self.of.yield_force.symbol - self.initial_force) / self.stiffness
        return (1 - yields) * self.deformation + yields * drawn

    def still_force(self, chi: sp.Expr = sp.S.One) -> sp.Expr:
        return self.of.by_state(self.of.force)

    def energy(self, chi: sp.Expr = sp.S.One) -> sp.Expr:
        return self.of.by_state(self.of.energy)

    def loss(self, chi: sp.Expr, coordinates: tuple[Coordinate, ...]) -> sp.Expr:
        yields = self.of.switches[1] * self.of.yield_force.symbol
        return yields * rate(self.deformation, coordinates)


@dataclass(frozen=True)
class Tendons:
    """All tendons of a wall, whose extensions are functions of one coordinate."""

    each: tuple[Tendon, ...]
    moving: Coordinate

    @property
    def states(self) -> Iterator[tuple[int, ...]]:
        """All combinations of states."""
        return product(WORDS, repeat=len(self.each))

    @property
    def parameters(self) -> tuple[Parameter, ...]:
        return tuple(p for t in self.each for p in t.parameters)

    @property
    def permanent(self) -> tuple[Coordinate, ...]:
        return tuple(t.permanent for t in self.each)

    @property
    def several(self) -> str:
        """End of the name of a structure with more than one."""
        return f"_{len(self.each)}_tendons" if len(self.each) != 1 else ""

    def members(self, low: sp.Expr, high: sp.Expr) -> tuple[Member, ...]:
        """For a sketch: from a depth under the base to a height over the centroid."""
        places = (t.eccentricity.symbol for t in self.each)
        return tuple(Member("tendon", "ground", "wall", (e, low), (e, high)) for e in places)

    def suffix(self, states: Iterable[int]) -> str:
        """End of the name of a mode."""
        pairs = zip(self.each, states, strict=True)
        return "".join(f"{WORDS[state]}{t.number}" for t, state in pairs if state)

    def switches(self, places: Iterable[str]) -> tuple[Switch, ...]:
        """The numbers by which equations serve all states, in the modes of some places."""
        words = {0: "is elastic", 1: "yields"}

        def on(i: int, state: int) -> tuple[str, ...]:
            there = [self.suffix(states) for states in self.states if states[i] == state]
            return tuple(f"{place}{suffix}" for suffix in there for place in places)

        return tuple(
            Switch(chi, f"while `{t.name}` {words[state]}", on(i, state))
            for i, t in enumerate(self.each)
            for state, chi in t.switches.items()
        )

    def quantities(self, centre: sp.Expr) -> dict[str, tuple[str, sp.Expr]]:
        """Further quantities of a response of the wall."""
        lengths_and_forces = {"rotation_centre": ("m", centre)}
        for t in self.each:
            lengths_and_forces[f"tendon_extension{t.number}"] = "m", t.extension
            lengths_and_forces[f"tendon_force{t.number}"] = "N", t.by_state(t.force)
        return lengths_and_forces

    def functions(
        self, centre: sp.Expr, distance: sp.Expr, extension: Callable[[Tendon], sp.Expr]
    ) -> tuple[NamedFunction, ...]:
        """The distance b of the rotation centre and the tendons' extensions."""
        b = NamedFunction(
            centre, "rotation_centre", "m", "distance of the rotation centre from the centreline",
            distance,
        )  # fmt: skip
        extensions = (
            NamedFunction(
                t.extension, f"tendon_extension{t.number}", "m",
                f"extension of tendon{t.number.replace('_', ' ')} since the initial state",
                extension(t),
            )
            for t in self.each
        )  # fmt: skip
        return (b, *extensions)


def _tendons(count: int, moving: Coordinate) -> Tendons:
    numbers = [str(i) for i in range(1, count + 1)] if count > 1 else [""]
    return Tendons(tuple(_tendon(number, moving) for number in numbers), moving)


def _tendon(number: str, moving: Coordinate) -> Tendon:
    """Tendon of that number, "" where it is alone."""
    name, which = (f"_{number}", f"tendon {number}") if number else ("", "tendon")

    def of(symbol: str, word: str, unit: str, meaning: str) -> Parameter:
        return parameter(symbol, f"{word}{name}", unit, f"{meaning} of {which}")

    place = f"place of {which} along the base, from the centreline, positive to the right"
    permanent = f"permanent extension of {which} by yielding that has ended"
    return Tendon(
        name,
        of(f"k{name or '_T'}", "tendon_stiffness", "N/m", "stiffness"),
        of(f"P_{{0{number}}}", "initial_force", "N", "force"),
        of(f"F_{{y{number}}}", "yield_force", "N", "yield force"),
        Parameter(sp.Symbol(f"e{name}", real=True), f"eccentricity{name}", "m", place),
        coordinate(f"x_{{p{number}}}", f"permanent_extension{name}", "m", permanent),
        sp.Function(f"x{name or '_T'}", real=True)(moving.position),
    )


@dataclass(frozen=True)
class Wall:
    """A wall in its places ("left", ...), each with a side, in all states of its tendons."""

    tendons: Tendons

    places: ClassVar[Mapping[str, int]] = SIDES

    def mode(self, sides: dict[str, int]) -> Mode:
        """Its equations in all places and states."""
        raise NotImplementedError

    def leaving(self, place: str, states: tuple[int, ...]) -> list[Transition]:
        """Transitions to other places in the same states: an impact where it comes upright."""
        suffix, s = self.tendons.suffix(states), SIDES[place]
        other = "right" if s < 0 else "left"
        gap = s * self.tendons.moving.position
        return [Transition(f"{place}{suffix}", f"{other}{suffix}", "impact", gap)]


def _model(wall: Wall, **described: Any) -> RockingModel:
    """One mode for all states of the tendons, and the transitions between all of them."""
    tendons, sides = wall.tendons, dict[str, int]()
    transitions: list[Transition] = []
    for states in tendons.states:
        suffix = tendons.suffix(states)
        for place in wall.places:
            sides[f"{place}{suffix}"] = wall.places[place]
            transitions += wall.leaving(place, states)
            for i, (tendon, state) in enumerate(zip(tendons.each, states, strict=True)):
                settled = {tendon.permanent.position: tendon.settled} if state == 1 else {}
                transitions += (
                    Transition(
                        f"{place}{suffix}",
                        f"{place}{tendons.suffix((*states[:i], ending.target, *states[i + 1 :]))}",
                        "switch",
                        tendon.in_state(ending.guard[0], state),
                        sets=settled,
                        reversible=ending.back is not None,
                    )
                    for ending in tendon.endings(state, tendons.moving)
                )
    described["parameters"] = tuple(dict.fromkeys(described["parameters"]))  # each once
    mode = replace(wall.mode(sides), switches=tendons.switches(wall.places))
    return RockingModel(
        modes=(mode,), transitions=tuple(transitions), rotation=tendons.moving, **described
    )


# --- the oscillator


def _energy_ratio() -> tuple[tuple[Parameter, ...], Callable[[sp.Expr], sp.Expr]]:
    """r of the speed in straight pieces, each from the end of the one before: (parameters, r)."""
    found, pieces = [], []
    for i in range(1, PIECES + 1):
        name = "energy_ratio" if i == 1 else f"energy_ratio_{i}"
        r = parameter(f"r_{i}", name, "-", f"energy ratio r of a passage, in piece {i} at no speed")
        slope = Parameter(
            sp.Symbol(f"r'_{i}", real=True), f"energy_ratio_slope_{i}", "s/m",
            f"slope of the energy ratio in piece {i}",
        )  # fmt: skip
        found += [r, slope]
        end = None
        if i < PIECES:
            end = parameter(f"v_{i}", f"speed_limit_{i}", "m/s", f"speed at which piece {i} ends")
            found.append(end)
        pieces.append((r.symbol, slope.symbol, end.symbol if end else None))

    def ratio(speed: sp.Expr) -> sp.Expr:
        return sp.Piecewise(
            *((r + slope * speed, True if end is None else speed < end) for r, slope, end in pieces)
        )

    return tuple(found), ratio


@dataclass(frozen=True)
class _Oscillator(Wall):
    """The equivalent oscillator: its symbols, functions, modes and the transitions between them."""

    q: ClassVar = DISPLACEMENT.position
    v: ClassVar = DISPLACEMENT.velocity
    centre: ClassVar = sp.Function("b", real=True)(q)
    rise: ClassVar = sp.Function("y_0", real=True)(q)
    speed, ratio, now, upright = sp.symbols("v r v_a V_0", positive=True)
    places: ClassVar[Mapping[str, int]] = {
        f"{side}{part}": s for side, s in SIDES.items() for part in ("", "_inward", "_near")
    }

    def functions(
        self, distance: sp.Expr, ratio: Callable[[sp.Expr], sp.Expr]
    ) -> tuple[NamedFunction, ...]:
        """Geometry, the energy in the wall upright, and the energy ratio at a speed."""
        H, B, q = HEIGHT.symbol, HALF_WIDTH.symbol, self.q
        w, h = PASSAGE_SPEED.position, HELD.symbol
        cosine = sp.sqrt(1 - (q / H) ** 2)
        lever = (self.centre + B * (1 - cosine)) / cosine  # d - B
        stored = (
            sp.Max(t.force().subs(t.extension, 0), 0) ** 2 / (2 * t.stiffness.symbol)
            for t in self.tendons.each
        )
        return (
            *self.tendons.functions(
                self.centre, distance,
                lambda t: (SIDE * lever - t.eccentricity.symbol) * (q / H) / cosine,
            ),
            NamedFunction(
                self.rise, "rise", "m", "rise of the middle of the base", SIDE * lever * q / H
            ),
            NamedFunction(
                self.upright, "upright_energy", "J", "energy of the tendons in the wall upright",
                sum(stored, sp.S.Zero),
            ),
            NamedFunction(
                self.now, "present_speed", "m/s", "speed of the instant", sp.Abs(self.v)
            ),
            NamedFunction(
                self.speed, "speed", "m/s", "speed on which r depends", h * w + (1 - h) * self.now
            ),
            NamedFunction(
                self.ratio, "energy_ratio", "-", "ratio of kinetic energies of the passage",
                ratio(self.speed),
            ),
        )  # fmt: skip

    @property
    def raised(self) -> sp.Expr:
        """Potential energy of gravity."""
        return MASS.symbol * GRAVITY.symbol * self.rise

    def mode(self, sides: dict[str, int]) -> Mode:
        B, M = HALF_WIDTH.symbol, EFFECTIVE_MASS.symbol
        damping = M * loss(self.ratio) * delta(self.q, REGULARISATION.symbol) * self.now * self.v
        place = (self.q, sp.S.Zero)
        return Mode(
            sides,
            (DISPLACEMENT,),
            (Body("wall", M, place, outline=rectangle(B, 0, B)),),
            GRAVITY.symbol,
            self.raised,
            load_point=place,
            forces=(sum((t.plastic_force(self.q) for t in self.tendons.each), damping),),
            quantities=self.tendons.quantities(self.centre),
            elements=tuple(t.acting for t in self.tendons.each),
        )

    def leaving(self, place: str, states: tuple[int, ...]) -> list[Transition]:
        """From mark to mark on the way."""
        suffix, q, v = self.tendons.suffix(states), SIDE * self.q, SIDE * self.v
        side, other = ("left", "right") if self.places[place] < 0 else ("right", "left")

        def to(target: str, guard: sp.Expr, sets: dict | None = None) -> Transition:
            return Transition(
                f"{place}{suffix}", f"{target}{suffix}", "switch", guard, sets=sets or {}
            )

        if place == side:
            if 1 in states:
                return []  # turning back ends the yielding first, and only then x_p is known
            stored = sum((t.by_state(t.energy) for t in self.tendons.each), self.raised)
            gained = sp.Max(stored - self.upright, 0)
            speed = sp.sqrt(self.v**2 + 2 * gained / EFFECTIVE_MASS.symbol)
            return [to(f"{side}_inward", v, {PASSAGE_SPEED.position: speed})]
        if place == f"{side}_inward":
            return [to(f"{side}_near", q - NEAR * REGULARISATION.symbol), to(side, -v)]
        return [to(other, q), to(side, -v)]


@shipped(
    place=12,
    may_vanish=_SHARED,
    defaults={"effective_mass": "mass", "eccentricity": 0.0},
    called={
        f"{name}_{i}": "energy_ratio"
        for i in range(1, 5)
        for name in ("energy_ratio", "energy_ratio_slope", "speed_limit")
        if (name, i) not in (("energy_ratio", 1), ("speed_limit", 4))
    },
)
def controlled_wall_oscillator(
    tendons: int = 1, centre: RotationCentre = MIGRATING
) -> RockingModel:
    """The equivalent oscillator, whose losses are a force (thesis 4-27 to 4-31, 4-39).

    A mass M_e at the displacement D. The restoring force is that of the potential energies of
    gravity (4-18) and of the tendons (4-20), with the geometry of the thesis: an edge has risen by
    d sin|theta| with d cos(theta) = B + b, and a tendon grows by the uplift over cos(theta) (4-10).
    The loss of a passage is spread by a Gaussian of the width n, as in `dirac_delta_block`.

    Modes are marks on the way: a wall moves outward ("left"), back ("left_inward"), and back near
    the middle ("left_near"), where the force begins, so that no step leaps over it. On turning back
    the speed is noted at which it would come upright.

    The energy ratio is a number, or an `EnergyRatioAtSpeed`. With held the speed is, for a whole
    passage, that with which the wall would come upright without losses from where it turned back;
    else it is the speed of the instant, and r changes within a passage. The 6 % by which 4.8.1
    raises F_k are those of effective_mass = mass/1.06. The energies are those of 4-18 and 4-20,
    without P-delta; the elastic energy holds that of gravity.

    The state `u` is Delta [m]; no velocity jumps and `impacts` is empty. Tolerances must be below
    the regularisation n.
    """
    B, cables = HALF_WIDTH.symbol, _tendons(tendons, DISPLACEMENT)
    wall = _Oscillator(cables)
    ratio_parameters, ratio = _energy_ratio()
    return _model(
        wall,
        name=f"controlled_wall_oscillator{cables.several}",
        title="Controlled rocking wall as an equivalent oscillator",
        parameters=(
            MASS, EFFECTIVE_MASS, HEIGHT, HALF_WIDTH, *centre.parameters, *cables.parameters,
            REGULARISATION, HELD, *ratio_parameters, GRAVITY,
        ),
        coordinates=(DISPLACEMENT, *cables.permanent, PASSAGE_SPEED),
        functions=wall.functions(centre.distance(wall.q), ratio),
        members=(Member("spring", "ground", "wall", (-3 * B, B / 2), (-B, B / 2)),),
        overturning=2 * B - EDGE_DISTANCE.symbol
        if EDGE_DISTANCE in centre.parameters
        else 2 * B,
        reference="thesis 4-18, 4-20, 4-27 to 4-31, 4-39",
        sources={"u": "thesis 4-27"},
    )  # fmt: skip


# --- walls that turn


def _pressed(mode: Mode, pivot: tuple[sp.Expr, sp.Expr], pull: sp.Expr) -> Mode:
    """It with feet: the pressed one carries all, with the downward pull of the tendons."""
    vertical = total_reaction(mode)[1] + pull
    share = {"left": (1 - SIDE) / 2, "right": (1 + SIDE) / 2}
    edges = {
        name: turned((s * HALF_WIDTH.symbol, 0), pivot, ROTATION.position)
        for name, s in SIDES.items()
    }
    return replace(
        mode, feet={name: Foot(edge, vertical * share[name]) for name, edge in edges.items()}
    )


@dataclass(frozen=True)
class _SubstituteGravity(Wall):
    """Housner's block with the tendons' force as weight.

    arm : distance of the rotation centre from the centreline, taken as fixed at each instant.
    """

    arm: sp.Expr

    q: ClassVar = ROTATION.position
    centre: ClassVar = sp.Function("b", real=True)(q)

    def functions(self, distance: sp.Expr, lever: sp.Expr) -> tuple[NamedFunction, ...]:
        """Extensions, the lever where it is no constant, and forces of elastic tendons."""
        q, B = self.q, HALF_WIDTH.symbol

        def extension(t: Tendon) -> sp.Expr:
            edge = SIDE * (self.centre + B * (1 - sp.cos(q))) / sp.cos(q)
            return (edge - t.eccentricity.symbol) * sp.tan(q)

        functions = self.tendons.functions(self.centre, distance, extension)
        if self.arm != B:
            meaning = "arm, from the centreline to the centre about which the wall turns"
            functions += (NamedFunction(self.arm, "lever", "m", meaning, lever),)
        forces = (
            NamedFunction(
                self.elastic_force(t), t.initial_force.name.replace("initial", "elastic"), "N",
                "force of a tendon that is elastic", t.force(),
            )
            for t in self.tendons.each
        )  # fmt: skip
        return (*functions, *forces)

    def elastic_force(self, tendon: Tendon) -> sp.Symbol:
        """Symbol of the force of an elastic tendon: the model has no derivative of it."""
        return sp.Symbol(f"P_{{T{tendon.number.strip('_')}}}", real=True)

    def weight(self, tendon: Tendon) -> sp.Expr:
        """The force of a tendon as weight."""
        forces = {0: self.elastic_force(tendon), 1: tendon.force(1)}
        return tendon.by_state(forces.__getitem__)

    def mode(self, sides: dict[str, int]) -> Mode:
        H, B, Hc, m = HEIGHT.symbol, HALF_WIDTH.symbol, CENTROID_HEIGHT.symbol, MASS.symbol
        q, pivot = self.q, (SIDE * self.arm, sp.S.Zero)
        downward = sum(map(self.weight, self.tendons.each), sp.S.Zero)
        centroid = turned((0, Hc), pivot, q)
        inertia = PIVOT_INERTIA.symbol - m * (self.arm**2 + Hc**2)
        mode = Mode(
            sides,
            (ROTATION,),
            (Body("wall", m, centroid, inertia, q, outline=rectangle(B, Hc, H - Hc)),),
            GRAVITY.symbol,
            load_point=turned((0, H), pivot, q),
            forces=(-downward * sp.diff(centroid[1], q),),
            quantities=self.tendons.quantities(self.arm),
        )
        return _pressed(mode, pivot, downward)


@shipped(place=13, may_vanish=_SHARED, defaults={"eccentricity": 0.0})
def substitute_gravity_wall(
    tendons: int = 1,
    centre: RotationCentre = MIGRATING,
    lever: RotationCentre = MIGRATING_TO_THE_EDGE,
) -> RockingModel:
    """Housner's block with the force of the tendons as weight (thesis 4-32, 4-37, 4-40).

    The force of all tendons acts downwards at the centroid, and the moment of inertia about the
    rotation centre is constant. The moments are about B (1 - exp(-(Delta/epsilon)**2)) from the
    centreline (4-37), taken as fixed at each instant: terms with the rate at which it moves are not
    in the model. The extension of the tendon is that of b (4-16). The work of its weight is no
    stored energy, and `elastic_energy` is zero.
    """
    # lever: of the centre about which the wall turns; centre: of the extension of the tendons
    H, B, Hc = HEIGHT.symbol, HALF_WIDTH.symbol, CENTROID_HEIGHT.symbol
    cables, fixed = _tendons(tendons, ROTATION), lever is AT_THE_EDGE
    D = H * sp.sin(ROTATION.position)
    wall = _SubstituteGravity(cables, B if fixed else sp.Symbol("ell", positive=True))
    model = _model(
        wall,
        name="simplified_substitute_gravity_wall" if fixed else "substitute_gravity_wall",
        title="Controlled rocking wall with substitute gravity"
        + (", about its edges" if fixed else ""),
        parameters=(
            MASS, PIVOT_INERTIA, CENTROID_HEIGHT, HEIGHT, HALF_WIDTH, *centre.parameters,
            *lever.parameters, *cables.parameters, GRAVITY,
        ),
        coordinates=(ROTATION, *cables.permanent),
        functions=wall.functions(centre.distance(D), lever.distance(D)),
        members=cables.members(sp.S.Zero, H - Hc),
        overturning=sp.pi / 3,  # far beyond overturning; the extension (4-13) has no value at pi/2
        reference="thesis 4-32" if fixed else "thesis 4-37, 4-40",
        sources={"theta": "thesis 4-32" if fixed else "thesis 4-40"},
    )  # fmt: skip
    return _one_ratio(_with_full_contact(model, cables) if fixed else model)


def _with_full_contact(model: RockingModel, cables: Tendons) -> RockingModel:
    """The wall also stands still on both edges, its tendons elastic or slack."""
    forces = {f.symbol: f.value for f in model.functions if f.symbol.is_Symbol}

    def standing(expr: sp.Expr) -> sp.Expr:
        return at_side(sp.sympify(expr).xreplace(forces).subs({ROTATION.position: 0}), 1)

    def stand(point: tuple[sp.Expr, sp.Expr]) -> tuple[sp.Expr, sp.Expr]:
        return standing(point[0]), standing(point[1])

    # full contact after an impact: no tendon goes on yielding in it
    held = {states: cables.suffix(min(state, 0) for state in states) for states in cables.states}
    rests = {f"{side}{cables.suffix(x)}": f"both{y}" for x, y in held.items() for side in SIDES}
    (turning,) = model.modes
    upright = Mode(
        dict.fromkeys(rests.values(), 0),
        (),
        tuple(replace(b, position=stand(b.position), rotation=sp.S.Zero) for b in turning.bodies),
        turning.gravity,
        feet={name: Foot(stand(f.position)) for name, f in turning.feet.items()},
        load_point=turning.load_point and stand(turning.load_point),
        quantities={k: (u, standing(e)) for k, (u, e) in turning.quantities.items()},
        switches=cables.switches(["both"]),
    )
    rocking = (
        replace(t, fallback=rests[t.source]) if t.kind == "impact" else t for t in model.transitions
    )
    uplifts = (
        Transition(both, f"{side}{both.removeprefix('both')}", "uplift")
        for both in upright.sides
        for side in SIDES
    )
    return replace(model, modes=(turning, upright), transitions=(*rocking, *uplifts))


def _one_ratio(model: RockingModel) -> RockingModel:
    """With one coordinate free, or b(0) = 0, the impulsive impact law is the velocity ratio."""
    return replace(model, rigid_velocity_ratio=model.velocity_ratio)


@shipped(place=14, may_vanish=_SHARED, defaults={"eccentricity": 0.0})
def simplified_substitute_gravity_wall() -> RockingModel:
    """A `SubstituteGravityWall` whose moments are about the edges of the base (thesis 4-32).

    Only the extension of the tendon knows of the rotation centre that moves (4-16). The wall lifts
    off when the ground acceleration exceeds (m g + P) B/(m H_c).
    """
    return substitute_gravity_wall(lever=AT_THE_EDGE)


ANCHOR_HEIGHT = parameter(
    "H_a", "anchor_height", "m", "height of the tendons' anchors in the wall above its base"
)
ANCHOR_DEPTH = parameter(
    "H_f", "anchor_depth", "m", "depth of their anchors in the foundation below the base"
)


@dataclass(frozen=True)
class _Lagrangian(Wall):
    """The wall by Lagrange's equations, which may bend."""

    flexible: bool

    q: ClassVar = ROTATION.position
    centre: ClassVar = sp.Function("b", real=True)(q)
    pivot: ClassVar = (SIDE * centre, sp.S.Zero)
    length: ClassVar = ANCHOR_HEIGHT.symbol + ANCHOR_DEPTH.symbol

    @property
    def moving(self) -> tuple[Coordinate, ...]:
        return (ROTATION, DEFLECTION) if self.flexible else (ROTATION,)

    def run(self, t: Tendon) -> tuple[sp.Expr, sp.Expr]:
        """From a tendon's anchor in the foundation to that in the wall."""
        e = t.eccentricity.symbol
        x, y = turned((e, ANCHOR_HEIGHT.symbol), self.pivot, self.q)
        return x - e, y + ANCHOR_DEPTH.symbol

    def functions(self, distance: sp.Expr) -> tuple[NamedFunction, ...]:
        return self.tendons.functions(
            self.centre,
            distance,
            lambda t: sp.sqrt(self.run(t)[0] ** 2 + self.run(t)[1] ** 2) - self.length,
        )

    def mode(self, sides: dict[str, int]) -> Mode:
        H, B, Hc = HEIGHT.symbol, HALF_WIDTH.symbol, CENTROID_HEIGHT.symbol
        u, cables = DEFLECTION.position if self.flexible else sp.S.Zero, self.tendons.each
        bending = (Spring("wall", u, STIFFNESS.symbol, DAMPING.symbol),) if self.flexible else ()
        at, top = turned((u, Hc), self.pivot, self.q), sp.Max(H, ANCHOR_HEIGHT.symbol)
        outline = rectangle(B, Hc, top - Hc)
        mode = Mode(
            sides,
            self.moving,
            (Body("wall", MASS.symbol, at, INERTIA.symbol, self.q, outline=outline),),
            GRAVITY.symbol,
            load_point=turned((u, H), self.pivot, self.q),
            forces=(
                sum((t.plastic_force(self.q) for t in cables), sp.S.Zero),
                *(sp.S.Zero for _ in self.moving[1:]),
            ),
            quantities=self.tendons.quantities(self.centre),
            elements=(*(t.acting for t in cables), *bending),
        )
        pulls = (t.by_state(t.force) * self.run(t)[1] / (t.extension + self.length) for t in cables)
        down = sum(pulls, sp.S.Zero)
        return _pressed(mode, self.pivot, down)


@shipped(place=10, may_vanish=(*_SHARED, "inertia", "anchor_depth"), defaults={"eccentricity": 0.0})
def controlled_wall(
    tendons: int = 1, centre: RotationCentre = MIGRATING, flexible: bool = False
) -> RockingModel:
    """A rigid wall held by an unbonded tendon, by Lagrange's equations with no term dropped.

    It turns by theta about the point of its base that lies at b from the centreline and has no
    vertical displacement: b = (B - edge_distance) (1 - exp(-(Delta/epsilon)**2)), thesis 4-8, with
    the displacement Delta of the point at the height H and the transition epsilon. The kinetic
    energy contains the motion of that point along the base. A tendon is straight between its
    anchor in the wall and that in the foundation.

    The tendon is elastic, yields, or is slack: a mode each. The state `permanent_extension` gets
    its new value when yielding ends. A wall that starts at rest beyond yield has been pulled there.
    `tendon_force`, `tendon_extension` and `rotation_centre` are quantities of a response.

    The rotation centre passes the centreline with the wall upright, so that no velocity jumps
    there: without an impact law no energy is lost.
    """
    # flexible: all above the base line moves across the axis by u, and turns with the base
    cables = _tendons(tendons, ROTATION)
    wall = _Lagrangian(cables, flexible)
    model = _model(
        wall,
        name=("flexible_" if flexible else "") + f"controlled_wall{cables.several}",
        title="Controlled rocking wall" + (" that bends," if flexible else "")
        + " by Lagrange's equations",
        parameters=(
            MASS, INERTIA, CENTROID_HEIGHT, HEIGHT, HALF_WIDTH, *centre.parameters,
            ANCHOR_HEIGHT, ANCHOR_DEPTH, *cables.parameters,
            *((STIFFNESS, DAMPING) if flexible else ()), GRAVITY,
        ),
        coordinates=(*wall.moving, *cables.permanent),
        functions=wall.functions(centre.distance(HEIGHT.symbol * sp.sin(ROTATION.position))),
        members=cables.members(-ANCHOR_DEPTH.symbol, ANCHOR_HEIGHT.symbol - CENTROID_HEIGHT.symbol),
        reference="thesis 4-8, 4-33; Lagrange's equations in place of 4-27 and 4-32"
        + ("; the fixed-base period of 4.7" if flexible else ""),
    )  # fmt: skip
    return _one_ratio(model)


@shipped(place=11, may_vanish=(*_SHARED, "anchor_depth", "damping"), defaults={"eccentricity": 0.0})
def flexible_controlled_wall() -> RockingModel:
    """The wall of `ControlledWall` that bends on its base while it rocks (thesis 4.7).

    All that is above the base line turns with the base through theta and moves across the wall's
    axis by u [m], against the stiffness and the damping: on a base that cannot turn its period is
    2 pi sqrt(mass/k). The displacement of a response and the load of a pushover are those of the
    point at height H of the bent wall. The rotation centre and the tendon follow the rotation of
    the base, Delta = H sin(theta): the anchor in the wall lies on the axis of the wall unbent. At
    30 mm of the thesis's wall that leaves out 0.1 % of the force that bends it.

    A wall that turns about its centreline resists no small rotation. It then vibrates as one on a
    hinge, (1 + m H_c**2/I)**(1/2) times as fast as on a base that cannot turn. No velocity jumps
    where it comes upright.
    """
    return controlled_wall(flexible=True)
