"""Displacement-based design: from a target drift to the base shear (thesis 2-31 to 2-35).

    import rockeom as rk
    from rockeom.analysis import design, formulas

    records = [rk.GroundMotion.from_library(f"El Centro 1940 {n}") for n in (180, 270)]
    found = design.displacement_based_design(
        target_displacement=0.15, yield_displacement=0.03, mass=20e3,
        spectrum=design.MeanSpectrum(records),
        damping=lambda ductility, period: formulas.design_damping("flag", ductility, period),
    )
    found.base_shear, found.effective_period  # N, s

The substitute structure is elastic: its stiffness is the secant one at the target displacement,
and its damping ratio that of 2-31 to 2-35 at the ductility there. The period at which the spectrum
of that damping has the target displacement gives the stiffness, and this the base shear
(Priestley, Calvi and Kowalsky 2007).
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import ArrayLike

from rockeom.analysis.design.hysteresis import FlagRule
from rockeom.analysis.dynamics.spectra import Spectrum, response_spectrum
from rockeom.analysis.formulas.controlled_wall import Wall
from rockeom.motion import DesignSpectrum, GroundMotion
from rockeom.numbers.checks import not_negative, positive, require

DESIGNED = "designed"
BEYOND = "target beyond the spectrum"
BELOW = "target below the spectrum"


def damping_modifier(damping_ratio: ArrayLike, exponent: float = 0.5):
    """Displacement of a damped spectrum over that of 5 %, ``(0.07/(0.02 + xi))**exponent``.

    Parameters
    ----------
    damping_ratio : array_like
        Damping ratio xi, any shape.
    exponent : float, optional
        0.5, or 0.25 near a fault whose motion is a pulse.

    Returns
    -------
    float or ndarray
        Modifier, in the shape of the damping ratio.

    Raises
    ------
    ValueError
        For numbers that are not positive.

    References
    ----------
    Priestley, Calvi and Kowalsky (2007).
    """
    (xi,) = not_negative("damping_modifier", damping_ratio=damping_ratio)
    positive("damping_modifier", exponent=exponent)
    return (0.07 / (0.02 + xi)) ** exponent


def modified_spectrum(
    spectrum: Callable[[float], float] | DesignSpectrum, exponent: float = 0.5
) -> Spectrum:
    """Spectrum of displacements for any damping, from that for 5 %.

    Parameters
    ----------
    spectrum : callable or DesignSpectrum
        Function of period [s] that gives the displacement [m] for 5 % of damping; or a
        `DesignSpectrum`, with its displacements.
    exponent : float, optional
        Exponent of `damping_modifier`.

    Returns
    -------
    callable
        Displacement [m] of period [s] and damping ratio.

    Raises
    ------
    ValueError
        For a design spectrum of another damping.
    """
    if isinstance(spectrum, DesignSpectrum):
        xi, rule = spectrum.damping_ratio, "make the spectrum with damping_ratio=0.05"
        require(xi == 0.05, "modified_spectrum", "damping_ratio", xi, rule)
    of_5_per_cent = spectrum.displacement if isinstance(spectrum, DesignSpectrum) else spectrum

    def damped(period: float, damping_ratio: float) -> float:
        return float(of_5_per_cent(period) * damping_modifier(damping_ratio, exponent))

    return damped


@dataclass(frozen=True)
class MeanSpectrum:
    """Mean of the elastic spectra of some motions, exact for any period and damping.

    Parameters
    ----------
    motions : sequence of GroundMotion
        Ground motions.
    """

    motions: Sequence[GroundMotion]

    def __call__(self, period: float, damping_ratio: float) -> float:
        """Mean of the largest displacements [m]; period [s]."""
        displacements = [
            response_spectrum(m, period, damping_ratio).displacement[0] for m in self.motions
        ]
        return float(np.mean(displacements))


@dataclass(frozen=True)
class DisplacementDesign:
    """Result of a displacement-based design.

    Parameters
    ----------
    outcome : str
        "designed"; "target beyond the spectrum", where no period up to the longest needs so much;
        or "target below the spectrum", where the shortest period needs more.
    target_displacement : float
        Target displacement [m].
    yield_displacement : float
        Yield displacement [m].
    ductility : float
        Ratio of the two.
    mass : float
        Effective mass [kg].
    damping_ratio : float
        Damping ratio at the effective period; NaN where there is no design.
    effective_period : float
        Effective period [s]; NaN where there is no design.
    effective_stiffness : float
        Secant stiffness at the target [N/m]; NaN where there is no design.
    base_shear : float
        Force at the target displacement [N]; NaN where there is no design.
    """

    outcome: str
    target_displacement: float
    yield_displacement: float
    ductility: float
    mass: float
    damping_ratio: float
    effective_period: float
    effective_stiffness: float
    base_shear: float

    def flag(self, stiffness_ratio: float, flag_height: float = 0.0) -> FlagRule:
        """Flag-shaped rule of this strength.

        Parameters
        ----------
        stiffness_ratio : float
            Ratio k_p/k_i of the stiffness after yield and the initial one.
        flag_height : float, optional
            Height beta_FS of the flag over the yield force, as in `FlagRule`.

        Returns
        -------
        FlagRule
            Rule whose force at the target displacement is the base shear.
        """
        strength = self.base_shear / (1 + stiffness_ratio * (self.ductility - 1))
        return FlagRule(strength, self.yield_displacement, stiffness_ratio, flag_height)


def displacement_based_design(
    target_displacement: float,
    yield_displacement: float,
    mass: float,
    spectrum: Spectrum | DesignSpectrum,
    damping: Callable[[float, float], float],
    *,
    periods: tuple[float, float] = (0.05, 10.0),
) -> DisplacementDesign:
    """Base shear with which a structure keeps to a target displacement.

    Parameters
    ----------
    target_displacement : float
        Target displacement of the substitute structure [m].
    yield_displacement : float
        Yield displacement of the substitute structure [m].
    mass : float
        Effective mass [kg].
    spectrum : callable or DesignSpectrum
        Displacement [m] of period [s] and damping ratio, such as ``MeanSpectrum(motions)`` or
        `modified_spectrum` of one for 5 %; or a `DesignSpectrum`, for which `modified_spectrum` is
        called.
    damping : callable
        Damping ratio of ductility and effective period [s], such as 2-31 with 2-32c, ``lambda mu,
        t: 0.05 + flag_damping(mu, 0.05, 0.35)``, 2-33 (`grant_damping`), 2-34 or 2-35.
    periods : tuple of (float, float), optional
        Shortest and longest period of the search [s].

    Returns
    -------
    DisplacementDesign
        Base shear, effective stiffness, period and damping, or the reason why there is no design.

    Raises
    ------
    ValueError
        For a target below the yield displacement, where the structure is elastic, and for numbers
        that are not positive.

    Notes
    -----
    Several periods may have the target displacement; the shortest is the effective one.
    """
    from scipy.optimize import brentq  # takes long to import

    where = "displacement_based_design"
    target, yields, m = positive(
        where, target_displacement=target_displacement, yield_displacement=yield_displacement,
        mass=mass,
    )  # fmt: skip
    rule = "the target is below the yield displacement: the structure stays elastic"
    require(target >= yields, where, "target_displacement", target, rule)
    first, last = (float(t) for t in positive(where, periods=np.asarray(periods))[0])
    if isinstance(spectrum, DesignSpectrum):
        last, spectrum = min(last, spectrum.longest), modified_spectrum(spectrum)
    mu = float(target / yields)

    def ratio(period: float) -> float:
        return float(damping(mu, period))

    def beyond(period: float) -> float:
        return spectrum(period, ratio(period)) - float(target)

    def design(outcome: str, period: float) -> DisplacementDesign:
        designed = outcome == DESIGNED
        stiffness = float(4 * np.pi**2 * m / period**2) if designed else np.nan
        return DisplacementDesign(
            outcome, float(target), float(yields), mu, float(m),
            ratio(period) if designed else np.nan, period if designed else np.nan, stiffness,
            stiffness * float(target),
        )  # fmt: skip

    before = first
    if beyond(first) > 0:
        return design(BELOW, np.nan)
    for period in np.geomspace(first, last, 80)[1:]:
        if beyond(float(period)) >= 0:
            return design(DESIGNED, float(brentq(beyond, before, float(period), xtol=1e-10)))
        before = float(period)
    return design(BEYOND, np.nan)


@dataclass(frozen=True, eq=False)
class DesignCheck:
    """Peaks of a non-linear structure under some motions, compared with the target of its design.

    Parameters
    ----------
    peaks : ndarray
        Largest displacements (m,), one for each motion [m].
    factors : ndarray
        Factors (m,) by which the motions were scaled.
    target_displacement : float
        Target of the design [m].
    """

    peaks: np.ndarray
    factors: np.ndarray
    target_displacement: float

    @property
    def ratio(self) -> np.ndarray:
        """(m,) peak over target."""
        return self.peaks / self.target_displacement

    def __str__(self) -> str:
        low, middle, high = np.quantile(self.ratio, [0.16, 0.5, 0.84])
        return (
            f"{len(self.ratio)} motions: peak over target {self.ratio.mean():.2f} on the mean, "
            f"median {middle:.2f}, 16 to 84 % from {low:.2f} to {high:.2f}"
        )


def check_design(
    design: DisplacementDesign,
    motions: Sequence[GroundMotion],
    peaks: Callable[[Sequence[GroundMotion]], ArrayLike],
    *,
    matched: bool = True,
) -> DesignCheck:
    """Compare a design with the integration of the structure designed.

    Parameters
    ----------
    design : DisplacementDesign
        Result of `displacement_based_design`.
    motions : sequence of GroundMotion
        Ground motions, m of them.
    peaks : callable
        Function from the m motions to the largest displacements (m,) [m], such as ``lambda some:
        oscillator.response(some).peak`` of an `EquivalentOscillator`, or a sweep of a structure.
    matched : bool, optional
        Whether each motion is first scaled so that its own damped spectrum has the target at the
        effective period: this compares the substitute structure with the non-linear one. Otherwise
        the motions are used unscaled, and their scatter counts as well.

    Returns
    -------
    DesignCheck
        Peaks and factors of the motions, with the target.

    Raises
    ------
    ValueError
        For a design that has no effective period.
    """
    rule = "there is no design to check: choose another target or spectrum"
    designed = design.outcome == DESIGNED
    require(designed, "check_design", "design.effective_period", design.effective_period, rule)
    factors = np.ones(len(motions))
    if matched:
        for i, motion in enumerate(motions):
            spectrum = response_spectrum(motion, design.effective_period, design.damping_ratio)
            factors[i] = design.target_displacement / spectrum.displacement[0]
    scaled = [m.scaled(acceleration=float(f)) for m, f in zip(motions, factors, strict=True)]
    return DesignCheck(np.asarray(peaks(scaled), dtype=float), factors, design.target_displacement)


def wall_for_base_shear(wall: Wall, displacement: float, base_shear: float) -> Wall:
    """Wall with the prestress of its tendons that gives a force at a displacement.

    Parameters
    ----------
    wall : Wall
        Wall whose tendons are all prestressed by the same factor more or less.
    displacement : float
        Displacement at the wall's height [m].
    base_shear : float
        Horizontal force there [N].

    Returns
    -------
    Wall
        Wall with the other initial forces of its tendons.

    Raises
    ------
    ValueError
        Where no prestress between none and yield gives the force; the message has the possible
        range.
    """
    from scipy.optimize import brentq  # takes long to import

    where = "wall_for_base_shear"
    shear, at = positive(where, base_shear=base_shear, displacement=displacement)

    def stressed(factor: float) -> Wall:
        return replace(
            wall,
            tendons=tuple(
                replace(one, initial_force=factor * one.initial_force) for one in wall.tendons
            ),
        )

    def lacking(factor: float) -> float:
        return float(stressed(factor).restoring_force(at)) - float(shear)

    most = min(one.yield_force / one.initial_force for one in wall.tendons) * (1 - 1e-9)
    low, high = lacking(0.0) + float(shear), lacking(most) + float(shear)
    rule = (
        f"the wall has from {low:.0f} to {high:.0f} N at {float(at):g} m, by the prestress of its "
        "tendons: change their number or the wall"
    )
    require((shear >= low) & (shear <= high), where, "base_shear", shear, rule)
    return stressed(float(brentq(lacking, 0.0, most, xtol=1e-12)))
