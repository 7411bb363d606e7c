"""The integration loop: one text for every structure and method.

This file is not imported. `rockeom.numeric.specialise` joins it to a generated module (which
defines rates, guards, jump, opening_acceleration and the tables) and to the text of a step
(take_step, dense_output), so that the compiler sees one self-contained program.

It reads in the order of the work: settle what is due, step, find the first event, land on it,
jump, go on.
"""

# Outcomes, numbered as in rockeom.numeric.response.Outcome
COMPLETED, CAME_TO_REST, OVERTURNED, TOO_MANY_IMPACTS, STALLED, CHATTER, NOT_FINITE = range(7)
FULL = 7  # no outcome: the records must be emptied before the loop goes on

# Columns of the record of events
IMPACT, UPLIFT, SWITCH, REST = range(4)

_entry = njit(cache=True, error_model="numpy", nogil=True)

EPS = 2.220446049250313e-16
NEVER = 2.0  # a place behind the end of any step


@_compiled
def ground(row, t):
    """Ground acceleration at t by the law in a row of a motion's table."""
    kind = row[2]
    tau = t - row[0]
    if kind == 0.0:  # linear
        return row[3] + row[4] * tau
    if kind == 1.0:  # sine
        return row[3] * math.sin(row[4] * tau + row[5])
    x = row[4] * (tau - row[5])
    if kind == 2.0:  # symmetric Ricker
        return row[3] * (1.0 - 2.0 * x * x) * math.exp(-x * x)
    return row[3] * x * (x * x - 3.0) * math.exp(-0.5 * x * x)


@_compiled
def row_at(table, n, t, quiet):
    """(n, row) of a motion's table that holds at t and after it, from row n on; quiet behind it."""
    while n < table.shape[0] and t >= table[n, 1]:
        n += 1
    return n, (table[n] if n < table.shape[0] else quiet)


# -- first fall of a guard through zero ----------------------------------------------------------


@_compiled
def bernstein_at(b, x, w):
    """Value of the polynomial with Bernstein coefficients b[:8], by de Casteljau in w (8,)."""
    for i in range(8):
        w[i] = b[i]
    for n in range(7, 0, -1):
        for i in range(n):
            w[i] += x * (w[i + 1] - w[i])
    return w[0]


@_compiled
def first_fall(b, touching, noise, stack):
    """Smallest x in (0, 1] at which a polynomial falls through zero, or NEVER.

    b (8,) Bernstein coefficients on [0, 1]. Its coefficients bound a polynomial, and the number
    of their changes of sign bounds that of its roots: a part without change has no root, a part
    with one has one, other parts are halved. So no pair of roots is stepped over.

    touching : the guard was closed at x = 0 (an event was just there); that root is no other event.
    noise : beside x = 0 coefficients below it are rounding errors.
    stack (64, 10) : scratch, a row holds the coefficients of a part, its start and its width.
    """
    scale = size(b)
    if scale == 0.0:
        return NEVER
    opening = max(8.0 * EPS * scale, noise)
    noise = 8.0 * EPS * scale
    for i in range(8):
        stack[0, i] = b[i]
    if touching:
        stack[0, 0] = 0.0
    stack[0, 8], stack[0, 9] = 0.0, 1.0
    before = -1 if b[0] < -noise and not touching else 1  # sign before a part
    depth = 0
    while depth >= 0:
        part, upper = stack[depth], stack[depth + 1]
        start, width = part[8], part[9]
        negligible = opening if start == 0.0 else noise
        changes = 0
        first = sign = 0
        for i in range(8):
            if abs(part[i]) > negligible:
                new = 1 if part[i] > 0.0 else -1
                if sign == 0:
                    first = new
                elif new != sign:
                    changes += 1
                sign = new
        if first < 0 and before > 0:
            return start  # it falls exactly where this part begins
        if changes == 0:
            before = sign if sign != 0 else before
            depth -= 1
        elif changes == 1 or width < 1e-13:
            if first > 0:
                return start + width * fall(part, upper)
            before = sign  # begins below zero and rises
            depth -= 1
        else:
            # halve: de Casteljau gives both halves at once; the lower one is looked at first
            for n in range(7, -1, -1):
                upper[7 - n] = part[0]
                for i in range(n):
                    part[i] = 0.5 * (part[i] + part[i + 1])
            upper[8], upper[9] = start, 0.5 * width
            part[8], part[9] = start + 0.5 * width, 0.5 * width
            depth += 1
    return NEVER if before > 0 or b[0] >= -noise else 0.0  # 0: below zero all along


