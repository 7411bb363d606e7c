"""Derived equations for people: LaTeX and Markdown, as one would write them in a paper."""

from __future__ import annotations

import re
import unicodedata
from dataclasses import dataclass

import sympy as sp

from rockeom.symbolic.algebra import SIDE
from rockeom.symbolic.contact import reactions, total_reaction
from rockeom.symbolic.model import GROUND_X, GROUND_Y, Phase, RockingModel, Transition
from rockeom.symbolic.notation import AFTER, BEFORE, Notation, at_impact, broken, width
from rockeom.symbolic.polar import has_polar_form, in_polar_form, polar_model, polar_parameters
from rockeom.symbolic.statics import LOAD, pushover

LINE = 62.0
"""Width of a line of mathematics on the page, in letters."""
SHORT = 1.6 * LINE


# --- equations of motion


def equation_lines(phase: Phase, form: str = "width") -> list[str]:
    """One line of LaTeX an equation of motion, in the order of the phase's coordinates.

    Left: accelerations, velocities, damping, gravity, stiffness; right: excitation, horizontal
    then vertical. `form` is "width" (B, H) or "polar" (R, alpha).
    Raises ValueError if `form` is neither or the phase has no polar form.
    """
    if form not in ("width", "polar"):
        raise ValueError(f'form must be "width" or "polar", not {form!r}')
    equations = in_polar_form(phase) if form == "polar" else phase.equations
    notation = Notation(phase)
    lines = []
    for i in range(len(phase.coordinates)):
        row = [
            equations.mass_matrix[i, j] * c.acceleration for j, c in enumerate(phase.coordinates)
        ]
        row += [equations.velocity[i], equations.damping[i]]
        statics = [equations.gravity[i], equations.stiffness[i]]
        together = notation.terms(sum(statics))
        # one sum where weight and spring cancel in part, as at a settled position
        apart = [t for part in statics for t in notation.terms(part)]
        row += [sum(statics)] if len(together) < len(apart) else statics
        left = notation.sum([notation.write(part) for part in row if part != 0])
        lines.append(f"{left} = {notation.write(equations.excitation[i])}")
    return lines


def equations_latex(phase: Phase, form: str = "width") -> str:
    """The equations of motion as an `aligned` block, one line each; "" without coordinates."""
    lines = [line.replace(" = ", " &= ") for line in equation_lines(phase, form)]
    return "\n".join([r"\begin{aligned}", " \\\\\n".join(lines), r"\end{aligned}"]) if lines else ""


# --- content of a document
# Text holds mathematics between $ and code between `, in both forms of document.


@dataclass(frozen=True)
class Heading:
    level: int
    text: str


@dataclass(frozen=True)
class Table:
    header: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]


@dataclass(frozen=True)
class Display:
    lines: tuple[str, ...]


Block = Heading | Table | Display | str


def content(model: RockingModel, form: str) -> list[Block]:
    """Everything that was derived of a structure; in width form where there is no polar one."""
    if form not in ("width", "polar"):
        raise ValueError(f'form must be "width" or "polar", not {form!r}')
    polar = form == "polar" and any(has_polar_form(phase) for phase in model.phases)
    shown = polar_model(model) if polar else model
    blocks: list[Block] = [Heading(1, model.title)]
    if model.reference:
        blocks.append(f"Reference: {model.reference}.")
    blocks += _symbols(model, shown, polar)
    for phase, original in zip(shown.phases, model.phases, strict=True):
        blocks += _phase(model, phase, original, "polar" if polar and phase.polar else "width")
    blocks += _transitions(shown)
    blocks += _pushover(shown)
    return blocks
