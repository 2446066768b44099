"""The scene of the study and its runs, which all give the same film."""

import functools
import json

from .. import program
from ..studies import runs
from ..studies.judging import priced_for
from ..studies.table import shortest
from ..studies.texts import counted
from .setups import Database

_OWN = "own"  # the name of a machine's file among drawn machines


def figures(stats):
    """What is kept of a run."""
    options, rays, packets = stats["options"], stats["rays"]["total"], stats["packets"]
    return {"seconds": stats["virtual_seconds"]["total"], "film": stats["film_hash"], "memory": options["node_memory"],
            "in-flight": options["in_flight"], "ray-batch": options["ray_batch"], "host": _host_busy(stats),
            "share": {part: stats["time_percent"][part] for part in runs.PARTS},
            "messages": packets["sent"] / rays if rays else 0.0, "bytes": packets["bytes"] / rays if rays else 0.0}


def _host_busy(stats):
    """The share of the run in which the host computes, sends, receives or serves pages."""
    host, total = stats["host"]["virtual_seconds"], stats["virtual_seconds"]["total"]
    busy = ("computing", "sending", "receiving", "service_busy", "service_idle")
    return sum(host[part] for part in busy) / total if host and total else 0.0


class Subject:
    """`scene` and the words of dmpc render for its picture, on a machine. `folder` is for databases and drawn machines."""

    def __init__(self, scene, picture, machine, folder, jobs, messages):
        self.scene, self._machine, self._picture = scene, machine, picture
        self.count, self.film = 0, None
        self._files = {_OWN: machine} if machine.endswith(".json") else {}
        self._runs = runs.Runs(folder, jobs, figures, self._database_words, messages.say, messages.progress, machines=self._files)
        self._databases, self._structures = {}, set()

    def _database_words(self, name):
        return [self.scene, *self._picture, *self._databases[name].words]

    def line(self, setup, draw=None):
        """The command of a run, on the machine or on one whose prices are drawn."""
        machine = priced_for(self._machine, setup.database.structure)
        if machine == self._machine:
            self._structures.add(setup.database.structure)
        if draw is not None:
            machine = f"machines/{_OWN if self._files else machine}.{draw}.json"
        self._databases[setup.database.name] = setup.database
        return runs.line_of(["render", f"databases/{setup.database.name}.pages", *self._picture, *setup.words, "--runner=virtual",
                             f"--machine={machine}"])

    def get(self, lines):
        """The results of these lines, which are run side by side. Raises a program.InternalError if a film is another's."""
        results = self._runs.get(lines)
        for result in results:
            if "film" in result:
                self.count += 1
                self.film = self.film or result["film"]
                if result["film"] != self.film:
                    raise program.InternalError(f"this is a bug in dmpc, please report it: {result['line']} gives another film")
        return results

    @functools.cache
    def database(self, asked):
        """The "bytes" and "pages" of a database."""
        path = self._path(asked)
        return json.loads(program.run(["info", path, *self._picture, "--nodes=1", "--format=json", "--quiet"]))["database"]

    def _path(self, asked):
        self._databases[asked.name] = asked
        return str(self._runs.database(asked.name))

    @functools.cached_property
    def _own(self):
        """The counters of the picture on one node of the machine: what its options mean."""
        return program.counters(["render", self._path(Database()), *self._picture, "--strategy=replicated", "--nodes=1", "--runner=virtual",
                                 f"--machine={self._machine}"])

    @property
    def size(self):
        """Width, height, and samples of a pixel."""
        resolution = next(word for word in self._picture if word.startswith("--resolution="))
        return *map(int, resolution.split("=")[1].split("x")), self._own["options"]["samples"]

    @property
    def text(self):
        """What is rendered, for a title."""
        options, (width, height, samples) = self._own["options"], self.size
        error, cutoff = options["error"], options["cutoff"]
        return ", ".join([f"{width}x{height} pixels",
                          f"samples refined to an error of {255 * error:.3f}/255" if error else counted(samples, "sample") + " a pixel",
                          *([f"cutoff {255 * cutoff:.3f}/255"] if cutoff else []),
                          f"depth {options['depth']}" if options["transport"] == "whitted" else _paths_text(options),
                          f"convention {options['convention']}", f"record order {options['record_order']}",
                          counted(self._own["database"]["primitives"], "primitive")])

    @property
    def machine_name(self):
        return self._own["machine"]["name"]

    @property
    def machine_text(self):
        machine = self._own["machine"]
        links = " without contention" if not machine["has_contention"] else " with memory ports" if machine["has_memory_port"] else ""
        return f"Machine {machine['name']}{links} (machine_digest {self._own['machine_digest']})"

    def prices_of(self, structure):
        """The name of the machine whose prices runs on this structure have."""
        priced = priced_for(self._machine, structure)
        return self.machine_name if priced == self._machine else priced

    def price_notes(self):
        """Of structures that the machine has no prices for."""
        known = self._own["machine"]["prices_for"]
        return [f"{self.machine_name} has prices for other structures ({', '.join(known)}) than {structure}, so virtual times may be far "
                f"off; {priced_for('ipsc2', structure)} has prices for {structure}."
                for structure in sorted(self._structures) if known and structure not in known]


def _paths_text(options):
    """paths, 3 bounces, sky 1,1,1."""
    more = (("sky", "sky"), ("light_radius", "lights of radius"), ("clamp", "indirect light clamped to"))
    given = [f"{text} {_plain(options[key])}" for key, text in more if options[key]]
    return ", ".join(["paths", counted(options["bounces"], "bounce"), *given])


def _plain(value):
    return value if isinstance(value, str) else shortest(value)
