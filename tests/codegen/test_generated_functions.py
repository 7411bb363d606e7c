"""Generated functions against lambdified expressions, at 1,000 random states a mode.

Both sides start from the same derived expressions, but nothing else is shared: the generated
text has its common subexpressions, constants and solution of M q'' = f written out; here NumPy
evaluates the plain expressions and LAPACK solves. What differs is rounding, so the tolerance is
1e-12 of the size of the terms that were added up, and not of their sum, which may cancel.
"""

import functools
import importlib
import itertools
import zlib

import mpmath
import numpy as np
import pytest
import sympy as sp
from sympy.core.function import AppliedUndef

import rockeom as rk
from rockeom.codes import IMPULSIVE, RATIO
from rockeom.generated import rigid_block
from rockeom.symbolic.algebra import SIDE
from rockeom.symbolic.model import GROUND_X, GROUND_Y
from rockeom.symbolic.reactions import reactions
from rockeom.symbolic.statics import LOAD, equilibrium
from tests.evaluation import Values
from tests.shipped import PINNED, plain
from tests.typical import S1, oscillator

N = 1000
TOLERANCE = 1e-12

TWO_MASSES = S1 | {"gravity": 9.81}
WALL = {
    "mass": 2000.0,
    "height": 2.4,
    "half_width": 0.5,
    "edge_distance": 0.1,
    "transition": 0.2,  # so that random displacements are on both sides of it
    "tendon_stiffness": 11.7e6,
    "initial_force": 75e3,
    "yield_force": 160e3,
    "eccentricity": 0.1,
    "gravity": 9.81,
}
TURNING = {"inertia": 2e3, "centroid_height": 2.1, "anchor_height": 2.9, "anchor_depth": 0.2}
BLOCK = {"mass": 2000.0, "pivot_inertia": 12e3, "centroid_height": 2.1} | WALL
PASSAGES = {
    "effective_mass": 2000.0,
    "regularisation": 0.2,
    "held": 0.5,
    "energy_ratio": 0.7,
    "energy_ratio_2": 0.6,
    "energy_ratio_3": 0.5,
    "energy_ratio_4": 0.4,
    **{f"energy_ratio_slope_{i}": 0.01 for i in range(1, 5)},
    "speed_limit_1": 0.3,
    "speed_limit_2": 0.6,
    "speed_limit_3": 1.0,
}
TYPICAL = {
    "rigid_block": {
        "mass": 334.0,
        "half_width": 0.1,
        "height": 0.45,
        "inertia": 24.0,
        "gravity": 9.81,
    },
    "slender_block": {
        "mass": 334.0,
        "radius": 0.46,
        "alpha": 0.2,
        "inertia": 24.0,
        "gravity": 9.81,
    },
    "nondimensional_block": {"alpha": 0.3, "radius_ratio": 0.75},
    "dirac_delta_block": {"alpha": 0.3, "energy_ratio": 0.7, "regularisation": 0.2},
    "lumped_mass_structure": TWO_MASSES,
    "two_spring_structure": TWO_MASSES | {"foundation_stiffness": 5.5e5, "foundation_damping": 3e3},
    "two_spring_cart": TWO_MASSES | {"foundation_stiffness": 5.5e5},
    "uplifting_oscillator": oscillator().parameters(),
    "flexible_structure": TWO_MASSES | {"stiffness": 571.8e3, "damping": 502.4},
    "controlled_wall": WALL | TURNING,
    "flexible_controlled_wall": WALL | TURNING | {"stiffness": 40e6, "damping": 2e4},
    "controlled_wall_oscillator": WALL | PASSAGES,
    "substitute_gravity_wall": BLOCK,
    "simplified_substitute_gravity_wall": BLOCK,
}


@functools.cache
def model(name):
    return rk.derive(name)


@functools.cache
def module(name):
    return importlib.import_module(f"rockeom.generated.{name}")


@functools.cache
def modes(name):
    return model(name).lambdify()


