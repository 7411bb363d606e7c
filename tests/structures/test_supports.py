"""Any superstructure on any support: the limits in which one is another, and matrices by hand."""

import re
from argparse import Namespace

import numpy as np
import pytest
import sympy as sp
from scipy.linalg import eigh

import rockeom as rk
from rockeom.cli import models as command_line
from rockeom.cli.errors import UsageError
from rockeom.symbolic.algebra import at_side, tidy
from rockeom.symbolic.modes.balance import free_motion
from rockeom.symbolic.text.page import to_latex, to_markdown
from rockeom.symbolic.write.typeset import content
from tests.typical import FOUNDATION_STIFFNESS, S1, STIFFNESS, TOTAL_MASS, column, on_springs

GRAVITY = 9.81
SPRINGS = {"stiffness": FOUNDATION_STIFFNESS, "damping": 3e3}
PULSE = rk.GroundMotion.single_sine(amplitude=5.0, period=0.5, duration=2.0)


def lumped(support):
    return rk.LumpedMassStructure(**S1, support=support)


def two_storeys(support, **changes):
    values = {
        "masses": [20e3, 15e3],
        "heights": [3.0, 6.5],
        "stiffnesses": [30e6, 20e6],
        "dampings": [0.0, 0.0],
        "inertias": [2e4, 1e4],
        "half_width": 1.5,
        "base_mass": 30e3,
        "base_height": 0.4,
        "base_inertia": 2e4,
    }
    return rk.ShearFrame(**(values | changes), support=support)


# -- two springs


def test_the_rigid_structure_on_two_springs_is_the_two_spring_structure():
    """The same modes, accelerations and forces: one derived of modes, one of elements."""
    composed, shipped = lumped(rk.TwoSprings(**SPRINGS)), on_springs()
    assert sorted(composed.module.MODES) == sorted(shipped.module.MODES)
    rng = np.random.default_rng(5)
    for mode in shipped.module.MODES:
        for _ in range(10):
            state = dict(zip(shipped.states, rng.uniform(-0.05, 0.05, 4), strict=True))
            for ask in ("accelerations", "reactions"):
                expected, found = (
                    getattr(s, ask)(state, 1.3, -0.7, mode=mode) for s in (shipped, composed)
                )
                assert found == pytest.approx(expected, rel=1e-11, abs=1e-9)


def test_the_rigid_structure_on_two_springs_moves_as_the_two_spring_structure():
    t = np.linspace(0.0, 2.0, 200)
    composed, shipped = (
        rk.simulate(s, PULSE) for s in (lumped(rk.TwoSprings(**SPRINGS)), on_springs())
    )
    assert len(composed.events) == len(shipped.events) > 4
    for name in ("theta", "heave"):
        expected = shipped.at(t)[name]
        np.testing.assert_allclose(
            composed.at(t)[name], expected, atol=1e-8 * np.abs(expected).max()
        )


def test_a_bed_of_two_springs_is_the_two_springs():
    bed, springs = (
        rk.derive("flexible_structure", **support)
        for support in ({"support": "winkler", "springs": 2}, {"support": "two_springs"})
    )
    assert bed.elements == springs.elements
    assert bed.bodies == springs.bodies
    assert bed.coordinates == springs.coordinates


def settled_modes(structure):
    """Circular frequencies of small motion about the settled state [rad/s]."""
    m, p, n = structure.module, structure.vector, structure.module.N_STATES // 2
    mode = structure.mode_number(np.zeros(2 * n))

    def accelerations(q):
        dy = np.zeros(2 * n)
        m.rates(mode, np.array([*q, *np.zeros(n)]), p, 0.0, 0.0, dy)
        return dy[n:]

    matrix = np.transpose([(accelerations(h) - accelerations(-h)) / 2e-7 for h in 1e-7 * np.eye(n)])
    return np.sqrt(np.sort(-np.linalg.eigvals(matrix).real))


def places(springs):
    return S1["half_width"] * np.linspace(-1.0, 1.0, springs)


