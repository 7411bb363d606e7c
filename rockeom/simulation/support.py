"""Forces and impulses that the ground had to give, and the friction that not sliding needed."""

import math
from collections.abc import Sequence
from functools import cached_property
from typing import Any

import numpy as np

from rockeom.codes import LANDING, NEVER_SLIPS, SLIP_LEFT, SLIP_RIGHT
from rockeom.integrator.schema import GeneratedModule, has_landings, is_by_code, still_ground
from rockeom.numbers.mode_codes import rows_of
from rockeom.simulation.events import EventColumns, Events
from rockeom.simulation.extremes import Extremes, extremes, last_crest
from rockeom.simulation.feet import least_friction
from rockeom.simulation.quantities import Quantities
from rockeom.simulation.steps import Evaluate, Rows, Steps
from rockeom.structures.base import Structure
from rockeom.structures.searched_modes import Points, friction_of

_WHOLE_BASE = ("horizontal_reaction", "transverse_reaction", "vertical_reaction")


class Support:
    """Forces and impulses of the ground, and whether friction and contact could bear them.

    Parameters
    ----------
    quantities : Quantities
        Quantities of the motion.
    events : Events
        Events of the motion.
    rows : Rows
        Samples of the motion.
    overturned : bool
        Whether the motion ends in overturning: the last fall then counts for none of them, from its
        highest point on, since nothing could stop it.
    """

    def __init__(
        self, quantities: Quantities, events: Events, rows: Rows, overturned: bool
    ) -> None:
        self._quantities, self._events, self._rows = quantities, events, rows
        self._overturned = overturned
        self._structure = quantities.structure

    # -- forces

    @cached_property
    def _extremes(self) -> tuple[Extremes, ...] | None:
        """Extremes of the horizontal, left, right and whole vertical force; None without feet."""
        if "left_reaction" not in self._structure.module.REACTIONS:
            return None
        steps = self._quantities.steps("what the feet had to bear (friction_demand, lost_contact)")

        def forces(t: np.ndarray, y: np.ndarray, mode: np.ndarray) -> np.ndarray:
            feet = self._feet(t, y, mode)
            return np.column_stack([feet, feet[:, 1] + feet[:, 2]])

        return tuple(extremes(steps, forces, self._until))

    @property
    def _feet(self) -> Evaluate:
        return self._quantities.columns(("horizontal_reaction", "left_reaction", "right_reaction"))

    @cached_property
    def _until(self) -> float:
        """Time at which the forces on the feet cease to matter [s]."""
        if not self._overturned:
            return math.inf
        steps = self._quantities.steps("the last fall")
        return last_crest(steps, self._quantities.columns(("gravitational_energy",)))

    @cached_property
    def base_moment(self) -> Extremes | None:
        """Extremes of the moment of the ground's forces about the middle of the base [N m].

        The force on the right less that on the left, times the distance at which they act: half the
        distance of the feet, or that of a rotation centre that moves. None unless the structure
        stands on rigid ground and has a `half_width`.
        """
        arm = self._structure.parameters().get("half_width")
        moves = "rotation_centre" in self._quantities.units
        if arm is None or not (moves or self._structure.rocks_on_rigid_ground):
            return None
        names = ("left_reaction", "right_reaction", *("rotation_centre",) * moves)
        forces = self._quantities.columns(names)

        def moment(t: np.ndarray, y: np.ndarray, mode: np.ndarray) -> np.ndarray:
            left, right, *centre = forces(t, y, mode).T
            return ((centre[0] if moves else arm) * (right - left))[:, None]

        return extremes(self._quantities.steps("base_moment"), moment)[0]

    @cached_property
    def lost_contact(self) -> bool:
        """Whether the ground would have had to pull a foot: the model's assumption failed then.

        In space that of the whole base counts, where no feet may open.
        """
        if self._forces_in_space == list(_WHOLE_BASE):
            upwards = self._quantities.columns(_WHOLE_BASE[-1:])
            (whole,) = extremes(self._quantities.steps("lost_contact"), upwards, self._until)
            return bool(whole.minimum < -1e-9 * abs(whole.peak))
        if self._extremes is None:
            return False
        _, left, right, vertical = self._extremes
        weight = max(abs(vertical.peak), 1e-300)
        return bool(min(left.minimum, right.minimum) < -1e-9 * weight)

    # -- friction

    @cached_property
    def friction_demand(self) -> float:
        """Largest ``|horizontal|/vertical`` force that not sliding needed, within the steps too.

        The vertical force is that on both feet together. inf where there was none, but a horizontal
        one: then no friction suffices. NaN without feet. In space it is that of all feet that never
        slip together; `foot_friction_demand` is of single ones. Impulses are in
        `impact_friction_demand`.
        """
        if self._forces_in_space is not None:
            return self._demand_in_space(self._forces_in_space)
        across = getattr(self._structure.module, "HELD_ACROSS", False)
        if self._sliding_points and (self._extremes is None or across):
            return self._demand_of(self._sliding_points)  # without what ties and pushes take
        if self._extremes is None:
            return math.nan
        horizontal, _, _, vertical = self._extremes

        def forces(t: np.ndarray, y: np.ndarray, mode: np.ndarray) -> np.ndarray:
            across, left, right = self._feet(t, y, mode).T
            return np.column_stack([across, left + right])

        return least_coefficient(
            self._quantities.steps("friction_demand"), forces, horizontal, vertical, self._until,
            self._structure.has_landings,
        )  # fmt: skip

    @cached_property
    def impact_friction_demand(self) -> float:
        """Largest ``|horizontal|/vertical`` impulse of the ground at an impact.

        The impulse on both feet together: the gain of momentum of all masses. inf where the ground
        had to pull; 0 without impacts; NaN where no foot meets rigid ground in an impact.
        """
        if not meets_ground(self._structure.module):
            return math.nan
        before, after = self._events.impacts.momenta
        gained, size = after - before, np.hypot.reduce
        # in the smallest impacts of a vibrating structure the difference is rounding
        counts = size(gained) > 1e-9 * np.hypot(size(before), size(after))
        across, up = np.abs(size(gained[:-1]))[counts], gained[-1, counts]
        ratios = np.divide(across, up, out=np.full(len(up), np.inf), where=up > 0.0)
        return float(ratios.max(initial=0.0))

    @cached_property
    def friction_demands(self) -> dict[str, tuple[float, float]]:
        """`friction_demand` and `impact_friction_demand` of each of several surfaces.

        The names are those of the points that rub on it, such as "upper_left+upper_right": of
        forces, and of impulses at landings. Empty for structures whose contacts cannot open and
        slide.
        """
        groups = surfaces(self._structure.module)
        if len(groups) == 1 and self._extremes is not None:
            return dict.fromkeys(groups, (self.friction_demand, self.impact_friction_demand))
        impulses = demands_of_landings(
            self._structure, self._events.columns, self._rows.y, list(groups.values())
        )
        names = getattr(self._structure.module, "POINTS", ())
        return {
            surface: (self._demand_of([names[i] for i in points]), impulse)
            for (surface, points), impulse in zip(groups.items(), impulses, strict=True)
        }

    @property
    def _sliding_points(self) -> tuple[str, ...]:
        """Points that may slide; none where no friction holds any."""
        module = self._structure.module
        if has_landings(module) and friction_of(module, self._structure.vector).any():
            return tuple(module.POINTS)
        return ()

    def _demand_of(self, points: Sequence[str]) -> float:
        columns = self._quantities.columns(
            [f"{name}_{what}" for what in ("friction", "reaction") for name in points]
        )

        def forces(t: np.ndarray, y: np.ndarray, mode: np.ndarray) -> np.ndarray:
            return columns(t, y, mode).reshape(len(t), 2, -1).sum(axis=2)

        steps = self._quantities.steps("friction_demands")
        across, pressing = extremes(steps, forces, self._until)
        return least_coefficient(steps, forces, across, pressing, self._until, True)

    @property
    def _forces_in_space(self) -> list[str] | None:
        """Names of the forces along x, then y, then upwards; None of a structure in the plane.

        Those at the points that never slip, or on the whole base of one without points.
        """
        module: Any = self._structure.module
        if is_by_code(module):
            ways = ("friction_x", "friction_y", "reaction")
            return [f"{name}_{of}" for of in ways for name in self._holding_feet]
        return list(_WHOLE_BASE) if _WHOLE_BASE[1] in module.REACTIONS else None

    def _demand_in_space(self, names: list[str]) -> float:
        """The same of the sums of forces over the points that never slip."""
        if not names:
            return math.nan
        columns = self._quantities.columns(names)

        def forces(t: np.ndarray, y: np.ndarray, mode: np.ndarray) -> np.ndarray:
            along_x, along_y, up = columns(t, y, mode).reshape(len(t), 3, -1).sum(axis=2).T
            return np.column_stack([np.hypot(along_x, along_y), up])

        steps = self._quantities.steps("friction_demand")
        across, pressing = extremes(steps, forces, self._until)
        return least_coefficient(steps, forces, across, pressing, self._until, True)

    @cached_property
    def foot_friction_demand(self) -> float:
        """The least friction coefficient with which no single foot in space would have slid.

        |T|/N of a foot that holds alone; of two on an edge the least for both, however they share
        the force along it; of more that of all together. inf where a foot that is relieved still
        has to hold a force across the edge: it is released, see `Prism`. NaN in the plane.
        """
        feet = self._holding_feet
        if len(feet) < 2:  # all is of a rim
            return self.friction_demand if feet else math.nan
        return least_friction(self._quantities, feet, self._until)

    @property
    def _holding_feet(self) -> list[str]:
        """Feet in space that never slip."""
        module: Any = self._structure.module
        if not is_by_code(module):
            return []
        friction = friction_of(module, self._structure.vector)
        return [n for n, mu in zip(module.POINTS, friction, strict=True) if mu >= NEVER_SLIPS]

    # -- contact

    @cached_property
    def sliding(self) -> np.ndarray:
        """Starts and ends of the spans of time in which a point slides (k, 2) [s].

        Empty where contacts cannot slide.
        """
        module = self._structure.module
        if not has_landings(module):
            return np.empty((0, 2))
        spans, modes = self.spans
        states = rows_of(module.POINT_STATES, modes)
        return spans[((states == SLIP_RIGHT) | (states == SLIP_LEFT)).any(axis=1)]

    @property
    def spans(self) -> tuple[np.ndarray, np.ndarray]:
        """(k, 2) starts and ends [s] of the spans of time between events, and their modes (k,)."""
        times, kinds, _ = self._events.columns
        edges = np.concatenate([self._rows.t[:1], times, self._rows.t[-1:]])
        modes = np.concatenate([self._rows.mode[:1], kinds[:, 2]])
        lasts = edges[1:] > edges[:-1]
        return np.column_stack([edges[:-1], edges[1:]])[lasts], modes[lasts]

    @property
    def never_lifted(self) -> bool:
        """Whether both feet stood on rigid ground all the time."""
        sides = np.array(self._structure.module.SIDES)
        return self._structure.rocks_on_rigid_ground and not sides[self._rows.mode].any()

    # -- in words

    def describe(self) -> str:
        """How far the assumptions of no sliding and no lost contact held, in words.

        Returns
        -------
        str
            Text.
        """
        if not isinstance(self._quantities.record, Steps):
            return (
                "Only samples were kept: the forces that friction and contact had to bear, which "
                "are found within the steps, are not known."
            )
        if is_by_code(self._structure.module):
            return self._describe_in_space()
        if self._sliding_points:
            return self._describe_sliding()
        if self._forces_in_space is not None:
            jumped = f" Its vertical reaction turned negative: {self._structure.pulled}."
            return self._describe_friction() + jumped * self.lost_contact
        if self._extremes is None:
            return "The model has no feet: it says nothing of sliding or contact."
        if self._structure.has_landings:
            return self._describe_sliding()
        text = self._describe_friction()
        if self.lost_contact:
            return f"{text} A foot's vertical reaction turned negative: {self._structure.pulled}."
        return text + " No foot's vertical reaction turned negative."

    def _describe_sliding(self) -> str:
        spans = self.sliding
        slid = np.diff(spans).sum()
        if slid > 1e-12 * self._rows.t[-1]:
            return f"It slid for {slid:.4g} s, the first time at {spans[0, 0]:.4g} s."
        if is_by_code(self._structure.module):
            return f"It did not slide{', but for impacts' * bool(len(self._events.impacts))}."
        demands, module = self.friction_demands, self._structure.module
        bounds = friction_of(module, self._structure.vector)
        for surface, points in surfaces(module).items():
            if demands[surface][1] >= (1.0 - 1e-6) * bounds[[*points]].max() > 0.0:
                return f"It slid in impacts alone: impulses reached the friction at {surface}."
        needed = [
            f"{max(pair):.3g}" + f" at {surface}" * (len(demands) > 1)
            for surface, pair in demands.items()
        ]
        return f"It did not slide: that needed a friction coefficient of {' and '.join(needed)}."

    def _describe_in_space(self) -> str:
        friction = friction_of(self._structure.module, self._structure.vector)
        if ((friction > 0.0) & (friction < NEVER_SLIPS)).any():
            return self._describe_sliding()
        if math.isnan(self.friction_demand):
            return "Its feet have no friction: the ground moves under them."
        alone, one = self.foot_friction_demand, len(self._holding_feet) < 2
        together = f" Both are of all feet together: single ones needed {alone:.3g} under forces."
        if math.isinf(alone):
            together = " Both are of all feet together: none would have held single ones."
        together *= not one
        names, kinds = self._structure.module.MODES, self._events.columns.kinds
        freed = [
            names[after].count("_released") - names[before].count("_released")
            for _, before, after, _ in kinds
        ]
        released = sum(number > 0 for number in freed)
        jammed = "feet that jammed were released, and slid"
        if one:
            jammed = "its rim, which pressed no more and had to hold, was released, and slipped"
        jams = f" {released} times {jammed}." if released else ""
        return self._describe_friction() + together + jams

    def _describe_friction(self) -> str:
        forces, impulses = self.friction_demand, self.impact_friction_demand
        if math.isnan(forces):
            return "The forces on the feet are not finite: they say nothing of sliding."
        if math.isinf(forces):
            text = (
                "No friction coefficient would have kept it from sliding: the ground pressed no "
                "foot while a horizontal force was needed."
            )
        else:
            text = f"Not sliding needed a friction coefficient of at least {forces:.3g}."
        if math.isinf(impulses):
            return text + " None suffices for the impulses at its impacts."
        return text + f" The impulses at its impacts needed {impulses:.3g}." * (impulses > 0)


