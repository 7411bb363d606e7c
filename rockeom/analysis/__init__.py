"""The formulas of the field as functions of arrays; NumPy and SciPy only, never SymPy.

    from rockeom import analysis

    analysis.energy_ratio_of_block(alpha=[0.1, 0.2, 0.3])
    analysis.exact_quarter_period(theta_0=0.1, alpha=0.2, p=4.0)

All are in SI units and radians and take numbers or arrays, which they broadcast; what cannot be is
a ValueError that names the function, the argument, its value and the remedy. "Thesis" numbers are
the equations of Ma (2010), which `rockeom.thesis` checks.
"""

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:  # and when a program runs, each where it is first asked for, see below
    from rockeom.analysis.boundaries import OverturningPoint, followed_boundary, overturning_point
    from rockeom.analysis.branches import (
        FEIGENBAUM,
        Bifurcation,
        Cascade,
        OrbitBranch,
        bifurcation_value,
        continued_orbits,
        orbit_branch,
        period_doublings,
    )
    from rockeom.analysis.controlled_wall import (
        DissipationLimit,
        EdgeUplifts,
        RotationCentre,
        Tendon,
        TendonPath,
        Wall,
        back_calculated_force,
        corrected_uplifts,
        energy_ratio_4_31,
        energy_ratio_4_36,
        energy_ratio_4_38,
        harmonic_force,
        peak_sequence,
        quarter_period_fit,
    )
    from rockeom.analysis.damping import (
        DESIGN_FACTORS,
        GRANT_FACTORS,
        DesignFactors,
        GrantFactors,
        bilinear_damping,
        damping_from_decrement,
        damping_from_decrement_exact,
        design_damping,
        equivalent_damping,
        fema_356_damping,
        flag_damping,
        grant_damping,
        priestley_damping,
        recentring_ratio,
        simplified_damping,
        takeda_damping,
    )
    from rockeom.analysis.design.displacement_based import (
        DesignCheck,
        DisplacementDesign,
        MeanSpectrum,
        check_design,
        damping_modifier,
        displacement_based_design,
        modified_spectrum,
        wall_for_base_shear,
    )
    from rockeom.analysis.design.envelope import RestitutionEnvelope, restitution_envelope
    from rockeom.analysis.design.fema_356 import (
        FemaComparison,
        FemaEstimate,
        fema_356_against_integration,
        fema_356_rocking,
    )
    from rockeom.analysis.design.hysteresis import (
        BilinearRule,
        FlagRule,
        HysteresisLoop,
        HysteresisRule,
        HysteresisStep,
        TakedaRule,
    )
    from rockeom.analysis.design.oscillator import (
        Damping,
        EquivalentOscillator,
        OscillatorResponse,
        PassageDamping,
        TangentDamping,
        ViscousDamping,
        bilinear_fit,
        linear_start,
        tabulated,
    )
    from rockeom.analysis.design.overturning import (
        overturning_constant,
        overturning_half_sine,
        overturning_spectral_velocity,
        stable_slenderness,
    )
    from rockeom.analysis.energies import Energies, energies_of_states, held_states, static_energy
    from rockeom.analysis.fitting import (
        Fit,
        Swings,
        energy_ratios_by_release,
        fit,
        fit_free_vibration,
        fit_moving_centre,
        fit_rotation_centre,
        swings,
    )
    from rockeom.analysis.foundation import (
        FoundationSprings,
        circular_mat,
        rectangular_mat,
        rigid_moment,
        two_spring_moment,
        two_spring_uplift_rotation,
        winkler_moment,
        winkler_stiffness,
        winkler_stiffness_from_rotation,
        winkler_uplift_rotation,
    )
    from rockeom.analysis.fragility import Fragility, fit_fragility, fragility_of
    from rockeom.analysis.free_vibration import (
        CycleDamping,
        FreeVibration,
        QuarterPeriods,
        Restitution,
        coefficient_of_determination,
        resolved_floor,
    )
    from rockeom.analysis.impacts import (
        EnergyLossFit,
        Impacts,
        Mean,
        PeakChange,
        Peaks,
        RotationalSpring,
        fitted_peaks,
        fitted_rotational_spring,
        low_pass_on_peaks,
        record_energies,
        rotational_stiffness_from_excess,
    )
    from rockeom.analysis.isolation import (
        Demands,
        EnergyBalance,
        Isolation,
        beside_fixed_base,
        demands,
        energy_balance,
    )
    from rockeom.analysis.lyapunov import LyapunovSpectrum, lyapunov_spectrum
    from rockeom.analysis.measured import (
        displacement_from_rotation,
        rotation_about_moving_centre,
        rotation_centre,
        rotation_from_displacement,
        stiffness_from_period,
        viscous_coefficient,
    )
    from rockeom.analysis.measured_forces import (
        ImpactForces,
        SupportForces,
        impact_forces_of_record,
        kink_gain,
        support_forces_of_record,
    )
    from rockeom.analysis.noise import Noise, noise_level
    from rockeom.analysis.orbits import GrazingError, PeriodicOrbit, Shooting, StroboscopicMap
    from rockeom.analysis.overturning import (
        dimensionless_pulses,
        impacts_before_overturning,
        minimum_overturning,
        overturning_boundaries,
        rocking_spectrum,
    )
    from rockeom.analysis.periods import exact_quarter_period, quarter_period, rocking_period
    from rockeom.analysis.points_of_interest import (
        PointsOfInterest,
        importance_scores,
        points_by_prominence,
        points_by_score,
    )
    from rockeom.analysis.pulses import PULSE_MODELS, PulseFit, fit_pulse
    from rockeom.analysis.records import MeasuredRecord, Velocities
    from rockeom.analysis.reliability import (
        FirstOrder,
        MonteCarlo,
        first_order_reliability,
        monte_carlo,
        reliability_of,
    )
    from rockeom.analysis.restitution import (
        energy_ratio_from_velocity_ratio,
        energy_ratio_of_block,
        energy_ratio_of_lumped_mass,
        energy_ratios_from_peaks,
        energy_ratios_from_peaks_of_lumped_mass,
        gravitational_energy,
        spring_energy,
        velocity_ratio_from_energy_ratio,
    )
    from rockeom.analysis.sections import basin_stability, basins, poincare_sections
    from rockeom.analysis.slips import (
        Slips,
        rotation_centre_between_gauges,
        slips_from_tendon_force,
        slips_from_uplifts,
    )
    from rockeom.analysis.spectra import (
        OscillatorHistory,
        ResponseSpectrum,
        oscillator_history,
        response_spectrum,
    )
    from rockeom.analysis.support_forces import (
        acceleration_at_impact,
        block_reactions,
        block_reactions_at_impact,
        centroid_acceleration,
        impact_speed,
    )
    from rockeom.analysis.sweeps import outcome_labels, peaks_of
    from rockeom.analysis.uplift import (
        uplift_acceleration,
        uplift_displacement,
        uplifted_damping,
        uplifted_frequency,
    )
    from rockeom.analysis.windows import MovingWindow, moving_window

