"""The integration loop: one text for every structure and method.

This file is not imported. `rockeom.numeric.specialise` joins it to a generated module (which
defines rates, guards, jump, opening_acceleration and the tables) and to the text of a step
(take_step, dense_output), so that the compiler sees one self-contained program.

It reads in the order of the work: settle what is due, step, find the first event, land on it,
jump, go on.
"""

# Outcomes, numbered as in rockeom.numeric.response.Outcome
COMPLETED, AT_REST, OVERTURNED, TOO_MANY_IMPACTS, STALLED, CHATTER, NOT_FINITE = range(7)

# Columns of the record of events
IMPACT, UPLIFT, SWITCH, REST = range(4)

EPS = 2.220446049250313e-16
NEVER = 2.0  # a place behind the end of any step


@_compiled
def ground(seg, column, t):
    """Ground acceleration at t by the law written from `column` on in a segment's row."""
    kind = seg[column]
    tau = t - seg[column + 1]
    if kind == 0.0:  # linear
        return seg[column + 2] + seg[column + 3] * tau
    if kind == 1.0:  # sine
        return seg[column + 2] * math.sin(seg[column + 3] * tau + seg[column + 4])
    x = seg[column + 3] * (tau - seg[column + 4])
    if kind == 2.0:  # symmetric Ricker
        return seg[column + 2] * (1.0 - 2.0 * x * x) * math.exp(-x * x)
    return seg[column + 2] * x * (x * x - 3.0) * math.exp(-0.5 * x * x)


# -- first fall of a guard through zero ----------------------------------------------------------


@_compiled
def bernstein_at(b, x):
    """Value of a polynomial in Bernstein form, by de Casteljau's scheme."""
    w = b.copy()
    for n in range(7, 0, -1):
        for i in range(n):
            w[i] += x * (w[i + 1] - w[i])
    return w[0]


@_compiled
def first_fall(b, touching, noise):
    """Smallest x in (0, 1] at which a polynomial falls through zero, or NEVER.

    b (8,) Bernstein coefficients on [0, 1]. Its coefficients bound a polynomial, and the number
    of their changes of sign bounds that of its roots: a part without change has no root, a part
    with one has one, other parts are halved. So no pair of roots is stepped over.

    touching : the guard was closed at x = 0 (an event was just there); that root is no other event.
    noise : coefficients below it are rounding errors.
    """
    scale = 0.0
    for i in range(8):
        scale = max(scale, abs(b[i]))
    if scale == 0.0:
        return NEVER
    noise = max(8.0 * EPS * scale, noise)
    stack = np.empty((64, 8))
    left = np.empty(64)
    width = np.empty(64)
    stack[0] = b
    if touching:
        stack[0, 0] = 0.0
    left[0] = 0.0
    width[0] = 1.0
    depth = 1
    while depth > 0:
        depth -= 1
        part = stack[depth].copy()
        x0, dx = left[depth], width[depth]
        changes = 0
        first = sign = 0
        for i in range(8):
            if abs(part[i]) > noise:
                new = 1 if part[i] > 0.0 else -1
                if sign == 0:
                    first = new
                elif new != sign:
                    changes += 1
                sign = new
        if sign == 0 or (changes == 0 and first > 0):
            continue
        if changes == 0:
            # below zero from its start: it fell where this part begins
            return x0
        if (changes == 1 and first > 0) or dx < 1e-13:
            return x0 + dx * _root(part)
        if changes == 1 and x0 == 0.0 and first < 0:
            # begins below zero and rises: it is leaving the surface it stood on
            if touching:
                return 0.0
            continue
        if changes == 1:
            continue
        # halve: de Casteljau gives both parts at once
        lower = np.empty(8)
        for n in range(7, -1, -1):
            lower[7 - n] = part[0]
            for i in range(n):
                part[i] = 0.5 * (part[i] + part[i + 1])
        # part now holds the coefficients of the upper half
        stack[depth] = part
        left[depth], width[depth] = x0 + 0.5 * dx, 0.5 * dx
        stack[depth + 1] = lower
        left[depth + 1], width[depth + 1] = x0, 0.5 * dx
        depth += 2
    return NEVER


@_compiled
def _root(b):
    """The single fall through zero on [0, 1], by bisection sped up by false position."""
    low, high = 0.0, 1.0
    at_low, at_high = bernstein_at(b, 0.0), bernstein_at(b, 1.0)
    for n in range(200):
        if high - low <= 2.0 * EPS:
            break
        x = 0.5 * (low + high)
        if n % 2 == 0 and at_low > 0.0 > at_high:
            x = low + (high - low) * at_low / (at_low - at_high)
            x = min(max(x, low + 0.01 * (high - low)), high - 0.01 * (high - low))
        value = bernstein_at(b, x)
        if value > 0.0:
            low, at_low = x, value
        else:
            high, at_high = x, value
        if value == 0.0:
            return x
    return high


