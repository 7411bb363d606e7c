"""The answers of all cases without rockeom: closed forms, or Newton and Euler in many digits.

Each function takes the parameters of its case as mpmath numbers and returns its quantities by name.
The second of its arguments is a `Solver`; closed forms do not use it.
"""

from collections.abc import Callable, Mapping

from mpmath import mp, mpf

from benchmarks.reference_cases.newton_euler import (
    Body,
    Row,
    Solver,
    Stage,
    State,
    after_impact,
    at_ground,
    between,
    place,
)

Numbers = Mapping[str, mpf]
ZERO, HALF = mpf(0), mpf(1) / 2
Answer = dict[str, mpf]


# -- a block that rocks: the pendulum upside down ------------------------------------------------


def pivoted(p: Numbers) -> tuple[mpf, mpf]:
    """Slenderness alpha and frequency p of a homogeneous rectangle about its foot."""
    b, h = p["half_width"], p["half_height"]
    return mp.atan(b / h), mp.sqrt(3 * p["gravity"] / (4 * mp.hypot(b, h)))


def fall(start: mpf, end: mpf, p: mpf) -> mpf:
    """Time of phi'' = p^2 sin(phi) from rest at `start` to `end`, both from the balance [s].

    pi - phi is a pendulum of modulus cos(start/2): an elliptic integral of the first kind.
    """
    k = mp.cos(start / 2)
    return (mp.ellipk(k * k) - mp.ellipf(mp.asin(mp.cos(end / 2) / k), k * k)) / p


def speed(start: mpf, end: mpf, p: mpf) -> mpf:
    return p * mp.sqrt(2 * (mp.cos(start) - mp.cos(end)))


def ratio_of_velocities(alpha: mpf) -> mpf:
    """Housner's: the angular momentum about the corner that lands stays."""
    return 1 - 3 * mp.sin(alpha) ** 2 / 2


def free_rocking(alpha: mpf, p: mpf, ratio: mpf, peak: mpf, n: int) -> tuple[list, list]:
    """Times of n impacts, and the speeds before them, after a release from rest."""
    t, times, speeds = ZERO, [], []
    for _ in range(n):
        reach = alpha - peak
        quarter = fall(reach, alpha, p)
        t += quarter
        times.append(t)
        speeds.append(speed(reach, alpha, p))
        peak = alpha - mp.acos(mp.cos(alpha) + (ratio * speeds[-1] / p) ** 2 / 2)
        t += fall(alpha - peak, alpha, p)
    return times, speeds


def free_decay(p: Numbers, _: Solver) -> Answer:
    alpha, frequency = pivoted(p)
    ratio = ratio_of_velocities(alpha)
    times, speeds = free_rocking(alpha, frequency, ratio, p["rotation"], 10)
    return {
        "impact_1_time": times[0],
        "impact_1_rate_before": -speeds[0],
        "impact_1_rate_after": -ratio * speeds[0],
        "impact_5_time": times[4],
        "impact_10_time": times[9],
        "impact_10_rate_after": ratio * speeds[9],
    }


def free_to_rest(p: Numbers, _: Solver) -> Answer:
    """The sum of all impacts; once they are small, the rest of them is a geometric series."""
    small, n = mpf(10) ** (-mp.dps / 2), 1
    with mp.workdps(3 * mp.dps):  # a small peak is a difference of angles
        alpha, frequency = pivoted(p)
        ratio = ratio_of_velocities(alpha)
        while ratio**n > small:
            n += 1
        times, speeds = free_rocking(alpha, frequency, ratio, p["rotation"], n)
    left = 2 * ratio * speeds[-1] / (frequency**2 * mp.sin(alpha)) / (1 - ratio)
    return {
        "impact_1_time": times[0],
        "impact_20_time": times[19],
        "rest_time": times[-1] + left,
    }


def tipped_past_balance(p: Numbers, _: Solver) -> Answer:
    alpha, frequency = pivoted(p)
    start, end = p["rotation"] - alpha, p["end_rotation"] - alpha
    return {
        "fall_time": fall(start, end, frequency),
        "fall_rate": speed(start, end, frequency),
    }


