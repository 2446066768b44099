"""Runs of dmpc on modelled machines, each kept by its command line: what was run once is never run again."""

import concurrent.futures
import json
import pathlib
import re
import threading

from .. import program
from . import design

_COLUMNS = ("computing", "data_wait", "starvation", "token_wait", "credit_wait", "film_wait", "other_wait", "service_busy", "service_idle",
            "messages", "idle_at_end")


class Runs:
    """The folder of a study: `runs.jsonl` has a line for each run, written when it ends."""

    def __init__(self, folder, jobs, say):
        self.folder, self.jobs, self.say = pathlib.Path(folder).absolute(), jobs, say
        self._kept, self._lock = {}, threading.Lock()
        for name in ("machines", "databases"):
            (self.folder / name).mkdir(parents=True, exist_ok=True)
        if self._file.exists():
            for line in self._file.read_text().splitlines():
                try:
                    one = json.loads(line)
                except json.JSONDecodeError:
                    continue  # the line that was being written when the study was stopped
                self._kept[one["line"]] = one

    @property
    def _file(self):
        return self.folder / "runs.jsonl"

    def __len__(self):
        return len(self._kept)

    def all(self):
        return self._kept.values()

    def kept(self, line):
        return self._kept.get(line)

    def get(self, lines):
        """The results of these command lines, in their order; those that are missing are run side by side."""
        missing = [line for line in dict.fromkeys(lines) if line not in self._kept]
        if missing:
            for line in missing:
                self._prepare(line)
            with concurrent.futures.ThreadPoolExecutor(self.jobs) as pool:
                done = [pool.submit(self._run, line) for line in missing]
                try:
                    for one in concurrent.futures.as_completed(done):
                        one.result()
                except BaseException:
                    pool.shutdown(cancel_futures=True)
                    raise
        return [self._kept[line] for line in lines]

    def _prepare(self, line):
        """Makes what several runs share: drawn machines, databases."""
        drawn = re.search(r"--machine=machines/(\S+)\.(\d+)\.json", line)
        if drawn:
            self._write(f"machines/{drawn[1]}.{drawn[2]}.json", lambda: program.run(["machine", drawn[1], f"--draw={drawn[2]}"]))
        database = re.match(r"render (databases/(\S+)\.(\S+)\.(\S+)\.(\S+)\.pages) ", line)
        if database and not (self.folder / database[1]).exists():
            _, scene, structure, page, transport = database.groups()
            self.say(f"building {scene} for {transport}, {structure}, pages of {page}")
            light = ["--transport=paths", "--sky=1"] if transport == "paths" else []
            program.run(["build", scene, *design.SCENES[scene][1], *light, f"--structure={structure}", f"--page-size={page}",
                         "-o", str(self.folder / database[1])])

    def _write(self, name, text):
        path = self.folder / name
        if not path.exists():
            path.write_text(text())

    def _run(self, line):
        words = [str(self.folder / word) if word.startswith("databases/") else
                 word.replace("=machines/", f"={self.folder}/machines/") for word in line.split()]
        try:
            one = {"line": line, **_figures(program.counters(words))}
        except program.CapacityError as error:
            one = {"line": line, "misfit": str(error)}
        with self._lock:
            self._kept[line] = one
            with open(self._file, "a") as file:
                file.write(json.dumps(one) + "\n")


def _figures(stats):
    return {"seconds": stats["virtual_seconds"]["total"], "film": stats["film_hash"], "run": stats["run_hash"],
            "processor": stats["seconds"]["user"] + stats["seconds"]["system"], "memory": stats["options"]["node_memory"],
            "host": _host_busy(stats), "rays": stats["rays"]["total"],
            "share": {name: round(stats["time_percent"][name], 3) for name in _COLUMNS}}


def _host_busy(stats):
    """The share of the run in which the host sends or receives."""
    host, total = stats["host"]["virtual_seconds"], stats["virtual_seconds"]["total"]
    return round((host["sending"] + host["receiving"]) / total, 4) if host and total else 0.0


def line_of(cell, scene, memory, system, setting, draw=None):
    """The command of a run. `setting` has the value of each searched option, or nothing for the default."""
    options = dict(setting)
    structure = options.pop("structure", None) or "extents"
    structure = "extents" if "--instances=keep" in design.SCENES[scene][1] else structure  # which other structures do not have
    page = options.pop("page-size", None)
    priced = design.PRICED.get((cell.machine, structure), cell.machine)
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
    return " ".join(["render", *subject, *words, *design.LIGHTS[cell.light], f"--resolution={side}x{side}", f"--nodes={cell.nodes}",
                     f"--node-memory={memory}B", "--runner=virtual", f"--machine={machine}"])


def seconds_of(result):
    return result.get("seconds", float("inf"))
