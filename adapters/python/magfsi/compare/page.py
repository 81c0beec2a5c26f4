# SPDX-License-Identifier: GPL-2.0-or-later
"""The page of a comparison, one file that fetches nothing, in the style of the page of a run; and
what both cost."""
import base64
import csv
import html
import json
import math

from magfsi import curves, units
from magfsi.compare import differences
from magfsi.compare import sides as reading
from magfsi.cost.report import duration, percent, size
from magfsi.report import page as of_a_run

STYLE = """
.verdict { font-size: 1.15em; max-width: 60em; }
img { display: block; max-width: 100%; background: #fff; border-radius: 4px; }
@media (max-width: 700px) { img { max-width: none; width: 860px; } }
th.number { text-align: right; }
"""
COST = ("run", "fluid", "wall[s]", "processor[s]", "steps[1]", "cells of the fluid[1]", "ranks",
        "memory[bytes]", "machine")


def _text(value):
    return html.escape(str(value))


def _cells(values, kind="td"):
    """The first is a word, the others are numbers."""
    first, *numbers = values
    return f"<{kind}>{first}</{kind}>" + "".join(f'<{kind} class="number">{value}</{kind}>'
                                                 for value in numbers)


def _table(head, rows):
    """Cells of the head are text, the others HTML."""
    lines = [_cells([_text(word) for word in head], "th"), *(_cells(row) for row in rows)]
    text = "\n".join(f"<tr>{line}</tr>" for line in lines)
    return f'<div class="wide" tabindex="0"><table>\n{text}\n</table></div>'


# --- probes ---

def _within(row):
    return {None: "", True: '<span class="good">yes</span>',
            False: '<span class="bad">no</span>'}[row.within()]


def _share(value):
    if not math.isfinite(value):
        return ""
    if 0 < abs(value) <= curves.ROUNDING:
        return f"below {percent(curves.ROUNDING)}"
    return percent(value)


def _probes(found):
    head = ["probe", *(side.name for side in found.sides), "difference", "of the largest", "L2",
            "largest at any time", "within both bars", "remark"]
    rows = []
    for row in found.rows:
        values = ["", "", ""]
        if math.isfinite(row.difference):
            values = [row.value_words(0), row.value_words(1),
                      units.with_unit(row.difference, row.unit)]
        share = row.difference / row.scale if row.scale else math.nan
        rows.append([_text(row.column), *map(_text, values), _share(share), _share(row.l2),
                     _share(row.most), _within(row), _text(row.remark())])
    return _table(head, rows)


def _left_out(found):
    parts = [("nothing in both runs (less than a thousandth of their vector)", found.zero)]
    parts += [(f"in {side.name} alone", alone) for side, alone in zip(found.sides, found.alone)]
    return [f'<p class="grey">Not compared, {_text(what)}: {_text(", ".join(columns))}</p>'
            for what, columns in parts if columns]


def _bars(found):
    have = [f"{side.name}: {side.bars_from}" for side in found.sides if side.bars_from]
    return "Error bars of " + "; ".join(have) + "." if have else (
        "No run has error bars: ./magfsi run --error writes them, and --bars-first and "
        "--bars-second take those of a result of ./magfsi cost.")


# --- cost ---

def costs(found):
    """A row a run; None is what is not recorded."""
    rows = []
    for side in found.sides:
        summary = side.summary
        ranks = ", ".join(f"{name} {n}" for name, n in summary.get("ranks", {}).items())
        rows.append([side.name, side.scene.get("fluid", {}).get("solver", ""),
                     summary.get("wall_s"), side.processor_s(), summary.get("steps"),
                     summary.get("fluid", {}).get("cells"), ranks, side.memory_bytes(),
                     side.last_start().get("machine", "")])
    return rows


