"""What studies in Python share, run by Debian's Python with nothing but its standard library: `studies_test.py PROGRAM MODULE_FOLDER`."""

import contextlib
import importlib.util
import io
import json
import os
import pathlib
import sys
import tempfile
import time
import unittest
from types import SimpleNamespace
from unittest import mock

PROGRAM, MODULES = sys.argv[1:3]
os.environ["DMPC"] = PROGRAM
sys.path.insert(0, MODULES)
from dmpc import program  # noqa: E402
from dmpc.studies import judging, output, runs, search, texts  # noqa: E402
from dmpc.studies.table import Column, Table, shortest  # noqa: E402


def small_table():
    table = Table("two runs", [Column("nodes"), Column("kind"), Column("average load", "%", 1)])
    table.add([1234567, "plain", 82.46])
    table.add([8, "missing", None])
    return table


class TableTest(unittest.TestCase):
    def test_markdown_has_its_columns_in_line_and_notes_as_a_list_below(self):
        table = small_table()
        table.note("One.")
        self.assertEqual(table.text("markdown"),
                         "**two runs**\n\n"
                         "|     nodes | kind    | average load (%) |\n"
                         "|----------:|---------|-----------------:|\n"
                         "| 1,234,567 | plain   |             82.5 |\n"
                         "|         8 | missing |                  |\n"
                         "\n- One.\n")

    def test_a_text_cannot_end_its_cell_or_its_row(self):
        table = Table("title", [Column("a")])
        table.add(["x|y\nz"])
        self.assertIn("| x\\|y z |\n", table.text("markdown"))

    def test_a_wide_table_stands_in_parts_each_with_the_columns_that_tell_its_rows_apart(self):
        table = Table("wide", [Column("scene"), Column("nodes"), *(Column(f"a figure with a long name {number}") for number in range(12))])
        for nodes in (1, 2):
            table.add(["teapot", nodes, *[7] * 12])
        lines = table.text("markdown").splitlines()
        self.assertLessEqual(max(map(len, lines)), 120)
        self.assertEqual(sum(line.startswith("| scene  | nodes | a figure") for line in lines), 4)

    def test_rows_are_numbered_where_much_would_be_needed_to_tell_them_apart(self):
        table = Table("alike", [Column("a" * 80), Column("b" * 80)])
        table.add(["x", "y"])
        table.add(["x", "y"])
        self.assertIn("| row | " + "a" * 80 + " |\n", table.text("markdown"))
        self.assertIn("|   2 | y ", table.text("markdown"))
        self.assertNotIn("| row |", Table("120 letters", [Column("a" * 57), Column("b" * 56)]).text("markdown"))
        self.assertIn("| row |", Table("121 letters", [Column("a" * 57), Column("b" * 57)]).text("markdown"))

    def test_rows_below_a_heading_stand_in_a_table_of_their_own(self):
        table = Table("Title", [Column("on", is_heading=True), Column("who"), Column("seconds", "s", 1)])
        for row in (["land", "a", 1.0], ["sea", "a", 2.0], ["land", "longer", 3.0]):
            table.add(row)
        self.assertEqual(table.text("markdown"),
                         "**Title**\n"
                         "\n**on land**\n"
                         "\n| who    | seconds (s) |\n|--------|------------:|\n| a      |         1.0 |\n| longer |         3.0 |\n"
                         "\n**on sea**\n"
                         "\n| who | seconds (s) |\n|-----|------------:|\n| a   |         2.0 |\n")
        self.assertEqual(table.text("csv"), "on,who,seconds (s)\nland,a,1\nsea,a,2\nland,longer,3\n")

    def test_csv_quotes_its_own_signs_and_what_would_be_a_formula(self):
        table = Table("title", [Column("a, b"), Column("change", "%")])
        for row in (['he said "no"', -2.5], ["=1+1", 2.5], ["-2+3+cmd", None], ["-", None], ["-3", None]):
            table.add(row)
        self.assertEqual(table.text("csv"),
                         '"a, b",change (%)\n"he said ""no""",-2.5\n\'=1+1,2.5\n\'-2+3+cmd,\n-,\n-3,\n')

    def test_numbers_of_csv_are_the_shortest_that_read_back(self):
        numbers = (0.0, 12.0, 0.25, 5e-4, 100000.0, 123456.5, -1e22, 1 / 3, 5e-324)
        self.assertEqual([shortest(each) for each in numbers],
                         ["0", "12", "0.25", "5e-04", "1e+05", "123456.5", "-1e+22", "0.3333333333333333", "5e-324"])
        self.assertTrue(all(float(shortest(each)) == each for each in numbers))

    def test_json_has_names_units_and_null_for_what_is_missing(self):
        table = small_table()
        table.note("A note.")
        self.assertEqual(json.loads(table.text("json")), {
            "format": program.FORMAT, "title": "two runs", "notes": ["A note."],
            "columns": [{"name": "nodes", "unit": None}, {"name": "kind", "unit": None}, {"name": "average_load", "unit": "%"}],
            "rows": [{"nodes": 1234567, "kind": "plain", "average_load": 82.46}, {"nodes": 8, "kind": "missing", "average_load": None}]})
        self.assertEqual(table.text("jsonl").splitlines()[1], '{"nodes":8,"kind":"missing","average_load":null}')

    def test_a_row_that_is_added_is_shown_as_much_as_fits_a_line(self):
        shown = []
        table = Table("two runs", [Column("nodes"), Column("average load", "%", 1), Column("x" * 80)], shown.append)
        table.add([4, 82.46, "far away"])
        table.add([8, None, None])
        self.assertEqual(shown, ["nodes 4, average load (%) 82.5", "nodes 8"])

    def test_a_row_of_another_length_and_a_number_that_is_none_are_refused(self):
        for row in ([1, "kind"], [1, "kind", float("inf")]):
            with self.assertRaises(ValueError):
                small_table().add(row)


