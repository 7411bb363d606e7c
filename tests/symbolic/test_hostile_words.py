"""Words of a declaration that would do something in a document: they are data, or refused."""

import re
from dataclasses import replace

import pytest
import sympy as sp

from rockeom.symbolic import Definition, InternalVariable, NamedFunction, coordinate, parameter
from rockeom.symbolic.text.page import Display, Heading, Table, to_markdown
from tests.refusals import told
from tests.symbolic.test_declarations import tower

HOSTILE = '<script>alert(1)</script>|`x` <img src=x onerror="y">'
ASTRAY = "$a\n\n<script>$ `b\n\n<script>` $<b>"
TAG = re.compile(r"<[a-zA-Z/!?]")


@pytest.mark.parametrize("text", [HOSTILE, ASTRAY])
def test_no_word_of_a_declaration_is_html_in_its_page(text):
    model = tower()
    first, *others = model.parameters
    parameters = (replace(first, meaning=text, unit=text), *others)
    page = replace(model, title=text, reference=text, parameters=parameters).markdown()
    assert "alert(1)" in page or text == ASTRAY
    assert not TAG.search(page)
    rows = [line for line in page.splitlines() if line.startswith("|") and "alert" in line]
    assert all(len(re.findall(r"(?<!\\)\|", row)) == 5 for row in rows)


def test_no_block_of_a_page_passes_a_tag():
    table = Table(("a", "b"), ((HOSTILE, f"${HOSTILE}$"),))
    assert not TAG.search(to_markdown([Heading(1, HOSTILE), table, Display((HOSTILE,)), HOSTILE]))


REFUSED = [
    r"\input{/etc/passwd}", r"\write18{x}",
    r"x\def\y{z}", r"\csname input\endcsname", "^^5cinput{x}",
    "x%", "x$", "x&y",
    "x#1", "x~y", "{x", "<b>", r"\\", r"\{", "", "1", r"\@input", "x\ny", "x" * 101,
]  # fmt: skip


@pytest.mark.parametrize("symbol", REFUSED)
def test_a_symbol_that_does_something_in_latex_is_refused(symbol):
    for declare in (
        lambda: parameter(symbol, "a", "m", "what it is"),
        lambda: coordinate(symbol, "a", "m", "what it is"),
        lambda: Definition(sp.Symbol(symbol), "a", "m", "what it is", sp.Integer(1)),
        lambda: InternalVariable(sp.Symbol(symbol), "a", "m", "what it is"),
        lambda: NamedFunction(
            sp.Function(symbol)(sp.Symbol("x")), "a", "m", "what it is", sp.Symbol("x")
        ),
    ):
        with pytest.raises(ValueError, match=r"'a'.*must consist of letters") as error:
            declare()
        assert repr(symbol[:100]) in str(error.value)


@pytest.mark.parametrize(
    "symbol",
    [
        "theta",
        "M_b",
        "k_{f,1}",
        "r'_1",
        "φ",
        r"\theta",
        r"\dot{x}",
        r"\Delta L",
        "xdot",
        "varphi_0",
    ],
)
def test_symbols_of_papers_are_taken(symbol):
    parameter(symbol, "a", "m", "what it is")
    coordinate(symbol, "a", "m", "what it is")


@pytest.mark.parametrize("text", [r"$\input{x}$", r"half of $B$, $\write18{y}$", "$^^5cinput{x}$"])
def test_mathematics_in_a_text_does_nothing_but_say(text):
    assert "mathematics of meaning" in told(parameter, "B", "a", "m", text)
    with pytest.raises(ValueError, match=r"mathematics of title"):
        replace(tower(), title=text)
