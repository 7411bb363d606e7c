"""Derived equations as a person reads them: what the LaTeX says, and that it can be typeset."""

import ast
import dataclasses
import math
import re
import shutil
import subprocess
from functools import cache
from pathlib import Path

import numpy as np
import pytest
import sympy as sp
from hypothesis import given, strategies as st
from sympy.core.function import AppliedUndef

from rockeom.symbolic import SHIPPED, derive
from rockeom.symbolic.algebra import SIDE
from rockeom.symbolic.impulse import AFTER, BEFORE, at_impact
from rockeom.symbolic.model import GROUND_X, GROUND_Y
from rockeom.symbolic.reactions import total_reaction
from rockeom.symbolic.statics import pushover
from rockeom.symbolic.text.page import LINE, Display, broken, to_latex, to_markdown, to_text, width
from rockeom.symbolic.write.notation import Notation
from rockeom.symbolic.write.polar import has_polar_form, in_polar_form, polar_mode, polar_model
from rockeom.symbolic.write.typeset import (
    content,
    equation_lines,
    equations_latex,
    latex_document,
    markdown_page,
)
from tests.evaluation import Values
from tests.refusals import refused
from tests.shipped import PINNED

ROOT = Path(__file__).resolve().parents[2]

POLAR = ["rigid_block", "lumped_mass_structure", "flexible_structure"]
# (structure, form) of every document that differs from the others
DOCUMENTS = [(n, "width") for n in SHIPPED] + [(n, "polar") for n in POLAR]
BY_MODES = [(n, form) for n, form in DOCUMENTS if n in PINNED]


@cache
def structure(name):
    return derive(name).hybrid


@cache
def said(name, form):
    return content(structure(name), form)


@cache
def article(name, form):
    return to_latex(said(name, form))


def values_of(mode, seed=0) -> dict[sp.Symbol, float]:
    """A random state and random parameters, R and alpha in accord with B and H."""
    rng = np.random.default_rng(seed)
    used = {SIDE, GROUND_X, GROUND_Y}
    for c in mode.coordinates:
        used |= {c.position, c.velocity, c.acceleration}
    for body in mode.bodies:
        used |= {x for e in (body.mass, body.inertia, *body.position) for x in e.free_symbols}
    used |= mode.stored_energy.free_symbols | mode.dissipation_function.free_symbols
    used |= mode.gravity.free_symbols | sp.Tuple(*mode.forces).free_symbols
    residual = mode.equations.residual
    for law in residual.atoms(AppliedUndef) | mode.stored_energy.atoms(AppliedUndef):
        used |= {law, law.diff(*law.args), law.diff(*law.args, 2)}
        used |= law.free_symbols
    used |= sp.Tuple(*(mode.load_point or ())).free_symbols
    values = {x: rng.uniform(0.2, 1.2) for x in sorted(used, key=str)}
    values[SIDE] = rng.choice([-1.0, 1.0])
    for body in mode.bodies:
        if body.polar:
            b, h, radius, alpha = body.polar
            if b in values:
                values[radius] = math.hypot(values[b], values[h])
                values[alpha] = math.atan2(values[b], values[h])
    return values


FUNCTIONS = {
    rf"\{n}": getattr(math, n) for n in ("sin", "cos", "tan", "tanh", "cosh", "log", "sqrt")
}
NUMBERS = {"e": math.e, r"\pi": math.pi}


