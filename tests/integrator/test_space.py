"""Ground that shakes along three axes: of modules whose functions take three accelerations."""

import re
from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import rockeom as rk
from rockeom.exports.code import code
from rockeom.integrator.program import program
from rockeom.integrator.texts import load_text, source
from rockeom.simulation.case import Problem
from rockeom.simulation.simulate import run
from tests.typical import S1

METHODS = pytest.mark.parametrize("method", ["DOP853", "RK45", "Radau"])

# -- a point on springs that are coupled, one of which is stiffer while it is pressed

POINT = '''"""A point on springs."""
from rockeom.generated.prelude import LOCALISED, FULL_CONTACT, N_FALLS, N_PARTS, full_contact_guards

NAME = "point_on_springs"
GROUND = ("horizontal", "transverse", "vertical")
N_STATES = 6
ROTATION, ROTATION_RATE = 0, 3
N_GUARDS = 1
MODES = ("soft", "stiff")
SIDES = (0.0, 0.0)
GUARDS = (1, 1)
EQUATIONS = (0, 1)
KINDS = ((2,), (2,))
TARGETS = ((1,), (0,))
REVERSE = ((0,), (0,))
PARTS = ((-1,), (-1,))

def accelerations(mode, x, y, z, x_dot, y_dot, z_dot, p, ax, ay, az):
    force = p[0] * (x + 2.0 * y - z) + p[1] * (x * x + y * y + z * z) * x + 0.3 * x_dot
    pressed = p[2] * (z - 0.5 * y) if mode == 1 else 0.0
    return -force - ax, -2.0 * force + 0.5 * pressed - 9.0 * y - ay, force - pressed - 4.0 * z - az

def rates(mode, y, p, ax, ay, az, dy):
    acc = accelerations(mode, y[0], y[1], y[2], y[3], y[4], y[5], p, ax, ay, az)
    dy[0], dy[1], dy[2] = y[3], y[4], y[5]
    dy[3], dy[4], dy[5] = acc[0], acc[1], acc[2]

def opening_acceleration(mode, y, p, ax, ay, az):
    return 0.0

def guards(mode, y, p, ax, ay, az, g):
    g[0] = z_above(y, ax, ay, az) if mode == 0 else -z_above(y, ax, ay, az)

def z_above(y, ax, ay, az):
    return y[2] + 0.1 + 0.01 * (ax - 2.0 * ay + 0.5 * az)

def jump(mode, guard, law, ratio, y, p, out):
    for i in range(6):
        out[i] = y[i]
    return 1 - mode

def energies(mode, y, p, out):
    out[0] = out[1] = out[2] = 0.0

def kinematics(mode, y, p, out):
    pass

def reactions(mode, y, p, ax, ay, az, out):
    pass
'''
P = np.array([12.0, 30.0, 80.0])
START = np.array([0.05, -0.1, 0.02, 0.0, 0.3, 0.0])
PULSES = (
    rk.GroundMotion.single_sine(3.0, 0.9),
    rk.GroundMotion.ricker(4.0, 0.7),
    rk.GroundMotion.from_array([0.0, 2.0, -3.0, 1.0, 0.0], dt=0.4),
)
END = 2.5


def shaken_point():
    tables = dict(zip(("horizontal", "transverse", "vertical"), PULSES, strict=True))
    return Problem(
        0, START, P, [], 0, 0.0, 9.0, **{name: m.segments for name, m in tables.items()},
        end=END, quiet_from=np.inf,
    )  # fmt: skip


@cache
def of_scipy():
    """(last state, times of the switches) of the point."""
    module = load_text("point_on_springs", POINT)

    def accelerations(t):
        return [float(m.acceleration(t)) for m in PULSES]

    def rate(t, y, mode):
        dy = np.zeros(6)
        module.rates(mode, y, P, *accelerations(t), dy)
        return dy

    def pressed(t, y, mode):
        return module.z_above(y, *accelerations(t)) * (1 - 2 * mode)

    pressed.terminal, pressed.direction = True, -1
    t, y, mode, times = 0.0, START, 0, []
    while True:
        corners = [c for c in (0.4, 0.8, 0.9, 1.2, 1.6, END) if c > t + 1e-12]
        ran = solve_ivp(
            rate, (t, corners[0]), y, "DOP853", events=pressed, args=(mode,), rtol=1e-13, atol=1e-14
        )
        t, y = ran.t[-1], ran.y[:, -1]
        if ran.status == 1:
            times.append(t)
            mode = 1 - mode
        elif t == END:
            return y, times


@METHODS
def test_point_under_three_pulses_moves_as_scipy_says(method):
    module = load_text("point_on_springs", POINT)
    options = rk.SolverOptions(method=method, rtol=1e-12, atol=1e-13)
    motion = run(program(module, method), shaken_point(), options)
    y, times = of_scipy()
    assert len(times) > 1
    np.testing.assert_allclose(motion.events.times, times, atol=1e-9)
    np.testing.assert_allclose(motion.y, y, atol=1e-9)


# -- structures of the plane, shaken by half of the transverse acceleration, too

