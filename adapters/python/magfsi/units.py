# SPDX-License-Identifier: GPL-2.0-or-later
"""Numbers with a unit, "0.2 mm", for axes of figures. Checking them is the scene's matter."""
import re

PREFIXES = {"": 1, "p": 1e-12, "n": 1e-9, "u": 1e-6, "m": 1e-3, "c": 1e-2, "k": 1e3, "M": 1e6,
            "G": 1e9}
# Unit: that of SI and its size in it.
UNITS = {"m": ("m", 1), "s": ("s", 1), "g": ("kg", 1e-3), "Pa": ("Pa", 1), "A/m": ("A/m", 1), "Hz": ("1/s", 1),
         "T": ("T", 1), "min": ("s", 60), "h": ("s", 3600), "deg": ("rad", 0.017453292519943295),
         "rad": ("rad", 1), "N": ("N", 1), "m/s": ("m/s", 1), "m2/s": ("m2/s", 1)}
PATTERN = re.compile(r"([+-]?[0-9.]+(?:[eE][+-]?[0-9]+)?)\s*(.*)$")


def size_of(unit):
    """(SI unit, factor) or None."""
    if unit == "":
        return "1", 1.0
    for name, (si, factor) in UNITS.items():
        prefix = unit[:len(unit) - len(name)]
        if unit.endswith(name) and prefix in PREFIXES:
            power = 2 if name == "m2/s" else 1
            return si, factor * PREFIXES[prefix]**power
    return None


def parse(text):
    """(number in SI, SI unit), or None of what is no quantity."""
    match = PATTERN.match(text.strip())
    size = size_of(match.group(2)) if match else None
    if size is None:
        return None
    try:
        return float(match.group(1)) * size[1], size[0]
    except ValueError:
        return None


# What axes and legends show of units: those that take a prefix, and their letters.
SIZES = {1e9: "G", 1e6: "M", 1e3: "k", 1.0: "", 1e-3: "m", 1e-6: "\u00b5", 1e-9: "n", 1e-12: "p"}
WITH_PREFIX = {"m", "s", "m/s", "N", "J", "T", "Pa", "W", "A/m", "N m", "N s"}
DEGREE = "\u00b0"
RAISED = str.maketrans("-0123456789", "\u207b\u2070\u00b9\u00b2\u00b3\u2074\u2075\u2076\u2077\u2078\u2079")


def typeset(unit):
    """As a reader is to see it: "1/s^2" as s\u207b\u00b2, "m2/s" as m\u00b2/s, "deg" as \u00b0, "1" as nothing. The page
    does the same (report/colours.js)."""
    if unit in ("", "1"):
        return ""
    over = re.fullmatch(r"1/([A-Za-z]+)\^?(\d*)", unit)
    if over:
        return over[1] + f"-{over[2] or 1}".translate(RAISED)
    return re.sub(r"(?<=[A-Za-z])\^?(-?\d+)", lambda power: power[1].translate(RAISED), re.sub(r"\bdeg\b", DEGREE, unit))


def scaled(largest, unit):
    """(factor, unit) in which a value of this size is between 1 and 1000, for units that take a
    prefix. Nobody says kiloseconds."""
    if not largest > 0 or unit not in WITH_PREFIX:
        return 1.0, typeset(unit)
    size = max((s for s in SIZES if s <= largest * (1 + 1e-9) and (unit != "s" or s <= 1)), default=1e-12)
    return 1 / size, SIZES[size] + unit


def with_unit(value, unit, digits=3):
    """"17 mT"."""
    factor, shown = scaled(abs(value), unit)
    return f"{factor * value:.{digits}g}{'' if shown in ('', DEGREE) else ' '}{shown}"
