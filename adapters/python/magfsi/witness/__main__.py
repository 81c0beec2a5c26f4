# SPDX-License-Identifier: GPL-2.0-or-later
"""magfsi witness: a run's plane flow solved a second time, by stock pimpleFoam on a mesh that lies
on the body's surface and moves as the run recorded it, with nothing of magfsi in it: forces, moment
and work beside those of the run, with the mesh's own error bar."""
import argparse
import re
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from magfsi import units
from magfsi.ending import EXIT_ERROR, ended_well

CELLS = (6, 9, 13)


def seconds(text):
    value = units.parse(text)
    if not value or value[1] != "s" or not value[0] > 0:
        raise argparse.ArgumentTypeError(f"found '{text}'; allowed is a time such as 60 ms")
    return value[0]


def share(text):
    match = re.fullmatch(r"([0-9.]+) *%", text.strip())
    if not match:
        raise argparse.ArgumentTypeError(f"found '{text}'; allowed is a share such as 5%")
    return float(match.group(1)) / 100


def cells(text):
    try:
        found = [int(word) for word in text.split(",")]
    except ValueError:
        found = []
    if not found or min(found) < 2 or sorted(set(found)) != found:
        raise argparse.ArgumentTypeError(f"found '{text}'; allowed are whole numbers of 2 and more, "
                                         "ascending, as 6,9")
    return found


def arguments(words=None):
    parser = argparse.ArgumentParser(
        prog="magfsi witness", description=__doc__,
        epilog="The run needs output: {structure: {every: ...}}, a hundredth of a period or less, and "
               "probes.bodies: [fluid_force, fluid_torque]. OUT has witness.csv (the table), "
               "series.csv, witness.png and a case of OpenFOAM for each mesh.")
    parser.add_argument("run", type=Path, metavar="RUN", help="a run folder")
    parser.add_argument("--meshes", type=int, choices=(1, 2, 3), default=2,
                        help="number of meshes; the bar is that of the last two (default: 2)")
    parser.add_argument("--cells", type=cells, metavar="N,...",
                        help=f"cells in the strip's thickness, a mesh each (default: {CELLS[0]},{CELLS[1]})")
    parser.add_argument("--end", type=seconds, metavar="TIME",
                        help="of the comparison, as '40 ms' (default: the run's)")
    parser.add_argument("--period", type=seconds, metavar="TIME",
                        help="of the motion (default: that of the field or of the oscillation)")
    parser.add_argument("--run-bar", type=share, metavar="SHARE",
                        help="the run's own error, as 5%% (magfsi cost says it); none without")
    parser.add_argument("--out", type=Path, metavar="FOLDER", help="default: RUN/witness")
    chosen = parser.parse_args(words)
    if chosen.cells is None:
        chosen.cells = list(CELLS[:chosen.meshes])
    chosen.out = chosen.out or chosen.run / "witness"
    return chosen


def say(text):
    print(text, flush=True)


def solve(recorded, chosen, end):
    """[Solution], a mesh each; all to the time that all meshes can follow."""
    from magfsi.witness import flow, foam
    cases = []
    for count in chosen.cells:
        case, reached, fault = flow.prepare(chosen.out / f"mesh_{count}", recorded, count, end, say)
        say(f"{count} cells in the thickness: {case.count} cells, {case.steps} steps of {1e6 * case.step:.3g} us"
            + (f"; the mesh follows to {1e3 * reached:.4g} ms of {1e3 * end:.4g} ms, then {fault}"
               if fault else ""))
        cases.append((case, reached, fault))
    reached, fault = min(((r, f) for _, r, f in cases), key=lambda found: found[0])
    if not reached > 0:
        from magfsi.witness.recorded import Refused
        raise Refused(f"no mesh: {fault}")
    with ThreadPoolExecutor() as pool:
        try:
            return list(pool.map(lambda case: flow.solve(case[0], reached, fault), cases))
        except BaseException:
            foam.stop()
            raise


def work(chosen):
    # matplotlib and VTK are slow to start, and mistakes are to be reported at once.
    from magfsi.witness.recorded import Recorded
    recorded = Recorded(chosen.run, chosen.end, chosen.period)
    end = recorded.time[-1]
    say(f"{recorded.body}: {1e3 * recorded.thickness:.4g} mm thick, moves by up to "
        f"{1e3 * recorded.stroke:.4g} mm to {1e3 * end:.4g} ms; known between {len(recorded.time)} recorded "
        f"shapes to {100 * recorded.between:.2g} %, its area held by moving the surface by up to "
        f"{1e6 * recorded.shift:.2g} um")
    chosen.out.mkdir(parents=True, exist_ok=True)
    solutions = solve(recorded, chosen, end)
    from magfsi.witness import report
    for line in report.write(recorded, solutions, chosen):
        say(line)


def main():
    from magfsi.witness import foam, recorded
    chosen = arguments()
    try:
        work(chosen)
    except foam.Failed as error:
        print(f"magfsi witness: {error}", file=sys.stderr)
        sys.exit(EXIT_ERROR)
    except recorded.Refused as error:
        raise recorded.Refused(f"magfsi witness: {chosen.run}: {error}") from None


def command():
    from magfsi.witness import recorded
    ended_well(main, "magfsi witness", (recorded.Refused,))


if __name__ == "__main__":
    command()
