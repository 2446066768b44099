"""The command line of dmpc study systems: its table, and what its notes say."""

import argparse

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
    with output.scratch_folder() as folder:
        subject = Subject(options.scene, picture, options.machine, folder, messages)
        return output.run(lambda: _measure(options, subject, table), table, options, messages,
                          lambda: [*subject.price_notes(), subject.film_note()],
                          lambda: plots.write(options.plots, "systems", table, _plots(table)))


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
    output.add_options(parser)
    return parser.parse_known_args(words)


def _words(given):
    """Of an option that takes several, and may be given several times: each once."""
    return list(dict.fromkeys(word for text in given or () for word in text.split(",")))


def _measure(options, subject, table):
    node_counts = [int(count) for count in options.nodes.split(",")]
    rules = memory_rule.parse(options.node_memory)
    if options.scene.endswith(".pages"):
        raise program.UsageError(f"{options.scene}: study systems builds databases of its own: expected a scene")
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


def _plots(table):
    """For each of its parts the times as bars."""
    for name in dict.fromkeys(row["table"] for row in table.named_rows()):
        places = dict.fromkeys((row["memory"], row["nodes"]) for row in table.named_rows() if row["table"] == name)
        series = [plots.Series(f"memory {memory}, {nodes} nodes", "virtual time", {"table": name, "memory": memory, "nodes": nodes}, colour)
                  for colour, (memory, nodes) in enumerate(places)]
        yield plots.Plot(f"systems_time_{name}", f"Virtual time of the systems, {name}", "virtual time (s)", tuple(series),
                         places=("system", "structure"), is_log=True)
