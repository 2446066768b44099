"""The benchmark `error`, by Debian's Python with nothing but its standard library: `errors_test.py PROGRAM MODULE_FOLDER`."""

import contextlib
import io
import json
import math
import os
import pathlib
import signal
import subprocess
import sys
import tempfile
import time
import unittest
from types import SimpleNamespace
from unittest import mock

PROGRAM, MODULES = sys.argv[1:3]
os.environ.update(DMPC=PROGRAM, PYTHONPATH=MODULES)
sys.path.insert(0, MODULES)
from dmpc import program  # noqa: E402
from dmpc.errors import curves, findings, measuring, pictures, table  # noqa: E402
from dmpc.errors.points import KNOBS, Point, Setting, Sweep, value_of  # noqa: E402
from dmpc.studies import plots  # noqa: E402

STEP = 1 / 255
PATHS = Setting(bounces=4)


def bench(*words):
    """Its status, its table, and what it says."""
    line = [PROGRAM, "bench", "error", *words, "--format=json"]
    done = subprocess.run(line, capture_output=True, text=True)
    return done.returncode, json.loads(done.stdout or "{}"), done.stderr


def tiny(*words):
    return bench("tetra-2", "--resolution=16x16", "--quick", "--repeat=2", *words)


def texts(points):
    return [point.text for point in points]


def measured(rays, error, setting=Setting()):
    """A picture whose error is the same in all groups of pixels."""
    return measuring.Measurement(setting, [float(rays)], rays, rays, squares=[error * error / pictures.GROUPS] * pictures.GROUPS,
                                 error=dict.fromkeys((key for *_, key in table._MEASURES), error))


def make_uneven(one):
    """The same error, but all of it in every other group: its square has a deviation of 1 / sqrt(63)."""
    one.squares = [square * (2 if group % 2 == 0 else 0) for group, square in enumerate(one.squares)]


def add(result, knob, text, one, **turned):
    setting = Setting(**turned)
    one.setting = setting
    result.points.append(Point(knob, text, setting))
    result.measurements[setting] = one
    return one


def result_of(share, own_error=0.0, base=Setting(), emitters=0):
    """Uniform sampling with errors of 32, 8 and 4 8-bit steps, which fall with time^-1/2, and adaptive sampling, which was asked for 16 and
    8 and takes `share` of that time."""
    reference = SimpleNamespace(own_error=own_error, own_relative=0.0, samples_a_side=8, rays=7, seconds=1.0, emitters=emitters,
                                width=2, height=2, pixels=4)
    result = measuring.Result("tetra-2", reference, base)
    for samples in (1, 16, 64):
        add(result, "samples", str(samples), measured(100 * samples, 32 * STEP / math.sqrt(samples)), samples=samples, depth=9)
    for samples, asked in ((1, "255/255"), (4, "16/255"), (20, "8/255"), (100, "300/255")):
        add(result, "adaptive", asked, measured(round(share * 100 * samples), 32 * STEP / math.sqrt(samples)), error=asked)
    return result


def of_knob(result, knob):
    return [result.of(point) for point in result.points if point.knob == knob]