def threshold_pulse(p: Numbers, _: Solver) -> Answer:
    """A constant acceleration turns gravity; at its end the energy is that of the balance."""
    alpha, frequency = pivoted(p)
    g, a = p["gravity"], p["amplitude"]
    turned = mp.atan(a / g)
    left = mp.asin(mp.sin(alpha) - g / a * (1 - mp.cos(alpha)))  # to the balance, at the end
    stronger = frequency * mp.sqrt(mp.hypot(g, a) / g)
    return {
        "threshold_duration": fall(turned - alpha, turned - left, stronger),
        "threshold_rotation": alpha - left,
    }


def rocking_frame(p: Numbers, _: Solver) -> Answer:
    """Two columns that turn alike and a beam that is carried along, by energy and momentum."""
    alpha, single = pivoted(p)
    share = p["beam_mass"] / (2 * p["column_mass"])
    frequency = single * mp.sqrt((1 + 2 * share) / (1 + 3 * share))
    ratio = ratio_of_velocities(alpha) + 3 * share * mp.cos(2 * alpha)
    ratio /= 1 + 3 * share
    times, speeds = free_rocking(alpha, frequency, ratio, p["rotation"], 5)
    return {
        "impact_1_time": times[0],
        "impact_1_rate_before": -speeds[0],
        "impact_1_rate_after": -ratio * speeds[0],
        "impact_5_time": times[4],
    }


# -- a block that slides, falls or bounces -------------------------------------------------------


def threshold_slide(p: Numbers, _: Solver) -> Answer:
    """Under a(t) = jerk t the block slides from friction g on: a cubic."""
    begins = p["friction"] * p["gravity"] / p["jerk"]
    t = p["time"] - begins
    return {
        "slip_begins": begins,
        "displacement": -p["jerk"] * t**3 / 6,
        "velocity": -p["jerk"] * t**2 / 2,
    }


def slide_to_stop(p: Numbers, _: Solver) -> Answer:
    braking = p["friction"] * p["gravity"]
    return {
        "stop_time": p["velocity"] / braking,
        "displacement": p["velocity"] ** 2 / (2 * braking),
    }


def stick_slip(p: Numbers, _: Solver) -> Answer:
    """u'' = -A sin(w t) + friction g while it slides, from where sin(w t) = friction g/A on."""
    a, w, grip = p["amplitude"], 2 * mp.pi / p["period"], p["friction"] * p["gravity"]
    begins = mp.asin(grip / a) / w

    def velocity(t: mpf) -> mpf:
        return a / w * (mp.cos(w * t) - mp.cos(w * begins)) + grip * (t - begins)

    ends = mp.findroot(velocity, (p["period"] * mpf("0.54"), p["period"] * mpf("0.59")))
    t = ends - begins
    slid = a / w**2 * (mp.sin(w * ends) - mp.sin(w * begins))
    slid += -a / w * mp.cos(w * begins) * t + grip * t**2 / 2
    half = p["period"] / 2
    if not ends < begins + half:
        raise ArithmeticError("the block does not stick between its slips")
    return {
        "slip_1_begins": begins,
        "slip_1_ends": ends,
        "displacement_after_slip_1": slid,
        "slip_2_begins": begins + half,
        "slip_2_ends": ends + half,
    }


def bounce(p: Numbers, _: Solver) -> Answer:
    """A ball of no size: a geometric series."""
    e, drop = p["restitution"], mp.sqrt(2 * p["height"] / p["gravity"])
    return {
        "landing_1_time": drop,
        "landing_2_time": drop * (1 + 2 * e),
        "landing_5_time": drop * (1 + 2 * (e - e**5) / (1 - e)),
        "rest_time": drop * (1 + e) / (1 - e),
    }


