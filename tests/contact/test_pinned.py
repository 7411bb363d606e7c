"""Feet that are pinned: a free structure on them is the rocking structure of the same masses."""

from dataclasses import replace

import numpy as np
import pytest
import sympy as sp

import rockeom as rk
from rockeom.codegen import module_text
from rockeom.generated import flexible_structure as flexible_structure_module
from rockeom.integrator.texts import load_text
from rockeom.symbolic import (
    Body,
    Contact,
    Model,
    Pinned,
    Rigid,
    RockingModel,
    Unilateral,
    coordinate,
    feet,
    parameter,
    registry,
    turned,
)
from rockeom.symbolic.algebra import tidy
from rockeom.symbolic.lagrange import rate
from rockeom.symbolic.model import GROUND_X, GROUND_Y
from rockeom.symbolic.modes.balance import free_motion
from rockeom.symbolic.reactions import reactions
from rockeom.symbolic.structures.flexible import flexible_structure
from rockeom.symbolic.structures.rigid_block import rigid_block
from tests.contact import declared
from tests.contact.declared import X, Y

NEVER_SLIPS = Rigid(restitution=sp.S.Zero, friction=None)
SIDES = (("left", -1), ("right", 1))


def placed(point, angle):
    """A point of a base whose centre is at (x, y)."""
    return declared.placed(point, theta=angle)


def freed(shipped: RockingModel, masses, width, **changes) -> Model:
    """The masses of a shipped structure, its base free to move, on pinned feet."""
    theta = shipped.rotation.position
    what = {
        "name": f"free_{shipped.name}",
        "title": shipped.title,
        "parameters": shipped.parameters,
        "coordinates": (X, Y, *shipped.coordinates),
        "bodies": masses,
        "gravity": shipped.modes[0].gravity,
        "rotation": shipped.rotation,
        "contacts": feet(
            gap=lambda s: placed((s * width, 0), theta)[1],
            slip=lambda s: placed((s * width, 0), theta)[0],
            law=Pinned(),
        ),
        "load_point": masses[0].position,
        "reference": shipped.reference,
    }
    return Model(**(what | changes))


HOUSNER = rigid_block()
M, B, H, INERTIA, G = (p.symbol for p in HOUSNER.parameters)
THETA = HOUSNER.rotation
POLAR = HOUSNER.modes[0].bodies[0].polar
BLOCK = Body("block", M, placed((0, H), THETA.position), INERTIA, THETA.position, POLAR)


def block(**changes) -> Model:
    return freed(HOUSNER, (BLOCK,), B, **changes)


COLUMN = flexible_structure()
NAMED = {p.name: p.symbol for p in COLUMN.parameters}


def column() -> Model:
    theta, u = (c.position for c in COLUMN.coordinates)
    bodies = (
        Body("superstructure", NAMED["mass"], placed((u, NAMED["height"]), theta),
             NAMED["inertia"], theta),
        Body("base", NAMED["base_mass"], placed((0, NAMED["base_height"]), theta),
             NAMED["base_inertia"], theta),
    )  # fmt: skip
    return freed(
        COLUMN,
        bodies,
        NAMED["half_width"],
        elastic_energy=NAMED["stiffness"] * u**2 / 2,
        dissipation=NAMED["damping"] * COLUMN.coordinates[1].velocity ** 2 / 2,
    )


STRUCTURES = {"rigid block": (block, HOUSNER), "elastic column": (column, COLUMN)}


def same(one, other) -> bool:
    return all(tidy(a - b) == 0 for a, b in zip(one, other, strict=True))


@pytest.mark.parametrize("which", STRUCTURES)
def test_the_shipped_structure_comes_out(which):
    """Equations, impacts, reactions and transitions, with symbolically zero difference."""
    declare, shipped = STRUCTURES[which]
    found = declare().reduced
    assert isinstance(found, RockingModel)
    assert (found.mode_names, found.coordinates) == (shipped.mode_names, shipped.coordinates)
    assert found.transitions == shipped.transitions
    for mine, theirs in zip(found.modes, shipped.modes, strict=True):
        assert mine.coordinates == theirs.coordinates
        assert same(*(p.equations.residual for p in (mine, theirs)))
        pairs = [reactions(model, p) for model, p in ((found, mine), (shipped, theirs))]
        assert pairs[0].keys() == pairs[1].keys()
        assert same(*(forces.values() for forces in pairs))
    for target in ("left", "both"):
        assert found.impulse_map("right", target).equals(shipped.impulse_map("right", target))
    assert tidy(sp.cancel(found.velocity_ratio - shipped.velocity_ratio)) == 0


