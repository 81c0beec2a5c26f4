# SPDX-License-Identifier: GPL-2.0-or-later
"""What a controller costs: the swimmer with one that returns the scene's own law every 20 coupled steps,
beside the swimmer without, in turns. Processor time of all processes (mpirun, waits and the start of
Python too), of runs of two lengths, so that what is paid once drops out; and the share of its task.

    ./magfsi python tests/bench/control/cost.py [--pairs 5]
"""
import argparse
import statistics
from pathlib import Path

from magfsi import runs, testing

LAW = """
class Controller:
    def step(self, t, probes):
        return {"table": {"time": ["0 ms", "19.5 ms", "32 ms", "40 ms"], "direction": "45 deg",
                          "magnitude": ["-17 mT", "17 mT", "-17 mT", "-17 mT"], "repeat": True}}
"""
SHORT_MS, LONG_MS = 4, 24  # 20 us a step
EVERY = "0.4 ms"


def swum(settings, end_ms):
    ended = runs.run(testing.ROOT / "tutorials/swimmer", testing.new_folder(),
                     {"output": "null", "time.end": f"{end_ms} ms", **settings},
                     ranks="structure=1,fluid=1")
    if ended.code != 0:
        raise SystemExit(ended.err)
    tasks = ended.summary()["tasks"]["structure"]
    return ended.core_s, tasks.get("ask controller", 0.0) / sum(tasks.values())


def main():
    options = argparse.ArgumentParser(description=__doc__)
    options.add_argument("--pairs", type=int, default=5)
    pairs = options.parse_args().pairs
    script = Path(testing.new_folder()) / "steer.py"
    script.write_text(LAW)
    controlled = {"control": f"{{script: {script}, every: {EVERY}, "
                             "probes: [robot.com_x, robot.com_z, robot.speed_z]}"}
    extra, shares = [], []
    for _ in range(pairs):
        spent = {}
        for name, settings in (("without", {}), ("with", controlled)):
            short_s, _ = swum(settings, SHORT_MS)
            long_s, share = swum(settings, LONG_MS)
            spent[name] = long_s - short_s
        extra.append(spent["with"] / spent["without"] - 1)
        shares.append(share)
        print(f"{spent['without']:.2f} s without, {spent['with']:.2f} s with: {100 * extra[-1]:+.2f} %; "
              f"its task {100 * share:.2f} % of the structure's time", flush=True)
    print(f"median: processor time {100 * statistics.median(extra):+.2f} %, "
          f"task {100 * statistics.median(shares):.2f} %")


if __name__ == "__main__":
    main()
