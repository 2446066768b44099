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


class TrafficTest(unittest.TestCase):
    def test_with_one_node_nothing_travels(self):
        [row] = rows("traffic", "--nodes=1", "balls-1")
        self.assertEqual({row[name] for name in ("rays_sent", "ray_packets", "ray_traffic", "faults", "page_traffic", "hops_a_ray")}, {0})
        self.assertEqual([row["average_load"], row["packet_fill"], row["overflow"]], [100, None, None])

    def test_figures_of_rays_and_pages_are_those_of_their_own_runs(self):
        status, table, _ = study("traffic", "--nodes=2,4", "rings-2-t1")
        row, words = table["rows"][1], ["--nodes=4", "--no-skip=bundles", "--strategy=dataflow"]
        own, pages = stats("rings-2-t1", *words), stats("rings-2-t1", "--nodes=4")
        self.assertEqual([row["rays_sent"], row["hops_a_ray"], row["dataflow_memory"], row["svm_memory"]],
                         [own["travel"]["rays_out"]["total"], own["travel"]["messages_per_ray"], own["options"]["node_memory"],
                          pages["options"]["node_memory"]])
        self.assertAlmostEqual(row["average_load"], 100 * own["load"]["average"])
        self.assertGreater(row["average_load"], row["average_load_equal_size"])
        self.assertTrue(0 < row["ray_packets"] <= row["rays_sent"] and 0 < row["packet_fill"] <= 100 and row["overflow"] >= 0)
        self.assertTrue(row["ray_traffic"] > 80 * row["rays_sent"] and row["page_traffic"] >= 1024 * row["faults"] > 0)
        self.assertTrue(table["notes"][-1].startswith("Film of every run, 6 in all: "))


CUTTINGS = ["subsampled", "subsampled, alternating", "equal size", "scattered, 16 a node"]


class BalanceTest(unittest.TestCase):
    def test_each_number_of_nodes_has_a_row_for_each_way_to_cut_whose_figures_are_those_of_its_own_run(self):
        status, table, _ = study("balance", "--nodes=5,8", "tetra-3")
        self.assertEqual([(row["nodes"], row["regions"]) for row in table["rows"]],
                         [(nodes, name) for nodes in (5, 8) for name in CUTTINGS])
        self.assertEqual(column(table["rows"][2:4], "average_load_predicted"), [None, None])
        self.assertTrue(table["notes"][-1].startswith("Film of every run, 8 in all: "))
        for row, words in zip(table["rows"][4:], ("", "--cuts=alternating", "--balance=equal-size", "--balance=scattered --regions=16")):
            own = stats("tetra-3", "--nodes=8", "--strategy=dataflow", "--no-skip=bundles", *words.split())
            self.assertEqual([row["moves_a_ray"], row["duplication"], row["hops"], row["hops_at_random"], row["average_load_achieved"]],
                             [own["travel"]["messages_per_ray"], own["regions"]["duplication"], own["mapping"]["mean_hops"],
                              own["mapping"]["mean_hops_random"], 100 * own["load"]["average"]])
        self.assertNotEqual(table["rows"][4]["moves_a_ray"], table["rows"][5]["moves_a_ray"])

    def test_regions_by_the_subsampled_picture_and_scattered_ones_are_more_even_than_those_of_equal_size(self):
        table = rows("balance", "--nodes=8", "--subsample=2", "rings-2-t1", size=64)
        sampled, alternating, equal, scattered = column(table, "average_load_achieved")
        self.assertTrue(min(sampled, alternating) > 1.5 * equal and scattered > equal)
        coarser = rows("balance", "--nodes=8", "rings-2-t1", size=64)
        self.assertNotEqual(table[0]["average_load_predicted"], coarser[0]["average_load_predicted"])

    def test_one_node_is_all_the_load_and_a_crossbar_has_all_nodes_a_hop_away(self):
        alone, wired = rows("balance", "--nodes=1", "balls-1")[0], rows("balance", "--nodes=6", "--topology=crossbar", "balls-1")[0]
        self.assertEqual([alone[name] for name in ("average_load_achieved", "moves_a_ray", "hops", "hops_at_random")], [100, 0, None, None])
        self.assertEqual([wired["hops"], wired["hops_at_random"]], [1, 1])
        self.assertGreater(rows("balance", "--nodes=6", "--topology=mesh", "balls-1")[0]["hops_at_random"], 1)

    def test_rows_by_node_follow_their_run_and_share_out_the_whole(self):
        table = rows("balance", "--nodes=3", "--per-node", "rings-2-t1")
        self.assertEqual(column(table, "node"), 4 * [None, 0, 1, 2])
        for name in ("share_predicted", "share_achieved"):
            self.assertAlmostEqual(sum(column(table[1:4], name)), 100)
        self.assertEqual([table[0]["share_achieved"], table[1]["hops"], table[9]["share_predicted"]], [None] * 3)

    def test_the_articles_figures_stand_below_its_scene_alone(self):
        for scene, count in (("rings-3-t1", 1), ("rings-2-t1", 0)):
            notes = study("balance", "--nodes=2", scene, size=8)[1]["notes"]
            self.assertEqual(sum("82.5 %" in note for note in notes), count)


