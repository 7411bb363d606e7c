"""Statements of section 2.7 on controlled rocking: hysteresis and its equivalent damping."""

import itertools
from collections.abc import Sequence

import numpy as np

from rockeom.analysis import design, formulas
from rockeom.thesis.figures import chapter_2_design as figures
from rockeom.thesis.statements import statement as st

# --- the flag


def area_of_the_flag() -> st.Finding:
    areas = {
        kind: [figures.loop_with_dissipaters(kind, x).area for x in figures.LAMBDAS]
        for kind in figures.DISSIPATERS
    }
    ratio = max(b / a for area in areas.values() for a, b in itertools.pairwise(area))
    said = "; ".join(f"{k}: " + ", ".join(f"{a:.2f}" for a in v) for k, v in areas.items())
    return st.finding(ratio, f"{said} for lambda = {', '.join(f'{x:g}' for x in figures.LAMBDAS)}")


def residual_rotation_above_one() -> st.Finding:
    """Worst just above 1: lambda is of the design rotation, and a joint that opens counts."""
    rise = figures.moment_at_design_over_opening()
    ratios = (0.5 * (1 + rise), *figures.LAMBDAS[1:])
    residual = [figures.residual_rotation(ratio) for ratio in ratios]
    said = ", ".join(f"{x:.2f} for {ratio:.4g}" for x, ratio in zip(residual, ratios, strict=True))
    return st.finding(
        max(residual),
        f"{said}: the moment that re-centres rises by a factor of {rise:.2f} after the joint has "
        "opened, as a positive tangential stiffness makes it, and lambda must exceed that factor",
    )


# --- loops and their damping


def areas_of_the_loops() -> st.Finding:
    ratio = [rule.simulated_loop(4.0).damping / float(rule.damping(4.0))
             for rule in figures.RULES.values()]  # fmt: skip
    return st.finding(
        ratio, f"equal to {np.abs(np.array(ratio) - 1).max():.0e}, for a ductility of 4"
    )


DUCTILITIES = np.linspace(1.5, 8.0, 27)


def _damping_over_flag(rules: Sequence[design.HysteresisRule]) -> tuple[np.ndarray, np.ndarray]:
    """Least and largest damping at `DUCTILITIES` over that of the flag of Table 2-4, (n,) each."""
    flag = figures.RULES["flag"].damping(DUCTILITIES)
    ratio = np.array([rule.damping(DUCTILITIES) / flag for rule in rules])
    return ratio.min(axis=1), ratio.max(axis=1)


def bilinear_damping_over_that_of_a_flag() -> st.Finding:
    ratios = (figures.BILINEAR_HARDENING, 0.1, figures.HARDENING)
    ends = _damping_over_flag([design.BilinearRule(1.0, 1.0, ratio) for ratio in ratios])
    said = ", ".join(
        f"{low:.1f} to {high:.1f} with {x:g}" for x, low, high in zip(ratios, *ends, strict=True)
    )
    return st.ranging(np.transpose(ends), f"k_p/k_i of Table 2-4 first: {said} times the flag's")


def takeda_damping_over_that_of_a_flag() -> st.Finding:
    exponents = figures.EXPONENTS
    ends = _damping_over_flag(
        [
            design.TakedaRule(1.0, 1.0, figures.HARDENING, exponent)
            for exponent in np.linspace(*exponents, 5)
        ]
    )
    low, high = ends
    return st.ranging(
        np.transpose(ends),
        f"{low[0]:.1f} to {high[0]:.1f} times the flag's with alpha_T = {exponents[0]:g}, "
        f"{low[-1]:.1f} to {high[-1]:.1f} with {exponents[1]:g}, and k_p/k_i = "
        f"{figures.HARDENING:g}",
    )


# --- the period in 2-33


def _far_from_one(beyond: float) -> dict[str, float]:
    """Largest distance of the term of 2-33 from 1 beyond a period [s], by rule."""
    period, terms = figures.period_terms()
    return {
        name.replace("_", " "): float(np.abs(term[period >= beyond] - 1).max())
        for name, term in terms.items()
    }


def rules_near_one(beyond: str, share: str) -> st.Finding:
    """Rules whose term is within a share of one beyond a period [s]."""
    far = _far_from_one(float(beyond))
    near_one = [name for name, x in far.items() if x <= float(share)]
    said = ", ".join(f"{name} {x:.2f}" for name, x in far.items())
    return st.finding(len(near_one), f"{len(near_one)} of 6; off by up to {said}")


def period_term_of_the_flag() -> st.Finding:
    period, terms = figures.period_terms()
    flag = terms["flag"][period >= 0.5]
    return st.finding(
        [flag.min(), flag.max()], f"{flag.max():.2f} at 0.5 s to {flag.min():.2f} at 4 s"
    )


def error_without_the_period() -> st.Finding:
    far = _far_from_one(1.0)
    flag = far.pop("flag")
    worse = [name for name, x in far.items() if x >= flag]
    return st.finding(
        len(far) - len(worse),
        f"up to {flag:.2f} is dropped for a flag, as much only for {', '.join(worse)}",
    )


# --- references


def odd_factors_of_table_2_4() -> st.Finding:
    factors = formulas.damping.GRANT_FACTORS
    others = [f.d for name, f in factors.items() if name not in ("flag", "bilinear")]
    outside = not min(others) <= factors["bilinear"].d <= max(others)
    low = [name.replace("_", " ") for name, f in factors.items() if f.d < 1]
    return st.finding(int(outside), f"d below 1 have {' and '.join(low)}, and not the bilinear one")
