# SPDX-License-Identifier: GPL-2.0-or-later
"""A study's reference table as spreadsheets, numpy and instruments write it is read right, or
refused with the line and what to do."""

import unittest
from pathlib import Path

from magfsi import testing
from magfsi.study.foreign_table import Table, TableFault

# All hold t = 0, 1, 2 and u = 0, 0.5, -2.
READ = {
    "plain": "t,u\n0,0\n1,0.5\n2,-2\n",
    "byte order mark": "\ufefft,u\n0,0\n1,0.5\n2,-2\n",
    "ends of lines of DOS": "t,u\r\n0,0\r\n1,0.5\r\n2,-2\r\n",
    "semicolons": "t;u\n0;0\n1;0.5\n2;-2\n",
    "tabs": "t\tu\n0\t0\n1\t0.5\n2\t-2\n",
    "blanks": "t u\n0   0\n 1 0.5\n2  -2\n",
    "quotes": '"t","u"\n"0","0"\n"1","0.5"\n"2","-2"\n',
    "blanks after commas": "t, u\n0, 0\n1, 0.5\n2, -2\n",
    "a header of numpy": "# t u\n0.0e+00 0.0e+00\n1.0e+00 5.0e-01\n2.0e+00 -2.0e+00\n",
    "a header of numpy with commas": "# t,u\n0,0\n+1,+.5\n2.,-2\n",
    "comments": "% made by hand\n# twice\nt,u\n0,0\n# between\n1,0.5\n2,-2\n",
    "sep=": "sep=;\nt;u\n0;0\n1;0.5\n2;-2\n",
    "an empty line": "t,u\n\n0,0\n1,0.5\n\n2,-2\n\n",
    "separators at the ends": "t,u,\n0,0,\n1,0.5,\n2,-2,\n",
    "a separator at the end of a row": "t,u\n0,0\n1,0.5,\n2,-2\n",
    "no end of the last line": "t,u\n0,0\n1,0.5\n2,-2",
    "a column of words beside": "t,u,who\n0,0,a\n1,0.5,b\n2,-2,c\n",
    "another order": "u,x,t\n0,7,0\n0.5,7,1\n-2,7,2\n",
}
REFUSED = {
    "a row too short": ("t,u\n0,0\n1\n2,-2\n", ":3:", "1 values below 2 columns"),
    "a row too long": ("t,u\n0,0\n1,0.5,3\n2,-2\n", ":3:", "3 values below 2 columns"),
    "decimal commas beside semicolons": ("t;u\n0;0\n1;0,5\n", ":3:", "write decimal points"),
    "decimal commas beside commas": ("t,u\n0,0\n1,0,5\n", ":3:", "write decimal points"),
    "a word": ("t,u\n0,0\n1,none\n", ":3:", '"none"'),
    "no number": ("t,u\n0,0\n1,nan\n", ":3:", '"nan"'),
    "no header": ("0,0\n1,0.5\n", ":1:", "no header"),
    "no rows": ("t,u\n", "", "no row"),
    "nothing": ("", ":1:", "no row"),
    "one name twice": ("t,t\n0,0\n", ":1:", "one name"),
    "Latin letters of one byte": ("t,u\n# \udce4\n0,0\n", ":2:", "UTF-8"),
}


def written(text):
    path = Path(testing.new_folder()).with_suffix(".csv")
    path.write_bytes(text.encode("utf-8", "surrogateescape"))
    return path


class TablesOfOthers(unittest.TestCase):
    def test_read_right(self):
        for name, text in READ.items():
            with self.subTest(name):
                table = Table(written(text))
                self.assertEqual(table.numbers("t"), [0, 1, 2])
                self.assertEqual(table.numbers("u"), [0, 0.5, -2])

    def test_refused_with_place_and_remedy(self):
        for name, (text, place, words) in REFUSED.items():
            with self.subTest(name):
                with self.assertRaises(TableFault) as caught:
                    Table(written(text)).numbers("u")
                self.assertIn(place, str(caught.exception))
                self.assertIn(words, str(caught.exception))


if __name__ == "__main__":
    unittest.main()
