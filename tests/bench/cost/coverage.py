# SPDX-License-Identifier: GPL-2.0-or-later
"""Does the true error lie within the bar that magfsi cost states? Cases that nothing was fitted to,
with answers that are known otherwise.

    ./magfsi python tests/bench/cost/coverage.py [--out FOLDER] [--only WORD]      an hour

Writes table.md, which docs/accuracy/coverage.md shows: for each case the value's true error and
stated bar, and those of the limit. Runs that are done are kept in FOLDER.
"""
import argparse
import sys
import time
from dataclasses import dataclass
from pathlib import Path

from magfsi.cost import command, probes
from magfsi.cost import result as finding
from magfsi.cost.report import percent
from magfsi.cost.variants import Named
from magfsi.study import store

import moving
import still
from case import Case

CASES = (*still.CASES, *moving.CASES)
command.LIMIT = 50.0  # other work on the machine is no fault of the bars


@dataclass
class Found:
    case: Case
    probe: object = None
    seconds: float = 0.0
    fault: str = ""

    def within(self):
        """Whether the value and the limit lie within their bars, as far as the truth is known."""
        e, bar, limit, limit_bar = self.errors()
        return e <= bar + self.case.known_to, limit <= limit_bar + self.case.known_to

    def errors(self):
        """True error and bar of the value, of the limit; of the truth."""
        p, true = self.probe, self.case.true
        return [x / abs(true) for x in (abs(p.value - true), p.bar, abs(p.limit - true),
                                        p.limit_bar)]


def refer(case, folder):
    """Gives the case its truth by the finer runs, known to what they differ by."""
    scene = folder / "scene.yaml"
    runs = [store.planned(scene, Named({}, sets, "", None, f"reference {number}"), folder)
            for number, sets in enumerate(reversed(case.finer), 1)]
    store.do(scene, None, runs)
    norm = probes.norm_of(case.probe, case.norm, case.start_s)
    other, case.true = (probes.value(run, norm)[0] for run in runs)
    case.known_to = abs(other / case.true - 1)


def examine(case, out):
    folder = out / case.name.replace(" ", "_").replace("/", "_").replace(",", "")
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "scene.yaml").write_text(case.scene)
    if case.finer:
        refer(case, folder)
    wish = command.Wish(folder / "scene.yaml", out=folder, budget_s=case.budget_s,
                        probes=[case.probe], norm=case.norm, start_s=case.start_s)
    began = time.monotonic()
    try:
        result = command.planned(wish)
        if any("time.end" in v.sets for v in result.variants):  # the truth is of the whole
            return Found(case, fault="the budget has room for a leading part only")
        command.do(result, wish)
        probe = finding.analyse(result.scene, result.variants, case.probe, case.norm, case.start_s)
    except (command.making.CannotRun, finding.NoError) as why:
        return Found(case, fault=str(why))
    faults = finding.common_faults(result.scene, result.variants) + probe.faults
    return Found(case, probe, time.monotonic() - began,
                 "; ".join(f"{f.parameter}: {f.why}" for f in faults))


def page(found):
    promised = [f for f in found if f.probe and not f.fault]
    inside = [f for f in promised if f.within()[0]]
    near = [f for f in promised if f.errors()[1] <= 3 * f.errors()[0]]
    limits = [f for f in promised if f.within()[1]]
    lines = ["| case | reference | true error | bar | within | bar over error | limit's true error "
             "| its bar | within |", "|---|---|---|---|---|---|---|---|---|"]
    for f in promised:
        e, bar, limit, limit_bar = f.errors()
        words = ["yes" if inside else "**no**" for inside in f.within()]
        known = f" ({percent(f.case.known_to)})" if f.case.known_to else ""
        lines.append(f"| {f.case.name} | {f.case.reference}{known} | {percent(e)} | {percent(bar)} "
                     f"| {words[0]} | {bar / e:.1f} | {percent(limit)} | {percent(limit_bar)} | "
                     f"{words[1]} |")
    n, of = len(promised), max(1, len(promised))
    lines += ["", f"Of {n} cases for which a bar is stated, the true error of the value lies "
              f"within it in {len(inside)} ({percent(len(inside) / of)}); the bar is at most 3 times "
              f"the error in {len(near)} ({percent(len(near) / of)}); the limit lies within its own bar "
              f"in {len(limits)} ({percent(len(limits) / of)})."]
    doubtful = [f for f in found if f.fault]
    if doubtful:
        lines += ["", "No bar is stated (the fit does not hold, and the command says so):", ""]
    for f in doubtful:
        words = ""
        if f.probe:
            e, bar, *_ = f.errors()
            words = f" True error {percent(e)}; a bar would have been {percent(bar)}."
        lines.append(f"- {f.case.name}: {f.fault}.{words}")
    return "\n".join(lines) + "\n"


def main():
    options = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    options.add_argument("--out", type=Path, default=Path("runs/cost_coverage"))
    options.add_argument("--only", default="", help="cases with this in their name")
    chosen = options.parse_args()
    found = []
    for case in (c for make in CASES for c in make()):
        if chosen.only in case.name:
            found.append(examine(case, chosen.out))
            f = found[-1]
            print(f"{case.name}: " + (", ".join(percent(x) for x in f.errors()) if f.probe else "")
                  + f" {f.fault}", flush=True)
    text = page(found)
    (chosen.out / "table.md").write_text(text)
    print(text)


if __name__ == "__main__":
    sys.exit(main())