def meets_ground(module: GeneratedModule) -> bool:
    """Whether feet meet rigid ground in impacts."""
    return has_landings(module) or {"impact", "uplift"} <= {kind for *_, kind in module.TRANSITIONS}


def surfaces(module: GeneratedModule) -> dict[str, tuple[int, ...]]:
    """The points that rub on one surface, by their names joined by "+": numbers of points.

    Points are of one surface where a mode lets them share their friction.
    """
    if not has_landings(module) or is_by_code(module):
        return {}
    first = list(range(len(module.POINTS)))
    for shared in module.SHARED:
        for i, j in enumerate(shared):
            first = [first[j] if f == first[i] else f for f in first]
    groups = [tuple(i for i, f in enumerate(first) if f == one) for one in dict.fromkeys(first)]
    return {"+".join(module.POINTS[i] for i in points): points for points in groups}


def least_coefficient(
    steps: Steps,
    forces: Evaluate,
    across: Extremes,
    pressing: Extremes,
    until: float,
    may_fly: bool,
) -> float:
    """Largest |across|/pressing of two forces, found within the steps.

    forces : gives both (n, 2) at times, states and modes (n,); across, pressing : their
    extremes. until : when they cease to matter [s]. inf where nothing presses, but for a force
    across; 0 for one that flies all the time.
    """
    none = 1e-9 * abs(pressing.peak)  # a smaller force is rounding
    if (may_fly and pressing.peak == 0.0) or abs(across.peak) <= none:
        return 0.0

    def pressing_over_across(t: np.ndarray, y: np.ndarray, mode: np.ndarray) -> np.ndarray:
        along, normal = forces(t, y, mode).T
        ratio = normal / np.maximum(np.abs(along), none)
        ratio[(np.abs(along) <= none) & (np.abs(normal) <= none)] = 1e9  # in flight
        return ratio[:, None]

    # this ratio passes zero smoothly where the other one is infinite
    (ratio,) = extremes(steps, pressing_over_across, until)
    if not math.isfinite(ratio.minimum):
        return math.nan
    return 1.0 / ratio.minimum if ratio.minimum > 1e-9 else math.inf


