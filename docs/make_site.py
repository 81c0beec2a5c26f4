# SPDX-License-Identifier: GPL-2.0-or-later
"""Builds the documentation as a site, with the pages that are made: docs/scene_examples.md (an example
of every key) and docs/cpp_reference.md (the headers of the installed libraries). The sidebar has the
headings and links of docs/index.md. The site needs neither network nor server: its equations are drawn
by the copy of MathJax in it, and what a search shows of pages comes from a file of their texts.

    ./magfsi python docs/make_site.py OUT       OUT/html/index.html; any warning is an error

Needs furo, libjs-mathjax, python3-sphinx and python3-myst-parser (packages-tests.txt).
"""
import json
import os
import re
import shutil
import subprocess
import sys
from html.parser import HTMLParser
from pathlib import Path

import yaml

from magfsi import runs

TOP = Path(__file__).resolve().parents[1]
MATHJAX = Path("/usr/share/javascript/mathjax")
# What equations in TeX that become SVG with TeX's letters take of its 38 MB.
OF_MATHJAX = ("MathJax.js", "config/TeX-AMS_SVG.js", "extensions/TeX", "extensions/*.js",
              "jax/element", "jax/input/TeX", "jax/output/SVG/*.js", "jax/output/SVG/autoload",
              "jax/output/SVG/fonts/TeX")
EXAMPLES = ("tutorials", "docs/examples", "docs/howto")
HEADERS = {
    "Your own structure beside the fluid": ["adapters/structure_program.h",
                                            "coupler/scheme/structure_solver.h"],
    "A fluid of your own": ["coupler/immersed_boundary/grid.h"],
    "Scenes": ["adapters/scene/reader.h", "adapters/scene/scene.h", "coupler/options.h"],
    "The coupled run": ["coupler/participants/session.h", "coupler/participants/world.h",
                        "coupler/participants/handshake.h", "coupler/scheme/structure_coupling.h",
                        "coupler/scheme/fluid_coupling.h"],
    "The lattice-Boltzmann fluid": ["fluid_lbm/fluid.h", "fluid_lbm/config.h", "fluid_lbm/options.h"],
    "The magttice": ["structure/body.h", "structure/lattice/lattice.h",
                     "structure/equilibrium/newton.h"],
    "The LAMMPS styles": ["structure/lammps/register_styles.h", "structure/lammps/script.h"],
}
# Pages that are made, by the heading of the index below which the site lists them.
MADE = {"Reference": ["docs/scene_examples.md"], "Developers": ["docs/cpp_reference.md"]}
TO_THE_FRONT_PAGE = """<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8"><title>magfsi</title>
<meta http-equiv="refresh" content="0; url=docs/index.html"></head>
<body><a href="docs/index.html">magfsi</a></body></html>
"""
# Lists whose items have the keys of another place.
LIKE_ANOTHER = [("magnetic_field", "plus")]  # magnetic_field
SIDES = [f"{axis}_{end}" for axis in "xyz" for end in ("min", "max")]


def examples():
    """[(file, values)] of the scenes that examples are taken from."""
    files = [file for folder in EXAMPLES for file in sorted((TOP / folder).rglob("*.yaml"))]
    found = [(file, yaml.safe_load(file.read_text())) for file in files]
    return [(file, values) for file, values in found if isinstance(values, dict) and "time" in values]


def keys_of_schema(schema, at=()):
    """Paths of all keys; NAME stands for a name that users give, SIDE for one of the six sides of the
    box, an index is left out."""
    for choice in ("anyOf", "oneOf", "allOf"):
        for part in schema.get(choice, ()):
            yield from keys_of_schema(part, at)
    for key, value in schema.get("properties", {}).items():
        below = (*at, "SIDE" if key in SIDES else key)
        yield below
        if below not in LIKE_ANOTHER:
            yield from keys_of_schema(value, below)
    if isinstance(named := schema.get("additionalProperties"), dict):
        yield from keys_of_schema(named, (*at, "NAME"))
    if isinstance(named := schema.get("patternProperties"), dict):
        for value in named.values():
            yield from keys_of_schema(value, (*at, "NAME"))
    if isinstance(items := schema.get("items"), dict):
        yield from keys_of_schema(items, at)


def find(values, key):
    """The part of a scene's values that leads to a key alone, nested as it is there; None without."""
    if not key:
        return values
    if isinstance(values, list):
        for item in values:
            found = find(item, key)
            if found is not None:
                return [found]
        return None
    if not isinstance(values, dict):
        return None
    wanted = {"NAME": list(values), "SIDE": SIDES}.get(key[0], [key[0]])
    for name in (name for name in wanted if name in values):
        found = find(values[name], key[1:])
        if found is not None:
            return {name: found}
    return None


def example_of(key, scenes):
    """(file, snippet) of the shortest example of a key, or None."""
    found = []
    for file, values in scenes:
        part = find(values, key)
        if part is not None:
            text = yaml.safe_dump(part, sort_keys=False, default_flow_style=None, width=90)
            found.append((len(text), str(file.relative_to(TOP)), text))
    return min(found)[1:] if found else None


def named(file):
    """A scene's file in words."""
    folder, stem = Path(file).parent.name, Path(file).stem.replace("_", " ")
    if not file.startswith("tutorials"):
        return f"example {stem}"
    return f"tutorial {folder}" + ("" if stem == "scene" else f", {stem}")


def scene_examples(schema):
    scenes = examples()
    lines = ["# An example of every key", "",
             "<!-- Made by docs/make_site.py. -->",
             "Each is a part of a scene that `check` calls good, which stands behind it. What a key means "
             "and may be is in [the reference](scene.md).", ""]
    missing, part = [], None
    for key in dict.fromkeys(keys_of_schema(schema)):
        example = example_of(key, scenes)
        if example is None:
            missing.append(".".join(key))
            continue
        if key[0] != part:
            part = key[0]
            lines += [f"## {part}", ""]
        lines += [f"`{'.'.join(key)}` ([{named(example[0])}](../{example[0]}))", "", "```yaml",
                  example[1].rstrip(), "```", ""]
    return "\n".join(lines), missing