@pytest.mark.parametrize(
    "support",
    [
        rk.TwoSprings(**SPRINGS),
        rk.TwoSprings(**SPRINGS, guided="foot"),
        rk.Winkler(springs=5, **SPRINGS),
    ],
    ids=["centre", "foot", "bed"],
)
def test_modes_of_the_elastic_column_that_has_settled(support):
    """Rocking and bending with their weights, and heave by itself, from matrices by hand."""
    x = places(getattr(support, "springs", 2))
    m, h, m_b, h_b = S1["mass"], S1["height"], S1["base_mass"], S1["base_height"]
    turning = S1["inertia"] + S1["base_inertia"] + m * h**2 + m_b * h_b**2
    mass = np.array([[turning, m * h, 0.0], [m * h, m, 0.0], [0.0, 0.0, m + m_b]])
    rocking = SPRINGS["stiffness"] * (x**2).sum() - GRAVITY * (m * h + m_b * h_b)
    stiffness = np.array(
        [
            [rocking, -m * GRAVITY, 0.0],
            [-m * GRAVITY, STIFFNESS, 0.0],
            [0.0, 0.0, SPRINGS["stiffness"] * len(x)],
        ]
    )
    expected = np.sqrt(eigh(stiffness, mass, eigvals_only=True))
    found = settled_modes(column(damping=0.0, support=undamped(support)))
    np.testing.assert_allclose(found, expected, rtol=1e-6)


def undamped(support):
    values = {"stiffness": support.stiffness, "damping": 0.0}
    values |= {k: getattr(support, k) for k in ("guided", "springs") if hasattr(support, k)}
    return type(support)(**values)


def test_a_stiff_column_on_two_springs_is_the_rigid_one():
    t = np.linspace(0.0, 1.0, 100)
    rigid = rk.simulate(on_springs(), PULSE).at(t)["theta"]
    size = np.abs(rigid).max()
    gaps = []
    for stiffness in (1e8, 1e9):
        # as much of critical damping each, or it would ring
        damping = 0.5 * np.sqrt(stiffness * S1["mass"])
        stiff = column(stiffness=stiffness, damping=damping, support=rk.TwoSprings(**SPRINGS))
        gaps.append(np.abs(rk.simulate(stiff, PULSE).at(t)["theta"] - rigid).max() / size)
    assert gaps[1] < 0.2 * gaps[0] < 1e-2


# -- springs that grow stiff: one foot pressed


def reduced(mass_matrix, forcing, coordinates, half_width):
    """The equations with the pressed foot at its level: d'Alembert along what is left."""
    theta = coordinates[0]
    q = [c.position for c in coordinates]
    n = len(q)
    level = half_width * sp.sin(theta.position)  # of the centre above the right foot
    moving = sp.eye(n)
    moving.col_del(1)
    moving[1, 0] = sp.diff(level, theta.position)
    drift = sp.zeros(n, 1)
    drift[1] = sp.diff(level, theta.position, 2) * theta.velocity**2
    left = moving.T * mass_matrix * moving
    return left, moving.T * (forcing - mass_matrix * drift)


STANDING = [
    ("lumped_mass_structure", {}),
    ("flexible_structure", {}),
    ("shear_frame", {"storeys": 2}),
]


@pytest.mark.parametrize(("name", "arguments"), STANDING)
def test_guided_at_the_foot_the_equations_tend_to_those_on_pinned_feet(name, arguments):
    model = rk.derive(name, **arguments, support="two_springs", guided="foot")
    pinned = rk.derive(name, **arguments).equations("right")
    half_width = next(p.symbol for p in model.parameters if p.name == "half_width")
    eq = model.mode("flight_right").equations.at_side(1)  # without the springs' forces
    mass_matrix, forcing = reduced(eq.mass_matrix, eq.forcing, model.coordinates, half_width)
    for lacking in (*(mass_matrix - pinned.mass_matrix), *(forcing - pinned.forcing)):
        assert tidy(lacking) == 0


def test_guided_at_the_centre_they_do_not():
    """The foot glides: what the mass matrix lacks is of the first order in theta."""
    model = rk.derive("flexible_structure", support="two_springs")
    pinned = rk.derive("flexible_structure").equations("right")
    half_width = next(p.symbol for p in model.parameters if p.name == "half_width")
    mass_matrix, forcing = free_motion(model)
    found, _ = reduced(mass_matrix, forcing, model.coordinates, half_width)
    theta = model.rotation.position
    lacking = (found - pinned.mass_matrix)[0, 0]
    assert tidy(lacking.subs(theta, 0)) == 0
    assert sp.simplify(sp.diff(lacking, theta).subs(theta, 0)) != 0


