"""The study decades, run by Debian's Python: `decades_test.py PROGRAM MODULE_FOLDER`. Ends with 77 where its packages are missing."""

import hashlib
import io
import json
import math
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest
from contextlib import redirect_stderr
from dataclasses import replace
from unittest import mock

PROGRAM, MODULES = sys.argv[1:3]
os.environ["DMPC"] = PROGRAM
os.environ["PYTHONPATH"] = MODULES
sys.path.insert(0, MODULES)
try:
    from dmpc.decades import command, controls, design, memory, page, predictions, prices, runs, verdicts
    from dmpc.studies import search
    from dmpc.studies.runs import Runs
except ModuleNotFoundError as error:
    print(f"skipped: {error}; tests/run installs what is missing")
    sys.exit(77)

CELL = design.Cell("map", "hdr", 4, 64, "whitted", ("a", "b"))
PLAN = replace(design.WHOLE_DESIGN, draws=100, draws_least=20)


def result(seconds, film="f", **more):
    share = dict.fromkeys(("computing", "film_wait", "idle_at_end"), 0.0)
    return {"line": "render", "seconds": seconds, "film": film, "host": 0.0, "share": share, **more}


def verdict(times, factors=()):
    """Of families with their seconds in the scenes a and b; None has no room. `factors`: of all rivals, by draw."""
    rows = {family: verdicts.Row(family, {scene: ("svm", (), result(seconds)) for scene, seconds in zip("ab", several) if seconds})
            for family, several in times.items()}
    made = verdicts.Verdict(CELL, rows)
    made.times = [{row.family: dict.fromkeys("ab", 1.0 if row is made.winner else factor) for row in [made.winner, *made.rivals]}
                  for factor in factors]
    return made


class VerdictTest(unittest.TestCase):
    def test_the_winner_has_the_least_geometric_mean_of_those_with_room_in_every_scene(self):
        made = verdict({"pages": (2, 8), "rays": (1, None), "questions": (5, 5)})
        self.assertEqual(made.winner.family, "pages")
        self.assertAlmostEqual(made.lead, 5 / 4)
        self.assertEqual([row.family for row in made.rivals], ["questions"])

    def test_who_alone_has_room_is_decided_without_draws(self):
        made = verdict({"pages": (2, 8), "rays": (1, None)})
        self.assertTrue(math.isinf(made.lead) and made.is_decided and not made.needs_draws(PLAN))

    def test_a_draw_times_the_winner_and_its_rivals_on_the_machine_of_that_draw(self):
        def answer(line):
            drawn = int(line.split("machines/hdr.")[1].split(".")[0])
            return {"line": line, "seconds": 3 + drawn if "--strategy=dataflow" in line else 2}

        made = verdict({"pages": (2, 2), "rays": (3, 3)})
        for scene in "ab":
            made.best["rays"].best[scene] = ("scattered", (), result(3))
        kept = mock.Mock()
        kept.kept.side_effect = answer
        with mock.patch.dict(design.SCENES, {"a": (1, ()), "b": (1, ())}):
            verdicts.draw(kept, replace(PLAN, draws_least=10, draws=10), lambda scene, nodes: [1 << 20] * 8, [made])
        self.assertEqual([round(factor, 9) for factor in made.factors], [(3 + number) / 2 for number in range(10)])

    def test_a_cell_is_undecided_below_80_of_100_draws_and_ties_do_not_stay(self):
        times = {"pages": (1, 1), "rays": (2, 2)}
        self.assertTrue(verdict(times, [2] * 80 + [0.5] * 20).is_decided)
        self.assertFalse(verdict(times, [2] * 79 + [0.5] * 21).is_decided)
        self.assertFalse(verdict(times, [1.005] * 100).is_decided)

    def test_draws_end_early_only_if_all_stay_or_too_few_can(self):
        times = {"pages": (1, 1), "rays": (2, 2)}
        self.assertTrue(verdict(times, [2] * 19).needs_draws(PLAN))
        self.assertFalse(verdict(times, [2] * 20).needs_draws(PLAN))
        self.assertTrue(verdict(times, [2] * 19 + [0.5]).needs_draws(PLAN))
        self.assertTrue(verdict(times, [2] * 60 + [0.5] * 20).needs_draws(PLAN))
        self.assertFalse(verdict(times, [2] * 60 + [0.5] * 21).needs_draws(PLAN))
        self.assertFalse(verdict(times, [2] * 99 + [0.5]).needs_draws(PLAN))

    def test_scenes_in_which_the_host_the_film_or_the_end_decides_are_left_out_and_a_cell_of_nothing_else_is_undecided(self):
        made = verdict({"pages": (1, 4), "rays": (2, 2)}, [2] * 20)
        self.assertEqual((made.scenes, made.winner.family), (("a", "b"), "pages"))
        made.best["rays"].best["b"][2]["share"]["idle_at_end"] = 51.0
        again = verdicts.Verdict(CELL, made.best, made.times)
        self.assertEqual((again.scenes, list(again.small)), (("a",), ["b"]))
        self.assertAlmostEqual(again.lead, 2)
        self.assertTrue(again.is_decided)
        made.best["pages"].best["a"][2]["host"] = 0.6
        self.assertFalse(verdicts.Verdict(CELL, made.best, made.times).is_decided)

    def test_where_one_family_alone_has_room_no_picture_is_too_small(self):
        made = verdict({"pages": (1, 1), "rays": (2, None)})
        made.best["pages"].best["b"][2]["host"] = 0.9
        self.assertEqual(verdicts.Verdict(CELL, made.best).small, {})

    def test_a_scene_alone_has_the_draws_of_its_cell_only_if_those_were_of_its_families(self):
        made = verdict({"pages": (1, 8), "rays": (3, 3), "questions": (60, 60)}, [2] * 20)
        self.assertEqual({row.family for row in made.rivals}, {"rays"})
        self.assertEqual(verdicts.of_scene(made, "b").winner.family, "rays")
        self.assertEqual(len(verdicts.of_scene(made, "b").times), 20)
        made.best["questions"].best["b"] = ("forest", (), result(1))
        self.assertEqual(verdicts.of_scene(made, "b").winner.family, "questions")
        self.assertEqual(verdicts.of_scene(made, "b").times, [])

    def test_an_interval_is_of_the_geometric_mean_and_holds_it(self):
        mean, low, high = verdicts.interval([1, 4, 2, 2])
        self.assertAlmostEqual(mean, 2)
        self.assertTrue(1 <= low < mean < high <= 4)
        self.assertTrue(all(abs(one - 3) < 1e-12 for one in verdicts.interval([3, 3])))


