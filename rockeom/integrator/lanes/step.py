"""The text of one step of many lanes, for the vectoriser of the compiler."""

from textwrap import indent
from typing import NamedTuple

import numpy as np

from rockeom.codes import IMPACT, UPLIFT
from rockeom.integrator.methods.tableau import (
    NODES,
    Tableau,
    _stage,
    _sum,
    bernstein_at,
    error_text,
    samples_to_bernstein,
)
from rockeom.integrator.schema import GeneratedModule

LANES = 16
"""Motions that step together: two of the widest vectors that processors have."""


def _padded(times: list[float], places: int) -> list[float]:
    return times + [1.0] * (places - len(times))


def _shaken(places: int) -> str:
    """Functions that find the ground at all places, by linear segments and by sines."""
    times = "".join(f"    c{j} = times[{j}]\n" for j in range(places))
    text = f"""

@entry
def shake_lanes(z: Floats, times: Floats):
    \"\"\"The ground at some times of a step, by linear segments.\"\"\"
{times}    for lane in range(LANES):
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

@entry
def bend_{name}_lanes(z: Floats, times: Floats):
    \"\"\"The same of lanes whose segment is a sine; others keep what they have.\"\"\"
{times}    for lane in range(LANES):
        t, h, start = z[Z_T + lane], z[Z_H + lane], z[Z_START_{axis} + lane]
        size, rate = z[Z_{axis}0 + lane], z[Z_{axis}1 + lane]
        angle, bent = z[Z_{axis}2 + lane], z[Z_KIND_{axis} + lane] == 1.0
"""
        for j in range(places):
            place = f"z[Z_A{axis} + {j} * LANES + lane]"
            text += f"        tau = t + c{j} * h\n"
            text += "        bend = size * sine(rate * (tau - start) + angle)\n"
            text += f"        {place} = bend if bent else {place}\n"
    return text


ROOTS = 6
"""Powers of errors are products of their 2nd, 4th, ... 64th roots."""


def _powers(exponent: float) -> str:
    """A power of `error` as a product of its roots r1, r2, ...; the exponent within a 128th."""
    bits = round(exponent * 2**ROOTS)
    return " * ".join(f"r{k}" for k in range(1, ROOTS + 1) if bits >> (ROOTS - k) & 1)


SINES = """import numpy as np
from rockeom.compiler.decorators import inlined


@inlined
def sine_cosine(x):
    \"\"\"Sine and cosine up to an eighth of a turn; not a number beyond, where the loop goes on.

    It has no branches, so that all modes share what they have of it.
    \"\"\"
    r = x if abs(x) <= 0.7853981633974483 else np.nan
    z = r * r
    zz = z * z
    s0 = -1 / 6 + z * (1 / 120)
    s1 = -1 / 5040 + z * (1 / 362880)
    s2 = -1 / 39916800 + z * (1 / 6227020800)
    c0 = 1 / 24 - z * (1 / 720)
    c1 = 1 / 40320 - z * (1 / 3628800)
    c2 = 1 / 479001600 - z * (1 / 87178291200)
    s1 += zz * (s2 - zz * (1 / 1307674368000))
    c1 += zz * (c2 + zz * (1 / 20922789888000))
    return r + r * z * (s0 + zz * s1), 1.0 - (0.5 * z - zz * (c0 + zz * c1))
"""
"""The step of lanes has it in place of a generated module's `sine_cosine`."""


def _accelerations(generated: GeneratedModule) -> str:
    """A function of all modes without branches: what they have in common is found once."""
    n = generated.N_STATES // 2
    arguments = ", ".join([f"q_{i}" for i in range(n)] + [f"v_{i}" for i in range(n)])
    text = f"\n\n@inlined\ndef accelerations_of_lanes(mode, {arguments}, p, ax, ay):\n"
    if len(_held(generated)) < 2:
        return f"{text}    return accelerations(mode, {arguments}, p, ax, ay)\n"
    for c in range(len(generated.MODES)):
        names = ", ".join(f"{'b' if c else 'a'}_{i}" for i in range(n))
        text += f"    ({names},) = accelerations({c}, {arguments}, p, ax, ay)\n"
        if c:
            text += "".join(f"    a_{i} = b_{i} if mode == {c} else a_{i}\n" for i in range(n))
    return f"{text}    return ({', '.join(f'a_{i}' for i in range(n))},)\n"


