# SPDX-License-Identifier: GPL-2.0-or-later
"""Sphinx reads this; docs/make_site.py makes the folder that it works in."""
import sys
from pathlib import Path

from pygments.lexers.special import TextLexer
from sphinx.highlighting import lexers

project = "magfsi"
copyright = "The magfsi developers, GPL-2.0-or-later"
extensions = ["myst_parser", "sphinx.ext.autodoc"]
master_doc = root_doc = "docs/index"
source_suffix = {".md": "markdown"}
myst_heading_anchors = 4
myst_enable_extensions = ["html_image"]  # pictures whose width is given
autodoc_typehints = "none"  # they stand in the signatures' own text
sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "adapters/python"))

lexers["lammps"] = TextLexer()

html_theme = "alabaster"
html_title = "magfsi"
html_theme_options = {"description": "Hard-magnetic soft robots in a fluid", "page_width": "1100px",
                      "sidebar_width": "240px", "fixed_sidebar": False}
html_sidebars = {"**": ["about.html", "navigation.html", "searchbox.html"]}
html_show_sourcelink = False
# Pages are those of readers; the tests' and adapters' own READMEs are for developers.
exclude_patterns = ["adapters", "tests", "structure", "fluid_lbm", "coupler", "build", "runs",
                    "packaging", ".*"]
suppress_warnings = ["myst.header"]