def write_costs(found, path):
    with open(path, "w", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(COST)
        for row in costs(found):
            writer.writerow(["" if value is None else f"{value:.6g}" if isinstance(value, float)
                             else value for value in row])


def cost_sentence(found):
    """How many times as much the second takes."""
    first, second = costs(found)
    parts = [f"{second[i] / first[i]:.2g} times the {what} time"
             for i, what in ((2, "wall"), (3, "processor")) if first[i] and second[i]]
    if not parts:
        return "What they cost is not recorded."
    return f"{second[0]} takes {' and '.join(parts)} of {first[0]}."


def _costs(found):
    def seconds(value):
        return duration(value) if value else "not recorded"
    rows = [[_text(name), _text(fluid), seconds(wall), seconds(processor), steps or "", cells or "",
             _text(ranks), size(memory), _text(machine)]
            for name, fluid, wall, processor, steps, cells, ranks, memory, machine in costs(found)]
    return _table(["run", "fluid", "wall time", "processor time", "steps", "cells of the fluid",
                   "ranks", "memory", "machine"], rows)


# --- the rest ---

def _scenes(found):
    def shown(value):
        return "" if value is None else f"{value:.6g}" if isinstance(value, float) else (
            value if isinstance(value, str) else json.dumps(value))
    rows = [[_text(key), _text(shown(first)), _text(shown(second))]
            for key, first, second in reading.scene_differences(found.sides)]
    if not rows:
        return "<p>The scenes are the same.</p>"
    return _table(["key (values in SI units)", *(side.name for side in found.sides)], rows)


def _origin(found):
    lines = []
    for side in found.sides:
        last = side.last_start()
        versions = side.summary.get("versions", {})
        lines += [f"{side.name}: {side.folder}",
                  f"  begun {last.get('begun', '')}: {last.get('command', '')}",
                  "  " + ", ".join(f"{name} {version}" for name, version in versions.items())]
    folders = " ".join(str(side.folder) for side in found.sides)
    lines.append(f"both on a page to play with: ./magfsi report {folders}")
    return "<pre>" + _text("\n".join(lines)) + "</pre>"


def _picture(file, words):
    data = base64.b64encode(file.read_bytes()).decode()
    # On a phone it is as large as its letters need, and moved sideways.
    return (f'<figure class="wide" tabindex="0"><img alt="{_text(words)}" src="data:image/png;base64,{data}">'
            "</figure>")


def _section(title, *parts):
    return "\n".join([f"<section><h2>{title}</h2>", *parts, "</section>"])


def _header(found, title):
    agree, words = differences.sentence(found)
    kind = {True: " good", False: " bad", None: ""}[agree]
    about = f"{differences.sampling(found)} {_bars(found)}"
    return "\n".join([f'<header><h1>{_text(title)}</h1><p class="verdict{kind}">{_text(words)}</p>',
                      *(f'<p class="bad">{_text(line)}</p>' for line in differences.endings(found)),
                      f'<p class="grey">{_text(about)}</p></header>'])


def assemble(found, courses, fields, fields_words):
    """The page as text. courses: pictures; fields: a picture, or None and why."""
    names = [side.name for side in found.sides]
    title = f"{found.sides[0].scene.get('name', '')}: {names[0]} and {names[1]}"
    end = units.with_unit(found.span[1], "s", 4)
    about = (f'<p class="grey">Values are those at {end}, of a place its change from the start. '
             f"Shares are of {_text(names[0])}: of its largest value, in L2 of its root mean "
             "square.</p>")
    parts = [_header(found, title), "<main>",
             _section("Probes", about, _probes(found), *_left_out(found)),
             _section("Curves", *(_picture(file, "every probe of both runs") for file in courses)),
             _section("Fields", f'<p class="grey">{_text(fields_words)}</p>',
                      _picture(fields, fields_words) if fields else ""),
             _section("Cost", f"<p>{_text(cost_sentence(found))}</p>", _costs(found)),
             _section("Where the scenes differ", _scenes(found)),
             _section("Where it comes from", _origin(found)), "</main>"]
    style = of_a_run.style() + STYLE
    policy = f"default-src 'none'; img-src data:; style-src {of_a_run.hash_of(style)}"
    return ('<!DOCTYPE html>\n<html lang="en">\n<head>\n<meta charset="utf-8">\n'
            '<meta name="viewport" content="width=device-width, initial-scale=1">\n'
            f'<meta http-equiv="Content-Security-Policy" content="{policy}">\n'
            f"<title>{_text(title)}</title>\n<style>{style}</style>\n</head>\n<body>\n"
            + "\n".join(parts) + "\n</body>\n</html>\n")
