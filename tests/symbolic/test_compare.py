"""An equation that a reader types against the derived one: equal, up to a factor, or where not."""

import pytest
import sympy as sp
from sympy.physics.mechanics import dynamicsymbols

import rockeom as rk
from tests.symbolic.rewritings import RIGHT, WRONG

BLOCK = rk.derive("rigid_block")
PIER = rk.derive("flexible_structure")
S = BLOCK.symbols
IMPACT = {"impact": ("right", "left")}
HOUSNER = sp.sympify("Eq(theta_ddot, -p**2*sin(alpha - theta))")


def plain(expr: sp.Expr) -> sp.Expr:
    return sp.sympify(expr).xreplace({x: sp.Symbol(x.name) for x in sp.sympify(expr).free_symbols})


@pytest.mark.parametrize("rewriting", RIGHT, ids=lambda r: f"{r.number} {r.why}")
def test_right_rewriting_is_equal_up_to_its_factor(rewriting):
    comparison = rk.derive(rewriting.model).compare(rewriting.equation, **rewriting.where)
    assert comparison
    assert comparison.equal
    assert not comparison.difference
    wanted = sp.S.One if rewriting.factor is None else rewriting.factor
    assert sp.simplify(plain(comparison.factor) - plain(wanted)) == 0


@pytest.mark.parametrize("rewriting", WRONG, ids=lambda r: f"{r.number} {r.why}")
def test_wrong_rewriting_is_unequal(rewriting):
    comparison = rk.derive(rewriting.model).compare(rewriting.equation, **rewriting.where)
    assert not comparison
    assert not comparison.equal
    assert comparison.difference


def test_difference_is_the_wrong_term_alone():
    equation = BLOCK.equations("right").residual[0] - S.mass * S.gravity * S.height * sp.sin(
        S.theta
    )
    comparison = BLOCK.compare(equation, mode="right")
    assert comparison.difference == {"gravity": -S.mass * S.gravity * S.height * sp.sin(S.theta)}
    assert str(comparison) == (
        "Unequal to the derived equation of theta. Typed less derived:\n  gravity: - H g m sin(θ)"
    )


def test_damping_coriolis_and_springs_are_told_apart():
    s = PIER.symbols
    row = PIER.equations("left").residual[0]
    for name, term in {
        "damping": s.damping * s.u_dot,
        "springs and forces": s.stiffness * s.u,
        "velocities squared": s.mass * s.u * s.theta_dot**2,
        "inertia of u": s.mass * s.u_ddot,
        "horizontal excitation": s.mass * s.a_x,
    }.items():
        assert PIER.compare(row + term, mode="left").difference == {name: term}


@pytest.mark.parametrize(
    "name",
    [
        "two_spring_structure",
        "two_spring_cart",
        "dirac_delta_block",
        "uplifting_oscillator",
        "substitute_gravity_wall",  # with named functions
    ],
)
def test_modes_whose_rotation_is_free_or_held_read_their_own_equation_and_no_other(name):
    """On both springs and in flight the rotation is free, and has no side."""
    model = rk.derive(name)
    wrong = model.parameters[0].symbol * sp.sin(model.rotation.position)
    for mode in model.mode_names:
        row = model.equations(mode).residual[0]
        assert model.compare(row, mode=mode).equal
        held = model.rotation not in model.mode(mode).coordinates
        assert model.compare(row + wrong, mode=mode).equal == held


def test_side_of_a_free_rotation_is_its_sign():
    s = rk.derive("two_spring_structure").symbols
    row = rk.derive("two_spring_structure").equations("both").residual[0]
    turned = s.mass * s.gravity * sp.Abs(s.theta)
    compare = rk.derive("two_spring_structure").compare
    assert compare(row + turned - s.mass * s.gravity * s.s * s.theta, mode="both").equal
    assert not compare(row + turned, mode="both")


