# SPDX-License-Identifier: GPL-2.0-or-later
"""The page as text: template, style, scripts and data in one file that fetches nothing."""
import base64
import hashlib
import html
import json
import os
from pathlib import Path

from magfsi.report.colours import MAPS, colour_table
from magfsi.report.fields import packed

HERE = Path(__file__).resolve().parent
# Debian's libjs-chart.js; the page holds the whole of it.
CHART = Path(os.environ.get("MAGFSI_CHART_JS", "/usr/share/javascript/chart.js/chart.min.js"))
SCRIPTS = ("colours.js", "view.js", "sources.js", "vortices.js", "curves.js", "panel.js", "page.js")


def as_json(value):
    """For a script element: no text in it can end that."""
    text = json.dumps(value, allow_nan=False, default=float)
    return text.replace("<", "\\u003c").replace("\u2028", "\\u2028").replace("\u2029", "\\u2029")


def hash_of(text):
    """Of a script or a style, for the policy that allows it."""
    return f"'sha256-{base64.b64encode(hashlib.sha256(text.encode()).digest()).decode()}'"


def style():
    return (HERE / "page.css").read_text()


def _library():
    try:
        return CHART.read_text()
    except OSError as error:
        raise FileNotFoundError(f"found no {CHART}; Debian's package libjs-chart.js has it, elsewhere "
                                "the variable MAGFSI_CHART_JS names chart.min.js of Chart.js 3") from error


def _filled(title, data, scripts, more_policy=""):
    """Only the page's own script and style act: their hashes are in its policy."""
    css = style()
    maps = {kind: packed(colour_table(kind), "u1") for kind in MAPS}
    script = "\n" + "\n".join(['"use strict";', _library(), f"const MAPS = {json.dumps(maps)};",
                               *((HERE / name).read_text() for name in scripts)])
    parts = {"TITLE": html.escape(title), "STYLE": css, "SCRIPTS": script, "DATA": data,
             "POLICY": f"style-src {hash_of(css)}; script-src {hash_of(script)}{more_policy}"}
    template = (HERE / "page.html").read_text()
    # In one pass: what is put in may hold such a word itself.
    pieces = template.split("@@")
    return "".join(parts[piece] if i % 2 else piece for i, piece in enumerate(pieces))


def assemble(found):
    return _filled(", ".join(run["name"] for run in found), as_json(found), SCRIPTS)


def live(title):
    """A page that asks the server it comes from for its data."""
    return _filled(title, as_json({"live": True}), (*SCRIPTS, "live.js"), "; connect-src 'self'")