def drop_on_corner(p: Numbers, _: Solver) -> Answer:
    """Without friction the impulse is upright; between impacts the block is a projectile."""
    b, h, g, e = p["half_width"], p["half_height"], p["gravity"], p["restitution"]
    inertia, turn = p["mass"] * (b * b + h * h) / 3, p["rotation"]

    def lever(side: int, turn: mpf) -> mpf:
        """From the centroid to a lower corner, to the right."""
        return side * b * mp.cos(turn) - h * mp.sin(turn)

    def below(side: int, turn: mpf) -> mpf:
        return side * b * mp.sin(turn) + h * mp.cos(turn)

    def struck(side: int, turn: mpf, v: mpf, spin: mpf) -> tuple[mpf, mpf]:
        arm = lever(side, turn)
        closing = v - arm * spin
        impulse = -(1 + e) * closing / (1 / p["mass"] + arm**2 / inertia)
        return v + impulse / p["mass"], spin - arm * impulse / inertia

    first = mp.sqrt(2 * p["height"] / g)
    z = below(1, turn)  # the height of the centroid
    v, spin = struck(1, turn, -g * first, ZERO)

    def gap(t: mpf) -> mpf:
        return z + v * t - g * t * t / 2 - below(-1, turn + spin * t)

    t, step = ZERO, mpf(1) / 1000
    while gap(t + step) > 0:
        t += step
    flight = mp.findroot(gap, (t, t + step), solver="anderson", tol=mpf(10) ** (4 - 2 * mp.dps))
    v_2, spin_2 = struck(-1, turn + spin * flight, v - g * flight, spin)
    return {
        "landing_1_time": first,
        "rate_after_landing_1": spin,
        "landing_2_time": first + flight,
        "rate_after_landing_2": spin_2,
        "velocity_after_landing_2": v_2,
    }


def frictionless_release(p: Numbers, _: Solver) -> Answer:
    """The centroid falls straight down; the time is a quadrature of the energy."""
    b, h, g, start = p["half_width"], p["half_height"], p["gravity"], p["rotation"]
    square = (b * b + h * h) / 3  # of the radius of gyration

    def slowness(s: mpf) -> mpf:
        if s == 0:
            falling = 2 * g * (b * mp.cos(start) - h * mp.sin(start))
            inertia = square + (b * mp.cos(start) - h * mp.sin(start)) ** 2
            return 2 * mp.sqrt(inertia / falling)
        turn = start - s * s
        rise = b * mp.cos(turn) - h * mp.sin(turn)
        # b (sin(start) - sin(turn)) + h (cos(start) - cos(turn)), without cancellation
        middle, part = start - s * s / 2, mp.sin(s * s / 2)
        drop = 2 * part * (b * mp.cos(middle) - h * mp.sin(middle))
        return 2 * s * mp.sqrt((square + rise * rise) / (2 * g * drop))

    drop = b * mp.sin(start) + h * mp.cos(start) - h
    return {
        "landing_time": mp.quad(slowness, mp.linspace(0, mp.sqrt(start), 5)),
        "rate_before": -mp.sqrt(2 * g * drop / (square + b * b)),
        "slip": h * mp.sin(start) + b * (1 - mp.cos(start)),
    }


def spring_drop(p: Numbers, _: Solver) -> Answer:
    """A fall, half a wave on both springs, and up again to the same height."""
    w = mp.sqrt(2 * p["stiffness"] / p["mass"])
    g = p["gravity"]
    drop = mp.sqrt(2 * p["height"] / g)
    v = g * drop
    pressed = 2 * (mp.pi - mp.atan(v * w / g)) / w
    return {
        "touch_time": drop,
        "lift_off_time": drop + pressed,
        "compression": g / w**2 + mp.hypot(g / w**2, v / w),
        "touch_2_time": 3 * drop + pressed,
    }


# -- Newton and Euler ----------------------------------------------------------------------------


def rectangle(p: Numbers, of: str = "") -> tuple[Body, mpf, mpf]:
    b, h, mass = p[f"{of}half_width"], p[f"{of}half_height"], p[f"{of}mass"]
    return Body(mass, mass * (b * b + h * h) / 3), b, h


def tilted(b: mpf, h: mpf, turn: mpf) -> tuple[mpf, mpf]:
    """The centroid of a rectangle that turned about its right foot, which is at (b, 0)."""
    sine, cosine = mp.sin(turn), mp.cos(turn)
    return b - b * cosine + h * sine, b * sine + h * cosine