def test_the_guide_changes_its_foot_without_a_jump():
    """The base's centre goes on where it was, as fast as it went."""
    model = rk.derive("lumped_mass_structure", support="two_springs", guided="foot")
    theta = model.rotation
    for body in model.mode("right").bodies:
        x = body.position[0]
        left, right = (at_side(x, side) for side in (-1, 1))
        for order in (0, 1):
            difference = sp.diff(left - right, theta.position, order)
            assert sp.simplify(difference.subs(theta.position, 0)) == 0


def test_on_stiff_springs_guided_at_the_foot_it_turns_as_on_pinned_feet():
    """From one foot, until the other lands; guided at the centre it differs."""
    start = {"theta": 0.08, "u": 0.002}
    t = np.linspace(0.0, 0.2, 50)
    still = rk.GroundMotion.none(0.2)
    pinned = rk.simulate(column(), still, initial=start).at(t)["theta"]
    stiffness = 1e10
    settled = TOTAL_MASS * GRAVITY / stiffness  # half of it with both feet down, all on one
    heave = S1["half_width"] * np.sin(0.08) - settled / 2
    apart = {}
    for guided in ("foot", "centre"):
        springs = rk.TwoSprings(
            stiffness=stiffness, damping=np.sqrt(stiffness * TOTAL_MASS), guided=guided
        )
        run = rk.simulate(column(support=springs), still, initial=start | {"heave": heave})
        apart[guided] = np.abs(run.at(t)["theta"] - pinned).max()
    assert apart["foot"] < 1e-6
    assert apart["centre"] > 1e-5


# -- a Winkler bed


def test_each_spring_of_a_bed_carries_its_share():
    """Settled an equal one; turned a little, in proportion to its place."""
    springs = 6
    bed = lumped(rk.Winkler(springs=springs, stiffness=1e6, damping=0.0))
    names = ["left", *(f"spring_{i}" for i in range(2, springs)), "right"]
    share = TOTAL_MASS * GRAVITY / springs
    for theta in (0.0, 1e-4):
        forces = bed.reactions({"theta": theta})
        found = [forces[f"{name}_reaction"] for name in names]
        expected = share + 1e6 * places(springs) * np.sin(theta)
        np.testing.assert_allclose(found, expected, rtol=1e-12)


def test_pushover_of_a_bed_against_the_sum_over_its_springs():
    """Bilinear each: the heave that balances the weight, then the moment that is left."""
    springs, k = 7, 2e5
    bed = lumped(rk.Winkler(springs=springs, stiffness=k, damping=0.0))
    x, weight = places(springs), TOTAL_MASS * GRAVITY
    moment = GRAVITY * (S1["mass"] * S1["height"] + S1["base_mass"] * S1["base_height"])
    for theta in (1e-4, 0.003, 0.02, 0.1):
        low, high = -0.1, 0.1  # of the sole's middle below the tops
        for _ in range(200):
            middle = (low + high) / 2
            pressed = np.clip(middle + x * np.sin(theta), 0.0, None)
            low, high = (low, middle) if k * pressed.sum() > weight else (middle, high)
        held = k * (pressed * x).sum() * np.cos(theta) - moment * np.sin(theta)
        expected = held / (S1["height"] * np.cos(theta))
        assert bed.pushover([theta])[0] == pytest.approx(expected, rel=1e-7)


def test_energy_of_a_frame_on_an_undamped_bed_is_constant():
    frame = two_storeys(rk.Winkler(springs=3, stiffness=4e7, damping=0.0))
    run = rk.simulate(frame, rk.GroundMotion.none(2.0), initial={"theta": 0.01, "u_2": 0.02})
    assert len(run.events) > 5
    energy = run["total_energy"]
    assert np.ptp(energy) < 1e-7 * np.ptp(run["elastic_energy"])


# -- feet that slide


@pytest.mark.parametrize("side", [-1, 1])
@pytest.mark.parametrize("storeys", [False, True])
def test_on_a_foot_that_sticks_it_moves_as_on_pinned_feet(storeys, side):
    slides = rk.Sliding(friction=10.0, restitution=0.0)
    make = two_storeys if storeys else lambda support: column(support=support)
    sliding, pinned = make(slides), make(rk.Pinned())
    rng = np.random.default_rng(9)
    mode = "right" if side > 0 else "left"
    for _ in range(20):
        state = dict(zip(pinned.states, 0.1 * rng.standard_normal(len(pinned.states)), strict=True))
        state["theta"] = side * abs(state["theta"])
        expected = pinned.accelerations(state, 1.5, 0.5, mode=mode)
        y = sliding.state(state)
        assert sliding.module.MODES[sliding.mode_number(y)] == mode
        found = sliding.accelerations(state, 1.5, 0.5, mode=mode)  # whether or not it can stick
        for name, value in expected.items():
            assert found[name] == pytest.approx(value, rel=1e-9, abs=1e-9)
        forces, same = (s.reactions(state, 1.5, 0.5, mode=mode) for s in (pinned, sliding))
        for name, value in forces.items():
            assert same[name] == pytest.approx(value, rel=1e-9, abs=1e-6)


