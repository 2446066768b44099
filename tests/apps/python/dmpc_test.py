"""The module dmpc, run by Debian's Python: `dmpc_test.py PROGRAM MODULE_FOLDER`. Ends with 77 where its packages are missing."""

import os
import pathlib
import signal
import struct
import subprocess
import sys
import tempfile
import time
import unittest

PROGRAM, MODULES = sys.argv[1:3]
os.environ["DMPC"] = PROGRAM
os.environ["PYTHONPATH"] = MODULES
os.environ["PYDEVD_DISABLE_FILE_VALIDATION"] = "1"  # of which the debugger of notebooks warns
sys.path.insert(0, MODULES)
try:
    import nbclient
    import nbformat
    import numpy

    import dmpc
    from dmpc import pictures, program, rendering
except ModuleNotFoundError as error:
    print(f"skipped: {error}; tests/run installs what is missing")
    sys.exit(77)

SMALL = {"resolution": "16x12", "nodes": 3}


class RenderTest(unittest.TestCase):
    def test_a_render_has_counters_nodes_film_and_heat_maps_that_agree(self):
        render = dmpc.render("balls-1", **SMALL, cache_pages=4, heat=["faults", "rays"])
        self.assertEqual(render.stats["format"], 1)
        self.assertEqual(render.film.shape, (12, 16, 3))
        self.assertGreater(render.film.max(), 0)
        self.assertEqual(render.heat["rays"].shape, (12, 16))
        self.assertEqual(render.heat["rays"].sum(), render.stats["rays"]["total"])
        self.assertEqual(render.heat["faults"].sum(), render.stats["pages"]["faults"])
        self.assertEqual(list(render.nodes.index), [0, 1, 2])
        self.assertEqual(render.nodes["pages.faults"].sum(), render.stats["pages"]["faults"])

    def test_the_film_is_the_same_for_every_strategy(self):
        films = [dmpc.render("balls-1", **SMALL, strategy=strategy).film for strategy in ("svm", "dataflow", "forest")]
        self.assertTrue(numpy.array_equal(films[0], films[1]))
        self.assertTrue(numpy.array_equal(films[0], films[2]))

    def test_options_are_words_with_dashes_and_what_is_none_or_false_is_left_out(self):
        self.assertEqual(program.words({"node_memory": "4MiB", "count_pages": True, "quiet": False, "chaos": None, "nodes": 8}),
                         ["--node-memory=4MiB", "--count-pages", "--nodes=8"])
        self.assertEqual(program.words({"light": ["1,2,3", "4,5,6"]}), ["--light=1,2,3", "--light=4,5,6"])

    def test_a_notebook_shows_the_picture_and_what_it_came_to_with_texts_escaped(self):
        render = dmpc.render("balls-1", **SMALL, runner="virtual")
        png = render._repr_png_()
        self.assertEqual(png[:8], b"\x89PNG\r\n\x1a\n")
        self.assertEqual(struct.unpack(">II", png[16:24]), (16, 12))
        self.assertIn("virtual time (s)", render._repr_html_())
        render.stats["options"]["scene"] = "<b>&"
        self.assertIn("&lt;b&gt;&amp;", render._repr_html_())
        self.assertNotIn("<b>", render._repr_html_())
        self.assertIn("page faults", repr(render))

    def test_one_heat_map_needs_no_list(self):
        self.assertEqual(list(dmpc.render("balls-1", **SMALL, heat="rays").heat), ["rays"])

    def test_a_picture_on_a_screen_is_curved_and_what_is_too_bright_is_white(self):
        self.assertEqual(list(pictures.srgb(numpy.array([-1, 0, 0.5, 1, 2, numpy.nan]))), [0, 0, 188, 255, 255, 0])


class FailureTest(unittest.TestCase):
    def test_what_goes_wrong_is_an_exception_with_the_words_of_dmpc(self):
        with self.assertRaisesRegex(dmpc.UsageError, "Did you mean --nodes?"):
            dmpc.render("balls-1", nodez=3)
        with self.assertRaisesRegex(dmpc.InputError, "^none.nff: "):
            dmpc.render("none.nff", nodes=3)
        with self.assertRaisesRegex(dmpc.RoomError, "node-memory"):
            dmpc.render("balls-1", **SMALL, node_memory="1KiB")
        with self.assertRaisesRegex(dmpc.UsageError, "Did you mean faults"):
            dmpc.sweep("balls-1", nodes=[1, 2], columns=["fautls"])
        self.assertTrue(issubclass(dmpc.RoomError, dmpc.Error))

    def test_what_would_render_nothing_is_refused(self):
        for call in (dmpc.render, dmpc.sweep):
            with self.assertRaisesRegex(dmpc.UsageError, "--version: expected a scene"):
                call("--version")
            with self.assertRaisesRegex(dmpc.UsageError, "help: no option"):
                call("balls-1", help=True)

    def test_a_program_that_is_not_there_is_told_with_what_to_do(self):
        os.environ["DMPC"] = "/none/dmpc"
        try:
            with self.assertRaisesRegex(FileNotFoundError, "DMPC=/none/dmpc"):
                dmpc.render("balls-1")
        finally:
            os.environ["DMPC"] = PROGRAM

    def test_counters_of_another_format_are_refused(self):
        with self.assertRaisesRegex(dmpc.Error, "format 2, expected 1"):
            program.check_format({"format": 2}, "--stats")

    def test_a_picture_that_cannot_be_read_is_an_error_with_its_name(self):
        with self.assertRaisesRegex(dmpc.Error, "none.exr"):
            pictures.read("none.exr")


