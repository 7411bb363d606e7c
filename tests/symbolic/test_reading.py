"""Derived equations as a reader meets them: names, signs and forms are those of SymPy and books."""

import copy

import numpy as np
import pytest
import sympy as sp
from sympy.core.function import AppliedUndef
from sympy.physics.mechanics import (
    LagrangesMethod,
    Point,
    ReferenceFrame,
    RigidBody,
    dynamicsymbols,
    inertia,
)

import rockeom as rk
from rockeom.cli import main
from rockeom.symbolic import SIDE

BLOCK, PIER = rk.derive("rigid_block"), rk.derive("flexible_structure")
A_X, A_Y = dynamicsymbols("a_x a_y")


def is_zero(matrix) -> bool:
    """Whether all entries are zero, at random numbers for rates, coordinates and parameters."""
    matrix, rng = sp.Matrix([matrix]), np.random.default_rng(8)
    for kind in (sp.Derivative, AppliedUndef, sp.Symbol):
        atoms = sorted(matrix.atoms(kind), key=sp.default_sort_key)
        matrix = matrix.xreplace({x: sp.Float(rng.uniform(0.2, 0.9), 30) for x in atoms[::-1]})
    return all(abs(sp.N(e, 30)) < 1e-20 for e in matrix)


def by_sympy(model, mode="right") -> LagrangesMethod:
    """A block or a pier on its right foot, or upright, by points and frames of SymPy.

    The ground moves the foot by gravity's opposite: d'Alembert's forces at each mass.
    """
    s = model.symbols
    theta, *rest = dynamicsymbols([c.name for c in model.coordinates])
    u = rest[0] if rest else sp.S.Zero
    angle = theta if mode == "right" else sp.S.Zero
    ground, turned = ReferenceFrame("N"), ReferenceFrame("A")
    turned.orient_axis(ground, ground.z, -angle)
    foot = Point("O")
    foot.set_vel(ground, 0)
    flexible = "base_mass" in s
    masses = [(s.mass, s.height, s.inertia, u)]
    masses += [(s.base_mass, s.base_height, s.base_inertia, sp.S.Zero)] if flexible else []
    bodies, loads = [], []
    for i, (mass, height, moment, across) in enumerate(masses):
        centre = foot.locatenew(f"G{i}", (across - s.half_width) * turned.x + height * turned.y)
        centre.set_vel(ground, centre.pos_from(foot).dt(ground))
        body = RigidBody(f"b{i}", centre, turned, mass, (inertia(turned, 0, 0, moment), centre))
        body.potential_energy = mass * s.gravity * centre.pos_from(foot).dot(ground.y)
        bodies.append(body)
        loads.append((centre, -mass * (A_X * ground.x + A_Y * ground.y)))
    lagrangian = sum(b.kinetic_energy(ground) - b.potential_energy for b in bodies)
    coordinates = [theta, u] if flexible else [theta]
    if flexible:
        lagrangian -= s.stiffness * u**2 / 2
        damper = Point("damper")
        damper.set_vel(ground, u.diff() * ground.x)
        loads.append((damper, -s.damping * u.diff() * ground.x))
        coordinates = coordinates if mode == "right" else [u]
    method = LagrangesMethod(lagrangian, coordinates, forcelist=loads, frame=ground)
    method.form_lagranges_equations()
    return method


@pytest.mark.parametrize("model", [BLOCK, PIER], ids=lambda m: m.name)
def test_names_and_signs_are_those_of_lagranges_method(model):
    derived, method = model.equations("right").dynamic(), by_sympy(model)
    for name in ("q", "u", "mass_matrix", "forcing", "mass_matrix_full", "forcing_full"):
        assert getattr(derived, name).shape == getattr(method, name).shape
        assert is_zero(getattr(derived, name) - getattr(method, name)), name
    assert is_zero(derived.mass_matrix_full * derived.rhs() - derived.forcing_full)


@pytest.mark.parametrize(
    ("model", "mode", "state"),
    [
        (BLOCK, "right", {"theta": sp.Symbol("theta_0", positive=True)}),
        (PIER, "both", {}),
        (PIER, "right", {"theta": sp.Rational(1, 10), "u": sp.Rational(1, 20)}),
    ],
    ids=lambda x: getattr(x, "name", None),
)
def test_state_space_is_that_of_sympy(model, mode, state):
    method = by_sympy(model, mode)
    values = {x: state.get(str(x.func), 0) for x in method.q}
    values |= {x.diff(): 0 for x in method.q} | {A_X: 0, A_Y: 0}
    values |= {x.diff().diff(): 0 for x in method.q}
    a, b, inputs = method.linearize(q_ind=method.q, qd_ind=method.u, A_and_B=True, op_point=values)
    found = model.linearize(mode, state)
    assert is_zero(found.A - a.subs(values))
    columns = [list(inputs).index(x) for x in (A_X, A_Y) if x in list(inputs)]
    ours = found.B[:, [i for i, x in enumerate((A_X, A_Y)) if x in list(inputs)]]
    assert is_zero(ours - b[:, columns].subs(values))


