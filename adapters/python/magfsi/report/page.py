"""The page as text: template, style, scripts and data in one file that fetches nothing."""
import html
import json
from pathlib import Path

HERE = Path(__file__).resolve().parent
SCRIPTS = ("view.js", "curves.js", "page.js")


def as_json(value):
    """For a script element: no text in it can end that."""
    text = json.dumps(value, allow_nan=False, default=float)
    return text.replace("<", "\\u003c").replace("\u2028", "\\u2028").replace("\u2029", "\\u2029")


def assemble(found):
    title = ", ".join(run["name"] for run in found)
    parts = {"TITLE": html.escape(title), "STYLE": (HERE / "page.css").read_text(),
             "SCRIPTS": "\n".join((HERE / name).read_text() for name in SCRIPTS),
             "DATA": as_json(found)}
    template = (HERE / "page.html").read_text()
    # In one pass: what is put in may hold such a word itself.
    pieces = template.split("@@")
    return "".join(parts[piece] if i % 2 else piece for i, piece in enumerate(pieces))