class SearchTest(unittest.TestCase):
    def test_it_tries_one_option_after_the_other_with_the_best_so_far_and_steps_over_what_has_no_room(self):
        def seconds(line):
            base = 4 if "--page-size=4KiB" in line else 8
            if "--in-flight=64" in line:
                return None
            return base - ("--in-flight=1 " in line) - ("--resident=50" in line) + (" --structure=grid" in line)

        def answer(lines):
            return [{"line": line, **({} if seconds(line) is None else {"seconds": seconds(line)})} for line in lines]

        kept = mock.Mock()
        kept.get.side_effect = answer
        [found] = search.in_step(kept, [verdicts.search_of(CELL, "rings-4-t1", 1 << 20, "svm")])
        self.assertEqual(found.seconds, 2)
        self.assertEqual(found.setting, {"structure": "extents", "page-size": "4KiB", "in-flight": "1", "work-donor": "ring", "resident": "50"})

    def test_voxels_are_tried_only_on_machines_with_prices_for_them(self):
        tried = []
        kept = mock.Mock()
        kept.get.side_effect = lambda lines: tried.extend(lines) or [{"line": line, "seconds": 1} for line in lines]
        cells = [replace(CELL, machine=machine) for machine in ("ipsc2", "hdr")]
        search.in_step(kept, [verdicts.search_of(cell, "rings-4-t1", 1 << 20, "svm") for cell in cells])
        voxels = [line for line in tried if "--structure=voxels" in line]
        self.assertEqual(len(voxels), 1)
        self.assertIn("--machine=ipsc2-1994", voxels[0])


class PredictionsTest(unittest.TestCase):
    def test_they_are_those_that_were_committed_before_the_runs(self):
        committed = {"2026-11-30.json": "7be4d52df1d51a38f53f8616c55218052b69394de19dfc0af1feabc324d55f30"}
        self.assertEqual({one.name: one.sha256 for one in predictions.read()}, committed)
        self.assertEqual(hashlib.sha256((predictions.FOLDER / "2026-11-30.json").read_bytes()).hexdigest(), committed["2026-11-30.json"])

    def test_each_is_about_a_cell_of_the_design(self):
        keys = {cell.key for cell in design.WHOLE_DESIGN.cells()}
        for one in predictions.read():
            self.assertGreater(len(one.cells), 40)
            self.assertGreater(len(set(one.cells) & keys), 40)

    def test_one_holds_if_the_winner_came_and_its_lead_within_a_factor(self):
        made = verdict({"pages": (1, 1), "rays": (2, 2)})
        self.assertEqual(predictions.held(("rays", 2.0), made), (False, False))
        self.assertEqual(predictions.held(("pages", 1.5), made), (True, True))
        self.assertEqual(predictions.held(("pages", 1.2), made), (True, False))
        self.assertEqual(predictions.held(("pages", 4.0), made), (True, False))
        self.assertEqual(predictions.held(("pages", None), made), (True, False))
        self.assertEqual(predictions.held(("pages", None), verdict({"pages": (1, 1)})), (True, True))


