# SPDX-License-Identifier: GPL-2.0-or-later
"""./magfsi render RUN [--time "160 ms"] [--out render.png]: one instant of any run as a picture."""
import sys
from pathlib import Path

from magfsi import plotting
from magfsi.drawing import options
from magfsi.drawing.stage import ensure_display


def main():
    asked = options.parser("render", __doc__, "picture", "direction", (1600, 1200))
    asked.add_argument("--time", type=plotting.seconds, help="the last without it")
    asked.add_argument("--out", type=Path, help="the picture, PNG (default: render.png in RUN)")
    chosen = asked.parse_args()
    out = chosen.out or chosen.run / "render.png"

    def work():
        stage = options.staged(chosen)
        first, last = stage.times()
        time = last if chosen.time is None else min(max(chosen.time, first), last)
        from PIL import Image
        Image.fromarray(stage.draw(time)).save(out, format="PNG")
        print(out)
        return 0

    ensure_display()
    return options.guarded("render", work)


if __name__ == "__main__":
    sys.exit(main())
