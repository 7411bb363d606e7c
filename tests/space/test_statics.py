"""Statics of bodies on feet and on rims in space: closed forms, and the engine by itself."""

import numpy as np
import pytest

import rockeom as rk
from rockeom.analysis import formulas
from tests.refusals import told
from tests.space.bodies import NAMES, oriented, prism
from tests.space.cases import GRAVITY, Case, of_group

CORNER = NAMES["(+1,+1)"]
EDGE = "east_south_east_north"
STARTS = of_group("start of rocking or sliding")
EIGHTH = np.array([1 / 280, -4 / 105, 1 / 5, -4 / 5, 0, 4 / 5, -1 / 5, 4 / 105, -1 / 280])
"""Weights of a central difference of eighth order."""


def corners(case: Case) -> list[tuple[float, float]]:
    return [(i * case["b"], j * case["c"]) for i in (-1, 1) for j in (-1, 1)]


def leaning(direction: float, tilt: float) -> dict[str, float]:
    """The state at rest that leans without turning about the vertical."""
    c, s = np.cos(direction), np.sin(direction)
    about = np.array([[0, 0, c], [0, 0, s], [-c, -s, 0]])  # the axis normal to the direction
    rotation = np.eye(3) + np.sin(tilt) * about + (1 - np.cos(tilt)) * about @ about
    return oriented(rotation)


@pytest.mark.parametrize("name", ["corner_inertia_A", "corner_inertia_S"])
def test_kinetic_energy_about_a_corner_has_the_inertia_of_the_prism_there(name):
    case = Case(name)
    block, upright = prism(case.given, friction=None), oriented(np.eye(3))
    places = block.positions(upright)
    arm = places["prism"] - places[CORNER]

    def twice_energy(turning: np.ndarray) -> float:
        rates = dict(zip(("roll_dot", "pitch_dot", "yaw_dot"), turning, strict=True))
        moves = zip(("x_dot", "y_dot", "z_dot"), np.cross(turning, arm), strict=True)
        state = upright | rates | dict(moves)
        return 2.0 * block.energies(state, mode=CORNER)["kinetic_energy"]

    own = [twice_energy(axis) for axis in np.eye(3)]
    inertia = np.diag(own)
    for i, j in ((0, 1), (0, 2), (1, 2)):
        both = twice_energy(np.eye(3)[i] + np.eye(3)[j])
        inertia[i, j] = inertia[j, i] = (both - own[i] - own[j]) / 2
    case.agrees(
        principal_moments_about_corner=np.linalg.eigvalsh(inertia),
        trace=inertia.trace(),
        hinge_b=2 * energy_about_edge(block, places, 1),
        hinge_c=2 * energy_about_edge(block, places, 0),
    )


def energy_about_edge(block, places, axis: int) -> float:
    """Kinetic energy of a turn at unit rate about the edge along x (0) or y (1)."""
    turning = np.eye(3)[axis]
    arm = places["prism"] - places[CORNER]
    arm[axis] = 0.0
    moves = dict(zip(("x_dot", "y_dot", "z_dot"), np.cross(turning, arm), strict=True))
    rate = {("roll_dot", "pitch_dot")[axis]: 1.0}
    return block.energies(rate | moves, mode=CORNER)["kinetic_energy"]


def test_the_stability_surface_is_where_the_energy_is_highest():
    case = Case("stability_surface_90")
    direction = np.radians(case["direction_of_tilt_deg"])
    tilt = formulas.overturning_tilt(direction, corners(case), case["h"])
    barrier = formulas.overturning_barrier(direction, corners(case), case["h"], case["m"], GRAVITY)
    case.agrees(overturning_tilt=tilt, energy_barrier=barrier)
    block = prism(case.given, friction=None)
    there = leaning(direction, tilt)
    case.agrees(centroid_height=block.positions(there)["prism"][2])
    lower = [leaning(direction, tilt + step) for step in (-1e-3, 0.0, 1e-3)]
    heights = [block.energies(state)["gravitational_energy"] for state in lower]
    assert heights[1] > max(heights[0], heights[2])