def test_the_block_moves_as_the_shipped_one():
    """In machine code, from rest: full contact, impacts of either foot."""
    values = {"mass": 300.0, "half_width": 0.1, "inertia": 26.0}
    structures = (
        rk.structure(block(), **values, height=0.5, gravity=9.81),
        rk.RigidBlock(**values, half_height=0.5, gravity=9.81),
    )
    shaking = rk.GroundMotion.harmonic(2.5, period=0.3, duration=4.0)
    runs = [rk.simulate(each, shaking) for each in structures]
    mine, theirs = runs
    assert len(theirs.impacts) > 3
    assert {*theirs.mode} == {"left", "both", "right"}
    assert len(mine.impacts) == len(theirs.impacts)
    for name in ("theta", "theta_dot", "right_reaction", "displacement", "left_uplift"):
        scale = np.abs(theirs[name]).max()
        assert np.abs(mine[name] - theirs[name]).max() < 1e-9 * scale


def test_the_column_computes_what_the_shipped_one_does():
    """Its module, at random states in each mode and over both impacts."""
    mine, theirs = load_text("free_column", module_text(column())), flexible_structure_module
    assert (mine.MODES, mine.KINDS, mine.TARGETS) == (
        theirs.MODES, theirs.KINDS, theirs.TARGETS,
    )  # fmt: skip
    rng = np.random.default_rng(1)
    p = theirs.prepare(rng.uniform(0.5, 2.0, len(theirs.PARAMETERS)))
    for mode, side in enumerate(theirs.SIDES):
        y = rng.uniform(-0.3, 0.3, theirs.N_STATES)
        y[0] = side * abs(y[0])

        def found(module, y=y, mode=mode, side=side):
            out = np.zeros((7, 4))
            module.rates(mode, y, p, 0.3, 0.1, out[0])
            module.guards(mode, y, p, 0.3, 0.1, out[1])
            module.energies(mode, y, p, out[2])
            module.reactions(mode, y, p, 0.3, 0.1, out[3])
            module.kinematics(mode, y, p, out[4])
            if side:
                closed = np.array([0.0, *y[1:]])
                module.impulse_to_opposite(side, closed, p, out[5])
                module.impulse_to_both(side, closed, p, out[6])
            return out

        there = found(theirs)
        assert np.abs(there).max(axis=1)[:5].all()
        np.testing.assert_allclose(found(mine), there, rtol=1e-12, atol=1e-13)


# --- against what Newton's laws say of the free structure


@pytest.mark.parametrize(("foot", "side"), SIDES)
def test_a_spring_to_the_ground_takes_its_part(foot, side):
    """Forces of the feet balance the free structure, whose base is tied to the ground."""
    k, c = (parameter(name, name, "", "of the tie") for name in ("k", "c"))
    tied = block(
        parameters=(*HOUSNER.parameters, k, c),
        elastic_energy=k.symbol * (X.position**2 + X.position * Y.position + Y.position**2) / 2,
        dissipation=c.symbol * (X.velocity**2 + 2 * Y.velocity**2) / 2,
    )
    found = tied.reduced
    mode = found.mode(foot)
    forces = {k: e.subs(sp.Symbol("s", real=True), side) for k, e in reactions(found, mode).items()}
    # where the base goes while it turns about the foot, by a drawing
    theta = THETA.position
    moved = (side * B * (1 - sp.cos(theta)), side * B * sp.sin(theta))
    put = {}
    for q, place in zip((X, Y), moved, strict=True):
        speed = rate(place, (THETA,))
        put |= {q.position: place, q.velocity: speed, q.acceleration: rate(speed, (THETA,))}
    matrix, given = free_motion(tied)
    accelerations = sp.Matrix([q.acceleration for q in tied.coordinates])
    lacking = (matrix * accelerations - given).subs(put)
    assert tidy(lacking[0] - forces["horizontal_reaction"]) == 0
    assert tidy(lacking[1] - forces[f"{foot}_reaction"]) == 0
    # what is left is the moment of these two about the base's centre
    across, up = (-e + (side * B if i == 0 else 0) for i, e in enumerate(moved))
    moment = forces["horizontal_reaction"] * up - forces[f"{foot}_reaction"] * across
    equation = found.equations(foot).residual[0]
    assert tidy(lacking[2] - moment - equation) == 0
    assert {GROUND_X, GROUND_Y} <= equation.free_symbols


# --- how it is used


def test_a_declared_one_is_derived_like_any(monkeypatch):
    monkeypatch.setitem(registry.FAMILIES, "free_rigid_block", block)
    assert rk.derive("free_rigid_block").equations("right").mass_matrix.shape == (1, 1)


def test_the_page_is_that_of_the_shipped_one():
    assert block().latex("polar") == replace(HOUSNER, sources={}).latex("polar")


# --- what is refused

