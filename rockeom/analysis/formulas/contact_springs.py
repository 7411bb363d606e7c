"""Contact springs of a rocking block: the energy a landing loses, and springs for a given loss.

A finite-element model rocks on a spring and a damper under each foot that act while the foot is
down. No stiffness and no damping of them is a restitution: the loss follows from the landing. The
foot that lands pushes the old foot up; from there on only the new foot acts, and whatever it does,
the angular momentum about it stays, but for the weight. Stiff springs therefore lose what Housner's
impact loses, whatever their dampers are. They lose less where the old foot still pushes as it
leaves, and more where its damper holds it down.

The landing is solved for small rotations, base centre guided vertically. In the time 1/Omega, with
Omega = sqrt(2 k/m), and the length b omega/Omega, omega the angular velocity before the landing,
heave and rotation are two oscillators until the old foot is free:

    u'' + 2 zeta u' + u = 0,    phi'' + 2 zeta mu phi' + mu phi = 0,    u'(0) = phi'(0) = -1

u counts from the settled position, phi is b times the rotation left to upright. Three numbers
remain: mu = m b**2/(I + m h**2), Housner's ratio of angular velocities being (1 - mu)/(1 + mu),
zeta = c/(m Omega), and the number of the landing N = b omega Omega/g. For small rotations N**2 is
(1 - Housner's ratio) times the peak rotation over the rotation at uplift.
"""

from dataclasses import dataclass
from typing import NamedTuple, Self

import numpy as np
from numpy.typing import ArrayLike

from rockeom.motion.units import STANDARD_GRAVITY
from rockeom.numbers.checks import not_negative, positive, require


@dataclass(frozen=True)
class ContactSprings:
    """Spring and damper of each foot of a block, and the losses to expect of them.

    Parameters
    ----------
    stiffness : float
        Stiffness of the spring of each foot [N/m].
    damping : float
        Coefficient of the damper of each foot [N s/m].
    time_step : float
        Time step for Newmark's method, a tenth of the shortest time constant of the contacts [s]; r
        measured in OpenSees with it differed by up to 0.006.
    damping_ratio : float
        Damping ratio of the heave with both feet down.
    uplift_rotation : float
        Rotation at which a foot lifts [rad]; below it the block does not rock.
    energy_ratio : float
        Energy ratio r of the landing after the requested peak rotation.
    energy_ratio_at_half_peak : float
        Energy ratio r after a peak half as large, with the same springs.
    rigid_energy_ratio : float
        Energy ratio r of Housner's impact, the limit of stiff springs.
    """

    stiffness: float
    damping: float
    time_step: float
    damping_ratio: float
    uplift_rotation: float
    energy_ratio: float
    energy_ratio_at_half_peak: float
    rigid_energy_ratio: float


