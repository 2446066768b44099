"""The module dmpc, run by Debian's Python: `dmpc_test.py PROGRAM MODULE_FOLDER`. Ends with 77 where its packages are missing."""

import inspect
import json
import os
import pathlib
import re
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
    import matplotlib  # of the tour
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
        self.assertEqual(render.stats["format"], 2)
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
        self.assertEqual(program.words({"cache_pages": [1, 4], "trace_window": (0, "2.5"), "nodes": []}),
                         ["--cache-pages=1,4", "--trace-window=0,2.5"])

    def test_scalars_of_numpy_are_what_they_hold(self):
        options = {"scene": numpy.str_("balls-1"), "count_pages": numpy.True_, "resume": numpy.False_, "nodes": numpy.int64(8),
                   "cutoff": numpy.array(0.5)}
        scene, given = program.scene_of(options)
        self.assertEqual(scene, "balls-1")
        self.assertEqual(program.words(given), ["--count-pages", "--nodes=8", "--cutoff=0.5"])
        self.assertEqual(program.words({"cache_pages": numpy.array([1, 4])}), ["--cache-pages=1,4"])

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
        with self.assertRaisesRegex(dmpc.UsageError, "Did you mean svm?"):
            dmpc.render("balls-1", strategy="svn")
        with self.assertRaisesRegex(dmpc.InputError, "^none.nff: "):
            dmpc.render("none.nff", nodes=3)
        with self.assertRaisesRegex(dmpc.CapacityError, "node-memory"):
            dmpc.render("balls-1", **SMALL, node_memory="1KiB")
        with self.assertRaisesRegex(dmpc.UsageError, "Did you mean faults"):
            dmpc.sweep("balls-1", nodes=[1, 2], columns=["fautls"])
        self.assertTrue(issubclass(dmpc.CapacityError, dmpc.Error))

    def test_what_would_render_nothing_is_refused(self):
        for call in (dmpc.render, dmpc.sweep, dmpc.references, dmpc.trace, dmpc.study.cache, dmpc.study.traffic):
            with self.assertRaisesRegex(dmpc.UsageError, "--version: expected a scene"):
                call("--version")
            with self.assertRaisesRegex(TypeError, "unexpected keyword argument 'help'"):
                call("balls-1", help=True)

        with self.assertRaisesRegex(dmpc.UsageError, "no scene: expected a scene's name"):
            dmpc.render(None)
        with self.assertRaisesRegex(TypeError, "unexpected keyword argument 'frames'"):
            dmpc.render("balls-1", frames=3)

    def test_an_option_that_there_is_not_is_an_error_of_the_call(self):
        with self.assertRaisesRegex(TypeError, "unexpected keyword argument 'nodez'"):
            dmpc.render("balls-1", nodez=3)

    def test_a_program_that_is_not_there_is_told_with_what_to_do(self):
        os.environ["DMPC"] = "/none/dmpc"
        try:
            with self.assertRaisesRegex(FileNotFoundError, "DMPC=/none/dmpc"):
                dmpc.render("balls-1")
        finally:
            os.environ["DMPC"] = PROGRAM

    def test_counters_of_another_format_are_refused(self):
        with self.assertRaisesRegex(dmpc.Error, "format 3, expected 2"):
            program.check_format({"format": 3}, "--stats")

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
        sides = dmpc.sweep("balls-1", resolution="8x8", runner="virtual", background=["0,0,0", "1,1,1"], columns="rays.total")
        self.assertEqual(list(sides["background"]), ["0,0,0", "1,1,1"])
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


