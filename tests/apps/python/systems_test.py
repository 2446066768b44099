"""The study systems, run by Debian's Python with nothing but its standard library: `systems_test.py PROGRAM MODULE_FOLDER`."""

import contextlib
import io
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest
from dataclasses import replace

PROGRAM, MODULES = sys.argv[1:3]
os.environ["DMPC"] = PROGRAM
sys.path.insert(0, MODULES)
from dmpc import program  # noqa: E402
from dmpc.systems import command, memory_rule, setups, verdicts  # noqa: E402


def setup_of(name, structure="extents"):
    return next(one for one in setups.on_all_structures([name], 4, None) if one.database.structure == structure)


def row(seconds, name="svm on grid", film="7", memory=1 << 20, nodes=64, scene="tetra-4", machine="hdr", search="one search", **options):
    options = {"homes": "spread", "in-flight": "16", "strategy": "svm", **{key.replace("_", "-"): value for key, value in options.items()}}
    return verdicts.Row(name, (scene, machine, film, nodes, memory), options, seconds, search)


class VerdictTest(unittest.TestCase):
    def test_rows_that_differ_in_one_option_have_an_isolated_verdict_which_names_it(self):
        self.assertEqual(verdicts.isolated(row(1), row(2, "svm otherwise", homes="host")),
                         "Isolated, homes (spread, host) alone, 64 nodes of hdr, 1.00 MiB each: svm on grid 1.00 s, svm otherwise 2.00 s, "
                         "2.00 times as long.")
        self.assertTrue(verdicts.isolated(row(1), row(1.005, "other", resident="50")).endswith("other 1.00 s, a tie."))

    def test_rows_that_differ_in_nothing_or_in_more_have_none(self):
        for other in (row(2), row(2, homes="host", in_flight="1"), row(2, homes="host", resident="50")):
            with self.assertRaises(program.InternalError):
                verdicts.isolated(row(1), other)

    def test_no_verdict_is_drawn_across_scenes_films_machines_memories_or_numbers_of_nodes(self):
        for more in ({"scene": "tetra-5"}, {"film": "8"}, {"machine": "ipsc2"}, {"memory": 1}, {"nodes": 32}):
            for judge in (verdicts.isolated, verdicts.best):
                with self.assertRaises(program.InternalError):
                    judge(row(1), row(2, homes="host", **more))

    def test_the_best_are_compared_only_if_one_search_has_found_them_and_all_their_differences_are_named(self):
        rays = replace(row(3, "subsampled on grid"), options={"balance": "subsampled", "strategy": "dataflow"})
        self.assertEqual(verdicts.best(row(2), rays, (97, 100)),
                         "Best against best, 64 nodes of hdr, 1.00 MiB each: svm on grid 2.00 s, subsampled on grid 3.00 s, 1.50 times as "
                         "long; ahead in 97 of 100 draws of the prices. They differ in strategy (svm, dataflow); svm on grid alone has "
                         "homes spread, in-flight 16; subsampled on grid alone has balance subsampled.")
        for first, second in ((row(2), replace(rays, search="another")), (row(2, search=""), replace(rays, search=""))):
            with self.assertRaises(program.InternalError):
                verdicts.best(first, second)

    def test_a_row_that_is_ahead_in_fewer_than_80_of_100_draws_is_undecided(self):
        self.assertTrue(verdicts.is_undecided((79, 100)) and not verdicts.is_undecided((80, 100)) and not verdicts.is_undecided(None))
        self.assertTrue(verdicts.best(row(1), row(2, homes="host"), (79, 100)).startswith("Best against best, undecided, 64 nodes"))

    def test_a_clear_winner_is_ahead_in_all_draws_and_equal_times_are_nobodys(self):
        self.assertEqual(verdicts.ahead_in([[1, 2, 3]] * 100, 0, 1), (100, 100))
        self.assertEqual(verdicts.first_in([[1, 2, 3]] * 100), [100, 0, 0])
        self.assertEqual(verdicts.ahead_in([[1, 1]] * 100, 0, 1), (0, 100))
        self.assertEqual(verdicts.first_in([[1, 1]] * 100), [0, 0])
        self.assertEqual(verdicts.ahead_in([[1, 2], [2, 1], [1, 2]], 0, 1), (2, 3))
        self.assertEqual(verdicts.first_in([]), [])


