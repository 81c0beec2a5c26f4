# SPDX-License-Identifier: GPL-2.0-or-later
"""A table that a run goes on writing, for a page that is made again and again."""
import array
import csv
import os


class GrowingTable:
    """Numbers of a CSV file by column. Each call reads the rows that are new, if they are whole and
    numbers; all of them again when the file has become shorter."""

    def __init__(self, path):
        self.path = path
        self.forget()

    def forget(self):
        self.offset, self.columns = 0, {}

    def new_lines(self):
        with open(self.path, "rb") as file:
            if os.fstat(file.fileno()).st_size < self.offset:
                self.forget()
            file.seek(self.offset)
            text = file.read()
        whole = text[:text.rfind(b"\n") + 1]
        self.offset += len(whole)
        return [line for line in whole.decode().splitlines() if not line.startswith("#")]

    def read(self):
        """{name: numbers}; empty as long as there is no row."""
        try:
            rows = [*csv.reader(self.new_lines())]
        except OSError:
            return {}
        if rows and not self.columns:
            self.columns = {name: array.array("d") for name in rows.pop(0)}
        for row in rows:
            try:
                numbers = [float(word) for word in row]
            except ValueError:
                continue
            if len(numbers) == len(self.columns):
                for values, number in zip(self.columns.values(), numbers):
                    values.append(number)
        return self.columns if any(self.columns.values()) else {}