def gap_sides(generated: GeneratedModule) -> tuple[float, ...]:
    """The side of each mode that only an impact ends; 0 of all others."""
    return tuple(
        side if kinds[:guards] == (IMPACT,) else 0.0
        for side, guards, kinds in zip(
            generated.SIDES, generated.GUARDS, generated.KINDS, strict=True
        )
    )


def _held(generated: GeneratedModule) -> list[int]:
    """Modes whose guards are all sampled in a step."""
    return [c for c, side in enumerate(gap_sides(generated)) if side == 0.0]


def _sampled(generated: GeneratedModule) -> str:
    """Lines that find whether all guards clearly stay open, as `stays_held` of the loop does.

    They are sampled on the quintics through both ends of a step. A guard that a mode has
    not is open.
    """
    n, r, states = generated.N_STATES // 2, generated.ROTATION, _held(generated)
    still = all(generated.KINDS[c][0] == UPLIFT for c in states)  # then it does not rotate, either
    text = ""
    to_samples, to_slopes = bernstein_at(NODES, 5), 5.0 * bernstein_at(NODES, 4)
    moving = [i for i in range(n) if i != r or not still]
    for i in moving:
        text += f"        b0_{i}, b5_{i} = q0_{i}, q1_{i}\n"
        text += f"        b1_{i}, b4_{i} = q0_{i} + 0.2 * h * v0_{i}, q1_{i} - 0.2 * h * v1_{i}\n"
        text += f"        b2_{i} = q0_{i} + 0.4 * h * v0_{i} + 0.05 * h * h * a0_{i}\n"
        text += f"        b3_{i} = q1_{i} - 0.4 * h * v1_{i} + 0.05 * h * h * a1_{i}\n"
        text += "".join(f"        d{j}_{i} = (b{j + 1}_{i} - b{j}_{i}) / h\n" for j in range(5))
    functions = generated.N_GUARDS + generated.N_PARTS
    for m in range(len(NODES)):
        for i in range(n):
            q = v = "0.0"
            if i in moving:
                q = _sum(to_samples[m], f"b{{}}_{i}", " " * 12)
                v = _sum(to_slopes[m], f"d{{}}_{i}", " " * 12)
            text += f"        y[{i}] = (\n            {q}\n        )\n"
            text += f"        y[{n + i}] = (\n            {v}\n        )\n"
        text += f"        ax, ay = z[Z_AX + {m} * LANES + lane], z[Z_AY + {m} * LANES + lane]\n"
        for c in states:
            text += "".join(f"        g[{f}] = 1.0\n" for f in range(functions))
            text += f"        guards({c}, y, p, ax, ay, g)\n"
            for f in range(functions):
                other = f"g[{f}]" if c == states[0] else f"g[{f}] if mode == {c} else g{f}_{m}"
                text += f"        g{f}_{m} = {other}\n"
    for f in range(functions):
        text += f"        most = abs(g{f}_0)\n"
        text += "".join(f"        most = max(most, abs(g{f}_{m}))\n" for m in range(1, 8))
        text += f"        open_{f} = True\n"
        for row in samples_to_bernstein():
            coefficient = _sum(row, f"g{f}_{{}}", " " * 12)
            text += f"        open_{f} &= (\n            {coefficient}\n        ) > CLEAR * most\n"
    text += "        held = True\n"
    for guard in range(generated.N_GUARDS):
        text += f"        clear = open_{guard}\n"
        for place in range(generated.N_GUARDS, functions, 2):
            of = [c for c in states if generated.PARTS[c][guard] == place]
            if of:  # the larger of two parts
                where = " | ".join(f"(mode == {c})" for c in of)
                text += f"        clear = (open_{place} | open_{place + 1}) if {where} else clear\n"
        text += "        held &= clear\n"
    return text


