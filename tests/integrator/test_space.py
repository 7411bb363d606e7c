"""Ground that shakes along three axes: of modules whose functions take three accelerations."""

import re
from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import rockeom as rk
from rockeom.exports.code import code
from rockeom.integrator.texts import load_text, source
from tests.typical import S1

METHODS = pytest.mark.parametrize("method", ["DOP853", "RK45", "Radau"])

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
def test_column_under_three_pulses_rocks_as_scipy_says(method):
    """Until its foot lands, by its equations alone."""
    pulses = rk.GroundMotion.single_sine(3.0, 0.5), rk.GroundMotion.ricker(4.0, 0.15), SIDEWAYS
    column, end = in_space(PLANE["column"]), 0.35
    case = rk.Case(
        column, pulses[0], initial={"theta": 0.12, "u_dot": 0.3}, duration=end,
        transverse=pulses[1], vertical=pulses[2],
    )  # fmt: skip
    run = rk.simulate(case, options=rk.SolverOptions(method=method, rtol=1e-12, atol=1e-13))

    def rates(t, y):
        dy = np.zeros(4)
        shaking = (float(pulse.acceleration(t)) for pulse in pulses)
        column.module.rates(column.module.RIGHT, y, column.vector, *shaking, dy)
        return dy

    start = case.problem().y0
    how = {"method": "DOP853", "max_step": 0.01, "rtol": 1e-13, "atol": 1e-15}
    wanted = solve_ivp(rates, (0.0, end), start, **how).y[:, -1]
    assert not len(run.events)
    np.testing.assert_allclose(run.end, wanted, atol=1e-9)


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
    of, to = [f"end {one.structure.states[0]}"], ["motion.scale", "transverse.scale"]
    space = rk.sensitivity(one, of=of, to=["scale", *to, "vertical.scale"]).derivatives[0]
    plane = rk.sensitivity(other, of=of, to=["scale"]).derivatives[0]
    assert space[0] == pytest.approx(plane[0], rel=1e-6)
    assert space[0] == pytest.approx(space[1:].sum(), rel=1e-9)
    assert (np.abs(space) > 1e-6).all()
    jumping = rk.GroundMotion.single_cosine(4.0, 0.7)  # where it ends, which moves with its time
    case = replace(one, transverse=jumping)
    scaled = {"scale": jumping.scaled, "time_scale": lambda x: jumping.scaled(1.0, time=x)}
    for name, motion in scaled.items():
        by_name = rk.sensitivity(case, of=of, to=[f"transverse.{name}"]).derivatives[0, 0]
        sides = (replace(case, transverse=motion(x)) for x in (1 - 1e-5, 1 + 1e-5))
        low, high = (rk.simulate(side).end[0] for side in sides)
        assert (high - low) / 2e-5 == pytest.approx(by_name, rel=1e-3)


def test_sweeps_and_files_keep_the_transverse_motion(tmp_path):
    one, _ = cases("column")
    sweep = rk.simulate_many(one, over={"transverse.scale": [0.5, 1.0]})
    alone = [rk.simulate(replace(one, transverse=SIDEWAYS.scaled(x))) for x in (0.5, 1.0)]
    peaks = [abs(r.extremes("theta").peak) for r in alone]
    np.testing.assert_allclose(sweep.peak[:, 0], peaks, rtol=1e-12)
    replace(alone[1], structure=PLANE["column"]).save(tmp_path / "run.nc")
    np.testing.assert_array_equal(rk.load(tmp_path / "run.nc").transverse.samples, SIDEWAYS.samples)
    shaking = alone[1]["transverse_ground_acceleration"]
    np.testing.assert_allclose(shaking, SIDEWAYS.acceleration(alone[1].t), atol=1e-12)


def test_what_the_plane_and_space_do_not_have_is_refused():
    with pytest.raises(rk.InputError, match="RigidBlock moves in a plane"):
        rk.Case(PLANE["block"], ACROSS, transverse=SIDEWAYS)
    with pytest.raises(rk.InputError, match="SlidingBlock moves in space, and its ground is lev"):
        rk.simulate(in_space(PLANE["sliding"]), ACROSS, slope="5 deg")
    many = rk.Case(in_space(PLANE["block"]), ACROSS, transverse=SIDEWAYS)
    with pytest.raises(rk.InputError, match="lanes are of the plane, and rigid_block moves in"):
        rk.simulate_many(many, {"scale": [1.0]}, sweep_options=rk.SweepOptions(lanes=True))
    with pytest.raises(rk.InputError, match="moves in space, which is not written in other lang"):
        code(in_space(PLANE["block"]).module, "c")
    with pytest.raises(TypeError, match="transverse"):
        rk.Case(in_space(PLANE["block"]), ACROSS, transverse=SIDEWAYS.samples)