class Reader:
    """Evaluates the LaTeX of an expression: what a person would compute from the page."""

    def __init__(self, notation: Notation, values: dict[sp.Symbol, float]) -> None:
        self.values = NUMBERS | {notation.plain(x): v for x, v in values.items()}
        names = sorted(map(re.escape, self.values), key=len, reverse=True)
        skipped = r"(?P<skip>\s+|\\thinspace|\\left(?![a-z])|\\right(?![a-z])|\\bigl|\\bigr)"
        known = "|".join(rf"{n}(?![A-Za-z_])" for n in names)
        self.token = re.compile(rf"{skipped}|({known}|\\[a-z]+|\d+|[-+=/^{{}}()\[\]])")

    def __call__(self, tex: str) -> float:
        self.tokens, at = [], 0
        while at < len(tex):
            match = self.token.match(tex, at)
            assert match, f"cannot read {tex[at:]!r} in {tex!r}"
            self.tokens += [] if match["skip"] else [match[0]]
            at = match.end()
        value = self.sum()
        assert not self.tokens, f"left over: {self.tokens} in {tex!r}"
        return value

    def next(self, *wanted: str) -> str | None:
        return self.tokens.pop(0) if self.tokens and self.tokens[0] in wanted else None

    def sum(self) -> float:
        total = -self.product() if self.next("-") else self.product()
        while sign := self.next("+", "-"):
            total += self.product() if sign == "+" else -self.product()
        return total

    def product(self) -> float:
        value = self.power()
        while self.tokens and self.tokens[0] not in "+-=)]}":
            value = value / self.power() if self.next("/") else value * self.power()
        return value

    def power(self) -> float:
        value = self.atom()
        return value ** self.atom() if self.next("^") else value

    def atom(self) -> float:
        token = self.tokens.pop(0)
        if token in "([{":
            value = self.sum()
            assert self.tokens.pop(0) == {"(": ")", "[": "]", "{": "}"}[token]
            return value
        if token in (r"\frac", r"\tfrac"):
            return self.atom() / self.atom()
        if token in FUNCTIONS:
            exponent = self.atom() if self.next("^") else 1
            return FUNCTIONS[token](self.atom()) ** exponent
        return self.values[token] if token in self.values else float(token)


def modes(name):
    """(mode, form) of every way to show a structure."""
    for mode in structure(name).modes:
        yield mode, "width"
        if has_polar_form(mode):
            yield mode, "polar"


# --- what the page says


@pytest.mark.parametrize("name", SHIPPED)
def test_reading_the_typeset_equations_gives_the_residual_of_the_derived_ones(name):
    for mode, form in modes(name):
        if not mode.coordinates:
            continue
        values = values_of(mode)
        exact = Values(values)
        residual = [exact[e] for e in mode.equations.residual]
        shown = polar_mode(mode) if form == "polar" else mode
        read = Reader(Notation(shown), values)
        for line, expected in zip(equation_lines(mode, form), residual, strict=True):
            left, right = line.split(" = ")
            scale = abs(read(left)) + abs(read(right))
            assert read(left) - read(right) == pytest.approx(expected, abs=1e-12 * scale)


@pytest.mark.parametrize(("name", "form"), DOCUMENTS)
def test_reading_typeset_energies_reactions_and_velocity_ratio_gives_the_derived_ones(name, form):
    original = structure(name)
    model = polar_model(original) if form == "polar" else original
    for mode, plain in zip(model.modes, original.modes, strict=True):
        notation, values = Notation(mode, model), values_of(plain, 1)
        read = Reader(notation, values)
        equations, exact = mode.equations, plain.equations
        pairs = [
            (notation.write(equations.kinetic_energy), exact.kinetic_energy),
            (notation.write(equations.gravitational_energy), exact.gravitational_energy),
            (notation.plain(equations.elastic_energy), exact.elastic_energy),
            (notation.plain(mode.dissipation_function), plain.dissipation_function),
        ]
        shown, expected = total_reaction(mode), total_reaction(plain)
        pairs += [(notation.write(a), b) for a, b in zip(shown, expected, strict=True)]
        for tex, expr in pairs:
            assert read(tex) == pytest.approx(Values(values)[expr], rel=1e-12, abs=1e-12)
    if model.velocity_ratio not in (None, sp.nan) and original.rigid_velocity_ratio is None:
        first = original.modes[0]
        values = values_of(first, 2)
        tex = Notation(model.modes[0], model).quotient(model.velocity_ratio)
        exact = Values(values)[original.velocity_ratio]
        assert Reader(Notation(model.modes[0], model), values)(tex) == pytest.approx(exact)