@_compiled
def guard_polynomial(contact, index, t, h, p, seg, coefficients, y, g, b):
    """Bernstein coefficients of a guard over the step whose dense output is given."""
    if KINDS[contact][index] == 0:
        # an impact's guard is the rotation, on its side: exactly the dense output
        side = SIDES[contact]
        for i in range(8):
            b[i] = 0.0
            for j in range(i + 1):
                b[i] += POWERS_TO_BERNSTEIN[i, j] * side * coefficients[j, ROTATION]
        return
    samples = np.empty(8)
    for n in range(8):
        x = NODES[n]
        for i in range(N_STATES):
            y[i] = coefficients[7, i]
            for j in range(6, -1, -1):
                y[i] = y[i] * x + coefficients[j, i]
        tau = t + x * h
        guards(contact, y, p, ground(seg, 2, tau), ground(seg, 8, tau), g)
        samples[n] = g[index]
    for i in range(8):
        b[i] = 0.0
        for j in range(8):
            b[i] += SAMPLES_TO_BERNSTEIN[i, j] * samples[j]


@_compiled
def rounding(contact, index, h, y, p, seg, t, b):
    """Size of the rounding errors of a guard that opens from closed.

    A gap that opens without speed grows with the third power of time out of accelerations that
    cancel: what is left of them by rounding acts over the whole step.
    """
    scale = 0.0
    for i in range(8):
        scale = max(scale, abs(b[i]))
    if KINDS[contact][index] != IMPACT:
        return 1e-8 * scale
    ax, ay = ground(seg, 2, t), ground(seg, 8, t)
    acceleration = 0.0
    for other in range(len(SIDES)):
        if SIDES[other] != 0.0:
            acceleration += abs(opening_acceleration(other, y, p, ax, ay))
    return max(1e-11 * scale, 1e-10 * acceleration * h * h)


# -- infinitely many impacts ---------------------------------------------------------------------


@_compiled
def time_to_rest(contact, y, p, law, ratio, ax, ay, tolerance, out):
    """(time, contact): when the infinitely many impacts to come will all have happened.

    Close to the end of a free rocking motion the flights between impacts are parabolas: a flight
    that leaves with gap rate v under the closing acceleration a lasts 2 v / a, and the impact
    map gives the v of the next. Their sum converges. Returns (inf, contact) while it is longer
    than `tolerance` in units of 1/sqrt(a), or while an acceleration opens the gap. `out` gets
    the state of the limit.
    """
    w = y.copy()
    total = 0.0
    start = abs(y[ROTATION_RATE])
    while True:
        a = -opening_acceleration(contact, w, p, ax, ay)
        if not a > 0.0:
            return np.inf, contact
        v = abs(w[ROTATION_RATE])
        total += 2.0 * v / a
        if total > tolerance / math.sqrt(a):
            return np.inf, contact
        w[ROTATION_RATE] = -w[ROTATION_RATE] if v > EPS * start else 0.0
        contact = jump(contact, 0, law, ratio, w, p, out)
        if SIDES[contact] == 0.0:
            return total, contact
        if not abs(out[ROTATION_RATE]) < v:
            return np.inf, contact  # nothing is lost: there is no end
        w[:] = out


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
def settle(contact, t, y, p, seg, touching, g):
    """Index of a guard that is already below zero, the lowest if there are several; else -1.

    Ground acceleration may jump where a segment begins, and a new contact state may be one that
    cannot last. Impacts are not asked, they happen only in motion; nor is the guard through
    which the state has just come.
    """
    if GUARDS[contact] == 0 or (GUARDS[contact] == 1 and KINDS[contact][0] == 0):
        return -1
    guards(contact, y, p, ground(seg, 2, t), ground(seg, 8, t), g)
    due = -1
    for i in range(GUARDS[contact]):
        if i != touching and KINDS[contact][i] != 0 and g[i] < 0.0 and (due < 0 or g[i] < g[due]):
            due = i
    return due


