# SPDX-License-Identifier: GPL-2.0-or-later
"""./magfsi report RUN... [--out FILE]: one HTML page of one or several run folders."""
import argparse
import os
import sys
from pathlib import Path

from magfsi.report import data, page
from magfsi.runs import EXIT_INPUT

OF_THE_PAGE = 0.35e6  # bytes: its library, its own script, scenes


def thinned(run):
    """What is not all there, in words; empty if all is."""
    shown = run["bodies"]
    if not shown or len(shown["times"]) == shown["stored"]:
        return ""
    return f"{run['folder']}: {len(shown['times'])} of {shown['stored']} frames, for want of room"


def write(folders, out):
    """Returns the runs and the size in bytes. Readers see the page whole or not at all."""
    room = (data.LARGEST_PAGE - OF_THE_PAGE) / len(folders)
    begun = [data.read_json(folder / "run.json", None) for folder in folders]
    found = [data.read_run(folder, room) for folder in folders]
    text = page.assemble(found).encode()
    if begun != [data.read_json(folder / "run.json", None) for folder in folders]:
        raise data.NotARun(f"{folders[0]}: another run has begun in the folder meanwhile; "
                               "./magfsi report it when that has ended")
    beside = out.with_name(f"{out.name}.{os.getpid()}.tmp")
    try:
        beside.write_bytes(text)
        os.replace(beside, out)
    finally:
        beside.unlink(missing_ok=True)
    return found, len(text)


def main():
    options = argparse.ArgumentParser(prog="magfsi report", description=__doc__)
    options.add_argument("runs", nargs="+", type=Path, metavar="RUN", help="run folders")
    options.add_argument("--out", type=Path, help="the page (default: report.html in the first)")
    options.add_argument("--after-run", action="store_true", help=argparse.SUPPRESS)
    chosen = options.parse_args()
    out = chosen.out or chosen.runs[0] / "report.html"
    try:
        found, size = write(chosen.runs, out)
    except (data.NotARun, OSError) as error:
        print(f"magfsi report: {error}", file=sys.stderr)
        return EXIT_INPUT
    for run in found:
        if words := thinned(run):
            print(words)
    print(f"{out}: {size / 1e6:.1f} MB")
    if size > data.LARGEST_PAGE:
        print(f"more than the {data.LARGEST_PAGE / 1e6:.0f} MB that open at once on a phone; take "
              "fewer runs")
    return 0


if __name__ == "__main__":
    sys.exit(main())
