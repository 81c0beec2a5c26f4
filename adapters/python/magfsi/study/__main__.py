# SPDX-License-Identifier: GPL-2.0-or-later
"""magfsi study: runs a scene over a product of settings, and what accuracy costs in time."""
import argparse
import shlex
import sys
from pathlib import Path

from magfsi.ending import ended_well
from magfsi.study import findings, marked, norms, product, store, tables
from magfsi.study.study_file import read_study



def arguments():
    parser = argparse.ArgumentParser(
        prog="magfsi study", description=__doc__,
        epilog="Runs that are done are kept in OUT/runs and not done again. docs/accuracy has "
               "the shipped studies and says what a study file holds.")
    parser.add_argument("study", type=Path, help="study file, or a folder with a study.yaml")
    parser.add_argument("--out", type=Path, help="runs and results (default: runs/study_NAME)")
    parser.add_argument("--results", type=Path,
                        help="folder for runs.csv, figure.png, results.md (default: OUT)")
    parser.add_argument("--draw", type=Path, metavar="FOLDER",
                        help="run nothing: draw FOLDER/figure.png anew from its runs.csv")
    parser.add_argument("--list", action="store_true", help="print the runs, and run nothing")
    parser.add_argument("--only", action="append", metavar="AXIS=VALUE", default=[],
                        help="only the runs with this value, in the study file's words; may be "
                        "given again, also for the same axis")
    parser.add_argument("--again", action="store_true", help="repeat all runs")
    return parser.parse_args()


def _only(words, study):
    """The study's cells with the values that the words name."""
    wanted = {}
    for word in words:
        axis, _, label = word.partition("=")
        labels = [s.label for s in study.axes[axis].settings] if axis in study.axes else []
        if label not in labels:
            allowed = f"{axis}= one of {'; '.join(labels)}" if labels else (
                f"AXIS=VALUE with an axis of {', '.join(study.axes)}")
            raise marked.InputError(f'--only: found "{word}"; allowed {allowed}')
        wanted.setdefault(axis, []).append(label)
    found = [cell for cell in product.cells(study)
             if all(cell.label(axis) in labels for axis, labels in wanted.items())]
    if not found:
        raise marked.InputError(f"--only: found no run with {', '.join(words)}; allowed values "
                                "that the study does not skip")
    return found


def _list(planned):
    for run in planned:
        state = run.record.get("outcome") or ("done" if store.is_done(run) else "to do")
        print(f"{state}: {run.cell.text()}")


def _conclude(study, planned, results):
    # matplotlib is slow to start, and mistakes are to be reported at once
    from magfsi.study import figure
    findings.add_errors(study, planned)
    results.mkdir(parents=True, exist_ok=True)
    tables.write_csv(study, planned, results / "runs.csv")
    drawn = figure.draw(study, planned, results / "figure.png")
    words = ["./magfsi", "study", *sys.argv[1:]]
    page = tables.page(study, planned, shlex.join(words))
    if not drawn:
        page = page.replace("\n![Error against seconds](figure.png)\n", "")
    (results / "results.md").write_text(page)
    print(page)
    print(f"{results}/runs.csv, results.md" + (", figure.png" if drawn else ""))


def main():
    chosen = arguments()
    study = read_study(chosen.study)
    if chosen.draw and not chosen.list:
        from magfsi.study import figure
        figure.draw(study, tables.read_csv(study, chosen.draw / "runs.csv"), chosen.draw / "figure.png")
        print(chosen.draw / "figure.png")
        return
    out = chosen.out or Path("runs") / f"study_{study.name}"
    planned = store.plan(study, _only(chosen.only, study), out)
    if chosen.list:
        _list(planned)
        return
    store.do(store.scene_file(study.scene), study.limit_s, planned,
             lambda run: norms.check_probes(study, run), chosen.again)
    _conclude(study, planned, chosen.results or out)


if __name__ == "__main__":
    ended_well(main, "magfsi study", marked.InputError)