@pytest.mark.parametrize(
    ("name", "form"),
    [
        d
        for d in BY_MODES
        if not d[0].startswith(("two_spring", "dirac_delta")) and "wall" not in d[0]
    ],
)
def test_reading_typeset_impact_maps_gives_the_derived_velocities(name, form):
    model = structure(name)
    first = model.mode("left")
    values = values_of(first, 3) | {model.rotation.position: 0.0, SIDE: -1.0}
    before = {at_impact(c, BEFORE): values[c.velocity] for c in model.coordinates}
    rotation = str(at_impact(model.rotation, AFTER))

    @cache
    def after(target):
        """(coordinate, velocity after the impact), by elimination in numbers."""
        derived, known = model.impulse_map("left", target), Values(values)
        mass_matrix = np.array([known[e] for e in derived.mass_matrix])
        solved = np.linalg.solve(
            mass_matrix.reshape(derived.mass_matrix.shape), [known[e] for e in derived.momentum]
        )
        return list(zip(derived.coordinates, solved.tolist(), strict=True))

    read = 0
    for block in said(name, form):
        for line in block.lines if isinstance(block, Display) else ():
            if "^{+}" not in line:
                continue
            target = "right" if any(rotation in each for each in block.lines) else "both"
            known = values | before | {at_impact(c, AFTER): v for c, v in after(target)}
            reader = Reader(Notation(model.mode(target), model), known)
            left, right = map(reader, line.split(" = "))
            assert left == pytest.approx(right, rel=1e-12)
            read += 1
    assert read >= len(model.coordinates)


@pytest.mark.parametrize(("name", "form"), [d for d in BY_MODES if not d[0].startswith("flexible")])
def test_reading_typeset_pushover_gives_the_derived_force(name, form):
    model = structure(name)
    blocks = said(name, form)
    found = [
        (blocks[i - 1], block.lines[0].removeprefix("P = "))
        for i, block in enumerate(blocks)
        if isinstance(block, Display) and block.lines[0].startswith("P = ")
    ]
    assert found
    for title, tex in found:
        mode = re.fullmatch("In `(.*)`:", title)[1]
        values = values_of(model.mode(mode), 4)
        force = Values(values)[pushover(model, mode)]
        read = Reader(Notation(model.modes[0], model), values_of(model.modes[0], 5) | values)
        assert read(tex) == pytest.approx(force, rel=1e-12)


def part_of(equations, what):
    """A physical part of equations by its name on a page."""
    if what == "inertia":
        return equations.mass_matrix * equations.accelerations
    first, *more = (getattr(equations, f"{x.split()[0]}_forces") for x in what.split(" and "))
    return sum(more, first)


@pytest.mark.parametrize(("name", "form"), DOCUMENTS)
def test_each_part_of_an_equation_of_motion_is_what_its_name_says(name, form):
    """And the rows of a page lose nothing of it."""
    model = structure(name)
    if model.search is not None:
        return
    modes = [m for m in (polar_model(model) if form == "polar" else model).modes if m.coordinates]
    shown = [b for b in said(name, form) if isinstance(b, Display) and b.parts]
    for mode, display in zip(modes, shown, strict=True):
        values = values_of(next(m for m in model.modes if m.sides == mode.sides), 5)
        read, exact = Reader(Notation(mode, model), values), Values(values)
        for i, parts in enumerate(display.parts.values()):
            for part in parts:
                tex = re.sub(r"^= |^\+ | = 0$", "", part.tex)
                value = read(f"-{tex[2:]}" if tex.startswith("- ") else tex)
                assert value == pytest.approx(float(exact[part_of(mode.equations, part.what)[i]]))
    marks = r"&|\s|\\quad|\\scriptstyle\\text\{[^}]*\}|\\notag\\\\"
    rows = re.sub(marks, "", article(name, form)).replace("{-}", "-")
    assert all(line.replace(" ", "") in rows for display in shown for line in display.lines)


@pytest.mark.parametrize("name", SHIPPED)
def test_equations_of_a_page_are_numbered_from_one_on_and_in_latex_alike(name):
    page = to_markdown(said(name, "width"), numbered=True)
    numbers = [int(n) for n in re.findall(r"\\tag\{(\d+)", page)]
    assert numbers == list(range(1, len(numbers) + 1))
    assert len(numbers) == sum(len(b.lines) for b in said(name, "width") if isinstance(b, Display))
    tex = article(name, "width")
    aligned = re.findall(r"\\begin\{align\}(.*?)\\end\{align\}", tex, re.DOTALL)
    rows = sum(block.count(r"\\") + 1 - block.count(r"\notag") for block in aligned)
    assert rows == len(numbers)


