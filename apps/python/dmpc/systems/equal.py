"""The table "equal": every system on every structure at its best with the same memory, and what may be concluded from it."""

from dataclasses import dataclass

from .. import program
from ..studies import judging, search
from ..studies.runs import seconds_of
from ..studies.texts import bytes_text, counted
from . import rows, setups, verdicts

_DRAWN = 3  # rows, at most


@dataclass
class Cell:
    """The rows with the same number of nodes and the same memory."""
    nodes: int
    rule: object
    memory: int
    starts: list  # setups before the search

    def __str__(self):
        return f"{counted(self.nodes, 'node')}, memory {self.rule} ({bytes_text(self.memory)})"


@dataclass
class Best:
    """A row at the best of its search."""
    start: setups.Setup
    found: search.Found

    @property
    def setup(self):
        return self.start.with_setting(self.found.setting)

    @property
    def has_run(self):
        return "seconds" in self.found.result


def add_to(table, subject, names, node_counts, rules, draws, tells_search):
    cells = []
    database_bytes = subject.database(setups.Database())["bytes"]
    for nodes in node_counts:
        rays_bytes = _memory_of_rays(subject, nodes) if any(rule.is_of_rays for rule in rules) else None
        for rule in rules:
            memory = rule.bytes_of(database_bytes, rays_bytes)
            cells.append(Cell(nodes, rule, memory, setups.on_all_structures(names, nodes, memory)))
    starts = [start for cell in cells for start in cell.starts]
    found = iter(search.in_step(subject, [_search(subject, start) for start in starts]))
    for cell in cells:
        _finish(table, subject, cell, [Best(start, next(found)) for start in cell.starts], draws, tells_search)


def _search(subject, start):
    return search.descend(setups.searched_options(start), lambda setting: subject.line(start.with_setting(setting)))


def _memory_of_rays(subject, nodes):
    """What the better of two systems with rays needs on the grid by default."""
    both = [setups.Setup(setups.systems()[name], setups.Database(), nodes) for name in ("scattered", "subsampled")]
    results = subject.get([subject.line(setup) for setup in both])
    better = results[seconds_of(results[1]) < seconds_of(results[0])]
    if "misfit" in better:
        raise program.CapacityError(better["misfit"])
    return better["memory"]


def _finish(table, subject, cell, all_rows, draws, tells_search):
    best = _best_of_strategies(all_rows)
    small = best and judging.small(best[0].found.result)
    drawn = best[:_DRAWN] if len(best) > 1 and not small else []
    seconds = _draw(subject, drawn, draws)
    first = dict(zip(map(id, drawn), verdicts.first_in(seconds)))
    for row in all_rows:
        table.add(rows.row_of(subject, "equal", str(cell.rule), row.setup, row.found.result, first.get(id(row))))
    if tells_search:
        for row in all_rows:
            table.note(f"Search, {cell}, {row.start.name}: {row.found.steps_text()}.")
    if not best:
        table.note(f"On {cell} nothing fits.")
    elif small:
        table.note(f"Too small, {cell}: with {best[0].setup.name} {judging.small_text(best[0].found.result)}: "
                   f"{judging.remedy(best[0].found.result, *subject.size)} or more would do. No verdict.")
    else:
        _add_verdicts(table, subject, all_rows, best, seconds)


def _best_of_strategies(all_rows):
    """The fastest row of each strategy, the fastest of all first."""
    best = {}
    for row in sorted((row for row in all_rows if row.has_run), key=lambda row: row.found.seconds):
        best.setdefault(row.setup.system.strategy, row)
    return list(best.values())


def _draw(subject, drawn, draws):
    """By draw the seconds of each row."""
    lines = [subject.line(row.setup, number) for number in range(draws) for row in drawn]
    seconds = [seconds_of(result) for result in subject.get(lines)]
    return [seconds[at:at + len(drawn)] for at in range(0, len(seconds), len(drawn) or 1)]


def _add_verdicts(table, subject, all_rows, best, seconds):
    compared = {id(row): rows.compared(subject, row.setup, row.found.result, setups.SEARCH) for row in all_rows if row.has_run}
    for at, row in enumerate(best[1:], 1):
        ahead = verdicts.ahead_in(seconds, 0, at) if seconds and at < len(seconds[0]) else None
        table.note(verdicts.best(compared[id(best[0])], compared[id(row)], ahead))
    for at, first in enumerate(all_rows):
        for second in all_rows[at + 1:]:
            # Pairs that differ in one option: the winner's structure, and whatever defines two systems.
            is_meant = first.start.system is not second.start.system or best[0] in (first, second)
            if first.has_run and second.has_run and is_meant and verdicts.may_isolate(compared[id(first)], compared[id(second)]):
                table.note(verdicts.isolated(compared[id(first)], compared[id(second)]))