def test_a_prism_balances_on_a_corner_and_on_its_edges():
    case = Case("balance_on_corner_A")
    direction, tilt = case.right("direction"), case.right("tilt")
    barriers = formulas.overturning_barrier(
        [direction, 0.0, np.pi / 2], corners(case), case["h"], case["m"], GRAVITY
    )
    names = ("energy_barrier", "energy_barrier_edge_b", "energy_barrier_edge_c")
    case.agrees(
        direction=np.arctan2(case["c"], case["b"]),
        tilt=formulas.overturning_tilt(direction, corners(case), case["h"]),
        cos_tilt=np.cos(tilt),
        **dict(zip(names, barriers, strict=True)),
    )
    block = prism(case.given, friction=None)
    flat = block.energies({})["gravitational_energy"]
    ways = {CORNER: (direction, tilt), EDGE: (0.0, np.arctan2(case["b"], case["h"]))}
    for (mode, where), barrier in zip(ways.items(), barriers[:2], strict=True):
        state = leaning(*where)
        moves = block.accelerations(state, mode=mode)
        assert max(abs(moves[angle]) for angle in ("yaw", "pitch", "roll")) < 1e-13 * GRAVITY
        risen = block.energies(state)["gravitational_energy"] - flat
        assert risen == pytest.approx(barrier, rel=case.tolerance)


def growth_rates(block, mode: str, state: dict[str, float], angles: list[str]) -> np.ndarray:
    """Rates at which small motions about a balance grow: of the accelerations by the angles."""
    steps = np.arange(-4, 5) * 0.01
    slopes = np.zeros((len(angles), len(angles)))
    for j, moved in enumerate(angles):
        for weight, step in zip(EIGHTH, steps, strict=True):
            there = {name: state[name] for name in ("yaw", "pitch", "roll")}
            there[moved] += step
            moves = block.accelerations(there, mode=mode) if weight else dict.fromkeys(angles, 0.0)
            slopes[:, j] += weight / 0.01 * np.array([moves[name] for name in angles])
    squares = np.linalg.eigvals(slopes)
    return np.sqrt(np.sort(squares.real.clip(0.0)))


@pytest.mark.parametrize(
    "name", ["growth_rates_balanced_corner_A", "growth_rates_balanced_corner_S"]
)
def test_a_balance_on_a_corner_is_left_at_two_rates(name):
    case = Case(name)
    block = prism(case.given, friction=None)
    direction = np.arctan2(case["c"], case["b"])
    state = leaning(direction, formulas.overturning_tilt(direction, corners(case), case["h"]))
    none, *rates = growth_rates(block, CORNER, state, ["yaw", "pitch", "roll"])
    assert none < 1e-5
    np.testing.assert_allclose(rates, case.right("growth_rates"), rtol=1e-10)


def test_a_balance_on_an_edge_is_left_at_the_rate_of_the_block():
    case = Case("growth_rate_balanced_edge_b")
    state = leaning(0.0, np.arctan2(case["b"], case["h"]))
    (rate,) = growth_rates(prism(case.given, friction=None), EDGE, state, ["pitch"])
    assert rate == pytest.approx(case.right("p"), rel=1e-11)


@pytest.mark.parametrize("name", STARTS)
def test_a_prism_starts_to_rock_about_the_edge_and_at_the_acceleration_of_its_closed_form(name):
    case = Case(name)
    block, way = prism(case.given, friction=None), np.radians(case["direction_deg"])
    threshold = formulas.rocking_threshold(way, corners(case), case["h"], gravity=GRAVITY)
    case.agrees(rocking_acceleration=threshold, mu_critical=threshold / GRAVITY)
    turns = "pitch" if "x" in case.expected["about"] else "roll"
    for factor in (1.0 - 1e-9, 1.0 + 1e-9, 1.5):
        size = factor * threshold
        along, across = size * np.cos(way), size * np.sin(way)
        moves = block.accelerations({}, along, transverse_ground_acceleration=across)
        begins = {angle for angle in ("pitch", "roll") if abs(moves[angle]) > 1e-12 * GRAVITY}
        assert begins == ({turns} if factor > 1.0 else set())


def test_a_falling_ground_lets_a_body_rock_earlier():
    case = Case("start_low_45")
    block, up = prism(case.given, friction=None), -4.0
    threshold = formulas.rocking_threshold(0.0, corners(case), case["h"], up, GRAVITY)
    assert threshold == pytest.approx((GRAVITY + up) * case["b"] / case["h"])
    for factor, rocks in ((1.0 - 1e-9, False), (1.0 + 1e-9, True)):
        moves = block.accelerations({}, factor * threshold, up)
        assert (abs(moves["pitch"]) > 0.0) == rocks
    assert formulas.rocking_threshold(0.0, corners(case), case["h"], -10.0, GRAVITY) == 0.0


