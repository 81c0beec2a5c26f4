# SPDX-License-Identifier: GPL-2.0-or-later
"""What the modules of the package promise: units, tables, formulas, the product of a study."""

import unittest
from pathlib import Path

from magfsi import runs, testing, units
from magfsi.study.expression import Formula


class Units(unittest.TestCase):
    def test_each_size_in_si(self):
        for text, number, unit in (("0.2 mm", 2e-4, "m"), ("17 mT", 0.017, "T"),
                                   ("3 kPa", 3e3, "Pa"), ("1 mm2/s", 1e-6, "m2/s"),
                                   ("2 min", 120, "s"), ("5 g", 5e-3, "kg"),
                                   ("-1e-3", -1e-3, "1"), ("180 deg", 3.141592653589793, "rad")):
            found = units.parse(text)
            self.assertEqual(found[1], unit, text)
            self.assertAlmostEqual(found[0] / number, 1, places=12, msg=text)

    def test_what_is_no_quantity(self):
        for text in ("", "mm", "1 furlong", "1.2.3 m", "[1 m]"):
            self.assertIsNone(units.parse(text), text)


class Tables(unittest.TestCase):
    def write(self, text):
        file = Path(testing.new_folder()) / "table.csv"
        file.write_text(text)
        return file

    def test_comments_and_a_row_cut_short_are_left_out(self):
        file = self.write("# from somewhere\nt[s],x[m]\n0,1\n1,2.5\n2")
        self.assertEqual(runs.read_table(file, float), {"t[s]": [0, 1], "x[m]": [1, 2.5]})
        self.assertEqual(runs.read_rows(file)[1], {"t[s]": "1", "x[m]": "2.5"})

    def test_a_long_course_is_the_same(self):
        """It is read in another way."""
        rows = [f"{i / 7!r},{(i - 1500) / 3!r}" for i in range(3000)]
        for last in ("nan,-inf", "3000,0.1,2", "3000"):
            found = runs.read_table(self.write("\n".join(["# from somewhere", "t[s],x[m]", *rows, last])), float)
            self.assertEqual(found["x[m]"][:3000], [(i - 1500) / 3 for i in range(3000)])
            self.assertEqual(len(found["t[s]"]), 3000 + (last == "nan,-inf"))

    def test_nothing_in_the_file(self):
        self.assertEqual(runs.read_table(self.write("")), {})


class Formulas(unittest.TestCase):
    def test_values_and_names(self):
        formula = Formula("2 * a ** 2 - sqrt(b[1]) / pi")
        self.assertEqual(formula.names, {"a", "b"})
        self.assertAlmostEqual(formula(a=3, b=[0, 4]), 18 - 2 / 3.141592653589793)

    def test_nothing_but_arithmetic(self):
        for text in ("__import__('os')", "a.b", "lambda: 1", "'text'", "a if b else c", "1 +"):
            with self.assertRaises(ValueError, msg=text):
                Formula(text)


if __name__ == "__main__":
    unittest.main()