class TextTest(unittest.TestCase):
    def test_times_have_three_digits_in_the_unit_that_suits_them(self):
        self.assertEqual([texts.time_text(each) for each in (10.0, 1.005, 0.0031, 2.6e-5, 4e-9, 250.0)],
                         ["10.0 s", "1.00 s", "3.10 ms", "26.0 us", "4 ns", "250 s"])

    def test_no_line_but_the_first_begins_as_an_item_does(self):
        self.assertEqual(texts.folded("- aaaa bbbb - 12. cccc", 12), "- aaaa\n  bbbb - 12.\n  cccc")


def line_of(setting):
    return " ".join(f"{name}={value}" for name, value in setting.items())


def searched(options, seconds):
    """What the search finds and the lines that it tries, where `seconds` returns those of a line, or None without room."""
    tried, kept = [], mock.Mock()
    kept.get.side_effect = lambda lines: tried.extend(lines) or [
        {} if seconds(line) is None else {"seconds": seconds(line)} for line in lines]
    [found] = search.in_step(kept, [search.descend(options, line_of)])
    return found, tried


THREE = [search.Searched("page", ("1KiB", "4KiB")), search.Searched("fixed", ("yes",)), search.Searched("in-flight", ("16", "1", "64"))]


def plot_data(*series, **other):
    """As dmpc writes it, with limits and ticks along y; a series is its mark, colour and rows."""
    y = {"label": "time", "log": True, "least": 1, "most": 100, "ticks": [[1, "1 s"], [10, "10 s"]]}
    return {"title": "Times", "stacked": False, "width": 0, "x": {"label": "nodes", "log": False, "ticks": []}, "y": y, **other,
            "series": [{"name": f"the {mark}", "mark": mark, "color": color, "rows": rows} for mark, color, rows in series]}


@unittest.skipUnless(importlib.util.find_spec("matplotlib"), "there is no matplotlib")
class PlottingTest(unittest.TestCase):
    CURVES = plot_data(("line", 0, [[1, 50], [4, 20]]), ("points", 1, [[1, 60]]), ("intervals", 2, [[1, 30, 20, 40], [4, 10, 9, 12]]))

    def test_pictures_are_written_beside_their_data_the_same_each_time(self):
        from dmpc import plotting
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder)
            (path / "a.json").write_text(json.dumps(self.CURVES))
            plotting.main([folder, "a"])
            text = (path / "a.svg").read_text()
            for said in ("Times", "nodes", "1 s", "10 s", "the line", "the points", "the intervals", "#000000"):
                self.assertIn(said, text)
            self.assertEqual(text, plotting.drawn(self.CURVES, "a"))
            self.assertIn("currentColor", plotting.drawn(self.CURVES, "a", True))

    def test_bars_stand_beside_or_upon_each_other_and_from_the_ninth_colour_on_are_hatched(self):
        from dmpc import plotting
        from matplotlib.axes import Axes
        for stacked in (False, True):
            with mock.patch.object(Axes, "bar", autospec=True, side_effect=Axes.bar) as bar:
                plotting.drawn(plot_data(("bars", 0, [[0, 4], [1, 3]]), ("bars", 9, [[1, 2]]), places=["a", "b"], stacked=stacked), "b")
            (first, second), ninth = [call.args[1:] for call in bar.call_args_list], bar.call_args_list[1].kwargs
            self.assertEqual(second[0], [1] if stacked else [1.2])
            self.assertEqual((first[3], second[3]), ([0, 0], [3 if stacked else 0]))
            self.assertEqual((bar.call_args_list[0].kwargs["hatch"], ninth["hatch"]), (None, "//"))


