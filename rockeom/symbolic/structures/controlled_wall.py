"""A rigid wall that rocks on its base, held by unbonded tendons (thesis chapter 4).

The wall turns about a point of its base that moves from the centreline towards the pressed edge
as it rocks, at the distance b from the centreline. Three models of it are built here: the
equivalent oscillator (4-27), the substitute gravity that takes the tendons' force as weight (4-32,
4-37) and Lagrange's equations of the positions themselves, where it may also bend (4.7).

A tendon is elastic, yields at a constant force, or is slack, a contact state each. The permanent
extension is a coordinate that is held, and is put to its new value when yielding ends.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, replace
from itertools import product

import sympy as sp

from rockeom.symbolic.algebra import SIDE, at_side
from rockeom.symbolic.contact import total_reaction
from rockeom.symbolic.elements import Spring
from rockeom.symbolic.lagrange import rate
from rockeom.symbolic.mode import Mode, Transition
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
"""Of the energy ratio as a function of the speed; as many as thesis 4-31 has."""

NEAR = 6
"""In units of n: beyond it nothing is left of the damping force, to the last bit of a double."""

SIDES = {"left": -1, "right": 1}

ELASTIC, SLACK, YIELDING = "", "slack", "yield"


# --- the rotation centre


@dataclass(frozen=True)
class RotationCentre:
    """A law b of the displacement D [m]: the distance from the centreline [m], even in D.

    distance : takes a SymPy expression of D and gives one of b. parameters : what is in it besides
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
class TendonState(Spring):
    """A tendon while it is elastic, slack or yields; its deformation is without what yielded."""

    state: str = ELASTIC
    yield_force: sp.Expr = sp.S.Zero

    @property
    def told_displacement(self) -> sp.Expr:
        if self.state == YIELDING:
            return (self.yield_force - self.initial_force) / self.stiffness
        return self.deformation

    def still_force(self, chi: sp.Expr = sp.S.One) -> sp.Expr:
        if self.state == ELASTIC:
            return super().still_force(chi)
        return self.yield_force if self.state == YIELDING else sp.S.Zero

    def energy(self, chi: sp.Expr = sp.S.One) -> sp.Expr:
        """What it gives back when it is let loose, P**2/(2 k)."""
        return self.still_force(chi) ** 2 / (2 * self.stiffness)

    def loss(self, chi: sp.Expr, coordinates: tuple[Coordinate, ...]) -> sp.Expr:
        if self.state != YIELDING:
            return sp.S.Zero
        return self.yield_force * rate(self.deformation, coordinates)


@dataclass(frozen=True)
class Tendon:
    """Symbols of one tendon; with several they are numbered from 1."""

    number: int
    stiffness: Parameter
    initial_force: Parameter
    yield_force: Parameter
    eccentricity: Parameter
    permanent: Coordinate
    extension: sp.Function

    @property
    def name(self) -> str:
        return self.permanent.name.replace("permanent_extension", "tendon")

    def force(self, extension: sp.Expr, permanent: sp.Expr | None = None) -> sp.Expr:
        """P_0 + k (x - x_p), as long as it is elastic."""
        held = self.permanent.position if permanent is None else permanent
        return self.initial_force.symbol + self.stiffness.symbol * (extension - held)

    def permanent_while_yielding(self, extension: sp.Expr) -> sp.Expr:
        """x_p at which the force at this extension is F_y."""
        return (
            extension
            - (self.yield_force.symbol - self.initial_force.symbol) / self.stiffness.symbol
        )

    def force_in(self, state: str, extension: sp.Expr) -> sp.Expr:
        if state == ELASTIC:
            return self.force(extension)
        return self.yield_force.symbol if state == YIELDING else sp.S.Zero

    def element(self, state: str, extension: sp.Expr) -> TendonState:
        """It in a state, by name."""
        return TendonState(
            self.name, extension - self.permanent.position, self.stiffness.symbol,
            initial_force=self.initial_force.symbol, state=state,
            yield_force=self.yield_force.symbol,
        )  # fmt: skip

    def plastic_force_in(self, state: str, extension: sp.Expr, by: sp.Symbol) -> sp.Expr:
        """Generalised force of the yield force, whose work is not stored."""
        if state != YIELDING:
            return sp.S.Zero
        return -self.yield_force.symbol * sp.diff(extension, by)

    @property
    def parameters(self) -> tuple[Parameter, ...]:
        return self.stiffness, self.initial_force, self.yield_force, self.eccentricity