class DesignTest(unittest.TestCase):
    def test_no_two_cells_of_a_light_share_their_place_and_quick_ones_are_of_the_whole(self):
        whole = [(cell.key, cell.scenes) for cell in design.WHOLE_DESIGN.cells()]
        self.assertEqual(len(whole), len(set(whole)))
        quick = {cell.key for cell in design.QUICK_DESIGN.cells()}
        self.assertLessEqual(quick, {key for key, _ in whole})

    def test_what_turns_a_cell_is_the_price_on_which_its_lead_depends(self):
        made = verdict({"pages": (1, 1), "rays": (2, 2)})
        fake = mock.Mock()
        chances = [(0.3, -0.2), (-0.5, 0.1), (0.1, 0.4), (0.6, -0.6), (-0.2, -0.3), (0.4, 0.5), (-0.6, 0.2), (0.2, 0.1), (0, 0.6), (-0.1, -0.5)]
        fake.factors.side_effect = lambda _, number: {"page service": chances[number][0], "a hop": chances[number][1]}
        made.times = [{"pages": dict.fromkeys("ab", 1.0), "rays": dict.fromkeys("ab", 2 * math.exp(-0.5 * one))} for one, _ in chances]
        name, power, factor = prices.turning(fake, made)
        self.assertEqual(name, "page service")
        self.assertAlmostEqual(power, -0.5, places=2)
        self.assertAlmostEqual(factor, 4, delta=0.05)


class StudyTest(unittest.TestCase):
    """A small study from end to end, by the program."""

    SMALL = design.Design(systems=("replicated", "svm", "scattered"), scouts=("rings-4-t1",), steps=(4, 7), scenes=("rings-4-t1", "mount-6-t6"),
                          kept=1, draws=10, draws_least=10)

    def study(self, folder):
        kept = runs.kept_in(folder, 2, lambda text: None)
        with mock.patch.dict(design.MACHINES, {"paragon": 1993}, clear=True), mock.patch.dict(design.RESOLUTIONS, {64: 32}), \
                redirect_stderr(io.StringIO()):
            command.study(kept, self.SMALL, True)
        return kept

    def test_it_writes_a_page_continues_from_what_is_kept_and_runs_nothing_twice(self):
        with tempfile.TemporaryDirectory() as folder:
            first = self.study(folder)
            text = (pathlib.Path(folder) / "index.html").read_text()
            self.assertIn("2 of 2 cells are decided. ", text)
            self.assertTrue((pathlib.Path(folder) / "machines" / "paragon.9.json").exists())
            self.assertIn("dmpc render ", text)
            self.assertNotIn("NOT as it must be", text)
            lines = (pathlib.Path(folder) / "runs.jsonl").read_text().splitlines()
            self.assertEqual(len(lines), len(first))
            (pathlib.Path(folder) / "runs.jsonl").write_text("\n".join(lines[:-3]) + "\n" + lines[-1][:40])
            with mock.patch.object(Runs, "_run", autospec=True, side_effect=Runs._run) as run:
                again = self.study(folder)
            self.assertLessEqual(run.call_count, 3)
            self.assertGreater(run.call_count, 0)
            self.assertEqual({one["line"]: one.get("run") for one in again.all()}, {one["line"]: one.get("run") for one in first.all()})
            self.assertEqual((pathlib.Path(folder) / "map-light.svg").read_bytes()[:5], b"<?xml")

    def test_memories_grow_from_the_least_of_pages_to_that_of_copies(self):
        with tempfile.TemporaryDirectory() as folder:
            steps = memory.steps_of(runs.kept_in(folder, 2, print), "rings-4-t1", 64)
        self.assertEqual(len(steps), design.STEPS)
        self.assertEqual(steps, sorted(set(steps)))

    def test_a_control_fails_if_other_samples_give_the_same_film(self):
        made = verdict({"pages": (1, 1), "rays": (2, 2)})
        for family in made.rows:
            family.best["b"] = (*family.best["b"][:2], result(1, "g"))
        kept = mock.Mock()
        kept.get.return_value = [result(1, "h")]
        with mock.patch.dict(design.SCENES, {"a": (1, ()), "b": (1, ())}):
            self.assertTrue(all(one.is_right for one in controls.check(kept, lambda scene, nodes: [1 << 20] * 8, [made])))
            kept.get.return_value = [result(1, "f")]
            self.assertFalse(controls.check(kept, lambda scene, nodes: [1 << 20] * 8, [made])[0].is_right)

    def test_the_first_sentence_says_how_many_are_decided_of_all(self):
        found = [verdict({"pages": (1, 1), "rays": (2, 2)}, [2] * 20), verdict({"rays": (1, 1), "pages": (2, 2)}, [2] * 70 + [0.5] * 30)]
        self.assertTrue(page.sentence(found).startswith("1 of 2 cells are decided. Of the 2 machines and memories below pages 1 (by 2.00"))


class CommandTest(unittest.TestCase):
    def test_a_missing_module_is_named_with_the_line_that_installs_it(self):
        with tempfile.TemporaryDirectory() as folder:
            (pathlib.Path(folder) / "matplotlib.py").write_text("raise ModuleNotFoundError(\"none\", name=\"matplotlib\")\n")
            done = subprocess.run([PROGRAM, "study", "decades", "-o", folder + "/out"], capture_output=True, text=True,
                                  env={**os.environ, "PYTHONPATH": f"{folder}:{MODULES}"})
        self.assertEqual(done.returncode, 1)
        self.assertIn("needs Python's module matplotlib: apt-get install python3-matplotlib", done.stderr)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
