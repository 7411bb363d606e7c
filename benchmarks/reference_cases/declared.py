"""The twenty motions as data: their parameters, the model in the plane, and the questions asked."""

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field

Parameters = Mapping[str, float]
GRAVITY = {"gravity": 9.81}
STACK = {
    "lower_half_width": 0.3, "lower_half_height": 0.5, "lower_mass": 4.0,
    "upper_half_width": 0.2, "upper_half_height": 0.4, "upper_mass": 2.0, **GRAVITY,
}  # fmt: skip
"""Two blocks on one another."""
UNITS = {
    "half_width": "m", "half_height": "m", "mass": "kg", "gravity": "m/s2", "rotation": "rad",
    "jerk": "m/s3", "time": "s", "friction": "-", "velocity": "m/s", "amplitude": "m/s2",
    "period": "s", "restitution": "-", "height": "m", "stiffness": "N/m", "inertia": "kg m2",
}  # fmt: skip
"""Units of parameters, by the end of their names."""


@dataclass(frozen=True)
class Quantity:
    """A number that is asked for.

    measure : how to read it from a motion, where a motion has it: what, of which body, and where.
    """

    name: str
    unit: str
    meaning: str
    measure: Mapping[str, object] | None = None


@dataclass(frozen=True)
class Case:
    """A motion.

    model : bodies, contacts, springs and ground motion of its parameters; duration [s] : how long
    it is to be followed; derivation : how the answers were found without rockeom; closed : whether
    that is a closed form (roots and quadratures included).
    """

    id: str
    title: str
    description: str
    parameters: Parameters
    model: Callable[[Parameters], dict]
    duration: float
    derivation: str
    closed: bool
    quantities: tuple[Quantity, ...] = field(default=())

    @property
    def function(self) -> str:
        """Name of the functions that compute its answers."""
        return self.id.replace("-", "_")


def unit_of(parameter: str) -> str:
    return next(unit for end, unit in UNITS.items() if parameter.endswith(end))


# -- models --------------------------------------------------------------------------------------


def rectangle(p: Parameters, name: str = "block", of: str = "") -> dict:
    """A homogeneous rectangle that stands at the origin."""
    b, h, mass = p[f"{of}half_width"], p[f"{of}half_height"], p[f"{of}mass"]
    return {
        "name": name, "half_width": b, "half_height": h, "mass": mass,
        "inertia": mass * (b * b + h * h) / 3.0, "x": 0.0, "z": h, "rotation": 0.0,
        "velocity": [0.0, 0.0, 0.0],
    }  # fmt: skip


def leaning(body: dict, rotation: float, foot: tuple[float, float] | None = None) -> dict:
    """A rectangle turned about its lower right corner, which stays where it was, or at a foot."""
    b, h = body["half_width"], body["half_height"]
    x, z = foot or (body["x"] + b, body["z"] - h)
    sine, cosine = math.sin(rotation), math.cos(rotation)
    x, z = x - b * cosine + h * sine, z + b * sine + h * cosine
    return {**body, "x": x, "z": z, "rotation": rotation}


def contact(
    first: str, second: str, friction: float | None = None, restitution: float = 0.0
) -> dict:
    """friction : None where it is large enough to exclude slip."""
    return {"bodies": [first, second], "friction": friction, "restitution": restitution}


def plane(p: Parameters, bodies: list[dict], contacts: list[dict], **more: object) -> dict:
    whole = {"gravity": p["gravity"], "bodies": bodies, "contacts": contacts}
    return {**whole, "springs": [], "guides": [], "ground_motion": None, **more}


def ramp(p: Parameters) -> dict:
    return {"formula": "a(t) = jerk t", "kind": "polynomial", "coefficients": [0.0, p["jerk"]]}


def sine(p: Parameters, end: float | None) -> dict:
    until = "" if end is None else " for t < period, 0 later"
    return {
        "formula": f"a(t) = amplitude sin(2 pi t/period){until}", "kind": "sine",
        "amplitude": p["amplitude"], "angular_frequency": 2 * math.pi / p["period"], "end": end,
    }  # fmt: skip


def one_block(p: Parameters, turned: float = 0.0, **more: object) -> dict:
    friction, restitution = p.get("friction"), p.get("restitution", 0.0)
    touching = contact("block", "ground", friction, restitution)
    return plane(p, [leaning(rectangle(p), turned)], [touching], **more)