def test_with_much_friction_and_no_bounce_the_column_rocks_as_on_pinned_feet():
    """Each landing by the impulsive form of Lagrange's equations, which both derive."""
    rough = column(support=rk.Sliding(friction=50.0, restitution=0.0))
    t = np.linspace(0.0, 1.0, 100)
    rocking = rk.simulate(column(), PULSE, impact=rk.Impulsive())
    found = rk.simulate(rough, PULSE)
    assert len(rocking.impacts.above(1e-3)) > 1
    expected = rocking.at(t)["theta"]
    np.testing.assert_allclose(found.at(t)["theta"], expected, atol=1e-6 * np.abs(expected).max())


def test_with_little_friction_the_frame_stays_upright_and_slides():
    """The whole mass at first, as the storeys are stiff: the base slides where mu g is passed."""
    frame = two_storeys(rk.Sliding(friction=0.05, restitution=0.0), dampings=[1e5, 1e5])
    run = rk.simulate(frame, PULSE)
    assert np.abs(run["theta"]).max() == 0.0
    assert np.ptp(run["x"]) > 0.01
    assert run.support.friction_demand == pytest.approx(0.05, rel=1e-9)


# -- bad input


@pytest.mark.parametrize(
    ("make", "error", "says"),
    [
        (lambda: rk.TwoSprings(stiffness=-1.0, damping=0.0), ValueError, "stiffness is -1"),
        (lambda: rk.TwoSprings(stiffness="1", damping=0.0), TypeError, "stiffness is '1'"),
        (lambda: rk.TwoSprings(**SPRINGS, guided="left"), ValueError, "guided is 'left': give"),
        (lambda: rk.Winkler(springs=1, **SPRINGS), ValueError, "springs is 1: give a whole"),
        (lambda: rk.Winkler(springs=2.5, **SPRINGS), ValueError, "springs is 2.5: give a whole"),
        (lambda: rk.Sliding(friction=-0.1, restitution=0.0), ValueError, "friction is -0.1"),
        (lambda: rk.Sliding(friction=0.1, restitution=1.1), ValueError, "restitution is 1.1"),
        (lambda: column(support="sliding"), TypeError, "support is 'sliding': give a support,"),
        (
            lambda: two_storeys(
                rk.TwoSprings(**SPRINGS), inertias=None, base_inertia=0.0, base_height=0.0
            ),
            ValueError,
            "the base must have an inertia of its own",
        ),
        (
            lambda: column(base_mass=0.0, support=rk.Sliding(friction=0.3, restitution=0.0)),
            ValueError,
            "base_mass is 0: a base that slides has",
        ),
        (
            lambda: rk.derive("shear_frame", storeys=2, support="ice"),
            ValueError,
            "support is 'ice'",
        ),
        (
            lambda: rk.derive("flexible_structure", support="winkler"),
            TypeError,
            "on the support 'winkler' missing a",
        ),
        (
            lambda: rk.derive("flexible_structure", support="winkler", springs=1),
            ValueError,
            "springs is 1: give two or more",
        ),
    ],
)
def test_what_is_wrong_is_named(make, error, says):
    with pytest.raises(error, match=says):
        make()


def test_a_base_without_inertia_stands_on_pinned_feet():
    """There its mass at the edges' level turns about them."""
    bare = two_storeys(rk.Pinned(), inertias=None, base_inertia=0.0, base_height=0.0)
    assert np.isfinite(bare.accelerations({"theta": 0.01})["theta"])


# -- by name