def test_constants_of_a_model_are_read_by_their_letters_and_by_what_they_stand_for():
    """Stiffness of the cart with both feet down, thesis 5-25; letters of the thesis, too."""
    stiffness = "(2*B**2*k_f - (m_e*H_e + m_b*H_b)*g)/H_e**2"
    cart, weight = rk.derive("two_spring_cart"), sp.Symbol("g") * sp.Symbol("I_{e,g}")
    for k_0 in (stiffness, "contact_stiffness", "k_0"):
        typed = sp.sympify(f"(m_e + m_b)*u_ddot + {k_0}*u")
        assert cart.compare(typed, mode="both_left", ground=()).equal
        assert not cart.compare(typed + weight, mode="both_left", ground=())
    assert {*cart.compare(typed + weight, mode="both_left", ground=()).difference} == {"gravity"}


def test_equation_without_ground_motion_is_equal_where_the_ground_rests():
    assert not BLOCK.compare(HOUSNER, mode="right")
    assert "ground=()" in str(BLOCK.compare(HOUSNER, mode="right"))
    assert BLOCK.compare(HOUSNER, mode="right", ground=()).equal
    assert not BLOCK.compare(HOUSNER, mode="left", ground=())


def test_equations_of_a_uniform_block_are_those_with_its_inertia():
    """Housner's p**2 = 3 g/(4 R) and r = (1 - 3/2 sin(alpha)**2)**2."""
    m, B, H, g, R, r, alpha, theta, turns = sp.symbols("m B H g R r alpha theta theta_ddot")
    uniform = {"inertia": m * (B**2 + H**2) / 3}
    motion = sp.Eq(turns, -sp.Rational(3, 4) * g / R * sp.sin(alpha - theta))
    impact = sp.Eq(r, (1 - sp.Rational(3, 2) * sp.sin(alpha) ** 2) ** 2)
    for equation, where in ((motion, {"mode": "right", "ground": ()}), (impact, IMPACT)):
        assert not BLOCK.compare(equation, **where)
        assert BLOCK.compare(equation, **where, values=uniform).equal
    assert not BLOCK.compare(sp.Eq(r, 1 - sp.sin(alpha) ** 2), **IMPACT, values=uniform)
    for wrong in ({"inertia": "m*B**2"}, {"I_g": m}):
        with pytest.raises((rk.InputError, TypeError), match=r"equation|values"):
            BLOCK.compare(impact, **IMPACT, values=wrong)


def test_combination_of_equations_holds_and_is_no_multiple_of_one():
    first, second = PIER.equations("right").residual
    s = PIER.symbols
    for equation in (first + 2 * second, first * sp.cos(s.theta), first * s.a_x, second * s.u_dot):
        comparison = PIER.compare(equation, mode="right")
        assert comparison
        assert not comparison.equal
        assert str(comparison).startswith("It holds in every motion")


@pytest.mark.parametrize(
    "name", ["two_spring_cart", "controlled_wall", "controlled_wall_oscillator"]
)
def test_definitions_and_named_functions_are_read_as_they_are_printed(name):
    model = rk.derive(name)
    equations = model.equations("left")
    for printed in (equations, equations.dynamic()):
        assert model.compare(printed.residual[0], mode="left").equal
    wrong = equations.residual[0] + model.rotation.position
    assert model.compare(wrong, mode="left").difference.keys() == {"springs and forces"}


def test_ground_and_rates_go_by_the_names_of_the_literature():
    m, g, alpha, R, I_o, theta = sp.symbols("m g alpha R I_o theta")
    moving = dynamicsymbols("x_g").diff(dynamicsymbols._t, 2)
    for a_x in (moving, sp.Symbol("u_g''"), sp.Symbol(r"\ddot{u}_{g}")):
        turning = I_o * sp.Symbol("theta''") + m * g * R * sp.sin(alpha - theta)
        shaken = m * R * a_x * sp.cos(alpha - theta)
        assert BLOCK.compare(turning + shaken, mode="right", ground=("a_x",)).equal
        assert not BLOCK.compare(turning - shaken, mode="right", ground="a_x")
    before, after = sp.symbols("theta_dot_before theta_dot_after")
    assert BLOCK.compare(sp.Eq(after, sp.Symbol("e") * before), impact=("right", "left"))


