# SPDX-License-Identifier: GPL-2.0-or-later
"""./magfsi compare of two run folders with courses that are known: differences, the time and the
rows that are compared, error bars and the sentence about them, instants of fields, costs, and
what is refused."""
import re
import unittest
from pathlib import Path

import numpy as np
import vtk
from vtk.util.numpy_support import numpy_to_vtk

from command import called, made, with_bars
from magfsi import runs, testing
from magfsi.compare import pictures, sides

TIMES = np.linspace(0, 1, 101)
WAVE = np.sin(7 * TIMES)
ENERGY = "body.elastic[J]"


def compared(first, second, *words, drawn=False):
    """(the rows of the table by probe, what was said, where it is); drawn: with the picture of the curves."""
    out = Path(testing.new_folder()) / "out"
    done = called(first, second, "--out", out, *words, drawn=drawn)
    if done.code:
        raise AssertionError(done.err)
    return {row["probe"]: row for row in runs.read_rows(out / "compare.csv")}, done.out, out


def number(row, name):
    return float(row[name])


class Differences(unittest.TestCase):
    def test_a_tenth_more_is_ten_per_cent_in_every_measure(self):
        first = made({"t[s]": TIMES, ENERGY: WAVE})
        second = made({"t[s]": TIMES, ENERGY: 1.1 * WAVE})
        row = compared(first, second)[0][ENERGY]
        share = 0.1 * WAVE[-1] / np.abs(WAVE).max()
        for name, right in (("first", WAVE[-1]), ("second", 1.1 * WAVE[-1]),
                            ("difference", 0.1 * WAVE[-1]), ("difference of largest[1]", share),
                            ("l2[1]", 0.1), ("largest[1]", 0.1)):
            # The table has four digits.
            self.assertAlmostEqual(number(row, name), right, places=4, msg=name)
        self.assertEqual(row["unit"], "J")

    def test_of_a_place_the_change_counts(self):
        """Where the scene puts the body does not: 1 mm and 1.2 mm of way are 20 % apart."""
        first = made({"t[s]": TIMES, "body.com_z[m]": 4e-3 + 1e-3 * TIMES})
        second = made({"t[s]": TIMES, "body.com_z[m]": 7e-3 + 1.2e-3 * TIMES})
        row = compared(first, second)[0]["body.com_z[m]"]
        for name, right in (("first", 1e-3), ("second", 1.2e-3)):
            self.assertAlmostEqual(number(row, name), right, delta=1e-11)
        self.assertAlmostEqual(number(row, "l2[1]"), 0.2, places=4)

    def test_other_rows_are_interpolated_and_that_is_said(self):
        """Compared at the rows of the coarser run, in either order. On straight lines through the
        finer one's rows, h apart, a parabola is off by h^2/4 at most; through those of
        the coarser it would be a hundred times that."""
        coarse, fine = np.linspace(0, 1, 11), np.linspace(0, 1, 98)
        runs_ = [made({"t[s]": t, ENERGY: t**2}, name=name)
                 for t, name in ((coarse, "coarse"), (fine, "fine"))]
        for first, second in (runs_, runs_[::-1]):
            rows, _, out = compared(first, second)
            most = number(rows[ENERGY], "largest[1]")
            self.assertGreater(most, 0)
            self.assertLessEqual(most, (fine[1] - fine[0])**2 / 4 * 1.001)
            page = (out / "compare.html").read_text()
            self.assertIn("compared at those of coarse, where fine is interpolated", page)
        same = compared(runs_[0], made({"t[s]": coarse, ENERGY: coarse}))[2]
        self.assertIn("Both have their rows at the same times.",
                      (same / "compare.html").read_text())

    def test_the_time_that_both_have_counts(self):
        first = made({"t[s]": TIMES, ENERGY: TIMES})
        second = made({"t[s]": TIMES[:51], ENERGY: np.append(TIMES[:50], 0.6)},
                      summary={"outcome": "diverged", "cause": "too fast"})
        rows, said, out = compared(first, second)
        self.assertAlmostEqual(number(rows[ENERGY], "first"), 0.5, places=9)
        self.assertAlmostEqual(number(rows[ENERGY], "second"), 0.6, places=9)
        self.assertIn("is not complete (diverged: too fast): compared until 500 ms.", said)
        self.assertIn("compared until 500 ms", (out / "compare.html").read_text())

    def test_what_is_nothing_or_in_one_run_alone_is_named(self):
        first = made({"t[s]": TIMES, "body.com_x[m]": 1e-3 * TIMES, "body.com_y[m]": 1e-9 * WAVE,
                      "old[J]": WAVE, "bad[J]": np.where(TIMES > 0.5, np.nan, 1.0)})
        second = made({"t[s]": TIMES, "body.com_x[m]": 1e-3 * TIMES, "body.com_y[m]": -1e-9 * WAVE,
                       "new[J]": WAVE, "bad[J]": TIMES})
        rows, _, out = compared(first, second, "--names", "a,b")
        self.assertEqual(set(rows), {"body.com_x[m]", "bad[J]"})
        self.assertIn("not finite", rows["bad[J]"]["remark"])
        text = (out / "compare.html").read_text()
        for words in ("vector): body.com_y[m]", "in a alone: old[J]", "in b alone: new[J]"):
            self.assertIn(words, text)


