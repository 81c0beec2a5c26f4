# SPDX-License-Identifier: GPL-2.0-or-later
"""What render and film have in common on the command line."""
import argparse
import sys
from pathlib import Path

from magfsi.report import data
from magfsi.runs import EXIT_INPUT


def size(text):
    """1600x1200"""
    try:
        width, height = (int(word) for word in text.split("x"))
    except ValueError:
        width = height = 0
    if not (16 <= width <= 8000 and 16 <= height <= 8000):
        raise argparse.ArgumentTypeError(f"'{text}': write a size as 1600x1200, each 16 to 8000")
    return width, height


def parser(program, description, look, default_size):
    options = argparse.ArgumentParser(prog=f"magfsi {program}", description=description)
    options.add_argument("run", type=Path, metavar="RUN", help="run folder")
    options.add_argument("--look", choices=("page", "picture"), default=look,
                         help=f"page: as report.html shows it; picture: with perspective and "
                         f"vortices ({look})")
    options.add_argument("--size", type=size, default=default_size, help="WIDTHxHEIGHT in pixels")
    options.add_argument("--colour", default="magnetisation",
                         help="of the bodies: magnetisation, strain, speed or body")
    options.add_argument("--flow", default="speed", help="speed, vorticity, pressure or none")
    options.add_argument("--levels", help="of vortices, up to three, in 1/s, rising: 60,150,300",
                         type=lambda text: [float(level) for level in text.split(",")])
    options.add_argument("--zoom", type=float, default=1.0, help="1 shows the bodies over their whole course (page) "
                         "or the whole box (picture)")
    return options


def staged(chosen):
    from magfsi.drawing.stage import Stage
    colour = {"strain": "largest strain", "body": ""}.get(chosen.colour, chosen.colour)
    return Stage(chosen.run, chosen.look, chosen.size, colour, chosen.flow, chosen.levels,
                 chosen.zoom)


def guarded(program, work):
    """Exit code; what cannot be read or written is said in one line."""
    try:
        return work()
    except (data.NotARun, OSError, RuntimeError) as error:
        print(f"magfsi {program}: {error}", file=sys.stderr)
        return EXIT_INPUT if isinstance(error, data.NotARun) else 1
