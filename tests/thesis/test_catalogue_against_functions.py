"""The functions of `rockeom.analysis` agree with the equations of the catalogue they implement.

The two were typed apart. Each is evaluated at random points, the equation by SymPy.
"""

import re
from collections.abc import Callable, Mapping

import numpy as np
import pytest
import sympy as sp

from rockeom.analysis import design, dynamics, formulas, identification
from rockeom.thesis import EQUATIONS, notation as th, wall_tests

POINTS = 20
Values = Mapping[sp.Symbol, np.ndarray]
Function = Callable[[Values, int], np.ndarray]

RANGES: dict[sp.Symbol, tuple[float, float]] = {
    th.alpha: (0.1, 0.4),
    th.theta_0: (0.001, 0.09),
    th.theta: (0.001, 0.09),
    th.theta_before: (0.001, 0.09),
    th.theta_after: (0.001, 0.09),
    th.theta_d1: (0.6, 2.0),
    th.theta_d2: (0.1, 0.6),
    th.r: (0.05, 1.0),
    th.B: (0.2, 0.5),
    th.H_e: (1.0, 1.5),
    th.H_b: (0.1, 0.5),
    th.Delta: (1.0, 29.0),
    th.B_measured: (200.0, 400.0),
    th.H_measured: (900.0, 1200.0),
    th.x_centre: (80.0, 520.0),
    th.mu: (1.0, 6.0),
    th.k_p: (0.02, 0.2),
    th.k_i: (1.0, 2.0),
    th.alpha_T: (0.0, 0.5),
    th.beta_FS: (0.1, 0.8),
    th.fit_c: (-0.1, 3.0),
    th.fit_d: (0.2, 6.0),
}
"""Admissible values; those of other symbols lie in (0.5, 2), and in (-2, 2) if they have a sign."""

ON_A_SIDE = (th.theta, th.theta_before, th.Delta)
"""Symbols that take the sign of theta; the peak after an impact has the other."""


POLAR = (
    (th.R, None, th.B, th.H),
    (th.R_e, th.alpha_e, th.B, th.H_e),
    (th.R_b, th.alpha_b, th.B, th.H_b),
    (th.R_measured, th.alpha_measured, th.B_measured, th.H_measured),
)
"""Radius and angle that follow from width and height; alpha is drawn apart, 2-8 is without it."""


def random_values(side: int, seed: str) -> dict[sp.Symbol, np.ndarray]:
    rng = np.random.default_rng([ord(letter) for letter in seed])
    values = {}
    for symbol in dict.fromkeys(entry.symbol for entry in th.NOTATION):
        ordinary = (0.5, 2.0) if symbol.is_positive else (-2.0, 2.0)
        values[symbol] = rng.uniform(*RANGES.get(symbol, ordinary), POINTS)
    for symbol in ON_A_SIDE:
        values[symbol] = values[symbol] * side
    values[th.theta_after] = -side * values[th.theta_after]
    values[th.PM] = np.full(POINTS, side)
    for radius, angle, width, height in POLAR:
        values[radius] = np.hypot(values[width], values[height])
        if angle is not None:
            values[angle] = np.arctan2(values[width], values[height])
    values[th.I_o] = values[th.I_o] + values[th.m] * values[th.R] ** 2
    values[th.y_centre] = 600.0 - values[th.x_centre]
    return values


def inertia(n: Values) -> dict[str, np.ndarray]:
    return {
        "mass": n[th.m],
        "radius": n[th.R],
        "inertia": n[th.I_o] - n[th.m] * n[th.R] ** 2,
    }


def frequency_parameter(n: Values) -> np.ndarray:
    return np.sqrt(n[th.m] * n[th.g] * n[th.R] / n[th.I_o])


def block(n: Values) -> dict[str, np.ndarray]:
    return {"mass": n[th.m], "alpha": n[th.alpha], "radius": n[th.R], "gravity": n[th.g]}


def without(names: str, arguments: dict) -> dict:
    return {k: v for k, v in arguments.items() if k not in names.split()}


def peaks(n: Values) -> np.ndarray:
    return np.stack([n[th.theta_before], n[th.theta_after]], axis=-1)


def ratios_from_peaks(n: Values, stiffness: np.ndarray | None = None) -> np.ndarray:
    """The ratio of each point; a spring is of one stiffness for all peaks of a call."""
    found = []
    for i, pair in enumerate(peaks(n)):
        at = {name: value[i] for name, value in block(n).items()}
        spring = 0.0 if stiffness is None else float(stiffness[i])
        (ratio,) = formulas.energy_ratios_from_peaks(pair, rotational_stiffness=spring, **at)
        found.append(ratio)
    return np.array(found)