class StudyTest(unittest.TestCase):
    def test_a_study_is_a_frame_with_units_and_notes(self):
        frame = dmpc.study.cache("balls-2", nodes=3, resolution="16x12", cache_pages=[1, 4])
        self.assertEqual(list(frame["cache_pages"]), [1, 4])
        self.assertGreaterEqual(frame["faults_lru"][0], frame["faults_optimum"][0])
        self.assertEqual(frame.attrs["units"]["misses_lru"], "%")
        self.assertTrue(any("Film of every run" in note for note in frame.attrs["notes"]))

    def test_a_study_of_references_takes_the_file_that_others_wrote(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder, "-trace.csv")
            path.write_text("page\n1\n2\n3\n4\n1\n2\n5\n1\n2\n3\n4\n5\n")
            frame = dmpc.study.references(path, cache_pages=[3, 4])
            self.assertEqual(list(frame["faults_fifo"]), [9, 10])
            os.chdir(folder)  # a name that begins with a dash is no option
            self.assertEqual(list(dmpc.study.references("-trace.csv", cache_pages=3)["faults_fifo"]), [9])
            os.chdir("/")

    def test_a_study_of_ones_own_finds_of_a_sweep_what_the_study_in_dmpc_finds(self):
        space, options = {"__name__": "speedup"}, {"resolution": "32x32", "machine": "hdr"}
        exec(pathlib.Path(MODULES, "examples/speedup.py").read_text(), space)
        with tempfile.TemporaryDirectory() as folder:
            own = [space["speedup"]("rings-2-t1", nodes=(2, 1, 5), runs=folder, **options) for _ in range(2)]  # again, as it was kept
            self.assertEqual(len(os.listdir(folder)), 3)
        self.assertTrue(own[0].equals(own[1]))
        theirs = dmpc.study.speedup("rings-2-t1", nodes=(2, 1, 5), **options)
        self.assertEqual(list(own[0]["run_hash"]), list(theirs["run_hash"]))
        self.assertEqual(list(own[0]["options.node_memory"]), list(theirs["node_memory"]))
        for name in (name for name in own[0] if name not in ("run_hash", "options.node_memory")):
            column = {"virtual_seconds.total": "virtual_time", "links.wait": "link_wait"}.get(name, name.removeprefix("time_percent."))
            self.assertTrue(numpy.allclose(own[0][name], theirs[column], rtol=1e-12, atol=0), name)

    def test_cost_grows_as_the_slope_of_logarithms_has_it(self):
        space = {"__name__": "scale"}
        exec(pathlib.Path(MODULES, "examples/scale.py").read_text(), space)
        self.assertAlmostEqual(space["growth"]([1, 2, 4], [3, 12, 48]), 2)
        self.assertAlmostEqual(space["growth"]([1, 2, 4, 8], [5, 0, 5, 5]), 0)
        self.assertIsNone(space["growth"]([2, 2], [3, 4]))
        table = space["scale"](["tetra-2", "tetra-4", "tetra-6"], resolution="16x16")
        self.assertEqual(list(table["database.primitives"]), [16, 256, 4096])
        self.assertLess(abs(table.attrs["growth"]["database.bytes"] - 1), 0.2)

    def test_pages_and_rays_at_equal_memory_are_what_their_chosen_options_render(self):
        space = {"__name__": "equal_memory"}
        exec(pathlib.Path(MODULES, "examples/equal_memory.py").read_text(), space)
        cell = space["cell"]("hdr", "tetra-2", "whitted")
        again = space["run"]("tetra-2", machine="hdr", transport="whitted", samples=4, system="svm-extents", page_size=cell["page size"],
                             in_flight=cell["in flight"], node_memory=f"{cell['memory (KiB)']}KiB")
        self.assertEqual(again[0], cell["pages (s)"])
        self.assertLessEqual(again[1], cell["memory (KiB)"] * 1024)
        self.assertEqual(cell["rays over pages"], cell["rays (s)"] / cell["pages (s)"])

    def test_what_a_study_complains_of_is_raised(self):
        with self.assertRaisesRegex(dmpc.InputError, "--policy=/none.so: "):
            dmpc.study.cache("balls-1", policy="/none.so")
        with self.assertRaisesRegex(dmpc.UsageError, "--nodes"):
            dmpc.study.cache("balls-1", nodes=0)


class ImportTest(unittest.TestCase):
    def test_packages_that_are_missing_are_named(self):
        ended = subprocess.run([sys.executable, "-c", "import importlib.util as u; find = u.find_spec; import sys; hidden = sys.argv[2:]\n"
                                "u.find_spec = lambda name, *more: None if name in hidden else find(name, *more)\n"
                                "sys.path.insert(0, sys.argv[1])\nimport dmpc\ndmpc.render", MODULES, "pandas", "OpenImageIO"], capture_output=True, text=True)
        self.assertIn("ModuleNotFoundError: dmpc.render needs pandas and OpenImageIO, which this Python does not have: on Debian, apt install "
                      "python3-pandas python3-openimageio, for /usr/bin/python3", ended.stderr)