def released(p: Parameters) -> dict:
    return one_block(p, p["rotation"])


def under_a_ramp(p: Parameters) -> dict:
    return one_block(p, ground_motion=ramp(p))


def under_a_pulse(p: Parameters) -> dict:
    return one_block(p, ground_motion=sine(p, p["period"]))


def under_a_harmonic(p: Parameters) -> dict:
    return one_block(p, ground_motion=sine(p, None))


def under_a_rectangle(p: Parameters) -> dict:
    pulse = {
        "formula": "a(t) = -amplitude for t < duration, 0 later; the duration is asked for",
        "kind": "polynomial", "coefficients": [-p["amplitude"]],
    }  # fmt: skip
    return one_block(p, ground_motion=pulse)


def pushed(p: Parameters) -> dict:
    model = one_block(p)
    model["bodies"][0]["velocity"][0] = p["velocity"]
    return model


def dropped(p: Parameters) -> dict:
    """Its lowest corner is `height` above the ground."""
    model = one_block(p, p.get("rotation", 0.0))
    model["bodies"][0]["z"] += p["height"]
    return model


def stacked(p: Parameters) -> dict:
    lower = leaning(rectangle(p, "lower", "lower_"), p["lower_rotation"])
    b, h, turn = p["upper_half_width"], p["lower_half_height"], p["lower_rotation"]
    foot = (
        lower["x"] + b * math.cos(turn) + h * math.sin(turn),
        lower["z"] - b * math.sin(turn) + h * math.cos(turn),
    )
    upper = leaning(rectangle(p, "upper", "upper_"), p["upper_rotation"], foot)
    touching = [contact("lower", "ground"), contact("upper", "lower")]
    return plane(p, [lower, upper], touching)


def on_standing_lower(p: Parameters) -> dict:
    return stacked({**p, "lower_rotation": 0.0})


def frame(p: Parameters) -> dict:
    """Two columns apart by six widths, and a beam on their tops."""
    b, h = p["half_width"], p["half_height"]
    column = {k: p[k] for k in ("half_width", "half_height")} | {"mass": p["column_mass"]}
    beam = {"half_width": 8 * b, "half_height": h / 4, "mass": p["beam_mass"]}
    bodies = []
    for name, x in (("left", -6 * b), ("right", 6 * b)):
        one = rectangle(column, name)
        bodies.append(leaning({**one, "x": x}, p["rotation"]))
    shift = 2 * h * math.sin(p["rotation"]) + 2 * b * (1 - math.cos(p["rotation"]))
    rise = 2 * h * math.cos(p["rotation"]) + 2 * b * math.sin(p["rotation"])
    above = rectangle(beam, "beam")
    bodies.append({**above, "x": shift, "z": above["z"] + rise})
    touching = [contact(name, "ground") for name in ("left", "right")]
    touching += [contact(name, "beam") for name in ("left", "right")]
    return plane(p, bodies, touching)


def column(p: Parameters) -> dict:
    """Base and mass, each with its own centroid on the axis of the column."""
    turn, b = p["rotation"], p["half_width"]
    low, high = p["base_height"], p["height"]
    base = {
        "name": "base", "half_width": b, "half_height": low, "mass": p["base_mass"],
        "inertia": p["base_inertia"], "x": 0.0, "z": low, "rotation": 0.0,
        "velocity": [0.0, 0.0, 0.0],
    }  # fmt: skip
    base = leaning(base, turn)
    top = {
        **base, "name": "mass", "half_width": 0.0, "half_height": 0.0, "mass": p["mass"],
        "inertia": p["inertia"], "x": base["x"] + (high - low) * math.sin(turn),
        "z": base["z"] + (high - low) * math.cos(turn),
    }  # fmt: skip
    spring = {"bodies": ["mass", "base"], "axis": "x of the base", "stiffness": p["stiffness"],
              "tension": True}  # fmt: skip
    guide = "the mass moves along the x of the base and turns with it"
    touching = [contact("base", "ground")]
    return plane(p, [base, top], touching, springs=[spring], guides=[guide])


