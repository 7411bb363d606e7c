"""The comparison with the thesis notices a structure, or an engine, that is slightly wrong."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import pytest
import sympy as sp

from rockeom.symbolic import SHIPPED, RockingModel, impulse, lagrange
from rockeom.symbolic.mode import Mode
from rockeom.symbolic.model import GROUND_X, Body
from rockeom.thesis import EQUATIONS, Verdict, decide, notation as th
from rockeom.thesis.checks.engine import THETA, B, compared, shipped, values_of_shipped
from rockeom.thesis.comparison import PIER, in_engine_notation, normal_form

U, H_E, H_B = PIER["u"], PIER["height"], PIER["base_height"]


def notices(number: str, model: RockingModel) -> bool:
    """Whether the corrected equation differs from what `model` gives, on any of its sides."""
    equation = EQUATIONS[number]
    return any(
        not finding.holds
        for side in equation.sides
        for finding in compared(number, equation.right, side, model)
    )


def bodies(model: RockingModel, change: Callable[[Body], Body], name: str = "") -> RockingModel:
    """The model with `change` made to its bodies, or to the one called `name`."""

    def altered(mode: Mode) -> Mode:
        new = tuple(change(b) if name in ("", b.name) else b for b in mode.bodies)
        at = [b.position for b in mode.bodies].index(mode.load_point)
        return replace(mode, bodies=new, load_point=new[at].position)

    return replace(model, modes=tuple(altered(mode) for mode in model.modes))


def modes(model: RockingModel, change: Callable[[Mode], Mode]) -> RockingModel:
    return replace(model, modes=tuple(change(mode) for mode in model.modes))


def twice(constant: str) -> Callable[[Mode], Mode]:
    """With twice the stiffness or damping of each element."""

    def change(mode: Mode) -> Mode:
        found = (replace(e, **{constant: 2 * getattr(e, constant)}) for e in mode.elements)
        return replace(mode, elements=tuple(found))

    return change


def placed(body: Body, put: dict) -> Body:
    x, y = (sp.sympify(e).subs(put, simultaneous=True) for e in body.position)
    return replace(body, position=(x, y))


def spinless(body: Body) -> Body:
    return replace(body, inertia=sp.Integer(0))


def pushed_along_the_ground(body: Body) -> Body:
    x, y = placed(body, {U: 0}).position
    return replace(body, position=(x + U, y))


@dataclass(frozen=True)
class Mutation:
    structure: str
    change: Callable[[RockingModel], RockingModel]
    noticed_by: tuple[str, ...]


FLEXIBLE, RIGID, BLOCK = "flexible_structure", "lumped_mass_structure", "rigid_block"
SPRINGS, CART = "two_spring_structure", "two_spring_cart"

MUTATIONS = {
    "superstructure on the wrong side of the pivot": Mutation(
        FLEXIBLE,
        lambda m: bodies(m, lambda b: placed(b, {B: -B}), "superstructure"),
        ("5-34", "5-35", "D-1", "D-11", "D-13", "D-17", "D-21"),
    ),
    "superstructure without rotary inertia": Mutation(
        FLEXIBLE, lambda m: bodies(m, spinless, "superstructure"), ("5-34", "D-8", "D-11")
    ),
    "base without rotary inertia": Mutation(
        FLEXIBLE, lambda m: bodies(m, spinless, "base"), ("5-34", "D-12", "D-14")
    ),
    "gravity upwards": Mutation(
        FLEXIBLE,
        lambda m: modes(m, lambda p: replace(p, gravity=-p.gravity)),
        ("5-34", "5-35", "D-13", "D-23", "D-24"),
    ),
    "elastic energy k u**2": Mutation(
        FLEXIBLE,
        lambda m: modes(m, twice("stiffness")),
        ("5-35", "D-13", "D-20", "D-24", "D-26"),
    ),
    "dissipation c u'**2": Mutation(
        FLEXIBLE,
        lambda m: modes(m, twice("damping")),
        ("5-35", "D-15", "D-20"),
    ),
    "deformation along the ground instead of across the column": Mutation(
        FLEXIBLE,
        lambda m: bodies(m, pushed_along_the_ground, "superstructure"),
        ("5-34", "5-35", "5-37", "D-3", "D-18"),
    ),
    "base turning anticlockwise": Mutation(
        FLEXIBLE, lambda m: bodies(m, lambda b: placed(b, {THETA: -THETA}), "base"), ("5-34", "D-2")
    ),
    "heights exchanged": Mutation(
        FLEXIBLE,
        lambda m: bodies(m, lambda b: placed(b, {H_E: H_B, H_B: H_E})),
        ("5-34", "5-35", "D-1", "D-2"),
    ),
    "rigid structure without rotary inertia": Mutation(
        RIGID, lambda m: bodies(m, spinless), ("5-8", "5-9", "5-10", "5-12", "5-13", "5-14")
    ),
    "base of the rigid structure on the wrong side": Mutation(
        RIGID,
        lambda m: bodies(m, lambda b: placed(b, {B: -B}), "base"),
        ("5-9", "5-10", "5-11", "5-31"),  # its impact is even in B
    ),
    "block without rotary inertia": Mutation(
        BLOCK, lambda m: bodies(m, spinless), ("2-2", "2-6", "2-9")
    ),
    "block on the wrong side of its edge": Mutation(
        BLOCK, lambda m: bodies(m, lambda b: placed(b, {B: -B})), ("2-2", "2-9", "3-6", "3-9")
    ),
    "springs twice as stiff": Mutation(
        SPRINGS,
        lambda m: modes(m, twice("stiffness")),
        ("5-16", "5-24"),
    ),
    "springs with gravity upwards": Mutation(
        SPRINGS,
        lambda m: modes(m, lambda p: replace(p, gravity=-p.gravity)),
        ("5-17", "5-24"),
    ),
    "cart without the base's mass": Mutation(
        CART,
        lambda m: bodies(m, lambda b: replace(b, mass=PIER["mass"])),
        ("5-15",),
    ),
}


@pytest.mark.parametrize("name", MUTATIONS)
def test_wrong_structure_is_noticed(name):
    mutation = MUTATIONS[name]
    model = mutation.change(SHIPPED[mutation.structure]())
    assert [n for n in mutation.noticed_by if not notices(n, model)] == []


def test_unchanged_copy_raises_no_alarm():
    copy = modes(bodies(SHIPPED[FLEXIBLE](), lambda body: placed(body, {})), replace)
    assert [n for n in ("5-34", "5-35", "5-37", "D-1", "D-13", "D-18") if notices(n, copy)] == []


# --- as `verify` sees it, for every shipped structure


def _twice_each(constant: str) -> Callable[[RockingModel], RockingModel]:
    return lambda model: modes(model, twice(constant))


def _twice_the_force(model: RockingModel) -> RockingModel:
    return modes(model, lambda p: replace(p, forces=tuple(2 * f for f in p.forces)))


def _backwards(model: RockingModel) -> RockingModel:
    return modes(model, lambda p: replace(p, forces=tuple(-f for f in p.forces)))


def _upwards(model: RockingModel) -> RockingModel:
    return modes(model, lambda p: replace(p, gravity=-p.gravity))


def _heavier(model: RockingModel) -> RockingModel:
    """The first mass, 1 % more."""
    name = model.modes[0].bodies[0].name
    more = sp.Rational(101, 100)
    return bodies(model, lambda b: replace(b, mass=more * b.mass), name)


DECIDED = {
    "rigid_block, gravity upwards": ("rigid_block", _upwards, "2-9"),
    "rigid_block, mass but not inertia 1 % more": ("rigid_block", _heavier, "2-6"),
    "slender_block, gravity upwards": ("slender_block", _upwards, "2-3"),
    "nondimensional_block, gravity upwards": ("nondimensional_block", _upwards, "2-13"),
    "dirac_delta_block, printed sign of the force": ("dirac_delta_block", _backwards, "2-29"),
    "dirac_delta_block, twice the force": ("dirac_delta_block", _twice_the_force, "2-29"),
    "lumped_mass_structure, gravity upwards": ("lumped_mass_structure", _upwards, "5-10"),
    "lumped_mass_structure, mass 1 % more": ("lumped_mass_structure", _heavier, "5-14"),
    "two_spring_structure, twice the stiffness": (
        "two_spring_structure", _twice_each("stiffness"), "5-22",
    ),
    "two_spring_cart, mass 1 % more": ("two_spring_cart", _heavier, "5-15"),
    "uplifting_oscillator, gravity upwards": ("uplifting_oscillator", _upwards, "2-7"),
    "uplifting_oscillator, twice the damping": (
        "uplifting_oscillator", _twice_each("damping"), "2-8b",
    ),
    "flexible_structure, mass 1 % more": ("flexible_structure", _heavier, "5-34"),
    "flexible_structure, twice the stiffness": (
        "flexible_structure", _twice_each("stiffness"), "5-35",
    ),
}  # fmt: skip


@pytest.fixture
def derived_anew():
    """Models are kept once derived: forget them before and after."""
    for kept in (shipped, values_of_shipped):
        kept.cache_clear()
    yield
    for kept in (shipped, values_of_shipped):
        kept.cache_clear()


@pytest.mark.parametrize("name", DECIDED)
def test_wrong_structure_fails_the_verification(name, monkeypatch, derived_anew):
    structure, change, number = DECIDED[name]
    wrong = change(SHIPPED[structure]())
    monkeypatch.setitem(SHIPPED, structure, lambda: wrong)
    assert decide(number).verdict is Verdict.FAILED


# --- the engine itself


def test_ground_acceleration_of_the_wrong_sign_is_noticed(monkeypatch):
    monkeypatch.setattr(lagrange, "GROUND_X", -GROUND_X)
    model = SHIPPED[FLEXIBLE]()
    assert all(notices(n, model) for n in ("5-34", "5-35", "D-17", "D-18"))


def test_kinetic_energy_without_spin_is_noticed(monkeypatch):
    exact = lagrange.body_velocity

    def still(body, coordinates):
        return (*exact(body, coordinates)[:2], sp.Integer(0))

    monkeypatch.setattr(lagrange, "body_velocity", still)
    assert all(notices(n, SHIPPED[FLEXIBLE]()) for n in ("5-34", "D-11", "D-12"))


def test_impulse_without_spin_is_noticed(monkeypatch):
    exact = impulse.body_velocity

    def still(body, coordinates):
        return (*exact(body, coordinates)[:2], sp.Integer(0))

    monkeypatch.setattr(impulse, "body_velocity", still)
    assert all(notices(n, SHIPPED[RIGID]()) for n in ("5-12", "5-14"))


def test_impact_about_the_old_pivot_is_noticed(monkeypatch):
    monkeypatch.setattr(impulse, "SIDE", sp.Dummy("no side"))  # the new edge is not put in
    assert all(notices(n, SHIPPED[RIGID]()) for n in ("5-12", "5-14"))


# --- the comparison itself


def test_comparison_tells_cosines_of_sum_and_difference_apart():
    plus, minus = (sp.cos(th.alpha_e + sign * th.theta) * th.R_e for sign in (1, -1))
    in_symbols = [in_engine_notation(e, 1) for e in (plus, minus)]
    assert normal_form(in_symbols[0] - in_symbols[1]) != 0
    by_hand = H_E * sp.cos(THETA) + B * sp.sin(THETA)
    assert normal_form(in_symbols[1] - by_hand) == 0


def test_comparison_knows_the_radius_and_not_only_its_square():
    squared = in_engine_notation(th.R_b**2, 1) - B**2 - H_B**2
    assert normal_form(squared) == 0
    assert normal_form(in_engine_notation(th.R_b, 1) - B**2 - H_B**2) != 0


def test_symbol_without_counterpart_is_refused():
    with pytest.raises(ValueError, match="not translated"):
        in_engine_notation(th.m_e * sp.Symbol("M_e"), 1)