def shaken(bodies: list[Body], g: mpf, ground: Callable[[mpf], mpf]) -> Callable[[State], list]:
    """Gravity, and the force of inertia in the frame of the ground."""

    def loads(state: State) -> list:
        a = ground(state.t)
        return [f for body in bodies for f in (-body.mass * a, -body.mass * g, ZERO)]

    return loads


def quiet(t: mpf) -> mpf:
    return ZERO


class RockingBlock:
    """A block that rocks about one foot after the other, without slip or restitution."""

    def __init__(self, p: Numbers, solver: Solver) -> None:
        self.body, self.b, self.h = rectangle(p)
        self.gravity, self.solver = p["gravity"], solver

    def foot(self, side: int) -> list:
        return [side * self.b, -self.h]

    def lifts(self, t: mpf, side: int) -> State:
        """At rest, upright: the state as it begins to turn about a foot."""
        return State(t, [ZERO, self.h, ZERO], [ZERO] * 3)

    def stage(self, side: int, ground: Callable[[mpf], mpf]) -> Stage:
        loads = shaken([self.body], self.gravity, ground)
        return Stage([self.body], loads, lambda state: at_ground(state, 0, self.foot(side)))

    def gap(self, side: int) -> Callable[[State], mpf]:
        """The height of the other foot, as a guard."""
        return lambda state: state.q[1] + place(state, 0, self.foot(-side))[1]

    def impact(self, state: State, side: int) -> State:
        """The other foot lands; the side that was closed opens, which is checked."""
        rows = at_ground(state, 0, self.foot(-side))
        v = after_impact([self.body], rows, state.v)
        if v[2] * side >= 0:
            raise ArithmeticError("the foot that was closed does not open")
        return State(state.t, state.q, v)


def threshold_uplift(p: Numbers, solver: Solver) -> Answer:
    """Under a(t) = jerk t the moment about a foot vanishes at g b/h; it turns to the left."""
    block = RockingBlock(p, solver)
    begins = p["gravity"] * block.b / block.h / p["jerk"]
    stage = block.stage(-1, lambda t: p["jerk"] * t)
    end, _ = solver.until(stage, block.lifts(begins, -1), [], p["time"])
    return {"uplift_time": begins, "rotation": end.q[2], "rate": end.v[2]}


def under_a_sine(p: Numbers, solver: Solver) -> tuple[RockingBlock, State, Callable]:
    """A block as it lifts under a sine of one period, and the motion from there to an event."""
    block = RockingBlock(p, solver)
    w = 2 * mp.pi / p["period"]
    begins = mp.asin(p["gravity"] * block.b / block.h / p["amplitude"]) / w

    def until(state: State, side: int, guards: list, end: mpf) -> tuple[State, int | None]:
        for ground, last in (
            (lambda t: p["amplitude"] * mp.sin(w * t), p["period"]),
            (quiet, mpf(100)),
        ):
            if state.t < min(last, end):
                state, which = solver.until(
                    block.stage(side, ground), state, guards, min(last, end)
                )
                if which is not None:
                    return state, which
        return state, None

    return block, block.lifts(begins, -1), until


def pulse_overturns(p: Numbers, solver: Solver) -> Answer:
    """It lifts to the left, comes back, and falls to the right after one impact."""
    block, state, until = under_a_sine(p, solver)
    lifts = state.t
    top, _ = until(state, -1, [lambda s: -s.v[2]], mpf(10))
    state, _ = until(top, -1, [block.gap(-1)], mpf(10))
    impact = state.t
    state = block.impact(state, -1)
    rate = state.v[2]
    state, _ = until(state, 1, [lambda s: p["end_rotation"] - s.q[2]], mpf(10))
    return {
        "uplift_time": lifts,
        "rotation_peak_1": top.q[2],
        "impact_1_time": impact,
        "impact_1_rate_after": rate,
        "fall_time": state.t,
    }


