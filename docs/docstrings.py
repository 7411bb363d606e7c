"""Docstrings of this project as reStructuredText.

They are plain text: `name` in single backticks, ``name [unit] : meaning`` for arguments, fields and
results, and examples that are indented or begin with ``>>>``. A ``*`` or ``|`` is a sign of
arithmetic. A sentence that begins with the name of an argument describes it, with or without the
colon, and becomes an item of a list; so does each part of ``alpha [rad]; p [rad/s]``.
"""

import builtins
import inspect
import re
from collections.abc import Collection
from functools import cache
from itertools import accumulate, pairwise
from pathlib import Path

UNIT = r"(?: \([^)]*\))?(?: \[[^\]]*\])?"
NAME = rf"\w+(?: \w+)?{UNIT}"  # x, x (n,) [m], stiffness k [N/m]
SYMBOL = r"(?:[A-Za-z]\d?|alpha|beta|eta|gamma|mu|nu|phi|rho|theta|xi)(?:_\w+)?"
ITEM = re.compile(rf"({NAME}(?:, {NAME})*) : ")
REMARK = re.compile(r"(Raises|Returns|Sources?:|Any shapes?\b)")  # is about all items
CODE = re.compile(r"(``.*?``|`[^`]*`)", re.DOTALL)
FOREIGN = {"pd", "numpy", "np", "sympy", "sp", "xarray", "xr", "matplotlib", "mpl", "collections"}
FOREIGN |= {"types", "typing", "enum", "pathlib", "os", "ArrayLike"}
FOREIGN |= {"Motion", "Run", "Rocking", "GeneratedModule"}  # protocols of the package's own use
FOREIGN |= {"RandomParameters", "_Density"}  # in which a posterior keeps its own
FOREIGN |= {"Axes", "Figure", "SubFigure", "ModuleType"}  # as annotations name them


INTERNAL = {
    # of a structure
    "of_each", "pulled", "parameter_at", "module", "vector", "module_for", "jumps_between_events",
    "rocks_on_rigid_ground", "has_landings", "fastest_damping", "small_motion", "state",
    "mode_number", "law", "describe_impact", "speed_height", "impact_table", "defaults",
    "complete", "held", "not_numbers", "load", "sizes_checked", "may_vanish", "of_base",
    # of a support, an impact law, a case, a response
    "kind", "resolve", "table", "of_foot", "code", "problem", "spans",
}  # fmt: skip
"""Members that the package itself calls."""

INTERNAL_HOMES = ("rockeom.symbolic.elements",)
"""Modules whose classes are declared by their arguments; their methods serve the derivation."""


def process(app, what, name, obj, options, lines) -> None:
    docstring = "\n".join(lines).strip()
    if what == "data" and docstring == (inspect.getdoc(type(obj)) or "").strip():
        lines.clear()  # a constant that has none shows that of its type: of dict, of list
    else:
        lines[:] = rst(docstring, arguments(obj)).split("\n")
        lines += examples().get(name, "").split("\n")


@cache
def examples() -> dict[str, str]:
    """Sessions of Python by the names that they belong to, see examples.txt."""
    text = (Path(__file__).parent / "examples.txt").read_text(encoding="utf-8")
    _, *parts = re.split(r"^# ([\w.]+)\n", text, flags=re.MULTILINE)
    sessions = (re.sub(r" *# doctest: .*", "", part).strip() for part in parts[1::2])
    return {name: f"\n{part}\n" for name, part in zip(parts[::2], sessions, strict=True)}


def skip(app, what, name, obj, skipped, options) -> bool | None:
    """Leave out the package's own members, and fields of a named tuple.

    The docstring of a named tuple describes its fields.
    """
    docstring = getattr(obj, "__doc__", "") or ""
    home = getattr(getattr(obj, "fget", obj), "__module__", "")
    internal = what == "class" and (name in INTERNAL or home in INTERNAL_HOMES)
    hidden = docstring.startswith("Alias for field")
    return True if internal or hidden else None


def arguments(obj) -> set[str]:
    """Names of the arguments of a function or class, and of the fields of a class."""
    try:
        names = set(inspect.signature(obj).parameters)
    except (TypeError, ValueError):  # a property, a constant
        return set()
    return names | set(getattr(obj, "__annotations__", ()))


def shorten(app, what, name, obj, options, signature, returned):
    """Signatures that say ArrayLike, not the lines of types that it stands for."""
    from numpy.typing import ArrayLike
    from sphinx.util.typing import stringify_annotation

    spelt = stringify_annotation(ArrayLike, "smart")
    return tuple(text and text.replace(spelt, "ArrayLike") for text in (signature, returned))