def _tendons(count: int) -> tuple[Tendon, ...]:
    found = []
    for i in range(1, count + 1):
        mark, name, which = (f"_{i}", f"_{i}", f" {i}") if count > 1 else ("", "", "")

        def of(symbol: str, word: str, unit: str, meaning: str) -> Parameter:
            return parameter(symbol, f"{word}{name}", unit, f"{meaning}{which}")  # noqa: B023

        eccentricity = Parameter(
            sp.Symbol(f"e{mark}", real=True),
            f"eccentricity{name}",
            "m",
            f"place of tendon{which} along the base, from the centreline, positive to the right",
        )
        found.append(
            Tendon(
                i,
                of(f"k{mark or '_T'}", "tendon_stiffness", "N/m", "stiffness of tendon"),
                of(f"P_{{0{i if count > 1 else ''}}}", "initial_force", "N", "force of tendon"),
                of(f"F_{{y{i if count > 1 else ''}}}", "yield_force", "N", "yield force of tendon"),
                eccentricity,
                coordinate(
                    f"x_{{p{i if count > 1 else ''}}}",
                    f"permanent_extension{name}",
                    "m",
                    f"permanent extension of tendon{which} by yielding that has ended",
                ),
                sp.Function(f"x{mark or '_T'}", real=True),
            )
        )
    return tuple(found)


def _suffix(tendons: tuple[Tendon, ...], states: Iterable[str]) -> str:
    single = len(tendons) == 1
    return "".join(
        f"_{state}" + ("" if single else f"_{tendon.number}")
        for tendon, state in zip(tendons, states, strict=True)
        if state
    )


def _changes(
    tendon: Tendon, state: str, x: sp.Expr, moving: tuple[Coordinate, ...]
) -> list[tuple[str, sp.Expr, dict[sp.Symbol, sp.Expr]]]:
    """(state that follows, guard, what is put to a new value) for one tendon of extension x."""
    force = tendon.force(x)
    if state == ELASTIC:
        return [(YIELDING, tendon.yield_force.symbol - force, {}), (SLACK, force, {})]
    if state == SLACK:
        return [(ELASTIC, -force, {})]
    kept = {tendon.permanent.position: tendon.permanent_while_yielding(x)}
    return [(ELASTIC, rate(x, moving), kept)]


def _laws(
    tendons: tuple[Tendon, ...],
    q: sp.Symbol,
    centre: sp.Expr,
    distance: sp.Expr,
    extension: Callable[[Tendon], sp.Expr],
) -> tuple[NamedFunction, ...]:
    """b and the tendons' extensions as functions of the coordinate q."""
    b = NamedFunction(
        centre, "rotation_centre", "m", "distance of the rotation centre from the centreline",
        distance,
    )  # fmt: skip

    def which(t: Tendon) -> str:
        return f" {t.number}" if len(tendons) > 1 else ""

    def number(t: Tendon) -> str:
        return which(t).replace(" ", "_")

    return (
        b,
        *(
            NamedFunction(
                t.extension(q), f"tendon_extension{number(t)}", "m",
                f"extension of tendon{which(t)} since the initial state", extension(t),
            )
            for t in tendons
        ),
    )  # fmt: skip


def _quantities(
    tendons: tuple[Tendon, ...], states: tuple[str, ...], q: sp.Symbol, centre: sp.Expr
) -> dict[str, tuple[str, sp.Expr]]:
    """What a response tells of a wall, besides displacement and uplifts."""
    found = {"rotation_centre": ("m", centre)}
    for t, state in zip(tendons, states, strict=True):
        mark = f"_{t.number}" if len(tendons) > 1 else ""
        found[f"tendon_extension{mark}"] = "m", t.extension(q)
        found[f"tendon_force{mark}"] = "N", t.force_in(state, t.extension(q))
    return found


