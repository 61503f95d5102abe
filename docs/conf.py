"""Settings of the documentation site; `make docs` builds it without a connection to any network."""

import sys
from pathlib import Path

DOCS = Path(__file__).parent
sys.path.insert(0, str(DOCS / "_ext"))

from stonepass import __version__  # noqa: E402

project = "stonepass"
author = "The stonepass developers"
copyright = "2026, The stonepass developers"
version = release = __version__

extensions = [
    "myst_nb",
    "sphinx.ext.autodoc",
    "numpydoc",
    "sphinx.ext.autosectionlabel",  # docstrings refer to sections of pages
    "sphinx.ext.doctest",
    "sphinx_copybutton",
    "mathml",  # docs/_ext: equations as MathML, without a script
    "dark_figures",  # docs/_ext: figures in the colours of the dark theme
    "generated_pages",  # docs/_ext: pages of the Python interface and of the command line
]
exclude_patterns = ["_build", "_ext"]
autosectionlabel_prefix_document = True
# Pages that runs write have sections of the same title, to which nothing refers.
suppress_warnings = ["autosectionlabel.verification", "autosectionlabel.reference"]
nitpicky = True
# Types of other libraries, whose documentation is on other machines.
nitpick_ignore_regex = [
    (
        "py:.*",
        r"(numpy|np|collections|pathlib|concurrent|pandas|matplotlib|pydantic|jaxtyping)\b.*",
    ),
]

# Pages: Markdown that a code host shows as well. Anchors are those that a code host makes.
myst_enable_extensions = ["dollarmath"]
myst_heading_anchors = 4
html_math_renderer = "mathml"

# Notebooks are run by the build; an error in one of them fails the build.
nb_execution_mode = "auto"
nb_execution_timeout = 300
nb_execution_raise_on_error = True
nb_execution_show_tb = True
nb_merge_streams = True

# Docstrings have NumPy sections.
numpydoc_show_class_members = False
autodoc_typehints = "none"
autodoc_member_order = "bysource"
autodoc_preserve_defaults = True
default_role = "code"
smartquotes = False  # --option stays --option
# The names that a docstring of the package finds in its own module.
doctest_global_setup = """
from pathlib import Path
import numpy as np
import stonepass as sp
from stonepass import *
from stonepass.export import *
"""

html_theme = "furo"
html_title = f"stonepass {version}"
html_static_path = ["_static"]
html_css_files = ["site.css"]
html_show_sphinx = False
html_copy_source = False
copybutton_prompt_text = r">>> |\.\.\. |\$ "
copybutton_prompt_is_regexp = True

# `make docs-links` alone asks other machines.
linkcheck_timeout = 20
linkcheck_retries = 2