class PolicyTest(unittest.TestCase):
    CLOCK = pathlib.Path(MODULES, "examples/clock.py")

    def test_a_policy_misses_in_python_what_it_misses_in_a_study_and_what_dmpcs_own_does(self):
        references = dmpc.references("rings-2-t1", nodes=3, resolution="32x32", runner="virtual", work_item=0)
        space = {}
        exec(self.CLOCK.read_text(), space)
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder, "references.csv")
            references.to_csv(path, index=False)
            frame = dmpc.study.references(path, cache_pages=[2, 5, 9], policy=f"python:{self.CLOCK.resolve()}:Clock")
        self.assertEqual(list(frame["faults_Clock"]), list(frame["faults_clock"]))
        for size, faults in zip(frame["cache_pages"], frame["faults_clock"]):
            self.assertEqual(faults, sum(dmpc.simulate(space["Clock"], of_node["page"].to_list(), size, node)
                                         for node, of_node in references.groupby("node")))

    def test_of_a_frame_each_node_has_a_cache_of_its_own(self):
        space = {}
        exec(self.CLOCK.read_text(), space)
        frame = dmpc.references("rings-2-t1", nodes=3, resolution="32x32", runner="virtual", work_item=0)
        misses = dmpc.simulate(space["Clock"], frame, 4)
        self.assertEqual(list(misses.index), [0, 1, 2])
        self.assertEqual(misses.index.name, "node")
        for node, of_node in frame.groupby("node"):
            self.assertEqual(misses[node], dmpc.simulate(space["Clock"], of_node["page"], 4, node))
        again, costs = dmpc.simulate(space["Clock"], frame, 4, prices=frame["bytes"])
        self.assertTrue(again.equals(misses))
        self.assertEqual(costs.sum(), 1024 * misses.sum())
        alone = dmpc.simulate(space["Clock"], frame[["page"]], 4, node=7)
        self.assertEqual(list(alone.index), [7])
        self.assertEqual(alone[7], dmpc.simulate(space["Clock"], frame["page"], 4))
        self.assertEqual(list(dmpc.simulate(space["Clock"], frame[:0], 4)), [])
        with self.assertRaisesRegex(ValueError, "the frame's columns are node, bytes: expected page, and perhaps node"):
            dmpc.simulate(space["Clock"], frame[["node", "bytes"]], 4)

    def test_what_is_no_page_number_is_refused_with_its_place(self):
        space = {}
        exec(self.CLOCK.read_text(), space)
        for wrong in ("7", None, -1, 2**32 - 1, 1.5, float("nan"), float("inf"), True, [1], b"1", numpy.float32(0.5), numpy.bool_(True)):
            with self.assertRaisesRegex(ValueError, "reference 2 is .*, expected a page: a whole number from 0 to 4,294,967,294"):
                dmpc.simulate(space["Clock"], [1, 2, wrong, 3], 2)
        self.assertEqual(dmpc.simulate(space["Clock"], [1, 2.0, numpy.uint64(2**32 - 2), numpy.float64(1), 1], 4), 3)
        with self.assertRaisesRegex(ValueError, "1 prices for 2 references"):
            dmpc.simulate(space["Clock"], [1, 2], 2, prices=[1])

    def test_a_policy_of_ones_own_decides_in_a_render_and_in_a_sweep(self):
        clock = f"python:{self.CLOCK.resolve()}:Clock"
        with tempfile.TemporaryDirectory() as folder:
            table = dmpc.sweep("rings-2-t1", replacement=["clock", clock], runner="virtual", nodes=4, cache_pages=6, resolution="32x32",
                               columns=["pages.faults", "virtual_seconds.total"], runs=folder)
        self.assertEqual(table["pages.faults"][0], table["pages.faults"][1])
        self.assertEqual(table["virtual_seconds.total"][0], table["virtual_seconds.total"][1])
        render = dmpc.render("rings-2-t1", replacement=clock, runner="virtual", nodes=4, cache_pages=6, resolution="32x32")
        self.assertEqual(render.stats["pages"]["faults"], table["pages.faults"][1])
        self.assertEqual(render.stats["options"]["replacement"], "Clock")

    def test_s4_fifo_promotes_what_comes_back_and_if_it_is_wary_what_comes_back_twice(self):
        space = {}
        exec(pathlib.Path(MODULES, "examples/s4_fifo.py").read_text(), space)
        references = [1, 2, 3, 1, 3, 4, 5, 1, 6, 1]  # two frames, one of them the small queue's; a name is remembered
        self.assertEqual(dmpc.simulate(space["S4Fifo"], references, 2), 7)  # page 1 is in the main queue as it comes again
        self.assertEqual(dmpc.simulate(space["Wary"], references, 2), 8)  # as it comes for the third time

    def test_numbers_of_numpy_are_frames_and_what_is_none_is_refused(self):
        class Says:
            frame = 0

            def __init__(self, frame_count, node):
                pass

            def victim(self, incoming):
                return self.frame

        Says.frame = numpy.uint32(1)
        self.assertEqual(dmpc.simulate(Says, numpy.array([1, 2, 3, 1, 2]), 2), 4)
        for wrong in (2, -1, 0.0, True, None, "0"):
            Says.frame = wrong
            with self.assertRaisesRegex(dmpc.PolicyError, "expected a frame from 0 to 1"):
                dmpc.simulate(Says, [1, 2, 3], 2)
        with self.assertRaisesRegex(dmpc.PolicyError, "no method victim"):
            dmpc.simulate(type("None_such", (), {"__init__": lambda *_: None}), [1], 2)
        self.assertEqual(dmpc.simulate(Says, [1, 2, 1], 0), 3)
        self.assertEqual(dmpc.simulate(Says, [1, 1, 2, 2, 1, 1], 2), 2)  # of one page in a row the first may miss


    def test_a_policy_may_let_a_page_pass_and_hears_what_misses_cost(self):
        class Keeps:
            """What has come first stays."""
            heard = []

            def __init__(self, frame_count, node):
                pass

            def price(self, page, price):
                self.heard.append((page, price))

            def victim(self, incoming):
                return "bypass"

        self.assertEqual(dmpc.simulate(Keeps, [1, 2, 2, 1, 2], 1), 3)
        self.assertEqual(Keeps.heard, [(1, 1), (2, 1), (2, 1)])
        self.assertEqual(dmpc.simulate(Keeps, [1, 2, 2, 1, 2], 1, prices=[5, 2, 9, 5, 3]), (3, 10))
        self.assertEqual(dmpc.simulate(Keeps, [1, 2], 0, prices=[5, 2]), (2, 7))


