"""The study `frames`: what nodes that keep their contents fetch and send for a frame, beside nodes that begin with nothing."""

from dataclasses import dataclass
from statistics import mean

from .. import program
from ..studies.plots import Plot, Series
from ..studies.runs import CORES
from ..studies.subject import machine_text, name_with_links
from ..studies.table import Column, shortest
from ..studies.texts import counted

JOBS = CORES
RUN = ()
_COLUMNS = (Column("machine", is_heading=True), Column("nodes"), Column("what travels"), Column("frames"), Column("cache pages"),
            Column("share of database", "%", 1), Column("faults cold"), Column("faults warm"), Column("warm faults", "%", 1),
            Column("worst warm faults", "%", 1), Column("messages cold"), Column("messages warm"), Column("traffic cold", "bytes"),
            Column("traffic warm", "bytes"), Column("time cold", "s", 6), Column("time warm", "s", 6), Column("warm time", "%", 1))
_TREE = ["--structure=extents", "--page-size=4KiB"]  # to which questions are sent
_TRAVELS = ("page_reply", "questions", "answers")  # kinds of packets


def add_options(parser):
    parser.set_defaults(nodes=[8])
    parser.add_argument("--frames", type=int, default=6)
    parser.add_argument("--each-frame", action="store_true")
    parser.add_argument("--turntable", default="1")
    parser.add_argument("--camera-path")
    parser.add_argument("--machine", default="ipsc2")
    parser.add_argument("--machines")


def columns(options):
    return _COLUMNS


def figures(frames):
    return {"frames": [_figures(stats) for stats in frames]}


def _figures(stats):
    packets, pages = stats["packets"], stats["pages"]
    sent = stats["travel"]["bytes"] if stats["travel"] else sum(packets["by_kind"].get(kind, {"bytes": 0})["bytes"] for kind in _TRAVELS)
    faults = [node["pages"]["faults"] for node in stats["nodes"]] if pages else [0]
    return {"faults": sum(faults), "most": max(faults), "messages": packets["sent"], "traffic": sent,
            "time": stats["virtual_seconds"]["total"]}


@dataclass
class Case:
    """What travels, with caches of so many pages if it is pages, and the frames: lists of figures, of which the first is the same."""
    what: str
    strategy: str
    cache: int | None = None
    warm: list = ()
    cold: list = ()

    def lines(self, options, subject, machine, nodes):
        """Of the frames one after the other on the same nodes, and of each but the first on nodes of its own."""
        path = f"--camera-path={options.camera_path}" if options.camera_path else f"--turntable={options.turntable}"
        cache = [] if self.cache is None else [f"--cache-pages={self.cache}"]
        words = [f"--strategy={self.strategy}", *cache, f"--nodes={nodes}", path, "--no-skip=equal-frames"]
        ranges = [f"1..{options.frames}", *(f"{frame}..{frame}" for frame in range(2, options.frames + 1))]
        return [subject.line("tree" if self.strategy == "forest" else "scene", [*words, f"--frames={each}"], machine) for each in ranges]

    def take(self, results):
        self.warm, *cold = (result["frames"] for result in results)
        self.cold = [self.warm[0], *(frames[0] for frames in cold)]

    def row(self, begin, end, pages):
        """Means over these frames."""
        def both(name):
            return mean(each[name] for each in self.cold[begin:end]), mean(each[name] for each in self.warm[begin:end])

        faults = [None] * 6
        if self.strategy == "svm":
            worst = max(_percent(cold["faults"], warm["faults"]) for cold, warm in zip(self.cold[begin:end], self.warm[begin:end]))
            faults = [self.cache, _percent(pages, self.cache), *map(float, both("faults")), _percent(*both("faults")), worst]
        return [*faults, *map(float, (*both("messages"), *both("traffic"))), *both("time"), _percent(*both("time"))]


def _percent(whole, part):
    return 100 * part / whole if whole else 0.0


def measure(options, subject, table):
    if options.scene.endswith(".pages"):
        raise program.UsageError(f"{options.scene}: study frames builds databases of its own: expected a scene")
    subject.databases["tree"] = _TREE
    pages = subject.database("scene")["pages"]
    for machine in options.machines.split(",") if options.machines else [options.machine]:
        for nodes in options.nodes:
            _measure_on(options, subject, table, machine, nodes, pages)


def _measure_on(options, subject, table, machine, nodes, pages):
    kept = Case("pages, all kept", "svm", pages)
    kept.take(subject.fitting(kept.lines(options, subject, machine, nodes)))
    working_set = max(1, *(frame["most"] for frame in kept.cold))
    cases = [Case("pages, caches of a quarter", "svm", -(-25 * pages // 100)),
             Case("pages, caches of two fifths", "svm", -(-40 * pages // 100)),
             Case("pages, caches of the working set", "svm", working_set), kept, Case("questions", "forest"), Case("rays", "dataflow")]
    others = [case for case in cases if case is not kept]
    results = subject.fitting([line for case in others for line in case.lines(options, subject, machine, nodes)])
    name = name_with_links(list(subject.machines.values())[-1][0])
    for case in cases:
        if case is not kept:
            case.take([next(results) for _ in range(options.frames)])
        single = range(options.frames) if options.each_frame else ()
        for begin, end, frames in (*((at, at + 1, str(at + 1)) for at in single), (1, options.frames, _means(options))):
            table.add([name, nodes, case.what, frames, *case.row(begin, end, pages)])


def _means(options):
    return f"2 to {options.frames}"


def notes(options, subject):
    path = f"the camera moves through the keyframes of {options.camera_path}" if options.camera_path else \
        f"turned by {shortest(float(options.turntable))} degrees a frame"
    return [*(f"{machine_text(machine, digest)}." for digest, (machine, _) in subject.machines.items()),
            f"{counted(options.frames, 'frame')}, {path}; means over frames {_means(options)}. Pages and questions: 16 pixels in flight.",
            "Cold: by nodes that begin with the frame; warm: by nodes that have rendered those before it, and keep caches, or regions. Of "
            "rays cold ones have regions by the frame's own subsampled picture, warm ones those of frame 1. Questions leave nothing "
            "behind.",
            "Caches, lru, each of so many pages; the working set is what the node that needs most fetches of a cold frame. Where all is "
            "kept, a warm frame's faults are pages that their node has never had. Worst: of the frame for which the share is largest.",
            "Messages: packets of every kind. Traffic: pages sent, packets with questions and answers, or packets with rays.",
            "Each frame's film is the same in all rows, warm and cold; below stands that of frame 1."]


def plots(table):
    faults, times = [], []
    for name, nodes in dict.fromkeys((row[0], row[1]) for row in table.rows):
        frames = next(row[3] for row in table.rows if " to " in row[3])
        who, where = f"{nodes} nodes of {name}", {"machine": name, "nodes": nodes, "frames": frames}
        faults += [Series(f"{kind}, {who}", f"faults {kind}", where, len(faults) + at) for at, kind in enumerate(("cold", "warm"))]
        times.append(Series(f"warm, {who}", "warm time", where, len(times)))
    return [Plot("frames_faults", "Faults of a frame", "faults", tuple(faults), "cache pages", log_x=0),
            Plot("frames_time", "Virtual time of a warm frame", "of a cold frame's (%)", tuple(times), places=("what travels",))]