def _at(rows: str, i: int) -> str:
    """The number of a lane in row i of several rows."""
    return f"z[{rows} + {i} * LANES + lane]"


class _Lines(NamedTuple):
    """Lines of a loop over the lanes that several functions have.

    step : time, length and parameters. start, end : the coordinates, their rates and accelerations
    at both ends of the step. within : whether no state has a new extreme between them.
    """

    step: str
    start: str
    end: str
    within: str


def _lines(generated: GeneratedModule, parameters: int) -> _Lines:
    n = generated.N_STATES // 2
    step = f"""        t, h = z[Z_T + lane], z[Z_H + lane]
        p = ({", ".join(_at("Z_P", i) for i in range(parameters))},)
"""
    start = end = within = ""
    for i in range(n):
        start += f"        q0_{i} = {_at('Z_Q', i)}\n"
        start += f"        v0_{i} = {_at('Z_K', i)}\n        a0_{i} = {_at('Z_K', n + i)}\n"
        end += f"        q1_{i} = {_at('Z_Q_NEW', i)}\n"
        end += f"        v1_{i} = {_at('Z_K_NEW', i)}\n        a1_{i} = {_at('Z_K_NEW', n + i)}\n"
        within += f"""        within &= turns_within(
            h, Ends(q0_{i}, v0_{i}, a0_{i}, q1_{i}, v1_{i}, a1_{i}),
            {_at("Z_LEAST", i)}, {_at("Z_MOST", i)},
            {_at("Z_LEAST", n + i)}, {_at("Z_MOST", n + i)},
        )
"""
    return _Lines(step, start, end, within)


_IMPORTS = """import math

import numpy as np
from rockeom.compiler.decorators import Floats, entry, inlined
from rockeom.integrator.tolerances import CLEAR, EPS, LEAST_ERROR
from rockeom.integrator.ground import sine
from rockeom.integrator.lanes.loop import (
    Z_AX, Z_AY, Z_CLOSED, Z_DAMP, Z_EQUAL, Z_ERROR, Z_FALLEN, Z_H, Z_K, Z_KIND_X, Z_KIND_Y, Z_K_NEW,
    Z_LANDING, Z_LAST, Z_LEAST, Z_MODE, Z_MOST, Z_NEXT, Z_P, Z_Q, Z_Q_NEW, Z_SIDE, Z_START_X,
    Z_START_Y, Z_T, Z_TAKEN, Z_T_NEW, Z_VERDICT, Z_X0, Z_X1, Z_X2, Z_Y0, Z_Y1, Z_Y2,
)
from rockeom.integrator.lanes.verdicts import (
    DOUBTFUL, REFUSED, REPEATED, STANDS, TURNS, judge_gap, turns_within,
)
from rockeom.integrator.polynomials import Ends
from rockeom.integrator.provided import LANES, N_STATES, accelerations, guards
"""


def numbers_text(method: Tableau, generated: GeneratedModule) -> str:
    """Source of the numbers that the step of lanes and their loop have in common."""
    # stage j is shaken as place j - 1, the last two, at the end of the step, as one
    times = method.c[1 : method.stages].tolist()
    assert method.c[method.stages] == times[-1]
    places = max(len(times), len(NODES))
    return f"""import numpy as np

LANES = {LANES}
N_PARAMETERS = {_parameters(generated)}
PLACES = {places}  # of a step at which the ground is found at once
STAGE_PLACES = np.array({_padded(times, places)!r})
NODE_PLACES = np.array({_padded(NODES.tolist(), places)!r})
DAMPING = {_damping(method)!r}
GAP_SIDES = {gap_sides(generated)!r}  # of modes that end by an impact alone; 0 of others
"""


def _parameters(generated: GeneratedModule) -> int:
    return len(generated.prepare(np.ones(len(generated.PARAMETERS))))