QUARTER, FIFTHS, WORKING_SET, KEPT, QUESTIONS, RAYS = range(6)


class FramesTest(unittest.TestCase):
    def table(self, degrees, *words):
        status, table, said = study("frames", "--nodes=3", "--frames=3", f"--turntable={degrees}", *words, "rings-2-t1")
        self.assertEqual((status, said), (0, ""))
        return table["rows"]

    def test_pages_have_four_caches_and_questions_and_rays_no_faults_and_each_is_a_run_of_the_count(self):
        status, table, _ = study("frames", "--nodes=3,2", "--frames=2", "--machines=ipsc2,hdr", "rings-2-t1", size=16)
        shown = table["rows"]
        self.assertEqual([(row["machine"], row["nodes"]) for row in shown[::6]], [("ipsc2", 3), ("ipsc2", 2), ("hdr", 3), ("hdr", 2)])
        self.assertGreater(shown[KEPT]["time_warm"], 100 * shown[12 + KEPT]["time_warm"])
        self.assertTrue(shown[QUARTER]["cache_pages"] < shown[FIFTHS]["cache_pages"] and shown[FIFTHS]["share_of_database"] >= 40)
        for row in (shown[QUESTIONS], shown[RAYS]):
            self.assertEqual([row["faults_cold"], row["cache_pages"]], [None, None])
            self.assertGreater(row["traffic_cold"], 0)
        self.assertEqual([note.split(" (")[0] for note in table["notes"][:2]], ["Machine ipsc2", "Machine hdr"])
        self.assertTrue(table["notes"][-1].startswith("Film of every run, 24 in all: "))

    def test_a_camera_that_stands_still_finds_all_that_it_fetched_and_cold_nodes_fetch_it_anew(self):
        shown = self.table(0)
        self.assertGreater(shown[KEPT]["faults_cold"], 0)
        self.assertEqual([shown[KEPT]["faults_warm"], shown[KEPT]["warm_faults"]], [0, 0])
        for name in ("traffic", "messages", "time"):
            self.assertEqual(shown[RAYS][f"{name}_warm"], shown[RAYS][f"{name}_cold"])

    def test_questions_leave_nothing_behind_and_where_all_is_kept_a_warm_frame_has_fewer_faults_and_messages(self):
        shown = self.table(2)
        for name in ("messages", "traffic", "time"):
            self.assertEqual(shown[QUESTIONS][f"{name}_warm"], shown[QUESTIONS][f"{name}_cold"])
            self.assertLess(shown[KEPT][f"{name}_warm"], shown[KEPT][f"{name}_cold"])
        self.assertTrue(shown[KEPT]["faults_warm"] < shown[KEPT]["faults_cold"] == shown[WORKING_SET]["faults_cold"])
        self.assertLess(shown[KEPT]["worst_warm_faults"], 100)
        words = ["--turntable=2", "--nodes=3", "--runner=virtual", f"--cache-pages={shown[KEPT]['cache_pages']}"]
        cold = [stats("rings-2-t1", f"--frames={frame}..{frame}", *words)[0] for frame in (1, 2, 3)]
        self.assertEqual(shown[WORKING_SET]["cache_pages"], max(node["pages"]["faults"] for one in cold for node in one["nodes"]))

    def test_single_frames_have_rows_that_their_means_follow_and_are_those_of_their_own_runs(self):
        shown = self.table(2, "--each-frame")
        self.assertEqual(column(shown, "frames"), 6 * ["1", "2", "3", "2 to 3"])
        first, second, third, means = shown[4 * KEPT:4 * KEPT + 4]
        self.assertEqual([first["warm_faults"], first["faults_warm"]], [100, first["faults_cold"]])
        self.assertEqual(means["faults_warm"], (second["faults_warm"] + third["faults_warm"]) / 2)
        self.assertEqual(means["worst_warm_faults"], max(second["warm_faults"], third["warm_faults"]))
        words = ["--frames=1..3", "--turntable=2", "--nodes=3", "--runner=virtual", f"--cache-pages={first['cache_pages']}"]
        for row, own in zip((first, second, third), stats("rings-2-t1", *words)):
            self.assertEqual([row["faults_warm"], row["messages_warm"], row["time_warm"], row["traffic_warm"]],
                             [own["pages"]["faults"], own["packets"]["sent"], own["virtual_seconds"]["total"],
                              own["packets"]["by_kind"]["page_reply"]["bytes"]])

    def test_a_path_of_keyframes_moves_the_camera_and_a_database_is_refused(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder, "walk.txt")
            path.write_text("1 4,3,5/0,0,0\n2 5,3,4/0,0,0\n")
            status, table, _ = study("frames", "--nodes=2", "--frames=2", f"--camera-path={path}", "balls-1", size=8)
        self.assertEqual((status, sum("keyframes of " in note for note in table["notes"])), (0, 1))
        said = "dmpc: x.pages: study frames builds databases of its own: expected a scene\n"
        self.assertEqual(study("frames", "x.pages")[::2], (2, said))


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
            mesh = pathlib.Path(folder, "one triangle.obj")
            mesh.write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nl 1 2\nf 1 2 3\nf 1 1 2\n")
            program.run(["build", str(mesh), "--resolution=8x8", "-o", path])
            stored = study("speedup", "--nodes=2", path, size=8)[1]["title"]
            self.assertIn("8x8 pixels, samples refined to an error of 2.550/255, paths, ", stored)
            status, table, said = study("speedup", "--nodes=2,3", str(mesh), size=8)
            self.assertEqual((status, said.count("1 degenerate primitive"), said.count("points and lines left out: 1")), (0, 1, 1))
            self.assertIn("8x8 pixels, 1 sample a pixel, depth 5, ", table["title"])
        status, _, said = study("speedup", "nonsense-3")
        self.assertTrue(status == 1 and "there is no built-in scene 'nonsense-3'" in said, said)

    def test_runs_that_give_different_films_are_an_error_of_dmpcs_own_below_the_rows_before(self):
        real = program.counters

        def counters(words, noted):
            return {**real(words, noted), **({"film_hash": "0"} if "--nodes=3" in words else {})}

        with mock.patch.object(program, "counters", counters):
            status, table, said = study("speedup", "--nodes=2,3,4", "balls-1")
        self.assertEqual((status, column(table["rows"], "nodes"), table["notes"][4]), (3, [2], "Ended by an error: rows are missing."))
        self.assertRegex(said, "^dmpc: this is a bug in dmpc, please report it: render .* --nodes=3 .* gives another film$")

    def test_every_series_of_a_plot_has_points_and_plots_are_written_beside_the_table_that_they_are_drawn_from(self):
        drawn = []

        def draw(plot, table):
            drawn.append(plot.name)
            for series in plot.series:
                self.assertTrue(plots.points(plot, series, table), (plot.name, series.label))
            return ""

        for name in ("speedup", "traffic", "balance", "frames"):
            with tempfile.TemporaryDirectory() as folder, mock.patch.object(plots, "draw", draw), mock.patch.object(plots, "check"):
                drawn.clear()
                self.assertEqual(study(name, "--nodes=8,9", f"--plots={folder}/new", "balls-1", size=16)[0], 0)
                self.assertEqual(sorted(os.listdir(f"{folder}/new")), sorted([f"{name}.csv", *(f"{plot}.svg" for plot in drawn)]))
                self.assertGreater(len(drawn), 0)

    def test_without_matplotlib_plots_are_refused_before_any_run(self):
        with mock.patch("importlib.util.find_spec", return_value=None):
            self.assertEqual(study("speedup", "--plots=none", "balls-1"),
                             (1, {}, "dmpc: --plots needs Python's module matplotlib: apt-get install python3-matplotlib\n"))

    def test_ctrl_c_leaves_the_rows_that_are_finished_and_no_scratch_file(self):
        for sent in (signal.SIGINT, signal.SIGTERM, signal.SIGKILL):
            with tempfile.TemporaryDirectory() as folder:
                line = [PROGRAM, "study", "speedup", "balls-3", "--resolution=16x16", "--nodes=" + ",".join(map(str, range(1, 1000)))]
                running = subprocess.Popen([*line, "--format=csv", "-o", f"{folder}/table"], stderr=subprocess.PIPE, text=True,
                                           env={**os.environ, "PYTHONPATH": MODULES, "TMPDIR": folder})
                while not any(path.stat().st_size > 5000 for path in pathlib.Path(folder).glob("dmpc-*/runs.jsonl")):
                    self.assertIsNone(running.poll())
                    time.sleep(0.1)
                running.send_signal(sent)
                said = running.communicate()[1]
                if sent == signal.SIGKILL:
                    while os.listdir(folder):
                        time.sleep(0.1)
                    continue
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