def _unique(parameters: Iterable[Parameter]) -> tuple[Parameter, ...]:
    return tuple(dict.fromkeys(parameters))


def _build(
    tendons: tuple[Tendon, ...],
    moving: Coordinate,
    places: Mapping[str, int],
    passages: Callable[[str, tuple[str, ...]], list[Transition]],
    mode_of: Callable[[dict[str, int], tuple[str, ...]], Mode],
    **described,
) -> RockingModel:
    """A mode for each state of the tendons, and the transitions between all of them.

    passages : those out of a place ("left", ...) of the states named, without their suffixes.
    """
    x = {t.number: t.extension(moving.position) for t in tendons}
    modes, transitions = [], []
    for states in product((ELASTIC, SLACK, YIELDING), repeat=len(tendons)):
        suffix = _suffix(tendons, states)
        modes.append(mode_of({f"{p}{suffix}": s for p, s in places.items()}, states))
        for place, side in places.items():
            transitions += passages(place, states)
            for i, tendon in enumerate(tendons):
                for follows, guard, sets in _changes(
                    tendon, states[i], x[tendon.number], (moving,)
                ):
                    then = (*states[:i], follows, *states[i + 1 :])
                    transitions.append(
                        Transition(
                            f"{place}{suffix}",
                            f"{place}{_suffix(tendons, then)}",
                            "switch",
                            at_side(guard, side),
                            sets={k: at_side(e, side) for k, e in sets.items()},
                            # a tendon begins to yield at any rate, and ends at none
                            reversible=follows != YIELDING,
                        )
                    )
    return RockingModel(
        modes=tuple(modes), transitions=tuple(transitions), rotation=moving, **described
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


@shipped(place=12)
def controlled_wall_oscillator(
    tendons: int = 1, centre: RotationCentre = MIGRATING
) -> RockingModel:
    """The equivalent oscillator, whose losses are a force (thesis 4-27 to 4-31, 4-39).

    A mass M_e at the displacement D. The restoring force is that of the potential energies of
    gravity (4-18) and of the tendons (4-20), with the geometry of the thesis: an edge has risen by
    d sin|theta| with d cos(theta) = B + b, and a tendon grows by the uplift over cos(theta) (4-10).
    The loss of a passage is spread by a Gaussian of the width n, as in `dirac_delta_block`.

    Contact states are marks on the way: a wall moves outward ("left"), back ("left_inward"), and
    back near the middle ("left_near"), where the force begins, so that no step leaps over it. On
    turning back it is noted at what speed it would come upright.
    """
    cables = _tendons(tendons)
    q, v = DISPLACEMENT.position, DISPLACEMENT.velocity
    H, B, m, M = HEIGHT.symbol, HALF_WIDTH.symbol, MASS.symbol, EFFECTIVE_MASS.symbol
    n, w, h = REGULARISATION.symbol, PASSAGE_SPEED.position, HELD.symbol
    b, rise = sp.Function("b", real=True)(q), sp.Function("y_0", real=True)(q)
    cosine = sp.sqrt(1 - (q / H) ** 2)
    lever = (b + B * (1 - cosine)) / cosine  # d - B
    ratio_parameters, ratio = _energy_ratio()
    speed, r, now, upright = sp.symbols("v r v_a V_0", positive=True)
    damping = M * loss(r) * delta(q, n) * now * v
    laws = (
        *_laws(
            cables, q, b, centre.distance(q),
            lambda t: (SIDE * lever - t.eccentricity.symbol) * (q / H) / cosine,
        ),
        NamedFunction(rise, "rise", "m", "rise of the middle of the base", SIDE * lever * q / H),
        NamedFunction(
            upright, "upright_energy", "J", "energy of the tendons in the wall upright",
            sum(
                (
                    sp.Max(t.force(sp.S.Zero), 0) ** 2 / (2 * t.stiffness.symbol)
                    for t in cables
                ),
                sp.S.Zero,
            ),
        ),
        NamedFunction(now, "present_speed", "m/s", "speed of the instant", sp.Abs(v)),
        NamedFunction(speed, "speed", "m/s", "speed on which r depends", h * w + (1 - h) * now),
        NamedFunction(
            r, "energy_ratio", "-", "ratio of kinetic energies of the passage", ratio(speed)
        ),
    )  # fmt: skip

    def elements(states: tuple[str, ...]) -> tuple[TendonState, ...]:
        return tuple(t.element(s, t.extension(q)) for t, s in zip(cables, states, strict=True))

    raised = m * GRAVITY.symbol * rise

    def stored(states: tuple[str, ...]) -> sp.Expr:
        return sum((e.energy() for e in elements(states)), raised)

    def mode_of(contacts: dict[str, int], states: tuple[str, ...]) -> Mode:
        plastic = (
            t.plastic_force_in(s, t.extension(q), q) for t, s in zip(cables, states, strict=True)
        )
        place = (q, sp.S.Zero)
        return Mode(
            contacts,
            (DISPLACEMENT,),
            (Body("wall", M, place, outline=rectangle(B, 0, B)),),
            GRAVITY.symbol,
            raised,
            load_point=place,
            forces=(damping + sum(plastic, sp.S.Zero),),
            quantities=_quantities(cables, states, q, b),
            elements=elements(states),
        )

    places = {f"{side}{part}": s for side, s in SIDES.items() for part in ("", "_inward", "_near")}

    def passages(place: str, states: tuple[str, ...]) -> list[Transition]:
        suffix, s = _suffix(cables, states), places[place]
        side = "left" if s < 0 else "right"
        other = "right" if s < 0 else "left"

        def to(target: str, guard: sp.Expr, sets: dict | None = None) -> Transition:
            return Transition(
                f"{place}{suffix}", f"{target}{suffix}", "switch", guard, sets=sets or {}
            )

        if place == side:
            if YIELDING in states:
                return []  # turning back ends the yielding first, and only then x_p is known
            gained = sp.Max(at_side(stored(states), s) - upright, 0)
            return [to(f"{side}_inward", s * v, {w: sp.sqrt(v**2 + 2 * gained / M)})]
        if place == f"{side}_inward":
            return [to(f"{side}_near", s * q - NEAR * n), to(side, -s * v)]
        return [to(other, s * q), to(side, -s * v)]

    several = f"_{tendons}_tendons" if tendons != 1 else ""
    return _build(
        cables,
        DISPLACEMENT,
        places,
        passages,
        mode_of,
        name=f"controlled_wall_oscillator{several}",
        title="Controlled rocking wall as an equivalent oscillator",
        parameters=_unique(
            (
                MASS, EFFECTIVE_MASS, HEIGHT, HALF_WIDTH, *centre.parameters,
                *(p for t in cables for p in t.parameters),
                REGULARISATION, HELD, *ratio_parameters, GRAVITY,
            )
        ),
        coordinates=(DISPLACEMENT, *(t.permanent for t in cables), PASSAGE_SPEED),
        functions=laws,
        members=(Member("spring", "ground", "wall", (-3 * B, B / 2), (-B, B / 2)),),
        overturning=2 * B - EDGE_DISTANCE.symbol
        if EDGE_DISTANCE in centre.parameters
        else 2 * B,
        reference="thesis 4-18, 4-20, 4-27 to 4-31, 4-39",
    )  # fmt: skip


# --- walls that turn


def _crossing(
    cables: tuple[Tendon, ...],
) -> Callable[[str, tuple[str, ...]], list[Transition]]:
    """An impact where the wall comes upright."""

    def passages(place: str, states: tuple[str, ...]) -> list[Transition]:
        suffix, s = _suffix(cables, states), SIDES[place]
        other = "right" if s < 0 else "left"
        return [
            Transition(f"{place}{suffix}", f"{other}{suffix}", "impact", s * ROTATION.position),
        ]

    return passages


def _pressed(mode: Mode, edges: dict[str, tuple[sp.Expr, sp.Expr]], pull: sp.Expr) -> Mode:
    """It with feet: the pressed one carries all, with the downward pull of the tendons."""
    vertical = total_reaction(mode)[1] + pull
    share = {"left": (1 - SIDE) / 2, "right": (1 + SIDE) / 2}
    return replace(
        mode, feet={name: Foot(edge, vertical * share[name]) for name, edge in edges.items()}
    )


@shipped(place=13)
def substitute_gravity_wall(
    tendons: int = 1,
    centre: RotationCentre = MIGRATING,
    lever: RotationCentre = MIGRATING_TO_THE_EDGE,
) -> RockingModel:
    """Housner's block with the tendons' force as weight (thesis 4-32, 4-37, 4-40).

    The force of all tendons acts downwards at the centroid, and the moment of inertia about the
    rotation centre is constant. `lever` : the law of the centre about which the wall turns, taken
    as fixed at each instant: terms with the rate at which it moves are not in the model.
    `centre` : the law behind the extension of the tendons, as in the oscillator (4-16).
    """
    cables = _tendons(tendons)
    q = ROTATION.position
    H, B, Hc, m = HEIGHT.symbol, HALF_WIDTH.symbol, CENTROID_HEIGHT.symbol, MASS.symbol
    D = H * sp.sin(q)
    b, held = sp.Function("b", real=True)(q), sp.Symbol("ell", positive=True)
    fixed = lever is AT_THE_EDGE
    arm = B if fixed else held
    pivot = (SIDE * arm, sp.S.Zero)
    centroid = turned((0, Hc), pivot, q)
    inertia = PIVOT_INERTIA.symbol - m * (arm**2 + Hc**2)
    body = Body("wall", m, centroid, inertia, q, outline=rectangle(B, Hc, H - Hc))
    edges = {name: turned((s * B, 0), pivot, q) for name, s in SIDES.items()}

    def extension(t: Tendon) -> sp.Expr:
        across = SIDE * (b + B * (1 - sp.cos(q))) / sp.cos(q) - t.eccentricity.symbol
        return across * sp.tan(q)

    laws = _laws(cables, q, b, centre.distance(D), extension)
    if not fixed:
        meaning = "arm, from the centreline to the centre about which the wall turns"
        laws += (NamedFunction(held, "lever", "m", meaning, lever.distance(D)),)

    named = {t: sp.Symbol(f"P_{{T{t.number if tendons > 1 else ''}}}", real=True) for t in cables}
    laws += tuple(
        NamedFunction(
            named[t], t.initial_force.name.replace("initial", "elastic"), "N",
            "force of a tendon that is elastic", t.force(t.extension(q)),
        )
        for t in cables
    )  # fmt: skip

    def pull(states: tuple[str, ...]) -> sp.Expr:
        """The force of all tendons; no derivative of it is in the model."""
        return sum(
            (
                named[t] if s == ELASTIC else t.force_in(s, t.extension(q))
                for t, s in zip(cables, states, strict=True)
            ),
            sp.S.Zero,
        )

    def mode_of(contacts: dict[str, int], states: tuple[str, ...]) -> Mode:
        downward = pull(states)
        mode = Mode(
            contacts,
            (ROTATION,),
            (body,),
            GRAVITY.symbol,
            load_point=turned((0, H), pivot, q),
            forces=(-downward * sp.diff(centroid[1], q),),
            quantities=_quantities(cables, states, q, arm),
        )
        return _pressed(mode, edges, downward)

    model = _build(
        cables,
        ROTATION,
        SIDES,
        _crossing(cables),
        mode_of,
        name="simplified_substitute_gravity_wall" if fixed else "substitute_gravity_wall",
        title="Controlled rocking wall with substitute gravity"
        + (", about its edges" if fixed else ""),
        parameters=_unique(
            (
                MASS, PIVOT_INERTIA, CENTROID_HEIGHT, HEIGHT, HALF_WIDTH, *centre.parameters,
                *lever.parameters, *(p for t in cables for p in t.parameters), GRAVITY,
            )
        ),
        coordinates=(ROTATION, *(t.permanent for t in cables)),
        functions=laws,
        members=tuple(
            Member("tendon", "ground", "wall", (e, sp.S.Zero), (e, H - Hc))
            for e in (t.eccentricity.symbol for t in cables)
        ),
        overturning=sp.pi / 3,  # fallen by far; the extension (4-13) has no value at pi/2
        reference="thesis 4-32" if fixed else "thesis 4-37, 4-40",
    )  # fmt: skip
    return _one_law(_with_full_contact(model, cables) if fixed else model)


def _with_full_contact(model: RockingModel, cables: tuple[Tendon, ...]) -> RockingModel:
    """The wall also stands still on both edges, its tendons elastic or slack."""
    modes = []
    uplifts: list[Transition] = []

    forces = {law.symbol: law.value for law in model.functions if law.symbol.is_Symbol}

    def standing(expr: sp.Expr) -> sp.Expr:
        return at_side(sp.sympify(expr).xreplace(forces).subs({ROTATION.position: 0}), 1)

    def stand(point: tuple[sp.Expr, sp.Expr]) -> tuple[sp.Expr, sp.Expr]:
        return standing(point[0]), standing(point[1])

    for states in product((ELASTIC, SLACK), repeat=len(cables)):
        suffix = _suffix(cables, states)
        turning = model.mode(f"right{suffix}")
        modes.append(
            Mode(
                {f"both{suffix}": 0},
                (),
                tuple(
                    replace(b, position=stand(b.position), rotation=sp.S.Zero)
                    for b in turning.bodies
                ),
                turning.gravity,
                feet={name: Foot(stand(f.position)) for name, f in turning.feet.items()},
                load_point=turning.load_point and stand(turning.load_point),
                quantities={k: (u, standing(e)) for k, (u, e) in turning.quantities.items()},
            )
        )
        uplifts += [Transition(f"both{suffix}", f"{side}{suffix}", "uplift") for side in SIDES]
    rests = {}  # the full contact to which an impact may lead: no tendon goes on yielding in it
    for states in product((ELASTIC, SLACK, YIELDING), repeat=len(cables)):
        kept = tuple(ELASTIC if state == YIELDING else state for state in states)
        for side in SIDES:
            rests[f"{side}{_suffix(cables, states)}"] = f"both{_suffix(cables, kept)}"
    rocking = (
        replace(t, fallback=rests[t.source]) if t.kind == "impact" else t for t in model.transitions
    )
    return replace(model, modes=(*model.modes, *modes), transitions=(*rocking, *uplifts))


def _one_law(model: RockingModel) -> RockingModel:
    """With one coordinate free, or b(0) = 0, the impulsive law is that of the velocity ratio."""
    return replace(model, rigid_velocity_ratio=model.velocity_ratio)


@shipped(place=14)
def simplified_substitute_gravity_wall() -> RockingModel:
    """The same about the edges of the base (thesis 4-32)."""
    return substitute_gravity_wall(lever=AT_THE_EDGE)


ANCHOR_HEIGHT = parameter(
    "H_a", "anchor_height", "m", "height of the tendons' anchors in the wall above its base"
)
ANCHOR_DEPTH = parameter(
    "H_f", "anchor_depth", "m", "depth of their anchors in the foundation below the base"
)


@shipped(place=10)
def controlled_wall(
    tendons: int = 1, centre: RotationCentre = MIGRATING, flexible: bool = False
) -> RockingModel:
    """The wall by Lagrange's equations, no term dropped.

    It turns by theta about the point of its base that lies at b(theta) from the centreline and
    has no vertical displacement. The kinetic energy contains the motion of that point along the
    base. A tendon is straight between its anchor in the wall and that in the foundation.

    `flexible` : all that is above the base line moves across the axis by u against a spring and a
    damper, and turns with the base. b and the tendons know the rotation of the base alone: their
    anchors are on the axis of the wall unbent.
    """
    cables = _tendons(tendons)
    q = ROTATION.position
    moving = (ROTATION, DEFLECTION) if flexible else (ROTATION,)
    u = DEFLECTION.position if flexible else sp.S.Zero
    bending = (Spring("wall", u, STIFFNESS.symbol, DAMPING.symbol),) if flexible else ()
    H, B, Hc, m = HEIGHT.symbol, HALF_WIDTH.symbol, CENTROID_HEIGHT.symbol, MASS.symbol
    b = sp.Function("b", real=True)(q)
    pivot = (SIDE * b, sp.S.Zero)
    at, top = turned((u, Hc), pivot, q), sp.Max(H, ANCHOR_HEIGHT.symbol)
    body = Body("wall", m, at, INERTIA.symbol, q, outline=rectangle(B, Hc, top - Hc))
    edges = {name: turned((s * B, 0), pivot, q) for name, s in SIDES.items()}
    length = ANCHOR_HEIGHT.symbol + ANCHOR_DEPTH.symbol

    def run(t: Tendon) -> tuple[sp.Expr, sp.Expr]:
        """From the anchor in the foundation to that in the wall."""
        e = t.eccentricity.symbol
        x, y = turned((e, ANCHOR_HEIGHT.symbol), pivot, q)
        return x - e, y + ANCHOR_DEPTH.symbol

    def mode_of(contacts: dict[str, int], states: tuple[str, ...]) -> Mode:
        pairs = list(zip(cables, states, strict=True))
        plastic = sum((t.plastic_force_in(s, t.extension(q), q) for t, s in pairs), sp.S.Zero)
        mode = Mode(
            contacts,
            moving,
            (body,),
            GRAVITY.symbol,
            load_point=turned((u, H), pivot, q),
            forces=(plastic, *(sp.S.Zero for _ in moving[1:])),
            quantities=_quantities(cables, states, q, b),
            elements=(*(t.element(s, t.extension(q)) for t, s in pairs), *bending),
        )
        down = sum(
            (
                t.force_in(s, t.extension(q)) * run(t)[1] / (t.extension(q) + length)
                for t, s in pairs
            ),
            sp.S.Zero,
        )
        return _pressed(mode, edges, down)

    several = f"_{tendons}_tendons" if tendons != 1 else ""
    model = _build(
        cables,
        ROTATION,
        SIDES,
        _crossing(cables),
        mode_of,
        name=("flexible_" if flexible else "") + f"controlled_wall{several}",
        title="Controlled rocking wall" + (" that bends," if flexible else "")
        + " by Lagrange's equations",
        parameters=_unique(
            (
                MASS, INERTIA, CENTROID_HEIGHT, HEIGHT, HALF_WIDTH, *centre.parameters,
                ANCHOR_HEIGHT, ANCHOR_DEPTH, *(p for t in cables for p in t.parameters),
                *((STIFFNESS, DAMPING) if flexible else ()), GRAVITY,
            )
        ),
        coordinates=(*moving, *(t.permanent for t in cables)),
        functions=_laws(
            cables, q, b, centre.distance(H * sp.sin(q)),
            lambda t: sp.sqrt(run(t)[0] ** 2 + run(t)[1] ** 2) - length,
        ),
        members=tuple(
            Member(
                "tendon", "ground", "wall", (e, -ANCHOR_DEPTH.symbol),
                (e, ANCHOR_HEIGHT.symbol - Hc),
            )
            for e in (t.eccentricity.symbol for t in cables)
        ),
        reference="thesis 4-8, 4-33; Lagrange's equations in place of 4-27 and 4-32"
        + ("; the fixed-base period of 4.7" if flexible else ""),
    )  # fmt: skip
    return _one_law(model)


@shipped(place=11)
def flexible_controlled_wall() -> RockingModel:
    """The wall with one tendon that bends on its base while it rocks."""
    return controlled_wall(flexible=True)