def pulse_safe_window(p: Numbers, solver: Solver) -> Answer:
    """Beyond the angle of overturning and back: a stronger pulse than one that overturns."""
    block, state, until = under_a_sine(p, solver)
    top, _ = until(state, -1, [lambda s: -s.v[2]], mpf(10))
    answer = {"uplift_time": state.t, "rotation_peak_1": top.q[2]}
    state, _ = until(top, -1, [block.gap(-1)], mpf(10))
    answer["impact_1_time"] = state.t
    state = block.impact(state, -1)
    answer["impact_1_rate_after"] = state.v[2]
    state, _ = until(state, 1, [lambda s: s.v[2]], mpf(10))
    answer["rotation_peak_2"] = state.q[2]
    state, _ = until(state, 1, [block.gap(1)], mpf(10))
    return {**answer, "impact_2_time": state.t}


def slide_and_rock(p: Numbers, solver: Solver) -> Answer:
    """The foot slips to the right while the block comes upright; friction pulls to the left."""
    body, b, h = rectangle(p)
    start = State(ZERO, [*tilted(b, h, p["rotation"]), p["rotation"]], [ZERO] * 3)
    stage = Stage(
        [body],
        shaken([body], p["gravity"], quiet),
        lambda state: at_ground(state, 0, [b, -h], p["friction"]),
    )

    def gap(state: State) -> mpf:
        return state.q[1] + place(state, 0, [-b, -h])[1]

    end, _ = solver.until(stage, start, [gap], mpf(5))
    if stage.solved(end)[1][0] < 0 or end.v[0] + place(end, 0, [b, -h])[1] * end.v[2] < 0:
        raise ArithmeticError("the foot does not press, or does not slip to the right")
    return {
        "landing_time": end.t,
        "rate_before": end.v[2],
        "slip": end.q[0] + place(end, 0, [b, -h])[0] - b,
    }


def stack(p: Numbers) -> tuple[list[Body], State, dict[str, Callable[[State], list]]]:
    """Two blocks, each on its right foot, at rest; and the rows of each contact."""
    (lower, b, h), (upper, b_2, h_2) = rectangle(p, "lower_"), rectangle(p, "upper_")
    turn, turn_2 = p["lower_rotation"], p["upper_rotation"]
    x, z = tilted(b, h, turn)
    start = State(ZERO, [x, z, turn, ZERO, ZERO, turn_2], [ZERO] * 6)
    dx, dz = place(start, 0, [b_2, h])  # the foot of the upper block, on the lower one's top
    ex, ez = place(start, 1, [b_2, -h_2])
    start.q[3], start.q[4] = x + dx - ex, z + dz - ez

    def on_top(side: int) -> Callable[[State], list]:
        def rows(state: State) -> list:
            """Where the corner is now, on the lower block."""
            cx, cz = place(state, 1, [side * b_2, -h_2])
            cx, cz = cx + state.q[3] - state.q[0], cz + state.q[4] - state.q[1]
            sine, cosine = mp.sin(state.q[2]), mp.cos(state.q[2])
            at = [cx * cosine - cz * sine, cx * sine + cz * cosine]
            return between(state, 1, [side * b_2, -h_2], 0, at)

        return rows

    fixed = {
        "left": lambda state: at_ground(state, 0, [-b, -h]),
        "right": lambda state: at_ground(state, 0, [b, -h]),
        "upper_left": on_top(-1),
        "upper_right": lambda state: between(state, 1, [b_2, -h_2], 0, [b_2, h]),
    }
    return [lower, upper], start, fixed


def stack_leans(p: Numbers, solver: Solver) -> Answer:
    """Both turn about their right feet until the lower block comes upright."""
    bodies, start, contacts = stack(p)
    stage = Stage(
        bodies,
        shaken(bodies, p["gravity"], quiet),
        lambda state: [*contacts["right"](state), *contacts["upper_right"](state)],
    )
    end, which = solver.until(stage, start, [lambda s: s.q[2], lambda s: s.q[5] - s.q[2]], mpf(5))
    if which != 0:
        raise ArithmeticError("the upper block lands first")
    v = after_impact(bodies, [*contacts["left"](end), *contacts["upper_right"](end)], end.v)
    state = State(end.t, end.q, v)
    later = _later(p, solver, bodies, state, [contacts["left"], contacts["upper_right"]])
    return {
        **later,
        "landing_time": end.t,
        "lower_rate_before": end.v[2],
        "upper_rotation": end.q[5],
        "upper_rate_before": end.v[5],
        "lower_rate_after": v[2],
        "upper_rate_after": v[5],
    }


