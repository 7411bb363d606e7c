"""Docstrings of this project as reStructuredText.

They are plain text: `name` in single backticks, lines that begin with ``name : `` for arguments,
fields and results, and examples that are indented. A ``*`` or ``|`` is a sign of arithmetic.
"""

import builtins
import inspect
import re

NAME = r"\w+(?: \w+)?(?: \([^)]*\))?(?: \[[^\]]*\])?"  # x, x (n,) [m], stiffness k [N/m]
ITEM = re.compile(rf"({NAME}(?:, {NAME})*) : (.*)")
CODE = re.compile(r"(``.*?``|`[^`]*`)", re.DOTALL)
FOREIGN = {"pd", "numpy", "np", "sympy", "sp", "xarray", "xr", "matplotlib", "mpl", "collections"}
FOREIGN |= {"types", "typing", "enum", "pathlib", "os", "ArrayLike"}
FOREIGN |= {"Axes", "Figure", "SubFigure", "ModuleType"}  # as annotations name them


def structures() -> str:
    """The lines that show the classes of all shipped structures."""
    from rockeom.structures.classes import SHIPPED

    return "\n".join(f".. autoclass:: rockeom.{cls.__name__}" for cls in SHIPPED.values())


def process(app, what, name, obj, options, lines) -> None:
    docstring = "\n".join(lines).strip()
    if what == "data" and docstring == (inspect.getdoc(type(obj)) or "").strip():
        lines.clear()  # a constant that has none shows that of its type: of dict, of list
    else:
        lines[:] = rst(docstring).split("\n")


def shorten(app, what, name, obj, options, signature, returned):
    """Signatures that say ArrayLike, not the lines of types that it stands for."""
    from numpy.typing import ArrayLike
    from sphinx.util.typing import stringify_annotation

    spelt = stringify_annotation(ArrayLike, "smart")
    return tuple(text and text.replace(spelt, "ArrayLike") for text in (signature, returned))


def rst(docstring: str) -> str:
    """reStructuredText of a docstring."""
    paragraphs = re.split(r"\n\s*\n", inspect.cleandoc(docstring))
    joined: list[str] = []
    for text in paragraphs:
        if text.startswith("    ") and joined and joined[-1].startswith("    "):
            joined[-1] += f"\n\n{text}"  # one example with a blank line
        else:
            joined.append(text)
    return "\n\n".join(_paragraph(text) for text in joined) + "\n"


def _paragraph(text: str) -> str:
    if text.startswith("    "):
        return ".. code-block:: python\n\n" + text
    lines = text.split("\n")
    if not any(ITEM.match(line) for line in lines):
        return escaped(text)
    parts: list[str] = []
    for line in lines:
        if found := ITEM.match(line):
            name, meaning = found.groups()
            parts.append(f"* ``{name}``: {escaped(meaning)}")
        elif not parts or not (parts[-1].startswith("* ")):
            parts.append(escaped(line))
        elif line.startswith(" ") or not _ends(parts[-1]):
            parts[-1] += f"\n  {escaped(line.strip())}"
        else:  # a sentence after the last item
            parts.append(escaped(line))
    return "\n\n".join(parts)


def _ends(text: str) -> bool:
    return text.rstrip().endswith(".")


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
    foreign = target.partition(".")[0] in FOREIGN or hasattr(builtins, target)
    return contnode if foreign or node["reftype"] == "obj" else None
