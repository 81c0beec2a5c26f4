# SPDX-License-Identifier: GPL-2.0-or-later
"""Tables that other programs wrote: measured or published curves. The C++ programs read theirs in
the same ways (structure/table_file.h)."""
import csv
import re

NUMBER = re.compile(r"[+-]?(\d+\.?\d*|\.\d+)([eE][+-]?\d+)?$")
DECIMAL_COMMA = re.compile(r"[+-]?\d+,\d+([eE][+-]?\d+)?$")
POINTS = "write decimal points"


class TableFault(ValueError):
    """What is wrong in a file, with its line."""


class Table:
    """Allowed are a byte order mark, lines of comment by # or %, a header in the last of them,
    sep=, quotes, and commas, semicolons, tabs or blanks between columns. Throws TableFault at the
    first line that has another meaning or none, OSError without a file."""

    def __init__(self, path):
        lines = _lines(path)
        separator, lines = _declared_separator(lines)
        comments = [(i, line) for i, line in lines if line[0] in "#%"]
        lines = [(i, line) for i, line in lines if line[0] not in "#%"]
        at, header = _header(path, lines, comments)
        separator = separator or next((c for c in ";\t," if c in header), None)
        self.names = _fields(header, separator)
        if len(set(self.names)) < len(self.names):
            raise TableFault(f"{path}:{at}: found two columns of one name: {header}")
        self._rows = [(f"{path}:{i}", _row(f"{path}:{i}", line, separator, len(self.names)))
                      for i, line in lines]
        if not self._rows:
            raise TableFault(f"{path}:{at}: found no row of numbers")

    def numbers(self, name):
        column = self.names.index(name)
        return [_number(place, row[column]) for place, row in self._rows]


def _lines(path):
    """[(number, text)] of those that are not empty."""
    try:
        text = path.read_text(encoding="utf-8-sig")
    except UnicodeDecodeError as error:
        line = error.object[:error.start].count(b"\n") + 1
        raise TableFault(f"{path}:{line}: found bytes that are no UTF-8; save the file as "
                         "UTF-8") from None
    return [(i, line.strip()) for i, line in enumerate(text.splitlines(), 1) if line.strip()]


def _declared_separator(lines):
    """sep=; in the first line, as spreadsheets write it."""
    if lines and lines[0][1].strip('"').lower().startswith("sep="):
        return lines[0][1].strip('"')[4:5] or "\t", lines[1:]
    return None, lines


def _header(path, lines, comments):
    """(line, text), taken out of the lines; numbers without names have it in a comment."""
    if not lines:
        raise TableFault(f"{path}:1: found no row of numbers")
    if not NUMBER.match(re.split(r"[;,\s]", lines[0][1].strip('"'))[0]):
        return lines.pop(0)
    before = [c for c in comments if c[0] < lines[0][0]]
    if not before:
        raise TableFault(f"{path}:1: found no header; the first line names the columns, as in "
                         "time,value")
    return before[-1][0], before[-1][1].lstrip("#% ")


def _fields(line, separator):
    fields = line.split() if separator is None else next(csv.reader([line], delimiter=separator))
    return [field.strip().strip('"') for field in fields]


def _row(place, line, separator, count):
    fields = _fields(line, separator)
    while len(fields) > count and not fields[-1]:  # a separator at the end
        fields.pop()
    if len(fields) != count:
        more = f"; if its commas are decimal ones, {POINTS}" if "," in line else ""
        raise TableFault(f"{place}: found {len(fields)} values below {count} columns: {line}{more}")
    return fields


def _number(place, text):
    if not NUMBER.match(text):
        more = f", which has a decimal comma; {POINTS}" if DECIMAL_COMMA.match(text) else ""
        raise TableFault(f'{place}: found "{text}"{more}; allowed are numbers')
    return float(text)
