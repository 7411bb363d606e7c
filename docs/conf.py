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
import derived  # noqa: E402
import explorers  # noqa: E402
import gallery  # noqa: E402
import notebooks  # noqa: E402
from docutils import nodes  # noqa: E402
from numpydoc.xref import DEFAULT_LINKS  # noqa: E402
from sphinx.util.nodes import make_refnode  # noqa: E402

import rockeom  # noqa: E402

project = "rockeom"
author = "the rockeom developers"
copyright = author
version = release = rockeom.__version__

extensions = [
    "sphinx.ext.autodoc",
    "numpydoc",
    "sphinx.ext.mathjax",
    "sphinx-mathjax-offline",
    "myst_nb",
    "sphinx_copybutton",
]
exclude_patterns = ["_build", "*.py"]
nitpicky = True
nitpick_ignore = [("py:class", "collections.abc.Callable")]  # an alias shows what it stands for
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
autodoc_typehints = "none"  # the sections of numpydoc have them
autodoc_member_order = "bysource"
autodoc_inherit_docstrings = False  # what a class overrides is described once, by its base
autodoc_default_options = {"members": True, "inherited-members": False}
autodoc_preserve_defaults = True
python_use_unqualified_type_names = True
add_module_names = False
maximum_signature_line_length = 88
numpydoc_show_class_members = False  # autodoc shows them
numpydoc_xref_param_type = True
numpydoc_xref_aliases = {name: name for name in DEFAULT_LINKS}  # the pages need no network
numpydoc_xref_ignore = {"of", "to", "optional"}

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


def leave_out_member(app, what, name, obj, skipped, options) -> bool | None:
    """Leave out the package's own members, and fields of a named tuple: its docstring has them."""
    home = getattr(getattr(obj, "fget", obj), "__module__", "")
    internal = what == "class" and (name in INTERNAL or home in INTERNAL_HOMES)
    field = (getattr(obj, "__doc__", "") or "").startswith("Alias for field")
    return True if internal or field else None


def resolve_short_name(app, env, node, contnode):
    """A name without its module, where one thing alone has it; an argument stays as it is."""
    if node.get("refdomain") != "py":
        return None
    named = env.get_domain("py").find_obj(env, None, None, node["reftarget"], None, 1)
    places = {(entry.docname, entry.node_id): name for name, entry in named}
    if len(places) == 1:
        ((docname, node_id), name) = places.popitem()
        return make_refnode(app.builder, node["refdoc"], docname, node_id, contnode, name)
    return contnode if node["reftype"] == "obj" else None


def setup(app) -> None:
    notebooks.copy()
    derived.copy()
    app.add_config_value("code", CODE, "env")  # where the code changed, every page is read again
    app.connect("source-read", catalogue.fill)
    app.connect("source-read", leave_out_links_to_code)
    app.connect("doctree-read", let_tags_stand)
    app.connect("doctree-resolved", write_thumbnail)
    app.connect("build-finished", write_explorers)
    app.connect("autodoc-skip-member", leave_out_member)
    app.connect("missing-reference", resolve_short_name)
