"""The study sweep, by Debian's Python with nothing but its standard library: `sweep_test.py PROGRAM MODULE_FOLDER`."""

import contextlib
import importlib.util
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

PROGRAM, MODULES = (os.path.abspath(path) for path in sys.argv[1:3])
os.environ.update(DMPC=PROGRAM, PYTHONPATH=MODULES)
sys.path.insert(0, MODULES)
from dmpc import program  # noqa: E402
from dmpc.sweeps import columns, command, figures, kept  # noqa: E402
from dmpc.sweeps.variation import Variation  # noqa: E402

TINY = ["balls-1", "--resolution=8x8", "--runner=virtual"]
NFF = """v
from 0 0 9
at 0 0 0
up 0 1 0
angle 45
hither 1
resolution 8 8
l 1 2 9
f 1 0 0 1 0 0 0 0
s 0 0 0 1
"""


def swept(*words, start=TINY, form="csv", renders=PROGRAM):
    """Status, table and complaints."""
    done = subprocess.run([PROGRAM, "study", "sweep", *start, f"--format={form}", *map(str, words)], capture_output=True, text=True,
                          env={**os.environ, "DMPC": str(renders)})
    return done.returncode, done.stdout, done.stderr


def table(*words, **more):
    status, text, said = swept(*words, **more)
    assert status == 0, said
    return text


def described(*words, **more):
    return json.loads(table(*words, form="json", **more))


def column(found, name):
    return [row[name] for row in found["rows"]]


class FolderTest(unittest.TestCase):
    def setUp(self):
        whole = tempfile.TemporaryDirectory()
        self.addCleanup(whole.cleanup)
        self.folder = pathlib.Path(whole.name)
        self.runs, self.calls = self.folder / "runs", self.folder / "calls"

    def calling(self, *lines):
        """A program that notes what it does, and does what dmpc does, unless a line of its own says otherwise."""
        path = self.folder / "dmpc"
        path.write_text("\n".join(["#!/bin/sh", f"echo begin $1 >> {self.calls}", *lines, f'{PROGRAM} "$@"; s=$?',
                                   f"echo end >> {self.calls}", "exit $s"]))
        path.chmod(0o700)
        return path

    def count(self):
        """Of renders."""
        return self.calls.read_text().count("begin render")