def on_springs(p: Parameters) -> dict:
    """One rigid body on springs under its corners, which press and do not pull."""
    turn, b, k = p.get("rotation", 0.0), p["half_width"], p["stiffness"]
    mass = p["mass"] + p["base_mass"]
    low = (p["mass"] * p["height"] + p["base_mass"] * p["base_height"]) / mass
    inertia = p["inertia"] + p["base_inertia"] + p["mass"] * (p["height"] - low) ** 2
    inertia += p["base_mass"] * (low - p["base_height"]) ** 2
    settled = -mass * p["gravity"] / (2 * k)
    body = {
        "name": "block", "half_width": b, "half_height": low, "mass": mass, "inertia": inertia,
        "x": low * math.sin(turn), "z": settled + low * math.cos(turn), "rotation": turn,
        "velocity": [0.0, 0.0, 0.0],
    }  # fmt: skip
    return plane(p, [body], [], springs=_feet(b, low, k), guides=[GUIDE])


def above_springs(p: Parameters) -> dict:
    body = rectangle(p)
    body["z"] += p["height"]
    springs = _feet(p["half_width"], p["half_height"], p["stiffness"])
    return plane(p, [body], [], springs=springs, guides=[GUIDE])


GUIDE = "the middle of the base moves straight up and down"


def _feet(b: float, low: float, k: float) -> list[dict]:
    return [
        {"bodies": ["block", "ground"], "point": [side * b, -low], "axis": "z of the ground",
         "stiffness": k, "tension": False}
        for side in (-1, 1)
    ]  # fmt: skip


# -- quantities ----------------------------------------------------------------------------------


def time(name: str, meaning: str, **measure: object) -> Quantity:
    return Quantity(name, "s", meaning, measure or None)


def rate(name: str, meaning: str, **measure: object) -> Quantity:
    return Quantity(name, "rad/s", meaning, measure or None)


def turned_by(name: str, meaning: str, **measure: object) -> Quantity:
    return Quantity(name, "rad", meaning, measure or None)


def length(name: str, meaning: str, **measure: object) -> Quantity:
    return Quantity(name, "m", meaning, measure or None)


def both_turned_at(time: float) -> list[Quantity]:
    """Rotations of the two blocks of a stack at a time."""
    return [
        turned_by(
            f"{body}_rotation_later", f"of the {body} block at `time`", what="rotation", body=body,
            time=time,
        )
        for body in ("lower", "upper")
    ]  # fmt: skip


def impacts(*asked: tuple[int, str], body: str = "block") -> tuple[Quantity, ...]:
    """Times and rates of impacts, each the n-th time that the rotation passes through zero."""
    kinds = {
        "time": lambda n: time(
            f"impact_{n}_time", f"of impact {n}", what="zero_of_rotation", body=body, n=n
        ),
        "before": lambda n: rate(
            f"impact_{n}_rate_before", f"angular velocity just before impact {n}",
            what="rate_before_zero", body=body, n=n,
        ),
        "after": lambda n: rate(
            f"impact_{n}_rate_after", f"angular velocity just after impact {n}"
        ),
    }  # fmt: skip
    return tuple(kinds[kind](n) for n, kind in asked)


BLOCK = {"half_width": 0.25, "half_height": 1.0, "mass": 1.0, **GRAVITY}
ELLIPTIC = (
    "Between impacts the block is a pendulum upside down: times are elliptic integrals of the "
    "first kind, speeds follow from the energy, and at an impact the angular momentum about the "
    "corner that lands stays."
)
NEWTON = (
    "Newton and Euler's equations of each body with unknown reactions, in arithmetic of 30 digits "
    "and once more of 40, extrapolated to order 24."
)