@pytest.mark.parametrize(
    ("name", "mode"), [("dirac_delta_block", "right_tail"), ("two_spring_structure", "both")]
)
def test_rotation_that_is_free_on_both_sides_is_not_taken_for_zero(name, mode):
    model = rk.derive(name)
    row = model.equations(mode).residual[0]
    assert model.compare(row, mode=mode).equal
    assert not model.compare(row + model.rotation.position, mode=mode)


def test_coordinate_that_is_held_has_no_rates():
    assert PIER.compare(PIER.equations("right").residual[1], mode="both").equal


def test_terms_of_a_product_and_of_what_has_no_value_at_rest_are_shown_once():
    e, before, after = sp.symbols("e theta_dot theta_dot_after")
    product = BLOCK.compare(sp.Eq(after, -e * before), impact=("right", "left"))
    assert "rest" not in product.difference
    for infinite in (sp.log(S.theta_dot), 1 / S.gravity, S.mass / S.theta_ddot):
        wrong = BLOCK.equations("right").residual[0] + infinite
        comparison = BLOCK.compare(wrong, mode="right")
        assert comparison.difference.keys() == {"equation"}
        assert str(comparison).startswith("Unequal")


def test_unevaluated_rate_of_a_momentum_is_read_in_time_and_refused_in_plain_symbols():
    theta = dynamicsymbols("theta")
    m, B, H, I_g, g = sp.symbols("m B H I_g g")
    momentum = (I_g + m * (B**2 + H**2)) * theta.diff()
    weight = m * g * (B * sp.cos(theta) - H * sp.sin(theta))
    rate = sp.Derivative(momentum, dynamicsymbols._t)
    assert BLOCK.compare(rate + weight, mode="right", ground=()).equal
    with pytest.raises(rk.InputError, match="is a rate of plain symbols: write it out"):
        BLOCK.compare(sp.Derivative(sp.Symbol("theta_dot"), sp.Symbol("t")), mode="right")


def test_decimal_fractions_are_compared_to_their_rounding():
    third = sp.Float(1 / 3)
    assert BLOCK.compare(third * BLOCK.equations("right").residual[0], mode="right").equal
    assert not BLOCK.compare(
        BLOCK.equations("right").residual[0].subs(S.height, 1.0001 * S.height), mode="right"
    )


@pytest.mark.parametrize(
    ("equation", "where", "message"),
    [
        (sp.Symbol("thetta"), {"mode": "right"}, r"no symbol 'thetta' \(did you mean theta\?\)"),
        (S.theta - S.theta + 0 * S.theta, {"mode": "right"}, "it is an identity"),
        ((S.mass + 1) ** 2 - S.mass**2 - 2 * S.mass - 1, {"mode": "right"}, "it is an identity"),
        (S.theta, {}, 'give the mode of an equation of motion, mode="right"'),
        (S.theta, {"mode": "right", "impact": ("right", "left")}, "give the mode"),
        (S.theta, {"mode": "right", "ground": ("a_z",)}, "a_z"),
        (S.theta / (S.s - 1), {"mode": "right"}, "is not finite"),
        ("theta_ddot", {"mode": "right"}, "equation"),
        (1 / (sp.sin(S.mass) ** 2 + sp.cos(S.mass) ** 2 - 1), {"mode": "right"}, "not finite"),
        (S.theta_ddot, {"mode": "both"}, "no coordinate moves"),
        (S.theta_ddot, {"impact": "right"}, "the modes before and after"),
        (sp.Eq(sp.Matrix([S.theta]), sp.zeros(1)), {"mode": "right"}, "equation"),
        (sp.Function("theta")(sp.Symbol("t") - 1), {"mode": "right"}, "at one time t"),
        (sp.true, {"mode": "right"}, "equation"),
    ],
)
def test_what_cannot_be_compared_is_refused(equation, where, message):
    with pytest.raises((rk.InputError, TypeError), match=message):
        BLOCK.compare(equation, **where)
