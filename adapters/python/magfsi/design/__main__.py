# SPDX-License-Identifier: GPL-2.0-or-later
"""magfsi design: the magnetisation that gives the shapes that are wanted, in the fields that are given."""
import argparse
import sys
from pathlib import Path

from magfsi import runs
from magfsi.ending import EXIT_ERROR, ended_well
from magfsi.study import marked

EPILOG = """\
a design file:
  scene: scene.yaml                           the body, its mesh, material and clamps
  poses:
    up:                                       any name; as many poses as wanted
      field: [0 mT, 0 mT, 20 mT]              free: direction, or vector, lets it change
      curve: {file: up.csv}                   the centre line, columns x[mm],y[mm],z[mm]
      points: [{at: [20 mm, 2 mm, 0.2 mm], to: [9 mm, 2 mm, 14 mm]}]
      opening: {between: [[..], [..]], distance: 2 mm}
      force: {face: x_min, direction: [0, 0, 1], force: 1 mN}
  magnetization: {strength: 60 kA/m, plane: xz}

tutorials/letter/design.yaml is one. The same command goes on where it ended.
docs/design.md says all that a design file may hold."""


def arguments():
    parser = argparse.ArgumentParser(prog="magfsi design", description=__doc__,
                                     epilog=EPILOG, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("design", type=Path, help="design file")
    parser.add_argument("--out", type=Path, help="results (default: runs/design_NAME)")
    parser.add_argument("--set", type=runs.setting, action="append", default=[], metavar="KEY=VALUE",
                        help="override a value of the scene")
    parser.add_argument("--quantize", type=int, metavar="N",
                        help="the nearest design of N vectors, optimised again, too")
    parser.add_argument("--overwrite", action="store_true", help="begin anew")
    parser.add_argument("--check", action="store_true", help="one clear error, or \"good\"")
    parser.add_argument("--explain", action="store_true", help="what there is to find, and start nothing")
    chosen = parser.parse_args()
    if chosen.quantize is not None and chosen.quantize < 1:
        parser.error(f"--quantize: found {chosen.quantize}; allowed are whole numbers from 1")
    return chosen


def main():
    chosen = arguments()
    # Behind the arguments: --help needs no numpy.
    from magfsi.design import work
    from magfsi.design.design_file import read_design
    from magfsi.design.problem import Problem

    wanted = read_design(chosen.design)
    wanted.sets |= dict(chosen.set)
    if chosen.check or chosen.explain:
        with Problem(wanted, processes=1) as problem:
            print(work.explained(problem) if chosen.explain else f"{chosen.design}: good")
        return
    out = chosen.out or Path("runs") / f"design_{wanted.name}"
    try:
        print(work.design(wanted, out, chosen.quantize, chosen.overwrite, shown=True).text)
    except work.Lost as error:
        print(f"magfsi design: {error}", file=sys.stderr)
        sys.exit(EXIT_ERROR)


if __name__ == "__main__":
    ended_well(main, "magfsi design", marked.InputError)