BED = {"foundation_stiffness": 1e8, "foundation_damping": 1e5}
NAMED = {
    "pinned": ({}, rk.Pinned()),
    "two_springs": (
        {**BED, "guided": "foot"},
        rk.TwoSprings(stiffness=1e8, damping=1e5, guided="foot"),
    ),
    "winkler": ({**BED, "springs": 4}, rk.Winkler(springs=4, stiffness=1e8, damping=1e5)),
    "sliding": ({"friction": 0.3, "restitution": 0.1}, rk.Sliding(friction=0.3, restitution=0.1)),
}
FRAME = {
    "masses": [2e4, 3e4], "heights": [3.5, 7.0], "stiffnesses": [2e7, 2e7],
    "dampings": [1.2e5, 1.1e5], "half_width": 1.2, "base_mass": 1e4, "base_inertia": 5e3,
}  # fmt: skip


@pytest.mark.parametrize("support", NAMED)
def test_a_family_and_its_support_are_made_by_name_as_by_class(support):
    """In Python and on the command line: lists by commas, what the support takes beside them."""
    beside, made = NAMED[support]
    frame = rk.ShearFrame(**FRAME, support=made)
    assert rk.structure("shear_frame", **FRAME, support=support, **beside) == frame
    assert rk.structure("shear_frame", **FRAME, support=made) == frame
    words = {n: ",".join(map(str, v)) if type(v) is list else v for n, v in FRAME.items()}
    said = [f"{n}={v}" for n, v in (words | {"support": support} | beside).items()]
    assert command_line.made(Namespace(name="shear_frame", set=said)) == frame


def test_one_storey_is_one_number_on_the_command_line():
    said = ["masses=2e4", "heights=3.5", "stiffnesses=2e7", "dampings=0", "half_width=1.2"]
    frame = command_line.made(Namespace(name="shear_frame", set=[*said, "base_mass=1e4"]))
    assert frame.masses == (2e4,)


@pytest.mark.parametrize(
    ("changes", "error", "says"),
    [
        ({"support": "winklr"}, ValueError, r"'winklr' \(did you mean winkler\?\); there are"),
        ({"support": "winkler", "springs": 4}, TypeError, "missing foundation_stiffness, found"),
        (
            {"support": "sliding", "springs": 4, "friction": 0.3, "restitution": 0.0},
            TypeError, "'sliding': unknown springs. .* it takes friction, restitution",
        ),
        ({"springs": 4}, TypeError, 'springs is a parameter of a support: .* support="winkler"'),
        ({"support": "winkler", "springs": 1.5, **BED}, ValueError, "springs is 1.5: give a whole"),
        ({"support": 3}, TypeError, "support is 3: give a support, such as"),
    ],
)  # fmt: skip
def test_a_support_by_name_that_cannot_be_is_told_of(changes, error, says):
    with pytest.raises(error, match=says):
        rk.structure("shear_frame", **FRAME, **changes)


@pytest.mark.parametrize(
    ("said", "says"),
    [
        (["masses=2e4,x"], "--set masses=2e4,x: 'x' is no number; .* masses=20e3,20e3"),
        (["half_width=1,2"], "half_width=1,2: '1,2' is no number"),
        (["masses=1", "masses=2"], "masses is given twice"),
    ],
)
def test_lists_on_the_command_line_that_are_none_are_told_of(said, says):
    with pytest.raises(UsageError, match=says):
        command_line.made(Namespace(name="shear_frame", set=said))


def test_a_structure_that_takes_no_support_says_so():
    with pytest.raises(TypeError, match="unknown support"):
        rk.structure("rigid_block", half_width=0.1, half_height=0.4, support="winkler")


# -- what was derived, to read


@pytest.mark.parametrize(
    ("name", "arguments"),
    [
        ("shear_frame", {"storeys": 2}),
        ("shear_frame", {"storeys": 2, "support": "winkler", "springs": 3}),
        ("flexible_structure", {"support": "sliding"}),
        ("flexible_structure", {"support": "winkler", "springs": 3}),
        ("lumped_mass_structure", {"support": "two_springs", "guided": "foot"}),
    ],
)
def test_each_has_a_page_and_a_document(name, arguments):
    """With every coordinate's acceleration, and every parameter by its name."""
    model = rk.derive(name, **arguments)
    said = content(model, "width")
    page, document = to_markdown(said), to_latex(said)
    assert f"# {model.title}" in page
    for c in model.coordinates:
        shown = re.sub(r"_\{(\d)\}", r"_\1", sp.latex(c.acceleration))
        assert shown in page
        assert shown in document
    for p in model.parameters:
        assert f"`{p.name}`" in page
