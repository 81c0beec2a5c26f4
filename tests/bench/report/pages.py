# SPDX-License-Identifier: GPL-2.0-or-later
"""Pages in headless Chromium: how soon each opens, and how many frames a second it plays, of every
tutorial and every kind of run, on this machine's software renderer.
    ./magfsi python tests/bench/report/pages.py [--runs runs/gallery] [--only beam gait]
Tutorials' runs that are not in --runs are made first (minutes). The last column counts on a busy
machine too: processor time of all of Chromium for a frame."""
import argparse
import os
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "report"))
import browser  # noqa: E402
import kinds  # noqa: E402
from magfsi import gallery  # noqa: E402

OPENS_IN_S, FRAMES_A_S = 1, 20
PLAYED = 100  # frames


def pages(where, names):
    for name in names:
        if name in kinds.KINDS:
            yield name, kinds.page(kinds.KINDS[name]())
        elif gallery.made(name, where / name, {}):
            yield name, kinds.page(where / name)


def main():
    options = argparse.ArgumentParser(description=__doc__,
                                      formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("--runs", type=Path, default=Path("runs/gallery"))
    everything = gallery.tutorials() + list(kinds.KINDS)
    options.add_argument("--only", nargs="*", choices=everything, default=everything)
    chosen = options.parse_args()
    made, late = list(pages(chosen.runs.resolve(), chosen.only)), []
    print(f"load of the machine: {os.getloadavg()[0]:.1f}")
    print(f"{'page':24} {'MB':>5} {'frames':>7} {'opens [s]':>10} {'frames/s':>9} {'CPU [ms]/frame':>15}")
    with browser.Browser() as chromium:
        for name, page in made:
            opened = chromium.open(f"file://{page}")
            stored = chromium.run("magfsi.view.shapes[0]?.bodies.times.length ?? 0")
            before = chromium.processor_s()
            rate = PLAYED / chromium.run(kinds.PLAY % PLAYED)
            each = 1e3 * (chromium.processor_s() - before) / PLAYED
            print(f"{name:24} {page.stat().st_size / 1e6:5.1f} {stored:7} {opened:10.2f} {rate:9.1f} "
                  f"{each:15.1f}", flush=True)
            for fault in chromium.errors():
                print(f"  console: {fault}")
            if opened > OPENS_IN_S or rate < FRAMES_A_S or chromium.errors():
                late.append(name)
    missing = sorted(set(chosen.only) - {name for name, _ in made})
    print(f"opens within {OPENS_IN_S} s and plays at {FRAMES_A_S} frames/s: "
          + (f"not {', '.join(late + missing)}" if late or missing else f"all {len(made)}"))
    return 1 if late or missing else 0


if __name__ == "__main__":
    sys.exit(main())