class TableTest(FolderTest):
    def test_every_combination_has_a_row_the_last_option_changes_fastest_and_sizes_are_in_bytes(self):
        words = ["--vary=nodes:1,3", "--vary=--page-size:1KiB,4KiB", "--columns=faults,virtual_seconds"]
        text = table(*words)
        self.assertTrue(text.startswith("nodes,page-size (bytes),pages.faults,virtual_seconds.total (s)\n1,1024,0,"), text)
        self.assertEqual([line.split(",")[:2] for line in text.splitlines()[1:]], [[a, b] for a in "13" for b in ("1024", "4096")])
        self.assertEqual(table(*words), text)
        lines = table("--vary=nodes:1,3", "--columns=faults", form="jsonl").splitlines()
        self.assertEqual([sorted(json.loads(line)) for line in lines], [["nodes", "pages.faults"]] * 2)

    def test_a_row_is_that_of_a_run_by_itself_with_the_flags_that_are_on(self):
        found = described("--vary=count-pages:off,on", "--nodes=3", "--columns=run_hash,distinct,options.count_pages")
        alone = [program.counters(["render", *TINY, "--nodes=3", *flag]) for flag in ([], ["--count-pages"])]
        self.assertEqual(column(found, "run_hash"), [stats["run_hash"] for stats in alone])
        self.assertEqual(column(found, "pages.distinct"), [stats["pages"]["distinct"] for stats in alone])
        self.assertEqual((column(found, "options.count_pages"), column(found, "count-pages")), (["false", "true"], ["off", "on"]))

    def test_a_mesh_file_has_one_ray_a_pixel_unless_something_is_said_of_that(self):
        mesh = self.folder / "a.obj"
        mesh.write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
        for more, as_if in ([[], ["--transport=whitted", "--samples=1"]], [["--error=0.1"], ["--transport=whitted", "--error=0.1"]],
                            [["--transport=paths", "--samples=2"], ["--transport=paths", "--samples=2"]]):
            line = [str(mesh), "--resolution=8x8", "--runner=virtual"]
            self.assertEqual(column(described("--vary=nodes:2", "--columns=film_hash", *more, start=line), "film_hash"),
                             [program.counters(["render", *line, *as_if, "--nodes=2"])["film_hash"]])

    def test_values_that_have_commas_have_semicolons_between_and_one_alone_a_semicolon_behind(self):
        for text, wanted in (("0,0,0;1,1,1", ["0,0,0", "1,1,1"]), ("0,0,0;", ["0,0,0"])):
            self.assertEqual(column(described(f"--vary=background:{text}", "--columns=rays.total"), "background"), wanted)

    def test_without_columns_there_are_times_of_the_runners_and_the_traffic_of_the_strategies(self):
        usual = ["rays.total", "packets.sent", "packets.bytes"]
        for words, wanted in ((["--runner=threads"], ["seconds.render", *usual, "pages.faults"]),
                              (["--runner=virtual", "--strategy=dataflow"], ["virtual_seconds.total", *usual, "travel.messages_per_ray"])):
            found = described("--vary=nodes:2", *words, start=TINY[:2])
            self.assertEqual([each["name"] for each in found["columns"]], ["nodes", *wanted])

    def test_a_combination_without_room_has_an_empty_row_and_a_note_and_where_none_has_that_is_the_error(self):
        found = described("--vary=node-memory:1KiB,4MiB", "--nodes=2", "--columns=faults")
        self.assertEqual((column(found, "pages.faults")[0], column(found, "node-memory")), (None, [1024, 4194304]))
        self.assertRegex(found["notes"][0], r"^No room with --node-memory=1KiB: .*[^.]\.$")
        status, text, said = swept("--vary=node-memory:1KiB,2KiB", "--nodes=2")
        self.assertEqual((status, text.count("\n"), "too small" in said), (4, 3, True), said)
        killed = described("--vary=nodes:1,2", "--columns=faults", renders=self.calling("case $* in *--nodes=1*) kill -9 $$;; esac"))
        self.assertRegex(killed["notes"][0], "^No room with --nodes=1: this computer .* killed")

    def test_a_sweep_over_machines_says_once_which_of_them_have_prices_for_other_structures(self):
        for structure, machine in (("voxels", "ipsc2"), ("grid", "ipsc2-1994")):
            [note] = described("--vary=machine:ipsc2,ipsc2-1994", "--vary=nodes:1,2", f"--structure={structure}")["notes"]
            self.assertTrue(note.startswith(f"{machine} has prices for other structures"))

    def test_models_run_side_by_side_and_threads_one_after_the_other(self):
        for runner, are_beside in (("virtual", len(os.sched_getaffinity(0)) > 1), ("threads", False)):
            self.calls.write_text("")
            table("--vary=depth:1,2,3", f"--runner={runner}", start=TINY[:2], renders=self.calling("sleep 0.3"))
            self.assertEqual("begin render\nbegin" in self.calls.read_text(), are_beside)

    def test_what_goes_wrong_is_told_before_anything_runs_with_what_was_meant(self):
        for words, told in (([], "there is nothing to vary"), (["--vary=node:2"], "Did you mean nodes?"),
                            (["--vary=nodes:2", "--columns=fautls"], "Did you mean faults?"),
                            (["--vary=nodes:2", "--columns=bytes"], "this may be any of "),
                            (["--vary=nodes:2", "--columns=faults,pages.faults"], "there twice"),
                            (["--vary=nodes:2", "--columns=faults,,rays"], "a word is missing"),
                            (["--vary=nodes:x"], "with --nodes=x dmpc render would say: --nodes=x: expected"),
                            (["--vary=nodes:2,3", "--vary=depth:0,1"], "with --nodes=2 --depth=0 dmpc render would say"),
                            (["--vary=nodes:2", "--nodes=2"], "given, and varied")):
            status, text, said = swept(*words, renders=self.calling())
            self.assertEqual((status, text, told in said, self.calls.exists()), (2, "", True, False), said)
        self.assertIn("has a column of its own", swept("--vary=runner:virtual", "--columns=runner", start=TINY[:2])[2])
        scene = self.folder / "a.nff"
        scene.write_text(NFF)
        self.assertEqual(swept("--vary=nodes:2", "-o", scene, start=[str(scene)])[0], 2)
        self.assertEqual(scene.read_text(), NFF)

    def test_a_run_that_fails_ends_the_sweep_with_its_combination_and_the_rows_before_it_are_written(self):
        failing = self.calling("case $* in *--nodes=2*) echo dmpc: too odd >&2; exit 1;; esac")
        status, text, said = swept("--vary=nodes:1,2", renders=failing)
        self.assertEqual((status, said, text.count("\n")), (1, "dmpc: the run with --nodes=2 failed: too odd\n", 2))

    def test_ctrl_c_gives_the_rows_that_are_finished_and_a_sweep_that_is_killed_leaves_neither_renders_nor_files(self):
        slow = ["balls-4", "--resolution=2048x2048"]
        line = [PROGRAM, "study", "sweep", "--runner=virtual", "--vary=nodes:2,3", "--format=csv"]
        for number, words, wanted in ((signal.SIGINT, ["balls-1", "--vary=resolution:8x8,2048x2048"], 130), (signal.SIGKILL, slow, -9)):
            running = subprocess.Popen([*line, *words], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, start_new_session=True,
                                       env={**os.environ, "TMPDIR": str(self.folder)})
            while self.renders() < (0 if number == signal.SIGKILL else 1):
                self.assertIsNone(running.poll())
            time.sleep(1)
            self.assertTrue(any(self.folder.iterdir()))
            running.send_signal(number)
            printed, said = running.communicate()
            self.assertEqual(running.returncode, wanted, said)
            if number == signal.SIGINT:
                self.assertEqual((said, printed.count("\n")), ("dmpc: interrupted, the table has the rows finished before\n", 2))
            end = time.monotonic() + 30
            while self.renders() or any(self.folder.iterdir()):
                self.assertLess(time.monotonic(), end, list(self.folder.iterdir()))
                time.sleep(0.1)

    def renders(self):
        """How many there are that write into the folder."""
        found = subprocess.run(["ps", "-eo", "args"], capture_output=True, text=True).stdout.splitlines()
        return sum("dmpc render" in line and str(self.folder) in line for line in found)


