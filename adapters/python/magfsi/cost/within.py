# SPDX-License-Identifier: GPL-2.0-or-later
"""magfsi run --error: finds the cheapest setting within a tolerance, runs it, and adds to its
summary each probe with its error bar. magfsi run calls this."""
import argparse
import json
import shlex
import sys
from pathlib import Path

import numpy as np

from magfsi import runs
from magfsi.cost import __main__ as options
from magfsi.cost import command, probes, report
from magfsi.ending import EXIT_ERROR, ended_well
from magfsi.study.norms import NoError


def arguments():
    parser = options.Parser(prog="magfsi run", description=__doc__)
    options.add_options(parser)
    parser.add_argument("--error", type=options.share, required=True)
    parser.add_argument("--out", type=Path)
    parser.add_argument("--overwrite", action="store_true")
    return parser.parse_args()


def _setting(chosen):
    """(Result, Advice) of the scene; raises CannotRun where nothing is promised."""
    wish = options.wish_of(argparse.Namespace(**{**vars(chosen), "out": None}))
    wish.tolerances = (chosen.error,)
    wish.out = options.default_out(wish)
    result = command.planned(wish)
    command.do(result, wish)
    command.conclude(result, wish)
    options.write(result, wish.out)
    advice = result.advice[0]
    if not advice.setting:
        raise NoPromise(f"magfsi run: no tolerance of {report.percent(chosen.error)} is promised: "
                        f"{advice.why}; {wish.out}/cost.txt has more, and without --error the "
                        "scene runs as it is")
    return result, advice


class NoPromise(Exception):
    """The tolerance cannot be met, or the fit does not hold."""


def _bars(result, advice, folder):
    """{column: value and bar} of the run."""
    sizes = command.advising.sizes_of(result.scene.parameters, advice.setting)
    run = argparse.Namespace(folder=folder, cell=argparse.Namespace(settings={}))
    out = {}
    for p in result.probes:
        try:
            value, scale = probes.value(run, probes.norm_of(p.column, p.norm, result.start_s))
        except NoError:
            continue
        errors, bars = p.fit.errors(sizes)
        share = float(np.abs(errors[0]) + bars[0] + p.scatter_bar) / p.scale
        out[p.column] = {"norm": p.norm, "value": value, "bar": share * scale}
        if p.faults:
            out[p.column] = {"norm": p.norm, "value": value, "bar": None, "doubt":
                             f"{p.faults[0].parameter}: {p.faults[0].why}"}
    return out


def _note(result, advice, folder, tolerance):
    path = folder / "summary.json"
    summary = json.loads(path.read_text())
    bars = _bars(result, advice, folder)
    summary["accuracy"] = {
        "error": tolerance, "probes_within": [p.column for p in result.headline],
        "setting": report.described(result.scene, advice.setting),
        "found_on": result.length_words, "probes": bars}
    part = path.with_suffix(".part")
    part.write_text(json.dumps(summary, indent=2) + "\n")
    part.replace(path)
    for p in result.headline:
        found = bars.get(p.column)
        if found:
            print(f"{p.column}, {p.norm}: {found['value']:.5g} +- {found['bar']:.2g}")


def main():
    chosen = arguments()
    result, advice = _setting(chosen)
    scene = result.scene
    print(f"within {report.percent(chosen.error)}: {report.described(scene, advice.setting)}; "
          f"predicted {report.duration(advice.seconds)}", flush=True)
    # What the probing runs leave out, fields and states, this one has.
    sets = {k: v for k, v in scene.variant(advice.setting).sets.items()
            if k not in ("output", "checkpoint")} | dict(chosen.set)
    if "accuracy" in scene.scene_keys:
        sets["accuracy"] = ""
    folder = chosen.out or Path("runs") / scene.facts["name"]
    more = ["--overwrite"] if chosen.overwrite else []
    ended = runs.run(chosen.scene, folder, sets, chosen.ranks, more=more)
    sys.stdout.write(ended.out)
    sys.stderr.write(ended.err)
    if ended.code == 0:
        _note(result, advice, folder, chosen.error)
        print(shlex.join(["./magfsi", "run", str(chosen.scene), *runs.overrides(sets)])
              + " is this run without looking for it")
    sys.exit(ended.code)


if __name__ == "__main__":
    try:
        ended_well(main, "magfsi cost", options.REFUSALS)
    except NoPromise as why:
        print(why, file=sys.stderr)
        sys.exit(EXIT_ERROR)
