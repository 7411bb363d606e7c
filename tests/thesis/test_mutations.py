"""The comparison with the thesis notices a derivation or a structure that is slightly wrong."""

from collections.abc import Callable
from dataclasses import dataclass, replace

import pytest
import sympy as sp

from rockeom.symbolic import SHIPPED, RockingModel
from rockeom.symbolic.mode import Mode
from rockeom.symbolic.model import Body
from rockeom.thesis import EQUATIONS, notation as th
from rockeom.thesis.checks.engine import THETA, B, compared
from rockeom.thesis.comparison import PIER, in_engine_notation, normal_form
from rockeom.thesis.equation import Kind

from . import mutations

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
class WrongStructure:
    structure: str
    change: Callable[[RockingModel], RockingModel]
    noticed_by: tuple[str, ...]


FLEXIBLE, RIGID, BLOCK = "flexible_structure", "lumped_mass_structure", "rigid_block"
SPRINGS, CART = "two_spring_structure", "two_spring_cart"

WRONG = {
    "superstructure on the wrong side of the pivot": WrongStructure(
        FLEXIBLE,
        lambda m: bodies(m, lambda b: placed(b, {B: -B}), "superstructure"),
        ("5-34", "5-35", "D-1", "D-11", "D-13", "D-17", "D-21"),
    ),
    "superstructure without rotary inertia": WrongStructure(
        FLEXIBLE, lambda m: bodies(m, spinless, "superstructure"), ("5-34", "D-8", "D-11")
    ),
    "base without rotary inertia": WrongStructure(
        FLEXIBLE, lambda m: bodies(m, spinless, "base"), ("5-34", "D-12", "D-14")
    ),
    "gravity upwards": WrongStructure(
        FLEXIBLE,
        lambda m: modes(m, lambda p: replace(p, gravity=-p.gravity)),
        ("5-34", "5-35", "D-13", "D-23", "D-24"),
    ),
    "elastic energy k u**2": WrongStructure(
        FLEXIBLE,
        lambda m: modes(m, twice("stiffness")),
        ("5-35", "D-13", "D-20", "D-24", "D-26"),
    ),
    "dissipation c u'**2": WrongStructure(
        FLEXIBLE,
        lambda m: modes(m, twice("damping")),
        ("5-35", "D-15", "D-20"),
    ),
    "deformation along the ground instead of across the column": WrongStructure(
        FLEXIBLE,
        lambda m: bodies(m, pushed_along_the_ground, "superstructure"),
        ("5-34", "5-35", "5-37", "D-3", "D-18"),
    ),
    "base turning anticlockwise": WrongStructure(
        FLEXIBLE, lambda m: bodies(m, lambda b: placed(b, {THETA: -THETA}), "base"), ("5-34", "D-2")
    ),
    "heights exchanged": WrongStructure(
        FLEXIBLE,
        lambda m: bodies(m, lambda b: placed(b, {H_E: H_B, H_B: H_E})),
        ("5-34", "5-35", "D-1", "D-2"),
    ),
    "rigid structure without rotary inertia": WrongStructure(
        RIGID, lambda m: bodies(m, spinless), ("5-8", "5-9", "5-10", "5-12", "5-13", "5-14")
    ),
    "base of the rigid structure on the wrong side": WrongStructure(
        RIGID,
        lambda m: bodies(m, lambda b: placed(b, {B: -B}), "base"),
        ("5-9", "5-10", "5-11", "5-31"),  # its impact is even in B
    ),
    "block without rotary inertia": WrongStructure(
        BLOCK, lambda m: bodies(m, spinless), ("2-2", "2-6", "2-9")
    ),
    "block on the wrong side of its edge": WrongStructure(
        BLOCK, lambda m: bodies(m, lambda b: placed(b, {B: -B})), ("2-2", "2-9", "3-6", "3-9")
    ),
    "springs twice as stiff": WrongStructure(
        SPRINGS,
        lambda m: modes(m, twice("stiffness")),
        ("5-16", "5-24"),
    ),
    "springs with gravity upwards": WrongStructure(
        SPRINGS,
        lambda m: modes(m, lambda p: replace(p, gravity=-p.gravity)),
        ("5-17", "5-24"),
    ),
    "cart without the base's mass": WrongStructure(
        CART,
        lambda m: bodies(m, lambda b: replace(b, mass=PIER["mass"])),
        ("5-15",),
    ),
}


@pytest.mark.parametrize("name", WRONG)
def test_wrong_structure_is_noticed(name):
    wrong = WRONG[name]
    model = wrong.change(SHIPPED[wrong.structure]())
    assert [n for n in wrong.noticed_by if not notices(n, model)] == []


def test_unchanged_copy_raises_no_alarm():
    copy = modes(bodies(SHIPPED[FLEXIBLE](), lambda body: placed(body, {})), replace)
    assert [n for n in ("5-34", "5-35", "5-37", "D-1", "D-13", "D-18") if notices(n, copy)] == []


# --- errors in the text of the project


@pytest.mark.parametrize("mutation", mutations.MUTATIONS, ids=str)
def test_error_in_the_text_fails_the_verification(mutation):
    assert mutations.noticed(mutation)


FILES = {mutation.file: mutation for mutation in mutations.MUTATIONS}


@pytest.mark.parametrize("mutation", FILES.values(), ids=FILES)
def test_text_without_an_error_raises_no_alarm(mutation):
    assert not mutations.noticed(mutation._replace(new=mutation.old))


def test_list_of_errors_contains_every_wrong_printed_form_and_every_fitted_number():
    catalogue = {m.noticed_by for m in mutations.MUTATIONS if m.file.startswith("thesis/")}
    wrong = {number for number, one in EQUATIONS.items() if one.is_erratum}
    fitted = {
        number
        for number, one in EQUATIONS.items()
        if one.kind is Kind.FIT and any(r.rhs.atoms(sp.Float) for r in one.printed)
    }
    assert len(mutations.MUTATIONS) >= 125
    assert wrong | fitted <= catalogue


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
