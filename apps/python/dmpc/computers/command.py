"""The command line of these studies: their tables, what is said below them, and their plots. The first word is the study's name.

A study is a module. It has `add_options`, its own beside those here; `RUN`, the names of those that dmpc render takes but dmpc build does
not; `columns` of its table and `figures`, what it keeps of the counters of a run; `measure`, which adds rows to the table, and `JOBS`, the
runs at a time; `notes` above what the runs say; and `plots`.
"""

import argparse
import importlib

from ..studies import output, plots
from ..studies.subject import Subject
from ..studies.table import Table

_DATABASE = ("--page-size", "--record-order", "--structure", "--voxels")


def main(words):
    study = importlib.import_module(f".{words[0]}", __package__)
    options, given = _parse(study, words)
    messages = output.Messages(options)
    table = Table("", study.columns(options), messages.row)
    picture = [word for word in given if word.split("=")[0] not in (*_DATABASE, *study.RUN)]
    with output.scratch_folder() as folder:
        subject = Subject(options.scene, picture, options.machine, folder, messages, study.figures, study.JOBS)
        subject.databases["scene"] = [word for word in given if word.split("=")[0] in _DATABASE]
        options.run = [word for word in given if word.split("=")[0] in study.RUN]
        options.told = dict(word.removeprefix("--").partition("=")[::2] for word in given)
        return output.run(lambda: study.measure(options, subject, table), table, options, messages,
                          lambda: _close(study, options, subject, table),
                          lambda: plots.write(options.plots, words[0], table, study.plots(table)))


def _parse(study, words):
    """The study's own options, which dmpc has checked, and those of its runs."""
    parser = argparse.ArgumentParser(prog=f"dmpc study {words[0]}", allow_abbrev=False)
    parser.add_argument("--nodes", type=lambda text: [int(count) for count in text.split(",")])
    parser.set_defaults(machine=None)
    study.add_options(parser)
    output.add_options(parser)
    return parser.parse_known_args(words[1:])


def _close(study, options, subject, table):
    """Gives the table its title and the first notes, which runs have told, and returns the last ones."""
    table.title = f"Study {study.__name__.split('.')[-1]} of {options.scene}: {subject.text}"
    table.notes[:0] = study.notes(options, subject)
    return [*(subject.price_notes() if options.machine else ()), subject.film_note()]
