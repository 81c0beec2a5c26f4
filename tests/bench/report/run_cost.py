# SPDX-License-Identifier: GPL-2.0-or-later
"""What the page after a run costs the run: seconds until `./magfsi run` returns, with the page and
without it, in turns. Nothing is recorded for it while the run goes on, and it is written by a
process of its own; each run waits here for the page of the one before.
    ./magfsi python tests/bench/report/run_cost.py [--pairs 9]"""
import argparse
import os
import statistics
import subprocess
import sys
import time
from pathlib import Path

from magfsi import testing

ALLOWED = 0.02


def seconds(scene, page):
    """Wall time of the run alone."""
    folder = Path(testing.new_folder())
    command = [testing.ROOT / "magfsi", "run", scene, "--out", folder]
    began = time.perf_counter()
    done = subprocess.run(list(map(str, command)) + EXTRA[scene], capture_output=True, text=True,
                          env={**os.environ, "MAGFSI_PAGE": page, "MAGFSI_INSTALL": "no"})
    taken = time.perf_counter() - began
    if done.returncode != 0:
        raise SystemExit(done.stderr)
    until = time.monotonic() + 300
    while page == "yes" and not (folder / "report.html").exists():
        if time.monotonic() > until:
            raise SystemExit(f"no page in {folder}")
        time.sleep(0.05)
    time.sleep(0.2)  # and its process has ended
    return taken


EXTRA = {"tutorials/beam": [], "tutorials/swimmer": ["--set", "time.end=20 ms"]}


def main():
    options = argparse.ArgumentParser(description=__doc__,
                                      formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("--pairs", type=int, default=9)
    chosen = options.parse_args()
    os.chdir(testing.ROOT)
    slowed = []
    for scene in EXTRA:
        taken = {"yes": [], "no": []}
        seconds(scene, "no")  # what is read from disk for the first time
        for pair in range(chosen.pairs):
            for page in ("yes", "no") if pair % 2 else ("no", "yes"):
                taken[page].append(seconds(scene, page))
        more = [a / b - 1 for a, b in zip(taken["yes"], taken["no"])]
        quarters = statistics.quantiles(more, n=4)
        print(f"{scene}: {statistics.median(taken['no']):.3f} s without, "
              f"{statistics.median(taken['yes']):.3f} s with; of {chosen.pairs} pairs the median "
              f"{100 * quarters[1]:+.2f} % (half of them {100 * quarters[0]:+.2f} to "
              f"{100 * quarters[2]:+.2f} %); allowed {100 * ALLOWED:g} %; load "
              f"{os.getloadavg()[0]:.1f}", flush=True)
        if quarters[1] > ALLOWED:
            slowed.append(scene)
    return 1 if slowed else 0


if __name__ == "__main__":
    sys.exit(main())
