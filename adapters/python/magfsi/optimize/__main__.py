# SPDX-License-Identifier: GPL-2.0-or-later
"""magfsi optimize: searches the settings of a scene for the best of an objective."""
import argparse
import sys
from pathlib import Path

from magfsi import runs
from magfsi.ending import EXIT_ERROR, ended_well
from magfsi.optimize import result
from magfsi.optimize.search import Missing, Searching
from magfsi.optimize.search_file import read_search
from magfsi.study import marked


def arguments():
    parser = argparse.ArgumentParser(
        prog="magfsi optimize", description=__doc__,
        epilog="Runs that are done are kept in OUT/runs; the same command goes on where it ended. "
               "docs/optimize.md says what a search file holds.")
    parser.add_argument("search", type=Path, help="search file")
    parser.add_argument("--out", type=Path, help="runs and results (default: runs/search_NAME)")
    parser.add_argument("--runs", type=int, metavar="N", help="so many, whatever the file says")
    parser.add_argument("--set", type=runs.setting, action="append", default=[], metavar="KEY=VALUE",
                        help="override a value of the scene, in all runs")
    parser.add_argument("--search-only", action="store_true",
                        help="leave out what follows the search: finer runs of the best, the check")
    parser.add_argument("--draw", type=Path, metavar="FOLDER",
                        help="search nothing: draw FOLDER/search.png anew from its runs.csv")
    chosen = parser.parse_args()
    if chosen.runs is not None and chosen.runs < 1:
        parser.error(f"--runs: found {chosen.runs}; allowed are whole numbers from 1")
    return chosen


def asked(chosen):
    """The search of the file, as the command line has it."""
    search = read_search(chosen.search)
    search.sets |= dict(chosen.set)
    search.runs = chosen.runs or search.runs
    if chosen.search_only:
        search.finer = search.check = None
    return search


def main():
    chosen = arguments()
    search = asked(chosen)
    out = chosen.out or Path("runs") / f"search_{search.name}"
    if chosen.draw:
        points = result.read_points(search, chosen.draw / "runs.csv")
        best = result.ranked(points, search)
        shapes = result.shapes_of(search, best[0], out) if best else None
        result.draw(search, points, chosen.draw / "search.png", shapes)
        print(chosen.draw / "search.png")
        return
    try:
        points = Searching(search, out).go()
    except Missing as error:
        print(error, file=sys.stderr)
        sys.exit(EXIT_ERROR)
    some = result.finalists(search, points, out)
    result.write_runs(search, points, out / "runs.csv")
    text = result.page(search, points, some)
    (out / "results.md").write_text(text)
    if some:
        result.best_scene(search, some[0].point, out / "best.yaml")
        shapes = result.shapes_of(search, some[0].point, out)
        result.draw(search, points, out / "search.png", shapes)
    print("\n" + text)
    print(f"{out}/results.md, runs.csv" + (", best.yaml, search.png" if some else ""))


if __name__ == "__main__":
    ended_well(main, "magfsi optimize", marked.InputError)