class InterruptedTest(unittest.TestCase):
    CALLS = {"render": "dmpc.render('balls-4', resolution='4096x4096', nodes=2)",
             "sweep": "dmpc.sweep('balls-4', resolution='4096x4096', runner='virtual', nodes=[2, 4])"}

    def test_an_interrupted_call_ends_dmpc_with_its_children_and_files_and_is_raised(self):
        for call in self.CALLS.values():
            with tempfile.TemporaryDirectory() as folder:
                python = self._start(call, folder)
                python.send_signal(signal.SIGINT)
                output, _ = python.communicate(timeout=60)
                self.assertEqual(output, b"interrupted\n")
                self._expect_nothing_left(folder)

    def test_a_python_that_is_killed_leaves_no_dmpc(self):
        for call in self.CALLS.values():
            with tempfile.TemporaryDirectory() as folder:
                python = self._start(call, folder)
                python.kill()
                python.communicate()
                self._wait_until(lambda folder=folder: not self._running(folder))

    def _start(self, call, folder):
        code = f"import dmpc\ntry:\n  {call}\nexcept KeyboardInterrupt:\n  print('interrupted')"
        python = subprocess.Popen([sys.executable, "-c", code], env={**os.environ, "TMPDIR": folder}, stdout=subprocess.PIPE,
                                  preexec_fn=lambda: signal.signal(signal.SIGINT, signal.default_int_handler))
        self._wait_until(lambda: self._running(folder))
        return python

    def _running(self, folder):
        """Renders that write there, which have set their signals up."""
        running = []
        for process in pathlib.Path("/proc").glob("[0-9]*"):
            try:
                words = (process / "cmdline").read_bytes()
                blocked = int((process / "status").read_text().split("SigBlk:")[1].split()[0], 16)
            except (OSError, IndexError):
                continue
            if b"--output=" + folder.encode() in words and blocked & 1 << signal.SIGINT - 1:
                running.append(process)
        return running

    def _wait_until(self, holds):
        for _ in range(6000):
            if holds():
                return
            time.sleep(0.01)
        self.fail("waited in vain")

    def _expect_nothing_left(self, folder):
        self._wait_until(lambda: not self._running(folder) and not os.listdir(folder))


class SweepTest(unittest.TestCase):
    def test_lists_vary_and_each_combination_is_a_row(self):
        frame = dmpc.sweep("balls-1", resolution="8x8", runner="virtual", nodes=[1, 3], page_size=["1KiB", "4KiB"],
                           columns=["faults", "virtual_seconds"])
        self.assertEqual(list(frame.columns), ["nodes", "page-size", "pages.faults", "virtual_seconds.total"])
        self.assertEqual(list(frame["nodes"]), [1, 1, 3, 3])
        self.assertEqual(list(frame["page-size"]), [1024, 4096, 1024, 4096])
        self.assertEqual(list(frame["pages.faults"][:2]), [0, 0])
        self.assertEqual(frame.attrs["units"]["page-size"], "bytes")

    def test_an_array_varies_and_one_column_needs_no_list(self):
        frame = dmpc.sweep("balls-1", resolution="8x8", runner="virtual", nodes=numpy.array([1, 2]), columns="pages.faults")
        self.assertEqual(list(frame["nodes"]), [1, 2])
        self.assertEqual(list(frame.columns), ["nodes", "pages.faults"])

    def test_truths_vary_a_flag_and_runs_are_kept(self):
        with tempfile.TemporaryDirectory() as folder:
            asked = {"resolution": "8x8", "runner": "virtual", "nodes": 2, "count_pages": [False, True],
                     "columns": ["pages.distinct"], "runs": folder}
            frame = dmpc.sweep("balls-1", **asked)
            self.assertTrue(numpy.isnan(frame["pages.distinct"][0]))
            self.assertGreater(frame["pages.distinct"][1], 0)
            self.assertIn("2 of 2 runs kept from before.", dmpc.sweep("balls-1", **asked).attrs["notes"])


class NotebookTest(unittest.TestCase):
    def test_the_tour_runs_from_its_first_cell_to_its_last_and_shows_a_picture_and_a_table(self):
        notebook = nbformat.read(pathlib.Path(MODULES, "tour.ipynb"), as_version=4)
        nbclient.NotebookClient(notebook, timeout=300, kernel_name="python3").execute()
        shown = {kind for cell in notebook.cells for output in cell.get("outputs", []) for kind in output.get("data", {})}
        self.assertIn("image/png", shown)
        self.assertIn("text/html", shown)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[3:])