class LookingTest(unittest.TestCase):
    def test_references_are_those_that_the_run_counted(self):
        frame = dmpc.references("rings-2-t1", nodes=3, resolution="16x12", runner="virtual", work_item=0)
        self.assertTrue({"node", "page"} <= set(frame.columns))
        self.assertEqual(set(frame["node"]), {0, 1, 2})

    def test_a_trace_is_a_frame_of_events_by_node(self):
        frame = dmpc.trace("balls-1", **SMALL, runner="virtual")
        self.assertTrue({"node 0", "node 1", "node 2", "host"} <= set(frame["track"]))
        spans = frame[frame["ph"] == "X"]
        self.assertTrue((spans["dur"] >= 0).all())
        self.assertTrue({"trace", "shade"} <= set(spans["name"]))
        messages = frame.groupby("ph")["id"].apply(set)
        self.assertEqual(messages["s"], messages["f"])
        self.assertTrue(frame[frame["ph"] == "W"]["name"].str.startswith("page ").all())
        self.assertEqual(frame[frame["ph"] == "C"]["args.value"].min(), 0)
        self.assertEqual(frame.attrs["about"]["scene"], "balls-1")

    def test_counters_of_a_run_repeated_on_a_modelled_machine_do_not_differ(self):
        with tempfile.TemporaryDirectory() as folder:
            for name in ("a", "b"):
                stats = dmpc.render("balls-1", **SMALL, runner="virtual").stats
                pathlib.Path(folder, name + ".json").write_text(json.dumps(stats))
            a, b = f"{folder}/a.json", f"{folder}/b.json"
            self.assertFalse(dmpc.compare(a, b)["differs"])
            stats["pages"]["faults"] += 1
            pathlib.Path(b).write_text(json.dumps(stats))
            found = dmpc.compare(a, b, only="pages.faults")
            self.assertTrue(found["differs"])
            self.assertEqual(found["compared"], 1)
            with self.assertRaisesRegex(dmpc.InputError, "none.json"):
                dmpc.compare(a, "none.json")


class PageTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.path = pathlib.Path(folder.name, "page.html")
        self.render = dmpc.render("balls-1", **SMALL, runner="virtual", heat="faults", report=self.path)

    def test_a_page_has_the_shares_of_each_nodes_time_and_what_pixels_took(self):
        page = dmpc.page(self.path)
        self.assertEqual(page.share["tracing"].shape[0], 3)
        total = sum(page.share.values())
        self.assertLess(abs(total[:, 1:-1] - 1).max(), 0.05)  # a step is a whole, to the roundings of its parts
        self.assertEqual(page.done.shape, (12, 16))
        self.assertEqual(page.fields["faults"].sum(), self.render.heat["faults"].sum())
        self.assertAlmostEqual(page.seconds, self.render.stats["virtual_seconds"]["total"])

    def test_what_is_no_page_is_refused(self):
        for text, said in {"": "no data of a run", "<script id='data'>7</script>": "no data of a run",
                           '<script id="data">{</script>': "Expecting property name"}.items():
            self.path.write_text(text)
            with self.assertRaisesRegex(dmpc.InputError, said):
                dmpc.page(self.path)
        with self.assertRaisesRegex(dmpc.InputError, "none.html"):
            dmpc.page("none.html")

    def test_a_page_that_was_changed_or_is_of_another_version_is_an_error_of_dmpcs(self):
        whole = self.path.read_text()
        for wrong, other in {'"format":3': '"format":4', '"type":"u1"': '"type":"x9"', '"steps":': '"stops":', '"high":': '"high":1',
                             '"data":"': '"data":"*'}.items():
            self.assertIn(wrong, whole)
            self.path.write_text(whole.replace(wrong, other))
            with self.assertRaises(dmpc.Error):
                dmpc.page(self.path)


