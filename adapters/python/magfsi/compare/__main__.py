# SPDX-License-Identifier: GPL-2.0-or-later
"""./magfsi compare SCENE runs a scene with both fluids, the lattice and OpenFOAM; ./magfsi compare
RUN1 RUN2 takes two runs. Writes how far they are apart, whether that is within their error bars,
and what each cost: a page, tables and pictures."""
import argparse
import os
import subprocess
from pathlib import Path

from magfsi import runs
from magfsi.compare import differences
from magfsi.compare import sides as reading
from magfsi.cost.variants import Named
from magfsi.ending import ended_well
from magfsi.report import data
from magfsi.study import store

# On the command line what is for one of the two fluids alone has these names.
OPTION_OF = {"lbm": "--lattice", "openfoam": "--openfoam"}
PLANES = ("xy", "xz", "yz")
QUANTITIES = ("speed", "vorticity", "pressure")


class Refused(Exception):
    """Bad input: what was found, and what is allowed."""


class Failed(OSError):
    """A run that did not end well."""


def two_names(text):
    names = [name.strip() for name in text.split(",")]
    if len(names) != 2 or not all(names) or names[0] == names[1]:
        raise argparse.ArgumentTypeError(f"found '{text}'; allowed are two that differ, as "
                                         "coarse,fine")
    return names


def parsed():
    options = argparse.ArgumentParser(
        prog="magfsi compare", description=__doc__,
        usage="magfsi compare (SCENE | RUN1 RUN2) [options]",
        epilog="Runs of a SCENE are kept in OUT/runs and not done again. docs/compare.md says how "
               "the numbers are made.")
    options.add_argument("what", nargs="+", type=Path, metavar="SCENE | RUN1 RUN2",
                         help="scene file or tutorial folder; or two run folders")
    options.add_argument("--out", type=Path, help="folder for what is written (default: "
                         "runs/compare_NAME of a SCENE, compare_RUN2 in RUN1)")
    options.add_argument("--names", type=two_names, metavar="A,B",
                         help="of the two in legends and tables")
    for which in ("first", "second"):
        options.add_argument(f"--bars-{which}", type=Path, metavar="FOLDER",
                             help=f"error bars of the {which}: a result of magfsi cost for the "
                             "same setting (default: what run --error has written)")
    options.add_argument("--field", choices=QUANTITIES, default="speed",
                         help="of the flow (default: %(default)s)")
    options.add_argument("--plane", choices=PLANES, help="in which fields are seen (default: the "
                         "magnetic field's, else xz)")
    scene = options.add_argument_group("of a SCENE")
    scene.add_argument("--set", type=runs.setting, action="append", default=[], metavar="KEY=VALUE",
                       help="override a value of the scene for both")
    for solver, fluid in reading.FLUIDS.items():
        scene.add_argument(OPTION_OF[solver], dest=solver, type=runs.setting, action="append",
                           default=[], metavar="KEY=VALUE",
                           help=f"the same for the run with {fluid} as its fluid")
    scene.add_argument("--ranks", default="", help="MPI ranks: structure=N,fluid=M")
    scene.add_argument("--again", action="store_true", help="repeat runs that are kept")
    return options.parse_args()


def _given(chosen):
    """Options that were given and are of a scene."""
    of_one = {option: getattr(chosen, solver) for solver, option in OPTION_OF.items()}
    values = {"--set": chosen.set, **of_one, "--ranks": chosen.ranks, "--again": chosen.again}
    return [name for name, value in values.items() if value]


def check(chosen):
    """Raises Refused."""
    if len(chosen.what) > 2:
        raise Refused(f"magfsi compare: found {len(chosen.what)} folders; allowed is a scene or "
                      "two run folders; for more than two take ./magfsi report")
    if len(chosen.what) == 1 and (chosen.what[0] / "run.json").exists():
        raise Refused(f"magfsi compare: found one run folder, {chosen.what[0]}; allowed are two, "
                      "or a scene")
    if len(chosen.what) == 2 and _given(chosen):
        raise Refused(f"magfsi compare: found {_given(chosen)[0]} beside two run folders, which "
                      "are there already; allowed is it beside a scene")
    if len(chosen.what) == 2 and chosen.what[0].resolve() == chosen.what[1].resolve():
        raise Refused(f"magfsi compare: found {chosen.what[0]} twice; allowed are two different "
                      "run folders")


