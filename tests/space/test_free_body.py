"""Bodies that fly and turn in space: Euler's equations, shaking along three axes, declarations."""

import numpy as np
import pytest
import sympy as sp
from scipy.integrate import solve_ivp
from scipy.spatial.transform import Rotation

import rockeom as rk
from rockeom.symbolic import Body, Contact, Model, Rigid, coordinate, parameter, space

TIGHT = rk.SolverOptions(rtol=1e-12, atol=1e-14)
PLACE = [coordinate(x, x, "m", f"place along {x}") for x in "xyz"]
YAW, PITCH, ROLL = ANGLES = [
    coordinate(symbol, name, "rad", name)
    for symbol, name in (("psi", "yaw"), ("theta", "pitch"), ("phi", "roll"))
]
MASS, G = parameter("m", "mass", "kg", "mass"), parameter("g", "gravity", "m/s2", "gravity")
SIZE = (0.4, 0.7, 1.5)
FRAME = space.frame(*(c.position for c in ANGLES), origin=tuple(c.position for c in PLACE))
# about axes of its own a body of any shape
TENSOR = np.array([[0.9, 0.1, -0.05], [0.1, 0.7, 0.08], [-0.05, 0.08, 0.4]])


def model(*bodies: Body, **more) -> Model:
    return Model(
        **{"name": "free_body", "title": "Body in space"} | more, parameters=(MASS, G),
        coordinates=(*PLACE, *ANGLES), bodies=bodies, gravity=G.symbol, rotation=PITCH,
        bounds={"ground": PLACE[2].position + 100},
    )  # fmt: skip


def stone() -> Body:
    return space.body("stone", MASS.symbol, MASS.symbol * sp.Matrix(TENSOR), FRAME)


@pytest.fixture(scope="module")
def flying():
    return rk.structure(model(stone()), mass=2.0, gravity=9.81)


START = {
    "yaw": 0.4, "pitch": 0.2, "roll": -0.3, "x_dot": 0.5, "z_dot": 2.0, "yaw_dot": 1.1,
    "pitch_dot": -0.8, "roll_dot": 0.6,
}  # fmt: skip


def spin_of(start) -> np.ndarray:
    """Angular velocity along the axes of the ground, of R = Rz Ry Rx."""
    yaw, pitch = start["yaw"], start["pitch"]
    about_y = Rotation.from_euler("z", yaw).apply([0, 1, 0])
    about_x = Rotation.from_euler("ZY", [yaw, pitch]).apply([1, 0, 0])
    return (
        start["yaw_dot"] * np.array([0, 0, 1])
        + start["pitch_dot"] * about_y
        + start["roll_dot"] * about_x
    )


def by_euler(duration: float) -> Rotation:
    """Orientation at the end by Euler's equations and a quaternion."""
    rotation = Rotation.from_euler("ZYX", [START[n] for n in ("yaw", "pitch", "roll")])
    spin = rotation.inv().apply(spin_of(START))

    def rates(_, y):
        q, w = y[:4], y[4:]
        turning = np.array([*(np.cross(w, q[:3]) * -1 + w * q[3]), -w @ q[:3]]) / 2
        return [*turning, *np.linalg.solve(TENSOR, -np.cross(w, TENSOR @ w))]

    end = solve_ivp(
        rates, (0, duration), [*rotation.as_quat(), *spin], "DOP853", rtol=1e-12, atol=1e-14
    )
    return Rotation.from_quat(end.y[:4, -1])


def test_a_stone_turns_as_eulers_equations_have_it(flying):
    run = rk.simulate(flying, rk.GroundMotion.none(1.5), initial=START, options=TIGHT)
    np.testing.assert_allclose(
        flying.rotations(run.final)["stone"], by_euler(1.5).as_matrix(), atol=1e-10
    )
    place = [0.5 * 1.5, 0.0, 2.0 * 1.5 - 9.81 * 1.5**2 / 2]
    np.testing.assert_allclose(flying.positions(run.final)["stone"], place, atol=1e-12)
    assert run.energy_balance().error < 1e-12