U = coordinate("u", "u", "m", "of something else")
D = parameter("d", "d", "m", "a length")
THIRD = Contact("bumper", *reversed(placed((0, D.symbol), THETA.position)), law=NEVER_SLIPS)
MORE = {"parameters": (*HOUSNER.parameters, D)}


def pair(place, law=None, **more):
    return feet(gap=lambda s: place(s)[1], slip=lambda s: place(s)[0], law=law or Pinned(), **more)


def corner(s):
    return placed((s * B, 0), THETA.position)


def on_a_slope(s):
    cos, sin = sp.cos(D.symbol), sp.sin(D.symbol)
    x, y = placed((s * B * cos, s * B * sin), THETA.position)
    return x * cos + y * sin, y * cos - x * sin


REFUSED = {
    "another law beside them": (
        MORE | {"contacts": (*pair(corner), THIRD)}, "left, right, bumper not all are Pinned",
    ),
    "two pairs": (
        MORE | {"contacts": (
            *pair(corner),
            *pair(lambda s: placed((s * B / 2, D.symbol), THETA.position), names=("a", "b")),
        )},
        "left, right, a, b: two feet",
    ),
    "one foot": ({"contacts": (replace(THIRD, gap=corner(1)[1], slip=corner(1)[0], law=Pinned()),)},
                 "bumper: two feet"),
    "a spring beside them": (
        {"elements": (Unilateral("pad", -Y.position, M),)}, "element 'pad' stands next to",
    ),
    "other names": ({"contacts": pair(corner, names=("west", "east"))}, "call them left and right"),
    "left and right in exchange": (
        {"contacts": pair(corner, names=("right", "left"))}, "call them left and right",
    ),
    "different heights": (
        MORE | {"contacts": pair(lambda s: placed((s * B, s * D.symbol), THETA.position))},
        "gaps of its pinned feet are -d of 'left', d of 'right'",
    ),
    "a height that is not from the ground": (
        {"contacts": pair(lambda s: (corner(s)[0], corner(s)[1] - H))}, "must stand on the ground",
    ),
    "a slope": (MORE | {"contacts": pair(on_a_slope)}, "as they move the pinned feet"),
    "a mass that the ground carries": (
        {"coordinates": (X, Y, THETA, U),
         "bodies": (BLOCK, Body("frame", M, (U.position, H)))},
        "x and y do not move body 'frame'",
    ),
    "a base that is guided": (
        {"bodies": (replace(BLOCK, position=turned((0, H), (0, 0), THETA.position)),),
         "contacts": pair(lambda s: turned((s * B, 0), (0, 0), THETA.position)),
         "coordinates": (THETA,), "load_point": None},
        "no two coordinates are fixed",
    ),
    "feet that spread": (
        {"coordinates": (X, Y, THETA, U),
         "contacts": pair(lambda s: placed((s * (B + U.position), 0), THETA.position))},
        "the slip of the left one changes with u",
    ),
    "feet that meet elsewhere": (
        {"contacts": pair(lambda s: (corner(s)[0] - s * B, corner(s)[1]))},
        "their slip must be their place",
    ),
    "a rotation to the other side": (
        {"bodies": (Body("block", M, placed((0, H), -THETA.position), INERTIA, -THETA.position),),
         "contacts": pair(lambda s: placed((s * B, 0), -THETA.position))},
        "turns counterclockwise",
    ),
    "a support for a law": ({"contacts": lambda: pair(corner, law=rk.Pinned())}, "symbolic"),
}  # fmt: skip


@pytest.mark.parametrize("what", REFUSED)
def test_what_no_pair_of_pinned_feet_can_be_is_refused(what):
    changes, told = REFUSED[what]
    with pytest.raises(ValueError, match=told) as error:
        block(**{k: v() if callable(v) else v for k, v in changes.items()})
    ways = ("Rigid(restitution", "give the rotation its other sign")
    assert any(way in str(error.value) for way in ways)


def test_masses_off_the_middle_have_no_ratio_of_both_feet():
    """Each foot has its own: conservation of the angular momentum is then the impact map."""
    aside = replace(BLOCK, position=placed((D.symbol, H), THETA.position), polar=None)
    names: dict = {}
    for bodies, of_both in (((BLOCK,), True), ((aside,), False)):
        text = module_text(block(**MORE, bodies=bodies))
        exec(compile(text, "module", "exec"), names)
        ratio = names["velocity_ratio"](np.full(len(names["PARAMETERS"]), 0.5))
        assert np.isfinite(ratio) == of_both


def test_modes_of_feet_that_slide_are_not_those_of_pinned_ones():
    with pytest.raises(ValueError, match=r"left, both, right: see `model\.reduced`"):
        block().mode("flight")


def test_pinned_feet_have_no_restitution():
    with pytest.raises(TypeError):
        Pinned(restitution=0.5)