class SweepTest(unittest.TestCase):
    def test_a_sweep_turns_one_knob_at_a_time_and_ends_at_the_base_point(self):
        self.assertEqual(texts(Sweep(Setting(samples=8)).points({"samples"})), ["1", "4", "8", "16", "32", "64", "256"])
        self.assertEqual(texts(Sweep(Setting(depth=3)).points({"depth"})), ["1", "2", "3"])
        self.assertEqual(texts(Sweep(Setting(depth=1)).points({"depth"})), ["1"])
        for knob in ("cutoff", "depth", "tessellation", "arithmetic"):
            points = Sweep(Setting(), (1, 2)).points({knob})
            self.assertEqual([point.setting == Setting() for point in points], [False] * (len(points) - 1) + [True])
        self.assertEqual(Sweep(Setting()).points({"tessellation"}), [])

    def test_by_paths_bounces_go_up_to_the_base_points_and_emitters_from_none_to_those_that_it_samples(self):
        self.assertEqual(texts(Sweep(PATHS).points({"bounces"})), ["0", "1", "2", "3", "4"])
        self.assertEqual(texts(Sweep(Setting(bounces=0)).points({"bounces"})), ["0"])
        points = Sweep(PATHS, emitters=20).points({"emitters"})
        self.assertEqual(texts(points), ["none", "1", "4", "16", "20"])
        self.assertEqual([point.setting.emitters for point in points], [0, 1, 4, 16, 1024])
        self.assertEqual(texts(Sweep(PATHS, emitters=20, is_quick=True).points({"emitters"})), ["none", "20"])
        self.assertEqual(texts(Sweep(PATHS, emitters=1).points({"emitters"})), ["none", "1"])
        self.assertEqual(Sweep(PATHS).points({"emitters"}), [])

    def test_a_quick_sweep_has_fewer_points_and_none_asks_for_a_smaller_error_than_can_be_seen(self):
        quick, whole = (Sweep(Setting(), (1, 2), is_quick=is_quick) for is_quick in (True, False))
        self.assertLess(len(quick.points(KNOBS[:7])), len(whole.points(KNOBS[:7])))
        self.assertEqual(texts(quick.points({"cutoff"})), ["1/255", "1/1024", "0"])
        self.assertEqual(texts(quick.points({"adaptive"}, 0.4 / 255)), ["8/255", "4/255", "2/255", "1/255", "1/510"])
        self.assertEqual(texts(whole.points({"adaptive"}, 4 / 255)), ["64/255", "32/255", "16/255", "8/255", "4/255"])
        self.assertEqual(whole.points({"adaptive"}, 1), [])


class CurvesTest(unittest.TestCase):
    def front(self, *points):
        return curves.pareto_front(points, [True] * len(points))

    def test_the_pareto_front_has_the_points_that_nothing_cheaper_equals_and_nothing_better_undercuts(self):
        self.assertEqual(self.front(), [])
        self.assertEqual(self.front((1, 8), (2, 4), (3, 5), (4, 2), (5, 2), (4, 3), (1, 9)),
                         [True, True, False, True, False, False, False])
        self.assertEqual(self.front((1, 2), (1, 2), (2, 3)), [True, True, False])
        self.assertEqual(curves.pareto_front([(1, 1), (2, 2)], [False, True]), [False, True])

    def test_between_two_points_the_cost_at_an_error_lies_on_a_line_in_logarithms_which_goes_on_for_a_tenth(self):
        slope_2 = [(400, 1), (1, 20), (100, 2)]
        self.assertAlmostEqual(curves.cost_at(slope_2, 4), 25)
        self.assertAlmostEqual(curves.cost_at(slope_2, math.sqrt(2)), 200)
        points = [(100, 2), (90, 2), (400, 1)]
        self.assertEqual([curves.cost_at(points, error) for error in (2, 1)], [90, 400])
        self.assertAlmostEqual(curves.cost_at([(100, 2), (400, 1)], 2 * 1.05), 100 / 1.05 ** 2)
        self.assertAlmostEqual(curves.cost_at([(100, 2), (400, 1)], 1 / 1.05), 400 * 1.05 ** 2)
        for some, error in ((points, 2.21), (points, 0.9), ([], 1), ([(7, 3)], 2.9), ([(0, 2), (400, 1), (9, 0)], 1.5)):
            self.assertIsNone(curves.cost_at(some, error))
        self.assertEqual(curves.cost_at([(7, 3)], 3), 7)

    def test_an_errors_interval_follows_from_how_much_groups_of_pixels_differ(self):
        one = measured(1, 3)
        self.assertEqual([round(end, 9) for end in curves.interval(one.squares)], [3, 3, 3])
        make_uneven(one)
        for end, sign in zip(curves.interval(one.squares), (-1, 0, 1)):
            self.assertAlmostEqual(end, 3 * math.exp(sign / math.sqrt(63)))
        self.assertAlmostEqual(curves.error_of(one.squares, 0), 3 * math.sqrt(62 / 63))


