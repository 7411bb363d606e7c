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


def lanes_text(method: Tableau, generated: ModuleType) -> str:
    """Source of one step of `LANES` motions of a structure at once; `lanes.py` says of what.

    Each loop over the lanes holds the whole work of a lane in plain numbers and without branches,
    at places that differ by constants: so the compiler makes vector instructions of it.
    """
    s, size, r = method.stages, generated.N_STATES, generated.ROTATION
    n = size // 2
    parameters = len(generated.prepare(np.ones(len(generated.PARAMETERS))))
    rocking = [c for c, side in enumerate(generated.SIDES) if side != 0.0]

    def at(rows: str, i: int) -> str:
        return f"z[{rows} + {i} * LANES + lane]"

    ground = f"""        t, h = z[Z_T + lane], z[Z_H + lane]
        gx, gy = ground_x(z, lane), ground_y(z, lane)
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
    stages = "".join(_stage(method, j, n) for j in range(1, s + 1))
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
    for m, node in enumerate(NODES.tolist()):
        for i in range(n):
            q = v = "0.0"
            if i != r:
                q = _sum(to_samples[m], f"b{{}}_{i}", " " * 12)
                v = _sum(to_slopes[m], f"d{{}}_{i}", " " * 12)
            sampled += f"        q_{i} = (\n            {q}\n        )\n"
            sampled += f"        v_{i} = (\n            {v}\n        )\n"
        states = ", ".join([f"q_{i}" for i in range(n)] + [f"v_{i}" for i in range(n)])
        sampled += f"        tau = t + {node!r} * h\n"
        sampled += "        ax, ay = shaking(gx, tau), shaking(gy, tau)\n"
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

LANES = {LANES}
N_PARAMETERS = {parameters}


def step_lanes(z, rtol, atol):
    """One step of all lanes: the states and accelerations at its end, and its estimated error."""
    for lane in range(LANES):
        contact = z[Z_CONTACT + lane]
{ground}        hh = h * h
{start}{indent(stages, "    ")}{kept}{errors}        z[Z_ERROR + lane] = error


def judge_lanes(z, coarse):
    """What becomes of the step of each rocking lane; the length of one to be repeated.

    One with an error above `coarse`, or that is not finite, is doubtful.
    """
    for lane in range(LANES):
        t, h, side = z[Z_T + lane], z[Z_H + lane], z[Z_SIDE + lane]
        touching, landing = z[Z_TOUCHING + lane] == 0.0, z[Z_LANDING + lane]
{start}{end}        within = abs(q1_{r}) < z[Z_FALLEN + lane]
{within}        verdict, new_h = judge_gap(t, h, side, touching, landing, within, {gap})
        z[Z_VERDICT + lane] = verdict if z[Z_ERROR + lane] <= coarse else DOUBTFUL
        z[Z_H + lane] = new_h


def judge_held_lanes(z, coarse):
    """What becomes of the step of each lane in full contact: it stands where no foot lifts."""
    for lane in range(LANES):
{ground}{start}{end}{quintics}{sampled}        held = z[Z_SIDE + lane] == 0.0
        held &= z[Z_ERROR + lane] <= coarse
{held}        within = held
{within}        z[Z_VERDICT + lane] = STANDS if within else z[Z_VERDICT + lane]


def accept_lanes(z):
    """Move the lanes whose step stands to its end."""
    for lane in range(LANES):
        stands = z[Z_VERDICT + lane] >= STANDS
        repeated = z[Z_VERDICT + lane] == REPEATED
        t, h, last = z[Z_T + lane], z[Z_H + lane], z[Z_LAST + lane]
{start}{end}        z[Z_T + lane] = z[Z_T_NEW + lane] if stands else t
        z[Z_T_NEW + lane] = min(t + h, last) if repeated else z[Z_T_NEW + lane]
        z[Z_LANDING + lane] = z[Z_LANDING + lane] + 1.0 if repeated else 0.0
        z[Z_TOUCHING + lane] = -1.0 if stands else z[Z_TOUCHING + lane]
        z[Z_TAKEN + lane] = z[Z_TAKEN + lane] + 1.0
{taken}'''