def test_energy_is_that_of_the_spin_in_the_axes_of_the_body(flying):
    rotation = Rotation.from_euler("ZYX", [START[n] for n in ("yaw", "pitch", "roll")])
    spin = rotation.inv().apply(spin_of(START))
    kinetic = flying.energies(START)["kinetic_energy"]
    assert kinetic == pytest.approx(2.0 * (0.5**2 + 2.0**2) / 2 + 2.0 * spin @ TENSOR @ spin / 2)


def test_a_box_has_the_tensor_of_its_sides():
    box = space.box("box", sp.Integer(12), SIZE, FRAME)
    b, c, h = SIZE
    expected = np.diag([c**2 + h**2, b**2 + h**2, b**2 + c**2])
    np.testing.assert_allclose(np.array(box.inertia, float), expected, rtol=1e-15)
    masses = space.cylinder("column", sp.Integer(2), 0.3, 1.2, FRAME).inertia
    np.testing.assert_allclose(np.diag(np.array(masses, float)), [0.285, 0.285, 0.09], rtol=1e-15)


def test_a_point_mass_has_no_spin():
    body = Body("mass", MASS.symbol, FRAME.at((0, 0, 1)))
    assert body.inertia == sp.zeros(3, 3)
    assert body.rotation == sp.eye(3)


SKEW = sp.Matrix(TENSOR) + sp.Matrix([[0, 1, 0], [0, 0, 0], [0, 0, 0]])
REFUSED = {
    "tensor that is not symmetric": (
        lambda: space.body("stone", MASS.symbol, SKEW, FRAME), "inertia", "not symmetric",
    ),
    "tensor that is a number": (
        lambda: Body("stone", MASS.symbol, FRAME.at((0, 0, 1)), sp.Integer(1), FRAME.rotation),
        "inertia", "a matrix of SymPy, 3 by 3, in space",
    ),
    "place with four coordinates": (
        lambda: Body("stone", MASS.symbol, (0, 0, 0, 1)), "a point as (x, y), in space (x, y, z)",
    ),
    "bodies of the plane and of space": (
        lambda: model(stone(), Body("mass", MASS.symbol, (PLACE[0].position, PLACE[2].position))),
        "some of its bodies have places (x, y), others (x, y, z)",
    ),
    "contacts of the plane": (
        lambda: model(
            stone(),
            contacts=[Contact("tip", PLACE[2].position, PLACE[0].position, Rigid(restitution=0))],
        ),
        "its bodies move in space, and contact 'tip' in the plane",
    ),
}  # fmt: skip


@pytest.mark.parametrize("item", REFUSED)
def test_a_declaration_that_cannot_be_meant_is_refused(item):
    declare, *words = REFUSED[item]
    with pytest.raises(ValueError) as caught:  # noqa: PT011
        declare()
    assert all(word in str(caught.value) for word in words)


@pytest.mark.parametrize("moments", [(1.0, 1.0, 2.1), (0.2, 0.5, 1.0)])
def test_a_tensor_of_no_masses_is_refused_by_its_values(moments):
    along = [parameter(f"I_{x}", f"inertia_{x}", "kg m2", f"moment about {x}") for x in "xyz"]
    body = space.body("stone", MASS.symbol, sp.diag(*(p.symbol for p in along)), FRAME)
    declared = Model(
        name="stone", title="Stone", parameters=(MASS, *along, G), coordinates=(*PLACE, *ANGLES),
        bodies=[body], gravity=G.symbol, rotation=PITCH, bounds={"ground": PLACE[2].position + 100},
    )  # fmt: skip
    values = {p.name: value for p, value in zip(along, moments, strict=True)}
    with pytest.raises(ValueError, match="may be above the sum of the other two"):
        rk.structure(declared, mass=1.0, gravity=9.81, **values)
    rk.structure(declared, mass=1.0, gravity=9.81, **values | {"inertia_z": moments[1]})