def demands_of_landings(
    structure: Structure, events: EventColumns, y: np.ndarray, groups: Sequence[tuple[int, ...]]
) -> list[float]:
    """Largest |tangential|/normal impulse at the landings, on the points of each group together.

    Out of M (v+ - v-) = J_N' P_N + J_T' P_T at the closed points. y (n, N) : states of the motion.
    """
    module, p = structure.module, structure.vector
    n = module.N_STATES // 2
    _, kinds, landings = events.of(LANDING)
    largest = [0.0] * len(groups)
    if not (groups and has_landings(module) and len(landings)):
        return largest
    points = Points(module, landings[:, 0], p)
    # besides where the motion goes: at a landing all coordinates may be none, but for rounding
    closed = points.closed_beside(np.fmax.reduce(np.abs(y[:, :n])))
    matrix, forces = np.empty(n * n), np.empty(n)
    for (arriving, leaving), near, normal, along, mode in zip(
        landings, closed, points.normal, points.tangential, kinds[:, 1], strict=True
    ):
        module.free_motion(arriving, p, *still_ground(module), mode, matrix, forces)
        gained = matrix.reshape(n, n) @ (leaving[n:] - arriving[n:])
        rows = np.vstack([normal[near], *along[near]])
        (at,) = np.nonzero(near)
        pressed, rubbed = np.zeros(len(near)), np.zeros(len(near))
        impulses = np.linalg.lstsq(rows.T, gained, rcond=1e-12)[0]
        pressed[at], rubbed[at] = impulses[: len(at)], impulses[len(at) :]
        whole = np.abs(impulses).sum()
        for i, group in enumerate(map(list, groups)):
            across, up = float(rubbed[group].sum()), float(pressed[group].sum())
            if math.hypot(across, up) > 1e-9 * whole:
                largest[i] = max(largest[i], abs(across) / up if up > 0.0 else math.inf)
    return largest
