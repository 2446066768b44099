"""The command line of dmpc study sweep, which dmpc has checked with every combination: renders, and a table of their figures."""

import argparse
import itertools
import os
import pathlib

from .. import program
from ..studies import output, page, plots
from ..studies.runs import CORES, reason_of, side_by_side
from ..studies.subject import price_notes
from ..studies.table import Table
from . import columns, figures
from .kept import Kept
from .variation import Variation

_NO_DATABASE = "-"


class Run:
    """What dmpc has planned: `varied` in words, the `line` of dmpc render, and the `values` of the variations. Once it is made, it has
    `figures` of each column and the note on its machine's `prices`, or a `misfit`; it `is_kept` if an earlier sweep has made it."""

    def __init__(self, plan, values):
        begin = plan.index("render", 2)
        self.varied, self.database, *self.database_words = plan[:begin]
        self.line, self.values = plan[begin:], values
        self.figures, self.prices, self.misfit, self.is_kept = None, [], None, False

    def take(self, stats, names):
        """Raises a KeyError, TypeError or ValueError for counters that do not have all that they should."""
        self.figures = {name: figures.value(stats, name) for name in names}
        self.prices = price_notes(stats["machine"], [stats["options"]["structure"]]) if stats["runner"] == "virtual" else []


class Sweep:
    """All runs of a line, as a table."""

    def __init__(self, options, messages):
        self._options, self._messages = options, messages
        schema, *plans = pathlib.Path(options.plan).read_bytes().split(b"\0\0")
        self.variations = [Variation(text) for text in options.vary]
        values = itertools.product(*(variation.cells for variation in self.variations))
        self.runs = [Run([os.fsdecode(word) for word in plan.split(b"\0")], each) for plan, each in zip(plans, values)]
        self._known, self.table, self.done = figures.known(schema), Table(options.title, (), messages.row), []

    def measure(self):
        """Adds the rows as their runs end. Raises NothingFits once all rows are there, if none has figures."""
        try:
            self._most = dict.fromkeys(columns.names(self._options, self.variations, self._known), 0)
        except program.UsageError as error:
            raise program.UsageError(f"{error}\nTry: dmpc study sweep --help") from error
        kept = Kept(self._options.runs, self._options.source, self._messages.say) if self._options.runs else None
        for run in self.runs if kept else ():
            self._find(run, kept)
        jobs = 1 if self._options.timed else CORES
        for run in side_by_side(lambda run: self._made(run, kept), self.runs, jobs, self._messages.progress):
            self._add(run)
        if all(run.misfit for run in self.runs):
            raise output.NothingFits(self.runs[0].misfit)

    def _find(self, run, kept):
        try:
            run.take(kept.find(run.line[1:]), self._most)
            run.is_kept = True
        except (KeyError, TypeError, ValueError, AttributeError):
            run.figures = None
            if run.database != _NO_DATABASE:
                kept.provide(run.database, run.database_words, run.line[1])

    def _made(self, run, kept):
        if run.is_kept:
            return run
        scene = kept and kept.database(run.database) or run.line[1]
        try:
            stats = program.counters(["render", str(scene), *run.line[2:], "--quiet"])
        except program.CapacityError as error:
            run.misfit = reason_of(error)
            return run
        except program.InputError as error:
            raise program.InputError(f"the run with {run.varied} failed: {error}") from error
        run.take(stats, self._most)
        if kept:
            kept.keep(run.line[1:], stats)
        return run

    def _add(self, run):
        self.done.append(run)
        cells = [run.figures[name] if run.figures else None for name in self._most]
        for name, cell in zip(self._most, cells):
            self._most[name] = max(self._most[name], abs(cell) if isinstance(cell, float) else 0)
        self.table.columns = columns.of(self.variations, self._most)
        self.table.add([*run.values, *cells])

    def plots(self):
        return list(columns.plots(self._options.scene, self.variations, [name for name in self._most if self._known[name]]))

    def notes(self):
        """Below the table."""
        of_prices = sorted({note for run in self.done for note in run.prices})
        count = sum(run.is_kept for run in self.done)
        runs = f"{len(self.done):,} run{'' if len(self.done) == 1 else 's'}"
        return [*(f"No room with {run.varied}: {run.misfit}." for run in self.done if run.misfit), *of_prices,
                *([f"{count:,} of {runs} kept from before."] if count else [])]


def main(words):
    options = _parse(words)
    messages = output.Messages(options)
    with output.scratch_folder():
        sweep = Sweep(options, messages)
        status = output.run(sweep.measure, sweep.table, options, messages, sweep.notes,
                            lambda: plots.write(options.plots, "sweep", sweep.table, sweep.plots()))
        if options.report and sweep.done:
            status = output.write(page.of_table(sweep.table, sweep.plots()), options.report, messages, "--report") or status
    return status


def _parse(words):
    parser = argparse.ArgumentParser(prog="dmpc study sweep", allow_abbrev=False)
    for name in ("plan", "source", "usual", "title", "columns", "runs", "report"):
        parser.add_argument("--" + name)
    parser.add_argument("--vary", action="append")
    parser.add_argument("--timed", action="store_true")
    output.add_options(parser)
    return parser.parse_args(words)
