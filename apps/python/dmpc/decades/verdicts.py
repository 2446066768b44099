"""What runs say of a cell: the winner, by how much, and in how many draws of the machine's prices it stays the winner."""

import itertools
import math
import random
from dataclasses import dataclass, field, replace

from ..studies import judging, search
from ..studies.runs import seconds_of
from . import design, runs

RIVALS_WITHIN = 1.6  # of the winner's time: who is slower is not drawn, but for the runner-up
BATCH = 10


@dataclass
class Row:
    """A family at its best in a cell: by scene its system, setting and result."""
    family: str
    best: dict = field(default_factory=dict)

    def seconds(self, scene):
        return seconds_of(self.best[scene][2]) if scene in self.best else float("inf")

    def mean(self, scenes):
        """The geometric mean over the scenes, infinite if one has no room for it."""
        return math.exp(sum(math.log(self.seconds(scene)) for scene in scenes) / len(scenes))


@dataclass
class Verdict:
    """On the scenes whose pictures are large enough to tell, or on all of them if none is."""
    cell: design.Cell
    best: dict  # rows by family
    times: list = field(default_factory=list)  # by draw: of each family drawn, by scene, the seconds

    def __post_init__(self):
        self.small = {scene: why for scene in self.cell.scenes if (why := self._why_small(scene))}
        self.scenes = tuple(scene for scene in self.cell.scenes if scene not in self.small) or self.cell.scenes
        self.rows = sorted(self.best.values(), key=lambda row: row.mean(self.scenes))  # the fastest first

    def _why_small(self, scene):
        """Nothing, or what takes most of the time of the fastest in place of pages and rays; where one family alone has room, there is
        nothing to tell."""
        ahead, *others = sorted(self.best.values(), key=lambda row: row.seconds(scene))
        if not others or math.isinf(others[0].seconds(scene)):
            return None
        result = ahead.best[scene][2]
        return judging.small_text(result) if judging.small(result) else None

    @property
    def winner(self):
        return self.rows[0]

    @property
    def rivals(self):
        others = [row for row in self.rows[1:] if math.isfinite(row.mean(self.scenes))]
        return [row for row in others[:2] if row is others[0] or row.mean(self.scenes) < RIVALS_WITHIN * self.winner.mean(self.scenes)]

    @property
    def lead(self):
        """How many times as long the runner-up takes; infinite for a winner that alone has room in every scene."""
        return self.rivals[0].mean(self.scenes) / self.winner.mean(self.scenes) if self.rivals else math.inf

    @property
    def factors(self):
        """By draw, of the nearest rival over the winner."""
        return [min(self._mean(drawn, row.family) for row in self.rivals) / self._mean(drawn, self.winner.family) for drawn in self.times]

    def _mean(self, drawn, family):
        return math.exp(sum(math.log(drawn[family][scene]) for scene in self.scenes) / len(self.scenes))

    @property
    def stays(self):
        """The share of draws in which it stays the winner; certain if there is no rival."""
        return 1.0 if not self.rivals or not self.times else sum(judging.is_faster(1, factor) for factor in self.factors) / len(self.times)

    @property
    def is_too_small(self):
        return len(self.small) == len(self.cell.scenes)

    @property
    def is_decided(self):
        return not self.is_too_small and self.stays >= judging.DECIDED and judging.is_faster(1, self.lead)

    def needs_draws(self, plan):
        """Until the share is known: as many draws as are wanted, or fewer if all of the first, or too few of all, stay."""
        count, lost = len(self.times), sum(not judging.is_faster(1, factor) for factor in self.factors)
        if not self.rivals or self.is_too_small or count >= plan.draws:
            return False
        return not (count >= plan.draws_least and (lost == 0 or lost > plan.draws - judging.DECIDED * plan.draws))