CASES = (
    Case(
        "free-decay", "Free block, ten impacts",
        "A slender block is let go and rocks from foot to foot. Each impact loses the energy that "
        "Housner (1963) gives, because the foot that lands neither slips nor bounces.",
        {"half_width": 0.095, "half_height": 0.45, "mass": 1.0, **GRAVITY, "rotation": 0.1},
        released, 4.5, ELLIPTIC, True,
        impacts((1, "time"), (1, "before"), (1, "after"), (5, "time"), (10, "time"), (10, "after")),
    ),
    Case(
        "free-to-rest", "Free block until it rests",
        "Infinitely many impacts in a finite time. A program that counts them needs an end.",
        {"half_width": 0.3, "half_height": 1.0, "mass": 1.0, **GRAVITY, "rotation": 0.15},
        released, 6.0,
        ELLIPTIC + " The times are summed; small impacts are a geometric series.", True,
        (*impacts((1, "time"), (20, "time")), time("rest_time", "at which the impacts end")),
    ),
    Case(
        "tipped-past-balance", "Box that was tipped past its balance",
        "A box of 30 mm x 135 mm on its lower right edge, 0.021 rad beyond the balance. It must "
        "fall on its side; a contact that holds it there is wrong.",
        {"half_width": 0.015, "half_height": 0.0675, "mass": 0.3, **GRAVITY, "rotation": 0.24,
         "end_rotation": 0.8},
        released, 0.6, "The pendulum upside down, from rest: an elliptic integral.", True,
        (
            time("fall_time", "at which it has turned by `end_rotation`", what="time_of_rotation",
                 body="block", rotation=0.8),
            rate("fall_rate", "angular velocity then", what="rate_at_rotation", body="block",
                 rotation=0.8),
        ),
    ),
    Case(
        "threshold-uplift", "Uplift under a growing acceleration",
        "The ground's acceleration grows until the block lifts a foot, at gravity times half_width "
        "over half_height, and turns.",
        {**BLOCK, "jerk": 5.0, "time": 0.9}, under_a_ramp, 0.95,
        "The moment about the foot vanishes. From there: " + NEWTON, False,
        (
            turned_by("rotation", "at `time`", what="rotation", body="block", time=0.9),
            rate("rate", "angular velocity at `time`", what="rate", body="block", time=0.9),
            time("uplift_time", "at which a foot lifts"),
        ),
    ),
    Case(
        "threshold-slide", "Slip under a growing acceleration",
        "The ground's acceleration grows until the block slides, at friction times gravity.",
        {"half_width": 0.3, "half_height": 0.2, "mass": 1.0, **GRAVITY, "friction": 0.2,
         "jerk": 4.0, "time": 0.9},
        under_a_ramp, 0.95, "Coulomb's friction as the only force: a cubic in time.", True,
        (
            length("displacement", "at `time`", what="x", body="block", time=0.9),
            Quantity("velocity", "m/s", "at `time`",
                     {"what": "x_rate", "body": "block", "time": 0.9}),
            time("slip_begins", "at which it slips"),
        ),
    ),
    Case(
        "slide-to-stop", "Block that slides to a stop",
        "A low block with a horizontal velocity. It must not tip, and must stop.",
        {"half_width": 0.3, "half_height": 0.2, "mass": 1.0, **GRAVITY, "friction": 0.3,
         "velocity": 1.5},
        pushed, 0.7, "Constant deceleration by Coulomb's friction.", True,
        (
            length("displacement", "until it stops", what="x", body="block", time=0.7),
            time("stop_time", "at which it stops"),
        ),
    ),
    Case(
        "stick-slip", "Stick and slip under a harmonic ground motion",
        "Friction holds the block for part of each half period.",
        {"half_width": 0.3, "half_height": 0.2, "mass": 1.0, **GRAVITY, "friction": 0.3,
         "amplitude": 5.0, "period": 1.0},
        under_a_harmonic, 1.2,
        "Coulomb's friction and the sine, integrated by hand; the end of a slip is a root.", True,
        (
            length("displacement_after_slip_1", "between the first two slips", what="x",
                   body="block", time=0.583),
            time("slip_1_begins", "at which the first slip begins"),
            time("slip_1_ends", "at which it ends"),
            time("slip_2_begins", "at which the second slip begins"),
            time("slip_2_ends", "at which it ends"),
        ),
    ),
    Case(
        "bounce", "Block that is dropped flat and bounces",
        "Both corners land at once and the block does not turn: a ball with a restitution, which "
        "comes to rest after infinitely many landings.",
        {"half_width": 0.3, "half_height": 0.2, "mass": 1.0, **GRAVITY, "friction": 0.0,
         "restitution": 0.7, "height": 0.5},
        dropped, 1.9, "Free falls and a geometric series.", True,
        (
            *(time(f"landing_{n}_time", f"of landing {n}", what="landing", body="block", n=n)
              for n in (1, 2, 5)),
            time("rest_time", "at which the landings end"),
        ),
    ),
    Case(
        "drop-on-corner", "Block that is dropped on a corner and bounces to the other",
        "Without friction each impulse is upright; one corner lands, later the other.",
        {"half_width": 0.3, "half_height": 0.2, "mass": 1.0, **GRAVITY, "friction": 0.0,
         "restitution": 0.7, "height": 0.45, "rotation": 0.2},
        dropped, 0.35,
        "Impulse and angular impulse at one corner; a projectile in between, whose landing is a "
        "root.", True,
        (
            time("landing_1_time", "of the right corner", what="landing", body="block", n=1),
            rate("rate_after_landing_1", "angular velocity after it", what="rate", body="block",
                 time=0.318),
            time("landing_2_time", "of the left corner", what="landing", body="block", n=2),
            rate("rate_after_landing_2", "angular velocity after it", what="rate", body="block",
                 time=0.345),
            Quantity("velocity_after_landing_2", "m/s", "upward, of the centroid, after it"),
        ),
    ),
    Case(
        "pulse-overturns", "Block that one sine overturns",
        "It lifts, comes back, and falls to the other side after one impact.",
        {**BLOCK, "amplitude": 7.0, "period": 0.7, "end_rotation": 0.8}, under_a_pulse, 2.5,
        NEWTON, False,
        (
            *impacts((1, "time"), (1, "after")),
            turned_by("rotation_peak_1", "largest to the left", what="peak", body="block", sign=-1),
            time("fall_time", "at which it has turned by `end_rotation`", what="time_of_rotation",
                 body="block", rotation=0.8),
            time("uplift_time", "at which a foot lifts"),
        ),
    ),
    Case(
        "pulse-safe-window", "Block that a stronger sine does not overturn",
        "At 1.45 times the amplitude that overturned it the block turns beyond its angle of "
        "overturning, and the pulse brings it back. It rocks on.",
        {**BLOCK, "amplitude": 10.15, "period": 0.7}, under_a_pulse, 4.0,
        NEWTON, False,
        (
            *impacts((1, "time"), (1, "after"), (2, "time")),
            turned_by("rotation_peak_1", "largest to the left", what="peak", body="block", sign=-1),
            turned_by("rotation_peak_2", "the next, to the right", what="peak", body="block",
                      sign=1),
            time("uplift_time", "at which a foot lifts"),
        ),
    ),
    Case(
        "threshold-pulse", "Shortest rectangular pulse that overturns",
        "A constant acceleration for a while; the shortest that overturns without an impact leaves "
        "the block on its way to the balance, which it would reach after infinite time.",
        {**BLOCK, "amplitude": 4.0}, under_a_rectangle, 4.0,
        "A constant acceleration turns gravity, so that the duration is an elliptic integral; its "
        "end follows from the energy of the balance.", True,
        (
            time("threshold_duration", "of the pulse", what="threshold_duration", body="block",
                 between=[0.3, 0.6]),
            turned_by("threshold_rotation", "at the end of that pulse"),
        ),
    ),
    Case(
        "slide-and-rock", "Tilted block whose foot slips",
        "The friction is too small for the foot to stay: it slips while the block comes upright.",
        {"half_width": 0.2, "half_height": 0.4, "mass": 1.0, **GRAVITY, "friction": 0.15,
         "rotation": 0.2},
        released, 0.25, NEWTON, False,
        (
            time("landing_time", "at which it is upright", what="zero_of_rotation", body="block",
                 n=1),
            rate("rate_before", "angular velocity just before", what="rate_before_zero",
                 body="block", n=1),
            length("slip", "of the foot until then"),
        ),
    ),
    Case(
        "frictionless-release", "Tilted block on a frictionless ground",
        "Nothing pushes sideways: the centroid falls straight down while the foot runs away.",
        {"half_width": 0.2, "half_height": 0.4, "mass": 1.0, **GRAVITY, "friction": 0.0,
         "rotation": 0.2},
        released, 0.2, "Energy; the time is a quadrature.", True,
        (
            time("landing_time", "at which it is upright", what="zero_of_rotation", body="block",
                 n=1),
            rate("rate_before", "angular velocity just before", what="rate_before_zero",
                 body="block", n=1),
            length("slip", "of the foot until then"),
        ),
    ),
    Case(
        "stack-leans", "Two blocks on one another, both leaning",
        "Both turn about their right feet, each at its own rate, until the lower one is upright "
        "and its left foot lands, which strikes both.",
        {**STACK, "lower_rotation": 0.05, "upper_rotation": 0.12, "time": 0.24},
        stacked, 0.25, NEWTON, False,
        (
            time("landing_time", "of the lower block's left foot", what="zero_of_rotation",
                 body="lower", n=1),
            rate("lower_rate_before", "of the lower block", what="rate_before_zero", body="lower",
                 n=1),
            *both_turned_at(0.24),
            rate("lower_rate_after", "of the lower block"),
            rate("upper_rate_before", "of the upper block"),
            rate("upper_rate_after", "of the upper block"),
            turned_by("upper_rotation", "of the upper block, then"),
        ),
    ),
    Case(
        "upper-block-rocks", "Two blocks on one another, the upper one leaning",
        "The lower block stands still until the upper one lands, and lifts its right foot then.",
        {**STACK, "upper_rotation": 0.1, "time": 0.215},
        on_standing_lower, 0.22,
        "An elliptic integral up to the landing, impulses of Newton and Euler in it, and then: "
        + NEWTON, False,
        (
            time("landing_time", "of the upper block's left corner", what="zero_of_rotation",
                 body="upper", n=1),
            rate("upper_rate_before", "of the upper block", what="rate_before_zero", body="upper",
                 n=1),
            *both_turned_at(0.215),
            rate("upper_rate_after", "of the upper block"),
            rate("lower_rate_after", "of the lower block"),
        ),
    ),
    Case(
        "flexible-column", "Elastic column on a rocking base",
        "A mass on an elastic column, whose base rocks from foot to foot. The spring passes no "
        "impulse on, so that an impact changes both rates.",
        {"mass": 122.6, "height": 1.05, "inertia": 44.8, "base_mass": 45.6, "base_height": 0.1,
         "base_inertia": 1.37, "half_width": 0.285, "stiffness": 571800.0, **GRAVITY,
         "rotation": 0.05},
        column, 0.9, NEWTON, False,
        tuple(
            q
            for n in (1, 2, 3)
            for q in (
                time(f"impact_{n}_time", f"of impact {n}", what="zero_of_rotation", body="base",
                     n=n),
                length(f"impact_{n}_deformation", "of the column, then"),
                rate(f"impact_{n}_rate_after", "angular velocity of the base after it"),
            )
        ),
    ),
    Case(
        "rocking-frame", "Two columns and a beam on them",
        "Columns that are joined neither to the ground nor to the beam turn alike; the beam stays "
        "level. It rocks as a single larger block (Makris and Vassiliou 2013).",
        {"half_width": 0.1, "half_height": 0.5, "column_mass": 1.0, "beam_mass": 3.0, **GRAVITY,
         "rotation": 0.1},
        frame, 3.0, ELLIPTIC, True,
        impacts((1, "time"), (1, "before"), (1, "after"), (5, "time"), body="left"),
    ),
    Case(
        "two-springs", "Structure on two springs that do not pull",
        "It is tilted and let go, its base's centre guided upright; both feet leave their springs.",
        {"mass": 122.6, "height": 1.05, "inertia": 44.8, "base_mass": 45.6, "base_height": 0.1,
         "base_inertia": 1.37, "half_width": 0.285, "stiffness": 500000.0, **GRAVITY,
         "rotation": 0.05, "time": 0.5},
        on_springs, 0.5, NEWTON, False,
        (
            turned_by("rotation", "at `time`", what="rotation", body="block", time=0.5),
            rate("rate", "angular velocity at `time`", what="rate", body="block", time=0.5),
            *(time(f"switch_{n}_time", f"of the {n}. opening or closing of a foot")
              for n in (1, 2, 5)),
        ),
    ),
    Case(
        "spring-drop", "Block that is dropped on two springs",
        "It falls, presses both springs, and leaves them at the speed with which it came.",
        {"half_width": 0.3, "half_height": 0.5, "mass": 100.0, **GRAVITY, "stiffness": 250000.0,
         "height": 0.05},
        above_springs, 0.4, "A fall and half a wave of an oscillator.", True,
        (
            length("compression", "the largest", what="lowest", body="block", height=0.5),
            time("touch_time", "at which the springs are touched"),
            time("lift_off_time", "at which they are left"),
            time("touch_2_time", "at which they are touched again"),
        ),
    ),
)  # fmt: skip
