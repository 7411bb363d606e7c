"""Checks of 4-27 to 4-31, 4-39 and 4-41 to 4-43: the equivalent oscillator of the wall."""

import math
from collections.abc import Callable, Iterable

import numpy as np
import sympy as sp
from scipy.integrate import solve_ivp
from sympy import cos, sin

from rockeom.analysis.formulas.controlled_wall import Wall, peak_sequence
from rockeom.thesis import notation as th
from rockeom.thesis.catalogue import EQUATIONS
from rockeom.thesis.checks import check, wall
from rockeom.thesis.checks.chapter_4_free_vibration import restoring_force
from rockeom.thesis.checks.check import Finding, Findings, close, derived, reproduced, vanishes
from rockeom.thesis.equation import BOTH, Equation
from rockeom.thesis.wall_tests import back_calculated_force, energy_ratio_4_31, harmonic_force

# --- 4-27 to 4-30: the equation of motion and its forces


def _oscillator(equation: Equation, relation: sp.Eq) -> Findings:
    """Check Lagrange's equation of the mass with the power of the other two forces."""
    path, V = sp.Function("Delta")(th.t), sp.Function("V")
    lagrangian = th.M_e * path.diff(th.t) ** 2 / 2 - V(path)
    left = lagrangian.diff(path.diff(th.t)).diff(th.t) - lagrangian.diff(path)
    left = left.subs({V(path).diff(path): th.F_k, path.diff(th.t, 2): th.Delta_dd})
    rest = left - (th.P_e - th.F_damp) - (relation.lhs - relation.rhs)
    yield vanishes("Lagrange's equation minus thesis", rest, sp.simplify)


def _passage(equation: Equation, relation: sp.Eq) -> Findings:
    """M_e v dv/dx = -F_Damp on the left of 4-27: separable, with ln(v) = -int F/(M_e v**2) dx."""
    (motion,) = EQUATIONS["4-27"].right
    force = sp.solve(motion.lhs.subs({th.F_k: 0, th.F_damp: relation.rhs}), th.Delta_dd)[0]
    w = sp.Dummy("w", positive=True)
    for direction in BOTH:
        slope = sp.simplify((force / th.Delta_d**2).subs(th.Delta_d, direction * w))
        growth = direction * sp.integrate(slope, (th.Delta, -sp.oo, sp.oo))
        what = f"ratio of the velocities of a passage to {'+-'[direction < 0]}Delta minus sqrt(r)"
        yield vanishes(what, sp.exp(growth) - sp.sqrt(th.r), sp.simplify)


def _peaks_of_constant_r(equation: Equation, *relations: sp.Eq) -> Findings:
    """Compare the peaks of 4-27, integrated with the force, with their closed form."""
    force = relations[0].rhs
    reference = peak_sequence(
        Wall.thesis().restoring_force, 0.025, 0.852, float(wall.PENALTY) / 1e3, 3
    )
    computed = peaks_of_oscillator(force, lambda speed: 0.852, 25.0, 3)
    for i, (a, b) in enumerate(zip(computed[1:], np.abs(reference[1:]) * 1e3, strict=False), 1):
        yield close(f"peak {i} in mm after 25 mm, r = 0.852", a, b, 1e-3)


def peaks_of_oscillator(
    force: sp.Expr, ratio: Callable[[float], float], start: float, passages: int, stiffer: float = 1
) -> list[float]:
    """Absolute peaks [mm] of 4-27 with a damping force as 4-28; r depends on the speed.

    Integrated over Delta, with the kinetic energy as the unknown.
    """
    elastic, mass = restoring_force(), float(wall.MASS)
    # F_Damp/M_e [m/s2] of r, Delta [mm], velocity [m/s]; the width n is in metres in it
    expression = (
        force.subs(th.M_e, 1).subs(th.Delta, th.Delta / 1000).subs(th.n, wall.PENALTY / 1000)
    )
    damping = sp.lambdify((th.r, th.Delta, th.Delta_d), expression, "math")
    computed = [start]
    for _ in range(passages):

        def growth(place, energy):
            speed = math.sqrt(max(2 * energy[0] / mass, 0.0))
            pull = stiffer * math.copysign(elastic(abs(place)), place)
            return (-pull - mass / 1e3 * damping(ratio(max(speed, 1e-9)), place, speed),)

        def rest(place, energy):
            return energy[0]

        rest.terminal, rest.direction = True, -1  # type: ignore[attr-defined]
        first = -computed[-1] * (1 - 1e-6)
        energy = stiffer * elastic(computed[-1]) * 1e-6 * computed[-1]
        run = solve_ivp(
            growth,
            (first, 2 * computed[-1]),
            [energy],
            events=rest,
            rtol=1e-7,
            atol=1e-8,
            max_step=computed[-1] / 20,
        )
        if not len(run.t_events[0]):
            break
        computed.append(float(run.t_events[0][0]))
    return computed


