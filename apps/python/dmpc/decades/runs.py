"""The runs of the study: their command lines, and what is kept of each."""

import functools

from ..studies import runs
from ..studies.judging import priced_for
from . import design


def kept_in(folder, jobs, say):
    return runs.Runs(folder, jobs, _figures, functools.partial(_database_words, say), say)


def _database_words(say, name):
    scene, structure, page, transport = name.split(".")
    say(f"building {scene} for {transport}, {structure}, pages of {page}")
    light = ["--transport=paths", "--sky=1"] if transport == "paths" else []
    return [scene, *design.SCENES[scene][1], *light, f"--structure={structure}", f"--page-size={page}"]


def _figures(stats):
    return {"seconds": stats["virtual_seconds"]["total"], "film": stats["film_hash"], "run": stats["run_hash"],
            "processor": stats["seconds"]["user"] + stats["seconds"]["system"], "memory": stats["options"]["node_memory"],
            "host": _host_busy(stats), "rays": stats["rays"]["total"],
            "share": {name: round(stats["time_percent"][name], 3) for name in runs.PARTS}}


def _host_busy(stats):
    """The share of the run in which the host sends or receives; the pages that it serves belong to the systems that have it so."""
    host, total = stats["host"]["virtual_seconds"], stats["virtual_seconds"]["total"]
    return round((host["sending"] + host["receiving"]) / total, 4) if host and total else 0.0


def line_of(cell, scene, memory, system, setting, draw=None):
    """The command of a run. `setting` has the value of each searched option, or nothing for the default."""
    options = dict(setting)
    structure = options.pop("structure", None) or "extents"
    structure = "extents" if "--instances=keep" in design.SCENES[scene][1] else structure  # which other structures do not have
    page = options.pop("page-size", None)
    priced = priced_for(cell.machine, structure)
    machine = priced if draw is None else f"machines/{priced}.{draw}.json"
    side = design.RESOLUTIONS[cell.nodes]
    page = page or "1KiB"
    if scene in design.BUILT:
        transport = "paths" if cell.light.startswith("paths") else "whitted"
        subject = [f"databases/{scene}.{structure}.{page}.{transport}.pages"]
    else:
        subject = [scene, *design.SCENES[scene][1], f"--structure={structure}", f"--page-size={page}"]
    words = [word for word in design.SYSTEMS[system].words if not word.startswith("--structure=")]
    for name, value in options.items():
        if value == "on":
            words.append(f"--{name}")
        elif value not in (None, "off", "default"):
            words.append(f"--{name}={value}")
    return runs.line_of(["render", *subject, *words, *design.LIGHTS[cell.light], f"--resolution={side}x{side}", f"--nodes={cell.nodes}",
                         f"--node-memory={memory}B", "--runner=virtual", f"--machine={machine}"])