def test_flexible_structure_reads_as_the_thesis_prints_it():
    """The thesis, equations 5-34 and 5-35, with vertical acceleration added."""
    rotation, deformation = equation_lines(structure("flexible_structure").mode("right"), "polar")
    left, right = rotation.split(" = ")
    assert left == (
        r"(m_e R_e^2 + m_e u^2 - 2 s m_e u R_e \sin\alpha_e + I_{eg} + m_b R_b^2 + I_{bg})"
        r" \ddot{\theta} + m_e R_e \cos\alpha_e \thinspace \ddot{u}"
        r" + 2 m_e (u - s R_e \sin\alpha_e) \dot{\theta} \dot{u}"
        r" + s m_e g [R_e \sin(\alpha_e - s \theta) - s u \cos\theta]"
        r" + s m_b g R_b \sin(\alpha_b - s \theta)"
    )
    assert right.startswith(
        r"-m_e \ddot x_g [R_e \cos(\alpha_e - s \theta) - u \sin\theta]"
        r" - m_b \ddot x_g R_b \cos(\alpha_b - s \theta)"
    )
    assert deformation == (
        r"m_e R_e \cos\alpha_e \thinspace \ddot{\theta} + m_e \ddot{u}"
        r" + m_e (s R_e \sin\alpha_e - u) \dot{\theta}^2 + c \dot{u} - m_e g \sin\theta + k u"
        r" = -m_e \ddot x_g \cos\theta + m_e \ddot y_g \sin\theta"
    )


@pytest.mark.parametrize("name", SHIPPED)
def test_one_line_an_equation_of_motion(name):
    for mode, form in modes(name):
        tex = equations_latex(mode, form)
        assert tex.count(" &= ") == len(mode.coordinates)
        assert tex.count(r"\\") == max(len(mode.coordinates) - 1, 0)


# --- the form in R and alpha


@pytest.mark.parametrize("name", POLAR)
def test_polar_form_is_the_width_form(name):
    mode = structure(name).modes[0]
    polar = in_polar_form(mode)
    geometry = {b.polar[0] for b in mode.bodies} | {b.polar[1] for b in mode.bodies}
    back = {}
    for body in mode.bodies:
        b, h, radius, alpha = body.polar
        back |= {sp.sin(alpha): b / radius, sp.cos(alpha): h / radius}
    for field in dataclasses.fields(polar):
        shown = sp.Matrix([getattr(polar, field.name)])
        exact = sp.Matrix([getattr(mode.equations, field.name)])
        assert not shown.free_symbols & geometry
        for side in (-1, 1):
            for a, b in zip(shown.subs(SIDE, side), exact.subs(SIDE, side), strict=True):
                difference = sp.expand_trig(a).subs(back) - b
                for body in mode.bodies:
                    width, height, radius, _ = body.polar
                    difference = difference.subs(radius, sp.sqrt(width**2 + height**2))
                assert sp.simplify(difference) == 0


def test_structure_without_radius_and_angle_has_no_polar_form():
    mode = structure("two_spring_structure").mode("both")
    with pytest.raises(ValueError, match=r'no polar form of mode both.*form="width"'):
        equations_latex(mode, "polar")


def test_document_of_a_structure_without_polar_form_is_in_width_form():
    assert latex_document(structure("two_spring_cart"), "polar") == article(
        "two_spring_cart", "width"
    )


def test_unknown_form_is_refused_by_name():
    model = structure("rigid_block")
    assert refused(latex_document, model, "cartesian") == ("form", "cartesian")
    assert refused(equations_latex, model.modes[0], "cartesian") == ("form", "cartesian")


# --- line breaks


@given(st.integers(0, 10_000), st.floats(15, 70))
def test_broken_lines_lose_nothing_and_are_no_wider_than_asked(seed, limit):
    rng = np.random.default_rng(seed)
    words = [r"m_e g", r"\ddot{\theta}", r"(a + b) c", r"\frac{a + b}{c}", r"\sin\theta", "[x - y]"]
    tex = "".join(f"{rng.choice([' + ', ' - '])}{rng.choice(words)}" for _ in range(30))[3:]
    lines = broken(tex, limit)
    assert " ".join(lines) == tex
    assert max(map(width, lines)) <= limit


# --- documents


@pytest.mark.parametrize(("name", "form"), DOCUMENTS)
def test_document_has_balanced_braces_and_names_every_symbol(name, form):
    model, tex = structure(name), article(name, form)
    bare = re.sub(r"\\[{}]", "", tex)
    assert bare.count("{") == bare.count("}")
    assert len(re.findall(r"\\left(?![a-z])", tex)) == len(re.findall(r"\\right(?![a-z])", tex))
    for entry in (*model.parameters, *model.definitions, *model.coordinates):
        assert entry.name.replace("_", r"\_") + "} & " in tex


