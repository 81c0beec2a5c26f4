# SPDX-License-Identifier: GPL-2.0-or-later
"""What render and film have in common on the command line."""
import argparse
import math
import sys
from pathlib import Path

from magfsi.drawing.camera import FRAMES, VIEWS
from magfsi.report import data
from magfsi.runs import EXIT_INPUT

PARTS = ("arrows", "bars", "box", "field", "obstacles", "scale", "sources", "time", "vortices")
COLOURS = ("direction", "magnetisation", "strain", "speed", "body")


def size(text):
    """1600x1200"""
    try:
        width, height = (int(word) for word in text.split("x"))
    except ValueError:
        width = height = 0
    if not (16 <= width <= 8000 and 16 <= height <= 8000):
        raise argparse.ArgumentTypeError(f"'{text}': write a size as 1600x1200, each 16 to 8000")
    return width, height


def view(text):
    """A name, or degrees to the right and up: 30,20."""
    if text in VIEWS:
        return VIEWS[text]
    try:
        yaw, pitch = (float(word) for word in text.split(","))
    except ValueError:
        yaw = pitch = math.inf
    if not (abs(yaw) <= 360 and abs(pitch) <= 90):
        raise argparse.ArgumentTypeError(f"'{text}': allowed are {', '.join(VIEWS)}, or degrees to the right (up to "
                                         "360) and up (-90 to 90) as 30,20")
    return math.radians(yaw), math.radians(pitch)


def parts(text):
    unknown = sorted(set(text.split(",")) - set(PARTS))
    if unknown:
        raise argparse.ArgumentTypeError(f"found {', '.join(unknown)}; allowed are {', '.join(PARTS)}")
    return tuple(text.split(","))


def levels(text):
    try:
        found = [float(word) for word in text.split(",")]
    except ValueError:
        found = []
    if not (1 <= len(found) <= 3 and found == sorted(found) and found[0] > 0):
        raise argparse.ArgumentTypeError(f"'{text}': write up to three rising numbers as 60,150,300")
    return found


def parser(program, description, look, colour, default_size):
    options = argparse.ArgumentParser(prog=f"magfsi {program}", description=description)
    options.add_argument("run", type=Path, metavar="RUN", help="run folder")
    options.add_argument("--look", choices=("page", "picture"), default=look,
                         help=f"page: as report.html shows it; picture: with perspective and "
                         f"vortices ({look})")
    options.add_argument("--size", type=size, default=default_size, help="WIDTHxHEIGHT in pixels")
    options.add_argument("--colour", choices=COLOURS, default=colour,
                         help="of the bodies; direction: that of the magnetisation as the bodies carry it, by a wheel "
                         f"of colours and arrows; magnetisation: its main component at rest ({colour})")
    options.add_argument("--flow", default="speed", choices=("speed", "vorticity", "pressure", "none"),
                         help="of the slice in the look page (speed)")
    options.add_argument("--levels", help="of vortices, up to three, in 1/s, rising: 60,150,300", type=levels)
    options.add_argument("--camera", type=view, metavar="VIEW", help=f"{', '.join(VIEWS)}, or degrees to the "
                         "right and up: 30,20 (picture: corner, page: page)")
    options.add_argument("--frame", choices=FRAMES, help="what fills it: the bodies now, over their whole course, the box, "
                         "or as much of the box as leaves the bodies a third of the width (picture: auto, page: course)")
    options.add_argument("--zoom", type=float, default=1.0, help="so much closer")
    options.add_argument("--obstacles", choices=("cut", "glass", "whole"), default="cut",
                         help="in the look picture; cut: those that hide a body are cut open (cut)")
    options.add_argument("--hide", type=parts, default=(), metavar="PART,...", help=f"of {', '.join(PARTS)}")
    return options


def staged(chosen):
    from magfsi.drawing.stage import Stage
    if not 0.01 <= chosen.zoom <= 1000:
        raise data.NotARun(f"--zoom: found {chosen.zoom:g}; allowed is 0.01 to 1000")
    colour = {"strain": "largest strain", "body": ""}.get(chosen.colour, chosen.colour)
    return Stage(chosen.run, chosen.look, chosen.size, colour, chosen.flow, chosen.levels,
                 chosen.zoom, chosen.camera, chosen.frame, chosen.obstacles, chosen.hide)


def guarded(program, work):
    """Exit code; what cannot be read or written is said in one line."""
    try:
        return work()
    except (data.NotARun, OSError, RuntimeError) as error:
        print(f"magfsi {program}: {error}", file=sys.stderr)
        return EXIT_INPUT if isinstance(error, data.NotARun) else 1