@_compiled
def size(b):
    largest = 0.0
    for i in range(8):
        largest = max(largest, abs(b[i]))
    return largest


@_compiled
def fall(b, w):
    """The single fall through zero on [0, 1], by bisection sped up by false position."""
    low, high = 0.0, 1.0
    at_low, at_high = b[0], b[7]
    for n in range(200):
        if high - low <= 2.0 * EPS:
            break
        x = 0.5 * (low + high)
        if n % 2 == 0 and at_low > 0.0 > at_high:
            x = low + (high - low) * at_low / (at_low - at_high)
            x = min(max(x, low + 0.01 * (high - low)), high - 0.01 * (high - low))
        value = bernstein_at(b, x, w)
        if value > 0.0:
            low, at_low = x, value
        else:
            high, at_high = x, value
        if value == 0.0:
            return x
    return high


@_compiled
def dense_at(coefficients, x, out):
    """States at x in [0, 1] of a step from its dense output (8, N), into out (N,)."""
    for i in range(N_STATES):
        value = coefficients[7, i]
        for j in range(6, -1, -1):
            value = value * x + coefficients[j, i]
        out[i] = value


@_compiled
def stays_open(contact, h, y, y_new, k, touching):
    """Whether the gap of a rocking phase clearly stays open in a step, without dense output.

    The quintic through rotation, rate and acceleration at both ends, in Bernstein form: where all
    coefficients are positive by a margin far above its error, there is no root.
    """
    if GUARDS[contact] != 1 or KINDS[contact][0] != IMPACT:
        return False
    side = SIDES[contact]
    q0, q1 = side * y[ROTATION], side * y_new[ROTATION]
    v0, v1 = side * h * y[ROTATION_RATE] / 5.0, side * h * y_new[ROTATION_RATE] / 5.0
    a0 = side * h * h * k[0, ROTATION_RATE] / 20.0
    a1 = side * h * h * k[N_STAGES, ROTATION_RATE] / 20.0
    b1, b2, b3, b4 = q0 + v0, q0 + 2.0 * v0 + a0, q1 - 2.0 * v1 + a1, q1 - v1
    least = 1e-3 * max(q0, q1)
    return (
        (q0 > least or touching == 0)
        and b1 > least
        and b2 > least
        and b3 > least
        and (b4 > least and q1 > least)
    )


@_compiled
def guard_polynomials(contact, t, h, p, gx, gy, coefficients, w, g, b):
    """Bernstein coefficients of all guards over the step of the dense output, into b (m, 8)."""
    n_guards = GUARDS[contact]
    for n in range(n_guards):
        for i in range(8):
            b[n, i] = 0.0
    sampled = False
    for n in range(n_guards):
        if KINDS[contact][n] == IMPACT:
            # an impact's guard is the rotation, on its side: exactly the dense output
            side = SIDES[contact]
            for i in range(8):
                for j in range(i + 1):
                    b[n, i] += POWERS_TO_BERNSTEIN[i, j] * side * coefficients[j, ROTATION]
        else:
            sampled = True
    if not sampled:
        return
    for m in range(8):
        dense_at(coefficients, NODES[m], w)
        tau = t + NODES[m] * h
        guards(contact, w, p, ground(gx, tau), ground(gy, tau), g)
        for n in range(n_guards):
            if KINDS[contact][n] != IMPACT:
                for i in range(8):
                    b[n, i] += SAMPLES_TO_BERNSTEIN[i, m] * g[n]


@_compiled
def rounding(contact, index, h, y, p, gx, gy, t, b):
    """Size of the rounding errors of a guard that opens from closed.

    A gap that opens without speed grows with the third power of time out of accelerations that
    cancel: what is left of them by rounding acts over the whole step.
    """
    scale = size(b)
    if KINDS[contact][index] != IMPACT:
        return 1e-8 * scale
    ax, ay = ground(gx, t), ground(gy, t)
    acceleration = 0.0
    for other in range(len(SIDES)):
        if SIDES[other] != 0.0:
            acceleration += abs(opening_acceleration(other, y, p, ax, ay))
    return max(1e-11 * scale, 1e-10 * acceleration * h * h)


# -- infinitely many impacts ---------------------------------------------------------------------


