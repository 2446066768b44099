"""The study `balance`: how evenly the work of travelling rays is distributed, and the effect of the regions' positions."""

import json

from .. import program
from ..studies.plots import Plot, Series
from ..studies.runs import CORES
from ..studies.table import Column

JOBS = CORES
RUN = ("--subsample",)
_CUTTINGS = {"subsampled": ["--balance=subsampled"], "subsampled, alternating": ["--balance=subsampled", "--cuts=alternating"],
             "equal size": ["--balance=equal-size"], "scattered, 16 a node": ["--balance=scattered", "--regions=16"]}
_COLUMNS = (Column("nodes"), Column("regions"), Column("average load predicted", "%", 1), Column("average load achieved", "%", 1),
            Column("duplication", digits=3), Column("moves a ray", digits=3), Column("hops", digits=2), Column("hops at random", digits=2))
_OF_NODES = (Column("node"), Column("share predicted", "%", 2), Column("share achieved", "%", 2))


def add_options(parser):
    parser.set_defaults(nodes=[4, 8, 16, 32, 64])
    parser.add_argument("--topology", default="hypercube")
    parser.add_argument("--per-node", action="store_true")


def columns(options):
    return [*_COLUMNS, *(_OF_NODES if options.per_node else ())]


def figures(stats):
    load, moves, mapping = stats["load"], stats["travel"]["messages_per_ray"], stats["mapping"]
    hops = [mapping["mean_hops"], mapping["mean_hops_random"]] if moves else [None, None]
    return {"row": [_percent(load["average_predicted"]), _percent(load["average"]), stats["regions"]["duplication"], moves, *hops],
            "nodes": [[_percent(node["load"][kind], load[kind]) for kind in ("predicted_ps", "work_ps")] for node in stats["nodes"]]}


def _percent(part, whole=1):
    return None if part is None else 100 * part / whole if whole else 0.0


def measure(options, subject, table):
    """On a machine of that topology, whose times nobody looks at: runs on it are repeatable, and go side by side."""
    machine = {**json.loads(program.run(["machine", "ipsc2"])), "topology": options.topology}
    (subject.runs.folder / "machines" / "wired.json").write_text(json.dumps(machine))
    rows = [(nodes, name) for nodes in options.nodes for name in _CUTTINGS]
    lines = [subject.line("scene", ["--strategy=dataflow", *options.run, *_CUTTINGS[name], f"--nodes={nodes}"],
                          "machines/wired.json") for nodes, name in rows]
    for row, result in zip(rows, subject.fitting(lines)):
        table.add([*row, *result["row"], *[None] * (len(table.columns) - len(_COLUMNS))])
        for node in enumerate(result["nodes"]) if options.per_node else ():
            table.add([*row, *[None] * (len(_COLUMNS) - 2), node[0], *node[1]])


def notes(options, subject):
    step = options.told.get("subsample", "8")
    notes = ["Average load: mean over maximum of the nodes' work, which is counted operations at measured prices.",
             f"Predicted: by the picture of one pixel of every {step}x{step}.",
             "Alternating: a box is cut along one axis, its halves along the other, as the article has it; the others across their longer "
             "sides.",
             "Scattered: a lattice of regions of equal size, neighbours on different nodes.",
             "Moves: how often a ray goes on to another node.",
             "Duplication: copies of primitives in all regions over those in the database's BVH nodes.",
             f"Hops: links that a ray sent from node to node passes on a machine wired as a {options.topology}, by counted rays, with the "
             "regions where they are put and as the mean of random mappings."]
    if options.scene.lower() == "rings-3-t1":
        notes.append("Badouel, Bouatouch and Priol (1994) report for Rings3 an average load of 82.5 % with one pixel of every 8x8, and "
                     "under 20 % with regions of equal size.")
    return notes


def plots(table):
    series = [Series(f"{name}, {kind}", f"average load {kind}", {"regions": name}, colour, kind == "predicted")
              for colour, name in enumerate(_CUTTINGS) for kind in ("predicted", "achieved") if kind == "achieved" or "subsampled" in name]
    return [Plot("balance_load", "Average load of the nodes", "average load (%)", tuple(series), "nodes")]