def _exponent(method: Tableau) -> float:
    return -1.0 / (method.error_order + 1)


def _damping(method: Tableau) -> float:
    return round(-0.4 * _exponent(method) * 2**ROOTS) / 2**ROOTS


def lanes_text(method: Tableau, generated: GeneratedModule) -> str:
    """Source of one step of `LANES` motions of a structure at once; `loop.py` says of what.

    Each loop over the lanes holds the whole work of a lane in plain numbers and without branches,
    at places that differ by constants: so the compiler makes vector instructions of it.
    """
    lines = _lines(generated, _parameters(generated))
    places = max(method.stages - 1, len(NODES))
    return "".join(
        (
            _IMPORTS,
            _accelerations(generated),
            _shaken(places),
            _control(_exponent(method), _damping(method)),
            _step(method, generated, lines),
            _judge(generated, lines),
            _judge_held(generated, lines),
            _accept(generated, lines),
        )
    )


def _control(exponent: float, damping: float) -> str:
    roots = "        r1 = math.sqrt(error)\n"
    roots += "".join(f"        r{k} = math.sqrt(r{k - 1})\n" for k in range(2, ROOTS + 1))
    return f'''

@entry
def control_lanes(z: Floats):
    """The next step of each lane by proportional-integral control, as in the loop.

    A step that is cut, or is to end at an impact, says nothing of it unless it is refused. Powers
    are products of roots.
    """
    for lane in range(LANES):
        h, error, last = z[Z_H + lane], max(z[Z_ERROR + lane], LEAST_ERROR), z[Z_DAMP + lane]
        equal = z[Z_EQUAL + lane] > 0.0
{roots}        refused = (error > 1.0) & ~equal
        cut, first = z[Z_T_NEW + lane] >= z[Z_LAST + lane], z[Z_LANDING + lane] == 0.0
        tells = (error <= 1.0) & first & ~cut & ~equal
        factor = (0.9 if refused else 0.9 * last) / (
            {_powers(-exponent)} if refused else {_powers(-0.7 * exponent)}
        )
        factor = max(0.1 if refused else 0.2, factor)
        z[Z_NEXT + lane] = h * min(5.0, factor) if refused | tells else z[Z_NEXT + lane]
        z[Z_DAMP + lane] = {_powers(damping)} if tells else last
'''


def _step(method: Tableau, generated: GeneratedModule, lines: _Lines) -> str:
    s, n = method.stages, generated.N_STATES // 2
    atol = ", ".join(f"tolerances[{i}]" for i in range(2 * n))

    def stage(j: int) -> str:
        place = min(j, s - 1) - 1
        ground = f"{_at('Z_AX', place)}, {_at('Z_AY', place)}"
        return _stage(method, j, n, ground, "accelerations_of_lanes")

    stages = indent("".join(stage(j) for j in range(1, s + 1)), "    ")
    ends = "".join(
        f"        {_at('Z_Q_NEW', i)} = q{s}_{i}\n        {_at('Z_K_NEW', i)} = v{s}_{i}\n"
        f"        {_at('Z_K_NEW', n + i)} = a{s}_{i}\n"
        for i in range(n)
    )
    errors = indent(error_text(method, n, in_lanes=True), "    ")
    return f'''

@entry
def step_lanes(z: Floats, rtol: float, tolerances: Floats):
    """One step of all lanes: the states and accelerations at its end, and its estimated error."""
    atol = ({atol},)
    for lane in range(LANES):
        mode = z[Z_MODE + lane]
{lines.step}        hh = h * h
{lines.start}{stages}{ends}{errors}        z[Z_ERROR + lane] = error
'''