def lumped_mass_ratios_from_peaks(n: Values) -> np.ndarray:
    names = {
        "mass": th.m_e,
        "height": th.H_e,
        "base_mass": th.m_b,
        "base_height": th.H_b,
        "half_width": th.B,
    }
    columns = {name: n[symbol][:, np.newaxis] for name, symbol in names.items()}
    return formulas.energy_ratios_from_peaks_of_lumped_mass(peaks(n), **columns)[:, 0]


def turning(n: Values) -> tuple[np.ndarray, ...]:
    return n[th.theta], n[th.theta_d], n[th.theta_dd]


def accelerations(n: Values):
    geometry = without("mass gravity", block(n))
    return formulas.centroid_acceleration(*turning(n), ground_acceleration=n[th.a_gx], **geometry)


def forces(n: Values):
    return formulas.block_reactions(*turning(n), ground_acceleration=n[th.a_gx], **block(n))


def forces_at_impact(n: Values, side: int, rate=None):
    rate = n[th.theta_d_impact] if rate is None else rate
    return formulas.block_reactions_at_impact(rate, side, slender=True, **block(n))


def fitted(n: Values, function, factors, symbols, *arguments, **named) -> np.ndarray:
    """A fit at every point with factors of its own."""
    found = []
    for i in range(POINTS):
        own = factors(*(float(n[symbol][i]) for symbol in symbols))
        named_here = {k: v[i] for k, v in named.items()}
        found.append(function(own, *(a[i] for a in arguments), **named_here))
    return np.array(found)


A_TO_D = (th.fit_a, th.fit_b, th.fit_c, th.fit_d)

FUNCTIONS: dict[str, tuple[Function, ...]] = {
    "2-1": (lambda n, s: formulas.uplift_acceleration(n[th.B], n[th.H], n[th.g]),),
    "2-4": (
        lambda n, s: formulas.energy_ratio_from_velocity_ratio(n[th.theta_d2] / n[th.theta_d1]),
    ),
    "2-5": (
        lambda n, s: formulas.rocking_period(n[th.theta_0] / n[th.alpha], n[th.p]),
        lambda n, s: 4 * formulas.quarter_period(n[th.theta_0] / n[th.alpha], n[th.p]),
    ),
    "2-6": (lambda n, s: formulas.energy_ratio_of_block(n[th.alpha], **inertia(n)),),
    "2-8a": (lambda n, s: formulas.uplifted_frequency(n[th.omega_n], n[th.B], n[th.H]),),
    "2-8b": (lambda n, s: formulas.uplifted_damping(n[th.xi], n[th.B], n[th.H]),),
    "2-15": (lambda n, s: formulas.fema_356_damping(n[th.r]),),
    "2-16": (lambda n, s: formulas.priestley_damping(n[th.r]),),
    "2-30": (lambda n, s: formulas.recentring_ratio(n[th.M_AE], n[th.M_N], n[th.M_ED]),),
    "2-31": (lambda n, s: formulas.equivalent_damping(n[th.xi_el], n[th.xi_hyst]),),
    "2-32a": (lambda n, s: formulas.bilinear_damping(n[th.mu], n[th.k_p] / n[th.k_i]),),
    "2-32b": (
        lambda n, s: formulas.takeda_damping(n[th.mu], n[th.k_p] / n[th.k_i], n[th.alpha_T]),
    ),
    "2-32c": (
        lambda n, s: formulas.flag_damping(n[th.mu], n[th.k_p] / n[th.k_i], n[th.beta_FS]),
    ),
    "2-33": (
        lambda n, s: fitted(
            n, formulas.grant_damping, formulas.GrantFactors, (*A_TO_D, th.fit_e, th.fit_f),
            n[th.mu], n[th.effective_period],
            constant_damping=n[th.xi_const], tangent_damping=n[th.xi_tang],
        ),
    ),
    "2-34": (lambda n, s: formulas.simplified_damping(n[th.xi_v], n[th.C_i], n[th.mu]),),
    "2-35": (
        lambda n, s: fitted(
            n, formulas.design_damping, formulas.DesignFactors, A_TO_D,
            n[th.mu], n[th.effective_period],
        ),
    ),
    "3-2": (lambda n, s: formulas.gravitational_energy(n[th.theta], **block(n)),),
    "3-3": (lambda n, s: ratios_from_peaks(n),),
    "3-4": (lambda n, s: formulas.spring_energy(n[th.theta], n[th.k_rot]),),
    "3-6": (lambda n, s: accelerations(n)[0],),
    "3-7": (lambda n, s: accelerations(n)[1],),
    "3-8": (lambda n, s: forces(n)[0],),
    "3-9": (lambda n, s: forces(n)[1],),
    "3-10": (
        lambda n, s: formulas.acceleration_at_impact(s, slender=True, **without("mass", block(n))),
    ),
    "3-11": (lambda n, s: forces_at_impact(n, s)[0],),
    "3-12": (lambda n, s: forces_at_impact(n, s)[1],),
    "3-13": (
        lambda n, s: s * formulas.impact_speed(n[th.alpha], **without("mass", block(n))),
    ),
    "3-14": (lambda n, s: forces_at_impact(n, s, 0.0)[0],),
    "3-15": (lambda n, s: forces_at_impact(n, s, 0.0)[1],),
    "3-16": (lambda n, s: ratios_from_peaks(n, n[th.k_rot]),),
    "4-42": (
        lambda n, s: wall_tests.back_calculated_force(n[th.M_e], n[th.Delta_dd], n[th.a_g]),
    ),
    "4-43": (lambda n, s: wall_tests.harmonic_force(n[th.t], n[th.M_e], n[th.Z]),),
    "5-1": (lambda n, s: identification.stiffness_from_period(n[th.m_e], n[th.T_fixed]),),
    "5-2": (
        lambda n, s: identification.rotation_from_displacement(
            *(n[x] / 1e3 for x in (th.Delta, th.B_measured, th.H_measured))
        ),
    ),
    "5-3": (
        lambda n, s: formulas.gravitational_energy(
            n[th.theta], mass=n[th.m_e], radius=n[th.R_e], alpha=n[th.alpha_e], gravity=n[th.g]
        ) + formulas.gravitational_energy(
            n[th.theta], mass=n[th.m_b], radius=n[th.R_b], alpha=n[th.alpha_b], gravity=n[th.g]
        ),
    ),
    "5-4": (lambda n, s: lumped_mass_ratios_from_peaks(n),),
    "5-5": (lambda n, s: 1e3 * identification.rotation_centre(n[th.Delta] / 1e3),),
    "5-6": (
        lambda n, s: identification.rotation_about_moving_centre(
            *(n[x] / 1e3 for x in (th.Delta, th.x_centre, th.H_measured))
        ),
    ),
    "5-7": (lambda n, s: formulas.damping_from_decrement(n[th.Delta_i], n[th.Delta_next]),),
    "5-14": (
        lambda n, s: formulas.energy_ratio_of_lumped_mass(
            mass=n[th.m_e], height=n[th.H_e], inertia=n[th.I_eg], base_mass=n[th.m_b],
            base_height=n[th.H_b], base_inertia=n[th.I_bg], half_width=n[th.B],
        ),
    ),
    "5-36": (lambda n, s: identification.viscous_coefficient(0.03, n[th.m_e], n[th.k]),),
}  # fmt: skip
"""The functions of an equation, of the values of its symbols and the sign of theta."""

