# SPDX-License-Identifier: GPL-2.0-or-later
"""./magfsi film RUN [--out film.mp4]: a run as a film, in the view of its page."""
import shutil
import subprocess
import sys
from pathlib import Path

import numpy as np

from magfsi import plotting
from magfsi.drawing import options
from magfsi.drawing.stage import ensure_display


def encoder(out, size, rate):
    """ffmpeg, that takes pictures on its standard input. H.264 in 4:2:0 plays everywhere."""
    command = ["ffmpeg", "-hide_banner", "-loglevel", "error", "-y", "-f", "rawvideo", "-pix_fmt",
               "rgb24", "-s", f"{size[0]}x{size[1]}", "-r", str(rate), "-i", "-", "-an", "-c:v",
               "libx264", "-pix_fmt", "yuv420p", "-crf", "20", "-movflags", "+faststart",
               "-f", "mp4", str(out)]
    return subprocess.Popen(command, stdin=subprocess.PIPE, stderr=subprocess.PIPE)


def write(stage, out, rate, seconds, ends):
    """Of the run between these times, as far as it goes; returns how many pictures. Raises RuntimeError
    with what ffmpeg says."""
    beside = out.with_name(out.name + ".tmp")
    process = encoder(beside, stage.size, rate)
    first, last = (min(max(at, stage.times()[0]), stage.times()[1]) for at in ends)
    count = max(2, round(rate * seconds))
    try:
        for time in np.linspace(first, last, count):
            process.stdin.write(np.ascontiguousarray(stage.draw(time)).tobytes())
    except BrokenPipeError:
        pass  # it has ended, and says why
    _, said = process.communicate()
    if process.returncode != 0:
        beside.unlink(missing_ok=True)
        says = "; ".join(said.decode(errors="replace").strip().splitlines())
        raise RuntimeError(f"{out}: ffmpeg ended with code {process.returncode}: {says}")
    beside.replace(out)
    return count


def even(size):
    return tuple(n - n % 2 for n in size)  # 4:2:0 halves both


def main():
    asked = options.parser("film", __doc__, "page", "magnetisation", (1280, 720))
    asked.add_argument("--out", type=Path, help="the film, MP4 (default: film.mp4 in RUN)")
    asked.add_argument("--seconds", type=float, default=10, help="how long it plays")
    asked.add_argument("--rate", type=int, default=25, help="pictures a second")
    asked.add_argument("--from", dest="begin", type=plotting.seconds, default=0.0, metavar="TIME",
                       help="where it begins, as '20 ms'")
    asked.add_argument("--to", dest="end", type=plotting.seconds, default=float("inf"), metavar="TIME",
                       help="where it ends")
    chosen = asked.parse_args()
    if not chosen.begin < chosen.end:
        asked.error("--from: allowed is what comes before --to")
    chosen.size = even(chosen.size)
    if not (0 < chosen.seconds <= 600 and 1 <= chosen.rate <= 60):
        asked.error("--seconds: allowed is up to 600; --rate: 1 to 60")
    out = chosen.out or chosen.run / "film.mp4"
    if not shutil.which("ffmpeg"):
        print("magfsi film: there is no ffmpeg; install it with: apt-get install ffmpeg",
              file=sys.stderr)
        return 1

    def work():
        count = write(options.staged(chosen), out, chosen.rate, chosen.seconds, (chosen.begin, chosen.end))
        print(f"{out}: {count} pictures, {chosen.seconds:g} s")
        return 0

    ensure_display()
    return options.guarded("film", work)


if __name__ == "__main__":
    sys.exit(main())
