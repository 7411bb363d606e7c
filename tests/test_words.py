"""Names and prose say the words of the field: those that words.toml bans are not used."""

import argparse
import ast
import inspect
import re
import tokenize
import tomllib
from collections.abc import Iterator
from importlib import import_module
from pathlib import Path
from types import ModuleType
from typing import Any

import pytest

from rockeom.cli import _parser

HERE = Path(__file__).resolve().parent
PACKAGE = HERE.parent / "rockeom"
WORDS = tomllib.loads((HERE / "words.toml").read_text(encoding="utf-8"))
PUBLIC = (
    "rockeom",
    "rockeom.analysis",
    "rockeom.analysis.design",
    "rockeom.analysis.dynamics",
    "rockeom.analysis.formulas",
    "rockeom.analysis.identification",
    "rockeom.analysis.risk",
    "rockeom.analysis.standards",
    "rockeom.drawing",
    "rockeom.exports",
    "rockeom.modelling",
    "rockeom.motion",
    "rockeom.plots",
    "rockeom.symbolic",
)


# --- docstrings, comments and messages


def prose(text: str) -> Iterator[str]:
    """Docstrings and other texts of more than one word, and comments that follow one another."""
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, ast.Constant) and isinstance(node.value, str) and " " in node.value:
            yield " ".join(node.value.split())
    lines: dict[int, str] = {}
    for token in tokenize.generate_tokens(iter(text.splitlines(keepends=True)).__next__):
        if token.type == tokenize.COMMENT:
            before = lines.pop(token.start[0] - 1, "")
            lines[token.start[0]] = f"{before} {token.string.lstrip('#: ')}".strip()
    yield from lines.values()


def uses(banned: dict[str, Any], text: str) -> list[str]:
    """The places of a text in which the phrase is used, but for the allowed uses."""
    phrase = banned["phrase"]
    for use in banned.get("allowed", []):
        text = re.sub(use, "...", text, flags=re.IGNORECASE)
    flags = re.NOFLAG if re.search("[A-Z]", re.sub(r"\\.", "", phrase)) else re.IGNORECASE
    found = re.finditer(phrase, text, flags)
    return [text[max(0, match.start() - 40) : match.end() + 40] for match in found]


@pytest.fixture(scope="module")
def texts() -> dict[str, list[str]]:
    files = (f for f in PACKAGE.rglob("*.py") if "generated" not in f.relative_to(PACKAGE).parts)
    return {
        f.relative_to(PACKAGE).as_posix(): [*prose(f.read_text(encoding="utf-8"))] for f in files
    }


def paragraphs(markdown: str) -> Iterator[str]:
    """Paragraphs, items, headings and cells of a page, without its code."""
    text = re.sub(
        r"^```(?!{(?:note|tip|figure)).*?^```|\A---.*?^---", "", markdown, flags=re.M | re.S
    )
    for part in re.split(r"\n\s*\n|\n(?=\s*(?:[-|*#:>]|\d+\.) ?)", text):
        for cell in part.split("|") if part.lstrip().startswith("|") else [part]:
            yield " ".join(cell.strip(" -*#>|\n").split())


@pytest.fixture(scope="module")
def pages() -> dict[str, list[str]]:
    root = PACKAGE.parent
    files = [root / "README.md", root / "CHANGELOG.md", *(root / "docs").rglob("*.md")]
    built = {"_build", "derivations"}  # by `make docs`
    return {
        file.relative_to(root).as_posix(): [*paragraphs(file.read_text(encoding="utf-8"))]
        for file in files
        if not built & {*file.relative_to(root).parts}
    }


@pytest.mark.parametrize(
    "banned", [w for w in WORDS["prose"] if w.get("pages")], ids=lambda banned: banned["phrase"]
)
def test_pages_say_it_in_plain_english(pages, banned):
    found = [
        f"{page}: {use}" for page, texts in pages.items() for t in texts for use in uses(banned, t)
    ]
    assert not found, (banned["say"], *found)


@pytest.mark.parametrize("banned", WORDS["prose"], ids=lambda banned: banned["phrase"])
def test_prose_says_it_in_the_words_of_the_field(texts, banned):
    found = [
        f"{file}: {use}"
        for file, of_file in texts.items()
        if not file.startswith(tuple(banned.get("right_in", ())))
        for text in of_file
        for use in uses(banned, text)
    ]
    assert len(found) <= banned.get("left", 0), (banned["say"], *found)


def test_a_banned_phrase_is_seen_and_an_allowed_use_is_not():
    docstring, comment = prose('"""Draw the phase portrait.\n\nWhat a\nphase is."""\n# Of a phase')
    phase = {"phrase": r"\bphases?\b", "allowed": ["phase portrait"]}
    assert uses(phase, docstring) == ["Draw the .... What a phase is."]
    assert uses(phase, comment) == ["Of a phase"]
    what, _, of = WORDS["prose"][:3]
    assert uses(what, docstring)
    assert uses(of, comment)
    assert not uses(what, comment)
    assert not uses(of, docstring)


# --- public names


def public_names(path: str, value: object) -> Iterator[str]:
    """The name of a function or class, of its members and fields, and of their arguments."""
    yield path
    if inspect.isclass(value):
        if not value.__module__.startswith("rockeom"):
            return
        yield from (f"{path}: {name}" for name in getattr(value, "__dataclass_fields__", ()))
        for name in dir(value):
            if name.startswith("_"):
                continue
            member = inspect.getattr_static(value, name)
            member = getattr(member, "__func__", member)
            yield f"{path}.{name}"
            if inspect.isfunction(member):
                yield from (f"{path}.{name}: {a}" for a in inspect.signature(member).parameters)
    elif inspect.isfunction(value):
        yield from (f"{path}: {a}" for a in inspect.signature(value).parameters)


def options(parser: argparse.ArgumentParser, path: str) -> Iterator[str]:
    for action in parser._actions:
        yield from (f"{path}: {option}" for option in action.option_strings or [action.dest])
        if isinstance(action, argparse._SubParsersAction):
            for name, command in action.choices.items():
                yield from options(command, f"{path} {name}")


def is_banned(name: str) -> bool:
    last = re.split(r"[.: ]+", re.sub(r"(?<=[a-z])(?=[A-Z])", "_", name))[-1]
    words = last.lower().replace("-", "_").strip("_")
    return any(re.search(f"(^|_){word}s?(_|$)", words) for word in WORDS["names"]["words"])


@pytest.mark.parametrize("module", PUBLIC)
def test_public_names_are_words_of_the_field(module):
    home = import_module(module)
    names = [name for name in getattr(home, "__all__", dir(home)) if not name.startswith("_")]
    members = ((name, getattr(home, name)) for name in names)
    found = {
        name
        for member, value in members
        if not isinstance(value, ModuleType)
        for name in public_names(member, value)
        if is_banned(name)
    }
    assert found <= {*WORDS["names"]["allowed"]}


def test_options_of_commands_are_words_of_the_field():
    assert [name for name in options(_parser(), "rockeom") if is_banned(name)] == []


def test_a_banned_name_is_seen_in_a_class_an_argument_and_an_option():
    for name in ("PhasePortrait", "energies: phase", "rockeom simulate: --contact-state", "phases"):
        assert is_banned(name)
    for name in ("foundation", "emphases", "energies: mode"):
        assert not is_banned(name)
