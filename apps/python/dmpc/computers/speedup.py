"""The study `speedup`: how much faster a modelled machine gets with more nodes, and where the remaining time goes."""

from ..studies.output import NothingFits
from ..studies.plots import Plot, Series, of_parts
from ..studies.runs import CORES, PARTS
from ..studies.table import Column
from ..studies.texts import counted

JOBS = CORES
RUN = tuple("--" + name for name in (
    "strategy", "node-memory", "cache-pages", "homes", "resident", "replacement", "in-flight", "bundles", "work-item", "work-donor",
    "pixels", "workers", "balance", "cuts", "regions", "subsample", "ray-batch", "ray-credits", "ray-slots", "ray-queue", "tested-objects",
    "no-backpressure"))
_COLUMNS = (Column("nodes"), Column("virtual time", "s", 3), Column("speedup", digits=2), Column("efficiency", "%", 1),
            *(Column(part, "%", 1) for part in PARTS), Column("link wait", "s", 3), Column("node memory", "bytes"), Column("run hash"))


def add_options(parser):
    parser.set_defaults(nodes=[1, 2, 4, 8, 16, 32, 64])
    parser.add_argument("--machine", default="ipsc2")


def columns(options):
    return _COLUMNS


def figures(stats):
    return {"seconds": stats["virtual_seconds"]["total"], "share": [stats["time_percent"][part] for part in PARTS],
            "rest": [stats["links"]["wait"], stats["options"]["node_memory"], stats["run_hash"]]}


def measure(options, subject, table):
    """A row for each number of nodes, without figures where the scene does not fit. Raises NothingFits once all rows are there, if none has
    any."""
    misfits, first = [], None
    if options.told.get("strategy") == "forest":
        usual = {"structure": "extents", "page-size": "4KiB"}
        subject.databases["scene"] += [f"--{name}={value}" for name, value in usual.items() if name not in options.told]
    lines = [subject.line("scene", [*options.run, f"--nodes={nodes}"], options.machine) for nodes in options.nodes]
    for nodes, result in zip(options.nodes, subject.each(lines)):
        table.notes += [f"{counted(nodes, 'node')}: {note}." for note in result.get("notes", ())]
        if "misfit" in result:
            misfits.append(result["misfit"])
            table.note(f"{counted(nodes, 'node')}: the scene does not fit. {result['misfit']}.")
            table.add([nodes, *[None] * (len(_COLUMNS) - 1)])
            continue
        seconds = result["seconds"]
        first = seconds * nodes if first is None else first
        efficiency = first / (seconds * nodes) if seconds else 1.0
        table.add([nodes, seconds, efficiency * nodes, 100 * efficiency, *result["share"], *result["rest"]])
    if len(misfits) == len(options.nodes):
        raise NothingFits(misfits[0])


def notes(options, subject):
    strategy, memory = options.told.get("strategy", "svm"), options.told.get("node-memory", "auto")
    policy = subject.asked["options"]["replacement"] or "lru"
    travels = _rays(options.told) if strategy == "dataflow" else _pages(options.told, strategy, memory, policy)
    room = "as much as it needs" if memory == "auto" else f"{memory} a node"
    return [f"{subject.machine_text}, strategy {strategy}, memory {room}, {travels}.",
            "Speedup and efficiency: against the first row with figures, in node-seconds, as if its own efficiency were 100 %.",
            "Parts of the nodes' time, summed over them: they add up to 100 %. data_wait is for pages or rays, starvation for pixels of "
            "other nodes, token_wait for the token that finds out whether all rays have ended, service_busy and service_idle serve page "
            "requests while there is something else to do and while there is not.",
            "Link wait: that messages stood before links that others held, summed. Node memory: of the fullest node."]


def _pages(run, strategy, memory, policy):
    cache = counted(int(run["cache-pages"]), "page") if "cache-pages" in run else \
        "a quarter of the database" if memory == "auto" else "what the memory leaves"
    in_flight = int(run.get("in-flight", 1 if strategy == "replicated" else 16))
    side = run.get("work-item", "4" if "bundles" in run and in_flight >= 16 else "3")
    return (f"cache of {cache} ({policy}), " if strategy == "svm" else "") + \
        f"{counted(in_flight, 'pixel')} in flight, {'no work given away' if side == '0' else f'work items of {side}x{side}'}"


def _rays(run):
    kinds = {"equal-size": "of equal size", "scattered": "scattered", "moving": "that move"}
    regions = kinds.get(run.get("balance"), "by the subsampled picture")
    return f"regions {regions}{' and alternating cuts' if run.get('cuts') == 'alternating' else ''}, mapped onto the machine"


def plots(table):
    return [Plot("speedup", "Speedup", "speedup", (Series("speedup", "speedup"),), "nodes", is_log=True),
            Plot("speedup_efficiency", "Efficiency", "efficiency (%)", (Series("efficiency", "efficiency"),), "nodes"),
            of_parts("speedup_losses", "Where the nodes' time goes", ("nodes",))]
