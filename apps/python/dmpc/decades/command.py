"""The command line of dmpc study decades: plans, runs, and writes the page."""

import argparse
import functools
import os
import sys
import time

from .. import program
from . import controls, design, memory, page, predictions, prices, runs, search, verdicts


def main(words):
    options = _parser().parse_args(words)
    kept = runs.Runs(options.output, options.jobs, _say)
    plan = design.QUICK_DESIGN if options.quick else design.WHOLE_DESIGN
    try:
        if options.part == "plan":
            return _plan(kept, plan)
        study(kept, plan, options.quick)
    except KeyboardInterrupt:
        _say(f"stopped; the same line continues after the {len(kept)} runs that {options.output} has")
        return 130
    except program.Error as error:
        _say(error)
        return 1
    return 0


def study(kept, plan, is_quick):
    """Runs what is missing and writes the page."""
    began, count = time.monotonic(), len(kept)
    memories = functools.cache(lambda scene, nodes: memory.steps_of(kept, scene, nodes))
    cells = plan.cells()
    _say(f"searching the options of {len(plan.systems)} systems for {len(plan.map_cells())} machines and memories")
    settings = verdicts.found_settings(kept, plan, memories, cells)
    _say(f"{len(kept) - count} runs; rendering {len(cells)} cells")
    found = search.in_step(kept, [verdicts.verdict_on(kept, memories, settings, cell) for cell in cells])
    found = [each for each in found if each.winner.best]
    _say(f"{len(kept) - count} runs; drawing prices")
    verdicts.draw(kept, plan, memories, found)
    checked = controls.check(kept, memories, found)
    minutes = (time.monotonic() - began) / 60
    page.write(kept, plan, memories, found, checked, predictions.read(), prices.Prices(),
               f"{len(kept) - count} runs in {minutes:.0f} minutes, {len(kept)} in all" if len(kept) > count else f"{len(kept)} runs")
    _say(f"{kept.folder / 'index.html'}: " + page.sentence(found))


def _plan(kept, plan):
    """What runs of each family cost, by one of each, and what the design needs at most."""
    cell = design.Cell("map", "hdr", 5, 64, "whitted", ("rings-4-t1",))
    memories = memory.steps_of(kept, "rings-4-t1", 64)
    lines = {name: runs.line_of(cell, "rings-4-t1", memories[7], name, ()) for name in plan.systems}
    for name, result in zip(lines, kept.get(list(lines.values()))):
        print(f"{name:14} {result.get('processor', float('nan')):6.2f} s of processor time a run")
    cells = plan.cells()
    trials = sum(1 + sum(len(option.values) - 1 for option in design.SYSTEMS[name].searched) for name in plan.systems)
    places = len({(each.machine, each.step) for each in cells})
    print(f"{places} searches x {len(plan.scouts)} scenes x {trials} runs = {places * len(plan.scouts) * trials} at most")
    rows = sum(len(each.scenes) for each in cells)
    print(f"{len(cells)} cells, {rows} cells x scenes, {rows * 4 * plan.kept * len(plan.scouts)} runs at most")
    print(f"draws: {rows * 2 * plan.draws_least} runs if {plan.draws_least} settle each cell, {rows * 3 * plan.draws} at most")
    return 0


def _say(text):
    print(f"dmpc: {text}", file=sys.stderr, flush=True)


def _parser():
    parser = argparse.ArgumentParser(prog="dmpc study decades")
    parser.add_argument("--output", required=True)
    parser.add_argument("--part", choices=("plan", "run", "page"), default="run")
    parser.add_argument("--quick", action="store_true")
    parser.add_argument("--jobs", type=int, default=len(os.sched_getaffinity(0)))
    return parser