def test_rocking_about_a_foot_has_no_equilibrium_at_zero_but_at_alpha():
    s = BLOCK.symbols
    moment = s.mass * s.gravity * s.half_width
    assert BLOCK.linearize("right").f0 == sp.Matrix([moment])
    balanced = BLOCK.linearize("right", {s.theta: sp.atan(s.half_width / s.height)})
    assert is_zero(balanced.f0)
    assert is_zero(balanced.A - sp.Matrix([[0, 1], [-balanced.K[0] / balanced.M[0], 0]]))


def test_deviation_moves_by_the_linear_equations_to_second_order():
    """Of any state that moves, gyroscopic terms and accelerations of the state included."""
    s, at = PIER.symbols, {"theta": 0.1, "u": 0.2, "theta_dot": 0.5, "u_dot": -0.3, "theta_ddot": 2}
    linear, small = PIER.linearize("left", at), sp.Symbol("epsilon")
    names = ("theta", "u", "theta_dot", "u_dot", "theta_ddot", "u_ddot")
    ways = {name: i for i, name in enumerate(names, 1)}
    put = {s[name]: at.get(name, 0) + small * way for name, way in ways.items()}
    ground = {s.a_x: 3 * small, s.a_y: -2 * small}
    exact = PIER.equations("left").residual.subs(put | ground)
    x, rate, acceleration = (sp.Matrix([small * i, small * (i + 1)]) for i in (1, 3, 5))
    first = linear.M * acceleration + linear.C * rate + linear.K * x + linear.f0
    first -= linear.F * sp.Matrix([3 * small, -2 * small])
    rest = (exact - first).applyfunc(lambda e: sp.diff(e, small))
    numbers = {p.symbol: sp.Rational(i, 3) for i, p in enumerate(PIER.parameters, 1)}
    assert max(abs(sp.N(e.subs({small: 0} | numbers), 20)) for e in rest) < 1e-12


def test_state_of_a_structure_with_named_functions_is_linearised_with_its_side():
    """Forces about a state, by differences of the accelerations that `lambdify` gives."""
    wall, h = rk.derive("controlled_wall"), 1e-6
    values = {p.name: 0.3 + 0.02 * i for i, p in enumerate(wall.parameters)}
    state = {"theta": -0.1, "theta_dot": 0.2}
    of = wall.lambdify()["left"]

    def acceleration(theta):
        y = [theta if x == "theta" else state.get(x, 0.0) for x in wall.states]
        return of.accelerations(y, values)[0]

    at = {"theta_ddot": acceleration(-0.1)}
    linear = wall.linearize("left", state | at)
    numbers = {p.symbol: values[p.name] for p in wall.parameters}
    mass, stiffness, force = (float(m[0].subs(numbers)) for m in (linear.M, linear.K, linear.f0))
    slope = (acceleration(-0.1 + h) - acceleration(-0.1 - h)) / (2 * h)
    assert stiffness == pytest.approx(-mass * slope, rel=1e-6)
    assert force == pytest.approx(0.0, abs=1e-9)


def test_class_instance_and_name_have_one_derivation():
    block = rk.RigidBlock(half_width=0.1, half_height=0.4)
    assert rk.derive(block) is rk.derive(rk.RigidBlock) is BLOCK is rk.derive(BLOCK)
    storeys = {"masses": [1e3] * 2, "heights": [3, 6], "stiffnesses": [1e6] * 2}
    frame = rk.ShearFrame(**storeys, dampings=[1e3] * 2, half_width=1.0, base_mass=1e3)
    assert rk.derive(frame) is rk.derive("shear_frame", storeys=2)
    assert rk.derive(rk.structure(BLOCK, **block.parameters())) is BLOCK


@pytest.mark.parametrize(
    ("support", "name"),
    [
        (rk.Sliding(friction=0.5, restitution=0.0, law="poisson"), "sliding_flexible_structure"),
        (rk.Winkler(springs=3, stiffness=1e3, damping=1.0), "flexible_structure_on_3_springs"),
        (rk.Pinned(), "flexible_structure"),
    ],
)
def test_a_structure_brings_its_support(support, name):
    pier = rk.FlexibleStructure(
        mass=1.0, height=2.0, inertia=0.0, base_mass=1.0, base_height=0.1, base_inertia=0.1,
        half_width=0.5, stiffness=100.0, damping=1.0, support=support,
    )  # fmt: skip
    assert rk.derive(pier).name == pier.module.NAME == name


@pytest.mark.parametrize(
    ("attempt", "place"),
    [
        (lambda: rk.RigidBlock(half_width=0.1, half_height=0.4).equations, "rockeom.derive(it)"),
        (lambda: rk.RigidBlock(half_width=0.1, half_height=0.4).lambdify, "rockeom.derive(it)"),
        (lambda: BLOCK.restitution, "velocity_ratio"),
        (lambda: BLOCK.mass_matrix, 'equations("right").mass_matrix'),
        (lambda: BLOCK.K, 'linearize("both").K'),
        (lambda: BLOCK.equations("right").stiffness, "elastic_forces"),
        (lambda: BLOCK.equations("right").M, "mass_matrix"),
        (lambda: BLOCK.symbols.B, "half_width"),
    ],
)
def test_names_that_people_try_lead_to_the_place(attempt, place):
    with pytest.raises(AttributeError) as error:
        attempt()
    assert place in str(error.value)


