"""The studies of one scene on several computers, by Debian's Python with nothing but its standard library: `computers_test.py PROGRAM
MODULE_FOLDER`."""

import contextlib
import io
import json
import os
import pathlib
import signal
import subprocess
import sys
import tempfile
import time
import unittest
from unittest import mock

PROGRAM, MODULES = sys.argv[1:3]
os.environ["DMPC"] = PROGRAM
sys.path.insert(0, MODULES)
from dmpc import program  # noqa: E402
from dmpc.computers import command  # noqa: E402
from dmpc.studies import plots  # noqa: E402
from dmpc.studies.runs import PARTS  # noqa: E402


def study(name, *words, size=32):
    """Its status, its table, which has "rows" and "notes", and what it says."""
    printed, errors = io.StringIO(), io.StringIO()
    with contextlib.redirect_stdout(printed), contextlib.redirect_stderr(errors):
        status = command.main([name, f"--resolution={size}x{size}", "--format=json", "--quiet", *words])
    return status, json.loads(printed.getvalue() or "{}"), errors.getvalue()


def rows(name, *words, **more):
    return study(name, *words, **more)[1]["rows"]


def column(table, name):
    return [row[name] for row in table]


def stats(scene, *words, size=32):
    return program.counters(["render", scene, f"--resolution={size}x{size}", *words])


class SpeedupTest(unittest.TestCase):
    def test_more_nodes_take_less_time_at_an_efficiency_below_the_first_rows_and_the_parts_of_each_row_add_up(self):
        for strategy in ("svm", "dataflow", "replicated", "forest"):
            table = rows("speedup", f"--strategy={strategy}", "--nodes=1,3,8", "tetra-3")
            self.assertEqual((table[0]["speedup"], table[0]["efficiency"]), (1, 100))
            for row in table:
                self.assertLessEqual(row["virtual_time"], table[0]["virtual_time"])
                self.assertLessEqual(row["efficiency"], 100)
                self.assertAlmostEqual(row["speedup"], row["nodes"] * row["efficiency"] / 100)
                self.assertAlmostEqual(sum(row[part] for part in PARTS), 100)

    def test_a_row_is_that_of_a_run_by_itself_and_another_machine_says_something_else(self):
        words = ["--nodes=5", "--cache-pages=7", "--page-size=2KiB"]
        [row], alone = rows("speedup", *words, "tetra-3"), stats("tetra-3", *words, "--runner=virtual")
        self.assertEqual([row["virtual_time"], row["run_hash"], row["node_memory"], row["link_wait"]],
                         [alone["virtual_seconds"]["total"], alone["run_hash"], alone["options"]["node_memory"], alone["links"]["wait"]])
        self.assertNotEqual(rows("speedup", *words, "--machine=hdr", "tetra-3"), [row])

    def test_what_the_scene_does_not_fit_has_a_row_without_figures_and_a_note_and_the_first_that_fits_is_the_base(self):
        for strategy in ("svm", "dataflow"):
            status, table, _ = study("speedup", f"--strategy={strategy}", "--nodes=1,8,16", "--node-memory=500KiB", "tetra-6")
            self.assertEqual((status, set(table["rows"][0].values())), (0, {1, None}))
            told = [note for note in table["notes"] if "does not fit" in note]
            self.assertRegex(" ".join(told), r"^1 node: the scene does not fit. --node-memory=500KiB is too small for --nodes=1: .*[^.]\.$")
            self.assertEqual(column(table["rows"][1:2], "speedup") + column(table["rows"][1:2], "efficiency"), [8, 100])
            self.assertLess(table["rows"][2]["efficiency"], 100)

    def test_where_nothing_fits_all_rows_are_there_without_figures_and_the_status_says_so(self):
        status, table, said = study("speedup", "--strategy=replicated", "--nodes=1,4", "--node-memory=500KiB", "tetra-6")
        self.assertEqual((status, column(table["rows"], "virtual_time")), (4, [None, None]))
        self.assertRegex(said, "^dmpc: .* is too small for --nodes=1: ")
        self.assertEqual(table["notes"][-1], "No picture was rendered.")
        self.assertFalse([note for note in table["notes"] if "missing" in note])

    def test_memory_that_the_real_computer_lacks_is_no_misfit_but_an_error(self):
        line = "study speedup balls-1 --strategy=dataflow --nodes=1,64 --ray-queue=16384 --ray-batch=546 --resolution=8x8".split()
        done = subprocess.run(["/bin/sh", "-c", 'ulimit -v 3000000; exec "$0" "$@"', PROGRAM, *line], capture_output=True, text=True,
                              env={**os.environ, "PYTHONPATH": MODULES})
        self.assertEqual((done.returncode, done.stderr.startswith("dmpc: this computer has no ")), (4, True), done.stderr)
        self.assertNotIn("does not fit", done.stdout)

    def test_notes_say_what_ran_what_was_reduced_and_of_prices_for_another_structure(self):
        for words, wanted in (
                ([], "strategy svm, memory as much as it needs, cache of a quarter of the database (lru), 16 pixels in flight, work items "
                     "of 3x3."),
                (["--node-memory=1MiB", "--cache-pages=5", "--replacement=fifo", "--in-flight=4", "--work-item=0"],
                 "memory 1MiB a node, cache of 5 pages (fifo), 4 pixels in flight, no work given away."),
                (["--strategy=dataflow", "--cuts=alternating"],
                 "regions by the subsampled picture and alternating cuts, mapped onto the machine."),
                (["--bundles"], "work items of 4x4."), (["--strategy=replicated"], "needs, 1 pixel in flight, work items of 3x3.")):
            notes = study("speedup", *words, "--nodes=2", "balls-1")[1]["notes"]
            self.assertTrue(notes[0].startswith("Machine ipsc2 (machine_digest ") and notes[0].endswith(wanted), notes[0])
        notes = study("speedup", "--nodes=2,3", "--node-memory=400KiB", "--in-flight=4000", "--machine=ipsc2-1994", "balls-1")[1]["notes"]
        self.assertEqual([note[:40] for note in notes[4:6]], [f"{nodes} nodes: in-flight reduced from 4000 to " for nodes in (2, 3)])
        self.assertTrue(notes[6].startswith("ipsc2-1994 has prices for other structures (voxels) than grid"))
        self.assertTrue(notes[7].startswith("Film of every run, 2 in all: ") and len(notes) == 8)