def cpp_reference():
    lines = ["# C++ reference", "", "<!-- Made by docs/make_site.py. -->",
             "The headers of the installed libraries that programs begin with; all are below "
             "`include/magfsi`. How they are used: [own structures](own_structure.md), "
             "[a fluid of one's own](adding_a_fluid.md).", ""]
    for title, headers in HEADERS.items():
        lines += [f"## {title}", ""]
        for header in headers:
            text = re.sub(r"\A// SPDX.*\n", "", (TOP / header).read_text())
            lines += [f"### {header}", "", "```cpp", text.rstrip(), "```", ""]
    return "\n".join(lines)


def with_contents(source):
    """The text of docs/index.md and, hidden below it, what Sphinx makes the sidebar of: for each heading
    the pages that its items begin with, and a list of all other pages. In the index itself a forge would
    show these directives as code."""
    index = source / "docs/index.md"
    text = index.read_text()
    lists = {}
    for part in text.split("\n## ")[1:]:
        heading, _, body = part.partition("\n")
        items = "".join(re.findall(r"^- \[.*", body, re.M))
        links = [os.path.normpath(index.parent / link)
                 for link in re.findall(r"\]\(([^)#:]+\.md)\)", items)]
        pages = [os.path.relpath(link, source) for link in links] + MADE.get(heading, [])
        listed = {page for above in lists.values() for page in above}
        lists[heading] = [page for page in dict.fromkeys(pages) if page not in listed]
    listed = {"docs/index.md", *(page for pages in lists.values() for page in pages)}
    files = [*source.glob("*.md"), *(source / "docs").rglob("*.md"), *(source / "tutorials").rglob("*.md")]
    lists["More pages"] = sorted({str(file.relative_to(source)) for file in files} - listed)
    for heading, pages in ((heading, pages) for heading, pages in lists.items() if pages):
        names = "\n".join("/" + page.removesuffix(".md") for page in pages)
        text += f"\n```{{toctree}}\n:hidden:\n:caption: {heading}\n:maxdepth: 1\n{names}\n```\n"
    return text


def copy_mathjax(static):
    for pattern in OF_MATHJAX:
        for part in MATHJAX.glob(pattern):
            to = static / "mathjax" / part.relative_to(MATHJAX)
            to.parent.mkdir(parents=True, exist_ok=True)
            (shutil.copytree if part.is_dir() else shutil.copy)(part, to)


class Texts(HTMLParser):
    """The text of a page's article, within the sections that have an id: all that a search needs of it
    to show words in their context."""

    def __init__(self):
        super().__init__(convert_charrefs=False)
        self.parts, self.inside, self.skipped = [], 0, 0

    def handle_starttag(self, tag, attributes):
        values = dict(attributes)
        self.inside += tag == "article" or self.inside > 0 and tag == "section"
        self.skipped += tag == "a" and "headerlink" in values.get("class", "").split()
        if self.inside and tag == "section":
            self.parts.append(f'<section id="{values.get("id", "")}">')

    def handle_endtag(self, tag):
        if self.inside and tag == "section":
            self.parts.append("</section>")
        self.inside -= self.inside > 0 and tag in ("article", "section")
        self.skipped -= self.skipped > 0 and tag == "a"

    def handle_data(self, text):
        if self.inside and not self.skipped:
            self.parts.append(re.sub(r"\s+", " ", text))

    def handle_entityref(self, name):
        self.handle_data(f"&{name};")

    def handle_charref(self, name):
        self.handle_data(f"&#{name};")


def write_texts(html):
    """_static/texts.js, from which search.js answers where Sphinx would fetch a page: browsers fetch
    nothing from a folder."""
    texts = {}
    for page in sorted(html.rglob("*.html")):
        reader = Texts()
        reader.feed(page.read_text())
        if reader.parts:
            texts[str(page.relative_to(html))] = '<div role="main">' + "".join(reader.parts) + "</div>"
    (html / "_static/texts.js").write_text(f"window.TEXTS = {json.dumps(texts, ensure_ascii=False)};\n")


def build(out):
    source = out / "source"
    shutil.rmtree(out, ignore_errors=True)
    shutil.copytree(TOP, source, ignore=lambda folder, names: [
        name for name in names if name in (".git", "__pycache__", "shared")
        or Path(folder) == TOP and name in ("build", "runs")])
    schema = json.loads(subprocess.run([runs.BIN / "magfsi", "schema"], capture_output=True,
                                       text=True, check=True).stdout)
    page, missing = scene_examples(schema)
    (source / "docs/scene_examples.md").write_text(page)
    (source / "docs/cpp_reference.md").write_text(cpp_reference())
    (source / "docs/index.md").write_text(with_contents(source))
    copy_mathjax(source / "docs/site")
    words = [sys.executable, "-m", "sphinx", "-q", "-b", "html", "-W", "--keep-going", "-c",
             source / "docs", source, out / "html"]
    done = subprocess.run([str(word) for word in words], capture_output=True, text=True,
                          env={**os.environ, "LC_ALL": "C.UTF-8"})
    if done.returncode == 0:
        write_texts(out / "html")
        (out / "html/index.html").write_text(TO_THE_FRONT_PAGE)
    return done.returncode, done.stdout + done.stderr, missing


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    code, text, missing = build(Path(sys.argv[1]).resolve())
    print(text, end="")
    if missing:
        print("keys without an example:", *missing, sep="\n  ")
    sys.exit(code)
