"""The text of one step of many lanes, for the vectoriser of the compiler."""

from __future__ import annotations

from textwrap import indent
from types import ModuleType

import numpy as np

from rockeom.numeric.tableau import (
    NODES,
    Tableau,
    _stage,
    _sum,
    bernstein_at,
    error_text,
    samples_to_bernstein,
)

LANES = 16
"""Motions that step together: two of the widest vectors that processors have."""


def _padded(times: list[float], places: int) -> list[float]:
    return times + [1.0] * (places - len(times))


def _shaken(places: int) -> str:
    """Functions that find the ground at all places, by linear laws and by sines."""
    known = "".join(f"    c{j} = times[{j}]\n" for j in range(places))
    text = f"""

@apart
def shake_lanes(z, times):
    \"\"\"The ground at some times of a step, by linear laws.\"\"\"
{known}    for lane in range(LANES):
        t, h = z[Z_T + lane], z[Z_H + lane]
        start_x, x0, x1 = z[Z_START_X + lane], z[Z_X0 + lane], z[Z_X1 + lane]
        start_y, y0, y1 = z[Z_START_Y + lane], z[Z_Y0 + lane], z[Z_Y1 + lane]
"""
    for j in range(places):
        text += f"        tau = t + c{j} * h\n"
        text += f"        z[Z_AX + {j} * LANES + lane] = x0 + x1 * (tau - start_x)\n"
        text += f"        z[Z_AY + {j} * LANES + lane] = y0 + y1 * (tau - start_y)\n"
    for axis, name in (("X", "x"), ("Y", "y")):
        text += f"""

@apart
def bend_{name}_lanes(z, times):
    \"\"\"The same of lanes whose law is a sine; others keep what they have.\"\"\"
{known}    for lane in range(LANES):
        t, h, start = z[Z_T + lane], z[Z_H + lane], z[Z_START_{axis} + lane]
        size, rate = z[Z_{axis}0 + lane], z[Z_{axis}1 + lane]
        phase, bent = z[Z_{axis}2 + lane], z[Z_KIND_{axis} + lane] == 1.0
"""
        for j in range(places):
            place = f"z[Z_A{axis} + {j} * LANES + lane]"
            text += f"        tau = t + c{j} * h\n"
            text += "        sine, _ = sine_cosine(rate * (tau - start) + phase)\n"
            text += f"        {place} = size * sine if bent else {place}\n"
    return text


ROOTS = 6
"""Powers of errors are products of their 2nd, 4th, ... 64th roots."""


def _powers(exponent: float) -> str:
    """A power of `error` as a product of its roots r1, r2, ...; the exponent within a 128th."""
    bits = round(exponent * 2**ROOTS)
    return " * ".join(f"r{k}" for k in range(1, ROOTS + 1) if bits >> (ROOTS - k) & 1)