@_compiled
def time_to_rest(contact, y, p, law, ratio, ax, ay, tolerance, w, out):
    """(time, contact): when the infinitely many impacts to come will all have happened.

    Close to the end of a free rocking motion the flights between impacts are parabolas: a flight
    that leaves with gap rate v under the closing acceleration a lasts 2 v / a, and the impact
    map gives the v of the next. Their sum converges. Returns (inf, contact) while it is longer
    than `tolerance` in units of 1/sqrt(a), or while an acceleration opens the gap. `out` gets
    the state of the limit.
    """
    for i in range(N_STATES):
        w[i] = y[i]
    total = 0.0
    start = abs(y[ROTATION_RATE])
    loss = 1.0
    for turn in range(1000):
        rates(contact, w, p, ax, ay, out)
        a = -SIDES[contact] * out[ROTATION_RATE]
        if not a > 0.0:
            return np.inf, contact
        v = abs(w[ROTATION_RATE])
        flight = 2.0 * v / a
        total += flight
        if total > tolerance / math.sqrt(a):
            return np.inf, contact
        for i in range(N_STATES):
            w[i] += flight * out[i]
        w[ROTATION] = 0.0
        if v <= EPS * start or turn == 999:
            total += flight * (1.0 - loss) / loss  # what a constant loss leaves of the series
            w[ROTATION_RATE] = 0.0
        contact = jump(contact, 0, law, ratio, w, p, out)
        if SIDES[contact] == 0.0:
            return total, contact
        loss = 1.0 - abs(out[ROTATION_RATE]) / v
        if not loss > 0.0 or flight > loss * tolerance / math.sqrt(a):
            return np.inf, contact  # so little is lost that the end is far, or never comes
        for i in range(N_STATES):
            w[i] = out[i]
    return np.inf, contact


# -- the loop ------------------------------------------------------------------------------------


@_compiled
def first_step(y, rate, rtol, atol):
    """A cautious first step, from the sizes of the state and of its rate."""
    size = speed = 0.0
    for i in range(N_STATES):
        scale = atol[i] + rtol * abs(y[i])
        size = max(size, abs(y[i]) / scale)
        speed = max(speed, abs(rate[i]) / scale)
    if size < 1e-5 or speed < 1e-5:
        return 1e-6
    return 0.01 * size / speed


@_compiled
def settle(contact, t, h, y, p, gx, gy, touching, g, w, rate):
    """Index of a guard that is below zero and stays there, the lowest if there are several; or -1.

    Ground acceleration may jump where a law of the ground begins, and a new contact state may be
    one that cannot last. Impacts are not asked, they happen only in motion; nor is the guard
    through which the state has just come, nor one that rounding left below zero while it rises.
    """
    if GUARDS[contact] == 0 or (GUARDS[contact] == 1 and KINDS[contact][0] == IMPACT):
        return -1
    due = -1
    moved = False
    guards(contact, y, p, ground(gx, t), ground(gy, t), g)
    for i in range(GUARDS[contact]):
        if i == touching or KINDS[contact][i] == IMPACT or not g[i] < 0.0:
            continue
        if not moved:
            # look a few rounding errors of time ahead
            moved = True
            tau = 64.0 * EPS * max(t, h)
            rates(contact, y, p, ground(gx, t), ground(gy, t), rate)
            for n in range(N_STATES):
                w[n] = y[n] + tau * rate[n]
            guards(contact, w, p, ground(gx, t + tau), ground(gy, t + tau), g)
        if g[i] < 0.0 and (due < 0 or g[i] < g[due]):
            due = i
    return due


@_compiled
def sampling_step(contact, row):
    """Largest step in which eight samples of a guard follow a law of the ground.

    Only guards of uplift and of springs are sampled; in full contact nothing else may move, and
    the error of a step says nothing of the ground.
    """
    if row[2] == 0.0 or (GUARDS[contact] == 1 and KINDS[contact][0] == IMPACT):
        return np.inf
    return (1.0 if row[2] == 1.0 else 0.5) / abs(row[4])


@_compiled
def record_step(row, t, h, contact, coefficients, steps, step_contact, step_states):
    steps[row, 0] = t
    steps[row, 1] = h
    step_contact[row] = contact
    for j in range(8):
        for i in range(N_STATES):
            step_states[row, j, i] = coefficients[j, i]


