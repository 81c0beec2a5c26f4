# SPDX-License-Identifier: GPL-2.0-or-later
"""magfsi cost: what accuracy costs for any scene. Runs cheap variants of it, and tells each
probe's error bar, what it is made of, and the cheapest setting within a tolerance."""
import argparse
from pathlib import Path

from magfsi import runs, units
from magfsi.cost import command, probes, report
from magfsi.cost.variants import CannotRun, seconds
from magfsi.ending import EXIT_INPUT, ended_well
from magfsi.study import store
from magfsi.study.marked import PERCENT



class Parser(argparse.ArgumentParser):
    """Whose errors are one line."""

    def error(self, message):
        self.exit(EXIT_INPUT, f"{self.prog}: {message}\n")


def _time(text):
    found = units.parse(text)
    if not found or found[1] != "s" or found[0] <= 0:
        raise argparse.ArgumentTypeError(f"found '{text}'; allowed a time such as '5 min'")
    return found[0]


def share(text):
    match = PERCENT.match(text.strip())
    try:
        value = float(match.group(1)) / 100 if match else 0
    except ValueError:
        value = 0
    if not 0 < value < 1:
        raise argparse.ArgumentTypeError(f"found '{text}'; allowed a percentage such as '3 %'")
    return value


def add_options(parser):
    parser.add_argument("scene", type=Path, help="scene file or tutorial folder")
    parser.add_argument("--set", type=runs.setting, action="append", default=[], metavar="KEY=VALUE",
                        help="override a value of the scene")
    parser.add_argument("--ranks", default="", help="MPI ranks: structure=N,fluid=M")
    parser.add_argument("--probe", action="append", default=[], metavar="COLUMN",
                        help="a column of probes.csv that the tolerances are for; may be given "
                        "again (default: how bodies move; without bodies, all)")
    parser.add_argument("--norm", choices=probes.NORMS, default="final",
                        help="which number of the probe's course (default: %(default)s)")
    parser.add_argument("--from", type=_time, dest="start", metavar="TIME",
                        help="of the course, what is from here on")
    parser.add_argument("--budget", type=_time, default=300.0, metavar="TIME",
                        help="for all runs together, by the cost model (default: 5 min)")


def arguments():
    parser = Parser(
        prog="magfsi cost", description=__doc__,
        epilog="Runs that are done are kept in OUT/runs and not done again: what was interrupted "
               "goes on. docs/accuracy/cost.md says how it works and where it does not.")
    add_options(parser)
    parser.add_argument("--error", type=share, metavar="SHARE",
                        help="advise for this tolerance, such as '3 %%', as well")
    parser.add_argument("--out", type=Path, help="runs and results (default: runs/cost_NAME)")
    parser.add_argument("--models", action="store_true",
                        help="compare the limits of kernels, forcings, collisions and elements")
    parser.add_argument("--list", action="store_true", help="print the runs, and run nothing")
    return parser.parse_args()


def wish_of(chosen):
    wish = command.Wish(chosen.scene, dict(chosen.set), chosen.ranks, chosen.out,
                        chosen.budget, chosen.probe, chosen.norm, chosen.start)
    if chosen.error:
        wish.tolerances = tuple(sorted({*wish.tolerances, chosen.error}, reverse=True))
    return wish


def default_out(wish):
    facts = command.making.Scene(wish.path, wish.sets, wish.ranks).facts
    return Path("runs") / f"cost_{facts['name']}"


def _list(result):
    for v in result.variants:
        state = "done" if store.is_done(v.run) else "to do"
        print(f"{state}: {seconds(v.facts):.2g} s: {v.text()}")


def write(result, out):
    """The tables, the figure and the text, which is returned."""
    report.write_runs(result, out / "runs.csv")
    report.write_probes(result, out / "cost.csv")
    from magfsi.cost import figure  # matplotlib is slow to start: not before it is needed
    figure.draw(result, out / "figure.png")
    text = report.text(result)
    (out / "cost.txt").write_text(text)
    return text


def main():
    chosen = arguments()
    wish = wish_of(chosen)
    wish.out = wish.out or default_out(wish)
    result = command.planned(wish, dry=chosen.list)
    if chosen.list:
        _list(result)
        return
    if chosen.models:
        from magfsi.cost import models
        text = models.text(models.compare(wish, result))
        (wish.out / "models.txt").write_text(text)
        print("\n" + text)
        return
    command.do(result, wish)
    command.conclude(result, wish)
    print("\n" + write(result, wish.out))
    print(f"{wish.out}/cost.txt, cost.csv, runs.csv, figure.png")


REFUSALS = CannotRun, probes.NoProbe

if __name__ == "__main__":
    ended_well(main, "magfsi cost", REFUSALS)