class SearchTest(unittest.TestCase):
    def test_it_finds_the_optimum_where_options_do_not_depend_on_each_other_and_tells_its_steps(self):
        found, tried = searched(THREE, lambda line: 10 - 4 * ("4KiB" in line) - 3 * ("=64" in line) + 2 * line.endswith("=1"))
        self.assertEqual(found.setting, {"page": "4KiB", "fixed": "yes", "in-flight": "64"})
        self.assertEqual((found.seconds, len(tried)), (3, 4))
        self.assertEqual(found.steps_text(), "defaults 10.0 s, page 4KiB 6.00 s, in-flight 1 8.00 s, in-flight 64 3.00 s")

    def test_only_a_faster_value_replaces_the_best(self):
        found, tried = searched(THREE, lambda line: 5)
        self.assertEqual(tried, ["page=1KiB fixed=yes in-flight=16", "page=4KiB fixed=yes in-flight=16",
                                 "page=1KiB fixed=yes in-flight=1", "page=1KiB fixed=yes in-flight=64"])
        self.assertEqual(line_of(found.setting), tried[0])

    def test_what_has_no_room_is_never_the_best(self):
        found, _ = searched(THREE, lambda line: 9 if line.endswith("=1") else None)
        self.assertEqual(found.setting["in-flight"], "1")
        self.assertTrue(found.steps_text().startswith("defaults no room, page 4KiB no room, in-flight 1 9.00 s"))
        found, _ = searched(THREE, lambda line: None)
        self.assertEqual(found.seconds, float("inf"))


def result(computing=0.0, film=0.0, end=0.0, host=0.0):
    return {"host": host, "share": {"computing": computing, "film_wait": film, "idle_at_end": end}}


class JudgingTest(unittest.TestCase):
    def test_times_within_one_percent_are_a_tie_and_no_room_is_slower_than_any(self):
        self.assertTrue(judging.is_tie(1, 1.01) and not judging.is_faster(1, 1.01))
        self.assertTrue(judging.is_faster(1, 1.02) and not judging.is_faster(1.02, 1))
        self.assertTrue(judging.is_faster(1, float("inf")))

    def test_a_run_that_computes_is_large_enough(self):
        self.assertIsNone(judging.small(result(90, 5, 5, 0.2)))
        self.assertIsNone(judging.small(result(0, 25, 25, 0.5)))

    def test_where_film_or_host_decide_as_many_samples_would_do_as_make_the_rest_as_long(self):
        film, both = result(20, 75, host=0.1), result(20, 50, 25)
        self.assertEqual(judging.small_text(film), "nodes wait for film or are idle at the end for 75 % of the time")
        self.assertEqual(judging.remedy(film, 128, 128, 4), "--samples=12")
        self.assertEqual((judging.small(both), judging.remedy(both, 128, 128, 1)), ("film", "--samples=3"))
        host = result(50, host=1.0)
        self.assertEqual(judging.small_text(host), "the host is busy for 100 % of the time")
        self.assertEqual(judging.remedy(host, 128, 128, 1), "--samples=4")

    def test_where_the_end_decides_a_larger_picture_would_do(self):
        end = result(20, end=80)
        self.assertEqual(judging.small_text(end), "nodes are idle at the end or wait for film for 80 % of the time")
        self.assertEqual(judging.remedy(end, 128, 64, 1), "--resolution=256x128")

    def test_voxels_on_the_ipsc2_have_the_prices_that_were_fitted_to_them(self):
        self.assertEqual([judging.priced_for(*each) for each in (("ipsc2", "voxels"), ("ipsc2-1994", "grid"), ("hdr", "voxels"))],
                         ["ipsc2-1994", "ipsc2", "hdr"])


SMALL = "--resolution=16x16 --nodes=2 --runner=virtual"