class MemoryRuleTest(unittest.TestCase):
    def test_rules_are_rays_shares_and_sizes_and_read_as_they_were_typed(self):
        rules = memory_rule.parse("rays,25%,1000%,0.5%,1MiB,300KiB,1000B,2GiB")
        self.assertEqual(",".join(map(str, rules)), "rays,25%,1000%,0.5%,1MiB,300KiB,1000B,2GiB")
        self.assertEqual([rule.bytes_of(1000, 77) for rule in rules[:5]], [77, 250, 10000, 5, 1 << 20])

    def test_what_is_no_rule_is_bad_usage_that_says_what_one_is(self):
        for text in ("", "rays,", "0%", "1001%", "-1%", "nan%", "1e400%", "many", "1.5MiB", "2000GiB"):
            with self.assertRaisesRegex(program.UsageError, "^--node-memory="):
                memory_rule.parse(text)


class SetupTest(unittest.TestCase):
    def searched(self, name):
        return [f"{option.name}={','.join(option.values)}" for option in setups.searched_options(setup_of(name))]

    def test_the_search_of_a_system_tries_what_it_has_and_what_does_not_define_it_from_its_defaults_on(self):
        flight, page = "in-flight=16,1,64", "page-size=1KiB,4KiB"
        self.assertEqual(self.searched("svm"), [page, flight, "work-donor=ring,host", "resident=0,50"])
        self.assertEqual(self.searched("svm-resident"), [page, flight])
        self.assertEqual(self.searched("green-paddon"), [page, flight])
        self.assertEqual(self.searched("pixel-machine"), [page, flight, "resident=0,50"])
        self.assertEqual(self.searched("forest"), ["page-size=4KiB,1KiB", flight, "work-donor=ring,host"])
        self.assertEqual(self.searched("forest-static"), ["page-size=4KiB,1KiB", flight])
        self.assertEqual(self.searched("replicated"), ["work-donor=ring,host"])
        self.assertEqual(self.searched("moving"), ["backpressure=on,off", "ray-batch=default,64"])

    def test_defaults_are_not_given_so_that_a_run_may_choose(self):
        start = setup_of("moving")
        self.assertEqual(start.with_setting({"backpressure": "on", "ray-batch": "default"}), start)
        changed = start.with_setting({"backpressure": "off", "ray-batch": "64"})
        self.assertIn("--no-backpressure", changed.words)
        self.assertIn("--ray-batch=64", changed.words)
        self.assertEqual(setup_of("forest").with_setting({"page-size": "1KiB", "in-flight": "16", "work-donor": "ring"}).database.page, "1KiB")

    def test_what_a_run_took_stands_for_what_was_left_open(self):
        texts = setup_of("svm").texts({"in-flight": 7, "ray-batch": None})
        self.assertEqual((texts["in-flight"], texts["work-donor"], texts["resident"]), ("7", "ring", "0"))
        self.assertEqual(setup_of("pixel-machine").texts()["work-donor"], "none")
        self.assertNotIn("cuts", setup_of("scattered").texts())
        self.assertEqual(setup_of("equal-size").texts()["cuts"], "longer-side")

    def test_each_system_is_described_on_its_own_structure_with_a_pixel_in_flight_and_without_backpressure(self):
        for system in setups.systems().values():
            one = setups.described(system, 4)
            self.assertEqual((one.database.structure, one.database.voxels == "article"), (system.had, system.had == "voxels"))
            self.assertIn("--no-backpressure" if system.strategy == "dataflow" else "--in-flight=1", one.words)
        self.assertIn("--cuts=alternating", setups.described(setups.systems()["subsampled"], 4).words)

    def test_the_cache_of_what_is_described_holds_all_that_a_node_does_not_have(self):
        def pages(name):
            return setups.with_whole_cache(setups.described(setups.systems()[name], 4), 1002).settings.get("cache-pages")

        self.assertEqual([pages(name) for name in ("svm", "green-paddon", "forest")], [752, 1002, None])

    def test_systems_are_on_every_structure_that_they_can_walk_and_are_one_if_they_differ_in_that_alone(self):
        made = setups.on_all_structures(["svm", "svm-extents", "forest", "subsampled"], 4, 9)
        self.assertEqual([one.name for one in made], [f"svm on {each}" for each in setups.STRUCTURES] + ["forest on extents"]
                         + [f"subsampled on {each}" for each in setups.STRUCTURES])
        self.assertEqual({one.memory for one in made}, {9})

    def test_what_is_found_out_beforehand_is_said(self):
        self.assertEqual([setup_of(name).free_beforehand for name in ("svm", "green-paddon", "moving", "scattered")],
                         [None, "small picture for residents", "small picture for regions", None])