def _later(p: Numbers, solver: Solver, bodies: list[Body], state: State, closed: list) -> Answer:
    """Rotations at a time after a landing, which comes before the next; each on its corner."""
    stage = Stage(
        bodies, shaken(bodies, p["gravity"], quiet), lambda s: [row for c in closed for row in c(s)]
    )
    lean = mp.sign(state.q[5] - state.q[2] or state.v[5] - state.v[2])
    gaps = [lambda s: -s.q[2], lambda s: lean * (s.q[5] - s.q[2])]
    end, which = solver.until(stage, state, gaps, p["time"])
    if which is not None:
        raise ArithmeticError("a corner lands before that time")
    return {"lower_rotation_later": end.q[2], "upper_rotation_later": end.q[5]}


def upper_block_rocks(p: Numbers, solver: Solver) -> Answer:
    """The lower block stands until the upper one lands, and is then turned by the impulse."""
    one = {k: p[f"upper_{k}"] for k in ("half_width", "half_height")}
    alpha, frequency = pivoted({**one, "gravity": p["gravity"]})
    reach = alpha - p["upper_rotation"]
    for part in range(9):
        turn = p["upper_rotation"] * part / 8
        _check_that_the_lower_block_stands(p, turn, -speed(reach, alpha - turn, frequency))
    before = speed(reach, alpha, frequency)
    bodies, state, contacts = stack({**p, "lower_rotation": ZERO, "upper_rotation": ZERO})
    # the upper block turns about its right corner
    state.v[3:] = [-before * one["half_height"], -before * one["half_width"], -before]
    rows = [*contacts["left"](state), *contacts["upper_left"](state)]
    v = after_impact(bodies, rows, state.v)
    if v[2] > 0 or v[5] > v[2]:
        raise ArithmeticError("a corner that was closed does not open")
    landing = fall(reach, alpha, frequency)
    corner, at = [-p["upper_half_width"], -p["upper_half_height"]], p["lower_half_height"]
    closed = [
        contacts["left"],
        lambda state: between(state, 1, corner, 0, [-p["upper_half_width"], at]),
    ]
    return {
        **_later(p, solver, bodies, State(landing, state.q, v), closed),
        "landing_time": landing,
        "upper_rate_before": -before,
        "lower_rate_after": v[2],
        "upper_rate_after": v[5],
    }


def _check_that_the_lower_block_stands(p: Numbers, turn: mpf, rate: mpf) -> None:
    """Both its feet press while the upper block turns about its right corner."""
    bodies, state, contacts = stack({**p, "lower_rotation": ZERO, "upper_rotation": turn})
    dx, dz = place(state, 1, [p["upper_half_width"], -p["upper_half_height"]])
    state.v[3:] = [-dz * rate, dx * rate, rate]

    def rows(state: State) -> list[Row]:
        feet = [*contacts["left"](state), contacts["right"](state)[1]]
        return [*feet, *contacts["upper_right"](state)]

    _, reactions = Stage(bodies, shaken(bodies, p["gravity"], quiet), rows).solved(state)
    if min(reactions[1], reactions[2]) < 0:
        raise ArithmeticError("the lower block does not stand")