class SignatureTest(unittest.TestCase):
    """What editors and notebooks offer, held against what the program says of itself."""

    CALLS = {dmpc.render: ["render"], dmpc.references: ["render"], dmpc.trace: ["render"], dmpc.compare: ["compare"],
             dmpc.sweep: ["study", "sweep"],
             **{getattr(dmpc.study, name): ["study", name] for name in dmpc.study.__all__ if name != "sweep"}}
    OWN = {"help", "output", "stats", "heatmap", "quiet", "references", "trace", "format", "vary"}
    FRAMES = {"frames", "turntable", "camera_path", "animation", "fps"}  # which are many pictures

    def _help(self, words):
        return subprocess.run([PROGRAM, *words, "--help=all"], capture_output=True, text=True, check=True).stdout

    def test_every_option_of_help_is_a_keyword_and_no_other(self):
        for call, words in self.CALLS.items():
            text = self._help(words).split("\nExamples:")[0]
            options = {name.replace("-", "_") for name in re.findall(r"^  (?:-\w,)?--([a-z][a-z-]*)", text, re.M)}
            keywords = {name for name, parameter in inspect.signature(call).parameters.items() if parameter.kind == parameter.KEYWORD_ONLY}
            with self.subTest(words=words):
                self.assertGreater(len(options), 3)
                many = self.FRAMES if words == ["render"] else set()
                self.assertEqual(options - self.OWN - many, keywords - self.OWN - {"heat"})

    def test_types_are_those_that_help_shows(self):
        parameters = inspect.signature(dmpc.render).parameters
        self.assertEqual(str(parameters["nodes"].annotation), "int | None")
        self.assertIn("typing.Literal['svm', 'replicated', 'dataflow', 'forest']", str(parameters["strategy"].annotation))
        self.assertIs(parameters["count_pages"].annotation, bool)
        self.assertIn("Sequence", str(parameters["light"].annotation))
        self.assertNotIn("Sequence", str(parameters["depth"].annotation))
        self.assertIn("Sequence[int]", str(inspect.signature(dmpc.sweep).parameters["nodes"].annotation))

    def test_every_study_is_a_function_with_words_on_what_it_does(self):
        studies = re.findall(r"^  ([a-z]+) {2,}", self._help(["study"]).split("Commands:")[1], re.M)
        self.assertEqual(set(studies), set(dmpc.study.__all__))
        for call in self.CALLS:
            self.assertTrue(call.__doc__.endswith("."))

    def test_the_package_says_that_it_has_types(self):
        self.assertTrue(pathlib.Path(MODULES, "dmpc/py.typed").exists())


class NotebookTest(unittest.TestCase):
    def test_the_tour_runs_from_its_first_cell_to_its_last_and_comes_to_what_it_has_stored(self):
        stored = nbformat.read(pathlib.Path(MODULES, "tour.ipynb"), as_version=4)
        notebook = nbformat.read(pathlib.Path(MODULES, "tour.ipynb"), as_version=4)
        nbclient.NotebookClient(notebook, timeout=300, kernel_name="python3").execute()
        self.assertEqual(self._shown(notebook), self._shown(stored))
        kinds = [kind for cell in notebook.cells for output in cell.get("outputs", []) for kind in output.get("data", {})]
        self.assertEqual(kinds.count("image/png"), 2)  # the picture, and the plot
        self.assertIn("text/html", kinds)

    def _shown(self, notebook):
        """The words of each cell's outputs; the places of objects in memory are no words."""
        return [[re.sub("0x[0-9a-f]+", "", output["data"]["text/plain"]) for output in cell.get("outputs", []) if "data" in output]
                for cell in notebook.cells]


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[3:])