@_compiled
def record_event(row, t, kind, before, follows, y, after, events, event_kinds, event_states):
    events[row] = t
    event_kinds[row, 0] = kind
    event_kinds[row, 1] = before
    event_kinds[row, 2] = follows
    for i in range(N_STATES):
        event_states[row, 0, i] = y[i]
        event_states[row, 1, i] = after[i]


@_entry
def integrate(
    status,
    clock,
    y,
    t_end,
    horizontal,
    vertical,
    p,
    law,
    ratio,
    rtol,
    atol,
    h_max,
    fixed,
    fallen,
    rest_tolerance,
    max_impacts,
    max_steps,
    steps,
    step_contact,
    step_states,
    events,
    event_kinds,
    event_states,
    peaks,
):
    """Integrate to t_end, to the outcome that ends the motion, or until a record is FULL.

    status : contact, guard closed at t (or -1), impacts, steps taken, passages since time last
        moved, whether a guard may be due at t (1, or 0), steps recorded, events recorded.
    clock : t, next step (0: unknown), error of the last step. y (N,): the state. All three are
        changed in place, so that a call goes on where the last one ended, to the last bit.
    horizontal, vertical (m, 7) : the ground's motion, each row start, end, kind and constants of
        a law; no step straddles an end, and behind the last one the ground stands still.
    fixed : 0 to control the error, or the number of equal steps in each law of the ground.
    steps (n, 2) start and length, step_contact (n,), step_states (n, 8, N) the dense output of
    each step; n = 0 keeps none. events (m,) times, event_kinds (m, 3) kind and contact before
    and after, event_states (m, 2, N) state before and after.
    """
    contact, touching, impacts, taken, idle, news, n_steps, n_events = status
    t, h_next, last_error = clock
    k = np.zeros((N_ALL_STAGES, N_STATES))
    w = np.empty(N_STATES)
    y_new = np.empty(N_STATES)
    after = np.empty(N_STATES)
    coefficients = np.zeros((8, N_STATES))
    stack = np.empty((64, 10))
    b = np.empty((N_GUARDS, 8))
    w8 = np.empty(8)
    g = np.zeros(N_GUARDS)

    quiet = np.zeros(7)
    quiet[1] = np.inf
    nx, gx = row_at(horizontal, 0, t, quiet)
    ny, gy = row_at(vertical, 0, t, quiet)
    keep = steps.shape[0] > 0
    outcome = COMPLETED
    fresh = True  # the rate at t is not known

    while t < t_end:
        if (keep and n_steps + 2 > steps.shape[0]) or n_events + 2 > events.shape[0]:
            outcome = FULL
            break
        if t >= gx[1] or t >= gy[1]:
            nx, gx = row_at(horizontal, nx, t, quiet)
            ny, gy = row_at(vertical, ny, t, quiet)
            fresh = True
            news = 1
        last = min(gx[1], gy[1], t_end)

        landed = -1  # the guard that ends this contact state now
        if fresh:
            if news == 1:
                landed = settle(contact, t, h_next, y, p, gx, gy, touching, g, w, k[0])
            if landed < 0:
                rates(contact, y, p, ground(gx, t), ground(gy, t), k[0])
                fresh = False
                news = 0
                if h_next == 0.0:
                    h_next = first_step(y, k[0], rtol, atol)

        if landed < 0:
            # -- step, cut where a law of the ground ends, and once more to the first event in it
            span = min(gx[1] - gx[0], gy[1] - gy[0])
            controlled = fixed == 0 or span == np.inf
            if not controlled:
                h_next = span / fixed
            h = min(h_next, h_max, sampling_step(contact, gx), sampling_step(contact, gy))
            cut = t + 1.1 * h >= last
            if cut:
                h = last - t
            target = -1
            slope = 0.0
            corrections = 0
            while True:
                taken += 1
                error = take_step(contact, t, h, y, p, gx, gy, rtol, atol, k, w, y_new)
                if target < 0 and not error <= 1.0 and (controlled or not math.isfinite(error)):
                    # refused: too inaccurate, or not finite
                    cut = False
                    shrink = 0.9 * error**ERROR_EXPONENT if math.isfinite(error) else 0.1
                    h *= max(0.1, shrink)
                    h_next = h
                    if h <= 4.0 * EPS * t or h < 1e-290 or taken >= max_steps:
                        outcome = STALLED if math.isfinite(error) else NOT_FINITE
                        break
                    continue
                if target >= 0:
                    # this step ends at the event: correct what is left of the guard there
                    tau = t + h
                    guards(contact, y_new, p, ground(gx, tau), ground(gy, tau), g)
                    move = -g[target] / slope if slope < 0.0 else 0.0
                    if corrections < 3 and 2.0 * EPS * tau < abs(move) < 0.01 * h:
                        corrections += 1
                        h += move
                        continue
                    landed = target
                else:
                    # proportional-integral control: the last error damps the answer to this one
                    error = max(error, 1e-10)
                    factor = 0.9 * (error**0.7 / last_error**0.4) ** ERROR_EXPONENT
                    last_error = error
                    growth = h * min(5.0, max(0.2, factor))
                    h_next = max(h_next, growth) if cut else growth
                open_ = landed < 0 and stays_open(contact, h, y, y_new, k, touching)
                if keep or not open_ or turns(k) or abs(y_new[ROTATION]) >= fallen:
                    dense_output(contact, t, h, y, p, gx, gy, k, w, coefficients)
                if landed >= 0 or open_:
                    break
                place = NEVER
                guard_polynomials(contact, t, h, p, gx, gy, coefficients, w, g, b)
                for i in range(GUARDS[contact]):
                    noise = rounding(contact, i, h, y, p, gx, gy, t, b[i]) if touching == i else 0.0
                    x = first_fall(b[i], touching == i, noise, stack)
                    if x < place:
                        place = x
                        target = i
                        low, high = max(x - 1e-4, 0.0), min(x + 1e-4, 1.0)
                        slope = bernstein_at(b[i], high, w8) - bernstein_at(b[i], low, w8)
                        slope /= (high - low) * h
                if target < 0:
                    break
                if place * h <= 4.0 * EPS * max(t, h):
                    if touching == target and y[ROTATION_RATE] == 0.0 and h > 1e-6 * h_next:
                        # an uplift so short that rounding hides it in a step of this length
                        h *= 0.1
                        cut = False
                        target = -1
                        continue
                    h = 0.0  # it falls here and now
                if place >= 1.0 or h == 0.0:
                    landed = target
                    break
                h *= place
                cut = False
            if outcome != COMPLETED:
                break

            # -- fallen over: the step ends where it passed the bound
            if h > 0.0 and abs(y_new[ROTATION]) >= fallen:
                x = bound_passed(coefficients, fallen)
                dense_at(coefficients, x, y_new)
                shorten(coefficients, x)
                h *= x
                cut = False
                outcome = OVERTURNED

            if h > 0.0:
                if keep:
                    record_step(
                        n_steps, t, h, contact, coefficients, steps, step_contact, step_states
                    )
                    n_steps += 1
                t = last if cut or t + h > last else t + h
                if turns(k):
                    widen_within(peaks, coefficients)
                widen(peaks, y_new)
                for i in range(N_STATES):
                    y[i] = y_new[i]
                    k[0, i] = k[N_STAGES, i]
                touching = -1
                idle = 0
            if outcome != COMPLETED:
                break
            if taken >= max_steps:
                outcome = STALLED
                break

        if landed < 0:
            continue

        # -- the event: pass into the contact state that follows
        idle += 1
        if idle > 100:
            outcome = CHATTER
            break
        before = contact
        kind = KINDS[contact][landed]
        contact = jump(before, landed, law, ratio, y, p, after)
        record_event(
            n_events, t, kind, before, contact, y, after, events, event_kinds, event_states
        )
        n_events += 1
        for i in range(N_STATES):
            y[i] = after[i]
        fresh = True
        news = 1
        touching = CLOSED[before][landed] if kind != IMPACT or SIDES[contact] != 0.0 else -1
        if kind == UPLIFT:
            h_next = 0.0  # the gap opens slowly: its first moments want a short step
        if kind != IMPACT:
            continue
        if idle > 1 and SIDES[contact] == 0.0:
            # it opened and closed in no time: that uplift was none
            for i in range(GUARDS[contact]):
                if TARGETS[contact][i] == before:
                    touching = i
        impacts += 1
        if impacts > max_impacts:
            outcome = TOO_MANY_IMPACTS
            break
        if SIDES[contact] == 0.0:
            continue

        # -- the rest of infinitely many impacts at once
        ax, ay = ground(gx, t), ground(gy, t)
        rests, follows = time_to_rest(contact, y, p, law, ratio, ax, ay, rest_tolerance, w, after)
        if t + rests < last or rests < 16.0 * EPS * t:
            if keep and t + rests > t:
                for i in range(N_STATES):
                    for j in range(8):
                        coefficients[j, i] = after[i] if j == 0 else 0.0
                record_step(
                    n_steps, t, rests, follows, coefficients, steps, step_contact, step_states
                )
                n_steps += 1
            t += rests
            record_event(
                n_events, t, REST, contact, follows, y, after, events, event_kinds, event_states
            )
            n_events += 1
            for i in range(N_STATES):
                y[i] = after[i]
            contact = follows
            touching = -1
            h_next = 0.0

    status[:] = np.array([contact, touching, impacts, taken, idle, news, n_steps, n_events])
    clock[:] = np.array([t, h_next, last_error])
    return outcome