class PicturesTest(unittest.TestCase):
    def test_a_picture_is_read_to_the_bit_and_its_groups_add_up_to_the_mean_square_error(self):
        with tempfile.TemporaryDirectory() as folder:
            paths = [pathlib.Path(folder, f"{samples}.exr") for samples in (1, 64)]
            for path in paths:
                for size in ("1x1", "37x35"):  # packed blocks and others, the last of few rows
                    program.run(["render", "balls-1", f"--samples={path.stem}", f"--resolution={size}", f"--output={path}"])
            few, many = map(pictures.read_exr, paths)
            groups = pictures.groups_of(37 * 35)
            squares = pictures.square_errors(few, many, [0.0] * len(many), groups)
            self.assertAlmostEqual(math.sqrt(sum(squares)), pictures.difference(*paths)["root_mean_square"], places=12)
            nothing = ["--camera=9,9,9/20,20,20", "--background=0.25,0.5,1"]
            program.run(["render", "balls-1", *nothing, "--resolution=3x17", f"--output={path}"])
            self.assertEqual(list(pictures.read_exr(path)), [0.25, 0.5, 1] * 3 * 17)
        self.assertEqual((len(squares), set(groups)), (64, set(range(64))))
        self.assertEqual(groups[:18:3], [0, 37, 10, 48, 20, 28])  # by core's mix()

    def test_the_references_own_error_is_taken_off_in_squares_as_the_product_of_the_distances_from_its_halves(self):
        squares = pictures.square_errors([1.0] * 3 + [0.0] * 3, [0.75] * 3 + [0.0] * 3, [0.125] * 3 + [0.0] * 3, [0, 0, 0, 5, 5, 5])
        self.assertAlmostEqual(curves.error_of(squares), math.sqrt(0.125 * 0.375 / 2))
        self.assertEqual(curves.error_of(pictures.square_errors([0.75], [0.75], [0.125], [0])), 0)


