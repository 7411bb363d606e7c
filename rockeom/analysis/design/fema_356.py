"""FEMA 356's procedure for rocking (thesis 2.7), and its comparison with integration.

    import rockeom as rk
    from rockeom.analysis import design

    block = rk.RigidBlock(half_width=0.095, half_height=0.4549, mass=334.44)
    record = rk.GroundMotion.from_library("El Centro 1940 180").scaled_to(peak=2.5)
    estimate = design.fema_356_rocking(block, record)
    estimate.outcome, estimate.rotation / block.alpha

The steps, by the thesis after Makris and Konstantinidis (2003):

1. The element rocks about the middle of a stress block at its edge, whose length is m g/q_c.
2. It rocks if S_a > g tan(alpha), S_a being that of the period at which it does not rock.
3. The spectrum is that for the damping of 2-15, 0.4 (1 - sqrt(r)), r by 2-6.
4. A rotation gives a period by 2-5, the period a displacement of the spectrum, the displacement the
   next rotation, until it stays.

The text does not state how a displacement delta becomes a rotation: it refers to 2-16, which is a
damping. Here delta is the displacement of the centroid and theta = delta/R, as for rotations that
are small compared with alpha's complement; another arm may be given.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from rockeom.analysis.design.displacement_based import modified_spectrum
from rockeom.analysis.dynamics.spectra import Spectrum, response_spectrum
from rockeom.analysis.formulas.damping import fema_356_damping, priestley_damping
from rockeom.analysis.formulas.periods import rocking_period
from rockeom.analysis.formulas.restitution import energy_ratio_of_block
from rockeom.analysis.sweeps import ANSWERS, STANDS, unanswered
from rockeom.motion import DesignSpectrum, GroundMotion
from rockeom.numbers.checks import InputError, not_negative, positive, require
from rockeom.simulation.case import Case
from rockeom.structures.classes import RigidBlock
from rockeom.structures.impact_laws import ImpactLaw
from rockeom.sweeps.options import SweepOptions
from rockeom.sweeps.run import simulate_many

NO_ROCKING = "no rocking"
CONVERGED = "converged"
OVERTURNED = "overturned"
NOT_CONVERGED = "not converged"

_DAMPINGS = {"2-15": fema_356_damping, "2-16": priestley_damping}


@dataclass(frozen=True, eq=False)
class FemaEstimate:
    """Result of the FEMA 356 procedure.

    Parameters
    ----------
    outcome : str
        "no rocking" (S_a is not above g tan(alpha)), "converged", "overturned" (a rotation reached
        alpha, where 2-5 has no period) or "not converged" (the rotation goes to and fro).
    rotation : float
        Estimate of the peak rotation [rad]; 0 without rocking, NaN where there is none.
    rotations : ndarray
        Rotations of the iteration, the first guess first [rad].
    alpha : float
        Slenderness of the block about its pivot [rad].
    p : float
        Frequency parameter of the block about its pivot [rad/s].
    energy_ratio : float
        Energy ratio r of the block about its pivot.
    damping_ratio : float
        Damping ratio of the block about its pivot.
    initiation : float
        Ratio S_a/(g tan(alpha)) of step 2.
    period : float
        Period of the last rotation but one, at which the spectrum was read last [s].
    """

    outcome: str
    rotation: float
    rotations: np.ndarray
    alpha: float
    p: float
    energy_ratio: float
    damping_ratio: float
    initiation: float
    period: float


def fema_356_rocking(
    block: RigidBlock,
    motion: GroundMotion | Spectrum | DesignSpectrum,
    *,
    damping: str = "2-15",
    bearing_capacity: float = np.inf,
    fixed_base_period: float = 0.0,
    arm: float | None = None,
    first_guess: float = 0.5,
    tolerance: float = 1e-3,
    iterations: int = 100,
) -> FemaEstimate:
    """Peak rotation of a rocking block by FEMA 356.

    The steps are those in the docstring of this module.

    Parameters
    ----------
    block : RigidBlock
        Block on rigid ground.
    motion : GroundMotion or callable or DesignSpectrum
        Ground motion, whose spectrum replaces the design spectrum; or a function of period [s] and
        damping ratio that gives the displacement [m], such as `modified_spectrum` of one for 5 %;
        or a `DesignSpectrum`, for which `modified_spectrum` is called. Both spectra need a
        `fixed_base_period`.
    damping : str, optional
        "2-15" (FEMA 356), or "2-16" (Priestley et al. 1978), which is more.
    bearing_capacity : float, optional
        Force q_c by which the ground resists each metre of the edge's way in [N/m]: the pivot lies
        m g/(2 q_c) inside the edge, which needs the block's mass; infinite for rigid ground.
    fixed_base_period : float, optional
        Period at which S_a is read, with 5 % of damping, in step 2 [s]; at 0, a rigid block, S_a is
        the peak of the ground's acceleration.
    arm : float, optional
        Arm of the rotation, theta = delta/arm [m]; R about the pivot if not given.
    first_guess : float, optional
        First rotation of the iteration, over alpha.
    tolerance : float, optional
        Change of the rotation, over alpha, at which the iteration ends.
    iterations : int, optional
        Largest number of iterations.

    Returns
    -------
    FemaEstimate
        Peak rotation, and how the iteration ended.

    Raises
    ------
    ValueError
        For impossible arguments, such as a stress block as wide as the block.
    """
    where = "fema_356_rocking"
    require(damping in _DAMPINGS, where, "damping", damping, "choose between '2-15' and '2-16'")
    if isinstance(motion, DesignSpectrum):
        motion = modified_spectrum(motion)
    positive(where, tolerance=tolerance)
    (guess,) = positive(where, first_guess=first_guess)
    require(guess < 1, where, "first_guess", guess, "it is a part of alpha, less than 1")
    pivot = _pivot(where, block, bearing_capacity)
    reach = pivot.radius if arm is None else float(positive(where, arm=arm)[0])
    ratio = float(_DAMPINGS[damping](pivot.energy_ratio))
    initiation = _spectral_acceleration(where, motion, fixed_base_period) / pivot.initiates
    rotations, period = [float(guess) * pivot.alpha], np.nan

    def estimate(outcome: str, rotation: float) -> FemaEstimate:
        return FemaEstimate(
            outcome, rotation, np.array(rotations), pivot.alpha, pivot.p, pivot.energy_ratio,
            ratio, initiation, period,
        )  # fmt: skip

    if initiation <= 1:
        return estimate(NO_ROCKING, 0.0)
    for _ in range(iterations):
        period = float(rocking_period(rotations[-1] / pivot.alpha, pivot.p))
        rotation = _displacement(motion, period, ratio) / reach
        rotations.append(rotation)
        if rotation >= pivot.alpha:
            return estimate(OVERTURNED, np.nan)
        if abs(rotation - rotations[-2]) <= tolerance * pivot.alpha:
            return estimate(CONVERGED, rotation)
    return estimate(NOT_CONVERGED, np.nan)


@dataclass(frozen=True)
class _Pivot:
    """The block about the point on which it rocks."""

    alpha: float
    radius: float
    p: float
    energy_ratio: float
    initiates: float


def _pivot(where: str, block: RigidBlock, bearing_capacity: float) -> _Pivot:
    values = block.parameters()
    mass, height, gravity = values["mass"], values["height"], values["gravity"]
    capacity = np.asarray(bearing_capacity, dtype=float)
    require(capacity > 0, where, "bearing_capacity", capacity, "it must be positive, in N/m")
    half_width = values["half_width"] - float(mass * gravity / (2 * capacity))
    rule = "the stress block is as wide as the block: give a larger capacity, in N/m"
    require(half_width > 0, where, "bearing_capacity", capacity, rule)
    alpha, radius = float(np.arctan2(half_width, height)), float(np.hypot(half_width, height))
    about = values["inertia"] + mass * radius**2
    r = energy_ratio_of_block(alpha, inertia=values["inertia"], mass=mass, radius=radius)
    p = float(np.sqrt(mass * gravity * radius / about))
    return _Pivot(alpha, radius, p, float(r), gravity * np.tan(alpha))


def _displacement(motion: GroundMotion | Spectrum, period: float, damping_ratio: float) -> float:
    if isinstance(motion, GroundMotion):
        return float(response_spectrum(motion, period, damping_ratio).displacement[0])
    return float(motion(period, damping_ratio))


def _spectral_acceleration(
    where: str, motion: GroundMotion | Spectrum, fixed_base_period: float
) -> float:
    (t,) = not_negative(where, fixed_base_period=fixed_base_period)
    period = float(t)
    if period:
        return (2 * np.pi / period) ** 2 * _displacement(motion, period, 0.05)
    if isinstance(motion, GroundMotion):
        return motion.peak
    raise InputError("fixed_base_period", of=where).wrong(
        "is 0, at which a spectrum of displacements has no acceleration: give the period at which "
        "the block does not rock [s], such as 0.05"
    )


@dataclass(frozen=True, eq=False)
class FemaComparison:
    """FEMA 356 and integration side by side, a row for each motion.

    Parameters
    ----------
    motions : tuple of str
        Names of the motions, n of them.
    fema : tuple of FemaEstimate
        Estimates with thesis 2-15.
    priestley : tuple of FemaEstimate
        Estimates with thesis 2-16.
    rotation : ndarray
        Largest rotation by integration, without its sign (n,) [rad].
    outcome : tuple of str
        How each motion ended, as "overturned".
    alpha : float
        Slenderness of the block [rad].
    """

    motions: tuple[str, ...]
    fema: tuple[FemaEstimate, ...]
    priestley: tuple[FemaEstimate, ...]
    rotation: np.ndarray
    outcome: tuple[str, ...]
    alpha: float

    @property
    def overturned(self) -> np.ndarray:
        """(n,) whether the block overturned in the integration."""
        return np.array([one == "overturned" for one in self.outcome])

    @property
    def answered(self) -> np.ndarray:
        """(n,) whether the block overturned in the integration, or stood to its end."""
        return np.isin(self.outcome, ANSWERS)

    @property
    def ratio(self) -> np.ndarray:
        """(n,) estimate with 2-15 over integration; NaN where one of the two has no rotation."""
        return self._ratio(self.fema)

    @property
    def ratio_2_16(self) -> np.ndarray:
        """(n,) the same of the estimate with 2-16."""
        return self._ratio(self.priestley)

    def _ratio(self, estimates: tuple[FemaEstimate, ...]) -> np.ndarray:
        angles = np.array([one.rotation for one in estimates])
        stood = self.answered & ~self.overturned
        rocked = stood & (self.rotation > 0) & (angles > 0)
        return np.divide(angles, self.rotation, out=np.full(len(angles), np.nan), where=rocked)

    def __str__(self) -> str:
        """The table, with rotations over alpha, and the number of each outcome.

        The ratio is that of 2-15 to integration; where only the estimate overturns, more than
        alpha over the rotation found.
        """
        lines = [f"{'motion':40} {'2-15':>14} {'2-16':>14} {'integrated':>12} {'ratio':>9}"]
        rows = zip(self.motions, self.fema, self.priestley, self.rotation, self.outcome,
                   strict=True)  # fmt: skip
        for name, one, other, rotation, outcome in rows:
            shown = [
                f"{e.rotation / self.alpha:.3f}" if np.isfinite(e.rotation) else e.outcome
                for e in (one, other)
            ]
            stood = outcome in STANDS
            largest = f"{rotation / self.alpha:.3f}" if stood else outcome
            ratio = "-"
            if stood and one.outcome == CONVERGED:
                ratio = f"{one.rotation / rotation:.2f}"
            elif stood and one.outcome == OVERTURNED:
                ratio = f"> {self.alpha / rotation:.2f}"
            lines.append(f"{name[:40]:40} {shown[0]:>14} {shown[1]:>14} {largest:>12} {ratio:>9}")
        return "\n".join([*lines, "", self.summary()])

    def summary(self) -> str:
        """Number of each outcome, and range of the ratios.

        Returns
        -------
        str
            Text of several lines.
        """
        number = len(self.motions)
        plural = "" if number == 1 else "s"
        text = [f"{number} motion{plural}; integrated: {self.overturned.sum()} overturned"]
        if lost := unanswered(self.outcome):
            text[0] += f"; {lost}, {(self.overturned | ~self.answered).sum()} if they did"
        for name, estimates, ratio in (
            ("2-15", self.fema, self.ratio),
            ("2-16", self.priestley, self.ratio_2_16),
        ):
            outcomes = [one.outcome for one in estimates]
            counted = ", ".join(
                f"{outcomes.count(o)} {o}"
                for o in (CONVERGED, OVERTURNED, NOT_CONVERGED, NO_ROCKING)
            )
            finite = ratio[np.isfinite(ratio)]
            fell = np.array([o == OVERTURNED for o in outcomes])
            stood = self.answered & ~self.overturned
            text.append(
                f"{name}: {counted}; overturned by both {(fell & self.overturned).sum()}, by the "
                f"estimate alone {(fell & stood).sum()}, by integration alone "
                f"{(~fell & self.overturned).sum()}"
            )
            if len(finite):
                text.append(
                    f"      ratio to integration of {len(finite)}: median {np.median(finite):.2f}, "
                    f"from {finite.min():.2f} to {finite.max():.2f}; {(finite > 1).sum()} above 1"
                )
        return "\n".join(text)


def fema_356_against_integration(
    block: RigidBlock,
    motions: Sequence[GroundMotion],
    *,
    impact: ImpactLaw | None = None,
    quiet: float = 20.0,
    **choices,
) -> FemaComparison:
    """FEMA 356's estimate and direct integration, for each of some motions.

    Parameters
    ----------
    block : RigidBlock
        Block on rigid ground.
    motions : sequence of GroundMotion
        Ground motions, scaled as they should be, such as ``[record.scaled_to(peak=3.0) for record
        in records]``.
    impact : ImpactLaw, optional
        Impact law of the integration; AngularMomentum(), whose r is 2-6, if not given.
    quiet : float, optional
        Time that the block has to fall or to come to rest after the shaking [s].
    **choices : object
        Arguments of `fema_356_rocking` but for the damping, which is 2-15 and 2-16 in turn.

    Returns
    -------
    FemaComparison
        Estimates and integrated rotations, a row for each motion.

    See Also
    --------
    fema_356_rocking : The estimate for one motion, with its errors.
    """
    shaken = [motion.padded_by(quiet) for motion in motions]

    def case(motion: int) -> Case:
        return Case(block, shaken[motion], impact)

    sweep = simulate_many(
        case, over={"motion": range(len(shaken))}, sweep_options=SweepOptions(progress=False)
    )
    estimates = [
        tuple(fema_356_rocking(block, motion, damping=which, **choices) for motion in motions)
        for which in ("2-15", "2-16")
    ]
    return FemaComparison(
        motions=tuple(motion.name for motion in motions),
        fema=estimates[0],
        priestley=estimates[1],
        rotation=sweep.peak.sel(state="theta").values,
        outcome=tuple(str(one) for one in sweep.outcome.values),
        alpha=block.alpha,
    )
