"""The command line of dmpc study systems: its table, and what its notes say."""

import argparse
import functools
import os
import pathlib
import tempfile

from .. import program
from ..studies import output, plots
from ..studies.table import Table
from . import described, equal, memory_rule, rows, setups
from .subject import Subject

_TABLES = ("described", "equal")


def main(words):
    options, picture = _parse(words)
    messages = output.Messages(options)
    table = Table("", rows.COLUMNS, messages.row)
    draw = functools.partial(_draw, table, options.plots)
    with tempfile.TemporaryDirectory(prefix="dmpc-study-") as folder:
        subject = Subject(options.scene, _whole_picture(picture), options.machine, folder,
                          len(os.sched_getaffinity(0)), messages)
        return output.run(lambda: _measure(options, subject, table), table, options, messages,
                          lambda: _closing_notes(subject), draw if options.plots else None)


def _parse(words):
    """The study's own options, which dmpc has checked, and those of the picture."""
    parser = argparse.ArgumentParser(prog="dmpc study systems", allow_abbrev=False)
    parser.add_argument("--nodes", default="64")
    parser.add_argument("--systems", action="append")
    parser.add_argument("--tables", action="append")
    parser.add_argument("--node-memory", default="rays")
    parser.add_argument("--search", action="store_true")
    parser.add_argument("--draws", type=int, default=100)
    parser.add_argument("--machine", default="ipsc2")
    parser.add_argument("--plots", type=pathlib.Path)
    output.add_options(parser)
    parser.add_argument("scene")
    return parser.parse_known_args(words)


def _whole_picture(picture):
    """The words of dmpc render that make its picture the study's: a file's is as that of other scenes."""
    given = {word.split("=")[0] for word in picture}
    transport = [] if "--transport" in given else ["--transport=whitted"]
    return [*picture, *transport, *([] if given & {"--samples", "--quality", "--error"} else ["--samples=1"])]


def _words(given):
    """Of an option that takes several, and may be given several times: each once."""
    return list(dict.fromkeys(word for text in given or () for word in text.split(",")))


def _measure(options, subject, table):
    node_counts = [int(count) for count in options.nodes.split(",")]
    rules = memory_rule.parse(options.node_memory)
    if options.scene.endswith(".pages"):
        raise program.UsageError(f"{options.scene}: study systems builds databases of its own: expected a scene")
    if options.plots:
        plots.check()
    names = _words(options.systems) or list(setups.systems())
    table.title = f"Study systems of {options.scene}: {subject.text}"
    table.notes += _notes(options, names, subject)
    for name in _words(options.tables) or _TABLES:
        if name == "described":
            for nodes in node_counts:
                described.add_to(table, subject, names, nodes)
        else:
            equal.add_to(table, subject, names, node_counts, rules, options.draws, options.search)


def _notes(options, names, subject):
    systems = [system for system in setups.systems().values() if system.name in names]
    return [
        f"{subject.machine_text}. Voxels on ipsc2 have the prices of ipsc2-1994, which were fitted to voxels.",
        *(f"{system.name}: {system.meaning}. Its structure: {system.had_what} ({system.had})." for system in systems),
        "Table described: each system as it had it when it was described, or as dmpc has it nearest: its structure (voxels by the "
        "article's rule, or a tree), one pixel in flight, cuts in alternating directions, no backpressure, as much memory as it needs, "
        "caches of the whole database. Its verdicts are those that authors drew.",
        "Table equal: equal memory, and each system on each structure that it can walk at the best of one search: from its defaults, one "
        "option after the other, each value with the others at their best so far, as far as the option is the system's and does not define "
        f"it: {setups.SEARCH}. Free beforehand: what a system finds out before the run, in no virtual time.",
        "Best against best: the fastest row beside the fastest of each other strategy. Isolated: rows that differ in one option. Times "
        "within 1 % are a tie.",
        f"Draws: {options.draws} (seed 1994), each price multiplied by a factor from 1/f to f, uniform in its logarithm, f = 1.1, 1.3 or 2 "
        "by the certainty of its source (high, medium, low or none). A row that is ahead in fewer than 80 of 100 is undecided.",
        "Parts of the nodes' time add up to 100 %; data_wait is for pages, rays or answers. Host busy: of the run. Messages and bytes of "
        "all kinds."]


def _closing_notes(subject):
    film = f"Film of every run, {subject.count} in all: {subject.film}." if subject.film else "No picture was rendered."
    return [*subject.price_notes(), film]


def _draw(table, folder):
    """The table as data, and the times of each of its parts as bars."""
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "systems.csv").write_text(table.text("csv"))
    found = table.named_rows()
    for name in dict.fromkeys(row["table"] for row in found):
        series = {}
        for row in found:
            if row["table"] == name and row["virtual time"] is not None:
                place = f"{row['system']} {row['structure']}"
                series.setdefault(f"memory {row['memory']}, {row['nodes']} nodes", {})[place] = row["virtual time"]
        plots.bars(folder / f"systems_time_{name}.svg", f"Virtual time of the systems, {name}", "virtual time (s)", series)