class KeptTest(FolderTest):
    def test_runs_that_are_kept_are_not_run_again_and_a_larger_sweep_adds_its_own(self):
        counting, runs = self.calling(), f"--runs={self.runs}"
        text = table("--vary=nodes:1,3", runs, renders=counting)
        self.assertEqual((table(runs, "--vary=nodes:1,3", renders=counting), self.count()), (text, 2))
        found = described("--vary=nodes:1,2,3", runs, renders=counting)
        self.assertEqual((self.count(), len(os.listdir(self.runs)), found["notes"]), (3, 3, ["2 of 3 runs kept from before."]))

    def test_what_is_kept_is_another_runs_where_the_program_an_option_or_a_file_that_is_read_is_another(self):
        scene, machine = self.folder / "a.nff", self.folder / "m.json"
        scene.write_text(NFF)
        machine.write_text(program.run(["machine", "hdr"]))

        def is_new(*words):
            before = self.count() if self.calls.exists() else 0
            table("--vary=nodes:2", f"--runs={self.runs}", f"--machine={machine}", "--runner=virtual", *words, start=[str(scene)],
                  renders=renders)
            return self.count() > before

        renders = self.calling()
        self.assertTrue(is_new("--depth=2", "--samples=1"))
        self.assertFalse(is_new("--samples=1", "--depth=2"))
        self.assertTrue(is_new("--samples=1", "--depth=3"))
        scene.write_text(NFF + "s 1 0 0 1\n")
        self.assertTrue(is_new("--samples=1", "--depth=3"))
        machine.write_text(program.run(["machine", "paragon"]))
        self.assertTrue(is_new("--samples=1", "--depth=3"))
        self.assertFalse(is_new("--samples=1", "--depth=3"))
        renders = self.calling("true")
        self.assertTrue(is_new("--samples=1", "--depth=3"))
        (self.folder / "dmpc_mesh_reader").write_text("another")
        self.assertTrue(is_new("--samples=1", "--depth=3"))

    def test_only_ordinary_files_of_counters_with_the_figures_asked_for_are_used_and_nothing_outside_is_changed(self):
        words = ["--vary=nodes:2", "--columns=faults,packets.bytes", f"--runs={self.runs}"]
        text, victim = table(*words), self.folder / "victim"
        [entry] = self.runs.iterdir()
        whole, counting = entry.read_text(), self.calling()
        wrong = [{"format": 1}, {"pages": {}}, {"packets": {"bytes": [7]}}, {"packets": {"bytes": float("nan")}}, {"options": 1},
                 {"machine": {"name": 7}}]
        for odd in ["", '{"format": 2, ', "[" * 100000, "7", *(json.dumps({**json.loads(whole), **each}) for each in wrong)]:
            entry.write_text(odd)
            self.assertEqual((table(*words), entry.read_text().count("film_hash")), (text, 1), odd[:100])
        for linked in ("mine", whole):
            victim.write_text(linked)
            entry.unlink()
            entry.symlink_to(victim)
            self.assertEqual((table(*words), victim.read_text(), entry.is_symlink()), (text, linked, False))
        entry.unlink()
        os.mkfifo(entry)
        pipe = os.open(entry, os.O_RDWR)
        os.write(pipe, whole.encode())
        self.assertEqual((table(*words), entry.is_file()), (text, True))
        os.close(pipe)
        os.truncate(entry, 3 << 30)
        self.assertEqual((table(*words), entry.read_text().count("film_hash")), (text, 1))
        self.assertEqual((swept("--vary=nodes:2", f"--runs={victim}", renders=counting)[0], self.calls.exists()), (1, False))

    def kept_with_databases(self, *words):
        """As table() with --runs, as if all databases were large, and what is said."""
        stand_in = self.folder / "modules/dmpc/sweeps"
        stand_in.mkdir(parents=True, exist_ok=True)
        for name in ("__init__.py", "../__init__.py"):
            (stand_in / name).touch()
        (stand_in / "command.py").write_text("import json, shutil\n\n\ndef main(words):\n"
                                             f"    shutil.copy(words[0].removeprefix('--plan='), {str(self.folder / 'plan')!r})\n"
                                             "    print(json.dumps(words[1:]))\n")
        line = [PROGRAM, "study", "sweep", *words, f"--runs={self.runs}", "--format=csv"]
        given = subprocess.run(line, capture_output=True, check=True, env={**os.environ, "PYTHONPATH": str(self.folder / "modules")}).stdout
        printed, said = io.StringIO(), io.StringIO()
        with contextlib.redirect_stdout(printed), contextlib.redirect_stderr(said), mock.patch.object(kept, "DATABASE_BYTES_MIN", 0):
            self.assertEqual(command.main([f"--plan={self.folder}/plan", *json.loads(given)]), 0, said.getvalue())
        return printed.getvalue(), said.getvalue()

    def test_large_databases_are_kept_one_for_all_runs_that_need_it_and_odd_or_old_ones_are_built_again(self):
        scene, victim = self.folder / "a.nff", self.folder / "victim"
        scene.write_text(NFF)
        line = [str(scene), "--runner=virtual", "--columns=faults,run_hash", "--vary=page-size:1KiB,4KiB"]
        text = table(*line[1:], "--vary=nodes:1,2", "--depth=2", start=line[:1])
        self.assertEqual(self.kept_with_databases(*line, "--vary=nodes:1,2", "--depth=2"), (text, ""))
        first = sorted(self.runs.glob("*.pages"))
        self.assertEqual(len(first), 2)
        os.replace(first[0], victim)
        first[0].symlink_to(victim)
        first[1].write_text("no database")
        content = victim.read_bytes()
        self.assertEqual(self.kept_with_databases(*line, "--vary=nodes:3")[1].count("built again"), 2)
        self.assertEqual((sorted(self.runs.glob("*.pages")), victim.read_bytes()), (first, content))
        self.assertFalse(first[0].is_symlink() or first[1].read_bytes() == b"no database")
        with mock.patch.object(kept.Kept, "_replacing", side_effect=AssertionError("built")):
            self.assertEqual(self.kept_with_databases(*line, "--vary=nodes:1,2", "--depth=2")[0], text)
        scene.write_text(NFF + "s 1 0 0 1\n")
        self.assertEqual(self.kept_with_databases(*line, "--vary=nodes:1,2")[1].count("built again"), 2)
        self.assertEqual({path.name[:20] for path in self.runs.glob("*.pages")}, {path.name[:20] for path in first})
        self.assertFalse(any(path in first for path in self.runs.glob("*.pages")))
        self.assertFalse([name for name in os.listdir(self.runs) if name.startswith(".")])