# --- both fluids ---

def _scene_facts(chosen):
    """What explain says of the scene; None where it takes settings of one fluid to be good."""
    try:
        return runs.explain(store.scene_file(chosen.what[0]), dict(chosen.set), chosen.ranks,
                            as_json=True)
    except subprocess.CalledProcessError:
        return None


def _planned(chosen, solver, out):
    """The run with that fluid. Raises Refused."""
    sets = {**dict(chosen.set), "fluid.solver": solver, **dict(getattr(chosen, solver))}
    cell = Named({}, sets, chosen.ranks, None, reading.FLUIDS[solver])
    run = store.planned(store.scene_file(chosen.what[0]), cell, out)
    if not run.key:
        raise Refused(f"{run.record['cause']} (with {reading.FLUIDS[solver]} as the fluid; "
                      f"{OPTION_OF[solver]} KEY=VALUE changes the scene for it alone)")
    return run


def with_both_fluids(chosen):
    """Run folders of the lattice and of OpenFOAM, and where results go. Raises Refused and
    Failed."""
    facts = _scene_facts(chosen)
    if facts and "fluid" not in facts["scene"]:
        raise Refused(f"{chosen.what[0]}: found no fluid in the scene; allowed is one with the key "
                      "fluid, or two run folders")
    if facts and "probes" not in facts["scene"]:
        raise Refused(f"{chosen.what[0]}: found no probes in the scene, and so nothing to compare; "
                      "add the key probes")
    name = facts["name"] if facts else store.scene_file(chosen.what[0]).resolve().parent.name
    out = chosen.out or Path("runs") / f"compare_{name}"
    planned = [_planned(chosen, solver, out) for solver in reading.FLUIDS]
    store.do(store.scene_file(chosen.what[0]), None, planned, again=chosen.again)
    for run in planned:
        if not run.completed():
            raise Failed(f"{run.folder}: {run.record['outcome']}: {run.record['cause']}; --again "
                         "repeats the runs, and ./magfsi compare RUN1 RUN2 takes them as far as "
                         "they went")
    return [run.folder for run in planned], out


# --- what is written ---

def read_both(folders, chosen):
    """Raises NotARun."""
    sides = [reading.read(folder) for folder in folders]
    axes = [side.probes.axis[0] for side in sides]
    if axes[0] != axes[1]:
        raise data.NotARun(f"{folders[0]} is over {axes[0]}, {folders[1]} over {axes[1]}; allowed "
                           "are runs over the same")
    for side, bars in zip(sides, (chosen.bars_first, chosen.bars_second)):
        if bars:
            reading.take_bars(side, bars)
    reading.give_names(sides, chosen.names)
    return sides


def write(found, out, quantity, plane):
    """(the files, of which the page comes last; what the two cost in a sentence)."""
    # matplotlib is slow to start, and mistakes are to be told at once
    from magfsi.compare import page, pictures

    out.mkdir(parents=True, exist_ok=True)
    differences.write_csv(found, out / "compare.csv")
    page.write_costs(found, out / "cost.csv")
    curves = pictures.draw_curves(found, out)
    fields, words = pictures.draw_fields(found, out, quantity, plane)
    text = page.assemble(found, curves, fields, words)
    file = out / "compare.html"
    beside = file.with_name(f"{file.name}.{os.getpid()}.tmp")
    beside.write_text(text)
    beside.replace(file)
    pictures_ = [*curves, *([fields] if fields else [])]
    return [out / "compare.csv", out / "cost.csv", *pictures_, file], page.cost_sentence(found)


def main():
    chosen = parsed()
    check(chosen)
    if len(chosen.what) == 1:
        folders, out = with_both_fluids(chosen)
    else:
        folders = chosen.what
        out = chosen.out or folders[0] / f"compare_{folders[1].resolve().name}"
    found = differences.compare(read_both(folders, chosen))
    files, cost = write(found, out, chosen.field, chosen.plane)
    for line in (differences.sentence(found)[1], *differences.endings(found), cost):
        print(line)
    print(f"{files[-1]}, " + ", ".join(file.name for file in files[:-1]))


REFUSALS = Refused, data.NotARun

if __name__ == "__main__":
    ended_well(main, "magfsi compare", REFUSALS)
