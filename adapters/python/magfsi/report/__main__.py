"""./magfsi report RUN... [--out FILE]: one HTML page of one or several run folders."""
import argparse
import sys
from pathlib import Path

from magfsi.report import data, page
from magfsi.runs import EXIT_INPUT


def main():
    options = argparse.ArgumentParser(prog="magfsi report", description=__doc__)
    options.add_argument("runs", nargs="+", type=Path, metavar="RUN", help="run folders")
    options.add_argument("--out", type=Path, help="the page (default: report.html in the first)")
    chosen = options.parse_args()
    out = chosen.out or chosen.runs[0] / "report.html"
    try:
        # Half of the page for what else it has.
        room = 0.5 * data.LARGEST_PAGE / len(chosen.runs)
        found = [data.read_run(folder, room) for folder in chosen.runs]
        text = page.assemble(found)
        out.write_text(text)
    except (data.NotARun, OSError) as error:
        print(f"magfsi report: {error}", file=sys.stderr)
        return EXIT_INPUT
    for run in found:
        shown, stored = (len(run["bodies"]["times"]), run["bodies"]["stored"]) \
            if run["bodies"] else (0, 0)
        if shown < stored:
            print(f"{run['folder']}: {shown} of {stored} frames, for want of room")
    print(f"{out}: {len(text) / 1e6:.1f} MB")
    return 0


if __name__ == "__main__":
    sys.exit(main())