def found_settings(kept, plan, memories, cells):
    """By machine, step and family the settings that were best on the scouts, the best first."""
    places = list(dict.fromkeys((cell.machine, cell.step) for cell in cells))
    jobs = [(place, scene, name) for place in places for scene in plan.scouts for name in plan.systems]
    found = search.in_step(kept, [
        search_of(design.Cell("map", *place, 64, "whitted", (scene,)), scene, memories(scene, 64)[place[1]], name)
        for place, scene, name in jobs])
    tried = {}
    for (place, _, name), one in zip(jobs, found):
        if math.isfinite(one.seconds):
            tried.setdefault((*place, design.SYSTEMS[name].family), []).append((one.seconds, name, tuple(one.setting.items())))
    return {key: _distinct(sorted(several), plan.kept * len(plan.scouts)) for key, several in tried.items()}


def search_of(cell, scene, memory, name):
    """Generator for search.in_step: a system's best options in a cell."""
    options = [search.Searched(each.name, tuple(value for value in each.values if _is_priced(cell.machine, each.name, value)))
               for each in design.SYSTEMS[name].searched]
    return search.descend(options, lambda setting: runs.line_of(cell, scene, memory, name, setting.items()))


def _is_priced(machine, option, value):
    return (option, value) != ("structure", "voxels") or machine in judging.ONE_COMPUTER


def _distinct(several, count):
    """The first settings, alternately of each scout: times of different scenes do not compare, but each scout's best comes early."""
    return list(dict.fromkeys((name, setting) for _, name, setting in several))[:count]


def verdict_on(kept, memories, settings, cell):
    """Generator for search.in_step: the rows of a cell, from the settings of its machine and memory."""
    trials = [(family, scene, name, setting) for family in design.FAMILIES for scene in cell.scenes
              for name, setting in settings.get((cell.machine, cell.step, family), ())]
    results = yield [runs.line_of(cell, scene, memories(scene, cell.nodes)[cell.step], name, setting)
                     for _, scene, name, setting in trials]
    rows = {family: Row(family) for family in design.FAMILIES}
    for (family, scene, name, setting), result in zip(trials, results):
        if seconds_of(result) < rows[family].seconds(scene):
            rows[family].best[scene] = (name, setting, result)
    return Verdict(cell, rows)


def draw(kept, plan, memories, verdicts):
    """Adds draws to the verdicts that need them, batch by batch."""
    while waiting := [each for each in verdicts if each.needs_draws(plan)]:
        asked = [(each, number) for each in waiting for number in range(len(each.times), min(len(each.times) + BATCH, plan.draws))]
        lines = [{row.family: {scene: _line(memories, each.cell, row, scene, number) for scene in each.scenes}
                  for row in [each.winner, *each.rivals]} for each, number in asked]
        kept.get([line for rows in lines for row in rows.values() for line in row.values()])
        for (each, _), rows in zip(asked, lines):
            each.times.append({family: {scene: seconds_of(kept.kept(line)) for scene, line in row.items()}
                               for family, row in rows.items()})


def _line(memories, cell, row, scene, number):
    name, setting, _ = row.best[scene]
    return runs.line_of(cell, scene, memories(scene, cell.nodes)[cell.step], name, setting, number)


def line_of_winner(memories, verdict, scene):
    name, setting, _ = verdict.winner.best[scene]
    return runs.line_of(verdict.cell, scene, memories(scene, verdict.cell.nodes)[verdict.cell.step], name, setting)


def interval(ratios):
    """The geometric mean of paired ratios with 95 % by bootstrap over them: all resamples of few, 2,000 of many."""
    logs = [math.log(each) for each in ratios]
    count = len(logs)
    chance = random.Random(1994)
    resamples = itertools.product(logs, repeat=count) if count <= 5 else (chance.choices(logs, k=count) for _ in range(2000))
    means = sorted(sum(one) / count for one in resamples)
    at = [means[min(int(share * len(means)), len(means) - 1)] for share in (0.025, 0.975)]
    return tuple(math.exp(each) for each in (sum(logs) / count, *at))


def of_scene(verdict, scene):
    """The verdict on one scene of a cell, by the same runs: without draws unless its winner and its rivals are those of the cell."""
    single = Verdict(replace(verdict.cell, scenes=(scene,)), verdict.best)
    drawn = {row.family for row in [verdict.winner, *verdict.rivals]}
    if scene in verdict.scenes and all(row.family in drawn for row in [single.winner, *single.rivals]):
        single.times = verdict.times
    return single
