# SPDX-License-Identifier: GPL-2.0-or-later
"""./magfsi compare called as a user does, in this process; and run folders with given courses."""
import json
from pathlib import Path
from unittest import mock

from magfsi import testing
from magfsi.compare import __main__ as command
from magfsi.compare import pictures

SCENE = {"name": "made", "time": {"end": 1.0},
         "fluid": {"solver": "lbm", "box": [8e-3, 4e-3, 8e-3], "spacing": 1e-3}}


def no_curves(found, out):
    """In the place of pictures.draw_curves, which takes most of the time."""
    (out / "curves.png").write_bytes(b"drawn elsewhere")
    return [out / "curves.png"]


def no_fields(*_, **__):
    return None, "drawn elsewhere"


def called(*words, drawn=True, fields=True):
    """drawn, fields: with pictures of the curves, of the fields."""
    with mock.patch.object(pictures, "draw_curves", pictures.draw_curves if drawn else no_curves), \
            mock.patch.object(pictures, "draw_fields", pictures.draw_fields if fields else no_fields):
        return testing.called("magfsi.compare", command.REFUSALS, *words)


def made(columns, scene=None, summary=None, name="run"):
    """A run folder with these columns {name: values}; name: of the folder."""
    folder = Path(testing.new_folder()) / name
    folder.mkdir()
    for file, content in (("scene.json", {**SCENE, **(scene or {})}),
                          ("run.json", [{"command": "by hand"}]),
                          ("summary.json", {"outcome": "completed", **(summary or {})})):
        (folder / file).write_text(json.dumps(content))
    rows = "".join(",".join(f"{value:.17g}" for value in row) + "\n"
                   for row in zip(*columns.values(), strict=True))
    (folder / "probes.csv").write_text(",".join(columns) + "\n" + rows)
    return folder


def with_bars(**bars):
    """Of a summary, as run --error writes it: {probe: bar}, "end" for "body.end[m]"."""
    return {"accuracy": {"probes": {f"body.{name}[J]": {"norm": "final", "value": 0.0, "bar": bar}
                                    for name, bar in bars.items()}}}