def energy_ratio_on_contact_springs(
    stiffness: ArrayLike,
    damping: ArrayLike,
    *,
    half_width: ArrayLike,
    half_height: ArrayLike,
    mass: ArrayLike,
    peak_rotation: ArrayLike,
    pulls: bool = True,
    inertia: ArrayLike | None = None,
    gravity: ArrayLike = STANDARD_GRAVITY,
):
    """Energy ratio r of the first landing of a block on contact springs.

    Parameters
    ----------
    stiffness : array_like
        Stiffness of the spring of each foot [N/m].
    damping : array_like
        Coefficient of the damper of each foot [N s/m].
    half_width : array_like
        Half of the width of the block [m].
    half_height : array_like
        Height of the centroid above the base [m].
    mass : array_like
        Mass of the block [kg].
    peak_rotation : array_like
        Rotation from which the block falls, its spring settled [rad].
    pulls : bool, optional
        Whether a damper acts as long as its foot is below the ground, so that it holds the foot
        down as that leaves: ``ViscoelasticGap`` of OpenSees. With False the contact never pulls, as
        in `TwoSprings` and `TwoSpringStructure`.
    inertia : array_like, optional
        Moment of inertia about the centroid [kg m2]; that of a homogeneous rectangle if not given.
    gravity : array_like, optional
        Acceleration of gravity [m/s2].

    Returns
    -------
    float or ndarray
        Ratio of the energies at the two peaks, as `energy_ratios_from_peaks` has it of the
        rotations, in the shape of all arguments, broadcast. NaN where the old foot does not leave
        the ground, since the springs are too soft or the dampers hold it.

    Raises
    ------
    ValueError
        For numbers that are not positive, a peak beyond the balance, and a block so squat that it
        does not roll from foot to foot.

    Notes
    -----
    The vibration of the foot that landed must have died out by the next landing. Against
    integration at large rotations, damping ratios of 0.1 to 3, the error is below 0.008 where N > 1
    and 0.002 where N > 4 (N as in the docstring of the module) for a `half_height` of 4
    `half_width`, 0.0003 for 10, and up to 0.07 and 0.04 for 2.

    Examples
    --------
    >>> from rockeom.analysis.formulas import energy_ratio_on_contact_springs
    >>> block = {"half_width": 0.1, "half_height": 0.4, "mass": 1.0, "peak_rotation": 0.07}
    >>> stiffness, damping = [1e4, 1e6, 1e8], [100.0, 1e3, 1e4]
    >>> energy_ratio_on_contact_springs(stiffness, damping, **block).round(3)
    array([0.702, 0.815, 0.829])
    """
    where = "energy_ratio_on_contact_springs"
    block = _Block.checked(where, half_width, half_height, mass, inertia, gravity)
    (stiffness,) = positive(where, stiffness=stiffness)
    (damping,) = not_negative(where, damping=damping)
    return _energy_ratio(block, stiffness, damping, block.peak(where, peak_rotation), pulls)[()]


def contact_springs_for_energy_ratio(
    energy_ratio: float,
    *,
    half_width: float,
    half_height: float,
    mass: float,
    peak_rotation: float,
    uplift_rotation: float | None = None,
    pulls: bool = True,
    inertia: float | None = None,
    gravity: float = STANDARD_GRAVITY,
) -> ContactSprings:
    """Stiffness, damping and time step with which a landing has a chosen energy ratio r.

    Parameters
    ----------
    energy_ratio : float
        Wanted energy ratio r of the landing after `peak_rotation`.
    half_width : float
        Half of the width of the block [m].
    half_height : float
        Height of the centroid above the base [m].
    mass : float
        Mass of the block [kg].
    peak_rotation : float
        Rotation from which the block falls, its spring settled [rad].
    uplift_rotation : float, optional
        Rotation W/(2 k b) at which a foot lifts, by which the stiffness is chosen [rad]; a
        hundredth of the peak rotation if not given. The smaller it is, the more rigid is the
        ground, the shorter the time step, and the narrower the range of r about Housner's.
    pulls : bool, optional
        Whether a damper may hold its foot down, as in `energy_ratio_on_contact_springs`.
    inertia : float, optional
        Moment of inertia about the centroid [kg m2]; that of a homogeneous rectangle if not given.
    gravity : float, optional
        Acceleration of gravity [m/s2].

    Returns
    -------
    ContactSprings
        Springs, dampers and time step, with the energy ratios to expect.

    Raises
    ------
    ValueError
        For an energy ratio out of reach, with the range that is reached, and for the arguments that
        `energy_ratio_on_contact_springs` refuses.

    See Also
    --------
    energy_ratio_on_contact_springs : The inverse.

    Notes
    -----
    r depends on the speed of the landing, so that other peaks have other ratios:
    `ContactSprings.energy_ratio_at_half_peak` says how much that is.

    Examples
    --------
    >>> from rockeom.analysis.formulas import contact_springs_for_energy_ratio
    >>> springs = contact_springs_for_energy_ratio(
    ...     0.80, half_width=0.1, half_height=0.4, mass=1.0, peak_rotation=0.07
    ... )
    >>> f"{springs.stiffness:.0f} N/m, {springs.damping:.1f} N s/m, {springs.time_step:.1e} s"
    '70071 N/m, 197.9 N s/m, 2.7e-04 s'
    """
    where = "contact_springs_for_energy_ratio"
    block = _Block.checked(where, half_width, half_height, mass, inertia, gravity)
    peak = block.peak(where, peak_rotation)
    (wanted,) = positive(where, energy_ratio=energy_ratio)
    rotation = peak / 100 if uplift_rotation is None else uplift_rotation
    (uplift,) = positive(where, uplift_rotation=rotation)
    require(uplift < peak, where, "uplift_rotation", uplift, f"it must be below the peak, {peak}")
    stiffness = block.mass * block.gravity / (2 * block.half_width * uplift)
    frequency = np.sqrt(2 * stiffness / block.mass)

    def ratio(zeta, of=peak):
        return _energy_ratio(block, stiffness, zeta * block.mass * frequency, of, pulls)

    zeta = _damping_ratio(where, float(wanted), ratio, float(uplift))
    fastest = zeta + np.sqrt(zeta**2 - 1) if zeta > 1 else 1.0
    return ContactSprings(
        stiffness=float(stiffness),
        damping=float(zeta * block.mass * frequency),
        time_step=float(0.1 / (frequency * fastest)),
        damping_ratio=zeta,
        uplift_rotation=float(uplift),
        energy_ratio=float(ratio(zeta)),
        energy_ratio_at_half_peak=float(ratio(zeta, peak / 2)),
        rigid_energy_ratio=float(((1 - block.mass_ratio) / (1 + block.mass_ratio)) ** 2),
    )


