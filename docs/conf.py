"""Sphinx: the pages in this folder, the notebooks in ../derivations, and the docstrings.

Built by ``make docs``. Notebooks and the examples of the guides are run by the build, so that
nothing shown is typed in. Mathematics is set by a copy of MathJax in the built pages: they need
no network.
"""

import hashlib
import re
import sys
from pathlib import Path

HERE = Path(__file__).parent
ROOT = HERE.parent
sys.path[:0] = [str(ROOT), str(HERE)]

import catalogue  # noqa: E402
import docstrings  # noqa: E402
import explorers  # noqa: E402
import gallery  # noqa: E402
import notebooks  # noqa: E402
from docutils import nodes  # noqa: E402

import rockeom  # noqa: E402

project = "rockeom"
author = "the rockeom developers"
copyright = author
version = release = rockeom.__version__

extensions = [
    "sphinx.ext.autodoc",
    "sphinx.ext.mathjax",
    "sphinx-mathjax-offline",
    "myst_nb",
    "sphinx_copybutton",
]
exclude_patterns = ["_build", "*.py"]
nitpicky = True
nitpick_ignore = [("py:class", "rockeom.motion.floor.Shaking")]  # a motion, or a recording
suppress_warnings = ["myst.header"]  # benchmarks.md is written by a program, one level deep

# --- Markdown and notebooks

myst_enable_extensions = ["dollarmath", "amsmath", "attrs_inline", "colon_fence"]
myst_heading_anchors = 3
nb_custom_formats = {".py": ["jupytext.reads", {"fmt": "py:percent"}]}
nb_execution_in_temp = True  # what an example writes is thrown away
nb_execution_timeout = 600
nb_execution_raise_on_error = True
nb_merge_streams = True
nb_mime_priority_overrides = [("html", "text/latex", 45)]  # before a PNG of the same equation


def _hash_of(*folders: str) -> str:
    """Changes with every line of the package: a stale output must not outlive the code."""
    paths = sorted(p for folder in folders for p in (ROOT / folder).rglob("*.py"))
    return hashlib.sha256(b"".join(p.read_bytes() for p in paths)).hexdigest()[:16]


CODE = _hash_of("rockeom", "generated")
nb_execution_mode = "cache"
nb_execution_cache_path = str(HERE / "_build" / "executed" / CODE)

# --- docstrings

default_role = "py:obj"
autodoc_typehints = "signature"
autodoc_member_order = "bysource"
autodoc_inherit_docstrings = False  # what a class overrides is described once, by its base
autodoc_default_options = {"members": True, "inherited-members": False}
autodoc_preserve_defaults = True
python_use_unqualified_type_names = True
add_module_names = False
maximum_signature_line_length = 88

# --- HTML

html_theme = "furo"
html_title = f"rockeom {release}"
html_static_path = ["_static"]
html_css_files = ["rockeom.css"]
html_copy_source = False
html_show_sphinx = False
mathjax3_config = {"chtml": {"displayAlign": "left", "displayIndent": "1.5em"}}
copybutton_exclude = ".linenos, .gp, .go"


def leave_out_links_to_code(app, docname, source) -> None:
    """Files of the repository that are no pages are named, not linked."""

    def text(link: re.Match) -> str:
        words, target = link.groups()
        inside = (HERE / docname).parent.joinpath(target).resolve().is_relative_to(HERE)
        return link[0] if inside else f"`{words}`"

    source[0] = re.sub(r"(?<!!)\[([^\]]+)\]\((\.\.?/[^)]*)\)", text, source[0])


def let_tags_stand(app, doctree) -> None:
    """Sphinx puts whatever has two lines into ``split``, where MathJax allows no ``\\tag``."""
    for node in doctree.findall(nodes.math_block):
        text = node.astext()
        if r"\tag" in text and not node.get("no-wrap"):
            node.children = [nodes.Text(rf"\[{text}\]")]
            node["no-wrap"] = True


def write_thumbnail(app, doctree, docname) -> None:
    """The figure that stands for a notebook, made small for the list of all."""
    folder, _, name = docname.rpartition("/")
    if folder == "derivations" and (picture := notebooks.figure_of(name, doctree)):
        target = Path(app.outdir, notebooks.THUMBNAILS, f"{name}.png")
        gallery.thumbnail(Path(app.srcdir, picture), target)


def write_explorers(app, error) -> None:
    """The pages with sliders to which the gallery leads."""
    if error is None and app.builder.name == "html":
        explorers.write(Path(app.outdir))


def setup(app) -> None:
    notebooks.copy()
    app.add_config_value("code", CODE, "env")  # where the code changed, every page is read again
    app.connect("source-read", catalogue.fill)
    app.connect("source-read", leave_out_links_to_code)
    app.connect("doctree-read", let_tags_stand)
    app.connect("doctree-resolved", write_thumbnail)
    app.connect("build-finished", write_explorers)
    app.connect("autodoc-process-signature", docstrings.shorten)
    app.connect("autodoc-process-docstring", docstrings.process)
    app.connect("autodoc-skip-member", docstrings.skip)
    app.connect("missing-reference", docstrings.resolve)
