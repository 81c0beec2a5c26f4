# SPDX-License-Identifier: GPL-2.0-or-later
"""The pictures of the front page, from runs of all tutorials as `./magfsi gallery` leaves them:

    ./magfsi python docs/pictures/draw.py runs/gallery [NAME ...]

Those that write no shapes by themselves (helix) with --set output.structure.every='30 ms'. `front` is docs/swimmer.png,
of the swimmer's run."""
import subprocess
import sys
from pathlib import Path

from PIL import Image

from magfsi import runs

HERE = Path(__file__).resolve().parent
WIDTH, HEIGHT = 480, 320
FRONT = (680, 510)
# Labels would be four points high on a card, and six on the front page.
HIDDEN = "bars,field,scale,time"
# Which instant, as a share of the run, and what differs from render's own choices.
PICTURES = {
    "beam": (0.3, []), "catheter": (0.75, []), "cilia": (0.3, []), "gait": (0.9, ["--zoom", "0.7"]),
    "gravity": (1, []), "gripper": (0.7, ["--zoom", "1.4"]), "helix": (0.8, []), "letter": (0.4, ["--frame", "bodies"]),
    "origami": (1, []), "steering": (0.75, ["--zoom", "1.5"]), "strip": (1, []),
    "front": (0.284, ["--zoom", "0.8"]), "swimmer": (1, ["--zoom", "0.8"]), "tank": (0.834, []), "turning": (0.5, []),
}


def draw(name, folder):
    share, more = PICTURES[name]
    file, (width, height) = HERE / f"{name}.png", (WIDTH, HEIGHT)
    if name == "front":
        file, (width, height) = HERE.parent / "swimmer.png", FRONT
    last = runs.frames(folder)[-1][0]
    subprocess.run([sys.executable, "-P", "-m", "magfsi.render", str(folder), "--time", f"{share * last:.9g} s",
                    "--size", f"{2 * width}x{2 * height}", "--hide", HIDDEN, "--out", str(file), *more], check=True)
    # Half the size smooths edges; colours of a table of their own are a third of the bytes.
    small = Image.open(file).convert("RGB").resize((width, height), Image.LANCZOS)
    small.quantize(255, Image.Quantize.MEDIANCUT).save(file, optimize=True)


if __name__ == "__main__":
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    for tutorial in sys.argv[2:] or PICTURES:
        draw(tutorial, Path(sys.argv[1]) / ("swimmer" if tutorial == "front" else tutorial))