class StudyTest(unittest.TestCase):
    def table(self, *words, status=0):
        printed, errors = io.StringIO(), io.StringIO()
        with contextlib.redirect_stdout(printed), contextlib.redirect_stderr(errors):
            self.assertEqual(command.main(["--resolution=32x32", "--format=json", "--nodes=4", "--quiet", *words]), status, errors.getvalue())
        return json.loads(printed.getvalue()) if status == 0 else errors.getvalue()

    def count(self, table, words):
        return sum(words in note for note in table["notes"])

    def test_what_was_described_has_the_verdicts_that_authors_drew_and_no_others(self):
        table = self.table("tetra-4", "--tables=described", "--systems=svm,equal-size", "--systems=subsampled,moving")
        self.assertEqual([(one["system"], one["structure"], one["memory"]) for one in table["rows"]],
                         [(name, "voxels", "as needed") for name in ("svm", "equal-size", "subsampled", "moving")])
        self.assertEqual([one["in_flight"] for one in table["rows"]], ["1", None, None, None])
        self.assertEqual(self.count(table, "Badouel, Bouatouch and Priol (1994): "), 2)
        self.assertEqual(self.count(table, "Isolated, balance (subsampled, equal-size) alone"), 1)
        self.assertEqual(self.count(table, "Isolated, strategy (svm, dataflow) alone"), 1)
        self.assertEqual(self.count(table, "Best against best, "), 0)
        self.assertEqual(self.count(table, "Film of every run, 4 in all: "), 1)

    def test_what_the_article_says_of_structures_is_judged_where_both_have_the_prices_of_one_machine(self):
        words = ("tetra-4", "--tables=described", "--systems=replicated,replicated-extents")
        self.assertEqual(self.count(self.table(*words), "not judged, since the structures have prices of their own"), 1)
        on_hdr = self.table(*words, "--machine=hdr")
        self.assertEqual(self.count(on_hdr, "Isolated, structure (voxels, extents) alone"), 1)
        self.assertEqual(self.count(on_hdr, " has prices for other structures "), 1)
        self.assertEqual(self.count(on_hdr, "hdr has prices for other structures (grid, extents) than voxels"), 1)

    def test_a_cell_has_a_verdict_for_each_other_strategy_of_the_best_found_by_the_search(self):
        table = self.table("tetra-5", "--tables=equal", "--systems=svm,forest,subsampled", "--search", "--draws=3")
        self.assertEqual(len(table["rows"]), 3 + 1 + 3)
        self.assertEqual(len({one["node_memory"] for one in table["rows"]}), 1)
        self.assertEqual(self.count(table, "Search, 4 nodes, memory rays"), len(table["rows"]))
        self.assertEqual(self.count(table, "Too small, 4 nodes"), 0)
        self.assertEqual(self.count(table, "Best against best, "), 2)
        self.assertEqual(self.count(table, " of 3 draws of the prices"), 2)
        self.assertEqual(len([one for one in table["rows"] if one["draws_ahead"] is not None]), 3)

    def test_what_fits_no_setting_has_a_row_without_figures_and_a_cell_in_which_nothing_fits_says_so(self):
        table = self.table("tetra-5", "--tables=equal", "--systems=replicated", "--node-memory=4096B")
        self.assertEqual([(one["node_memory"], one["virtual_time"]) for one in table["rows"]], [(4096, None)] * 3)
        self.assertEqual(self.count(table, "nothing fits"), 1)
        self.assertEqual(self.count(table, "No picture was rendered."), 1)

    def test_bad_input_is_told_in_dmpcs_words(self):
        self.assertIn("at most 1000%", self.table("tetra-4", "--node-memory=2000%", status=2))
        self.assertIn("dmpc: there is no built-in scene 'nonsense-3'", self.table("nonsense-3", status=1))

    def test_a_file_is_rendered_as_other_scenes_are_and_what_dmpc_notes_of_it_is_said_once(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder, "one triangle.obj")
            path.write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 1 1 2\n")
            errors = io.StringIO()
            with contextlib.redirect_stdout(io.StringIO()) as printed, contextlib.redirect_stderr(errors):
                self.assertEqual(command.main(["--resolution=8x4", "--nodes=2", "--systems=svm", "--draws=0", str(path)]), 0)
        self.assertIn("one triangle.obj: 8x4 pixels, 1 sample a pixel, depth 5,", " ".join(printed.getvalue().split()))
        self.assertEqual(errors.getvalue().count("1 degenerate primitive"), 1)

    def test_the_program_starts_it_and_writes_the_table_to_a_file(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder, "table.csv")
            done = subprocess.run([PROGRAM, "study", "systems", "tetra-4", "--resolution=8x8", "--systems=svm", "--tables=described",
                                   "--format=csv", "-o", path], capture_output=True, text=True, env={**os.environ, "PYTHONPATH": MODULES})
            self.assertEqual((done.returncode, done.stdout, done.stderr), (0, "", ""))
            self.assertEqual(path.read_text().splitlines()[1].split(",")[:5], ["described", "as needed", "64", "svm", "voxels"])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