def test_what_is_no_structure_is_refused_with_what_is_one():
    with pytest.raises(rk.InputError, match="a name such as 'rigid_block', a class"):
        rk.derive(3)
    with pytest.raises(KeyError, match="did you mean rigid_block"):
        rk.derive("RigidBlok")


@pytest.mark.parametrize("name", rk.models())
def test_repr_is_a_line_and_impulse_maps_are_of_one_side(name):
    model = rk.derive(name)
    assert "\n" not in repr(model)
    assert len(repr(model)) < 100
    assert model._repr_latex_().startswith("$$")
    if "both" in getattr(model, "mode_names", ()):
        full = model.equations("both")
        assert full._repr_latex_().startswith("$$")
        assert full.q or str(full).strip() == "no coordinate moves"
    impacts = [t for t in getattr(model, "transitions", ()) if t.kind == "impact"]
    for t in impacts:
        derived = model.impulse_map(t.source, t.target)
        assert not (derived.mass_matrix.has(SIDE))
        assert not (derived.momentum.has(SIDE))
        sided = model.sided_impulse_map(t.source, t.target)
        side = model.mode(t.source).side_of(t.source)
        assert sided.at_side(side).equals(derived)
    for t in impacts[:1]:
        for shown in (model.impulse_map(t.source, t.target), model.equations(t.source)):
            assert "\n" not in repr(shown)
            assert "begin{aligned}" in shown._repr_latex_()


def test_text_of_a_model_is_what_the_command_line_prints(capsys, monkeypatch):
    monkeypatch.setenv("COLUMNS", "100")
    assert main(["derive", "rigid_block"]) == 0
    assert capsys.readouterr().out.rstrip() == str(BLOCK)


def test_equations_are_shown_by_physical_part():
    assert str(BLOCK.equations("right")) == (
        "  (m B² + m H² + I_g) θ̈ + m g (B cos θ - H sin θ)\n"
        "      = -m ẍ_g (H cos θ + B sin θ) - m ÿ_g (B cos θ - H sin θ)"
    )


def test_symbols_are_attributes_and_a_mapping():
    s = PIER.symbols
    assert {*s} >= {"theta", "theta_dot", "theta_ddot", "u", "stiffness", "a_x", "a_y", "s"}
    assert s["theta_dot"] is s.theta_dot is PIER.rotation.velocity
    assert PIER.equations("right").residual.free_symbols <= {*s.values()}
    assert "stiffness" in dir(s)
    assert {**copy.deepcopy(s)} == {**s}


def test_forms_are_those_of_the_models_declared_in_them():
    """Slender (thesis 2-3) and without dimensions (thesis 2-13)."""
    slender, scaled = rk.derive("slender_block"), rk.derive("nondimensional_block")
    for mode in ("left", "right"):
        theirs = BLOCK.equations(mode, "slender")
        assert is_zero(theirs.residual - slender.equations(mode).residual)
        x, s = scaled.symbols, scaled.equations(mode).residual
        divided = s / (x.alpha**2 * x.radius_ratio)
        assert is_zero(BLOCK.equations(mode, "nondimensional").residual - divided)
        assert BLOCK.equations(mode, "nondimensional").mass_matrix == sp.eye(1)


def test_polar_and_small_forms_say_the_same_as_the_exact_one():
    for model, mode in ((BLOCK, "left"), (PIER, "right")):
        exact, polar = model.equations(mode), model.equations(mode, "polar")
        put = {}
        for body in model.mode(mode).bodies:
            b, h, radius, alpha = body.polar
            put |= {radius: sp.sqrt(b**2 + h**2), alpha: sp.atan(b / h)}
        assert is_zero(polar.residual.subs(put) - exact.residual)
        linear, small = model.linearize(mode), model.equations(mode, "small")
        assert is_zero(small.mass_matrix - linear.M)
        assert is_zero(
            small.residual.jacobian(small.q).subs({BLOCK.symbols.a_x: 0, BLOCK.symbols.a_y: 0})
            - linear.K
        )
    with pytest.raises(rk.InputError, match="is that of a block"):
        PIER.equations("right", "nondimensional")
    with pytest.raises(rk.InputError, match="form"):
        PIER.equations("right", "slim")


@pytest.mark.parametrize(
    ("state", "message"),
    [({"thet": 1}, "did you mean theta"), ({"theta": "1"}, "is a text"), ({"mass": 1}, "mass")],
)
def test_state_that_is_none_is_refused(state, message):
    with pytest.raises(rk.InputError, match=message):
        BLOCK.linearize("right", state)