__all__ = [
    "DESIGN_FACTORS",
    "FEIGENBAUM",
    "GRANT_FACTORS",
    "PULSE_MODELS",
    "Bifurcation",
    "BilinearRule",
    "Cascade",
    "CycleDamping",
    "Damping",
    "Demands",
    "DesignCheck",
    "DesignFactors",
    "DisplacementDesign",
    "DissipationLimit",
    "EdgeUplifts",
    "Energies",
    "EnergyBalance",
    "EnergyLossFit",
    "EquivalentOscillator",
    "FemaComparison",
    "FemaEstimate",
    "FirstOrder",
    "Fit",
    "FlagRule",
    "FoundationSprings",
    "Fragility",
    "FreeVibration",
    "GrantFactors",
    "GrazingError",
    "HysteresisLoop",
    "HysteresisRule",
    "HysteresisStep",
    "ImpactForces",
    "Impacts",
    "Isolation",
    "LyapunovSpectrum",
    "Mean",
    "MeanSpectrum",
    "MeasuredRecord",
    "MonteCarlo",
    "MovingWindow",
    "Noise",
    "OrbitBranch",
    "OscillatorHistory",
    "OscillatorResponse",
    "OverturningPoint",
    "PassageDamping",
    "PeakChange",
    "Peaks",
    "PeriodicOrbit",
    "PointsOfInterest",
    "PulseFit",
    "QuarterPeriods",
    "ResponseSpectrum",
    "Restitution",
    "RestitutionEnvelope",
    "RotationCentre",
    "RotationalSpring",
    "Shooting",
    "Slips",
    "StroboscopicMap",
    "SupportForces",
    "Swings",
    "TakedaRule",
    "TangentDamping",
    "Tendon",
    "TendonPath",
    "Velocities",
    "ViscousDamping",
    "Wall",
    "acceleration_at_impact",
    "back_calculated_force",
    "basin_stability",
    "basins",
    "beside_fixed_base",
    "bifurcation_value",
    "bilinear_damping",
    "bilinear_fit",
    "block_reactions",
    "block_reactions_at_impact",
    "centroid_acceleration",
    "check_design",
    "circular_mat",
    "coefficient_of_determination",
    "continued_orbits",
    "corrected_uplifts",
    "damping_from_decrement",
    "damping_from_decrement_exact",
    "damping_modifier",
    "demands",
    "design_damping",
    "dimensionless_pulses",
    "displacement_based_design",
    "displacement_from_rotation",
    "energies_of_states",
    "energy_balance",
    "energy_ratio_4_31",
    "energy_ratio_4_36",
    "energy_ratio_4_38",
    "energy_ratio_from_velocity_ratio",
    "energy_ratio_of_block",
    "energy_ratio_of_lumped_mass",
    "energy_ratios_by_release",
    "energy_ratios_from_peaks",
    "energy_ratios_from_peaks_of_lumped_mass",
    "equivalent_damping",
    "exact_quarter_period",
    "fema_356_against_integration",
    "fema_356_damping",
    "fema_356_rocking",
    "first_order_reliability",
    "fit",
    "fit_fragility",
    "fit_free_vibration",
    "fit_moving_centre",
    "fit_pulse",
    "fit_rotation_centre",
    "fitted_peaks",
    "fitted_rotational_spring",
    "flag_damping",
    "followed_boundary",
    "fragility_of",
    "grant_damping",
    "gravitational_energy",
    "harmonic_force",
    "held_states",
    "impact_forces_of_record",
    "impact_speed",
    "impacts_before_overturning",
    "importance_scores",
    "kink_gain",
    "linear_start",
    "low_pass_on_peaks",
    "lyapunov_spectrum",
    "minimum_overturning",
    "modified_spectrum",
    "monte_carlo",
    "moving_window",
    "noise_level",
    "orbit_branch",
    "oscillator_history",
    "outcome_labels",
    "overturning_boundaries",
    "overturning_constant",
    "overturning_half_sine",
    "overturning_point",
    "overturning_spectral_velocity",
    "peak_sequence",
    "peaks_of",
    "period_doublings",
    "poincare_sections",
    "points_by_prominence",
    "points_by_score",
    "priestley_damping",
    "quarter_period",
    "quarter_period_fit",
    "recentring_ratio",
    "record_energies",
    "rectangular_mat",
    "reliability_of",
    "resolved_floor",
    "response_spectrum",
    "restitution_envelope",
    "rigid_moment",
    "rocking_period",
    "rocking_spectrum",
    "rotation_about_moving_centre",
    "rotation_centre",
    "rotation_centre_between_gauges",
    "rotation_from_displacement",
    "rotational_stiffness_from_excess",
    "simplified_damping",
    "slips_from_tendon_force",
    "slips_from_uplifts",
    "spring_energy",
    "stable_slenderness",
    "static_energy",
    "stiffness_from_period",
    "support_forces_of_record",
    "swings",
    "tabulated",
    "takeda_damping",
    "two_spring_moment",
    "two_spring_uplift_rotation",
    "uplift_acceleration",
    "uplift_displacement",
    "uplifted_damping",
    "uplifted_frequency",
    "velocity_ratio_from_energy_ratio",
    "viscous_coefficient",
    "wall_for_base_shear",
    "winkler_moment",
    "winkler_stiffness",
    "winkler_stiffness_from_rotation",
    "winkler_uplift_rotation",
]

_HOMES = (
    "controlled_wall", "damping", "energies", "foundation", "free_vibration", "measured", "orbits",
    "periods", "restitution", "support_forces", "uplift", "isolation",
    "design.displacement_based", "design.envelope", "design.fema_356", "design.hysteresis",
    "design.oscillator", "design.overturning", "spectra", "fitting", "impacts", "measured_forces",
    "noise", "points_of_interest", "pulses", "records", "slips", "windows",
    "fragility", "reliability", "sweeps", "branches", "sections", "lyapunov", "overturning",
    "boundaries",
)  # fmt: skip

_RENAMED = {"TwoSprings": "FoundationSprings"}


def __getattr__(name: str) -> Any:
    """Import no more than it takes to find a name: who simulates a wall wants only `Wall`."""
    if name in _HOMES:
        return import_module(f"rockeom.analysis.{name}")
    if name in __all__:
        for home in map(__getattr__, _HOMES):
            if hasattr(home, name):
                globals()[name] = getattr(home, name)
                return globals()[name]
    if name in _RENAMED:
        raise AttributeError(f"rockeom.analysis.{name} is called {_RENAMED[name]} now")
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__, *_HOMES})