class Sample:
    """n random states of one mode with as many random structures and accelerations."""

    def __init__(self, name, mode_name, n=N):
        self.name, self.mode_name, self.model, self.n = name, mode_name, model(name), n
        self.mode = self.model.mode(mode_name)
        self.side = self.mode.side_of(mode_name)
        rng = np.random.default_rng(zlib.crc32(f"{name} {mode_name}".encode()))
        self.parameters = {
            k: value * rng.uniform(0.8, 1.25, self.n) for k, value in TYPICAL[name].items()
        }
        half = len(self.model.states) // 2
        self.y = np.concatenate(
            [rng.uniform(-0.6, 0.6, (half, self.n)), rng.uniform(-2, 2, (half, self.n))]
        )
        if self.side:  # on its own side
            row = self.model.states.index(self.model.rotation.name)
            self.y[row] = self.side * np.abs(self.y[row])
        held = set(range(half)) - {self.model.coordinates.index(c) for c in self.mode.coordinates}
        for row in held:
            self.y[row] = self.y[half + row] = 0.0
        self.ax, self.ay, self.load = rng.uniform(-10, 10, (3, self.n))

    def values(self, *expressions, accelerations=()):
        """(k, n): expressions of the model at the sample."""
        m, half = self.model, len(self.model.coordinates)
        known = Exact(m, self.mode_name, {p.symbol: self.parameters[p.name] for p in m.parameters})
        for i, c in enumerate(m.coordinates):
            known |= {c.position: self.y[i], c.velocity: self.y[half + i]}
        known |= {SIDE: self.side, GROUND_X: self.ax, GROUND_Y: self.ay, LOAD: self.load}
        known |= zip(m.switches, self.mode.states_of(self.mode_name), strict=True)
        free = [c.acceleration for c in self.mode.coordinates]
        known |= dict(zip(free, accelerations, strict=False))
        return np.array([np.broadcast_to(known[sp.sympify(e)], (self.n,)) for e in expressions])

    def sizes(self, *expressions, accelerations=()):
        """(k, n): the sums of the absolute values of the expressions' terms, laws a number each."""
        parts = [terms(e) for e in expressions]
        found = np.abs(
            self.values(*(t for part in parts for t in part), accelerations=accelerations)
        )
        ends = np.cumsum([0, *map(len, parts)])
        return np.array([found[a:b].sum(axis=0) for a, b in itertools.pairwise(ends)])

    def sizes_written_out(self, *expressions):
        """The same with the terms of the laws, where these are differences of larger numbers."""
        return self.sizes(*(self.model.in_mode(e, self.mode_name) for e in expressions))

    def solution_size(self):
        """(d, n): the scale of rounding errors of q'' = M^-1 f."""
        equations = self.model.equations(self.mode_name)
        d = len(self.mode.coordinates)
        mass = self.values(*equations.mass_matrix).reshape(d, d, self.n)
        mass_size = self.sizes(*equations.mass_matrix).reshape(d, d, self.n)
        right_size = self.sizes(*equations.forcing).reshape(d, self.n)
        found = modes(self.name)[self.mode_name].accelerations(
            self.y, self.parameters, self.ax, self.ay
        )
        inverse = np.abs(np.linalg.inv(np.moveaxis(mass, -1, 0)))
        lacking = np.einsum("ijn,jn->in", mass_size, np.abs(found)) + right_size
        return np.einsum("nij,jn->in", inverse, lacking)

    @functools.cached_property
    def prepared(self):
        """(n, m): parameters with their constants, as generated functions take them."""
        p = np.array([self.parameters[k] for k in module(self.name).PARAMETERS])
        return [module(self.name).prepare(np.ascontiguousarray(row)) for row in p.T]

    def generated(self, function, length, *arguments):
        """(length, n): a function of the generated module at each state."""
        number = module(self.name).MODES.index(self.mode_name)
        out = np.empty((self.n, length))
        compiled = getattr(module(self.name), function)
        states, structures = np.ascontiguousarray(self.y.T), self.prepared
        for i in range(self.n):
            compiled(number, states[i], structures[i], *(a[i] for a in arguments), out[i])
        return out.T


class Exact(Values):
    """Values in a mode, of its laws and derived constants by what they stand for."""

    def __init__(self, model, mode_name, given):
        super().__init__(given)
        self.model, self.mode_name = model, mode_name
        self.named = {law.symbol for law in model.functions}

    def _of(self, expr):
        if expr in self.model.constants:
            return self[self.model.constants[expr]]
        if expr in self.named or isinstance(expr, AppliedUndef | sp.Derivative | sp.Subs):
            return self[self.model.in_mode(expr, self.mode_name)]
        return super()._of(expr)