@_compiled
def widen(peaks, y):
    """Let the smallest and largest values (2, N) take in a state."""
    for i in range(N_STATES):
        peaks[0, i] = min(peaks[0, i], y[i])
        peaks[1, i] = max(peaks[1, i], y[i])


@_compiled
def turns(k):
    """Whether a coordinate may turn back within a step: its rate changes sign."""
    back = False
    for i in range(N_STATES // 2):
        back = back or k[0, i] * k[N_STAGES, i] < 0.0
    return back


@_compiled
def widen_within(peaks, coefficients):
    """Take in the turning points of the coordinates inside a step, from its dense output."""
    for i in range(N_STATES // 2):
        low, high = 0.0, 1.0
        start = slope_at(coefficients, 0.0, i)
        if start * slope_at(coefficients, 1.0, i) >= 0.0:
            continue
        for _ in range(40):
            x = 0.5 * (low + high)
            if slope_at(coefficients, x, i) * start > 0.0:
                low = x
            else:
                high = x
        value = coefficients[7, i]
        for j in range(6, -1, -1):
            value = value * high + coefficients[j, i]
        peaks[0, i] = min(peaks[0, i], value)
        peaks[1, i] = max(peaks[1, i], value)


@_compiled
def slope_at(coefficients, x, i):
    value = 7.0 * coefficients[7, i]
    for j in range(6, 0, -1):
        value = value * x + j * coefficients[j, i]
    return value


@_compiled
def bound_passed(coefficients, bound):
    """Place in a step at which the rotation's size reaches `bound`, by bisection."""
    low, high = 0.0, 1.0
    for _ in range(60):
        x = 0.5 * (low + high)
        value = coefficients[7, ROTATION]
        for j in range(6, -1, -1):
            value = value * x + coefficients[j, ROTATION]
        if abs(value) < bound:
            low = x
        else:
            high = x
    return high


@_compiled
def shorten(coefficients, x):
    """Make [0, x] of a step its whole [0, 1]."""
    factor = 1.0
    for j in range(8):
        for i in range(N_STATES):
            coefficients[j, i] *= factor
        factor *= x


@_entry
def at_rest(contact, y, p):
    """Full contact, and a kinetic energy below a billionth of the weight's potential energy."""
    if SIDES[contact] != 0.0 or KINDS[contact][0] != UPLIFT:
        return False
    energy = np.empty(3)
    energies(contact, y, p, energy)
    return energy[0] <= 1e-9 * abs(energy[1])


@_entry
def falls(
    contact, y, still, p, law, ratio, rtol, atol, fallen, max_impacts, max_steps, reach
):  # fmt: skip
    """Whether free motion from here leads to the ground, and not back upright.

    It is followed until the next impact, or, on springs, while the structure leans further;
    `reach` [s] is how long at a time; `still` the table of ground that is.
    """
    if SIDES[contact] == 0.0 and KINDS[contact][0] == UPLIFT:
        return False
    rocks = SIDES[contact] != 0.0 and KINDS[contact][0] == IMPACT
    if rocks:
        # a rocking motion has a time of its own, in which it comes back or falls
        a = abs(opening_acceleration(contact, y, p, 0.0, 0.0))
        reach = max(reach, 10.0 / math.sqrt(a)) if a > 0.0 else reach
    steps, step_contact, step_states = np.empty((0, 2)), np.empty(0, np.int64), np.empty((0, 8, 1))
    events, event_kinds = np.empty(64), np.empty((64, 3), np.int64)
    event_states = np.empty((64, 2, N_STATES))
    peaks = np.zeros((2, N_STATES))
    status = np.array([contact, -1, 0, 0, 0, 1, 0, 0])
    clock = np.array([0.0, 0.0, 1.0])
    state = y.copy()
    for n in range(1000):
        lean = abs(state[ROTATION])
        status[6] = status[7] = 0
        code = integrate(
            status, clock, state, (n + 1) * reach, still, still, p, law, ratio, rtol, atol,
            np.inf, np.int64(0), fallen, 1e-6, 0 if rocks else max_impacts, max_steps,
            steps, step_contact, step_states, events, event_kinds, event_states, peaks,
        )  # fmt: skip
        if code == OVERTURNED:
            return True
        if code not in (COMPLETED, FULL) or (not rocks and abs(state[ROTATION]) <= lean):
            return False
    return False


@_entry
def integrate_many(
    contacts, states, t_end, quiet_from, horizontal, h_rows, vertical, v_rows, p, law, ratio,
    rtol, atol, h_max, fixed, fallen, rest_tolerance, max_impacts, max_steps,
    outcome, t_final, contact_final, impacts, peaks, impact_times,
):  # fmt: skip
    """Integrate n motions one after the other, keeping the end, the peaks and the impacts.

    contacts (n,), states (n, N) at the start, and on return at the end. horizontal, vertical : the
    rows of all motions, those of motion i from h_rows[i, 0] to h_rows[i, 1]. t_end, quiet_from,
    law, ratio, fallen (n,), p (n, m). impact_times (n, k) gets the first k impacts of each.
    """
    steps, step_contact, step_states = np.empty((0, 2)), np.empty(0, np.int64), np.empty((0, 8, 1))
    events, event_kinds = np.empty(64), np.empty((64, 3), np.int64)
    event_states = np.empty((64, 2, N_STATES))
    status = np.empty(8, np.int64)
    clock = np.empty(3)
    for n in range(len(contacts)):
        y = states[n]
        status[:] = 0
        status[0], status[1], status[5] = contacts[n], -1, 1
        clock[:] = 0.0
        clock[2] = 1.0
        widen(peaks[n], y)
        noted = 0
        code = FULL
        while code == FULL:
            status[7] = 0
            code = integrate(
                status, clock, y, t_end[n], horizontal[h_rows[n, 0] : h_rows[n, 1]],
                vertical[v_rows[n, 0] : v_rows[n, 1]], p[n], law[n], ratio[n], rtol, atol, h_max,
                fixed, fallen[n], rest_tolerance, max_impacts, max_steps,
                steps, step_contact, step_states, events, event_kinds, event_states, peaks[n],
            )  # fmt: skip
            for e in range(status[7]):
                if event_kinds[e, 0] == IMPACT and noted < impact_times.shape[1]:
                    impact_times[n, noted] = events[e]
                    noted += 1
        if code == COMPLETED and quiet_from[n] <= t_end[n]:
            reach = 0.1 * t_end[n]
            if falls(
                status[0], y, horizontal[:0], p[n], law[n], ratio[n], rtol, atol, fallen[n],
                max_impacts, max_steps, reach,
            ):  # fmt: skip
                code = OVERTURNED
            elif at_rest(status[0], y, p[n]):
                code = CAME_TO_REST
        outcome[n] = code
        t_final[n] = clock[0]
        contact_final[n] = status[0]
        impacts[n] = status[2]


@_compiled
def row_for(table, n, t, quiet):
    """As row_at, but the very end of a motion still belongs to its last law."""
    if table.shape[0] > 0 and t == table[-1, 1]:
        return table.shape[0] - 1, table[-1]
    return row_at(table, n, t, quiet)


@_entry
def evaluate(contacts, t, states, horizontal, vertical, p, energy, force, motion):
    """Energies, reactions and kinematics (columns of the last three) at every sample."""
    quiet = np.zeros(7)
    quiet[1] = np.inf
    nx = ny = 0
    for n in range(t.shape[0]):
        nx, gx = row_for(horizontal, nx, t[n], quiet)
        ny, gy = row_for(vertical, ny, t[n], quiet)
        ax, ay = ground(gx, t[n]), ground(gy, t[n])
        energies(contacts[n], states[n], p, energy[n])
        reactions(contacts[n], states[n], p, ax, ay, force[n])
        kinematics(contacts[n], states[n], p, motion[n])