def test_a_statue_on_three_legs_overturns_least_between_two_of_them():
    feet = {"front": (0.0, 0.3), "left": (-0.3, -0.2), "right": (0.3, -0.2)}
    places = np.array(list(feet.values()))
    statue = rk.LeggedStatue(
        feet=feet, centroid=(0.0, 0.0, 0.9), mass=200.0, inertia=np.diag([60.0, 55.0, 20.0]),
        gravity=GRAVITY,
    )  # fmt: skip
    ways = np.radians(np.arange(0.0, 360.0, 0.05))
    tilts = formulas.overturning_tilt(ways, places, 0.9)
    assert tilts.min() == pytest.approx(np.arctan2(0.09 / np.hypot(0.5, 0.3), 0.9), rel=1e-3)
    back = np.pi / 2  # pushed along y it leans to -y, onto the edge of both hind legs
    threshold = formulas.rocking_threshold(back, places, 0.9, gravity=GRAVITY)
    assert threshold == pytest.approx(GRAVITY * 0.2 / 0.9)
    for factor, rocks in ((1.0 - 1e-9, False), (1.0 + 1e-9, True)):
        moves = statue.accelerations({}, transverse_ground_acceleration=factor * threshold)
        assert (abs(moves["roll"]) > 0.0) == rocks


@pytest.mark.parametrize("seed", range(6))
def test_a_statue_on_any_five_feet_rocks_as_soon_as_the_resultant_leaves_the_base(seed):
    rng = np.random.default_rng(seed)
    ways = np.arange(5) * 1.2566 + rng.uniform(-0.5, 0.5, 5)
    places = rng.uniform(0.2, 0.4, (5, 1)) * np.array([np.cos(ways), np.sin(ways)]).T
    statue = rk.LeggedStatue(
        feet={f"leg{i}": tuple(place) for i, place in enumerate(places.tolist())},
        centroid=(0.0, 0.0, 0.8), mass=100.0, inertia=np.diag([30.0, 28.0, 10.0]), gravity=GRAVITY,
    )  # fmt: skip
    for way in rng.uniform(-np.pi, np.pi, 3):
        threshold = formulas.rocking_threshold(way, places, 0.8, gravity=GRAVITY)
        for factor, rocks in ((1.0 - 1e-8, False), (1.0 + 1e-8, True)):
            along, across = factor * threshold * np.array([np.cos(way), np.sin(way)])
            moves = statue.accelerations({}, along, transverse_ground_acceleration=across)
            assert (max(abs(moves[angle]) for angle in ("pitch", "roll")) > 1e-12) == rocks


def test_closed_forms_of_round_bases_are_those_of_the_cases():
    for name in of_group("steady wobbling"):
        case = Case(name)
        if name == "euler_disc_0.05":
            rate = formulas.euler_disc_precession(case["tilt"], case["b"], GRAVITY)
        else:
            m, b, h = case["m"], case["b"], case["H"]
            across, along = m * (b**2 / 4 + h**2 / 3), m * b**2 / 2
            rate = formulas.steady_precession(case["tilt"], m, b, h, across, along, GRAVITY)
        case.agrees(precession_rate=rate)
    case = Case("planar_limit_cylinder")
    m, b, h = case["m"], case["b"], case["H"]
    sizes = (m, b, h, m * (b**2 / 4 + h**2 / 3))
    turns = [formulas.turn_of_contact(*sizes, rolls=rolls) for rolls in (True, False)]
    case.agrees(
        turn_of_contact_rolling=turns[0], turn_of_contact_rolling_deg=np.degrees(turns[0]),
        turn_of_contact_smooth_deg=np.degrees(turns[1]),
    )  # fmt: skip
    column = rk.WobblingColumn(radius=b, height=2 * h, mass=m, gravity=GRAVITY)
    hinge = 2 * column.energies({"tilt": 0.1, "tilt_dot": 1.0})["kinetic_energy"]
    case.agrees(
        I0=hinge, alpha=column.alpha, ratio_rim_to_opposite_rim=column.velocity_ratio,
        p=np.sqrt(m * GRAVITY * np.hypot(b, h) / hinge),
    )  # fmt: skip


@pytest.mark.parametrize(
    ("name", "arguments", "words"),
    [
        ("base_reach", (0.0, [(0, 0), (1, 1), (2, 2)]), "on one line"),
        ("base_reach", (0.0, [(1, 0), (2, 0), (1, 1)]), "have the centroid, their origin, beyond"),
        ("base_reach", (0.0, [(1, 0), (2, 0)]), "three or more feet"),
        ("overturning_tilt", (0.0, [(-1, -1), (1, -1), (0, 1)], 0.0), "give a positive number"),
        ("steady_precession", (2.0, 1, 1, 1, 1, 1), "between 0 and pi/2"),
        ("steady_precession", (0.1, 1, 1, -1, 1, 1), "height above the base"),
        ("turn_of_contact", (1, 0, 1, 1), "give a positive number"),
    ],
)
def test_arguments_out_of_range_are_refused(name, arguments, words):
    assert words in told(getattr(formulas, name), *arguments)
