"""The command line of `dmpc bench error`. dmpc has checked it, and made the references of all scenes."""

import argparse
import os
import re
import tempfile

from ..studies import output, plots
from .findings import findings_of, summary_of
from .measuring import Bench, Reference, Result
from .points import KNOBS, Setting
from .table import ErrorTable, plots_of

_EXPLAINED = "Errors are RMSEs without the reference's own, whose square is subtracted, with an interval of 95 % by how much 64 groups " \
             "of pixels differ; an error below the reference's own is not told, drawn or compared."
_TIMED = "Seconds are processor time. Shares at equal error are interpolated in logarithms; their intervals have the groups' differences " \
         "and the rounds' least and most."


def main(words):
    options, render = _parse(words)
    messages = output.Messages(options)
    are_by_paths = options.bounces is not None
    base = Setting(options.samples, depth=options.depth, bounces=options.bounces, emitters=options.emitters)
    table, results = ErrorTable(options.title, are_by_paths), []

    def measure():
        try:
            for scene, figures in zip(options.scene, options.reference):
                results.append(result := Result(scene, Reference(figures, options.reference_samples), base))
                shown = ErrorTable("", are_by_paths, messages.row)
                with tempfile.TemporaryDirectory(prefix="dmpc-error-") as folder:
                    Bench(result, options, render, folder, messages, lambda one: shown.add_first(result, one)).measure()
        finally:
            for result in results:
                table.add_results(result)
            table.summary = summary_of(results)

    def notes():
        load = f"Load of the machine, whose cores are {os.cpu_count()}: {options.load} before, {os.getloadavg()[0]:.1f} after."
        return [*_explanations(are_by_paths), *(text for result in results for text in findings_of(result)), load]

    def draw():
        for result in results:
            own = ErrorTable(result.scene, are_by_paths)
            own.add_results(result)
            name = "error_" + re.sub("[^0-9A-Za-z]", "-", result.scene)
            plots.write(options.plots, name, own, plots_of(result, name))

    with output.scratch_folder():
        return output.run(measure, table, options, messages, notes, draw)


def _explanations(are_by_paths):
    return ["RMSEs are against the converged picture in " +
            ("the renderer's own arithmetic, with other samples than all rows." if are_by_paths else "double precision."),
            _EXPLAINED, _TIMED,
            "Fewer bounces make the picture darker, an error that samples do not reduce; BSDF sampling alone causes no such error."
            if are_by_paths else
            "Deterministic errors are those of the knob alone: against the picture with the same samples and the knob at its exact "
            "position; for arithmetic, against the same samples in double precision.",
            "Adaptive sampling is asked for no error below the reference's own, or that uniform samples do not reach."]


def _parse(words):
    """The options, and the words that all renders have."""
    parser = argparse.ArgumentParser(prog="dmpc bench error", allow_abbrev=False)
    parser.add_argument("--knobs", type=lambda text: {knob for knob in KNOBS if knob in text.split(",")})
    parser.add_argument("--quick", action="store_true")
    parser.add_argument("--reference", action="append")
    for name in ("samples", "repeat", "reference-samples", "depth", "bounces", "emitters"):
        parser.add_argument("--" + name, type=int)
    for name in ("title", "load"):
        parser.add_argument("--" + name)
    output.add_options(parser, "+")
    return parser.parse_known_args(words)