class RunsTest(unittest.TestCase):
    def kept_in(self, folder, **more):
        return runs.Runs(folder, 2, lambda stats: {"seconds": stats["virtual_seconds"]["total"]}, lambda name: [name], **more)

    def test_runs_are_kept_by_their_line_with_databases_and_drawn_machines_and_misfits_are_no_errors(self):
        lines = [f"render databases/tetra-2.pages {SMALL} --machine=hdr", f"render tetra-2 {SMALL} --machine=machines/hdr.3.json",
                 f"render tetra-2 {SMALL} --machine=hdr --node-memory=1KiB"]
        told = []
        with tempfile.TemporaryDirectory() as folder:
            first = self.kept_in(folder, progress=lambda done, total: told.append((done, total))).get(lines)
            self.assertEqual(told, [(1, 3), (2, 3), (3, 3)])
            self.assertNotEqual(first[0]["seconds"], first[1]["seconds"])
            self.assertIn("--node-memory", first[2]["misfit"])
            with open(pathlib.Path(folder, "runs.jsonl"), "a") as file:
                file.write('{"line": "rend')
            with mock.patch.object(program, "counters", side_effect=AssertionError("nothing is run twice")):
                self.assertEqual(self.kept_in(folder).get(lines), first)

    def test_results_come_in_the_order_of_their_lines_and_an_error_in_its_place(self):
        def counters(words, noted):
            time.sleep(0.1 * (words[1] == "slow"))
            if words[1] == "bad":
                raise program.UsageError("bad")
            noted("in-flight reduced from 9 to 1")
            return {"virtual_seconds": {"total": 1.0}}

        with tempfile.TemporaryDirectory() as folder, mock.patch.object(program, "counters", side_effect=counters):
            came = []
            with self.assertRaises(program.UsageError):
                for result in self.kept_in(folder).each(["render slow", "render fast", "render slow", "render bad", "render never"]):
                    came.append(result["line"])
                    self.assertEqual(result["notes"], ["in-flight reduced from 9 to 1"])
        self.assertEqual(came, ["render slow", "render fast", "render slow"])

    def test_what_this_computer_has_no_room_for_is_no_misfit(self):
        said = program.CapacityError("dmpc: a note\ndmpc: this computer has no room for 64 nodes.")
        with tempfile.TemporaryDirectory() as folder, mock.patch.object(program, "counters", side_effect=said):
            with self.assertRaises(program.CapacityError):
                self.kept_in(folder).get(["render tetra-2"])

    def test_what_dmpc_complains_of_is_raised(self):
        with tempfile.TemporaryDirectory() as folder, self.assertRaisesRegex(program.UsageError, "--nodes"):
            self.kept_in(folder).get(["render tetra-2 --nodes=0"])


class OutputTest(unittest.TestCase):
    def run_with(self, measure, **more):
        options = SimpleNamespace(**{"format": "csv", "output": None, "quiet": False, "plots": None, **more})
        table, errors, printed = Table("t", [Column("a")]), io.StringIO(), io.StringIO()
        with contextlib.redirect_stderr(errors), contextlib.redirect_stdout(printed), mock.patch.object(output, "take_signals"):
            status = output.run(lambda: measure(table), table, options, output.Messages(options), lambda: ["Closing."])
        return status, printed.getvalue(), errors.getvalue(), table.notes

    def test_what_ends_the_measuring_leaves_the_rows_so_far_and_a_note_that_others_are_missing(self):
        def interrupted(table):
            table.add([1])
            raise KeyboardInterrupt

        def failing(table):
            table.add([1])
            raise program.CapacityError("no room")

        self.assertEqual(self.run_with(interrupted), (130, "a\n1\n", "dmpc: interrupted, the table has the rows finished before\n",
                                                      ["Interrupted: rows are missing.", "Closing."]))
        self.assertEqual(self.run_with(failing), (4, "a\n1\n", "dmpc: no room\n", ["Ended by an error: rows are missing.", "Closing."]))

    def test_without_rows_nothing_is_written(self):
        def interrupted(table):
            raise KeyboardInterrupt

        self.assertEqual(self.run_with(interrupted)[:3], (130, "", "dmpc: interrupted, nothing was written\n"))

    def test_a_file_is_replaced_at_once_and_one_that_cannot_be_written_is_an_error(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder, "table.csv")
            path.write_text("old")
            self.assertEqual(self.run_with(lambda table: table.add([1]), output=str(path))[:2], (0, ""))
            self.assertEqual((path.read_text(), os.listdir(folder)), ("a\n1\n", ["table.csv"]))
            status, _, said, _ = self.run_with(lambda table: table.add([1]), output=folder + "/none/table.csv")
            self.assertEqual((status, said.startswith("dmpc: -o ")), (1, True))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