ACROSS = rk.GroundMotion.from_array([0.0, 3.0, -5.0, 2.0, 4.0, -6.0, 1.0, -2.0, 3.0, 0.0], dt=0.15)
SIDEWAYS = rk.GroundMotion.from_array(
    [0.0, 2.0, 4.0, -3.0, 1.0, -4.0, 3.0, 5.0, -2.0, 0.0], dt=0.15
)
UP = rk.GroundMotion.ricker(1.5, 1.2)
BOTH = rk.GroundMotion.from_array(ACROSS.samples + 0.5 * SIDEWAYS.samples, dt=0.15)
PLANE = {
    "block": rk.RigidBlock(half_width=0.1, half_height=0.4),
    "column": rk.FlexibleStructure(**S1, stiffness=571.8e3, damping=502.4),
    "sliding": rk.SlidingBlock(half_width=0.1, half_height=0.3, friction=0.5, restitution=0.1),
}


def in_space(structure):
    """The structure with a module whose functions take three accelerations."""
    text = source(structure.module).replace("ax, ay", "ax, 0.0, ay")
    defined = re.compile(r"(def \w+\(.*)ax, 0\.0, ay(.*\):)$", re.MULTILINE)
    text = defined.sub(r"\1ax, across, ay\2\n    ax = ax + 0.5 * across", text)
    text += '\nGROUND = ("horizontal", "transverse", "vertical")\n'
    module = load_text(structure.module.NAME, text)
    kind = type(structure)
    other = type(kind.__name__, (kind,), {"module": property(lambda self: module)})
    spatial = object.__new__(other)
    spatial.__dict__.update({k: v for k, v in vars(structure).items() if k != "module"})
    return spatial


def cases(name):
    """The structure under both motions apart, and in the plane under their sum."""
    structure, how = PLANE[name], {"vertical": UP, "duration": 2.5}
    return (
        rk.Case(in_space(structure), ACROSS, transverse=SIDEWAYS, **how),
        rk.Case(structure, BOTH, **how),
    )


@METHODS
@pytest.mark.parametrize("name", PLANE)
def test_transverse_motion_acts_where_the_equations_have_it(name, method):
    options = rk.SolverOptions(method=method)
    one, other = (rk.simulate(case, options=options) for case in cases(name))
    assert one.outcome == other.outcome
    assert len(one.events) == len(other.events) > 2
    np.testing.assert_allclose(one.events.times, other.events.times, rtol=1e-9)
    np.testing.assert_allclose(one.end, other.end, rtol=1e-7, atol=1e-10)


@pytest.mark.parametrize("name", PLANE)
def test_derivatives_by_each_motion(name):
    """Those by the factor of all motions are the sum of the others, and those of the plane."""
    one, other = cases(name)
    names = ["scale", "motion.scale", "transverse.scale", "vertical.scale", "transverse.time_scale"]
    state = one.structure.states[0]
    of = [f"end {state}"]
    space, plane = rk.sensitivity(one, of=of, to=names), rk.sensitivity(other, of=of, to=names[:1])
    whole, *parts, by_time = space.derivatives[0]
    assert whole == pytest.approx(plane.derivatives[0, 0], rel=1e-6)
    assert whole == pytest.approx(sum(parts), rel=1e-9)
    assert all(np.abs(parts) > 1e-6)
    step = 1e-5
    ends = [
        rk.simulate(replace(one, transverse=SIDEWAYS.scaled(a, time=b))).end[0]
        for a, b in ((1 + step, 1.0), (1 - step, 1.0), (1.0, 1 + step), (1.0, 1 - step))
    ]
    assert (ends[0] - ends[1]) / (2 * step) == pytest.approx(parts[1], rel=1e-4)
    assert (ends[2] - ends[3]) / (2 * step) == pytest.approx(by_time, rel=1e-3)


def test_sweeps_keep_the_transverse_motion():
    one, _ = cases("column")
    sweep = rk.simulate_many(one, over={"transverse.scale": [0.5, 1.0]})
    alone = [rk.simulate(replace(one, transverse=SIDEWAYS.scaled(x))) for x in (0.5, 1.0)]
    peaks = [abs(r.extremes("theta").peak) for r in alone]
    np.testing.assert_allclose(sweep.peak[:, 0], peaks, rtol=1e-12)
    shaking = alone[1]["transverse_ground_acceleration"]
    np.testing.assert_allclose(shaking, SIDEWAYS.acceleration(alone[1].t), atol=1e-12)


def test_what_the_plane_and_space_do_not_have_is_refused():
    with pytest.raises(rk.InputError, match="RigidBlock moves in a plane"):
        rk.Case(PLANE["block"], ACROSS, transverse=SIDEWAYS)
    with pytest.raises(rk.InputError, match="SlidingBlock moves in space, where the ground is lev"):
        rk.simulate(in_space(PLANE["sliding"]), ACROSS, slope="5 deg")
    many = rk.Case(in_space(PLANE["block"]), ACROSS, transverse=SIDEWAYS)
    with pytest.raises(rk.InputError, match="lanes carry motions in the plane, and rigid_block"):
        rk.simulate_many(many, {"scale": [1.0]}, sweep_options=rk.SweepOptions(lanes=True))
    with pytest.raises(rk.InputError, match="moves in space, which is not written in other lang"):
        code(in_space(PLANE["block"]).module, "c")
    with pytest.raises(TypeError, match="transverse"):
        rk.Case(in_space(PLANE["block"]), ACROSS, transverse=SIDEWAYS.samples)