class FindingsTest(unittest.TestCase):
    def test_adaptive_samplings_share_of_uniform_samplings_time_is_told_at_each_error_that_it_was_asked_for_and_both_reach(self):
        shares = findings.adaptive_shares(result_of(0.25))
        self.assertEqual([share.error for share in shares], ["16/255", "8/255"])
        for share in shares:
            for figure in (share.low, share.middle, share.high, share.rays):
                self.assertAlmostEqual(figure, 0.25)
        self.assertEqual(findings.findings_of(result_of(0.25))[0],
                         "tetra-2: adaptive takes 0.25 of uniform's time at 16/255 (0.25 to 0.25), 0.25 at 8/255 (0.25 to 0.25); in rays "
                         "0.25 at 16/255, 0.25 at 8/255.")

    def test_a_shares_interval_has_what_pixels_differ_in_but_for_what_both_pictures_have_in_common(self):
        result, factor = result_of(1.1), math.exp(2 / math.sqrt(63))
        for one in of_knob(result, "adaptive"):
            make_uneven(one)
        share = findings.adaptive_shares(result)[0]
        for figure, wanted in ((share.low, 1.1 / factor), (share.middle, 1.1), (share.high, 1.1 * factor)):
            self.assertAlmostEqual(figure, wanted, places=3)
        self.assertIn("tetra-2: between adaptive and uniform no difference that this run can tell at 16/255 (0.85 to 1.42), 8/255",
                      findings.findings_of(result)[0])
        for one in of_knob(result, "samples"):
            make_uneven(one)
        self.assertAlmostEqual(findings.adaptive_shares(result)[0].high, 1.1)

    def test_a_shares_interval_has_what_rounds_differ_in_and_its_middle_the_least_times(self):
        result = result_of(0.5)
        for knob, slower in (("adaptive", 1.5), ("samples", 1)):
            for one in of_knob(result, knob):
                one.seconds.append(one.seconds[0] * slower)
        share = findings.adaptive_shares(result)[0]
        self.assertAlmostEqual(share.middle, 0.5)
        self.assertAlmostEqual(share.high, 0.75)

    def test_without_an_error_that_both_reach_there_is_no_share_which_is_said_if_both_were_measured(self):
        result = result_of(0.25)
        result.points = result.points[:1]
        self.assertNotIn("adaptive", findings.findings_of(result)[0])
        add(result, "adaptive", "1/4", measured(4, 0.25), error="1/4")
        self.assertIn("no error asked of adaptive sampling is reached by both", findings.findings_of(result)[0])
        self.assertEqual(findings.shares_text([]), "")

    def test_the_cheapest_cutoff_has_a_deterministic_error_below_a_quarter_of_an_8_bit_step(self):
        result = result_of(0.5)
        for text, rays, error in (("1/64", 60, 1 / 1000), ("1/255", 80, 1 / 2000), ("0", 100, 0.0)):
            add(result, "cutoff", text, measured(rays, 0.1), cutoff=text).deterministic = {"root_mean_square": error}
        self.assertEqual(findings.cheapest_point(result, "cutoff").text, "1/255")
        self.assertIn("cutoff 1/255 (0.128/255, 0.800 times the rays)", findings.findings_of(result)[2])

    def test_what_light_found_by_chance_costs_is_said_in_time_for_the_same_error_as_a_bound_where_one_sample_errs_less(self):
        result = result_of(0.25, base=PATHS, emitters=3)
        one = add(result, "emitters", "none", measured(2000, 16 * STEP), bounces=4, emitters=0)  # as four samples, which take 400
        self.assertIn("BSDF sampling alone takes 5.00 times the time", findings.findings_of(result)[-1])
        one.squares = measured(2000, 96 * STEP).squares
        self.assertIn("BSDF sampling alone takes at least 20.00 times the time", findings.findings_of(result)[-1])

    def test_the_first_words_say_what_adaptive_sampling_takes_and_where_errors_end(self):
        words = findings.summary_of([result_of(0.25, 3.5 * STEP)])
        self.assertIn("tetra-2: adaptive takes 0.25", words)
        self.assertIn("errors end at its own one, 3.500/255 (relative MSE 0): of 1 setting below it", words)
        self.assertEqual(findings.summary_of([]), "")


class TableTest(unittest.TestCase):
    def test_a_table_has_the_rows_that_are_measured_and_no_error_below_the_references_own(self):
        result = result_of(0.25, 3.5 * STEP)
        add(result, "adaptive", "late", measuring.Measurement(Setting()), error="1/2")
        found = table.ErrorTable("errors", False)
        found.add_results(result)
        rows = found.named_rows()
        self.assertEqual((len(rows), round(rows[0]["error"], 9), rows[0]["remark"]), (7, 32, ""))
        self.assertEqual((rows[6]["error"], rows[6]["remark"]), (None, "less than the reference's own error"))
        self.assertEqual("".join("01"[row["front"] == "yes"] for row in rows), "0011110")  # but for what is not told

    def test_the_first_plot_has_uniform_and_adaptive_sampling_alone_and_their_front_the_second_one_all_knobs(self):
        result = result_of(0.25)
        self.assertEqual(len(table.plots_of(result, "error")), 1)
        add(result, "depth", "3", measured(10, STEP), depth=3)  # beats all
        found = table.ErrorTable("errors", False)
        found.add_results(result)
        self.assertEqual([tuple(row[name] for name in table._FRONTS) for row in found.named_rows()][6:], [("", "yes"), ("yes", "")])
        first, second = (plots.data(plot, found) for plot in table.plots_of(result, "error"))
        self.assertEqual(first["title"], "tetra-2: adaptive takes 0.25 of uniform's time at 8/255 (0.25 to 0.25)")
        self.assertEqual([(one["name"], one["mark"]) for one in first["series"]],
                         [("uniform sampling", "intervals"), ("adaptive sampling", "intervals"), ("on the front", "points")])
        self.assertEqual([len(row) for row in first["series"][0]["rows"]], [4] * 3)
        self.assertIn("depth", [one["name"] for one in second["series"]])


