"""The notebooks of ../derivations as pages: copied, headed, listed, and kept for Jupyter.

What is said of each, its level, the minutes it takes and the figure that stands for it, is in its
own header and nowhere else.
"""

import re
from copy import deepcopy
from functools import cache
from pathlib import Path
from typing import NamedTuple

import jupytext

HERE = Path(__file__).parent
SOURCES = HERE.parent / "derivations"
PAGES = HERE / "derivations"
FOR_JUPYTER = HERE / "_build" / "notebooks"
THUMBNAILS = "_static/notebooks"


class Told(NamedTuple):
    """What the header of a notebook says, with its title and its first sentences."""

    title: str
    about: str
    level: str
    minutes: int
    figure: int

    @property
    def line(self) -> str:
        return f"{self.level.capitalize()}, about {self.minutes} minutes."


@cache
def sources() -> dict[str, Path]:
    return {p.stem: p for p in sorted(SOURCES.glob("*.py")) if p.name[0] != "_"}


read = cache(jupytext.read)


@cache
def told(name: str) -> Told:
    notebook = read(sources()[name])
    first, about = notebook.cells[0].source.split("\n\n")[:2]
    about = re.sub(r"\[([^\]]+)\]\([^)]+\)", r"\1", about)  # links, which lead from that page
    return Told(first.removeprefix("# "), " ".join(about.split()), **notebook.metadata["rockeom"])


def copy() -> None:
    """The notebooks as pages and as .ipynb; only those that changed, for a quick rebuild."""
    for folder, ending in ((PAGES, ".py"), (FOR_JUPYTER, ".ipynb")):
        folder.mkdir(parents=True, exist_ok=True)
        for old in folder.iterdir():
            if old.stem not in sources():
                old.unlink()
        for name, source in sources().items():
            text = headed(name) if ending == ".py" else for_jupyter(source)
            target = folder / f"{name}{ending}"
            if not target.exists() or target.read_text(encoding="utf-8") != text:
                target.write_text(text, encoding="utf-8")


def headed(name: str) -> str:
    """The text of a notebook, with a line below its title: for whom it is, and where to get it."""
    link = f"{{download}}`Download it <../_build/notebooks/{name}.ipynb>`"
    line = f"# *{told(name).line}* {link} for Jupyter."
    text = sources()[name].read_text(encoding="utf-8")
    return re.sub(r"^(# # .*\n#\n)", rf"\g<1>{line}\n#\n", text, count=1, flags=re.MULTILINE)


def for_jupyter(source: Path) -> str:
    notebook = deepcopy(read(source))
    for number, cell in enumerate(notebook.cells):
        cell["id"] = f"cell-{number}"  # the same each time
    return jupytext.writes(notebook, fmt="ipynb")


def cards() -> str:
    """All notebooks, in the order of the table of contents of their page."""
    page = (HERE / "derivations.md").read_text(encoding="utf-8")
    order = re.findall(r"^derivations/(\w+)$", page, re.MULTILINE)
    return "::::{container} cards\n" + "\n".join(_card(name) for name in order) + "\n::::"


def _card(name: str) -> str:
    one = told(name)
    return f"""\
:::{{container}} card
<img src="{THUMBNAILS}/{name}.png" alt="Figure {one.figure} of the notebook">

**[{one.title}](derivations/{name}.py)**

*{one.line}* {one.about}
:::"""


def figure_of(name: str, doctree) -> str | None:
    """The path of the picture that stands for a notebook, in its page with all outputs."""
    from docutils import nodes

    pictures = [node["uri"] for node in doctree.findall(nodes.image)]
    return pictures[told(name).figure - 1] if len(pictures) >= told(name).figure else None
