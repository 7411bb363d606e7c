"""Six impacts of bodies on feet that rub, in 40 digits: Newton, Euler, Coulomb and Moreau.

Nothing of the package is used. Impulses P at the feet change their velocities u by D P, D = J M^-1
J'. By Moreau's law u* = u after + e u before and P suit one another: of a foot that "opens" P is
zero and u* not negative; of one that "sticks" u* is zero and P lies in the cone of friction; one
that "slips" has the friction mu P_N against the direction of u*, an angle from x, which Newton's
method finds. What each foot does, and about which angle, is given; that it is an outcome is
checked. By trials of all patterns it is the only one
of each of IMPACTS.
"""

from collections.abc import Sequence
from typing import Any, NamedTuple

import mpmath
from mpmath import mp

mp.dps = 50
NONE = mp.mpf(10) ** -40
SIDES = ("yaw", "pitch", "roll")


class Impact(NamedTuple):
    """A body on its feet before an impact; floats, which are exact.

    principal : moments of inertia [kg m2] along axes of the body, and arms of the feet that touch
    [m], from the centroid. feet : of each of these what it does, as above; angles [rad] : near the
    directions of those that slip.
    """

    mass: float
    principal: tuple[float, float, float]
    arms: Sequence[tuple[float, float, float]]
    state: dict[str, float]
    friction: float
    restitution: float
    feet: tuple[str, ...]
    angles: tuple[float, ...] = ()


