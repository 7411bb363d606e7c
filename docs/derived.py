"""The pages of ../generated as pages: copied, with links to the gallery and to the catalogue."""

import re
from functools import cache
from pathlib import Path

from catalogue import PAGES as CHAPTERS

from rockeom.structures.classes import SHIPPED

HERE = Path(__file__).parent
SOURCES = HERE.parent / "generated"
PAGES = HERE / "derived"

STYLE = """<style>mjx-container[display="true"] { font-size: 95% !important; }</style>"""
"""Numbers of equations next to long lines take room."""


def copy() -> None:
    """The pages; only those that changed, for a quick rebuild."""
    PAGES.mkdir(exist_ok=True)
    for name in SHIPPED:
        target, text = PAGES / f"{name}.md", page(name)
        if not target.exists() or target.read_text(encoding="utf-8") != text:
            target.write_text(text, encoding="utf-8")


@cache
def page(name: str) -> str:
    """The page of a structure, with a line of links below its title."""
    text = (SOURCES / f"{name}.md").read_text(encoding="utf-8")
    title, drawing, rest = text.replace("../docs/images/", "../images/").split("\n\n", 2)
    cls = SHIPPED[name].__name__
    links = f"[{cls}](#rockeom.{cls}) simulates it; the [gallery](../gallery.md) has a motion."
    if numbers := sorted(set(re.findall(r"[\dD]-\d+", " ".join(tags(text))))):
        linked = ", ".join(f"[{n}](../equations/{_place(n)})" for n in numbers)
        links += f" The catalogue of the thesis has {linked}, each with its verdict."
    return "\n\n".join([title, STYLE, links, drawing, rest])


def tags(text: str) -> list[str]:
    """The sources of the equations of a page."""
    return re.findall(r"\\tag\{\d+, ([^}]*)\}", text)


def _place(number: str) -> str:
    return f"{CHAPTERS[number.partition('-')[0]]}.md#equation-{number.lower()}"


def cards() -> str:
    """A card for each structure: the drawing, and its title as a link."""
    return "::::{container} cards small\n" + "\n".join(map(_card, SHIPPED)) + "\n::::"


def _card(name: str) -> str:
    title = page(name).partition("\n")[0].removeprefix("# ")
    picture = f"![{title}](images/free_body/{name}.png)"
    return f":::{{container}} card\n{picture}\n\n**[{title}](derived/{name}.md)**\n:::"
