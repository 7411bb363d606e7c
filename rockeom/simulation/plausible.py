"""Questions about values that are allowed and hardly meant: units, masses, friction.

Each function returns the sentences of one question, none where the values are plausible.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from rockeom.simulation.recorder import SAMPLES
from rockeom.structures.units import is_dimensionless

if TYPE_CHECKING:
    from rockeom.simulation.response import Response
    from rockeom.structures.classes import Structure

SHARE_OF_UPLIFT = 0.5
"""Part of the uplift acceleration below which the unit of a motion is questioned."""
LIKE_G = 0.05, 1.5
"""Peak accelerations that are usual in g, and small in m/s2."""
ROUGHEST = 0.8
"""Friction coefficient above which that of a foot that does not slide is questioned."""


def shaking(run: Response) -> tuple[str, ...]:
    """Accelerations in g that were given for m/s2."""
    threshold, peak = _uplift_acceleration(run.structure), run.motion.peak
    stood = run.never_lifted or (run.structure.stands_on_points and not len(run.passages[0]))
    weak = LIKE_G[0] <= peak <= min(LIKE_G[1], SHARE_OF_UPLIFT * threshold)
    if not (stood and weak):
        return ()
    remedy = (
        f'{run.motion.peak:.4g} g are given by GroundMotion.from_array(values, dt, units="g")'
        if run.motion.source == "array"
        else f"{peak:.4g} g are {peak:.4g} * 9.81 = {peak * 9.81:.4g} m/s2"
    )
    return (
        f"The largest ground acceleration, {peak:.4g} m/s2, is {peak / threshold:.2g} of that "
        f"which lifts it: was it meant in g? {remedy}.",
    )


def _uplift_acceleration(structure: Structure) -> float:
    """In m/s2; 0 where it is not known."""
    if is_dimensionless(structure.module):
        return 0.0
    found = structure.uplift_acceleration
    if found is None and structure.slenderness is not None:  # a block on feet that may slide
        return float(structure.parameters()["gravity"] * math.tan(structure.slenderness))
    return found or 0.0


def default_masses(structure: Structure) -> tuple[str, ...]:
    """Names of the masses that have their default value."""
    return tuple(
        name
        for name, default in structure.defaults().items()
        if name.endswith("mass") and getattr(structure, name) == default
    )


def forces(structure: Structure) -> tuple[str, ...]:
    """Forces that are reported of a structure whose mass was not given."""
    found = default_masses(structure)
    if not found or is_dimensionless(structure.module):
        return ()
    verb = "is" if len(found) == 1 else "are"
    return (
        f"{' and '.join(found)} {verb} at the default, {structure.defaults()[found[0]]:g} kg: "
        "give the mass, or read forces, impulses and energies as those of one kilogram.",
    )


def friction(run: Response) -> tuple[str, ...]:
    """Feet that are assumed not to slide, and need more friction than most surfaces have."""
    from rockeom.structures.fixed_base import FixedBase

    module = run.structure.module
    slides = any("friction" in name for name in module.PARAMETERS)
    held = isinstance(run.structure, FixedBase)
    if run.keeps == SAMPLES or slides or held or is_dimensionless(module):
        return ()
    demands = run.friction_demands.values() or [(run.friction_demand, run.impact_friction_demand)]
    needed = max((x for pair in demands for x in pair if not math.isnan(x)), default=0.0)
    if not needed > ROUGHEST:
        return ()
    beyond = (
        f"Not sliding needed a friction coefficient of {needed:.3g}, more than the {ROUGHEST:g} of "
        "rough concrete"
        if needed < math.inf
        else "No friction coefficient would have kept it from sliding"
    )
    return (
        f"{beyond}: hold the feet, or let them slide, as rk.SlidingBlock and "
        "support=rk.Sliding(...) do.",
    )
