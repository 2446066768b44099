"""The command line of dmpc study decades: plans, runs, and writes the page."""

import argparse
import functools
import math
import time

from .. import program
from ..studies import output, search
from ..studies.runs import CORES
from . import controls, design, measuring, memory, page, predictions, prices, runs, verdicts


def main(words):
    options = _parser().parse_args(words)
    say = output.Messages(options).say
    kept = runs.kept_in(options.output, options.jobs, (lambda text: None) if options.quiet else say)
    plan = design.QUICK_DESIGN if options.quick else design.WHOLE_DESIGN
    try:
        if options.part == "plan":
            return _plan(kept, plan)
        if options.part == "hold":
            with output.scratch_folder():
                for row in measuring.hold(kept.folder):
                    say(f"{row['cell']}: predicted {row['predicted']:.4g} s, took {row['timed']:.4g} s")
            return 0
        study(kept, plan, options.quick)
    except KeyboardInterrupt:
        say(f"stopped; the same line continues after the {len(kept)} runs that {options.output} has")
        return 130
    except program.Error as error:
        say(error)
        return 1
    return 0


def study(kept, plan, is_quick):
    """Runs what is missing and writes the page."""
    began, count = time.monotonic(), len(kept)
    memories = functools.cache(lambda scene, nodes: memory.steps_of(kept, scene, nodes))
    cells = plan.cells()
    kept.say(f"searching the options of {len(plan.systems)} systems for {len(plan.map_cells())} machines and memories")
    settings = verdicts.found_settings(kept, plan, memories, cells)
    kept.say(f"{len(kept) - count} runs; rendering {len(cells)} cells")
    found = search.in_step(kept, [verdicts.verdict_on(kept, memories, settings, cell) for cell in cells])
    found = [each for each in found if math.isfinite(each.winner.mean(each.scenes))]
    kept.say(f"{len(kept) - count} runs; drawing prices")
    verdicts.draw(kept, plan, memories, found)
    checked = controls.check(kept, memories, found)
    minutes = (time.monotonic() - began) / 60
    page.write(kept, plan, memories, found, checked, predictions.read(), prices.Prices(),
               f"{len(kept) - count} runs in {minutes:.0f} minutes, {len(kept)} in all" if len(kept) > count else f"{len(kept)} runs")
    kept.say(f"{kept.folder / 'index.html'}: " + page.sentence(found))


def _plan(kept, plan):
    """What runs cost, by one of each family in each set of cells, and what the design then takes."""
    memories = functools.cache(lambda scene, nodes: memory.steps_of(kept, scene, nodes))
    total = 0.0
    for name, light, nodes, scenes in dict.fromkeys((each.set, each.light, each.nodes, each.scenes) for each in plan.cells()):
        cells = [each for each in plan.cells() if (each.set, each.light, each.nodes, each.scenes) == (name, light, nodes, scenes)]
        lines = [runs.line_of(design.Cell(name, "hdr", 4, nodes, light, (scene,)), scene, memories(scene, nodes)[design.WHOLE], system, ())
                 for scene in scenes for system in ("svm", "forest", "scattered")]
        costs = [one["processor"] for one in kept.get(lines) if "processor" in one]
        cost = sum(costs) / max(len(costs), 1)
        trials = 0
        if name == "map":
            trials = len(cells) * len(plan.scouts) * sum(1 + sum(len(option.values) - 1 for option in design.SYSTEMS[system].searched)
                                                         for system in plan.systems)
        rendered = len(cells) * len(scenes) * len(design.FAMILIES) * plan.kept * len(plan.scouts)
        drawn = [sum(each.step > 1 for each in cells) * len(scenes) * 2 * draws for draws in (plan.draws_least, plan.draws)]
        seconds = cost * (trials / 2 + rendered / 2 + drawn[0])
        total += seconds
        print(f"{name:6} {light:8} {nodes:4} nodes, {', '.join(scenes)}: {cost:.2f} s of processor time a run; {len(cells)} cells; searches "
              f"{trials}, renders {rendered}, half of which have no room, draws {drawn[0]} to {drawn[1]}: {seconds / 60:.0f} minutes")
    print(f"{total / 60:.0f} minutes of processor time if {plan.draws_least} draws settle each cell")
    return 0


def _parser():
    parser = argparse.ArgumentParser(prog="dmpc study decades")
    parser.add_argument("--output", required=True)
    parser.add_argument("--part", choices=("plan", "run", "hold"), default="run")
    parser.add_argument("--quick", action="store_true")
    parser.add_argument("--quiet", action="store_true")
    parser.add_argument("--jobs", type=int, default=CORES)
    parser.set_defaults(format=None)
    return parser