def lanes_text(method: Tableau, generated: ModuleType) -> str:
    """Source of one step of `LANES` motions of a structure at once; `lanes.py` says of what.

    Each loop over the lanes holds the whole work of a lane in plain numbers and without branches,
    at places that differ by constants: so the compiler makes vector instructions of it.
    """
    s, size, r = method.stages, generated.N_STATES, generated.ROTATION
    n = size // 2
    parameters = len(generated.prepare(np.ones(len(generated.PARAMETERS))))
    method_exponent = -1.0 / (method.error_order + 1)
    damping = round(-0.4 * method_exponent * 2**ROOTS) / 2**ROOTS
    roots = "        r1 = math.sqrt(error)\n"
    roots += "".join(f"        r{k} = math.sqrt(r{k - 1})\n" for k in range(2, ROOTS + 1))
    rocking = [c for c, side in enumerate(generated.SIDES) if side != 0.0]

    def at(rows: str, i: int) -> str:
        return f"z[{rows} + {i} * LANES + lane]"

    start_of = f"""        t, h = z[Z_T + lane], z[Z_H + lane]
        p = ({", ".join(at("Z_P", i) for i in range(parameters))},)
"""
    start, end, kept, within, taken = "", "", "", "", ""
    for i in range(n):
        start += f"        q0_{i} = {at('Z_Q', i)}\n"
        start += f"        v0_{i} = {at('Z_K', i)}\n        a0_{i} = {at('Z_K', n + i)}\n"
        end += f"        q1_{i} = {at('Z_Q_NEW', i)}\n"
        end += f"        v1_{i} = {at('Z_K_NEW', i)}\n        a1_{i} = {at('Z_K_NEW', n + i)}\n"
        kept += f"        {at('Z_Q_NEW', i)} = q{s}_{i}\n"
        kept += (
            f"        {at('Z_K_NEW', i)} = v{s}_{i}\n        {at('Z_K_NEW', n + i)} = a{s}_{i}\n"
        )
        within += f"""        within &= turns_within(
            h, q0_{i}, v0_{i}, a0_{i}, q1_{i}, v1_{i}, a1_{i},
            {at("Z_LEAST", i)}, {at("Z_MOST", i)}, {at("Z_LEAST", n + i)}, {at("Z_MOST", n + i)},
        )
"""
        taken += f"        {at('Z_Q', i)} = q1_{i} if stands else q0_{i}\n"
        taken += f"        {at('Z_K', i)} = v1_{i} if stands else v0_{i}\n"
        taken += f"        {at('Z_K', n + i)} = a1_{i} if stands else a0_{i}\n"
        for state, old, new in ((i, f"q0_{i}", f"q1_{i}"), (n + i, f"v0_{i}", f"v1_{i}")):
            least, most = at("Z_LEAST", state), at("Z_MOST", state)
            taken += f"        {least} = min({least}, {new} if stands else {old})\n"
            taken += f"        {most} = max({most}, {new} if stands else {old})\n"
    # stage j is shaken as place j - 1, the last two, at the end of the step, as one
    times = method.c[1:s].tolist()
    assert method.c[s] == times[-1]
    places = max(len(times), len(NODES))

    def stage(j: int) -> str:
        place = min(j, len(times)) - 1
        ground = f"{at('Z_AX', place)}, {at('Z_AY', place)}"
        return _stage(method, j, n, ground)

    stages = "".join(stage(j) for j in range(1, s + 1))
    errors = indent(error_text(method, n), "    ")
    gap = f"q0_{r}, v0_{r}, a0_{r}, q1_{r}, v1_{r}, a1_{r}"

    # full contact: the guards sampled on the quintics through both ends
    quintics, sampled = "", ""
    to_samples, to_slopes = bernstein_at(NODES, 5), 5.0 * bernstein_at(NODES, 4)
    for i in range(n):
        if i == r:
            continue
        quintics += f"        b0_{i}, b5_{i} = q0_{i}, q1_{i}\n"
        quintics += (
            f"        b1_{i}, b4_{i} = q0_{i} + 0.2 * h * v0_{i}, q1_{i} - 0.2 * h * v1_{i}\n"
        )
        quintics += f"        b2_{i} = q0_{i} + 0.4 * h * v0_{i} + 0.05 * h * h * a0_{i}\n"
        quintics += f"        b3_{i} = q1_{i} - 0.4 * h * v1_{i} + 0.05 * h * h * a1_{i}\n"
        quintics += "".join(f"        d{j}_{i} = (b{j + 1}_{i} - b{j}_{i}) / h\n" for j in range(5))
    for m in range(len(NODES)):
        for i in range(n):
            q = v = "0.0"
            if i != r:
                q = _sum(to_samples[m], f"b{{}}_{i}", " " * 12)
                v = _sum(to_slopes[m], f"d{{}}_{i}", " " * 12)
            sampled += f"        q_{i} = (\n            {q}\n        )\n"
            sampled += f"        v_{i} = (\n            {v}\n        )\n"
        states = ", ".join([f"q_{i}" for i in range(n)] + [f"v_{i}" for i in range(n)])
        sampled += f"        ax, ay = {at('Z_AX', m)}, {at('Z_AY', m)}\n"
        for c in rocking:
            sampled += f"        found = accelerations({c}, {states}, p, ax, ay)\n"
            sampled += f"        g{c}_{m} = -SIDES[{c}] * found[{r}]\n"
    held = ""
    for c in rocking:
        held += f"        most = abs(g{c}_0)\n"
        held += "".join(f"        most = max(most, abs(g{c}_{m}))\n" for m in range(1, 8))
        for row in samples_to_bernstein():
            coefficient = _sum(row, f"g{c}_{{}}", " " * 12)
            held += f"        held &= (\n            {coefficient}\n        ) > 1e-3 * most\n"

    return f'''
from rockeom.marks import apart

LANES = {LANES}
N_PARAMETERS = {parameters}
PLACES = {places}  # of a step at which the ground is found at once
STAGE_PLACES = np.array({_padded(times, places)!r})
NODE_PLACES = np.array({_padded(NODES.tolist(), places)!r})
DAMPING = {damping!r}
{_shaken(places)}

@apart
def control_lanes(z):
    """The next step of each lane by proportional-integral control, as in the loop.

    A step that is cut, or is to end at an impact, says nothing of it unless it is refused. Powers
    are products of roots.
    """
    for lane in range(LANES):
        h, error, last = z[Z_H + lane], max(z[Z_ERROR + lane], 1e-10), z[Z_DAMP + lane]
        equal = z[Z_EQUAL + lane] > 0.0
{roots}        refused = (error > 1.0) & ~equal
        cut, first = z[Z_T_NEW + lane] >= z[Z_LAST + lane], z[Z_LANDING + lane] == 0.0
        tells = (error <= 1.0) & first & ~cut & ~equal
        factor = (0.9 if refused else 0.9 * last) / (
            {_powers(-method_exponent)} if refused else {_powers(-0.7 * method_exponent)}
        )
        factor = max(0.1 if refused else 0.2, factor)
        z[Z_NEXT + lane] = h * min(5.0, factor) if refused | tells else z[Z_NEXT + lane]
        z[Z_DAMP + lane] = {_powers(damping)} if tells else last


@apart
def step_lanes(z, rtol, tolerances):
    """One step of all lanes: the states and accelerations at its end, and its estimated error."""
    atol = ({", ".join(f"tolerances[{i}]" for i in range(size))},)
    for lane in range(LANES):
        contact = z[Z_CONTACT + lane]
{start_of}        hh = h * h
{start}{indent(stages, "    ")}{kept}{errors}        z[Z_ERROR + lane] = error


@apart
def judge_lanes(z, coarse):
    """What becomes of the step of each rocking lane; the length of one to be repeated.

    One with an error above its bound, `coarse` for an equal step, is refused, or doubtful if it is
    an equal one; as one that is not finite.
    """
    for lane in range(LANES):
        t, h, side = z[Z_T + lane], z[Z_H + lane], z[Z_SIDE + lane]
        touching, landing = z[Z_TOUCHING + lane] == 0.0, z[Z_LANDING + lane]
{start}{end}        upright, within = abs(q1_{r}) < z[Z_FALLEN + lane], True
{within}        verdict, new_h = judge_gap(
            t, h, z[Z_LAST + lane] - t, side, touching, landing, upright, within,
            {gap},
        )
        error, equal = z[Z_ERROR + lane], z[Z_EQUAL + lane] > 0.0
        refused = (error > 1.0) & (error < np.inf) & (h > 64.0 * EPS * t) & ~equal
        verdict = verdict if error <= (coarse if equal else 1.0) else DOUBTFUL
        z[Z_VERDICT + lane] = REFUSED if refused else verdict
        z[Z_H + lane] = h if refused else new_h


@apart
def judge_held_lanes(z, coarse):
    """What becomes of the step of each lane in full contact: it stands where no foot lifts."""
    for lane in range(LANES):
{start_of}{start}{end}{quintics}{sampled}        held = z[Z_SIDE + lane] == 0.0
        held &= z[Z_ERROR + lane] <= (coarse if z[Z_EQUAL + lane] > 0.0 else 1.0)
{held}        within = True
{within}        stands = STANDS if within else TURNS
        z[Z_VERDICT + lane] = stands if held else z[Z_VERDICT + lane]


@apart
def accept_lanes(z):
    """Move the lanes whose step stands to its end."""
    for lane in range(LANES):
        stands = z[Z_VERDICT + lane] >= STANDS
        repeated = z[Z_VERDICT + lane] == REPEATED
        t, h = z[Z_T + lane], z[Z_H + lane]
{start}{end}        z[Z_T + lane] = z[Z_T_NEW + lane] if stands else t
        z[Z_T_NEW + lane] = t + h if repeated else z[Z_T_NEW + lane]
        landing = z[Z_LANDING + lane]
        kept = landing if z[Z_VERDICT + lane] == TURNS else 0.0
        z[Z_LANDING + lane] = max(landing, 0.0) + 1.0 if repeated else kept
        z[Z_TOUCHING + lane] = -1.0 if stands else z[Z_TOUCHING + lane]
        z[Z_TAKEN + lane] = z[Z_TAKEN + lane] + 1.0
{taken}'''
