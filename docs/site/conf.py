"""How Sphinx builds the site; scripts/docs --site stages the pages and calls it."""

import os
from typing import Any

import mcplan
from pages.site import docstrings

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
# Every header declares its namespace.
suppress_warnings = ["ref.python", "duplicate_declaration.cpp"]
python_use_unqualified_type_names = True
add_module_names = False

breathe_projects = {"mcplan": os.environ["MCPLAN_DOXYGEN_XML"]}
breathe_default_project = "mcplan"
cpp_index_common_prefix = ["mcplan::"]


def setup(app: Any) -> None:
    """Called by Sphinx; docstrings are rewritten before napoleon reads their sections."""
    app.connect("autodoc-process-docstring", docstrings.as_restructured_text, priority=400)
    app.connect("autodoc-process-docstring", docstrings.with_colons, priority=600)