CHAIN = {"3-3": 2, "5-4": 2}
"""Which relation of a chain is the one in known symbols; elsewhere the first."""

ELSEWHERE = {
    "3-5",  # a sum of vectors; 3-6 and 3-7 are its components
    "4-8",  # numbers of a fit, which is made again
    "4-1", "4-2", "4-3", "4-4", "4-27", "4-28",  # compared in test_chapter_4
    "4-5", "4-31", "4-36", "4-38",  # compared with the function inside the equation's own check
}  # fmt: skip
"""Cited by a function, but not compared here."""


@pytest.mark.parametrize("number", FUNCTIONS)
def test_function_agrees_with_the_equation(number):
    for side in EQUATIONS[number].sides:
        n = random_values(side, number)
        expr = EQUATIONS[number].right[CHAIN.get(number, 0)].rhs
        arguments = sorted(expr.free_symbols, key=str)
        expected = sp.lambdify(arguments, expr, "numpy")(*(n[x] for x in arguments))
        for function in FUNCTIONS[number]:
            assert np.asarray(function(n, side)) == pytest.approx(expected, rel=1e-10, abs=1e-12)


def cited(text: str) -> set[str]:
    """Numbers of equations in the first sentence of a docstring; "3-5 to 3-7" are three."""
    summary = text.partition("\n")[0]
    found = set(re.findall(r"(?<!Table )(?<!Figure )\b[2-5]-\d+[a-z]?\b", summary))
    for chapter, first, last in re.findall(r"\b([2-5])-(\d+) to \1-(\d+)\b", summary):
        found |= {f"{chapter}-{i}" for i in range(int(first), int(last) + 1)}
    return found


def test_every_function_that_cites_an_equation_is_compared_with_it():
    numbers = set()
    for home in (design, dynamics, formulas, identification, wall_tests):
        for thing in map(vars(home).get, dir(home)):
            if callable(thing) and not isinstance(thing, type):
                numbers |= cited(thing.__doc__ or "")
    assert numbers & set(EQUATIONS) - ELSEWHERE <= set(FUNCTIONS)