class PlotTest(FolderTest):
    def plots(self, *variations, numbers=("packets.bytes",)):
        return list(columns.plots("balls-1", [Variation(text) for text in variations], numbers))

    def test_a_plot_has_numbers_along_x_and_a_curve_for_each_combination_of_the_rest(self):
        [plot] = self.plots("strategy:svm,forest", "nodes:2,16", "depth:1,2")
        self.assertEqual((plot.name, plot.x, plot.log_x, len(plot.series)), ("packets-bytes", "nodes", 2, 4))
        self.assertEqual((plot.series[1].label, plot.series[1].where), ("strategy svm, depth 2", {"strategy": "svm", "depth": 2}))

    def test_where_nothing_varies_by_numbers_there_are_bars_and_more_curves_than_can_be_told_apart_are_not_drawn(self):
        self.assertEqual([(plot.x, plot.places) for plot in self.plots("strategy:svm,forest")], [("", ("strategy",))])
        self.assertEqual(self.plots("nodes:1,2", "depth:" + ",".join(map(str, range(1, 18)))), [])

    @unittest.skipIf(importlib.util.find_spec("matplotlib") is None, "no matplotlib")
    def test_plots_of_all_numbers_are_in_a_folder_with_their_data_and_on_a_page_with_the_table(self):
        page = self.folder / "page.html"
        text = table("--vary=page-size:1KiB,4KiB", "--vary=strategy:svm,dataflow", "--columns=faults,virtual_seconds,film_hash",
                     "--nodes=2", f"--plots={self.folder}/plots", f"--report={page}")
        names = ["pages-faults.svg", "sweep.csv", "virtual_seconds-total.svg"]
        self.assertEqual((sorted(os.listdir(self.folder / "plots")), (self.folder / "plots/sweep.csv").read_text()), (names, text))
        self.assertEqual((page.read_text().count("<svg"), page.read_text().count("<tr>")), (2, 5))
        self.assertIn("<h1>Study sweep of balls-1: --resolution=8x8 --nodes=2 --runner=virtual</h1>", page.read_text())
        (self.folder / "plots/sweep.csv").unlink()
        (self.folder / "plots/sweep.csv").mkdir()
        status, again, said = swept("--vary=nodes:1", "--columns=faults", f"--plots={self.folder}/plots")
        self.assertEqual((status, again, "sweep.csv: Is a directory" in said), (1, "nodes,pages.faults\n1,0\n", True), said)


