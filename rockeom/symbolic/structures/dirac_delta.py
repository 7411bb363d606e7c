"""A slender block whose impacts are forces: one equation through all of them (thesis 2.6).

An impact is spread over a small width n of the rotation x = theta/alpha. Where the block changes
its edge, sgn(x) becomes tanh(x/n); the loss is a force F(x, v) = delta_n(x) g(v), with Dirac's
delta as the Gaussian delta_n.
"""

from functools import cache
from itertools import pairwise

import sympy as sp

from rockeom.symbolic.algebra import SIDE
from rockeom.symbolic.mode import Mode, Transition
from rockeom.symbolic.model import Body, coordinate, parameter
from rockeom.symbolic.registry import shipped
from rockeom.symbolic.rocking import RockingModel

ROTATION = coordinate("x", "x", "-", "rotation over alpha")
ALPHA = parameter("alpha", "alpha", "rad", "angle of the line from edge to centroid")
ENERGY_RATIO = parameter(
    "r", "energy_ratio", "-", "ratio of kinetic energies after and before an impact"
)
REGULARISATION = parameter("n", "regularisation", "-", "width of an impact in x")

_SIDES = {"left": -1, "right": 1}

CORE, TAIL = 3, 20
"""In units of n: within CORE acts all but 2e-5 of the force; from TAIL on nothing of it is left,
and tanh(x/n) is +1 or -1, to the last bit of a double."""


def delta(x: sp.Expr, n: sp.Expr) -> sp.Expr:
    """The Gaussian of unit area that becomes Dirac's delta as n falls to zero (thesis 2-20)."""
    return sp.exp(-(x**2) / n**2) / (n * sp.sqrt(sp.pi))


@cache
def loss(r: sp.Expr) -> sp.Expr:
    """K of g(v) = K v**2: a passage multiplies the velocity by sqrt(r) (thesis 2-25).

    Where the force is all that acts, v dv = delta(x) g(v) dx, and a passage towards positive x
    integrates the delta to one: so does v/g, from v_0 to sqrt(r) v_0. With another power of v
    than the second K would depend on v_0.
    """
    v, v_0, k = sp.Symbol("v", positive=True), sp.Symbol("v_0", positive=True), sp.Symbol("K")
    passage = sp.integrate(v / (k * v**2), (v, v_0, sp.sqrt(r) * v_0))
    (found,) = sp.solve(sp.expand_log(passage - 1), k)
    return found


def impact_force(x: sp.Expr, v: sp.Expr, r: sp.Expr, n: sp.Expr) -> sp.Expr:
    """F of x'' - x + tanh(x/n) = F (thesis 2-28, without its minus sign, which would add energy).

    tanh(v/n) stands for sgn(v): the force opposes the motion either way.
    """
    return loss(r) * delta(x, n) * sp.tanh(v / n) * v**2


@shipped(place=4)
def dirac_delta_block() -> RockingModel:
    """The slender block in x = theta/alpha and time p t, its impacts forces (thesis 2-29).

    A slender block moves like a point mass at its centre of percussion, at the distance g/p**2
    from either edge, which is the unit of length here; time in units of 1/p and mass of m.
    Gravity is then 1 and ground accelerations are in units of g; alpha matters to shaking only.

    The energy ratio r is that of the kinetic energies after and before an impact, as in
    `EnergyRatio`. As the width n over which an impact is spread falls to zero the response becomes
    that of `SlenderBlock`, with an error in proportion to n. No velocity jumps: `impacts` is empty,
    `events` holds the passages between "left_core" and "right_core". Tolerances must be below n.

    Modes are marks on the way, at which a step ends: none leaps over the force. Only "left" and
    "right", far from the impact, are written in their shorter form.
    """
    x, v = ROTATION.position, ROTATION.velocity
    a, r, n = ALPHA.symbol, ENERGY_RATIO.symbol, REGULARISATION.symbol

    def mode(contacts: dict[str, int], height: sp.Expr, force: sp.Expr) -> Mode:
        """The slope of `height` is the place of the pivot, from -1 to 1 between the edges."""
        place = (a * x, 1 + a**2 * (height - x**2 / 2))
        return Mode(
            contacts,
            (ROTATION,),
            (Body("block", sp.Integer(1), place),),
            sp.Integer(1),
            load_point=place,
            small=(a,),
            forces=(a**2 * force,),
        )

    away = mode({"left": -1, "right": 1}, SIDE * x, sp.S.Zero)
    near = mode(
        {f"{side}_{part}": 0 for side in _SIDES for part in ("core", "tail")},
        n * sp.log(2 * sp.cosh(x / n)),  # of slope tanh(x/n)
        impact_force(x, v, r, n),
    )
    marks = []
    for side, s in _SIDES.items():
        inward = (side, f"{side}_tail", f"{side}_core")
        for (outer, inner), place in zip(pairwise(inward), (TAIL * n, CORE * n), strict=True):
            marks.append(Transition(outer, inner, "switch", s * x - place))
            marks.append(Transition(inner, outer, "switch", place - s * x))
    return RockingModel(
        name="dirac_delta_block",
        title="Slender block with Dirac-delta impacts",
        parameters=(ALPHA, ENERGY_RATIO, REGULARISATION),
        coordinates=(ROTATION,),
        modes=(away, near),
        transitions=(
            *marks,
            Transition("right_core", "left_core", "switch", x),
            Transition("left_core", "right_core", "switch", -x),
        ),
        rotation=ROTATION,
        overturning=sp.pi / (2 * a),
        reference="Prieto et al. (2004); thesis 2-17 to 2-29",
    )