class CommandTest(unittest.TestCase):
    def test_there_is_a_row_for_each_point_with_the_figures_of_its_render_and_what_they_say(self):
        status, found, said = tiny()
        self.assertEqual((status, said), (0, ""))
        rows = {(row["knob"], row["setting"]): row for row in found["rows"]}
        self.assertEqual({knob for knob, _ in rows}, {"samples", "adaptive", "cutoff", "depth", "arithmetic", "quality"})
        for row, words in ((("samples", "4"), ["--samples=4", "--depth=8"]), (("depth", "2"), ["--samples=16", "--depth=2"]),
                           (("cutoff", "1/255"), ["--samples=16", "--depth=8", "--cutoff=1/255"]),
                           (("adaptive", "2/255"), ["--samples=auto", "--error=2/255", "--depth=8"]),
                           (("quality", "draft"), ["--quality=draft", "--depth=8"])):
            stats = program.counters(["render", "tetra-2", "--resolution=16x16", "--strategy=replicated", *words])
            figures = [stats["rays"]["total"], stats["sampling"]["samples"]]
            self.assertEqual([rows[row]["rays"], 256 * rows[row]["samples_a_pixel"]], figures)
        for row in found["rows"]:
            self.assertLessEqual(0, row["seconds_least"])
            self.assertLessEqual(row["seconds_least"], row["seconds_most"])
        base = rows["samples", "16"]
        for row in (("cutoff", "0"), ("depth", "8")):
            self.assertEqual(rows[row]["RMSE"], base["RMSE"])
            self.assertEqual(rows[row]["deterministic_RMSE"], 0)
        self.assertLess(rows["arithmetic", "float"]["deterministic_RMSE"], 255e-4)
        self.assertGreater(base["RMSE"], rows["arithmetic", "float"]["deterministic_RMSE"])
        self.assertIsNone(base["deterministic_RMSE"])
        notes = " ".join(found["notes"])
        for part in ("the reference has 12x12 samples a pixel", "cheapest with a deterministic RMSE", "good quality has an error of",
                     "Load of the machine"):
            self.assertIn(part, notes)

    def test_a_cutoff_saves_rays_and_a_quality_has_its_own(self):
        found = bench("balls-1", "--knobs=quality,cutoff", "--quick", "--repeat=1", "--resolution=24x24")[1]["rows"]
        rays = [row["rays"] for row in found]
        self.assertLess(rays[0], rays[2])
        for row, count in zip(found, rays):
            words = [f"--quality={row['setting']}"] if row["knob"] == "quality" else ["--samples=16", f"--cutoff={row['setting']}"]
            self.assertEqual(count, program.counters(["render", "balls-1", "--resolution=24x24", "--depth=8", *words])["rays"]["total"])

    def test_by_paths_samples_adaptive_samples_bounces_and_emitters_are_turned_and_no_other_knob(self):
        status, found, said = bench("balls-1", "--transport=paths", "--bounces=2", "--sky=1", "--light-radius=3", "--resolution=12x12",
                                    "--quick", "--reference-samples=16", "--repeat=1")
        self.assertEqual((status, {row["knob"] for row in found["rows"]}), (0, {"samples", "adaptive", "bounces", "emitters"}))
        self.assertIn("16 samples a pixel, paths, 2 bounces, sky 1,1,1, lights of radius 3, convention", found["title"])
        self.assertIn("the reference has 16x16 samples a pixel, 2 bounces", " ".join(found["notes"]))
        self.assertNotIn("deterministic", json.dumps(found["columns"]))
        self.assertEqual(said.count("1 light stays a point"), 1)
        notes = bench("balls-1", "--transport=paths", "--bounces=1", "--sky=1", "--quick", "--knobs=emitters", "--resolution=8x8",
                      "--reference-samples=4")[1]["notes"]
        self.assertIn("balls-1: there is no emitter for light sampling", " ".join(notes))

    def test_scenes_are_tessellated_with_every_strategy_and_meshes_with_textures_are_seen_and_lit_as_one_likes(self):
        for strategy in ("svm", "forest", "dataflow"):
            status, found, _ = bench("balls-1", "--knobs=tessellation", "--quick", "--repeat=1", "--resolution=8x8", "--nodes=2",
                                     f"--strategy={strategy}")
            self.assertEqual((status, [row["setting"] for row in found["rows"]]), (0, ["t1", "t2", "exact"]))
            errors = [row["deterministic_RMSE"] for row in found["rows"]]
            self.assertTrue(errors[0] > errors[1] > errors[2] == 0, errors)
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder)
            program.run(["render", "balls-1", "--resolution=64x64", f"--output={path}/paint.png"])
            (path / "a.mtl").write_text("newmtl m\nKd 1 1 1\nmap_Kd paint.png\n")
            (path / "a.obj").write_text("mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nusemtl m\n"
                                        "f 1/1 2/2 3/3 4/4\n")
            status, found, _ = bench(str(path / "a.obj"), "--knobs=samples,arithmetic", "--camera=0.5,0.4,1/0.5,0.5,0", "--light=3,4,5",
                                     "--quick", "--repeat=1", "--resolution=16x16")
        rows = {(row["knob"], row["setting"]): row for row in found["rows"]}
        self.assertLess(rows["arithmetic", "float"]["deterministic_RMSE"], 255e-4)
        self.assertLess(rows["arithmetic", "float"]["deterministic_RMSE"], rows["samples", "16"]["RMSE"])
        self.assertLess(rows["samples", "16"]["RMSE"], 25)

    def test_people_read_a_summary_first_and_plots_stand_beside_their_data(self):
        with tempfile.TemporaryDirectory() as folder:
            line = [PROGRAM, "bench", "error", "tetra-2", "--resolution=16x16", "--quick", "--repeat=1", "--knobs=samples,adaptive,depth"]
            done = subprocess.run([*line, "-o", f"{folder}/table", f"--plots={folder}/plots"], capture_output=True, text=True)
            text = pathlib.Path(folder, "table").read_text()
            self.assertRegex(text, r"^tetra-2: [^|]*\n\n\*\*Error against time: about 16 samples a pixel at depth 8")
            self.assertLessEqual(max(map(len, text.splitlines())), 120)
            self.assertEqual((done.stdout, sorted(os.listdir(f"{folder}/plots"))),
                             ("", ["error_tetra-2.csv", "error_tetra-2.svg", "error_tetra-2_knobs.svg"]))

    def test_a_setting_that_gives_two_films_is_an_error_of_dmpcs_own(self):
        one = measured(1, 1)
        runner = measuring.Bench.__new__(measuring.Bench)
        runner._folder = pathlib.Path("none")
        with mock.patch.object(measuring.Bench, "_render", lambda *_: {"film_hash": "other"}), self.assertRaises(program.InternalError):
            runner._measure(one)

    def test_ctrl_c_leaves_what_was_measured_and_no_scratch_file(self):
        with tempfile.TemporaryDirectory() as folder:
            line = [PROGRAM, "bench", "error", "tetra-2", "--resolution=16x16", "--quick", "--repeat=1000", "--knobs=samples"]
            running = subprocess.Popen([*line, "--format=csv", "-o", f"{folder}/table"], stderr=subprocess.PIPE, text=True,
                                       env={**os.environ, "TMPDIR": folder})
            while not any((path.parent / "picture.exr").exists() for path in pathlib.Path(folder).glob("dmpc-*/dmpc-error-*/base.exr")):
                self.assertIsNone(running.poll())
                time.sleep(0.1)
            running.send_signal(signal.SIGINT)
            said = running.communicate()[1]
            self.assertEqual((running.returncode, said), (130, "dmpc: interrupted, the table has the rows finished before\n"))
            for _ in range(50):
                if os.listdir(folder) == ["table"]:
                    break
                time.sleep(0.1)
            self.assertEqual(os.listdir(folder), ["table"])
            self.assertIn("tetra-2,samples,16,", pathlib.Path(folder, "table").read_text())


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