class FiguresTest(unittest.TestCase):
    def setUp(self):
        driver = pathlib.Path(PROGRAM).with_name("manual") / "stats.schema.json"
        self.known = figures.known(driver.read_text())

    def test_a_word_means_the_figure_that_ends_in_it_of_all_nodes_before_the_hosts_and_options(self):
        for typed, name in (("faults", "pages.faults"), ("virtual_seconds", "virtual_seconds.total"), ("film_hash", "film_hash"),
                            ("sending", "virtual_seconds.sending"), ("node_memory", "options.node_memory")):
            self.assertEqual(figures.figure_meant(typed, self.known), name)
        self.assertEqual([self.known[name] for name in ("pages.faults", "film_hash", "virtual_seconds.total")], [True, False, True])

    def test_figures_that_are_known_are_those_that_renders_have(self):
        for strategy in ("svm", "dataflow", "forest", "replicated"):
            for runner in ("virtual", "threads"):
                stats = program.counters(["render", *TINY[:2], "--nodes=2", f"--strategy={strategy}", f"--runner={runner}"])
                for name in self.known:
                    figures.value(stats, name)

    def test_units_are_told_by_names(self):
        for name, unit in (("seconds.render", "s"), ("time_percent.data_wait", "%"), ("packets.bytes", "bytes"),
                           ("options.page_size", "bytes"), ("memory.total", "bytes"), ("pages.faults", ""), ("a_ps", "ps")):
            self.assertEqual(figures.unit(name), unit)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
