"""How Sphinx builds the site; scripts/docs --site stages the pages and calls it."""

import os
import re
from typing import Any

import mcplan

project = "mcplan"
author = "The mcplan developers"
copyright = author
version = release = mcplan.__version__

extensions = [
    "myst_nb",
    "sphinx.ext.autodoc",
    "sphinx.ext.napoleon",
    "sphinx_copybutton",
    "sphinx-mathjax-offline",
    "breathe",
]
root_doc = "index"
html_theme = "furo"
html_title = f"mcplan {release}"
html_show_sphinx = False
html_static_path = ["_static"]
html_css_files = ["mcplan.css"]
html_extra_path = ["gallery_files"]

# The pages are written for GitHub's Markdown, too: anchors as there, formulas between dollars.
myst_enable_extensions = ["dollarmath", "attrs_inline", "colon_fence"]
myst_heading_anchors = 4
myst_dmath_double_inline = True

nb_execution_mode = os.environ.get("MCPLAN_NOTEBOOKS", "cache")
nb_execution_cache_path = os.environ["MCPLAN_NOTEBOOK_CACHE"]
nb_execution_timeout = 600
nb_execution_raise_on_error = True
nb_merge_streams = True

autodoc_member_order = "bysource"
autodoc_typehints = "signature"
autodoc_typehints_format = "short"
autodoc_preserve_defaults = True
napoleon_google_docstring = True
napoleon_use_rtype = False
napoleon_use_ivar = True
napoleon_attr_annotations = False
default_role = "code"
# Three engines have Options and Results of their own; a short name in a signature may mean any of them.
suppress_warnings = ["ref.python"]
python_use_unqualified_type_names = True
add_module_names = False

breathe_projects = {"mcplan": os.environ["MCPLAN_DOXYGEN_XML"]}
breathe_default_project = "mcplan"
cpp_index_common_prefix = ["mcplan::"]

SECTIONS = ("Args:", "Attributes:", "Raises:", "Returns:", "Yields:")
CODE = re.compile(r"(``.*?``|`.*?`)")


#: Docstrings of properties, in which napoleon would take what stands before a colon for a type.
PROPERTIES: dict[str, list[str]] = {}


def as_restructured_text(_: Any, what: str, name: str, told: Any, options: Any, lines: list[str]) -> None:
    """Make a docstring, whose code is indented and whose text is plain, one that reStructuredText reads the same way."""
    out: list[str] = []
    in_section = in_code = False
    for line in lines:
        indented = line.startswith("    ")
        if line.strip() and not indented:
            in_section, in_code = line.strip() in SECTIONS, False
        if indented and not in_section and not in_code:
            out += ["", ".. code-block:: python", ""]
            in_code = True
        out.append(line if in_code else escaped(line))
    lines[:] = out
    if what in ("attribute", "property"):
        PROPERTIES[name] = out


def with_colons(_: Any, what: str, name: str, told: Any, options: Any, lines: list[str]) -> None:
    """Take back what napoleon has made of a property's docstring."""
    if name in PROPERTIES:
        lines[:] = PROPERTIES[name]


def escaped(line: str) -> str:
    """A line whose bars and trailing underscores mean themselves, but in what is marked as code."""
    parts = CODE.split(line)
    for i in range(0, len(parts), 2):
        parts[i] = re.sub(r"(?<=\w)_(?!\w)", r"\\_", parts[i].replace("|", r"\|"))
    return "".join(parts)


def setup(app: Any) -> None:
    """Called by Sphinx; docstrings are rewritten before napoleon reads their sections."""
    app.connect("autodoc-process-docstring", as_restructured_text, priority=400)
    app.connect("autodoc-process-docstring", with_colons, priority=600)