def _push(equation: Equation, relation: sp.Eq) -> Findings:
    """Check 4-29 by the moments of weight, tendon and push in equilibrium about a fixed O."""
    lever, load, pull, turn = sp.symbols("b mg P dtheta", positive=True)
    angle = sp.Symbol("theta", positive=True)
    right_move, up_move = (e.subs(th.theta, angle) for e in wall.turned(1, lever))
    mouth = (-lever + right_move, up_move)
    chord = 2 * lever * sin(angle / 2)
    tendon = pull * (mouth[1] * right_move - mouth[0] * up_move) / chord
    centroid = -lever * cos(angle) + th.H_c * sin(angle)
    push = (tendon - load * centroid) / (th.H * cos(angle))
    rise = wall.turned(1, lever, th.H_c)[1].subs(th.theta, angle)
    put = {
        th.F_k: push,
        th.dDelta: sp.diff(th.H * sin(angle), angle) * turn,
        th.dU: load * sp.diff(rise, angle) * turn,
        th.dU_E: pull * sp.diff(chord, angle) * turn,
    }
    rest = (relation.lhs - relation.rhs).subs(put)
    half = sp.expand(sp.expand_trig(rest.subs(angle, 2 * sp.Symbol("half", positive=True))))
    yield vanishes("thesis with the force by moments", half, sp.simplify)


def _gradient(equation: Equation, relation: sp.Eq) -> Findings:
    (work,) = EQUATIONS["4-29"].right
    (force,) = sp.solve(work.lhs - work.rhs, th.F_k)
    names = {th.dU: sp.Function("U"), th.dU_E: sp.Function("U_E")}
    put = {dU: f(th.Delta).diff(th.Delta) * th.dDelta for dU, f in names.items()}
    yield vanishes("thesis minus 4-29 by dDelta", relation.rhs - force.subs(put), sp.simplify)
    size = sp.Symbol("size", positive=True)
    elastic = (wall.right("4-16") ** 2 - wall.FORCE**2) / (2 * wall.STIFFNESS)
    energies = {sp.Function("U"): wall.right("4-18") / 1000, sp.Function("U_E"): elastic}
    whole = relation.rhs
    for function, energy in energies.items():
        whole = whole.replace(function, lambda _, energy=energy: energy)
    stated = sp.lambdify(size, whole.subs(th.Delta, size).doit().subs(wall.WALL), "numpy")
    at = np.linspace(0.01, 30, 3000)
    values = stated(at)
    top = int(values[:1000].argmax())
    bottom = top + int(values[top:].argmin())
    for what, i, place, kilonewton in (("top", top, 4.55, 25.01), ("dip", bottom, 9.23, 19.48)):
        yield close(f"place of its {what} in mm", at[i], place, 0.02)
        yield close(f"its {what} in kN", values[i], kilonewton, 0.01)
    gone = np.abs(values * 1e3 / Wall.thesis().restoring_force(at / 1e3) - 1).max()
    yield close("against rockeom.analysis", float(gone), 0, 1e-9)


# --- 4-31: energy ratio by bands of the speed


def _one_band_for_each_speed(bands: sp.Piecewise, jumps: Iterable[float]) -> Findings:
    """Check that the bands meet at the stated speeds and do not overlap."""
    inside = [sp.lambdify(th.Delta_d, condition, "math") for _, condition in bands.args]
    for band, speed in enumerate(jumps):
        for beside, wanted in ((speed - 1e-4, band), (speed + 1e-4, band + 1)):
            computed = [i for i, holds in enumerate(inside) if holds(beside)]
            what = f"bands at {beside:.4f} m/s, counted from 0: {computed}, and that of the text"
            yield Finding(what, wanted, computed == [wanted])


def bands(function: Callable, jumps: dict[float, float]) -> Callable:
    """Check a fit of r by bands of the speed: its values, and the jumps that the text states."""

    def find(equation: Equation, relation: sp.Eq) -> Findings:
        yield from _one_band_for_each_speed(relation.rhs, jumps)
        stated = sp.lambdify(th.Delta_d, relation.rhs, "math")
        ends = [speed + aside for speed in jumps for aside in (-1e-6, 1e-6)]
        for speed in (0.05, 0.2, 0.4, 0.6, 0.87, *ends):
            for way in BOTH:
                computed = stated(way * speed)
                yield close(f"r at {way * speed} m/s", computed, float(function(speed)), 1e-12)
                yield Finding("an impact that loses energy", computed, 0 < computed < 1)
        for speed, jump in jumps.items():
            rise = stated(speed + 1e-9) - stated(speed - 1e-9)
            yield close(f"jump at {speed} m/s", rise, jump, 1e-6)

    return find