@_compiled
def integrate(
    contact, y0, t_end, segments, p, law, ratio, rtol, atol, h_max, fallen, rest_tolerance,
    max_impacts, max_steps, keep,
):
    """Integrate from y0 (N,) at t = 0 to t_end, or to the outcome that ends the motion.

    segments (m, 14) : start, end, and the law of the horizontal (columns 2 to 7) and of the
        vertical acceleration (8 to 13); they cover [0, t_end] and no step straddles an end.
    Returns (outcome, t, contact, y, steps, step_contact, step_states, events, event_kinds,
    event_states): steps (n, 2) start and length, step_states (n, 8, N) their dense output,
    events (m,) times, event_kinds (m, 3) kind and contact before and after, event_states
    (m, 2, N) state before and after.
    """
    k = np.zeros((N_ALL_STAGES, N_STATES))
    w = np.empty(N_STATES)
    y = y0.copy()
    y_new = np.empty(N_STATES)
    after = np.empty(N_STATES)
    coefficients = np.empty((8, N_STATES))
    b = np.empty(8)
    g = np.zeros(N_GUARDS)

    capacity = 256 if keep else 1
    n_steps = 0
    steps = np.empty((capacity, 2))
    step_contact = np.empty(capacity, np.int64)
    step_states = np.empty((capacity, 8, N_STATES))
    n_events = 0
    events = np.empty(64)
    event_kinds = np.empty((64, 3), np.int64)
    event_states = np.empty((64, 2, N_STATES))

    t = 0.0
    s = 0
    seg = segments[0]
    h_next = 0.0
    outcome = COMPLETED
    taken = impacts = 0
    fresh = True  # the rate at t, and whether a guard is due there, are not known
    touching = -1  # guard that is closed at t: where the state came through
    idle = 0  # passages since time last moved

    while t < t_end:
        if t >= seg[1] and s + 1 < segments.shape[0]:
            s += 1
            seg = segments[s]
            fresh = True
            continue

        due = -1
        if fresh:
            due = settle(contact, t, y, p, seg, touching, g)
            if due < 0:
                rates(contact, y, p, ground(seg, 2, t), ground(seg, 8, t), k[0])
                fresh = False
                if h_next == 0.0:
                    h_next = first_step(y, k[0], rtol, atol)
        h = 0.0
        landed = due

        if due < 0:
            # -- step, cut at the end of the segment; land on the first event, if there is one
            last = min(seg[1], t_end)
            h = min(h_next, h_max)
            cut = t + 1.1 * h >= last
            if cut:
                h = last - t
            target = -1
            slope = 0.0
            corrections = 0
            while True:
                taken += 1
                error = take_step(contact, t, h, y, p, seg, rtol, atol, k, w, y_new)
                if not math.isfinite(error):
                    if h < 1e-3 * first_step(y, k[0], rtol, atol) or taken >= max_steps:
                        outcome = NOT_FINITE
                        break
                    h *= 0.1
                    cut = False
                    target = -1
                    continue
                if error > 1.0 and target < 0:
                    h *= max(0.2, 0.9 * error**ERROR_EXPONENT)
                    h_next = h
                    cut = False
                    if h <= 4.0 * EPS * abs(t) or taken >= max_steps:
                        outcome = STALLED
                        break
                    continue
                if target >= 0:
                    # this step ends at the event: correct what is left of the guard there
                    tau = t + h
                    guards(contact, y_new, p, ground(seg, 2, tau), ground(seg, 8, tau), g)
                    move = -g[target] / slope if slope < 0.0 else 0.0
                    if corrections < 3 and abs(move) > 2.0 * EPS * tau and abs(move) < 0.01 * h:
                        corrections += 1
                        h += move
                        continue
                    dense_output(contact, t, h, y, p, seg, k, w, coefficients)
                    landed = target
                    break
                # accepted: ask every guard
                if not cut:
                    h_next = h * min(5.0, 0.9 * max(error, 1e-10) ** ERROR_EXPONENT)
                elif error > 0.0:
                    h_next = max(h_next, h * min(5.0, 0.9 * max(error, 1e-10) ** ERROR_EXPONENT))
                dense_output(contact, t, h, y, p, seg, k, w, coefficients)
                place = NEVER
                for i in range(GUARDS[contact]):
                    guard_polynomial(contact, i, t, h, p, seg, coefficients, w, g, b)
                    noise = rounding(contact, i, h, y, p, seg, t, b) if touching == i else 0.0
                    x = first_fall(b, touching == i, noise)
                    if x < place:
                        place = x
                        target = i
                        high = min(x + 1e-4, 1.0)
                        low = max(x - 1e-4, 0.0)
                        slope = (bernstein_at(b, high) - bernstein_at(b, low)) / ((high - low) * h)
                if target < 0:
                    break
                if place * h <= 4.0 * EPS * max(t, h):
                    landed = target  # it falls here and now
                    h = 0.0
                    break
                if place >= 1.0:
                    landed = target
                    break
                h *= place
            if outcome != COMPLETED:
                break

            # -- fallen over: cut the step where it passed the bound
            over = False
            if h > 0.0 and abs(y_new[ROTATION]) >= fallen:
                over = True
                x = _bound_passed(coefficients, fallen)
                for i in range(N_STATES):
                    factor = 1.0
                    for j in range(8):
                        coefficients[j, i] *= factor
                        factor *= x
                    y_new[i] = 0.0
                    for j in range(8):
                        y_new[i] += coefficients[j, i]
                h *= x
                landed = -1

            if h > 0.0:
                if keep:
                    if n_steps == steps.shape[0]:
                        steps = _grown2(steps)
                        step_contact = np.append(step_contact, step_contact)
                        step_states = _grown3(step_states)
                    steps[n_steps, 0] = t
                    steps[n_steps, 1] = h
                    step_contact[n_steps] = contact
                    step_states[n_steps] = coefficients
                    n_steps += 1
                t = last if t + h >= last or (cut and landed < 0 and not over) else t + h
                y[:] = y_new
                k[0] = k[N_STAGES]
                touching = -1
                idle = 0
                if over:
                    outcome = OVERTURNED
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
        kind = KINDS[contact][landed]
        follows = jump(contact, landed, law, ratio, y, p, after)
        if kind == IMPACT:
            impacts += 1
        if n_events == events.shape[0]:
            events = np.append(events, events)
            event_kinds = np.append(event_kinds, event_kinds).reshape(-1, 3)
            event_states = _grown3(event_states)
        events[n_events] = t
        event_kinds[n_events, 0] = kind
        event_kinds[n_events, 1] = contact
        event_kinds[n_events, 2] = follows
        event_states[n_events, 0] = y
        event_states[n_events, 1] = after
        n_events += 1
        y[:] = after
        came_from = contact
        contact = follows
        fresh = True
        touching = CLOSED[came_from][landed] if kind != IMPACT or SIDES[contact] != 0.0 else -1
        if impacts > max_impacts:
            outcome = TOO_MANY_IMPACTS
            break
        if kind == IMPACT and SIDES[contact] != 0.0:
            ax, ay = ground(seg, 2, t), ground(seg, 8, t)
            rests, follows = time_to_rest(
                contact, y, p, law, ratio, ax, ay, rest_tolerance, after
            )
            if t + rests < min(seg[1], t_end) or rests < 16.0 * EPS * t:
                if n_events == events.shape[0]:
                    events = np.append(events, events)
                    event_kinds = np.append(event_kinds, event_kinds).reshape(-1, 3)
                    event_states = _grown3(event_states)
                if keep and rests > 0.0:
                    if n_steps == steps.shape[0]:
                        steps = _grown2(steps)
                        step_contact = np.append(step_contact, step_contact)
                        step_states = _grown3(step_states)
                    steps[n_steps, 0] = t
                    steps[n_steps, 1] = rests
                    step_contact[n_steps] = follows
                    step_states[n_steps] = 0.0
                    step_states[n_steps, 0] = after
                    n_steps += 1
                t += rests
                events[n_events] = t
                event_kinds[n_events, 0] = REST
                event_kinds[n_events, 1] = contact
                event_kinds[n_events, 2] = follows
                event_states[n_events, 0] = y
                event_states[n_events, 1] = after
                n_events += 1
                y[:] = after
                contact = follows
                touching = -1
                h_next = 0.0

    return (
        outcome, t, contact, y, steps[:n_steps], step_contact[:n_steps], step_states[:n_steps],
        events[:n_events], event_kinds[:n_events], event_states[:n_events],
    )


@_compiled
def _bound_passed(coefficients, bound):
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
def _grown2(old):
    new = np.empty((2 * old.shape[0], old.shape[1]))
    new[: old.shape[0]] = old
    return new


@_compiled
def _grown3(old):
    new = np.empty((2 * old.shape[0], old.shape[1], old.shape[2]))
    new[: old.shape[0]] = old
    return new


@_compiled
def evaluate(contacts, t, states, segments, p, energy, force, motion):
    """Energies, reactions and kinematics (columns of the last three) at every sample."""
    s = 0
    for n in range(t.shape[0]):
        while s + 1 < segments.shape[0] and t[n] >= segments[s, 1]:
            s += 1
        ax, ay = ground(segments[s], 2, t[n]), ground(segments[s], 8, t[n])
        energies(contacts[n], states[n], p, energy[n])
        reactions(contacts[n], states[n], p, ax, ay, force[n])
        kinematics(contacts[n], states[n], p, motion[n])