def flexible_column(p: Numbers, solver: Solver) -> Answer:
    """Base and mass on a foot; the mass slides across the column, on a spring."""
    base, top = Body(p["base_mass"], p["base_inertia"]), Body(p["mass"], p["inertia"])
    b, low, apart = p["half_width"], p["base_height"], p["height"] - p["base_height"]

    def axes(state: State) -> tuple:
        """Across and along the column; from the base to the mass, and how fast."""
        sine, cosine = mp.sin(state.q[2]), mp.cos(state.q[2])
        d = [state.q[3] - state.q[0], state.q[4] - state.q[1]]
        d_dot = [state.v[3] - state.v[0], state.v[4] - state.v[1]]
        return (cosine, -sine), (sine, cosine), d, d_dot

    def guides(state: State) -> list:
        e, n, d, d_dot = axes(state)
        u, turning = mp.fdot(e, d), state.v[2]
        along = [-n[0], -n[1], u, n[0], n[1], ZERO]
        bias = 2 * turning * mp.fdot(e, d_dot) - turning**2 * mp.fdot(n, d)
        alike = [ZERO, ZERO, mpf(-1), ZERO, ZERO, mpf(1)]
        return [Row(along, bias), Row(alike, ZERO)]

    def loads(state: State) -> list:
        e, _, d, _ = axes(state)
        pull = -p["stiffness"] * mp.fdot(e, d)
        x, z = pull * e[0], pull * e[1]
        g = p["gravity"]
        # the force on the base acts at the mass: its moment is about the base's centroid
        return [-x, -z - base.mass * g, z * d[0] - x * d[1], x, z - top.mass * g, ZERO]

    def on(side: int) -> Callable[[State], list]:
        return lambda state: [*at_ground(state, 0, [side * b, -low]), *guides(state)]

    turn = p["rotation"]
    x, z = tilted(b, low, turn)
    e_n = mp.sin(turn), mp.cos(turn)
    state = State(ZERO, [x, z, turn, x + apart * e_n[0], z + apart * e_n[1], turn], [ZERO] * 6)
    answer, side = {}, 1
    for n in (1, 2, 3):
        state, _ = solver.until(
            Stage([base, top], loads, on(side)), state, [lambda s, side=side: side * s.q[2]], mpf(5)
        )
        e, _, d, _ = axes(state)
        answer[f"impact_{n}_time"] = state.t
        answer[f"impact_{n}_deformation"] = mp.fdot(e, d)
        side = -side
        v = after_impact([base, top], on(side)(state), state.v)
        if v[2] * side <= 0:
            raise ArithmeticError("the foot that was closed does not open")
        state = State(state.t, state.q, v)
        answer[f"impact_{n}_rate_after"] = v[2]
    return answer


def two_springs(p: Numbers, solver: Solver) -> Answer:
    """One body, its base's centre guided upright, on springs that press and do not pull."""
    mass = p["mass"] + p["base_mass"]
    low = (p["mass"] * p["height"] + p["base_mass"] * p["base_height"]) / mass
    inertia = p["inertia"] + p["base_inertia"] + p["mass"] * (p["height"] - low) ** 2
    inertia += p["base_mass"] * (low - p["base_height"]) ** 2
    body, b, k, g = Body(mass, inertia), p["half_width"], p["stiffness"], p["gravity"]

    def height(side: int) -> Callable[[State], mpf]:
        return lambda state: state.q[1] + place(state, 0, [side * b, -low])[1]

    def loads(pressed: tuple[int, ...]) -> Callable[[State], list]:
        def forces(state: State) -> list:
            z, moment = -mass * g, ZERO
            for side in pressed:
                force = -k * height(side)(state)
                z += force
                moment -= force * place(state, 0, [side * b, -low])[0]
            return [ZERO, z, moment]

        return forces

    def guide(state: State) -> list:
        return at_ground(state, 0, [ZERO, -low])[:1]

    turn, settled = p["rotation"], -mass * g / (2 * k)
    state = State(ZERO, [low * mp.sin(turn), settled + low * mp.cos(turn), turn], [ZERO] * 3)
    pressed = [side for side in (-1, 1) if height(side)(state) < 0]
    answer, switches = {}, []
    while state.t < p["time"]:
        now = tuple(pressed)
        guards = [
            (lambda s, side=side: -height(side)(s)) if side in now else height(side)
            for side in (-1, 1)
        ]
        state, which = solver.until(Stage([body], loads(now), guide), state, guards, p["time"])
        if which is not None:
            switches.append(state.t)
            side = (-1, 1)[which]
            pressed = [s for s in (-1, 1) if (s in now) != (s == side)]
    for n in (1, 2, 5):
        answer[f"switch_{n}_time"] = switches[n - 1]
    return {**answer, "rotation": state.q[2], "rate": state.v[2]}
