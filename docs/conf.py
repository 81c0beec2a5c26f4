# SPDX-License-Identifier: GPL-2.0-or-later
"""Sphinx reads this; docs/make_site.py makes the folder that it works in."""
import sys
from pathlib import Path

from pygments.lexers.special import TextLexer
from sphinx.highlighting import lexers

TOP = Path(__file__).resolve().parents[1]
sys.path[:0] = [str(TOP / "docs"), str(TOP / "adapters/python")]
import theme  # noqa: E402

project = "magfsi"
copyright = "The magfsi developers, GPL-2.0-or-later"
extensions = ["myst_parser", "sphinx.ext.autodoc", "sphinx.ext.mathjax"]
master_doc = root_doc = "docs/index"
source_suffix = {".md": "markdown"}
myst_heading_anchors = 4
# Pictures whose width is given; equations between dollars, as forges have them.
myst_enable_extensions = ["html_image", "dollarmath"]
autodoc_typehints = "none"  # they stand in the signatures' own text

lexers["lammps"] = TextLexer()

html_theme = "furo"
html_title = "magfsi"
html_theme_options = {"dark_css_variables": theme.dark_colours()}
html_static_path = ["site"]
html_css_files = ["site.css"]
html_search_scorer = str(TOP / "docs/site/scorer.js")
html_show_sourcelink = False
html_scaled_image_link = False  # a picture of the front page leads to its tutorial, not to its file

# Equations are drawn by Debian's MathJax 2, which make_site.py puts into the site: as SVG, for
# which it needs no fonts (Firefox refuses those of pages from a folder). MathML needs nothing, but
# looks as the reader's fonts are; pictures by LaTeX need half a gigabyte to be made, and are black
# on dark paper.
mathjax_path = "mathjax/MathJax.js"
myst_update_mathjax = False  # its settings are for MathJax 3
mathjax2_config = {"config": ["TeX-AMS_SVG.js"], "showMathMenu": False, "messageStyle": "none",
                   "tex2jax": {"inlineMath": [["\\(", "\\)"]], "displayMath": [["\\[", "\\]"]],
                               "processClass": "math", "ignoreClass": "document"},
                   "SVG": {"font": "TeX", "scale": 92, "linebreaks": {"automatic": True}}}

# Pages are those of readers; the tests' and adapters' own READMEs are for developers.
exclude_patterns = ["adapters", "tests", "structure", "fluid_lbm", "coupler", "build", "runs",
                    "packaging", ".*"]
suppress_warnings = ["myst.header"]


def add_search(app, page, *_):
    if page == "search":
        app.add_js_file("texts.js")
        app.add_js_file("search.js")


def mend_theme(app, error):
    if error is None:
        theme.mend(Path(app.outdir) / "_static")


def setup(app):
    app.connect("build-finished", mend_theme)
    app.connect("html-page-context", add_search)