_DAMPING_RATIOS = np.geomspace(0.05, 10.0, 60)
"""Below, the foot still vibrates at the next landing; above, the time step is too short to use."""


def _damping_ratio(where: str, wanted: float, ratio, uplift: float) -> float:
    """The least damping ratio with which a landing has the energy ratio wanted."""
    reached = ratio(_DAMPING_RATIOS)
    finite = reached[np.isfinite(reached)]
    rule = "springs so soft that the old foot does not lift in a landing: give a smaller one"
    require(len(finite) > 0, where, "uplift_rotation", uplift, rule)
    rule = (
        f"damping ratios of 0.05 to 10 reach {finite.min():.4f} to {finite.max():.4f} with springs "
        f"that let a foot lift at {uplift:.3g} rad; a larger uplift_rotation, that is softer "
        "springs, reaches further, and below Housner's ratio dampers with pulls=True"
    )
    require(
        (wanted >= finite.min()) & (wanted <= finite.max()), where, "energy_ratio", wanted, rule
    )
    return _first_passage(lambda zeta: ratio(zeta) - wanted, _DAMPING_RATIOS)


class _Block(NamedTuple):
    """A rectangle and its numbers; all broadcast."""

    half_width: np.ndarray
    half_height: np.ndarray
    mass: np.ndarray
    inertia: np.ndarray
    gravity: np.ndarray

    @classmethod
    def checked(cls, where, half_width, half_height, mass, inertia, gravity) -> Self:
        b, h, mass, gravity = positive(
            where, half_width=half_width, half_height=half_height, mass=mass, gravity=gravity
        )
        if inertia is None:
            inertia = mass * (b**2 + h**2) / 3
        (inertia,) = not_negative(where, inertia=inertia)
        block = cls(b, h, mass, inertia, gravity)
        rule = "so squat that it does not roll from foot to foot: make it more slender"
        require(block.mass_ratio < 1, where, "half_width", b, rule)
        return block

    @property
    def mass_ratio(self) -> np.ndarray:
        """mu: inertia of the heave over that of the rotation, in the motion of a foot."""
        upright = self.inertia + self.mass * self.half_height**2
        return self.mass * self.half_width**2 / upright

    def peak(self, where: str, rotation: ArrayLike) -> np.ndarray:
        (peak,) = positive(where, peak_rotation=rotation)
        rule = "the block balances at alpha = atan(half_width/half_height): give less, in radians"
        balance = np.arctan2(self.half_width, self.half_height)
        require(peak < balance, where, "peak_rotation", peak, rule)
        return peak

    def fall(self, rotation: np.ndarray) -> np.ndarray:
        """Height of the centroid of the rotated block above that of the upright one."""
        sine, half = np.sin(rotation), np.sin(rotation / 2)
        return self.half_width * sine - 2 * self.half_height * half**2