class CommandTest(unittest.TestCase):
    def test_the_title_says_what_is_rendered_and_paths_have_a_film_of_their_own(self):
        whitted, paths = (study("speedup", "--nodes=2", *words, "balls-1")[1] for words in ([], ["--transport=paths", "--bounces=1"]))
        self.assertTrue(whitted["title"].startswith("Study speedup of balls-1: 32x32 pixels, 1 sample a pixel, depth 5, convention haines, "
                                                    "record order spatial, "), whitted["title"])
        self.assertIn("1 sample a pixel, paths, 1 bounce, convention haines", paths["title"])
        self.assertNotEqual(whitted["notes"][-1], paths["notes"][-1])
        voxels = study("speedup", "--nodes=2", "--structure=voxels", "--voxels=article", "balls-1")[1]
        self.assertIn(", structure voxels (article), ", voxels["title"])

    def test_a_database_stands_for_its_scene_and_a_scene_that_there_is_not_is_bad_input(self):
        with tempfile.TemporaryDirectory() as folder:
            path = str(pathlib.Path(folder, "rings.pages"))
            program.run(["build", "rings-2-t1", "--page-size=2KiB", "-o", path])
            self.assertEqual(rows("speedup", "--nodes=2", path), rows("speedup", "--nodes=2", "--page-size=2KiB", "rings-2-t1"))
        status, _, said = study("speedup", "nonsense-3")
        self.assertTrue(status == 1 and "there is no built-in scene 'nonsense-3'" in said, said)

    def test_every_series_of_a_plot_has_points_and_plots_are_written_beside_the_table_that_they_are_drawn_from(self):
        drawn = []

        def draw(plot, table):
            drawn.append(plot.name)
            for series in plot.series:
                self.assertTrue(plots.points(plot, series, table), (plot.name, series.label))
            return ""

        for name in ("speedup",):
            with tempfile.TemporaryDirectory() as folder, mock.patch.object(plots, "draw", draw), mock.patch.object(plots, "check"):
                drawn.clear()
                self.assertEqual(study(name, "--nodes=2,3", f"--plots={folder}/new", "balls-1", size=16)[0], 0)
                self.assertEqual(sorted(os.listdir(f"{folder}/new")), sorted([f"{name}.csv", *(f"{plot}.svg" for plot in drawn)]))
                self.assertGreater(len(drawn), 0)

    def test_without_matplotlib_plots_are_refused_before_any_run(self):
        with mock.patch("importlib.util.find_spec", return_value=None):
            self.assertEqual(study("speedup", "--plots=none", "balls-1"),
                             (1, {}, "dmpc: --plots needs Python's module matplotlib: apt-get install python3-matplotlib\n"))

    def test_ctrl_c_leaves_the_rows_that_are_finished_and_no_scratch_file(self):
        for sent in (signal.SIGINT, signal.SIGTERM):
            with tempfile.TemporaryDirectory() as folder:
                line = [PROGRAM, "study", "speedup", "balls-3", "--resolution=16x16", "--nodes=" + ",".join(map(str, range(1, 1000)))]
                running = subprocess.Popen([*line, "--format=csv", "-o", f"{folder}/table"], stderr=subprocess.PIPE, text=True,
                                           env={**os.environ, "PYTHONPATH": MODULES, "TMPDIR": folder})
                while not any(path.stat().st_size > 5000 for path in pathlib.Path(folder).glob("dmpc-study-*/runs.jsonl")):
                    self.assertIsNone(running.poll())
                    time.sleep(0.1)
                running.send_signal(sent)
                said = running.communicate()[1]
                self.assertEqual((running.returncode, said), (130, "dmpc: interrupted, the table has the rows finished before\n"))
                self.assertEqual(os.listdir(folder), ["table"])
                table = pathlib.Path(folder, "table").read_text().splitlines()
                self.assertTrue(table[0].startswith("nodes,virtual time (s)") and table[1].startswith("1,"))

    def test_a_table_that_would_replace_what_the_study_reads_is_refused_before_any_run(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder, "mine.json")
            path.write_text(program.run(["machine", "hdr"]))
            done = subprocess.run([PROGRAM, "study", "speedup", "balls-1", f"--machine={path}", "-o", path], capture_output=True, text=True)
            self.assertEqual((done.returncode, done.stdout), (2, ""), done.stderr)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
