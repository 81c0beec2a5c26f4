# SPDX-License-Identifier: GPL-2.0-or-later
"""The pictures of the front page, from runs of all tutorials as `./magfsi gallery` leaves them:

    ./magfsi python docs/pictures/draw.py runs/gallery [NAME ...]

Those that write no shapes by themselves (helix) with --set output.structure.every='30 ms'."""
import subprocess
import sys
from pathlib import Path

from PIL import Image

from magfsi import runs

HERE = Path(__file__).resolve().parent
WIDTH, HEIGHT = 480, 320
# Labels would be four points high on a card.
HIDDEN = "bars,field,scale,time"
# Which instant, as a share of the run, and what differs from render's own choices.
PICTURES = {
    "beam": (0.3, []), "catheter": (0.75, []), "cilia": (0.3, []), "gait": (0.75, ["--zoom", "0.6"]),
    "gravity": (1, []), "gripper": (0.7, ["--zoom", "1.4"]), "helix": (0.8, []), "letter": (0.4, []),
    "origami": (1, []), "steering": (0.75, ["--zoom", "1.5"]), "strip": (1, []),
    "swimmer": (0.9, ["--zoom", "0.7"]), "tank": (0.9, []), "turning": (0.5, []),
}


def draw(name, folder):
    share, more = PICTURES[name]
    file = HERE / f"{name}.png"
    last = runs.frames(folder)[-1][0]
    subprocess.run([sys.executable, "-P", "-m", "magfsi.render", str(folder), "--time", f"{share * last:.9g} s",
                    "--size", f"{2 * WIDTH}x{2 * HEIGHT}", "--hide", HIDDEN, "--out", str(file), *more], check=True)
    # Half the size smooths edges, 128 colours are a third of the bytes.
    Image.open(file).convert("RGB").resize((WIDTH, HEIGHT)).quantize(128).save(file, optimize=True)


if __name__ == "__main__":
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    for tutorial in sys.argv[2:] or PICTURES:
        draw(tutorial, Path(sys.argv[1]) / tutorial)
