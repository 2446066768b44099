"""The study `traffic`: the traffic of travelling rays beside that of travelling pages."""

from ..studies.plots import Plot, Series
from ..studies.table import Column

JOBS = 1  # since each run has threads
RUN = ()
_COLUMNS = (Column("nodes"), Column("hops a ray", digits=3), Column("rays sent"), Column("ray packets"), Column("ray traffic", "bytes"),
            Column("packet fill", "%", 1), Column("overflow", "%", 2), Column("dataflow memory", "bytes"), Column("average load", "%", 1),
            Column("average load equal size", "%", 1), Column("faults"), Column("page traffic", "bytes"), Column("svm memory", "bytes"))
_RAYS = ("rays", "overflow", "forwarded")  # kinds of packets


def add_options(parser):
    parser.set_defaults(nodes=[1, 2, 4, 8, 16, 32, 64])


def columns(options):
    return _COLUMNS


def figures(stats):
    travel, packets = stats["travel"], stats["packets"]["by_kind"]
    memory = max(node["memory"]["used"]["total"] for node in stats["nodes"])
    if travel is None:
        return {"row": [stats["pages"]["faults"], packets["page_reply"]["bytes"], memory]}
    sent = travel["rays_out"]["total"]
    shares = [100 * travel["mean_fill"], 100 * travel["overflow"]["share"]] if sent else [None, None]
    return {"row": [travel["messages_per_ray"], sent, sum(packets[kind]["packets"] for kind in _RAYS), travel["bytes"], *shares, memory,
                    100 * stats["load"]["average"]]}


def measure(options, subject, table):
    """Rays are traced one by one: which go in a bundle depends on the schedule, and the work on that."""
    rays = ["--strategy=dataflow", "--no-skip=bundles"]
    ways = ([*rays, "--balance=subsampled"], [*rays, "--balance=equal-size"], ["--strategy=svm"])
    results = subject.fitting([subject.line("scene", [*way, f"--nodes={nodes}"]) for nodes in options.nodes for way in ways])
    for nodes, by_rays, of_equal_size, by_pages in zip(options.nodes, results, results, results):
        table.add([nodes, *by_rays["row"], of_equal_size["row"][-1], *by_pages["row"]])


def notes(options, subject):
    return ["Rays travel (dataflow, regions by the subsampled picture): hops a ray are rays sent over rays shot; packets and their bytes "
            "count every packet with rays, those by way of the host twice; overflow is the share of the rays sent that took that way.",
            "Average load: mean over maximum of the nodes' work, with regions by the subsampled picture and of equal size.",
            "Pages travel (svm, cache of a quarter of the database): faults, and the bytes of the pages sent for them.",
            "Memory: high-water mark of the fullest node."]


def plots(table):
    def both(name, title, rays, pages):
        return Plot(name, title, "bytes", (Series("rays travel", rays, colour=1), Series("pages travel", pages)), "nodes", is_log=True)

    return [both("traffic_bytes", "Bytes that travel", "ray traffic", "page traffic"),
            both("traffic_memory", "Memory of the fullest node", "dataflow memory", "svm memory")]
