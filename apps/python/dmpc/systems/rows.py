"""The rows of the study's table, and how verdicts see them."""

from ..studies.runs import PARTS
from ..studies.table import Column
from . import verdicts

_OPTIONS = ("page-size", "in-flight", "work-donor", "resident", "backpressure", "ray-batch")
COLUMNS = (Column("table", is_heading=True), Column("memory"), Column("nodes"), Column("system"), Column("structure"),
           Column("node memory", "bytes"), Column("memory over database", "%", 1), Column("page size"), Column("in flight"),
           Column("work donor"), Column("resident", "%"), Column("backpressure"), Column("ray batch"), Column("free beforehand"),
           Column("draws ahead"), Column("virtual time", "s", 6), *(Column(part, "%", 1) for part in PARTS), Column("host busy", "%", 1),
           Column("messages a ray", digits=3), Column("bytes a ray", "bytes", 1))


def row_of(subject, table, memory, setup, result, ahead=None):
    """`ahead`: the draws in which it is the fastest. Without figures if there was no room."""
    has_run = "seconds" in result
    texts = setup.texts(result)
    size = setup.memory if setup.memory is not None else result.get("memory")
    share = None if size is None else 100 * size / subject.database(setup.database)["bytes"]
    figures = [result["seconds"], *(result["share"][part] for part in PARTS), 100 * result["host"], result["messages"],
               result["bytes"]] if has_run else [None] * (len(PARTS) + 4)
    return [table, memory, setup.nodes, setup.system.name, setup.database.structure, size, share, *(texts.get(name) for name in _OPTIONS),
            setup.free_beforehand, ahead, *figures]


def compared(subject, setup, result, search=""):
    return verdicts.Row(setup.name, (subject.scene, subject.machine_name, result["films"][0], setup.nodes, setup.memory),
                        {**setup.texts(result), "prices": subject.prices_of(setup.database.structure)}, result["seconds"], search)