def _simulated_decay(equation: Equation, *relations: sp.Eq) -> Findings:
    """Compare 4-27 with F_k 6 % larger, as in Figure 4-37, with the peaks of Table A-1."""
    stated = sp.lambdify(th.Delta_d, relations[0].rhs, "math")
    computed = peaks_of_oscillator(wall.right("4-28"), stated, wall.FALL, 13, stiffer=1.06)
    reference = wall.sizes_of_peaks()[: len(computed)]
    rms = float(np.sqrt(np.mean((np.array(computed) - reference) ** 2)))
    yield Finding("rms error of 13 peaks in mm, below 1.5", rms, len(computed) == 14 and rms < 1.5)


# --- 4-39, 4-41 to 4-43: base excitation


def _driving_force(equation: Equation, relation: sp.Eq) -> Findings:
    """Check the work of -m a_g at the centroid for a change of Delta, upright, with M_e as m."""
    lever = sp.Dummy("b", positive=True)
    moved = wall.turned(1, lever, th.H_c)[0]
    per_delta = sp.diff(moved, th.theta) / sp.diff(th.H * sin(th.theta), th.theta)
    exact = -th.M_e * th.a_g * per_delta.subs(th.theta, 0)
    rest = relation.rhs * th.H_c / th.H - exact
    yield vanishes("thesis times H_c/H minus the generalised force", rest, sp.simplify)
    size = float((relation.rhs / exact - 1).subs(wall.WALL))
    yield close("excess of the thesis", size, 0.122, 5e-4)


def _newton(equation: Equation, relation: sp.Eq) -> Findings:
    """Check Newton's second law with the total acceleration."""
    rest = th.M_e * (th.Delta_dd + th.a_g) + th.F_k + th.F_D - (relation.lhs - relation.rhs)
    yield vanishes("Newton's equation minus thesis", rest, sp.expand)
    (motion,) = EQUATIONS["4-27"].right
    put = {th.F_damp: th.F_D, th.P_e: wall.right("4-39")}
    rest = (motion.lhs - motion.rhs).subs(put) - (relation.lhs - relation.rhs)
    yield vanishes("4-27 with 4-39 minus thesis", rest, sp.expand)


def _at_rest(equation: Equation, *relations: sp.Eq) -> Findings:
    (motion,) = EQUATIONS["4-41"].right
    (force,) = sp.solve((motion.lhs - motion.rhs).subs(th.F_D, 0), th.F_k)
    yield vanishes("4-41 without damping minus thesis", force - relations[0].rhs, sp.expand)
    stated = relations[0].rhs.subs({th.M_e: 2016, th.Delta_dd: -12, th.a_g: 3})
    reference = float(back_calculated_force(2016, -12, 3))
    yield close("against rockeom.analysis", float(stated), reference, 1e-9)


def _harmonic(equation: Equation, relation: sp.Eq) -> Findings:
    (motion,) = EQUATIONS["4-27"].right
    ground = th.Z * sin(2 * sp.pi * 8 * th.t)
    rest = (motion.lhs - motion.rhs).subs(th.P_e, wall.right("4-39").subs(th.a_g, ground))
    yield vanishes(
        "4-27 with 4-39 at 8 Hz minus thesis", sp.expand(rest - relation.lhs + relation.rhs)
    )
    stated = relation.rhs.subs({th.M_e: 2016, th.Z: 6, th.t: 0.013})
    yield close(
        "against rockeom.analysis", float(stated), float(harmonic_force(0.013, 2016, 6)), 1e-9
    )


# --- the checks of each equation

CHECKS: check.Checks = {
    "4-27": derived("Lagrange's equation", _oscillator),
    "4-28": (
        derived("the velocity after one passage, in 4-27", _passage),
        reproduced("peaks of the oscillator in closed form", _peaks_of_constant_r),
    ),
    "4-29": derived("moments about O", _push),
    "4-30": derived("4-29", _gradient),
    "4-31": (
        check.transcribed(
            "bands of the speed and their jumps",
            bands(energy_ratio_4_31, {0.3: -0.04 - 0.3 / 45, 0.47: 0.042, 0.78: 0.098}),
        ),
        reproduced("peaks of Table A-1, as in Figure 4-37", _simulated_decay),
    ),
    "4-39": derived(
        "work of the inertia at the centroid",
        _driving_force,
        "no order: too large by H/H_c - 1 = 12 % where M_e is the mass",
    ),
    "4-41": derived("Newton's law for the whole acceleration", _newton),
    "4-42": derived("4-41 without velocity", _at_rest),
    "4-43": derived("4-27 with 4-39", _harmonic),
}