@functools.cache
def terms(expr):
    """Of the expression multiplied out; what would split a power or a logarithm makes no terms."""
    expr = sp.sympify(expr).replace(sp.Min, sp.Add)
    found = sp.expand(expr, basic=False, log=False, power_base=False, power_exp=False)
    return sp.Add.make_args(found)


def assert_agree(what, found, expected, size):
    excess = np.abs(found - expected) / np.maximum(size, 1e-300)
    assert excess.max() <= TOLERANCE, f"{what}: differs by {excess.max():.2e} of its terms' size"


for shipped in filter(lambda name: name not in TYPICAL, PINNED):
    TYPICAL[shipped] = rk.structure(shipped, **plain(shipped)).parameters()
STRUCTURES = pytest.mark.parametrize("name", PINNED)


@functools.cache
def samples(name):
    """Of each mode; tests do not change them."""
    return [Sample(name, mode_name) for mode_name in model(name).mode_names]


@STRUCTURES
def test_rates(name):
    for sample in samples(name):
        found = sample.generated("rates", len(sample.model.states), sample.ax, sample.ay)
        expected = modes(name)[sample.mode_name].rates(
            sample.y, sample.parameters, sample.ax, sample.ay
        )
        size = np.abs(expected)
        half = len(found) // 2
        for coordinate, scale in zip(sample.mode.coordinates, sample.solution_size(), strict=True):
            size[half + sample.model.coordinates.index(coordinate)] = scale
        assert_agree(f"rates in {sample.mode_name}", found, expected, size)


@STRUCTURES
def test_energies(name):
    for sample in samples(name):
        expected = modes(name)[sample.mode_name].energies(sample.y, sample.parameters)
        eq = sample.mode.equations
        size = sample.sizes_written_out(
            eq.kinetic_energy, eq.gravitational_energy, eq.elastic_energy
        )
        found = sample.generated("energies", len(expected))
        assert tuple(expected) == module(name).ENERGIES
        assert_agree(f"energies in {sample.mode_name}", found, list(expected.values()), size)


@STRUCTURES
def test_reactions(name):
    for sample in samples(name):
        expected = modes(name)[sample.mode_name].reactions(
            sample.y, sample.parameters, sample.ax, sample.ay
        )
        assert tuple(expected) == module(name).REACTIONS
        told = reactions(sample.model, sample.mode) | sample.mode.quantities_in("N")
        size = sample.sizes(
            *told.values(),
            accelerations=sample.solution_size(),
        )
        found = sample.generated("reactions", len(expected), sample.ax, sample.ay)
        assert_agree(f"reactions in {sample.mode_name}", found, list(expected.values()), size)


@STRUCTURES
def test_kinematics(name):
    """Displacement and uplifts against the positions of the bodies, from rest."""
    for sample in samples(name):
        mode = modes(name)[sample.mode_name]
        now = mode.positions(sample.y, sample.parameters)
        rest = mode.positions(np.zeros_like(sample.y), sample.parameters)
        size = {k: np.abs(v) + np.abs(rest[k]) for k, v in now.items()}
        loaded = [b.name for b in sample.mode.bodies if b.position == sample.mode.load_point]
        columns = {"displacement": (loaded[0] if loaded else "load point", 0)}
        load = sample.values(*sample.mode.load_point)  # x is zero upright
        now["load point"], rest["load point"] = load, np.zeros_like(load)
        size["load point"] = np.abs(load) + sample.sizes(*sample.mode.load_point)
        columns |= {f"{foot}_uplift": (f"{foot}_foot", 1) for foot in sample.mode.feet}
        told = sample.mode.quantities_in("m")
        found = sample.generated("kinematics", len(columns) + len(told))
        assert (*columns, *told) == module(name).KINEMATICS
        if told:
            values, sizes = sample.values(*told.values()), sample.sizes(*told.values())
            lengths = 10.0  # in m: what extensions and distances are differences of
            assert_agree(
                f"lengths in {sample.mode_name}", found[len(columns) :], values, sizes + lengths
            )
        for name_of_column, row in zip(columns, found, strict=False):
            body, axis = columns[name_of_column]
            assert_agree(
                f"{name_of_column} in {sample.mode_name}",
                row,
                now[body][axis] - rest[body][axis],
                size[body].sum(axis=0),
            )