class Bars(unittest.TestCase):
    def said(self, first_bars, second_bars, *words, change=0.3):
        """The first ends at 1 and 2, the second at 1.3 and 2."""
        columns = {"t[s]": TIMES, "body.a[J]": TIMES, "body.b[J]": 2 * TIMES}
        first = made(columns, summary=with_bars(**first_bars), name="first")
        second = made({**columns, "body.a[J]": (1 + change) * TIMES}, name="second",
                      summary=with_bars(**second_bars))
        rows, said, out = compared(first, second, *words)
        self.assertIn(said.splitlines()[0].split(":")[0], (out / "compare.html").read_text())
        return rows, said.splitlines()[0]

    def test_they_agree_where_the_bars_overlap(self):
        rows, said = self.said({"a": 0.2, "b": 0.1}, {"a": 0.11, "b": 0.1})
        self.assertTrue(said.startswith("They agree within their error bars: of 2 probes"), said)
        self.assertIn("nearest to that is body.a, 1 J ± 200 mJ and 1.3 J ± 110 mJ", said)
        self.assertEqual({row["within bars"] for row in rows.values()}, {"yes"})

    def test_they_do_not_where_one_probe_is_further_apart(self):
        rows, said = self.said({"a": 0.2, "b": 0.1}, {"a": 0.09, "b": 0.1})
        self.assertTrue(said.startswith("They do not agree within their error bars: of 2 probes "
                                        "with a bar in both runs 1 is further apart"), said)
        self.assertEqual(rows["body.a[J]"]["within bars"], "no")

    def test_without_bars_nothing_is_claimed(self):
        for bars, why in ((({}, {}), "neither run has one"),
                          (({"a": 0.1}, {}), "only first has one"),
                          (({"a": 0.1}, {"b": 0.1}), "no probe has one in both runs"),
                          (({"a": None}, {"a": 0.2}), "only second has one")):
            rows, said = self.said(*bars)
            self.assertIn(f"Whether they agree within their error bars is not known: {why}.", said)
            self.assertIn("30 % in L2, of body.a", said)
            self.assertEqual({row["within bars"] for row in rows.values()}, {""})

    def test_a_bar_of_a_later_time_is_none(self):
        """The first goes on for twice as long as the second: its bar is of its own end."""
        long = {"t[s]": np.append(TIMES, 2), "body.a[J]": np.append(TIMES, 2)}
        first = made(long, summary=with_bars(a=0.5), name="first")
        second = made({"t[s]": TIMES, "body.a[J]": TIMES}, summary=with_bars(a=0.5), name="second")
        rows, said, _ = compared(first, second)
        self.assertIn("is not known: only second has one", said)
        self.assertIn("its bar is of 2 s", rows["body.a[J]"]["remark"])

    def test_a_bar_holds_for_the_last_row(self):
        """Of runs with other steps the last rows are less than the time between rows apart."""
        first = made({"t[s]": TIMES, "body.a[J]": TIMES}, summary=with_bars(a=0.1))
        second = made({"t[s]": 0.997 * TIMES, "body.a[J]": TIMES}, summary=with_bars(a=0.1))
        self.assertIn("They agree within their error bars", compared(first, second)[1])

    def test_a_small_component_is_not_the_largest_difference(self):
        columns = {"t[s]": TIMES, "body.com_x[m]": 1e-5 * TIMES, "body.com_z[m]": 1e-3 * TIMES}
        other = {**columns, "body.com_x[m]": 2e-5 * TIMES, "body.com_z[m]": 1.1e-3 * TIMES}
        rows, said, _ = compared(made(columns), made(other))
        self.assertIn("10 % in L2, of body.com_z", said)
        self.assertAlmostEqual(number(rows["body.com_x[m]"], "l2[1]"), 1, places=4)

    def test_of_a_cost_result_the_share_is_taken(self):
        """|error| + its bar, in parts of the largest value: 8 % of 1 J; a doubtful one is none."""
        folder = Path(testing.new_folder())
        (folder / "cost.csv").write_text(
            "probe,norm,value,bar,limit,limit_bar,error[1],error_bar[1],doubt\n"
            "body.a[J],final,1,0.08,1.05,0.03,-0.05,0.03,\n"
            "body.b[J],final,2,0.1,2,0.1,0.01,0.01,step: it turns back\n")
        rows, said = self.said({}, {"a": 0.3, "b": 0.3}, "--bars-first", folder)
        self.assertAlmostEqual(number(rows["body.a[J]"], "first_bar"), 0.08, places=9)
        self.assertEqual(rows["body.b[J]"]["first_bar"], "")
        self.assertIn("it turns back", rows["body.b[J]"]["remark"])
        self.assertIn("of 1 probe with a bar", said)

    def test_a_cost_result_of_another_run_is_told(self):
        folder = Path(testing.new_folder())
        (folder / "cost.csv").write_text(
            "probe,norm,value,bar,limit,limit_bar,error[1],error_bar[1],doubt\n"
            "body.a[J],final,3,0.08,1.05,0.03,-0.05,0.03,\n")
        rows, _ = self.said({}, {}, "--bars-first", folder)
        self.assertIn("has 3 in place of 1", rows["body.a[J]"]["remark"])