def velocities_after(impact: Impact) -> tuple[list[Any], Any]:
    """Velocity of the centroid and spin (6,) after an impact, and the ratio of kinetic energies."""
    matrix, rows, before = _body(impact)
    effect = mpmath.inverse(matrix) * rows.T
    coupling, arriving = rows * effect, rows * before
    e, mu, held = mp.mpf(impact.restitution), mp.mpf(impact.friction), _held(impact.feet)
    slips = [i for i, foot in enumerate(impact.feet) if foot == "slips"]

    def impulses(angles: Sequence[Any]) -> Any:
        along = mpmath.zeros(len(arriving), len(held))
        for column, row in enumerate(held):
            along[row, column] = 1
            if row % 3 == 2 and row // 3 in slips:
                angle = angles[slips.index(row // 3)]
                along[row - 2, column] = -mu * mp.cos(angle)
                along[row - 1, column] = -mu * mp.sin(angle)
        a = coupling * along
        a = mpmath.matrix([[a[r, c] for c in range(len(held))] for r in held])
        return along * mpmath.lu_solve(a, mpmath.matrix([-(1 + e) * arriving[r] for r in held]))

    def star(p: Any) -> Any:
        return (1 + e) * arriving + coupling * p

    def across(*angles: Any) -> list[Any]:
        u = star(impulses(angles))
        pairs = zip(slips, angles, strict=True)
        return [u[3 * i + 1] * mp.cos(x) - u[3 * i] * mp.sin(x) for i, x in pairs]

    angles = list(mpmath.findroot(across, impact.angles, tol=NONE**2)) if slips else []
    p = impulses(angles)
    _check(impact, p, star(p))
    after = before + effect * p
    energies = [(q.T * matrix * q)[0] for q in (before, after)]
    # energy taken: by friction and by the part 1 - e of the impulses, neither of which is negative
    taken = (1 - e) / 2 * (p.T * coupling * p)[0] - (p.T * star(p))[0]
    assert abs(energies[0] - energies[1] - 2 * taken / (1 + e)) < NONE * energies[0]
    return [*after], energies[1] / energies[0]


def _body(impact: Impact) -> tuple[Any, Any, Any]:
    """M (6, 6), rows J (3 m, 6) of feet, and velocities (6,) before."""
    state = {name: mp.mpf(value) for name, value in impact.state.items()}
    yaw, pitch, roll = (_turn(k, state.get(n, 0)) for k, n in zip((2, 1, 0), SIDES, strict=True))
    axes, unit = yaw * pitch * roll, mpmath.eye(3)
    about = (unit[:, 2], yaw * unit[:, 1], yaw * pitch * unit[:, 0])
    spin = mpmath.zeros(3, 1)
    for axis, name in zip(about, SIDES, strict=True):
        spin += axis * state.get(f"{name}_dot", 0)
    before = mpmath.matrix([*(state.get(f"{n}_dot", 0) for n in "xyz"), *spin])
    matrix, rows = mpmath.zeros(6), mpmath.zeros(3 * len(impact.arms), 6)
    matrix[:3, :3] = impact.mass * unit
    matrix[3:, 3:] = axes * mpmath.diag(impact.principal) * axes.T
    for i, arm in enumerate(impact.arms):
        x, y, z = axes * mpmath.matrix(arm)
        rows[3 * i : 3 * i + 3, :3] = unit
        rows[3 * i : 3 * i + 3, 3:] = mpmath.matrix([[0, z, -y], [-z, 0, x], [y, -x, 0]])
    return matrix, rows, before


def _turn(axis: int, angle: Any) -> Any:
    """Rotation about an axis, by the right-hand rule."""
    i, j, turn = (axis + 1) % 3, (axis + 2) % 3, mpmath.eye(3)
    turn[i, i], turn[j, j] = mp.cos(angle), mp.cos(angle)
    turn[j, i], turn[i, j] = mp.sin(angle), -mp.sin(angle)
    return turn


def _held(feet: Sequence[str]) -> list[int]:
    """Rows in which u* vanishes: of gaps, and along the ground where a foot sticks."""
    rows = {"opens": (), "slips": (2,), "sticks": (0, 1, 2)}
    return [3 * i + k for i, foot in enumerate(feet) for k in rows[foot]]


def _check(impact: Impact, p: Any, star: Any) -> None:
    """Assert that impulses suit the velocities u* that follow, as Signorini and Coulomb have it."""
    for i, foot in enumerate(impact.feet):
        along, presses = mp.hypot(p[3 * i], p[3 * i + 1]), p[3 * i + 2]
        assert presses > 0 if foot != "opens" else star[3 * i + 2] > 0
        assert along < impact.friction * presses or foot != "sticks"
        work = p[3 * i] * star[3 * i] + p[3 * i + 1] * star[3 * i + 1]
        speed = mp.hypot(star[3 * i], star[3 * i + 1])
        assert foot != "slips" or abs(work + impact.friction * presses * speed) < NONE


_EAST = ((0.25, -0.35, -1.5), (0.25, 0.35, -1.5))
_PRISM = (2000.0, (1600.0, 1550.0, 125.0), _EAST)
_LEGS = ((0.02, 0.26, -0.6), (-0.24, -0.13, -0.6), (0.22, -0.11, -0.6))
_TRIPOD = (300.0, (50.0, 45.0, 12.0), _LEGS)


def _state(*values: float) -> dict[str, float]:
    names = ("yaw", "pitch", "x_dot", "y_dot", "z_dot", "yaw_dot", "pitch_dot", "roll_dot")
    return dict(zip(names, values, strict=True))


IMPACTS = {
    "a tripod on two feet, one of which slips": Impact(
        *_TRIPOD, _state(0.07, 0.0, -0.14, -0.31, -0.31, 0.65, -0.01, -0.83), 1.29, 0.0,
        ("slips", "sticks", "opens"), (5.765,),
    ),
    "a tripod on two feet that slip": Impact(
        *_TRIPOD, _state(0.04, 0.0, 1.54, 0.29, -0.21, -0.15, 0.04, 0.24), 0.11, 0.0,
        ("opens", "slips", "slips"), (0.252, 0.185),
    ),
    "a prism on an edge that turns about a corner": Impact(
        *_PRISM, _state(-0.3, 0.1, -0.26, -0.59, -0.78, -0.64, -0.34, -0.94), 1.04, 0.0,
        ("sticks", "slips"), (2.842,),
    ),
    "a tripod that bounces from two feet, one of which sticks": Impact(
        *_TRIPOD, _state(-0.26, 0.0, -0.02, 0.24, -0.71, 0.83, 0.15, -0.37), 0.54, 0.5,
        ("sticks", "slips", "opens"), (5.435,),
    ),
    "a tripod that bounces and slips on three feet": Impact(
        *_TRIPOD, _state(-0.39, 0.0, -0.4, 0.11, -0.32, -0.09, 0.36, -0.12), 0.44, 0.8,
        ("slips", "slips", "slips"), (2.938, 2.725, 3.018),
    ),
    "a prism that bounces and slips on an edge": Impact(
        *_PRISM, _state(0.51, 0.1, -0.74, -0.41, -0.42, -0.66, -0.07, 0.07), 0.42, 0.3,
        ("slips", "slips"), (3.664, 3.878),
    ),
}  # fmt: skip
"""By what happens; three without restitution come first."""

_OF_THREE = Impact(
    *_TRIPOD, _state(-0.12, 0.0, 0.07, -1.2, -0.29, -0.16, -0.36, 0.22), 1.4, 0.5,
    ("opens", "opens", "sticks"),
)  # fmt: skip
OF_THREE = (_OF_THREE, _OF_THREE._replace(feet=("opens", "slips", "sticks"), angles=(4.636,)))
"""Two of three outcomes of one impact; in the third both last feet stick."""