@STRUCTURES
def test_guards(name):
    m = module(name)
    for sample in samples(name):
        expected = modes(name)[sample.mode_name].guards(
            sample.y, sample.parameters, sample.ax, sample.ay
        )
        found = sample.generated("guards", m.N_GUARDS + m.N_PARTS, sample.ax, sample.ay)
        leaving = [t for t in sample.model.transitions if t.source == sample.mode_name]
        assert [t.target for t in leaving] == [
            b for a, b, _ in m.TRANSITIONS if a == sample.mode_name
        ]
        for t, row in zip(leaving, found, strict=False):
            if t.kind == "uplift":
                # q'' of the structure closed and at rest: the size is that of its own mode
                opened = Sample(name, t.target)
                opened.y, opened.parameters = sample.y, sample.parameters
                opened.ax, opened.ay = sample.ax, sample.ay
                place = [c.name for c in opened.mode.coordinates].index(sample.model.rotation.name)
                size = opened.solution_size()[place]
            else:
                (size,) = sample.sizes_written_out(t.guard)
            assert_agree(f"{sample.mode_name} to {t.target}", row, expected[t.target], size)


@STRUCTURES
def test_statics(name):
    for sample in samples(name):
        rows = equilibrium(sample.mode)
        free = {c.name: e for c, e in zip(sample.mode.coordinates, rows, strict=True)}
        every = [free.get(c.name, sp.Integer(0)) for c in sample.model.coordinates]
        found = sample.generated("statics", len(every), sample.load)
        assert_agree(
            f"statics in {sample.mode_name}", found, sample.values(*every), sample.sizes(*every)
        )


@STRUCTURES
def test_velocity_ratio_and_overturning(name):
    sample = samples(name)[0]
    ratio = sample.model.velocity_ratio
    forms = {"overturning": sample.model.overturning}
    if ratio is sp.nan:  # each foot has its own
        assert np.isnan([module(name).velocity_ratio(p) for p in sample.prepared]).all()
    else:
        forms["velocity_ratio"] = sp.Integer(1) if ratio is None else ratio
    for function, expr in forms.items():
        found = [getattr(module(name), function)(p) for p in sample.prepared]
        numerator, denominator = sp.fraction(sp.together(expr))
        size = sample.sizes(numerator)[0] / np.abs(sample.values(denominator)[0])
        assert_agree(function, np.array(found), sample.values(expr)[0], size)


WITHOUT_IMPACTS = ("two_spring_structure", "dirac_delta_block", "controlled_wall_oscillator")
ONE_LAW = ("two_spring_cart", *(name for name in TYPICAL if name.endswith("wall")))
WITH_IMPACTS = [name for name in TYPICAL if name not in WITHOUT_IMPACTS]
JUMPS = [(name, RATIO) for name in WITH_IMPACTS]
JUMPS += [(name, IMPULSIVE) for name in WITH_IMPACTS if name not in ONE_LAW]


def test_jumps_are_compared_wherever_there_are_any():
    for name in TYPICAL:
        assert model(name).has_impacts == ((name, RATIO) in JUMPS)
        assert ((name, IMPULSIVE) in JUMPS) == module(name).HAS_IMPULSIVE