def grid(folder, name, spacing, velocity, time):
    """A file of the flow whose velocity along x follows from the places of the cells' middles, and
    its entry."""
    counts = [round(side / spacing) for side in (8e-3, 4e-3, 8e-3)]
    image = vtk.vtkImageData()
    image.SetDimensions(*(n + 1 for n in counts))
    image.SetSpacing(*3 * [spacing])
    z, y, x = np.meshgrid(*((np.arange(n) + 0.5) * spacing for n in counts[::-1]), indexing="ij")
    values = np.zeros((x.size, 3))
    values[:, 0] = velocity(x, y, z).ravel()
    array = numpy_to_vtk(values, deep=True)
    array.SetName("velocity[m/s]")
    image.GetCellData().AddArray(array)
    writer = vtk.vtkXMLImageDataWriter()
    writer.SetFileName(str(folder / name))
    writer.SetInputData(image)
    writer.Write()
    return f'<DataSet timestep="{time}" part="0" file="{name}"/>'


def with_flow(spacing, velocity, times, name):
    folder = made({"t[s]": TIMES, ENERGY: WAVE}, name=name)
    entries = [grid(folder, f"flow_{i}.vti", spacing, lambda x, y, z, t=t: velocity(x, y, z, t), t)
               for i, t in enumerate(times)]
    text = f"<VTKFile><Collection>{''.join(entries)}</Collection></VTKFile>"
    (folder / "fluid.pvd").write_text(text)
    return folder


class Fields(unittest.TestCase):
    def test_instants_are_those_that_both_have_without_the_start(self):
        every = [0.1 * i for i in range(11)]
        found = pictures.pairs(every, every, (0, 1))
        self.assertEqual([round(first, 9) for first, _ in found], [0.4, 0.7, 1.0])
        self.assertEqual(pictures.pairs(every, [0.0, 0.5], (0, 1)), [(0.5, 0.5)])
        near = pictures.pairs([0.0, 0.4], [0.0, 0.39, 0.8], (0, 0.5))
        self.assertEqual(near, [(0.4, 0.39)])
        self.assertEqual(pictures.pairs(every, [0.0], (0, 0.04)), [])

    def test_a_difference_is_that_of_the_flows(self):
        """Speeds that rise along z by 1/s and by 1.5/s on cells of 1 mm and 0.5 mm: half of z
        apart, to rounding, but in the outer halves of the coarser cells, beyond whose middles
        nothing is known."""
        first = with_flow(1e-3, lambda x, y, z, t: t * z, (0, 0.5, 1), "first")
        second = with_flow(5e-4, lambda x, y, z, t: 1.5 * t * z, (0, 0.5, 1), "second")
        rows, _, out = compared(first, second)
        self.assertIn("The speed in the plane xz at y = 2 mm", (out / "compare.html").read_text())
        self.assertTrue((out / "fields.png").exists())
        read = [sides.read(folder) for folder in (first, second)]
        made_ = pictures.read_slices(read, pictures.View(read), "speed", [(0.5, 0.5), (1.0, 1.0)])
        for time, slices in zip((0.5, 1), made_):
            z = slices[0].middles()[1][:, None]
            np.testing.assert_allclose(slices[2], 0.5 * time * z * np.ones(8), atol=1e-12)

    def test_what_one_of_them_has_not_is_left_out(self):
        first = with_flow(1e-3, lambda x, y, z, t: t * z, (0, 1), "first")
        rows, _, out = compared(first, made({"t[s]": TIMES, ENERGY: WAVE}))
        self.assertIn("No fields in both runs", (out / "compare.html").read_text())
        self.assertFalse((out / "fields.png").exists())
        third = with_flow(1e-3, lambda x, y, z, t: t * z, (0, 1), "third")
        _, _, out = compared(first, third, "--field", "pressure")
        self.assertIn("No fields in both runs", (out / "compare.html").read_text())


