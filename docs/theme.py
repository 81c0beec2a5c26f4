# SPDX-License-Identifier: GPL-2.0-or-later
"""What the packages of Furo in Debian 12 and 13 lack, which are built without its own tools: the script
asks for its other half as a module (refused to pages from a folder), the first style sheet stands where
a Debian web server has it, and dark mode comes by the button but not by the reader's system."""
import re
from pathlib import Path

import furo

STATIC = Path(furo.__file__).parent / "theme/furo/static"
NORMALIZE = Path("/usr/share/javascript/normalize.css/normalize.css")


def dark_colours():
    """{name: colour} of Furo's dark mode, which conf.py gives back to it as our own: those it uses both
    by the button and by the system."""
    style = (STATIC / "styles/furo.css").read_text()
    block = re.search(r'body\[data-theme="?dark"?\]\s*\{(.*?)\}', style, re.S)
    return dict(re.findall(r"--([\w-]+):\s*([^;}]+?)\s*(?=[;}])", block[0]))


def mend(static):
    """In the made site's _static."""
    script = static / "scripts/furo.js"
    text, imports = re.subn(r'^import .*"\./gumshoe-patched\.js";\n', "", script.read_text())
    if imports:
        script.write_text((static / "scripts/gumshoe-patched.js").read_text() + text)
        for page in static.parent.rglob("*.html"):
            text = page.read_text()
            page.write_text(re.sub(r'<script [^>]*scripts/furo\.js[^>]*>',
                                   lambda tag: tag[0].replace(' type="module"', ""), text))
    style = static / "styles/furo.css"
    style.write_text(re.sub(r"^@import url\(/javascript/normalize\.css/.*?\);",
                            lambda _: NORMALIZE.read_text(), style.read_text()))
