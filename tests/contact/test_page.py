"""What a page says of a structure on points holds in numbers: each equation read from its LaTeX.

The values stand for a random state of a mode, its accelerations and forces solved by numpy
(`tests.contact.kkt`), and rates after an impact by the same equations in impulses.
"""

import re
from functools import cache

import numpy as np
import pytest

import rockeom as rk
from rockeom.symbolic.impulse import AFTER, BEFORE, at_impact
from rockeom.symbolic.model import GROUND_X, GROUND_Y
from rockeom.symbolic.text.page import Display, Heading
from rockeom.symbolic.write.notation import Notation
from rockeom.symbolic.write.typeset import content
from tests.contact import kkt
from tests.symbolic.test_typeset import Reader

MODEL = rk.derive("sliding_block")
MODULE = rk.SlidingBlock(half_width=1.0, half_height=1.0, friction=0.1, restitution=0.0).module


@cache
def displays():
    """(heading of the modes, heading within, lines) of each display of equations."""
    found, states, part = [], "", ""
    for block in content(MODEL, "width"):
        if isinstance(block, Heading):
            states, part = (block.text, "") if block.level == 2 else (states, block.text)
        elif isinstance(block, Display) and states.startswith("Contact"):
            found.append((states, part, block.lines))
    return found


def shown(mode: str, part: str) -> tuple[str, ...]:
    (lines,) = (
        lines for states, where, lines in displays() if f"`{mode}`" in states and where == part
    )
    return lines


def values_in(mode: str, at_rest: bool):
    """(reader of what stands for this mode, its module's arguments)."""
    rng, m = np.random.default_rng(11), MODULE
    parameters = rng.uniform(0.5, 1.5, len(m.PARAMETERS))
    p, number = m.prepare(parameters), m.MODES.index(mode)
    y = np.zeros(6) if at_rest else kkt.put_on(m, number, rng.normal(0, 0.4, 6), p)
    ground = rng.normal(0, 1, 2)
    found = kkt.solve(m, number, y, p, *ground)
    values = dict(zip((x.symbol for x in MODEL.parameters), parameters, strict=True))
    values |= {GROUND_X: ground[0], GROUND_Y: ground[1]}
    for i, c in enumerate(MODEL.coordinates):
        values |= {c.position: y[i], c.velocity: y[3 + i], c.acceleration: found.accelerations[i]}
    state = next(s for s in MODEL.modes.states if s.name == mode)
    values |= MODEL.modes.signs(state)
    before = rng.normal(0, 1, 3)
    after = impact(number, y, p, before)
    for i, c in enumerate(MODEL.coordinates):
        values |= {at_impact(c, BEFORE): before[i], at_impact(c, AFTER): after[i]}
    reader = Reader(Notation(MODEL.free, MODEL), values)
    forces = {"N": found.normal.sum(), "F": sum(found.friction.values())}
    forces |= {rf"N_{{\mathrm{{{n}}}}}": found.normal[i] for i, n in enumerate(m.POINTS)}
    forces[r"F_{\mathrm{left+right}}"] = forces["F"]
    known = reader.values | forces
    names = "|".join(rf"{re.escape(n)}(?![A-Za-z_])" for n in sorted(known, key=len, reverse=True))
    reader.values = known
    skipped = r"(?P<skip>\s+|\\thinspace|\\left(?![a-z])|\\right(?![a-z])|\\bigl|\\bigr)"
    reader.token = re.compile(rf"{skipped}|({names}|\\[a-z]+|\d+|[-+=/^{{}}()\[\]])")
    return reader


def impact(mode: int, y, p, before):
    """Rates after, of M (q'+ - q'-) = W P, closed gaps opening e times as they closed."""
    m, n = MODULE, 3
    matrix, _, laws = np.zeros(n * n), np.zeros(n), np.zeros(2 * m.N_POINTS)
    m.free_motion(y, p, 0.0, 0.0, mode, matrix, np.zeros(n))
    m.point_laws(p, laws)
    at, states = kkt.points(m, y, p), m.POINT_STATES[mode]
    rows, right, pushes = [], [], []
    for i, state in enumerate(states):
        if state != kkt.OPEN:
            rows.append(at.normal[i])
            right.append(-laws[2 * i] * at.normal[i] @ before)
            pushes.append(at.normal[i] - laws[2 * i + 1] * kkt.sign(state) * at.along[i])
    for first, many in kkt.groups(m, mode).items():
        if states[many[0]] == kkt.STICK:
            rows.append(at.along[first])
            right.append(0.0)
            pushes.append(at.along[first])
    k = len(rows)
    system, known = np.zeros((n + k, n + k)), np.zeros(n + k)
    system[:n, :n] = matrix.reshape(n, n)
    known[:n] = system[:n, :n] @ before
    if k:
        system[:n, n:], system[n:, :n], known[n:] = -np.array(pushes).T, rows, right
    return np.linalg.solve(system, known)[:n]


PARTS = ("", "Equations of motion", "Forces of contact", "Impact")


@pytest.mark.parametrize("mode", MODULE.MODES)
@pytest.mark.parametrize("part", PARTS)
def test_each_equation_holds(mode, part):
    if mode == "flight" and part != "Equations of motion":
        return  # nothing is prescribed, nothing presses
    if mode == "both" and part == "Equations of motion":
        return  # it stands still
    read = values_in(mode, at_rest=False)
    for line in shown(mode, part):
        left, right = map(read, line.split(" = "))
        assert left == pytest.approx(right, rel=1e-9, abs=1e-9), line


@pytest.mark.parametrize("mode", [c for c in MODULE.MODES if c not in ("both", "flight")])
def test_each_beginning_from_rest_holds(mode):
    read = values_in(mode, at_rest=True)
    lines = shown(mode, "From rest")
    assert any(line.startswith("N") for line in lines)
    for line in lines:
        left, right = line.split(" = ")
        above, _, below = right.partition("] / [")
        if below:
            assert read(left) == pytest.approx(read(above[1:]) / read(below[:-1]), rel=1e-9)
        else:
            assert read(left) == pytest.approx(read(right), rel=1e-9), line


def test_a_page_of_many_coordinates_tells_the_free_structure_and_what_each_mode_prescribes():
    page = rk.derive("stacked_blocks").markdown()
    assert len(page) < 20_000
    for mode in rk.derive("stacked_blocks").modes.names:
        assert f"`{mode}`" in page