class Written(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        columns = {"t[s]": TIMES, **{f"body.q{i}[J]": WAVE + i for i in range(3)}}
        hostile = {"name": "<script>alert(1)</script>"}
        summary = {"wall_s": 2.0, "steps": 10, "processor_s": {"structure": 1.0, "fluid": 2.5}}
        first = made(columns, hostile, summary)
        other = {**hostile, "fluid": {"solver": "openfoam", "spacing": 2e-3}}
        second = made(columns, other, {"wall_s": 8.0})
        (second / "study.json").write_text('{"core_s": 14.0}')
        cls.rows, cls.said, cls.out = compared(first, second, drawn=True)
        cls.page = (cls.out / "compare.html").read_text()

    def test_costs_are_those_of_the_summaries(self):
        rows = runs.read_rows(self.out / "cost.csv")
        self.assertEqual([row["run"] for row in rows], ["lattice", "OpenFOAM"])
        self.assertEqual([float(row["wall[s]"]) for row in rows], [2, 8])
        self.assertEqual([float(row["processor[s]"]) for row in rows], [3.5, 14])
        self.assertIn("OpenFOAM takes 4 times the wall time and 4 times the processor time of "
                      "lattice.", self.said)

    def test_the_page_holds_all_and_fetches_nothing(self):
        for outside in ("http:", "https:", "<script", "url(", "<link"):
            self.assertNotIn(outside, self.page)
        self.assertIn("&lt;script&gt;alert(1)", self.page)
        self.assertEqual(re.findall('src="(?!data:image/png;base64,)', self.page), [])
        for name in self.rows:
            self.assertIn(name, self.page)

    def test_scenes_are_laid_beside_each_other(self):
        table = self.page.split("Where the scenes differ")[1]
        for words in ("fluid.solver", "fluid.spacing", ">0.001<", ">0.002<", "fluid.box"):
            self.assertIn(words, table)
        self.assertNotIn("time.end", table)


class Refused(unittest.TestCase):
    def refused(self, says, *words):
        out = Path(testing.new_folder()) / "out"
        done = called(*words, "--out", out)
        self.assertEqual((done.code, len(done.err.strip().splitlines())), (2, 1), done.err)
        self.assertIn(says, done.err)
        self.assertFalse(out.exists())

    def test_folders_that_are_no_pair_of_runs(self):
        run, other = made({"t[s]": TIMES, ENERGY: WAVE}), made({"t[s]": TIMES, ENERGY: WAVE})
        self.refused("found one run folder", run)
        self.refused("found 3 folders", run, other, run)
        self.refused("twice", run, run)
        self.refused("found no scene.json", run, testing.new_folder())
        self.refused("found 1 rows", run, made({"t[s]": [0], ENERGY: [1]}))
        self.refused("fewer than two rows", run, made({"t[s]": TIMES + 2, ENERGY: WAVE}))
        self.refused("beside two run folders", run, other, "--set", "time.end=1 s")
        self.refused("beside two run folders", run, other, "--openfoam", "fluid.courant=0.1")
        self.refused("found no result of magfsi cost", run, other, "--bars-second",
                     testing.new_folder())
        self.refused("over equilibrium", run, made({"t[s]": TIMES, ENERGY: WAVE},
                                                      {"time": {"end": 1, "equilibrium": {}}}))

    def test_words_that_are_none(self):
        run, other = made({"t[s]": TIMES, ENERGY: WAVE}), made({"t[s]": TIMES, ENERGY: WAVE})
        for words, says in ((("--field", "colour"), "invalid choice"),
                            (("--plane", "xx"), "invalid choice"),
                            (("--names", "a"), "two that differ"),
                            (("--names", "a,a"), "two that differ")):
            done = called(run, other, *words)
            self.assertEqual(done.code, 2)
            self.assertIn(says, done.err)

    def test_scenes_without_fluid_or_probes_and_none(self):
        self.refused("found no fluid in the scene", testing.ROOT / "tutorials/beam")
        self.refused("found no probes in the scene", testing.SMALL, "--set", "probes=")
        self.refused("nowhere", "nowhere.yaml")
        self.refused("--openfoam KEY=VALUE", testing.SMALL, "--openfoam", "fluid.corant=0.1")


if __name__ == "__main__":
    unittest.main()