@pytest.mark.parametrize("name", ["flexible_structure", "uplifting_oscillator"])
def test_guards_on_both_feet_are_sums_but_for_what_is_positive(name):
    m = module(name)
    assert m.MODES[m.FULL_CONTACT] == "both"
    rng = np.random.default_rng(17)
    for _ in range(50):
        values = [TYPICAL[name][k] * rng.uniform(0.8, 1.25) for k in m.PARAMETERS]
        p = m.prepare(np.array(values))
        u = rng.uniform(-0.01, 0.01)
        states = np.array([[0.0, u, 0.0, v] for v in rng.uniform(-1.0, 1.0, 3)])
        ground = rng.uniform(-5.0, 5.0, 3)
        whole, sums = np.empty((3, 2)), np.empty((3, 2))
        for y, ax, g, s in zip(states, ground, whole, sums, strict=True):
            m.guards(m.FULL_CONTACT, y, p, ax, 0.0, g)
            m.full_contact_guards(y, p, ax, s)
        # one factor for each guard, whatever the ground and the speed: it is that of a mass
        factor = whole / sums
        assert (factor > 0.0).all()
        assert np.abs(factor / factor[0] - 1.0).max() < 1e-9
        # a sum at the mean of three is the mean of three sums, whatever the positions
        states[:, 1] = rng.uniform(-0.01, 0.01, 3)
        for y, ax, s in zip(states, ground, sums, strict=True):
            m.full_contact_guards(y, p, ax, s)
        mean = np.empty(2)
        m.full_contact_guards(states.mean(axis=0), p, ground.mean(), mean)
        np.testing.assert_allclose(mean, sums.mean(axis=0), rtol=0, atol=1e-12 * abs(sums).max())


def test_structures_whose_guards_on_both_feet_are_such_sums():
    assert {name for name in rk.models() if module(name).FULL_CONTACT >= 0} == {
        "flexible_structure",
        "uplifting_oscillator",
        "wall_with_frame",
    }


@pytest.mark.parametrize(("name", "law"), JUMPS)
def test_jump(name, law):
    """Each impact against the closed form of the impulse map, or the prescribed ratio."""
    m = module(name)
    impacts = [t for t in model(name).transitions if t.kind == "impact"]
    rotation, rate = m.ROTATION, m.ROTATION_RATE
    met = set()
    for t in impacts:
        sample = Sample(name, t.source)
        # from slender to squat, where the old foot cannot lift
        sample.parameters["alpha" if "alpha" in sample.parameters else "half_width"] *= np.linspace(
            1, 4, N
        )
        sample.y[rotation] = 0.0
        sample.y[rate] = -sample.side * np.abs(sample.y[rate])
        size = np.abs(sample.y)
        followed = {}
        if law == IMPULSIVE:
            for target in (t.target, t.fallback):
                followed[target] = sample.y.copy()
                followed[target][[rotation, rate]] = 0.0
                impulse = model(name).impulse_map(t.source, target)
                after = sample.values(*impulse.velocities())
                for c, values in zip(impulse.coordinates, after, strict=True):
                    followed[target][model(name).states.index(f"{c.name}_dot")] = values
                size = size + np.abs(followed[target])
            opens = -sample.side * followed[t.target][rate] > 0
            expected = np.where(opens, followed[t.target], followed[t.fallback])
            targets = np.where(opens, t.target, t.fallback)
        else:
            expected = sample.y.copy()
            expected[rate] *= 0.7
            targets = np.full(N, t.target)
        structures, out = sample.prepared, np.empty_like(sample.y)
        for i in range(N):
            row = np.empty(len(out))
            source = m.MODES.index(t.source)
            y = np.ascontiguousarray(sample.y[:, i])
            follows = m.jump(source, 0, law, 0.7, y, structures[i], row)
            assert m.MODES[follows] == targets[i]
            out[:, i] = row
        met |= set(targets)
        assert_agree(f"impact from {t.source}", out, expected, size)
    # without rotary inertia the momentum left would turn the oscillator into the ground
    never = {"left", "right"} if name == "uplifting_oscillator" else set()
    assert law == RATIO or met == {"left", "right", "both"} - never


def test_sine_and_cosine_are_within_their_error_of_thirty_digits():
    """Small angles by their relative error, too: gaps of feet are made of them."""
    random = np.random.default_rng(11)
    angles = [*random.uniform(-20.0, 20.0, 2000), *random.uniform(-0.8, 0.8, 2000)]
    with mpmath.workdps(30):
        for x in map(float, [*angles, *10.0 ** random.uniform(-300.0, -1.0, 500), 0.0]):
            sine, cosine = rigid_block.sine_cosine(x)
            assert abs(sine - mpmath.sin(x)) <= 2.3e-16 * min(1.0, abs(x))
            assert abs(cosine - mpmath.cos(x)) <= 2.3e-16