def compiled(tex: str, folder: Path) -> str:
    """The log of pdflatex, which must succeed."""
    (folder / "page.tex").write_text(tex, encoding="utf-8")
    command = ["pdflatex", "-interaction=nonstopmode", "-halt-on-error", "page.tex"]
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True, errors="replace")
    assert done.returncode == 0, done.stdout[-2000:]
    return done.stdout


latex_installed = pytest.mark.skipif(not shutil.which("pdflatex"), reason="no pdflatex on PATH")


@latex_installed
@pytest.mark.parametrize(("name", "form"), DOCUMENTS)
def test_document_compiles_and_nothing_runs_off_the_page(tmp_path, name, form):
    assert "Overfull" not in compiled(article(name, form), tmp_path)


STRANGE = r"50 % of {a_b} & #1 \ ~ ^ < > for θ and Ω at ½ $"


@pytest.mark.parametrize(("name", "form"), DOCUMENTS)
def test_no_latex_is_left_in_plain_text(name, form):
    text = to_text(said(name, form), 100)
    assert not re.search(r"[\\{}$`]", text)
    assert max(len(line) for line in text.splitlines() if "/(" not in line) <= 106


def test_special_characters_in_a_users_words_are_escaped():
    tex = latex_document(dataclasses.replace(structure("rigid_block"), title=STRANGE))
    assert r"50 \% of \{a\_b\} \& \#1 \textbackslash{} " in tex
    assert r"\DeclareUnicodeCharacter{03B8}{\ensuremath{\theta}}" in tex


@latex_installed
def test_special_characters_in_a_users_words_compile(tmp_path):
    model = dataclasses.replace(structure("rigid_block"), title=STRANGE, reference=STRANGE)
    compiled(latex_document(model), tmp_path)


@pytest.mark.parametrize("name", SHIPPED)
def test_markdown_survives_the_markdown_reader(name):
    """No mark-up that a Markdown reader would take for its own inside mathematics."""
    model = structure(name)
    page = to_markdown(said(name, "width"), numbered=True)
    for block in re.findall(r"\$\$(.*?)\$\$", page, re.DOTALL):
        assert "\n\n" not in block
        assert not re.search(r"^\s*[-+*=<>#]", block, re.MULTILINE), "a list, heading or quote"
        assert not re.search(r"[})\]]_|\*|<", block), "emphasis or a tag"
        escapes = re.findall(r"\\[^A-Za-z]", block)
        assert all(e == "\\\\" for e in escapes), "an escape that Markdown eats"
        assert all(row.endswith("\\\\") for row in block.split("\n")[2:-3])
        rows = [row.split("&&")[0].split(r"\tag")[0] for row in block.split("\n")]
        assert all(width(row) < 1.3 * LINE for row in rows)
    for entry in (*model.parameters, *model.definitions, *model.coordinates):
        unit = re.sub("(?<=[a-z])2", "²", entry.unit)
        assert f" | `{entry.name}` | {unit} | {entry.meaning} |" in page
    tables = [line for line in page.splitlines() if line.startswith("|")]
    assert {line.count(" | ") for line in tables} == {3}


def test_pages_of_a_model_are_what_is_said_of_it():
    model = structure("rigid_block")
    assert markdown_page(model) == to_markdown(said("rigid_block", "width"), numbered=True)
    for form in ("width", "polar"):
        assert model.latex(form) == latex_document(model, form) == article("rigid_block", form)
    assert model.markdown() == markdown_page(model)
    assert model._repr_latex_() == f"$${equations_latex(model.modes[0])}$$"


DERIVING = (
    "model", "mode", "contacts", "modes/every", "modes/derived", "hybrid", "lagrange", "impulse",
    "reactions", "statics", "evaluate", "outputs",
)  # fmt: skip


def test_a_model_is_data_and_knows_nothing_that_writes_it_out():
    """Nor do the files that derive, not even in a function."""
    symbolic = ROOT / "rockeom" / "symbolic"
    writers = {"notation", "page", "polar", "typeset"}
    for name in DERIVING:
        tree = ast.parse((symbolic / f"{name}.py").read_text(encoding="utf-8"))
        homes = {n.module or "" for n in ast.walk(tree) if isinstance(n, ast.ImportFrom)}
        assert not writers & {home.rpartition(".")[2] for home in homes}, name
