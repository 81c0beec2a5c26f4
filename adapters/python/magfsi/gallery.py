# SPDX-License-Identifier: GPL-2.0-or-later
"""./magfsi gallery [--runs DIR] [--out docs/index.html]: a page with every tutorial: what happens, a
picture, what it cost, and the page of its run beside it. Runs those that are not there."""
import argparse
import html
import os
import re
import subprocess
import sys
from pathlib import Path

from magfsi import runs
from magfsi.report import data
from magfsi.report.__main__ import write

TUTORIALS = runs.ROOT / "tutorials"
STYLE = """:root { --paper: #fff; --ink: #1a1a1a; --grey: #5c5c5c; --soft: #f4f4f4; color-scheme: light dark; }
@media (prefers-color-scheme: dark) { :root { --paper: #16181b; --ink: #e8e8e8; --grey: #a8a8a8; --soft: #202327; } }
* { box-sizing: border-box; }
body { margin: 0 auto; max-width: 1400px; padding: 0 16px 40px; background: var(--paper); color: var(--ink);
  font: 15px/1.45 system-ui, sans-serif; }
main { display: grid; gap: 24px; grid-template-columns: repeat(auto-fill, minmax(min(340px, 100%), 1fr)); }
article { background: var(--soft); border-radius: 6px; overflow: hidden; }
article img { display: block; width: 100%; aspect-ratio: 4 / 3; object-fit: cover; }
article div { padding: 4px 14px 14px; } h2 { font-size: 1.15em; margin: 8px 0; } p { margin: 6px 0; }
.grey { color: var(--grey); font-size: .9em; } a { color: inherit; }"""


def tutorials():
    return sorted(folder.name for folder in TUTORIALS.iterdir() if (folder / "scene.yaml").exists())


def about(tutorial):
    """(title, first paragraph) of its README, as plain text."""
    blocks = (tutorial / "README.md").read_text().split("\n\n")
    title = blocks[0].splitlines()[0].lstrip("# ")
    text = " ".join(blocks[1].split())
    return title, re.sub(r"\[([^\]]*)\]\([^)]*\)|\*\*?|`", lambda m: m.group(1) or "", text)


def made(name, folder, settings):
    """The run folder, made where it is not there or did not end well."""
    if data.read_json(folder / "summary.json", {}).get("outcome") == "completed":
        return True
    print(f"{name}: runs", flush=True)
    done = runs.run(TUTORIALS / name, folder, settings, more=("--overwrite",))
    if done.code != 0:
        print(f"{name}: {done.error()}", file=sys.stderr)
    return done.code == 0


def draw(folder, picture):
    """A frame of its film: render's picture, at three quarters of the run."""
    times = [t for t, _ in runs.frames(folder)]
    at = f"{0.75 * times[-1]:.9g} s"
    subprocess.run([sys.executable, "-P", "-m", "magfsi.render", str(folder), "--time", at,
                    "--size", "960x720", "--out", str(picture)], check=True,
                   stdout=subprocess.DEVNULL)


def cost(folder):
    summary = runs.read_summary(folder)
    starts = data.read_json(folder / "run.json", [{}])
    ranks = ", ".join(f"{side} {n}" for side, n in starts[-1].get("ranks", {}).items())
    seconds = summary["wall_s"]
    parts = [f"{seconds:.0f} s" if seconds >= 100 else f"{seconds:.1f} s", f"{summary['steps']} steps",
             f"ranks: {ranks}", starts[-1].get("machine", "")]
    return " · ".join(part for part in parts if part)


def card(title, text, name, cost_, beside):
    words = {key: html.escape(value) for key, value in
             {"title": title, "text": text, "cost": cost_, "page": f"{beside}/{name}.html",
              "picture": f"{beside}/{name}.png"}.items()}
    return ('<article><a href="{page}"><img src="{picture}" alt="{title}"></a><div>'
            '<h2><a href="{page}">{title}</a></h2><p>{text}</p><p class="grey">{cost}</p></div>'
            "</article>").format(**words)


def assemble(cards):
    return ('<!DOCTYPE html>\n<html lang="en">\n<head>\n<meta charset="utf-8">\n<meta name="viewport" '
            'content="width=device-width, initial-scale=1">\n<title>magfsi: gallery</title>\n'
            f"<style>{STYLE}</style>\n</head>\n<body>\n<h1>magfsi: the tutorials</h1>\n<p>Each picture "
            "leads to the page of its run: the robot to turn and play, curves, checks, and how to "
            "run it again.</p>\n<main>\n" + "\n".join(cards) + "\n</main>\n</body>\n</html>\n")


def main():
    options = argparse.ArgumentParser(prog="magfsi gallery", description=__doc__.split("\n")[0])
    options.add_argument("--runs", type=Path, default=Path("runs/gallery"),
                         help="where the runs are, or are made")
    options.add_argument("--out", type=Path, default=runs.ROOT / "docs/index.html")
    options.add_argument("--only", nargs="*", metavar="NAME", help="of these tutorials alone")
    options.add_argument("--set", type=runs.setting, action="append", default=[], metavar="KEY=VALUE",
                         help="for every run, such as time.end='20 ms'")
    chosen = options.parse_args()
    settings = dict(chosen.set)
    names = tutorials()
    unknown = sorted(set(chosen.only or []) - set(names))
    if unknown:
        options.error(f"--only: found {', '.join(unknown)}; allowed are {', '.join(names)}")
    os.environ.setdefault("OMPI_ALLOW_RUN_AS_ROOT", "1")
    os.environ.setdefault("OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "1")
    beside = chosen.out.parent / "gallery"
    beside.mkdir(parents=True, exist_ok=True)
    cards, missing = [], []
    for name in [n for n in names if not chosen.only or n in chosen.only]:
        folder = chosen.runs / name
        if not made(name, folder, settings):
            missing.append(name)
            continue
        write([folder], beside / f"{name}.html")
        draw(folder, beside / f"{name}.png")
        cards.append(card(*about(TUTORIALS / name), name, cost(folder), beside.name))
        print(f"{name}: {cost(folder)}", flush=True)
    chosen.out.write_text(assemble(cards))
    print(f"{chosen.out}: {len(cards)} tutorials" + (f", without {', '.join(missing)}" if missing else ""))
    return 1 if missing else 0


if __name__ == "__main__":
    sys.exit(main())
