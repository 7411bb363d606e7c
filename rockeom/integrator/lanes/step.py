"""The text of one step of many lanes, and the numbers that lanes have of a structure and a method.

Only this is written for each structure: stage by stage by the words of `tableau.py`, as the step of
the loop is. The other work on lanes is `vectors.py`.
"""

from textwrap import indent

import numpy as np

from rockeom.codes import IMPACT, UPLIFT
from rockeom.integrator.methods.tableau import NODES, Tableau, _stage, error_text
from rockeom.integrator.schema import GeneratedModule

LANES = 16
"""Motions that step together: two of the widest vectors that processors have."""
ROOTS = 6
"""Powers of errors are products of their 2nd, 4th, ... 64th roots: exponents within a 128th."""


def _bits(exponent: float) -> tuple[bool, ...]:
    """Which of the roots of an error make a power of it."""
    bits = round(exponent * 2**ROOTS)
    return tuple(bool(bits >> (ROOTS - k) & 1) for k in range(1, ROOTS + 1))


def _padded(times: list[float], places: int) -> list[float]:
    return times + [1.0] * (places - len(times))


def gap_sides(generated: GeneratedModule) -> tuple[float, ...]:
    """The side of each mode that only an impact ends; 0 of all others."""
    return tuple(
        side if kinds[:guards] == (IMPACT,) else 0.0
        for side, guards, kinds in zip(
            generated.SIDES, generated.GUARDS, generated.KINDS, strict=True
        )
    )


def _parameters(generated: GeneratedModule) -> int:
    return len(generated.prepare(np.ones(len(generated.PARAMETERS))))


def numbers_text(method: Tableau, generated: GeneratedModule) -> str:
    """Source of the numbers that the step of lanes and their loop have in common."""
    # stage j is shaken as place j - 1, the last two, at the end of the step, as one
    times = method.c[1 : method.stages].tolist()
    assert method.c[method.stages] == times[-1]
    places = max(len(times), len(NODES))
    exponent = 1.0 / (method.error_order + 1)
    damping = round(0.4 * exponent * 2**ROOTS) / 2**ROOTS
    sides = gap_sides(generated)
    held = tuple(c for c, side in enumerate(sides) if side == 0.0)
    still = all(generated.KINDS[c][0] == UPLIFT for c in held)  # then it does not rotate, either
    n = generated.N_STATES // 2
    return f"""import numpy as np

LANES = {LANES}
N_PARAMETERS = {_parameters(generated)}
PLACES = {places}  # of a step at which the ground is found at once
STAGE_PLACES = np.array({_padded(times, places)!r})
NODE_PLACES = np.array({_padded(NODES.tolist(), places)!r})
ROOTS = {ROOTS}
# which roots make the powers of an error by which a step is divided: refused, taken; and damps
POWERS = {_bits(exponent), _bits(0.7 * exponent), _bits(damping)!r}
DAMPING = {damping!r}
GAP_SIDES = {sides!r}  # of modes that end by an impact alone; 0 of others
HELD_MODES = {held!r}  # the others, whose guards are all sampled in a step
MOVES = {tuple(i != generated.ROTATION or not still for i in range(n))!r}  # coordinates, in them
"""


def _accelerations(n: int, modes: int, held: bool) -> str:
    """A function of all modes without branches: what they have in common is found once.

    held : whether other modes than those of a gap need more than one set of equations.
    """
    arguments = ", ".join([f"q_{i}" for i in range(n)] + [f"v_{i}" for i in range(n)])
    text = f"\n\n@inlined\ndef accelerations_of_lanes(mode, {arguments}, p, ax, ay):\n"
    if not held:
        return f"{text}    return accelerations(mode, {arguments}, p, ax, ay)\n"
    for c in range(modes):
        names = ", ".join(f"{'b' if c else 'a'}_{i}" for i in range(n))
        text += f"    ({names},) = accelerations({c}, {arguments}, p, ax, ay)\n"
        if c:
            text += "".join(f"    a_{i} = b_{i} if mode == {c} else a_{i}\n" for i in range(n))
    return f"{text}    return ({', '.join(f'a_{i}' for i in range(n))},)\n"


def _row(rows: str, i: int) -> str:
    """The number of a lane in row i of several rows."""
    return f"z[{rows} + {i} * LANES + lane]"


def lanes_text(method: Tableau, generated: GeneratedModule) -> str:
    """Source of one step of `LANES` motions of a structure at once; `loop.py` says of what."""
    s, n = method.stages, generated.N_STATES // 2
    stages = ""
    for j in range(1, s + 1):
        place = min(j, s - 1) - 1
        ground = f"{_row('Z_AX', place)}, {_row('Z_AY', place)}"
        stages += indent(_stage(method, j, n, ground, "accelerations_of_lanes"), "    ")
    starts = "".join(
        f"        q0_{i}, v0_{i} = {_row('Z_Q', i)}, {_row('Z_K', i)}\n"
        f"        a0_{i} = {_row('Z_K', n + i)}\n"
        for i in range(n)
    )
    ends = "".join(
        f"        {_row('Z_Q_NEW', i)} = q{s}_{i}\n        {_row('Z_K_NEW', i)} = v{s}_{i}\n"
        f"        {_row('Z_K_NEW', n + i)} = a{s}_{i}\n"
        for i in range(n)
    )
    held = gap_sides(generated).count(0.0) > 1
    return f'''import math

from rockeom.compiler.decorators import Floats, entry, inlined
from rockeom.integrator.lanes.vectors import (
    Z_AX, Z_AY, Z_ERROR, Z_H, Z_K, Z_K_NEW, Z_MODE, Z_P, Z_Q, Z_Q_NEW,
)
from rockeom.integrator.provided import LANES, N_STATES, accelerations
{_accelerations(n, len(generated.MODES), held)}

@entry
def step_lanes(z: Floats, rtol: float, tolerances: Floats):
    """One step of all lanes: the states and accelerations at its end, and its estimated error."""
    atol = ({", ".join(f"tolerances[{i}]" for i in range(2 * n))},)
    for lane in range(LANES):
        mode, h = z[Z_MODE + lane], z[Z_H + lane]
        p = ({", ".join(_row("Z_P", i) for i in range(_parameters(generated)))},)
        hh = h * h
{starts}{stages}{ends}{indent(error_text(method, n, in_lanes=True), "    ")}\
        z[Z_ERROR + lane] = error
'''