def _energy_ratio(block: _Block, stiffness, damping, peak, pulls: bool) -> np.ndarray:
    """r of the landing after a peak: its numbers, and the landing."""
    b, mu, g = block.half_width, block.mass_ratio, block.gravity
    settled = block.mass * g / (2 * stiffness)  # on both feet
    fallen = block.fall(peak) - settled / (1 + mu)  # when the new foot touches
    inertia = block.inertia / block.mass + b**2 + block.half_height**2  # about a foot
    speed = np.sqrt(2 * g * np.maximum(fallen, 0.0) / inertia)
    frequency = np.sqrt(2 * stiffness / block.mass)
    return _landings(
        b * speed * frequency / g,
        damping / (block.mass * frequency),
        mu,
        block.half_height * speed**2 / g,
        pulls,
    )


def _landing(number: float, zeta: float, mu: float, centripetal: float, pulls: bool) -> float:
    """r of a landing in the units of the module; nan where the old foot stays down.

    centripetal : h omega**2/g, by which the centripetal acceleration relieves the old foot.
    """
    if not number > 0:
        return np.nan
    weight = 1 / number  # as an acceleration, and so the settlement on both feet
    old, new = weight * (1 / (1 + mu) - centripetal), weight / (1 + mu)  # half those on one foot

    def motion(t):
        u, u_dot = _oscillation(1.0, zeta, weight - old, -1.0, t)
        return u, u_dot, *_oscillation(mu, zeta * mu, old, -1.0, t)

    def pressed(t):
        """Compression of the old foot, with its damper if that is all that can keep it."""
        u, u_dot, phi, phi_dot = motion(t)
        return weight + phi - u + (0.0 if pulls else 2 * zeta * (phi_dot - u_dot))

    times = np.geomspace(1e-12, 100 * (1 + zeta), 4000)
    u, u_dot, phi, phi_dot = motion(_first_passage(pressed, times))
    # the rotation about the settled new foot that has the same angular momentum about it
    rotation = (mu * (u - weight) + 2 * mu * new - phi) / (1 + mu)
    rate = (mu * u_dot - phi_dot) / (1 + mu)
    double = (1 + mu) / mu
    return (double * rate**2 / 2 + weight * rotation) / (double / 2 + weight * old)


def _first_passage(function, grid: np.ndarray) -> float:
    """Where a function of an array first changes its sign along a grid; nan where it does not."""
    passage = np.nan
    for _ in range(12):  # each time in the interval that has it, an eleventh of the one before
        values = function(grid)
        passed = np.flatnonzero(values[:-1] * values[1:] <= 0)
        if not len(passed):
            break
        passage = grid[passed[0]]
        grid = np.linspace(passage, grid[passed[0] + 1], 12)
    return float(passage)


_landings = np.vectorize(_landing, otypes=[float])


def _oscillation(square: float, decay: float, x: float, v: float, t):
    """(x, v) at t of x'' + 2 decay x' + square x = 0."""
    difference = decay**2 - square
    # critical damping as its neighbour, between truncation and cancellation
    root = np.emath.sqrt(difference if abs(difference) > 1e-10 else 1e-10)
    up, down = root - decay, -root - decay
    growing = (v - down * x) / (2 * root)
    falling = x - growing
    one, other = growing * np.exp(up * t), falling * np.exp(down * t)
    return np.real(one + other), np.real(up * one + down * other)