def _judge(generated: GeneratedModule, lines: _Lines) -> str:
    r = generated.ROTATION
    return f'''

@entry
def judge_lanes(z: Floats, coarse: float):
    """What becomes of the step of each rocking lane; the length of one to be repeated.

    One with an error above its bound, `coarse` for an equal step, is refused, or doubtful if it is
    an equal one; as one that is not finite.
    """
    for lane in range(LANES):
        t, h, side = z[Z_T + lane], z[Z_H + lane], z[Z_SIDE + lane]
        closed, landing = z[Z_CLOSED + lane] == 0.0, z[Z_LANDING + lane]
{lines.start}{lines.end}        upright, within = abs(q1_{r}) < z[Z_FALLEN + lane], True
{lines.within}        verdict, new_h = judge_gap(
            t, h, z[Z_LAST + lane] - t, side, closed, landing, upright, within,
            Ends(q0_{r}, v0_{r}, a0_{r}, q1_{r}, v1_{r}, a1_{r}),
        )
        error, equal = z[Z_ERROR + lane], z[Z_EQUAL + lane] > 0.0
        refused = (error > 1.0) & (error < np.inf) & (h > 64.0 * EPS * t) & ~equal
        verdict = verdict if error <= (coarse if equal else 1.0) else DOUBTFUL
        z[Z_VERDICT + lane] = REFUSED if refused else verdict
        z[Z_H + lane] = h if refused else new_h
'''


def _judge_held(generated: GeneratedModule, lines: _Lines) -> str:
    held, r = _held(generated), generated.ROTATION
    mode = "z[Z_MODE + lane]" if len(held) > 1 else held[0]
    functions = generated.N_GUARDS + generated.N_PARTS
    return f'''

@entry
def judge_held_lanes(z: Floats, coarse: float):
    """What becomes of the step of each lane in other modes: it stands where they last."""
    y, g = np.empty({generated.N_STATES}), np.empty({functions})
    for lane in range(LANES):
        mode = {mode}
{lines.step}{lines.start}{lines.end}{_sampled(generated)}        held &= z[Z_SIDE + lane] == 0.0
        held &= abs(q1_{r}) < z[Z_FALLEN + lane]
        held &= z[Z_ERROR + lane] <= (coarse if z[Z_EQUAL + lane] > 0.0 else 1.0)
        within = True
{lines.within}        stands = STANDS if within else TURNS
        z[Z_VERDICT + lane] = stands if held else z[Z_VERDICT + lane]
'''


def _accept(generated: GeneratedModule, lines: _Lines) -> str:
    n, moved = generated.N_STATES // 2, ""
    for i in range(n):
        moved += f"        {_at('Z_Q', i)} = q1_{i} if stands else q0_{i}\n"
        moved += f"        {_at('Z_K', i)} = v1_{i} if stands else v0_{i}\n"
        moved += f"        {_at('Z_K', n + i)} = a1_{i} if stands else a0_{i}\n"
        for state, old, new in ((i, f"q0_{i}", f"q1_{i}"), (n + i, f"v0_{i}", f"v1_{i}")):
            least, most = _at("Z_LEAST", state), _at("Z_MOST", state)
            moved += f"        {least} = min({least}, {new} if stands else {old})\n"
            moved += f"        {most} = max({most}, {new} if stands else {old})\n"
    return f'''

@entry
def accept_lanes(z: Floats):
    """Move the lanes whose step stands to its end."""
    for lane in range(LANES):
        stands = z[Z_VERDICT + lane] >= STANDS
        repeated = z[Z_VERDICT + lane] == REPEATED
        t, h = z[Z_T + lane], z[Z_H + lane]
{lines.start}{lines.end}        z[Z_T + lane] = z[Z_T_NEW + lane] if stands else t
        z[Z_T_NEW + lane] = t + h if repeated else z[Z_T_NEW + lane]
        landing = z[Z_LANDING + lane]
        kept = landing if z[Z_VERDICT + lane] == TURNS else 0.0
        z[Z_LANDING + lane] = max(landing, 0.0) + 1.0 if repeated else kept
        z[Z_CLOSED + lane] = -1.0 if stands else z[Z_CLOSED + lane]
        z[Z_TAKEN + lane] = z[Z_TAKEN + lane] + 1.0
{moved}'''