def rst(docstring: str, names: Collection[str] = ()) -> str:
    """reStructuredText of a docstring; `names` are those of the arguments."""
    paragraphs = re.split(r"\n\s*\n", inspect.cleandoc(docstring))
    joined: list[str] = []
    for text in paragraphs:
        if text.startswith("    ") and joined and joined[-1].startswith("    "):
            joined[-1] += f"\n\n{text}"  # one example with a blank line
        else:
            joined.append(text)
    summary, *others = joined
    parts = [_paragraph(summary, ()), *(_paragraph(text, names) for text in others)]
    return "\n\n".join(parts) + "\n"


def _paragraph(text: str, names: Collection[str]) -> str:
    if text.startswith("    "):
        return ".. code-block:: python\n\n" + text
    if text.startswith(">>> "):
        return text
    pieces = [piece.strip() for piece in _pieces(text, names)]
    items = [_item(piece, names) for piece in pieces]
    if not any(items):
        return escaped(text)
    last = max(i for i, item in enumerate(items) if item)
    parts: list[str] = []
    for i, (piece, item) in enumerate(zip(pieces, items, strict=True)):
        if item:
            parts.append(f"* {item}")
        elif not parts or (i > last and parts[-1][:2] != "* ") or REMARK.match(piece):
            parts.append(escaped(piece))
        else:
            parts[-1] += f" {escaped(piece)}"
    return "\n\n".join(re.sub(r";$", ".", part) for part in parts)


def _pieces(text: str, names: Collection[str]) -> list[str]:
    """The sentences of a paragraph, and the parts of those in which descriptions begin."""
    lines = [line.strip() for line in text.split("\n")]
    one_line = " ".join(lines)
    line_starts = {*accumulate(len(line) + 1 for line in lines)}
    starts = [
        here.end()
        for here in re.finditer(" ", one_line)
        if _begins(one_line[: here.start()], one_line[here.end() :], names)
        or (here.end() in line_starts and ITEM.match(one_line, here.end()))
    ]
    return [one_line[a:b] for a, b in pairwise([0, *starts, len(one_line)])]


def _begins(before: str, rest: str, names: Collection[str]) -> bool:
    """Whether a sentence, or the description of an argument, begins between two texts."""
    if before[-1] == ".":
        return not rest[:1].islower() or bool(ITEM.match(rest) or _run(rest, names))
    if before[-1] == ";":
        run = _run(rest, names)
        return "[" in rest[:run] or bool(run and re.match(r"\s*[\[:;,]|$", rest[run:]))
    return False


def _item(piece: str, names: Collection[str]) -> str:
    """The piece as an item, its names as code, or nothing where it is none."""
    head, colon, meaning = piece.partition(" : ")
    if ITEM.match(piece):
        return f"``{head}``: {escaped(meaning)}"
    if not (run := _run(piece, names)):
        return ""
    if colon and "." not in head:
        return f"``{head}``: {escaped(meaning)}"
    return f"``{piece[:run]}``{escaped(piece[run:])}"


def _run(text: str, names: Collection[str]) -> int:
    """The length of the names of arguments, with units, with which a text begins."""
    end = 0
    name = re.compile(rf"(\w+)(?: {SYMBOL}(?=[ ,;.]))?{UNIT}")
    while (found := name.match(text, end)) and found[1] in names:
        stop = found.end()
        between = re.compile(r", | and ").match(text, stop)
        follows = between and name.match(text, between.end())
        if not (follows and follows[1] in names):
            return stop
        end = between.end()
    return 0


def escaped(text: str) -> str:
    """Text in which only backticks are markup."""
    pieces = CODE.split(text)
    pieces[::2] = [re.sub(r"([*|\\]|(?<=\w)_(?!\w))", r"\\\1", piece) for piece in pieces[::2]]
    return "".join(pieces)


def resolve(app, env, node, contnode):
    """A name without its module, where only one thing documented has that name.

    What is not of this project, and what in a docstring is an argument, is shown as it is. A type
    of this project that has no page is a warning.
    """
    from sphinx.util.nodes import make_refnode

    if node.get("refdomain") != "py":
        return None
    target = node["reftarget"]
    domain = env.get_domain("py")
    last = target.rpartition(".")[2]
    found = {
        (entry.docname, entry.node_id, name)
        for name, entry in domain.objects.items()
        if (name == target or name.endswith("." + last)) and entry.objtype != "module"
    }
    exact = {f for f in found if f[2].endswith("." + target)} or found
    if len({f[:2] for f in exact}) == 1:
        docname, node_id, name = min(exact)
        builder = app.builder
        return make_refnode(builder, node["refdoc"], docname, node_id, contnode, name)
    foreign = not {target.partition(".")[0], last}.isdisjoint(FOREIGN) or hasattr(builtins, target)
    return contnode if foreign or node["reftype"] == "obj" else None
