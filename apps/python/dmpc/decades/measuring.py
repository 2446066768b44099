"""This computer as a machine file: round trips, bandwidth and the price of computing, measured by renders over MPI on the loopback, each with
its spread; and cells that are predicted by these prices and then timed."""

import json
import os
import pathlib
import shutil
import statistics
import subprocess
import sys
import tempfile
from dataclasses import dataclass

from .. import program
from ..studies.runs import CORES

RANKS = 2
REPEATS = 5
_MPI = {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}
_COMMON = ("--nodes=2", "--in-flight=1", "--work-item=0", "--structure=extents")
# The four runs that prices are fitted to: few and many page faults, with short and long pages.
_FITTED = [("rings-4-t1", "--strategy=svm", f"--page-size={page}", f"--cache-pages={cache}", "--resolution=48x48", *_COMMON)
           for page, caches in (("1KiB", (8, 4000)), ("16KiB", (4, 4000))) for cache in caches]
# Those that are predicted.
HELD = {
    "pages, another scene": ("mount-6-t6", "--strategy=svm", "--page-size=4KiB", "--cache-pages=8", "--resolution=64x64", *_COMMON),
    "questions": ("rings-4-t1", "--strategy=forest", "--nodes=2", "--in-flight=16", "--resolution=64x64"),
    "rays": ("rings-4-t1", "--strategy=dataflow", "--nodes=2", "--resolution=64x64"),
}


@dataclass
class Sample:
    seconds: float  # of the render, without its start
    idle: float  # of a node, in the mean
    processor: float  # of all ranks
    faults: float  # of a node, in the mean


def over_mpi(words):
    """Renders by two processes over TCP on this computer. Raises a program.Error if there is no mpirun or the render fails."""
    if shutil.which("mpirun") is None:
        raise program.Error("there is no mpirun: apt-get install openmpi-bin, and the package dmpc-mpi")
    with tempfile.TemporaryDirectory() as scratch:
        stats = os.path.join(scratch, "stats.json")
        done = subprocess.run(
            ["mpirun", "-n", str(RANKS), "--oversubscribe", "--bind-to", "none", "--mca", "btl", "tcp,self", "--mca", "btl_tcp_if_include", "lo",
             program.path(), "render", *words, "--runner=mpi", "--quiet", f"--stats={stats}", "-o", os.path.join(scratch, "film.png")],
            env={**os.environ, **_MPI}, capture_output=True, text=True, stdin=subprocess.DEVNULL)
        if done.returncode != 0:
            raise program.Error(done.stderr.strip())
        found = json.loads(pathlib.Path(stats).read_text())
    nodes = found["nodes"]
    return Sample(found["seconds"]["render"], statistics.mean(node["seconds"]["idle"] for node in nodes),
                  found["seconds"]["render_user"] + found["seconds"]["render_system"], (found["pages"] or {}).get("faults", 0) / len(nodes))


def _computing():
    """How many times as long as on the core that prices were measured on: real over virtual seconds of single nodes."""
    factors = []
    for scene in ("rings-4-t1", "mount-6-t6", "tetra-9"):
        words = [scene, "--strategy=replicated", "--structure=extents", "--nodes=1", "--resolution=192x192", "--no-skip=bundles"]
        modelled = program.counters(["render", *words, "--runner=virtual", "--machine=hdr"])["virtual_seconds"]["computing"]
        factors += [program.counters(["render", *words])["nodes"][0]["seconds"]["busy"] / modelled for _ in range(REPEATS)]
    return factors


def _round_trips():
    """Seconds of a page's round trip beyond its bytes, seconds a byte, and processor seconds of one end of a message, in each repetition."""
    found = []
    for _ in range(REPEATS):
        few_hits, hits, long_few, long_hits = (over_mpi(words) for words in _FITTED)
        short = (few_hits.idle - hits.idle) / (few_hits.faults - hits.faults)
        long = (long_few.idle - long_hits.idle) / (long_few.faults - long_hits.faults)
        byte = max((long - short) / (15 * 1024), 1e-12)
        ends = (few_hits.processor - hits.processor) / (4 * 2 * (few_hits.faults - hits.faults))
        found.append((max(short - 1024 * byte, 1e-9), byte, max(ends, 1e-9)))
    return list(zip(*found))


def _said(values, unit, scale):
    """The median with its quartiles, and how certain that is."""
    low, middle, high = (scale * each for each in statistics.quantiles(values, n=4))
    doubt = "high" if high < 1.1 * low else "medium" if high < 1.3 * low else "low"
    return f"measured on this computer: {middle:.4g} {unit}, quartiles {low:.4g} and {high:.4g}, {doubt}"


def measured(form="hdr"):
    """A machine file as a dictionary: the network's form and the proportions of operations from the named machine."""
    machine = json.loads(program.run(["machine", form]))
    factors = _computing()
    trips, a_byte, ends = _round_trips()
    factor, trip, end = statistics.median(factors), statistics.median(trips), statistics.median(ends)
    end = min(end, trip / 6)  # the four ends of a round trip leave some of it to the network
    message = {"send_ns": round(1e9 * end), "latency_ns": max(round(1e9 * (trip / 2 - 2 * end)), 1), "receive_ns": round(1e9 * end),
               "byte_ps": max(round(1e12 * statistics.median(a_byte)), 1)}
    machine.update(name="measured", short_message=message, long_message=message, hop_ns=1, service_ns=1)
    machine["operation_ps"] = {name: round(factor * ps) for name, ps in machine["operation_ps"].items()}
    machine["sources"].update(
        long_message=f"a page's round trip without its bytes: {_said(trips, 'us', 1e6)}; its bytes: {_said(a_byte, 'ns a byte', 1e9)}; each "
                     f"processor: {_said(ends, 'us', 1e6)}",
        hop_ns="in the latency: assumed, low", service_ns="in the round trip: assumed, low",
        operation_ps=f"times those of the core on which prices were measured: {_said(factors, 'times', 1)}",
        cached_lookup="as the other operations: assumed, low")
    return machine


def hold(folder):
    """Times the held cells, predicts them by a machine file that it measures, and keeps both in the folder."""
    path = pathlib.Path(folder) / "measured.json"
    path.write_text(json.dumps(measured(), indent=2))
    rows = []
    for name, words in HELD.items():
        seconds = sorted(over_mpi(words).seconds for _ in range(REPEATS))
        predicted = program.counters(["render", *words, "--runner=virtual", f"--machine={path}"])["virtual_seconds"]["total"]
        rows.append({"cell": name, "line": " ".join(words), "predicted": predicted, "timed": statistics.median(seconds),
                     "least": seconds[0], "most": seconds[-1]})
    (pathlib.Path(folder) / "reality.json").write_text(json.dumps({"processors": CORES, "rows": rows}, indent=1))
    return rows


def main(words):
    try:
        print(json.dumps(measured(words[0]), indent=2))
    except program.Error as error:
        print(f"dmpc: {error}", file=sys.stderr)
        return 1
    return 0
